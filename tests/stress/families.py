"""Random scenes, log-scaled, with their true motion in decimals of 60 digits, by formulas alone."""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import mpmath

from tests.stress.cases import HEAD
from tests.stress.closed import Moving, Turning, cranked, fixed, turning, two_bars

DIGITS = mpmath.workdps(60)


@dataclass(frozen=True)
class Truth:
    """The text of a scene, the motion of its points, and ω and ε of its links."""

    text: str
    points: dict[str, Moving]
    rates: dict[str, Turning]


def written(x: Any) -> str:
    """A number with so many digits that the scene has it as the truth does."""
    return str(mpmath.nstr(x, 56, strip_zeros=False))


def rounded(x: Any, digits: int = 50) -> Any:
    """A number that can be written."""
    return mpmath.mpf(mpmath.nstr(x, digits))


def power(rng: random.Random, low: float, high: float) -> Any:
    """A power of ten, evenly spread in its logarithm."""
    return rounded(mpmath.mpf(10) ** rng.uniform(low, high), 6)


@DIGITS
def chain(rng: random.Random, count: int) -> Truth:
    """A crank and a chain of flat dyads, the sine at each pin from 1e-3 to 1e-1."""
    omega, epsilon = mpmath.mpf(1), mpmath.mpf("0.3")
    last, name = cranked(fixed(0), 1, mpmath.mpf(40), omega, epsilon), "A"
    points, rates = {"A": last}, {"1": Turning(omega, epsilon)}
    frame, links, sides = "O1 = [0, 0]\n", "[links.1]\nO1-A = 1\n", ""
    for i in range(1, count + 1):
        a, b = (mpmath.mpf(rng.randint(8, 15)) / 10 for _ in range(2))
        sine, side = mpmath.mpf(10) ** rng.uniform(-3, -1), rng.choice([1, -1])
        folded = -1 if abs(a - b) > 0.25 and rng.random() < 0.4 else 1
        apart = mpmath.sqrt(a * a + b * b + folded * 2 * a * b * mpmath.sqrt(1 - sine**2))
        foot = last.place + apart * mpmath.expj(rng.uniform(0, 6.28))
        pivot, pin = fixed(rounded(foot.real), rounded(foot.imag)), f"B{i}"
        foot, (found, _) = pivot.place, two_bars(last, pivot, a, b, side)
        frame += f'Q{i} = ["{written(foot.real)}", "{written(foot.imag)}"]\n'
        links += f'[links.{2 * i}]\n{name}-{pin} = "{written(a)}"\n'
        links += f'[links.{2 * i + 1}]\nQ{i}-{pin} = "{written(b)}"\n'
        sides += f'{pin} = "{"left" if side > 0 else "right"} of {name}-Q{i}"\n'
        points[pin] = found
        rates |= {f"{2 * i}": turning(last, found), f"{2 * i + 1}": turning(pivot, found)}
        last, name = found, pin
    driver = '[[drivers]]\nturn = 1\nangle = 40\nspeed = 1\nacceleration = "0.3"\n'
    text = f"{HEAD}[frame]\n{frame}{links}{driver}[branches]\n{sides}"
    return Truth(text, points, rates)


@DIGITS
def four_bar(rng: random.Random, scale: float, sine: float) -> Truth:
    """Bars of 1e±scale m, the sine at the rocker's pin down to 1e-sine."""
    rate = Turning(mpmath.mpf(1), mpmath.mpf("0.5"))
    while True:
        crank, coupler, rocker = (power(rng, -scale, scale) for _ in range(3))
        angle = rounded(mpmath.mpf(rng.uniform(5, 175)))
        pin = cranked(fixed(0), crank, angle, *rate)
        s = mpmath.mpf(10) ** rng.uniform(-sine, -0.01)
        cosine = rng.choice([1, -1]) * mpmath.sqrt(1 - s * s)
        square = coupler**2 + rocker**2 - 2 * coupler * rocker * cosine - pin.place.imag**2
        if square > 0:
            break
    side = rng.choice([1, -1])
    foot = fixed(rounded(pin.place.real + rng.choice([1, -1]) * mpmath.sqrt(square), 55))
    found, _ = two_bars(pin, foot, coupler, rocker, side)
    text = (
        f'{HEAD}[frame]\nO1 = [0, 0]\nO2 = ["{written(foot.place.real)}", 0]\n'
        f'[links.1]\nO1-A = "{written(crank)}"\n[links.2]\nA-B = "{written(coupler)}"\n'
        f'[links.3]\nO2-B = "{written(rocker)}"\n[[drivers]]\nturn = 1\n'
        f'angle = "{written(angle)}"\nspeed = 1\nacceleration = "0.5"\n'
        f'[branches]\nB = "{"left" if side > 0 else "right"} of A-O2"\n'
    )
    rates = {"1": rate, "2": turning(pin, found), "3": turning(foot, found)}
    return Truth(text, {"A": pin, "B": found}, rates)


