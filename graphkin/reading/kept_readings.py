"""The folder of readings: a record and a flattened picture for each photograph."""

from __future__ import annotations

from pathlib import Path

import msgspec

from graphkin.reading.read_sheet import SheetRecord
from graphkin.scene.file_limits import whole_file
from graphkin.text.errors import PageError, Problem, message

READING, PICTURE = ".reading.json", ".jpg"
"""The file name endings of a record and of its picture."""


def kept(out: Path, name: str) -> SheetRecord | None:
    """The record of a photograph in a folder; None where it is absent or incomplete."""
    try:
        data = whole_file(out / f"{name}{READING}")
        return msgspec.json.decode(data, type=SheetRecord)
    except (OSError, msgspec.MsgspecError):
        return None


def records_in(out: Path) -> list[SheetRecord]:
    """All records of a folder, by name. Raises PageError where the folder holds none."""
    names = sorted(path.name.removesuffix(READING) for path in out.glob(f"*{READING}"))
    found = [record for name in names if (record := kept(out, name)) is not None]
    if not found:
        hint = message("graphkin read CLASS PHOTOS -o DIR makes it")
        raise PageError(
            Problem(
                str(out), message("holds no reading"), message("a folder of graphkin read"), hint
            )
        )
    return found
