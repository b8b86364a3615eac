"""The fields of a page, which map metres of a drawing to millimetres of paper."""

from __future__ import annotations

from functools import cached_property, lru_cache
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from graphkin.scene.house import PAPERS, USUAL_PAPER

XY = tuple[float, float]
Rect = tuple[float, float, float, float]
"""Left, top, right and bottom in mm."""

A4_SIZE = (210.0, 297.0)
A4_FRAME: Rect = (20.0, 10.0, 200.0, 287.0)
A4_AREA: Rect = (20.0, 18.0, 200.0, 279.0)
"""The area between header and footer of an A4 page."""


class TextPage(Struct, frozen=True):
    """A page of text: its size, and how it differs from an A4 page, all in mm.

    The text has the width of that on A4, ``aside`` of it so that it is in the middle; its foot is
    ``shorter`` than that of A4.
    """

    name: str
    size: XY
    aside: float = 0.0
    shorter: float = 0.0


A4_PAGE = TextPage("A4", A4_SIZE)
LETTER = TextPage("Letter", (215.9, 279.4), (215.9 - 210.0) / 2, 297.0 - 279.4)
"""The page of ASME Y14.1 size A, upright."""


def text_page(paper: str) -> TextPage:
    """The page of text beside a paper of sheets: Letter beside those of ANSI, else A4."""
    return LETTER if paper in ASME else A4_PAGE


MARGIN = 15.0
"""Space left and right of a drawing for symbols, ends of lines and labels, in mm."""
ABOVE = 8.5
"""Space above and below a drawing, in mm."""
LEAST_FIELD = 80.0
"""Least width of a field in mm, so that its caption fits above it in two lines."""
HEADER, LOWER = 28.0, 12.0
"""Height of the title, the data and the captions below the frame's upper edge, and how much lower
they are on a leaf, where the bar that checks the print is above the title; in mm."""
SCHEME, CODE = 76.0, 30.0
"""Width of the scheme of a task, and of the room for the square with the code on a leaf, in mm."""
FILING = 20.0
"""Width of the filing margin at the left of a sheet, in mm."""


class SheetFrame(Struct, frozen=True):
    """A standard's frame: its name, the margins beside and above the area, the title block, in mm.

    The left margin may be wider, for filing. ``writing`` is the height below the fields for tables
    and text, and ``leaf`` that on an A4 leaf, where the title block is as wide as the frame.
    ``tables`` is the width of the tables above the title block of a wide sheet.
    """

    name: str
    beside: float
    above: float
    block: tuple[float, float]
    writing: float
    tables: float
    leaf: float = 0.0
    filing: float = FILING


ISO = SheetFrame("ISO", 10.0, 10.0, (180.0, 36.0), 86.0, 178.0, 100.0)
"""ISO 5457:1999 with the title block of ISO 7200:2004."""
GOST = SheetFrame("GOST", 5.0, 5.0, (185.0, 55.0), 97.0, 208.0, 113.0)
"""GOST 2.301-68 and GOST 2.104-2006, form 1."""
ASME_BLOCK = (158.75, 50.8)
"""The title block of ASME Y14.1 for sizes B and C: 6.25 × 2 in."""
ASME = {
    "ANSI B": SheetFrame("ASME", 15.748, 9.652, ASME_BLOCK, 94.0, 208.0, filing=15.748),
    "ANSI C": SheetFrame("ASME", 12.7, 19.05, ASME_BLOCK, 94.0, 208.0, filing=12.7),
}
"""ASME Y14.1-2012: margins of 0.62 and 0.38 in for size B, of 0.5 and 0.75 in for size C."""


