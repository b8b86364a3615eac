"""Proposes ranges in which a lab is fair to all, and a change that mends a formula."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping
from fractions import Fraction
from pathlib import Path
from tempfile import TemporaryDirectory

from msgspec import Struct
from msgspec.structs import replace

from graphkin.classroom.lab.fair_ranges import FairRanges
from graphkin.classroom.lab.fairness import judged
from graphkin.classroom.lab.fairness_words import draw_words, limit_words
from graphkin.classroom.lab.lab_model import Lab, LabRule, Range, SeveralValues, ValueList
from graphkin.classroom.lab.lab_trial import LabTrial, tried
from graphkin.classroom.lab.rules import exact_text
from graphkin.classroom.roster.student import Student
from graphkin.classroom.variants.assign import assigned
from graphkin.scene.model import DRIVEN, JOINED
from graphkin.text.errors import GraphkinError
from graphkin.text.tables import labelled, table

CHANGES = (1, 2, 3, 5, 8, 12)
"""The changes tried, in percent: the smallest first, up before down."""
NUMBER = re.compile(r"(?<![\w.\"-])\d+(?:\.\d+)?(?![\w.])")
SECTION = re.compile(r"\s*\[+\s*(\w+)")
CHANGED = ("frame", "links", "drivers")
"""The tables whose numbers are lengths, places and laws of the driver."""
VALUE = re.compile(r"\s*(?:\{\s*value\s*=\s*)?[\d.]+")
"""The value of a parameter where it is a plain number."""
FIXED = re.compile(rf"\s*({'|'.join(('on', 'against', *DRIVEN, *JOINED))})\s*=")
"""Keys whose numbers name links, or count teeth."""


class Mending(Struct, frozen=True):
    """A number of a scene, and what to change it to.

    ``line`` counts from 1 and ``column`` from zero. ``percent`` is the change from ``old`` to
    ``new``.
    """

    line: int
    column: int
    text: str
    old: str
    new: str
    percent: float


def mended(lab: Lab, outcome: LabTrial) -> Mending | None:
    """The smallest change that is fair to all numbers tried; None where none was found.

    One number is changed at a time, by some percent, and rounded to three digits.
    """
    text = lab.scene.read_text(encoding="utf-8")
    with TemporaryDirectory() as folder:
        path = Path(folder) / lab.scene.name
        for change in CHANGES:
            for mending, changed in candidates(text, change, lab.rule.settings):
                path.write_text(changed, encoding="utf-8")
                if is_fair(replace(lab, scene=path), outcome):
                    return mending
    return None


def is_fair(lab: Lab, outcome: LabTrial) -> bool:
    """Whether a scene is fair to all variants on which a lab was tried."""
    try:
        return bool(judged(lab, outcome.many).fair.all())
    except GraphkinError:
        return False


def candidates(
    text: str, change: float, given: Collection[str] = ()
) -> Iterator[tuple[Mending, str]]:
    """Every scene with one of its numbers larger or smaller by some percent.

    A parameter's value is changed too, unless the parameter is in ``given``, which each student
    gets.
    """
    lines, section = text.split("\n"), ""
    for row, line in enumerate(lines):
        if found := SECTION.match(line):
            section = found[1]
        key, equals, value = line.partition("=")
        shared = section == "parameters" and key.strip() not in given
        if not (section in CHANGED or shared) or not equals or FIXED.match(line):
            continue
        stated = value.partition("#")[0]
        if shared:
            found = VALUE.match(stated)
            stated = found[0] if found else ""
        for number in NUMBER.finditer(stated):
            for factor in (1 + change / 100, 1 - change / 100):
                old, new = number[0], f"{float(number[0]) * factor:.3g}"
                if float(new) == float(old):
                    continue
                start = len(key) + 1 + number.start()
                changed = line[:start] + new + line[start + len(old) :]
                percent = 100 * (float(new) / float(old) - 1)
                mending = Mending(row + 1, start, line.partition("#")[0].strip(), old, new, percent)
                yield mending, "\n".join([*lines[:row], changed, *lines[row + 1 :]])


# --- proposals ------------------------------------------------------------------------------------


CLASS = 60
"""The number of students in the class on which a proposal is tried."""
APART = 0.5
"""The largest share that another's right values may earn, where the lab states none."""
COURSE = "mechanics 2026"
"""The course for which data are drawn, where the lab states none."""


