"""A link that slides on two pins: they guide it, and nothing has to be tried."""

from cmath import phase
from math import asin, degrees, hypot

import pytest
from msgspec.structs import replace

from graphkin.mechanism import Mechanism
from graphkin.scene.model import Way
from graphkin.scene.read_scene import read_text
from graphkin.structure.groups import Higher, OnTwoPins, Tie
from graphkin.text.errors import StructureError
from tests.scene_files import scene_text, scene_texts

SCENES = scene_texts("structure/pins")


def mechanism_of(text):
    return Mechanism(read_text(text, "scene", None, {}))


def found(name):
    return mechanism_of(SCENES[name])


@pytest.mark.parametrize("name", SCENES)
def test_two_pins_guide_a_link_and_nothing_is_tried(name):
    """On the frame and on moving links, in line and beside one another, however it is driven."""
    groups = found(name).groups
    assert sum(isinstance(group, OnTwoPins) for group in groups) == 1
    assert not any(isinstance(group, Higher) for group in groups)


@pytest.mark.parametrize("name", SCENES)
def test_the_independent_route_agrees(name):
    mechanism = found(name)
    verdict = mechanism.witness(mechanism.solve())
    assert verdict.agrees and not verdict.branches


@pytest.mark.parametrize("name", SCENES)
def test_the_other_way_round_is_another_closure(name):
    """The rail turned over on its pins is told from how it stands, by the witness too."""
    scene = found(name).scene
    (group,) = (each for each in found(name).groups if isinstance(each, OnTwoPins))
    key = group.inner.named
    turned = {**scene.branches, key: Way(-scene.branches[key].way)}
    verdict = Mechanism(scene).witness(Mechanism(scene).solve())
    assert verdict.agrees
    stands = Mechanism(scene).solve()
    other = Mechanism(replace(scene, branches=turned))
    assert key in other.witness(stands).branches


def test_a_bar_on_two_pins_moves_as_on_a_guide():
    """Both pins on the x axis: the same bar written as a slider has the same motion."""
    pins = found("bar-and-cylinder").solve().points
    slide = mechanism_of(scene_text("structure/bar-on-a-slide")).solve().points
    for point in ("P1", "P2"):
        for kind in ("velocity", "acceleration"):
            assert getattr(pins[point], kind) == pytest.approx(getattr(slide[point], kind))


def test_slots_apart_lean_against_the_line_of_their_pins():
    """Slots 20 mm apart on pins F, G: the sine of the angle is their distance over FG."""
    mechanism = found("plate-with-two-slots")
    turned = phase(mechanism.trace([("axis", "plate")]).value("axis", "plate"))
    line = phase(complex(70, 30))
    assert degrees(turned - line) == pytest.approx(degrees(asin(20 / hypot(70, 30))))


def closed_plates():
    """P1 of a plate on the x axis, 190.591 mm from P5, by the direction of the plate's own axis.

    Its guide lies along the x axis, and P1 is 45 mm to its left.
    """
    for turn in (1, -1):
        reach = (190.591**2 - (60 - 45 * turn) ** 2) ** 0.5
        yield from (complex(250 + way * reach, 45 * turn) for way in (-1, 1))


@pytest.mark.parametrize("number", [1, 2, 3, 4])
def test_the_number_of_a_closure_is_read_as_ways(number):
    """The closures in order: by the angle of the plate, 0 and 180 degrees, then by the tube's."""
    text = SCENES["plate-by-its-closure"].replace("closure 1", f"closure {number}")
    points = mechanism_of(text).solve().points
    assert 1e3 * points["P1"].position == pytest.approx([*closed_plates()][number - 1])


def test_a_plate_by_its_closure_slides_along():
    """P1 goes along x, so that its distance from P5 grows at 7 mm/s."""
    found = mechanism_of(SCENES["plate-by-its-closure"]).solve()
    arm = 1e3 * found.points["P1"].position - complex(250, 60)
    speed = 7 * abs(arm) / arm.real
    assert arm.real == pytest.approx(60.000186102 - 250)
    assert 1e3 * found.points["P1"].velocity == pytest.approx(speed)
    gained = (7**2 - speed**2) / arm.real
    assert 1e3 * found.points["P1"].acceleration == pytest.approx(gained)
    assert found.links["L0"].omega == pytest.approx(0)


def test_a_number_beyond_the_closures_is_refused():
    text = SCENES["plate-by-its-closure"].replace("closure 1", "closure 5")
    with pytest.raises(StructureError, match=r'branches\.L0: "closure 5" .*"forward"'):
        mechanism_of(text).solve()


def test_a_way_beside_the_number_is_kept():
    """Of the plate's closures with s0 backward the first is the second of all."""
    text = SCENES["plate-by-its-closure"] + 's0 = "backward"\n'
    points = mechanism_of(text).solve().points
    assert 1e3 * points["P1"].position == pytest.approx([*closed_plates()][1])


def test_a_third_bushing_is_idle():
    groups = found("three-bushings").groups
    assert [group.link for group in groups if isinstance(group, Tie)] == ["b3"]


def test_a_third_bushing_beside_the_line_is_refused():
    text = SCENES["three-bushings"].replace("H = [20, 190]", "H = [21, 190]")
    with pytest.raises(StructureError, match="beside its guide"):
        mechanism_of(text).solve()


def test_the_way_round_is_asked_for():
    text = SCENES["rod-in-two-bushings"].replace('rod = "forward"\n', "")
    with pytest.raises(StructureError, match=r"branches\.rod: .*forward puts G ahead of F"):
        mechanism_of(text).solve()


def test_guides_that_are_not_parallel_are_none():
    """Slots at an angle hold the plate in no direction: its group is tried."""
    text = SCENES["plate-with-two-slots"].replace("S = [160, 10]", "S = [160, 11]")
    with pytest.raises(StructureError, match="closure 1"):
        mechanism_of(text).solve()
