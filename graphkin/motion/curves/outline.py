"""The mechanism as the scene stands, drawn lightly under paths and centrodes."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from math import degrees, radians
from typing import TYPE_CHECKING, Any

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.links.plates import hull
from graphkin.construction.links.wheel_symbols import edges_of
from graphkin.motion.cycle import Cycle
from graphkin.scene.link_points import is_under
from graphkin.scene.model import FRAME, Link, Scene, Slide
from graphkin.text.errors import ClosureError
from graphkin.writers.plot_style import FAINT, INK

if TYPE_CHECKING:
    from matplotlib.axes import Axes

PLATE = "#c9d3dc"
PIN = 4.2
"""Size of a pin in points."""
SYMBOL = 0.017
"""Half the size of a block or pivot, in breadths of the picture."""
PROFILE = 5.0
"""How far a profile is drawn to each side where its length is not written, in such sizes."""
MOST_POINTS = 60
"""Points of a mechanism beyond which a picture shows only the part that it is about."""
FLAT = 1e-3
"""Height of a triangle, in its longest side, below which a plate is drawn as a bar."""


class Outline(Struct, frozen=True):
    """Where every point stands as the scene has it, in the unit of the picture, and at which row.

    ``factor`` turns metres into that unit; ``drawn`` tells whether the scene itself can be drawn:
    else the first row of the cycle takes its place. ``left_out`` says what is not drawn.
    """

    scene: Scene
    places: Mapping[str, complex]
    factor: float
    drawn: bool
    left_out: str = ""

    def breadth(self) -> float:
        """The longer side of the box around the mechanism."""
        every = np.array(list(self.places.values()))
        return float(max(np.ptp(every.real), np.ptp(every.imag))) or 1.0


def stand_of(cycle: Cycle, factor: float) -> Outline:
    """Where the mechanism stands in its scene."""
    drawn = True
    try:
        wanted = [t for t in cycle.mechanism.program.targets if t[0] == "position"]
        trace = cycle.mechanism.trace(wanted)
        places = {of: complex(trace.value(what, of)) * factor for what, of in wanted}
    except ClosureError:
        drawn = False
        every = cycle.solution.points.items()
        places = {n: complex(np.ravel(np.asarray(p.position))[0]) * factor for n, p in every}
    return Outline(cycle.scene, {n: z for n, z in places.items() if not is_under(n)}, factor, drawn)


def stand_about(cycle: Cycle, factor: float, points: Collection[str]) -> Outline:
    """Where the mechanism stands; of a very long one only the links that have one of the points."""
    stand = stand_of(cycle, factor)
    if len(stand.places) <= MOST_POINTS:
        return stand
    every = stand.scene.links
    links = {name: link for name, link in every.items() if not set(points).isdisjoint(link.points)}
    kept = {point for link in links.values() for point in link.points}
    return replace(
        stand,
        scene=replace(stand.scene, links=links),
        places={name: place for name, place in stand.places.items() if name in kept},
        left_out=f"{len(links)} of {len(every)} links drawn",
    )


def draw(ax: Axes, stand: Outline, breadth: float) -> None:
    """Plates, bars, wheels, blocks, pins and pivots, with the letters of the points.

    ``breadth`` is the longer side of the picture, by which symbols are sized.
    """
    size = SYMBOL * breadth
    for link in stand.scene.links.values():
        body(ax, stand, link)
        wheels(ax, stand, link)
        profiles(ax, stand, link, size)
        for slide in link.slides:
            block(ax, stand, link, slide, size)
    wheels(ax, stand, stand.scene.frame)
    profiles(ax, stand, stand.scene.frame, size)
    pinned = {point for link in stand.scene.links.values() for point in link.points}
    for name, place in stand.places.items():
        fixed = name in stand.scene.fixed_points
        if fixed and name in pinned:
            pivot(ax, place, size)
        if name in pinned:
            ax.plot(
                [place.real], [place.imag], "o", ms=PIN, mfc="white", mec=INK, mew=0.9, zorder=6
            )
        if name in pinned:
            letter(ax, stand, name, place)


def letter(ax: Axes, stand: Outline, name: str, place: complex) -> None:
    """The letter of a point, on the side away from the middle of its links."""
    others = [
        stand.places[point]
        for link in stand.scene.links.values()
        if name in link.points
        for point in link.points
        if point != name and point in stand.places
    ]
    away = place - sum(others) / len(others) if others else 1j
    away = away / abs(away) if away else 1j
    way = 9 * away
    if name in stand.scene.fixed_points:
        way = complex(-13 if away.real <= 0 else 13, 3)
    elif (along := block_along(stand, name)) is not None:
        square = 1j * along
        way = 15 * (square if (square * away.conjugate()).real >= 0 else -square)
    ax.annotate(
        name,
        (place.real, place.imag),
        xytext=(way.real, way.imag),
        textcoords="offset points",
        ha="center",
        va="center",
        fontsize=8.5,
        zorder=8,
    )


def block_along(stand: Outline, name: str) -> complex | None:
    """The guide of the block whose first point this is; None where there is none."""
    for link in stand.scene.links.values():
        if link.slides and link.points and name == link.points[0]:
            return guide_of(stand, link.slides[0])
    return None


def body(ax: Axes, stand: Outline, link: Link) -> None:
    """A bar through two points or points in line, a plate through more."""
    places = [
        stand.places[point]
        for point in link.points
        if point in stand.places and not link.is_hollow_about(point)
    ]
    if len(places) < 2:
        return
    corners = hull(places, FLAT)
    if len(corners) < 3:
        first, last = corners
        ax.plot(
            [first.real, last.real],
            [first.imag, last.imag],
            color=FAINT,
            linewidth=2.6,
            solid_capstyle="round",
            zorder=3,
        )
        return
    xs, ys = [z.real for z in corners], [z.imag for z in corners]
    ax.fill(xs, ys, facecolor=PLATE, alpha=0.55, edgecolor=FAINT, linewidth=1.4, zorder=2.5)


def wheels(ax: Axes, stand: Outline, link: Link) -> None:
    """The circles of a link."""
    for wheel in link.wheels:
        place = stand.places.get(wheel.centre)
        if place is not None and wheel.radius is not None:
            radius = float(wheel.radius.si(stand.scene.values)) * stand.factor
            circle(ax, place, radius, color=FAINT, linewidth=1.3, zorder=2.6)


def profiles(ax: Axes, stand: Outline, link: Link, size: float) -> None:
    """The arcs of a link's profiles; none where a centre stands on its own profile."""
    for edge in edges_of(link, stand.places):
        if not edge.arm:
            continue
        half = radians(edge.half(degrees(PROFILE * size / abs(edge.arm)), stand.scene.values))
        rim = edge.centre + edge.arm * np.exp(1j * np.linspace(-half, half, 61))
        ax.plot(rim.real, rim.imag, color=FAINT, linewidth=1.8, zorder=3)


