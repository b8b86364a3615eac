"""Runs: the same bytes whoever does them and however often they were cut short."""

from __future__ import annotations

import errno
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from graphkin.classroom.printing import print_run as running
from graphkin.classroom.printing.edition import read_edition
from graphkin.classroom.printing.print_run import JOURNAL, Means, Outcome, PrintRequest, print_class
from graphkin.classroom.printing.print_run import make as make_sheets
from graphkin.text.errors import PLAIN_TRACEBACK, PageError
from graphkin.writers import commit
from graphkin.writers.commit import LOCK, locked
from tests.chosen import EVERY
from tests.classroom.printing.conftest import tree, write_class

ROOT = Path(__file__).resolve().parents[3]
IDS = [f"{i:04d}" for i in range(1, 9)]
USUAL = PrintRequest()
HOSTILE = ["../../x", "Ab", "aB", "ștefan"]


def printed(
    folder: Path, wishes: PrintRequest = USUAL, jobs: int = 1, cluster: str = ""
) -> Outcome:
    means = Means(jobs, cluster)
    return print_class(read_edition(folder), wishes, means, lambda done, total: None)


@pytest.fixture(scope="module")
def whole(tmp_path_factory) -> dict[str, bytes]:
    """What a run in one go gives, one process."""
    folder = write_class(tmp_path_factory.mktemp("whole") / "a", IDS)
    outcome = printed(folder)
    assert (outcome.made, outcome.stood, outcome.refused) == (8, 0, [])
    return tree(folder / "print")


def copied(whole: dict[str, bytes], tmp_path: Path) -> Path:
    """A class folder that was printed already."""
    folder = write_class(tmp_path / "copy", IDS)
    for name, data in whole.items():
        path = folder / "print" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)
    return folder


def test_a_lost_journal_is_no_loss(whole, tmp_path):
    folder = copied(whole, tmp_path)
    (folder / "print" / JOURNAL).unlink()
    (folder / "print" / "class-task.pdf").unlink()
    (folder / "print" / "class-key.pdf").unlink()
    printed(folder)
    assert tree(folder / "print") == whole


def test_a_fault_in_one_student_s_sheets_is_told_of_that_one(tmp_path, monkeypatch):
    """The others get the very files that they get without."""
    folders = [write_class(tmp_path / name, IDS[:3]) for name in "ab"]
    printed(folders[0])
    of = running.owner

    def owner(taker, *paper):
        if taker.student.id == IDS[1]:
            raise ZeroDivisionError("of a kind that nobody foresaw")
        return of(taker, *paper)

    monkeypatch.setattr(running, "owner", owner)
    monkeypatch.delenv(PLAIN_TRACEBACK, raising=False)
    ((taker, problems),) = printed(folders[1]).refused
    assert taker.student.id == IDS[1]
    assert "a fault in graphkin itself (ZeroDivisionError" in str(problems[0])
    all_files, files_left = (tree(folder / "print") for folder in folders)
    own = {name for name in files_left if "class-" not in name and name != JOURNAL}
    assert own == {name for name in all_files if f"/{IDS[0]}-" in name or f"/{IDS[2]}-" in name}
    assert all(files_left[name] == all_files[name] for name in own)


class Killed(BaseException):
    """The end of a process in the middle of its work."""


