"""Marked-up text that knows whose symbols it says."""

from __future__ import annotations

from collections.abc import Iterable


class Markup(str):
    """Marked-up text with the ``names`` of the points and vectors whose symbols it says.

    Sentences with fields, ``join`` and ``+`` keep what their parts say; an f-string does not.
    """

    names: frozenset[str] = frozenset()

    def join(self, parts: Iterable[str], /) -> Markup:
        """Parts with this between them."""
        every = tuple(parts)
        return saying(super().join(every), *every)

    def __add__(self, other: str) -> Markup:
        """It before other text."""
        return saying(super().__add__(other), self, other)


def saying(text: str, *parts: object) -> Markup:
    """Text made of parts, saying what they say."""
    said = Markup(text)
    said.names = frozenset[str]().union(*map(names_in, parts))
    return said


def names_in(text: object) -> frozenset[str]:
    """The names whose symbols a text says; none where it is no markup."""
    return text.names if isinstance(text, Markup) else frozenset()


def as_text(value: object) -> str:
    """Markup as plain text, for what encodes records; TypeError for anything else."""
    if isinstance(value, Markup):
        return str(value)
    raise TypeError(f"{type(value).__name__} is no text")


NOTHING = Markup()
"""What joins markup without anything between."""
AND = Markup("; ")
"""What stands between clauses that are said in one sentence."""
COMMA = Markup(", ")
"""What stands between things that are listed."""
EQUALS = Markup(" = ")
"""What stands between symbols of the same."""
