"""The form fields that a drawing answers: lengths of vectors and places, in mm of paper.

Fields that depend on a point which a person has yet to decide are written as ?. ``grade`` counts
them neither as wrong nor as right.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

from msgspec import Struct

from graphkin.classroom.grading.answer_numbers import OPEN
from graphkin.classroom.grading.probes import Probe, probes
from graphkin.classroom.lab.lab_model import Item
from graphkin.classroom.printing.edition import Edition
from graphkin.classroom.printing.print_run import PrintOrder
from graphkin.classroom.roster.students import Taker
from graphkin.reading.lettered_points import LetteredSheet
from graphkin.reading.read_sheet import SheetRecord, sheets_of
from graphkin.reading.settled_points import (
    SettledPoints,
    Standing,
    latest_of,
    records_in,
    settled_points,
)
from graphkin.text.errors import GraphkinError, Refusals
from graphkin.text.tables import csv_text

ANSWERS = "answers.csv"
Places = Mapping[int, complex | None]
"""Where steps are on paper: None for a step that is not drawn; undecided steps are absent."""


class DrawnRow(Struct, frozen=True):
    """The answers read from a student's drawings: one cell per field, and the fields that follow.

    ``followed`` names the fields whose value follows correctly from an earlier mistake of the
    student.
    """

    who: str
    cells: tuple[str, ...]
    followed: tuple[str, ...]


def answers_table(opened: Edition, out: Path, refusals: Refusals) -> bytes:
    """The answers of all students whose sheets were read, as CSV in the order of the roster."""
    head = ["id", *(item.field for item in drawn_items(opened))]
    rows: list[list[object]] = [[row.who, *row.cells] for row in drawn_rows(opened, out, refusals)]
    return csv_text([head, *rows]).encode("utf-8")


def drawn_rows(opened: Edition, out: Path, refusals: Refusals) -> Iterator[DrawnRow]:
    """The current answers of each student whose sheets were read.

    A student whose answers cannot be computed gets ? in every field, and the reason goes to
    ``refusals``.
    """
    standing = SettledPoints(out).standing
    try:
        records = latest_of(records_in(out), standing)
    except GraphkinError:
        records = {}
    form = drawn_items(opened)
    for taker in opened.takers:
        own = {kind: record for (code, kind), record in records.items() if code == taker.code}
        if own:
            row = DrawnRow(taker.student.id, (OPEN,) * len(form), ())
            with refusals.alone(taker.student.called):
                row = drawn_row(opened, taker, own, standing, form)
            yield row


def drawn_row(
    opened: Edition,
    taker: Taker,
    own: Mapping[str, SheetRecord],
    standing: Standing,
    form: tuple[Item, ...],
) -> DrawnRow:
    """The current answers from one student's sheets, given by their kinds."""
    language = opened.words().language
    order = PrintOrder(opened.lab, opened.scene, language, "colour")
    sheets = sheets_of(order, taker, language)
    places: dict[int, tuple[str, complex | None]] = {}
    verdicts: dict[int, str] = {}
    for kind, page in sheets.task_pages.items():
        if kind in own:
            drawing = next(each for each in sheets.drawings if each.kind == kind)
            sheet = LetteredSheet(drawing, page)
            found = places_of(sheet, own[kind], standing)
            places |= {n: (kind, at) for n, at in found.items() if n not in places}
            settled = settled_points(own[kind], standing)
            verdicts = {point.step: point.verdict for point in settled} | verdicts
    probe_of = {probe.item.field: probe for probe in probes(sheets.mechanism.with_forces, form)}
    cells = tuple(cell(probe_of[item.field], places) for item in form)
    followed = [item.field for item in form if is_followed(probe_of[item.field], verdicts)]
    return DrawnRow(taker.student.id, cells, tuple(followed))


def is_followed(probe: Probe, verdicts: Mapping[int, str]) -> bool:
    """Whether the tip follows from the student's own points and the tail is not wrong."""
    tail, tip = (verdicts.get(step, "right") for step in (probe.steps[0], probe.steps[-1]))
    return tip == "follows" and tail in ("right", "follows")


def drawn_items(opened: Edition) -> tuple[Item, ...]:
    """The form fields that a drawing answers."""
    return tuple(item for item in opened.book.form if item.what in ("segment", "place"))


def places_of(sheet: LetteredSheet, record: SheetRecord, standing: Standing) -> Places:
    """Where the steps of a sheet are on paper: printed ones and those that are read and decided."""
    found: dict[int, complex | None] = {}
    steps = sheet.exact.program.steps
    for number, value in sheet.exact.trace.values.items():
        here = steps[number].plane is sheet.drawing.plane or number in sheet.on_mechanism
        if isinstance(value, complex) and not steps[number].args and here:
            found[number] = complex(sheet.place(number, value))
    for step, at in record.corners.items():
        found[step] = complex(*at)
    for point in settled_points(record, standing):
        if not point.ask:
            found[point.step] = None if point.at is None else complex(*point.at)
    values = sheet.exact.trace.values
    for tip, side in sheet.short.items():
        if side.tail in found:
            way = sheet.place(tip, values[tip]) - sheet.place(side.tail, values[side.tail])
            start = found[side.tail]
            found[tip] = None if start is None else start + complex(way)
    return found


def cell(probe: Probe, places: Mapping[int, tuple[str, complex | None]]) -> str:
    """The answer to a field: "" where it is not drawn, ? where it is not decided."""
    if any(step not in places for step in probe.steps):
        return OPEN
    (_, first), (_, last) = places[probe.steps[0]], places[probe.steps[-1]]
    if first is None or last is None:
        return ""
    way = last - first
    if probe.item.what == "place":
        return f"{-way.imag if probe.item.axis == 'y' else way.real:.2f}"
    return f"{abs(way):.2f}"
