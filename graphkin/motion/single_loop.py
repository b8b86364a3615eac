"""A single loop: the path of the driven pin against the ring or band that the rest can reach.

The pin of the crank moves on a circle. The two links of the dyad reach a ring about the other fixed
pivot, between the difference and the sum of their lengths. A rod with a sliding end reaches a band
along the guide, as wide as the rod on either side. The mechanism closes where the pin is within the
ring or band.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

import numpy as np
from msgspec import Struct

from graphkin.motion.cycle import Cycle
from graphkin.numbers.plane import Line, cross
from graphkin.scene.model import FRAME, Scene
from graphkin.structure.groups import Crank, Dyad
from graphkin.structure.pairs import Pin, Sliding

EQUAL = 1e-9
"""Share of the total length within which two lengths count as equal."""

Kind = Literal["four-bar", "slider-crank", "slider-driven"]


class Ring(Struct, frozen=True):
    """All points between two circles about a centre (m)."""

    centre: complex
    inner: float
    outer: float


class Band(Struct, frozen=True):
    """All points within a distance of a line (m)."""

    line: Line
    half: float


class Loop(Struct, frozen=True):
    """A driven pin, its path, and the reach of the rest of its loop.

    ``pins`` are the driver's pivot (empty for a slider), the driven pin, the inner pin and the
    other fixed pivot (empty for a guide). ``lengths`` (m) are by name. ``turns`` means that the
    driven pin's whole path is within reach, ``more`` that further groups depend on the loop.
    """

    kind: Kind
    pins: tuple[str, str, str, str]
    lengths: Mapping[str, float]
    path: Ring | Line
    reach: Ring | Band
    turns: bool
    more: bool


def loop_of(cycle: Cycle) -> Loop | None:
    """The loop of a single driver and a dyad RRR or RRP on the frame; None for others."""
    course = cycle.path.ranges[0][0].course
    drivers = cycle.scene.drivers
    if len(drivers) != 1 or drivers[0].against != FRAME or not len(cycle.at):
        return None
    driver = drivers[0]
    crank = next((group for group in course.groups if isinstance(group, Crank)), None)
    more = len(course.groups) > 2
    for dyad in course.groups:
        found = ends_of(cycle.scene, dyad, driver.link)
        if found is None:
            continue
        pin, inner, right = found
        if driver.kind == "slide" and isinstance(right, Pin):
            return slider_driven(cycle, pin, inner, right.point, more)
        if driver.kind == "turn" and crank is not None and isinstance(right, Pin):
            return four_bar(cycle, (crank.pivot, pin, inner, right.point), more)
        if driver.kind == "turn" and crank is not None and isinstance(right, Sliding):
            return slider_crank(cycle, (crank.pivot, pin, inner), more)
    return None


def ends_of(scene: Scene, dyad: object, driver: str) -> tuple[str, str, Pin | Sliding] | None:
    """The driven pin, the inner pin and the pair on the frame of a dyad that closes a loop."""
    if not isinstance(dyad, Dyad) or not isinstance(dyad.inner, Pin):
        return None
    fixed = scene.fixed_points
    for left, right in ((dyad.left, dyad.right), (dyad.right, dyad.left)):
        if not isinstance(left, Pin) or left.point in fixed:
            continue
        if left.point not in scene.links[driver].points:
            continue
        if isinstance(right, Pin) and right.point in fixed:
            return left.point, dyad.inner.point, right
        if isinstance(right, Sliding) and right.slide.on == FRAME:
            return left.point, dyad.inner.point, right
    return None


def place(cycle: Cycle, point: str) -> np.ndarray:
    """The positions of a point in all rows."""
    return np.asarray(cycle.solution.points[point].position)


def apart(cycle: Cycle, p: str, q: str) -> float:
    """Distance of two points of one link (m)."""
    return float(abs(place(cycle, q)[0] - place(cycle, p)[0]))


def four_bar(cycle: Cycle, pins: tuple[str, str, str, str], more: bool) -> Loop:
    """The four-bar: the crank pin's circle about its pivot, the ring of coupler and rocker."""
    o, a, b, c = pins
    crank, coupler, rocker, base = (apart(cycle, p, q) for p, q in ((o, a), (a, b), (c, b), (o, c)))
    least, most = abs(coupler - rocker), coupler + rocker
    slack = EQUAL * (crank + coupler + rocker + base)
    turns = least <= abs(base - crank) + slack and base + crank <= most + slack
    return Loop(
        "four-bar",
        pins,
        {"crank": crank, "coupler": coupler, "rocker": rocker, "frame": base},
        Ring(complex(place(cycle, o)[0]), crank, crank),
        Ring(complex(place(cycle, c)[0]), least, most),
        turns,
        more,
    )


def slider_crank(cycle: Cycle, pins: tuple[str, str, str], more: bool) -> Loop | None:
    """The slider-crank: the crank pin's circle, and the band of the rod along the guide."""
    o, a, b = pins
    guide = path_line(cycle, b)
    if guide is None:
        return None
    crank, rod = apart(cycle, o, a), apart(cycle, a, b)
    pivot = complex(place(cycle, o)[0])
    offset = abs(cross(guide.along, pivot - guide.point))
    turns = crank + offset <= rod + EQUAL * (crank + rod + offset)
    return Loop(
        "slider-crank",
        (o, a, b, ""),
        {"crank": crank, "rod": rod, "offset": offset},
        Ring(pivot, crank, crank),
        Band(guide, rod),
        turns,
        more,
    )


def slider_driven(cycle: Cycle, pin: str, inner: str, pivot: str, more: bool) -> Loop | None:
    """The driven slider: the line of the block, and the ring of rod and crank."""
    guide = path_line(cycle, pin)
    if guide is None:
        return None
    rod, crank = apart(cycle, pin, inner), apart(cycle, pivot, inner)
    centre = complex(place(cycle, pivot)[0])
    offset = abs(cross(guide.along, centre - guide.point))
    return Loop(
        "slider-driven",
        ("", pin, inner, pivot),
        {"crank": crank, "rod": rod, "offset": offset},
        guide,
        Ring(centre, abs(rod - crank), rod + crank),
        False,
        more,
    )


def path_line(cycle: Cycle, point: str) -> Line | None:
    """The line on which a point moves, through its two positions that are farthest apart."""
    places = place(cycle, point)
    far = places[np.abs(places - places[0]).argmax()]
    if far == places[0]:
        return None
    along = complex(far - places[0])
    return Line(complex(places[0]), along / abs(along))


def class_of(loop: Loop) -> str:
    """Grashof's verdict on a four-bar by its lengths, in the field's words."""
    a, b, c, g = (loop.lengths[key] for key in ("crank", "coupler", "rocker", "frame"))
    ordered = sorted((a, b, c, g))
    excess = ordered[0] + ordered[3] - ordered[1] - ordered[2]
    if abs(excess) <= EQUAL * sum(ordered):
        return "change-point " + equal_pairs(a, b, c, g)
    if excess > 0:
        return "triple rocker"
    names = ((g, "double crank"), (a, "crank-rocker"), (c, "rocker-crank"), (b, "double rocker"))
    return min(names)[1]


def equal_pairs(a: float, b: float, c: float, g: float) -> str:
    """The kind of a change-point four-bar: a parallelogram, a kite, or neither."""
    slack = EQUAL * (a + b + c + g)
    if abs(a - c) <= slack and abs(b - g) <= slack:
        return "parallelogram"
    if (abs(a - g) <= slack and abs(b - c) <= slack) or (
        abs(a - b) <= slack and abs(c - g) <= slack
    ):
        return "kite"
    return "four-bar"
