"""A field of the page with a drawing: the map from metres of the drawing to mm of paper."""

from __future__ import annotations

from typing import Any

from msgspec import Struct

Rect = tuple[float, float, float, float]
"""Left, top, right and bottom in mm."""

A3_AREA: Rect = (20.0, 10.0, 410.0, 287.0)
"""Inside the frame of an A3 sheet (ISO 5457)."""
TITLE_WIDTH, TITLE_HEIGHT = 180.0, 36.0
A3_TITLE_BLOCK: Rect = (230.0, 251.0, 410.0, 287.0)
A4_SIZE = (210.0, 297.0)
A4_FRAME: Rect = (20.0, 10.0, 200.0, 287.0)
A4_AREA: Rect = (20.0, 18.0, 200.0, 279.0)
"""Between header and footer of an A4 page."""

MARGIN = 15.0
"""Space left and right of a drawing for symbols, ends of lines and labels, in mm."""
ABOVE = 8.5
"""Space above and below a drawing, in mm."""
LEAST_FIELD = 80.0
"""Least width of a field, in mm, so that its caption fits in two lines."""
HEADER = 28.0
"""Height of the title, the data and the captions below the frame's upper edge, in mm."""
FOOT = 201.0
"""Top of the tables below the drawings, in mm from the page's upper edge."""

AREA: Rect = (A3_AREA[0] + 2, A3_AREA[1] + HEADER, A3_AREA[2] - 2, FOOT)
"""The part of the sheet for the mechanism and the plan side by side, below their captions."""
WIDTH, HEIGHT = AREA[2] - AREA[0] - 4 * MARGIN, AREA[3] - AREA[1] - 2 * ABOVE
"""The space for both drawings together, without their margins."""
BELOW: Rect = (AREA[0], FOOT + 2, AREA[2], A3_AREA[3] - 2)
"""The part for steps, tables and check bar."""
SCHEME: Rect = (150.0, 210.0, 226.0, 281.0)
"""The kinematic scheme of a task, to the right of the questions and above the centring mark."""
MARKED = (207.0, 276.0)
"""Left of this, or above it, text is clear of the centring mark at the sheet's lower edge."""
TABLES: Rect = (A3_TITLE_BLOCK[0], FOOT + 2, AREA[2], A3_TITLE_BLOCK[1] - 2)
"""The table above the title block."""


# --- a field of the page with a drawing -----------------------------------------------------------


XY = tuple[float, float]


class Carried(tuple[Any, Any]):
    """A place on an animated page, which knows how other places depend on it."""

    def toward(self, end: XY) -> tuple[Any, XY]:
        """The distance to another place, and the unit vector towards it."""
        raise NotImplementedError

    def across(self, way: XY, along: Any, aside: Any) -> XY:
        """The place at a distance along a unit vector, and at another distance to its right."""
        raise NotImplementedError


class Field(Struct, frozen=True):
    """A rectangle of the page (mm, y down) and the placement of a drawing's points (y up) in it."""

    rect: Rect
    mm: float
    middle: complex
    at: XY

    def __call__(self, point: complex) -> XY:
        """The place of a drawing's point on the page."""
        shift = (point - self.middle) * self.mm
        return self.at[0] + shift.real, self.at[1] - shift.imag

    def holds(self, point: complex, margin: float = 0.0) -> bool:
        """Whether a point of the drawing is in the field, at least a margin from its edge."""
        left, top, right, bottom = self.rect
        x, y = self(point)
        return left + margin <= x <= right - margin and top + margin <= y <= bottom - margin

    def way(self, vector: complex) -> XY:
        """Unit vector on the page of a direction of the drawing."""
        unit = vector / abs(vector)
        return unit.real, -unit.imag


def clipped(start: XY, end: XY, rect: Rect) -> tuple[XY, XY] | None:
    """The part of a segment inside a rectangle, or None."""
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
