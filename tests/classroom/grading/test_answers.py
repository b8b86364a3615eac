"""Answer tables: strict numbers, units, senses in three languages, all mistakes told at once."""

from __future__ import annotations

from math import pi

import openpyxl
import pytest

from graphkin.classroom.grading.answer_numbers import read_answer, rounding
from graphkin.classroom.grading.answers import Unread, read_answers
from graphkin.classroom.grading.feedback_rows import unread
from graphkin.classroom.grading.graded import Answer
from graphkin.classroom.lab.lab_model import Item
from graphkin.classroom.roster.student_signs import signs
from graphkin.text import words
from graphkin.text.errors import RosterError

LENGTH = Item("v_D_mm", "segment", "v", "mm", "velocity", "D")
SPEED = Item("v_D", "value", "v", "m/s", "velocity", "D")
RATE = Item("omega_3", "value", "ω", "rad/s", "omega", "3")
HARD = Item("a_D", "value", "a", "m/s²", "acceleration", "D")
SENSE = Item("omega_3_sense", "sense", "ω", "", "omega", "3")
SLIDING = Item("v_slide_2_sense", "sense", "v", "", "slide speed", "2")
FORM = (LENGTH, SPEED, RATE, SENSE)
IDS = ("001", "002", "ĂÎ-3")


@pytest.mark.parametrize(
    ("text", "item", "value"),
    [
        ("19.75", LENGTH, 19.75),
        ("19,75", LENGTH, 19.75),
        (" 19,75 mm ", LENGTH, 19.75),
        ("1,975cm", LENGTH, 19.75),
        ("-5", LENGTH, -5.0),
        ("−5", LENGTH, -5.0),
        ("+.5", LENGTH, 0.5),
        ("3.8 m/s", SPEED, 3.8),
        ("380 cm/s", SPEED, 3.8),
        ("3,8e2", SPEED, 380.0),
        ("4,7·10^2 m/s^2", HARD, 470.0),
        ("4.7 x 10^2 m/s2", HARD, 470.0),
        ("473 m/s²", HARD, 473.0),
        ("27,6 1/s", RATE, 27.6),
        ("27,6 s^-1", RATE, 27.6),
        ("27.6 (rad/s)", RATE, 27.6),
        ("≈ 3,8", SPEED, 3.8),
        ("~3.8 m/s", SPEED, 3.8),
        ("ca. -5", LENGTH, -5.0),
    ],
)
def test_numbers_are_read_with_point_or_comma_and_unit(text, item, value):
    answer = read_answer(text, item)
    assert answer.value == pytest.approx(value, rel=1e-15)
    assert not answer.problem


@pytest.mark.parametrize(
    ("text", "what", "value"),
    [
        ("2 in", "mm", 50.8),
        ("2 in", "m", 0.0508),
        ("2 in/s", "m/s", 0.0508),
        ("2 in/s2", "m/s²", 0.0508),
        ("180 deg/s", "rad/s", pi),
        ("180 °/s", "rad/s", pi),
        ("30 rpm", "rad/s", pi),
        ("30 rot/min", "rad/s", pi),
        ("30 rev/min", "rad/s", pi),
        ("30 giri/min", "rad/s", pi),
        ("180 deg/s2", "rad/s²", pi),
    ],
)
def test_inches_degrees_and_turns_are_read_in_the_unit_of_the_field(text, what, value):
    """An inch is 25.4 mm; half a turn is π rad, which 30 turns a minute make in a second."""
    assert read_answer(text, Item("x", "value", "x", what, "", "x")).value == pytest.approx(value)


@pytest.mark.parametrize(
    "text",
    [
        "１２.５",
        "1_000",
        "nan",
        "inf",
        "1e400",
        "12,3,4",
        "1.234,5",
        "0x1F",
        "twelve",
        "12 kg",
        "--5",
        "5..",
        "=5",
        "٣",
        "1" * 400,
    ],
)
def test_what_is_no_number_is_unreadable_and_says_why(text):
    answer = read_answer(text, SPEED)
    assert answer.value is None
    assert answer.problem
    assert not answer.is_blank


