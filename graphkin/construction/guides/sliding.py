"""What is known of the acceleration of a point that slides: where it is laid off to in the plan.

That is the acceleration of the point under it, and where the guide turns the component for that.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphkin.construction.core.arrows import slide_arrow
from graphkin.construction.core.component import LaidOff
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import Part, Plane, Step
from graphkin.construction.core.vocabulary import part_along
from graphkin.construction.guides.coincident_points import carried
from graphkin.construction.guides.guides import known_guide
from graphkin.construction.links.link_shapes import LinkShapes
from graphkin.construction.plans.plan import ACCELERATION, VELOCITY
from graphkin.scene.link_points import is_under
from graphkin.structure.joints import partner
from graphkin.structure.pairs import Joint

if TYPE_CHECKING:
    from graphkin.construction.coriolis import CoriolisComponent


def turning_component(pen: Pen, pair: Joint, link: str, name: str, point: str) -> int | None:
    """The component that the turning of a guide gives a slide; None where it does not turn.

    Where the point of a guide's link under a pin is sought (name A@3, point A), the pin's relative
    velocity counts, else that of the point against what it slides on.
    """
    known = partner(pair, link)
    if not is_under(name) and not pen.turns(known):
        return None
    from graphkin.construction.coriolis import coriolis_of

    if is_under(name):
        tail, tip = pen.the("velocity", name), pen.the("velocity", point)
        return coriolis_of(pen, link, tail, tip, point, pair.links[0])
    tail, tip = carried(pen, known, point, VELOCITY), pen.the("velocity", point)
    return coriolis_of(pen, known, tail, tip, point, pair.links[0])


def lay_off_component(
    pen: Pen, pair: Joint, link: str, name: str, point: str, vector: int | None
) -> int:
    """The end of the component, laid off from the point under the sliding one.

    Where that is the one that is sought, it is laid off backwards from the sliding one.
    """
    if vector is None:
        return carried(pen, partner(pair, link), point, ACCELERATION)
    from graphkin.construction.coriolis import end_of

    if is_under(name):
        return end_of(pen, pen.the("acceleration", point), vector, back=True)
    return end_of(pen, carried(pen, partner(pair, link), point, ACCELERATION), vector)


def end_on_driven(
    pen: Pen, link: str, images: tuple[int, int], point: str, block: str, index: str
) -> int:
    """The same for a link that a driver slides against another, as its pin on ``point`` is known.

    The ``images`` of the velocity plan are those of that point and of the link's own point there.
    """
    from graphkin.construction.coriolis import coriolis_of, end_of

    vector = coriolis_of(pen, link, *images, point, block, index=index)
    with pen.on(Part.ACCELERATION, Plane.ACCELERATIONS):
        return end_of(pen, pen.the("acceleration", point), vector)


def slid(step: Step) -> tuple[LaidOff, CoriolisComponent] | None:
    """The component of what slides that a step lays off; None for other steps."""
    from graphkin.construction.coriolis import CoriolisComponent

    laid = step.of
    if not isinstance(laid, LaidOff) or not isinstance(laid.component, CoriolisComponent):
        return None
    return laid, laid.component


def sliding(pen: Pen, shapes: LinkShapes, block: str) -> None:
    """Acceleration of a block along its guide, and the component that comes of its turning."""
    pair = pen.first_slide(block)
    first = pen.scene.link(block).points[0]
    start = carried(pen, pair.links[1], first, ACCELERATION)
    guide, end = known_guide(pen, shapes, pair), pen.the("acceleration", first)
    if pen.turns(pair.links[1]):
        vector = turning_component(pen, pair, block, first, first)
        assert vector is not None
        pen.want("coriolis", block, vector)
        with pen.on(Part.ACCELERATION, Plane.ACCELERATIONS):
            start = lay_off_component(pen, pair, block, first, first, vector)
            slide_arrow(pen, start, end, pair.links[1], first)
    with pen.on(Part.RESULT, Plane.NUMBERS):
        pen.want("slide acceleration", block, pen.draw(part_along, guide, start, end))
