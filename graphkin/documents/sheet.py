"""A sheet: mechanism and plan side by side, data above, construction and tables below."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable, Iterable, Iterator, Sequence
from enum import Enum
from functools import partial
from itertools import accumulate, islice, pairwise
from math import ceil

from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction import step_marks
from graphkin.construction.core.component import crowded_pins
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.given_data import Datum, data
from graphkin.construction.core.kind import PlanPole, Sentence, construction
from graphkin.construction.core.layout import Layout, lay_out, lowered, spare_height
from graphkin.construction.core.naming import (
    has_plan,
    name_of_sheet,
    scale_of,
    stated_scale,
)
from graphkin.construction.core.paper_canvas import (
    PaperCanvas,
    Plot,
    above_foot,
    draw_curves,
    draw_part,
)
from graphkin.construction.core.program import Plane
from graphkin.construction.core.quantities import (
    ASKED,
    FORCE,
    PLANES,
    SHEETS,
    TRAVEL,
    WHOSE,
    request,
)
from graphkin.construction.core.relation import beside_plan, figure
from graphkin.construction.drivers import driver_symbols
from graphkin.construction.guides.slide_symbols import covered
from graphkin.construction.links import mechanism_symbols
from graphkin.construction.links.mechanism_symbols import settle_in_plates
from graphkin.construction.rate_relations import driven_bars, plan_scales
from graphkin.construction.result_tables import COMPUTED, tables
from graphkin.construction.velocity.relative_motion import TurnedVelocity
from graphkin.documents.detail import insets, parted
from graphkin.documents.listing import around_tables, first_part, listed
from graphkin.documents.scheme import scheme
from graphkin.documents.sentences import flattest_line, sentences
from graphkin.documents.signs import mechanism_signs, plan_signs
from graphkin.drawing.field import Rect, SheetPaper
from graphkin.drawing.frame import (
    CELLS,
    STUDENT,
    TitleBlock,
    check_bar,
    logo_box,
    sheet_frame,
    wrapped,
)
from graphkin.drawing.labels import FieldContent, FootNote, Label, at_bare_stretches, segment_of
from graphkin.drawing.marks import (
    LineMark,
    Mark,
    Page,
    Picture,
    Text,
    box,
    moved,
    reach,
    style_class,
)
from graphkin.drawing.richtext import are_clear, extent, flowed, words_of
from graphkin.drawing.style import VECTORS
from graphkin.drawing.symbol_markup import bar, escape, symbol
from graphkin.scene.house import THICK
from graphkin.scene.link_points import lettered
from graphkin.scene.model import Link
from graphkin.text import Words, names_in
from graphkin.text.errors import PageError, message

BLANK = ". . . . . . . . ."
"""Room to write in for values that a task does not reveal."""
HEADING = "heading"
"""The name of the lines of captions."""
CAPTION, ROWS = 2.5, 2
"""Height of captions in mm, and the most lines of one."""
LEAST = 1.8
"""Height in mm of the letters where more lines are needed."""
CAPTION_LEADING = 1.4
"""Distance of the lines of a caption, in heights of its letters."""
FOOT = 2.2
"""Distance of a caption's first line above its field, in mm.

It is clear of three lines of data; a second line of the lower letters ends above the marks that
begin 3 mm below the field's edge.
"""


def headlines(drawing: Drawing, layout: Layout, view: str) -> tuple[list[Mark], list[Mark]]:
    """The captions of both fields, of one height on both sheets of a mechanism.

    A task leaves the scale factors to be computed. A field without a plan has no caption.
    """
    own = said_above(drawing, drawing.kind if has_plan(drawing) else "", view)
    every = [*own, *(said for kind in others(drawing) for said in said_above(drawing, kind, view))]
    rects = layout.mechanism.rect, layout.plan.rect
    both = [(said, rects[i % 2]) for i, said in enumerate(every)]
    fits = all(len(lines(*each, CAPTION)) <= ROWS for each in both)
    height = CAPTION if fits else LEAST
    above = [caption(said, rect, height) if said else [] for said, rect in both[:2]]
    return above[0], above[1]


def others(drawing: Drawing) -> list[str]:
    """The kinds of the other sheets of a mechanism; one with accelerations has both sheets."""
    ask = drawing.scene.ask
    later = any(getattr(ask, q) for q, some in ASKED.items() if some[0].kind == SHEETS[1])
    return [kind for kind in SHEETS if later and kind != drawing.kind]


def said_above(drawing: Drawing, kind: str, view: str) -> tuple[str, str]:
    """The captions of a mechanism and of a kind of plan next to it, which may be missing.

    A task leaves a factor open unless it states the factor itself.
    """
    words, scales, task = drawing.words, drawing.scales, view == "task"
    kL = stated_scale(drawing, BLANK if task else "")
    if kind == FORCE:
        above = words("page.loads_heading", scale=words.decimal(scales.words), kL=kL)
        return above, words("page.force_heading", k=figure(drawing, scales.kF / 1000))
    beside = beside_plan(drawing, kind) if kind else ""
    kL = words.clauses(filter(None, (kL, beside)))
    mechanism = words("page.mechanism_heading", scale=words.decimal(scales.words), kL=kL)
    if not kind:
        return mechanism, ""
    sought = task and dict(zip(SHEETS, plan_scales(drawing), strict=True))[kind].symbols
    k = BLANK if sought else figure(drawing, scale_of(drawing, PLANES[kind]) / 1000)
    return mechanism, words(f"page.{kind}_heading", k=k)


def plan_enlarged(drawing: Drawing, rect: Rect, times: float) -> list[Mark]:
    """The caption of a plan that is drawn again, enlarged and with auxiliary points."""
    words, factor = drawing.words, scale_of(drawing, drawing.plane) / 1000
    said = words(f"page.{drawing.kind}_heading", k=figure(drawing, factor / times))
    larger = "" if times == 1 else words("page.as_large", m=figure(drawing, times))
    return caption(f"{said}  {words('page.with_trials')}{larger}", rect, CAPTION)


def lines(said: str, rect: Rect, height: float) -> list[str]:
    """The lines of a field's caption; the part in brackets takes a second line if necessary."""
    room = rect[2] - rect[0] - 5
    if extent(said, height)[0] <= room:
        return [said]
    parts = said.split("  ")
    if max(extent(part, height)[0] for part in parts) <= room:
        return parts
    return flowed(words_of(" ".join(parts)), " ", room, height)


