"""The right plan of a group: its points on the lines through their two trials, and its arrows."""

from __future__ import annotations

from graphkin.construction.acceleration.acceleration import slid
from graphkin.construction.acceleration.turned_acceleration import TurnedAcceleration
from graphkin.construction.core.arrows import arrow_between, relative_arrow
from graphkin.construction.core.pen import Pen, about, letter
from graphkin.construction.core.plan_vector import PlanVector, foot_of
from graphkin.construction.core.program import Part, Plane, Target
from graphkin.construction.core.vocabulary import Action, action
from graphkin.construction.higher_class.divided_point import (
    CrossedLine,
    DividedPoint,
    DividedRate,
    between,
)
from graphkin.construction.plan import VELOCITY, Plan
from graphkin.numbers.arithmetic import Point
from graphkin.numbers.plane import Vector
from graphkin.scene.link_points import ends_of, is_under, under
from graphkin.structure.groups import CoupledTrain, Higher, Tie
from graphkin.structure.pairs import Pin


@action("to-corner")
def along_component(start: Point, tip: Point, component: Point) -> Vector:
    """The first leg of a path from one point of a plan to another: a component laid off."""
    return Vector(start, start + component)


@action("from-corner")
def after_component(start: Point, tip: Point, component: Point) -> Vector:
    """The last leg of such a path, from the end of the component laid off."""
    return Vector(start + component, tip)


@action("to-corner")
def along_way(start: Point, tip: Point, foot: Point, corner: Point) -> Vector:
    """The first leg of a path, equal to the vector from a foot to a corner elsewhere."""
    return Vector(start, start + (corner - foot))


@action("from-corner")
def after_way(start: Point, tip: Point, foot: Point, corner: Point) -> Vector:
    """The last leg of such a path."""
    return Vector(start + (corner - foot), tip)


@action("to-corner")
def before_component(start: Point, tip: Point, component: Point) -> Vector:
    """The first leg of a path whose last leg is a component laid off backwards from its tip."""
    return Vector(start, tip - component)


@action("from-corner")
def last_component(start: Point, tip: Point, component: Point) -> Vector:
    """A component as the last leg of a path between two points of a plan."""
    return Vector(tip - component, tip)


# --- its points ----------------------------------------------------------------------------------


def settle(
    pen: Pen,
    group: CoupledTrain | Higher,
    plan: Plan,
    layers: list[dict[Target, int]],
    divided: int,
    crossed: dict[str, CrossedLine],
    rims: dict[str, int],
) -> None:
    """Draw every point of the right plan, on the line through its two trials."""
    first, second = layers
    settled: dict[tuple[int, int], str] = {}
    for (quantity, of), one in first.items():
        two = second[quantity, of]
        if quantity == plan.rate and own_rate(pen, of):
            with pen.on(Part.RESULT, Plane.NUMBERS):
                value = pen.want(quantity, of, pen.draw(between, one, two, divided, name=of))
            pen.make(DividedRate(first=one, second=two, share=divided, value=value))
        elif quantity != plan.quantity:
            continue
        elif one == two or of in rims:
            pen.want(quantity, of, rims.get(of, one))
        elif pen.has(quantity, of):
            settled[one, two] = of  # of a known link, where the line of a crossing begins
        elif (one, two) in settled:
            pen.want(quantity, of, pen.the(quantity, settled[one, two]))
        else:
            line, name = crossed.get(of), plan.named(of)
            by_hand = line.crossing if line is not None else None
            with plan.drawn(pen):
                value = pen.draw(between, one, two, divided, name=name, by_hand=by_hand)
            pen.want(quantity, of, value)
            roles = {"first": one, "second": two, "share": divided, "value": value}
            pen.make(DividedPoint(**roles, point=of, crossed=line))
            settled[one, two] = of
    closing: tuple[str, ...] = ()
    match group.last:
        case Tie(_, Pin(point=p), Pin(point=q)):
            closing = in_order((p, q), [*settled.values()])
    for point in settled.values():
        if not is_under(point):
            finish(pen, plan, point, closing)
        elif plan is VELOCITY:
            relative_arrows(pen, point)
    if closing:
        plan.arrows(pen, closing[1], closing[0])


def in_order(ends: tuple[str, str], found: list[str]) -> tuple[str, ...]:
    """The ends of the bar that closes a group, the end that is known or found first in front."""
    return tuple(sorted(ends, key=lambda end: found.index(end) if end in found else -1))


def own_rate(pen: Pen, link: str) -> bool:
    """Whether two points cannot give a link's rate: a tried link with one pin."""
    base = pen.bases.get(link)
    return base is not None and base.end is None and link not in pen.leads and pen.turns(link)


def finish(pen: Pen, plan: Plan, point: str, closing: tuple[str, ...]) -> None:
    """Draw the arrows to a point of the right plan, but not that of the ``closing`` bar."""
    moved = [base for base in pen.bases.values() if pen.has(plan.quantity, base.start)]
    starts = {b.start for b in moved if point == b.end}
    starts = starts or {b.start for b in moved if point in b.others}
    pivots: list[str | None] = [*sorted(starts)]
    for pivot in pivots or [None]:
        plan.arrows(pen, point, None if (point, pivot) == closing else pivot)


