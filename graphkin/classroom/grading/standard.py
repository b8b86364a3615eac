"""What a student's answers are held against: the key of the own variant, and its tolerances."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from math import isfinite, nan, radians
from typing import Any

from msgspec import Struct

from graphkin.accuracy.pencil.original import Original, original
from graphkin.accuracy.pencil.pencil import Pencil
from graphkin.accuracy.pencil.pencil_marks import Paper
from graphkin.classroom.grading.probes import Probe, probes, targets_of
from graphkin.classroom.grading.tolerance import (
    Errors,
    Reading,
    Tolerance,
    pencil_errors,
    tolerances,
)
from graphkin.classroom.lab.lab_model import Item, Rubric
from graphkin.construction.core.program import Drive, Program, Target
from graphkin.construction.core.run import StepFailed, run
from graphkin.documents.scaling import scales
from graphkin.drawing.scale import Scales
from graphkin.mechanism import Mechanism
from graphkin.numbers.arithmetic import FLOAT, turn_by
from graphkin.numbers.arrays import np

NOTHING: Mapping[int, Any] = {}


@dataclass(frozen=True)
class Expectation:
    """What is expected of a form, without the construction from which it comes."""

    items: tuple[Item, ...]
    key: Mapping[str, float]
    tolerance: Mapping[str, Tolerance]
    spread: Any = field(default=None, compare=False)
    """The covariance of the pencil's errors of the fields that have a tolerance, in their order."""
    cranks: Any = field(default=None, compare=False)
    """How far the same fields go for each crank that is laid off by a degree too much."""

    @cached_property
    def item(self) -> Mapping[str, Item]:
        """The item of each field."""
        return {item.field: item for item in self.items}


class FormLayout(Struct, frozen=True, dict=True):
    """How the fields of a form are read off a construction; all variants of a program share it.

    ``targets`` are what must be constructed for that.
    """

    program: Program
    items: tuple[Item, ...]
    probes: tuple[Probe, ...]
    targets: tuple[Target, ...]

    @cached_property
    def by_field(self) -> Mapping[str, Probe]:
        """The probe of each field."""
        return {probe.item.field: probe for probe in self.probes}

    @cached_property
    def needed(self) -> tuple[int, ...]:
        """The steps from which the fields follow, composite ones by value."""
        return self.program.behind(step for probe in self.probes for step in probe.steps)

    @cached_property
    def followers(self) -> dict[int, frozenset[int]]:
        """The steps that hang on each step, itself included, as far as it was asked for."""
        return {}

    def below(self, number: int) -> frozenset[int]:
        """The steps that hang on a step, itself included."""
        if number not in self.followers:
            self.followers[number] = self.program.descendants(number)
        return self.followers[number]


def layout(mechanism: Mechanism, items: Iterable[Item]) -> FormLayout:
    """How the fields are read off a mechanism's construction."""
    form = tuple(items)
    program = mechanism.program
    return FormLayout(program, form, probes(mechanism, form), targets_of(mechanism, form))


