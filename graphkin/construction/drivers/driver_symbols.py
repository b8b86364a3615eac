"""The drivers on the mechanism: the angle of each crank, the path of each slide, and its sense."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from math import degrees, pi
from typing import NamedTuple

from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import NOISE, Drawing
from graphkin.construction.core.naming import angle_symbol, driver_index
from graphkin.construction.core.quantities import in_degrees, quantity_text
from graphkin.construction.guides.slide_symbols import ground_ways, within
from graphkin.construction.links.link_shapes import seat
from graphkin.drawing.field import XY, Field
from graphkin.drawing.labels import FieldContent, Label
from graphkin.drawing.marks import Arc, LineMark, Mark, Shown, showing
from graphkin.drawing.symbols import BLOCK, SHORT, across, arrow, distance, head, turned_arrow
from graphkin.numbers.arithmetic import Real, phase, pick, turn_by
from graphkin.numbers.plane import cross, dot
from graphkin.scene.model import FRAME, Driver, Slide

DEGREE = 180 / pi
TURN = 360.0
"""Degrees in a full turn."""
ANGLE = 11.0
"""Radius of the arc of a driver's angle, in mm."""
WIDER = 6.5
"""Increase in radius for each further driver's arc at the same pin, in mm."""
ASIDE = 9.5
"""Distance of the dimension of a driver's slide from its guide, in mm."""
BESIDE = 7.5
"""Distance of the arrow of a driver's speed from its guide, in mm."""
LEAST = 9.0
"""The shortest distance that is dimensioned, in mm."""
ENOUGH = 4.0
"""Distance of points from a dimension line, in mm."""
SENSE, AROUND = (12.0, 70.0), 10.0
"""Range of angles beyond the crank for a turning arrow, and its clearance, in degrees."""
GROUND = 35.0
"""Half the angle that the ground of a pivot subtends at its pin, in degrees."""
HALF = 5.5
"""Half the length of the arrow of a driver's speed, in mm."""


def draw_drivers(
    board: FieldContent, drawing: Drawing, field: Field, *, defined: bool = False
) -> None:
    """Draw every driver: its position with its value, and the sense of its motion.

    With ``defined``, draw its position with the letter alone.
    """
    used: Counter[str] = Counter()
    for driver in drawing.scene.drivers:
        symbol = DriverSymbol(board, drawing, field, driver, defined)
        if driver.kind == "turn":
            start = pivot_of(drawing, driver)
            if start in drawing.positions:
                symbol.draw_crank(ANGLE + WIDER * used[start])
                used[start] += 1
        else:
            ways = (driven_ways(each.drawing, each.driver) for each in (symbol, symbol.choosing))
            for way, chosen in zip(*ways, strict=True):
                symbol.draw_way(way, chosen)


def pivot_of(drawing: Drawing, driver: Driver) -> str:
    """The point about which a driver's angle is drawn."""
    return (driver.of or drawing.scene.links[driver.link].points)[0]


def drawn_angle(drawing: Drawing, driver: Driver) -> Real:
    """The driver's angle in degrees, as written if that is less than a turn either way."""
    if driver.link in drawing.driven:
        moved = drawing.driven[driver.link]
        return pick(abs(moved) < TURN, moved, moved % TURN)
    turn = degrees(phase(complex(driver.position.direction(drawing.scene.values))))
    written = degrees(float(driver.position.si(drawing.scene.values)))
    return written if abs(written) < TURN else turn % TURN


