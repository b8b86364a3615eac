"""The display list: everything a page shows, with its layout in millimetres.

Coordinates have their origin at the page's top-left corner, x to the right, y DOWN. Angles are in
degrees, counter-clockwise as seen on the paper. ``cls`` holds one or more classes separated by
blanks; the first decides the style (see ``style``). ``name`` and ``step`` go into the SVG as
``data-name`` and ``data-step``. ``part`` numbers the strokes that draw a step. ``shows`` is the
part of a link that the mark shows, for marks that no step draws.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from math import cos, isfinite, pi, radians, sin
from typing import Literal

from msgspec import Struct
from msgspec.structs import replace

from graphkin.drawing.richtext import extent
from graphkin.text.errors import Message, PageError, Problem, message

Point = tuple[float, float]
Anchor = Literal["start", "middle", "end"]
SLACK = 1e-6  # mm, tolerance for rounding at the page's edge
CHORDS = 12
"""Number of chords for the half circle at an end of a drawn-out circle."""


class Shown(Struct, frozen=True):
    """The part of a link that a mark shows.

    It is the guide on which the link slides, or for a driven link its position (``coordinate``) or
    its speed (``rate``).
    """

    what: Literal["guide", "coordinate", "rate"]
    link: str


class RuledRow(Struct, frozen=True):
    """A row of a printed table: what the table holds, what the row is about, and its number.

    ``height`` is in mm. ``edges`` are the offsets of its columns from the row's left end, in mm.
    """

    table: str
    name: str
    number: int
    height: float
    edges: tuple[float, ...]


class LineMark(Struct, frozen=True):
    """A straight line between two points; ``row`` is the row of a table that it rules off."""

    x1: float
    y1: float
    x2: float
    y2: float
    cls: str
    name: str = ""
    step: int | None = None
    part: int = 0
    shows: Shown | None = None
    row: RuledRow | None = None


class Polyline(Struct, frozen=True):
    """A polyline; a closed one is a polygon, filled if its class is."""

    points: tuple[Point, ...]
    cls: str
    name: str = ""
    step: int | None = None
    closed: bool = False
    part: int = 0
    shows: Shown | None = None


class CircleMark(Struct, frozen=True):
    """A circle, filled if its class is."""

    cx: float
    cy: float
    r: float
    cls: str
    name: str = ""
    step: int | None = None
    part: int = 0
    shows: Shown | None = None


class Arc(Struct, frozen=True):
    """An arc of less than a full turn from angle ``start`` to ``end``; clockwise if end < start."""

    cx: float
    cy: float
    r: float
    start: float
    end: float
    cls: str
    name: str = ""
    step: int | None = None
    part: int = 0
    shows: Shown | None = None

    def at(self, angle: float) -> Point:
        """The point of the arc's circle at an angle in degrees."""
        turn = radians(angle)
        return self.cx + self.r * cos(turn), self.cy - self.r * sin(turn)


class SharedLetter(Struct, frozen=True):
    """A letter in the label of coincident points, and the sign that joins it to the last one."""

    name: str
    markup: str
    joint: str = ""

    @property
    def joined(self) -> str:
        """The letter after the sign that joins it."""
        return self.joint + self.markup


class Text(Struct, frozen=True):
    """Marked-up text: baseline at y, capitals ``height`` mm high, rotated by ``rotate``°.

    ``letters`` are the letters of the plan's points that the text labels.
    """

    x: float
    y: float
    markup: str
    cls: str
    height: float = 2.5
    anchor: Anchor = "start"
    name: str = ""
    step: int | None = None
    rotate: float = 0.0
    part: int = 0
    letters: tuple[SharedLetter, ...] = ()
    shows: Shown | None = None

    def left(self) -> float:
        """The offset of the text's beginning from x along the baseline, in mm."""
        if self.anchor == "start":
            return 0.0
        width = extent(self.markup, self.height)[0]
        return -width / 2 if self.anchor == "middle" else -width

    def corners(self) -> tuple[Point, ...]:
        """The four corners of the text's box on the page, rotated with the text."""
        left = self.left()
        width, top, bottom = extent(self.markup, self.height)
        box = ((left, top), (left + width, top), (left + width, bottom), (left, bottom))
        if not self.rotate:
            return tuple((self.x + u, self.y + v) for u, v in box)
        c, s = cos(radians(self.rotate)), sin(radians(self.rotate))
        return tuple((self.x + u * c + v * s, self.y - u * s + v * c) for u, v in box)


