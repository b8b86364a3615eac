"""The reading of one photograph: the student, the map and the points, or the reason for refusal."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from graphkin.accuracy.pencil import Pencil
from graphkin.classroom.grading.probes import probes
from graphkin.classroom.lab.lab_model import Item
from graphkin.classroom.printing.personal import without_crosses
from graphkin.classroom.printing.print_run import PrintOrder, Sheets
from graphkin.classroom.roster.students import Taker
from graphkin.drawing.field import A3, SheetPaper, paper_of
from graphkin.numbers.arithmetic import np
from graphkin.reading.lettered_points import LetteredSheet
from graphkin.reading.paper_map import PaperMap
from graphkin.reading.pictures import Photograph, Unreadable, colours_of, darkest
from graphkin.reading.plan_causes import PlanCause
from graphkin.reading.point_reading import PointReading
from graphkin.reading.written_cells import WrittenCell
from graphkin.text import LANGUAGES
from graphkin.text.errors import problems_of

ONE_LEAF = (
    "shows one of two A4 pages: photograph both, and name the pictures NAME-left and NAME-right"
)
"""The reason for refusal of a single A4 page."""
SHOWN, QUALITY = 6.0, 82
"""Pixels per mm and JPEG quality of the flattened picture that is kept."""
SURE_OF_SHEET = 0.9
"""The share found of a sheet's own lines from which no other language is tried."""


class Grid(Struct, frozen=True):
    """A grid of places in mm of paper whose pixels are wanted, by row, x changing fastest."""

    x: tuple[float, ...] = ()
    y: tuple[float, ...] = ()


class SheetRecord(Struct, frozen=True):
    """The record of a photograph; ``refused`` is the reason why it was not read, else None."""

    name: str
    file: str
    key: str
    code: str = ""
    who: str = ""
    kind: str = ""
    refused: str | None = None
    map: tuple[tuple[float, float], ...] = ()
    points: tuple[PointReading, ...] = ()
    corners: dict[int, tuple[float, float]] = {}
    key_lines: tuple[tuple[float, float, float, float], ...] = ()
    residual: float = 0.0
    cause: PlanCause | None = None
    paper: tuple[str, str] = (A3.name, A3.frame.name)
    """The names of the paper and of its frame."""
    written: tuple[WrittenCell, ...] = ()
    """The cells of the sheet's tables that hold handwriting, in the order of their cut-outs."""

    @property
    def on(self) -> SheetPaper:
        """The paper of the sheet."""
        return paper_of(*self.paper)


class ReadOrder(Struct, frozen=True):
    """The data that the readings of a class share: its lab, its scene, and its students by code."""

    order: PrintOrder
    takers: Mapping[str, Taker]
    grid: Grid = Grid()
    by_hand: bool = False
    marked: tuple[Item, ...] = ()
    """The marked lengths and places: when reading by hand, a person is asked only for their points.
    """


class SheetRead(Struct, frozen=True):
    """A record, and as JPEG the flattened picture and the cut-outs of written cells.

    The picture is b"" where the photograph was refused.
    """

    record: SheetRecord
    picture: bytes = b""
    cells: tuple[bytes, ...] = ()


class FoundSheet(Struct, frozen=True):
    """The sheet found in a picture, with its map, its residual in mm, and the student's sheets."""

    sheet: LetteredSheet
    map: PaperMap
    residual: float
    sheets: Sheets


def read_some(order: ReadOrder, wanted: Sequence[tuple[Photograph, str]]) -> list[SheetRead]:
    """The readings of some photographs, each given with the key under which it is kept."""
    import cv2

    cv2.setNumThreads(1)
    return [read_one(order, photograph, key) for photograph, key in wanted]


