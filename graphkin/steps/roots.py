"""Where functions of one number vanish, many at once: brackets on a grid, then closing in.

``Misfit`` gives the values of many functions at one place each: which functions (K,), where (K,),
as arrays of equal length; NaN where a function is not defined.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

Array = Any
Misfit = Callable[[Array, Array], Array]

ROUNDS = 60
"""Most rounds of closing in; halving alone needs 53 for all digits of a double."""
CLOSE = 1e-6
"""Misfit left at a root, in parts of its interval's: rounding leaves far less, a pole more."""
GROWN = 4.0
"""How many times the misfit of an interval may grow within it before it counts as a pole."""
SURE = 8
"""Rounds after which a misfit that has grown is taken for a pole."""
GOLDEN = 0.3819660112501051
"""The smaller part of a way divided in the golden ratio."""


def roots(misfit: Misfit, grid: Array) -> tuple[Array, Array]:
    """Every root of n functions, each on its own grid of places (n, M): (function, place) of each.

    Between neighbours of the grid a change of sign is a root, unless it is a pole. Where the
    misfit turns back towards nought its least value is looked for, and where a function breaks off
    the very end of it, so that two roots close together are found there too.
    """
    import numpy as np

    size, places = grid.shape
    owner = np.repeat(np.arange(size), places)
    value = misfit(owner, grid.ravel()).reshape(grid.shape)
    left, right = value[:, :-1], value[:, 1:]
    element, at = np.nonzero((left * right < 0) | (left == 0))
    found = [(element, grid[element, at], grid[element, at + 1])]
    found += beside_breaks(misfit, grid, value)
    found += beside_turns(misfit, grid, value)
    which, low, high = (np.concatenate(parts) for parts in zip(*found, strict=True))
    place = closed_in(misfit, which, low, high)
    good = np.isfinite(place)
    return which[good], place[good]


def beside_breaks(misfit: Misfit, grid: Array, value: Array) -> list[tuple[Array, Array, Array]]:
    """Intervals with a root between the last place of a grid and where the function breaks off."""
    import numpy as np

    there = np.isfinite(value)
    element, at = np.nonzero(there[:, :-1] != there[:, 1:])
    first = there[element, at]
    inside = np.where(first, grid[element, at], grid[element, at + 1])
    outside = np.where(first, grid[element, at + 1], grid[element, at])
    start, end = inside, outside
    for _ in range(ROUNDS):
        middle = (start + end) / 2
        good = np.isfinite(misfit(element, middle))
        start, end = np.where(good, middle, start), np.where(good, end, middle)
        if not (abs(end - start) > 4e-16 * np.maximum(abs(start), abs(end))).any():
            break
    crossed = misfit(element, inside) * misfit(element, start) < 0
    low, high = np.minimum(inside, start), np.maximum(inside, start)
    return [(element[crossed], low[crossed], high[crossed])]


def beside_turns(misfit: Misfit, grid: Array, value: Array) -> list[tuple[Array, Array, Array]]:
    """Intervals with two roots where a function comes near nought between three places of a grid.

    Golden section towards the least misfit, until it crosses nought or has been found.
    """
    import numpy as np

    size = abs(value)
    here, near = size[:, 1:-1], np.sign(value[:, 1:-1])
    turns = (here <= size[:, :-2]) & (here <= size[:, 2:])
    turns &= (near == np.sign(value[:, :-2])) & (near == np.sign(value[:, 2:]))
    element, at = np.nonzero(turns)
    low, best, high = (grid[element, at + k] for k in (0, 1, 2))
    sign, least = near[element, at], here[element, at]
    ends = low, high
    for _ in range(ROUNDS):
        longer = high - best > best - low
        trial = np.where(longer, best + GOLDEN * (high - best), best - GOLDEN * (best - low))
        found = sign * misfit(element, trial)
        better = found < least
        low = np.where(better & longer, best, np.where(~better & ~longer, trial, low))
        high = np.where(better & ~longer, best, np.where(~better & longer, trial, high))
        best, least = np.where(better, trial, best), np.where(better, found, least)
        waiting = (least > 0) & (high - low > 1e-9 * (ends[1] - ends[0]))
        if not waiting.any():
            break
    crossed = least <= 0
    which, middle = element[crossed], best[crossed]
    return [(which, ends[0][crossed], middle), (which, middle, ends[1][crossed])]


def closed_in(misfit: Misfit, which: Array, low: Array, high: Array) -> Array:
    """The root in each interval, by the Illinois variant of false position; NaN at a pole.

    Dowell and Jarratt (1971). Both ends must differ in sign, or be nought.
    """
    import numpy as np

    left, right = misfit(which, low), misfit(which, high)
    height = np.maximum(abs(left), abs(right))
    best: Array = np.where(abs(left) <= abs(right), low, high)
    least: Array = np.minimum(abs(left), abs(right))
    for turn in range(ROUNDS):
        with np.errstate(all="ignore"):
            trial = high - right * (high - low) / (right - left)
        inside = (trial - low) * (trial - high) < 0
        trial = np.where(inside, trial, (low + high) / 2)
        value = misfit(which, trial)
        best = np.where(abs(value) < least, trial, best)
        least = np.minimum(abs(value), least)
        other = value * right < 0
        low, left = np.where(other, high, low), np.where(other, right, left / 2)
        high, right = trial, value
        pole = (turn >= SURE) & (abs(value) > GROWN * height)
        narrow = abs(high - low) <= 4e-16 * np.maximum(abs(low), abs(high))
        if (pole | narrow | (least == 0) | (abs(trial - low) < 1e-300)).all():
            break
    return np.where(least <= CLOSE * height, best, np.nan)
