"""What the scene does not call for is not run: steps counted by their actions, on every scene.

The counts look at what a step does (its action, its plane, the module its action comes from), not
at the effect that it says it is drawn for; where both are looked at, they are held together.
"""

from __future__ import annotations

from collections import Counter

import pytest
from msgspec.structs import replace

from graphkin.construction.core.program import Effect, Part, Plane
from graphkin.diagnosis.effects import (
    BY_COMMAND,
    BY_HAND,
    EFFECTS,
    EffectRow,
    effect_of,
    effects,
    parted,
)
from graphkin.mechanism import Mechanism
from graphkin.scene.model import FRAME, Ask, Scene
from graphkin.scene.read_scene import read_text
from tests.chosen import CHOSEN
from tests.diagnosis.scope import (
    FILES,
    accelerations,
    asking,
    counted,
    keys,
    points,
    shipped,
    steps,
    turning_guides,
    untouched,
    velocities,
)
from tests.loops.loops_alone import as_solution

EVERY = pytest.mark.parametrize("name", ["pump", *CHOSEN])
CORIOLIS = {"coriolis"}
LAID_OFF = {"lay-off", "lay-back"}
OF_ACCELERATION = {"centripetal", "driven-tangential", "normal", "epsilon", "rolling-normal"}
OF_ACCELERATION |= CORIOLIS | {"acceleration-pole", "turned-pole"}
OUT_WITH_ACCELERATION = (
    "acceleration",
    "driver acceleration",
    "normal components",
    "tangential components",
    "Coriolis",
    "acceleration poles",
)


def rows(mechanism: Mechanism) -> dict[str, EffectRow]:
    """The effects of a mechanism by name."""
    return {row.name: row for row in effects(mechanism)}


def drawn_for(mechanism: Mechanism) -> Counter[Effect]:
    """How many steps each effect has."""
    return Counter(parted(mechanism).values())


@EVERY
def test_the_effects_add_up_to_the_steps_that_are_asked(name):
    mechanism = shipped(name)
    program, asked = mechanism.program, mechanism.asked()
    found = rows(mechanism)
    assert sum(found[each].steps for each in EFFECTS) == len(program.needed(asked))
    drawn = len(program.needed(asked, by_hand=True)) - len(program.needed(asked))
    assert found[BY_HAND].steps == drawn
    assert set(found) == {*EFFECTS, BY_HAND, *BY_COMMAND}


@EVERY
def test_an_effect_is_in_where_it_has_steps_and_out_where_it_has_none(name):
    for row in effects(shipped(name)):
        shares = row.name == "centrodes" and shipped(name).scene.ask.centrodes
        assert row.included == (row.steps > 0) or shares, row
        assert row.reason


@pytest.mark.parametrize("name", ["pump", "centrodes-cardan", "inflection-cardan"])
def test_centrodes_alone_follow_the_centres_that_are_asked_anyway(name):
    mechanism = shipped(name)
    follow = "the centres that are asked anyway, followed over the motion"
    told = {row.name for row in effects(mechanism) if row.reason == follow}
    assert told == ({"centrodes"} if mechanism.scene.ask.centrodes else set())


@EVERY
def test_no_more_is_run_than_what_is_asked_needs(name, monkeypatch):
    mechanism = untouched(shipped(name))
    needed = steps(mechanism)
    with counted(monkeypatch) as ran:
        mechanism.solve(asked=True)
    assert [id(step) for step in ran] == [id(step) for step in needed]


@EVERY
def test_a_velocity_runs_no_step_of_an_acceleration(name, monkeypatch):
    mechanism = untouched(velocities(name))
    with counted(monkeypatch) as ran:
        mechanism.solve(asked=True)
    assert ran
    assert not [step for step in ran if step.plane is Plane.ACCELERATIONS]
    assert not [s for s in ran if s.part in (Part.ACCELERATION, Part.NORMAL, Part.POLE)]
    assert not OF_ACCELERATION & {step.action.key for step in ran if step.action}
    given = {id(mechanism.program.steps[drive.acceleration]) for drive in mechanism.program.drives}
    shared = {id(mechanism.program.steps[drive.speed]) for drive in mechanism.program.drives}
    assert not (given - shared) & {id(step) for step in ran}
    counts = drawn_for(mechanism)
    assert not [effect for effect in OUT_WITH_ACCELERATION if counts[effect]]


