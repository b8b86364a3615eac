"""Classes of 120 who draw by hand: honest ones of every kind, and some who copy."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from functools import lru_cache

import numpy as np
from msgspec import Struct

from graphkin.classroom.grading.class_marking import Book, graded_class
from graphkin.classroom.grading.graded import Answer, Result
from graphkin.classroom.lab.lab_model import exact_text
from graphkin.classroom.roster.students import Student, Taker
from tests.classroom.grading import hand
from tests.classroom.grading.students import lab_of

SIZE = 120
LABS = tuple(hand.DRAW)
Row = dict[str, Answer]


class Kind(Struct, frozen=True):
    """A kind of class: between which ``sigma`` (mm) its hands are, how many times as many degrees
    they turn a direction, to how many ``step`` mm they read and how many ``digits`` they write,
    the share with one of some ``slips``; ``own`` tells that no two have the same data.
    """

    name: str
    sigma: tuple[float, float]
    turn: float = 1.0
    step: float = 0.5
    digits: int = 4
    share: float = 0.0
    slips: Sequence[str] = hand.SLIPS
    own: bool = False


HONEST = (
    Kind("careful", (0.25, 0.25)),
    Kind("ordinary", (0.5, 0.5), digits=3),
    Kind("ordinary, own data", (0.25, 0.75), step=1, digits=3, own=True),
    Kind("weak", (0.5, 0.5), step=1, digits=2, share=0.5),
    Kind("weak, fine hands, own data", (0.25, 0.25), step=1, digits=2, share=0.5, own=True),
    Kind("all but a few with one slip", (0.25, 0.5), digits=3, share=0.9, slips=hand.SLIPS[5:6]),
    Kind("computed, no drawing", (0.0, 0.02), step=0.1, share=0.3),
    Kind("sloppy", (1.5, 1.5), step=1, digits=3),
    Kind("sloppy, angles worse, own data", (1.0, 1.5), 3.0, step=1, own=True),
    Kind("sloppy and weak", (0.5, 1.5), 2.0, step=1, digits=2, share=0.5),
)


@lru_cache
def book_of(lab: str) -> Book:
    """What marks a lab whose parameter takes any number."""
    text = lab_of(lab).scene.read_text(encoding="utf-8")
    return Book(lab_of(lab), text.replace(", step = 1 ", " "))


@lru_cache
def takers_of(kind_own: bool, seed: int) -> tuple[Taker, ...]:
    """A class: each with data of the own, or whole numbers drawn for each."""
    rng = np.random.default_rng([seed, 1])
    numbers = [1 + Fraction(29 * i, SIZE - 1) for i in range(SIZE)]
    if not kind_own:
        numbers = [Fraction(int(n)) for n in rng.integers(1, 31, SIZE)]
    order = rng.permutation(SIZE)
    return tuple(
        Taker(Student(i + 1, f"s{i:03d}"), {"n": exact_text(numbers[place])})
        for i, place in enumerate(order)
    )


def number_of(taker: Taker) -> float:
    """The parameter of a student's variant."""
    return float(Fraction(taker.settings["n"]))


@lru_cache(4096)
def sheet_of(lab: str, settings: str) -> tuple[float, float, float]:
    """kL, kv and ka of the sheets of a variant."""
    scales = book_of(lab).marker({"n": settings}).standard.scales
    return scales.kL, scales.kv, scales.ka


def written(field: str, value: float, digits: int) -> Answer:
    """A value as it is handed in: a size, a sense, or a place."""
    if field.endswith("_sense"):
        return Answer("+" if value > 0 else "-", value, signed=True)
    place = field.endswith(("_x_mm", "_y_mm"))
    size = value if place else abs(value)
    if field.endswith("_mm"):
        text = f"{size:.1f}".removesuffix(".0")
    else:
        text = f"{Decimal(f'{size:.{digits}g}'):f}"
    return Answer(text, float(text))


def row(lab: str, taker: Taker, kind: Kind, rng: np.random.Generator, honest: bool = True) -> Row:
    """What a student hands in who draws the own data."""
    given, sheet = hand.data(lab, number_of(taker)), sheet_of(lab, taker.settings["n"])

    def draw(pencil: Sequence[float], slips: Sequence[str]) -> dict[str, float]:
        return hand.drawn(lab, given, sheet, rng, *pencil, slips)

    return drawn_row(draw, kind, rng, honest)


def drawn_row(
    draw: Callable[[Sequence[float], Sequence[str]], dict[str, float]],
    kind: Kind,
    rng: np.random.Generator,
    honest: bool = True,
) -> Row:
    """What a student of a kind hands in, who draws with a pencil (as a Hand has it) and slips."""
    sigma = rng.uniform(*kind.sigma)
    slips = [str(rng.choice(kind.slips))] if honest and rng.random() < kind.share else []
    pencil = sigma, kind.turn * sigma, 0.13 if sigma > 0.1 else 0.0, kind.step
    for _ in range(20):
        try:
            found = draw(pencil, slips)
        except ValueError:
            slips = []
            continue
        return {field: written(field, value, kind.digits) for field, value in found.items()}
    raise ValueError("no drawing closes")


