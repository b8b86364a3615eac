"""What a construction draws with: the marks of one step, in any kind of number."""

from __future__ import annotations

from typing import Any, Protocol

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.numbers.plane import Circle, Ratio


class Canvas(Protocol):
    """Where the marks of one step are put down; places are points of the mechanism, in metres.

    Paper draws them at once; a page that moves keeps how each follows its values.
    """

    @property
    def drawing(self) -> Drawing:
        """The sheet at the position where the scene stands."""

    @property
    def mm(self) -> float:
        """The millimetres of paper that a unit of the field takes up."""

    def value(self, number: int) -> Any:
        """The value of a step."""

    def size(self, way: Any) -> Any:
        """How long a way of the mechanism is drawn, in mm."""

    def vector(self, name: str, look: str, tail: Any, tip: Any) -> None:
        """A vector with its symbol, in the look of its kind."""

    def point(self, name: str, at: Any) -> None:
        """A small point with its letter."""

    def segment(self, start: Any, end: Any) -> None:
        """A thin line between two points."""

    def line(self, look: str = "construction", name: str | None = None) -> bool:
        """The step's own line as far as it is needed; False where none of it is in the field.

        Thin if no look is told; it bears the step's name unless another is told.
        """

    def line_beyond(self) -> None:
        """The same, where it leads farther than its own two points."""

    def line_end(self, name: str) -> None:
        """The end of the step's own line, beyond what is drawn on it."""

    def arc(self, name: str) -> None:
        """As much of the step's own circle as finds the points on it."""

    def right_angle(self, toward: Any) -> None:
        """The mark of a right angle where the step's line begins, against the way to a point."""

    def swing(self, centre: Any, end: Any) -> None:
        """The arc by which a point was carried about a centre."""

    def opening(self, name: str, centre: Any, end: Any) -> None:
        """As much of the arc about a centre as finds a point on it."""

    # --- plans -------------------------------------------------------------------------------

    def locus(self, name: str, text: str) -> None:
        """The step's own line beyond the points on it, with what it is drawn by along it."""

    def image(self) -> None:
        """The step's own point of the plan with its letter; none of a point without letter."""

    def pole(self) -> None:
        """The step's own point as the pole of the plan."""

    def side(self, start: Any, end: Any) -> None:
        """A side of the image of a link, where it is long enough to be drawn."""

    def image_aside(self) -> None:
        """The same point of an auxiliary plan, which is smaller."""

    def leg(self, name: str, look: str, start: Any, end: Any) -> None:
        """A thin line of a look between two points of a plan that stand apart."""

    def stretch(self, name: str, look: str, at: Any, along: Any, low: Any, high: Any) -> None:
        """A thin line of a look on a line through a point, from one distance to another."""

    def through(self, first: Any, second: Any, third: Any) -> None:
        """A chain line through two points that stand apart and a third, a little beyond them."""

    # --- centres -----------------------------------------------------------------------------

    def centre(self, value: Ratio) -> bool:
        """The circle and cross of a centre with its letter; False where it is off the field."""

    def ring(self, at: Any) -> None:
        """The ring around a pin that is a centre, with the centre's letter."""

    def spot(self, at: Any) -> None:
        """A small point with its letter, where the field holds it."""

    def circle(self, circle: Circle, look: str) -> None:
        """As much of a circle as lies in the field."""

    def away(
        self, start: Any, way: Any, text: str, *, ray: bool = True, headed: bool = True
    ) -> None:
        """Words for what lies off the field, where the ray to it leaves the field."""

    def through_tips(self, one: tuple[Any, Any], other: tuple[Any, Any]) -> None:
        """The line through the tips of two parallel vectors, each given by its tail and its way."""

    def note(self, text: str) -> None:
        """Words at the foot of the field."""