# --- its arrows ----------------------------------------------------------------------------------


def relative_arrows(pen: Pen, name: str) -> None:
    """Draw the arrows of the right plan for the point of a link under a sliding one (name P@2).

    One is its velocity about the base of its link; the other is the sliding point's velocity
    relative to it. At a fixed pivot, the point is known first: the arrows are its own velocity and
    the base's velocity about it.
    """
    point, link = ends_of(name)
    here, start = pen.the("velocity", name), pen.bases[link].start
    if point in pen.scene.frame.points:
        arrow_between(pen, pen.pole(Plane.VELOCITIES), here, name, "")
        if pen.has("velocity", start):
            relative_arrow(pen, start, name)
        return
    if pen.has("velocity", point):
        arrow_between(pen, here, pen.the("velocity", point), point, letter(name))
    if pen.has("velocity", start):
        fixed = start in pen.scene.frame.points
        about_which = "" if fixed else letter(start)
        arrow_between(pen, pen.the("velocity", start), here, name, about_which)


def components(pen: Pen, group: CoupledTrain | Higher, tried: range) -> None:
    """Draw the arrows of the components in the right plan, and of the velocities that give them.

    The components laid off are those of the second trial, at the steps ``tried``: they follow from
    velocities and do not depend on the trial value. The path to a point is closed by its tangential
    component, or by its acceleration along a guide.
    """
    right = {
        number: pen.targets[target]
        for layer in pen.tried
        for target, number in layer.items()
        if target in pen.targets
    }
    with pen.on(Part.ACCELERATION, Plane.ACCELERATIONS):
        for number in tried:
            carried_legs(pen, right, number)
        for pivot, pin, vector in normals_of(pen, group):
            relative_arrow(pen, pin, pivot)
            ends = pen.the("acceleration", pivot), pen.the("acceleration", pin)
            names = about(pen, pin, pivot), letter(pin), letter(pivot)
            legs(pen, "ντ", along_component, after_component, (*ends, vector), names)
        for number in tried:
            sliding_legs(pen, right, number)


def carried_legs(pen: Pen, right: dict[int, int], number: int) -> None:
    """Draw the normal and tangential component of a point on a link of known rotation."""
    turned = pen.steps[number].of
    if not isinstance(turned, TurnedAcceleration) or turned.image != number or number not in right:
        return
    ends = right.get(turned.start, turned.start), right[number]
    names = turned.index, turned.q, turned.p
    legs(pen, "ντ", along_way, after_way, (*ends, turned.start, turned.end), names)


def sliding_legs(pen: Pen, right: dict[int, int], number: int) -> None:
    """Draw the Coriolis component of a sliding point, and its relative acceleration.

    Where the point of the guide under it is the unknown, the path runs backwards from the sliding
    point.
    """
    found = slid(pen.steps[number])
    if found is None:
        return
    laid, component = found
    start, vector = (right.get(arg, arg) for arg in pen.steps[number].args)
    names = component.index, component.point, ""
    if not laid.back:
        ends = start, pen.the("acceleration", component.point)
        legs(pen, "cr", along_component, after_component, (*ends, vector), names)
    else:
        ends = pen.the("acceleration", under(component.point, component.guide)), start
        legs(pen, "rc", before_component, last_component, (*ends, vector), names)


def legs(
    pen: Pen,
    kinds: str,
    first: Action,
    last: Action,
    args: tuple[int, ...],
    names: tuple[str, str, str],
) -> None:
    """Draw the arrows of both legs of a path in the plan, each with the sign of its component.

    ``names`` are the index of the whole vector, the moving point, and the point that it moves
    about.
    """
    index, of, about_which = names
    foot = next(filter(None, (foot_of(sign, index) for sign in kinds)))
    start, end = (pen.steps[number].name for number in args[:2])
    for leg, sign, ends in zip((first, last), kinds, ((start, foot), (foot, end)), strict=True):
        own = foot_of(sign, index)
        back = bool(own) and leg is last
        vector = PlanVector("a", index, of, about_which, sign, own, back, ends)
        if vector.symbol not in pen.arrows:
            pen.vector(leg, *args, of=vector)


def normals_of(pen: Pen, group: CoupledTrain | Higher) -> list[tuple[str, str, int]]:
    """The accelerations towards pivots within a group, each with its pivot and its pin."""
    return [
        (key[1], key[2], vector)
        for key, vector in pen.shared.items()
        if key[0] == "normal"
        and any({key[1], key[2]} <= points_on(pen, link) for link in group.links)
        and all(pen.has("acceleration", point) for point in key[1:])
    ]


def points_on(pen: Pen, link: str) -> set[str]:
    """The points of a link, with its base's end where that is under another link's point."""
    base = pen.bases.get(link)
    return {*pen.scene.link(link).points, *([base.end] if base and base.end else [])}
