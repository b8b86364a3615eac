"""Sheets drawn from other data: another student's, or as a cause of the lab changes the own."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from contextlib import AbstractContextManager
from fractions import Fraction
from functools import cached_property
from typing import Any, Protocol

from msgspec import Struct
from msgspec.structs import astuple, replace

from graphkin.accuracy.pencil import Paper
from graphkin.classroom.grading.causes import Cause, plan_of
from graphkin.classroom.grading.explanations import (
    LIKELY,
    SheetCauses,
    explained_by,
    explained_by_two,
)
from graphkin.classroom.grading.graded import Answer, Graded, Status
from graphkin.classroom.grading.marking import Marker, unread_left_out
from graphkin.classroom.grading.standard import Errors, Expectation, Standard, Tolerance, standard
from graphkin.classroom.lab.lab_model import (
    ANOTHER,
    Item,
    Lab,
    OwnCause,
    exact_text,
    outside,
    settings,
    sheets,
)
from graphkin.classroom.roster.students import Student, Taker
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
SURELY = 6.0
"""The least odds, as a logarithm, at which other data are named: a sheet that is turned by a degree
fits the data of a neighbour nearly as well, and this says more of a student than a slip does."""
VERBATIM = 8
"""The fewest numbers that are a copy where all are those of the student whose data were used."""
AS_WELL = 1.0
"""The odds, as a logarithm, by which another cause may be likelier than the lab's own."""
UNEXPLAINED, BESIDE_TWO = 0.2, 0.05
"""The shares of unexplained answers, beside one cause and beside two, from which a second cause
beside other data is looked for."""


class OtherData(Struct, frozen=True):
    """The right values by another student's data, and the scales of that student's sheets.

    ``whose`` are the ids of the students with these data, or a number of the lab. ``taker`` is one
    of them. ``tolerance`` has the pencil's errors of their drawings.
    """

    whose: tuple[str, ...]
    key: Mapping[str, float]
    paper: Paper
    taker: Taker
    tolerance: Mapping[str, Tolerance]


class Others(Struct, frozen=True, dict=True):
    """All data that students may have drawn, by the fields of a form."""

    every: Sequence[OtherData]
    form: Sequence[Item]

    @cached_property
    def table(self) -> Any:
        """The right values, a row for each."""
        return np.array([[each.key[item.field] for item in self.form] for each in self.every])

    def nearest(
        self, standard: Standard, given: Mapping[str, Answer], most: int
    ) -> list[OtherData]:
        """At most so many data other than the own, the nearest by what no scale changes."""
        own = np.array([standard.key[item.field] for item in self.form])
        other = np.flatnonzero(~np.isclose(self.table, own, rtol=1e-12, equal_nan=True).all(axis=1))
        sized = [item.what == "value" and bool(given[item.field].value) for item in self.form]
        if len(other) > most and any(sized):
            sizes = [abs(given[item.field].value or 0.0) for item in self.form]
            with np.errstate(all="ignore"):
                apart = abs(np.log(np.array(sizes)[sized] / abs(self.table[other][:, sized])))
            far = np.nansum(np.minimum(apart, 0.5), axis=1)
            other = other[np.argsort(far, kind="stable")]
        return [self.every[i] for i in other[:most].tolist()]


def with_others_data(
    book: Markers,
    graded: Sequence[Graded],
    expected: Sequence[Expectation],
    copied: Collection[str],
    alone: Callable[[str], AbstractContextManager[None]],
) -> list[Graded]:
    """The marks, where sheets that nothing else explains may be drawn from other data.

    Nothing is explained so whose digits are another student's: that is a copy. ``copied`` are those
    for whom copying is likelier than chance.
    """
    found = list(graded)
    open_yet = [i for i, each in enumerate(graded) if is_open(each, copied)]
    if not open_yet:
        return found
    others = Others([*of_class(graded, expected), *of_numbers(book, graded)], book.form)
    known = {each.taker.student.id: each for each in graded}
    for i in open_yet:
        with alone(graded[i].taker.student.id):
            again = by_others_data(book, graded[i], others)
            owners = [known[who] for e in again.causes for who in e.whose if who in known]
            if not any(is_verbatim(graded[i], owner) for owner in owners):
                found[i] = again
    return found


def is_verbatim(graded: Graded, other: Graded) -> bool:
    """Whether all numbers of a student are those of another, many enough not to agree by chance."""
    pairs = [
        (mark.answer.value, theirs.answer.value)
        for mark, theirs in zip(graded.marks, other.marks, strict=True)
        if mark.answer.is_read and mark.item.what != "sense"
    ]
    return len(pairs) >= VERBATIM and all(mine == theirs for mine, theirs in pairs)


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
        found = explained_by(
            marker.standard, given, missed, Cause(cause.name), *tables(marker.standard, [other])
        )
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
        return OtherData((), found.key, found.paper, taker, found.tolerance)
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
    known: dict[int, tuple[Expectation, Taker]] = {}
    for each, form in zip(graded, expected, strict=True):
        whose.setdefault(id(form), []).append(each.taker.student.id)
        known[id(form)] = form, each.taker
    return [
        OtherData(tuple(whose[i]), form.key, form.paper, taker, form.tolerance)
        for i, (form, taker) in known.items()
        if form.paper is not None
    ]


