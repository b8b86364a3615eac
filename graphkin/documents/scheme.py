"""The kinematic scheme of a task: links, letters and drivers' coordinates, not to scale.

The mechanism is in another position than the student's, so that nothing can be traced.
"""

from __future__ import annotations

from cmath import phase
from collections.abc import Iterator
from itertools import combinations
from math import degrees, radians
from typing import Any

from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import NOISE, Drawing
from graphkin.construction.core.layout import centre
from graphkin.construction.core.program import Part
from graphkin.construction.core.run import StepFailed, run
from graphkin.construction.drivers.driver_symbols import draw_drivers, drawn_angle
from graphkin.construction.guides.slide_symbols import within
from graphkin.construction.links.mechanism_symbols import (
    draw_bars,
    draw_ground,
    draw_pins,
    draw_plates,
)
from graphkin.drawing.field import XY, Field
from graphkin.drawing.labels import FieldContent, Label, segment_of
from graphkin.drawing.marks import Mark, Text, reach, scaled
from graphkin.numbers.arithmetic import FLOAT
from graphkin.scene.model import Link
from graphkin.text.errors import PageError

SCHEMATIC = "scheme"
"""The class that separates marks of the scheme from those drawn to scale."""
AROUND = 12.0, 14.0
"""Width and height beside the mechanism in its scheme for symbols and letters, in mm.

Larger schemes have room for letters inside: of 240 sheets, 11 % of the leaders of tasks crossed a
strong line with 16 and 21 mm, 8 % with these.
"""
SMALLER = 0.7
"""Size of symbols relative to those of a sheet, so that they hide little of the small mechanism."""
TURNS = tuple(
    sign * turn for turn in (35.0, 25.0, 15.0, 50.0, 70.0, 90.0, 115.0, 150.0) for sign in (1, -1)
)
"""Angles in degrees by which drivers are turned from the student's position, in the order tried."""
WAY = 1 / 200
"""Displacement of a sliding driver for one degree, in breadths of the mechanism."""
CLEAR, CROSSING = 0.07, 0.25
"""Least legible distance of pins, in breadths of the mechanism, and least sine of a crossing."""
APART, OPEN = 15.0, 20.0
"""Least legible angles in degrees: between overlapping links, and of a crank from its axis."""
COMMON = 0.25
"""Least part of the shorter of two bars along which they count as overlapping."""


def scheme(drawing: Drawing) -> list[Mark]:
    """The scheme with its title; without link numbers, or empty, where letters find no room."""
    moved = elsewhere(drawing)
    left, top = drawing.paper.scheme[:2]
    title = Text(left, top - 2.0, drawing.words("task.scheme"), "caption", 2.5, name="scheme")
    for numbered in (True, False):
        board = drawn(moved, numbered=numbered)
        try:
            return [
                title,
                *(replace(mark, cls=f"{mark.cls} {SCHEMATIC}") for mark in board.finish()),
            ]
        except PageError:
            continue
    return []


def drawn(drawing: Drawing, *, numbered: bool) -> FieldContent:
    """The mechanism with its symbols in the middle of the scheme's field."""
    box = drawing.mechanism_extent()
    own = drawing.paper.scheme
    size = own[2] - own[0] - AROUND[0], own[3] - own[1] - AROUND[1]
    sides = [room / side for room, side in zip(size, (box.width, box.height), strict=True) if side]
    field = Field(own, min(sides, default=1.0), box.middle, centre(own))
    solid = [reach(m) for m in symbols(drawing, field).marks if m.cls != "centre-line"]
    lefts, tops, rights, lows = zip(*solid, strict=True)
    shift = [
        middle - (low + high) / 2
        for middle, low, high in zip(
            field.at, (min(lefts), min(tops)), (max(rights), max(lows)), strict=True
        )
    ]
    board = symbols(drawing, replace(field, at=(field.at[0] + shift[0], field.at[1] + shift[1])))
    board.marks = [*within(board.marks, own)]
    if not numbered:
        board.labels = [label for label in board.labels if not label.ring]
    return board


def symbols(drawing: Drawing, field: Field) -> FieldContent:
    """The symbols of links, guides, pins and drivers, with their labels."""
    left, top, right, low = (side / SMALLER for side in field.rect)
    at = field.at[0] / SMALLER, field.at[1] / SMALLER
    board = full_size(drawing, Field((left, top, right, low), field.mm / SMALLER, field.middle, at))
    board.rect = field.rect
    board.marks = [scaled(mark, SMALLER) for mark in board.marks]
    board.labels = [smaller(label) for label in board.labels]
    sides = [[SMALLER * side for side in box] for box in board.taken]
    board.taken = [(a, b, c, d) for a, b, c, d in sides]
    return board


def smaller(label: Label) -> Label:
    """A label of unchanged height, moved to its object in the smaller drawing."""
    ends = segment_of(label)
    if ends is None:
        x, y = label.point
        at: XY | tuple[XY, XY] = SMALLER * x, SMALLER * y
    else:
        (x0, y0), (x1, y1) = ends
        at = (SMALLER * x0, SMALLER * y0), (SMALLER * x1, SMALLER * y1)
    return replace(label, subject=at, radius=SMALLER * label.radius)


