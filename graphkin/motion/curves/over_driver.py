"""Curves over the driver: positions, velocities, accelerations, rotation, slides."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

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
from graphkin.drawing.marks import Page
from graphkin.drawing.style import HUES
from graphkin.drawing.symbol_markup import escape
from graphkin.motion.curves.charts import INK, AcrossAxis, ChartCurve, ChartPanel, Upright, stacked
from graphkin.motion.cycle import Cycle
from graphkin.motion.driving import TURN
from graphkin.scene.link_points import lettered
from graphkin.scene.model import Scene
from graphkin.scene.quantity import SI, size_in_si
from graphkin.text import ENGLISH, Words, words

if TYPE_CHECKING:
    from graphkin.motion.cycle import ForcesAlong

Reals = np.ndarray[tuple[int], np.dtype[np.float64]]

FINE = 720
"""Positions in a piece or a full turn."""
END = 3e-4
"""Share of a piece left out at an end where rates grow without bound."""


class Sampled(Struct, frozen=True, eq=False):
    """The motion at closely spaced u, rising within each range.

    ``breaks`` are the row numbers at which a new range begins. ``language`` is that of all words,
    empty for the scene's own.
    """

    cycle: Cycle
    breaks: tuple[int, ...]
    language: str = ""

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
        return ", ".join([self.scene.title_in(self.words.language), *settings])

    @property
    def words(self) -> Words:
        """The words of the pictures, with the scene's signs and its unit of results."""
        sheet = self.scene.sheet
        language = self.language or sheet.language
        return words(language, sheet.signs, self.scene.unit_of_results)

    def in_results(self, unit: str) -> tuple[str, float]:
        """The unit in which results are shown, for a unit of SI, and the factor to it."""
        own = words(ENGLISH, length=self.scene.unit_of_results).unit(unit)
        return self.words.unit(unit), 1.0 if own == unit else 1 / float(size_in_si(own)[0])

    @property
    def in_lengths(self) -> tuple[str, float]:
        """The scene's unit of length as written, and the factor to it from metres."""
        return self.words.spelled(self.length_unit), self.per_length

    @property
    def length_unit(self) -> str:
        """The scene's unit of length."""
        return self.scene.units["length"]

    @property
    def per_length(self) -> float:
        """The factor from metres to the scene's unit of length."""
        return 1 / float(SI[self.length_unit][0])


def sampled(cycle: Cycle, fine: int = FINE, language: str = "") -> Sampled:
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
    return Sampled(fine_cycle, tuple(breaks), language)


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


MOST_PANELS = 6
MOST_CURVES = len(HUES)
"""The most curves in one panel: the number of hues."""
LINE = 84
"""The most letters of a heading that names the lines of links."""
TURNS = (15, 30, 45, 60, 90, 180, 360)
"""Steps of an axis of angles in degrees."""
TICKS = 13
LEAST_TICKS = 2
"""The fewest steps for ticks at whole parts of a turn on an axis of angles."""


def indexed(letter: str, name: str) -> str:
    """A letter with a name as its index, as markup."""
    return f"*{letter}*_{{{escape(lettered(name))}}}"


def some_of(found: Sampled, title: str, names: Sequence[str], most: int) -> tuple[list[str], str]:
    """The first names that fit into a figure, and its title, which says how many there are."""
    said = found.words(f"curves.{title}")
    if len(names) <= most:
        return list(names), said
    return list(names[:most]), found.words("curves.some", title=said, most=most, all=len(names))


def components(found: Sampled, sign: str, value: np.ndarray, first: int) -> list[ChartCurve]:
    """The components of a vector along both axes, the first in a hue."""
    return [
        ChartCurve(found.words("curves.along", sign=sign, axis=axis), part, hue, hue + 1)
        for hue, (axis, part) in enumerate(zip("xy", (value.real, value.imag), strict=True), first)
    ]


def pictures(found: Sampled) -> dict[str, Callable[[], Page]]:
    """The figures of a cycle by name, each drawn when called."""
    scene, solution = found.scene, found.solution
    points = moving_points(scene, solution)
    drawn: dict[str, Callable[[], Page]] = {}
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


def of_points(found: Sampled, points: Sequence[str], quantity: str) -> Page:
    """A panel for each point with its components and its magnitude."""
    letter = MOTION[quantity].letter
    place = quantity == "position"
    unit, factor = found.in_lengths if place else found.in_results(MOTION[quantity].unit)
    known = [n for n in points if getattr(found.solution.points[n], quantity) is not None]
    shown, title = some_of(found, PLURALS[quantity], known, MOST_PANELS)
    panels = []
    for name in shown:
        value = np.asarray(getattr(found.solution.points[name], quantity)) * factor
        if place:
            curves = [
                ChartCurve(indexed(axis, name), part, hue)
                for hue, (axis, part) in enumerate(zip("xy", (value.real, value.imag), strict=True))
            ]
        else:
            sign = indexed(letter, name)
            curves = [ChartCurve(sign, np.abs(value), INK), *components(found, sign, value, 0)]
        point, _, link = name.partition("@")
        key = "curves.point_of_link" if link else "curves.point"
        panels.append(ChartPanel(found.words(key, p=point, k=link), unit, curves))
    return figure(found, title, panels)


