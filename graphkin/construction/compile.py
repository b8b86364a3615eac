"""From groups to the program: all positions, then all velocities, then accelerations and poles."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

from graphkin.construction import asked
from graphkin.construction.acceleration import acceleration
from graphkin.construction.acceleration.tangential_direction import refuse_unused_method
from graphkin.construction.centres.acceleration_poles import draw_pole
from graphkin.construction.centres.instant_centre import draw_centre
from graphkin.construction.core.bases import Base, bases, crank_tip, leads_of
from graphkin.construction.core.branches import in_place_of, refuse_unstated, stray, unused_branches
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import Part, Plane, Program
from graphkin.construction.core.quantities import EPSILON, OMEGA
from graphkin.construction.core.vocabulary import coordinate
from graphkin.construction.guides import sliding
from graphkin.construction.guides.coincident_points import omega_of
from graphkin.construction.guides.guides import axis, standing_guide
from graphkin.construction.links import plate_points, position
from graphkin.construction.links.link_shapes import LinkShapes
from graphkin.construction.velocity import velocity
from graphkin.scene.model import Scene
from graphkin.structure.groups import (
    CamFollower,
    CoupledTrain,
    Crank,
    Driven,
    Dyad,
    Geared,
    Group,
    Higher,
    Spun,
    Stretched,
    Tie,
    Train,
    Unresolved,
)
from graphkin.structure.pairs import Sliding
from graphkin.text.errors import Problem, StructureError

Work = Callable[[Pen, LinkShapes, Any], None]
"""What draws a group in one of the drawings."""
MOVED, ACCELERATED = 1, 2
"""Which of a group's works draws it in either plan."""
PLANS = {
    MOVED: (velocity.plate_points, velocity.sliding, asked.VELOCITY, OMEGA),
    ACCELERATED: (acceleration.plate_points, sliding.sliding, asked.ACCELERATION, EPSILON),
}
"""What draws the rest of a link in each plan, how a block slides, what of points is asked, and the
rate of a link."""
CROSSED = velocity.cross, acceleration.cross
"""What finds the image of a point where two lines meet, in either plan."""
Standing = list[tuple[Group, tuple[Base, ...]]]
"""Each group with the bases of its links."""


def write(scene: Scene, groups: tuple[Group, ...]) -> Program:
    """The program of a mechanism, everything included. Raises StructureError, all at once."""
    standing = stand(scene, groups)
    pen = Pen(scene)
    shapes = LinkShapes(pen)
    position.frame(pen)
    for group, found in standing:
        place(pen, shapes, group, found)
        if isinstance(group, Tie):
            position.refuse_misfit(pen, shapes, group)
    if any(link.rolls for link in scene.every_link):
        from graphkin.construction.rolling import rolling

        rolling.refuse_idle_turns(pen)
    write_turning(pen, shapes)
    write_plan(pen, shapes, standing, MOVED)
    if scene.sheet.plan == "kutzbach":
        from graphkin.construction.rolling.ladder import draw_ladder

        draw_ladder(pen)
    write_plan(pen, shapes, standing, ACCELERATED)
    refuse_unused_method(pen)
    every = [base for _, found in standing for base in found]
    draw_centres(pen, every)
    return pen.program()


def stand(scene: Scene, groups: tuple[Group, ...]) -> Standing:
    """The groups with their bases; every missing branch and construction is listed at once."""
    problems: list[Problem] = []
    standing: Standing = []
    told: set[str] = set()
    for group in groups:
        try:
            standing.append((group, bases(scene, group)))
            refuse_unstated(scene, group)
        except StructureError as error:
            others = stray(scene, groups, group)
            told.update(others)
            problems += [in_place_of(scene, each, others) for each in error.problems]
    if not any(isinstance(group, Unresolved) for group in groups):
        problems += unused_branches(scene, groups, told)
    if problems:
        raise StructureError(problems)
    return standing


