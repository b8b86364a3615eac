"""The desk's part about answers: cells, appeals, suspects, sheets and clusters of answers."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any

import msgspec
from msgspec import Struct
from msgspec.structs import replace

from graphkin.classroom.grading.answer_numbers import OPEN, read_answer
from graphkin.classroom.grading.decisions import AMOUNT, LONGEST, with_decisions
from graphkin.classroom.grading.desk_rulings import (
    AnyRuling,
    Appeal,
    DeskAct,
    DeskRulings,
    LeaveMark,
    Place,
    ReadAs,
    Remark,
    SetPoints,
    read_appeals,
)
from graphkin.classroom.grading.feedback import (
    COLUMNS,
    HEADS,
    cause_sentence,
    decision_words,
    points_words,
    row_of,
)
from graphkin.classroom.grading.graded import Decision, EarnedMark, Graded, Status
from graphkin.classroom.grading.grading_files import KeptReport
from graphkin.classroom.roster.students import signs
from graphkin.reading.desk_queue import DeskItem, DeskQueue
from graphkin.studio.session import PageRequestError
from graphkin.text import Words
from graphkin.text.errors import Problem
from graphkin.writers.shared_lines import Said
from graphkin.writers.templates import marked_up


class DeskRequest(Struct, frozen=True, forbid_unknown_fields=True):
    """What a marker decides about an item: one of its choices, or points, or a reading.

    ``known`` is the number of lines of the file that the page has seen.
    """

    item: str
    known: int
    choice: int | None = None
    points: str = ""
    reading: str | None = None
    reason: str = ""


class RemarkRequest(Struct, frozen=True, forbid_unknown_fields=True):
    """A remark on a row of an item, by the row's number; None for the whole form."""

    item: str
    known: int
    row: int
    text: str


