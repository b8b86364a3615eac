"""The first picture: error against time of every method, a hand's drawing beside them."""

from __future__ import annotations

from collections.abc import Sequence
from math import isfinite, log10
from typing import TYPE_CHECKING, Any

from msgspec import Struct

from graphkin.accuracy.methods import MethodRow
from graphkin.accuracy.pencil_rows import PENCILS
from graphkin.accuracy.point_names import GREY, PointName, name_points
from graphkin.accuracy.study import Study
from graphkin.construction.core.quantities import KINDS
from graphkin.writers.plot_style import (
    COLOURS,
    INK,
    figure_title,
    new_figure,
    panel_heading,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

A4 = (11.2, 7.4)
"""Size of a picture in inches: an A4 page across, less its margins."""
HOUR = 3600.0
BY_HAND = (HOUR / 3, 3 * HOUR)
"""The time in which a person draws one position: an estimate, not measured."""
LEAST = 1e-21
"""The smallest error of the enlarged part."""
FAMILIES = {
    "float64": (COLOURS[0], "o"),
    "float32": (COLOURS[5], "v"),
    "longdouble": (COLOURS[3], "^"),
    "mpmath": (COLOURS[2], "s"),
    "Arb": (COLOURS[1], "D"),
    "Newton": (COLOURS[7], "P"),
    "differences": (COLOURS[6], "X"),
    "pencil": (COLOURS[4], "*"),
}
"""Ink and mark of each family of methods."""
JOINED = ("mpmath", "Arb", "Newton", "differences")
"""Families whose members are joined by a line, for they differ by one number."""
TICKS = {
    1e-9: "1 ns",
    1e-8: "10 ns",
    1e-7: "100 ns",
    1e-6: "1 µs",
    1e-5: "10 µs",
    1e-4: "100 µs",
    1e-3: "1 ms",
    1e-2: "10 ms",
    1e-1: "100 ms",
    1.0: "1 s",
    60.0: "1 min",
    HOUR: "1 h",
}


class MethodSpot(Struct, frozen=True):
    """A method on the picture: its time, its quartiles, its error."""

    row: MethodRow
    seconds: float
    low: float
    high: float
    error: float


def ladder(study: Study, machine: str) -> Figure:
    """Error against time, all of it at the left, that of doubles enlarged at the right."""
    figure = new_figure(*A4)
    which = max((n for n in range(3) if any(row.errors[n] for row in study.rows)), default=0)
    spots = [spot for row in study.rows if (spot := spot_of(row, which)) is not None]
    left, right = figure.subplots(1, 2, width_ratios=(1.12, 1))
    figure_title(
        figure,
        f"What accuracy costs: {study.mechanism.scene.title}",
        fontweight="bold",
        fontsize=13,
    )
    footnote(figure, study, which, machine)
    whole(figure, left, spots)
    enlarged(figure, right, spots)
    return figure


def spot_of(row: MethodRow, which: int) -> MethodSpot | None:
    """Where a method stands; None where it gives no error, none that is finite, or no time."""
    error = row.errors[which]
    if error is None or not isfinite(error) or error <= 0:
        return None
    if row.family == "pencil":
        return MethodSpot(row, HOUR, *BY_HAND, error)
    if row.time is None:
        return None
    return MethodSpot(row, row.time.median, row.time.low, row.time.high, error)


def footnote(figure: Figure, study: Study, which: int, machine: str) -> None:
    """How it was measured, below the panels."""
    reference = study.reference
    words = (
        f"Error: the largest {KINDS[which]} error of all points over "
        f"{len(reference.places.at)} positions, in parts of the largest {KINDS[which]}, "
        f"against Arb balls whose own radius is {reference.radius:.0e}.\n"
        f"Time: median and quartiles of one position; batches of "
        f"{max(row.variants for row in study.rows):,}. {machine}"
    )
    figure.supxlabel(words, fontsize=7, color=GREY, x=0.01, ha="left")


def pencil_words(pencils: Sequence[MethodSpot]) -> str:
    """The name of all pencils together."""
    return f"pencil, {PENCILS[0]:g} to {PENCILS[-1]:g} mm" if len(pencils) > 1 else "pencil"


def whole(figure: Figure, ax: Axes, spots: Sequence[MethodSpot]) -> None:
    """Every method and the hand."""
    from matplotlib.ticker import LogLocator

    axes_of(ax, spots)
    panel_heading(ax, digits_words(spots))
    ax.axvspan(*BY_HAND, color=FAMILIES["pencil"][0], alpha=0.13, lw=0)
    draw(ax, spots)
    ax.yaxis.set_major_locator(LogLocator(base=1e20))
    some = [s for s in spots if s.row.family in ("mpmath", "Arb", "longdouble")]
    names = [PointName(s.seconds, s.error, label(s.row), ink(s.row)) for s in some]
    pencils = [s for s in spots if s.row.family == "pencil"]
    if pencils:
        names.append(PointName(HOUR, pencils[0].error, pencil_words(pencils), ink(pencils[0].row)))
    doubles = [s for s in spots if s.row.family == "float64"]
    if doubles:
        best = min(doubles, key=lambda s: s.seconds)
        names.append(PointName(best.seconds, best.error, "float64", ink(best.row), bold=True))
    single = [s for s in spots if s.row.family == "float32"]
    names += [PointName(s.seconds, s.error, "float32", ink(s.row)) for s in single]
    marks = [(s.seconds, s.error) for s in spots if s.row.family != "pencil"]
    name_points(figure, ax, names, marks, lines_of(spots))
    ax.text(
        HOUR,
        0.5,
        "by hand: about an hour (not measured)",
        transform=ax.get_xaxis_transform(),
        rotation=90,
        ha="center",
        va="center",
        color=FAMILIES["pencil"][0],
        fontsize=8,
        bbox={"facecolor": "#f6f0e1", "edgecolor": "none", "pad": 2},
    )


def enlarged(figure: Figure, ax: Axes, spots: Sequence[MethodSpot]) -> None:
    """The part of doubles, with the differences and Newton's method; a pencil's error as a band."""
    near = [s for s in spots if s.error > LEAST and s.row.family != "pencil"]
    pencils = [s.error for s in spots if s.row.family == "pencil"]
    axes_of(ax, near)
    ax.set_ylabel("")
    panel_heading(ax, batch_words(spots))
    ax.set_ylim(LEAST, 10 * max([*(s.error for s in near), *pencils, 1e-2]))
    if pencils:
        ax.axhspan(min(pencils), max(pencils), color=FAMILIES["pencil"][0], alpha=0.13, lw=0)
        ax.text(
            0.99,
            (min(pencils) * max(pencils)) ** 0.5,
            f"a {pencil_words([s for s in spots if s.row.family == 'pencil'])}",
            transform=ax.get_yaxis_transform(),
            ha="right",
            va="center",
            fontsize=7.5,
            color=FAMILIES["pencil"][0],
        )
    draw(ax, near)
    names = [PointName(s.seconds, s.error, label(s.row), ink(s.row)) for s in near]
    name_points(figure, ax, names, [(s.seconds, s.error) for s in near], lines_of(near))


def lines_of(spots: Sequence[MethodSpot]) -> list[list[tuple[float, float]]]:
    """Lines that no name may cover: the quartiles of each mark, and those between marks."""
    bars = [[(s.low, s.error), (s.high, s.error)] for s in spots if s.row.family != "pencil"]
    joined = [[(s.seconds, s.error) for s in spots if s.row.family == f] for f in JOINED]
    return [*bars, *joined]


def axes_of(ax: Axes, spots: Sequence[MethodSpot]) -> None:
    """Logarithmic axes with times as people say them."""
    ax.set_xscale("log")
    ax.set_yscale("log")
    low, high = min(s.seconds for s in spots), max(s.seconds for s in spots)
    ax.set_xlim(low / 4, high * 8)
    ax.set_xlabel("time of one position")
    ax.set_ylabel("error, in parts of the largest value")
    spread = log10(high / low)
    ticks = [t for t in TICKS if low / 4 < t < high * 8]
    if spread > 5:
        ticks = [t for t in ticks if t >= 1 or round(log10(t)) % 2 == 0]
        ticks = [t for t in ticks if t != 1e-9]
    ax.set_xticks(ticks, [TICKS[t] for t in ticks], fontsize=8)
    ax.minorticks_off()


def draw(ax: Axes, spots: Sequence[MethodSpot]) -> None:
    """The marks, with quartiles as thin bars, and lines between those of a family."""
    for family in JOINED:
        line = [s for s in spots if s.row.family == family]
        ax.plot([s.seconds for s in line], [s.error for s in line], color=FAMILIES[family][0],
                lw=0.9, alpha=0.6)  # fmt: skip
    for s in spots:
        colour, mark = FAMILIES[s.row.family]
        if s.row.family != "pencil":
            ax.plot([s.low, s.high], [s.error] * 2, color=colour, lw=0.8, alpha=0.8)
        style: dict[str, Any] = {"mfc": colour, "mec": "white", "mew": 0.5, "ls": ""}
        size = 9 if s.row.family == "pencil" else 6.5
        ax.plot([s.seconds], [s.error], marker=mark, ms=size, zorder=5, **style)


def label(row: MethodRow) -> str:
    """The short name of a method with what it belongs to."""
    names = {"float64": "", "float32": "", "longdouble": "", "differences": "differences, "}
    return names.get(row.family, f"{row.family}, ") + row.key


def ink(row: MethodRow) -> str:
    """The colour of a method."""
    return FAMILIES.get(row.family, (INK, "o"))[0]


def digits_words(spots: Sequence[MethodSpot]) -> str:
    """The lesson of the whole: what more digits cost."""
    balls = [s for s in spots if s.row.family == "Arb"]
    if len(balls) < 2:
        return "Every kind of number, and a hand"
    first, last = balls[0], balls[-1]
    more = log10(last.error) / log10(first.error)
    times = last.seconds / first.seconds
    if times < 1.05:
        return f"{more:.0f} times the digits, proved: for hardly more time"
    return f"{more:.0f} times the digits, proved: {times:.1f} times the time"


def batch_words(spots: Sequence[MethodSpot]) -> str:
    """The lesson of the enlarged part: differences lose digits, batches lose none."""
    doubles = [s for s in spots if s.row.family == "float64"]
    single = [s for s in doubles if s.row.variants == 1]
    if not single or len(doubles) < 2:
        return "Differences throw digits away"
    best = min(s.seconds for s in doubles)
    times = float(f"{single[0].seconds / best:.2g}")
    words = f"In a batch the same digits cost {times:,.0f} times less"
    differences = [s.error for s in spots if s.row.family == "differences"]
    if not differences:
        return words
    mine, theirs = (round(-log10(e)) for e in (single[0].error, min(differences)))
    return f"{words};\ndifferences lose {mine - theirs} of the {mine} digits"