def of_links(found: Sampled, links: Sequence[str]) -> Page:
    """Three panels: angles, angular velocities, angular accelerations of links."""
    panels = []
    said, signs = found.words, found.words.signs
    links, title = some_of(found, "turning", links, MOST_CURVES)
    angles = [
        ChartCurve(indexed("θ", name), angle, i)
        for i, name in enumerate(links)
        if (angle := angle_of(found, name)) is not None
    ]
    if angles:
        lines = ", ".join(f"{n}: {'-'.join(line_of(found, n))}" for n in links if line_of(found, n))
        heading = "curves.angle_of_lines" if len(lines) < LINE else "curves.angle"
        panels.append(ChartPanel(said(heading, list=lines), said("unit.deg"), angles))
    letters = ("omega", "ω"), ("epsilon", signs.angular_acceleration)
    for rate, (heading, letter) in zip(RATES, letters, strict=True):
        curves: list[ChartCurve] = []
        for i, name in enumerate(links):
            value = motion_value(found.solution.links[name], rate)
            if value is not None:
                whole = np.broadcast_to(np.asarray(value, float), found.at.shape)
                curves.append(ChartCurve(indexed(letter, name), whole, i))
        if curves:
            panels.append(ChartPanel(said(f"curves.{heading}"), said.unit(rate.unit), curves))
    return figure(found, title, panels)


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


def of_slides(found: Sampled, blocks: Sequence[str]) -> Page:
    """Three panels: coordinate, speed, acceleration of every block along its guide."""
    panels = []
    blocks, title = some_of(found, "slides", blocks, MOST_CURVES)
    for quantity, letter, (unit, factor) in (
        ("position", "s", found.in_lengths),
        ("speed", "v", found.in_results("m/s")),
        ("acceleration", "a", found.in_results("m/s²")),
    ):
        curves: list[ChartCurve] = []
        for i, name in enumerate(blocks):
            value = getattr(found.solution.slides[name], quantity)
            if value is not None:
                whole = np.broadcast_to(np.asarray(value, float), found.at.shape) * factor
                curves.append(ChartCurve(indexed(letter, name), whole, i))
        if curves:
            panels.append(ChartPanel(found.words(f"curves.slide_{quantity}"), unit, curves))
    return figure(found, title, panels)


