"""The arrows of the plans: absolute and relative velocities, absolute accelerations."""

from __future__ import annotations

from graphkin.plans.pen import PRIME, Pen, letter, named, owned, second_image
from graphkin.steps.program import Part, Plane
from graphkin.steps.vocabulary import join


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
    if pivot == pin.partition("@")[0]:
        arrow_between(pen, tip, start, pivot, letter(pin))
    else:
        arrow_between(pen, start, tip, pin, letter(pivot))


def arrow_between(pen: Pen, tail: int, tip: int, pin: str, about: str) -> None:
    """The arrow of the velocity of a point, against another if that is named; drawn once."""
    name = named(pen, tail) + named(pen, tip)
    if name not in pen.arrows:
        with pen.on(Part.VELOCITY, Plane.VELOCITIES):
            symbol = f"v_{letter(pin)}{about}"
            pen.arrow(join, tail, tip, name=name, symbol=symbol, q=letter(pin), p=about)


def acceleration_arrow(pen: Pen, pin: str) -> None:
    """The arrow from the pole to a second image, the absolute acceleration; drawn once."""
    o, tip = pen.pole(Plane.ACCELERATIONS), pen.the("acceleration", pin)
    name = f"o{PRIME}{second_image(pin)}"
    if name not in pen.arrows:
        with pen.on(Part.ACCELERATION, Plane.ACCELERATIONS):
            symbol = f"a_{owned(pin)}"
            pen.arrow(join, o, tip, name=name, symbol=symbol, q=owned(pin), p="")
