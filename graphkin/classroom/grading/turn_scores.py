"""Score sheets that students save from "your turn" on their pages, as further evidence.

A page says how each step was drawn: alone, with a hint or by the page, and after how many wrong
turns. The sheet is sealed with the opaque code of the student's variant. The seal shows that a file
was changed, or saved from another student's page. Anyone who reads the page can make such a seal:
the sheets earn nothing and prove nothing.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from hashlib import sha256
from pathlib import Path
from typing import Annotated, Literal

import msgspec
from msgspec import Meta, Struct

from graphkin.classroom.grading.grading_files import csv_bytes
from graphkin.scene.findings import visible
from graphkin.text.errors import Problem, Refusals, RosterError, message, verbatim

TURNS = "turns.csv"
"""The table of a report that lists score sheets."""
ENDING = ".json"
SAVED_AS = "-turn"
"""The text after a student's id in the name of a score sheet."""
MOST = 1 << 20
"""The most bytes of a file that are read."""
HEAD = ("id", "from_step", "steps", "alone", "hint", "drawn_by_page", "wrong", "left", "seal")

Count = Annotated[int, Meta(ge=0, le=100_000)]
How = Literal["alone", "hint", "help"]
Seal = Literal["right", "broken", "none"]


class TurnFile(Struct, forbid_unknown_fields=True, rename={"start": "from"}):
    """The file that a page saves: each step, how it was drawn, and the wrong turns before it."""

    graphkin_turn: Literal[1]
    id: str
    start: Count
    steps: list[tuple[str, How, Count]]
    left: Count
    seal: str = ""


class TurnScore(Struct, frozen=True):
    """A student's score sheet; its ``seal`` is right, broken or none."""

    who: str
    file: str
    sheet: TurnFile
    seal: Seal

    def row(self) -> tuple[object, ...]:
        """The row of the table."""
        how = [way for _, way, _ in self.sheet.steps]
        counts = (how.count(way) for way in ("alone", "hint", "help"))
        wrong = sum(turns for _, _, turns in self.sheet.steps)
        return (
            self.who,
            self.sheet.start,
            len(how),
            *counts,
            wrong,
            self.sheet.left,
            self.seal,
            self.file,
        )


def read_turns(path: Path, codes: Mapping[str, str], refusals: Refusals) -> list[TurnScore]:
    """The score sheets in a folder of answers; ``codes`` maps ids to opaque codes.

    Files that are no score sheets, or of no student in the class, are noted in ``refusals``. Of
    several sheets of one student, the only one with a right seal counts; otherwise none does.
    """
    files = sorted(path.glob(f"*{ENDING}")) if path.is_dir() else []
    found: dict[str, list[TurnScore]] = {}
    for file in files:
        with refusals.alone(file.name):
            read = turn_file(file)
            who = read.id or file.stem.removesuffix(SAVED_AS)
            if who not in codes:
                said = message('"{sign}" is no student of this class', sign=visible(who))
                raise RosterError.at(file.name, said)
            score = TurnScore(who, file.name, read, state_of(codes[who], read))
            found.setdefault(who, []).append(score)
    kept = [each for who in codes for each in only(found.get(who, ()))]
    for who, every in found.items():
        for each in every[1:] if len(every) > 1 else ():
            also = message(
                '"{who}" has a score sheet already, in {file}', who=visible(who), file=every[0].file
            )
            refusals.add(each.file, [Problem(each.file, also, message("one"))])
    return kept


def only(every: Sequence[TurnScore]) -> Sequence[TurnScore]:
    """The score sheet of a student that counts, if there is one."""
    right = [each for each in every if each.seal == "right"]
    counts = every if len(every) == 1 else right
    return counts if len(counts) == 1 else ()


def turn_file(file: Path) -> TurnFile:
    """Read a score sheet. Raises RosterError for any other file."""
    expected = message("a score sheet as a page saves it")
    hint = message("take the file out of the folder, or save it anew from the page")
    try:
        with file.open("rb") as opened:
            return msgspec.json.decode(opened.read(MOST), type=TurnFile)
    except (OSError, msgspec.MsgspecError, UnicodeDecodeError, RecursionError) as reason:
        raise RosterError.at(file.name, verbatim(visible(str(reason))), expected, hint) from None


def seal_of(code: str, sheet: TurnFile) -> str:
    """The seal of a score sheet for a student's opaque code, as the page makes it."""
    content = [sheet.id, sheet.start, sheet.steps, sheet.left]
    text = json.dumps(content, ensure_ascii=False, separators=(",", ":"))
    return sha256(f"{code}\n{text}".encode("utf-8", "replace")).hexdigest()


def state_of(code: str, sheet: TurnFile) -> Seal:
    """Whether the seal of a score sheet is right for a student's opaque code."""
    if not sheet.seal:
        return "none"
    return "right" if sheet.seal == seal_of(code, sheet) else "broken"


def turns_table(turns: Sequence[TurnScore]) -> bytes:
    return csv_bytes([(*HEAD, "file"), *(turn.row() for turn in turns)])