def of_cams(found: Sampled) -> Page:
    """Two panels for each cam that the driver turns: displacement and pressure angle."""
    panels = []
    said, degrees = found.words, found.words("unit.deg")
    profiles, title = some_of(found, "cams", list(found.cycle.profiles), MOST_PANELS // 2)
    for name in profiles:
        profile = found.cycle.profiles[name]
        swings = profile.cam.lever is not None
        unit, factor = (degrees, np.degrees(1.0)) if swings else found.in_lengths
        rise = ChartCurve(indexed("ψ" if swings else "s", name), profile.rise.at * factor)
        heading = said("curves.cam_rise", k=name, g=profile.cam.on)
        panels.append(ChartPanel(heading, unit, [rise]))
        angle = ChartCurve(indexed("α", name), profile.pressure, 1)
        panels.append(ChartPanel(said("curves.cam_pressure", k=name), degrees, [angle]))
    return figure(found, title, panels)


def of_forces(found: Sampled, forces: ForcesAlong) -> Page:
    """The magnitudes of reactions, and a panel for each driver's moment or force."""
    every = forces.values.items()
    reactions = {name: value for (what, name), value in every if what == PAIR_REACTION.target}
    said = found.words
    shown, title = some_of(found, "forces", list(reactions), MOST_CURVES)
    unit, factor = found.in_results(PAIR_REACTION.unit)
    curves = [
        ChartCurve(indexed(*name.split("_", 1)), np.abs(reactions[name]) * factor, i)
        for i, name in enumerate(shown)
    ]
    panels = [ChartPanel(said("curves.reactions"), unit, curves)] if curves else []
    for (what, name), value in every:
        quantity, sign = BY_TARGET[what], indexed(*name.split("_", 1))
        if quantity not in (BALANCING_MOMENT, BALANCING_FORCE):
            continue
        unit, factor = found.in_results(quantity.unit)
        size = value * factor
        if quantity is BALANCING_MOMENT:
            heading, along = "curves.balancing_moment", [ChartCurve(sign, size, INK)]
        else:
            heading = "curves.balancing_force"
            along = [ChartCurve(sign, np.abs(size), INK), *components(found, sign, size, 0)]
        panels.append(ChartPanel(said(heading), unit, along))
    return figure(found, title, panels)


def figure(found: Sampled, title: str, panels: Sequence[ChartPanel]) -> Page:
    """Panels one below another over one axis of the driver, interrupted between ranges."""
    whole = [
        replace(
            panel,
            curves=[replace(each, values=found.broken(each.values)) for each in panel.curves],
            bounds=span_of(found.at, [each.values for each in panel.curves]),
        )
        for panel in panels
    ]
    return stacked(titled(found, title), whole, driver_axis(found))


def titled(found: Sampled, title: str) -> str:
    """The title of a figure, with that of the scene."""
    return found.words("curves.figure", title=title, scene=found.title)


def axis_factor(found: Sampled) -> float:
    """The factor from u to the values on its axis."""
    return found.per_length if found.cycle.sweep.is_length else 1.0


def driver_axis(found: Sampled) -> AcrossAxis:
    """The axis of the driver, with numbers at whole parts of a turn where it turns."""
    sweep, said = found.cycle.sweep, found.words
    low, high = float(found.at.min()), float(found.at.max())
    ticks: list[float] = []
    if sweep.what == "turn":
        if sweep.whole and high - low > 0.9 * TURN:
            low, high = min(low, 0.0), max(high, low + TURN)
        step = next((s for s in TURNS if (high - low) / s < TICKS), None)
        if step is not None and high - low > LEAST_TICKS * step:
            first, last = np.ceil(low / step - 1e-9), np.floor(high / step + 1e-9)
            ticks = (np.arange(first, last + 1) * step).tolist()
        name = found.scene.drivers[(sweep.number or 1) - 1].link
        axis = f"{said('curves.axis_turn', k=name)}, {said('unit.deg')}"
    elif sweep.what == "time":
        axis = f"{said('curves.axis_time')}, {said.unit('s')}"
    else:
        axis = f"{said('curves.axis_slide')}, {found.in_lengths[0]}"
    axis = said("curves.backwards", axis=axis) if sweep.runs_backwards else axis
    factor = axis_factor(found)
    room = 0.0 if found.cycle.path.whole else 0.02 * (high - low)
    low, high = (low - room) * factor, (high + room) * factor
    at = found.broken(found.at * factor)
    return AcrossAxis(at, low, high, axis, ticks, uprights(found), said("decimal_mark"))


def uprights(found: Sampled) -> list[Upright]:
    """The lines at dead points, change points and the scene's position, with their words."""
    factor = axis_factor(found)
    lines = [
        Upright(each.at * factor, "limit", found.words(f"curves.{each.kind}"))
        for each in found.cycle.singulars
    ]
    sweep = found.cycle.sweep
    if sweep.what != "time":
        low, high = found.at.min(), found.at.max()
        at = found.cycle.path.found_at(sweep.start, low, high)
        if low <= at <= high:
            lines.append(Upright(at * factor, "here", found.words("curves.here")))
    return lines


# --- limits of curves that run to infinity --------------------------------------------------------


def span_of(at: Reals, values: Sequence[np.ndarray]) -> tuple[float, float] | None:
    """Axis limits that cut off curves running to infinity, wide enough for the rest.

    None where no curve runs to infinity, so that everything may be shown.
    """
    even = np.linspace(at.min(), at.max(), 1001)
    order = np.argsort(at)
    after = np.clip(np.searchsorted(at[order], even), 1, len(at) - 1)
    gap = at[order][after] - at[order][after - 1]
    even = even[gap < GAP * np.ptp(at)]  # not between two ranges
    known = np.concatenate([np.interp(even, at[order], v[order]) for v in values])
    known = known[np.isfinite(known)]
    if not known.size:
        return None
    most = max(float(np.nanmax(np.abs(v[np.isfinite(v)]), initial=0.0)) for v in values)
    usual = float(np.quantile(np.abs(known), 0.85))
    if most <= RUNS_AWAY * usual or usual == 0:
        return None
    inside = known[np.abs(known) <= KEPT * usual]
    low, high = min(float(inside.min()), 0.0), max(float(inside.max()), 0.0)
    room = 0.08 * (high - low)
    return low - room, high + room


GAP = 0.02
"""Distance of two places, as a share of the whole, across which nothing is drawn."""
RUNS_AWAY = 5.0
"""Ratio of the largest to the usual value beyond which a curve runs to infinity."""
KEPT = 2.0
"""Multiple of the usual value up to which values stay visible."""
