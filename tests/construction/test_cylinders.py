"""Dyads of which the bars are driven cylinders: their plans by what the lengths' rates say."""

from itertools import product
from pathlib import Path

import numpy as np
import pytest

from graphkin.diagnosis.closures import choices
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


def test_a_platform_closes_in_all_six_ways_that_elimination_finds():
    """Hunt; Gosselin and Merlet: D follows linearly from two legs' difference, at each angle of the
    plate; the third then is a polynomial of the sixth degree in the tangent of half that angle."""
    mechanism = load(SCENES / "platform-six.toml")
    a, b, c = (0, 0.24), (0.26, 0.29), (0.1 + 0.24j, 0.19)
    edge = 0.3
    x = (edge**2 + 0.14**2 - 0.18**2) / (2 * edge)
    corner = x + 1j * np.sqrt(0.14**2 - x**2)

    def eliminated(angle):
        """D by the two linear equations, and what the first leg misses, times the determinant."""
        turn = np.exp(1j * angle)
        one, two = b[0] - turn * edge, c[0] - turn * corner
        r, s = (
            (a[1] ** 2 - length**2 + abs(z) ** 2) / 2 for z, (_, length) in ((one, b), (two, c))
        )
        det = (np.conj(one) * two).imag
        place = (r * two.imag - s * one.imag) + 1j * (one.real * s - two.real * r)
        return place, det, abs(place) ** 2 - (a[1] * det) ** 2

    grid = np.linspace(0, 2 * np.pi, 7201)
    missed = eliminated(grid)[2]
    places = []
    for n in np.flatnonzero(np.diff(np.sign(missed))):
        low, high = grid[n], grid[n + 1]
        for _ in range(60):
            middle = (low + high) / 2
            same = np.sign(eliminated(middle)[2]) == np.sign(missed[n])
            low, high = (middle, high) if same else (low, middle)
        place, det, _ = eliminated(low)
        places.append(place / det)
    assert len(places) == 6
    (choice,) = choices(mechanism.scene, mechanism.groups, mechanism.program)
    assert len(choice.closures) == 6
    text = (SCENES / "platform-six.toml").read_text(encoding="utf-8")
    found = []
    for number in range(1, 7):
        one = Mechanism(read_text(text.replace("closure 3", f"closure {number}"), "six"))
        solution = one.solve()
        assert one.witness(solution).agrees
        found.append(solution.points["D"].position)
        nearest = min(places, key=lambda z: abs(z - found[-1]))
        assert found[-1] == pytest.approx(nearest, rel=1e-8)
    assert len({complex(round(z.real, 6), round(z.imag, 6)) for z in found}) == 6
