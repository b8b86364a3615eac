"""What is said of a class that got its data: how fair they are, and to whom they are not."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence

from graphkin.classroom.grading.neighbours import compared, unsure_fields
from graphkin.classroom.lab.fairness_words import (
    apart_lines,
    data_words,
    fields_by_whom,
    limit_words,
    pencil_lines,
    rule_words,
    spread_lines,
)
from graphkin.classroom.lab.lab_model import Lab
from graphkin.classroom.roster.student import Student
from graphkin.classroom.variants.assign import Assigned, held_against
from graphkin.text.plain_table import labelled, table

MOST = 40
"""Rows of one list."""
COMPARED = 1_000
"""Students whose data are compared with one another; of more of them so many."""
WHO = ("row", "number", "id", "name")
"""The heads of what lists say of who somebody is."""


def class_lines(lab: Lab, found: Sequence[Assigned]) -> Iterator[str]:
    """The whole report on a class."""
    yield from labelled("rule", [rule_words(lab)])
    yield from labelled("limits", [limit_words(lab.fair)])
    fair = sum(each.fair for each in found)
    yield from labelled("fair", [f"{fair} of {len(found)} students"])
    unfair = [
        (*who(each.student), data_words(each.settings), "; ".join(map(str, each.faults)))
        for each in found
        if not each.fair
    ]
    yield from labelled("unfair", listed((*WHO, "data", "limits"), unfair))
    if lab.rule.draws:
        again = [(*who(each.student), f"{each.attempt + 1}") for each in found if each.attempt]
        yield from labelled("again", listed((*WHO, "draws"), again))
    small = [(*who(each.student), " ".join(each.computed)) for each in found if each.computed]
    yield from labelled("compute", listed((*WHO, "computed instead of measured"), small))
    drawn = [each for each in found if each.flattest is not None]
    angles = [each.flattest for each in drawn if each.flattest is not None]
    lengths = [each.shortest for each in drawn if each.shortest is not None]
    rays = [each.rays for each in drawn if each.rays is not None]
    yield from labelled("spread", spread_lines(angles, lengths, rays))
    if len(drawn) > COMPARED:
        told = f"{COMPARED} of {len(drawn)} students, evenly spaced in the list"
        yield from labelled("compared", [told])
        drawn = [drawn[i * len(drawn) // COMPARED] for i in range(COMPARED)]
    names = [each.student.id for each in drawn]
    standards = held_against(lab, drawn)
    neighbours = compared(standards)
    yield from labelled("apart", apart_lines(neighbours, names, "id"))
    yield from labelled("pencil", pencil_lines(neighbours))
    unsure = list(zip(names, map(unsure_fields, standards), strict=True))
    yield from labelled("unsure", unsure_lines(unsure, f"{100 * lab.rubric.cap:g} %"))
    if not lab.rule.draws:
        yield from labelled("note", alike_lines([each.student for each in found]))


def unsure_lines(unsure: Sequence[tuple[str, Sequence[str]]], cap: str) -> list[str]:
    """The fields that hardly any drawing settles, and whose: before the exam, as after it."""
    if not any(fields for _, fields in unsure):
        return ["none"]
    return [
        *fields_by_whom(unsure, "id"),
        f"a careful drawing is off there by more than {cap} of the value;"
        " pencil in [fair] limits that",
    ]


def alike_lines(students: Sequence[Student]) -> list[str]:
    """Numbers that several students of a group share, and so their data."""
    shared = Counter((student.group, student.number) for student in students)
    found = [
        f"{count} students{f' of group {group}' if group else ''} have number {number}: "
        "they get the same data"
        for (group, number), count in shared.items()
        if count > 1
    ]
    return [*found[:MOST], *([f"… and {len(found) - MOST} more numbers"] if found[MOST:] else [])]


def who(student: Student) -> tuple[str, str, str, str]:
    """A student as lists name one."""
    number = "" if student.number is None else str(student.number)
    return str(student.row), number, student.id, student.name


def listed(head: tuple[str, ...], rows: Sequence[tuple[str, ...]]) -> list[str]:
    """A list with its head, cut where it is long; none where it is empty."""
    if not rows:
        return ["none"]
    more = [f"… and {len(rows) - MOST} more"] if len(rows) > MOST else []
    return [*table(head, list(rows[:MOST])), *more]
