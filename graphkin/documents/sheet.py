"""An A3 sheet: mechanism and plan side by side, data above, construction and tables below."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from enum import Enum

from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction import step_marks
from graphkin.construction.core.component import crowded_pins
from graphkin.construction.core.curve_marks import draw_curves
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import PlanPole, Sentence, construction
from graphkin.construction.core.layout import Layout, lay_out, lowered, spare_height
from graphkin.construction.core.naming import name_of_sheet
from graphkin.construction.core.paper_canvas import PaperCanvas, draw_part
from graphkin.construction.core.plot import Plot, above_foot
from graphkin.construction.core.quantities import ASKED
from graphkin.construction.drivers import driver_symbols
from graphkin.construction.guides.slide_symbols import covered
from graphkin.construction.links import mechanism_symbols
from graphkin.construction.links.link_numbers import settle_in_plates
from graphkin.construction.result_tables import tables
from graphkin.documents.captions import HEADING, headlines
from graphkin.documents.data_heading import data_heading, height_beyond
from graphkin.documents.detail import parted
from graphkin.documents.flattest import flattest_line
from graphkin.documents.inset import insets
from graphkin.documents.listing import first_part, listed
from graphkin.documents.members import members
from graphkin.documents.scheme import scheme
from graphkin.documents.sentences import sentences
from graphkin.documents.signs import mechanism_signs, plan_signs
from graphkin.documents.task_scale import plan_at
from graphkin.drawing.areas import A3_AREA, AREA, BELOW, SCHEME, TABLES
from graphkin.drawing.bare_stretches import at_bare_stretches
from graphkin.drawing.frame import CELLS, STUDENT, TitleBlock, check_bar, sheet_frame, wrapped
from graphkin.drawing.label import Label, segment_of
from graphkin.drawing.labels import FieldContent, FootNote
from graphkin.drawing.marks import LineMark, Mark, Page, Text, reach, style_class
from graphkin.drawing.richtext import extent, flowed, words_of
from graphkin.drawing.style import VECTORS
from graphkin.drawing.symbol_markup import escape, symbol
from graphkin.scene.link_points import lettered
from graphkin.scene.requests import LINKS_ASKED
from graphkin.text.errors import PageError
from graphkin.text.markup import names_in

TITLE = 182.0
"""Widest title that stays clear of the centring mark, in mm."""
LEADING = 4.6
"""Distance of lines of text in mm."""
CROWD = 3
"""So many triangles at one pin are shown enlarged."""
MANY = 24
"""So many named auxiliary points of a plan have their names on a continuation sheet."""
CUT = 3.0
"""How far below the fields' upper edges guides and loci begin, in mm."""
RAISED = (*VECTORS, "arrowhead")
"""What stands above bars and pins, so that one sees where vectors begin and where they point."""


class Moved(Enum):
    """What goes on to a continuation sheet where it has no room; its value names it in words."""

    DATA = "data"
    ASKED = "asked"
    MEMBERS = "members"
    CONSTRUCTION = "construction"
    TABLES = "tables"
    AUXILIARY = "auxiliary"


class Writing(Struct, frozen=True):
    """What is written above and below the drawings of a sheet, and what of it has no room.

    Of a construction that has no room, so many sentences are ``said`` here, the others moved.
    Data of many lines take ``more`` height than others, in mm, of the fields below.
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
) -> Page:
    """One A3 page of a sheet: the key with everything, or the task with nothing given away."""
    written = written or writing(drawing, view)
    layout = lowered(layout or lay_out(drawing), written.more)
    (left, detail, _), (right, other, _) = parted(*boards(drawing, layout, view))
    if view != "task":
        detail += insets(drawing, layout.mechanism, [*left, *detail])
        detail += mechanism_signs(drawing, layout.mechanism, [*left, *detail])
        other += plan_signs(drawing, layout.plan, [*right, *other])
    marks: list[Mark] = [
        *sheet_frame(title_block(drawing, view, number)),
        *written.head,
        *(*left, *detail, *right, *other),
        *panels(layout),
        *written.foot,
    ]
    return Page(420, 297, tuple(marks), page_title(drawing), drawing.words.language)


def page_title(drawing: Drawing) -> str:
    """The title of a page's file."""
    return f"{title_of(drawing)} – {drawing.words('sheet.' + name_of_sheet(drawing))}"


def panels(layout: Layout) -> list[Mark]:
    """The lines between the mechanism, the plan and what stands below them."""
    x, top = layout.plan.rect[:2]
    return [
        LineMark(x, top - 6, x, AREA[3] - 2, "panel"),
        LineMark(AREA[0], AREA[3], AREA[2], AREA[3], "panel"),
    ]


def title_of(drawing: Drawing) -> str:
    """The scene's title in the sheet's language."""
    return drawing.scene.titles.get(drawing.words.language, drawing.scene.title)


