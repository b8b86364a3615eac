"""The extent of a study: how many positions, rounds and variants are measured."""

from __future__ import annotations

import os
import platform
import sys
from collections.abc import Callable
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from msgspec import Struct

from graphkin.construction.core.timing import Clock, Stopwatch


class Effort(Struct, frozen=True):
    """The extent of a study: positions compared, rounds of a time, variants of a batch.

    ``timed`` is the number of positions at which decimals and balls are timed. ``drawn`` is the
    number of positions towards a dead point at which a drawing is predicted.

    ``least`` is the least time of a round and ``patience`` the most time for all rounds of one
    method, in seconds. ``groups`` and ``each`` divide the way to a dead point.
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

    def watch(self, clock: Clock, say: Callable[[str], None]) -> Stopwatch:
        """The stopwatch for this effort."""
        return Stopwatch(self.rounds, self.least, self.patience, clock=clock, say=say)


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
"""A few positions with hardly any timing: to try the command, and for its tests."""


# --- the machine on which something was timed, in words -------------------------------------------


LIBRARIES = ("numpy", "numba", "mpmath", "python-flint")
"""The libraries whose speed is measured."""


def machine_words() -> str:
    """Processor, system, and the versions of Python and of the numerical libraries."""
    cores = os.cpu_count() or 1
    parts = [
        f"{processor()}, {cores} core{'s' if cores > 1 else ''}",
        f"{platform.system()} {platform.machine()}",
        f"Python {sys.version.split()[0]}",
    ]
    return "; ".join([*parts, *(f"{name} {v}" for name in LIBRARIES if (v := version_of(name)))])


def processor(listing: Path = Path("/proc/cpuinfo")) -> str:
    """The name of the processor, as far as the system reports it."""
    try:
        for line in listing.read_text(encoding="utf-8", errors="replace").splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    except OSError:
        pass
    return platform.processor() or platform.machine() or "unknown processor"


def version_of(name: str) -> str:
    """The version of a library; empty if it is not installed."""
    try:
        return version(name)
    except PackageNotFoundError:
        return ""
