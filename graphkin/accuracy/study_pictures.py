"""The two pictures of a study: the table as digits and times, and errors towards a dead point."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from math import isfinite, log10
from typing import TYPE_CHECKING, Any

import numpy as np

from graphkin.accuracy.methods import MethodRow
from graphkin.accuracy.study import FINE, LAW, LOST, Flattening, Study, machine_words
from graphkin.construction.core.quantities import KINDS
from graphkin.motion.course import Reals
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
