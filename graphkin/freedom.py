"""True mobility: the freedom that the constraints leave at a position, whatever a count says."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from graphkin.arithmetic import Point
from graphkin.loops.equations import equations
from graphkin.loops.start import start_values
from graphkin.scene.model import Scene

IDLE = 1e-8
"""Share of the largest singular value below which a direction is not constrained."""


def true_mobility(scene: Scene, positions: Mapping[str, Point]) -> int:
    """Unknowns of the loop equations less the rank of their Jacobian without the drivers.

    ``positions`` (m) must close the mechanism. At a change point or another singular position the
    velocities are freer than the motion, and so is this number. Raises StructureError as
    ``equations`` does.
    """
    loops = equations(scene)
    unknowns = start_values(loops, positions, {})
    linear = loops.chains.at(unknowns)
    lengths = loops.columns[:, None, :] / loops.size[:, None, None]
    jacobian = (loops.jacobian(linear, driven=False) * lengths)[0]
    values = np.linalg.svd(jacobian, compute_uv=False)
    rank = int(np.count_nonzero(values > IDLE * values.max(initial=0)))
    return loops.unknown_count - rank
