"""The words of wheels on the mechanism: their tracks, how far they have come and turned."""

from __future__ import annotations

from math import degrees

from graphkin.paper.drawing import Drawing
from graphkin.paper.lines import straight
from graphkin.paper.naming import amount
from graphkin.scene.model import FRAME
from graphkin.steps.program import Step

SAME = 1e-9
"""Radii and angles nearer than this, in parts of themselves or in radians, are the same."""


def track_line(drawing: Drawing, step: Step) -> str:
    """The line of a straight track of a moving link, as the data have it."""
    link, on = drawing.scene.links[step.says["g"]], step.says["h"]
    return straight(drawing, next(r for r in link.rolls if r.on == on and r.angle is not None))


def is_moving_track(step: Step) -> bool:
    """True for the line of a straight track of a moving link."""
    return step.says.get("h", FRAME) != FRAME


def untold_track(drawing: Drawing, step: Step) -> Step | None:
    """The track of a point of contact on a moving link, where no path of the centre tells of it."""
    if step.action is None or step.action.key != "contact-on-track" or step.says["g"] == FRAME:
        return None
    steps, track = drawing.trace.program.steps, step.args[0]
    users = (steps[user].action for user in drawing.children.get(track, ()))
    told = any(action is not None and action.key == "radius-along" for action in users)
    return None if told else steps[track]


def is_halfway(drawing: Drawing, where: Step) -> bool:
    """True for a roller that has rolled as far on one of its two tracks as on the other."""
    if where.action is None or where.action.key != "between-tracks":
        return False
    lean, one, two = (float(drawing.trace.values[arg]) for arg in where.args[2:])
    return abs(lean) < SAME and abs(abs(one) - abs(two)) < SAME * abs(one)


def arc_rolled(drawing: Drawing, step: Step) -> str:
    """The arc by which a rack has moved since the start."""
    return amount(drawing, abs(float(drawing.trace.values[step.args[-1]])))


def turned_by(drawing: Drawing, link: str) -> str:
    """By how many degrees a wheel has turned since the start; nothing for what rolls nowhere."""
    targets, values = drawing.trace.program.targets, drawing.trace.values
    ends = [targets.get((what, link), -1) for what in ("turned", "turned from")]
    if not all(number in values for number in ends):
        return ""
    now, start = (float(values[number]) for number in ends)
    return drawing.words.fixed(degrees(now - start), 1)
