"""Constraints written link by link: which velocities of free links each joint forbids.

Every moving link may drift and turn (three velocities, of its origin and its angle); each joint
adds rows that vanish on the velocities it allows. Unlike the chains, no joint is spent on reaching
a link, so that each can be taken away.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from msgspec import Struct

from graphkin.loops.equations import Equations, undriven
from graphkin.loops.loop_motion import Motion
from graphkin.loops.rigid_bodies import Reals
from graphkin.scene.model import FRAME


class Constraint(Struct, frozen=True, eq=False):
    """What a joint forbids: ``rows`` (r, 3·links) of unit size, lengths counted in bars."""

    name: str
    links: tuple[str, ...]
    rows: Reals


class Velocities:
    """Rows on the velocities of free links, at one position."""

    def __init__(self, loops: Equations, unknowns: Reals) -> None:
        still = np.zeros_like(unknowns)
        self.loops, self.motion = loops, Motion.of(undriven(loops), unknowns, still, still)
        self.links = [link for link in loops.links if link != FRAME]
        self.bar = float(loops.size[0])

    def row(self, terms: list[tuple[str, complex, complex, float]]) -> Reals:
        """Sum over terms (link, place, direction, spin) of v(place)·direction + spin·ω·bar."""
        row = np.zeros(3 * len(self.links))
        for link, place, way, spin in terms:
            if link == FRAME:
                continue
            c = 3 * self.links.index(link)
            arm = (place - self.motion.origin.place[0, self.motion.index[link]]) / self.bar
            row[c : c + 2] += way.real, way.imag
            row[c + 2] += (way.conjugate() * 1j * arm).real + spin
        return row

    def together(self, one: str, other: str, place: complex) -> Reals:
        """Two links move alike at a place: a pin, or where wheels touch without slip."""
        return np.array(
            [self.row([(one, place, way, 0.0), (other, place, -way, 0.0)]) for way in (1 + 0j, 1j)]
        )

    def pins(self) -> list[Constraint]:
        """Each two links at a pin; a pin of k links ties k - 1 pairs."""
        found = []
        for point in self.loops.points:
            owners = [link for link in self.loops.links if point in self.loops.bodies[link]]
            for one, other in pairwise(owners):
                place = complex(self.motion.point(point).place[0])
                rows = self.together(one, other, place)
                found.append(Constraint(f"pin {point} of {one} and {other}", (one, other), rows))
        return found

    def guides(self) -> list[Constraint]:
        """Slides, which keep a block on its line and at its angle, and straight tracks."""
        found = []
        for guide in self.loops.guides:
            on, block = guide.on, guide.block
            along = complex(self.motion.heading[0, self.motion.index[on]]) * complex(guide.along)
            place = self.head(block, guide.point)
            if guide.turns_alike:
                level = self.row([(block, place, 1j * along, 0.0), (on, place, -1j * along, 0.0)])
                turn = self.row([(block, place, 0j, 1.0), (on, place, 0j, -1.0)])
                rows, name = np.array([level, turn]), f"slide of {block} on {on}"
            else:
                touch = place - 1j * along * float(guide.offset)
                rows, name = self.together(block, on, touch), f"track of {block} on {on}"
            found.append(Constraint(name, (block, on), rows))
        return found

    def head(self, block: str, point: str) -> complex:
        """Where the point of a block stands that keeps to a guide."""
        if point:
            return complex(self.motion.point(point).place[0])
        return complex(self.motion.origin.place[0, self.motion.index[block]])

    def wheels(self) -> list[Constraint]:
        """Wheels on one another: no slip where they touch; their arm keeps the distance."""
        found = []
        for gear in self.loops.gears:
            wheel, on = gear.links
            centre, other = (self.head("", each.centre) for each in gear.wheels)
            own, its = (float(each) for each in gear.radii)
            away = (centre - other) / (its + gear.sense * own)
            touch = other + its * away
            rows = self.together(wheel, on, touch)
            across = rows[:1] * (1j * away).real + rows[1:] * (1j * away).imag
            found.append(Constraint(f"wheel of {wheel} on {on}", (wheel, on), across))
        return found

    def every(self) -> list[Constraint]:
        """All joints; drivers are none."""
        return [*self.pins(), *self.guides(), *self.wheels()]


def constraints(loops: Equations, unknowns: Reals) -> tuple[int, list[Constraint]]:
    """Velocities of free links (3 each), and what each joint forbids, at one closed position."""
    velocities = Velocities(loops, unknowns)
    return 3 * len(velocities.links), velocities.every()
