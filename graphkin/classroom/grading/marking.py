"""The marks of students: by the key, by the causes that explain a sheet, and by follow-through."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from math import floor, isnan
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from graphkin.accuracy.pencil import chi_square_share
from graphkin.classroom.grading.answer_numbers import significant
from graphkin.classroom.grading.explanations import SheetCauses, explanations
from graphkin.classroom.grading.follow_through import Following, followings, is_hit, rightly
from graphkin.classroom.grading.graded import (
    BLANK,
    THOUSANDS,
    Answer,
    EarnedCause,
    EarnedMark,
    Graded,
    Status,
)
from graphkin.classroom.grading.keys import Key, Keys, coarseness
from graphkin.classroom.grading.standard import Expectation, Standard, alike, sense_is_open
from graphkin.classroom.lab.items import worth
from graphkin.classroom.lab.lab_model import Item
from graphkin.classroom.roster.students import Taker
from graphkin.numbers.arithmetic import np

FEW = 3
"""The fewest values that can be judged together as one drawing."""


def of_one_drawing(
    expected: Expectation, answers: Mapping[str, Answer], beyond: Sequence[str]
) -> tuple[str, ...]:
    """The fields ``beyond`` their tolerance that are right, judged by the whole sheet."""
    found = tuple(field for field in beyond if is_near(expected, field, answers[field]))
    if not found:
        return ()
    keys = Keys.of([expected])
    is_read = np.array([answers[field].is_read for field in keys.fields])
    read = is_read & keys.known(0)
    given = [answers[keys.fields[place]] for place in np.flatnonzero(read)]
    values = np.array([float(each.value or 0.0) for each in given])
    digits = np.array([coarseness(each) for each in given]) * abs(values)
    key, rounded = keys.key(0, read), np.maximum(digits, keys.reading(0)[read])
    sizes = np.where(key.places, values, abs(values))
    return found if is_one_drawing(sizes - key.sizes, rounded, key) else ()


def is_near(expected: Expectation, field: str, answer: Answer) -> bool:
    """Whether a value is within the error of 99 of 100 careful drawings; False for a sense."""
    if field not in expected.tolerance:
        return False
    off = expected.item[field].off(float(answer.value or 0.0), expected.key[field])
    return abs(off) <= expected.tolerance[field].most


def is_one_drawing(off: Any, rounded: Any, key: Key) -> Any:
    """Whether the errors of values together are like those of 95 of 100 careful drawings.

    ``rounded`` are the rounding errors. ``off`` may hold a row for each of many sheets.
    """
    spread = key.spread + np.diag(key.computed**2 + rounded**2 / 3)
    scale, count = np.sqrt(np.diag(spread)), len(spread)
    if count < FEW or not (scale > 0).all():
        return np.zeros(np.shape(off)[:-1], dtype=bool)
    shared = spread / np.outer(scale, scale) + 1e-9 * np.eye(count)
    apart = off / scale
    size = (apart * np.linalg.solve(shared, apart.T).T).sum(axis=-1)
    return size <= count * chi_square_share(count)


# --- the marks of one student ---------------------------------------------------------------------


NONE = Fraction()
REVERSED = "sense_reversed"
"""The cause that all senses were taken the other way."""
COARSE = 2
"""The most significant digits of a value that is rounded too coarsely."""
NEAR = 3.0
"""The largest factor, up or down, by which an answer near the key differs from it."""


class FirstLook(Struct, frozen=True):
    """A student's answers by the key alone, before anything explains the wrong ones.

    ``given`` has an answer for each field. ``right`` are right by the key or by the whole sheet,
    ``computed`` follow by formula from right answers, ``wrong`` are all others that can be read.
    ``torn`` are senses that contradict the sign of their own value.
    """

    given: Mapping[str, Answer]
    right: tuple[str, ...]
    computed: Mapping[str, Following]
    wrong: tuple[str, ...]
    torn: frozenset[str]


class Marker:
    """Marks answers against one variant."""

    def __init__(self, standard: Standard) -> None:
        self.standard = standard

    def mark(self, taker: Taker, answers: Mapping[str, Answer], present: bool = True) -> Graded:
        """The mark of each field of a student's form."""
        first = self.first_look(answers)
        (found,) = explained([(self, first)])
        return self.graded(taker, first, found, present)

    def first_look(self, answers: Mapping[str, Answer]) -> FirstLook:
        """The answers by the key."""
        given = asked_of_thousands(self.standard, with_senses(self.standard, answers))
        torn = {field for field in self.standard.key if is_torn(self.standard, field, given)}
        read = [f for f in self.standard.key if given[f].is_read and f not in torn]
        by_key = tuple(field for field in read if is_right(self.standard, field, given))
        beyond = tuple(field for field in read if field not in by_key)
        if beyond:
            by_key = (*by_key, *of_one_drawing(self.standard.expectation, given, beyond))
        off = tuple(field for field in beyond if field not in by_key)
        computed = rightly(self.standard, given, off, by_key)
        wrong = tuple(field for field in off if field not in computed)
        return FirstLook(given, by_key, computed, wrong, frozenset(torn))

    def graded(
        self, taker: Taker, first: FirstLook, found: SheetCauses | None, present: bool = True
    ) -> Graded:
        """The marks with the explanation of the sheet, if there is one that costs less than none.

        A cause costs what the rubric says, and never more than the same values unexplained, or
        explained without it.
        """
        plain = Graded(taker, self.marks(taker, first), present)
        if found is None:
            return plain
        least = plain.earned
        if found.single is not None:
            least = max(least, self.graded(taker, first, found.single, present).earned)
        caused = self.marks(taker, first, found)
        whole = sum((mark.earned for mark in caused), NONE)
        most = max(NONE, whole - least)
        costs = self.costs(plain.points, found, most)
        return Graded(taker, caused, present, causes=costs)

    def costs(
        self, points: Fraction, found: SheetCauses, most: Fraction
    ) -> tuple[EarnedCause, ...]:
        """What each cause costs, together at most ``most``: hundredths of a point, rounded down.

        Senses that are all reversed cost their own points, and nothing beside.
        """
        shares = [self.share(name, found.either) for name in found.names]
        shares = [Fraction(floor(100 * points * share), 100) for share in shares]
        full = sum(shares, NONE)
        part = min(Fraction(1), most / full) if full else NONE
        own = self.standard.rubric.own
        return tuple(
            EarnedCause(
                name,
                share * part,
                found.odds,
                said=own[name].said if name in own else {},
                either=found.either,
            )
            for name, share in zip(found.names, shares, strict=True)
        )

    def share(self, name: str, either: str) -> Fraction:
        """The share of all points that a cause costs: of two that may be meant, the lower one."""
        if name == REVERSED:
            return NONE
        may_be = {name, either} - {"", REVERSED}
        return min(Fraction(str(self.standard.rubric.cost(each))) for each in may_be)

    def marks(
        self, taker: Taker, first: FirstLook, found: SheetCauses | None = None
    ) -> tuple[EarnedMark, ...]:
        """The mark of each field; what agrees with an explanation of the sheet is right."""
        given, wrong = first.given, first.wrong
        caused = {f for f in wrong if found is not None and f in found.fits}
        empty = frozenset() if found is None else self.left_out(given, found)
        lost = frozenset(f for f in caused if found is not None and self.is_lost(f, found))
        right = (*first.right, *first.computed, *(f for f in wrong if f in caused))
        rest = tuple(field for field in wrong if field not in caused)
        also = rightly(self.standard, given, rest, right) if caused and rest else {}
        right, rest = (*right, *also), tuple(field for field in rest if field not in also)
        followed = self.followed(given, rest, right)
        known: dict[str, EarnedMark] = {}
        name = "+".join(found.names) if found is not None else ""
        for item in self.standard.items:
            field, points = item.field, self.worth(item.field, taker.compute)
            mark = self.first_mark(item, given[field], (*first.right, *first.computed), points)
            if field in first.computed:
                mark = replace(mark, source=first.computed[field].sources[0])
            elif field in caused or field in also or field in empty:
                earned = NONE if field in lost else points
                mark = replace(mark, status=Status.CAUSE, earned=earned, cause=name)
                if found is not None and field not in also and field not in found.alone:
                    mark = replace(mark, by_cause=found.values[field])
            elif field in rest:
                mark = self.following(mark, followed.get(field))
            mark = self.by_digits(mark)
            known[field] = replace(mark, torn=field in first.torn)
        return without_chance(known.values())

    def by_digits(self, mark: EarnedMark) -> EarnedMark:
        """The mark of a value that is right but for its digits: too few, or other than wanted."""
        rubric = self.standard.rubric
        if mark.item.what != "value" or not mark.answer.is_read or not mark.points:
            return mark
        fewest, most = significant(mark.answer)
        share = mark.points * Fraction(str(rubric.rounded))
        if mark.status is Status.WRONG:
            error = mark.tolerance + coarseness(mark.answer) * abs(mark.answer.value or 0.0)
            if fewest > COARSE or mark.off is None or abs(mark.off) > error:
                return mark
            return replace(mark, status=Status.FOLLOWS, earned=share, rounded="few")
        if rubric.digits is None or mark.status is Status.BLANK:
            return mark
        fault = "few" if most < rubric.digits[0] else "many" if fewest > rubric.digits[1] else ""
        return replace(mark, earned=min(mark.earned, share), rounded=fault) if fault else mark

    def left_out(self, given: Mapping[str, Answer], found: SheetCauses) -> frozenset[str]:
        """The blank fields of vectors that a student with these causes does not draw."""
        vectors = {f for f, probe in self.standard.by_field.items() if probe.vector}
        return frozenset(f for f in vectors if given[f].is_blank and found.values[f] == 0)

    def is_lost(self, field: str, found: SheetCauses) -> bool:
        """Whether a sense was taken the other way: it is worth no more than a blank."""
        return REVERSED in found.names and self.standard.by_field[field].item.what == "sense"

    def followed(
        self, answers: Mapping[str, Answer], wrong: tuple[str, ...], right: tuple[str, ...]
    ) -> dict[str, Following]:
        """For each wrong field, the answers from which it follows; never in a circle.

        A sense follows only where the size of its rate follows from the same values.
        """
        if not wrong or not self.standard.rubric.follow:
            return {}
        candidates = followings(self.standard, answers, wrong, right)
        hits = [following for following in candidates if is_hit(self.standard, following, answers)]
        sized = {(following.field, following.sources) for following in hits}
        found: dict[str, Following] = {}
        for following in hits:
            field, sources = following.field, following.sources
            rate = self.standard.by_field[field].item.sized
            if rate != field and (rate, sources) not in sized:
                continue
            if field in wrong and field not in found and not is_circular(found, following):
                found[field] = following
        return found

    def worth(self, field: str, computed: tuple[str, ...]) -> Fraction:
        """The points of a field.

        A segment too short to measure leaves its points to the value that is computed.
        """
        item = self.standard.by_field[field].item
        return worth(item, self.standard.rubric.points, computed) or NONE

    def first_mark(
        self, item: Item, answer: Answer, right: tuple[str, ...], points: Fraction
    ) -> EarnedMark:
        """The mark by the key alone."""
        status = Status.WRONG
        if answer.is_blank:
            status = Status.BLANK
        elif not answer.is_read:
            status = Status.UNREADABLE
        elif item.field in right:
            status = Status.RIGHT
        allowed = self.standard.tolerance.get(item.field)
        return EarnedMark(
            item,
            answer,
            status,
            points,
            points if status is Status.RIGHT else NONE,
            self.standard.key[item.field],
            allowed.value if allowed is not None else 0.0,
        )

    def following(self, mark: EarnedMark, follows: Following | None) -> EarnedMark:
        """The mark of a wrong answer: the share of follow-through where it follows."""
        rubric = self.standard.rubric
        on_paper = mark.answer.followed and rubric.follow > 0
        if follows is None and not on_paper:
            return mark
        earned = mark.points * Fraction(str(rubric.follow))
        source = follows.sources[0] if follows is not None else ""
        return replace(mark, status=Status.FOLLOWS, earned=earned, source=source)


