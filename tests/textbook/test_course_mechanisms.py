"""Mechanisms of every course against their closed forms: straight lines, indexing, tangent cams."""

from __future__ import annotations

import math
from fractions import Fraction
from pathlib import Path

import pytest

from graphkin.mechanism import Mechanism, load
from tests.textbook.book import RPM, within

FOLDER = Path(__file__).parents[2] / "examples" / "scenes"


def at(name: str, angle: float) -> Mechanism:
    """A shipped scene with its driver at an angle (degrees)."""
    return load(FOLDER / f"{name}.toml", angle=Fraction(angle))


@pytest.mark.parametrize("angle", range(65, 116, 10))
def test_the_tangent_cam_lifts_as_its_flank_says(angle):
    """Khurmi, chapter 20: v = ωr sin θ/cos² θ, a = ω²r(2 - cos² θ)/cos³ θ, r = r1 + r2."""
    found = at("cam-tangent", angle).solve().slides["3"]
    theta, omega, radius = math.radians(angle - 90), 600 * RPM, 0.05
    cosine = math.cos(theta)
    assert within(found.position, radius / cosine, 1e-13)
    assert found.speed == pytest.approx(omega * radius * math.sin(theta) / cosine**2, abs=1e-12)
    expected = omega**2 * radius * (2 - cosine**2) / cosine**3
    assert within(found.acceleration, expected, 1e-11)


@pytest.mark.parametrize("angle", range(-40, 41, 10))
def test_the_geneva_wheel_turns_by_its_closed_form(angle):
    """Norton, Design of Machinery: ω₂/ω₁ = λ(cos φ - λ)/(1 - 2λ cos φ + λ²), λ = sin(π/4)."""
    found = at("geneva-wheel", angle).solve().links["3"]
    phi, omega, ratio = math.radians(angle), 60 * RPM, math.sin(math.pi / 4)
    below = 1 - 2 * ratio * math.cos(phi) + ratio**2
    assert within(found.omega, -omega * ratio * (math.cos(phi) - ratio) / below, 1e-12)
    bent = omega**2 * ratio * math.sin(phi) * (1 - ratio**2) / below**2
    assert found.epsilon == pytest.approx(bent, rel=1e-11, abs=1e-11)


@pytest.mark.parametrize("angle", range(50, 311, 130))
def test_the_geneva_wheel_dwells_while_the_disc_is_in_its_hollow(angle):
    """Norton: pin and disc turn freely, the wheel stands, and both arcs lie on one circle."""
    found = at("geneva-dwell", angle)
    motion, scene = found.solve(), found.scene
    assert motion.links["2"].omega == motion.links["2"].epsilon == 0
    assert within(abs(motion.points["P"].velocity), 0.05 * 60 * RPM, 1e-12)
    ends = [profile for link in scene.links.values() for profile in link.profiles]
    radii = [abs(motion.points[each.through].position) for each in ends]
    assert radii == pytest.approx([0.035, 0.035])
    assert found.witness(motion).agrees


@pytest.mark.parametrize("angle", range(-50, 51, 20))
def test_peaucellier_s_inversor_draws_a_straight_line(angle):
    """OP·OQ = OA² - AP², so that Q keeps the distance (OA² - AP²)/(2·OC) from O."""
    points = at("peaucellier", angle).solve().points
    o, p, q = (points[name].position for name in "OPQ")
    assert within(abs(p - o) * abs(q - o), 0.12**2 - 0.06**2, 1e-12)
    assert within(q.real, (0.12**2 - 0.06**2) / 0.1, 1e-12)
    assert abs(points["Q"].velocity.real) < 1e-13
    assert abs(points["Q"].acceleration.real) < 1e-12


def test_chebyshev_s_coupler_runs_nearly_straight():
    """Cranks 5, frame 4, coupler 2: M runs 4/5 of a crank high, to 0.3 % over half the stroke."""
    for angle in (40, 50, 60, 70, 80, 90):
        point = at("chebyshev", angle).solve().points["M"]
        assert within(point.position.imag, 0.08, 0.003)
        assert abs(point.velocity.imag) < 0.02 * abs(point.velocity.real)


@pytest.mark.parametrize("angle", range(20, 360, 45))
def test_the_lever_gear_follows_willis_about_the_rocker(angle):
    """(ω₄ - ω₃)/(ω₂ - ω₃) = -r₂/r₄ with wheel 2 on the coupler and the rocker 3 as arm."""
    links = at("gears-lever", angle).solve().links
    turned = (links["4"].omega - links["3"].omega) / (links["2"].omega - links["3"].omega)
    assert within(turned, -40 / 50, 1e-10)
