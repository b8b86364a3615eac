"""How the angle or the way of a driver and the arrow of its sense follow it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import pi
from typing import Any, NamedTuple

from graphkin.arithmetic import pick
from graphkin.motion.driving import TURN
from graphkin.paper.inputs import ANGLE, WIDER, draw_crank, draw_roll, draw_slide, driven_slide
from graphkin.paper.labels import Board
from graphkin.paper.marks import Arc, Line, Mark, Polyline
from graphkin.scene.model import FRAME, Driver
from graphkin.screen.binding import Bench, Binding, Told, only_at_start
from graphkin.screen.poses import Pose


def of_driver(bench: Bench, driver: Driver, angles: Mapping[str, Any]) -> Told:
    """The marks of a driver, made again to be told; ``angles`` are those of links, in degrees."""
    board, drawing = Board(bench.field.rect), bench.places.drawing
    if driver.kind == "turn":
        return of_crank(bench, driver, board, angles[driver.link])
    if driver.kind == "slide":
        draw_slide(board, drawing, bench.field, driver)
    else:
        draw_roll(board, drawing, bench.field, driver)
    found: Told = {}
    for way in ways_of(bench, driver):
        lines = [mark for mark in board.marks if isinstance(mark, Line) and mark.cls == "drive"]
        for mark in board.marks:
            if mark.name.startswith("s "):
                found[mark] = dimension(bench, mark, lines, way)
            else:
                found[mark] = bench.carried_by(Pose(way.drawn, way.along))
    return found


def of_crank(bench: Bench, driver: Driver, board: Board, angle: Any) -> Told:
    """The arc of a crank's angle from the axis it counts from, and the arrow of its sense."""
    places, drawing = bench.places, bench.places.drawing
    start = first_of(bench, driver)
    if start not in drawing.positions:
        return {}
    before = drawing.scene.drivers[: drawing.scene.drivers.index(driver)]
    starts = [first_of(bench, other) for other in before if other.kind == "turn"]
    radius = ANGLE + WIDER * starts.count(start)
    draw_crank(board, drawing, bench.field, driver, radius)
    at, base, own = places.positions[start], places.pose(driver.against), places.pose(driver.link)
    found: Told = {}
    for mark in board.marks:
        if isinstance(mark, Arc) and mark.cls == "angle":
            found[mark] = swept(bench, at, angle, places.turn_of(driver.against), mark)
        elif mark.name.startswith("x ") and base is not None:
            found[mark] = bench.carried_by(Pose(at, base.way))
        elif own is not None:
            found[mark] = bench.carried_by(Pose(at, own.way))
    return found


def first_of(bench: Bench, driver: Driver) -> str:
    """The point about which a driver's angle is drawn."""
    return (driver.of or bench.places.drawing.scene.links[driver.link].points)[0]


def swept(bench: Bench, centre: Any, angle: Any, base: Any, mark: Arc) -> Binding:
    """The arc of a crank's angle, from nought to where it stands, less than a turn.

    ``base`` is by how much the link has turned against which it is counted.
    """
    angle, base = bench.shelf.lifted(angle), bench.shelf.lifted(base)
    zero = base.imag.do("atan2", base.real) * (180 / pi) + mark.start
    rest = angle - (angle * (1 / TURN)).do("floor") * TURN
    end = zero + pick(abs(angle) < TURN, angle, rest)
    return bench.arc(centre, mark.r / bench.field.mm, (zero, end))


class Way(NamedTuple):
    """What a driver's coordinate is counted along: its zero, its place, its direction, and beside
    which place the arrow of its speed stands."""

    zero: Any
    here: Any
    along: Any
    drawn: Any


def ways_of(bench: Bench, driver: Driver) -> Iterator[Way]:
    """The way of a driven block or of a driven wheel's contact."""
    places, standing = bench.places, bench.places.drawing.standing
    if driver.kind == "slide":
        slide = driven_slide(bench.places.drawing, driver)
        for way in standing.guideways:
            if way.block == driver.link and way.slide is slide:
                along = places.along(way)
                zero = places.carried(way.slide.on, way.zero + 1j * way.offset * way.along)
                here = places.positions[bench.places.drawing.scene.links[way.block].points[0]]
                yield Way(zero, here, along, places.seat(way) if way.slide.on == FRAME else here)
        return
    for touch in standing.touches:
        mine = touch.disc.link == driver.link and touch.rolling.on == driver.against
        if mine and touch.zero is not None:
            pose = places.touch(touch)
            yield Way(places.carried(driver.against, touch.zero), *pose, pose.origin)


def dimension(bench: Bench, mark: Mark, lines: list[Line], way: Way) -> Binding:
    """A line or a head of a dimension: at its zero, at the block, or between both."""
    if len(lines) != 3:
        return only_at_start
    whole, shelf = lines[2], bench.shelf
    along = shelf.lifted(way.along).conjugate()
    ends = [bench.page(place) for place in (way.zero, way.here)]
    off = (complex(whole.x1, whole.y1) - shelf.now(ends[0])) * shelf.now(along).conjugate()
    low, high = (place + along * (1j * off.imag) for place in ends)
    if mark is whole:
        return bench.joining(low, high, bench.room)
    if isinstance(mark, Line):
        return bench.on(Pose(ends[lines.index(mark)], along), bench.room)
    assert isinstance(mark, Polyline)
    tip = complex(*mark.points[0])
    if abs(tip - shelf.now(high)) > abs(tip - shelf.now(low)):
        low, high = high, low
    return lambda _: ["h", -1, shelf.point(low), shelf.point(high)]