@pytest.mark.parametrize(("when", "how"), [(1, "half a file"), (1, "half")][: 2 if EVERY else 1])
def test_a_run_that_ends_at_any_moment_is_resumed_exactly(whole, make, monkeypatch, when, how):
    """Between the line in the journal and the files, within them, within one of them."""
    folder = make("cut", IDS)
    done = 0

    def dying(folder, targets):
        nonlocal done
        done += 1
        if done <= when:
            commit.put_in_place(folder, targets)
            return
        names = list(targets)
        if how == "half":
            names[0].parent.mkdir(exist_ok=True)
            names[0].write_bytes(targets[names[0]])
        elif how == "half a file":
            aside = folder / ".graphkin-99999999.part"
            aside.write_bytes(targets[names[0]][:100])
        raise Killed

    with monkeypatch.context() as patch:
        patch.setattr(running, "put_in_place", dying)
        with pytest.raises(Killed):
            printed(folder)
    outcome = printed(folder)
    assert outcome.stood == 2 * when  # a chunk of this class is two students
    assert tree(folder / "print") == whole


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGKILL there")
def test_kill_9_in_the_middle_and_the_next_run_ends_it(whole, make):
    folder = make("killed", IDS)
    command = [sys.executable, "-m", "graphkin", "print", str(folder), "--jobs", "2"]
    surroundings = {**os.environ, "PYTHONPATH": str(ROOT)}
    silent = subprocess.DEVNULL
    with subprocess.Popen(command, env=surroundings, stdout=silent, stderr=silent) as process:
        journal = folder / "print" / JOURNAL
        two_students = 2  # a chunk: its lines come before its files, the next chunk's after them
        until(
            lambda: (
                process.poll()
                or (journal.exists() and journal.read_bytes().count(b"\n") > two_students)
            )
        )
        assert process.poll() is None
        with pytest.raises(PageError, match=f"process {process.pid} on"):
            printed(folder)
        process.send_signal(signal.SIGKILL)
    cut = tree(folder / "print")
    assert not set(cut) >= set(whole)
    for name, data in cut.items():
        if not name.startswith("."):
            assert data == whole[name]
    outcome = printed(folder)
    assert f"process {process.pid} on" in outcome.left
    assert outcome.made < 8
    assert tree(folder / "print") == whole


def until(holds, seconds: float = 300.0) -> None:
    """Wait until something holds."""
    end = time.monotonic() + seconds
    while not holds():
        assert time.monotonic() < end
        time.sleep(0.01)


def test_workers_die_with_the_run_that_began_them(tmp_path):
    """They hold the pipe that they inherited; it closes when the last of them is gone."""
    program = """
import os, sys, time
from graphkin.classroom.printing.workers import processes
from time import sleep
if __name__ == "__main__":
    pool = processes(2)
    print(*[pool.submit(os.getpid).result() for _ in range(4)], flush=True)
    pool.submit(sleep, 600)
    time.sleep(600)
"""
    path = tmp_path / "parent.py"
    path.write_text(program, encoding="utf-8")
    surroundings = {**os.environ, "PYTHONPATH": str(ROOT)}
    command = [sys.executable, str(path)]
    with subprocess.Popen(command, env=surroundings, stdout=subprocess.PIPE) as process:
        assert process.stdout is not None
        assert process.stdout.readline().split()
        process.kill()
        assert process.stdout.read() == b""  # returns when no process has the pipe any more


def test_two_runs_into_one_folder_are_refused(make):
    folder = make("twice", ["1"])
    (folder / "print").mkdir()
    with locked(folder / "print"), pytest.raises(PageError, match="another run is writing here"):
        printed(folder)
    assert not [name for name in tree(folder / "print") if name != LOCK]
    assert printed(folder).made == 1


