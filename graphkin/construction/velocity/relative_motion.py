"""The motion of one point about another or along a guide, in both plans.

The image of a point lies on a line through the image of a known point. The line is perpendicular to
a bar, which keeps its length, or parallel to a guide, along which the slide moves.

Known rates give the velocity and the acceleration of a turning pin themselves.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from typing import ClassVar

from graphkin.construction.core.component import (
    LaidOff,
    component_ending_at,
    end_before,
    index_before,
)
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import (
    ByHand,
    Canvas,
    Construction,
    EndsComponent,
    FindsImage,
    GivenVector,
    GivesRate,
    Run,
    auxiliary_plan,
    construction,
)
from graphkin.construction.core.naming import (
    driver_of_rate,
    has_no_length,
    is_driven,
    laid_off_words,
    length_drawn,
    letter_at,
    rate_symbol,
    turning_with,
    vector_of,
    way_of,
)
from graphkin.construction.core.palette import (
    LAYS_OFF,
    PARALLEL,
    PERPENDICULAR,
    ErrorPicks,
    KnownError,
    Move,
    point_and_bar,
    two,
)
from graphkin.construction.core.pen import Pen, about, against, component_arrow, image, letter
from graphkin.construction.core.program import OwnStep, Plane, Step
from graphkin.construction.core.quantities import EPSILON, OMEGA
from graphkin.construction.core.relation import (
    Relation,
    Term,
    VectorEquation,
    answer,
    figure,
    length_of,
)
from graphkin.construction.core.vocabulary import action, difference, speed_at_rim, sum_of
from graphkin.drawing.symbol_markup import bar, escape, symbol
from graphkin.numbers.arithmetic import Point, Real
from graphkin.numbers.plane import Line
from graphkin.scene.link_points import ends_of, is_under, lettered, under
from graphkin.structure.pairs import is_in_scene
from graphkin.text import EQUALS, NOTHING


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


# --- vectors from known rates ---------------------------------------------------------------------


class LaidOffByRate(Construction, frozen=True):
    """A vector that a rate gives, or two that follow from both rates of one link.

    ``move`` is how a student draws each of its ends.
    """

    move: ClassVar[Move] = LAYS_OFF

    @abstractmethod
    def tried_rate(self, role: str) -> int | None:
        """The rate with which an auxiliary plan lays off a role's vector; None for other roles."""

    @abstractmethod
    def fields(self, drawing: Drawing, role: str) -> dict[str, str]:
        """The words and lengths for a sentence about the vector that ends in a role."""


class LaidOffAboutPivot(AboutPivot, LaidOffByRate, frozen=True, kw_only=True):
    """Vectors of a pin about a pivot by the rates of their ``link``."""

    link: str

    def is_of_driver(self, drawing: Drawing, rate: int) -> bool:
        """Whether the rate belongs to a crank on the frame, which has relations of its own."""
        driver = driver_of_rate(drawing, rate)
        if driver is None or self.p not in drawing.scene.frame.points:
            return False
        return self.link in (driver.link, driver.against)

    def by_turning(self, drawing: Drawing, rate: int, sign: str) -> Relation:
        """The vector from a known rate: rate times bar, or rate squared times bar inwards."""
        value = drawing.rate_size(rate, "acceleration" if sign == "τ" else "velocity")
        length = length_of(drawing, self.p, self.q)
        square, letter = "^2" if sign == "ν" else "", "ε" if sign == "τ" else "ω"
        size = value * value * length if square else value * length
        remark: str = drawing.words("calculation.square_to", bar=self.bar)
        driver = driver_of_rate(drawing, rate)
        if driver is not None and self.link not in ("", driver.link, driver.against):
            own = drawing.symbol(f"{letter}_{self.link}")
            remark = drawing.words.clauses(
                (remark, f"{own} = {rate_symbol(drawing, rate, letter)}")
            )
        if square:
            remark = laid_off_words(drawing, "laid_off", size, p=symbol(self.p), q=symbol(self.q))
        return Relation(
            drawing.symbol(f"{drawing.vector.letter}_{self.index}{signed(sign)}"),
            f"{rate_symbol(drawing, rate, letter)}{square}·{self.bar}",
            f"{figure(drawing, value, 6)}{square}·{figure(drawing, length)}",
            answer(drawing, size),
            drawing.vector.caret_unit,
            remark,
            over=((self.p, self.q),),
        )


def signed(sign: str) -> str:
    """The sign of a component as written in a symbol."""
    return f"^{sign}" if sign else ""


