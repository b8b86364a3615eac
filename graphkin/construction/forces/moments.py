"""Moments of the forces on one link: arms measured on the drawing, and what balances them.

The part of a reaction across a bar follows from the moments about the bar's other pin. The place of
a guide's reaction follows from the moments about the block's pin.

The balance of a driven crank: the moment that keeps its motion, from moments about its pivot.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import chain
from typing import Any, ClassVar, NamedTuple

from msgspec import Struct

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Canvas, Construction, Slip
from graphkin.construction.core.naming import sense
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import OwnStep, Part, Plane
from graphkin.construction.core.quantities import in_mm
from graphkin.construction.core.relation import Relation, answer, figure
from graphkin.construction.core.vocabulary import Action, action
from graphkin.construction.forces.loads import (
    LinkForce,
    force_amount,
    newton_metres,
    newtons,
    signed,
)
from graphkin.drawing.symbol_markup import bar, escape, symbol
from graphkin.drawing.symbols import SQUARE
from graphkin.numbers.arithmetic import Point, Real, pick
from graphkin.numbers.plane import Line, cross, dot

NOISE = 1e-13
"""A reaction below this share of the other forces is rounding, so that it has no place."""
SEEN = 0.3
"""An arm below this, in mm, is zero on paper."""


@action("arm")
def arm(about: Point, place: Point, force: Point) -> Point:
    """The foot of the perpendicular from a point to the line of action of a force."""
    square = dot(force, force)
    along = dot(about - place, force) / pick(square == 0, 1.0, square)
    return place + along * force


def moment_sum(about: Point, rest: Sequence[Any]) -> Real:
    """The moments about a point: pairs of a foot and a force, then couples, then their number."""
    pairs, couples = pairs_and_couples(rest)
    total: Any = 0.0
    for moment in chain((cross(foot - about, force) for foot, force in pairs), couples):
        total = total + moment
    return total


def pairs_and_couples(rest: Sequence[Any]) -> tuple[list[tuple[Any, Any]], list[Any]]:
    """Pairs of a foot and a force, and couples; the number of pairs comes last."""
    *terms, count = rest
    end = 2 * int(count)
    return [*zip(terms[:end:2], terms[1:end:2], strict=True)], terms[end:]


@action("tangential-part")
def tangential_part(outer: Point, inner: Point, *rest: Any) -> Point:
    """The force across a bar at its outer pin that balances the moments about the inner one."""
    way = outer - inner
    return -moment_sum(inner, rest) / dot(way, way) * (1j * way)


@action("balancing-moment")
def balancing_moment(about: Point, *rest: Any) -> Real:
    """The moment that balances the moments about a point."""
    return -moment_sum(about, rest)


@action("place-by-moments")
def place_by_moments(about: Point, guide: Line, reaction: Point, *rest: Any) -> Point:
    """The place along a guide through a point where a reaction balances the moments about it."""
    unit = guide.along / abs(guide.along)
    arm = cross(unit, reaction)
    some = abs(arm) > NOISE * sizes(rest)
    shift = pick(some, moment_sum(about, rest), 0.0) / pick(some, arm, 1.0)
    return about - shift * unit


def sizes(rest: Sequence[Any]) -> Real:
    """The magnitudes of the forces in a sum of moments together."""
    total: Any = 0.0
    for _, force in pairs_and_couples(rest)[0]:
        total = total + abs(force)
    return total


def right_angle(canvas: Canvas, corner: Any, toward: Any, way: Any) -> None:
    """Draw the mark of a right angle at the foot of an arm, where there is room for it."""
    back = toward - corner
    if canvas.size(back) > 2 * SQUARE and abs(way):
        first, second = (v / abs(v) * SQUARE / canvas.mm for v in (back, way))
        canvas.leg("right-angle", "square-mark", corner + first, corner + first + second)
        canvas.leg("right-angle", "square-mark", corner + first + second, corner + second)


@action("left-couple")
def left_couple(about: Point, guide: Line, reaction: Point, *rest: Any) -> Real:
    """The couple of a guide without a reaction that balances the moments about a point."""
    arm = cross(guide.along / abs(guide.along), reaction)
    return pick(abs(arm) > NOISE * sizes(rest), 0.0, -moment_sum(about, rest))


def slanted(kind: ForceArm, foot: Any, get: Callable[[int], Any]) -> Any:
    """The foot of an arm that was measured to the place of the force, not to its line of action."""
    about = get(kind.about)
    arm = abs(foot - about)
    return about + (foot - about) * (abs(get(kind.place) - about) / pick(arm == 0, 1.0, arm))


def about_outer(kind: TangentialPart, force: Any, get: Callable[[int], Any]) -> Any:
    """The part of a reaction by arms about the outer pin, each with its right sense."""
    outer, inner = get(kind.outer), get(kind.moments.about)
    total: Any = 0.0
    for term in kind.moments.terms:
        if term.foot is None or term.force is None:
            assert term.couple is not None
            total = total + get(term.couple)
            continue
        foot, acting = get(term.foot), get(term.force)
        moment, other = cross(foot - inner, acting), abs(cross(foot - outer, acting))
        total = total + pick(moment < 0, -other, other)
    return tangential_part.value(outer, inner, total, 0.0)


class ForceArm(Construction, frozen=True, kw_only=True):
    """The arm of a force ``name`` about a point: its ``foot``, and its symbol ``number``."""

    slips: ClassVar[Mapping[str, Slip]] = {
        "arm_slanted": Slip(1, "moderate", ("foot",), taken=slanted)
    }

    name: str
    number: str
    about: int
    place: int
    force: int
    foot: OwnStep

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the arm with its right angle, and the line of action as far as the foot."""
        about, foot, place = map(canvas.value, (self.about, self.foot, self.place))
        drawn = canvas.drawing.settled(abs(canvas.value(self.force)))
        if not drawn or canvas.size(foot - about) <= SEEN:
            return
        if canvas.size(foot - place) > SEEN:
            canvas.leg(self.name, "ray", place, foot)
        canvas.dimension(self.number, about, foot)
        right_angle(canvas, foot, about, canvas.value(self.force))


