"""A turn's score sheet, saved from a student's page, beside answers: told, and proof of nothing."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from graphkin.classroom.grading.turn_scores import TURNS
from graphkin.cli.main import app
from tests.browser.opening import Opened
from tests.browser.test_your_turn import by_lists
from tests.running import Run


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    """A class folder of a student of the pump, with the page of the key."""
    place = tmp_path_factory.mktemp("turns")
    (place / "class.csv").write_text("Nr.;Matricol\n7;0042\n", encoding="utf-8")
    made = place / "pump"
    for args in (
        ("variants", "pump", place / "class.csv", "-o", made),
        ("print", made, "--view", "key", "--format", "html", "--lang", "en", "--jobs", "1"),
    ):
        result = CliRunner().invoke(app, [str(arg) for arg in args])
        assert result.exit_code == 0, result.output
    return made


@pytest.fixture
def answers(tmp_path) -> Path:
    """A folder with one student's answers."""
    found = tmp_path / "answers"
    found.mkdir()
    (found / "0042-answers.csv").write_text("field;value\nid;0042\nv_D;1\n", encoding="utf-8")
    return found


def graded(run: Run, folder: Path, answers: Path, report: Path) -> tuple[str, list[dict[str, str]]]:
    """What grading says, and the score sheets that it lists."""
    result = run("grade", folder, answers, "-o", report, "--format", "none")
    assert result.exit_code == 0, result.output
    with (report / "turns.csv").open(encoding="utf-8-sig", newline="") as file:
        return result.output, list(csv.DictReader(file))


def test_a_saved_score_sheet_is_listed_beside_answers(
    opened: Opened,
    folder: Path,
    answers: Path,
    run: Run,
    tmp_path: Path,
):
    page = opened(
        folder / "print" / "key" / "0042-key.html",
        "#step=6",
        viewport={"width": 1440, "height": 900},
    )
    page.locator("#turn").click()
    by_lists(page, "perpendicular", "a", "O2B")
    by_lists(page, "perpendicular", "a", "AB")
    page.locator("#draw-it").click()
    assert not page.locator("#turn-save").is_visible()
    page.locator("#turn-score").click()
    with page.expect_download() as saved:
        page.locator("#turn-save").click()
    assert saved.value.suggested_filename == "0042-turn.json"
    path = answers / saved.value.suggested_filename
    saved.value.save_as(path)
    assert "proves nothing" in page.locator("#turn-say").inner_text()

    said, (row,) = graded(run, folder, answers, tmp_path / "report")
    assert "prove nothing" in said
    told = {name: row[name] for name in ("id", "from_step", "steps", "alone", "drawn_by_page")}
    assert told == {
        "id": "0042",
        "from_step": "6",
        "steps": "2",
        "alone": "1",
        "drawn_by_page": "1",
    }
    assert (row["wrong"], row["seal"]) == ("1", "right")

    found = json.loads(path.read_text(encoding="utf-8"))
    found["steps"][1][1] = "alone"
    path.write_text(json.dumps(found), encoding="utf-8")
    _, (row,) = graded(run, folder, answers, tmp_path / "again")
    assert (row["alone"], row["seal"]) == ("2", "broken")

    path.write_text("nonsense", encoding="utf-8")
    result = run("grade", folder, answers, "-o", tmp_path / "unread", "--format", "none")
    assert result.exit_code == 1
    assert "0042-turn.json: " in result.output
    assert not (tmp_path / "unread" / TURNS).exists()
