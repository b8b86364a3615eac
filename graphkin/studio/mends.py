"""The edits of a text that would correct a mistake, as far as its problem names them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from msgspec import Struct

from graphkin.scene.toml_spans import Path, Span, parts, walked
from graphkin.text.errors import (
    Change,
    DriverAdded,
    DriverTaken,
    FirstLine,
    Mend,
    PointRenamed,
    Problem,
    TakenOut,
    Written,
    WrittenInto,
)

MOST = 4
"""Largest number of corrections offered for one mistake."""
END_OF_LINE, END_OF_TABLE = re.compile(r"\n"), re.compile(r"\n\s*\[")


class Edit(Struct, frozen=True):
    """A piece of the text, counted as a browser does, and its replacement.

    ``name`` is the parameter, ``before`` the current value.
    """

    start: int
    end: int
    text: str
    name: str = ""
    before: str = ""


def units(text: str) -> int:
    """The length of a text as a browser counts it."""
    return len(text.encode("utf-16-le", "surrogatepass")) // 2


def mends_of(problem: Problem, text: str, span: Span | None) -> list[Edit]:
    """Edits, each of which would correct a problem at a span; the most likely come first."""
    if isinstance(problem.hint, Mend):
        own = None if span is None else corrected(problem.hint, text, span)
        return [] if own is None else [own]
    walk = walked(text)
    lines = Lines(text, walk.found, walk.values)
    made = (edit for change in problem.changes for edit in lines.changed_by(change, problem))
    return list(dict.fromkeys(made))[:MOST]


def corrected(hint: Mend, text: str, span: Span) -> Edit | None:
    """The edit that a hint proposes, in the lines of its span or of its table.

    None where the piece to change does not occur exactly once.
    """
    first = text.rfind("\n", 0, span.start) + 1
    before, after = (r"\b" if re.match(r"\w", sign) else "" for sign in (hint.old[0], hint.old[-1]))
    wanted = re.compile(before + re.escape(hint.old) + after)
    for end in (END_OF_LINE, END_OF_TABLE):
        stop = end.search(text, span.end)
        found = [*wanted.finditer(text[first : stop.start() if stop else len(text)])]
        if found:
            break
    if len(found) != 1:
        return None
    start, stopped = (units(text[: first + at]) for at in found[0].span())
    return Edit(start, stopped, hint.new, before=hint.old)


def parted(place: str) -> Path:
    """The table and the key that a place names; the key alone is kept as written."""
    *table, last = place.split(".") if place else [""]
    return (*parts(".".join(table)), last)


class Lines:
    """A text with its keys, whose lines can be rewritten, removed or added."""

    def __init__(self, text: str, found: Mapping[Path, Span], values: Mapping[Path, Span]) -> None:
        self.text, self.found, self.values = text, found, values

    def changed_by(self, change: Change, problem: Problem) -> Iterator[Edit]:
        """The edit that makes a change, if its object is in the text."""
        path = parted(problem.place)
        match change:
            case Written():
                yield from self.written(change, path)
            case WrittenInto(line=line):
                yield from self.put_into(line, (*path[:-1], *parts(str(path[-1]))))
            case TakenOut() if path in self.found:
                yield self.without(self.found[path])
            case FirstLine(line=line):
                yield self.edit(Span(0, 0), f"{line}\n")
            case DriverAdded(line=line):
                end, rest = len(self.text), "angle = 0\nspeed = 0"
                yield self.edit(Span(end, end), f"\n[[drivers]]\n{line}\n{rest}\n")
            case DriverTaken():
                yield from self.without_driver(change)
            case PointRenamed():
                yield from self.renamed(change)

    def written(self, change: Written, path: Path) -> Iterator[Edit]:
        """Set the value of a key: in its own line, in the line of another key, or in a new line."""
        table, key = path[:-1], change.key or str(path[-1])
        line, other = f"{key} = {change.value}", (*table, change.instead or key)
        if other in self.found:
            yield self.changed(self.found[other], line)
        elif len(table) == 1:
            yield self.added(table, str(table[0]), line)

    def without_driver(self, change: DriverTaken) -> Iterator[Edit]:
        """Remove the whole table of a driver."""
        for path, span in self.values.items():
            own = path[0] == "drivers" and path[-1] == change.key
            if own and self.of(span) == change.value:
                heading = self.found[path[:2]]
                stop = END_OF_TABLE.search(self.text, heading.end)
                end = stop.start() + 1 if stop else len(self.text)
                yield self.edit(Span(heading.start, end), "")

    def renamed(self, change: PointRenamed) -> Iterator[Edit]:
        """Rename a point in the first key of a link that names it."""
        for path in self.found:
            names = str(path[-1]).split("-")
            if path[:2] != ("links", change.link) or len(path) != 3 or change.old not in names:
                continue
            start = self.found[path].start
            whole = "-".join(change.new if name == change.old else name for name in names)
            if self.text.startswith(str(path[2]), start):
                yield self.changed(Span(start, start + len(str(path[2]))), whole)
                return

    def put_into(self, line: str, path: Path) -> Iterator[Edit]:
        """Add a key and value at the end of an inline table."""
        span = self.values.get(path)
        if span is not None and self.of(span).endswith("}"):
            at = len(self.text[: span.end - 1].rstrip())
            yield self.edit(Span(at, at), f", {line}")

    # --- edits ---------------------------------------------------------------------------------

    def of(self, span: Span) -> str:
        """The text at a span."""
        return self.text[span.start : span.end]

    def edit(self, span: Span, words: str, before: str = "") -> Edit:
        """An edit, counted as a browser does."""
        start, end = (units(self.text[:at]) for at in span)
        return Edit(start, end, words, before=before or self.of(span).strip())

    def changed(self, span: Span, words: str) -> Edit:
        return self.edit(span, words)

    def without(self, span: Span) -> Edit:
        """Remove a whole line with its comment."""
        start = self.text.rfind("\n", 0, span.start) + 1
        stop = self.text.find("\n", span.end)
        whole = Span(start, stop + 1 if stop >= 0 else len(self.text))
        return self.edit(whole, "", self.of(span))

    def added(self, path: Path, table: str, line: str) -> Edit:
        """Add a line under the heading of a table, and the heading if it is missing."""
        heading = self.found.get(path)
        if heading is None or not self.of(heading).startswith("["):
            at = len(self.text)
            return self.edit(Span(at, at), f"\n[{table}]\n{line}\n")
        stop = self.text.find("\n", heading.end)
        at = stop if stop >= 0 else len(self.text)
        return self.edit(Span(at, at), f"\n{line}")
