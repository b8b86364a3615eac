"""Profiles that touch, by their centres of curvature: how they slide, and what link they are."""

from __future__ import annotations

import pytest

from graphkin.documents.centre_tables import place_of
from graphkin.numbers.plane import cross, dot
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import SceneError
from tests.mechanisms import HEAD, mechanism_of

PAIR = """
[frame]
O1 = [0, 0]
O2 = [1.6, 0]
[links.1]
O1-K1 = 0.55
{touches}
[links.2]
O2-K2 = 0.95
{third}
[[drivers]]
turn = 1
angle = 25
speed = 10
acceleration = 30
[branches]
K2 = "right of K1-O2"
[ask]
velocity = ["M@1", "M@2"]
omega = [1, 2]
epsilon = [2]
centres = ["1-2"]
"""
OUTSIDE = 'touches = { on = 2, centres = "K1-K2", radii = [0.44, 0.16], contact = "M" }'
INSIDE = 'touches = { on = 2, centres = "K1-K2", radii = [0.2, 0.8], contact = "M", inside = true }'
BY_HAND = """
[links.3]
K1-K2 = 0.6
K1-M = 0.44
M = "on K1-K2"
"""


def pair(touches: str, third: str = ""):
    """Two wheels whose profiles touch."""
    return mechanism_of(PAIR.format(touches=touches, third=third))


@pytest.mark.parametrize("touches", [OUTSIDE, INSIDE])
def test_the_sliding_speed_is_the_relative_omega_times_the_way_to_the_centre(touches):
    solution = pair(touches).solve()
    contact = solution.points["M"].position
    pitch = place_of(solution.centres["1-2"], 1.0)
    slip = solution.points["M@1"].velocity - solution.points["M@2"].velocity
    relative = solution.links["1"].omega - solution.links["2"].omega
    assert abs(slip) == pytest.approx(abs(relative) * abs(contact - pitch), rel=1e-12)


@pytest.mark.parametrize("touches", [OUTSIDE, INSIDE])
def test_profiles_neither_part_nor_run_into_one_another(touches):
    solution = pair(touches).solve()
    places = [solution.points[name].position for name in ("K1", "K2")]
    slip = solution.points["M@1"].velocity - solution.points["M@2"].velocity
    normal = (places[1] - places[0]) / abs(places[1] - places[0])
    assert abs(dot(slip, normal)) <= 1e-12 * abs(slip)


@pytest.mark.parametrize("touches", [OUTSIDE, INSIDE])
def test_the_common_normal_meets_the_line_of_centres_in_the_pitch_point(touches):
    solution = pair(touches).solve()
    pitch = place_of(solution.centres["1-2"], 1.0)
    first, second = (solution.points[name].position for name in ("K1", "K2"))
    assert abs(pitch.imag) < 1e-12
    assert abs(cross(second - first, pitch - first)) < 1e-12
    ratio = solution.links["2"].omega / solution.links["1"].omega
    assert ratio == pytest.approx(pitch.real / (pitch.real - 1.6), rel=1e-12)


@pytest.mark.parametrize(("touches", "radii"), [(OUTSIDE, (0.44, 0.16)), (INSIDE, (0.2, 0.8))])
def test_the_contact_lies_on_both_profiles(touches, radii):
    points = pair(touches).solve().points
    for centre, radius in zip(("K1", "K2"), radii, strict=True):
        away = abs(points["M"].position - points[centre].position)
        assert away == pytest.approx(radius, rel=1e-12)


def test_touching_profiles_are_the_link_between_their_centres():
    short, long = pair(OUTSIDE).solve(), pair("", BY_HAND).solve()
    for name, motion in long.points.items():
        assert short.points[name] == motion
    assert short.links["n1_2"] == long.links["3"]


def test_the_witness_agrees():
    mechanism = pair(OUTSIDE)
    assert mechanism.witness(mechanism.solve()).largest_difference < 1e-10


@pytest.mark.parametrize(
    ("touches", "words"),
    [
        ('touches = { on = 2, centres = "K1-K2" }', "two radii of curvature"),
        ('touches = { on = 2, centres = "K1-K2", radii = [1, -1] }', "radii[1]"),
        ('touches = { on = 2, centres = "K1-X", radii = [1, 1] }', "X is no point of link 2"),
        ('touches = { on = 2, centres = "K2-K1", radii = [1, 1] }', "K2 is no point of link 1"),
        ('touches = { on = 7, centres = "K1-K2", radii = [1, 1] }', "K2 is no point of link 7"),
        ('touches = { on = 2, centres = "K1-K2", radii = [1, 1], link = 2 }', "is there already"),
        ('touches = { on = 2, centres = "K1-K2", radii = [1, 1], far = 2 }', "far"),
        (
            'touches = { on = 2, centres = "K1-K2", radii = [2, 1], inside = true }',
            "the hollow's 1 is no more than this profile's 2",
        ),
        (
            'touches = { on = 2, centres = "K1-K2", radii = [2, 2], inside = true }',
            "one centre: write a pin, and both arcs",
        ),
    ],
)
def test_what_is_wrong_with_a_contact_is_said(touches, words):
    with pytest.raises(SceneError) as caught:
        read_text(HEAD + PAIR.format(touches=touches, third=""), "made", None, {})
    assert words in str(caught.value)