def work_of(group: Group) -> tuple[Work, Work, Work]:
    """What a kind of group draws to scale, as velocities and as accelerations.

    What only some mechanisms have is loaded for these.
    """
    match group:
        case Crank():
            return position.crank, velocity.crank, acceleration.crank
        case Driven():
            return position.driven, velocity.driven, acceleration.driven
        case Dyad():
            return position.dyad, velocity.dyad, acceleration.dyad
        case Tie():
            first, second = (partial(tie, cross=each) for each in CROSSED)
            return position.tie, first, second
        case CamFollower():
            from graphkin.construction.cams import cam

            return cam.place, cam.move, cam.accelerate
        case Stretched():
            from graphkin.construction.drivers import cylinder

            return cylinder.place, cylinder.move, cylinder.accelerate
        case Geared():
            from graphkin.construction.rolling import rolling, wheel_images

            return rolling.geared, wheel_images.geared, wheel_images.second_geared
        case Spun():
            from graphkin.construction.rolling import spun_wheel

            return spun_wheel.place, spun_wheel.move, spun_wheel.accelerate
        case Train():
            from graphkin.construction.rolling import rolling, wheel_images

            return rolling.train, wheel_images.train, wheel_images.second_train
        case CoupledTrain():
            from graphkin.construction.higher_class import coupled_train

            return (partial(coupled_train.position, each=place), *by_trials())
        case Higher(at_instant=parts):
            from graphkin.construction.higher_class import higher

            plans = with_pinned_wheels() if parts else by_trials()
            return (partial(higher.position, each=place), *plans)
        case Unresolved():
            raise ValueError(f"links {', '.join(group.links)} are in no group that is drawn")


def by_trials() -> tuple[Work, Work]:
    """What a group draws in both plans that has a link tried."""
    from graphkin.construction.higher_class import two_trials

    first, second = (partial(in_plan, which=which) for which in PLANS)
    return partial(two_trials.velocity, each=first), partial(two_trials.acceleration, each=second)


def with_pinned_wheels() -> tuple[Work, Work]:
    """What a group draws in both plans whose wheels leave nothing to try at the instant."""
    from graphkin.construction.rolling import wheel_images

    first, second = (partial(in_plan, which=which) for which in PLANS)
    return (
        partial(wheel_images.move_pinned, each=first),
        partial(wheel_images.accelerate_pinned, each=second),
    )


def place(pen: Pen, shapes: LinkShapes, group: Group, found: tuple[Base, ...]) -> None:
    """The mechanism to scale: one group."""
    pen.bases |= {base.link: base for base in found}
    pen.leads |= leads_of(group)
    work_of(group)[0](pen, shapes, group)
    for base in own_bases(group, found):
        plate_points.plate_points(pen, shapes, base)


def own_bases(group: Group, found: tuple[Base, ...]) -> tuple[Base, ...]:
    """The links that are finished with their group; higher classes finish theirs one by one."""
    return () if isinstance(group, CoupledTrain | Higher) else found


def write_turning(pen: Pen, shapes: LinkShapes) -> None:
    """The axis of every link, and where each block stands on its guide."""
    for link in pen.scene.links.values():
        axis(pen, shapes, link.name)
        if link.slides:
            guide = standing_guide(pen, shapes, pen.first_slide(link.name))
            pen.want("guide", link.name, guide)
            with pen.on(Part.RESULT, Plane.NUMBERS):
                found = pen.draw(coordinate, guide, pen.the("position", link.points[0]))
            pen.want("slide", link.name, found)


def write_plan(pen: Pen, shapes: LinkShapes, standing: Standing, which: int) -> None:
    """A plan, the rates of links, how blocks slide, and what is asked set on the mechanism."""
    _, slides, quantity, _ = PLANS[which]
    for point in pen.scene.frame.points:
        pen.want(quantity.quantity, point, pen.pole(quantity.plane))
    for group, found in standing:
        in_plan(pen, shapes, group, found, which=which)
    for link in pen.scene.links.values():
        if link.slides:
            slides(pen, shapes, link.name)
    asked.show(pen, quantity, tips(pen, standing))


def in_plan(
    pen: Pen, shapes: LinkShapes, group: Group, found: tuple[Base, ...], *, which: int
) -> None:
    """One group in a plan."""
    work_of(group)[which](pen, shapes, group)
    rest, _, _, rate = PLANS[which]
    for base in own_bases(group, found):
        rest(pen, shapes, base)
        omega_of(pen, base.link, rate)


def tie(pen: Pen, shapes: LinkShapes, group: Tie, *, cross: Callable[..., None]) -> None:
    """A link between two known ones: on two guides its image is found, at two pins it is there."""
    if isinstance(group.first, Sliding):
        point = pen.bases[group.link].start
        cross(pen, shapes, point, point, [(group.first, group.link), (group.second, group.link)])


def tips(pen: Pen, standing: Standing) -> list[str]:
    """The points of cranks whose motion is given."""
    found = (crank_tip(pen.scene, group) for group, _ in standing if isinstance(group, Crank))
    return [tip for tip in found if tip is not None]


def draw_centres(pen: Pen, bases: Sequence[Base]) -> None:
    """Every centre and pole: first those of velocities, then those of accelerations.

    What only some scenes ask is loaded for these.
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
