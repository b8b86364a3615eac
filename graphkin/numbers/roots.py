"""Roots of many functions of one number at once: brackets on a grid, then refinement.

``Misfit`` gives the values of many functions at one place each: which functions (K,), where (K,),
as arrays of equal length; NaN where a function is undefined.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from graphkin.numbers.arithmetic import np

Array = Any
Misfit = Callable[[Array, Array], Array]

ROUNDS = 60
"""The most rounds of refinement; bisection alone needs 53 for all digits of a double."""
CLOSE = 1e-6
"""Misfit left at a root, relative to its interval's: rounding leaves far less, a pole more."""
GROWN = 4.0
"""Growth of the misfit within an interval beyond which it counts as a pole."""
SURE = 8
"""Rounds after which a misfit that has grown counts as a pole."""
NEXT = 4e-16
"""Relative distance of two neighbouring numbers."""
POLE = 4 * NEXT
"""Relative distance from a pole at which its sides are examined."""
DEEPEST = 1e3
"""Largest dip of a misfit within three places, relative to its rise at the outer two.

A parabola with two roots dips an eighth, an edge half. A change by rounding alone does not rise.
"""
HIDDEN = 1e-13
"""Relative misfit below which rounding hides whether there is a root."""
GOLDEN = 0.3819660112501051
"""The smaller part in the golden section."""


def roots(misfit: Misfit, grid: Array) -> tuple[Array, Array]:
    """Every root of n functions, each on its own grid of places (n, M): function and place."""
    which, place, touching = roots_and_touches(misfit, grid)
    return which[~touching], place[~touching]


def roots_and_touches(misfit: Misfit, grid: Array) -> tuple[Array, Array, Array]:
    """The roots, with places where rounding may hide two roots, and a mark for these.

    A change of sign between grid neighbours is a root, unless it is a pole. Where the misfit turns
    back towards zero, its minimum is located. Where a function breaks off, its last place is
    located. Two roots close together are thus found there, too.
    """
    size, places = grid.shape
    owner = np.repeat(np.arange(size), places)
    value = misfit(owner, grid.ravel()).reshape(grid.shape)
    left, right = value[:, :-1], value[:, 1:]
    element, at = np.nonzero((left * right < 0) | (left == 0))
    found = [(element, grid[element, at], grid[element, at + 1])]
    found += beside_breaks(misfit, grid, value)
    turned = turns(misfit, grid, value)
    found += beside_turns(*turned)
    which, low, high = (np.concatenate(parts) for parts in zip(*found, strict=True))
    place = closed_in(misfit, which, low, high)
    good = np.isfinite(place)
    near, touch = touches(value, *turned)
    touching = np.repeat([False, True], [good.sum(), near.size])
    return np.append(which[good], near), np.append(place[good], touch), touching


def beside_breaks(misfit: Misfit, grid: Array, value: Array) -> list[tuple[Array, Array, Array]]:
    """Intervals with a root between the last grid place and the function's break."""
    there = np.isfinite(value)
    element, at = np.nonzero(there[:, :-1] != there[:, 1:])
    if not element.size:
        return []
    first = there[element, at]
    inside = np.where(first, grid[element, at], grid[element, at + 1])
    start, end = inside.copy(), np.where(first, grid[element, at + 1], grid[element, at])
    for _ in range(ROUNDS):
        wide = abs(end - start) > NEXT * np.maximum(abs(start), abs(end))
        if not (live := np.flatnonzero(wide)).size:
            break
        middle = (start[live] + end[live]) / 2
        good = np.isfinite(misfit(element[live], middle))
        start[live[good]], end[live[~good]] = middle[good], middle[~good]
    crossed = misfit(element, inside) * misfit(element, start) < 0
    low, high = np.minimum(inside, start), np.maximum(inside, start)
    return [(element[crossed], low[crossed], high[crossed])]


