"""One run at a time in a folder, by a lock that the system releases when its process ends."""

from __future__ import annotations

import json
import os
import socket
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from errno import ENOLCK, EOPNOTSUPP
from pathlib import Path
from time import time
from typing import Any

from graphkin.scene.file_limits import file_bytes
from graphkin.text.errors import Message, PageError, Problem, message

LOCK = ".graphkin-lock"
"""The locked file."""
HOLDER = ".graphkin-holder"
"""The file that describes the holder of the lock."""
LOCKLESS = (ENOLCK, EOPNOTSUPP)
"""Error codes of file systems without locks; their folders are written without one."""


class InUseError(PageError):
    """Another run holds the folder."""


@contextmanager
def locked(folder: Path, patience: float = 0.0) -> Iterator[str]:
    """Hold a folder while files are written into it; yields the last holder if it was killed.

    The text is empty after a run that ended normally. A killed process holds nothing: its lock is
    stale and taken over. Raises InUseError, with the process and its age, if another run still
    holds the folder after ``patience`` seconds.
    """
    from filelock import FileLock, Timeout

    note, lock = folder / HOLDER, FileLock(folder / LOCK, timeout=patience)
    try:
        lock.acquire()
    except Timeout:
        refuse_unwritable(folder)  # filelock also waits where no file can be made, as in /proc
        raise InUseError(in_use(folder, note_of_holder(note))) from None
    except OSError as error:
        if error.errno not in LOCKLESS:
            raise
    try:
        left = note_of_holder(note)
        sign = {"pid": os.getpid(), "host": socket.gethostname(), "since": int(time())}
        note.write_text(json.dumps(sign), encoding="utf-8")
        yield holder(left) if left else ""
    finally:
        for path in (note, folder / LOCK):  # while held, so that a waiting run sees it
            with suppress(OSError):  # Windows keeps an open file
                path.unlink()
        lock.release()


def refuse_unwritable(folder: Path) -> None:
    """Raise OSError where no file can be made in a folder."""
    from tempfile import TemporaryFile

    with TemporaryFile(dir=folder):
        pass


def alive(process: int) -> bool:
    """Whether a process of this computer is running; False where that cannot be determined."""
    if sys.platform == "win32":  # os.kill would end it
        return False
    try:
        os.kill(process, 0)
    except (ProcessLookupError, OverflowError):
        return False
    except PermissionError:
        return True
    return True


def note_of_holder(note: Path) -> dict[str, Any]:
    """The written data of the holder; empty where they are missing or unreadable."""
    try:
        found = json.loads(file_bytes(note, 1 << 12))
    except (OSError, ValueError, RecursionError):
        return {}
    return found if isinstance(found, dict) else {}


def holder(sign: dict[str, Any]) -> Message:
    """Words for the holder of a lock: process, host and age."""
    since = sign.get("since")
    age = max(int(time()) - since, 0) if isinstance(since, int) else 0
    return message(
        "process {pid} on {host}, begun {age} ago",
        pid=sign.get("pid", "?"),
        host=sign.get("host", "?"),
        age=age_words(age),
    )


def age_words(seconds: int) -> str:
    """An age in a unit of its size: 40 s, 12 min or 3 h."""
    for unit, size in (("h", 3600), ("min", 60)):
        if seconds >= 2 * size:
            return f"{seconds // size} {unit}"
    return f"{seconds} s"


def in_use(folder: Path, sign: dict[str, Any]) -> Problem:
    """The problem of a folder in which another run is writing."""
    found = message("another run is writing here: {holder}", holder=holder(sign))
    return Problem(
        str(folder), found, message("one run at a time"), message("wait for it, or end it")
    )
