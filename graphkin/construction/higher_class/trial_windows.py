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
from graphkin.numbers.plane import Circle, Line, cross
from graphkin.numbers.roots import Array, Misfit, roots

TOGETHER = 2.0**-25
"""Distance of the centres of two equal circles, in parts of both radii, that may be rounding.

Beside a flat crossing rounding is as large as the root of eps.
"""


class Windows(NamedTuple):
    """Whose each window is (W,), and its places from end to end (W, M)."""

    owner: Array
    places: Array


def arcs_reach(m: Circle, n: Circle, *_: Any) -> Any:
    """By how much two circles meet: positive where they cross, negative where they do not.

    Equal circles that fall together do not: their centres may stay together on all the way, and
    where the circles cross is then rounding.
    """
    distance, most = abs(n.centre - m.centre), m.radius + n.radius
    least = (m.radius - n.radius) ** 2 + (TOGETHER * most) ** 2
    return (most**2 - distance**2) * (distance**2 - least)


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


def narrowed(reaches: Misfit, windows: Windows) -> Windows:
    """The parts of windows in which a smooth function is positive."""
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
    whole = (low == places[row, 0]) & (high == places[row, -1])
    eased = low[:, None] + (high - low)[:, None] * ease(count)
    return Windows(owner[row], np.where(whole[:, None], places[row], eased))


def ease(count: int) -> Array:
    """Places from 0 to 1, close together near both ends: there a root grows steeply."""
    import numpy as np

    return (1 - np.cos(np.linspace(0, np.pi, count))) / 2
