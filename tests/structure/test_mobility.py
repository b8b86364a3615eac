"""How many freedoms: counts in the plane and in space, and the loops that close."""

from __future__ import annotations

import pytest

from graphkin.structure.driver_count import Count, count, gruebler
from tests.mechanisms import scene_of
from tests.structure.test_contacts import ALONE, plates, rack, train
from tests.structure.test_groups import (
    DRIVEN,
    FIVE_BAR,
    LIFTER,
    PARALLEL,
    SLIDER_CRANK,
    TOGGLE_PRESS,
    TRAMMEL_BAR,
    WATT,
)


@pytest.mark.parametrize(
    ("text", "words", "loops"),
    [
        (SLIDER_CRANK, "3·3 − 2·4 = 1", 1),
        (FIVE_BAR, "3·4 − 2·5 = 2", 1),
        (WATT, "3·5 − 2·7 = 1", 2),
        (TOGGLE_PRESS, "3·5 − 2·7 = 1", 2),
        (LIFTER, "3·5 − 2·7 = 1", 2),
        (PARALLEL, "3·4 − 2·6 = 0", 2),
        (TRAMMEL_BAR, "3·4 − 2·6 = 0", 2),
        (ALONE, "3·1 − 2·1 = 1", 0),
        (rack(), "3·2 − 2·2 − 1·1 = 1", 1),
        (train(), "3·3 − 2·3 − 1·2 = 1", 2),
        (plates(), "3·3 − 2·3 − 1·1 = 2", 1),
    ],
    ids=[
        "slider-crank",
        "five-bar",
        "Watt",
        "toggle press",
        "lifter",
        "parallel cranks",
        "trammel bar",
        "wheel on a rail",
        "rack and pinion",
        "planet between ring and sun",
        "roller between plates",
    ],
)
def test_the_count_and_the_loops_of_a_scene(text, words, loops):
    found = count(scene_of(text + DRIVEN))
    assert found.words == words
    assert found.mobility == int(words.rpartition(" ")[2].replace("−", "-"))
    assert found.loops == loops


def test_a_structure_that_cannot_move_counts_below_zero():
    assert Count(2, 4).words == "3·2 − 2·4 = −2"


@pytest.mark.parametrize(
    ("moving", "lower", "higher", "freedoms"),
    [(2, 2, 1, 1), (2, 2, 1, 1), (3, 4, 0, 1), (1, 1, 0, 1), (2, 2, 0, 2)],
    ids=[
        "cam and follower",
        "two pulleys and a belt",
        "the cam as a four-bar by centres of curvature",
        "a lever on a spring, which takes nothing",
        "two pulleys whose belt is off",
    ],
)
def test_higher_pairs_and_belts_take_one_and_springs_nothing(moving, lower, higher, freedoms):
    assert gruebler(moving, lower, higher) == freedoms


def test_the_double_hinge_counted_once_would_give_three():
    """The six-bar whose hinge joins three links: 7 pairs leave 1 freedom, 6 would leave 3."""
    assert (gruebler(5, 7), gruebler(5, 6)) == (1, 3)
    assert count(scene_of(TOGGLE_PRESS + DRIVEN)).pairs == 7
