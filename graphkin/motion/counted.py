"""How often links have gone round along a sweep, where wheels depend on it.

A position shows which way a link points and not how often it went round since its wheels stood as
at the start. Along a motion nothing is open: from place to place the angle goes on. So the angles
near which links count are followed from the place where the scene says them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from graphkin.scene.expression import Name
from graphkin.scene.model import Scene
from graphkin.scene.quantity import Quantity
from graphkin.structure.counting import counted_near

if TYPE_CHECKING:
    from graphkin.motion.course import Course
    from graphkin.motion.pieces import Piece

Reals = np.ndarray[Any, np.dtype[Any]]
QUARTER = 90.0
"""Angles near which links count are whole quarters of a turn, whose directions are exact."""
FIRST, MOST = 64, 8192
"""Places run at once, at first and at most, until some link has gone a quarter of a turn."""
PARTS = 16
"""Parts into which a way is cut on which a link goes a quarter of a turn and more."""
ENOUGH = 1e-9
"""Share of the way below which it is not cut any more: there a link leaps."""


def name_of(link: str) -> str:
    """The name of the angle near which a link counts; no parameter can be called so."""
    return f"turned {link}"


def named_angles(scene: Scene) -> tuple[dict[str, Quantity], dict[str, Any]]:
    """The angles near which links count as named values in degrees, and those of the scene."""
    near = counted_near(scene)
    values = {name_of(link): degrees_of(angle, scene) for link, angle in near.items()}
    return {link: Quantity(name, Name(name), "deg") for link, name in zip(near, values, strict=True)}, values


def degrees_of(angle: Quantity, scene: Scene) -> Any:
    """An angle in degrees, exact where it is stated so."""
    if angle.unit == "deg":
        return angle.number(scene.values)
    return float(np.degrees(angle.si(scene.values)))


@dataclass(frozen=True, eq=False)
class Turned:
    """How far links have turned: places u (N,), rising, and angles (degrees) by the link, (N,)."""

    at: Reals
    angles: Mapping[str, Reals]

    def values(self, at: Any) -> dict[str, Any]:
        """The named angles near which links count at other places; at both ends they stay."""
        return {name_of(link): self.near(link, at) for link in self.angles}

    def near(self, link: str, at: Any) -> Any:
        """The quarter of a turn nearest to the angle of a link."""
        return QUARTER * np.rint(np.interp(at, self.at, self.angles[link]) / QUARTER)

    def within(self, low: float, high: float) -> Turned:
        """The part from one place to another."""
        here = (low <= self.at) & (self.at <= high)
        return Turned(self.at[here], {link: row[here] for link, row in self.angles.items()})

    def steps(self, link: str) -> list[tuple[float, float]]:
        """The places from which on a link counts near another quarter of a turn, and that."""
        near = self.near(link, self.at)
        new = np.flatnonzero(np.append(True, np.diff(near) != 0))
        return [(float(self.at[k]), float(near[k])) for k in new]

    def joined(self, other: Turned | None) -> Turned:
        """With the places of another that follow on these."""
        if other is None:
            return self
        both = {link: np.append(row, other.angles[link]) for link, row in self.angles.items()}
        return Turned(np.append(self.at, other.at), both)

    def moved(self, by: float, gone: Mapping[str, float]) -> Turned:
        """The same motion at other places, where links have gone so much farther (degrees)."""
        angles = {link: row + gone[link] for link, row in self.angles.items()}
        return Turned(self.at + by, angles)


def through(pieces: Sequence[Piece]) -> Turned | None:
    """How far links turn on the pieces of a range, one after the other; None where none counts."""
    found: Turned | None = None
    for piece in pieces:
        turned = piece.course.turned
        if turned is not None:
            part = turned.within(piece.low.at, piece.high.at)
            found = part if found is None else found.joined(part)
    return found


def led(course: Course, start: float, stop: float) -> Course:
    """The course with the angles near which links count followed from one place to another.

    At the start they count as the course says so far. Where nothing closes they stay. Between two
    places of the grid a link is taken to turn by less than three quarters of a turn.
    """
    if not course.counting or start == stop:
        return course
    way = abs(stop - start)
    count = max(int(np.ceil(way / abs(course.sweep.grid_step))), 1)
    ahead = np.linspace(start, stop, count + 1).tolist()[::-1]
    known = course.values(np.array([start]))
    near = {link: float(np.ravel(known[name_of(link)])[0]) for link in course.counting}
    found: list[tuple[float, dict[str, float]]] = []
    size, last = FIRST, start
    while ahead:
        places = np.array(ahead[: -size - 1 : -1])
        angles = angles_near(course, places, near)
        good = np.isfinite(np.array([*angles.values()])).all(axis=0)
        if not found and good.any():
            near = {link: float(row[good][0]) for link, row in angles.items()}
            last = float(places[good][0])
            found.append((last, near))
            del ahead[-1 - int(np.flatnonzero(good)[0]) :]
            continue
        done = within_quarter(angles, near, good)
        if done:
            here = np.flatnonzero(good[:done])
            found += [(float(places[k]), {m: float(r[k]) for m, r in angles.items()}) for k in here]
            near, last = found[-1][1] if found else near, float(places[done - 1])
            del ahead[-done:]
            size = min(2 * size, MOST) if done == len(places) else FIRST
            continue
        if abs(places[0] - last) > ENOUGH * way:
            ahead += np.linspace(places[0], last, PARTS + 1)[1:-1].tolist()
        else:
            near = {link: float(row[0]) for link, row in angles.items()}
    if not found:
        return course
    return replace(course, turned=table(found))


def led_both(course: Course, start: float, low: float, high: float) -> Course:
    """The course with these angles followed from one place forth and back."""
    before, after = led(course, start, low).turned, led(course, start, high).turned
    turned = before.joined(after) if before is not None else after
    return replace(course, turned=turned)


def angles_near(course: Course, at: Reals, near: Mapping[str, float]) -> dict[str, Reals]:
    """The angles of links (degrees) at some places, each within half a turn of a given one."""
    values = course.values(at) | {name_of(link): angle for link, angle in near.items()}
    rows = course.counted(values, len(at))
    return {link: np.degrees(row) for link, row in rows.items()}


def within_quarter(angles: Mapping[str, Reals], near: Mapping[str, float], good: Reals) -> int:
    """How many places come before a link has gone a quarter of a turn, in all or from one on."""
    over = np.zeros(len(good), dtype=bool)
    for link, row in angles.items():
        rows = np.append(near[link], row[good])
        far = (np.abs(rows[1:] - near[link]) > QUARTER) | (np.abs(np.diff(rows)) > QUARTER)
        over[np.flatnonzero(good)[far]] = True
    return int(np.argmax(over)) if over.any() else len(good)


def table(found: Sequence[tuple[float, Mapping[str, float]]]) -> Turned:
    """Followed angles as arrays, the places rising."""
    rows = sorted(found, key=lambda row: row[0])
    links = rows[0][1]
    at = np.array([place for place, _ in rows])
    return Turned(at, {link: np.array([angles[link] for _, angles in rows]) for link in links})