@pytest.mark.parametrize("text", ["", " ", "\t"])
def test_nothing_is_not_answered(text):
    assert read_answer(text, SPEED).is_blank
    assert read_answer(text, SENSE).is_blank


def written(folder, name, text):
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def test_a_table_with_semicolons_a_mark_and_strange_columns(tmp_path):
    text = (
        "\ufeffMatricol;V_D_MM;v_D;omega_3_sense;comment\n001;19,75;3,8;orar;=1+1\nĂÎ-3;;abc;+;\n"
    )
    found = read_answers(written(tmp_path, "a.csv", text), FORM, signs(IDS))
    assert found.of["001"]["v_D_mm"].value == 19.75
    assert found.of["001"]["omega_3_sense"].value == -1
    assert found.of["ĂÎ-3"]["v_D_mm"].is_blank
    assert found.unread == [Unread("a.csv", 3, "ĂÎ-3", "v_D", "abc", "number", "m/s")]
    assert found.missing == ["omega_3"]
    assert [(each.file, each.name) for each in found.strangers] == [("a.csv", "comment")]


def test_a_student_may_sign_with_the_code_on_the_sheets(tmp_path):
    text = "id,v_D\nQWERTYUIOP,3.8\n002,1\n"
    found = read_answers(written(tmp_path, "a.csv", text), FORM, signs(IDS, {"001": "QWERTYUIOP"}))
    assert found.of["001"]["v_D"].value == 3.8
    with pytest.raises(RosterError, match="has answers already"):
        read_answers(
            written(tmp_path, "a.csv", text + "001,2\n"), FORM, signs(IDS, {"001": "QWERTYUIOP"})
        )


@pytest.mark.parametrize(
    ("text", "item", "problem"),
    [
        ("twelve", SPEED, "number"),
        ("12,3,4", SPEED, "number"),
        ("?", SPEED, "open"),
        ("12 kg", SPEED, "unit"),
        ("3 mm", RATE, "unit"),
        ("1e400", SPEED, "large"),
        ("sus", SENSE, "turning"),
        ("orar", SLIDING, "sliding"),
    ],
)
def test_what_cannot_be_read_says_why(text, item, problem):
    assert read_answer(text, item).problem == problem


def test_every_broken_file_of_a_folder_is_told(tmp_path):
    written(tmp_path, "001.csv", 'field,value\nv_D,"1\n')
    written(tmp_path, "003.csv", "field,value\nv_D,1\n")
    (tmp_path / "002.csv").write_bytes(b"field,value\nv_D,\xff\n")
    with pytest.raises(RosterError) as error:
        read_answers(tmp_path, FORM, signs(IDS))
    told = "\n".join(str(problem) for problem in error.value.problems)
    assert all(f"00{n}" in told for n in (1, 2, 3))


@pytest.mark.parametrize(
    ("text", "share"), [("2,1", 0.05 / 2.1), ("27", 0.5 / 27), ("4,10", 0.005 / 4.1), ("", 0.0)]
)
def test_a_number_is_rounded_by_half_a_unit_of_its_last_digit(text, share):
    assert rounding(Answer(text)) == pytest.approx(share)


def test_everything_wrong_with_the_rows_is_told_at_once(tmp_path):
    text = "id,v_D\n001,1\n1,2\n001,3\n,4\n"
    with pytest.raises(RosterError) as error:
        read_answers(written(tmp_path, "a.csv", text), FORM, signs(IDS))
    places = [problem.place for problem in error.value.problems]
    assert places == [f'a.csv, row {row}, column "id"' for row in (3, 4, 5)]
    assert "answers already, in a.csv, row 2" in str(error.value)


def test_zeros_that_a_spreadsheet_took_away_count_only_where_two_ids_differ_by_them(tmp_path):
    path = written(tmp_path, "a.csv", "id,v_D\n1,2\n")
    assert read_answers(path, FORM, signs(IDS)).of["001"]["v_D"].value == 2
    with pytest.raises(RosterError, match=r"no student of this class; did you mean 0*1"):
        read_answers(path, FORM, signs([*IDS, "0001"]))


