"""The three pictures of a study: error against time, error against sine, cost by scope."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from itertools import pairwise
from math import cos, hypot, isfinite, log10, radians, sin
from typing import TYPE_CHECKING, Any

import numpy as np
from msgspec import Struct

from graphkin.accuracy.effort import machine_words
from graphkin.accuracy.methods import MethodRow
from graphkin.accuracy.study import ASKED, FINE, LAW, LOST, PENCILS, Flattening, Study
from graphkin.construction.core.quantities import KINDS
from graphkin.construction.core.timing import Timing
from graphkin.motion.course import Reals
from graphkin.writers import plot_style
from graphkin.writers.plot_style import (
    COLOURS,
    FAINT,
    INK,
    PALE,
    figure_title,
    new_figure,
    panel_heading,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

GREY = "#56646f"
"""The colour of notes."""
RINGS = (9.0, 15.0, 24.0, 36.0, 50.0, 66.0, 84.0)
"""The distances tried between a point and its name, in points of print."""
TURNS = (0, 180, 90, 270, 35, 145, 325, 215, 60, 120, 300, 240)
"""The directions tried, the best first, in degrees."""
LED = 12.0
"""The distance in points from which a thin line joins a name to its point."""
AIR = 2.0
"""The clearance around a name and a point, in points of print."""
DOT = 4.0
"""Half the size of a point's mark, in points of print."""

Box = tuple[float, float, float, float]


class PointName(Struct, frozen=True):
    """The name of a point, at coordinates of the axes."""

    x: float
    y: float
    text: str
    colour: str
    size: float = 7.5
    bold: bool = False


def name_points(
    figure: Figure,
    ax: Axes,
    names: Sequence[PointName],
    points: Sequence[tuple[float, float]] = (),
    lines: Sequence[Sequence[tuple[float, float]]] = (),
) -> list[Box]:
    """Write names near their points and return their boxes in pixels.

    Further ``points`` and ``lines`` are kept clear.
    """
    figure.draw_without_rendering()
    dot = figure.dpi / 72
    spots = [tuple(ax.transData.transform((n.x, n.y))) for n in names]
    others = [tuple(ax.transData.transform(point)) for point in points]
    full = [around(x, y, (DOT + AIR) * dot) for x, y in (*spots, *others)]
    for line in lines:
        corners = [tuple(ax.transData.transform(corner)) for corner in line]
        full += [around(x, y, AIR * dot) for x, y in along(corners, AIR * dot)]
    room = ax.get_window_extent()
    taken = np.array(full).reshape(-1, 4)
    written: list[Box] = []
    for name, spot in zip(names, spots, strict=True):
        width, height = size_of(figure, name)
        candidates = [
            (overlap(box, taken) + 3 * outside(box, room), order, shift, box)
            for order, (shift, box) in enumerate(places(spot, width, height, dot))
        ]
        _, _, shift, box = min(candidates, key=lambda each: each[:2])
        written.append(box)
        taken = np.vstack([taken, box])
        put(ax, name, shift)
    return written


def along(corners: Sequence[tuple[Any, ...]], step: float) -> Iterator[tuple[float, float]]:
    """Points on a line through some corners, about a step apart."""
    for (x, y), (u, v) in pairwise(corners):
        count = max(1, round(hypot(u - x, v - y) / step))
        for k in range(count + 1):
            yield x + (u - x) * k / count, y + (v - y) * k / count


def size_of(figure: Figure, name: PointName) -> tuple[float, float]:
    """Width and height of a name in pixels."""
    from matplotlib.text import Text

    text = Text(0, 0, name.text, fontsize=name.size, fontweight="bold" if name.bold else "normal")
    text.set_figure(figure)
    box = text.get_window_extent(figure.canvas.get_renderer())  # type: ignore[attr-defined]
    return box.width, box.height


def places(
    spot: tuple[Any, ...], width: float, height: float, dot: float
) -> Iterator[tuple[tuple[float, float], Box]]:
    """Candidate offsets of a name's middle from its point, in points of print, with the boxes."""
    for ring in RINGS:
        for turn in TURNS:
            across, up = cos(radians(turn)), sin(radians(turn))
            x = across * (ring * dot + width / 2)
            y = up * (ring * dot + height / 2)
            middle = spot[0] + x, spot[1] + y
            half = width / 2 + AIR * dot, height / 2 + AIR * dot
            box = (
                middle[0] - half[0],
                middle[1] - half[1],
                middle[0] + half[0],
                middle[1] + half[1],
            )
            yield (x / dot, y / dot), box


