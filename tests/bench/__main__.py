"""Benchmarks on request, as ratios within one run: ``python -m tests.bench``.

Every row names what is measured, its time, and how many times that of the plain thing beside it.
``python -m tests.bench.effects``, ``.motion`` and ``.chain`` print their parts alone.
"""

from __future__ import annotations

import subprocess
import sys
import timeit
from collections.abc import Callable
from functools import partial
from pathlib import Path
from statistics import median

import numpy as np

from graphkin.arithmetic import batch_kind
from graphkin.handout import drawings_of, proved
from graphkin.mechanism import Mechanism, load
from graphkin.paper.drawing import Drawing
from graphkin.paper.pdf import write_pdf
from graphkin.paper.sheet import sheet
from graphkin.paper.svg import write_svg
from graphkin.steps.batch import run_blocks
from graphkin.steps.gather import gathered
from graphkin.steps.run import Trace
from graphkin.text import words
from tests.bench import chain, effects, motion
from tests.bench import pump_by_formulas as formulas
from tests.bench.page_by_matplotlib import both_files

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


SAME = (
    *((what, point) for what in ("position", "velocity", "acceleration") for point in "ABCD"),
    *((what, link) for what in ("omega", "epsilon") for link in "1234"),
    *((what, link) for what in ("centre", "pole") for link in "34"),
)
"""The quantities that the plain formulas give."""


def same_quantities(mechanism: Mechanism, n: np.ndarray) -> Trace:
    """The program, run step by step for just what the plain formulas give."""
    program = mechanism.program
    keep = [program.targets[target] for target in SAME]
    with np.errstate(all="ignore"):
        return run_blocks(program, program.needed(SAME), {"n": n}, batch_kind(), keep)


def batch() -> list[tuple[str, float, float]]:
    """Many variants, per variant, against plain numpy of the same, blocked."""
    mechanism = load("pump", n=7)
    n = np.linspace(1, 30, VARIANTS)
    whole = best(lambda: formulas.many(n)) / VARIANTS
    plain = best(lambda: formulas.many_in_blocks(n)) / VARIANTS
    return [
        ("a variant: plain numpy in blocks of 2048", plain, plain),
        ("a variant: plain numpy at once", whole, plain),
        (
            "a variant: step by step, the same quantities",
            best(lambda: same_quantities(mechanism, n)) / VARIANTS,
            plain,
        ),
        (
            "a variant: emitted, all quantities",
            best(lambda: mechanism.batch(n=n)) / VARIANTS,
            plain,
        ),
        (
            "a variant: all quantities and margins",
            best(lambda: mechanism.batch(n=n)) / VARIANTS,
            plain,
        ),
        (
            "a variant: only what the scene asks",
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
    """A whole page, layout, SVG and PDF, against plain matplotlib artists of the same marks.

    The layout is the median over the students' numbers 1 to 30: pages are not equally crowded.
    """
    every = [drawings_for(n) for n in range(1, 31)]
    rows = []
    for which, drawing in enumerate(every[14]):
        made = sheet(drawing, "key", "1/2")
        plain = best(partial(both_files, made), repeat=3)
        layouts = [once_warm(partial(sheet, drawings[which], "key", "1")) for drawings in every]
        rows += [
            (f"{drawing.kind} page: matplotlib artists", plain, plain),
            (f"{drawing.kind} page: layout, median of 30", median(layouts), plain),
            (f"{drawing.kind} page: layout, the slowest", max(layouts), plain),
            (f"{drawing.kind} page: SVG", best(partial(write_svg, made)), plain),
            (f"{drawing.kind} page: PDF", best(partial(write_pdf, (made,))), plain),
        ]
    return rows


def drawings_for(n: int) -> list[Drawing]:
    """What the two sheets of a student are drawn from."""
    mechanism = load("pump", n=n)
    return drawings_of(mechanism, proved(mechanism, mechanism.solve()), words("ro"))


def once_warm(work: Callable[[], object]) -> float:
    """Shortest of three calls in seconds."""
    return min(timeit.repeat(work, number=1, repeat=3))


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
    return "\n".join([*lines, "", effects.table(), "", motion.table(), "", chain.table()])


if __name__ == "__main__":
    print(table())
