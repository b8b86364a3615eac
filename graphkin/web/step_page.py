"""The step page: a scene's sheets in one offline file that draws itself sentence by sentence."""

from __future__ import annotations

import gc
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from math import degrees, floor, log10
from typing import TYPE_CHECKING

from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.given_data import Datum, data, given
from graphkin.construction.core.layout import lay_out
from graphkin.construction.core.naming import drawn_in, length_gap, name_of_sheet, scale_of
from graphkin.construction.core.program import Part, PlanVector, Step, plan_vector
from graphkin.construction.core.quantities import CENTRES, FORCE, in_mm
from graphkin.construction.forces.force_drawing import ForceLayout
from graphkin.construction.result_tables import unread
from graphkin.documents.relations import travel_words
from graphkin.documents.scheme import scheme
from graphkin.documents.sheet import HEADING, apart, asked_words, checked, data_of, title_of
from graphkin.documents.sheet_documents import drawn_of, language_of
from graphkin.drawing.field import Rect
from graphkin.drawing.marks import Mark
from graphkin.drawing.style import BY_SIGN, Ink
from graphkin.drawing.symbol_markup import symbol
from graphkin.mechanism import Mechanism
from graphkin.motion.driving import TURN
from graphkin.text import Words
from graphkin.web import facts
from graphkin.web.board_page import board_record
from graphkin.web.board_page import palette as board_palette
from graphkin.web.highlights import ghosts, rates, rows_found, triangles
from graphkin.web.moving import moving, still
from graphkin.web.offline_page import (
    BAR,
    BOARD_PAGE,
    STEP_PAGE,
    bar_rules,
    bundled,
    data_block,
    field_picture,
    ink_sheet,
    offline_page,
    part,
)
from graphkin.web.page_driver import PageDriver, Reach, window
from graphkin.web.protocol import NO_STEP, PageProtocol, ProtocolSentence, Timed, telling
from graphkin.web.screen_sheets import ScreenSheet, screen_sheet, screen_sheets
from graphkin.web.your_turn import NOBODY, TurnOwner, palette, your_turn
from graphkin.web.your_turn import record as turn_record
from graphkin.writers.svg import number
from graphkin.writers.templates import from_template, marked_up, tables_html

if TYPE_CHECKING:
    from markupsafe import Markup

Arrow = tuple[Step, PlanVector]
PLANS = {
    "velocity": ("*k*_v", "*ω*", "legend.omega"),
    "acceleration": ("*k*_a", "*ε*", "legend.epsilon"),
}
"""The scale of each plan, and the symbol and meaning of a link's rate on its sheet."""


def meanings(words: Words, sheets: Sequence[ScreenSheet]) -> Iterator[tuple[str, str]]:
    """Each symbol and its meaning, as markup."""
    yield words.signs.in_sentence("*k*_L"), words("legend.kL")
    for sheet in sheets:
        drawing = sheet.drawing
        if drawing.kind == FORCE:
            yield (
                "*k*_F",
                words("legend.scale", plan=words("sheet.force"), unit=words.unit(drawing.unit)),
            )
            continue
        *signs, turning = PLANS[drawing.kind]
        scale, rate = map(drawing.in_signs, signs)
        unit = words(f"table.{drawing.kind}")
        yield scale, words("legend.scale", plan=words(f"sheet.{drawing.kind}"), unit=unit)
        yield drawing.symbol(drawing.pole), words("legend.at_rest")
        steps = [step for _, step, _ in drawing.steps(drawing.plane)]
        arrows = [(step, vector) for step in steps if (vector := plan_vector(step))]
        yield from images(words, arrows, sheet)
        yield from components(words, arrows)
        yield rate, words(turning)
        targets = drawing.trace.program.targets
        found = {what for (what, _), number in targets.items() if number in drawing.trace.values}
        for each in CENTRES:
            if each.kind == drawing.kind and each.target in found:
                yield f"*{each.letter}*", words(f"legend.{each.target}")


def images(words: Words, arrows: Sequence[Arrow], sheet: ScreenSheet) -> Iterator[tuple[str, str]]:
    """One segment of a point's vector, and one of a relative vector, with their meanings."""
    drawing, steps = sheet.drawing, sheet.drawing.trace.program.steps
    whole = [(step, vector) for step, vector in arrows if not vector.sign]
    for key, has_pivot in (("legend.image", False), ("legend.relative", True)):
        for step, found in [each for each in whole if bool(each[1].p) is has_pivot][:1]:
            names = {"q": found.q, "p": found.p, "symbol": found.symbol}
            fields = {key: drawing.symbol(name or "o") for key, name in names.items()}
            yield (
                "".join(drawing.symbol(steps[arg].name) for arg in step.args),
                words(key, **fields),
            )


