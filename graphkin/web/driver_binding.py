"""How the angle or the way of a driver and the arrow of its sense follow it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import pi
from typing import Any, NamedTuple

from graphkin.construction.drivers.driver_symbols import (
    ANGLE,
    WIDER,
    draw_crank,
    draw_roll,
    draw_slide,
    driven_slide,
)
from graphkin.drawing.labels import FieldContent
from graphkin.drawing.marks import Arc, LineMark, Mark, Polyline
from graphkin.motion.driving import TURN
from graphkin.numbers.arithmetic import pick
from graphkin.scene.model import FRAME, Driver
from graphkin.web.field_binder import Binding, FieldBinder, Told, only_at_start
from graphkin.web.traced_poses import BodyPose


def of_driver(binder: FieldBinder, driver: Driver, angles: Mapping[str, Any]) -> Told:
    """The marks of a driver, made again to be told; ``angles`` are those of links, in degrees."""
    board, drawing = FieldContent(binder.field.rect), binder.places.drawing
    if driver.kind == "turn":
        return of_crank(binder, driver, board, angles[driver.link])
    if driver.kind == "slide":
        draw_slide(board, drawing, binder.field, driver)
    else:
        draw_roll(board, drawing, binder.field, driver)
    found: Told = {}
    for way in ways_of(binder, driver):
        lines = [mark for mark in board.marks if isinstance(mark, LineMark) and mark.cls == "drive"]
        for mark in board.marks:
            if mark.name.startswith("s "):
                found[mark] = dimension(binder, mark, lines, way)
            else:
                found[mark] = binder.carried_by(BodyPose(way.drawn, way.along))
    return found


def of_crank(binder: FieldBinder, driver: Driver, board: FieldContent, angle: Any) -> Told:
    """The arc of a crank's angle from the axis it counts from, and the arrow of its sense."""
    places, drawing = binder.places, binder.places.drawing
    start = first_of(binder, driver)
    if start not in drawing.positions:
        return {}
    before = drawing.scene.drivers[: drawing.scene.drivers.index(driver)]
    starts = [first_of(binder, other) for other in before if other.kind == "turn"]
    radius = ANGLE + WIDER * starts.count(start)
    draw_crank(board, drawing, binder.field, driver, radius)
    at, base, own = places.positions[start], places.pose(driver.against), places.pose(driver.link)
    found: Told = {}
    for mark in board.marks:
        if isinstance(mark, Arc) and mark.cls == "angle":
            found[mark] = swept(binder, at, angle, places.turn_of(driver.against), mark)
        elif mark.name.startswith("x ") and base is not None:
            found[mark] = binder.carried_by(BodyPose(at, base.way))
        elif own is not None:
            found[mark] = binder.carried_by(BodyPose(at, own.way))
    return found


def first_of(binder: FieldBinder, driver: Driver) -> str:
    """The point about which a driver's angle is drawn."""
    return (driver.of or binder.places.drawing.scene.links[driver.link].points)[0]


def swept(binder: FieldBinder, centre: Any, angle: Any, base: Any, mark: Arc) -> Binding:
    """The arc of a crank's angle, from nought to where it stands, less than a turn.

    ``base`` is by how much the link has turned against which it is counted.
    """
    angle, base = binder.tape.lifted(angle), binder.tape.lifted(base)
    zero = base.imag.do("atan2", base.real) * (180 / pi) + mark.start
    rest = angle - (angle * (1 / TURN)).do("floor") * TURN
    end = zero + pick(abs(angle) < TURN, angle, rest)
    return binder.arc(centre, mark.r / binder.field.mm, (zero, end))


class DriverAxis(NamedTuple):
    """What a driver's coordinate is counted along: its zero, its place, its direction, and beside
    which place the arrow of its speed stands."""

    zero: Any
    here: Any
    along: Any
    drawn: Any


def ways_of(binder: FieldBinder, driver: Driver) -> Iterator[DriverAxis]:
    """The way of a driven block or of a driven wheel's contact."""
    places, standing = binder.places, binder.places.drawing.standing
    if driver.kind == "slide":
        slide = driven_slide(binder.places.drawing, driver)
        for way in standing.guideways:
            if way.block == driver.link and way.slide is slide:
                along = places.along(way)
                zero = places.carried(way.slide.on, way.zero + 1j * way.offset * way.along)
                here = places.positions[binder.places.drawing.scene.links[way.block].points[0]]
                yield DriverAxis(
                    zero, here, along, places.seat(way) if way.slide.on == FRAME else here
                )
        return
    for touch in standing.touches:
        mine = touch.disc.link == driver.link and touch.on == driver.against
        if mine and touch.zero is not None:
            pose = places.touch(touch)
            yield DriverAxis(places.carried(driver.against, touch.zero), *pose, pose.origin)


def dimension(binder: FieldBinder, mark: Mark, lines: list[LineMark], way: DriverAxis) -> Binding:
    """A line or a head of a dimension: at its zero, at the block, or between both."""
    if len(lines) != 3:
        return only_at_start
    whole, tape = lines[2], binder.tape
    along = tape.lifted(way.along).conjugate()
    ends = [binder.page(place) for place in (way.zero, way.here)]
    off = (complex(whole.x1, whole.y1) - tape.now(ends[0])) * tape.now(along).conjugate()
    low, high = (place + along * (1j * off.imag) for place in ends)
    if mark is whole:
        return binder.joining(low, high, binder.room)
    if isinstance(mark, LineMark):
        return binder.on(BodyPose(ends[lines.index(mark)], along), binder.room)
    assert isinstance(mark, Polyline)
    tip = complex(*mark.points[0])
    if abs(tip - tape.now(high)) > abs(tip - tape.now(low)):
        low, high = high, low
    return lambda _: ["h", -1, tape.point(low), tape.point(high)]
