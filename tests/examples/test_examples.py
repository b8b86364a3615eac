"""What a newcomer runs, run: the scripts, some scenes, and the scene of the README."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

import graphkin
from tests.examples.document import EXAMPLES, README, ROOT, blocks_in
from tests.running import ran

SCRIPTS = sorted(EXAMPLES.glob("[0-9][0-9]_*.py"))
FIRST = ("crank-rocker", "engine", "offset-slider-crank", "six-bar")  # those that the pages name
SCENES = [EXAMPLES / "scenes" / f"{name}.toml" for name in FIRST]
DOCUMENTS = (
    "velocity-{}.svg",
    "velocity-{}.pdf",
    "acceleration-{}.svg",
    "acceleration-{}.pdf",
    "calculation-{}.pdf",
)


def named(path: Path) -> str:
    """The name of a file as the name of a test."""
    return path.stem


def python(folder: Path, *args: str) -> str:
    """What a process of Python says, run in a folder, its warnings being errors."""
    surroundings = {**os.environ, "PYTHONPATH": str(ROOT), "PYTHONIOENCODING": "utf-8"}
    surroundings["TMPDIR"] = surroundings["TEMP"] = str(folder)
    found = subprocess.run(
        [sys.executable, "-W", "error", *args],
        cwd=folder,
        env=surroundings,
        capture_output=True,
        check=False,
    )
    assert found.returncode == 0, found.stderr.decode("utf-8")
    assert not found.stderr
    return found.stdout.decode("utf-8")


@pytest.mark.parametrize("script", SCRIPTS, ids=named)
def test_a_script_runs_and_has_something_to_show(script: Path, tmp_path: Path) -> None:
    said = python(tmp_path, str(script))
    assert len(said.splitlines()) >= 10
    assert "nan" not in said.lower()
    assert "False" not in said


def test_there_are_scripts_and_scenes_to_test() -> None:
    assert len(SCRIPTS) == 5
    assert all(scene.is_file() for scene in SCENES)


def test_sheets_go_into_the_folder_that_is_named(tmp_path: Path) -> None:
    folder = tmp_path / "mine"
    said = python(tmp_path, str(EXAMPLES / "03_sheets.py"), str(folder))
    written = sorted(path.name for path in folder.iterdir())
    assert [name for name in written if name not in said] == []
    assert written == sorted(
        f"pump-n{n}-{document.format(view)}"
        for n in (7, 8)
        for view in ("task", "key")
        for document in DOCUMENTS
    )


def test_the_textbook_is_met(tmp_path: Path) -> None:
    said = python(tmp_path, str(EXAMPLES / "04_own_scene.py"))
    off = [float(percent) for percent in re.findall(r"(\S+)%", said)]
    assert len(off) == 4
    assert max(off) < 3  # the book's values were read from a drawing


@pytest.mark.parametrize("scene", SCENES, ids=named)
def test_a_scene_is_right_by_both_routes(scene: Path) -> None:
    mechanism = graphkin.load(scene)
    assert mechanism.witness(mechanism.solve()).agrees
    assert ran("check", scene).exit_code == 0


@pytest.mark.parametrize("view", ["task", "key"])
def test_a_scene_gives_its_sheets(view: str, tmp_path: Path) -> None:
    scene = SCENES[0]
    result = ran("sheet", scene, "-o", tmp_path, "--view", view)
    assert result.exit_code == 0, result.stderr
    expected = {f"{scene.stem}-{document.format(view)}" for document in DOCUMENTS}
    assert {path.name for path in tmp_path.iterdir()} == expected


def test_the_scene_of_the_readme_is_read_solved_and_drawn(tmp_path: Path) -> None:
    (block,) = blocks_in(README.read_text(encoding="utf-8"))
    path = tmp_path / "my.toml"
    path.write_text(block.text, encoding="utf-8")
    assert ran("check", path).exit_code == 0
    result = ran("sheet", path, "-o", tmp_path)
    assert result.exit_code == 0, result.stderr
    shipped = tomllib.loads((EXAMPLES / "scenes/offset-slider-crank.toml").read_text("utf-8"))
    shipped.pop("titles")  # the README keeps to one language
    assert tomllib.loads(block.text) == shipped


def test_a_scale_is_real_over_drawn_and_one_that_does_not_fit_is_refused(tmp_path: Path) -> None:
    text = (EXAMPLES / "scenes/engine.toml").read_text("utf-8")
    path = tmp_path / "engine.toml"
    path.write_text(f"{text}\n[sheet]\nscale = 10\n", encoding="utf-8")
    result = ran("sheet", path, "-o", tmp_path / "out")
    assert result.exit_code == 0, result.stderr
    assert "1:10" in (tmp_path / "out/engine-velocity-key.svg").read_text("utf-8")
    path.write_text(f"{text}\n[sheet]\nscale = 2\n", encoding="utf-8")
    assert ran("sheet", path, "-o", tmp_path / "none").exit_code == 2
