"""The language of each student's sheets and feedback: a column of the class list."""

from __future__ import annotations

from pathlib import Path

from graphkin.classroom.roster.language_names import HEADS
from graphkin.classroom.roster.spreadsheets import columns, read_sheet
from graphkin.classroom.variants.manifest import TABLE


def languages(folder: Path) -> dict[str, str]:
    """What the table of a class folder says of each student's language, by id as it is written
    there; nothing where it has no such column, or where there is no table, which is needed for
    nothing else.

    Raises RosterError where the table cannot be read.
    """
    if not (folder / TABLE).exists():
        return {}
    sheet = read_sheet(folder / TABLE)
    where = columns(sheet, {"id": (), "language": HEADS})
    if len(where) < 2:
        return {}
    rows = ((row.cells[where["id"]], row.cells[where["language"]]) for row in sheet.rows)
    return {who: text for who, text in rows if text}
