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

from graphkin.classroom.printing.edition import Edition
from graphkin.classroom.printing.file_names import stems
from graphkin.classroom.roster.taker import Taker
from graphkin.construction.core.quantities import MOTION
from graphkin.drawing.richtext import font_file
from graphkin.reading.kept_readings import PICTURE, records_in
from graphkin.reading.point_reading import PointReading
from graphkin.reading.read_sheet import SheetRecord
from graphkin.reading.settled_points import SettledPoints, Standing, latest_of, settled_points
from graphkin.text import Words
from graphkin.text.errors import Refusals
from graphkin.writers.templates import from_template

GREEN, RED, YELLOW = "#087a2c", "#c21807", "#c77800"
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
    """The remarks on the whole plan and on each point, and their colours."""


def drawings_of_class(
    opened: Edition, folder: Path, words: Words, kinds: Sequence[str], refusals: Refusals
) -> dict[str, bytes]:
    """The marked drawings of all students whose sheets were read, by file name."""
    standing = SettledPoints(folder).standing
    records = latest_of(records_in(folder), standing)
    names = stems([t.student.id for t in opened.takers], [t.code for t in opened.takers])
    found: dict[str, bytes] = {}
    for taker, name in zip(opened.takers, names, strict=True):
        spoken = words.in_language(taker.spoken) if taker.spoken else words
        with refusals.alone(taker.student.called):
            own = [records[key] for kind in MOTION if (key := (taker.code, kind)) in records]
            sheets = [marked_sheet(folder, each, taker, standing, spoken) for each in own]
            if sheets and "html" in kinds:
                found[f"{name}-drawing.html"] = as_page(sheets, spoken)
            if sheets and "pdf" in kinds:
                found[f"{name}-drawing.pdf"] = as_pdf(sheets, spoken)
    return found


def marked_sheet(
    folder: Path, record: SheetRecord, taker: Taker, standing: Standing, words: Words
) -> MarkedSheet:
    """One drawing of a student with its remarks."""
    points = settled_points(record, standing)
    here = [each for each in standing.values() if each.sheet == record.name]
    notes = {each.step: each.note for each in here}
    who = taker.student.name or taker.student.id
    head = words("marked.head", sheet=words(f"sheet.{record.kind}"), who=who)
    picture = (folder / f"{record.name}{PICTURE}").read_bytes()
    causes = () if record.cause is None else record.cause.sentences(words)
    lines = [*((cause, RED) for cause in causes), *said_of(points, notes, words)]
    return MarkedSheet(head, picture, points, tuple(lines))


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
    told = words("marked.wrong", point=point.name, off=tenths(abs(at - own), words))
    if point.tail is None:
        return told
    tail = complex(*point.tail)
    if not abs(at - tail) or not abs(own - tail):
        return told
    turn = tenths(abs(degrees(phase((at - tail) / (own - tail)))), words)
    length = tenths(abs(abs(at - tail) - abs(own - tail)), words)
    return f"{told}: {words('marked.turned', tail=point.tail_name, turn=turn, length=length)}"


def tenths(value: float, words: Words) -> str:
    """A number to one decimal place, as the language writes it."""
    return words.decimal(f"{value:.1f}")


def as_page(sheets: Sequence[MarkedSheet], words: Words) -> bytes:
    """The drawings as one self-contained HTML page."""
    shown = [
        {
            "title": sheet.title,
            "picture": b64encode(sheet.picture).decode("ascii"),
            "points": [(point, colour_of(point)) for point in sheet.points],
            "lines": sheet.lines,
        }
        for sheet in sheets
    ]
    page = from_template(
        "reading/web/marked.html",
        language=words.language,
        title=words("marked.title"),
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
        width, height = round(420 * DENSITY), round(297 * DENSITY)
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
        for i, (text, colour) in enumerate(rows):
            pen.text((MARGIN, height + MARGIN + i * LINE), text, fill=colour, font=font)
        pages.append(page)
    out = io.BytesIO()
    pages[0].save(
        out, "PDF", save_all=True, append_images=pages[1:], resolution=DENSITY * 25.4, quality=80,
        title=sheets[0].title, creationDate=STILL, modDate=STILL,
    )  # fmt: skip
    return out.getvalue()
