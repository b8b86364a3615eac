"""Names beside points, each where it covers neither a point nor another name."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from math import cos, hypot, radians, sin
from typing import TYPE_CHECKING, Any

import numpy as np
from msgspec import Struct

from graphkin.writers.plot_style import FAINT

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

GREY = "#56646f"
"""Ink of notes."""
RINGS = (9.0, 15.0, 24.0, 36.0, 50.0, 66.0, 84.0)
"""Distances from a point to its name that are tried, in points of print."""
TURNS = (0, 180, 90, 270, 35, 145, 325, 215, 60, 120, 300, 240)
"""Directions that are tried, the best first, in degrees."""
LED = 12.0
"""Distance from which a thin line leads to the point."""
AIR = 2.0
"""Free space around a name and a point, in points of print."""
DOT = 4.0
"""Half the size of a point."""

Box = tuple[float, float, float, float]


class PointName(Struct, frozen=True):
    """A name that belongs to a point in the axes' own numbers."""

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
    """Write names beside their points; further ``points`` and ``lines`` are left free.

    Gives the boxes of the names in pixels.
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
    """Where the middle of a name may lie, from its point, in points of print; and its box."""
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
    """Write a name, with a thin line to its point where it lies apart."""
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
    """The square around a point."""
    return x - half, y - half, x + half, y + half


def overlap(box: Box, others: Any) -> float:
    """The area that a box shares with others (N, 4), summed one after the other."""
    others = np.asarray(others, dtype=np.float64).reshape(-1, 4)
    wide = np.minimum(box[2], others[:, 2]) - np.maximum(box[0], others[:, 0])
    high = np.minimum(box[3], others[:, 3]) - np.maximum(box[1], others[:, 1])
    both = (wide > 0) & (high > 0)
    return float(sum((wide[both] * high[both]).tolist()))


def outside(box: Box, room: Any) -> float:
    """The area of a box that lies outside the axes."""
    whole = (box[2] - box[0]) * (box[3] - box[1])
    return whole - overlap(box, [(room.x0, room.y0, room.x1, room.y1)])
