"""A force whose line of action is known: its size by moments about a point.

The force of a cam acts along the common normal. The force in an outer pin of a group of class III
acts along its bar, once the part across the bar is known; moments are taken about the point in
which the lines of two other bars meet (Assur's point). The force between two links that slide
along each other is normal to their guide.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import combinations
from typing import Any, ClassVar

from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Construction
from graphkin.construction.core.naming import way_of
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import OwnStep, Part, Plane
from graphkin.construction.core.vocabulary import action, meet
from graphkin.construction.forces.moments import (
    SEEN,
    ForceByMoments,
    Moments,
    arm,
    moment_sum,
    right_angle,
)
from graphkin.construction.forces.polygon import SideDirection, links_words
from graphkin.drawing.symbol_markup import escape, symbol
from graphkin.numbers.arithmetic import Point
from graphkin.numbers.plane import Line, cross, crossing_sine

LETTERS = ("W", "Z", "N", "W0", "Z0", "N0")
"""The names of Assur's point, the first of which is free."""


@action("foot-on-line")
def foot_on_line(point: Point, line: Line) -> Point:
    """The foot of the perpendicular from a point to a line."""
    return arm.value(point, line.point, line.along)


@action("line-force")
def line_force(about: Point, foot: Point, line: Line, *rest: Any) -> Point:
    """The force along a line that balances the moments about a point with its foot on the line."""
    unit = line.along / abs(line.along)
    return -moment_sum(about, rest) / cross(foot - about, unit) * unit


class ForceOnLine(ForceByMoments, frozen=True, kw_only=True):
    """A force along a known line through a point, with its arm called ``number``.

    ``through`` is the step of the point, ``foot`` is the end of the arm on the line.
    """

    number: str
    through: int
    foot: OwnStep

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the line as far as the foot, and the arm with its dimension."""
        about, through, foot = map(canvas.value, (self.moments.about, self.through, self.foot))
        if role != "foot" or canvas.size(foot - about) <= SEEN or not canvas.holds(about):
            return
        canvas.leg(self.name, "ray", through, foot)
        canvas.dimension(self.number, about, foot)
        along = foot - through
        way = along if canvas.size(along) > SEEN else 1j * (about - foot)
        right_angle(canvas, foot, about, way)

    def arm(self, drawing: Drawing) -> Sequence[tuple[str, str]]:
        """The distance of the line."""
        return [(symbol(self.number), self.reach(drawing, self.foot))]


class LineForce(ForceOnLine, frozen=True, kw_only=True):
    """The force ``name`` on some ``links`` along a line, whose direction is the ``way``.

    ``cam`` says that the line is the common normal of a cam and its follower.
    """

    reasons: ClassVar[Mapping[str, str]] = {"force": "why.force_line"}
    none: ClassVar[str] = "step.force-line-none"

    links: tuple[str, ...]
    way: SideDirection
    cam: bool

    def sentence_key(self, drawing: Drawing) -> str:
        return "step.force-normal" if self.cam else "step.force-line"

    def fields(self, drawing: Drawing) -> Mapping[str, str]:
        """The links, the line and the arm."""
        links, way = links_words(drawing, self.links), self.way.words(drawing)
        return {**super().fields(drawing), "k": links, "way": way, "h": symbol(self.number)}


class AssurPoint(Construction, frozen=True, kw_only=True):
    """The point of a group of class III in which the lines of two of its arms meet."""

    one: int
    other: int
    starts: tuple[int, int]
    point: OwnStep

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw both lines as far as the point."""
        point = canvas.value(self.point)
        if canvas.holds(point):
            for start in self.starts:
                canvas.leg("", "ray", canvas.value(start), point)
            canvas.image()


def in_order(pen: Pen, lines: Sequence[int]) -> tuple[int, int, int]:
    """The numbers of three lines, first the two that cross at the largest angle in the scene."""
    shown = [pen.peek(line) for line in lines]
    if any(line is None for line in shown):
        return 0, 1, 2
    both = max(combinations(range(3), 2), key=lambda e: crossing_sine(shown[e[0]], shown[e[1]]))
    (last,) = {0, 1, 2} - {*both}
    return both[0], both[1], last


