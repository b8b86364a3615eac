"""A student's own sheets: name and opaque code on every page, and a QR code where it fits."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache
from itertools import groupby, product
from unicodedata import category, normalize

from msgspec import Struct
from msgspec.structs import replace

from graphkin.classroom.roster.students import Student, Taker
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.documents.sheet_documents import FOOT
from graphkin.drawing.field import A3, A4_AREA, A4_SIZE, Rect, SheetPaper
from graphkin.drawing.frame import STUDENT, TitleBlock, cells_of, fitting, room_in
from graphkin.drawing.marks import LineMark, Mark, Page, Point, Polyline, Text, box, moved, reach
from graphkin.drawing.richtext import known, measures
from graphkin.drawing.symbol_markup import escape
from graphkin.numbers.arithmetic import np
from graphkin.scene.model import Scene
from graphkin.text.errors import PageError

SIDE = 20.0
"""The side of the QR code in mm."""
QUIET = 4
"""The white modules around the QR code (ISO/IEC 18004)."""
STEP = 4.0
"""The distance between the places tried, in mm."""


@lru_cache(maxsize=64)
def modules(text: str) -> tuple[tuple[bool, ...], ...]:
    """The QR code of a text, row by row, dark modules True.

    It stays readable with a quarter of the modules damaged. Ten capitals and digits take 21 modules
    a side, the smallest size there is.
    """
    import segno

    code = segno.make_qr(text, error="q", boost_error=True)
    return tuple(tuple(bool(dark) for dark in row) for row in code.matrix)


def square(text: str, x: float, y: float, side: float = SIDE) -> tuple[Mark, ...]:
    """The QR code of a text as black rectangles, its top-left corner at (x, y), side in mm."""
    rows = modules(text)
    size = side / len(rows)
    return tuple(
        box(x + left * size, y + top * size, width * size, height * size, "qr")
        for left, top, width, height in rectangles(rows)
    )


def rectangles(rows: Sequence[Sequence[bool]]) -> Iterator[tuple[int, int, int, int]]:
    """Dark modules as rectangles (left, top, width, height): equal runs are joined."""
    standing: dict[tuple[int, int], int] = {}  # (left, width) of a run: the row where it began
    for top, row in enumerate([*rows, ()]):
        runs = dict.fromkeys(dark_runs(row), top)
        for run in [run for run in standing if run not in runs]:
            began = standing.pop(run)
            yield run[0], began, run[1], top - began
        standing = runs | standing


def dark_runs(row: Sequence[bool]) -> Iterator[tuple[int, int]]:
    """The runs of dark modules in a row: where each begins, and its length."""
    for dark, group in groupby(range(len(row)), key=row.__getitem__):
        run = list(group)
        if dark:
            yield run[0], len(run)


def stamped(page: Page, text: str, paper: SheetPaper = A3) -> Page:
    """The page with the QR code of a text where there is room; the same page if there is none."""
    margin = SIDE / len(modules(text)) * QUIET
    full = [full_box for mark in page.marks for full_box in boxes(mark)]
    whole = (page.width, page.height) == (paper.width, paper.height)
    for x, y in corners_on(paper, margin) if whole else corners_of_text(page, margin):
        needed = (x - margin, y - margin, x + SIDE + margin, y + SIDE + margin)
        if not any(overlap(needed, other) for other in full):
            marks = square(text, x, y)
            return replace(page, marks=(*page.marks, *marks))
    return page


def corners_on(paper: SheetPaper, margin: float) -> Iterator[tuple[float, float]]:
    """Places below the drawings of a sheet, from the title block to the left and up."""
    left, top, right, bottom = paper.below
    low = (bottom if paper.is_leaf else paper.area[3]) - SIDE - margin - 1
    x = (right if paper.is_leaf else paper.title_block[0]) - SIDE - margin - 1
    while x > left + margin:
        y = low
        while y > top + margin:
            yield x, y
            y -= STEP
        x -= STEP


def corners_of_text(page: Page, margin: float) -> Iterator[tuple[float, float]]:
    """Places on a page of text, from its top right corner down, then further to the left."""
    low = A4_AREA[3] - A4_SIZE[1] + page.height
    x = A4_AREA[2] - SIDE - margin - 1
    while x > A4_AREA[0] + margin:
        y = A4_AREA[1] + margin + 1
        while y < low - SIDE - margin:
            yield x, y
            y += STEP
        x -= STEP


def boxes(mark: Mark) -> Iterator[Rect]:
    """The bounding boxes of a mark; of a polyline, those of its sides."""
    if isinstance(mark, Polyline):
        ends = (*mark.points[1:], mark.points[0]) if mark.closed else mark.points[1:]
        for (x1, y1), (x2, y2) in zip(mark.points, ends, strict=False):
            yield reach(LineMark(x1, y1, x2, y2, mark.cls))
    else:
        yield reach(mark)


def overlap(one: Rect, other: Rect) -> bool:
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]


# --- A student's own sheets -----------------------------------------------------------------------


UNKNOWN = "?"
"""The substitute for a sign that the sheet's font does not have."""


class Owner(Struct, frozen=True):
    """The owner of a sheet: the name as printed, with the group, and the opaque code."""

    name: str
    code: str

    @property
    def line(self) -> str:
        return f"{self.name}   {self.code}"


def owner(taker: Taker, paper: SheetPaper = A3) -> Owner:
    """The owner of a student's sheets."""
    return Owner(shortened(printable_name(taker.student), paper), taker.code)


