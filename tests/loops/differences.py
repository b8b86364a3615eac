"""Motions by central differences in 50 digits, for the loops to be held against."""

from __future__ import annotations

import mpmath


def unit(angle):
    return mpmath.mpc(mpmath.cos(angle), mpmath.sin(angle))


def degrees(angle):
    return angle * mpmath.pi / 180


def central(place, laws):
    """Place, velocity and acceleration of points by central differences, laws (q, q′, q″)."""
    with mpmath.workdps(50):
        h = mpmath.mpf(10) ** -15
        before, here, after = (
            place(*(q + w * k * h + e * (k * h) ** 2 / 2 for q, w, e in laws)) for k in (-1, 0, 1)
        )
        return {
            name: (
                complex(z),
                complex((after[name] - before[name]) / (2 * h)),
                complex((after[name] - 2 * z + before[name]) / h**2),
            )
            for name, z in here.items()
        }


def agree(motion, expected, tolerance=1e-12):
    for name, quantities in expected.items():
        for found, exact in zip(motion.point(name), quantities, strict=True):
            assert abs(found[0] - exact) <= tolerance * max(1, abs(exact)), name
