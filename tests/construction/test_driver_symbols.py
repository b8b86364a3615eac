"""Drivers in words and marks: angles in degrees and from what, rates in full, arrows left clear."""

from __future__ import annotations

from math import hypot

import pytest

from graphkin.construction.core.given_data import given
from graphkin.documents.sentences import sentences
from graphkin.drawing.marks import Arc
from graphkin.drawing.richtext import plain
from tests.documents.sheet_tools import drawings, drawn, kind_of


def told(name, kind, n=None):
    """The sentences of a sheet in plain letters."""
    drawing = next(d for d in drawings(name, n) if d.kind == kind)
    return [plain(said.markup) for said in sentences(drawing)]


def test_an_angle_in_radians_is_told_in_degrees_too():
    (velocity, _) = drawings("jumper")
    assert any(plain(piece) == "φshank = 2.39159 rad = 137.03°" for piece in given(velocity))
    assert "through A draw the line at φshank = 137.03°; on it lay off AK: K" in told(
        "jumper", "velocity"
    )
    (cutter, *_) = drawings("excavator-relative")
    assert all("rad =" not in piece and "deg" not in piece for piece in given(cutter))


def test_an_angle_against_a_link_says_from_which_line():
    first, second = told("excavator-relative", "velocity")[1:3]
    assert first.startswith("through A draw the line at φstick/boom to OA produced;")
    assert second.startswith("through B draw the line at φbucket/stick to AB produced;")


@pytest.mark.parametrize(
    ("kind", "sum_of"),
    [
        ("velocity", "ωstick = ωboom + ωstick/boom = −0.4102 rad/s"),
        ("velocity", "ωbucket = ωstick + ωbucket/stick = −0.9076 rad/s"),
        ("acceleration", "εstick = εboom + εstick/boom = 0.1047 rad/s2"),
    ],
)
def test_a_rate_that_is_a_sum_is_formed_where_it_is_used_first(kind, sum_of):
    assert sum(sum_of in said for said in told("excavator-relative", kind)) == 1


def test_a_velocity_is_laid_off_in_the_sense_that_the_figure_names():
    (said,) = (one for one in told("four-bar-crank-rocker", "velocity") if "as long as" in one)
    assert "in the sense of ω1, as long as" in said


def test_a_block_on_a_lever_is_told_by_the_side_of_its_pivot():
    (velocity, *_) = drawings("slotted-lever", 7)
    assert any("A slides along O2B, on the side of B from O2" in plain(p) for p in given(velocity))


@pytest.mark.parametrize("name", ["jumper", "excavator-absolute", "excavator-relative"])
def test_no_velocity_crosses_the_arrow_of_a_turning(name):
    page = drawn(name, None, "velocity")
    arcs = [m for m in page.marks["mechanism"] if isinstance(m, Arc) and kind_of(m) == "sense"]
    vectors = [v for v in page.vectors("mechanism") if kind_of(v) == "velocity"]
    assert len(arcs) > 2 and len(vectors) > 2
    for arc in arcs:
        low, high = arc.at(arc.start), arc.at(arc.end)
        for vector in vectors:
            if hypot(vector.x1 - arc.cx, vector.y1 - arc.cy) < 0.01:
                sides = [
                    (vector.x2 - vector.x1) * (y - vector.y1)
                    - (vector.y2 - vector.y1) * (x - vector.x1)
                    for x, y in (low, high)
                ]
                ahead = [
                    (vector.x2 - vector.x1) * (x - vector.x1)
                    + (vector.y2 - vector.y1) * (y - vector.y1)
                    for x, y in (low, high)
                ]
                assert sides[0] * sides[1] > 0 or max(ahead) < 0, vector.name
