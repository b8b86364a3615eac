"""Links set at a coordinate of their guide or track, given by a driver or by a group's closure."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from graphkin.construction.core.crossings import is_found_by_closing
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Construction
from graphkin.construction.core.naming import angle_symbol, drawn_amount, nearest_side, place
from graphkin.construction.core.palette import MARK_OFF, Move, one_and_length
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import Drive
from graphkin.construction.core.vocabulary import action
from graphkin.drawing.symbol_markup import escape
from graphkin.numbers.arithmetic import Point, Real
from graphkin.numbers.plane import Line
from graphkin.scene.model import Slide


@action("set-at", move=Move(MARK_OFF, one_and_length))
def set_at(line: Line, coordinate: Real) -> Point:
    """The point of a guide at a coordinate."""
    return line.point + line.along * (coordinate / abs(line.along))


@action("set-back")
def set_back(line: Line, coordinate: Real, here: Point, through: Point, axis: Point) -> Point:
    """A point of the link that carries a guide, from the position of the block on it."""
    zero = line.point - line.along * (coordinate / abs(line.along))
    return zero + axis * (here - through)


class SetByCoordinate(Construction, frozen=True, kw_only=True):
    """The ``point`` of a ``link`` at the coordinate ``where`` of its ``path`` on a link ``on``."""

    gives: ClassVar[tuple[str, ...]] = ("point",)
    reasons: ClassVar[Mapping[str, str]] = {"point": "why.set_at"}
    lines_before: ClassVar[tuple[str, ...]] = ("path",)

    link: str
    on: str
    path: int
    where: int
    point: int

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence for the point by its coordinate.

        Where a group's closure gives the coordinate, the sentence gives distance and side from the
        zero.
        """
        name = drawing.lettered(self.point)
        if not is_found_by_closing(drawing.trace.program.steps[self.where]):
            return drawing.words("step.set-at", name=name, what=self.coordinate(drawing))
        size = float(drawing.trace.values[self.where])
        paths = drawing.scene.links[self.link].paths
        path = next(path for path in paths if path.on == self.on)
        zero = path.along[0] if isinstance(path, Slide) and path.along else path.through
        assert zero is not None
        side = nearest_side(drawing.trace.values[self.path].along * (-1 if size < 0 else 1))
        return drawing.words(
            "step.set-at-found",
            name=name,
            what=drawn_amount(drawing, abs(size)),
            side=drawing.words(f"page.{side}"),
            zero=place(drawing, path.on, zero, on_paper=True),
        )

    def coordinate(self, drawing: Drawing) -> str:
        """The coordinate, by the letter of the driver that gives it, or as drawn."""
        amount = drawn_amount(drawing, float(drawing.trace.values[self.where]))
        drive = drawing.trace.program.steps[self.where].of
        if not isinstance(drive, Drive) or drive.position != self.where:
            return amount
        return f"{angle_symbol(drawing.scene, drawing.scene.drivers[drive.driver])} ({amount})"


class CarrierSetByCoordinate(SetByCoordinate, frozen=True, kw_only=True):
    """A ``point`` of the ``link`` that carries a guide, from the position of the block on it."""

    lines_before: ClassVar[tuple[str, ...]] = ()

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence for the point by the coordinate of the block."""
        name = drawing.lettered(self.point)
        what = self.coordinate(drawing)
        return drawing.words("step.set-back", name=name, k=escape(self.link), what=what)


def set_point(pen: Pen, name: str, pair: tuple[str, str], path: int, where: int) -> int:
    """Draw a point of the first link of a pair, at a coordinate of its path on the other."""
    point = pen.draw(set_at, path, where, name=name)
    link, on = pair
    pen.make(SetByCoordinate(link=link, on=on, path=path, where=where, point=point))
    return point


def set_carrier(
    pen: Pen, name: str, pair: tuple[str, str], zero: int, where: int, *ends: int
) -> int:
    """Draw a point of a link that carries a guide; ``zero`` is the guide through its block."""
    point = pen.draw(set_back, zero, where, *ends, name=name)
    link, on = pair
    pen.make(CarrierSetByCoordinate(link=link, on=on, path=zero, where=where, point=point))
    return point
