"""Marks a whole class: each student against their own variant, then all students together.

The standards of all variants, their scales and pencil errors, are computed in arrays. Variants that
differ only in the speed and angle of their drivers share one program; the others have a program
each. Keys equal those of single variants to the last digit. Drawings with pencil errors are made
for a block of variants at once, with an axis for the variants.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import cached_property, partial
from typing import Any

from msgspec import Struct, field
from msgspec.structs import replace

from graphkin.accuracy.pencil import PencilMark
from graphkin.classroom.grading.class_look import look_at_class, look_for_another_lab
from graphkin.classroom.grading.copied_answers import copies, wrong_variants
from graphkin.classroom.grading.decisions import by_student, settled, with_decisions
from graphkin.classroom.grading.end_positions import travel_keys
from graphkin.classroom.grading.explanations import CauseWay, SheetCauses, ways_of
from graphkin.classroom.grading.graded import (
    WAITING,
    Answer,
    Decision,
    EarnedMark,
    Graded,
    Result,
    Status,
)
from graphkin.classroom.grading.marking import (
    FirstLook,
    Marker,
    explained,
    unread_left_out,
    without_chance,
)
from graphkin.classroom.grading.others_data import with_others_data, with_own_causes
from graphkin.classroom.grading.standard import (
    Expectation,
    FormLayout,
    Standard,
    alike,
    layout,
    pencil_errors,
    pencil_of,
    standard,
    standard_at,
    with_force_scales,
)
from graphkin.classroom.lab.items import items
from graphkin.classroom.lab.lab_model import ANOTHER, Item, Lab, Rubric
from graphkin.classroom.lab.variant_scales import Scaling, by_arrays, scaled
from graphkin.classroom.printing.workers import chunks, engine
from graphkin.classroom.roster.students import Taker
from graphkin.construction.core.program import Program, Step
from graphkin.documents.scaling import scales, the_crank
from graphkin.drawing.scale import Scales
from graphkin.mechanism import Mechanism
from graphkin.numbers.arithmetic import np
from graphkin.scene.findings import Findings
from graphkin.scene.model import Scene, quantities_within
from graphkin.scene.parameters import set_values
from graphkin.scene.read_scene import read_text
from graphkin.structure.groups import Group, Tie
from graphkin.text.errors import GraphkinError, Problem, Refusals

DRAWINGS = 8_192
"""The most drawings made at once, for all variants together."""
Settings = Mapping[str, str]


class VariantMechanism(Mechanism, frozen=True, dict=True, kw_only=True):
    """A mechanism with other data than ``like``, whose construction has the same steps."""

    like: Mechanism

    @cached_property
    def groups(self) -> tuple[Group, ...]:
        """The groups of ``like``."""
        return self.like.groups

    @cached_property
    def program(self) -> Program:
        """The program of ``like``."""
        return self.like.program

    @cached_property
    def with_forces(self) -> Mechanism:
        """The mechanism with the plan of forces of ``like``."""
        whole = self.like.with_forces
        return self if whole is self.like else VariantMechanism(self.scene, like=whole)


def standards(
    usual: Mechanism,
    text: str,
    form: Sequence[Item],
    rubric: Rubric,
    many: Sequence[tuple[Settings, tuple[str, ...]]],
) -> list[Standard]:
    """The standard of each variant of a scene, by its settings and its computed fields.

    ``usual`` is the mechanism of the scene in ``text``. Raises what
    :func:`~graphkin.classroom.grading.standard.standard` raises.
    """
    own = mechanisms(usual, text, [settings for settings, _ in many])
    shared = layout(usual, form)
    chosen = [
        with_force_scales(mechanism, scale, shared)
        for mechanism, scale in zip(own, all_scales(usual, own), strict=True)
    ]
    found = [
        single(mechanism, scale, shared, rubric, computed)
        for mechanism, scale, (_, computed) in zip(own, chosen, many, strict=True)
    ]
    pencil = pencil_of(rubric)
    for places in blocks(found):
        errors = pencil_errors([found[i].readings for i in places], pencil)
        for i, each in zip(places, errors, strict=True):
            found[i] = replace(found[i], errors=each)
    return found


def blocks(found: Sequence[Standard]) -> Iterator[list[int]]:
    """The indices of variants that draw the same, with at most ``DRAWINGS`` drawings together.

    Variants with groups of higher class are left out: these are closed for each variant alone.
    """
    for places in alike(found):
        marks = found[places[0]].exact.marks.values()
        if PencilMark.CLOSING in marks:
            continue
        size = max(1, DRAWINGS // (2 * sum(mark.errors for mark in marks) or 1))
        yield from (places[i : i + size] for i in range(0, len(places), size))


def single(
    mechanism: Mechanism,
    chosen: Scales,
    shared: FormLayout,
    rubric: Rubric,
    computed: tuple[str, ...],
) -> Standard:
    """The standard of one variant, without pencil errors.

    A variant whose steps differ gets its own layout.
    """
    whole = mechanism.with_forces
    form = shared if whole.program is shared.drawn else layout(mechanism, shared.items)
    keys = travel_keys(mechanism, form.items, chosen, pencil_of(rubric))
    return standard_at(mechanism, chosen, form, rubric, computed, keys)


# --- mechanisms and scales --------------------------------------------------------------------


def mechanisms(usual: Mechanism, text: str, many: Sequence[Settings]) -> list[Mechanism]:
    """The mechanism of each variant; variants that differ only in their drivers share steps."""
    scene = usual.scene
    changed = {name for each in many for name in each}
    if scene.time is None and by_driving(usual, changed):
        return [
            VariantMechanism(replace(scene, values=values_of(scene, each)), like=usual)
            for each in many
        ]
    texts = (read_text(text, scene.name, settings=dict(each), house=scene.house) for each in many)
    return [as_usual(Mechanism(each), usual) for each in texts]


def values_of(scene: Scene, settings: Settings) -> dict[str, Any]:
    """The exact data of a variant. Raises SceneError for values that the scene does not allow."""
    findings = Findings()
    values = set_values(scene.parameters, dict(settings), findings)
    findings.stop()
    return dict(values)


def by_driving(mechanism: Mechanism, names: set[str]) -> bool:
    """Whether the parameters only change how a mechanism of pins and guides is driven.

    Driving then selects no step. Two cases are excluded: an idle link, which may not fit, and
    requests whose construction depends on the position.
    """
    scene = mechanism.scene
    idle = any(isinstance(group, Tie) for group in mechanism.groups)
    if scene.ask.chosen_by_place or idle or not by_arrays(mechanism):
        return False
    shapes = quantities_within((scene.frame, *scene.links.values()))
    return not any(names.intersection(each.uses()) for each in shapes)


def as_usual(mechanism: Mechanism, usual: Mechanism) -> Mechanism:
    """The mechanism; it shares the steps of the usual one where its steps are the same."""
    own, known = mechanism.program, usual.program
    same = len(own.steps) == len(known.steps) and own.targets == known.targets
    if same and all(map(is_same, own.steps, known.steps)):
        return VariantMechanism(mechanism.scene, like=usual)
    return mechanism


def is_same(one: Step, other: Step) -> bool:
    """Whether two steps draw the same. Sizes that only set margins are ignored."""
    if one.extra == other.extra:
        return one == other
    return replace(one, extra=signs(one)) == replace(other, extra=signs(other))


def signs(step: Step) -> tuple[float, ...]:
    """The branches of a step."""
    return tuple(part for part in step.extra if isinstance(part, int))


def all_scales(usual: Mechanism, own: Sequence[Mechanism]) -> list[Scales]:
    """The scale factors of each variant's sheets."""
    like = [i for i, each in enumerate(own) if each.program is usual.program]
    known: dict[int, Scales] = {}
    if by_arrays(usual) and len(like) > 1:
        found = Scaling([None] * len(like))
        values = {
            name: np.array([float(own[i].scene.values[name]) for i in like])
            for name in usual.scene.values
        }
        scaled(usual, values, found)
        pairs = zip(like, found.own, strict=True)
        known = {i: as_sheet(own[i], each) for i, each in pairs if each is not None}
    return [known[i] if i in known else scales(each) for i, each in enumerate(own)]


