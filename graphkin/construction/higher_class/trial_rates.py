"""What two trial plans are drawn with: round numbers that keep them about as large as the result.

What a trial misses grows in proportion to what was tried, so any two rates lead to the same plan.
On paper those serve best whose plans fit beside the right one and whose points stand well apart.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from itertools import product
from math import floor, log10
from typing import Any

from msgspec import Struct

from graphkin.construction.core.kind import constructions
from graphkin.construction.core.program import Program
from graphkin.construction.higher_class.closure_solver import run_settled
from graphkin.construction.higher_class.divided_point import Divided
from graphkin.construction.higher_class.two_trials import TwoTrials
from graphkin.numbers.arithmetic import larger, smaller
from graphkin.scene.model import Scene

ROUND = {1.0: 0.0, 1.5: 0.1, 2.0: 0.0, 3.0: 0.05, 4.0: 0.05, 5.0: 0.0, 6.0: 0.05, 8.0: 0.1}
"""First digits of the numbers that are tried, and what each is worse than the roundest."""
APART = 0.45
"""How far apart, in parts of the right plan, some point of the two trials shall stand."""
LARGER = 1.25
"""How much larger than the right plan alone it may be with its trials."""
TOO_LARGE = 2.0
"""The same from which numbers are looked for that are less round."""
WITHIN = (0.15, 0.85)
"""Where between its trials the right plan shall lie."""
BESIDE = 0.75
"""What a number of further digits beside the right rate is worse than a round one, for each trial.

Where the group hardly holds, a round rate that is not just the right one moves points far away.
"""
STEPS = {1.0: 0.0, 2.0: 0.05, 5.0: 0.05}
"""First digits of the steps of which such numbers are multiples, and what each is worse."""
MOVING = 0.8
"""What a first trial is worse in which the link moves than one in which it is at rest."""
FARTHEST = 1.0
"""How far from the right rate a link may be at rest in a trial, in parts of the rate that moves all
points as far as the right plan reaches, where the driver has moved on."""

Box = tuple[float, float, float, float]
"""Left, bottom, right and top of the upright box around some points and the pole."""


class Spread(Struct, frozen=True):
    """The points of a plan by the rate that is tried: ``start`` at nought, ``way`` for each unit.

    ``rate`` is the right one, ``whole`` how far the right plan reaches from its pole.
    """

    start: tuple[complex, ...]
    way: tuple[complex, ...]
    rate: float
    whole: float

    def box(self, rate: float) -> Box:
        """The box of the plan of a rate."""
        points = [0j, *(p + rate * w for p, w in zip(self.start, self.way, strict=True))]
        xs, ys = [p.real for p in points], [p.imag for p in points]
        return min(xs), min(ys), max(xs), max(ys)

    @property
    def reach(self) -> float:
        """How far a unit of the rate moves the point that it moves farthest."""
        return max(map(abs, self.way))

    def fault(self, first: float, second: float, large: float) -> float:
        """How badly two trials are drawn and read: too large, too near, both on one side."""
        share = (self.rate - first) / (second - first)
        near = APART - abs(second - first) * self.reach / self.whole
        outside = max(WITHIN[0] - share, share - WITHIN[1])
        return 3 * sum(max(amount, 0.0) for amount in (large - LARGER, near, outside))


def trial_rates(scene: Scene, program: Program) -> dict[int, float]:
    """The two rates for each pair of trial plans, by the steps that hold them: those of a group
    first, then those within its trial plans, which are as large as these make them.

    Raises StepFailed where the mechanism does not close.
    """
    divided = [each.value for each in constructions(program, Divided)]
    wanted = {*divided} & {*program.targets.values()}
    if not wanted:
        return {}
    rates: dict[int, float] = {}
    for together in levels_of(program):
        needed = program.behind(wanted)
        found = run_settled(scene, program, needed, overrides={**rates}).values
        for trials in together:
            spread = spread_of(program, found, trials) if trials.share in found else None
            if spread is not None:
                rates |= dict(zip(trials.rates, chosen_rates(spread), strict=True))
    return rates


def spread_of(program: Program, found: Mapping[int, Any], trials: TwoTrials) -> Spread | None:
    """The plans of all rates, from two of them; None where nothing moves, so that any rate does."""
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
    """The rates at another place of the driver: trial plans keep their size beside the right one.

    A link at rest in a trial stays at rest where that is not too far from the right rate, measured
    by the rate that moves all points as far as the right plan reaches; elsewhere it is tried at
    this distance. Another rate is as far from the right one as before. ``drawn`` are the values
    where the rates were chosen, ``run`` gives those at the other place by the rates, in any kind
    of number.
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
    """The rate that fits, and the one that moves all points as far as the right plan reaches."""
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
    """The two trials that can be drawn and read best, the link at rest in the first if it may.

    Round numbers, unless even the best of these draw a plan far too large.
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
    """The best two of some rates, each with what it is worse."""
    faults = {}
    for first, second in product(worse, worse):
        if abs(first) < abs(second):
            fault = spread.fault(first, second, enlarged(spread, first, second))
            faults[first, second] = fault + worse[first] + worse[second]
    return min(faults, key=lambda pair: faults[pair])


def enlarged(spread: Spread, *rates: float) -> float:
    """How much larger than the right plan alone it is with the trials of some rates."""
    right = spread.box(spread.rate)
    return longest(right, *map(spread.box, rates)) / longest(right)


def longest(*boxes: Box) -> float:
    """The longer side of the box around some boxes."""
    left, bottom, right, top = zip(*boxes, strict=True)
    return float(max(max(right) - min(left), max(top) - min(bottom)))


def candidates(least: float, most: float) -> Iterator[tuple[float, float]]:
    """Round numbers of both signs in a range and a little beyond, each with what it is worse."""
    for power in range(floor(log10(least)) - 1, floor(log10(most)) + 2):
        for digit, worse in ROUND.items():
            size = digit * 10.0**power if power >= 0 else digit / 10.0**-power
            yield size, worse
            yield -size, worse


def beside(rate: float, enough: float) -> Iterator[tuple[float, float]]:
    """Numbers on both sides of a rate, in steps of about ``enough`` and less, each with what it is
    worse."""
    power = floor(log10(enough))
    for digit, worse in STEPS.items():
        for exponent in (power, power - 1):
            below = floor(rate / (digit * 10.0**exponent))
            for count in range(below - 1, below + 3):
                multiple = count * digit
                number = multiple * 10.0**exponent if exponent >= 0 else multiple / 10.0**-exponent
                yield number, BESIDE + worse
