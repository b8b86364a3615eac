"""Pictures in the plane: paths of points, and centrodes rolling on one another."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from graphkin.motion.centrodes import centrodes, links_with_centrodes
from graphkin.motion.curves.outline import MILLIMETRES, Box, Outline, draw, stand_about
from graphkin.motion.curves.sampled import Sampled, moving_points
from graphkin.scene.link_points import is_under
from graphkin.writers.plot_style import (
    COLOURS,
    FAINT,
    INK,
    colour,
    figure_title,
    new_figure,
    some_of,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

ROOM = 0.09
"""Free space around, in the longer side of what is drawn."""
MOST_PATHS = 16
"""Paths in one picture: each ink twice."""
FAR = 1.6
"""Breadths of the mechanism beyond its box at which centrodes leave the picture."""
LETTERS = 11.5
"""Letters of a legend in an inch."""


def path_points(found: Sampled) -> list[str]:
    """The moving points whose paths are worth drawing: those asked, and those of couplers."""
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
    """The path of every point of interest, the mechanism where the scene stands."""
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
    """The places of a point at every twelfth of a turn; none for other drivers."""
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
    """The fixed centrode of a link, and the moving one where the scene stands, touching it."""
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
    for curve, ink, words in (
        (fixed, COLOURS[0], "fixed centrode"),
        (moving, COLOURS[1], f"moving centrode, carried by link {link}"),
    ):
        line = unbroken(found, curve, window)
        ax.plot(line.real, line.imag, color=ink, label=words, zorder=5)
    if inside(touch, window):
        name = f"$I_{{{link}}}$" if link.isalnum() else "I"
        ax.plot([touch.real], [touch.imag], "o", ms=5, color=INK, zorder=9)
        ax.annotate(name, (touch.real, touch.imag), xytext=(7, 6), textcoords="offset points")
    note = "the moving centrode rolls on the fixed one; they touch in the instantaneous centre"
    below(ax, note, stand)
    return figure


def at_scene(found: Sampled, link: str) -> tuple[complex, complex, complex]:
    """Origin and heading of a link, and its instantaneous centre, where the scene stands."""
    here = found.cycle.along([found.cycle.sweep.start])
    both = centrodes(here if len(here.at) else found.cycle, link)
    assert both is not None
    return complex(both.origin[0]), complex(both.heading[0]), complex(both.fixed[0])


def unbroken(found: Sampled, curve: np.ndarray, window: Box) -> np.ndarray:
    """A curve with NaN where it runs far out of the picture, to be clipped and not joined."""
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
    """The legend above the picture, and below it a note and what of the mechanism is left out."""
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
    """The box around places, with room on all sides."""
    every = np.concatenate([np.ravel(part) for part in parts])
    every = every[np.isfinite(every)]
    x0, x1 = float(every.real.min()), float(every.real.max())
    y0, y1 = float(every.imag.min()), float(every.imag.max())
    room = ROOM * max(x1 - x0, y1 - y0, 1e-9)
    return x0 - room, x1 + room, y0 - room, y1 + room


def near_box(places: np.ndarray, curves: list[np.ndarray], breadth: float, touch: complex) -> Box:
    """The box around the mechanism and what of the curves lies near it."""
    x0, x1, y0, y1 = box_of([places])
    reach = FAR * breadth
    limits = (x0 - reach, x1 + reach, y0 - reach, y1 + reach)
    near = [curve[[inside(z, limits) for z in curve]] for curve in curves]
    touching = np.array([touch]) if inside(touch, limits) else np.array([], dtype=complex)
    return box_of([places, touching, *near])


def inside(z: complex, box: Box) -> bool:
    """Whether a place lies in a box."""
    return bool(box[0] <= z.real <= box[1] and box[2] <= z.imag <= box[3])
