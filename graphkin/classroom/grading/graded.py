"""Plain records of marking: answers as they were read, and what they earned."""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum
from fractions import Fraction
from typing import TYPE_CHECKING

from msgspec import Struct, field

from graphkin.classroom.lab.lab_model import Item
from graphkin.classroom.roster.students import Taker
from graphkin.text.errors import Problem

if TYPE_CHECKING:
    from graphkin.classroom.grading.standard import Expectation


WITHHELD, THOUSANDS, HANDWRITTEN = "withheld", "thousands", "handwritten"
"""Reasons why a cell cannot be read.

With ``HANDWRITTEN``, a person is to type what a cut-out of the student's sheet shows.
With ``WITHHELD``, everything that the student handed in is refused. With ``THOUSANDS``, a point or
comma may separate thousands.
"""


class Answer(Struct, frozen=True):
    """One cell of an answer table: its ``text``, and the number it states in the field's unit.

    A sense is +1 or -1; counter-clockwise and along the guide are positive. ``signed`` says that a
    sign was written.

    ``problem`` is why a cell cannot be read, which is not the same as wrong: open, number, unit,
    large, turning, sliding, thousands, withheld or handwritten.

    ``followed`` says that the answer was found on the drawing to follow from the student's own
    earlier points. ``grouped`` is the number if its point or comma separates thousands. ``written``
    is what the cell holds, where a person read it as ``text``. ``typed`` says that a person typed
    it from a photograph of the sheet.
    """

    text: str
    value: float | None = None
    signed: bool = False
    problem: str = ""
    followed: bool = False
    grouped: float | None = None
    written: str = ""
    typed: bool = False

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
"""The answer of a student whose answers cannot be read or marked."""


class Status(Enum):
    """The result of marking an answer."""

    RIGHT = "right"
    FOLLOWS = "follows"
    CAUSE = "cause"
    WRONG = "wrong"
    BLANK = "blank"
    UNREADABLE = "unreadable"


class Decision(Struct, frozen=True):
    """The lecturer's decision on a student's ``field``, or on the whole form (no field).

    ``points`` is what it earns, None where the mark stays. ``is_open`` marks a request that is not
    decided yet. ``before`` is what was earned without the decision, None where that mark waited.

    ``at_desk`` says that it was made at the desk. ``answers`` is the appeal that it answers, and
    ``asked`` an appeal since then, which is not decided yet.
    """

    who: str
    field: str
    points: Fraction | None
    reason: str
    is_open: bool = False
    before: Fraction | None = None
    at_desk: bool = False
    answers: str = ""
    asked: str = ""


class EarnedMark(Struct, frozen=True, omit_defaults=True):
    """What one field earned, out of ``points``, and why.

    ``expected`` is the value in the key, and ``tolerance`` the largest accepted error, in the
    field's unit.

    ``source`` is the field that explains the mark: the answer follows from that field's own value.
    A right answer has a source where it is right but not by the key. ``source`` is empty where
    the student's drawing shows what follows.

    ``cause`` names what explains the answer: it is right for a student who made that mistake, which
    gives the value ``by_cause``.
    ``torn`` says that a sense contradicts the sign of its own value, ``alone`` that a right sense
    earns nothing, since the size beside it earns nothing. ``rounded`` says that it is right but for
    its digits: ``few`` or ``many``. ``decision`` is the lecturer's.
    """

    item: Item
    answer: Answer
    status: Status
    points: Fraction
    earned: Fraction
    expected: float
    tolerance: float
    source: str = ""
    cause: str = ""
    by_cause: float | None = None
    torn: bool = False
    alone: bool = False
    rounded: str = ""
    decision: Decision | None = None

    @property
    def is_ruled(self) -> bool:
        """Whether the lecturer set its points."""
        return self.decision is not None and self.decision.points is not None

    @property
    def is_together(self) -> bool:
        """Whether it is right beyond its own tolerance, since all answers fit one drawing."""
        sized = self.item.what != "sense" and self.status is Status.RIGHT and not self.source
        return sized and self.off is not None and abs(self.off) > self.tolerance

    @property
    def waits(self) -> bool:
        """Whether it cannot be read, and its points are not decided."""
        return self.status is Status.UNREADABLE and not self.is_ruled

    @property
    def off(self) -> float | None:
        """The difference between the answer and the key; None without an answer."""
        value = self.answer.value
        return None if value is None else self.item.off(value, self.expected)


