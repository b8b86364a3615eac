"""What links are called on the sheets of a language."""

from __future__ import annotations

import pytest

from graphkin.documents.sheet_documents import hand_out
from graphkin.drawing.marks import Text
from graphkin.mechanism import Mechanism
from graphkin.scene.link_names import in_language
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import SceneError
from graphkin.web.step_page import step_page, task_page
from tests.scene_files import scene_text

SCENE = scene_text("scene/guide")
OWN = ("crank", "lever", "block")


def scene(text: str = SCENE):
    return read_text(text, "shaper")


def test_every_mention_of_a_link_is_by_its_name_in_the_language():
    said = repr(in_language(scene(), "it"))
    assert not [name for name in OWN if f"'{name}" in said or f"{name}'" in said]
    assert "'A@leva'" in said
    assert "'manovella-leva'" in said


def test_a_link_without_a_name_in_a_language_keeps_its_own():
    renamed = in_language(scene(), "ro")
    assert [*renamed.links] == ["crank", "block", "pârghie"]
    assert renamed.link("block").slides[0].on == "pârghie"


def test_a_language_without_names_changes_nothing():
    whole = scene()
    assert in_language(whole, "en") is whole


def test_another_name_changes_no_number():
    whole = Mechanism(scene())
    own, other = whole.solve(), whole.spoken("it").solve()
    assert other.links["leva"] == own.links["lever"]
    assert other.points == {
        name.replace("@lever", "@leva"): motion for name, motion in own.points.items()
    }


@pytest.mark.parametrize("view", ["key", "task"])
def test_sheets_in_a_language_say_its_names_alone(view):
    sheets = hand_out(Mechanism(scene()), view, "it")
    marks = [m for sheet in sheets for page in sheet.pages for m in page.marks]
    said = " | ".join(m.markup for m in marks if isinstance(m, Text))
    assert "leva" in said
    assert not [name for name in OWN if name in said]


@pytest.mark.parametrize("page", [step_page, task_page])
def test_pages_in_a_language_say_its_names(page):
    text = page(Mechanism(scene()), "it")
    assert "manovella" in text
    assert "crank" not in text


@pytest.mark.parametrize(
    ("names", "place", "found"),
    [
        ('it = { levr = "leva" }', "names.it.levr", "link levr is not in [links]"),
        ('it = { lever = "A" }', "names.it.lever", '"A" is another thing\'s name'),
        ('it = { lever = "crank" }', "names.it.lever", '"crank" is another thing\'s name'),
        ('it = { lever = "x", crank = "x" }', "names.it.crank", '"x" is another thing\'s name'),
        ('it = { lever = "due leve" }', "names.it.lever", '"due leve"'),
        ('it = { 0 = "telaio" }', "names.it.0", "the frame, which has no name on a sheet"),
        ("it = 3", "names.it", "3"),
        ('de = { lever = "Hebel" }', "names.de", "unknown key"),
    ],
)
def test_names_that_cannot_be(names, place, found):
    lines = SCENE.splitlines()
    lines[3:5] = [names]
    with pytest.raises(SceneError) as caught:
        scene("\n".join(lines))
    (problem,) = caught.value.problems
    assert (problem.place, problem.found) == (place, found)
