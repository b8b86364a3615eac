"""Sheets drawn from other data: another student's, or as a cause of the lab changes the own."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from contextlib import AbstractContextManager
from fractions import Fraction
from typing import Any, Protocol

from msgspec import Struct
from msgspec.structs import astuple, replace

from graphkin.accuracy.pencil.pencil import Paper
from graphkin.classroom.grading.causes import Cause, plan_of
from graphkin.classroom.grading.explanations import LIKELY, SheetCauses, explained_by
from graphkin.classroom.grading.graded import Graded, Status
from graphkin.classroom.grading.marking import Marker, unread_left_out
from graphkin.classroom.grading.standard import Expectation, Standard, standard
from graphkin.classroom.lab.cause_names import ANOTHER
from graphkin.classroom.lab.lab_model import Item, Lab, OwnCause
from graphkin.classroom.lab.rules import exact_text, outside, settings
from graphkin.classroom.roster.student import Student
from graphkin.classroom.roster.taker import Taker
from graphkin.mechanism import Mechanism
from graphkin.numbers.arithmetic import np
from graphkin.text.errors import GraphkinError, SceneError


class Markers(Protocol):
    """The markers of a class's variants."""

    lab: Lab

    @property
    def usual(self) -> Mechanism:
        """The mechanism with the scene's own values."""

    @property
    def form(self) -> tuple[Item, ...]:
        """The fields of the form."""

    def prepare(self, takers: Iterable[Taker]) -> None:
        """Construct the variants of some students together."""

    def marker_of(self, taker: Taker) -> Marker:
        """The marker for a student's variant."""


NUMBERS = 60
"""The most numbers of students, beside those of the class, whose data are tried."""
NEAREST = 24
"""The most other variants that are compared closely with one sheet."""
AS_WELL = 1.0
"""The odds, as a logarithm, by which another cause may be likelier than the lab's own."""
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


def with_own_causes(
    book: Markers,
    graded: Sequence[Graded],
    alone: Callable[[str], AbstractContextManager[None]],
) -> list[Graded]:
    """The marks, where the causes that only this lab knows explain sheets as well as any other."""
    own, found = book.lab.rubric.own, list(graded)
    for i, each in enumerate(graded if own else ()):
        if each.present and any(mark.status is not Status.RIGHT for mark in each.marks):
            with alone(each.taker.student.id):
                found[i] = by_own_causes(book, each, own.values())
    return found


def by_own_causes(book: Markers, graded: Graded, own: Iterable[OwnCause]) -> Graded:
    """The marks of a student by the lab's own cause that explains the sheet best, if any does.

    Where another cause explains it as well, the lab's is named.
    """
    marker = book.marker_of(graded.taker)
    first = marker.first_look({mark.item.field: mark.answer for mark in graded.marks})
    given, missed = unread_left_out(first), frozenset(first.wrong)
    best: SheetCauses | None = None
    for cause in own if missed else ():
        other = taken(book, graded.taker, cause)
        if other is None:
            continue
        table = np.array([values_by(marker.standard, other, way) for way in (AT_OWN, AT_THEIRS)])
        found = explained_by(marker.standard, given, missed, Cause(cause.name), table)
        if found is not None and (best is None or found[1].odds > best.odds):
            best = found[1]
    if best is None or (graded.causes and graded.causes[0].odds > best.odds + AS_WELL):
        return graded
    return marker.graded(graded.taker, first, best, graded.present)


def taken(book: Markers, taker: Taker, cause: OwnCause) -> OtherData | None:
    """A student's data as a cause of the lab changes them; None where nothing can be drawn.

    The ranges and steps of the scene do not bind a mistake.
    """
    scene = book.usual.scene
    values = {**scene.values}
    values |= {name: Fraction(text) for name, text in taker.settings.items()}
    try:
        changed = {name: exact(each.number(values)) for name, each in cause.settings.items()}
        mechanism = Mechanism(replace(scene, values={**values, **changed}))
        found = standard(mechanism, book.form, book.lab.rubric, taker.compute)
        return OtherData((), found.key, found.paper)
    except GraphkinError:
        return None


def exact(value: Any) -> Fraction:
    """A value as an exact number, of twelve digits where it is not rational."""
    return value if isinstance(value, Fraction) else Fraction(f"{float(value):.12g}")


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
    own = marker.standard
    first = marker.first_look({mark.item.field: mark.answer for mark in graded.marks})
    given, missed = unread_left_out(first), frozenset(first.wrong)
    other = [each for each in others if each.key != expected.key]
    rows = [
        (each, way, values_by(own, each, way))
        for each in nearest(own, given, other)
        for way in (AT_OWN, AT_THEIRS)
    ]
    if not rows or not missed:
        return graded
    table = np.array([values for _, _, values in rows])
    best = explained_by(own, given, missed, Cause(ANOTHER), table)
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
    pairs = zip(astuple(other.paper), astuple(standard.paper), strict=True)
    ratios = [theirs / own if own else 1.0 for theirs, own in pairs]
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
