"""The rotation of a link: the relative motion of two of its points, over their bar."""

from __future__ import annotations

from collections.abc import Mapping
from operator import truediv
from typing import ClassVar

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import GivesRate
from graphkin.construction.core.naming import driver_index, rate_symbol, sense, turning_with
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import OwnStep, plan_vector
from graphkin.construction.core.quantities import EPSILON, OMEGA
from graphkin.construction.core.relation import FINE, Relation, figure, length_of, put_in, within
from graphkin.construction.core.vocabulary import action, difference, sum_of
from graphkin.drawing.symbol_markup import bar
from graphkin.numbers.arithmetic import Point, Real
from graphkin.numbers.plane import cross, dot
from graphkin.scene.model import Driver


@action(OMEGA)
def omega(p: Point, q: Point, image_p: Point, image_q: Point) -> Real:
    """The angular velocity of a link from the relative velocity of two of its points."""
    bar = q - p
    return cross(bar, image_q - image_p) / dot(bar, bar)


@action(EPSILON)
def epsilon(p: Point, q: Point, image_p: Point, image_q: Point) -> Real:
    """The angular acceleration from the tangential part of a relative acceleration."""
    bar = q - p
    return cross(bar, image_q - image_p) / dot(bar, bar)


ACTIONS = {OMEGA: omega, EPSILON: epsilon}
"""The action that finds each rate from the bar and its image."""


class TurningOfLink(GivesRate, frozen=True, kw_only=True):
    """The ``rate`` of a link from the relative motion of ``q`` about ``p``, read off a plan.

    ``quantity`` is omega or epsilon. ``places`` and ``images`` are the steps of both points.
    """

    vectors: ClassVar[Mapping[str, str]] = {OMEGA: "v_{}", EPSILON: "a_{}^τ"}

    turns: ClassVar[Mapping[str, str]] = {"velocity": "why.omega", "acceleration": "why.epsilon"}

    quantity: str
    link: str
    p: str
    q: str
    index: str
    places: tuple[int, int]
    images: tuple[int, int]
    rate: OwnStep

    def vector(self, index: str) -> str:
        """The symbol of the relative vector that is perpendicular to the bar."""
        return self.vectors[self.quantity].format(index)

    def rate_reason(self, drawing: Drawing) -> str:
        """The key of the reason: each sheet says how the rate is read off the bar and its image."""
        return self.turns[drawing.kind]

    def relative(self, drawing: Drawing) -> tuple[str, tuple[str, str]]:
        """The symbol of the drawn relative vector, and the bar from the end taken as fixed.

        It is the vector of ``q`` about ``p``, or of ``p`` about ``q`` where the plan draws only
        that one.
        """
        found = (plan_vector(step) for _, step, _ in drawing.steps(drawing.plane))
        drawn = {vector.symbol for vector in found if vector}
        one, other = (self.vector(index) for index in (self.index, self.p + self.q))
        if one not in drawn and other in drawn:
            return drawing.symbol(other), (self.q, self.p)
        return drawing.symbol(one), (self.p, self.q)

    def source_of_rate(self, drawing: Drawing) -> str:
        """The relative vector over the bar."""
        vector, ends = self.relative(drawing)
        return f" = {vector}/{bar(*ends)}"

    def relation(self, drawing: Drawing, tail: tuple[str, str, str]) -> Relation:
        """The relation for the rate; ``tail`` is the result with its unit and sense."""
        vector, ends = self.relative(drawing)
        length = length_of(drawing, *ends)
        size = abs(float(drawing.trace.values[self.rate])) * length
        size = 0.0 if drawing.turning(self.link) == 0 else size
        figures = "/".join(put_in(drawing, tail[0], truediv, size, length))
        name = drawing.symbol(f"{drawing.rate.letter}_{turning_with(drawing, self.link)}")
        whole = f"{vector}/{bar(*ends)}"
        return Relation(name, whole, figures, *tail, over=(ends,), takes=vector)


def turning_of_link(
    pen: Pen,
    quantity: str,
    link: str,
    letters: tuple[str, str],
    index: str,
    steps: tuple[tuple[int, int], tuple[int, int]],
) -> int:
    """The rate of a link by two of its points: their letters, and steps of places and images."""
    places, images = steps
    rate = pen.draw(ACTIONS[quantity], *places, *images, name=link)
    p, q = letters
    found = TurningOfLink(
        quantity=quantity, link=link, p=p, q=q, index=index, places=places, images=images, rate=rate
    )
    return pen.make(found).rate


# --- the rate of a crank on a moving link: the rate of that link plus the given one --------------


class SummedRate(GivesRate, frozen=True, kw_only=True):
    """The ``rate`` of a ``link`` that a driver turns against another: the other rate plus ``own``.

    For the link against which another one is turned, the given rate ``own`` is subtracted.
    """

    link: str
    driver: int
    other: int
    own: int
    rate: OwnStep

    def sign(self, drawing: Drawing) -> str:
        return "+" if drawing.scene.drivers[self.driver].link == self.link else "−"

    def whole(self, drawing: Drawing) -> str:
        """The sum or the difference, as markup."""
        other = rate_symbol(drawing, self.other, drawing.rate.letter)
        index = driver_index(drawing.scene.drivers[self.driver])
        letter = drawing.symbol(drawing.rate.letter)
        return f"{other} {self.sign(drawing)} {letter}_{{{index}}}"

    def source_of_rate(self, drawing: Drawing) -> str:
        """The sum with its value."""
        value = drawing.words.significant(float(drawing.trace.values[self.rate]))
        return (
            f" = {self.whole(drawing)} = {value} {drawing.words.spelled(drawing.rate.caret_unit)}"
        )

    def relation(self, drawing: Drawing) -> Relation:
        """The relation for the sum, with its values."""
        one, two = (float(drawing.trace.values[each]) for each in (self.other, self.own))
        sign = self.sign(drawing)
        value = one + two if sign == "+" else one - two
        return Relation(
            drawing.symbol(f"{drawing.rate.letter}_{self.link}"),
            self.whole(drawing),
            f"{figure(drawing, one, FINE)} {sign} {within(drawing, two)}",
            figure(drawing, value, FINE),
            drawing.rate.caret_unit,
            sense(drawing.words, value),
            turns=True,
        )


def summed_rate(pen: Pen, driver: Driver, link: str, other: int, own: int) -> int:
    """The rate of a driven link from the other link's rate; or of the link it is driven against."""
    rate = pen.draw(sum_of if driver.link == link else difference, other, own, name=link)
    number = pen.scene.drivers.index(driver)
    found = SummedRate(link=link, driver=number, other=other, own=own, rate=rate)
    return pen.make(found).rate
