"""The force between two links that slide along each other: normal to their guide, by moments."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.naming import way_of
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.relation import figure
from graphkin.construction.core.vocabulary import action
from graphkin.construction.forces.moments import (
    SEEN,
    ForceByMoments,
    Moments,
    arm,
    line_arm,
    moment_sum,
)
from graphkin.drawing.symbol_markup import escape, symbol
from graphkin.numbers.arithmetic import Point
from graphkin.numbers.plane import Line, cross


@action("pressure-arm")
def pressure_arm(about: Point, place: Point, guide: Line) -> Point:
    """The foot of the perpendicular from a pin to the normal of a guide at a place."""
    return arm.value(about, place, 1j * guide.along)


@action("slide-pressure")
def slide_pressure(far: Point, foot: Point, guide: Line, near: Point, *rest: Any) -> Point:
    """The force of a guide that balances the moments of both its links.

    ``foot`` is the foot of ``far`` on the normal through ``near``. The inputs of the moments of the
    link at far come first, then those of the link at near. The numbers of pairs of both follow, and
    last the number of inputs of the first.
    """
    *terms, pairs, others, first = rest
    normal = 1j * guide.along / abs(guide.along)
    total = moment_sum(far, (*terms[: int(first)], pairs))
    total = total + moment_sum(near, (*terms[int(first) :], others))
    return total / cross(foot - far, normal) * normal


class SlidePressure(ForceByMoments, frozen=True, kw_only=True):
    """The force ``name`` on the link at ``near`` from the ``link`` at ``far``, normal to a guide.

    ``moments`` are those of the link at far about its pin, ``others`` those of the link at near.
    """

    gives: ClassVar[tuple[str, ...]] = ("foot", "force")
    reasons: ClassVar[Mapping[str, str]] = {"force": "why.force_pressure"}
    none: ClassVar[str] = "step.force-pressure-none"

    number: str
    link: str
    block: str
    others: Moments
    foot: int

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the arm of the force about the far pin."""
        if role != "foot":
            return
        far, near, foot = map(canvas.value, (self.moments.about, self.others.about, self.foot))
        if canvas.size(foot - far) <= SEEN:
            return
        line_arm(canvas, (self.name, self.number), far, near, foot)

    def sentence_key(self, drawing: Drawing) -> str:
        both = self.others.shown(drawing)
        return "step.force-pressure-both" if both else "step.force-pressure"

    def fields(self, drawing: Drawing) -> Mapping[str, str]:
        """The link, both pins, the arm and the guide."""
        return {
            **super().fields(drawing),
            "k": escape(self.link),
            "far": symbol(self.moments.letter),
            "near": symbol(self.others.letter),
            "h": symbol(self.number),
            "guide": way_of(drawing, self.block),
        }

    def arm(self, drawing: Drawing) -> Sequence[tuple[str, str]]:
        """The distance of the normal from the far pin."""
        foot, far = (drawing.trace.values[n] for n in (self.foot, self.moments.about))
        return [(symbol(self.number), figure(drawing, drawing.on_paper(abs(foot - far))))]


def pressure(
    pen: Pen,
    name: str,
    number: str,
    names: tuple[str, str],
    guide: int,
    own: Moments,
    others: Moments,
) -> int:
    """The force of a guide on the near link; ``names`` are the far link and the block."""
    link, block = names
    with pen.on(Part.FORCE, Plane.MECHANISM):
        foot = pen.draw(pressure_arm, own.about, others.about, guide)
    first, second = own.steps, others.steps
    with pen.on(Part.FORCE, Plane.NUMBERS):
        force = pen.draw(
            slide_pressure,
            *(own.about, foot, guide, others.about),
            *first,
            *second,
            extra=(*own.extra, *others.extra, float(len(first))),
        )
    found = SlidePressure(
        name=name,
        number=number,
        link=link,
        block=block,
        moments=own,
        others=others,
        foot=foot,
        force=force,
    )
    return pen.make(found).force
