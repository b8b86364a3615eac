"""The one registry of quantities, against what can be asked and what a solution holds."""

from __future__ import annotations

import pytest

from graphkin.construction.core.quantities import (
    QUANTITIES,
    LinkMotion,
    PointMotion,
    SlideMotion,
)
from graphkin.construction.core.solution import Solution

MOTIONS = {"points": PointMotion, "links": LinkMotion, "slides": SlideMotion}


@pytest.mark.parametrize("whose", MOTIONS)
def test_a_motion_holds_the_quantities_of_what_moves_and_no_others(whose):
    known = {each.attribute for each in QUANTITIES if each.whose == whose}
    assert known == set(MOTIONS[whose].__struct_fields__)
    assert whose in Solution.__struct_fields__


def test_no_two_quantities_are_one_target():
    targets = [each.target for each in QUANTITIES]
    assert len(set(targets)) == len(targets)
