"""The sheet of forces of a mechanism, verified before it is drawn."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress

from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.layout import mechanism_field
from graphkin.construction.core.program import Part, Target
from graphkin.construction.core.quantities import FORCE, SHEETS
from graphkin.construction.core.run import Trace, run
from graphkin.construction.core.solution import UNPROVED
from graphkin.construction.forces.force_drawing import ForceDrawing
from graphkin.construction.forces.force_plan import undrawn
from graphkin.construction.forces.loads import AppliedForce
from graphkin.construction.reactions import ForceSolution
from graphkin.documents.force_fields import laid_out
from graphkin.documents.scaling import curves_drawn, drawing, targets_of
from graphkin.drawing.scale import Scales
from graphkin.mechanism import Mechanism
from graphkin.numbers.arithmetic import FLOAT
from graphkin.scene.model import joined_words, link_words
from graphkin.structure.groups import Group
from graphkin.text import words
from graphkin.text.errors import Problem, StructureError, WitnessError, message

HELD = 1e-9
"""Difference, as a share of the largest force, up to which two routes agree."""


def force_drawing(mechanism: Mechanism, drawings: Sequence[Drawing]) -> ForceDrawing:
    """The drawing of the forces, with the mechanism at its place on the other sheets.

    Raises StructureError for a group whose forces are not drawn yet, and WitnessError where the
    polygons, the equations of equilibrium and the lever disagree.
    """
    groups = mechanism.laid[0]
    group = undrawn(mechanism.scene, groups)
    if group is not None:
        raise StructureError(not_drawn(mechanism, group))
    by_forces = mechanism.forces()
    assert by_forces is not None
    found, verdict = by_forces
    drawing, first = unplaced(mechanism, drawings), drawings[0]
    worst = max(verdict.largest_difference, abs(verdict.power), *differences(drawing, found))
    if worst > HELD:
        raise WitnessError(
            Problem(
                "loads",
                message(
                    "polygons and equations of equilibrium differ by {difference}",
                    difference=f"{worst:.1e}",
                ),
                message("at most {limit:.1e}", limit=HELD),
                message("no sheet is handed out"),
            )
        )
    drawing = replace(drawing, verdict=replace(first.verdict, largest_difference=worst))
    return laid_out(drawing, first.stand or mechanism_field(drawings))


def unplaced(mechanism: Mechanism, drawings: Sequence[Drawing]) -> ForceDrawing:
    """The drawing of the forces without its fields."""
    first, trace = drawings[0], traced(mechanism)
    own = FORCE, mechanism.scene, trace, first.scales, first.verdict, first.words
    return ForceDrawing(*own, again=True, computed={})


def force_scales(mechanism: Mechanism, chosen: Scales) -> Scales:
    """The scale factors of the sheets, ``chosen`` without forces, with those of the forces."""
    mechanism = mechanism.measured
    curves = curves_drawn(mechanism)
    drawings = [
        drawing(mechanism, kind, found, chosen, UNPROVED, words("en"), curves)
        for kind in SHEETS
        if (found := targets_of(mechanism, kind))
    ]
    return laid_out(unplaced(mechanism, drawings), mechanism_field(drawings)).scales


def with_force_plan(
    mechanism: Mechanism, chosen: Scales
) -> tuple[Mechanism, Scales, tuple[Target, ...]]:
    """The mechanism with its plan of forces, its scale factors, and what the scene asks of both.

    Without forces that are asked and drawn, it is the mechanism as it is.
    """
    forces, whole, asked = mechanism.scene.forces, mechanism.with_forces, mechanism.asked()
    if forces is None or not forces.asked or whole is mechanism:
        return mechanism, chosen, asked
    return whole, force_scales(mechanism, chosen), whole.asked()


def not_drawn(mechanism: Mechanism, group: Group) -> Problem:
    """The problem of a group whose forces are not drawn, with a hint where its numbers are."""
    first, *others = group.links
    links = joined_words(group.links) if others else link_words(first)
    hint = message("leave reactions and balance out of [ask]")
    with suppress(StructureError):
        mechanism.forces()
        hint = message("{hint}: graphkin solve gives their numbers", hint=hint)
    return Problem(
        "loads",
        message(
            "the forces of {links} ({what}) are not drawn yet",
            links=links,
            what=group.title,
        ),
        message(
            "dyads, cylinders, cams, wheels on pivots, racks, groups of class III, driven links"
        ),
        hint,
    )


def traced(mechanism: Mechanism) -> Trace:
    """The values of the plan of forces, and of everything that it needs."""
    scene = mechanism.scene
    program = mechanism.with_forces.program
    own = [number for number, step in enumerate(program.steps) if step.part is Part.FORCE]
    placed = [n for target, n in program.targets.items() if is_place(target)]
    return run(program, program.behind([*own, *placed]), scene.values, FLOAT)


def is_place(target: Target) -> bool:
    """Whether the drawing of the mechanism needs a target."""
    return target[0] in ("position", "axis", "guide", "track", "rolled")


def differences(drawing: ForceDrawing, found: ForceSolution) -> Iterator[float]:
    """The differences of drawn reactions from those of the solution, and of the lever's balance."""
    values, size = drawing.trace.values, drawing.natural
    forces = [each.force for each in found.reactions]
    largest = max([size, *map(abs, forces)], default=0.0) or 1.0
    drawn = {
        step.of.name: values[step.of.force]
        for _, step, _ in drawing.on_mechanism
        if isinstance(step.of, AppliedForce) and step.of.look == "reaction"
    }
    for force in drawn.values():
        yield min((abs(force - each) for each in forces), default=0.0) / largest
    for each in drawing.lever_balances():
        yield each.difference(drawing) if each.size(drawing) else 0.0
