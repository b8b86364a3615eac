"""Drawing the steps of constructions on paper: marks in millimetres of their field."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import wraps
from itertools import count
from math import cos, degrees, hypot, pi, sin
from typing import Any, Concatenate, ParamSpec, TypeVar

from msgspec import Struct, field
from msgspec.structs import replace

from graphkin.construction.core.component import TriangleComponent
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Construction
from graphkin.construction.core.layout import BEYOND, SWEEP, Layout, arc_span
from graphkin.construction.core.naming import NEAR, TINY, scale_of
from graphkin.construction.core.program import Plane, Step, plan_vector, sign_of
from graphkin.construction.core.quantities import OnPaper, in_mm
from graphkin.construction.core.solution import Curve
from graphkin.drawing.field import XY, Field, Rect, clipped
from graphkin.drawing.labels import FieldContent, FootNote, Label
from graphkin.drawing.marks import Arc, CircleMark, LineMark, Polyline, SharedLetter, Shown
from graphkin.drawing.style import BY_SIGN, CENTRODES, CHAIN_LINES, OWN_LINES
from graphkin.drawing.symbol_markup import symbol
from graphkin.drawing.symbols import FIXED, HEAD, PIN, SHORT, arrow, bearing, head, square_mark
from graphkin.numbers.plane import Circle, Ratio
from graphkin.text import Words

CHORDS, FINE = 240, 0.02
"""Number of chords of a small circle, and the largest deviation (mm) of chords from a large one."""
UNSEEN = 0.01
"""The largest deviation, in mm, of a polyline whose points are thinned out."""


def ring(circle: Circle, mm: float = 0.0) -> list[complex]:
    """Points around a closed circle, close enough together for ``mm`` millimetres per metre."""
    chords = max(CHORDS, int(pi * (circle.radius * mm / FINE / 2) ** 0.5))
    turns = (2 * pi * i / chords for i in range(chords + 1))
    return [circle.centre + circle.radius * complex(cos(a), sin(a)) for a in turns]


def clipped_path(
    points: Sequence[XY], rect: Rect, cls: str, name: str, step: int | None = None
) -> Iterator[Polyline]:
    """The parts of a polyline inside a rectangle, without points too close to be seen."""
    from shapely import LineString, box

    if len(points) < 2:
        return
    line, field = LineString(points).simplify(UNSEEN, preserve_topology=False), box(*rect)
    found = line if field.covers(line) else line.intersection(field)
    for part in getattr(found, "geoms", [found]):
        if part.geom_type == "LineString" and len(part.coords) > 1:
            yield Polyline(tuple((x, y) for x, y in part.coords), cls, name, step)


def draw_curves(board: FieldContent, drawing: Drawing, field: Field, rect: Rect) -> None:
    """Draw the paths of points and the centrodes, each with its name."""
    for curve in drawing.curves:
        parts = [
            part
            for run in curve.runs
            for part in clipped_path([field(point) for point in run], rect, curve.kind, curve.name)
        ]
        board.marks += parts
        if parts:
            subject = middle_of(max(parts, key=length), share=SHARES[curve.kind])
            words = name_of(drawing.words, curve)
            cls = CENTRODES.get(curve.kind, "")
            board.labels.append(Label(words, cls, subject, 2.5, curve.name, led=True))


SHARES = {"fixed-centrode": 0.5, "moving-centrode": 0.3, "trajectory": 0.15, "locus": 0.6}
"""Share of its longest part at which a curve is named, so that names do not collide."""


def name_of(words: Words, curve: Curve) -> str:
    """The name printed next to a curve."""
    return words(f"page.{curve.kind}", of=symbol(curve.of))


def length(part: Polyline) -> float:
    """The length of a polyline in mm."""
    ends = zip(part.points, part.points[1:], strict=False)
    return sum(hypot(x - u, y - v) for (x, y), (u, v) in ends)


def middle_of(part: Polyline, share: float) -> XY:
    """The point of a polyline at a share of its length."""
    left = share * length(part)
    for (x, y), (u, v) in zip(part.points, part.points[1:], strict=False):
        step = hypot(x - u, y - v)
        if step >= left > 0:
            return x + (u - x) * left / step, y + (v - y) * left / step
        left -= step
    return part.points[-1]


# --- the drawing of one plane, and helpers for every kind of step --------------------------------


EDGE = 3.0
"""Distance in mm from a field's edge at which longer lines end."""
FOOT = 6.5
"""The same distance at the foot of a field, where the notes are."""
CAPTION = 7.0
"""Depth of the caption at the top of a field, in mm."""


