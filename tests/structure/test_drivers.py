"""Too few and too many drivers: the words that help."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from graphkin.construction.core.solution import Solution
from graphkin.loops.assemble import true_mobility
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.structure.decomposition import decompose
from graphkin.structure.driver_count import (
    count,
    driver_problem,
    refuse_drivers,
    refuse_wrong_drivers,
)
from graphkin.structure.groups import Higher, Unresolved
from graphkin.text.errors import StructureError
from tests.examples.scenes import mechanism, motion
from tests.mechanisms import scene_of
from tests.scene_files import scene_text
from tests.structure.test_groups import DRIVEN, FIVE_BAR, FOUR_BAR, PARALLEL, SLIDER_CRANK

EXAMPLES = Path(__file__).parents[2] / "examples" / "scenes"
OTHER = DRIVEN.replace("turn = 1", "turn = 4")


def words(text: str, true: int | None = None) -> str:
    """What is said of the drivers of a scene."""
    return str(driver_problem(scene_of(text), true) or "")


def test_too_few_are_told_with_the_count_and_a_link_that_could_be_driven():
    assert words(FIVE_BAR + DRIVEN) == (
        "drivers: 1 given, but the count 3·4 - 2·5 leaves 2 freedoms; "
        "expected as many drivers as freedoms; add a driver, such as turn = 4"
    )
    assert words(FIVE_BAR + DRIVEN + OTHER) == ""


def test_a_missing_pin_is_suspected_where_links_hang_by_one_pair():
    """Link 4's end is misspelt; what is a coupler point of a link on two pairs is not suspected."""
    loose = FIVE_BAR.replace("Q-C", "Q-X").replace("A-B = 4", 'A-B = 4\nA-M = 1\nM = "on A-B"')
    assert words(loose + DRIVEN).endswith(
        "add a driver, or a pin is missing: only one link has the points C (3), X (4)"
    )


def test_too_many_are_told_with_the_drivers_to_choose_from():
    """The rod is driven beside the crank: it alone can be spared and leaves a chain of dyads."""
    second = DRIVEN.replace("turn = 1", "turn = 2")
    assert words(SLIDER_CRANK + DRIVEN + second) == (
        "drivers: 2 given, but the count 3·3 - 2·4 leaves 1 freedom; "
        "expected as many drivers as freedoms; "
        "take turn = 2 away: its motion follows from the rest"
    )


def test_the_truth_goes_before_the_count():
    """The third parallel crank: by the count one driver is too many, in truth it is right."""
    assert words(PARALLEL + DRIVEN, true=1) == ""
    assert words(PARALLEL + DRIVEN) == (
        "drivers: 1 given, but the count 3·4 - 2·6 leaves 0 freedoms; "
        "expected as many drivers as freedoms; nothing can move, unless a constraint is idle; or a "
        "block is missing: a pin in a slot is a link of its own"
    )
    assert words(PARALLEL + DRIVEN + OTHER, true=1) == (
        "drivers: 2 given, but the rank of the constraints leaves 1 "
        "(the count 3·4 - 2·6 leaves 0); expected as many drivers as freedoms; "
        "take one driver away, of turn = 1, turn = 4: its motion follows from the rest"
    )


def refused(text: str) -> str:
    """The words in which the structure alone refuses the drivers of a scene, empty for none."""
    scene = scene_of(text)
    try:
        refuse_drivers(scene, decompose(scene))
    except StructureError as error:
        return str(error)
    return ""


def test_a_count_below_the_drivers_is_left_to_the_rank_where_a_link_may_be_idle():
    """The count is never above the truth: it refuses too few drivers, too many not always."""
    assert refused(PARALLEL + DRIVEN) == ""
    apart = PARALLEL.replace("[links.1]", "X = [0, 9]\n[links.1]") + "[links.5]\nX-Y = 1\n"
    assert refused(apart + DRIVEN + DRIVEN.replace("turn = 1", "turn = 5")) == ""
    assert "add a driver" in refused(FIVE_BAR + DRIVEN)
    with pytest.raises(StructureError, match="nothing can move"):
        refuse_wrong_drivers(scene_of(PARALLEL + DRIVEN))


