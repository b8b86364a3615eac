"""What the courses state of linkages of bars and pins, and of open chains."""

from __future__ import annotations

import mpmath
import pytest

from graphkin.structure.driver_count import count
from tests.examples.scenes import (
    acceleration,
    carried,
    degrees,
    follows,
    mechanism,
    meeting,
    motion,
    omega,
    place,
    proved,
    rates,
    same,
    unit,
    varied,
    velocity,
)

FOUR_BARS = {
    "four-bar-crank-rocker": ("crank-rocker", 50, 120, 90, 130, 60, 10, 20, 1),
    "four-bar-crank-rocker-crossed": ("crank-rocker", 50, 120, 90, 130, 60, 10, 20, -1),
    "four-bar-double-crank": ("double crank", 100, 120, 110, 50, 75, 10, 0, 1),
    "four-bar-double-rocker": ("double rocker", 90, 50, 100, 120, 55, 5, 0, 1),
    "four-bar-triple-rocker": ("triple rocker", 70, 80, 90, 130, 70, 5, 0, 1),
    "four-bar-change-point": ("change point", 70, 130, 70, 130, 70, 10, 0, 1),
}
"""Grashof's class, AB, BC, DC, AD, q, q′, q″ and the side of C seen from B to D."""


# --- four-bar ------------------------------------------------------------------------------------


@pytest.mark.parametrize("other", [False, True], ids=["as written", "the other closure"])
@pytest.mark.parametrize("name", FOUR_BARS)
def test_a_four_bar_moves_by_its_closed_form_in_both_closures(name: str, other: bool) -> None:
    _, ab, bc, dc, ad, q, speed, rate, side = FOUR_BARS[name]
    sides = ("left", "right") if side > 0 else ("right", "left")
    changes = [tuple(f'C = "{word} of B-D"' for word in sides)] if other else []
    found = proved(varied(name, *changes))
    side = -side if other else side

    def pin(q: mpmath.mpf) -> mpmath.mpc:
        return meeting(ab * unit(q), bc, mpmath.mpc(ad), dc, side)

    follows(found, "C", pin, (degrees(q), speed, rate))


# --- several loops -------------------------------------------------------------------------------


def test_the_lifter_is_solved_loop_after_loop() -> None:
    found = motion("lifter")
    a, d = mpmath.mpc(0), mpmath.mpc(320, -40)

    def hinge(q: mpmath.mpf) -> mpmath.mpc:
        return meeting(a + 260 * unit(q), 300, d, 280, 1)

    def beam(q: mpmath.mpf) -> mpmath.mpc:
        return meeting(580 * unit(q), 260, hinge(q), 330, 1)

    def load(q: mpmath.mpf) -> mpmath.mpc:
        end = 580 * unit(q)
        return end + (end - beam(q)) / 260 * 360

    drive = (degrees(65), "0.5", 0)
    follows(found, "C", hinge, drive)
    follows(found, "F", beam, drive)
    follows(found, "P", load, drive)
    assert [group.title for group in mechanism("lifter").groups[1:]] == ["dyad RRR"] * 2


@pytest.mark.parametrize(("word", "side"), [("left", 1), ("right", -1)])
def test_the_five_bar_moves_by_its_closed_form_in_both_closures(word: str, side: int) -> None:
    found = proved(varied("five-bar", ('C = "left of', f'C = "{word} of')))

    def pin(p: mpmath.mpf, q: mpmath.mpf) -> mpmath.mpc:
        return meeting(60 * unit(p), 130, 140 + 70 * unit(q), 115, side)

    follows(found, "C", pin, (degrees(115), 4, -2), (degrees(50), -3, 5))


# --- six-bars ------------------------------------------------------------------------------------

SIX_BARS = {
    "watt-1": ["dyad RRR", "dyad RRR"],
    "watt-1-ternary": ["dyad RRR", "dyad RRR"],
    "watt-2": ["dyad RRR", "dyad RRR"],
    "watt-2-centre": ["dyad RRR", "dyad RRR"],
    "stephenson-1": ["dyad RRR", "dyad RRR"],
    "stephenson-2-ternary": ["group of class III, order 3"],
    "stephenson-2-binary": ["group of class IV, order 2"],
    "stephenson-3": ["dyad RRR", "dyad RRR"],
    "stephenson-3-crank": ["group of class III, order 3"],
}


@pytest.mark.parametrize("name", SIX_BARS)
def test_a_six_bar_falls_into_its_groups(name: str) -> None:
    driver, *groups = mechanism(name).groups
    assert driver.title.startswith("driven")
    assert [group.title for group in groups] == SIX_BARS[name]
    assert count(mechanism(name).scene).mobility == 1


# --- mobility ------------------------------------------------------------------------------------


def test_the_coupler_of_three_parallel_cranks_moves_as_its_pin() -> None:
    found = motion("mobility-parallel-cranks")

    for point, shift in (("C", 110), ("F", 200)):
        follows(found, point, lambda q, by=shift: by + 60 * unit(q), (degrees(60), 10, 0))
    assert [omega(found, link) for link in (2, 3)] == pytest.approx([10, 10])
    assert abs(omega(found, 4)) < 1e-12


