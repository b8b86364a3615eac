"""The parts that all sheets share: a standard's frame and title block, check bar, A4 page."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import lru_cache
from itertools import pairwise
from math import floor

from msgspec import Struct, field
from msgspec.structs import replace

from graphkin.drawing.field import (
    A3,
    A4_AREA,
    A4_FRAME,
    A4_PAGE,
    GOST,
    ISO,
    Rect,
    SheetFrame,
    SheetPaper,
    TextPage,
)
from graphkin.drawing.marks import LineMark, Mark, Page, Text, box, moved
from graphkin.drawing.richtext import extent, flowed, plain, words_of
from graphkin.drawing.symbol_markup import escape
from graphkin.text.errors import PageError, message

BAND, FIELD = 5.0, 50.0  # grid border's width, field length
LETTERS = "ABCDEFGHJKLM"  # without I and O
LEADING, CLOSER = 1.55, 1.5  # line spacing in heights of capitals, and that of a header
CLOSE = 3.0  # distance of two lines at the head of an A4 page, in mm
LABEL, UNDER = 3.4, 1.7  # a cell's baselines: label below the top, value above the bottom
DESCENT = 0.45  # the same of large values, in their heights: p and g stay clear of the line
HEIGHTS = (7.0, 5.0, 3.5, 2.5, 1.8)  # ISO 3098


class TitleBlock(Struct, frozen=True):
    """The data fields of ISO 7200 in plain text; only ``scale`` is markup.

    ``labels`` maps names of fields to labels; a field without a label shows only its value, and an
    empty value leaves its cell free for handwriting. A block with a label for ``student`` has that
    cell where other blocks have the creator's. ``size`` is the letter of an ANSI paper.
    ``logo`` is the width over the height of a picture in the legal owner's cell, 0 without one.
    """

    legal_owner: str = ""
    title: str = ""
    creator: str = ""
    student: str = ""
    approved_by: str = ""
    document_type: str = ""
    identification: str = ""
    date_of_issue: str = ""
    sheet: str = ""
    language: str = ""
    scale: str = ""
    revision: str = ""
    labels: Mapping[str, str] = field(default_factory=dict)
    logo: float = 0.0
    frame: SheetFrame = ISO
    size: str = ""

    @property
    def is_headed(self) -> bool:
        """Whether the legal owner's cell holds a school's header, which needs no label."""
        return bool(self.logo) or "\n" in self.legal_owner


# field name, cell (left, top, right, bottom) in the block, largest height of the value
CELLS: tuple[tuple[str, Rect, float], ...] = (
    ("title", (0, 0, 120, 15.3), 5.0),
    ("creator", (120, 0, 180, 15.3), 3.5),
    ("legal_owner", (0, 15.3, 66, 26), 3.5),
    ("document_type", (66, 15.3, 135, 26), 2.5),
    ("approved_by", (135, 15.3, 180, 26), 3.5),
    ("scale", (0, 26, 42, 36), 3.5),
    ("identification", (42, 26, 93, 36), 3.5),
    ("revision", (93, 26, 105, 36), 3.5),
    ("date_of_issue", (105, 26, 138, 36), 3.5),
    ("language", (138, 26, 150, 36), 3.5),
    ("sheet", (150, 26, 180, 36), 3.5),
)
OWNER = "legal_owner"
STEP = " · "
"""The sign between the number of a sheet and that of a step on it."""
BESIDE = 1.0
"""Distance of a logo and of a header from the edges of their cell, in mm."""
STUDENT = "student"
"""The name of the field for the student's name."""
STUDENTS: tuple[tuple[str, Rect, float], ...] = (
    CELLS[0],
    (STUDENT, *CELLS[1][1:]),
    CELLS[2],
    ("document_type", (66, 15.3, 108, 26), 2.5),
    ("creator", (108, 15.3, 144, 26), 3.5),
    ("approved_by", (144, 15.3, 180, 26), 3.5),
    *CELLS[5:],
)
"""The cells of a student's sheet, where the student's cell takes the place of the creator's."""


