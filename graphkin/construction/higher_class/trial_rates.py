"""The rates of two trial plans: round numbers that keep the plans about as large as the result.

The misclosure is linear in the trial rate, so any two rates lead to the same plan. On paper, the
best rates give plans that fit with the right one and points that are well apart.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from math import floor, log10
from typing import Any

from msgspec import Struct

from graphkin.construction.core.kind import constructions
from graphkin.construction.core.program import Program
from graphkin.construction.higher_class.closure_solver import run_settled
from graphkin.construction.higher_class.divided_point import Divided
from graphkin.construction.higher_class.two_trials import TwoTrials
from graphkin.numbers.arithmetic import larger, np, smaller
from graphkin.scene.model import Scene

ROUND = {1.0: 0.0, 1.5: 0.1, 2.0: 0.0, 3.0: 0.05, 4.0: 0.05, 5.0: 0.0, 6.0: 0.05, 8.0: 0.1}
"""First digits of the rates tried, and the penalty of each relative to the roundest."""
APART = 0.45
"""Required distance between the two trials of some point, as a fraction of the right plan."""
LARGER = 1.25
"""Allowed size of the plan with its trials, relative to the right plan alone."""
TOO_LARGE = 2.0
"""Relative size above which less round numbers are also tried."""
WITHIN = (0.15, 0.85)
"""Required range of the right plan's position between its trials."""
BESIDE = 0.75
"""Penalty of a rate with further digits near the right rate, for each trial.

Where the group is nearly singular, a round rate that is not quite the right one moves points far
away.
"""
STEPS = {1.0: 0.0, 2.0: 0.05, 5.0: 0.05}
"""First digits of the steps of which such rates are multiples, and the penalty of each."""
MOVING = 0.8
"""Penalty of a first trial in which the link moves rather than rests."""
FARTHEST = 1.0
"""Largest distance of a rate of zero from the right rate, once the driver has moved on.

The unit is the rate that moves all points by the reach of the right plan.
"""

Array = Any
"""Numbers (N,), or the left, bottom, right and top (4, N) of upright boxes."""


class Spread(Struct, frozen=True):
    """The points of a plan as functions of the trial rate: ``start`` at zero, ``way`` per unit.

    ``rate`` is the right one; ``whole`` is the distance from the pole to the right plan's farthest
    point.
    """

    start: tuple[complex, ...]
    way: tuple[complex, ...]
    rate: float
    whole: float

    def boxes(self, rates: Array) -> Array:
        """The boxes (4, N) of the plans at some rates, each around its points and the pole."""
        start, way = (np.array([0j, *each])[:, None] for each in (self.start, self.way))
        points = start + rates * way
        x, y = points.real, points.imag
        return np.array([x.min(axis=0), y.min(axis=0), x.max(axis=0), y.max(axis=0)])

    @property
    def reach(self) -> float:
        """The largest distance that a unit of the rate moves a point."""
        return max(map(abs, self.way))

    def fault(self, first: Array, second: Array, large: Array) -> Array:
        """The penalty of pairs of trials: too large, too close together, or both on one side."""
        share = (self.rate - first) / (second - first)
        near = APART - abs(second - first) * self.reach / self.whole
        outside = np.maximum(WITHIN[0] - share, share - WITHIN[1])
        faults = (np.maximum(amount, 0.0) for amount in (large - LARGER, near, outside))
        return 3 * sum(faults)


def trial_rates(
    scene: Scene, program: Program, closed: Mapping[int, Any] | None = None
) -> dict[int, float]:
    """The two rates for each pair of trial plans, by the steps that hold them.

    Rates of groups come first. The rates within their trial plans depend on these. ``closed`` holds
    the closings that are known, by step. Raises StepFailed where the mechanism does not close.
    """
    divided = [each.value for each in constructions(program, Divided)]
    wanted = {*divided} & {*program.targets.values()}
    if not wanted:
        return {}
    rates: dict[int, float] = {}
    for together in levels_of(program):
        needed = program.behind(wanted)
        found = run_settled(scene, program, needed, overrides={**(closed or {}), **rates}).values
        for trials in together:
            spread = spread_of(program, found, trials) if trials.share in found else None
            if spread is not None:
                rates |= dict(zip(trials.rates, chosen_rates(spread), strict=True))
    return rates


def spread_of(program: Program, found: Mapping[int, Any], trials: TwoTrials) -> Spread | None:
    """The plans of all rates, from two; None where nothing moves, so that any rate will do."""
    one, two = (found[number] for number in trials.rates)
    start, way, whole = [], [], 0.0
    for point in trials.divided(program):
        if point.value in found:
            first, second = found[point.first], found[point.second]
            way.append((second - first) / (two - one))
            start.append(first - one * way[-1])
            whole = max(whole, abs(found[point.value]))
    if not whole or not any(way):
        return None
    return Spread(tuple(start), tuple(way), one + found[trials.share] * (two - one), whole)