def test_a_five_bar_whose_second_driver_stands_moves_as_a_four_bar() -> None:
    found = motion("mobility-five-bar")

    def pin(q: mpmath.mpf) -> mpmath.mpc:
        return meeting(75 * unit(q), 105, 75 + 75 * unit(degrees(45)), 105, 1)

    follows(found, "C", pin, (degrees(120), 2, 0))
    assert abs(velocity(found, "D")) < 1e-15


# --- open chains ---------------------------------------------------------------------------------

T = mpmath.mpf
JUMP = {
    "A": (0.27, lambda t: 2 * t),
    "K": (0.48, lambda t: mpmath.pi - (20 * (t - T("0.15")) ** 2 + T("0.7"))),
    "H": (0.50, lambda t: 15 * (t - T("0.1")) ** 2 + T("0.6")),
    "C": (0.28, lambda t: mpmath.pi - (T("2.5") * t + T("0.4"))),
}
"""Each rod's upper end, its length (m) and its absolute angle at a time (s)."""
JUMP_STATED = {
    "A": (-0.2103 + 0.4974j, -0.9947 - 0.4206j),
    "K": (0.4441 + 1.1998j, 13.498 + 12.319j),
    "H": (-0.5784 + 2.2973j, -0.0196 + 20.227j),
    "C": (-0.0300 + 2.7325j, 1.068 + 18.856j),
}
JUMP_PRINTED = {"A": -0.2 + 0.5j, "K": 0.5 + 1.2j, "H": -0.6 + 2.3j, "C": 0 + 2.7j}


@pytest.mark.parametrize("point", JUMP)
def test_the_jump_follows_its_laws_of_time(point: str) -> None:
    def law(t: mpmath.mpf) -> mpmath.mpc:
        ends = list(JUMP).index(point) + 1
        rods = list(JUMP.values())[:ends]
        return sum(1000 * T(repr(length)) * unit(turn(t)) for length, turn in rods)

    follows(motion("jumper"), point, law, ("0.2", 1, 0))


@pytest.mark.parametrize("point", JUMP)
def test_the_jump_has_the_digits_that_are_stated_and_printed(point: str) -> None:
    found = motion("jumper")
    (v, a), printed = JUMP_STATED[point], JUMP_PRINTED[point]
    close = {"abs": 0.5001e-4}, {"abs": 0.5001e-3}
    assert velocity(found, point).real == pytest.approx(v.real, **close[0])
    assert velocity(found, point).imag == pytest.approx(v.imag, **close[0])
    assert acceleration(found, point).real == pytest.approx(a.real, **close[1])
    assert acceleration(found, point).imag == pytest.approx(a.imag, **close[1])
    assert abs(velocity(found, point) - printed) < 0.08  # .44 is printed as .5


BOOM = (
    (5.7, lambda t: 40 + 12 * t - 3 * t**2),
    (2.9, lambda t: -35 - 25 * t + 2 * t**3),
    (1.5, lambda t: -95 - 60 * t + 8 * t**2),
)
"""Length (m) and absolute angle (°) of the excavator's links at a time (s)."""


@pytest.mark.parametrize("name", ["excavator-absolute", "excavator-relative"])
def test_the_excavator_moves_the_same_by_either_set_of_angles(name: str) -> None:
    for number, point in enumerate("ABC", 1):

        def law(t: mpmath.mpf, number: int = number) -> mpmath.mpc:
            return sum(
                1000 * T(repr(length)) * unit(degrees(turn(t))) for length, turn in BOOM[:number]
            )

        follows(motion(name), point, law, ("0.5", 1, 0))
    speeds = [rates(lambda t, turn=turn: degrees(turn(t)), ("0.5", 1, 0))[1] for _, turn in BOOM]
    for link, speed in zip(("boom", "stick", "bucket"), speeds, strict=True):
        assert same(omega(motion(name), link), speed)


@pytest.mark.parametrize("q", [40, 50, 70])
def test_hart_draws_a_straight_line(q: int) -> None:
    """OP·OR is constant, so that R goes square to OQ; its height is OR times the sine of OP."""
    found = motion("hart", angle=q)
    p, r = place(found, "P"), place(found, "R")
    assert same(abs(p) * abs(r), 0.4 * 0.6 * (0.2**2 - 0.12**2))
    assert same(velocity(found, "R").real, 0, abs(velocity(found, "R")))

    def point(q: mpmath.mpf) -> mpmath.mpc:
        p = 60 + 60 * unit(q)
        return -mpmath.mpf(6144) * p / abs(p) ** 2

    follows(found, "R", point, (degrees(q), 2, 0))


@pytest.mark.parametrize("q", [0, 40, 145, 300])
def test_the_die_of_a_link_motion_keeps_to_its_slot(q: int) -> None:
    """The slot's middle is an arc of 620 mm about Z: the die has no velocity across it."""
    found = motion("link-motion", angle=q)
    across = place(found, "V") - place(found, "Z")
    assert same(abs(across), 0.62)
    slip = velocity(found, "V") - carried(found, 4, "Z", place(found, "V"))
    assert abs((slip.conjugate() * across).real) < 1e-12
