"""People's decisions about points of drawings, as lines of a file: the last on a point counts.

The folder of readings: a record and a flattened picture for each photograph.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

import msgspec
from msgspec.structs import replace

from graphkin.reading.point_reading import PointReading, ReadVerdict
from graphkin.reading.read_sheet import SheetRecord
from graphkin.scene.file_limits import whole_file
from graphkin.text.errors import PageError, Problem, message
from graphkin.writers.shared_lines import SharedLine, SharedLines

SETTLED = "decisions.jsonl"
LONGEST = 400
"""The most characters of a note."""


class PointDecision(SharedLine, frozen=True):
    """A person's decision about a point of a sheet: its place and its verdict.

    With ``step`` None it is a remark pinned to a place of the drawing; without a note, the pin is
    taken away. ``rivals`` are the decisions of others who disagree; they are never written.
    """

    sheet: str = ""
    step: int | None = 0
    verdict: ReadVerdict = "unread"
    at: tuple[float, float] | None = None
    note: str = ""
    rivals: tuple[PointDecision, ...] = ()


Standing = Mapping[tuple[str, int], PointDecision]
"""The last decision on each point, by sheet and step."""


class SettledPoints(SharedLines[PointDecision]):
    """The decisions of a folder of readings."""

    def __init__(self, folder: Path) -> None:
        super().__init__(folder / SETTLED, PointDecision, targets_of)

    @property
    def standing(self) -> Standing:
        """The last decision on each point, with those of others who disagree."""
        found = {}
        for (sheet, step, _), entries in self.decided.items():
            if step is not None:
                *others, last = (each.line for each in entries)
                found[sheet, step] = replace(last, rivals=tuple(others))
        return found

    def pins(self, sheet: str) -> list[PointDecision]:
        """The remarks pinned to a sheet, in the order in which they were made."""
        latest = [each[-1].line for each in self.decided.values()]
        return [d for d in latest if d.sheet == sheet and d.step is None and d.note]


def targets_of(line: PointDecision) -> Iterator[tuple[object, object]]:
    """What a decision is about, and what it says."""
    pin = line.at if line.step is None else None
    yield (line.sheet, line.step, pin), (line.verdict, line.at, line.note)


def settled_points(record: SheetRecord, standing: Standing) -> tuple[PointReading, ...]:
    """The points of a sheet with the decisions applied.

    A decided point has no question, unless people disagree about it.
    """
    found = []
    for point in record.points:
        decision = standing.get((record.name, point.step))
        if decision is None:
            found.append(point)
        else:
            ask = bool(decision.rivals)
            found.append(replace(point, at=decision.at, verdict=decision.verdict, ask=ask))
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


READING, PICTURE = ".reading.json", ".jpg"
"""The file name endings of a record and of its picture."""


def kept(out: Path, name: str) -> SheetRecord | None:
    """The record of a photograph in a folder; None where it is absent or incomplete."""
    try:
        data = whole_file(out / f"{name}{READING}")
        return msgspec.json.decode(data, type=SheetRecord)
    except (OSError, msgspec.MsgspecError):
        return None


def records_in(out: Path) -> list[SheetRecord]:
    """All records of a folder, by name. Raises PageError where the folder holds none."""
    names = sorted(path.name.removesuffix(READING) for path in out.glob(f"*{READING}"))
    found = [record for name in names if (record := kept(out, name)) is not None]
    if not found:
        hint = message("graphkin read CLASS PHOTOS -o DIR makes it")
        raise PageError(
            Problem(
                str(out), message("holds no reading"), message("a folder of graphkin read"), hint
            )
        )
    return found
