"""What two loci, or two pins, determine, in what words that fails, and how flat lines cross."""

from __future__ import annotations

from collections.abc import Sequence
from math import asin, inf, sin
from typing import Any, ClassVar

from msgspec import Struct

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import ClosesGroup, Construction, construction
from graphkin.construction.core.program import Part, Plane, Program, Step
from graphkin.construction.core.run import Trace
from graphkin.text.errors import Problem

LOCI = "loci that cross"
"""What a point needs that is found where two loci cross."""


class Determined(Construction, frozen=True):
    """A point or a direction that two loci determine.

    ``loci`` is what these are called, ``apart`` the words for two that miss each other.
    ``has_angle`` says that its margin is the sine of the angle at which they cross, ``has_mirror``
    that they cross a second time, on the other side.
    """

    loci: ClassVar[str] = "the loci"
    apart: ClassVar[str] = "the loci miss each other"
    has_angle: ClassVar[bool] = True
    has_mirror: ClassVar[bool] = False

    def in_line(self, steps: Sequence[Step], nearly: str) -> str:
        """What lies in line or perpendicular where it fails; ``nearly`` is put before, if flat."""
        return ""

    @property
    def reaching(self) -> str:
        """What is needed where its loci miss each other."""
        return LOCI

    def failing(self) -> str:
        """Words for what hinders it where its loci do not meet; nothing where lines say it."""
        return ""

    def undetermined(self, args: Sequence[Any]) -> Problem | None:
        """The problem of loci that leave any place or direction open; None where they do not."""
        return None

    def at_end(self, steps: Sequence[Step], loci: Sequence[Any]) -> tuple[str, str] | None:
        """What cannot be found beyond the end of a range, and how the lines lie there."""
        return None


def which_side(drawing: Drawing, number: int) -> int:
    """Which of two crossings a step takes, by its sign: stated, or found with a group."""
    step = drawing.trace.program.steps[number]
    return round(step.extra[0] if step.extra else drawing.trace.values[step.args[2]])


FAR = 1e-3
"""Sine below which the lines to a centre are parallel on paper: it is at infinity."""


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
    centre = step.part in (Part.CENTRE, Part.POLE)
    first = not is_found_by_closing(step) or step.role == "tried"
    angle = not isinstance(step.of, Determined) or step.of.has_angle
    return step.part is not Part.SHAPE and angle and first and not (centre and sine < FAR)


def is_found_by_closing(step: Step) -> bool:
    """Whether a step holds a value at which a group of higher class was found to close."""
    kind = construction(step)
    return isinstance(kind, ClosesGroup) and bool(kind.closes) and step.role != "closing"


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
