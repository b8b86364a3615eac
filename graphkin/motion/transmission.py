"""Transmission angles of dyads, and pressure angles of blocks and cams, with customary limits.

The limits are rules of thumb. R. L. Norton, Design of Machinery, keeps the transmission angle above
40 degrees. His Cam Design and Manufacturing Handbook, figure 7-2, keeps the pressure angle below 30
degrees for a translating follower, and below 35 degrees for one on a pivoted arm. The pressure
angle of a block is the complement of the transmission angle between its rod and the normal of its
guide. The speed of a follower over the driver's is the reciprocal of the mechanical advantage.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

import numpy as np

from graphkin.construction.core.cam_profiles import CamProfile
from graphkin.construction.core.program import Target
from graphkin.motion.course import Reals
from graphkin.motion.cycle import Cycle
from graphkin.motion.extremes import (
    RATE_OF,
    SAME,
    Columns,
    Extremes,
    Measure,
    asked_measures,
    extremes,
)
from graphkin.motion.follower_limits import movers_of
from graphkin.scene.model import FRAME, Scene
from graphkin.structure.groups import Dyad
from graphkin.structure.pairs import Pin, Sliding
from graphkin.structure.turning import guide_line

LEAST_TRANSMISSION = 40.0
"""The customary least transmission angle, in degrees."""
MOST_PRESSURE = {"block": 90 - LEAST_TRANSMISSION, "follower": 30.0, "lever": 35.0}
"""The customary largest pressure angle (degrees) of a block, and of a cam's follower or lever."""

USUAL = 1e-5 / SAME
"""The size against which an angle is rounding at 1e-5 degrees: at dead points it is a square root
of rounding."""


def angle_measures(cycle: Cycle) -> Iterator[Measure]:
    """The angles that show how well a mechanism passes on forces.

    They are the transmission angle of every dyad of two bars, the pressure angle of every block
    that a rod moves along the frame, and the pressure angle of every cam.
    """
    course = cycle.path.ranges[0][0].course
    for group in course.groups:
        if isinstance(group, Dyad) and isinstance(group.inner, Pin):
            yield from of_dyad(cycle.scene, group)
    for follower in cycle.scene.cams:
        yield from of_cam(cycle.scene, follower, course.program.targets)


def ratio_measures(cycle: Cycle) -> Iterator[Measure]:
    """The speed of every follower over that of a single driver, without friction and sign.

    It is the reciprocal of the mechanical advantage: where it is largest, a force on the driver
    moves the least load, and at a dead point of the follower it is zero.
    """
    driver = cycle.sweep.driver
    pace = 0.0 if driver is None else abs(float(driver.speed.si(cycle.scene.values)))
    if driver is None or not pace:
        return
    over = f"{'ω' if driver.kind == 'turn' else 'v'}_{driver.link}"
    for mover in movers_of(cycle):
        letter = "v" if mover.line is None else "ω"
        unit = {("v", "turn"): "m", ("ω", "slide"): "1/m"}.get((letter, driver.kind), "")
        label = f"|{letter}_{mover.name}/{over}|, 1 over the mechanical advantage"
        rate = RATE_OF[mover.speed[0]], mover.name
        yield speed_ratio(mover.name, label, unit, mover.speed, rate, pace)


def speed_ratio(
    name: str, label: str, unit: str, speed: Target, rate: Target, pace: float
) -> Measure:
    """The size of the speed of one follower over the speed (SI) of the driver."""

    def value(columns: Columns) -> Reals:
        return np.asarray(np.abs(columns[speed]) / pace)

    def slope(columns: Columns) -> Reals:
        return np.asarray(columns[speed] * columns[rate])

    return Measure(
        "speed ratio", name, label, unit, (speed,), value, (speed, rate), slope, np.square, 1.0
    )


