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
from typing import Any

from msgspec import Struct

from graphkin.classroom.grading.graded import DrawingRemark
from graphkin.classroom.printing.edition import Edition, stems
from graphkin.classroom.roster.students import Taker
from graphkin.construction.core.quantities import PLANES
from graphkin.drawing.field import A3, Rect, SheetPaper
from graphkin.drawing.marks import Text
from graphkin.drawing.richtext import extent, font_file, runs
from graphkin.drawing.symbol_markup import escape, symbol
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
from graphkin.writers.svg import text_element
from graphkin.writers.templates import from_template

GREEN, RED, YELLOW, BLUE = "#087a2c", "#c21807", "#c77800", "#0b5cad"
COLOURS = {"right": GREEN, "follows": GREEN, "wrong": RED, "missing": YELLOW, "unread": YELLOW}
DENSITY = 5.0
"""Pixels per mm of the picture in a PDF."""
STILL = gmtime(315532800)
"""The fixed date of every PDF, so that the same readings give the same bytes."""
LINE, MARGIN, SIZE = 34, 30, 3.0
"""Height of a line of text and margin of a PDF page, in pixels; height of its capitals, in mm."""
MOVED, SAME, DASH = 3.0, 1.0, 2.0
"""In mm: a cause moves a point by at least MOVED; a line ends at a point within SAME; a dash."""
ROOM, BESIDE, BARB, LETTER = 5.0, 3.0, 1.5, 4.0
"""In mm: from a frame's edge to the mark of a point outside it; from a mark to its label.

Then the length of an arrow's barbs, and the height of a label's capitals.
"""


PaperLine = tuple[float, float, float, float]
"""Both ends of a line in mm of paper."""


class MarkedSheet(Struct, frozen=True):
    """One drawing with its remarks; ``picture`` is a JPEG."""

    title: str
    picture: bytes
    points: tuple[PointReading, ...]
    lines: tuple[tuple[str, str], ...]
    """The remarks on the whole plan, on each point, and on other places, as markup with colours."""
    pins: tuple[DrawingRemark, ...] = ()
    paper: SheetPaper = A3
    expected: tuple[PaperLine, ...] = ()
    """Where the lines of a plan with a cause should be."""


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
            own = [records[key] for kind in PLANES if (key := (taker.code, kind)) in records]
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
    pinned = ((escape(f"{each.number}. {each.text}"), BLUE) for each in pins)
    expected = expected_lines(record, points)
    causes = [] if record.cause is None else [*record.cause.sentences(words)]
    whole = ((each, RED) for each in (*causes, *[words("marked.plan_expected")] * bool(expected)))
    lines = (*whole, *said_of(points, notes, words), *pinned)
    return MarkedSheet(head, picture, points, lines, pins, record.on, expected)


def expected_lines(record: SheetRecord, points: Sequence[PointReading]) -> tuple[PaperLine, ...]:
    """The key's lines to points that a cause of the whole plan moved; none without a cause."""
    if record.cause is None:
        return ()
    moved = [
        complex(*point.key)
        for point in points
        if point.at is not None and abs(complex(*point.at) - complex(*point.key)) > MOVED
    ]
    return tuple(
        line
        for line in record.key_lines
        if any(abs(complex(*end) - key) < SAME for end in (line[:2], line[2:]) for key in moved)
    )


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
        yield f"{text}. {escape(note)}" if note else text, colour_of(point)


def colour_of(point: PointReading) -> str:
    """Green, red, or yellow for an undecided point; a point confirmed missing is red."""
    if point.ask:
        return YELLOW
    return RED if point.verdict == "missing" else COLOURS[point.verdict]


def sentence(point: PointReading, words: Words) -> str:
    """The remark on one point, as markup."""
    name = symbol(point.name, signs=words.signs)
    if point.ask or point.verdict == "unread":
        return words("marked.open", point=name)
    if point.at is None or point.verdict in ("missing", "right"):
        return words("marked.missing" if point.at is None else "marked.right", point=name)
    at, own, key = complex(*point.at), complex(*point.own), complex(*point.key)
    if point.verdict == "follows":
        return words("marked.follows", point=name, far=tenths(abs(at - key), words))
    text = words("marked.wrong", point=name, off=tenths(abs(at - own), words))
    if point.tail is None:
        return text
    tail = complex(*point.tail)
    if not abs(at - tail) or not abs(own - tail):
        return text
    turn = tenths(abs(degrees(phase((at - tail) / (own - tail)))), words)
    length = tenths(abs(abs(at - tail) - abs(own - tail)), words)
    seen_from = symbol(point.tail_name, signs=words.signs)
    return f"{text}: {words('marked.turned', tail=seen_from, turn=turn, length=length)}"


def tenths(value: float, words: Words) -> str:
    """A number to one decimal place, as the language writes it."""
    return words.decimal(f"{value:.1f}")


class PointMark(Struct, frozen=True):
    """The mark of a point in a frame: its place, its label, and what joins it to other places.

    A point outside the frame is marked at the frame's edge, with an arrow that points there.
    """

    at: tuple[float, float]
    colour: str
    label: Text
    lines: tuple[PaperLine, ...]
    """A line to where a wrong point should be, and the lines of the arrow."""


