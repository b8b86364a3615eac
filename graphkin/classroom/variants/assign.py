"""Who gets which data: a formula as it is, a range drawn again until it is fair."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from itertools import groupby

from msgspec import Struct
from msgspec.structs import replace

from graphkin.classroom.grading.neighbours import (
    RightValues,
    pencil_fault,
    standards_of,
    without_doubles,
)
from graphkin.classroom.grading.standard import Standard
from graphkin.classroom.lab.fairness import Fairness, Fault, judged
from graphkin.classroom.lab.lab_model import Lab
from graphkin.classroom.lab.rules import Settings, settings
from graphkin.classroom.roster.read_roster import Check
from graphkin.classroom.roster.student import Student
from graphkin.numbers.arithmetic import np
from graphkin.scene.parameters import misfit, range_words
from graphkin.scene.quantity import shortest
from graphkin.text.errors import Problem, RosterError, problems_of

VAIN = 300
"""Draws on end that find room for nobody, after which nobody is drawn again."""
BLOCK = 256
"""Students whose data are held against those before them at once."""
MOST = 5_000
"""Students of a list whose data are all held against one another."""


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

    What ranges give that is unfair, or too near to the data of one before in the list, is drawn
    again, as often as the rule allows; the least unfair is kept.
    Raises RosterError for numbers with which a formula leaves what the scene allows, and for more
    students than can be held against one another where a limit asks for that.
    """
    if lab.fair.needs_keys and len(students) > MOST:
        found = f"has {len(students)} students, and [fair] of lab.toml limits apart or pencil"
        hint = "split the list, or take those limits out"
        raise RosterError(Problem(roster, found, f"at most {MOST}", hint))
    if lab.rule.counts:
        refuse_misfits(lab, students, roster)
    every = fairest(lab, students)
    return spaced(lab, every) if lab.fair.needs_keys else every


def spaced(lab: Lab, every: list[Assigned]) -> list[Assigned]:
    """The same, where a pencil draws everything as exactly as it should, and nobody's right values
    earn too much on the sheet of one before in the list.

    By ranges what is not so is drawn again, until many draws find room for nobody; what is left
    has its fault.
    """
    kept: list[tuple[Assigned, Standard]] = []
    known: dict[object, Standard] = {}
    vain = 0
    found, waiting = [*every], [i for i, each in enumerate(every) if each.fair]
    while waiting:
        tried = [found[i] for i in waiting]
        names = [(*each.settings.items(), each.computed) for each in tried]
        new = {name: each for name, each in zip(names, tried, strict=True) if name not in known}
        known |= zip(new, held_against(lab, list(new.values())), strict=True)
        held = [known[name] for name in names]
        room = with_room(lab, kept, list(zip(tried, held, strict=True)))
        near = {i: fault for i, fault in zip(waiting, room, strict=True) if fault is not None}
        again = [i for i in near if found[i].attempt + 1 < lab.rule.attempts]
        vain = vain + len(waiting) if len(near) == len(waiting) else longest(room)
        if not again or vain >= VAIN:
            for i, fault in near.items():
                found[i] = replace(found[i], faults=(fault,))
            break
        since = [found[i].attempt + 1 for i in again]
        redrawn = fairest(lab, [found[i].student for i in again], since)
        waiting = []
        for i, each in zip(again, redrawn, strict=True):
            found[i] = each if each.fair else replace(found[i], faults=(near[i],))
            waiting += [i] if each.fair else []
        for i in near.keys() - {*again}:
            found[i] = replace(found[i], faults=(near[i],))
    return found


def longest(room: Sequence[Fault | None]) -> int:
    """How many in a row found no room, where these are so many that nobody is drawn again."""
    runs = (sum(1 for _ in run) for full, run in groupby(room, bool) if full)
    most = max(runs, default=0)
    return most if most >= VAIN else 0


