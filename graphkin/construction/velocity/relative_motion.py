"""The motion of one point about another or along a guide, in both plans.

The image of a point lies on a line through the image of a known point. The line is perpendicular to
a bar, which keeps its length, or parallel to a guide, along which the slide moves.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import ClassVar

from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.component import (
    LaidOff,
    component_ending_at,
    end_before,
    index_before,
)
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Construction, FindsImage, GivenVector, Run, construction
from graphkin.construction.core.naming import letter_at, vector_of, way_of
from graphkin.construction.core.palette import (
    PARALLEL,
    PERPENDICULAR,
    ErrorPicks,
    KnownError,
    Move,
    point_and_bar,
    two,
)
from graphkin.construction.core.pen import Pen, against, image, letter
from graphkin.construction.core.program import OwnStep, Plane, Step
from graphkin.construction.core.relation import Relation, Term, VectorEquation
from graphkin.construction.core.vocabulary import action
from graphkin.drawing.symbol_markup import bar, escape, symbol
from graphkin.numbers.arithmetic import Point
from graphkin.numbers.plane import Line
from graphkin.scene.link_points import ends_of, is_under, lettered, under
from graphkin.structure.pairs import is_in_scene


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


# --- lines through the image of a known point -----------------------------------------------------


@action("square-to", move=Move(PERPENDICULAR, point_and_bar))
def square_to(start: Point, p: Point, q: Point) -> Line:
    """The perpendicular to a bar through a point."""
    return Line(start, 1j * (q - p))


class PerpendicularThrough(AboutPivot, frozen=True, kw_only=True):
    """The ``line`` through the image ``start`` of a pivot on which the image of a pin lies.

    If the pivot is a contact point, ``touch`` is the name of its image.
    """

    reasons: ClassVar[Mapping[str, str]] = {"line": "why.perpendicular"}
    lines: ClassVar[Mapping[str, str]] = {"line": "⊥ {p}{q}"}
    lines_before: ClassVar[tuple[str, ...]] = ("start",)
    along_bar: ClassVar[str] = "turn.wrong.along_bar"

    start: int
    line: OwnStep
    touch: str = ""

    @property
    def runs(self) -> Run:
        """Perpendicular to the bar."""
        return Run(self.p + self.q, square=True)

    def reason(self, drawing: Drawing, role: str) -> str:
        """The key of the reason: a bar keeps its length; a pivot at rest has the pole as image."""
        at_rest = self.index == self.whole and not self.touch
        return "why.perpendicular_at_rest" if at_rest else super().reason(drawing, role)

    def clause(self, drawing: Drawing, role: str) -> str:
        """The clause with the point that the line passes through; contact points share one."""
        start = drawing.trace.program.steps[self.start].name
        key = "square-to"
        if self.touch:
            key = "square-to-both" if self.touch == start else "square-to-touch"
        fields = {"s": drawing.symbol(start), "c": symbol(self.touch), **self.symbols()}
        return drawing.words(f"step.{key}", **fields)

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the line, labelled with the bar to which it is perpendicular."""
        canvas.locus(f"⊥{self.runs.what}", f"⊥ {self.bar}")

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """Euler's theorem."""
        yield self.euler(drawing)

    def errors(self, picks: ErrorPicks, steps: Sequence[Step]) -> Iterator[KnownError]:
        """A line along the bar, and one from the pole, as if the moving pivot were at rest."""
        start, square = point_and_bar(picks, self.line, steps[self.line].args)
        yield KnownError(self.along_bar, self.line, PARALLEL, (start, square))
        yield KnownError(
            "turn.wrong.pole", self.line, PERPENDICULAR, (picks.pole_of(self.line), square)
        )


