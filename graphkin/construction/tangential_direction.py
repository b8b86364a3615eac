"""The line on which the acceleration image of a point about a known pivot lies.

It is perpendicular to their bar, the tangential direction, and passes through the end of the known
normal component.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import ClassVar

from msgspec import Struct

from graphkin.construction.core.component import component_ending_at
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.naming import letter_at
from graphkin.construction.core.palette import PERPENDICULAR, ErrorPicks, KnownError
from graphkin.construction.core.pen import Pen, about, acceleration_arrow, component_arrow, letter
from graphkin.construction.core.program import Step
from graphkin.construction.normal_component import lay_off_normal, normal_component
from graphkin.construction.plan import ACCELERATION
from graphkin.construction.velocity.relative_motion import (
    PerpendicularThrough,
    forgotten,
    square_to,
)
from graphkin.scene.link_points import is_under, lettered
from graphkin.scene.requests import KLEIN
from graphkin.structure.pairs import Joint


class TangentialDirection(PerpendicularThrough, frozen=True, kw_only=True):
    """The ``line`` along which the tangential component of a pin about a pivot lies."""

    reasons: ClassVar[Mapping[str, str]] = {"line": "why.tangential"}
    along_bar: ClassVar[str] = "turn.wrong.tangential_along_bar"

    def clause(self, drawing: Drawing, role: str) -> str:
        """The clause: through the normal component's end, or its start if it is too short."""
        fields = {"vector": drawing.symbol(f"a_{self.index}^τ"), **self.symbols()}
        laid = component_ending_at(drawing.trace.program, self.start)
        if laid is not None and laid.is_short(drawing):
            start = drawing.lettered(laid.start)
            return drawing.words("step.square-to", s=start, **fields)
        foot = drawing.symbol(letter_at(drawing, self.start))
        return drawing.words(f"step.square-to-{'foot' if foot else 'end'}", s=foot, **fields)

    def errors(self, picks: ErrorPicks, steps: Sequence[Step]) -> Iterator[KnownError]:
        """A line without the normal component, along the bar, or from the pole."""
        if before := forgotten(picks, steps, self.start):
            _, *ends = steps[self.line].args
            key, start = before
            yield KnownError(key, self.line, PERPENDICULAR, (start, picks.bar(*ends)))
        yield from super().errors(picks, steps)


def tangential_direction(pen: Pen, pivot: str, pin: str, corner: int) -> int:
    """The perpendicular to a bar through the end of its normal component."""
    ends = pen.the("position", pivot), pen.the("position", pin)
    with pen.calls_for("tangential components"):
        line = pen.draw(square_to, corner, *ends)
    names = {
        "p": letter(pivot),
        "q": letter(pin),
        "index": about(pen, pin, pivot),
        "whole": lettered(pin),
        "base": lettered(pivot),
    }
    pen.make(TangentialDirection(**names, start=corner, line=line))
    return line


class BarAcceleration(Struct, frozen=True):
    """The line that a bar to a known ``pivot`` gives for the acceleration of a ``point``."""

    pivot: str
    point: str

    def component(self, pen: Pen, sides: list[tuple[Joint, str]] | None = None) -> int:
        """The known normal component, drawn by the method that the scene asks for in a dyad."""
        if sides is None or pen.scene.sheet.method != KLEIN:
            return normal_component(pen, self.pivot, self.point)
        from graphkin.construction.normal_component import component_in_dyad

        return component_in_dyad(pen, sides, self.pivot, self.point)

    def end(self, pen: Pen, vector: int | None) -> int:
        """The end of the known part in the plan."""
        assert vector is not None
        return lay_off_normal(pen, self.pivot, self.point, vector)

    def line(self, pen: Pen, vector: int | None) -> tuple[int, int]:
        """The known end, and the line of the rest."""
        end = self.end(pen, vector)
        return end, tangential_direction(pen, self.pivot, self.point, end)

    def rest(self, pen: Pen, end: int, found: int) -> None:
        """Draw the arrow of the rest."""
        component_arrow(pen, end, found, "τ", self.point, self.pivot)

    def finish(self, pen: Pen) -> None:
        """Draw the arrow from the pole."""
        if not is_under(self.point):
            acceleration_arrow(pen, self.point)


def known_and_free(pen: Pen, pivot: str, pin: str) -> tuple[int, int]:
    """The end of the known part of a pin's acceleration about a pivot, and the line of the rest."""
    vector = normal_component(pen, pivot, pin)
    with ACCELERATION.drawn(pen):
        end = lay_off_normal(pen, pivot, pin, vector)
        return end, tangential_direction(pen, pivot, pin, end)


def refuse_unused_method(pen: Pen) -> None:
    """Raise StructureError where the scene's method for components applies to none of them."""
    if pen.scene.sheet.method == KLEIN:
        from graphkin.construction.normal_component import refuse_unused

        refuse_unused(pen)
