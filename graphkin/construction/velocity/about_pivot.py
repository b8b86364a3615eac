"""The motion of one point about another: what lines and vectors of both plans have in common."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from graphkin.construction.core.kind import Construction
from graphkin.construction.core.relation import Relation
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

    def euler(self, drawing: Drawing, *, steady: bool = False) -> Relation:
        """Euler's theorem for the motion of a pin about another, or about a fixed pivot.

        What turns ``steady`` gives no tangential component.
        """
        letter, fixed = drawing.vector.letter, self.index == self.whole
        key = f"{'about' if fixed else 'euler'}_{drawing.kind}"
        fields = {
            **self.symbols(),
            "whole": symbol(f"{letter}_{self.whole}"),
            "start": symbol(f"{letter}_{self.base}"),
            "relative": symbol(f"v_{self.index}"),
            "normal": symbol(f"a_{self.index}^ν"),
            "tangential": symbol(f"a_{self.index}^τ"),
        }
        return Relation(drawing.words(f"calculation.{'euler_steady' if steady else key}", **fields))
