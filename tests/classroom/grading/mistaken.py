"""Students with one mistake, or two, that run through the whole sheet; nothing of the marking.

They draw by the formulas of ``hand``. Each mistake is one method of the hand that a student gets
wrong: the task as it is read, the drawing, the ruler, or what is written down.
"""

from __future__ import annotations

import cmath
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import pi, radians

import numpy as np

from tests.classroom.grading import hand
from tests.classroom.grading.hand import Data, Hand

LABS = ("offset-slider-crank", "slotted-lever", "pump")
Sheet = tuple[float, float, float]
"""kL, kv and ka of a sheet."""


@dataclass
class Mistaken(Hand):
    """A hand with some mistakes by name; ``crank_mm`` is the crank's length where it varies."""

    mistakes: frozenset[str] = frozenset()
    crank_mm: float = 0.0
    other: Data | None = None
    other_mm: float = 0.0

    def made(self, name: str) -> bool:
        """Whether a mistake is made."""
        return name in self.mistakes

    # --- the task ------------------------------------------------------------------------------

    def crank(self, given: Data, length: float) -> tuple[complex, complex, complex]:
        length = self.crank_mm or length
        if self.made("another number") and self.other is not None:
            given, length = self.other, self.other_mm or length
        if self.made("diameter"):
            length *= 2
        if self.made("half the radius"):
            length /= 2
        angle = given.angle
        if self.made("clockwise"):
            angle = -angle
        if self.made("protractor"):
            angle = 180 - angle
        omega = given.omega * (-1 if self.made("reversed") else 1)
        way = self.turned(cmath.exp(1j * radians(angle)))
        pin = self.dot(way * self.metres(length))
        way = pin / abs(pin)
        velocity = self.dot(self.turned(1j * way) * length * omega / self.kv)
        size = length * omega**2 / self.ka
        return pin, velocity, self.dot(-self.turned(way) * size)

    def side(self, place: str) -> float:
        return -1.0 if self.made(f"other side of the {place}") else 1.0

    def plate(self, shape: complex) -> complex:
        if self.made("plate flipped"):
            shape = complex(shape).conjugate()
        if self.made("from the other end"):
            shape = 1 - complex(shape).conjugate()
        return shape

    # --- the drawing ---------------------------------------------------------------------------

    def across(self, bar: complex, plan: str) -> complex:
        return bar if self.made("parallel") else 1j * bar

    def relative_normal(self, arrow: complex, bar: complex) -> complex:
        if self.made("no normals"):
            return 0j
        size = self.read(abs(arrow)) ** 2 / abs(bar) * self.square
        turned = self.turned(-bar / abs(bar)) * size
        return -turned if self.made("normals turned") else turned

    # --- the ruler and what is written ---------------------------------------------------------

    def read(self, length: float) -> float:
        told = super().read(length)
        if self.reading_wrongly and self.made("ruler 1:2"):
            told *= 2
        if self.reading_wrongly and self.made("ruler from 10"):
            told += 10 if length >= 0 else -10
        return told

    reading_wrongly: bool = False
    """Only what is handed in is read with the wrong ruler; ``all through`` reads all so."""

    def velocity(self, name: str, arrow: complex) -> None:
        self.reading_wrongly = True
        length = self.read(abs(arrow))
        self.found[f"{name}_mm"] = length
        self.found[name] = length * self.factor("v") / 1000
        self.reading_wrongly = self.made("all through")

    def acceleration(self, name: str, arrow: complex) -> None:
        self.reading_wrongly = True
        length = self.read(abs(arrow))
        self.found[f"{name}_mm"] = length
        self.found[name] = length * self.factor("a") / 1000
        self.reading_wrongly = self.made("all through")

    def factor(self, plan: str) -> float:
        """The scale by which a length of a plan is multiplied."""
        own = {"v": self.kv, "a": self.ka}[plan]
        if self.made("scales exchanged"):
            own = {"v": self.ka, "a": self.kv}[plan]
        if self.made("scale forgotten"):
            own = 1000.0
        if self.made("rev/min"):
            own *= (30 / pi) ** (1 if plan == "v" else 2)
        return own

    def along(self, name: str, arrow: complex, way: complex, per_mm: float) -> None:
        self.reading_wrongly = True
        sign = 1.0 if (arrow * way.conjugate()).real > 0 else -1.0
        plan = "v" if name.startswith(("omega", "v_")) else "a"
        wrong = self.factor(plan) / {"v": self.kv, "a": self.ka}[plan]
        self.found[name] = sign * self.read(abs(arrow)) * per_mm * wrong
        self.found[f"{name}_sense"] = sign
        self.reading_wrongly = self.made("all through")

    def place(self, name: str, point: complex) -> None:
        self.reading_wrongly = True
        super().place(name, point)
        self.reading_wrongly = self.made("all through")


Changed = Callable[[dict[str, float], Sheet], dict[str, float]]


def own_plans(found: dict[str, float], sheet: Sheet) -> dict[str, float]:
    """Both plans drawn twice as large as the sheet says, and computed with that scale."""
    return {f: v * 2 if f.endswith("_mm") and f[0] in "va" else v for f, v in found.items()}


def in_millimetres(found: dict[str, float], sheet: Sheet) -> dict[str, float]:
    """Velocities in mm/s and accelerations in mm/s²."""
    return {f: v * 1000 if is_vector(f) else v for f, v in found.items()}


