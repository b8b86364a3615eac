"""What a marked class leaves to a person, one by one, each with its likely decisions."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from hashlib import sha256
from typing import Literal

from msgspec import Struct
from msgspec.structs import replace

from graphkin.classroom.grading.answer_numbers import OPEN, beyond_number, rounding, shown_cell
from graphkin.classroom.grading.class_report import copies_words, wrong_variant_words
from graphkin.classroom.grading.desk_rulings import (
    AnyRuling,
    Appeal,
    LeaveMark,
    Place,
    ReadAs,
    SetPoints,
)
from graphkin.classroom.grading.feedback import points_words, unread
from graphkin.classroom.grading.graded import THOUSANDS, WITHHELD, EarnedMark, Graded, Status
from graphkin.classroom.grading.grading_files import KeptReport
from graphkin.drawing.richtext import plain
from graphkin.text import Words

DeskKind = Literal["cell", "appeal", "suspects", "sheet", "cluster"]
KINDS: tuple[DeskKind, ...] = ("cell", "appeal", "suspects", "sheet", "cluster")
"""The kinds of things to decide, in the order of the desk."""
LOST = Fraction(1, 4)
"""The least share of all points that a sheet without an explanation has lost to wrong values."""
LIKE = 3
"""The fewest like answers that are decided together."""
NAMED = 4
"""The most suspects of whom each can be decided by one key."""
GROUPS = re.compile(r"(?<=\d)[.,](?=\d{3})")
"""A point or comma before three digits."""


class DeskChoice(Struct, frozen=True):
    """A likely decision: what it says, and the rulings that it makes."""

    said: str
    rulings: tuple[AnyRuling, ...]


class DeskItem(Struct, frozen=True):
    """One thing to decide.

    ``title`` is its line in the queue, ``reason`` says why a person must decide. ``places`` are the
    marks decided; ``shown`` are the rows to see. ``own`` is the text of a cell, or of an appeal.
    ``cut_out`` is the picture of a handwritten cell, a file among the readings.
    """

    kind: DeskKind
    title: str
    reason: str
    places: tuple[Place, ...]
    shown: tuple[Place, ...]
    choices: tuple[DeskChoice, ...]
    own: str = ""
    cut_out: str = ""

    @property
    def name(self) -> str:
        """A name that stays the same as long as it is about the same marks."""
        about = repr((self.kind, self.places, self.own))
        return f"{self.kind}-{sha256(about.encode()).hexdigest()[:12]}"


class DeskQueue(Struct, frozen=True):
    """A marked class from which the things to decide are collected, in the lecturer's language.

    ``names`` are the students' by id, as they are shown.
    """

    report: KeptReport
    graded: Mapping[str, Graded]
    names: Mapping[str, str]
    words: Words

    def items(self, appeals: Iterable[Appeal] = ()) -> list[DeskItem]:
        """Everything to decide, in the order of the desk."""
        asked = [self.appeal(each) for each in appeals]
        parts = (self.cells(), asked, self.suspects(), self.sheets(), self.clusters())
        return [each for part in parts for each in part]

    def mark(self, place: Place) -> EarnedMark:
        """The mark of a field."""
        return self.graded[place[0]].mark(place[1])

    # --- cells ------------------------------------------------------------------------------------

    def cells(self) -> Iterator[DeskItem]:
        """Cells that wait: the same text in the same field is one thing to decide.

        A drawing that leaves a field open is a matter of its student alone, and so is a cell that a
        hand wrote on a sheet.
        """
        words, by_cell = self.words, defaultdict[tuple[str, str, str, str], list[Place]](list)
        cut_outs = {(cell.who, cell.field): cell.cut_out for cell in self.report.cells}
        units = {cell.field: cell.unit for cell in self.report.cells}
        for cell in self.report.cells:
            if cell.who in self.graded:
                alone = cell.who if cell.text.strip() == OPEN else ""
                by_cell[cell.field, cell.text, cell.problem, alone].append((cell.who, cell.field))
        for (field, text, problem, _), places in by_cell.items():
            mark, cut_out = self.mark(places[0]), cut_outs[places[0]]
            name = called(mark, words)
            shown = words("desk.quoted", text=shown_cell(text.strip()))
            why = unread(problem, units[field], words, shown_cell(beyond_number(text)))
            yield DeskItem(
                "cell",
                self.titled(name if cut_out else f"{name}: {shown}", places),
                words("desk.type_it") if cut_out else f"{shown} {why}",
                tuple(places),
                tuple(places),
                (*self.readings(text, problem, places), *self.shares(places, (0, 1))),
                text,
                cut_out,
            )
        for who, graded in self.graded.items():
            if graded.present and all(m.answer.problem == WITHHELD for m in graded.marks):
                why = words("unread.withheld", unit="", rest="")
                yield DeskItem("cell", self.names[who], why, ((who, ""),), (), ())

    def readings(self, text: str, problem: str, places: Sequence[Place]) -> Iterator[DeskChoice]:
        """What a cell may say: the number with its point, or without it; or nothing."""
        words, texts = self.words, [""]
        if problem == THOUSANDS:
            texts = [text.strip(), GROUPS.sub("", text.strip())]
        for each in texts:
            said = words("desk.read_as", text=each) if each else words("desk.no_answer")
            yield DeskChoice(said, tuple(ReadAs(*at, written=text, text=each) for at in places))

    # --- choices ----------------------------------------------------------------------------------

    def shares(self, places: Sequence[Place], shares: Iterable[float]) -> Iterator[DeskChoice]:
        """Shares of the points of fields."""
        for share in map(Fraction, shares):
            most = [share * self.mark(place).points for place in places]
            said = points_words(most[0], self.words)
            rulings = (SetPoints(*at, points=own) for at, own in zip(places, most, strict=True))
            yield DeskChoice(self.words("desk.earns", points=said), tuple(rulings))

    def stays(self, places: Iterable[Place], asked: str = "") -> DeskChoice:
        """The marks stay."""
        rulings = tuple(LeaveMark(*place, asked=asked) for place in places)
        return DeskChoice(self.words("desk.stays"), rulings)

    def titled(self, text: str, places: Sequence[Place]) -> str:
        """A title with the student, or with the number of students."""
        who = self.names[places[0][0]] if len(places) == 1 else f"{len(places)}×"
        return f"{text}, {who}"

    # --- what students ask, and what only the lecturer can judge ----------------------------------

    def appeal(self, appeal: Appeal) -> DeskItem:
        """An appeal, with the mark that it is about."""
        words, place = self.words, appeal.place
        name = self.names[appeal.who]
        field = called(self.mark(place), words) if appeal.field else words("class.whole")
        mark = self.mark(place) if appeal.field else None
        is_full = mark is None or mark.earned == mark.points
        full = [] if is_full else list(self.shares([place], [1]))
        full += self.undeducted(appeal)
        given = [replace(each, rulings=answering(each.rulings, appeal.text)) for each in full]
        shown = (place,) if appeal.field else self.whole(appeal.who)
        return DeskItem(
            "appeal",
            f"{name}, {field}",
            appeal.text,
            (place,),
            shown,
            (self.stays([place], appeal.text), *given),
            appeal.text,
        )

    def undeducted(self, appeal: Appeal) -> Iterator[DeskChoice]:
        """The whole form without a deduction, where its causes explain what is asked about."""
        graded, place = self.graded[appeal.who], appeal.place
        if not graded.cost or (appeal.field and self.mark(place).status is not Status.CAUSE):
            return
        points = sum((mark.earned for mark in graded.marks), Fraction())
        said = self.words("desk.undeducted", points=points_words(points, self.words))
        stays = (LeaveMark(*place),) if appeal.field else ()
        yield DeskChoice(said, (*stays, SetPoints(appeal.who, "", points=points)))

    def whole(self, who: str) -> tuple[Place, ...]:
        """The rows of a student's form that earn points."""
        return tuple((who, mark.item.field) for mark in self.graded[who].marks if mark.points)

    def suspects(self) -> Iterator[DeskItem]:
        """Answers that fit another student's data, and answers handed in twice."""
        names, words = dict(self.names), self.words
        together = [{*each.students} for each in self.report.copies]
        for each in self.report.wrong_variants:
            if any({*each.students[:2]} <= some for some in together):
                continue
            reason = wrong_variant_words(each, names, words)
            yield self.suspected(reason, each.students[:1], each.students[:2], each.fields)
        for each in self.report.copies:
            reason = copies_words(each, names, words)
            yield self.suspected(reason, each.students, each.students, each.fields)

    def suspected(
        self, reason: str, who: Sequence[str], beside: Sequence[str], fields: Sequence[str]
    ) -> DeskItem:
        """Suspects, with the fields that agree."""
        words, places = self.words, [(each, "") for each in who]
        choices = [replace(self.stays(places), said=words("desk.own_work"))]
        for guilty in who if 1 < len(who) <= NAMED else ():
            rulings = (SetPoints(*p) if p[0] == guilty else LeaveMark(*p) for p in places)
            said = words("desk.none_for", who=self.names[guilty])
            choices.append(DeskChoice(said, tuple(rulings)))
        one = len(who) == 1
        none = words("desk.none_for", who=self.names[who[0]]) if one else words("desk.none_for_all")
        choices.append(DeskChoice(none, tuple(SetPoints(*p) for p in places)))
        shown = tuple((each, field) for field in fields for each in beside)
        title = words("list_mark").join(self.names[each] for each in who)
        return DeskItem("suspects", title, reason, tuple(places), shown, tuple(choices))

    def flagged(self) -> set[str]:
        """The students who are suspected of anything."""
        first = {each.students[0] for each in self.report.wrong_variants}
        return first.union(*(each.students for each in self.report.copies))

    def sheets(self) -> Iterator[DeskItem]:
        """Sheets that lost many points to wrong values which no cause explains."""
        flagged = self.flagged()
        for who, graded in self.graded.items():
            lost = sum((mark.points for mark in wrong(graded)), Fraction())
            if who in flagged or graded.causes or lost <= LOST * graded.points or not lost:
                continue
            points = points_words(lost, self.words)
            reason = self.words("desk.unexplained", points=points)
            place = (who, "")
            stays = (self.stays([place]),)
            yield DeskItem("sheet", self.names[who], reason, (place,), self.whole(who), stays)

    # --- like answers -----------------------------------------------------------------------------

    def clusters(self) -> Iterator[DeskItem]:
        """Like wrong answers to one field: the same part of the right value, or the same value."""
        words, flagged = self.words, self.flagged()
        every: dict[str, list[tuple[str, EarnedMark]]] = defaultdict(list)
        for who, graded in self.graded.items():
            for mark in wrong(graded) if who not in flagged else ():
                if mark.item.what != "sense" and mark.answer.is_read:
                    every[mark.item.field].append((who, mark))
        for field, answers in every.items():
            found: list[tuple[str, list[Wrong]]]
            if answers[0][1].item.what == "place":
                found = [(words("desk.same_value"), each) for each in alike(answers, value_of)]
            else:
                found = [(ratio_words(each, words), each) for each in alike(answers, ratio_of)]
                rest = [own for own in answers if not any(own in run for _, run in found)]
                found += [(words("desk.same_value"), run) for run in alike(rest, value_of)]
            for said, run in found:
                places = [(who, field) for who, _ in run]
                choices = (self.stays(places), *self.shares(places, (0.5, 1)))
                title = f"{called(run[0][1], words)}: {len(run)}×"
                yield DeskItem("cluster", title, said, tuple(places), tuple(places), choices)


