"""The pump of the laboratory as one writes it down who needs only this one mechanism.

Closed formulas, no steps, no margins: what the straight-line program is measured against. Once in
plain Python for one position, once in numpy for many. Both give every quantity that the program
gives: positions, velocities and accelerations of A, B, C and D, ω and ε of the links, and the
centres and poles of the links that have no fixed pivot, as a shift over a size.
"""

from __future__ import annotations

import cmath
import math

import numpy as np

O2 = -0.3j
PART = (0.4**2 + 0.2**2 - 0.25**2) / (2 * 0.4**2)
RATIO = complex(PART, math.sqrt((0.2 / 0.4) ** 2 - PART**2))
"""(C - A)/(B - A), of the triangle ABC."""


def one(n: float) -> dict[str, complex]:
    """One position, in Python's complex numbers."""
    omega = (300 + 10 * n) * math.pi / 30
    a = 0.3 * cmath.exp(1j * math.radians(30 + 2 * n))
    axis = O2 - a
    d = abs(axis)
    along = (0.16 - 0.09 + d * d) / (2 * d)
    u = (along - 1j * math.sqrt(0.16 - along * along)) * axis / d
    b = a + u
    w = b - O2
    c = a + RATIO * u
    d = complex(c.real + math.sqrt(0.04 - c.imag * c.imag))
    rod = d - c
    area = u.real * w.imag - u.imag * w.real
    va = 1j * omega * a
    omega3 = -(va.real * w.real + va.imag * w.imag) / area
    vb = va + 1j * omega3 * u
    omega2 = (vb.imag * w.real - vb.real * w.imag) / 0.09
    vc = va + RATIO * (vb - va)
    omega4 = -vc.imag / rod.real
    vd = vc + 1j * omega4 * rod
    aa = -omega * omega * a
    part = aa - omega3 * omega3 * u
    epsilon3 = -(part.real * w.real + part.imag * w.imag + omega2 * omega2 * 0.09) / area
    ab = part + 1j * epsilon3 * u
    epsilon2 = (ab.imag * w.real - ab.real * w.imag) / 0.09
    ac = aa + RATIO * (ab - aa)
    part = ac - omega4 * omega4 * rod
    epsilon4 = -part.imag / rod.real
    ad = part + 1j * epsilon4 * rod
    return {
        "A": a, "B": b, "C": c, "D": d,
        "v_A": va, "v_B": vb, "v_C": vc, "v_D": vd,
        "a_A": aa, "a_B": ab, "a_C": ac, "a_D": ad,
        "omega_1": omega, "omega_2": omega2, "omega_3": omega3, "omega_4": omega4,
        "epsilon_2": epsilon2, "epsilon_3": epsilon3, "epsilon_4": epsilon4,
        "I_3": 1j * va / omega3, "I_4": 1j * vc / omega4,
        "J_3": aa * u / (aa - ab), "J_4": ac * rod / (ac - ad),
    }  # fmt: skip


def many(n: np.ndarray) -> dict[str, np.ndarray]:
    """Many positions at once: the same formulas on numpy arrays."""
    omega = (300 + 10 * n) * (math.pi / 30)
    phi = np.radians(30 + 2 * n)
    a = np.empty(n.shape, complex)
    a.real, a.imag = 0.3 * np.cos(phi), 0.3 * np.sin(phi)
    axis = O2 - a
    square = axis.real**2 + axis.imag**2
    along = (0.07 + square) / (2 * square)
    across = np.sqrt(0.16 / square - along * along)
    u = (along - 1j * across) * axis
    b = a + u
    w = b - O2
    c = a + RATIO * u
    d = c.real + np.sqrt(0.04 - c.imag**2)
    rod = d - c
    area = u.real * w.imag - u.imag * w.real
    va = 1j * omega * a
    omega3 = -(va.real * w.real + va.imag * w.imag) / area
    vb = va + 1j * omega3 * u
    omega2 = (vb.imag * w.real - vb.real * w.imag) * (1 / 0.09)
    vc = va + RATIO * (vb - va)
    omega4 = -vc.imag / rod.real
    vd = vc.real - omega4 * rod.imag
    aa = -(omega * omega) * a
    part = aa - omega3 * omega3 * u
    epsilon3 = -(part.real * w.real + part.imag * w.imag + 0.09 * omega2 * omega2) / area
    ab = part + 1j * epsilon3 * u
    epsilon2 = (ab.imag * w.real - ab.real * w.imag) * (1 / 0.09)
    ac = aa + RATIO * (ab - aa)
    squared = omega4 * omega4
    epsilon4 = -(ac.imag - squared * rod.imag) / rod.real
    ad = ac.real - squared * rod.real - epsilon4 * rod.imag
    return {
        "A": a, "B": b, "C": c, "D": d,
        "v_A": va, "v_B": vb, "v_C": vc, "v_D": vd,
        "a_A": aa, "a_B": ab, "a_C": ac, "a_D": ad,
        "omega_1": omega, "omega_2": omega2, "omega_3": omega3, "omega_4": omega4,
        "epsilon_2": epsilon2, "epsilon_3": epsilon3, "epsilon_4": epsilon4,
        "I_3": 1j * va / omega3, "I_4": 1j * vc / omega4,
        "J_3": aa * u / (aa - ab), "J_4": ac * rod / (ac - ad),
    }  # fmt: skip


def many_in_blocks(n: np.ndarray, block: int = 2048) -> dict[str, np.ndarray]:
    """The same, a block at a time into arrays made beforehand, so that all stays in the cache."""
    found: dict[str, np.ndarray] = {}
    for start in range(0, n.size, block):
        part = slice(start, start + block)
        for name, values in many(n[part]).items():
            if name not in found:
                found[name] = np.empty(n.size, values.dtype)
            found[name][part] = values
    return found
