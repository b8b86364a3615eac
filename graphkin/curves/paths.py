"""Pictures in the plane: paths of points, centrodes rolling on one another, the ring of a loop."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from graphkin.curves.mechanism import Stand, circle, draw, stand_of
from graphkin.curves.sampled import Sampled, moving_points
from graphkin.curves.style import COLOURS, FAINT, INK, WARNING, colour, new_figure
from graphkin.motion.centrodes import Centrodes, centrodes, links_with_centrodes
from graphkin.motion.loop import Band, Loop, Ring

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SIDE = 7.2
"""Longer side of a picture in inches."""
ROOM = 0.09
"""Free space around, in the longer side of what is drawn."""
MARKS = 12
"""Dots on the path of a point in a whole turn: one every 30 degrees."""
FAR = 1.6
"""Breadths of the mechanism beyond its box at which centrodes leave the picture."""
CLOSE = 7200
"""Places at which centrodes are sampled."""
TURNED = np.exp(1j * np.linspace(0, 2 * np.pi, 1441))
"""Unit vectors all round."""
GREEN = "#2b8a5b"
LETTERS = 11.5
"""Letters of a legend in an inch."""
AREA = "#e3efe6"

Box = tuple[float, float, float, float]


def path_points(found: Sampled) -> list[str]:
    """The moving points whose paths are worth drawing: those asked, and those of couplers."""
    scene = found.scene
    fixed = set(scene.frame.points)
    driven = {driver.link for driver in scene.drivers}
    couplers = [
        point
        for name, link in scene.links.items()
        if name not in driven and fixed.isdisjoint(link.points) and len(link.points) > 1
        for point in link.points
    ]
    names = dict.fromkeys((*moving_points(scene, found.solution), *couplers))
    return [n for n in names if n in found.solution.points and n not in fixed]


def paths(found: Sampled) -> Figure:
    """The path of every point of interest, the mechanism where the scene stands."""
    stand = stand_of(found.cycle, found.per_length)
    curves = {
        name: np.asarray(found.solution.points[name].position) * found.per_length
        for name in path_points(found)
    }
    box = box_of([np.array(list(stand.places.values())), *curves.values()])
    figure, ax = plane(found, "Paths of points", box)
    draw(ax, stand, breadth_of(box))
    for i, (name, curve) in enumerate(curves.items()):
        line = found.broken(curve)
        ax.plot(line.real, line.imag, color=colour(i), label=f"path of {name}", zorder=5)
        dots = dotted(found, curve)
        ax.plot(dots.real, dots.imag, "o", ms=2.6, color=colour(i), zorder=5.5)
    note = ", a dot every 30° of the driver" if found.cycle.sweep.what == "turn" else ""
    below(ax, f"mechanism as the scene has it{note}" if stand.drawn else note.lstrip(", "))
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


def rolling(found: Sampled, link: str) -> Figure:
    """The fixed centrode of a link, and the moving one where the scene stands, touching it."""
    stand = stand_of(found.cycle, found.per_length)
    both = centrodes(found.cycle, link)
    assert both is not None
    here = at_scene(found, link)
    fixed = both.fixed * found.per_length
    moving = both.placed(*here[:2]) * found.per_length
    places = np.array(list(stand.places.values()))
    touch = here[2] * found.per_length
    window = near_box(places, [fixed, moving], stand.breadth(), touch)
    figure, ax = plane(found, f"Centrodes of link {link}", window)
    draw(ax, stand, breadth_of(window))
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
    below(ax, "the moving centrode rolls on the fixed one; they touch in the instantaneous centre")
    return figure


def at_scene(found: Sampled, link: str) -> tuple[complex, complex, complex]:
    """Origin and heading of a link, and its instantaneous centre, where the scene stands."""
    cycle = found.cycle
    here = cycle.along([cycle.sweep.start])
    row = 0
    if not len(here.at):
        here = cycle
    found_here = centrodes(here, link)
    assert isinstance(found_here, Centrodes)
    return (
        complex(found_here.origin[row]),
        complex(found_here.heading[row]),
        complex(found_here.fixed[row]),
    )


def unbroken(found: Sampled, curve: np.ndarray, window: Box) -> np.ndarray:
    """A curve with NaN where it runs far out of the picture, to be clipped and not joined."""
    line = found.broken(curve)
    x0, x1, y0, y1 = window
    wide, high = x1 - x0, y1 - y0
    with np.errstate(invalid="ignore"):
        out = (line.real < x0 - wide) | (line.real > x1 + wide)
        out |= (line.imag < y0 - high) | (line.imag > y1 + high) | ~np.isfinite(line)
    return np.where(out, complex(np.nan, np.nan), line)


def reach(found: Sampled, loop: Loop) -> Figure:
    """The path of the driven pin against the ring or band that the rest of the loop can reach."""
    stand = stand_of(found.cycle, found.per_length)
    factor = found.per_length
    if isinstance(loop.reach, Ring):
        rim = loop.reach.centre + loop.reach.outer * np.array([1, 1j, -1, -1j])
        parts = [rim * factor, path_places(loop, stand) * factor]
    else:
        parts = [path_places(loop, stand) * factor]
        half = 1j * loop.reach.line.along * loop.reach.half
        foot = foot_of(loop.reach, loop) if isinstance(loop.path, Ring) else loop.reach.line.point
        parts.append(np.array([foot + half, foot - half]) * factor)
    box = box_of([np.array(list(stand.places.values())), *parts])
    figure, ax = plane(found, "What the driven pin passes, and what the rest can reach", box)
    area(ax, loop, factor, box)
    draw(ax, stand, breadth_of(box))
    pin_path(ax, loop, stand, factor)
    dead_marks(ax, found, loop)
    below(ax, reach_note(loop))
    return figure


def foot_of(band: Band, loop: Loop) -> complex:
    """The foot of the perpendicular from the crank's pivot on the guide."""
    assert isinstance(loop.path, Ring)
    way = loop.path.centre - band.line.point
    along = band.line.along
    return complex(band.line.point + along * (way * along.conjugate()).real)