def read_one(order: ReadOrder, photograph: Photograph, key: str) -> SheetRead:
    """The reading of one photograph; any error becomes the refusal of that photograph alone."""
    record = SheetRecord(photograph.name, photograph.path.name, key)
    code = ""
    try:
        picture = colours_of(photograph)
        if photograph.left is not None:
            picture = of_halves(colours_of(photograph.left), picture, order)
        grey = darkest(picture)
        if photograph.left is not None:
            code, corners = code_of_halves(grey, order.takers, paper_for(order))
        else:
            code, corners = known_code(grey, order.takers)
            if paper_for(order).is_parted:
                raise Unreadable(ONE_LEAF)
        found = found_sheet(grey, order, code, corners)
        points, corners_at, cause = (
            points_to_click(found, order) if order.by_hand else read_points(grey, found)
        )
        written = cells_with_ink(picture, grey, found)
        read = replace(
            record,
            code=code,
            who=student_label(order, code),
            kind=found.sheet.kind,
            map=mapped(found.map, order.grid),
            points=points,
            corners=corners_at,
            key_lines=found.sheet.key_lines,
            residual=round(found.residual, 3),
            paper=(found.map.paper.name, found.map.paper.frame.name),
            cause=cause,
            written=tuple(cell for cell, _ in written),
        )
        flat = flat_picture(picture, found.map)
        return SheetRead(read, flat, tuple(cut for _, cut in written))
    except Exception as error:
        refused = str(error) if isinstance(error, Unreadable) else problems_of(error)[0].found
        who = student_label(order, code)
        return SheetRead(replace(record, code=code, who=who, refused=refused.splitlines()[0]))


def student_label(order: ReadOrder, code: str) -> str:
    """The id and name of the student with a code; "" for an unknown code."""
    taker = order.takers.get(code)
    return f"{taker.student.id} {taker.student.name}".strip() if taker is not None else ""


def known_code(grey: Any, takers: Mapping[str, Taker]) -> tuple[str, Any]:
    """The only code of the class in a picture, and its corners. Raises Unreadable."""
    from graphkin.reading.codes import codes_in

    found = codes_in(grey)
    ours = [each for each in found if each.text in takers]
    if len(ours) > 1:
        codes = ", ".join(sorted(each.text for each in ours))
        raise Unreadable(f"holds several sheets: {codes}; one in each picture")
    if not ours and found:
        raise Unreadable("its code is that of no student of this class: another class, or a copy")
    if not ours:
        raise Unreadable(
            "no code is found: the square left of the title block must be seen whole; "
            "halves of a sheet are named NAME-left and NAME-right; "
            "sheets of positions and diagrams have no code, and are not read"
        )
    (each,) = ours
    return each.text, each.corners


