"""Full turns: which of the angles that differ by whole turns is meant, where wheels depend on it.

A driver's angle counts as written and a wheel's as its track leads it there; an angle that only
pins tell is counted from its start, within half a turn. Where wheels tie several of those, that
of the arm, or of the track's link, is counted, else that of the largest wheel, and the wheels lead
the others: no order of links decides, and the wheels that turn faster are found all round.
"""

from __future__ import annotations

import numpy as np

from graphkin.loops.closing_groups import Mask, moved_by, stages
from graphkin.loops.equations import Equations
from graphkin.loops.no_slip import within_half_a_turn
from graphkin.loops.rigid_bodies import Reals

LOOSE = 1e-9
"""Share of a unit direction below which linear equations settle an unknown."""


def settled(loops: Equations, read: Reals, told: Mask) -> tuple[Reals, Mask]:
    """Unknowns read off positions (N, K + m) with their full turns, and which are told now.

    What the linear equations settle is told by them.
    """
    if not loops.slips.counted:
        return read, told
    values, told, known = read.copy(), told.copy(), np.zeros_like(told)
    for group in stages(loops.scene, loops):
        settle(loops, values, told, known, moved_by(loops, group))
    settle(loops, values, told, known, np.ones_like(told))
    return values, told


def settle(loops: Equations, values: Reals, told: Mask, known: Mask, part: Mask) -> None:
    """Settle one group's unknowns, by linear equations first, then as counted from the start."""
    turning = np.arange(len(part)) < loops.turning_count
    within = np.abs(np.nan_to_num(loops.slips.rows[0][:, ~(known | part)])).max(1, initial=0) == 0
    known |= part & told & ~turning & ~unrolled(loops, part)
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
        k = min(np.flatnonzero(ready).tolist(), key=lambda k: precedence(loops, k, within))
        values[:, k] = counted(loops, values, k)
        known[k] = True


def unrolled(loops: Equations, part: Mask) -> Mask:
    """The coordinates along bars of a group that touch a wheel which is known before.

    A wheel is as far on its track as it has come, also one that rolls on a known track and leads a
    bar; a bar touches its wheel where the bar's angle says, and that is counted within half a turn
    as one that only pins tell.
    """
    found, of = np.zeros_like(part), loops.turned.of
    free = {int(k) + 1 for k in np.flatnonzero(part[: loops.turning_count])}
    tracks = [(of[g.block], of[g.on]) for g in loops.guides if not g.turns_alike]
    led = {wheel for wheel, track in tracks if track not in free}
    for j, guide in enumerate(loops.guides):
        wheel, bar = of[guide.block], of[guide.on]
        known = wheel not in free or wheel in led
        found[loops.turning_count + j] = not guide.turns_alike and known and bar in free
    return found


def precedence(loops: Equations, k: int, within: Mask) -> tuple[bool, float]:
    """Which of several angles that wheels tie is counted: an arm's, else the largest wheel's.

    Wheels count that touch ``within`` what is known and the group.
    """
    links, rows = loops.slips.links, loops.slips.rows[0]
    arms = {loops.turned.of[each[-1]] for each, near in zip(links, within, strict=True) if near}
    return k + 1 not in arms, -float(np.abs(rows[within, k]).max(initial=0))


def solved_straight(loops: Equations, values: Reals, free: Mask, known: Mask) -> tuple[Reals, Mask]:
    """The free unknowns by the linear equations alone, and which of them those settle.

    ``values`` hold the known ones, and zero for the free; equations with others are left out.
    """
    scale = np.where(free, loops.columns, 0.0)
    every = np.nan_to_num(loops.linear_rows())
    others = np.abs(every[:, :, ~(known | free)])
    ready = others.max(axis=(0, 2), initial=0) == 0
    waiting = loops.drives.waits[:, ~known].max(axis=1, initial=0) > 0
    ready[len(ready) - len(waiting) :] &= ~waiting
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
    angle = values[:, k]
    start = loops.slips.counted.get(k + 1)
    return angle if start is None else within_half_a_turn(angle, start)


def counted_freely(loops: Equations, values: Reals, moving: Mask) -> Reals:
    """The unknowns with the angles counted that no linear equation ties: only chains hold them."""
    found = values.copy()
    tied = np.abs(np.nan_to_num(loops.linear_rows())).max(axis=(0, 1), initial=0) > 0
    for k in np.flatnonzero(moving & ~tied):
        if k < loops.turning_count:
            found[:, k] = counted(loops, found, int(k))
    return found


def as_meant(loops: Equations, values: Reals, moving: Mask) -> Mask:
    """Where the full turns of a closed group are those that its position means: (N,)."""
    found = values.copy()
    settle(loops, found, np.ones_like(moving), ~moving, moving)
    return np.asarray(np.abs(found - values).max(axis=1, initial=0) < 1)