def path_places(loop: Loop, stand: Stand) -> np.ndarray:
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
        turn = np.exp(1j * np.linspace(0, 2 * np.pi, 361))
        outer = (loop.reach.centre + loop.reach.outer * turn) * factor
        inner = (loop.reach.centre + loop.reach.inner * turn[::-1]) * factor
        rim = np.concatenate([outer, inner])
        ax.fill(
            rim.real, rim.imag, facecolor=AREA, edgecolor="none", zorder=0.5, label=within(loop)
        )
        for radius in (loop.reach.outer, loop.reach.inner):
            circle(ax, loop.reach.centre * factor, radius * factor, color=GREEN, linewidth=0.9)
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


def pin_path(ax: Axes, loop: Loop, stand: Stand, factor: float) -> None:
    """The path of the driven pin, whole where it is within reach, dashed and red elsewhere."""
    places = path_places(loop, stand)
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
    from graphkin.motion.loop import class_of

    more = "; further groups may narrow the range" if loop.more else ""
    if loop.kind == "four-bar":
        turns = "turns fully" if loop.turns else "cannot turn fully"
        return f"{class_of(loop)}: the driver {turns}{more}"
    says = "the driver turns fully" if loop.turns else "the driver moves between dead points"
    return f"slider-crank: {says}{more}"


def plane(found: Sampled, title: str, box: Box) -> tuple[Figure, Axes]:
    """A figure with equal axes over a box."""
    wide, high = box[1] - box[0], box[3] - box[2]
    scale = SIDE / max(wide, high)
    figure = new_figure(max(wide * scale, 5.2) + 0.7, max(high * scale, 2.6) + 1.5)
    figure.suptitle(f"{title}: {found.title}", x=0.01, ha="left", fontsize=11)
    ax = figure.subplots()
    ax.set_xlim(box[0], box[1])
    ax.set_ylim(box[2], box[3])
    ax.set_aspect("equal", adjustable="box")
    ax.set_xlabel(f"x, {found.length_unit}")
    ax.set_ylabel(f"y, {found.length_unit}")
    return figure, ax


def below(ax: Axes, note: str) -> None:
    """The legend above the picture, and a note below it."""
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


def breadth_of(box: Box) -> float:
    """The longer side of a box."""
    return max(box[1] - box[0], box[3] - box[2])


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
