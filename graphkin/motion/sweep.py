"""What is moved through a cycle: one driver's position, or the time when several drivers move.

The scene is written anew with named values in place of its drivers' numbers; the construction and
the witness then take arrays for these names as they take arrays for any parameter.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import degrees, pi, radians, sqrt
from typing import Any, Literal

from graphkin.arithmetic import batch_kind
from graphkin.errors import Problem, SceneError
from graphkin.scene.expression import TIME, Name
from graphkin.scene.model import At, Branch, Driver, Link, Scene
from graphkin.scene.quantity import LENGTHS, Quantity

What = Literal["turn", "slide", "roll", "time"]
TURN = 360.0
GRID = 7200
"""Positions tried in a sweep when its events are looked for: in one turn every 0.05 degrees."""
DOUBLINGS = 60
"""How often the time is doubled to find a driver's first whole turn."""
FREE = 2.1
"""Reaches to each side of where a slide stands: over two, so that no dead point falls there."""
UNITS = {"turn": "deg", "slide": "m", "roll": "m", "time": "s"}
SYMBOLS = {"turn": "phi", "slide": "s", "roll": "s", "time": "t"}


@dataclass(frozen=True, slots=True, eq=False)
class Sweep:
    """A scene whose drivers are named values, and the coordinate u that moves them.

    u is the swept driver's position in degrees or metres, or the time in seconds; ``start`` is
    where the scene stands, ``low`` to ``high`` the window. ``whole`` tells that the window is one
    turn, which closes on itself. ``number`` counts drivers from 1, None for the time.
    """

    scene: Scene
    original: Scene
    what: What
    number: int | None
    start: float
    low: float
    high: float
    whole: bool

    @property
    def unit(self) -> str:
        """Unit of u: deg, m or s."""
        return UNITS[self.what]

    @property
    def symbol(self) -> str:
        """Letter of u: phi, s or t."""
        return SYMBOLS[self.what]

    @property
    def driver(self) -> Driver | None:
        """The swept driver as the scene has it; None for the time."""
        return None if self.number is None else self.original.drivers[self.number - 1]

    @property
    def per_unit(self) -> float:
        """Radians, metres or seconds in one unit of u."""
        return pi / 180 if self.what == "turn" else 1.0

    @property
    def grid_step(self) -> float:
        """The step of the grid on which events are looked for."""
        return (self.high - self.low) / GRID

    def with_branches(self, branches: Mapping[str, Branch], here: float | None = None) -> Scene:
        """The scene, ready for arrays, with its closures picked as given, standing at a place u."""
        values = self.scene.values
        if here is not None:
            import numpy as np

            found = self.values(np.array([here]))
            values = {k: float(v[0]) if hasattr(v, "shape") else v for k, v in found.items()}
        return replace(self.scene, branches=dict(branches), values=values)

    def values(self, at: Any, *, geometric: bool = False) -> dict[str, Any]:
        """All values of the scene for an array of u (N,): parameters, and every driver's motion.

        ``geometric`` lets the swept driver move at speed 1 (rad/s, m/s) without acceleration, so
        that velocities are derivatives by its position; with the time they are so anyhow.
        """
        values: dict[str, Any] = dict(self.scene.values)
        for n, driver in enumerate(self.original.drivers, 1):
            if self.what == "time":
                motion = timed(driver, dict(self.original.values), at)
            elif n != self.number:
                continue
            elif geometric:
                motion = (at, 1.0, 0.0)
            else:
                continue_at = stated(driver, self.original)
                motion = (at, *continue_at[1:])
            values |= dict(zip(names(n), motion, strict=True))
        return values


def names(number: int) -> tuple[str, str, str]:
    """Names of a driver's position, speed and acceleration; no parameter can be called so."""
    return (f"drive {number} position", f"drive {number} speed", f"drive {number} acceleration")


def sweep_of(
    scene: Scene,
    *,
    driver: int | None = None,
    low: float | None = None,
    high: float | None = None,
) -> Sweep:
    """The sweep of a scene: its only driver, driver number ``driver`` while the others stand still,
    or else the time.

    ``low`` and ``high`` (degrees, metres or seconds) narrow or widen the window. Raises SceneError.
    """
    number = chosen(scene, driver)
    what: What = "time" if number is None else scene.drivers[number - 1].kind
    start = 0.0
    if number is not None:
        start = stated(scene.drivers[number - 1], scene)[0]
        start = start % TURN if what == "turn" else start
    first, last, whole = window(scene, what, number, start, low, high)
    return Sweep(named(scene, number), scene, what, number, start, first, last, whole)


