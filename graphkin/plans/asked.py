"""What is asked of points: in its plan an arrow from the pole, and the same on the mechanism."""

from __future__ import annotations

from collections.abc import Iterable

from graphkin.plans.arrows import acceleration_arrow, velocity_arrows
from graphkin.plans.carried import carried
from graphkin.plans.pen import Pen, image, letter, second_image
from graphkin.scene.model import FRAME
from graphkin.steps.program import Part, Plane
from graphkin.steps.vocabulary import alike, set_on, set_on_twice


def show_velocities(pen: Pen, tips: Iterable[str]) -> None:
    """The velocities of driven tips and of what is asked, on the mechanism, and their arrows."""
    asked = [constructed(pen, name, "velocity") for name in pen.scene.ask.velocity]
    for point in asked:
        if not stands_still(pen, point, "velocity", Plane.VELOCITIES):
            velocity_arrows(pen, point, None)
    for point in dict.fromkeys((*tips, *asked)):
        set_velocity_on(pen, point)


def show_accelerations(pen: Pen, tips: Iterable[str]) -> None:
    """The accelerations of driven tips and of what is asked, in the same way."""
    asked = [constructed(pen, name, "acceleration") for name in pen.scene.ask.acceleration]
    for point in asked:
        if not stands_still(pen, point, "acceleration", Plane.ACCELERATIONS):
            acceleration_arrow(pen, point)
    for point in dict.fromkeys((*tips, *asked)):
        set_acceleration_on(pen, point)


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


def stands_still(pen: Pen, point: str, quantity: str, plane: Plane) -> bool:
    """True for a point of the frame, whose image is the pole."""
    return pen.the(quantity, point) == pen.pole(plane)


def set_velocity_on(pen: Pen, point: str) -> None:
    """The absolute velocity of a point, set on the mechanism."""
    o = pen.pole(Plane.VELOCITIES)
    ends = pen.the("position", point), o, pen.the("velocity", point)
    with pen.on(Part.VELOCITY, Plane.MECHANISM):
        symbol = f"v_{letter(point)}"
        pen.arrow(set_on, *ends, pen.seconds(), name=symbol, symbol=symbol)


def set_acceleration_on(pen: Pen, point: str) -> None:
    """The absolute acceleration of a point, set on the mechanism."""
    o = pen.pole(Plane.ACCELERATIONS)
    ends = pen.the("position", point), o, pen.the("acceleration", point)
    with pen.on(Part.ACCELERATION, Plane.MECHANISM):
        symbol = f"a_{letter(point)}"
        pen.arrow(set_on_twice, *ends, pen.seconds(), name=symbol, symbol=symbol)
