"""Wheels that nothing but rolling keeps in place: in rings, under bars, on drums, on ropes."""

from __future__ import annotations

from cmath import exp
from functools import cache
from math import cos, pi, radians, sin

import numpy as np
import pytest
from msgspec.structs import replace

from graphkin.construction.core.kind import constructions
from graphkin.construction.higher_class.two_trials import TwoTrials
from graphkin.loops.assemble import assemble
from graphkin.mechanism import Mechanism, load
from graphkin.scene.read_scene import read_text
from graphkin.structure.driver_count import count
from graphkin.structure.groups import Higher
from graphkin.text.errors import StructureError
from tests.chosen import FOLDER
from tests.scene_files import scene_text

SCENES = (
    "wheel-in-ring",
    "wheel-in-ring-rod",
    "bar-on-drum",
    "bar-on-drum-rod",
    "rope-on-drum",
    "bar-on-roller",
)


@cache
def example(name, **settings):
    """A scene of the examples."""
    return load(FOLDER / f"{name}.toml", **settings)


def told(found, point):
    """Place, velocity and acceleration of a point."""
    motion = found.points[point]
    return motion.position, motion.velocity, motion.acceleration


def made(text):
    """The mechanism of a text."""
    return Mechanism(read_text(text, "kept"))


@pytest.mark.parametrize("name", SCENES)
def test_it_counts_one_freedom_without_what_was_put_in(name):
    scene = example(name).scene
    assert len(scene.keepers) == 1
    assert set(scene.bare.links) == set(scene.links) - set(scene.keepers)
    assert count(scene).mobility == 1
    assert count(scene).singles == 0


@pytest.mark.parametrize("name", SCENES)
def test_loops_that_know_no_such_link_agree(name):
    """The vector loops of the bare scene, led to the same closure, put in nothing."""
    one = example(name)
    found = one.solve()
    assert one.witness(found).agrees
    bare, wheels = one.scene.bare, {name: wheel for name, (wheel, _) in one.scene.keepers.items()}
    branches = {wheels.get(name, name): branch for name, branch in bare.branches.items()}
    motion = assemble(replace(bare, branches=branches)).motion
    for point in (point for point in found.points if "@" not in point):
        own = motion.point(point)
        for got, want in zip(
            (own.place, own.velocity, own.acceleration), told(found, point), strict=True
        ):
            assert complex(got[0]) == pytest.approx(want, abs=1e-11)


@pytest.mark.parametrize("extra", [0, 3])
def test_a_driven_bar_counts_its_turns_as_written(extra):
    """After whole turns more the drum has taken up so many more rims of the bar."""
    text = (FOLDER / "bar-on-drum.toml").read_text(encoding="utf-8")
    text = text.replace('angle = "phi"', f'angle = "phi + {360 * extra}"')
    place = made(text).solve().points["A"].position
    u, turn = exp(1j * pi / 3), pi / 3 + 2 * pi * extra
    assert place == pytest.approx(-0.06 * (1j + turn) * u)


def test_a_hinged_bar_on_a_roller_as_hibbeler_prints_it():
    """Problem 16-50: ω = (2v/r)·sin²(θ/2), α = (2v²/r²)·sin θ·sin²(θ/2)."""
    for theta in (30, 60, 85):
        found, turn = example("plank-hinged", theta=theta).solve(), radians(theta)
        half = sin(turn / 2) ** 2
        bar = found.links["2"]
        assert bar.omega == pytest.approx(2 * 0.1 / 0.05 * half)
        assert bar.epsilon == pytest.approx(2 * (0.1 / 0.05) ** 2 * sin(turn) * half)
        assert found.points["B"].position == pytest.approx(0.2 * (cos(turn) + 1j * sin(turn)))


@pytest.mark.parametrize("name", ["wheel-in-ring-rod", "bar-on-drum-rod"])
def test_the_plans_of_what_turns_about_its_contact_need_no_trial(name):
    """Only the place needs one: the wheel or the bar turns about T at the instant."""
    one = example(name)
    (group,) = (each for each in one.groups if isinstance(each, Higher))
    assert group.at_instant
    assert not [*constructions(one.program, TwoTrials)]


def test_an_arm_and_its_wheel_are_no_dyad_at_an_instant():
    """Both centres and the contact lie in line; such a group is tried in the plans too."""
    one = load(FOLDER.parents[1] / "tests" / "scenes" / "two-gear-crank.toml")
    (group,) = (each for each in one.groups if isinstance(each, Higher))
    assert not group.at_instant


def test_the_line_of_centres_may_be_named_and_driven():
    text = (FOLDER / "wheel-in-ring.toml").read_text(encoding="utf-8")
    named = text.replace("rolls = { on = 0 }", 'rolls = { on = 0, link = "arm" }')
    one = made(named.replace("turn = 1", 'turn = "arm"'))
    assert one.solve().links["1"].omega == pytest.approx(-4 * 0.1 / 0.05)
    assert "arm" in one.scene.bare.links


