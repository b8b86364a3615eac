"""Pictures of the reading bench pair every lab with everything that may be wrong on a sheet."""

from __future__ import annotations

from itertools import product

from tests.bench.reading import turn_of

LABS, WRONG = ("pump", "lever", "crank", "class-three"), ("long", "short", "turned", "exchanged")


def test_each_round_of_pictures_has_each_mistake_in_each_lab() -> None:
    pairs = set(product(LABS, WRONG))
    for seed in (1, 2):
        assert {turn_of(i, LABS, WRONG, seed) for i in range(16)} == pairs
        assert {turn_of(i, LABS, WRONG, seed) for i in range(16, 32)} == pairs


def test_no_place_in_a_round_is_always_of_one_lab() -> None:
    """Every fourth picture is hard: it must not always be of the last of four labs."""
    hard = {turn_of(i, LABS, (), seed)[0] for i in range(3, 64, 4) for seed in (1, 2)}
    assert hard == set(LABS)
