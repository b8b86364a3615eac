"""The machine on which something was timed, in words."""

from __future__ import annotations

import os
import platform
import sys
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

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
