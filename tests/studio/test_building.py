"""Each act of the hand is one edit of the text, and what is impossible changes nothing."""

from __future__ import annotations

import re
from cmath import rect
from math import radians
from pathlib import Path
from tomllib import loads

import pytest

from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.studio.building import KINDS, Act, built, says
from graphkin.studio.sketch import sketch
from graphkin.text.errors import SceneError
from tests.studio.pump import PUMP

SCENES = Path(__file__).resolve().parents[2] / "examples" / "scenes"


def places_of(text: str) -> dict[str, complex]:
    """Where the points of a text stand."""
    return {name: complex(*at) for name, at in sketch(text, "own", {}).points.items()}


def done(text: str, kind: str, *of: str, at: complex = 0j, **more) -> str:
    """The text after an act."""
    return built(text, Act(kind, of, at, places_of(text), **more)).text


def changed(before: str, after: str) -> list[str]:
    """The new lines of a text."""
    old = before.split("\n")
    return [line for line in after.split("\n") if line not in old]


def test_a_dragged_pin_changes_its_lengths_alone():
    at = places_of(PUMP)["B"] + 2
    assert [line.split(" = ")[0] for line in changed(PUMP, done(PUMP, "move", "B", at=at))] == [
        "O2-B", "A-B", "B-C",
    ]  # fmt: skip


def test_a_dragged_pin_turns_no_driver_but_that_of_its_own_link():
    text = PUMP.replace('angle = "30 + 2*n"', "angle = 44")
    at = places_of(text)
    assert "angle = 44\n" in done(text, "move", "B", at=at["B"] + 2)
    turned = done(text, "move", "A", at=at["O1"] + (at["A"] - at["O1"]) * rect(1, radians(10)))
    (angle,) = read_text(turned, "own", None, {}).drivers
    assert float(angle.position.number({})) == pytest.approx(54, abs=0.1)


def test_a_mechanism_stays_in_the_field_where_a_value_of_a_parameter_is_refused():
    """A value out of range is told as a mistake; the field shows those of the text."""
    seen = sketch(PUMP, "own", {}, {"n": "-3"})
    assert seen == sketch(PUMP, "own", {}) != sketch(PUMP, "own", {}, {"n": "8"})
    assert "D" in seen.points


def test_the_other_closure_has_all_bars_as_long_as_the_one_that_is_drawn():
    """Also to a coupler point, which lies elsewhere with its coupler."""
    seen = sketch(PUMP, "own", {})
    (ghost,) = [each for each in seen.ghosts if each.point == "B"]
    held = [seen.links[name] for name in ("2", "3")]
    assert sorted(map(len, ghost.bars)) == sorted(map(len, held)) == [2, 3]

    def lengths(places):
        places = [complex(*at) for at in places]
        return sorted(abs(p - q) for p in places for q in places)

    for bar in ghost.bars:
        drawn = [[seen.points[point] for point in points] for points in held]
        assert any(
            lengths(bar) == pytest.approx(lengths(own)) for own in drawn if len(own) == len(bar)
        )
        assert not any(set(bar) == set(own) for own in drawn)


def test_a_driver_that_is_chosen_again_has_the_other_speed():
    text = done(GEARS, "wheel", "O1", at=50 + 0j)
    text = done(text, "driver", "1", at=50j, speed=60)
    assert changed(text, done(text, "driver", "1", at=50j, speed=90)) == ["speed = 90"]
    with pytest.raises(SceneError, match="is driven already"):
        done(text, "driver", "1", at=50j, speed=60)


def test_an_angle_that_is_an_expression_stays():
    at = places_of(PUMP)["A"] * 1.2
    after = done(PUMP, "move", "A", at=at)
    assert 'angle = "30 + 2*n"' in after
    assert "O1-A = 36\n" in after


def test_comments_stay_through_every_act():
    places = places_of(PUMP)
    acts = [
        ("pivot", (), 50 + 50j, {}),
        ("bar", ("C",), 40 + 30j, {}),
        ("plate", ("2",), -20 - 20j, {}),
        ("move", ("O2",), -32j, {}),
        ("close", ("5",), 0j, {"words": "backward"}),
    ]
    for kind, of, at, more in acts:
        after = built(PUMP, Act(kind, of, at, places, **more)).text
        assert [line for line in PUMP.split("\n") if "#" in line] == [
            line for line in after.split("\n") if "#" in line
        ], kind


def test_what_is_deleted_is_nowhere_named_and_the_rest_stands():
    after = done(PUMP, "delete", "D", words="point")
    scene = read_text(after, "own", None, {})
    assert set(scene.links) == {"1", "2", "3"}
    assert set(scene.branches) == {"B"}
    assert "D" not in (*scene.ask.velocity, *scene.ask.acceleration)


