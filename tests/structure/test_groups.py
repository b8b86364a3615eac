"""How a mechanism is put together: counts of freedom, pairs, and Assur groups in order."""

from __future__ import annotations

from itertools import permutations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphkin.structure.decomposition import decompose
from graphkin.structure.driver_count import count
from graphkin.structure.groups import Crank, Driven, Dyad, Geared, Higher, Tie
from graphkin.structure.pairs import Contact, Joints, Pin, pairs
from graphkin.text.errors import StructureError
from tests.mechanisms import LAW, SHIPPED, mechanism_of, mechanisms, scene_of, shipped
from tests.scene_files import scene_text
from tests.structure.test_contacts import ALONE, train

PUMP = {
    "1": "[links.{1}]\nO1-A = 30",
    "2": "[links.{2}]\nO2-B = 30",
    "3": '[links.{3}]\nA-B = 40\nA-C = 20\nB-C = 25\nC = "left of A-B"',
    "4": "[links.{4}]\nC-D = 20",
    "5": '[links.{5}]\nD = [0, 0]\nslides = {{ on = 0, through = "O1", angle = 0 }}',
}
REST = """[frame]
O1 = [0, 0]
O2 = [0, -30]
[[drivers]]
turn = "{1}"
angle = 44
speed = 38
[branches]
B = "right of A-O2"
{5} = "forward"
"""
NAMES = {"1": "crank", "2": "rocker", "3": "plate", "4": "rod", "5": "piston"}


def pump_written(order, names) -> str:
    """The pump with its links in some order and under some names."""
    links = [PUMP[link].replace("{" + link + "}", names[link]).replace("{{", "{") for link in order]
    head, _, tail = REST.replace("{1}", names["1"]).replace("{5}", names["5"]).partition("[[")
    return "\n".join([head, *links, "[[" + tail]).replace("}}", "}")


# --- the pump ------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", SHIPPED)
def test_the_pump_is_a_crank_a_dyad_of_three_pins_and_a_dyad_with_a_slide(name):
    crank, first, second = decompose(shipped(name, 7).scene)
    assert isinstance(crank, Crank)
    assert (crank.link, crank.pivot) == ("1", "O1")
    assert isinstance(first, Dyad)
    assert (first.type, set(first.links), first.inner.point) == ("RRR", {"2", "3"}, "B")
    assert isinstance(second, Dyad)
    assert (second.type, second.links, second.inner.point) == ("RRP", ("4", "5"), "D")
    assert second.left == Pin("C", ("4", "3"))


def test_the_order_and_the_names_of_the_links_change_nothing():
    """All 120 orders, under numbers and under words."""
    written = {link: link for link in PUMP}
    expected = mechanism_of(pump_written("12345", written)).solve()
    for order in permutations("12345"):
        for names in (written, NAMES):
            if names is NAMES and order[0] not in "35":
                continue
            found = mechanism_of(pump_written(order, names)).solve()
            assert {p: m.position for p, m in found.points.items()} == pytest.approx(
                {p: m.position for p, m in expected.points.items()}, rel=1e-13, abs=1e-13
            )
            for point, motion in expected.points.items():
                assert found.points[point].velocity == pytest.approx(
                    motion.velocity, rel=1e-12, abs=1e-9
                )
                assert found.points[point].acceleration == pytest.approx(
                    motion.acceleration, rel=1e-12, abs=1e-8
                )
            for link in ("1", "2", "3", "4"):
                mine, theirs = found.links[names[link]], expected.links[link]
                assert mine.omega == pytest.approx(theirs.omega, rel=1e-12)
                assert mine.epsilon == pytest.approx(theirs.epsilon, rel=1e-11, abs=1e-9)


@LAW
@given(mechanisms(most=4), st.randoms(use_true_random=False))
def test_groups_use_only_what_stands_before_them_and_hold_each_link_once(made, random):
    scene = made.mechanism().scene
    known, groups = {"0"}, decompose(scene)
    for group in groups:
        if isinstance(group, Crank):
            known.add(group.link)
            continue
        assert isinstance(group, Dyad)
        assert known.isdisjoint(group.links)
        for outer in (group.left, group.right):
            assert known.intersection(outer.links)
        assert set(group.inner.links) == set(group.links)
        known.update(group.links)
    assert known == {"0", *scene.links}
    assert sum(1 if isinstance(g, Crank) else 2 for g in groups) == len(scene.links)


