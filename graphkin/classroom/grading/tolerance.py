"""How far an answer may lie from the key: what the pencil does to that very drawing, and a ruler.

The pencil's error of a field is the 95th percentile over drawings of the student's own variant
with the drawing error that the rubric forgives. Each error of each mark is tried on its own, as in
the forecast of the pencil; where errors do not just add, or a drawing may not close, joint drawings
are made, the same at every run.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from math import hypot, inf, isfinite
from typing import Any, NamedTuple

from msgspec import Struct

from graphkin.accuracy.pencil.forecast import BENT, JOINT, NORMAL_95, SEED, WEIGHT, sources
from graphkin.accuracy.pencil.original import Original, together
from graphkin.accuracy.pencil.pencil import STRAIGHT, Pencil
from graphkin.accuracy.pencil.pencil_marks import PencilMark
from graphkin.accuracy.pencil.read_off import bar_of
from graphkin.accuracy.pencil.redrawing import redrawn
from graphkin.accuracy.pencil.simulation import COMMON
from graphkin.classroom.grading.probes import Probe
from graphkin.classroom.lab.lab_model import Rubric
from graphkin.construction.core.program import Plane
from graphkin.numbers.arrays import np

FINE = 0.5
"""A fine drawing has half the error that is forgiven: no cap takes its marks."""
RARE = 2.5758293035489004 / STRAIGHT
"""How many times as far as 95 of 100 drawings 99 of 100 are off, at most."""


class Tolerance(Struct, frozen=True):
    """How far a field may be off, in its unit, and of what that is made.

    ``pencil`` and ``ruler`` are the errors of drawing and reading, which 95 of 100 drawings keep
    to; ``unsure`` tells that together they are larger than the rubric's cap, so that the drawing
    hardly tells the field. ``most`` is how far it may be off where all of a sheet is one careful
    drawing: what 99 of 100 keep to.
    """

    value: float
    pencil: float
    ruler: float
    unsure: bool = False
    most: float = 0.0


class Reading(Struct, frozen=True):
    """A field of one construction, as the forecast of the pencil wants an answer."""

    probe: Probe
    exact: Original
    value: float

    def error(self, found: Mapping[int, Any]) -> Any:
        """How far the field lies from the key in some drawings."""
        return self.probe.error(found, self.exact.paper, self.value)


class Errors(NamedTuple):
    """The pencil's error of each field, and the covariance of all of them in one drawing."""

    each: tuple[float, ...]
    together: Any


def tolerances(
    readings: Sequence[Reading],
    errors: Sequence[float],
    rubric: Rubric,
    computed: Collection[str] = (),
) -> dict[str, Tolerance]:
    """The tolerance of each field from the pencil's error of it; never above the cap where a field
    is computed instead of measured.
    """
    if not readings:
        return {}
    size = extent(readings[0].exact)
    return {
        (field := reading.probe.item.field): combined(
            reading, error, rubric, size, drawn=field not in computed
        )
        for reading, error in zip(readings, errors, strict=True)
    }


def pencil_errors(variants: Sequence[Sequence[Reading]], pencil: Pencil) -> list[Errors]:
    """The 95th percentile of the error of each field over drawings with a pencil, of variants that
    draw the same; a single one is a batch of one.
    """
    fields = variants[0]
    if not fields:
        return [Errors((), np.zeros((0, 0)))] * len(variants)
    many = together([readings[0].exact for readings in variants])
    owners, errors = sources(many)
    drawings = redrawn(many, pencil, errors)
    size = len(variants), 2 * len(owners)
    off = np.empty((len(variants), len(fields), len(owners), 2))
    for place, each in enumerate(fields):
        key = np.array([[readings[place].value] for readings in variants])
        error = np.broadcast_to(each.probe.error(drawings, many.paper, key), size)
        off[:, place] = error.reshape(len(variants), -1, 2)
    found, bent = added(off)
    for i in np.flatnonzero(bent.any(axis=1)).tolist():
        found[i] = np.where(bent[i], joint_errors(variants[i], pencil), found[i])
    return [
        Errors(tuple(map(float, row)), spread)
        for row, spread in zip(found, covariance(off, found, bent), strict=True)
    ]


