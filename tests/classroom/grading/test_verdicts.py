"""Marks are those that the published rules give, worked out by hand for sets of thirty kinds."""

from __future__ import annotations

import pytest

from tests.classroom.grading.hand import DRAW
from tests.classroom.grading.independent import KINDS
from tests.classroom.grading.verdicts import Verdict, verdicts


@pytest.fixture(scope="module")
def every() -> list[Verdict]:
    """The verdicts on one student of each lab, one of them with points for half the fields."""
    labs = zip(DRAW, (12, 11, 12), (False, False, True), strict=True)
    return [each for lab, n, half in labs for each in verdicts(lab, n, 1, half)]


def test_ninety_nine_of_a_hundred_verdicts_are_right(every):
    wrong = [each for each in every if not each.is_right]
    assert len(every) > 1500
    assert len(wrong) <= 0.01 * len(every), wrong


@pytest.mark.parametrize("kind", KINDS)
def test_of_each_kind_nearly_all_are(every, kind):
    found = [each for each in every if each.kind == kind]
    assert len(found) > 5
    assert sum(not each.is_right for each in found) <= 0.05 * len(found), found