HEADED = {OWNER: (0.0, 93.0), "document_type": (93.0, 146.0), "approved_by": (146.0, 180.0)}
"""The sides of cells beside the wider cell of a school's header."""
CROWDED = {
    OWNER: (0.0, 98.0),
    "document_type": (98.0, 136.0),
    "creator": (136.0, 158.0),
    "approved_by": (158.0, 180.0),
}
"""The same on a student's sheet that has an author."""


def cells_of(block: TitleBlock) -> tuple[tuple[str, Rect, float], ...]:
    """The cells of a block; a student's block has a creator's cell only if there is an author."""
    if block.frame is not ISO:
        return OTHERS[block.frame.name](block)
    found, across = CELLS, HEADED
    if STUDENT in block.labels:
        found = STUDENTS if block.creator else (CELLS[0], STUDENTS[1], *CELLS[2:])
        across = CROWDED if block.creator else HEADED
    if not block.is_headed:
        return found
    return tuple(
        (name, (across[name][0], rect[1], across[name][1], rect[3]) if name in across else rect, h)
        for name, rect, h in found
    )


SIGNED = 55.0
"""The right end of a student's cell in form 1, which has the room of the signature, in mm."""


def gost_cells(block: TitleBlock) -> tuple[tuple[str, Rect, float], ...]:
    """The cells of GOST 2.104, form 1. The student, or else the author, has the first row."""
    first = STUDENT if STUDENT in block.labels else "creator"
    second = (("creator", (17.0, 30.0, 40.0, 35.0), 2.5),) if first == STUDENT else ()
    return (
        ("identification", (65.0, 0.0, 185.0, 15.0), 7.0),
        ("title", (65.0, 15.0, 135.0, 40.0), 5.0),
        ("document_type", (65.0, 40.0, 135.0, 55.0), 3.5),
        (OWNER, (135.0, 40.0, 185.0, 55.0), 3.5),
        ("scale", (167.0, 20.0, 185.0, 35.0), 3.5),
        ("sheet", (135.0, 35.0, 185.0, 40.0), 2.5),
        (first, (17.0, 25.0, SIGNED if first == STUDENT else 40.0, 30.0), 2.5),
        *second,
        ("approved_by", (17.0, 50.0, 40.0, 55.0), 2.5),
        ("date_of_issue", (SIGNED if first == STUDENT else 40.0, 25.0, 65.0, 30.0), 2.5),
    )


def asme_cells(block: TitleBlock) -> tuple[tuple[str, Rect, float], ...]:
    """The cells of a title block of ASME Y14.1 for sizes B and C, in mm."""
    first = STUDENT if STUDENT in block.labels else "creator"
    second = block.creator and first == STUDENT
    return (
        (OWNER, (0.0, 0.0, 92.0, 14.0), 3.5),
        (first, (92.0, 0.0, 158.75, 14.0), 3.5),
        ("title", (0.0, 14.0, 92.0, 27.5), 5.0),
        *((("creator", (92.0, 14.0, 125.0, 27.5), 3.5),) if second else ()),
        ("approved_by", (125.0 if second else 92.0, 14.0, 158.75, 27.5), 3.5),
        ("size", (0.0, 27.5, 15.0, 39.0), 5.0),
        ("identification", (15.0, 27.5, 92.0, 39.0), 3.5),
        ("revision", (92.0, 27.5, 104.0, 39.0), 3.5),
        ("date_of_issue", (104.0, 27.5, 142.0, 39.0), 3.5),
        ("language", (142.0, 27.5, 158.75, 39.0), 3.5),
        ("scale", (0.0, 39.0, 42.0, 50.8), 3.5),
        ("document_type", (42.0, 39.0, 112.0, 50.8), 3.5),
        ("sheet", (112.0, 39.0, 158.75, 50.8), 3.5),
    )


OTHERS = {GOST.name: gost_cells, "ASME": asme_cells}
"""The cells of the other standards' title blocks."""


@lru_cache(maxsize=8)
def border(paper: SheetPaper) -> tuple[Mark, ...]:
    """Draw the frame of a page with its centring marks, fields and designation."""
    (frame,), standard = paper.areas, paper.frame
    right, bottom = frame[2:]
    size, small = (
        Text(right - 1, bottom + 4.2, paper.name, "field", 3.5, "end", "size"),
        tuple[Mark, ...](),
    )
    if standard is ISO:
        small = fields(paper)
    elif standard is not GOST:
        small = tuple(zones(paper))
        size = replace(size, y=(bottom + paper.height) / 2 + 1.75)
    return (*small, edged(frame, "frame"), *centring_marks(paper), size)


