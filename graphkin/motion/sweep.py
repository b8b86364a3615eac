"""The variable of a cycle: one driver's position, or the time when several drivers move.

The scene is rewritten with named values in place of its drivers' numbers. The construction and the
residual check then take arrays for these names, as for any parameter.

The window of a sweep: one turn, the travel of a slide, or the time shown.

The whole turns of links along a sweep, where wheels depend on them.

A position shows the direction of a link, but not how many turns it has made since its wheels were
at the start. Along a motion this is known, because the angle is continuous. The angles near which
links count are therefore followed from the position in which the scene states them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import isfinite, pi, radians, sqrt
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.compile import without_idle_sides
from graphkin.motion.driving import (
    COORDINATES,
    GRID,
    TURN,
    Coordinate,
    What,
    motion_at,
    reach_of,
    stated_motion,
)
from graphkin.numbers.arithmetic import np
from graphkin.scene.expression import TIME, Name
from graphkin.scene.model import FRAME, Branch, Driver, Scene
from graphkin.scene.quantity import Quantity
from graphkin.structure.wheel_groups import counted_near
from graphkin.text.errors import SceneError, message, verbatim

Reals = np.ndarray[Any, np.dtype[Any]]


def name_of(link: str) -> str:
    """The name of the angle near which a link counts; no parameter can have such a name."""
    return f"turned {link}"


def named_angles(scene: Scene) -> tuple[dict[str, Quantity], dict[str, Any]]:
    """The angles near which links count, as named values in degrees, and their values."""
    near = counted_near(scene)
    values = {name_of(link): degrees_of(angle, scene) for link, angle in near.items()}
    named = {link: Quantity(name_of(link), Name(name_of(link)), "deg") for link in near}
    return named, values


def degrees_of(angle: Quantity, scene: Scene) -> Any:
    """An angle in degrees, exact where it is stated in degrees."""
    if angle.unit == "deg":
        return angle.number(scene.values)
    return float(np.degrees(angle.si(scene.values)))


class Turned(Struct, frozen=True, eq=False):
    """The angles (degrees) near which links count, each from a u in ``at`` on: (N,)."""

    at: Reals
    near: Mapping[str, Reals]

    def values(self, at: Any) -> dict[str, Any]:
        """The named angles at any u; before the first u, the first angles hold."""
        here = np.maximum(np.searchsorted(self.at, at, side="right") - 1, 0)
        return {name_of(link): row[here] for link, row in self.near.items()}

    def beside(self, other: Turned | None) -> Turned:
        """With the additional links of another."""
        more = {} if other is None else {k: n for k, n in other.near.items() if k not in self.near}
        if other is None or not more:
            return self
        at = np.union1d(self.at, other.at)
        near = {**self.values(at), **Turned(other.at, more).values(at)}
        return Turned(at, {link: near[name_of(link)] for link in (*self.near, *more)})

    def joined(self, other: Turned | None) -> Turned:
        """With the values of u of another that follow."""
        if other is None:
            return self
        both = {link: np.append(row, other.near[link]) for link, row in self.near.items()}
        return Turned(np.append(self.at, other.at), both)

    def within(self, low: float, high: float) -> Turned:
        """The part from one u to another."""
        here = (low < self.at) & (self.at < high)
        first = self.values(low)
        near = {link: np.append(first[name_of(link)], row[here]) for link, row in self.near.items()}
        return Turned(np.append(low, self.at[here]), near)

    def moved(self, by: float, gone: Mapping[str, float]) -> Turned:
        """The same motion shifted by ``by``, with links turned further by ``gone`` (degrees)."""
        near = {link: row + gone.get(link, 0.0) for link, row in self.near.items()}
        return Turned(self.at + by, near)


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
            raise SceneError.at(option, verbatim(f"{bound:g}"), message("a finite number"))
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
        if number is not None and (way := wheel_turn(scene, scene.drivers[number - 1])):
            back = ahead = way / 2
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
        raise SceneError.at("--from, --to", found, message("a window that grows"))
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


def wheel_turn(scene: Scene, driver: Driver) -> float:
    """The path of a driver in one turn of its wheel, or of the largest wheel on its rack (m).

    Zero without such a wheel, or if no radius is given.
    """
    rolling = [scene.links[driver.link]] if driver.kind == "roll" else []
    if driver.kind == "slide":
        rolling = [
            link
            for link in scene.every_link
            if any(each.on == driver.link and each.through is not None for each in link.rolls)
        ]
    radii = [link.wheels[0].radius for link in rolling if link.wheels]
    ways = [2 * pi * float(radius.si(scene.values)) for radius in radii if radius is not None]
    return max(ways, default=0.0)


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
    raise SceneError.at(
        "drivers",
        message("no driver makes a whole turn or turns back again and again"),
        message("a time to end"),
        message("say with --from and --to which seconds to show"),
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


class Sweep(Struct, frozen=True, eq=False):
    """A scene whose drivers are named values, and the coordinate u that moves them.

    u is the swept driver's position in degrees or metres, or the time in seconds. ``start`` is the
    scene's own u, ``low`` to ``high`` the window. ``whole`` means that the window is one full turn.
    ``number`` counts drivers from 1 and is None for the time. ``usual`` is the length of the
    default window, in the unit of u. ``stated`` means that a bound of the window is given.
    """

    scene: Scene
    original: Scene
    what: What
    number: int | None
    start: float
    low: float
    high: float
    whole: bool
    usual: float
    stated: bool = False

    @property
    def coordinate(self) -> Coordinate:
        """The kind of coordinate of u."""
        return COORDINATES[self.what]

    @property
    def is_length(self) -> bool:
        return self.unit == "m"

    @property
    def unit(self) -> str:
        """Unit of u: deg, m or s."""
        return self.coordinate.unit

    @property
    def symbol(self) -> str:
        """Letter of u: phi, s or t."""
        return self.coordinate.name

    @property
    def driver(self) -> Driver | None:
        """The swept driver in the original scene; None for the time."""
        return None if self.number is None else self.original.drivers[self.number - 1]

    @property
    def runs_backwards(self) -> bool:
        """Whether u decreases with time."""
        return self.driver is not None and self.driver.speed.si(self.original.values) < 0

    @property
    def at_scene(self) -> float:
        """The u at which the scene is drawn: its start, or the time that it states."""
        time = self.original.time
        if self.what != "time" or time is None:
            return self.start
        return float(time.si(self.original.values))

    @property
    def per_unit(self) -> float:
        """Radians, metres or seconds in one unit of u."""
        return pi / 180 if self.what == "turn" else 1.0

    @property
    def grid_step(self) -> float:
        """The grid step in the search for events, independent of the window."""
        return self.usual / GRID

    def with_branches(
        self, branches: Mapping[str, Branch], here: Mapping[str, Any] | None = None
    ) -> Scene:
        """The scene, ready for arrays, with the given closures and the values of one position."""
        found: Mapping[str, Any] = self.scene.values if here is None else here
        values = {k: float(v[0]) if hasattr(v, "shape") else v for k, v in found.items()}
        return replace(self.scene, branches=dict(branches), values=values)

    def values(self, at: Any, *, geometric: bool = False) -> dict[str, Any]:
        """All values of the scene for an array of u (N,): parameters, and every driver's motion.

        ``geometric`` moves the swept driver at speed 1 (rad/s, m/s) without acceleration, so that
        velocities are derivatives by its position. With the time as u they are derivatives anyway.
        """
        values: dict[str, Any] = dict(self.scene.values)
        for n, driver in enumerate(self.original.drivers, 1):
            if self.what == "time":
                motion = motion_at(driver, dict(self.original.values), at)
            elif n != self.number:
                continue
            elif geometric:
                motion = (at, 1.0, 0.0)
            else:
                continue_at = stated_motion(driver, self.original)
                motion = (at, *continue_at[1:])
            values |= dict(zip(names(n), motion, strict=True))
        return values


def names(number: int) -> tuple[str, str, str]:
    """Names of a driver's position, speed and acceleration; no parameter can have such a name."""
    return (f"drive {number} position", f"drive {number} speed", f"drive {number} acceleration")


