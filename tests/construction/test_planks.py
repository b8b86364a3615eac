"""Planks on two rollers of different sizes: a wheel that must not slip closes the group."""

from __future__ import annotations

from cmath import exp
from functools import cache
from math import atan, cos

import mpmath
import pytest

from graphkin.construction.core.kind import constructions
from graphkin.construction.higher_class.two_trials import TwoTrials
from graphkin.mechanism import Mechanism, load
from graphkin.scene.read_scene import read_text
from graphkin.structure.driver_count import count
from graphkin.structure.groups import Higher
from graphkin.structure.pairs import Contact
from tests.chosen import FOLDER


@cache
def example(name, **settings):
    """A scene of the examples."""
    return load(FOLDER / f"{name}.toml", **settings)


@pytest.mark.parametrize("name", ["plank-two-sizes", "plank-axle"])
def test_a_contact_closes_the_group(name):
    one = example(name)
    (group,) = (each for each in one.groups if isinstance(each, Higher))
    assert isinstance(group.last, Contact)
    assert group.last.links == ("2", "3")
    assert count(one.scene).mobility == 1
    assert one.witness(one.solve()).agrees


@pytest.mark.parametrize("name", ["plank-two-sizes", "plank-axle"])
def test_the_trials_slip_and_the_right_plan_does_not(name):
    """Across the radius both points of contact have one velocity, and one acceleration."""
    trace = example(name).trace()
    both = list(constructions(trace.program, TwoTrials))
    sizes = [[float(trace.values[gap.size]) for gap in each.gaps] for each in both]
    assert len(sizes) == 2
    for trials, (first, second) in zip(both, sizes, strict=True):
        assert abs(first - second) > 1e-6
        share = float(trace.values[trials.share])
        assert first + share * (second - first) == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("v", [50, 100, 200])
def test_on_the_floor_it_does_not_tip(v):
    """Its slope is 2·atan((r2 - r1)/Δx), by which 2·Δx = 600 - (r2 - r1)·β from the start, and it
    goes with twice the rollers' v·cos(β/2), at half the slope.
    """
    found = example("plank-two-sizes", v=v).solve()
    apart = 0.3
    for _ in range(60):
        slope = 2 * atan(0.03 / apart)
        apart = (0.6 - 0.03 * slope) / 2
    c, d, p, q = (found.points[name] for name in "CDPQ")
    assert d.position - c.position == pytest.approx(complex(apart, 0.03), abs=1e-12)
    assert q.position - p.position == pytest.approx(0.4 * exp(1j * slope), abs=1e-12)
    assert d.velocity == pytest.approx(c.velocity, abs=1e-12)
    assert d.acceleration == pytest.approx(c.acceleration, abs=1e-12)
    way = 2 * cos(slope / 2) * exp(0.5j * slope)
    assert q.velocity == pytest.approx(v / 1000 * way, abs=1e-12)
    assert q.acceleration == pytest.approx(0.04 * way, abs=1e-12)
    assert found.links["3"].omega == pytest.approx(0, abs=1e-12)
    assert found.links["3"].epsilon == pytest.approx(0, abs=1e-11)


@pytest.mark.parametrize("phi", [-40, 20, 80])
def test_on_an_axle_and_the_floor_it_tips_as_both_arcs_say(phi):
    """sin β = (r2 - r1)/x, and the way between the contacts is what both rollers rolled off it.

    Derivatives by x and φ of these two equations, in fifty digits.
    """
    found = example("plank-axle", phi=phi).solve()
    small, large = mpmath.mpf("0.045"), mpmath.mpf("0.09")

    def slope(x):
        return mpmath.asin((large - small) / x)

    def missed(x, turn):
        rolled = -(x - mpmath.mpf("0.3")) / large
        first = small * (turn - slope(x) - mpmath.pi / 3)
        second = mpmath.mpf("0.3") + large * (rolled - slope(x))
        return second - first - x * mpmath.cos(slope(x))

    with mpmath.workdps(50):

        def centre(t):
            turn = mpmath.radians(phi) - 4 * t
            return mpmath.findroot(lambda x: missed(x, turn), mpmath.mpf("0.3"))

        place, speed, rate = (mpmath.diff(centre, 0, n) if n else centre(0) for n in range(3))
        tilt = slope(place)
        tipping = [mpmath.diff(lambda t: slope(centre(t)), 0, n) for n in (1, 2)]
    d, p, q = (found.points[name] for name in "DPQ")
    for got, want in zip(
        (d.position, d.velocity, d.acceleration), (place, speed, rate), strict=True
    ):
        assert got == pytest.approx(complex(want), abs=1e-9)
    assert q.position - p.position == pytest.approx(0.4 * exp(1j * float(tilt)), abs=1e-11)
    assert found.links["3"].omega == pytest.approx(float(tipping[0]), abs=1e-9)
    assert found.links["3"].epsilon == pytest.approx(float(tipping[1]), abs=1e-8)
    assert found.links["2"].omega == pytest.approx(float(-speed / large), abs=1e-9)


def test_a_driven_bar_pushes_a_roller_that_it_slips_on():
    """Hibbeler 16-50 the other way round: the bar is turned and the roller goes with it."""
    text = (FOLDER / "plank-hinged.toml").read_text(encoding="utf-8")
    old = 'roll = 1\nposition = "50/tan(theta/2)"\nspeed = -100\n'
    assert old in text
    text = text.replace(old, 'turn = 2\nangle = "theta"\nspeed = 1\n')
    text = text.replace('[branches]\n3 = "forward"\n', "")
    one = Mechanism(read_text(text, "pushed"))
    found = one.solve()
    assert one.witness(found).agrees
    assert found.links["1"].omega == pytest.approx(2.0, abs=1e-12)
    assert found.points["C"].velocity == pytest.approx(-0.1, abs=1e-12)
