"""A task says what the links are and how large its plans, so that it can be drawn as meant."""

from __future__ import annotations

import pytest

from graphkin.documents.members import members
from graphkin.documents.scaling import shown
from graphkin.documents.sheet_documents import drawings_of, hand_out, language_of, proved
from graphkin.documents.task_scale import plan_at
from graphkin.drawing.richtext import plain
from tests.documents.centre_scenes import four_bar
from tests.documents.sheet_tools import mechanism_named, texts
from tests.mechanisms import mechanism_of

LABS = ("pump", "slotted-lever")


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("pump", "Links: 1 = O1A, 2 = O2B, 3 = ABC, 4 = CD, 5 = block D"),
        ("slotted-lever", "Links: 1 = O1A, 2 = block A, 3 = O2B, 4 = BC, 5 = block C"),
        ("gears-ring", "Links: 1 = OP, 2 = wheel PQ, 3 = wheel OS"),
    ],
)
def test_links_are_told_by_their_points(name, told):
    mechanism = mechanism_named(name, 7) if name in LABS else mechanism_named(name)
    verdict = proved(mechanism, shown(mechanism))
    drawing = drawings_of(mechanism, verdict, language_of(mechanism, "en"))[0]
    assert plain(members(drawing)) == told


@pytest.mark.parametrize(
    ("name", "rules"),
    [
        ("pump", ("kv = ω1·kL, oa = O1A/kL", "ka = ω12·kL")),
        ("slotted-lever", ("kv = 0.015 (m/s)/mm", "ka = kv2/kL")),
    ],
)
def test_a_task_tells_at_which_scales_its_plans_are_meant(name, rules):
    for handed, rule in zip(hand_out(mechanism_named(name, 7), "task", "en"), rules, strict=False):
        lines = [plain(text.markup) for text in texts(handed.pages)]
        (said,) = (line for line in lines if line.startswith("The plan is drawn at"))
        assert rule in said


def test_a_task_without_a_velocity_of_the_crank_tells_the_scale_alone():
    """No segment of such a plan is as long as the crank."""
    (velocity, *_) = hand_out(mechanism_of(four_bar('velocity = ["O1"]')), "task", "en")
    (said,) = (t.markup for t in texts(velocity.pages) if t.markup.startswith("The plan"))
    assert plain(said).startswith("The plan is drawn at kv = ω1·kL. Lengths")


@pytest.mark.parametrize("ask", ['curves = ["B"]', 'centres = ["1-2"]'])
def test_a_task_without_a_plan_tells_no_scale_of_one(ask):
    (sheet, *_) = hand_out(mechanism_of(four_bar(ask)), "task", "en")
    assert not [t for t in texts(sheet.pages) if t.markup.startswith("The plan")]


def test_a_plans_scale_is_told_in_every_language():
    for language, start in (("ro", "Planul"), ("it", "Il poligono"), ("en", "The plan")):
        mechanism = mechanism_named("pump", 7)
        drawn = drawings_of(
            mechanism, proved(mechanism, shown(mechanism)), language_of(mechanism, language)
        )
        assert all(plain(plan_at(drawing)).startswith(start) for drawing in drawn)


def test_a_task_tells_them_and_a_key_need_not():
    for view, times in (("task", 1), ("key", 0)):
        pages = hand_out(mechanism_named("pump", 7), view, "en")[0].pages
        assert sum("Links:" in text.markup for text in texts(pages)) == times
