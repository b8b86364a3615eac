"""What links are called on the sheets of a language."""

from __future__ import annotations

from unicodedata import category, normalize

import pytest
import tomlkit

from graphkin.documents.sheet_documents import hand_out
from graphkin.drawing.marks import Text
from graphkin.mechanism import Mechanism
from graphkin.scene.findings import Findings, plain_text
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import SceneError
from tests.scene_files import scene_text

SCENE = scene_text("scene/guide")
OWN = ("crank", "lever", "block")


def scene(text: str = SCENE):
    return read_text(text, "shaper")


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
        ('xx = { lever = "Hebel" }', "names.xx", "unknown key"),
    ],
)
def test_names_that_cannot_be(names, place, found):
    lines = SCENE.splitlines()
    lines[3:5] = [names]
    with pytest.raises(SceneError) as caught:
        scene("\n".join(lines))
    (problem,) = caught.value.problems
    assert (problem.place, problem.found) == (place, found)


def test_wheels_that_roll_on_what_is_named_and_not_written_are_told_with_their_places():
    """Also where a link that keeps another wheel in its place gets the free name."""
    tables = tomlkit.parse(scene_text("loops/driven-against-a-slid-track"))
    tables["links"].pop("1")
    with pytest.raises(SceneError) as caught:
        read_text(tomlkit.dumps(tables), "own", None, {})
    places = {problem.place for problem in caught.value.problems}
    assert places == {"links.3.rolls.start.1", "drivers[0].turn"}


@pytest.mark.parametrize("name", ["sin", "pi", "t", "lambda", "class", "in"])
def test_a_parameter_has_no_name_that_an_expression_cannot_hold(name):
    text = f"{SCENE}\n[parameters]\n{name} = 2\n"
    with pytest.raises(SceneError, match=rf"parameters\.{name}: {name} has a meaning of its own"):
        scene(text)


def test_every_text_is_composed_or_refused_as_the_tables_of_unicode_say():
    for each in map(chr, range(0x3000)):
        for raw in (each, f"e{each}", f"\u0438\u0306{each}"):
            control = each not in "\n\t" and category(each) in ("Cc", "Cf", "Cs")
            found = Findings()
            assert plain_text("title", raw, found) == ("" if control else normalize("NFC", raw))
            assert bool(found.problems) == control
