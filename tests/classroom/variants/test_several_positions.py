"""Several positions for each student: a sheet, a form and marks for each, and their sum."""

from __future__ import annotations

import io
import json
import zipfile
from fractions import Fraction

import pytest
from msgspec.structs import replace

from graphkin.classroom.grading.answers import packed_feedback, read_answers
from graphkin.classroom.grading.class_marking import graded_class
from graphkin.classroom.grading.class_report import class_report, counted_in, summary
from graphkin.classroom.grading.feedback import feedback_html
from graphkin.classroom.grading.graded import Answer
from graphkin.classroom.grading.grading_files import points_by_id, students_table
from graphkin.classroom.lab.fair_ranges import fair_ranges
from graphkin.classroom.lab.lab_model import picked, settings, sheets
from graphkin.classroom.lab.new_lab import proposed_ranges
from graphkin.classroom.lab.read_lab import read_lab
from graphkin.classroom.printing.edition import read_edition
from graphkin.classroom.printing.personal import owner
from graphkin.classroom.printing.print_run import bookmark
from graphkin.classroom.roster.students import Student
from graphkin.classroom.variants.assign import assigned
from graphkin.classroom.variants.class_files import class_lines, write_class
from graphkin.documents.positions import positions_of
from graphkin.mechanism import load
from graphkin.text import words
from graphkin.text.errors import RosterError, SceneError
from tests.scene_files import scene_text

LAB = """graphkin = 1
[variants]
{rule}
[fair]
crossing = 0
segment = 0
triangle = [0, 1e9]
[marks]
v_B = 2
a_B = 1
"""
DRAWN = 'course = "mechanics 2026"\npositions = { p = 3 }'
FORMULAS = 'positions = { p = ["number mod 12", "(number + 4) mod 12"] }'
STUDENTS = [Student(n + 1, f"{n:04d}", n, f"Name {n}") for n in range(1, 11)]


def lab_with(folder, rule, scene=None):
    (folder / "scene.toml").write_text(scene or scene_text("motion/own-position"), encoding="utf-8")
    (folder / "lab.toml").write_text(LAB.format(rule=rule), encoding="utf-8")
    return read_lab(folder)


@pytest.fixture
def drawn(tmp_path):
    return lab_with(tmp_path, DRAWN)


def test_each_student_gets_three_different_positions_in_order(drawn):
    found = assigned(drawn, STUDENTS)
    assert [each.student.id for each in found[:4]] == ["0001-1", "0001-2", "0001-3", "0002-1"]
    for student in STUDENTS:
        own = [each.settings["p"] for each in found if each.student.owner == student.id]
        assert own == sorted(set(own))
        assert len(own) == 3
    assert {each.settings["p"] for each in found} == set(range(12))


def test_a_hash_of_course_lab_and_id_picks_among_the_positions_that_are_left(drawn):
    left, own = list(range(12)), []
    for part in (1, 2, 3):
        index = picked("mechanics 2026", drawn.name, "0007", 0, f"p {part}") % len(left)
        own.append(left.pop(index))
    got = [settings(drawn, each)["p"] for each in sheets(drawn.rule, STUDENTS[6])]
    assert got == sorted(own)


def test_formulas_give_positions_by_the_number(tmp_path):
    lab = lab_with(tmp_path, FORMULAS)
    assert lab.rule.counts
    found = assigned(lab, STUDENTS)
    own = [each.settings["p"] for each in found if each.student.owner == "0009"]
    assert own == [9, 1]


def test_the_sheets_of_a_student_share_what_else_is_drawn(tmp_path):
    scene = scene_text("motion/own-position").replace(
        "[frame]", "r = { value = 60, min = 50, max = 70, step = 1 }\n[frame]"
    )
    scene = scene.replace("O-A = 60", 'O-A = "r"')
    rule = f"{DRAWN}\ndraw = {{ r = {{ min = 50, max = 70, step = 1 }} }}"
    found = assigned(lab_with(tmp_path, rule, scene), STUDENTS)
    for student in STUDENTS:
        assert len({e.settings["r"] for e in found if e.student.owner == student.id}) == 1
    assert len({each.settings["r"] for each in found}) > 3


def test_all_sheets_of_a_student_are_drawn_again_where_one_is_unfair(tmp_path):
    lab = lab_with(tmp_path, DRAWN)
    text = (tmp_path / "lab.toml").read_text(encoding="utf-8")
    (tmp_path / "lab.toml").write_text(text.replace("crossing = 0", "crossing = 66"), "utf-8")
    strict = read_lab(tmp_path)
    before, after = assigned(lab, STUDENTS), assigned(strict, STUDENTS)
    assert all(each.fair for each in after)
    assert any(each.attempt for each in after)
    for student in STUDENTS:
        own = [each for each in after if each.student.owner == student.id]
        assert len({each.attempt for each in own}) == 1
    assert [each.settings for each in before] != [each.settings for each in after]


