"""Marks a whole class: each student against their own variant, then all students together."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from fractions import Fraction
from functools import cached_property, partial

from msgspec import Struct, field
from msgspec.structs import replace

from graphkin.classroom.grading.class_standards import standards
from graphkin.classroom.grading.copied_answers import copies, wrong_variants
from graphkin.classroom.grading.decisions import by_student, settled, with_decisions
from graphkin.classroom.grading.graded import (
    WAITING,
    Answer,
    Decision,
    EarnedMark,
    Graded,
    Result,
    Status,
)
from graphkin.classroom.grading.marking import Marker
from graphkin.classroom.grading.slips import Slip
from graphkin.classroom.grading.standard import Expectation, standard
from graphkin.classroom.lab.items import items
from graphkin.classroom.lab.lab_model import Item, Lab
from graphkin.classroom.printing.workers import chunks, engine
from graphkin.classroom.roster.taker import Taker
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import GraphkinError, Problem, Refusals

Variant = tuple[tuple[tuple[str, str], ...], tuple[str, ...]]
Given = Mapping[str, Answer]
KEPT = 64
"""The most variants whose constructions are kept. A class with a formula has few variants."""


class Book(Struct, dict=True):
    """The variants of a lab; each is constructed once while it is needed."""

    lab: Lab
    scene: str
    markers: dict[Variant, Marker] = field(default_factory=dict)

    @cached_property
    def form(self) -> tuple[Item, ...]:
        """The fields of the form, the same for all students."""
        return items(self.usual, self.lab)

    def mechanism(self, settings: Mapping[str, str]) -> Mechanism:
        """The mechanism of a variant."""
        return Mechanism(read_text(self.scene, self.lab.name, settings=dict(settings)))

    @cached_property
    def usual(self) -> Mechanism:
        """The mechanism with the scene's own values."""
        return self.mechanism({})

    def prepare(self, takers: Iterable[Taker]) -> None:
        """Construct the variants of some students together, at most ``KEPT`` of them."""
        wanted = {variant(t.settings, t.compute): (t.settings, t.compute) for t in takers}
        new = {name: each for name, each in wanted.items() if name not in self.markers}
        if len(new) < 2:
            return
        for name in list(self.markers)[: max(0, len(self.markers) + len(new) - KEPT)]:
            del self.markers[name]
        many = list(new.values())
        found = standards(self.usual, self.scene, self.form, self.lab.rubric, many)
        self.markers |= {name: Marker(each) for name, each in zip(new, found, strict=True)}

    def marker(self, settings: Mapping[str, str], computed: tuple[str, ...] = ()) -> Marker:
        """The marker for a variant, some of whose fields are computed."""
        name = variant(settings, computed)
        if name not in self.markers:
            if len(self.markers) >= KEPT:
                del self.markers[next(iter(self.markers))]
            found = standard(self.mechanism(settings), self.form, self.lab.rubric, computed)
            self.markers[name] = Marker(found)
        return self.markers[name]

    def expectation(self, taker: Taker) -> Expectation:
        """The expected answers to a student's variant."""
        return self.marker(taker.settings, taker.compute).standard.expectation

    def slips(self, graded: Graded) -> tuple[Slip, ...]:
        """The slips with a student's data."""
        return self.marker(graded.taker.settings, graded.taker.compute).slips

    def mark(self, taker: Taker, answers: Given | None) -> tuple[Graded, Expectation]:
        """The marks of one student and the expected answers; ``answers`` is None where absent."""
        marker = self.marker(taker.settings, taker.compute)
        graded = marker.mark(taker, answers or {}, answers is not None)
        return graded, marker.standard.expectation


class Marked(Struct, frozen=True):
    """The marks of one student, the expected answers, and the problems met on the way.

    There are no marks where the variant cannot be constructed. All marks are open where the answers
    cannot be marked.
    """

    graded: Graded | None = None
    expected: Expectation | None = None
    problems: tuple[Problem, ...] = ()


def marked(book: Book, taker: Taker, answers: Given | None) -> Marked:
    """The marks of one student, with any problem of the answers or the variant."""
    who, refusals, found = taker.student.id, Refusals(), Marked()
    waiting = dict.fromkeys((item.field for item in book.form), WAITING)
    for given in (answers, waiting):
        with refusals.alone(who):
            graded, expected = book.mark(taker, given)
            found = Marked(graded, expected)
        if found.graded is not None:
            break
    return replace(found, problems=tuple(dict.fromkeys(refusals.found.get(who, ()))))


def variant(settings: Mapping[str, str], computed: tuple[str, ...]) -> Variant:
    """The key shared by students with the same data and the same computed fields."""
    return tuple(sorted(settings.items())), computed


