"""What follows from a student's own values: later fields told by the own earlier ones.

At the level of formulas a value is the own segment times the scale, a rate the own relative vector
over the bar, a normal component v²/l. At the level of the drawing the own length, laid off in the
true direction, takes the place of ours, and the construction is run again from it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from graphkin.grading.model import Answer
from graphkin.grading.probes import Probe
from graphkin.grading.standard import Standard
from graphkin.steps.program import Plane

EASY = 0.1
"""Part of the right value below which an own value, or what follows from it, is too easy."""
WILD = 30.0
"""How many times the right value an own value may be and still be followed."""
ROUNDED = 0.005
"""Share by which a value that is only reckoned may be rounded."""
SPAN = (0.5, 2.0)
"""Between which times of the key's a tolerance grows with what it belongs to."""


@dataclass(frozen=True, slots=True)
class Following:
    """A value that a field would have, after the own value of another, and how near it must be."""

    field: str
    source: str
    value: float
    tolerance: float


def followings(
    standard: Standard, answers: Mapping[str, Answer], wrong: tuple[str, ...]
) -> Iterator[Following]:
    """All that follows for wrong fields from a student's own wrong values."""
    own = {field: float(answers[field].value or 0.0) for field in wrong}
    numbers = {field: value for field, value in own.items() if is_number(standard, field)}
    sources = {field: v for field, v in numbers.items() if is_fit(standard, field, v)}
    for following in by_formula(standard, sources, wrong):
        if not too_easy(standard, following):
            yield following
    for following in by_drawing(standard, sources, wrong):
        if not too_easy(standard, following):
            yield following


def is_number(standard: Standard, field: str) -> bool:
    """Whether a field is the size of a vector, or a rate."""
    return standard.by_field[field].item.what in ("segment", "value")


def is_fit(standard: Standard, field: str, value: float) -> bool:
    """Whether an own value may be followed: neither nearly nought nor wild."""
    right = abs(standard.key[field])
    return EASY * right <= abs(value) <= WILD * right and abs(value) > 0


def too_easy(standard: Standard, following: Following) -> bool:
    """Whether what follows is nearly nought, so that a wrong start made the work trivial."""
    item = standard.by_field[following.field].item
    if item.what == "sense":
        return following.value == 0
    if item.what == "place":
        return following.value != following.value
    size, right = abs(following.value), abs(standard.key[following.field])
    return not (size >= EASY * right and size > following.tolerance)


# --- formulas ---------------------------------------------------------------------------------


def by_formula(
    standard: Standard, sources: Mapping[str, float], wrong: tuple[str, ...]
) -> Iterator[Following]:
    """Values that are reckoned from an own segment or an own vector."""
    for field in wrong:
        probe = standard.by_field[field]
        if probe.item.what != "value":
            continue
        for source, value in reckoned(standard, probe, sources):
            yield Following(field, source, value, reckoning_error(standard, value))


def reckoning_error(standard: Standard, value: float) -> float:
    """How far a reckoned value may be off."""
    return max(standard.rubric.floor, ROUNDED) * abs(value)


def reckoned(
    standard: Standard, probe: Probe, sources: Mapping[str, float]
) -> Iterator[tuple[str, float]]:
    """Each own field from which one is reckoned, with what comes out."""
    if probe.vector:
        segment = f"{probe.item.field}_mm"
        if segment in sources:
            yield segment, sources[segment] * standard.paper.millimetre(probe.plane)
        yield from normal_from(standard, probe, sources)
    else:
        yield from rate_from(standard, probe, sources)


def si(standard: Standard, field: str, value: float) -> float:
    """An own size of a vector in SI, from its segment or as it was reckoned."""
    probe = standard.by_field[field]
    return value * (standard.paper.millimetre(probe.plane) if probe.item.unit == "mm" else 1.0)


def normal_from(
    standard: Standard, probe: Probe, sources: Mapping[str, float]
) -> Iterator[tuple[str, float]]:
    """A normal component from the own relative velocity: v²/l."""
    found = normal_step(standard, probe)
    if found is None:
        return
    p, q, tail, tip = found
    values = standard.exact.trace.values
    bar = abs(values[q] - values[p])
    for field, value in sources.items():
        steps = standard.by_field[field].steps
        if standard.by_field[field].vector and set(steps) == {tail, tip}:
            yield field, si(standard, field, value) ** 2 / bar


