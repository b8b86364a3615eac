"""What the courses state of wheels: on rails, between plates, on a driven rod, in gears."""

from __future__ import annotations

import cmath
import math

import mpmath
import pytest

from tests.examples.scenes import (
    acceleration,
    angle,
    carried,
    centre,
    crossing,
    degrees,
    epsilon,
    follows,
    meeting,
    motion,
    omega,
    place,
    rates,
    same,
    unit,
    velocity,
)

TURN = 2 * math.pi / 60
"""Rad/s of one turn a minute."""


# --- rails and plates ----------------------------------------------------------------------------


@pytest.mark.parametrize(("v", "a", "r"), [(400, 1000, 100), (600, 0, 60), (200, 2000, 140)])
def test_a_wheel_on_a_rail(v: int, a: int, r: int) -> None:
    found = motion("roller", v=v, a=a, r=r)
    v, a, r = v / 1000, a / 1000, r / 1000
    assert same(omega(found, 1), -v / r)
    assert same(epsilon(found, 1), -a / r, v / r)
    assert abs(velocity(found, "C")) < 1e-12
    assert same(velocity(found, "T"), 2 * v)
    assert same(velocity(found, "Q"), v - 1j * v)
    assert same(velocity(found, "P"), v + 1j * v)
    inwards = v**2 / r
    assert same(acceleration(found, "C"), 1j * inwards)
    assert same(acceleration(found, "T"), 2 * a - 1j * inwards)
    assert same(acceleration(found, "Q"), a - inwards - 1j * a)
    assert same(acceleration(found, "P"), a + inwards + 1j * a)
    assert abs(centre(found.links["1"].instant_centre)) < 1e-12


@pytest.mark.parametrize(("v_upper", "v_lower"), [(700, -300), (300, -900), (500, -500)])
def test_a_wheel_between_two_plates(v_upper: int, v_lower: int) -> None:
    found = motion("roller-plates", vU=v_upper, vL=v_lower)
    upper, lower, r = v_upper / 1000, v_lower / 1000, 0.1
    assert same(velocity(found, "O"), (upper + lower) / 2, 1)
    assert same(omega(found, 3), (lower - upper) / (2 * r))
    assert same(velocity(found, "A"), lower)
    assert same(velocity(found, "B"), upper)
    assert abs(acceleration(found, "O")) < 1e-12


@pytest.mark.parametrize("s", [-60, 40, 120])
def test_a_wheel_turns_about_its_contact(s: int) -> None:
    """The rail is the fixed centrode and the rim the moving one: the point s along either."""
    found = motion("centrodes-roller", s=s)
    contact = centre(found.links["1"].instant_centre)
    assert same(contact, s / 1000, 0.1)
    own = (contact - place(found, "O")) / (place(found, "P") - place(found, "O"))
    assert same(own, cmath.rect(1, -math.pi / 2 + s / 100))


def test_a_wheel_on_a_rod_of_changing_length() -> None:
    """x_C = r(90° - θ); the rod's length fixes θ, its rate θ′."""
    found = motion("rod-and-wheel", q=190)
    fixed = mpmath.mpc(-250, 40)

    def pin(theta: mpmath.mpf) -> mpmath.mpc:
        return 60 * (mpmath.pi / 2 - theta) + 60j + 40 * unit(theta)

    def turned(q: mpmath.mpf) -> mpmath.mpf:
        near = mpmath.mpf(cmath.phase(place(found, "B") - place(found, "C")))
        return mpmath.findroot(lambda theta: abs(pin(theta) - fixed) - q, near)

    drive = (190, 150, 0)
    follows(found, "B", lambda q: pin(turned(q)), drive)
    follows(found, "C", lambda q: 60 * (mpmath.pi / 2 - turned(q)) + 60j, drive)
    _, speed, rate = rates(turned, drive)
    assert same(omega(found, 3), speed)
    assert same(epsilon(found, 3), rate)
    way = place(found, "B") - place(found, "A")
    push = (
        0.19 * 0.15 / (way.conjugate() * 1j * (0.06j + place(found, "B") - place(found, "C"))).real
    )
    assert same(omega(found, 3), push)
    assert same(found.slides["2"].position, 0.19)


# --- gears ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(("q", "z"), [(30, 24), (0, 18), (345, 30)])
def test_a_pair_of_gears(q: int, z: int) -> None:
    found, w = motion("gears-pair", angle=q, z1=z), 60 * TURN
    assert same(omega(found, 2), -w * z / 40)
    pitch = 0.0025 * z
    assert same(carried(found, 1, "O1", pitch), carried(found, 2, "O2", pitch))
    shaft = 2.5 * (z + 40)

    def tip(q: mpmath.mpf) -> mpmath.mpc:
        return shaft + 70 * unit(degrees(120) - q * z / 40)

    follows(found, "B", tip, (degrees(q), 2 * mpmath.pi, 0))


