"""A closure of a group of class III or higher, in a kind of number other than doubles.

Doubles determine which closure is meant. Refinement leads from there to the value in the kind asked
for. In balls, a change of sign proves that the cut fits in between.

Near a place where two closures merge, the misfit is a parabola whose least value is of the size of
rounding. Its vertex is found in balls, and the misfit there decides. If its sign is opposite to
that of the curvature, a closure lies on each side; if the signs agree, there is none.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from msgspec import Struct

from graphkin.construction.higher_class.trial import TrialChain
from graphkin.numbers.arithmetic import Kind, is_ball
from graphkin.numbers.common_roots import (
    APART,
    by_newton,
    by_newton_arrays,
    by_secant,
    by_secants,
    proved,
    proved_together,
)
from graphkin.numbers.kinds import in_doubles, middle
from graphkin.numbers.plane import cross

NEAR = 1e-3
"""The distance within which closures merge, in radians or as a fraction of their trial value."""
ROUNDS = 40
"""Most steps of Newton's method towards a vertex."""
FINE = 2.0**-12
"""Second trial of a secant near a vertex, as a fraction of the distance to the vertex."""


class Closing(Struct, frozen=True):
    """One closure: its trial value (rad or m), its signs and the sine of crossing.

    The trial value and the sine are doubles, or balls where balls have found them.
    """

    tried: Any
    signs: tuple[float, ...]
    sine: Any


def closing_of(row: Any) -> Closing:
    """The closure of a row of a table."""
    return Closing(float(row[1]), tuple(row[2:-1].tolist()), float(row[-1]))


def merged(trying: Any, known: Sequence[Any], closures: Any, kind: Kind) -> list[Closing]:
    """Every closure in order, on known balls, of the first element of closures in doubles.

    Raises ValueError where balls of this kind do not decide between two closures and none.
    """
    found: list[Closing] = []
    seen: list[Closing] = []
    for row, merging in zip(closures.whole, closures.merging, strict=True):
        if row[0] != 0:
            break
        one = closing_of(row)
        if not merging:
            found.append(one)
        elif not any(beside(trying, one, other) for other in seen):
            found += both(TrialChain(trying, known, one.signs, kind), one.tried)
        seen += [one] if merging else []
    return found


def beside(trying: Any, one: Closing, other: Closing) -> bool:
    """Whether two closures that merge belong to the same vertex."""
    return one.signs == other.signs and abs(one.tried - other.tried) < NEAR * size(
        trying, one.tried
    )


def size(trying: Any, tried: Any) -> Any:
    """The unit of a trial: a radian, or the trial value itself (m)."""
    return 1 if trying.first.turns else abs(tried) or 1


def both(chain: TrialChain, start: float) -> list[Closing]:
    """The two closures near a vertex, in order; none where the misfit does not reach zero."""
    step = chain.kind.number(size(chain.trial, start)) * quarter(chain.kind)
    vertex = vertex_near(chain, start, step)
    least, (before, after) = chain.misfit(vertex), sides(chain, vertex, step)
    bend = before - 2 * least + after
    if (least > 0 and bend > 0) or (least < 0 and bend < 0):
        if all(abs(least) > 2 * abs(each - least) for each in (before, after)):
            return []
        raise ValueError("the ball does not tell whether two closures have merged")
    if not ((least > 0 and bend < 0) or (least < 0 and bend > 0)):
        raise ValueError("the ball does not tell whether two closures have merged")
    way = middle((-2 * least / bend).sqrt() * step)
    ends = [found_beside(chain, vertex + sign * way, sign * way * FINE) for sign in (-1, 1)]
    if not ends[0] < ends[1]:
        raise ValueError("the balls do not tell two closures apart")
    sines = [sine_of(chain, end, way * FINE) for end in ends]
    pair = [Closing(end, tuple(chain.signs), sine) for end, sine in zip(ends, sines, strict=True)]
    return pair if in_order(chain, *ends) else pair[::-1]


