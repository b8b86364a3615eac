"""The plans of velocities and accelerations: images by known rates, and rates read off them."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from contextlib import AbstractContextManager
from operator import truediv
from typing import ClassVar

from msgspec import Struct

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import GivesRate
from graphkin.construction.core.naming import driver_index, rate_symbol, sense, turning_with
from graphkin.construction.core.pen import (
    PRIME,
    Pen,
    about,
    acceleration_arrow,
    against,
    image_name,
    letter,
    velocity_arrows,
)
from graphkin.construction.core.program import OwnStep, Part, Plane, plan_vector
from graphkin.construction.core.quantities import EPSILON, MOTION, OMEGA, PLANES, RATE, SLIDING
from graphkin.construction.core.relation import FINE, Relation, figure, length_of, put_in, within
from graphkin.construction.core.vocabulary import action, difference, sum_of
from graphkin.construction.velocity.relative_motion import (
    turned_acceleration_image,
    turned_velocity_image,
)
from graphkin.drawing.symbol_markup import bar
from graphkin.numbers.arithmetic import Point, Real
from graphkin.numbers.plane import cross, dot
from graphkin.scene.link_points import lettered
from graphkin.scene.model import FRAME, Driver


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
        unit = drawing.words.spelled(drawing.rate.caret_unit)
        return f" = {self.whole(drawing)} = {value} {unit}"

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


class Plan(Struct, frozen=True):
    """A plan by the ``quantity`` of points and the ``rate`` of links that it shows.

    ``given`` is the attribute of a driver that it takes. ``letter`` is the letter of its vectors.
    ``prime`` is appended to the letters of its images.
    """

    quantity: str
    rate: str
    given: str
    letter: str
    part: Part
    plane: Plane
    prime: str = ""

    def named(self, point: str) -> str:
        return str(image_name(point, self.prime))

    def drawn(self, pen: Pen) -> AbstractContextManager[None]:
        """Write steps in this plan."""
        return pen.on(self.part, self.plane)

    @abstractmethod
    def arrows(self, pen: Pen, point: str, pivot: str | None = None) -> None:
        """Draw the arrows to the image of a point: from the pole, and from a pivot's image."""

    @abstractmethod
    def index(self, pen: Pen, pin: str, pivot: str) -> str:
        """The index of the vector of a pin relative to a pivot."""

    @abstractmethod
    def lettered(self, point: str) -> str:
        """The index of the vector of a link's point under another point."""

    @abstractmethod
    def turned(
        self, pen: Pen, link: str, pivot: str, pin: str, start: int, *, steady: bool = False
    ) -> int:
        """The image of a pin from ``start``, the pivot's image, by the rates of their link."""

    @abstractmethod
    def is_steady(self, pen: Pen, link: str) -> bool:
        """Whether a link has no angular acceleration; writes the rates of the link where needed."""

    def turn(
        self, pen: Pen, link: str, pivot: str, pin: str, *, steady: bool, along: str | None = None
    ) -> None:
        """Draw the image of a pin of a link with known rates, with its arrows.

        The pivot may be a contact point. An arrow also leads from the image of ``along``.
        """
        start = pen.the(self.quantity, pivot)
        with self.drawn(pen):
            found = self.turned(pen, link, pivot, pin, start, steady=steady)
        self.settle(pen, pin, found, along)

    def settle(self, pen: Pen, point: str, image: int, pivot: str | None = None) -> None:
        """Record which step is the image of a point, and draw its arrows."""
        pen.want(self.quantity, point, image)
        self.arrows(pen, point, pivot)


class VelocityPlan(Plan, frozen=True):
    """The plan of velocities."""

    def arrows(self, pen: Pen, point: str, pivot: str | None = None) -> None:
        """Draw the absolute velocity, and the velocity relative to a pivot."""
        velocity_arrows(pen, point, pivot)

    def index(self, pen: Pen, pin: str, pivot: str) -> str:
        """The index of a relative velocity; the pin alone about a point at rest."""
        return against(pen, pin, pivot)

    def lettered(self, point: str) -> str:
        """The index of a point's velocity; two points in contact have one velocity."""
        return letter(point)

    def turned(
        self, pen: Pen, link: str, pivot: str, pin: str, start: int, *, steady: bool = False
    ) -> int:
        """The image of a pin by the angular velocity."""
        return turned_velocity_image(pen, link, (pivot, pin), start, name=self.named(pin))

    def is_steady(self, pen: Pen, link: str) -> bool:
        """False, since velocities do not depend on it; writes the rate of the link."""
        omega_of(pen, link)
        return False


class AccelerationPlan(Plan, frozen=True):
    """The plan of accelerations."""

    def arrows(self, pen: Pen, point: str, pivot: str | None = None) -> None:
        """Draw the absolute acceleration; components have arrows of their own."""
        acceleration_arrow(pen, point)

    def index(self, pen: Pen, pin: str, pivot: str) -> str:
        """The index of a relative acceleration; the pin alone about a fixed pivot."""
        return about(pen, pin, pivot)

    def lettered(self, point: str) -> str:
        """The index of a point's acceleration, with its link."""
        return lettered(point)

    def turned(
        self, pen: Pen, link: str, pivot: str, pin: str, start: int, *, steady: bool = False
    ) -> int:
        """The image of a pin by both rates."""
        name, points = self.named(pin), (pivot, pin)
        return turned_acceleration_image(pen, link, points, start, name=name, steady=steady)

    def is_steady(self, pen: Pen, link: str) -> bool:
        """Whether a driver turns the link at a constant rate."""
        omega_of(pen, link)
        return pen.is_zero(omega_of(pen, link, EPSILON))


def shown(kind: str) -> tuple[str, str, str, str, Part, Plane]:
    """The arguments of a plan for velocity or acceleration."""
    rate, given, letter = RATE[kind].target, SLIDING[kind].attribute, MOTION[kind].letter
    return kind, rate, given, letter, Part(kind), PLANES[kind]


VELOCITY = VelocityPlan(*shown("velocity"))
ACCELERATION = AccelerationPlan(*shown("acceleration"), PRIME)
BY_RATE: dict[str, Plan] = {plan.rate: plan for plan in (VELOCITY, ACCELERATION)}
"""The plan from which each rate is read off."""


def omega_of(pen: Pen, link: str, quantity: str = VELOCITY.rate) -> int:
    """The angular velocity or acceleration of a link, from its base or from its leading link."""
    if link == FRAME:
        return pen.given("zero")
    if not pen.has(quantity, link):
        pen.want(quantity, link, rate_of(pen, link, quantity))
    return pen.the(quantity, link)


def rate_of(pen: Pen, link: str, quantity: str) -> int:
    """The step that finds an angular velocity or acceleration that is not known yet."""
    if not pen.turns(link):
        return pen.given("zero", name=f"no {quantity}")
    base, plan = pen.bases[link], BY_RATE[quantity]
    if base.end is None:
        return omega_of(pen, pen.leads[link], quantity)
    index = plan.index(pen, base.end, base.start)
    places = pen.the("position", base.start), pen.the("position", base.end)
    images = pen.the(plan.quantity, base.start), pen.the(plan.quantity, base.end)
    letters = letter(base.start), letter(base.end)
    with pen.on(Part.RESULT, Plane.NUMBERS), pen.calls_for(None):
        return turning_of_link(pen, quantity, link, letters, index, (places, images))