class MarkDesk(Struct, dict=True):
    """The marks of a report's folder and the decisions on them; one request at a time."""

    folder: Path
    report: KeptReport
    words: Words
    marker: str = ""
    anonymous: bool = False

    def __post_init__(self) -> None:
        self.rulings = DeskRulings(self.folder)
        graded = {each.taker.student.id: each for each in self.report.graded}
        named = self.words("studio.student")
        names = {
            who: f"{named} {place}" if self.anonymous else each.taker.student.called
            for place, (who, each) in enumerate(
                sorted(graded.items(), key=lambda pair: pair[1].taker.code), 1
            )
        }
        if self.anonymous:  # the order of the class list would tell who is who
            graded = {who: graded[who] for who in names}
        self.queue = DeskQueue(self.report, graded, names, self.words)
        self.stamp: tuple[int, int] | None = None
        self.problems: tuple[Problem, ...] = ()
        self.known_items: dict[str, DeskItem] = {}

    def items(self) -> dict[str, DeskItem]:
        """Everything to decide, by name; read again where the appeals changed."""
        path = self.folder / "appeals.csv"
        stat = path.stat() if path.is_file() else None
        stamp = (stat.st_mtime_ns, stat.st_size) if stat else (0, 0)
        if stamp != self.stamp:
            self.stamp = stamp
            every = self.queue.items(self.appeals())
            self.known_items = {each.name: each for each in every}
        return self.known_items

    def appeals(self) -> Sequence[Appeal]:
        """The appeals in the folder."""
        takers = [each.taker for each in self.queue.graded.values()]
        ids = {taker.student.id: taker for taker in takers}
        known = signs(
            ids,
            {who: taker.code for who, taker in ids.items()},
            {who: taker.email for who, taker in ids.items()},
            {who: taker.student.name for who, taker in ids.items()},
        )
        fields = {who: [f for _, f in self.queue.whole(who)] for who in ids}
        found = read_appeals(self.folder, known, fields)
        self.problems = found.problems
        return found.every

    # --- what the page shows ----------------------------------------------------------------------

    def listed(self, drawn: Collection[str] = ()) -> list[dict[str, Any]]:
        """A line for each thing to decide: its name, kind, title and state.

        The open cells of students whose drawings are still being decided (``drawn``, by their
        codes) are left out: the next marking fills them in.
        """
        return [
            {"name": name, "kind": each.kind, "title": each.title, "state": self.state(each)}
            for name, each in self.items().items()
            if not (
                self.is_drawn(each) and self.queue.graded[each.places[0][0]].taker.code in drawn
            )
        ]

    def is_drawn(self, item: DeskItem) -> bool:
        """Whether an item is a field that a drawing leaves open."""
        return item.own == OPEN and not item.cut_out

    def state(self, item: DeskItem) -> str:
        """Whether an item is ``open``, ``decided``, or people ``disagree`` on it."""
        said_by_place = [list(self.about(item, place)) for place in item.places]
        if any(len(said) > 1 for each in said_by_place for said in each):
            return "disagree"
        table = (self.of_table(place) for place in item.places)
        settled = (
            any(each) or (decision is not None and not decision.is_open)
            for each, decision in zip(said_by_place, table, strict=True)
        )
        return "decided" if all(settled) else "open"

    def about(self, item: DeskItem, place: Place) -> Iterator[tuple[Said[DeskAct], ...]]:
        """What counts about a place of an item: rulings on its mark, and on its cell."""
        said = self.rulings.about(SetPoints, place)
        if item.kind != "appeal" or (said and said[-1].what.asked == item.own):
            yield said
        if item.kind == "cell":
            yield self.rulings.about(ReadAs, place)

    def of_table(self, place: Place) -> Decision | None:
        """The decision of ``decisions.csv`` on a place."""
        graded = self.queue.graded[place[0]]
        found = graded.mark(place[1]).decision if place[1] else graded.decision
        return None if found is None or found.at_desk else found

    def shown(self, name: str) -> dict[str, Any]:
        """One thing to decide, with its rows and choices. Raises PageRequestError if unknown."""
        item, words = self.item(name), self.words
        most = {points_words(self.most(place), words) for place in item.places}
        return {
            "name": name,
            "kind": item.kind,
            "title": item.title,
            "state": self.state(item),
            "told": item.reason,
            "sums": self.sums(item),
            "causes": self.causes(item),
            "heads": [words((HEADS | {"yours": "desk.answer"})[each]) for each in COLUMNS],
            "rows": [self.row(place) for place in item.shown],
            "choices": [each.said for each in item.choices],
            "reads": item.own if item.kind == "cell" and item.own else None,
            "cut_out": bool(item.cut_out),
            "most": most.pop() if len(most) == 1 else "",
            "decided": self.decided(item),
            "known": self.rulings.count,
        }

    def item(self, name: str) -> DeskItem:
        """The item of a name. Raises PageRequestError where there is none."""
        found = self.items().get(name)
        if found is None:
            raise PageRequestError(name)
        return found

    def most(self, place: Place) -> Fraction:
        """The most points of a field, or of the whole form."""
        graded = self.queue.graded[place[0]]
        return graded.mark(place[1]).points if place[1] else graded.points

    def row(self, place: Place) -> dict[str, Any]:
        """A field as the student's feedback shows it, as browser markup, with the remark on it."""
        graded = self.queue.graded[place[0]]
        mark = graded.mark(place[1])
        found = replace(graded, remarks={})
        feedback_row = row_of(found, undecided(mark), self.words, for_marker=True)
        (remark,) = self.rulings.about(Remark, place)[-1:] or (None,)
        table = self.of_table(place)
        return {
            "who": self.queue.names[place[0]],
            "cells": [marked_up(cell) for cell in feedback_row.cells],
            "why": marked_up(feedback_row.why),
            "status": feedback_row.status.value,
            "table": marked_up(decision_words(table, self.words)) if table is not None else "",
            "remark": remark.what.text if remark is not None else "",
        }

    def sums(self, item: DeskItem) -> list[str]:
        """What each student of an item earns on the whole form, with what the desk decided."""
        if item.kind not in ("appeal", "suspects", "sheet"):
            return []
        found = []
        for who in dict.fromkeys(who for who, _ in item.places):
            graded = self.ruled(who)
            earned, most = (points_words(p, self.words) for p in (graded.earned, graded.points))
            said: str = self.words("desk.sum", points=earned, most=most)
            cost = graded.cost if graded.decision is None or graded.decision.points is None else 0
            if cost:
                also = self.words("desk.deducted", points=points_words(graded.cost, self.words))
                said = f"{said}, {also}"
            found.append(f"{self.queue.names[who]}: {said}" if len(item.places) > 1 else said)
        return found

    def ruled(self, who: str) -> Graded:
        """A student's marks with what counts at present of the table and the desk."""
        graded = found_only(self.queue.graded[who])
        places = [(who, mark.item.field) for mark in graded.marks] + [(who, "")]
        decisions = [d for place in places if (d := self.decision(place)) is not None]
        return with_decisions(graded, decisions)

    def decision(self, place: Place) -> Decision | None:
        """What counts about a place: the table's decision, else the desk's if people agree."""
        table = self.of_table(place)
        said = self.rulings.about(SetPoints, place)
        if len(said) != 1 or (table is not None and not table.is_open):
            return table
        ruling = said[0].what
        points = ruling.points if isinstance(ruling, SetPoints) else None
        return Decision(*place, points, getattr(ruling, "reason", ""), at_desk=True)

    def causes(self, item: DeskItem) -> list[str]:
        """The causes that explain an appeal's sheet or a row that is shown, as browser markup."""
        found: dict[str, None] = {}
        for who, name in (*item.places, *item.shown):
            graded = self.queue.graded[who]
            explained = name and graded.mark(name).status is Status.CAUSE
            if item.kind == "appeal" or explained:
                found |= dict.fromkeys(cause_sentence(each, self.words) for each in graded.causes)
        return [marked_up(each) for each in found]

    def decided(self, item: DeskItem) -> list[str]:
        """What was decided about an item, by whom; each sentence once."""
        found: dict[str, None] = {}
        for place in item.places:
            table = self.of_table(place)
            if table is not None and not table.is_open:
                found[f"decisions.csv: {self.words('desk.by_table', reason=table.reason)}"] = None
            earlier = self.rulings.about(SetPoints, place) if item.kind == "appeal" else ()
            for said in (*self.about(item, place), earlier):
                for each in said:
                    found[self.said(each, len(item.places) > 1)] = None
        return list(found)

    def said(self, each: Said[DeskAct], several: bool) -> str:
        """A ruling in words, with its marker."""
        ruling: AnyRuling = each.what
        who = f"{self.queue.names[ruling.who]}: " if several and not ruling.field else ""
        text: str = self.words("desk.stays")
        if isinstance(ruling, SetPoints):
            text = self.words("desk.earns", points=points_words(ruling.points, self.words))
        elif isinstance(ruling, ReadAs):
            read = self.words("desk.read_as", text=ruling.text)
            text = read if ruling.text else self.words("desk.no_answer")
        reason = getattr(ruling, "reason", "")
        text = f"{text}: {reason}" if reason else text
        return f"{who}{text} ({each.line.by})" if each.line.by else f"{who}{text}"

    # --- what the page decides --------------------------------------------------------------------

    def decide(self, data: bytes) -> dict[str, Any]:
        """Record a decision, all of it in one line. Raises PageRequestError where it is invalid."""
        asked = decoded(data, DeskRequest)
        item = self.item(asked.item)
        if any(each is not None and not each.is_open for each in map(self.of_table, item.places)):
            raise PageRequestError(self.words("desk.in_table"))
        if len(asked.reason) > LONGEST:
            raise PageRequestError(f"{len(asked.reason)} > {LONGEST}")
        rulings = tuple(with_reason(each, asked.reason) for each in self.wanted(item, asked))
        self.rulings.add(DeskAct(by=self.marker, seen=asked.known, rulings=rulings))
        return self.shown(asked.item)

    def wanted(self, item: DeskItem, asked: DeskRequest) -> tuple[AnyRuling, ...]:
        """The rulings of a request."""
        if asked.choice is not None:
            if not 0 <= asked.choice < len(item.choices):
                raise PageRequestError(str(asked.choice))
            return item.choices[asked.choice].rulings
        if asked.reading is not None and item.kind == "cell" and item.own:
            form = {each.field: each for each in self.report.form}
            if read_answer(asked.reading, form[item.places[0][1]]).problem:
                raise PageRequestError(self.words("desk.unreadable", text=asked.reading))
            read = ({"written": item.own, "text": asked.reading} for _ in item.places)
            return tuple(ReadAs(*at, **own) for at, own in zip(item.places, read, strict=True))
        most = min(map(self.most, item.places))
        points = Fraction(asked.points.replace(",", ".")) if AMOUNT.fullmatch(asked.points) else -1
        if not 0 <= points <= most:
            raise PageRequestError(
                self.words("desk.bad_points", most=points_words(most, self.words))
            )
        asked_by = item.own if item.kind == "appeal" else ""
        return tuple(
            SetPoints(*place, points=Fraction(points), asked=asked_by) for place in item.places
        )

    def remark(self, data: bytes) -> dict[str, Any]:
        """Record a remark on a row. Raises PageRequestError where it is invalid."""
        asked = decoded(data, RemarkRequest)
        item = self.item(asked.item)
        if not 0 <= asked.row < len(item.shown) or len(asked.text) > LONGEST:
            raise PageRequestError(str(asked.row))
        who, field = item.shown[asked.row]
        remark = Remark(who, field, asked.text.strip())
        self.rulings.add(DeskAct(by=self.marker, seen=asked.known, rulings=(remark,)))
        return self.shown(asked.item)

    def undo(self) -> str:
        """Take back this marker's last decision; returns the item that it was about, if listed."""
        last = self.rulings.last_of(self.marker)
        if last is None:
            return ""
        places = {each.place for each in last[1].rulings}
        self.rulings.add(DeskAct(by=self.marker, undo=True))
        exact = (n for n, each in self.items().items() if places == {*each.places})
        near = (n for n, each in self.items().items() if places & {*each.places, *each.shown})
        return next(exact, next(near, ""))


def undecided(mark: EarnedMark) -> EarnedMark:
    """A mark as it was found, without the decision on it."""
    decision = mark.decision
    if decision is None or decision.before is None:
        return replace(mark, decision=None)
    return replace(mark, decision=None, earned=decision.before)


def found_only(graded: Graded) -> Graded:
    """A student's marks as they were found, without decisions."""
    return replace(graded, marks=tuple(map(undecided, graded.marks)), decision=None)


def with_reason(ruling: AnyRuling, reason: str) -> AnyRuling:
    """A ruling with the marker's reason."""
    if isinstance(ruling, SetPoints | LeaveMark) and reason.strip():
        return replace(ruling, reason=reason.strip())
    return ruling


def decoded(data: bytes, kind: type[Any]) -> Any:
    """A request of the page. Raises PageRequestError for anything else."""
    try:
        return msgspec.json.decode(data, type=kind)
    except msgspec.MsgspecError as error:
        raise PageRequestError(str(error)) from None
