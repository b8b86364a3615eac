"""Windows in which functions of one number are defined: their ends, and roots beside these.

Where something only just can be drawn a misfit grows like a root, and a window may be narrower than
any grid. How far it can be is a smooth function on both sides of the end, so the ends are found by
it. Where two signs meet there the misfit is c ± k·√τ, τ the distance to the end: one curve, smooth
in v = ±√τ, which runs on one sign up to the end and on the other back from it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from graphkin.numbers.arrays import np
from graphkin.numbers.roots import CLOSE, NEXT, Array, Misfit, roots, roots_and_touches

BESIDE = 0.5
"""How far from the end of a window its first place lies, in steps of the places before easing."""
STRAIGHT = 8.0
"""How many times rounding moves what is close enough to a root: nearer the end the curve counts as
straight, as rounding hides it there."""
WHOLE = 0.9
"""Most of the way to the place next to an end that counts as straight."""
OPENS = 1.5
"""How many times more the signs differ twice as far from the end, at least; 2 where they meet."""
ROUNDS = 40
"""Most doublings of the distance at which doubles can draw a dyad that is stretched nearly flat."""
NOISY = 10
"""Places, from a quarter of that distance on, at which they can: rounding lets one of them pass."""
LEAST = 16.0
"""That distance at least, in parts of how far two neighbouring numbers about one lie apart."""


class Windows(NamedTuple):
    """Whose each window is (W,), and its places from end to end (W, M)."""

    owner: Array
    places: Array


class Ends(NamedTuple):
    """Whose each end of a window is (E,), where it lies (E,), and the window's place next to it."""

    owner: Array
    at: Array
    beside: Array


def narrowed(reaches: Misfit, windows: Windows) -> tuple[Windows, Ends]:
    """The parts of windows in which a smooth function is positive, and their ends where it is zero.

    Places lead up to such an end, not into it.
    """
    owner, places = windows
    size, count = places.shape
    which, at = roots(lambda row, place: reaches(owner[row], place), places)
    rows = np.concatenate([np.repeat(np.arange(size), 2), which])
    marks = np.concatenate([places[:, [0, -1]].ravel(), at])
    order = np.lexsort((marks, rows))
    rows, marks = rows[order], marks[order]
    same = (rows[1:] == rows[:-1]) & (marks[1:] > marks[:-1])
    row, low, high = rows[:-1][same], marks[:-1][same], marks[1:][same]
    good = reaches(owner[row], (low + high) / 2) > 0
    row, low, high = row[good], low[good], high[good]
    begins, ends = low != places[row, 0], high != places[row, -1]
    eased = low[:, None] + (high - low)[:, None] * ease(np.arange(count) / (count - 1))
    short = (high - low) * ease(BESIDE / (count - 1))
    eased[:, 0] = np.where(begins, low + short, low)
    eased[:, -1] = np.where(ends, high - short, high)
    found = np.where((begins | ends)[:, None], eased, places[row])
    sides = ((begins, low, found[:, 0]), (ends, high, found[:, -1]))
    columns = [[owner[row[cut]], end[cut], beside[cut]] for cut, end, beside in sides]
    return Windows(owner[row], found), Ends(*map(np.concatenate, zip(*columns, strict=True)))


def ease(share: Any) -> Any:
    """Shares from 0 to 1, closer together near both ends: there a root grows steeply."""
    return (1 - np.cos(np.pi * share)) / 2


# --- beside a flat end ---------------------------------------------------------------------------


def fits_beside(
    misfit: Callable[[Array, Array, Array], Array], at: Array, beside: Array
) -> tuple[Array, Array, Array, Array]:
    """Every fit near n ends of windows: which end, place, sign, and whether it only may be one.

    ``misfit`` gives the values of which functions (K,), at which places and signs (K,). ``at`` has
    where each ends (n,), in radians or shares of a way, ``beside`` the window's place next to it.
    """
    way = beside - at
    grain = NEXT * np.maximum(abs(at), 1) / np.maximum(abs(way), NEXT)
    straight = np.minimum(STRAIGHT * grain / CLOSE, WHOLE)

    def drawn(which: Array, v: Array) -> Array:
        return misfit(which, at[which] + way[which] * v**2, np.where(v < 0, -1.0, 1.0))

    one = np.ones(at.size)
    grid = np.stack([-2 * one, -one, -straight, straight, one, 2 * one], axis=1)
    value = drawn(np.repeat(np.arange(at.size), 6), grid.ravel()).reshape(grid.shape)
    apart = value[:, ::-1] - value
    middle, slope = (value[:, 2] + value[:, 3]) / 2, apart[:, 2] / (2 * straight)
    slope[~(abs(apart[:, 0]) > OPENS * abs(apart[:, 1]))] = np.nan
    if not (near := np.flatnonzero(may_vanish(value))).size:
        return near, at[near], at[near], near > 0

    def curve(row: Array, v: Array) -> Array:
        which = near[row]
        bent = np.maximum(abs(v), straight[which]) * np.where(v < 0, -1.0, 1.0)
        return np.where(bent == v, drawn(which, bent), middle[which] + slope[which] * v)

    row, v, touching = roots_and_touches(curve, grid[near])
    which, sign = near[row], np.where(v < 0, -1.0, 1.0)
    away = np.maximum(v**2, LEAST * grain[which])
    lost = np.arange(which.size)
    for _ in range(ROUNDS):
        tried = np.repeat(which[lost], NOISY)
        steps = np.outer(away[lost], np.linspace(0.25, 1, NOISY)).ravel()
        value = misfit(tried, at[tried] + way[tried] * steps, np.repeat(sign[lost], NOISY))
        lost = lost[~np.isfinite(value).reshape(-1, NOISY).all(axis=1)]
        if not lost.size:
            break
        away[lost] *= 2
    return which, at[which] + way[which] * away, sign, touching


def may_vanish(value: Array) -> Array:
    """Of which rows of values some change their sign, or turn back towards zero."""
    size = abs(value)
    turned = (size[:, 1:-1] <= size[:, :-2]) & (size[:, 1:-1] <= size[:, 2:])
    return (np.sign(value[:, 1:]) != np.sign(value[:, :-1])).any(axis=1) | turned.any(axis=1)