class DriverSymbol(Struct, frozen=True):
    """A driver on the mechanism; only the letter of its position, if that is only ``defined``."""

    board: FieldContent
    drawing: Drawing
    field: Field
    driver: Driver
    defined: bool

    @property
    def choosing(self) -> DriverSymbol:
        """The same driver on the sheet whose position decides the places of marks."""
        chosen = self.drawing.choosing
        driver = chosen.scene.drivers[self.drawing.scene.drivers.index(self.driver)]
        return replace(self, drawing=chosen, driver=driver)

    @property
    def coordinate(self) -> str:
        """The letter of its position, with its value unless it is only defined."""
        scene, driver = self.drawing.scene, self.driver
        letter = angle_symbol(scene, driver)
        if self.defined:
            return letter
        given = scene, self.drawing.words, driver.position
        angle = in_degrees(*given) if driver.kind == "turn" else ""
        return f"{letter} = {angle or quantity_text(*given)}"

    @property
    def speed(self) -> Real:
        """Its speed, in rad/s or m/s; its sign is the sense drawn."""
        scene, trace = self.drawing.scene, self.drawing.trace
        for each, drive in zip(scene.drivers, trace.program.drives, strict=True):
            if each is self.driver and drive.speed in trace.values:
                return trace.values[drive.speed]
        return float(self.driver.speed.si(scene.values))

    # --- driven by turning -----------------------------------------------------------------------

    def draw_crank(self, radius: float) -> None:
        """Draw the angle of a crank from the axis of the link it turns against, and its sense."""
        board, drawing, field, driver = self.board, self.drawing, self.field, self.driver
        centre = field(drawing.positions[pivot_of(drawing, driver)])
        base = drawing.standing.axis(driver.against)
        if base is None:
            return
        swept, zero, end = drawn_angle(drawing, driver), phase(base) * DEGREE, self.bearing
        ray, shows = (
            across(centre, field.way(base), radius + 6, 0),
            Shown("coordinate", driver.link),
        )
        axis = LineMark(*centre, *ray, "centre-line", f"x {driver.link}", shows=shows)
        board.marks += within([axis], field.rect)
        if driver.of is None and not self.lies_along(end):
            tip = across(centre, field.way(base * turn_by(swept / DEGREE)), radius + 6, 0)
            line = LineMark(*centre, *tip, "centre-line", f"axis {driver.link}", shows=shows)
            board.marks.append(line)
        name = "phi" if len(drawing.scene.drivers) == 1 else f"phi {driver.link}"
        if abs(swept) > 0.5:
            board.marks.append(Arc(*centre, radius, zero, end, "angle", name, shows=shows))
        half = field.way(base * turn_by(swept / 2 / DEGREE))
        middle = across(centre, half, radius, 0)
        label = Label(self.coordinate, "", middle, 2.5, name, away=half, shows=shows)
        board.labels.append(label)
        if not self.defined:
            self.draw_sense(end, radius - 3)

    @property
    def bearing(self) -> Real:
        """The bearing of a crank in degrees."""
        base = self.drawing.standing.axis(self.driver.against)
        assert base is not None
        return phase(base) * DEGREE + drawn_angle(self.drawing, self.driver)

    def lies_along(self, angle: float) -> bool:
        """Whether the link's second point is on the ray at an angle (degrees) from its first."""
        points = self.drawing.scene.links[self.driver.link].points[:2]
        places = [self.drawing.positions[p] for p in points]
        if len(places) < 2 or places[0] == places[1]:
            return False
        turn = phase(places[1] - places[0]) * DEGREE - angle
        return bool(abs((turn + 180) % 360 - 180) < 0.01)

    def draw_sense(self, end: Real, radius: float) -> None:
        """Draw a turning arrow beyond the crank, in the sense of its angular velocity."""
        drawing, field, driver, omega = self.drawing, self.field, self.driver, self.speed
        if omega == 0:
            return
        centre = field(drawing.positions[pivot_of(drawing, driver)])
        sign = pick(omega > 0, 1, -1)
        (near, far), turns = SENSE, dict(self.cuts(end, sign))
        place = self.choosing.end_beyond()
        start, long = turns[place] + near if place else near, far - near
        tip = end + sign * (start + long)
        way, half = (field.way(turn_by(at / DEGREE)) for at in (tip, tip - sign * long / 2))
        shows, end_of_arc = Shown("rate", driver.link), (tip, -sign * long)
        self.board.marks += showing(shows, turned_arrow(centre, radius, way, end_of_arc, "sense"))
        at = across(centre, half, radius, 0)
        text, name = f"*ω*_{{{driver_index(driver)}}}", f"omega {driver.link}"
        self.board.labels.append(Label(text, "", at, 2.5, name, shows=shows))

    def end_beyond(self) -> str:
        """The line beyond which a turning arrow is clear; empty beyond the crank itself."""
        (near, far), end = SENSE, self.bearing
        found = list(self.cuts(end, 1 if self.speed > 0 else -1))
        turns = [(0.0, ""), *sorted((turn, name) for name, turn in found)]

        def is_free(start: float) -> bool:
            return not any(-AROUND < cut - start < far - near + AROUND for _, cut in found)

        places = ((turn + near, name) for turn, name in turns)
        return next((name for at, name in places if at + far < 360 and is_free(at)), "")

    def cuts(self, end: Real, sign: Real) -> Iterator[tuple[str, Real]]:
        """The names of the lines that could cut the arrow, and their angles beyond the crank.

        Angles are in degrees in the crank's sense. The lines are bars, the ground of the pivot, and
        the velocity of a moving pivot.
        """
        drawing, here = self.drawing, pivot_of(self.drawing, self.driver)
        links = (link for link in drawing.scene.links.values() if here in link.points)
        others = (p for link in links for p in link.points if link.name != self.driver.link)
        ways = {point: drawing.positions[point] - drawing.positions[here] for point in others}
        velocity = drawing.trace.value("velocity", here)
        if velocity is not None and not abs(velocity) < NOISE * drawing.largest:
            ways[f"v {here}"] = velocity
        ground = ground_ways(drawing, self.field.mm).get(here)
        if ground is not None:
            for side in (-1, 0, 1):
                ways[f"ground {side}"] = ground * turn_by(side * GROUND / DEGREE)
        for name, way in ways.items():
            if abs(way) > 0:
                yield name, sign * (phase(way) * DEGREE - end) % 360

    # --- driven along a guide or a track ---------------------------------------------------------

    def draw_way(self, driven: DrivenWay, chosen: DrivenWay) -> None:
        """Dimension a driven coordinate next to its line, and draw an arrow for its rate of change.

        The side and whether a dimension fits are those of the way ``chosen``, on the sheet where
        places are chosen.
        """
        board, field, link, way = (
            self.board,
            self.field,
            self.driver.link,
            self.field.way(driven.along),
        )
        aside = free_side(self.drawing.choosing, field, chosen.zero, chosen.here, chosen.along)
        side = 1 if aside > 0 else -1
        start, end = field(driven.zero), field(driven.here)
        text, name, shows = self.coordinate, f"s {link}", Shown("coordinate", link)
        if field.holds(chosen.zero, 1) and abs(chosen.here - chosen.zero) * field.mm >= LEAST:
            low, high = across(start, way, 0, aside), across(end, way, 0, aside)
            thin = [across(each, way, 0, aside + side * 1.5) for each in (start, end)]
            lines = ((start, thin[0]), (end, thin[1]), (low, high))
            board.marks += within(showing(shows, dimension(lines, name)), field.rect)
            board.labels.append(Label(text, "", (low, high), 2.5, name, shows=shows))
        else:
            at = across(field(driven.drawn), way, 0, side * BLOCK[1] / 2)
            away = across((0.0, 0.0), way, 0, side)
            board.labels.append(Label(text, "", at, 2.5, name, away=away, shows=shows))
        speed = self.speed
        if speed != 0 and not self.defined:
            ahead = pick(speed > 0, HALF, -HALF)
            here, name, shows = field(driven.moved), f"speed {link}", Shown("rate", link)
            tail, tip = (across(here, way, a, -side * BESIDE) for a in (-ahead, ahead))
            board.marks += showing(shows, arrow(tail, tip, "sense", name))
            text = f"*v*_{{{driver_index(self.driver)}}}"
            board.labels.append(Label(text, "", (tail, tip), 2.5, name, shows=shows))