def components(words: Words, arrows: Sequence[Arrow]) -> Iterator[tuple[str, str]]:
    """The components of accelerations by their signs, in the order in which they are drawn."""
    kinds = dict.fromkeys(vector.sign for _, vector in arrows if vector.sign)
    yield from (
        (symbol(f"a^{kind}", signs=words.signs), words(BY_SIGN[kind].legend))
        for kind in kinds
        if kind in BY_SIGN
    )


# --- the driver's slider of a step page -----------------------------------------------------------


SLACK = 0.5
"""Degrees that a full turn may lack around a change point."""


class Slider(Struct, frozen=True):
    """The script that moves a mechanism and its plans, with the slider's data.

    ``name`` is the markup of the driver's symbol, ``datum`` the symbol as in the data, ``unit`` the
    unit of its position. ``ends`` are the least and greatest positions, ``stops`` the ends beyond
    which nothing closes, ``digits`` the decimals shown. Without a script, ``why`` is the key of the
    sentence that says why nothing moves.
    """

    source: str = ""
    name: str = ""
    datum: str = ""
    unit: str = ""
    ends: tuple[float, float] = (0.0, 0.0)
    stops: tuple[float, ...] = ()
    digits: int = 1
    why: str = ""

    def place(self, words: Words, at: float | None) -> str:
        """A position of the driver in words, or its unit alone."""
        unit = words("unit.deg") if self.unit == "deg" else f" {words.spelled(self.unit)}"
        return unit if at is None else words.fixed(at, self.digits) + unit

    def limits(self, words: Words) -> str:
        """The positions that the driver cannot pass; empty where it turns freely."""
        return " / ".join(self.place(words, at) for at in self.stops)


def slider(mechanism: Mechanism, sheets: Sequence[ScreenSheet]) -> Slider:
    """The slider of a mechanism, or the reason why nothing moves."""
    found = moving(mechanism, sheets)
    if found is None:
        return Slider(why=still(mechanism) or "")
    driven, reach = found.driven, found.reach
    ends = (reach.low, reach.high)
    stops, digits = stopped(driven, reach), max(1, -floor(log10(reach.step)))
    return Slider(found.source, driven.name, driven.datum, driven.unit, ends, stops, digits)


def stopped(driven: PageDriver, reach: Reach) -> tuple[float, ...]:
    """The ends of a range beyond which nothing closes, without the ends of the search window.

    A range of a full turn ends where it begins, in a change point that the driver can pass.
    """
    if driven.unit == "deg" and reach.high - reach.low > TURN - SLACK:
        return ()
    pairs = zip((reach.low, reach.high), window(driven), strict=True)
    return () if reach.whole else tuple(end for end, edge in pairs if abs(end - edge) > 1e-9)


# --- the step page: a scene's sheets in one offline file that draws itself sentence by sentence ---


STOP_NAMES = {
    Part.POSITION: "screen.position",
    Part.VELOCITY: "screen.velocity",
    Part.CENTRE: "screen.centre",
    Part.NORMAL: "screen.normal",
    Part.ACCELERATION: "screen.acceleration",
    Part.POLE: "screen.pole",
    Part.FORCE: "sheet.force",
}
"""The labels of the buttons that jump to the parts of the work."""
RATE_NAMES = {
    "velocity": "screen.rates_velocity",
    "acceleration": "screen.rates_acceleration",
}
"""The labels of the buttons that jump to the rates of links, by the kind of sheet."""


class Form(Struct, frozen=True):
    """A form for answers in a task page: its markup, its rules and its script.

    ``says_right`` says that the lab lets the board tell when a point is right.
    """

    body: Markup
    style: str
    script: str
    says_right: bool = False


Tell = Callable[[str], None]
"""Receives notes that concern a page but are not on it."""


def silent(note: str) -> None:
    """Ignore a note."""


@contextmanager
def all_kept() -> Iterator[None]:
    """Suspend garbage collection: a page makes many small records at once, all of which are needed.

    Processor time of a first page with and without it: engine 0.14 and 0.17 s, eight-link-2 0.32
    and 0.38 s, jumper 0.185 and 0.193 s.
    """
    was = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was:
            gc.enable()


