"""Marked-up text that records the names of its symbols."""

from __future__ import annotations

from collections.abc import Iterable


class Markup(str):
    """Marked-up text with the ``names`` of the points and vectors whose symbols it contains.

    Sentences with fields, ``join`` and ``+`` keep the names of their parts; an f-string does not.
    """

    names: frozenset[str] = frozenset()

    def join(self, parts: Iterable[str], /) -> Markup:
        """Parts joined by this text."""
        every = tuple(parts)
        return saying(super().join(every), *every)

    def __add__(self, other: str) -> Markup:
        """This text followed by another."""
        return saying(super().__add__(other), self, other)


def saying(text: str, *parts: object) -> Markup:
    """Text made of parts, with all names of the parts."""
    said = Markup(text)
    said.names = frozenset[str]().union(*map(names_in, parts))
    return said


def names_in(text: object) -> frozenset[str]:
    """The names whose symbols a text contains; none if it is no markup."""
    return text.names if isinstance(text, Markup) else frozenset()


def as_text(value: object) -> str:
    """Markup as plain text, for encoders of records. Raises TypeError for anything else."""
    if isinstance(value, Markup):
        return str(value)
    raise TypeError(f"{type(value).__name__} is no text")


NOTHING = Markup()
"""The empty separator."""
AND = Markup("; ")
"""The separator of clauses in one sentence."""
COMMA = Markup(", ")
"""The separator of a list."""
EQUALS = Markup(" = ")
"""The separator of equal symbols."""
