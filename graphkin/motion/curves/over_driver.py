"""Curves over the driver: positions, velocities, accelerations, rotation, slides."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct

from graphkin.construction.core.quantities import (
    BALANCING_FORCE,
    BALANCING_MOMENT,
    BY_TARGET,
    JERK,
    MOTION,
    PAIR_REACTION,
    PLURALS,
    RATES,
    VECTORS,
    motion_value,
    names_asked,
)
from graphkin.construction.core.solution import Solution
from graphkin.motion.cycle import Cycle
from graphkin.motion.driving import TURN
from graphkin.scene.model import Scene
from graphkin.scene.quantity import SI
from graphkin.writers.plot_style import (
    COLOURS,
    DASHES,
    FAINT,
    INK,
    WARNING,
    colour,
    dash,
    figure_title,
    legend,
    new_figure,
    panel_heading,
    some_of,
    span_of,
    subscripted,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from graphkin.motion.forces_along import ForcesAlong

Reals = np.ndarray[tuple[int], np.dtype[np.float64]]

FINE = 720
"""Positions in a piece or a full turn."""
END = 3e-4
"""Share of a piece left out at an end where rates grow without bound."""


class Sampled(Struct, frozen=True, eq=False):
    """The motion at closely spaced u, rising within each range.

    ``breaks`` are the row numbers at which a new range begins.
    """

    cycle: Cycle
    breaks: tuple[int, ...]

    @property
    def at(self) -> Reals:
        """u of every row."""
        return self.cycle.at

    @property
    def solution(self) -> Solution:
        """The motion in every row, without uncertain digits."""
        return self.cycle.sure

    @property
    def scene(self) -> Scene:
        return self.cycle.scene

    def broken(self, values: np.ndarray) -> np.ndarray:
        """Values with NaN between ranges, so that no line is drawn there."""
        array = np.broadcast_to(np.asarray(values), self.at.shape)
        array = array.astype(complex if np.iscomplexobj(array) else float)
        return np.insert(array, list(self.breaks), np.nan)

    @property
    def title(self) -> str:
        """The title of the scene with its parameters as set."""
        values = self.scene.values
        settings = [
            f"{name} = {float(values[name]):.6g}"
            for name in self.scene.parameters
            if name in values
        ]
        return ", ".join([self.scene.title, *settings])

    @property
    def length_unit(self) -> str:
        """The scene's unit of length."""
        return self.scene.units["length"]

    @property
    def per_length(self) -> float:
        """The factor from metres to the scene's unit of length."""
        return 1 / float(SI[self.length_unit][0])


def sampled(cycle: Cycle, fine: int = FINE) -> Sampled:
    """A cycle at positions suitable for curves."""
    rows, breaks, count = [], [], 0
    for pieces in cycle.path.ranges:
        parts = []
        for piece in pieces:
            low, high = piece.low.at, piece.high.at
            if {piece.low.kind, piece.high.kind} <= {"window", "number"}:
                parts.append(np.linspace(low, high, fine + 1))
                continue
            share = np.linspace(END if piece.low.kind in ("dead", "change") else 0, 1, fine + 1)
            share = share * (1 - END) if piece.high.kind in ("dead", "change") else share
            ease = 0.5 - 0.5 * np.cos(np.pi * share)
            parts.append(low + (high - low) * ease)
        found = np.concatenate(parts)
        if count:
            breaks.append(count)
        rows.append(found)
        count += len(found)
    at = np.concatenate(rows)
    fine_cycle = cycle.along(at)
    if len(fine_cycle.at) != len(at):
        kept = np.isin(at, fine_cycle.at)
        before = np.concatenate([[0], np.cumsum(kept)])
        breaks = [int(before[b]) for b in breaks]
    return Sampled(fine_cycle, tuple(breaks))


def moving_points(scene: Scene, solution: Solution) -> list[str]:
    """The requested points, else all that are neither fixed nor on a driven link alone."""
    asked = names_asked(scene.ask, *VECTORS, MOTION[JERK])
    known = [name for name in asked if name in solution.points]
    if known:
        return known
    driven = {driver.link for driver in scene.drivers}
    found = dict.fromkeys(
        point
        for name, link in scene.links.items()
        if name not in driven
        for point in link.points
        if point not in scene.fixed_points and point in solution.points
    )
    return list(found)


def turning_links(scene: Scene, solution: Solution) -> list[str]:
    """The requested links, else all that turn and are not driven at constant speed."""
    asked = names_asked(scene.ask, *RATES)
    known = [name for name in asked if name in solution.links]
    if known:
        return known
    driven = {driver.link for driver in scene.drivers}
    return [
        name
        for name, motion in solution.links.items()
        if name not in driven and motion.omega is not None and np.any(motion.omega)
    ]


