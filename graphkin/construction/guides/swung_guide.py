"""A guide that turns about a pivot and guides a pin, or that two pins guide.

Its line is drawn through both pins, or as a tangent from one pin to a circle about the other.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

from msgspec.structs import replace

from graphkin.construction.core.branches import way_of
from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.crossings import Determined
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import ByHand, LaidLength, PlacesLink
from graphkin.construction.core.naming import drawn_amount
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import OwnStep, Part, Plane, Step
from graphkin.construction.core.vocabulary import action, ray
from graphkin.construction.guides.guides import (
    axis_by_guide,
    height_between,
    height_of,
    is_through,
    local_line,
    turned_with,
)
from graphkin.construction.links.dyad_by_arcs import arcs_meet, compass
from graphkin.drawing.symbol_markup import bar, escape, symbol
from graphkin.numbers.arithmetic import Point, Real, at, pick, sqrt
from graphkin.scene.link_points import lettered
from graphkin.structure.groups import Dyad, OnTwoPins
from graphkin.structure.pairs import Pin, Sliding
from graphkin.text.errors import Message, Problem, Sought, message

# --- values --------------------------------------------------------------------------------------


def swing_margin(pivot: Point, pin: Point, height: Real, way: int, size: float) -> Real:
    """Cosine of the angle between the guide and the line of its two pins.

    Pins closer together than the mechanism's ``size`` give the direction as badly as a flat
    crossing. For these, the cosine is the ratio of the foot's distance to the size.
    """
    bar = abs(pin - pivot)
    return sqrt((bar - height) * (bar + height)) / pick(bar < size, size, bar)


def swing_reached(pivot: Any, pin: Any, height: Any, *_: Any) -> tuple[Any, Any]:
    """By how much a pin is far enough from a pivot for a guide at a height between them."""
    bar = abs(pin - pivot)
    return bar - height, bar + height


@action("swing", margin=swing_margin, reaches=swing_reached)
def swing(pivot: Point, pin: Point, height: Real, way: int, size: float) -> Point:
    """Direction of a guide that turns about a pivot and has a pin at a height to its left.

    The pin lies ahead of the pivot (way +1) or behind it (-1). Raises an error where the pin is
    closer to the pivot than the height.
    """
    line = pin - pivot
    bar = abs(line)
    foot = way * sqrt((bar - height) * (bar + height))
    return line / bar * (at(foot, -height) / bar)


def through_margin(pivot: Point, pin: Point, way: int, size: float) -> Real:
    """Distance of the pins as a fraction of the mechanism's size, at most 1."""
    bar = abs(pin - pivot)
    return bar / pick(bar < size, size, bar)


@action("swing-through", margin=through_margin)
def swing_through(pivot: Point, pin: Point, way: int, size: float) -> Point:
    """Direction of a guide whose line passes through both pins: from the pivot to the pin, or back.

    Raises an error where the pin is on the pivot: the direction is then undetermined.
    """
    line = way * (pin - pivot)
    return line / abs(line)


@action("middle")
def middle(p: Point, q: Point) -> Point:
    return (p + q) / 2


@action("half")
def half(p: Point, q: Point) -> Real:
    """Half the distance of two points: the radius of Thales's circle on them."""
    return abs(q - p) / 2


@action("size")
def size(height: Real) -> Real:
    """The absolute height: the radius of the circle that the guide touches."""
    return abs(height)


@action("from-foot")
def from_foot(foot: Point, pin: Point, way: int) -> Point:
    """Direction of the tangent from its foot to the pin."""
    line = way * (pin - foot)
    return line / abs(line)


# --- constructions -------------------------------------------------------------------------------


class SwungGuide(Determined, PlacesLink, frozen=True, kw_only=True):
    """A guide of a ``link`` that turns about its ``pivot`` and guides the ``pin`` of a ``block``.

    It gives its direction ``turn`` and its ``line``. Where two pins guide the link, ``ahead`` is +1
    for a ``pin`` ahead of the pivot along the guide and -1 for one behind it; otherwise it is 0.
    """

    pencil: ClassVar[Mapping[str, ByHand]] = {"turn": ByHand.TURNED}
    lines: ClassVar[Mapping[str, str]] = {"line": "the line through {pivot}"}
    between: ClassVar[tuple[str, ...]] = ("pivot", "pin")
    guided: ClassVar[str] = "block"

    link: str
    block: str
    pivot: str
    pin: str
    turn: OwnStep
    line: OwnStep
    ahead: int = 0

    def guides(self, block: str, on: str) -> bool:
        """Whether it guides a block along a link, whichever of the two has the guide."""
        return {self.block, self.link} == {block, on}

    @property
    def found_link(self) -> str:
        return self.link

    def symbols(self) -> Mapping[str, str]:
        """The symbols of both pins and of the link that turns."""
        p, q = (symbol(lettered(point)) for point in self.points)
        return {"p": p, "q": q, "k": escape(self.link)}

    def fields(self) -> Mapping[str, str]:
        """The fields of its sentence."""
        p, q = map(symbol, self.points)
        return {"p": p, "q": q, "k": escape(self.link), "bar": bar(self.pivot, self.pin)}


