"""The law of a cam as diagrams: lift, its three derivatives and the pressure angle over the cam.

The steepest places of rise and return are marked, and the customary limit of the pressure angle.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import cached_property, partial
from itertools import pairwise
from typing import Any

import numpy as np
from msgspec import Struct

from graphkin.construction.core.cam_profiles import CamProfile
from graphkin.documents.diagrams_sheet import (
    ARROW,
    FILLED,
    GAP,
    LETTERS,
    OVER,
    POINT,
    Axes,
    axis_lines,
    cleared,
    curve,
    numbers_along,
    sentence_lines,
)
from graphkin.documents.positions import PositionSet
from graphkin.documents.positions_sheet import field_on, foot_line, framed, heading, headline, proof
from graphkin.documents.sheet import title_of
from graphkin.drawing.field import XY
from graphkin.drawing.marks import CircleMark, LineMark, Mark, Page, Text
from graphkin.drawing.scale import preferred
from graphkin.drawing.symbol_markup import escape
from graphkin.motion.course import Reals
from graphkin.motion.driving import stated_motion
from graphkin.motion.extremes import MOST_PRESSURE

IN_PIECE = 240
"""Samples of a piece of the law."""
BESIDE = 1e-6
"""Distance of the first and the last sample from the borders of a piece, as a share of it."""
BEFORE, AFTER = 20.0, 14.0
"""The room in the field before and after the diagrams, in mm."""
SLOPE = 22.0
"""Half the length of the line along the steepest place of the lift, in mm."""
JUMP = 1e-3
"""A jump of a derivative between two pieces, as a share of its largest size, that is reported."""
LEVEL = 1e-12
"""Share of the largest value within which a value stays the same."""
PARTS, ROUNDS = 16, 9
"""Parts into which the samples beside a largest value are cut at once, and how often."""
PRESSED = 1e-6
"""Pressure angle in degrees above which it is no rounding."""
ANGLE = "*α*"
"""The symbol of the pressure angle."""
TICKS = 12
"""The most numbers along the axis of the cam."""


class CamLaw(Struct, frozen=True, dict=True):
    """The law of the cam of a ``follower`` over its angle or way θ, from the start of the law.

    Arrays have the shape (pieces, N). Between two pieces, derivatives may jump.
    """

    found: PositionSet
    follower: str

    @property
    def cam(self) -> Any:
        """The cam with its law."""
        return self.found.cycle.scene.cams[self.follower]

    @cached_property
    def borders(self) -> Reals:
        """The ends of the pieces, with the start: radians, or metres of a plate."""
        values = self.found.cycle.scene.values
        return np.array([0.0, *(float(piece.to.si(values)) for piece in self.cam.law)])

    @cached_property
    def at(self) -> Reals:
        """The samples θ of every piece."""
        shares = np.linspace(BESIDE, 1 - BESIDE, IN_PIECE + 1)
        return self.borders[:-1, None] + np.diff(self.borders)[:, None] * shares

    def profile(self, at: Reals) -> CamProfile:
        """The cam at some θ."""
        scene = self.found.cycle.scene
        start = float(self.cam.start.si(scene.values))
        return CamProfile(scene, self.follower, given=(start + self.cam.sense * at).ravel())

    def orders_at(self, at: Reals) -> list[Reals]:
        """The lift and its three derivatives by θ at some θ, in SI."""
        profile, sense = self.profile(at), self.cam.sense
        rise = profile.rise
        every = rise.at, sense * rise.rate, rise.bend, sense * profile.third
        return [np.broadcast_to(each, at.size).reshape(at.shape) for each in every]

    def pressure_at(self, at: Reals) -> Reals:
        """The pressure angle in degrees at some θ."""
        return np.asarray(self.profile(at).pressure).reshape(at.shape)

    @cached_property
    def orders(self) -> list[Reals]:
        """The lift and its three derivatives at the samples."""
        return self.orders_at(self.at)

    @cached_property
    def pressure(self) -> Reals:
        """The pressure angle in degrees at the samples."""
        return self.pressure_at(self.at)

    @property
    def is_pressed(self) -> bool:
        """Whether there is a pressure angle; under a flat face that slides there is none."""
        return bool(self.pressure.max() > PRESSED)

    def largest(self, value: Callable[[Reals], Reals]) -> tuple[float, float]:
        """Where a function of θ is largest, and its value; the middle of a level one.

        The best sample is refined between its neighbours in its piece, to the rounding of doubles.
        """
        rows = value(self.at)
        best = float(rows.max())
        level = np.flatnonzero(rows.ravel() >= best - LEVEL * abs(best))
        if len(level) > 2:
            return float(self.at.ravel()[level[len(level) // 2]]), best
        piece, k = np.unravel_index(int(rows.argmax()), rows.shape)
        own = self.at[piece]
        low, high, at = own[max(k - 1, 0)], own[min(k + 1, len(own) - 1)], own[k]
        for _ in range(ROUNDS):
            places = np.linspace(low, high, PARTS + 1)
            found = value(places)
            i = int(found.argmax())
            if found[i] > best:
                at, best = places[i], float(found[i])
            low, high = places[max(i - 1, 0)], places[min(i + 1, PARTS)]
        return float(at), best

    def steepest(self, sign: int) -> tuple[float, float] | None:
        """Where the lift grows (1) or falls (-1) fastest, and its slope; None where it does not."""
        at, found = self.largest(lambda u: self.orders_at(u)[1] * sign)
        size = float(np.abs(self.orders[1]).max())
        return (at, sign * found) if found > JUMP * size else None

    def jumps(self, order: int) -> list[float]:
        """The borders at which a derivative jumps; a turn ends where it begins."""
        values = self.orders[order]
        size = float(np.abs(values).max())
        pairs = [*pairwise(range(len(values)))]
        places = [float(self.borders[i + 1]) for i in range(len(pairs))]
        if not self.cam.slides:
            pairs, places = [(len(values) - 1, 0), *pairs], [0.0, *places]
        ends = zip(pairs, places, strict=True)
        return [u for (i, k), u in ends if abs(values[k][0] - values[i][-1]) > JUMP * size]


def cam_law_pages(found: PositionSet) -> list[Callable[[str], Page]]:
    """The sheets of the cams' laws, each waiting for its number."""
    return [partial(cam_law_page, CamLaw(found, name)) for name in found.cycle.scene.cams]