@pytest.mark.parametrize("n", [-50, 0, 80])
def test_a_planet_on_an_arm(n: int) -> None:
    """Willis: the speeds seen from the arm are as the radii, turned about."""
    found, arm, sun = motion("gears-planet", n=n), 100 * TURN, n * TURN
    assert same(omega(found, 3), arm - 60 / 40 * (sun - arm))
    pitch = 0.06 * cmath.rect(1, math.radians(40))
    assert same(carried(found, 1, "O", pitch), carried(found, 3, "P", pitch), 1)

    def tip(arm: mpmath.mpf, sun: mpmath.mpf) -> mpmath.mpc:
        return 100 * unit(arm) + 40 * unit(arm - (sun - arm) * 3 / 2)

    turns = mpmath.pi / 30
    follows(found, "Q", tip, (degrees(40), 100 * turns, 0), (degrees(110), n * turns, 0))


@pytest.mark.parametrize("q", [0, 50, 200, 345])
def test_a_planet_in_a_fixed_ring(q: int) -> None:
    found, arm = motion("gears-ring", angle=q), 30 * TURN
    assert same(omega(found, 2), arm * (1 - 120 / 40))
    assert same(omega(found, 3), arm * (1 + 120 / 40))
    contact = 0.12 * cmath.rect(1, math.radians(q))
    assert same(centre(found.links["2"].instant_centre), contact)
    drive = (degrees(q), mpmath.pi, 0)
    follows(found, "Q", lambda q: 80 * unit(q) + 40 * unit(-2 * q), drive)
    follows(found, "S", lambda q: 40 * unit(4 * q), drive)


@pytest.mark.parametrize("q", [-60, 0, 40])
def test_a_rack_moves_as_the_rim_of_its_pinion(q: int) -> None:
    found = motion("gears-rack", angle=q)
    follows(found, "B", lambda q: 60 * q - 60j, (degrees(q), 5, 10))
    assert same(velocity(found, "B"), carried(found, 1, "O", -0.06j))


@pytest.mark.parametrize("q", [10, 25, 30])
def test_profiles_slide_by_the_distance_from_the_pitch_point(q: int) -> None:
    """The normal meets the line of centres in the pitch point I, where ω1·O1I = -ω2·O2I."""
    found = motion("gears-profiles", angle=q)
    pitch = crossing(place(found, "K1"), place(found, "K2"), 0j, 0.16 + 0j)
    one, two = omega(found, 1), omega(found, 2)
    assert same(one * pitch, -two * (0.16 - pitch))
    assert same(carried(found, 1, "O1", pitch), carried(found, 2, "O2", pitch))
    slip = velocity(found, "M@2") - velocity(found, "M@1")
    assert same(slip, 1j * (two - one) * (place(found, "M") - pitch))
    along = place(found, "K2") - place(found, "K1")
    assert abs((slip.conjugate() * along).real) < 1e-9 * abs(slip) * abs(along)


@pytest.mark.parametrize("q", [0, 30, 205])
def test_three_planets_turn_as_one(q: int) -> None:
    """Willis: with a fixed ring of 60 teeth and a sun of 20 the arm turns a quarter as fast."""
    found, sun = motion("gears-three-planets", angle=q), 120 * TURN
    assert same(omega(found, 2), sun / 4)
    for planet in (3, 4, 5):
        assert same(omega(found, planet), sun / 4 * (1 - 60 / 20))

    def rim(q: mpmath.mpf) -> mpmath.mpc:
        return 80 * unit(q / 4 + degrees(120)) + 40 * unit(-q / 2)

    follows(found, "B", rim, (degrees(q), 4 * mpmath.pi, 0))


@pytest.mark.parametrize("q", [0, 75, 300])
def test_ferguson_turns_one_wheel_backward_and_one_forward(q: int) -> None:
    """ω = ω_arm (1 - 100/z) for z = 99 and 101, whatever the idler of 20 teeth."""
    found = motion("gears-ferguson", angle=q)
    assert same(omega(found, 2), 10 * (1 + 100 / 20))
    assert same(omega(found, 3), -10 / 99)
    assert same(omega(found, 4), 10 / 101)


