"""The changes of a text that would mend a mistake, as far as what is said of it names them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from msgspec import Struct

from graphkin.studio.toml_spans import Path, Span, parts, walked
from graphkin.text.errors import Mend, Problem

MOST = 4
"""Mends that are offered for one mistake."""
END_OF_LINE, END_OF_TABLE = re.compile(r"\n"), re.compile(r"\n\s*\[")
LINE = r"[\w-]+ = (?:\"[^\"{]*\"|-?[\d.]+|true)"
"""A key with its value, as messages write it."""
BRANCH = re.compile(rf"branches\.({r'[^.]+'})")
CHOICE = re.compile(r'"(?:left of|right of) (?!P-Q)\S+"|"(?:forward|backward|closure \d+)"')
CLOSURES = re.compile(r'"closure 1" to "closure (\d+)"')
INSTEAD = re.compile(rf"(.+) in place of ({LINE})")
AWAY = re.compile(r"take (\w+ = \S+) away")
ADDED = re.compile(r"add a driver, such as (\w+ = \S+)")
MEANT = re.compile(rf"did you mean ({LINE})\?")
RENAMED = re.compile(r"did you mean (\w+) where link (\w+) has (\w+)\?")
INTO = re.compile(rf"write ({LINE})")
FIRST = re.compile(rf"the first line ({LINE})")
OUT = "take it out"


class Edit(Struct, frozen=True):
    """A piece of the text, counted as a browser does, and what comes in its place.

    ``name`` is the parameter, ``before`` the value that stands there now.
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
    """The changes of which each would mend a problem that stands at a span, the likeliest first."""
    if isinstance(problem.hint, Mend):
        own = None if span is None else corrected(problem.hint, text, span)
        return [] if own is None else [own]
    walk = walked(text)
    lines = Lines(text, walk.found, walk.values)
    found = [*lines.branches(problem), *lines.keys(problem), *lines.drivers(problem)]
    return list(dict.fromkeys(found))[:MOST]


def corrected(hint: Mend, text: str, span: Span) -> Edit | None:
    """The change that a hint proposes, in the lines of its span or of its table; None where what is
    to be changed stands there not just once."""
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


class Lines:
    """A text by its keys, whose lines are written anew, taken out or added."""

    def __init__(self, text: str, found: Mapping[Path, Span], values: Mapping[Path, Span]) -> None:
        self.text, self.found, self.values = text, found, values

    def branches(self, problem: Problem) -> Iterator[Edit]:
        """The branch that is missing or wrong written as each of those that it may be."""
        place = BRANCH.fullmatch(problem.place)
        if place is None:
            return
        key = place[1]
        path: Path = ("branches", key)
        if str(problem.hint).startswith(OUT) and path in self.found:
            yield self.without(self.found[path])
            return
        instead = INSTEAD.fullmatch(problem.expected)
        most = CLOSURES.fullmatch(problem.expected)
        said = instead[1] if instead else problem.expected
        choices = CHOICE.findall(said)
        if most:
            choices = [f'"closure {n}"' for n in range(1, int(most[1]) + 1)]
        for choice in choices:
            line = f"{key} = {choice}"
            other = ("branches", instead[2].partition(" = ")[0]) if instead else path
            if other in self.found:
                yield self.changed(self.found[other], line)
            else:
                yield self.added(("branches",), "branches", line)

    def keys(self, problem: Problem) -> Iterator[Edit]:
        """A line that is said to be expected, or meant, in place of the one that is wrong."""
        *table, last = problem.place.split(".") if problem.place else [""]
        path = (*parts(".".join(table)), last)
        expected, meant = re.fullmatch(LINE, problem.expected), MEANT.search(str(problem.hint))
        first, renamed = FIRST.fullmatch(problem.expected), RENAMED.search(str(problem.hint))
        into = INTO.fullmatch(str(problem.hint))
        if first:
            yield self.edit(Span(0, 0), f"{first[1]}\n")
        elif meant and meant[1].partition(" = ")[0] == last and path in self.values:
            yield self.changed(self.values[path], meant[1].partition(" = ")[2])
        elif expected and path in self.found and "[" not in last:
            yield self.changed(self.found[path], expected[0])
        elif into and self.text[: self.end(tuple(parts(problem.place)))].endswith("}"):
            at = self.end(tuple(parts(problem.place))) - 1
            at = len(self.text[:at].rstrip())
            yield self.edit(Span(at, at), f", {into[1]}")
        elif renamed:
            new, link, old = renamed.groups()
            keys = [p for p in self.found if p[:2] == ("links", link) and len(p) == 3]
            for key in keys:
                names = str(key[2]).split("-")
                if old in names:
                    start = self.found[key].start
                    whole = "-".join(new if name == old else name for name in names)
                    if self.text.startswith(str(key[2]), start):
                        yield self.changed(Span(start, start + len(str(key[2]))), whole)
                        return

    def drivers(self, problem: Problem) -> Iterator[Edit]:
        """A driver taken away, or one added, at rest."""
        away, added = AWAY.search(str(problem.hint)), ADDED.search(str(problem.hint))
        if added:
            line = f"{added[1]}\nangle = 0\nspeed = 0"
            yield self.edit(Span(len(self.text), len(self.text)), f"\n[[drivers]]\n{line}\n")
        if not away:
            return
        key, _, value = away[1].partition(" = ")
        for path, span in self.values.items():
            if path[0] == "drivers" and path[-1] == key and self.of(span) == value:
                heading = self.found[path[:2]]
                stop = END_OF_TABLE.search(self.text, heading.end)
                end = stop.start() + 1 if stop else len(self.text)
                yield self.edit(Span(heading.start, end), "")

    # --- edits ---------------------------------------------------------------------------------

    def of(self, span: Span) -> str:
        """What stands at a span."""
        return self.text[span.start : span.end]

    def end(self, path: Path) -> int:
        """Where the value of a key ends; 0 for a key that is not written."""
        span = self.values.get(path)
        return 0 if span is None else span.end

    def edit(self, span: Span, words: str, before: str = "") -> Edit:
        """An edit, counted as a browser does."""
        start, end = (units(self.text[:at]) for at in span)
        return Edit(start, end, words, before=before or self.of(span).strip())

    def changed(self, span: Span, words: str) -> Edit:
        """A span with other words in it."""
        return self.edit(span, words)

    def without(self, span: Span) -> Edit:
        """A line taken out whole, with its comment."""
        start = self.text.rfind("\n", 0, span.start) + 1
        stop = self.text.find("\n", span.end)
        whole = Span(start, stop + 1 if stop >= 0 else len(self.text))
        return self.edit(whole, "", self.of(span))

    def added(self, path: Path, table: str, line: str) -> Edit:
        """A line under the heading of a table; with the heading where there is none."""
        heading = self.found.get(path)
        if heading is None or not self.of(heading).startswith("["):
            at = len(self.text)
            return self.edit(Span(at, at), f"\n[{table}]\n{line}\n")
        stop = self.text.find("\n", heading.end)
        at = stop if stop >= 0 else len(self.text)
        return self.edit(Span(at, at), f"\n{line}")
