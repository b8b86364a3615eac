"""Files written completely or not at all: checked, written to temporary files, then moved."""

from __future__ import annotations

import os
import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from unicodedata import normalize
from zlib import crc32

from graphkin.drawing.marks import Page
from graphkin.drawing.style import Ink
from graphkin.text.errors import FileError, Problem, joined, message
from graphkin.writers.commit import PATIENCE, cannot_write, held, put_in_place, settle

RESERVED = frozenset(
    ["CON", "PRN", "AUX", "NUL"] + [f"{port}{i}" for port in ("COM", "LPT") for i in range(10)]
)
"""Names that Windows reserves for devices, with any extension."""
LONGEST = 60
"""Characters of one part of a file name."""
MOST_BYTES = 180
"""Bytes of the first part of a file name; the rest must fit within 255."""
SHOWN = 3
"""Existing files that are named in an error."""
PDF_ONLY = "calculation"
"""The sheet that is written only as PDF, because it is several pages of text."""


def file_part(text: str) -> str:
    """A name or value as part of a file name, its accents composed; unsafe characters become _."""
    part = re.sub(r"[^\w.+-]+", "_", normalize("NFC", text)).strip("._")[:LONGEST].rstrip(".")
    return f"_{part}" if part.partition(".")[0].upper() in RESERVED else part or "_"


def file_stem(name: str, settings: Mapping[str, str]) -> str:
    """The name of a scene, then its settings: pump-n7."""
    stem = "-".join([file_part(name), *(file_part(f"{k}{v}") for k, v in settings.items())])
    whole = stem.encode("utf-8")
    if len(whole) <= MOST_BYTES:
        return stem
    return f"{whole[: MOST_BYTES - 9].decode('utf-8', 'ignore')}-{crc32(whole):08x}"


def rendered(
    stem: str,
    kind: str,
    pages: Sequence[Page],
    formats: Collection[str],
    ink: Ink = "colour",
    *,
    steps: bool = False,
) -> dict[str, bytes]:
    """The files of one sheet by name: an SVG, a DXF and a TikZ picture for each page, one PDF.

    The pages of a sheet with ``steps`` are numbered; otherwise the first page is the sheet itself.
    """
    files: dict[str, bytes] = {}
    if "svg" in formats and kind != PDF_ONLY:
        from graphkin.writers.svg import write_svg

        for number, page in enumerate(pages, 1):
            tail = f"-{number}" if steps or number > 1 else ""
            files[f"{stem}{tail}.svg"] = write_svg(page, ink).encode("utf-8")
    if "tikz" in formats and kind != PDF_ONLY:
        from graphkin.writers.latex import write_tikz

        for number, page in enumerate(pages, 1):
            tail = f"-{number}" if steps or number > 1 else ""
            files[f"{stem}{tail}.tex"] = write_tikz(page, ink).encode("utf-8")
    if "dxf" in formats and kind != PDF_ONLY:
        from graphkin.writers.dxf import write_dxf

        for number, page in enumerate(pages, 1):
            tail = f"-{number}" if steps or number > 1 else ""
            files[f"{stem}{tail}.dxf"] = write_dxf(page, ink)
    if "pdf" in formats:
        from graphkin.writers.pdf import write_pdf

        files[f"{stem}.pdf"] = write_pdf(pages, ink, title=pages[0].title)
    return files


def write_all(folder: Path, files: Mapping[str, bytes], force: bool) -> list[Path]:
    """Write all files into a folder, made if missing, or none of them. Raises PageError.

    Existing files are replaced only with ``force``. A full disk, a file that cannot be replaced and
    a read-only folder leave everything unchanged. The next run completes or reverses an interrupted
    one. Runs that write into one folder wait for each other.
    """
    targets = {folder / name: data for name, data in files.items()}
    try:
        settle(folder)
        refuse_existing(folder, list(targets), force)
        folder.mkdir(parents=True, exist_ok=True)
        with held(folder, patience=PATIENCE):
            refuse_existing(folder, list(targets), force)
            put_in_place(folder, targets)
    except OSError as error:
        raise cannot_write(folder, error) from error
    return list(targets)


def refuse_existing(folder: Path, targets: list[Path], force: bool) -> None:
    """Raise PageError with every existing target."""
    if folder.exists() and not folder.is_dir():
        hint = message("name another folder with -o")
        raise FileError.at(str(folder), message("is a file"), message("a folder"), hint)
    folders = [target for target in targets if target.is_dir()]
    devices = [t for t in targets if t.exists() and not t.is_file() and t not in folders]
    others = (*folders, *devices)
    there = [t for t in targets if not force and os.path.lexists(t) and t not in others]
    problems = [in_the_way(there)] if there else []
    problems += [
        Problem(str(t), message("is no ordinary file"), message("a place for a file"))
        for t in devices
    ]
    problems += [
        Problem(str(t), message("is a folder"), message("a place for a file")) for t in folders
    ]
    if problems:
        raise FileError(problems)


def write_apart(target: Path, data: bytes, source: str | Path, force: bool = False) -> Path:
    """Write one file that was made from another, never over its source, and return it.

    Raises FileError for a target that is the source, and as ``write_all`` does.
    """
    same = False
    with suppress(OSError, ValueError):  # the source is a link, or does not exist
        same = target.samefile(source)
    if same:
        hint = message("name another file with -o")
        found = message("is the file that is read")
        raise FileError.at(str(target), found, message("another file"), hint)
    return write_all(target.parent, {target.name: data}, force)[0]


def refuse_folder(folder: Path, names: Iterable[str] = (), *, force: bool = False) -> None:
    """Raise PageError, before any work, where no file can be written into a folder.

    The check writes an anonymous file into the folder, or into the folder that will contain it.
    Files of ``names`` that exist are reported as by ``refuse_existing``.
    """
    from tempfile import TemporaryFile

    settle(folder)
    refuse_existing(folder, [folder / name for name in names], force)
    try:
        there = next(path for path in (folder, *folder.parents) if path.exists())
        with TemporaryFile(dir=there):
            pass
    except OSError as error:
        raise cannot_write(folder, error) from error


def in_the_way(there: Sequence[Path]) -> Problem:
    """The problem of existing files: all of them in one line, the first by name."""
    if len(there) == 1:
        hint = message("--force replaces it, -o names another folder")
        return Problem(str(there[0]), message("exists already"), message("a new file"), hint)
    names, more = joined(", ", map(str, there[:SHOWN])), len(there) - SHOWN
    if more > 0:
        names = message("{names} and {count} more", names=names, count=more)
    hint = message("--force replaces them, -o names another folder")
    return Problem(names, message("each exists already"), message("new files"), hint)
