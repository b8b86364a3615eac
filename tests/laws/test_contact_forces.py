"""Forces of wheels and cams by all equations of equilibrium, held to formulas and to power."""

from __future__ import annotations

import math
import random
from pathlib import Path

import pytest

from graphkin.construction.core.solution import ForceSolution
from graphkin.mechanism import Mechanism
from graphkin.scene.model import FRAME
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import StructureError
from tests.chosen import FOLDER
from tests.laws.force_routes import differences, loaded

CLOSE = 1e-9


def forces_of(name: str, load: str, *changes: tuple[str, str]) -> ForceSolution:
    """The forces of a scene of the gallery with a load."""
    text = (FOLDER / f"{name}.toml").read_text(encoding="utf-8")
    for old, new in (*changes, ("[[drivers]]", f"[[loads]]\n{load}\n[[drivers]]")):
        assert old in text
        text = text.replace(old, new, 1)
    found, verdict = Mechanism(read_text(text, name, None, {})).forces()
    assert verdict.agrees and verdict.constructed
    return found


def on(found: ForceSolution, name: str, link: str) -> complex:
    return next(each.force for each in found.reactions if (each.name, each.link) == (name, link))


@pytest.mark.parametrize("moment", [40, -40])
def test_teeth_push_along_a_line_of_action_at_20_degrees(moment):
    """F_t = M/r_2, F_r = F_t·tan 20° pushes the wheels apart; the driver holds M·z_1/z_2."""
    found = forces_of("gears-pair", f"link = 2\nmoment = {moment}")
    force, radius = on(found, "2-1", "2"), 0.1
    assert math.isclose(force.imag, moment / radius, rel_tol=CLOSE)
    assert math.isclose(
        force.real, abs(moment) / radius * math.tan(math.radians(20)), rel_tol=CLOSE
    )
    (balance,) = found.balance
    assert math.isclose(balance.moment, moment * 24 / 40, rel_tol=CLOSE)


def test_plain_wheels_push_along_the_tangent():
    plain = (("module = 5\n", ""), ('teeth = "z1"', 'radius = "2.5*z1"'))
    found = forces_of(
        "gears-pair", "link = 2\nmoment = 40", *plain, ('teeth = "z2"', "radius = 100")
    )
    assert abs(on(found, "2-1", "2") - 400j) < 400 * CLOSE


def test_a_pinion_pushes_its_rack_along_the_line_of_action():
    """The force along the rack is the load; its moment is that of the radius 60 mm."""
    found = forces_of("gears-rack", 'link = 2\nat = "B"\nforce = [50, 0]')
    force = on(found, "1-2", "2")
    assert math.isclose(force.real, -50, rel_tol=CLOSE)
    assert math.isclose(abs(force.imag), 50 * math.tan(math.radians(20)), rel_tol=CLOSE)


def test_a_cam_and_its_roller_push_along_the_normal():
    """M = F·s′, and the side thrust is F·tan α with tan α = (s′ − e)/(s_0 + s); e = 10 mm left.

    At 50° of a cycloidal rise of h = 20 mm in β = 120°.
    """
    found = forces_of("cam-roller", 'link = 2\nat = "B"\nforce = [0, -100]')
    h, beta, u, base = 0.02, math.radians(120), 50 / 120, 0.05
    slope = h / beta * (1 - math.cos(2 * math.pi * u))
    rise = h * (u - math.sin(2 * math.pi * u) / (2 * math.pi))
    offset = on(found, "2-0", "2").real / 100
    (balance,) = found.balance
    assert math.isclose(balance.moment, 100 * slope, rel_tol=CLOSE)
    height = math.sqrt(base**2 - 0.01**2) + rise
    assert math.isclose(abs(offset), abs(slope - 0.01) / height, rel_tol=1e-6) or math.isclose(
        abs(offset), abs(slope + 0.01) / height, rel_tol=1e-6
    )


def test_a_flat_face_of_an_eccentric_is_pushed_square_to_the_face():
    """M = F·e·cos φ, and the guide carries the load along the face with a moment."""
    found = forces_of("cam-flat", 'link = 2\nat = "F"\nforce = [5, -100]')
    (balance,) = found.balance
    assert math.isclose(balance.moment, 100 * 0.04 * math.cos(math.radians(40)), rel_tol=CLOSE)
    assert abs(on(found, "2-1", "2") - 100j) < 100 * CLOSE


