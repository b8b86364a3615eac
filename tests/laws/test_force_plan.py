"""Laws of the drawn plan of forces: polygons and lever give what the other routes give."""

from __future__ import annotations

import math
import random
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphkin.construction.core.kind import constructions
from graphkin.construction.core.solution import by_name
from graphkin.construction.forces.force_plan import undrawn
from graphkin.construction.forces.lever import LeverBalance
from graphkin.construction.forces.loads import AppliedForce, InertiaForce
from graphkin.documents.force_fields import traced
from graphkin.loops.equilibrium import by_equations, equilibrium
from graphkin.mechanism import Mechanism
from graphkin.numbers.plane import cross
from graphkin.scene.model import FRAME
from graphkin.scene.read_scene import read_text
from tests.chance.checking import told
from tests.chance.forces import dyads
from tests.chance.making import made
from tests.chosen import FOLDER
from tests.laws.force_routes import differences, loaded
from tests.laws.test_forces import (
    CROSSED,
    FOUR_BAR,
    SLIDER,
    SWINGING,
    TWO_BLOCKS,
    four_bar,
    solved,
    three_links,
)
from tests.mechanisms import LAW, mechanism_of, mechanisms

EVERY = [SLIDER, SWINGING, CROSSED, TWO_BLOCKS, three_links(2), three_links(4)]
NAMES = ["RRP", "RPR", "RPP", "PRP", "RRR", "RRR-shared"]
CLOSE = 1e-12
SCENES = Path(__file__).parents[1] / "scenes" / "forces"


@pytest.mark.parametrize("text", EVERY, ids=NAMES)
def test_polygons_and_lever_give_the_solution(text):
    assert max(differences(mechanism_of(text))) < CLOSE


@pytest.mark.parametrize("seed", range(40))
def test_polygons_and_lever_give_the_solution_of_random_four_bars(seed):
    assert max(differences(mechanism_of(four_bar(random.Random(seed))))) < 1e-9


@pytest.mark.parametrize("seed", range(20))
@pytest.mark.parametrize("text", EVERY[:4], ids=NAMES[:4])
def test_they_do_for_random_loads_in_every_group(text, seed):
    """Other loads, speeds and positions of the same dyads."""
    rng = random.Random(seed)
    old = text.partition("force = [")[2].partition("]")[0]
    text = text.replace(f"[{old}]", f"[{rng.uniform(-900, 900)}, {rng.uniform(-900, 900)}]")
    for key in ("speed = 20", "speed = 12", "speed = 10", "speed = 0.7"):
        text = text.replace(f"{key}\n", f"speed = {rng.uniform(-25, 25)}\n")
    for key, low, high in (("angle = 50\n", 35, 85), ("angle = 25\n", 0, 60)):
        text = text.replace(key, f"angle = {rng.uniform(low, high)}\n")
    assert max(differences(mechanism_of(text))) < 1e-9


OTHERS = {
    "cylinder": ("cylinders-two",),
    "cam": ("cam-roller", "cam-knife", "cam-flat", "cam-plate", "cam-fixed", "cam-carried"),
    "lever of a cam": ("cam-rocker", "cam-lever", "cam-plate-lever", "cam-fixed-lever"),
    "wheel on an arm": ("gears-planet", "gears-ring", "gears-lever", "gears-sun-and-planet"),
    "rack": ("gears-rack", "bar-on-roller"),
    "class III": ("stephenson-3-crank", "stephenson-2-ternary", "link-motion"),
    "driven wheel": ("roller", "centrodes-roller", "plank-hinged"),
    "arm driven against an arm": ("excavator-absolute", "excavator-relative"),
}
"""Scenes of the gallery by the kind of group whose forces they have."""