@pytest.mark.parametrize("text", ["name,v_D\nA,1\n", "id,colour\n001,red\n"])
def test_a_table_without_ids_or_fields_is_refused(tmp_path, text):
    with pytest.raises(RosterError, match="no column"):
        read_answers(written(tmp_path, "a.csv", text), FORM, signs(IDS))


def test_a_folder_with_a_file_for_each_student(tmp_path):
    written(tmp_path, "001.csv", "field;value\nv_D_mm;19,75\nomega_3_sense;ccw\n")
    written(tmp_path, "x.csv", "câmp,valoare\nmatricol,002\nv_D,3.8 m/s\nv_DD,1\n")
    written(tmp_path, "notes.md", "nothing")
    found = read_answers(tmp_path, FORM, signs(IDS))
    assert found.of["001"]["v_D_mm"].value == 19.75
    assert found.of["002"]["v_D"].value == 3.8
    assert [each.name for each in found.strangers] == ["v_DD"]
    assert found.missing == ["omega_3"]


def test_a_folder_without_tables_is_refused(tmp_path):
    with pytest.raises(RosterError, match="without any table"):
        read_answers(tmp_path, FORM, signs(IDS))


def test_answers_in_a_spreadsheet(tmp_path):
    book = openpyxl.Workbook()
    for line in (("id", "v_D_mm", "omega_3_sense"), ("001", 19.75, "cw")):
        book.active.append(line)
    book.save(tmp_path / "a.xlsx")
    found = read_answers(tmp_path / "a.xlsx", FORM, signs(IDS))
    assert found.of["001"]["v_D_mm"].value == 19.75
    assert found.of["001"]["omega_3_sense"].value == -1


def test_the_answers_to_another_lab_are_refused_with_their_columns(tmp_path):
    text = "id,v_D,v_Q,a_Q,omega_9\n001,3.8,1,2,3\n"
    with pytest.raises(RosterError, match="only 1 of the form's 4 fields") as refused:
        read_answers(written(tmp_path, "a.csv", text), FORM, signs(IDS))
    assert "v_Q, a_Q, omega_9" in str(refused.value)
    with pytest.raises(RosterError, match=r"no column is a field of the form.*v_Q"):
        read_answers(written(tmp_path, "b.csv", "id,v_Q,a_Q\n001,1,2\n"), FORM, signs(IDS))


@pytest.mark.parametrize(
    "text",
    ["1o,5", "3.8.2", "1O", "2l", "5o0", "5O0 m/s", "1o m/s", "47b3,2", "4b7", "3x12", "1/2"],
)
def test_a_mistyped_number_is_no_matter_of_units(text):
    assert read_answer(text, SPEED).problem == "number"


@pytest.mark.parametrize("text", ["12 kg", "3 kg/m3", "3 m³", "4 N/m2", "5 mm^2", "2 l", "7 oz"])
def test_a_unit_of_something_else_is_no_mistyped_number(text):
    assert read_answer(text, SPEED).problem == "unit"


@pytest.mark.parametrize(
    ("language", "said"),
    [("en", "is not a number"), ("ro", "nu este un număr"), ("it", "non è un numero")],
)
def test_letters_among_the_digits_are_told_as_no_number(language, said):
    answer = read_answer("5o0", HARD)
    assert unread(answer.problem, HARD.unit, words(language)) == said


@pytest.mark.parametrize("text", ["-", "–", " n/a ", "N.A.", "na", "--"])
def test_what_stands_for_no_answer_is_none(text):
    assert read_answer(text, SPEED).is_blank
    sense = read_answer(text, SENSE)
    assert sense.is_blank or (text in "-–" and sense.value == -1)


def test_a_number_that_is_about_right_is_as_rough_as_its_digits():
    assert rounding(read_answer("≈ 3,8", SPEED)) == rounding(read_answer("3,8", SPEED))
