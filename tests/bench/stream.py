"""Ten million variants streamed to a reducer: time a variant, and the memory of the process.

``python -m tests.bench.stream`` prints it; the peers are one variant of a plain batch, and the
limit of 200 MB that the stream has to keep.
"""

from __future__ import annotations

import subprocess
import sys
import timeit
from pathlib import Path

import numpy as np

from graphkin import load

ROOT = Path(__file__).resolve().parents[2]
VARIANTS = 10_000_000
LIMIT = 200.0
"""Megabytes."""
WORK = f"""
import re, time
import numpy as np
from graphkin import load
pump, n = load("pump"), np.linspace(1, 30, {VARIANTS})
start, largest = time.perf_counter(), 0.0
for block in pump.stream(n=n, asked=True):
    largest = max(largest, float(np.nanmax(abs(block.points["D"].acceleration))))
with open("/proc/self/status") as status:
    held = re.search(r"VmHWM:\\s+(\\d+)", status.read())
print(time.perf_counter() - start, int(held[1]) / 1024)
"""


def measured() -> tuple[float, float]:
    """Seconds a variant, and megabytes at most, in a process of its own (Linux).

    Not by getrusage, whose maximum a process inherits from the one that starts it.
    """
    result = subprocess.run(
        [sys.executable, "-c", WORK], cwd=ROOT, check=True, capture_output=True, text=True
    )
    seconds, megabytes = map(float, result.stdout.split())
    return seconds / VARIANTS, megabytes


def main() -> None:
    """Print the rows."""
    pump, n = load("pump"), np.linspace(1, 30, 100_000)
    pump.batch(n=n, asked=True)
    plain = min(timeit.repeat(lambda: pump.batch(n=n, asked=True), number=1, repeat=5)) / len(n)
    seconds, megabytes = measured()
    print(f"a variant of ten million, streamed: {seconds * 1e6:.3f} µs, ", end="")
    print(f"{seconds / plain:.2f} × one of a batch of 100 000")
    print(
        f"memory at most: {megabytes:.0f} MB, {megabytes / LIMIT:.2f} × the limit of {LIMIT:g} MB"
    )


if __name__ == "__main__":
    main()
