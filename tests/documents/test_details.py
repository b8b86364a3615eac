"""Enlarged details: at short vectors and where triangles meet, with indices that can be read."""

from __future__ import annotations

from math import dist

import pytest

from graphkin.construction.core.component import crowded_pins
from graphkin.documents.detail import RADIUS
from graphkin.drawing.label import SMALL
from graphkin.drawing.marks import CircleMark, Text
from graphkin.drawing.richtext import runs
from tests.chosen import HALVES
from tests.documents.sheet_tools import drawn, kind_of, kinds_of

NAMES = dict.fromkeys((*HALVES[0], "stephenson-3-crank", "watt-1"))


def accelerations(name):
    """The acceleration sheet of a scene, if it has one."""
    return [drawn(name, None, kind) for kind in kinds_of(name) if kind == "acceleration"]


def circles(page):
    """The circles of the details on a mechanism: the small ones and the large ones."""
    marks = page.marks["mechanism"]
    every = [m for m in marks if isinstance(m, CircleMark) and m.cls == "detail"]
    return [m for m in every if m.r < RADIUS], [m for m in every if m.r == RADIUS]


@pytest.mark.parametrize("name", NAMES)
def test_each_small_circle_has_its_large_one(name):
    for page in accelerations(name):
        small, large = circles(page)
        assert len(small) == len(large)


def test_a_pin_at_which_three_triangles_meet_is_shown_enlarged():
    page = drawn("stephenson-3-crank", None, "acceleration")
    (pin,) = crowded_pins(page.drawing, 3)
    small, _ = circles(page)
    assert any(dist(page.layout.mechanism(pin), (m.cx, m.cy)) < m.r for m in small)


@pytest.mark.parametrize("name", NAMES)
def test_indices_in_details_are_as_high_as_the_smallest_lettering(name):
    for page in accelerations(name):
        for mark in (*page.marks["mechanism"], *page.marks["plan"]):
            if isinstance(mark, Text) and kind_of(mark) == "label" and not mark.name:
                sizes = [run.size for run in runs(mark.markup, mark.height)]
                assert mark.height * min(sizes) / max(sizes) > SMALL - 0.1, mark.markup
