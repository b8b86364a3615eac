"""The marks of two trial plans: thin and grey, points with tags, and the lines through them."""

from __future__ import annotations

from typing import Any

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.layout import BEYOND
from graphkin.construction.core.plan_marks import name_point, put_point
from graphkin.construction.core.plot import Plot, line_ends
from graphkin.construction.core.program import Step
from graphkin.construction.higher_class.coincident_images import fallen_on
from graphkin.drawing.marks import CircleMark, LineMark
from graphkin.numbers.plane import Line as Carrier

DOT = 0.5
"""Radius of a trial's point, in mm."""
TRIAL = "point trial"
"""The class of a trial's point."""
NEAR = 0.3
"""A leg of a trial shorter than this, in mm, is not drawn."""


def put_trial(plot: Plot, number: int, step: Step, value: Any) -> None:
    """A step of a trial plan: a line as far as it is needed, or a leg and the point at its end."""
    if isinstance(value, Carrier):
        ends = line_ends(plot, number, value)
        if ends and not is_idle(plot.drawing, number):
            plot.board.marks.append(LineMark(*ends[0], *ends[1], "trial", step.name, number))
        return
    start = leg_start(plot, step)
    at = plot.field(value)
    if start is not None:
        tail = plot.field(start)
        if abs(complex(at[0] - tail[0], at[1] - tail[1])) > NEAR:
            plot.board.marks.append(LineMark(*tail, *at, "trial", step.name, number))
    if step.name:
        plot.board.marks.append(CircleMark(*at, DOT, TRIAL, step.name, number))
        name_point(plot, number, step, at, DOT, "trial", 2.5)


def is_idle(drawing: Drawing, number: int) -> bool:
    """True for a line that finds only points which fall on where it begins."""
    users = drawing.children.get(number, ())
    return bool(users) and all(fallen_on(drawing, user) for user in users)


def leg_start(plot: Plot, step: Step) -> complex | None:
    """Where the vector begins that a step of a trial lays off; None where two lines cross."""
    if step.action is None or step.action.key in ("meet", "similar-point", "alike"):
        return None
    before = plot.drawing.trace.program.steps[step.args[0]]
    if before.plane is not plot.drawing.plane:
        return None
    return complex(plot.drawing.trace.values[step.args[0]])


def put_trial_line(plot: Plot, number: int, step: Step, value: Any) -> None:
    """The line through the two trials of a point and the right one, a little beyond them."""
    ends = line_ends(plot, number, value)
    if ends:
        plot.board.marks.append(LineMark(*ends[0], *ends[1], "trial-line", "", number))


def put_divided(plot: Plot, number: int, step: Step, value: Any) -> None:
    """A point of the right plan, with the line of its trials where no other step draws it."""
    if step.by_hand not in plot.drawing.trace.values:
        ends = [plot.drawing.trace.values[arg] for arg in step.args[:2]]
        way = ends[1] - ends[0]
        if abs(way) * plot.field.mm > NEAR:
            unit = way / abs(way)
            along = [((p - ends[0]) * unit.conjugate()).real for p in (*ends, value)]
            beyond = BEYOND / 2 / plot.field.mm
            first, last = (
                plot.field(ends[0] + reach * unit)
                for reach in (min(along) - beyond, max(along) + beyond)
            )
            plot.board.marks.append(LineMark(*first, *last, "trial-line", "", number))
    put_point(plot, number, step, value)


def raise_trials(plot: Plot) -> None:
    """Put the points of trials over the arrows that would hide them, not over the right points."""
    circles = [mark for mark in plot.board.marks if isinstance(mark, CircleMark)]
    trials = [mark for mark in circles if mark.cls == TRIAL]
    right = [complex(mark.cx, mark.cy) for mark in circles if mark.cls != TRIAL]
    free = {
        id(mark)
        for mark in trials
        if all(abs(complex(mark.cx, mark.cy) - at) > 2 * DOT for at in right)
    }
    plot.board.marks.sort(key=lambda mark: id(mark) in free)