def roots_beside_poles(misfit: Misfit, pole: Misfit, grid: Array) -> tuple[Array, Array]:
    """Roots that share a grid interval with a pole, so that there is no change of sign.

    ``pole`` vanishes at the poles.
    """
    size, places = grid.shape
    value = pole(np.repeat(np.arange(size), places), grid.ravel()).reshape(grid.shape)
    element, at = np.nonzero(value[:, :-1] * value[:, 1:] < 0)
    ends = misfit(np.tile(element, 2), np.append(grid[element, at], grid[element, at + 1]))
    hiding = ends[: at.size] * ends[at.size :] > 0
    if not hiding.any():
        return element[hiding], ends[: at.size][hiding]
    element, at = element[hiding], at[hiding]
    low, high = grid[element, at], grid[element, at + 1]
    there = closed_in(pole, element, low, high)
    gap = POLE * np.maximum(abs(there), 1)
    which = np.concatenate([element, element])
    start, end = np.append(low, there + gap), np.append(there - gap, high)
    crossed = misfit(which, start) * misfit(which, end) < 0
    which, start, end = which[crossed], start[crossed], end[crossed]
    place = closed_in(lambda row, x: misfit(row, x) * pole(row, x), which, start, end)
    good = np.isfinite(place)
    return which[good], place[good]


def beside_turns(
    element: Array, low: Array, best: Array, high: Array, least: Array
) -> list[tuple[Array, Array, Array]]:
    """Intervals with two roots, one on each side of a minimum beyond zero."""
    crossed = least <= 0
    which, middle = element[crossed], best[crossed]
    return [(which, low[crossed], middle), (which, middle, high[crossed])]


def touches(
    value: Array, element: Array, low: Array, best: Array, high: Array, least: Array
) -> tuple[Array, Array]:
    """Places where functions turn so near zero that rounding may hide two roots.

    ``value`` are the values of the functions on their grids.
    """
    near = (least > 0) & (least < HIDDEN * largest(value)[element])
    return element[near], best[near]


def largest(value: Array) -> Array:
    return np.nanmax(abs(value), axis=1, initial=0)


def turns(misfit: Misfit, grid: Array, value: Array) -> tuple[Array, Array, Array, Array, Array]:
    """Minima of functions towards zero: which function, three places about each, the least misfit.

    Golden section searches until it has converged or crosses zero by more than rounding; the least
    misfit is then negative. It also stops where the function is too high to fall to zero.
    """
    size = abs(value)
    here, near = size[:, 1:-1], np.sign(value[:, 1:-1])
    turns = (here <= size[:, :-2]) & (here <= size[:, 2:])
    turns &= (near == np.sign(value[:, :-2])) & (near == np.sign(value[:, 2:]))
    element, at = np.nonzero(turns)
    sign = near[element, at]
    low, best, high = (grid[element, at + k] for k in (0, 1, 2))
    below, least, above = (size[element, at + k] for k in (0, 1, 2))
    ends, hidden = (low.copy(), high.copy()), HIDDEN * largest(value)[element]
    for _ in range(ROUNDS):
        waiting = (least > -hidden) & (high - low > 1e-9 * (ends[1] - ends[0]))
        waiting &= ~(least > DEEPEST * (np.maximum(below, above) - least))
        if not (live := np.flatnonzero(waiting)).size:
            break
        start, middle, end = low[live], best[live], high[live]
        longer = end - middle > middle - start
        candidate = middle + GOLDEN * np.where(longer, end - middle, start - middle)
        found = sign[live] * misfit(element[live], candidate)
        better = found < least[live]
        new_end = np.where(better, middle, candidate), np.where(better, least[live], found)
        up = better == longer
        low[live[up]], below[live[up]] = (each[up] for each in new_end)
        high[live[~up]], above[live[~up]] = (each[~up] for each in new_end)
        best[live[better]], least[live[better]] = candidate[better], found[better]
    return element, ends[0], best, ends[1], least


def closed_in(misfit: Misfit, which: Array, low: Array, high: Array) -> Array:
    """The root in each interval, by the Illinois variant of false position; NaN at a pole.

    Dowell and Jarratt (1971). Both ends must differ in sign, or be zero.
    """
    low, high = low.copy(), high.copy()
    left, right = np.array(misfit(which, low)), np.array(misfit(which, high))
    height = np.maximum(abs(left), abs(right))
    best: Array = np.where(abs(left) <= abs(right), low, high)
    least: Array = np.minimum(abs(left), abs(right))
    live = np.flatnonzero(least != 0)
    for turn in range(ROUNDS):
        if not live.size:
            break
        start, end, before, after = low[live], high[live], left[live], right[live]
        with np.errstate(all="ignore"):
            candidate = end - after * (end - start) / (after - before)
        inside = (candidate - start) * (candidate - end) < 0
        candidate = np.where(inside, candidate, (start + end) / 2)
        value = misfit(which[live], candidate)
        best[live] = np.where(abs(value) < least[live], candidate, best[live])
        least[live] = np.minimum(abs(value), least[live])
        other = value * after < 0
        low[live], left[live] = np.where(other, end, start), np.where(other, after, before / 2)
        high[live], right[live] = candidate, value
        pole = (turn >= SURE) & (abs(value) > GROWN * height[live])
        narrow = abs(candidate - low[live]) <= NEXT * np.maximum(abs(low[live]), abs(candidate))
        live = live[~(pole | narrow | (least[live] == 0) | (abs(candidate - low[live]) < 1e-300))]
    rough = (least > HIDDEN * height) & (least <= CLOSE * height)
    halved_in(misfit, which, (low, high), (best, least), rough)
    return np.where(least <= CLOSE * height, best, np.nan)


