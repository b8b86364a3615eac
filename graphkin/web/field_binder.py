"""How a mark follows the driver: a record of a kind, outputs by their index, and constants.

Every record begins with the id of its mark, its kind, and the index of an output. The mark shows
while this output is positive; the index -1 means that it always shows. The kinds, as moving.js
draws them:

- ``l`` a line between two places; ``g`` a polygon between places; ``h`` an arrowhead at the second
- ``f`` a line, ``r`` a polygon, ``m`` a circle, ``t`` a text that a pose carries; ``x`` a polygon
  whose corners are carried by several poses; ``b`` a text next to a segment
- ``a`` an arc, ``i`` a circle as a broken line, both given by centre and size
- ``s`` a part of a construction line
- ``o`` a mark that holds for the drawn position alone
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any

from msgspec import Struct

from graphkin.construction.tape.emitted import NOWHERE, TapeOutputs
from graphkin.drawing.field import XY, Field, Rect
from graphkin.drawing.marks import Arc, CircleMark, LineMark, Mark, Polyline, Text, style_class
from graphkin.drawing.richtext import extent
from graphkin.web.moving_sheet import BodyPose, MovingSheet

GROWTH = 3.5
"""Growth of a field on each side, in widths or heights of the field, for marks that leave it."""
UNSEEN = ("centre-line", "moving-centrode", "caption")
"""Classes of marks that may leave the field, and of marks that the page shows elsewhere."""
SIGHT_DIGITS = 1
"""Decimals of millimetres for the boxes that must be in sight."""


def room_of(rect: Rect) -> Rect:
    """The rectangle that a field can grow to, at which lines are cut."""
    left, top, right, bottom = rect
    across, down = GROWTH * (right - left), GROWTH * (bottom - top)
    return left - across, top - down, right + across, bottom + down


def must_be_seen(mark: Mark) -> bool:
    """Whether all of a mark must be in sight."""
    return style_class(mark) not in UNSEEN


def half(mark: Mark) -> tuple[float, float]:
    """Half the width and half the height of a mark, in mm; zero for a mark given by its points."""
    if isinstance(mark, CircleMark):
        return round(mark.r, SIGHT_DIGITS), round(mark.r, SIGHT_DIGITS)
    if isinstance(mark, Text):
        width, top, bottom = extent(mark.markup, mark.height)
        return round(width / 2, SIGHT_DIGITS), round((bottom - top) / 2, SIGHT_DIGITS)
    return 0, 0


def box_of(marks: Iterable[Mark]) -> Rect | None:
    """The rectangle around marks that do not move; None without any."""
    corners = [corner for mark in marks if must_be_seen(mark) for corner in corners_of(mark)]
    if not corners:
        return None
    across, down = zip(*corners, strict=True)
    left, right = (round(end(across), SIGHT_DIGITS) for end in (min, max))
    top, bottom = (round(end(down), SIGHT_DIGITS) for end in (min, max))
    return left, top, right, bottom


def corners_of(mark: Mark) -> Iterator[tuple[float, float]]:
    """The points that bound a mark."""
    match mark:
        case LineMark():
            yield from ((mark.x1, mark.y1), (mark.x2, mark.y2))
        case CircleMark() | Arc():
            x, y = (mark.cx, mark.cy)
            yield from ((x - mark.r, y - mark.r), (x + mark.r, y + mark.r))
        case Text():
            width, top, bottom = extent(mark.markup, mark.height)
            left = mark.x + mark.left()
            yield from ((left, mark.y + top), (left + width, mark.y + bottom))
        case _:
            yield from mark.points


# --- records --------------------------------------------------------------------------------------


Record = list[Any]
Binding = Callable[[Mark], Record | None]
"""Makes the record of a mark, all but its number; None for a mark that does not move."""
Told = dict[Mark, Binding]
SPACING = 2.2
"""Distance between the strokes of hatching, in mm."""
DIGITS = 6
"""Decimals of millimetres in records."""


def still(_: Mark) -> None:
    """Bind a mark that does not move."""


def only_at_start(_: Mark) -> Record:
    """Bind a mark that holds for the drawn position alone."""
    return ["o", NOWHERE]


def rounded(*numbers: float) -> list[float]:
    """Millimetres rounded as they are written."""
    return [int(r) if (r := round(number, DIGITS)) == int(r) else r for number in numbers]


class FieldBinder(Struct, frozen=True):
    """Binds the marks of one field: traced values, the field, and the clip rectangles."""

    places: MovingSheet
    field: Field
    rects: list[Rect]

    @property
    def tape(self) -> TapeOutputs:
        return self.places.tape

    @property
    def room(self) -> Rect:
        """The rectangle that the field can grow to, at which lines are cut."""
        return room_of(self.field.rect)

    def page(self, point: Any) -> Any:
        """The place on the page of a traced point of the drawing: x to the right, y down."""
        place, known = self.tape.lifted(point), self.tape.pages
        key = (self.field, place.node, place.down)
        if key not in known:
            mm, middle, (x, y) = self.field.mm, self.field.middle, self.field.at
            across = place.real * mm + (x - middle.real * mm)
            down = (y + middle.imag * mm) - place.imag * mm
            known[key] = across.of(across, down)
        return known[key]

    def pose(self, pose: BodyPose) -> BodyPose:
        """The pose on the page of a pose of the drawing."""
        return BodyPose(self.page(pose.origin), self.tape.lifted(pose.way).conjugate())

    def rect(self, rect: Rect | None) -> int:
        """The number of a rectangle at which lines are cut."""
        if rect is None:
            return NOWHERE
        if rect not in self.rects:
            self.rects.append(rect)
        return self.rects.index(rect)

    # --- bindings ------------------------------------------------------------------------------

    def carried_by(self, pose: BodyPose | None) -> Binding:
        """Bind a mark that moves rigidly with a pose of the drawing."""
        return still if pose is None else self.on(self.pose(pose))

    def with_point(self, point: Any) -> Binding:
        """Bind a mark that keeps its offset from a point of the drawing and does not turn."""
        return self.on(BodyPose(self.page(point), self.tape.lifted(1 + 0j)))

    def on(self, pose: BodyPose, rect: Rect | None = None) -> Binding:
        """Bind a mark that moves rigidly with a pose of the page."""
        fixed = all(self.is_constant(part) for part in pose)
        return still if fixed else lambda mark: [*self.rigid(mark, pose, rect)]

    def is_constant(self, value: Any) -> bool:
        """Whether a number or point never changes."""
        number, graph = self.tape.lifted(value), self.tape.graph
        nodes = [number.node, number.imag.node]
        return all(graph.constant(node) is not None for node in nodes)

    def rigid(self, mark: Mark, pose: BodyPose, rect: Rect | None) -> Record:
        """The record of a mark that moves rigidly."""
        head = [NOWHERE, self.tape.point(pose.origin), self.tape.point(pose.way)]
        origin, way = complex(self.tape.now(pose.origin)), complex(self.tape.now(pose.way))

        def local(x: float, y: float) -> list[float]:
            place = (complex(x, y) - origin) * way.conjugate()
            return rounded(place.real, place.imag)

        match mark:
            case LineMark():
                ends = [*local(mark.x1, mark.y1), *local(mark.x2, mark.y2)]
                return ["f", *head, *ends, self.rect(rect)]
            case Polyline():
                return ["r", *head, *(number for point in mark.points for number in local(*point))]
            case CircleMark():
                return ["m", *head, *local(mark.cx, mark.cy)]
            case Arc():
                raise AssertionError("an arc follows by its centre and angles")
            case Text():
                middle = middle_of(mark)
                return ["t", *head, *local(*middle), *rounded(*middle)]

    def beside(self, pose: BodyPose, shown: Any = None) -> Binding:
        """Bind a text next to a segment, which is given by its midpoint and direction on the page.

        The text follows the segment, stays upright, and keeps its clear distance.
        """

        def bound(mark: Mark) -> Record:
            if not isinstance(mark, Text):
                return self.conditioned(self.rigid(mark, pose, None), shown)
            width, top, bottom = extent(mark.markup, mark.height)
            half, tall = width / 2, (bottom - top) / 2
            middle = CircleMark(*middle_of(mark), 1.0, "")
            _, *head, along, aside = self.rigid(middle, pose, None)
            way = complex(self.tape.now(pose.way))
            room = abs(aside) - abs(way.imag) * half - abs(way.real) * tall
            box = rounded(middle.cx, middle.cy, half, tall, room)
            return self.conditioned(["b", *head, along, aside, *box], shown)

        return bound

    def between(self, start: Any, end: Any, rect: Rect | None = None, shown: Any = None) -> Binding:
        """Bind a line between two traced points of the drawing."""
        return self.joining(self.page(start), self.page(end), rect, shown)

    def joining(self, start: Any, end: Any, rect: Rect | None = None, shown: Any = None) -> Binding:
        """Bind a line between two traced places of the page."""
        return lambda _: [
            "l",
            self.condition(shown),
            self.tape.point(start),
            self.tape.point(end),
            self.rect(rect),
        ]

    def head(self, tail: Any, tip: Any, shown: Any = None) -> Binding:
        """Bind the head of an arrow between two traced points of the drawing."""
        return self.heading(self.page(tail), self.page(tip), shown)

    def heading(self, tail: Any, tip: Any, shown: Any = None) -> Binding:
        """Bind the head of an arrow between two traced places of the page."""
        return lambda _: ["h", self.condition(shown), *map(self.tape.point, (tail, tip))]

    def corners(self, places: Sequence[Any], shown: Any = None) -> Binding:
        """Bind a polygon or broken line through traced places of the page."""
        return lambda _: ["g", self.condition(shown), *map(self.tape.point, places)]

    def at(self, point: Any, shown: Any = None) -> Binding:
        """Bind a circle of constant size around a traced point of the drawing."""
        one = BodyPose(self.page(point), self.tape.lifted(1 + 0j))
        return lambda mark: self.conditioned(self.rigid(mark, one, None), shown)

    def conditioned(self, record: Record, shown: Any) -> Record:
        """The record, shown only while ``shown`` is positive."""
        return [record[0], self.condition(shown), *record[2:]]

    def condition(self, shown: Any) -> int:
        """The index of the output that must be positive for a mark to show."""
        return NOWHERE if shown is None else self.tape.number(shown)

    def by_poses(self, poses: Sequence[BodyPose]) -> Binding:
        """Bind a polygon whose corners are carried by poses of the page, one pose for each."""

        def bound(mark: Mark) -> Record:
            assert isinstance(mark, Polyline)
            found: Record = ["x", NOWHERE]
            for point, pose in zip(mark.points, poses, strict=True):
                found += self.rigid(CircleMark(*point, 1.0, ""), pose, None)[2:]
            return found

        return bound

    def arc(self, centre: Any, radius: Any, span: tuple[Any, Any], shown: Any = None) -> Binding:
        """Bind an arc whose centre and angles (degrees) move; the radius is in metres."""
        size = self.tape.lifted(radius) * self.field.mm
        return self.sweeping(self.page(centre), size, span, shown)

    def sweeping(
        self, centre: Any, radius: Any, span: tuple[Any, Any], shown: Any = None
    ) -> Binding:
        """Bind an arc around a place of the page; the radius is in mm."""
        return lambda _: [
            "a",
            self.condition(shown),
            self.tape.point(centre),
            self.tape.number(radius),
            *map(self.tape.number, span),
        ]


def middle_of(text: Text) -> XY:
    """The middle of a text's box, about which an upright label turns."""
    width, top, bottom = extent(text.markup, text.height)
    return text.x + text.left() + width / 2, text.y + (top + bottom) / 2
