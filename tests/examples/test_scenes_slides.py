"""What the courses state of mechanisms with blocks: on fixed and moving guides, one and several."""

from __future__ import annotations

import math

import mpmath
import pytest

from graphkin.structure.driver_count import count
from tests.examples.scenes import (
    acceleration,
    angle,
    centre,
    degrees,
    epsilon,
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

TURN = 2 * math.pi / 60
"""Rad/s of one turn a minute."""


# --- blocks on moving guides ---------------------------------------------------------------------


@pytest.mark.parametrize("q", [0, 50, 115, 240, 345])
def test_the_bar_through_a_swivelling_block(q: int) -> None:
    """b = sqrt(c² + d² + a² + 2a(d sinθ - c cosθ)), and its two derivatives."""
    found = motion("crank-slot", angle=q)
    drive = (degrees(q), 10, 0)

    def length(q: mpmath.mpf) -> mpmath.mpf:
        lean = 60 * mpmath.sin(q) - 200 * mpmath.cos(q)
        return mpmath.sqrt(200**2 + 60**2 + 80**2 + 160 * lean)

    def end(q: mpmath.mpf) -> mpmath.mpc:
        crank = 80 * unit(q)
        way = mpmath.mpc(200, -60) - crank
        return crank + 340 * way / abs(way)

    slide, b = found.slides["3"], rates(length, drive)
    assert same(slide.position, b[0] / 1000)
    assert same(slide.speed, b[1] / 1000, 1)
    assert same(slide.acceleration, b[2] / 1000, 10)
    follows(found, "E", end, drive)


@pytest.mark.parametrize("beta", [0, 25, 40])
@pytest.mark.parametrize("q", [0, 50, 200])
def test_the_slot_of_constant_inclination(q: int, beta: int) -> None:
    found = motion("crank-fixed-slot", angle=q, beta=beta)
    theta, lean, w = math.radians(q), math.radians(beta), 10
    slot, lift = found.slides["2"], found.slides["3"]
    assert same(slot.position, (0.2 - 0.08 * math.cos(theta)) / math.cos(lean))
    assert same(slot.speed, 0.08 * w * math.sin(theta) / math.cos(lean), 1)
    assert same(slot.acceleration, 0.08 * w**2 * math.cos(theta) / math.cos(lean), 1)
    height = 0.08 * math.sin(theta) + (0.2 - 0.08 * math.cos(theta)) * math.tan(lean)
    assert same(lift.position, height, 0.1)
    assert same(lift.speed, 0.08 * w * (math.cos(theta) + math.sin(theta) * math.tan(lean)), 1)
    fall = 0.08 * w**2 * (math.cos(theta) * math.tan(lean) - math.sin(theta))
    assert same(lift.acceleration, fall, 10)
    assert same(place(found, "E"), 0.2 + 1j * height)


@pytest.mark.parametrize("w", [1, 2, 10])
def test_eight_links_with_a_sliding_yoke(w: int) -> None:
    found, length = motion("eight-link-1", omega=w), 0.045
    assert same(velocity(found, "B@4"), 2j * w * length)
    assert same(velocity(found, "D"), w * length)
    for link, ratio in {5: -1 / 2, 7: 1 / 6, 8: 1 / 2}.items():
        assert same(omega(found, link), ratio * w)
    stands = {"B": 2 + 2j, "C": 3 + 2j, "D": 7 + 4j, "E": 10 + 4j, "F": 9 + 6j}
    for point, where in stands.items():
        assert same(place(found, point), where * length)


def test_the_output_printed_on_the_slide_needs_another_pivot() -> None:
    """F = E + (-2l, 4l) makes ω8 = ω/4."""
    changes = (('F = ["9*l", "6*l"]', 'F = ["8*l", "8*l"]'), ('"l*sqrt(5)"', '"l*sqrt(20)"'))
    assert same(omega(proved(varied("eight-link-1", *changes)), 8), 2 / 4)


@pytest.mark.parametrize(("k", "share", "output"), [(6, 1 / 15, -1 / 30), (2, 1 / 5, -1 / 10)])
def test_eight_links_with_a_swivelling_guide(k: int, share: float, output: float) -> None:
    """k = 6 gives the slide's results; k = 2 is what it prints, with other results."""
    found, length, v = motion("eight-link-2", k=k), 0.018, 0.36
    assert same(omega(found, 3), v / (15 * length))
    assert same(velocity(found, "B@3"), (0.8 + 0.4j) * v)
    assert same(velocity(found, "D"), 1j * share * v)
    assert same(velocity(found, "E"), 1j * share * v)
    assert abs(omega(found, 7)) < 1e-12
    assert abs(found.links["7"].instant_centre.size) < 1e-12
    assert same(omega(found, 8), output * v / length)


@pytest.mark.parametrize("q", [0, 20, 150, 270])
def test_the_oscillating_slide_has_the_ratios_of_the_notes(q: int) -> None:
    found = motion("oscillating-slide", angle=q)
    slide, speed, lever = found.slides["2"], 90 * TURN, angle(found, "O", "E")
    turn = math.radians(q)
    assert same(slide.speed, -0.065 * speed * math.sin(turn - lever), 0.65)
    assert same(omega(found, 3), 0.065 / slide.position * speed * math.cos(turn - lever), 1)

    def end(q: mpmath.mpf) -> mpmath.mpc:
        block = mpmath.mpc(0, 150) + 65 * unit(q)
        return 280 * block / abs(block)

    follows(found, "E", end, (degrees(q), 3 * mpmath.pi, 0))


# --- slider-crank --------------------------------------------------------------------------------


@pytest.mark.parametrize("q", [0, 55, 160, 300])
def test_a_slider_crank_driven_by_its_crank(q: int) -> None:
    found, speed = motion("slider-crank", angle=q), 120 * TURN
    rod = math.asin((30 - 70 * math.sin(math.radians(q))) / 200)
    expected = -70 * speed * math.cos(math.radians(q)) / (200 * math.cos(rod))
    assert same(omega(found, 2), expected, 1)

    def piston(q: mpmath.mpf) -> mpmath.mpc:
        rise = 30 - 70 * mpmath.sin(q)
        return 70 * mpmath.cos(q) + mpmath.sqrt(200**2 - rise**2) + 30j

    follows(found, "B", piston, (degrees(q), 4 * mpmath.pi, 0))


@pytest.mark.parametrize("x", [170, 240, 270])
def test_a_slider_crank_driven_by_its_slider(x: int) -> None:
    found = motion("slider-crank-slider", x=x)
    crank, rod = angle(found, "O", "A"), angle(found, "A", "B")
    expected = 600 * math.cos(rod) / (80 * math.sin(crank - rod))
    assert same(omega(found, 1), expected)

    def pin(x: mpmath.mpf) -> mpmath.mpc:
        return meeting(mpmath.mpc(0), 80, x + 40j, 220, 1)

    follows(found, "A", pin, (x, -600, 1500))


# --- several loops -------------------------------------------------------------------------------


def test_the_toggle_press_is_a_four_bar_with_a_slider_behind() -> None:
    found = motion("toggle-press")
    drive = (degrees(60), 2 * mpmath.pi, 0)

    def knee(q: mpmath.mpf) -> mpmath.mpc:
        return meeting(42 * unit(q), 166, mpmath.mpc(215, 125), 130, -1)

    def slide(q: mpmath.mpf) -> mpmath.mpc:
        pin = knee(q)
        drop = mpmath.sqrt(148**2 - (215 - mpmath.re(pin)) ** 2)
        return mpmath.mpc(215, mpmath.im(pin) - drop)

    follows(found, "B", knee, drive)
    follows(found, "C", slide, drive)
    assert [group.title for group in mechanism("toggle-press").groups[1:]] == [
        "dyad RRR",
        "dyad RRP",
    ]


@pytest.mark.parametrize("number", [1, 2, 3, 4])
def test_the_rapid_return_closes_in_four_ways(number: int) -> None:
    """Three slides at once: A on the lever PQ, P on the vertical, Q on its guide."""
    found = proved(varied("rapid-return", ('"closure 2"', f'"closure {number}"')))
    a, p, q = (place(found, point) for point in "APQ")
    lean = math.radians(10)
    assert abs(q - p) == pytest.approx(0.288, rel=1e-12)
    assert abs(p.real) < 1e-12
    assert abs(((q - 0.16j) * complex(math.cos(lean), -math.sin(lean))).imag) < 1e-12
    assert abs(((a - p) * (q - p).conjugate()).imag) < 1e-12


def test_the_rapid_return_driven_by_an_end_is_of_class_two() -> None:
    titles = [group.title for group in mechanism("rapid-return-slider").groups[1:]]
    assert len(titles) == 2
    assert all(title.startswith("dyad") for title in titles)
    drive = (-112, 160, 400)
    lean = unit(degrees(10))

    def upper(y: mpmath.mpf) -> mpmath.mpc:
        low = (1j * y - 160j) / lean
        reach = mpmath.re(low) + mpmath.sqrt(288**2 - mpmath.im(low) ** 2)
        return 160j + reach * lean

    def pin(y: mpmath.mpf) -> mpmath.mpc:
        along = (upper(y) - 1j * y) / 288
        foot = -1j * y / along
        reach = mpmath.re(foot) + mpmath.sqrt(48**2 - mpmath.im(foot) ** 2)
        return 1j * y + reach * along

    follows(motion("rapid-return-slider"), "Q", upper, drive)
    follows(motion("rapid-return-slider"), "A", pin, drive)


TWO_LOOPS = (40, 100, 50)


def over(q: mpmath.mpf) -> mpmath.mpc:
    """A stands over the middle of BO, at the distance 100 from both."""
    b, o = mpmath.mpc(0, -q), mpmath.mpc(100)
    height = mpmath.sqrt(100**2 - abs(o - b) ** 2 / 4)
    return (b + o) / 2 + 1j * (o - b) / abs(o - b) * height


def test_two_loops_by_their_closed_form() -> None:
    found = motion("two-loops")
    follows(found, "A", over, TWO_LOOPS)
    follows(found, "C", lambda q: 100 + 2j * mpmath.im(over(q)), TWO_LOOPS)
    theta = [angle(found, *ends) for ends in ("BA", "OA", "AC")]
    left, right, rod = (omega(found, link) for link in (2, 3, 4))
    sine = math.sin(theta[0] - theta[1])
    assert same(left, -math.sin(theta[1]) / sine)
    assert same(right, -math.sin(theta[0]) / sine)
    assert same(rod, -right * math.sin(theta[1]) / math.sin(theta[2]))


def test_two_loops_keep_c_on_o_in_the_other_closure() -> None:
    found = proved(varied("two-loops", ('5 = "forward"', '5 = "backward"')))
    assert same(place(found, "C"), place(found, "O"))
    assert abs(velocity(found, "C")) < 1e-12
    assert abs(acceleration(found, "C")) < 1e-11
    assert omega(found, 4) == pytest.approx(omega(found, 3))


# --- double sliders ------------------------------------------------------------------------------


def test_oldham_turns_alike_and_slides_by_the_offset() -> None:
    w = 180 * TURN
    for q in (0, 35, 90, 200):
        found = motion("oldham", angle=q)
        turn = math.radians(q)
        assert same(omega(found, 3), w)
        assert abs(epsilon(found, 3)) < 1e-9 * w**2
        assert same(abs(found.slides["2"].speed), abs(0.06 * w * math.sin(turn)), 1)
        assert same(abs(found.slides["3"].speed), abs(0.06 * w * math.cos(turn)), 1)
    assert same(abs(motion("oldham", angle=90).slides["2"].speed), 0.06 * w)


def test_the_cross_of_oldham_runs_around_the_circle_between_the_shafts() -> None:
    follows(
        motion("oldham"),
        "M",
        lambda q: 60 * mpmath.cos(q) * unit(q),
        (degrees(35), 6 * mpmath.pi, 0),
    )


def test_the_trammel_draws_an_ellipse() -> None:
    found = motion("trammel")
    drive = (132, 176, 0)

    def rise(x: mpmath.mpf) -> mpmath.mpf:
        return mpmath.sqrt(220**2 - x**2)

    follows(found, "B", lambda x: 1j * rise(x), drive)
    follows(found, "M", lambda x: mpmath.mpc(132 * x, 88 * rise(x)) / 220, drive)
    assert same(omega(found, 2), 0.176 / place(found, "B").imag)
    assert same(centre(found.links["2"].instant_centre), 0.132 + 0.176j)


@pytest.mark.parametrize("alpha", [15, 45, 75])
def test_the_centre_of_cardans_cross_lies_on_both_circles(alpha: int) -> None:
    found = motion("centrodes-cardan", alpha=alpha)
    lean = math.radians(alpha)
    meet, foot = centre(found.links["2"].instant_centre), place(found, "B")
    assert same(meet, 0.1 * complex(math.cos(lean), -math.sin(lean)))
    own = (meet - foot) * complex(math.cos(lean), -math.sin(lean))
    assert abs(meet) == pytest.approx(0.1, rel=1e-9)  # about O
    assert abs(own - 0.05) == pytest.approx(0.05, rel=1e-9)  # about the rod's middle


# --- a shaper ------------------------------------------------------------------------------------


@pytest.mark.parametrize("q", [0, 50, 200, 330])
def test_the_ram_of_a_shaper(q: int) -> None:
    def ram(q: mpmath.mpf) -> mpmath.mpc:
        pin = 120 * unit(q) + 300j
        end = -300j + 550 * pin / abs(pin)
        return end.real - mpmath.sqrt(200**2 - (end.imag - 260) ** 2) + 260j

    follows(motion("shaper", angle=q), "C", ram, (degrees(q), 2 * mpmath.pi, 0))


def test_a_shaper_cuts_longer_than_it_returns() -> None:
    """The lever rests where it is square to the crank: time ratio (180° + 2γ)/(180° - 2γ)."""
    dead = math.degrees(math.asin(120 / 300))
    for turn in (-dead, 180 + dead):
        text = ("angle = { value = 50", f"angle = {{ value = {turn!r}"), (", step = 5 }", " }")
        text += (("min = 0", "min = -90"),)
        assert abs(omega(proved(varied("shaper", *text)), 3)) < 1e-12
    assert (180 + 2 * dead) / (180 - 2 * dead) == pytest.approx(1.71, abs=5e-3)


# --- a cam and the mechanism in its place --------------------------------------------------------


@pytest.mark.parametrize("q", [0, 40, 250])
def test_a_flat_follower_rises_by_the_eccentric(q: int) -> None:
    found = motion("mobility-cam", angle=q)
    follows(found, "F", lambda q: 1j * (40 * mpmath.sin(q) + 70), (degrees(q), 3 * mpmath.pi, 0))
    assert count(mechanism("mobility-cam").scene).mobility == 3 * 2 - 2 * 2 - 1