def as_sheet(mechanism: Mechanism, found: Scales) -> Scales:
    """Scale factors equal to the last digit to those of a single sheet, set by one crank."""
    return replace(found, seconds=found.of_crank / the_crank(mechanism))


# --- the marks of a class -------------------------------------------------------------------------


Variant = tuple[tuple[tuple[str, str], ...], tuple[str, ...]]
Given = Mapping[str, Answer]
KEPT = 256
"""The most variants whose constructions are kept, and the most students explained together."""


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
        house = self.lab.house
        return Mechanism(read_text(self.scene, self.lab.name, settings=dict(settings), house=house))

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

    def marker_of(self, taker: Taker) -> Marker:
        """The marker for a student's variant."""
        return self.marker(taker.settings, taker.compute)

    def ways(self, graded: Graded) -> tuple[CauseWay, ...]:
        """The ways of working with a student's data and one cause, or those that were found."""
        marker = self.marker_of(graded.taker)
        first = marker.first_look({mark.item.field: mark.answer for mark in graded.marks})
        given, wrong = unread_left_out(first), frozenset(first.wrong)
        return ways_of(marker.standard, given, wrong, two=len(graded.causes) > 1)


class Marked(Struct, frozen=True):
    """The marks of one student, the expected answers, and the problems met on the way.

    There are no marks where the variant cannot be constructed. All marks are open where the answers
    cannot be marked.
    """

    graded: Graded | None = None
    expected: Expectation | None = None
    problems: tuple[Problem, ...] = ()


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
    *,
    as_it_is: bool = False,
) -> Result:
    """The marks of a whole class, by student id, with the evidence that needs the whole class.

    Raises RosterError where the class as a whole looks like another table or lab, unless it is
    marked ``as_it_is``.

    Where the rubric holds marks back, those of ``released`` students and of students with a
    decision are not held. The evidence comes from the answers, whatever was decided.
    """
    every = [(taker, handed_in(answers.get(taker.student.id))) for taker in takers]
    order = sorted(range(len(every)), key=lambda i: (sorted(every[i][0].settings.items()), i))
    done = spread(book, [every[i] for i in order], jobs)
    sheets = [each for _, each in sorted(zip(order, done, strict=True), key=lambda pair: pair[0])]
    refusals = Refusals()
    for (taker, _), each in zip(every, sheets, strict=True):
        if each.problems:
            refusals.add(taker.student.id, each.problems)
    found = [
        (m.graded, m.expected) for m in sheets if m.graded is not None and m.expected is not None
    ]
    if refusals.found and not found:
        raise GraphkinError(p for problems in refusals.found.values() for p in problems)
    graded = [each for each, _ in found]
    expected = shared(found)
    if not as_it_is:
        look_at_class(graded, expected)
    twice = copies(graded, expected, book.ways, refusals.alone)
    copied = {who for each in twice for who in each.students}
    graded = with_own_causes(book, graded, refusals.alone)
    graded = with_others_data(book, graded, expected, copied, refusals.alone)
    if not as_it_is:
        look_for_another_lab(graded)
    others = wrong_variants(graded, expected, book.ways, refusals.alone)
    flagged = {*(each.students[0] for each in others), *copied}
    free = settled(decisions).union(released)
    held = flagged.difference(free) if book.lab.rubric.hold else set()
    fits = {each.students[0]: each.fields for each in others}
    graded = [
        replace(unfollowed(each, fits.get(who, ())), held=who in held)
        for each in graded
        for who in [each.taker.student.id]
    ]
    own = by_student(decisions)
    graded = [with_decisions(each, own.get(each.taker.student.id, ())) for each in graded]
    open_yet = unsure(graded, expected)
    return Result(tuple(graded), others, twice, open_yet, tuple(expected), refusals.found)


