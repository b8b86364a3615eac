"""One family of errors: each names the place, what was found, what was expected, and a hint."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager

from msgspec import Struct


class Mend(Struct, frozen=True):
    """What should stand in a text instead of a piece of it; ``words`` say so in another way."""

    old: str
    new: str
    words: str = ""

    def __str__(self) -> str:
        """Read as a question: did you mean …?"""
        return self.words or f"did you mean {self.new}?"


Hint = str | Mend
"""What helps: in words, or as the change that mends it; the empty text is none."""


class Written(Struct, frozen=True):
    """The key at a problem's place, or another of its table, with a value as a text writes it;
    ``instead`` of a key of the table where that is named.
    """

    value: str
    key: str = ""
    instead: str = ""


class TakenOut(Struct, frozen=True):
    """The key at a problem's place taken out."""


class FirstLine(Struct, frozen=True):
    """A line put before all others."""

    line: str


class DriverAdded(Struct, frozen=True):
    """A driver added, at rest, by the line that says what it drives."""

    line: str


class DriverTaken(Struct, frozen=True):
    """The driver taken away whose key has a value."""

    key: str
    value: str


class PointRenamed(Struct, frozen=True):
    """A point of one link under another name."""

    link: str
    old: str
    new: str


class WrittenInto(Struct, frozen=True):
    """A key with its value put into the table in braces that stands at a problem's place."""

    line: str


Change = Written | WrittenInto | TakenOut | FirstLine | DriverAdded | DriverTaken | PointRenamed
"""What would mend a problem, each alone."""


class InLine(Struct, frozen=True):
    """A line of the text and the column at which it is no TOML, from 1; 0 for none."""

    line: int
    column: int = 0

    def __str__(self) -> str:
        return f"line {self.line}"


class InTable(Struct, frozen=True):
    """A row of a table, by the name of its file, and a column by its head or its number."""

    table: str
    row: int
    column: str | int = ""

    def __str__(self) -> str:
        """Read as words: roster.csv, row 14, column "id"."""
        column = f'"{self.column}"' if isinstance(self.column, str) else self.column
        return f"{self.table}, row {self.row}" + (f", column {column}" if self.column else "")


class Setting(Struct, frozen=True):
    """A parameter whose value is set from outside the text."""

    name: str

    def __str__(self) -> str:
        return f"setting {self.name}"


class Sought(Struct, frozen=True):
    """Links and points that are to be found by drawing; none for the position as a whole."""

    names: tuple[str, ...] = ()


About = tuple[str, ...] | InLine | InTable | Setting | Sought
"""What a problem is about where its place is no key: a key with its tables, or one of these."""


class Problem(Struct, frozen=True):
    """One thing wrong at one place, in words that help to mend it, and the changes that would.

    ``place`` is the dotted key, or words where ``about`` says what it is about; ``file`` is told
    before it where there are several files.
    """

    place: str
    found: str
    expected: str = ""
    hint: Hint = ""
    changes: tuple[Change, ...] = ()
    about: tuple[About, ...] = ()
    file: str = ""

    def __str__(self) -> str:
        """Read as one sentence: file: place: found; expected …; hint."""
        parts = [": ".join(filter(None, (self.file, self.place, self.found)))]
        if self.expected:
            parts.append(f"expected {self.expected}")
        if self.hint:
            parts.append(str(self.hint))
        return "; ".join(parts)


MOST = 100
"""Problems that one error carries."""
MORE = Problem("", "and perhaps more problems")
"""What stands for the problems beyond those."""


class GraphkinError(Exception):
    """Base of every error that a user can mend; carries all problems found, not only the first."""

    def __init__(self, problems: Problem | Iterable[Problem]) -> None:
        found = (problems,) if isinstance(problems, Problem) else tuple(problems)
        self.problems = found if len(found) <= MOST else (*found[:MOST], MORE)
        super().__init__("\n".join(str(problem) for problem in self.problems))


class SceneError(GraphkinError):
    """The scene cannot be read, or says something that cannot be."""


class StructureError(GraphkinError):
    """The mechanism cannot be put together: mobility, drivers, or a group without construction."""


class ClosureError(GraphkinError):
    """A step cannot be drawn in this position: the mechanism does not close."""


class WitnessError(GraphkinError):
    """The independent route does not agree with the construction, so nothing is handed out."""


class PageError(GraphkinError):
    """The drawing does not fit the page, or a file cannot be written."""


class FileError(PageError):
    """A file cannot be written where it was to be."""


class RosterError(GraphkinError):
    """A class list or a table of answers cannot be read; every problem has its row and column."""


PLAIN_TRACEBACK = "GRAPHKIN_TRACEBACK"
"""Set in the environment, a fault in graphkin itself shows where it happened."""


def fault(error: Exception) -> str:
    """What is said of an error that nobody expected, in one line."""
    what = f"{type(error).__name__}: {error}".splitlines()[0][:200]
    return f"a fault in graphkin itself ({what}); {PLAIN_TRACEBACK}=1 shows where"


def problems_of(error: Exception) -> tuple[Problem, ...]:
    """The problems of an error: its own, or that it is a fault in graphkin itself.

    Raises a fault where its traceback is asked for.
    """
    if isinstance(error, GraphkinError):
        return error.problems
    if os.environ.get(PLAIN_TRACEBACK):
        raise error
    return (Problem("", fault(error)),)


class Refusals:
    """What was refused of many units (students, files, pictures), each of which fails alone."""

    def __init__(self) -> None:
        self.found: dict[str, tuple[Problem, ...]] = {}

    @contextmanager
    def alone(self, unit: str) -> Iterator[None]:
        """Work on one unit: whatever is raised is noted with its name, and the others go on."""
        try:
            yield
        except Exception as error:
            self.add(unit, problems_of(error))

    def add(self, unit: str, problems: Iterable[Problem]) -> None:
        """Note what is wrong with a unit."""
        self.found[unit] = (*self.found.get(unit, ()), *problems)

    def lines(self) -> Iterator[str]:
        """A line for each problem, with the name of its unit."""
        for unit, problems in self.found.items():
            for problem in problems:
                named = problem.place.startswith(unit) or problem.file == unit
                yield str(problem) if named else f"{unit}: {problem}"