class MomentTerm(NamedTuple):
    """One term of a sum of moments: its force or couple, and its arm."""

    name: str
    number: str
    foot: int | None
    force: int | None
    couple: int | None


class Moments(Struct, frozen=True):
    """The terms of a sum of moments about a point, by its ``letter`` and its step."""

    letter: str
    about: int
    terms: tuple[MomentTerm, ...]

    @property
    def steps(self) -> tuple[int, ...]:
        """The inputs of an action: feet and forces, then couples."""
        pairs = (n for t in self.terms if t.foot is not None for n in (t.foot, t.force))
        couples = (t.couple for t in self.terms)
        return tuple(n for n in (*pairs, *couples) if n is not None)

    @property
    def extra(self) -> tuple[float, ...]:
        """The number of pairs, after the inputs."""
        return (float(sum(t.foot is not None for t in self.terms)),)

    def balanced(
        self, pen: Pen, action: Action, *inputs: int, extra: tuple[float, ...] = ()
    ) -> int:
        """The force or moment that balances them by an action, from the point and other inputs."""
        with pen.on(Part.FORCE, Plane.NUMBERS):
            steps = self.about, *inputs, *self.steps
            return pen.draw(action, *steps, extra=(*self.extra, *extra))

    def values(self, drawing: Drawing) -> Iterator[tuple[MomentTerm, float, float, float]]:
        """Each term with its moment in N·m, its force in N and its arm in mm on paper."""
        value = drawing.trace.values
        about = value[self.about]
        for term in self.terms:
            if term.couple is not None:
                yield term, float(value[term.couple]), 0.0, 0.0
                continue
            assert term.foot is not None and term.force is not None
            way, force = value[term.foot] - about, value[term.force]
            arm = drawing.on_paper(abs(way))
            yield term, float(cross(way, force)), drawing.settled(abs(force)), arm

    def shown(self, drawing: Drawing) -> list[tuple[MomentTerm, float, float, float]]:
        """The terms that are not zero on paper."""
        every = self.values(drawing)
        return [e for e in every if (e[2] and e[3] > SEEN) or (e[0].foot is None and e[1])]

    def symbols(self, drawing: Drawing, *, turned: bool = False) -> str:
        """The sum in symbols: F·h_1 − G·h_2 + M; all signs are reversed if ``turned``."""
        scale = drawing.in_signs("·*k*_L") if self.in_metres(drawing) else ""
        return signed(
            (
                (moment > 0) is not turned,
                symbol(term.name)
                if term.foot is None
                else f"{symbol(term.name)}·{symbol(term.number)}{scale}",
            )
            for term, moment, _, _ in self.shown(drawing)
        )

    def figures(self, drawing: Drawing, *, turned: bool = False) -> str:
        """The same in figures."""
        some = self.shown(drawing)
        metres = any(term.foot is None for term, *_ in some)
        scale = drawing.scales.kL / 1000

        def of(term: MomentTerm, moment: float, force: float, arm: float) -> str:
            if term.foot is None:
                return figure(drawing, abs(moment))
            said = f"{figure(drawing, force)}·{figure(drawing, arm)}"
            return f"{said}·{figure(drawing, scale)}" if metres else said

        return signed(((e[1] > 0) is not turned, of(*e)) for e in some)

    def total(self, drawing: Drawing) -> float:
        """The sum in N·m."""
        return sum(moment for _, moment, _, _ in self.values(drawing))

    def in_metres(self, drawing: Drawing) -> bool:
        """Whether a couple among the terms needs arms in metres."""
        return any(term.foot is None for term, *_ in self.shown(drawing))


