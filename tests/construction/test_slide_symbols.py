"""The drawn part of a guide of the frame stays clear of fixed pivots, in every kind of number, its
line of the field's edge; what bears the frame stays clear of the notes."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from graphkin.construction.guides.slide_symbols import (
    AWAY,
    LEAST,
    REACH,
    clear_of_pivots,
    merged,
    rails_of,
)
from tests.documents.made_up import field_of, made_up

SCENE = """
[frame]
O = [0, {below}]
G = [0, 0]
[links.1]
O-B = 40
[links.2]
A = [0, 0]
slides = {{ on = 0, through = "G", angle = 0 }}
"""
SPANS = {
    30: (30 - REACH, 30 + REACH),
    20: (AWAY, 20 + REACH),
    10: (10 - LEAST, 10 + REACH),
    -10: (-10 - REACH, -10 + LEAST),
    -20: (-20 - REACH, -AWAY),
    -30: (-30 - REACH, -30 + REACH),
}
"""The drawn part, in mm from a pivot on the guide, by where the block stands."""


def span(middle, below=0):
    """The part about a block whose middle stands there, with the pivot so far below the guide."""
    points = {"O": -1j * below, "G": 0j, "B": 40 - 1j * below, "A": 0j}
    drawing = made_up(SCENE.format(below=-below), points)
    (rail,) = rails_of(drawing)
    return clear_of_pivots(drawing, field_of(drawing), rail, middle)


@pytest.mark.parametrize("middle", SPANS)
def test_a_guide_ends_before_a_pivot_but_holds_its_block(middle):
    assert span(float(middle)) == pytest.approx(SPANS[middle])


def test_many_places_at_once_give_what_each_gives_alone():
    low, high = span(np.array(list(SPANS), float))
    expected = np.array(list(SPANS.values())).T
    assert (low, high) == (pytest.approx(expected[0]), pytest.approx(expected[1]))


def test_parts_of_a_guide_less_than_two_millimetres_apart_are_drawn_as_one():
    """Whatever lies in whatever: the drawn parts hold every one of them, 2 mm or more apart."""
    chance = np.random.default_rng(3)
    for _ in range(200):
        lows = chance.uniform(0, 60, 6)
        parts = [*zip(lows, lows + chance.uniform(0.5, 12, 6), strict=True)]
        drawn = [*merged(parts)]
        assert all(any(low <= a and b <= high for low, high in drawn) for a, b in parts)
        assert all(late - end >= 2 for (_, end), (late, _) in pairwise(drawn))
        ends = {each for part in parts for each in part}
        assert {each for part in drawn for each in part} <= ends
    assert [*merged([(7.0, 9.0), (0.0, 2.0), (3.9, 5.0)])] == [(0.0, 5.0), (7.0, 9.0)]