def caption(said: str, rect: Rect, height: float) -> list[Mark]:
    """A field's caption in letters of a height; the first lines of both fields are level."""
    first = rect[1] - FOOT
    return [
        Text(
            rect[0] + 3, first + CAPTION_LEADING * height * i, line, "caption", height, name=HEADING
        )
        for i, line in enumerate(lines(said, rect, height))
    ]


def apart(marks: Sequence[Mark]) -> tuple[str, list[Mark]]:
    """The markup of a field's caption, empty without one, and the other marks of the field."""
    lines = [mark.markup for mark in marks if isinstance(mark, Text) and mark.name == HEADING]
    return " ".join(lines), [mark for mark in marks if mark.name != HEADING]


# --- the data at the head of a sheet --------------------------------------------------------------


NAME = "data"
"""The name of the marks of the data."""
LETTERS, ROW, BASE, PAD = 2.5, 4.5, 3.1, 3.0
"""Sizes of the table in mm: letters, least row height, least depth of a baseline, side margins."""
CLEAR = 0.3
"""Clearance of characters from the lines of the table above and below, in mm."""
ABOVE = 2.6
"""Start of the table above the baseline of the first line, in mm."""
GAP = 5.0
"""Distance of the words from the table in mm."""
BESIDE = {1: (ROW, 2.75), 2: (ROW, 0.5), 3: (3.6, -0.2)}
"""By the number of lines next to the table, at most three: their distance and offset, in mm.

The offset is from the baseline of the first line: one line is centred on the table, two are level
with its rows, three are as high as the table.
"""
BETWEEN = 1.2
"""Distance of tables of data one below another, and of the lines below them, in mm."""
SPACED, CLOSE = 4.2, 3.85
"""Distance of two lines of data without a table, and of more lines, in mm."""
AIR = 1.0
"""Extra distance in mm of the captions from many lines of data: both may have large letters."""
SHORTER = (0.0, *range(4, 49, 4))
"""Reductions of line width tried in mm, until no characters touch."""

TITLE = 3.5
"""Height of the letters of a title, in mm."""
UNDER = 7.2
"""Distance of the lowest line from the fields in mm: captions, in two lines if necessary."""


def data_heading(
    drawing: Drawing, view: str, x: float, y: float, spare: Callable[[], float] = float
) -> list[Mark]:
    """The data from a point on, whose y is the baseline of the first line.

    ``spare`` is the height in mm that the drawings leave free below the captions. Many lines of
    data extend into it, and the captions move down. Raises PageError where the data do not fit.
    """
    found, mark = data_of(drawing, view), drawing.words("clause_mark")
    return (
        in_table(drawing.paper, mark, found, x, y)
        or in_tables(drawing.paper, mark, found, x, y, spare)
        or in_lines(drawing, found, x, y, spare)
    )


def data_of(drawing: Drawing, view: str) -> Sequence[Datum]:
    """The data of a sheet: of the motion, or of the loads."""
    if drawing.kind == FORCE:
        from graphkin.documents.sentences import force_data

        return force_data(drawing, solved=view != "task")
    return data(drawing, solved=view != "task", laws=True)


def in_table(
    paper: SheetPaper, mark: str, found: Sequence[Datum], x: float, y: float
) -> list[Mark]:
    """A table of the values with the other data next to it; empty where there is no room.

    The other data are clauses with a ``mark`` between them.
    """
    valued = [datum for datum in found if datum.value]
    said = [datum.remark for datum in found if datum.remark]
    widths = [*map(width_of, valued)]
    rows = [
        row_for([getattr(datum, part) for datum in valued]) for part in ("name", "value") if valued
    ]
    if y - ABOVE + sum(height for height, _ in rows) > lowest(paper):
        return []
    left = x + sum(widths) + GAP
    room = paper.left[2] - 3 - left
    if not valued or room < max((extent(piece, LETTERS)[0] for piece in said), default=0.0):
        return []
    lines = flowed(said, mark, room, LETTERS)
    leading, low = BESIDE.get(len(lines), (0.0, 0.0))
    if lines and not (leading and are_clear(lines, LETTERS, leading)):
        return []
    return [
        *ruled(valued, widths, rows, x, y - ABOVE),
        *(
            Text(left, y + low + leading * i, line, "caption", LETTERS, name=NAME)
            for i, line in enumerate(lines)
        ),
    ]


