"""The verdicts of the marking beside those of the rules, over sets of answers of every kind."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from graphkin.classroom.grading.answer_numbers import read_answer
from graphkin.classroom.grading.marking import Marker
from tests.classroom.grading import hand
from tests.classroom.grading.independent import COSTS, MORE, Set, Task, sets
from tests.classroom.grading.students import marker_with, taker


@dataclass(frozen=True)
class Verdict:
    """What one field of a set was found to be, and what it earns by the rules."""

    kind: str
    where: str
    answer: str
    earns: float
    found: float
    reason: str

    @property
    def is_right(self) -> bool:
        """Whether the marking says the same."""
        return abs(self.earns - self.found) < 1e-9


def form(lab: str, n: int, half: bool = False) -> tuple[Marker, Task]:
    """A marker of a wider form of a lab, and what its student has; without ``half`` the points."""
    marker = marker_with(lab, MORE[lab], n)
    if half:
        rng = np.random.default_rng(n)
        none = [f for f in marker.standard.rubric.points if rng.random() < 0.5]
        marker = marker_with(lab, MORE[lab], n, points=dict.fromkeys(none, Fraction()))
    standard = marker.standard
    sheet = standard.scales.kL, standard.scales.kv, standard.scales.ka
    points = {field: float(standard.rubric.points.get(field, 0)) for field in standard.key}
    tolerance = {field: allowed.value for field, allowed in standard.tolerance.items()}
    return marker, Task(lab, hand.data(lab, n), sheet, points, tolerance)


def verdicts(lab: str, n: int, seed: int, half: bool = False) -> Iterator[Verdict]:
    """The verdicts of each field with points, over a set of each kind."""
    marker, task = form(lab, n, half)
    for kind, found in sets(task, 1000 * n + seed):
        yield from of_set(marker, task, kind, found, f"{lab} {n} {seed}")


def of_set(marker: Marker, task: Task, kind: str, found: Set, where: str) -> Iterator[Verdict]:
    """The verdicts of one set."""
    items = marker.standard.by_field
    answers = {field: read_answer(text, items[field].item) for field, text in found.texts.items()}
    graded = marker.mark(taker(), answers)
    for field, earns in found.earns.items():
        mark = graded.mark(field)
        if task.points[field]:
            share = float(mark.earned / mark.points)
            reason = f"{mark.status.value} {mark.source} {mark.cause}".strip()
            yield Verdict(kind, f"{where} {field}", found.texts[field], earns, share, reason)
    if found.cause:
        costs = {cause.name: float(cause.cost) for cause in graded.causes}
        most = COSTS[found.cause] * float(graded.points)
        paid = 0 < costs.get(found.cause, 0.0) <= most + 1e-9
        only = len(costs) == 1
        yield Verdict(kind, where, "", 1.0, float(paid and only), f"costs {costs} of {most}")
