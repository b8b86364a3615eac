"""The point of a link that coincides with another link's point: its images in both plans."""

from __future__ import annotations

from graphkin.construction.core.pen import Pen, letter
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.vocabulary import in_proportion
from graphkin.construction.plan import Plan
from graphkin.construction.velocity.image_of_link import image_of_link, translated_image
from graphkin.scene.link_points import under
from graphkin.scene.model import FRAME
from graphkin.structure.pairs import is_in_scene


def image_under(pen: Pen, link: str, point: str, plan: Plan) -> int:
    """The image in a plan of the point of a known link that coincides with a given point.

    A link that does not turn has one image for all its points. Otherwise, the plan has a figure
    similar to the link.
    """
    if link == FRAME:
        return pen.pole(plan.plane)
    if not pen.turns(link):
        return shifted(pen, link, point, plan)
    if point in pen.scene.link(link).points:
        return pen.the(plan.quantity, point)
    base, name = pen.bases[link], under(point, link)
    if not pen.has(plan.quantity, name):
        pen.want("position", name, pen.the("position", point))
        pen.want(plan.quantity, name, found_under(pen, link, point, plan))
        plan.arrows(pen, name, base.start if base.end is None else None)
    return pen.the(plan.quantity, name)


def shifted(pen: Pen, link: str, point: str, plan: Plan) -> int:
    """The image of a point of a translating link: that of its other points, with its own letter."""
    start, name = pen.bases[link].start, under(point, link)
    number = pen.the(plan.quantity, start)
    if point in pen.scene.link(link).points or not is_in_scene(point):
        return number
    if not pen.has(plan.quantity, name):
        pen.want("position", name, pen.the("position", point))
        with pen.on(pen.steps[number].part, pen.steps[number].plane):
            ends = letter(start), letter(name)
            found = translated_image(pen, number, ends, plan.named(name))
        pen.shared["fallen", found] = number
        pen.want(plan.quantity, name, found)
    return pen.the(plan.quantity, name)


def source_of(pen: Pen, number: int) -> int:
    """The image with which a translating link's image coincides, or the image itself."""
    return pen.shared.get(("fallen", number), number)


def found_under(pen: Pen, link: str, point: str, plan: Plan) -> int:
    """The step that finds the image of a link's point under another point."""
    base, name = pen.bases[link], under(point, link)
    if base.end is None:
        return found_by_turning(pen, link, name, plan)
    if base.end == name:
        return pen.the(plan.quantity, base.end)
    places = [pen.the("position", each) for each in (base.start, base.end, point)]
    with pen.on(Part.SHAPE, Plane.NUMBERS):
        ratio = pen.draw(in_proportion, *places)
    letters = letter(base.start), letter(base.end), letter(name)
    images = pen.the(plan.quantity, base.start), pen.the(plan.quantity, base.end), ratio
    with plan.drawn(pen):
        called, whole = plan.named(name), plan.lettered(name)
        return image_of_link(pen, images, letters, name=called, whole=whole)


def found_by_turning(pen: Pen, link: str, name: str, plan: Plan) -> int:
    """The image of a point of a link of known rotation, from the image of its base."""
    base = pen.bases[link].start
    start, steady = pen.the(plan.quantity, base), plan.is_steady(pen, link)
    with plan.drawn(pen):
        return plan.turned(pen, link, base, name, start, steady=steady)