def of_numbers(book: Markers, graded: Sequence[Graded]) -> list[OtherData]:
    """The data of the lab's other numbers, where its rule is a formula of the number alone."""
    lab = book.lab
    if lab.rule.is_drawn or not lab.rule.counts:
        return []
    taken = {tuple(sorted(each.taker.settings.items())) for each in graded}
    found: list[Taker] = []
    for number in range(1, NUMBERS + 1):
        student = Student(number, str(number), number)
        try:
            every = [settings(lab, each) for each in sheets(lab.rule, student)]
        except SceneError:
            break
        if any(outside(book.usual.scene.parameters, data) for data in every):
            break
        for data in every:
            exact_data = {name: exact_text(value) for name, value in data.items()}
            if tuple(sorted(exact_data.items())) not in taken:
                found.append(Taker(student, exact_data))
    book.prepare(found)
    standards = [book.marker_of(each).standard for each in found]
    return [
        OtherData((f"number {each.student.number}",), s.key, s.paper, each, s.tolerance)
        for each, s in zip(found, standards, strict=True)
    ]


def by_others_data(book: Markers, graded: Graded, others: Others) -> Graded:
    """The marks of a student by the data that explain the sheet best, if any others do."""
    marker = book.marker_of(graded.taker)
    own = marker.standard
    first = marker.first_look({mark.item.field: mark.answer for mark in graded.marks})
    given, missed = unread_left_out(first), frozenset(first.wrong)
    near = others.nearest(own, given, NEAREST) if missed else []
    if not near:
        return graded
    one = explained_by(own, given, missed, Cause(ANOTHER), *tables(own, near))
    best = None if one is None else (near[one[0] // 2], one[1])
    left = given if best is None else {f: a for f, a in given.items() if f not in best[1].fits}
    most = UNEXPLAINED if len(graded.causes) < 2 else BESIDE_TWO
    is_open = not graded.causes or unexplained(graded) > most
    if is_open and is_lost(own, missed) and any(answer.is_read for answer in left.values()):
        single = None if best is None else best[1]
        near = others.nearest(own, given, NUMBERS)
        best = with_second_cause(book, own, given, missed, near, single) or best
    if best is None or best[1].odds < SURELY:
        return graded
    data, why = best
    if graded.causes and graded.causes[0].odds > why.odds - LIKELY:
        return graded
    again = marker.graded(graded.taker, first, why, graded.present)
    causes = (
        replace(each, whose=data.whose) if each.name == ANOTHER else each for each in again.causes
    )
    return replace(again, causes=tuple(causes))


def unexplained(graded: Graded) -> float:
    """The share of a student's answers that nothing explains."""
    read = [mark for mark in graded.marks if mark.answer.is_read]
    lost = [mark for mark in read if mark.status in (Status.WRONG, Status.FOLLOWS)]
    return len(lost) / max(1, len(read))


def is_lost(standard: Standard, missed: Collection[str]) -> bool:
    """Whether most numbers of a sheet are wrong, so that two causes may run through all of it."""
    return sum(field in missed for field in standard.tolerance) > len(standard.tolerance) / 2


def with_second_cause(
    book: Markers,
    own: Standard,
    given: Mapping[str, Answer],
    missed: frozenset[str],
    others: Sequence[OtherData],
    one: SheetCauses | None,
) -> tuple[OtherData, SheetCauses] | None:
    """The other data that explain a sheet together with a second cause, at scales of either.

    None where they do not explain it better than ``one``, the explanation by other data alone.
    """
    book.prepare(each.taker for each in others)
    theirs = [book.marker_of(each.taker).standard for each in others]
    every = [*theirs, *(at_scales_of(own, each) for each in theirs)]
    found = explained_by_two(own, given, missed, Cause(ANOTHER), every, one)
    return None if found is None else (others[found[0] % len(others)], found[1])


def at_scales_of(own: Standard, other: Standard) -> Standard:
    """Other data drawn at the scales of the student's own sheets."""
    ratios = scale_ratios(own.paper, other.paper)
    mm = [each.probe.item.unit == "mm" for each in other.readings]
    plans = [
        plan_of(other.layout, i)
        for i, p in enumerate(other.layout.probes)
        if p.item.what != "sense"
    ]
    factors = np.where(mm, 1.0, ratios[plans] ** -1.0)
    errors = tuple((np.array(other.pencil.each) * factors).tolist())
    spread = other.pencil.together * np.outer(factors, factors)
    exact = replace(other.exact, paper=own.paper)
    return replace(other, scales=own.scales, exact=exact, errors=Errors(errors, spread))


def scale_ratios(own: Paper, other: Paper) -> Any:
    """How many times as long lengths are at one's own scales, in the mechanism and each plan."""
    pairs = zip(astuple(other), astuple(own), strict=True)
    return np.array([theirs / mine if mine else 1.0 for theirs, mine in pairs])


def tables(standard: Standard, others: Sequence[OtherData]) -> tuple[Any, Any]:
    """What a student writes with each of other data, and how many times as large the errors are.

    There are two rows for each, as drawn at one's own scales and at those of the other.
    """
    measured = np.array([item.unit == "mm" for item in standard.items])
    plans = [plan_of(standard.layout, i) for i in range(len(measured))]
    own = pencil_of(standard.tolerance, standard.items)
    values, grown = [], []
    for other in others:
        key = np.array([other.key[item.field] for item in standard.items])
        with np.errstate(all="ignore"):
            errors = pencil_of(other.tolerance, standard.items) / own
        ratios = scale_ratios(standard.paper, other.paper)[plans]
        values += [key * np.where(measured, ratios, 1.0), key]
        grown += [errors * np.where(measured, 1.0, 1 / ratios), errors]
    return np.array(values), np.nan_to_num(np.array(grown), nan=1.0, posinf=1.0)


def pencil_of(tolerance: Mapping[str, Tolerance], items: Sequence[Item]) -> Any:
    """The pencil's error of each field; 1 for senses."""
    return np.array([tolerance[i.field].pencil if i.field in tolerance else 1.0 for i in items])