def inputs(scene: Scene) -> frozenset[str]:
    """The names of the values by which a sweep sets the drivers of a scene."""
    return frozenset(name for n, _ in enumerate(scene.drivers, 1) for name in names(n))


def sweep_of(
    scene: Scene, *, driver: int | None = None, low: float | None = None, high: float | None = None
) -> Sweep:
    """The sweep of a scene, over one driver's position or over the time.

    With ``driver``, that driver moves and the others are at rest; by default the only driver moves,
    or the time runs. ``low`` and ``high`` (degrees, metres or seconds) set the window. Sides that
    parallel bars decide are left out. Raises SceneError.
    """
    scene = without_idle_sides(scene)
    number = chosen(scene, driver)
    what: What = "time" if number is None else scene.drivers[number - 1].kind
    start = 0.0
    if number is not None:
        start = stated_motion(scene.drivers[number - 1], scene)[0]
        if what == "turn" and not scene.touching:  # |else wheels count its turns
            start %= TURN
    first, last, whole = window(scene, what, number, start, low, high)
    way = usual(scene, what, number, first, last)
    stated = low is not None or high is not None
    return Sweep(named(scene, number), scene, what, number, start, first, last, whole, way, stated)


def chosen(scene: Scene, driver: int | None) -> int | None:
    """The swept driver, counted from 1; None where the time is swept."""
    drivers = scene.drivers
    if not drivers:
        raise SceneError.at("drivers", message("none"), message("a driver to be moved"))
    if driver is not None:
        if not 1 <= driver <= len(drivers):
            expected = (
                message("1 to {most}", most=len(drivers))
                if len(drivers) > 1
                else message("1, the only driver")
            )
            raise SceneError.at(
                "--driver", message("there is no driver {driver}", driver=driver), expected
            )
        return driver
    return None if len(drivers) > 1 or law_of_time(scene) else 1