def sheet_frame(title_block: TitleBlock, paper: SheetPaper = A3) -> tuple[Mark, ...]:
    """Draw the frame, centring marks, fields and title block of a page."""
    return (*border(paper), *title_block_marks(title_block, *paper.title_block[:2]))


ZONES = {"ANSI B": (4, 2), "ANSI C": (4, 4)}
"""The zones across and down of ASME Y14.1."""


def zones(paper: SheetPaper) -> Iterator[Mark]:
    """Draw the zones outside a frame of ASME Y14.1: from the right, and from below."""
    left, top, right, bottom = paper.area
    across, down = ZONES[paper.name]
    for i in range(across):
        x, width = i * paper.width / across, paper.width / across
        middle = (max(x, left) + min(x + width, right)) / 2
        for y, out in ((top, -BAND), (bottom, BAND)):
            if i:
                yield LineMark(x, y, x, y + out, "border")
            base = y + out / 2 + 1.75 + out / 10
            if middle < right - 20 or y == top or i < across - 1:
                yield Text(middle, base, str(across - i), "field", 3.5, "middle")
    for i in range(down):
        y, height = i * paper.height / down, paper.height / down
        middle = (max(y, top) + min(y + height, bottom)) / 2 + 1.75
        for x, out in ((left, -BAND), (right, BAND)):
            if i:
                yield LineMark(x, y, x + out, y, "border")
            yield Text(x + out * 0.6, middle, LETTERS[down - 1 - i], "field", 3.5, "middle")


def edged(rect: Rect, cls: str) -> Mark:
    """Draw a rectangle given by its sides."""
    left, top, right, bottom = rect
    return box(left, top, right - left, bottom - top, cls)


def centring_marks(paper: SheetPaper) -> tuple[Mark, ...]:
    """Draw four 10 mm marks across the frame in the middle of each side."""
    x, y, reach = paper.width / 2, paper.height / 2, 2 * BAND
    left, top, right, bottom = outside(paper)
    ends = (
        (x, top, x, top + reach),
        (x, bottom, x, bottom - reach),
        (left, y, left + reach, y),
        (right, y, right - reach, y),
    )
    return tuple(LineMark(*four, "frame", "centring-mark") for four in ends)


def outside(paper: SheetPaper) -> Rect:
    """The rectangle outside the frame in which the grid border lies."""
    left, top, right, bottom = paper.area
    return left - BAND, top - BAND, right + BAND, bottom + BAND


def bounds(length: float, low: float, high: float) -> list[float]:
    """Return the bounds of the fields along one side, spaced by 50 mm from its middle."""
    half = floor(length / 2 / FIELD)
    inner = [length / 2 + i * FIELD for i in range(-half, half + 1)]
    return [low, *(at for at in inner if low + FIELD / 4 < at < high - FIELD / 4), high]


def fields(paper: SheetPaper) -> tuple[Mark, ...]:
    """Draw the grid border with its numbered and lettered fields."""
    width, height = paper.width, paper.height
    outer = left, top, right, bottom = outside(paper)
    across, down = bounds(width, left, right), bounds(height, top, bottom)
    marks: list[Mark] = [edged(outer, "border")]
    for x in across[1:-1]:
        marks += (LineMark(x, y, x, y + BAND, "border") for y in (top, bottom - BAND))
    for y in down[1:-1]:
        marks += (LineMark(x, y, x + BAND, y, "border") for x in (left, right - BAND))
    for i, (a, b) in enumerate(pairwise(across)):
        middle = (max(a, left + BAND) + min(b, right - BAND)) / 2
        for y in (top, bottom - BAND):
            marks.append(Text(middle, y + 4.25, str(i + 1), "field", 3.5, "middle"))
    for i, (a, b) in enumerate(pairwise(down)):
        middle = (max(a, top + BAND) + min(b, bottom - BAND)) / 2 + 1.75
        for x in (left, right - BAND):
            marks.append(Text(x + BAND / 2, middle, LETTERS[i], "field", 3.5, "middle"))
    return tuple(marks)


