"""What is said of the ranges in which a lab is fair, and the text to be put into lab.toml."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction

from graphkin.classroom.lab.fair_ranges import FairRanges
from graphkin.classroom.lab.fairness_words import draw_words, limit_words
from graphkin.classroom.lab.formula_mending import Mending
from graphkin.classroom.lab.lab_model import Lab, Range, ValueList
from graphkin.classroom.lab.rules import exact_text
from graphkin.text.plain_table import labelled, table

SHOWN = 6
"""Limits that are listed."""
NUMBERS = 12
"""Numbers of which it is told why a formula is unfair to them."""


def range_lines(lab: Lab, found: FairRanges) -> Iterator[str]:
    """The whole report on where a lab is fair."""
    tried = found.tried
    draws = "all" if tried.complete else "draws"
    told = (f"{name} {draw_words(values)}" for name, values in tried.space.items())
    yield from labelled("tried", [f"{len(tried.places)} {draws} of {', '.join(told)}"])
    if found.left_alone:
        names = ", ".join(found.left_alone)
        yield from labelled("left", [f"{names}: no min and max in the scene, so left as written"])
    yield from labelled("limits", [limit_words(lab.fair)])
    fair = [f"{100 * tried.share:.0f} %"]
    if found.exact:
        share = f"{100 * sum(found.exact) / len(found.exact):.0f} %"
        fair.append(f"a pencil draws {share} of {len(found.exact)} of these exactly enough")
    yield from labelled("fair", fair)
    rows = [(limit, str(times)) for limit, times in tried.reasons()]
    more = [f"and {len(rows) - SHOWN} more limits"] if rows[SHOWN:] else []
    lines = [*table(("limit", "times"), rows[:SHOWN]), *more] if rows else ["none"]
    yield from labelled("unfair", lines)
    if tried.share < 1:
        guilt = sorted(((tried.guilt(name), name) for name in tried.space), reverse=True)
        shares = [f"{name} {100 * share:.0f} %" for share, name in guilt]
        yield from labelled("decides", [f"{', '.join(shares)} of what is fair and what is not"])
        for _, name in guilt:
            yield from labelled(name[:9], value_lines(found, name))


def value_lines(found: FairRanges, name: str) -> list[str]:
    """The fair share by the values of a parameter."""
    rows = []
    for first, last, share, _ in found.tried.by_value(name):
        ends = exact_text(first)
        if last != first:
            ends += f" to {exact_text(last)}"
        rows.append((ends, f"{100 * share:.0f}", "#" * round(20 * share)))
    return table(("value", "fair, %", ""), rows)


def variants_lines(ranges: Mapping[str, Range | ValueList], course: str) -> list[str]:
    """``[variants]`` that draws from some ranges."""
    lines = ["[variants]", f'course = "{course}"', "[variants.draw]"]
    return lines + [f"{name} = {listed_alone(values)}" for name, values in ranges.items()]


def listed_alone(values: Range | ValueList) -> str:
    """The same, a single value as a list of one: alone it is no rule to draw by."""
    text = as_toml(values)
    return f"[{text}]" if isinstance(values, Range) and len(values) == 1 else text


def as_toml(values: Range | ValueList) -> str:
    """A range, or a list of ranges and values, as lab.toml writes it."""
    if isinstance(values, ValueList):
        return f"[{', '.join(map(as_toml, values.parts))}]"
    if len(values) == 1:
        return number_text(values.least)
    ends = {"min": values.least, "max": values.most, "step": values.step}
    return f"{{ {', '.join(f'{key} = {number_text(end)}' for key, end in ends.items())} }}"


def number_text(value: Fraction) -> str:
    """An exact number as TOML: one that has no finite decimals in quotes."""
    text = exact_text(value)
    return f'"{text}"' if "/" in text else text


def mending_lines(unfair: Mapping[str, str], mending: Mending | None) -> list[str]:
    """Which numbers a formula is unfair to, why, and what one change would mend."""
    if not unfair:
        return ["the formula is fair to every number"]
    lines = [f"number {number}: {why}" for number, why in [*unfair.items()][:NUMBERS]]
    if len(unfair) > NUMBERS:
        lines.append(f"and {len(unfair) - NUMBERS} numbers more, see graphkin check")
    if mending is None:
        return [*lines, "no change of one number of the scene by up to 12 % is fair to all"]
    change = f"{mending.old} to {mending.new} ({mending.percent:+.1f} %)"
    return [*lines, f"fair to all: scene.toml, line {mending.line}, {mending.text}: {change}"]
