"""The point of a link under another link's point: its images in both plans."""

from __future__ import annotations

from graphkin.construction.core.arrows import acceleration_arrow, component_arrow, velocity_arrows
from graphkin.construction.core.bases import under
from graphkin.construction.core.effect import Effect
from graphkin.construction.core.pen import (
    Pen,
    Says,
    about,
    against,
    image,
    letter,
    owned,
    second_image,
)
from graphkin.construction.core.program import CONTACT, Part, Plane
from graphkin.construction.core.vocabulary import (
    alike,
    centripetal,
    difference,
    driven_tangential,
    epsilon,
    in_proportion,
    omega,
    similar_point,
    sum_of,
    turned_velocity,
)
from graphkin.construction.rolling.wheel_actions import speed_rolled
from graphkin.scene.model import FRAME

RATES = {"omega": ("velocity", omega), "epsilon": ("acceleration", epsilon)}


def omega_of(pen: Pen, link: str, quantity: str = "omega") -> int:
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
    plan, action = RATES[quantity]
    points = (base.start, base.end)
    ends = [pen.the(what, point) for what in ("position", plan) for point in points]
    with pen.on(Part.RESULT, Plane.NUMBERS), pen.calls_for(None):
        says: Says = {"p": letter(base.start), "q": letter(base.end)}
        says["i"] = (against if plan == "velocity" else about)(pen, base.end, base.start)
        return pen.draw(action, *ends, name=link, **says)


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
    if point in pen.scene.link(link).points or point.startswith(CONTACT):
        return number
    if not pen.has(quantity, name):
        called = image(name) if quantity == "velocity" else second_image(name)
        pen.want("position", name, pen.the("position", point))
        with pen.on(pen.steps[number].part, pen.steps[number].plane):
            found = pen.draw(alike, number, name=called, p=letter(start), q=letter(name))
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
    says: Says = {"p": letter(base.start), "q": letter(base.end), "r": letter(name)}
    is_velocity = quantity == "velocity"
    says |= {} if is_velocity else {"w": owned(name)}
    part = Part.VELOCITY if is_velocity else Part.ACCELERATION
    plane = Plane.VELOCITIES if is_velocity else Plane.ACCELERATIONS
    with pen.on(part, plane):
        called = image(name) if is_velocity else second_image(name)
        return pen.draw(similar_point, *ends, ratio, name=called, **says)


def found_by_turning(pen: Pen, link: str, point: str, quantity: str) -> int:
    """The image of a point of a link whose turning is known, from that of its base."""
    base, name = pen.bases[link], under(point, link)
    start = pen.the(quantity, base.start)
    ends = pen.the("position", base.start), pen.the("position", point)
    says: Says = {"p": base.start, "q": letter(name), "s": pen.steps[start].name, "k": link}
    turning = omega_of(pen, link)
    if quantity == "velocity":
        with pen.on(Part.VELOCITY, Plane.VELOCITIES):
            return pen.draw(turned_velocity, start, *ends, turning, name=image(name), **says)
    rate, called = omega_of(pen, link, "epsilon"), second_image(name)
    says |= {"i": about(pen, name, base.start), "w": owned(name)}
    steady = pen.is_nought(rate)
    with pen.on(Part.ACCELERATION, Plane.ACCELERATIONS):
        with pen.calls_for(Effect.NORMAL):
            given = called if steady else ""
            corner = pen.draw(centripetal, start, *ends, turning, name=given, **says)
        if not steady or start != pen.pole(Plane.ACCELERATIONS):
            component_arrow(pen, start, corner, "ν", name, base.start)
        if steady:
            return corner
        with pen.calls_for(tangential_effect(pen, rate)):
            found = pen.draw(driven_tangential, corner, *ends, rate, name=called, **says)
        component_arrow(pen, corner, found, "τ", name, base.start)
        return found


def tangential_effect(pen: Pen, rate: int) -> Effect:
    """A tangential component is a driver's where its rate holds what that is accelerated by."""
    return Effect.DRIVER if accelerated(pen, rate) else Effect.TANGENTIAL


def accelerated(pen: Pen, rate: int) -> bool:
    """Whether a rate is a driver's acceleration, alone or with another's, and not nought."""
    step = pen.steps[rate]
    if step.given is not None:
        given = {drive.acceleration for drive in pen.drives.values()}
        return rate in given and not pen.is_nought(rate)
    passed_on = step.action in (sum_of, difference, speed_rolled)
    return passed_on and any(accelerated(pen, arg) for arg in step.args)