@DIGITS
def gears(rng: random.Random, span: float) -> Truth:
    """One to three wheels on a first one, radii of 1e±span m, all on an arm that turns."""
    radii = [power(rng, -span, span) for _ in range(rng.randint(2, 4))]
    places = [sum(radii[:i], mpmath.mpf(0)) * 2 + radii[i] - radii[0] for i in range(len(radii))]
    speed, lead = power(rng, -3, 3), mpmath.mpf(rng.randint(1, 9))
    arm, wheel = (mpmath.mpf(0), lead, mpmath.mpf(2)), (mpmath.mpf(60), speed, mpmath.mpf(1))
    text = f"{HEAD}[frame]\nO = [0, 0]\n[links.arm]\nO = [0, 0]\n"
    text += "".join(f'P{i} = ["{written(x)}", 0]\n' for i, x in enumerate(places) if i)
    points: dict[str, Moving] = {}
    rates = {"arm": Turning(*arm[1:])}
    for i, radius in enumerate(radii):
        centre = f"P{i}" if i else "O"
        text += f'[links.w{i}]\n{centre} = [0, 0]\nT{i} = ["{written(radius)}", 0]\n'
        text += f'wheel = {{ centre = "{centre}", radius = "{written(radius)}" }}\n'
        if i:
            text += f'rolls = {{ on = "w{i - 1}" }}\n'
            ratio = radii[i - 1] / radius
            wheel = tuple(a - (w - a) * ratio for w, a in zip(wheel, arm, strict=True))
        carried = cranked(fixed(0), places[i], *arm)
        rim = cranked(fixed(0), radius, *wheel)
        points[f"T{i}"] = Moving(*(a + b for a, b in zip(carried, rim, strict=True)))
        rates[f"w{i}"] = Turning(*wheel[1:])
    text += f'[[drivers]]\nturn = "w0"\nangle = 60\nspeed = "{written(speed)}"\nacceleration = 1\n'
    text += f'[[drivers]]\nturn = "arm"\nangle = 0\nspeed = "{written(lead)}"\nacceleration = 2\n'
    return Truth(text, points, rates)


FAMILIES: dict[str, Callable[[random.Random], Truth]] = {
    **{f"{n} flat dyads": lambda rng, n=n: chain(rng, n) for n in range(1, 7)},
    "four-bars to the dead point": lambda rng: four_bar(rng, 0.5, 9),
    "four-bars of bars 1e-6 to 1e6": lambda rng: four_bar(rng, 6, 7),
    "wheels of radii 1e-6 to 1e6": lambda rng: gears(rng, 6),
}


@DIGITS
def errors(solution: Any, truth: Truth) -> dict[str, float]:
    """True errors over the largest of their kind, as the witness counts, by the quantity's name."""
    places = [abs(a[0] - b[0]) for a in truth.points.values() for b in truth.points.values()]
    length = max([*places, *(abs(complex(p.position)) for p in solution.points.values())])
    speed, push = (max(abs(p[n]) for p in truth.points.values()) for n in (1, 2))
    turn, twist = (max(abs(r[n]) for r in truth.rates.values()) for n in (0, 1))
    natural = max(speed**2 / length, turn**2 * length)
    scales = {
        "position": length,
        "velocity": max(speed, turn * length / 1000),
        "acceleration": max(push, natural / 1000, twist * length / 1000),
        "omega": max(turn, speed / length / 1000),
        "epsilon": max(twist, natural / length / 1000, push / length / 1000),
    }
    found = {}
    for name, motion in truth.points.items():
        for key, value in zip(("position", "velocity", "acceleration"), motion, strict=True):
            ours = getattr(solution.points[name], key)
            found[f"points.{name}.{key}"] = float(abs(mpmath.mpc(ours) - value) / scales[key])
    for name, rate in truth.rates.items():
        for key, value in zip(("omega", "epsilon"), rate, strict=True):
            ours = getattr(solution.links[name], key)
            found[f"links.{name}.{key}"] = float(abs(ours - value) / scales[key])
    return found
