"""The window of a sweep: one turn, the travel of a slide, or the time shown."""

from __future__ import annotations

from collections.abc import Iterator
from math import isfinite, pi, radians, sqrt
from typing import Any

from graphkin.motion.driving import (
    COORDINATES,
    GRID,
    TURN,
    What,
    motion_at,
    reach_of,
    stated_motion,
)
from graphkin.numbers.arithmetic import np
from graphkin.scene.expression import TIME
from graphkin.scene.model import FRAME, Driver, Link, Scene
from graphkin.text.errors import Problem, SceneError, message, verbatim

DOUBLINGS = 60
"""Doublings of the time in the search for a driver's first full turn."""
FREE = 2.1
"""Reaches on each side of a slide's position: over two, so that no dead point is at the end."""


def window(
    scene: Scene,
    what: What,
    number: int | None,
    start: float,
    low: float | None,
    high: float | None,
) -> tuple[float, float, bool]:
    """The window of the sweep, and whether it is one full turn.

    Missing bounds are filled in: a turn, the travel of a slide, a time. Raises SceneError.
    """
    for option, bound in (("--from", low), ("--to", high)):
        if bound is not None and not isfinite(bound):
            raise SceneError(Problem(option, verbatim(f"{bound:g}"), message("a finite number")))
    if what == "turn" and low is None and high is None:
        return start, start + TURN, True
    if what == "turn":
        first = low if low is not None else (high or 0.0) - TURN
        last = high if high is not None else first + TURN
    elif what == "time":
        first = 0.0 if low is None else low
        last = high if high is not None else first + whole_turn(scene)
    else:
        back = ahead = reach_of(scene) * FREE
        if what != "slide" and number is not None:
            way = wheel_turn(scene.links[scene.drivers[number - 1].link], scene) or ahead
            start, back, ahead = start - way / 2, 0.0, way
        least, most = start - back, start + ahead
        if number is not None:
            least, most = on_one_side(scene, scene.drivers[number - 1], start, least, most)
        first = least if low is None else low
        last = most if high is None else high
    if not first < last:
        found = message(
            "{first:.10g} to {last:.10g} {unit}",
            first=first,
            last=last,
            unit=COORDINATES[what].unit,
        )
        raise SceneError(Problem("--from, --to", found, message("a window that grows")))
    return first, last, False


def on_one_side(
    scene: Scene, driver: Driver, start: float, low: float, high: float
) -> tuple[float, float]:
    """Two positions of a driver, cut at zero for a cylinder: its length keeps its sign."""
    if not start or not is_cylinder(scene, driver):
        return low, high
    return (max(low, 0.0), high) if start > 0 else (low, min(high, 0.0))


def is_cylinder(scene: Scene, driver: Driver) -> bool:
    """Whether a driver sets the length of a cylinder: a rod on one pin in a tube on another.

    Nothing else holds either of them, and the guide passes through the tube's pin, so that the
    length is never negative.
    """
    if driver.kind != "slide" or driver.against == FRAME:
        return False
    rod, tube = scene.link(driver.link), scene.link(driver.against)
    slides = [slide for slide in rod.slides if slide.on == tube.name]
    pins = [
        [
            p
            for p in each.points
            if any(p in other.points for other in scene.every_link if other is not each)
        ]
        for each in (rod, tube)
    ]
    return (
        len(rod.slides) == len(slides) == 1
        and not tube.slides
        and pins == [[rod.points[0]], [slides[0].through]]
        and slides[0].offset.is_zero()
    )


def usual(scene: Scene, what: What, number: int | None, low: float, high: float) -> float:
    """The length of a sweep without stated bounds, in its unit, on which events are searched for.

    A window in time has its own length where the scene determines none.
    """
    try:
        first, last, _ = window(scene, what, number, 0.0, None, None)
    except SceneError:
        return max(high, 0.0) - min(low, 0.0)
    return last - first


def wheel_turn(link: Link, scene: Scene) -> float:
    """The path of a wheel in one turn (m); zero if its radius is not given."""
    radii = [wheel.radius.si(scene.values) for wheel in link.wheels if wheel.radius is not None]
    return 2 * pi * float(radii[0]) if radii else 0.0


def whole_turn(scene: Scene) -> float:
    """The time (s) of the first full turn of a driver, counted from time zero.

    If no driver makes a full turn, it is the time until a driver stops, or until it has slid the
    sum of all lengths. For a law of time, it is the time of one movement to and fro. Raises
    SceneError where there is no such time.
    """
    for driver in scene.drivers:
        if driver.kind != "turn":
            continue
        if TIME in driver.position.uses():
            found = turn_by_law(driver, scene)
        else:
            _, speed, push = stated_motion(driver, scene)
            found = turn_evenly(abs(speed), push if speed >= 0 else -push)
        if found is not None:
            return found
    for driver in scene.drivers:
        span = (to_and_fro if TIME in driver.position.uses() else until_rest)(driver, scene)
        if span is not None:
            return span
    raise SceneError(
        Problem(
            "drivers",
            message("no driver makes a whole turn or turns back again and again"),
            message("a time to end"),
            message("say with --from and --to which seconds to show"),
        )
    )


def until_rest(driver: Driver, scene: Scene) -> float | None:
    """The time after which a driver stops, or has slid the length of the mechanism; or None."""
    _, speed, push = stated_motion(driver, scene)
    if speed * push < 0:
        return -speed / push
    if driver.kind == "turn" or speed == 0:
        return None
    return reach_of(scene) / abs(speed)


def turn_evenly(speed: float, push: float) -> float | None:
    """The time of one turn with constant acceleration, positive in the sense of the speed."""
    if push == 0:
        return radians(TURN) / speed if speed else None
    under = speed * speed + 4 * pi * push
    if under < 0:
        return None
    return 4 * pi / (speed + sqrt(under)) if push > 0 or speed else None


def turn_by_law(driver: Driver, scene: Scene) -> float | None:
    """The time at which a law of time has first turned its driver by a full turn."""
    for times, (angle, _, _) in doubled(driver, scene):
        past = np.flatnonzero(np.abs(angle - angle[0]) >= TURN)
        if past.size:
            low, high = times[past[0] - 1], times[past[0]]
            for _ in range(DOUBLINGS):
                middle = np.array([(low + high) / 2])
                far = abs(motion_at(driver, dict(scene.values), middle)[0][0] - angle[0]) >= TURN
                low, high = (low, middle[0]) if far else (middle[0], high)
            return float(high)
        if not np.isfinite(angle).all():
            return None
    return None


def to_and_fro(driver: Driver, scene: Scene) -> float | None:
    """The time (s) of one movement to and fro, from the first reversal to the third, or None."""
    for times, (_, speed, _) in doubled(driver, scene):
        if not np.isfinite(speed).all():
            return None
        moves = np.flatnonzero(speed)
        back = np.flatnonzero(np.diff(np.sign(speed[moves])))
        if back.size >= 3:
            before, after = moves[back], moves[back + 1]
            share = speed[before] / (speed[before] - speed[after])
            turns = times[before] + (times[after] - times[before]) * share
            return float(turns[2] - turns[0])
    return None


def doubled(driver: Driver, scene: Scene) -> Iterator[tuple[Any, tuple[Any, Any, Any]]]:
    """Times (N,) from zero on, with the driver's motion at them; each span doubles the last."""
    span = 1e-3
    for _ in range(DOUBLINGS):
        times = np.linspace(0, span, GRID + 1)
        yield times, motion_at(driver, dict(scene.values), times)
        if span > 1e6:
            return
        span *= 2