def chosen(scene: Scene, driver: int | None) -> int | None:
    """The driver that is swept, counted from 1; None when the time is."""
    drivers = scene.drivers
    if not drivers:
        raise SceneError(Problem("drivers", "none", "a driver to be moved"))
    if driver is not None:
        if not 1 <= driver <= len(drivers):
            expected = f"1 to {len(drivers)}"
            raise SceneError(Problem("--driver", f"there is no driver {driver}", expected))
        return driver
    return None if len(drivers) > 1 or law_of_time(scene) else 1


def law_of_time(scene: Scene) -> bool:
    """Whether any driver moves by a law of the time."""
    return any(TIME in driver.position.uses() for driver in scene.drivers)


def named(scene: Scene, number: int | None) -> Scene:
    """The scene with named values in place of its drivers' numbers; what is not swept stands."""
    drivers, values = [], dict(scene.values)
    for n, driver in enumerate(scene.drivers, 1):
        unit = "deg" if driver.kind == "turn" else "m"
        base = "rad" if driver.kind == "turn" else "m"
        position, speed, acceleration = (
            Quantity(name, Name(name), each, f"drivers.{n}")
            for name, each in zip(names(n), (unit, f"{base}/s", f"{base}/s²"), strict=True)
        )
        drivers.append(driver._replace(position=position, speed=speed, acceleration=acceleration))
        place, rate, push = stated(driver, scene)
        stands = number is not None and n != number
        motion = (place, 0.0, 0.0) if stands else (place, rate, push)
        values |= dict(zip(names(n), motion, strict=True))
    return replace(scene, drivers=tuple(drivers), values=values)


def stated(driver: Driver, scene: Scene) -> tuple[float, float, float]:
    """Position (degrees or m), speed and acceleration (rad or m) of a driver as it stands."""
    number = driver.position.number(scene.values)
    place = float(driver.position.si(scene.values))
    if driver.kind == "turn":
        place = float(number) if driver.position.unit == "deg" else degrees(place)
    return place, float(driver.speed.si(scene.values)), float(driver.acceleration.si(scene.values))


def timed(driver: Driver, values: dict[str, Any], at: Any) -> tuple[Any, Any, Any]:
    """Position (degrees or m), speed and acceleration of a driver at given times (N,).

    A driver without a law moves from its stated position, at the time nought, with its stated
    speed, evenly accelerated.
    """
    import numpy as np

    law = TIME in driver.position.uses()
    here = values | ({TIME: at} if law else {})
    kind = batch_kind()
    place, speed, push = (
        quantity.si(here, kind) for quantity in (driver.position, driver.speed, driver.acceleration)
    )
    if not law:
        place, speed = place + (speed + push * at / 2) * at, speed + push * at
    if driver.kind == "turn":
        place = np.degrees(place)
    return tuple(np.broadcast_to(each, np.shape(at)) for each in (place, speed, push))  # type: ignore[return-value]


def window(
    scene: Scene,
    what: What,
    number: int | None,
    start: float,
    low: float | None,
    high: float | None,
) -> tuple[float, float, bool]:
    """The window of the sweep, and whether it is one turn that closes on itself."""
    if low is not None and high is not None and not low < high:
        raise SceneError(Problem("--from, --to", f"{low:g} to {high:g}", "a window that grows"))
    if what == "turn":
        if low is None and high is None:
            return start, start + TURN, True
        first = low if low is not None else (high or 0.0) - TURN
        return first, high if high is not None else first + TURN, False
    if what == "time":
        first = 0.0 if low is None else low
        return first, high if high is not None else first + whole_turn(scene), False
    room = reach_of(scene) * FREE
    if what == "roll" and number is not None:
        room = wheel_turn(scene.links[scene.drivers[number - 1].link], scene) or room
        start -= room / 2
        return start if low is None else low, start + room if high is None else high, False
    return start - room if low is None else low, start + room if high is None else high, False


def wheel_turn(link: Link, scene: Scene) -> float:
    """The way of a wheel in one turn (m); nought where its radius is not given."""
    radii = [wheel.radius.si(scene.values) for wheel in link.wheels if wheel.radius is not None]
    return 2 * pi * float(radii[0]) if radii else 0.0


