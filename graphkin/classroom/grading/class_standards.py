"""The standards of many variants: their scales and their pencil errors, in arrays.

Variants that differ only in the speed and angle of their drivers share one program; the others have
a program each. Keys equal those of single variants to the last digit. Drawings with pencil errors
are made for a block of variants at once, with an axis for the variants.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from typing import Any

from msgspec.structs import replace

from graphkin.accuracy.pencil import PencilMark
from graphkin.classroom.grading.end_positions import travel_keys
from graphkin.classroom.grading.standard import (
    FormLayout,
    Standard,
    alike,
    layout,
    pencil_errors,
    pencil_of,
    standard_at,
    with_force_scales,
)
from graphkin.classroom.lab.lab_model import Item, Rubric
from graphkin.classroom.lab.variant_scales import Scaling, by_arrays, scaled
from graphkin.construction.core.program import Program, Step
from graphkin.documents.scaling import scales, the_crank
from graphkin.drawing.scale import Scales
from graphkin.mechanism import Mechanism
from graphkin.numbers.arithmetic import np
from graphkin.scene.findings import Findings
from graphkin.scene.model import Scene, quantities_within
from graphkin.scene.parameters import set_values
from graphkin.scene.read_scene import read_text
from graphkin.structure.groups import Group, Tie

DRAWINGS = 8_192
"""The most drawings made at once, for all variants together."""
Settings = Mapping[str, str]


class VariantMechanism(Mechanism, frozen=True, dict=True, kw_only=True):
    """A mechanism with other data than ``like``, whose construction has the same steps."""

    like: Mechanism

    @cached_property
    def groups(self) -> tuple[Group, ...]:
        """The groups of ``like``."""
        return self.like.groups

    @cached_property
    def program(self) -> Program:
        """The program of ``like``."""
        return self.like.program

    @cached_property
    def with_forces(self) -> Mechanism:
        """The mechanism with the plan of forces of ``like``."""
        whole = self.like.with_forces
        return self if whole is self.like else VariantMechanism(self.scene, like=whole)


def standards(
    usual: Mechanism,
    text: str,
    form: Sequence[Item],
    rubric: Rubric,
    many: Sequence[tuple[Settings, tuple[str, ...]]],
) -> list[Standard]:
    """The standard of each variant of a scene, by its settings and its computed fields.

    ``usual`` is the mechanism of the scene in ``text``. Raises what
    :func:`~graphkin.classroom.grading.standard.standard` raises.
    """
    own = mechanisms(usual, text, [settings for settings, _ in many])
    shared = layout(usual, form)
    chosen = [
        with_force_scales(mechanism, scale, shared)
        for mechanism, scale in zip(own, all_scales(usual, own), strict=True)
    ]
    found = [
        single(mechanism, scale, shared, rubric, computed)
        for mechanism, scale, (_, computed) in zip(own, chosen, many, strict=True)
    ]
    pencil = pencil_of(rubric)
    for places in blocks(found):
        errors = pencil_errors([found[i].readings for i in places], pencil)
        for i, each in zip(places, errors, strict=True):
            found[i] = replace(found[i], errors=each)
    return found


def blocks(found: Sequence[Standard]) -> Iterator[list[int]]:
    """The indices of variants that draw the same, with at most ``DRAWINGS`` drawings together.

    Variants with groups of higher class are left out: these are closed for each variant alone.
    """
    for places in alike(found):
        marks = found[places[0]].exact.marks.values()
        if PencilMark.CLOSING in marks:
            continue
        size = max(1, DRAWINGS // (2 * sum(mark.errors for mark in marks) or 1))
        yield from (places[i : i + size] for i in range(0, len(places), size))


def single(
    mechanism: Mechanism,
    chosen: Scales,
    shared: FormLayout,
    rubric: Rubric,
    computed: tuple[str, ...],
) -> Standard:
    """The standard of one variant, without pencil errors.

    A variant whose steps differ gets its own layout.
    """
    whole = mechanism.with_forces
    form = shared if whole.program is shared.drawn else layout(mechanism, shared.items)
    keys = travel_keys(mechanism, form.items, chosen, pencil_of(rubric))
    return standard_at(mechanism, chosen, form, rubric, computed, keys)


# --- mechanisms and scales --------------------------------------------------------------------


def mechanisms(usual: Mechanism, text: str, many: Sequence[Settings]) -> list[Mechanism]:
    """The mechanism of each variant; variants that differ only in their drivers share steps."""
    scene = usual.scene
    changed = {name for each in many for name in each}
    if scene.time is None and by_driving(usual, changed):
        return [
            VariantMechanism(replace(scene, values=values_of(scene, each)), like=usual)
            for each in many
        ]
    texts = (read_text(text, scene.name, settings=dict(each), house=scene.house) for each in many)
    return [as_usual(Mechanism(each), usual) for each in texts]


def values_of(scene: Scene, settings: Settings) -> dict[str, Any]:
    """The exact data of a variant. Raises SceneError for values that the scene does not allow."""
    findings = Findings()
    values = set_values(scene.parameters, dict(settings), findings)
    findings.stop()
    return dict(values)


def by_driving(mechanism: Mechanism, names: set[str]) -> bool:
    """Whether the parameters only change how a mechanism of pins and guides is driven.

    Driving then selects no step. Two cases are excluded: an idle link, which may not fit, and
    requests whose construction depends on the position.
    """
    scene = mechanism.scene
    idle = any(isinstance(group, Tie) for group in mechanism.groups)
    if scene.ask.chosen_by_place or idle or not by_arrays(mechanism):
        return False
    shapes = quantities_within((scene.frame, *scene.links.values()))
    return not any(names.intersection(each.uses()) for each in shapes)


def as_usual(mechanism: Mechanism, usual: Mechanism) -> Mechanism:
    """The mechanism; it shares the steps of the usual one where its steps are the same."""
    own, known = mechanism.program, usual.program
    same = len(own.steps) == len(known.steps) and own.targets == known.targets
    if same and all(map(is_same, own.steps, known.steps)):
        return VariantMechanism(mechanism.scene, like=usual)
    return mechanism


def is_same(one: Step, other: Step) -> bool:
    """Whether two steps draw the same. Sizes that only set margins are ignored."""
    if one.extra == other.extra:
        return one == other
    return replace(one, extra=signs(one)) == replace(other, extra=signs(other))


def signs(step: Step) -> tuple[float, ...]:
    """The branches of a step."""
    return tuple(part for part in step.extra if isinstance(part, int))


def all_scales(usual: Mechanism, own: Sequence[Mechanism]) -> list[Scales]:
    """The scale factors of each variant's sheets."""
    like = [i for i, each in enumerate(own) if each.program is usual.program]
    known: dict[int, Scales] = {}
    if by_arrays(usual) and len(like) > 1:
        found = Scaling([None] * len(like))
        values = {
            name: np.array([float(own[i].scene.values[name]) for i in like])
            for name in usual.scene.values
        }
        scaled(usual, values, found)
        pairs = zip(like, found.own, strict=True)
        known = {i: as_sheet(own[i], each) for i, each in pairs if each is not None}
    return [known[i] if i in known else scales(each) for i, each in enumerate(own)]


def as_sheet(mechanism: Mechanism, found: Scales) -> Scales:
    """Scale factors equal to the last digit to those of a single sheet, set by one crank."""
    return replace(found, seconds=found.of_crank / the_crank(mechanism))
