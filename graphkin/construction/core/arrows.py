"""The arrows of the plans: absolute and relative velocities, absolute accelerations."""

from __future__ import annotations

from graphkin.construction.core.pen import PRIME, Pen, about, letter, second_image, step_name
from graphkin.construction.core.plan_vector import PlanVector, foot_of
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.vocabulary import join
from graphkin.scene.link_points import ends_of, lettered, under
from graphkin.scene.model import FRAME


def velocity_arrows(pen: Pen, pin: str, pivot: str | None) -> None:
    """The arrows of a plan to an image: the absolute velocity, and the one relative to a pivot."""
    arrow_between(pen, pen.pole(Plane.VELOCITIES), pen.the("velocity", pin), pin, "")
    if pivot is not None:
        relative_arrow(pen, pin, pivot)


def relative_arrow(pen: Pen, pin: str, pivot: str) -> None:
    """The arrow of the velocity of a pin relative to a pivot, where both move and not alike."""
    start, tip = pen.the("velocity", pivot), pen.the("velocity", pin)
    if start == tip or pen.pole(Plane.VELOCITIES) in (start, tip):
        return
    if pivot == ends_of(pin)[0]:
        arrow_between(pen, tip, start, pivot, letter(pin))
    else:
        arrow_between(pen, start, tip, pin, letter(pivot))


def arrow_between(pen: Pen, tail: int, tip: int, pin: str, about: str) -> None:
    """The arrow of the velocity of a point, against another if that is named; drawn once."""
    if not has_arrow(pen, tail, tip):
        with pen.on(Part.VELOCITY, Plane.VELOCITIES):
            vector = PlanVector("v", letter(pin) + about, letter(pin), about)
            pen.vector(join, tail, tip, of=vector, name=arrow_name(pen, tail, tip))


def has_arrow(pen: Pen, tail: int, tip: int) -> bool:
    """Whether the plan has an arrow from one of its points to another."""
    return arrow_name(pen, tail, tip) in pen.arrows


def arrow_name(pen: Pen, tail: int, tip: int) -> str:
    """The letters of both ends."""
    return step_name(pen, tail) + step_name(pen, tip)


def acceleration_arrow(pen: Pen, pin: str) -> None:
    """The arrow from the pole to a second image, the absolute acceleration; drawn once."""
    o, tip = pen.pole(Plane.ACCELERATIONS), pen.the("acceleration", pin)
    name = f"o{PRIME}{second_image(pin)}"
    if name not in pen.arrows:
        with pen.on(Part.ACCELERATION, Plane.ACCELERATIONS):
            vector = PlanVector("a", lettered(pin), lettered(pin))
            pen.vector(join, o, tip, of=vector, name=name)


def component_arrow(pen: Pen, tail: int, tip: int, kind: str, pin: str, pivot: str) -> None:
    """The arrow of a normal (ν) or tangential (τ) component."""
    index = about(pen, pin, pivot)
    foot = "" if pen.steps[tip].name else foot_of(kind, index)
    vector = PlanVector("a", index, lettered(pin), lettered(pivot), kind, foot=foot)
    pen.vector(join, tail, tip, of=vector)


def slide_arrow(pen: Pen, tail: int, tip: int, link: str, point: str, *, index: str = "") -> None:
    """The arrow of a relative acceleration along a guide that moves.

    It is that of the point against the link's own under it, if no ``index`` says otherwise.
    """
    if link == FRAME:
        return
    index = index or letter(point) + letter(under(point, link))
    vector = PlanVector("a", index, point, sign="r")
    if vector.symbol not in pen.arrows:
        pen.vector(join, tail, tip, of=vector)
