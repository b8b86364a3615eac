"""The reading bench: its classes, and how its pictures pair labs with mistakes."""

from __future__ import annotations

from itertools import product
from pathlib import Path

from tests.bench.reading import folder_of, turn_of

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


def test_a_seed_gives_the_same_class_and_codes(tmp_path: Path) -> None:
    drawn = []
    for name in ("one", "other"):
        (tmp_path / name).mkdir()
        drawn.append((folder_of("pump", tmp_path / name, 1) / "variants.csv").read_bytes())
    assert drawn[0] == drawn[1]