def in_tables(
    paper: SheetPaper,
    mark: str,
    found: Sequence[Datum],
    x: float,
    y: float,
    spare: Callable[[], float],
) -> list[Mark]:
    """Tables of the values one below another, the other data in lines below them.

    Empty where the drawings do not leave their height.
    """
    valued = [datum for datum in found if datum.value]
    width, top = paper.left[2] - x - 3, y - ABOVE
    lines = spread([d.remark for d in found if d.remark], mark, width, LETTERS, CLOSE)
    widest = [*map(width_of, valued), *(extent(line, LETTERS)[0] for line in lines)]
    if not valued or max(widest) > width:
        return []
    marks: list[Mark] = []
    for block in blocks(valued, width):
        widths = [*map(width_of, block)]
        rows = [row_for([getattr(datum, part) for datum in block]) for part in ("name", "value")]
        marks += ruled(block, widths, rows, x, top)
        top += sum(height for height, _ in rows) + BETWEEN
    marks += [
        Text(x, top + ABOVE + CLOSE * i, line, "caption", LETTERS, name=NAME)
        for i, line in enumerate(lines)
    ]
    beyond = height_beyond(paper, marks)
    return marks if not beyond or beyond <= spare() else []


def blocks(valued: Sequence[Datum], width: float) -> Iterable[Sequence[Datum]]:
    """Data in as few rows of a width as hold them, about equally long."""
    every = [*accumulate(map(width_of, valued), initial=0.0)]
    count = ceil(every[-1] / width)
    while True:
        ends = [bisect_left(every, every[-1] * i / count) for i in range(count)]
        ends.append(len(valued))
        if all(every[end] - every[start] <= width for start, end in pairwise(ends)):
            return (valued[start:end] for start, end in pairwise(ends))
        count += 1


def width_of(datum: Datum) -> float:
    """The width of a column of the table, in mm."""
    return PAD + max(extent(markup, LETTERS)[0] for markup in (datum.name, datum.value))


def row_for(texts: Sequence[str]) -> tuple[float, float]:
    """The height of a row of texts, and the depth of its baseline, in mm."""
    _, tops, bottoms = zip(*(extent(text, LETTERS) for text in texts), strict=True)
    base = max(BASE, CLEAR - min(tops))
    return max(ROW, base + max(bottoms) + CLEAR), base


def ruled(
    valued: Sequence[Datum],
    widths: Sequence[float],
    rows: Sequence[tuple[float, float]],
    x: float,
    top: float,
) -> Iterator[Mark]:
    """The table: names above values, in rows of a height with their baselines."""
    (upper, named), (lower, below) = rows
    middle, low, right = top + upper, top + upper + lower, x + sum(widths)
    yield box(x, top, right - x, upper, "shade")
    for y in (top, middle, low):
        yield LineMark(x, y, right, y, "panel")
    yield LineMark(x, top, x, low, "panel")
    for datum, width in zip(valued, widths, strict=True):
        for y, markup in ((top + named, datum.name), (middle + below, datum.value)):
            yield Text(x + width / 2, y, markup, "table", LETTERS, "middle", NAME)
        x += width
        yield LineMark(x, top, x, low, "panel")


def in_lines(
    drawing: Drawing, found: Sequence[Datum], x: float, y: float, spare: Callable[[], float]
) -> list[Mark]:
    """All data in lines that end where their characters are clear of each other.

    More lines than usual extend down as far as the drawings leave room; otherwise long data may be
    divided within a piece. All lines stay clear of the fields'
    captions, even below a title of two lines.
    """
    first, *pieces = (datum.said for datum in found)
    pieces = [f"{drawing.words('page.data')}{drawing.words('colon')}{first}", *pieces]
    paper = drawing.paper
    width = paper.left[2] - x - 3
    between = drawing.words("clause_mark")
    parted = words_of(between.join(pieces))
    for i, (leading, room) in enumerate(looks(lowest(paper) - y, spare)):
        for parts, mark in ((pieces, between), (parted, " "))[: 1 + (i > 1)]:
            lines = spread(parts, mark, width, LETTERS, leading)
            if len(lines) <= room and all(extent(line, LETTERS)[0] <= width for line in lines):
                return [
                    Text(x, y + row * leading, line, "caption", LETTERS, name=NAME)
                    for row, line in enumerate(lines)
                ]
    raise PageError.at(
        "data",
        message("does not fit: {count} lines", count=len(lines)),
        message("fewer lines above the drawings"),
        message("shorten names and notes, or split the scene"),
    )


def spread(
    parts: Sequence[str], mark: str, width: float, height: float, leading: float
) -> list[str]:
    """Pieces in lines of at most a width, chosen so that their characters are clear if possible."""
    every = (flowed(parts, mark, width - less, height) for less in SHORTER)
    first = next(every)
    return next((lines for lines in (first, *every) if are_clear(lines, height, leading)), first)


def lowest(paper: SheetPaper) -> float:
    """The baseline of the lowest line of data in mm."""
    return paper.fields[1] - UNDER


def looks(room: float, spare: Callable[[], float]) -> Iterator[tuple[float, int]]:
    """The possible forms of lines in a room above the captions: distance in mm, and number.

    First the preferred form, then lines down to the drawings.
    """
    yield SPACED, 2
    yield CLOSE, rows(room, CLOSE)
    yield CLOSE, rows(room + spare() - AIR, CLOSE)


def height_beyond(paper: SheetPaper, marks: Sequence[Mark]) -> float:
    """The extra height of data beyond the room above the fields, in mm."""
    low = max((mark.y for mark in marks if isinstance(mark, Text)), default=0.0)
    beyond = low - lowest(paper)
    return beyond + AIR if beyond > 0 else 0.0


