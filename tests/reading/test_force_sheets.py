"""Photographs of sheets of forces: the corners of polygons, and the fields that follow."""

from __future__ import annotations

import csv
import json
import shutil
from pathlib import Path

import pytest
from click.testing import CliRunner

from graphkin.cli.main import app
from graphkin.reading.settled_points import records_in
from tests.reading.camera import Shot, photograph
from tests.reading.hand import Habits, drawn_sheet, sheets_of

SCENE = Path(__file__).parents[2] / "examples" / "scenes" / "engine-forces.toml"
LAB = """graphkin = 1
[variants]
set = { phi = "45 + 15*(number mod 3)" }
[marks]
R_03_mm = 1
R_32_mm = 1
R_01_mm = 1
"""
ROSTER = "Nr.;Matricol;Nume;Grupa\n7;0042;Ana Pop;A\n"


def call(*words: object) -> None:
    told = CliRunner().invoke(app, [str(word) for word in words], catch_exceptions=False)
    assert told.exit_code == 0, told.output


def test_corners_of_polygons_are_read_and_their_fields_filled_in(tmp_path: Path) -> None:
    lab, folder = tmp_path / "engine", tmp_path / "class"
    lab.mkdir()
    shutil.copy(SCENE, lab / "scene.toml")
    (lab / "lab.toml").write_text(LAB, encoding="utf-8")
    (tmp_path / "class.csv").write_text(ROSTER, encoding="utf-8")
    call("variants", lab, tmp_path / "class.csv", "-o", folder, "--lang", "en")
    manifest = json.loads((folder / "manifest.json").read_text(encoding="utf-8"))
    code = str(manifest["students"][0]["code"])
    habits = Habits(point=0.3, line=0.3, headless=0.0)
    drawing = drawn_sheet(folder, code, "force", habits, 4)
    taken = photograph(drawing.image, Shot(size=(3600, 2700), tilt=12, turn=3), 5)
    (tmp_path / "one.jpg").write_bytes(taken.data)
    call("read", folder, tmp_path / "one.jpg", "-o", tmp_path / "read", "--jobs", "1")
    (record,) = records_in(tmp_path / "read")
    assert (record.refused, record.kind) == (None, "force")
    true = {each.step: each for each in drawing.points}
    assert {"A", "B", "D", "P_A", "R_03", "R_21"} <= {each.name for each in record.points}
    for point in record.points:
        assert point.verdict == "right" and not point.ask, point
        assert abs(complex(*point.at) - complex(*true[point.step].at)) < 0.6
    answers = (tmp_path / "read" / "answers.csv").read_text(encoding="utf-8")
    (row,) = csv.DictReader(answers.splitlines())
    key = next(each for each in sheets_of(folder, code).drawings if each.kind == "force")
    program, values = sheets_of(folder, code).mechanism.with_forces.program, key.trace.values
    for name in ("R_03", "R_32", "R_01"):
        tail, tip = program.steps[program.targets["reaction", name]].args
        exact = abs(values[tip] - values[tail]) * 1000 / key.scales.kF
        assert float(row[f"{name}_mm"]) == pytest.approx(exact, abs=1.2)
