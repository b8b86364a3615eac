"""The velocities of points of contact: nothing slips, so both have one."""

from __future__ import annotations

from collections.abc import Iterator

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import construction, constructions
from graphkin.construction.core.naming import arrow_of
from graphkin.construction.core.plan_pole import PlanPole
from graphkin.construction.core.plan_vector import plan_vector
from graphkin.construction.core.program import Plane
from graphkin.construction.core.quantities import OMEGA
from graphkin.construction.core.relation import Relation, answer
from graphkin.construction.rolling.contact_points import PointOfContact
from graphkin.construction.velocity.perpendicular_through import PerpendicularThrough
from graphkin.construction.velocity.turning_of_link import TurningOfLink
from graphkin.drawing.symbol_markup import symbol


def of_contacts(drawing: Drawing) -> Iterator[Relation]:
    """The velocities at contacts that the plan holds by another name, for nothing slips there."""
    if drawing.kind != "velocity":
        return
    for contact, index, (tail, tip), key in at_contacts(drawing):
        arrow = arrow_of(drawing, tail, tip)
        vector = plan_vector(arrow) if arrow else None
        if vector is None or vector.symbol == f"v_{index}":
            continue
        name = symbol(vector.symbol)
        size = drawing.settled(abs(drawing.trace.values[tip] - drawing.trace.values[tail]))
        fields = {"contact": symbol(f"v_{contact}"), "v": name}
        remark = drawing.words(f"calculation.{key}", **fields)
        yield Relation(symbol(f"v_{index}"), name, "", answer(drawing, size), "m/s", remark)


def at_contacts(drawing: Drawing) -> Iterator[tuple[str, str, tuple[int, int], str]]:
    """The velocities at contacts that are used: contact, index, ends in the plan, what to say."""
    program, pole = drawing.trace.program, -1
    contacts = {each.point for each in constructions(program, PointOfContact)}
    for number, step, _ in drawing.steps(drawing.plane, Plane.NUMBERS):
        match construction(step):
            case PlanPole():
                pole = number
            case PerpendicularThrough(contact=contact, p=p, start=start) if contact:
                yield p, p, (pole, start), "no_slip"
            case TurningOfLink(places=(_, place)) as turning if (
                place in contacts and turning.quantity == OMEGA
            ):
                key = "contact_rests_opposite" if turning.images[1] == pole else "no_slip"
                yield turning.q, turning.index, turning.images, key
