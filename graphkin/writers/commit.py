"""Several files put in place as one commit: all are new or all are old, whenever a run ends.

New files, and links to those that they replace, wait in a hidden folder. A plan in that folder
decides. Without a plan the next run discards the waiting files; with one it completes the commit.
If a file cannot be replaced, all others are restored.

One run at a time in a folder, by a lock that the system releases when its process ends.
"""

from __future__ import annotations

import json
import os
import re
import socket
import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from errno import ENOLCK, EOPNOTSUPP
from pathlib import Path
from shutil import copy2, rmtree
from time import monotonic, sleep, time
from typing import Any, BinaryIO

import msgspec
from msgspec import Struct

from graphkin.scene.file_limits import file_bytes, whole_file
from graphkin.scene.scene_files import UNFINISHED
from graphkin.text.errors import NO_WORDS, FileError, Message, PageError, Problem, message

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


PATIENCE = 10.0
"""Seconds to wait for another run that writes into the same folder."""
PAUSE = 0.05
"""Seconds between two checks whether a folder is free."""
FORWARD, BACK, DRAFT = "forward.json", "back.json", "draft.json"
"""The plans of a commit, of its reversal, and of an unfinished plan."""
ASIDE = re.compile(r"\.graphkin-([0-9]+)\.part")
"""A single temporary file, with its process."""
FEW = 8
"""The most files that are flushed one by one; more are flushed by one call, if available."""


class CommitPlan(Struct, frozen=True):
    """The files of a commit in order, those that replace a file, and the folders to be made.

    All names are relative to the folder of the commit. File number i waits as i.new; the file that
    it replaces is kept as i.old.
    """

    files: tuple[str, ...]
    replaced: frozenset[str] = frozenset()
    folders: tuple[str, ...] = ()


@contextmanager
def held(folder: Path, patience: float = 0.0) -> Iterator[str]:
    """Hold a folder, restored after interrupted runs, while files are written into it.

    Yields and raises as ``locked`` does; raises FileError where the folder cannot be restored.
    """
    with locked(folder, patience) as left:
        make_whole(folder)
        yield left


def settle(folder: str | os.PathLike[str]) -> None:
    """Restore a folder after an interrupted run, before anything in it is read.

    Waits for a run that is writing. Raises FileError where the folder cannot be restored, PageError
    where another run holds it for too long.
    """
    root, end = Path(folder), monotonic() + PATIENCE
    while (root / UNFINISHED).is_dir():
        try:
            with held(root):
                return
        except InUseError:
            if monotonic() > end:
                raise
            sleep(PAUSE)
        except OSError as error:
            if not planned(root / UNFINISHED):
                return  # nothing was moved yet, so the files are complete
            found = message("an earlier run did not end, and {error}", error=reason_of(error))
            raise FileError.at(str(root), found, message("a folder that can be written")) from error


def put_in_place(folder: Path, targets: Mapping[Path, bytes]) -> None:
    """Put files in place in a folder that this run holds, all of them or none.

    Raises FileError with the file that cannot be replaced, OSError where no file can be written.
    """
    if len(targets) == 1 and next(iter(targets)).parent == folder:
        for target, data in targets.items():
            with replacing(folder, target) as stream:
                stream.write(data)
        return
    hidden, plan = folder / UNFINISHED, plan_of(folder, list(targets))
    try:
        hidden.mkdir(exist_ok=True)
        for number, (name, data) in enumerate(zip(plan.files, targets.values(), strict=True)):
            (hidden / f"{number}.new").write_bytes(data)
            if name in plan.replaced:
                keep(folder / name, hidden / f"{number}.old")
        flush([hidden / f"{number}.new" for number in range(len(plan.files))])
        draft = hidden / DRAFT
        draft.write_bytes(msgspec.json.encode(plan))
        flush([draft])
        draft.replace(hidden / FORWARD)
    except BaseException:
        discard(hidden)
        raise
    finish(folder)


@contextmanager
def replacing(folder: Path, target: Path) -> Iterator[BinaryIO]:
    """A stream to a temporary file that replaces one file when complete.

    Raises FileError where the file cannot be replaced.
    """
    aside = folder / f".graphkin-{os.getpid()}.part"
    try:
        with aside.open("wb") as stream:
            yield stream
            stream.flush()
            os.fsync(stream.fileno())
        move(aside, target)
    except BaseException:
        with suppress(OSError):
            aside.unlink()
        raise


def plan_of(folder: Path, targets: Sequence[Path]) -> CommitPlan:
    """The plan for some targets. Raises FileError for a target outside the folder."""
    names = tuple(target.relative_to(folder).as_posix() for target in targets)
    inner = dict.fromkeys(way for target in targets for way in ways(folder, target))
    missing = tuple(way.relative_to(folder).as_posix() for way in inner if not way.exists())
    there = (name for name, target in zip(names, targets, strict=True) if os.path.lexists(target))
    return checked(folder, CommitPlan(names, frozenset(there), missing))


def ways(folder: Path, target: Path) -> Iterator[Path]:
    """The folders between a folder and a target in it, outermost first."""
    yield from reversed([way for way in target.parents if folder in way.parents])


