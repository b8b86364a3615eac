"""Full turns: which of the angles that differ by whole turns is meant, where wheels roll.

A driver's angle counts as written and a wheel's as its rolling leads it there; an angle that only
pins tell is counted from its start, within half a turn.
"""

from __future__ import annotations

import numpy as np

from graphkin.loops.bodies import Reals
from graphkin.loops.equations import Equations
from graphkin.loops.groups import Mask, moved_by, stages

ROUND = 1e-9
"""Radians by which rounding may put half a turn on its other side."""
LOOSE = 1e-9
"""Share of a unit direction below which linear equations settle an unknown."""


def settled(loops: Equations, read: Reals, told: Mask) -> tuple[Reals, Mask]:
    """Unknowns read off positions (N, K + m) with their full turns, and which are told now.

    What the linear equations settle is told by them.
    """
    if not loops.slips.links:
        return read, told
    values, told, known = read.copy(), told.copy(), np.zeros_like(told)
    for group in stages(loops.scene, loops):
        settle(loops, values, told, known, moved_by(loops, group))
    settle(loops, values, told, known, np.ones_like(told))
    return values, told


def settle(loops: Equations, values: Reals, told: Mask, known: Mask, part: Mask) -> None:
    """Settle one group's unknowns, by linear equations first, then as counted from the start."""
    turning = np.arange(len(part)) < loops.turning_count
    known |= part & told & ~turning
    while (free := part & ~known).any():
        straight, solved = solved_straight(loops, np.where(free, 0, values), free, known)
        if solved.any():
            full = 2 * np.pi * np.rint((straight - values) / (2 * np.pi))
            led = np.where(told & turning, values + full, straight)
            values[:, solved] = led[:, solved]
            told |= solved
            known |= solved
            continue
        if not (ready := free & told & turning).any():
            known |= free
            return
        k = int(np.flatnonzero(ready)[0])
        values[:, k] = counted(loops, values, k)
        known[k] = True


def solved_straight(loops: Equations, values: Reals, free: Mask, known: Mask) -> tuple[Reals, Mask]:
    """The free unknowns by the linear equations alone, and which of them those settle.

    ``values`` hold the known ones, and zero for the free; equations with others are left out.
    """
    scale = np.where(free, loops.columns, 0.0)
    every = np.nan_to_num(loops.linear_rows())
    others = np.abs(every[:, :, ~(known | free)])
    ready = others.max(axis=(0, 2), initial=0) == 0
    rows = every[:, ready] * scale[:, None, :]
    found = values.copy()
    solved = free & settles(rows[0])
    if solved.any():
        gaps = loops.linear(values)[:, ready, None]
        found = values - (np.linalg.pinv(rows) @ gaps)[:, :, 0] * scale
    return found, solved


def settles(rows: Reals) -> Mask:
    """Which unknowns a set of linear equations (R, U) settles: those that no motion left moves."""
    _, sizes, directions = np.linalg.svd(rows)
    rank = int(np.count_nonzero(sizes > LOOSE * sizes.max(initial=0)))
    left = np.abs(directions[rank:]).max(axis=0, initial=0)
    return np.asarray(left < LOOSE)


def counted(loops: Equations, values: Reals, k: int) -> Reals:
    """The angle of unknown turning k counted from its start, within half a turn: shape (N,)."""
    turn = 2 * np.pi
    angle = values[:, k]
    if k + 1 not in loops.slips.counted:
        return angle
    against, start = loops.slips.counted[k + 1]
    if against:
        start = start + values[:, against - 1]
    beyond = np.ceil((angle - start - np.pi - ROUND) / turn)
    return np.asarray(angle - turn * beyond)


def within_half(loops: Equations, values: Reals, moving: Mask) -> Mask:
    """Where the angles of a group that only pins tell lie within half a turn of their start: (N,).

    A wheel counts as far as it has come along a straight track, which is told by where it stands.
    """
    _, solved = solved_straight(loops, np.where(moving, 0, values), moving, ~moving)
    tracks = [
        loops.turned.of[guide.block]
        for j, guide in enumerate(loops.guides)
        if guide.rolls and moving[loops.turning_count + j]
    ]
    holds = np.ones(len(values), dtype=np.bool_)
    for k in np.flatnonzero(moving & ~solved):
        if k < loops.turning_count and k + 1 not in tracks:
            holds &= np.abs(counted(loops, values, int(k)) - values[:, k]) < 1
    return holds
