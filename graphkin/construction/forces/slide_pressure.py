"""The force between two links that slide along each other: normal to their guide, by moments."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, ClassVar

from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Construction
from graphkin.construction.core.naming import way_of
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.relation import Relation, answer, figure
from graphkin.construction.core.vocabulary import action
from graphkin.construction.forces.loads import force_amount, newtons
from graphkin.construction.forces.moments import (
    SEEN,
    Moments,
    arm,
    line_arm,
    moment_sum,
    of_moments,
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


class SlidePressure(Construction, frozen=True, kw_only=True):
    """The force ``name`` on the link at ``near`` from the ``link`` at ``far``, normal to a guide.

    ``own`` are the moments of the link at far about its pin, ``others`` those of the link at near.
    """

    gives: ClassVar[tuple[str, ...]] = ("foot", "force")
    reasons: ClassVar[Mapping[str, str]] = {"force": "why.force_pressure"}

    name: str
    number: str
    link: str
    block: str
    ends: tuple[str, str]
    own: Moments
    others: Moments
    foot: int
    force: int

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the arm of the force about the far pin."""
        if role != "foot":
            return
        far, near, foot = map(canvas.value, (self.own.about, self.others.about, self.foot))
        if canvas.size(foot - far) <= SEEN:
            return
        line_arm(canvas, (self.name, self.number), far, near, foot)

    def sentence_alone(self, drawing: Drawing, role: str) -> str:
        """The moment equation, and the size of the force."""
        if role != "force":
            return ""
        size = drawing.settled(abs(drawing.trace.values[self.force]))
        key = (
            "step.force-pressure" if not self.others.shown(drawing) else "step.force-pressure-both"
        )
        return drawing.words(
            key if size else "step.force-pressure-none",
            k=escape(self.link),
            far=symbol(self.ends[0]),
            near=symbol(self.ends[1]),
            r=symbol(self.name),
            h=symbol(self.number),
            guide=way_of(drawing, self.block),
            sum=self.sum(drawing),
            size=newtons(drawing, size),
            drawn=force_amount(drawing, size),
        )

    def sum(self, drawing: Drawing) -> str:
        """The sum of moments in symbols, positive as a whole."""
        return self.joined(drawing, figures=False)

    def joined(self, drawing: Drawing, *, figures: bool) -> str:
        """The sums of both links one after the other, in symbols or in figures."""
        both = [each for each in (self.own, self.others) if each.shown(drawing)]
        total = sum(m for each in both for _, m, _, _ in each.values(drawing))
        terms = [
            (each.figures if figures else each.symbols)(drawing, turned=total < 0) for each in both
        ]
        said = terms[0] if terms else "0"
        for more in terms[1:]:
            said += f" − {more[1:]}" if more.startswith("−") else f" + {more}"
        return said

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """The sum of moments divided by the arm."""
        values = drawing.trace.values
        size = drawing.settled(abs(values[self.force]))
        if role != "force" or not size:
            return
        length = drawing.on_paper(abs(values[self.foot] - values[self.own.about]))
        scale = self.own.in_metres(drawing) or self.others.in_metres(drawing)
        below: str = symbol(self.number)
        put = figure(drawing, length)
        if scale:
            below = f"({below}·*k*_L)"
            put = f"({put}·{figure(drawing, drawing.scales.kL / 1000)})"
        yield of_moments(
            (symbol(self.name), answer(drawing, size), "N"),
            symbol(self.ends[0]),
            (self.joined(drawing, figures=False), self.joined(drawing, figures=True)),
            (below, put),
            by=symbol(self.number),
        )


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
        ends=(own.letter, others.letter),
        own=own,
        others=others,
        foot=foot,
        force=force,
    )
    return pen.make(found).force
