"""A vector ends where its arrowhead and the last of its stroke are, not where lines cross."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from graphkin.accuracy.pencil import Pencil
from graphkin.drawing.symbols import head
from graphkin.reading.point_reader import PointReader
from graphkin.reading.point_search import ExpectedPlace, LinesCrossing, PointSearch
from graphkin.reading.vector_ends import (
    FAN,
    HEADED,
    VectorEnd,
    bar_runs_on,
    head_along,
    heads,
    vector_end,
)
from tests.reading.test_reading import a_class, code, ink_of, velocity_of  # noqa: F401

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


def read(
    strokes: Strokes,
    others: tuple[complex, ...] = (),
    arriving: tuple[complex, ...] = (),
    *,
    along: bool = False,
) -> VectorEnd:
    """What is read of the vector to TIP, at which another line crosses."""
    ink = ink_of(*strokes, ACROSS)
    return vector_end(ink, TAIL, TIP, list(others), arriving, along_line=along)


BOTH_SIDES = [(TIP, TIP - 40 * WAY * np.exp(1j * np.radians(each))) for each in (-17, 17)]
"""Lines that leave a point on both sides of the vector to it."""
OWN = vector(TAIL, TIP)[1:]
"""Only the head of the vector."""


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


@pytest.mark.parametrize("along", [False, True])
def test_lines_beside_the_vector_do_not_excuse_a_head_at_its_tail(*, along: bool) -> None:
    """Lines leave the point where the sides of a head would be."""
    assert not read(vector(TAIL, TIP, headed=TAIL) + BOTH_SIDES, along=along).is_there


@pytest.mark.parametrize("share", [0.0, 0.6, 1.4])
def test_a_second_head_is_asked_about(share: float) -> None:
    """The head at the point may belong to another vector there, that elsewhere to this one."""
    moved = TAIL + share * (TIP - TAIL)
    second = vector(TAIL, TIP, headed=TAIL) if share == 0 else vector(TAIL, moved)
    end = read([*second, *OWN, (TAIL, TIP + 50 * WAY)], along=True)
    assert end.doubled
    assert not end.is_wrong


def test_the_head_of_a_vector_that_ends_at_the_tail_is_its_own() -> None:
    start = TAIL + 30 * WAY
    strokes = vector(TAIL, TIP) + vector(start, TAIL)
    assert read(strokes, along=True).doubled
    assert read(strokes, arriving=(TAIL - start,), along=True).is_there


def test_a_stroke_that_ends_at_its_point_needs_no_head() -> None:
    """What looks like a head farther back on it is not its own."""
    back = vector(TAIL, TAIL + 0.5 * (TIP - TAIL))[1:]
    assert read([(TAIL, TIP), *back]).is_there
    assert read([(TAIL, TIP), *back, (TAIL, TIP + 50 * WAY)], along=True).head is not None


def test_long_lines_on_both_sides_are_no_head() -> None:
    lines = [(TIP, TIP - 40 * WAY * np.exp(1j * np.radians(each))) for each in (-28, 28)]
    assert heads(ink_of((TAIL, TIP), *lines), np.array([TIP]), WAY)[0] < HEADED


LINE: Strokes = [(TAIL, TIP + 50 * WAY)]


def ring(place: complex) -> Strokes:
    """The ring of a point."""
    turns = 0.85 * np.exp(1j * np.arange(0, 2 * np.pi + 0.3, 0.3))
    return [(place + a, place + b) for a, b in pairwise(turns.tolist())]


RING = ring(TIP)


def test_a_point_on_a_line_without_head_and_mark_is_open() -> None:
    """Nothing that is drawn says that the vector ends there, so a person is asked."""
    assert read(LINE, along=True).open
    assert read(LINE + RING, along=True).is_there
    assert read(vector(TAIL, TIP) + LINE, along=True).is_there


def test_a_ring_does_not_excuse_a_head_at_the_tail() -> None:
    assert not read(vector(TAIL, TIP, headed=TAIL) + RING).is_there


def test_where_a_vector_is_not_drawn_nothing_is_said_of_its_end() -> None:
    assert read([]).is_there


@pytest.mark.parametrize("share", [0.7, 1.3])
def test_the_head_of_another_vector_to_the_point_is_not_the_vectors(share: float) -> None:
    """Two vectors nearly along one another: one ends at the point, the other elsewhere."""
    moved = TAIL + share * (TIP - TAIL)
    other = TIP - 45 * WAY * np.exp(1j * np.radians(8))
    ink = ink_of(*vector(TAIL, moved), *vector(other, TIP), *LINE)
    end = vector_end(ink, TAIL, TIP, [], along_line=True, beside=[TIP - other])
    assert not end.is_there


@pytest.mark.parametrize("share", [0.7, 1.35])
def test_a_head_elsewhere_is_asked_about_where_another_vector_covers_the_stroke(
    share: float,
) -> None:
    """The vector of a farther point runs along this one, and another's head is at the point."""
    far, moved = TAIL + 1.9 * (TIP - TAIL), TAIL + share * (TIP - TAIL)
    end = read([*vector(TAIL, far), *vector(TAIL, moved), *OWN], (far,))
    assert not end.is_there