Mark = LineMark | Polyline | CircleMark | Arc | Text


def showing(shown: Shown, marks: Iterable[Mark]) -> Iterator[Mark]:
    """The marks, with what they show set to ``shown``."""
    return (replace(mark, shows=shown) for mark in marks)


def style_class(mark: Mark) -> str:
    """The first class of a mark, which decides its style."""
    return mark.cls.split(maxsplit=1)[0]


def polygon(
    points: tuple[Point, ...], cls: str, name: str = "", step: int | None = None
) -> Polyline:
    """Make a closed polyline."""
    return Polyline(points, cls, name, step, closed=True)


def box(x: float, y: float, width: float, height: float, cls: str) -> Polyline:
    """Make an upright rectangle from its top-left corner and its size in mm."""
    right, below = x + width, y + height
    return Polyline(((x, y), (right, y), (right, below), (x, below)), cls, closed=True)


def drawn_out(x: float, y: float, radius: float, width: float, cls: str) -> Polyline:
    """Make a circle stretched to a width in mm: two lines, with half circles as chords."""
    half = width / 2 - radius
    turns = [pi * i / CHORDS for i in range(CHORDS + 1)]
    right = [(x + half + radius * sin(t), y - radius * cos(t)) for t in turns]
    left = [(x - half - radius * sin(t), y + radius * cos(t)) for t in turns]
    return Polyline((*right, *left), cls, closed=True)


