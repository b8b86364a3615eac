"""The three linkages in closed form, as one writes them down who needs only these: plain numpy.

Real arrays for each coordinate, no steps, no margins, no care for flat triangles. Each function
takes the crank's angle in degrees and gives x, y, their velocities and accelerations for each pin.
"""

from __future__ import annotations

import numpy as np

from tests.bench.linkages import OMEGA

Pin = tuple[np.ndarray, ...]
"""x, y, vx, vy, ax, ay."""


def crank(degrees: np.ndarray, radius: float) -> Pin:
    """The tip of a crank about the origin, turning evenly."""
    phi = np.radians(degrees)
    x, y = radius * np.cos(phi), radius * np.sin(phi)
    square = -OMEGA * OMEGA
    return x, y, -OMEGA * y, OMEGA * x, square * x, square * y


def left(p: Pin, fixed: tuple[float, float], r: float, s: float) -> Pin:
    """The pin of a dyad RRR to the left of the way from a moving pin to a fixed one."""
    px, py, pvx, pvy, pax, pay = p
    gx, gy = fixed[0] - px, fixed[1] - py
    inverse = 1 / (gx * gx + gy * gy)
    along = 0.5 + (0.5 * (r * r - s * s)) * inverse
    across = np.sqrt(r * r * inverse - along * along)
    ux, uy = along * gx - across * gy, along * gy + across * gx
    wx, wy = ux - gx, uy - gy
    inverse = 1 / (ux * wy - uy * wx)
    omega = -(pvx * wx + pvy * wy) * inverse
    other = -(pvx * ux + pvy * uy) * inverse
    square = omega * omega
    ax, ay = pax - square * ux, pay - square * uy
    epsilon = -(ax * wx + ay * wy + other * other * (s * s)) * inverse
    return (
        px + ux, py + uy, pvx - omega * uy, pvy + omega * ux, ax - epsilon * uy, ay + epsilon * ux,
    )  # fmt: skip


def four_bar(degrees: np.ndarray) -> tuple[Pin, ...]:
    """Crank and rocker."""
    a = crank(degrees, 0.04)
    return a, left(a, (0.1, 0.0), 0.09, 0.07)


def slider_crank(degrees: np.ndarray) -> tuple[Pin, ...]:
    """Crank, rod, and a block on a level guide above the origin."""
    a = crank(degrees, 0.06)
    x, y, vx, vy, ax, ay = a
    h = 0.02 - y
    rod = np.sqrt(0.04 - h * h)
    inverse = 1 / rod
    omega = -vy * inverse
    square = omega * omega
    epsilon = (square * h - ay) * inverse
    still = np.zeros_like(x)
    b = x + rod, still + 0.02, vx - omega * h, still, ax - square * rod - epsilon * h, still
    return a, b


def six_bar(degrees: np.ndarray) -> tuple[Pin, ...]:
    """A crank-rocker, whose rocker is a bell crank, and a second dyad."""
    a = crank(degrees, 0.05)
    b = left(a, (0.15, -0.02), 0.15, 0.09)
    bell = (100 / 90) * np.exp(-1j * np.radians(70))
    x, y, vx, vy, ax, ay = b
    x, y = x - 0.15, y + 0.02
    c, s = float(bell.real), float(bell.imag)
    pin = (
        0.15 + (c * x - s * y), s * x + c * y - 0.02, c * vx - s * vy, s * vx + c * vy,
        c * ax - s * ay, s * ax + c * ay,
    )  # fmt: skip
    return a, b, pin, left(pin, (0.34, 0.02), 0.12, 0.08)


FORMULAS = {"four-bar": four_bar, "slider-crank": slider_crank, "six-bar": six_bar}


def in_blocks(name: str, degrees: np.ndarray, block: int = 4096) -> np.ndarray:
    """The same a block at a time, so that all stays in the cache: pins by six by positions."""
    size, found = degrees.size, np.empty((0, 6, 0))
    for start in range(0, size, block):
        pins = FORMULAS[name](degrees[start : start + block])
        if not found.size:
            found = np.empty((len(pins), 6, size))
        for row, pin in zip(found, pins, strict=True):
            for place, part in zip(row, pin, strict=True):
                place[start : start + block] = part
    return found
