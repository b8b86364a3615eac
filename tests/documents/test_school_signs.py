"""Every page of a school is the usual page with the school's signs."""

from __future__ import annotations

import re

import pytest
from msgspec.structs import replace

from graphkin.classroom.lab.items import all_fields
from graphkin.documents.sheet_documents import hand_out
from graphkin.drawing.marks import Text
from graphkin.drawing.richtext import plain
from graphkin.mechanism import Mechanism, load
from graphkin.scene import scene_files
from graphkin.scene.read_scene import read_text
from graphkin.text import LANGUAGES, words
from graphkin.text.errors import SceneError
from graphkin.text.school_signs import MEANINGS, NAMES, SCHOOLS, USUAL, SchoolSigns
from graphkin.web.step_page import step_page
from tests.chosen import by_turns

MADE_UP = SchoolSigns(
    normal="N",
    tangential="T",
    coriolis="cor",
    sliding="rel",
    angular_acceleration="β",
    velocity_pole="θ",
    acceleration_pole="π",
    length_scale="μ_l",
    velocity_scale="μ_v",
    acceleration_scale="μ_a",
)
"""SchoolSigns of which no letter is used otherwise."""
WRITTEN = re.compile(r"[ντε]|\*k\*_[Lvan]\b|\*o\*(?!′?_)|\^\{?[cr]\b")
"""A usual sign in markup."""
SCENES = (
    "pump",
    "shaper",
    "stephenson-3-crank",
    "gears-kutzbach",
    "klein-engine",
    "excavator-relative",
    "roller",
)
SMALLEST = """
graphkin = 1
units = { length = "mm", angle = "deg", speed = "rad/s" }
[frame]
O = [0, 0]
[links.1]
O-A = 60
[[drivers]]
turn = 1
angle = 30
speed = 10
"""


def of_school(name: str, signs: SchoolSigns) -> Mechanism:
    """A scene of graphkin with some signs."""
    try:
        scene = load(name).scene
    except SceneError:
        scene = load(scene_files.examples()[name]).scene
    return Mechanism(replace(scene, sheet=replace(scene.sheet, signs=signs)))


def texts(mechanism: Mechanism, view: str, language: str) -> list[str]:
    """The markup of every text on the pages of a view."""
    pages = (page for part in hand_out(mechanism, view, language) for page in part.pages)
    return [mark.markup for page in pages for mark in page.marks if isinstance(mark, Text)]


@pytest.mark.parametrize(("name", "view"), by_turns(SCENES, ["key", "task", "steps"]))
def test_no_usual_sign_is_left_on_paper(name: str, view: str) -> None:
    left = [each for each in texts(of_school(name, MADE_UP), view, "en") if WRITTEN.search(each)]
    assert not left


@pytest.mark.parametrize("language", LANGUAGES)
def test_no_usual_sign_is_left_in_a_sentence(language: str) -> None:
    sentences = words(language, MADE_UP).sentences
    assert not {
        key: said for key, said in sentences.items() if re.search(r"[ντε]|a\^c|\*o\*", said)
    }
    usual = words(language).sentences
    assert {k for k in usual if usual[k] != sentences[k]} == {
        key for key, said in usual.items() if re.search(r"[ντε]|a\^c|\*k\*_|\*o\*", said)
    }


@pytest.mark.parametrize(
    ("school", "velocities", "accelerations"),
    [("german", "*P*_v", "*P*_a"), ("russian", "*p*", "*π*"), ("english", "*o*", "*o*′")],
)
def test_sentences_of_forces_name_the_poles_of_the_school(
    school: str, velocities: str, accelerations: str
) -> None:
    sentences = words("de", SCHOOLS[school].signs).sentences
    for key in ("force-inertia", "force-inertia-moved"):
        assert re.search(rf"nach {re.escape(accelerations)}(?:,|$)", sentences[f"step.{key}"])
    assert f"Momente um {velocities}:" in sentences["step.force-lever"]


@pytest.mark.parametrize("name", ["pump", "shaper"])
def test_a_page_for_the_screen_has_the_signs_of_its_sheets(name: str) -> None:
    page = step_page(of_school(name, MADE_UP), "en")
    shown = re.sub(r'data-name="[^"]*"', "", page)
    assert not re.findall(r"<i>ε</i>|<var>ε</var>|<sup>[ντ]</sup>|>[ντε]<", shown)
    assert "β" in shown and "μ" in shown


def test_names_of_marks_and_fields_do_not_depend_on_signs() -> None:
    usual, other = of_school("pump", USUAL), of_school("pump", MADE_UP)

    def names(mechanism: Mechanism) -> list[tuple[str, int | None]]:
        """Those of all but letters, which find no place in a crowd where signs are longer."""
        found = hand_out(mechanism)[1].pages[0].marks
        drawn = (m for m in found if m.cls.split()[0] not in ("label", "leader"))
        return sorted((mark.name, mark.step or 0) for mark in drawn if mark.step is not None)

    assert names(usual) == names(other)
    fields, signed = all_fields(usual), all_fields(other)
    assert list(fields) == list(signed)
    assert plain(fields["a_BA_nu"].symbol) == "aBAν"
    assert plain(signed["a_BA_nu"].symbol) == "aBAN"


def test_every_sign_has_a_meaning_and_every_set_its_book() -> None:
    assert tuple(MEANINGS) == NAMES
    assert all(school.books for school in SCHOOLS.values())
    assert SCHOOLS["romanian"].signs == USUAL


@pytest.mark.parametrize(
    "written, expected",
    [
        ('signs = "english"', SCHOOLS["english"].signs),
        (
            'signs = { set = "russian", tangential = "t" }',
            replace(SCHOOLS["russian"].signs, tangential="t"),
        ),
        ('signs = { acceleration_pole = "p\'" }', replace(USUAL, acceleration_pole="p′")),
    ],
)
def test_a_scene_states_its_signs(written: str, expected: SchoolSigns) -> None:
    assert read_text(f"{SMALLEST}[sheet]\n{written}\n", "x").sheet.signs == expected


def test_all_wrong_signs_are_told_at_once() -> None:
    wrong = 'signs = { set = "rusian", normal = "n*", tangentail = "t" }'
    with pytest.raises(SceneError) as error:
        read_text(f"{SMALLEST}[sheet]\n{wrong}\n", "x")
    told = [str(problem) for problem in error.value.problems]
    assert [each.split(":")[0] for each in told] == [
        "sheet.signs.set",
        "sheet.signs.normal",
        "sheet.signs.tangentail",
    ]
    assert "russian" in told[0] and "tangential" in told[2]


def test_a_pole_keeps_its_usual_sign_beside_a_point_of_that_letter() -> None:
    """A point P has the image p, so the pole of its plan is not p."""
    scene = SMALLEST.replace("O-A", "O-P")
    signs = read_text(f'{scene}[sheet]\nsigns = "russian"\n', "x").sheet.signs
    assert (signs.velocity_pole, signs.acceleration_pole) == ("o", "π")
