"""One student's form: what is too short to be measured is not asked, its points are not lost."""

from __future__ import annotations

from fractions import Fraction

from graphkin.classroom.lab.asking import asked_of
from graphkin.classroom.lab.items import items
from graphkin.mechanism import load
from tests.classroom.grading.students import lab_of

POINTS = {"a_D_mm": Fraction(3), "a_D": Fraction(1), "epsilon_2": Fraction(3, 2)}


def fields(points: dict[str, Fraction], compute: tuple[str, ...]) -> dict[str, Fraction | None]:
    """The fields of the pump's form, and what they are worth."""
    form, worths = asked_of(items(load("pump"), lab_of("pump")), points, compute)
    return {item.field: worths.get(item.field) for item in form}


def test_the_points_of_a_short_segment_go_to_the_value_that_is_computed():
    found = fields(POINTS, ("a_D_mm", "a_D"))
    assert "a_D_mm" not in found
    assert found["a_D"] == 4


def test_a_short_segment_whose_value_earns_nothing_stays():
    """Else the student would be asked for nothing that earns its points."""
    points = {"a_D_mm": Fraction(3)}
    found = fields(points, ("a_D_mm", "a_D"))
    assert found["a_D_mm"] == 3