def test_vectors_that_leave_a_pole_on_both_sides_are_no_head() -> None:
    for turn in (15, 19, 25):
        fan = [(TIP, TIP - 40 * WAY * np.exp(1j * np.radians(each))) for each in (-turn, turn)]
        assert heads(ink_of((TAIL, TIP), *fan), np.array([TIP]), WAY, lines=FAN)[0] < HEADED


def test_a_bar_that_runs_on_beyond_a_point_without_a_mark_is_seen() -> None:
    far = TIP + 20 * WAY
    assert bar_runs_on(ink_of((TAIL, far), ACROSS), TAIL, TIP, [])
    assert not bar_runs_on(ink_of((TAIL, far), ACROSS, *RING), TAIL, TIP, [])
    assert not bar_runs_on(ink_of((TAIL, TIP), ACROSS), TAIL, TIP, [])
    assert not bar_runs_on(ink_of((TAIL, far), ACROSS), TAIL, TIP, [far])


def test_a_letter_beyond_a_head_is_no_stroke_that_runs_on() -> None:
    """The letter lies on the line of the vector, apart from the point."""
    assert read([*vector(TAIL, TIP), (TIP + 2.1 * WAY, TIP + 7 * WAY)]).is_there
    assert read([(TAIL, TIP + 7 * WAY)]).runs_on


def test_a_stroke_beside_its_line_is_no_side_of_a_head() -> None:
    """Beyond the point the construction line swerves by 0.5 mm, and another line crosses it."""
    bend = TIP + 16 * WAY
    swerved = bend + 0.45j * WAY
    across = WAY * np.exp(1j * np.radians(35))
    crossing = (swerved - 20 * across, swerved + 20 * across)
    line = [(TIP, swerved), (swerved, swerved + 30 * (swerved - TIP) / abs(swerved - TIP))]
    assert read([(TAIL, TIP), *RING, *line, crossing], along=True).head is None


@pytest.mark.parametrize("long", [1.0, 1.8])
def test_a_head_is_read_in_the_size_of_the_hand(long: float) -> None:
    """A filled head of twice the size has no second head farther back on its shaft."""
    tip = heads_of(TIP, long * 3.2)
    line = [(TAIL, TIP + 50 * WAY)]
    assert read([(TAIL, TIP), *tip, *line], along=True).is_there


def heads_of(tip: complex, long: float) -> Strokes:
    """A slim head, filled with strokes from its tip."""
    turns = np.radians(np.arange(-12, 12.1, 3))
    return [(tip, tip - long * WAY * np.exp(1j * turn)) for turn in turns]


def test_a_head_just_beyond_the_point_is_not_its_own() -> None:
    """The construction line hides the stroke, and a ring marks the point that was passed."""
    assert not read([*vector(TAIL, TIP + 3.1 * WAY), *LINE, *RING], along=True).is_there


@pytest.mark.parametrize("turn", [35, 60])
@pytest.mark.parametrize("past", [2.4, 3.5, 5.5, -2.4])
def test_a_head_beside_a_point_with_other_heads_is_asked_about(past: float, turn: int) -> None:
    """Two other vectors end at the point, and their heads look like the end of this one."""
    tails = [TIP - 45 * WAY * np.exp(1j * np.radians(each)) for each in (-turn, turn)]
    others = [stroke for tail in tails for stroke in vector(tail, TIP)]
    ways = [TIP - tail for tail in tails]

    def end(past: float) -> VectorEnd:
        ink = ink_of(*vector(TAIL, TIP + past * WAY), *LINE, *others, ACROSS)
        return vector_end(ink, TAIL, TIP, [], along_line=True, beside=ways)

    assert end(0.0).is_there
    assert end(past).doubled


def test_half_a_head_at_the_tail_of_a_vector_without_one_is_asked_about() -> None:
    """A printed pole hides the other half; a ring alone says that the point is there."""
    half = [(TAIL, TAIL + 1.6 * WAY * np.exp(1j * np.radians(each))) for each in (-17, 17)]
    assert read([*LINE, *RING], along=True).is_there
    assert read([*LINE, *RING, *half], along=True).open


