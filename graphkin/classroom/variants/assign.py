"""Who gets which data: a formula as it is, a range drawn again until it is fair."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from msgspec import Struct

from graphkin.classroom.lab.fairness import Fairness, Fault, judged
from graphkin.classroom.lab.lab_model import Formula, Lab, Ranges
from graphkin.classroom.lab.rules import Settings, outside, settings
from graphkin.classroom.roster.read_roster import Check
from graphkin.classroom.roster.roster_errors import RosterError
from graphkin.classroom.roster.student import Student
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_scene
from graphkin.text.errors import Problem, SceneError


class Assigned(Struct, frozen=True):
    """The data of one student, and how fair they are.

    ``attempt`` counts the drawings before this one; ``faults`` are the limits that are not kept,
    ``computed`` the fields that are computed for want of something to measure. ``flattest`` and
    ``rays``, those to centres and poles, are in degrees, ``shortest`` in mm; None where nothing of
    the kind can be drawn.
    """

    student: Student
    settings: Settings
    attempt: int = 0
    faults: tuple[Fault, ...] = ()
    computed: tuple[str, ...] = ()
    flattest: float | None = None
    shortest: float | None = None
    rays: float | None = None

    @property
    def fair(self) -> bool:
        """Whether all limits are kept."""
        return not self.faults

    @property
    def status(self) -> str:
        """``fair``, ``unfair``, or ``undrawable`` where it does not close or fit its page."""
        if self.fair:
            return "fair"
        return "unfair" if self.flattest is not None else "undrawable"


def assigned(lab: Lab, students: Sequence[Student], roster: str = "roster") -> list[Assigned]:
    """The data of each student by the lab's rule, the whole class judged as one batch.

    What ranges give that is unfair is drawn again, as often as the rule allows; the last is kept.
    Raises RosterError for numbers with which a formula leaves what the scene allows.
    """
    mechanism = Mechanism(read_scene(lab.scene))
    if isinstance(lab.rule, Formula):
        many = by_formula(lab, students, mechanism, roster)
        found = judged(mechanism, lab, many)
        return [one(student, many[i], 0, found, i) for i, student in enumerate(students)]
    return by_ranges(lab, students, mechanism, lab.rule)


def by_formula(
    lab: Lab, students: Sequence[Student], mechanism: Mechanism, roster: str
) -> list[Settings]:
    """The data that a formula gives; RosterError with the row of each number it does not suit."""
    problems = [
        Problem(f"{roster}, row {student.row}", p.found, p.expected, p.hint)
        for student in students
        for p in misfits(lab, mechanism, student)
    ]
    if problems:
        raise RosterError(problems)
    return [settings(lab, student) for student in students]


def check_of(lab: Lab) -> Check | None:
    """What finds students whose number gives no data that the scene allows; none for ranges."""
    if not isinstance(lab.rule, Formula):
        return None
    return partial(misfits, lab, Mechanism(read_scene(lab.scene)))


def misfits(lab: Lab, mechanism: Mechanism, student: Student) -> list[Problem]:
    """What is wrong with the data that a formula gives a student: none, or what no scene allows."""
    try:
        given = settings(lab, student)
    except SceneError as error:
        return list(error.problems)
    return [
        Problem("", f"number {student.number} gives {problem.found}", problem.expected)
        for problem in outside(mechanism.scene.parameters, given)
    ]


def by_ranges(
    lab: Lab, students: Sequence[Student], mechanism: Mechanism, rule: Ranges
) -> list[Assigned]:
    """The first fair data that are drawn for each student, else the last that were tried."""
    found: dict[int, Assigned] = {}
    waiting = list(range(len(students)))
    for attempt in range(rule.tries):
        many = [settings(lab, students[i], attempt) for i in waiting]
        fairness = judged(mechanism, lab, many)
        for place, i in enumerate(waiting):
            found[i] = one(students[i], many[place], attempt, fairness, place)
        waiting = [i for i in waiting if not found[i].fair]
        if not waiting:
            break
    return [found[i] for i in range(len(students))]


def one(
    student: Student, given: Settings, attempt: int, fairness: Fairness, index: int
) -> Assigned:
    """The data of one student with what the batch says of them."""
    drawn = bool(fairness.closes[index] and fairness.fits[index])
    shortest, rays = float(fairness.shortest[index]), float(fairness.flattest_rays[index])
    return Assigned(
        student,
        given,
        attempt,
        fairness.faults(index),
        fairness.computed(index),
        float(fairness.flattest[index]) if drawn else None,
        shortest if drawn and shortest != float("inf") else None,
        rays if drawn and rays != float("inf") else None,
    )