def code_of_halves(
    sheet: Any, takers: Mapping[str, Taker], paper: SheetPaper = A3
) -> tuple[str, Any]:
    """The code on a sheet joined from its halves, and its corners. Raises Unreadable.

    The code is where the halves meet, and scans may lack part of it.
    """
    from graphkin.reading.codes import code_among
    from graphkin.reading.halves import DENSITY

    if paper.is_parted:  # both leaves have it
        return known_code(sheet[:, : sheet.shape[1] // 2], takers)
    try:
        return known_code(sheet, takers)
    except Unreadable:
        found = code_among(sheet, DENSITY, tuple(takers), paper)
        if found is None:
            raise
        return found.text, found.corners


def found_sheet(grey: Any, order: ReadOrder, code: str, corners: Any) -> FoundSheet:
    """The sheet of a student that is in a picture. Raises Unreadable where none can be flattened.

    It is the sheet whose own lines are found while those of the others are not, because one sheet
    may have all lines of another and some more.
    """
    from graphkin.reading.registration import SheetSearch

    search = SheetSearch(grey, corners, paper=paper_for(order))
    best, most, held, refused = None, -1.0, 0.0, ""
    own = order.takers[code].spoken or order.order.language
    for language in dict.fromkeys((own, *LANGUAGES)):
        sheets = sheets_of(order.order, order.takers[code], language)
        pages = sheets.task_pages
        shares = {
            kind: search.likeness(page, [other for other in pages.values() if other is not page])
            for kind, page in pages.items()
        }
        kind = max(shares, key=lambda each: shares[each])
        found = search.registered(pages[kind]) if shares[kind] > most else None
        if found is not None:
            drawing = next(each for each in sheets.drawings if each.kind == kind)
            most, refused, held = shares[kind], found.refused, found.own
            page = pages[kind] if found.crossed else without_crosses(pages[kind])
            sheet = LetteredSheet(drawing, page)
            best = FoundSheet(sheet, found.map, found.residual, sheets)
        if held >= SURE_OF_SHEET:
            break
    if best is None or refused:
        raise Unreadable(refused or "no sheet of this student has a square to begin with")
    return best


def of_halves(left: Any, right: Any, order: ReadOrder) -> Any:
    """The sheet joined from pictures of its halves. Raises Unreadable where a half is not found."""
    from graphkin.reading.halves import laid_together, put_together

    taker = next(iter(order.takers.values()))
    sheets = sheets_of(order.order, taker, order.order.language)
    if not sheets.paper.is_parted:
        return put_together(left, right, next(iter(sheets.task_pages.values())))
    (code, first), (other, second) = (known_code(darkest(x), order.takers) for x in (left, right))
    if code != other:
        raise Unreadable(f"its halves are of two students: {code}, {other}")
    sheets = sheets_of(order.order, order.takers[code], order.order.language)
    return laid_together((left, right), (first, second), sheets.leaves, sheets.paper)


def paper_for(order: ReadOrder) -> SheetPaper:
    """The paper of the sheets of a class."""
    taker = next(iter(order.takers.values()))
    return sheets_of(order.order, taker, order.order.language).paper


@lru_cache(maxsize=8)
def last_drawn(code: str, language: str) -> list[tuple[PrintOrder, Taker, Sheets]]:
    """A cache for a student's sheets while several pictures of them are read.

    It holds the last sheets, and the lab and the data from which they were drawn.
    """
    return []


def sheets_of(order: PrintOrder, taker: Taker, language: str) -> Sheets:
    """The sheets of a student in a language."""
    own = replace(order, language=language), replace(taker, language=language)
    kept = last_drawn(taker.code, language)
    if not kept or kept[0][:2] != own:
        kept[:] = [(*own, Sheets(*own))]
    return kept[0][2]


Points = tuple[tuple[PointReading, ...], dict[int, tuple[float, float]], PlanCause | None]
"""The lettered points of a sheet, the places of its corners without letters, by step, and the cause
of all mistakes in its plan.
"""


def read_points(grey: Any, found: FoundSheet) -> Points:
    """The points read from a sheet that was found."""
    from graphkin.reading.drawn_ink import drawn_ink
    from graphkin.reading.point_reader import PointReader

    rubric = found.sheets.lab.rubric
    ink = drawn_ink(grey, found.map, found.sheet.page)
    reader = PointReader(found.sheet, ink, Pencil(rubric.point, rubric.line))
    points = reader.read()
    return points, reader.corners(), reader.cause


def points_to_click(found: FoundSheet, order: ReadOrder) -> Points:
    """The points of a sheet that a person is to click; none of them is read.

    Only the points that a mark depends on are asked for; if no length or place is marked, all are.
    """
    from graphkin.reading.point_reader import forecast_points

    rubric = found.sheets.lab.rubric
    points = forecast_points(found.sheet, Pencil(rubric.point, rubric.line))
    whole = found.sheets.mechanism.with_forces
    needed = {step for each in probes(whole, order.marked) for step in each.steps}
    if not needed:
        return points, {}, None
    return tuple(replace(point, ask=point.step in needed) for point in points), {}, None


def cells_with_ink(picture: Any, grey: Any, found: FoundSheet) -> list[tuple[WrittenCell, bytes]]:
    """The cells of a found sheet's tables that hold handwriting, with their cut-outs."""
    from graphkin.reading.cut_outs import written_cells

    return written_cells(picture, grey, found.map, found.sheet.page)


def mapped(over: PaperMap, grid: Grid) -> tuple[tuple[float, float], ...]:
    """The pixels of a grid of places."""
    if not grid.x or not grid.y:
        return ()
    places = np.stack(np.meshgrid(grid.x, grid.y), axis=-1).reshape(-1, 2)
    return tuple((round(float(x), 3), round(float(y), 3)) for x, y in over(places))


def flat_picture(picture: Any, over: PaperMap) -> bytes:
    """The flattened sheet as a JPEG without metadata, in the picture's colours."""
    from graphkin.reading.cut_outs import as_jpeg
    from graphkin.reading.drawn_ink import flattened

    return as_jpeg(flattened(picture, over, over.paper.whole, SHOWN), QUALITY)