def rows(height: float, leading: float) -> int:
    """The number of lines whose baselines fit into a height."""
    return int(height / leading + 1e-9) + 1


# --- the links of a mechanism in one line: their points, blocks and wheels ------------------------


def members(drawing: Drawing) -> str:
    """The links by their numbers and the points that they join, as in a task."""
    words, scene = drawing.words, drawing.scene.bare
    links = [f"{escape(name)} = {of_link(words, link)}" for name, link in scene.links.items()]
    for centre, follower in scene.cam_centres.items():
        cam = escape(scene.cams[follower].on)
        links.append(words("page.member_centre", point=drawing.symbol(centre), g=cam))
    return words("page.members", list=words("list_mark").join(links))


def of_link(words: Words, link: Link) -> str:
    """The points of a link in order; a link with a single point is a block, or a wheel on it."""
    points = "".join(symbol(point) for point in link.points)
    if link.slides and len(link.points) < 2:
        return words("page.member_block", points=points)
    if link.wheels:
        return words("page.member_wheel", points=points)
    return points


# --- the scale of a task's plan: the rule that the crank gives, or a value ------------------------


def plan_at(drawing: Drawing) -> str:
    """The sentence for the scale of a task's plan; empty without a plan."""
    if drawing.kind == FORCE:
        return drawing.words("task.forces", k=figure(drawing, drawing.scales.kF / 1000))
    if not has_plan(drawing):
        return ""
    return drawing.words("task.plan", rule=", ".join(rules(drawing)))


def rules(drawing: Drawing) -> Iterator[str]:
    """The scale of a plan: by the crank, with the segment equal to the crank, or by value.

    A plan without the velocity of a crank pin has no segment equal to the crank.
    """
    scales, first = drawing.scales, drawing.kind == "velocity"
    kv, ka = plan_scales(drawing)
    rule = kv if first else ka
    m = figure(drawing, scales.of_bar(drawing.kind))
    yield f"{rule.left} = {rule.symbols or f'{rule.result} {drawing.words.unit(rule.unit)}'}"
    if first and scales.of_crank:
        for p, q in islice(driven_bars(drawing, drawing.scene.drivers[0]), 1):
            times = "" if m == "1" else f"{m}·"
            yield drawing.in_signs(f"{segment(drawing, q)} = {times}{bar(p, q)}/*k*_L")


def segment(drawing: Drawing, pin: str) -> str:
    """The velocity of the crank's pin in the plan, by the letters of its ends."""
    for _, step, _ in drawing.steps(Plane.VELOCITIES):
        kind = construction(step)
        if isinstance(kind, TurnedVelocity) and kind.q == pin:
            return drawing.symbol(drawing.pole) + drawing.symbol(step.name)
    raise KeyError(pin)


# --- a sheet: mechanism and plan side by side, data above, construction and tables below ----------


LEADING = 4.6
"""Distance of lines of text in mm."""
CROWD = 3
"""Number of triangles at one pin from which they are shown enlarged."""
MANY = 24
"""Number of named auxiliary points from which their names go to a continuation sheet."""
CUT = 3.0
"""Distance below the fields' upper edges at which guides and loci begin, in mm."""
RAISED = (*VECTORS, "arrowhead")
"""Marks drawn above bars and pins, to show where vectors begin and where they point."""


class Moved(Enum):
    """The parts that go to a continuation sheet where they do not fit; values are keys of words."""

    DATA = "data"
    ASKED = "asked"
    MEMBERS = "members"
    CONSTRUCTION = "construction"
    TABLES = "tables"
    AUXILIARY = "auxiliary"


class Writing(Struct, frozen=True):
    """The text above and below the drawings of a sheet, and the parts that do not fit.

    The first ``said`` sentences of a long construction fit on this sheet; the rest are moved. Many
    lines of data take ``more`` height, in mm, from the fields below.
    """

    head: list[Mark]
    foot: list[Mark]
    moved: frozenset[Moved]
    said: int = 0
    more: float = 0.0


def sheet(
    drawing: Drawing,
    view: str,
    number: str,
    layout: Layout | None = None,
    written: Writing | None = None,
) -> tuple[Page, ...]:
    """The pages of a sheet: the complete key, or the task without any result."""
    written = written or writing(drawing, view)
    layout = lowered(drawing.paper, layout or lay_out(drawing), written.more)
    (left, detail, _), (right, other, _) = parted(*boards(drawing, layout, view))
    if view != "task":
        detail += insets(drawing, layout.mechanism, [*left, *detail])
        detail += mechanism_signs(drawing, layout.mechanism, [*left, *detail])
        other += plan_signs(drawing, layout.plan, [*right, *other])
    block = title_block(drawing, view, number)
    marks: list[Mark] = [
        *written.head,
        *(*left, *detail, *right, *other),
        *panels(drawing.paper, layout),
        *written.foot,
    ]
    return pages_of(drawing, block, marks)


def pages_of(
    drawing: Drawing, block: TitleBlock, marks: Iterable[Mark], title: str = ""
) -> tuple[Page, ...]:
    """The pages of a sheet in their frames, with the logo of the school in the title block.

    A sheet on two leaves has two pages, the second one only if it has more than its title.
    """
    paper = drawing.paper
    parts = [*parts_of(paper, marks)]
    if paper.is_parted and all(reach(mark)[3] < lowest(paper) for mark in parts[-1]):
        del parts[-1]
    return tuple(
        page_in(paper.leaf, drawing, of_leaf(block, i, len(parts)), part, title)
        for i, part in enumerate(parts)
    )