def checked(folder: Path, plan: CommitPlan) -> CommitPlan:
    """A plan with all its files and folders in a folder. Raises FileError for any other."""
    whole = folder.resolve()
    for name in (*plan.files, *plan.folders):
        path = folder / name
        if ".." in path.parts or not path.parent.resolve().is_relative_to(whole):
            found, hint = (
                message("leads to {folder}", folder=path.parent.resolve()),
                message("remove the link"),
            )
            raise FileError.at(str(path), found, message("a file in {whole}", whole=whole), hint)
    return plan


def plan_in(folder: Path, name: str) -> CommitPlan:
    """The waiting plan in a folder. Raises FileError if it is unreadable."""
    path = folder / UNFINISHED / name
    try:
        return checked(folder, msgspec.json.decode(whole_file(path), type=CommitPlan))
    except (msgspec.MsgspecError, UnicodeDecodeError, RecursionError) as error:
        found, hint = (
            message("an earlier run did not end, and its plan is unreadable"),
            message("remove this file"),
        )
        raise FileError.at(str(path), found, hint=hint) from error


def planned(hidden: Path) -> bool:
    """Whether a plan is waiting to be completed or reversed."""
    return any((hidden / plan).is_file() for plan in (FORWARD, BACK))


def make_whole(folder: Path) -> None:
    """Complete or reverse the commit of an interrupted run; discard one that had no plan."""
    hidden = folder / UNFINISHED
    if hidden.is_symlink():
        hidden.unlink()
    elif (hidden / BACK).is_file():
        take_back(folder)
    elif (hidden / FORWARD).is_file():
        try:
            finish(folder)
        except FileError:
            if planned(hidden):
                raise
    elif hidden.is_dir():
        discard(hidden)
    for path in folder.glob(".graphkin-*.part"):
        found = ASIDE.fullmatch(path.name)
        if found and (int(found[1]) == os.getpid() or not alive(int(found[1]))):
            path.unlink(missing_ok=True)


def finish(folder: Path) -> None:
    """Move the waiting files of a folder into place, or restore everything after a failure.

    Raises FileError with the file that cannot be replaced.
    """
    hidden, plan = folder / UNFINISHED, plan_in(folder, FORWARD)
    try:
        for way in plan.folders:
            (folder / way).mkdir(exist_ok=True)
        for number, name in enumerate(plan.files):
            new = hidden / f"{number}.new"
            if new.exists():
                move(new, folder / name)
    except BaseException:
        (hidden / FORWARD).replace(hidden / BACK)
        take_back(folder)
        raise
    discard(hidden)


def take_back(folder: Path) -> None:
    """Restore everything that was moved in a folder. Raises FileError for a file that cannot be."""
    hidden, plan = folder / UNFINISHED, plan_in(folder, BACK)
    for number, name in enumerate(plan.files):
        target, old = folder / name, hidden / f"{number}.old"
        if (hidden / f"{number}.new").exists():
            continue  # the file was not moved
        if name not in plan.replaced:
            target.unlink(missing_ok=True)
        elif os.path.lexists(old):
            move(old, target, back=True)
    for way in reversed(plan.folders):
        with suppress(OSError):
            (folder / way).rmdir()
    (hidden / BACK).unlink()  # before the files it names, or it would count them as moved
    discard(hidden)


def move(source: Path, target: Path, *, back: bool = False) -> None:
    """Move a file into place. Raises FileError with its path where the system refuses."""
    try:
        source.replace(target)
    except OSError as error:
        expected, hint = NO_WORDS, NO_WORDS
        if isinstance(error, PermissionError):
            expected = message("a file that no other program has open")
            hint = message(
                "close it, perhaps in a spreadsheet or a viewer, and run the command again"
            )
        found = message(
            "cannot be put back: {error}" if back else "cannot be replaced: {error}",
            error=reason_of(error),
        )
        raise FileError.at(str(target), found, expected, hint) from error


def keep(target: Path, old: Path) -> None:
    """Keep a file under another name as well, by a link, or by a copy."""
    try:
        os.link(target, old, follow_symlinks=False)
    except (OSError, NotImplementedError):
        copy2(target, old, follow_symlinks=False)


def flush(paths: Sequence[Path]) -> None:
    """Flush files to the disk, so that a power failure leaves no plan without its files."""
    if len(paths) > FEW and hasattr(os, "sync"):
        os.sync()
        return
    for path in paths:
        with path.open("r+b") as stream:
            os.fsync(stream.fileno())


def discard(hidden: Path) -> None:
    """Remove the folder of waiting files."""
    rmtree(hidden, ignore_errors=True)


def reason_of(error: OSError) -> str:
    """The system's reason for a failure, as the end of a sentence."""
    reason = error.strerror or str(error)
    return f"{reason[:1].lower()}{reason[1:]}"


def cannot_write(folder: Path, error: OSError) -> PageError:
    """The error for a file or folder that the system does not allow to be written."""
    found = message("cannot be written: {error}", error=reason_of(error))
    return FileError.at(
        str(folder), found, message("a folder that can be written"), message("name one with -o")
    )