class Strip(Struct, frozen=True):
    """One diagram: its symbol and unit, its values, the printed number of one unit, its look."""

    symbol: str
    unit: str
    values: Reals
    factor: float
    look: str


def strips(law: CamLaw) -> list[Strip]:
    """The diagrams of a sheet, from the lift to the pressure angle."""
    drawing = law.found.shown.alone
    lever, unit = law.cam.lever is not None, drawing.scene.units["length"]
    own = 1.0 if lever else drawing.length(1.0)
    letter = "*ψ*" if lever else "*s*"
    made = []
    for order, (values, mark) in enumerate(zip(law.orders, ("", "′", "″", "‴"), strict=True)):
        look = ("profile", "velocity", "acceleration", "acceleration")[order]
        made.append(Strip(f"{letter}{mark}", unit_of(law, order, unit), values, own, look))
    if lever:
        made[0] = Strip(letter, "°", law.orders[0], float(np.degrees(1.0)), "profile")
    if law.cam.slides:
        made = [scaled(each, drawing.length(1.0), order) for order, each in enumerate(made)]
    return [*made, Strip(ANGLE, "°", law.pressure, 1.0, "profile")] if law.is_pressed else made


def scaled(strip: Strip, per_metre: float, order: int) -> Strip:
    """A diagram over a way that is printed in the unit of the scene."""
    return Strip(
        strip.symbol, strip.unit, strip.values, strip.factor / per_metre**order, strip.look
    )