# --- counts --------------------------------------------------------------------------------------

DRIVEN = """
[[drivers]]
turn = 1
angle = 40
speed = 1
"""
FOUR_BAR = "[frame]\nO = [0, 0]\nQ = [4, 0]\n[links.1]\nO-A = 1\n[links.2]\nA-B = 4\n"
FIVE_BAR = FOUR_BAR + "[links.3]\nB-C = 3\n[links.4]\nQ-C = 3\n"
PARALLEL = scene_text("structure/parallel")
TRAMMEL_BAR = scene_text("structure/trammel-bar")
WATT = FOUR_BAR.replace("A-B = 4", 'A-B = 4\nA-C = 3\nB-C = 3\nC = "left of A-B"') + (
    '[links.3]\nQ-B = 3\nQ-E = 3\nB-E = 2\nE = "left of Q-B"\n'
    "[links.4]\nC-F = 4\n[links.5]\nE-F = 4\n"
)
TOGGLE_PRESS = FOUR_BAR + (
    "[links.3]\nQ-B = 3\n[links.4]\nB-C = 4\n[links.5]\nC = [0, 0]\n"
    'slides = { on = 0, through = "Q", angle = 90 }\n'
)
LIFTER = scene_text("structure/lifter")
SLIDER_CRANK = scene_text("structure/slider-crank")


@pytest.mark.parametrize(
    ("text", "moving", "lower", "freedoms"),
    [
        (SLIDER_CRANK, 3, 4, 1),
        (FOUR_BAR + "[links.3]\nQ-B = 2\n", 3, 4, 1),
        (FIVE_BAR, 4, 5, 2),
        (WATT, 5, 7, 1),
        (TOGGLE_PRESS, 5, 7, 1),
        (LIFTER, 5, 7, 1),
        (PARALLEL, 4, 6, 0),
    ],
    ids=["slider-crank", "four-bar", "five-bar", "Watt", "toggle press", "lifter", "parallel"],
)
def test_gruebler_counts_three_a_link_less_two_a_pair(text, moving, lower, freedoms):
    """The third parallel crank is idle: the count says 0 although the mechanism moves."""
    found = count(scene_of(text + DRIVEN))
    assert (found.moving, found.pairs, found.mobility) == (moving, lower, freedoms)


@pytest.mark.parametrize(("text", "pin", "links"), [(TOGGLE_PRESS, "B", 3), (LIFTER, "C", 3)])
def test_three_links_at_one_pin_are_two_pairs(text, pin, links):
    """The double hinge that fools Grübler's count."""
    at_pin = [pair for pair in pairs(scene_of(text + DRIVEN)) if pair == Pin(pin, pair.links)]
    assert len(at_pin) == links - 1


def test_a_pin_of_five_links_is_four_pairs():
    spokes = "".join(f"[links.{n}]\nO-P{n} = 1\n" for n in range(1, 6))
    assert count(scene_of("[frame]\nO = [0, 0]\n" + spokes + DRIVEN)).pairs == 5
    loose = "".join(f"[links.{n}]\nX-P{n} = 1\n" for n in range(1, 6))
    assert count(scene_of("[frame]\nP1 = [0, 0]\n" + loose + DRIVEN)).pairs == 5


# --- double hinges and higher groups -------------------------------------------------------------


def test_links_that_hang_on_one_known_pin_are_no_dyad_of_their_own():
    """Both rods of a V engine hang on the crank pin: each closes on its own block."""
    text = scene_text("structure/v-engine")
    mechanism = mechanism_of(text + DRIVEN)
    _, first, second = mechanism.groups
    assert {first.links, second.links} == {("2", "4"), ("3", "5")}
    points = mechanism.solve().points
    assert points["B"].position.real == pytest.approx(points["B"].position.imag)
    assert points["C"].position.real == pytest.approx(-points["C"].position.imag)


STEPHENSON = scene_text("structure/stephenson")
RAPID_RETURN = scene_text("structure/rapid-return")