def perpendicular_through(pen: Pen, pivot: str, pin: str) -> int:
    """The perpendicular to a bar through the velocity image of one of its ends."""
    start, p, q = pen.the("velocity", pivot), letter(pivot), letter(pin)
    ends = pen.the("position", pivot), pen.the("position", pin)
    line = pen.draw(square_to, start, *ends)
    index, touch = q + ("" if p in pen.scene.frame.points else p), ""
    if not is_in_scene(pivot):
        index, touch = against(pen, pin, pivot), image(pivot)
    names = {"p": p, "q": q, "index": index, "whole": q, "base": p}
    pen.make(PerpendicularThrough(**names, start=start, line=line, touch=touch))
    return line


def forgotten(
    picks: ErrorPicks, steps: Sequence[Step], number: int
) -> tuple[str, str | None] | None:
    """The component that ends at a step as one left out: its key, and the point before it."""
    laid = construction(steps[number])
    if not isinstance(laid, LaidOff) or not laid.component.forgotten:
        return None
    return laid.component.forgotten, picks.point_or_line(laid.start)


@action("parallel-to", move=Move(PARALLEL, two, in_plan=True))
def parallel_to(start: Point, line: Line) -> Line:
    """The parallel to a line, such as a guide, through a point."""
    return Line(start, line.along)


class ParallelThrough(AlongGuide, frozen=True, kw_only=True):
    """The ``line`` on which the image of a point that slides on a guide lies."""

    lines: ClassVar[Mapping[str, str]] = {"line": "∥ guide {guide}"}
    lines_before: ClassVar[tuple[str, ...]] = ("start",)
    guided: ClassVar[str] = "guide"

    line: OwnStep

    def reason(self, drawing: Drawing, role: str) -> str:
        """The key of the reason: relative to its guide, a block only moves along the guide."""
        velocity = drawing.trace.program.steps[self.line].plane is Plane.VELOCITIES
        return "why.along" if velocity else "why.along_acceleration"

    def symbols(self) -> Mapping[str, str]:
        """The guide by its block."""
        return {"g": escape(self.guide)}

    def clause(self, drawing: Drawing, role: str) -> str:
        """The clause with the point through which the line passes, or the end of a component."""
        steps, start = drawing.trace.program.steps, end_before(drawing, self.start)
        letter, key = letter_at(drawing, start), "parallel-to"
        if letter and not steps[start].name:
            key = "parallel-to-foot"
        elif not letter:
            laid = component_ending_at(drawing.trace.program, start)
            back = laid is not None and laid.back
            key = "parallel-to-tail" if back else "parallel-to-end"
        fields = {"guide": self.way(drawing), "vector": self.vector_along(drawing, self.line)}
        return drawing.words(f"step.{key}", s=drawing.symbol(letter), **fields)

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the line, labelled with the guide to which it is parallel."""
        canvas.locus(f"∥{self.guide}", f"∥ {self.way(canvas.drawing)}")

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """The motion along the guide of the point that is found on the line."""
        if sought := self.found_on_it(drawing):
            yield self.motion_of(drawing, sought)

    def errors(self, picks: ErrorPicks, steps: Sequence[Step]) -> Iterator[KnownError]:
        """A line across the guide, and one without the known component."""
        inputs = start, guide = two(picks, self.line, steps[self.line].args)
        yield KnownError("turn.wrong.across_guide", self.line, PERPENDICULAR, inputs)
        if before := forgotten(picks, steps, self.start):
            key, start = before
            yield KnownError(key, self.line, PARALLEL, (start, guide))

    def found_on_it(self, drawing: Drawing) -> str:
        """The point whose image is found on the line; empty where there is none."""
        steps = drawing.trace.program.steps
        for child in drawing.children.get(self.line, ()):
            user = steps[drawing.results.get(child, child)]
            kind = construction(user)
            if found := kind.sought if isinstance(kind, FindsImage) else "":
                return found
        return ""


def parallel_through(pen: Pen, start: int, along: int, guide: str) -> int:
    """The parallel to a line of the mechanism, such as a guide, through a point of a plan."""
    line = pen.draw(parallel_to, start, along)
    pen.make(ParallelThrough(guide=guide, start=start, line=line))
    return line