def arc_points(arc: Arc) -> Iterator[Point]:
    """The ends of an arc, and the quarter points that it passes."""
    low, high = sorted((arc.start, arc.end))
    yield arc.at(arc.start)
    yield arc.at(arc.end)
    quarter = 90.0 * (low // 90.0 + 1.0)
    while quarter < high:
        yield arc.at(quarter)
        quarter += 90.0


def moved(mark: Mark, right: float, down: float) -> Mark:
    """The mark moved to the right and down by some mm."""
    if isinstance(mark, LineMark):
        x1, y1, x2, y2 = mark.x1 + right, mark.y1 + down, mark.x2 + right, mark.y2 + down
        return replace(mark, x1=x1, y1=y1, x2=x2, y2=y2)
    if isinstance(mark, Polyline):
        return replace(mark, points=tuple((x + right, y + down) for x, y in mark.points))
    if isinstance(mark, Text):
        return replace(mark, x=mark.x + right, y=mark.y + down)
    return replace(mark, cx=mark.cx + right, cy=mark.cy + down)


def scaled(mark: Mark, times: float) -> Mark:
    """The mark scaled about the page's corner; text keeps its height."""
    if isinstance(mark, LineMark):
        x1, y1, x2, y2 = (times * each for each in (mark.x1, mark.y1, mark.x2, mark.y2))
        return replace(mark, x1=x1, y1=y1, x2=x2, y2=y2)
    if isinstance(mark, Polyline):
        return replace(mark, points=tuple((times * x, times * y) for x, y in mark.points))
    if isinstance(mark, Text):
        return replace(mark, x=times * mark.x, y=times * mark.y)
    return replace(mark, cx=times * mark.cx, cy=times * mark.cy, r=times * mark.r)


def reach(mark: Mark) -> tuple[float, float, float, float]:
    """The upright bounding box (left, top, right, bottom) of a mark, without line widths."""
    if isinstance(mark, LineMark):
        points: tuple[Point, ...] = ((mark.x1, mark.y1), (mark.x2, mark.y2))
    elif isinstance(mark, Polyline):
        points = mark.points
    elif isinstance(mark, CircleMark):
        return mark.cx - mark.r, mark.cy - mark.r, mark.cx + mark.r, mark.cy + mark.r
    elif isinstance(mark, Arc):
        points = tuple(arc_points(mark))
    else:
        points = mark.corners()
    xs, ys = [x for x, _ in points], [y for _, y in points]
    return min(xs), min(ys), max(xs), max(ys)


def numbers(mark: Mark) -> Iterator[float]:
    """Every number that a mark is drawn from."""
    if isinstance(mark, LineMark):
        return iter((mark.x1, mark.y1, mark.x2, mark.y2))
    if isinstance(mark, Polyline):
        return (value for point in mark.points for value in point)
    if isinstance(mark, CircleMark):
        return iter((mark.cx, mark.cy, mark.r))
    if isinstance(mark, Arc):
        return iter((mark.cx, mark.cy, mark.r, mark.start, mark.end))
    return iter((mark.x, mark.y, mark.height, mark.rotate))


def fits(mark: Mark, width: float, height: float) -> bool:
    """Quick check that a mark is on a page; False for arcs and rotated texts, which need a box."""
    if isinstance(mark, Text):
        if mark.rotate or not mark.height > 0:
            return False
        left, (long, top, bottom) = mark.x + mark.left(), extent(mark.markup, mark.height)
        across = left >= 0 and left + long <= width
        return across and mark.y + top >= 0 and mark.y + bottom <= height
    if isinstance(mark, LineMark):
        across = 0 <= mark.x1 <= width and 0 <= mark.x2 <= width
        return across and 0 <= mark.y1 <= height and 0 <= mark.y2 <= height
    if isinstance(mark, CircleMark):
        across = 0 < mark.r <= mark.cx <= width - mark.r
        return across and mark.r <= mark.cy <= height - mark.r
    if isinstance(mark, Polyline):
        inside = all(0 <= x <= width and 0 <= y <= height for x, y in mark.points)
        return inside and len(mark.points) >= 2
    return False


def fault(mark: Mark, width: float, height: float) -> tuple[Message, Message] | None:
    """The problem (found, expected) of a mark that cannot be drawn on a page of this size in mm."""
    if not all(map(isfinite, numbers(mark))):
        return message("a coordinate that is not a finite number"), message("finite millimetres")
    if isinstance(mark, CircleMark | Arc) and mark.r <= 0:
        return message("radius {radius:g} mm", radius=mark.r), message("a radius above zero")
    if isinstance(mark, Text) and mark.height <= 0:
        found = message("lettering {height:g} mm high", height=mark.height)
        return found, message("a height above zero")
    if isinstance(mark, Arc) and abs(mark.end - mark.start) >= 360:
        found = message("an arc over {over:g}°", over=abs(mark.end - mark.start))
        return found, message("less than 360° (else a circle)")
    if isinstance(mark, Polyline) and len(mark.points) < 2:
        found = message("a broken line of {count} points", count=len(mark.points))
        return found, message("two points or more")
    left, top, right, bottom = reach(mark)
    if left < -SLACK or top < -SLACK or right > width + SLACK or bottom > height + SLACK:
        found = message(
            "reaches x {left:.2f} to {right:.2f}, y {top:.2f} to {bottom:.2f} mm",
            left=left,
            right=right,
            top=top,
            bottom=bottom,
        )
        return found, message(
            "a mark within the page of {width:g} × {height:g} mm", width=width, height=height
        )
    return None


def place_of(mark: Mark) -> str:
    """The name of a mark in an error: its kind, class, name and text."""
    words = [type(mark).__name__.removesuffix("Mark").lower(), mark.cls, mark.name]
    if isinstance(mark, Text):
        words.append(f"“{mark.markup}”")
    return " ".join(word for word in words if word)


class Picture(Struct, frozen=True):
    """A picture in a box (mm): the bytes of a PNG or an SVG file."""

    x: float
    y: float
    width: float
    height: float
    data: bytes
    kind: Literal["png", "svg"]


class Page(Struct, frozen=True):
    """One page: its size in mm, its marks in painting order, its title and language code.

    ``pictures`` lie above its marks. ``weight`` is a factor on the widths of all lines.
    ``drawn`` is the part with the drawings: left, top, right and bottom in mm, None without one.
    """

    width: float
    height: float
    marks: tuple[Mark, ...]
    title: str = ""
    lang: str = "en"
    pictures: tuple[Picture, ...] = ()
    weight: float = 1.0
    drawn: tuple[float, float, float, float] | None = None

    def check(self) -> None:
        """Raise PageError, naming each mark that is not finite or leaves the page."""
        problems = []
        for mark in self.marks:
            if fits(mark, self.width, self.height):
                continue
            found = fault(mark, self.width, self.height)
            if found:
                problems.append(Problem(place_of(mark), *found))
        if problems:
            raise PageError(problems)