@pytest.mark.parametrize(("side", "other", "height"), [("left", "right", 1), ("right", "left", -1)])
def test_rollers_of_one_size_keep_a_plank_parallel(side, other, height):
    """Twice the radius from the floor, at twice the speed of the centres: v = -2ωr, a = -2εr."""
    text = (FOLDER / "plank-rollers.toml").read_text(encoding="utf-8")
    assert "slides" not in text
    text = text.replace("P = [0, 0]", "P = [0, 7]").replace("[480, 0]", "[480, -3]")
    text = text.replace('through = "P"', "through = [0, -3]").replace('side = "right"', "SIDE")
    text = text.replace("{ on = 0, ", f'{{ on = 0, side = "{side}", ')
    text = text.replace("SIDE", f'side = "{other}"')
    driven = text.replace("slide = 3\nposition = 70", "roll = 2\nposition = 35")
    for drive, times in ((text, 1), (driven, 2)):
        plank = made(drive)
        motion = plank.solve()
        assert plank.witness(motion).agrees
        assert motion.points["P"].position.imag == pytest.approx(0.1 * height + 0.010)
        assert motion.points["P"].velocity == pytest.approx(0.2 * times)
        assert motion.points["P"].acceleration == pytest.approx(0.05 * times)
        for roller in "12":
            assert motion.links[roller].omega == pytest.approx(-2 * times * height)
            assert motion.links[roller].epsilon == pytest.approx(-0.5 * times * height)


def alike(one, other, links, points):
    """Whether links and points of two mechanisms move alike."""
    first, second = one.solve(), other.solve()
    assert other.witness(second).agrees
    for link in links:
        for rate in ("omega", "epsilon"):
            got, want = (getattr(each.links[link], rate) for each in (second, first))
            assert got == pytest.approx(want, rel=1e-12, abs=1e-12)
    for point in points:
        for got, want in zip(told(second, point), told(first, point), strict=True):
            assert got == pytest.approx(want, rel=1e-12, abs=1e-12)


HANGING = scene_text("construction/crank-on-a-bar")


def test_what_hangs_on_a_track_does_not_hold_it():
    """A crank on the end of a bar that lies on a roller, and a rod on that: the bar moves alike."""
    text = (FOLDER / "bar-on-roller.toml").read_text(encoding="utf-8")
    text = text.replace("[branches]", HANGING + "[branches]")
    laden = made(text.replace('4 = "forward"', '6 = "forward"'))
    assert len(laden.scene.keepers) == 1
    alike(example("bar-on-roller"), laden, "123", "ABCD")


CARRIED = scene_text("construction/crank-on-a-plank")


def test_a_crank_on_a_plank_leaves_it_to_its_rollers():
    """The slide that two rollers stand for is put in all the same."""
    text = (FOLDER / "plank-rollers.toml").read_text(encoding="utf-8")
    laden = made(text.replace("P = [0, 0]\n", CARRIED))
    assert laden.scene.links["3"].slides
    alike(example("plank-rollers"), laden, "123", "ABCDP")


ROCKED = scene_text("construction/rocked-bar")
CAM = scene_text("construction/cam-on-a-bar")


def test_a_cam_on_a_track_does_not_hold_it():
    """A bar that a roller rocks lifts a follower by a cam on it: the bar moves as without it."""
    plain = made(ROCKED.replace("BLOCK", "4"))
    lifting = made(ROCKED.replace("[[drivers]]", CAM, 1).replace("BLOCK", "6"))
    alike(plain, lifting, "123", "ABCD")


@pytest.mark.parametrize(("turn", "own"), [(0.4, 0.9), (-2.0, 7.5), (3.5, -0.2)])
def test_a_wheel_that_its_driver_turns_on_its_track_is_held(turn, own):
    """It needs no block though it carries a track itself; in closed form, one wheel on the other.

    P is at -2φ + 2i, and Q against it at e^(iφ)·(3i/2 - ψ/2), which turns with φ + ψ.
    """
    one = made(scene_text("construction/wheel-on-a-wheel", turn=turn, own=own))
    assert not one.scene.keepers
    found = one.solve()
    assert one.witness(found).agrees
    w, e, v, b = 1.5, 0.8, -2.5, 4.0
    arm, slid = exp(1j * turn), 1.5j - own / 2
    centre = -2 * turn + 2j + arm * slid
    speed = -2 * w + arm * (1j * w * slid - v / 2)
    rate = -2 * e + arm * ((1j * e - w * w) * slid - 1j * w * v - b / 2)
    reach = exp(1j * (turn + own)) * (0.3 + 0.1j)
    turning, spin = w + v, e + b
    pin = centre + reach, speed + 1j * turning * reach
    pin += (rate + (1j * spin - turning**2) * reach,)
    for point, want in (("Q", (centre, speed, rate)), ("R", pin)):
        assert told(found, point) == pytest.approx(want, abs=1e-12)


