"""What some steps of a program cost on one scene: they alone are run, again and again."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from statistics import quantiles
from time import perf_counter
from typing import Any

from msgspec import Struct

from graphkin.construction.core.run import Trace, Values, evaluate
from graphkin.numbers.arithmetic import FLOAT

ROUNDS = (5, 25)
"""Rounds of which the median is taken: at least, at most."""
LONGEST = 1.0
"""Seconds after which no more than the least rounds are made."""
LEAST = 2e-4
"""Seconds that a round lasts at least, so that the clock's own step does not count."""


class Timing(Struct, frozen=True):
    """Seconds of one run: the median of some rounds, and the quartiles on either side of it."""

    median: float
    low: float
    high: float
    rounds: int


def time_of_steps(trace: Trace, numbers: Sequence[int], values: Values) -> Timing:
    """The time that some steps alone take, on what a trace found before them.

    Steps that the trace had to leave out are left out here too.
    """
    steps, found = trace.program.steps, trace.values
    work = [(steps[number], number) for number in numbers if number in found]
    margins: dict[int, Any] = {}

    def once() -> None:
        for step, number in work:
            evaluate(step, number, found, values, FLOAT, margins)

    return timing(once)


def timing(work: Callable[[], object]) -> Timing:
    """The time of one call: a round calls so often that it lasts a while; fewer rounds if slow."""
    work()
    before = perf_counter()
    work()
    once = max(perf_counter() - before, 1e-9)
    calls, (fewest, most) = max(1, round(LEAST / once)), ROUNDS
    rounds = max(fewest, min(most, int(LONGEST / once)))
    seconds = []
    for _ in range(rounds):
        before = perf_counter()
        for _ in range(calls):
            work()
        seconds.append((perf_counter() - before) / calls)
    low, median, high = quantiles(seconds, n=4)
    return Timing(median, low, high, rounds)
