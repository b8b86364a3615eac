"""The balance of a driven crank: the moment that keeps its motion, from moments about its pivot."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import ClassVar

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Construction
from graphkin.construction.core.naming import sense
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.relation import Relation, answer, figure
from graphkin.construction.forces.moments import Moments, balancing_moment
from graphkin.drawing.symbol_markup import escape, symbol


class BalancingMoment(Construction, frozen=True, kw_only=True):
    """The balancing moment ``name`` of a driven ``link``."""

    gives: ClassVar[tuple[str, ...]] = ("moment",)
    reasons: ClassVar[Mapping[str, str]] = {"moment": "why.force_balance"}

    name: str
    link: str
    moments: Moments
    moment: int

    def size(self, drawing: Drawing) -> float:
        """The moment in N·m, counter-clockwise positive; zero for rounding."""
        moment = float(drawing.trace.values[self.moment])
        return moment if drawing.settled(abs(moment) / drawing.reach) else 0.0

    def sentence_alone(self, drawing: Drawing, role: str) -> str:
        """The moment equation with its result and sense."""
        size = self.size(drawing)
        fields = {
            "k": escape(self.link),
            "o": symbol(self.moments.letter),
            "m": symbol(self.name),
            "size": f"{answer(drawing, abs(size))} N·m",
            "sense": sense(drawing.words, size),
            "sum": self.moments.symbols(drawing, turned=size > 0),
        }
        key = "step.force-balance-none"
        if size:
            metres = self.moments.in_metres(drawing)
            key = "step.force-balance-metres" if metres else "step.force-balance"
        return drawing.words(key, **fields)

    def symbols(self) -> Mapping[str, str]:
        """The pivot."""
        return {"o": symbol(self.moments.letter)}

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """The sum of moments, with arms in metres."""
        size = self.size(drawing)
        if not size:
            return
        scaled = not self.moments.in_metres(drawing)
        symbols = self.moments.symbols(drawing, turned=size > 0)
        put = self.moments.figures(drawing, turned=size > 0)
        k = figure(drawing, drawing.scales.kL / 1000)
        equation = f"({symbols})·*k*_L = ({put})·{k}" if scaled else f"{symbols} = {put}"
        yield Relation(
            symbol(self.name),
            f"−Σ*M*({symbol(self.moments.letter)})",
            equation,
            answer(drawing, abs(size)),
            "N·m",
            sense(drawing.words, size),
            turns=True,
        )


def balance_of(pen: Pen, name: str, link: str, moments: Moments) -> int:
    """The balancing moment of a driven crank."""
    with pen.on(Part.FORCE, Plane.NUMBERS):
        moment = pen.draw(balancing_moment, moments.about, *moments.steps, extra=moments.extra)
    return pen.make(BalancingMoment(name=name, link=link, moments=moments, moment=moment)).moment
