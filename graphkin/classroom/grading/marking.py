"""The marks of one student: by the key, by follow-through, and by slips with a share."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from math import hypot, isnan
from typing import Any

from msgspec.structs import replace

from graphkin.accuracy.pencil.forecast import chi_square_share
from graphkin.classroom.grading.follow_through import followings, is_hit, rightly
from graphkin.classroom.grading.form_relations import Following
from graphkin.classroom.grading.graded import BLANK, THOUSANDS, Answer, EarnedMark, Graded, Status
from graphkin.classroom.grading.keys import Keys, coarseness
from graphkin.classroom.grading.likelihood import Key
from graphkin.classroom.grading.slip_diagnosis import Found, diagnosed
from graphkin.classroom.grading.slips import Slip, constructions, of_fields
from graphkin.classroom.grading.standard import Expectation, Standard
from graphkin.classroom.lab.items import worth
from graphkin.classroom.lab.lab_model import Item
from graphkin.classroom.roster.taker import Taker
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
    told = np.array([answers[field].is_read for field in keys.fields])
    read = told & keys.known(0)
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
NEAR = 3.0
"""The largest factor, up or down, by which an answer near the key differs from it."""


class Marker:
    """Marks answers against one variant, whose slips are worked out at the first wrong answer."""

    def __init__(self, standard: Standard) -> None:
        self.standard = standard
        self.known: tuple[Slip, ...] | None = None

    @property
    def slips(self) -> tuple[Slip, ...]:
        """Every slip that changes a field."""
        if self.known is None:
            self.known = (*constructions(self.standard), *of_fields(self.standard))
        return self.known

    def mark(self, taker: Taker, answers: Mapping[str, Answer], present: bool = True) -> Graded:
        """The mark of each field of a student's form."""
        given = asked_of_thousands(self.standard, with_senses(self.standard, answers))
        torn = {field for field in self.standard.key if is_torn(self.standard, field, given)}
        read = [f for f in self.standard.key if given[f].is_read and f not in torn]
        by_key = tuple(field for field in read if is_right(self.standard, field, given))
        beyond = tuple(field for field in read if field not in by_key)
        if beyond:
            by_key = (*by_key, *of_one_drawing(self.standard.expectation, given, beyond))
        off = tuple(field for field in beyond if field not in by_key)
        computed = rightly(self.standard, given, off, by_key)
        right = (*by_key, *computed)
        wrong = tuple(field for field in off if field not in computed)
        followed = self.followed(given, wrong, right)
        slipped = self.slipped(given, wrong, right, followed)
        marks: dict[str, EarnedMark] = {}
        paid: dict[str, str] = {}
        for item in self.standard.items:
            points = self.worth(item.field, taker.compute)
            mark = self.first_mark(item, given[item.field], right, points)
            if item.field in computed:
                mark = replace(mark, source=computed[item.field].sources[0])
            elif item.field in wrong:
                mark = self.lesser(mark, followed.get(item.field), slipped, paid, taker.compute)
            marks[item.field] = replace(mark, torn=item.field in torn)
        return Graded(taker, tuple(marks.values()), present)

    def followed(
        self, answers: Mapping[str, Answer], wrong: tuple[str, ...], right: tuple[str, ...]
    ) -> dict[str, Following]:
        """For each wrong field, the answers from which it follows; never in a circle.

        A sense follows only where the size of its rate follows from the same values.
        """
        if not wrong or not self.standard.rubric.follow:
            return {}
        told = followings(self.standard, answers, wrong, right)
        hits = [following for following in told if is_hit(self.standard, following, answers)]
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

    def slipped(
        self,
        answers: Mapping[str, Answer],
        wrong: tuple[str, ...],
        right: tuple[str, ...],
        followed: Mapping[str, Following],
    ) -> dict[str, Found]:
        """For each wrong field, the slip that explains it."""
        if not wrong:
            return {}
        sources = {field: each.sources for field, each in followed.items() if not each.drawn}
        return diagnosed(self.standard, self.slips, answers, wrong, right, sources)

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

    def lesser(
        self,
        mark: EarnedMark,
        follows: Following | None,
        slipped: Mapping[str, Found],
        paid: dict[str, str],
        compute: tuple[str, ...],
    ) -> EarnedMark:
        """The mark of a wrong answer: the share of its slip, or of follow-through, the larger.

        A slip is paid for once, at the first field with points that it explains; the other fields
        that it explains follow from it. A slip without a share in the rubric earns nothing.
        ``paid`` maps each slip to the field where it was paid for.

        An answer may follow on the drawing only from values with the same slip. Then the slip
        counts: nobody finds such a chain on their own paper.
        """
        rubric, field = self.standard.rubric, mark.item.field
        found = slipped.get(field)
        name = found.slip.name if found is not None else ""
        share, paid_at = rubric.slips.get(name, 0.0), paid.get(name, "")
        if follows is not None and name and not paid_at and mark.points:
            same = [f for f in follows.sources if f in slipped and slipped[f].slip.name == name]
            if same and (share or not any(self.worth(f, compute) for f in same)):
                follows = None
        if share and paid_at:
            share = max(share, rubric.follow)
            drawn = follows.sources if follows is not None and follows.drawn else ()
            if drawn and all(f in slipped and slipped[f].slip.name == name for f in drawn):
                follows = None
        on_paper = mark.answer.followed and rubric.follow > 0
        if (follows is not None or on_paper) and rubric.follow >= share:
            earned = mark.points * Fraction(str(rubric.follow))
            source = follows.sources[0] if follows is not None else ""
            mark = replace(mark, status=Status.FOLLOWS, earned=earned, source=source)
        elif found is not None:
            if mark.points:
                paid.setdefault(name, field)
            earned, source = mark.points * Fraction(str(share)), paid_at if share else ""
            mark = replace(mark, status=Status.SLIP, earned=earned, source=source)
        return mark if found is None else replace(mark, slip=name, odds=found.odds)


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


def sense_is_open(standard: Standard, field: str) -> bool:
    """Whether no drawing determines a sense: the value is zero within the error of a drawing."""
    sized = standard.by_field[field].item.sized
    if sized not in standard.tolerance:
        return standard.key[field] == 0
    allowed = standard.tolerance[sized]
    return abs(standard.key[sized]) <= max(allowed.value, hypot(allowed.pencil, allowed.ruler))
