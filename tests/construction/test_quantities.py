"""The one registry of quantities, against what can be asked and what a solution holds."""

from __future__ import annotations

from dataclasses import fields

import pytest

from graphkin.construction.core.quantities import QUANTITIES, Whose
from graphkin.construction.core.solution import LinkMotion, PointMotion, SlideMotion, Solution

MOTIONS = {Whose.POINT: PointMotion, Whose.LINK: LinkMotion, Whose.SLIDE: SlideMotion}


@pytest.mark.parametrize("whose", Whose)
def test_a_motion_holds_the_quantities_of_what_moves_and_no_others(whose):
    known = {each.attribute for each in QUANTITIES if each.whose is whose}
    assert known == {each.name for each in fields(MOTIONS[whose])}
    assert whose.value in {each.name for each in fields(Solution)}


def test_no_two_quantities_are_one_target():
    targets = [each.target for each in QUANTITIES]
    assert len(set(targets)) == len(targets)