def ten_times(found: dict[str, float], sheet: Sheet) -> dict[str, float]:
    """Ten times too large where accelerations are computed."""
    return {f: v * 10 if is_vector(f) and f[0] == "a" else v for f, v in found.items()}


def is_vector(field: str) -> bool:
    """Whether a field is a velocity or an acceleration."""
    return field[0] in "va" and not field.endswith(("_mm", "_sense"))


def answers_exchanged(found: dict[str, float], sheet: Sheet) -> dict[str, float]:
    """The rows of two points or links in the table exchanged."""
    for one, two in (("v_B", "v_C"), ("v_C", "v_A3"), ("omega_2", "omega_4")):
        if one in found and two in found:
            names = (one, two), (one.replace("v", "a", 1), two.replace("v", "a", 1))
            if one.startswith("omega"):
                names = (
                    (one, two),
                    (one.replace("omega", "epsilon"), two.replace("omega", "epsilon")),
                )
            swap: dict[str, str] = {}
            for p, q in names:
                for end in ("", "_mm", "_sense"):
                    if p + end in found and q + end in found:
                        swap |= {p + end: q + end, q + end: p + end}
            return {f: found[swap.get(f, f)] for f in found}
    return found


WRITTEN: Mapping[str, Changed] = {
    "own plans": own_plans,
    "mm/s": in_millimetres,
    "ten times": ten_times,
    "answers exchanged": answers_exchanged,
}
"""Mistakes in what is written down."""
CAUSES: Mapping[str, tuple[tuple[str, ...], ...]] = {
    "the crank's diameter for its radius": (("diameter",), ("half the radius",)),
    "another number": (("another number",),),
    "the angle clockwise": (("clockwise",),),
    "the protractor's other scale": (("protractor",),),
    "the crank turned the other way": (("reversed",),),
    "the plate flipped": (("plate flipped",), ("from the other end",), ("parallel",)),
    "the other closure": (("other side of the rocker",), ("other side of the guide",)),
    "the ruler's other edge, 1:2": (("ruler 1:2",),),
    "the ruler from 10 mm": (("ruler from 10",),),
    "the scales exchanged": (("scales exchanged",),),
    "the scale forgotten": (("scale forgotten",),),
    "plans of one's own scale": (("own plans",),),
    "mm/s for m/s": (("mm/s",),),
    "rev/min for rad/s": (("rev/min",),),
    "a power of ten": (("ten times",),),
    "no normal components": (("no normals",),),
    "answers exchanged": (("answers exchanged",), ("from the other end",)),
}
"""What is tried; where the first of a cause changes nothing or cannot be drawn, the next."""
NAMED: Mapping[str, str] = {
    "diameter": "diameter_for_radius",
    "half the radius": "radius_for_diameter",
    "another number": "data_of_another",
    "clockwise": "angle_clockwise",
    "protractor": "other_scale_of_protractor",
    "reversed": "driver_reversed",
    "plate flipped": "plate_flipped",
    "from the other end": "letters_exchanged",
    "parallel": "parallel_for_perpendicular",
    "other side of the rocker": "other_side",
    "other side of the guide": "other_side",
    "ruler 1:2": "ruler_scale",
    "ruler from 10": "ruler_from_ten",
    "scales exchanged": "wrong_scale",
    "scale forgotten": "scale_missing",
    "own plans": "own_scale",
    "mm/s": "power_of_ten",
    "rev/min": "rpm_as_rad",
    "ten times": "power_of_ten",
    "no normals": "normal_missing",
    "answers exchanged": "answers_exchanged",
}
"""The name in the report of each mistake."""


@dataclass(frozen=True)
class Pencil:
    """How a student draws: the deviations of marks (mm), directions (degrees) and readings (mm)."""

    sigma: float = 0.2
    degrees: float = 0.2
    ruler: float = 0.13
    step: float = 0.5
    digits: int = 3


CAREFUL = Pencil()
SLOPPY = Pencil(1.5, 1.0, 0.3, 1.0)


def handed_in(
    lab: str,
    given: Data,
    sheet: Sheet,
    rng: np.random.Generator,
    pencil: Pencil = CAREFUL,
    mistakes: tuple[str, ...] = (),
    crank: float = 0.0,
    other: tuple[Data, float] | None = None,
) -> dict[str, str]:
    """What a student writes in each field. Raises ValueError where the drawing does not close."""
    drawn = Mistaken(
        *sheet,
        rng,
        pencil.sigma,
        pencil.degrees,
        pencil.ruler,
        pencil.step,
        mistakes=frozenset(mistakes),
        crank_mm=crank,
        other=other[0] if other else None,
        other_mm=other[1] if other else 0.0,
    )
    drawn.reading_wrongly = drawn.made("all through")
    hand.DRAW[lab](drawn, given)
    found = drawn.found
    for name in mistakes:
        if name in WRITTEN:
            found = WRITTEN[name](found, sheet)
    return {field: written(field, value, pencil.digits) for field, value in found.items()}


def written(field: str, value: float, digits: int) -> str:
    """A number as it is written: lengths to half a millimetre, other sizes to some digits."""
    if field.endswith("_sense"):
        return "+" if value > 0 else "-"
    if field.endswith(("_x_mm", "_y_mm")):
        return f"{value:.1f}"
    if field.endswith("_mm"):
        return f"{abs(value):.1f}"
    return np.format_float_positional(float(f"{abs(value):.{digits}g}"), trim="-")