def put(ax: Axes, name: PointName, shift: tuple[float, float]) -> None:
    """Write a name, with a thin line to its point if the name is far from it."""
    far = abs(shift[1]) > LED * 1.6 or abs(shift[0]) > 400
    text = ax.annotate(
        name.text,
        (name.x, name.y),
        shift,
        textcoords="offset points",
        ha="center",
        va="center",
        fontsize=name.size,
        color=name.colour,
        fontweight="bold" if name.bold else "normal",
        arrowprops={"arrowstyle": "-", "color": FAINT, "lw": 0.5, "shrinkA": 0, "shrinkB": 3}
        if far
        else None,
        zorder=6,
    )
    text.set_in_layout(False)


def around(x: float, y: float, half: float) -> Box:
    return x - half, y - half, x + half, y + half


def overlap(box: Box, others: Any) -> float:
    """The total area that a box shares with each of the others (N, 4), summed in order."""
    others = np.asarray(others, dtype=np.float64).reshape(-1, 4)
    wide = np.minimum(box[2], others[:, 2]) - np.maximum(box[0], others[:, 0])
    high = np.minimum(box[3], others[:, 3]) - np.maximum(box[1], others[:, 1])
    both = (wide > 0) & (high > 0)
    return float(sum((wide[both] * high[both]).tolist()))


def outside(box: Box, room: Any) -> float:
    """The area of a box that lies outside the axes."""
    whole = (box[2] - box[0]) * (box[3] - box[1])
    return whole - overlap(box, [(room.x0, room.y0, room.x1, room.y1)])


# --- the third picture: the cost of a position by what is asked -----------------------------------


def bars(study: Study, machine: str) -> Figure:
    """The time of one position by scope, one by one and in a batch, with quartiles."""
    figure = new_figure(11.2, 4.6)
    left, right = figure.subplots(1, 2, sharey=True)
    scopes = study.scopes
    figure_title(
        figure,
        f"What a position costs by what is asked: {study.mechanism.scene.title}",
        fontweight="bold",
        fontsize=12.5,
    )
    labels = [f"{scope.name}\n{scope.steps} steps" for scope in scopes]
    colours = [COLOURS[1] if scope.name == ASKED else COLOURS[0] for scope in scopes]
    scope_panel(left, labels, colours, [scope.single for scope in scopes])
    panel_heading(left, "One position after the other")
    scope_panel(right, labels, colours, [scope.batch for scope in scopes])
    panel_heading(right, "In a batch")
    figure.supxlabel(
        f"Medians with quartiles of everything up to each scope. {machine}",
        fontsize=7,
        color=GREY,
        x=0.01,
        ha="left",
    )
    return figure


def scope_panel(
    ax: Axes, labels: Sequence[str], colours: Sequence[str], times: Sequence[Timing]
) -> None:
    """Bars in microseconds with their numbers, the first scope on top."""
    micro = [time.median * 1e6 for time in times]
    rows = range(len(times))
    ax.barh(rows, micro, color=colours, height=0.62)
    for row, time in zip(rows, times, strict=True):
        ax.plot([time.low * 1e6, time.high * 1e6], [row, row], color=INK, lw=1.2)
        ax.annotate(
            f"{time.median * 1e6:.3g}",
            (max(time.high, time.median) * 1e6, row),
            (5, 0),
            textcoords="offset points",
            va="center",
            fontsize=9,
        )
    ax.set_yticks(rows, labels)
    ax.set_ylim(len(labels) - 0.5, -0.5)
    ax.set_xlim(0, max([time.high * 1e6 for time in times] + micro) * 1.15)
    ax.set_xlabel("µs a position")
    ax.grid(False, axis="y")


# --- the first picture: error against time of every method, with a drawing by hand ----------------


A4 = (11.2, 7.4)
"""The size of a picture in inches: an A4 page in landscape, less its margins."""
HOUR = 3600.0
BY_HAND = (HOUR / 3, 3 * HOUR)
"""The range of times in which a person draws one position, in s: an estimate, not measured."""
LEAST = 1e-21
"""The smallest error shown in the enlarged part."""
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
"""Colour and mark of each family of methods."""
JOINED = ("mpmath", "Arb", "Newton", "differences")
"""The families whose members are joined by a line, because they differ by one number."""
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
    """Error against time: everything on the left, the range of doubles enlarged on the right."""
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
    """The place of a method; None without a time, or without a finite positive error."""
    error = row.errors[which]
    if error is None or not isfinite(error) or error <= 0:
        return None
    if row.family == "pencil":
        return MethodSpot(row, HOUR, *BY_HAND, error)
    if row.time is None:
        return None
    return MethodSpot(row, row.time.median, row.time.low, row.time.high, error)


