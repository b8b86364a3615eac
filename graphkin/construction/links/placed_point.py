"""Points of links that are turned to their axes already, such as those of wheels."""

from __future__ import annotations

from cmath import phase
from collections.abc import Mapping
from math import degrees
from typing import ClassVar

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Construction, construction
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.sentence import Sentence, together
from graphkin.construction.guides.guide_line import placed
from graphkin.drawing.symbol_markup import bar, escape, symbol

UNTURNED = 0.05
"""A wheel that has turned by less, in degrees, is drawn as at the start."""


class PlacedPoint(Construction, frozen=True, kw_only=True):
    """A ``point`` of a ``link``, laid off from its point ``start`` as the link has turned."""

    gives: ClassVar[tuple[str, ...]] = ("point",)
    reasons: ClassVar[Mapping[str, str]] = {"point": "why.placed"}
    laid_off: ClassVar[frozenset[str]] = frozenset({"point"})

    link: str
    start: str
    name: str
    point: int

    @property
    def points(self) -> tuple[str, ...]:
        """From which point it is laid off, and itself."""
        return self.start, self.name

    def turned(self, drawing: Drawing) -> float | None:
        """By how many degrees the link has turned since the start; None where it is not said."""
        targets, values = drawing.trace.program.targets, drawing.trace.values
        ends = [targets.get((what, self.link), -1) for what in ("turned", "turned from")]
        if not all(number in values for number in ends):
            return None
        now, start = (float(values[number]) for number in ends)
        return degrees(now - start)

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """By its distance, and its direction in the plane."""
        words, spot = drawing.words, drawing.standing.spot
        fields = {
            "name": symbol(self.name),
            "p": symbol(self.start),
            "g": escape(self.link),
            "bar": bar(self.start, self.name),
            "angle": words.fixed(degrees(phase(spot(self.name) - spot(self.start))), 1),
        }
        turned = self.turned(drawing)
        if self.link in drawing.scene.unseen:
            wheel, _ = drawing.scene.keepers[self.link]
            return words("step.beside-led", **fields | {"g": escape(wheel)})
        if drawing.scene.links[self.link].slides:
            return words("step.beside", **fields)
        if turned is None:
            return words("step.beside-turned", **fields)
        return words("step.beside-rolled", turned=words.fixed(turned, 1), **fields)


def with_starts_together(drawing: Drawing, found: list[Sentence]) -> list[Sentence]:
    """The points of each wheel that stands as at the start said in one sentence: as given."""
    steps = drawing.trace.program.steps
    alike: dict[tuple[str, str], list[Sentence]] = {}
    for said in found:
        kind = construction(steps[said.step]) if said.step >= 0 else None
        if isinstance(kind, PlacedPoint):
            turned = kind.turned(drawing)
            if turned is not None and abs(turned) < UNTURNED:
                alike.setdefault((kind.link, kind.start), []).append(said)
    for (link, start), some in alike.items():
        names = drawing.words("list_mark").join(symbol(steps[said.step].name) for said in some)
        fields = {"g": escape(link), "p": symbol(start), "list": names}
        found = together(found, some, drawing.words("step.beside-start", **fields))
    return found


def place_point(pen: Pen, link: str, ends: tuple[str, str], *values: int) -> int:
    """A point of a link laid off from another: ``ends`` are both, ``values`` those of the step."""
    start, name = ends
    point = pen.draw(placed, *values, name=name)
    pen.make(PlacedPoint(link=link, start=start, name=name, point=point))
    return point
