"""Timing of work: seconds per call on one clock, the median of several rounds with quartiles."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from statistics import quantiles
from time import perf_counter
from typing import Any

from msgspec import Struct, field

from graphkin.construction.core.program import Program
from graphkin.construction.core.run import Trace, Values, evaluate, run
from graphkin.numbers.arithmetic import FLOAT

Clock = Callable[[], float]
Work = Callable[[], object]
FEWEST = 5
"""Least number of rounds, even where the work takes longer than ``patience``."""


class Timing(Struct, frozen=True):
    """Seconds of one run: the median of several rounds, and its lower and upper quartiles."""

    median: float
    low: float
    high: float
    rounds: int


class TimedWork(Struct):
    """Work on a number of positions, its calls per round, and the times of the rounds."""

    work: Work
    positions: int
    calls: int = 1
    rounds: int = 0
    seconds: list[float] = field(default_factory=list)

    @property
    def timing(self) -> Timing:
        """Median and quartiles, in seconds per position."""
        low, median, high = quantiles(self.seconds, n=4)
        return Timing(median, low, high, len(self.seconds))


class Stopwatch(Struct, frozen=True):
    """Times work with a replaceable clock, in at most ``rounds`` rounds.

    ``least`` is the shortest duration of a round in seconds, so that the resolution of the clock
    does not matter. ``patience`` is the time for all rounds of one work, in seconds, unless there
    are only ``fewest`` rounds.
    """

    rounds: int = 25
    least: float = 2e-4
    patience: float = 1.0
    fewest: int = FEWEST
    clock: Clock = perf_counter
    say: Callable[[str], None] = lambda words: None

    def times(self, works: Sequence[tuple[Work, int]]) -> list[Timing]:
        """Seconds per position of each work on a number of positions, after one call to warm up.

        A round runs all works in turn, so that other load on the machine affects them equally.
        """
        every = [self.prepared(TimedWork(work, positions)) for work, positions in works]
        for n in range(max((timed.rounds for timed in every), default=0)):
            self.say(f"timing, round {n + 1}")
            for timed in every:
                if n < timed.rounds:
                    seconds = self.seconds(timed.work, timed.calls)
                    timed.seconds.append(seconds / (timed.calls * timed.positions))
        return [timed.timing for timed in every]

    def prepared(self, timed: TimedWork) -> TimedWork:
        """Set the number of calls and rounds of a work."""
        timed.work()
        once = self.seconds(timed.work, 1)
        timed.calls = max(1, round(self.least / max(once, 1e-9)))
        affordable = int(self.patience / max(once * timed.calls, 1e-9))
        timed.rounds = max(2, min(self.rounds, max(affordable, self.fewest)))
        return timed

    def seconds(self, work: Work, calls: int) -> float:
        """The time of all calls together, in seconds."""
        before = self.clock()
        for _ in range(calls):
            work()
        return self.clock() - before


def one_position(program: Program, needed: Sequence[int], values: Values) -> Work:
    """The work of one position: run every needed step."""
    return lambda: run(program, needed, values, FLOAT)


def work_of_steps(trace: Trace, numbers: Sequence[int], values: Values) -> Work:
    """The work of some steps alone, on the values of an earlier trace.

    Steps that the trace left out are left out here too.
    """
    steps, found = trace.program.steps, trace.values
    work = [(steps[number], number) for number in numbers if number in found]
    margins: dict[int, Any] = {}

    def once() -> None:
        for step, number in work:
            evaluate(step, number, found, values, FLOAT, margins)

    return once