def page_in(
    paper: SheetPaper,
    drawing: Drawing,
    block: TitleBlock,
    marks: Iterable[Mark],
    title: str = "",
    drawn: Rect | None = None,
) -> Page:
    """One page of a paper: marks in its frame, with the logo of the school in the title block."""
    return Page(
        paper.width,
        paper.height,
        (*sheet_frame(block, paper), *marks),
        title or page_title(drawing),
        drawing.words.language,
        pictures(drawing, block),
        weight_of(drawing),
        drawn or paper.fields,
    )


def parts_of(paper: SheetPaper, marks: Iterable[Mark]) -> Iterator[tuple[Mark, ...]]:
    """The marks on each leaf, moved to its own page."""
    if not paper.is_parted:
        yield tuple(marks)
        return
    every = [(int(sum(reach(mark)[::2]) / 2 / paper.across), mark) for mark in marks]
    for i in range(paper.leaves):
        yield tuple(
            moved(mark, -i * paper.across, 0) if i else mark for at, mark in every if at == i
        )


LEAVES = "AB"
"""The letters of the leaves of a sheet, in the title block after its number."""


def of_leaf(block: TitleBlock, leaf: int, count: int) -> TitleBlock:
    """The title block of a leaf; that of a single page is unchanged."""
    if count == 1:
        return block
    number, _, total = block.sheet.partition("/")
    return replace(block, sheet=f"{number}{LEAVES[leaf]}/{total}")


def weight_of(drawing: Drawing) -> float:
    """The factor of a school on the widths of lines."""
    return drawing.scene.house.thick / THICK


def page_title(drawing: Drawing) -> str:
    return f"{title_of(drawing)} – {drawing.words('sheet.' + name_of_sheet(drawing))}"


def panels(paper: SheetPaper, layout: Layout) -> list[Mark]:
    """The lines between the mechanism, the plan and the part below them."""
    (x, top), low = layout.plan.rect[:2], paper.foot
    if paper.is_parted:
        both = paper.left, paper.right
        return [LineMark(left, low, right, low, "panel") for left, _, right, _ in both]
    return [
        LineMark(x, top - 6, x, low - 2, "panel"),
        LineMark(paper.fields[0], low, paper.fields[2], low, "panel"),
    ]


def title_of(drawing: Drawing) -> str:
    """The scene's title in the sheet's language."""
    return drawing.scene.title_in(drawing.words.language)


def title_block(drawing: Drawing, view: str, number: str) -> TitleBlock:
    """The fields of the title block."""
    words, sheet = drawing.words, drawing.scene.sheet
    house = drawing.scene.house
    names = (*(name for name, _, _ in CELLS), "size")
    labels = {name: house.labels.get(name) or words(f"block.{name}") for name in names}
    if view == "task" or sheet.student:
        labels[STUDENT] = words("task.person")
    return TitleBlock(
        legal_owner=sheet.owner,
        title=title_of(drawing),
        creator=sheet.author,
        student=sheet.student,
        approved_by=sheet.approved,
        document_type=words(
            f"sheet.document_{name_of_sheet(drawing)}", view=words(f"sheet.{view}")
        ),
        identification=sheet.number,
        date_of_issue=sheet.date,
        sheet=number,
        language=words.language,
        scale=words.decimal(drawing.scales.words),
        labels=labels,
        logo=house.logo.aspect if house.logo else 0.0,
        frame=drawing.paper.frame,
        size=drawing.paper.name.removeprefix("ANSI "),
    )


def pictures(drawing: Drawing, block: TitleBlock) -> tuple[Picture, ...]:
    """The logo of the school in the title block of a sheet."""
    logo = drawing.scene.house.logo
    if logo is None:
        return ()
    left, top, right, bottom = logo_box(block)
    x, y = drawing.paper.leaf.title_block[:2]
    return (Picture(x + left, y + top, right - left, bottom - top, logo.data, logo.kind),)


def sheet_heading(drawing: Drawing, view: str = "key") -> tuple[list[Mark], set[Moved], float]:
    """The sheet's title and data, the parts that do not fit, and extra height in mm."""
    marks, x, y = title_line(drawing)

    def made() -> list[Mark]:
        return data_heading(drawing, view, x, y, lambda: spare_above(drawing))

    data, moved = with_room(drawing, Moved.DATA, made, x, y)
    return [*marks, *data], moved, height_beyond(drawing.paper, data)


def spare_above(drawing: Drawing) -> float:
    """The height in mm by which the fields' upper edges may be lowered without cutting the key.

    On leaves it is that of the mechanism's field, since the data are above it alone.

    Guides and lines without end, which extend to the edges, are not counted.
    """
    most = spare_height(drawing)
    if most <= AIR:
        return 0.0
    layout, paper = lay_out(drawing), drawing.paper
    both = [left_board(drawing, layout, "key")]
    both += [] if paper.is_parted else [right_board(drawing, layout, "key")]
    tops = (reach(mark)[1] for board in both for mark in board.marks if mark.name != HEADING)
    drawn = (top for top in tops if top > paper.fields[1] + CUT + 0.5)
    above = min(drawn, default=paper.foot) - CUT - paper.fields[1]
    return max(min(most, above), 0.0)


