"""Answer tables: strict numbers, units, senses in three languages, all mistakes told at once."""

from __future__ import annotations

from math import pi

import openpyxl
import pytest

from graphkin.classroom.grading.answer_numbers import read_answer, rounding
from graphkin.classroom.grading.answers import Unread, read_answers
from graphkin.classroom.grading.class_report import stranger_lines
from graphkin.classroom.grading.feedback import unread
from graphkin.classroom.grading.graded import Answer
from graphkin.classroom.lab.lab_model import Item
from graphkin.classroom.roster.students import signs
from graphkin.text import words
from graphkin.text.errors import RosterError

LENGTH = Item("v_D", "segment", "v", "mm", "velocity", "D")
SPEED = Item("v_D", "value", "v", "m/s", "velocity", "D")
RATE = Item("omega_3", "value", "ω", "rad/s", "omega", "3")
HARD = Item("a_D", "value", "a", "m/s²", "acceleration", "D")
SENSE = Item("omega_3", "sense", "ω", "", "omega", "3")
SLIDING = Item("v_slide_2", "sense", "v", "", "slide speed", "2")
FORCE = Item("R_12", "value", "R", "N", "reaction", "12")
MOMENT = Item("M_b1", "value", "M", "N·m", "balancing moment", "1")
FORM = (LENGTH, SPEED, RATE, SENSE)
IDS = ("001", "002", "ĂÎ-3")
NUMBERS = (
    (LENGTH, 19.75, "19.75 | 19,75 |  19,75 mm  | 1,975cm | 19.75 mm. | 19,75 mm;"),
    (LENGTH, 1234.5, "1.234,5 | 1,234.5 | 1 234,5 | 1\N{NO-BREAK SPACE}234.5 mm | 1'234.5"),
    (LENGTH, 1234567.0, "1.234.567 | 1,234,567 | 1 234 567,0 | 1.234.567,0 mm."),
    (LENGTH, -5.0, "-5 | −5 | ca. -5"),
    (LENGTH, 0.5, "+.5"),
    (LENGTH, 50.8, "2 in"),
    (SPEED, 3.8, "3.8 m/s | 380 cm/s | ≈ 3,8 | ~3.8 m/s"),
    (SPEED, 380.0, "3,8e2"),
    (SPEED, 0.429, "v=0.429 | v_D = 0,429 m/s | vD≈0.429 | V_D: 0.429 | 0.429 m/sec"),
    (SPEED, 0.429, "4.29x10⁻¹ | 4,29 × 10⁻¹ m/s | 4.29·10^(-1) | 4.29*10**-1 | 4.29·10^−1"),
    (SPEED, 0.0508, "2 in/s"),
    (HARD, 470.0, "4,7·10^2 m/s^2 | 4.7 x 10^2 m/s2"),
    (HARD, 473.0, "473 m/s²"),
    (HARD, 0.0508, "2 in/s2"),
    (RATE, 27.6, "27,6 1/s | 27,6 s^-1 | 27.6 (rad/s) | ω_3 = 27.6 | w3=27,6 | omega_3 = 27.6 s⁻¹"),
    (RATE, pi, "180 deg/s | 180 °/s | 30 rpm | 30 rot/min | 30 rev/min | 30 giri/min"),
    (RATE, pi, "30 tr/min | 30 об/мин | 30 об./мин. | 30 U/min | 30 r/min | 30 RPM | 30 min⁻¹"),
    (RATE, 27.6, "27,6 рад/с | 27.6 с⁻¹ | 27.6 Rad/s | 27.6 rad·s⁻¹;"),
    (LENGTH, 19.75, "19,75 мм | 1,975 см. | 19.75 MM | 19,75;"),
    (SPEED, 0.43, "0,43 м/с | 430 мм/сек | 0.43 m·s⁻¹ | 0.43 M/S"),
    (HARD, 473.0, "473 м/с² | 473 m·s⁻² | 473 m/sec²,"),
    (Item("x", "value", "x", "m", "", "x"), 0.0508, "2 in"),
    (FORCE, 12.5, "12,5 Н | 12.5 N | 0,0125 кН"),
    (MOMENT, 12.5, "12,5 Н·м | 12.5 Нм | 12,5 Н м | 12.5 N·m | 12.5 Nm"),
    (SPEED, 0.43, "0,43 М/С"),
    (Item("x", "value", "x", "rad/s²", "", "x"), pi, "180 deg/s2"),
)
"""What is written, by its field, and the number meant: an inch is 25.4 mm; half a turn is π rad,
which 30 turns a minute make in a second."""
UNREAD = (
    (SPEED, "number", "１２.５ | 1_000 | nan | inf | 12,3,4 | 12.34,5 | 0x1F | twelve | --5 | 5.."),
    (SPEED, "number", "=5 | ٣ | 1o,5 | 3.8.2 | 1O | 2l | 5o0 | 5O0 m/s | 1o m/s | 47b3,2 | 4b7"),
    (SPEED, "number", "3x12 | 1/2 | a_D = 0.43 | v=w=3"),
    (SPEED, "number", "1.234,56,7 | 1,234.567.8 | 0.234,5 | 0.4 3"),
    (SPEED, "large", "1e400"),
    (SPEED, "open", "?"),
    (SPEED, "unit", "12 kg | 3 kg/m3 | 3 m³ | 4 N/m2 | 5 mm^2 | 2 l | 7 oz"),
    (RATE, "unit", "3 mm"),
    (SENSE, "turning", "sus | 3,21 | +0 | +3 kg"),
    (SLIDING, "sliding", "orar"),
)  # fmt: skip
"""What cannot be read, and why: a mistyped number is no matter of units."""


