"""Class and order of Assur groups, after Artobolevsky."""

from __future__ import annotations

from itertools import permutations

import pytest

from graphkin.structure.groups import assur_class, loop_sizes

DYAD = ([("1", "2")], ["1", "2"])
TRIAD = ([("p", "1"), ("p", "2"), ("p", "3")], ["1", "2", "3"])
SQUARE = ([("1", "2"), ("2", "3"), ("3", "4"), ("4", "1")], ["1", "3"])
TWO_PLATES = (
    [("p", "1"), ("p", "2"), ("p", "q"), ("q", "3"), ("q", "4")],
    ["1", "2", "3", "4"],
)
PLATE_OF_FOUR = ([("p", str(n)) for n in range(1, 5)], ["p", "1", "2", "3", "4"])
PENTAGON = (
    [("1", "2"), ("2", "3"), ("3", "4"), ("4", "5"), ("5", "1"), ("2", "6")],
    ["6", "1", "4"],
)


@pytest.mark.parametrize(
    ("group", "expected"),
    [
        (DYAD, (2, 2)),
        (TRIAD, (3, 3)),
        (SQUARE, (4, 2)),
        (TWO_PLATES, (3, 4)),
        (PLATE_OF_FOUR, (5, 5)),
        (PENTAGON, (5, 3)),
    ],
    ids=["dyad", "triad", "square of links", "two plates", "five pairs on a plate", "pentagon"],
)
def test_class_is_the_largest_contour_and_order_the_outer_pairs(group, expected):
    assert assur_class(*group) == expected


@pytest.mark.parametrize("group", [TRIAD, SQUARE, PENTAGON])
def test_the_order_in_which_pairs_are_written_changes_nothing(group):
    inner, outer = group
    for turned in permutations(inner):
        assert assur_class([pair[::-1] for pair in turned], outer) == assur_class(inner, outer)


def test_loops_are_as_short_as_can_be_and_as_many_as_are_independent():
    """Two squares with a side in common: 4 and 4, never the hexagon around both."""
    ladder = [("a", "b"), ("b", "c"), ("c", "d"), ("d", "a"), ("c", "e"), ("e", "f"), ("f", "d")]
    assert loop_sizes(ladder) == [4, 4]
    assert loop_sizes([("a", "b"), ("b", "c")]) == []
    assert loop_sizes([("a", "b"), ("x", "y"), ("y", "z"), ("z", "x")]) == [3]
