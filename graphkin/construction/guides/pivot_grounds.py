"""The side of each fixed pivot's pin on which its ground is drawn: the side with most room."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations
from math import hypot, sqrt

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.guides.rails import BEYOND, REACH, places_of, rails_of, swivelling
from graphkin.drawing.symbols import BLOCK, HATCH, HIP, PIN, PIVOT, STRIP, TALL
from graphkin.numbers.plane import cross, dot
from graphkin.scene.model import FRAME

Segment = tuple[complex, complex]
Ground = tuple[complex, float]
"""The unit vector from a fixed pivot to its ground, and the height of its triangle in mm."""

HALFWAY = sqrt(0.5)
WAYS = {
    -1j: 0.0,
    1 + 0j: 0.4,
    -1 + 0j: 0.4,
    1j: 0.8,
    HALFWAY * (1 - 1j): 1.2,
    HALFWAY * (-1 - 1j): 1.2,
    HALFWAY * (1 + 1j): 1.6,
    HALFWAY * (-1 + 1j): 1.6,
}
"""The directions of a ground from its pin, and the cost of each, in mm of clearance."""
AIR = 2.5
"""Required clearance of a ground from the marks at its pin, in mm."""
RAIL = BLOCK[1] / 2 + HATCH
"""Half the width of a guide of the frame, in mm."""
RAY = 17.0
"""Drawn length, from its pin, of the axis from which a crank's angle is measured, in mm."""
NEAR = hypot(TALL + HATCH / 2, STRIP + HIP * (TALL - PIVOT)) + AIR
"""Distance from its pin within which a mark may collide with the ground, in mm."""
RAISED = 1.0
"""Cost of a tall ground, in mm of clearance: a bar past the pin would cross its triangle."""


def ground_ways(drawing: Drawing, mm: float) -> dict[str, complex]:
    """The direction from each fixed pivot to its ground."""
    return {name: way for name, (way, _) in grounds_of(drawing, mm).items()}


def grounds_of(drawing: Drawing, mm: float) -> dict[str, Ground]:
    """The ground of each fixed pivot, kept while the mechanism moves.

    ``mm`` is the millimetres of paper for a metre.
    """
    still = drawing.choosing
    if mm not in still.grounds:
        still.grounds[mm] = chosen(still, mm)
    return still.grounds[mm]


def chosen(drawing: Drawing, mm: float) -> dict[str, Ground]:
    """The ground of each pivot with most room; down and low among equals."""
    drawn, found = [*segments(drawing, mm)], {}
    for name, here in pivots(drawing).items():
        lines = (((p - here) * mm, (q - here) * mm) for p, q in drawn)
        near = [line for line in lines if away_from(0j, line) < NEAR]
        heights = {TALL: 0.0} if is_covered(drawing, here, mm) else {PIVOT: 0.0, TALL: RAISED}
        costs = {
            (way, height): cost + raised + crowding(near, way, height)
            for height, raised in heights.items()
            for way, cost in WAYS.items()
        }
        found[name] = min(costs, key=costs.__getitem__)
    return found


def pivots(drawing: Drawing) -> dict[str, complex]:
    """The points of the frame that moving links share."""
    moving = {point for link in drawing.scene.links.values() for point in link.points}
    return {
        name: drawing.positions[name]
        for name in drawing.scene.fixed_points
        if name in moving and name in drawing.positions
    }


def is_covered(drawing: Drawing, here: complex, mm: float) -> bool:
    """Whether a block turns about a pivot's pin, judged at the position where places are chosen."""
    return any(abs(place - here) * mm < PIN for place in swivelling(drawing.choosing))


def segments(drawing: Drawing, mm: float) -> Iterator[Segment]:
    """The bars, sides of plates, guides, and axes from which crank angles are measured."""
    for link in drawing.scene.links:
        yield from combinations(places_of(drawing, link), 2)
    for rail in rails_of(drawing):
        if rail.owner == FRAME:
            for mark in rail.marks:
                low, high = (rail.at(mark + side * REACH / mm) for side in (-1, 1))
                for aside in (-RAIL, 0.0, RAIL):
                    yield low + 1j * rail.along * aside / mm, high + 1j * rail.along * aside / mm
        else:
            ends = [mark + side * BEYOND / mm for mark in rail.marks for side in (-1, 1)]
            ends += [rail.along_of(place) for place in places_of(drawing, rail.owner)]
            yield rail.at(min(ends)), rail.at(max(ends))
    for driver in drawing.scene.drivers:
        start = (driver.of or drawing.scene.links[driver.link].points)[0]
        base = drawing.standing.axis(driver.against)
        if driver.kind == "turn" and base is not None and start in drawing.positions:
            yield drawing.positions[start], drawing.positions[start] + base * RAY / mm


def crowding(near: Sequence[Segment], way: complex, height: float) -> float:
    """The clearance that a ground lacks from lines near its pin, in mm."""
    middle, half = way * (height + HATCH / 2), 1j * way * (STRIP + HIP * (height - PIVOT))
    ground = middle - half, middle + half
    return sum(max(0.0, AIR - apart(ground, line)) for line in near)


def apart(one: Segment, other: Segment) -> float:
    """The distance between two segments; less than zero where they cross."""
    (a, b), (c, d) = one, other
    sides = cross(b - a, c - a) * cross(b - a, d - a), cross(d - c, a - c) * cross(d - c, b - c)
    if max(sides) < 0:
        return -AIR
    return min(
        *(away_from(place, one) for place in other),
        *(away_from(place, other) for place in one),
    )


def away_from(place: complex, line: Segment) -> float:
    """The distance of a place from a segment."""
    start, along = line[0] - place, line[1] - line[0]
    square = abs(along) ** 2
    share = min(max(-dot(start, along) / square, 0.0), 1.0) if square else 0.0
    return abs(start + share * along)
