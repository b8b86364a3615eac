"""A whole class judged at once against the same variants one after the other.

``python -m tests.bench.variants`` prints, for each shipped lab, the seconds in which 10 000
students get their data and the fairness of each is judged, and what a loop over single scenes takes
for it: the construction and the scales of each one's sheets, which would tell the same.
"""

from __future__ import annotations

import timeit
from fractions import Fraction

from msgspec.structs import replace

from graphkin.classroom.lab.lab_model import Lab, settings
from graphkin.classroom.lab.read_lab import read_lab
from graphkin.classroom.roster.students import Student
from graphkin.classroom.variants.assign import assigned
from graphkin.documents.scaling import scales
from graphkin.mechanism import load
from graphkin.scene import scene_files

STUDENTS = 10_000
LIMIT = 5.0
"""Seconds that they may take on two cores; the batch uses one."""
SINGLES = range(1, 31)


def students(count: int = STUDENTS) -> list[Student]:
    """A class of so many students, with the numbers from 1 to 30 over and over."""
    return [Student(i + 2, f"{i:05d}", 1 + i % 30) for i in range(count)]


def one_by_one(lab: Lab) -> float:
    """Seconds of the plain loop for a student, the median number's class of thirty."""

    def loop() -> None:
        for number in SINGLES:
            given: dict[str, Fraction] = settings(lab, Student(2, "x", number))
            mechanism = load(lab.scene, **given)
            chosen = scales(mechanism)
            mechanism.trace(mechanism.asked(), by_hand=True, seconds=chosen.seconds)

    return min(timeit.repeat(loop, number=1, repeat=3)) / len(SINGLES)


def table() -> str:
    """A row for each shipped lab."""
    lines = [f"{STUDENTS} students' data, judged (limit {LIMIT:g} s)", ""]
    everybody = students()
    for name in scene_files.names():
        if scene_files.folder(name) is None:
            continue
        lab = read_lab(name)
        lab = replace(lab, fair=replace(lab.fair, apart=None))  # ten thousand cannot lie apart
        whole = min(timeit.repeat(lambda lab=lab: assigned(lab, everybody), number=1, repeat=3))
        plain = one_by_one(lab) * STUDENTS
        words = f"{whole:6.2f} s, one by one {plain:6.1f} s, {plain / whole:5.0f} ×"
        lines.append(f"{name:24} {words}")
    return "\n".join(lines)


if __name__ == "__main__":
    print(table())
