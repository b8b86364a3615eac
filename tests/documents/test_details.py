"""Enlarged details: at short vectors and where triangles meet, with indices that can be read."""

from __future__ import annotations

from math import dist

import pytest

from graphkin.construction.core.component import crowded_pins
from graphkin.documents.detail import RADIUS
from graphkin.drawing.label import SMALL
from graphkin.drawing.marks import CircleMark, Text
from graphkin.drawing.richtext import runs
from tests.chosen import SCENES
from tests.documents.sheet_tools import drawn, kind_of, kinds_of

ACCELERATIONS = [name for name in SCENES if "acceleration" in kinds_of(name)]


def circles(page):
    """The circles of the details on a mechanism: the small ones and the large ones."""
    marks = page.marks["mechanism"]
    every = [m for m in marks if isinstance(m, CircleMark) and m.cls == "detail"]
    return [m for m in every if m.r < RADIUS], [m for m in every if m.r == RADIUS]


@pytest.mark.parametrize("name", ACCELERATIONS)
def test_each_small_circle_has_its_large_one(name):
    small, large = circles(drawn(name, None, "acceleration"))
    assert len(small) == len(large)


def test_a_pin_at_which_three_triangles_meet_is_shown_enlarged():
    page = drawn("stephenson-3-crank", None, "acceleration")
    (pin,) = crowded_pins(page.drawing, 3)
    small, _ = circles(page)
    assert any(dist(page.layout.mechanism(pin), (m.cx, m.cy)) < m.r for m in small)


@pytest.mark.parametrize("name", ACCELERATIONS)
def test_indices_in_details_are_as_high_as_the_smallest_lettering(name):
    page = drawn(name, None, "acceleration")
    for field in ("mechanism", "plan"):
        for mark in page.marks[field]:
            if isinstance(mark, Text) and kind_of(mark) == "label" and not mark.name:
                sizes = [run.size for run in runs(mark.markup, mark.height)]
                assert mark.height * min(sizes) / max(sizes) > SMALL - 0.1, mark.markup
