"""Wheels whose angles are rounded before they are reduced: the digits told are those that hold.

Angles in radians, radii that are irrational or parameters, several wheels of a link, straight
tracks; the truth by Willis in decimals of 60 digits.
"""

from __future__ import annotations

import mpmath
import pytest

from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from tests.scene_files import scene_text

MP = mpmath.mp.clone()
MP.dps = 60
TURNS = (10**3, 10**6, 10**9, 10**12, 10**13, 10**14, 10**15)
DRIVER = 'speed = 1\nacceleration = "0.3"\n'
RADII = {
    "fractions": (("3/10", "7/10", "1/5", "9/10"), [MP.mpf(n) / 10 for n in (3, 7, 2, 9)]),
    "roots": (
        ("sqrt(2)/2", "sqrt(3)", "1/2", "pi"),
        [MP.sqrt(2) / 2, MP.sqrt(3), MP.mpf(1) / 2, MP.pi],
    ),
    "parameters": (("r", "q/10", "1/5", "2*r"), [MP.mpf(n) / 10 for n in (3, 7, 2, 6)]),
}


def written(parts: str, radii: tuple[str, ...], unit: str, **numbers: str) -> str:
    for name, text in (*zip("ABCD", radii, strict=True), *numbers.items()):
        parts = parts.replace(f'"{name}"', f'"{text}"') if name in "ABCD" else parts
        parts = parts.replace(name, text) if name in numbers else parts
    parts = parts.replace("A+B+C+D", "+".join(radii)).replace("A+B", "+".join(radii[:2]))
    units = f'units = {{ length = "m", angle = "{unit}", speed = "rad/s" }}'
    return f'graphkin = 1\ntitle = "t"\n{units}\n[parameters]\nr = 0.3\nq = 7\n{parts}{DRIVER}'


def train(radii, angle) -> dict[str, object]:
    """Where the rims stand."""
    a, b, c, d = radii
    second = -angle * a / b
    return {
        "R1": a * MP.expj(angle),
        "R2": a + b + b * MP.expj(second),
        "R3": a + b + c + d + d * MP.expj(-second * c / d),
    }


def held(text: str, truth: dict[str, object]) -> int:
    """The digits of positions, which all hold; those of which none is sure are named."""
    mechanism = Mechanism(read_text(text, "wheels", None, {}))
    solution = mechanism.solve()
    verdict = mechanism.witness(solution)
    assert verdict.agrees, verdict
    size = max(abs(a - b) for a in truth.values() for b in (*truth.values(), 0))
    for name, true in truth.items():
        if f"points.{name}.position" in verdict.unsure:
            continue
        error = abs(MP.mpc(solution.points[name].position) - true)
        assert error <= verdict.limit * size
        assert error <= MP.mpf(10) ** -verdict.digits["position"] * abs(true)
    assert verdict.digits["position"] > 0 or verdict.unsure
    return verdict.digits["velocity"]


@pytest.mark.parametrize("unit", ["deg", "rad"])
@pytest.mark.parametrize("radii", RADII)
def test_the_digits_of_a_train_are_those_that_hold(radii, unit):
    texts, numbers = RADII[radii]
    told = []
    for turns in TURNS:
        degrees = 360 * turns + 50
        angle = degrees * MP.pi / 180 if unit == "deg" else MP.mpf(int(6.28 * turns))
        text = str(degrees if unit == "deg" else int(angle))
        told.append(
            held(
                written(scene_text("stress/train"), texts, unit, ANGLE=text), train(numbers, angle)
            )
        )
    assert told == sorted(told, reverse=True)
    assert told[0] >= 9, "after a thousand turns hardly any digit is lost"
    assert told[-1] == 0, "after 1e15 turns all are"


@pytest.mark.parametrize("radii", RADII)
def test_the_digits_of_a_wheel_on_a_track_are_those_that_hold(radii):
    texts, (radius, *_) = RADII[radii]
    for turns in TURNS:
        way = MP.mpf(2 * turns)
        truth = {
            "O": MP.mpc(way, radius),
            "R1": MP.mpc(way, radius) + radius * MP.expj(-way / radius),
        }
        held(written(scene_text("stress/track"), texts, "deg", WAY=str(2 * turns)), truth)
