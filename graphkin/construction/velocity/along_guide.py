"""The motion of a point along a guide: what lines and vectors of both plans have in common."""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphkin.construction.core.component import index_before, laid_off
from graphkin.construction.core.kind import Construction
from graphkin.construction.core.naming import vector_of, way_of
from graphkin.construction.core.relation import Relation
from graphkin.construction.core.vector_equation import Term, VectorEquation
from graphkin.construction.velocity.known_vector import joined, known, stated
from graphkin.drawing.symbol_markup import symbol

if TYPE_CHECKING:
    from graphkin.construction.core.drawn_scene import Drawing


class AlongGuide(Construction, frozen=True, kw_only=True):
    """What follows from the motion of a point along the guide of a block, or a wheel's track.

    ``start`` is the end of what is known of that motion.
    """

    guide: str
    start: int

    def way(self, drawing: Drawing) -> str:
        """The guide, or the track, in words."""
        return way_of(drawing, self.guide)

    def vector_along(self, drawing: Drawing, number: int) -> str:
        """The vector along the guide: from its line's or its own beginning to the point found."""
        tips = [number, *drawing.children.get(number, ())]
        found = (vector_of(drawing, self.start, tip) for tip in tips)
        index = index_before(drawing.trace.program, self.start)
        default = symbol(f"a_{index}^r") if index else ""
        return next((name for name in found if name), default)

    def motion_of(self, drawing: Drawing, sought: str) -> Relation:
        """The motion of a point: alone where the guide stands still, else on its point's."""
        point, beneath = self.slider(drawing, sought)
        velocity, guide = drawing.kind == "velocity", self.way(drawing)
        letter = drawing.vector.letter
        if drawing.trace.program.steps[self.start].name == drawing.pole:
            name = symbol(f"{letter}_{beneath if '@' in sought else point}")
            rests = self.rests(drawing, point) if "@" in sought else ""
            return stated(VectorEquation(Term(name, 1, joined(f"∥ {guide}", rests))))
        terms = [known(drawing, beneath)]
        laid = laid_off(drawing.trace.program, self.start)
        if laid is not None:
            component = laid.component
            name = symbol(f"a_{point}{beneath}^{component.sign}")
            terms.append(Term(name, 2, component.formula(drawing)))
        relative = symbol(f"{letter}_{point}{beneath}" + ("" if velocity else "^r"))
        terms.append(Term(relative, 1, f"∥ {guide}"))
        rests = self.rests(drawing, point)
        whole = Term(symbol(f"{letter}_{point}"), 2 if rests else 0, rests)
        return stated(VectorEquation(whole, (tuple(terms),)))

    def rests(self, drawing: Drawing, point: str) -> str:
        """That a fixed point does not move; nothing of one that does."""
        fixed = point in drawing.scene.frame.points
        return f"{symbol(f'{drawing.vector.letter}_{point}')} = 0" if fixed else ""

    def slider(self, drawing: Drawing, sought: str) -> tuple[str, str]:
        """The point that slides and the one beneath it on the guide, as the index of symbols."""
        point, _, link = sought.partition("@")
        block = drawing.scene.links[self.guide]
        if not link:
            link = block.paths[0].on if point in block.points else block.name
        return point, point + ("" if link.isdigit() and point[-1].isalpha() else ",") + link