def driven_slide(drawing: Drawing, driver: Driver) -> Slide | None:
    """The slide that a sliding driver moves."""
    slides = drawing.scene.links[driver.link].slides
    return next((slide for slide in slides if slide.on == driver.against), None)


class DrivenWay(NamedTuple):
    """A coordinate that is driven: its zero, its place, and its direction.

    A coordinate too short for its dimension is written next to ``drawn``. The arrow of its rate of
    change is drawn next to ``moved``, which has this speed.
    """

    zero: complex
    here: complex
    along: complex
    drawn: complex
    moved: complex


def driven_ways(drawing: Drawing, driver: Driver) -> Iterator[DrivenWay]:
    """The ways of a driven block from the zero of its guide, or of a driven wheel on its track.

    A wheel's way ends at its contact point and starts at the zero of its track. Its centre has the
    speed.
    """
    if driver.kind == "slide":
        slide = driven_slide(drawing, driver)
        for way in drawing.standing.guideways:
            if way.block == driver.link and way.slide is slide:
                path = 1j * way.offset * way.along
                drawn = seat(drawing, way) if way.slide.on == FRAME else way.at
                yield DrivenWay(way.zero + path, way.at, way.along, drawn, drawn)
        return
    for touch in drawing.standing.touches:
        mine = touch.disc.link == driver.link and touch.on == driver.against
        if mine and touch.zero is not None:
            yield DrivenWay(touch.zero, touch.at, touch.along, touch.at, touch.disc.centre)


def free_side(drawing: Drawing, field: Field, start: complex, end: complex, way: complex) -> float:
    """The nearest free distance to the right of a line for a dimension, in mm.

    Both sides are tried, first the one away from the mechanism. Where no distance is free, the
    nearest on that side is returned.
    """
    places = list(drawing.positions.values())
    low, high = sorted(dot(place - start, way) * field.mm for place in (start, end))
    middle = sum(places) / len(places)
    outer = 1 if cross(way, middle - end) >= 0 else -1
    right = [
        -cross(way, place - start) * field.mm
        for place in places
        if low - ASIDE < dot(place - start, way) * field.mm < high + ASIDE
    ]
    tries = [side * far for far in (ASIDE, 1.6 * ASIDE, 2.2 * ASIDE) for side in (outer, -outer)]
    free = (far for far in tries if all(abs(far - place) > ENOUGH for place in right))
    return next(free, outer * ASIDE)


def dimension(lines: Iterable[tuple[XY, XY]], name: str) -> Iterator[Mark]:
    """The extension lines and the dimension line, with arrowheads where there is room."""
    for low, high in lines:
        yield LineMark(*low, *high, "drive", name)
    if distance(low, high) >= SHORT:
        yield head(low, high, "sense", name)
        yield head(high, low, "sense", name)
