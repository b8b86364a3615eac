"""Figures in the plane: paths of points, and centrodes that roll on one another."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.solution import UNPROVED
from graphkin.construction.links.mechanism_symbols import draw_ground, draw_links
from graphkin.drawing.field import Field
from graphkin.drawing.labels import FieldContent, free_ones
from graphkin.drawing.scale import Scales
from graphkin.mechanism import Mechanism
from graphkin.motion.centrodes import centrodes, links_with_centrodes
from graphkin.motion.curves.over_driver import Sampled, moving_points
from graphkin.motion.cycle import Cycle
from graphkin.motion.single_loop import Band, Loop, Ring, class_of
from graphkin.scene.link_points import is_under
from graphkin.text import words
from graphkin.text.errors import ClosureError
from graphkin.writers.plot_style import (
    COLOURS,
    FAINT,
    INK,
    WARNING,
    colour,
    figure_title,
    new_figure,
    some_of,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Box = tuple[float, float, float, float]
MILLIMETRES = 180.0
"""Longer side of a figure in mm."""
OUTLINE_FAINT = 0.6
"""Opacity of the mechanism's lines among the curves."""
MOST_POINTS = 60
"""Points of a mechanism above which a figure shows only the links that it concerns."""


class Outline(Struct, frozen=True):
    """The mechanism in the scene's position; ``factor`` converts metres to the figure's unit.

    ``drawn`` means that the scene itself can be drawn; otherwise the first row of the cycle
    replaces it. ``left_out`` says what is not drawn.
    """

    drawing: Drawing
    factor: float
    drawn: bool
    left_out: str = ""

    @property
    def places(self) -> Mapping[str, complex]:
        """Positions of all points, in the figure's unit."""
        return {name: place * self.factor for name, place in self.drawing.positions.items()}

    def breadth(self) -> float:
        """The longer side of the box around the mechanism."""
        every = np.array(list(self.places.values()))
        return float(max(np.ptp(every.real), np.ptp(every.imag))) or 1.0


def stand_of(cycle: Cycle, factor: float) -> Outline:
    """The mechanism in the scene's position, or in the first row of the cycle."""
    try:
        return Outline(placed(cycle.mechanism), factor, True)
    except ClosureError:
        first = cycle.pieces[cycle.piece[0] - 1]
        return Outline(placed(first.course.mechanism(cycle.at[0])), factor, False)


def placed(mechanism: Mechanism) -> Drawing:
    """The drawing of a mechanism without its plans."""
    trace = mechanism.trace([t for t in mechanism.program.targets if t[0] in ("position", "axis")])
    scales = Scales(1.0, 1.0, triangles=False)
    return Drawing("velocity", mechanism.scene, trace, scales, UNPROVED, words("en"))


def stand_about(cycle: Cycle, factor: float, points: Collection[str]) -> Outline:
    """The mechanism's outline; for a long mechanism, only the links with one of the points."""
    stand = stand_of(cycle, factor)
    if len(stand.places) <= MOST_POINTS:
        return stand
    scene, every = stand.drawing.scene, stand.drawing.scene.links
    links = {name: link for name, link in every.items() if not set(points).isdisjoint(link.points)}
    return replace(
        stand,
        drawing=replace(stand.drawing, scene=replace(scene, links=links)),
        left_out=f"{len(links)} of {len(every)} links drawn",
    )


def draw(ax: Axes, stand: Outline, box: Box) -> None:
    """Draw the mechanism in axes over a ``box``, with the letters that fit."""
    from graphkin.writers.axes import put_to_scale

    (x0, x1, y0, y1), per_metre = box, stand.factor
    times = MILLIMETRES / max(x1 - x0, y1 - y0)
    middle = complex(x0 + x1, y0 + y1) / (2 * per_metre)
    wide, high = (x1 - x0) * times, (y1 - y0) * times
    rect = (0.0, 0.0, wide, high)
    field = Field(rect, per_metre * times, middle, (wide / 2, high / 2))
    board = FieldContent(rect)
    draw_ground(board, stand.drawing, field)
    draw_links(board, stand.drawing, field)
    marks = [*board.marks, *free_ones(board, board.spots([]))]
    put_to_scale(ax, marks, field(0j), times, strength=OUTLINE_FAINT)


# --- paths of points, and centrodes that roll on one another --------------------------------------


ROOM = 0.09
"""Margin around a drawing, as a share of its longer side."""
MOST_PATHS = 16
"""Most paths in one figure: each colour twice."""
FAR = 1.6
"""Distance from the mechanism's box, in its breadths, at which centrodes are cut off."""
LETTERS = 11.5
"""Letters of a legend per inch."""


