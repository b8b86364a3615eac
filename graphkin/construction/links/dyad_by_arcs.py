"""The arc that a compass draws about one end of a bar, and the pin in which two arcs meet.

The pin between a bar and a link on a guide or track: the bar's arc cuts the pin's line in it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, ClassVar

from graphkin.construction.core.crossings import Determined, which_side
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Canvas, Construction, lies_along
from graphkin.construction.core.naming import drawn_amount, nearest_side
from graphkin.construction.core.palette import COMPASS, CUTS, Move, one_and_length
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import OwnStep, Step
from graphkin.construction.core.vocabulary import action
from graphkin.drawing.symbol_markup import bar, symbol
from graphkin.numbers.arithmetic import Point, Real, pick
from graphkin.numbers.plane import (
    Circle,
    Line,
    circle_meets_circle,
    circles_sine,
    cross,
    line_circle_sine,
    line_meets_circle,
)
from graphkin.scene.link_points import lettered
from graphkin.scene.model import Side, Triangle
from graphkin.text.errors import Message, Problem, Sought, message


@action("compass", move=Move(COMPASS, one_and_length))
def compass(centre: Point, radius: Real) -> Circle:
    """The circle about a point with a given opening of the compass."""
    return Circle(centre, radius)


class CompassArc(Construction, frozen=True, kw_only=True):
    """The ``arc`` of a ``radius`` about the point ``centre``, on which a ``point`` lies."""

    lines: ClassVar[Mapping[str, str]] = {"arc": "the arc {centre}{point} about {centre}"}
    between: ClassVar[tuple[str, ...]] = ("centre", "point")
    laid_at: ClassVar[str] = "arc"

    centre: str
    point: str
    radius: int
    arc: OwnStep

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the part of the arc that finds the point."""
        canvas.arc(self.centre + self.point)

    def clause(self, drawing: Drawing, role: str) -> str:
        """The clause for the arc, by the bar that is its radius."""
        opening = stated_bar(drawing, (self.centre, self.point), self.radius)
        return drawing.words("step.compass", p=symbol(self.centre), bar=opening)


def stated_bar(drawing: Drawing, ends: tuple[str, str], length: int) -> str:
    """The name of a bar, with its drawn length in mm unless the scene gives its ``length``."""
    name = bar(*ends)
    if drawing.trace.program.steps[length].given is None:
        name += f" ({drawn_amount(drawing, float(drawing.trace.values[length]))})"
    return name


def draw_arc(pen: Pen, ends: tuple[str, str], centre: int, radius: int) -> int:
    """Draw the arc about the first of two points on which the second lies."""
    arc = pen.draw(compass, centre, radius)
    pen.make(CompassArc(centre=ends[0], point=ends[1], radius=radius, arc=arc))
    return arc


COINCIDE = 1e-6
"""Distance of two centres below which they coincide, as a fraction of the radius."""
TOGETHER = 2.0**-25
"""Distance of two equal circles' centres that may be rounding, as a fraction of both radii.

Near a flat crossing, rounding is as large as the square root of eps.
"""


def arcs_reach(m: Circle, n: Circle, *_: Any) -> tuple[Any, Any]:
    """By how much two circles lie neither apart nor one in the other.

    Coincident equal circles count as not crossing: their centres may coincide along a whole motion,
    and a crossing would then be rounding.
    """
    distance, most = abs(n.centre - m.centre), m.radius + n.radius
    least, hidden = abs(m.radius - n.radius), TOGETHER * most
    least = pick(least < hidden, hidden, least)
    return most**2 - distance**2, distance**2 - least**2


@action("arcs-meet", margin=lambda m, n, side: circles_sine(m, n), reaches=arcs_reach, move=CUTS)
def arcs_meet(m: Circle, n: Circle, side: int) -> Point:
    """The point where two arcs meet, on one side of the line from one centre to the other."""
    return circle_meets_circle(m, n, side)