@all_kept()
def step_page(
    mechanism: Mechanism,
    language: str | None = None,
    ink: Ink = "colour",
    owner: TurnOwner = NOBODY,
    tell: Tell = silent,
) -> str:
    """The step page of a scene; ``language`` None means the scene's own language.

    ``owner`` is the owner of the score sheet at the end of a student's turn. ``tell`` receives
    notes on quantities that are asked for but cannot be read off the page. Raises WitnessError when
    the independent route disagrees, and PageError where a drawing does not fit.
    """
    mechanism = mechanism.spoken(language).measured
    sheets = screen_sheets(mechanism, language)
    tell_unread(sheets, tell)
    return page_of_steps(sheets, slider(mechanism, sheets), ink, owner)


def force_page(
    mechanism: Mechanism,
    language: str | None = None,
    ink: Ink = "colour",
    owner: TurnOwner = NOBODY,
) -> str:
    """The page on which the forces of a scene that asks for them draw themselves.

    Nothing moves in it. Raises as step_page does.
    """
    own = force_sheet(mechanism.spoken(language).measured, language)
    return page_of_steps([own], Slider(), ink, owner)


def force_sheet(mechanism: Mechanism, language: str | None = None) -> ScreenSheet:
    """The sheet of forces, with the field of its first polygon as the frame of all of them."""
    drawing = drawn_of(mechanism, language_of(mechanism, language))[-1]
    layout = lay_out(drawing)
    assert isinstance(layout, ForceLayout)
    sheet = screen_sheet(drawing, layout)
    first = replace(next(iter(layout.polygons.values())), rect=layout.plan.rect)
    return replace(sheet, layout=replace(layout, plan=first))


def page_of_steps(
    sheets: Sequence[ScreenSheet], moves: Slider, ink: Ink, owner: TurnOwner = NOBODY
) -> str:
    """The page on which some sheets of one mechanism draw themselves, sentence by sentence."""
    protocol = telling(sheets)
    turn = your_turn(sheets, protocol)
    drawing = sheets[0].drawing
    given_data = data_of(drawing, "key") if drawing.kind == FORCE else data(drawing)
    found = rows_found(sheets, protocol)
    body = from_template(
        "web/templates/step.html",
        **common(sheets),
        sheets=[
            fields(sheet, place, *grown(sheet, protocol, place))
            for place, sheet in enumerate(sheets)
        ],
        construction=list(construction(sheets, protocol)),
        no_step=NO_STEP,
        degrees=degrees,
        results=[
            (each.drawing.kind, sheet_name(each), tables_html(facts.results(each.drawing, found)))
            for each in sheets
        ],
        sought=[
            *(piece for sheet in sheets for piece in asked_words(sheet.drawing)),
            *travel_words(sheets[0].drawing),
        ],
        data=[datum.said for datum in given_data],
        datum=place_of(moves.datum, given_data),
        meanings=list(meanings(drawing.words, sheets)),
        steps=len(protocol.said),
        stops=[
            (
                first,
                last,
                STOP_NAMES.get(stop)
                or RATE_NAMES[sheets[protocol.said[first - 1].sheet].drawing.kind],
            )
            for first, last, stop in protocol.stops()
        ],
        moves=moves,
        palette=palette(turn, sheets[0].drawing.words),
        turning=data_block("turning", turn_record(sheets, turn, owner)),
        run=data_block(
            "run",
            record(sheets, protocol)
            | {"by_rate": [k for k, datum in enumerate(given_data) if datum.by_rate]},
        ),
    )
    scripts = [bundled(STEP_PAGE)]
    if moves.source:
        scripts.insert(0, moves.source)
    styles = [part("steps.css"), part("story.css"), part("your_turn.css")]
    return written(sheets, body, ink, styles, scripts)


