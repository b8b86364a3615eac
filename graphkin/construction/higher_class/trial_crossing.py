"""The hand's way with two trials: the line through a point's trials cuts the one it must lie on."""

from __future__ import annotations

from graphkin.construction.acceleration.tangential_direction import tangential_direction
from graphkin.construction.core.pen import Pen, named
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.vocabulary import meet
from graphkin.construction.guides.coincident_points import image_under
from graphkin.construction.guides.guides import known_guide
from graphkin.construction.guides.sliding import known_end
from graphkin.construction.higher_class.trial_actions import line_through
from graphkin.construction.links.link_shapes import LinkShapes
from graphkin.construction.normal_component.normal_component import (
    lay_off_normal,
    normal_component,
)
from graphkin.construction.velocity.parallel_through import parallel_through
from graphkin.construction.velocity.perpendicular_through import perpendicular_through
from graphkin.structure.groups import Higher, Tie
from graphkin.structure.joints import partner
from graphkin.structure.pairs import Pin, Sliding

IN_PLAN = {
    "velocity": (Part.VELOCITY, Plane.VELOCITIES),
    "acceleration": (Part.ACCELERATION, Plane.ACCELERATIONS),
}
"""Where the images of points are drawn."""


def crossed_point(pen: Pen, group: Higher, quantity: str, tried: set[str]) -> str | None:
    """The point whose right image lies on a line that is known before the trials; None for none.

    ``tried`` are the points that two trials move.
    """
    match group.last:
        case Tie(_, Pin(point=p), Pin(point=q)):
            ends = [of for of, other in ((p, q), (q, p)) if pen.has(quantity, other)]
            return next((of for of in ends if of in tried), None)
        case Tie(link, Pin(point=p), Sliding() as pair) if p in tried:
            return None if partner(pair, link) in group.links else p
    return None


def crossing(
    pen: Pen, shapes: LinkShapes, group: Higher, quantity: str, of: str, ends: tuple[int, int]
) -> int:
    """Where the line through both trials of a point cuts the line on which it must lie."""
    locus = locus_of(pen, shapes, group, quantity, of)
    with pen.on(*IN_PLAN[quantity]), pen.hands_way():
        line = pen.draw(line_through, *ends, a=named(pen, ends[0]), b=named(pen, ends[1]))
        return pen.draw(meet, line, locus)


def locus_of(pen: Pen, shapes: LinkShapes, group: Higher, quantity: str, of: str) -> int:
    """The line on which a pin must lie in the plan: square to its bar, or parallel to its guide."""
    last = group.last
    assert isinstance(last, Tie)
    if isinstance(last.second, Sliding):
        return along_guide(pen, shapes, last.link, last.second, quantity, of)
    ends = last.first, last.second
    other = next(end.point for end in ends if isinstance(end, Pin) and end.point != of)
    if quantity == "velocity":
        with pen.on(*IN_PLAN[quantity]), pen.hands_way():
            return perpendicular_through(pen, other, of)
    vector = normal_component(pen, other, of)
    with pen.on(*IN_PLAN[quantity]), pen.hands_way():
        return tangential_direction(pen, other, of, lay_off_normal(pen, other, of, vector))


def along_guide(
    pen: Pen, shapes: LinkShapes, link: str, pair: Sliding, quantity: str, of: str
) -> int:
    """The parallel to a guide of a known link from what is known of a sliding point's motion."""
    if quantity == "velocity":
        start = image_under(pen, partner(pair, link), of)
    else:
        with pen.on(*IN_PLAN[quantity]):
            start = known_end(pen, pair, link, of)
    guide = known_guide(pen, shapes, pair)
    with pen.on(*IN_PLAN[quantity]), pen.hands_way():
        return parallel_through(pen, start, guide, pair.links[0])