def covariance(off: Any, errors: Any, bent: Any) -> Any:
    """How the errors of fields go together in one drawing, from single errors at both their nodes.

    Fields whose errors do not just add up are held to go with no other.
    """
    parts = np.where(np.asarray(bent)[..., None, None], 0.0, off)
    mean = WEIGHT * parts.sum(axis=-1)
    found = WEIGHT * np.einsum("...isk,...jsk->...ij", parts, parts, optimize=True)
    found = found - np.einsum("...is,...js->...ij", mean, mean, optimize=True)
    alone = np.where(bent, np.asarray(errors) / STRAIGHT, 0.0)
    each = np.arange(found.shape[-1])
    found[..., each, each] += alone**2
    return found


def added(off: Any) -> tuple[Any, Any]:
    """The 95th percentile of each field from single errors at both their nodes, which the last two
    axes hold; and where errors do not just add up, or a drawing does not close.

    A scaled chi-square of the same mean and variance stands for the square, as in the forecast.
    """
    with np.errstate(all="ignore"):
        mean = WEIGHT * off.sum(axis=-1)
        variance = (WEIGHT * (off * off).sum(axis=-1) - mean * mean).sum(axis=-1)
        bent = ~(abs(mean).sum(axis=-1) <= BENT * np.sqrt(variance))
        drift = mean.sum(axis=-1) ** 2
        size = variance + drift
        lack = (2 * variance**2 + 4 * drift * variance) / (9 * size**2)
        share = (1 - lack + NORMAL_95 * np.sqrt(lack)) ** 3
        return np.where(size > 0, np.sqrt(size * share), 0.0), bent & ~(size == 0)


def joint_errors(readings: Sequence[Reading], pencil: Pencil) -> list[float]:
    """The same from drawings in which every mark is off."""
    drawings = joint_drawings(readings[0].exact, pencil, JOINT, SEED)
    found = []
    for reading in readings:
        off = np.broadcast_to(abs(reading.error(drawings)), JOINT)
        full = np.where(np.isnan(off), inf, off)
        found.append(float(np.percentile(full, COMMON, method="lower")))
    return found


def joint_drawings(exact: Original, pencil: Pencil, count: int, seed: int) -> dict[int, Any]:
    """Every value of so many drawings in which every mark is off; the same for the same seed."""

    def errors(number: int, mark: PencilMark) -> Any:
        stream = np.random.Generator(np.random.PCG64([seed, number]))
        return stream.standard_normal((count, mark.errors))

    return redrawn(exact, pencil, errors)


def combined(
    reading: Reading, error: float, rubric: Rubric, size: float, *, drawn: bool
) -> Tolerance:
    """Pencil and ruler together, not less than the floor nor more than the cap of the value.

    For a place the cap is of the mechanism's size. What is ``drawn`` is never held to less than
    the ruler tells, nor to less than a fine drawing misses.
    """
    ruler = rubric.ruler * ruler_unit(reading)
    is_place = reading.probe.item.what == "place"
    beside = size if is_place else abs(reading.value)
    cap, floor = rubric.cap * beside, 0.0 if is_place else rubric.floor * beside

    def allowed(error: float) -> float:
        whole, fine = hypot(error, ruler), hypot(FINE * error, ruler)
        if not drawn:
            return max(floor, min(whole, cap))
        return max(floor, ruler, min(whole, max(cap, fine) if isfinite(fine) else cap))

    value = allowed(error)
    most = allowed(RARE * error) if drawn else value
    return Tolerance(value, error, ruler, hypot(error, ruler) > cap, most)


def ruler_unit(reading: Reading) -> float:
    """What a millimetre on the ruler is worth in the field's unit."""
    probe, exact = reading.probe, reading.exact
    if probe.item.unit == "mm":
        return 1.0
    mm = exact.paper.millimetre(probe.plane)
    if not probe.item.unit.startswith("rad"):
        return mm
    return mm / bar_of(exact, exact.program.steps[probe.step])


def extent(exact: Original) -> float:
    """The size of the mechanism on paper, in mm: the larger side of the box round its points."""
    targets = exact.program.targets
    found = [
        exact.trace.values[number]
        for (quantity, _), number in targets.items()
        if quantity == "position" and number in exact.trace.values
    ]
    mm = exact.paper.millimetre(Plane.MECHANISM)
    wide = max(p.real for p in found) - min(p.real for p in found)
    high = max(p.imag for p in found) - min(p.imag for p in found)
    return float(max(wide, high)) / mm
