"""The interface on which a construction draws the marks of one step, in any kind of number."""

from __future__ import annotations

from typing import Any, Protocol

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.numbers.plane import Circle, Ratio


class Canvas(Protocol):
    """Where the marks of one step are drawn; places are points of the mechanism, in metres.

    Paper draws them at once. An animated page records how each mark depends on the values.
    """

    @property
    def drawing(self) -> Drawing:
        """The sheet at the position of the scene."""

    @property
    def mm(self) -> float:
        """The size of one unit of the field on paper, in mm."""

    def value(self, number: int) -> Any:
        """The value of a step."""

    def size(self, way: Any) -> Any:
        """The drawn length of a vector of the mechanism, in mm."""

    def vector(self, name: str, look: str, tail: Any, tip: Any) -> None:
        """A vector with its symbol, in the style of its kind."""

    def point(self, name: str, at: Any) -> None:
        """A small point with its letter."""

    def segment(self, start: Any, end: Any) -> None:
        """A thin line between two points."""

    def line(self, look: str = "construction", name: str | None = None) -> bool:
        """The step's own line, as far as it is needed; False where the field holds none of it.

        The line is thin unless ``look`` gives a style, and has the step's name unless ``name`` is
        given.
        """

    def line_beyond(self) -> None:
        """The step's own line, where it extends beyond its two defining points."""

    def line_end(self, name: str) -> None:
        """The end of the step's own line, beyond everything drawn on it."""

    def arc(self, name: str) -> None:
        """The part of the step's own circle that finds the points on it."""

    def right_angle(self, toward: Any) -> None:
        """The right-angle mark where the step's line starts, against the direction to a point."""

    def swing(self, centre: Any, end: Any) -> None:
        """The arc along which a point was turned about a centre."""

    def opening(self, name: str, centre: Any, end: Any) -> None:
        """The part of an arc about a centre that finds a point on it."""

    # --- plans -----------------------------------------------------------------------------------

    def locus(self, name: str, text: str) -> None:
        """The step's own line beyond the points on it, with a label along it."""

    def image(self) -> None:
        """The step's own point of the plan with its letter; nothing if the point has no letter."""

    def pole(self) -> None:
        """The step's own point as the pole of the plan."""

    def side(self, start: Any, end: Any) -> None:
        """A side of a link's image, if it is long enough to be drawn."""

    def image_aside(self) -> None:
        """The step's own point in an auxiliary plan, drawn smaller."""

    def leg(self, name: str, look: str, start: Any, end: Any) -> None:
        """A thin line in a given style between two distinct points of a plan."""

    def stretch(self, name: str, look: str, at: Any, along: Any, low: Any, high: Any) -> None:
        """A thin line in a given style, on a line through a point, from one distance to another."""

    def through(self, first: Any, second: Any, third: Any) -> None:
        """A chain line through two distinct points and a third, extended a little beyond."""

    # --- centres ---------------------------------------------------------------------------------

    def centre(self, value: Ratio) -> bool:
        """The circle and cross of a centre with its letter; False where it lies off the field."""

    def ring(self, at: Any) -> None:
        """A ring around a pin that is a centre, with the letter of the centre."""

    def spot(self, at: Any) -> None:
        """A small point with its letter, if it lies in the field."""

    def dimension(self, name: str, start: Any, end: Any) -> None:
        """A dimension line between two points, with its symbol."""

    def circle(self, circle: Circle, look: str) -> None:
        """The part of a circle that lies in the field."""

    def away(
        self, start: Any, way: Any, text: str, *, ray: bool = True, headed: bool = True
    ) -> None:
        """A text for something off the field, placed where the ray to it leaves the field."""

    def through_tips(self, one: tuple[Any, Any], other: tuple[Any, Any]) -> None:
        """The line through the tips of two parallel vectors, each as tail and direction."""

    def holds(self, place: Any) -> bool:
        """Whether a place is in the field."""

    def note(self, text: str, lead: str = "") -> None:
        """A text at the foot of the field; texts with one lead are listed after it."""