def halved_in(
    misfit: Misfit,
    which: Array,
    ends: tuple[Array, Array],
    found: tuple[Array, Array],
    rough: Array,
) -> None:
    """Refine by bisection the ``rough`` roots that false position does not settle.

    A root just before a jump of its function is one of them. ``found`` holds the best place of each
    root and the misfit there; both are updated.
    """
    (low, high), (best, least) = ends, found
    live = np.flatnonzero(rough)
    if not live.size:
        return
    start, end = low[live].copy(), high[live].copy()
    after = np.array(misfit(which[live], end))
    for _ in range(ROUNDS):
        middle = (start + end) / 2
        value = misfit(which[live], middle)
        closer = abs(value) < least[live]
        best[live[closer]], least[live[closer]] = middle[closer], abs(value[closer])
        beyond = value * after > 0
        start, end = np.where(beyond, start, middle), np.where(beyond, middle, end)


# --- windows in which functions of one number are defined, their ends, and roots near these -------


BESIDE = 0.5
"""Distance of a window's first place from its end, in steps of the places before easing."""
STRAIGHT = 8.0
"""Multiple of rounding within which the curve near an end counts as straight.

Rounding hides the curvature there.
"""
WHOLE = 0.9
"""The largest share of the distance to the next place that counts as straight."""
OPENS = 1.5
"""Least growth of the signs' difference at twice the distance; 2 where the signs meet."""
DOUBLINGS = 40
"""The most doublings of the distance at which doubles can draw a nearly flat dyad."""
NOISY = 10
"""Places, from a quarter of that distance on, that must be drawable; rounding excuses one."""
LEAST = 16.0
"""The least such distance, in gaps between neighbouring numbers near one."""


class Windows(NamedTuple):
    """The owner of each window (W,), and its places from end to end (W, M)."""

    owner: Array
    places: Array


class Ends(NamedTuple):
    """The owner of each window end (E,), its place (E,), and the window's next place."""

    owner: Array
    at: Array
    beside: Array


def narrowed(reaches: Misfit, windows: Windows) -> tuple[Windows, Ends]:
    """The parts of windows in which a smooth function is positive, and their ends at its zeros.

    The places come close to such an end but do not include it.
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
    """Shares from 0 to 1, denser near both ends, where a square root grows steeply."""
    return (1 - np.cos(np.pi * share)) / 2


# --- roots near a flat end ------------------------------------------------------------------------


def fits_beside(
    misfit: Callable[[Array, Array, Array], Array], at: Array, beside: Array
) -> tuple[Array, Array, Array, Array]:
    """Every root near n ends of windows: end, place, sign, and whether it is uncertain.

    ``misfit`` gives the values of functions (K,) at places and signs (K,). ``at`` are the ends
    (n,), in radians or shares of a way, and ``beside`` the windows' next places.
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
    for _ in range(DOUBLINGS):
        tried = np.repeat(which[lost], NOISY)
        steps = np.outer(away[lost], np.linspace(0.25, 1, NOISY)).ravel()
        value = misfit(tried, at[tried] + way[tried] * steps, np.repeat(sign[lost], NOISY))
        lost = lost[~np.isfinite(value).reshape(-1, NOISY).all(axis=1)]
        if not lost.size:
            break
        away[lost] *= 2
    return which, at[which] + way[which] * away, sign, touching


def may_vanish(value: Array) -> Array:
    """The rows of values that change sign or turn back towards zero."""
    size = abs(value)
    turned = (size[:, 1:-1] <= size[:, :-2]) & (size[:, 1:-1] <= size[:, 2:])
    return (np.sign(value[:, 1:]) != np.sign(value[:, :-1])).any(axis=1) | turned.any(axis=1)
