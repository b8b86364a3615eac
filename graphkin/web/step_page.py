"""The step page: a scene's sheets in one offline file that draws itself sentence by sentence."""

from __future__ import annotations

import gc
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from html import escape
from itertools import chain

from graphkin.construction.core.naming import called, scale_of
from graphkin.documents.sheet import title_of
from graphkin.drawing.areas import Rect
from graphkin.drawing.marks import Mark
from graphkin.drawing.style import Ink
from graphkin.mechanism import Mechanism
from graphkin.web import facts
from graphkin.web.controls import dock
from graphkin.web.field_pictures import bar_rules, field_picture, headline, ink_sheet, scale_bar
from graphkin.web.legend import legend
from graphkin.web.offline_page import data_block, offline_page, part
from graphkin.web.protocol import PageProtocol, Timed, telling
from graphkin.web.protocol_section import construction
from graphkin.web.screen_sheets import ScreenSheet, screen_sheets
from graphkin.web.scripts import STEP_PAGE, together
from graphkin.web.slider import slider
from graphkin.writers.html_markup import marked_up
from graphkin.writers.svg import number


@dataclass(frozen=True, slots=True)
class Form:
    """A form for answers in a task page: its markup, its rules and its script."""

    body: str
    style: str
    script: str


@contextmanager
def all_kept() -> Iterator[None]:
    """No search for garbage: a page makes many small records at once, all of which are needed.

    Processor time of a first page with it and without: engine 0.14 and 0.17 s, eight-link-2 0.32
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
def step_page(mechanism: Mechanism, language: str | None = None, ink: Ink = "colour") -> str:
    """The page of a scene that draws itself; ``language`` is the scene's own if None.

    Raises WitnessError when the independent route disagrees, PageError where a drawing does not
    fit.
    """
    mechanism = mechanism.spoken(language)
    sheets = screen_sheets(mechanism, language)
    told = telling(sheets)
    moves = slider(mechanism, sheets)
    body = "\n".join(
        (
            *top(sheets),
            '<main id="page">',
            '<div id="desk">',
            *chain.from_iterable(figures(sheets, told, place) for place in range(len(sheets))),
            "</div>",
            *construction(sheets, told),
            *outcome(sheets, moves.datum),
            *legend(sheets),
            "</main>",
            *foot(sheets),
            dock(sheets[0].drawing.words, told, moves),
            data_block("run", record(sheets, told)),
        )
    )
    scripts = [together(STEP_PAGE)]
    if moves.source:
        scripts.insert(0, moves.source)
    return written(sheets, body, ink, [part("steps.css")], scripts)


def task_page(
    mechanism: Mechanism,
    language: str | None = None,
    ink: Ink = "colour",
    form: Form | None = None,
) -> str:
    """The page of a scene as a task: what is given and what is asked, and nothing of the key."""
    mechanism = mechanism if form else mechanism.spoken(language)  # answers go by the scene's names
    sheets = screen_sheets(mechanism, language, "task")
    words = sheets[0].drawing.words
    asked = words("page.asked")
    parts = [*top(sheets), '<main id="page" class="task">', *given(sheets), '<div id="desk">']
    for place, sheet in enumerate(sheets):
        marks = [Timed(mark, 0, None) for mark in (*sheet.left, *sheet.right)]
        parts += figure_pair(sheet, place, marks, ((), ()))
        parts.insert(-1, f"<h3>{escape(asked)}</h3>{facts.wanted(sheet.drawing)}")
    body = "\n".join((*parts, "</div>", form.body if form else "", "</main>", *foot(sheets)))
    styles, scripts = ([form.style], [form.script]) if form else ([], [])
    return written(sheets, body, ink, styles, scripts)


def written(
    sheets: Sequence[ScreenSheet],
    body: str,
    ink: Ink,
    styles: Sequence[str],
    scripts: Sequence[str],
) -> str:
    """A page with the looks of the sheets."""
    marks = [mark for sheet in sheets for mark in all_marks(sheet)]
    drawing = sheets[0].drawing
    looks = (ink_sheet(marks, ink), part("page.css"), shapes(sheets), *styles)
    return offline_page(title_of(drawing), drawing.words.language, body, looks, scripts)


def all_marks(sheet: ScreenSheet) -> tuple[Mark, ...]:
    """Every mark of a sheet."""
    return (*sheet.left, *sheet.right, *sheet.more_left, *sheet.more_right)


def shapes(sheets: Sequence[ScreenSheet]) -> str:
    """How wide the two fields of each sheet stand beside one another, and what their bars know."""
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


# --- what stands on the page ---------------------------------------------------------------------


def top(sheets: Sequence[ScreenSheet]) -> Iterator[str]:
    """The title."""
    yield f"<header><h1>{escape(title_of(sheets[0].drawing))}</h1></header>"


def figures(sheets: Sequence[ScreenSheet], told: PageProtocol, place: int) -> list[str]:
    """The two fields of a sheet as they grow."""
    sheet = sheets[place]
    last = told.bounds(place)[1]
    more = tuple(
        [Timed(mark, last, None) for mark in marks] for marks in (sheet.more_left, sheet.more_right)
    )
    return figure_pair(sheet, place, told.timed[place], more)


def figure_pair(
    sheet: ScreenSheet,
    place: int,
    timed: Sequence[Timed],
    more: Sequence[Sequence[Timed]],
) -> list[str]:
    """A sheet: the field of the mechanism and that of the plan, each under its caption."""
    drawing, count = sheet.drawing, len(sheet.left)
    name = escape(drawing.words(f"sheet.{called(drawing)}"))
    ids = [f"m{place}-{k}" for k in range(len(timed))]
    named = list(zip(ids, timed, strict=True))
    found = [
        f'<section class="sheet" id="sheet-{place}" data-kind="{drawing.kind}"'
        f' aria-labelledby="name-{place}">',
        f'<h2 id="name-{place}">{name}</h2>',
        f'<div class="fields" id="fields-{place}">',
    ]
    sides = (
        (named[:count], sheet.left, sheet.layout.mechanism.rect),
        (named[count:], sheet.right, sheet.layout.plan.rect),
    )
    for side, (own, marks, rect) in enumerate(sides):
        caption, _ = headline(marks)
        shown = [*own[1:], *(("", mark) for mark in more[side])]
        label = f"caption-{place}-{side}"
        found += [
            f'<figure><figcaption><span id="{label}">{marked_up(caption)}</span>',
            f"{scale_bar(drawing.words)}</figcaption>",
            f'<div class="view">{field_picture(shown, rect, label)}</div></figure>',
        ]
    return [*found, "</div>", "</section>"]


def outcome(sheets: Sequence[ScreenSheet], datum: str) -> Iterator[str]:
    """The tables of results, and the data; ``datum`` is the symbol of the one that is moved."""
    words = sheets[0].drawing.words
    yield '<section id="results" aria-labelledby="results-name"><h2 id="results-name">'
    yield f"{escape(words('screen.results'))}</h2>"
    for sheet in sheets:
        yield f'<div data-kind="{sheet.drawing.kind}">'
        yield f"<h3>{escape(words(f'sheet.{called(sheet.drawing)}'))}</h3>"
        yield from facts.results(sheet.drawing)
        yield "</div>"
    yield "</section>"
    yield from given(sheets, datum)


def given(sheets: Sequence[ScreenSheet], datum: str = "") -> Iterator[str]:
    """The data of the scene."""
    drawing = sheets[0].drawing
    name = escape(drawing.words("page.data"))
    yield f'<section id="given" aria-labelledby="given-name"><h2 id="given-name">{name}</h2>'
    yield f"{facts.data(drawing, datum)}</section>"


def foot(sheets: Sequence[ScreenSheet]) -> Iterator[str]:
    """What the independent route says of the drawings."""
    drawing = sheets[0].drawing
    words = drawing.words
    worst = words.significant(drawing.verdict.largest_difference, 2)
    text = words("page.verified", difference=worst)
    yield f"<footer><p>{marked_up(text)}</p></footer>"


# --- what a script makes of it -------------------------------------------------------------------


def record(sheets: Sequence[ScreenSheet], told: PageProtocol) -> dict[str, object]:
    """What the script has to know."""
    words = sheets[0].drawing.words
    return {
        "bounds": [told.bounds(place) for place in range(len(sheets))],
        "at": told.at,
        "from": told.sources,
        "sides": told.sides,
        "letters": {step: marked_up(name) for step, name in told.letters.items()},
        "tints": told.tints,
        "hangs": told.hangs,
        "aside": told.aside,
        "squares": told.squares,
        "stops": [first for first, _, _ in told.stops()],
        "count": words("page.step_of", number="{number}", all="{all}"),
        "mark": words("decimal_mark"),
        "sense": [words("page.anticlockwise"), words("page.clockwise")],
        "slides": facts.senses(sheets[0].drawing),
        "scales": {
            sheet.drawing.kind: scale_of(sheet.drawing, sheet.drawing.plane) / 1000
            for sheet in sheets
        },
    }
