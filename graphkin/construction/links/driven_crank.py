"""Links turned about a pivot: to the angle of a driver, or to an angle at which a group closes."""

from __future__ import annotations

from cmath import phase
from collections.abc import Mapping
from math import degrees
from typing import ClassVar

from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.crossings import is_found_by_closing
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import ByHand, Construction
from graphkin.construction.core.naming import angle_symbol, axis_of
from graphkin.construction.core.palette import MARK_OFF, Move, one_and_length
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import OwnStep
from graphkin.construction.core.quantities import in_degrees
from graphkin.construction.core.vocabulary import action, ray
from graphkin.construction.guides.guides import axis_by_guide
from graphkin.construction.links.link_shapes import bar_length, local_place
from graphkin.drawing.symbol_markup import bar, escape, symbol
from graphkin.numbers.arithmetic import Point, Real
from graphkin.numbers.plane import Line
from graphkin.scene.model import FRAME


@action("mark-off", move=Move(MARK_OFF, one_and_length))
def mark_off(line: Line, length: Real, sense: int = 1) -> Point:
    """The point at a given distance along a line, or back (sense -1)."""
    length = length if sense > 0 else -length
    return line.point + line.along * (length / abs(line.along))


@action("arm")
def arm(pivot: Point, direction: Point, start: Point, end: Point, base: Point, tip: Point) -> Point:
    """A point of a turning link, from the direction of one of its lines (start to end)."""
    line = end - start
    return pivot + direction * (tip - base) * (abs(line) / line)


@action("arm")
def arm_by_axis(pivot: Point, direction: Point, base: Point, tip: Point) -> Point:
    """A point of a turning link, from the direction of the link's own x axis."""
    return pivot + direction * (tip - base)


class DrivenCrank(Construction, frozen=True, kw_only=True):
    """A bar of a driven ``link`` from its ``pivot`` to its ``tip``, called ``name``.

    The bar is laid off on the ``line`` at the driver's angle.
    """

    reasons: ClassVar[Mapping[str, str]] = {"tip": "why.crank"}
    lines: ClassVar[Mapping[str, str]] = {"line": "the line through {pivot}"}
    between: ClassVar[tuple[str, ...]] = ("pivot", "name")
    laid_at: ClassVar[str] = "tip"

    link: str
    pivot: str
    name: str
    line: OwnStep
    tip: OwnStep

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the end of the line, beyond the bar."""
        if role == "line":
            canvas.line_end(self.pivot)

    def said_before(self, drawing: Drawing, role: str) -> tuple[int, ...]:
        """The line, which comes before the tip."""
        return (self.line,) if role == "tip" else ()

    def clause(self, drawing: Drawing, role: str) -> str:
        """The clause for the line at its angle to the frame's axis, or to a line of a moving link.

        Where the pivot ends that link's bar, the line is measured from the bar produced.
        """
        scene, words = drawing.scene, drawing.words
        driver = next(d for d in scene.drivers if d.link == self.link)
        size = in_degrees(scene, words, driver.position)
        angle = angle_symbol(scene, driver) + (f" = {size}" if size else "")
        fields = {"p": symbol(self.pivot), "angle": angle}
        if driver.against == FRAME:
            return words("step.ray", **fields)
        other = scene.links[driver.against]
        line = axis_of(drawing, other)
        ends = other.points[1:2] == (self.pivot,) and line == bar(*other.points[:2])
        return words("step.ray-produced" if ends else "step.ray-against", line=line, **fields)

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence that lays off the bar."""
        p, name = symbol(self.pivot), symbol(self.name)
        return drawing.words("step.mark-off", p=p, q=name, name=name)


class TurnedLink(Construction, frozen=True, kw_only=True):
    """The ``tip``, called ``name``, of a ``link`` turned about its ``pivot`` to ``turn``."""

    reasons: ClassVar[Mapping[str, str]] = {"tip": "why.turned_link"}
    pencil: ClassVar[Mapping[str, ByHand]] = {"tip": ByHand.LAID_OFF}
    between: ClassVar[tuple[str, ...]] = ("pivot", "name")
    laid_at: ClassVar[str] = "tip"

    link: str
    pivot: str
    name: str
    turn: int
    tip: OwnStep

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence for the tip by its angle, or by the bar's angle if found with a group."""
        words, spot = drawing.words, drawing.standing.spot
        fields = {"p": symbol(self.pivot), "name": symbol(self.name)}
        if not is_found_by_closing(drawing.trace.program.steps[self.turn]):
            return words("step.arm", k=escape(self.link), **fields)
        angle = words.fixed(degrees(phase(spot(self.name) - spot(self.pivot))), 1)
        return words("step.arm-found", bar=bar(self.pivot, self.name), angle=angle, **fields)


def turn_about(
    pen: Pen, link: str, ends: tuple[str, str | None], line: tuple[str, ...], turn: int
) -> None:
    """Place a link at its pivot so that one of its lines has a given direction.

    With an empty ``line``, the direction is that of the link's x axis.
    """
    pivot, tip = ends
    start = pen.the("position", pivot)
    if not line:
        pen.want("axis", link, turn)
    if tip is None:
        if line:
            here = [local_place(pen, link, point) for point in line]
            pen.want("axis", link, pen.draw(axis_by_guide, turn, *here))
        return
    if line == (pivot, tip):
        way = pen.draw(ray, start, turn)
        found = pen.draw(mark_off, way, bar_length(pen, link, pivot, tip), name=tip)
        pen.make(DrivenCrank(link=link, pivot=pivot, name=tip, line=way, tip=found))
    else:
        locals_ = [local_place(pen, link, point) for point in (*line, pivot, tip)]
        found = pen.draw(arm if line else arm_by_axis, start, turn, *locals_, name=tip)
        pen.make(TurnedLink(link=link, pivot=pivot, name=tip, turn=turn, tip=found))
    pen.want("position", tip, found)
