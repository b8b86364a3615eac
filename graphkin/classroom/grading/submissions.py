"""Files as a class hands them in: a table, a folder, or the ZIP file of a learning platform.

Moodle puts each student's files into a folder "Name_12345_assignsubmission_file" (before 4.1 with
another _ at its end), or begins the names of the files so; Canvas calls them
"name_12345_67890_answers.csv". The numbers are the platform's own: who it is the name tells, where
the file itself does not. Feedback goes back into Moodle under the very names that it gave.
"""

from __future__ import annotations

import io
import re
import zipfile
from collections.abc import Callable, Iterator, Mapping
from functools import partial
from pathlib import Path, PurePosixPath

from msgspec import Struct

from graphkin.classroom.roster.spreadsheets import LARGEST, bytes_of
from graphkin.scene.file_limits import file_bytes
from graphkin.text.errors import Problem, RosterError

KINDS = (".csv", ".txt", ".tsv", ".xlsx")
"""Files that are read."""
PACKED = ".zip"
MOST_BYTES, MOST_FILES = 512 << 20, 100_000
"""Bytes of a ZIP file, and files in it."""
MOST_OWN = 50
"""Tables of one student; all of them together are no larger than one table may be."""
MOODLE = re.compile(r"(?P<name>[^_]+)_(?P<number>\d+)_assignsubmission_[a-z]+(?:_(?P<file>.*))?")
CANVAS = re.compile(r"(?P<name>[^_]+)_(?:LATE_)?(?P<number>\d+)_\d+_(?P<file>.+)")
DATE = (1980, 1, 1, 0, 0, 0)
"""The time of a file in a ZIP file of ours: none, so that the same marks give the same bytes."""


class Sender(Struct, frozen=True):
    """Whose a learning platform says that a file is.

    ``name`` is the full name as the platform has it; ``back`` what the path of a feedback to it
    begins with, empty where the platform takes none.
    """

    name: str
    back: str = ""


class HandedIn(Struct, frozen=True):
    """A table that was handed in: its path within all that was, its size, and whose it is.

    ``read`` gives its bytes, and raises RosterError where there are none.
    """

    name: str
    size: int
    read: Callable[[], bytes]
    sender: Sender | None = None

    @property
    def stem(self) -> str:
        """The name of the file itself, which may be an id."""
        return PurePosixPath(self.name).stem


class Submissions(Struct, frozen=True):
    """Everything that was handed in; ``empty`` are senders without any table, ``others`` the names
    of other files without a sender, which are not read.

    ``is_one`` tells that it is a single table.
    """

    tables: tuple[HandedIn, ...]
    empty: tuple[Sender, ...] = ()
    others: tuple[str, ...] = ()
    is_one: bool = False


def submissions(path: Path) -> Submissions:
    """What stands at a path: a table, a folder with all that is below it, or a ZIP file.

    Raises RosterError where there is no table.
    """
    if path.is_dir():
        found = list(in_folder(path))
    elif path.suffix.lower() == PACKED:
        found = in_zip(path)
    else:
        data = bytes_of(path)
        return Submissions((HandedIn(path.name, len(data), lambda: data),), is_one=True)
    tables = tuple(each for each in found if is_table(PurePosixPath(each.name)))
    if not tables:
        what = "a folder" if path.is_dir() else "a ZIP file"
        raise RosterError(
            Problem(str(path), f"{what} without any table", f"files {', '.join(KINDS)}")
        )
    told = {each.sender.name for each in tables if each.sender is not None}
    every = [each.sender for each in found if each.sender is not None]
    empty = {each.name: each for each in every if each.name not in told}
    others = [each for each in found if each.sender is None and each not in tables]
    names = (PurePosixPath(each.name) for each in others)
    left = tuple(str(name) for name in names if not is_beside(name))
    return Submissions(tables, tuple(empty.values()), left)


def is_hidden(path: PurePosixPath) -> bool:
    """Whether a file is one that a system leaves beside others."""
    return any(part.startswith((".", "~", "__MACOSX")) for part in path.parts)