WHEELS = sorted(
    path.stem
    for path in Path(FOLDER).glob("*.toml")
    if path.stem.startswith(("gears-", "cam-", "bar-on-"))
)


@pytest.mark.parametrize("name", WHEELS)
def test_virtual_power_and_the_frame_agree_wherever_forces_are_determined(name):
    """All loads, inertia forces and reactions of the frame together do not push the mechanism."""
    text = (FOLDER / f"{name}.toml").read_text(encoding="utf-8")
    made = loaded(Mechanism(read_text(text, name, None, {})), random.Random(name))
    try:
        found, verdict = made.forces()
    except StructureError as error:
        assert "redundant" in str(error) or "cam of" in str(error) or "finite" in str(error)
        return
    assert verdict.agrees
    assert any(each.link == FRAME for each in found.reactions)


@pytest.mark.parametrize(
    ("name", "said"), [("belts-equal", "strands"), ("cam-conjugate", "roller")]
)
def test_what_equilibrium_does_not_determine_is_refused(name, said):
    with pytest.raises(StructureError) as caught:
        forces_of(name, "link = 2\nmoment = 3")
    assert said in str(caught.value)


TWO = """
graphkin = 1
title = "Two wheels"
units = {{ length = "mm", angle = "deg", speed = "rev/min" }}
{module}
[frame]
O = [0, 0]
Q = [{apart}, 40]
[links.1]
O-A = 30
wheel = {{ centre = "O", {first} }}
[links.2]
Q-B = 50
wheel = {{ centre = "Q", {second} }}
rolls = {{ on = 1, start = {{ 1 = 0, 2 = 120 }} }}
mass = 4
centre = "B"
inertia = 0.03
[[loads]]
at = "B"
link = 2
force = [60, -35]
[[drivers]]
turn = 1
angle = {angle}
speed = {speed}
acceleration = 25
[ask]
reactions = ["O", "Q", 2]
balance = true
"""
PLAIN = {"module": "", "apart": 30, "first": "radius = 20", "second": "radius = 30"}
TEETH = {"module": "module = 2", "apart": 30, "first": "teeth = 20", "second": "teeth = 30"}
RING = {**PLAIN, "first": "radius = 100, inside = true", "second": "radius = 50"}
INSIDE = {**PLAIN, "first": "radius = 50", "second": "radius = 100, inside = true"}


@pytest.mark.parametrize(
    "wheels", [PLAIN, TEETH, RING, INSIDE], ids=["plain", "teeth", "ring", "in"]
)
@pytest.mark.parametrize("angle", [10, 130, 250])
@pytest.mark.parametrize("speed", [90, -200])
def test_the_drawn_force_of_a_wheel_is_that_of_the_equations(wheels, angle, speed):
    text = TWO.format(**wheels, angle=angle, speed=speed)
    mechanism = Mechanism(read_text(text, "two", None, {}))
    assert max(differences(mechanism)) < CLOSE


def test_a_chain_of_wheels_passes_the_moment_on():
    """M_1 = M_3·ω_3/ω_1 without masses; each tooth force is that moment over its base radius."""
    file = Path(__file__).parents[1] / "scenes" / "forces" / "gears.toml"
    text = (
        file.read_text(encoding="utf-8")
        .replace("mass = 6", "mass = 0")
        .replace("mass = 9", "mass = 0")
    )
    text = text.replace("inertia = 0.02", "").replace("inertia = 0.05", "")
    mechanism = Mechanism(read_text(text, "train", None, {}))
    found, verdict = mechanism.forces()
    assert verdict.agrees and max(differences(mechanism)) < CLOSE
    (balance,) = found.balance
    assert math.isclose(balance.moment, -30 * 18 / 38, rel_tol=CLOSE)
    base = 0.095 * math.cos(math.radians(20))
    assert math.isclose(abs(on(found, "3-2", "3")), 30 / base, rel_tol=CLOSE)
