"""The marked drawing for the student: the photograph in green and red, with remarks on points.

It is written as an HTML page and as a PDF with the same picture and the same remarks.
"""

from __future__ import annotations

import io
from base64 import b64encode
from cmath import phase
from collections.abc import Iterator, Sequence
from math import degrees
from pathlib import Path
from time import gmtime

from msgspec import Struct

from graphkin.classroom.grading.graded import DrawingRemark
from graphkin.classroom.printing.edition import Edition, stems
from graphkin.classroom.roster.students import Taker
from graphkin.construction.core.quantities import MOTION
from graphkin.drawing.field import A3, SheetPaper
from graphkin.drawing.richtext import font_file
from graphkin.reading.point_reading import PointReading
from graphkin.reading.read_sheet import SheetRecord
from graphkin.reading.settled_points import (
    PICTURE,
    SettledPoints,
    latest_of,
    records_in,
    settled_points,
)
from graphkin.text import Words
from graphkin.text.errors import Refusals
from graphkin.writers.templates import from_template

GREEN, RED, YELLOW, BLUE = "#087a2c", "#c21807", "#c77800", "#0b5cad"
COLOURS = {"right": GREEN, "follows": GREEN, "wrong": RED, "missing": YELLOW, "unread": YELLOW}
DENSITY = 5.0
"""Pixels per mm of the picture in a PDF."""
STILL = gmtime(315532800)
"""The fixed date of every PDF, so that the same readings give the same bytes."""
LINE, MARGIN = 34, 30
"""Height of a line of text and margin of a PDF page, in pixels."""


class MarkedSheet(Struct, frozen=True):
    """One drawing with its remarks; ``picture`` is a JPEG."""

    title: str
    picture: bytes
    points: tuple[PointReading, ...]
    lines: tuple[tuple[str, str], ...]
    """The remarks on the whole plan, on each point, and on other places, with their colours."""
    pins: tuple[DrawingRemark, ...] = ()
    paper: SheetPaper = A3


def drawings_of_class(
    opened: Edition, folder: Path, words: Words, kinds: Sequence[str], refusals: Refusals
) -> dict[str, bytes]:
    """The marked drawings of all students whose sheets were read, by file name."""
    settled = SettledPoints(folder)
    records = latest_of(records_in(folder), settled.standing)
    names = stems([t.student.id for t in opened.takers], [t.code for t in opened.takers])
    found: dict[str, bytes] = {}
    for taker, name in zip(opened.takers, names, strict=True):
        spoken = words.in_language(taker.spoken) if taker.spoken else words
        with refusals.alone(taker.student.called):
            own = [records[key] for kind in MOTION if (key := (taker.code, kind)) in records]
            sheets = [marked_sheet(folder, each, taker, settled, spoken) for each in own]
            if sheets and "html" in kinds:
                found[f"{name}-drawing.html"] = as_page(sheets, spoken)
            if sheets and "pdf" in kinds:
                found[f"{name}-drawing.pdf"] = as_pdf(sheets, spoken)
    return found


def marked_sheet(
    folder: Path, record: SheetRecord, taker: Taker, settled: SettledPoints, words: Words
) -> MarkedSheet:
    """One drawing of a student with its remarks."""
    standing = settled.standing
    points = settled_points(record, standing)
    here = [each for each in standing.values() if each.sheet == record.name]
    notes = {each.step: each.note for each in here if each.step is not None}
    who = taker.student.title
    head = words("marked.head", sheet=words(f"sheet.{record.kind}"), who=who)
    picture = (folder / f"{record.name}{PICTURE}").read_bytes()
    pins = tuple(remarks_on(record, settled))
    pinned = ((f"{each.number}. {each.text}", BLUE) for each in pins)
    causes = () if record.cause is None else record.cause.sentences(words)
    whole = ((cause, RED) for cause in causes)
    lines = (*whole, *said_of(points, notes, words), *pinned)
    return MarkedSheet(head, picture, points, lines, pins, record.on)


def remarks_on(record: SheetRecord, settled: SettledPoints) -> Iterator[DrawingRemark]:
    """The remarks pinned to a sheet, numbered in the order in which they were made."""
    for number, each in enumerate(settled.pins(record.name), 1):
        yield DrawingRemark(record.kind, number, each.at or (0.0, 0.0), each.note)


def pinned_remarks(folder: Path) -> dict[str, tuple[DrawingRemark, ...]]:
    """The remarks pinned to each student's drawings, by the code on the sheets."""
    settled = SettledPoints(folder)
    found: dict[str, tuple[DrawingRemark, ...]] = {}
    for (code, _), record in latest_of(records_in(folder), settled.standing).items():
        found[code] = (*found.get(code, ()), *remarks_on(record, settled))
    return found