@pytest.mark.parametrize("point", ["A", "B", "C", "D"])
def test_no_branch_names_a_point_that_is_deleted(point):
    after = loads(done(PUMP, "delete", point, words="point"))
    for told in after.get("branches", {}).items():
        assert point not in re.findall(r"\w+", " ".join(told))
    assert ("B" in after.get("branches", {})) is (point in "CD")


@pytest.mark.parametrize(("scene", "link"), [("watt-2", "2"), ("toggle-press", "3")])
def test_no_heading_of_branches_is_left_where_a_deletion_leaves_none(scene, link):
    text = (SCENES / f"{scene}.toml").read_text(encoding="utf-8")
    assert loads(text)["branches"]
    assert "[branches]" not in done(text, "delete", link, words="link")


def test_a_pin_on_the_line_of_a_bar_is_written_so():
    places = places_of(PUMP)
    at = (places["O2"] + places["B"]) / 2
    after = done(PUMP, "plate", "2", at=at)
    assert 'E = "on O2-B"' in after
    assert "O2-E = 15" in after
    assert abs(places_of(after)["E"] - at) < 1e-9


def test_the_slot_of_a_link_lies_along_two_of_its_pins():
    """Of link 3 with A, B and C along A-B."""
    assert 'slides = {on = 3, along = "A-B"}' in done(PUMP, "block", "O2", "3")


LOOSE = """graphkin = 1
title = "Loose"
units = { length = "mm", angle = "deg", speed = "rev/min" }

[frame]
O1 = [0, 0] # left
O2 = [220, 0]

[links.1]
O1-A = 80 # crank

[links.2]
A-B = 220

[links.3] # rocker, not joined yet
O2-C = 150
C-D = 40
O2-D = 160
D = "left of O2-C"

[[drivers]]
turn = 1
angle = 60
speed = 57

[ask]
velocity = ["B", "C", "D"]
"""
"""A four-bar whose coupler B ends beside the rocker's pin C."""
PUT = {"A": 40 + 69.3j, "B": 255 + 120j, "C": 250 + 147j, "D": 215 + 160j}


def test_pins_that_are_joined_are_one_and_the_mechanism_closes():
    places = {**PUT, "O1": 0j, "O2": 220 + 0j}
    for one, other in (("B", "C"), ("C", "B")):
        after = built(LOOSE, Act("join", (one, other), 0j, places)).text
        scene = read_text(after, "own", None, {})
        assert set(scene.links["2"].points) == {"A", other}
        assert set(scene.links["3"].points) == {"O2", other, "D"}
        assert scene.ask.velocity == (other, "D") or set(scene.ask.velocity) == {other, "D"}
        assert other in scene.branches
        assert "# rocker, not joined yet" in after
        assert places_of(after)[other]


def test_a_pin_laid_on_a_fixed_one_or_a_fixed_one_on_it_is_fixed():
    text = PUMP.replace("[links.1]", "O3 = [20, -25]\n\n[links.1]", 1)
    for of in (("D", "O3"), ("O3", "D")):
        free = text.split("[links.5]")[0] + "[[drivers]]" + text.split("[[drivers]]")[1]
        places = {**places_of(PUMP), "O3": 20 - 25j}
        after = built(free, Act("join", of, 0j, places)).text
        assert "C-O3 = " in after
        assert "O3 = [" in after
        assert "C-D" not in after


@pytest.mark.parametrize(
    ("of", "words"),
    [
        (("O1", "O2"), "belong both to the frame"),
        (("A", "C"), "belong both to link 3"),
        (("A", "O2"), "would share two pins"),
        (("B", "A"), "belong both to link 3"),
        (("D", "O1"), "pinned to its own guide"),
        (("A", "A"), "is one pin already"),
        (("A", "Q"), "is at no known place"),
    ],
)
def test_pins_that_cannot_be_one_are_told(of, words):
    with pytest.raises(SceneError, match=words):
        done(PUMP, "join", *of)


@pytest.mark.parametrize(
    ("kind", "of", "words"),
    [
        ("bar", ("O1", "O2"), "both pins belong to the frame"),
        ("bar", ("A", "C"), "both pins belong to link 3"),
        ("bar", ("A", "A"), "begins and ends at one pin"),
        ("bar", ("Q",), "is at no known place"),
        ("plate", ("9",), "is not there"),
        ("block", ("O1",), "O1 is fixed"),
        ("block", ("A", "3"), "a pin of link 3 itself"),
        ("block", ("D",), "has a block already"),
        ("driver", ("1",), "is driven already"),
        ("driver", ("4",), "is at no fixed pin"),
    ],
)
def test_what_is_impossible_is_said(kind, of, words):
    with pytest.raises(SceneError, match=words):
        done(PUMP, kind, *of, at=3 + 4j)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", ["", "links", "slides", "A-B", "O1", "A", "5", "999"])
