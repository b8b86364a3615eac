"""Several files are put in their places as one: all are new or all old, whatever ends the run."""

from __future__ import annotations

import errno
import json
import os
from functools import partial
from pathlib import Path

import pytest

from graphkin.scene.scene_files import UNFINISHED
from graphkin.text.errors import FileError, PageError
from graphkin.writers import commit
from graphkin.writers.commit import BACK, FORWARD, settle
from graphkin.writers.files import write_all
from tests.running import planted, states, tree, watched

OLD = {"marks.csv": b"old", "pages": None, "pages/1.html": b"old", "mine.txt": b"mine"}
FILES = {"marks.csv": b"new", "pages/1.html": b"new", "pages/2.html": b"new", "key/1.pdf": b"new"}
NEW = {**OLD, **FILES, "key": None}


def written(folder: Path) -> list[Path]:
    return write_all(folder, FILES, force=True)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return planted(tmp_path / "report", OLD)


@pytest.fixture(params=["links", "copies"])
def ways(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """File systems with hard links and without."""
    if request.param == "copies":
        monkeypatch.setattr(os, "link", refused)


def refused(*_given: object, **_more: object) -> None:
    raise OSError(errno.EPERM, "Operation not permitted")


@pytest.mark.usefixtures("ways")
def test_a_run_killed_at_any_moment_is_finished_or_taken_back_by_the_next(
    folder: Path, tmp_path: Path
) -> None:
    found = states(folder, lambda: written(folder))
    assert tree(folder) == NEW
    assert len(found) > 20
    ends = []
    for state in found:
        left = planted(tmp_path / "left", state)
        settle(left)
        write_all(left, {"next.txt": b""}, force=True)  # a single file, aside, may wait as well
        (left / "next.txt").unlink()
        ends.append(tree(left))
    assert all(end in (OLD, NEW) for end in ends)
    decided = ends.index(NEW)
    assert 0 < decided < len(ends) - 1
    assert all(end == NEW for end in ends[decided:])


@pytest.mark.usefixtures("ways")
def test_the_next_run_may_be_killed_as_well(folder: Path, tmp_path: Path) -> None:
    """Both ways: while it finishes, and while it takes back what cannot be finished."""
    for state in states(folder, lambda: written(folder))[::4]:
        left = planted(tmp_path / "left", state)
        for again in states(left, partial(settle, left)):
            last = planted(tmp_path / "last", again)
            settle(last)
            assert tree(last) in (OLD, NEW)


@pytest.mark.usefixtures("ways")
@pytest.mark.parametrize("number", [errno.ENOSPC, errno.EACCES, errno.EIO])
def test_a_system_that_refuses_at_any_moment_leaves_all_as_it_was_or_all_new(
    folder: Path, number: int
) -> None:
    outcomes = set()
    for point in range(1, 200):
        planted(folder, OLD)
        refusing = Refusing(point, number)
        raised: PageError | None = None
        with watched(folder, refusing):
            try:
                written(folder)
            except PageError as error:
                raised = error
        if not refusing.reached:
            break
        settle(folder)
        assert tree(folder) in (OLD, NEW), point
        assert raised is None or os.strerror(number).lower() in str(raised)
        outcomes.add((raised is None, tree(folder) == NEW))
    assert (False, False) in outcomes
    assert (False, True) not in outcomes


class Refusing:
    """A system that refuses one change of a folder."""

    def __init__(self, point: int, number: int) -> None:
        self.point, self.number, self.reached = point, number, False

    def __call__(self, count: int, path: Path, _opened: bool) -> None:
        if count == self.point:
            self.reached = True
            raise OSError(self.number, os.strerror(self.number), str(path))


@pytest.mark.parametrize("name", [*FILES])
def test_a_file_that_another_program_has_open_is_named_and_all_others_stay(
    folder: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    """As a spreadsheet does on Windows."""
    held_open(monkeypatch, folder / name)
    with pytest.raises(FileError) as raised:
        written(folder)
    assert str(raised.value) == (
        f"{folder / name}: cannot be replaced: permission denied; expected a file that no other "
        "program has open; close it, perhaps in a spreadsheet or a viewer, and run the command "
        "again"
    )
    assert tree(folder) == OLD
    monkeypatch.undo()
    written(folder)
    assert tree(folder) == NEW


def test_a_single_file_that_another_program_has_open_is_named(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    held_open(monkeypatch, folder / "marks.csv")
    with pytest.raises(FileError, match=r"marks\.csv: cannot be replaced: permission denied"):
        write_all(folder, {"marks.csv": b"new"}, force=True)
    assert tree(folder) == OLD


def test_what_cannot_be_finished_later_is_taken_back(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A run was killed between two files; then somebody opened one that was still to come."""
    between = next(
        state
        for state in states(folder, lambda: written(folder))
        if state.get("marks.csv") == b"new" and state["pages/1.html"] == b"old"
    )
    left = planted(tmp_path / "left", between)
    held_open(monkeypatch, left / "pages" / "2.html")
    settle(left)
    assert tree(left) == OLD


def test_what_can_be_neither_finished_nor_taken_back_stops_every_command(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    between = next(
        state
        for state in states(folder, lambda: written(folder))
        if state.get("pages/1.html") == b"new" and "pages/2.html" not in state
    )
    left = planted(tmp_path / "left", between)
    held_open(monkeypatch, left / "marks.csv", left / "pages" / "2.html")
    for _ in range(2):
        with pytest.raises(FileError, match=r"marks\.csv: cannot be put back"):
            settle(left)
        with pytest.raises(FileError, match=r"marks\.csv: cannot be put back"):
            write_all(left, {"other": b""}, force=True)
    monkeypatch.undo()
    settle(left)
    assert tree(left) == OLD


def held_open(monkeypatch: pytest.MonkeyPatch, *paths: Path) -> None:
    """Let no file take the place of some."""
    rename = os.replace

    def replace(source: str, target: str) -> None:
        if Path(target) in paths:
            raise PermissionError(errno.EACCES, "Permission denied", str(source), None, str(target))
        rename(source, target)

    monkeypatch.setattr(os, "replace", replace)


def test_a_link_is_replaced_and_what_it_leads_to_stays(folder: Path, tmp_path: Path) -> None:
    other = tmp_path / "other.csv"
    other.write_bytes(b"other")
    (folder / "marks.csv").unlink()
    (folder / "marks.csv").symlink_to(other)
    written(folder)
    assert tree(folder) == NEW
    assert other.read_bytes() == b"other"


def test_a_link_that_cannot_be_replaced_is_a_link_again(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (folder / "marks.csv").unlink()
    (folder / "marks.csv").symlink_to(tmp_path / "nowhere")
    held_open(monkeypatch, folder / "key" / "1.pdf")
    with pytest.raises(FileError):
        written(folder)
    assert (folder / "marks.csv").readlink() == tmp_path / "nowhere"


def test_a_folder_that_leads_elsewhere_is_refused(folder: Path, tmp_path: Path) -> None:
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    (folder / "key").symlink_to(elsewhere)
    with pytest.raises(FileError, match=r"leads to .*elsewhere.*remove the link"):
        written(folder)
    assert not list(elsewhere.iterdir())
    assert (folder / "marks.csv").read_bytes() == b"old"


@pytest.mark.parametrize("plan", [FORWARD, BACK])
@pytest.mark.parametrize("name", ["../victim", "way/victim", "{top}/victim"])
def test_a_plan_that_leads_out_of_its_folder_is_not_followed(
    folder: Path, tmp_path: Path, plan: str, name: str
) -> None:
    """A folder may come from somebody else, with a plan in it."""
    victim = tmp_path / "victim"
    victim.write_bytes(b"mine")
    (folder / "way").symlink_to(tmp_path)
    hidden = folder / UNFINISHED
    hidden.mkdir()
    if plan == FORWARD:
        (hidden / "0.new").write_bytes(b"theirs")
    (hidden / plan).write_text(json.dumps({"files": [name.format(top=tmp_path)]}))
    with pytest.raises(FileError, match="leads to"):
        settle(folder)
    assert victim.read_bytes() == b"mine"


@pytest.mark.parametrize("data", [b"", b"{", b"\xff", b"[" * 100_000, b'{"files": 1}'])
def test_a_plan_that_cannot_be_read_is_named(folder: Path, data: bytes) -> None:
    hidden = folder / UNFINISHED
    hidden.mkdir()
    (hidden / FORWARD).write_bytes(data)
    with pytest.raises(FileError, match=r"forward\.json: an earlier run did not end"):
        settle(folder)


def test_a_folder_that_cannot_be_written_is_read_where_nothing_was_moved_yet(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """On a disk that can only be read, what had not begun is no matter; what had begun is."""
    hidden = folder / UNFINISHED
    hidden.mkdir()

    def read_only(*_given: object) -> None:
        raise OSError(errno.EROFS, "Read-only file system", str(folder))

    monkeypatch.setattr(commit, "locked", read_only)
    settle(folder)
    (hidden / FORWARD).write_text('{"files": ["marks.csv"]}')
    with pytest.raises(FileError, match="did not end, and read-only file system"):
        settle(folder)


def test_a_run_that_writes_at_this_moment_is_waited_for(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from graphkin.writers.commit import locked

    (folder / UNFINISHED).mkdir()
    looked = []

    def pause(_seconds: float) -> None:
        looked.append(len(looked))
        if len(looked) == 3:
            (folder / UNFINISHED).rmdir()

    monkeypatch.setattr(commit, "sleep", pause)
    with locked(folder):
        settle(folder)
    assert len(looked) == 3
    (folder / UNFINISHED).mkdir()
    monkeypatch.setattr(commit, "PATIENCE", -1.0)
    with locked(folder), pytest.raises(PageError, match="another run is writing here"):
        settle(folder)
