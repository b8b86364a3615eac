"""An empty table of answers has the students and fields of its class, and can be marked."""

from __future__ import annotations

import csv
import io
import json

import pytest

from tests.running import ran

TWO_POSITIONS = """set = { r = "61" }
positions = { n = ["number + 4", "number + 8"] }"""
CLASS = "number,id,name\n1,0042,Ana Pop\n2,0043,Ion Rus\n"


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "class.csv").write_text(CLASS, encoding="utf-8")
    assert ran("new", "lab", "crank").exit_code == 0
    assert ran("variants", "crank", "class.csv", "-o", "made").exit_code == 0
    return tmp_path


def test_the_table_has_the_students_and_the_fields_of_the_form(folder):
    assert ran("new", "answers", "made", "-o", "answers.csv").exit_code == 0
    text = (folder / "answers.csv").read_text("utf-8-sig")
    head, *rows = csv.reader(io.StringIO(text))
    assert head[:3] == ["id", "name", "code"]
    assert [row[:2] for row in rows] == [["0042", "Ana Pop"], ["0043", "Ion Rus"]]
    takers = json.loads((folder / "made" / "manifest.json").read_text("utf-8"))["students"]
    assert [row[2] for row in rows] == [each["code"] for each in takers]
    assert not any(cell for row in rows for cell in row[3:])
    filled = text.replace(f"0042,Ana Pop,{rows[0][2]},", f"0042,Ana Pop,{rows[0][2]},115.5")
    (folder / "answers.csv").write_text(filled, encoding="utf-8")
    marked = ran("grade", "made", "answers.csv", "--format", "html")
    assert "1 of 2 students handed in" in marked.stdout, marked.output
    marks = (folder / "made" / "report" / "marks.csv").read_text("utf-8-sig")
    assert all(field in marks for field in head[3:])


def test_a_table_is_not_replaced_unasked(folder):
    (folder / "answers.csv").write_text("mine", encoding="utf-8")
    assert ran("new", "answers", "made", "-o", "answers.csv").exit_code == 2
    assert (folder / "answers.csv").read_text("utf-8") == "mine"
    assert ran("new", "answers", "made").stdout.startswith("id,name,code,v_B_mm")


def test_each_position_has_a_row_with_its_value(folder):
    lab = folder / "crank" / "lab.toml"
    text = lab.read_text("utf-8")
    several = f"[variants]\n{TWO_POSITIONS}\n\n[fair]"
    lab.write_text(several.join([text[: text.index("[variants]")], text.partition("[fair]")[2]]))
    assert ran("variants", "crank", "class.csv", "-o", "two").exit_code in (0, 1)
    head, *rows = csv.reader(io.StringIO(ran("new", "answers", "two").stdout))
    assert head[:4] == ["id", "name", "code", "n"]
    assert [(row[0], row[3]) for row in rows if row[0].startswith("0042")] == [
        ("0042-1", "5"),
        ("0042-2", "9"),
    ]
