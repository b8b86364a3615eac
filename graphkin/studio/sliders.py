"""The parameters of a scene as sliders: the exact values at which each may stand."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from math import ceil, floor, log10

from graphkin.paper.settings import unit_of
from graphkin.scene.expression import TIME
from graphkin.scene.model import Parameter, Scene
from graphkin.scene.quantity import Quantity, shortest

MOST = 1000
"""Places of a slider at most; where a scene allows more, a slider stands at some of them."""
FINE = 200
"""Places, about, of a slider to which the scene gives no step."""
HALF = Fraction(1, 2)
"""How far a slider without a bound goes either way, in parts of its value."""


@dataclass(frozen=True, slots=True)
class Slider:
    """A parameter: its value as set, the values at which its slider stands, and which is nearest.

    ``low`` and ``high`` are its bounds as the scene states them, empty where it states none.
    """

    name: str
    value: str
    unit: str
    stops: tuple[str, ...]
    index: int
    low: str
    high: str


def sliders(scene: Scene) -> Iterator[Slider]:
    """A slider for each parameter, in the order of the scene."""
    for name, parameter in scene.parameters.items():
        if name != TIME:
            yield slider(scene, parameter)


def slider(scene: Scene, parameter: Parameter) -> Slider:
    """The slider of one parameter, as it is set."""
    value = Fraction(str(scene.values[parameter.name]))
    places = stops(parameter, value)
    nearest = min(range(len(places)), key=lambda i: abs(places[i] - value))
    return Slider(
        parameter.name,
        written(value),
        unit_of(scene, parameter.name),
        tuple(map(written, places)),
        nearest,
        bound(parameter.minimum),
        bound(parameter.maximum),
    )


def written(value: Fraction) -> str:
    """A value as a setting takes it, exact: a decimal where it ends, else a fraction."""
    text = shortest(value)
    return text if Fraction(text) == value else f"{value.numerator}/{value.denominator}"


def bound(quantity: Quantity | None) -> str:
    """A bound as it is shown."""
    return "" if quantity is None else written(plain(quantity))


def plain(quantity: Quantity) -> Fraction:
    """The value of a quantity without parameters."""
    return Fraction(quantity.number({}))


def stops(parameter: Parameter, value: Fraction) -> list[Fraction]:
    """The values at which a slider stands: on the steps, within the bounds, both ends included."""
    own = plain(parameter.value)
    least = plain(parameter.minimum) if parameter.minimum else None
    most = plain(parameter.maximum) if parameter.maximum else None
    span = abs(own) * HALF or Fraction(1)
    low = least if least is not None else min(own - span, value)
    high = most if most is not None else max(own + span, value)
    if parameter.step:
        step = plain(parameter.step)
        start = least if least is not None else own
    else:
        step, start = fine(high - low), Fraction(0)
    first, last = ceil((low - start) / step), floor((high - start) / step)
    stride = max(1, ceil(Fraction(last - first, MOST)))
    found = [start + step * k for k in range(first, last + 1, stride)]
    if parameter.step:
        return found or [own]
    return sorted({low, *found, high})


def fine(span: Fraction) -> Fraction:
    """A round step, 1, 2 or 5 at some power of ten, that cuts a span into about so many."""
    if not span:
        return Fraction(1)
    power = Fraction(10) ** floor(log10(span / FINE))
    return next(step for m in (1, 2, 5, 10) if (step := m * power) * FINE >= span)
