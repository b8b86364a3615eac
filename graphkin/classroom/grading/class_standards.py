"""What the answers to many variants are held against: their scales and their pencils in arrays.

Variants that differ only in how fast and at which angle they are driven share one program; the
others are written each by itself. Keys are those of single variants, to the last digit. Drawings
with a pencil are made for as many variants at once as go into a block, an axis for each.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from typing import Any

from msgspec.structs import replace

from graphkin.accuracy.pencil.forecast import sources
from graphkin.accuracy.pencil.original import Original, original
from graphkin.accuracy.pencil.pencil import Pencil
from graphkin.accuracy.pencil.pencil_marks import Paper, PencilMark
from graphkin.accuracy.pencil.redrawing import redrawn
from graphkin.classroom.grading.standard import FormLayout, Standard, layout
from graphkin.classroom.grading.tolerance import (
    Errors,
    added,
    covariance,
    joint_errors,
    readings_of,
)
from graphkin.classroom.lab.lab_model import Item, Rubric
from graphkin.classroom.lab.variant_scales import by_arrays, empty, scaled
from graphkin.construction.core.program import Program, Step
from graphkin.construction.core.run import Trace
from graphkin.documents.scaling import scales, the_crank
from graphkin.drawing.scale import Scales
from graphkin.mechanism import Mechanism
from graphkin.scene.findings import Findings
from graphkin.scene.model import Scene
from graphkin.scene.parameters import set_values
from graphkin.scene.quantity import Quantity
from graphkin.scene.read_scene import read_text
from graphkin.structure.groups import Group, Tie

CRANK = 1e-9
"""Part by which seconds may differ from those of the crank and still be them."""
DRAWINGS = 8_192
"""Drawings made at once, of all variants together."""
Settings = Mapping[str, str]


class VariantMechanism(Mechanism, frozen=True, dict=True):
    """A mechanism with other data than one that is ready, whose construction has the same steps."""

    like: Mechanism

    @cached_property
    def groups(self) -> tuple[Group, ...]:
        """Those of the other."""
        return self.like.groups

    @cached_property
    def program(self) -> Program:
        """That of the other."""
        return self.like.program


def standards(
    usual: Mechanism,
    text: str,
    form: Sequence[Item],
    rubric: Rubric,
    many: Sequence[tuple[Settings, tuple[str, ...]]],
) -> list[Standard]:
    """The standard of each variant of a scene, by its settings and the fields that are computed.

    ``usual`` is the scene as its ``text`` says. Raises what a single one raises.
    """
    own = mechanisms(usual, text, [settings for settings, _ in many])
    chosen = all_scales(usual, own)
    shared = layout(usual, form)
    found = [
        single(mechanism, scale, shared, rubric, computed)
        for mechanism, scale, (_, computed) in zip(own, chosen, many, strict=True)
    ]
    pencil = Pencil(rubric.point, rubric.line)
    for places in alike(found):
        errors = errors_of([found[i] for i in places], pencil)
        for i, each in zip(places, errors, strict=True):
            found[i] = replace(found[i], errors=each)
    return found


def single(
    mechanism: Mechanism,
    chosen: Scales,
    shared: FormLayout,
    rubric: Rubric,
    computed: tuple[str, ...],
) -> Standard:
    """One variant, its pencil left out; it has a layout of its own where its steps are others."""
    same = mechanism.program is shared.program
    form = shared if same else layout(mechanism, shared.items)
    exact = original(mechanism, chosen, form.targets)
    return Standard(mechanism, chosen, form, exact, rubric, computed)


# --- mechanisms and scales --------------------------------------------------------------------


def mechanisms(usual: Mechanism, text: str, many: Sequence[Settings]) -> list[Mechanism]:
    """The mechanism of each variant; those that differ only in their driving share its steps."""
    scene = usual.scene
    changed = {name for each in many for name in each}
    if scene.time is None and by_driving(usual, changed):
        return [
            VariantMechanism(replace(scene, values=values_of(scene, each)), usual) for each in many
        ]
    texts = (read_text(text, scene.name, settings=dict(each)) for each in many)
    return [as_usual(Mechanism(each), usual) for each in texts]


def values_of(scene: Scene, settings: Settings) -> dict[str, Any]:
    """The exact data of a variant. Raises SceneError for what the scene does not allow."""
    findings = Findings()
    values = set_values(scene.parameters, dict(settings), findings)
    findings.stop()
    return dict(values)


def by_driving(mechanism: Mechanism, names: set[str]) -> bool:
    """Whether parameters only say how a mechanism of pins and guides is driven.

    No step is then chosen by them: an idle link fits or not, and relative centres and inflection
    poles are found in ways that hang on the position.
    """
    scene = mechanism.scene
    chosen = scene.ask.pairs or scene.ask.inflection
    idle = any(isinstance(group, Tie) for group in mechanism.groups)
    if chosen or idle or not by_arrays(mechanism):
        return False
    return not names.intersection(used((scene.frame, *scene.links.values())))


def used(part: object) -> Iterator[str]:
    """The parameters that occur in a part of a scene."""
    if isinstance(part, Quantity):
        yield from part.uses()
    elif isinstance(part, Mapping):
        for value in part.values():
            yield from used(value)
    elif isinstance(part, tuple):
        for value in part:
            yield from used(value)


def as_usual(mechanism: Mechanism, usual: Mechanism) -> Mechanism:
    """A mechanism, with the steps of the usual one where its own are the same."""
    own, known = mechanism.program, usual.program
    same = len(own.steps) == len(known.steps) and own.targets == known.targets
    if same and all(map(is_same, own.steps, known.steps)):
        return VariantMechanism(mechanism.scene, usual)
    return mechanism


def is_same(one: Step, other: Step) -> bool:
    """Whether two steps draw the same; sizes, by which only margins are judged, do not count."""
    if one.extra == other.extra:
        return one == other
    return replace(one, extra=signs(one)) == replace(other, extra=signs(other))


def signs(step: Step) -> tuple[float, ...]:
    """The branches of a step."""
    return tuple(part for part in step.extra if isinstance(part, int))


def all_scales(usual: Mechanism, own: Sequence[Mechanism]) -> list[Scales]:
    """The scale factors of the sheets of each variant."""
    import numpy as np

    like = [i for i, each in enumerate(own) if each.program is usual.program]
    known: dict[int, Scales] = {}
    if by_arrays(usual) and len(like) > 1:
        found = empty(len(like))
        values = {
            name: np.array([float(own[i].scene.values[name]) for i in like])  # type: ignore[arg-type]
            for name in usual.scene.values
        }
        done = scaled(usual, values, found)
        for place in np.flatnonzero(done & np.isfinite(found.kL)):
            i = like[place]
            kL, seconds = float(found.kL[place]), float(found.seconds[place])
            known[i] = as_sheet(own[i], kL, seconds, bool(found.triangles[place]))
    return [known[i] if i in known else scales(each) for i, each in enumerate(own)]


def as_sheet(mechanism: Mechanism, kL: float, seconds: float, triangles: bool) -> Scales:
    """The scale factors as a single sheet has them: of its crank, or with a round kv."""
    crank = the_crank(mechanism)
    if abs(seconds * crank - 1) <= CRANK:
        return Scales(kL, 1 / crank, triangles=triangles)
    return Scales(kL, seconds, from_driver=False, triangles=triangles)


# --- the pencil -------------------------------------------------------------------------------


class Originals(Original, frozen=True, kw_only=True, dict=True):
    """The constructions of several variants that draw the same: each value holds a row for each
    variant, or stands alone where all share it; ``like`` is the first of them.
    """

    like: Original

    @cached_property
    def marks(self) -> Mapping[int, PencilMark]:
        """Those of the first."""
        return self.like.marks

    @cached_property
    def order(self) -> tuple[int, ...]:
        """That of the first."""
        return self.like.order

    @cached_property
    def tails(self) -> Mapping[int, int]:
        """Those of the first."""
        return self.like.tails


def alike(found: Sequence[Standard]) -> list[list[int]]:
    """The places of variants that draw the same, in groups that make few enough drawings.

    Groups of higher class are closed for each variant by itself.
    """
    groups: dict[Any, list[int]] = {}
    for i, each in enumerate(found):
        exact = each.exact
        if PencilMark.CLOSING not in exact.marks.values():
            kinds = tuple((number, type(value)) for number, value in exact.trace.values.items())
            key = (id(each.layout), exact.triangles, kinds, tuple(exact.tails.items()))
            groups.setdefault(key, []).append(i)
    parts = []
    for places in groups.values():
        first = found[places[0]].exact
        size = max(1, DRAWINGS // (2 * sum(mark.errors for mark in first.marks.values()) or 1))
        parts += [places[i : i + size] for i in range(0, len(places), size)]
    return parts


def errors_of(found: Sequence[Standard], pencil: Pencil) -> list[Errors]:
    """The 95th percentile of the error of each field but senses, for variants that draw alike."""
    import numpy as np

    many = together([each.exact for each in found])
    fields = [probe for probe in found[0].probes if probe.item.what != "sense"]
    if not fields:
        return [Errors((), np.zeros((0, 0)))] * len(found)
    owners, errors = sources(many)
    drawings = redrawn(many, pencil, errors)
    size = len(found), 2 * len(owners)
    off = np.empty((len(found), len(fields), len(owners), 2))
    for place, probe in enumerate(fields):
        key = np.array([[each.key[probe.item.field]] for each in found])
        error = np.broadcast_to(probe.error(drawings, many.paper, key), size)
        off[:, place] = error.reshape(len(found), -1, 2)
    added_up, bent = added(off)
    for i in np.flatnonzero(bent.any(axis=1)).tolist():
        readings = readings_of(found[i].probes, found[i].key, found[i].exact)
        added_up[i] = np.where(bent[i], joint_errors(readings, found[i].exact, pencil), added_up[i])
    spread = covariance(off, added_up, bent)
    return [
        Errors(tuple(map(float, row)), each) for row, each in zip(added_up, spread, strict=True)
    ]


def together(every: Sequence[Original]) -> Originals:
    """The constructions of several variants as one."""
    first = every[0]
    values = {
        number: stacked([each.trace.values[number] for each in every])
        for number in first.trace.values
        if number not in first.skipped
    }
    paper = Paper(
        *(
            stacked([getattr(each.paper, name) for each in every])
            for name in ("mechanism", "velocities", "accelerations")
        )
    )
    trace = Trace(first.program, values, {})
    return Originals(trace, paper, first.targets, first.triangles, like=first)


def stacked(values: Sequence[Any]) -> Any:
    """One value of each variant as a column, by the parts of a line or circle; what all share
    stays alone."""
    import numpy as np

    first = values[0]
    if isinstance(first, tuple):
        parts = [stacked(part) for part in zip(*values, strict=True)]
        return type(first)(*parts) if hasattr(first, "_fields") else tuple(parts)
    if all(value == first for value in values):
        return first
    return np.array(values)[:, None]
