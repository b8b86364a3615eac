"""A drawing made on the board of a task page: replayed, judged point by point, and given back.

A point is right where it lies at the key, within the error of a careful pencil. It follows where it
lies as the student's own earlier points lead to it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from math import cos, pi, sin
from typing import TYPE_CHECKING, Any

from msgspec import Struct
from msgspec.structs import replace

from graphkin.accuracy.pencil import Original, Pencil, PencilMark, closed, step_drawn, unmarked
from graphkin.classroom.grading.answer_numbers import OPEN, read_answer
from graphkin.classroom.grading.feedback import (
    LEFT,
    LETTER,
    RIGHT,
    Block,
    DrawingBack,
    text_block,
)
from graphkin.classroom.grading.probes import probes
from graphkin.classroom.printing.edition import Edition
from graphkin.classroom.printing.print_run import PrintOrder
from graphkin.classroom.roster.students import Taker
from graphkin.construction.board import PLANES, Board, board_given, replayed
from graphkin.construction.core.vocabulary import similar_point
from graphkin.drawing.field import A3, Field, SheetPaper, clipped
from graphkin.drawing.marks import LineMark, Mark, Page, Text
from graphkin.drawing.symbol_markup import escape
from graphkin.numbers.arithmetic import np
from graphkin.numbers.plane import Circle, Line, crossing_sine
from graphkin.reading.drawn_answers import cell, drawn_items, is_followed
from graphkin.reading.lettered_points import LetteredSheet
from graphkin.reading.marked_drawing import GREEN, RED, YELLOW, colour_of, point_mark, sentence
from graphkin.reading.point_reading import PointReading, ReadVerdict, pair
from graphkin.reading.read_sheet import sheets_of
from graphkin.reading.wrong_lines import wrong_lines
from graphkin.text import Words
from graphkin.text.errors import Refusals
from graphkin.writers.svg import text_element
from graphkin.writers.templates import from_template

if TYPE_CHECKING:
    from markupsafe import Markup as SafeMarkup

    from graphkin.classroom.grading.answers import Answers

DRAWINGS, SEED = 300, 23
"""The number of pencil drawings that give a point's error, and the seed of their errors."""
COMMON = 95.0
"""The percentage of careful drawings that the error of a point holds."""
NOWHERE = Page(A3.width, A3.height, ())
"""The page of a drawing that is on no paper."""
TURNED, ROUNDED = 1e-3, 0.5
"""The sine of the angle, and the distance in mm, by which two drawn lines may differ and be one."""
LONG = 1000.0
"""Half the length of a drawn line, in mm; its field cuts it."""


class JudgedSheet(Struct, frozen=True):
    """One sheet of a replayed drawing with its points, in mm of paper.

    ``corners`` are the places where points without a letter belong, each with its error.
    ``whys`` are sentences about known wrong lines, by the steps of the points found on them.
    """

    sheet: LetteredSheet
    board: Board
    points: tuple[PointReading, ...]
    corners: Mapping[int, tuple[complex, float]]
    whys: Mapping[int, Sequence[str]]


def add_drawings(opened: Edition, given: Answers, refusals: Refusals) -> dict[str, DrawingBack]:
    """Measure the drawings that students made on their pages; their pictures in green and red.

    Lengths and places that a student has not written are taken from the drawing. Where a log is no
    drawing of the task, they wait, and the reason goes to ``refusals``.
    """
    form = drawn_items(opened)
    found: dict[str, DrawingBack] = {}
    takers = {each.student.id: each for each in opened.takers}
    for who, log in given.drawings.items():
        own = given.of[who]
        blank = [item for item in form if item.field not in own or own[item.field].is_blank]
        own |= {item.field: read_answer(OPEN, item) for item in blank}
        with refusals.alone(takers[who].student.called):
            sheets = ReplayedDrawing(opened, takers[who], log)
            measured = sheets.answers([*blank])
            found[who] = given_back(sheets.judged, sheets.words)
            own |= measured
    return found


