"""A task says what the links are and how large its plans, so that it can be drawn as meant."""

from __future__ import annotations

import pytest

from graphkin.documents.sheet_documents import hand_out
from graphkin.drawing.richtext import plain
from tests.documents.centre_scenes import four_bar
from tests.documents.sheet_tools import texts
from tests.mechanisms import mechanism_of


def test_a_task_without_a_velocity_of_the_crank_tells_the_scale_alone():
    """No segment of such a plan is as long as the crank."""
    (velocity, *_) = hand_out(mechanism_of(four_bar('velocity = ["O1"]')), "task", "en")
    (said,) = (t.markup for t in texts(velocity.pages) if t.markup.startswith("The plan"))
    assert plain(said).startswith("The plan is drawn at kv = ω1·kL. Lengths")


@pytest.mark.parametrize("ask", ['curves = ["B"]', 'centres = ["1-2"]'])
def test_a_task_without_a_plan_tells_no_scale_of_one(ask):
    (sheet, *_) = hand_out(mechanism_of(four_bar(ask)), "task", "en")
    assert not [t for t in texts(sheet.pages) if t.markup.startswith("The plan")]
