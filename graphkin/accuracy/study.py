"""The whole comparison for one scene: methods, and errors on the way to a dead point."""

from __future__ import annotations

import os
import platform
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from importlib.metadata import version
from importlib.util import find_spec
from itertools import chain
from math import isfinite, log10
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Any

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from graphkin.accuracy.comparison import (
    Approach,
    ComparedTargets,
    Ground,
    Reference,
    answers_of,
    approach,
    ground_of,
    places_around,
    reference_of,
    rows_of,
)
from graphkin.accuracy.methods import (
    Effort,
    Method,
    MethodRow,
    batch_work,
    other_methods,
    own_methods,
)
from graphkin.accuracy.pencil import Forecast, Pencil, forecast, original
from graphkin.construction.core.quantities import KINDS
from graphkin.construction.core.timing import Clock, Stopwatch
from graphkin.drawing.scale import Scales
from graphkin.mechanism import Mechanism
from graphkin.motion.course import Reals
from graphkin.text.errors import GraphkinError
from graphkin.text.tables import Say
from graphkin.writers import plot_style
from graphkin.writers.plot_style import (
    COLOURS,
    FAINT,
    INK,
    PALE,
    figure_title,
    footnote,
    legend,
    new_figure,
    panel_heading,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


# --- errors while a crossing grows flat -----------------------------------------------------------


LAW = (-1.0, -2.0, -3.0)
"""The theoretical slopes of the errors in position, velocity and acceleration."""
UNIT = {"float64": 2.0**-52, "float32": 2.0**-23}
"""The relative distance of neighbouring numbers of each kind."""
TAKES_HOLD = 0.2
"""The sine of crossing below which the errors follow the law."""
ABOVE = 10.0
"""A slope is measured above this multiple of the unit's root; below, no digit is left."""
FALLEN = 0.1
"""A crossing grows flat if its sine falls below this share of its largest."""
LOST = 0.1
"""An error above this is not rounding: the answer is lost."""


class Flattening(Struct, frozen=True, eq=False):
    """Errors (G, 3) in groups of equal sines (G,), by kind of number; NaN where a kind fails.

    ``reference`` holds the positions. ``roots`` (G,) are the roots of the distances from the end,
    as shares of the farthest: at a dead point a sine falls as the root does.
    """

    approach: Approach
    reference: Reference
    sines: Reals
    roots: Reals
    errors: Mapping[str, Reals]

    @property
    def has_end(self) -> bool:
        """Whether the driver was moved towards a dead point or change point."""
        return self.approach.end != "range"

    @property
    def falls(self) -> bool:
        """Whether the flattest crossing really grows flat at the end.

        A group of higher class may reach its dead point without a flat crossing.
        """
        return bool(self.sines.min() < FALLEN * self.sines.max())

    @property
    def measure(self) -> Reals:
        """The variable against which errors are plotted: the sine, or else the root (G,)."""
        return self.sines if self.falls else self.roots

    def slopes(self, kind: str) -> tuple[float | None, ...]:
        """The logarithmic slope of each error of a kind over the measure; None if unknown.

        Places at the start of the way, where another crossing is as flat, are left out.
        """
        least = ABOVE * UNIT[kind] ** 0.5
        near = self.measure <= self.measure.max() / 2
        measure, errors = self.measure[near], self.errors[kind][near]
        return tuple(slope(measure, errors[:, n], least) for n in range(3))


def flattened(approach: Approach, answers: ComparedTargets) -> Flattening:
    """The errors of doubles and of single precision on the way to a dead point."""
    reference = reference_of(approach.places, answers)
    group = np.asarray(approach.group)[list(reference.kept)]
    program, count = approach.places.course.program, len(reference.places.at)
    values = reference.places.repeated(count)
    errors = {}
    for kind in UNIT:
        columns = batch_work(program, answers.every, values, kind, "steps")()
        missed = reference.missed(rows_of(columns, count))
        errors[kind] = in_groups(missed / units_of(reference.sizes), group)
    sines = in_groups(reference.sines[:, None], group, np.median)[:, 0]
    roots = in_groups(roots_of(approach, reference)[:, None], group, np.median)[:, 0]
    return Flattening(approach, reference, sines, roots, errors)


def roots_of(approach: Approach, reference: Reference) -> Reals:
    """The root of each position's distance from the end, as a share of the farthest.

    All ones if there is no end.
    """
    if approach.goal is None:
        return np.ones(len(reference.places.at))
    far = np.abs(approach.places.at - approach.goal)
    return np.asarray(np.sqrt(far[list(reference.kept)] / far.max()))


def units_of(sizes: Reals) -> Reals:
    """Largest distance L, largest speed v, and v²/L of each position, (P, 3)."""
    length, speed = sizes[:, 0], sizes[:, 1]
    units = np.stack([length, speed, speed**2 / np.where(length > 0, length, 1)], axis=1)
    return np.where(units > 0, units, 1.0)


def in_groups(rows: Reals, group: Reals, of: Callable[..., Reals] = np.max) -> Reals:
    """One row for each group: the largest of its rows, or the result of ``of``."""
    return np.array([of(rows[group == each], axis=0) for each in np.unique(group)])


def slope(sines: Reals, errors: Reals, least: float) -> float | None:
    """The logarithmic slope of errors over sines above ``least``; None for too few points."""
    sure = (sines > least) & (sines < TAKES_HOLD) & (errors > 0) & (errors < LOST)
    if np.count_nonzero(sure) < 4 or np.ptp(np.log10(sines[sure])) < 1:
        return None
    return float(np.polyfit(np.log10(sines[sure]), np.log10(errors[sure]), 1)[0])


# --- the pencil compared with the numbers ---------------------------------------------------------


PENCILS = (0.5, 0.25, 0.1)
"""The distances in mm within which 95 of 100 marks lie."""
FINE = 0.25
"""The pencil shown where a crossing grows flat, in mm."""
NEAREST = 1e-3
"""The distance of the last position of that pencil, as a share of the first."""


def pencil_rows(mechanism: Mechanism, reference: Reference, scales: Scales) -> Iterator[MethodRow]:
    """Three pencils at the scene's own position, at the scales of its sheets."""
    note = "95 of 100 drawings of the scene's own position are off by less; a person's hour"
    for point in PENCILS:
        name = f"pencil, {point:g} mm"
        try:
            exact = original(mechanism, scales, reference.answers.every)
            worst = worst_of(forecast(exact, Pencil(point)), reference.answers)
        except GraphkinError as error:
            note = f"cannot be drawn: {error.problems[0]}"
            yield MethodRow("pencil", name, (None, None, None), None, note=note)
            continue
        first, second, third = (float(each) for each in worst / reference.scales)
        yield MethodRow("pencil", name, (first, second, third), None, note=note)


def worst_of(found: Forecast, answers: ComparedTargets) -> Reals:
    """The largest expected error of each quantity, in SI (3,); zero if nothing is drawn."""
    known = found.index
    return np.array(
        [
            max((known[target].error for target in some if target in known), default=0.0)
            for some in answers.targets
        ]
    )


def pencilled(
    ground: Ground, answers: ComparedTargets, scales: Scales, flattening: Flattening, drawn: int
) -> tuple[Reals, Reals]:
    """Measures (G,) and errors (G, 3) of a fine pencil at ``drawn`` places towards a dead point.

    A measure is that of the flattening, or the driver's position over a range. The velocity plan is
    drawn as large as at the first position: kv grows with the velocities. An error is infinite
    where more than one in twenty drawings do not close.
    """
    way = approach(ground, drawn, 1, NEAREST)
    reference = reference_of(way.places, answers)
    units, course = units_of(reference.sizes), way.places.course
    first = reference.sizes[0, 1]
    measure = reference.sines if flattening.falls else roots_of(way, reference)
    measure = reference.places.at if way.goal is None else measure
    measures, errors = [], []
    for row, at in enumerate(reference.places.at):
        growth = float(reference.sizes[row, 1] / first) if first else 1.0
        paper = replace(scales, seconds=scales.seconds / growth)
        here = Mechanism(course.standing(float(at)))
        try:
            exact = original(here, paper, reference.answers.every)
            worst = worst_of(forecast(exact, Pencil(FINE)), reference.answers)
        except GraphkinError:
            continue
        measures.append(measure[row])
        errors.append(worst / units[row])
    return np.array(measures), np.array(errors).reshape(-1, 3)


# --- the whole comparison ------------------------------------------------------------------------


class Study(Struct, frozen=True, eq=False):
    """The results for a scene.

    ``flattening`` is None if the driver cannot move, or nothing on the way can be certified.
    ``pencil`` holds measures (G,) and errors (G, 3) of a pencil on that way.
    """

    mechanism: Mechanism
    reference: Reference
    rows: tuple[MethodRow, ...]
    flattening: Flattening | None
    pencil: tuple[Reals, Reals]

    def row(self, method: str) -> MethodRow:
        return next(row for row in self.rows if row.method == method)


def study(
    mechanism: Mechanism,
    scales: Scales | None,
    effort: Effort | None = None,
    *,
    say: Say = lambda words: None,
    clock: Clock = perf_counter,
) -> Study:
    """Compare every method on one scene; ``say`` receives the name of each task.

    ``scales`` are those of the scene's sheets, for the pencil, which is left out without them.
    Raises ClosureError if the scene does not close, WitnessError if nothing can be certified.
    """
    effort = effort or Effort()
    watch = effort.watch(clock, say)
    say("positions and certified reference")
    ground = ground_of(mechanism.scene)
    answers = answers_of(ground.sweep.scene, ground.piece.course.program)
    reference = reference_of(places_around(ground, effort.places), answers)
    methods = []
    for method in chain(own_methods(reference, effort), other_methods(reference, effort)):
        say(method.row.method)
        methods.append(method)
    rows = timed(methods, watch)
    if scales is not None:
        say("the pencil")
        rows += pencil_rows(mechanism, reference, scales)
    say("the way to a dead point")
    flattening, pencil = None, (np.array([]), np.zeros((0, 3)))
    try:
        flattening = flattened(approach(ground, effort.groups, effort.each), answers)
    except GraphkinError:
        say("no way to a dead point")
    if flattening is not None and scales is not None:
        pencil = pencilled(ground, answers, scales, flattening, effort.drawn)
    return Study(mechanism, reference, tuple(rows), flattening, pencil)


def timed(methods: Sequence[Method], watch: Stopwatch) -> list[MethodRow]:
    """The rows of methods with their times."""
    works = [(method.work, method.positions) for method in methods if method.work is not None]
    times = iter(watch.times(works))
    return [
        method.row if method.work is None else replace(method.row, time=next(times))
        for method in methods
    ]


# --- the machine on which something was timed, in words -------------------------------------------


CPU = Path("/proc/cpuinfo")
LIBRARIES = {"numpy": "numpy", "numba": "numba", "mpmath": "mpmath", "python-flint": "flint"}
"""The libraries whose speed is measured, with their modules."""


def machine_words() -> str:
    """Processor, system, and the versions of Python and of the numerical libraries."""
    cores = os.cpu_count() or 1
    listed = CPU.read_text(encoding="utf-8", errors="replace") if CPU.exists() else ""
    model = re.search(r"^model name\s*:\s*(.*\S)", listed, re.MULTILINE)
    own = platform.processor() or platform.machine() or "unknown processor"
    parts = [
        f"{model[1] if model else own}, {cores} core{'s' if cores > 1 else ''}",
        f"{platform.system()} {platform.machine()}",
        f"Python {platform.python_version()}",
    ]
    known = {name: version(name) for name, module in LIBRARIES.items() if find_spec(module)}
    return "; ".join([*parts, *(f"{name} {each}" for name, each in known.items())])


# --- the pictures of a study: methods by digits and time, and the way to a dead point -------------


WIDE = 11.2
"""The width of a picture in inches: an A4 page in landscape, less its margins."""
GREY = "#56646f"
"""The colour of notes."""
HOUR = 3600.0
BY_HAND = (HOUR / 3, 3 * HOUR)
"""The range of times in which a person draws one position, in s: an estimate, not measured."""
FAMILIES = {
    "float64": COLOURS[0],
    "float32": COLOURS[5],
    "longdouble": COLOURS[3],
    "mpmath": COLOURS[2],
    "Arb": COLOURS[1],
    "Newton": COLOURS[7],
    "differences": COLOURS[6],
    "pencil": COLOURS[4],
}
"""The colour of each family of methods."""
MARKS = ("o", "s", "^")
"""The marks of position, velocity and acceleration."""
DIGITS = (1, 2, 4, 8, 16, 32, 64, 128)
TICKS = {1e-8: "10 ns", 1e-6: "1 µs", 1e-4: "100 µs", 1e-2: "10 ms", 1.0: "1 s", 60.0: "1 min"}
TICKS |= {HOUR: "1 h"}


def methods_picture(study: Study) -> Figure:
    """Every method of the table with its correct digits on the left and its time on the right."""
    figure = new_figure(WIDE, 1.8 + 0.24 * len(study.rows))
    digits, times = figure.subplots(1, 2, sharey=True, width_ratios=(1.25, 1))
    title = f"What accuracy costs: {study.mechanism.scene.title}"
    figure_title(figure, title, fontweight="bold", fontsize=13)
    for y, row in enumerate(study.rows):
        digits_of(digits, y, row)
        time_of(times, y, row)
    digits.set_yticks(range(len(study.rows)), [row.method for row in study.rows])
    for label, row in zip(digits.get_yticklabels(), study.rows, strict=True):
        label.set_color(FAMILIES[row.family])
    digits.set_ylim(len(study.rows) - 0.4, -0.6)
    log_ticks(digits, {each: str(each) for each in DIGITS})
    digits.set_xlabel("correct digits of the largest value")
    panel_heading(digits, "Digits", raised=True)
    for kind, mark in zip(KINDS, MARKS, strict=True):
        digits.plot([], [], mark, color=FAINT, ms=5, label=kind)
    legend(digits)
    log_ticks(times, TICKS)
    times.tick_params(axis="y", length=0)
    times.set_xlabel("time of one position")
    panel_heading(times, "Time", raised=True)
    reference = study.reference
    words = (
        f"Digits: by the largest error of all points and blocks over {len(reference.places.at)} "
        "positions, in parts of the largest distance, speed and acceleration, against Arb balls "
        f"whose own radius is {reference.radius:.0e}.\nTime: median and quartiles of one position; "
        f"batches of {max(row.variants for row in study.rows):,}; a drawing takes a person about "
        f"an hour (not measured).\n{machine_words()}"
    )
    footnote(figure, words, size=7, colour=GREY)
    return figure


def digits_of(ax: Axes, y: int, row: MethodRow) -> None:
    """Draw the correct digits of a method, one mark for each quantity."""
    known = [(-log10(e), m) for e, m in zip(row.errors, MARKS, strict=True) if e and isfinite(e)]
    seen = [(digits, mark) for digits, mark in known if digits > 0]
    if len(known) > len(seen) or any(e is not None and not isfinite(e) for e in row.errors):
        ax.text(DIGITS[0], y, "✗", color=FAMILIES[row.family], ha="center", va="center", fontsize=8)
    if seen:
        ends = [min(seen)[0], max(seen)[0]]
        ax.plot(ends, [y, y], color=FAMILIES[row.family], lw=0.8, alpha=0.6)
    for digits, mark in seen:
        ax.plot([digits], [y], mark, color=FAMILIES[row.family], ms=5, mec="white", mew=0.4)


def time_of(ax: Axes, y: int, row: MethodRow) -> None:
    """Draw the time of a method with its quartiles; of a drawing, the time that is estimated."""
    colour = FAMILIES[row.family]
    if row.family == "pencil" and any(row.errors):
        ax.plot(BY_HAND, [y, y], color=colour, lw=3, alpha=0.3)
    if row.time is not None:
        ax.plot([row.time.low, row.time.high], [y, y], color=colour, lw=0.8)
        ax.plot([row.time.median], [y], "o", color=colour, ms=5, mec="white", mew=0.4)


def log_ticks(ax: Axes, words: dict[Any, str]) -> None:
    """Set a logarithmic horizontal axis with these ticks where the marks are."""
    ax.set_xscale("log")
    low, high = ax.get_xlim()
    shown = [each for each in words if low <= each <= high]
    ax.set_xticks(shown, [words[each] for each in shown], fontsize=8)
    ax.minorticks_off()


# --- errors against the sine of the flattest crossing, towards a dead point -----------------------


COUNTED = (
    "in parts of the largest distance",
    "in parts of the largest speed v",
    "in parts of v²/L",
)
TITLES = ("Position: 1/s", "Velocity: 1/s²", "Acceleration: 1/s³")
MOST, LEAST = 3.0, 1e-19
"""The largest and the smallest error shown; beyond the largest no digit is left."""


def dead_point_picture(study: Study) -> Figure | None:
    """Errors towards a dead point in three panels; None if the study has none."""
    found = study.flattening
    if found is None:
        return None
    figure = new_figure(WIDE, 6.2)
    panels = figure.subplots(1, 3, sharex=True, sharey=True)
    figure_title(figure, title_of(study), fontweight="bold", fontsize=12.5)
    for n, ax in enumerate(panels):
        sine_panel(ax, study, found, n)
        panel_heading(ax, TITLES[n] if found.has_end else KINDS[n].capitalize(), raised=True)
        legend(ax)
        ax.set_xlabel(along_words(found))
        ax.text(
            0.02, 0.02, unit_words(found, n), transform=ax.transAxes, ha="left", va="bottom",
            fontsize=8, color=GREY,
        )  # fmt: skip
    panels[0].set_ylabel("largest error")
    panels[0].set_ylim(LEAST, MOST)
    words = (
        "Thin lines: the laws 1/s, 1/s², 1/s³. L is the largest distance of two points, v the "
        f"largest speed in each position. Grey: no digit is left.\nPencil: {FINE:g} mm; 95 of 100 "
        "drawings are off by less; its line ends where one drawing in twenty does not close."
    )
    footnote(figure, words, size=7, colour=GREY)
    return figure


def along_words(found: Flattening) -> str:
    """The label of the horizontal axis."""
    sweep = found.approach.places.course.sweep
    if not found.has_end:
        what = "time" if sweep.driver is None else f"position of driver {sweep.number}"
        return f"{what}, {sweep.unit}"
    if found.falls:
        return "sine s of the flattest crossing"
    return "s: root of the distance to go, in parts of the first"


def unit_words(found: Flattening, n: int) -> str:
    """The unit of an error, and the measured slope."""
    slope = found.slopes("float64")[n]
    if slope is None or not found.has_end:
        return COUNTED[n]
    return f"{COUNTED[n]}\nmeasured slope of float64: {slope:.2f}".replace("-", "−")


def title_of(study: Study) -> str:
    """The conclusion, with the kind of end that was approached."""
    found, title = study.flattening, study.mechanism.scene.title
    assert found is not None
    if not found.has_end:
        return f"No dead point within the driver's reach: errors over its whole range: {title}"
    return f"Towards a {found.approach.end} point every derivative loses digits faster: {title}"


def sine_panel(ax: Axes, study: Study, found: Flattening, n: int) -> None:
    """Draw one quantity: doubles, single precision, a pencil, and the law through the doubles."""
    ax.set_xscale("log" if found.has_end else "linear")
    ax.set_yscale("log")
    ax.minorticks_off()
    ax.axhspan(LOST, MOST, color=PALE, lw=0)
    measure = found.measure if found.has_end else found.reference.places.at
    ink = COLOURS[n]
    series: list[tuple[str, Reals, Reals, dict[str, Any]]] = [
        ("float64", measure, found.errors["float64"], {"color": ink, "marker": MARKS[n]}),
        ("float32", measure, found.errors["float32"],
         {"color": ink, "marker": MARKS[n], "mfc": "white"}),
        ("pencil", *study.pencil, {"color": FAMILIES["pencil"], "marker": "*", "ms": 7}),
    ]  # fmt: skip
    for name, sines, errors, style in series:
        seen = np.isfinite(errors[:, n]) & (errors[:, n] > 0) & (errors[:, n] < MOST)
        if seen.any():
            width = 1.0 if found.has_end else 0.5
            look = {"ms": 4.5, "lw": width, "mew": 0.8, "label": name, **style}
            ax.plot(sines[seen], errors[seen, n], **look)
    if found.has_end:
        law_line(ax, measure, found.errors["float64"][:, n], n)


def law_line(ax: Axes, sines: Reals, errors: Reals, n: int) -> None:
    """Draw the law of a quantity as a thin line through its errors in doubles."""
    seen = (errors > 0) & (errors < LOST) & (sines < 0.2) & (sines > 1e-7)
    if np.count_nonzero(seen) < 3:
        return
    level = np.median(np.log10(errors[seen]) - LAW[n] * np.log10(sines[seen]))
    ends = np.array([sines.min(), 1.0])
    ax.plot(ends, 10**level * ends ** LAW[n], color=INK, lw=0.6, alpha=0.7, zorder=1)


def picture_files(study: Study, stem: str, formats: Sequence[str]) -> dict[str, bytes]:
    """Both pictures of a study by file name, in each of the formats svg and png."""
    pictures = {"time": methods_picture, "dead-point": dead_point_picture}
    drawn = ((f"{stem}-accuracy-{name}", partial(of, study)) for name, of in pictures.items())
    return plot_style.picture_files(drawn, formats)
