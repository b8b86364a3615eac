"""The relations of a form: what a student computes from earlier answers, without the drawing.

A value is the student's segment times the scale. A rate is the student's relative vector over the
length of the bar. Components of accelerations follow as their constructions say. A block slides at
the speed of its relative vector. A computed length is laid off as it came out.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import hypot, inf
from typing import NamedTuple

from msgspec import Struct

from graphkin.classroom.grading.probes import Probe
from graphkin.classroom.grading.standard import Standard
from graphkin.construction.core.component import Component, component_of
from graphkin.construction.core.program import Plane
from graphkin.construction.core.quantities import EPSILON, OMEGA

ROUNDED = 0.005
"""The relative rounding allowed for a value that is only computed."""
COARSE = 0.05
"""The largest relative rounding of a number as written: two digits."""


class Own(Struct, frozen=True):
    """A size that a student states, in SI units, its relative rounding, and its field.

    Where no field states it, ``field`` is empty and the size is the key's.
    """

    size: float
    rounded: float = 0.0
    field: str = ""


class Following(Struct, frozen=True):
    """The value that a field takes from the student's other answers, and its tolerance.

    ``drawn`` says that the construction gives it.
    """

    field: str
    sources: tuple[str, ...]
    value: float
    tolerance: float
    drawn: bool = False


class FormRelation(NamedTuple):
    """The student's values as factors, their result in SI units, and the bar used, in metres."""

    factors: tuple[Own, ...]
    size: float
    bar: float = inf


def si(standard: Standard, field: str, value: float) -> float:
    """A field's number in SI units; a segment is converted by the scale of its drawing."""
    return abs(value) * unit(standard, standard.by_field[field])


def unit(standard: Standard, probe: Probe) -> float:
    """The unit of a field in SI units."""
    return standard.paper.millimetre(probe.plane) if probe.item.unit == "mm" else 1.0


def computed_first(standard: Standard, probe: Probe) -> Component | None:
    """The component computed before a field's vector is laid off; None where there is none."""
    program = standard.mechanism.program
    for end in probe.steps:
        start, *rest = program.steps[end].args or (end,)
        for arg in rest if start in probe.steps else ():
            component = component_of(program, arg)
            if component is not None:
                return component
    return None


class OwnLengths(Struct, frozen=True):
    """A student's sizes by field, from which others are computed.

    Where no field states what a component needs, the key's value is used.
    """

    standard: Standard
    own: Mapping[str, Own]

    def computed(self, field: str, rounded: float) -> Iterator[Following]:
        """The values of a field by each relation to the student's other answers.

        ``rounded`` is the relative rounding of the field's answer.
        """
        standard = self.standard
        probe = standard.by_field[field]
        rubric, mm = standard.rubric, unit(standard, probe)
        error = hypot(rubric.point, rubric.ruler)
        for factors, size, bar in self.relations(probe):
            sources = tuple(dict.fromkeys(each.field for each in factors if each.field))
            if not sources or field in sources:
                continue
            written = min(rounded + sum(each.rounded for each in factors), COARSE)
            measured = error * standard.paper.millimetre(Plane.MECHANISM) / bar
            allowed = (max(rubric.floor, ROUNDED) + written + measured) * size / mm
            laid_off = error if probe.item.unit == "mm" else 0.0
            yield Following(field, sources, size / mm, allowed + laid_off)

    def relations(self, probe: Probe) -> Iterator[FormRelation]:
        """Each relation that results in the field."""
        step = self.standard.mechanism.program.steps[probe.step]
        if probe.vector:
            component = computed_first(self.standard, probe)
            if probe.item.what == "value":
                yield from (FormRelation((v,), v.size) for v in self.vectors(*probe.steps))
            if component is not None:
                yield from (FormRelation(e.factors, e.size, e.bar) for e in component.sizes(self))
        elif len(step.args) == 4:
            yield from self.rates(probe)
        elif probe.item.quantity == "slide speed":
            _, tail, tip = step.args
            yield from (FormRelation((v,), v.size) for v in self.vectors(tail, tip))

    def rates(self, probe: Probe) -> Iterator[FormRelation]:
        """A rate from the student's relative vector over the bar.

        For an angular acceleration this is the tangential component.
        """
        p, q, tail, tip = self.standard.mechanism.program.steps[probe.step].args
        bar = self.length(p, q)
        tails = {tail, self.standard.exact.tails.get(probe.step, tail)}
        if probe.item.quantity == EPSILON and len(tails) > 1:
            tails -= {tail}
        for start in sorted(tails):
            yield from (FormRelation((v,), v.size / bar, bar) for v in self.vectors(start, tip))

    def length(self, p: int, q: int) -> float:
        """The length of a bar."""
        values = self.standard.exact.trace.values
        return float(abs(values[q] - values[p]))

    def vectors(self, tail: int, tip: int) -> Iterator[Own]:
        """The student's sizes of the vector between two images."""
        for field, value in self.own.items():
            probe = self.standard.by_field[field]
            if probe.vector and {*probe.steps} == {tail, tip}:
                yield value

    def turnings_over(self, ends: tuple[int, ...]) -> Iterator[Own]:
        """The student's angular velocities read off the same points and images."""
        steps = self.standard.mechanism.program.steps
        for field, omega in self.own.items():
            probe = self.standard.by_field[field]
            if probe.item.quantity == OMEGA and steps[probe.step].args == ends:
                yield omega

    def turnings(self, rate: int) -> Iterator[Own]:
        """The angular velocities of a step: as answered, from velocities, then the key's."""
        for field, value in self.own.items():
            probe = self.standard.by_field[field]
            if probe.item.quantity == OMEGA and probe.step == rate:
                yield value
        args = self.standard.mechanism.program.steps[rate].args
        if len(args) == 4:
            bar = self.length(*args[:2])
            for v in self.vectors(*args[2:]):
                yield Own(v.size / bar, v.rounded, v.field)
        yield Own(abs(self.standard.exact.trace.values[rate]))

    def slidings(self, tail: int, tip: int) -> Iterator[Own]:
        """The sliding velocities: as answered, from vectors, then the key's."""
        steps = self.standard.mechanism.program.steps
        for field, value in self.own.items():
            probe = self.standard.by_field[field]
            if probe.item.quantity == "slide speed" and steps[probe.step].args[1:] == (tail, tip):
                yield value
        yield from self.vectors(tail, tip)
        yield Own(self.length(tail, tip))
