"""The content of the building field for a text, even if it is not yet a complete mechanism.

The text gives the lengths of bars but not their places. While the mechanism does not close, points
lie where the user put them; once it closes, they lie where the construction finds them.
"""

from __future__ import annotations

from cmath import rect
from collections.abc import Iterator, Mapping
from math import radians
from typing import Any

from msgspec import Struct

from graphkin.diagnosis.closures import choices
from graphkin.mechanism import Mechanism
from graphkin.scene.file_limits import tables_of
from graphkin.scene.model import FRAME, KEYWORDS, Scene
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import GraphkinError

Places = Mapping[str, complex]
"""Places of points, in the unit of the scene."""
GRIDS = {"mm": 5.0, "cm": 0.5, "m": 0.01, "in": 0.25}
"""The steps of drawn lengths, by the unit of the scene."""
NOTHING: Mapping[str, str] = {}
GHOSTS = 8
"""Number of closures offered besides the drawn one."""


class Block(Struct, frozen=True):
    """A block: its link, its point, a direction of its guide, and whether the guide is fixed."""

    link: str
    point: str
    along: tuple[float, float]
    fixed: bool = False


class DrawnWheel(Struct, frozen=True):
    """A wheel: its link, its centre, its radius, and whether it is a ring."""

    link: str
    centre: str
    radius: float
    inside: bool = False


class Ghost(Struct, frozen=True):
    """A point in another closure, and the words that choose that closure.

    ``bars`` are the links that close in this way, by the places of their points there.
    """

    point: str
    at: tuple[float, float]
    key: str
    words: str
    bars: tuple[tuple[tuple[float, float], ...], ...]


class Sketch(Struct, frozen=True):
    """Points by name, the points of each link, blocks, wheels, driven links, other closures.

    ``rate`` is the unit of the drivers' speeds.
    """

    unit: str
    rate: str
    grid: float
    points: dict[str, tuple[float, float]]
    fixed: list[str]
    links: dict[str, list[str]]
    blocks: list[Block]
    wheels: list[DrawnWheel]
    driven: list[str]
    ghosts: list[Ghost]


def sketch(
    text: str, name: str, places: Places, settings: Mapping[str, str] = NOTHING
) -> Sketch | None:
    """The sketch of a text, its free points where the user put them; None for invalid TOML."""
    try:
        tables = tables_of(text)
    except GraphkinError:
        return None
    unit = unit_of(tables)
    found = {**places, **frame_places(tables)}
    ghosts: list[Ghost] = []
    try:
        mechanism = Mechanism(as_set(text, name, settings))
        found |= solved(mechanism)
        ghosts = list(others(mechanism))
    except GraphkinError:
        pass
    links = {key: points_of(table) for key, table in links_of(tables).items()}
    fixed = points_of(table_of(tables, "frame"))
    named = dict.fromkeys([*fixed, *(point for points in links.values() for point in points)])
    rate = table_of(tables, "units").get("speed")
    return Sketch(
        unit,
        rate if isinstance(rate, str) else "rad/s",
        GRIDS[unit],
        {point: (found[point].real, found[point].imag) for point in named if point in found},
        fixed,
        links,
        [block for block in blocks_of(tables, found) if block.point in found],
        [wheel for wheel in wheels_of(tables) if wheel.centre in found],
        [str(each.get("turn")) for each in drivers_of(tables) if "turn" in each],
        ghosts[:GHOSTS],
    )


def as_set(text: str, name: str, settings: Mapping[str, str]) -> Scene:
    """The scene with the settings of its parameters, or without them if they are refused."""
    try:
        return read_text(text, name, None, settings)
    except GraphkinError:
        return read_text(text, name, None, NOTHING)


def unit_of(tables: Mapping[str, Any]) -> str:
    """The unit of lengths of a scene; millimetres where it names no known unit."""
    unit = table_of(tables, "units").get("length")
    return unit if isinstance(unit, str) and unit in GRIDS else "mm"