def footnote(figure: Figure, study: Study, which: int, machine: str) -> None:
    """Write the conditions of the measurement below the panels."""
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
    """Draw every method and the drawing by hand."""
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
    """Draw the range of doubles, differences and Newton's method; a pencil's error is a band."""
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
    """Set logarithmic axes with times in everyday units."""
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
    """Draw the marks, with quartiles as thin bars, and lines between those of a family."""
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
    """The short name of a method with its family."""
    names = {"float64": "", "float32": "", "longdouble": "", "differences": "differences, "}
    return names.get(row.family, f"{row.family}, ") + row.key


def ink(row: MethodRow) -> str:
    return FAMILIES.get(row.family, (INK, "o"))[0]


def digits_words(spots: Sequence[MethodSpot]) -> str:
    """The conclusion of the left panel: the cost of more digits."""
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
    """The conclusion of the right panel: differences lose digits, batches lose none."""
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


# --- the second picture: error against the sine of the flattest crossing, towards a dead point ----


INKS = (COLOURS[0], COLOURS[1], COLOURS[2])
MARKS = ("o", "s", "^")
COUNTED = (
    "in parts of the largest distance",
    "in parts of the largest speed v",
    "in parts of v²/L",
)
TITLES = ("Position: 1/s", "Velocity: 1/s²", "Acceleration: 1/s³")
MOST = 3.0
"""The largest error shown; beyond it no digit is left."""
LEAST_BY_SINE = 1e-19


def slopes(study: Study, machine: str) -> Figure | None:
    """Errors towards a dead point in three panels; None if the study has none."""
    found = study.flattening
    if found is None:
        return None
    figure = new_figure(A4[0], 6.2)
    panels = figure.subplots(1, 3, sharex=True, sharey=True)
    named: list[tuple[Axes, list[PointName], list[tuple[float, float]]]] = []
    to_end = found.approach.end != "range"
    figure_title(figure, title_of(study), fontweight="bold", fontsize=12.5)
    for n, ax in enumerate(panels):
        ends = sine_panel(ax, study, n)
        panel_heading(ax, TITLES[n] if to_end else KINDS[n].capitalize())
        ax.set_xlabel(along_words(found))
        ax.text(
            0.02, 0.02, told(study, n), transform=ax.transAxes, ha="left", va="bottom",
            fontsize=8, color=GREY,
        )  # fmt: skip
        named.append((ax, *ends))
    panels[0].set_ylabel("largest error")
    panels[0].set_ylim(LEAST_BY_SINE, MOST)
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
    """The label of the horizontal axis."""
    sweep = found.approach.places.course.sweep
    if found.approach.end == "range":
        if sweep.driver is None:
            return "time, s"
        return f"position of driver {sweep.number}, {sweep.unit}"
    if found.falls:
        return "sine s of the flattest crossing"
    return "s: root of the distance to go, in parts of the first"


def told(study: Study, n: int) -> str:
    """The unit of an error, and the measured slope."""
    assert study.flattening is not None
    slope = study.flattening.slopes("float64")[n]
    if slope is None or study.flattening.approach.end == "range":
        return COUNTED[n]
    return f"{COUNTED[n]}\nmeasured slope of float64: {slope:.2f}".replace("-", "−")


def title_of(study: Study) -> str:
    """The conclusion, with the kind of end that was approached."""
    found, title = study.flattening, study.mechanism.scene.title
    assert found is not None
    match found.approach.end:
        case "dead":
            return f"Towards a dead point every derivative loses digits faster: {title}"
        case "change":
            return f"Towards a change point every derivative loses digits faster: {title}"
    return f"No dead point within the driver's reach: errors over its whole range: {title}"


def sine_panel(ax: Axes, study: Study, n: int) -> tuple[list[PointName], list[tuple[float, float]]]:
    """Draw one quantity: doubles, single precision, a pencil, and the law through the doubles.

    Returns the names for its lines, and the points that the names may not cover.
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
    """Draw the law of a quantity as a thin line through its errors in doubles."""
    seen = (errors > 0) & (errors < LOST) & (sines < 0.2) & (sines > 1e-7)
    if np.count_nonzero(seen) < 3:
        return
    level = np.median(np.log10(errors[seen]) - LAW[n] * np.log10(sines[seen]))
    ends = np.array([sines.min(), 1.0])
    ax.plot(ends, 10**level * ends ** LAW[n], color=INK, lw=0.6, alpha=0.7, zorder=1)


# --- the three picture files of a study -----------------------------------------------------------


PICTURES = {"time": ladder, "dead-point": slopes, "scope": bars}
"""The pictures by the last part of their file names."""


def picture_files(study: Study, stem: str, formats: Sequence[str]) -> dict[str, bytes]:
    """Every picture of a study by its file name, in each of the formats svg and png."""
    machine = machine_words()
    drawn = ((f"{stem}-accuracy-{k}", partial(of, study, machine)) for k, of in PICTURES.items())
    return plot_style.picture_files(drawn, formats)
