"""A closure of a group of class III or higher in numbers of another kind than doubles.

Doubles tell which closure is meant. From there the secant through two trials leads to the value in
the kind asked for; in balls a change of sign proves it: what is cut cannot but fit in between.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from graphkin.construction.higher_class.merging import Closing, closings_of, merged
from graphkin.construction.higher_class.trial_chain import TrialChain, by_secant, middle, proved
from graphkin.numbers.arithmetic import Kind, is_ball, phase, turn_by

SECANTS = 2
"""Steps along the secant that lead from a double to a longdouble."""
APART = 2.0**-30
"""How far the second trial lies from the closure in doubles, in radians or parts of its size."""
FLAT = 1e-6
"""How near the end of a window a closure lies beside it, in radians or parts of its size."""
ASIDE = 2.0**-15
"""Root of the distance to an end at which the misfit on both signs tells its curve between."""
CONFUSED = 0.01
"""How near another closure is that one may be taken for, in radians or parts of its size."""


def closed_in(trying: Any, known: Sequence[Any], number: int, kind: Kind) -> tuple[Any, ...]:
    """Trial value, signs and the sine of crossing in one closure, in the kind of what is known.

    Raises ClosingError where there is no such closure, ValueError where a ball does not tell that
    the group closes, and MergingError where it does not tell which closure has the number.
    """
    doubles = [in_doubles(value) for value in known]
    if trying.several:
        from graphkin.construction.higher_class.refined_trials import refined as refined_together

        single = not any(hasattr(value, "shape") for value in doubles)
        closed = (trying.closed_again if single else trying.closed)(tuple(doubles), number)
        return refined_together(trying, known, closed, kind)
    if kind.name == "ball":
        return closed_in_balls(trying, known, doubles, number, kind)
    found, *signs, sine = trying.closed(doubles, number)
    start = kind.number(phase(found) if trying.first.turns else found)
    aim = aimed(TrialChain(trying, known, signs, kind), start)
    return closing(aim.chain, refined(aim), sine)


def closed_in_balls(
    trying: Any, known: Sequence[Any], doubles: Sequence[Any], number: int, kind: Kind
) -> tuple[Any, ...]:
    """As closed_in, in balls: where rounding leaves open which closures there are balls decide."""
    closures = trying.closures_of(doubles)
    closings = closings_of(closures)
    if merging := closures.merging_at(number):
        try:
            closings = merged(trying, known, closures, kind)
        except ValueError as undecided:
            raise merging from undecided
    one = trying.chosen(closings, number)
    chain = TrialChain(trying, known, one.signs, kind)
    if is_ball(one.tried):
        return closing(chain, one.tried, one.sine)
    aim = aimed(chain, kind.number(one.tried))
    value = refined(aim)
    refuse_confused(aim.chain, value, one, closings)
    return closing(aim.chain, value, one.sine)


def closing(chain: TrialChain, value: Any, sine: Any) -> tuple[Any, ...]:
    """What closes a group, in the kind of a chain: the trial value, signs, sine of crossing."""
    rest = (each if is_ball(each) else chain.kind.number(each) for each in (*chain.signs, sine))
    return (turn_by(value) if chain.trying.first.turns else value, *rest)


def refuse_confused(
    chain: TrialChain, value: Any, one: Closing, closings: Sequence[Closing]
) -> None:
    """Closures with the signs of one are surely others, and on the side where doubles find them.

    Only those that lie so near that a secant might lead from one to the other are looked at.
    """
    turns, tried = chain.trying.first.turns, one.tried
    for each in closings:
        if each is one or each.signs != tuple(chain.signs) or is_ball(each.tried):
            continue
        other = each.tried
        if abs(other - tried) < CONFUSED * (1 if turns else abs(tried) or 1):
            away = refined(aimed(chain, chain.kind.number(other))) - value
            if not (away > 0 if other > tried else away < 0):
                raise ValueError("the balls do not tell two closures apart")


def in_doubles(value: Any) -> Any:
    """The double, or the array of doubles, next to a number of any kind."""
    if hasattr(value, "shape") and value.shape:
        import numpy as np

        return value.astype(np.complex128 if value.dtype.kind == "c" else np.float64)
    if isinstance(value, complex | float | int):
        return value
    parts = float(value.real), float(value.imag)
    return complex(*parts) if is_complex(value) else parts[0]


def is_complex(value: Any) -> bool:
    """Whether a number of another kind than Python's is one of the plane."""
    return type(value).__name__.startswith(("mpc", "acb", "complex", "clongdouble"))


class Aim(NamedTuple):
    """The chain whose closure is refined, where that starts, and how far the second trial lies."""

    chain: TrialChain
    start: Any
    step: Any


def aimed(chain: TrialChain, start: Any) -> Aim:
    """Where the secant towards a closure starts, from its double.

    Beside the end of a window, where a dyad is stretched flat and doubles do not tell its sign, the
    curve of both signs is followed through the end.
    """
    turns, trying = chain.trying.first.turns, chain.trying
    if hasattr(start, "shape") and start.shape:
        return Aim(chain, start, None)
    size = 1 if turns else abs(start) or 1
    for k, choice in enumerate(trying.choices):
        if choice is None:
            continue
        here, beyond = (chain.reach(k, start + step) for step in (0, APART * size))
        slope = (beyond - here) / (APART * size)
        if abs(here) < FLAT * size * abs(slope):
            return beside_flat(chain, k, start, -here / slope)
    return Aim(chain, start, APART * size)


def beside_flat(chain: TrialChain, k: int, start: Any, step: Any) -> Aim:
    """As aimed, where the dyad of a sign is stretched flat a step away from a start."""
    end = by_secant(lambda tried: chain.reach(k, tried), start, step or APART)
    way = 1 if chain.reach(k, end + abs(step) + APART) > 0 else -1
    sides = {
        sign: TrialChain(
            chain.trying,
            tuple(chain.known.values()),
            [*chain.signs[:k], sign, *chain.signs[k + 1 :]],
            chain.kind,
        )
        for sign in (-1.0, 1.0)
    }

    def side(v: Any) -> TrialChain:
        return sides[1.0 if v > 0 else -1.0]

    def curve(v: Any) -> Any:
        return side(v).middle_misfit(end + way * v * v)

    before, after = curve(-ASIDE), curve(ASIDE)
    v = by_secant(curve, middle((before + after) / (before - after) * ASIDE), ASIDE**2)
    return Aim(side(v), middle(end + way * v * v), v * v * ASIDE)


def refined(aim: Aim) -> Any:
    """The trial value of a closure in the kind of its chain."""
    chain, start, step = aim
    if step is None:
        turns = chain.trying.first.turns
        return start if chain.kind.name == "float32" else by_secants(chain.misfit, start, turns)
    if chain.kind.name != "ball":
        return by_secant(chain.misfit, start, step)
    return proved(chain, by_secant(chain.middle_misfit, start, step), step)


def by_secants(misfit: Any, start: Any, turns: bool) -> Any:
    """As by_secant for an array; each step gains all the digits that the first double had."""
    import numpy as np

    old, new = start + APART * (1 if turns else np.maximum(abs(start), APART)), start
    before, after = misfit(old), misfit(new)
    for _ in range(SECANTS):
        flat = after == before
        trial = np.where(flat, new, new - after * (new - old) / np.where(flat, 1, after - before))
        old, new, before, after = new, trial, after, misfit(trial)
    return new
