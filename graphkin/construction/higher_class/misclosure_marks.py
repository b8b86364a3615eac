"""The gaps of two trial plans that no crossing settles: each from its point to its own line."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.layout import BEYOND
from graphkin.construction.core.plot import Plot
from graphkin.construction.core.program import Part, Plane, Step
from graphkin.construction.higher_class.trial_actions import lacks, lacks_across
from graphkin.construction.higher_class.trial_marks import NEAR
from graphkin.drawing.marks import LineMark
from graphkin.numbers.arithmetic import larger, smaller
from graphkin.numbers.plane import dot

LOOKS = {"laid off": "trial", "locus of a trial": "trial", "gap": "trial-line"}
"""The lines of a gap by their names: what is laid off, the line that its point should lie on from
the end of that, and the way to it from the point."""


def put_gaps(plot: Plot) -> None:
    """Put down the gaps that are measured, each with the line that it is measured from."""
    mm, value = plot.field.mm, plot.drawing.trace.values.__getitem__
    for number, step in measured(plot.drawing):
        for name, tail, tip in gap_lines(number, step, value, mm):
            if abs(tip - tail) * mm > NEAR:
                line = LineMark(*plot.field(tail), *plot.field(tip), LOOKS[name], name, number)
                plot.board.marks.append(line)


def measured(drawing: Drawing) -> Iterator[tuple[int, Step]]:
    """The steps that hold what trials miss where no crossing tells how the right plan divides."""
    trace = drawing.trace
    for _, share, _ in drawing.steps(Plane.NUMBERS):
        called = share.action is not None and share.action.key == "share"
        if called and share.part is Part(drawing.kind) and share.by_hand not in trace.values:
            yield from ((number, trace.program.steps[number]) for number in share.args)


def gap_lines(
    number: int, step: Step, value: Callable[[int], Any], mm: float
) -> Iterator[tuple[str, Any, Any]]:
    """The lines of a gap by the values of steps; none where it is what a driver gives."""
    if step.action is lacks:
        p, q, foot, tip, wanted = map(value, step.args)
        across, start = (q - p) / abs(q - p), foot + wanted
    elif step.action is lacks_across:
        guide, start, tip = map(value, step.args)
        across, foot = 1j * guide.along / abs(guide.along), start
    else:
        return
    end, along, beyond = tip - across * value(number), 1j * across, BEYOND / 2 / mm
    reach = dot(along, end - start)
    low, high = smaller(reach, 0.0) - beyond, larger(reach, 0.0) + beyond
    yield "laid off", foot, start
    yield "locus of a trial", start + along * low, start + along * high
    yield "gap", tip, end