def with_room(
    lab: Lab, kept: list[tuple[Assigned, Standard]], tried: Sequence[tuple[Assigned, Standard]]
) -> list[Fault | None]:
    """For each of some data what is too inexact or too near to others; what is not is kept."""
    limit, found = lab.fair.apart, list[Fault | None]()
    data, places = without_doubles([standard for _, standard in (*kept, *tried)])
    values, taken = RightValues.of(data), places[: len(kept)]
    for start in range(0, len(tried), BLOCK):
        block = tried[start : start + BLOCK]
        own = places[len(places) - len(tried) + start :][: len(block)]
        near = Nearness(values, own, [*taken, *own]) if limit is not None else None
        for place, each in zip(own, block, strict=True):
            nearest, share = near.nearest(place, taken) if near is not None else (-1, 0.0)
            if (coarse := pencil_fault(lab, each[1])) is not None:
                found.append(coarse)
            elif limit is not None and share > limit:
                found.append(Fault("apart", kept[nearest][0].student.id, share, limit))
            else:
                taken.append(place)
                kept.append(each)
                found.append(None)
    return found


class Nearness:
    """What the right values of some data and of others earn on each other's sheet, at most."""

    def __init__(self, values: RightValues, own: Sequence[int], others: Sequence[int]) -> None:
        rows, columns = list(dict.fromkeys(own)), list(dict.fromkeys(others))
        self.row = {place: row for row, place in enumerate(rows)}
        self.column = {place: column for column, place in enumerate(columns)}
        here, there = values.rows(rows), values.rows(columns)
        self.shares = np.maximum(here.by_key(there), there.by_key(here).T)

    def nearest(self, place: int, among: Sequence[int]) -> tuple[int, float]:
        """Which of some is nearest to a datum, the first of several, and what is earned there."""
        if not among:
            return -1, 0.0
        shares = self.shares[self.row[place], [self.column[other] for other in among]]
        found = int(np.argmax(shares))
        return found, float(shares[found])


def held_against(lab: Lab, every: Sequence[Assigned]) -> list[Standard]:
    """What the answers of students who can draw are held against."""
    asked = [(each.settings, each.computed) for each in every]
    return standards_of(lab, asked) if asked else []


def refuse_misfits(lab: Lab, students: Sequence[Student], roster: str) -> None:
    """RosterError with the row of each number to which a formula gives what no scene allows."""
    problems = [
        Problem(f"{roster}, row {student.row}", p.found, p.expected, p.hint)
        for student in students
        for p in misfits(lab, student)
    ]
    if problems:
        raise RosterError(problems)


def check_of(lab: Lab) -> Check | None:
    """What finds students whose number gives no data that the scene allows; none for ranges."""
    return partial(misfits, lab) if lab.rule.counts else None


def misfits(lab: Lab, student: Student) -> list[Problem]:
    """What is wrong with the data that a formula gives a student: none, or what no scene allows."""
    try:
        given = settings(lab, student)
    except Exception as error:
        return list(problems_of(error))
    parameters, gives = lab.mechanism.scene.parameters, f"number {student.number} gives"
    return [
        Problem("", f"{gives} {name} = {shortest(value)}, which is {wrong}", range_words(each))
        for name, value in given.items()
        if (wrong := misfit(each := parameters[name], value))
    ]


def fairest(lab: Lab, students: Sequence[Student], since: Sequence[int] = ()) -> list[Assigned]:
    """The first fair data that the rule gives each student, else the least unfair of all tried.

    ``since`` are the attempts with which each begins, the first where it is left out.
    """
    found: dict[int, Assigned] = {}
    attempts = list(since) or [0] * len(students)
    waiting = list(range(len(students)))
    while waiting:
        many = [settings(lab, students[i], attempts[i]) for i in waiting]
        fairness = judged(lab, many)
        for place, i in enumerate(waiting):
            drawn = one(students[i], many[place], attempts[i], fairness, place)
            found[i] = min(found.get(i, drawn), drawn, key=unfairness)
            attempts[i] += 1
        waiting = [i for i in waiting if not found[i].fair and attempts[i] < lab.rule.attempts]
    return [found[i] for i in range(len(students))]


def unfairness(data: Assigned) -> tuple[bool, int]:
    """By what data are less unfair than others: those that can be drawn, of the fewest faults."""
    return data.flattest is None, len(data.faults)


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