class SheetPaper(Struct, frozen=True, dict=True):
    """A sheet: its size, its frame, and the regions of its contents, all in mm.

    A sheet of two ``leaves`` is printed on two A4 pages that lie side by side: the mechanism on the
    left one, the plan on the right one. Its own size is that of both together.
    """

    name: str
    width: float
    height: float
    frame: SheetFrame
    leaves: int = 1

    @property
    def half(self) -> float:
        return self.width / 2

    @property
    def middle(self) -> XY:
        return self.half, self.height / 2

    @property
    def whole(self) -> Rect:
        return 0.0, 0.0, self.width, self.height

    @property
    def across(self) -> float:
        """The width of a page."""
        return self.width / self.leaves

    @cached_property
    def areas(self) -> tuple[Rect, ...]:
        """The area inside the frame of each leaf."""
        frame, low = self.frame, self.height - self.frame.above
        return tuple(
            (i * self.across + frame.filing, frame.above, (i + 1) * self.across - frame.beside, low)
            for i in range(self.leaves)
        )

    @cached_property
    def area(self) -> Rect:
        """The area inside the frames of all leaves."""
        return (*self.areas[0][:2], *self.areas[-1][2:])

    @cached_property
    def blocks(self) -> tuple[Rect, ...]:
        """The title block of each leaf."""
        wide, high = self.frame.block
        return tuple((right - wide, low - high, right, low) for _, _, right, low in self.areas)

    @property
    def title_block(self) -> Rect:
        """The title block of the sheet, or of its right leaf."""
        return self.blocks[-1]

    @property
    def is_parted(self) -> bool:
        """Whether mechanism and plan are on leaves of their own."""
        return self.leaves > 1

    @property
    def is_leaf(self) -> bool:
        """Whether the title block is as wide as the area, so that nothing is left of it."""
        return self.areas[0][2] - self.areas[0][0] < self.frame.block[0] + 1

    @property
    def leaf(self) -> SheetPaper:
        """A single page of this paper."""
        return self if not self.is_parted else replace(self, width=self.across, leaves=1)

    @cached_property
    def foot(self) -> float:
        """Where the tables below the drawings begin, from the page's upper edge."""
        return self.area[3] - (self.frame.leaf if self.is_leaf else self.frame.writing)

    @property
    def lowered(self) -> float:
        """How much lower the title and the fields are than on a wide sheet."""
        return LOWER if self.is_leaf else 0.0

    @cached_property
    def fields(self) -> Rect:
        """The part for the mechanism and its plan, next to each other below their captions."""
        left, top, right, _ = self.area
        return left + 2, top + HEADER + self.lowered, right - 2, self.foot

    @cached_property
    def left(self) -> Rect:
        """The fields on the left leaf; all fields of a single sheet."""
        return (*self.fields[:2], self.areas[0][2] - 2, self.fields[3])

    @cached_property
    def right(self) -> Rect:
        """The fields on the right leaf; all fields of a single sheet."""
        return (self.areas[-1][0] + 2, *self.fields[1:])

    @cached_property
    def room(self) -> float:
        """The width for both drawings together, without their margins."""
        left, right = self.left, self.right
        wide = right[2] - right[0] + (left[2] - left[0] if self.is_parted else 0.0)
        return wide - 4 * MARGIN

    @cached_property
    def upright(self) -> float:
        """The height for a drawing, without its margins."""
        return self.fields[3] - self.fields[1] - 2 * ABOVE

    def room_beside(self, mechanism: Any) -> Any:
        """The width for a plan beside a mechanism of some width, without margins.

        Negative where the mechanism is too wide itself.
        """
        if not self.is_parted:
            return self.room - mechanism
        half = self.room / 2
        return half if mechanism <= half * (1 + 1e-12) else half - mechanism

    def beside(self, mechanism: Rect) -> Rect:
        """The field of a plan beside the field of the mechanism."""
        left = self.right[0] if self.is_parted else mechanism[2]
        return (left, *self.fields[1:])

    @cached_property
    def below(self) -> Rect:
        """The part of the sheet, or of its left leaf, for steps, tables and requests."""
        low = self.blocks[0][1] if self.is_leaf else self.area[3]
        return self.left[0], self.foot + 2, self.left[2], low - 2

    @cached_property
    def tables(self) -> Rect:
        """The table above the title block."""
        left = self.right[0] if self.is_leaf else self.fields[2] - self.frame.tables
        return left, self.foot + 1, self.fields[2], self.title_block[1] - 1

    @cached_property
    def writing(self) -> float:
        """The right end of sentences and requests below the drawings: beside the tables."""
        return self.left[2] if self.is_leaf else self.tables[0] - 3

    @cached_property
    def marked(self) -> tuple[float, float]:
        """Text left of this x, or above this y, is clear of the lower or right centring mark."""
        if self.is_leaf:
            return self.left[2] - 4, self.area[3]
        return self.width / 2 - 3, self.area[3] - 11

    @cached_property
    def second(self) -> float:
        """The left end of the right column of a continuation sheet."""
        return self.right[0] if self.is_leaf else self.marked[0] + 6

    @cached_property
    def scheme(self) -> Rect:
        """The kinematic scheme of a task, between requests and tables, above the centring mark."""
        beside = min(self.title_block[0], self.tables[0]) - 4
        right = self.left[2] - CODE if self.is_leaf else beside
        wide = SCHEME - (14 if self.is_leaf else 0)
        return right - wide, self.foot + 9, right, self.below[3] - (1 if self.is_leaf else 4)

    @cached_property
    def empty_tables(self) -> Rect:
        """The tables of a task, close to the lines around them: their rows are as high as possible.

        On a leaf they leave room for the square with the code at the lower right.
        """
        left, top, right, low = self.tables
        return left, top - 0.5, right, low + 0.5

    @property
    def code(self) -> float:
        """The side of the square with the code, in mm, that the tables of a task leave free."""
        return CODE if self.is_leaf else 0.0

    @cached_property
    def title(self) -> float:
        """Largest width of a title that stays clear of the centring mark."""
        start = self.fields[0] + 2
        return self.left[2] - start if self.is_leaf else self.width / 2 - 4 - start

    @cached_property
    def notes(self) -> Rect:
        """The part for a table and sentences of a sheet with one field."""
        low, block = self.area[3], self.leaf.title_block
        if self.is_leaf:
            return self.left[0] + 2, block[1] - 46, self.left[2] - 2, block[1] - 2
        return self.fields[0] + 4, block[1], block[0] - 4, low

    @cached_property
    def single(self) -> Rect:
        """The field of a sheet with one field."""
        return (*self.left[:3], self.notes[1] - 2)


