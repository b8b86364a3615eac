"""The motion of a mechanism from its positions alone, in fifty digits: Newton and differences.

No formula of velocities or accelerations is used: the mechanism is closed at three moments a tiny
time apart, and how far everything has come in between is read off.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import arb

from tests.chance.constraints import Equation, Moved, Pose, equations, fixed_frame
from tests.chance.many_digits import in_many_digits
from tests.chance.records import FRAME, Standing
from tests.chance.written import Exact, Written

INSTANT = arb(2) ** -43
"""The time between the moments, in parts of the time that a driver needs for its own size."""
ENOUGH = 1e-44
"""A correction, in parts of the mechanism, after which nothing more is gained."""


class NotClosedError(ArithmeticError):
    """Positions that Newton's method does not settle in."""


@dataclass
class Motion:
    """Position (or angle), velocity and acceleration of points, links and blocks, as floats."""

    points: dict[str, tuple[complex, complex, complex]]
    links: dict[str, tuple[float, float, float]]
    slides: dict[str, tuple[float, float, float, complex]]
    off: float
    """How far the generated places are from the exact ones, in parts of the mechanism."""
    period: float
    """The time in which the fastest driver comes about as far as it is long (s)."""


class Closing:
    """The equations of a mechanism and their Jacobian where it was generated."""

    def __init__(self, written: Written, geometry: Exact | None = None) -> None:
        self.standing, self.geometry = written.standing, geometry or Exact(written)
        self.size = arb(self.standing.size)
        self.equations: list[Equation] = equations(self.standing)
        self.names = [name for name in self.standing.bodies if name != FRAME]
        self.first = self.stacked(
            {
                name: (body.corner.real, body.corner.imag, body.angle)
                for name, body in self.standing.bodies.items()
            }
        )
        self.inverse = self.inverted()

    def stacked(self, poses: Mapping[str, Pose]) -> list[Any]:
        """Poses as a list of unknowns, lengths in parts of the mechanism."""
        found = []
        for name in self.names:
            x, y, angle = (arb(each) for each in poses[name])
            found += [x / self.size, y / self.size, angle]
        return found

    def moved(self, unknowns: list[Any]) -> Moved:
        """The bodies as some unknowns have them."""
        rows = [unknowns[k : k + 3] for k in range(0, len(unknowns), 3)]
        poses = {
            name: (x * self.size, y * self.size, angle)
            for name, (x, y, angle) in zip(self.names, rows, strict=True)
        }
        return Moved(self.geometry, fixed_frame(poses))

    def missed(self, unknowns: list[Any], time: Any) -> list[Any]:
        """What does not vanish yet."""
        moved = self.moved(unknowns)
        return [value for _, miss in self.equations for value in miss(moved, time)]

    def inverted(self) -> Any:
        """The inverse of the Jacobian, to the precision of floats."""
        step = arb(2) ** -83
        here = self.missed(self.first, 0)
        columns = []
        for k in range(len(self.first)):
            there = [*self.first]
            there[k] += step
            pairs = zip(self.missed(there, 0), here, strict=True)
            columns.append([float((after - before) / step) for after, before in pairs])
        matrix = np.array(columns).T
        if matrix.shape[0] != matrix.shape[1]:
            raise NotClosedError(f"{matrix.shape[0]} equations for {matrix.shape[1]} unknowns")
        scale = abs(matrix).max(axis=1, keepdims=True)
        return np.linalg.inv(matrix / scale) / scale.T

    def closed(self, start: list[Any], time: Any) -> list[Any]:
        """The unknowns at a time. Raises NotClosedError."""
        unknowns, before = [*start], 1.0
        for _ in range(40):
            missed = self.missed(unknowns, time)
            scale = max(abs(float(value)) for value in missed) or 1.0
            step = self.inverse @ np.array([float(value / scale) for value in missed])
            pairs = zip(unknowns, step * scale, strict=True)
            unknowns = [(u - float(s)).mid() for u, s in pairs]
            moved = scale * float(abs(step).max())
            if moved < ENOUGH or (moved < 1e-40 and moved > before / 4):
                return unknowns
            before = moved
        raise NotClosedError(f"still moves by {moved:.1e}")


def motion(written: Written, geometry: Exact | None = None) -> Motion:
    """Positions, velocities and accelerations of everything. Raises NotClosedError.

    The geometry is that of what is written, or one beside it.
    """
    with in_many_digits():
        closing, standing = Closing(written, geometry), written.standing
        h = INSTANT * period(standing)
        here = closing.closed(closing.first, arb(0))
        ends = [closing.closed(here, way * h) for way in (-1, 1)]
        off = max(abs(float(a - b)) for a, b in zip(here, closing.first, strict=True))
        states = [states_of(closing, unknowns) for unknowns in (ends[0], here, ends[1])]
        found = {key: rates([state[key] for state in states], h) for key in states[0]}
        return gathered(standing, closing, here, found, (off, float(h / INSTANT)))


def period(standing: Standing) -> Any:
    """The time in which the fastest driver comes about as far as it is long."""
    rates = [0.0]
    for drive in standing.drives:
        size = 1.0 if drive.kind == "turn" else standing.size
        rates += [abs(drive.speed) / size, (abs(drive.acceleration) / size) ** 0.5]
    return 1 / arb(max(rates) or 1.0)


def states_of(closing: Closing, unknowns: list[Any]) -> dict[tuple[str, str], Any]:
    """Places of points, angles of links and coordinates of blocks."""
    standing, moved = closing.standing, closing.moved(unknowns)
    found: dict[tuple[str, str], Any] = {}
    for body in standing.bodies.values():
        found |= {("point", p): moved.point(body.name, p) for p in body.points}
        if body.name != FRAME:
            found["link", body.name] = moved.poses[body.name][2]
    for slide in standing.slides.values():
        found["slide", slide.block] = moved.slid(standing, slide).real
    return found


def rates(values: list[Any], h: Any) -> tuple[Any, Any, Any]:
    """The middle value, its first and its second derivative."""
    before, here, after = values
    return here, (after - before) / (2 * h), (after - 2 * here + before) / (h * h)


def gathered(
    standing: Standing,
    closing: Closing,
    here: list[Any],
    found: dict[Any, Any],
    ends: tuple[float, float],
) -> Motion:
    """The records, and the Coriolis acceleration of each block by its definition."""
    moved = closing.moved(here)
    points = {n: tuple(map(complex, each)) for (k, n), each in found.items() if k == "point"}
    links = {n: tuple(map(float, each)) for (k, n), each in found.items() if k == "link"}
    slides = {}
    for (kind, name), each in found.items():
        if kind == "slide":
            slide = standing.slides[name]
            _, along, _ = closing.geometry.guide(slide)
            along = complex(moved.units[slide.on] * along)
            turning = links[slide.on][1] if slide.on != FRAME else 0.0
            speed = float(each[1])
            slides[name] = (*map(float, each), 2j * turning * speed * along)
    return Motion(points, links, slides, *ends)