def wrapped(text: str, room: float, height: float) -> list[str]:
    """Break plain text between its words into lines of markup no wider than ``room`` mm."""
    lines: list[str] = []
    for word in escape(text).split():
        longer = f"{lines[-1]} {word}" if lines else word
        if lines and extent(longer, height)[0] <= room:
            lines[-1] = longer
        else:
            lines.append(word)
    return lines


def fitting(
    name: str, text: str, room: float, depth: float, most: float, leading: float = LEADING
) -> tuple[list[str], float]:
    """Return lines of markup and the greatest ISO 3098 height at which they fit a cell (mm).

    Raises PageError where the text does not fit.
    """
    for height in (height for height in HEIGHTS if height <= most):
        parts = [text] if name == "scale" else text.split("\n")
        lines = parts if name == "scale" else [x for p in parts for x in wrapped(p, room, height)]
        wide = max(extent(line, height)[0] for line in lines)
        if wide <= room and (len(lines) - 1) * leading * height + height <= depth:
            return lines, height
    raise PageError.at(
        message("title block, {name}", name=name.replace("_", " ")),
        message("“{text}” does not fit in the smallest lettering", text=text),
        message("text for {room:g} × {depth:g} mm", room=room, depth=depth),
        message("shorten the text"),
    )


def room_in(rect: Rect, frame: SheetFrame = ISO) -> tuple[float, float]:
    """The width and height, in mm, of the space for a value in a title block cell.

    It is below the label; the cells of GOST have none.
    """
    left, top, right, bottom = rect
    if frame is GOST:
        return right - left - 2, bottom - top - 2
    return right - left - 3, bottom - top - LABEL - UNDER - 0.7


def cell(name: str, rect: Rect, most: float, label: str, value: str) -> list[Mark]:
    """Draw one cell: its label at the top and the lines of its value at the bottom."""
    left, top, right, bottom = rect
    x, room = left + 1.5, right - left - 3
    marks: list[Mark] = []
    if label:
        (line,), height = fitting(f"label of {name}", label, room + 1, 2.5, 2.5)
        marks.append(Text(x, top + LABEL, line, "title", height))
    if value.strip():
        lines, height = fitting(name, value, *room_in(rect), most)
        low = bottom - max(UNDER, DESCENT * height)
        for i, line in enumerate(lines):
            y = low - (len(lines) - 1 - i) * LEADING * height
            marks.append(Text(x, y, line, "title", height, name=name))
    return marks


def logo_box(block: TitleBlock) -> Rect:
    """The box of the logo in the title block; without a logo, it has no width."""
    left, top, right, bottom = next(rect for name, rect, _ in cells_of(block) if name == OWNER)
    high, most = bottom - top - 2 * BESIDE, (right - left) / 3
    width = min(high * block.logo, most)
    high = width / block.logo if width else high
    middle = (top + bottom) / 2
    return left + BESIDE, middle - high / 2, left + BESIDE + width, middle + high / 2


def header_marks(block: TitleBlock, rect: Rect, logo: Rect) -> list[Mark]:
    """The lines of a school's header beside its logo, across the whole height of its cell."""
    left, top, right, bottom = rect
    room, depth = right - left - 3 - (logo[2] - logo[0]), bottom - top - 2 * BESIDE
    if not block.legal_owner.strip():
        return []
    lines, height = fitting(OWNER, block.legal_owner, room, depth, 3.5, CLOSER)
    first = (top + bottom - (len(lines) - 1) * CLOSER * height + height) / 2
    x = right - 1.5 - room
    return [
        Text(x, first + i * CLOSER * height, line, "title", height, name=OWNER)
        for i, line in enumerate(lines)
    ]


