"""The marking desk: one local page on which a person decides what a class leaves open.

The desk reads a folder of readings, a report, or a report with its readings. It appends each
decision to a file in the folder, so that several people can decide at once.

The desk's part about drawings: a person decides about points, and pins remarks to places.
"""

from __future__ import annotations

import io
from collections.abc import Callable
from datetime import UTC, datetime
from pathlib import Path
from threading import Lock
from typing import Any

import msgspec
from msgspec import Struct
from msgspec.structs import replace

from graphkin.classroom.grading.grading_files import KEPT_MARKS, read_kept_marks
from graphkin.drawing.field import A3, SheetPaper
from graphkin.drawing.frame import STUDENT, TitleBlock, cells_of
from graphkin.drawing.symbol_markup import symbol
from graphkin.reading.desk_marks import MarkDesk
from graphkin.reading.desk_queue import KINDS
from graphkin.reading.point_reading import VERDICTS, PointReading
from graphkin.reading.read_sheet import QUALITY, SHOWN, SheetRecord
from graphkin.reading.settled_points import (
    LONGEST,
    PICTURE,
    READING,
    PointDecision,
    SettledPoints,
    records_in,
    settled_points,
)
from graphkin.studio.server import JSON, answer, answering, new_application
from graphkin.studio.session import PageRequestError
from graphkin.text import Words, as_text
from graphkin.text.errors import PageError, Problem, message
from graphkin.writers.templates import from_template, marked_up


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
            "symbol": marked_up(symbol(point.name, signs=self.words.signs)),
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


HERE = Path(__file__).parent / "web"
MOST_BYTES = 16 * 1024
SAID = (
    "title", "open", "none_open", "point", "verdict", "off", "note", "right", "follows", "wrong",
    "missing", "unread", "next", "undo", "key", "flicker", "by_keys", "refused", "saved",
    "failed", "gone", "sheets", "help", "pin", "pins", "rivals", "reason", "points", "reading",
    "remark", "decided", "disagree", "marks_by_keys", "pin_help", "to_decide",
    "cut_out",
    *(f"kind_{kind}" for kind in KINDS),
)  # fmt: skip
"""The sentences of the page."""