class Standard(Struct, frozen=True, dict=True):
    """One variant: its construction by hand without errors at the scales of its sheets, its form.

    ``errors`` are those of the pencil for each field but senses, where they were worked out for
    many variants at once.
    """

    mechanism: Mechanism
    scales: Scales
    layout: FormLayout
    exact: Original
    rubric: Rubric
    computed: tuple[str, ...] = ()
    """The fields that are too small to be measured."""
    errors: Errors | None = None

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
        """The fields but senses, each with its key."""
        return [
            Reading(probe, self.exact, self.key[probe.item.field])
            for probe in self.layout.probes
            if probe.item.what != "sense"
        ]

    @cached_property
    def tolerance(self) -> Mapping[str, Tolerance]:
        """How far each field but senses may be off."""
        return tolerances(self.readings, self.pencil.each, self.rubric, self.computed)

    @cached_property
    def pencil(self) -> Errors:
        """What a pencil makes of the fields but senses."""
        if self.errors is not None:
            return self.errors
        (found,) = pencil_errors([self.readings], Pencil(self.rubric.point, self.rubric.line))
        return found

    @cached_property
    def expectation(self) -> Expectation:
        """What is expected, for reports."""
        return Expectation(self.items, self.key, self.tolerance, self.pencil.together, self.cranks)

    @property
    def cranks(self) -> Any:
        """How far each field but senses goes where a crank is laid off by a degree too much, a row
        for each that turns; sizes, as they are marked.
        """
        values, rows = self.exact.trace.values, []
        for drive in self.layout.program.drives:
            if isinstance(values.get(drive.position), complex):
                told = self.told(turned(values, drive, radians(1.0)))
                rows.append([self.moved(field, told) for field in self.tolerance])
        return np.array(rows).reshape(len(rows), len(self.tolerance))

    def moved(self, field: str, told: Mapping[str, float]) -> float:
        """How far a field lies from the key as it is told; zero where nothing is."""
        off = self.by_field[field].item.off(told.get(field, nan), self.key[field])
        return off if isfinite(off) else 0.0

    @property
    def paper(self) -> Paper:
        """What a metre of paper stands for."""
        return self.exact.paper

    def read(self, found: Mapping[int, Any], paper: Paper | None = None) -> dict[str, float]:
        """Every field as a construction tells it."""
        return {
            probe.item.field: sign_of(probe, probe.read(found, paper or self.paper))
            for probe in self.layout.probes
        }

    def rerun(
        self, overrides: Mapping[int, Any], program: Program | None = None
    ) -> Mapping[int, Any]:
        """The construction with some values put in place of its own, or with other steps in its
        program; nothing if it fails. What hangs on none of these stays as it is.
        """
        written = program or self.layout.program
        exact = self.exact.trace.values
        again = self.changed(overrides, written)
        steps = [n for n in self.layout.needed if n in again or n not in exact]
        given = {arg: exact[arg] for n in steps for arg in written.steps[n].args if arg in exact}
        kept = {arg: value for arg, value in given.items() if arg not in again}
        values = self.mechanism.scene.values_in(FLOAT)
        try:
            told = run(
                written, sorted({*steps, *kept}), values, FLOAT, overrides=kept | dict(overrides)
            )
        except StepFailed:
            return NOTHING
        return {**exact, **told.values}

    def changed(self, overrides: Mapping[int, Any], program: Program) -> frozenset[int]:
        """The steps that hang on a value put in place of another, or on another step."""
        own = self.layout.program.steps
        other = () if program is self.layout.program else range(len(own))
        roots = [*overrides, *(n for n in other if program.steps[n] is not own[n])]
        return frozenset().union(*(self.layout.below(number) for number in roots))

    def told(
        self,
        overrides: Mapping[int, Any],
        program: Program | None = None,
        paper: Paper | None = None,
    ) -> dict[str, float]:
        """Every field as the construction tells it with some values put in place of its own."""
        found = self.rerun(overrides, program)
        return self.read(found, paper) if found else {}


def turned(values: Mapping[int, Any], drive: Drive, angle: float) -> dict[int, Any]:
    """The direction of a crank that is laid off too far by an angle, in radians."""
    found = {drive.position: values[drive.position] * turn_by(angle)}
    if drive.angle is not None:
        found[drive.angle] = values[drive.angle] + angle
    return found


def sign_of(probe: Probe, value: float) -> float:
    """A sense is a sign; everything else stays what it is."""
    if probe.item.what != "sense":
        return float(value)
    return float((value > 0) - (value < 0))


def standard(
    mechanism: Mechanism, items: Iterable[Item], rubric: Rubric, computed: Iterable[str] = ()
) -> Standard:
    """What the answers to a variant are held against, at the scales of its sheets."""
    chosen, form = scales(mechanism), layout(mechanism, items)
    exact = original(mechanism, chosen, form.targets)
    return Standard(mechanism, chosen, form, exact, rubric, tuple(computed))
