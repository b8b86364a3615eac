"""Whatever is asked of a point is drawn, set on the mechanism, tabulated and calculated."""

from __future__ import annotations

from functools import cache

import pytest
from msgspec.structs import replace

from graphkin.construction.core.pen import letter
from graphkin.construction.core.plan_vector import plan_vector
from graphkin.construction.core.program import Plane
from graphkin.construction.coriolis.coriolis import CoriolisComponent
from graphkin.drawing.symbol_markup import symbol
from graphkin.mechanism import Mechanism, point_of
from graphkin.numbers.plane import Vector
from graphkin.scene.model import FRAME
from tests.chance.checking import case
from tests.chosen import CHOSEN
from tests.documents.sheet_tools import (
    KINDS,
    calculations,
    drawings,
    drawn,
    is_label,
    kind_of,
    mechanism_named,
    named,
    relation_lines,
)
from tests.mechanisms import mechanism_of

LABS = ("pump", "pump-collinear", "slotted-lever", "offset-slider-crank")
WHICH = [(lab, n) for lab in LABS for n in (7, 30)] + [(name, None) for name in CHOSEN]
SIGNS = {"velocity": "v", "acceleration": "a"}
PLANES = {"velocity": Plane.VELOCITIES, "acceleration": Plane.ACCELERATIONS}
SEEDS = range(40)
"""Mechanisms made at random."""

YOKE = """
[frame]
O = [0, 0]
G = [120, 0]
[links.1]
O-B = 80
[links.2]
B = [0, 0]
slides = { on = 3, through = "C", angle = -90 }
[links.3]
C = [0, 0]
slides = { on = 0, through = "G", angle = 90 }
[[drivers]]
turn = 1
angle = 40
speed = 3
[ask]
"""


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
    ask = mechanism.scene.ask._replace(velocity=points, acceleration=points)
    return Mechanism(replace(mechanism.scene, ask=ask))


def beneath(scene):
    """The point of every guide's and track's link under what slides or rolls on it."""
    for link in scene.links.values():
        for pair in (*link.slides, *link.rolls):
            yield from (f"{point}@{pair.on}" for point in link.points)


@pytest.mark.parametrize("which", WHICH, ids=named)
def test_what_is_asked_is_an_arrow_from_the_pole_and_stands_on_the_mechanism_once(which):
    assert not not_drawn(mechanism_named(*which))


@pytest.mark.parametrize("which", WHICH, ids=named)
def test_what_is_asked_has_a_row_and_a_line_of_calculation(which):
    lines = [line for _, line in relation_lines(calculations(*which))]
    for drawing in drawings(*which):
        page = drawn(*which, drawing.kind).page
        rows = {mark.name for mark in page.marks if kind_of(mark) == "table"}
        for point in asked_of(mechanism_named(*which), drawing.kind):
            sign = f"{SIGNS[drawing.kind]}_{letter(point)}"
            assert sign in rows
            assert any(line.startswith(f"{symbol(sign)} = ") for line in lines), sign


@pytest.mark.parametrize("which", WHICH, ids=named)
def test_what_is_asked_is_a_vector_with_its_symbol_in_both_fields(which):
    for kind in [drawing.kind for drawing in drawings(*which)]:
        sheet = drawn(*which, kind)
        fields = {"plan": PLANES[kind], "mechanism": Plane.MECHANISM}
        for field, plane in fields.items():
            marks = sheet.marks[field]
            notes = [m.markup for m in marks if m.name == "note"]
            for point in asked_of(mechanism_named(*which), kind):
                sign = f"{SIGNS[kind]}_{letter(point)}"
                (number,) = arrows(mechanism_named(*which).program, kind, plane)[sign]
                own = [mark for mark in marks if mark.step == number]
                if any(note.startswith(f"{symbol(sign)} ") for note in notes):
                    continue  # too short to be seen, which is said below the field
                assert [m for m in own if not is_label(m)], (field, sign)
                assert symbol(sign) in [m.markup for m in own if kind_of(m) == "label"]


@pytest.mark.parametrize("which", WHICH, ids=named)
def test_no_two_vectors_on_the_mechanism_cover_one_another(which):
    for drawing in drawings(*which):
        ends = [
            tuple(round(part, 9) for z in (value.tail, value.tip) for part in (z.real, z.imag))
            for _, step, value in drawing.mechanism_steps()
            if step.arrow and isinstance(value, Vector)
        ]
        assert len(ends) == len(set(ends))


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
    assert len(made()) > 20
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


def test_a_point_that_its_link_owns_is_drawn_under_its_own_letter():
    mechanism = mechanism_of(f'{YOKE}velocity = ["B@1", "B@2", "B"]\n')
    assert not not_drawn(mechanism)
    signs = arrows(mechanism.program, "velocity", Plane.MECHANISM)
    assert set(signs) == {"v_B"}
    assert mechanism.solve().points["B@1"].velocity == mechanism.solve().points["B"].velocity


def test_the_point_of_the_frame_under_another_stands_still_and_has_no_arrow_in_the_plan():
    mechanism = mechanism_of(f'{YOKE}velocity = ["C@0"]\n')
    assert mechanism.solve().points["C@0"].velocity == 0
    assert "v_C0" not in arrows(mechanism.program, "velocity", Plane.VELOCITIES)
    (number,) = arrows(mechanism.program, "velocity", Plane.MECHANISM)["v_C0"]
    value = mechanism.trace(by_hand=True).values[number]
    assert value.tail == value.tip


@pytest.mark.parametrize(
    ("name", "letters"),
    [("slotted-lever", "ef"), ("oscillating-slide", "gh"), ("crank-slot", "gh")],
)
def test_corners_of_coriolis_triangles_bear_letters_that_no_point_bears(name, letters):
    """A point E has its images e and e′ in the plans."""
    mechanism = mechanism_named(name, 7 if name in LABS else None)
    steps = [s for s in mechanism.program.steps if isinstance(s.of, CoriolisComponent)]
    found = {s.name[0] for s in steps if s.name and s.name[0] not in "ac"}
    points = {name[0] for name in mechanism.scene.frame.points}
    points |= {name[0] for link in mechanism.scene.links.values() for name in link.points}
    assert found == {*letters}
    assert not {letter.upper() for letter in found} & points
