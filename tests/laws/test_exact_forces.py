"""Reactions and balances against the fifty digits of ``exact_forces``, which shares no formula."""

from __future__ import annotations

import json
import math
import random
from pathlib import Path

import mpmath
import pytest

from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import GraphkinError, StructureError
from tests.chance.forces import judged
from tests.chosen import FOLDER, SCENES, shared
from tests.laws.exact_forces import (
    DIGITS,
    Exact,
    UnsupportedError,
    exact_forces,
    far_from_exact,
)
from tests.laws.force_routes import differences, loaded
from tests.mechanisms import HEAD, mechanism_of
from tests.running import ran
from tests.scene_files import scene_text

ROUNDING = 1e-12
"""The share of the largest force by which doubles may differ from fifty digits."""
MOTION = ("position", "velocity", "acceleration")
ROOT = Path(__file__).resolve().parents[2]
WITH_FORCES = sorted(
    path
    for folder in ("tests/scenes/forces", "examples/scenes", "sheets")
    for path in (ROOT / folder).rglob("*.toml")
    if any(word in path.read_text(encoding="utf-8") for word in ("[[loads]]", "mass ="))
)
"""Every shipped scene and lab, and every scene of the tests of forces, that has loads or masses."""


def mechanism_at(path: Path) -> Mechanism:
    return Mechanism(read_text(path.read_text(encoding="utf-8"), path.stem, None, {}))


@pytest.mark.parametrize("path", WITH_FORCES, ids=[path.stem for path in WITH_FORCES])
def test_every_scene_with_forces_has_them_right(path):
    assert far_from_exact(mechanism_at(path)) < ROUNDING


@pytest.mark.parametrize("path", WITH_FORCES, ids=[path.stem for path in WITH_FORCES])
def test_forty_proved_digits_of_the_motion_and_the_printed_forces_are_those(path):
    """``solve --digits 40`` proves the accelerations on which inertia forces depend."""
    done = ran("solve", path, "--digits", 40, "--json")
    assert done.exit_code == 0, done.output
    printed = json.loads(done.stdout)
    with mpmath.workdps(DIGITS):
        exact = Exact(mechanism_at(path)).solved()
        for point, three in exact.points.items():
            largest = max(map(abs, three)) or 1
            for key, expected in zip(MOTION, three, strict=True):
                found = mpmath.mpc(*printed["points"][point][key])
                assert abs(found - expected) < mpmath.mpf("1e-39") * max(largest, abs(found))
    largest = max(abs(complex(force)) for force, _ in exact.pairs.values())
    for name, links in printed.get("reactions", {}).items():
        for link, each in links.items():
            off = complex(*each["force"]) - complex(exact.pairs[name, link][0])
            assert abs(off) < ROUNDING * largest
    for link, each in printed.get("balance", {}).items():
        expected = complex(exact.drivers[link])
        found = each["moment"] if "moment" in each else complex(*each["force"])
        assert abs(found - expected) < ROUNDING * max(abs(expected), largest)


# --- every scene of the gallery, with loads at random ------------------------------------------


def with_loads(name: str) -> Mechanism:
    """A scene with masses and loads at random, unless it has its own."""
    mechanism = mechanism_at(FOLDER / f"{name}.toml")
    given = mechanism.scene.forces
    return mechanism if given is not None else loaded(mechanism, random.Random(name))


@pytest.mark.parametrize("name", shared(SCENES, 10))
def test_every_scene_of_the_gallery_has_them_right_with_loads_at_random(name):
    """Redundant constraints, belts and second rollers are refused; the rest agrees."""
    mechanism = with_loads(name)
    try:
        assert far_from_exact(mechanism) < ROUNDING
    except UnsupportedError:
        pytest.skip("a pair that the route does not have")
    except StructureError as error:
        assert any(word in str(error) for word in ("redundant", "belt", "cam of", "finite"))


@pytest.mark.parametrize("name", ["excavator-absolute", "jumper"])
def test_a_driven_link_on_another_passes_its_pin_s_force_to_the_link_that_carries_it(name):
    """Each angle is driven against the frame, while the pin is on the link before."""
    mechanism = with_loads(name)
    assert far_from_exact(mechanism) < ROUNDING
    assert max(differences(mechanism)) < ROUNDING


def test_two_drivers_of_one_link_have_a_balance_each(tmp_path):
    """Link 1 is driven against the frame and against link 2: balance.1-0 and balance.1-2."""
    speeds = {"u1": 3, "u2": -7, "a1": None, "a2": None}
    text = scene_text("laws/arm-of-two-links", q1=20, q2=50, **speeds) + "[ask]\nbalance = true\n"
    other = exact_forces(mechanism_of(text))
    text = text.replace("turn = 2\nagainst = 1", "turn = 1\nagainst = 2")
    text = text.replace("= 50", "= -50").replace("= -7", "= 7")
    mechanism = mechanism_of(text)
    assert far_from_exact(mechanism) < ROUNDING
    exact = exact_forces(mechanism)
    assert math.isclose(exact.drivers["1-0"], other.drivers["1"], rel_tol=1e-15)
    assert math.isclose(exact.drivers["1-2"], -other.drivers["2"], rel_tol=1e-15)
    scene = tmp_path / "two.toml"
    scene.write_text(HEAD + text, encoding="utf-8")
    printed = json.loads(ran("solve", scene, "--json").stdout)["balance"]
    assert printed.keys() == {"1-0", "1-2"}
    for name, each in printed.items():
        assert math.isclose(each["moment"], exact.drivers[name], rel_tol=1e-12)
    assert "moment on link 1 against 2: " in ran("solve", scene).stdout