class GuideThroughPins(SwungGuide, frozen=True, kw_only=True):
    """A guide whose line passes through both pins."""

    reasons: ClassVar[Mapping[str, str]] = {"turn": "why.lever"}
    has_angle: ClassVar[bool] = False
    key: ClassVar[str] = "step.swing-through"
    titled: ClassVar[str] = "the line {pivot}-{pin}"

    def sentence_alone(self, drawing: Drawing, role: str) -> str:
        """The sentence that joins the pins."""
        return drawing.words(self.key, **self.fields()) if role == "turn" else ""

    def in_line(self, steps: Sequence[Step], *, nearly: bool) -> Message:
        """The words for coincident pins."""
        return message(
            "{pin} nearly falls on {pivot}" if nearly else "{pin} falls on {pivot}",
            pin=self.pin,
            pivot=self.pivot,
        )

    def undetermined(self, args: Sequence[Any]) -> Problem:
        """The problem of a pin that coincides with the pivot."""
        p, q = self.pivot, self.pin
        return Problem(
            message("position of link {link}", link=self.link),
            message(
                "{q} falls on {p}, so that the guide through both may have any direction", q=q, p=p
            ),
            message("{p} and {q} apart", p=q, q=p),
            message("move the driver, or give the guide an offset from {p}", p=p),
            about=(Sought((self.link,)),),
        )

    def at_end(self, steps: Sequence[Step], loci: Sequence[Any]) -> tuple[str, str]:
        """The link, and the coincident pins at the end of its range."""
        return f"link {self.link}", f"{self.pin} on {self.pivot}"


class LineOfPins(GuideThroughPins, frozen=True, kw_only=True):
    """A line through two pins in parallel guides of a link, which both guide the link along it."""

    key: ClassVar[str] = "step.pins-guide"


class TangentGuide(SwungGuide, frozen=True, kw_only=True):
    """A guide with the pin at a ``height`` to its left: a tangent of a circle about its pivot.

    By hand, the ``small`` circle has the height as its radius and the ``large`` one is Thales's
    circle on both pins. They meet in the ``foot`` of the ``tangent``.
    """

    pencil: ClassVar[Mapping[str, ByHand]] = dict.fromkeys(("tangent", "turn"), ByHand.TURNED)
    corners: ClassVar[frozenset[str]] = frozenset({"foot"})
    lines: ClassVar[Mapping[str, str]] = {
        **SwungGuide.lines,
        **dict.fromkeys(("small", "large"), "the arc {pivot}{pin} about {pivot}"),
    }
    laid_at: ClassVar[str] = "large"

    height: int
    small: OwnStep | None = None
    large: OwnStep | None = None
    foot: OwnStep | None = None
    tangent: OwnStep | None = None

    def laid_length(self, role: str) -> LaidLength | None:
        """Half the distance of the pins, the radius of Thales's circle."""
        whole = super().laid_length(role)
        return replace(whole, half=True) if whole is not None else None

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the parts of both circles that find the foot."""
        if role in ("small", "large"):
            canvas.arc(self.pivot + self.pin)

    def sentence_alone(self, drawing: Drawing, role: str) -> str:
        """The sentence, by Thales's circle where it is drawn."""
        if role != "turn":
            return ""
        if self.tangent not in drawing.trace.values:
            return drawing.words("step.swing-through", **self.fields())
        radius = drawn_amount(drawing, abs(float(drawing.trace.values[self.height])))
        return drawing.words("step.swing", radius=radius, **self.fields())

    def in_line(self, steps: Sequence[Step], *, nearly: bool) -> Message:
        """The line of the pins and the guide."""
        return message(
            "{bar} is nearly square to the guide of {block}"
            if nearly
            else "{bar} is square to the guide of {block}",
            bar=f"{self.pivot}{self.pin}",
            block=self.block,
        )

    def failing(self) -> Message:
        """The words for a pin within the circle that the guide touches."""
        return message(
            "{pin} is nearer to {pivot} than the guide passes it", pin=self.pin, pivot=self.pivot
        )