class DyadByArcs(Determined, frozen=True, kw_only=True):
    """The ``pin`` called ``name``, in which two arcs meet.

    They are ``near``, about ``left``, and ``far``, about ``right``.
    """

    reasons: ClassVar[Mapping[str, str]] = {"pin": "why.arcs"}
    loci: ClassVar[Message] = message("the arcs")
    apart: ClassVar[Message] = message("the arcs miss each other")
    has_mirror: ClassVar[bool] = True
    lines_before: ClassVar[tuple[str, ...]] = ("near", "far")
    between: ClassVar[tuple[str, ...]] = ("left", "right", "name")

    name: str
    left: str
    right: str
    near: int
    far: int
    pin: OwnStep

    def symbols(self) -> Mapping[str, str]:
        """The symbols of the outer pins."""
        return {"p": symbol(lettered(self.left)), "q": symbol(lettered(self.right))}

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence for the crossing of the arcs, with its side of the line of centres."""
        return drawing.words("step.arcs-meet.say", **self.place(drawing))

    def point_apart(self, drawing: Drawing, role: str) -> str:
        """The sentence for the crossing of the arcs, on its own."""
        return drawing.words("step.arcs-meet.apart", **self.place(drawing))

    def place(self, drawing: Drawing) -> Mapping[str, str]:
        """The pin's letter and its side."""
        side = side_words(drawing, self.pin, self.name, (self.left, self.right))
        return {"name": symbol(self.name), "side": side}

    @property
    def reaching(self) -> Message:
        """The expected bars, whose ends can meet."""
        bars = {"one": f"{self.left}{self.name}", "other": f"{self.right}{self.name}"}
        return message("bars {one} and {other} that can meet", **bars)

    def in_line(self, steps: Sequence[Step], *, nearly: bool) -> Message:
        """The words for two bars in line."""
        return message(
            "{one} and {other} are nearly in line" if nearly else "{one} and {other} are in line",
            one=f"{self.left}{self.name}",
            other=f"{self.right}{self.name}",
        )

    def undetermined(self, args: Sequence[Any]) -> Problem | None:
        """The problem of two equal bars whose outer pins coincide, so that the pin is open."""
        first, second = args[:2]
        least = TOGETHER * first.radius
        apart = abs(first.centre - second.centre), abs(first.radius - second.radius)
        if not (apart[0] < least and apart[1] < least):
            return None
        p, q, pin = self.left, self.right, self.name
        return Problem(
            message("position of {name}", name=pin),
            message(
                "{p} falls on {q}, and {p}{pin} is as long as {q}{pin}: {pin} may be anywhere "
                "about it",
                p=p,
                q=q,
                pin=pin,
            ),
            message("{p} and {q} apart", p=p, q=q),
            message(
                "at a change point move the driver, elsewhere take another side of {p} or {q}",
                p=p,
                q=q,
            ),
            about=(Sought((pin,)),),
        )

    def at_end(self, steps: Sequence[Step], loci: Sequence[Any]) -> tuple[str, str] | None:
        """The three pins in line, or the outer pins coincident, at the end of the range."""
        if not loci:
            return None
        near, far = loci
        if abs(near.centre - far.centre) < COINCIDE * near.radius:
            return self.name, f"{self.left} on {self.right}"
        return self.name, f"{self.left}, {self.name} and {self.right} in line"


def side_words(drawing: Drawing, number: int, name: str, centres: tuple[str, str]) -> str:
    """The words for the side of the line of centres on which two arcs meet.

    The centres are in the scene's own order.
    """
    side = which_side(drawing, number)
    if centres[::-1] in stated_ways(drawing, name):
        centres, side = centres[::-1], -side
    fields = {"p": symbol(centres[0]), "q": symbol(centres[1])}
    return drawing.words(f"step.arcs-meet.side{side:+d}", **fields)


def stated_ways(drawing: Drawing, name: str) -> Iterator[tuple[str, str]]:
    """The lines for which the scene says on which side a point lies."""
    branch = drawing.scene.branches.get(name)
    if isinstance(branch, Side):
        yield branch.first, branch.second
    for link in drawing.scene.every_link:
        for placing in link.placings:
            if isinstance(placing, Triangle) and placing.point == name:
                yield placing.first, placing.second