def title_block_marks(block: TitleBlock, x: float, y: float) -> tuple[Mark, ...]:
    """Draw the title block with its top-left corner at (x, y)."""
    if block.frame is GOST:
        return tuple(form_one(block, x, y))
    width, height = block.frame.block
    marks: list[Mark] = [box(x, y, width, height, "frame title-block")]
    for name, (left, top, right, bottom), most in cells_of(block):
        rect = (x + left, y + top, x + right, y + bottom)
        if left:
            marks.append(LineMark(rect[0], rect[1], rect[0], rect[3], "border title-block"))
        elif top:
            marks.append(LineMark(x, rect[1], x + width, rect[1], "border title-block"))
        if name == OWNER and block.is_headed:
            marks += header_marks(block, rect, logo_box(block))
            continue
        marks += cell(name, rect, most, block.labels.get(name, ""), getattr(block, name))
    return tuple(marks)


COLUMNS = (7.0, 17.0, 40.0, 55.0)
"""The lines between the columns of changes and signatures in form 1, from its left edge, in mm."""
LINES = (
    *((x, 0.0, x, 25.0 if x == COLUMNS[0] else 55.0) for x in (*COLUMNS, 65.0)),
    *((0.0, y, 65.0, y) for y in (20.0, 25.0)),
    *((65.0, y, 185.0, y) for y in (15.0, 40.0)),
    (135.0, 15.0, 135.0, 55.0),
    *((135.0, y, 185.0, y) for y in (20.0, 35.0)),
    *((x, 15.0, x, 35.0) for x in (150.0, 167.0)),
    *((x, 20.0, x, 35.0) for x in (140.0, 145.0)),
    (155.0, 35.0, 155.0, 40.0),
)
"""The strong lines of form 1."""
ROWS = ("Разраб.", "Пров.", "Т. контр.", "", "Н. контр.", "Утв.")
"""The first column of the signatures."""
HEADS = (
    *(("Изм.", 3.5, 1.8), ("Лист", 12.0, 2.5), ("№ докум.", 28.5, 2.5), ("Подп.", 47.5, 2.5)),
    ("Дата", 60.0, 2.5),
)
"""The heads of the columns, their middles, and the heights of their letters."""
ASIDE = (("Лит.", 142.5), ("Масса", 158.5), ("Масштаб", 176.0))
"""The heads above the stage, the mass and the scale, and their middles."""


def lines_of_form(block: TitleBlock) -> Iterator[Rect]:
    """The strong lines of form 1; a student's cell has none within it."""
    for x1, y1, x2, y2 in LINES:
        if x1 == x2 == COLUMNS[2] and STUDENT in block.labels:
            yield x1, y1, x2, 25.0
            yield x1, 30.0, x2, y2
        else:
            yield x1, y1, x2, y2


def form_one(block: TitleBlock, x: float, y: float) -> Iterator[Mark]:
    """Draw the title block of GOST 2.104-2006, form 1, with its printed words."""
    width, height = block.frame.block
    yield box(x, y, width, height, "frame title-block")
    for x1, y1, x2, y2 in lines_of_form(block):
        yield LineMark(x + x1, y + y1, x + x2, y + y2, "frame title-block")
    for row in (*range(5, 20, 5), *range(30, 55, 5)):
        yield LineMark(x, y + row, x + 65.0, y + row, "border title-block")
    for word, middle, size in HEADS:
        yield Text(x + middle, y + 23.6, word, "title", size, "middle")
    for word, middle in ASIDE:
        yield Text(x + middle, y + 18.6, word, "title", 2.5, "middle")
    for i, word in enumerate(filter(None, ROWS)):
        row = i + (i >= ROWS.index(""))
        yield Text(x + 1.0, y + 28.7 + 5 * row, word, "title", 2.5)
    number, _, rest = block.sheet.partition("/")
    total, _, step = rest.partition(STEP)
    if step:
        block = replace(block, document_type=f"{block.document_type}\n{step}")
    for word, left in ((f"Лист {number}", 136.5), (f"Листов {total}", 156.5)):
        yield Text(x + left, y + 38.6, word, "title", 2.5, name="sheet")
    for name, (left, top, right, bottom), most in gost_cells(block):
        value = getattr(block, name)
        rect = x + left, y + top, x + right, y + bottom
        if name == OWNER and block.is_headed:
            yield from header_marks(block, rect, logo_box(block))
        elif name != "sheet" and value.strip():
            yield from centred(name, rect, most, value)