class Plot(Struct, frozen=True):
    """The target of one drawing's steps: board, field, and the sheet's material."""

    board: FieldContent
    field: Field
    drawing: Drawing
    layout: Layout

    @property
    def colour(self) -> str:
        """The class that colours this sheet's plan."""
        return self.drawing.kind


def line_part(plot: Plot, value: Any, low: float, high: float) -> tuple[XY, XY] | None:
    """The part of a line between two distances in mm from its anchor, within its field."""
    unit = value.along / abs(value.along) / plot.field.mm
    start, end = plot.field(value.point + low * unit), plot.field(value.point + high * unit)
    return clipped(start, end, above_foot(plot.field.rect))


def inside(rect: Rect) -> Rect:
    """A field without its edges."""
    return rect[0] + EDGE, rect[1] + EDGE, rect[2] - EDGE, rect[3] - EDGE


def above_foot(rect: Rect) -> Rect:
    """A field without its edges and without its foot, where the notes are."""
    return rect[0] + EDGE, rect[1] + EDGE, rect[2] - EDGE, rect[3] - FOOT


def in_field(start: XY, end: XY, rect: Rect) -> tuple[XY, XY] | None:
    """The part of a segment in a field: whole, or as far as its edge, its caption and its foot."""
    left, top, right, low = rect
    if all(left <= x <= right and top + CAPTION <= y <= low for x, y in (start, end)):
        return start, end
    left, _, right, low = above_foot(rect)
    return clipped(start, end, (left, top + CAPTION, right, low))


def middle(tail: XY, tip: XY) -> XY:
    return (tail[0] + tip[0]) / 2, (tail[1] + tip[1]) / 2


def note_tiny(plot: Plot, name: str, length: OnPaper) -> None:
    """Add a note at the foot of the field for a vector too short to be seen."""
    words, drawing = plot.drawing.words, plot.drawing
    factor = scale_of(drawing, drawing.plane)
    if not drawing.settled(length * factor / 1000):
        note = FootNote(words("page.zero", name=name), name)
    else:
        said = words("page.tiny", name=name, length=in_mm(words, length))
        note = FootNote(said, name, words("page.too_short"))
    if note not in plot.board.notes:
        plot.board.notes.append(note)


def draw_line(
    board: FieldContent,
    field: Field,
    line: tuple[complex, complex],
    name: str,
    shows: Shown | None = None,
) -> None:
    """Draw a line across the field, chain-dotted."""
    start, along = line
    seen = start + along * (100 / (abs(along) * field.mm))  # 100 mm on paper
    part = clipped(*stretched(field(start), field(seen)), above_foot(field.rect))
    if part:
        board.marks.append(LineMark(*part[0], *part[1], "centre-line", name, shows=shows))