def meeting(pen: Pen, one: int, other: int, starts: tuple[int, int]) -> int:
    """The point in which the lines of two arms meet."""
    name = next(letter for letter in LETTERS if letter not in pen.scene.points)
    with pen.on(Part.FORCE, Plane.MECHANISM):
        point = pen.draw(meet, one, other, name=name)
    return pen.make(AssurPoint(one=one, other=other, starts=starts, point=point)).point


def along_line(
    pen: Pen,
    name: str,
    number: str,
    links: tuple[str, ...],
    line: int,
    through: int,
    moments: Moments,
    way: SideDirection,
    *,
    cam: bool = False,
) -> int:
    """The force along the step of a line that balances moments; its step."""
    with pen.on(Part.FORCE, Plane.MECHANISM):
        end = pen.draw(foot_on_line, moments.about, line)
    force = moments.balanced(pen, line_force, end, line)
    found = LineForce(
        name=name,
        number=number,
        links=links,
        way=way,
        cam=cam,
        moments=moments,
        through=through,
        foot=end,
        force=force,
    )
    return pen.make(found).force


# --- the force of a guide, normal to it -----------------------------------------------------------


@action("pressure-arm")
def pressure_arm(about: Point, place: Point, guide: Line) -> Point:
    """The foot of the perpendicular from a pin to the normal of a guide at a place."""
    return arm.value(about, place, 1j * guide.along)


@action("slide-pressure")
def slide_pressure(far: Point, foot: Point, guide: Line, near: Point, *rest: Any) -> Point:
    """The force of a guide that balances the moments of both its links.

    ``foot`` is the foot of ``far`` on the normal through ``near``. The inputs of the moments of the
    link at far come first, then those of the link at near. The numbers of pairs of both follow, and
    last the number of inputs of the first.
    """
    *terms, pairs, others, first = rest
    normal = 1j * guide.along / abs(guide.along)
    total = moment_sum(far, (*terms[: int(first)], pairs))
    total = total + moment_sum(near, (*terms[int(first) :], others))
    return total / cross(foot - far, normal) * normal


class SlidePressure(ForceOnLine, frozen=True, kw_only=True):
    """The force ``name`` on the link at ``near`` from the ``link`` at ``far``, normal to a guide.

    ``moments`` are those of the link at far about its pin, ``others`` those of the link at near,
    about the pin ``through`` which the normal is drawn.
    """

    reasons: ClassVar[Mapping[str, str]] = {"force": "why.force_pressure"}
    none: ClassVar[str] = "step.force-pressure-none"

    link: str
    block: str
    others: Moments

    def sentence_key(self, drawing: Drawing) -> str:
        both = self.others.shown(drawing)
        return "step.force-pressure-both" if both else "step.force-pressure"

    def fields(self, drawing: Drawing) -> Mapping[str, str]:
        """The link, both pins, the arm and the guide."""
        return {
            **super().fields(drawing),
            "k": escape(self.link),
            "far": symbol(self.moments.letter),
            "near": symbol(self.others.letter),
            "h": symbol(self.number),
            "guide": way_of(drawing, self.block),
        }


def pressure(
    pen: Pen,
    name: str,
    number: str,
    names: tuple[str, str],
    guide: int,
    own: Moments,
    others: Moments,
) -> int:
    """The force of a guide on the near link; ``names`` are the far link and the block."""
    link, block = names
    with pen.on(Part.FORCE, Plane.MECHANISM):
        foot = pen.draw(pressure_arm, own.about, others.about, guide)
    first, second = own.steps, others.steps
    with pen.on(Part.FORCE, Plane.NUMBERS):
        force = pen.draw(
            slide_pressure,
            *(own.about, foot, guide, others.about),
            *first,
            *second,
            extra=(*own.extra, *others.extra, float(len(first))),
        )
    found = SlidePressure(
        name=name,
        number=number,
        link=link,
        block=block,
        moments=own,
        others=others,
        through=others.about,
        foot=foot,
        force=force,
    )
    return pen.make(found).force