def unit_of(law: CamLaw, order: int, unit: str) -> str:
    """The unit of a derivative of the lift by the cam's angle or way."""
    power = "" if order < 2 else f"^{order}"
    if law.cam.slides:
        top = order if law.cam.lever is not None else order - 1
        if top < 0:
            return unit
        return "1" if top == 0 else f"1/{unit}{'' if top == 1 else f'^{top}'}"
    if law.cam.lever is not None:
        return "1"
    return unit if not order else f"{unit}/rad{power}"


def cam_law_page(law: CamLaw, number: str) -> Page:
    """The sheet of one cam's law."""
    drawing, words = law.found.shown.alone, law.found.shown.alone.words
    every = strips(law)
    _, over, _, foot = field_on(law.found)
    over += OVER
    height = (foot - over - 5 - (len(every) - 1) * GAP) / len(every)
    marks: list[Mark] = []
    frames: list[Axes] = []
    for index, each in enumerate(every):
        top = over + index * (height + GAP)
        axes = axes_of(law, each, top, top + height)
        frames.append(axes)
        marks += diagram(law, axes, each, last=index == len(every) - 1)
    marks += steepest_marks(law, frames, every)
    marks += limit_marks(law, frames[-1]) if law.is_pressed else ()
    name = words("sheet.cam_law", g=escape(law.cam.on))
    said = words("diagrams.cam_caption", g=escape(law.cam.on), k=escape(law.follower))
    whole: list[Mark] = [
        *heading(law.found, drawing, name),
        *headline(law.found, said),
        *marks,
        *foot_line(law.found),
        *sentence_lines(law.found, sentences_of(law, every)),
        *proof(law.found),
    ]
    title = f"{name} – {title_of(drawing)}"
    return framed(drawing, number, words("sheet.document_diagrams"), "–", whole, title)


def axes_of(law: CamLaw, strip: Strip, top: float, low: float) -> Axes:
    """The frame of one diagram, which its values fill."""
    least, largest = min(float(strip.values.min()), 0.0), max(float(strip.values.max()), 0.0)
    high = FILLED * (low - top) / (largest - least or 1.0)
    left, _, right, _ = field_on(law.found)
    left, right = left + BEFORE, right - AFTER
    wide = (right - left) / float(law.borders[-1])
    zero = (top + low) / 2 + (largest + least) / 2 * high
    return Axes((left, top, right, low), zero, wide, high, 0.0)


def diagram(law: CamLaw, axes: Axes, strip: Strip, *, last: bool) -> Iterator[Mark]:
    """The axes, the borders of the pieces and the curve of one diagram; the numbers below all."""
    _, top, right, low = axes.rect
    name = strip.symbol.replace("*", "")
    words = law.found.shown.alone.words
    for border in law.borders[1:]:
        x, _ = axes.on_page(axes.place(float(border), 0.0))
        yield LineMark(x, top - 2, x, low + 2, "register", f"border {name}")
    said = f"{strip.symbol}, {words.unit(strip.unit)}" if strip.unit != "1" else strip.symbol
    yield from axis_lines(axes, name, said)
    yield Text(right + ARROW + 1, axes.zero + 0.9, f"*{way_letter(law)}*", "caption", LETTERS)
    yield from numbers_along(words, axes, name, strip.factor, 4)
    for piece in range(len(law.at)):
        ends = zip(law.at[piece], strip.values[piece], strict=True)
        points = [axes.place(float(u), float(v)) for u, v in ends]
        yield from curve(axes, points, strip.look, f"{name} {piece}")
    for i, k in pairwise(range(len(law.at))):
        x, start = axes.on_page(axes.place(float(law.borders[i + 1]), float(strip.values[i][-1])))
        _, end = axes.on_page(axes.place(0.0, float(strip.values[k][0])))
        if abs(start - end) > 0.1:
            yield LineMark(x, start, x, end, strip.look, f"jump {name}")
    if strip.symbol in ("*s*", "*ψ*"):
        yield from pieces_named(law, axes)
    if last:
        yield from cam_numbers(law, axes)


