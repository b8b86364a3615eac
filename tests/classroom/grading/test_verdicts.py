"""Marks are those that the published rules give, worked out by hand for sets of thirty kinds."""

from __future__ import annotations

import pytest

from tests.classroom.grading import hand
from tests.classroom.grading.independent import KINDS
from tests.classroom.grading.students import marker_of
from tests.classroom.grading.verdicts import Verdict, verdicts


@pytest.fixture(scope="module")
def every() -> list[Verdict]:
    """The verdicts on one student of each lab, one of them with points for half the fields."""
    labs = zip(hand.DRAW, (12, 11, 12), (False, False, True), strict=True)
    return [each for lab, n, half in labs for each in verdicts(lab, n, 1, half)]


@pytest.mark.parametrize("kind", KINDS)
def test_every_verdict_is_that_of_the_rules(every, kind):
    found = [each for each in every if each.kind == kind]
    assert len(found) > 5
    assert [each for each in found if not each.is_right] == []


@pytest.mark.parametrize("lab", hand.DRAW)
def test_a_hand_without_errors_draws_the_key(lab):
    """All fields of every other variant; what is nearly zero to a thousandth of a millimetre."""
    for n in range(1, 31, 2):
        standard = marker_of(lab, n).standard
        scales = standard.scales
        found = hand.key(lab, hand.data(lab, n), (scales.kL, scales.kv, scales.ka))
        assert set(found) == set(standard.key)
        for field, right in standard.key.items():
            tolerance = standard.tolerance.get(field)
            near = 1e-5 * tolerance.value if tolerance is not None else 0
            told = found[field]
            signed = standard.by_field[field].vector or told * right > 0 or abs(right) < near
            assert signed, (n, field)
            assert told == pytest.approx(right, rel=1e-9, abs=near), (n, field)
