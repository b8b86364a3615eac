"""Whatever is asked of a point is drawn, set on the mechanism, tabulated and calculated."""

from __future__ import annotations

from functools import cache

import pytest
from msgspec.structs import replace

from graphkin.construction.core.pen import letter
from graphkin.construction.core.program import Plane, plan_vector
from graphkin.mechanism import Mechanism
from graphkin.scene.link_points import point_of
from graphkin.scene.model import FRAME
from tests.chance.checking import case
from tests.chosen import CHOSEN, EVERY
from tests.documents.sheet_tools import KINDS, mechanism_named
from tests.mechanisms import mechanism_of
from tests.scene_files import scene_text

LABS = ("pump", "pump-collinear", "slotted-lever", "offset-slider-crank")
SIGNS = {"velocity": "v", "acceleration": "a"}
PLANES = {"velocity": Plane.VELOCITIES, "acceleration": Plane.ACCELERATIONS}
SEEDS = (*range(8), 96, 250, 386) if EVERY else (0, 1, 2, 3, 386)
"""Mechanisms made at random; the last close two trials on a guide of a link that turns."""

YOKE = scene_text("construction/yoke")


def asked_of(mechanism, kind):
    """The asked points that move, under the names by which they are found."""
    scene = mechanism.scene
    names = (point_of(scene, name) for name in getattr(scene.ask, kind))
    return [n for n in names if n not in scene.frame.points and n.partition("@")[2] != FRAME]


def arrows(program, kind, plane):
    """The numbers of the arrows of a plan, or of those set on the mechanism, by their symbols."""
    found = {}
    for number, step in enumerate(program.steps):
        sign = step.of.symbol if plan_vector(step) else ""
        if step.arrow and step.plane is plane and sign.startswith(SIGNS[kind]):
            found.setdefault(sign, []).append(number)
    return found


def pole_of(program, plane):
    """The number of the pole of a plan."""
    (number,) = (
        i
        for i, step in enumerate(program.steps)
        if step.action is not None and step.action.key == "pole" and step.plane is plane
    )
    return number


def not_drawn(mechanism):
    """The asked vectors that are no arrow from the pole, or stand on the mechanism not once."""
    program, missing = mechanism.program, []
    for kind in KINDS:
        plan = arrows(program, kind, PLANES[kind])
        mounted = arrows(program, kind, Plane.MECHANISM)
        for point in asked_of(mechanism, kind):
            sign = f"{SIGNS[kind]}_{letter(point)}"
            tip, place = program.targets[kind, point], program.targets["position", point]
            o = pole_of(program, PLANES[kind])
            if [program.steps[n].args for n in plan.get(sign, ())] != [(o, tip)]:
                missing.append(f"{sign} in the plan")
            if [program.steps[n].args[:3] for n in mounted.get(sign, ())] != [(place, o, tip)]:
                missing.append(f"{sign} on the mechanism")
    return missing


def asking(mechanism, names):
    """The same mechanism, asked for the motion of other points."""
    points = tuple(names)
    ask = replace(mechanism.scene.ask, velocity=points, acceleration=points)
    return Mechanism(replace(mechanism.scene, ask=ask))


def beneath(scene):
    """The point of every guide's and track's link under what slides or rolls on it."""
    for link in scene.links.values():
        for pair in (*link.slides, *link.rolls):
            yield from (f"{point}@{pair.on}" for point in link.points)


@pytest.mark.parametrize("name", [*LABS, *CHOSEN])
def test_any_point_beneath_another_may_be_asked_for(name):
    mechanism = mechanism_named(name, 7 if name in LABS else None)
    assert not not_drawn(asking(mechanism, beneath(mechanism.scene)))


@cache
def made():
    """Mechanisms made at random that have guides or tracks."""
    found = {seed: one.mechanism for seed in SEEDS if (one := case(seed))}
    return {seed: one for seed, one in found.items() if [*beneath(one.scene)]}


def test_so_it_may_in_mechanisms_made_at_random():
    assert len(made()) > len(SEEDS) / 2
    faults = {seed: not_drawn(asking(one, beneath(one.scene))) for seed, one in made().items()}
    assert not {seed: missing for seed, missing in faults.items() if missing}


def test_the_point_of_a_link_that_only_shifts_has_an_image_of_its_own_letter():
    mechanism = mechanism_of(f'{YOKE}velocity = ["B@3"]\nacceleration = ["B@3"]\n')
    assert not not_drawn(mechanism)
    names = {step.name for step in mechanism.program.steps}
    assert {"ob_3", "o′b′_3"} <= names
    points = mechanism.solve().points
    assert points["B@3"].velocity == points["C"].velocity
    assert points["B@3"].acceleration == points["C"].acceleration


def test_the_point_of_the_frame_under_another_stands_still_and_has_no_arrow_in_the_plan():
    mechanism = mechanism_of(f'{YOKE}velocity = ["C@0"]\n')
    assert mechanism.solve().points["C@0"].velocity == 0
    assert "v_C0" not in arrows(mechanism.program, "velocity", Plane.VELOCITIES)
    (number,) = arrows(mechanism.program, "velocity", Plane.MECHANISM)["v_C0"]
    value = mechanism.trace(by_hand=True).values[number]
    assert value.tail == value.tip
