"""The marks of two trial plans: thin and grey, points with tags, and the lines through them."""

from __future__ import annotations

from typing import Any

from graphkin.paper.desk import Desk, line_ends
from graphkin.paper.drawing import Drawing
from graphkin.paper.layout import BEYOND
from graphkin.paper.marks import Circle, Line
from graphkin.paper.plan import name_point, put_point
from graphkin.paper.trial_falls import fallen_on
from graphkin.plane import Line as Carrier
from graphkin.steps.program import Step

DOT = 0.5
"""Radius of a trial's point, in mm."""
TRIAL = "point trial"
"""The class of a trial's point."""
NEAR = 0.3
"""A leg of a trial shorter than this, in mm, is not drawn."""


def put_trial(desk: Desk, number: int, step: Step, value: Any) -> None:
    """A step of a trial plan: a line as far as it is needed, or a leg and the point at its end."""
    if isinstance(value, Carrier):
        ends = line_ends(desk, number, value)
        if ends and not is_idle(desk.drawing, number):
            desk.board.marks.append(Line(*ends[0], *ends[1], "trial", step.name, number))
        return
    start = leg_start(desk, step)
    at = desk.field(value)
    if start is not None:
        tail = desk.field(start)
        if abs(complex(at[0] - tail[0], at[1] - tail[1])) > NEAR:
            desk.board.marks.append(Line(*tail, *at, "trial", step.name, number))
    if step.name:
        desk.board.marks.append(Circle(*at, DOT, TRIAL, step.name, number))
        name_point(desk, number, step, at, DOT, "trial", 2.5)


def is_idle(drawing: Drawing, number: int) -> bool:
    """True for a line that finds only points which fall on where it begins."""
    users = drawing.children.get(number, ())
    return bool(users) and all(fallen_on(drawing, user) for user in users)


def leg_start(desk: Desk, step: Step) -> complex | None:
    """Where the vector begins that a step of a trial lays off; None where two lines cross."""
    if step.action is None or step.action.key in ("meet", "similar-point", "alike"):
        return None
    before = desk.drawing.trace.program.steps[step.args[0]]
    if before.plane is not desk.drawing.plane:
        return None
    return complex(desk.drawing.trace.values[step.args[0]])


def put_trial_line(desk: Desk, number: int, step: Step, value: Any) -> None:
    """The line through the two trials of a point and the right one, a little beyond them."""
    ends = line_ends(desk, number, value)
    if ends:
        desk.board.marks.append(Line(*ends[0], *ends[1], "trial-line", "", number))


def put_divided(desk: Desk, number: int, step: Step, value: Any) -> None:
    """A point of the right plan, with the line of its trials where no other step draws it."""
    if step.by_hand not in desk.drawing.trace.values:
        ends = [desk.drawing.trace.values[arg] for arg in step.args[:2]]
        way = ends[1] - ends[0]
        if abs(way) * desk.field.mm > NEAR:
            unit = way / abs(way)
            along = [((p - ends[0]) * unit.conjugate()).real for p in (*ends, value)]
            beyond = BEYOND / 2 / desk.field.mm
            first, last = (
                desk.field(ends[0] + reach * unit)
                for reach in (min(along) - beyond, max(along) + beyond)
            )
            desk.board.marks.append(Line(*first, *last, "trial-line", "", number))
    put_point(desk, number, step, value)


def raise_trials(desk: Desk) -> None:
    """Put the points of trials over the arrows that would hide them, not over the right points."""
    circles = [mark for mark in desk.board.marks if isinstance(mark, Circle)]
    trials = [mark for mark in circles if mark.cls == TRIAL]
    right = [complex(mark.cx, mark.cy) for mark in circles if mark.cls != TRIAL]
    free = {
        id(mark)
        for mark in trials
        if all(abs(complex(mark.cx, mark.cy) - at) > 2 * DOT for at in right)
    }
    desk.board.marks.sort(key=lambda mark: id(mark) in free)
