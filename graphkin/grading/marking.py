"""The marks of one student: by the key, by what follows from own values, by slips with a share."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from math import hypot, isnan

from graphkin.grading.construction_slips import constructions
from graphkin.grading.diagnosis import Found, diagnosed
from graphkin.grading.field_slips import of_fields
from graphkin.grading.follow import Following, followings
from graphkin.grading.model import BLANK, Answer, Graded, Mark, Status, Taker
from graphkin.grading.slips import Slip
from graphkin.grading.standard import Standard
from graphkin.lab.asking import worth
from graphkin.lab.model import Item

NONE = Fraction()
SENSE = "_sense"


class Marker:
    """Marks answer sets against one variant; its slips are worked out once, when one is wrong."""

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
        given = with_senses(self.standard, answers)
        torn = {field for field in self.standard.key if is_torn(self.standard, field, given)}
        read = [f for f in self.standard.key if given[f].is_read and f not in torn]
        right = tuple(field for field in read if is_right(self.standard, field, given))
        wrong = tuple(field for field in read if field not in right)
        followed = self.followed(given, wrong)
        slipped = self.slipped(given, wrong, right)
        marks = []
        spent: dict[str, str] = {}
        for item in self.standard.items:
            worth = self.points(item, taker.compute)
            mark = self.first_mark(item, given[item.field], right, worth)
            if item.field in wrong:
                mark = self.lesser(mark, followed.get(item.field), slipped.get(item.field), spent)
            marks.append(replace(mark, torn=item.field in torn))
        return Graded(taker, tuple(marks), present)

    def followed(
        self, answers: Mapping[str, Answer], wrong: tuple[str, ...]
    ) -> dict[str, Following]:
        """For each wrong field that follows from an own value, from which."""
        if not wrong or not self.standard.rubric.follow:
            return {}
        found: dict[str, Following] = {}
        told = list(followings(self.standard, answers, wrong))
        for following in told:
            if following.field not in found and is_hit(self.standard, following, answers):
                found[following.field] = following
        return self.with_their_senses(found, told, answers)

    def with_their_senses(
        self,
        found: dict[str, Following],
        told: list[Following],
        answers: Mapping[str, Answer],
    ) -> dict[str, Following]:
        """A sense follows only where the size of the same rate does, from the same value."""
        kept = {field: f for field, f in found.items() if not field.endswith(SENSE)}
        for following in told:
            sized = kept.get(following.field.removesuffix(SENSE))
            if (
                following.field.endswith(SENSE)
                and sized is not None
                and sized.source == following.source
                and is_hit(self.standard, following, answers)
            ):
                kept[following.field] = following
        return kept

    def slipped(
        self, answers: Mapping[str, Answer], wrong: tuple[str, ...], right: tuple[str, ...]
    ) -> dict[str, Found]:
        """For each wrong field the slip that explains it."""
        if not wrong:
            return {}
        return diagnosed(self.standard, self.slips, answers, wrong, right)

    def points(self, item: Item, computed: tuple[str, ...]) -> Fraction:
        """What a field is worth: a segment too short to be measured leaves its points to the value
        that is computed."""
        return worth(item, self.standard.rubric.points, computed) or NONE

    def first_mark(
        self, item: Item, answer: Answer, right: tuple[str, ...], points: Fraction
    ) -> Mark:
        """The mark by the key alone."""
        status = Status.WRONG
        if answer.is_blank:
            status = Status.BLANK
        elif not answer.is_read:
            status = Status.UNREADABLE
        elif item.field in right:
            status = Status.RIGHT
        allowed = self.standard.tolerance.get(item.field)
        return Mark(
            item,
            answer,
            status,
            points,
            points if status is Status.RIGHT else NONE,
            self.standard.key[item.field],
            allowed.value if allowed is not None else 0.0,
        )

    def lesser(
        self, mark: Mark, follows: Following | None, found: Found | None, spent: dict[str, str]
    ) -> Mark:
        """The share of a wrong answer: that of its slip, or of what follows, the larger.

        A slip of the construction costs its share once: what else it makes wrong follows from it.
        A slip for which the rubric has no share earns nothing. ``spent`` gathers the field at which
        each slip was paid for.
        """
        rubric = self.standard.rubric
        slip_share, paid_at = 0.0, ""
        if found is not None:
            slip_share = rubric.slips.get(found.slip.name, 0.0)
            again = found.slip.whole and mark.item.what != "sense"
            if again and 0 < slip_share < rubric.follow:
                paid_at = spent.get(found.slip.name, "")
                slip_share = rubric.follow if paid_at else slip_share
        follow_share = rubric.follow if follows is not None else 0.0
        if follows is not None and follow_share >= slip_share:
            earned = mark.points * Fraction(str(follow_share))
            mark = replace(mark, status=Status.FOLLOWS, earned=earned, source=follows.source)
        elif found is not None:
            spent.setdefault(found.slip.name, mark.item.field)
            earned = mark.points * Fraction(str(slip_share))
            mark = replace(mark, status=Status.SLIP, earned=earned, source=paid_at)
        return mark if found is None else replace(mark, slip=found.slip.name, odds=found.odds)


def with_senses(standard: Standard, answers: Mapping[str, Answer]) -> dict[str, Answer]:
    """An answer for each field; a sense that is left blank is told by the sign of its value."""
    given = {item.field: answers.get(item.field, BLANK) for item in standard.items}
    for field, answer in given.items():
        value = given.get(field.removesuffix(SENSE), BLANK)
        if field.endswith(SENSE) and answer.is_blank and value.signed and value.value:
            sign = 1.0 if value.value > 0 else -1.0
            given[field] = Answer("+" if sign > 0 else "-", sign, signed=True)
    return given


def is_torn(standard: Standard, field: str, answers: Mapping[str, Answer]) -> bool:
    """Whether a sense says the contrary of the sign that is written before its own value.

    Nobody can tell which of the two is meant, so the sense earns nothing; the value counts by its
    size. Where no drawing tells the sense, none is asked.
    """
    if not field.endswith(SENSE) or sense_is_open(standard, field):
        return False
    sense, value = answers[field].value, answers.get(field.removesuffix(SENSE), BLANK)
    return bool(sense and value.signed and value.value and sense * value.value < 0)


def is_right(standard: Standard, field: str, answers: Mapping[str, Answer]) -> bool:
    """Whether an answer is right by the key: a size within its tolerance, a sense as it is."""
    item, right = standard.by_field[field].item, standard.key[field]
    value = float(answers[field].value or 0.0)
    if item.what == "sense":
        return value == right or sense_is_open(standard, field)
    allowed = standard.tolerance[field].value
    if item.what == "place":
        return abs(value - right) <= allowed or isnan(right)
    return abs(abs(value) - abs(right)) <= allowed


def sense_is_open(standard: Standard, field: str) -> bool:
    """Whether no drawing tells a sense: the value is nought within what a pencil makes of it."""
    sized = field.removesuffix(SENSE)
    if sized not in standard.tolerance:
        return standard.key[field] == 0
    allowed = standard.tolerance[sized]
    return abs(standard.key[sized]) <= max(allowed.value, hypot(allowed.pencil, allowed.ruler))


def is_hit(standard: Standard, following: Following, answers: Mapping[str, Answer]) -> bool:
    """Whether an answer is what follows."""
    value = float(answers[following.field].value or 0.0)
    item = standard.by_field[following.field].item
    if item.what == "sense":
        return value == following.value
    if item.what == "place":
        return abs(value - following.value) <= following.tolerance
    return abs(abs(value) - abs(following.value)) <= following.tolerance
