"""Figures in the plane: paths of points, and centrodes that roll on one another."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from functools import partial
from itertools import pairwise

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.solution import UNPROVED
from graphkin.construction.links.mechanism_symbols import draw_ground, draw_links
from graphkin.drawing.field import Field
from graphkin.drawing.labels import FieldContent, free_ones
from graphkin.drawing.marks import CircleMark, Mark, Page, Text, moved
from graphkin.drawing.scale import Scales
from graphkin.drawing.style import HUES
from graphkin.drawing.symbol_markup import escape, symbol
from graphkin.mechanism import Mechanism
from graphkin.motion.centrodes import centrodes, links_with_centrodes
from graphkin.motion.curves.charts import (
    INK,
    Box,
    ChartCurve,
    PlaneChart,
    area_in,
    noted,
    plane_page,
)
from graphkin.motion.curves.over_driver import (
    Sampled,
    indexed,
    moving_points,
    pictures,
    sampled,
    some_of,
    titled,
)
from graphkin.motion.cycle import Cycle
from graphkin.motion.single_loop import Band, Loop, Ring, class_of, loop_of
from graphkin.scene.link_points import is_under
from graphkin.text import words
from graphkin.text.errors import ClosureError

MOST_POINTS = 60
"""Points of a mechanism above which a figure shows only the links that it concerns."""


class Outline(Struct, frozen=True):
    """The mechanism in the scene's position; ``factor`` converts metres to the figure's unit.

    ``drawn`` means that the scene itself can be drawn; otherwise the first row of the cycle
    replaces it. ``left_out`` are the numbers of links drawn and of all, if some are not drawn.
    """

    drawing: Drawing
    factor: float
    drawn: bool
    left_out: tuple[int, int] | None = None

    @property
    def places(self) -> Mapping[str, complex]:
        """Positions of all points, in the figure's unit."""
        return {name: place * self.factor for name, place in self.drawing.positions.items()}

    @property
    def corners(self) -> np.ndarray:
        """Two corners of the box around all that is drawn, cams and wheels too."""
        box = self.drawing.bare_extent()
        return np.array([complex(box.left, box.bottom), complex(box.right, box.top)]) * self.factor

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
        left_out=(len(links), len(every)),
    )


def outline(stand: Outline, plane: PlaneChart) -> list[Mark]:
    """The mechanism in a figure, with the letters that fit."""
    (x0, x1, y0, y1), per_metre = plane.shown, stand.factor
    middle = complex(x0 + x1, y0 + y1) / (2 * per_metre)
    wide, high = (x1 - x0) * plane.mm, (y1 - y0) * plane.mm
    rect = (0.0, 0.0, wide, high)
    field = Field(rect, per_metre * plane.mm, middle, (wide / 2, high / 2))
    board = FieldContent(rect)
    draw_ground(board, stand.drawing, field)
    draw_links(board, stand.drawing, field)
    left, top, _, _ = plane.rect
    marks = [*board.marks, *free_ones(board, board.spots([]))]
    return [moved(mark, left, top) for mark in marks]


# --- paths of points, and centrodes that roll on one another --------------------------------------


ROOM = 0.09
"""Margin around a drawing, as a share of its longer side."""
MOST_PATHS = 16
"""Most paths in one figure: each colour twice."""
FAR = 1.6
"""Distance from the mechanism's box, in its breadths, at which centrodes are cut off."""
DOT = 0.55
"""Radius of a dot on a path, in mm."""


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


def paths(found: Sampled) -> Page:
    """The path of every point of interest, with the mechanism in the scene's position."""
    said = found.words
    names, title = some_of(found, "paths", path_points(found), MOST_PATHS)
    stand = stand_about(found.cycle, found.per_length, names)
    curves = {
        name: np.asarray(found.solution.points[name].position) * found.per_length for name in names
    }
    box = box_of([stand.corners, *curves.values()])
    lines = [
        ChartCurve(said("curves.path", p=symbol(name)), found.broken(curve), i)
        for i, (name, curve) in enumerate(curves.items())
    ]
    dots = [
        ChartCurve("", dotted(found, curve), i, dot=DOT) for i, curve in enumerate(curves.values())
    ]
    plane = plane_of(found, title, box, [*lines, *dots])
    notes = ["curves.as_given"] if stand.drawn else []
    notes += ["curves.dots"] if found.cycle.sweep.what == "turn" else []
    return plane_page(plane, outline(stand, plane), note=noting(found, stand, *map(said, notes)))


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


