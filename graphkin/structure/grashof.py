"""The links of a single loop that can turn fully: Grashof's rule and the slider-crank's.

Both rules concern the links relative to one another, whichever is fixed: the shortest bar turns
fully relative to all others, or no link turns fully relative to any.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations
from typing import Literal

from msgspec import Struct

from graphkin.numbers.plane import cross
from graphkin.scene.model import FRAME, Scene
from graphkin.structure.pairs import Joint, Joints, Pin, Sliding
from graphkin.structure.turning import body, guide_line, metres

EVEN = 1e-9
"""Relative difference below which two sums of lengths count as equal."""

Kind = Literal["crank-rocker", "double crank", "double rocker", "triple rocker", "change point"]


class FourBar(Struct, frozen=True):
    """A loop of four links and four pins: each link with its length (m), the fixed one first."""

    links: tuple[str, str, str, str]
    lengths: tuple[float, float, float, float]

    @property
    def kind(self) -> Kind:
        """Grashof's class."""
        return grashof(*self.lengths)

    @property
    def slack(self) -> int:
        """+1 where the shortest bar turns fully, 0 at the limit, -1 where no link does."""
        return {"triple rocker": -1, "change point": 0}.get(self.kind, 1)

    @property
    def turning(self) -> tuple[str, ...]:
        """The links that turn fully relative to all others: the shortest, or none.

        At a change point several links may be the shortest.
        """
        if self.slack < 0:
            return ()
        bars = zip(self.links, self.lengths, strict=True)
        return tuple(name for name, long in bars if compare(long, min(self.lengths)) == 0)


class SliderCrank(Struct, frozen=True):
    """A loop of four links with three pins and one slide.

    ``guide`` carries the guide, and ``block`` slides on it. ``crank`` is the bar pinned to the
    guide's link, ``rod`` the one pinned to the block; lengths are in m. ``offset`` is the distance
    of the crank's pin on the guide's link from the path of the block's pin.
    """

    guide: str
    block: str
    crank: tuple[str, float]
    rod: tuple[str, float]
    offset: float

    @property
    def links(self) -> tuple[str, str, str, str]:
        """All four, in the order of the loop."""
        return self.guide, self.crank[0], self.rod[0], self.block

    @property
    def lengths(self) -> tuple[float, float]:
        """The shorter and the longer bar."""
        return min(self.crank[1], self.rod[1]), max(self.crank[1], self.rod[1])

    @property
    def slack(self) -> int:
        """+1 where the shorter bar turns fully, 0 at the limit, -1 where no link does.

        A link turns fully iff r + |d| <= c, with r the shorter bar, c the longer one and d the
        offset.
        """
        short, long = self.lengths
        return compare(long, short + abs(self.offset))

    @property
    def turning(self) -> tuple[str, ...]:
        """The links that turn fully relative to all others: the shorter bar, both, or none."""
        if self.slack < 0:
            return ()
        bars = (self.crank, self.rod)
        return tuple(name for name, long in bars if compare(long, self.lengths[0]) == 0)


Loop = FourBar | SliderCrank


def grashof(fixed: float, first: float, coupler: float, last: float) -> Kind:
    """The class of a four-bar by its lengths in the order of the loop, the fixed link's first.

    Grashof: with s the shortest, l the longest, and p and q the other lengths, the shortest link
    turns fully relative to all others iff s + l <= p + q.
    """
    short, *middle, long = sorted((fixed, first, coupler, last))
    sign = compare(sum(middle), short + long)
    if sign == 0:
        return "change point"
    if sign < 0:
        return "triple rocker"
    if short == fixed:
        return "double crank"
    return "double rocker" if short == coupler else "crank-rocker"


def compare(one: float, other: float) -> int:
    """Sign of the difference of two lengths; 0 where they are equal but for rounding."""
    gap = one - other
    return 0 if abs(gap) <= EVEN * max(one, other) else 1 if gap > 0 else -1


def single_loops(scene: Scene) -> tuple[Loop, ...]:
    """The loops of four links with four pins, or three pins and a slide, the frame's first."""
    found: list[Loop] = []
    if scene.cams:  # an equivalent linkage is valid only at its instant
        return ()
    bodies = Bodies(scene)
    for links, joints in four_cycles(Joints(scene)):
        loop = loop_of(bodies, links, joints)
        found += [] if loop is None else [loop]
    return tuple(sorted(found, key=lambda loop: FRAME not in loop.links))