def said_of(
    points: Sequence[PointReading], notes: dict[int, str], words: Words
) -> Iterator[tuple[str, str]]:
    """The remark on each point, and its colour."""
    for point in points:
        if point.verdict == "unread" and not point.ask:
            continue  # a point placed by hand that no mark depends on
        text = sentence(point, words)
        note = notes.get(point.step, "")
        yield f"{text}. {note}" if note else text, colour_of(point)


def colour_of(point: PointReading) -> str:
    """Green, red, or yellow for an undecided point; a point confirmed missing is red."""
    if point.ask:
        return YELLOW
    return RED if point.verdict == "missing" else COLOURS[point.verdict]


def sentence(point: PointReading, words: Words) -> str:
    """The remark on one point."""
    if point.ask or point.verdict == "unread":
        return words("marked.open", point=point.name)
    if point.at is None or point.verdict in ("missing", "right"):
        return words("marked.missing" if point.at is None else "marked.right", point=point.name)
    at, own, key = complex(*point.at), complex(*point.own), complex(*point.key)
    if point.verdict == "follows":
        return words("marked.follows", point=point.name, far=tenths(abs(at - key), words))
    text = words("marked.wrong", point=point.name, off=tenths(abs(at - own), words))
    if point.tail is None:
        return text
    tail = complex(*point.tail)
    if not abs(at - tail) or not abs(own - tail):
        return text
    turn = tenths(abs(degrees(phase((at - tail) / (own - tail)))), words)
    length = tenths(abs(abs(at - tail) - abs(own - tail)), words)
    return f"{text}: {words('marked.turned', tail=point.tail_name, turn=turn, length=length)}"


def tenths(value: float, words: Words) -> str:
    """A number to one decimal place, as the language writes it."""
    return words.decimal(f"{value:.1f}")


def as_page(sheets: Sequence[MarkedSheet], words: Words) -> bytes:
    """The drawings as one self-contained HTML page."""
    shown = [
        {
            "title": sheet.title,
            "size": [f"{side:g}" for side in (sheet.paper.width, sheet.paper.height)],
            "picture": b64encode(sheet.picture).decode("ascii"),
            "points": [(point, colour_of(point)) for point in sheet.points],
            "pins": sheet.pins,
            "lines": sheet.lines,
        }
        for sheet in sheets
    ]
    page = from_template(
        "reading/web/marked.html",
        language=words.language,
        title=words("marked.title"),
        pinned=BLUE,
        legend=words("marked.legend"),
        sheets=shown,
    )
    return f"{page}\n".encode()


def as_pdf(sheets: Sequence[MarkedSheet], words: Words) -> bytes:
    """The drawings as a PDF with one page each."""
    from PIL import Image, ImageDraw, ImageFont

    font = ImageFont.truetype(str(font_file(italic=False)), 22)
    pages = []
    for sheet in sheets:
        image = Image.open(io.BytesIO(sheet.picture)).convert("RGB")
        width, height = (round(sheet.paper.width * DENSITY), round(sheet.paper.height * DENSITY))
        rows = [(sheet.title, "#000000"), *sheet.lines, (words("marked.legend"), "#000000")]
        page = Image.new("RGB", (width, height + 2 * MARGIN + LINE * len(rows)), "white")
        page.paste(image.resize((width, height)), (0, 0))
        pen = ImageDraw.Draw(page)
        for point in sheet.points:
            if point.at is None:
                continue
            (x, y), colour = (part * DENSITY for part in point.at), colour_of(point)
            pen.ellipse((x - 12, y - 12, x + 12, y + 12), outline=colour, width=4)
            pen.text((x + 16, y - 34), point.name, fill=colour, font=font)
            if colour == RED:
                own = tuple(part * DENSITY for part in point.own)
                pen.line(((x, y), own), fill=colour, width=3)
        for pin in sheet.pins:
            x, y = (part * DENSITY for part in pin.at)
            pen.ellipse((x - 17, y - 17, x + 17, y + 17), fill="white", outline=BLUE, width=3)
            pen.text((x, y), str(pin.number), fill=BLUE, font=font, anchor="mm")
        for i, (text, colour) in enumerate(rows):
            pen.text((MARGIN, height + MARGIN + i * LINE), text, fill=colour, font=font)
        pages.append(page)
    out = io.BytesIO()
    pages[0].save(
        out, "PDF", save_all=True, append_images=pages[1:], resolution=DENSITY * 25.4, quality=80,
        title=sheets[0].title, creationDate=STILL, modDate=STILL,
    )  # fmt: skip
    return out.getvalue()
