"""A closure of a group in which several links are tried, in numbers of another kind than doubles.

Newton's method leads from doubles to the kind asked for. In balls Miranda's theorem proves it: each
combination of misfits that grows along one unknown alone has two signs on opposite faces of a box,
so that all vanish somewhere within.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import Any

from graphkin.construction.higher_class.trial_chain import TrialChain, middle
from graphkin.numbers.arithmetic import Kind, is_ball, phase, turn_by

APART = 2.0**-30
"""How far the first differences reach, in radians or parts of a trial value."""
ROUNDS = 60
"""Steps of Newton's method at most."""
ARRAY_ROUNDS = 2
"""Steps for arrays; each gains all the digits that the first double had."""
PIECES = (1, 16, 128, 1024, 4096)
"""Parts into which a face is cut, one number after the other: balls on smaller parts are tighter by
as much."""
WIDENED = 3
"""How many times a box is tried, doubled each time, before its proof is given up."""
Rows = Sequence[Sequence[Any]]


def refined(
    trying: Any, known: Sequence[Any], closed: Sequence[Any], kind: Kind
) -> tuple[Any, ...]:
    """A closure in doubles, ``closed``, in the kind of what is known: values, signs and sine.

    Raises ValueError where a ball does not tell that the group closes.
    """
    size = len(trying.unknowns)
    first, signs, sine = closed[:size], closed[size:-1], closed[-1]
    chain = SeveralChain(trying, known, signs, kind)
    pairs = [*zip(trying.unknowns, first, strict=True)]
    start = [kind.number(phase(each) if one.turns else each) for one, each in pairs]
    if hasattr(start[0], "shape") and start[0].shape:
        found = by_newton_arrays(chain, start)
    elif kind.name == "ball":
        found = proved(chain, by_newton(chain.middles, start))
    else:
        found = by_newton(chain.misfits, start)
    values = (turn_by(v) if one.turns else v for (one, _), v in zip(pairs, found, strict=True))
    rest = (each if is_ball(each) else kind.number(each) for each in (*signs, sine))
    return (*values, *rest)


class SeveralChain(TrialChain):
    """The trial chain of a group on one scene: its misfits at trial values, in a kind."""

    def misfits(self, tried: Sequence[Any], known: Any = None) -> list[Any]:
        """By how much each group misses; ValueError where the chain cannot be drawn."""
        unknowns = self.trying.unknowns
        facing = [one.facing for one in unknowns if one.facing is not None]
        found = self.drawn(tried, (*(one.misfit for one in unknowns), *facing), known)
        if not all(each > 0 for each in found[len(unknowns) :]):
            raise ValueError("the last link does not surely face the right way")
        return found[: len(unknowns)]

    def middles(self, tried: Sequence[Any]) -> list[Any]:
        """The middles of the misfits, in balls, of the middles of what is known."""
        known = {number: middle(value) for number, value in self.known.items()}
        return [middle(each) for each in self.misfits(tried, known)]


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


def slopes(misfits: Any, here: Sequence[Any], value: Sequence[Any], steps: Sequence[Any]) -> Rows:
    """How each misfit grows with each unknown: rows of differences."""
    columns = []
    for k, step in enumerate(steps):
        there = misfits([*here[:k], here[k] + step, *here[k + 1 :]])
        columns.append([(b - a) / step for a, b in zip(value, there, strict=True)])
    return [*zip(*columns, strict=True)]


def size_of(value: Any) -> Any:
    """What a step is measured by: a radian, or the trial value."""
    return abs(value) or 1


def by_newton(misfits: Any, start: Sequence[Any]) -> list[Any]:
    """Where all misfits vanish, near a start: until they no longer come nearer to nought.

    Differences reach as far as the last step went.
    """
    here, steps = [*start], [size_of(each) * APART for each in start]
    value = misfits(here)
    for _ in range(ROUNDS):
        if not any(value):
            break
        rows = slopes(misfits, here, value, steps)
        way = solved(rows, [-each for each in value])
        trial = [middle(each + step) for each, step in zip(here, way, strict=True)]
        there = misfits(trial)
        if not sum(map(abs, there)) < sum(map(abs, value)):
            break
        here, value = trial, there
        steps = [middle(step) or old for step, old in zip(way, steps, strict=True)]
    return here


def by_newton_arrays(chain: SeveralChain, start: Sequence[Any]) -> list[Any]:
    """As by_newton for arrays; in single precision the start is all that there is."""
    if chain.kind.name == "float32":
        return [*start]
    here = [*start]
    for _ in range(ARRAY_ROUNDS):
        value, steps = chain.misfits(here), [size * APART for size in map(abs, here)]
        way = solved(slopes(chain.misfits, here, value, steps), [-each for each in value])
        here = [each + step for each, step in zip(here, way, strict=True)]
    return here


def proved(chain: SeveralChain, near: Sequence[Any]) -> list[Any]:
    """The balls about values within which all misfits surely vanish, by Miranda's theorem."""
    from flint import arb

    sides = range(len(near))
    value = chain.misfits(near)
    steps = [size_of(each) * APART for each in near]
    rows = slopes(chain.middles, near, chain.middles(near), steps)
    inverse = [*zip(*(solved(rows, [int(i == k) for i in sides]) for k in sides), strict=True)]
    inverse = [tuple(middle(each) for each in row) for row in inverse]

    def grown(tried: Sequence[Any]) -> list[Any]:
        """The combinations of misfits that grow each along one unknown."""
        found = chain.misfits(tried)
        return [sum(a * g for a, g in zip(row, found, strict=True)) for row in inverse]

    tiny = arb(2) ** -(4 * 1024)
    widths = [
        2 * sum((abs(a) * abs(g).upper() for a, g in zip(row, value, strict=True)), tiny).upper()
        for row in inverse
    ]
    if not all(width.is_finite() for width in widths):
        raise ValueError("the ball does not tell how the loci cross")
    widest = max(widths, key=float)
    widths = [widest * size_of(each).upper() if is_ball(each) else widest for each in near]
    widths = [4 * width for width in widths]
    for _ in range(WIDENED):
        box = [arb(each, width.upper()) for each, width in zip(near, widths, strict=True)]
        if all(has_two_signs(grown, near, widths, k) for k in sides):
            if all(bool(each.is_finite()) for each in chain.misfits(box)):
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
