"""The places of keys in a TOML text: the spans of headings, keys and elements of lists.

The values are read elsewhere. This module only walks through a text. Invalid TOML ends the walk,
which keeps everything found up to there.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import NamedTuple

Path = tuple[str | int, ...]
"""The keys and indices of a value."""
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
    """A piece of the text: its start, and the index after its end."""

    start: int
    end: int


class Again(NamedTuple):
    """A key, or a table by its heading, that occurs in the text a second time.

    ``first`` is the first occurrence. ``key`` is the second name, without brackets or value.
    """

    path: Path
    first: Span
    key: Span
    heading: bool


class LostError(Exception):
    """The text is not valid TOML from here on."""


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
    """One pass through a text that records the places of its keys."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.at = 0
        self.found: dict[Path, Span] = {}
        self.values: dict[Path, Span] = {}
        self.counts: dict[Path, int] = {}
        self.again: list[Again] = []
        self.names: dict[Path, Span] = {}

    def document(self) -> None:
        """Read headings, each with its keys."""
        table: Path = ()
        self.skip(EMPTY)
        while self.at < len(self.text):
            if self.text[self.at] == "[":
                table = self.heading()
            else:
                self.pair(table)
            self.skip(EMPTY)

    def heading(self) -> Path:
        """Read a heading and return the path of its table, with a number in an array of tables."""
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
        """The path of some keys, within the last table of each array of tables."""
        path: Path = ()
        for key in keys:
            path = (*path, key)
            if path in self.counts:
                path = (*path, self.counts[path] - 1)
        return path

    def pair(self, table: Path) -> None:
        """Read a key with its value; the keys before its last dot are tables."""
        start = self.at
        keys = self.keys()
        path = (*table, *keys)
        again, count = self.name(path, Span(start, self.at)), len(self.again)
        self.expect("=")
        self.skip(BLANK)
        begin = self.at
        self.value(path)
        if again:  # |a duplicate's own keys are not reported again
            del self.again[count:]
        self.values[path] = Span(begin, self.at)
        for depth in range(len(table) + 1, len(path) + 1):
            self.found.setdefault(path[:depth], Span(start, self.at))
            self.names.setdefault(path[:depth], self.found[path[:depth]])

    def name(self, path: Path, span: Span, *, heading: bool = False) -> bool:
        """Record a name and return whether it occurs for the second time."""
        first = self.names.setdefault(path, span)
        if first is span:
            return False
        self.again.append(Again(path, first, span, heading))
        return True

    def keys(self) -> list[str]:
        """Read a key, or several with dots between them."""
        found = [self.key()]
        while self.text.startswith(".", self.at):
            self.at += 1
            found.append(self.key())
        return found

    def key(self) -> str:
        """Read one key, bare or quoted, and the blanks around it."""
        self.skip(BLANK)
        match = BARE.match(self.text, self.at) or STRING.match(self.text, self.at)
        if match is None:
            raise LostError
        self.at = match.end()
        self.skip(BLANK)
        return unquoted(match[0])

    def value(self, path: Path) -> None:
        """Read a value; lists and inline tables hold further values."""
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
        """Read the items between brackets, separated by commas."""
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
        """Read an element of a list."""
        start = self.at
        self.value(path)
        self.found[path] = Span(start, self.at)

    def skip(self, what: re.Pattern[str]) -> None:
        """Skip blanks, or blanks, line ends and comments."""
        match = what.match(self.text, self.at)
        assert match is not None
        self.at = match.end()

    def expect(self, sign: str) -> None:
        """Skip a required sign."""
        if not self.text.startswith(sign, self.at):
            raise LostError
        self.at += len(sign)


def unquoted(key: str) -> str:
    """A key without its quotes and escapes."""
    if key[:1] == "'":
        return key[1:-1]
    return ESCAPE.sub(unescaped, key[1:-1]) if key[:1] == '"' else key


def unescaped(match: re.Match[str]) -> str:
    """The character of an escape; rare escapes are not decoded, as keys do not need them."""
    code = match[1] or match[2]
    if code is None:
        return match[3]
    return chr(int(code, 16)) if int(code, 16) < 0x110000 else ""


def parts(place: str) -> Iterator[str | int]:
    """The keys and indices of a dotted path."""
    for match in PART.finditer(place):
        yield int(match[1]) if match[1] else unquoted(match[0])
