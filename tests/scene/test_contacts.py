"""Letters of the points where wheels touch: short, their own, and no point's of the scene."""

from __future__ import annotations

import pytest

from graphkin.scene.read_scene import read_text
from graphkin.scene.wheels import contact_letters
from graphkin.structure.pairs import contacts
from tests.scene_files import scene_text

TRAIN = scene_text("scene/train")


def letters(*changes: tuple[str, str]) -> tuple[str, ...]:
    """The letters of the planet's contacts in the train with pieces of its text replaced."""
    text = TRAIN
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    return contact_letters(read_text(text, "train"))["planet"]


def test_several_contacts_are_numbered_in_the_order_written() -> None:
    assert letters() == ("T1", "T2")


def test_one_contact_has_no_number() -> None:
    assert letters((', { on = "sun" }', "")) == ("T",)


@pytest.mark.parametrize(
    ("point", "stem"), [("T", "K"), ("T7", "K"), ("t1", "K"), ("TU", "T"), ("K1", "T")]
)
def test_a_letter_of_the_scene_is_left_to_it(point: str, stem: str) -> None:
    assert letters(("O-S", f"O-{point}")) == (f"{stem}1", f"{stem}2")


def test_all_letters_taken() -> None:
    taken = "T = [1, 1]\nK3 = [2, 1]\nH = [3, 1]\nTT2 = [4, 1]\n[links.arm]"
    assert letters(("[links.arm]", taken)) == ("TTT1", "TTT2")


def test_the_pairs_carry_the_letters() -> None:
    found = contacts(read_text(TRAIN, "train"))
    assert [(each.links, each.letter) for each in found] == [
        (("planet", "0"), "T1"),
        (("planet", "sun"), "T2"),
    ]
