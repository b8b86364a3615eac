"""The data that a reader of a page can change: parameters, and the places of several drivers."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from msgspec import Struct

from graphkin.construction.core.naming import angle_symbol
from graphkin.construction.core.parameter_words import parameter_symbol, quantities, unit_of
from graphkin.construction.links.counted_turn import counted_link
from graphkin.mechanism import Mechanism
from graphkin.motion.driving import TURN
from graphkin.motion.sweep import sweep_of
from graphkin.scene.model import Driver, Scene, quantities_within
from graphkin.scene.quantity import LENGTHS, Quantity


class GivenFigure(Struct, frozen=True):
    """A number that can be changed: its input, its key on the page, markup of its symbol, where it
    stands and how far and in which steps it goes, in its unit.

    ``parameter`` is that of the scene; else ``driver`` is one of several, and the number is how far
    that is led from where it would be at the time, ``metres`` what one unit of it is.
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
    """All figures of a mechanism; where its pins tell how often links went round, which is known
    along the time alone, no driver is led aside."""
    counted = any(counted_link(step) is not None for step in mechanism.program.steps)
    scene = mechanism.scene
    return (*of_parameters(scene), *(() if counted else of_drivers(scene)))


def of_parameters(scene: Scene) -> Iterator[GivenFigure]:
    """The parameters with a range that tell how fast drivers are, or how long links."""
    free = [quantity.place for quantity in lengths_and_rates(scene)]
    places = {driver.position.place for driver in scene.drivers}
    for name, each in scene.parameters.items():
        uses = {quantity.place for quantity in quantities(scene) if name in quantity.uses()}
        if each.minimum is None or each.maximum is None or uses <= places:
            continue  # where a driver stands its own slider or handle says
        if uses <= {*free, *places}:
            low, high = (float(end.number({})) for end in (each.minimum, each.maximum))
            start = float(Fraction(str(scene.values[name])))
            step = (high - low) / 100 if each.step is None else float(each.step.number({}))
            symbol = parameter_symbol(name)
            if low <= start <= high and low < high:
                unit, input_name = unit_of(scene, name), f"figure {name}"
                yield GivenFigure(input_name, name, symbol, start, low, high, step, unit, name)


def lengths_and_rates(scene: Scene) -> Iterator[Quantity]:
    """The numbers by which a page can draw otherwise: speeds, and lengths of links that move."""
    for driver in scene.drivers:
        yield from (driver.speed, driver.acceleration)
    for link in scene.links.values():
        if not link.wheels and link.cam is None:
            yield from quantities_within(tuple(link.placings))


def of_drivers(scene: Scene) -> Iterator[GivenFigure]:
    """Each driver of several."""
    for number, driver in enumerate(scene.drivers if len(scene.drivers) > 1 else (), 1):
        unit, metres, low, high, step = "deg", 1.0, -TURN, TURN, 1.0
        if driver.kind != "turn":
            unit = scene.units["length"]
            metres = float(LENGTHS[unit])
            sweep = sweep_of(scene, driver=number)
            low, high = ((end - sweep.start) / metres for end in (sweep.low, sweep.high))
            step = (high - low) / TURN
        symbol = angle_symbol(scene, driver)
        of, span = (f"figure of driver {number}", f"drive{number}", symbol), (0.0, low, high, step)
        yield GivenFigure(*of, *span, unit, driver=driver, metres=metres)
