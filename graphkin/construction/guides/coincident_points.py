"""The point of a link under another link's point: its images in both plans."""

from __future__ import annotations

from graphkin.construction.acceleration import turned_acceleration
from graphkin.construction.core.arrows import acceleration_arrow, velocity_arrows
from graphkin.construction.core.pen import (
    Pen,
    about,
    against,
    image,
    letter,
    second_image,
)
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.quantities import BY_TARGET, EPSILON, OMEGA
from graphkin.construction.core.vocabulary import in_proportion
from graphkin.construction.velocity.image_of_link import image_of_link, translated_image
from graphkin.construction.velocity.turned_velocity import turned_image
from graphkin.construction.velocity.turning_of_link import turning_of_link
from graphkin.scene.link_points import lettered, under
from graphkin.scene.model import FRAME
from graphkin.structure.pairs import is_in_scene


def omega_of(pen: Pen, link: str, quantity: str = OMEGA) -> int:
    """Angular velocity (or acceleration) of a link: from its base, or as the link it is led by."""
    if link == FRAME:
        return pen.given("nought")
    if not pen.has(quantity, link):
        pen.want(quantity, link, rate_of(pen, link, quantity))
    return pen.the(quantity, link)


def rate_of(pen: Pen, link: str, quantity: str) -> int:
    """The step that finds an angular velocity or acceleration that is not known yet."""
    if not pen.turns(link):
        return pen.given("nought", name=f"no {quantity}")
    base = pen.bases[link]
    if base.end is None:
        return omega_of(pen, pen.leads[link], quantity)
    plan = BY_TARGET[quantity].kind
    index = (against if plan == "velocity" else about)(pen, base.end, base.start)
    places = pen.the("position", base.start), pen.the("position", base.end)
    images = pen.the(plan, base.start), pen.the(plan, base.end)
    letters = letter(base.start), letter(base.end)
    with pen.on(Part.RESULT, Plane.NUMBERS), pen.calls_for(None):
        return turning_of_link(pen, quantity, link, letters, index, (places, images))


def image_under(pen: Pen, link: str, point: str) -> int:
    """The image of the point of a known link that lies under a point: its velocity there."""
    return carried(pen, link, point, "velocity")


def second_image_under(pen: Pen, link: str, point: str) -> int:
    """The second image of the point of a known link under a point: its acceleration there."""
    return carried(pen, link, point, "acceleration")


def carried(pen: Pen, link: str, point: str, quantity: str) -> int:
    """The image of the point of a link under another, in either plan.

    What does not turn has one image for all its points; else the link's figure is similar to it.
    """
    plane = Plane.VELOCITIES if quantity == "velocity" else Plane.ACCELERATIONS
    if link == FRAME:
        return pen.pole(plane)
    if not pen.turns(link):
        return shifted(pen, link, point, quantity)
    if point in pen.scene.link(link).points:
        return pen.the(quantity, point)
    name = under(point, link)
    if not pen.has(quantity, name):
        pen.want("position", name, pen.the("position", point))
        pen.want(quantity, name, found_under(pen, link, point, quantity))
        if quantity == "velocity":
            base = pen.bases[link]
            velocity_arrows(pen, name, base.start if base.end is None else None)
        else:
            acceleration_arrow(pen, name)
    return pen.the(quantity, name)


def shifted(pen: Pen, link: str, point: str, quantity: str) -> int:
    """The image of a point of a link that only shifts: on that of its others, under its letter."""
    start, name = pen.bases[link].start, under(point, link)
    number = pen.the(quantity, start)
    if point in pen.scene.link(link).points or not is_in_scene(point):
        return number
    if not pen.has(quantity, name):
        called = image(name) if quantity == "velocity" else second_image(name)
        pen.want("position", name, pen.the("position", point))
        with pen.on(pen.steps[number].part, pen.steps[number].plane):
            found = translated_image(pen, number, (letter(start), letter(name)), called)
        pen.shared["fallen", found] = number
        pen.want(quantity, name, found)
    return pen.the(quantity, name)


def source_of(pen: Pen, number: int) -> int:
    """The image on which that of a point of a link that only shifts falls, or the image itself."""
    return pen.shared.get(("fallen", number), number)


def found_under(pen: Pen, link: str, point: str, quantity: str) -> int:
    """The step that finds the image of a point of a link under another."""
    base, name = pen.bases[link], under(point, link)
    start = pen.the(quantity, base.start)
    places = [pen.the("position", base.start), pen.the("position", point)]
    if base.end is None:
        return found_by_turning(pen, link, point, quantity)
    if base.end == name:
        return pen.the(quantity, base.end)
    ends = start, pen.the(quantity, base.end)
    with pen.on(Part.SHAPE, Plane.NUMBERS):
        ratio = pen.draw(in_proportion, places[0], pen.the("position", base.end), places[1])
    letters = letter(base.start), letter(base.end), letter(name)
    is_velocity = quantity == "velocity"
    part = Part.VELOCITY if is_velocity else Part.ACCELERATION
    plane = Plane.VELOCITIES if is_velocity else Plane.ACCELERATIONS
    with pen.on(part, plane):
        called = image(name) if is_velocity else second_image(name)
        whole = "" if is_velocity else lettered(name)
        return image_of_link(pen, (*ends, ratio), letters, name=called, whole=whole)


def found_by_turning(pen: Pen, link: str, point: str, quantity: str) -> int:
    """The image of a point of a link whose turning is known, from that of its base."""
    base, name = pen.bases[link], under(point, link)
    start = pen.the(quantity, base.start)
    turning = omega_of(pen, link)
    if quantity == "velocity":
        places = pen.the("position", base.start), pen.the("position", point)
        letters, called = (base.start, letter(name)), image(name)
        with pen.on(Part.VELOCITY, Plane.VELOCITIES):
            return turned_image(pen, link, letters, start, places, name=called, omega=turning)
    steady = pen.is_nought(omega_of(pen, link, EPSILON))
    points, called = (base.start, name), second_image(name)
    with pen.on(Part.ACCELERATION, Plane.ACCELERATIONS):
        return turned_acceleration.turned_image(
            pen, link, points, start, name=called, steady=steady
        )
