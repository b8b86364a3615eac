"""Whole turns of drivers that leave every wheel as it stands, taken off before anything rounds."""

from __future__ import annotations

from fractions import Fraction
from math import prod

from graphkin.scene.model import Driver, Rolling, Scene
from graphkin.scene.quantity import Quantity
from graphkin.text.errors import SceneError

MANY = 1000
"""Turns up to which a driver's angle is left as it is written: they cost three digits at most."""


def turned(scene: Scene, driver: Driver) -> Quantity:
    """The angle of a driver, less whole cycles of the wheels where it is many turns.

    Those are taken off the number as the scene states it, without rounding, so that a wheel stands
    right after any number of turns. Angles in radians, and those that roots or sines give, stay.
    """
    try:
        angle = driver.position.number(scene.values)
    except SceneError:
        return driver.position
    turns = cycle(scene)
    plain = isinstance(angle, Fraction) and driver.position.unit == "deg"
    if turns is None or not plain or abs(angle) <= 360 * MANY:
        return driver.position
    return driver.position.less(360 * turns * round(angle / (360 * turns)))


def cycle(scene: Scene) -> int | None:
    """After how many turns of any link all wheels stand as before; None where none is sure.

    A wheel that turns another in the ratio p : q does after p·q turns of either. One that rolls on
    a straight track comes farther with each turn.
    """
    ratios = list[Fraction]()
    for link in scene.every_link:
        for rolling in link.rolls:
            found = ratio(scene, link.name, rolling)
            if found is None:
                return None
            ratios.append(found)
    return prod(each.numerator * each.denominator for each in ratios)


def ratio(scene: Scene, name: str, rolling: Rolling) -> Fraction | None:
    """The ratio of two wheels of fixed radii that roll on one another, their links' only ones."""
    wheels = *scene.link(name).wheels, *scene.link(rolling.on).wheels
    if rolling.through is not None or len(wheels) != 2:
        return None
    radii = [wheel.radius for wheel in wheels if wheel.radius is not None]
    exact = [r for each in radii if not each.uses() and isinstance(r := each.number({}), Fraction)]
    return exact[0] / exact[1] if len(exact) == 2 else None
