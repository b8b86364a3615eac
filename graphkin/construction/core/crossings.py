"""How flat the lines of a drawing cross, and what a millimetre of pencil becomes there."""

from __future__ import annotations

from math import asin, inf, sin

from msgspec import Struct

from graphkin.construction.core.determined import Determined
from graphkin.construction.core.program import Part, Plane, Program, Step
from graphkin.construction.core.run import Trace

FAR = 1e-3
"""Sine below which the lines to a centre are parallel on paper: it is at infinity."""
CLOSED = "part"
"""The action that takes a value from what closes a group; its first one is where loci cross."""


class Crossing(Struct, frozen=True):
    """A crossing of two lines or arcs: its step, its letter, its part of the work, its angle.

    ``angle`` is the one of the two angles that is not obtuse, in radians.
    """

    number: int
    name: str
    part: Part
    angle: float

    @property
    def factor(self) -> float:
        """How far the crossing goes, at worst, when each line is a unit off: 1/sin(θ/2)."""
        return 1 / sin(self.angle / 2) if self.angle else inf


def crossings(trace: Trace) -> tuple[Crossing, ...]:
    """Every crossing that is drawn, in the order of the drawing.

    Shapes that are worked out in a link's own axes are not drawn, nor are centres at infinity.
    """
    found = []
    for number, sine in trace.margins.items():
        if is_drawn(trace.program.steps[number], float(sine)):
            angle = asin(min(max(float(sine), 0.0), 1.0))
            name = letter_of(trace.program, number)
            found.append(Crossing(number, name, trace.program.steps[number].part, angle))
    return tuple(found)


def is_drawn(step: Step, sine: float) -> bool:
    """Whether a step with a margin is a crossing on paper."""
    key = step.action.key if step.action is not None else ""
    centre = step.part in (Part.CENTRE, Part.POLE)
    first = key != CLOSED or step.extra == (0,)
    angle = not isinstance(step.of, Determined) or step.of.has_angle
    return step.part is not Part.SHAPE and angle and first and not (centre and sine < FAR)


def is_found_by_closing(step: Step) -> bool:
    """Whether a step holds a value at which a group of higher class was found to close."""
    return step.action is not None and step.action.key == CLOSED


def flattest(found: tuple[Crossing, ...]) -> Crossing | None:
    """The crossing at the smallest angle, the first of equals; None where nothing crosses."""
    return min(found, key=lambda crossing: crossing.angle, default=None)


def letter_of(program: Program, number: int) -> str:
    """The letter of the point that a step gives: its own, or that of what it gives by hand.

    The crossing that closes a group bears the first letter that its tried value leads to. Nothing
    where the drawing has no letter for it.
    """
    step = program.steps[number]
    if step.name:
        return step.name
    whole = next((other for other in program.steps if other.by_hand == number), None)
    if whole is not None:
        return whole.name
    return after(program, number, step)


def after(program: Program, number: int, step: Step) -> str:
    """The letter of the first drawn point that comes of a step in its part of the work."""
    reached = {number}
    for later in range(number + 1, len(program.steps)):
        following = program.steps[later]
        if following.part is not step.part:
            continue
        if reached.intersection(following.args):
            if following.name and following.plane is not Plane.NUMBERS and not following.arrow:
                return following.name
            reached.add(later)
    return ""
