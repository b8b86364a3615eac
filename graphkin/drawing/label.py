"""A label: a text that wants a place at what it names."""

from __future__ import annotations

from collections.abc import Iterable
from math import hypot

from msgspec import Struct
from msgspec.structs import replace

from graphkin.drawing.areas import Rect
from graphkin.drawing.field import XY
from graphkin.drawing.marks import CircleMark, LineMark, Mark, SharedLetter, Shown, Text, drawn_out
from graphkin.drawing.placement import Spot, Wish
from graphkin.drawing.richtext import extent

NUMBER = 2.3
"""Radius of the circle around a link's number, in mm."""
SMALL = 1.8
"""Height of the smallest lettering in mm."""
EDGE = 0.3
"""How far what stands in that circle stays from it, in mm; longer names draw it out in width."""
GAP, LED = 0.9, 3.4
"""Clear distance of a label from its subject, and of one that always has a leader, in mm."""


class Label(Struct, frozen=True):
    """A text that wants a place at a subject.

    ``ring`` puts it into a circle (a link's number), ``led`` always gives it a leader; ``spare``
    may be left out in a crowd, for the construction and the tables name it too; ``optional`` is
    drawn only where there is a place for it at once. ``letters`` are those of the points of a plan
    that it names, ``shows`` is what of a link no step draws.
    """

    markup: str
    cls: str
    subject: XY | tuple[XY, XY]
    height: float = 2.5
    name: str = ""
    step: int | None = None
    away: XY | None = None
    priority: int = 0
    radius: float = 0.0
    ring: bool = False
    led: bool = False
    spare: bool = False
    optional: bool = False
    part: int = 0
    letters: tuple[SharedLetter, ...] = ()
    shows: Shown | None = None

    def of_letters(self, letters: tuple[SharedLetter, ...]) -> Label:
        """The same for points that fall together, which share it."""
        names = " ".join(letter.name for letter in letters)
        markup = "".join(letter.joined for letter in letters)
        return replace(self, name=names, markup=markup, letters=letters)

    def size(self) -> tuple[float, float]:
        """Width and height of the label's box."""
        width, top, bottom = extent(self.markup, self.height)
        if self.ring:
            held = hypot(width, bottom - top) / 2 < NUMBER - EDGE
            return 2 * NUMBER if held else width + NUMBER, 2 * NUMBER
        return width, bottom - top

    @property
    def shrinks(self) -> bool:
        """True for a letter of the construction that may still be made smaller."""
        return self.cls == "construction" and self.height > SMALL

    @property
    def look(self) -> str:
        """The classes of its text."""
        return f"label {self.cls}".strip()

    @property
    def leader_look(self) -> str:
        """The classes of its leader."""
        return f"leader {self.cls}".strip()

    def wish(self) -> Wish:
        """The box that the label needs, and where."""
        gap = LED if self.led else GAP
        width, height = self.size()
        return Wish(
            width, height, self.subject, self.away, self.priority, gap, self.radius, self.optional
        )

    def marks(self, spot: Spot) -> Iterable[Mark]:
        """The label at its place, with its leader or circle."""
        leader = spot.leader or (self.short_leader(spot) if self.led else None)
        if leader:
            (x1, y1), (x2, y2) = leader
            own = self.leader_look, self.name, self.step, self.part, self.shows
            yield LineMark(x1, y1, x2, y2, *own)
        if self.ring:
            yield self.balloon(spot)
        yield self.text(spot)

    def balloon(self, spot: Spot) -> Mark:
        """The circle around a link's number, which is drawn out in width for a longer name."""
        width, height = self.size()
        style = f"number {self.cls}".strip()
        if width <= height:
            return CircleMark(spot.x, spot.y, NUMBER, style, self.name)
        return drawn_out(spot.x, spot.y, NUMBER, width, style)

    def text(self, spot: Spot) -> Text:
        """The label's text with the middle of its ink at a place."""
        width, top, bottom = extent(self.markup, self.height)
        x, y = spot.x - width / 2, spot.y - (top + bottom) / 2
        own = self.name, self.step, 0.0, self.part, self.letters, self.shows
        return Text(x, y, self.markup, self.look, self.height, "start", *own)

    def area(self, spot: Spot) -> Rect:
        """The box that the text's ink takes up at a place."""
        width, top, bottom = extent(self.markup, self.height)
        high = (bottom - top) / 2
        return spot.x - width / 2, spot.y - high, spot.x + width / 2, spot.y + high

    @property
    def point(self) -> XY:
        """The point that it names, where that is no segment."""
        x, y = self.subject
        assert isinstance(x, float) and isinstance(y, float)
        return x, y

    def short_leader(self, spot: Spot) -> tuple[XY, XY]:
        """From the nearest side of the label's box to the point it names."""
        return self.side(spot, *self.point)

    def side(self, spot: Spot, x: float, y: float) -> tuple[XY, XY]:
        """From the nearest side of the label's box, a little off it, to a place."""
        half_width, half_height = (side / 2 + 0.3 for side in self.size())
        near_x = min(max(x, spot.x - half_width), spot.x + half_width)
        near_y = min(max(y, spot.y - half_height), spot.y + half_height)
        return (near_x, near_y), (x, y)


def segment_of(label: Label) -> tuple[XY, XY] | None:
    """The segment that a label names; None for a point."""
    first, second = label.subject
    if isinstance(first, tuple) and isinstance(second, tuple):
        return first, second
    return None