def full_size(drawing: Drawing, field: Field) -> FieldContent:
    """The same symbols as large as on a sheet."""
    board = FieldContent(field.rect)
    draw_plates(board, drawing, field)
    draw_ground(board, drawing, field)
    draw_bars(board, drawing, field)
    draw_drivers(board, drawing, field, defined=True)
    draw_pins(board, drawing, field)
    return board


def elsewhere(drawing: Drawing) -> Drawing:
    """The mechanism in another position: the first legible one.

    Otherwise the position with the largest clearance that closes, otherwise the student's own.
    """
    own = replace(drawing, curves=())
    best, widest = own, 0.0
    for turn in TURNS:
        moved = moved_by(own, turn)
        if moved is None:
            continue
        clear = clearance(moved)
        if clear >= 1:
            return moved
        if clear > widest:
            best, widest = moved, clear
    return best


def clearance(drawing: Drawing) -> float:
    """The legibility of a position, 1 or more where it is fully legible.

    It is legible where all pins are apart, no two loci cross flatly, no link lies on another, and
    each crank's angle is open.
    """
    places = [*drawing.positions.values()]
    near = min((abs(p - q) for p, q in combinations(places, 2) if p != q), default=drawing.reach)
    sine = min(drawing.trace.margins.values(), default=1.0)
    cranks = [driver for driver in drawing.scene.drivers if driver.kind == "turn"]
    angles = (float(drawn_angle(drawing, driver)) for driver in cranks)
    opened = min((abs((angle + 180) % 360 - 180) for angle in angles), default=OPEN)
    return min(
        near / (CLEAR * drawing.reach),
        float(sine) / CROSSING,
        opened / OPEN,
        between_links(drawing) / APART,
    )


def between_links(drawing: Drawing) -> float:
    """The least angle between overlapping links drawn as bars, in degrees; 90 if there are none."""
    bars = [bar for link in drawing.scene.links.values() if (bar := bar_of(drawing, link))]
    return min(
        (
            angle
            for one, other in combinations(bars, 2)
            if (angle := angle_between(one, other)) < APART
            and lie_on_one_another(one, other, CLEAR * drawing.reach)
        ),
        default=90.0,
    )


def bar_of(drawing: Drawing, link: Link) -> tuple[complex, complex] | None:
    """The ends of the bar that a link is drawn as; None for a plate, a block or a wheel."""
    places = [drawing.positions[p] for p in link.points if p in drawing.positions]
    pairs = list(combinations(places, 2))
    ends = max(pairs, key=lambda pair: abs(pair[1] - pair[0]), default=None)
    if ends is None or ends[0] == ends[1]:
        return None
    beside = (abs(((place - ends[0]) / (ends[1] - ends[0])).imag) for place in places)
    return ends if max(beside) < NOISE else None


def angle_between(one: tuple[complex, complex], other: tuple[complex, complex]) -> float:
    """The angle between two lines in degrees, 90 at most."""
    turned = degrees(phase((one[1] - one[0]) / (other[1] - other[0]))) % 180
    return min(turned, 180 - turned)


def lie_on_one_another(
    one: tuple[complex, complex], other: tuple[complex, complex], near: float
) -> bool:
    """Whether nearly parallel bars overlap within ``near`` along much of the shorter one."""
    shorter, longer = sorted((one, other), key=lambda ends: abs(ends[1] - ends[0]))
    along = (longer[1] - longer[0]) / abs(longer[1] - longer[0])
    ends = [(end - longer[0]) / along for end in shorter]
    low, high = sorted(end.real for end in ends)
    common = min(high, abs(longer[1] - longer[0])) - max(low, 0.0)
    return common > COMMON * (high - low) and min(abs(end.imag) for end in ends) < near


def moved_by(drawing: Drawing, turn: float) -> Drawing | None:
    """The positions with every driver moved by some degrees, or a matching part of the breadth.

    None where the mechanism does not close there.
    """
    program = drawing.trace.program
    placed = [n for n in drawing.trace.values if program.steps[n].part is Part.POSITION]
    needed = program.behind(n for n in placed if not program.steps[n].hand)
    driven, overrides = dict(moved_drivers(drawing, turn)), dict(moved_steps(drawing, turn))
    try:
        trace = run(program, needed, drawing.scene.values, FLOAT, overrides=overrides)
    except StepFailed:
        return None
    return replace(drawing, trace=trace, driven=driven)


def moved_drivers(drawing: Drawing, turn: float) -> Iterator[tuple[str, float]]:
    """The angles of the drivers that turn, in degrees."""
    for driver in drawing.scene.drivers:
        if driver.kind == "turn":
            yield driver.link, degrees(float(driver.position.si(drawing.scene.values))) + turn


def moved_steps(drawing: Drawing, turn: float) -> Iterator[tuple[int, Any]]:
    """The values of the steps that hold the drivers' positions."""
    values = drawing.scene.values
    for driver, drive in zip(drawing.scene.drivers, drawing.trace.program.drives, strict=True):
        place = float(driver.position.si(values))
        if driver.kind != "turn":
            yield drive.position, place + WAY * turn * drawing.reach
            continue
        yield drive.position, FLOAT.direction(degrees(place) + turn)
        if drive.angle is not None:
            yield drive.angle, place + radians(turn)
