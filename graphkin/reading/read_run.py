"""The reading of a class of photographs into a folder: resumable, on all cores, one run at a time.

For each photograph the folder holds NAME.jpg, the flattened sheet, and NAME.reading.json, the
record. NAME.cell-0.jpg and so on are the cells of the sheet's tables that hold handwriting. The
file answers.csv holds the form fields that follow from them, as ``grade`` reads them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from math import ceil
from pathlib import Path

import msgspec
from msgspec import Struct, field

from graphkin.classroom.printing.edition import Edition
from graphkin.classroom.printing.print_run import PrintOrder, key_of
from graphkin.classroom.printing.workers import ENDED, chunks, engine, results
from graphkin.reading.drawn_answers import ANSWERS, answers_table, drawn_items
from graphkin.reading.pictures import Photograph, hash_of_picture
from graphkin.reading.read_sheet import Grid, ReadOrder, SheetRead, SheetRecord, read_some
from graphkin.reading.settled_points import PICTURE, READING, kept
from graphkin.reading.written_cells import cut_out_name
from graphkin.text import as_text
from graphkin.text.errors import Refusals
from graphkin.text.tables import safe
from graphkin.writers.commit import held, put_in_place, settle

POINTS = ".points.json"
FORMAT = 1
"""The format of points.json."""
METHOD = 20
"""Version of the method.

Increase it when the same photograph would be read differently, so that older readings are redone.
"""
FEWEST = 3
"""The number of photographs that justifies another worker process."""
Tell = Callable[[int, int], None]


class ReadOutcome(Struct):
    """The outcome of a run: all records in the order of the photographs.

    ``stood`` counts the photographs that were already read. ``refusals`` are students whose answers
    cannot be computed from the records.
    """

    records: list[SheetRecord]
    stood: int = 0
    refusals: Refusals = field(default_factory=Refusals)


def read_order(opened: Edition, grid: Grid, *, by_hand: bool = False) -> ReadOrder:
    """The data that the readings of a class share."""
    order = PrintOrder(opened.lab, opened.scene, opened.words().language, "colour")
    takers = {each.code: each for each in opened.takers}
    return ReadOrder(order, takers, grid, by_hand, drawn_items(opened))


def read_class(
    opened: Edition,
    pictures: Sequence[Photograph],
    out: Path,
    order: ReadOrder,
    jobs: int,
    tell: Tell,
) -> ReadOutcome:
    """Read photographs of a class into a folder; unchanged readings there are kept."""
    out.mkdir(parents=True, exist_ok=True)
    refused = {
        each.name: SheetRecord(each.name, each.path.name, "", refused=each.refused)
        for each in pictures
        if each.refused
    }
    every, pictures = pictures, [each for each in pictures if not each.refused]
    with held(out):
        keys = {each.name: reading_key(order, each) for each in pictures}
        known = {
            each.name: record
            for each in pictures
            if (record := kept(out, each.name)) is not None and record.key == keys[each.name]
        }
        wanted = [(each, keys[each.name]) for each in pictures if each.name not in known]
        outcome = ReadOutcome([], len(known))
        done = len(known)
        tell(done, len(pictures))
        if wanted:
            with engine(min(jobs, ceil(len(wanted) / FEWEST))) as (executor, workers):
                work = partial(read_some, order)
                parts = chunks(wanted, workers, 4)
                for found in results(executor, workers, work, parts, lost_reading):
                    for one in found:
                        put(out, one)
                        known[one.record.name] = one.record
                    done += len(found)
                    tell(done, len(pictures))
        outcome.records = [(known | refused)[each.name] for each in every]
        write_answers(opened, out, outcome.refusals)
    return outcome


def reading_key(order: ReadOrder, picture: Photograph) -> str:
    """The key of a reading: a hash of the photograph, the students' data and the method."""
    students = {code: dict(each.settings) for code, each in order.takers.items()}
    marked = [each.field for each in order.marked] if order.by_hand else []
    how = msgspec.to_builtins(order.grid), order.by_hand, marked
    return key_of(METHOD, hash_of_picture(picture), students, order.order.scene, how)


def lost_reading(wanted: tuple[Photograph, str]) -> list[SheetRead]:
    """The record of a photograph whose worker process ends."""
    photograph, _ = wanted
    record = SheetRecord(photograph.name, photograph.path.name, "", refused=ENDED)
    return [SheetRead(record)]


def put(out: Path, one: SheetRead) -> None:
    """Write a record and its picture."""
    name = one.record.name
    files = {out / f"{name}{PICTURE}": one.picture} if one.picture else {}
    files |= {out / cut_out_name(name, number): cut for number, cut in enumerate(one.cells)}
    data = msgspec.json.format(msgspec.json.encode(one.record, enc_hook=as_text), indent=1)
    put_in_place(out, {**files, out / f"{name}{READING}": data + b"\n"})


def write_answers(opened: Edition, out: Path, refusals: Refusals) -> None:
    """Write the answers that follow from all that was read and decided."""
    settle(out)
    put_in_place(out, {out / ANSWERS: answers_table(opened, out, refusals)})


def points_file(record: SheetRecord) -> bytes:
    """A record as JSON for other programs."""
    points = [
        {
            "name": each.name,
            "step": each.step,
            "at": None if each.at is None else list(each.at),
            "verdict": each.verdict,
            "ask": each.ask,
        }
        for each in record.points
    ]
    found = {
        "format": FORMAT,
        "code": record.code,
        "refused": record.refused,
        "map": [list(pixel) for pixel in record.map],
        "points": points,
    }
    return msgspec.json.encode(found, enc_hook=as_text) + b"\n"


def said(opened: Edition, outcome: ReadOutcome) -> Iterator[str]:
    """The lines that the terminal prints for a run: one per photograph, then the totals."""
    names = {each.code: each.student for each in opened.takers}
    english = opened.words().in_language("en")
    yield from outcome.refusals.lines()
    for record in outcome.records:
        if record.refused is not None:
            yield f"{record.name}: refused: {record.refused}"
            continue
        who, asked = names[record.code], sum(point.ask for point in record.points)
        found = f"{len(record.points)} points, {asked or 'none'} to be looked at"
        yield f"{record.name}: {safe(who.id)} {who.name}, {record.kind}: {found}"
        if record.cause is not None:
            yield from (f"{record.name}: {each}" for each in record.cause.sentences(english))
    read = [record for record in outcome.records if record.refused is None]
    shown = dict[tuple[str, str], list[str]]()
    for record in read:
        shown.setdefault((record.code, record.kind), []).append(record.name)
    for several in (each for each in shown.values() if len(each) > 1):
        counts = "the one on which you decide counts, else that with the fewest questions"
        yield f"{', '.join(several)}: the same sheet; {counts}"
    asked = sum(point.ask for record in read for point in record.points)
    yield ""
    stood = f", {outcome.stood} stood already" if outcome.stood else ""
    sums = f"{len(read)} of {len(outcome.records)} photographs read{stood}"
    yield f"{sums}; {asked} points to be looked at"
