"""The vectors of the requested points: arrows from the pole, and on the mechanism."""

from __future__ import annotations

from collections.abc import Iterable

from graphkin.construction.core.palette import TRANSFER, Move, vector_at_point
from graphkin.construction.core.pen import Pen, letter
from graphkin.construction.core.plan_vector import PlanVector
from graphkin.construction.core.program import Plane
from graphkin.construction.core.quantities import CENTRES, MOTION, names_asked
from graphkin.construction.core.vocabulary import action
from graphkin.construction.guides.coincident_points import image_under
from graphkin.construction.plan import Plan
from graphkin.numbers.arithmetic import Point, Real
from graphkin.numbers.plane import Vector
from graphkin.scene.link_points import ends_of


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


def show(pen: Pen, plan: Plan, tips: Iterable[str]) -> None:
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