def by_bar(drawing: Drawing, rate: int, fields: dict[str, str]) -> str:
    """The key for the length of a driven pin's vector: by its bar, or in mm.

    In mm also where a page keeps the scale while the rate changes. Adds to ``fields`` the ratio of
    that length to the bar.
    """
    by_scale = is_driven(drawing, rate) and drawing.lengths == "drawn"
    times = drawing.scales.of_bar(drawing.kind) if by_scale else 0.0
    fields["m"] = figure(drawing, times)
    return {0.0: "-scaled", 1.0: ""}.get(times, "-times")


def falls_key(drawing: Drawing, number: int, start: str) -> str:
    """The key of the sentence for an image at the ``start`` of its vector, whose rate is zero.

    In an auxiliary plan, which tries the rate, the sentence does not mention it.
    """
    if not start:
        return "step.falls-end"
    return "step.falls" if number in drawing.auxiliary else "step.falls-zero"


def falls_here(drawing: Drawing, fields: Mapping[str, str]) -> str:
    """The sentence for an image at the start of its vector at a page's position of the driver."""
    return drawing.words("step.falls" if fields["s"] else "step.falls-end", **fields)


def rate_words(drawing: Drawing, number: int, rate: int, link: str, letter: str) -> str:
    """The rate by which a step lays off a vector, as words; a tried rate is named by its link."""
    plan = auxiliary_plan(drawing, number)
    if plan is not None and link:
        own, lead = drawing.symbol(f"{letter}_{link}"), turning_with(drawing, plan.turned_by(rate))
        if lead not in ("", turning_with(drawing, link)):
            return f"{own} = {drawing.symbol(f'{letter}_{lead}')}"
        if lead or drawing.trace.program.steps[rate].name not in drawing.scene.links:
            return own
    return rate_symbol(drawing, rate, letter) + source_of_rate(drawing, number, rate)


def source_of_rate(drawing: Drawing, number: int, rate: int) -> str:
    """The source of a rate in this plan, where the rate is used for the first time."""
    steps = drawing.trace.program.steps
    kind, action = construction(steps[rate]), steps[number].action
    first = next(user for user in drawing.children[rate] if steps[user].action is action)
    return kind.source_of_rate(drawing) if isinstance(kind, GivesRate) and first == number else ""


@action("turned-velocity")
def turned_velocity(start: Point, pivot: Point, pin: Point, omega: Real) -> Point:
    """The image of a pin turning about a pivot: omega times the bar, turned 90° (Galileo)."""
    return start + 1j * (pin - pivot) * omega


