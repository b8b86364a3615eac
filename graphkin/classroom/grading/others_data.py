"""Sheets drawn from another student's data: whose data they are, and the marks by these."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from contextlib import AbstractContextManager
from typing import Any, Protocol

from msgspec import Struct
from msgspec.structs import replace

from graphkin.accuracy.pencil.pencil import Paper
from graphkin.classroom.grading.causes import Cause, plan_of
from graphkin.classroom.grading.explanations import LIKELY, explained_by
from graphkin.classroom.grading.graded import Graded, Status
from graphkin.classroom.grading.marking import Marker, unread_left_out
from graphkin.classroom.grading.standard import Expectation, Standard
from graphkin.classroom.lab.cause_names import ANOTHER
from graphkin.classroom.lab.lab_model import Lab
from graphkin.classroom.lab.rules import exact_text, outside, settings
from graphkin.classroom.roster.student import Student
from graphkin.classroom.roster.taker import Taker
from graphkin.mechanism import Mechanism
from graphkin.numbers.arithmetic import np
from graphkin.text.errors import SceneError


class Markers(Protocol):
    """The markers of a class's variants."""

    lab: Lab

    @property
    def usual(self) -> Mechanism:
        """The mechanism with the scene's own values."""

    def prepare(self, takers: Iterable[Taker]) -> None:
        """Construct the variants of some students together."""

    def marker_of(self, taker: Taker) -> Marker:
        """The marker for a student's variant."""


NUMBERS = 60
"""The most numbers of students, beside those of the class, whose data are tried."""
NEAREST = 24
"""The most other variants that are compared closely with one sheet."""
AT_OWN, AT_THEIRS = "at own scales", "at their scales"


class OtherData(Struct, frozen=True):
    """The right values by another student's data, and the scales of that student's sheets.

    ``whose`` are the ids of the students with these data, or a number of the lab.
    """

    whose: tuple[str, ...]
    key: Mapping[str, float]
    paper: Paper


def with_others_data(
    book: Markers,
    graded: Sequence[Graded],
    expected: Sequence[Expectation],
    copied: Collection[str],
    alone: Callable[[str], AbstractContextManager[None]],
) -> list[Graded]:
    """The marks, where sheets that nothing else explains may be drawn from other data.

    Nothing is explained so whose digits are another student's (``copied``): that is a copy.
    """
    found = list(graded)
    open_yet = [i for i, each in enumerate(graded) if is_open(each, copied)]
    if not open_yet:
        return found
    others = [*of_class(graded, expected), *of_numbers(book, graded)]
    for i in open_yet:
        with alone(graded[i].taker.student.id):
            found[i] = by_others_data(book, graded[i], expected[i], others)
    return found


def is_open(graded: Graded, copied: Collection[str]) -> bool:
    """Whether most of a sheet is wrong, or explained by no more than chance would."""
    if not graded.present or graded.taker.student.id in copied:
        return False
    read = [mark for mark in graded.marks if mark.answer.is_read and mark.item.what != "sense"]
    right = [mark for mark in read if mark.status is Status.RIGHT]
    return len(read) > 2 and len(right) < 0.75 * len(read)


def of_class(graded: Sequence[Graded], expected: Sequence[Expectation]) -> list[OtherData]:
    """The data of the class, each once with those who have them."""
    whose: dict[int, list[str]] = {}
    known: dict[int, Expectation] = {}
    for each, form in zip(graded, expected, strict=True):
        whose.setdefault(id(form), []).append(each.taker.student.id)
        known[id(form)] = form
    return [
        OtherData(tuple(whose[i]), form.key, form.paper)
        for i, form in known.items()
        if form.paper is not None
    ]


def of_numbers(book: Markers, graded: Sequence[Graded]) -> list[OtherData]:
    """The data of the lab's other numbers, where its rule is a formula of the number alone."""
    lab = book.lab
    if lab.rule.draws or not lab.rule.counts:
        return []
    taken = {tuple(sorted(each.taker.settings.items())) for each in graded}
    found: list[Taker] = []
    for number in range(1, NUMBERS + 1):
        student = Student(number, str(number), number)
        try:
            data = settings(lab, student)
            if outside(book.usual.scene.parameters, data):
                break
        except SceneError:
            break
        told = {name: exact_text(value) for name, value in data.items()}
        if tuple(sorted(told.items())) not in taken:
            found.append(Taker(student, told))
    book.prepare(found)
    standards = [book.marker_of(each).standard for each in found]
    return [
        OtherData((f"number {each.student.number}",), s.key, s.paper)
        for each, s in zip(found, standards, strict=True)
    ]


def by_others_data(
    book: Markers, graded: Graded, expected: Expectation, others: Sequence[OtherData]
) -> Graded:
    """The marks of a student by the data that explain the sheet best, if any others do."""
    marker = book.marker_of(graded.taker)
    standard = marker.standard
    first = marker.first_look({mark.item.field: mark.answer for mark in graded.marks})
    given, missed = unread_left_out(first), frozenset(first.wrong)
    other = [each for each in others if each.key != expected.key]
    rows = [
        (each, way, values_by(standard, each, way))
        for each in nearest(standard, given, other)
        for way in (AT_OWN, AT_THEIRS)
    ]
    if not rows or not missed:
        return graded
    table = np.array([values for _, _, values in rows])
    best = explained_by(standard, given, missed, Cause(ANOTHER), table)
    if best is None:
        return graded
    place, why = best
    if graded.causes and graded.causes[0].odds > why.odds - LIKELY:
        return graded
    again = marker.graded(graded.taker, first, why, graded.present)
    whose = rows[place][0].whose
    return replace(again, causes=tuple(replace(e, whose=whose) for e in again.causes))


def values_by(standard: Standard, other: OtherData, way: str) -> Any:
    """What a student writes with other data, drawn at one's own scales or at those of the other."""
    values = np.array([other.key[item.field] for item in standard.items])
    if way == AT_THEIRS:
        return values
    names = ("mechanism", "velocities", "accelerations")
    ratios = [getattr(other.paper, name) / getattr(standard.paper, name) for name in names]
    measured = [item.unit == "mm" for item in standard.items]
    plans = [plan_of(standard.layout, i) for i in range(len(measured))]
    return values * np.where(measured, np.array(ratios)[plans], 1.0)


def nearest(
    standard: Standard, given: Mapping[str, Any], others: Sequence[OtherData]
) -> list[OtherData]:
    """At most ``NEAREST`` data, the nearest to the answers by what no scale changes."""
    fields = [
        item.field for item in standard.items if item.what == "value" and given[item.field].value
    ]
    if len(others) <= NEAREST or not fields:
        return list(others[:NEAREST])
    told = np.array([abs(given[field].value) for field in fields])
    keys = np.array([[abs(each.key[field]) for field in fields] for each in others])
    with np.errstate(all="ignore"):
        apart = np.minimum(abs(np.log(told / keys)), 0.5)
    order = np.argsort(np.nansum(apart, axis=1), kind="stable")[:NEAREST]
    return [others[i] for i in order]
