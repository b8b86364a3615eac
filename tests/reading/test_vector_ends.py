"""A vector ends where its arrowhead and the last of its stroke are, not where lines cross."""

from __future__ import annotations

import pytest

from graphkin.drawing.symbols import head
from graphkin.reading.vector_ends import VectorEnd, vector_end
from tests.reading.test_reading import ink_of

TAIL, TIP = 120 + 150j, 180 + 110j
WAY = (TIP - TAIL) / abs(TIP - TAIL)
ACROSS = (TIP - 15j * WAY, TIP + 15j * WAY)
AT = 1.0
"""How far from the drawn head, in mm, a head is read."""

Strokes = list[tuple[complex, complex]]


def vector(tail: complex, tip: complex, *, headed: complex | None = None) -> Strokes:
    """The strokes of a vector, with its head at the tip, or at the end that is given."""
    end = tip if headed is None else headed
    other = tail if abs(end - tip) < AT else tip
    corners = [
        complex(*p) for p in head((other.real, other.imag), (end.real, end.imag), "v").points
    ]
    return [(tail, tip), (corners[0], corners[1]), (corners[0], corners[2])]


def read(strokes: Strokes, others: tuple[complex, ...] = (), *, along: bool = False) -> VectorEnd:
    """What is read of the vector to TIP, at which another line crosses."""
    return vector_end(ink_of(*strokes, ACROSS), TAIL, TIP, list(others), along_line=along)


def test_a_vector_that_ends_at_its_point_has_nothing_against_it() -> None:
    assert read(vector(TAIL, TIP)).is_there


@pytest.mark.parametrize("share", [1.12, 1.3, 1.6, 0.9, 0.7, 0.5])
@pytest.mark.parametrize("along", [False, True])
def test_a_vector_too_long_or_too_short_ends_at_its_head(share: float, *, along: bool) -> None:
    """Also where a construction line along the vector hides the end of its stroke."""
    moved = TAIL + share * (TIP - TAIL)
    line = [(TAIL, TIP + 50 * WAY)] if along else []
    end = read(vector(TAIL, moved) + line, along=along)
    assert end.is_wrong
    assert end.head is not None
    assert abs(end.head - moved) < AT


@pytest.mark.parametrize("share", [1.12, 1.6, 0.95, 0.5])
def test_a_stroke_without_a_head_ends_where_its_ink_does(share: float) -> None:
    end = read([(TAIL, TAIL + share * (TIP - TAIL))])
    assert (end.runs_on, end.stops_short) == (share > 1, share < 1)


def test_a_head_at_the_tail_is_a_vector_turned_round() -> None:
    end = read(vector(TAIL, TIP, headed=TAIL))
    assert end.reversed
    assert end.head is None


def test_the_head_of_another_point_on_the_same_line_is_not_the_vectors() -> None:
    other = TAIL + 1.5 * (TIP - TAIL)
    assert read(vector(TAIL, TIP) + vector(TAIL, other), (other,)).is_there
