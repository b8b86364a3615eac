"""Positions of a drawing: a few equal steps of the driver, from the scene or from a dead point."""

from __future__ import annotations

from typing import Literal, get_args

import numpy as np

from graphkin.motion.course import Reals
from graphkin.motion.cycle import Cycle
from graphkin.motion.driving import stated_motion
from graphkin.motion.follower_limits import followers
from graphkin.motion.pieces import ALIKE
from graphkin.text.errors import SceneError, message

Start = Literal["scene", "dead"]
"""Where positions are counted from: the scene's own position, or a dead point."""
STARTS: tuple[Start, ...] = get_args(Start)


def equal_positions(cycle: Cycle, count: int, start: Start = "scene") -> Cycle:
    """The cycle at ``count`` equal steps of the driver in the range of the scene.

    A driver that turns fully takes ``count`` positions. In a range, only positions inside it have a
    row. Raises SceneError as ``equal_places`` does.
    """
    return cycle.along(equal_places(cycle, count, start))


def equal_places(
    cycle: Cycle, count: int, start: Start | float, place: str = "--positions-from"
) -> Reals:
    """The places u (N,) of ``count`` equal steps in the range of the scene, with its ends.

    They follow the motion: where the driver runs backwards, u falls.

    ``start`` may be a u itself. ``dead`` starts at the dead point that begins the range, or where
    the last follower that reverses has its low limit. Raises SceneError, about ``place``, if there
    is neither, or if no position lies in the range.
    """
    low, high = cycle.ranges[0]
    whole = cycle.path.whole and cycle.path.returns
    sense = sense_of(cycle)
    step = (cycle.path.period if whole else high - low) / count
    if start == "dead":
        first = dead_point(cycle, place)
    else:
        first = cycle.sweep.at_scene if start == "scene" else float(start)
    if whole:
        return np.asarray(first + sense * step * np.arange(count), float)
    first = cycle.path.found_at(first, low, high)
    numbers = np.arange(-count, count + 1)
    at = first + step * numbers
    at = at[(at >= low - ALIKE * step) & (at <= high + ALIKE * step)]
    if not at.size:
        ends = {"low": low, "high": high, "unit": cycle.sweep.unit}
        raise SceneError.at(
            place,
            message("the first position lies far outside the range of the driver"),
            message("a position from {low:.4g} to {high:.4g} {unit}", **ends),
        )
    return np.asarray(at if sense > 0 else at[::-1], float)


def sense_of(cycle: Cycle) -> float:
    """1, or -1 where the driver runs backwards."""
    driver = cycle.sweep.driver
    if driver is None:
        return 1.0
    _, speed, _ = stated_motion(driver, cycle.sweep.original)
    return -1.0 if speed < 0 else 1.0


def dead_point(cycle: Cycle, place: str) -> float:
    """The dead point that begins the range, or a dead point of the last follower that reverses."""
    pieces = cycle.path.ranges[0]
    begin = pieces[0].low if sense_of(cycle) > 0 else pieces[-1].high
    if begin.kind == "dead":
        return begin.at
    found = [each.low.at for each in followers(cycle) if each.limits and not each.low.edge]
    if not found:
        raise SceneError.at(
            place,
            message("neither the driver nor a follower has a dead point"),
            message("the position of the scene"),
        )
    return found[-1]


def step_of(found: Cycle) -> tuple[float, float]:
    """The first position of some equal ones, and the step between them."""
    at: Reals = found.at
    return float(at[0]), float(at[1] - at[0]) if len(at) > 1 else 0.0