def divisor(drawing: Drawing, *factors: tuple[str, str], metres: bool) -> tuple[str, str]:
    """A product of factors in symbols and in figures; in metres with the scale of lengths."""
    if metres:
        factors = (*factors, (drawing.in_signs("*k*_L"), figure(drawing, drawing.scales.kL / 1000)))
    symbols, figures = ("·".join(each) for each in zip(*factors, strict=True))
    return (symbols, figures) if len(factors) == 1 else (f"({symbols})", f"({figures})")


def sums_of(drawing: Drawing, *every: Moments) -> tuple[str, str]:
    """The sums of one or two links as one, in symbols and in figures, positive as a whole."""
    shown = [each for each in every if each.shown(drawing)]
    turned = sum(each.total(drawing) for each in shown) < 0
    symbols = in_turn(each.symbols(drawing, turned=turned) for each in shown)
    return symbols, in_turn(each.figures(drawing, turned=turned) for each in shown)


def in_turn(sums: Iterable[str]) -> str:
    """Sums one after the other as one sum."""
    said = ""
    for more in sums:
        said += (f" − {more[1:]}" if more.startswith("−") else f" + {more}") if said else more
    return said or "0"


class ForceByMoments(Construction, frozen=True, kw_only=True):
    """The ``force`` called ``name``: the sum of moments about a point, divided by its arm.

    ``others`` are the moments of a second link, whose sum it balances too. ``none`` is the key of
    the sentence where there is no force.
    """

    none: ClassVar[str]

    name: str
    moments: Moments
    others: Moments | None = None
    force: OwnStep

    @property
    def every(self) -> list[Moments]:
        """The moments of its one or two links."""
        return [each for each in (self.moments, self.others) if each is not None]

    @abstractmethod
    def sentence_key(self, drawing: Drawing) -> str:
        """The key of the sentence where there is a force."""

    @abstractmethod
    def arm(self, drawing: Drawing) -> Sequence[tuple[str, str]]:
        """The arm of the force on paper as a product: each factor in symbols and in figures."""

    def reach(self, drawing: Drawing, end: int) -> str:
        """The drawn distance of a step from the point of the moments, in figures."""
        values = drawing.trace.values
        return figure(drawing, drawing.on_paper(abs(values[end] - values[self.moments.about])))

    def below(self, drawing: Drawing) -> tuple[str, str]:
        """The arm that divides the sum, in symbols and in figures."""
        metres = any(each.in_metres(drawing) for each in self.every)
        return divisor(drawing, *self.arm(drawing), metres=metres)

    def over(self, drawing: Drawing) -> str:
        """The arm in symbols as a form has it."""
        return self.arm(drawing)[0][0]

    def size(self, drawing: Drawing) -> float:
        """The magnitude of the force in N; zero for rounding."""
        return drawing.settled(abs(drawing.trace.values[self.force]))

    def symbols(self) -> Mapping[str, str]:
        """The point about which the moments are taken."""
        return {"b": symbol(self.moments.letter)}

    def fields(self, drawing: Drawing) -> Mapping[str, str]:
        """The symbols and numbers that its sentence uses."""
        size = self.size(drawing)
        return {
            **self.symbols(),
            "r": symbol(self.name),
            "below": self.below(drawing)[0],
            "sum": sums_of(drawing, *self.every)[0],
            "size": newtons(drawing, size),
            "drawn": force_amount(drawing, size),
        }

    def sentence_alone(self, drawing: Drawing, role: str) -> str:
        """The moment equation, and the size of the force."""
        if role != "force":
            return ""
        key = self.sentence_key(drawing) if self.size(drawing) else self.none
        return drawing.words(key, **self.fields(drawing))

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """The sum of moments divided by the arm."""
        if role == "force" and (size := self.size(drawing)):
            yield of_moments(
                (symbol(self.name), answer(drawing, size), "N"),
                symbol(self.moments.letter),
                sums_of(drawing, *self.every),
                self.below(drawing),
                by=self.over(drawing),
            )


