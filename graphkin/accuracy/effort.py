"""How much is measured of what accuracy costs."""

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

    def watch(self, clock: Clock, say: Callable[[str], None]) -> Stopwatch:
        """What measures times with this effort."""
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
"""A few positions, hardly any timing: to try the command, and for its tests."""


# --- the machine on which something was timed, in words -------------------------------------------


LIBRARIES = ("numpy", "numba", "mpmath", "python-flint")
"""Libraries whose speed is measured."""


def machine_words() -> str:
    """Processor, system, and the versions of Python and of the libraries that reckon."""
    cores = os.cpu_count() or 1
    parts = [
        f"{processor()}, {cores} core{'s' if cores > 1 else ''}",
        f"{platform.system()} {platform.machine()}",
        f"Python {sys.version.split()[0]}",
    ]
    return "; ".join([*parts, *(f"{name} {v}" for name in LIBRARIES if (v := version_of(name)))])


def processor(listing: Path = Path("/proc/cpuinfo")) -> str:
    """The name of the processor, as well as the system tells it."""
    try:
        for line in listing.read_text(encoding="utf-8", errors="replace").splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    except OSError:
        pass
    return platform.processor() or platform.machine() or "unknown processor"


def version_of(name: str) -> str:
    """The version of a library; empty where it is not installed."""
    try:
        return version(name)
    except PackageNotFoundError:
        return ""