def test_no_act_ends_in_a_fault(kind, name):
    for text in (PUMP, "", "graphkin = 1", "links = 5\nframe = 3", "drivers = 1\nbranches = 2"):
        try:
            built(text, Act(kind, (name,), 1 + 1j, {"A": 0j, "O1": 1j}))
        except SceneError as error:
            assert error.problems


GEARS = """graphkin = 1
title = "Gears"
units = { length = "mm", angle = "deg", speed = "rev/min" }

[frame]
O1 = [0, 0]
O2 = [150, 0]
"""


def test_two_wheels_about_fixed_pins_drive_one_another():
    text = done(GEARS, "wheel", "O1", at=50 + 0j)
    assert "rolls" not in text
    text = done(text, "wheel", "O2", "1", at=50 + 0j)
    text = done(text, "driver", "1", at=50j, speed=60)
    solved = Mechanism(read_text(text, "own", None, {})).solve()
    assert solved.links["2"].omega == pytest.approx(-solved.links["1"].omega / 2)
    assert [wheel.radius for wheel in sketch(text, "own", {}).wheels] == [50, 100]


def test_a_wheel_on_an_arm_rolls_on_the_sun():
    text = done(GEARS, "wheel", "O1", at=60 + 0j)
    text = done(text, "bar", "O1", at=90j)
    text = built(text, Act("wheel", ("A", "1"), 60j, {"O1": 0j, "A": 90j})).text
    text = built(text, Act("driver", ("2",), 45j, {"O1": 0j, "A": 90j}, speed=100)).text
    text = built(text, Act("driver", ("1",), 60j, {"O1": 0j, "A": 90j}, speed=0)).text
    solved = Mechanism(read_text(text, "own", None, {})).solve()
    assert solved.links["3"].omega == pytest.approx(3 * solved.links["2"].omega)
    after = built(text, Act("plate", ("3",), 110j, {"O1": 0j, "A": 90j})).text
    assert "A-B = 20" in after
    assert "B" in Mechanism(read_text(after, "own", None, {})).solve().points


def test_a_wheel_on_a_moving_pin_rolls_on_the_line_that_it_touches():
    text = done(GEARS, "bar", "O1", at=30 + 40j)
    places = {"O1": 0j, "O2": 150 + 0j, "A": 30 + 40j}
    text = built(text, Act("bar", ("A",), 230 + 5j, places)).text
    places["B"] = 230 + 5j
    text = built(text, Act("wheel", ("B",), 230 - 25j, places)).text
    text = built(text, Act("driver", ("1",), 15 + 20j, places, speed=60)).text
    solved = Mechanism(read_text(text, "own", None, {})).solve()
    speed = solved.points["B"].velocity
    assert abs(speed.imag) < 1e-9
    assert abs(solved.links["3"].omega) == pytest.approx(abs(speed) / 0.03)
    assert places_of(text)["B"].real > 150
    gone = done(text, "delete", "3", words="link")
    assert "wheel" not in gone


@pytest.mark.parametrize(
    ("of", "at", "words"),
    [
        (("O1", "9"), 0j, "cannot roll on link 9"),
        (("O1", "1"), 0j, "a wheel about another centre"),
        (("O3", "1"), 0j, "lies inside the wheel"),
    ],
)
def test_wheels_that_cannot_meet_are_told(of, at, words):
    text = done(GEARS + "O3 = [20, 0]\n", "wheel", "O1", at=50 + 0j)
    with pytest.raises(SceneError, match=words):
        done(text, "wheel", *of, at=at)


@pytest.mark.parametrize(
    ("key", "value", "named"),
    [
        ("C", "left of A-B", "ABC"),
        ("C", "beyond B on A-P", "ABCP"),
        ("O-B", 30, "OB"),
        ("C", [0, 0], "C"),
        ("wheel", {"centre": "O", "radius": 30}, "O"),
        ("rolls", {"on": 0, "through": "P", "angle": 0}, "P"),
        ("slides", {"on": 3, "along": "O-B"}, "OB"),
        ("slides", {"on": 0, "through": "P", "angle": 0}, "P"),
    ],
)
def test_a_key_and_its_words_name_the_points_that_go_with_them(key, value, named):
    """What a deleted point takes along."""
    assert "".join(point for point in "ABCOPl" if says(point, key, value)) == "".join(sorted(named))
