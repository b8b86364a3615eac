"""The one registry of quantities, against what can be asked and what a solution holds."""

from __future__ import annotations

from itertools import groupby

import pytest

from graphkin.construction.core.quantities import ASKED, KINDS, QUANTITIES, Sort, Whose
from graphkin.construction.core.solution import LinkMotion, PointMotion, SlideMotion, Solution
from graphkin.scene.model import Ask

MOTIONS = {Whose.POINT: PointMotion, Whose.LINK: LinkMotion, Whose.SLIDE: SlideMotion}


def test_every_key_of_ask_asks_for_some_quantity():
    assert set(ASKED) == set(Ask._fields)


@pytest.mark.parametrize("whose", Whose)
def test_a_motion_holds_the_quantities_of_what_moves_and_no_others(whose):
    known = {each.attribute for each in QUANTITIES if each.whose is whose}
    assert known == set(MOTIONS[whose].__struct_fields__)
    assert whose.value in Solution.__struct_fields__


def test_no_two_quantities_are_one_target():
    targets = [each.target for each in QUANTITIES]
    assert len(set(targets)) == len(targets)


def test_a_quantity_is_called_alike_wherever_it_is_held_in_one_place():
    held = sorted((each.whose.value, each.attribute) for each in QUANTITIES if each.words)
    assert all(len(list(alike)) == 1 for _, alike in groupby(held))


def test_the_unit_of_what_is_no_place_is_that_of_its_derivative():
    for each in QUANTITIES:
        seconds = 0 if each.sort is Sort.PLACE else KINDS.index(each.kind)
        assert each.unit.removeprefix("rad").removeprefix("m") == ("", "/s", "/s²")[seconds]