class ReplayedDrawing:
    """The drawing of a student, replayed from its log. Raises PageError as ``replayed`` does."""

    def __init__(self, opened: Edition, taker: Taker, log: str) -> None:
        self.words: Words = opened.words(taker.spoken or None)
        order = PrintOrder(opened.lab, opened.scene, self.words.language, "colour")
        self.sheets = sheets_of(order, taker, self.words.language)
        self.board = replayed(board_given(self.sheets.drawings), log)
        rubric = opened.lab.rubric
        self.pencil = Pencil(rubric.point, rubric.line)
        self.judged = [
            judged(LetteredSheet(drawing, NOWHERE), self.board, self.pencil)
            for drawing in self.sheets.drawings
        ]

    def answers(self, form: Sequence[Any]) -> dict[str, Any]:
        """The answers that the drawing gives to some fields, each with what follows."""
        places: dict[int, tuple[str, complex | None]] = {}
        verdicts: dict[int, str] = {}
        for each in self.judged:
            kind = each.sheet.kind
            own = {p.step: None if p.at is None else complex(*p.at) for p in each.points}
            places = given_places(each.sheet) | {n: (kind, at) for n, at in own.items()} | places
            verdicts = {point.step: point.verdict for point in each.points} | verdicts
        found = {}
        for probe in probes(self.sheets.mechanism, form):
            known = {step: ("", self.unlettered(step)) for step in probe.steps} | places
            answer = read_answer(cell(probe, known), probe.item)
            follows = is_followed(probe, verdicts)
            found[probe.item.field] = replace(answer, followed=follows) if follows else answer
        return found

    def unlettered(self, step: int) -> complex | None:
        """The drawn point without a letter that is where a step belongs; None if there is none."""
        for each in self.judged:
            if step not in each.corners:
                continue
            place, error = each.corners[step]
            plane = each.sheet.exact.program.steps[step].plane
            there = [
                complex(each.sheet.place(step, thing.value))
                for thing in self.board.own.values()
                if thing.kind == "image" and PLANES[thing.plane] is plane
            ]
            near = min(there, key=lambda at: abs(at - place), default=None)
            if near is not None and abs(near - place) <= error:
                return near
        return None


def given_places(sheet: LetteredSheet) -> dict[int, tuple[str, complex | None]]:
    """The printed points of a sheet."""
    steps = sheet.exact.program.steps
    return {
        number: (sheet.kind, complex(sheet.place(number, value)))
        for number, value in sheet.exact.trace.values.items()
        if isinstance(value, complex)
        and not steps[number].args
        and (steps[number].plane is sheet.drawing.plane or number in sheet.on_mechanism)
    }


# --- verdicts -------------------------------------------------------------------------------------


def judged(sheet: LetteredSheet, board: Board, pencil: Pencil) -> JudgedSheet:
    """The points of one sheet with their verdicts, in the order of the construction.

    Each point is expected where the student's own lettered points lead to it. Its error is that of
    a careful pencil from there on.
    """
    exact, letters = sheet.exact, {each.step: key for key, each in board.given.letters.items()}
    found, cloud = dict(exact.trace.values), dict(exact.trace.values)
    wrong, readings = set[int](), list[PointReading]()
    corners: dict[int, tuple[complex, float]] = {}
    for number in sheet.order:
        with np.errstate(all="ignore"):
            cloud[number] = step_drawn(exact, number, cloud, stream(exact, number), pencil)
        found[number] = followed(sheet, number, found)
        if number in sheet.corners:
            corners[number] = place_of(sheet, number, found), error_of(sheet, cloud, number, pencil)
        if number not in sheet.points or number not in letters:
            continue
        key = place_of(sheet, number, exact.trace.values)
        thing = board.named.get(letters[number])
        at = None if thing is None else complex(sheet.place(number, board.own[thing].value))
        own = nearest(at, [place_of(sheet, number, each) for each in ways(sheet, number, found)])
        error = error_of(sheet, cloud, number, pencil)
        behind = bool(wrong & behind_of(sheet, number))
        verdict = verdict_on(at, key, own, error, behind=behind)
        wrong |= {number} if verdict == "wrong" else set()
        if at is not None:
            found[number] = cloud[number] = sheet.value(number, at)
        readings.append(
            PointReading(
                exact.program.steps[number].name,
                number,
                None if at is None else pair(at),
                verdict,
                False,
                pair(key),
                pair(own),
                None if at is None else round(abs(at - own), 3),
                round(error, 3),
            )
        )
    whys = {step: list(whys_of(sheet, board, step, found)) for step in sorted(wrong)}
    return JudgedSheet(sheet, board, tuple(readings), corners, whys)


def ways(
    sheet: LetteredSheet, number: int, found: Mapping[int, Any]
) -> Iterator[Mapping[int, Any]]:
    """The values with a step as the sheet finds it, and by similarity where that finds it too."""
    yield found
    step = sheet.exact.program.steps[number]
    if step.action is similar_point and sheet.exact.by_hand(number) is not None:
        yield {**found, number: similar_point.value(*(found[arg] for arg in step.args))}


def nearest(at: complex | None, places: Sequence[complex]) -> complex:
    """The place nearest to a drawn point; the first one where nothing is drawn."""
    return places[0] if at is None else min(places, key=lambda place: abs(place - at))


