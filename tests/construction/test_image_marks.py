"""Where similarity finds a point of a plan, the line or the triangle that holds it is drawn."""

from __future__ import annotations

from itertools import combinations

import pytest
import shapely

from graphkin.construction.core.layout import lay_out
from graphkin.construction.velocity.image_of_link import ImageOfLink
from graphkin.documents.sheet import right_board
from graphkin.drawing.marks import LineMark
from tests.documents.sheet_tools import drawings

NAMES = (
    "crank-slot",
    "engine",
    "gears-pair",
    "lifter",
    "oldham",
    "rapid-return-slider",
    "rod-and-wheel",
    "roller",
    "trammel",
)
LINES = ("velocity", "relative-velocity", "acceleration", "construction", "trial")
NEAR = 0.5
"""Millimetres; what is shorter is not drawn."""


def found_by_similarity(drawing):
    """The numbers of the points that only similarity finds."""
    values = drawing.trace.values
    for number, step, _ in drawing.steps(drawing.plane):
        if isinstance(step.of, ImageOfLink) and step.by_hand not in values:
            yield number, step


@pytest.mark.parametrize("name", NAMES)
def test_every_side_of_the_image_is_drawn(name):
    seen = 0
    for drawing in drawings(name):
        layout = lay_out(drawing)
        lines = shapely.union_all(
            [
                shapely.LineString([(m.x1, m.y1), (m.x2, m.y2)]).buffer(0.01)
                for m in right_board(drawing, layout, "key").marks
                if isinstance(m, LineMark) and m.cls.split()[0] in LINES
            ]
        )
        for number, step in found_by_similarity(drawing):
            corners = [layout.plan(drawing.trace.values[n]) for n in (*step.args[:2], number)]
            for ends in combinations(corners, 2):
                side = shapely.LineString(ends)
                assert side.length < NEAR or lines.covers(side), (drawing.kind, step.name)
                seen += 1
    assert seen


@pytest.mark.parametrize("name", (*NAMES, "roller-plates"))
def test_no_side_of_an_image_covers_an_arrow(name):
    for drawing in drawings(name):
        layout = lay_out(drawing)
        marks = right_board(drawing, layout, "key").marks
        points = {number for number, _ in found_by_similarity(drawing)}
        sides = [
            m for m in marks if isinstance(m, LineMark) and m.step in points and m.cls != "trial"
        ]
        arrows = [
            shapely.LineString([layout.plan(value.tail), layout.plan(value.tip)])
            for number, step, value in drawing.steps(drawing.plane)
            if step.arrow and abs(value.tip - value.tail) * layout.plan.mm > NEAR
        ]
        for mark in sides:
            side = shapely.LineString([(mark.x1, mark.y1), (mark.x2, mark.y2)]).buffer(0.01)
            assert not [arrow for arrow in arrows if side.covers(arrow)], (drawing.kind, mark.name)


def test_what_an_arrow_draws_is_not_drawn_again():
    velocity, acceleration = drawings("lifter")
    sides = {
        step.name: [*step.of.undrawn_sides(velocity)] for _, step in found_by_similarity(velocity)
    }
    assert sides == {"e": [], "p": []}
    named = {step.name: step.of for _, step in found_by_similarity(acceleration)}
    assert named["p′"].is_in_line(acceleration)
    (whole,) = named["p′"].undrawn_sides(acceleration)
    names = {acceleration.trace.program.steps[number].name for number in whole}
    assert names == {"p′", "f′"}
