"""What is proposed to a lab: ranges in which all is fair, and what mends a formula."""

from __future__ import annotations

from collections.abc import Mapping

from msgspec import Struct
from msgspec.structs import replace

from graphkin.classroom.lab.fair_ranges import FairRanges
from graphkin.classroom.lab.formula_mending import Mending, mended
from graphkin.classroom.lab.lab_model import Lab, LabRule, Range, ValueList
from graphkin.classroom.lab.lab_trial import tried
from graphkin.classroom.roster.student import Student
from graphkin.classroom.variants.assign import assigned

CLASS = 60
"""Students of the class on which a proposal is tried."""
APART = 0.5
"""Most that another's right values may earn, where the lab says nothing."""
COURSE = "mechanics 2026"
"""The course for which data are drawn, where the lab says nothing."""


class ProposedRanges(Struct, frozen=True):
    """Ranges to draw from for a course: how many different data they give, and how many of a class
    they keep apart at a limit; ``exact`` is the share of them that a pencil draws exactly enough.
    """

    ranges: Mapping[str, Range | ValueList]
    course: str
    count: int
    apart: float
    kept: int
    of: int
    exact: float = 1.0


def proposed_ranges(lab: Lab, found: FairRanges) -> ProposedRanges | None:
    """The ranges that were found, tried on a class; None where none were."""
    if found.ranges is None:
        return None
    course = lab.rule.course or COURSE
    apart = lab.fair.apart if lab.fair.apart is not None else APART
    new = replace(lab, rule=LabRule(course, found.ranges), fair=replace(lab.fair, apart=apart))
    students = [Student(i, f"{i:04d}", i) for i in range(1, CLASS + 1)]
    kept = sum(each.fair for each in assigned(new, students))
    return ProposedRanges(found.ranges, course, found.count, apart, kept, CLASS, found.exact_inside)


class FormulaFaults(Struct, frozen=True):
    """The numbers to which a formula is unfair, with why, and the change that mends it, if any."""

    unfair: Mapping[str, str]
    mending: Mending | None = None


def formula_faults(lab: Lab) -> FormulaFaults:
    """To which numbers a lab's formula is unfair, why, and the smallest change that mends that."""
    outcome = tried(lab)
    unfair = {
        number: "; ".join(map(str, outcome.fairness.faults(i)))
        for i, number in enumerate(outcome.names)
        if not outcome.fairness.fair[i]
    }
    return FormulaFaults(unfair, mended(lab, outcome) if unfair else None)