@pytest.mark.parametrize("headed", [True, False])
def test_a_vaguely_expected_point_is_where_its_own_vector_ends(
    a_class: Path,  # noqa: F811
    code: str,  # noqa: F811
    *,
    headed: bool,
) -> None:
    """The head at the end of a vector from the pole says that no other lines cross there."""
    sheet = velocity_of(a_class, code)
    steps, values = sheet.exact.program.steps, sheet.exact.trace.values
    number, pole = (next(n for n in values if steps[n].name == name) for name in "ao")
    o, at = complex(sheet.place(pole, values[pole])), 300 + 100j
    shaft, *sides = vector(o, at)
    reader = PointReader(sheet, ink_of(shaft, *(sides if headed else [])), Pencil(0.4, 0.4))
    reader.next = reader.drawings = reader.ahead()
    away = 2.8 * (at - o) / abs(at - o)
    own = ExpectedPlace(at + away, np.eye(2) * 1.9)
    read = LinesCrossing(at, np.eye(2) * 0.01, 2, 1.0)
    told = reader.verdict_on(number, own, own, read)
    assert (told.verdict, "vague" in told.doubts) == ("right", not headed)
    reader.own[next(n for n in sheet.points if steps[n].name == "b")] = at - 0.8j
    assert "vague" in reader.verdict_on(number, own, own, read).doubts


@pytest.mark.parametrize(("turn", "runs_on"), [(6, True), (90, True), (90, False)])
def test_a_vector_along_a_line_ends_at_the_tip_of_its_head(turn: int, *, runs_on: bool) -> None:
    """Neither the sides of the head nor a line that leaves flatly move its end."""
    other = (TIP, TIP - 60 * WAY * np.exp(1j * np.radians(turn)))
    ink = ink_of(*vector(TAIL, TIP), *(LINE + RING if runs_on else []), other)
    for beside in (-2.5, 0.0, 2.0):
        found = head_along(ink, TIP + beside * WAY, WAY, 3.5)
        assert found == pytest.approx(-beside, abs=0.35)


def test_of_two_heads_near_one_another_none_is_the_end() -> None:
    ink = ink_of(*vector(TAIL, TIP), *vector(TAIL, TIP - 6 * WAY), *LINE)
    assert head_along(ink, TIP - 3 * WAY, WAY, 4.0) is None
    assert head_along(ink, TIP + 20 * WAY, WAY, 4.0) is None


def test_a_point_laid_off_on_a_line_is_at_its_head(
    a_class: Path,  # noqa: F811
    code: str,  # noqa: F811
) -> None:
    """Another line leaves it too flatly to cross; the sides of the head leave it farther back."""
    sheet = velocity_of(a_class, code)
    steps, values = sheet.exact.program.steps, sheet.exact.trace.values
    number, pole = (next(n for n in values if steps[n].name == name) for name in "ao")
    o, at = complex(sheet.place(pole, values[pole])), 300 + 100j
    way = (at - o) / abs(at - o)
    flat = (at, at - 60 * way * np.exp(1j * np.radians(5)))
    ink = ink_of(*vector(o, at), (at, at + 30 * way), flat)
    search = PointSearch(sheet, ink, Pencil(0.4, 0.4))
    search.next = search.drawings = search.ahead()
    found = search.best_near(number, ExpectedPlace(at + 0.6 * way, np.eye(2) * 0.5))
    assert found is not None
    assert abs(found.place - at) < 0.4


@pytest.mark.parametrize("past", [1.8, 2.0, 2.4, 2.8])
@pytest.mark.parametrize("along", [False, True])
def test_a_head_and_a_ring_a_little_beyond_the_point_are_asked_about(
    past: float, *, along: bool
) -> None:
    moved = TIP + past * WAY
    strokes = vector(TAIL, moved) + ring(moved) + LINE * along
    assert not read(strokes, along=along).is_there
    assert read(vector(TAIL, TIP) + RING + LINE * along, along=along).is_there


@pytest.mark.parametrize("turn", [-6, 5, 8])
def test_the_head_of_a_vector_beside_it_does_not_hide_that_one_ends_before_the_point(
    turn: int,
) -> None:
    """Its own head is farther back on its line, and its neighbour is drawn up to the point."""
    start = TIP - 50 * WAY * np.exp(1j * np.radians(turn))
    short = vector(TAIL, TIP - 16 * WAY)
    assert not read(short + vector(start, TIP)).is_there
    assert read(vector(TAIL, TIP) + vector(start, TIP)).is_there
