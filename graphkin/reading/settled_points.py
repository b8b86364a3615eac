"""A person's decisions about points, kept as lines of a file: the last decision on a point counts.

Each line is written at once and never overwritten, so that closing the page or a crash loses no
decision.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from pathlib import Path

import msgspec
from msgspec import Struct
from msgspec.structs import replace

from graphkin.reading.point_reading import PointReading, ReadVerdict
from graphkin.reading.read_sheet import SheetRecord
from graphkin.text.errors import PageError, Problem, message

SETTLED = "decisions.jsonl"
MOST = 1 << 26
"""The most bytes of the file: some half a million decisions."""
LONGEST = 400
"""The most characters of a note."""


class PointDecision(Struct, frozen=True):
    """A person's decision about a point of a sheet: its place and its verdict.

    ``undo`` takes back the last decision that still counts.
    """

    sheet: str = ""
    step: int = 0
    verdict: ReadVerdict = "unread"
    at: tuple[float, float] | None = None
    note: str = ""
    undo: bool = False


Standing = Mapping[tuple[str, int], PointDecision]
"""The last decision on each point, by sheet and step."""


class SettledPoints:
    """The decisions of a folder of readings: read once, then appended line by line.

    Raises PageError for a file of more than ``MOST`` bytes.
    """

    def __init__(self, folder: Path) -> None:
        self.path = folder / SETTLED
        size = self.path.stat().st_size if self.path.exists() else 0
        if size > MOST:
            raise PageError(
                Problem(
                    str(self.path),
                    message("{size} bytes", size=size),
                    message("at most {most} bytes", most=MOST),
                    message("move the file away; the decisions in it must then be made again"),
                )
            )
        data = self.path.read_bytes() if size else b""
        self.whole = data.rfind(b"\n") + 1
        self.lines: list[PointDecision] = []
        for line in data[: self.whole].splitlines():
            try:
                self.take(msgspec.json.decode(line, type=PointDecision))
            except msgspec.MsgspecError:
                continue

    def take(self, decision: PointDecision) -> None:
        """Apply a decision: record it, or undo the last recorded one."""
        if not decision.undo:
            self.lines.append(decision)
        elif self.lines:
            self.lines.pop()

    def add(self, decision: PointDecision) -> None:
        """Write a decision to the file, then apply it."""
        with self.path.open("ab") as stream:
            stream.truncate(self.whole)  # the incomplete line of a run that was killed
            line = msgspec.json.encode(decision) + b"\n"
            stream.write(line)
            stream.flush()
            os.fsync(stream.fileno())
        self.whole += len(line)
        self.take(decision)

    @property
    def standing(self) -> Standing:
        """The last decision on each point, by sheet and step."""
        return {(each.sheet, each.step): each for each in self.lines}


def settled_points(record: SheetRecord, standing: Standing) -> tuple[PointReading, ...]:
    """The points of a sheet with the decisions applied; a decided point has no question."""
    found = []
    for point in record.points:
        decision = standing.get((record.name, point.step))
        if decision is None:
            found.append(point)
        else:
            found.append(replace(point, at=decision.at, verdict=decision.verdict, ask=False))
    return tuple(found)


def latest_of(
    records: Iterable[SheetRecord], standing: Standing
) -> dict[tuple[str, str], SheetRecord]:
    """The record that counts for each sheet, by code and kind.

    If a sheet was photographed more than once, that is the record with decisions, else the one with
    the fewest questions.
    """
    decided = {sheet for sheet, _ in standing}
    found: dict[tuple[str, str], SheetRecord] = {}

    def rank(record: SheetRecord) -> tuple[bool, int, str]:
        return record.name not in decided, sum(p.ask for p in record.points), record.name

    for record in records:
        if record.refused is None:
            place = record.code, record.kind
            other = found.get(place)
            if other is None or rank(record) < rank(other):
                found[place] = record
    return found
