"""Points determined by two loci or two pins: how they fail, and how flat their crossings are."""

from __future__ import annotations

from collections.abc import Sequence
from math import asin, inf, sin
from typing import Any, ClassVar

from msgspec import Struct

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import ClosesGroup, Construction, construction
from graphkin.construction.core.program import Part, Plane, Program, Step
from graphkin.construction.core.run import Trace
from graphkin.text.errors import NO_WORDS, Message, Problem, message

LOCI = message("loci that cross")
"""What a point at the crossing of two loci needs."""


class Determined(Construction, frozen=True):
    """A point or a direction that two loci determine.

    ``loci`` is the name of the loci, ``apart`` the message for two loci that do not meet.
    ``has_angle`` says that the margin is the sine of their crossing angle. ``has_mirror`` says that
    they cross a second time, on the other side.
    """

    loci: ClassVar[Message] = message("the loci")
    apart: ClassVar[Message] = message("the loci miss each other")
    has_angle: ClassVar[bool] = True
    has_mirror: ClassVar[bool] = False

    def in_line(self, steps: Sequence[Step], *, nearly: bool) -> Message:
        """The points in line or perpendicular where it fails, or nearly so where it is flat."""
        return NO_WORDS

    @property
    def reaching(self) -> Message:
        """What is needed where the loci do not meet."""
        return LOCI

    def failing(self) -> Message:
        """The cause where the loci do not meet; empty where the lines of the message say it."""
        return NO_WORDS

    def undetermined(self, args: Sequence[Any]) -> Problem | None:
        """The problem of loci that leave every place or direction open; None where they do not."""
        return None

    def at_end(self, steps: Sequence[Step], loci: Sequence[Any]) -> tuple[str, str] | None:
        """What cannot be found beyond the end of a range, and how the lines lie there."""
        return None


def which_side(drawing: Drawing, number: int) -> int:
    """The sign of the crossing that a step takes, stated or found with a group."""
    step = drawing.trace.program.steps[number]
    return round(step.extra[0] if step.extra else drawing.trace.values[step.args[2]])


FAR = 1e-3
"""The sine of the angle below which two lines count as parallel: their centre is at infinity."""


class Crossing(Struct, frozen=True):
    """A crossing of two lines or arcs: its step, its letter, its part of the work, its angle.

    ``angle`` is the smaller of the two angles, in radians.
    """

    number: int
    name: str
    part: Part
    angle: float

    @property
    def factor(self) -> float:
        """The largest displacement of the crossing when each line is one unit off: 1/sin(θ/2)."""
        return 1 / sin(self.angle / 2) if self.angle else inf


def crossings(trace: Trace) -> tuple[Crossing, ...]:
    """Every crossing that is drawn, in drawing order.

    Crossings in a link's own axes and centres at infinity are not drawn.
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
    centre = step.part in (Part.CENTRE, Part.POLE)
    first = not is_found_by_closing(step) or step.role == "tried"
    angle = not isinstance(step.of, Determined) or step.of.has_angle
    return step.part is not Part.SHAPE and angle and first and not (centre and sine < FAR)


def is_found_by_closing(step: Step) -> bool:
    """Whether a step holds a value found by closing a group of higher class."""
    kind = construction(step)
    return isinstance(kind, ClosesGroup) and bool(kind.closes) and step.role != "closing"


def flattest(found: tuple[Crossing, ...]) -> Crossing | None:
    """The crossing with the smallest angle, the first one of equals; None if there is none."""
    return min(found, key=lambda crossing: crossing.angle, default=None)


def letter_of(program: Program, number: int) -> str:
    """The letter of the point that a step gives, or of the step that it gives by hand.

    The crossing that closes a group has the first letter that follows from its trial value. Empty
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
    """The letter of the first drawn point that depends on a step, in the same part of the work."""
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