# --- the figures over the driver ------------------------------------------------------------------


WIDTH = 8.0
PANEL = 2.15
"""Height of a panel in inches; title and axis take 0.9 more."""
MOST_PANELS = 6
MOST_CURVES = 8
"""The most curves in one panel: the number of colours, and of names in a legend's line."""
LINE = 84
"""Letters above a panel that fit on one line."""
NAMED = 11
"""Letters that the stroke and the name of a curve take up."""
WORDS_WIDE, LETTER_TALL, NARROW = 0.03, 0.027, 0.01
"""Words along a line: their width as a share of the axis, then a letter and the clearance.

The last two are shares of a panel's height.
"""
TURNS = (15, 30, 45, 60, 90, 180, 360)
"""Steps of an axis of angles in degrees."""
TICKS = 13
LEAST_TICKS = 2
"""The fewest steps for ticks at whole parts of a turn on an axis of angles."""

Curve = tuple[str, np.ndarray, str, object]
"""A label, values, a colour and a stroke."""


def pictures(found: Sampled) -> dict[str, Callable[[], Figure]]:
    """The figures of a cycle by name, each drawn when called."""
    scene, solution = found.scene, found.solution
    points = moving_points(scene, solution)
    drawn: dict[str, Callable[[], Figure]] = {}
    for quantity, name in PLURALS.items():
        if any(getattr(solution.points[p], quantity) is not None for p in points):
            drawn[name] = partial(of_points, found, points, quantity)
    links = turning_links(scene, solution)
    if links:
        drawn["turning"] = partial(of_links, found, links)
    if solution.slides:
        drawn["slides"] = partial(of_slides, found, list(solution.slides))
    if found.cycle.profiles:
        drawn["cams"] = partial(of_cams, found)
    if found.cycle.forces is not None:
        drawn["forces"] = partial(of_forces, found, found.cycle.forces)
    return drawn


def of_points(found: Sampled, points: Sequence[str], quantity: str) -> Figure:
    """A panel for each point with its components and its magnitude."""
    letter, unit, factor = MOTION[quantity].letter, MOTION[quantity].unit, 1.0
    if quantity == "position":
        unit, factor = found.length_unit, found.per_length
    known = [n for n in points if getattr(found.solution.points[n], quantity) is not None]
    shown, more = some_of(known, MOST_PANELS, "points")
    panels = []
    for name in shown:
        value = np.asarray(getattr(found.solution.points[name], quantity)) * factor
        if quantity == "position":
            curves: list[Curve] = [
                (subscripted("x", name), value.real, COLOURS[0], DASHES[0]),
                (subscripted("y", name), value.imag, COLOURS[1], DASHES[1]),
            ]
        else:
            curves = [
                (subscripted(letter, name), np.abs(value), INK, DASHES[0]),
                (f"{subscripted(letter, name)} along x", value.real, COLOURS[0], DASHES[1]),
                (f"{subscripted(letter, name)} along y", value.imag, COLOURS[1], DASHES[2]),
            ]
        panels.append((f"Point {name.replace('@', ' of link ')}", unit, curves))
    return stacked(found, PLURALS[quantity].capitalize() + more, panels)


def of_links(found: Sampled, links: Sequence[str]) -> Figure:
    """Three panels: angles, angular velocities, angular accelerations of links."""
    panels = []
    links, more = some_of(links, MOST_CURVES, "links")
    angles = [
        (subscripted("\\theta", name), angle, colour(i), dash(i))
        for i, name in enumerate(links)
        if (angle := angle_of(found, name)) is not None
    ]
    if angles:
        lines = ", ".join(f"{n}: {'-'.join(line_of(found, n))}" for n in links if line_of(found, n))
        which = f" ({lines})" if len(lines) < LINE else ", from its first point to its second"
        panels.append((f"Angle of the line of each link{which}", "deg", angles))
    turning = "Angular velocity, counter-clockwise positive", "Angular acceleration"
    for rate, letter, words in zip(RATES, ("\\omega", "\\varepsilon"), turning, strict=True):
        curves: list[Curve] = []
        for i, name in enumerate(links):
            value = motion_value(found.solution.links[name], rate)
            if value is not None:
                whole = np.broadcast_to(np.asarray(value, float), found.at.shape)
                curves.append((subscripted(letter, name), whole, colour(i), dash(i)))
        if curves:
            panels.append((words, rate.unit, curves))
    return stacked(found, f"Turning of the links{more}", panels)


