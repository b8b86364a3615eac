"""Groups of higher class: the motion goes on though the number of its closure changes."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from msgspec.structs import replace

from graphkin.cli.report.piece_words import pieces_words
from graphkin.mechanism import load
from graphkin.motion.closures_followed import FollowedClosures
from graphkin.motion.cycle import cycle
from graphkin.motion.follower_limits import followers
from graphkin.scene.model import Closure


@pytest.fixture(scope="module")
def swept():
    """A Stephenson III driven at the crank of its two-link path, across two new numbers."""
    mechanism = load("examples/scenes/stephenson-3-crank.toml")
    return cycle(mechanism, low=95, high=125, steps=10)


def test_the_closure_is_followed_under_its_changing_number(swept):
    assert len(swept.pieces) > 1
    numbers = [piece.branches["1"] for piece in swept.pieces]
    assert all(isinstance(each, Closure) for each in numbers)
    assert all(a != b for a, b in pairwise(numbers))
    for name, motion in swept.solution.points.items():
        if np.ptp(np.abs(motion.position - motion.position[0])) == 0:
            continue
        # positions and velocities fit together: no leap to another closure anywhere
        seconds = np.radians(np.diff(swept.at)) / swept.solution.links["5"].omega[0]
        mean = (motion.velocity[1:] + motion.velocity[:-1]) / 2
        step = np.diff(motion.position)
        assert np.abs(step - mean * seconds).max() < 0.02 * np.abs(step).max(), name


def test_every_row_agrees_with_the_witness(swept):
    assert swept.witnessed.agrees.all()


def test_a_link_turns_round_where_the_other_driver_has_its_dead_point():
    # driven at link 1 the same linkage has dead points; seen from link 5, link 1 turns round there
    other = load("examples/scenes/stephenson-3.toml")
    dead = cycle(other).ranges[0][1]
    here = cycle(load("examples/scenes/stephenson-3-crank.toml"), low=145, high=160, steps=15)
    crank = next(each for each in followers(here) if each.name == "1")
    assert crank.high.value == pytest.approx(dead, abs=1e-6)


def told(found) -> list[str]:
    """The lines about the closures."""
    label, lines = pieces_words(found)
    assert label == "closures"
    assert lines[0] == "one motion through the whole range; to stand in it, write in [branches]"
    return lines[1:]


def test_each_number_is_told_as_a_scene_writes_it(swept):
    first, *_, last = lines = told(swept)
    assert first == 'φ from 95.000° to 101.862°: 1 = "closure 3"'
    assert last == 'φ from 120.635° to 125.000°: 1 = "closure 1"'
    assert len(lines) == len(swept.pieces)


def test_pieces_of_one_number_are_told_as_one_and_what_lies_between_has_no_rows():
    """Where the crank of the rapid return stands on the guide, two of its closures meet."""
    found = cycle(load("examples/scenes/rapid-return.toml"), low=80, high=280, steps=20)
    assert len(found.pieces) > 1
    assert told(found) == [
        'φ from 80.000° to 280.000°: 2 = "closure 2"',
        "φ from 90.000° to 90.500°: no rows, two closures lie too close together",
        "φ from 270.000° to 270.500°: no rows, two closures lie too close together",
    ]
    assert {90.0, 270.0} == set(found.left_out)


def test_followed_closures_of_several_trials_are_those_that_a_search_finds():
    """Newton's method from the neighbours comes to the same places as the search all round."""
    mechanism = load("examples/scenes/plates-coupled.toml")
    (piece,) = cycle(mechanism, low=0, high=30, steps=3).pieces
    course, at = piece.course, np.array([1.7, 11.3, 28.9])
    assert course.closures is not None
    targets = [target for target in course.program.targets if target[0] == "velocity"]
    sought = replace(course, closures=None).columns(at, targets)
    for target, found in course.columns(at, targets).items():
        assert found == pytest.approx(sought[target], abs=1e-12), target


def test_between_closures_that_are_not_alike_all_are_sought():
    mechanism = load("examples/scenes/plates-coupled.toml")
    (piece,) = cycle(mechanism, low=0, high=9, steps=3).pieces
    course = piece.course
    ways, size = course.closures, len(course.closures.at)
    turned = FollowedClosures(ways.at, ways.rows * np.where(np.arange(size) % 2, 1, -1)[:, None])
    at, targets = np.array([4.5]), [("position", "P3")]
    wrong = replace(course, closures=turned).columns(at, targets)
    right = course.columns(at, targets)
    assert wrong[targets[0]] == pytest.approx(right[targets[0]], abs=1e-12)