def point_mark(point: PointReading, frame: Rect, words: Words) -> PointMark:
    """The mark of a point that has a place, in a frame (mm)."""
    left, top, right, low = frame
    place = complex(*point.at or point.own)
    there = complex(
        min(max(place.real, left + ROOM), right - ROOM),
        min(max(place.imag, top + ROOM), low - ROOM),
    )
    lines, colour = [], colour_of(point)
    if colour == RED:
        lines.append((there, complex(*point.own)))
    if place != there:
        way = (place - there) / abs(place - there)
        tip = there + ROOM * way
        lines += [(there, tip), *((tip, tip - BARB * way * turn) for turn in (1 + 0.4j, 1 - 0.4j))]
    name = symbol(point.name, signs=words.signs)
    width, upper, _ = extent(name, LETTER)
    x = there.real + BESIDE if there.real + BESIDE + width < right else there.real - BESIDE - width
    y = there.imag - BESIDE if there.imag - BESIDE + upper > top else there.imag + BESIDE - upper
    ends = tuple((p.real, p.imag, q.real, q.imag) for p, q in lines)
    return PointMark((there.real, there.imag), colour, Text(x, y, name, "label", LETTER), ends)


def as_page(sheets: Sequence[MarkedSheet], words: Words) -> bytes:
    """The drawings as one self-contained HTML page."""
    from markupsafe import Markup

    shown = [
        {
            "title": sheet.title,
            "size": [f"{side:g}" for side in (sheet.paper.width, sheet.paper.height)],
            "picture": b64encode(sheet.picture).decode("ascii"),
            "marks": [(mark, Markup(text_element(mark.label))) for mark in marks_on(sheet, words)],
            "expected": sheet.expected,
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
        wrong=RED,
        legend=words("marked.legend"),
        sheets=shown,
    )
    return f"{page}\n".encode()


def marks_on(sheet: MarkedSheet, words: Words) -> Iterator[PointMark]:
    """The marks of a sheet's points."""
    frame = 0.0, 0.0, sheet.paper.width, sheet.paper.height
    yield from (point_mark(each, frame, words) for each in sheet.points if each.at is not None)


def typeset(pen: Any, text: Text, colour: str) -> None:
    """Write a marked-up text on a picture."""
    from PIL import ImageFont

    for run in runs(text.markup, text.height):
        font = ImageFont.truetype(str(font_file(italic=run.italic)), run.size * DENSITY)
        place = (text.x + text.left() + run.x) * DENSITY, (text.y + run.y) * DENSITY
        pen.text(place, run.text, fill=colour, font=font, anchor="ls")


def dashes(line: PaperLine) -> Iterator[PaperLine]:
    """The pieces of a dashed line."""
    start, end = complex(*line[:2]), complex(*line[2:])
    long = abs(end - start)
    for i in range(int(long / (2 * DASH)) + 1):
        first, last = (start + (end - start) * min((2 * i + k) * DASH / long, 1) for k in (0, 1))
        yield first.real, first.imag, last.real, last.imag


def as_pdf(sheets: Sequence[MarkedSheet], words: Words) -> bytes:
    """The drawings as a PDF with one page each."""
    from PIL import Image, ImageDraw, ImageFont

    font = ImageFont.truetype(str(font_file(italic=False)), 22)
    pages = []
    for sheet in sheets:
        image = Image.open(io.BytesIO(sheet.picture)).convert("RGB")
        width, height = (round(sheet.paper.width * DENSITY), round(sheet.paper.height * DENSITY))
        legend = escape(words("marked.legend"))
        rows = [(escape(sheet.title), "#000000"), *sheet.lines, (legend, "#000000")]
        page = Image.new("RGB", (width, height + 2 * MARGIN + LINE * len(rows)), "white")
        page.paste(image.resize((width, height)), (0, 0))
        pen = ImageDraw.Draw(page)
        for x1, y1, x2, y2 in (piece for line in sheet.expected for piece in dashes(line)):
            pen.line([part * DENSITY for part in (x1, y1, x2, y2)], fill=RED, width=2)
        for mark in marks_on(sheet, words):
            x, y = (part * DENSITY for part in mark.at)
            pen.ellipse((x - 12, y - 12, x + 12, y + 12), outline=mark.colour, width=4)
            typeset(pen, mark.label, mark.colour)
            for line in mark.lines:
                pen.line([part * DENSITY for part in line], fill=mark.colour, width=3)
        for pin in sheet.pins:
            x, y = (part * DENSITY for part in pin.at)
            pen.ellipse((x - 17, y - 17, x + 17, y + 17), fill="white", outline=BLUE, width=3)
            pen.text((x, y), str(pin.number), fill=BLUE, font=font, anchor="mm")
        for i, (text, colour) in enumerate(rows):
            base = height + MARGIN + i * LINE + SIZE * DENSITY
            typeset(pen, Text(MARGIN / DENSITY, base / DENSITY, text, "remark", SIZE), colour)
        pages.append(page)
    out = io.BytesIO()
    pages[0].save(
        out, "PDF", save_all=True, append_images=pages[1:], resolution=DENSITY * 25.4, quality=80,
        title=sheets[0].title, creationDate=STILL, modDate=STILL,
    )  # fmt: skip
    return out.getvalue()