def pieces_named(law: CamLaw, axes: Axes) -> Iterator[Mark]:
    """The motion of each piece, above it."""
    words = law.found.shown.alone.words
    for piece, (low, high) in zip(law.cam.law, pairwise(law.borders), strict=True):
        x, _ = axes.on_page(axes.place(float(low + high) / 2, 0.0))
        wide = float(high - low) * axes.wide
        moves = float(piece.rise.si(law.found.cycle.scene.values)) != 0
        moved = f"page.motion_{piece.motion.replace(' ', '_')}"
        if piece.slopes is None and wide > 12:
            said = words(moved if moves else "page.motion_dwell")
            at = x, axes.rect[1] - 0.6
            yield Text(*at, said, "caption", LETTERS, "middle", "motion")


def cam_numbers(law: CamLaw, axes: Axes) -> Iterator[Mark]:
    """The numbers of the cam's angle or way below the last diagram."""
    drawing = law.found.shown.alone
    per = drawing.length(1.0) if law.cam.slides else float(np.degrees(1.0))
    whole = float(law.borders[-1]) * per
    pace = 30.0 if not law.cam.slides else next(preferred(whole / TICKS))
    for k in range(int(whole / pace + 1e-9) + 1):
        x, _ = axes.on_page(axes.place(k * pace / per, 0.0))
        text = drawing.words.decimal(f"{k * pace:.6g}") + ("" if law.cam.slides else "°")
        yield LineMark(x, axes.rect[3] - 0.8, x, axes.rect[3] + 0.8, "dimension", "axis θ")
        yield Text(x, axes.rect[3] + 3.4, text, "caption", LETTERS, "middle", "axis θ")


def way_letter(law: CamLaw) -> str:
    """The letter of the cam's angle, or of a plate's way."""
    return "x" if law.cam.slides else "θ"


# --- what is marked -------------------------------------------------------------------------------


def steepest_marks(law: CamLaw, frames: Sequence[Axes], every: Sequence[Strip]) -> Iterator[Mark]:
    """The steepest places: a line along the lift there, and its slope beside the curve of s′."""
    lift, rate = frames[:2]
    for sign in (1, -1):
        found = law.steepest(sign)
        if found is None:
            continue
        u, slope = found
        name = "steepest rise" if sign > 0 else "steepest return"
        x, y = lift.on_page(lift.place(u, float(law.orders_at(np.array([u]))[0][0])))
        rise = slope * lift.high / lift.wide
        along = SLOPE / float(np.hypot(1.0, rise))
        ends = (x - along, y + along * rise, x + along, y - along * rise)
        yield LineMark(*ends, "construction", name)
        yield CircleMark(x, y, POINT, "point construction", name)
        at: XY = rate.on_page(rate.place(u, slope))
        yield CircleMark(*at, POINT, "point velocity", name)
        text, aside = number_of(law, every[1], slope), -1.2 if sign > 0 else 3.0
        beside = Text(at[0] + 2.2, at[1] + aside, text, "caption", LETTERS, name=name)
        yield from cleared(beside)


def limit_marks(law: CamLaw, axes: Axes) -> Iterator[Mark]:
    """The customary limit of the pressure angle, if the diagram reaches near it."""
    limit = limit_of(law)
    _, y = axes.on_page(axes.place(0.0, limit))
    if y >= axes.rect[1] - 2:
        yield LineMark(axes.rect[0], y, axes.rect[2], y, "centre-line", "limit")


def limit_of(law: CamLaw) -> float:
    """The customary largest pressure angle in degrees."""
    return MOST_PRESSURE["lever" if law.cam.lever else "follower"]


