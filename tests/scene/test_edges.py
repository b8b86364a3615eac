"""Profiles that are drawn: how they are read, and what is said where they are wrong."""

from __future__ import annotations

import pytest

from graphkin.scene.model import Profile, Scene
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import SceneError
from tests.mechanisms import HEAD

TOUCHING = """
[frame]
O1 = [0, 0]
O2 = [1.6, 0]
P = [0, 0]
{frame}
[links.1]
O1-K1 = 0.55
touches = {{ on = 2, centres = "K1-K2", radii = [0.44, 0.16], contact = "M" }}
{first}
[links.2]
O2-K2 = 0.95
{second}
[[drivers]]
turn = 1
angle = 25
speed = 10
[branches]
K2 = "right of K1-O2"
[ask]
omega = [2]
"""
ONE, TWO = '{ about = "K1", through = "M" }', '{ about = "K2", through = "M" }'


def scene_with(frame: str = "", first: str = "", second: str = "") -> Scene:
    """Two links whose profiles touch, with more keys of theirs and of the frame."""
    return read_text(HEAD + TOUCHING.format(frame=frame, first=first, second=second), "made")


def test_a_link_has_one_profile_or_several_through_points_of_any_link():
    scene = scene_with(
        'profiles = { about = "O1", through = "M" }',
        f"profiles = {ONE}",
        f'profiles = [{TWO}, {{ about = "O2", through = "K2" }}]',
    )
    assert scene.frame.profiles == (Profile("O1", "M"),)
    assert scene.links["1"].profiles == (Profile("K1", "M"),)
    assert scene.links["2"].profiles == (Profile("K2", "M"), Profile("O2", "K2"))
    assert scene.links["n1_2"].profiles == ()


def test_an_arc_has_an_angle_and_a_hollow_is_said_so():
    told = ONE.replace(" }", ", arc = 80, hollow = true }")
    (found,) = scene_with(first=f"profiles = {told}").links["1"].profiles
    assert found.hollow
    assert found.arc.number({}) == 80
    with pytest.raises(SceneError, match=r"links\.1\.profiles\.arc: a list of 0"):
        scene_with(first="profiles = " + ONE.replace(" }", ", arc = [] }"))


CASES = [
    ('{ about = "K2", through = "M" }', "links.1.profiles.about", "K2 is no point of link 1", "K1"),
    ('{ about = "K1", through = "N" }', "links.1.profiles.through", "N is no point of", "K2"),
    ('{ about = "K1", through = "K1" }', "links.1.profiles.through", "about K1 and through it", ""),
    ('{ about = "K1" }', "links.1.profiles.through", "is missing", "the name of a point"),
    ('{ through = "M" }', "links.1.profiles.about", "is missing", "the name of a point"),
    ('{ about = 3, through = "M" }', "links.1.profiles.about", "3 is no name of a point", "letter"),
    ('{ about = "K1", thru = "M" }', "links.1.profiles.thru", "unknown key", "through"),
    ('"K1"', "links.1.profiles", '"K1"', "a table { … }, or a list of them"),
    (f"[{ONE}, 4]", "links.1.profiles[1]", "4", "a table"),
]


@pytest.mark.parametrize(("written", "place", "found", "expected"), CASES)
def test_what_is_wrong_with_a_profile_is_said(written, place, found, expected):
    with pytest.raises(SceneError) as told:
        scene_with(first=f"profiles = {written}")
    problem = next(each for each in told.value.problems if each.place == place)
    assert found in problem.found
    assert expected in problem.expected


def test_a_profile_has_a_radius():
    """O1 and P are both at (0, 0) of the frame; A is beside them."""
    assert scene_with('A = [0, 0.1]\nprofiles = { about = "O1", through = "A" }').frame.profiles
    with pytest.raises(SceneError, match=r"^frame.profiles: O1 and P are written at one spot; "):
        scene_with('profiles = { about = "O1", through = "P" }')


def test_all_mistakes_are_told_at_once():
    with pytest.raises(SceneError) as told:
        scene_with(
            'profiles = { about = "K1", through = "M" }',
            'profiles = { about = "K1", through = "K1" }',
            'profiles = [{ about = "K2" }, { about = "O1", through = "X" }]',
        )
    assert [problem.place for problem in told.value.problems] == [
        "links.2.profiles[0].through",
        "frame.profiles.about",
        "links.1.profiles.through",
        "links.2.profiles[1].about",
        "links.2.profiles[1].through",
    ]
