"""Marks of students who share nothing with the marking, by the mistake that each class makes.

``python -m tests.bench.strangers [LAB …] [SEED]`` draws 24 students with each mistake.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from functools import lru_cache

import numpy as np

from graphkin.classroom.grading.answer_numbers import read_answer
from graphkin.classroom.grading.class_marking import graded_class
from graphkin.classroom.grading.graded import Graded
from tests.classroom.grading.strangers import CAUSES, LABS, hand_in
from tests.classroom.grading.students import book_of
from tests.classroom.grading.students import taker as student

STUDENTS = 24


def a_class(
    lab: str, made: str, seed: int, count: int = STUDENTS, sigma: float = 0.3
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
            row = hand_in(lab, number, scales, rng, made, other, sigma)
        except ValueError:
            continue
        answers[taker.student.id] = {
            item.field: read_answer(row.get(item.field, ""), item) for item in book.form
        }
    result = graded_class(book, takers, answers, as_it_is=True)
    return [each for each in result.graded if each.present]


@lru_cache
def honest(lab: str, seed: int) -> Mapping[str, float]:
    """What the same students lose without the mistake, by blank cells and blunders of their own."""
    found = a_class(lab, "", seed)
    return {graded.taker.student.id: float(100 - 100 * graded.share) for graded in found}


def told(lab: str, made: str, seed: int) -> str:
    """A row: the mean mark, the 5th and 95th percentile, and how often the mistake is named.

    What a student loses without the mistake as well is given back.
    """
    found = a_class(lab, made, seed)
    if not found:
        return f"{lab}: {made}: does not close"
    own = honest(lab, seed)
    marks = np.array([float(100 * g.share) + own[g.taker.student.id] for g in found])
    named = [{c.name for c in g.causes}.issubset(CAUSES[made]) and bool(g.causes) for g in found]
    low, high = np.percentile(marks, (5, 95))
    row = f"{f'{lab}: {made}':40} {len(found):4} {marks.mean():6.1f} {low:6.1f} {high:6.1f}"
    return f"{row} {100 * np.mean(named):6.1f}"


def main() -> None:
    """Print the table."""
    seeds = [int(each) for each in sys.argv[1:] if each.isdigit()] or [1]
    print(f"{'mistake':40} {'n':>4} {'mean':>6} {'5 %':>6} {'95 %':>6} {'named':>6}")
    for lab in [each for each in sys.argv[1:] if each in LABS] or LABS:
        for made in [each for each in sys.argv[1:] if each in CAUSES] or CAUSES:
            print(told(lab, made, seeds[0]), flush=True)
        every = a_class(lab, "", seeds[0], 4 * STUDENTS)
        marks = np.array([float(100 * graded.share) for graded in every])
        false = [c.name for g in every for c in g.causes]
        print(f"{lab}: honest {marks.mean():.1f}, named {false}", flush=True)


if __name__ == "__main__":
    main()
