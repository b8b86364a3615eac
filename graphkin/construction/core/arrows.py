"""The arrows of the plans: absolute and relative velocities, absolute accelerations."""

from __future__ import annotations

from graphkin.construction.core.pen import PRIME, Pen, about, letter, second_image, step_name
from graphkin.construction.core.plan_vector import PlanVector, foot_of
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.vocabulary import join
from graphkin.scene.link_points import ends_of, lettered, under
from graphkin.scene.model import FRAME


def velocity_arrows(pen: Pen, pin: str, pivot: str | None) -> None:
    """Draw the absolute velocity of a pin, and its velocity relative to a pivot if one is given."""
    arrow_between(pen, pen.pole(Plane.VELOCITIES), pen.the("velocity", pin), pin, "")
    if pivot is not None:
        relative_arrow(pen, pin, pivot)


def relative_arrow(pen: Pen, pin: str, pivot: str) -> None:
    """Draw the velocity of a pin relative to a pivot.

    Draws nothing where either velocity is zero or the two velocities are equal.
    """
    start, tip = pen.the("velocity", pivot), pen.the("velocity", pin)
    if start == tip or pen.pole(Plane.VELOCITIES) in (start, tip):
        return
    if pivot == ends_of(pin)[0]:
        arrow_between(pen, tip, start, pivot, letter(pin))
    else:
        arrow_between(pen, start, tip, pin, letter(pivot))


def arrow_between(pen: Pen, tail: int, tip: int, pin: str, about: str) -> None:
    """Draw the velocity of a point, relative to ``about`` if one is given, unless already drawn."""
    if not has_arrow(pen, tail, tip):
        with pen.on(Part.VELOCITY, Plane.VELOCITIES):
            vector = PlanVector("v", letter(pin) + about, letter(pin), about)
            pen.vector(join, tail, tip, of=vector, name=arrow_name(pen, tail, tip))


def has_arrow(pen: Pen, tail: int, tip: int) -> bool:
    """Whether the plan already has an arrow between two of its points."""
    return arrow_name(pen, tail, tip) in pen.arrows


def arrow_name(pen: Pen, tail: int, tip: int) -> str:
    """The letters of both ends of an arrow."""
    return step_name(pen, tail) + step_name(pen, tip)


def acceleration_arrow(pen: Pen, pin: str) -> None:
    """Draw the absolute acceleration of a pin, from the pole to its image, unless already drawn."""
    o, tip = pen.pole(Plane.ACCELERATIONS), pen.the("acceleration", pin)
    name = f"o{PRIME}{second_image(pin)}"
    if name not in pen.arrows:
        with pen.on(Part.ACCELERATION, Plane.ACCELERATIONS):
            vector = PlanVector("a", lettered(pin), lettered(pin))
            pen.vector(join, o, tip, of=vector, name=name)


def component_arrow(pen: Pen, tail: int, tip: int, kind: str, pin: str, pivot: str) -> None:
    """Draw the normal (ν) or tangential (τ) component of a relative acceleration."""
    index = about(pen, pin, pivot)
    foot = "" if pen.steps[tip].name else foot_of(kind, index)
    vector = PlanVector("a", index, lettered(pin), lettered(pivot), kind, foot=foot)
    pen.vector(join, tail, tip, of=vector)


def slide_arrow(pen: Pen, tail: int, tip: int, link: str, point: str, *, index: str = "") -> None:
    """Draw a relative acceleration along a moving guide.

    By default this is the acceleration of the point relative to the point of the link under it;
    ``index`` names another one.
    """
    if link == FRAME:
        return
    index = index or letter(point) + letter(under(point, link))
    vector = PlanVector("a", index, point, sign="r")
    if vector.symbol not in pen.arrows:
        pen.vector(join, tail, tip, of=vector)
