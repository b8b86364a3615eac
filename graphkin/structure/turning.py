"""The points, guides and tracks of a link in its own axes, and which links turn together.

These numbers decide which wheels touch and which link keeps a distance. Lengths are floats in
metres. The construction and the residual check compute their own. Links turn together because they
slide on one another; some links never turn.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import combinations

from msgspec import Struct

from graphkin.numbers.arithmetic import Point
from graphkin.numbers.plane import Circle, Line, circle_meets_circle, cross
from graphkin.scene.model import (
    FRAME,
    Angled,
    Apart,
    At,
    GuideOrTrack,
    Link,
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


LEVEL = 1e-9
"""Sine of an angle below which two directions count as parallel."""


class Stand(Struct, frozen=True):
    """The angle and height of a link relative to another along which it only slides.

    ``lean`` is the direction of its x axis in the other link's axes. ``height`` (m) is the distance
    of its origin to the left of the line through the other's origin in the common direction.
    """

    lean: complex
    height: float


def turns(scene: Scene, name: str) -> bool:
    """Whether a link can turn: False if slides alone join it to the frame, one after another."""
    return FRAME not in together(scene, name)


def guides_under(scene: Scene, name: str) -> Iterator[str]:
    """The link below a block, the one below that, and so on to a link that does not slide."""
    seen: set[str] = set()
    while name != FRAME and name not in seen and scene.links[name].slides:
        seen.add(name)
        name = scene.links[name].slides[0].on
        yield name


def together(scene: Scene, name: str) -> frozenset[str]:
    """All links that turn with a link, because slides, or two pins, join them."""
    beside: dict[str, list[str]] = {}
    joined = [(block, slide.on) for block, slide in every_slide(scene)]
    for one, other in (*joined, *((block, on) for block, _, on in pinned_twice(scene))):
        beside.setdefault(one, []).append(other)
        beside.setdefault(other, []).append(one)
    found, waiting = {name}, [name]
    while waiting:
        new = [link for link in beside.get(waiting.pop(), ()) if link not in found]
        found.update(new)
        waiting += new
    return frozenset(found)


def every_slide(scene: Scene) -> Iterator[tuple[str, Slide]]:
    """Every block with each of its guides."""
    for link in scene.links.values():
        for slide in link.slides:
            yield link.name, slide


def pinned_twice(scene: Scene) -> Iterator[tuple[str, str, str]]:
    """Two blocks pinned to one link and guided in parallel by another, with the link they carry.

    The link keeps the direction of the guides, like a rod in two bushings.
    """
    beside: dict[str, list[tuple[str, complex]]] = {}
    for block, slide in every_slide(scene):
        for rail, other in ((slide.on, block), (block, slide.on)):
            if rail != FRAME != other:
                beside.setdefault(rail, []).append((other, guide_on(scene, rail, block, slide)))
    for rail, blocks in beside.items():
        for (one, way), (other, second) in combinations(blocks, 2):
            if one == other or abs(cross(way, second)) > LEVEL:
                continue
            for link in scene.every_link:
                if link.name not in (rail, one, other) and two_pins(scene, one, other, link):
                    yield one, other, link.name


def two_pins(scene: Scene, one: str, other: str, on: Link) -> bool:
    """Whether two links are pinned to a third, each by a point of its own."""
    first, second = ({*scene.link(name).points} & {*on.points} for name in (one, other))
    return bool(first and second) and len(first | second) > 1


def guide_on(scene: Scene, link: str, block: str, slide: Slide) -> complex:
    """The direction of a guide in the axes of one of its two links.

    A block's x axis is parallel to its first guide.
    """
    return complex(guide_line(scene, slide).along) if slide.on == link else 1 + 0j


def stands_along(scene: Scene, base: str, way: complex) -> Mapping[str, Stand]:
    """The links that move relative to ``base`` only along ``way``, a unit vector in its axes.

    Slides in that direction join them, so that each link keeps its angle and its height. A block's
    x axis is parallel to its first guide.
    """
    found, waiting = {base: Stand(1 + 0j, 0.0)}, [base]
    while waiting:
        here = waiting.pop()
        for link in scene.links.values():
            for slide in link.slides[:1]:
                reached, stand = link.name, None
                if slide.on == here and link.name not in found:
                    stand = block_stand(scene, link.name, slide, found[here], way)
                elif link.name == here and slide.on not in found:
                    reached = slide.on
                    stand = carrier_stand(scene, link.name, slide, found[here], way)
                if stand is not None:
                    found[reached] = stand
                    waiting.append(reached)
    return found


def block_stand(scene: Scene, block: str, slide: Slide, under: Stand, way: complex) -> Stand | None:
    """The stand of a block, from its guide's link; None if the guide is not parallel."""
    line = guide_line(scene, slide)
    lean = under.lean * line.along
    if abs(cross(way, lean)) > LEVEL:
        return None
    return Stand(lean, under.height + lift(scene, block, slide, under.lean, way))


def carrier_stand(
    scene: Scene, block: str, slide: Slide, upon: Stand, way: complex
) -> Stand | None:
    """The stand of a guide's link, from its block's; None if the guide is not parallel."""
    line = guide_line(scene, slide)
    lean = upon.lean / line.along
    if abs(cross(way, upon.lean)) > LEVEL:
        return None
    return Stand(lean, upon.height - lift(scene, block, slide, lean, way))


def lift(scene: Scene, block: str, slide: Slide, lean: complex, way: complex) -> float:
    """The height of a block's origin above the origin of its guide's link, for a given lean."""
    line, points = guide_line(scene, slide), body(scene, block)
    foot = line.point + 1j * metres(scene, slide.offset) * line.along
    first = points[scene.links[block].points[0]]
    return float(cross(way, lean * foot) - cross(way, lean * line.along * first))
