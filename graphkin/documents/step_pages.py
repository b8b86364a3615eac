"""Step by step: pages on which a sheet grows, each with the sentence that says what to do."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from math import degrees
from typing import NamedTuple

from msgspec.structs import replace

from graphkin.construction.core.crossings import Crossing, flattest
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Sentence
from graphkin.construction.core.layout import lay_out, lowered
from graphkin.documents.detail import parted
from graphkin.documents.flattest import crossings_on, group_closed, is_gap, names_of_crossing
from graphkin.documents.inset import insets
from graphkin.documents.listing import written
from graphkin.documents.sentences import sentences
from graphkin.documents.sheet import (
    boards,
    page_title,
    panels,
    sheet_heading,
    title_block,
)
from graphkin.documents.signs import mechanism_signs, plan_signs
from graphkin.documents.step_numbers import BEFORE, stages
from graphkin.documents.step_visibility import appearing, marks_at_stage, when_told
from graphkin.drawing.areas import A3_TITLE_BLOCK, BELOW, MARKED
from graphkin.drawing.frame import sheet_frame
from graphkin.drawing.marks import LineMark, Mark, Page, Text
from graphkin.drawing.richtext import flowed, flowed_pieces, words_of
from graphkin.drawing.style import NOW

LARGE, CLOSE, DONE = (3.5, 6.2), (2.5, 4.2), (2.5, 4.6)
"""Height and distance in mm of the lines of sentences to do, of those to do that have no room so
large, and of those that are done."""
LEFT, TOP, RIGHT = BELOW[0] + 2, BELOW[1] + 4.5, BELOW[2] - 4
"""Where these begin and end, in mm."""
FIRST, ABOVE = TOP + 8, A3_TITLE_BLOCK[1] - 4
"""The foot of the first line to do, and of the lowest above the title block, in mm."""
BESIDE, CLEAR = A3_TITLE_BLOCK[0] - LEFT - 5, MARKED[0] - LEFT - 7
"""The width of lines beside the title block, and of those clear of the centring mark, in mm."""
MOST = 150
"""Words that no line holds."""
LEFT_OUT = "…"
"""What stands for the sentences that are done and have no room."""


def growing(drawing: Drawing, number: str) -> tuple[Page, ...]:
    """A page for each sentence of the construction: what it draws stands out, the rest follows.

    One that draws nothing, as of what is computed, is told with the next that does. ``number`` is
    that of the sheet; each page adds which step it is, of how many. Every mark and letter has on
    each page the place that it has on the finished sheet.
    """
    head, _, more = sheet_heading(drawing)
    layout = lowered(lay_out(drawing), more)
    said = sentences(drawing)
    staged = stages(drawing, said)
    (left, detail, _), (right, other, _) = parted(*boards(drawing, layout, "key", said))
    telling = when_told(drawing, staged)
    given = 0 if drawing.again else BEFORE
    field = layout.mechanism
    standing = appearing(drawing, field, left, staged, said)
    timed = [(max(stage, given), mark) for stage, mark in standing]
    timed += appearing(drawing, field, right, staged, said)
    detail += insets(drawing, layout.mechanism, [*left, *detail])
    detail += mechanism_signs(drawing, layout.mechanism, [*left, *detail])
    last = [*detail, *other, *plan_signs(drawing, layout.plan, [*right, *other])]
    block, same = (
        title_block(drawing, "steps", number),
        [*head, *panels(layout)],
    )
    lines = [
        (stage_of_crossing(drawing, each, staged), each)
        for each in crossings_on(drawing)
        if not is_gap(drawing, each)
    ]
    title = page_title(drawing)
    fields = [tuple(marks_at_stage(timed, stage, telling)) for stage in range(len(said))]
    return tuple(
        Page(
            420,
            297,
            (
                *sheet_frame(replace(block, sheet=numbered(drawing, number, stage, len(said)))),
                *same,
                *fields[stage],
                *(last if stage == len(said) - 1 else ()),
                *told(drawing, said, first, stage),
                *crossed(drawing, [line for at, line in lines if first <= at <= stage]),
            ),
            f"{title}, {stage + 1}/{len(said)}",
            drawing.words.language,
        )
        for first, stage in spans(fields, lambda first, last: to_do(said, first, last).is_held)
    )


def spans(
    fields: Sequence[Sequence[Mark]], held: Callable[[int, int], bool]
) -> Iterator[tuple[int, int]]:
    """The first and the last sentence of each page, which holds those from one to another or not.

    The last draws what is new on the page, or is followed by one for which there is no room.
    """
    first = 0
    for stage, field in enumerate(fields):
        is_new = any(NOW in mark.cls.split() for mark in field)
        if stage == len(fields) - 1 or is_new or not held(first, stage + 1):
            yield first, stage
            first = stage + 1


def numbered(drawing: Drawing, number: str, stage: int, total: int) -> str:
    """Which page of its sheet a step is, as the title block says it."""
    return drawing.words("page.sheet_step", sheet=number, number=stage + 1, all=total)


def crossed(drawing: Drawing, found: Sequence[Crossing]) -> Iterator[Mark]:
    """The flattest crossing of a sentence, and what a millimetre of pencil becomes there."""
    worst = flattest(tuple(found))
    if worst is None:
        return
    words = drawing.words
    text = words(
        "page.crossing",
        name=names_of_crossing(drawing, worst)[0],
        angle=words.fixed(degrees(worst.angle), 0),
        factor=words.significant(worst.factor, 2),
    )
    yield Text(BELOW[2] - 4, BELOW[1] + 4.5, text, "caption", 2.5, "end", name="crossing")


def stage_of_crossing(drawing: Drawing, crossing: Crossing, staged: Mapping[int, int]) -> int:
    """The sentence that draws a crossing."""
    group = group_closed(drawing, crossing)
    return staged[group.closing if group is not None and group.locus else crossing.number]


class ToDo(NamedTuple):
    """The lines of sentences to do with their feet, the height of their letters, the foot of a line
    below them, and whether the page holds them."""

    lines: list[tuple[float, str]]
    height: float
    low: float
    is_held: bool


def to_do(said: Sequence[Sentence], first: int, last: int) -> ToDo:
    """Sentences from one to another: large above the title block, else smaller and beside it."""
    markups = [
        f"{number}. {each.markup}" if first < last else each.markup
        for number, each in enumerate(said[first : last + 1], first + 1)
    ]
    for (height, leading), lowest in ((LARGE, ABOVE), (CLOSE, BELOW[3])):
        lines: list[tuple[float, str]] = []
        y = FIRST
        for markup in markups:
            for line in wrapped(markup, height, leading, y):
                lines.append((y, line))
                y += leading
        if y - leading <= lowest:
            return ToDo(lines, height, y, True)
    return ToDo(lines, height, y, False)


def wrapped(markup: str, height: float, leading: float, y: float) -> Iterator[str]:
    """The lines of a sentence from a foot on, narrower where they are beside the title block."""
    words = words_of(markup)
    while words:
        wide = RIGHT - LEFT if y <= ABOVE else BESIDE if y <= MARKED[1] else CLEAR
        line, held = flowed_pieces(words[:MOST], " ", wide, height)[0]
        yield line
        words, y = words[len(held) :], y + leading


def told(drawing: Drawing, said: Sequence[Sentence], first: int, stage: int) -> Iterator[Mark]:
    """The sentences to do in large lettering, and below them the last of those that are done."""
    words = drawing.words
    key, several = (
        ("page.steps_of", {"first": first + 1}) if first < stage else ("page.step_of", {})
    )
    caption = words(key, number=stage + 1, all=len(said), **several)
    yield Text(LEFT, TOP, caption, "caption", 3.5, name="step")
    lines, height, y, _ = to_do(said, first, stage)
    for foot, line in lines:
        yield Text(LEFT, foot, line, "caption", height, name="sentence")
    if y - 2.5 < MARKED[1]:
        yield LineMark(LEFT, y - 2.5, A3_TITLE_BLOCK[0] - 5, y - 2.5, "panel")
    done = [
        (f"{number}." if i == 0 else "", line)
        for number, sentence in enumerate(said[:first], 1)
        for i, line in enumerate(flowed(words_of(sentence.markup), " ", CLEAR, DONE[0]))
    ]
    room = max(int((BELOW[3] - y - 3.5) // DONE[1]) + 1, 0)
    shown = done
    if len(done) > room:  # a line tells that sentences before are left out
        shown = done[len(done) - room + 1 :]
        while shown and not shown[0][0]:
            shown = shown[1:]
        shown = [("", LEFT_OUT), *shown][:room]
    yield from written(shown, LEFT, y + 2.5, *DONE)