# --- drawing -------------------------------------------------------------------------------------


def swing_guide(pen: Pen, group: Dyad) -> None:
    """Draw a dyad RPR: the guide through one pin and, at its height, the other; set the axes."""
    assert isinstance(group.left, Pin) and isinstance(group.right, Pin)
    assert isinstance(group.inner, Sliding)
    first, second = group.links
    block, carrier = group.inner.links
    pins = {first: group.left.point, second: group.right.point}
    height = height_of(pen, group.inner, pins)
    own = {"link": carrier, "block": block, "pivot": pins[carrier], "pin": pins[block]}
    turn, _ = lay_guide(pen, group, height, own)
    _, along = local_line(pen, group.inner.slide, carrier)
    with pen.on(Part.POSITION, Plane.NUMBERS):
        pen.want("axis", carrier, pen.draw(axis_by_guide, turn, pen.given("origin"), along))
        pen.want("axis", block, turn)
    pen.want("position", pen.bases[carrier].end or "", pen.the("position", pins[block]))


def guide_by_pins(pen: Pen, group: OnTwoPins) -> None:
    """Draw a link that two blocks guide by their pins: its line, and what slides along it."""
    (block, start), (pin, pivot) = group.inner.links, group.inner.pins
    ahead, behind = group.inner.slides
    own: dict[str, Any] = {"link": group.rail, "block": block, "pivot": pivot, "pin": pin}
    own["ahead"] = way_of(pen.scene, group)
    turn, line = lay_guide(pen, group, height_between(pen, group.inner), own)
    _, along = local_line(pen, group.inner.slide, start)
    with pen.on(Part.POSITION, Plane.NUMBERS):
        pen.want("axis", start, pen.draw(axis_by_guide, turn, pen.given("origin"), along))
    turned_with(pen, behind, start)
    turned_with(pen, ahead, group.rail)
    if is_through(pen, behind, pivot):
        pen.shared["guide", *behind.links] = line
    end = pen.bases[start].end
    if end is not None:
        pen.want("position", end, pen.the("position", pin))


def lay_guide(pen: Pen, group: Dyad, height: int | None, own: Mapping[str, Any]) -> tuple[int, int]:
    """Draw the direction and the line of a guide from its ``pivot`` and ``pin``, already placed."""
    places = [pen.the("position", own[end]) for end in ("pivot", "pin")]
    way, extra = pen.choice(group)
    sized = (*extra, breadth_about(pen, places[0]))
    with pen.on(Part.POSITION, Plane.MECHANISM):
        by_hand: dict[str, Any] = {}
        if height is None:
            turn = pen.draw(swing_through, *places, *way, extra=sized)
        else:
            by_hand = {} if way else tangent(pen, places, height, extra[0])
            last = by_hand.get("tangent")
            turn = pen.draw(swing, *places, height, *way, extra=sized, by_hand=last)
        line = pen.draw_shared(("swing", group.inner.links[1]), ray, places[0], turn)
    if height is None:
        through = LineOfPins if isinstance(group, OnTwoPins) else GuideThroughPins
        pen.make(through(**own, turn=turn, line=line))
    else:
        pen.make(TangentGuide(**own, turn=turn, line=line, height=height, **by_hand))
    return turn, line


def breadth_about(pen: Pen, pivot: int) -> float:
    """The largest distance of a placed point from a pivot; zero if none is known."""
    start = pen.peek(pivot)
    positions = [number for (what, _), number in pen.targets.items() if what == "position"]
    places = [pen.peek(number) for number in positions]
    if start is None:
        return 0.0
    return max((abs(place - start) for place in places if place is not None), default=0.0)


def tangent(pen: Pen, places: list[int], height: int, way: int) -> dict[str, int]:
    """Draw the tangent to a circle, by Thales's circle, as a hand finds an offset guide."""
    value = pen.peek(height)
    if not value:
        return {}
    pivot, pin = places
    with pen.hands_way():
        small = pen.draw(compass, pivot, pen.draw(size, height))
        large = pen.draw(compass, pen.draw(middle, pivot, pin), pen.draw(half, pivot, pin))
        foot = pen.draw(arcs_meet, small, large, extra=(1 if value * way > 0 else -1,))
        last = pen.draw(from_foot, foot, pin, extra=(way,))
    return {"small": small, "large": large, "foot": foot, "tangent": last}
