"""What follows from a student's own values: later fields told by the own earlier ones.

At the level of formulas it is what the relations of the form make of them. At the level of the
drawing the own length, laid off in the true direction, takes the place of ours, and the
construction is run again from it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain
from math import isnan
from typing import Any

from msgspec.structs import replace

from graphkin.classroom.grading.answer_numbers import rounding
from graphkin.classroom.grading.form_relations import Following, Own, OwnLengths, si
from graphkin.classroom.grading.graded import BLANK, Answer
from graphkin.classroom.grading.standard import Standard
from graphkin.construction.core.component import component_of
from graphkin.construction.core.quantities import TURNING
from graphkin.construction.core.vocabulary import part_along
from graphkin.construction.velocity.turning_of_link import TurningOfLink

EASY = 0.1
"""Part of the right value below which an own value, or what follows from it, is too easy."""
WILD = 30.0
"""How many times the right value an own value may be and still be followed."""
SPAN = (0.5, 2.0)
"""Between which times of the key's a tolerance grows with what it belongs to."""
ALIKE = 1e-9
"""Vectors that differ by no more than this share are the same."""
Answers = Mapping[str, Answer]


def followings(
    standard: Standard, answers: Answers, wrong: tuple[str, ...], right: tuple[str, ...]
) -> Iterator[Following]:
    """All that follows for wrong fields from own values: by formula from right ones too, which are
    named after wrong ones; by drawing from wrong ones. Of a wrong sense its rate's size as well.
    """
    sources = {field: own_value(standard, answers, field) for field in numbers(standard, wrong)}
    sources = {field: value for field, value in sources.items() if is_fit(standard, field, value)}
    known = (*sources, *numbers(standard, right))
    sized = (standard.by_field[field].item.sized for field in wrong)
    fields = (*wrong, *(field for field in sized if field in right))
    told = chain(by_formula(standard, answers, known, wrong), by_drawing(standard, sources, fields))
    return (each for each in told if not too_easy(standard, answers, each))


def rightly(
    standard: Standard, answers: Answers, wrong: tuple[str, ...], right: tuple[str, ...]
) -> dict[str, Following]:
    """What follows, for fields off the key, by formula from nothing but right own values; or from
    values that follow from those in turn.
    """
    found: dict[str, Following] = {}
    while True:
        known = numbers(standard, (*right, *found))
        rest = tuple(field for field in wrong if field not in found)
        told = by_formula(standard, answers, known, rest)
        more = {each.field: each for each in told if is_hit(standard, each, answers)}
        if not more:
            return found
        found |= more


def is_hit(standard: Standard, following: Following, answers: Answers) -> bool:
    """Whether an answer is what follows."""
    value = float(answers[following.field].value or 0.0)
    item = standard.by_field[following.field].item
    if item.what == "sense":
        return value == following.value
    return abs(item.off(value, following.value)) <= following.tolerance


def by_formula(
    standard: Standard, answers: Answers, known: Sequence[str], fields: tuple[str, ...]
) -> Iterator[Following]:
    """What the relations of the form make of known own values."""
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
    """Those of some fields that are the size of a vector, or a rate."""
    return [f for f in fields if standard.by_field[f].item.what in ("segment", "value")]


def size(answers: Answers, field: str) -> float:
    """The size of an answer that was read."""
    return abs(answers[field].value or 0.0)


def own_value(standard: Standard, answers: Answers, field: str) -> float:
    """An own value: of a rate with the own sense, with the key's where none was stated."""
    sense = answers.get(standard.by_field[field].item.beside("sense"), BLANK).value
    return size(answers, field) * (sense or (1.0 if standard.key[field] >= 0 else -1.0))


def is_fit(standard: Standard, field: str, value: float) -> bool:
    """Whether an own value may be followed: neither nearly zero nor wild."""
    right = abs(standard.key[field])
    return EASY * right <= abs(value) <= WILD * right and abs(value) > 0


def too_easy(standard: Standard, answers: Answers, following: Following) -> bool:
    """Whether what follows is nearly zero, so that a wrong start made the work trivial.

    What has passed through zero and was told to turn the other way is not.
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
    """What the construction tells from each own length by itself, and from all of them."""
    values = standard.exact.trace.values
    single = {field: put_in_place(standard, field, value) for field, value in sources.items()}
    single = {field: overrides for field, overrides in single.items() if overrides}
    seen: list[Mapping[int, Any]] = []
    own = [((field,), overrides) for field, overrides in single.items()]
    for fields, overrides in (*own, *together(single)):
        given = [{*standard.by_field[field].steps} for field in fields]
        for found in reruns(standard, overrides) if overrides not in seen else ():
            told = standard.read(found)
            for other in wrong:
                steps = {*standard.by_field[other].steps}
                if steps not in given and any(found[step] != values[step] for step in steps):
                    for value in (told[other], *closing(standard, other, found, told[other])):
                        error = drawing_error(standard, other, value)
                        yield Following(other, fields, value, error, drawn=True)
        seen.append(overrides)


def reruns(standard: Standard, overrides: Mapping[int, Any]) -> Iterator[Mapping[int, Any]]:
    """The construction run again from own lengths; and with the components that are computed from
    its velocities as they are measured, though these no longer lie as they should.
    """
    values = standard.exact.trace.values
    found = standard.rerun(overrides)
    if not found:
        return
    yield found
    measured: dict[int, Any] = {}
    for number in standard.layout.needed:
        component = component_of(standard.mechanism.program, number)
        if component is not None and number not in overrides:
            vector = component.as_measured(found, values)
            measured |= {} if vector is None else {number: vector}
    if any(abs(value - found[n]) > ALIKE * abs(value) for n, value in measured.items()):
        again = standard.rerun({**overrides, **measured})
        if again:
            yield again


def closing(
    standard: Standard, field: str, found: Mapping[int, Any], told: float
) -> Iterator[float]:
    """A rate over the bar, or a speed along a guide, from the whole vector that closes the plan:
    with an own length that is measured, though it no longer lies as it should.
    """
    probe = standard.by_field[field]
    step = standard.mechanism.program.steps[probe.step]
    turns = isinstance(step.of, TurningOfLink)
    if probe.vector or probe.item.what != "value" or not (turns or step.action is part_along):
        return
    *line, tail, tip = step.args
    start = standard.exact.tails.get(probe.step, tail)
    bar = abs(found[line[1]] - found[line[0]]) if turns else 1.0
    length = float(abs(found[tip] - found[start]) / bar)
    yield length if told >= 0 else -length


def together(
    single: Mapping[str, Mapping[int, Any]],
) -> Iterator[tuple[tuple[str, ...], Mapping[int, Any]]]:
    """All own lengths at once, the first of those that replace the same."""
    if len(single) > 1:
        merged: dict[int, Any] = {}
        for overrides in reversed(list(single.values())):
            merged |= overrides
        yield tuple(single), merged


def put_in_place(standard: Standard, field: str, value: float) -> dict[int, Any]:
    """The steps that an own value replaces: the end of a vector that is drawn last; a rate or the
    speed of a block, and the components that are computed with it.
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
    """The components that are computed with a rate or a speed so many times the right one.

    Those that use its step follow by themselves.
    """
    program, values = standard.mechanism.program, standard.exact.trace.values
    found: dict[int, Any] = {}
    for other in standard.layout.needed:
        component = component_of(program, other)
        power = component.power_of(program.steps[number].args) if component else 0
        if power:
            found[other] = ratio**power * values[other]
    return found


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