def both_centrodes(found: Sampled, link: str) -> Page:
    """The fixed centrode of a link, and the moving one that touches it in the scene's position."""
    stand = stand_about(found.cycle, found.per_length, found.scene.links[link].points)
    both = centrodes(found.cycle, link)
    assert both is not None
    here = at_scene(found, link)
    fixed = both.fixed * found.per_length
    moving = both.placed(*here[:2]) * found.per_length
    places = stand.corners
    touch = here[2] * found.per_length
    window = near_box(places, [fixed, moving], stand.breadth(), touch)
    curves = [
        ChartCurve(found.words("curves.fixed"), unbroken(found, fixed, window), 0),
        ChartCurve(
            found.words("curves.moving", k=escape(link)), unbroken(found, moving, window), 1
        ),
    ]
    plane = plane_of(found, found.words("curves.centrodes", k=link), window, curves)
    above: list[Mark] = []
    if inside(touch, window):
        x, y = plane(touch)
        above.append(CircleMark(x, y, 2 * DOT, f"dot {HUES[INK]}", "centre"))
        name = indexed("I", link) if link.isalnum() else "*I*"
        above.append(Text(x + 2, y - 2, name, "caption", 2.5, name="centre"))
    note = noting(found, stand, found.words("curves.rolls"))
    return plane_page(plane, outline(stand, plane), above, note)


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


def plane_of(found: Sampled, title: str, box: Box, curves: Sequence[ChartCurve]) -> PlaneChart:
    """A figure with equal scales over a box."""
    unit, mark = found.in_lengths[0], found.words("decimal_mark")
    return PlaneChart(titled(found, title), unit, box, curves, mark)


def noting(found: Sampled, stand: Outline, *notes: str) -> str:
    """The notes below a figure, with what is left out."""
    if stand.left_out is None:
        return found.words.clauses(notes)
    some, every = stand.left_out
    return found.words.clauses([*notes, found.words("curves.links_drawn", some=some, all=every)])


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


BLUE, RED, GREEN, GREY = 0, 1, 2, 6
"""The hues of what is within reach, of what is not, of limits, and of middle lines."""
TURNED = np.exp(1j * np.linspace(0, 2 * np.pi, 1441))
"""Unit vectors in all directions."""


def reach(found: Sampled, loop: Loop) -> Page:
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
    box = box_of([stand.corners, *parts])
    curves = [*limits(found, loop, box), *pin_path(found, loop)]
    plane = plane_of(found, found.words("curves.reach"), box, curves)
    below = [*area_in(plane, rim_of(loop, factor, box), "shade"), *outline(stand, plane)]
    above = dead_marks(plane, found, loop)
    return plane_page(plane, below, [*above], noting(found, stand, *reach_notes(found, loop)))


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


def rims(loop: Loop, factor: float, box: Box) -> tuple[np.ndarray, np.ndarray]:
    """The two edges of the ring or band, which run against one another."""
    if isinstance(loop.reach, Ring):
        outer = (loop.reach.centre + loop.reach.outer * TURNED) * factor
        return outer, (loop.reach.centre + loop.reach.inner * TURNED[::-1]) * factor
    line, half = loop.reach.line, loop.reach.half
    long = 2 * max(abs(bound) for bound in box) + abs(line.point) * factor
    ends = np.array([-1, 1]) * line.along * long
    one, other = ((line.point + side * 1j * line.along * half) * factor + ends for side in (1, -1))
    return one, other[::-1]