def title_line(
    drawing: Drawing, remark: str = "", named: str = ""
) -> tuple[list[Mark], float, float]:
    """The sheet's title, the bar that checks the print, and the place where the data may begin.

    Velocity and acceleration sheets have titles with equally many lines. A title has one line, or
    two of small lettering that stay clear of the frame and the data. A continuation sheet, with a
    ``remark``, has room for two lines of the usual lettering. A sheet may be ``named`` otherwise
    than after its plan.
    """
    words, paper = drawing.words, drawing.paper
    left, top, most_wide = paper.fields[0] + 2, paper.area[1] + paper.lowered, paper.title
    kinds = dict.fromkeys((name_of_sheet(drawing), "velocity", "acceleration"))
    called = [named] if named else [words(f"sheet.{kind}") for kind in kinds]
    name, *others = (f"{each} – {title_of(drawing)}{remark}" for each in called)
    longest = max((name, *others), key=lambda each: extent(escape(each), TITLE)[0])
    most = ((TITLE, 2 if remark else 1), (LETTERS, 2))
    height = next((h for h, few in most if len(wrapped(longest, most_wide, h)) <= few), LEAST)
    lines, rows = wrapped(name, most_wide, height), len(wrapped(longest, most_wide, height))
    low, data = top + 7.6, top + 12.4
    if rows > 1:
        low, data = (top + 12.5, top + 18.0) if remark else (top + 8.6, top + 13.4)
    marks: list[Mark] = [
        Text(left, low - 1.4 * height * (len(lines) - 1 - i), line, "title", height, name="title")
        for i, line in enumerate(lines)
    ]
    end, y = paper.left[2], paper.area[1] + (9.5 if paper.lowered else 5.0)
    marks += check_bar(end - 106, y)
    said = words_of(words("page.check_bar"))
    beside = flowed(said, " ", end - 109 - left, LETTERS)
    marks += [
        Text(end - 109, y + CLOSE * (i + 1 - len(beside)), line, "check-bar", LETTERS, "end")
        for i, line in enumerate(beside)
    ]
    if paper.is_parted:
        marks += [moved(mark, paper.across, 0) for mark in marks]
    return marks, left, data


def with_room(
    drawing: Drawing, part: Moved, made: Callable[[], Iterable[Mark]], x: float, y: float
) -> tuple[list[Mark], set[Moved]]:
    """The marks of a part; where they have no room, a line that says where the part is."""
    try:
        return list(made()), set()
    except PageError:
        words = drawing.words
        where = f"{words(f'page.{part.value}')}{words('colon')}{words('page.moved')}"
        return [Text(x, y, where, "caption", 2.5, name="moved")], {part}


def writing(drawing: Drawing, view: str) -> Writing:
    """The text above and below the drawings of a sheet."""
    head, moved, lower = sheet_heading(drawing, view)
    foot, more, said = below(drawing, view)
    if view == "key" and has_many_auxiliary(drawing):
        moved.add(Moved.AUXILIARY)
    return Writing(head, foot, frozenset(moved | more), said, lower)


def left_board(drawing: Drawing, layout: Layout, view: str) -> FieldContent:
    """The mechanism's field."""
    field = layout.mechanism
    words = drawing.words
    board = FieldContent(field.rect, unnamed=words("page.unnamed"), between=words("clause_mark"))
    board.marks += headlines(drawing, layout, view)[0]
    if view == "task":
        mechanism_symbols.draw_frame(board, drawing, field)
        return board
    plot = Plot(board, field, drawing, layout)
    mechanism_symbols.draw_plates(board, drawing, field)
    draw_curves(board, drawing, field, above_foot(field.rect))
    step_marks.draw_mechanism_steps(plot, found=True)
    step_marks.draw_closing_arcs(plot)
    loci = list(board.marks)
    mechanism_symbols.draw_ground(board, drawing, field)
    mechanism_symbols.draw_guides(board, drawing, field)
    raise_marks(board, covered(loci, board.marks))
    below = len(board.marks)
    mechanism_symbols.draw_upper(board, drawing, field)
    above = len(board.marks)
    step_marks.draw_mechanism_steps(plot, found=False)
    thin = [mark for mark in board.marks[above:] if is_thin(mark)]
    drawn = [mark for mark in board.marks[above:] if not is_thin(mark)]
    board.marks[below:] = [*thin, *board.marks[below:above], *drawn]
    if drawing.kind == "velocity":
        driver_symbols.draw_drivers(board, drawing, field)
    mechanism_symbols.draw_pins(board, drawing, field)
    board.crowds += [field(pin) for pin in crowded_pins(drawing, CROWD)]
    board.labels = at_bare_stretches(board.labels, board.marks)
    raise_marks(board, vectors(board.marks))
    return board


def boards(
    drawing: Drawing, layout: Layout, view: str, said: Sequence[Sentence] = ()
) -> tuple[FieldContent, FieldContent]:
    """Both fields; construction letters that no sentence mentions may be dropped.

    Many auxiliary points have no letters, except on the step pages, whose sentences are ``said``.
    """
    both = left_board(drawing, layout, view), right_board(drawing, layout, view)
    settle_in_plates(both[0])
    letters = [x for x in both[0].labels if x.cls == "construction" and not segment_of(x)]
    if letters:
        mentioned = {name for each in said or sentences(drawing) for name in names_in(each.markup)}
        both[0].dispensable = [label for label in letters if label.name not in mentioned]
        both[0].labels = [x for x in both[0].labels if x not in both[0].dispensable]
    if view == "key" and not said and has_many_auxiliary(drawing):
        both[1].labels = [*without_auxiliary(drawing, both[1].labels)]
        both[1].notes.append(FootNote(drawing.words("page.trials_moved")))
    return both


