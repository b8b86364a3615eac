"""What moves a page: the scene's one driver, or the time, as the only input of a traced program."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from math import pi
from typing import Any

from msgspec import Struct

from graphkin.construction.core.naming import angle_symbol
from graphkin.construction.core.program import Program
from graphkin.construction.tape.graph import Graph
from graphkin.construction.tape.tape_outputs import runner
from graphkin.construction.tape.traced import TracedNumber
from graphkin.construction.tape.tracer import traced_kind
from graphkin.motion.driving import COORDINATES, TURN, What, stated_motion
from graphkin.motion.sweep import chosen, law_of_time, sweep_of
from graphkin.numbers.arrays import np
from graphkin.scene.expression import TIME
from graphkin.scene.model import Driver, Scene
from graphkin.scene.quantity import LENGTHS
from graphkin.text import Words
from graphkin.web.figures import GivenFigure

INPUT = "driver"
"""The name of the input: the driver's position, or the time."""
GRID = 720
"""Positions at which it is looked whether the mechanism closes: every half degree of a turn."""
FINER = 65
"""Positions tried between two of them for the end of a range, again and again."""
ROUNDS = 7
"""How often: the last places lie some 1e-13 of the first distance apart."""
LEAST = 1e-6
"""The least part of what is looked at that is a range and no mere place."""
PARTS = 360
"""How many moves of a slider lead through a range that is not one of many degrees."""


class PageDriver(Struct, frozen=True):
    """What moves: the driver (None for the time), and where it stands, in ``unit``.

    ``metres`` is what one unit of a driver along a line is, ``figures`` are the numbers of the data
    that can be changed.
    """

    scene: Scene
    driver: Driver | None
    what: What
    start: float
    unit: str
    metres: float = 1.0
    figures: tuple[GivenFigure, ...] = ()

    @property
    def name(self) -> str:
        """The letter of what moves, as markup."""
        return f"*{COORDINATES[self.what].letter}*"

    @property
    def datum(self) -> str:
        """Its symbol as among the data: with the link's name where several drive."""
        return angle_symbol(self.scene, self.driver) if self.driver else self.name

    @property
    def sense(self) -> int:
        """In which sense it goes, by the driver's speed; a time runs on."""
        driver = self.driver
        return -1 if driver is not None and driver.speed.si(self.scene.values) < 0 else 1

    def unit_in(self, words: Words) -> str:
        """Its unit, as it follows a number."""
        return words("unit.deg") if self.unit == "deg" else f" {self.unit}"

    @property
    def pins(self) -> tuple[str, ...]:
        """The points of the link that is driven; none of a time."""
        return () if self.driver is None else tuple(self.scene.link(self.driver.link).points)

    def overrides(
        self, program: Program, x: TracedNumber, known: Mapping[str, Any]
    ) -> dict[int, Any]:
        """The values of the drivers' own steps for a traced position or time; ``known`` are the
        parameters and figures."""
        found: dict[int, Any] = {}
        for driver, drive in zip(self.scene.drivers, program.drives, strict=True):
            if self.driver is not None:
                if driver is self.driver:
                    place = x if self.what == "turn" else x * self.metres
                    found |= self.placed(drive, driver, place)
                continue
            place, speed, push = self.timed(driver, x, known)
            found |= self.placed(drive, driver, place)
            found |= {drive.speed: speed, drive.acceleration: push}
        return found

    def angles(self, x: TracedNumber, known: Mapping[str, Any]) -> dict[str, Any]:
        """The angle in degrees of each link that a driver turns, by its name."""
        found: dict[str, Any] = {}
        for driver in self.scene.drivers:
            if driver.kind == "turn":
                moves = self.driver in (None, driver)
                here = x if self.driver is not None else self.timed(driver, x, known)[0]
                found[driver.link] = here if moves else stated_motion(driver, self.scene)[0]
        return found

    def placed(self, drive: Any, driver: Driver, place: Any) -> dict[int, Any]:
        """The steps that hold a driver's position, in degrees or metres."""
        if driver.kind != "turn":
            return {drive.position: place}
        found = {drive.position: traced_kind().direction(place)}
        return found if drive.angle is None else found | {drive.angle: place * (pi / 180)}

    def timed(
        self, driver: Driver, time: TracedNumber, known: Mapping[str, Any]
    ) -> tuple[Any, Any, Any]:
        """Position (degrees or metres), speed and acceleration of a driver at a traced time."""
        kind, law = traced_kind(), TIME in driver.position.uses()
        values = {**known, TIME: time} if law else known
        rates = (driver.speed, driver.acceleration)
        speed, push = (rate.si(values, kind) for rate in rates)
        in_degrees = 180 / pi if driver.kind == "turn" else 1
        if law:
            place = driver.position.si(values, kind) * in_degrees
        else:
            since = time - self.start
            place = (
                stated_motion(driver, self.scene)[0]
                + (speed + push * since / 2) * since * in_degrees
            )
            speed = speed + push * since
        led = next((each for each in self.figures if each.driver is driver), None)
        return (place if led is None else place + known[led.name] * led.metres), speed, push


