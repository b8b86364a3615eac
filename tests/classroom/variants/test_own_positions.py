"""A position of its own for each student: drawn strongly on the sheet, and asked on the form."""

from __future__ import annotations

import pytest

from graphkin.classroom.grading.standard import standard
from graphkin.classroom.lab.items import items
from graphkin.classroom.lab.lab_model import exact_text
from graphkin.classroom.lab.read_lab import read_lab
from graphkin.classroom.roster.students import Student
from graphkin.classroom.variants.assign import assigned
from graphkin.documents.positions import positions_of
from graphkin.documents.sheet_documents import hand_out
from graphkin.drawing.marks import Text
from graphkin.mechanism import load
from graphkin.text import words
from tests.scene_files import scene_text

LAB = """graphkin = 1
[variants]
set = { p = "5*number mod 12" }
[fair]
crossing = 0
segment = 0
triangle = [0, 1e9]
[marks]
v_B_mm = 2
v_B = 1
a_B = 1
"""
STUDENTS = [Student(n, f"s{n}", n) for n in range(1, 13)]


@pytest.fixture(scope="module")
def lab(tmp_path_factory):
    folder = tmp_path_factory.mktemp("labs") / "own-position"
    folder.mkdir()
    (folder / "scene.toml").write_text(scene_text("motion/own-position"), encoding="utf-8")
    (folder / "lab.toml").write_text(LAB, encoding="utf-8")
    return read_lab(folder)


def test_every_position_is_given_to_one_student_of_twelve(lab):
    given = {each.settings["p"] for each in assigned(lab, STUDENTS)}
    assert given == set(range(12))


def test_the_form_asks_what_the_plan_of_the_students_own_position_shows(lab):
    every = positions_of(lab.mechanism, words("en"))
    for each in assigned(lab, STUDENTS):
        settings = {name: exact_text(value) for name, value in each.settings.items()}
        own = load(lab.scene, **settings)
        found = positions_of(own, words("en"))
        assert found.shown.name == settings["p"]
        assert [p.at for p in found.numbered] == pytest.approx([p.at for p in every.numbered])
        key = standard(own, items(own, lab), lab.rubric).key
        for field, kind in (("v_B", "velocity"), ("a_B", "acceleration")):
            plan = every.numbered[int(settings["p"])].plans[kind]
            assert key[field] == pytest.approx(abs(plan.trace.value(kind, "B")), rel=1e-9)


def test_the_sheet_prints_the_students_own_position(lab):
    pages = {part.kind: part.pages for part in hand_out(load(lab.scene, p="7"), "positions", "en")}
    (page,) = pages["mechanism"]
    said = [mark.markup for mark in page.marks if isinstance(mark, Text)]
    assert any("position 7 is drawn strongly" in text for text in said)