class TangentialPart(ForceByMoments, frozen=True, kw_only=True):
    """The part ``name`` of the reaction at a ``link``'s outer pin, across the bar to the inner."""

    reasons: ClassVar[Mapping[str, str]] = {"force": "why.force_tangential"}
    slips: ClassVar[Mapping[str, Slip]] = {
        "tangential_reversed": Slip(-1, "moderate", ("force",)),
        "arms_about_outer": Slip(1, "moderate", ("force",), taken=about_outer),
    }
    none: ClassVar[str] = "step.force-tangential-none"

    link: str
    ends: tuple[str, str]
    outer: int

    def sentence_key(self, drawing: Drawing) -> str:
        return "step.force-tangential"

    def symbols(self) -> Mapping[str, str]:
        """The inner pin, and the bar."""
        return {"b": symbol(self.ends[1]), "bar": bar(*self.ends)}

    def fields(self, drawing: Drawing) -> Mapping[str, str]:
        """The link, and the sense of the loads."""
        turned = self.moments.total(drawing) < 0
        own = {"k": escape(self.link), "sense": sense(drawing.words, 1 if turned else -1)}
        return {**super().fields(drawing), **own}

    def arm(self, drawing: Drawing) -> Sequence[tuple[str, str]]:
        """The bar."""
        return [(bar(*self.ends), self.reach(drawing, self.outer))]