def table_of(tables: Mapping[str, Any], key: str) -> dict[str, Any]:
    """A table of a text; empty where it is missing."""
    found = tables.get(key)
    return found if isinstance(found, dict) else {}


def links_of(tables: Mapping[str, Any]) -> dict[str, dict[str, Any]]:
    """The tables of the moving links."""
    found = table_of(tables, "links")
    return {name: table for name, table in found.items() if isinstance(table, dict)}


def drivers_of(tables: Mapping[str, Any]) -> list[dict[str, Any]]:
    """The tables of the drivers."""
    found = tables.get("drivers")
    return [each for each in found if isinstance(each, dict)] if isinstance(found, list) else []


def points_of(table: Mapping[str, Any]) -> list[str]:
    """The points that the keys of a link name, in the order of their first mention."""
    keys = (key for key in table if key not in KEYWORDS)
    return list(dict.fromkeys(point for key in keys for point in key.split("-")))


def frame_places(tables: Mapping[str, Any]) -> dict[str, complex]:
    """The points of the frame that the text gives by two numbers."""
    return {point: complex(*at) for point, at in table_of(tables, "frame").items() if is_place(at)}


def is_place(value: object) -> bool:
    """Whether a value is a pair of numbers."""
    return isinstance(value, list) and len(value) == 2 and all(map(is_number, value))


def is_number(value: object) -> bool:
    """Whether a value is a number rather than an expression."""
    return isinstance(value, int | float) and not isinstance(value, bool)


def blocks_of(tables: Mapping[str, Any], places: Places) -> Iterator[Block]:
    """The blocks on straight guides whose direction the text gives by a number or two points."""
    for name, table in links_of(tables).items():
        slides, points = table.get("slides"), points_of(table)
        if not isinstance(slides, dict) or not points:
            continue
        angle, along = slides.get("angle"), str(slides.get("along", "")).split("-")
        if str(slides.get("on")) == FRAME and isinstance(angle, int | float):
            way = rect(1.0, radians(angle))
            yield Block(name, points[0], (way.real, way.imag), fixed=True)
        elif len(along) == 2 and all(point in places for point in along):
            way = places[along[1]] - places[along[0]]
            yield Block(name, points[0], (way.real, way.imag))


def wheels_of(tables: Mapping[str, Any]) -> Iterator[DrawnWheel]:
    """The wheels whose radius the text gives by a number, or by teeth and a module."""
    for name, table in {FRAME: table_of(tables, "frame"), **links_of(tables)}.items():
        listed = table.get("wheels")
        for each in [table.get("wheel"), *(listed if isinstance(listed, list) else [])]:
            if not isinstance(each, Mapping):
                continue
            radius: Any = each.get("radius")
            teeth: Any = each.get("teeth")
            module: Any = tables.get("module")
            if is_number(teeth) and is_number(module):
                radius = teeth * module / 2
            if is_number(radius) and isinstance(each.get("centre"), str):
                yield DrawnWheel(name, each["centre"], float(radius), each.get("inside") is True)


def solved(mechanism: Mechanism) -> dict[str, complex]:
    """The places of the points by construction. Raises GraphkinError where it does not close."""
    metre = mechanism.scene.unit_length
    found = mechanism.solve().points
    return {
        name: complex(point.position) / metre
        for name, point in found.items()
        if point.position is not None
    }


def others(mechanism: Mechanism) -> Iterator[Ghost]:
    """The closures that are not drawn, each with the branch that chooses it."""
    scene = mechanism.scene
    metre = scene.unit_length
    for choice in choices(scene, *mechanism.laid):
        key = choice.key
        for closure in choice.closures:
            if not key or closure.picked or closure.fails or closure.unfit or closure.place is None:
                continue
            at = closure.place / metre
            there = {p: (z.real / metre, z.imag / metre) for p, z in closure.points.items()}
            held = (scene.links[link].points for link in choice.links)
            bars = (tuple(there[p] for p in points if p in there) for points in held)
            drawn = tuple(bar for bar in bars if len(bar) > 1)
            yield Ghost(choice.pin, (at.real, at.imag), key, closure.words, drawn)