@pytest.mark.parametrize("q", [-30, 20, 30])
def test_a_sun_turns_by_twice_the_arm_less_the_rod(q: int) -> None:
    """Willis about the arm, for wheels of one size: ω4 - ω1 = -(ω2 - ω1), and so for ε."""
    found = motion("gears-sun-and-planet", angle=q)
    assert same(omega(found, 4), 2 * omega(found, 1) - omega(found, 2))
    assert same(epsilon(found, 4), 2 * epsilon(found, 1) - epsilon(found, 2))

    def centre_of_planet(q: mpmath.mpf) -> mpmath.mpc:
        beam_end = mpmath.mpc(-500, 900) + 700 * unit(q)
        return meeting(beam_end, 900, mpmath.mpc(0), 400, -1)

    follows(found, "C", centre_of_planet, (degrees(q), mpmath.mpf("-0.8"), 0))


def test_a_geared_five_bar_has_the_angles_that_norton_prints() -> None:
    """Norton, Design of Machinery, table P4-4, row a: 173.6° and -177.7°."""
    found = motion("geared-five-bar")
    assert math.degrees(angle(found, "A", "B")) == pytest.approx(173.6, abs=0.05)
    assert math.degrees(angle(found, "C", "B")) == pytest.approx(-177.7, abs=0.05)


@pytest.mark.parametrize("q", [0, 60, 200])
def test_a_geared_five_bar_follows_both_cranks(q: int) -> None:
    def coupler_pin(q: mpmath.mpf) -> mpmath.mpc:
        return meeting(10 * unit(q), 70, 60 + 40 * unit(2 * q + degrees(30)), 90, 1)

    follows(motion("geared-five-bar", angle=q), "B", coupler_pin, (degrees(q), 10, 0))


@pytest.mark.parametrize("way", [0, 50, 430])
def test_a_coupling_rod_moves_along_its_engine(way: int) -> None:
    """All its points have the velocity of the crank pins; the piston's way is a slider-crank's."""
    found = motion("locomotive", way=way)
    assert same(velocity(found, "A"), velocity(found, "B"))
    assert abs(omega(found, 4)) < 1e-12 and same(omega(found, 1), omega(found, 3))

    def piston(s: mpmath.mpf) -> mpmath.mpc:
        x, y = 30 * mpmath.cos(s / 80), -30 * mpmath.sin(s / 80)
        return s + 80j + x - mpmath.sqrt(250**2 - y * y)

    follows(found, "P", piston, (way, 1000, 0))


# --- a cam behind gears ---------------------------------------------------------------------------


@pytest.mark.parametrize("crank", [130, 180, 240, 290])
def test_a_crankshaft_lifts_a_tappet_at_half_its_speed(crank: int) -> None:
    """A cycloidal rise of 8 mm within 90° of the camshaft, after a dwell of 60°.

    The rod of the tappet and the rocker move by the law of cosines from there.
    """
    found = motion("valve-train", angle=crank)
    assert same(omega(found, "camshaft"), 750 * TURN)

    def tappet(phi: mpmath.mpf) -> mpmath.mpc:
        u = (phi - 60) / 90 if phi < 150 else (240 - phi) / 90
        return mpmath.mpc(0, 90 + 18 + 8 * (u - mpmath.sin(2 * mpmath.pi * u) / (2 * mpmath.pi)))

    def rocked(phi: mpmath.mpf) -> mpmath.mpc:
        way = tappet(phi) - mpmath.mpc(48, 330)
        far = abs(way)
        cosine = (far**2 + 50**2 - 205**2) / (2 * far * 50)
        return mpmath.mpc(48, 330) + 50 * way / far * (cosine - 1j * mpmath.sqrt(1 - cosine**2))

    drive = (mpmath.mpf(crank) / 2, 750 * 6, 0)
    follows(found, "T", tappet, drive)
    follows(found, "R", rocked, drive)


def test_a_plate_on_three_bars_moves_as_its_bars_allow() -> None:
    """The ends of each bar have the same velocity along it; the plate is rigid."""
    found = motion("platform-3rrr", angle=85)
    for pin, plate in ("AD", "BE", "CF"):
        along = place(found, plate) - place(found, pin)
        apart = velocity(found, plate) - velocity(found, pin)
        assert abs((apart * along.conjugate()).real) < 1e-12 * abs(along)
        assert same(velocity(found, plate), carried(found, 7, "D", place(found, plate)), 1)
    for pin, speed in (("A", 2), ("B", -1), ("C", 1.5)):
        assert same(abs(velocity(found, pin)), 0.13 * abs(speed))
