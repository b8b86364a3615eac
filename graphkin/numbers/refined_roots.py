"""Where functions vanish near doubles that do so nearly, in numbers of any other kind.

The secant through two places leads to the root of one function, Newton's method to that of several.
In balls a change of sign proves the one, Miranda's theorem the other: each combination of functions
that grows along one number alone has two signs on opposite faces of a box, so that all vanish
somewhere within.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import product
from typing import Any

from graphkin.numbers.arithmetic import is_ball
from graphkin.numbers.arrays import np
from graphkin.numbers.kinds import middle

Misfit = Callable[[Any], Any]
Misfits = Callable[[Sequence[Any]], Sequence[Any]]
Rows = Sequence[Sequence[Any]]

APART = 2.0**-30
"""How far the second place lies from the double, in radians or parts of its size."""
LEAST = 4 * 1024
"""The power of a half that the interval of a proof has at least for its width."""
MOST_SECANTS = 40
"""Most steps along the secant."""
WIDENED = 100
"""How many times the interval of a proof is widened before it is given up."""
WIDER = 1.25
"""How much wider each time."""
ARRAY_STEPS = 2
"""Steps for arrays; each gains all the digits that the first double had."""
ROUNDS = 60
"""Steps of Newton's method at most."""
PIECES = (1, 16, 128, 1024, 4096)
"""Parts into which a face is cut, one number after the other: balls on smaller parts are tighter by
as much."""
DOUBLED = 3
"""How many times a box is tried, doubled each time, before its proof is given up."""


def by_secant(misfit: Misfit, start: Any, step: Any) -> Any:
    """Where a misfit vanishes, near a start: until it no longer comes nearer to nought.

    The second place lies a ``step`` away.
    """
    old, new = start, start + step
    before, after = misfit(old), misfit(new)
    if abs(before) < abs(after):
        old, new, before, after = new, old, after, before
    for _ in range(MOST_SECANTS):
        if after in (0, before):
            return new
        aim = middle(new - after * (new - old) / (after - before))
        value = misfit(aim)
        if not abs(value) < abs(after):
            return new
        old, new, before, after = new, aim, after, value
    return new


def by_secants(misfit: Misfit, start: Any, turns: bool) -> Any:
    """As by_secant for an array; each step gains all the digits that the first double had."""
    old, new = start + APART * (1 if turns else np.maximum(abs(start), APART)), start
    before, after = misfit(old), misfit(new)
    for _ in range(ARRAY_STEPS):
        flat = after == before
        aim = np.where(flat, new, new - after * (new - old) / np.where(flat, 1, after - before))
        old, new, before, after = new, aim, after, misfit(aim)
    return new


def proved(misfit: Misfit, near: Any, step: Any) -> Any:
    """The ball about a value at whose ends the misfit surely has two signs, and none is missing.

    Between them the misfit is a continuous function, for it is finite on the whole ball.
    """
    from flint import arb

    slope = (misfit(near + step) - misfit(near - step)) / (2 * step)
    width = abs(misfit(near)).upper() / abs(slope).lower()
    if not width.is_finite():
        raise ValueError("the ball does not tell how the locus crosses")
    for _ in range(WIDENED):
        ball = arb(near, width.upper())
        ends = misfit(near - width), misfit(near + width)
        if (ends[0] < 0 and ends[1] > 0) or (ends[0] > 0 and ends[1] < 0):
            if bool(misfit(ball).is_finite()):
                return ball
            break
        width = WIDER * width + arb(2) ** -LEAST
    raise ValueError("the ball does not tell whether the group closes")


# --- of several functions -----------------------------------------------------------------------


def determinant(rows: Rows) -> Any:
    """The determinant of a few rows, by its first row."""
    if not rows:
        return 1
    total: Any = 0
    for k, head in enumerate(rows[0]):
        rest = [[*row[:k], *row[k + 1 :]] for row in rows[1:]]
        total = total + (-1) ** k * head * determinant(rest)
    return total


def solved(rows: Rows, right: Sequence[Any]) -> list[Any]:
    """What makes a few linear equations true (Cramer's rule)."""
    whole = determinant(rows)
    sides = range(len(rows))
    with_right = (
        [[*row[:k], end, *row[k + 1 :]] for row, end in zip(rows, right, strict=True)]
        for k in sides
    )
    return [determinant(each) / whole for each in with_right]


