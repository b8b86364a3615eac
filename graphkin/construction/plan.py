"""The plans of velocities and of accelerations: their images, and images by known rates."""

from __future__ import annotations

from abc import abstractmethod
from contextlib import AbstractContextManager

from msgspec import Struct

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
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.quantities import EPSILON, MOTION, PLANES, RATE, SLIDING
from graphkin.construction.velocity.turned_vectors import (
    turned_acceleration_image,
    turned_velocity_image,
)
from graphkin.construction.velocity.turning_of_link import turning_of_link
from graphkin.scene.link_points import lettered
from graphkin.scene.model import FRAME


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
