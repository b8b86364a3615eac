"""The standard for a student's answers: the key of the student's variant, and its tolerances."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import chain
from math import hypot, inf, isfinite, nan, radians
from typing import Any, NamedTuple

from msgspec import Struct

from graphkin.accuracy.pencil import (
    BENT,
    COMMON,
    JOINT,
    NORMAL_95,
    SEED,
    STRAIGHT,
    WEIGHT,
    Original,
    Paper,
    Pencil,
    PencilMark,
    bar_of,
    original,
    redrawn,
    sources,
    together,
)
from graphkin.classroom.grading.end_positions import (
    TravelKey,
    places_of,
    travel_keys,
    with_keys,
)
from graphkin.classroom.grading.probes import Probe, probes, targets_of, with_travel
from graphkin.classroom.lab.items import motion_of
from graphkin.classroom.lab.lab_model import Item, Rubric
from graphkin.construction.core.program import Drive, Plane, Program, Target
from graphkin.construction.core.quantities import BALANCING_MOMENT, FORCES
from graphkin.construction.core.run import StepFailed, run
from graphkin.documents.force_fields import force_scales
from graphkin.documents.scaling import scales
from graphkin.drawing.scale import Scales
from graphkin.mechanism import Mechanism
from graphkin.numbers.arithmetic import FLOAT, np, turn_by

FINE = 0.5
"""The error of a fine drawing, relative to the forgiven one.

No cap takes marks from a fine drawing.
"""
RARE = 2.5758293035489004 / STRAIGHT
"""The error that 99 of 100 drawings keep to, relative to that of 95 of 100."""


class Tolerance(Struct, frozen=True):
    """The largest accepted error of a field, in its unit, and its parts.

    ``pencil`` and ``ruler`` are the errors of drawing and reading that 95 of 100 drawings keep to.
    ``unsure`` says that together they exceed the rubric's cap, so that a drawing hardly determines
    the field. ``most`` is the tolerance where the whole sheet is one careful drawing: the error
    that 99 of 100 keep to.
    """

    value: float
    pencil: float
    ruler: float
    unsure: bool = False
    most: float = 0.0


class Reading(Struct, frozen=True):
    """A field of one construction, in the form of an answer for the pencil forecast.

    A field that takes the whole motion has a ``key`` of its own.
    """

    probe: Probe
    exact: Original
    value: float
    key: TravelKey | None = None

    def error(self, found: Mapping[int, Any]) -> Any:
        """The errors of the field in some drawings."""
        return self.probe.error(found, self.exact.paper, self.value)


class Errors(NamedTuple):
    """The pencil's error of each field, and the covariance of all fields in one drawing."""

    each: tuple[float, ...]
    together: Any


def tolerances(
    readings: Sequence[Reading],
    errors: Sequence[float],
    rubric: Rubric,
    computed: Collection[str] = (),
) -> dict[str, Tolerance]:
    """The tolerance of each field, from the pencil's error of the field.

    A ``computed`` field is never allowed more than the cap.
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
    """The 95th percentile of each field's error over drawings with a pencil.

    All variants draw the same; a single variant is a batch of one.
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
    """The covariance of the fields' errors in one drawing, from single errors at both their nodes.

    Fields whose errors do not simply add are taken as uncorrelated with all others.
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
    """The 95th percentile of each field from single errors at both their nodes, the last two axes.

    The second result says where errors do not simply add, or a drawing does not close. The square
    of the error is approximated by a scaled chi-square of the same mean and variance, as in the
    forecast.
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
    """The same percentiles from drawings in which every mark is off."""
    drawings = joint_drawings(readings[0].exact, pencil, JOINT, SEED)
    found = []
    for reading in readings:
        off = np.broadcast_to(abs(reading.error(drawings)), JOINT)
        full = np.where(np.isnan(off), inf, off)
        found.append(float(np.percentile(full, COMMON, method="lower")))
    return found


