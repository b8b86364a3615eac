"""The points, guides and tracks of a link in its own axes, at the scene's parameters.

These numbers decide which wheels touch and which link keeps a distance. Lengths are floats in
metres. The construction and the residual check compute their own.
"""

from __future__ import annotations

from graphkin.numbers.arithmetic import Point
from graphkin.numbers.plane import Circle, Line, circle_meets_circle
from graphkin.scene.model import (
    FRAME,
    Angled,
    Apart,
    At,
    GuideOrTrack,
    OnLine,
    Placing,
    Polar,
    Scene,
    Slide,
    Triangle,
)
from graphkin.scene.quantity import Quantity
from graphkin.text.errors import StructureError, message

Body = dict[str, complex]


def body(scene: Scene, name: str) -> Body:
    """Every point of a link in its own axes (m). Raises StructureError for impossible lengths."""
    placed: Body = {}
    for placing in scene.link(name).placings:
        try:
            placed[placing.point] = located(scene, placing, placed)
        except (ValueError, ZeroDivisionError):
            place = "frame" if name == FRAME else f"links.{name}"
            raise StructureError.at(
                f"{place}.{placing.point}",
                message("the lengths give no such point"),
                message("sides of a triangle, each shorter than the other two together"),
            ) from None
    for point in scene.link(name).points:
        placed.setdefault(point, 0j)
    return placed


def located(scene: Scene, placing: Placing, placed: Body) -> complex:
    """One point from those placed before it."""
    match placing:
        case At(_, x, y):
            return complex(metres(scene, x), metres(scene, y))
        case Polar(_, start, length, angle):
            return placed[start] + metres(scene, length) * unit(scene, angle)
        case Apart(_, start, length):
            return placed[start] + metres(scene, length)
        case Triangle(_, first, second, from_first, from_second, side):
            near = Circle(placed[first], metres(scene, from_first))
            far = Circle(placed[second], metres(scene, from_second))
            return complex(circle_meets_circle(near, far, side))
        case OnLine(_, first, second, start, length, sense):
            way = placed[second] - placed[first]
            return placed[start] + sense * metres(scene, length) * way / abs(way)
        case Angled(_, vertex, arm, length, angle):
            way = placed[arm] - placed[vertex]
            return placed[vertex] + metres(scene, length) * unit(scene, angle) * way / abs(way)


def metres(scene: Scene, quantity: Quantity) -> float:
    """A length in metres."""
    return float(quantity.si(scene.values))


def unit(scene: Scene, angle: Quantity | None) -> complex:
    """The unit vector at an angle; the x axis without one."""
    return 1 + 0j if angle is None else complex(angle.direction(scene.values))


def guide_line(scene: Scene, slide: Slide) -> Line:
    """A guide in the axes of its link, along a unit vector; block offsets are not included."""
    if slide.along is None:
        return Line(through(scene, slide), unit(scene, slide.angle))
    points = body(scene, slide.on)
    first, second = (points[name] for name in slide.along)
    if first == second:
        names = "-".join(slide.along)
        found = message("{names} has no length, so that it has no direction", names=names)
        raise StructureError.at(f"links.{slide.on}", found, message("two points apart"))
    return Line(first, (second - first) / abs(second - first))


def through(scene: Scene, joint: GuideOrTrack) -> Point:
    """The point of a guide's or track's ``through``, in the axes of its link."""
    match joint.through:
        case str(name):
            return body(scene, joint.on)[name]
        case (x, y):
            return complex(metres(scene, x), metres(scene, y))
    return 0j
