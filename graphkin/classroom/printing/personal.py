"""A student's own sheets: the name and the opaque code on every page, the square where it fits."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache
from itertools import groupby, product
from unicodedata import category, normalize

from msgspec import Struct
from msgspec.structs import replace

from graphkin.classroom.roster.student import Student
from graphkin.classroom.roster.taker import Taker
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.documents.sheet_documents import FOOT
from graphkin.drawing.field import A3_AREA, A3_TITLE_BLOCK, A4_AREA, A4_SIZE, AREA, BELOW, Rect
from graphkin.drawing.frame import STUDENT, STUDENTS, fitting, room_in
from graphkin.drawing.marks import LineMark, Mark, Page, Point, Polyline, Text, box, reach
from graphkin.drawing.richtext import known, measures
from graphkin.drawing.symbol_markup import escape
from graphkin.text.errors import PageError

SIDE = 20.0
"""Side of the square in mm."""
QUIET = 4
"""Modules that stay white around it (ISO/IEC 18004)."""
STEP = 4.0
"""How far apart the places are that are tried, in mm."""


@lru_cache(maxsize=64)
def modules(text: str) -> tuple[tuple[bool, ...], ...]:
    """The square of a text, row by row, dark ones True; a quarter of them may be spoilt.

    Ten capitals and digits take 21 modules a side, the least that there is.
    """
    import segno

    code = segno.make_qr(text, error="q", boost_error=True)
    return tuple(tuple(bool(dark) for dark in row) for row in code.matrix)


def square(text: str, x: float, y: float, side: float = SIDE) -> tuple[Mark, ...]:
    """The square of a text as black rectangles, its top-left corner at (x, y), side in mm."""
    rows = modules(text)
    size = side / len(rows)
    return tuple(
        box(x + left * size, y + top * size, width * size, height * size, "qr")
        for left, top, width, height in rectangles(rows)
    )


def rectangles(rows: Sequence[Sequence[bool]]) -> Iterator[tuple[int, int, int, int]]:
    """Dark modules as rectangles (left, top, width, height): runs, joined where they are alike."""
    standing: dict[tuple[int, int], int] = {}  # (left, width) of a run, and where it began
    for top, row in enumerate([*rows, ()]):
        runs = dict.fromkeys(dark_runs(row), top)
        for run in [run for run in standing if run not in runs]:
            began = standing.pop(run)
            yield run[0], began, run[1], top - began
        standing = runs | standing


def dark_runs(row: Sequence[bool]) -> Iterator[tuple[int, int]]:
    """Where dark modules of a row begin, and how many there are side by side."""
    for dark, group in groupby(range(len(row)), key=row.__getitem__):
        run = list(group)
        if dark:
            yield run[0], len(run)


def stamped(page: Page, text: str) -> Page:
    """The page with the square of a text where there is room; as it was where there is none."""
    margin = SIDE / len(modules(text)) * QUIET
    full = [full_box for mark in page.marks for full_box in boxes(mark)]
    a4 = (page.width, page.height) == A4_SIZE
    for x, y in corners_of_a4(margin) if a4 else corners_of_a3(margin):
        needed = (x - margin, y - margin, x + SIDE + margin, y + SIDE + margin)
        if not any(overlap(needed, other) for other in full):
            marks = square(text, x, y)
            return replace(page, marks=(*page.marks, *marks))
    return page


def corners_of_a3(margin: float) -> Iterator[tuple[float, float]]:
    """Places below the drawings of an A3 sheet, from beside the title block to the left and up."""
    x, low = A3_TITLE_BLOCK[0] - SIDE - margin - 1, A3_TITLE_BLOCK[3] - SIDE - margin - 1
    while x > BELOW[0] + margin:
        y = low
        while y > BELOW[1] + margin:
            yield x, y
            y -= STEP
        x -= STEP


def corners_of_a4(margin: float) -> Iterator[tuple[float, float]]:
    """Places on an A4 page, from its right upper corner down, then further to the left."""
    x = A4_AREA[2] - SIDE - margin - 1
    while x > A4_AREA[0] + margin:
        y = A4_AREA[1] + margin + 1
        while y < A4_AREA[3] - SIDE - margin:
            yield x, y
            y += STEP
        x -= STEP


def boxes(mark: Mark) -> Iterator[Rect]:
    """The boxes that a mark takes up; of an outline those of its sides."""
    if isinstance(mark, Polyline):
        ends = (*mark.points[1:], mark.points[0]) if mark.closed else mark.points[1:]
        for (x1, y1), (x2, y2) in zip(mark.points, ends, strict=False):
            yield reach(LineMark(x1, y1, x2, y2, mark.cls))
    else:
        yield reach(mark)


def overlap(one: Rect, other: Rect) -> bool:
    """Whether two upright boxes share anything."""
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]


# --- A student's own sheets -----------------------------------------------------------------------


UNKNOWN = "?"
"""What stands for a sign that the sheet's font does not have."""
OVERLAY_FOOT = (A3_AREA[0] + 12, A3_AREA[3] - FOOT + 4.6)
"""Where an overlay says whose it is, in mm: below its caption."""


class Owner(Struct, frozen=True):
    """Whose a sheet is: the name as it is printed, with the group, and the opaque code."""

    name: str
    code: str

    @property
    def line(self) -> str:
        """Name and code on one line."""
        return f"{self.name}   {self.code}"