def test_drivers_without_which_the_groups_are_complete_are_too_many():
    """A four-bar with two of its links driven, and a second four-bar that has its own driver."""
    second = scene_text("structure/driver-too-many")
    two = FOUR_BAR.replace("Q = [4, 0]", "Q = [4, 0]\nX = [0, 9]\nW = [4, 9]")
    two += "[links.3]\nQ-B = 2\n" + second
    third, fifth = (DRIVEN.replace("turn = 1", f"turn = {n}") for n in (3, 5))
    assert refused(two + DRIVEN + fifth) == ""
    assert refused(two + DRIVEN + third + fifth).endswith(
        "take one driver away, of turn = 1, turn = 3: its motion follows from the rest"
    )
    assert refused(PARALLEL + DRIVEN + OTHER) == (
        "drivers: 2 given, but the order of the groups leaves 1 (the count 3·4 - 2·6 leaves 0); "
        "expected as many drivers as freedoms; "
        "take one driver away, of turn = 1, turn = 4: its motion follows from the rest"
    )
    assert refused(two + DRIVEN + third) == (
        "drivers: 2 given, but link 2 would join what is driven already, while no driver moves "
        "links 5, 6, 7; expected a driver for each freedom; "
        "let a driver move link 5 instead, or add one if link 2 is idle"
    )


def test_a_track_that_only_seems_to_be_led_may_have_its_keeper_by_name():
    """A bar on a roller whose rod leads to planets that nothing else drives (made at random)."""
    text = scene_text("structure/track-held-by-its-wheel")
    assert refused(text).endswith(
        "; or, if a pin and the wheel of link 7 alone hold link 8, "
        "write link = 15 in rolls of link 7: "
        "a block of that name is put in, which keeps the wheel on its track"
    )
    assert refused(text.replace('side = "right"', 'side = "right", link = 15')) == ""


def test_links_for_which_no_group_is_found_are_no_fault_of_the_drivers():
    """One driver for one freedom, whatever the groups may be."""
    refuse_drivers(scene_of(SLIDER_CRANK + DRIVEN), (Unresolved(("2", "3")),))


def test_a_second_planet_does_not_make_a_driver_superfluous():
    """Three planets share a load: the count is -1, two contacts are idle, the arm still turns."""
    found = mechanism("gears-three-planets")
    assert count(found.scene).mobility == -1
    refuse_drivers(found.scene, found.groups)
    assert mobility(found, motion("gears-three-planets")) == 1


def test_wheels_that_hold_two_pinned_levers_fast_are_left_to_the_rank():
    """Two levers whose arcs roll on one another about centres beside their pins cannot move."""
    jammed = Mechanism(read_text(scene_text("structure/levers-that-jam"), "jam"))
    group = jammed.groups[-1]
    assert isinstance(group, Higher)
    assert group.wheels == group.at_instant == ()
    assert mobility(jammed, jammed.solve()) == 0


def mobility(found: Mechanism, solution: Solution) -> int:
    """The rank of the constraints where a mechanism stands."""
    places = {name: point.position for name, point in solution.points.items()}
    return true_mobility(found.scene, places)


@pytest.mark.parametrize(
    ("scene", "follower", "place", "driven"),
    [
        ("cam-lever", "turn = 2", "drivers[0].turn", "turn = 1"),
        ("cam-rocker", "turn = 2", "drivers[0].turn", "turn = 1"),
        ("cam-conjugate", "turn = 2", "drivers[0].turn", "turn = 1"),
        ("cam-fixed-lever", "turn = 2", "drivers[0].turn", "turn = 1"),
        ("cam-roller", "slide = 2", "drivers[0].slide", "turn = 1"),
        ("cam-flat", "slide = 2", "drivers[0].slide", "turn = 1"),
        ("cam-knife", "slide = 2", "drivers[0].slide", "turn = 1"),
        ("cam-table", "slide = 2", "drivers[0].slide", "turn = 1"),
        ("cam-plate", "slide = 2", "drivers[0].slide", "slide = 1"),
        ("cam-plate-lever", "turn = 4", "drivers[0].turn", "slide = 3"),
    ],
)
def test_a_follower_does_not_drive_its_cam(scene, follower, place, driven):
    text = (EXAMPLES / f"{scene}.toml").read_text(encoding="utf-8")
    given = "position = 5" if follower.startswith("slide") else "angle = 5"
    driver = f"[[drivers]]\n{follower}\n{given}\nspeed = 1\n"
    text = re.sub(r"\[\[drivers\]\].*?(?=\n\[|\Z)", driver, text, count=1, flags=re.DOTALL)
    with pytest.raises(StructureError) as caught:
        Mechanism(read_text(text, scene, None, {})).solve()
    (problem,) = caught.value.problems
    assert problem.place == place
    assert problem.hint == f"write {driven}"
    assert problem.changes


def test_a_block_on_one_link_is_driven_against_that():
    text = (EXAMPLES / "cylinders-two.toml").read_text(encoding="utf-8")
    without = re.sub(r"^against = .*\n", "", text, flags=re.MULTILINE)
    assert without.count("against = ") < text.count("against = ")
    assert read_text(without, "x", None, {}).drivers == read_text(text, "x", None, {}).drivers
