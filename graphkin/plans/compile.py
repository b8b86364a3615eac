"""From groups to the program: all positions, then all velocities, then accelerations and poles."""

from __future__ import annotations

from graphkin.errors import Problem, StructureError
from graphkin.plans import acceleration, centres, position, velocity
from graphkin.plans.links import Base, bases, crank_tip, unused_branches
from graphkin.plans.pen import Pen
from graphkin.plans.shape import Shapes
from graphkin.scene.model import Scene
from graphkin.steps.program import Program
from graphkin.structure.groups import Crank, Dyad, Group

Standing = list[tuple[Group, tuple[Base, ...]]]
"""Each group with the bases of its links."""


def write(scene: Scene, groups: tuple[Group, ...]) -> Program:
    """The program of a mechanism, everything included. Raises StructureError, all at once."""
    standing = stand(scene, groups)
    pen = Pen(scene)
    shapes = Shapes(pen)
    write_positions(pen, shapes, standing)
    write_velocities(pen, shapes, standing)
    write_accelerations(pen, shapes, standing)
    every = [base for _, found in standing for base in found]
    for base in every:
        centres.centre(pen, base)
    for base in every:
        centres.pole(pen, base)
    return pen.program()


def stand(scene: Scene, groups: tuple[Group, ...]) -> Standing:
    """The groups with their bases; every missing branch and construction is listed at once."""
    problems: list[Problem] = []
    standing: Standing = []
    for group in groups:
        try:
            standing.append((group, bases(scene, group)))
        except StructureError as error:
            problems += error.problems
    problems += [] if problems else unused_branches(scene, groups)
    if problems:
        raise StructureError(problems)
    return standing


def write_positions(pen: Pen, shapes: Shapes, standing: Standing) -> None:
    """The mechanism to scale."""
    position.frame(pen)
    for group, found in standing:
        if isinstance(group, Crank):
            position.crank(pen, shapes, group)
        elif isinstance(group, Dyad):
            position.dyad(pen, shapes, group)
        for base in found:
            position.plate_points(pen, shapes, base)


def write_velocities(pen: Pen, shapes: Shapes, standing: Standing) -> None:
    """The velocity plan, the angular velocities, and what is asked set on the mechanism."""
    velocity.frame(pen)
    for group, found in standing:
        if isinstance(group, Crank):
            velocity.crank(pen, group)
        elif isinstance(group, Dyad):
            velocity.dyad(pen, group)
        for base in found:
            velocity.plate_points(pen, shapes, base)
            velocity.turning(pen, base)
    for point in shown(pen, standing, pen.scene.ask.velocity):
        velocity.set_on_mechanism(pen, point)


def write_accelerations(pen: Pen, shapes: Shapes, standing: Standing) -> None:
    """The acceleration plan, the angular accelerations, and what is asked set on the mechanism."""
    acceleration.frame(pen)
    for group, found in standing:
        if isinstance(group, Crank):
            acceleration.crank(pen, group)
        elif isinstance(group, Dyad):
            acceleration.dyad(pen, group)
        for base in found:
            acceleration.plate_points(pen, shapes, base)
            acceleration.turning(pen, base)
            velocity.sliding(pen, base)
    for point in shown(pen, standing, pen.scene.ask.acceleration):
        acceleration.set_on_mechanism(pen, point)


def shown(pen: Pen, standing: Standing, asked: tuple[str, ...]) -> list[str]:
    """The points whose motion is set on the mechanism: driven tips, and what is asked."""
    tips = [crank_tip(pen.scene, group) for group, _ in standing if isinstance(group, Crank)]
    return list(dict.fromkeys((*tips, *(p for p in asked if pen.has("position", p)))))
