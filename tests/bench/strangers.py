"""Marks of students who share nothing with the marking, by the mistake that each class makes.

``python -m tests.bench.strangers [LAB …] [MISTAKE …] [KIND …] [SEED] [pairs]`` draws 24 students
with each mistake. The kinds of classes differ in how they draw, read and write.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from itertools import combinations

import numpy as np

from graphkin.classroom.grading.answer_numbers import read_answer
from graphkin.classroom.grading.class_marking import graded_class
from graphkin.classroom.grading.graded import Graded
from tests.classroom.grading.strangers import CAUSES, KINDS, LABS, ONLY, USUAL, Habits, hand_in
from tests.classroom.grading.students import book_of
from tests.classroom.grading.students import taker as student

STUDENTS = 24
IN_PAIRS = 4
"""Students with each pair of mistakes."""


def a_class(
    lab: str, made: str, seed: int, count: int = STUDENTS, habits: Habits = USUAL
) -> list[Graded]:
    """The marks of those of a class whose drawings close."""
    book = book_of(lab)
    takers = [student(3 + i % STUDENTS, f"s{i:04d}") for i in range(max(count, STUDENTS))]
    book.prepare(takers)
    answers = {}
    for taker in takers[:count]:
        paper = book.marker(taker.settings).standard.paper
        number = int(taker.settings["n"])
        rng = np.random.default_rng([seed, *taker.student.id.encode()])
        other = 3 + (number - 3 + 5 + int(rng.integers(14))) % STUDENTS
        scales = (paper.mechanism, paper.velocities, paper.accelerations)
        try:
            row = hand_in(lab, number, scales, rng, made, other, habits)
            again = np.random.default_rng([seed, *taker.student.id.encode()])
            again.integers(14)
            if made and row == hand_in(lab, number, scales, again, "", other, habits):
                continue  # every cell that would show the mistake is blank
        except ValueError:
            continue
        answers[taker.student.id] = {
            item.field: read_answer(row.get(item.field, ""), item) for item in book.form
        }
    result = graded_class(book, takers, answers, as_it_is=True)
    return [each for each in result.graded if each.present]


@lru_cache
def honest(lab: str, seed: int, habits: Habits) -> Mapping[str, float]:
    """What the same students lose without the mistake, by blank cells and blunders of their own."""
    found = a_class(lab, "", seed, habits=habits)
    return {graded.taker.student.id: float(100 - 100 * graded.share) for graded in found}


def is_named(graded: Graded, made: str) -> bool:
    """Whether just the mistakes that were made are named, each perhaps with one just like it."""
    named = [{cause.name, cause.either} for cause in graded.causes]
    ways = [{*CAUSES[each]} for each in made.split("+")]
    return all(any(each & way for way in ways) for each in named) and all(
        any(each & way for each in named) for way in ways
    )


def told(lab: str, made: str, seed: int, habits: Habits) -> str:
    """A row: the mean mark, the 5th and 95th percentile, and how often the mistake is named.

    What a student loses without the mistake as well is given back.
    """
    found = a_class(lab, made, seed, habits=habits)
    if not found:
        return f"{lab}: {made}: does not close"
    own = honest(lab, seed, habits)
    marks = np.array([float(100 * g.share) + own[g.taker.student.id] for g in found])
    named = [is_named(g, made) for g in found]
    low, high = np.percentile(marks, (5, 95))
    row = f"{f'{lab}: {made}':40} {len(found):4} {marks.mean():6.1f} {low:6.1f} {high:6.1f}"
    others = sorted({"+".join(c.name for c in g.causes) for g in found if not is_named(g, made)})
    return f"{row} {100 * np.mean(named):6.1f}  {', '.join(each or 'none' for each in others)}"


def possible(lab: str) -> list[str]:
    """The mistakes that can be made in a lab."""
    return [made for made in CAUSES if lab in ONLY.get(made, LABS)]


def singles(lab: str, mistakes: Sequence[str], seed: int, habits: Habits) -> Iterator[str]:
    """The row of each mistake, and of the honest."""
    for made in mistakes:
        yield told(lab, made, seed, habits)
    every = a_class(lab, "", seed, 4 * STUDENTS, habits)
    marks = np.array([float(100 * graded.share) for graded in every])
    false = [c.name for g in every for c in g.causes]
    yield f"{lab}: honest {marks.mean():.1f}, named {false}"


def pairs(lab: str, mistakes: Sequence[str], seed: int, habits: Habits) -> Iterator[str]:
    """How often pairs of mistakes are both named, and where hardly ever."""
    named = count = 0
    for one, other in combinations(mistakes, 2):
        if {*CAUSES[one]} & {*CAUSES[other]}:
            continue
        found = a_class(lab, f"{one}+{other}", seed, IN_PAIRS, habits)
        hits = sum(is_named(g, f"{one}+{other}") for g in found)
        named, count = named + hits, count + len(found)
        if 2 * hits < len(found):
            names = ", ".join("+".join(c.name for c in g.causes) or "none" for g in found)
            yield f"{lab}: {one} + {other}: {hits} of {len(found)}: {names}"
    yield f"{lab}: pairs named {named} of {count}: {100 * named / count:.1f} %"


def main() -> None:
    """Print the table."""
    given = sys.argv[1:]
    seed = next((int(each) for each in given if each.isdigit()), 1)
    rows = pairs if "pairs" in given else singles
    if rows is singles:
        print(f"{'mistake':40} {'n':>4} {'mean':>6} {'5 %':>6} {'95 %':>6} {'named':>6}")
    for kind in [each for each in KINDS if each in given] or ["usual"]:
        print(kind)
        for lab in [each for each in given if each in LABS] or LABS:
            mistakes = [each for each in possible(lab) if each in given] or possible(lab)
            for line in rows(lab, mistakes, seed, KINDS[kind]):
                print(line, flush=True)


if __name__ == "__main__":
    main()