def normal_step(standard: Standard, probe: Probe) -> tuple[int, ...] | None:
    """The bar and the images from which a normal component is reckoned; None for others."""
    steps = standard.mechanism.program.steps
    lay_off = steps[probe.step]
    for arg in lay_off.args:
        action = steps[arg].action
        if action is not None and action.key == "normal" and probe.plane is Plane.ACCELERATIONS:
            return steps[arg].args
    return None


def rate_from(
    standard: Standard, probe: Probe, sources: Mapping[str, float]
) -> Iterator[tuple[str, float]]:
    """A rate from the own relative vector over the bar: of an acceleration its tangential part."""
    step, values = standard.mechanism.program.steps[probe.step], standard.exact.trace.values
    if len(step.args) != 4:
        return
    p, q, tail, tip = step.args
    bar = abs(values[q] - values[p])
    tails = {tail, standard.exact.tails.get(probe.step, tail)}
    if step.action is not None and step.action.key == "epsilon":
        tails = tails - {tail} if len(tails) > 1 else tails
    for field, value in sources.items():
        steps = standard.by_field[field].steps
        if standard.by_field[field].vector and steps[-1] == tip and steps[0] in tails:
            yield field, si(standard, field, value) / bar


# --- the drawing --------------------------------------------------------------------------------


def by_drawing(
    standard: Standard, sources: Mapping[str, float], wrong: tuple[str, ...]
) -> Iterator[Following]:
    """What the construction tells from each own length by itself, and from all of them."""
    single = {field: put_in_place(standard, field, value) for field, value in sources.items()}
    single = {field: overrides for field, overrides in single.items() if overrides}
    seen: list[Mapping[int, Any]] = []
    for field, overrides in (*single.items(), *together(single)):
        if overrides in seen:
            continue
        seen.append(overrides)
        told = standard.told(overrides)
        below = descendants(standard, overrides)
        for other in wrong:
            probe = standard.by_field[other]
            if other in told and probe.step in below and probe.step not in overrides:
                value = told[other]
                yield Following(other, field, value, drawing_error(standard, other, value))


def together(single: Mapping[str, Mapping[int, Any]]) -> Iterator[tuple[str, Mapping[int, Any]]]:
    """All own lengths at once, under the name of the first."""
    if len(single) > 1:
        merged: dict[int, Any] = {}
        for overrides in reversed(list(single.values())):
            merged |= overrides
        yield next(iter(single)), merged


def put_in_place(standard: Standard, field: str, value: float) -> dict[int, Any]:
    """The steps that an own value replaces: the tip of a vector, a rate and its normals."""
    probe, values = standard.by_field[field], standard.exact.trace.values
    if probe.vector:
        tail, tip = (values[step] for step in probe.steps)
        right = abs(tip - tail)
        return {probe.step: tail + (tip - tail) * (abs(si(standard, field, value)) / right)}
    if probe.item.quantity not in ("omega", "epsilon"):
        return {}
    right = values[probe.step]
    own = abs(value) if right >= 0 else -abs(value)
    return {probe.step: own, **normals_of(standard, probe.step, own)}


def normals_of(standard: Standard, rate: int, own: float) -> dict[int, Any]:
    """The normal components that are reckoned as ω²·l with the own angular velocity."""
    steps, values = standard.mechanism.program.steps, standard.exact.trace.values
    args = steps[rate].args
    found: dict[int, Any] = {}
    for number in standard.needed:
        action = steps[number].action
        if action is not None and action.key == "normal" and steps[number].args == args:
            found[number] = own * own * (values[args[0]] - values[args[1]])
    return found


def descendants(standard: Standard, overrides: Mapping[int, Any]) -> frozenset[int]:
    """The steps that hang on some steps."""
    return frozenset().union(*(standard.layout.below(number) for number in overrides))


def drawing_error(standard: Standard, field: str, value: float) -> float:
    """How far a field that is drawn from own values may be off: as the key's, by its size."""
    probe = standard.by_field[field]
    if probe.item.what == "sense":
        return 0.0
    allowed = standard.tolerance[field].value
    right = abs(standard.key[field])
    if probe.item.what == "place" or not right:
        return allowed
    return allowed * min(max(abs(value) / right, SPAN[0]), SPAN[1])
