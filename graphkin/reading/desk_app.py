"""The marking desk: one local page on which a person decides what a class leaves open.

The desk reads a folder of readings, a report, or a report with its readings. It appends each
decision to a file in the folder, so that several people can decide at once.
"""

from __future__ import annotations

from collections.abc import Callable
from datetime import UTC, datetime
from pathlib import Path
from threading import Lock
from typing import Any

import msgspec
from msgspec import Struct

from graphkin.classroom.grading.kept_marks import KEPT_MARKS, read_kept_marks
from graphkin.reading.desk_drawings import DrawingDesk
from graphkin.reading.desk_marks import MarkDesk
from graphkin.reading.desk_queue import KINDS
from graphkin.reading.kept_readings import READING
from graphkin.reading.point_reading import VERDICTS
from graphkin.reading.read_sheet import SHOWN
from graphkin.studio.local_pages import JSON, answer, answering, new_application
from graphkin.studio.session import PageRequestError
from graphkin.text import Words
from graphkin.text.errors import PageError, Problem, message
from graphkin.text.markup import as_text
from graphkin.writers.templates import from_template

HERE = Path(__file__).parent / "web"
MOST_BYTES = 16 * 1024
SAID = (
    "title", "open", "none_open", "point", "verdict", "off", "note", "right", "follows", "wrong",
    "missing", "unread", "next", "undo", "key", "flicker", "by_keys", "refused", "saved",
    "failed", "gone", "sheets", "help", "pin", "pins", "rivals", "reason", "points", "reading",
    "remark", "decided", "disagree", "marks_by_keys", "pin_help", "to_decide",
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

    def picture(name: str) -> Any:
        try:
            if session.drawings is not None:
                return answer(200, "image/jpeg", session.drawings.picture(name))
        except (PageRequestError, OSError):
            pass
        return answer(404, "text/plain", b"no such picture\n")

    def item(name: str) -> Any:
        try:
            return answer(200, JSON, encoded(session.item(name)))
        except PageRequestError:
            return answer(404, "text/plain", b"no such thing to decide\n")

    encoded = msgspec.json.Encoder(enc_hook=as_text).encode
    app = new_application(HERE)
    app.route("/", "GET", lambda: answer(200, "text/html", desk_page(session)))
    app.route("/everything", "GET", lambda: answer(200, JSON, encoded(session.everything())))
    app.route("/picture/<name>.jpg", "GET", picture)
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