@pytest.mark.parametrize("moment", [-60, 80])
@pytest.mark.parametrize("angle", [0, 30, 200])
@pytest.mark.parametrize("plain", [False, True])
def test_a_planet_between_two_wheels_gives_the_forces_of_the_equations(moment, angle, plain):
    """Also without teeth, which push along the tangent alone."""
    text = (SCENES / "planetary.toml").read_text(encoding="utf-8")
    text = text.replace("moment = -60", f"moment = {moment}")
    text = text.replace("= 30\nspeed", f"= {angle}\nspeed")
    if plain:
        text = text.replace("module = 4\n", "")
        text = re.sub(r"teeth = (\d+)", lambda m: f"radius = {2 * int(m[1])}", text)
    mechanism = Mechanism(read_text(text, "planetary", None, {}))
    assert max(differences(mechanism)) < 1e-11


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("name", [name for some in OTHERS.values() for name in some])
def test_every_other_group_gives_the_forces_of_the_equations(name, seed):
    """Cylinders, cams, wheels on arms, racks and groups of class III, at random loads."""
    text = (FOLDER / f"{name}.toml").read_text(encoding="utf-8")
    made = loaded(Mechanism(read_text(text, name, None, {})), random.Random(seed))
    if undrawn(made.scene, made.laid[0]) is not None:
        pytest.fail(f"{name} is not drawn")
    assert max(differences(made)) < 1e-9


@pytest.mark.parametrize("seed", [41, 84, 94, 107, 128, 10028, 10094])
def test_racks_aside_of_their_guides_and_guides_without_force_agree(seed):
    """A rack's track off the line of its guide, and a couple beside a force that is rounding."""
    case = told(seed, *made(seed))
    assert max(differences(loaded(case.mechanism, random.Random(seed)))) < 1e-9


def test_the_place_of_a_guide_s_reaction_is_that_of_the_solution():
    for text in (SLIDER, TWO_BLOCKS):
        mechanism = mechanism_of(text)
        found, _ = mechanism.forces()
        trace = traced(mechanism)
        for each in constructions(trace.program, AppliedForce):
            for other in by_name(found, each.name[-1]).values() if each.look == "reaction" else ():
                on_block = next(e for e in other if e.link == each.name[-1])
                force, place = trace.values[each.force], trace.values[each.place]
                if on_block.at is not None and abs(force - on_block.force) < CLOSE * abs(force):
                    assert abs(cross(place - on_block.at, force)) < 1e-9 * abs(force)


def test_a_moved_inertia_force_has_the_moment_of_the_link():
    trace = traced(mechanism_of(SLIDER))
    (rod,) = (e for e in constructions(trace.program, InertiaForce) if e.place is not None)
    value = trace.values
    turned = cross(value[rod.place] - value[rod.centre], value[rod.force])
    assert math.isclose(turned, value[rod.moment], rel_tol=CLOSE)
    assert math.isclose(turned, -value[rod.inertia] * value[rod.epsilon], rel_tol=CLOSE)


# --- what must hold of every equilibrium ---------------------------------------------------------


def outer_forces(mechanism: Mechanism) -> Iterator[tuple[complex, complex]]:
    """The place and the force of each load, inertia force and reaction of the frame."""
    trace = traced(mechanism)
    for each in constructions(trace.program, AppliedForce):
        if each.look in ("load", "inertia") or each.name.startswith("R_0"):
            yield trace.values[each.place], trace.values[each.force]


@pytest.mark.parametrize("text", EVERY[:3], ids=NAMES[:3])
def test_frame_reactions_loads_and_inertia_forces_add_up_to_zero(text):
    forces = [force for _, force in outer_forces(mechanism_of(text))]
    assert abs(sum(forces)) < CLOSE * sum(map(abs, forces))


def test_their_moments_about_any_point_are_the_balancing_moment_reversed():
    mechanism = mechanism_of(SLIDER)
    found, _ = mechanism.forces()
    (balance,) = found.balance
    some = list(outer_forces(mechanism))
    for about in (0j, 3 - 2j, -0.4 + 0.1j):
        turned = sum(cross(place - about, force) for place, force in some)
        assert math.isclose(turned, -balance.moment, rel_tol=1e-9)


def test_doubled_masses_and_loads_double_every_reaction():
    once, twice = SLIDER, SLIDER.replace("mass = 2", "mass = 4").replace("mass = 3", "mass = 6")
    twice = twice.replace("inertia = 0.05", "inertia = 0.1").replace("[-500, 40]", "[-1000, 80]")
    for one, other in zip(solved(once).reactions, solved(twice).reactions, strict=True):
        assert abs(2 * one.force - other.force) <= CLOSE * abs(other.force)


def energy(mechanism: Mechanism) -> float:
    """Kinetic and potential energy of the masses of a mechanism."""
    scene, found = mechanism.scene, mechanism.solve()
    total = 0.0
    for link, each in scene.forces.masses.items():
        m, point = float(each.mass.si({})), found.points[each.centre]
        total += m * abs(point.velocity) ** 2 / 2 + 9.81 * m * point.position.imag
        if each.inertia is not None:
            total += float(each.inertia.si({})) * float(found.links[link].omega) ** 2 / 2
    return total