def honest_class(lab: str, kind: Kind, seed: int) -> dict[str, Row]:
    """The answers of a class, each of the own drawing."""
    rng = np.random.default_rng([seed, 2, *kind.name.encode()])
    takers = takers_of(kind.own, seed)
    book_of(lab).prepare(takers)
    return {taker.student.id: row(lab, taker, kind, rng) for taker in takers}


def marked(lab: str, kind: Kind, seed: int, answers: Mapping[str, Row]) -> Result:
    """A class with these answers, marked."""
    return graded_class(book_of(lab), takers_of(kind.own, seed), answers)


def named(result: Result) -> list[tuple[str, ...]]:
    """Who is named together in a report, the one whose answers fit another's data alone."""
    return [
        *((each.students[0],) for each in result.wrong_variants),
        *(each.students for each in result.copies),
    ]


# --- those who copy -----------------------------------------------------------------------------


def groups_of(fields: Sequence[str]) -> list[list[str]]:
    """The fields that are copied together: a segment, its value, its sense."""
    found: dict[str, list[str]] = {}
    for field in fields:
        name = field
        for end in ("_sense", "_mm", "_x", "_y"):
            name = name.removesuffix(end)
        found.setdefault(name, []).append(field)
    return list(found.values())


def whole(own: Row, other: Row, rng: np.random.Generator) -> tuple[Row, Row]:
    """All answers of another."""
    return dict(other), other


def half(own: Row, other: Row, rng: np.random.Generator) -> tuple[Row, Row]:
    """Every second quantity of another, all else drawn."""
    groups = groups_of(list(own))
    taken = rng.permutation(len(groups))[: (len(groups) + 1) // 2]
    fields = [field for i in taken for field in groups[int(i)]]
    return {**own, **{field: other[field] for field in fields}}, other


def unusual(count: int) -> Callable[[Row, Row, np.random.Generator], tuple[Row, Row]]:
    """Some wrong numbers that nobody else has, in both rows."""

    def shared(own: Row, other: Row, rng: np.random.Generator) -> tuple[Row, Row]:
        sizes = [field for field in own if not field.endswith(("_sense", "_x_mm", "_y_mm"))]
        wrong: Row = {}
        for field in rng.permutation(sizes)[:count].tolist():
            factor = float(np.exp(rng.choice([-1, 1]) * rng.uniform(0.3, 1.2)))
            wrong[field] = written(field, float(other[field].value or 0.0) * factor, 3)
        return {**own, **wrong}, {**other, **wrong}

    return shared


@dataclass(frozen=True)
class Copying:
    """A way to copy, and whether by two with the same data; ``redrawn``: another's data drawn."""

    name: str
    way: Callable[[Row, Row, np.random.Generator], tuple[Row, Row]] | None
    alike: bool = False


COPYING = (
    Copying("all of another's answers", whole),
    Copying("another's data, drawn again", None),
    Copying("half of another's answers", half),
    Copying("all, the same data", whole, alike=True),
    Copying("half, the same data", half, alike=True),
    Copying("one unusual wrong number, the same data", unusual(1), alike=True),
    Copying("three unusual wrong numbers, the same data", unusual(3), alike=True),
    Copying("six unusual wrong numbers, the same data", unusual(6), alike=True),
)


def copied_class(
    lab: str, kind: Kind, seed: int, copying: Copying, count: int = 12
) -> tuple[dict[str, Row], list[tuple[str, str]]]:
    """A class in which some copy, and who of whom: a different set of two each time."""
    answers = honest_class(lab, kind, seed)
    rng = np.random.default_rng([seed, 3, *copying.name.encode()])
    takers = list(takers_of(kind.own, seed))
    order = [takers[i] for i in rng.permutation(len(takers))]
    pairs: list[tuple[str, str]] = []
    used: set[str] = set()
    for one in order:
        for other in order if len(pairs) < count else ():
            ids = (one.student.id, other.student.id)
            fits = copying.alike == (one.settings == other.settings)
            if one is not other and fits and not used.intersection(ids):
                used.update(ids)
                pairs.append(ids)
                if copying.way is None:
                    answers[ids[0]] = row(lab, other, kind, rng, honest=False)
                else:
                    found = copying.way(answers[ids[0]], answers[ids[1]], rng)
                    answers[ids[0]], answers[ids[1]] = found
                break
    return answers, pairs


def is_found(result: Result, pair: tuple[str, str]) -> bool:
    """Whether a report names somebody who copied: with whom, or whose data the answers fit."""
    copier, source = pair
    fits = any(s.students[0] == copier and source in s.students for s in result.wrong_variants)
    return fits or any({copier, source} <= set(each.students) for each in result.copies)
