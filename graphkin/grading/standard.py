"""What a student's answers are held against: the key of the own variant, and its tolerances."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from graphkin.arithmetic import FLOAT
from graphkin.grading.probes import Probe, probes, targets_of
from graphkin.grading.tolerance import Tolerance, tolerances
from graphkin.lab.model import Item, Rubric
from graphkin.mechanism import Mechanism
from graphkin.pencil.marks import Paper
from graphkin.pencil.original import Original, Scales, original
from graphkin.scaling import scales
from graphkin.steps.program import Program
from graphkin.steps.run import StepFailed, run

NOTHING: Mapping[int, Any] = {}


@dataclass(frozen=True)
class Expectation:
    """What is expected of a form, without the construction from which it comes."""

    items: tuple[Item, ...]
    key: Mapping[str, float]
    tolerance: Mapping[str, Tolerance]

    @cached_property
    def item(self) -> Mapping[str, Item]:
        """The item of each field."""
        return {item.field: item for item in self.items}


@dataclass(frozen=True)
class Standard:
    """One variant: its construction without errors at the scales of its sheets, and its form."""

    mechanism: Mechanism
    scales: Scales
    items: tuple[Item, ...]
    rubric: Rubric
    computed: tuple[str, ...] = ()
    """The fields that are too small to be measured."""

    @cached_property
    def exact(self) -> Original:
        """The construction, by hand, without errors."""
        return original(self.mechanism, self.scales, targets_of(self.mechanism, self.items))

    @cached_property
    def probes(self) -> tuple[Probe, ...]:
        """How each field is read off it."""
        return probes(self.mechanism, self.items)

    @cached_property
    def by_field(self) -> Mapping[str, Probe]:
        """The probe of each field."""
        return {probe.item.field: probe for probe in self.probes}

    @cached_property
    def key(self) -> Mapping[str, float]:
        """The right value of each field, in its unit; rates with their sign."""
        return self.read(self.exact.trace.values)

    @cached_property
    def tolerance(self) -> Mapping[str, Tolerance]:
        """How far each field but senses may be off."""
        return tolerances(self.probes, self.key, self.exact, self.rubric, self.computed)

    @cached_property
    def expectation(self) -> Expectation:
        """What is expected, for reports."""
        return Expectation(self.items, self.key, self.tolerance)

    @cached_property
    def needed(self) -> tuple[int, ...]:
        """The steps from which the fields follow, composite ones by value."""
        wanted = {step for probe in self.probes for step in probe.steps}
        steps = self.mechanism.program.steps
        for number in range(len(steps) - 1, -1, -1):
            if number in wanted:
                wanted.update(steps[number].args)
        return tuple(sorted(wanted))

    @property
    def paper(self) -> Paper:
        """What a metre of paper stands for."""
        return self.exact.paper

    def read(self, found: Mapping[int, Any], paper: Paper | None = None) -> dict[str, float]:
        """Every field as a construction tells it."""
        return {
            probe.item.field: sign_of(probe, probe.read(found, paper or self.paper))
            for probe in self.probes
        }

    def rerun(
        self, overrides: Mapping[int, Any], program: Program | None = None
    ) -> Mapping[int, Any]:
        """The construction with some values put in place of its own; nothing if it fails."""
        written = program or self.mechanism.program
        given = dict(self.mechanism.trial_rates)
        if written.seconds is not None:
            given[written.seconds] = self.scales.seconds
        values = self.mechanism.scene.values_in(FLOAT)
        try:
            return run(
                written, self.needed, values, FLOAT, overrides=given | dict(overrides)
            ).values
        except StepFailed:
            return NOTHING

    def told(
        self,
        overrides: Mapping[int, Any],
        program: Program | None = None,
        paper: Paper | None = None,
    ) -> dict[str, float]:
        """Every field as the construction tells it with some values put in place of its own."""
        found = self.rerun(overrides, program)
        return self.read(found, paper) if found else {}


def sign_of(probe: Probe, value: float) -> float:
    """A sense is a sign; everything else stays what it is."""
    if probe.item.what != "sense":
        return float(value)
    return float((value > 0) - (value < 0))


def standard(
    mechanism: Mechanism, items: Iterable[Item], rubric: Rubric, computed: Iterable[str] = ()
) -> Standard:
    """What the answers to a variant are held against, at the scales of its sheets."""
    return Standard(mechanism, scales(mechanism), tuple(items), rubric, tuple(computed))
