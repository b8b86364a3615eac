"""The drivers on the mechanism: the angle of each crank, the path of each slide, and its sense."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from math import degrees, pi
from typing import NamedTuple

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
    used: list[tuple[str, int]] = []
    for driver in drawing.scene.drivers:
        if driver.kind == "turn":
            start = pivot_of(drawing, driver)
            if start in drawing.positions:
                nth = sum(1 for name, _ in used if name == start)
                used.append((start, nth))
                draw_crank(board, drawing, field, driver, ANGLE + WIDER * nth, defined)
        else:
            sheets = drawing, drawing.choosing
            ways = (driven_ways(each, same(driver, drawing, each)) for each in sheets)
            for way, chosen in zip(*ways, strict=True):
                room = dimensioned(drawing, field, chosen)
                draw_way(board, drawing, field, driver, way, room, defined)


def same(driver: Driver, drawing: Drawing, other: Drawing) -> Driver:
    """The driver of another sheet of the same scene."""
    return other.scene.drivers[drawing.scene.drivers.index(driver)]


def draw_crank(
    board: FieldContent,
    drawing: Drawing,
    field: Field,
    driver: Driver,
    radius: float,
    defined: bool,
) -> None:
    """Draw the angle of a crank from the axis of the link it turns against, and its sense."""
    start = pivot_of(drawing, driver)
    centre = field(drawing.positions[start])
    base = drawing.standing.axis(driver.against)
    if base is None:
        return
    swept = drawn_angle(drawing, driver)
    zero, end = phase(base) * DEGREE, crank_end(drawing, driver)
    ray, shows = across(centre, field.way(base), radius + 6, 0), Shown("coordinate", driver.link)
    axis = LineMark(*centre, *ray, "centre-line", f"x {driver.link}", shows=shows)
    board.marks += within([axis], field.rect)
    if driver.of is None and not lies_along(drawing, driver.link, end):
        tip = across(centre, field.way(base * turn_by(swept / DEGREE)), radius + 6, 0)
        line = LineMark(*centre, *tip, "centre-line", f"axis {driver.link}", shows=shows)
        board.marks.append(line)
    name = "phi" if len(drawing.scene.drivers) == 1 else f"phi {driver.link}"
    if abs(swept) > 0.5:
        board.marks.append(Arc(*centre, radius, zero, end, "angle", name, shows=shows))
    half = field.way(base * turn_by(swept / 2 / DEGREE))
    middle = across(centre, half, radius, 0)
    text = coordinate(drawing, driver, defined)
    board.labels.append(Label(text, "", middle, 2.5, name, away=half, shows=shows))
    if not defined:
        draw_sense(board, drawing, field, end, driver, radius - 3)


def coordinate(drawing: Drawing, driver: Driver, defined: bool) -> str:
    """The letter of a driver's position, with its value unless it is only defined."""
    letter = angle_symbol(drawing.scene, driver)
    if defined:
        return letter
    given = drawing.scene, drawing.words, driver.position
    angle = in_degrees(*given) if driver.kind == "turn" else ""
    return f"{letter} = {angle or quantity_text(*given)}"


def crank_end(drawing: Drawing, driver: Driver) -> Real:
    """The bearing of a crank in degrees."""
    base = drawing.standing.axis(driver.against)
    assert base is not None
    return phase(base) * DEGREE + drawn_angle(drawing, driver)


def pivot_of(drawing: Drawing, driver: Driver) -> str:
    """The point about which a driver's angle is drawn."""
    return (driver.of or drawing.scene.links[driver.link].points)[0]


def lies_along(drawing: Drawing, link: str, angle: float) -> bool:
    """Whether the link's second point is on the ray at an angle (degrees) from its first."""
    places = [drawing.positions[p] for p in drawing.scene.links[link].points[:2]]
    if len(places) < 2 or places[0] == places[1]:
        return False
    turn = phase(places[1] - places[0]) * DEGREE - angle
    return bool(abs((turn + 180) % 360 - 180) < 0.01)


def drawn_angle(drawing: Drawing, driver: Driver) -> Real:
    """The driver's angle in degrees, as written if that is less than a turn either way."""
    if driver.link in drawing.driven:
        moved = drawing.driven[driver.link]
        return pick(abs(moved) < TURN, moved, moved % TURN)
    turn = degrees(phase(complex(driver.position.direction(drawing.scene.values))))
    written = degrees(float(driver.position.si(drawing.scene.values)))
    return written if abs(written) < TURN else turn % TURN


def draw_sense(
    board: FieldContent, drawing: Drawing, field: Field, end: Real, driver: Driver, radius: float
) -> None:
    """Draw a turning arrow beyond the crank, in the sense of its angular velocity."""
    centre = field(drawing.positions[pivot_of(drawing, driver)])
    omega = speed_of(drawing, driver)
    if omega == 0:
        return
    sign = pick(omega > 0, 1, -1)
    (near, far), turns = SENSE, dict(cuts(drawing, field, driver, end, sign))
    chosen = drawing.choosing
    place = end_beyond(chosen, field, same(driver, drawing, chosen))
    start, long = turns[place] + near if place else near, far - near
    tip = end + sign * (start + long)
    way, half = (field.way(turn_by(at / DEGREE)) for at in (tip, tip - sign * long / 2))
    shows, end_of_arc = Shown("rate", driver.link), (tip, -sign * long)
    board.marks += showing(shows, turned_arrow(centre, radius, way, end_of_arc, "sense"))
    at = across(centre, half, radius, 0)
    text = f"*ω*_{{{driver_index(driver)}}}"
    board.labels.append(Label(text, "", at, 2.5, f"omega {driver.link}", shows=shows))