def title_block(drawing: Drawing, view: str, number: str) -> TitleBlock:
    """The fields of the title block."""
    words, sheet = drawing.words, drawing.scene.sheet
    labels = {name: words(f"block.{name}") for name, _, _ in CELLS}
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
    )


def sheet_heading(drawing: Drawing, view: str = "key") -> tuple[list[Mark], set[Moved], float]:
    """The sheet's title and the data, in as many lines as they need; what has no room; how much
    more height than others these lines take, in mm."""
    marks, x, y = title_line(drawing)

    def made() -> list[Mark]:
        return data_heading(drawing, view, x, y, lambda: spare_above(drawing))

    data, moved = with_room(drawing, Moved.DATA, made, x, y)
    return [*marks, *data], moved, height_beyond(data)


def spare_above(drawing: Drawing) -> float:
    """By how much the fields' upper edges may be lowered, in mm, so that nothing that is drawn on
    the key is cut but what reaches up to them: guides and lines without end."""
    layout = lay_out(drawing)
    both = left_board(drawing, layout, "key"), right_board(drawing, layout, "key")
    tops = (reach(mark)[1] for board in both for mark in board.marks if mark.name != HEADING)
    drawn = (top for top in tops if top > AREA[1] + CUT + 0.5)
    return max(min(spare_height(drawing), min(drawn, default=AREA[3]) - CUT - AREA[1]), 0.0)


def title_line(drawing: Drawing, remark: str = "") -> tuple[list[Mark], float, float]:
    """The sheet's title and the bar that checks the print; where the data may begin.

    Velocity and acceleration sheets have titles of one height, with as many lines: one, else two of
    small lettering, which stay clear of the frame and the data. A sheet that goes on, with a
    ``remark``, has room for two of larger lettering.
    """
    words = drawing.words
    left, top = AREA[0] + 2, A3_AREA[1]
    kinds = dict.fromkeys((name_of_sheet(drawing), "velocity", "acceleration"))
    name, *others = (f"{words('sheet.' + k)} – {title_of(drawing)}{remark}" for k in kinds)
    lines, height, rows = [escape(name)], 5.0, 1
    longest = max((name, *others), key=lambda each: extent(escape(each), height)[0])
    if extent(escape(longest), height)[0] > TITLE:
        most = ((3.5, 2 if remark else 1), (2.5, 2))
        height = next((h for h, few in most if len(wrapped(longest, TITLE, h)) <= few), 1.8)
        lines, rows = wrapped(name, TITLE, height), len(wrapped(longest, TITLE, height))
    low, data = top + 7.6, top + 12.4
    if rows > 1:
        low, data = (top + 12.5, top + 18.0) if remark else (top + 8.6, top + 13.4)
    marks: list[Mark] = [
        Text(left, low - 1.4 * height * (len(lines) - 1 - i), line, "title", height, name="title")
        for i, line in enumerate(lines)
    ]
    marks += check_bar(AREA[2] - 106, top + 5.5)
    bar = words("page.check_bar")
    marks.append(Text(AREA[2] - 109, top + 5.5, bar, "check-bar", 1.8, "end"))
    return marks, left, data


def with_room(
    drawing: Drawing, part: Moved, made: Callable[[], Iterable[Mark]], x: float, y: float
) -> tuple[list[Mark], set[Moved]]:
    """The marks of a part; where they have no room, a line at a place that says where they are."""
    try:
        return list(made()), set()
    except PageError:
        where = f"{drawing.words(f'page.{part.value}')}: {drawing.words('page.moved')}"
        return [Text(x, y, where, "caption", 2.5, name="moved")], {part}


def writing(drawing: Drawing, view: str) -> Writing:
    """What is written above and below the drawings of a sheet."""
    head, moved, lower = sheet_heading(drawing, view)
    foot, more, said = below(drawing, view)
    if view == "key" and has_many_auxiliary(drawing):
        moved.add(Moved.AUXILIARY)
    return Writing(head, foot, frozenset(moved | more), said, lower)


def left_board(drawing: Drawing, layout: Layout, view: str) -> FieldContent:
    """The mechanism's field."""
    field = layout.mechanism
    board = FieldContent(field.rect, unnamed=drawing.words("page.unnamed"))
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
    """Both fields; the letters of the construction that no sentence says are dispensable there.

    Many auxiliary points have no letters, but on the pages that grow, whose sentences are
    ``said``.
    """
    both = left_board(drawing, layout, view), right_board(drawing, layout, view)
    settle_in_plates(both[0])
    letters = [x for x in both[0].labels if x.cls == "construction" and not segment_of(x)]
    if letters:
        told = {name for each in said or sentences(drawing) for name in names_in(each.markup)}
        both[0].dispensable = [label for label in letters if label.name not in told]
        both[0].labels = [x for x in both[0].labels if x not in both[0].dispensable]
    if view == "key" and not said and has_many_auxiliary(drawing):
        both[1].labels = [*without_auxiliary(drawing, both[1].labels)]
        both[1].notes.append(FootNote(drawing.words("page.trials_moved")))
    return both


