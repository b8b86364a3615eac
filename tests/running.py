"""Running the commands, in this process or in one of their own."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from graphkin.cli.main import app

ROOT = Path(__file__).resolve().parents[1]
Run = Callable[..., Result]


def ran(*args: object) -> Result:
    """Run a command in this process: ran("solve", "pump")."""
    return CliRunner().invoke(app, [str(arg) for arg in args])


@pytest.fixture
def run() -> Run:
    """The same, for a test."""
    return ran


def command(*args: str, **env: str) -> subprocess.CompletedProcess[bytes]:
    """Run the command line in a process of its own, its output as bytes."""
    return python("-m", "graphkin", *args, **env)


def python(*args: str, **env: str) -> subprocess.CompletedProcess[bytes]:
    """Run Python in a process of its own on this checkout."""
    surroundings = {**os.environ, "PYTHONPATH": str(ROOT), **env}
    return subprocess.run(
        [sys.executable, *args], env=surroundings, capture_output=True, check=False
    )


DIES = """
import os, signal, sys
from pathlib import Path
from tests.running import watched
def dying(number, path, opened):
    if number == int(sys.argv[1]):
        os.kill(os.getpid(), signal.SIGKILL)
from graphkin.cli.main import app
with watched(Path(sys.argv[2]), dying):
    app(sys.argv[3:])
"""


def killed_at(point: int, folder: Path, *args: object) -> None:
    """Run the command line in a process that is killed before it touches a folder once more."""
    found = python("-c", DIES, str(point), str(folder), *map(str, args))
    assert found.returncode == -signal.SIGKILL


Touched = Callable[[int, Path, bool], None]
"""Called before a folder is changed: the how manieth time, what is touched, whether it is opened
to be written."""
WRITES = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND
NAMED = {
    "os.rename": 2,
    "os.link": 2,
    "os.remove": 1,
    "os.mkdir": 1,
    "os.rmdir": 1,
    "os.truncate": 1,
    "os.symlink": 2,
}
"""Events of the interpreter that change files, and how many paths each begins with."""
watching: list[Callable[[str, tuple[Any, ...]], None]] = []
"""What hears of them now; the hook itself cannot be taken away again."""


def hear(event: str, given: tuple[Any, ...]) -> None:
    """The hook: nothing that is done while it is heard is heard itself."""
    if watching and (event == "open" or event in NAMED):
        (heard,) = watching
        watching.clear()
        try:
            heard(event, given)
        finally:
            watching.append(heard)


sys.addaudithook(hear)


@contextmanager
def watched(folder: Path, touched: Touched) -> Iterator[None]:
    """Call something before each time that a folder, or anything in it, is changed.

    What it raises, the change raises: OSError for a disk that is full.
    """
    count = 0

    def heard(event: str, given: tuple[Any, ...]) -> None:
        nonlocal count
        opened = event == "open"
        if opened and not (isinstance(given[2], int) and given[2] & WRITES):
            return
        names = given[: 1 if opened else NAMED[event]]
        named = [os.fsdecode(name) for name in names if not isinstance(name, int)]
        paths = [Path(name).absolute() for name in named]
        beside = event in ("os.remove", "os.rmdir") and given[1] != -1  # by a handle of its folder
        inside = [path for path in paths if beside or folder in (path, *path.parents)]
        if inside:
            count += 1
            touched(count, inside[-1], opened)

    watching.append(heard)
    try:
        yield
    finally:
        watching.clear()


Tree = dict[str, bytes | None]
"""What is in a folder: files with their bytes, folders with nothing."""
LOCKS = (".graphkin-lock", ".graphkin-holder")


def tree(folder: Path) -> Tree:
    """What is in a folder, but for the locks of a run that was killed."""
    return {
        path.relative_to(folder).as_posix(): path.read_bytes() if path.is_file() else None
        for path in sorted(folder.rglob("*"))
        if path.name not in LOCKS
    }


def planted(folder: Path, found: Tree) -> Path:
    """A folder that has only what is given."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for name, data in found.items():
        if data is None:
            (folder / name).mkdir(parents=True, exist_ok=True)
        else:
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_bytes(data)
    return folder


def states(folder: Path, work: Callable[[], object]) -> list[Tree]:
    """All that some work would leave in a folder if it were killed: before each change, and with
    half of each file that is written.
    """
    found: list[Tree] = []

    def look(_number: int, path: Path, opened: bool) -> None:
        found.append(tree(folder))
        if opened and path.name not in LOCKS and not path.is_dir():
            found.append(tree(folder) | {path.relative_to(folder).as_posix(): b"ha"})

    with watched(folder, look):
        work()
    return found
