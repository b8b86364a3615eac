"""What the courses state of linkages of bars and pins, and of open chains."""

from __future__ import annotations

import math

import mpmath
import pytest

from graphkin.construction.core.solution import Solution
from graphkin.loops.freedom import true_mobility
from graphkin.structure.driver_count import count, kutzbach
from graphkin.structure.grashof import single_loops
from graphkin.text.errors import ClosureError
from tests.examples.scenes import (
    acceleration,
    angle,
    carried,
    centre,
    crossing,
    degrees,
    epsilon,
    follows,
    is_rigid,
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


@pytest.mark.parametrize("name", FOUR_BARS)
def test_a_four_bar_has_the_velocity_ratios_of_the_notes(name: str) -> None:
    _, ab, bc, dc, _, q, speed, _, _ = FOUR_BARS[name]
    found = motion(name)
    q, two, three = math.radians(q), angle(found, "B", "C"), angle(found, "D", "C")
    sine = math.sin(two - three)
    assert same(omega(found, 2), -(ab / bc) * speed * math.sin(q - three) / sine, speed)
    assert same(omega(found, 3), -(ab / dc) * speed * math.sin(q - two) / sine, speed)


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


@pytest.mark.parametrize("name", FOUR_BARS)
def test_the_class_of_a_four_bar_is_told(name: str) -> None:
    (loop,) = single_loops(mechanism(name).scene)
    assert loop.kind == FOUR_BARS[name][0]


def turned(name: str, q: float) -> Solution:
    """A four-bar at another angle of its crank, beyond the range of the scene if need be."""
    return varied(name, ('angle = "angle"', f"angle = {q!r}")).solve()


@pytest.mark.parametrize("name", ["four-bar-crank-rocker", "four-bar-double-crank"])
def test_a_crank_turns_fully(name: str) -> None:
    for q in range(0, 360, 15):
        assert turned(name, float(q)).margin > 0.05


def dead_point(ab: float, stretched: float, ad: float) -> float:
    """Angle of the crank (°) at which coupler and rocker lie in line, by the law of cosines."""
    return math.degrees(math.acos((ab**2 + ad**2 - stretched**2) / (2 * ab * ad)))


@pytest.mark.parametrize(
    ("name", "dead", "inwards"),
    [
        ("four-bar-double-rocker", dead_point(90, 50 + 100, 120), -1),
        ("four-bar-double-rocker", dead_point(90, 50 - 100, 120), 1),
        ("four-bar-triple-rocker", dead_point(70, 80 + 90, 130), -1),
        ("four-bar-triple-rocker", -dead_point(70, 80 + 90, 130), 1),
    ],
)
def test_a_driven_rocker_ends_at_its_dead_points(name: str, dead: float, inwards: int) -> None:
    near = turned(name, dead + inwards * 1e-3)
    bar, arm = angle(near, "B", "C"), angle(near, "D", "C")
    assert abs(math.sin(bar - arm)) < 0.02
    with pytest.raises(ClosureError):
        turned(name, dead - inwards * 1e-3)


def test_the_dead_points_that_the_scenes_state() -> None:
    assert math.cos(math.radians(dead_point(90, 50, 120))) == pytest.approx(25 / 27)
    assert dead_point(90, 150, 120) == pytest.approx(90)
    assert math.cos(math.radians(dead_point(70, 170, 130))) == pytest.approx(-71 / 182)


def test_the_coupler_of_a_parallelogram_does_not_turn() -> None:
    found = motion("four-bar-change-point")
    assert abs(omega(found, 2)) < 1e-12
    assert same(velocity(found, "C"), velocity(found, "B"))
    assert abs(found.links["2"].instant_centre.size) < 1e-12


# --- centres -------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["centrodes-four-bar", "centrodes-knee", "instant-centres"])
def test_the_coupler_turns_about_where_its_arms_meet(name: str) -> None:
    found = motion(name)
    a, b, c, d = (place(found, point) for point in "ABCD")
    meet = crossing(a, b, d, c)
    assert same(centre(found.links["2"].instant_centre), meet, abs(c - b))
    assert abs(carried(found, 2, "B", meet)) < 1e-9 * abs(velocity(found, "B"))


def test_the_knee_turns_about_the_crossing_of_its_ligaments() -> None:
    found = motion("centrodes-knee")
    a, b, c, d = (place(found, point) for point in "ABCD")
    share = [(meet - start) / (end - start) for meet, start, end in two_ways(a, b, d, c)]
    assert all(0 < each.real < 1 for each in share)


def two_ways(a: complex, b: complex, d: complex, c: complex) -> list[tuple[complex, ...]]:
    """The crossing of AB and DC with the ends of each."""
    meet = crossing(a, b, d, c)
    return [(meet, a, b), (meet, d, c)]


def test_six_centres_of_a_four_bar_lie_three_by_three_on_a_line() -> None:
    """Kennedy-Aronhold: the centres of any three links are in line."""
    found = motion("instant-centres")
    a, b, c, d = (place(found, point) for point in "ABCD")
    coupler = centre(found.links["2"].instant_centre)
    turning = (omega(found, 1), omega(found, 3))
    opposite = (turning[0] * a - turning[1] * d) / (turning[0] - turning[1])
    assert same(opposite, crossing(b, c, a, d), abs(d - a))
    assert same(carried(found, 1, "A", opposite), carried(found, 3, "D", opposite))
    for one, two, three in ((a, b, coupler), (c, d, coupler), (b, c, opposite), (a, d, opposite)):
        area = ((two - one).conjugate() * (three - one)).imag
        assert abs(area) < 1e-9 * abs(two - one) * abs(three - one)


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


def test_the_five_bar_has_the_velocity_ratios_of_the_notes() -> None:
    found = motion("five-bar")
    one, two = math.radians(115), math.radians(50)
    bar, arm = angle(found, "B", "C"), angle(found, "D", "C")
    sine = math.sin(bar - arm)
    ratios = {
        2: (-60 / 130 * math.sin(one - arm) / sine, 70 / 130 * math.sin(two - arm) / sine),
        3: (-60 / 115 * math.sin(one - bar) / sine, 70 / 115 * math.sin(two - bar) / sine),
    }
    for link, (first, second) in ratios.items():
        assert same(omega(found, link), 4 * first - 3 * second)


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


@pytest.mark.parametrize("name", SIX_BARS)
def test_a_six_bar_keeps_its_lengths_and_follows_its_driver(name: str) -> None:
    """Lengths kept to the second derivative, the driver's angle and speed: that is all there is."""
    found, scene = motion(name), mechanism(name).scene
    for link in scene.links.values():
        is_rigid(found, link.points)
        for placing in link.placings:
            for one, other, length in placing.lengths():
                way = abs(place(found, one) - place(found, other))
                assert way == pytest.approx(float(length.si(scene.values)), rel=1e-12)
    (driver,) = scene.drivers
    assert omega(found, driver.link) == pytest.approx(float(driver.speed.si(scene.values)))
    assert epsilon(found, driver.link) == pytest.approx(0, abs=1e-9)
    first, second = scene.links[driver.link].points[:2]
    given = float(driver.position.si(scene.values))
    assert angle(found, first, second) == pytest.approx(given, rel=1e-12)


@pytest.mark.parametrize(
    ("name", "old", "known"),
    [("stephenson-2-ternary", "closure 1", 2), ("stephenson-3-crank", "closure 3", 4)],
)
def test_the_closures_of_a_group_of_class_three_are_numbered(
    name: str, old: str, known: int
) -> None:
    """As many as the second route finds; ordered by the angle of the first-written link."""
    link = mechanism(name).groups[1].links
    first = next(each for each in mechanism(name).scene.links if each in link)
    points = mechanism(name).scene.links[first].points
    turns = []
    for number in range(1, known + 1):
        found = proved(varied(name, (f'"{old}"', f'"closure {number}"')))
        turns.append(angle(found, *points[:2]) % (2 * math.pi))
    assert turns == sorted(turns)
    assert len(set(turns)) == known


# --- mobility ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "counted", "true"),
    [
        ("slider-crank", 1, 1),
        ("mobility-cam", 1, 1),
        ("mobility-five-bar", 2, 2),
        ("mobility-watt", 1, 1),
        ("mobility-parallel-cranks", 0, 1),
        ("mobility-trammel-bar", 0, 1),
    ],
)
def test_the_count_and_the_truth(name: str, counted: int, true: int) -> None:
    found = motion(name)
    positions = {point: each.position for point, each in found.points.items() if "@" not in point}
    assert count(mechanism(name).scene).mobility == counted
    assert true_mobility(mechanism(name).scene, positions) == true


def test_a_double_hinge_counts_as_two_pins() -> None:
    scene = mechanism("mobility-watt").scene
    points = {point for link in scene.links.values() for point in link.points}
    assert count(scene).pairs == len(points) + 1 == 7
    assert 3 * 5 - 2 * len(points) == 3  # what it would be with one pin at B


def test_the_count_in_space() -> None:
    assert kutzbach(8, {1: 7}) == 7  # an arm of seven hinges
    assert kutzbach(5, {1: 4}) == 4  # SCARA: three hinges and a slide


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
