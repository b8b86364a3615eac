"""A drawing of points and bars, which does not say what is fixed: as a mechanism to be completed.

Whoever imports a drawing names its fixed points, the points that slide, and the driven bar.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from itertools import combinations, islice
from math import radians

from msgspec import Struct

from graphkin.importing.record import (
    MOST,
    DrawnGuide,
    DrawnInput,
    DrawnJoint,
    DrawnLink,
    Imported,
    few,
    named,
    number,
    refused,
)
from graphkin.text.errors import Message, joined, message

USUAL = "mm"
SPEED = 60.0
"""Revolutions per minute of the driven bar."""
MOST_NAMED = 40
"""Points in one message."""
NEAR = 1e-6
"""The distance between two points that are one, in parts of the drawing."""


class Completion(Struct, frozen=True):
    """What a drawing does not say: names of fixed points, and of two points of the driven bar.

    ``slides`` gives each sliding point the direction of its fixed guide, in degrees. ``unit`` is
    empty where the drawing's own counts.
    """

    fixed: tuple[str, ...] = ()
    drive: tuple[str, ...] = ()
    slides: Mapping[str, str] = {}
    unit: str = ""


class BarFigure(Struct, frozen=True):
    """Points by name, and bars or plates by the names of their points. ``unit`` may be empty."""

    program: str
    points: Mapping[str, complex]
    bars: tuple[tuple[str, ...], ...]
    unit: str = ""
    notes: tuple[Message, ...] = ()


def traced(figure: BarFigure, tracing: Completion) -> Imported:
    """The mechanism of a drawing. Raises SceneError for nothing fixed or unknown names."""
    bars = [*reached(with_points_between(figure), tracing.fixed)]
    used = [point for point in figure.points if any(point in bar for bar in bars)]
    if not used:
        raise refused(message("the drawing has no bar"), message("segments, lines or polygons"))
    expected = message("--fixed with some of {points}", points=placed(figure, used))
    if not tracing.fixed:
        raise refused(message("a drawing does not say which points are fixed"), expected)
    for name in (*tracing.fixed, *tracing.drive, *tracing.slides):
        if name not in used:
            raise refused(message("no bar has a point {name}", name=named(name)), expected)
    if not {*tracing.fixed}.isdisjoint(tracing.slides):
        raise refused(message("a point cannot both be fixed and slide"))
    few(len(used))
    few(len(bars))
    still = {*tracing.fixed, *tracing.slides}
    links = plates(bar for bar in bars if not bar <= still)
    joints = {
        point: DrawnJoint(point, figure.points[point], point in tracing.fixed) for point in used
    }
    bodies = {f"bar {number}": DrawnLink("-".join(link), link) for number, link in enumerate(links)}
    guides = []
    for point, angle in tracing.slides.items():
        block = f"block {point}"
        bodies[block] = DrawnLink(block, (point,))
        guides.append(DrawnGuide(block, point, angle=radians(number(angle))))
    inputs = (*driven(links, tracing),)
    unit = tracing.unit or figure.unit or USUAL
    notes = list(figure.notes)
    if not (tracing.unit or figure.unit):
        notes.append(message("lengths have no unit in the file; mm are written"))
    loose = [named(point) for point in figure.points if point not in used]
    if loose:
        points = ", ".join([*loose[:MOST_NAMED], *(["…"] if len(loose) > MOST_NAMED else [])])
        notes.append(message("not connected, and left out: points {points}", points=points))
    if inputs:
        notes.append(message("the driven bar turns at {speed:g} rev/min", speed=SPEED))
    extent = max(abs(place) for place in figure.points.values()) or 1.0
    return Imported(
        figure.program, unit, NEAR * extent, joints, bodies, tuple(guides), inputs, tuple(notes)
    )


def placed(figure: BarFigure, points: Iterable[str]) -> Message:
    """The names of points with their places."""
    each = (
        message(
            "{name} ({x:.6g}, {y:.6g})",
            name=named(point),
            x=figure.points[point].real,
            y=figure.points[point].imag,
        )
        for point in points
    )
    return joined(", ", [*islice(each, MOST_NAMED)])


def driven(links: Iterable[tuple[str, ...]], tracing: Completion) -> Iterator[DrawnInput]:
    """The input of the bar with the two named points, about its fixed one."""
    if not tracing.drive:
        return
    owns = (own for own, link in enumerate(links) if {*tracing.drive} <= {*link})
    own = next(owns, None)
    about = next((point for point in tracing.drive if point in tracing.fixed), None)
    if own is None or about is None:
        raise refused(
            message("{points} is no bar with a fixed end", points="-".join(tracing.drive)),
            message("--drive with the two ends of a bar, one of them fixed"),
        )
    yield DrawnInput(f"bar {own}", SPEED, about)


def reached(bars: Iterable[frozenset[str]], fixed: tuple[str, ...]) -> list[frozenset[str]]:
    """The bars that hang together with fixed points; all where nothing is fixed."""
    found, rest, held = list[frozenset[str]](), [*bars], {*fixed}
    if not fixed:
        return rest
    while joining := [bar for bar in rest if bar & held]:
        found += joining
        rest = [bar for bar in rest if not bar & held]
        held.update(*joining)
    return found


def with_points_between(figure: BarFigure) -> Iterator[frozenset[str]]:
    """The points of each bar, with those drawn on it between its ends."""
    import numpy as np

    names = [*figure.points]
    places = np.array([*figure.points.values()], complex)
    near = NEAR * max(np.abs(places), default=1.0)
    for bar in figure.bars:
        if len(bar) == 2 and figure.points[bar[0]] != figure.points[bar[1]]:
            one, other = (figure.points[end] for end in bar)
            along = (places - one) / (other - one)
            on = np.abs(along.imag) * abs(other - one) < near
            (between,) = np.nonzero(on & (along.real > 0) & (along.real < 1))
            yield frozenset([*bar, *(names[own] for own in between)])
        else:
            yield frozenset(bar)


def plates(bars: Iterable[frozenset[str]]) -> list[tuple[str, ...]]:
    """Bars joined to plates: two with two points in common are one, and three of a triangle too."""
    found = [*dict.fromkeys(bar for bar in bars if len(bar) > 1)]
    for _ in range(MOST):
        pair = next((p for p in combinations(found, 2) if len(p[0] & p[1]) > 1), None)
        group = pair or next(triangles(found), None)
        if group is None:
            break
        whole = frozenset().union(*group)
        found = [whole if bar is group[0] else bar for bar in found if bar not in group[1:]]
    return [tuple(sorted(bar)) for bar in found]


def triangles(bars: list[frozenset[str]]) -> Iterator[tuple[frozenset[str], ...]]:
    """Three bars, each two of which share a point of their own."""
    for one, other in combinations(bars, 2):
        if one & other:
            for third in bars:
                corners = {*(one & other), *(other & third), *(third & one)}
                if (
                    third not in (one, other)
                    and len(corners) == 3
                    and one & third
                    and other & third
                ):
                    yield one, other, third
