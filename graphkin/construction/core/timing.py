"""How long work takes: seconds of one call on one clock, the median of some rounds with quartiles.

One position means a run of the steps that targets need, on given values, with nothing kept.
"""

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
"""Rounds of work that alone takes longer than the patience allows."""


class Timing(Struct, frozen=True):
    """Seconds of one run: the median of some rounds, and the quartiles on either side of it."""

    median: float
    low: float
    high: float
    rounds: int


class TimedWork(Struct):
    """Work on so many positions, how often it is done in a round, and the rounds' times."""

    work: Work
    positions: int
    calls: int = 1
    rounds: int = 0
    seconds: list[float] = field(default_factory=list)

    @property
    def timing(self) -> Timing:
        """Median and quartiles, in seconds a position."""
        low, median, high = quantiles(self.seconds, n=4)
        return Timing(median, low, high, len(self.seconds))


class Stopwatch(Struct, frozen=True):
    """Times work with a clock that tests may replace, in at most so many ``rounds``.

    ``least`` is the time in seconds that a round lasts at least, so that the clock's own step does
    not count; ``patience`` is what all rounds of one work may take together, if there are more than
    the ``fewest``.
    """

    rounds: int = 25
    least: float = 2e-4
    patience: float = 1.0
    fewest: int = FEWEST
    clock: Clock = perf_counter
    say: Callable[[str], None] = lambda words: None

    def times(self, works: Sequence[tuple[Work, int]]) -> list[Timing]:
        """Seconds a position of each work on so many positions, each done once beforehand.

        A round takes all works in turn, so that what else the machine does meanwhile troubles
        them alike.
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
        """How many calls and rounds a work is worth."""
        timed.work()
        once = self.seconds(timed.work, 1)
        timed.calls = max(1, round(self.least / max(once, 1e-9)))
        affordable = int(self.patience / max(once * timed.calls, 1e-9))
        timed.rounds = max(2, min(self.rounds, max(affordable, self.fewest)))
        return timed

    def seconds(self, work: Work, calls: int) -> float:
        """The time of so many calls together."""
        before = self.clock()
        for _ in range(calls):
            work()
        return self.clock() - before


def one_position(program: Program, needed: Sequence[int], values: Values) -> Work:
    """The work of one position: every needed step anew."""
    return lambda: run(program, needed, values, FLOAT)


def work_of_steps(trace: Trace, numbers: Sequence[int], values: Values) -> Work:
    """The work of some steps alone, on what a trace found before them.

    Steps that the trace had to leave out are left out here too.
    """
    steps, found = trace.program.steps, trace.values
    work = [(steps[number], number) for number in numbers if number in found]
    margins: dict[int, Any] = {}

    def once() -> None:
        for step, number in work:
            evaluate(step, number, found, values, FLOAT, margins)

    return once