def joint_drawings(exact: Original, pencil: Pencil, count: int, seed: int) -> dict[int, Any]:
    """The values of ``count`` drawings in which every mark is off.

    The same ``seed`` gives the same values.
    """

    def errors(number: int, mark: PencilMark) -> Any:
        stream = np.random.Generator(np.random.PCG64([seed, number]))
        return stream.standard_normal((count, mark.errors))

    return redrawn(exact, pencil, errors)


def combined(
    reading: Reading, error: float, rubric: Rubric, size: float, *, drawn: bool
) -> Tolerance:
    """Pencil and ruler errors together, between the floor and the cap of the value.

    The cap of a place is relative to the mechanism's size. What is ``drawn`` is always allowed the
    ruler's error and the error of a fine drawing.
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
    """A millimetre on the ruler in the field's unit; zero for a moment, which no ruler reads."""
    probe, exact = reading.probe, reading.exact
    if probe.item.unit == "mm":
        return 1.0
    if reading.key is not None:
        return reading.key.millimetre
    if motion_of(probe.item) is BALANCING_MOMENT:
        return 0.0
    mm = exact.paper.millimetre(probe.plane)
    if not probe.item.unit.startswith("rad"):
        return mm
    return mm / bar_of(exact, exact.program.steps[probe.step])


def extent(exact: Original) -> float:
    """The size of the mechanism on paper, in mm: the larger side of its points' bounding box."""
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


# --- the standard of one variant ------------------------------------------------------------------


NOTHING: Mapping[int, Any] = {}


@dataclass(frozen=True)
class Expectation:
    """The expected values of a form, without the construction they come from."""

    items: tuple[Item, ...]
    key: Mapping[str, float]
    tolerance: Mapping[str, Tolerance]
    spread: Any = field(default=None, compare=False)
    """The covariance of the pencil's errors of the fields with a tolerance, in their order."""
    cranks: Any = field(default=None, compare=False)
    """The change of the same fields for each crank set a degree too far."""
    paper: Paper | None = field(default=None, compare=False)
    """The scales of the sheets."""

    @cached_property
    def item(self) -> Mapping[str, Item]:
        """The item of each field."""
        return {item.field: item for item in self.items}


class FormLayout(Struct, frozen=True, dict=True):
    """How the fields of a form are read off a construction; variants of a program share it.

    ``targets`` are what must be constructed for these fields. ``drawn`` is the program without the
    steps of fields that take the whole motion; ``places`` are the steps that these fields follow.
    """

    program: Program
    items: tuple[Item, ...]
    probes: tuple[Probe, ...]
    targets: tuple[Target, ...]
    drawn: Program
    places: Mapping[str, tuple[int, ...]] = {}

    @cached_property
    def by_field(self) -> Mapping[str, Probe]:
        """The probe of each field."""
        return {probe.item.field: probe for probe in self.probes}

    @cached_property
    def needed(self) -> tuple[int, ...]:
        """The steps that the fields depend on, composite ones by value."""
        read = (step for probe in self.probes for step in probe.steps)
        return self.program.behind([*read, *chain(*self.places.values())])

    @property
    def has_forces(self) -> bool:
        """Whether a field is read off the polygons of forces."""
        return any(motion_of(item) in FORCES for item in self.items)

    @cached_property
    def followers(self) -> dict[int, frozenset[int]]:
        """A cache of the steps that depend on each step, the step included."""
        return {}

    def below(self, number: int) -> frozenset[int]:
        """The steps that depend on a step, the step included."""
        if number not in self.followers:
            self.followers[number] = self.program.descendants(number)
        return self.followers[number]


def layout(mechanism: Mechanism, items: Iterable[Item]) -> FormLayout:
    """How the fields are read off a mechanism's construction."""
    form, whole = tuple(items), mechanism.with_forces
    program = with_travel(whole.program, form)
    followed = places_of(whole, form)
    targets = dict.fromkeys((*targets_of(whole, form), *chain(*followed.values())))
    places = {
        field: tuple(program.targets[target] for target in some) for field, some in followed.items()
    }
    return FormLayout(program, form, probes(whole, form), (*targets,), whole.program, places)