def reach_of(scene: Scene) -> float:
    """The sum of all lengths of a scene (m): no point moves farther.

    Where the origin lies does not matter: coordinates count from the first that a link is given.
    """
    lengths: list[Quantity] = []
    places: list[tuple[str, Quantity, Quantity]] = []
    for link in (scene.frame, *scene.links.values()):
        for placing in link.placings:
            lengths += [length for _, _, length in placing.lengths()]
            places += [(link.name, placing.x, placing.y)] if isinstance(placing, At) else []
        for slide in link.slides:
            lengths.append(slide.offset)
            places += [(slide.on, *slide.through)] if isinstance(slide.through, tuple) else []
        lengths += [wheel.radius for wheel in link.wheels if wheel.radius is not None]
    far = sum(abs(float(length.si(scene.values))) for length in lengths)
    first: dict[str, complex] = {}
    for name, x, y in places:
        place = complex(x.si(scene.values), y.si(scene.values))
        way = place - first.setdefault(name, place)
        far += abs(way.real) + abs(way.imag)
    return far or 1.0


def whole_turn(scene: Scene) -> float:
    """The time (s) in which the first turning driver makes one turn from the time nought.

    Where none does, the time until one comes to rest, or has slid as far as all lengths together,
    or in which a law of time moves one once to and fro.
    Raises SceneError where there is no such time.
    """
    for driver in scene.drivers:
        if driver.kind != "turn":
            continue
        if TIME in driver.position.uses():
            found = turn_by_law(driver, scene)
        else:
            _, speed, push = stated(driver, scene)
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
            "no driver makes a whole turn or turns back again and again",
            "a time to end",
            "say with --from and --to which seconds to show",
        )
    )


def until_rest(driver: Driver, scene: Scene) -> float | None:
    """The time in which a driver comes to rest, or slides as far as the mechanism is long."""
    _, speed, push = stated(driver, scene)
    if speed * push < 0:
        return -speed / push
    if driver.kind == "turn" or speed == 0:
        return None
    return reach_of(scene) / abs(speed)


def turn_evenly(speed: float, push: float) -> float | None:
    """The time of one turn under even acceleration along the sense of the speed."""
    if push == 0:
        return radians(TURN) / speed if speed else None
    under = speed * speed + 4 * pi * push
    if under < 0:
        return None
    return 4 * pi / (speed + sqrt(under)) if push > 0 or speed else None


def turn_by_law(driver: Driver, scene: Scene) -> float | None:
    """The time at which a law of time has first turned its driver by a whole turn."""
    import numpy as np

    span = 1e-3
    for _ in range(DOUBLINGS):
        times = np.linspace(0, span, GRID + 1)
        angle = timed(driver, dict(scene.values), times)[0]
        past = np.flatnonzero(np.abs(angle - angle[0]) >= TURN)
        if past.size:
            low, high = times[past[0] - 1], times[past[0]]
            for _ in range(DOUBLINGS):
                middle = np.array([(low + high) / 2])
                far = abs(timed(driver, dict(scene.values), middle)[0][0] - angle[0]) >= TURN
                low, high = (low, middle[0]) if far else (middle[0], high)
            return float(high)
        if not np.isfinite(angle).all() or span > 1e6:
            return None
        span *= 2
    return None


def to_and_fro(driver: Driver, scene: Scene) -> float | None:
    """The time (s) in which a law of time moves its driver to and fro: from where it first turns
    back to where it does so for the third time."""
    import numpy as np

    span = 1e-3
    for _ in range(DOUBLINGS):
        times = np.linspace(0, span, GRID + 1)
        speed = timed(driver, dict(scene.values), times)[1]
        if not np.isfinite(speed).all() or span > 1e6:
            return None
        moves = np.flatnonzero(speed)
        back = np.flatnonzero(np.diff(np.sign(speed[moves])))
        if back.size >= 3:
            before, after = moves[back], moves[back + 1]
            share = speed[before] / (speed[before] - speed[after])
            turns = times[before] + (times[after] - times[before]) * share
            return float(turns[2] - turns[0])
        span *= 2
    return None


def bounds_in_si(
    scene: Scene, driver: int | None, low: float | None, high: float | None
) -> tuple[float | None, float | None]:
    """Bounds of a window in the scene's unit of length, where a sliding driver moves, in metres.

    Degrees and seconds stay as they are.
    """
    number = chosen(scene, driver)
    if number is None or scene.drivers[number - 1].kind == "turn":
        return low, high
    factor = float(LENGTHS[scene.units["length"]])
    return tuple(None if each is None else each * factor for each in (low, high))  # type: ignore[return-value]