def number_of(law: CamLaw, strip: Strip, value: float) -> str:
    """A value of a diagram with its unit."""
    words = law.found.shown.alone.words
    text = words.significant(value * strip.factor, 4)
    unit = words.unit(strip.unit)
    return text if unit == "1" else text + ("" if unit == "°" else " ") + unit


def place_of(law: CamLaw, at: float) -> str:
    """A place of the cam as printed."""
    drawing = law.found.shown.alone
    if law.cam.slides:
        unit = drawing.scene.units["length"]
        return f"{drawing.words.significant(drawing.length(at), 4)} {unit}"
    return f"{drawing.words.fixed(float(np.degrees(at)), 2)}°"


def sentences_of(law: CamLaw, every: Sequence[Strip]) -> list[str]:
    """Steepest places, jumps, the pressure angle with its limit, and largest values in time."""
    words, letter = law.found.shown.alone.words, way_letter(law)
    said = []
    for sign, key in ((1, "diagrams.steepest_rise"), (-1, "diagrams.steepest_return")):
        if (found := law.steepest(sign)) is not None:
            value = f"{every[1].symbol} = {number_of(law, every[1], found[1])}"
            said.append(words(key, value=value, u=letter, at=place_of(law, found[0])))
    for order, key in ((1, "diagrams.jumps_1"), (2, "diagrams.jumps_2")):
        if jumps := law.jumps(order):
            places = words("list_mark").join(place_of(law, u) for u in jumps)
            said.append(words(key, s=every[order].symbol, list=places))
            break
    return [*said, *(pressure_said(law) if law.is_pressed else ()), *in_time(law, every)]


def pressure_said(law: CamLaw) -> Iterator[str]:
    """The largest pressure angle with its customary limit."""
    words, limit = law.found.shown.alone.words, limit_of(law)
    at, most = law.largest(law.pressure_at)
    key = "diagrams.pressure_kept" if most <= limit else "diagrams.pressure_beyond"
    numbers = {"most": f"{words.fixed(most, 3)}°", "limit": f"{limit:g}°"}
    yield words(key, u=way_letter(law), at=place_of(law, at), **numbers)


def size_of_order(law: CamLaw, order: int, at: Reals) -> Reals:
    """The size of a derivative of the lift at some θ."""
    return np.asarray(np.abs(law.orders_at(at)[order]))


def in_time(law: CamLaw, every: Sequence[Strip]) -> Iterator[str]:
    """The largest speed, acceleration and jerk of the follower, where the driver is the cam."""
    drawing, sweep = law.found.shown.alone, law.found.cycle.sweep
    driver = sweep.driver
    if driver is None or driver.link != law.cam.on or law.cam.carrier != driver.against:
        return
    _, speed, push = stated_motion(driver, sweep.original)
    if not float(speed) or float(push):
        return
    pace, lever = float(speed), law.cam.lever is not None
    unit = "rad" if lever else "m"
    shown = []
    for order in (1, 2, 3):
        _, most = law.largest(partial(size_of_order, law, order))
        power = "" if order == 1 else f"^{order}"
        size = drawing.words.significant(most * abs(pace) ** order, 4)
        shown.append(f"{size} {drawing.words.unit(unit)}/{drawing.words.spelled('s')}{power}")
    letter = "*v*" if law.cam.slides else "*ω*"
    own_unit = drawing.words.unit("m/s" if law.cam.slides else "rad/s")
    own = f"{drawing.words.significant(abs(pace), 4)} {own_unit}"
    rates = [
        f"{each.symbol}·{letter}{'' if order == 1 else f'^{order}'}"
        for order, each in enumerate(every[1:4], 1)
    ]
    yield drawing.words(
        "diagrams.cam_in_time",
        pace=f"{letter} = {own}",
        rule=", ".join(rates),
        list=", ".join(shown),
    )
