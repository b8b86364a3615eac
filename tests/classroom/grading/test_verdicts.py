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


@pytest.mark.parametrize("kind", KINDS)
def test_every_verdict_is_that_of_the_rules(every, kind):
    found = [each for each in every if each.kind == kind]
    assert len(found) > 5
    assert [each for each in found if not each.is_right] == []
