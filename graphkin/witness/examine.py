"""Both routes side by side, and the verdict."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from graphkin.loops.assemble import completed
from graphkin.loops.bodies import Reals
from graphkin.loops.equations import Equations, equations
from graphkin.loops.motion import Motion
from graphkin.loops.solve import LoopSolution, closed_from, refuse_undriven
from graphkin.loops.start import Start, start_values
from graphkin.scene.model import FRAME, Scene
from graphkin.steps.solution import Solution, Verdict
from graphkin.witness.branches import LEAST_LIMIT, Flags, branch_conditions
from graphkin.witness.differences import Differences, differing, or_one
from graphkin.witness.part import has_acceleration, links_concerned, scene_of

EPS = 2.0**-52


def compare(scene: Scene, solution: Solution, values: Mapping[str, Any] | None = None) -> Verdict:
    """Hold one solution against the vector loops, starting Newton's method at its positions.

    ``guessed`` in the verdict names the links that no position tells. Raises WitnessError where the
    loops do not close or are singular, StructureError where drivers are missing.
    """
    examined = examine(scene, solution, values)
    difference, quantity = examined.largest(0)
    limit = float(examined.limit[0])
    broken = tuple(name for name, holds in examined.branches.items() if not holds[0])
    report = examined.solved.report
    return Verdict(
        agrees=bool(examined.agrees[0]),
        largest_difference=difference,
        quantity=quantity,
        limit=limit,
        residual=float(report.residual[0]),
        moved=float(report.moved[0]),
        branches=broken,
        guessed=examined.guessed,
    )


def compare_batch(
    scene: Scene, solution: Solution, values: Mapping[str, Any]
) -> tuple[Reals, Flags]:
    """Largest difference of each of N settings, and whether it and the branches agree: (N,), (N,).

    A setting that either route could not solve has NaN and does not agree.
    """
    examined = examine(scene, solution, values)
    return examined.worst, examined.agrees


@dataclass(frozen=True, slots=True, eq=False)
class Examined:
    """Both routes side by side: differences and branch conditions by name, each of shape (N,)."""

    solved: LoopSolution
    differences: Differences
    branches: Mapping[str, Flags]
    limit: Reals
    guessed: tuple[str, ...] = ()

    @property
    def worst(self) -> Reals:
        """The largest difference of each setting; NaN where any is unknown."""
        if not self.differences:
            return np.where(self.solved.report.good, 0.0, np.nan)
        return np.asarray(np.stack(list(self.differences.values())).max(axis=0))

    @property
    def agrees(self) -> Flags:
        """Where every difference is within the limit and every branch as stated."""
        agrees = (self.worst <= self.limit) & np.isfinite(self.limit)
        for holds in self.branches.values():
            agrees = agrees & holds
        return np.asarray(agrees & self.solved.report.good)

    def largest(self, row: int) -> tuple[float, str]:
        """The largest difference of one setting, and the quantity where it was found."""
        found = [(float(each[row]), name) for name, each in self.differences.items()]
        return max(found, key=lambda pair: (np.isnan(pair[0]), pair[0]), default=(0.0, ""))


def examine(scene: Scene, solution: Solution, values: Mapping[str, Any] | None) -> Examined:
    """Solve the loops from the solution's positions and compare all that the solution holds.

    Links and accelerations of which it says nothing are left alone.
    """
    loops = equations(scene, values)
    within = links_concerned(scene, loops, solution)
    if within is not None:
        loops = equations(scene, values, within)
        scene = scene_of(loops)
    refuse_undriven(loops)
    start, guessed = started(scene, loops, solution)
    solved = closed_from(loops, start, accelerations=has_acceleration(solution))
    with np.errstate(all="ignore"):
        extent = breadth(solved.motion)
        margin = np.abs(loops.numbers.reals(solution.margin))
        far = np.abs(solved.motion.points.place).max(axis=1)
        slack = 64 * EPS * (np.maximum(extent, far) / loops.least) / margin**3
        limit = np.maximum(LEAST_LIMIT, slack)
        differences = differing(solved, solution, extent, slack / limit)
        branches = branch_conditions(scene, solved)
    return Examined(solved, differences, branches, limit, guessed)


def started(scene: Scene, loops: Equations, solution: Solution) -> tuple[Reals, tuple[str, ...]]:
    """Where Newton's method starts: at the solution's positions.

    What they do not tell comes from the loops' own assembly, by the branches that the scene
    states; the links and blocks for which that was done are named.
    """
    places = {name: p.position for name, p in solution.points.items() if p.position is not None}
    slides = {name: s.position for name, s in solution.slides.items() if s.position is not None}
    named = {name: place for name, place in places.items() if "@" not in name}
    with np.errstate(all="ignore"):
        start = start_values(loops, named, slides)
    return completed(scene, loops, start), untold(loops, start)


def untold(loops: Equations, start: Start) -> tuple[str, ...]:
    """The links whose angle no position tells, and the blocks whose coordinate none does."""
    turnings = {k + 1 for k in range(loops.turning_count) if not start.told[k]}
    links = [link for link, k in loops.turned.of.items() if k in turnings and link != FRAME]
    blocks = [
        guide.block
        for j, guide in enumerate(loops.guides)
        if not start.told[loops.turning_count + j]
    ]
    return tuple(dict.fromkeys([*links, *blocks]))


def breadth(motion: Motion) -> Reals:
    """Largest distance between two points of the mechanism (m), shape (N,)."""
    places = motion.points.place
    return or_one(np.abs(places[:, :, None] - places[:, None, :]).max(axis=(1, 2)))
