"""Students who share nothing with the marking: closed positions, differentiated in time.

A student sets the crank with one error of the protractor for the whole sheet. Every length that is
measured has an error with long tails and is rounded to half a millimetre; values are computed from
it. Some write other units, some leave cells blank, some misread one length by a centimetre.
"""

from __future__ import annotations

import cmath
from collections.abc import Callable, Mapping
from math import pi, radians, sqrt

import numpy as np

Points = dict[str, complex]
Motion = dict[str, tuple[complex, complex, complex]]
"""The position, velocity and acceleration of each point, in mm and s."""
Row = dict[str, float]
LABS: Mapping[str, tuple[float, Callable[[float], tuple[float, float]]]] = {
    "offset-slider-crank": (60, lambda n: (128 + 1.2 * n, 100 + 5 * n)),
    "slotted-lever": (120, lambda n: (28 + 1.5 * n, 50 + 2 * n)),
    "pump": (300, lambda n: (30 + 2 * n, 300 + 10 * n)),
}
"""The crank in mm, and its angle in degrees and its speed in rev/min by the student's number."""
CAUSES: Mapping[str, tuple[str, ...]] = {
    "diameter": ("diameter_for_radius", "radius_for_diameter"),
    "clockwise": ("angle_clockwise",),
    "protractor": ("other_scale_of_protractor",),
    "reversed": ("driver_reversed",),
    "another number": ("data_of_another",),
    "other side": ("other_side",),
    "plate": ("plate_flipped", "letters_exchanged"),
    "ruler 1:2": ("ruler_scale",),
    "ruler from 10": ("ruler_from_ten",),
    "scales exchanged": ("wrong_scale",),
    "scale forgotten": ("scale_missing",),
    "own plans": ("own_scale",),
    "rev/min": ("rpm_as_rad",),
    "in mm": ("power_of_ten",),
    "rows exchanged": ("answers_exchanged",),
}
"""The names that each mistake may have in a report."""


def reach(start: complex, rod: float, height: float, side: float) -> complex:
    """The end of a rod on a level guide."""
    return complex(start.real + side * sqrt(rod**2 - (height - start.imag) ** 2), height)


def positions(lab: str, way: complex, crank: float, made: str) -> Points:
    """All points for a direction of the crank. Raises ValueError where they do not close."""
    a, side = crank * way, -1.0 if made == "other side" else 1.0
    if lab == "offset-slider-crank":
        b = reach(a, 200, 30, side)
        return {"A": a, "B": b, "C": a + (0.55 if made == "plate" else 0.45) * (b - a)}
    if lab == "slotted-lever":
        arm = (a + 300j) / abs(a + 300j)
        b = -300j + 620 * arm
        return {"A": a, "B": b, "C": reach(b, 200, 340, side), "slot": abs(a + 300j) + 0j}
    span = -300j - a
    angle = (400**2 - 300**2 + abs(span) ** 2) / (2 * 400 * abs(span))
    if abs(angle) > 1:
        raise ValueError("does not close")
    turn = cmath.exp(-1j * np.arccos(angle))
    b = a + 400 * turn * span / abs(span)
    part = (400**2 + 200**2 - 250**2) / (2 * 400**2)
    shape = complex(part, sqrt(0.25 - part**2))
    c = a + (shape.conjugate() if made == "plate" else shape) * (b - a)
    return {"A": a, "B": b, "C": c, "D": reach(c, 200, 0, side)}


def motion(lab: str, phi: float, omega: float, crank: float, made: str) -> Motion:
    """Positions differentiated in time by a fourth-order stencil."""
    step = 1e-3 / abs(omega)
    every = [
        positions(lab, cmath.exp(1j * (phi + omega * k * step)), crank, made) for k in range(-2, 3)
    ]
    found: Motion = {}
    for name in every[0]:
        p = [each[name] for each in every]
        speed = (p[0] - 8 * p[1] + 8 * p[3] - p[4]) / (12 * step)
        rate = (-p[0] + 16 * p[1] - 30 * p[2] + 16 * p[3] - p[4]) / (12 * step**2)
        found[name] = p[2], speed, rate
    return found


def turning(m: Motion, p: str, q: str) -> tuple[float, float, float]:
    """The rate of a bar, its angular acceleration and its length; an empty name is at rest."""
    rest = (-300j, 0j, 0j)
    (x, v, a), (y, w, b) = m[p] if p else rest, m[q]
    z, u, c = y - x, w - v, b - a
    omega = (u / z).imag
    return omega, (c / z).imag, abs(z)