class Standard(Struct, frozen=True, dict=True):
    """One variant: its construction by hand without errors, at its sheets' scales, and its form.

    ``errors`` are the pencil's errors for each field except senses, where they were worked out for
    many variants at once.
    """

    mechanism: Mechanism
    scales: Scales
    layout: FormLayout
    exact: Original
    rubric: Rubric
    computed: tuple[str, ...] = ()
    """The fields that are too small to measure."""
    errors: Errors | None = None
    travel: Mapping[str, TravelKey] = {}
    """The keys of the fields that take the whole motion."""

    @property
    def items(self) -> tuple[Item, ...]:
        """The fields of the form."""
        return self.layout.items

    @property
    def by_field(self) -> Mapping[str, Probe]:
        """The probe of each field."""
        return self.layout.by_field

    @cached_property
    def key(self) -> Mapping[str, float]:
        """The right value of each field, in its unit; rates with their sign."""
        return self.read(self.exact.trace.values)

    @cached_property
    def readings(self) -> list[Reading]:
        """The fields except senses, each with its key."""
        return [
            Reading(
                *(probe, self.exact, self.key[probe.item.field]),
                self.travel.get(probe.item.field),
            )
            for probe in self.layout.probes
            if probe.item.what != "sense"
        ]

    @cached_property
    def tolerance(self) -> Mapping[str, Tolerance]:
        """The tolerance of each field except senses."""
        return tolerances(self.readings, self.pencil.each, self.rubric, self.computed)

    @cached_property
    def pencil(self) -> Errors:
        """The pencil's errors of the fields except senses."""
        found = self.errors
        if found is None:
            (found,) = pencil_errors([self.readings], pencil_of(self.rubric))
        return with_travel_errors(found, self.readings) if self.travel else found

    @cached_property
    def expectation(self) -> Expectation:
        """The expected values, for reports."""
        together = self.pencil.together
        return Expectation(self.items, self.key, self.tolerance, together, self.cranks, self.paper)

    @property
    def cranks(self) -> Any:
        """The change of each field except senses for a crank set a degree too far.

        There is a row for each crank that turns. Sizes are compared without sign, as in marking.
        """
        values, rows = self.exact.trace.values, []
        for drive in self.layout.program.drives:
            if isinstance(values.get(drive.position), complex):
                turned_values = self.reread(turned(values, drive, radians(1.0)))
                rows.append([self.moved(field, turned_values) for field in self.tolerance])
        return np.array(rows).reshape(len(rows), len(self.tolerance))

    def moved(self, field: str, read_values: Mapping[str, float]) -> float:
        """The difference between a value and the key; zero where there is no finite value."""
        off = self.by_field[field].item.off(read_values.get(field, nan), self.key[field])
        return off if isfinite(off) else 0.0

    @property
    def paper(self) -> Paper:
        """The scales of the paper: the real size of a metre of paper."""
        return self.exact.paper

    def read(self, found: Mapping[int, Any], paper: Paper | None = None) -> dict[str, float]:
        """Every field as read off a construction."""
        return {
            probe.item.field: sign_of(probe, probe.read(found, paper or self.paper))
            for probe in self.layout.probes
        }

    def rerun(
        self, overrides: Mapping[int, Any], program: Program | None = None
    ) -> Mapping[int, Any]:
        """The construction run again with some values or steps replaced; empty if it fails.

        Values that depend on no replacement are kept.
        """
        written = program or self.layout.program
        exact = self.exact.trace.values
        again = self.changed(overrides, written)
        steps = [n for n in self.layout.needed if n in again or n not in exact]
        given = {arg: exact[arg] for n in steps for arg in written.steps[n].args if arg in exact}
        kept = {arg: value for arg, value in given.items() if arg not in again}
        values = self.mechanism.scene.values_in(FLOAT)
        try:
            result = run(
                written, sorted({*steps, *kept}), values, FLOAT, overrides=kept | dict(overrides)
            )
        except StepFailed:
            return NOTHING
        return {**exact, **result.values}

    def changed(self, overrides: Mapping[int, Any], program: Program) -> frozenset[int]:
        """The steps that depend on a replaced value or a replaced step."""
        own = self.layout.program.steps
        other = () if program is self.layout.program else range(len(own))
        roots = [*overrides, *(n for n in other if program.steps[n] is not own[n])]
        return frozenset().union(*(self.layout.below(number) for number in roots))

    def reread(
        self,
        overrides: Mapping[int, Any],
        program: Program | None = None,
        paper: Paper | None = None,
    ) -> dict[str, float]:
        """Every field as read off the construction with some values replaced; empty if it fails."""
        found = self.rerun(overrides, program)
        return self.read(found, paper) if found else {}


