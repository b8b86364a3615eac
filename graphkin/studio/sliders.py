"""The parameters of a scene as sliders: the exact values at which each may stand."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import lru_cache
from math import ceil, floor, log10

from msgspec import Struct

from graphkin.classroom.lab.rules import exact_text
from graphkin.construction.core.parameter_words import unit_of
from graphkin.scene.expression import TIME
from graphkin.scene.model import Parameter, Scene
from graphkin.scene.parameters import plain
from graphkin.scene.quantity import Quantity

MOST = 1000
"""Places of a slider at most; where a scene allows more, a slider stands at some of them."""
FINE = 200
"""Places, about, of a slider to which the scene gives no step."""
HALF = Fraction(1, 2)
"""How far a slider without a bound goes either way, in parts of its value."""


class ParameterSlider(Struct, frozen=True):
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


def sliders(scene: Scene) -> Iterator[ParameterSlider]:
    """A slider for each parameter, in the order of the scene."""
    for name, parameter in scene.parameters.items():
        if name != TIME:
            yield slider(scene, parameter)


def slider(scene: Scene, parameter: Parameter) -> ParameterSlider:
    """The slider of one parameter, as it is set."""
    value = Fraction(str(scene.values[parameter.name]))
    low, high = ends(parameter, value)
    step = plain(parameter.step) if parameter.step else None
    places, names = stops(plain(parameter.minimum or parameter.value), low, high, step)
    return ParameterSlider(
        parameter.name,
        exact_text(value),
        unit_of(scene, parameter.name),
        names,
        nearest(places, value),
        bound(parameter.minimum),
        bound(parameter.maximum),
    )


def bound(quantity: Quantity | None) -> str:
    """A bound as it is shown."""
    return "" if quantity is None else exact_text(plain(quantity))


def nearest(places: Sequence[Fraction], value: Fraction) -> int:
    """The index of the place nearest to a value; the lower of two equally near."""
    after = bisect_left(places, value)
    beside = [i for i in (after - 1, after) if 0 <= i < len(places)]
    return min(beside, key=lambda i: abs(places[i] - value))


def ends(parameter: Parameter, value: Fraction) -> tuple[Fraction, Fraction]:
    """How far a slider goes: to the bounds, or where there are none, about its own value."""
    own = plain(parameter.value)
    least = plain(parameter.minimum) if parameter.minimum else None
    most = plain(parameter.maximum) if parameter.maximum else None
    span = abs(own) * HALF or Fraction(1)
    low = least if least is not None else min(own - span, value)
    high = most if most is not None else max(own + span, value)
    return low, high


@lru_cache(maxsize=256)
def stops(
    start: Fraction, low: Fraction, high: Fraction, step: Fraction | None
) -> tuple[Sequence[Fraction], tuple[str, ...]]:
    """The values at which a slider stands, and how they are written: the same while it moves.

    They lie on the steps from ``start``; without steps on round values, both ends included.
    """
    stride, begin = (fine(high - low), Fraction(0)) if step is None else (step, start)
    first, last = ceil((low - begin) / stride), floor((high - begin) / stride)
    each = max(1, ceil(Fraction(last - first, MOST)))
    found = [begin + stride * k for k in range(first, last + 1, each)]
    places = sorted({low, *found, high}) if step is None else found or [start]
    return places, tuple(map(exact_text, places))


def fine(span: Fraction) -> Fraction:
    """A round step, 1, 2 or 5 at some power of ten, that cuts a span into about so many."""
    if not span:
        return Fraction(1)
    power = Fraction(10) ** floor(log10(span / FINE))
    return next(step for m in (1, 2, 5, 10) if (step := m * power) * FINE >= span)
