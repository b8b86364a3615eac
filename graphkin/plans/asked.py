"""What is asked of points: in its plan an arrow from the pole, and the same on the mechanism."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import NamedTuple

from graphkin.plans.arrows import acceleration_arrow, velocity_arrows
from graphkin.plans.carried import carried
from graphkin.plans.pen import Pen, image, letter, second_image
from graphkin.scene.model import FRAME
from graphkin.steps.program import Part, Plane
from graphkin.steps.vocabulary import Action, alike, set_on, set_on_twice


class Kind(NamedTuple):
    """What differs between velocities and accelerations."""

    quantity: str
    sign: str
    plane: Plane
    part: Part
    action: Action  # that sets a vector on the mechanism
    arrow: Callable[[Pen, str], None]  # from the pole of the plan


VELOCITY = Kind(
    "velocity",
    "v",
    Plane.VELOCITIES,
    Part.VELOCITY,
    set_on,
    lambda pen, point: velocity_arrows(pen, point, None),
)
ACCELERATION = Kind(
    "acceleration", "a", Plane.ACCELERATIONS, Part.ACCELERATION, set_on_twice, acceleration_arrow
)


def show(pen: Pen, kind: Kind, tips: Iterable[str]) -> None:
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
    point, _, link = name.partition("@")
    if not link:
        return name
    owned = point in pen.scene.link(link).points
    if not pen.has("position", name):
        pen.want("position", name, pen.the("position", point))
    if not pen.has(quantity, name):
        number = carried(pen, link, point, quantity)
        if not pen.has(quantity, name):
            shifts = not owned and link != FRAME
            pen.want(quantity, name, alike_image(pen, name, number) if shifts else number)
    return point if owned else name


def alike_image(pen: Pen, name: str, number: int) -> int:
    """The image of a point of a link that only shifts: on that of its others, under its letter."""
    start = pen.bases[name.partition("@")[2]].start
    plan = pen.steps[number]
    called = image(name) if plan.plane is Plane.VELOCITIES else second_image(name)
    with pen.on(plan.part, plan.plane):
        return pen.draw(alike, number, name=called, p=start, q=letter(name))


def set_on_mechanism(pen: Pen, kind: Kind, point: str) -> None:
    """The absolute velocity or acceleration of a point, set on the mechanism."""
    ends = pen.the("position", point), pen.pole(kind.plane), pen.the(kind.quantity, point)
    with pen.on(kind.part, Plane.MECHANISM):
        symbol = f"{kind.sign}_{letter(point)}"
        pen.arrow(kind.action, *ends, pen.seconds(), name=symbol, symbol=symbol)
