"""The values of sliders put into the text of a scene, where it states its parameters."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from graphkin.scene.findings import Findings
from graphkin.scene.parameters import of_setting, plain, rational
from graphkin.scene.quantity import shortest
from graphkin.scene.toml_spans import values
from graphkin.studio.mends import Edit, units
from graphkin.text.errors import SceneError

LONGEST = 100
"""Signs of a value that is written."""


def edits(text: str, settings: Mapping[str, str]) -> list[Edit]:
    """What is to be changed so that the parameters have these values; the last place first.

    A value that the text states already changes nothing. Raises SceneError for what is no number.
    """
    known = values(text)
    found = []
    for name, value in settings.items():
        path = ("parameters", name)
        span = known.get((*path, "value")) or known.get(path)
        if span is None:
            continue
        before, after = text[slice(*span)], literal(name, value)
        if not same(before, after):
            start, end = (units(text[:at]) for at in span)
            found.append(Edit(start, end, after, name, before))
    return sorted(found, key=lambda edit: -edit.start)


def literal(name: str, value: str) -> str:
    """A value as TOML: a number where a decimal says it whole, else a fraction in quotes.

    Raises SceneError for what is no rational number.
    """
    findings = Findings()
    number = number_of(value, findings)
    if number is None:
        raise SceneError(of_setting(name, findings.problems))
    decimal = shortest(number)
    if Fraction(decimal) == number and "e" not in decimal:
        return decimal
    return f'"{number.numerator}/{number.denominator}"'


def same(before: str, after: str) -> bool:
    """Whether two values as TOML are one number."""
    one, other = (number_of(value.strip("\"'"), Findings()) for value in (before, after))
    return one is not None and one == other


def number_of(value: str, findings: Findings) -> Fraction | None:
    """The exact number of a text; None, with a problem noted, where it is none."""
    read = rational("", value[:LONGEST], findings)
    return None if read is None else plain(read)