SLOPE = scene_text("construction/plank-on-a-slope")
CRANK = scene_text("construction/crank-beside-a-slope")


def test_rollers_on_a_slope_keep_a_plank_parallel_to_it():
    """The other line of the slope may be written by its way along it: v of the plank is twice that
    of the centres."""
    plank = made(SLOPE + "[[drivers]]\nroll = 1\nposition = 20\nspeed = 100\n")
    motion = plank.solve()
    assert plank.witness(motion).agrees
    along = complex(np.exp(1j * np.radians(20)))
    assert motion.points["P"].velocity / along == pytest.approx(0.2)
    assert (motion.points["P"].position / along).imag == pytest.approx(0.08)
    other = SLOPE.replace("length = 200, angle = 20 }", "length = 200, angle = 21 }")
    assert other != SLOPE
    driver = "[[drivers]]\nroll = 1\nposition = 20\nspeed = 100\n"
    with pytest.raises(StructureError, match="closure 1"):
        made(other + driver).solve()
    leaning = made(other + driver + '[branches]\n3 = "closure 1"\n')
    motion = leaning.solve()
    assert leaning.witness(motion).agrees
    assert motion.links["3"].omega == pytest.approx(0, abs=1e-12)
    assert abs((motion.points["P"].position / along).imag - 0.08) > 1e-4


def test_a_rod_pulls_a_plank_on_rollers_of_one_size():
    """As a slider-crank beside the slope, by its closed form; the rollers go half as fast."""
    plank = made(SLOPE + CRANK)
    motion = plank.solve()
    assert plank.witness(motion).agrees
    along = complex(np.exp(1j * np.radians(20)))
    crank, omega = 0.06 * np.exp(1j * np.radians(50)), 4
    pin = (complex(-0.32, -0.06) + crank) / along
    rise = 0.08 - pin.imag
    rod = np.sqrt(0.3**2 - rise**2)
    assert (motion.points["P"].position / along).real == pytest.approx(pin.real + rod)
    speed = 1j * omega * crank / along
    expected = speed.real + rise * speed.imag / rod
    assert motion.points["P"].velocity / along == pytest.approx(expected)
    for roller in "12":
        assert motion.links[roller].omega == pytest.approx(-expected / 2 / 0.04)


@pytest.mark.parametrize("radii", [(60, 60), (60, 30)])
def test_a_plank_on_two_drums_that_turn_in_place(radii):
    """Without slip on both: it turns no further, and moves along itself as the rims do."""
    found = []
    for way in ("forward", "backward"):
        wheels = {"first": radii[0], "second": radii[1], "way": way}
        plank = made(scene_text("construction/plank-on-drums", **wheels))
        motion = plank.solve()
        assert plank.witness(motion).agrees
        assert motion.links["3"].omega == pytest.approx(0, abs=1e-12)
        assert abs(motion.points["P"].velocity) == pytest.approx(3 * radii[0] / 1000)
        assert motion.links["2"].omega == pytest.approx(3 * radii[0] / radii[1])
        along = motion.points["C"].position - motion.points["P"].position
        found.append(np.angle(along / abs(along)))
    lean = np.arcsin((radii[1] - radii[0]) / 300)
    expected = np.array([lean, np.pi - lean])
    assert np.exp(1j * np.array(found)) == pytest.approx(np.exp(1j * expected), abs=1e-9)


HOOP = scene_text("construction/hoop")


def test_a_hoop_rolls_on_the_floor_with_a_wheel_inside():
    """v of the wheel's rim is the hoop's where they touch: the line of centres turns so."""
    hoop = made(HOOP)
    motion = hoop.solve()
    assert hoop.witness(motion).agrees
    centre, wheel = motion.points["A"], motion.points["B"]
    way = (wheel.position - centre.position) / 0.07
    omega = motion.links["1"].omega
    assert omega == pytest.approx(-0.1 / 0.11)
    assert abs(way) == pytest.approx(1)
    expected = 1j * way * (0.1 * omega - 0.03 * 3)
    assert wheel.velocity - centre.velocity == pytest.approx(expected)


def test_what_keeps_a_wheel_in_a_ring_may_be_driven_against_a_track():
    """Willis: the wheel in the ring has ω_arm·(1 - 150/50); the rack turns its pinion by v/r."""
    found = made(scene_text("construction/ring-and-rack"))
    solution = found.solve()
    assert found.witness(solution).agrees
    assert solution.links["1"].omega == pytest.approx(4 * (1 - 150 / 50))
    assert solution.links["3"].omega == pytest.approx(10 / 20)
