"""The second picture: error against the sine of the flattest crossing, towards a dead point."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from graphkin.accuracy.error_against_time import A4
from graphkin.accuracy.flattening import LAW, LOST, Flattening
from graphkin.accuracy.pencil_rows import FINE
from graphkin.accuracy.point_names import GREY, PointName, name_points
from graphkin.accuracy.study import Study
from graphkin.construction.core.quantities import KINDS
from graphkin.motion.course import Reals
from graphkin.writers.plot_style import COLOURS, INK, PALE, figure_title, new_figure, panel_heading

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

INKS = (COLOURS[0], COLOURS[1], COLOURS[2])
MARKS = ("o", "s", "^")
COUNTED = (
    "in parts of the largest distance",
    "in parts of the largest speed v",
    "in parts of v²/L",
)
TITLES = ("Position: 1/s", "Velocity: 1/s²", "Acceleration: 1/s³")
MOST = 3.0
"""The largest error shown: beyond, nothing is left of an answer."""
LEAST = 1e-19


def slopes(study: Study, machine: str) -> Figure | None:
    """Errors towards a dead point in three panels; None where there is nothing to see."""
    found = study.flattening
    if found is None:
        return None
    figure = new_figure(A4[0], 6.2)
    panels = figure.subplots(1, 3, sharex=True, sharey=True)
    named: list[tuple[Axes, list[PointName], list[tuple[float, float]]]] = []
    to_end = found.approach.end != "range"
    figure_title(figure, title_of(study), fontweight="bold", fontsize=12.5)
    for n, ax in enumerate(panels):
        ends = panel(ax, study, n)
        panel_heading(ax, TITLES[n] if to_end else KINDS[n].capitalize())
        ax.set_xlabel(along_words(found))
        ax.text(
            0.02, 0.02, told(study, n), transform=ax.transAxes, ha="left", va="bottom",
            fontsize=8, color=GREY,
        )  # fmt: skip
        named.append((ax, *ends))
    panels[0].set_ylabel("largest error")
    panels[0].set_ylim(LEAST, MOST)
    figure.supxlabel(
        "Thin lines: the laws 1/s, 1/s², 1/s³. L is the largest distance of two points, v the "
        f"largest speed in each position. Grey: no digit is left.\nPencil: {FINE:g} mm; 95 of 100 "
        "drawings are off by less; its line ends where one drawing in twenty does not close.",
        fontsize=7,
        color=GREY,
        x=0.01,
        ha="left",
    )
    for ax, names, points in named:
        name_points(figure, ax, names, points)
    return figure


def along_words(found: Flattening) -> str:
    """What errors are shown against."""
    sweep = found.approach.places.course.sweep
    if found.approach.end == "range":
        if sweep.driver is None:
            return "time, s"
        return f"position of driver {sweep.number}, {sweep.unit}"
    if found.falls:
        return "sine s of the flattest crossing"
    return "s: root of the distance to go, in parts of the first"


def told(study: Study, n: int) -> str:
    """In what an error is counted, and the slope that was measured."""
    assert study.flattening is not None
    slope = study.flattening.slopes("float64")[n]
    if slope is None or study.flattening.approach.end == "range":
        return COUNTED[n]
    return f"{COUNTED[n]}\nmeasured slope of float64: {slope:.2f}".replace("-", "−")


def title_of(study: Study) -> str:
    """The lesson, with the end that was approached."""
    found, title = study.flattening, study.mechanism.scene.title
    assert found is not None
    match found.approach.end:
        case "dead":
            return f"Towards a dead point every derivative loses digits faster: {title}"
        case "change":
            return f"Towards a change point every derivative loses digits faster: {title}"
    return f"No dead point within the driver's reach: errors over its whole range: {title}"


def panel(ax: Axes, study: Study, n: int) -> tuple[list[PointName], list[tuple[float, float]]]:
    """One quantity: doubles, single precision, a pencil, and the law through the doubles.

    Gives the names that its lines are to have, and the points that these may not cover.
    """
    names: list[PointName] = []
    points: list[tuple[float, float]] = []
    found = study.flattening
    assert found is not None
    to_end = found.approach.end != "range"
    ax.set_xscale("log" if to_end else "linear")
    ax.set_yscale("log")
    ax.minorticks_off()
    ax.axhspan(LOST, MOST, color=PALE, lw=0)
    measure = found.measure if to_end else found.reference.places.at
    ink, mark = INKS[n], MARKS[n]
    series: list[tuple[str, Reals, Reals, str, str, str]] = [
        ("float64", measure, found.errors["float64"][:, n], ink, ink, mark),
        ("float32", measure, found.errors["float32"][:, n], ink, "white", mark),
    ]
    if len(study.pencil[0]):
        by_hand = COLOURS[4]
        series.append(("pencil", study.pencil[0], study.pencil[1][:, n], by_hand, by_hand, "*"))
    for name, sines, errors, colour, fill, sign in series:
        seen = np.isfinite(errors) & (errors > 0) & (errors < MOST)
        if not seen.any():
            continue
        look: dict[str, Any] = {"marker": sign, "ms": 7 if sign == "*" else 4.5, "mfc": fill}
        ax.plot(
            sines[seen],
            errors[seen],
            ls="-",
            lw=1.0 if to_end else 0.5,
            color=colour,
            mew=0.8,
            **look,
        )
        middle = np.flatnonzero(seen)[np.count_nonzero(seen) // 2]
        names.append(PointName(sines[middle], errors[middle], name, colour, 9, bold=True))
        points += zip(sines[seen].tolist(), errors[seen].tolist(), strict=True)
    if to_end:
        guides(ax, measure, found.errors["float64"][:, n], n)
    return names, points


def guides(ax: Axes, sines: Reals, errors: Reals, n: int) -> None:
    """The law of a quantity as a thin line through its errors in doubles."""
    seen = (errors > 0) & (errors < LOST) & (sines < 0.2) & (sines > 1e-7)
    if np.count_nonzero(seen) < 3:
        return
    level = np.median(np.log10(errors[seen]) - LAW[n] * np.log10(sines[seen]))
    ends = np.array([sines.min(), 1.0])
    ax.plot(ends, 10**level * ends ** LAW[n], color=INK, lw=0.6, alpha=0.7, zorder=1)
