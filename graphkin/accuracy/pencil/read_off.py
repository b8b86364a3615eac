"""What is read off a drawing: vectors, rates and places, their errors, their size on paper."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from enum import Enum
from math import isfinite
from typing import Any

from graphkin.accuracy.pencil.original import Original
from graphkin.construction.core.program import Plane, Step, Target
from graphkin.numbers.plane import Ratio

FAR = 10.0
"""Metres of paper beyond which a centre counts as at infinity: no hand draws it."""


class Sort(Enum):
    """What sort of answer it is."""

    VECTOR = "vector"
    NUMBER = "number"
    PLACE = "place"


@dataclass(frozen=True, slots=True)
class DrawnQuantity:
    """One answer: its target, the step that carries it, its exact value and its scale.

    ``unit`` is the answer's own unit in SI, ``millimetre`` how much of it a millimetre of paper
    stands for; nought where it is not drawn.
    """

    target: Target
    number: int
    sort: Sort
    value: Any
    unit: str
    millimetre: float

    @property
    def size(self) -> float | None:
        """What an error is compared with, in percent; None for a place, whose size says nothing."""
        return None if self.sort is Sort.PLACE else abs(self.value)

    def of(self, found: Mapping[int, Any]) -> Any:
        """The answer in some drawings, an element for each."""
        value = found[self.number]
        return placed(value) if self.sort is Sort.PLACE else value

    def error(self, found: Mapping[int, Any]) -> Any:
        """How far the answer lies from the exact one in some drawings, as a difference."""
        return self.of(found) - self.value


UNITS = {
    "position": "m",
    "velocity": "m/s",
    "acceleration": "m/s²",
    "omega": "rad/s",
    "epsilon": "rad/s²",
    "slide": "m",
    "slide speed": "m/s",
    "slide acceleration": "m/s²",
    "coriolis": "m/s²",
}
"""The unit of each quantity; centres and poles are places, in m."""
VECTORS = ("velocity", "acceleration", "coriolis")
PLANES = {
    "m": Plane.MECHANISM,
    "m/s": Plane.VELOCITIES,
    "m/s²": Plane.ACCELERATIONS,
    "rad/s": Plane.VELOCITIES,
    "rad/s²": Plane.ACCELERATIONS,
}
"""The drawing in which a quantity of each unit is measured."""
LONG_NAMES = {"inflection centre"}
"""Quantities that are there for others."""


def answers(original: Original) -> Iterator[DrawnQuantity]:
    """The answers that hang on what is drawn, in the order asked; places at infinity are left out.

    A rate that is given, or nought because nothing turns, is no answer of the drawing.
    """
    moved = frozenset(original.order)
    for target in original.targets:
        number = original.program.targets[target]
        if number not in moved or target[0] in LONG_NAMES:
            continue
        found = answer(original, target, number)
        if found is not None:
            yield found


def answer(original: Original, target: Target, number: int) -> DrawnQuantity | None:
    """One answer; None for a place that no drawing shows."""
    quantity, _ = target
    value = original.trace.values[number]
    unit = UNITS.get(quantity, "m")
    mm = original.paper.millimetre(PLANES[unit])
    if isinstance(value, Ratio) or quantity not in UNITS or quantity == "position":
        place = placed(value)
        if place is None or not isfinite(abs(place)) or abs(place) > FAR * 1000 * mm:
            return None
        return DrawnQuantity(target, number, Sort.PLACE, place, unit, mm)
    if quantity in VECTORS:
        return DrawnQuantity(target, number, Sort.VECTOR, value, unit, mm)
    if unit.startswith("rad"):
        mm = mm / bar_of(original, original.program.steps[number])
    return DrawnQuantity(target, number, Sort.NUMBER, value, unit, mm)


def bar_of(original: Original, step: Step) -> float:
    """The length of the bar whose relative vector tells a rate; infinite where no bar does."""
    if len(step.args) == 4:
        p, q = (original.trace.values[arg] for arg in step.args[:2])
        return abs(q - p) if isinstance(p, complex) and isinstance(q, complex) else float("inf")
    return float("inf")


def placed(value: Any) -> Any:
    """The point of a centre, by construction or by hand; None for one at infinity."""
    if not isinstance(value, Ratio):
        return value
    if not hasattr(value.size, "shape") and value.size == 0:
        return None
    return value.start + value.shift / value.size