def meet_arcs(
    pen: Pen,
    name: str,
    centres: tuple[str, str],
    arcs: tuple[int, int],
    *side: int,
    sign: tuple[int, ...],
) -> int:
    """Draw the pin in which two arcs meet, on a stated side or on the side that a step gives."""
    pin = pen.draw(arcs_meet, *arcs, *side, name=name, extra=sign)
    left, right = centres
    pen.make(DyadByArcs(name=name, left=left, right=right, near=arcs[0], far=arcs[1], pin=pin))
    return pin


def line_reached(line: Line, circle: Circle, *_: Any) -> tuple[Any, Any]:
    """By how much a circle reaches a line from its right and from its left."""
    height = cross(line.along, circle.centre - line.point) / abs(line.along)
    return circle.radius - height, circle.radius + height


@action(
    "arc-cuts-line",
    margin=lambda line, circle, way: line_circle_sine(line, circle),
    reaches=line_reached,
    move=CUTS,
)
def arc_cuts_line(line: Line, circle: Circle, way: int) -> Point:
    """The point where an arc cuts a line: the farther one along the line (way +1) or the nearer."""
    return line_meets_circle(line, circle, way)


class DyadByArcAndGuide(Determined, frozen=True, kw_only=True):
    """The ``pin`` called ``name``, in which the ``arc`` about ``centre`` cuts the line ``path``."""

    reasons: ClassVar[Mapping[str, str]] = {"pin": "why.arc"}
    loci: ClassVar[Message] = message("the arc and the guide")
    apart: ClassVar[Message] = message("the arc misses the guide")
    has_mirror: ClassVar[bool] = True
    lines_before: ClassVar[tuple[str, ...]] = ("path", "arc")
    between: ClassVar[tuple[str, ...]] = ("centre", "name")

    name: str
    centre: str
    path: int
    arc: int
    pin: OwnStep

    def symbols(self) -> Mapping[str, str]:
        """The symbol of the arc's centre."""
        return {"p": symbol(lettered(self.centre))}

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """Where the arc cuts the line, and on which side of its centre."""
        return drawing.words("step.arc-cuts-line", **self.place(drawing))

    def point_apart(self, drawing: Drawing, role: str) -> str:
        """The same, after a separate sentence for the line and the arc."""
        return drawing.words("step.arc-cuts-line-apart", **self.place(drawing))

    def place(self, drawing: Drawing) -> Mapping[str, str]:
        """The pin's letter, and the side of the centre on which the pin lies."""
        along = drawing.trace.values[self.path].along * which_side(drawing, self.pin)
        side = drawing.words(f"page.{nearest_side(along)}")
        return {"name": symbol(self.name), "p": symbol(self.centre), "side": side}

    @property
    def reaching(self) -> Message:
        """The expected bar, long enough to reach its guide."""
        return message("a bar {bar} that reaches its guide", bar=f"{self.centre}{self.name}")

    def in_line(self, steps: Sequence[Step], *, nearly: bool) -> Message:
        """The bar and the guide."""
        return message(
            "{bar} is nearly square to {guide}" if nearly else "{bar} is square to {guide}",
            bar=f"{self.centre}{self.name}",
            guide=lies_along(steps[self.path]) or message("its guide"),
        )

    def at_end(self, steps: Sequence[Step], loci: Sequence[Any]) -> tuple[str, str] | None:
        """The pin, and the bar perpendicular to the guide at the end of its range."""
        if not loci:
            return None
        guide = lies_along(steps[self.path]) or "its guide"
        return self.name, f"{self.centre}-{self.name} square to {guide}"


def cut_line(
    pen: Pen, name: str, centre: str, loci: tuple[int, int], *way: int, sign: tuple[int, ...]
) -> int:
    """Draw the pin in which an arc cuts a line, on a stated side or a side that a step gives."""
    pin = pen.draw(arc_cuts_line, *loci, *way, name=name, extra=sign)
    pen.make(DyadByArcAndGuide(name=name, centre=centre, path=loci[0], arc=loci[1], pin=pin))
    return pin


def arcs_finding(drawing: Drawing, points: Sequence[str]) -> Iterator[DyadByArcAndGuide]:
    """The dyads whose arcs find some points on their guides."""
    for _, step, _ in drawing.on_mechanism:
        if isinstance(step.of, DyadByArcAndGuide) and step.of.name in points:
            yield step.of
