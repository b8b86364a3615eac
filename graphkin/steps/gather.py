"""From a trace to the solution: each quantity under the point or link that it belongs to."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from graphkin.arithmetic import Real, least
from graphkin.steps.program import Part
from graphkin.steps.run import Trace
from graphkin.steps.solution import LinkMotion, PointMotion, SlideMotion, Solution

POINT = ("position", "velocity", "acceleration")
LINK = ("omega", "epsilon", "centre", "pole")
SLIDE = ("slide", "slide speed", "slide acceleration", "coriolis")


def gathered(trace: Trace, links: Iterable[str] | None = None) -> Solution:
    """The solution that a trace holds, links in the given order; what was not run is None."""
    motions = dict(of_kind(trace, LINK))
    return Solution(
        points={name: PointMotion(*found) for name, found in of_kind(trace, POINT)},
        links={name: LinkMotion(*motions[name]) for name in links or motions if name in motions},
        slides={name: SlideMotion(*found) for name, found in of_kind(trace, SLIDE)},
        margin=smallest_margin(trace),
    )


def of_kind(trace: Trace, quantities: tuple[str, ...]) -> Iterable[tuple[str, list[Any]]]:
    """The values of some quantities of each point or link that has any of them."""
    names = dict.fromkeys(of for quantity, of in trace.program.targets if quantity in quantities)
    for name in names:
        found = [trace.value(quantity, name) for quantity in quantities]
        if any(value is not None for value in found):
            yield name, found


def smallest_margin(trace: Trace) -> Real:
    """The smallest sine of crossing in the construction; 1 when nothing crossed, NaN where one
    of a batch cannot be drawn.

    The flat triangles of plates do not count: their points follow by similarity.
    """
    smallest: Real = 1.0
    for number, margin in trace.margins.items():
        step = trace.program.steps[number]
        if not step.hand and step.part is not Part.SHAPE:
            smallest = least(smallest, margin)
    return smallest
