"""From groups to the program: all positions, then all velocities, then accelerations and poles.

Last come the vectors of the requested points: arrows from the pole, and on the mechanism. Rods that
lie flat are in line with their cranks, where a dyad of the two has no sure crossing. Where parallel
bars keep a rod or a wheel parallel, its direction places it there, too.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import partial
from typing import Any

from msgspec.structs import replace

from graphkin.construction.centres.instant_centre import draw_centre, draw_pole
from graphkin.construction.core.bases import Base, bases, crank_tip, leads_of
from graphkin.construction.core.branches import (
    choosing,
    in_place_of,
    refuse_unstated,
    stray,
    unused_branches,
)
from graphkin.construction.core.palette import TRANSFER, Move, vector_at_point
from graphkin.construction.core.pen import Pen, letter
from graphkin.construction.core.program import Part, Plane, PlanVector, Program
from graphkin.construction.core.quantities import CENTRES, MOTION, names_asked
from graphkin.construction.core.run import StepFailed, run
from graphkin.construction.core.vocabulary import action, coordinate
from graphkin.construction.group_images import ACCELERATIONS, VELOCITIES, GroupImages
from graphkin.construction.guides.guides import axis, keep_parallel, standing_guide
from graphkin.construction.links import plate_points, position
from graphkin.construction.normal_component import refuse_unused_method
from graphkin.construction.plan import Plan, omega_of
from graphkin.construction.velocity.image_of_link import image_under
from graphkin.numbers.arithmetic import FLOAT, Point, Real
from graphkin.numbers.plane import Vector
from graphkin.scene.link_points import ends_of, point_of
from graphkin.scene.model import Scene, Side
from graphkin.structure.decomposition import decompose
from graphkin.structure.groups import (
    CamFollower,
    CoupledTrain,
    Crank,
    Driven,
    Dyad,
    Geared,
    Group,
    Higher,
    KeptParallel,
    Spun,
    Stretched,
    Tie,
    Train,
    Unresolved,
)
from graphkin.structure.pairs import parallel_sets
from graphkin.text.errors import Problem, StructureError

Work = Callable[[Pen, Any], None]
"""A function that draws a group in one of the drawings."""
PLANS = VELOCITIES, ACCELERATIONS
"""The drawing functions of both plans."""
Standing = list[tuple[Group, tuple[Base, ...]]]
"""Each group with the bases of its links."""


def write(scene: Scene, groups: tuple[Group, ...], *, fitted: bool = True) -> Program:
    """The complete program of a mechanism.

    Raises StructureError with all problems at once. With ``fitted`` this includes idle links that
    do not fit the stated closure.
    """
    standing = stand(scene, groups)
    pen = Pen(scene)
    position.frame(pen)
    for group, found in standing:
        place(pen, group, found)
        if fitted and isinstance(group, Tie):
            position.refuse_misfit(pen, group)
    if any(link.rolls for link in scene.every_link):
        from graphkin.construction.rolling import rolling

        rolling.refuse_idle_turns(pen)
    write_turning(pen)
    write_plan(pen, standing, VELOCITIES)
    if scene.sheet.plan == "kutzbach":
        from graphkin.construction.rolling.kutzbach import draw_ladder

        draw_ladder(pen)
    write_plan(pen, standing, ACCELERATIONS)
    if scene.ask.jerk:
        from graphkin.construction.third_order import draw_jerks

        draw_jerks(pen)
    refuse_unused_method(pen)
    every = [base for _, found in standing for base in found]
    draw_centres(pen, every)
    return pen.program()


def stand(scene: Scene, groups: tuple[Group, ...]) -> Standing:
    """The groups with their bases.

    Raises StructureError that lists every missing branch and construction.
    """
    problems: list[Problem] = []
    standing: Standing = []
    reported: set[str] = set()
    for group in groups:
        try:
            standing.append((group, bases(scene, group)))
            refuse_unstated(scene, group)
        except StructureError as error:
            others = stray(scene, groups, group)
            reported.update(others)
            problems += [in_place_of(scene, each, others) for each in error.problems]
    if not any(isinstance(group, Unresolved) for group in groups):
        problems += unused_branches(scene, groups, reported)
    if problems:
        raise StructureError(problems)
    return standing


def work_of(group: Group) -> tuple[Work, Work, Work]:
    """The functions that draw a kind of group: to scale, in the velocity plan, in the other plan.

    Modules that only some mechanisms need are imported here.
    """
    match group:
        case Crank():
            return position.crank, *both(GroupImages.crank)
        case Driven():
            return position.driven, *both(GroupImages.driven)
        case Dyad():
            return position.dyad, *both(GroupImages.dyad)
        case Tie():
            return position.tie, *both(GroupImages.tie)
        case KeptParallel():
            return keep_parallel, *both(GroupImages.kept)
        case CamFollower():
            return position.follower, *both(GroupImages.follower)
        case Stretched():
            from graphkin.construction.drivers import cylinder

            return cylinder.place, *both(cylinder.move)
        case Geared():
            from graphkin.construction.rolling import rolling, wheel_images

            return rolling.geared, wheel_images.geared, wheel_images.second_geared
        case Spun():
            from graphkin.construction.rolling import spun_wheel

            return spun_wheel.place, *both(spun_wheel.move)
        case Train():
            from graphkin.construction.rolling import rolling, wheel_images

            return rolling.train, wheel_images.train, wheel_images.second_train
        case CoupledTrain():
            from graphkin.construction.higher_class import coupled_train, two_trials

            return partial(coupled_train.position, each=place), *each_in(two_trials.two_trials)
        case Higher(at_instant=parts):
            from graphkin.construction.higher_class import higher, two_trials

            draw: Callable[..., None] = two_trials.two_trials
            if parts:
                from graphkin.construction.rolling import spun_wheel

                draw = spun_wheel.move_pinned
            return partial(higher.position, each=place), *each_in(draw)
        case Unresolved():
            raise ValueError(f"links {', '.join(group.links)} are in no group that is drawn")


def both(draw: Callable[..., None]) -> tuple[Work, Work]:
    """The drawing functions for both plans, from one that serves both."""
    first, second = (partial(draw, images) for images in PLANS)
    return first, second


def each_in(draw: Callable[..., None]) -> tuple[Work, Work]:
    """The drawing functions for both plans, from one that also draws other groups."""
    first, second = (partial(draw, each, each=partial(in_plan, each)) for each in PLANS)
    return first, second


def place(pen: Pen, group: Group, found: tuple[Base, ...]) -> None:
    """Draw one group of the mechanism to scale."""
    pen.bases |= {base.link: base for base in found}
    pen.leads |= leads_of(group)
    work_of(group)[0](pen, group)
    for base in own_bases(group, found):
        plate_points.plate_points(pen, base)


def own_bases(group: Group, found: tuple[Base, ...]) -> tuple[Base, ...]:
    """The bases of links finished with their group; higher classes finish theirs one by one."""
    return () if isinstance(group, CoupledTrain | Higher) else found


def write_turning(pen: Pen) -> None:
    """Write the axis of every link, and the coordinate of each block on its guide."""
    for link in pen.scene.links.values():
        axis(pen, link.name)
        if link.slides:
            guide = standing_guide(pen, pen.first_slide(link.name))
            pen.want("guide", link.name, guide)
            with pen.on(Part.RESULT, Plane.NUMBERS):
                found = pen.draw(coordinate, guide, pen.the("position", link.points[0]))
            pen.want("slide", link.name, found)


def write_plan(pen: Pen, standing: Standing, images: GroupImages) -> None:
    """Write a plan, the rates of links, the motion of blocks, and the requested vectors."""
    plan = images.plan
    for point in pen.scene.frame.points:
        pen.want(plan.quantity, point, pen.pole(plan.plane))
    for group, found in standing:
        in_plan(images, pen, group, found)
    for link in pen.scene.links.values():
        if link.slides:
            images.sliding(pen, link.name)
    show_asked(pen, plan, tips(pen, standing))


def in_plan(images: GroupImages, pen: Pen, group: Group, found: tuple[Base, ...]) -> None:
    """Draw one group in a plan."""
    work_of(group)[1 + PLANS.index(images)](pen, group)
    for base in own_bases(group, found):
        images.plate_points(pen, base)
        omega_of(pen, base.link, images.plan.rate)


def tips(pen: Pen, standing: Standing) -> list[str]:
    """The points of cranks whose motion is given."""
    found = (crank_tip(pen.scene, group) for group, _ in standing if isinstance(group, Crank))
    return [tip for tip in found if tip is not None]


def draw_centres(pen: Pen, bases: Sequence[Base]) -> None:
    """Draw every centre and pole: first those of velocities, then those of accelerations.

    Modules that only some scenes need are imported here.
    """
    for base in bases:
        draw_centre(pen, base)
    if pen.scene.ask.pairs:
        from graphkin.construction.centres.kennedy import draw_relative

        draw_relative(pen)
    for base in bases:
        draw_pole(pen, base)
        if base.link in pen.scene.ask.inflection:
            from graphkin.construction.centres.inflection import draw_circle

            draw_circle(pen, base)
    for name in pen.scene.ask.curvature:
        from graphkin.construction.centres.path_curvature import draw_curvature

        draw_curvature(pen, point_of(pen.scene, name))


@action("set-on", move=Move(TRANSFER, vector_at_point))
def set_on(point: Point, o: Point, image: Point, seconds: Real) -> Vector:
    """A velocity of the plan, set on the mechanism at its point."""
    return Vector(point, point + (image - o) * seconds)


@action("set-on-twice", move=Move(TRANSFER, vector_at_point))
def set_on_twice(point: Point, o: Point, image: Point, seconds: Real) -> Vector:
    """An acceleration of the plan, set on the mechanism at its point."""
    return Vector(point, point + (image - o) * (seconds * seconds))


SET_ON = {"velocity": set_on, "acceleration": set_on_twice}
"""The action that sets a vector of each plan on the mechanism."""


def show_asked(pen: Pen, plan: Plan, tips: Iterable[str]) -> None:
    """Draw the vectors of driven tips and requested points, on the mechanism and in the plan.

    The centres of points follow from these vectors.
    """
    centres = (each for each in CENTRES if each.whose == "points")
    names = names_asked(pen.scene.ask, MOTION[plan.quantity], *centres)
    asked = [constructed(pen, name, plan) for name in names]
    for point in asked:
        if pen.the(plan.quantity, point) != pen.pole(plan.plane):  # a fixed point has no arrow
            plan.arrows(pen, point)
    for point in dict.fromkeys((*tips, *asked)):
        ends = pen.the("position", point), pen.pole(plan.plane), pen.the(plan.quantity, point)
        with pen.on(plan.part, Plane.MECHANISM):
            vector = PlanVector(plan.letter, letter(point))
            pen.vector(SET_ON[plan.quantity], *ends, pen.seconds(), of=vector)


def constructed(pen: Pen, name: str, plan: Plan) -> str:
    """The point that a name asks about, with its image found: A for A@3 where link 3 owns A."""
    point, link = ends_of(name)
    if not link:
        return name
    owned = point in pen.scene.link(link).points
    if not pen.has("position", name):
        pen.want("position", name, pen.the("position", point))
    if not pen.has(plan.quantity, name):
        number = image_under(pen, link, point, plan)
        if not pen.has(plan.quantity, name):
            pen.want(plan.quantity, name, number)
    return point if owned else name


FLAT = 1e-6
"""Sine of a crossing below which a rod counts as flat."""

Laid = tuple[tuple[Group, ...], Program]


def laid(scene: Scene, groups: tuple[Group, ...]) -> Laid:
    """The groups as drawn, and their program: parallel bars place what a flat rod does not."""
    first = groups, write(scene, groups)
    if not any(isinstance(group, Tie) for group in groups) or not is_flat(scene, first[1]):
        return first
    other = without_idle_sides(scene)
    return first if other is scene else ((found := decompose(other)), write(other, found))


def is_flat(scene: Scene, program: Program) -> bool:
    """Whether two loci only touch in the scene's position."""
    places = program.needed(target for target in program.targets if target[0] == "position")
    try:
        margins = run(program, places, scene.values, FLOAT).margins
    except StepFailed:
        return False
    return bool(min(margins.values(), default=1.0) < FLAT)


def without_idle_sides(scene: Scene) -> Scene:
    """The scene without the sides of pins of parallel bars, where these leave no choice.

    The same where it states none.
    """
    pins = {p for each in parallel_sets(scene) for ends in each.pins for p in ends}
    idle = {pin for pin in pins if isinstance(scene.branches.get(pin), Side)}
    if not idle:
        return scene
    branches = {name: each for name, each in scene.branches.items() if name not in idle}
    left = idle & {*choosing(decompose(replace(scene, branches=branches)))}
    branches = {name: each for name, each in scene.branches.items() if name not in idle - left}
    return replace(scene, branches=branches)