@pytest.mark.parametrize(("item", "value", "texts"), NUMBERS)
def test_numbers_are_read_with_point_or_comma_and_in_the_unit_of_the_field(item, value, texts):
    for text in texts.split(" | "):
        answer = read_answer(text, item)
        assert answer.value == pytest.approx(value, rel=1e-15), text
        assert not answer.problem


@pytest.mark.parametrize(("item", "problem", "texts"), UNREAD)
def test_what_cannot_be_read_says_why(item, problem, texts):
    for text in texts.split(" | "):
        answer = read_answer(text, item)
        assert (answer.value, answer.problem) == (None, problem), text
        assert not answer.is_blank
    assert read_answer("1" * 400, SPEED).problem


def test_what_stands_for_no_answer_is_none():
    for text in ("", " ", "\t", "-", "–", " n/a ", "N.A.", "na", "--"):
        assert read_answer(text, SPEED).is_blank
        sense = read_answer(text, SENSE)
        assert sense.is_blank or (text in "-–" and sense.value == -1)


@pytest.mark.parametrize(
    ("text", "share"),
    [
        ("2,1", 0.05 / 2.1),
        ("27", 0.5 / 27),
        ("4,10", 0.005 / 4.1),
        ("1.234,5", 0.05 / 1234.5),
        ("", 0.0),
    ],
)
def test_a_number_is_rounded_by_half_a_unit_of_its_last_digit(text, share):
    assert rounding(Answer(text)) == pytest.approx(share)
    if text:  # what is about right is as rough as its digits
        assert rounding(read_answer(f"≈ {text}", SPEED)) == rounding(read_answer(text, SPEED))


def test_letters_among_the_digits_are_told_as_no_number():
    problem, said = read_answer("5o0", HARD).problem, ("nu este un număr", "is not a number")
    told = [unread(problem, HARD.unit, words(language)) for language in ("ro", "en", "it")]
    assert told == [*said, "non è un numero"]


@pytest.mark.parametrize(
    ("text", "value"), [("+3,21", 1), ("-3.21 rad/s", -1), ("− 3,2", -1), ("ω_3 = -3.21", -1)]
)
def test_a_signed_number_in_the_field_of_a_sense_states_the_sense(text, value):
    assert read_answer(text, SENSE).value == value


# --- tables --------------------------------------------------------------------------------------


@pytest.fixture
def read(tmp_path):
    """Read answers that are saved as a table, or as tables of a folder by their names."""

    def found(saved, who=signs(IDS)):  # noqa: B008
        for name, text in (saved if isinstance(saved, dict) else {"a.csv": saved}).items():
            (tmp_path / name).write_bytes(text if isinstance(text, bytes) else text.encode())
        return read_answers(tmp_path if isinstance(saved, dict) else tmp_path / "a.csv", FORM, who)

    return found


def test_a_table_with_semicolons_a_mark_and_strange_columns(read):
    text = (
        "\ufeffMatricol;V_D_MM;v_D;omega_3_sense;comment\n001;19,75;3,8;orar;=1+1\nĂÎ-3;;abc;+;\n"
    )
    found = read(text)
    assert found.of["001"]["v_D_mm"].value == 19.75
    assert found.of["001"]["omega_3_sense"].value == -1
    assert found.of["ĂÎ-3"]["v_D_mm"].is_blank
    assert found.unread == [Unread("a.csv", 3, "ĂÎ-3", "v_D", "abc", "number", "m/s")]
    assert found.missing == ["omega_3"]
    told = [" ".join(stranger_lines(found, earn, words("en"))) for earn in ({"omega_3"}, {"v_D"})]
    assert ["no column for omega_3" in line for line in told] == [True, False]
    assert [(each.file, each.name) for each in found.strangers] == [("a.csv", "comment")]