def slopes(
    misfits: Misfits, here: Sequence[Any], value: Sequence[Any], steps: Sequence[Any]
) -> Rows:
    """How each misfit grows with each unknown: rows of differences."""
    columns = []
    for k, step in enumerate(steps):
        there = misfits([*here[:k], here[k] + step, *here[k + 1 :]])
        columns.append([(b - a) / step for a, b in zip(value, there, strict=True)])
    return [*zip(*columns, strict=True)]


def size_of(value: Any) -> Any:
    """What a step is measured by: a radian, or the value itself."""
    return abs(value) or 1


def by_newton(misfits: Misfits, start: Sequence[Any]) -> list[Any]:
    """Where all misfits vanish, near a start: until they no longer come nearer to nought.

    Differences reach as far as the last step went. In the end these are rounding alone, which may
    lead nowhere (ZeroDivisionError), or to where there are no misfits (ValueError): neither is
    nearer.
    """
    here, steps = [*start], [size_of(each) * APART for each in start]
    value = misfits(here)
    for _ in range(ROUNDS):
        if not any(value):
            break
        rows = slopes(misfits, here, value, steps)
        try:
            way = solved(rows, [-each for each in value])
            aim = [middle(each + step) for each, step in zip(here, way, strict=True)]
            there = misfits(aim)
        except (ZeroDivisionError, ValueError):
            break
        if not sum(map(abs, there)) < sum(map(abs, value)):
            break
        here, value = aim, there
        steps = [middle(step) or old for step, old in zip(way, steps, strict=True)]
    return here


def by_newton_arrays(misfits: Misfits, start: Sequence[Any]) -> list[Any]:
    """As by_newton for arrays."""
    here = [*start]
    for _ in range(ARRAY_STEPS):
        value, steps = misfits(here), [size * APART for size in map(abs, here)]
        way = solved(slopes(misfits, here, value, steps), [-each for each in value])
        here = [each + step for each, step in zip(here, way, strict=True)]
    return here


def proved_together(misfits: Misfits, middles: Misfits, near: Sequence[Any]) -> list[Any]:
    """The balls about values within which all misfits surely vanish, by Miranda's theorem."""
    from flint import arb

    sides = range(len(near))
    value = misfits(near)
    steps = [size_of(each) * APART for each in near]
    rows = slopes(middles, near, middles(near), steps)
    inverse = [*zip(*(solved(rows, [int(i == k) for i in sides]) for k in sides), strict=True)]
    inverse = [tuple(middle(each) for each in row) for row in inverse]

    def grown(tried: Sequence[Any]) -> list[Any]:
        """The combinations of misfits that grow each along one unknown."""
        found = misfits(tried)
        return [sum(a * g for a, g in zip(row, found, strict=True)) for row in inverse]

    tiny = arb(2) ** -LEAST
    widths = [
        2 * sum((abs(a) * abs(g).upper() for a, g in zip(row, value, strict=True)), tiny).upper()
        for row in inverse
    ]
    if not all(width.is_finite() for width in widths):
        raise ValueError("the ball does not tell how the loci cross")
    widest = max(widths, key=float)
    widths = [widest * size_of(each).upper() if is_ball(each) else widest for each in near]
    widths = [4 * width for width in widths]
    for _ in range(DOUBLED):
        box = [arb(each, width.upper()) for each, width in zip(near, widths, strict=True)]
        if all(has_two_signs(grown, near, widths, k) for k in sides):
            if all(bool(each.is_finite()) for each in misfits(box)):
                return box
            break
        widths = [2 * width for width in widths]
    raise ValueError("the ball does not tell whether the group closes")


def has_two_signs(grown: Any, near: Sequence[Any], widths: Sequence[Any], k: int) -> bool:
    """Whether a combination is surely negative on one face of a box and positive on the other."""
    from flint import arb

    others = [i for i in range(len(near)) if i != k]
    for parts in PIECES:
        pieces, good = max(1, round(parts ** (1 / len(others)))), True
        for place in product(range(pieces), repeat=len(others)):
            tried = [*near]
            for i, part in zip(others, place, strict=True):
                share = arb(2 * part + 1 - pieces) / pieces
                tried[i] = arb((near[i] + share * widths[i]).mid(), (widths[i] / pieces).upper())
            for way in (-1, 1):
                tried[k] = near[k] + way * widths[k]
                if not way * grown(tried)[k] > 0:
                    good = False
                    break
            if not good:
                break
        if good:
            return True
    return False