def printable_name(student: Student) -> str:
    """A student's name and group in signs of the sheet's font.

    The id replaces a missing name, and a name of which the font has no letter. It precedes the name
    on each of several sheets of a student.
    """
    name = student.with_part(student.name if is_readable(student.name) else student.id)
    return ", ".join(filter(None, (writable(name) or UNKNOWN, writable(student.group))))


def is_readable(name: str) -> bool:
    """Whether the font has at least one letter of a name."""
    return any(sign.isalnum() for sign in writable(name))


def writable(text: str) -> str:
    """A text in signs of the sheet's font: letters without missing accents, ? for unknown signs."""
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


def shortened(text: str, paper: SheetPaper) -> str:
    """A text that fits the title block; the end is cut off if it does not fit."""
    kept = text
    while kept and not fits(kept, paper):
        kept = kept.removesuffix("…")[:-1].rstrip()
        kept += "…" if kept else ""
    return kept


def fits(text: str, paper: SheetPaper) -> bool:
    """Whether a name fits the title block in the smallest lettering."""
    try:
        block = TitleBlock(labels={STUDENT: ""}, creator="-", frame=paper.frame)
        _, rect, most = next(cell for cell in cells_of(block) if cell[0] == STUDENT)
        fitting(STUDENT, text, *room_in(rect, paper.frame), most)
    except PageError:
        return False
    return True


def owned(drawing: Drawing, whose: Owner) -> Drawing:
    """A drawing with the student's name and code in the title block."""
    return replace(drawing, scene=with_owner(drawing.scene, whose))


def with_owner(scene: Scene, whose: Owner) -> Scene:
    """A scene whose sheets have a student's name and code in the title block."""
    number = scene.sheet.number
    both = f"{number} / {whose.code}" if number else whose.code
    return replace(scene, sheet=replace(scene.sheet, student=whose.name, number=both))


def owned_pages(drawings: Sequence[Drawing], whose: Owner) -> list[Drawing]:
    """Drawings whose calculation pages have the student's name and code at the foot."""
    return [with_sheet(drawing, student=whose.line) for drawing in drawings]


def with_sheet(drawing: Drawing, **said: str) -> Drawing:
    """A drawing with some fields of its sheet replaced."""
    scene = drawing.scene
    return replace(drawing, scene=replace(scene, sheet=replace(scene.sheet, **said)))


def signed(pages: Sequence[Page], view: str, whose: Owner, paper: SheetPaper) -> Iterator[Page]:
    """The pages with their owner: a QR code on a task, the name on an overlay.

    Overlays have no title block.
    """
    for page in pages:
        if view == "overlay":
            left, _, _, low = paper.area
            foot = Text(
                left + 12, low - FOOT + 4.6, escape(whose.line), "caption", 2.5, name="owner"
            )
            yield replace(page, marks=(*page.marks, foot))
        elif view == "task":
            yield stamped(page, whose.code, paper)
        else:
            yield page


# --- small crosses in the fields of a task's drawing sheet, to register a scan -------------------


REGISTER = "register"
"""The class of the lines of the crosses."""
ARM, PITCH, CLEAR = 1.0, 20.0, 1.5
"""Half the size of a cross, their distance, and their clearance from printed marks, in mm."""


def crossed(page: Page, paper: SheetPaper = A3) -> Page:
    """The page with crosses in its fields, below everything else, where nothing is printed."""
    left, top, right, bottom = np.array([each for mark in page.marks for each in boxes(mark)]).T
    marks = []
    for x, y in places(paper):
        across = (x - ARM - CLEAR < right) & (left < x + ARM + CLEAR)
        if not (across & (y - ARM - CLEAR < bottom) & (top < y + ARM + CLEAR)).any():
            marks.append(LineMark(x - ARM, y, x + ARM, y, REGISTER))
            marks.append(LineMark(x, y - ARM, x, y + ARM, REGISTER))
    return replace(page, marks=(*marks, *page.marks))


def joined(pages: Sequence[Page]) -> Page:
    """Pages side by side as one, with the square of the first page alone."""
    first, *others = pages
    marks = [*first.marks]
    for number, page in enumerate(others, 1):
        aside = number * first.width
        marks += (moved(mark, aside, 0) for mark in page.marks if mark.cls != "qr")
    return replace(first, width=len(pages) * first.width, marks=tuple(marks)) if others else first


def without_crosses(page: Page) -> Page:
    """The page without crosses."""
    return replace(page, marks=tuple(mark for mark in page.marks if mark.cls != REGISTER))


def crosses_of(page: Page) -> list[Point]:
    """The places of the crosses of a page, in mm."""
    level = (m for m in page.marks if isinstance(m, LineMark) and m.cls == REGISTER)
    return [((m.x1 + m.x2) / 2, m.y1) for m in level if m.y1 == m.y2]


def places(paper: SheetPaper = A3) -> Iterator[Point]:
    """The possible places of crosses: on a square grid about the middle, inside the fields."""
    left, top, right, bottom = paper.fields
    middle = paper.width / 2, paper.height / 2
    low, high = (int((m - edge) / PITCH) for m, edge in zip(middle, (left, top), strict=True))
    for i, j in product(range(-low, low + 1), range(-high, high + 1)):
        x, y = middle[0] + i * PITCH, middle[1] + j * PITCH
        if left + ARM < x < right - ARM and top + ARM < y < bottom - ARM:
            yield x, y