def hand_in(  # noqa: PLR0915
    lab: str,
    number: float,
    sheet: tuple[float, float, float],
    rng: np.random.Generator,
    made: str = "",
    other: float = 0.0,
    sigma: float = 0.3,
) -> dict[str, str]:
    """What a student writes. Raises ValueError where the drawing does not close."""
    kL, kv, ka = sheet
    length, data = LABS[lab]
    degrees, speed = data(other if made == "another number" else number)
    degrees += rng.uniform(-0.5, 0.5)
    degrees = {"clockwise": -degrees, "protractor": 180 - degrees}.get(made, degrees)
    crank = length * (
        2 if lab != "pump" and made == "diameter" else 0.5 if made == "diameter" else 1
    )
    omega = speed * pi / 30 * (-1 if made == "reversed" else 1)
    m = motion(lab, radians(degrees), omega, crank, made)
    blunder = rng.integers(12) if rng.random() < 0.3 else -1
    read = 0

    def measured(mm: float) -> float:
        nonlocal read
        error = sigma * float(rng.standard_t(4)) / sqrt(2)
        told = round(2 * (abs(mm) + error)) / 2
        told += 10 if read == blunder else 0
        read += 1
        told = 2 * told if made == "ruler 1:2" else told
        return told + 10 if made == "ruler from 10" else max(told, 0.5)

    factors = {"v": kv, "a": ka}
    if made == "scales exchanged":
        factors = {"v": ka, "a": kv}
    if made == "scale forgotten":
        factors = {"v": 1000.0, "a": 1000.0}
    fast = {"v": 30 / pi, "a": (30 / pi) ** 2} if made == "rev/min" else {"v": 1.0, "a": 1.0}
    found: Row = {}

    def vector(name: str, size: float) -> None:
        plan = name[0]
        mm = measured(size / {"v": kv, "a": ka}[plan])
        found[f"{name}_mm"] = mm * 2 if made == "own plans" else mm
        found[name] = mm * factors[plan] / 1000 * fast[plan]

    def rate(name: str, value: float, bar: float, plan: str) -> None:
        mm = measured(value * bar / {"v": kv, "a": ka}[plan])
        found[name] = mm * factors[plan] / bar * fast[plan]
        found[f"{name}_sense"] = value

    def links(of: Mapping[str, tuple[str, str]]) -> None:
        for link, (p, q) in of.items():
            w, e, bar = turning(m, p, q)
            rate(f"omega_{link}", w, bar, "v")
            rate(f"epsilon_{link}", e, bar, "a")

    def points(names: str) -> None:
        for name in names:
            vector(f"v_{name}", abs(m[name][1]))
            vector(f"a_{name}", abs(m[name][2]))

    if lab == "offset-slider-crank":
        points("BC")
        links({"2": ("A", "B")})
        found["a_BA_nu_mm"] = measured(turning(m, "A", "B")[0] ** 2 * 200 / ka)
        found["a_BA_nu_mm"] *= 2 if made == "own plans" else 1
    elif lab == "slotted-lever":
        points("C")
        (w, e, _), arm = turning(m, "", "B"), abs(m["slot"][0])
        vector("v_A3", abs(w) * arm)
        vector("a_A3", abs(complex(w**2, e)) * arm)
        rate("omega_3", w, arm, "v")
        rate("epsilon_3", e, arm, "a")
        links({"4": ("B", "C")})
        for name, value, plan in (("v", m["slot"][1].real, "v"), ("a", m["slot"][2].real, "a")):
            found[f"{name}_slide_2"] = measured(value / {"v": kv, "a": ka}[plan]) * factors[plan]
            found[f"{name}_slide_2"] *= fast[plan] / 1000
            found[f"{name}_slide_2_sense"] = value
    else:
        points("D")
        links({"2": ("", "B"), "3": ("A", "B"), "4": ("C", "D")})
        poles = {"I_3": centre(m, "A", "B"), "J_3": pole(m, "A", "B"), "J_4": pole(m, "C", "D")}
        for name, at in poles.items():
            for axis, value in (("x", at.real), ("y", at.imag)):
                told = value / kL + 3 * sigma * float(rng.standard_t(4)) / sqrt(2)
                told = 2 * told if made == "ruler 1:2" else told
                told += 10 * np.sign(told) if made == "ruler from 10" else 0
                found[f"{name}_{axis}_mm"] = round(2 * told) / 2
    if made == "rows exchanged":
        swap = {"offset-slider-crank": ("B", "C"), "slotted-lever": ("C", "A3"), "pump": ("2", "4")}
        one, two = swap[lab]
        names = {f: f.replace(f"_{one}", f"_{two}", 1) for f in found if f"_{one}" in f"{f}_"}
        names = {f: o for f, o in names.items() if o in found and f != o and f[0] in "vaeo"}
        names |= {o: f for f, o in names.items()}
        found = {f: found[names.get(f, f)] for f in found}
    return {f: cell(f, v, made, rng) for f, v in found.items() if rng.random() > 0.04}


def centre(m: Motion, p: str, q: str) -> complex:
    """The instant centre of a bar."""
    x, v, _ = m[p]
    return x + 1j * v / turning(m, p, q)[0]


def pole(m: Motion, p: str, q: str) -> complex:
    """The pole of accelerations of a bar."""
    (x, _, a), (w, e, _) = m[p], turning(m, p, q)
    return x - a / complex(-(w**2), e)


def cell(field: str, value: float, made: str, rng: np.random.Generator) -> str:
    """A number as it is written: mostly in the form's unit, at times in another with its name."""
    if field.endswith("_sense"):
        return "+" if value > 0 else "-"
    if field.endswith("_mm"):
        return f"{value:.1f}" if rng.random() < 0.9 or value <= 0 else f"{value / 10:.2f} cm"
    size = abs(value) * (1000 if made == "in mm" and field[0] in "va" else 1)
    if rng.random() < 0.1 and made != "in mm":
        unit, factor = {"v": ("cm/s", 100.0), "a": ("cm/s2", 100.0), "o": ("rot/min", 30 / pi)}.get(
            field[0], ("s^-2", 1.0)
        )
        return f"{float(f'{size * factor:.4g}'):.10g} {unit}"
    return np.format_float_positional(float(f"{size:.3g}"), trim="-").replace(
        ".", rng.choice([".", ","])
    )
