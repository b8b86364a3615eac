"""The letter beside a point is evidence: exchanged letters are asked, unread ones say nothing."""

from __future__ import annotations

from itertools import pairwise
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from graphkin.construction.core.program import Plane
from graphkin.drawing.marks import Text
from graphkin.reading.drawn_ink import DENSITY, DrawnInk
from graphkin.reading.point_letters import FLOOR, INKED, letters_near, pieces, straight
from graphkin.reading.point_reader import PointReader
from graphkin.reading.point_reading import PointReading, ReadVerdict, pair
from tests.reading.hand_letters import Writing, written
from tests.reading.test_reading import ink_of

POINT = 300 + 150j
LINES = [(POINT, POINT + 50j), (POINT, POINT - 50 + 20j), (POINT, POINT + 30 - 40j)]
LETTERS = "abcd"
SEEDS = range(8)


def strokes(letter: str, seed: int, point: complex = POINT) -> list[tuple[complex, complex]]:
    """A letter written beside a point."""
    mark = Text(point.real + 2.5, point.imag + 0.5, letter, "letter", 3.2)
    paths = written(mark, Writing(wobble=0.2), np.random.default_rng(seed))
    return [
        (complex(*start), complex(*end)) for path in paths for start, end in pairwise(path.tolist())
    ]


def beside(letter: str, seed: int) -> DrawnInk:
    """A point at which lines meet, with a letter beside it."""
    return ink_of(*LINES, *strokes(letter, seed))


@pytest.mark.parametrize("letter", LETTERS)
def test_a_written_letter_is_likelier_than_any_other_of_the_plan(letter: str) -> None:
    best = [
        max(likely := letters_near(beside(letter, seed), POINT, LETTERS), key=likely.__getitem__)
        for seed in SEEDS
    ]
    assert best.count(letter) >= 0.75 * len(best)


def test_a_letter_under_print_is_not_cut_in_two() -> None:
    """Print hides the middle of its stem, and the ends of its stroke are no letter."""
    best = []
    for seed in SEEDS:
        ink = beside("c", seed)
        middle = (POINT + 2.3 - complex(*ink.paper.fields[:2])) * DENSITY
        known = ink.known.copy()
        row, column = round(middle.imag), round(middle.real)
        known[row - 4 : row + 4, column - 8 : column + 8] = 0
        likely = letters_near(DrawnInk(ink.dark, known, ink.sway, ink.paper), POINT, LETTERS)
        best.append(max(likely, key=likely.__getitem__))
    assert best.count("c") >= 0.5 * len(best)


def test_a_point_without_a_letter_has_none() -> None:
    likely = letters_near(ink_of(*LINES), POINT, LETTERS)
    assert max(likely.values()) == FLOOR


@pytest.mark.parametrize("place", [-40 + 150j, 500 + 150j, 200 - 60j, 200 + 400j])
def test_a_point_outside_the_fields_has_no_letter(place: complex) -> None:
    """Lines that cross beyond the edge of the sheet's fields are read as a point there."""
    likely = letters_near(ink_of(*LINES), place, LETTERS)
    assert set(likely.values()) == {FLOOR}


def test_a_letter_far_from_the_point_is_not_its_own() -> None:
    far = POINT - 14 - 8j
    likely = letters_near(beside("b", 1), far, LETTERS)
    assert max(likely.values()) == FLOOR


OTHER = POINT + 30 - 40j
PLACES = {0: POINT, 1: OTHER}


TRIED = POINT - 40 + 30j
"""Where d of a trial plan is expected."""


def compared(
    ink: DrawnInk, tried: complex | None = None, second: ReadVerdict = "right"
) -> list[PointReading]:
    """The readings of b and d, b right by its lines, after their letters were compared.

    With ``tried``, there is a d of a trial plan as well. ``second`` is the verdict on d.
    """
    reader = object.__new__(PointReader)
    steps = [SimpleNamespace(plane=Plane.VELOCITIES, aside=None, name="b")] * 2
    values = dict(PLACES)
    if tried is not None:
        values[2] = tried
        steps.append(SimpleNamespace(plane=Plane.VELOCITIES, aside=1, name="d¹"))
    trace = SimpleNamespace(values=values)
    exact = SimpleNamespace(program=SimpleNamespace(steps=steps), trace=trace)
    drawing = SimpleNamespace(plane=Plane.VELOCITIES)
    sheet = SimpleNamespace(exact=exact, drawing=drawing, place=lambda _, value: value)
    reader.sheet = cast("Any", sheet)
    reader.ink, reader.own, reader.next = ink, dict(PLACES), values
    verdicts: dict[str, ReadVerdict] = {"b": "right", "d_1": second}
    reader.readings = {
        number: PointReading(name, number, pair(at), verdict, False, pair(at), pair(at), 0.0)
        for (number, at), (name, verdict) in zip(PLACES.items(), verdicts.items(), strict=True)
    }
    reader.compare_letters()
    return list(reader.readings.values())


