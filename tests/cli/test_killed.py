"""Every command that writes several files writes all or none, whenever it is killed."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

import pytest

from graphkin.classroom.printing.edition import keep_language, read_edition
from graphkin.classroom.printing.print_run import FOLDER, Means, PrintRequest, print_class
from graphkin.reading.read_run import put
from graphkin.reading.read_sheet import SheetRead, SheetRecord
from graphkin.scene.scene_files import UNFINISHED
from graphkin.studio.folder import Folder
from graphkin.studio.session import OwnRules, save_files, save_scene
from graphkin.writers.commit import FORWARD, held, settle
from tests.running import Tree, planted, ran, states, tree

EXAMPLES = Path(__file__).resolve().parents[2] / "examples" / "scenes"
ROCKER = EXAMPLES / "four-bar-crank-rocker.toml"
ROSTERS = "number;id\n7;0007\n12;0012\n", "number;id\n9;0009\n"
ANSWERS = "id;v_D_mm\n0007;10\n", "id;v_D_mm\n0007;10\n0012;20\n"
DRAWN = ("--format", "svg", "--force", "-o")
COMMANDS: dict[str, Sequence[tuple[object, ...]]] = {
    "sheet": [("sheet", ROCKER, "--lang", language, *DRAWN) for language in ("en", "it")],
    "cycle": [("cycle", ROCKER, "--steps", 4, *DRAWN)],
    "accuracy": [("accuracy", ROCKER, "--quick", *DRAWN)],
    "ranges": [("ranges", "offset-slider-crank", "--force", "-o")],
    "quiz": [("quiz", "pump", "--count", 1, "--jobs", 1, "--force", "-o")],
    "variants": [("variants", "pump", f"{i}.csv", "--force", "-o") for i in range(2)],
    "new lab": [("new", "lab", "out", "-o")],
    "grade": [
        ("grade", "class", f"answers-{i}.csv", "--format", "html", "--jobs", 1, "--force", "-o")
        for i in range(2)
    ],
}
"""Commands as they are given, the folder behind them: once, then with other files to write."""


@pytest.fixture
def around(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with class lists, a class and answers of it, the current one."""
    monkeypatch.chdir(tmp_path)
    for number in range(2):
        Path(f"{number}.csv").write_text(ROSTERS[number], encoding="utf-8")
        Path(f"answers-{number}.csv").write_text(ANSWERS[number], encoding="utf-8")
    assert ran("variants", "pump", "0.csv", "-o", "class", "--lang", "en").exit_code == 0
    return tmp_path


def whole_at_every_moment(folder: Path, works: Sequence[Callable[[], object]]) -> None:
    """Each work leaves a folder as it was, or as it makes it, whenever it is killed."""
    for work in works:
        old = tree(folder)
        found = states(folder, work)
        new = tree(folder)
        assert old != new
        assert len(found) > 4
        ends = [settled(folder, state) for state in found]
        assert all(end in (old, new) for end in ends)
        assert [end for end in ends if end != ends[0]][-1] == new
        planted(folder, new)


def settled(folder: Path, state: Tree) -> Tree:
    """What the next command makes of a state, folders that hold nothing left out."""
    planted(folder, state)
    settle(folder)
    with held(folder):
        pass
    return tree(folder)


@pytest.mark.usefixtures("around")
@pytest.mark.parametrize("command", COMMANDS)
def test_a_command_that_is_killed_leaves_all_old_or_all_new(command: str) -> None:
    out = Path("out").absolute()
    out.mkdir()
    given = out.parent if command == "new lab" else out
    whole_at_every_moment(out, [partial(done, *args, given) for args in COMMANDS[command]])


def done(*args: object) -> None:
    """Run a command that ends well, or with students' faults."""
    result = ran(*args)
    assert result.exit_code in (0, 1), result.stderr


def test_what_the_studio_saves_is_all_old_or_all_new(tmp_path: Path) -> None:
    def scene(text: str) -> None:
        save_scene(Folder(tmp_path), "scene.toml", text, "", replace=True, rules=OwnRules(text))

    def sheets(text: str) -> None:
        files = {f"{name}.svg": text.encode() for name in "abc"}
        save_files(Folder(tmp_path), files, replace=True)

    works = [partial(save, text) for save in (scene, sheets) for text in ("one", "two")]
    whole_at_every_moment(tmp_path, works)


def test_a_reading_and_its_picture_are_both_old_or_both_new(tmp_path: Path) -> None:
    def reading(number: int) -> None:
        with held(tmp_path):
            put(tmp_path, SheetRead(SheetRecord("one", str(number), ""), b"%d" % number))

    whole_at_every_moment(tmp_path, [partial(reading, number) for number in (1, 2)])


def test_of_what_is_printed_no_student_has_half(around: Path) -> None:
    """Chunks of students come one after the other, each with the parts of all of them."""
    folder = around / "class" / FOLDER
    folder.mkdir()

    def printed(language: str) -> None:
        wishes = PrintRequest(language=language, force=True)
        print_class(read_edition(around / "class"), wishes, Means(), lambda done, total: None)

    printed("en")
    old = tree(folder)
    found = states(folder, partial(printed, "it"))
    new = tree(folder)
    sheets = [name for name in new if name.startswith(("task/", "key/", "form/"))]
    assert len(sheets) >= 4
    for state in found:
        end = settled(folder, state)
        assert end.keys() == new.keys()
        assert not [name for name in end if end[name] not in (old[name], new[name])][1:]
        for who in ("0007", "0012"):
            own = [name for name in sheets if f"/{who}" in name]
            assert [end[n] for n in own] in ([old[n] for n in own], [new[n] for n in own])
    planted(folder, found[len(found) // 2])
    printed("it")
    assert tree(folder) == new


READERS: dict[str, tuple[tuple[object, ...], str]] = {
    "check": (("check", "class/lab"), "class/lab"),
    "solve": (("solve", "class/lab"), "class/lab"),
    "print": (("print", "class", "--jobs", 1), "class"),
    "grade": (("grade", "class", "answers-0.csv", "--format", "none"), "class"),
    "report": (("grade", "class", "answers-0.csv", "--format", "none", "-o", "class/lab"), "class"),
    "quiz": (("quiz", "class", "--count", 1, "--jobs", 1), "class"),
    "variants": (("variants", "class/lab", "1.csv", "-o", "other"), "class/lab"),
    "again": (("variants", "pump", "1.csv", "-o", "class", "--force"), "class"),
    "sheet": (("sheet", "pump", "--set", "n=7", "-o", "class"), "class"),
}
"""Commands, and a folder that each opens."""


@pytest.mark.usefixtures("around")
@pytest.mark.parametrize("name", READERS)
def test_every_command_makes_whole_what_it_opens(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A run was killed when all was decided and nothing was moved; the command takes it up."""
    args, folder = READERS[name]
    hidden = Path(folder) / UNFINISHED
    hidden.mkdir()
    (hidden / "0.new").write_bytes(b"new")
    (hidden / FORWARD).write_text('{"files": ["note.txt"]}', encoding="utf-8")
    ran(*args)
    assert not hidden.exists()
    assert (Path(folder) / "note.txt").read_bytes() == b"new"


@pytest.mark.usefixtures("around")
def test_a_language_that_is_kept_is_written_whole() -> None:
    shutil.copytree("class", "again")
    whole_at_every_moment(Path("again").absolute(), [partial(keep_language, Path("again"), "it")])
