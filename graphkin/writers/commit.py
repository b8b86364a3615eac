"""Files put in their places, several as one: all are new or all as before, whenever a run ends.

New files, and links to those that they replace, wait in a hidden folder. A plan in it decides:
without a plan the next run discards what waits, with one it finishes the work. A file that cannot
be replaced takes all others back.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from shutil import copy2, rmtree
from time import monotonic, sleep
from typing import BinaryIO

import msgspec
from msgspec import Struct

from graphkin.scene.file_limits import whole_file
from graphkin.scene.scene_files import UNFINISHED
from graphkin.text.errors import FileError, PageError, Problem
from graphkin.writers.lock import InUseError, alive, locked

PATIENCE = 10.0
"""Seconds to wait for another run that writes into the same folder."""
PAUSE = 0.05
"""Seconds between two looks whether a folder is free."""
FORWARD, BACK, DRAFT = "forward.json", "back.json", "draft.json"
"""The plan of files that go to their places, of files that are put back, and one that is begun."""
ASIDE = re.compile(r"\.graphkin-([0-9]+)\.part")
"""A single file that is written aside, with its process."""
FEW = 8
"""Files that are flushed one by one; more are flushed by one call, where the system has it."""


class CommitPlan(Struct, frozen=True):
    """The files of a commit in order, those of them that replace one, and the folders to be made.

    All are named from the folder of the commit. File number i waits as i.new, what it replaces as
    i.old.
    """

    files: tuple[str, ...]
    replaced: frozenset[str] = frozenset()
    folders: tuple[str, ...] = ()


@contextmanager
def held(folder: Path, patience: float = 0.0) -> Iterator[str]:
    """Hold a folder, whole again after runs that were killed, while files are put into it.

    Gives and raises what ``locked`` does; raises FileError where it cannot be made whole.
    """
    with locked(folder, patience) as left:
        make_whole(folder)
        yield left


def settle(folder: str | os.PathLike[str]) -> None:
    """Make a folder whole again in which a run was killed, before anything in it is read.

    A run that writes at this moment is waited for. Raises FileError where the folder cannot be
    made whole, PageError where another run holds it for too long.
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
                return  # nothing was moved yet: what stands there is whole
            found = f"an earlier run did not end, and {reason_of(error)}"
            raise FileError(Problem(str(root), found, "a folder that can be written")) from error


def put_in_place(folder: Path, targets: Mapping[Path, bytes]) -> None:
    """Put files in their places in a folder that this run holds, all of them or none.

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
    """A stream aside in a folder; when all is written it takes the place of one file.

    Raises FileError where that cannot be replaced.
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
    """The plan for some targets. Raises FileError for one that lies out of the folder."""
    names = tuple(target.relative_to(folder).as_posix() for target in targets)
    inner = dict.fromkeys(way for target in targets for way in ways(folder, target))
    missing = tuple(way.relative_to(folder).as_posix() for way in inner if not way.exists())
    there = (name for name, target in zip(names, targets, strict=True) if os.path.lexists(target))
    return checked(folder, CommitPlan(names, frozenset(there), missing))


def ways(folder: Path, target: Path) -> Iterator[Path]:
    """The folders between a folder and a target in it, the outer ones first."""
    yield from reversed([way for way in target.parents if folder in way.parents])


def checked(folder: Path, plan: CommitPlan) -> CommitPlan:
    """A plan whose files and folders all lie in a folder. Raises FileError for any other."""
    whole = folder.resolve()
    for name in (*plan.files, *plan.folders):
        path = folder / name
        if ".." in path.parts or not path.parent.resolve().is_relative_to(whole):
            found, hint = f"leads to {path.parent.resolve()}", "remove the link"
            raise FileError(Problem(str(path), found, f"a file in {whole}", hint))
    return plan


def plan_in(folder: Path, name: str) -> CommitPlan:
    """The plan that waits in a folder. Raises FileError for one that cannot be read."""
    path = folder / UNFINISHED / name
    try:
        return checked(folder, msgspec.json.decode(whole_file(path), type=CommitPlan))
    except (msgspec.MsgspecError, UnicodeDecodeError, RecursionError) as error:
        found, hint = "an earlier run did not end, and its plan is unreadable", "remove this file"
        raise FileError(Problem(str(path), found, hint=hint)) from error


def planned(hidden: Path) -> bool:
    """Whether a plan waits to be finished or taken back."""
    return any((hidden / plan).is_file() for plan in (FORWARD, BACK))


def make_whole(folder: Path) -> None:
    """Finish what a run that was killed had decided, or take it back; discard what it had not."""
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
    """Move what waits in a folder to its places; after a failure all is as it was before.

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
    """Put everything back that was moved in a folder. Raises FileError for a file that stays."""
    hidden, plan = folder / UNFINISHED, plan_in(folder, BACK)
    for number, name in enumerate(plan.files):
        target, old = folder / name, hidden / f"{number}.old"
        if (hidden / f"{number}.new").exists():
            continue  # it was not moved
        if name not in plan.replaced:
            target.unlink(missing_ok=True)
        elif os.path.lexists(old):
            move(old, target, "cannot be put back")
    for way in reversed(plan.folders):
        with suppress(OSError):
            (folder / way).rmdir()
    (hidden / BACK).unlink()  # before what it names: it would take that for moved
    discard(hidden)


def move(source: Path, target: Path, failed: str = "cannot be replaced") -> None:
    """Move a file to its place. Raises FileError with that place where the system refuses."""
    try:
        source.replace(target)
    except OSError as error:
        expected, hint = "", ""
        if isinstance(error, PermissionError):
            expected = "a file that no other program has open"
            hint = "close it, perhaps in a spreadsheet or a viewer, and run the command again"
        found = f"{failed}: {reason_of(error)}"
        raise FileError(Problem(str(target), found, expected, hint)) from error


def keep(target: Path, old: Path) -> None:
    """Keep a file under another name as well: by a link, or a copy where there are no links."""
    try:
        os.link(target, old, follow_symlinks=False)
    except (OSError, NotImplementedError):
        copy2(target, old, follow_symlinks=False)


def flush(paths: Sequence[Path]) -> None:
    """Have files written to the disk, so that a loss of power leaves no plan without its files."""
    if len(paths) > FEW and hasattr(os, "sync"):
        os.sync()
        return
    for path in paths:
        with path.open("r+b") as stream:
            os.fsync(stream.fileno())


def discard(hidden: Path) -> None:
    """Remove the folder in which files waited."""
    rmtree(hidden, ignore_errors=True)


def reason_of(error: OSError) -> str:
    """What the system says of a failure, as the end of a sentence."""
    reason = error.strerror or str(error)
    return f"{reason[:1].lower()}{reason[1:]}"


def cannot_write(folder: Path, error: OSError) -> PageError:
    """The error for a file or folder that the system does not let us write."""
    found = f"cannot be written: {reason_of(error)}"
    return FileError(
        Problem(str(folder), found, "a folder that can be written", "name one with -o")
    )