def task_page(
    mechanism: Mechanism,
    language: str | None = None,
    ink: Ink = "colour",
    form: Form | None = None,
    tell: Tell = silent,
) -> str:
    """The task page of a scene: what is given and what is asked for, without the key.

    ``tell`` receives notes on quantities that are asked for but cannot be read off a drawing.
    """
    own = mechanism if form else mechanism.spoken(language)  # answers use the scene's names
    mechanism = own.measured
    sheets = screen_sheets(mechanism, language, "task")
    tell_unread(sheets, tell)
    shown = scheme(sheets[0].drawing)
    drawn_here = board_record(sheets, says_right=form is not None and form.says_right)
    body = from_template(
        "web/templates/task.html",
        **common(sheets),
        sheets=[
            (fields(sheet, place, untimed(sheet)), facts.scales_told(sheet.drawing))
            for place, sheet in enumerate(sheets)
        ],
        data=given(sheets[0].drawing),
        asked=facts.wanted([sheet.drawing for sheet in sheets]),
        scheme=scheme_figure(sheets[0].drawing, shown),
        palette=board_palette(sheets[0].drawing.words),
        board=data_block("board", drawn_here),
        form=form.body if form else "",
    )
    styles = [*map(part, ("steps.css", "your_turn.css", "board.css"))]
    scripts = [bundled(BOARD_PAGE)]
    if form:
        styles.append(form.style)
        scripts.insert(0, form.script)
    return written(sheets, body, ink, styles, scripts, shown)


def scheme_figure(drawing: Drawing, marks: Sequence[Mark]) -> tuple[str, str]:
    """The caption and the picture of the kinematic scheme; both empty where it found no room."""
    title, *drawn = marks or (None,)
    if title is None:
        return "", ""
    timed = [("", Timed(mark, 0, None)) for mark in drawn]
    return drawing.words("task.scheme"), field_picture(
        timed, drawing.paper.scheme, "caption-scheme"
    )


def tell_unread(sheets: Sequence[ScreenSheet], tell: Tell) -> None:
    """Report the quantities asked for that cannot be read off the sheets, as for paper."""
    for sheet in sheets:
        for note in unread(sheet.drawing):
            tell(note)


def written(
    sheets: Sequence[ScreenSheet],
    body: Markup,
    ink: Ink,
    styles: Sequence[str],
    scripts: Sequence[str],
    more: Sequence[Mark] = (),
) -> str:
    """A page with the styles of the sheets, and of ``more`` marks."""
    marks = [*(mark for sheet in sheets for mark in sheet.marks), *more]
    drawing = sheets[0].drawing
    looks = (ink_sheet(marks, ink), part("page.css"), shapes(sheets), *styles)
    return offline_page(title_of(drawing), drawing.words.language, body, looks, scripts)


def shapes(sheets: Sequence[ScreenSheet]) -> str:
    """The style rules for the widths of each sheet's two fields, and for their scale bars."""
    found = []
    for place, sheet in enumerate(sheets):
        rects = (sheet.layout.mechanism.rect, sheet.layout.plan.rect)
        left, right = (number(width(rect)) for rect in rects)
        found.append(f"#fields-{place}{{--left:{left}fr;--right:{right}fr}}")
        found += bar_rules(f"#fields-{place}", rects)
    return "\n".join(found)


def width(rect: Rect) -> float:
    """Width of a field in mm."""
    return rect[2] - rect[0]


# --- the contents of the page --------------------------------------------------------------------


class SheetFields(Struct, frozen=True):
    """The fields of a sheet: its name, and id, caption and picture of each field."""

    place: int
    kind: str
    name: str
    pictures: Sequence[tuple[str, str, str]]


def common(sheets: Sequence[ScreenSheet]) -> dict[str, object]:
    """The parts common to all pages: title, words, and the result of the residual check."""
    drawing = sheets[0].drawing
    words = drawing.words
    return {
        "title": title_of(drawing),
        "words": words,
        "bar": BAR,
        "verdict": words.clauses(checked(drawing)),
    }


def sheet_name(sheet: ScreenSheet) -> str:
    """The name of a sheet in the words of its page."""
    return sheet.drawing.words(f"sheet.{name_of_sheet(sheet.drawing)}")


def grown(
    sheet: ScreenSheet, protocol: PageProtocol, place: int
) -> tuple[Sequence[Timed], tuple[Sequence[Timed], Sequence[Timed]]]:
    """The marks of a sheet's fields in drawing order, and those that appear when all is drawn."""
    last = protocol.bounds(place)[1]
    left, right = (
        [Timed(mark, last, None) for mark in marks] for marks in (sheet.more_left, sheet.more_right)
    )
    return protocol.timed[place], (left, right)


