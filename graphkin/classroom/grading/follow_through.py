"""Follow-through: the values that later fields take from a student's earlier values.

The relations of the form compute some of them. For the others, the student's length replaces ours
in the true direction, and the construction is run again.

The relations of a form: what a student computes from earlier answers, without the drawing.

A value is the student's segment times the scale. A rate is the student's relative vector over the
length of the bar. Components of accelerations follow as their constructions say. A block slides at
the speed of its relative vector. A computed length is laid off as it came out.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain
from math import hypot, inf, isnan
from typing import Any, NamedTuple

from msgspec import Struct
from msgspec.structs import replace

from graphkin.classroom.grading.answer_numbers import rounding
from graphkin.classroom.grading.graded import BLANK, Answer
from graphkin.classroom.grading.probes import Probe
from graphkin.classroom.grading.standard import Standard
from graphkin.construction.core.component import Component, component_of
from graphkin.construction.core.program import Plane
from graphkin.construction.core.quantities import EPSILON, OMEGA, TURNING
from graphkin.construction.core.vocabulary import part_along
from graphkin.construction.plan import TurningOfLink

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
    program = standard.layout.program
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
        step = self.standard.layout.program.steps[probe.step]
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
        p, q, tail, tip = self.standard.layout.program.steps[probe.step].args
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
        steps = self.standard.layout.program.steps
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
        args = self.standard.layout.program.steps[rate].args
        if len(args) == 4:
            bar = self.length(*args[:2])
            for v in self.vectors(*args[2:]):
                yield Own(v.size / bar, v.rounded, v.field)
        yield Own(abs(self.standard.exact.trace.values[rate]))

    def slidings(self, tail: int, tip: int) -> Iterator[Own]:
        """The sliding velocities: as answered, from vectors, then the key's."""
        steps = self.standard.layout.program.steps
        for field, value in self.own.items():
            probe = self.standard.by_field[field]
            if probe.item.quantity == "slide speed" and steps[probe.step].args[1:] == (tail, tip):
                yield value
        yield from self.vectors(tail, tip)
        yield Own(self.length(tail, tip))


EASY = 0.1
"""The part of the right value below which a value is too easy to be followed, or to follow."""
WILD = 30.0
"""The largest factor of the right value at which a student's value is still followed."""
SPAN = (0.5, 2.0)
"""The least and largest factor by which a tolerance scales with its value."""
ALIKE = 1e-9
"""The relative difference up to which vectors are the same."""
Answers = Mapping[str, Answer]


def followings(
    standard: Standard, answers: Answers, wrong: tuple[str, ...], right: tuple[str, ...]
) -> Iterator[Following]:
    """All values that follow from a student's answers, for wrong fields.

    Formulas also use right answers, named after wrong ones in the sources; the drawing uses wrong
    answers only. For a wrong sense, the size of its rate is included.
    """
    sources = {field: own_value(standard, answers, field) for field in numbers(standard, wrong)}
    sources = {field: value for field, value in sources.items() if is_fit(standard, field, value)}
    known = (*sources, *numbers(standard, right))
    sized = (standard.by_field[field].item.sized for field in wrong)
    fields = (*wrong, *(field for field in sized if field in right))
    candidates = chain(
        by_formula(standard, answers, known, wrong), by_drawing(standard, sources, fields)
    )
    return (each for each in candidates if not too_easy(standard, answers, each))


def rightly(
    standard: Standard, answers: Answers, wrong: tuple[str, ...], right: tuple[str, ...]
) -> dict[str, Following]:
    """The values that follow by formula from right answers, for fields off the key.

    A value may also follow from values found in this way.
    """
    found: dict[str, Following] = {}
    while True:
        known = numbers(standard, (*right, *found))
        rest = tuple(field for field in wrong if field not in found)
        candidates = by_formula(standard, answers, known, rest)
        more = {each.field: each for each in candidates if is_hit(standard, each, answers)}
        if not more:
            return found
        found |= more


def is_hit(standard: Standard, following: Following, answers: Answers) -> bool:
    """Whether an answer agrees with the value that follows."""
    value = float(answers[following.field].value or 0.0)
    item = standard.by_field[following.field].item
    if item.what == "sense":
        return value == following.value
    return abs(item.off(value, following.value)) <= following.tolerance


def by_formula(
    standard: Standard, answers: Answers, known: Sequence[str], fields: tuple[str, ...]
) -> Iterator[Following]:
    """The values that the relations of the form give from known answers."""
    own = {
        field: Own(si(standard, field, size(answers, field)), rounding(answers[field]), field)
        for field in known
    }
    lengths = OwnLengths(standard, own)
    for field in numbers(standard, fields):
        for following in lengths.computed(field, rounding(answers[field])):
            first = sorted(following.sources, key=known.index)
            yield replace(following, sources=tuple(first))


def numbers(standard: Standard, fields: tuple[str, ...]) -> list[str]:
    """The fields that are the size of a vector or a rate."""
    return [f for f in fields if standard.by_field[f].item.what in ("segment", "value")]


def size(answers: Answers, field: str) -> float:
    """The absolute value of an answer that was read."""
    return abs(answers[field].value or 0.0)


def own_value(standard: Standard, answers: Answers, field: str) -> float:
    """The student's value of a field; a rate is signed by the answered sense, else by the key."""
    sense = answers.get(standard.by_field[field].item.beside("sense"), BLANK).value
    return size(answers, field) * (sense or (1.0 if standard.key[field] >= 0 else -1.0))