@pytest.mark.parametrize("seed", SEEDS)
def test_exchanged_letters_are_asked_and_proposed_as_wrong(seed: int) -> None:
    right = ink_of(*LINES, *strokes("b", seed), *strokes("d", seed, OTHER))
    assert not any(each.ask for each in compared(right))
    exchanged = ink_of(*LINES, *strokes("d", seed), *strokes("b", seed, OTHER))
    one, other = compared(exchanged)
    assert one.ask
    assert other.ask
    assert one.doubts == ("letter",)
    if one.verdict == "wrong":
        assert one.at == pair(OTHER)


@pytest.mark.parametrize("seed", SEEDS)
def test_one_letter_of_another_point_is_enough_to_ask(seed: int) -> None:
    """The other letter is not read: lines cross it, or it is not there."""
    one, other = compared(ink_of(*LINES, *strokes("d", seed)))
    assert one.ask
    assert other.ask
    assert not any(each.ask for each in compared(ink_of(*LINES, *strokes("b", seed))))


@pytest.mark.parametrize("seed", SEEDS)
def test_a_letter_exchanged_with_that_of_a_wrong_point_is_asked(seed: int) -> None:
    """The other point is somewhat off, so that a person is asked about it anyway."""
    ink = ink_of(*LINES, *strokes("d", seed), *strokes("b", seed, OTHER))
    one, other = compared(ink, second="wrong")
    assert one.doubts == ("letter",)
    assert other.at == pair(OTHER)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_letter_exchanged_with_that_of_a_trial_plan_is_asked(seed: int) -> None:
    """The point of the trial plan is not read itself, and nothing else says that b is wrong."""
    right = ink_of(*LINES, *strokes("b", seed), *strokes("d", seed, TRIED))
    assert not any(each.ask for each in compared(right, TRIED))
    own = strokes("d", seed, OTHER)
    exchanged = ink_of(*LINES, *own, *strokes("d", seed), *strokes("b", seed, TRIED))
    one, other = compared(exchanged, TRIED)
    assert not other.ask
    assert one.doubts == ("letter",)
    if one.verdict == "wrong":
        assert one.at == pair(TRIED)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_letter_of_a_trial_plan_near_by_is_not_the_points(seed: int) -> None:
    """The point's own letter is not read; that of a trial plan is written close to it."""
    near = POINT + 1 + 1j
    assert not any(each.ask for each in compared(ink_of(*LINES, *strokes("d", seed, near)), near))


@pytest.mark.parametrize(("long", "gone"), [(6.0, False), (12.0, True)])
def test_the_stem_of_a_tall_letter_is_no_line(long: float, *, gone: bool) -> None:
    inked = (ink_of((POINT, POINT + 1j * long)).dark > INKED).astype(np.uint8)
    assert bool(straight(inked).any()) == gone


def test_points_without_letters_are_not_asked() -> None:
    assert not any(each.ask for each in compared(ink_of(*LINES)))


def test_a_prime_makes_no_other_letter() -> None:
    """The prime stands close to an a, where the stem of a d is; the stem is a part of the d."""
    bowl = [
        (1.2 * np.exp(1j * turn), 1.2 * np.exp(1j * (turn + 0.3)))
        for turn in np.arange(0, 6.3, 0.3)
    ]
    for stem, parts in ((1.0, 1), (3.6, 2)):
        upright = (2.0 - 1.4j, 2.0 + (stem - 1.4) * 1j)
        ink = ink_of(*((POINT + a, POINT + b) for a, b in [*bowl, upright]))
        x, y = (
            round((POINT.real - ink.paper.fields[0]) * DENSITY),
            round((POINT.imag - ink.paper.fields[1]) * DENSITY),
        )
        found = [box for box, _ in pieces(ink.dark[y - 60 : y + 60, x - 60 : x + 60])]
        wide = [box for box in found if box[2] > 3.0 * DENSITY]
        assert len(wide) == parts - 1


@pytest.mark.parametrize("seed", SEEDS)
def test_specks_of_the_paper_do_not_join_letters_to_lines(seed: int) -> None:
    """Specks are darker than half a letter where the pencil is pale."""
    ink = beside("b", seed)
    rng = np.random.default_rng(seed)
    specks = 0.55 * (rng.random(ink.dark.shape) < 0.15).astype(np.float32)
    pale = DrawnInk(np.maximum(ink.dark, specks), ink.known, ink.sway, ink.paper)
    likely = letters_near(pale, POINT, LETTERS)
    clean = letters_near(ink, POINT, LETTERS)
    assert likely["b"] > clean["b"] / 3