@pytest.mark.parametrize("when", [11, 24] if EVERY else [24])
def test_a_full_disk_is_told_and_nothing_is_half_written(whole, make, monkeypatch, when):
    """Whichever file it is that finds no room: of a student, or one for the printer."""
    folder = make("full", IDS)
    written, opened = 0, Path.open

    def with_little_room(path: Path, mode: str = "r", *args, **kwargs):
        nonlocal written
        stream = opened(path, mode, *args, **kwargs)
        if mode == "wb" and path.suffix in (".part", ".new"):
            written += 1
            if written > when:
                with stream:
                    stream.write(b"%PDF half a")
                raise OSError(errno.ENOSPC, "No space left on device", str(path))
        return stream

    with monkeypatch.context() as patch:
        patch.setattr(Path, "open", with_little_room)
        with pytest.raises(PageError, match=r"no space left on device.*same command"):
            printed(folder)
    left = tree(folder / "print")
    assert not [name for name in left if name.endswith((".part", ".new"))]
    for name, data in left.items():
        if not name.startswith("."):
            assert data == whole[name]
    outcome = printed(folder)
    assert outcome.stood == min(when // 6 * 2, 8)  # chunks of two students with three files each
    assert tree(folder / "print") == whole


def test_files_of_other_settings_are_not_replaced_without_force(whole, tmp_path):
    folder = copied(whole, tmp_path)
    for wishes in (PrintRequest(language="ro"), PrintRequest(ink="black")):
        with pytest.raises(PageError, match=r"0001-task\.pdf.* and 21 more.*--force"):
            printed(folder, wishes)
    assert tree(folder / "print") == whole
    assert printed(folder, PrintRequest(ink="black", force=True)).made == 8
    assert tree(folder / "print") != whole
    assert set(tree(folder / "print")) == set(whole)


@pytest.mark.parametrize("name", ["task/0001-task.pdf", "class-task.pdf"])
def test_a_file_of_somebody_else_is_not_replaced_without_force(make, name):
    folder = make("foreign", ["0001"])
    mine = folder / "print" / name
    mine.parent.mkdir(parents=True)
    mine.write_bytes(b"mine")
    with pytest.raises(PageError, match=mine.name):
        printed(folder)
    assert mine.read_bytes() == b"mine"
    printed(folder, PrintRequest(force=True))
    assert mine.read_bytes() != b"mine"


def test_a_forced_run_that_was_cut_short_goes_on_without_force(make, monkeypatch):
    """What it had begun to replace is known to be its own."""
    folder, wishes = make("forced", ["0001"]), PrintRequest(language="ro")
    printed(folder)

    def dying(_folder, _targets):
        raise Killed

    with monkeypatch.context() as patch:
        patch.setattr(running, "put_in_place", dying)
        with pytest.raises(Killed):
            printed(folder, PrintRequest(language="ro", force=True))
    assert printed(folder, wishes).made == 1
    assert printed(folder, wishes).stood == 1


def test_hostile_ids_write_nothing_outside(make, tmp_path):
    folder = make("inner/class", HOSTILE)
    before = set(tree(tmp_path))
    outcome = printed(folder)
    assert outcome.made == len(HOSTILE)
    new = set(tree(tmp_path)) - before
    assert all(name.startswith("inner/class/print/") for name in new)
    sheets = [Path(name).name for name in new if name.endswith("-task.pdf") and "/task/" in name]
    assert len({name.casefold() for name in sheets}) == len(HOSTILE)
    assert all(name.isascii() for name in new)


def test_a_student_whose_worker_dies_is_named_and_the_others_are_printed(make, monkeypatch):
    folder = make("dead", [str(i) for i in range(8)])
    monkeypatch.setattr(running, "make", dies)
    outcome = printed(folder, jobs=2)
    ((taker, problems),) = outcome.refused
    assert taker.student.id == "5"
    assert "the system ended the process" in str(problems[0])
    assert outcome.made == 7
    monkeypatch.undo()
    assert printed(folder).made == 1


def dies(order, wanted):
    """A worker that the system ends at one student."""
    if any(one.taker.student.id == "5" for one in wanted):
        os._exit(9)
    return make_sheets(order, wanted)


def test_a_cluster_gives_the_same_bytes(whole, make):
    import distributed

    folder = make("cluster", IDS)
    local = distributed.LocalCluster(
        n_workers=2, threads_per_worker=2, processes=False, protocol="tcp", dashboard_address=None
    )
    try:
        printed(folder, cluster=local.scheduler_address.replace("tcp://", "dask://"))
    finally:
        local.close()
    assert tree(folder / "print") == whole
