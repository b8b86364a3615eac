"""Words for dead points and change points: what becomes impossible there, and what is in line."""

from __future__ import annotations

from typing import Literal

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.crossings import Determined
from graphkin.construction.core.program import Program
from graphkin.motion.course import Course
from graphkin.motion.ends import Event
from graphkin.motion.pieces import ALIKE, Path
from graphkin.numbers.plane import Line

FLAT = 0.02
"""Sine of a crossing that counts as flat near a dead point."""
INSIDE = 1e-7
"""Distance before a dead point at which its loci are examined, as a share of the piece."""


class Singular(Struct, frozen=True):
    """A dead point (the driver can go no further) or a change point (the closure may change).

    ``at`` is u. ``pin`` is the point that does not exist beyond. ``lines`` names the lines that are
    in line or parallel there.
    """

    kind: Literal["dead", "change"]
    at: float
    pin: str
    lines: str


def singulars(path: Path) -> tuple[Singular, ...]:
    """Every dead and change point of all ranges, in order, without duplicates."""
    found: list[Singular] = []
    for pieces in path.ranges:
        for piece in pieces:
            found += [named(piece.course, *end) for end in ends(piece.low, piece.high)]
    known: dict[tuple[str, float], Singular] = {}
    for each in found:
        at = once_round(path, each.at)
        known.setdefault((each.kind, round(at, 8)), replace(each, at=at))
    return tuple(sorted(known.values(), key=lambda each: each.at))


def once_round(path: Path, at: float) -> float:
    """A position of a driver that turns fully, counted from 0 to the end of its circle."""
    if not path.whole or not path.turns:
        return at
    at %= path.period
    return 0.0 if path.period - at < ALIKE else at


def ends(low: Event, high: Event) -> list[tuple[Event, float]]:
    """The singular ends of a piece, each with a position inside the piece."""
    way = high.at - low.at
    pairs = [(low, low.at + INSIDE * way), (high, high.at - INSIDE * way)]
    return [(event, inside) for event, inside in pairs if event.kind in ("dead", "change")]


def named(course: Course, event: Event, inside: float) -> Singular:
    """The dead or change point of an event, with its words."""
    kind: Literal["dead", "change"] = "dead" if event.kind == "dead" else "change"
    if not event.steps:
        return Singular(kind, event.at, *flattest(course, inside))
    both = [words(course, number, inside) for number in event.steps]
    pins = dict.fromkeys(pin for pin, _ in both)
    lines = dict.fromkeys(line for _, line in both)
    return Singular(kind, event.at, ", ".join(pins), "; ".join(lines))


def flattest(course: Course, inside: float) -> tuple[str, str]:
    """The flattest crossing, for a followed group of higher class that closes no further."""
    sines = course.margins(np.array([inside]))[:, 0]  # the last row, of no crossing, is 1
    if np.nanmin(sines, initial=1.0) < FLAT:
        return words(course, course.crossings[int(np.nanargmin(sines))], inside)
    ways = zip(course.numbered, course.closures, strict=False)
    ended = {name: abs(way.at[[0, -1]] - inside).min() for name, way in ways}
    link = f" of link {min(ended, key=lambda name: ended[name])}" if ended else ""
    return f"the group{link}", f"two closures of the group{link} meet"


def words(course: Course, number: int, inside: float) -> tuple[str, str]:
    """The pin that a step finds, and the lines in line, perpendicular or parallel there."""
    program = course.program
    step = program.steps[number]
    loci = course.loci(number, inside)
    kind = step.of if isinstance(step.of, Determined) else None
    if kind is not None and (found := kind.at_end(program.steps, loci)) is not None:
        return found
    pin = step.name or of_later(program, number)
    match loci:
        case (Line(), Line()):
            return pin, f"the two lines through {pin} parallel"
    return pin, f"the loci of {pin} touch"


def of_later(program: Program, number: int) -> str:
    """The name of the first later step that uses a step and has a name."""
    reached = {number}
    for later in range(number + 1, len(program.steps)):
        step = program.steps[later]
        if reached.intersection(step.args):
            if step.name:
                return step.name
            reached.add(later)
    return "a point"