def without_chance(marks: Iterable[EarnedMark]) -> tuple[EarnedMark, ...]:
    """The marks, where a sense earns nothing if the size beside it earns nothing.

    One of two senses is right by chance. Where a size cannot be read, its sense counts.
    """
    known = {mark.item.field: mark for mark in marks}

    def alone(mark: EarnedMark) -> bool:
        sized = known.get(mark.item.sized)
        if mark.item.what != "sense" or sized is None or not (mark.earned and sized.points):
            return False
        return sized.status in (Status.WRONG, Status.BLANK) and not sized.earned

    return tuple(replace(m, earned=NONE, alone=True) if alone(m) else m for m in known.values())


def explained(sheets: Sequence[tuple[Marker, FirstLook]]) -> list[SheetCauses | None]:
    """The explanation of each sheet; variants that draw alike are explained together."""
    found: list[SheetCauses | None] = [None] * len(sheets)
    open_yet = [i for i, (_, first) in enumerate(sheets) if first.wrong]
    markers = list({id(sheets[i][0]): sheets[i][0] for i in open_yet}.values())
    for group in alike([each.standard for each in markers]):
        row = {id(markers[place]): k for k, place in enumerate(group)}
        own = [i for i in open_yet if id(sheets[i][0]) in row]
        sheet_causes = explanations(
            [markers[place].standard for place in group],
            [row[id(sheets[i][0])] for i in own],
            [unread_left_out(sheets[i][1]) for i in own],
            [frozenset(sheets[i][1].wrong) for i in own],
        )
        for i, each in zip(own, sheet_causes, strict=True):
            found[i] = each
    return found