@EVERY
def test_a_position_runs_no_step_of_a_velocity(name):
    scene = shipped(name).scene
    mechanism = asking(name, Ask(curves=points(scene)))
    assert not [s for s in steps(mechanism) if s.plane not in (Plane.NUMBERS, Plane.MECHANISM)]
    counts = drawn_for(mechanism)
    out = (*OUT_WITH_ACCELERATION, "velocity", "instantaneous centres", "centrodes")
    assert not [effect for effect in out if counts[effect]]


@EVERY
def test_coriolis_only_where_a_guide_turns(name):
    mechanism = accelerations(name)
    found = keys(mechanism) & CORIOLIS
    if found:
        assert turning_guides(mechanism.scene) or kept_parallel(mechanism.scene)
    elif not turning_guides(mechanism.scene):
        assert not CORIOLIS & {s.action.key for s in mechanism.program.steps if s.action}
    labelled = {s.action.key for s in steps(mechanism) if effect_of(s) == "Coriolis"}
    assert labelled - LAID_OFF == found


def kept_parallel(scene: Scene) -> bool:
    """Whether a guide's link rides on two wheels of one size on parallel lines: it would turn
    if one were larger, and so its guide has a Coriolis component, of no length."""
    solution = shipped(scene.name).solve()
    for name in {slide.on for link in scene.links.values() for slide in link.slides} - {FRAME}:
        wheels = [
            (rolling.on, rolling.angle.si(scene.values), wheel.radius.si(scene.values))
            for link in scene.links.values()
            for wheel in link.wheels
            for rolling in link.rolls
            if wheel.centre in scene.links[name].points and rolling.angle is not None
        ]
        if len(wheels) == 2 and wheels[0] == wheels[1]:
            assert solution.links[name].omega == pytest.approx(0, abs=1e-12)
            return True
    return False


@EVERY
def test_every_block_on_a_guide_that_turns_has_its_coriolis_component(name):
    """2 ω × v_rel, as the independent route finds it, is zero for every block that has none.

    A wheel's centre slides along a track as the unseen link does that keeps it on that track.
    """
    mechanism, found = shipped(name), loops_of(name)
    blocks = as_solution(found).slides
    for number, guide in enumerate(found.loops.guides):
        (vector,) = found.motion.slide(number)[-1]
        rolls = () if guide.turns_alike else mechanism.scene.link(guide.block).rolls
        if rolls and (keeper := rolls[guide.number].keeper):
            assert vector == pytest.approx(blocks[keeper].coriolis, abs=1e-9), guide
        elif guide.first:
            assert mechanism.gives(("coriolis", guide.block)) or abs(vector) == 0, guide


def loops_of(name):
    """The motion by the vector loops alone."""
    from graphkin.loops.equations import equations
    from graphkin.loops.newton import solve

    scene, solution = shipped(name).scene, shipped(name).solve()
    places = {p: m.position for p, m in solution.points.items() if "@" not in p}
    slides = {b: s.position for b, s in solution.slides.items()}
    return solve(equations(scene), places, slides)


@EVERY
def test_an_accelerated_driver_only_where_one_is(name):
    mechanism = asking(name, Ask())
    accelerated = [d for d in mechanism.scene.drivers if not d.acceleration.is_zero()]
    if not accelerated:
        assert not drawn_for(mechanism)["driver acceleration"]
    drawn = drawn_for(accelerations(name))["driver acceleration"] > 0
    assert drawn == bool(accelerated) or closes(name)


def closes(name: str) -> bool:
    """Whether a driver closes a group of higher class: what it is given is missed, not laid off."""
    keys_ = {step.action.key for step in shipped(name).program.steps if step.action}
    return bool(keys_ & {"less", "speed-rolled"})


@EVERY
def test_only_what_is_named_has_centres_and_poles(name):
    mechanism = accelerations(name)
    parts = Counter(step.part for step in steps(mechanism))
    assert not parts[Part.CENTRE]
    assert not parts[Part.POLE]
    for link in shipped(name).scene.links:
        if shipped(name).gives(("centre", link)):
            alone = drawn_for(asking(name, Ask(centres=(link,))))
            assert alone["instantaneous centres"] >= 1
            assert not alone["acceleration poles"]
            assert not alone["acceleration"]
        if shipped(name).gives(("pole", link)):
            alone = drawn_for(asking(name, Ask(poles=(link,))))
            assert alone["acceleration poles"] >= 1
            assert not alone["instantaneous centres"]


