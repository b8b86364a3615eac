"""Where Newton's method starts: angles and coordinates read off given positions of points.

Of angles that differ by full turns it is told which is meant, where wheels depend on it.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from msgspec import Struct

from graphkin.loops.closing_groups import Mask, moved_by, stages
from graphkin.loops.equations import Equations
from graphkin.loops.no_slip import within_half_a_turn
from graphkin.loops.rigid_bodies import Complexes, Reals
from graphkin.scene.model import FRAME

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

    A wheel is as far on its track as it has come, also one on a known track that leads a
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
    every = np.nan_to_num(loops.linear_rows)
    others = np.abs(every[:, :, ~(known | free)])
    ready = others.max(axis=(0, 2), initial=0) == 0
    waits = np.concatenate([loops.slips.waits, loops.drives.waits])
    ready &= waits[:, ~known].max(axis=1, initial=0) == 0
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
    tied = np.abs(np.nan_to_num(loops.linear_rows)).max(axis=(0, 1), initial=0) > 0
    for k in np.flatnonzero(moving & ~tied):
        if k < loops.turning_count:
            found[:, k] = counted(loops, found, int(k))
    return found


def as_meant(loops: Equations, values: Reals, moving: Mask) -> Mask:
    """Where the full turns of a closed group are those that its position means: (N,)."""
    found = values.copy()
    settle(loops, found, np.ones_like(moving), ~moving, moving)
    return np.asarray(np.abs(found - values).max(axis=1, initial=0) < 1)


Places = Mapping[str, Complexes]


class Start(Struct, frozen=True, eq=False):
    """Unknowns (N, K + m) to start from; ``told`` are those that the positions tell (K + m,)."""

    unknowns: Reals
    told: Mask


def start_values(
    loops: Equations, places: Mapping[str, object], slides: Mapping[str, object]
) -> Start:
    """Unknowns from positions of points (m) and slide coordinates by block (m).

    An angle comes from the longest known bar of its turning, else from a block known on its guide,
    else from a driver; then further points of its links are known. Where wheels depend on it, full
    turns are counted as the scene means them. What no position tells is zero.
    """
    numbers = loops.numbers
    read = numbers.columns(list(places.values())) - loops.home[:, None]
    known = {name: read[:, n] for n, name in enumerate(places)}
    frame = {name: numbers.complexes(z) for name, z in loops.bodies[FRAME].items()}
    known = {**known, **frame}
    given = {name: numbers.reals(s) for name, s in slides.items()}
    turn: dict[int, Complexes] = {0: numbers.complexes(1)}
    guessed: set[int] = set()
    while len(turn) < loops.turned.count:
        seen = len(turn), len(known)
        turn |= turns_of_bars(loops, known, turn)
        turn |= turns_of_drivers(loops, turn)
        turn |= turns_of_blocks(loops, known, given, turn, guessed)
        known = {**points_on_links(loops, known, turn), **known}
        if seen == (len(turn), len(known)):
            break
    turns = numbers.columns([turn.get(k, 1.0) for k in range(1, loops.turned.count)])
    coordinates = [slide_start(loops, j, known, given, turn) for j in range(len(loops.guides))]
    slid = numbers.columns([0.0 if s is None else s for s in coordinates], float)
    told = [k in turn and k not in guessed for k in range(1, loops.turned.count)]
    told += [s is not None for s in coordinates]
    unknowns = np.concatenate([np.angle(turns), slid], axis=1)
    return Start(*settled(loops, unknowns, np.array(told, dtype=np.bool_)))


def driven_coordinate(loops: Equations, j: int) -> Reals | None:
    """The coordinate on guide j that a driver gives, None where none does."""
    column = loops.drives.selects[:, loops.turning_count + j]
    lifted = [lift.row for lift in loops.drives.lifts]
    found = [d for d in np.flatnonzero(column) if d not in lifted]
    return loops.drives.aim[:, found[0]].real if found else None


def turns_of_bars(
    loops: Equations, known: Places, turn: Mapping[int, Complexes]
) -> dict[int, Complexes]:
    """e^{iθ} of the turnings with a link of which two points are known; the longest bar counts."""
    bars = {k: bar for k, bar in loops.longest_bars.items() if k not in turn}
    if not known.keys() >= {end for first, second, _ in bars.values() for end in (first, second)}:
        bars = {k: bar for k, bar in loops.bars_among(known).items() if k not in turn}
    return {k: (known[second] - known[first]) / way for k, (first, second, way) in bars.items()}


def turns_of_blocks(
    loops: Equations,
    known: Places,
    given: Mapping[str, Reals],
    turn: Mapping[int, Complexes],
    guessed: set[int],
) -> dict[int, Complexes]:
    """e^{iθ} of a guide from a point of its link and the block on it, both known.

    Without a given slide coordinate the block is taken on the positive side, and the turning is
    added to ``guessed``.
    """
    found: dict[int, Complexes] = {}
    for guide in loops.guides:
        turning, body = loops.turned.of[guide.on], loops.bodies[guide.on]
        base = next((name for name in body if name in known), None)
        if turning in turn or turning in found or base is None or guide.point not in known:
            continue
        bar = known[guide.point] - known[base]
        foot = guide.through - body[base] + 1j * guide.offset * guide.along
        level = foot * np.conj(guide.along)
        if guide.first and guide.block in given:
            reach = given[guide.block]
        else:
            reach = np.sqrt(np.maximum(abs(bar) ** 2 - np.imag(level) ** 2, 0)) - np.real(level)
        arm = (foot + reach * guide.along) * loops.turned.lean[guide.on]
        if np.all(abs(arm) > 0):
            found[turning] = bar / arm
            if not (guide.first and guide.block in given):
                guessed.add(turning)
    return found


def turns_of_drivers(loops: Equations, turn: Mapping[int, Complexes]) -> dict[int, Complexes]:
    """e^{iθ} of a turning that a driver turns against a known one."""
    found: dict[int, Complexes] = {}
    lifted = [lift.row for lift in loops.drives.lifts]
    for d, row in enumerate(loops.drives.selects):
        raised = [int(k) + 1 for k in np.flatnonzero(row[: loops.turning_count] > 0)]
        lowered = [int(k) + 1 for k in np.flatnonzero(row[: loops.turning_count] < 0)]
        base = lowered[0] if lowered else 0
        if d in lifted or not loops.drives.turns[d] or not raised or raised[0] in turn:
            continue
        if base in turn or base in found:
            against = turn[base] if base in turn else found[base]
            found[raised[0]] = against * loops.drives.aim[:, d] / loops.drives.lean[:, d]
    return found


def points_on_links(
    loops: Equations, known: Places, turn: Mapping[int, Complexes]
) -> dict[str, Complexes]:
    """Every point of a link whose angle and one of whose points are known."""
    found: dict[str, Complexes] = {}
    for link, body in loops.bodies.items():
        base = next((name for name in body if name in known), None)
        turning = loops.turned.of[link]
        if base is None or turning not in turn or body.keys() <= known.keys():
            continue
        heading = turn[turning] / abs(turn[turning]) * loops.turned.lean[link]
        for name, arm in body.items():
            found[name] = known[base] + heading * (arm - body[base])
    return found


def slide_start(
    loops: Equations,
    j: int,
    known: Places,
    given: Mapping[str, Reals],
    turn: Mapping[int, Complexes],
) -> Reals | None:
    """Coordinate on a guide: the way from its zero, measured along it; None where nothing tells."""
    guide = loops.guides[j]
    body = loops.bodies[guide.on]
    base = next((name for name in body if name in known), None)
    turning = loops.turned.of[guide.on]
    if guide.first and guide.block in given:
        return given[guide.block]
    if guide.point not in known or turning not in turn or (base is None and guide.on != FRAME):
        return driven_coordinate(loops, j)
    heading = turn[turning] / abs(turn[turning]) * loops.turned.lean[guide.on]
    origin = known[base] - heading * body[base] if base is not None else 0
    way = known[guide.point] - origin - heading * guide.through
    return np.asarray((way / (heading * guide.along)).real)
