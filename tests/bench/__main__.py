"""Benchmarks on request, as ratios within one run: ``python -m tests.bench``.

Every row names what is measured, its time, and how many times that of the plain thing beside it.
"""

from __future__ import annotations

import subprocess
import sys
import timeit
from collections.abc import Callable
from pathlib import Path

import numpy as np

from graphkin.mechanism import load
from graphkin.steps.gather import gathered
from tests.bench import pump_by_formulas as formulas

ROOT = Path(__file__).resolve().parents[2]
VARIANTS = 100_000


def best(work: Callable[[], object], repeat: int = 7) -> float:
    """Shortest time of one call in seconds, among some repetitions of many calls."""
    timer = timeit.Timer(work)
    number, _ = timer.autorange()
    return min(timer.repeat(repeat, number)) / number


def fresh(*arguments: str, repeat: int = 7) -> float:
    """Shortest wall time in seconds of a fresh interpreter with some arguments."""
    command = [sys.executable, *arguments]

    def once() -> None:
        subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.DEVNULL)

    once()
    return min(timeit.repeat(once, number=1, repeat=repeat))


def scalar() -> list[tuple[str, float, float]]:
    """One position: everything the pump has, against a plain function of the same."""
    mechanism = load("pump", n=7)
    plain = best(lambda: formulas.one(7))
    trace, links = mechanism.trace(), mechanism.scene.links
    return [
        ("one position: plain function", plain, plain),
        ("one position: the program, with margins", best(mechanism.trace), plain),
        ("one position: the same as a solution", best(mechanism.solve), plain),
        ("one position: only what is asked", best(lambda: mechanism.solve(asked=True)), plain),
        ("one position: gathering alone", best(lambda: gathered(trace, links)), plain),
    ]


def batch() -> list[tuple[str, float, float]]:
    """Many variants, per variant, against plain numpy of the same, blocked."""
    mechanism = load("pump", n=7)
    n = np.linspace(1, 30, VARIANTS)
    whole = best(lambda: formulas.many(n)) / VARIANTS
    plain = best(lambda: formulas.many_in_blocks(n)) / VARIANTS
    return [
        ("a variant: plain numpy in blocks of 2048", plain, plain),
        ("a variant: plain numpy at once", whole, plain),
        ("a variant: the program", best(lambda: mechanism.batch(n=n)) / VARIANTS, plain),
        (
            "a variant: the program with margins",
            best(lambda: mechanism.batch(n=n, margins=True)) / VARIANTS,
            plain,
        ),
        (
            "a variant: the program, only what is asked",
            best(lambda: mechanism.batch(n=n, asked=True)) / VARIANTS,
            plain,
        ),
    ]


def start() -> list[tuple[str, float, float]]:
    """A cold start, against an interpreter that does nothing."""
    bare = fresh("-c", "pass")
    return [
        ("start: python -c pass", bare, bare),
        ("start: import graphkin", fresh("-c", "import graphkin"), bare),
        ("start: graphkin solve pump", fresh("-m", "graphkin", "solve", "pump"), bare),
    ]


def page() -> list[tuple[str, float, float]]:
    """A page, against matplotlib drawing as many lines: to be added here."""
    return []


def in_words(seconds: float) -> str:
    """A time with its unit."""
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6)):
        if seconds >= size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds * 1e9:.3g} ns"


def table() -> str:
    """All rows as one text."""
    lines = []
    for rows in (scalar(), batch(), start(), page()):
        lines += [
            f"{name:46} {in_words(seconds):>10} {seconds / plain:8.2f} ×"
            for name, seconds, plain in rows
        ]
    return "\n".join(lines)


if __name__ == "__main__":
    print(table())