def centred(name: str, rect: Rect, most: float, value: str) -> Iterator[Mark]:
    """The lines of a value in the middle of a cell without a label."""
    left, top, right, bottom = rect
    lines, height = fitting(name, value, *room_in(rect, GOST), most, CLOSER)
    first = (top + bottom - (len(lines) - 1) * CLOSER * height + height) / 2
    for i, line in enumerate(lines):
        y = first + i * CLOSER * height
        yield Text((left + right) / 2, y, line, "title", height, "middle", name)


@lru_cache(maxsize=8)
def check_bar(x: float, y: float) -> tuple[Mark, ...]:
    """Draw a 100 mm ruler from (x, y) to the right for checking the print.

    It has ticks every 1 mm and numbers every 10 mm, and takes 4 mm above and 4 mm below y.
    """
    marks: list[Mark] = [LineMark(x, y, x + 100, y, "check-bar", "check-bar")]
    for i in range(101):
        tick = 4.0 if i % 10 == 0 else 3.0 if i % 5 == 0 else 2.0
        marks.append(LineMark(x + i, y, x + i, y - tick, "check-bar"))
    for i in range(0, 101, 10):
        marks.append(Text(x + i, y + 3.3, str(i), "check-bar", 2.5, "middle"))
    return tuple(marks)


def page_frame(
    header: tuple[str, str] = ("", ""),
    footer: tuple[str, str] = ("", ""),
    school: Sequence[str] = (),
    page: TextPage = A4_PAGE,
) -> tuple[Mark, ...]:
    """Draw a portrait page's frame, with a line (left, right; markup) at its head and foot.

    The lines of a school's header, in plain text, are above the frame. All is in the place that it
    has on A4, but for the foot; ``on_page`` moves it to the middle.
    """
    left, top, right, bottom = A4_FRAME
    bottom -= page.shorter
    head, foot = A4_AREA[1], A4_AREA[3] - page.shorter
    marks: list[Mark] = [edged((left, top, right, bottom), "frame")]
    marks += (LineMark(left, y, right, y, "border") for y in (head, foot))
    marks += ends(head - 2.9, header, "header")
    marks += ends(bottom - 2.9, footer, "footer")
    if school:
        joined = escape(", ".join(school))
        wide = extent(joined, 2.5)[0] <= right - left
        line = joined if wide else escape(school[0])
        marks.append(Text(left, A4_FRAME[1] - 2, line, "title", 2.5, name="school"))
    return tuple(marks)


def on_page(
    page: TextPage, marks: Iterable[Mark], title: str, language: str, weight: float = 1.0
) -> Page:
    """A page of text with its marks, which are at their places on A4, in its middle. Checks it."""
    placed = tuple(moved(mark, page.aside, 0) if page.aside else mark for mark in marks)
    made = Page(*page.size, placed, title, language, weight=weight)
    made.check()
    return made


def ends(y: float, words: tuple[str, str], name: str) -> list[Mark]:
    """Write markup at the left and right ends of a line of an A4 page.

    A long left text is split into two small lines. Raises PageError where these are too short.
    """
    left, right = A4_FRAME[0] + 3, A4_FRAME[2] - 3
    first, last = words
    wide = sum(extent(markup, 2.5)[0] for markup in words)
    height = 2.5 if wide + 4 <= right - left else 1.8
    lines = [first]
    if wide / 2.5 * height + 4 > right - left:
        room = right - left - 4 - extent(last, height)[0]
        lines = flowed(words_of(first), " ", room, height)
        if len(lines) > 2:
            fits = len(plain(" ".join(lines[:2])))
            found = message(
                "“{text}” is too long: {count} letters", text=plain(first), count=len(plain(first))
            )
            raise PageError.at(
                name, found, message("about {fits} letters", fits=fits), message("shorten it")
            )
    low = y + CLOSE * (len(lines) - 1) / 2
    marks: list[Mark] = [
        Text(left, low - CLOSE * (len(lines) - 1 - i), line, "title", height, "start", name)
        for i, line in enumerate(lines)
        if line
    ]
    return [*marks, *([Text(right, y, last, "title", height, "end", name)] if last else [])]