def untimed(sheet: ScreenSheet) -> Sequence[Timed]:
    """The marks of a sheet's fields, all shown from the start."""
    return [Timed(mark, 0, None) for mark in (*sheet.left, *sheet.right)]


def fields(
    sheet: ScreenSheet,
    place: int,
    timed: Sequence[Timed],
    more: Sequence[Sequence[Timed]] = ((), ()),
) -> SheetFields:
    """A sheet: the field of the mechanism and the field of the plan, each under its caption."""
    count = len(sheet.left)
    named = [(f"m{place}-{k}", one) for k, one in enumerate(timed)]
    sides = (
        (named[:count], sheet.left, sheet.layout.mechanism.rect),
        (named[count:], sheet.right, sheet.layout.plan.rect),
    )
    pictures = []
    for side, (own, marks, rect) in enumerate(sides):
        drawn = [each for each in own if each[1].mark.name != HEADING]
        shown = [*drawn, *(("", mark) for mark in more[side])]
        label = f"caption-{place}-{side}"
        pictures.append((label, apart(marks)[0], field_picture(shown, rect, label)))
    return SheetFields(place, sheet.drawing.kind, sheet_name(sheet), pictures)


def place_of(symbol: str, given_data: Sequence[Datum]) -> int | None:
    """The index of the datum that moves, by its symbol; None without such a datum."""
    names = [datum.name for datum in given_data]
    return names.index(symbol) if symbol and symbol in names else None


def construction(
    sheets: Sequence[ScreenSheet], protocol: PageProtocol
) -> Iterator[tuple[str, int, Sequence[ProtocolSentence]]]:
    """The kind of each sheet, the number of its first sentence, and its sentences."""
    for place, sheet in enumerate(sheets):
        first, last = protocol.bounds(place)
        yield sheet.drawing.kind, first, protocol.said[first - 1 : last]


# --- the data for the script ---------------------------------------------------------------------


def record(sheets: Sequence[ScreenSheet], protocol: PageProtocol) -> dict[str, object]:
    """The data for the script."""
    words = sheets[0].drawing.words
    return {
        "bounds": [protocol.bounds(place) for place in range(len(sheets))],
        "at": protocol.at,
        "from": protocol.sources,
        "sides": protocol.sides,
        "letters": {step: marked_up(name) for step, name in protocol.letters.items()},
        "tints": protocol.tints,
        "hangs": alike(protocol.hangs),
        "aside": protocol.aside,
        "squares": protocol.squares,
        "rates": rates(sheets, protocol),
        "open": {
            at: [marked_up(said.open), marked_up(said.fallen)]
            for at, said in enumerate(protocol.said, 1)
            if said.open
        },
        "lengths": lengths(sheets, protocol),
        "similar": triangles(sheets),
        "ghosts": ghosts(sheets[0], protocol),
        "task": [words("screen.task"), words("screen.begin")],
        "stops": [first for first, _, _ in protocol.stops()],
        "count": words("page.step_of", number="{number}", all="{all}"),
        "mark": words("decimal_mark"),
        "between": words("clause_mark"),
        "sense": [words("page.anticlockwise"), words("page.clockwise")],
        "slides": facts.senses(sheets[0].drawing),
        "scales": {
            sheet.drawing.kind: scale_of(sheet.drawing, sheet.drawing.plane) / 1000
            for sheet in sheets
        },
    }


def lengths(
    sheets: Sequence[ScreenSheet], protocol: PageProtocol
) -> dict[int, tuple[str, str, str]]:
    """The arrows whose lengths sentences say, each with its row, kind of sheet and length."""
    found: dict[int, tuple[str, str, str]] = {}
    said = "".join(one.open for one in protocol.said)
    for drawing in (sheet.drawing for sheet in sheets):
        for arrow, step, value in drawing.steps(drawing.plane):
            vector = plan_vector(step)
            if vector is not None and length_gap(arrow) in said:
                drawn = in_mm(
                    drawing.words, drawn_in(drawing, drawing.plane, abs(value.tip - value.tail))
                )
                found[arrow] = vector.symbol, drawing.kind, drawn
    return found


def alike(hangs: Mapping[int, tuple[int, ...]]) -> list[tuple[tuple[int, ...], list[int]]]:
    """The steps that need the same crossings, with these crossings, each written once."""
    found: dict[tuple[int, ...], list[int]] = {}
    for step, crossings in hangs.items():
        found.setdefault(crossings, []).append(step)
    return [*found.items()]
