"""Ten thousand answer rows: thirty variants, and each its own; beside a loop that keeps nothing.

``python -m tests.bench.grading`` prints seconds for 10 000 rows, and the most memory that it took;
the loop is measured on fewer. A third of the students have five fields wrong.
"""

from __future__ import annotations

import random
import time
from collections.abc import Callable
from fractions import Fraction
from resource import RUSAGE_SELF, getrusage

from msgspec.structs import replace

from graphkin.classroom.grading.class_marking import KEPT, Book, graded_class
from graphkin.classroom.grading.graded import Answer
from graphkin.classroom.lab.lab_model import exact_text
from graphkin.classroom.lab.read_lab import read_lab
from graphkin.classroom.roster.students import Student, Taker

ROWS, ALONE = 10_000, 100
"""Rows of a class, and how many of them are marked one by one."""
LIMIT = 60.0
WRONG = 5


def pump(step: bool = True) -> Book:
    """What marks the pump; without its step, any number between gives a variant of its own."""
    lab = read_lab("pump")
    text = lab.scene.read_text(encoding="utf-8")
    return Book(lab, text if step else text.replace(", step = 1 ", " "))


def a_class(
    book: Book, numbers: list[Fraction]
) -> tuple[list[Taker], dict[str, dict[str, Answer]]]:
    """Students with these numbers, and their answers."""
    takers = [
        Taker(Student(i, f"s{i:05d}"), {"n": exact_text(number)})
        for i, number in enumerate(numbers)
    ]
    plain = replace(book, markers={})
    each = list({taker.settings["n"]: taker for taker in takers}.values())
    keys = {}
    for start in range(0, len(each), KEPT):
        part = each[start : start + KEPT]
        plain.prepare(part)
        keys |= {t.settings["n"]: plain.marker(t.settings).standard.key for t in part}
    answers = {}
    for i, taker in enumerate(takers):
        key = keys[taker.settings["n"]]
        chance = random.Random(i)
        wrong = chance.sample(sorted(key), WRONG) if i % 3 == 0 else []
        answers[taker.student.id] = {
            f: Answer("x", v * (chance.uniform(0.3, 2) if f in wrong else 1))
            for f, v in key.items()
        }
    return takers, answers


def timed(work: Callable[[], object]) -> float:
    """Seconds of one call."""
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def rows() -> list[tuple[str, float]]:
    """Each row: what is marked, and the seconds for ten thousand."""
    shared = a_class(pump(), [Fraction(1 + i % 30) for i in range(ROWS)])
    own = a_class(pump(False), [1 + Fraction(29 * i, ROWS) for i in range(ROWS)])
    single = [(each, shared[1]) for each in shared[0][:ALONE]]
    return [
        ("thirty variants", timed(lambda: graded_class(pump(), *shared))),
        *(
            (
                f"each its own variant, {jobs} process{'es' * (jobs > 1)}",
                timed(lambda jobs=jobs: graded_class(pump(False), *own, jobs=jobs)),
            )
            for jobs in (1, 2)
        ),
        (
            f"a loop over single students ({ALONE} measured)",
            ROWS / ALONE * timed(lambda: [graded_class(pump(), [t], a) for t, a in single]),
        ),
    ]


def main() -> None:
    """Print all rows, with the ratio to the loop."""
    found = rows()
    loop, memory = found[-1][1], getrusage(RUSAGE_SELF).ru_maxrss / 1024
    print(f"{ROWS} answer rows of the pump, limit {LIMIT:g} s")
    for name, seconds in found:
        print(f"{name:55} {seconds:8.1f} s {seconds / loop:8.3f} × the loop")
    print(f"memory of this process, both classes included: {memory:.0f} MB at most")


if __name__ == "__main__":
    main()