def is_fit(standard: Standard, field: str, value: float) -> bool:
    """Whether a student's value may be followed: neither nearly zero nor far too large."""
    right = abs(standard.key[field])
    return EASY * right <= abs(value) <= WILD * right and abs(value) > 0


def too_easy(standard: Standard, answers: Answers, following: Following) -> bool:
    """Whether the value that follows is nearly zero, so that a wrong start made the work trivial.

    A value that changed its sign, with an answered sense to match, is not too easy.
    """
    field, value = following.field, following.value
    item, right = standard.by_field[field].item, standard.key[field]
    if item.what == "sense":
        return value == 0
    if item.what == "place":
        return isnan(value)
    if abs(value) <= following.tolerance:
        return True
    sense = answers.get(standard.by_field[field].item.beside("sense"), BLANK).value or 0.0
    turned = value * right < 0 < value * sense
    return abs(value) < EASY * abs(right) and not turned


# --- the drawing --------------------------------------------------------------------------------


def by_drawing(
    standard: Standard, sources: Mapping[str, float], wrong: tuple[str, ...]
) -> Iterator[Following]:
    """The values that the construction gives from each length alone, and from all together.

    The lengths are the student's.
    """
    values = standard.exact.trace.values
    single = {field: put_in_place(standard, field, value) for field, value in sources.items()}
    single = {field: overrides for field, overrides in single.items() if overrides}
    seen: list[Mapping[int, Any]] = []
    own = [((field,), overrides) for field, overrides in single.items()]
    for fields, overrides in (*own, *together(single)):
        given = [{*standard.by_field[field].steps} for field in fields]
        for found in reruns(standard, overrides) if overrides not in seen else ():
            read = standard.read(found)
            for other in wrong:
                steps = {*standard.by_field[other].steps}
                if steps not in given and any(found[step] != values[step] for step in steps):
                    for value in (read[other], *closing(standard, other, found, read[other])):
                        error = drawing_error(standard, other, value)
                        yield Following(other, fields, value, error, drawn=True)
        seen.append(overrides)


def reruns(standard: Standard, overrides: Mapping[int, Any]) -> Iterator[Mapping[int, Any]]:
    """The construction run again from a student's lengths.

    A second run takes the components computed from its velocities as they measure on the plan,
    though the directions no longer fit.
    """
    values = standard.exact.trace.values
    found = standard.rerun(overrides)
    if not found:
        return
    yield found
    measured: dict[int, Any] = {}
    for number in standard.layout.needed:
        component = component_of(standard.layout.program, number)
        if component is not None and number not in overrides:
            vector = component.as_measured(found, values)
            measured |= {} if vector is None else {number: vector}
    if any(abs(value - found[n]) > ALIKE * abs(value) for n, value in measured.items()):
        again = standard.rerun({**overrides, **measured})
        if again:
            yield again


def closing(
    standard: Standard, field: str, found: Mapping[int, Any], read_value: float
) -> Iterator[float]:
    """A rate or a slide speed from the whole vector that closes the plan.

    After a wrong length, a student measures this vector although its direction no longer fits.
    """
    probe = standard.by_field[field]
    step = standard.layout.program.steps[probe.step]
    turns = isinstance(step.of, TurningOfLink)
    if probe.vector or probe.item.what != "value" or not (turns or step.action is part_along):
        return
    *line, tail, tip = step.args
    start = standard.exact.tails.get(probe.step, tail)
    bar = abs(found[line[1]] - found[line[0]]) if turns else 1.0
    length = float(abs(found[tip] - found[start]) / bar)
    yield length if read_value >= 0 else -length


def together(
    single: Mapping[str, Mapping[int, Any]],
) -> Iterator[tuple[tuple[str, ...], Mapping[int, Any]]]:
    """All lengths of a student at once; where several replace the same step, the first one."""
    if len(single) > 1:
        merged: dict[int, Any] = {}
        for overrides in reversed(list(single.values())):
            merged |= overrides
        yield tuple(single), merged


def put_in_place(standard: Standard, field: str, value: float) -> dict[int, Any]:
    """The steps that a student's value replaces.

    For a vector, its end that is drawn last. For a rate or a slide speed, its step and the
    components computed from it.
    """
    probe, values = standard.by_field[field], standard.exact.trace.values
    if probe.vector:
        first, last = min(probe.steps), max(probe.steps)
        arrow = values[last] - values[first]
        return {last: values[first] + arrow * (si(standard, field, value) / abs(arrow))}
    if probe.item.quantity not in (*TURNING, "slide speed"):
        return {}
    ratio = value / values[probe.step]
    return {probe.step: value, **components_with(standard, probe.step, ratio)}


def components_with(standard: Standard, number: int, ratio: float) -> dict[int, Any]:
    """The components computed from a rate or speed ``ratio`` times the right one.

    Components that use its step follow by themselves.
    """
    program, values = standard.layout.program, standard.exact.trace.values
    found: dict[int, Any] = {}
    for other in standard.layout.needed:
        component = component_of(program, other)
        power = component.power_of(program.steps[number].args) if component else 0
        if power:
            found[other] = ratio**power * values[other]
    return found


def drawing_error(standard: Standard, field: str, value: float) -> float:
    """The tolerance of a field drawn from a student's values.

    It is the tolerance of the key, scaled with the size of the value.
    """
    probe = standard.by_field[field]
    if probe.item.what == "sense":
        return 0.0
    allowed = standard.tolerance[field].value
    right = abs(standard.key[field])
    if probe.item.what == "place" or not right:
        return allowed
    return allowed * min(max(abs(value) / right, SPAN[0]), SPAN[1])