@pytest.mark.parametrize(
    ("text", "driver", "links", "order"),
    [
        (scene_text("structure/triad"), "turn = 1", "2345", (3, 3)),
        (STEPHENSON, "turn = 1", "2345", (3, 3)),
        (STEPHENSON, "turn = 5", "1234", (4, 2)),
        (RAPID_RETURN, "turn = 1", "2345", (3, 3)),
    ],
    ids=["triad", "Stephenson II, ternary", "Stephenson II, binary", "lever on three slides"],
)
def test_groups_of_higher_class_are_named_by_class_and_order(text, driver, links, order):
    """The same six-bar has a group of class III or IV by the link that drives it."""
    crank, group = decompose(scene_of(text + DRIVEN.replace("turn = 1", driver)))
    assert isinstance(crank, Crank)
    assert isinstance(group, Higher)
    assert (set(group.links), group.order) == (set(links), order)


def test_a_hinge_of_three_links_within_a_group_is_two_of_its_pairs():
    """Six links have nine pairs: six within, H twice among them, and three outwards."""
    _, group = decompose(scene_of(scene_text("structure/hinge-within") + DRIVEN))
    inner, outer = group.joints
    assert (len(group.links), len(inner), sorted(outer)) == (6, 6, ["2", "5", "6"])
    assert group.order == (4, 3)


def test_the_same_lever_is_of_class_ii_when_a_slider_drives_it():
    slider = DRIVEN.replace("turn = 1", "slide = 4").replace("angle = 40", "position = -1")
    driven, first, second = decompose(scene_of(RAPID_RETURN + slider))
    assert isinstance(driven, Driven)
    assert isinstance(first, Dyad) and isinstance(second, Dyad)
    assert (first.type, second.type) == ("RRP", "RRP")


@pytest.mark.parametrize(("text", "idle"), [(PARALLEL, "4"), (None, "4")])
def test_a_link_between_two_known_pins_is_a_tie(text, idle):
    """The third parallel crank, and the bar to the middle of the trammel."""
    slider = DRIVEN.replace("turn = 1", "slide = 1").replace("angle = 40", "position = 1")
    groups = decompose(scene_of(text + DRIVEN if text else TRAMMEL_BAR + slider))
    assert isinstance(groups[-1], Tie)
    assert groups[-1].link == idle


def test_wheels_are_settled_by_their_contacts():
    """A planet between a ring and a sun: the arm drives it, and it drives the sun."""
    arm, planet, sun = decompose(scene_of(train() + DRIVEN))
    assert isinstance(arm, Crank)
    assert isinstance(planet, Geared) and isinstance(sun, Geared)
    assert (planet.link, sun.link) == ("2", "sun")


def test_a_wheel_that_rolls_by_itself_is_driven_along_its_track():
    (wheel,) = decompose(scene_of(ALONE + "[[drivers]]\nroll = 1\nposition = 0\nspeed = 1\n"))
    assert isinstance(wheel, Driven)
    assert isinstance(wheel.pair, Contact)


# --- the five dyads ------------------------------------------------------------------------------


# --- drivers -------------------------------------------------------------------------------------


def words(text: str) -> str:
    """The words of a refusal."""
    with pytest.raises(StructureError) as caught:
        mechanism_of(text).solve()
    return str(caught.value)


@pytest.mark.parametrize("cranks", [10, 20])
def test_a_link_is_tried_among_those_that_it_is_joined_to(cranks, monkeypatch):
    """Cranks that nothing drives: each is tried alone, not with all the others."""
    asked = []
    between = Joints.between
    monkeypatch.setattr(
        Joints, "between", lambda self, *args: (asked.append(args), between(self, *args))[1]
    )
    pivots = "".join(f"O{k} = [{k}, 0]\n" for k in range(cranks))
    links = "".join(f"[links.{k}]\nO{k}-A{k} = 1\n" for k in range(1, cranks))
    drivers = "[[drivers]]\nturn = 1\nangle = 30\nspeed = 1\n"
    decompose(scene_of(f"[frame]\n{pivots}{links}{drivers}"))
    assert len(asked) < 16 * cranks
