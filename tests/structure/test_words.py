"""How check tells what a mechanism is made of: pairs, counts, loops, drivers and groups."""

from __future__ import annotations

import pytest

from graphkin.cli.report.structure_report import group_lines, structure
from graphkin.structure.decomposition import decompose
from tests.mechanisms import scene_of
from tests.structure.test_contacts import ALONE, plates, rack, train
from tests.structure.test_groups import (
    DRIVEN,
    FOUR_BAR,
    RAPID_RETURN,
    SLIDER_CRANK,
    SLOTTED_LEVER,
    STEPHENSON,
    TOGGLE_PRESS,
)


def part(text: str, label: str) -> list[str]:
    """The lines of one part of the report on a scene."""
    found, inside = [], False
    for line in structure(scene_of(text)):
        inside = line.startswith(label) or (inside and line.startswith(" "))
        found += [line[11:]] if inside else []
    return found


def groups(text: str) -> list[str]:
    """The groups of a scene in words."""
    return group_lines(decompose(scene_of(text)))


def test_a_hinge_of_three_links_is_said_to_count_twice():
    assert part(TOGGLE_PRESS + DRIVEN, "count") == [
        "3·5 − 2·7 = 1, mobility by the count",
        "pin B of links 2, 3 and 4 counts as two pairs",
    ]


def test_wheels_are_told_with_what_keeps_them():
    assert part(train() + DRIVEN, "pairs")[-2:] == [
        "wheel P of link 2 on wheel O of the frame, at a distance that link 1 keeps",
        "wheel P of link 2 on wheel O of link sun, at a distance that link 1 keeps",
    ]
    assert part(train() + DRIVEN, "count") == [
        "3·3 − 2·3 − 1·2 = 1, mobility by the count",
        "pin O of the frame, link 1 and link sun counts as two pairs",
        "each wheel whose distance is kept takes one freedom, every other pair two",
    ]
    assert part(ALONE + DRIVEN, "pairs") == ["1:", "wheel C of link 1 on a track of the frame"]


def test_open_chains_have_no_loops():
    text = "[frame]\nO = [0, 0]\n[links.1]\nO-A = 2\n[links.2]\nA-B = 1\n"
    assert part(text + DRIVEN, "loops") == ["none: an open chain"]


@pytest.mark.parametrize(
    ("lengths", "driver", "words", "verdict"),
    [
        ((4, 1, 4, 3), 1, "1 + 4 < 3 + 4 m, link 1 turns fully against the others", True),
        ((4, 3, 4, 1), 1, "1 + 4 < 3 + 4 m, link 3 turns fully against the others", False),
        ((1, 4, 4, 3), 1, "1 + 4 < 3 + 4 m, every link turns fully against the frame", True),
        ((4, 3, 1, 4), 3, "1 + 4 < 3 + 4 m, link 2 turns fully against the others", False),
        ((4, 2, 2, 2.5), 1, "2 + 4 > 2 + 2.5 m, no link turns fully", False),
    ],
    ids=["crank", "rocker", "double crank", "double rocker", "triple rocker"],
)
def test_grashof_is_told_with_its_numbers_and_what_it_means_to_the_driver(
    lengths, driver, words, verdict
):
    base, crank, coupler, rocker = lengths
    text = f"""[frame]
O = [0, 0]
Q = [{base}, 0]
[links.1]
O-A = {crank}
[links.2]
A-B = {coupler}
[links.3]
Q-B = {rocker}
"""
    _, rule, driven = part(text + DRIVEN.replace("turn = 1", f"turn = {driver}"), "loops")
    assert rule.startswith(f"four-bar 0–1–2–3: {words}")
    turns = "turns fully" if verdict else "cannot turn fully: dead points end its range"
    assert driven == f"  in this loop the driver of link {driver} {turns}"


def test_a_parallelogram_is_told_to_change_its_closure():
    text = FOUR_BAR + "[links.3]\nQ-B = 1\n"
    assert part(text + DRIVEN, "loops")[1:] == [
        "four-bar 0–1–2–3: 1 + 4 = 1 + 4 m, links 1 and 3 turn fully, but with the bars in line "
        "both closures meet (change point)",
        "  in this loop the driver of link 1 turns fully",
    ]


def test_the_rule_of_the_slider_crank_and_of_its_inversion():
    assert part(SLIDER_CRANK + DRIVEN, "loops")[1:] == [
        "slider-crank 0–1–2–3: 1 + 0 < 3 m, link 1 turns fully against the others",
        "  in this loop the driver of link 1 turns fully",
    ]
    assert part(SLOTTED_LEVER + DRIVEN, "loops")[1].startswith(
        "inverted slider-crank 3–0–1–2: 1 + 0 < 3 m, link 1 turns fully"
    )


def test_a_sliding_driver_is_told_in_units_of_the_scene():
    text = RAPID_RETURN + "[[drivers]]\nslide = 4\nposition = -1\nspeed = 2\nacceleration = 3\n"
    assert part(text, "drivers") == [
        "link 4 slides against the frame: at -1 m, speed 2 m/s, acceleration 3 m/s²"
    ]
    assert groups(text)[0] == "1. link 4 driven (class I): slide of block 4 on the frame"


def test_groups_are_told_with_class_and_order():
    assert groups(SLIDER_CRANK + DRIVEN) == [
        "1. crank 1 about O (class I)",
        "2. dyad RRP (class II, order 2) of links 2 and 3, inner pin B, "
        "outer pin A and slide of block 3 on the frame",
    ]
    fifth = DRIVEN.replace("turn = 1", "turn = 5")
    assert groups(STEPHENSON + fifth)[1].startswith(
        "2. group of class IV, order 2 (links 1, 2, 3 and 4): tried at link "
    )
    assert groups(RAPID_RETURN + DRIVEN)[1].startswith("2. group of class III, order 3 (links 2,")


def test_wheels_are_told_by_what_moves_them():
    assert groups(rack() + DRIVEN)[1] == (
        "2. link 2 on slide of block 2 on the frame, moved by its contact with link 1"
    )
    slides = "".join(f"[[drivers]]\nslide = {link}\nposition = 0\nspeed = 1\n" for link in (1, 2))
    assert groups(plates() + slides)[2] == (
        "3. link w on contact of links w and 1, moved by its contact with link 2"
    )


def test_an_arm_that_its_planet_moves_is_told():
    sun = DRIVEN.replace("turn = 1", 'turn = "sun"')
    assert groups(train() + sun) == [
        "1. crank sun about O (class I)",
        "2. arm 1 on pin O with wheel 2, which rolls on the frame and link sun",
    ]


def test_a_driver_against_a_moving_link_is_told():
    text = "[frame]\nO = [0, 0]\n[links.1]\nO-A = 2\n[links.2]\nA-B = 1\n"
    second = "[[drivers]]\nturn = 2\nagainst = 1\nangle = 10\nspeed = 1\n"
    assert groups(text + DRIVEN + second) == [
        "1. crank 1 about O (class I)",
        "2. crank 2 about A against link 1 (class I)",
    ]