def stretched(start: XY, end: XY) -> tuple[XY, XY]:
    """A segment through two points, long enough to leave any page at both ends."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    far = 2000 / max(abs(dx), abs(dy))
    return (start[0] - far * dx, start[1] - far * dy), (start[0] + far * dx, start[1] + far * dy)


# --- marks of a plan's steps: labelled lines, points, poles, arrows ------------------------------


SAME = 0.01
"""Points of a plan closer than this, in mm, are printed as equal."""
PLAN_DOT = 0.7
"""Radius of a point of a plan, in mm."""


def put_locus(plot: Plot, number: int, name: str, text: str, parts: tuple[int, int]) -> None:
    """Draw a construction line as far as the layout says, with a label along it.

    An arrow covers the piece between its first point and the point found on it. The line is drawn
    outside that piece, in two ``parts``, the near one first.
    """
    ends = beyond(plot, number, plot.drawing.trace.values[number])
    drawn = [(end, part) for end, part in zip(ends, parts, strict=False) if end]
    for end, part in drawn:
        line = LineMark(*end[0], *end[1], "construction", name, number, part)
        plot.board.marks.append(line)
    if drawn:
        end, part = drawn[-1]
        own = name, number
        label = Label(text, "construction", end, 2.5, *own, priority=-1, part=part, spare=True)
        plot.board.labels.append(label)


def beyond(plot: Plot, number: int, value: Any) -> list[tuple[XY, XY] | None]:
    """The parts of a line before its first point and after its last, in this order."""
    low, high = plot.layout.spans[number]
    if high - low <= 2 * BEYOND + TINY:
        return [line_part(plot, value, low, high)]
    first = line_part(plot, value, low, low + BEYOND)
    last = line_part(plot, value, high - BEYOND, high)
    return [first, last] if abs(low) < abs(high) else [last, first]


def put_point(plot: Plot, number: int, step: Step, value: Any) -> None:
    """Draw a named point of a plan."""
    if step.name:
        at = plot.field(value)
        plot.board.marks.append(
            CircleMark(*at, PLAN_DOT, f"point {plot.colour}", step.name, number)
        )
        name_point(plot, number, step.name, at, PLAN_DOT)


def put_pole(plot: Plot, number: int, step: Step, value: Any) -> None:
    """Draw the pole of a plan."""
    at = plot.field(value)
    plot.board.marks.append(CircleMark(*at, PIN, f"pole {plot.colour}", step.name, number))
    name_point(plot, number, step.name, at, PIN)


def name_point(
    plot: Plot,
    number: int,
    name: str,
    at: XY,
    radius: float,
    look: str = "",
    *,
    minor: bool = False,
) -> None:
    """Label a point; coinciding points share one label: o ≡ a or, for near points, o ≈ a.

    The letters of minor points are smaller; sentences and tables name these points, too.
    """
    board, look = plot.board, look or plot.colour
    for i, (x, y) in board.lettered.items():
        apart = hypot(x - at[0], y - at[1])
        if apart < TINY:
            label, joint = board.labels[i], "≡" if apart < SAME else "≈"
            letters = (*label.letters, SharedLetter(name, plot.drawing.symbol(name), f" {joint} "))
            board.labels[i] = replace(label.of_letters(letters), spare=label.spare and minor)
            return
    board.lettered[len(board.labels)] = at
    letters = (SharedLetter(name, plot.drawing.symbol(name)),)
    height = 2.5 if minor else 3.5
    label = Label("", look, at, height, "", number, priority=2, radius=radius, spare=minor)
    board.labels.append(label.of_letters(letters))


def put_arrow(plot: Plot, number: int, step: Step, value: Any) -> None:
    """Draw a vector with its symbol; a very short one has no head and is named by a leader."""
    tail, tip = plot.field(value.tail), plot.field(value.tip)
    length = hypot(tip[0] - tail[0], tip[1] - tail[1])
    cls = arrow_class(step, plot)
    if length > 0:
        plot.board.marks += arrow(tail, tip, cls, step.name, number)
    vector = plan_vector(step)
    assert vector is not None
    name, short = plot.drawing.symbol(vector.symbol), length < SHORT
    if length < TINY:
        note_tiny(plot, name, OnPaper(length))
        return
    subject = middle(tail, tip) if short else (tail, tip)
    ask = plot.drawing.scene.ask
    wanted = ask.acceleration if plot.drawing.kind == "acceleration" else ask.velocity
    lettered = step.plane is not Plane.MECHANISM  # a whole vector ends at its point's letter
    spare = bool(lettered or vector.sign or vector.p or vector.q not in wanted)
    plot.board.labels.append(
        Label(name, cls, subject, 2.5, step.name, number, priority=1, led=short, spare=spare)
    )


def arrow_class(step: Step, plot: Plot) -> str:
    """The style of a vector: normal or tangential component, relative or absolute vector."""
    kind = BY_SIGN.get(sign_of(step))
    if kind:
        return kind.look
    tail = plot.drawing.trace.program.steps[step.args[0]].name
    if step.plane is Plane.MECHANISM or tail == plot.drawing.pole:
        return plot.colour
    return f"relative-{plot.colour}"


# --- the canvas of paper -------------------------------------------------------------------------


P = ParamSpec("P")
R = TypeVar("R")
ASIDE = f"point {OWN_LINES}"
"""The class of a point of an auxiliary plan."""
SIDE = 6.0
"""Shortest side of a triangle, in mm, with a right-angle mark at its corner."""
SMALL, ARM = 1.3, 2.2
"""Radius of the circle of a centre, and half the length of its cross, in mm."""
RING = 1.9
"""Radius of the circle around a pin that is a centre, in mm."""
DOT = 0.5
"""Radius of a small point, in mm."""
WITHIN = 2.5
"""Least distance in mm of a marked centre from the edge of its field; the cross needs it."""
LAST = 20.0
"""Length in mm at the end of a ray that the label of a far centre refers to."""
STRAIGHT = 1e6
"""A circle with this radius in mm is a straight line on any page, or invisible."""
FAR = 2000.0
"""A length in mm that is longer than any page."""
BEYOND_TIPS = 4.0
"""Extension of the line through the tips of two vectors, in mm."""


def draw_part(canvas: PaperCanvas, kind: Construction) -> None:
    """Draw the step of a construction, unless the construction is too small."""
    if not (isinstance(kind, TriangleComponent) and kind.is_hidden(canvas.drawing)):
        kind.marks(canvas, canvas.step.role)


def raise_points_aside(plot: Plot) -> None:
    """Move the points of auxiliary plans above arrows, but not above points of the right plan."""
    circles = [mark for mark in plot.board.marks if isinstance(mark, CircleMark)]
    aside = [mark for mark in circles if mark.cls == ASIDE]
    right = [complex(mark.cx, mark.cy) for mark in circles if mark.cls != ASIDE]
    free = {
        id(mark)
        for mark in aside
        if all(abs(complex(mark.cx, mark.cy) - at) > 2 * DOT for at in right)
    }
    plot.board.marks.sort(key=lambda mark: id(mark) in free)


def stroke(
    draw: Callable[Concatenate[PaperCanvas, P], R],
) -> Callable[Concatenate[PaperCanvas, P], R]:
    """Decorate a drawing method so that its marks and labels get the number of the stroke."""

    @wraps(draw)
    def numbered(canvas: PaperCanvas, /, *args: P.args, **more: P.kwargs) -> R:
        board, part = canvas.plot.board, next(canvas.strokes)
        marks, labels = len(board.marks), len(board.labels)
        found = draw(canvas, *args, **more)
        if part:
            board.marks[marks:] = [replace(mark, part=part) for mark in board.marks[marks:]]
            board.labels[labels:] = [replace(each, part=part) for each in board.labels[labels:]]
        return found

    return numbered


class PaperCanvas(Struct, frozen=True):
    """The marks of one step on a field of a sheet, numbered by the strokes that draw them."""

    plot: Plot
    number: int
    strokes: Iterator[int] = field(default_factory=count)

    @property
    def drawing(self) -> Drawing:
        return self.plot.drawing

    @property
    def step(self) -> Step:
        return self.drawing.trace.program.steps[self.number]

    @property
    def mm(self) -> float:
        """The size of one unit of the field on paper, in mm."""
        return self.plot.field.mm

    def value(self, number: int) -> Any:
        return self.drawing.trace.values[number]

    def size(self, way: Any) -> Any:
        """The drawn length of a vector of the mechanism, in mm."""
        return abs(way) * self.plot.field.mm

    @stroke
    def vector(self, name: str, look: str, tail: Any, tip: Any) -> None:
        """Draw a vector on the mechanism, with its symbol."""
        start, end = self.plot.field(tail), self.plot.field(tip)
        self.plot.board.marks += arrow(start, end, look, name, self.number)
        short = hypot(end[0] - start[0], end[1] - start[1]) < SHORT
        subject = middle(start, end) if short else (start, end)
        self.plot.board.labels.append(
            Label(
                self.drawing.symbol(name),
                look,
                subject,
                2.5,
                name,
                self.number,
                led=short,
                spare=True,
            )
        )

    @stroke
    def point(self, name: str, at: Any) -> None:
        """Draw a small named point."""
        place, own = self.plot.field(at), self.step.name
        self.circled(place, "point construction", DOT)
        self.plot.board.labels.append(
            Label(
                self.drawing.symbol(name), "construction", place, 2.5, own, self.number, radius=DOT
            )
        )

    @stroke
    def foot(self, name: str, at: Any) -> None:
        """Draw a small point of a plan with its letter."""
        place = self.plot.field(at)
        mark = CircleMark(*place, DOT, f"point {self.plot.colour}", name, self.number)
        self.plot.board.marks.append(mark)
        name_point(self.plot, self.number, name, place, DOT, minor=True)

    @stroke
    def segment(self, start: Any, end: Any) -> None:
        """Draw a thin line between two points."""
        self.thin(self.plot.field(start), self.plot.field(end))

    @stroke
    def line(self, look: str = "construction", name: str | None = None) -> bool:
        """Draw the step's own line as the layout says; False where the field holds none of it."""
        return self.own(look, name)

    @stroke
    def line_beyond(self) -> None:
        """Draw the step's own line where it extends beyond its two defining points."""
        low, high = self.plot.layout.spans[self.number]
        if high - low >= 2 * BEYOND + TINY:
            self.own("construction")

    @stroke
    def line_end(self, name: str) -> None:
        """Draw the end of the step's own line, beyond everything drawn on it."""
        high = self.plot.layout.spans[self.number][1]
        part = line_part(self.plot, self.value(self.number), high - 2 * BEYOND, high)
        if part:
            line = LineMark(*part[0], *part[1], "construction", name, self.number)
            self.plot.board.marks.append(line)

    @stroke
    def arc(self, name: str) -> None:
        """Draw the part of the step's own circle where points were found on it."""
        span = self.plot.layout.spans.get(self.number)
        if span is not None:
            circle = self.value(self.number)
            centre, radius = self.plot.field(circle.centre), self.size(circle.radius)
            marks = self.plot.board.marks
            marks.append(Arc(*centre, radius, *span, "compass", name, self.number))

    def own(self, look: str, name: str | None = None) -> bool:
        """Draw the step's own line within the stroke; False where the field holds none of it."""
        ends = line_part(self.plot, self.value(self.number), *self.plot.layout.spans[self.number])
        if ends:
            self.thin(*ends, look, name)
        return ends is not None

    def thin(self, start: XY, end: XY, look: str = "construction", name: str | None = None) -> None:
        """Draw a thin line with the step's name unless ``name`` is given."""
        called = self.step.name if name is None else name
        self.plot.board.marks.append(LineMark(*start, *end, look, called, self.number))

    @stroke
    def right_angle(self, toward: Any) -> None:
        """Draw the right-angle mark at the start of the step's line, if there is room for it."""
        line = self.value(self.number)
        corner, other = self.plot.field(line.point), self.plot.field(toward)
        back = hypot(other[0] - corner[0], other[1] - corner[1])
        if back > SIDE:
            first = ((other[0] - corner[0]) / back, (other[1] - corner[1]) / back)
            u, v = self.plot.field.way(line.along)
            low, high = self.plot.layout.spans[self.number]
            second = (-u, -v) if -low > high else (u, v)
            self.plot.board.marks.append(square_mark(corner, first, second, self.number))

    @stroke
    def swing(self, centre: Any, end: Any) -> None:
        """Draw the arc along which a point was turned about a centre, unless the centre is near."""
        at, tip = self.plot.field(centre), self.plot.field(end)
        radius = hypot(tip[0] - at[0], tip[1] - at[1])
        if radius > SHORT:
            way = bearing((tip[0] - at[0], tip[1] - at[1]))
            half = min(degrees(SWEEP / radius / 2), 60.0)
            span = (way - half, way + half)
            marks = self.plot.board.marks
            marks.append(Arc(*at, radius, *span, "compass", self.step.name, self.number))

    @stroke
    def opening(self, name: str, centre: Any, end: Any) -> None:
        """Draw the part of an arc about a centre that finds a point on it."""
        circle = Circle(centre, abs(end - centre))
        span, radius = arc_span(circle, [end], self.mm), circle.radius * self.mm
        at = self.plot.field(centre)
        arc = Arc(*at, radius, *span, "compass", name, self.number)
        self.plot.board.marks.append(arc)

    # --- plans -----------------------------------------------------------------------------------

    @property
    def is_aside(self) -> bool:
        """Whether the step is part of an auxiliary plan, which draws its own points and lines."""
        return self.number in self.drawing.auxiliary

    def locus(self, name: str, text: str) -> None:
        """Draw the step's own line beyond the points on it, with a label along it."""
        parts = next(self.strokes), next(self.strokes)
        if not self.is_aside:
            put_locus(self.plot, self.number, name, text, parts)

    @stroke
    def image(self) -> None:
        """Draw the step's own point of the plan with its letter, if it has a letter."""
        if not self.is_aside:
            put_point(self.plot, self.number, self.step, self.value(self.number))

    @stroke
    def pole(self) -> None:
        """Draw the step's own point as the pole of the plan."""
        put_pole(self.plot, self.number, self.step, self.value(self.number))

    @stroke
    def side(self, start: Any, end: Any) -> None:
        """Draw a side of a link's image, if it is long enough."""
        look = OWN_LINES if self.is_aside else "construction"
        self.joining(self.step.name, look, start, end)

    @stroke
    def image_aside(self) -> None:
        """Draw the step's own point in an auxiliary plan, as a smaller point."""
        if self.step.name:
            place = self.plot.field(self.value(self.number))
            self.circled(place, ASIDE, DOT)
            name_point(self.plot, self.number, self.step.name, place, DOT, OWN_LINES, minor=True)

    @stroke
    def leg(self, name: str, look: str, start: Any, end: Any) -> None:
        """Draw a thin line in a given style between two distinct points of a plan."""
        self.joining(name, look, start, end)

    def joining(self, name: str, look: str, start: Any, end: Any) -> None:
        """Draw a thin line between two distinct points within the current stroke."""
        if self.size(end - start) > NEAR:
            field = self.plot.field
            part = in_field(field(start), field(end), field.rect)
            if part is not None:
                self.thin(*part, look, name)

    @stroke
    def stretch(self, name: str, look: str, at: Any, along: Any, low: Any, high: Any) -> None:
        """Draw a thin line on a line through a point, from one distance to another."""
        self.joining(name, look, at + along * low, at + along * high)

    @stroke
    def through(self, first: Any, second: Any, third: Any) -> None:
        """Draw a chain line through two distinct points and a third, extended a little beyond."""
        way = second - first
        if self.size(way) > NEAR:
            unit = way / abs(way)
            along = [((p - first) * unit.conjugate()).real for p in (first, second, third)]
            beyond = BEYOND / 2 / self.mm
            low, high = min(along) - beyond, max(along) + beyond
            ends = self.plot.field(first + low * unit), self.plot.field(first + high * unit)
            self.thin(*ends, CHAIN_LINES, "")

    # --- centres ---------------------------------------------------------------------------------

    @stroke
    def centre(self, value: Ratio) -> bool:
        """Draw the circle and cross of a centre with its letter; False if it is off the field."""
        point = self.drawing.place(value)
        if point is None or not self.plot.field.holds(point, WITHIN):
            return False
        (x, y), cls, name = self.plot.field(point), f"centre {self.plot.colour}", self.step.name
        self.circled((x, y), cls, RING if self.is_under_pin(point) else SMALL)
        self.plot.board.marks += (
            LineMark(x - ARM, y, x + ARM, y, cls, name, self.number),
            LineMark(x, y - ARM, x, y + ARM, cls, name, self.number),
        )
        name_point(self.plot, self.number, self.step.name, (x, y), ARM)
        return True

    def is_under_pin(self, point: complex) -> bool:
        """Whether the pin of a point covers the middle of a centre."""
        places = self.drawing.positions.values()
        return any(self.size(place - point) < FIXED for place in places)

    def circled(self, at: XY, cls: str, radius: float) -> None:
        """Draw a circle with the step's name."""
        self.plot.board.marks.append(CircleMark(*at, radius, cls, self.step.name, self.number))

    @stroke
    def ring(self, at: Any) -> None:
        """Draw the ring around a pin that is a centre, with the letter of the centre."""
        place = self.plot.field(at)
        self.circled(place, f"centre {self.plot.colour}", RING)
        name_point(self.plot, self.number, self.step.name, place, RING)

    @stroke
    def spot(self, at: Any) -> None:
        """Draw a small point with its letter, if it lies in the field."""
        if self.plot.field.holds(at, WITHIN):
            place = self.plot.field(at)
            self.circled(place, "point construction", DOT)
            name_point(self.plot, self.number, self.step.name, place, DOT)

    @stroke
    def dimension(self, name: str, start: Any, end: Any) -> None:
        """Draw a dimension line with a head at each end of it, and its symbol.

        An end beyond the field has no head, and a note says so.
        """
        ends = self.plot.field(start), self.plot.field(end)
        part = in_field(*ends, self.plot.field.rect)
        if part != ends:
            self.note(self.drawing.words("page.arm_beyond", name=symbol(name)))
        if part is None:
            return
        tail, tip = part
        self.thin(tail, tip, "dimension", name)
        if hypot(tip[0] - tail[0], tip[1] - tail[1]) >= 2 * HEAD:
            self.plot.board.marks += (
                head(other, at, "dimension", name, self.number)
                for at, other in ((tip, tail), (tail, tip))
                if at in ends
            )
        self.plot.board.labels.append(
            Label(symbol(name), "dimension", part, 2.5, name, self.number, spare=True)
        )

    @stroke
    def circle(self, circle: Circle, look: str) -> None:
        """Draw the part of a circle that lies in the field."""
        mm = self.plot.field.mm
        if TINY < circle.radius * mm < STRAIGHT:
            around = [self.plot.field(point) for point in ring(circle, mm)]
            cls, rect = f"{look} {self.plot.colour}", above_foot(self.plot.field.rect)
            parts = clipped_path(around, rect, cls, self.step.name, self.number)
            self.plot.board.marks.extend(parts)

    @stroke
    def away(
        self, start: Any, way: Any, text: str, *, ray: bool = True, headed: bool = True
    ) -> None:
        """Write a text for something off the field, where the ray to it leaves the field."""
        (x, y), (u, v) = self.plot.field(start), self.plot.field.way(way)
        rect, colour, name = above_foot(self.plot.field.rect), self.plot.colour, self.step.name
        part = clipped((x, y), (x + FAR * u, y + FAR * v), rect)
        if part is None:
            return
        if headed:
            self.plot.board.marks.append(head(*part, colour, name, self.number))
        if ray:
            self.plot.board.marks.append(LineMark(*part[0], *part[1], "ray", name, self.number))
        (x, y) = end = part[1]
        subject = ((x - LAST * u, y - LAST * v), end)
        label = Label(text, colour, subject, 2.5, name, self.number, priority=2)
        self.plot.board.labels.append(label)

    @stroke
    def through_tips(self, one: tuple[Any, Any], other: tuple[Any, Any]) -> None:
        """Draw the line through the tips of two vectors and a little beyond."""
        first, last = sum(one), sum(other)
        if first != last:
            on = (last - first) / abs(last - first) * BEYOND_TIPS / self.plot.field.mm
            ends = self.plot.field(first - on), self.plot.field(last + on)
            part = clipped(*ends, above_foot(self.plot.field.rect))
            if part:
                line = LineMark(*part[0], *part[1], "ray", self.step.name, self.number)
                self.plot.board.marks.append(line)

    def holds(self, place: Any) -> bool:
        """Whether a place is in the field of the sheet."""
        return self.plot.field.holds(place)

    def note(self, text: str, lead: str = "") -> None:
        """Write a text at the foot of the field, once."""
        if (note := FootNote(text, lead=lead)) not in self.plot.board.notes:
            self.plot.board.notes.append(note)
