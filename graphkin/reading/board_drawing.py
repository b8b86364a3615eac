"""A drawing made on the board of a task page: replayed, judged point by point, and given back.

A point is right where it lies at the key, within the error of a careful pencil. It follows where it
lies as the student's own earlier points lead to it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from msgspec import Struct
from msgspec.structs import replace

from graphkin.accuracy.pencil.pencil import Pencil, PencilMark
from graphkin.accuracy.pencil.redrawing import closed, redrawn, unmarked
from graphkin.classroom.grading.answer_numbers import OPEN, read_answer
from graphkin.classroom.grading.probes import Probe, probes
from graphkin.classroom.printing.edition import Edition
from graphkin.classroom.printing.print_work import PrintOrder
from graphkin.classroom.roster.taker import Taker
from graphkin.construction.board import PLANES, Board, board_given, replayed
from graphkin.drawing.field import Field
from graphkin.drawing.marks import Page
from graphkin.numbers.arithmetic import np
from graphkin.numbers.plane import Circle, Line
from graphkin.reading.drawn_answers import cell, drawn_items, is_followed
from graphkin.reading.lettered_points import LetteredSheet
from graphkin.reading.marked_drawing import colour_of, sentence
from graphkin.reading.point_reading import PointReading, ReadVerdict, pair
from graphkin.reading.read_sheet import Sheets, sheets_of
from graphkin.text import Words
from graphkin.text.errors import Refusals
from graphkin.writers.templates import from_template

if TYPE_CHECKING:
    from markupsafe import Markup

    from graphkin.classroom.grading.answers import Answers

DRAWINGS, SEED = 300, 23
"""The number of pencil drawings that give a point's error, and the seed of their errors."""
COMMON = 95.0
"""The percentage of careful drawings that the error of a point holds."""
NOWHERE = Page(420.0, 297.0, ())
"""The page of a drawing that is on no paper."""
LONG = 1000.0
"""Half the length of a drawn line, in mm; its field cuts it."""


class JudgedSheet(Struct, frozen=True):
    """One sheet of a replayed drawing with its points, in mm of paper."""

    sheet: LetteredSheet
    board: Board
    points: tuple[PointReading, ...]


def add_drawings(opened: Edition, given: Answers, refusals: Refusals) -> dict[str, str]:
    """Measure the drawings that students made on their pages; their pictures in green and red.

    Lengths and places that a student has not written are taken from the drawing. Where a log is no
    drawing of the task, they wait, and the reason goes to ``refusals``.
    """
    form = drawn_items(opened)
    found: dict[str, str] = {}
    takers = {each.student.id: each for each in opened.takers}
    for who, log in given.drawings.items():
        own = given.of[who]
        blank = [item for item in form if item.field not in own or own[item.field].is_blank]
        own |= {item.field: read_answer(OPEN, item) for item in blank}
        with refusals.alone(takers[who].student.called):
            sheets = Drawn(opened, takers[who], log)
            measured = sheets.answers([*blank])
            found[who] = picture(sheets.judged, sheets.words)
            own |= measured
    return found


class Drawn:
    """The drawing of a student, replayed from its log. Raises PageError as ``replayed`` does."""

    def __init__(self, opened: Edition, taker: Taker, log: str) -> None:
        self.words: Words = opened.words(taker.spoken or None)
        order = PrintOrder(opened.lab, opened.scene, self.words.language, "colour")
        self.sheets: Sheets = sheets_of(order, taker, self.words.language)
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
            known = {step: ("", self.unlettered(probe, step)) for step in probe.steps} | places
            answer = read_answer(cell(probe, known), probe.item)
            follows = is_followed(probe, verdicts)
            found[probe.item.field] = replace(answer, followed=follows) if follows else answer
        return found

    def unlettered(self, probe: Probe, step: int) -> complex | None:
        """The drawn point without a letter that is where a step would be; None if there is none."""
        for each in self.judged:
            steps = each.sheet.exact.program.steps
            if steps[step].plane is not each.sheet.drawing.plane:
                continue
            if step not in each.sheet.exact.trace.values:
                continue
            key = complex(each.sheet.place(step, each.sheet.exact.trace.values[step]))
            there = [
                complex(each.sheet.place(step, thing.value))
                for thing in self.board.own.values()
                if thing.kind == "image" and PLANES[thing.plane] is steps[step].plane
            ]
            near = min(there, key=lambda place: abs(place - key), default=None)
            if near is not None and abs(near - key) <= errors_of(each.sheet, self.pencil, step):
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


