"""File names from arbitrary ids: plain letters only, all different, all inside the folder."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence, Set
from pathlib import Path

from graphkin.text.errors import PageError, Problem, joined, message
from graphkin.writers.files import RESERVED

LONGEST = 48
"""The most characters of an id in a file name."""
SHOWN = 3
"""The most files in the way that a message names."""
STRANGE = r"[^A-Za-z0-9_-]+"


def stems(ids: Sequence[str], codes: Sequence[str]) -> list[str]:
    """The beginning of each student's file names: the id if it is plain letters and digits.

    Other signs become ``_``. The student's opaque code is appended to such an id, to one that a
    system reserves for a device, and to ids that differ only in case. All stems are different,
    regardless of case, whatever the ids and codes.
    """
    plain = [re.sub(STRANGE, "_", text)[:LONGEST] for text in ids]
    times = Counter(name.lower() for name in plain)
    kept = [
        name == text and times[name.lower()] == 1 and is_fit(name)
        for text, name in zip(ids, plain, strict=True)
    ]
    taken = {name.lower() for name, keep in zip(plain, kept, strict=True) if keep}
    found: list[str] = []
    for name, keep, code in zip(plain, kept, codes, strict=True):
        tail = re.sub(STRANGE, "_", code).lower()
        found.append(name if keep else unused(f"{name.strip('_-') or 'id'}-{tail}", taken))
        taken.add(found[-1].lower())
    return found


def is_fit(name: str) -> bool:
    """Whether a plain name can be a file name: not empty, no device, no leading hyphen."""
    return bool(name) and name.upper() not in RESERVED and name[0] != "-"


def unused(name: str, taken: Set[str]) -> str:
    """The name, or the name with the lowest number that makes it unused."""
    tried, number = name, 1
    while tried.lower() in taken:
        number += 1
        tried = f"{name}-{number}"
    return tried


def inside(folder: Path, name: str) -> Path:
    """The path of a file in a folder. Raises PageError if links lead out of the folder."""
    path = folder / name
    whole = folder.resolve()
    if not path.resolve().is_relative_to(whole):
        found = message("leads to {folder}", folder=path.resolve())
        raise PageError(
            Problem(
                str(path),
                found,
                message("a file in {whole}", whole=whole),
                message("remove the link"),
            )
        )
    return path


def in_the_way(folder: Path, names: Sequence[str], unlike: Sequence[str] = ()) -> Problem:
    """The problem of existing files where others are to go; ``unlike`` says what differs."""
    there, more = joined(", ", names[:SHOWN]), len(names) - SHOWN
    if more > 0:
        there = message("{names} and {count} more", names=there, count=more)
    why = joined("; ", unlike) or message("made from other data or settings")
    found = message("{names}: there already, {why}", names=there, why=why)
    return Problem(str(folder), found, hint=message("--force replaces what is in the way"))
