"""Sums of vectors: every point of a mechanism as a chain of links and slides from the frame.

Links that only slide on one another turn together; they form one *turning* with one unknown angle.
A chain is then a fixed vector per turning, plus or minus one slide vector per guide passed.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from msgspec import Struct, field

from graphkin.loops.rigid_bodies import Body, Guide
from graphkin.numbers.arithmetic import Point, Real
from graphkin.scene.model import FRAME
from graphkin.text.errors import Problem, StructureError


class Chain(Struct, frozen=True):
    """Sum over turnings k of fixed[k]·e^{iθ_k} plus, over slides j, slid[j]·s_j·(its direction)."""

    fixed: Mapping[int, Point] = field(default_factory=dict)
    slid: Mapping[int, int] = field(default_factory=dict)

    def plus(self, turning: int, vector: Point) -> Chain:
        """The chain continued by a vector that is fixed in a turning."""
        return Chain({**self.fixed, turning: self.fixed.get(turning, 0j) + vector}, self.slid)

    def along(self, slide: int, sense: int) -> Chain:
        """The chain continued along a guide, or back along it with sense -1."""
        return Chain(self.fixed, {**self.slid, slide: self.slid.get(slide, 0) + sense})

    def minus(self, other: Chain) -> Chain:
        """The way from the end of another chain to the end of this one."""
        fixed, slid = dict(self.fixed), dict(self.slid)
        for turning, vector in other.fixed.items():
            fixed[turning] = fixed.get(turning, 0j) - vector
        for slide, count in other.slid.items():
            slid[slide] = slid.get(slide, 0) - count
        return Chain(fixed, slid)


class Turnings(Struct, frozen=True):
    """The turning that each link belongs to, and its fixed lean (unit vector) against it.

    ``angle`` is the lean in radians, summed from guide to guide and not reduced. Turning 0 is the
    frame's: its angle is zero.
    """

    of: Mapping[str, int]
    lean: Mapping[str, Point]
    angle: Mapping[str, Real]
    count: int


Found = tuple[dict[str, int], dict[str, Point], dict[str, Real]]


def turnings(links: Sequence[str], guides: Sequence[Guide]) -> Turnings:
    """Gather the links that slide on one another; a block's x axis lies along its first guide."""
    tied = [guide for guide in guides if guide.first and guide.turns_alike]
    of: dict[str, int] = {}
    lean: dict[str, Point] = {}
    angle: dict[str, Real] = {}
    for seed in links:
        if seed not in of:
            of[seed], lean[seed], angle[seed] = max(of.values(), default=-1) + 1, 1 + 0j, 0.0
            spread(seed, tied, (of, lean, angle))
    return Turnings(of, lean, angle, max(of.values()) + 1)


def refuse_unknown_lean(turned: Turnings, guides: Sequence[Guide]) -> None:
    """A further guide of a block must join links that turn together already.

    How far the second link leans against the block the scene does not say.
    """
    for guide in guides:
        if guide.turns_alike and turned.of[guide.block] != turned.of[guide.on]:
            raise StructureError(
                Problem(
                    f"links.{guide.block}.slides",
                    f"the angle between this block and link {guide.on} is not known",
                    hint=f"write link {guide.on} as the block that slides on {guide.block}",
                )
            )


def spread(seed: str, tied: Sequence[Guide], found: Found) -> None:
    """Reach every link that turns with the seed, guide by guide."""
    of, lean, angle = found
    waiting = [seed]
    while waiting:
        here = waiting.pop()
        for guide in tied:
            if guide.on == here and guide.block not in of:
                other, along, turn = guide.block, guide.along, np.angle(guide.along)
            elif guide.block == here and guide.on not in of:
                other, along, turn = guide.on, 1 / guide.along, -np.angle(guide.along)
            else:
                continue
            of[other], lean[other], angle[other] = of[here], lean[here] * along, angle[here] + turn
            waiting.append(other)


class Tree:
    """A spanning tree of the joints from a link; every joint left over closes a loop."""

    def __init__(
        self,
        bodies: Mapping[str, Body],
        guides: Sequence[Guide],
        turned: Turnings,
        root: str = FRAME,
    ) -> None:
        self.bodies, self.guides, self.turned = bodies, guides, turned
        self.origins: dict[str, Chain] = {root: Chain()}
        self.spent: set[tuple[str, str]] = set()
        self.passed: set[int] = set()
        self.owners: dict[str, list[str]] = {}
        self.led: dict[str, list[int]] = {}
        for link, body in bodies.items():
            for point in body:
                self.owners.setdefault(point, []).append(link)
        for index, guide in enumerate(guides):
            for link in dict.fromkeys((guide.on, guide.block)):
                self.led.setdefault(link, []).append(index)
        waiting = [root]
        while waiting:
            waiting += self._reach_from(waiting.pop(0))

    def _reach_from(self, link: str) -> list[str]:
        """Hang on a link every body that shares a pin or a guide with it and is not yet reached."""
        reached = []
        for point in self.bodies[link]:
            for other in self.owners[point]:
                if other not in self.origins:
                    arm = -self.bodies[other][point]
                    self.origins[other] = self.step(self.at(link, point), other, arm)
                    self.spent |= {(point, link), (point, other)}
                    reached.append(other)
        for index in self.led.get(link, ()):
            guide = self.guides[index]
            if guide.on == link and guide.block not in self.origins:
                stand = self.on_guide(index).along(index, 1)
                self.origins[guide.block] = self.step(stand, guide.block, -self.head(index))
                reached.append(guide.block)
            elif guide.block == link and guide.on not in self.origins:
                way = self.step(self.origins[link], link, self.head(index)).along(index, -1)
                foot = guide.through + 1j * guide.offset * guide.along
                self.origins[guide.on] = self.step(way, guide.on, -foot)
                reached.append(guide.on)
            else:
                continue
            self.passed.add(index)
        return reached

    def step(self, chain: Chain, link: str, vector: Point) -> Chain:
        """The chain continued by a vector in the axes of a link."""
        return chain.plus(self.turned.of[link], self.turned.lean[link] * vector)

    def at(self, link: str, point: str) -> Chain:
        """The chain to a point of a link."""
        return self.step(self.origins[link], link, self.bodies[link][point])

    def on_guide(self, index: int) -> Chain:
        """The chain to where a block stands at slide coordinate zero."""
        guide = self.guides[index]
        foot = guide.through + 1j * guide.offset * guide.along
        return self.step(self.origins[guide.on], guide.on, foot)

    def head(self, index: int) -> Point:
        """The point of a block that keeps to guide ``index``, in the block's axes."""
        guide = self.guides[index]
        return self.bodies[guide.block].get(guide.point, 0j)

    def closures(self) -> dict[str, Chain]:
        """The chains that must vanish: pins reached twice, blocks met on their guide again."""
        found: dict[str, Chain] = {}
        holder: dict[str, str] = {}
        for link in self.origins:
            for point in self.bodies[link]:
                if holder.setdefault(point, link) == link:
                    continue
                if not {(point, link), (point, holder[point])} <= self.spent:
                    words = f"pin {point} of links {holder[point]} and {link}"
                    found[words] = self.at(holder[point], point).minus(self.at(link, point))
        for index, guide in enumerate(self.guides):
            if index not in self.passed:
                stand = self.on_guide(index).along(index, 1)
                head = self.step(self.origins[guide.block], guide.block, self.head(index))
                words = f"{guide.word} {guide.number + 1} of link {guide.block} on link {guide.on}"
                found[words] = head.minus(stand)
        return found
