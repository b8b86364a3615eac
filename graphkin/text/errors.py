"""One family of errors: each names the place, what was found, what was expected, and a hint."""

from __future__ import annotations

from collections.abc import Iterable

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


class Problem(Struct, frozen=True):
    """One thing wrong at one place, in words that help to mend it."""

    place: str
    found: str
    expected: str = ""
    hint: Hint = ""

    def __str__(self) -> str:
        """Read as one sentence: place: found; expected …; hint."""
        parts = [f"{self.place}: {self.found}" if self.place else self.found]
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
