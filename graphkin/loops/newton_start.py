"""Where Newton's method starts: angles and coordinates read off given positions of points."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from msgspec import Struct

from graphkin.loops.closing_groups import Mask
from graphkin.loops.equations import Equations, stacked
from graphkin.loops.full_turns import settled
from graphkin.loops.rigid_bodies import Complexes, Reals
from graphkin.scene.model import FRAME

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
    known = {name: numbers.complexes(z) - loops.home for name, z in places.items()}
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
    angles = [np.angle(turn.get(k, numbers.complexes(1))) for k in range(1, loops.turned.count)]
    coordinates = [slide_start(loops, j, known, given, turn) for j in range(len(loops.guides))]
    columns = [*angles, *(numbers.reals(0) if s is None else s for s in coordinates)]
    told = [k in turn and k not in guessed for k in range(1, loops.turned.count)]
    told += [s is not None for s in coordinates]
    unknowns = np.stack(columns, axis=-1) if columns else np.zeros((numbers.count, 0))
    return Start(*settled(loops, unknowns, np.array(told, dtype=np.bool_)))


def driven_coordinate(loops: Equations, j: int) -> Reals | None:
    """The coordinate on guide j that a driver gives, None where none does."""
    column = loops.drives.selects[:, loops.turning_count + j]
    found = np.flatnonzero(column)
    return loops.drives.aim[:, found[0]].real if len(found) else None


def turns_of_bars(
    loops: Equations, known: Places, turn: Mapping[int, Complexes]
) -> dict[int, Complexes]:
    """e^{iθ} of the turnings with a link of which two points are known; the longest bar counts."""
    best: dict[int, tuple[float, Complexes]] = {}
    for link, body in loops.bodies.items():
        turning, lean = loops.turned.of[link], loops.turned.lean[link]
        if turning in turn:
            continue
        names = [name for name in body if name in known]
        places = stacked([loops.numbers.complexes(body[name]) for name in names], loops.numbers)
        for n in range(len(names) - 1):
            bars = places[:, n + 1 :] - places[:, n : n + 1]
            lengths = np.fmax.reduce(abs(bars), axis=0)
            far = int(np.argmax(np.where(np.isnan(lengths), 0.0, lengths)))
            if lengths[far] > best.get(turning, (0.0, bars))[0]:
                way = known[names[n + 1 + far]] - known[names[n]]
                best[turning] = float(lengths[far]), way / (bars[:, far] * lean)
    return {turning: ratio for turning, (_, ratio) in best.items()}


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
    for d, row in enumerate(loops.drives.selects):
        raised = [int(k) + 1 for k in np.flatnonzero(row[: loops.turning_count] > 0)]
        lowered = [int(k) + 1 for k in np.flatnonzero(row[: loops.turning_count] < 0)]
        base = lowered[0] if lowered else 0
        if not loops.drives.turns[d] or not raised or raised[0] in turn:
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
        if base is None or turning not in turn:
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