def line_of(found: Sampled, link: str) -> tuple[str, ...]:
    """The first two points of a link, a fixed pivot first."""
    points = [p for p in found.scene.links[link].points if p in found.solution.points]
    fixed = [p for p in points if p in found.scene.fixed_points]
    ordered = dict.fromkeys((*fixed, *points))
    return tuple(ordered)[:2] if len(ordered) > 1 else ()


def angle_of(found: Sampled, link: str) -> np.ndarray | None:
    """The angle of a link's line (degrees), continued past 180 where it turns."""
    line = line_of(found, link)
    if not line:
        return None
    start, end = (np.asarray(found.solution.points[p].position) for p in line)
    parts = np.split(np.angle(end - start), list(found.breaks))
    return np.asarray(np.degrees(np.concatenate([np.unwrap(part) for part in parts])))


def of_slides(found: Sampled, blocks: Sequence[str]) -> Figure:
    """Three panels: coordinate, speed, acceleration of every block along its guide."""
    unit = found.length_unit
    panels = []
    blocks, more = some_of(blocks, MOST_CURVES, "blocks")
    for quantity, letter, words, units, factor in (
        ("position", "s", "Coordinate along the guide", unit, found.per_length),
        ("speed", "\\dot{s}", "Speed along the guide", "m/s", 1.0),
        ("acceleration", "\\ddot{s}", "Acceleration along the guide", "m/s²", 1.0),
    ):
        curves: list[Curve] = []
        for i, name in enumerate(blocks):
            value = getattr(found.solution.slides[name], quantity)
            if value is not None:
                whole = np.broadcast_to(np.asarray(value, float), found.at.shape) * factor
                curves.append((subscripted(letter, name), whole, colour(i), dash(i)))
        if curves:
            panels.append((words, units, curves))
    return stacked(found, f"Blocks on their guides{more}", panels)


