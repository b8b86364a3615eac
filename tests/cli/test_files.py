"""Files are written whole or not at all."""

from __future__ import annotations

import os
import sys
import threading
from pathlib import Path

import pytest

from graphkin.text.errors import PageError
from graphkin.writers import files
from graphkin.writers.files import file_stem, refuse_folder, write_all
from tests.running import Run

FILES = {"a.txt": b"one", "b.txt": b"two", "c.txt": b"three"}


def names(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


def test_every_file_in_the_way_is_told(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text("mine")
    (tmp_path / "c.txt").mkdir()
    with pytest.raises(PageError) as raised:
        write_all(tmp_path, FILES, force=False)
    assert [Path(problem.place).name for problem in raised.value.problems] == ["a.txt", "c.txt"]
    with pytest.raises(PageError, match="is a folder"):
        write_all(tmp_path, FILES, force=True)
    assert names(tmp_path) == ["a.txt", "c.txt"]


@pytest.mark.parametrize("broken", [1, 2, 3])
def test_a_failing_rename_leaves_nothing_new(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, broken: int
) -> None:
    calls = []
    rename = os.replace

    def failing(source: str, target: str) -> None:
        calls.append(target)
        if len(calls) == broken:
            raise PermissionError(13, "Permission denied", str(source))
        rename(source, target)

    monkeypatch.setattr(os, "replace", failing)
    with pytest.raises(PageError, match=r"cannot be (written|replaced): permission denied"):
        write_all(tmp_path, FILES, force=False)
    assert names(tmp_path) == []


def test_long_stems_are_cut_and_kept_apart() -> None:
    settings = {f"parameter{i}": "1/3" for i in range(40)}
    one, other = file_stem("ă" * 90, settings), file_stem("ă" * 90, settings | {"last": "2"})
    assert one != other
    assert max(len(stem.encode("utf-8")) for stem in (one, other)) <= 180
    assert file_stem("pump", {"n": "7"}) == "pump-n7"


DEAD = 99_999_999
"""A process that cannot be: Linux gives numbers up to 4 194 304."""


@pytest.mark.skipif(sys.platform == "win32", reason="processes are not asked there")
def test_what_a_killed_run_left_aside_is_removed_and_nothing_else(tmp_path: Path) -> None:
    stale = tmp_path / f".graphkin-{DEAD}.part"
    others = [
        tmp_path / f".graphkin-{os.getppid()}.part",
        tmp_path / f".graphkin-{DEAD}-0.part",
        tmp_path / "other.part",
    ]
    for path in (stale, *others):
        path.write_bytes(b"half")
    write_all(tmp_path, {"a.svg": b"a"}, force=False)
    assert not stale.exists()
    assert all(path.exists() for path in others)


def test_of_runs_at_once_without_force_one_writes_and_the_others_are_told(tmp_path: Path) -> None:
    """Each finds the way free, then waits for the one that holds the folder."""
    start = threading.Barrier(4)
    found: list[object] = []

    def run(number: int) -> None:
        start.wait()
        try:
            found.append(write_all(tmp_path, {"a.svg": b"%d" % number, "b.svg": b"x"}, force=False))
        except PageError as error:
            found.append(str(error))

    threads = [threading.Thread(target=run, args=(number,)) for number in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert sum(isinstance(each, list) for each in found) == 1
    assert sum("exists already" in each for each in found if isinstance(each, str)) == 3
    assert names(tmp_path) == ["a.svg", "b.svg"]


def test_what_comes_into_a_folder_while_a_run_waits_is_not_replaced(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The way was free when the run came; another run wrote before it held the folder."""
    (tmp_path / "a.svg").write_bytes(b"other")
    looked: list[Path] = []
    refuse = files.refuse_existing

    def late(folder: Path, targets: list[Path], force: bool) -> None:
        looked.append(folder)
        refuse(folder, targets, force or len(looked) == 1)

    monkeypatch.setattr(files, "refuse_existing", late)
    with pytest.raises(PageError, match="exists already"):
        write_all(tmp_path, {"a.svg": b"new"}, force=False)
    assert (tmp_path / "a.svg").read_bytes() == b"other"


WORK = {
    "sheet": "graphkin.documents.sheet_documents.hand_out",
    "cycle": "graphkin.motion.cycle.cycle",
    "accuracy": "graphkin.accuracy.study.study",
    "quiz": "graphkin.classroom.quiz.moodle_quiz.variants_of",
    "ranges": "graphkin.classroom.lab.fair_ranges.fair_ranges",
}
"""The commands that write into a folder, and what takes them long."""


@pytest.mark.parametrize("command", WORK)
def test_a_folder_that_cannot_be_written_is_told_before_anything_is_worked_out(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, command: str
) -> None:
    worked: list[object] = []
    monkeypatch.setattr(WORK[command], lambda *given, **more: worked.append(given))
    (tmp_path / "file").write_text("no folder")
    out = tmp_path / "file" / "new"
    result = run(command, "pump", "-o", out)
    assert result.exit_code == 2
    assert result.stderr == (
        f"graphkin: {out}: cannot be written: not a directory; expected a folder that can be "
        "written; name one with -o\n"
    )
    assert not worked


def test_trying_a_folder_leaves_nothing_and_makes_nothing(tmp_path: Path) -> None:
    refuse_folder(tmp_path / "a" / "b")
    assert names(tmp_path) == []


def test_a_name_has_one_file_whether_its_accents_are_composed_or_not():
    composed, apart = "pomp\u0103", "pompa\u0306"
    assert file_stem(apart, {}) == file_stem(composed, {}) == composed
    assert file_stem("\u202ex", {}) == "x"
