"""The words of wheels on the mechanism: their tracks, how far they have come and turned."""

from __future__ import annotations

from math import degrees

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.line_words import straight
from graphkin.construction.core.naming import drawn_amount
from graphkin.construction.core.program import Step
from graphkin.construction.core.sentence import Sentence, together
from graphkin.drawing.richtext import escape
from graphkin.drawing.symbol_markup import symbol
from graphkin.scene.model import FRAME

UNTURNED = 0.05
"""A wheel that has turned by less, in degrees, is drawn as at the start."""
SAME = 1e-9
"""Radii and angles nearer than this, in parts of themselves or in radians, are the same."""


def track_line(drawing: Drawing, step: Step) -> str:
    """The line of a straight track of a moving link, as it is drawn."""
    link, on = drawing.scene.links[step.says["g"]], step.says["h"]
    track = next(r for r in link.rolls if r.on == on and r.angle is not None)
    return straight(drawing, track, on_paper=True)


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
    """The arc by which a rack has moved since the start, as long as it is drawn."""
    return drawn_amount(drawing, abs(float(drawing.trace.values[step.args[-1]])))


def turned_by(drawing: Drawing, link: str) -> str:
    """By how many degrees a wheel has turned since the start; nothing for what rolls nowhere."""
    since = turned_since(drawing, link)
    return "" if since is None else drawing.words.fixed(since, 1)


def turned_since(drawing: Drawing, link: str) -> float | None:
    """The same in degrees; None for what rolls nowhere."""
    targets, values = drawing.trace.program.targets, drawing.trace.values
    ends = [targets.get((what, link), -1) for what in ("turned", "turned from")]
    if not all(number in values for number in ends):
        return None
    now, start = (float(values[number]) for number in ends)
    return degrees(now - start)


def with_starts_together(drawing: Drawing, found: list[Sentence]) -> list[Sentence]:
    """The points of each wheel that stands as at the start said in one sentence: as given."""
    steps = drawing.trace.program.steps
    alike: dict[tuple[str, str], list[Sentence]] = {}
    for said in found:
        step = steps[said.step] if said.step >= 0 else None
        if step is not None and step.action is not None and step.action.key == "beside":
            link, start = step.says["g"], step.says["p"]
            since = turned_since(drawing, link)
            if since is not None and abs(since) < UNTURNED:
                alike.setdefault((link, start), []).append(said)
    for (link, start), some in alike.items():
        names = drawing.words("list_mark").join(symbol(steps[said.step].name) for said in some)
        fields = {"g": escape(link), "p": symbol(start), "list": names}
        found = together(found, some, drawing.words("step.beside-start", **fields))
    return found


def radius_to(drawing: Drawing, step: Step) -> dict[str, str]:
    """The radius at which two wheels touch, and the centre that it is laid off from."""
    where, size = drawing.trace.values[step.args[0]], abs(float(drawing.trace.values[step.args[2]]))
    disc = min(
        drawing.standing.discs, key=lambda disc: abs(disc.centre - where) + abs(disc.radius - size)
    )
    count = " = *m*·*z*/2" if disc.module else ""
    radius = f"{symbol(f'r_{disc.link}')}{count} ({drawn_amount(drawing, size)})"
    return {"radius": radius, "o": symbol(disc.wheel.centre)}