def path_points(found: Sampled) -> list[str]:
    """The moving points whose paths are drawn: requested points and points of couplers."""
    scene = found.scene
    fixed = set(scene.fixed_points)
    driven = {driver.link for driver in scene.drivers}
    couplers = [
        point
        for name, link in scene.links.items()
        if name not in driven and fixed.isdisjoint(link.points) and len(link.points) > 1
        for point in link.points
    ]
    names = dict.fromkeys((*moving_points(scene, found.solution), *couplers))
    own = [name for name in names if not is_under(name) and name not in fixed]
    return [name for name in own if name in found.solution.points]


def paths(found: Sampled) -> Figure:
    """The path of every point of interest, with the mechanism in the scene's position."""
    names, more = some_of(path_points(found), MOST_PATHS, "points")
    stand = stand_about(found.cycle, found.per_length, names)
    curves = {
        name: np.asarray(found.solution.points[name].position) * found.per_length for name in names
    }
    box = box_of([np.array(list(stand.places.values())), *curves.values()])
    figure, ax = plane(found, f"Paths of points{more}", box)
    draw(ax, stand, box)
    for i, (name, curve) in enumerate(curves.items()):
        line = found.broken(curve)
        ax.plot(line.real, line.imag, color=colour(i), label=f"path of {name}", zorder=5)
        dots = dotted(found, curve)
        ax.plot(dots.real, dots.imag, "o", ms=2.6, color=colour(i), zorder=5.5)
    note = ", a dot every 30° of the driver" if found.cycle.sweep.what == "turn" else ""
    note = f"mechanism as the scene has it{note}" if stand.drawn else note.lstrip(", ")
    below(ax, note, stand)
    return figure


def dotted(found: Sampled, curve: np.ndarray) -> np.ndarray:
    """The positions of a point every 30° of the driver's turn; none for other drivers."""
    if found.cycle.sweep.what != "turn":
        return np.array([], dtype=complex)
    parts = []
    bounds = [0, *found.breaks, len(curve)]
    for first, last in pairwise(bounds):
        at, part = found.at[first:last], curve[first:last]
        if len(at):
            even = np.arange(np.ceil(at[0] / 30), np.floor(at[-1] / 30) + 1) * 30
            parts.append(np.interp(even, at, part.real) + 1j * np.interp(even, at, part.imag))
    return np.concatenate(parts)


def centrode_links(found: Sampled) -> list[str]:
    """The links whose centrodes can be drawn."""
    return [
        link
        for link in links_with_centrodes(found.scene)
        if link in found.solution.links and centrodes(found.cycle, link) is not None
    ]


def both_centrodes(found: Sampled, link: str) -> Figure:
    """The fixed centrode of a link, and the moving one that touches it in the scene's position."""
    stand = stand_about(found.cycle, found.per_length, found.scene.links[link].points)
    both = centrodes(found.cycle, link)
    assert both is not None
    here = at_scene(found, link)
    fixed = both.fixed * found.per_length
    moving = both.placed(*here[:2]) * found.per_length
    places = np.array(list(stand.places.values()))
    touch = here[2] * found.per_length
    window = near_box(places, [fixed, moving], stand.breadth(), touch)
    figure, ax = plane(found, f"Centrodes of link {link}", window)
    draw(ax, stand, window)
    for curve, ink, name in (
        (fixed, COLOURS[0], "fixed centrode"),
        (moving, COLOURS[1], f"moving centrode, carried by link {link}"),
    ):
        line = unbroken(found, curve, window)
        ax.plot(line.real, line.imag, color=ink, label=name, zorder=5)
    if inside(touch, window):
        name = f"$I_{{{link}}}$" if link.isalnum() else "I"
        ax.plot([touch.real], [touch.imag], "o", ms=5, color=INK, zorder=9)
        ax.annotate(name, (touch.real, touch.imag), xytext=(7, 6), textcoords="offset points")
    note = "the moving centrode rolls on the fixed one; they touch in the instantaneous centre"
    below(ax, note, stand)
    return figure


def at_scene(found: Sampled, link: str) -> tuple[complex, complex, complex]:
    """Origin, heading and instantaneous centre of a link in the scene's position."""
    here = found.cycle.along([found.cycle.sweep.start])
    both = centrodes(here if len(here.at) else found.cycle, link)
    assert both is not None
    return complex(both.origin[0]), complex(both.heading[0]), complex(both.fixed[0])


def unbroken(found: Sampled, curve: np.ndarray, window: Box) -> np.ndarray:
    """A curve with NaN far outside the figure, so that it is clipped and not joined."""
    line = found.broken(curve)
    x0, x1, y0, y1 = window
    wide, high = x1 - x0, y1 - y0
    with np.errstate(invalid="ignore"):
        out = (line.real < x0 - wide) | (line.real > x1 + wide)
        out |= (line.imag < y0 - high) | (line.imag > y1 + high) | ~np.isfinite(line)
    return np.where(out, complex(np.nan, np.nan), line)


