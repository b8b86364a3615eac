"""Both routes side by side, and the verdict."""

from __future__ import annotations

from collections.abc import Mapping
from math import isnan
from typing import Any

import numpy as np
from msgspec import Struct

from graphkin.construction.core.solution import Solution, Verdict
from graphkin.loops.assemble import completed
from graphkin.loops.cam_laws import by_law, without_linkages
from graphkin.loops.equations import Equations, equations
from graphkin.loops.loop_motion import Motion
from graphkin.loops.newton import LoopSolution, closed_from, refuse_undriven
from graphkin.loops.newton_start import Start, start_values
from graphkin.loops.rigid_bodies import Reals
from graphkin.loops.witness.branch_conditions import Flags, branch_conditions
from graphkin.loops.witness.coverage import has_acceleration, links_concerned, scene_of
from graphkin.loops.witness.differences import (
    LEAST_LIMIT,
    Differences,
    differing,
    digits_of,
    or_one,
)
from graphkin.scene.model import FRAME, Scene


def compare(
    scene: Scene,
    solution: Solution,
    values: Mapping[str, Any] | None = None,
    *,
    numbered: bool = True,
) -> Verdict:
    """Hold one solution against the vector loops, starting Newton's method at its positions.

    ``guessed`` in the verdict names the links that no position tells; without ``numbered`` it says
    nothing of branches for which all closures would have to be counted. Raises WitnessError where
    the loops do not close or are singular, StructureError where drivers are missing.
    """
    examined = examine(scene, solution, values, numbered=numbered)
    difference, quantity, limit = examined.told(0)
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
        digits=digits_of(examined.differences),
        unsure=tuple(examined.unsure),
    )


class Examined(Struct, frozen=True, eq=False):
    """Both routes side by side: differences and branch conditions by name, each of shape (N,)."""

    solved: LoopSolution
    differences: Differences
    branches: Mapping[str, Flags]
    guessed: tuple[str, ...] = ()

    @property
    def unsure(self) -> dict[str, Flags]:
        """The quantities of which no digit is sure in some setting, and in which: (N,) each."""
        lost = ~self.differences.judged
        somewhere = np.flatnonzero(lost.any(axis=1))
        return {self.differences.names[q]: lost[q] for q in somewhere}

    @property
    def worst(self) -> Reals:
        """The largest difference of each setting in what is sure; NaN where any is unknown."""
        each = self.differences
        known = np.where(self.solved.report.good, 0.0, np.nan)
        worst = np.where(each.judged, each.found, 0.0).max(axis=0, initial=0.0)
        return np.asarray(np.maximum(known, worst))

    @property
    def agrees(self) -> Flags:
        """Where every difference is within its limit and every branch as stated."""
        each = self.differences
        agrees = self.solved.report.good
        agrees = agrees & ((each.found <= each.limit) | ~each.judged).all(axis=0)
        for holds in self.branches.values():
            agrees = agrees & holds
        return np.asarray(agrees)

    def told(self, row: int) -> tuple[float, str, float]:
        """The largest difference of one setting, where it was found, and the largest limit.

        Where some difference is beyond its limit: the one that is so the farthest, and its own.
        """
        every = self.differences
        found, limit = every.found[:, row].tolist(), every.limit[:, row].tolist()
        known = np.flatnonzero(every.judged[:, row]).tolist()
        beyond = [q for q in known if not found[q] <= limit[q]]

        def farthest(q: int) -> tuple[bool, float]:
            return isnan(found[q]), found[q] / limit[q] if beyond else found[q]

        if not known:
            return 0.0, "", LEAST_LIMIT
        worst = max(beyond or known, key=farthest)
        most = max(limit[q] for q in (beyond and [worst]) or known)
        return found[worst], every.names[worst], most


def examine(
    scene: Scene,
    solution: Solution,
    values: Mapping[str, Any] | None,
    *,
    numbered: bool = True,
) -> Examined:
    """Solve the loops from the solution's positions and compare all that the solution holds.

    Links and accelerations of which it says nothing are left alone.
    """
    solution, scene = without_linkages(scene, solution), by_law(scene)
    loops = equations(scene, values)
    within = links_concerned(scene, loops, solution)
    if within is not None:
        loops = equations(scene, values, within)
        scene = scene_of(loops)
    refuse_undriven(loops)
    start, guessed = started(scene, loops, solution)
    solved = closed_from(loops, start, accelerations=has_acceleration(solution), singular=True)
    with np.errstate(all="ignore"):
        differences = differing(solved, solution, breadth(solved.motion))
        branches = branch_conditions(scene, solved, numbered=numbered)
    return Examined(solved, differences, branches, guessed)


def started(scene: Scene, loops: Equations, solution: Solution) -> tuple[Reals, tuple[str, ...]]:
    """Where Newton's method starts: at the solution's positions.

    What they do not tell comes from the loops' own assembly, by the branches that the scene
    states; the links and blocks for which that was done are named.
    """
    solution, scene = without_linkages(scene, solution), by_law(scene)
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