def graded_class(
    book: Book,
    takers: Iterable[Taker],
    answers: Mapping[str, Given],
    jobs: int = 1,
    released: Collection[str] = (),
    decisions: Sequence[Decision] = (),
) -> Result:
    """The marks of a whole class, by student id, with the evidence that needs the whole class.

    Where the rubric holds marks back, those of ``released`` students and of students with a
    decision are not held. The evidence comes from the answers, whatever was decided.
    """
    every = [(taker, handed_in(answers.get(taker.student.id))) for taker in takers]
    order = sorted(range(len(every)), key=lambda i: (sorted(every[i][0].settings.items()), i))
    done = spread(book, [every[i] for i in order], jobs)
    told = [each for _, each in sorted(zip(order, done, strict=True), key=lambda pair: pair[0])]
    refusals = Refusals()
    for (taker, _), each in zip(every, told, strict=True):
        if each.problems:
            refusals.add(taker.student.id, each.problems)
    found = [
        (m.graded, m.expected) for m in told if m.graded is not None and m.expected is not None
    ]
    if refusals.found and not found:
        raise GraphkinError(p for problems in refusals.found.values() for p in problems)
    graded = [each for each, _ in found]
    expected = shared(found)
    others = wrong_variants(graded, expected, book.slips, refusals.alone)
    twice = copies(graded, expected, book.slips, refusals.alone)
    fits = {each.students[0]: each.fields for each in others}
    flagged = {*fits, *(who for each in twice for who in each.students)}
    free = settled(decisions).union(released)
    held = flagged.difference(free) if book.lab.rubric.hold else set()
    graded = [
        replace(
            unguessed(each, fits[who]) if (who := each.taker.student.id) in fits else each,
            held=who in held,
        )
        for each in graded
    ]
    own = by_student(decisions)
    graded = [with_decisions(each, own.get(each.taker.student.id, ())) for each in graded]
    open_yet = unsure(graded, expected)
    return Result(tuple(graded), others, twice, open_yet, tuple(expected), refusals.found)


def unguessed(graded: Graded, fits: Sequence[str]) -> Graded:
    """The marks of a student whose answers fit another student's data in some fields.

    In these fields nothing follows from the student's own values. Slips that fit by chance and
    earned nothing are dropped.
    """
    return replace(graded, marks=tuple(unfollowed(without_slip(m), fits) for m in graded.marks))


def unfollowed(mark: EarnedMark, fits: Sequence[str]) -> EarnedMark:
    """A mark without follow-through where the answer fits another student's data."""
    if mark.status is not Status.FOLLOWS or mark.item.sized not in fits:
        return mark
    return replace(mark, status=Status.WRONG, earned=Fraction(), source="")


def without_slip(mark: EarnedMark) -> EarnedMark:
    """A mark without the name of a slip that earned nothing."""
    if not mark.slip or (mark.status is Status.SLIP and mark.earned):
        return mark
    status = Status.WRONG if mark.status is Status.SLIP else mark.status
    return replace(mark, slip="", odds=0.0, status=status)


def handed_in(answers: Given | None) -> Given | None:
    """The answers of a student; None where every field is blank."""
    if answers is None or all(answer.is_blank for answer in answers.values()):
        return None
    return answers


def spread(book: Book, every: Sequence[tuple[Taker, Given | None]], jobs: int) -> list[Marked]:
    """The marks of students, computed in ``jobs`` processes.

    Students with the same variant should be consecutive.
    """
    if jobs == 1:
        return mark_all(book, every)
    work = partial(mark_all, replace(book, markers={}))
    found: list[Marked] = []
    with engine(jobs) as (pool, workers):
        parts = chunks(every, workers, KEPT)
        for part in pool.map(work, parts) if pool is not None else map(work, parts):
            found += part
    return found


def mark_all(book: Book, every: Sequence[tuple[Taker, Given | None]]) -> list[Marked]:
    """The marks of some students, ``KEPT`` at a time, since as many variants are kept.

    Where the variants cannot be prepared together, each is prepared alone, and only those that fail
    are lost.
    """
    found: list[Marked] = []
    for start in range(0, len(every), KEPT):
        part = every[start : start + KEPT]
        with Refusals().alone("together"):
            book.prepare(taker for taker, _ in part)
        found += [marked(book, *each) for each in part]
    return found


def shared(found: Iterable[tuple[Graded, Expectation]]) -> list[Expectation]:
    """The expectation of each student; students with the same variant share one record."""
    known: dict[Variant, Expectation] = {}
    return [
        known.setdefault(variant(graded.taker.settings, graded.taker.compute), expected)
        for graded, expected in found
    ]


def unsure(graded: Sequence[Graded], expected: Sequence[Expectation]) -> dict[str, tuple[str, ...]]:
    """The fields of each student's variant that hardly any drawing determines."""
    found = {
        each.taker.student.id: tuple(f for f, t in form.tolerance.items() if t.unsure)
        for each, form in zip(graded, expected, strict=True)
    }
    return {who: fields for who, fields in found.items() if fields}
