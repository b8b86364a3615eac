"""The scenes as they are shipped, their motion proved by both routes, and closed forms for them."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from functools import cache
from pathlib import Path

import mpmath

from graphkin.construction.core.solution import Solution
from graphkin.mechanism import Mechanism, load
from graphkin.numbers.plane import Ratio
from graphkin.scene.read_scene import read_text

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "examples" / "scenes"
FILES = {path.stem: path for path in sorted(FOLDER.glob("*.toml"))} | {
    path.parent.name: path for path in sorted((ROOT / "sheets").glob("*/scene.toml"))
}
CLOSE = 1e-10
"""Largest difference of the two routes, over the largest magnitude of its kind in the scene."""
EXACT = 1e-9
"""A closed form is met to this share of the largest magnitude compared."""

Place = Callable[..., mpmath.mpc]


@cache
def mechanism(name: str, **settings: object) -> Mechanism:
    """A scene by the name of its file, with parameters set."""
    return load(FILES[name], **settings)


@cache
def motion(name: str, **settings: object) -> Solution:
    """The motion of a scene, on which the independent route agrees."""
    return proved(mechanism(name, **settings))


@cache
def varied(name: str, *changes: tuple[str, str]) -> Mechanism:
    """A scene with pieces of its text written otherwise; each piece must be there."""
    text = FILES[name].read_text(encoding="utf-8")
    for old, new in changes:
        assert old in text, f"{name} has no {old!r}"
        text = text.replace(old, new)
    return Mechanism(read_text(text, name))


def proved(found: Mechanism) -> Solution:
    """The motion of a mechanism, held against the vector loops."""
    solution = found.solve()
    verdict = found.witness(solution)
    assert verdict.agrees
    assert verdict.largest_difference < CLOSE
    return solution


def place(found: Solution, point: str) -> complex:
    """Position of a point (m)."""
    return found.points[point].position


def velocity(found: Solution, point: str) -> complex:
    """Velocity of a point (m/s)."""
    return found.points[point].velocity


def acceleration(found: Solution, point: str) -> complex:
    """Acceleration of a point (m/s²)."""
    return found.points[point].acceleration


def omega(found: Solution, link: object) -> float:
    """Angular velocity of a link (rad/s)."""
    return found.links[str(link)].omega


def epsilon(found: Solution, link: object) -> float:
    """Angular acceleration of a link (rad/s²)."""
    return found.links[str(link)].epsilon


def centre(ratio: Ratio) -> complex:
    """The point of a centre that is not at infinity."""
    return ratio.start + ratio.shift / ratio.size


def angle(found: Solution, start: str, end: str) -> float:
    """Angle of the way from one point to another (rad)."""
    return cmath.phase(place(found, end) - place(found, start))


def same(found: complex, exact: complex, scale: float = 0.0) -> bool:
    """Whether a number meets its closed form, to a share of it or of the given scale."""
    return abs(complex(found) - complex(exact)) <= EXACT * max(abs(complex(exact)), scale)


def carried(found: Solution, link: object, point: str, where: complex) -> complex:
    """Velocity of the point of a link at a place, from one of its points (Galileo)."""
    return velocity(found, point) + 1j * omega(found, link) * (where - place(found, point))


def crossing(a: complex, b: complex, c: complex, d: complex) -> complex:
    """Where the line AB meets the line CD."""
    along, other = b - a, d - c
    share = ((c - a).conjugate() * other).imag / (along.conjugate() * other).imag
    return a + share * along


def unit(turn: mpmath.mpf) -> mpmath.mpc:
    """The unit vector at an angle (rad)."""
    return mpmath.expj(turn)


def degrees(turn: float | str) -> mpmath.mpf:
    """An angle written in degrees, in rad."""
    return mpmath.mpf(turn) * mpmath.pi / 180


def meeting(a: mpmath.mpc, from_a: float, b: mpmath.mpc, from_b: float, side: int) -> mpmath.mpc:
    """The point at given distances from A and B: left of the way from A to B for side +1."""
    way = b - a
    distance = abs(way)
    reach = (distance**2 + mpmath.mpf(from_a) ** 2 - mpmath.mpf(from_b) ** 2) / (2 * distance)
    return a + way / distance * (
        reach + side * 1j * mpmath.sqrt(mpmath.mpf(from_a) ** 2 - reach**2)
    )


def rates(law: Place, *drives: tuple[object, object, object]) -> tuple[complex, complex, complex]:
    """A place and its first and second derivative by time, for (q, q′, q″) of every driver."""
    with mpmath.workdps(60):
        given = [[mpmath.mpf(number) for number in drive] for drive in drives]

        def moving(t: mpmath.mpf) -> mpmath.mpc:
            return mpmath.mpc(law(*(q + w * t + e * t * t / 2 for q, w, e in given)))

        return tuple(complex(mpmath.diff(moving, 0, n)) for n in (0, 1, 2))


def follows(
    found: Solution, point: str, law: Place, *drives: tuple[object, object, object]
) -> None:
    """A point's position, velocity and acceleration are those of a law in mm.

    Where one of the three passes through zero the others tell what is small: v² is near a·z.
    """
    exact = [value / 1000 for value in rates(law, *drives)]
    z, v, a = map(abs, exact)
    stands = found.points[point]
    assert same(stands.position, exact[0]), point
    assert same(stands.velocity, exact[1], math.sqrt(a * z)), point
    assert same(stands.acceleration, exact[2], v**2 / z if z else a), point
