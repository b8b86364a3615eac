"""The marking desk: a local page on which a person decides about the points of drawings.

The desk reads the records and pictures of one folder and writes one file of decisions into it.
"""

from __future__ import annotations

from pathlib import Path
from threading import Lock
from typing import Any

import msgspec
from msgspec import Struct

from graphkin.reading.kept_readings import PICTURE, records_in
from graphkin.reading.point_reading import VERDICTS
from graphkin.reading.read_sheet import SHOWN, SheetRecord
from graphkin.reading.settled_points import LONGEST, PointDecision, SettledPoints, settled_points
from graphkin.studio.local_pages import JSON, answer, answering, new_application
from graphkin.studio.session import PageRequestError
from graphkin.text import Words
from graphkin.text.markup import as_text
from graphkin.writers.templates import from_template

HERE = Path(__file__).parent / "web"
MOST_BYTES = 16 * 1024
SAID = (
    "title", "open", "none_open", "point", "verdict", "off", "note", "right", "follows", "wrong",
    "missing", "unread", "next", "undo", "key", "flicker", "by_keys", "refused", "saved", "failed",
    "sheets", "help",
)  # fmt: skip
"""The sentences of the page."""


class DeskSession(Struct, dict=True):
    """The readings of a folder and the decisions on them; one request at a time."""

    folder: Path
    words: Words

    def __post_init__(self) -> None:
        self.records = {each.name: each for each in records_in(self.folder)}
        self.settled = SettledPoints(self.folder)
        self.lock = Lock()

    def sheets(self) -> list[dict[str, Any]]:
        """All sheets with their current decisions; refused sheets come last."""
        with self.lock:
            standing = self.settled.standing
            read = sorted(self.records.values(), key=lambda each: each.refused is not None)
            return [self.told(each, standing) for each in read]

    def told(self, record: SheetRecord, standing: Any) -> dict[str, Any]:
        """A sheet in the form that the page expects."""
        points = [
            msgspec.to_builtins(each, enc_hook=as_text) for each in settled_points(record, standing)
        ]
        for point in points:
            decision = standing.get((record.name, point["step"]))
            point["note"] = decision.note if decision else ""
            point["decided"] = decision is not None
        return {
            "name": record.name,
            "code": record.code,
            "who": record.who,
            "kind": self.words(f"sheet.{record.kind}") if record.kind else "",
            "size": record.size,
            "refused": record.refused,
            "lines": record.key_lines,
            "points": points,
        }

    def decide(self, data: bytes) -> dict[str, Any]:
        """Record a decision. Raises PageRequestError for an unknown point or invalid decision."""
        try:
            decision = msgspec.json.decode(data, type=PointDecision)
        except msgspec.MsgspecError as error:
            raise PageRequestError(str(error)) from None
        record = self.records.get(decision.sheet)
        steps = {point.step for point in record.points} if record is not None else set()
        on_paper = decision.at is None or (
            record is not None
            and 0 <= decision.at[0] <= record.size[0]
            and 0 <= decision.at[1] <= record.size[1]
        )
        drawn = (decision.at is None) == (decision.verdict in ("missing", "unread"))
        known = decision.step in steps and len(decision.note) <= LONGEST
        if record is None or decision.undo or not (known and on_paper and drawn):
            raise PageRequestError("no such point, or a place that does not go with the verdict")
        with self.lock:
            self.settled.add(decision)
            return self.told(record, self.settled.standing)

    def undo(self) -> dict[str, Any]:
        """Undo the last decision; returns the sheet that it was on, or {} where there is none."""
        with self.lock:
            if not self.settled.lines:
                return {}
            last = self.settled.lines[-1]
            self.settled.add(PointDecision(undo=True))
            record = self.records.get(last.sheet)
            if record is None:
                return {}
            return {**self.told(record, self.settled.standing), "step": last.step}

    def picture(self, name: str) -> bytes:
        """The flattened picture of a sheet. Raises PageRequestError where there is none."""
        if name not in self.records or self.records[name].refused is not None:
            raise PageRequestError(name)
        return (self.folder / f"{name}{PICTURE}").read_bytes()


def desk_page(session: DeskSession) -> bytes:
    """The HTML page in the session's language."""
    words = session.words
    said = {key: words.open(f"desk.{key}") for key in SAID}
    start = {"said": said, "verdicts": VERDICTS, "density": SHOWN}
    text = msgspec.json.encode(start, enc_hook=as_text).decode()
    page = from_template("reading/web/desk.html", said=said, language=words.language, start=text)
    return f"{page}\n".encode()


def desk_application(session: DeskSession) -> Any:
    """The WSGI application of a desk."""

    def picture(name: str) -> Any:
        try:
            return answer(200, "image/jpeg", session.picture(name))
        except (PageRequestError, OSError):
            return answer(404, "text/plain", b"no such picture\n")

    encoded = msgspec.json.Encoder(enc_hook=as_text).encode
    app = new_application(HERE)
    app.route("/", "GET", lambda: answer(200, "text/html", desk_page(session)))
    app.route("/sheets", "GET", lambda: answer(200, JSON, encoded(session.sheets())))
    app.route("/picture/<name>.jpg", "GET", picture)
    app.route("/decide", "POST", answering(lambda data: encoded(session.decide(data)), MOST_BYTES))
    app.route("/undo", "POST", answering(lambda _: encoded(session.undo()), MOST_BYTES))
    return app