def answering(rulings: Iterable[AnyRuling], asked: str) -> tuple[AnyRuling, ...]:
    """The rulings as answers to an appeal."""
    answers = (SetPoints, LeaveMark)
    return tuple(replace(e, asked=asked) if isinstance(e, answers) else e for e in rulings)


def wrong(graded: Graded) -> Iterator[EarnedMark]:
    """The marks of wrong answers that earn points, whatever was decided on them."""
    for mark in graded.marks:
        if graded.present and mark.points and mark.status is Status.WRONG:
            yield mark


def called(mark: EarnedMark, words: Words) -> str:
    """A field's symbol and unit, or that it is a sense, as plain text."""
    sense = words("table.sense") if mark.item.what == "sense" else ""
    return ", ".join(
        filter(None, (plain(mark.item.symbol), words.spelled(mark.item.unit) or sense))
    )


Wrong = tuple[str, EarnedMark]


def ratio_of(mark: EarnedMark) -> tuple[float, float] | None:
    """An answer as a part of the right value, and how far like answers may be apart."""
    size, right = abs(mark.answer.value or 0.0), abs(mark.expected)
    if not (right > 0 and size > 0 and mark.tolerance < right):
        return None
    return size / right, size / right * (mark.tolerance / right + 2 * rounding(mark.answer))


def value_of(mark: EarnedMark) -> tuple[float, float] | None:
    """An answer, and how far like answers may be apart: by their last digits."""
    value = mark.item.size(mark.answer.value or 0.0)
    return value, 2 * rounding(mark.answer) * abs(value)


def alike(
    answers: Sequence[Wrong], by: Callable[[EarnedMark], tuple[float, float] | None]
) -> list[list[Wrong]]:
    """Runs of answers that are as near to the first of the run as ``by`` allows."""
    placed = [(*where, own) for own in answers if (where := by(own[1])) is not None]
    placed.sort(key=lambda each: (each[0], each[2][0]))
    runs: list[list[Wrong]] = []
    start = None
    for size, near, own in placed:
        if start is not None and size - start[0] <= min(near, start[1]):
            runs[-1].append(own)
        else:
            start = size, near
            runs.append([own])
    return [run for run in runs if len(run) >= LIKE]


def ratio_words(run: Sequence[Wrong], words: Words) -> str:
    """What like answers have in common: their part of the right value."""
    sizes = [abs(m.answer.value or 0.0) / abs(m.expected) for _, m in run]
    return words("desk.same_ratio", times=words.significant(sum(sizes) / len(sizes), 3))
