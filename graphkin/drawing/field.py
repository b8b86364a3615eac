"""A field of the page with a drawing in it: metres of the drawing to millimetres of paper."""

from __future__ import annotations

from typing import Any

from msgspec import Struct

from graphkin.drawing.areas import Rect

XY = tuple[float, float]


class Carried(tuple[Any, Any]):
    """A place of a page that moves: it knows how others are laid off from it."""

    def toward(self, end: XY) -> tuple[Any, XY]:
        """How far another place is from this one, and the unit way to it."""
        raise NotImplementedError

    def across(self, way: XY, along: Any, aside: Any) -> XY:
        """The place so far along a unit way from this one and so far to its right."""
        raise NotImplementedError


class Field(Struct, frozen=True):
    """A rectangle of the page (mm, y down) and where a drawing's points (y up) fall in it."""

    rect: Rect
    mm: float
    middle: complex
    at: XY

    def __call__(self, point: complex) -> XY:
        """Where a point of the drawing lies on the page."""
        shift = (point - self.middle) * self.mm
        return self.at[0] + shift.real, self.at[1] - shift.imag

    def holds(self, point: complex, margin: float = 0.0) -> bool:
        """True when a point of the drawing lies in the field, a margin from its edge."""
        left, top, right, bottom = self.rect
        x, y = self(point)
        return left + margin <= x <= right - margin and top + margin <= y <= bottom - margin

    def way(self, vector: complex) -> XY:
        """Unit vector on the page of a direction of the drawing."""
        unit = vector / abs(vector)
        return unit.real, -unit.imag


def clipped(start: XY, end: XY, rect: Rect) -> tuple[XY, XY] | None:
    """The part of a segment that lies in a rectangle; None when there is none."""
    left, top, right, bottom = rect
    if all(left <= x <= right and top <= y <= bottom for x, y in (start, end)):
        return start, end
    (x0, y0), (x1, y1) = start, end
    if max(x0, x1) < left or min(x0, x1) > right or max(y0, y1) < top or min(y0, y1) > bottom:
        return None
    from shapely import LineString, box

    part = LineString([start, end]).intersection(box(*rect))
    if part.is_empty or part.geom_type != "LineString":
        return None
    first, last = part.coords
    return (first[0], first[1]), (last[0], last[1])
