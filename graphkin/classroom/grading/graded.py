"""What marking is about, as plain records: answers as they were read, and what they earned."""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum
from fractions import Fraction
from typing import TYPE_CHECKING

from msgspec import Struct, field

from graphkin.classroom.lab.lab_model import Item
from graphkin.classroom.roster.taker import Taker
from graphkin.text.errors import Problem

if TYPE_CHECKING:
    from graphkin.classroom.grading.standard import Expectation


WITHHELD, THOUSANDS = "withheld", "thousands"
"""Why a cell cannot be read: all that its student handed in is refused; its point or comma may part
thousands.
"""


class Answer(Struct, frozen=True):
    """One cell of an answer table: its ``text`` and the number that it states, in the field's unit.

    A sense is +1 or -1, counter-clockwise or along the guide positive. ``signed`` tells that a
    sign was written; ``problem`` why a cell cannot be read (open, number, unit, large, turning,
    sliding, thousands, withheld), which is not the same as wrong; ``followed`` that it was found
    on the drawing to follow from the student's own earlier points; ``grouped`` is the number if its
    point or comma parts thousands.
    """

    text: str
    value: float | None = None
    signed: bool = False
    problem: str = ""
    followed: bool = False
    grouped: float | None = None

    @property
    def is_blank(self) -> bool:
        """Whether nothing was answered."""
        return not self.text.strip()

    @property
    def is_read(self) -> bool:
        """Whether there is a value."""
        return self.value is not None


BLANK = Answer("")
WAITING = Answer("?", problem=WITHHELD)
"""An answer of somebody whose answers cannot be read or marked."""


class Status(Enum):
    """What an answer was found to be."""

    RIGHT = "right"
    FOLLOWS = "follows"
    SLIP = "slip"
    WRONG = "wrong"
    BLANK = "blank"
    UNREADABLE = "unreadable"


class Decision(Struct, frozen=True):
    """What the lecturer decided of a student's ``field``, or of the whole form (no field), and why.

    ``points`` is what it earns, None where the mark stays; ``is_open`` tells of a request that is
    not decided yet; ``before`` is what was earned without it, None where that waited.
    """

    who: str
    field: str
    points: Fraction | None
    reason: str
    is_open: bool = False
    before: Fraction | None = None


class EarnedMark(Struct, frozen=True):
    """What one field earned, of ``points``, and why.

    ``expected`` is the key's value and ``tolerance`` how far an answer may lie from it, in the
    field's unit; ``source`` is the field from whose own value the answer follows (none where its
    drawing tells that), rightly where it is right but not by the key, or at which its slip was paid
    for; ``slip`` the name of the mistake
    that gives it, ``odds`` how much better that explains it than chance;
    ``torn`` tells of a sense that the sign of its own value contradicts; ``decision`` is the
    lecturer's.
    """

    item: Item
    answer: Answer
    status: Status
    points: Fraction
    earned: Fraction
    expected: float
    tolerance: float
    source: str = ""
    slip: str = ""
    odds: float = 0.0
    torn: bool = False
    decision: Decision | None = None

    @property
    def is_ruled(self) -> bool:
        """Whether the lecturer set its points."""
        return self.decision is not None and self.decision.points is not None

    @property
    def is_together(self) -> bool:
        """Whether it is right, though beyond its own tolerance, since all are one drawing."""
        sized = self.item.what != "sense" and self.status is Status.RIGHT and not self.source
        return sized and self.off is not None and abs(self.off) > self.tolerance

    @property
    def waits(self) -> bool:
        """Whether it cannot be read, and nobody has decided its points."""
        return self.status is Status.UNREADABLE and not self.is_ruled

    @property
    def off(self) -> float | None:
        """How far the answer lies from the key's; None where there is none."""
        value = self.answer.value
        return None if value is None else self.item.off(value, self.expected)


class Graded(Struct, frozen=True):
    """A student with the mark of each field, in the order of the form.

    ``held`` tells that they are kept back until the lecturer has decided whose answers these are;
    ``decision`` is the lecturer's on the whole form.
    """

    taker: Taker
    marks: tuple[EarnedMark, ...]
    present: bool = True
    held: bool = False
    decision: Decision | None = None

    @property
    def decisions(self) -> tuple[Decision, ...]:
        """The lecturer's, of fields and of the whole."""
        found = (*(mark.decision for mark in self.marks), self.decision)
        return tuple(each for each in found if each is not None)

    @property
    def is_marked(self) -> bool:
        """Whether there are marks: something was handed in, or the lecturer gave points."""
        return self.present or any(each.points is not None for each in self.decisions)

    @property
    def earned(self) -> Fraction:
        """What was earned: the sum, or what the lecturer decided for the whole."""
        if self.decision is not None and self.decision.points is not None:
            return self.decision.points
        return sum((mark.earned for mark in self.marks), Fraction())

    @property
    def points(self) -> Fraction:
        """The most that could be earned."""
        return sum((mark.points for mark in self.marks), Fraction())

    @property
    def pending(self) -> Fraction:
        """The points of answers that cannot be read, which a person has still to decide."""
        if self.decision is not None and self.decision.points is not None:
            return Fraction()
        waiting = (mark.points for mark in self.marks if mark.waits)
        return sum(waiting, Fraction())

    @property
    def decided(self) -> Fraction:
        """The points that do not wait."""
        return self.points - self.pending

    @property
    def spared(self) -> Fraction:
        """What wrong answers earned all the same, by what follows or by slips."""
        known = (Status.FOLLOWS, Status.SLIP)
        found = (m.earned for m in self.marks if m.status in known and not m.is_ruled)
        return sum(found, Fraction())

    @property
    def share(self) -> Fraction | None:
        """What was earned, in parts of the points that are decided; None without any."""
        return self.earned / self.decided if self.is_marked and self.decided else None

    def mark(self, name: str) -> EarnedMark:
        """The mark of a field."""
        return next(mark for mark in self.marks if mark.item.field == name)


SURE = 10_000.0
"""The largest odds that are reported: no model of hands and pencils is surer than that."""


class Suspicion(Struct, frozen=True):
    """Evidence for the lecturer: answers that fit another's data, or were handed in twice.

    ``students`` are ids; ``fields`` what fits, ``odds`` how much better than chance, ``SURE`` at
    most.
    """

    students: tuple[str, ...]
    fields: tuple[str, ...]
    odds: float
    of: int = 0


class Result(Struct, frozen=True):
    """A whole class, marked; ``unsure`` are fields that no drawing of a student's variant tells,
    ``expected`` is what each student's answers were held against; ``refused`` says of whom
    something could not be worked out, and why.
    """

    graded: tuple[Graded, ...]
    wrong_variants: tuple[Suspicion, ...] = ()
    copies: tuple[Suspicion, ...] = ()
    unsure: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    expected: tuple[Expectation, ...] = ()
    refused: Mapping[str, tuple[Problem, ...]] = field(default_factory=dict)
