"""One run at a time: a second is refused with who holds the folder; a dead one holds nothing."""

from __future__ import annotations

import errno
import os
import re
import signal
import subprocess
import sys
from pathlib import Path
from threading import Thread

import pytest

from graphkin.text.errors import PageError
from graphkin.writers.commit import HOLDER, LOCK, locked
from graphkin.writers.files import write_all

ROOT = Path(__file__).resolve().parents[2]
HOLD = """
import sys
from pathlib import Path
from graphkin.writers.commit import locked
with locked(Path(sys.argv[1])):
    print("held", flush=True)
    sys.stdin.read()
"""


@pytest.fixture
def holder(tmp_path):
    """Another process that holds the folder."""
    surroundings = {**os.environ, "PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-c", HOLD, str(tmp_path)]
    pipe = subprocess.PIPE
    with subprocess.Popen(command, env=surroundings, stdin=pipe, stdout=pipe) as process:
        assert process.stdout is not None
        assert process.stdout.readline().strip() == b"held"
        yield process
        process.kill()


def test_a_folder_that_another_process_holds_is_refused(tmp_path, holder):
    with pytest.raises(PageError) as refused, locked(tmp_path):
        pass
    words = str(refused.value)
    assert f"process {holder.pid} on " in words
    assert re.search(r"begun \d+ s ago", words)


def test_one_process_cannot_hold_a_folder_twice(tmp_path):
    with locked(tmp_path), pytest.raises(PageError, match=str(os.getpid())), locked(tmp_path):
        pass


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGKILL there")
def test_a_killed_process_holds_nothing_and_is_told(tmp_path, holder):
    holder.send_signal(signal.SIGKILL)
    holder.wait()
    assert (tmp_path / LOCK).exists()
    with locked(tmp_path) as left:
        assert f"process {holder.pid} on " in left
    with locked(tmp_path) as left:
        assert left == ""


@pytest.mark.parametrize("said", [b"\xff[1, 2", b"[" * 4096])
def test_a_lock_that_says_nothing_readable_is_taken(tmp_path, said):
    (tmp_path / HOLDER).write_bytes(said)
    with locked(tmp_path) as left:
        assert left == ""


def test_a_lock_that_is_waited_for_is_taken_when_it_is_free(tmp_path):
    """The second run comes while the first holds the folder, and goes on when that has ended."""
    order = []

    def second():
        with locked(tmp_path, patience=1000):
            order.append("second")

    waiting = Thread(target=second)
    with locked(tmp_path):
        waiting.start()
        order.append("first")
    waiting.join()
    assert order == ["first", "second"]
    assert not list(tmp_path.iterdir())


def test_a_folder_without_locks_is_written_all_the_same(tmp_path, monkeypatch):
    fcntl = pytest.importorskip("fcntl")

    def none(handle, what):
        raise OSError(errno.ENOLCK, "No locks available")

    monkeypatch.setattr(fcntl, "flock", none)
    with locked(tmp_path) as left:
        assert left == ""


@pytest.mark.skipif(not Path("/proc/self").exists(), reason="a folder in which nothing can be made")
def test_a_folder_that_cannot_be_written_is_no_folder_in_use():
    with pytest.raises(OSError), locked(Path("/proc")):
        pass
    with pytest.raises(PageError, match="cannot be written"):
        write_all(Path("/proc"), {"x": b""}, force=False)
