"""From a trace to the solution: each quantity under the point or link that it belongs to."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import fields, replace
from typing import Any

from graphkin.construction.core.program import CONTACT, Part
from graphkin.construction.core.run import Trace
from graphkin.construction.core.solution import LinkMotion, PointMotion, SlideMotion, Solution
from graphkin.numbers.arithmetic import Real, least
from graphkin.numbers.plane import Ratio

TOUCHING = 8
"""Sine of a crossing, in roots of eps, at which two loci count as touching in a batch."""
POINT = ("position", "velocity", "acceleration")
LINK = ("omega", "epsilon", "centre", "pole", "inflection")
SLIDE = ("slide", "slide speed", "slide acceleration", "coriolis")
ALL = -1
"""Where a merged trace has the product of its sines, beside the smallest of them."""


def gathered(trace: Trace, links: Iterable[str] | None = None) -> Solution:
    """The solution that a trace holds, links in the given order; what was not run is None."""
    motions = {name: found for name, found in of_kind(trace, LINK) if "-" not in name}
    centres = {name: trace.value("centre", name) for name, _ in of_kind(trace, ("centre",))}
    return Solution(
        points={name: PointMotion(*found) for name, found in of_kind(trace, POINT)},
        links={n: link_motion(trace, n, motions[n]) for n in links or motions if n in motions},
        slides={name: SlideMotion(*found) for name, found in of_kind(trace, SLIDE)},
        margin=smallest_margin(trace),
        centres={name: found for name, found in centres.items() if "-" in name},
    )


def link_motion(trace: Trace, link: str, found: list[Any]) -> LinkMotion:
    """The motion of a link; the centre on its inflection circle is its instantaneous centre."""
    motion = LinkMotion(*found)
    if motion.instant_centre is None:
        return replace(motion, instant_centre=trace.value("inflection centre", link))
    return motion


def of_kind(trace: Trace, quantities: tuple[str, ...]) -> Iterable[tuple[str, list[Any]]]:
    """The values of some quantities of each point or link that has any of them."""
    names = dict.fromkeys(of for quantity, of in trace.program.targets if quantity in quantities)
    for name in names:
        if name.startswith(CONTACT):
            continue
        found = [trace.value(quantity, name) for quantity in quantities]
        if any(value is not None for value in found):
            yield name, found


def merged(trace: Trace) -> Trace:
    """The same trace with the smallest of its margins alone, and with the product of its sines."""
    crossings = counted(trace)
    if not crossings:
        return replace(trace, margins={})
    margins = {next(iter(crossings)): smallest_margin(trace), ALL: product_of_sines(trace)}
    return replace(trace, margins=margins)


def decided(trace: Trace) -> Trace:
    """A batch without the variants in which two loci touch: there no digit of a rate is right.

    At a sine below 8·sqrt(eps), 1.2e-7 for doubles, they become NaN: a sine that ought to be
    nought comes out that large, and by the 1-2-3 law a velocity has lost all but two digits.
    """
    import numpy as np

    margin = smallest_margin(trace)
    if not isinstance(margin, np.ndarray):
        return trace
    touching = margin < TOUCHING * np.finfo(margin.dtype).eps ** 0.5
    if not touching.any():
        return trace
    values = {number: without(value, touching) for number, value in trace.values.items()}
    return replace(trace, values=values)


def without(value: Any, some: Any) -> Any:
    """A value with NaN for some of its variants; what all variants share stays."""
    import numpy as np

    if isinstance(value, Ratio):
        return Ratio(*(without(part, some) for part in value))
    return np.where(some, np.nan, value) if isinstance(value, np.ndarray) else value


def smallest_margin(trace: Trace) -> Real:
    """The smallest sine of crossing in the construction; 1 when nothing crossed, NaN where one
    of a batch cannot be drawn.

    The flat triangles of plates do not count: their points follow by similarity.
    """
    smallest: Real = 1.0
    for margin in counted(trace).values():
        smallest = least(smallest, margin)
    return smallest


def product_of_sines(trace: Trace) -> Real:
    """The product of the sines at all crossings of the mechanism, each of which multiplies errors;
    NaN where one of a batch cannot be drawn."""
    product: Real = trace.margins.get(ALL, 1.0)
    for number, margin in counted(trace).items():
        if ALL not in trace.margins and trace.program.steps[number].part is Part.POSITION:
            product = product * margin
    return product


def counted(trace: Trace) -> dict[int, Real]:
    """The margins of crossings that place or move something, by their steps."""
    steps = trace.program.steps
    return {
        number: margin
        for number, margin in trace.margins.items()
        if number != ALL and not steps[number].hand and steps[number].part is not Part.SHAPE
    }


def rows_of(solution: Solution, rows: Any) -> Solution:
    """Some rows of a solution of arrays; what all variants share stays."""

    def cut(record: Any) -> Any:
        found = {f.name: getattr(record, f.name) for f in fields(record)}
        return replace(record, **{name: row_of(v, rows) for name, v in found.items()})

    parts = ("points", "links", "slides")
    motions = {p: {n: cut(each) for n, each in getattr(solution, p).items()} for p in parts}
    centres = {name: row_of(ratio, rows) for name, ratio in solution.centres.items()}
    return Solution(**motions, margin=row_of(solution.margin, rows), centres=centres)


def row_of(value: Any, rows: Any) -> Any:
    """Some rows of an array, or of each part of a ratio; what is no array stays."""
    if isinstance(value, Ratio):
        return Ratio(*(row_of(part, rows) for part in value))
    return value[rows] if hasattr(value, "shape") and value.shape else value