def speed_of(drawing: Drawing, driver: Driver) -> Real:
    """The driver's speed, in rad/s or m/s; its sign is the sense drawn."""
    for each, drive in zip(drawing.scene.drivers, drawing.trace.program.drives, strict=True):
        if each is driver and drive.speed in drawing.trace.values:
            return drawing.trace.values[drive.speed]
    return float(driver.speed.si(drawing.scene.values))


def end_beyond(drawing: Drawing, field: Field, driver: Driver) -> str:
    """The name of the line beyond which a turning arrow is clear; empty beyond the crank itself."""
    (near, far), end = SENSE, crank_end(drawing, driver)
    sign = 1 if speed_of(drawing, driver) > 0 else -1
    found = list(cuts(drawing, field, driver, end, sign))
    turns = [(0.0, ""), *sorted((turn, name) for name, turn in found)]

    def is_free(start: float) -> bool:
        return not any(-AROUND < cut - start < far - near + AROUND for _, cut in found)

    places = ((turn + near, name) for turn, name in turns)
    return next((name for at, name in places if at + far < 360 and is_free(at)), "")


def cuts(
    drawing: Drawing, field: Field, driver: Driver, end: Real, sign: Real
) -> Iterator[tuple[str, Real]]:
    """The names of the lines that could cut the arrow, and their angles beyond the crank.

    Angles are in degrees in the crank's sense. The lines are bars, the ground of the pivot, and the
    velocity of a moving pivot.
    """
    here = pivot_of(drawing, driver)
    links = (link for link in drawing.scene.links.values() if here in link.points)
    others = (point for link in links for point in link.points if link.name != driver.link)
    ways = {point: drawing.positions[point] - drawing.positions[here] for point in others}
    velocity = drawing.trace.value("velocity", here)
    if velocity is not None and not abs(velocity) < NOISE * drawing.largest:
        ways[f"v {here}"] = velocity
    ground = ground_ways(drawing, field.mm).get(here)
    if ground is not None:
        for side in (-1, 0, 1):
            ways[f"ground {side}"] = ground * turn_by(side * GROUND / DEGREE)
    for name, way in ways.items():
        if abs(way) > 0:
            yield name, sign * (phase(way) * DEGREE - end) % 360


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


def dimensioned(drawing: Drawing, field: Field, way: DrivenWay) -> tuple[float, bool]:
    """The free distance to the right of a driven way, and whether a dimension fits.

    The distance is chosen on the sheet where places are chosen.
    """
    long = abs(way.here - way.zero) * field.mm >= LEAST
    aside = free_side(drawing.choosing, field, way.zero, way.here, way.along)
    return aside, field.holds(way.zero, 1) and bool(long)


def draw_way(
    board: FieldContent,
    drawing: Drawing,
    field: Field,
    driver: Driver,
    driven: DrivenWay,
    chosen: tuple[float, bool],
    defined: bool,
) -> None:
    """Dimension a driven coordinate next to its line, and draw an arrow for its rate of change."""
    way, (aside, is_dimensioned) = field.way(driven.along), chosen
    side = 1 if aside > 0 else -1
    start, end = field(driven.zero), field(driven.here)
    name, shows = f"s {driver.link}", Shown("coordinate", driver.link)
    text = coordinate(drawing, driver, defined)
    if is_dimensioned:
        low, high = across(start, way, 0, aside), across(end, way, 0, aside)
        thin = across(start, way, 0, aside + side * 1.5), across(end, way, 0, aside + side * 1.5)
        lines = ((start, thin[0]), (end, thin[1]), (low, high))
        board.marks += within(showing(shows, dimension(lines, name)), field.rect)
        board.labels.append(Label(text, "", (low, high), 2.5, name, shows=shows))
    else:
        at = across(field(driven.drawn), way, 0, side * BLOCK[1] / 2)
        away = across((0.0, 0.0), way, 0, side)
        board.labels.append(Label(text, "", at, 2.5, name, away=away, shows=shows))
    speed = speed_of(drawing, driver)
    if speed != 0 and not defined:
        ahead = pick(speed > 0, HALF, -HALF)
        tail, tip = (across(field(driven.moved), way, a, -side * BESIDE) for a in (-ahead, ahead))
        name, shows = f"speed {driver.link}", Shown("rate", driver.link)
        board.marks += showing(shows, arrow(tail, tip, "sense", name))
        text = f"*v*_{{{driver_index(driver)}}}"
        board.labels.append(Label(text, "", (tail, tip), 2.5, name, shows=shows))


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
