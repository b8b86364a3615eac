"""Photographs of sheets on other papers: on ANSI B, and on two leaves of A4."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner, Result

from graphkin.cli.main import app
from graphkin.reading.settled_points import records_in
from tests.reading.camera import Shot, photograph
from tests.reading.hand import DrawnSheet, Habits, drawn_sheet, sheets_of

LAB = Path(__file__).parents[2] / "sheets" / "pump"
ROSTER = "Nr.;Matricol;Nume;Grupa\n7;0042;Ana Pop;A\n"
GRID = {"x": [30.0, 120.0, 215.0, 310.0, 390.0], "y": [30.0, 120.0, 200.0, 250.0]}
PLACES = np.stack(np.meshgrid(GRID["x"], GRID["y"]), axis=-1).reshape(-1, 2)
TILTED = Shot(size=(3000, 2250), tilt=18, k1=-0.04, turn=4)


def call(*words: object) -> Result:
    return CliRunner().invoke(app, [str(word) for word in words], catch_exceptions=False)


def drawn_on(paper: str, folder: Path) -> tuple[Path, DrawnSheet]:
    """A class of a school with a paper, and what its student has drawn."""
    shutil.copytree(LAB, folder / "pump")
    house = f'graphkin = 1\n[pages]\npaper = "{paper}"\nlanguage = "en"\n'
    (folder / "pump" / "house.toml").write_text(house, encoding="utf-8")
    (folder / "class.csv").write_text(ROSTER, encoding="utf-8")
    made = call("variants", folder / "pump", folder / "class.csv", "-o", folder / "class")
    assert made.exit_code == 0, made.output
    manifest = json.loads((folder / "class" / "manifest.json").read_text(encoding="utf-8"))
    code = str(manifest["students"][0]["code"])
    habits = Habits(point=0.3, line=0.3)
    return folder / "class", drawn_sheet(folder / "class", code, "velocity", habits, 3)


def are_read(folder: Path, drawing: DrawnSheet) -> None:
    """Every point is read as right, within 0.6 mm of where it was drawn."""
    (record,) = records_in(folder)
    assert (record.refused, record.kind) == (None, "velocity")
    true = {point.step: point for point in drawing.points}
    read = [point for point in record.points if point.step in true]
    assert len(read) > 4
    for point in read:
        assert point.verdict == "right", point
        assert abs(complex(*point.at) - complex(*true[point.step].at)) < 0.6


def test_a_sheet_on_ansi_b_is_found_by_its_own_frame(tmp_path: Path) -> None:
    made, drawing = drawn_on("ANSI B", tmp_path)
    assert sheets_of(made, drawing.code).paper.width == pytest.approx(431.8)
    taken = photograph(drawing.image, Shot(**{**asked(TILTED), "sheet": (431.8, 279.4)}), 7)
    (tmp_path / "one.jpg").write_bytes(taken.data)
    (tmp_path / "grid").write_text(json.dumps(GRID), encoding="utf-8")
    found = call(
        "read", made, tmp_path / "one.jpg", "-o", tmp_path / "read", "--grid", tmp_path / "grid",
        "--jobs", "1",
    )  # fmt: skip
    assert found.exit_code == 0, found.output
    are_read(tmp_path / "read", drawing)
    (record,) = records_in(tmp_path / "read")
    off = np.hypot(*(np.array(record.map) - taken.where(PLACES)).T)
    assert np.median(off) < 0.5  # pixels, of about 6 a mm
    assert record.paper == ("ANSI B", "ASME")


def test_two_photographed_leaves_of_a4_are_one_sheet(tmp_path: Path) -> None:
    made, drawing = drawn_on("A4", tmp_path)
    middle = drawing.image.shape[1] // 2
    photos = tmp_path / "photos"
    photos.mkdir()
    halves = {"left": drawing.image[:, :middle], "right": drawing.image[:, middle:]}
    for seed, (half, image) in enumerate(halves.items()):
        shot = Shot(**{**asked(TILTED), "sheet": (210.0, 297.0), "size": (2250, 3000)})
        taken = photograph(np.ascontiguousarray(image), shot, 11 + seed)
        (photos / f"one-{half}.jpg").write_bytes(taken.data)
    found = call("read", made, photos, "-o", tmp_path / "read", "--jobs", "1")
    assert found.exit_code == 0, found.output
    are_read(tmp_path / "read", drawing)
    shutil.copy(photos / "one-left.jpg", tmp_path / "alone.jpg")
    alone = call("read", made, tmp_path / "alone.jpg", "-o", tmp_path / "other", "--jobs", "1")
    assert "alone: refused: shows one of two A4 pages" in alone.output


def asked(shot: Shot) -> dict[str, object]:
    return {name: getattr(shot, name) for name in shot.__struct_fields__}
