"""From a trace to the solution: each quantity under the point or link that it belongs to."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from graphkin.arithmetic import Real, least
from graphkin.steps.program import CONTACT, Part
from graphkin.steps.run import Trace
from graphkin.steps.solution import LinkMotion, PointMotion, SlideMotion, Solution

POINT = ("position", "velocity", "acceleration")
LINK = ("omega", "epsilon", "centre", "pole", "inflection")
SLIDE = ("slide", "slide speed", "slide acceleration", "coriolis")


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
