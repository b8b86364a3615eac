"""Where a trial can be drawn at all: the ends of its windows, and places spread well within them.

Where an arc only just reaches a misfit grows like a root, and a window may be narrower than any
grid. How far the arc reaches is a smooth function on both sides of the end, so the ends are found
by it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from graphkin.construction.guides.dyad_by_arc_and_guide import arc_cuts_line
from graphkin.construction.guides.swung_guide import swing
from graphkin.construction.links.dyad_by_arcs import arcs_meet
from graphkin.numbers.arithmetic import pick
from graphkin.numbers.plane import Circle, Line, cross
from graphkin.numbers.roots import Array, Misfit, roots

TOGETHER = 2.0**-25
"""Distance of the centres of two equal circles, in parts of both radii, that may be rounding.

Beside a flat crossing rounding is as large as the root of eps.
"""
BESIDE = 0.5
"""How far from the end of a window its first place lies, in steps of the places before easing."""


class Windows(NamedTuple):
    """Whose each window is (W,), and its places from end to end (W, M)."""

    owner: Array
    places: Array


class Ends(NamedTuple):
    """Whose each end of a window is (E,), where it lies (E,), and the window's place next to it."""

    owner: Array
    at: Array
    beside: Array


def arcs_reach(m: Circle, n: Circle, *_: Any) -> Any:
    """By how much two circles meet: positive where they cross, negative where they do not.

    Equal circles that fall together do not: their centres may stay together on all the way, and
    where the circles cross is then rounding.
    """
    distance, most = abs(n.centre - m.centre), m.radius + n.radius
    least, hidden = abs(m.radius - n.radius), TOGETHER * most
    least = pick(least < hidden, hidden, least)
    return (most**2 - distance**2) * (distance**2 - least**2)


def line_reached(line: Line, circle: Circle, *_: Any) -> Any:
    """By how much a circle meets a line."""
    height = cross(line.along, circle.centre - line.point) / abs(line.along)
    return circle.radius**2 - height**2


def swing_reached(pivot: Any, pin: Any, height: Any, *_: Any) -> Any:
    """By how much a pin stands far enough from a pivot for a guide at a height between them."""
    return abs(pin - pivot) ** 2 - height**2


REACHES: dict[Callable[..., Any], Callable[..., Any]] = {
    arcs_meet.value: arcs_reach,
    arc_cuts_line.value: line_reached,
    swing.value: swing_reached,
}
"""For each way of drawing that may fail by what it is drawn of: positive where it succeeds."""


def narrowed(reaches: Misfit, windows: Windows) -> tuple[Windows, Ends]:
    """The parts of windows in which a smooth function is positive, and their ends where it is zero.

    Places lead up to such an end, not into it.
    """
    import numpy as np

    owner, places = windows
    size, count = places.shape
    which, at = roots(lambda row, place: reaches(owner[row], place), places)
    rows = np.concatenate([np.repeat(np.arange(size), 2), which])
    marks = np.concatenate([places[:, [0, -1]].ravel(), at])
    order = np.lexsort((marks, rows))
    rows, marks = rows[order], marks[order]
    same = (rows[1:] == rows[:-1]) & (marks[1:] > marks[:-1])
    row, low, high = rows[:-1][same], marks[:-1][same], marks[1:][same]
    good = reaches(owner[row], (low + high) / 2) > 0
    row, low, high = row[good], low[good], high[good]
    begins, ends = low != places[row, 0], high != places[row, -1]
    eased = low[:, None] + (high - low)[:, None] * ease(np.arange(count) / (count - 1))
    short = (high - low) * ease(BESIDE / (count - 1))
    eased[:, 0] = np.where(begins, low + short, low)
    eased[:, -1] = np.where(ends, high - short, high)
    found = np.where((begins | ends)[:, None], eased, places[row])
    sides = ((begins, low, found[:, 0]), (ends, high, found[:, -1]))
    columns = [[owner[row[cut]], end[cut], beside[cut]] for cut, end, beside in sides]
    return Windows(owner[row], found), Ends(*map(np.concatenate, zip(*columns, strict=True)))


def ease(share: Any) -> Any:
    """Shares from 0 to 1, closer together near both ends: there a root grows steeply."""
    import numpy as np

    return (1 - np.cos(np.pi * share)) / 2