def whys_of(
    sheet: LetteredSheet, board: Board, number: int, found: Mapping[int, Any]
) -> Iterator[str]:
    """What is wrong with the lines on which a student found a point, where that is known."""
    hand, steps = sheet.exact.by_hand(number), sheet.exact.program.steps
    own = steps[number if hand is None else hand].args
    plane = PLANES.index(sheet.drawing.plane)
    mm = board.given.millimetre[plane]
    drawn = [
        thing.value
        for thing in board.own.values()
        if thing.plane == plane and isinstance(thing.value, Line)
    ]
    named = set[int]()
    for step, line, said in wrong_lines(sheet.drawing, found):
        is_wrong = step == number or (step in own and not is_same(line, found[step], mm))
        if step not in named and is_wrong and any(is_same(each, line, mm) for each in drawn):
            named.add(step)  # of two names for one wrong line the first holds
            yield said


def is_same(one: Line, other: Line, mm: float) -> bool:
    """Whether two lines of a plan are one, up to what a typed length is rounded by."""
    gap = (other.point - one.point) / one.along
    return bool(
        crossing_sine(one, other) < TURNED and abs(gap.imag * abs(one.along)) < ROUNDED * mm
    )


def stream(exact: Original, number: int) -> Any:
    """The random errors of a step in the drawings that give its error: always the same."""
    mark = exact.marks.get(number)
    if mark is None:
        return None
    return np.random.Generator(np.random.PCG64([SEED, number])).standard_normal(
        (DRAWINGS, mark.errors)
    )


def place_of(sheet: LetteredSheet, number: int, values: Mapping[int, Any]) -> complex:
    """The place of a step on paper; that of the key where the values have none."""
    place = complex(np.atleast_1d(sheet.place(number, values[number]))[0])
    if np.isfinite(place):
        return place
    return complex(sheet.place(number, sheet.exact.trace.values[number]))


def error_of(sheet: LetteredSheet, cloud: Mapping[int, Any], step: int, pencil: Pencil) -> float:
    """The error in mm that 95 of 100 careful drawings of a step keep to."""
    places = np.atleast_1d(sheet.place(step, cloud[step]))
    places = places[np.isfinite(places)]
    if not len(places):
        return pencil.mark
    middle = complex(np.median(places.real), np.median(places.imag))
    return max(float(np.percentile(abs(places - middle), COMMON)), pencil.mark)


def followed(sheet: LetteredSheet, number: int, found: Mapping[int, Any]) -> Any:
    """The value of a step as it follows from the student's points; the key's where it cannot."""
    exact = sheet.exact
    try:
        with np.errstate(all="ignore"):
            if exact.marks.get(number) is PencilMark.CLOSING:
                return closed(exact, number, found, np.zeros(1))
            return unmarked(exact, number, found)
    except (ArithmeticError, ValueError):
        return exact.trace.values[number]


def behind_of(sheet: LetteredSheet, number: int) -> set[int]:
    """The steps from which a step is drawn."""
    found, waiting = set[int](), [number]
    while waiting:
        for source in sheet.sources.get(waiting.pop(), ()):
            if source not in found:
                found.add(source)
                waiting.append(source)
    return found | {sheet.found_by[each] for each in found & sheet.found_by.keys()}


def verdict_on(
    at: complex | None, key: complex, own: complex, error: float, *, behind: bool
) -> ReadVerdict:
    """The verdict on a point; ``behind`` says that a point from which it is drawn is wrong."""
    if at is None:
        return "missing"
    if abs(at - key) <= error:
        return "right"
    if abs(at - own) <= error:
        return "follows" if behind else "right"
    return "wrong"


# --- the picture ----------------------------------------------------------------------------------


def given_back(sheets: Sequence[JudgedSheet], words: Words) -> DrawingBack:
    """The drawing in green and red with a remark on each point."""
    title, legend = words("marked.title"), words("marked.legend")
    said = set[int]()
    sheet_parts = []
    for each in sheets:
        points = [point for point in each.points if point.step not in said]
        said |= {point.step for point in points}
        sheet_parts.append(
            (
                words(f"sheet.{each.sheet.kind}"),
                [(field, list(shapes(each, field, words))) for field in fields(each)],
                [(remark_on(each, point, words), LOOKS[colour_of(point)]) for point in points],
            )
        )
    markup = from_template("reading/web/board.html", title=title, legend=legend, sheets=sheet_parts)
    blocks: list[Block] = [text_block(title, 3.5), text_block(escape(legend), LETTER)]
    for name, drawn, lines in sheet_parts:
        blocks += [text_block(name, LETTER), on_paper(drawn, sheets[0].sheet.drawing.paper)]
        blocks += [remark(text, look) for text, look in lines]
    return DrawingBack(markup, tuple(blocks))


