"""Labs of one's own, with the formulas of a hand for each: no lab of ours, drawn small, at 1:5.

``python -m tests.classroom.grading.own_labs [CLASSES]`` prints, for ten classes of 120 of each
kind, how many fields of honest drawings are not found right, and how many are named; of careful
hands for labs of ours, too.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from functools import lru_cache
from itertools import product

import numpy as np

from graphkin.classroom.grading.class_marking import Book, graded_class
from graphkin.classroom.grading.graded import Result, Status
from graphkin.classroom.lab.lab_model import Lab, exact_text
from graphkin.classroom.lab.read_lab import read_lab
from graphkin.classroom.roster.students import Student, Taker
from graphkin.classroom.variants.assign import assigned
from tests.classroom.grading import classes, hand
from tests.classroom.grading.classes import HONEST, Kind, Row, drawn_row, named
from tests.scene_files import FOLDER


def quick_return(drawing: hand.Hand, p: Mapping[str, float]) -> None:
    """The lab of a slotted lever whose every length is drawn."""
    given = hand.Data(p["phi"], p["n"])
    hand.quick_return(drawing, given, p["r"], p["a"], p["L"], p["s"], p["h"])


def six_bar(drawing: hand.Hand, p: Mapping[str, float]) -> None:
    """The lab of a Stephenson chain, ranges as ``graphkin ranges`` proposed them."""
    hand.six_bar(drawing, hand.Data(p["phi"], p["n"]), p["r"], p["p"], p["q"])


DRAW: dict[str, Callable[[hand.Hand, Mapping[str, float]], None]] = {
    "quick-return": quick_return,
    "six-bar": six_bar,
}


@lru_cache
def lab_of(name: str) -> Lab:
    """A lab of one's own."""
    return read_lab(FOLDER / "classroom" / "labs" / name)


@lru_cache
def book_of(name: str) -> Book:
    """What marks it."""
    return Book(lab_of(name), lab_of(name).scene.read_text(encoding="utf-8"))


@lru_cache
def takers_of(name: str, count: int) -> tuple[Taker, ...]:
    """A class with the data that the lab's rule draws for it."""
    students = [Student(i, f"s{i:03d}", i) for i in range(1, count + 1)]
    found = assigned(lab_of(name), students)
    assert all(each.fair for each in found)
    return tuple(
        Taker(each.student, {key: exact_text(value) for key, value in each.settings.items()})
        for each in found
    )


def drawn(
    name: str,
    taker: Taker,
    rng: np.random.Generator | None = None,
    pencil: Sequence[float] = (),
    slips: Collection[str] = (),
) -> dict[str, float]:
    """The fields with points as they are read off a drawing of a student's data."""
    scales = book_of(name).marker(taker.settings).standard.scales
    drawing = hand.Hand(scales.kL, scales.kv, scales.ka, rng, *pencil, slips=frozenset(slips))
    DRAW[name](drawing, {key: float(value) for key, value in taker.settings.items()})
    return {field: drawing.found[field] for field in lab_of(name).rubric.points}


def row(name: str, taker: Taker, kind: Kind, rng: np.random.Generator) -> Row:
    """What a student hands in who draws the own data."""
    return drawn_row(lambda *how: drawn(name, taker, rng, *how), kind, rng)


def honest_class(name: str, kind: Kind, seed: int, count: int = 120) -> dict[str, Row]:
    """The answers of a class, each of the own drawing."""
    rng = np.random.default_rng([seed, 2, *kind.name.encode()])
    takers = takers_of(name, count)
    book_of(name).prepare(takers)
    return {taker.student.id: row(name, taker, kind, rng) for taker in takers}


def marked(name: str, answers: Mapping[str, Row]) -> Result:
    """A class with these answers, marked."""
    return graded_class(book_of(name), takers_of(name, len(answers)), answers)


def not_right(result: Result) -> list[str]:
    """The fields of all that are not found right."""
    marks = (mark for each in result.graded for mark in each.marks if mark.points)
    return [
        f"{mark.item.field}: {mark.status.value} {mark.cause}".strip()
        for mark in marks
        if mark.status is not Status.RIGHT
    ]


def told(name: str, kind: Kind, results: Iterable[Result]) -> str:
    """How many fields of some honest classes are not found right, and how many are named."""
    missed = named_ones = fields = 0
    for result in results:
        missed += len(not_right(result))
        named_ones += len(named(result))
        fields += sum(mark.points > 0 for each in result.graded for mark in each.marks)
    share = f"not right {100 * missed / fields:5.2f} % of {fields}"
    return f"{name:20} {kind.name:30} {share}, named {named_ones}"


def main() -> None:
    """Print what becomes of honest classes."""
    careful, seeds = HONEST[0], range(int(sys.argv[1]) if len(sys.argv) > 1 else 10)
    for lab in classes.LABS:
        own = ((seed, classes.honest_class(lab, careful, seed)) for seed in seeds)
        print(told(lab, careful, (classes.marked(lab, careful, *each) for each in own)), flush=True)
    for name, kind in product(DRAW, HONEST):
        rows = (honest_class(name, kind, seed) for seed in seeds)
        print(told(name, kind, (marked(name, each) for each in rows)), flush=True)


if __name__ == "__main__":
    main()
