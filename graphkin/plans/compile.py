"""From groups to the program: all positions, then all velocities, then accelerations and poles."""

from __future__ import annotations

from graphkin.construction import sliding
from graphkin.errors import Problem, StructureError
from graphkin.plans import (
    acceleration,
    asked,
    centres,
    cylinder,
    higher,
    plates,
    position,
    rolling,
    trials,
    velocity,
    wheels,
)
from graphkin.plans.branches import in_place_of, refuse_unstated, stray, unused_branches
from graphkin.plans.guides import axis, standing_guide
from graphkin.plans.links import Base, bases, crank_tip, leads_of
from graphkin.plans.pen import Pen
from graphkin.plans.shape import Shapes
from graphkin.scene.model import Scene
from graphkin.steps.program import Part, Plane, Program
from graphkin.steps.vocabulary import coordinate
from graphkin.structure.groups import (
    Crank,
    Driven,
    Dyad,
    Geared,
    Group,
    Higher,
    Stretched,
    Tie,
    Train,
)

Standing = list[tuple[Group, tuple[Base, ...]]]
"""Each group with the bases of its links."""


def write(scene: Scene, groups: tuple[Group, ...]) -> Program:
    """The program of a mechanism, everything included. Raises StructureError, all at once."""
    standing = stand(scene, groups)
    pen = Pen(scene)
    shapes = Shapes(pen)
    position.frame(pen)
    for group, found in standing:
        place(pen, shapes, group, found)
        if isinstance(group, Tie):
            position.refuse_misfit(pen, shapes, group)
    rolling.refuse_idle_turns(pen)
    write_turning(pen, shapes)
    write_velocities(pen, shapes, standing)
    write_accelerations(pen, shapes, standing)
    every = [base for _, found in standing for base in found]
    for base in every:
        centres.centre(pen, base)
    centres.relative(pen)
    for base in every:
        centres.pole(pen, base)
        centres.inflection(pen, base)
    return pen.program()


def stand(scene: Scene, groups: tuple[Group, ...]) -> Standing:
    """The groups with their bases; every missing branch and construction is listed at once."""
    problems: list[Problem] = []
    standing: Standing = []
    for group in groups:
        try:
            standing.append((group, bases(scene, group)))
            refuse_unstated(scene, group)
        except StructureError as error:
            others = stray(scene, groups, group)
            problems += [in_place_of(scene, each, others) for each in error.problems]
    problems += [] if problems else unused_branches(scene, groups)
    if problems:
        raise StructureError(problems)
    return standing


def place(pen: Pen, shapes: Shapes, group: Group, found: tuple[Base, ...]) -> None:
    """The mechanism to scale: one group."""
    pen.bases |= {base.link: base for base in found}
    pen.leads |= leads_of(group)
    match group:
        case Crank():
            position.crank(pen, shapes, group)
        case Driven():
            position.driven(pen, shapes, group)
        case Dyad():
            position.dyad(pen, shapes, group)
        case Stretched():
            cylinder.place(pen, shapes, group)
        case Geared():
            rolling.geared(pen, shapes, group)
        case Train():
            rolling.train(pen, shapes, group)
        case Tie():
            position.tie(pen, shapes, group)
        case Higher():
            higher.position(pen, shapes, group, place)
            return
    for base in found:
        plates.plate_points(pen, shapes, base)


def write_turning(pen: Pen, shapes: Shapes) -> None:
    """The axis of every link, and where each block stands on its guide."""
    for link in pen.scene.links.values():
        axis(pen, shapes, link.name)
        if link.slides:
            guide = standing_guide(pen, shapes, pen.first_slide(link.name))
            pen.want("guide", link.name, guide)
            with pen.on(Part.RESULT, Plane.NUMBERS):
                found = pen.draw(coordinate, guide, pen.the("position", link.points[0]))
            pen.want("slide", link.name, found)


def write_velocities(pen: Pen, shapes: Shapes, standing: Standing) -> None:
    """The velocity plan, the angular velocities, and what is asked set on the mechanism."""
    velocity.frame(pen)
    for group, found in standing:
        move(pen, shapes, group, found)
    for link in pen.scene.links.values():
        if link.slides:
            velocity.sliding(pen, shapes, link.name)
    asked.show(pen, asked.VELOCITY, tips(pen, standing))


def move(pen: Pen, shapes: Shapes, group: Group, found: tuple[Base, ...]) -> None:
    """The velocity plan: one group."""
    match group:
        case Crank():
            velocity.crank(pen, shapes, group)
        case Driven():
            velocity.driven(pen, shapes, group)
        case Dyad():
            velocity.dyad(pen, shapes, group)
        case Stretched():
            cylinder.move(pen, shapes, group)
        case Geared():
            wheels.geared(pen, group)
        case Train():
            wheels.train(pen, group)
        case Tie():
            velocity.tie(pen, shapes, group)
        case Higher():
            trials.velocity(pen, shapes, group, move)
            return
    for base in found:
        velocity.plate_points(pen, shapes, base)
        velocity.turning(pen, base)


def write_accelerations(pen: Pen, shapes: Shapes, standing: Standing) -> None:
    """The acceleration plan, the angular accelerations, and what is asked set on the mechanism."""
    acceleration.frame(pen)
    for group, found in standing:
        accelerate(pen, shapes, group, found)
    for link in pen.scene.links.values():
        if link.slides:
            sliding.sliding(pen, shapes, link.name)
    asked.show(pen, asked.ACCELERATION, tips(pen, standing))


def accelerate(pen: Pen, shapes: Shapes, group: Group, found: tuple[Base, ...]) -> None:
    """The acceleration plan: one group."""
    match group:
        case Crank():
            acceleration.crank(pen, shapes, group)
        case Driven():
            acceleration.driven(pen, shapes, group)
        case Dyad():
            acceleration.dyad(pen, shapes, group)
        case Stretched():
            cylinder.accelerate(pen, shapes, group)
        case Geared():
            wheels.second_geared(pen, shapes, group)
        case Train():
            wheels.second_train(pen, group)
        case Tie():
            acceleration.tie(pen, shapes, group)
        case Higher():
            trials.acceleration(pen, shapes, group, accelerate)
            return
    for base in found:
        acceleration.plate_points(pen, shapes, base)
        acceleration.turning(pen, base)


def tips(pen: Pen, standing: Standing) -> list[str]:
    """The points of cranks whose motion is given."""
    found = (crank_tip(pen.scene, group) for group, _ in standing if isinstance(group, Crank))
    return [tip for tip in found if tip is not None]