def four_cycles(every: Joints) -> Iterator[tuple[tuple[str, ...], list[Joint]]]:
    """Each ring of four links, once, with its first-written link first.

    Each link is joined to both neighbours by one pair each, at different places. Otherwise the
    neighbours are joined directly: many links at one pin form no ring.
    """
    order = every.order
    near = {name: joined_once(every, name) for name in order}
    for first in order:
        later = [name for name in near[first] if order[name] > order[first]]
        at_start = {name: place_of(near[first][name]) for name in later}
        for second, last in combinations(later, 2):
            if at_start[second] == at_start[last]:
                continue
            for third, inner in near[second].items():
                outer = near[last].get(third)
                if outer is None or third == last or order[third] <= order[first]:
                    continue
                places = at_start[second], place_of(inner), place_of(outer), at_start[last]
                if len({*places}) == len(places):
                    joints = [near[first][second], inner, outer, near[first][last]]
                    yield (first, second, third, last), joints


def joined_once(every: Joints, link: str) -> dict[str, Joint]:
    """The links that exactly one pair joins to a link, each with that pair, in written order."""
    pairs = {other: every.between(link, (other,)) for other in every.neighbours(link)}
    return {other: joined[0] for other, joined in pairs.items() if len(joined) == 1}


def place_of(joint: Joint) -> str | tuple[str, str]:
    """The identity of a pair: the point of a pin, else the two links."""
    return joint.point if isinstance(joint, Pin) else joint.links


class Bodies(dict[str, Mapping[str, complex]]):
    """The points of each link in its own axes (m), computed once."""

    def __init__(self, scene: Scene) -> None:
        self.scene = scene

    def __missing__(self, link: str) -> Mapping[str, complex]:
        self[link] = body(self.scene, link)
        return self[link]

    def bar(self, link: str, one: str, other: str) -> float:
        """The distance of two points on a link (m)."""
        return abs(self[link][one] - self[link][other])


def loop_of(bodies: Bodies, links: Sequence[str], joints: Sequence[Joint]) -> Loop | None:
    """The loop of a ring of four links, in which link i is joined to the next by joint i."""
    pins = [joint.point for joint in joints if isinstance(joint, Pin)]
    if len(set(pins)) == 4:
        lengths = [bodies.bar(link, pins[i - 1], pins[i]) for i, link in enumerate(links)]
        a, b, c, d = links
        return FourBar((a, b, c, d), (lengths[0], lengths[1], lengths[2], lengths[3]))
    if len(pins) != 3 or len(set(pins)) != 3:
        return None
    turned, slide = next((i, joint) for i, joint in enumerate(joints) if not isinstance(joint, Pin))
    if not isinstance(slide, Sliding):
        return None
    ring = [*links[turned + 1 :], *links[: turned + 1]]
    points = [j.point for j in (*joints[turned + 1 :], *joints[:turned]) if isinstance(j, Pin)]
    if ring[0] != slide.block:
        ring, points = ring[::-1], points[::-1]
    return slider_crank(bodies, slide, ring, points)


def slider_crank(
    bodies: Bodies, slide: Sliding, ring: Sequence[str], points: Sequence[str]
) -> SliderCrank | None:
    """The loop from the block over the rod and the crank to the guide's link, with its pins.

    None for a block whose axes are not parallel to this guide, so that its offset is not known.
    """
    block, rod, crank, guide = ring
    at_block, middle, at_guide = points
    scene, own, base = bodies.scene, bodies[block], bodies[guide]
    line = guide_line(scene, slide.slide)
    across = own[at_block] - own[scene.links[block].points[0]]
    if across and slide.slide != scene.links[block].slides[0]:
        return None
    height = metres(scene, slide.slide.offset) + across.imag
    offset = height - cross(line.along, base[at_guide] - line.point)
    return SliderCrank(
        guide,
        block,
        (crank, bodies.bar(crank, middle, at_guide)),
        (rod, bodies.bar(rod, at_block, middle)),
        float(offset),
    )
