"""The motion of one point about another or along a guide, and known vectors.

Shared by the lines and vectors of both plans.
"""

from __future__ import annotations

from collections.abc import Mapping

from graphkin.construction.core.component import component_ending_at, index_before
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Construction, GivenVector, construction
from graphkin.construction.core.naming import vector_of, way_of
from graphkin.construction.core.relation import Relation, Term, VectorEquation
from graphkin.drawing.symbol_markup import bar, symbol
from graphkin.scene.link_points import ends_of, is_under, lettered, under


def known_term(drawing: Drawing, point: str) -> Term:
    """The vector of a known point, with its direction and magnitude where a driver gives them."""
    program = drawing.trace.program
    number = program.targets.get((drawing.kind, point))
    kind = construction(program.steps[number]) if number is not None else None
    note = kind.known_by(drawing) if isinstance(kind, GivenVector) else ""
    return Term(drawing.symbol(f"{drawing.vector.letter}_{point}"), 2, note)


def joined(*notes: str) -> str:
    return ", ".join(filter(None, notes))


def as_relation(equation: VectorEquation) -> Relation:
    """A relation that consists of a vector equation."""
    alone = equation.whole if not equation.sums else None
    left = f"{alone.symbol} {alone.note}" if alone else equation.markup
    return Relation(left, equation=equation)


class AboutPivot(Construction, frozen=True, kw_only=True):
    """The motion of a point ``q`` about ``p``, both with letters as in a bar.

    ``index`` is the index of the relative vectors. ``whole`` and ``base`` are the indices of the
    vectors of q and p.
    """

    p: str
    q: str
    index: str
    whole: str
    base: str

    @property
    def bar(self) -> str:
        """The bar between both points, as markup."""
        return bar(self.p, self.q)

    def symbols(self) -> Mapping[str, str]:
        """Both points and their bar."""
        return {"p": symbol(self.p), "q": symbol(self.q), "bar": self.bar}

    def euler(
        self, drawing: Drawing, *, omega: str = "", epsilon: str = "", steady: bool = False
    ) -> Relation:
        """Euler's theorem for the motion of a pin about another pin or about a fixed pivot.

        ``omega`` and ``epsilon`` are the known rates. A link with ``steady`` rotation gives no
        tangential component.
        """
        letter, fixed = drawing.vector.letter, self.index == self.whole
        whole = Term(drawing.symbol(f"{letter}_{self.whole}"))
        base = known_term(drawing, self.base)
        before = () if fixed else (base,)
        across, speed = f"⊥ {self.bar}", symbol(f"v_{self.index}")
        if drawing.kind == "velocity":
            relative = Term(speed, 1 + bool(omega), joined(across, omega and f"{omega}·{self.bar}"))
            if fixed:
                return as_relation(VectorEquation(relative))
            return as_relation(VectorEquation(whole, ((*before, relative),)))
        square = f"{omega}^2·{self.bar}" if omega else f"{speed}^2/{self.bar}"
        inward = f"{symbol(self.q)}→{symbol(self.p)}"
        terms = [Term(drawing.symbol(f"a_{self.index}^ν"), 2, joined(inward, square))]
        if not steady:
            size = epsilon and f"{epsilon}·{self.bar}"
            name = drawing.symbol(f"a_{self.index}^τ")
            terms.append(Term(name, 1 + bool(epsilon), joined(across, size)))
        return as_relation(VectorEquation(whole, ((*before, *terms),)))


class AlongGuide(Construction, frozen=True, kw_only=True):
    """The motion of a point along the guide of a block, or along a wheel's track.

    ``start`` is the end of the known part of that motion.
    """

    guide: str
    start: int

    def way(self, drawing: Drawing) -> str:
        """The guide or the track, in words."""
        return way_of(drawing, self.guide)

    def vector_along(self, drawing: Drawing, number: int) -> str:
        """The symbol of the vector along the guide, which ends in the point found."""
        tips = [number, *drawing.children.get(number, ())]
        found = (vector_of(drawing, self.start, tip) for tip in tips)
        index = index_before(drawing.trace.program, self.start)
        default = drawing.symbol(f"a_{index}^r") if index else ""
        return next((name for name in found if name), default)

    def motion_of(self, drawing: Drawing, sought: str, size: str = "") -> Relation:
        """The motion of a point along a guide, with the guide's own motion if it moves.

        Of the sliding point and the point beneath it, the point ``sought`` is unknown. ``size`` is
        the magnitude along the guide where it is given or tried.
        """
        point, beneath = self.slider(drawing, sought)
        velocity, guide = drawing.kind == "velocity", self.way(drawing)
        letter = drawing.vector.letter
        along = joined(f"∥ {guide}", size)
        if drawing.trace.program.steps[self.start].name == drawing.pole:
            name = drawing.symbol(f"{letter}_{beneath if is_under(sought) else point}")
            rests = self.rests(drawing, point) if is_under(sought) else ""
            return as_relation(VectorEquation(Term(name, 1 + bool(size), joined(along, rests))))
        unknown = Term(drawing.symbol(f"{letter}_{beneath if is_under(sought) else point}"))
        rests = self.rests(drawing, point)
        if is_under(sought):
            known_one = known_term(drawing, point)
            whole, first = Term(known_one.symbol, 2, rests or known_one.note), unknown
        else:
            whole, first = unknown, known_term(drawing, beneath)
        at_rest = first is not unknown and beneath in drawing.scene.frame.points
        terms = [] if at_rest else [first]
        laid = component_ending_at(drawing.trace.program, self.start)
        if laid is not None:
            component = laid.component
            name = drawing.symbol(f"a_{point}{beneath}^{component.sign}")
            terms.append(Term(name, 2, component.formula(drawing)))
        relative = drawing.symbol(f"{letter}_{point}{beneath}" + ("" if velocity else "^r"))
        terms.append(Term(relative, 1 + bool(size), along))
        return as_relation(VectorEquation(whole, (tuple(terms),)))

    def rests(self, drawing: Drawing, point: str) -> str:
        """The remark that a fixed point has a zero vector; empty for a moving point."""
        fixed = point in drawing.scene.frame.points
        return f"{drawing.symbol(f'{drawing.vector.letter}_{point}')} = 0" if fixed else ""

    def slider(self, drawing: Drawing, sought: str) -> tuple[str, str]:
        """The sliding point and the point beneath it on the guide, as indices of symbols."""
        point, link = ends_of(sought)
        block = drawing.scene.links[self.guide]
        if not link:
            link = block.paths[0].on if point in block.points else block.name
        return point, lettered(under(point, link))