def driven_by(
    scene: Scene, figures: tuple[GivenFigure, ...] = (), number: int | None = None
) -> PageDriver | None:
    """What moves a scene: its only driver, or driver ``number`` of several while the others stand
    still, else the time; None without a driver."""
    if not scene.drivers:
        return None
    number = None if number is None and law_of_time(scene) else chosen(scene, number)
    if number is None:
        return PageDriver(scene, None, "time", time_of(scene), "s", figures=figures)
    driver = scene.drivers[number - 1]
    place = stated_motion(driver, scene)[0]
    if driver.kind == "turn":
        return PageDriver(scene, driver, "turn", place, "deg", figures=figures)
    unit = scene.units["length"]
    metres = float(LENGTHS[unit])
    return PageDriver(scene, driver, driver.kind, place / metres, unit, metres, figures)


def time_of(scene: Scene) -> float:
    """The time at which a scene stands, in seconds."""
    return 0.0 if scene.time is None else float(scene.time.number(scene.values))


class Reach(Struct, frozen=True):
    """How far a mechanism moves from where it stands; ``whole`` tells a turn that is free."""

    low: float
    high: float
    whole: bool

    @property
    def step(self) -> float:
        """How far one move of a slider leads."""
        return 1.0 if self.high - self.low > PARTS / 4 else (self.high - self.low) / PARTS


def window(driven: PageDriver) -> tuple[float, float]:
    """How far it is looked: a turn, or as far as the sweeps of a cycle go."""
    if driven.what == "turn":
        return driven.start - TURN, driven.start + TURN
    own = driven.driver
    number = None if own is None else driven.scene.drivers.index(own) + 1
    sweep = sweep_of(driven.scene, driver=number)
    if driven.what == "time":
        return min(sweep.low, driven.start), driven.start + sweep.high
    return sweep.low / driven.metres, sweep.high / driven.metres


def reach_of(
    driven: PageDriver, graph: Graph, closed: Sequence[int], near: Callable[[Any], dict[str, Any]]
) -> Reach | None:
    """The range about the start in which some outputs are finite; None where it is a mere place.

    ``near`` gives the further inputs of the graph at places of the driver. A gap narrower than half
    a degree may be passed.
    """
    low, high = window(driven)
    at = np.linspace(low, high, 2 * GRID + 1)

    run = runner(graph, closed)

    def closes(places: Any) -> Any:
        found = run({INPUT: places, **near(places)})
        good = np.ones(len(places), dtype=bool)
        for values in found:
            good &= np.isfinite(values)
        return good

    return around(driven, at, closes)


def around(driven: PageDriver, at: Any, closes: Any) -> Reach | None:
    """The range about the start, its ends looked for ever more finely."""
    good = closes(at)
    here = int(np.abs(at - driven.start).argmin())
    if driven.what == "turn" and good[here - GRID // 2 : here + GRID // 2 + 1].all():
        first = TURN * np.floor(driven.start / TURN)
        return Reach(float(first), float(first + TURN), True)
    ends = []
    for sense in (-1, 1):
        places = at[here::sense]
        bad = np.flatnonzero(~closes(places))
        if not bad.size:
            ends.append(float(places[-1]))
            continue
        inside, outside = places[max(int(bad[0]) - 1, 0)], places[int(bad[0])]
        inside = inside if bad[0] else driven.start
        for _ in range(ROUNDS):
            between = np.linspace(inside, outside, FINER)
            last = int(np.flatnonzero(np.cumprod(closes(between)))[-1:].max(initial=0))
            inside, outside = between[last], between[min(last + 1, FINER - 1)]
        ends.append(float(inside))
    low, high = ends
    return Reach(low, high, False) if high - low > LEAST * float(at[-1] - at[0]) else None