class PlaceOnGuide(Construction, frozen=True, kw_only=True):
    """The place of the reaction ``name`` of a guide, from the moments of its ``link``."""

    reasons: ClassVar[Mapping[str, str]] = {"place": "why.force_place"}

    name: str
    number: str
    link: str
    moments: Moments
    reaction: int
    place: OwnStep

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the distance from the pin, with its dimension."""
        pin, place = canvas.value(self.moments.about), canvas.value(self.place)
        drawn = canvas.drawing.settled(abs(canvas.value(self.reaction)))
        if drawn and canvas.size(place - pin) > SEEN and canvas.holds(place):
            canvas.dimension(self.number, pin, place)

    def symbols(self) -> Mapping[str, str]:
        """The pin about which the moments are taken."""
        return {"b": symbol(self.moments.letter)}

    def shift(self, drawing: Drawing) -> float:
        """The distance from the pin in metres."""
        values = drawing.trace.values
        return float(abs(values[self.place] - values[self.moments.about]))

    def sentence_alone(self, drawing: Drawing, role: str) -> str:
        """The moment equation of the block, and the distance of the reaction from its pin."""
        size = drawing.settled(abs(drawing.trace.values[self.reaction]))
        fields = {
            "k": escape(self.link),
            "b": symbol(self.moments.letter),
            "r": symbol(self.name),
            "x": symbol(self.number),
            "mm": in_mm(drawing.words, drawing.on_paper(self.shift(drawing))),
            "sum": sums_of(drawing, self.moments)[0],
        }
        key = (
            "step.force-place" if size and self.moments.shown(drawing) else "step.force-place-none"
        )
        return drawing.words(key, **fields)

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """The sum of moments divided by the reaction."""
        size = drawing.settled(abs(drawing.trace.values[self.reaction]))
        if not size or not self.moments.shown(drawing):
            return
        force = symbol(self.name), figure(drawing, size)
        shift = drawing.words.fixed(drawing.on_paper(self.shift(drawing)), 2)
        yield of_moments(
            (symbol(self.number), shift, "mm"),
            symbol(self.moments.letter),
            sums_of(drawing, self.moments),
            divisor(drawing, force, metres=self.moments.in_metres(drawing)),
            by=symbol(self.name),
        )


def of_moments(
    found: tuple[str, str, str],
    about: str,
    sums: tuple[str, str],
    below: tuple[str, str],
    *,
    by: str,
) -> Relation:
    """A relation by moments: what is found, its result and unit; sums and divisors in two ways.

    A form has the sum of moments about a point alone, divided ``by`` a length or a force. The sum
    in symbols, whose signs are part of the answer, comes with the figures.
    """
    left, result, unit = found
    (signed, put), (under, divisor) = sums, below
    figures = f"({signed})/{under} = ({put})/{divisor}"
    return Relation(left, f"Σ*M*({about})/{by}", figures, result, unit)


# --- writing their steps -------------------------------------------------------------------------


def moments_about(
    pen: Pen, about: int, letter: str, acting: Sequence[LinkForce], numbers: Iterator[str]
) -> Moments:
    """The moments of some forces about a point; forces through that point have none."""
    terms = []
    for each in acting:
        if each.couple is not None:
            terms.append(MomentTerm(each.name, "", None, None, each.couple))
        elif each.place != about:
            assert each.place is not None and each.force is not None
            terms.append(of_arm(pen, about, each.name, each.place, each.force, next(numbers)))
    return Moments(letter, about, tuple(terms))


def of_arm(pen: Pen, about: int, name: str, place: int, force: int, number: str) -> MomentTerm:
    """Draw the arm of a force about a point."""
    with pen.on(Part.FORCE, Plane.MECHANISM):
        foot = pen.draw(arm, about, place, force)
    pen.make(ForceArm(name=name, number=number, about=about, place=place, force=force, foot=foot))
    return MomentTerm(name, number, foot, force, None)


def tangential(
    pen: Pen,
    name: str,
    link: str,
    ends: tuple[str, str],
    moments: Moments,
    outer: int | None = None,
) -> int:
    """The part of an outer reaction across a bar; ``outer`` is the step of a contact point."""
    outer = pen.the("position", ends[0]) if outer is None else outer
    with pen.on(Part.FORCE, Plane.NUMBERS):
        force = pen.draw(tangential_part, outer, moments.about, *moments.steps, extra=moments.extra)
    part = TangentialPart(
        name=name,
        link=link,
        ends=ends,
        outer=outer,
        moments=moments,
        force=force,
    )
    return pen.make(part).force


def on_guide(
    pen: Pen,
    name: str,
    link: str,
    guide: int,
    reaction: int,
    moments: Moments,
    acting: Iterable[LinkForce],
) -> tuple[int, int | None]:
    """The place of a guide's reaction on a link, and the couple that replaces it where it is zero.

    It is at the pin itself, without a couple, where no force has a moment about that pin. A
    reaction is zero beside the forces ``acting`` on the links whose polygon gives it.
    """
    if not moments.terms:
        return moments.about, None
    others = [e.force for e in acting if e.force is not None and e.force not in moments.steps]
    beside = [step for force in others for step in (moments.about, force)]
    inputs = moments.about, guide, reaction, *beside, *moments.steps
    count = (moments.extra[0] + len(others),)
    with pen.on(Part.FORCE, Plane.MECHANISM):
        place = pen.draw(place_by_moments, *inputs, extra=count)
    found = PlaceOnGuide(
        name=name, number=f"x_{link}", link=link, moments=moments, reaction=reaction, place=place
    )
    pen.make(found)
    with pen.on(Part.FORCE, Plane.NUMBERS):
        return place, pen.draw(left_couple, *inputs, extra=count)


class BalancingMoment(Construction, frozen=True, kw_only=True):
    """The balancing moment ``name`` of a driven ``link``."""

    reasons: ClassVar[Mapping[str, str]] = {"moment": "why.force_balance"}

    name: str
    link: str
    moments: Moments
    moment: OwnStep

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
            "size": newton_metres(drawing, size),
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
        if scaled:
            symbols, put = f"({symbols}){drawing.in_signs('·*k*_L')}", f"({put})·{k}"
        yield Relation(
            symbol(self.name),
            f"−Σ*M*({symbol(self.moments.letter)})",
            f"{symbols} = {put}",
            answer(drawing, abs(size)),
            "N·m",
            sense(drawing.words, size),
            turns=True,
        )


def balance_of(pen: Pen, name: str, link: str, moments: Moments) -> int:
    """The balancing moment of a driven crank."""
    moment = moments.balanced(pen, balancing_moment)
    return pen.make(BalancingMoment(name=name, link=link, moments=moments, moment=moment)).moment