class TurnedVelocity(LaidOffAboutPivot, GivenVector, frozen=True, kw_only=True):
    """ω·l laid off in the velocity plan, from the image ``start`` of a pivot to the pin's image.

    ``omega`` is the angular velocity of their ``link``.
    """

    reasons: ClassVar[Mapping[str, str]] = {"image": "why.turned"}
    pencil: ClassVar[Mapping[str, ByHand]] = {"image": ByHand.LAID_OFF}
    lines_before: ClassVar[tuple[str, ...]] = ("start",)
    imaged: ClassVar[frozenset[str]] = frozenset({"image"})

    start: int
    omega: int
    image: OwnStep

    def tried_rate(self, role: str) -> int:
        """The angular velocity."""
        return self.omega

    def fields(self, drawing: Drawing, role: str) -> dict[str, str]:
        """Its ends, its bar, its rate and its drawn length."""
        default = symbol(f"v_{self.index}")
        return {
            **self.symbols(),
            "s": drawing.lettered(self.start),
            "name": drawing.lettered(self.image),
            "vector": vector_of(drawing, self.start, self.image, default),
            "omega": rate_words(drawing, self.image, self.omega, self.link, "ω"),
            "rate": rate_symbol(drawing, self.omega),
            "drawn": length_drawn(drawing, self.start, self.image),
        }

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence on how it is laid off: as long as the bar if the driver sets the scale."""
        fields = self.fields(drawing, role)
        if has_no_length(drawing, self.image):
            return drawing.words(falls_key(drawing, self.image, fields["s"]), **fields)
        if drawing.lengths == "none":
            return falls_here(drawing, fields)
        return drawing.words(f"step.turned-velocity{by_bar(drawing, self.omega, fields)}", **fields)

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """Euler's theorem, and its magnitude; a driver's crank has relations of its own."""
        if not self.is_of_driver(drawing, self.omega):
            yield self.euler(drawing, omega=rate_symbol(drawing, self.omega, link=self.link))
            if self.image not in drawing.auxiliary:
                yield self.by_turning(drawing, self.omega, "")

    def errors(self, picks: ErrorPicks, steps: Sequence[Step]) -> Iterator[KnownError]:
        """A line along the bar."""
        start, pivot, pin, _ = steps[self.image].args
        inputs = picks.point_or_line(start), picks.bar(pivot, pin)
        yield KnownError("turn.wrong.along_bar", self.image, PARALLEL, inputs)

    def known_by(self, drawing: Drawing) -> str:
        """Perpendicular to its bar, by the rate of a driver; empty for other links."""
        rate = rate_symbol(drawing, self.omega)
        driven = self.is_of_driver(drawing, self.omega)
        return f"⊥ {self.bar}, {rate}·{self.bar}" if driven else ""

    def rate_taken(self, drawing: Drawing, role: str) -> str:
        return rate_symbol(drawing, self.omega)


def turned_velocity_image(
    pen: Pen, link: str, points: tuple[str, str], start: int, *, name: str
) -> int:
    """The image of the second of two ``points`` of a turning link, from the first one's image.

    ``start`` is the image of the first point.
    """
    pivot, pin = points
    places = pen.the("position", pivot), pen.the("position", pin)
    rate = pen.the(OMEGA, link)
    image = pen.draw(turned_velocity, start, *places, rate, name=name)
    p, q = map(letter, points)
    names = {"p": p, "q": q, "index": against(pen, pin, pivot), "whole": q, "base": p}
    pen.make(TurnedVelocity(**names, link=link, start=start, omega=rate, image=image))
    return image


@action("centripetal")
def centripetal(start: Point, pivot: Point, pin: Point, omega: Real) -> Point:
    """The end of the centripetal component of a bar: omega squared times the bar."""
    return start + omega * omega * (pivot - pin)


@action("driven-tangential")
def driven_tangential(start: Point, pivot: Point, pin: Point, epsilon: Real) -> Point:
    """The end of the tangential component of a bar: epsilon times the bar, turned 90°."""
    return start + 1j * (pin - pivot) * epsilon


class TurnedAcceleration(LaidOffAboutPivot, GivenVector, EndsComponent, frozen=True, kw_only=True):
    """ω²·l and ε·l laid off in the acceleration plan from the image ``start`` of a pivot.

    The centripetal component ends in ``end``. The tangential component leads from there to the
    pin's ``image``. Where the ``link`` turns at a constant rate, there is none, and ``end`` is the
    pin's image.
    """

    reasons: ClassVar[Mapping[str, str]] = {"end": "why.normal", "image": "why.driven_tangential"}
    pencil: ClassVar[Mapping[str, ByHand]] = dict.fromkeys(("end", "image"), ByHand.LAID_OFF)
    imaged: ClassVar[frozenset[str]] = frozenset({"end", "image"})

    start: int
    omega: int
    epsilon: int | None
    end: OwnStep
    image: OwnStep | None

    @property
    def is_steady(self) -> bool:
        return self.image is None

    def tried_rate(self, role: str) -> int | None:
        """The angular acceleration for the tangential component; otherwise None."""
        return self.epsilon if role == "image" else None

    def index_at(self, role: str) -> str:
        return self.index

    def errors(self, picks: ErrorPicks, steps: Sequence[Step]) -> Iterator[KnownError]:
        """A line without the normal component."""
        start, pivot, pin, *_ = steps[self.end].args
        inputs = picks.point_or_line(start), picks.bar(pivot, pin)
        yield KnownError("turn.wrong.normal_forgotten", self.end, PERPENDICULAR, inputs)

    # --- its sentences ---------------------------------------------------------------------------

    def said_before(self, drawing: Drawing, role: str) -> tuple[int, ...]:
        """The centripetal component before the tangential one."""
        if role == "image":
            return (self.end,)
        return (self.start,) if self.is_steady else ()

    def fields(self, drawing: Drawing, role: str) -> dict[str, str]:
        """Ends, bar, rate and drawn length of one of the two components."""
        steps = drawing.trace.program.steps
        names = {**self.symbols(), "s": drawing.lettered(self.start)}
        if role == "end":
            whole = self.is_steady and steps[self.start].name == drawing.pole
            rate = rate_symbol(drawing, self.omega)
            return {
                **names,
                "name": drawing.lettered(self.end),
                "vector": drawing.symbol(f"a_{self.index}" + ("" if whole else "^ν")),
                "omega": rate,
                "rate": rate,
                "drawn": length_drawn(drawing, self.start, self.end),
            }
        assert self.image is not None and self.epsilon is not None
        return {
            **names,
            "name": drawing.lettered(self.image),
            "vector": drawing.symbol(f"a_{self.index}^τ"),
            "epsilon": rate_words(drawing, self.image, self.epsilon, self.link, "ε"),
            "drawn": length_drawn(drawing, self.end, self.image),
        }

    def clause(self, drawing: Drawing, role: str) -> str:
        """The clause for the centripetal component by its value, before the tangential one."""
        if role == "image" or self.is_steady:
            return ""
        key = "none" if has_no_length(drawing, self.end) else "computed"
        fields = self.fields(drawing, role)
        if foot := drawing.symbol(letter_at(drawing, self.end)) if key == "computed" else "":
            fields["vector"] = EQUALS.join((NOTHING.join((fields["s"], foot)), fields["vector"]))
        return drawing.words(f"step.lay-off-{key}", **fields)

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence on how the component that ends in the pin's image is laid off."""
        fields = self.fields(drawing, role)
        if role == "end":
            if has_no_length(drawing, self.end):
                return drawing.words(falls_key(drawing, self.end, fields["s"]), **fields)
            if drawing.lengths == "none":
                return falls_here(drawing, fields)
            key = by_bar(drawing, self.omega, fields)
            if key == "-scaled" and not self.is_of_driver(drawing, self.omega):
                fields["vector"] += f" = {fields['omega']}^2·{self.bar}"
            return drawing.words(f"step.centripetal{key}", **fields)
        assert self.image is not None
        alone = has_no_length(drawing, self.end)
        if not alone:
            fields["s"] = drawing.symbol(letter_at(drawing, self.end))
        if has_no_length(drawing, self.image):
            key = "falls" if fields["s"] else "falls-end"
        else:
            key = "driven-tangential-only" if alone or fields["s"] else "driven-tangential"
        return drawing.words(f"step.{key}", **fields)

    # --- marks and relations ---------------------------------------------------------------------

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """Euler's theorem, and both magnitudes; a driver's crank has relations of its own."""
        if role == "end":
            driven = self.is_of_driver(drawing, self.omega)
            if not (driven and self.is_steady):
                omega = rate_symbol(drawing, self.omega, link=self.link)
                spin = ""
                if self.epsilon is not None:
                    spin = rate_symbol(drawing, self.epsilon, "ε", self.link)
                yield self.euler(drawing, omega=omega, epsilon=spin, steady=self.is_steady)
            if not driven:
                yield self.by_turning(drawing, self.omega, "ν")
            return
        assert self.epsilon is not None
        if self.image not in drawing.auxiliary and not self.is_of_driver(drawing, self.epsilon):
            yield self.by_turning(drawing, self.epsilon, "τ")

    def known_by(self, drawing: Drawing) -> str:
        """Along its bar, where a driver's rate is constant; empty otherwise."""
        if not (self.is_steady and self.is_of_driver(drawing, self.omega)):
            return ""
        inward = f"{symbol(self.q)}→{symbol(self.p)}"
        return f"{inward}, {rate_symbol(drawing, self.omega)}^2·{self.bar}"

    def rate_taken(self, drawing: Drawing, role: str) -> str:
        """The angular acceleration; empty for the centripetal component."""
        if role == "end" or self.epsilon is None:
            return ""
        return rate_symbol(drawing, self.epsilon, "ε")