def unread_left_out(first: FirstLook) -> Mapping[str, Answer]:
    """The answers that explain a sheet: those that contradict themselves say nothing."""
    return {f: BLANK if f in first.torn else answer for f, answer in first.given.items()}


def is_circular(found: Mapping[str, Following], following: Following) -> bool:
    """Whether one of the sources follows from the field itself."""
    sources = list(following.sources)
    for source in sources:
        if source in found:
            sources += [each for each in found[source].sources if each not in sources]
    return following.field in sources


def with_senses(standard: Standard, answers: Mapping[str, Answer]) -> dict[str, Answer]:
    """An answer for each field; a blank sense is taken from the sign of its value."""
    given = {item.field: answers.get(item.field, BLANK) for item in standard.items}
    for item in standard.items:
        value = given.get(item.sized, BLANK)
        if item.what == "sense" and given[item.field].is_blank and value.signed and value.value:
            sign = 1.0 if value.value > 0 else -1.0
            given[item.field] = Answer("+" if sign > 0 else "-", sign, signed=True)
    return given


def asked_of_thousands(standard: Standard, answers: Mapping[str, Answer]) -> dict[str, Answer]:
    """The answers, with ambiguous points and commas made unreadable.

    These are answers that are near the key only if the point or comma separates thousands.
    """
    found = dict(answers)
    for field, answer in answers.items():
        key = standard.key.get(field)
        if answer.grouped is None or not key or isnan(key):
            continue
        size = standard.by_field[field].item.size
        is_near = 1 / NEAR < size(answer.grouped) / size(key) < NEAR
        if is_near and not is_right(standard, field, answers):
            found[field] = Answer(answer.text, problem=THOUSANDS)
    return found


def is_torn(standard: Standard, field: str, answers: Mapping[str, Answer]) -> bool:
    """Whether a sense contradicts the sign written before its value.

    It is unclear which of the two is meant, so the sense earns nothing; the value counts by its
    size. Where no drawing determines the sense, there is no contradiction.
    """
    item = standard.by_field[field].item
    if item.what != "sense" or sense_is_open(standard, field):
        return False
    sense, value = answers[field].value, answers.get(item.sized, BLANK)
    return bool(sense and value.signed and value.value and sense * value.value < 0)


def is_right(standard: Standard, field: str, answers: Mapping[str, Answer]) -> bool:
    """Whether an answer agrees with the key: a size within its tolerance, a sense exactly.

    Where no drawing determines a sense, or the key of a place is NaN, every answer is right.
    """
    item, right = standard.by_field[field].item, standard.key[field]
    value = float(answers[field].value or 0.0)
    if item.what == "sense":
        return value == right or sense_is_open(standard, field)
    near = abs(item.off(value, right)) <= standard.tolerance[field].value
    return near or (item.what == "place" and isnan(right))