def test_a_wheel_touches_its_track_whatever_point_the_frame_lists_first():
    """The frame of rod-and-wheel starts with a pin that is not at the origin."""
    assert far_from_exact(with_loads("rod-and-wheel")) < ROUNDING


# --- dead points, zero forces, two-force links, pins of three links -----------------------------


DEAD = """
[frame]
O = [0, 0]
[links.1]
O-A = 0.2
[links.2]
A-B = 0.7
[links.3]
B = [0, 0]
slides = {{ on = 0, through = "O", angle = 0 }}
[[loads]]
link = 1
moment = 50
[[drivers]]
slide = 3
position = {position!r}
speed = 0.1
[branches]
A = "left of O-B"
"""


@pytest.mark.parametrize("short", [1e-2, 1e-4, 1e-6, 1e-8, 1e-10])
def test_towards_a_dead_point_the_force_grows_as_the_inverse_of_its_sine(short):
    """A piston holds a moment on its crank, ``short`` of its outer dead point at 0.9 m."""
    mechanism = mechanism_of(DEAD.format(position=0.9 * (1 - short)))
    exact = exact_forces(mechanism)
    force = abs(float(exact.drivers["3"].real))
    with mpmath.workdps(DIGITS):
        s, r, rod = mpmath.mpf(repr(0.9 * (1 - short))), mpmath.mpf("0.2"), mpmath.mpf("0.7")
        cosine = (s**2 + r**2 - rod**2) / (2 * s * r)
        sine = mpmath.sqrt(1 - cosine**2)
        arm = r * sine * (1 + r * cosine / mpmath.sqrt(rod**2 - (r * sine) ** 2))
        expected = float(50 / arm)
    assert math.isclose(force, expected, rel_tol=1e-14)
    found, verdict = mechanism.forces()
    (balance,) = found.balance
    assert abs(abs(balance.force) - expected) < 1e-14 / short * expected
    assert verdict.agrees or short < 1e-7


def test_at_the_dead_point_itself_the_load_is_refused():
    with pytest.raises(GraphkinError, match="dead point"):
        mechanism_of(DEAD.format(position=0.9)).forces()


FOUR_BAR = """
{gravity}
[frame]
O = [0, 0]
C = [0.6, 0]
[links.1]
O-A = 0.15
[links.2]
A-B = 0.5
[links.3]
C-B = 0.4
C-D = 0.2
D = "on C-B"
{mass}
[[loads]]
at = "{at}"
link = {link}
force = [{force}]
[[drivers]]
turn = 1
angle = 75
speed = 11
[branches]
B = "left of A-C"
"""


def test_a_load_on_a_fixed_pin_leaves_all_other_pins_without_force():
    """Zero forces stay zero: the frame carries a load at its own pin."""
    mechanism = mechanism_of(
        FOUR_BAR.format(gravity="", mass="", at="C", link=3, force="300, -200")
    )
    exact = exact_forces(mechanism)
    assert far_from_exact(mechanism) < ROUNDING
    for (name, link), (force, _) in exact.pairs.items():
        expected = 0 if name != "C" else (-300 + 200j) * (1 if link == "3" else -1)
        assert abs(complex(force) - expected) < 1e-40


def test_a_bar_without_mass_between_two_pins_carries_along_its_line():
    mechanism = mechanism_of(FOUR_BAR.format(gravity="", mass="", at="D", link=3, force="90, 40"))
    assert far_from_exact(mechanism) < ROUNDING
    exact = exact_forces(mechanism)
    force = exact.pairs["A", "2"][0]
    with mpmath.workdps(DIGITS):
        bar = exact.points["B"][0] - exact.points["A"][0]
        assert abs((force * mpmath.conj(bar)).imag) < mpmath.mpf("1e-50") * abs(force)


def test_masses_on_one_link_and_gravity_agree():
    mass = 'mass = 4\ncentre = "D"\ninertia = 0.3'
    mechanism = mechanism_of(
        FOUR_BAR.format(gravity="gravity = [1.5, -9.81]", mass=mass, at="B", link=2, force="9, 4")
    )
    assert far_from_exact(mechanism) < ROUNDING


@pytest.mark.parametrize("first", [2, 3, 4])
@pytest.mark.parametrize("second", [2, 3, 4])
def test_loads_on_a_pin_of_three_links_agree_on_whichever_link(first, second):
    text = scene_text("laws/three-links-on-a-pin", first=first, second=second)
    assert far_from_exact(mechanism_of(text)) < ROUNDING


ERRED = {
    20091: "a cam at rest against the link that carries it, so that nothing slips",
    20094: "a knife-edge cam on a block, which has one pin and is tried",
}
"""Seeds of ``python -m tests.chance.forces`` with ``every`` at which a route once erred."""


@pytest.mark.parametrize("seed", ERRED)
def test_random_mechanisms_have_their_forces_right(seed):
    assert judged(seed, "every") == ("agree", "")
