"""Which of the sides, ways and closures that a scene states hold in the position found."""

from __future__ import annotations

from typing import Any

import numpy as np

from graphkin.loops.assemble import LEVEL, led_by
from graphkin.loops.branch_closures import closure_numbers, closures, other_closure, turned_side
from graphkin.loops.closing_groups import Group, groups, speaks_of
from graphkin.loops.equations import equations
from graphkin.loops.newton import LoopSolution
from graphkin.loops.poses import pose_of, setting_of, unknowns_of
from graphkin.loops.rigid_bodies import Reals
from graphkin.scene.model import Closure, Scene, Side, Way

NUMBERED = 12
"""Settings of a batch, evenly spread, whose closures are numbered; it takes long."""

Flags = np.ndarray[Any, np.dtype[np.bool_]]


def branch_conditions(
    scene: Scene, solved: LoopSolution, *, numbered: bool = True
) -> dict[str, Flags]:
    """Whether each statement of [branches] holds: arrays of shape (N,).

    Numbers of closures, and ways of groups other than dyads, are verified on at most ``NUMBERED``
    settings of a batch, evenly spread; not at all without ``numbered``.
    """
    found: dict[str, Flags] = {}
    stated = scene.branches.items()
    sides_only = all(isinstance(branch, Side) for _, branch in stated)
    known = [] if sides_only else groups(scene, solved.loops)
    motion = solved.motion
    for name, branch in stated:
        if isinstance(branch, Side):
            side = turned_side(motion, branch.first, branch.second, name)
            found[name] = np.asarray(branch.side * side > -side_slack(solved, name, branch))
            continue
        for group in (each for each in known if speaks_of(name, branch, each, solved.loops)):
            if isinstance(branch, Way) and group.is_dyad:
                holds = way_of_dyad(branch, solved, group)
            elif not numbered:
                continue
            else:
                holds = picked_rows(scene, branch, solved, group, name)
            found[name] = found.get(name, True) & holds
    return found


def side_slack(solved: LoopSolution, name: str, branch: Side) -> Reals:
    """How far rounding may put a pin on the other side of the way between two others, as a sine."""
    start, end, place = (
        solved.motion.point(each).place for each in (branch.first, branch.second, name)
    )
    errors = sum(solved.rounding.point(each).place for each in (branch.first, branch.second, name))
    return LEVEL + errors / np.minimum(abs(end - start), abs(place - start))


def way_of_dyad(branch: Way, solved: LoopSolution, group: Group) -> Flags:
    """Whether the slide of a dyad stands the stated way; with two slides there is one closure."""
    loops = solved.loops
    if len(group.slides) != 1:
        return np.ones(loops.numbers.count, dtype=np.bool_)
    stands, other = other_closure(loops, solved.motion, group)
    error = solved.rounding.slide(group.slides[0].slide).position
    return np.asarray(branch.way * (stands - other) > -LEVEL * loops.size - 4 * error)


def picked_rows(
    scene: Scene, branch: Way | Closure, solved: LoopSolution, group: Group, name: str
) -> Flags:
    """Whether a group stands as stated, by looking for all its closures."""
    count = solved.loops.numbers.count
    holds = np.ones(count, dtype=np.bool_)
    settings = np.flatnonzero(solved.report.good)
    spread = np.linspace(0, max(len(settings) - 1, 0), min(len(settings), NUMBERED))
    for n in settings[np.unique(spread.astype(int))]:
        if isinstance(branch, Closure):
            row = solved.unknowns[n]
            numbers = closure_numbers(scene, solved.loops, group, row, int(n))
            holds[n] = branch.number in numbers
        else:
            holds[n] = farthest(scene, branch, solved, group, name, int(n))
    return holds


def farthest(
    scene: Scene, branch: Way, solved: LoopSolution, group: Group, name: str, n: int
) -> bool:
    """Whether the coordinate of a group is the largest (or least) of all its closures."""
    loops = solved.loops
    part = equations(scene, setting_of(loops, n), group.known | set(group.links))
    stands = unknowns_of(part, pose_of(loops, solved.unknowns[n], n))
    j = led_by(name, group, loops, part)
    if j is None:
        return True
    column = part.turning_count + j
    every = closures(part, stands, group)[:, column]
    end = every.max(initial=-np.inf) if branch.way > 0 else every.min(initial=np.inf)
    return bool(abs(stands[0, column] - end) <= 1e-6 * part.size[0])
