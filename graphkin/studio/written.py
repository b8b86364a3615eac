"""The values of sliders put into the text of a scene, where it states its parameters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from graphkin.scene.quantity import shortest
from graphkin.studio.places import units
from graphkin.studio.spans import values

LONGEST = 100
"""Signs of a value that is written."""


@dataclass(frozen=True, slots=True)
class Edit:
    """A piece of the text, counted as a browser does, and what comes in its place."""

    start: int
    end: int
    text: str


def edits(text: str, settings: Mapping[str, str]) -> list[Edit]:
    """What is to be changed so that the parameters have these values; the last place first."""
    known = values(text)
    found = []
    for name, value in settings.items():
        path = ("parameters", name)
        span = known.get((*path, "value")) or known.get(path)
        if span is not None:
            start, end = (units(text[:at]) for at in span)
            found.append(Edit(start, end, literal(value)))
    return sorted(found, key=lambda edit: -edit.start)


def literal(value: str) -> str:
    """A value as TOML: a number where a decimal says it whole, else a fraction in quotes.

    Raises ValueError for what is no number.
    """
    number = Fraction(value[:LONGEST])
    decimal = shortest(number)
    if Fraction(decimal) == number and "e" not in decimal:
        return decimal
    return f'"{number.numerator}/{number.denominator}"'