class DeskSession(Struct, dict=True):
    """A folder at the desk: the drawings of its readings, and the marks of its report.

    ``marker`` is who decides. Raises PageError for a folder with neither.
    """

    folder: Path
    words: Words
    marker: str = ""
    anonymous: bool = False

    def __post_init__(self) -> None:
        report = read_kept_marks(self.folder)
        readings = self.folder
        if report is not None and report.readings:
            readings = self.folder / report.readings
        self.readings = readings
        how = self.words, self.marker, self.anonymous
        drawn = readings.is_dir() and any(readings.glob(f"*{READING}"))
        self.drawings = DrawingDesk(readings, *how) if drawn else None
        self.marks = MarkDesk(self.folder, report, *how) if report is not None else None
        if not drawn and report is None:
            found = message("holds neither readings nor {file}", file=KEPT_MARKS)
            hint = message("graphkin read CLASS PHOTOS -o DIR or graphkin grade makes it")
            expected = message("a folder of graphkin read or graphkin grade")
            raise PageError(Problem(str(self.folder), found, expected, hint))
        self.lock = Lock()

    def everything(self) -> dict[str, Any]:
        """All sheets and all else to decide, after the lines of others were read."""
        with self.lock:
            return self.overview()

    def overview(self) -> dict[str, Any]:
        """All sheets, and a line for each other thing to decide."""
        drawings, marks = self.drawings, self.marks
        if drawings is not None:
            drawings.settled.refresh()
        if marks is not None:
            marks.rulings.refresh()
        return {
            "count": self.count(),
            "sheets": [] if drawings is None else drawings.sheets(),
            "items": self.listed(),
        }

    def listed(self) -> list[dict[str, Any]]:
        """A line for each thing to decide about marks."""
        if self.marks is None:
            return []
        if self.drawings is None:
            return self.marks.listed()
        written = (self.folder / KEPT_MARKS).stat().st_mtime
        since = datetime.fromtimestamp(written, UTC).isoformat(timespec="milliseconds")
        return self.marks.listed(self.drawings.being_decided(since))

    def problems(self) -> tuple[Problem, ...]:
        """What is wrong with rows of appeals."""
        if self.marks is None:
            return ()
        self.marks.items()
        return self.marks.problems

    def count(self) -> list[int]:
        """The number of lines in each file: it grows with each decision of anybody."""
        parts = (
            None if self.drawings is None else self.drawings.settled,
            None if self.marks is None else self.marks.rulings,
        )
        return [0 if part is None else part.count for part in parts]

    def news(self, data: bytes) -> dict[str, Any]:
        """Everything again, if anybody decided since the page had ``data`` (a count); else {}."""
        try:
            known = msgspec.json.decode(data, type=list[int])
        except msgspec.MsgspecError as error:
            raise PageRequestError(str(error)) from None
        with self.lock:
            found = self.overview()
            return {} if found["count"] == known else found

    def item(self, name: str) -> dict[str, Any]:
        """One thing to decide about marks."""
        with self.lock:
            return self.of_marks().shown(name)

    def picture(self, name: str) -> bytes:
        """The flattened picture of a sheet. Raises PageRequestError where there is none."""
        if self.drawings is None:
            raise PageRequestError(name)
        return self.drawings.picture(name)

    def cut_out(self, name: str) -> bytes:
        """The picture of a handwritten cell. Raises PageRequestError where there is none."""
        with self.lock:
            item = self.of_marks().item(name)
        if not item.cut_out or Path(item.cut_out).name != item.cut_out:
            raise PageRequestError(name)
        return (self.readings / item.cut_out).read_bytes()

    def of_marks(self) -> MarkDesk:
        """The part about marks. Raises PageRequestError where the folder has none."""
        if self.marks is None:
            raise PageRequestError(KEPT_MARKS)
        return self.marks

    def decide(self, data: bytes) -> dict[str, Any]:
        """Record a decision about a point of a drawing."""
        with self.lock:
            if self.drawings is None:
                raise PageRequestError(READING)
            return self.drawings.decide(data)

    def rule(self, data: bytes) -> dict[str, Any]:
        """Record a decision about marks."""
        with self.lock:
            return self.of_marks().decide(data) | {"items": self.listed()}

    def remark(self, data: bytes) -> dict[str, Any]:
        """Record a remark on a row."""
        with self.lock:
            return self.of_marks().remark(data)

    def undo(self) -> dict[str, Any]:
        """Undo this marker's last decision: the sheet or the name of the item that it was about."""
        with self.lock:
            drawings, marks = self.drawings, self.marks
            drawn = None if drawings is None else drawings.settled.last_of(self.marker)
            ruled = None if marks is None else marks.rulings.last_of(self.marker)
            if marks is not None and ruled and (not drawn or ruled[1].when > drawn[1].when):
                return {"item": marks.undo(), "items": self.listed()}
            return {} if drawings is None else drawings.undo()


def desk_page(session: DeskSession) -> bytes:
    """The HTML page in the session's language."""
    words = session.words
    said = {key: words.open(f"desk.{key}") for key in SAID}
    said["student"] = words("studio.student")
    start = {"said": said, "verdicts": VERDICTS, "density": SHOWN, "kinds": KINDS}
    text = msgspec.json.encode(start, enc_hook=as_text).decode()
    page = from_template("reading/web/desk.html", said=said, language=words.language, start=text)
    return f"{page}\n".encode()


def desk_application(session: DeskSession) -> Any:
    """The WSGI application of a desk."""

    def shown(picture: Callable[[str], bytes]) -> Callable[[str], Any]:
        def handler(name: str) -> Any:
            try:
                return answer(200, "image/jpeg", picture(name))
            except (PageRequestError, OSError):
                return answer(404, "text/plain", b"no such picture\n")

        return handler

    def item(name: str) -> Any:
        try:
            return answer(200, JSON, encoded(session.item(name)))
        except PageRequestError:
            return answer(404, "text/plain", b"no such thing to decide\n")

    encoded = msgspec.json.Encoder(enc_hook=as_text).encode
    app = new_application(HERE)
    app.route("/", "GET", lambda: answer(200, "text/html", desk_page(session)))
    app.route("/everything", "GET", lambda: answer(200, JSON, encoded(session.everything())))
    app.route("/picture/<name>.jpg", "GET", shown(session.picture))
    app.route("/cut-out/<name>.jpg", "GET", shown(session.cut_out))
    app.route("/item/<name>", "GET", item)
    works: dict[str, Callable[[bytes], dict[str, Any]]] = {
        "/news": session.news,
        "/decide": session.decide,
        "/rule": session.rule,
        "/remark": session.remark,
        "/undo": lambda _: session.undo(),
    }

    def handler(work: Callable[[bytes], dict[str, Any]]) -> Callable[[], Any]:
        return answering(lambda data: encoded(work(data)), MOST_BYTES)

    for path, work in works.items():
        app.route(path, "POST", handler(work))
    return app