def has_many_auxiliary(drawing: Drawing) -> bool:
    """Whether there are so many named auxiliary points that they get a sheet of their own."""
    steps = drawing.trace.program.steps
    return sum(bool(steps[number].name) for number in drawing.auxiliary) >= MANY


def without_auxiliary(drawing: Drawing, labels: Iterable[Label]) -> Iterator[Label]:
    """The labels of a plan without the letters of auxiliary points."""
    steps = drawing.trace.program.steps
    auxiliary = {steps[number].name for number in drawing.auxiliary}
    for label in labels:
        kept = [letter for letter in label.letters if letter.name not in auxiliary]
        if len(kept) == len(label.letters):
            yield label
        elif kept:
            alone = label.of_letters((replace(kept[0], joint=""), *kept[1:]))
            yield replace(alone, cls=drawing.kind)


def is_thin(mark: Mark) -> bool:
    """Whether a mark is a construction line, which lies below bars that it runs along."""
    return isinstance(mark, LineMark) and mark.cls in ("construction", "ray")


def raise_marks(board: FieldContent, some: Sequence[Mark]) -> None:
    """Move some marks above all others drawn so far."""
    raised = {id(mark) for mark in some}
    board.marks = [*(mark for mark in board.marks if id(mark) not in raised), *some]


def vectors(marks: Sequence[Mark]) -> list[Mark]:
    """The vectors of steps with their heads."""
    own = {(m.step, m.name) for m in marks if m.step is not None and style_class(m) in VECTORS}
    return [m for m in marks if (m.step, m.name) in own and style_class(m) in RAISED]


def right_board(drawing: Drawing, layout: Layout, view: str) -> FieldContent:
    """The plan's field."""
    field = layout.plan
    words = drawing.words
    board = FieldContent(field.rect, unnamed=words("page.unnamed"), between=words("clause_mark"))
    board.marks += headlines(drawing, layout, view)[1]
    if drawing.kind == FORCE:
        from graphkin.documents.force_fields import draw_fields

        board.detailed = False
        draw_fields(board, drawing, layout, view)
        board.labels = at_bare_stretches(board.labels, board.marks)
        return board
    plot = Plot(board, field, drawing, layout)
    if view == "task":
        for number, step, _ in drawing.steps(drawing.plane):
            if isinstance(pole := construction(step), PlanPole):
                draw_part(PaperCanvas(plot, number), pole)
        return board
    step_marks.draw_plan_steps(plot)
    board.labels = at_bare_stretches(board.labels, board.marks)
    return board


def below(drawing: Drawing, view: str) -> tuple[list[Mark], set[Moved], int]:
    """The part below the drawings: construction, tables, check bar, and residual check.

    Also returns the parts that do not fit, and the number of sentences that fit where not all do.
    """
    moved, said = set[Moved](), 0
    paper = drawing.paper
    left, top, _, low = paper.below
    left += 2
    found, more, wider = placed_tables(drawing, view)
    width = paper.writing - wider - left - 2
    checks = [] if view == "task" else checked_lines(drawing, width)
    first = low + 0.4 - CLOSE * (len(checks) - 1)
    if view == "key":
        try:
            listing = listed(drawing, left, top + 10.5, width, first - 3.9)
        except PageError:
            listing, said, found = beside_tables(drawing, (left, top + 10.5, first - 3.9))
            if said < len(sentences(drawing)):
                moved.add(Moved.CONSTRUCTION)
        marks = [construction_head(drawing, left, top + 4.5), *listing]
    else:
        marks, moved = wanted(drawing, left, top)
    marks += found
    moved |= more
    if view == "task":
        return marks, moved, said
    marks += [
        Text(left, first + CLOSE * i, text, "caption", LETTERS, name="witness")
        for i, text in enumerate(checks)
    ]
    return [*marks, *flattest_line(drawing, left + extent(checks[-1], LETTERS)[0])], moved, said


SPARE = (0.0, *range(5, 31, 5))
"""Heights in mm below the tables of a key that are tried where sentences go on there."""


def beside_tables(
    drawing: Drawing, column: tuple[float, float, float]
) -> tuple[list[Mark], int, list[Mark]]:
    """The sentences of a long construction, how many of them fit, and the tables beside them.

    ``column`` has the left end of the sentences, their first baseline and their lowest one. The
    tables are as low as the sentences that go on below them need.
    """
    paper, (left, top, low) = drawing.paper, column
    best: tuple[list[Mark], int, list[Mark]] = ([], -1, [])
    for spare in SPARE:
        found, moved, wider = placed_tables(drawing, "key", spare)
        if spare and moved:
            break
        width = paper.writing - wider - left - 2
        place = left, top, min(left + width, paper.marked[0]), low
        part = first_part(drawing, left, top, width, low)
        listing, said = around_tables(drawing, place, below_tables(paper, found), part)
        if said > best[1]:
            best = listing, said, found
        if said == len(sentences(drawing)):
            break
    return best


WIDER = (0.0, 4.0, 8.0, 12.0, 16.0, 20.0, 24.0, 28.0)
"""Extra widths of the tables beside sentences that are tried, in mm."""