def unfollowed(graded: Graded, fits: Sequence[str]) -> Graded:
    """The marks of a student, without follow-through where answers fit another student's data."""
    if not fits or any(cause.name == ANOTHER for cause in graded.causes):
        return graded

    def without(mark: EarnedMark) -> EarnedMark:
        if mark.status is not Status.FOLLOWS or mark.item.sized not in fits:
            return mark
        return replace(mark, status=Status.WRONG, earned=Fraction(), source="")

    return replace(graded, marks=without_chance(map(without, graded.marks)))


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


class SeenSheet(Struct, frozen=True):
    """A student's variant and answers, before they are marked; without a marker where that fails.

    ``problems`` are those of the variant or of the answers. With problems, all answers wait.
    """

    marker: Marker | None = None
    first: FirstLook | None = None
    problems: tuple[Problem, ...] = ()


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
        looks = [look(book, *each) for each in part]
        sheet_causes, faults = explained_all(looks)
        for i, (taker, answers) in enumerate(part):
            seen = looks[i] if i not in faults else withheld(book, taker, faults[i])
            found.append(marked(book, taker, answers is not None, seen, sheet_causes[i]))
    return found


def look(book: Book, taker: Taker, answers: Given | None) -> SeenSheet:
    """A student's answers by the key; all of them wait where they cannot be marked."""
    who, refusals = taker.student.id, Refusals()
    with refusals.alone(who):
        marker = book.marker_of(taker)
        marker.standard.expectation  # noqa: B018 - whatever fails, fails here
        return SeenSheet(marker, marker.first_look(answers or {}))
    return withheld(book, taker, tuple(refusals.found[who]))