def remark_on(each: JudgedSheet, point: PointReading, words: Words) -> str:
    """The markup of a remark on a point, with what is wrong in its construction."""
    whys = each.whys.get(point.step, ())
    return " ".join([escape(sentence(point, words)) + "." * bool(whys), *dict.fromkeys(whys)])


LOOKS = {GREEN: "right", RED: "wrong", YELLOW: "wrong"}
"""The look of a point by the colour of its remark."""
CHORDS = 96
"""The chords for a circle on paper."""


def on_paper(drawn: Sequence[tuple[Field, Sequence[Shape]]], paper: SheetPaper) -> Block:
    """The fields of a sheet side by side, in the width of a page."""
    marks: list[Mark] = []
    first, upper, last, lower = paper.fields
    scale = (RIGHT - LEFT) / (last - first)

    def place(x: float, y: float) -> tuple[float, float]:
        return LEFT + (x - first) * scale, (y - upper) * scale

    for field, every in drawn:
        left, top, right, low = field.rect
        edge = [(left, top), (right, top), (right, low), (left, low), (left, top)]
        marks += (LineMark(*place(*p), *place(*q), "panel") for p, q in pairwise(edge))
        for shape in every:
            if shape.label is not None:
                x, y = place(*shape.numbers)
                marks.append(Text(x, y, shape.label.markup, shape.look, LETTER))
                continue
            for p, q in pairwise(shape.outline):
                if (cut := clipped(p, q, field.rect)) is not None:
                    marks.append(LineMark(*place(*cut[0]), *place(*cut[1]), INKED[shape.look]))
    return (lower - upper) * scale + 3.0, marks


INKED = {"own": "construction", "dot": "dimension", "bar": "dimension"} | {
    look: look for look in LOOKS.values()
}
"""The classes of lines on paper by the looks of shapes."""


def remark(text: str, look: str) -> Block:
    """A remark on a point, in its colour."""
    height, marks = text_block(text, LETTER)
    return height - 1.6, [replace(mark, cls=look) for mark in marks if isinstance(mark, Text)]


def fields(each: JudgedSheet) -> tuple[Field, Field]:
    """The field of the mechanism and that of the plan."""
    return each.sheet.layout.mechanism, each.sheet.layout.plan


class Shape(Struct, frozen=True):
    """A shape of a picture: a line, a circle or a letter, in mm of paper."""

    tag: str
    look: str
    numbers: tuple[float, ...]
    label: Text | None = None

    @property
    def svg(self) -> SafeMarkup:
        """Its label for a browser."""
        from markupsafe import Markup

        return Markup("" if self.label is None else text_element(self.label))

    @property
    def outline(self) -> list[tuple[float, float]]:
        """The shape as a chain of places."""
        x, y, *rest = self.numbers
        if self.tag == "line":
            return [(x, y), (rest[0], rest[1])]
        turns = (2 * pi * k / CHORDS for k in range(CHORDS + 1))
        return [(x + rest[0] * cos(turn), y + rest[0] * sin(turn)) for turn in turns]


def shapes(each: JudgedSheet, field: Field, words: Words) -> Iterator[Shape]:
    """All that was drawn in a field, then its points in green and red."""
    board, drawing = each.board, each.sheet.drawing
    plane = 0 if field is each.sheet.layout.mechanism else PLANES.index(drawing.plane)
    for thing in (*board.given.things.values(), *board.own.values()):
        if thing.plane != plane:
            continue
        if isinstance(thing.value, Line):
            x, y = field(thing.value.point)
            u, v = field.way(thing.value.along)
            ends = (x - LONG * u, y - LONG * v, x + LONG * u, y + LONG * v)
            yield Shape("line", "own", ends)
        elif isinstance(thing.value, Circle):
            size = thing.value.radius * field.mm
            yield Shape("circle", "own", (*field(thing.value.centre), size))
        elif thing.kind in ("point", "image"):
            yield Shape("circle", "dot", (*field(thing.value), 0.5))
    for key in (*board.given.bars, *board.given.arrows):
        ends_of = {**board.given.bars, **board.given.arrows}[key][:2]
        if all(end in board.named or end in board.given.things for end in ends_of):
            tail, tip = (board.thing(end) for end in ends_of)
            if tail.plane == plane:
                yield Shape("line", "bar", (*field(tail.value), *field(tip.value)))
    steps = each.sheet.exact.program.steps
    for point in each.points:
        if point.at is None or PLANES.index(steps[point.step].plane) != plane:
            continue
        look = LOOKS[colour_of(point)]
        mark = point_mark(point, field.rect, words)
        yield from (Shape("line", look, line) for line in mark.lines)
        yield Shape("circle", look, (*mark.at, 2.2))
        yield Shape("text", look, (mark.label.x, mark.label.y), mark.label)
