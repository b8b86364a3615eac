"""One run at a time in a folder: a lock that the system lets go when its process dies."""

from __future__ import annotations

import json
import os
import socket
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from errno import ENOLCK, ENOSYS, EOPNOTSUPP
from pathlib import Path
from time import monotonic, sleep, time
from typing import Any

from graphkin.text.errors import PageError, Problem

LOCK = ".graphkin-lock"
"""The file that is locked; it says who holds it."""
AGAIN = 0.05
"""Seconds until a lock that is waited for is tried again."""
LOCKLESS = (ENOLCK, ENOSYS, EOPNOTSUPP)
"""What file systems say that have no locks: their folders are written without."""
FAR = 1 << 30
"""Where the lock itself lies, in bytes: beyond the text, so that others can read that."""


@contextmanager
def locked(folder: Path, patience: float = 0.0) -> Iterator[str]:
    """Hold a folder while files are written into it; gives who left it without letting go.

    That is empty after a run that ended well. A process that was killed holds nothing: its lock
    is stale, and taken over. Raises PageError, with the process and its age, when another run
    holds the folder, and still does after ``patience`` seconds.
    """
    path = folder / LOCK
    handle = opened(path, monotonic() + patience)
    try:
        left = told(handle)
        sign = {"pid": os.getpid(), "host": socket.gethostname(), "since": int(time())}
        os.lseek(handle, 0, os.SEEK_SET)
        os.truncate(handle, 0)
        os.write(handle, json.dumps(sign).encode())
        yield holder(left) if left else ""
    finally:
        with suppress(OSError):  # Windows keeps an open file
            path.unlink()
        os.close(handle)


def opened(path: Path, until: float) -> int:
    """The lock file, locked by this process, and still the one that bears its name."""
    while True:
        handle = os.open(path, os.O_RDWR | os.O_CREAT, 0o644)
        try:
            if taken(handle):
                with suppress(OSError):
                    if os.path.samestat(os.fstat(handle), path.stat()):
                        return handle
            elif monotonic() < until:
                sleep(AGAIN)
            else:
                raise PageError(in_use(path, told(handle)))
        except BaseException:
            os.close(handle)
            raise
        os.close(handle)  # its last holder removed it just before we locked it, or holds it still


def taken(handle: int) -> bool:
    """Lock an open file for this process alone; False when another process has it."""
    try:
        if sys.platform == "win32":
            import msvcrt

            os.lseek(handle, FAR, os.SEEK_SET)
            msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)
        else:
            import fcntl

            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except (BlockingIOError, PermissionError):
        return False
    except OSError as error:
        if error.errno not in LOCKLESS:
            raise
    return True


def alive(process: int) -> bool:
    """Whether a process of this computer lives; where it cannot be asked, that it does not."""
    if sys.platform == "win32":  # os.kill would end it
        return False
    try:
        os.kill(process, 0)
    except (ProcessLookupError, OverflowError):
        return False
    except PermissionError:
        return True
    return True


def told(handle: int) -> dict[str, Any]:
    """What the lock file says of its holder; nothing where it is empty or cannot be read."""
    os.lseek(handle, 0, os.SEEK_SET)
    try:
        found = json.loads(os.read(handle, 4096) or b"{}")
    except (ValueError, RecursionError):
        return {}
    return found if isinstance(found, dict) else {}


def holder(sign: dict[str, Any]) -> str:
    """Words for who holds a lock: process, host and how long."""
    since = sign.get("since")
    age = max(int(time()) - since, 0) if isinstance(since, int) else 0
    return f"process {sign.get('pid', '?')} on {sign.get('host', '?')}, begun {ago(age)}"


def ago(seconds: int) -> str:
    """Words for an age: 40 s, 12 min or 3 h ago."""
    for unit, size in (("h", 3600), ("min", 60)):
        if seconds >= 2 * size:
            return f"{seconds // size} {unit} ago"
    return f"{seconds} s ago"


def in_use(path: Path, sign: dict[str, Any]) -> Problem:
    """The problem of a folder in which another run is writing."""
    found = f"another run is writing here: {holder(sign)}"
    return Problem(str(path.parent), found, "one run at a time", "wait for it, or end it")
