"""The lab that the README tells as a story, lived through: its commands, its files, its ending."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from click.testing import CliRunner

from graphkin.classroom.grading.grading_files import read_marks
from graphkin.cli.main import app
from tests.examples.document import FENCE, README

STORY = "A lab in ten minutes"


def story() -> str:
    """The section of the README."""
    _, text = README.read_text(encoding="utf-8").split(f"## {STORY}\n")
    return text.partition("\n## ")[0]


def test_the_story_ends_as_it_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    text = story()
    checked, roster, answers, decisions, export = (found[2] for found in FENCE.finditer(text))
    commands = re.findall(r"^    graphkin (.+)$", text, re.MULTILINE)
    assert [command.split()[0] for command in commands] == [
        *("new", "check", "variants", "print", "grade", "grade")
    ]
    for name, content in (("class.csv", roster), ("answers.csv", answers), ("moodle.csv", export)):
        assert name in text
        Path(name).write_text(content, encoding="utf-8")

    def lived(command: str) -> str:
        found = CliRunner().invoke(app, command.split())
        assert found.exit_code == 0, found.output
        return found.output

    lived(commands[0])
    said = lived(commands[1])
    assert [line for line in checked.splitlines() if line not in said] == []
    lived(commands[2])
    lived(commands[3])
    assert {"class-task.pdf", "class-key.pdf"} <= {
        p.name for p in Path("crank-2026/print").iterdir()
    }
    lived(commands[4])
    before = read_marks(Path("report/marks.csv").read_bytes())["0042"]
    wrong = [head for head, cell in before.items() if head.endswith(" why") and cell != "right"]
    assert wrong == ["a_B_mm why"]
    Path("report/decisions.csv").write_text(decisions, encoding="utf-8")
    assert "decisions.csv: 1 decided" in lived(commands[5])
    after = read_marks(Path("report/marks.csv").read_bytes())["0042"]
    assert after["points"] == after["of"] == "14.5"
    reason = decisions.splitlines()[1].split(";")[-1]
    assert reason in Path("report/feedback/0042.html").read_text(encoding="utf-8")
    filled = export.replace("Submitted for grading,,", "Submitted for grading,10,")
    assert Path("report/gradebook-moodle.csv").read_text(encoding="utf-8") == filled
