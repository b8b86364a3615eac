"""Bars that parallel ones make idle are left out before a group of higher class is tried."""

import re
from cmath import rect
from math import radians, sqrt

import pytest
from msgspec.structs import replace

from graphkin.construction.compile import write
from graphkin.diagnosis.closures import choices
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.structure.groups import Higher, Tie
from graphkin.structure.parallel_bars import idle_bars
from graphkin.text.errors import StructureError
from tests.scene_files import scene_text

SCHMIDT = scene_text("structure/schmidt-three-bars")
BY_A_SIDE = scene_text("structure/schmidt-by-a-side")
PLATE = scene_text("structure/plate-on-parallel-bars")


def mechanism_of(text):
    return Mechanism(read_text(text, "scene", None, {}))


@pytest.mark.parametrize(("text", "idle"), [(SCHMIDT, {"6", "9"}), (PLATE, {"b3", "b4"})])
def test_of_each_parallel_set_all_bars_but_two_are_idle(text, idle):
    """Three bars a side of a Schmidt coupling, four bars under a plate, at unequal distances."""
    mechanism = mechanism_of(text)
    assert {*idle_bars(mechanism.scene)} == idle
    assert {group.link for group in mechanism.groups if isinstance(group, Tie)} == idle
    (higher,) = (group for group in mechanism.groups if isinstance(group, Higher))
    assert idle.isdisjoint(higher.links)


@pytest.mark.parametrize("text", [SCHMIDT, PLATE])
def test_the_independent_route_agrees_with_all_bars_in_place(text):
    mechanism = mechanism_of(text)
    assert mechanism.witness(mechanism.solve(), numbered=False).agrees


def test_the_discs_of_a_schmidt_coupling_turn_alike():
    links = mechanism_of(SCHMIDT).solve().links
    for disc in "23":
        assert links[disc].omega == pytest.approx(30)
        assert links[disc].epsilon == pytest.approx(4)


@pytest.mark.parametrize(("side", "above"), [("right", 1), ("left", -1)])
def test_a_side_where_nothing_is_left_to_choose_picks_the_closure(side, above):
    """Of the closures with room for all bars: link 2 turns as link 1 and its centre is 50 mm from
    O1, 45 mm from O3; link 3 turns as link 1."""
    found = mechanism_of(BY_A_SIDE.replace('"right of', f'"{side} of')).solve()
    along = (50**2 - 45**2 + 70**2) / (2 * 70)
    centre = complex(along, above * sqrt(50**2 - along**2))
    arm = 40 * rect(1, radians(25))
    places = {"B1": centre + arm, "C1": centre - arm, "D1": 70 - arm}
    for point, place in places.items():
        assert 1e3 * found.points[point].position == pytest.approx(place)
    speed = 30j * arm
    for point, velocity in {"B1": speed, "C1": -speed, "D1": -speed}.items():
        assert 1e3 * found.points[point].velocity == pytest.approx(velocity)


def test_a_side_that_is_true_of_no_closure_of_the_number_is_refused():
    text = BY_A_SIDE.replace("closure 1", "closure 2")
    with pytest.raises(StructureError, match=r"branches\.D1: no group has a choice at D1"):
        mechanism_of(text).solve()


def test_the_plate_only_shifts():
    links = mechanism_of(PLATE).solve().links
    assert links["plate"].omega == pytest.approx(0, abs=1e-9)
    assert links["b3"].omega == pytest.approx(links["b1"].omega)


def test_the_bars_are_idle_in_any_order_of_the_links():
    scene = mechanism_of(PLATE).scene
    backwards = replace(scene, links=dict(reversed(scene.links.items())))
    assert {*idle_bars(backwards)} == {"b1", "b2"}


@pytest.mark.parametrize(
    "change", [("F3-G3 = 90", "F3-G3 = 90.01"), ("G3 = [130, -20]", "G3 = [130.01, -20]")]
)
def test_a_bar_that_is_nearly_parallel_is_refused(change):
    """A length or a pin that differs by 0.01 mm: no closure has room for all four bars."""
    scene = mechanism_of(PLATE.replace(*change)).scene
    assert "b3" not in idle_bars(scene)
    with pytest.raises(StructureError, match=r"links\.b3: .* a length that fits"):
        Mechanism(scene).solve()


def test_the_driven_bar_of_a_set_is_kept():
    text = re.sub(r"turn = .*\n", 'turn = "b3"\n', PLATE)
    assert {*idle_bars(mechanism_of(text).scene)} == {"b4", "b2"}


def test_closures_without_room_for_an_idle_bar_are_told():
    mechanism = mechanism_of(PLATE)
    program = write(mechanism.scene, mechanism.groups, fitted=False)
    (choice,) = choices(mechanism.scene, mechanism.groups, program)
    assert [each.unfit for each in choice.closures] == ["b3", "", "b3", ""]
