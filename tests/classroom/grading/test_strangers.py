"""Students of another model: other noise, other units, blank cells and blunders of their own.

``python -m tests.bench.strangers`` measures every mistake on every lab.
"""

from __future__ import annotations

from dataclasses import replace

import pytest

from graphkin.classroom.grading.graded import Status
from tests.bench.strangers import a_class
from tests.classroom.grading.strangers import CAUSES, KINDS, USUAL

FEW = 8
SLICE = (
    ("offset-slider-crank", "rows exchanged"),
    ("slotted-lever", "scales exchanged"),
    ("pump", "reversed"),
)


@pytest.mark.parametrize(("lab", "made"), SLICE)
def test_the_mistake_of_a_stranger_is_named(lab, made):
    found = a_class(lab, made, 1, FEW)
    named = [{c.name for c in g.causes}.issubset(CAUSES[made]) and bool(g.causes) for g in found]
    assert sum(named) >= FEW - 1


def test_two_who_draw_a_third_students_data_copied_from_nobody():
    """Two of this class have the data of one other student, and half of their digits in common."""
    found = a_class("pump", "another number", 11, habits=KINDS["whole degrees"])
    assert {c.name for g in found for c in g.causes} == {"data_of_another"}
    assert all(g.causes for g in found)


@pytest.mark.parametrize("lab", ["offset-slider-crank", "slotted-lever", "pump"])
def test_a_fine_stranger_is_right(lab):
    """Nearly without errors, nearly every answer is right: both models solve one mechanism."""
    found = a_class(lab, "", 3, FEW, habits=replace(USUAL, sigma=0.02))
    marks = [m for g in found for m in g.marks if m.answer.is_read]
    assert sum(m.status is Status.RIGHT for m in marks) > 0.9 * len(marks)
    assert not any(g.causes for g in found)
