"""What a newcomer reads and runs, run: scripts, scenes, and every block and link of the pages."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

import graphkin
from graphkin.construction.core.solution import FAIR
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from tests.examples.document import (
    CLASSES_PAGE,
    CONTRIBUTING,
    EXAMPLES,
    README,
    ROOT,
    SCENES_PAGE,
    VERSION,
    Block,
    Mistake,
    anchors,
    blocks,
    commands,
    links,
    mistakes,
    whole_above,
    with_part,
)
from tests.running import ran

SCRIPTS = sorted(EXAMPLES.glob("[0-9][0-9]_*.py"))
FIRST = ("crank-rocker", "engine", "offset-slider-crank", "six-bar")  # those that the pages name
SCENES = [EXAMPLES / "scenes" / f"{name}.toml" for name in FIRST]
WHOLE, *BLOCKS = blocks(SCENES_PAGE, "toml")
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


def my_scene(folder: Path, part: str = "") -> Path:
    """The page's whole scene with a part of it written otherwise, as my.toml."""
    path = folder / "my.toml"
    path.write_text(with_part(WHOLE.text, part), encoding="utf-8")
    return path


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
    (block,) = blocks(README, "toml")
    path = tmp_path / "my.toml"
    path.write_text(block.text, encoding="utf-8")
    assert ran("check", path).exit_code == 0
    result = ran("sheet", path, "-o", tmp_path)
    assert result.exit_code == 0, result.stderr
    shipped = tomllib.loads((EXAMPLES / "scenes/offset-slider-crank.toml").read_text("utf-8"))
    assert tomllib.loads(block.text) == shipped


def test_the_python_of_the_readme_prints_what_it_says(tmp_path: Path) -> None:
    (block,) = blocks(README, "python")
    said = python(tmp_path, "-c", block.text).splitlines()
    told = re.findall(r"^print\(.*?\)\s+# (.+)$", block.text, re.MULTILINE)
    for line, comment in zip(said, told, strict=False):
        for number in re.findall(r"-?\d+\.\d+|True", comment):
            assert number in line


def test_the_whole_scene_of_the_page_solves() -> None:
    mechanism = Mechanism(read_text(WHOLE.text, "my"))
    assert mechanism.witness(mechanism.solve()).agrees


def scene_of(block: Block) -> str:
    """A block of the page as a scene: whole, or as a part of the last whole one above it."""
    if block.text.startswith(VERSION):
        return block.text
    return with_part(whole_above(SCENES_PAGE, block.line), block.text)


@pytest.mark.parametrize("block", BLOCKS, ids=lambda block: f"line {block.line}")
def test_a_block_on_the_page_is_a_scene_or_fits_into_one(block: Block) -> None:
    mechanism = Mechanism(read_text(scene_of(block), "my"))
    assert mechanism.witness(mechanism.solve()).agrees


@pytest.mark.parametrize("mistake", mistakes(SCENES_PAGE), ids=lambda each: str(each.number))
def test_a_mistake_gives_the_message_on_the_page(
    mistake: Mistake, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    my_scene(tmp_path, mistake.part)
    monkeypatch.chdir(tmp_path)
    result = ran("check", "my.toml")
    assert result.exit_code == 2
    assert result.stderr == f"graphkin: my.toml: {mistake.message}\n"


def test_commands_on_the_page_answer_as_it_says(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    my_scene(tmp_path)
    monkeypatch.chdir(tmp_path)
    told = list(commands(SCENES_PAGE))
    assert told
    for command, answer in told:
        assert ran(*command.split()[1:]).output == answer


@pytest.mark.parametrize(
    "block", blocks(SCENES_PAGE, "text"), ids=lambda block: f"line {block.line}"
)
def test_what_check_shows_on_the_page_is_what_it_shows(block: Block, tmp_path: Path) -> None:
    path = tmp_path / "my.toml"
    path.write_text(whole_above(SCENES_PAGE, block.line), encoding="utf-8")
    assert block.text in ran("check", path).stdout


def test_every_scene_is_named_on_the_page_once() -> None:
    page = SCENES_PAGE.read_text(encoding="utf-8")
    _, table = page.split("## Scenes that come with it")
    named = re.findall(r"\(scenes/(.+?)\.toml\)", table.split("\n## ")[0])
    assert sorted(named) == sorted(path.stem for path in (EXAMPLES / "scenes").glob("*.toml"))


@pytest.mark.parametrize("page", [README, CONTRIBUTING, SCENES_PAGE, CLASSES_PAGE], ids=named)
def test_every_link_leads_to_a_file_and_a_heading(page: Path) -> None:
    led = list(links(page))
    assert led
    assert [to for to, _ in led if not to.exists()] == []
    assert [(to, heading) for to, heading in led if heading and heading not in anchors(to)] == []


def test_without_ask_everything_is_asked() -> None:
    text = with_part(WHOLE.text, "[ask]\n").replace("[ask]", "")
    asked = Mechanism(read_text(text, "my")).asked()
    wanted = {("velocity", "B"), ("acceleration", "C"), ("omega", "4"), ("pole", "3")}
    assert wanted <= set(asked)


def test_the_bound_of_an_unfair_crossing_is_the_one_on_the_page() -> None:
    assert FAIR == 1e-4
    assert "sine of their angle is below 1e-4" in SCENES_PAGE.read_text(encoding="utf-8")


def test_a_scale_is_real_over_drawn_and_one_that_does_not_fit_is_refused(tmp_path: Path) -> None:
    text = (EXAMPLES / "scenes/engine.toml").read_text("utf-8")
    path = tmp_path / "engine.toml"
    path.write_text(f"{text}\n[sheet]\nscale = 10\n", encoding="utf-8")
    result = ran("sheet", path, "-o", tmp_path / "out")
    assert result.exit_code == 0, result.stderr
    assert "1:10" in (tmp_path / "out/engine-velocity-key.svg").read_text("utf-8")
    path.write_text(f"{text}\n[sheet]\nscale = 2\n", encoding="utf-8")
    assert ran("sheet", path, "-o", tmp_path / "none").exit_code == 2