def test_the_driver_s_power_is_the_growth_of_energy():
    """Without loads, M·ω is the derivative of kinetic and potential energy."""
    text, omega, step = SLIDER.replace("[-500, 40]", "[0, 0]"), 20.0, 1e-4
    (balance,) = solved(text).balance
    before, after = (
        energy(mechanism_of(text.replace("angle = 50", f"angle = {50 + math.degrees(turn)}")))
        for turn in (-step, step)
    )
    growth = (after - before) / (2 * step / omega)
    assert math.isclose(balance.moment * omega, growth, rel_tol=1e-6)


BALANCED = """
[frame]
O = [0, 0]
C = [0.5, 0]
[links.1]
O-A = 0.1
O-S1 = {s1}
S1 = "beyond O on A-O"
mass = 2
centre = "S1"
inertia = 0.01
[links.2]
A-B = 0.45
A-S2 = 0.15
S2 = "on A-B"
mass = 1.5
centre = "S2"
inertia = 0.03
[links.3]
C-B = 0.4
C-S3 = {s3}
S3 = "beyond C on B-C"
mass = 3
centre = "S3"
inertia = 0.05
[[drivers]]
turn = 1
angle = {angle}
speed = 15
[branches]
B = "left of A-C"
"""


@pytest.mark.parametrize("angle", [10, 95, 200, 310])
def test_the_frame_of_a_balanced_four_bar_is_not_shaken(angle):
    """R. S. Berkof, G. G. Lowen, A new method for completely force balancing simple linkages, 1969.

    m1·s1 = m2·a·(b − r)/b and m3·s3 = m2·c·r/b, both beyond the fixed pins.
    """
    s1, s3 = 1.5 * 0.1 * (0.45 - 0.15) / 0.45 / 2, 1.5 * 0.4 * 0.15 / 0.45 / 3
    text = BALANCED.format(s1=s1, s3=s3, angle=angle)
    found = solved(text)
    on_frame = [each.force for each in found.reactions if each.link == FRAME]
    assert abs(sum(on_frame)) < 1e-9 * max(map(abs, on_frame))


def test_the_lever_needs_one_driver_that_moves():
    still = traced(
        mechanism_of(
            FOUR_BAR.format(
                a=0.1,
                b=0.5,
                c=0.4,
                d=0.55,
                e=0,
                s=0.35,
                r=0.35,
                fx=1,
                fy=2,
                m=3,
                angle=40,
                speed=0,
                rate=0,
            )
        )
    )
    assert not [*constructions(still.program, LeverBalance)]


@LAW
@given(mechanisms(most=3), st.integers(0, 10**6))
def test_they_do_for_chains_of_dyads_with_masses_and_loads_at_random(made, seed):
    mechanism = loaded(made.mechanism(), random.Random(seed))
    assert max(differences(mechanism), default=0.0) < 1e-9


@pytest.mark.parametrize("seed", [73, 408, 577, 909, 910687, *range(12)])
def test_they_do_for_chains_of_all_dyads_with_masses_and_loads_at_random(seed):
    """73: a mass without acceleration on a link that turns; 408: a guide with a couple alone.

    909: loads that do no work; 910687: a couple on a block whose guide has no force.
    ``python -m tests.chance.forces 2000`` looks at more.
    """
    made = dyads(seed)
    assert made is not None
    assert max(differences(loaded(made.mechanism, random.Random(seed)))) < 1e-9


@pytest.mark.parametrize("text", EVERY, ids=NAMES)
def test_the_equations_alone_give_what_the_groups_give(text):
    """The numbers of groups that have no construction, where there is one to compare with."""
    mechanism = mechanism_of(text)
    found, _ = mechanism.forces()
    motion = mechanism.check.examine(mechanism.solve(), numbered=0).solved.motion
    here = equilibrium(mechanism.scene, mechanism.scene.forces, motion)
    others = {(e.name, e.link): e for e in by_equations(mechanism.scene, motion, here).reactions}
    largest = max(abs(each.force) for each in found.reactions)
    for each in found.reactions:
        other = others[each.name, each.link]
        assert abs(each.force - other.force) < 1e-9 * largest
        assert abs(each.moment - other.moment) < 1e-9 * largest
        assert each.block == other.block