def quarter(kind: Kind) -> Any:
    """A half to the power of a quarter of the balls' bits: the step of differences."""
    from flint import arb, ctx

    return arb(2) ** -(ctx.prec // 4)


def sides(chain: TrialChain, tried: Any, step: Any) -> tuple[Any, Any]:
    """The misfit a step before and a step after a trial value."""
    return chain.misfit(tried - step), chain.misfit(tried + step)


def vertex_near(chain: TrialChain, start: float, step: Any) -> Any:
    """The trial value at which the misfit turns back, by Newton's method on its differences."""
    tried = chain.kind.number(start)
    for _ in range(ROUNDS):
        before, after = sides(chain, tried, step)
        bend = before - 2 * chain.misfit(tried) + after
        away = middle((after - before) / bend * step / 2)
        tried = middle(tried - away)
        if not abs(tried - start) < 2 * NEAR * size(chain.trial, start):
            raise ValueError("no closures merge near the start")
        if abs(away) < step * FINE:
            break
    return tried


def found_beside(chain: TrialChain, start: Any, step: Any) -> Any:
    """The closure near a start, proved; the other one is farther away than a step."""
    return proved(chain.misfit, by_secant(chain.middle_misfit, middle(start), step), abs(step))


def sine_of(chain: TrialChain, tried: Any, step: Any) -> Any:
    """Sine of the angle at which the locus crosses what was cut, by differences."""
    before, after = sides(chain, middle(tried), step)
    way = chain.locus(middle(tried) + step) - chain.locus(middle(tried) - step)
    return middle(abs(after - before) / abs(way))


def in_order(chain: TrialChain, low: Any, high: Any) -> bool:
    """Whether the first of two closures has the smaller number, by the first axis that differs."""
    for first, second in zip(chain.axes(low), chain.axes(high), strict=True):
        turn = cross(first, second)
        if turn > 0 or turn < 0:
            return bool(turn > 0)
    raise ValueError("the balls do not tell which of two closures comes first")


FLAT = 1e-6
"""Distance from a window's end within which a closure is near it, in radians or relative."""
ASIDE = 2.0**-15
"""Square root of the distance from an end at which the misfit on both signs is sampled."""
CONFUSED = 0.01
"""Distance within which two closures may be confused, in radians or relative."""


def closed_in(trying: Any, known: Sequence[Any], number: int, kind: Kind) -> tuple[Any, ...]:
    """Trial value, signs and sine of crossing in one closure, in the kind of the known values.

    Raises ClosingError where there is no such closure. Raises ValueError where a ball does not
    prove that the group closes, and MergingError where it leaves the closure's number open.
    """
    doubles = [in_doubles(value) for value in known]
    if kind.name == "ball" and not trying.several:
        return closed_in_balls(trying, known, doubles, number, kind)
    return refined(trying, known, trying.closed(doubles, number), kind)


def refined(
    trying: Any, known: Sequence[Any], closed: Sequence[Any], kind: Kind
) -> tuple[Any, ...]:
    """Refine a closure in doubles, ``closed``, in the kind of the known values.

    Returns values, signs and sine. Raises ValueError where a ball does not prove that the group
    closes.
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
    """The trial values of a closure with several unknowns, from doubles."""
    if hasattr(start[0], "shape") and start[0].shape:
        return start if chain.kind.name == "float32" else by_newton_arrays(chain.misfits, start)
    if chain.kind.name != "ball":
        return by_newton(chain.misfits, start)
    return proved_together(chain.misfits, chain.middles, by_newton(chain.middles, start))


def closed_in_balls(
    trying: Any, known: Sequence[Any], doubles: Sequence[Any], number: int, kind: Kind
) -> tuple[Any, ...]:
    """As ``closed_in``, in balls, which decide where rounding leaves the closures open."""
    closures = trying.closures_of(doubles)
    closings = [closing_of(row) for row in closures.table if row[0] == 0]
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
    """The values that close a group, in a chain's kind: trial values, signs, sine of crossing."""
    rest = (each if is_ball(each) else chain.kind.number(each) for each in (*chain.signs, sine))
    return (*chain.trial.placed(found), *rest)


def refuse_confused(
    chain: TrialChain, value: Any, one: Closing, closings: Sequence[Closing]
) -> None:
    """Raise ValueError unless ``one`` is proved distinct from the other closures with its signs.

    The others must lie on the side where doubles find them. Only those so near that a secant might
    lead from one to the other are checked.
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
    """The chain whose closure is refined, its start, and the distance to the second trial."""

    chain: TrialChain
    start: Any
    step: Any


def aimed(chain: TrialChain, start: Any) -> Aim:
    """The start of the secant towards a closure, from its double.

    Near the end of a window, a dyad is stretched flat and doubles do not determine its sign. There,
    the curve of both signs is followed through the end.
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
    """As ``aimed``, where the dyad of a sign is stretched flat a step away from a start."""
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