def test_a_unit_in_the_head_is_that_of_bare_numbers(read):
    """A cell's own unit has the last word; a unit that is not known waits in each cell."""
    found = read(
        "id,v_D_mm [cm],v_D (mm/s),omega_3_sense [+/-]\n001,1.975,3800,+1\n002,2 mm,4 m/s,\n"
    )
    assert found.of["001"]["v_D_mm"].value == pytest.approx(19.75)
    assert found.of["001"]["v_D"].value == pytest.approx(3.8)
    assert found.of["001"]["omega_3_sense"].value == 1
    assert (found.of["002"]["v_D_mm"].value, found.of["002"]["v_D"].value) == (2, 4)
    assert [each.problem for each in read("id,v_D [kg]\n001,3.8\n").unread] == ["unit"]


def test_a_student_may_sign_with_the_code_on_the_sheets(read):
    text, coded = "id,v_D\nQWERTYUIOP,3.8\n002,1\n", signs(IDS, {"001": "QWERTYUIOP"})
    assert read(text, who=coded).of["001"]["v_D"].value == 3.8
    twice = read(f"{text}001,2\n", who=coded)
    assert twice.withheld == ["001"]
    assert "has answers already, in a.csv, row 2" in str(twice.refused[0].problem)


def test_a_folder_with_a_file_for_each_student(read):
    found = read(
        {
            "001.csv": "field;value\nv_D_mm;19,75\nomega_3_sense;ccw\n",
            "x.csv": "câmp,valoare\nmatricol,002\nv_D,3.8 m/s\nv_DD,1\n",
            "notes.md": "nothing",
        }
    )
    assert found.of["001"]["v_D_mm"].value == 19.75
    assert found.of["002"]["v_D"].value == 3.8
    assert [each.name for each in found.strangers] == ["v_DD"]
    assert found.missing == ["omega_3"]


def test_every_broken_file_of_a_folder_and_all_wrong_rows_are_told_at_once(read):
    broken = 'field,value\nv_D,"1\n', b"field,value\nv_D,\xff\n", "field,value\nv_D,1\n"
    with pytest.raises(RosterError) as error:
        read({f"00{n}.csv": text for n, text in enumerate(broken, 1)})
    told = "\n".join(str(problem) for problem in error.value.problems)
    assert all(f"00{n}" in told for n in (1, 2, 3))
    with pytest.raises(RosterError) as error:
        read("id,v_D\n001,1\n1,2\n001,3\n,4\n")
    places = [problem.place for problem in error.value.problems]
    assert places == [f'a.csv, row {row}, column "id"' for row in (3, 4, 5)]
    assert "answers already, in a.csv, row 2" in str(error.value)


def test_zeros_that_a_spreadsheet_took_away_count_only_where_two_ids_differ_by_them(read):
    assert read("id,v_D\n1,2\n").of["001"]["v_D"].value == 2
    with pytest.raises(RosterError, match=r"no student of this class; did you mean 0*1"):
        read("id,v_D\n1,2\n", who=signs([*IDS, "0001"]))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("name,v_D\nA,1\n", "no column"),
        ("id,colour\n001,red\n", "no column"),
        ({}, "without any table"),
        ("id,v_D,v_Q,a_Q,omega_9\n001,3.8,1,2,3\n", r"only 1 of the form's 4 fields.*v_Q, a_Q, om"),
        ("id,v_Q,a_Q\n001,1,2\n", r"no column is a field of the form.*v_Q"),
    ],
)
def test_a_table_without_ids_or_fields_or_of_another_lab_is_refused(read, text, said):
    with pytest.raises(RosterError, match=said):
        read(text)


def test_answers_in_a_spreadsheet(tmp_path):
    book = openpyxl.Workbook()
    for line in (("id", "v_D_mm", "omega_3_sense"), ("001", 19.75, "cw")):
        book.active.append(line)
    book.save(tmp_path / "a.xlsx")
    found = read_answers(tmp_path / "a.xlsx", FORM, signs(IDS))
    assert found.of["001"]["v_D_mm"].value == 19.75
    assert found.of["001"]["omega_3_sense"].value == -1


def test_a_field_that_one_student_answers_twice_is_told(tmp_path):
    (tmp_path / "001.csv").write_text("field;value\nv_D;3,8\nv_D;3,9\n", encoding="utf-8")
    with pytest.raises(RosterError, match=r"001\.csv, row 3.*v_D is answered twice"):
        read_answers(tmp_path, FORM, signs(IDS))