def is_table(path: PurePosixPath) -> bool:
    """Whether a file is a table to be read."""
    return path.suffix.lower() in KINDS and not is_hidden(path)


def is_beside(path: PurePosixPath) -> bool:
    """Whether a file that is no table needs no word: a hidden one, or a score sheet."""
    return is_hidden(path) or path.suffix.lower() == ".json"


def in_folder(folder: Path) -> Iterator[HandedIn]:
    """The files below a folder by their paths in it."""
    for path in sorted(p for p in folder.rglob("*") if p.is_file() or p.is_symlink()):
        name = path.relative_to(folder).as_posix()
        size = path.lstat().st_size
        yield HandedIn(name, size, partial(own_bytes, path, name), sender(name))


def own_bytes(path: Path, name: str) -> bytes:
    """The bytes of a file that is no link to another place. Raises RosterError."""
    if path.is_symlink():
        found, hint = "is a link to another place", "put the file itself there"
        raise RosterError(Problem(name, found, "a file of its own", hint))
    return bytes_of(path)


def in_zip(path: Path) -> list[HandedIn]:
    """The files of a ZIP file by their paths in it; nothing is unpacked onto the disk.

    Raises RosterError where it is none, or holds too much.
    """
    expected = f"at most {MOST_FILES} files, {MOST_BYTES >> 20} MiB"
    try:
        data = file_bytes(path, MOST_BYTES + 1)
        if len(data) > MOST_BYTES:
            raise RosterError(Problem(path.name, "is too large", expected))
        packed = zipfile.ZipFile(io.BytesIO(data))  # in memory: nothing is left open
        parts = [part for part in packed.infolist() if not part.is_dir()]
    except OSError as error:
        reason = error.strerror or "cannot be opened"
        raise RosterError(Problem(str(path), f"cannot be read: {reason}")) from None
    except (zipfile.BadZipFile, ValueError, RuntimeError, NotImplementedError, EOFError) as error:
        hint = "download it again, or unpack it and name the folder"
        raise RosterError(Problem(path.name, "cannot be read as a ZIP file", "", hint)) from error
    if len(parts) > MOST_FILES:
        raise RosterError(Problem(path.name, f"holds {len(parts)} files", expected))
    found = [
        HandedIn(
            part.filename, part.file_size, partial(unpacked, packed, part), sender(part.filename)
        )
        for part in parts
    ]
    return sorted(found, key=lambda each: each.name)


def unpacked(packed: zipfile.ZipFile, part: zipfile.ZipInfo) -> bytes:
    """The bytes of a file in a ZIP file. Raises RosterError where they cannot be had."""
    if part.file_size > LARGEST:
        raise RosterError(Problem(part.filename, "is too large", f"at most {LARGEST >> 20} MiB"))
    try:
        return packed.read(part)
    except Exception as error:
        hint = "is it encrypted or damaged? unpack it, or ask for it again"
        found = "cannot be unpacked from the ZIP file"
        raise RosterError(Problem(part.filename, found, "", hint)) from error


def sender(name: str) -> Sender | None:
    """Whose a file is by its path, as a learning platform writes it."""
    parts = PurePosixPath(name).parts
    for i, part in enumerate(parts):
        found = MOODLE.fullmatch(part)
        if found:
            is_file = i == len(parts) - 1
            back = part[: found.start("file")] if is_file and found["file"] else f"{part}/"
            return Sender(found["name"], back)
    found = CANVAS.fullmatch(parts[-1])
    return Sender(found["name"]) if found else None


def packed_feedback(backs: Mapping[str, str], pages: Mapping[str, bytes], kind: str) -> bytes:
    """Moodle's ZIP file of feedback: for each student with a name there the page of that kind.

    ``backs`` are the beginnings of the paths, ``pages`` the files, both by id.
    """
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as packed:
        for back, page in sorted((backs[who], page) for who, page in pages.items() if who in backs):
            packed.writestr(zipfile.ZipInfo(f"{back}feedback.{kind}", DATE), page)
    return data.getvalue()
