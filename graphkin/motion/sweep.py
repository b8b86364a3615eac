"""The variable of a cycle: one driver's position, or the time when several drivers move.

The scene is rewritten with named values in place of its drivers' numbers. The construction and the
residual check then take arrays for these names, as for any parameter.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import pi
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.flat_rods import without_idle_sides
from graphkin.motion.driving import (
    COORDINATES,
    GRID,
    TURN,
    Coordinate,
    What,
    motion_at,
    stated_motion,
)
from graphkin.motion.turns_counted import named_angles
from graphkin.motion.window import usual, window
from graphkin.scene.expression import TIME, Name
from graphkin.scene.model import Branch, Driver, Scene
from graphkin.scene.quantity import Quantity
from graphkin.text.errors import Problem, SceneError, message


class Sweep(Struct, frozen=True, eq=False):
    """A scene whose drivers are named values, and the coordinate u that moves them.

    u is the swept driver's position in degrees or metres, or the time in seconds. ``start`` is the
    scene's own u, ``low`` to ``high`` the window. ``whole`` means that the window is one full turn.
    ``number`` counts drivers from 1 and is None for the time. ``usual`` is the length of the
    default window, in the unit of u.
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
    scene: Scene,
    *,
    driver: int | None = None,
    low: float | None = None,
    high: float | None = None,
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
    return Sweep(named(scene, number), scene, what, number, start, first, last, whole, way)


def chosen(scene: Scene, driver: int | None) -> int | None:
    """The swept driver, counted from 1; None where the time is swept."""
    drivers = scene.drivers
    if not drivers:
        raise SceneError(Problem("drivers", message("none"), message("a driver to be moved")))
    if driver is not None:
        if not 1 <= driver <= len(drivers):
            expected = (
                message("1 to {most}", most=len(drivers))
                if len(drivers) > 1
                else message("1, the only driver")
            )
            raise SceneError(
                Problem("--driver", message("there is no driver {driver}", driver=driver), expected)
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
