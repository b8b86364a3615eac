"""Benchmarks on request, as ratios within one run: ``python -m tests.bench``.

Every row names what is measured, its time, and how many times that of the plain thing beside it.
``python -m tests.bench.motion`` (or ``.chain .start .variants .printing .screen``) prints
one part alone.
"""

from __future__ import annotations

import timeit
from collections.abc import Callable
from functools import partial
from pathlib import Path
from statistics import median

import numpy as np
from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.run import Trace, run_blocks
from graphkin.construction.core.solution import gathered
from graphkin.documents.scaling import sheet_motion
from graphkin.documents.sheet import sheet
from graphkin.documents.sheet_documents import drawings_of, proved
from graphkin.drawing.marks import Page
from graphkin.mechanism import Mechanism, load
from graphkin.numbers.arithmetic import batch_kind
from graphkin.scene.model import Ask
from graphkin.text import words
from graphkin.writers.pdf import write_pdf
from graphkin.writers.svg import write_svg
from tests.bench import chain, motion, printing, screen, start, variants
from tests.bench import pump_by_formulas as formulas
from tests.bench.page_by_matplotlib import both_files

ROOT = Path(__file__).resolve().parents[2]
SCENES = sorted((ROOT / "examples" / "scenes").glob("*.toml"))
VARIANTS = 100_000
LIMIT = 0.025
"""Seconds that a page of up to 60 labels may take, for layout and SVG and again for PDF."""


USUAL = 1.2
"""How many times its shortest time a plain loop may take on a machine that is not disturbed."""


def best(work: Callable[[], object], repeat: int = 7) -> float:
    """Shortest time of one call in seconds, among some repetitions of many calls."""
    timer = timeit.Timer(work)
    number, _ = timer.autorange()
    return min(timer.repeat(repeat, number)) / number


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


def checking() -> list[tuple[str, float, float]]:
    """The independent check of one velocity and of everything, against the solve of that velocity.

    Both keep what they had last; first without that, then with it, then of a mechanism that has
    just been read.
    """
    scene = load("pump", n=7).scene
    one = Mechanism(replace(scene, ask=Ask(velocity=("D",))))
    some, every = one.solve(asked=True), one.solve()
    one.witness(some), one.witness(every)

    def forget() -> None:
        one.drawings.clear()
        for part in (one.check.whole, *one.check.parts.values()):
            part.closed.clear()

    def after(work: Callable[[], object]) -> float:
        return best(lambda: (forget(), work())) - best(forget)

    def new() -> Mechanism:
        return Mechanism(one.scene)

    anew, kept = after(lambda: one.solve(asked=True)), best(lambda: one.solve(asked=True))
    first = best(lambda: new().solve(asked=True))
    return [
        ("one velocity: solved anew", anew, anew),
        ("one velocity: checked anew", after(lambda: one.witness(some)), anew),
        ("everything: checked anew", after(lambda: one.witness(every)), anew),
        ("one velocity: solved again", kept, kept),
        ("everything: solved again", best(one.solve), kept),
        ("one velocity: checked again", best(lambda: one.witness(some)), kept),
        ("one velocity: solved by a new mechanism", first, first),
        ("everything: solved by a new mechanism", best(lambda: new().solve()), first),
        ("one velocity: checked by a new mechanism", best(lambda: new().witness(some)), first),
        ("everything: checked by a new mechanism", best(lambda: new().witness(every)), first),
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


def page() -> list[tuple[str, float, float]]:
    """Whole pages, layout with SVG and PDF apart, against plain matplotlib artists of their marks.

    Pages are not equally crowded: the median is over the students' numbers 1 to 30, and over the
    pages of the examples by the number of labels that had to find a place.
    """
    students = [drawings_for(load("pump", n=n)) for n in range(1, 31)]
    sets = {f"{d.kind} page": [every[k] for every in students] for k, d in enumerate(students[0])}
    examples = [d for path in SCENES for d in drawings_for(load(str(path)))]
    for least, most in ((1, 30), (31, 60)):
        some = [d for d in examples if least <= labels(sheet(d, "key", "1/2")) <= most]
        sets[f"examples, {least} to {most} labels"] = some
    return [row for name, drawings in sets.items() for row in pages_of(name, drawings)]


def pages_of(name: str, drawings: list[Drawing]) -> list[tuple[str, float, float]]:
    """Median and slowest of some pages, beside matplotlib's time for the one in the middle."""
    made = sorted((sheet(drawing, "key", "1/2")[0] for drawing in drawings), key=labels)
    middle = made[len(made) // 2]
    plain = in_turn([partial(both_files, middle)], enough=1, most=6)[0]
    svg = in_turn([partial(laid_out, drawing) for drawing in drawings])
    pdf = in_turn([partial(write_pdf, (one,)) for one in made])
    return [
        (f"{name}: matplotlib, {labels(middle)} labels", plain, plain),
        (f"{name}: layout + SVG, median", median(svg), plain),
        (f"{name}: layout + SVG, the slowest", max(svg), plain),
        (f"{name}: PDF, median", median(pdf), plain),
        (f"{name}: PDF, the slowest", max(pdf), plain),
        (f"{name}: limit of each for 60 labels", LIMIT, plain),
    ]


def labels(made: Page) -> int:
    """How many labels of a page had to find a place."""
    return sum(mark.cls.split()[0] == "label" for mark in made.marks)


def laid_out(drawing: Drawing) -> str:
    """The layout of a page and its SVG file."""
    return write_svg(sheet(drawing, "key", "1/2")[0])


def drawings_for(mechanism: Mechanism) -> list[Drawing]:
    """What the sheets of a mechanism are drawn from."""
    return drawings_of(mechanism, proved(mechanism, sheet_motion(mechanism)), words("ro"))


def in_turn(works: list[Callable[[], object]], enough: int = 2, most: int = 24) -> list[float]:
    """Shortest seconds of each of some works, done one after another so that none comes twice.

    Machines that are shared run at half their speed at times: rounds go on until each work was
    done so often with a plain loop before and after it that took no longer than usual, and only
    such times count. Where there are none, all of them count.
    """
    loop = partial(sum, range(40_000))
    found: list[list[tuple[float, float]]] = [[] for _ in works]
    for work in works:
        work()
    for _ in range(most):
        for work, taken in zip(works, found, strict=True):
            before, time, after = (timeit.timeit(each, number=1) for each in (loop, work, loop))
            taken.append((max(before, after), time))
        usual = USUAL * min(beside for taken in found for beside, _ in taken)
        calm = [[time for beside, time in taken if beside < usual] for taken in found]
        if all(len(times) >= enough for times in calm):
            break
    both = zip(calm, found, strict=True)
    return [min(times or [time for _, time in taken]) for times, taken in both]


def in_words(seconds: float) -> str:
    """A time with its unit."""
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6)):
        if seconds >= size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds * 1e9:.3g} ns"


def table() -> str:
    """All rows as one text."""
    lines = []
    for rows in (scalar(), checking(), batch(), page()):
        lines += [
            f"{name:46} {in_words(seconds):>10} {seconds / plain:8.2f} ×"
            for name, seconds, plain in rows
        ]
    return "\n".join(
        [
            *lines,
            *("", motion.table(), "", chain.table()),
            *("", start.table(), "", variants.table(), "", printing.table(), "", screen.table()),
        ]
    )


if __name__ == "__main__":
    print(table())