def edition_of(lab, folder):
    roster = folder / "class.csv"
    roster.write_text("id\n", encoding="utf-8")
    write_class(folder / "class", lab, assigned(lab, STUDENTS), roster, force=True)
    return read_edition(folder / "class")


def right(edition, taker):
    key = edition.book.expectation(taker).key
    return {field: Answer(f"{value}", abs(value)) for field, value in key.items()}


def test_each_sheet_is_marked_by_its_own_position_and_the_points_are_added(drawn, tmp_path):
    edition = edition_of(drawn, tmp_path)
    every = positions_of(load(drawn.scene), words("en"))
    answers = {}
    for taker in edition.takers:
        plan = every.numbered[int(taker.settings["p"])].plans["velocity"]
        key = edition.book.expectation(taker).key
        assert key["v_B"] == pytest.approx(abs(plan.trace.value("velocity", "B")), rel=1e-9)
        answers[taker.student.id] = right(edition, taker)
    answers["0001-2"] = {name: Answer("9e9", 9e9) for name in answers["0001-2"]}
    del answers["0002-3"]
    found = graded_class(edition.book, edition.takers, answers, as_it_is=True)
    assert summary(found.graded, words("en")).startswith("29 of 30 sheets handed in")
    points = points_by_id(found)
    assert points == {"0001": 6, "0002": 6} | {f"{n:04d}": 9 for n in range(3, 11)}
    assert points_by_id(found, Fraction(10))["0001"] == Fraction(20, 3)
    rows = students_table(found).decode("utf-8-sig").splitlines()
    assert rows[0] == "id,name,group,points,of,pending,sheet 1,sheet 2,sheet 3"
    assert rows[1:3] == ["0001,Name 1,,6,9,,3,0,3", "0002,Name 2,,6,9,,3,3,"]


def test_the_manifest_says_whose_sheet_it_is(drawn, tmp_path):
    edition = edition_of(drawn, tmp_path)
    raw = json.loads((tmp_path / "class/manifest.json").read_text(encoding="utf-8"))
    assert raw["rule"]["positions"]["p"] == 3
    assert (raw["students"][4]["owner"], raw["students"][4]["part"]) == ("0002", 2)
    assert [t.student.whose for t in edition.takers[2:4]] == ["0001", "0002"]
    assert edition.owners.who("0002") == "0002"
    assert edition.signs.who("0002") is None
    assert len({taker.code for taker in edition.takers}) == 30


@pytest.mark.parametrize(
    ("rule", "said"),
    [
        ('course = "c"\npositions = { q = 3 }', "positions.q: is no parameter"),
        ('course = "c"\npositions = { p = 13 }', "positions.p: 13; expected a whole number"),
        ("positions = { p = 3 }", "course: is missing"),
        ('positions = { p = ["1", "2"] }', "no formula uses number"),
        ('course = "c"\npositions = { p = "many" }', "expected a count, such as 3"),
        (f'{FORMULAS}\nset = {{ p = "number" }}', "set or draw gives p as well"),
    ],
)
def test_a_wrong_rule_is_refused_at_its_place(tmp_path, rule, said):
    with pytest.raises(SceneError) as error:
        lab_with(tmp_path, rule)
    assert said in str(error.value)


def test_equal_positions_by_formula_are_refused_with_the_row(tmp_path):
    lab = lab_with(tmp_path, 'positions = { p = ["number mod 12", "5*number mod 12"] }')
    with pytest.raises(RosterError, match="number 3 gets 3 twice"):
        assigned(lab, [Student(2, "a", 3)])


def test_an_id_that_looks_like_a_sheet_is_refused(drawn):
    with pytest.raises(RosterError, match='sheet 2 gets the id "7-2"'):
        assigned(drawn, [Student(2, "7", 1), Student(3, "7-2", 2)])


def own_scene(count='"8 + 4*m"'):
    text = scene_text("motion/own-position")
    text = text.replace("[frame]", "m = { value = 1, min = 0, max = 10, step = 1 }\n[frame]", 1)
    return text.replace("count = 12", f"count = {count}").replace(
        "start = 20", 'start = "20 + 5*m"'
    )


def test_each_student_has_an_own_start_and_number_of_positions(tmp_path):
    lab = lab_with(tmp_path, 'set = { m = "number mod 3" }', own_scene())
    for student in STUDENTS[:3]:
        own = settings(lab, student)
        found = positions_of(lab.variant(own), words("en"))
        assert len(found.numbered) == 8 + 4 * own["m"]
        assert found.numbered[0].at == pytest.approx(20 + 5 * float(own["m"]))