def withheld(book: Book, taker: Taker, problems: tuple[Problem, ...]) -> SeenSheet:
    """A student's sheet whose answers all wait, because of some problems."""
    who, refusals = taker.student.id, Refusals()
    waiting = dict.fromkeys((item.field for item in book.form), WAITING)
    with refusals.alone(who):
        marker = book.marker_of(taker)
        marker.standard.expectation  # noqa: B018 - whatever fails, fails here
        return SeenSheet(marker, marker.first_look(waiting), problems)
    return SeenSheet(problems=tuple(dict.fromkeys((*problems, *refusals.found[who]))))


def explained_all(
    looks: Sequence[SeenSheet],
) -> tuple[list[SheetCauses | None], dict[int, tuple[Problem, ...]]]:
    """The explanations of some students, and the problems of those that cannot be explained.

    Where some cannot be had together, each is explained alone.
    """
    known = [(i, (e.marker, e.first)) for i, e in enumerate(looks) if e.marker and e.first]
    found: list[SheetCauses | None] = [None] * len(looks)
    refusals = Refusals()
    with refusals.alone("together"):
        for (i, _), each in zip(known, explained([sheet for _, sheet in known]), strict=True):
            found[i] = each
    for i, sheet in known if refusals.found else ():
        with refusals.alone(str(i)):
            (found[i],) = explained([sheet])
    faults = {i: tuple(refusals.found[str(i)]) for i, _ in known if str(i) in refusals.found}
    return found, faults


def marked(
    book: Book, taker: Taker, present: bool, seen: SeenSheet, why: SheetCauses | None
) -> Marked:
    """The marks of one student; all answers wait where they cannot be marked."""
    if seen.marker is None or seen.first is None:
        return Marked(problems=seen.problems)
    who, refusals = taker.student.id, Refusals()
    with refusals.alone(who):
        graded = seen.marker.graded(taker, seen.first, why, present)
        return Marked(graded, seen.marker.standard.expectation, seen.problems)
    if seen.problems:
        return Marked(problems=(*seen.problems, *refusals.found[who]))
    return marked(book, taker, present, withheld(book, taker, tuple(refusals.found[who])), None)


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