def placed_tables(
    drawing: Drawing, view: str, spare: float = 0.0
) -> tuple[list[Mark], set[Moved], float]:
    """The tables, the part that does not fit, and how much wider than usual they are, in mm.

    Tables beside the sentences of a key take some of their width where they need it, and leave a
    ``spare`` height free.
    """
    paper, task = drawing.paper, view == "task"
    left, *others = paper.empty_tables if task else paper.tables
    where = paper.tables[0], paper.tables[1] + 4.5
    for wider in WIDER[: 1 if task or paper.is_leaf else None]:
        rect: Rect = (left - wider, others[0], others[1], others[2])
        made = partial(tables, drawing, rect, empty=task, spare=spare)
        found, moved = with_room(drawing, Moved.TABLES, made, *where)
        if not moved:
            return found, moved, wider
    return found, moved, 0.0


def below_tables(paper: SheetPaper, found: Sequence[Mark]) -> Rect | None:
    """The room for sentences between the tables and the title block, or the notes above it.

    The top is the first baseline. None where there is no room for two lines.
    """
    notes = [mark.y - LEADING for mark in found if isinstance(mark, Text) and mark.name == COMPUTED]
    ends = (reach(mark)[3] for mark in found if mark.name != COMPUTED)
    top, low = max(ends, default=paper.tables[1]) + LEADING + 1, min(notes, default=paper.tables[3])
    if low - 1 - top < LEADING:
        return None
    return paper.tables[0] + 2, top, paper.tables[2], low - 1


def checked(drawing: Drawing) -> list[str]:
    """The difference of the independent route; of forces one sentence for each route."""
    if drawing.kind == FORCE:
        from graphkin.documents.sentences import checked as checked_forces

        return [*checked_forces(drawing)]
    worst = drawing.words.significant(drawing.verdict.largest_difference, 2)
    return [drawing.words("page.verified", difference=worst)]


def checked_lines(drawing: Drawing, width: float) -> list[str]:
    """The difference of the independent route, in as few lines of a width as hold it."""
    return in_width(checked(drawing), drawing.words("clause_mark"), width)


def in_width(pieces: Sequence[str], mark: str, width: float) -> list[str]:
    """Pieces in lines of a width, divided within a piece only where one is longer."""
    lines = flowed(pieces, mark, width, LETTERS)
    if all(extent(line, LETTERS)[0] <= width for line in lines):
        return lines
    return flowed(words_of(mark.join(pieces)), " ", width, LETTERS)


def construction_head(drawing: Drawing, x: float, y: float) -> Text:
    """The heading above the construction in sentences."""
    return Text(x, y, drawing.words("page.construction"), "caption", 3.5)


def wanted(drawing: Drawing, x: float, y: float) -> tuple[list[Mark], set[Moved]]:
    """The requests, links and plan scale of a task, next to the scheme.

    Where lines do not fit, they have no empty lines between them; then the links go to a
    continuation sheet, then the requests.
    """
    words, paper = drawing.words, drawing.paper
    heading = flowed(words_of(words("page.asked")), " ", paper.scheme[0] - x - 3, 3.5)
    first = y + 10.5 + LEADING * (len(heading) - 1)
    room = int((paper.below[3] - first) / LEADING) + 1
    moved = set[Moved]()
    lines = parts = task_lines(drawing, moved, paper.scheme[0] - x - 8)
    for part in (Moved.MEMBERS, Moved.ASKED):
        if len(lines) > room:
            lines = [line for line in parts if line]
        if len(lines) > room:
            moved.add(part)
            lines = parts = task_lines(drawing, moved, paper.scheme[0] - x - 8)
    marks: list[Mark] = [
        Text(x, y + 4.5 + i * LEADING, line, "caption", 3.5) for i, line in enumerate(heading)
    ]
    marks += [
        Text(x + 5, first + i * LEADING, line, "caption", 2.5)
        for i, line in enumerate(lines)
        if line
    ]
    return [*marks, *scheme(drawing)], moved


def task_lines(drawing: Drawing, moved: set[Moved], width: float) -> list[str]:
    """The lines of a task in a width, an empty line between parts; moved parts are named."""
    elsewhere = drawing.words("page.moved")
    mark = drawing.words("clause_mark")
    lines = in_width([elsewhere] if Moved.ASKED in moved else asked_words(drawing), mark, width)
    links = members(drawing)
    if Moved.MEMBERS in moved:
        links = drawing.words("page.members", list=elsewhere)
    for line in filter(None, (links, plan_at(drawing))):
        lines += ["", *flowed(words_of(line), " ", width, 2.5)]
    return lines


def asked_words(drawing: Drawing) -> Sequence[str]:
    """The quantities that a sheet asks for, in words; the travel is asked on the calculation."""
    if drawing.kind == FORCE:
        from graphkin.documents.sentences import forces_asked

        return forces_asked(drawing)
    words, ask = drawing.words, drawing.scene.ask
    shown = {drawing.kind, "position" if drawing.kind == "velocity" else drawing.kind}
    of_position = {key: some for key, some in ASKED.items() if some[0] not in TRAVEL}
    found = []
    for key, some in of_position.items():
        names: tuple[str, ...] = getattr(ask, key)
        if names and any(each.kind in shown for each in some if each.words):
            what = f"slides_{drawing.kind}" if key == "slides" else key
            symbols = (symbol(lettered(n)) if WHOSE[key] == "points" else escape(n) for n in names)
            found.append(request(words, f"ask.{what}", symbols))
    for_others = any(getattr(ask, key) for key in of_position)
    return found or ([words("ask.for_accelerations")] if for_others else [])