def clouds(sheet: LetteredSheet, pencil: Pencil) -> Mapping[int, Any]:
    """The value of every step in many careful drawings of the key."""

    def errors(number: int, mark: PencilMark) -> Any:
        stream = np.random.Generator(np.random.PCG64([SEED, number]))
        return stream.standard_normal((DRAWINGS, mark.errors))

    return redrawn(sheet.exact, pencil, errors)


def errors_of(sheet: LetteredSheet, pencil: Pencil, step: int) -> float:
    """The error of one step in careful drawings, in mm of paper."""
    return error_of(sheet, clouds(sheet, pencil), step, pencil)


def error_of(sheet: LetteredSheet, cloud: Mapping[int, Any], step: int, pencil: Pencil) -> float:
    """The error in mm that 95 of 100 careful drawings of a step keep to."""
    key = sheet.place(step, sheet.exact.trace.values[step])
    off = abs(np.atleast_1d(sheet.place(step, cloud[step])) - key)
    off = off[np.isfinite(off)]
    return max(float(np.percentile(off, COMMON)) if len(off) else 0.0, pencil.mark)


def judged(sheet: LetteredSheet, board: Board, pencil: Pencil) -> JudgedSheet:
    """The points of one sheet with their verdicts, in the order of the construction."""
    cloud, exact = clouds(sheet, pencil), sheet.exact
    own_steps = {each.step: key for key, each in board.given.letters.items()}
    found, wrong, readings = dict(exact.trace.values), set[int](), list[PointReading]()
    points = [number for number in sheet.points if number in own_steps]
    for number in sheet.order:
        found[number] = followed(sheet, number, found)
        if number not in points:
            continue
        key = complex(sheet.place(number, exact.trace.values[number]))
        own = complex(np.atleast_1d(sheet.place(number, found[number]))[0])
        own = own if np.isfinite(own) else key
        thing = board.named.get(own_steps[number])
        at = None if thing is None else complex(sheet.place(number, board.own[thing].value))
        error = error_of(sheet, cloud, number, pencil)
        behind = bool(wrong & behind_of(sheet, number))
        verdict = verdict_on(at, key, own, error, behind=behind)
        if verdict == "wrong":
            wrong.add(number)
        if at is not None:
            found[number] = sheet.value(number, at)
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
    return JudgedSheet(sheet, board, tuple(readings))


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


def picture(sheets: Sequence[JudgedSheet], words: Words) -> Markup:
    """The drawing in green and red with a remark on each point, for a feedback page."""
    return from_template(
        "reading/web/board.html",
        title=words("marked.title"),
        legend=words("marked.legend"),
        sheets=[
            (
                words(f"sheet.{each.sheet.kind}"),
                [(box(field), list(shapes(each, field))) for field in fields(each)],
                [(sentence(point, words), colour_of(point)) for point in each.points],
            )
            for each in sheets
        ],
    )


def fields(each: JudgedSheet) -> tuple[Field, Field]:
    """The field of the mechanism and that of the plan."""
    return each.sheet.layout.mechanism, each.sheet.layout.plan


def box(field: Field) -> str:
    """The view of a field."""
    left, top, right, bottom = field.rect
    return f"{left:.1f} {top:.1f} {right - left:.1f} {bottom - top:.1f}"


class Shape(Struct, frozen=True):
    """A shape of a picture: a line, a circle or a letter, in mm of paper."""

    tag: str
    look: str
    numbers: tuple[float, ...]
    text: str = ""


def shapes(each: JudgedSheet, field: Field) -> Iterator[Shape]:
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
        ends_of = (board.given.bars | board.given.arrows)[key][:2]
        if all(end in board.named or end in board.given.things for end in ends_of):
            tail, tip = (board.thing(end) for end in ends_of)
            if tail.plane == plane:
                yield Shape("line", "bar", (*field(tail.value), *field(tip.value)))
    steps = each.sheet.exact.program.steps
    for point in each.points:
        if point.at is None or PLANES.index(steps[point.step].plane) != plane:
            continue
        colour = colour_of(point)
        if point.verdict == "wrong":
            yield Shape("line", colour, (*point.at, *point.own))
        yield Shape("circle", colour, (*point.at, 2.2))
        yield Shape("text", colour, (point.at[0] + 2.6, point.at[1] - 2.6), point.name)
