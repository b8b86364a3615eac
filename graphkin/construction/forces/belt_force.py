"""The forces in the two strands of a belt, along common tangents of its wheels.

The moments of the loads of a wheel about its centre give the difference of both tensions. The scene
states what fixes them: the tension of the slack strand, the mean of both, or their ratio.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from typing import Any, ClassVar, NamedTuple

from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Slip
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import OwnStep, Part, Plane
from graphkin.construction.core.relation import Relation, answer, put_in
from graphkin.construction.core.vocabulary import action
from graphkin.construction.forces.loads import STRANDS, force_amount, newtons, sub
from graphkin.construction.forces.moments import (
    ForceByMoments,
    Moments,
    moment_sum,
    of_moments,
    sums_of,
)
from graphkin.drawing.symbol_markup import escape, of_wheel, symbol
from graphkin.numbers.arithmetic import Point, Real, at, pick, sqrt
from graphkin.scene.model import TENSIONS, Belt, Scene, Wheel

LETTERS = {"slack": "T_min", "pretension": "T_0", "ratio": "q"}
"""The symbol of what a scene states of a belt's tensions."""
RULES = tuple(TENSIONS)
FORMULAS = {
    "slack": ("{t} + {u}", "{t}"),
    "pretension": ("{t} + {u}/2", "{t} − {u}/2"),
    "ratio": ("{t}·{u}/({t} − 1)", "{u}/({t} − 1)"),
}
"""The tensions of the tight and of the slack strand from a stated number and their difference."""


@action("strand-edge")
def strand_edge(centre: Point, other: Point, own: Real, on: Real, sense: int, side: int) -> Point:
    """The point at which a strand leaves a wheel; ``sense`` is +1 for a crossed belt, else -1."""
    apart = abs(other - centre)
    lean = (own + sense * on) / apart
    rise = sqrt(1 - lean * lean)
    return centre + at(lean, side * rise) * (own / apart * (other - centre))


@action("strand-end")
def strand_end(centre: Point, other: Point, own: Real, on: Real, edge: Point, sense: int) -> Point:
    """The point at which a strand that leaves a wheel at an edge reaches the other wheel."""
    return other - sense * on / own * (edge - centre)


@action("strand-force")
def strand_force(centre: Point, edge: Point, number: Real, *rest: Any) -> Point:
    """The force of a strand on a wheel, which holds the moments about its centre with the other.

    ``rest`` holds the inputs of the moments and the number of pairs, then the strand's side and the
    place in RULES of the rule that ``number`` belongs to.
    """
    *terms, pairs, side, rule = rest
    arm = edge - centre
    more = side * moment_sum(centre, (*terms, pairs)) / abs(arm)
    return tension(more, number, RULES[int(rule)]) * (-1j * side * arm / abs(arm))


def tension(more: Real, number: Real, rule: str) -> Real:
    """The tension of a strand that carries ``more`` than the other.

    A loose strand raises ValueError; in a batch it is NaN.
    """
    if rule == "pretension":
        found = number + more / 2
        return found + 0 * sqrt(found)
    if rule == "slack":
        return number + pick(more > 0, more, 0 * more)
    return pick(more > 0, number * more, -more) / (number - 1)


def swapped(kind: BeltStrand, force: Any, get: Callable[[int], Any]) -> Any:
    """The force of a strand with the tension of the other one."""
    return -strand_force.value(*kind.inputs(get), -kind.side, RULES.index(kind.rule))


def of_other(kind: BeltStrand, force: Any, get: Callable[[int], Any]) -> Any:
    """The force of a strand where the stated tension was given to the wrong strand.

    The slack one's was given to the tight one, or the mean of both to the slack one. A ratio
    belongs to neither.
    """
    centre, edge, number, *terms = kind.inputs(get)
    more = kind.side * moment_sum(centre, terms) / abs(edge - centre)
    wrong = {
        "slack": number - pick(more < 0, -more, 0 * more),
        "pretension": tension(more, number, "slack"),
    }
    right = tension(more, number, kind.rule)
    share = wrong.get(kind.rule, right) / pick(right == 0, 1.0, right)
    return force * share


