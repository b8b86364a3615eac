"""One file of lines to which several people append: nothing in it is ever overwritten.

Each line is written under the folder's lock, after the lines of others were read. Two people who
decide differently without seeing each other's line disagree, until one of them decides again.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Generic, TypeVar

import msgspec
from msgspec import Struct
from msgspec.structs import replace

from graphkin.text.errors import PageError, message
from graphkin.writers.commit import PATIENCE, locked

MOST = 1 << 26
"""The most bytes of the file: some half a million lines."""


class SharedLine(Struct, frozen=True, kw_only=True, omit_defaults=True):
    """A line of a shared file: by whom, and when (UTC).

    ``seen`` is the number of lines that its writer had read; None for a writer who had the file
    alone. ``undo`` takes back the writer's last line that still counts.
    """

    by: str = ""
    when: str = ""
    seen: int | None = None
    undo: bool = False


L = TypeVar("L", bound=SharedLine)
Targets = Callable[[L], Iterable[tuple[Any, Any]]]
"""What a line decides: pairs of a target and of what is said about it."""


class Said(Struct, Generic[L], frozen=True):
    """What was said about a target, by whom, and in which line."""

    number: int
    line: L
    what: Any


class SharedLines(Generic[L]):
    """The lines of a file: read as far as they are complete, then appended one by one.

    Raises PageError for a file of more than ``MOST`` bytes.
    """

    def __init__(self, path: Path, kind: type[L], targets: Targets[L]) -> None:
        self.path, self.kind, self.targets = path, kind, targets
        self.whole = self.count = 0
        self.numbered: list[tuple[int, L]] = []
        self.replayed: dict[Any, tuple[Said[L], ...]] | None = None
        self.refresh()

    @property
    def lines(self) -> list[L]:
        """The lines that count, in order."""
        return [line for _, line in self.numbered]

    def refresh(self) -> bool:
        """Read what others have appended; whether there was anything."""
        size = self.path.stat().st_size if self.path.exists() else 0
        if size > MOST:
            raise PageError.at(
                str(self.path),
                message("{size} bytes", size=size),
                message("at most {most} bytes", most=MOST),
                message("move the file away; the decisions in it must then be made again"),
            )
        before = self.count
        if size < self.whole:  # somebody put another file in its place
            self.whole = self.count = 0
            self.numbered, self.replayed = [], None
        if size > self.whole:
            with self.path.open("rb") as stream:
                stream.seek(self.whole)
                data = stream.read()
            end = data.rfind(b"\n") + 1
            for line in data[:end].splitlines():
                self.count += 1
                self.take(line)
            self.whole += end
        return self.count != before

    def take(self, data: bytes) -> None:
        """Apply a line: keep it, or take back its writer's last one. Skips unreadable lines."""
        try:
            line = msgspec.json.decode(data, type=self.kind, dec_hook=exact)
        except (msgspec.MsgspecError, ValueError):
            return
        self.replayed = None
        if not line.undo:
            self.numbered.append((self.count, line))
        elif (last := self.last_of(line.by)) is not None:
            self.numbered.remove(last)

    def last_of(self, by: str) -> tuple[int, L] | None:
        """The last line of a writer that counts; None where there is none."""
        return next((each for each in reversed(self.numbered) if each[1].by == by), None)

    def add(self, line: L) -> None:
        """Append a line, after those of others. Raises InUseError where the folder stays locked."""
        now = datetime.now(UTC).isoformat(timespec="milliseconds")
        data = msgspec.json.encode(replace(line, when=line.when or now), enc_hook=str) + b"\n"
        with locked(self.path.parent, PATIENCE):
            self.refresh()
            with self.path.open("ab") as stream:
                stream.truncate(self.whole)  # the incomplete line of a run that was killed
                stream.write(data)
                stream.flush()
                os.fsync(stream.fileno())
            self.refresh()

    @property
    def decided(self) -> Mapping[Any, tuple[Said[L], ...]]:
        """What counts for each target: one statement, or those of writers who disagree."""
        if self.replayed is not None:
            return self.replayed
        found: dict[Any, tuple[Said[L], ...]] = {}
        for number, line in self.numbered:
            for target, what in self.targets(line):
                found[target] = (
                    *(each for each in found.get(target, ()) if disagree(each, line, what)),
                    Said(number, line, what),
                )
        self.replayed = found
        return found


def exact(kind: type, text: object) -> object:
    """A number that is exact, from text."""
    return kind(text)


def disagree(other: Said[Any], line: SharedLine, what: Any) -> bool:
    """Whether a line says something else than another writer's, which its own had not seen."""
    unseen = line.seen is not None and other.number > line.seen
    return unseen and other.line.by != line.by and other.what != what
