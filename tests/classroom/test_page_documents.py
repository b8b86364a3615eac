"""``graphkin sheet --format html``: one page beside the files for paper, by view."""

from __future__ import annotations

from pathlib import Path

import pytest

from graphkin.mechanism import load
from graphkin.text import words
from graphkin.web import step_page as pages
from graphkin.web.slider import Slider
from tests.running import Run


def written(folder: Path) -> list[str]:
    """The files of a folder."""
    return sorted(path.name for path in folder.iterdir())


@pytest.mark.parametrize("view", ["key", "steps"])
def test_one_page_is_written_with_every_step(run: Run, tmp_path: Path, view):
    args = ("sheet", "pump", "--set", "n=7", "-o", tmp_path, "--format", "html", "--view", view)
    result = run(*args, "--lang", "en")
    assert result.exit_code == 0, result.stderr
    assert written(tmp_path) == [f"pump-n7-{view}.html"]
    page = (tmp_path / f"pump-n7-{view}.html").read_text(encoding="utf-8")
    assert page.startswith("<!DOCTYPE html>")
    assert page.count('<li id="step-') == 42
    assert run(*args).exit_code == 2  # it is there already


def test_the_task_of_a_lab_holds_its_form(run: Run, tmp_path: Path):
    args = ("sheet", "pump", "-o", tmp_path, "--format", "html", "--view", "task", "--lang", "en")
    assert run(*args).exit_code == 0
    page = (tmp_path / "pump-task.html").read_text(encoding="utf-8")
    assert 'class="answers"' in page
    assert '<li id="step-' not in page


def test_a_mechanism_that_stands_still_says_why(monkeypatch):
    why = "screen.open"
    monkeypatch.setattr(pages, "slider", lambda *_: Slider(why=why))
    page = pages.step_page(load("pump"), "en")
    assert f'<p id="still">{words("en")(why)}</p>' in page
    assert 'id="driver"' not in page
    assert "const graphkinMotion" not in page
