"""The drivers' motion as stated: position, speed, and how far they can move."""

from __future__ import annotations

from math import degrees
from typing import Any, Literal, NamedTuple, get_args

from graphkin.numbers.arithmetic import batch_kind, np
from graphkin.scene.expression import TIME
from graphkin.scene.model import At, Driver, DriverKind, Scene, lengths_of
from graphkin.scene.quantity import Quantity

What = DriverKind | Literal["time"]


class Coordinate(NamedTuple):
    """A swept coordinate: its name as a column, its letter and unit, and the driven link's verb."""

    name: str
    letter: str
    unit: str
    moves: str = ""


COORDINATES: dict[What, Coordinate] = {
    **{kind: Coordinate("s", "s", "m", f"{kind}s") for kind in get_args(DriverKind)},
    "turn": Coordinate("phi", "φ", "deg", "turns"),
    "time": Coordinate("t", "t", "s"),
}
"""The coordinates that a cycle may sweep."""
TURN = 360.0
GRID = 7200
"""Positions of a full sweep at which events are searched for: every 0.05 degrees in a turn."""


def stated_motion(driver: Driver, scene: Scene) -> tuple[float, float, float]:
    """Position (degrees or m), speed and acceleration (rad or m) of a driver in the scene."""
    number = driver.position.number(scene.values)
    place = float(driver.position.si(scene.values))
    if driver.kind == "turn":
        place = float(number) if driver.position.unit == "deg" else degrees(place)
    return place, float(driver.speed.si(scene.values)), float(driver.acceleration.si(scene.values))


def motion_at(driver: Driver, values: dict[str, Any], at: Any) -> tuple[Any, Any, Any]:
    """Position (degrees or m), speed and acceleration of a driver at given times (N,).

    A driver without a law starts at its stated position at time zero, with its stated speed and
    constant acceleration.
    """
    law = TIME in driver.position.uses()
    here = values | ({TIME: at} if law else {})
    kind = batch_kind()
    place, speed, push = (
        quantity.si(here, kind) for quantity in (driver.position, driver.speed, driver.acceleration)
    )
    if not law:
        place, speed = place + (speed + push * at / 2) * at, speed + push * at
    if driver.kind == "turn":
        place = np.degrees(place)
    place, speed, push = (np.broadcast_to(each, np.shape(at)) for each in (place, speed, push))
    return place, speed, push


def reach_of(scene: Scene) -> float:
    """The sum of all lengths of a scene (m), which bounds the movement of every point.

    The origin does not matter, because coordinates count from the first point of a link.
    """
    lengths: list[Quantity] = []
    places: list[tuple[str, Quantity, Quantity]] = []
    for link in scene.every_link:
        for placing in link.placings:
            lengths += [length for _, _, length in lengths_of(placing)]
            places += [(link.name, placing.x, placing.y)] if isinstance(placing, At) else []
        for slide in link.slides:
            lengths.append(slide.offset)
            places += [(slide.on, *slide.through)] if isinstance(slide.through, tuple) else []
        if link.cam is not None:
            lifts = () if link.cam.lever else (piece.rise for piece in link.cam.law)
            lengths += [link.cam.base, link.cam.roller, *lifts]
        lengths += [wheel.radius for wheel in link.wheels if wheel.radius is not None]
    far = sum(abs(float(length.si(scene.values))) for length in lengths)
    first: dict[str, complex] = {}
    for name, x, y in places:
        place = complex(x.si(scene.values), y.si(scene.values))
        way = place - first.setdefault(name, place)
        far += abs(way.real) + abs(way.imag)
    return far or 1.0