# --- writing its steps ---------------------------------------------------------------------------


def turned_acceleration_image(
    pen: Pen, link: str, points: tuple[str, str], start: int, *, name: str, steady: bool
) -> int:
    """The acceleration image of the second of two ``points`` of a link with known rates.

    ``start`` is the image of the first point. Both components have arrows, except a single
    component that is the whole acceleration.
    """
    pivot, pin = points
    places = pen.the("position", pivot), pen.the("position", pin)
    omega = pen.the(OMEGA, link)
    with pen.calls_for("normal components"):
        end = pen.draw(centripetal, start, *places, omega, name=name if steady else "")
    if not steady or start != pen.pole(Plane.ACCELERATIONS):
        component_arrow(pen, start, end, "ν", pin, pivot)
    epsilon, image = None, None
    if not steady:
        epsilon = pen.the(EPSILON, link)
        with pen.calls_for(
            "driver acceleration" if accelerated(pen, epsilon) else "tangential components"
        ):
            image = pen.draw(driven_tangential, end, *places, epsilon, name=name)
        component_arrow(pen, end, image, "τ", pin, pivot)
    pen.make(
        TurnedAcceleration(
            p=letter(pivot),
            q=letter(pin),
            index=about(pen, pin, pivot),
            whole=lettered(pin),
            base=lettered(pivot),
            link=link,
            start=start,
            omega=omega,
            epsilon=epsilon,
            end=end,
            image=image,
        )
    )
    return end if image is None else image


def accelerated(pen: Pen, rate: int) -> bool:
    """Whether a rate is a driver's acceleration, alone or in a sum, that is not zero."""
    step = pen.steps[rate]
    if step.given is not None:
        given = {drive.acceleration for drive in pen.drives.values()}
        return rate in given and not pen.is_zero(rate)
    passed_on = step.action in (sum_of, difference, speed_at_rim)
    return passed_on and any(accelerated(pen, arg) for arg in step.args)
