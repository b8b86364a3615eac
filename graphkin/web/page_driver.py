"""The driver of a page: the scene's one driver, or the time, as input of a traced program."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from math import floor, log10, pi
from typing import Any

from msgspec import Struct

from graphkin.construction.core.given_data import parameter_symbol, quantities, unit_of
from graphkin.construction.core.naming import angle_symbol
from graphkin.construction.core.program import Program
from graphkin.construction.links.rolled_turn import counted_link
from graphkin.construction.tape.emitted import runner
from graphkin.construction.tape.graph import Graph
from graphkin.construction.tape.traced import TracedNumber, traced_kind
from graphkin.mechanism import Mechanism
from graphkin.motion.driving import COORDINATES, TURN, What, stated_motion
from graphkin.motion.driving import reach_of as sum_of_lengths
from graphkin.motion.pieces import reachable_ranges
from graphkin.motion.sweep import chosen, law_of_time, sweep_of
from graphkin.numbers.arithmetic import np
from graphkin.scene.expression import TIME
from graphkin.scene.model import Driver, Scene, quantities_within
from graphkin.scene.quantity import Quantity
from graphkin.text import Words


class GivenFigure(Struct, frozen=True):
    """A number that can be changed: input, key on the page, markup of its symbol, start and range.

    Start, range and step are in its unit. ``parameter`` is a parameter of the scene. Otherwise
    ``driver`` is one of several drivers, and the number is its offset from its position at the
    time; ``metres`` is the length of one unit of the offset.
    """

    name: str
    key: str
    symbol: str
    start: float
    low: float
    high: float
    step: float
    unit: str
    parameter: str = ""
    driver: Driver | None = None
    metres: float = 1.0


def figures(mechanism: Mechanism) -> tuple[GivenFigure, ...]:
    """All figures of a mechanism.

    Drivers have no figure where pins alone count the turns of links, since those turns are known
    along the time only.
    """
    counted = any(counted_link(step) is not None for step in mechanism.program.steps)
    scene = mechanism.scene
    return (*of_parameters(scene), *(() if counted else of_drivers(scene)))


def of_parameters(scene: Scene) -> Iterator[GivenFigure]:
    """The parameters with a range that set speeds of drivers or lengths of links."""
    free = [quantity.place for quantity in lengths_and_rates(scene)]
    places = {driver.position.place for driver in scene.drivers}
    for name, each in scene.parameters.items():
        uses = {quantity.place for quantity in quantities(scene) if name in quantity.uses()}
        if each.minimum is None or each.maximum is None or uses <= places:
            continue  # the slider or the handle of the driver sets its position
        if uses <= {*free, *places}:
            low, high = (float(end.number({})) for end in (each.minimum, each.maximum))
            start = float(Fraction(str(scene.values[name])))
            step = (high - low) / 100 if each.step is None else float(each.step.number({}))
            symbol = parameter_symbol(name)
            if low <= start <= high and low < high:
                unit, input_name = unit_of(scene, name), f"figure {name}"
                yield GivenFigure(input_name, name, symbol, start, low, high, step, unit, name)


def lengths_and_rates(scene: Scene) -> Iterator[Quantity]:
    """The quantities that a page can change: speeds, and lengths of moving links."""
    for driver in scene.drivers:
        yield from (driver.speed, driver.acceleration)
    for link in scene.links.values():
        if not link.wheels and link.cam is None:
            yield from quantities_within(tuple(link.placings))


def of_drivers(scene: Scene) -> Iterator[GivenFigure]:
    """The figure of each driver, if there are several."""
    for number, driver in enumerate(scene.drivers if len(scene.drivers) > 1 else (), 1):
        unit, metres, low, high, step = "deg", 1.0, -TURN, TURN, 1.0
        if driver.kind != "turn":
            unit = scene.units["length"]
            metres = scene.unit_length
            sweep = sweep_of(scene, driver=number)
            low, high = ((end - sweep.start) / metres for end in (sweep.low, sweep.high))
            step = 10.0 ** floor(log10(sum_of_lengths(scene) / metres / 1000))
        symbol = angle_symbol(scene, driver)
        of, span = (f"figure of driver {number}", f"drive{number}", symbol), (0.0, low, high, step)
        yield GivenFigure(*of, *span, unit, driver=driver, metres=metres)


# --- the driver of a page -------------------------------------------------------------------------


INPUT = "driver"
"""The name of the input: the driver's position, or the time."""
GRID = 720
"""Number of positions per turn at which the closure is tested: one every half degree."""
FINER = 65
"""Number of positions between two of them in each round of the search for the end of a range."""
ROUNDS = 7
"""Number of rounds: the last positions are some 1e-13 of the first distance apart."""
LEAST = 1e-6
"""Least part of the window that counts as a range rather than a single position."""
PARTS = 360
"""Number of slider moves across a range, unless the range spans many degrees."""


