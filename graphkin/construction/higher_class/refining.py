"""A closure of a group of class III or higher in numbers of another kind than doubles.

Doubles tell which closure is meant. From there one is led to the value in the kind asked for; balls
prove it: what is cut cannot but fit in between.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from graphkin.construction.higher_class.merging import Closing, closings_of, merged
from graphkin.construction.higher_class.trial import TrialChain
from graphkin.numbers.arithmetic import Kind, is_ball
from graphkin.numbers.kinds import in_doubles, middle
from graphkin.numbers.refined_roots import (
    APART,
    by_newton,
    by_newton_arrays,
    by_secant,
    by_secants,
    proved,
    proved_together,
)

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
    if kind.name == "ball" and not trying.several:
        return closed_in_balls(trying, known, doubles, number, kind)
    return refined(trying, known, trying.closed(doubles, number), kind)


def refined(
    trying: Any, known: Sequence[Any], closed: Sequence[Any], kind: Kind
) -> tuple[Any, ...]:
    """A closure in doubles, ``closed``, in the kind of what is known: values, signs and sine.

    Raises ValueError where a ball does not tell that the group closes.
    """
    size = len(trying.unknowns)
    signs, sine = closed[size:-1], closed[-1]
    chain = TrialChain(trying, known, signs, kind)
    start = [kind.number(each) for each in trying.numbers(closed)]
    if trying.several:
        return closing(chain, together(chain, start), sine)
    aim = aimed(chain, start[0])
    return closing(aim.chain, [led(aim)], sine)


def together(chain: TrialChain, start: Sequence[Any]) -> Sequence[Any]:
    """The trial values of a closure of several unknowns, from doubles."""
    if hasattr(start[0], "shape") and start[0].shape:
        return start if chain.kind.name == "float32" else by_newton_arrays(chain.misfits, start)
    if chain.kind.name != "ball":
        return by_newton(chain.misfits, start)
    return proved_together(chain.misfits, chain.middles, by_newton(chain.middles, start))


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
        return closing(chain, [one.tried], one.sine)
    aim = aimed(chain, kind.number(one.tried))
    value = led(aim)
    refuse_confused(aim.chain, value, one, closings)
    return closing(aim.chain, [value], one.sine)


def closing(chain: TrialChain, found: Sequence[Any], sine: Any) -> tuple[Any, ...]:
    """What closes a group, in the kind of a chain: the trial values, signs, sine of crossing."""
    rest = (each if is_ball(each) else chain.kind.number(each) for each in (*chain.signs, sine))
    return (*chain.trial.placed(found), *rest)


def refuse_confused(
    chain: TrialChain, value: Any, one: Closing, closings: Sequence[Closing]
) -> None:
    """Closures with the signs of one are surely others, and on the side where doubles find them.

    Only those that lie so near that a secant might lead from one to the other are looked at.
    """
    turns, tried = chain.trial.first.turns, one.tried
    for each in closings:
        if each is one or each.signs != tuple(chain.signs) or is_ball(each.tried):
            continue
        other = each.tried
        if abs(other - tried) < CONFUSED * (1 if turns else abs(tried) or 1):
            away = led(aimed(chain, chain.kind.number(other))) - value
            if not (away > 0 if other > tried else away < 0):
                raise ValueError("the balls do not tell two closures apart")


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
    turns = chain.trial.first.turns
    if hasattr(start, "shape") and start.shape:
        return Aim(chain, start, None)
    size = 1 if turns else abs(start) or 1
    for k, choice in enumerate(chain.trial.choices):
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
    sides = {sign: chain.with_sign(k, sign) for sign in (-1.0, 1.0)}

    def side(v: Any) -> TrialChain:
        return sides[1.0 if v > 0 else -1.0]

    def curve(v: Any) -> Any:
        return side(v).middle_misfit(end + way * v * v)

    before, after = curve(-ASIDE), curve(ASIDE)
    v = by_secant(curve, middle((before + after) / (before - after) * ASIDE), ASIDE**2)
    return Aim(side(v), middle(end + way * v * v), v * v * ASIDE)


def led(aim: Aim) -> Any:
    """The trial value of a closure in the kind of its chain."""
    chain, start, step = aim
    if step is None:
        turns = chain.trial.first.turns
        return start if chain.kind.name == "float32" else by_secants(chain.misfit, start, turns)
    if chain.kind.name != "ball":
        return by_secant(chain.misfit, start, step)
    return proved(chain.misfit, by_secant(chain.middle_misfit, start, step), step)