def owner(taker: Taker) -> Owner:
    """Whose the sheets of a student are."""
    return Owner(shortened(printable_name(taker.student)), taker.code)


def printable_name(student: Student) -> str:
    """A student's name and group in signs of the sheet's font; one without a name, or of whose
    name it has no letter, is called by the id."""
    name = student.name if is_readable(student.name) else student.id
    return ", ".join(filter(None, (writable(name) or UNKNOWN, writable(student.group))))


def is_readable(name: str) -> bool:
    """Whether the font has some letter of a name."""
    return any(sign.isalnum() for sign in writable(name))


def writable(text: str) -> str:
    """A text in signs of the sheet's font: letters without their marks, ? for what is unknown."""
    face = measures(italic=False)
    found = []
    for sign in known(normalize("NFC", " ".join(text.split()))):
        bare = next((part for part in normalize("NFKD", sign) if part in face), UNKNOWN)
        if category(sign)[0] != "C":
            found.append(sign if sign in face else bare)
    return "".join(found).strip()


def lost(text: str) -> tuple[str, ...]:
    """The signs of a text that are printed as ?, each once."""
    signs = dict.fromkeys(normalize("NFC", text))
    return tuple(sign for sign in signs if sign != UNKNOWN and writable(sign) == UNKNOWN)


def shortened(text: str) -> str:
    """A text that fits the title block, its end left out where it does not."""
    kept = text
    while kept and not fits(kept):
        kept = kept.removesuffix("…")[:-1].rstrip()
        kept += "…" if kept else ""
    return kept


def fits(text: str) -> bool:
    """Whether a name fits the title block in the smallest lettering."""
    try:
        _, rect, most = next(cell for cell in STUDENTS if cell[0] == STUDENT)
        fitting(STUDENT, text, *room_in(rect), most)
    except PageError:
        return False
    return True


def owned(drawing: Drawing, whose: Owner) -> Drawing:
    """A drawing whose title block names its student and bears the code."""
    number = drawing.scene.sheet.number
    both = f"{number} / {whose.code}" if number else whose.code
    return with_sheet(drawing, student=whose.name, number=both)


def owned_pages(drawings: Sequence[Drawing], whose: Owner) -> list[Drawing]:
    """Drawings whose calculation pages name their student and the code at the foot."""
    return [with_sheet(drawing, student=whose.line) for drawing in drawings]


def with_sheet(drawing: Drawing, **said: str) -> Drawing:
    """A drawing whose sheet says something else."""
    scene = drawing.scene
    return replace(drawing, scene=replace(scene, sheet=replace(scene.sheet, **said)))


def signed(pages: Sequence[Page], view: str, whose: Owner) -> Iterator[Page]:
    """The pages with their student's square; overlays, which have no title block, with the name."""
    for page in pages:
        if view == "overlay":
            x, y = OVERLAY_FOOT
            foot = Text(x, y, escape(whose.line), "caption", 2.5, name="owner")
            yield replace(page, marks=(*page.marks, foot))
        elif view == "task":
            yield stamped(page, whose.code)
        else:
            yield page


# --- small crosses in the fields of a task's drawing sheet ----------------------------------------


REGISTER = "register"
"""The class of their lines."""
ARM, PITCH, CLEAR = 1.0, 20.0, 1.5
"""Half of a cross, how far apart they stand, and how far from what is printed, in mm."""
MIDDLE = (210.0, 148.5)
"""The sheet's middle, from which they are laid off as the divisions of its border are, in mm."""


def crossed(page: Page) -> Page:
    """The page with crosses in its fields, below all else, where nothing is printed."""
    full = [each for mark in page.marks for each in boxes(mark)]
    marks = []
    for x, y in places():
        near = (x - ARM - CLEAR, y - ARM - CLEAR, x + ARM + CLEAR, y + ARM + CLEAR)
        if not any(overlap(near, other) for other in full):
            marks.append(LineMark(x - ARM, y, x + ARM, y, REGISTER))
            marks.append(LineMark(x, y - ARM, x, y + ARM, REGISTER))
    return replace(page, marks=(*marks, *page.marks))


def without_crosses(page: Page) -> Page:
    """The page as it was printed before there were crosses."""
    return replace(page, marks=tuple(mark for mark in page.marks if mark.cls != REGISTER))


def crosses_of(page: Page) -> list[Point]:
    """Where a page has crosses, in mm."""
    level = (m for m in page.marks if isinstance(m, LineMark) and m.cls == REGISTER)
    return [((m.x1 + m.x2) / 2, m.y1) for m in level if m.y1 == m.y2]


def places() -> Iterator[Point]:
    """Where crosses may stand: on a square pitch about the sheet's middle, inside its fields."""
    left, top, right, bottom = AREA
    low, high = (int((m - edge) / PITCH) for m, edge in zip(MIDDLE, (left, top), strict=True))
    for i, j in product(range(-low, low + 1), range(-high, high + 1)):
        x, y = MIDDLE[0] + i * PITCH, MIDDLE[1] + j * PITCH
        if left + ARM < x < right - ARM and top + ARM < y < bottom - ARM:
            yield x, y