CRANK = """
graphkin = 1
title = "Crank and slot"
{time}
units = {{ length = "mm", angle = "deg", speed = "rad/s" }}
[frame]
O1 = [0, 0]
O2 = [0, -80]
[links.1]
O1-A = 30
[links.2]
A = [0, 0]
slides = {{ on = 3, along = "O2-B" }}
[links.3]
O2-B = 150
[[drivers]]
turn = 1
{driver}
[branches]
2 = "forward"
[ask]
acceleration = ["B"]
"""


def slot(driver: str, time: str = "") -> Mechanism:
    """A crank that drives a slotted lever."""
    return Mechanism(read_text(CRANK.format(driver=driver, time=time), "slot"))


def test_a_law_of_time_takes_the_place_of_the_numbers_that_it_gives():
    steady = drawn_for(slot("angle = 40\nspeed = 3"))
    timed = drawn_for(slot('angle = "40 + 30*t**2"', "time = 0.2"))
    assert timed["laws of time"] == 2  # position and speed; the acceleration of 30 t² is a number
    assert steady["data and shapes"] - timed["data and shapes"] == 1
    assert timed["driver acceleration"] == 1


def test_a_driver_whose_acceleration_is_a_parameter_keeps_its_step_at_zero():
    text = CRANK.replace("[frame]", "[parameters]\ne = {{ value = 0 }}\n[frame]")
    driver = 'angle = 40\nspeed = 3\nacceleration = "e"'
    mechanism = Mechanism(read_text(text.format(driver=driver, time=""), "slot"))
    assert drawn_for(mechanism)["driver acceleration"] == 1


def test_the_slotted_lever_counted_by_eye():
    """Coriolis: the vector, laid back from the block's image; normal: of the crank, of the lever
    (vector and laying off); tangential: the lever's perpendicular."""
    found = drawn_for(slot("angle = 40\nspeed = 3"))
    assert found["Coriolis"] == 2
    assert found["normal components"] == 3
    assert found["tangential components"] == 1
    assert found["driver acceleration"] == found["rolling"] == found["gears"] == 0


def test_the_pump_counted_by_eye():
    """Normal components: the crank's, and for AB, O2B and CD vector and laying off; a
    perpendicular for each of those three bars; one centre, two poles."""
    found = drawn_for(shipped("pump"))
    assert found["normal components"] == 1 + 3 * 2
    assert found["tangential components"] == 3
    assert (found["instantaneous centres"], found["acceleration poles"]) == (1, 2)
    assert found["rates of links and slides"] == 6


def test_what_brings_an_effect_in_is_told_before_what_needs_it():
    rows = {row.name: row.reason for row in effects(shipped("pump"))}
    cause, needed = rows["normal components"].split("; ", 1)
    assert cause == "points that move about others need a normal component"
    assert needed.startswith("needed for acceleration of D")


@EVERY
def test_what_an_effect_is_needed_for_is_found_by_taking_it_away(name):
    """A target whose slice has a step of an effect is named in its reason, and no other."""
    mechanism = shipped(name)
    program, whole = mechanism.program, parted(mechanism)
    for row in effects(mechanism):
        if row.name not in EFFECTS or not row.steps:
            continue
        needs = {
            target
            for target in mechanism.asked()
            if any(whole[number] == row.name for number in program.needed([target]))
        }
        if needs == set(mechanism.asked()):
            assert row.reason.endswith("needed for all that is asked")
        else:
            told = row.reason.rpartition("needed for ")[2]
            named = {
                (quantity, of)
                for part in told.split("; ")
                for quantity, _, names in [part.partition(" of ")]
                for of in names.split(", ")
            }
            assert named == needs


def test_nothing_is_out_for_what_a_mutilated_program_still_has():
    """A step without an effect of its own is told by its part: none is left unnamed."""
    for name in FILES:
        for step in shipped(name).program.steps:
            assert effect_of(step) in EFFECTS
            assert effect_of(replace(step, effect=None)) in EFFECTS


def test_what_keeps_an_effect_out_is_what_the_scene_lacks():
    out = {row.name: row.reason for row in effects(shipped("pump")) if not row.included}
    expected = {
        "rolling": "no wheel rolls along a track",
        "gears": "no wheels are in mesh",
        "Coriolis": "the guide of 5 does not turn",
    }
    assert {effect: out[effect] for effect in expected} == expected
