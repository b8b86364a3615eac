"""One family of errors: each names the place, what was found, what was expected, and a hint."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from functools import reduce
from typing import Self

from msgspec import Struct


class Message(str):
    """A sentence as a template with fields; as a text, the English sentence.

    The template is the key of the sentence in other languages. A field that is a sentence is said
    in the reader's language; numbers and the user's own text stay as they are. An f-string and
    ``+`` lose the fields: their result is a plain text.
    """

    template: str
    fields: Mapping[str, object]

    def __new__(cls, template: str, fields: Mapping[str, object]) -> Self:
        said = super().__new__(cls, template.format_map(fields))
        said.template, said.fields = template, fields
        return said

    def __getnewargs__(self) -> tuple[str, Mapping[str, object]]:  # type: ignore[override]
        return self.template, self.fields


def message(template: str, /, **fields: object) -> Message:
    """A sentence from its template and fields, such as ``message("link {name}", name="3")``."""
    return Message(template, fields)


def verbatim(text: str) -> Message:
    """A text that is the same in every language: what the user wrote, names, lines of TOML."""
    return text if isinstance(text, Message) else Message("{text}", {"text": text})


def joined(separator: str, parts: Iterable[str]) -> Message:
    """Parts side by side, the empty ones left out: ``joined(", ", names)``."""
    fields = {f"part{number}": part for number, part in enumerate(filter(None, parts), 1)}
    return Message(separator.join(f"{{{name}}}" for name in fields), fields)


def either(parts: Iterable[str]) -> Message:
    """Alternatives: A or B or C."""
    return reduce(
        lambda one, other: message("{one} or {other}", one=one, other=other), every(parts)
    )


def both(parts: Iterable[str]) -> Message:
    """Parts that belong together: A and B and C."""
    return reduce(
        lambda one, other: message("{one} and {other}", one=one, other=other), every(parts)
    )


def every(parts: Iterable[str]) -> Iterator[Message]:
    """Each part as a message; one empty message where there are no parts."""
    return map(verbatim, list(parts) or [""])


NO_WORDS = Message("", {})
"""The sentence of a part that is left out."""


class Mend(Struct, frozen=True):
    """The replacement for a piece of a text; ``words`` replace the default wording."""

    old: str
    new: str
    words: Message = NO_WORDS

    def __str__(self) -> str:
        return self.message

    @property
    def message(self) -> Message:
        """The replacement as a question: did you mean …?"""
        return self.words or message("did you mean {new}?", new=self.new)


Hint = Message | Mend
"""A hint, as words or as the change that corrects the problem; empty for none."""


class Written(Struct, frozen=True):
    """A value written under the key at a problem's place, or under another key of its table.

    ``instead`` names a key of the table that it replaces.
    """

    value: str
    key: str = ""
    instead: str = ""


class TakenOut(Struct, frozen=True):
    """The key at a problem's place, removed."""


class FirstLine(Struct, frozen=True):
    """A line inserted before all others."""

    line: str


class DriverAdded(Struct, frozen=True):
    """A driver added, at rest, by the line that names what it drives."""

    line: str


class DriverTaken(Struct, frozen=True):
    """The removal of the driver whose key has a given value."""

    key: str
    value: str


class PointRenamed(Struct, frozen=True):
    """A point of one link, renamed."""

    link: str
    old: str
    new: str


class WrittenInto(Struct, frozen=True):
    """A key with its value added to the inline table at a problem's place."""

    line: str


Change = Written | WrittenInto | TakenOut | FirstLine | DriverAdded | DriverTaken | PointRenamed
"""The changes of which each alone would correct a problem."""


class InLine(Struct, frozen=True):
    """A line of the text and the column where it is no TOML, from 1; 0 for none."""

    line: int
    column: int = 0

    @property
    def message(self) -> Message:
        return message("line {line}", line=self.line)


class InTable(Struct, frozen=True):
    """A row of a table, by the name of its file, and a column by its heading or number."""

    table: str
    row: int
    column: str | int = ""

    @property
    def message(self) -> Message:
        """The place in words: roster.csv, row 14, column "id"."""
        if not self.column:
            return message("{table}, row {row}", table=self.table, row=self.row)
        column = f'"{self.column}"' if isinstance(self.column, str) else self.column
        return message(
            "{table}, row {row}, column {column}", table=self.table, row=self.row, column=column
        )


class Setting(Struct, frozen=True):
    """A parameter with a value set from outside the text."""

    name: str

    @property
    def message(self) -> Message:
        return message("setting {name}", name=self.name)


class Sought(Struct, frozen=True):
    """Links and points to be found by drawing; none for the whole position."""

    names: tuple[str, ...] = ()


