"""Whose held marks a lecturer has released: kept beside the report, until taken back."""

from __future__ import annotations

import json
from collections.abc import Collection, Sequence
from pathlib import Path

import msgspec
from msgspec import Struct

from graphkin.text.errors import Problem, SceneError

RELEASED = "released.json"
"""The file of a report folder that keeps the ids."""
MOST = 1 << 20
"""Bytes of it that are read."""


class Releases(Struct, frozen=True):
    """The ids of those whose marks are given, in the order of the class; ``earlier`` tells that
    some run before this one kept a list."""

    ids: tuple[str, ...] = ()
    earlier: bool = False

    def files(self) -> dict[str, bytes]:
        """The file that keeps them; none where nobody was ever released."""
        if not self.ids and not self.earlier:
            return {}
        return {RELEASED: (json.dumps(self.ids, ensure_ascii=False) + "\n").encode("utf-8")}


def releases(
    report: Path, students: Sequence[str], released: Collection[str], held: Collection[str]
) -> Releases:
    """Those released before and now, without those who are held again.

    Raises SceneError for a file that keeps no list of ids.
    """
    path = report / RELEASED
    earlier = path.is_file()
    every = {*(kept(path) if earlier else ()), *released}.difference(held)
    return Releases(tuple(who for who in students if who in every), earlier)


def kept(path: Path) -> list[str]:
    """The ids in a file."""
    try:
        with path.open("rb") as file:
            return msgspec.json.decode(file.read(MOST), type=list[str])
    except (OSError, msgspec.MsgspecError, UnicodeDecodeError, RecursionError):
        hint = "remove it, and release again whom you decide to"
        problem = Problem(str(path), "is no list of ids", '["0042", "0057"]', hint)
        raise SceneError(problem) from None