def circle(ax: Axes, centre: complex, radius: float, **style: Any) -> None:
    """A circle as a line."""
    rim = centre + radius * np.exp(1j * np.linspace(0, 2 * np.pi, 361))
    ax.plot(rim.real, rim.imag, **style)


def block(ax: Axes, stand: Outline, link: Link, slide: Slide, size: float) -> None:
    """A block at its first point along its guide, and the guide on the frame as a thin line."""
    place = stand.places.get(link.points[0]) if link.points else None
    along = guide_of(stand, slide)
    if place is None or along is None:
        return
    if slide.on == FRAME:
        ends = place - 3.2 * size * along, place + 3.2 * size * along
        ax.plot(
            [z.real for z in ends],
            [z.imag for z in ends],
            color=FAINT,
            linewidth=0.9,
            linestyle=(0, (8, 2, 1.5, 2)),
            zorder=2,
        )
    if slide.pin:
        return
    corners = [place + along * size * complex(x, y) for x, y in ((-1.2, -0.7), (1.2, -0.7))]
    corners += [place + along * size * complex(x, y) for x, y in ((1.2, 0.7), (-1.2, 0.7))]
    draw_white(ax, corners, 1.0)


def draw_white(ax: Axes, corners: list[complex], edge: float) -> None:
    """A white figure, its edge so wide (points)."""
    xs, ys = [z.real for z in corners], [z.imag for z in corners]
    ax.fill(xs, ys, facecolor="white", edgecolor=INK, linewidth=edge, zorder=4)


def guide_of(stand: Outline, slide: Slide) -> complex | None:
    """The direction of a guide; None where two of its points do not tell it."""
    if slide.along is not None:
        start, end = (stand.places.get(point) for point in slide.along)
        if start is None or end is None or start == end:
            return None
        return complex((end - start) / abs(end - start))
    if slide.on == FRAME and slide.angle is not None:
        return complex(slide.angle.direction(stand.scene.values))
    return None


def pivot(ax: Axes, place: complex, size: float) -> None:
    """A fixed pivot: a triangle on hatched ground."""
    foot = [place, place + size * complex(-0.8, -1.3), place + size * complex(0.8, -1.3)]
    draw_white(ax, foot, 0.9)
    ground = place.imag - 1.3 * size
    ax.plot(
        [place.real - 1.2 * size, place.real + 1.2 * size],
        [ground, ground],
        color=INK,
        linewidth=1.1,
        zorder=4,
    )
    for k in range(5):
        x = place.real + (-1.0 + 0.5 * k) * size
        ax.plot(
            [x, x - 0.35 * size], [ground, ground - 0.45 * size], color=INK, linewidth=0.6, zorder=4
        )