About = tuple[str, ...] | InLine | InTable | Setting | Sought
"""The subject of a problem whose place is no key: a key with its tables, or one of these."""


class Problem(Struct, frozen=True):
    """One problem at one place, with words that help to correct it and possible changes.

    ``place`` is the dotted key, or a sentence where ``about`` gives the subject. ``file`` precedes
    the place where there are several files.
    """

    place: str
    found: Message
    expected: Message = NO_WORDS
    hint: Hint = NO_WORDS
    changes: tuple[Change, ...] = ()
    about: tuple[About, ...] = ()
    file: str = ""

    def __str__(self) -> str:
        return self.message

    @property
    def help(self) -> Message:
        """The hint in words; none where it repeats what was expected."""
        if not isinstance(self.hint, Mend):
            return self.hint
        repeats = not self.hint.words and self.hint.new == self.expected
        return NO_WORDS if repeats else self.hint.message

    @property
    def message(self) -> Message:
        """The problem as one sentence: file: place: found; expected …; hint."""
        found = joined(": ", (self.file, self.place, self.found))
        wanted = self.expected and message("expected {expected}", expected=self.expected)
        return joined("; ", (found, wanted, self.help))


MOST = 100
"""The most problems in one error."""
MORE = Problem("", message("and perhaps more problems"))
"""The replacement for further problems."""


class GraphkinError(Exception):
    """Base of every error that a user can correct; it holds all problems found."""

    def __init__(self, problems: Problem | Iterable[Problem]) -> None:
        found = (problems,) if isinstance(problems, Problem) else tuple(problems)
        self.problems = found if len(found) <= MOST else (*found[:MOST], MORE)
        super().__init__("\n".join(str(problem) for problem in self.problems))

    @classmethod
    def at(
        cls,
        place: str,
        found: Message,
        expected: Message = NO_WORDS,
        hint: Hint = NO_WORDS,
        changes: tuple[Change, ...] = (),
        about: tuple[About, ...] = (),
    ) -> Self:
        """The error of a single problem."""
        return cls(Problem(place, found, expected, hint, changes, about))


class SceneError(GraphkinError):
    """The scene cannot be read, or contradicts itself."""


class StructureError(GraphkinError):
    """The mechanism cannot be analysed: mobility, drivers, or a group without construction."""


class ClosureError(GraphkinError):
    """A step cannot be drawn in this position: the mechanism does not close."""


class WitnessError(GraphkinError):
    """The residual check disagrees with the construction, so that no result is returned."""


class PageError(GraphkinError):
    """The drawing does not fit the page, or a file cannot be written."""


class FileError(PageError):
    """A file cannot be written in its place."""


class HouseError(SceneError):
    """The conventions of a school cannot be used; every problem has the file of the conventions."""


class RosterError(GraphkinError):
    """A class list or a table of answers cannot be read; every problem has its row and column."""


PLAIN_TRACEBACK = "GRAPHKIN_TRACEBACK"
"""Environment variable that shows the traceback of a fault in graphkin itself."""


def fault(error: Exception) -> Message:
    """The message for an unexpected error, in one line."""
    what = f"{type(error).__name__}: {error}".splitlines()[0][:200]
    return message(
        "a fault in graphkin itself ({what}); {variable}=1 shows where",
        what=what,
        variable=PLAIN_TRACEBACK,
    )


def problems_of(error: Exception) -> tuple[Problem, ...]:
    """The problems of an error: its own, or a fault in graphkin itself.

    Raises a fault where its traceback is requested.
    """
    if isinstance(error, GraphkinError):
        return error.problems
    if os.environ.get(PLAIN_TRACEBACK):
        raise error
    return (Problem("", fault(error)),)


class Refusals:
    """The refusals of many units (students, files, pictures), each of which fails alone."""

    def __init__(self) -> None:
        self.found: dict[str, tuple[Problem, ...]] = {}

    @contextmanager
    def alone(self, unit: str) -> Iterator[None]:
        """Process one unit: any error is recorded under its name, and the others continue."""
        try:
            yield
        except Exception as error:
            self.add(unit, problems_of(error))

    def add(self, unit: str, problems: Iterable[Problem]) -> None:
        """Record the problems of a unit."""
        self.found[unit] = (*self.found.get(unit, ()), *problems)

    def lines(self) -> Iterator[str]:
        """A line for each problem, with the name of its unit."""
        for unit, problems in self.found.items():
            for problem in problems:
                named = problem.place.startswith(unit) or problem.file == unit
                yield str(problem) if named else f"{unit}: {problem}"
