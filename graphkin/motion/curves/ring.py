"""The ring of a single loop: where its driven pin passes, and what the rest of it can reach."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from graphkin.motion.curves.outline import Box, draw, stand_about
from graphkin.motion.curves.plane_paths import below, box_of, plane
from graphkin.motion.curves.sampled import Sampled
from graphkin.motion.single_loop import Band, Loop, Ring, class_of
from graphkin.writers.plot_style import COLOURS, FAINT, WARNING

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

TURNED = np.exp(1j * np.linspace(0, 2 * np.pi, 1441))
"""Unit vectors all round."""
GREEN = "#2b8a5b"
AREA = "#e3efe6"


def reach(found: Sampled, loop: Loop) -> Figure:
    """The path of the driven pin against the ring or band that the rest of the loop can reach."""
    stand = stand_about(found.cycle, found.per_length, loop.pins)
    factor = found.per_length
    if isinstance(loop.reach, Ring):
        rim = loop.reach.centre + loop.reach.outer * np.array([1, 1j, -1, -1j])
        parts = [rim * factor, path_places(loop) * factor]
    else:
        parts = [path_places(loop) * factor]
        half = 1j * loop.reach.line.along * loop.reach.half
        foot = foot_of(loop.reach, loop) if isinstance(loop.path, Ring) else loop.reach.line.point
        parts.append(np.array([foot + half, foot - half]) * factor)
    box = box_of([np.array(list(stand.places.values())), *parts])
    figure, ax = plane(found, "What the driven pin passes, and what the rest can reach", box)
    area(ax, loop, factor, box)
    draw(ax, stand, box)
    pin_path(ax, loop, factor)
    dead_marks(ax, found, loop)
    below(ax, reach_note(loop), stand)
    return figure


def foot_of(band: Band, loop: Loop) -> complex:
    """The foot of the perpendicular from the crank's pivot on the guide."""
    assert isinstance(loop.path, Ring)
    way = loop.path.centre - band.line.point
    along = band.line.along
    return complex(band.line.point + along * (way * along.conjugate()).real)


def path_places(loop: Loop) -> np.ndarray:
    """The path of the driven pin (m): its circle, or a piece of its line past the reach."""
    if isinstance(loop.path, Ring):
        return np.asarray(loop.path.centre + loop.path.outer * TURNED)
    assert isinstance(loop.reach, Ring)
    along = loop.path.along
    way = loop.reach.centre - loop.path.point
    foot = loop.path.point + along * (way * along.conjugate()).real
    return np.asarray(foot + along * np.linspace(-1.15, 1.15, 1441) * loop.reach.outer)


def reached(loop: Loop, places: np.ndarray) -> np.ndarray:
    """Which places the rest of the loop can reach."""
    if isinstance(loop.reach, Ring):
        away = np.abs(places - loop.reach.centre)
        slack = 1e-9 * loop.reach.outer
        return np.asarray((loop.reach.inner - slack <= away) & (away <= loop.reach.outer + slack))
    line = loop.reach.line
    aside = np.abs(((places - line.point) * np.conj(line.along)).imag)
    return np.asarray(aside <= loop.reach.half * (1 + 1e-9))


def area(ax: Axes, loop: Loop, factor: float, box: Box) -> None:
    """The ring or band, lightly filled."""
    if isinstance(loop.reach, Ring):
        outer, inner = (
            (loop.reach.centre + loop.reach.outer * TURNED) * factor,
            (loop.reach.centre + loop.reach.inner * TURNED[::-1]) * factor,
        )
        filled(ax, np.concatenate([outer, inner]), within(loop))
        for rim in (outer, inner):
            ax.plot(rim.real, rim.imag, color=GREEN, linewidth=0.9)
        return
    line, half = loop.reach.line, loop.reach.half
    long = 2 * max(abs(bound) for bound in box) + abs(line.point) * factor
    ends = np.array([-1, 1]) * line.along * long
    edges = [(line.point + side * 1j * line.along * half) * factor + ends for side in (1, -1)]
    rim = np.concatenate([edges[0], edges[1][::-1]])
    filled(ax, rim, within(loop))
    for edge in edges:
        ax.plot(edge.real, edge.imag, color=GREEN, linewidth=0.9, zorder=1)
    middle = line.point * factor + ends
    ax.plot(middle.real, middle.imag, color=FAINT, linewidth=0.8, linestyle=(0, (8, 2, 1.5, 2)))


def filled(ax: Axes, rim: np.ndarray, words: str) -> None:
    """A lightly filled area."""
    ax.fill(rim.real, rim.imag, facecolor=AREA, edgecolor="none", zorder=0.5, label=words)


def within(loop: Loop) -> str:
    """What the filled area is."""
    if isinstance(loop.reach, Ring):
        return f"ring that {loop.pins[2]}'s two links reach about {loop.pins[3]}"
    return f"band that the rod reaches on either side of the path of {loop.pins[2]}"


def pin_path(ax: Axes, loop: Loop, factor: float) -> None:
    """The path of the driven pin, whole where it is within reach, dashed and red elsewhere."""
    places = path_places(loop)
    good = reached(loop, places)
    what = "circle" if isinstance(loop.path, Ring) else "line"
    for flags, ink, stroke, words in (
        (good, COLOURS[0], "-", f"{what} of {loop.pins[1]}, within reach"),
        (~good, WARNING, (0, (4, 2)), f"{what} of {loop.pins[1]}, out of reach"),
    ):
        if flags.any():
            line = np.where(flags, places, complex(np.nan, np.nan)) * factor
            ax.plot(
                line.real,
                line.imag,
                color=ink,
                linestyle=stroke,
                linewidth=2,
                label=words,
                zorder=5,
            )


def dead_marks(ax: Axes, found: Sampled, loop: Loop) -> None:
    """Where the driver can go no further: the pin's places at the dead points."""
    cycle = found.cycle
    way = 1e-6 * (found.at.max() - found.at.min())
    for pieces in cycle.path.ranges:
        for end, at in (
            (pieces[0].low, pieces[0].low.at + way),
            (pieces[-1].high, pieces[-1].high.at - way),
        ):
            row = cycle.along([at])
            if end.kind != "dead" or not len(row.at):
                continue
            place = complex(np.ravel(np.asarray(row.solution.points[loop.pins[1]].position))[0])
            place *= found.per_length
            ax.plot([place.real], [place.imag], "D", ms=5, color=WARNING, zorder=9)
            sign = "φ" if cycle.sweep.what == "turn" else "s"
            value = end.at if cycle.sweep.what == "turn" else end.at * found.per_length
            unit = "°" if cycle.sweep.what == "turn" else f" {found.length_unit}"
            ax.annotate(
                f"{sign} = {value:.2f}{unit}",
                (place.real, place.imag),
                xytext=(8, 8 if place.imag >= 0 else -12),
                textcoords="offset points",
                color=WARNING,
                fontsize=8,
                zorder=9,
                bbox={"boxstyle": "round,pad=0.15", "fc": "white", "ec": "none", "alpha": 0.8},
            )


def reach_note(loop: Loop) -> str:
    """The verdict below the picture."""
    more = "; further groups may narrow the range" if loop.more else ""
    if loop.kind == "four-bar":
        turns = "turns fully" if loop.turns else "cannot turn fully"
        return f"{class_of(loop)}: the driver {turns}{more}"
    says = "the driver turns fully" if loop.turns else "the driver moves between dead points"
    return f"slider-crank: {says}{more}"
