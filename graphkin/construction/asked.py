"""What is asked of points: in its plan an arrow from the pole, and the same on the mechanism."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from msgspec import Struct

from graphkin.construction.core.arrows import acceleration_arrow, velocity_arrows
from graphkin.construction.core.pen import Pen, letter
from graphkin.construction.core.plan_vector import PlanVector
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.vocabulary import Action, action
from graphkin.construction.guides.coincident_points import carried
from graphkin.numbers.arithmetic import Point, Real
from graphkin.numbers.plane import Vector
from graphkin.scene.link_points import ends_of


@action("set-on")
def set_on(point: Point, o: Point, image: Point, seconds: Real) -> Vector:
    """A velocity of the plan set on the mechanism at its point."""
    return Vector(point, point + (image - o) * seconds)


@action("set-on-twice")
def set_on_twice(point: Point, o: Point, image: Point, seconds: Real) -> Vector:
    """An acceleration of the plan set on the mechanism at its point."""
    return Vector(point, point + (image - o) * (seconds * seconds))


class AskedQuantity(Struct, frozen=True):
    """What differs between velocities and accelerations."""

    quantity: str
    sign: str
    plane: Plane
    part: Part
    action: Action  # that sets a vector on the mechanism
    arrow: Callable[[Pen, str], None]  # from the pole of the plan


VELOCITY = AskedQuantity(
    "velocity",
    "v",
    Plane.VELOCITIES,
    Part.VELOCITY,
    set_on,
    lambda pen, point: velocity_arrows(pen, point, None),
)
ACCELERATION = AskedQuantity(
    "acceleration", "a", Plane.ACCELERATIONS, Part.ACCELERATION, set_on_twice, acceleration_arrow
)


def show(pen: Pen, kind: AskedQuantity, tips: Iterable[str]) -> None:
    """The vectors of driven tips and of what is asked, on the mechanism, and their arrows."""
    names: tuple[str, ...] = getattr(pen.scene.ask, kind.quantity)
    asked = [constructed(pen, name, kind.quantity) for name in names]
    for point in asked:
        if pen.the(kind.quantity, point) != pen.pole(kind.plane):  # as that of a fixed point is
            kind.arrow(pen, point)
    for point in dict.fromkeys((*tips, *asked)):
        set_on_mechanism(pen, kind, point)


def constructed(pen: Pen, name: str, quantity: str) -> str:
    """The point that a name asks about, its image found: A for A@3 where link 3 owns A."""
    point, link = ends_of(name)
    if not link:
        return name
    owned = point in pen.scene.link(link).points
    if not pen.has("position", name):
        pen.want("position", name, pen.the("position", point))
    if not pen.has(quantity, name):
        number = carried(pen, link, point, quantity)
        if not pen.has(quantity, name):
            pen.want(quantity, name, number)
    return point if owned else name


def set_on_mechanism(pen: Pen, kind: AskedQuantity, point: str) -> None:
    """The absolute velocity or acceleration of a point, set on the mechanism."""
    ends = pen.the("position", point), pen.pole(kind.plane), pen.the(kind.quantity, point)
    with pen.on(kind.part, Plane.MECHANISM):
        vector = PlanVector(kind.sign, letter(point))
        pen.vector(kind.action, *ends, pen.seconds(), of=vector)