class BeltStrand(ForceByMoments, frozen=True, kw_only=True):
    """The force ``name`` of a strand on a ``link`` from the wheel of another, at its ``edge``.

    ``sign`` is the label of the wheel, and ``side`` is +1 for its left strand, -1 for the right.
    ``first`` is the name and the step of the left strand, at the right one. ``stated`` is the
    symbol of ``number``, which ``rule`` explains.
    """

    reasons: ClassVar[Mapping[str, str]] = {"force": "why.force_belt"}
    slips: ClassVar[Mapping[str, Slip]] = {
        "strands_swapped": Slip(1, "moderate", ("force",), taken=swapped),
        "tension_of_other_strand": Slip(1, "moderate", ("force",), taken=of_other),
    }
    none: ClassVar[str] = "step.force-belt-none"

    link: str
    sign: str
    side: int
    rule: str
    stated: str
    number: int
    edge: OwnStep
    first: tuple[str, int] | None = None

    def inputs(self, get: Callable[[int], Any]) -> tuple[Any, ...]:
        """The values from which its force follows, without its side and its rule."""
        steps = self.moments.about, self.edge, self.number, *self.moments.steps
        return (*map(get, steps), *self.moments.extra)

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the radius to the point at which the strand leaves the wheel."""
        if role == "edge":
            centre, edge = canvas.value(self.moments.about), canvas.value(self.edge)
            canvas.leg(self.name, "ray", centre, edge)

    def sentence_key(self, drawing: Drawing) -> str:
        return "step.force-belt"

    @property
    def formulas(self) -> tuple[str, str]:
        """Both tensions in terms of the stated number and the difference, the tight one first."""
        return FORMULAS[self.rule]

    def put(self, formula: str) -> str:
        """A formula in symbols."""
        return formula.format(t=symbol(self.stated), u=self.rim_force)

    def in_order(self, drawing: Drawing) -> list[tuple[str, float]]:
        """The symbols and the tensions of both strands, the tight one first."""
        assert self.first is not None
        both = [
            (symbol(name), drawing.settled(abs(drawing.trace.values[step])))
            for name, step in (self.first, (self.name, self.force))
        ]
        return sorted(both, key=lambda each: -each[1])

    def difference(self, drawing: Drawing) -> float:
        """The difference of both tensions in N; zero for rounding."""
        edge, about = (drawing.trace.values[n] for n in (self.edge, self.moments.about))
        return drawing.settled(abs(self.moments.total(drawing)) / float(abs(edge - about)))

    def sentence_alone(self, drawing: Drawing, role: str) -> str:
        """The difference of both strands and what fixes them, at the second one."""
        if role != "force" or self.first is None:
            return ""
        (tight, most), (slack, least) = self.in_order(drawing)
        difference = self.difference(drawing)
        fields = {
            **self.symbols(),
            "k": escape(self.link),
            "u": self.rim_force,
            "tight": tight,
            "slack": slack,
            "below": self.below(drawing)[0],
            "sum": sums_of(drawing, self.moments)[0],
            "size": newtons(drawing, difference),
            "more": self.put(self.formulas[0]),
            "less": self.put(self.formulas[1]),
            "most": f"{newtons(drawing, most)} ({force_amount(drawing, most)})",
            "least": f"{newtons(drawing, least)} ({force_amount(drawing, least)})",
        }
        return drawing.words(self.sentence_key(drawing) if difference else self.none, **fields)

    @property
    def rim_force(self) -> str:
        """The symbol of the difference of both tensions."""
        return symbol("U_" + sub("", self.link).removeprefix(","))

    def arm(self, drawing: Drawing) -> Sequence[tuple[str, str]]:
        """The radius of the wheel."""
        return [(of_wheel("r", self.sign), self.reach(drawing, self.edge))]

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """The difference of both tensions from the moments, then each tension."""
        if role != "force" or self.first is None:
            return
        difference = self.difference(drawing)
        if difference:
            yield of_moments(
                (self.rim_force, answer(drawing, difference), "N"),
                symbol(self.moments.letter),
                sums_of(drawing, self.moments),
                self.below(drawing),
                by=self.over(drawing),
            )
        number = float(drawing.trace.values[self.number])
        sides = zip(self.in_order(drawing), self.formulas, (1, -1), strict=True)
        for (name, size), formula, more in sides:
            result, worth = answer(drawing, size), partial(self.worth, more)
            t, u = put_in(drawing, result, worth, number, difference)
            yield Relation(name, self.put(formula), formula.format(t=t, u=u), result, "N")

    def worth(self, more: int, number: float, difference: float) -> float:
        """A tension from the stated number and the difference: of the tight strand for +1."""
        return float(tension(more * difference, number, self.rule))


# --- writing their steps -------------------------------------------------------------------------


def belt_letter(scene: Scene, belt: Belt) -> str:
    """The symbol of what a scene states of a belt's tensions; belts are numbered if many."""
    assert belt.tension is not None
    every = (each.belt for _, each in scene.belts)
    stated = [each for each in every if each is not None and each.tension is not None]
    letter = LETTERS[belt.tension.key]
    if len(stated) == 1:
        return letter
    number = 1 + next(k for k, each in enumerate(stated) if each is belt)
    return f"{letter},{number}" if "_" in letter else f"{letter}_{number}"


class StrandPlace(NamedTuple):
    """A strand's force on a wheel, and the points at which it leaves both wheels."""

    force: int
    edge: int
    end: int


def belt_strands(
    pen: Pen,
    link: str,
    names: Mapping[str, str],
    wheels: tuple[Wheel, Wheel],
    belt: Belt,
    moments: Moments,
    sense: int,
) -> Iterator[tuple[str, StrandPlace]]:
    """The forces of both strands on the wheel of a link, by their names in STRANDS.

    ``sense`` is -1 where left and right are those seen from the other wheel.
    """
    assert belt.tension is not None
    key, stated = belt.tension.key, belt_letter(pen.scene, belt)
    with pen.on(Part.FORCE, Plane.NUMBERS):
        radii = [pen.given("number", each.radius, name=f"radius {each.centre}") for each in wheels]
        number = pen.given("number", belt.tension.number, name=f"tension {stated}")
    centres = moments.about, pen.the("position", wheels[1].centre)
    first: tuple[str, int] | None = None
    for strand, (_, seen) in STRANDS.items():
        side = sense * seen
        with pen.on(Part.FORCE, Plane.MECHANISM):
            edge = pen.draw(strand_edge, *centres, *radii, extra=(belt.sense, side))
            end = pen.draw(strand_end, *centres, *radii, edge, extra=(belt.sense,))
        fixed = float(side), float(RULES.index(key))
        force = moments.balanced(pen, strand_force, edge, number, extra=fixed)
        found = BeltStrand(
            name=names[strand],
            link=link,
            sign=pen.scene.link(link).wheel_sign(wheels[0]),
            side=side,
            rule=key,
            stated=stated,
            number=number,
            moments=moments,
            edge=edge,
            force=force,
            first=first,
        )
        first = found.name, pen.make(found).force
        yield strand, StrandPlace(force, edge, end)
