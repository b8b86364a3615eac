"""The motion of one point about another: what lines and vectors of both plans have in common."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from graphkin.construction.core.kind import Construction
from graphkin.construction.core.relation import Relation
from graphkin.construction.core.vector_equation import Term, VectorEquation
from graphkin.construction.velocity.known_vector import joined, known, stated
from graphkin.drawing.symbol_markup import bar, symbol

if TYPE_CHECKING:
    from graphkin.construction.core.drawn_scene import Drawing


class AboutPivot(Construction, frozen=True, kw_only=True):
    """What follows from the motion of a point ``q`` about ``p``, both lettered as in a bar.

    ``index`` is that of the relative vectors, ``whole`` and ``base`` those of both points' own.
    """

    p: str
    q: str
    index: str
    whole: str
    base: str

    @property
    def bar(self) -> str:
        """Markup of the bar between both points."""
        return bar(self.p, self.q)

    def symbols(self) -> Mapping[str, str]:
        """Both points and their bar."""
        return {"p": symbol(self.p), "q": symbol(self.q), "bar": self.bar}

    def euler(
        self, drawing: Drawing, *, omega: str = "", epsilon: str = "", steady: bool = False
    ) -> Relation:
        """Euler's theorem for the motion of a pin about another, or about a fixed pivot.

        ``omega`` and ``epsilon`` are the rates that are known; what turns ``steady`` gives no
        tangential component.
        """
        letter, fixed = drawing.vector.letter, self.index == self.whole
        whole = Term(symbol(f"{letter}_{self.whole}"))
        base = known(drawing, self.base)
        before = () if fixed else (base,)
        across, speed = f"⊥ {self.bar}", symbol(f"v_{self.index}")
        if drawing.kind == "velocity":
            relative = Term(speed, 1 + bool(omega), joined(across, omega and f"{omega}·{self.bar}"))
            if fixed:
                return stated(VectorEquation(relative))
            return stated(VectorEquation(whole, ((*before, relative),)))
        square = f"{omega}^2·{self.bar}" if omega else f"{speed}^2/{self.bar}"
        inward = f"{symbol(self.q)}→{symbol(self.p)}"
        terms = [Term(symbol(f"a_{self.index}^ν"), 2, joined(inward, square))]
        if not steady:
            size = epsilon and f"{epsilon}·{self.bar}"
            name = symbol(f"a_{self.index}^τ")
            terms.append(Term(name, 1 + bool(epsilon), joined(across, size)))
        return stated(VectorEquation(whole, ((*before, *terms),)))
