"""True mobility: the freedom that the constraints leave at a position, independent of any count."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from graphkin.loops.assemble import anywhere, completed_start
from graphkin.loops.equations import Equations, equations
from graphkin.loops.newton import start_values
from graphkin.loops.rigid_bodies import Reals
from graphkin.numbers.arithmetic import Point
from graphkin.scene.model import Scene

SHARE = 1e-8
"""Share of the largest singular value below which a direction is unconstrained."""


FIRM = 1e-4
"""Share of the largest singular value below which a direction may be rounding at a dead point."""


def true_mobility(scene: Scene, positions: Mapping[str, Point] | None = None) -> int:
    """Unknowns of the loop equations less the rank of their Jacobian without the drivers.

    ``positions`` (m) must close the mechanism; the loops assemble what they leave open. Without
    positions, closed positions are searched for, independent of the drivers, and the smallest
    mobility counts. At a change point or another singular position the velocities have more freedom
    than the motion, and so has this number. Raises StructureError as ``equations`` does,
    WitnessError where nothing closes.
    """
    loops = equations(scene)
    unknowns = position_of(scene, loops, positions)
    return loops.unknown_count - rank(undriven_rows(loops, unknowns)[0]) - len(scene.cams)


def undriven_rows(loops: Equations, unknowns: Reals) -> Reals:
    """Jacobian of the loop equations without the drivers, in bars, at positions (M, K + m)."""
    jacobian = loops.jacobian(loops.chains.at(unknowns), driven=False)
    return np.asarray(jacobian * loops.columns[:, None, :] / loops.size[:, None, None])


def firmness(rows: Reals) -> tuple[int, float]:
    """The rank, and the smallest singular value counted in it as a share of the largest."""
    values = np.linalg.svd(rows, compute_uv=False)
    count = rank(rows)
    return count, float(values[count - 1] / values[0]) if count else 0.0


def rank(rows: Reals) -> int:
    """The number of directions that the rows constrain."""
    values = np.linalg.svd(rows, compute_uv=False)
    return int(np.count_nonzero(values > SHARE * values.max(initial=0)))


def position_of(scene: Scene, loops: Equations, positions: Mapping[str, Point] | None) -> Reals:
    """The unknowns (1, K + m) at given positions, or at the least mobile of some closed positions.

    Of several such positions, the one farthest from a singular position is taken.
    """
    if positions is None:
        found = anywhere(loops)
        firm = [firmness(rows) for rows in undriven_rows(loops, found)]
        order = [(share > FIRM, count, share) for count, share in firm]
        best = max(range(len(found)), key=order.__getitem__)
        return found[best : best + 1]
    return completed_start(scene, loops, start_values(loops, positions, {}))