def law_of_time(scene: Scene) -> bool:
    """Whether any driver's position depends on the time."""
    return any(TIME in driver.position.uses() for driver in scene.drivers)


def named(scene: Scene, number: int | None) -> Scene:
    """The scene with named values for its drivers and for the angles near which links are counted.

    Drivers that are not swept are at rest.
    """
    drivers, values = [], dict(scene.values)
    for n, driver in enumerate(scene.drivers, 1):
        unit = "deg" if driver.kind == "turn" else "m"
        base = "rad" if driver.kind == "turn" else "m"
        position, speed, acceleration = (
            Quantity(name, Name(name), each, f"drivers.{n}")
            for name, each in zip(names(n), (unit, f"{base}/s", f"{base}/s²"), strict=True)
        )
        drivers.append(replace(driver, position=position, speed=speed, acceleration=acceleration))
        place, rate, push = stated_motion(driver, scene)
        held = number is not None and n != number
        motion = (place, 0.0, 0.0) if held else (place, rate, push)
        values |= dict(zip(names(n), motion, strict=True))
    near, angles = named_angles(scene)
    return replace(scene, drivers=tuple(drivers), near=near, values=values | angles)


def bounds_in_si(
    scene: Scene, driver: int | None, low: float | None, high: float | None
) -> tuple[float | None, float | None]:
    """Bounds of a window, converted from the scene's unit of length to metres for a sliding driver.

    Degrees and seconds are unchanged.
    """
    number = chosen(scene, driver)
    if number is None or scene.drivers[number - 1].kind == "turn":
        return low, high
    factor = scene.unit_length
    return None if low is None else low * factor, None if high is None else high * factor
