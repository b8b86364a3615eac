"""Where two closures of a group merge: balls decide whether there are two or none.

Beside a merge the misfit is a parabola whose least value is as small as rounding. Its vertex is
found in balls, and the misfit there tells: of another sign than the curvature two closures lie to
both sides, of the same sign none does.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from msgspec import Struct

from graphkin.construction.higher_class.trial import TrialChain
from graphkin.numbers.arithmetic import Kind
from graphkin.numbers.kinds import middle
from graphkin.numbers.plane import cross
from graphkin.numbers.refined_roots import by_secant, proved

NEAR = 1e-3
"""How near closures that merge lie, in radians or parts of their trial value."""
ROUNDS = 40
"""Most steps of Newton's method towards a vertex."""
FINE = 2.0**-12
"""Second trial of a secant beside a vertex, in parts of the way to it."""


class Closing(Struct, frozen=True):
    """One closure: its trial value (rad or m) and the sine of crossing, doubles, or balls where
    balls have found it, and its signs."""

    tried: Any
    signs: tuple[float, ...]
    sine: Any


def closings_of(closures: Any) -> list[Closing]:
    """The closures of the first element as doubles find them."""
    return [closing_of(row) for row in closures.table if row[0] == 0]


def closing_of(row: Any) -> Closing:
    """The closure of a row of a table."""
    return Closing(float(row[1]), tuple(row[2:-1].tolist()), float(row[-1]))


def merged(trying: Any, known: Sequence[Any], closures: Any, kind: Kind) -> list[Closing]:
    """Every closure in order, on known balls, of the first element of closures in doubles.

    Raises ValueError where balls of this kind do not tell whether there are two or none.
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
    """Whether two closures that merge are those of one vertex."""
    return one.signs == other.signs and abs(one.tried - other.tried) < NEAR * size(
        trying, one.tried
    )


def size(trying: Any, tried: Any) -> Any:
    """What lengths of a trial are measured in: a radian, or the trial value itself (m)."""
    return 1 if trying.first.turns else abs(tried) or 1


def both(chain: TrialChain, start: float) -> list[Closing]:
    """The two closures beside a vertex near a start, in order; none where the misfit stays away."""
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
    """The power of a half with a quarter of the bits of balls: a step of differences."""
    from flint import arb, ctx

    return arb(2) ** -(ctx.prec // 4)


def sides(chain: TrialChain, tried: Any, step: Any) -> tuple[Any, Any]:
    """The misfit a step before and a step after a trial value."""
    return chain.misfit(tried - step), chain.misfit(tried + step)


def vertex_near(chain: TrialChain, start: float, step: Any) -> Any:
    """Where the misfit turns back, by Newton's method on its differences."""
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
    """The closure near a start, proved; the other one lies farther away than a step."""
    return proved(chain.misfit, by_secant(chain.middle_misfit, middle(start), step), abs(step))


def sine_of(chain: TrialChain, tried: Any, step: Any) -> Any:
    """Sine of the angle at which the locus crosses what was cut, by differences."""
    before, after = sides(chain, middle(tried), step)
    way = chain.locus(middle(tried) + step) - chain.locus(middle(tried) - step)
    return middle(abs(after - before) / abs(way))


def in_order(chain: TrialChain, low: Any, high: Any) -> bool:
    """Whether the first of two closures has the smaller number: by the first axis that differs."""
    for first, second in zip(chain.axes(low), chain.axes(high), strict=True):
        turn = cross(first, second)
        if turn > 0 or turn < 0:
            return bool(turn > 0)
    raise ValueError("the balls do not tell which of two closures comes first")
