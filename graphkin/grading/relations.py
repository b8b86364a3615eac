"""The relations of a form: what a student computes from own values, without the drawing.

A value is the own segment times the scale, a rate the own relative vector over the bar, a normal
component v²/l or ω²·l, the Coriolis component 2·ω·v; a block slides as fast as its relative vector
says. What is computed is laid off as long as it came out.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import product
from math import hypot, inf
from typing import NamedTuple

from graphkin.grading.probes import Probe
from graphkin.grading.standard import Standard
from graphkin.steps.program import Plane, Step

ROUNDED = 0.005
"""Share by which a value that is only computed may be rounded."""
COARSE = 0.05
"""Numbers as they are written are rounded by no more than this share: two digits."""
COMPONENTS = ("normal", "coriolis")
"""Vectors that are computed before they are laid off."""


@dataclass(frozen=True, slots=True)
class Own:
    """A student's own size in SI, the share by which it is rounded, and the field that states it;
    the key's where no field does.
    """

    size: float
    rounded: float = 0.0
    field: str = ""


@dataclass(frozen=True, slots=True)
class Following:
    """A value that a field would have, after the own values of others, and how near it must be;
    ``drawn`` where the construction tells it.
    """

    field: str
    sources: tuple[str, ...]
    value: float
    tolerance: float
    drawn: bool = False


class Relation(NamedTuple):
    """Own values as factors, what comes of them in SI, and the bar that is in it, in metres."""

    factors: tuple[Own, ...]
    size: float
    bar: float = inf


Values = Mapping[str, Own]


def si(standard: Standard, field: str, value: float) -> float:
    """A number of a field in SI: a segment by the scale of its drawing."""
    return abs(value) * unit(standard, standard.by_field[field])


def unit(standard: Standard, probe: Probe) -> float:
    """The unit of a field in SI."""
    return standard.paper.millimetre(probe.plane) if probe.item.unit == "mm" else 1.0


def computed(standard: Standard, own: Values, field: str, rounded: float) -> Iterator[Following]:
    """What a field would be by each relation to own values, itself ``rounded`` by a share."""
    probe = standard.by_field[field]
    rubric, mm = standard.rubric, unit(standard, probe)
    error = hypot(rubric.point, rubric.ruler)
    for factors, size, bar in relations(standard, own, probe):
        sources = tuple(dict.fromkeys(each.field for each in factors if each.field))
        if not sources or field in sources:
            continue
        written = min(rounded + sum(each.rounded for each in factors), COARSE)
        measured = error * standard.paper.millimetre(Plane.MECHANISM) / bar
        allowed = (max(rubric.floor, ROUNDED) + written + measured) * size / mm
        laid_off = error if probe.item.unit == "mm" else 0.0
        yield Following(field, sources, size / mm, allowed + laid_off)


def relations(standard: Standard, own: Values, probe: Probe) -> Iterator[Relation]:
    """Each relation in which a field is what comes out."""
    step = standard.mechanism.program.steps[probe.step]
    if probe.vector:
        component = component_of(standard, probe)
        if probe.item.what == "value":
            yield from (Relation((v,), v.size) for v in vectors(standard, own, *probe.steps))
        if component is not None:
            yield from components(standard, own, component)
    elif len(step.args) == 4:
        yield from rates(standard, own, probe)
    elif probe.item.quantity == "slide speed":
        _, tail, tip = step.args
        yield from (Relation((v,), v.size) for v in vectors(standard, own, tail, tip))


def vectors(standard: Standard, own: Values, tail: int, tip: int) -> Iterator[Own]:
    """The own sizes of the vector between two images."""
    for field, value in own.items():
        probe = standard.by_field[field]
        if probe.vector and {*probe.steps} == {tail, tip}:
            yield value


def rates(standard: Standard, own: Values, probe: Probe) -> Iterator[Relation]:
    """A rate from the own relative vector over the bar: of an acceleration its tangential part."""
    step = standard.mechanism.program.steps[probe.step]
    p, q, tail, tip = step.args
    bar = length(standard, p, q)
    tails = {tail, standard.exact.tails.get(probe.step, tail)}
    if probe.item.quantity == "epsilon" and len(tails) > 1:
        tails -= {tail}
    for start in sorted(tails):
        yield from (Relation((v,), v.size / bar, bar) for v in vectors(standard, own, start, tip))


def length(standard: Standard, p: int, q: int) -> float:
    """The length of a bar."""
    values = standard.exact.trace.values
    return float(abs(values[q] - values[p]))


def component_of(standard: Standard, probe: Probe) -> Step | None:
    """The step that computes the vector of a field, which is then laid off; None for others."""
    steps = standard.mechanism.program.steps
    for end in probe.steps:
        start, *rest = steps[end].args or (end,)
        for arg in rest if start in probe.steps else ():
            action = steps[arg].action
            if action is not None and action.key in COMPONENTS:
                return steps[arg]
    return None


def components(standard: Standard, own: Values, step: Step) -> Iterator[Relation]:
    """A normal component as v²/l or ω²·l, a Coriolis component as 2·ω·v."""
    if len(step.args) == 4:
        p, q, tail, tip = step.args
        bar = length(standard, p, q)
        for v in vectors(standard, own, tail, tip):
            yield Relation((v, v), v.size**2 / bar, bar)
        for field, omega in own.items():
            probe = standard.by_field[field]
            steps = standard.mechanism.program.steps
            if probe.item.quantity == "omega" and steps[probe.step].args == step.args:
                yield Relation((omega, omega), omega.size**2 * bar, bar)
        return
    rate, tail, tip = step.args
    for omega, v in product(turnings(standard, own, rate), slidings(standard, own, tail, tip)):
        yield Relation((omega, v), 2 * omega.size * v.size)


def turnings(standard: Standard, own: Values, rate: int) -> Iterator[Own]:
    """The own angular velocities of what guides, from own velocities too; then the key's."""
    for field, value in own.items():
        probe = standard.by_field[field]
        if probe.item.quantity == "omega" and probe.step == rate:
            yield value
    args = standard.mechanism.program.steps[rate].args
    if len(args) == 4:
        bar = length(standard, *args[:2])
        for v in vectors(standard, own, *args[2:]):
            yield Own(v.size / bar, v.rounded, v.field)
    yield Own(abs(standard.exact.trace.values[rate]))


def slidings(standard: Standard, own: Values, tail: int, tip: int) -> Iterator[Own]:
    """The own velocities of what slides along its guide; then the key's."""
    steps = standard.mechanism.program.steps
    for field, value in own.items():
        probe = standard.by_field[field]
        if probe.item.quantity == "slide speed" and steps[probe.step].args[1:] == (tail, tip):
            yield value
    yield from vectors(standard, own, tail, tip)
    yield Own(length(standard, tail, tip))
