"""The desk's part about drawings: a person decides about points, and pins remarks to places."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import msgspec
from msgspec import Struct
from msgspec.structs import replace

from graphkin.drawing.field import A3, SheetPaper
from graphkin.drawing.frame import STUDENT, TitleBlock, cells_of
from graphkin.reading.kept_readings import PICTURE, records_in
from graphkin.reading.point_reading import PointReading
from graphkin.reading.read_sheet import QUALITY, SHOWN, SheetRecord
from graphkin.reading.settled_points import LONGEST, PointDecision, SettledPoints, settled_points
from graphkin.studio.session import PageRequestError
from graphkin.text import Words
from graphkin.text.markup import as_text


class DrawingDesk(Struct, dict=True):
    """The readings of a folder and the decisions on them.

    ``anonymous`` hides whose the sheets are: their names are numbers, and the name that is printed
    on a sheet is covered.
    """

    folder: Path
    words: Words
    marker: str = ""
    anonymous: bool = False

    def __post_init__(self) -> None:
        self.records = {each.name: each for each in records_in(self.folder)}
        self.shown = {name: name for name in self.records}
        if self.anonymous:
            every = sorted(self.records.values(), key=lambda each: (each.code, each.kind))
            self.records = {each.name: each for each in every}
            self.shown = {name: str(i) for i, name in enumerate(self.records, 1)}
        self.named = {shown: name for name, shown in self.shown.items()}
        self.settled = SettledPoints(self.folder)

    def sheets(self) -> list[dict[str, Any]]:
        """All sheets with their current decisions; refused sheets come last."""
        read = sorted(self.records.values(), key=lambda each: each.refused is not None)
        return [self.shown_sheet(each) for each in read]

    def being_decided(self, since: str) -> set[str]:
        """The codes of students whose sheets have open points, or points decided ``since``."""
        standing = self.settled.standing
        late = {sheet for (sheet, _), each in standing.items() if each.when > since}
        return {
            record.code
            for name, record in self.records.items()
            if name in late or any(point.ask for point in settled_points(record, standing))
        }

    def shown_sheet(self, record: SheetRecord) -> dict[str, Any]:
        """A sheet in the form that the page expects."""
        standing = self.settled.standing
        whole = () if record.cause is None else record.cause.sentences(self.words)
        return {
            "name": self.shown[record.name],
            "code": "" if self.anonymous else record.code,
            "who": "" if self.anonymous else record.who,
            "kind": self.words(f"sheet.{record.kind}") if record.kind else "",
            "size": (record.on.width, record.on.height),
            "refused": record.refused,
            "whole": " ".join(f"{each}." for each in whole),
            "lines": record.key_lines,
            "points": [
                self.point(each, standing.get((record.name, each.step)))
                for each in settled_points(record, standing)
            ],
            "pins": [{"at": each.at, "note": each.note} for each in self.settled.pins(record.name)],
            "known": self.settled.count,
        }

    def point(self, point: PointReading, decision: PointDecision | None) -> dict[str, Any]:
        """A point, with the decision on it and those of others who disagree."""
        every = () if decision is None else (*decision.rivals, decision)
        verdicts = (f"{self.words(f'desk.{each.verdict}')} ({each.by})" for each in every)
        return {
            **msgspec.to_builtins(point, enc_hook=as_text),
            "note": decision.note if decision else "",
            "decided": decision is not None and not decision.rivals,
            "rivals": ", ".join(verdicts) if len(every) > 1 else "",
        }

    def decide(self, data: bytes) -> dict[str, Any]:
        """Record a decision. Raises PageRequestError for an unknown point or invalid decision."""
        try:
            decision = msgspec.json.decode(data, type=PointDecision)
        except msgspec.MsgspecError as error:
            raise PageRequestError(str(error)) from None
        record = self.records.get(self.named.get(decision.sheet, ""))
        steps = {point.step for point in record.points} if record is not None else set()
        on_paper = decision.at is None or (
            record is not None
            and 0 <= decision.at[0] <= record.on.width
            and 0 <= decision.at[1] <= record.on.height
        )
        drawn = (decision.at is None) == (decision.verdict in ("missing", "unread"))
        pinned = decision.step is None and decision.at is not None and decision.verdict == "unread"
        known = pinned or (decision.step in steps and drawn)
        if record is None or decision.undo or not (known and on_paper):
            raise PageRequestError("no such point, or a place that does not go with the verdict")
        if len(decision.note) > LONGEST:
            raise PageRequestError(f"{len(decision.note)} > {LONGEST}")
        own = replace(decision, sheet=record.name, by=self.marker, rivals=(), when="")
        self.settled.add(own)
        return self.shown_sheet(record)

    def undo(self) -> dict[str, Any]:
        """Undo this marker's last decision; returns its sheet, or {} where there is none."""
        last = self.settled.last_of(self.marker)
        if last is None:
            return {}
        self.settled.add(PointDecision(by=self.marker, undo=True))
        record = self.records.get(last[1].sheet)
        return {} if record is None else {**self.shown_sheet(record), "step": last[1].step}

    def picture(self, shown: str) -> bytes:
        """The flattened picture of a sheet. Raises PageRequestError where there is none."""
        record = self.records.get(self.named.get(shown, ""))
        if record is None or record.refused is not None:
            raise PageRequestError(shown)
        data = (self.folder / f"{record.name}{PICTURE}").read_bytes()
        return without_name(data, record.on) if self.anonymous else data


def without_name(picture: bytes, paper: SheetPaper = A3) -> bytes:
    """A flattened picture on which the student's cell of each title block is covered."""
    from PIL import Image, ImageDraw

    block = TitleBlock(labels={STUDENT: ""}, frame=paper.frame)
    cell = next(rect for name, rect, _ in cells_of(block) if name == STUDENT)
    image = Image.open(io.BytesIO(picture)).convert("RGB")
    pen = ImageDraw.Draw(image)
    for left, top, _, _ in paper.blocks:
        sides = zip(cell, (left, top, left, top), strict=True)
        pen.rectangle([(part + side) * SHOWN for part, side in sides], "white", "black")
    out = io.BytesIO()
    image.save(out, "JPEG", quality=QUALITY)
    return out.getvalue()
