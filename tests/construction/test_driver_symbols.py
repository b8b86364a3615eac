"""Drivers in words and marks: angles in degrees and from what, rates in full, arrows left clear."""

from __future__ import annotations

from math import hypot

import pytest

from graphkin.construction.core.given_data import given
from graphkin.documents.sentences import sentences
from graphkin.drawing.marks import Arc, Text
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


@pytest.mark.parametrize("name", ["excavator-relative", "hoist-differential", "cylinders-two"])
def test_what_shows_how_a_driver_stands_and_moves_says_so_of_its_link(name):
    page = drawn(name, None, "velocity")
    marks = [mark for mark in page.marks["mechanism"] if mark.shows is not None]
    links = [driver.link for driver in drawings(name)[0].scene.drivers]
    moved = {(m.shows.what, m.shows.link) for m in marks if m.shows.what != "guide"}
    assert moved == {(what, link) for what in ("coordinate", "rate") for link in links}
    senses = [m for m in page.marks["mechanism"] if m.cls in ("sense", "arrowhead sense")]
    assert senses and all(mark in marks for mark in senses)
    named = {m.shows.link for m in marks if isinstance(m, Text) and m.shows.what == "rate"}
    assert named == {*links}
