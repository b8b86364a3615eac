"""Dyads of which the bars are driven cylinders: their plans by what the lengths' rates say."""

from itertools import product
from pathlib import Path

import numpy as np
import pytest

from graphkin.mechanism import Mechanism, load
from graphkin.scene.read_scene import read_text
from graphkin.structure.decomposition import decompose
from graphkin.structure.groups import Stretched

SCENES = Path(__file__).resolve().parents[2] / "examples" / "scenes"

TWO = """
graphkin = 1
title = "two cylinders"
units = {{ length = "m", angle = "rad", speed = "rad/s" }}
[frame]
A = [0, 0]
D = [{base}, 0]
{first}
{second}
[branches]
B = "{side} of A-D"
"""
TUBE_ON_PIN = """
[links.{near}]
{pin} = [0, 0]
[links.{far}]
B = [0, 0]
slides = {{ on = {near}, through = "{pin}", angle = 0 }}
[[drivers]]
slide = {far}
against = {near}
"""
ROD_ON_PIN = """
[links.{far}]
B = [0, 0]
[links.{near}]
{pin} = [0, 0]
slides = {{ on = {far}, through = "B", angle = 0 }}
[[drivers]]
slide = {near}
against = {far}
"""
"""A cylinder with its tube on the known pin, or with its rod there and the tube at B."""


def cylinder(form, pin, near, far, length, speed, acceleration):
    """One cylinder of the scene: the block stands ahead of the guide's point."""
    head = form.format(pin=pin, near=near, far=far)
    return f"{head}position = {length}\nspeed = {speed}\nacceleration = {acceleration}\n"


@pytest.mark.parametrize("forms", [*product((TUBE_ON_PIN, ROD_ON_PIN), repeat=2)])
@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("side", ["left", "right"])
def test_rates_of_both_lengths(forms, size, side):
    """Along each cylinder v·e = L', and a·e = L" - L ω², with ω = (e x v) / L about a fixed pin."""
    lengths, rates, seconds = (
        (2.5 * size, 2.2 * size),
        (0.7 * size, -0.4 * size),
        (0.3 * size, size),
    )
    parts = [
        cylinder(form, pin, *links, *given)
        for form, pin, links, given in zip(
            forms, "AD", ((1, 2), (3, 4)), zip(lengths, rates, seconds, strict=True), strict=True
        )
    ]
    scene = read_text(TWO.format(base=3 * size, first=parts[0], second=parts[1], side=side), "two")
    assert [type(group) for group in decompose(scene)] == [Stretched]
    mechanism = Mechanism(scene)
    solution = mechanism.solve()
    assert mechanism.witness(solution).agrees
    found = solution.points["B"]
    assert (found.position.imag > 0) == (side == "left")
    for pin, link, length, rate, second in zip(
        (0, 3 * size), ("1", "3"), lengths, rates, seconds, strict=True
    ):
        way = found.position - pin
        along = way / abs(way)
        omega = (along.conjugate() * found.velocity).imag / length
        assert abs(way) == pytest.approx(length, rel=1e-12)
        assert (along.conjugate() * found.velocity).real == pytest.approx(rate, rel=1e-11)
        assert (along.conjugate() * found.acceleration).real == pytest.approx(
            second - length * omega**2, rel=1e-10, abs=1e-10 * size
        )
        assert solution.links[link].omega == pytest.approx(omega, rel=1e-11)


def test_platform_on_three_cylinders():
    """3-RPR: each leg is as long as its driver says, and the plate moves as a rigid body."""
    mechanism = load(SCENES / "platform-3rpr.toml")
    solution = mechanism.solve()
    assert mechanism.witness(solution).agrees
    legs = {"D": (0, 0.18, 0.1), "E": (0.4, 0.17, -0.06), "F": (0.2 + 0.35j, 0.19, 0.03)}
    rows, values = [], []
    for name, (foot, length, rate) in legs.items():
        point = solution.points[name]
        way = point.position - foot
        along = way / abs(way)
        assert abs(way) == pytest.approx(length, rel=1e-12)
        arm = point.position - solution.points["D"].position
        rows.append([along.real, along.imag, (along.conjugate() * 1j * arm).real])
        values.append(rate)
        assert (along.conjugate() * point.velocity).real == pytest.approx(rate, rel=1e-11)
    vx, vy, omega = np.linalg.solve(rows, values)
    assert solution.points["D"].velocity == pytest.approx(complex(vx, vy), rel=1e-10)
    assert solution.links["7"].omega == pytest.approx(omega, rel=1e-10)