class ProposedRanges(Struct, frozen=True):
    """Ranges to draw from for a course.

    ``count`` is the number of different data. ``kept`` is the number of students with fair data, in
    a class of ``of``, at the limit ``apart``. ``exact`` is the share of data that a pencil draws
    accurately enough. ``positions`` are those of the lab, drawn from all that the scene allows.
    """

    ranges: Mapping[str, Range | ValueList]
    course: str
    count: int
    apart: float
    kept: int
    of: int
    exact: float = 1.0
    positions: SeveralValues | None = None

    @property
    def lines(self) -> list[str]:
        """The table ``[variants]`` that draws from them."""
        return variants_lines(self.ranges, self.course, self.positions)


def proposed_ranges(lab: Lab, found: FairRanges) -> ProposedRanges | None:
    """The ranges that were found, tried on a class; None where there are none."""
    if found.ranges is None:
        return None
    course = lab.rule.course or COURSE
    apart = lab.fair.apart if lab.fair.apart is not None else APART
    positions = lab.rule.positions
    own = "" if positions is None else positions.parameter
    ranges = {name: values for name, values in found.ranges.items() if name != own}
    rule = LabRule(course, ranges, positions=positions)
    new = replace(lab, rule=rule, fair=replace(lab.fair, apart=apart))
    students = [Student(i, f"{i:04d}", i) for i in range(1, CLASS + 1)]
    every = assigned(new, students)
    kept, of = sum(each.fair for each in every), len(every)
    return ProposedRanges(
        ranges, course, found.count, apart, kept, of, found.exact_inside, positions
    )


class FormulaFaults(Struct, frozen=True):
    """The numbers to which a formula is unfair, with reasons, and a change that mends it."""

    unfair: Mapping[str, str]
    mending: Mending | None = None


def formula_faults(lab: Lab) -> FormulaFaults:
    """The faults of a lab's formula, and the smallest change that mends them."""
    outcome = tried(lab)
    unfair = {
        number: "; ".join(map(str, outcome.fairness.faults(i)))
        for i, number in enumerate(outcome.names)
        if not outcome.fairness.fair[i]
    }
    return FormulaFaults(unfair, mended(lab, outcome) if unfair else None)


# --- the report on fair ranges, and the text for lab.toml -----------------------------------------


SHOWN = 6
"""The most limits listed."""
NUMBERS = 12
"""The most numbers for which the faults of a formula are listed."""


def range_lines(lab: Lab, found: FairRanges) -> Iterator[str]:
    """The whole report on where a lab is fair."""
    tried = found.tried
    draws = "all" if tried.complete else "draws"
    range_texts = (f"{name} {draw_words(values)}" for name, values in tried.space.items())
    yield from labelled("tried", [f"{len(tried.places)} {draws} of {', '.join(range_texts)}"])
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


def variants_lines(
    ranges: Mapping[str, Range | ValueList], course: str, positions: SeveralValues | None = None
) -> list[str]:
    """The table ``[variants]`` that draws from some ranges, with the positions of a lab."""
    is_drawn = bool(ranges) or positions is None or bool(positions.count)
    lines = ["[variants]", *([f'course = "{course}"'] if is_drawn else [])]
    if positions is not None:
        formulas = ", ".join(f'"{each.text}"' for each in positions.formulas)
        several = f"[{formulas}]" if formulas else str(positions.count)
        lines.append(f"positions = {{ {positions.parameter} = {several} }}")
    draws = [f"{name} = {listed_alone(values)}" for name, values in ranges.items()]
    return [*lines, "[variants.draw]", *draws] if draws else lines


def listed_alone(values: Range | ValueList) -> str:
    """The values as TOML, a single value as a list: alone, it is no rule to draw by."""
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
    """An exact number as TOML; in quotes where its decimals are infinite."""
    text = exact_text(value)
    return f'"{text}"' if "/" in text else text


def mending_lines(unfair: Mapping[str, str], mending: Mending | None) -> list[str]:
    """The numbers to which a formula is unfair, why, and the change that mends it."""
    if not unfair:
        return ["the formula is fair to every number"]
    lines = [f"number {number}: {why}" for number, why in [*unfair.items()][:NUMBERS]]
    if len(unfair) > NUMBERS:
        lines.append(f"and {len(unfair) - NUMBERS} numbers more, see graphkin check")
    if mending is None:
        return [*lines, "no change of one number of the scene by up to 12 % is fair to all"]
    change = f"{mending.old} to {mending.new} ({mending.percent:+.1f} %)"
    return [*lines, f"fair to all: scene.toml, line {mending.line}, {mending.text}: {change}"]
