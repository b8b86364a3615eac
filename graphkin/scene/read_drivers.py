"""Motions that are given: which link is driven in which way, how far, how fast."""

from __future__ import annotations

from typing import get_args

from graphkin.scene.expression import TIME
from graphkin.scene.findings import Table, nearest, shown
from graphkin.scene.measures import Measures
from graphkin.scene.model import FRAME, Driver, DriverKind
from graphkin.scene.phrases import line_words, link_name
from graphkin.scene.quantity import Quantity, exact
from graphkin.text.errors import SceneError

MOST = 50
DERIVED = "speed and acceleration are the derivatives of a law, which must be finite at its time"
KINDS: tuple[DriverKind, ...] = get_args(DriverKind)


def read_drivers(top: Table, measures: Measures) -> tuple[Driver, ...]:
    """The drivers of a scene, from ``[[drivers]]``."""
    raw = top.take("drivers")
    if raw is None or raw == []:
        measures.findings.add("drivers", "no driver", "[[drivers]] with turn = LINK, angle, speed")
        return ()
    if not isinstance(raw, list) or len(raw) > MOST:
        measures.findings.add(
            "drivers", shown(raw), f"[[drivers]] in double brackets, at most {MOST}"
        )
        return ()
    drivers = []
    for index, each in enumerate(raw):
        place = f"drivers[{index}]"
        if isinstance(each, dict):
            driver = read_driver(Table(place, each, measures.findings), measures)
            drivers += [driver] if driver else []
        else:
            measures.findings.add(place, shown(each), "a table with turn, angle and speed")
    return tuple(drivers)


def read_driver(table: Table, measures: Measures) -> Driver | None:
    """One driver; None, with a problem noted, when what it drives is not clear."""
    kinds = [kind for kind in KINDS if kind in table]
    if len(kinds) != 1:
        found = " and ".join(kinds) or "nothing driven"
        expected = "one of " + ", ".join(f"{kind} = LINK" for kind in KINDS)
        hints = [hint for key in table.raw if (hint := nearest(key, KINDS))]
        measures.findings.add(table.place, found, expected, "" if kinds or not hints else hints[0])
        return None
    kind = kinds[0]
    link = link_name(table.at(kind), table.take(kind), measures.findings)
    against = read_against(table, measures)
    raw = table.take("of") if kind == "turn" else None
    of = None if raw is None else line_words(table.at("of"), raw, measures.findings)
    position, speed, acceleration = read_motion(table, kind, measures)
    table.finish()
    return Driver(kind, link, against, position, speed, acceleration, of) if link else None


def read_against(table: Table, measures: Measures) -> str:
    """The link that a motion is measured against, the frame where none is written."""
    raw = table.take("against")
    if raw is None:
        return FRAME
    return link_name(table.at("against"), raw, measures.findings) or FRAME


def read_motion(
    table: Table, kind: DriverKind, measures: Measures
) -> tuple[Quantity, Quantity, Quantity]:
    """Position, speed and acceleration: three numbers, or one law in ``t`` and its derivatives."""
    key, unit = ("angle", measures.units["angle"])
    speed, acceleration = measures.units["speed"], "rad/s²"
    if kind != "turn":
        key, unit = "position", measures.units["length"]
        speed, acceleration = f"{unit}/s", f"{unit}/s²"
    position = read_position(table, key, unit, measures)
    if TIME in position.uses():
        return derivatives(table, position, measures)
    raw = table.take("speed")
    if raw is None and not measures.findings.inside(position.place):
        measures.findings.add(table.place, "no speed", f"speed = … in {speed}, 0 if it stands")
    rate = measures.number(table.at("speed"), 0 if raw is None else raw, speed)
    raw = table.take("acceleration")
    return (
        position,
        rate,
        measures.number(table.at("acceleration"), 0 if raw is None else raw, acceleration),
    )


def read_position(table: Table, key: str, unit: str, measures: Measures) -> Quantity:
    """The angle of a turning driver, or the coordinate along a guide or a track."""
    raw = table.take(key)
    other = "position" if key == "angle" else "angle"
    if raw is None and other in table:
        table.take(other)
        measures.findings.add(
            table.at(other), f"this driver has no {other}", f"{key} = … in {unit}"
        )
    elif raw is None:
        measures.findings.add(table.place, f"no {key}", f"{key} = … in {unit}")
    return measures.number(table.at(key), 0 if raw is None else raw, unit, law=True)


def derivatives(
    table: Table, position: Quantity, measures: Measures
) -> tuple[Quantity, Quantity, Quantity]:
    """A law of time with its first and second derivative."""
    for key in ("speed", "acceleration"):
        if table.take(key) is not None:
            found = f"{key} beside a law of time"
            measures.findings.add(table.at(key), found, "none: it is the derivative of the law")
    try:
        speed = position.derivative(TIME)
        acceleration = speed.derivative(TIME)
    except SceneError as error:
        measures.findings.extend(error.problems)
        return position, exact(0), exact(0)
    if measures.exists(speed, hint=DERIVED):
        measures.exists(acceleration, hint=DERIVED)
    return position, speed, acceleration