def has_many_auxiliary(drawing: Drawing) -> bool:
    """Whether so many auxiliary points have names that these stand on a sheet of their own."""
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
    """True for a line of the construction, which lies below bars that it runs along."""
    return isinstance(mark, LineMark) and mark.cls in ("construction", "ray")


def raise_marks(board: FieldContent, some: Sequence[Mark]) -> None:
    """Put some marks above all others that are drawn so far."""
    raised = {id(mark) for mark in some}
    board.marks = [*(mark for mark in board.marks if id(mark) not in raised), *some]


def vectors(marks: Sequence[Mark]) -> list[Mark]:
    """The vectors of steps with their heads."""
    own = {(m.step, m.name) for m in marks if m.step is not None and style_class(m) in VECTORS}
    return [m for m in marks if (m.step, m.name) in own and style_class(m) in RAISED]


def right_board(drawing: Drawing, layout: Layout, view: str) -> FieldContent:
    """The plan's field."""
    field = layout.plan
    board = FieldContent(field.rect, unnamed=drawing.words("page.unnamed"))
    board.marks += headlines(drawing, layout, view)[1]
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
    """The construction in words, the tables, the check bar and the witness's verdict; what of them
    has no room, and how many sentences have some where not all have."""
    words, moved, said = drawing.words, set[Moved](), 0
    left, top = BELOW[0] + 2, BELOW[1]
    if view == "key":
        place = drawing, left, top + 10.5, TABLES[0] - left - 5, BELOW[3] - 3.5
        try:
            told = listed(*place)
        except PageError:
            told, said = first_part(*place)
            moved.add(Moved.CONSTRUCTION)
        marks = [construction_head(drawing, left, top + 4.5), *told]
    else:
        marks, moved = wanted(drawing, left, top)
    found, more = with_room(
        drawing,
        Moved.TABLES,
        lambda: tables(drawing, TABLES, empty=view == "task"),
        TABLES[0],
        TABLES[1] + 4.5,
    )
    marks += found
    moved |= more
    if view == "task":
        return marks, moved, said
    worst = words.significant(drawing.verdict.largest_difference, 2)
    text = words("page.verified", difference=worst)
    marks.append(Text(left, BELOW[3] + 0.8, text, "caption", 1.8, name="witness"))
    return [*marks, *flattest_line(drawing, left + extent(text, 1.8)[0])], moved, said


def construction_head(drawing: Drawing, x: float, y: float) -> Text:
    """What stands above the construction in sentences."""
    return Text(x, y, drawing.words("page.construction"), "caption", 3.5)


def wanted(drawing: Drawing, x: float, y: float) -> tuple[list[Mark], set[Moved]]:
    """What a task asks, what the links are and how the plan is drawn, beside the scheme.

    Where lines have no room, the links go on to a continuation sheet, and then what is asked.
    """
    words, room = drawing.words, int((BELOW[3] - y - 10.5) / LEADING) + 1
    moved = set[Moved]()
    lines = task_lines(drawing, moved, SCHEME[0] - x - 8)
    for part in (Moved.MEMBERS, Moved.ASKED):
        if len(lines) > room:
            moved.add(part)
            lines = task_lines(drawing, moved, SCHEME[0] - x - 8)
    marks: list[Mark] = [Text(x, y + 4.5, words("page.asked"), "caption", 3.5)]
    marks += [
        Text(x + 5, y + 10.5 + i * LEADING, line, "caption", 2.5)
        for i, line in enumerate(lines)
        if line
    ]
    return [*marks, *scheme(drawing)], moved


def task_lines(drawing: Drawing, moved: set[Moved], width: float) -> list[str]:
    """The lines of a task in a width, an empty one between parts; what is moved is only named."""
    elsewhere = drawing.words("page.moved")
    lines = flowed([elsewhere] if Moved.ASKED in moved else asked_words(drawing), "; ", width, 2.5)
    links = members(drawing)
    if Moved.MEMBERS in moved:
        links = drawing.words("page.members", list=elsewhere)
    for told in filter(None, (links, plan_at(drawing))):
        lines += ["", *flowed(words_of(told), " ", width, 2.5)]
    return lines


def asked_words(drawing: Drawing) -> Sequence[str]:
    """What a sheet asks for, in words."""
    words, ask = drawing.words, drawing.scene.ask
    shown = {drawing.kind, "position" if drawing.kind == "velocity" else drawing.kind}
    found = []
    for key, some in ASKED.items():
        names: tuple[str, ...] = getattr(ask, key)
        if names and any(each.kind in shown for each in some if each.words):
            what = f"slides_{drawing.kind}" if key == "slides" else key
            told = (escape(n) if key in LINKS_ASKED else symbol(lettered(n)) for n in names)
            mentioned = words("list_mark").join(told)
            found.append(words(f"ask.{what}" + ("_many" if len(names) > 1 else ""), list=mentioned))
    return found or ([words("ask.for_accelerations")] if ask.anything else [])