@pytest.mark.parametrize(("count", "said"), [('"7.5*m"', "gives 7.5"), ('"3*m"', "gives 3")])
def test_a_number_of_positions_that_is_no_whole_number_is_refused(tmp_path, count, said):
    lab = lab_with(tmp_path, 'set = { m = "number mod 3" }', own_scene(count))
    with pytest.raises(SceneError, match=f"positions.count: .*{said}"):
        positions_of(lab.variant({"m": Fraction(1)}), words("en"))


def test_moodle_gets_the_feedback_of_every_sheet_of_a_student():
    backs = {"7-1": "Ana_1_file_/", "7-2": "Ana_1_file_/", "8-1": "Ion_2_file_/"}
    pages = {"7-1": b"one", "7-2": b"two", "8-1": b"three"}
    with zipfile.ZipFile(io.BytesIO(packed_feedback(backs, pages, "pdf"))) as packed:
        read = {name: packed.read(name) for name in packed.namelist()}
    assert read == {
        "Ana_1_file_/feedback.pdf": b"one",
        "Ana_1_file_/feedback-2.pdf": b"two",
        "Ion_2_file_/feedback.pdf": b"three",
    }


@pytest.mark.parametrize("rule", [DRAWN, f'course = "c"\ndraw = {{ r = [60, 65] }}\n{FORMULAS}'])
def test_proposed_ranges_leave_the_students_their_positions(tmp_path, rule):
    scene = scene_text("motion/own-position").replace(
        "[frame]", "r = { value = 60, min = 50, max = 70, step = 5 }\n[frame]"
    )
    lab = lab_with(tmp_path, rule, scene.replace("O-A = 60", 'O-A = "r"'))
    new = proposed_ranges(lab, fair_ranges(lab))
    text = "\n".join(new.lines)
    again = lab_with(tmp_path, text.removeprefix("[variants]\n"), scene)
    assert again.rule.positions == lab.rule.positions
    assert again.rule.draws.keys() == {"r"}


def test_sheets_too_near_to_another_students_are_drawn_again_together(tmp_path):
    scene = scene_text("motion/own-position").replace(
        "[frame]", "r = { value = 60, min = 40, max = 80, step = 1 }\n[frame]"
    )
    rule = f"{DRAWN}\ntries = 8\ndraw = {{ r = {{ min = 40, max = 80, step = 1 }} }}"
    lab = lab_with(tmp_path, rule, scene.replace("O-A = 60", 'O-A = "r"'))
    text = (tmp_path / "lab.toml").read_text(encoding="utf-8")
    (tmp_path / "lab.toml").write_text(text.replace("[marks]", "apart = 0.6\n[marks]"), "utf-8")
    found = assigned(read_lab(tmp_path), STUDENTS)
    assert [each.settings for each in found] != [e.settings for e in assigned(lab, STUDENTS)]
    for student in STUDENTS:
        own = [each for each in found if each.student.owner == student.id]
        assert len({each.attempt for each in own}) == 1
        assert len({each.settings["r"] for each in own}) == 1
        assert len({each.settings["p"] for each in own}) == 3


def test_every_page_of_a_sheet_names_it_by_its_id(drawn, tmp_path):
    edition = edition_of(drawn, tmp_path)
    taker = edition.takers[1]
    assert owner(taker).name == "0001-2 Name 1"
    assert bookmark(taker) == "0001-2 Name 1"
    found = graded_class(edition.book, edition.takers, {"0001-2": right(edition, taker)})
    back = feedback_html(found.graded[1], "lab", drawn.rubric, words("en"))
    assert "0001-2 Name 1" in back.partition("</title>")[0]
    assert "0001-2 Name 1" in back.partition("</title>")[2]
    unnamed = replace(taker, student=replace(taker.student, name=""))
    assert owner(unnamed).name == "0001-2"


def test_what_is_counted_are_sheets(drawn, tmp_path):
    edition = edition_of(drawn, tmp_path)
    assert "fair       30 of 30 sheets" in list(class_lines(drawn, assigned(drawn, STUDENTS)))
    reversed_senses = {t.student.id: right(edition, t) for t in edition.takers}
    found = graded_class(edition.book, edition.takers, reversed_senses)
    assert counted_in(found.graded) == "sheets"
    assert 'class="n">sheets</th>' in class_report(found, "lab", (), words("en"))


def test_a_row_of_a_student_is_told_its_sheets(drawn, tmp_path):
    signs = edition_of(drawn, tmp_path).signs
    assert signs.sheets("0002") == ("0002-1", "0002-2", "0002-3")
    assert signs.sheets("000") == ()
    table = tmp_path / "answers.csv"
    table.write_text("id,v_B,a_B\n0002,1,2\n", encoding="utf-8")
    with pytest.raises(RosterError, match="write a row for each sheet: 0002-1, 0002-2, 0002-3"):
        read_answers(table, edition_of(drawn, tmp_path).book.form, signs)
