"""Tries a lab on a thousand variants: how many are fair, what spoils the others, the spread."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from msgspec import Struct

from graphkin.classroom.grading.neighbours import Neighbours, compared, pencil_faults
from graphkin.classroom.lab.fairness import Fairness, Fault, judged
from graphkin.classroom.lab.items import asked_fields, items
from graphkin.classroom.lab.lab_model import Lab, Settings, outside, settings, sheets
from graphkin.classroom.roster.students import Student
from graphkin.classroom.variants.assign import Assigned, assigned, held_against
from graphkin.numbers.arithmetic import np
from graphkin.text.errors import Problem, SceneError, message

TRIED = 1000
"""The number of variants tried."""
CLASS = 60
"""The number of students in the class whose variants are compared with one another."""
PENCILLED = 300
"""The most fair variants on which the accuracy of a pencil is tried, where a lab limits it."""
SHARES = (0.0, 0.25, 0.5, 0.75, 1.0)
"""The quantiles that describe a spread."""


class LabTrial(Struct, frozen=True):
    """The variants on which a lab was tried, their data, and how fair they are.

    ``names`` are numbers of students, or ids. ``unasked`` are fields of the rubric that no sheet
    draws; ``unmarked`` are fields that are asked and earn nothing.

    ``compared`` are the students of one class whose variants can be drawn, with the data that the
    class would get. ``neighbours`` compares these variants. ``coarse`` maps names to faults, for
    those of the first ``pencilled`` fair variants that a pencil draws less accurately than the lab
    allows. ``symbols`` are the markup of fields with their units.
    """

    lab: Lab
    names: tuple[str, ...]
    many: tuple[Settings, ...]
    fairness: Fairness
    unasked: tuple[str, ...] = ()
    unmarked: tuple[str, ...] = ()
    compared: tuple[Assigned, ...] = ()
    neighbours: Neighbours | None = None
    pencilled: int = 0
    coarse: Mapping[str, Fault] = {}
    symbols: Mapping[str, str] = {}

    @property
    def unfair(self) -> int:
        """How many variants break a limit that needs no keys."""
        return int((~self.fairness.fair).sum())

    @property
    def spoiled_share(self) -> float:
        """The share of variants that break a limit, including the pencil's."""
        fair = 1 - self.unfair / len(self.many)
        return 1 - fair * (1 - len(self.coarse) / self.pencilled) if self.pencilled else 1 - fair

    @property
    def by_keys(self) -> list[tuple[str, Fault]]:
        """The students of the class who break a limit that needs keys, after repeated draws."""
        return [
            (each.student.id, fault)
            for each in self.compared
            for fault in each.faults
            if fault.limit in ("apart", "pencil")
        ]

    def faults(self) -> list[tuple[str, Sequence[Fault]]]:
        """Each variant with the limits that it breaks, including those that need keys."""
        key_faults = [(name, fault) for name, fault in self.by_keys if name not in self.coarse]
        every = [(name, self.fairness.faults(i)) for i, name in enumerate(self.names)]
        return [*every, *((name, (fault,)) for name, fault in (*self.coarse.items(), *key_faults))]

    @property
    def spoilt(self) -> bool:
        """Whether students would get unfair data.

        A formula must be fair to all; ranges are unfair where every draw is. In both cases, no
        field may be missing on the sheets, and no limit that needs keys may be broken.
        """
        by_formula = not self.lab.rule.is_drawn
        unfair = bool(self.unfair or self.coarse) if by_formula else self.unfair == len(self.many)
        return bool(self.unasked or self.by_keys) or unfair

    @property
    def different(self) -> int:
        """How many of the variants differ."""
        return len({tuple(sorted(given.items())) for given in self.many})


def tried(lab: Lab, count: int = TRIED) -> LabTrial:
    """A lab tried on the numbers from 1 that its scene allows, or on as many drawn variants.

    Raises SceneError where the formula gives no allowed data for number 1.
    """
    students = students_of(lab, count)
    every_sheet = [each for student in students for each in sheets(lab.rule, student)]
    names = tuple(each.id for each in every_sheet)
    many = tuple(settings(lab, each) for each in every_sheet)
    fairness = judged(lab, many)
    form = items(lab.mechanism, lab)
    drawn = {*fairness.lengths, *fairness.rays, *fairness.on_page}
    unasked = [item.field for item in form if item.what == "segment" and item.field not in drawn]
    unmarked = [name for name in asked_fields(lab.mechanism) if name not in lab.rubric.points]
    sound = bool(fairness.fits.any())
    every = assigned(lab, students[:CLASS])
    pencilled, coarse = drawn_coarsely(lab, names, many, fairness)
    drawn_at_all = [each for each in every if each.flattest is not None]
    return LabTrial(
        lab,
        names,
        many,
        fairness,
        tuple(unasked if sound else ()),
        tuple(unmarked),
        tuple(drawn_at_all),
        compared(held_against(lab, drawn_at_all)),
        pencilled,
        coarse,
        {item.field: f"{item.symbol}, {item.unit.replace('²', '^2')}" for item in form},
    )


def drawn_coarsely(
    lab: Lab, names: Sequence[str], many: Sequence[Settings], fairness: Fairness
) -> tuple[int, dict[str, Fault]]:
    """The number of fair variants tried with a pencil, and those drawn too inaccurately."""
    if lab.fair.pencil is None:
        return 0, {}
    which = [int(i) for i in fairness.fair.nonzero()[0][:PENCILLED]]
    found = pencil_faults(lab, [(many[i], fairness.computed(i)) for i in which])
    pairs = zip(which, found, strict=True)
    return len(which), {names[i]: fault for i, fault in pairs if fault is not None}


def students_of(lab: Lab, count: int) -> list[Student]:
    """At most ``count`` students for whom a rule has variants.

    They have ids, or numbers from 1 up to the last that the scene allows. Raises SceneError where
    the scene does not allow number 1.
    """
    if not lab.rule.counts:
        return [Student(i, f"{i:04d}") for i in range(1, count + 1)]
    found: list[Student] = []
    for number in range(1, count + 1):
        student = Student(number, str(number), number)
        try:
            problems = [
                problem
                for each in sheets(lab.rule, student)
                for problem in outside(lab.mechanism.scene.parameters, settings(lab, each))
            ]
        except SceneError as error:
            problems = list(error.problems)
        if problems and number == 1:
            place = "lab.toml: variants.set"
            raise SceneError(
                Problem(place, message("number 1 gives {found}", found=p.found), p.expected)
                for p in problems
            )
        if problems:
            break
        found.append(student)
    return found


def quantiles(values: Sequence[float]) -> list[float]:
    """The least, the quartiles and the most of the finite values; empty where there are none."""
    finite = np.asarray(values, dtype=float)
    finite = finite[np.isfinite(finite)]
    return [float(q) for q in np.quantile(finite, SHARES)] if len(finite) else []
