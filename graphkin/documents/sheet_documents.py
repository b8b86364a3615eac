"""The sheets of a mechanism, each verified before it is drawn and handed out.

The continuation sheets: data, sentences and tables that do not fit next to the drawings.

They also hold plans with the names of auxiliary points.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set
from itertools import chain

from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.crossings import letter_of
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.given_data import variant
from graphkin.construction.core.layout import (
    Layout,
    centre,
    lay_out,
    lowered,
    mechanism_field,
    spans,
)
from graphkin.construction.core.naming import name_of_sheet
from graphkin.construction.core.quantities import SHEETS
from graphkin.construction.core.solution import FAIR, Solution, Verdict
from graphkin.construction.result_tables import tables, tables_on_sheets, unread
from graphkin.diagnosis.assembly_failure import beside_dead_point
from graphkin.documents import MOTION_VIEWS
from graphkin.documents.detail import with_detail
from graphkin.documents.listing import in_columns, on_sheets
from graphkin.documents.scaling import drawing, scales, sheet_motion, targets_of
from graphkin.documents.sheet import (
    HEADING,
    Moved,
    asked_words,
    boards,
    construction_head,
    data_of,
    members,
    pages_of,
    parts_of,
    plan_enlarged,
    right_board,
    sheet_heading,
    title_block,
    title_line,
    title_of,
    weight_of,
)
from graphkin.drawing.field import ABOVE, MARGIN, Field, Rect, SheetPaper
from graphkin.drawing.frame import fitting
from graphkin.drawing.marks import LineMark, Mark, Page, Text, reach
from graphkin.drawing.richtext import extent, flowed, narrow_words
from graphkin.drawing.scale import Scales
from graphkin.drawing.style import BARE, TINTS, style_of
from graphkin.mechanism import Mechanism
from graphkin.motion.motion_curves import curves_of
from graphkin.scene.house import FRAMES
from graphkin.scene.model import Scene
from graphkin.text import LANGUAGES, Words, words
from graphkin.text.errors import (
    PageError,
    Problem,
    SceneError,
    Sought,
    WitnessError,
    either,
    message,
)

CALCULATED = ("key", "task")
"""The views that come with calculation pages."""


class SheetDocument(Struct, frozen=True):
    """The pages of one document: velocity, acceleration or calculation.

    ``unread`` says which quantities it asks for but does not allow to be read off.
    """

    kind: str
    pages: tuple[Page, ...]
    unread: tuple[str, ...] = ()


def hand_out(
    mechanism: Mechanism, view: str = "key", language: str | None = None
) -> list[SheetDocument]:
    """The sheets that a scene asks for, in a language (None: the scene's own).

    Raises WitnessError when the independent route disagrees, and PageError when a page does not
    fit.
    """
    from graphkin.documents.calculation import calculation

    if view in MOTION_VIEWS:
        from graphkin.documents.motion_sheets import motion_sheets

        mechanism = mechanism.spoken(language).measured
        spoken = language_of(mechanism, language)
        return [SheetDocument(*part) for part in motion_sheets(mechanism, view, spoken)]
    mechanism = mechanism.spoken(language).measured
    spoken = language_of(mechanism, language)
    if mechanism.scene.sheet.sheets != len(SHEETS):
        raise SceneError.at(
            "sheet.sheets",
            message("one sheet for both plans is not drawn yet"),
            message("2, or left out"),
        )
    drawings = drawn_of(mechanism, spoken)
    sheets = [
        replace(each, unread=tuple(unread(drawing)) if drawing.kind in SHEETS else ())
        for each, drawing in zip(drawn_sheets(drawings, view), drawings, strict=True)
    ]
    if view not in CALCULATED:
        return sheets
    return [*sheets, SheetDocument("calculation", calculation(drawings, view))]


def calculation_text(mechanism: Mechanism, view: str = "key", language: str | None = None) -> str:
    """The calculation of a scene as a LaTeX document. Raises as ``hand_out`` does."""
    from graphkin.documents.calculation import calculation_tex

    mechanism = mechanism.spoken(language).measured
    return calculation_tex(drawn_of(mechanism, language_of(mechanism, language)), view)


def drawn_of(mechanism: Mechanism, spoken: Words) -> list[Drawing]:
    """The drawings of all sheets, proved by the independent route."""
    verdict = proved(mechanism, sheet_motion(mechanism))
    return with_forces(mechanism, drawings_of(mechanism, verdict, spoken))


def with_forces(mechanism: Mechanism, drawings: list[Drawing]) -> list[Drawing]:
    """The drawings, with that of the forces where the scene asks for reactions or the balance."""
    given = mechanism.scene.forces
    if given is None or not given.asked:
        return drawings
    from graphkin.documents.force_fields import force_drawing

    return [*drawings, force_drawing(mechanism, drawings)]


def drawn_sheets(drawings: Sequence[Drawing], view: str) -> list[SheetDocument]:
    """The numbered sheets of a mechanism's drawings in a view.

    Parts that do not fit on a key or a task go to continuation sheets.
    """
    if view in CALCULATED:
        from graphkin.documents.sheet import sheet, writing

        every = [(drawing, writing(drawing, view)) for drawing in drawings]
        more = [continued(drawing, view, own.moved, own.said) for drawing, own in every]
        total = sum(1 + len(sheets) for _, sheets in more)
        found, number = [], 0
        for (drawing, written), (later, sheets) in zip(every, more, strict=True):
            number += 1
            pages = [*sheet(drawing, view, f"{number}/{total}", written=written)]
            for marks in sheets:
                number += 1
                pages += as_pages(later, view, f"{number}/{total}", marks)
            found.append(SheetDocument(drawing.kind, tuple(pages)))
        return found
    total = len(drawings)
    return [
        SheetDocument(drawing.kind, by_itself(drawing, view, f"{i}/{total}"))
        for i, drawing in enumerate(drawings, 1)
    ]


def by_itself(drawing: Drawing, view: str, number: str) -> tuple[Page, ...]:
    """The pages of one drawing, step by step or as an overlay."""
    if view == "steps":
        from graphkin.documents.sheet import sheet_heading
        from graphkin.documents.step_pages import growing

        moved = frozenset(sheet_heading(drawing)[1])
        later, sheets = continued(drawing, view, moved)
        more = (as_pages(later, view, number, marks) for marks in sheets)
        return (*growing(drawing, number), *chain.from_iterable(more))

    return overlay(drawing, number)


def language_of(mechanism: Mechanism, language: str | None) -> Words:
    """The words of a language with the scene's signs. Raises SceneError if it is unknown."""
    code = language or mechanism.scene.sheet.language
    if code not in LANGUAGES:
        raise SceneError.at(
            "sheet.language", message('"{code}" is not a language', code=code), either(LANGUAGES)
        )
    return words(code, mechanism.scene.sheet.signs, mechanism.scene.base)


def proved(mechanism: Mechanism, solution: Solution) -> Verdict:
    """The verdict of the independent route. Raises WitnessError if it fails or is unreliable."""
    if solution.margin < FAIR:
        raise WitnessError(nearly_singular(mechanism))
    verdict = mechanism.witness(solution)
    if not verdict.agrees:
        raise WitnessError(disagreements(mechanism.scene, verdict))
    if verdict.unsure:
        raise WitnessError(lost(verdict))
    return verdict


def lost(verdict: Verdict) -> Problem:
    """The problem of quantities without a reliable digit; its place is the first of them."""
    return Problem(
        verdict.unsure[0],
        message(
            "no digit of it is sure: the rounding of doubles, which flat crossings and "
            "angles of many turns enlarge, exceeds it"
        ),
        message("crossings that are less flat, one after the other"),
        message("move the driver; no sheet is handed out"),
    )


def disagreements(scene: Scene, verdict: Verdict) -> Iterator[Problem]:
    """The reasons why the independent route disagrees: the numbers, the branches, or both."""
    refused = message("no sheet is handed out")
    if verdict.differs:
        difference = f"{verdict.largest_difference:.1e}"
        found = message(
            "construction and vector loops differ by {difference}", difference=difference
        )
        yield Problem(
            verdict.quantity, found, message("at most {limit:.1e}", limit=verdict.limit), refused
        )
    if verdict.branches:
        found = message(
            "{branches} does not hold by the vector loops",
            branches=verdict.not_as_stated(scene.branches),
        )
        yield Problem("branches", found, message("a construction that closes as stated"), refused)


def nearly_singular(mechanism: Mechanism) -> Problem:
    """The problem of lines that cross too flatly to be drawn: where, and what is nearly in line."""
    targets = dict.fromkeys(t for kind in SHEETS for t in targets_of(mechanism, kind))
    margins = mechanism.trace(targets or None).margins
    number = min(margins, key=lambda step: float(margins[step]))
    return Problem(
        "position",
        message(
            "the lines at {point} cross at a sine of {sine:.1e}, nearly singular",
            point=letter_of(mechanism.program, number),
            sine=float(margins[number]),
        ),
        message("at least {least:g}", least=FAIR),
        beside_dead_point(mechanism.scene, mechanism.program, number),
        about=(Sought(),),
        file=mechanism.scene.name,
    )


def drawings_of(
    mechanism: Mechanism, verdict: Verdict, spoken: Words, held: Scales | None = None
) -> list[Drawing]:
    """The drawings of all sheets, at one scale and with the mechanism at one place.

    The scale factors are those ``held``, whose layout is kept as well, or else those that fit best.
    """
    curves = curves_of(mechanism)
    chosen = held or scales(mechanism, curves)
    drawings = [
        drawing(mechanism, kind, found, chosen, verdict, spoken, curves)
        for kind in SHEETS
        if (found := targets_of(mechanism, kind))
    ]
    if not drawings:
        raise SceneError.at(
            "ask",
            message("asks for nothing that is drawn"),
            message("velocities, accelerations, centres …"),
        )
    stand = None if held else mechanism_field(drawings)
    return [replace(each, stand=stand, again=i > 0) for i, each in enumerate(drawings)]


# --- the key on a transparent ground --------------------------------------------------------------


HALF, GAP, STROKE = 3.0, 2.0, 3.0
"""Half the size of a cross, the gap outside it, and the stroke beyond the gap, in mm."""
FOOT = 10.0
"""Distance of the title above the frame's lower edge, where the task sheet has no words."""


def overlay(drawing: Drawing, number: str) -> tuple[Page, ...]:
    """Mechanism and plan of the key at the places and scale of the task sheet.

    Labels that the task sheet has are left out, since their places may differ on the key. Crosses
    mark the corners of the task sheet's frame, with crop marks outside them. The caption names the
    variant of the mechanism.
    """
    layout = lowered(drawing.paper, lay_out(drawing), sheet_heading(drawing, "task")[2])
    words, paper = drawing.words, drawing.paper
    tasks = boards(drawing, layout, "task")
    labels = (label for task in tasks for label in task.labels)
    known = {(label.name, cls) for label in labels for cls in (label.look, label.leader_look)}
    name = f"{title_of(drawing)} – {words('sheet.' + name_of_sheet(drawing))}"
    set_to = "".join(f", {each}" for each in variant(drawing.scene, words))
    rest = f"{set_to}, {words('sheet.overlay')} {number}, {words.decimal(drawing.scales.words)}"
    left, _, right, low = paper.areas[0]
    room = right - left - 24 - extent(rest, 2.5)[0]
    (first,), height = fitting("title", name, room, 2.5, 2.5)
    titles = [
        Text(own[0] + 12, low - FOOT, first + rest, "caption", height, name="title")
        for own in paper.areas
    ]
    marks = (
        *(
            untinted(mark)
            for mark in with_detail(*boards(drawing, layout, "key"))
            if (mark.name, mark.cls) not in known
        ),
        *(mark for own in paper.areas for mark in crop_marks(own)),
        *titles,
    )
    return tuple(
        Page(paper.across, paper.height, part, name, words.language, weight=weight_of(drawing))
        for part in parts_of(paper, marks)
    )


def untinted(mark: Mark) -> Mark:
    """A mark without its light tint, which would cover the drawing below."""
    if style_of(mark.cls).fill not in TINTS:
        return mark
    return replace(mark, cls=f"{mark.cls} {BARE}")


def crop_marks(rect: Rect) -> Iterator[Mark]:
    """A cross on each corner of a frame, with two strokes outside it that remain after a cut."""
    for x, outward in ((rect[0], -1), (rect[2], 1)):
        for y, down in ((rect[1], -1), (rect[3], 1)):
            near, far = HALF + GAP, HALF + GAP + STROKE
            yield LineMark(x - HALF, y, x + HALF, y, "border", "corner")
            yield LineMark(x, y - HALF, x, y + HALF, "border", "corner")
            yield LineMark(x + outward * near, y, x + outward * far, y, "border", "crop")
            yield LineMark(x, y + down * near, x, y + down * far, "border", "crop")


LEADING = 4.6
"""Distance of the lines of data in mm."""
BELOW, HEAD = 8.0, 6.0
"""Room above and below the heading of a part, in mm."""
INSIDE = 3.0
"""Clearance of tables and sentence numbers from the centring mark at the left, in mm."""
TIMES = (2.0, 1.5, 1.25, 1.0)
"""Possible enlargements of a plan that is drawn again."""
SMALLER = "A4"
"""The paper of a continuation that is no longer than one of its pages."""
LEAST = 60.0
"""Least room below the data in which tables that need more sheets begin, in mm."""


def continued(
    drawing: Drawing, view: str, moved: Set[Moved], said: int = 0
) -> tuple[Drawing, list[list[Mark]]]:
    """The continuation sheets, and the drawing on their paper.

    One A4 page where that is enough, in the frame of the sheet; else sheets of its size.
    """
    sheet = drawing.scene.sheet
    paper = drawing.paper
    larger = paper.frame.name in FRAMES and paper.name != SMALLER
    if moved and larger and Moved.AUXILIARY not in moved:
        smaller = replace(sheet, paper=SMALLER)
        own = replace(drawing, scene=replace(drawing.scene, sheet=smaller))
        sheets = rest(own, view, moved, said)
        if len(sheets) == 1 and len(as_pages(own, view, "1/1", sheets[0])) == 1:
            return own, sheets
    return drawing, rest(drawing, view, moved, said)


def rest(drawing: Drawing, view: str, moved: Set[Moved], said: int = 0) -> list[list[Mark]]:
    """The continuation sheets: one, or as many as the remaining parts need.

    The first ``said`` sentences are left out. Raises PageError where a sentence or a row of a table
    is longer than a sheet is wide.
    """
    if Moved.AUXILIARY in moved:
        return with_trials(drawing, rest(drawing, view, moved - {Moved.AUXILIARY}, said))
    if not moved:
        return []
    try:
        return [one_sheet(drawing, view, moved, said)]
    except PageError:
        others = moved - {Moved.CONSTRUCTION}
    try:
        sheets = [one_sheet(drawing, view, others, said)] if others else []
    except PageError:
        sheets = [*data_and_tables(drawing, view, others)]
    if Moved.CONSTRUCTION not in moved:
        return sheets
    head, x, y = title_line(drawing, drawing.words("page.continued"))
    top, paper = y + BELOW, drawing.paper
    left: Rect = (x + INSIDE, top + HEAD, paper.marked[0], paper.below[3] - 3.5)
    right: Rect = (paper.second, top + HEAD, paper.fields[2], low_of(paper))
    head = [*head, construction_head(drawing, x, top)]
    return [*sheets, *([*head, *marks] for marks in on_sheets(drawing, [left, right], said))]


def with_trials(drawing: Drawing, sheets: list[list[Mark]]) -> list[list[Mark]]:
    """The sheets with the plan next to the words of the last sheet, or on a sheet of its own.

    The plan is drawn as large as possible, with the names of its auxiliary points.
    """
    head, x, y = title_line(drawing, drawing.words("page.continued"))
    top, paper = y + BELOW, drawing.paper
    beside: Rect = (paper.second, top + HEAD, paper.fields[2], low_of(paper))
    last = sheets[-1] if sheets else head
    is_free = all(reach(mark)[2] < beside[0] or reach(mark)[3] < top for mark in last)
    marks = plan_with_trials(drawing, beside) if sheets and is_free else []
    if marks:
        return [*sheets[:-1], [*last, *marks]]
    left = beside[0] if paper.is_parted else x
    return [*sheets, [*head, *plan_with_trials(drawing, (left, *beside[1:]))]]


def plan_with_trials(drawing: Drawing, rect: Rect) -> list[Mark]:
    """The plan in a field, with the letters of its points; empty where it has no room."""
    layout, box, mm = lay_out(drawing), drawing.plan_extent(), 1000 / drawing.scales.kL
    room = rect[2] - rect[0] - 2 * MARGIN, rect[3] - rect[1] - 2 * ABOVE
    times = min(
        side / size for side, size in zip(room, (box.width * mm, box.height * mm), strict=True)
    )
    fits = next((each for each in TIMES if each <= times), None)
    if fits is None:
        return []
    plan = Field(rect, layout.plan.mm * fits, layout.plan.middle, centre(rect))
    large = Layout(layout.mechanism, plan, {})
    board = right_board(drawing, replace(large, spans=spans(drawing, large)), "key")
    board.marks = [mark for mark in board.marks if mark.name != HEADING]
    board.labels = [label for label in board.labels if label.letters or not label.spare]
    return [*plan_enlarged(drawing, rect, fits), *board.finish()]


def data_and_tables(drawing: Drawing, view: str, moved: Set[Moved]) -> Iterator[list[Mark]]:
    """The sheets of data too long for one sheet, and of tables, which begin below the data."""
    head, x, y = title_line(drawing, drawing.words("page.continued"))
    paper, low = drawing.paper, low_of(drawing.paper)
    room = int((low - y) / LEADING) + 1
    lines = continued_lines(drawing, view, moved, x)
    pages = [
        [Text(x, y + i * LEADING, line, "caption", 2.5, name="data") for i, line in enumerate(part)]
        for part in (lines[i : i + room] for i in range(0, len(lines), room))
    ]
    if Moved.TABLES not in moved:
        yield from ([*head, *part] for part in pages)
        return
    yield from ([*head, *part] for part in pages[:-1])
    last = pages[-1] if pages else []
    top = y + len(last) * LEADING + BELOW
    if top > low - LEAST:
        yield [*head, *last]
        last, top = [], y + BELOW
    left = x + INSIDE
    right = paper.left[2]
    rects: tuple[Rect, Rect] = (left, top, right, low), (left, y + BELOW, right, low)
    for marks in tables_on_sheets(drawing, *rects, empty=view == "task"):
        yield [*head, *last, *marks]
        last = []


def continued_lines(drawing: Drawing, view: str, moved: Set[Moved], x: float) -> list[str]:
    """The moved data, requests and links, in lines across a sheet from a place on."""
    words, width, lines = drawing.words, drawing.paper.left[2] - x - 3, list[str]()
    mark = words("clause_mark")
    if Moved.DATA in moved:
        first, *others = (datum.said for datum in data_of(drawing, view))
        lines += flowed([f"{words('page.data')}{words('colon')}{first}", *others], mark, width, 2.5)
    if Moved.ASKED in moved:
        first, *others = asked_words(drawing)
        lines += flowed(
            [f"{words('page.asked')}{words('colon')}{first}", *others], mark, width, 2.5
        )
    if Moved.MEMBERS in moved:
        lines.append(members(drawing))
    return [
        part
        for line in lines
        for part in ([line] if extent(line, 2.5)[0] <= width else cut(line, width))
    ]


def cut(line: str, width: float) -> list[str]:
    """A line divided between words into lines of a width in mm."""
    return flowed(narrow_words(line, width, 2.5), " ", width, 2.5)


def one_sheet(drawing: Drawing, view: str, moved: Set[Moved], said: int) -> list[Mark]:
    """The content of a single continuation sheet. Raises PageError where it does not fit."""
    marks, x, y = title_line(drawing, drawing.words("page.continued"))
    paper, low = drawing.paper, low_of(drawing.paper)
    if lines := continued_lines(drawing, view, moved, x):
        for line in lines:
            marks.append(Text(x, y, line, "caption", 2.5, name="data"))
            y += LEADING
        if y > low + LEADING:
            found = message("does not fit: {count} lines of data", count=len(lines))
            raise PageError.at("data", found, message("data for one sheet"))
    top = y + BELOW
    right: Rect = (paper.second, top, paper.fields[2], low)
    if Moved.CONSTRUCTION in moved:
        left: Rect = (x + INSIDE, top + HEAD, paper.marked[0], paper.below[3] - 3.5)
        beside = [] if Moved.TABLES in moved else [(right[0], left[1], *right[2:])]
        marks.append(construction_head(drawing, x, top))
        marks += in_columns(drawing, [left, *beside], said)
    if Moved.TABLES in moved:
        alone = Moved.CONSTRUCTION not in moved
        own: Rect = (x + INSIDE, top, paper.left[2], low) if alone else right
        marks += tables(drawing, own, empty=view == "task")
    return marks


def low_of(paper: SheetPaper) -> float:
    """The lower end of the right column, above the title block, in mm."""
    return paper.title_block[1] - 4


def as_pages(drawing: Drawing, view: str, number: str, marks: list[Mark]) -> tuple[Page, ...]:
    """The marks in the frame of a sheet."""
    return pages_of(drawing, title_block(drawing, view, number), marks)
