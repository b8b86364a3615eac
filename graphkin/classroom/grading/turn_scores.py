"""Score sheets that students save from "your turn" on their pages: evidence beside answers.

A page says how it was drawn: which steps alone, with a hint or by the page, and after how many
wrong turns. It is sealed with the opaque code of the student's variant, so that a file which was
changed, or saved from another's page, is told. Whoever reads the page can make such a seal: the
sheets earn nothing and prove nothing.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from hashlib import sha256
from pathlib import Path
from typing import Annotated, Literal

import msgspec
from msgspec import Meta, Struct

from graphkin.classroom.grading.marks_tables import csv_bytes
from graphkin.scene.findings import visible
from graphkin.text.errors import Problem, RosterError

TURNS = "turns.csv"
"""The table of a report that lists them."""
ENDING = ".json"
SAVED_AS = "-turn"
"""What stands behind a student's id in the name of such a file."""
MOST = 1 << 20
"""Bytes of a file that are read."""
HEAD = ("id", "from_step", "steps", "alone", "hint", "drawn_by_page", "wrong", "left", "seal")

Count = Annotated[int, Meta(ge=0, le=100_000)]
How = Literal["alone", "hint", "help"]
Seal = Literal["right", "broken", "none"]


class TurnFile(Struct, forbid_unknown_fields=True, rename={"start": "from"}):
    """What a page saves: each step with how it was drawn and the wrong turns before it."""

    graphkin_turn: Literal[1]
    id: str
    start: Count
    steps: list[tuple[str, How, Count]]
    left: Count
    seal: str = ""


class TurnScore(Struct, frozen=True):
    """A student's score sheet; its ``seal`` is right, broken, or missing."""

    who: str
    file: str
    told: TurnFile
    seal: Seal

    def row(self) -> tuple[object, ...]:
        """Its line in the table."""
        how = [way for _, way, _ in self.told.steps]
        counts = (how.count(way) for way in ("alone", "hint", "help"))
        wrong = sum(turns for _, _, turns in self.told.steps)
        return (
            self.who,
            self.told.start,
            len(how),
            *counts,
            wrong,
            self.told.left,
            self.seal,
            self.file,
        )


def read_turns(path: Path, codes: Mapping[str, str]) -> list[TurnScore]:
    """The score sheets in a folder of answers; ``codes`` has the opaque code of each student by id.

    Raises RosterError for files that are none, or no student's of the class, all at once.
    """
    files = sorted(path.glob(f"*{ENDING}")) if path.is_dir() else []
    found: dict[str, TurnScore] = {}
    problems: list[Problem] = []
    for file in files:
        read = turn_file(file)
        who = "" if isinstance(read, Problem) else read.id or file.stem.removesuffix(SAVED_AS)
        if isinstance(read, Problem):
            problems.append(read)
        elif who not in codes:
            problems.append(Problem(file.name, f'"{visible(who)}" is no student of this class'))
        elif who in found:
            also = f'"{visible(who)}" has a score sheet already, in {found[who].file}'
            problems.append(Problem(file.name, also, "one"))
        else:
            found[who] = TurnScore(who, file.name, read, state_of(codes[who], read))
    if problems:
        raise RosterError(problems)
    return [found[who] for who in codes if who in found]


def turn_file(file: Path) -> TurnFile | Problem:
    """A score sheet, or why a file is none."""
    expected = "a score sheet as a page saves it"
    hint = "take the file out of the folder, or save it anew from the page"
    try:
        with file.open("rb") as opened:
            return msgspec.json.decode(opened.read(MOST), type=TurnFile)
    except (OSError, msgspec.MsgspecError, UnicodeDecodeError, RecursionError) as reason:
        return Problem(file.name, visible(str(reason)), expected, hint)


def seal_of(code: str, told: TurnFile) -> str:
    """The seal of a score sheet under a student's opaque code, as the page makes it."""
    content = [told.id, told.start, told.steps, told.left]
    text = json.dumps(content, ensure_ascii=False, separators=(",", ":"))
    return sha256(f"{code}\n{text}".encode("utf-8", "replace")).hexdigest()


def state_of(code: str, told: TurnFile) -> Seal:
    """Whether a score sheet has the seal that it is to have under a student's opaque code."""
    if not told.seal:
        return "none"
    return "right" if told.seal == seal_of(code, told) else "broken"


def turns_table(turns: Sequence[TurnScore]) -> bytes:
    """The table of the score sheets."""
    return csv_bytes([(*HEAD, "file"), *(turn.row() for turn in turns)])
