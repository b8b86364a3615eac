"""Where a dyad of a trial is stretched flat: at the end of a window its two signs meet.

Beside the end the misfit is c ± k·√τ, τ the distance to it and ± the sign of the dyad: one curve,
smooth in v = ±√τ, which runs on one sign up to the end and on the other back from it.
"""

from __future__ import annotations

from collections.abc import Callable

from graphkin.numbers.roots import CLOSE, NEXT, Array, roots_and_touches

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


def fits_beside(
    misfit: Callable[[Array, Array, Array], Array], at: Array, beside: Array
) -> tuple[Array, Array, Array, Array]:
    """Every fit near n ends of windows: which end, place, sign, and whether it only may be one.

    ``misfit`` gives the values of which functions (K,), at which places and signs (K,). ``at`` has
    where each ends (n,), in radians or shares of a way, ``beside`` the window's place next to it.
    """
    import numpy as np

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
    import numpy as np

    size = abs(value)
    turned = (size[:, 1:-1] <= size[:, :-2]) & (size[:, 1:-1] <= size[:, 2:])
    return (np.sign(value[:, 1:]) != np.sign(value[:, :-1])).any(axis=1) | turned.any(axis=1)
