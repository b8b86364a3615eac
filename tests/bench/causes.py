"""Marks of students with one mistake each: how they are spread, and how often it is named.

``python -m tests.bench.causes [PART …] [SEED]`` draws 24 students of each of three labs with
each mistake, by the formulas of ``tests.classroom.grading.mistaken``, and marks them as a class.
Then come pairs of mistakes, and honest and sloppy students without any.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from itertools import combinations

import numpy as np

from graphkin.classroom.grading.answer_numbers import read_answer
from graphkin.classroom.grading.class_marking import graded_class
from graphkin.classroom.grading.graded import Graded, Status
from tests.classroom.grading import hand, mistaken
from tests.classroom.grading.mistaken import CAREFUL, CAUSES, LABS, NAMED, SLOPPY, Pencil
from tests.classroom.grading.students import book_of
from tests.classroom.grading.students import taker as student

STUDENTS = 24
APART = 4
"""The least difference from the number of a fellow student whose data are drawn: those of a
neighbour hardly differ, which ``apart`` in a lab excludes."""
Way = tuple[str, ...]


def a_class(
    lab: str, ways: Sequence[Way], seed: int, pencil: Pencil = CAREFUL, count: int = STUDENTS
) -> list[tuple[Graded, Way]]:
    """The marks of a class in which each makes the first of some mistakes that changes anything.

    Of two mistakes, each must change something beside the other.
    """
    book, rng = book_of(lab), np.random.default_rng(seed)
    takers = [student(3 + i % 28, f"s{i:04d}") for i in range(max(count, STUDENTS))]
    book.prepare(takers)
    answers, made = {}, {}
    numbers, others = range(3, 3 + STUDENTS), np.random.default_rng([seed, 5])
    for taker in takers[:count]:
        standard = book.marker(taker.settings).standard
        paper = standard.paper
        sheet = (paper.mechanism, paper.velocities, paper.accelerations)
        number = int(taker.settings["n"])
        far = [each for each in numbers if abs(each - number) >= APART]
        other = (hand.data(lab, int(others.choice(far))), 0.0)
        for way in ways or ((),):
            fewer = [tuple(each for each in way if each != left) for left in way] or [()]
            wrong, *others_told = (
                drawn(lab, number, sheet, np.random.default_rng(1), mistakes, other)
                for mistakes in (way, *fewer)
            )
            if wrong is None or (way and wrong in others_told):
                continue
            row = drawn(lab, number, sheet, rng, way, other, pencil)
            if row is not None:
                answers[taker.student.id] = {
                    item.field: read_answer(row[item.field], item) for item in standard.items
                }
                made[taker.student.id] = way
                break
    result = graded_class(book, takers, answers, as_it_is=True)
    return [(g, made[i]) for g in result.graded if (i := g.taker.student.id) in made]


def drawn(
    lab: str,
    number: int,
    sheet: mistaken.Sheet,
    rng: np.random.Generator,
    way: Way,
    other: tuple[hand.Data, float],
    pencil: Pencil = CAREFUL,
) -> dict[str, str] | None:
    """What a student hands in; None where the drawing does not close."""
    try:
        return mistaken.handed_in(lab, hand.data(lab, number), sheet, rng, pencil, way, other=other)
    except ValueError:
        return None


def is_named(graded: Graded, way: Way) -> bool:
    """Whether just these mistakes are named, each perhaps with one that gives the same answers."""
    wanted = {NAMED[name] for name in way}
    named = [{cause.name, cause.either} for cause in graded.causes]
    return len(named) == len(wanted) and all(each & wanted for each in named)


def told(name: str, found: Sequence[tuple[Graded, Way]]) -> str:
    """A row: the mean mark, the 5th and 95th percentile, and how often the mistake is named."""
    marks = np.array([float(100 * graded.share) for graded, _ in found])
    named = np.mean([is_named(*each) for each in found])
    low, high = np.percentile(marks, (5, 95))
    return f"{name:52} {len(found):4} {marks.mean():6.1f} {low:6.1f} {high:6.1f} {100 * named:6.1f}"


def rows(seed: int) -> Iterator[str]:
    """The rows of the table."""
    yield f"{'mistake':52} {'n':>4} {'mean':>6} {'5 %':>6} {'95 %':>6} {'named':>6}"
    for lab in LABS:
        for name, ways in CAUSES.items():
            found = a_class(lab, ways, seed)
            yield told(f"{lab}: {name}", found) if found else f"{lab}: {name}: changes nothing"


def pair_rows(seed: int) -> Iterator[str]:
    """How often pairs of mistakes are both named."""
    for lab in LABS:
        named, count = 0, 0
        for first, second in combinations(CAUSES.values(), 2):
            found = a_class(lab, [a + b for a in first for b in second], seed + 2, count=2)
            named += sum(is_named(*each) for each in found)
            count += len(found)
        yield f"{lab}: pairs named {named} of {count}"


def honest_rows(seed: int, count: int = 334) -> Iterator[str]:
    """Honest and sloppy students: right answers, and false names."""
    for kind, pencil in (("careful", CAREFUL), ("sloppy", SLOPPY)):
        right = every = false = 0
        for lab in LABS:
            for graded, _ in a_class(lab, [()], seed + 6, pencil, count):
                marks = [m for m in graded.marks if m.points]
                right += sum(m.status is Status.RIGHT for m in marks)
                every += len(marks)
                false += bool(graded.causes)
        yield f"{kind}: {100 * right / every:.2f} % right, {false} of {3 * count} named"


def main() -> None:
    """Print the table."""
    parts = {"causes": rows, "pairs": pair_rows, "honest": honest_rows}
    seeds = [int(each) for each in sys.argv[1:] if each.isdigit()] or [1]
    for name in [each for each in sys.argv[1:] if each in parts] or parts:
        for line in parts[name](seeds[0]):
            print(line, flush=True)


if __name__ == "__main__":
    main()
