"""The form fields that a hand wrote into the tables of a photographed sheet; each waits.

No digit is recognised: the desk shows the cut-out, and a person types what it says.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

from graphkin.classroom.grading.answer_numbers import OPEN
from graphkin.classroom.grading.answers import Answers, Unread
from graphkin.classroom.grading.graded import BLANK, HANDWRITTEN, Answer
from graphkin.classroom.lab.items import ARROW, asked_of, motion_of
from graphkin.classroom.lab.lab_model import Item
from graphkin.classroom.printing.edition import Edition
from graphkin.construction.core.quantities import FORCES, RATES, SLIDING, VECTORS
from graphkin.construction.result_tables import slide_name, turning_name
from graphkin.reading.settled_points import SettledPoints, latest_of, records_in
from graphkin.reading.written_cells import cut_out_name
from graphkin.scene.link_points import lettered

Cell = tuple[str, str, str, str]
"""A cell by the kind of its sheet, its table, the name of its row, and what it holds."""


def add_handwritten(opened: Edition, folder: Path, given: Answers) -> None:
    """Add a waiting answer, with its cut-out, where a field that earns points has no other."""
    records = latest_of(records_in(folder), SettledPoints(folder).standing)
    rubric = opened.book.lab.rubric
    for taker in opened.takers:
        form, worths = asked_of(opened.book.form, rubric.points, taker.compute)
        fields = fields_by_cell(item for item in form if item.field in worths)
        who = taker.student.id
        for record in (each for (code, _), each in records.items() if code == taker.code):
            own = given.of.setdefault(who, {})
            for number, cell in enumerate(record.written):
                item = fields.get((record.kind, cell.table, cell.name, cell.what))
                if item is not None and own.get(item.field, BLANK).is_blank:
                    own[item.field] = Answer(OPEN, problem=HANDWRITTEN)
                    where = record.file, cell.row, who, item.field, OPEN, HANDWRITTEN, item.unit
                    given.unread.append(Unread(*where, cut_out_name(record.name, number)))
    written = {cell.field for cell in given.unread}
    given.missing = [name for name in given.missing if name not in written]


def fields_by_cell(form: Iterable[Item]) -> Mapping[Cell, Item]:
    """The fields of a form that have a cell in a table of a sheet.

    A balancing moment has two cells there, for two routes, and is left out.
    """
    found: dict[Cell, Item] = {}
    for item in form:
        motion, row = motion_of(item), None
        if item.quantity == ARROW:
            row = "vectors", item.of
        elif motion in VECTORS:
            row = "vectors", f"{motion.letter}_{lettered(item.of)}"
        elif motion in RATES:
            row = "turns", turning_name(motion.letter, item.of)
        elif motion in SLIDING.values():
            row = "slides", slide_name(item.of)
        elif motion in FORCES and motion.sort == "vector":
            row = "sides", item.of
        if row is not None:
            found[motion.kind, *row, item.what] = item
    return found