def followed_rates(
    program: Program,
    drawn: Mapping[int, Any],
    chosen: Mapping[int, float],
    run: Callable[[Mapping[int, Any]], Mapping[int, Any]],
) -> dict[int, Any]:
    """The rates at another position of the driver, where trial plans keep their relative size.

    A link at rest in a trial stays at rest if zero is not too far from the right rate. The unit of
    that distance is the rate that moves all points by the reach of the right plan. Otherwise it is
    tried at the largest allowed distance. Other rates keep their distance from the right rate.

    ``drawn`` holds the values where the rates were chosen. ``run`` gives the values at the other
    position from the rates, in any kind of number.
    """
    rates: dict[int, Any] = dict(chosen)
    for together in levels_of(program):
        known = [each for each in together if each.share in drawn and {*each.rates} <= {*chosen}]
        found = run(rates) if known else {}
        for trials in known:
            before, now = (right_rate(program, values, trials) for values in (drawn, found))
            for number in trials.rates:
                beside = (chosen[number] - before[0]) / before[1]
                rates[number] = now[0] + beside * now[1]
                if not chosen[number]:
                    far = larger(abs(beside), FARTHEST) * now[1]
                    rates[number] = larger(now[0] - far, smaller(0.0, now[0] + far))
    return rates


def right_rate(program: Program, found: Mapping[int, Any], trials: TwoTrials) -> tuple[Any, Any]:
    """The right rate, and the rate that moves all points by the reach of the right plan."""
    one, two = (found[number] for number in trials.rates)
    points = [point for point in trials.divided(program) if point.value in found]
    reach = sum(abs(found[point.value]) for point in points)
    moved = sum(abs(found[point.second] - found[point.first]) for point in points)
    return one + found[trials.share] * (two - one), reach * abs(two - one) / moved


def levels_of(program: Program) -> list[list[TwoTrials]]:
    """The pairs of trial plans, those of groups first, then those within their trial plans."""
    levels: dict[int, list[TwoTrials]] = {}
    for trials in constructions(program, TwoTrials):
        levels.setdefault(trials.depth, []).append(trials)
    return [together for _, together in sorted(levels.items())]


def chosen_rates(spread: Spread) -> tuple[float, float]:
    """The two trials that are best to draw and read; in the first, the link rests if it may.

    The numbers are round, unless even the best round ones draw a plan far too large.
    """
    enough = APART * spread.whole / spread.reach
    size = abs(spread.rate) or enough
    worse = {0.0: -MOVING, **dict(candidates(min(size, enough), max(size, enough)))}
    found = best_of(spread, worse)
    if enlarged(spread, *found) > TOO_LARGE:
        for number, amount in beside(spread.rate, enough):
            worse.setdefault(number, amount)
        found = best_of(spread, worse)
    return found


def best_of(spread: Spread, worse: Mapping[float, float]) -> tuple[float, float]:
    """The best two of some rates, given the penalty of each; the first is the smaller."""
    rates, penalties = np.array([*worse]), np.array([*worse.values()])
    first, second = np.nonzero(abs(rates)[:, None] < abs(rates))
    boxes = spread.boxes(rates)
    large = larger_by(spread, boxes[:, first], boxes[:, second])
    fault = spread.fault(rates[first], rates[second], large)
    best = int((fault + penalties[first] + penalties[second]).argmin())
    return float(rates[first[best]]), float(rates[second[best]])


def enlarged(spread: Spread, *rates: float) -> float:
    """The size of the plan with trials at some rates, relative to the right plan alone."""
    return float(larger_by(spread, *(spread.boxes(np.array([rate])) for rate in rates))[0])


def larger_by(spread: Spread, *tried: Array) -> Array:
    """The sizes (N,) of the plan with trials in some boxes (4, N), relative to the right plan."""
    right = spread.boxes(np.array([spread.rate]))
    return longest(right, *tried) / longest(right)


def longest(*boxes: Array) -> Array:
    """The longer side (N,) of the box around some boxes (4, N)."""
    low = np.minimum.reduce([*np.broadcast_arrays(*(each[:2] for each in boxes))])
    high = np.maximum.reduce([*np.broadcast_arrays(*(each[2:] for each in boxes))])
    return (high - low).max(axis=0)


def candidates(least: float, most: float) -> Iterator[tuple[float, float]]:
    """Round numbers of both signs in a range and a little beyond, each with its penalty."""
    for power in range(floor(log10(least)) - 1, floor(log10(most)) + 2):
        for digit, worse in ROUND.items():
            size = digit * 10.0**power if power >= 0 else digit / 10.0**-power
            yield size, worse
            yield -size, worse


def beside(rate: float, enough: float) -> Iterator[tuple[float, float]]:
    """Numbers near a rate, in steps of about ``enough`` and less, each with its penalty."""
    power = floor(log10(enough))
    for digit, worse in STEPS.items():
        for exponent in (power, power - 1):
            below = floor(rate / (digit * 10.0**exponent))
            for count in range(below - 1, below + 3):
                multiple = count * digit
                number = multiple * 10.0**exponent if exponent >= 0 else multiple / 10.0**-exponent
                yield number, BESIDE + worse
