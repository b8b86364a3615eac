"""Links that turn together because they slide on one another, and links that never turn."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import combinations

from msgspec import Struct

from graphkin.numbers.plane import cross
from graphkin.scene.model import FRAME, Link, Scene, Slide
from graphkin.structure.link_axes import body, guide_line, metres

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
