"""How the marks of constructions follow while a page moves: the same drawing, on traced numbers."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from msgspec import Struct, field

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.layout import BEYOND
from graphkin.numbers.arithmetic import larger, smaller
from graphkin.numbers.plane import Circle, Ratio, dot
from graphkin.web.body_pose import unit
from graphkin.web.field_binder import FieldBinder
from graphkin.web.moving_sheet import place_of

Ends = tuple[Any, Any]


class MovingCanvas(Struct):
    """What the marks of one step are drawn from: its vector, its legs, and what its line faces.

    ``stands`` is where its circle is laid; one that ``is_cut`` shows only where the field has room.
    ``endless`` are start and direction of a ray, ``tips`` the vectors whose tips are joined.
    """

    binder: FieldBinder
    ends: Ends | None = None
    legs: list[Callable[[], Ends]] = field(default_factory=list)
    faces: Any = None
    swung: Ends | None = None
    is_beyond: bool = False
    is_end: bool = False
    stands: Any = None
    is_cut: bool = False
    endless: Ends | None = None
    tips: tuple[Ends, Ends] | None = None

    @property
    def place(self) -> Any:
        """The point where its circle is laid; None where it has none."""
        return place_of(self.stands) if isinstance(self.stands, Ratio) else self.stands

    @property
    def drawing(self) -> Drawing:
        """The sheet where the scene stands."""
        return self.binder.places.drawing

    @property
    def mm(self) -> float:
        """The millimetres of paper that a unit of the field takes up."""
        return self.binder.field.mm

    def value(self, number: int) -> Any:
        """The value of a step while it moves."""
        return self.binder.places.values[number]

    def size(self, way: Any) -> Any:
        """How long a way of the mechanism is drawn, in mm."""
        return abs(self.binder.tape.lifted(way)) * self.binder.field.mm

    def vector(self, name: str, look: str, tail: Any, tip: Any) -> None:
        """A vector between two points that move."""
        self.ends = tail, tip

    def point(self, name: str, at: Any) -> None:
        """A small point, which is the step's own value."""

    def segment(self, start: Any, end: Any) -> None:
        """A thin line between two points that move."""
        self.legs.append(lambda: (start, end))

    def line(self) -> bool:
        """The step's own line."""
        return True

    def line_beyond(self) -> None:
        """The same, while it leads farther than its own two points."""
        self.is_beyond = True

    def line_end(self, name: str) -> None:
        """The end of the step's own line."""
        self.is_end = True

    def arc(self, name: str) -> None:
        """The arc, which is the step's own value."""

    def right_angle(self, toward: Any) -> None:
        """The mark of a right angle at the beginning of the step's line."""
        self.faces = toward

    def swing(self, centre: Any, end: Any) -> None:
        """The arc by which a point was carried about a centre."""
        self.swung = centre, end

    # --- plans -------------------------------------------------------------------------------

    def locus(self, name: str, text: str) -> None:
        """The step's own line."""

    def image(self) -> None:
        """The step's own point."""

    def pole(self) -> None:
        """The pole, which stays."""

    def side(self, start: Any, end: Any) -> None:
        """A side of the image of a link."""
        self.segment(start, end)

    def image_aside(self) -> None:
        """The same of an auxiliary plan."""

    def line_aside(self) -> None:
        """The step's own line."""

    def leg(self, name: str, look: str, start: Any, end: Any) -> None:
        """A thin line between two points that move."""
        self.legs.append(lambda: (start, end))

    def stretch(self, name: str, look: str, at: Any, along: Any, low: Any, high: Any) -> None:
        """A thin line of a look on a line through a point, from one distance to another."""
        self.legs.append(lambda: (at + along * low, at + along * high))

    def chain(self) -> None:
        """The step's own line."""

    def through(self, first: Any, second: Any, third: Any) -> None:
        """The line through two points as far as a third, a little beyond them all."""
        self.legs.append(lambda: self.around(first, second, third))

    def around(self, first: Any, second: Any, third: Any) -> Ends:
        """The ends of such a line."""
        lift = self.binder.tape.lifted
        first, last = lift(first), lift(second)
        way = unit(last - first)
        low = high = lift(0.0)
        for point in (last, lift(third)):
            along = dot(point - first, way)
            low, high = smaller(low, along), larger(high, along)
        beyond = BEYOND / 2 / self.mm
        return first + way * (low - beyond), first + way * (high + beyond)

    # --- centres -----------------------------------------------------------------------------

    def ray(self, name: str) -> None:
        """The step's own line."""

    def centre(self, value: Ratio) -> bool:
        """A centre that moves, and shows where the field has room for it."""
        self.spot(value)
        return True

    def ring(self, at: Any) -> None:
        """The ring around a pin."""
        self.stands = at

    def spot(self, at: Any) -> None:
        """A small point, where the field has room for it."""
        self.stands, self.is_cut = at, True

    def circle(self, circle: Circle, look: str) -> None:
        """A circle, which is the step's own value."""

    def away(
        self, start: Any, way: Any, text: str, *, ray: bool = True, headed: bool = True
    ) -> None:
        """The ray to what lies at infinity."""
        self.endless = start, way

    def through_tips(self, one: Ends, other: Ends) -> None:
        """The line through the tips of two vectors, while these are parallel."""
        self.tips = one, other

    def note(self, text: str) -> None:
        """Words of the drawn position alone."""
