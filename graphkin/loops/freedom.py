"""True mobility: the freedom that the constraints leave at a position, whatever a count says."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from graphkin.loops.assemble import anywhere, completed
from graphkin.loops.constraints import Constraint, constraints
from graphkin.loops.equations import Equations, equations
from graphkin.loops.newton_start import start_values
from graphkin.loops.rigid_bodies import Reals
from graphkin.numbers.arithmetic import Point
from graphkin.scene.model import FRAME, Scene

SHARE = 1e-8
"""Share of the largest singular value below which a direction is not constrained."""


FIRM = 1e-4
"""Share of the largest singular value below which a direction may be rounding near a dead point."""


class Idle(NamedTuple):
    """What could be taken away without setting anything free.

    ``joints`` gives, by name, how many of a joint's constraints the others make too; of several
    such joints one may be relieved, not all at once. ``links`` may each be taken away alone.
    """

    joints: Mapping[str, int]
    links: tuple[str, ...]


def true_mobility(scene: Scene, positions: Mapping[str, Point] | None = None) -> int:
    """Unknowns of the loop equations less the rank of their Jacobian without the drivers.

    ``positions`` (m) must close the mechanism; what they leave open is assembled by the loops.
    Without any, closed positions are looked for, whatever the drivers, and the least free counts.
    At a change point or another singular position the velocities are freer than the motion, and so
    is this number. Raises StructureError as ``equations`` does, WitnessError where nothing closes.
    """
    loops = equations(scene)
    unknowns = position_of(scene, loops, positions)
    return loops.unknown_count - rank(undriven_rows(loops, unknowns)[0]) - len(scene.cams)


def undriven_rows(loops: Equations, unknowns: Reals) -> Reals:
    """Jacobian of the loop equations without the drivers, in bars, at positions (M, K + m)."""
    jacobian = loops.jacobian(loops.chains.at(unknowns), driven=False)
    return np.asarray(jacobian * loops.columns[:, None, :] / loops.size[:, None, None])


def firmness(rows: Reals) -> tuple[int, float]:
    """The rank, and the least singular value that it counts, over the largest."""
    values = np.linalg.svd(rows, compute_uv=False)
    count = rank(rows)
    return count, float(values[count - 1] / values[0]) if count else 0.0


def idle(scene: Scene, positions: Mapping[str, Point] | None = None) -> Idle:
    """Which joints hold what others hold already, and which links could go; positions as above.

    A joint is idle by as many of its rows as the rank does not miss; a link where the mobility
    stays the same without it and its joints.
    """
    loops = equations(scene)
    free, joints = constraints(loops, position_of(scene, loops, positions))
    whole = stacked_rank(joints, free)
    spare: dict[str, int] = {}
    for left in joints:
        others = [joint for joint in joints if joint is not left]
        count = len(left.rows) - (whole - stacked_rank(others, free))
        if count > 0:
            spare[left.name] = count
    links = [link for link in scene.links if link != FRAME]
    same = [link for link in links if without(link, joints, free) == free - whole]
    return Idle(spare, tuple(same) if spare else ())


def without(link: str, joints: Sequence[Constraint], free: int) -> int:
    """The mobility when a link and its joints are taken away."""
    left = [joint for joint in joints if link not in joint.links]
    return free - 3 - stacked_rank(left, free)


def stacked_rank(joints: Sequence[Constraint], free: int) -> int:
    """The rank of all rows of some joints."""
    return rank(np.concatenate([np.zeros((1, free)), *(joint.rows for joint in joints)]))


def rank(rows: Reals) -> int:
    """How many directions rows constrain."""
    values = np.linalg.svd(rows, compute_uv=False)
    return int(np.count_nonzero(values > SHARE * values.max(initial=0)))


def position_of(scene: Scene, loops: Equations, positions: Mapping[str, Point] | None) -> Reals:
    """The unknowns (1, K + m) at given positions, or at the least free of some closed ones.

    Of several such positions the one farthest from a singular one is taken.
    """
    if positions is None:
        found = anywhere(loops)
        firm = [firmness(rows) for rows in undriven_rows(loops, found)]
        order = [(share > FIRM, count, share) for count, share in firm]
        best = max(range(len(found)), key=order.__getitem__)
        return found[best : best + 1]
    return completed(scene, loops, start_values(loops, positions, {}))