class PageDriver(Struct, frozen=True):
    """The driver of a page (None for the time) and its position, in ``unit``.

    ``metres`` is the length of one unit of a sliding driver; ``figures`` are the data that can be
    changed.
    """

    scene: Scene
    driver: Driver | None
    what: What
    start: float
    unit: str
    metres: float = 1.0
    figures: tuple[GivenFigure, ...] = ()

    @property
    def number(self) -> int | None:
        """The number of the driver among those of the scene, from 1; None for the time."""
        own = self.driver
        return None if own is None else self.scene.drivers.index(own) + 1

    @property
    def name(self) -> str:
        """The letter of the coordinate, as markup."""
        return f"*{COORDINATES[self.what].letter}*"

    @property
    def datum(self) -> str:
        """The symbol of the driver in the data; with several drivers it names the link."""
        return angle_symbol(self.scene, self.driver) if self.driver else self.name

    @property
    def sense(self) -> int:
        """The sense of the driver's speed, 1 or -1; time runs forward."""
        driver = self.driver
        return -1 if driver is not None and driver.speed.si(self.scene.values) < 0 else 1

    def unit_in(self, words: Words) -> str:
        """Its unit as printed after a number."""
        return words("unit.deg") if self.unit == "deg" else f" {words.spelled(self.unit)}"

    @property
    def pins(self) -> tuple[str, ...]:
        """The points of the driven link; none for a time."""
        return () if self.driver is None else tuple(self.scene.link(self.driver.link).points)

    def overrides(
        self, program: Program, x: TracedNumber, known: Mapping[str, Any]
    ) -> dict[int, Any]:
        """The values of the drivers' own steps at a traced position or time.

        ``known`` are the parameters and figures.
        """
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
        """The steps that hold a driver's position, which is in degrees or metres."""
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
    """The driver of a scene's page; None without a driver.

    It is the scene's only driver, or driver ``number`` of several while the others do not move, or
    the time.
    """
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
    metres = scene.unit_length
    return PageDriver(scene, driver, driver.kind, place / metres, unit, metres, figures)


def time_of(scene: Scene) -> float:
    """The time of a scene's position, in seconds."""
    return 0.0 if scene.time is None else float(scene.time.number(scene.values))


class Reach(Struct, frozen=True):
    """The range of a mechanism around its position; ``whole`` means a full free turn."""

    low: float
    high: float
    whole: bool

    @property
    def step(self) -> float:
        """The change of the driver for one move of a slider."""
        return 1.0 if self.high - self.low > PARTS / 4 else (self.high - self.low) / PARTS


CHANGE = 1e-6
"""Distance beside a change point at which a mechanism closes, in parts of the window."""


def window(driven: PageDriver) -> tuple[float, float]:
    """The window that is searched: one turn to each side, or as far as a cycle goes."""
    if driven.what == "turn":
        return driven.start - TURN, driven.start + TURN
    sweep = sweep_of(driven.scene, driver=driven.number)
    if driven.what == "time":
        return min(sweep.low, driven.start), driven.start + sweep.high
    low, high = reachable_ranges(sweep).spans[0]
    return low / driven.metres, high / driven.metres


def reach_of(
    driven: PageDriver, graph: Graph, closed: Sequence[int], near: Callable[[Any], dict[str, Any]]
) -> Reach | None:
    """The range around the start where the outputs ``closed`` are finite; None for one position.

    ``near`` gives the other inputs of the graph at positions of the driver. A gap narrower than
    half a degree may be missed; a change point, where rounding decides, is none.
    """
    low, high = window(driven)
    at = np.linspace(low, high, 2 * GRID + 1)

    run = runner(graph, closed)

    def is_finite(places: Any) -> Any:
        good = np.ones(len(places), dtype=bool)
        for values in run({INPUT: places, **near(places)}):
            good &= np.isfinite(values)
        return good

    def closes(places: Any) -> Any:
        good = is_finite(places)
        if not good.all():
            bad, beside = places[~good], CHANGE * (high - low)
            good[~good] = is_finite(bad - beside) & is_finite(bad + beside)
        return good

    return around(driven, at, closes)


def around(driven: PageDriver, at: Any, closes: Any) -> Reach | None:
    """The range around the start, with its ends refined in rounds."""
    here = int(np.abs(at - driven.start).argmin())
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
