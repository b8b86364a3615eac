"""How long some work takes: the median of several rounds, and the quartiles beside it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from statistics import quantiles
from time import perf_counter

from msgspec import Struct, field

from graphkin.construction.core.timing import Timing

Clock = Callable[[], float]
FEWEST = 5
"""Rounds of work that alone takes longer than the patience allows."""


class Effort(Struct, frozen=True):
    """How much is measured: positions compared, rounds of a time, variants of a batch.

    ``timed`` are the positions at which decimals and balls are timed, ``drawn`` those on the way to
    a dead point at which a drawing is foretold.

    ``least`` is the time in seconds that a round lasts at least, ``patience`` what all rounds of
    one method may take together; ``groups`` and ``each`` part the way to a dead point.
    """

    places: int = 32
    rounds: int = 25
    variants: int = 20_000
    least: float = 2e-3
    patience: float = 4.0
    groups: int = 24
    each: int = 8
    timed: int = 8
    drawn: int = 12
    compiled: bool = True


QUICK = Effort(
    places=6,
    rounds=3,
    variants=64,
    least=0,
    patience=0.2,
    groups=14,
    each=4,
    timed=1,
    drawn=4,
    compiled=False,
)
"""A few positions, hardly any timing: to try the command, and for its tests."""


Work = Callable[[], object]


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
    """Times work on positions with a clock that tests may replace."""

    effort: Effort
    clock: Clock = perf_counter
    say: Callable[[str], None] = lambda words: None

    def times(self, works: Sequence[tuple[Work, int]]) -> list[Timing]:
        """Seconds a position of each work on so many positions, each done once beforehand.

        A round takes all works in turn, so that what else the machine does meanwhile troubles
        them alike.
        """
        runs = [self.prepared(TimedWork(work, positions)) for work, positions in works]
        for n in range(max((run.rounds for run in runs), default=0)):
            self.say(f"timing, round {n + 1}")
            for run in runs:
                if n < run.rounds:
                    seconds = self.seconds(run.work, run.calls)
                    run.seconds.append(seconds / (run.calls * run.positions))
        return [run.timing for run in runs]

    def prepared(self, run: TimedWork) -> TimedWork:
        """How many calls and rounds a work is worth."""
        run.work()
        once = self.seconds(run.work, 1)
        run.calls = max(1, round(self.effort.least / max(once, 1e-9)))
        affordable = int(self.effort.patience / max(once * run.calls, 1e-9))
        run.rounds = max(2, min(self.effort.rounds, max(affordable, FEWEST)))
        return run

    def seconds(self, work: Work, calls: int) -> float:
        """The time of so many calls together."""
        before = self.clock()
        for _ in range(calls):
            work()
        return self.clock() - before
