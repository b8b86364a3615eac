"""File names from ids that may be anything: plain letters only, no two alike, none outside."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence, Set
from pathlib import Path

from graphkin.text.errors import PageError, Problem
from graphkin.writers.files import RESERVED

LONGEST = 48
"""Characters of an id in a file name."""
SHOWN = 3
"""Files in the way that are named."""
STRANGE = r"[^A-Za-z0-9_-]+"


def stems(ids: Sequence[str], codes: Sequence[str]) -> list[str]:
    """The beginning of each student's file names: the id where it is plain letters and digits.

    What a file system may not like becomes _, and such an id, one that a system keeps for a
    device, and all that differ by case alone get the student's opaque code behind them. No two
    are the same, upper and lower case taken alike, whatever ids and codes there are.
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
    """Whether a file may bear a name of plain letters: not empty, no device, no option."""
    return bool(name) and name.upper() not in RESERVED and name[0] != "-"


def unused(name: str, taken: Set[str]) -> str:
    """The name, or with the first number behind it that no other name has."""
    tried, number = name, 1
    while tried.lower() in taken:
        number += 1
        tried = f"{name}-{number}"
    return tried


def inside(folder: Path, name: str) -> Path:
    """The path of a file in a folder. Raises PageError when links lead it out of the folder."""
    path = folder / name
    whole = folder.resolve()
    if not path.resolve().is_relative_to(whole):
        found = f"leads to {path.resolve()}"
        raise PageError(Problem(str(path), found, f"a file in {whole}", "remove the link"))
    return path


def in_the_way(folder: Path, names: Sequence[str], unlike: Sequence[str] = ()) -> Problem:
    """The problem of files that stand where others are to go; ``unlike`` says what differs."""
    more = f" and {len(names) - SHOWN} more" if len(names) > SHOWN else ""
    why = "; ".join(unlike) or "made from other data or settings"
    found = f"{', '.join(names[:SHOWN])}{more}: there already, {why}"
    return Problem(str(folder), found, hint="--force replaces what is in the way")
