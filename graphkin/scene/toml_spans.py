"""Where each key of a TOML text stands: the spans of headings, keys and elements of lists.

The values are read elsewhere. Here a text is only walked through, and what is no TOML ends the walk
with all that was found before it.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import NamedTuple

Path = tuple[str | int, ...]
"""The keys and indices that lead to a value."""
BARE = re.compile(r"[A-Za-z0-9_-]+")
BLANK = re.compile(r"[ \t]*")
EMPTY = re.compile(r"(?:[ \t\r\n]|#[^\n]*)*")
SCALAR = re.compile(r"[^,\]}\r\n#]*")
STRING = re.compile(
    r'"""(?:\\.|[^\\])*?"{3,5}'
    r"|'''.*?'{3,5}"
    r'|"(?:\\.|[^"\\\n])*"'
    r"|'[^'\n]*'",
    re.DOTALL,
)
PART = re.compile(r'"(?:\\.|[^"\\])*"|\[(\d+)\]|[^.\[\]"]+')
ESCAPE = re.compile(r"\\(?:u([0-9A-Fa-f]{4})|U([0-9A-Fa-f]{8})|(.))", re.DOTALL)


class Span(NamedTuple):
    """A piece of the text: where it starts, and where the next sign after it is."""

    start: int
    end: int


class Again(NamedTuple):
    """A key, or a table by its heading, that stands in the text a second time.

    ``first`` is where it stands first, ``key`` the second name without brackets or value.
    """

    path: Path
    first: Span
    key: Span
    heading: bool


class LostError(Exception):
    """The text goes on in a way that is no TOML."""


def spans(text: str) -> dict[Path, Span]:
    """The span of each heading, each key with its value, and each element of a list."""
    return walked(text).found


def values(text: str) -> dict[Path, Span]:
    """The span of the value of each key, without the key."""
    return walked(text).values


def walked(text: str) -> Walk:
    """A walk through a text, as far as it is TOML."""
    walk = Walk(text)
    with suppress(LostError, RecursionError):
        walk.document()
    return walk


class Walk:
    """Goes through a text once, from its beginning, and notes where keys stand."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.at = 0
        self.found: dict[Path, Span] = {}
        self.values: dict[Path, Span] = {}
        self.counts: dict[Path, int] = {}
        self.again: list[Again] = []
        self.names: dict[Path, Span] = {}

    def document(self) -> None:
        """Headings, each with its keys."""
        table: Path = ()
        self.skip(EMPTY)
        while self.at < len(self.text):
            if self.text[self.at] == "[":
                table = self.heading()
            else:
                self.pair(table)
            self.skip(EMPTY)

    def heading(self) -> Path:
        """The path of the table that a heading opens; one of several gets its number."""
        many = self.text.startswith("[[", self.at)
        start = self.at
        self.at += 2 if many else 1
        begin = self.at
        keys = self.keys()
        name = Span(begin, self.at)
        self.expect("]]" if many else "]")
        path = self.numbered(keys[:-1])
        path = (*path, keys[-1])
        if not (many and path in self.counts):
            self.name(path, name, heading=True)
        span = Span(start, self.at)
        self.found.setdefault(path, span)
        if many:
            number = self.counts.get(path, 0)
            self.counts[path] = number + 1
            path = (*path, number)
            self.found[path] = span
        return path

    def numbered(self, keys: list[str]) -> Path:
        """The path of keys, within the last of several tables where there are several."""
        path: Path = ()
        for key in keys:
            path = (*path, key)
            if path in self.counts:
                path = (*path, self.counts[path] - 1)
        return path

    def pair(self, table: Path) -> None:
        """A key with its value; the keys before its last dot are tables."""
        start = self.at
        keys = self.keys()
        path = (*table, *keys)
        again, count = self.name(path, Span(start, self.at)), len(self.again)
        self.expect("=")
        self.skip(BLANK)
        begin = self.at
        self.value(path)
        if again:  # what stands within it is not told again
            del self.again[count:]
        self.values[path] = Span(begin, self.at)
        for depth in range(len(table) + 1, len(path) + 1):
            self.found.setdefault(path[:depth], Span(start, self.at))
            self.names.setdefault(path[:depth], self.found[path[:depth]])

    def name(self, path: Path, span: Span, *, heading: bool = False) -> bool:
        """Note a name, and whether it stands there for the second time."""
        first = self.names.setdefault(path, span)
        if first is span:
            return False
        self.again.append(Again(path, first, span, heading))
        return True

    def keys(self) -> list[str]:
        """A key, or several with dots between them."""
        found = [self.key()]
        while self.text.startswith(".", self.at):
            self.at += 1
            found.append(self.key())
        return found

    def key(self) -> str:
        """One key, bare or in quotes, and the blanks around it."""
        self.skip(BLANK)
        match = BARE.match(self.text, self.at) or STRING.match(self.text, self.at)
        if match is None:
            raise LostError
        self.at = match.end()
        self.skip(BLANK)
        return unquoted(match[0])

    def value(self, path: Path) -> None:
        """A value: a list and a table within the line hold more of them."""
        sign = self.text[self.at : self.at + 1]
        if sign == "[":
            self.several("]", lambda number: self.element((*path, number)))
        elif sign == "{":
            self.several("}", lambda _: self.pair(path))
        else:
            match = STRING.match(self.text, self.at) or SCALAR.match(self.text, self.at)
            if match is None or not match[0].strip():
                raise LostError
            self.at += len(match[0].rstrip())

    def several(self, closing: str, one: Callable[[int], None]) -> None:
        """What stands between brackets, with commas."""
        self.at += 1
        self.skip(EMPTY)
        number = 0
        while not self.text.startswith(closing, self.at):
            one(number)
            number += 1
            self.skip(EMPTY)
            if self.text.startswith(",", self.at):
                self.at += 1
                self.skip(EMPTY)
            elif not self.text.startswith(closing, self.at):
                raise LostError
        self.at += 1

    def element(self, path: Path) -> None:
        """An element of a list."""
        start = self.at
        self.value(path)
        self.found[path] = Span(start, self.at)

    def skip(self, what: re.Pattern[str]) -> None:
        """Pass over blanks, or over blanks, ends of lines and comments."""
        match = what.match(self.text, self.at)
        assert match is not None
        self.at = match.end()

    def expect(self, sign: str) -> None:
        """Pass over a sign that must stand here."""
        if not self.text.startswith(sign, self.at):
            raise LostError
        self.at += len(sign)


def unquoted(key: str) -> str:
    """A key without its quotes and escapes."""
    if key[:1] == "'":
        return key[1:-1]
    return ESCAPE.sub(unescaped, key[1:-1]) if key[:1] == '"' else key


def unescaped(match: re.Match[str]) -> str:
    """The sign that an escape stands for; the rarer ones do not matter in a key."""
    code = match[1] or match[2]
    if code is None:
        return match[3]
    return chr(int(code, 16)) if int(code, 16) < 0x110000 else ""


def parts(place: str) -> Iterator[str | int]:
    """The keys and indices of a dotted place."""
    for match in PART.finditer(place):
        yield int(match[1]) if match[1] else unquoted(match[0])
