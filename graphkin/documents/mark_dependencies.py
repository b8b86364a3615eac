"""The dependencies of mechanism marks without a step: points, axes, and driver positions."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.guides.rails import places_of
from graphkin.construction.guides.slide_symbols import frame_guides
from graphkin.construction.links.link_shapes import corners_of, farthest, is_all_wheel
from graphkin.construction.links.wheel_symbols import TOUCHED, straight_tracks, touching_points
from graphkin.drawing.field import Field
from graphkin.drawing.marks import Mark, style_class
from graphkin.scene.model import FRAME, Driver, Link

Target = tuple[str, str]
BODY = ("plate", "outline", "link", "number", "label", "leader")
"""The classes of a link's bar or plate, and of its number."""


def ground_of(drawing: Drawing, field: Field) -> Mapping[Mark, tuple[Target, ...]]:
    """The guides and straight tracks of the frame, each with the points around which it is drawn.

    Their lines across the field say nothing of the positions of blocks and wheels.
    """
    found: dict[Mark, tuple[Target, ...]] = {}
    links = drawing.scene.links
    for blocks, marks in frame_guides(drawing, field):
        about = tuple(("position", links[block].points[0]) for block in blocks)
        found |= dict.fromkeys(marks, about)
    for touch, marks in straight_tracks(drawing, field):
        if touch.on == FRAME:
            found |= dict.fromkeys(marks, (("position", touch.disc.wheel.centre),))
    return found


def rests_on(drawing: Drawing, mark: Mark) -> Iterator[Target]:
    """The targets of the program that a mark depends on; none for a given mark."""
    link = drawing.scene.links.get(mark.name)
    if mark.shows is not None:
        drivers = (d for d in drawing.scene.drivers if d.link == mark.shows.link)
        if mark.shows.what != "guide":
            yield from of_driver(drawing, next(drivers))
    elif link is not None:
        yield from of_link(drawing, link, style_class(mark))
    else:
        yield "position", mark.name


def of_link(drawing: Drawing, link: Link, kind: str) -> Iterator[Target]:
    """The targets of a link's mark: points, and its axis where the points do not define it."""
    points = list(link.points)
    turned = len(points) < 2
    carriers = {way.slide.on for way in drawing.standing.guideways}
    if kind == TOUCHED:
        points, turned = touching_points(drawing, link), False
    elif kind == "disc":
        points, turned = [wheel.centre for wheel in link.wheels], False
    elif kind == "slider":
        points, turned = points[:1], False
    elif kind == "block" or (link.name in carriers and corners_of(drawing, link) is None):
        points, turned = points[:1], True
    elif kind in BODY and not any(wheel.teeth for wheel in link.wheels):
        points = body_of(drawing, link)
        level = link.wheels or any(slide.on == FRAME for slide in link.slides)
        turned = len(points) < 2 and not level
    yield from (("position", point) for point in points)
    if turned:
        yield "axis", link.name


def body_of(drawing: Drawing, link: Link) -> list[str]:
    """The points that a link's body needs: ends of a bar, corners of a plate, a wheel's centre."""
    if link.wheels and is_all_wheel(drawing, link.name):
        return [wheel.centre for wheel in link.wheels]
    places = places_of(drawing, link.name)
    if len(places) < 2:
        return list(link.points)
    ends = corners_of(drawing, link) or farthest(places)
    return [point for point in link.points if drawing.positions.get(point) in ends]


def of_driver(drawing: Drawing, driver: Driver) -> Iterator[Target]:
    """The targets that show the position of a driver."""
    link = drawing.scene.links[driver.link]
    if driver.kind == "turn":
        yield from (("position", point) for point in (driver.of or link.points)[:2])
    elif driver.kind == "slide":
        yield "position", link.points[0]
        yield "guide", link.name
    else:
        yield from (("position", wheel.centre) for wheel in link.wheels)