class EarnedCause(Struct, frozen=True):
    """A cause that explains a sheet by name, and the points that it costs, once.

    ``odds`` says how much likelier the explanation is than no mistake, as a logarithm. ``whose``
    are the ids of the students whose data were drawn. ``said`` is the sentence of a lab's own cause
    by language. ``either`` names another cause that gives the same answers, and costs no more.
    """

    name: str
    cost: Fraction
    odds: float
    whose: tuple[str, ...] = ()
    said: Mapping[str, str] = {}
    either: str = ""


class DrawingRemark(Struct, frozen=True):
    """A remark pinned to a place of a drawing, in mm of paper, with its number on that sheet."""

    kind: str
    number: int
    at: tuple[float, float]
    text: str


class Graded(Struct, frozen=True):
    """A student with the mark of each field, in the order of the form.

    ``held`` says that the marks are kept back until the lecturer has decided whose answers these
    are. ``decision`` is the lecturer's on the whole form. ``causes`` explain the sheet, and each is
    paid once. ``remarks`` are the lecturer's by field, on the whole form by no field; ``pins`` are
    those on the drawings.
    """

    taker: Taker
    marks: tuple[EarnedMark, ...]
    present: bool = True
    held: bool = False
    decision: Decision | None = None
    causes: tuple[EarnedCause, ...] = ()
    remarks: Mapping[str, str] = {}
    pins: tuple[DrawingRemark, ...] = ()

    @property
    def decisions(self) -> tuple[Decision, ...]:
        """The lecturer's decisions, on fields and on the whole form."""
        found = (*(mark.decision for mark in self.marks), self.decision)
        return tuple(each for each in found if each is not None)

    @property
    def is_marked(self) -> bool:
        """Whether there are marks: something was handed in, or the lecturer gave points."""
        return self.present or any(each.points is not None for each in self.decisions)

    @property
    def earned(self) -> Fraction:
        """The points earned: the sum, or what the lecturer decided for the whole form."""
        if self.decision is not None and self.decision.points is not None:
            return self.decision.points
        whole = sum((mark.earned for mark in self.marks), Fraction())
        return max(Fraction(), whole - self.cost)

    @property
    def cost(self) -> Fraction:
        """The points that the causes cost."""
        return sum((cause.cost for cause in self.causes), Fraction())

    @property
    def points(self) -> Fraction:
        """The most points that can be earned."""
        return sum((mark.points for mark in self.marks), Fraction())

    @property
    def pending(self) -> Fraction:
        """The points of answers that cannot be read, which a person must still decide."""
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
        """The points that wrong answers earned by following through or from a cause."""
        known = (Status.FOLLOWS, Status.CAUSE)
        found = (m.earned for m in self.marks if m.status in known and not m.is_ruled)
        return max(Fraction(), sum(found, Fraction()) - self.cost)

    @property
    def share(self) -> Fraction | None:
        """The earned share of the decided points; None where there are none."""
        return self.earned / self.decided if self.is_marked and self.decided else None

    def mark(self, name: str) -> EarnedMark:
        """The mark of a field."""
        return next(mark for mark in self.marks if mark.item.field == name)


SURE = 10_000.0
"""The largest odds reported: no model of hands and pencils is surer than that."""


class Suspicion(Struct, frozen=True):
    """Evidence for the lecturer: answers that fit another student's data, or were handed in twice.

    ``students`` are ids. ``fields`` are those that fit, of ``of`` in all. ``odds`` says how much
    better they fit than by chance, at most ``SURE``.
    """

    students: tuple[str, ...]
    fields: tuple[str, ...]
    odds: float
    of: int = 0


class Result(Struct, frozen=True):
    """A whole class, marked.

    ``unsure`` are fields of a student's variant that hardly any drawing determines. ``expected``
    holds the standard for each student's answers. ``refused`` has the problems, by student id, of
    what could not be worked out.
    """

    graded: tuple[Graded, ...]
    wrong_variants: tuple[Suspicion, ...] = ()
    copies: tuple[Suspicion, ...] = ()
    unsure: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    expected: tuple[Expectation, ...] = ()
    refused: Mapping[str, tuple[Problem, ...]] = field(default_factory=dict)