def of_cams(found: Sampled) -> Figure:
    """Two panels for each cam that the driver turns: displacement and pressure angle."""
    panels = []
    profiles, more = some_of(list(found.cycle.profiles), MOST_PANELS // 2, "cams")
    for name in profiles:
        profile = found.cycle.profiles[name]
        swings = profile.cam.lever is not None
        lift = np.degrees(profile.rise.at) if swings else profile.rise.at * found.per_length
        letter, unit = ("\\psi", "deg") if swings else ("s", found.length_unit)
        curve = subscripted(letter, name), lift, COLOURS[0], DASHES[0]
        panels.append((f"Displacement of link {name} by cam {profile.cam.on}", unit, [curve]))
        angle = subscripted("\\alpha", name), profile.pressure, COLOURS[1], DASHES[0]
        panels.append((f"Pressure angle of link {name}", "deg", [angle]))
    return stacked(found, f"Cams{more}", panels)


def of_forces(found: Sampled, forces: ForcesAlong) -> Figure:
    """The magnitudes of reactions, and a panel for each driver's moment or force."""
    every = forces.values.items()
    reactions = {name: value for (what, name), value in every if what == PAIR_REACTION.target}
    shown, more = some_of(list(reactions), MOST_CURVES, "reactions")
    curves = [
        (subscripted(*name.split("_", 1)), np.abs(reactions[name]), colour(i), dash(i))
        for i, name in enumerate(shown)
    ]
    panels = [("Reactions, their magnitudes", PAIR_REACTION.unit, curves)] if curves else []
    for (what, name), value in every:
        quantity, letters = BY_TARGET[what], name.split("_", 1)
        if quantity is BALANCING_MOMENT:
            curve = (subscripted(*letters), value, INK, DASHES[0])
            words = "Balancing moment, counter-clockwise positive"
            panels.append((words, quantity.unit, [curve]))
        elif quantity is BALANCING_FORCE:
            along = [
                (subscripted(*letters), np.abs(value), INK, DASHES[0]),
                (f"{subscripted(*letters)} along x", value.real, COLOURS[0], DASHES[1]),
                (f"{subscripted(*letters)} along y", value.imag, COLOURS[1], DASHES[2]),
            ]
            panels.append(("Balancing force", quantity.unit, along))
    return stacked(found, f"Forces{more}", panels)


def stacked(
    found: Sampled, title: str, panels: Sequence[tuple[str, str, Sequence[Curve]]]
) -> Figure:
    """Panels one below another over one axis of the driver."""
    figure = new_figure(WIDTH, PANEL * len(panels) + 0.9)
    figure_title(figure, f"{title}: {found.title}", x=0.01, ha="left", fontsize=11)
    axes = figure.subplots(len(panels), 1, sharex=True, squeeze=False)[:, 0]
    at = found.broken(found.at * axis_factor(found))
    for ax, (words, unit, curves) in zip(axes, panels, strict=True):
        for label, values, ink, stroke in curves:
            ax.plot(at, found.broken(values), color=ink, linestyle=stroke, label=label)
        bounds = span_of(found.at, [values for _, values, _, _ in curves])
        if bounds is not None:
            ax.set_ylim(*bounds)
        known = [sure for _, values, _, _ in curves if (sure := values[np.isfinite(values)]).size]
        if known and max(map(np.ptp, known)) < 1e-9 * max(abs(sure).max() for sure in known):
            ax.margins(y=0.5)
        ax.axhline(0, color=FAINT, linewidth=0.6, zorder=1)
        ax.set_ylabel(unit)
        panel_heading(ax, words, raised=len(words) + NAMED * len(curves) > LINE)
        legend(ax)
        singular_lines(found, ax)
    figure.align_ylabels(axes)
    tell_lines(found, axes[0], [values for _, values, _, _ in panels[0][2]])
    driver_axis(found, axes[-1])
    return figure


def axis_factor(found: Sampled) -> float:
    """The factor from u to the values on its axis."""
    return found.per_length if found.cycle.sweep.is_length else 1.0


def driver_axis(found: Sampled, ax: Axes) -> None:
    """Draw the axis of the driver, in whole parts of a turn where it turns."""
    sweep = found.cycle.sweep
    low, high = float(found.at.min()), float(found.at.max())
    if sweep.what == "turn":
        if sweep.whole and high - low > 0.9 * TURN:
            low, high = min(low, 0.0), max(high, low + TURN)
        step = next((s for s in TURNS if (high - low) / s < TICKS), None)
        if step is not None and high - low > LEAST_TICKS * step:
            ticks = np.arange(np.ceil(low / step - 1e-9), np.floor(high / step + 1e-9) + 1)
            ax.set_xticks(ticks * step)
        name = found.scene.drivers[(sweep.number or 1) - 1].link
        words = f"driver's angle φ of link {name}, deg"
    elif sweep.what == "time":
        words = "time t, s"
    else:
        words = f"driver's coordinate s, {found.length_unit}"
    ax.set_xlabel(words + (": time runs from right to left" if sweep.runs_backwards else ""))
    factor = axis_factor(found)
    room = 0.0 if found.cycle.path.whole else 0.02 * (high - low)
    ax.set_xlim((low - room) * factor, (high + room) * factor)


def marked(found: Sampled) -> list[tuple[float, str, str]]:
    """Positions to mark with their colour: dead points, change points and the scene's position."""
    lines = [
        (each.at, "dead point" if each.kind == "dead" else "change point", WARNING)
        for each in found.cycle.singulars
    ]
    sweep = found.cycle.sweep
    if sweep.what != "time":
        low, high = found.at.min(), found.at.max()
        at = found.cycle.path.found_at(sweep.start, low, high)
        lines += [(at, "scene's position", FAINT)] if low <= at <= high else []
    return lines


def singular_lines(found: Sampled, ax: Axes) -> None:
    """Draw thin lines at dead and change points, and at the scene's position."""
    for at, _, ink in marked(found):
        stroke = (0, (4, 3)) if ink == WARNING else ":"
        ax.axvline(at * axis_factor(found), color=ink, linewidth=0.8, linestyle=stroke, zorder=1)


def tell_lines(found: Sampled, ax: Axes, curves: Sequence[np.ndarray]) -> None:
    """Label these lines in small letters along them in the first panel, away from its curves."""
    low, high = found.at.min(), found.at.max()
    bottom, top = ax.get_ylim()
    for at, words, ink in marked(found):
        late = at > low + 0.97 * (high - low)
        beside = (at - found.at if late else found.at - at) / (high - low)
        near = (beside > -NARROW) & (beside < WORDS_WIDE)
        heights = np.concatenate([(curve[near] - bottom) / (top - bottom) for curve in curves])
        tall = LETTER_TALL * len(words)
        starts = sorted(np.arange(0.02, 1 - tall, 0.04), key=lambda y: abs(y + tall / 2 - 0.5))
        clear = {y: np.abs(heights - y - tall / 2).min(initial=1) - tall / 2 for y in starts}
        free = [y for y in starts if clear[y] > NARROW]
        ax.annotate(
            words,
            (at * axis_factor(found), free[-1] if free else max(starts, key=clear.__getitem__)),
            xycoords=("data", "axes fraction"),
            xytext=(-2 if late else 2, 0),
            textcoords="offset points",
            rotation=90,
            ha="right" if late else "left",
            va="bottom",
            fontsize=6.5,
            color=ink,
        )