def all_extremes(cycle: Cycle, *, ratios: bool = False) -> tuple[tuple[Extremes, ...], ...]:
    """The extremes of what the scene asks for and of these angles, range by range.

    With ``ratios``, also those of the followers' speeds over the driver's.
    """
    measures = (*asked_measures(cycle), *angle_measures(cycle))
    measures += tuple(ratio_measures(cycle)) if ratios else ()
    return tuple(extremes(cycle, measures, i) for i in range(len(cycle.path.ranges)))


def of_dyad(scene: Scene, dyad: Dyad) -> Iterator[Measure]:
    """The angle of a dyad whose links are pinned to each other, if it has one."""
    match dyad.left, dyad.right:
        case Pin() as left, Pin() as right:
            yield transmission(left.place, inner_pin(dyad), right.place, dyad.links)
        case (Pin() as pin, Sliding() as guide) | (Sliding() as guide, Pin() as pin):
            if guide.slide.on == FRAME:
                yield block_pressure(scene, pin.place, inner_pin(dyad), guide)


def inner_pin(dyad: Dyad) -> str:
    """The point of the pin between the two links of a dyad."""
    assert isinstance(dyad.inner, Pin)
    return dyad.inner.place


def transmission(first: str, pin: str, second: str, links: tuple[str, str]) -> Measure:
    """The acute angle at a pin between the lines of two links to their other pins."""
    targets = tuple(("position", point) for point in (first, pin, second))

    def value(columns: Columns) -> Reals:
        start, middle, end = (columns[target] for target in targets)
        return acute((start - middle) / (end - middle))

    words = f"transmission angle at {pin} of links {' and '.join(links)}"
    name = "transmission angle"
    least = LEAST_TRANSMISSION
    return Measure(
        name, pin, words, "°", targets, value, smooth=rounded, usual=USUAL, least_allowed=least
    )


def block_pressure(scene: Scene, outer: str, pin: str, guide: Sliding) -> Measure:
    """The acute angle between a rod and the guide of the block that it moves along the frame."""
    targets = tuple(("position", point) for point in (outer, pin))
    along = guide_line(scene, guide.slide).along

    def value(columns: Columns) -> Reals:
        start, end = (columns[target] for target in targets)
        return acute((end - start) / along)

    return pressure(guide.block, f"block {guide.block}", targets, value, MOST_PRESSURE["block"])


def pressure(
    of: str, words: str, targets: tuple[Target, ...], value: Callable[[Columns], Reals], most: float
) -> Measure:
    """The measure of a pressure angle with its customary limit."""
    words, name = f"pressure angle of {words}", "pressure angle"
    return Measure(
        name, of, words, "°", targets, value, smooth=rounded, usual=USUAL, most_allowed=most
    )


def of_cam(scene: Scene, follower: str, known: Mapping[Target, int]) -> Iterator[Measure]:
    """The pressure angle of a cam on its follower, if the position of the cam is a target."""
    cam = scene.cams[follower]
    target = "slide" if cam.slides else "axis", cam.on
    carrier = () if cam.slides or cam.carrier == FRAME else (("axis", cam.carrier),)
    if not {target, *carrier} <= {*known}:
        return

    def value(columns: Columns) -> Reals:
        given = columns[target]
        if not cam.slides:
            for axis in carrier:
                given = given / columns[axis]
            given = np.angle(given)
        return np.asarray(CamProfile(scene, follower, given=given).pressure)

    most = MOST_PRESSURE["lever" if cam.lever else "follower"]
    yield pressure(follower, f"the cam of link {follower}", (target, *carrier), value, most)


def rounded(angle: Reals) -> Reals:
    """The squared sine of an acute angle (degrees), which has no corners at 0 and 90 degrees."""
    return np.asarray(np.sin(np.radians(angle)) ** 2)


def acute(ratio: Reals) -> Reals:
    """The acute angles (degrees) between lines whose directions have a complex ratio."""
    return np.asarray(np.degrees(np.arctan2(np.abs(ratio.imag), np.abs(ratio.real))))