def rim_of(loop: Loop, factor: float, box: Box) -> np.ndarray:
    """The corners of the ring or band."""
    return np.concatenate(rims(loop, factor, box))


def limits(found: Sampled, loop: Loop, box: Box) -> list[ChartCurve]:
    """The edges of the ring or band, and the middle line of a band."""
    factor = found.per_length
    edges = [
        ChartCurve(label, edge, GREEN)
        for label, edge in zip((within(found, loop), ""), rims(loop, factor, box), strict=True)
    ]
    if isinstance(loop.reach, Ring):
        return edges
    line = loop.reach.line
    long = 2 * max(abs(bound) for bound in box) + abs(line.point) * factor
    middle = line.point * factor + np.array([-1, 1]) * line.along * long
    return [*edges, ChartCurve("", middle, GREY, 3)]


def within(found: Sampled, loop: Loop) -> str:
    """The legend of the filled area, as markup."""
    pin, about = symbol(loop.pins[2]), symbol(loop.pins[3])
    key = "curves.ring" if isinstance(loop.reach, Ring) else "curves.band"
    return found.words(key, p=pin, o=about)


def pin_path(found: Sampled, loop: Loop) -> Iterator[ChartCurve]:
    """The driven pin's path, solid where it is within reach, dashed and red elsewhere."""
    places, factor = path_places(loop), found.per_length
    good = reached(loop, places)
    what = "circle" if isinstance(loop.path, Ring) else "line"
    for flags, hue, stroke, name in (
        (good, BLUE, 0, "within"),
        (~good, RED, 1, "beyond"),
    ):
        if flags.any():
            line = np.where(flags, places, complex(np.nan, np.nan)) * factor
            label = found.words(f"curves.{what}_{name}", p=symbol(loop.pins[1]))
            yield ChartCurve(label, line, hue, stroke)


def dead_marks(plane: PlaneChart, found: Sampled, loop: Loop) -> Iterator[Mark]:
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
            sign = "φ" if cycle.sweep.what == "turn" else "s"
            value = end.at if cycle.sweep.what == "turn" else end.at * found.per_length
            unit = "°" if cycle.sweep.what == "turn" else f" {found.in_lengths[0]}"
            label = f"*{sign}* = {found.words.decimal(f'{value:.2f}')}{unit}"
            yield from noted(plane, place * found.per_length, label, RED)


def reach_notes(found: Sampled, loop: Loop) -> Iterator[str]:
    """The verdict below the figure."""
    said = found.words
    if loop.kind == "four-bar":
        name, verdict = class_of(loop).replace(" ", "-"), "turns" if loop.turns else "rocks"
    else:
        name, verdict = "slider-crank", "turns" if loop.turns else "between_dead"
    yield said(f"curves.{verdict}", loop=said(f"curves.loop.{name}"))
    if loop.more:
        yield said("curves.reach_more")


# --- the figure files of a cycle ------------------------------------------------------------------


def picture_files(
    cycle: Cycle, stem: str, formats: Sequence[str], language: str | None = None
) -> dict[str, bytes]:
    """Every figure of a cycle by its file name, in each of the formats svg and png.

    Their words are in a language, None for the scene's own.
    """
    from graphkin.writers.svg import write_svg

    files: dict[str, bytes] = {}
    for name, drawn in figures(sampled(cycle, language=language or "")):
        page = drawn()
        if "svg" in formats:
            files[f"{stem}-{name}.svg"] = write_svg(page).encode("utf-8")
        if "png" in formats:
            from graphkin.writers.axes import write_png

            files[f"{stem}-{name}.png"] = write_png(page)
    return files


def figures(found: Sampled) -> Iterator[tuple[str, Callable[[], Page]]]:
    """Every figure with its name, drawn when called."""
    yield from pictures(found).items()
    if path_points(found):
        yield "paths", partial(paths, found)
    for link in centrode_links(found):
        yield f"centrodes-{link}", partial(both_centrodes, found, link)
    loop = loop_of(found.cycle)
    if loop is not None:
        yield "reach", partial(reach, found, loop)