def plane(found: Sampled, title: str, box: Box) -> tuple[Figure, Axes]:
    """A figure with equal axes over a box."""
    wide, high = box[1] - box[0], box[3] - box[2]
    scale = MILLIMETRES / 25.4 / max(wide, high)
    figure = new_figure(max(wide * scale, 5.2) + 0.7, max(high * scale, 2.6) + 1.5)
    figure_title(figure, f"{title}: {found.title}", x=0.01, ha="left", fontsize=11)
    ax = figure.subplots()
    ax.set_xlim(box[0], box[1])
    ax.set_ylim(box[2], box[3])
    ax.set_aspect("equal", adjustable="box")
    ax.set_xlabel(f"x, {found.length_unit}")
    ax.set_ylabel(f"y, {found.length_unit}")
    return figure, ax


def below(ax: Axes, note: str, stand: Outline) -> None:
    """Add the legend above the figure, and below it a note and what is left out."""
    note = "; ".join(filter(None, (note, stand.left_out)))
    handles, labels = ax.get_legend_handles_labels()
    figure = ax.get_figure(root=True)
    assert figure is not None
    if handles:
        longest = max(map(len, labels)) + 7
        ax.legend(
            handles=handles,
            labels=[str(label) for label in labels],
            loc="lower left",
            bbox_to_anchor=(0.0, 1.0),
            ncols=max(1, int(LETTERS * figure.get_size_inches()[0] / longest)),
            borderaxespad=0.3,
            handlelength=2.0,
        )
    if note:
        figure.supxlabel(note, x=0.01, ha="left", fontsize=8, color=FAINT)


def box_of(parts: list[np.ndarray]) -> Box:
    """The box around positions, with a margin on all sides."""
    every = np.concatenate([np.ravel(part) for part in parts])
    every = every[np.isfinite(every)]
    x0, x1 = float(every.real.min()), float(every.real.max())
    y0, y1 = float(every.imag.min()), float(every.imag.max())
    room = ROOM * max(x1 - x0, y1 - y0, 1e-9)
    return x0 - room, x1 + room, y0 - room, y1 + room


def near_box(places: np.ndarray, curves: list[np.ndarray], breadth: float, touch: complex) -> Box:
    """The box around the mechanism and the parts of the curves near it."""
    x0, x1, y0, y1 = box_of([places])
    reach = FAR * breadth
    limits = (x0 - reach, x1 + reach, y0 - reach, y1 + reach)
    near = [curve[[inside(z, limits) for z in curve]] for curve in curves]
    touching = np.array([touch]) if inside(touch, limits) else np.array([], dtype=complex)
    return box_of([places, touching, *near])


def inside(z: complex, box: Box) -> bool:
    return bool(box[0] <= z.real <= box[1] and box[2] <= z.imag <= box[3])


# --- the ring of a single loop: the path of its driven pin, and the reach of the rest -------------


TURNED = np.exp(1j * np.linspace(0, 2 * np.pi, 1441))
"""Unit vectors in all directions."""
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
    """The foot of the perpendicular from the crank's pivot to the guide."""
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
    """Which positions the rest of the loop can reach."""
    if isinstance(loop.reach, Ring):
        away = np.abs(places - loop.reach.centre)
        slack = 1e-9 * loop.reach.outer
        return np.asarray((loop.reach.inner - slack <= away) & (away <= loop.reach.outer + slack))
    line = loop.reach.line
    aside = np.abs(((places - line.point) * np.conj(line.along)).imag)
    return np.asarray(aside <= loop.reach.half * (1 + 1e-9))


def area(ax: Axes, loop: Loop, factor: float, box: Box) -> None:
    """Draw the ring or band, lightly filled."""
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
    """Draw a lightly filled area."""
    ax.fill(rim.real, rim.imag, facecolor=AREA, edgecolor="none", zorder=0.5, label=words)


def within(loop: Loop) -> str:
    """The legend of the filled area."""
    if isinstance(loop.reach, Ring):
        return f"ring that {loop.pins[2]}'s two links reach about {loop.pins[3]}"
    return f"band that the rod reaches on either side of the path of {loop.pins[2]}"


def pin_path(ax: Axes, loop: Loop, factor: float) -> None:
    """Draw the driven pin's path, solid where it is within reach, dashed and red elsewhere."""
    places = path_places(loop)
    good = reached(loop, places)
    what = "circle" if isinstance(loop.path, Ring) else "line"
    for flags, ink, stroke, name in (
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
                label=name,
                zorder=5,
            )


def dead_marks(ax: Axes, found: Sampled, loop: Loop) -> None:
    """Mark the pin's positions at the dead points, beyond which the driver cannot go."""
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
    """The verdict below the figure."""
    more = "; further groups may narrow the range" if loop.more else ""
    if loop.kind == "four-bar":
        turns = "turns fully" if loop.turns else "cannot turn fully"
        return f"{class_of(loop)}: the driver {turns}{more}"
    says = "the driver turns fully" if loop.turns else "the driver moves between dead points"
    return f"slider-crank: {says}{more}"