@lru_cache(maxsize=16)
def paper_of(name: str, frame: str) -> SheetPaper:
    """The paper of a name with the frame of a standard; ANSI papers have that of ASME Y14.1."""
    width, height = PAPERS[name]
    own = ASME.get(name) or {each.name: each for each in (ISO, GOST)}[frame]
    if width < height:
        return SheetPaper(name, 2 * width, height, own, leaves=2)
    return SheetPaper(name, width, height, own)


A3 = paper_of(USUAL_PAPER, ISO.name)
"""The usual paper."""


# --- the mapping of a field: metres of the drawing to millimetres of paper ------------------------


class Carried(tuple[Any, Any]):
    """A place on a page that moves; it computes other places relative to itself."""

    def toward(self, end: XY) -> tuple[Any, XY]:
        """The distance to another place, and the unit direction to it."""
        raise NotImplementedError

    def across(self, way: XY, along: Any, aside: Any) -> XY:
        """The place at a distance along a unit direction and a distance to its right."""
        raise NotImplementedError


class Field(Struct, frozen=True):
    """A rectangle of the page (mm, y down), and the mapping of drawing points (y up) into it."""

    rect: Rect
    mm: float
    middle: complex
    at: XY

    def __call__(self, point: complex) -> XY:
        """The position of a drawing point on the page."""
        shift = (point - self.middle) * self.mm
        return self.at[0] + shift.real, self.at[1] - shift.imag

    def holds(self, point: complex, margin: float = 0.0) -> bool:
        """Whether a point of the drawing is in the field, at least a margin from its edge."""
        left, top, right, bottom = self.rect
        x, y = self(point)
        return left + margin <= x <= right - margin and top + margin <= y <= bottom - margin

    def way(self, vector: complex) -> XY:
        """The unit vector on the page for a direction of the drawing."""
        unit = vector / abs(vector)
        return unit.real, -unit.imag


def clipped(start: XY, end: XY, rect: Rect) -> tuple[XY, XY] | None:
    """The part of a segment inside a rectangle; None when there is none."""
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
