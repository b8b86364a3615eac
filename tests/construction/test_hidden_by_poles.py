"""Closures of a rapid return as its crank passes the upright guide, parallel to lines of a trial.

The independent count: with P at a height on the guide, Q on the line PA gives a polynomial of
degree four in that height, whose roots have 60 digits.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import mpmath
import pytest

from graphkin.diagnosis.closures import choices
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text

SCENE = Path(__file__).resolve().parents[2] / "examples" / "scenes" / "rapid-return.toml"
MP = mpmath.mp.clone()
MP.dps = 60


def heights(angle: Any) -> list[Any]:
    """How high P stands (m) in every closure at an angle of the crank."""
    a, along, start = 48 * MP.expj(MP.radians(angle)), MP.expjpi(MP.mpf(10) / 180), MP.mpc(0, 160)

    def missed(height: Any) -> Any:
        p = MP.mpc(0, height)
        divisor = (MP.conj(along) * (a - p)).imag
        way = (start - p) * divisor - (MP.conj(start - p) * (a - p)).imag * along
        return abs(way) ** 2 - (288 * divisor) ** 2

    nodes = [MP.mpf(node) for node in (-200, -100, 0, 100, 200)]
    rows = MP.matrix([[node**power for power in range(5)] for node in nodes])
    factors = list(MP.lu_solve(rows, MP.matrix([missed(node) for node in nodes])))
    found = MP.polyroots(factors, maxsteps=500, extraprec=400, asc=True)
    return sorted(root.real / 1000 for root in found if abs(root.imag) < MP.mpf("1e-20"))


def mechanism(angle: str, number: int) -> Mechanism:
    """The scene with another angle of its crank and another closure."""
    text = SCENE.read_text(encoding="utf-8")
    text = re.sub(r"\nangle = 35", f'\nangle = "{angle}"', text)
    text = re.sub(r'"closure \d"', f'"closure {number}"', text)
    return Mechanism(read_text(text, "made", None, {}))


@pytest.mark.parametrize(
    ("upright", "side", "offset"), [(90, -1, "0.1"), (270, 1, "1e-4"), (90, -1, "1e-9")]
)
def test_every_closure_is_listed_and_has_its_number(upright, offset, side):
    angle = MP.nstr(upright + side * MP.mpf(offset), 40)
    rounded = 1e-9 + 2e-13 / float(offset)
    expected = [float(height) for height in heights(MP.mpf(angle))]
    assert len(expected) == 4
    asked = mechanism(angle, 1)
    (choice,) = choices(asked.scene, asked.groups, asked.program)
    assert len(choice.closures) == 4
    found = [
        mechanism(angle, number).trace([("position", "P")]).value("position", "P")
        for number in range(1, 5)
    ]
    assert sorted(place.imag for place in found) == pytest.approx(expected, abs=rounded)