def turned(values: Mapping[int, Any], drive: Drive, angle: float) -> dict[int, Any]:
    """The direction of a crank that is set too far by an angle in radians."""
    found = {drive.position: values[drive.position] * turn_by(angle)}
    if drive.angle is not None:
        found[drive.angle] = values[drive.angle] + angle
    return found


def sign_of(probe: Probe, value: float) -> float:
    """The sign of a sense; any other value unchanged."""
    if probe.item.what != "sense":
        return float(value)
    return float((value > 0) - (value < 0))


def standard(
    mechanism: Mechanism, items: Iterable[Item], rubric: Rubric, computed: Iterable[str] = ()
) -> Standard:
    """The standard for the answers to a variant, at the scales of its sheets."""
    form = layout(mechanism, items)
    chosen = with_force_scales(mechanism, scales(mechanism), form)
    keys = travel_keys(mechanism, form.items, chosen, pencil_of(rubric))
    return standard_at(mechanism, chosen, form, rubric, tuple(computed), keys)


def standard_at(
    mechanism: Mechanism,
    chosen: Scales,
    form: FormLayout,
    rubric: Rubric,
    computed: tuple[str, ...],
    keys: Mapping[str, TravelKey],
) -> Standard:
    """The standard of a variant whose scales and keys of the whole motion are known."""
    whole = mechanism.with_forces
    exact = original(whole, chosen, form.targets)
    exact = with_keys(exact, form.program, form.items, keys)
    return Standard(whole, chosen, form, exact, rubric, computed, travel=keys)


def pencil_of(rubric: Rubric) -> Pencil:
    """The pencil whose errors a rubric forgives."""
    return Pencil(rubric.point, rubric.line)


def with_travel_errors(found: Errors, readings: Sequence[Reading]) -> Errors:
    """The errors with those of the dead positions, which are drawings of their own."""
    each, spread = [*found.each], np.array(found.together)
    for place, reading in enumerate(readings):
        if reading.key is not None:
            each[place] = reading.key.pencil
            spread[place, place] = (reading.key.pencil / STRAIGHT) ** 2
    return Errors(tuple(each), spread)


def with_force_scales(mechanism: Mechanism, chosen: Scales, form: FormLayout) -> Scales:
    """The scale factors of a variant's sheets; those of forces if a field needs them."""
    return force_scales(mechanism, chosen) if form.has_forces else chosen


def sense_is_open(standard: Standard, field: str) -> bool:
    """Whether no drawing determines a sense: the value is zero within the error of a drawing."""
    sized = standard.by_field[field].item.sized
    if sized not in standard.tolerance:
        return standard.key[field] == 0
    allowed = standard.tolerance[sized]
    return abs(standard.key[sized]) <= max(allowed.value, hypot(allowed.pencil, allowed.ruler))


# --- variants side by side -----------------------------------------------------------------------


def alike(found: Sequence[Standard]) -> list[list[int]]:
    """The indices of variants that draw the same, in groups.

    Variants with groups of higher class stand alone: these are closed for each variant alone.
    """
    groups: dict[Any, list[int]] = {}
    for i, each in enumerate(found):
        exact = each.exact
        kinds = tuple((number, type(value)) for number, value in exact.trace.values.items())
        alone = i if PencilMark.CLOSING in exact.marks.values() else -1
        key = (id(each.layout), exact.triangles, kinds, tuple(exact.tails.items()), alone)
        groups.setdefault(key, []).append(i)
    return list(groups.values())
