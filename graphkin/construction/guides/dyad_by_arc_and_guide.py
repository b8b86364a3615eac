"""The pin between a bar and a link on a guide or track: the bar's arc cuts the pin's line in it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, ClassVar

from graphkin.construction.core.crossings import Determined, which_side
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import lies_along
from graphkin.construction.core.naming import nearest_side
from graphkin.construction.core.palette import CUTS
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import Step
from graphkin.construction.core.vocabulary import action
from graphkin.drawing.symbol_markup import symbol
from graphkin.numbers.arithmetic import Point
from graphkin.numbers.plane import Circle, Line, cross, line_circle_sine, line_meets_circle
from graphkin.scene.link_points import lettered
from graphkin.text.errors import Message, message


def line_reached(line: Line, circle: Circle, *_: Any) -> tuple[Any, Any]:
    """By how much a circle reaches a line from its right and from its left."""
    height = cross(line.along, circle.centre - line.point) / abs(line.along)
    return circle.radius - height, circle.radius + height


@action(
    "arc-cuts-line",
    margin=lambda line, circle, way: line_circle_sine(line, circle),
    reaches=line_reached,
    move=CUTS,
)
def arc_cuts_line(line: Line, circle: Circle, way: int) -> Point:
    """The point where an arc cuts a line: the farther one along the line (way +1) or the nearer."""
    return line_meets_circle(line, circle, way)


class DyadByArcAndGuide(Determined, frozen=True, kw_only=True):
    """The ``pin`` called ``name``, in which the ``arc`` about ``centre`` cuts the line ``path``."""

    gives: ClassVar[tuple[str, ...]] = ("pin",)
    reasons: ClassVar[Mapping[str, str]] = {"pin": "why.arc"}
    loci: ClassVar[Message] = message("the arc and the guide")
    apart: ClassVar[Message] = message("the arc misses the guide")
    has_mirror: ClassVar[bool] = True
    lines_before: ClassVar[tuple[str, ...]] = ("path", "arc")
    between: ClassVar[tuple[str, ...]] = ("centre", "name")

    name: str
    centre: str
    path: int
    arc: int
    pin: int

    def symbols(self) -> Mapping[str, str]:
        """The symbol of the arc's centre."""
        return {"p": symbol(lettered(self.centre))}

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """Where the arc cuts the line, and on which side of its centre."""
        return drawing.words("step.arc-cuts-line", **self.place(drawing))

    def point_apart(self, drawing: Drawing, role: str) -> str:
        """The same, after a separate sentence for the line and the arc."""
        return drawing.words("step.arc-cuts-line-apart", **self.place(drawing))

    def place(self, drawing: Drawing) -> Mapping[str, str]:
        """The pin's letter, and the side of the centre on which the pin lies."""
        along = drawing.trace.values[self.path].along * which_side(drawing, self.pin)
        side = drawing.words(f"page.{nearest_side(along)}")
        return {"name": symbol(self.name), "p": symbol(self.centre), "side": side}

    @property
    def reaching(self) -> Message:
        """The expected bar, long enough to reach its guide."""
        return message("a bar {bar} that reaches its guide", bar=f"{self.centre}{self.name}")

    def in_line(self, steps: Sequence[Step], *, nearly: bool) -> Message:
        """The bar and the guide."""
        return message(
            "{bar} is nearly square to {guide}" if nearly else "{bar} is square to {guide}",
            bar=f"{self.centre}{self.name}",
            guide=lies_along(steps[self.path]) or message("its guide"),
        )

    def at_end(self, steps: Sequence[Step], loci: Sequence[Any]) -> tuple[str, str] | None:
        """The pin, and the bar perpendicular to the guide at the end of its range."""
        if not loci:
            return None
        guide = lies_along(steps[self.path]) or "its guide"
        return self.name, f"{self.centre}-{self.name} square to {guide}"


def cut_line(
    pen: Pen, name: str, centre: str, loci: tuple[int, int], *way: int, sign: tuple[int, ...]
) -> int:
    """Draw the pin in which an arc cuts a line, on a stated side or a side that a step gives."""
    pin = pen.draw(arc_cuts_line, *loci, *way, name=name, extra=sign)
    pen.make(DyadByArcAndGuide(name=name, centre=centre, path=loci[0], arc=loci[1], pin=pin))
    return pin


def arcs_finding(drawing: Drawing, points: Sequence[str]) -> Iterator[DyadByArcAndGuide]:
    """The dyads whose arcs find some points on their guides."""
    for _, step, _ in drawing.on_mechanism:
        if isinstance(step.of, DyadByArcAndGuide) and step.of.name in points:
            yield step.of
