"""Two parallel velocities and the line through their tips, which meets their bar in the centre."""

from __future__ import annotations

from collections.abc import Mapping

from graphkin.construction.centres.centre_words import at_rest, oddity
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.plot import Plot, above_foot
from graphkin.construction.core.program import Plane, Step
from graphkin.drawing.field import clipped
from graphkin.drawing.label import Label
from graphkin.drawing.marks import LineMark
from graphkin.drawing.symbol_markup import symbol
from graphkin.drawing.symbols import arrow
from graphkin.numbers.plane import cross

PARALLEL = 1e-6
"""Sine of the angle below which two velocities are parallel."""
BEYOND = 4.0
"""How far the line goes on beyond the tips, in mm."""


def parallel_velocities(drawing: Drawing, step: Step) -> dict[str, tuple[int, int]]:
    """The points by whose parallel velocities a centre is found: the steps of place and image.

    None where the perpendiculars cross, and where one of the points is at rest.
    """
    if step.action is None or step.action.key != "instant-centre":
        return {}
    if oddity(drawing, step) != "still" or at_rest(drawing, step, {}) != "tips":
        return {}
    pole, *places, one, other = step.args
    ways = [drawing.trace.values[image] - drawing.trace.values[pole] for image in (one, other)]
    if abs(cross(*ways)) > PARALLEL * abs(ways[0]) * abs(ways[1]):
        return {}
    names = (step.says["p"], step.says["q"])
    return dict(zip(names, zip(places, (one, other), strict=True), strict=True))


def set_before(drawing: Drawing) -> Mapping[int, int]:
    """The velocities that are set on the mechanism to find a centre, each with its centre."""
    ends = {
        pair: number
        for number, step, _ in drawing.mechanism_steps()
        for pair in parallel_velocities(drawing, step).values()
    }
    return {
        number: ends[step.args[0], step.args[2]]
        for number, step, _ in drawing.mechanism_steps()
        if step.action is not None and step.action.key == "set-on"
        if (step.args[0], step.args[2]) in ends
    }


def put_tips(plot: Plot, number: int, step: Step) -> None:
    """The line through the tips of two parallel velocities, and those that nothing else draws."""
    drawing, tips = plot.drawing, []
    values, pole = drawing.trace.values, drawing.trace.values[step.args[0]]
    drawn = {steps.args[:3] for _, steps, _ in drawing.mechanism_steps() if steps.arrow}
    for name, (place, image) in parallel_velocities(drawing, step).items():
        way = drawing.at_scale(Plane.VELOCITIES, values[image] - pole)
        tail, tip = plot.field(values[place]), plot.field(values[place] + way)
        tips.append(values[place] + way)
        if (place, step.args[0], image) not in drawn:
            plot.board.marks += arrow(tail, tip, plot.colour, f"v_{name}", number)
            label = Label(symbol(f"v_{name}"), plot.colour, (tail, tip), 2.5, f"v_{name}", number)
            plot.board.labels.append(label)
    if len(tips) == 2 and tips[0] != tips[1]:
        on = (tips[1] - tips[0]) / abs(tips[1] - tips[0]) * BEYOND / plot.field.mm
        ends = plot.field(tips[0] - on), plot.field(tips[1] + on)
        part = clipped(*ends, above_foot(plot.field.rect))
        if part:
            plot.board.marks.append(LineMark(*part[0], *part[1], "ray", step.name, number))
