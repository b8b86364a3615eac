"""A simulated student: the construction drawn anew with a pencil, and its truth.

Nothing here uses what reads or marks. Every line is turned, every point and opening shifted by
errors of its own, which go on through the construction; a mistake is made in one step, and what
comes after it is drawn rightly from there.
"""

from __future__ import annotations

from functools import lru_cache
from itertools import combinations, pairwise
from math import radians
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from graphkin.classroom.printing.edition import read_edition
from graphkin.classroom.printing.personal import joined
from graphkin.classroom.printing.print_run import PrintOrder, Sheets
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.layout import Layout, lay_out, spans
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.run import StepFailed, run
from graphkin.construction.higher_class.trial_rates import trial_rates
from graphkin.documents import sheet as documents
from graphkin.drawing.field import Field
from graphkin.drawing.marks import Arc, CircleMark, LineMark, Page, Polyline, Text
from graphkin.drawing.symbols import arrow, head
from graphkin.numbers.arithmetic import FLOAT, turn_by
from graphkin.numbers.plane import Circle, Line, Ratio
from graphkin.text.errors import GraphkinError
from graphkin.writers.pdf import write_pdf
from tests.reading.hand_letters import Writing, writing_of, written

DENSITY = 10.0
"""Pixels of a drawn sheet for each mm."""
SHIFT = 4
"""Bits of a pixel's fraction."""
NORMAL_95, RADIAL_95 = 1.96, 2.4477
CLEAR = 3.0
"""Millimetres by which a mistake moves its point at least."""
LONG, OFF, NEAR = 12.0, 2.0, 0.05
"""The shortest vector that ends elsewhere, by how much at least, and the same place; mm."""


PLANS: dict[str, tuple[complex, bool]] = {
    "halved": (0.5 + 0j, False),
    "spun": (complex(np.exp(1j * radians(30))), False),
    "mirrored": (-1 + 0j, True),
}
"""How a whole plan may be drawn about its pole: size and turn, and whether it is mirrored first."""


class TruePoint(Struct, frozen=True):
    """A lettered point as it was drawn: where (mm of paper, y down), and what is true of it."""

    name: str
    step: int
    at: tuple[float, float] | None
    verdict: str


class Habits(Struct, frozen=True):
    """How somebody draws: pencil (mm, degrees), greys, width, wobble, and what goes wrong."""

    point: float = 0.4
    line: float = 0.4
    grey: float = 0.6
    width: float = 0.32
    wobble: float = 0.06
    mistake: bool = False
    missing: bool = False
    headless: float = 0.1
    stray: int = 0
    erased: bool = False
    letters: bool = True
    end: str = ""
    """What alone is wrong: a vector of the plan is too ``long``, too ``short``, or has its head
    ``turned``; the letters of two points are ``exchanged``; or the whole plan is ``halved``,
    ``spun`` or ``mirrored``.
    """


class DrawnSheet(Struct, frozen=True):
    """A drawn sheet: grey from 0 to 255, 10 pixels a mm; its code, its kind, its points."""

    image: Any
    code: str
    kind: str
    points: tuple[TruePoint, ...]


@lru_cache(maxsize=16)
def sheets_of(folder: Path, code: str) -> Sheets:
    """The sheets of a student of a class folder."""
    edition = read_edition(folder)
    taker = next(each for each in edition.takers if each.code == code)
    return Sheets(PrintOrder(edition.lab, edition.scene, "en", "colour"), taker)


@lru_cache(maxsize=16)
def printed(folder: Path, code: str, kind: str) -> Any:
    """A student's task sheet as it leaves the printer."""
    found = next(each for each in sheets_of(folder, code).of("task") if each.kind == kind)
    leaves = sheets_of(folder, code).paper.leaves
    return np.hstack([printed_page(page) for page in found.pages[:leaves]])


def printed_page(sheet: Page) -> Any:
    """A page as it leaves the printer."""
    import pypdfium2

    data = write_pdf([sheet], "colour", title="task")
    page = pypdfium2.PdfDocument(data)[0]
    bitmap = page.render(scale=DENSITY * 25.4 / 72 * (1 - 1e-6), grayscale=True)
    return np.array(bitmap.to_numpy()).reshape(bitmap.height, bitmap.width)


@lru_cache(maxsize=6)
def drawn_sheet(folder: Path, code: str, kind: str, habits: Habits, seed: int) -> DrawnSheet:
    """A student's sheet with the construction drawn on it, kept for those who look at it."""
    sheets = sheets_of(folder, code)
    drawing = next(each for each in sheets.drawings if each.kind == kind)
    for attempt in range(40):
        rng = np.random.default_rng([seed, attempt])
        try:
            own, points, hidden = drawn_points(sheets, drawing, habits, rng)
            page = own_page(drawing, own)
            if habits.end == "exchanged":
                page, points = exchanged(page, drawing, points, rng)
            elif habits.end in PLANS:
                page, points = misplaced(page, drawing, points, habits.end)
            elif habits.end:
                page, points = misdrawn(page, drawing, points, habits.end, rng)
        except (GraphkinError, StepFailed, ZeroDivisionError):
            continue
        break
    else:
        raise AssertionError("no drawing stays on the sheet")
    image = printed(folder, code, kind).astype(np.float32)
    ink = pencilled(page, drawing, hidden, habits, rng, image.shape)
    drawn = np.clip(image * (1 - ink), 0, 255).astype(np.uint8)
    drawn.setflags(write=False)
    return DrawnSheet(drawn, code, kind, points)


# --- the construction -----------------------------------------------------------------------------


def lettered_steps(drawing: Drawing) -> list[int]:
    """The steps of the letters that a hand puts on the sheet, and of corners of polygons.

    Pivots, poles and starts of polygons are printed.
    """
    found = []
    for planes in ((Plane.MECHANISM,), (drawing.plane,)):
        for number, step, value in drawing.steps(*planes):
            known = step.part in (Part.POSITION, Part.VELOCITY, Part.ACCELERATION)
            lettered = isinstance(value, complex) and bool(step.name) and not step.arrow and known
            lettered |= isinstance(value, complex) and step.plane is Plane.FORCES
            if lettered and step.given is None and step.args:
                found.append(number)
    return found


def erring(drawing: Drawing, habits: Habits, rng: Any, wrong: int | None, layout: Layout) -> Any:
    """The trace as a hand draws it, with a mistake in one step."""
    program, exact = drawing.trace.program, drawing.trace.values
    mark, turn = habits.point / RADIAL_95, radians(habits.line) / NORMAL_95
    manner = int(rng.integers(3))

    def hook(number: int, step: Any, value: Any) -> Any:
        if isinstance(exact[number], Ratio) and isinstance(value, complex):
            return Ratio(value, 0j, 1.0)
        if step.plane is Plane.NUMBERS or step.arrow or step.given is not None:
            return value
        mm = layout.field(step).mm
        if step.plane not in (Plane.MECHANISM, drawing.plane):
            mm = 1e12
        if isinstance(value, Line):
            off = turn * float(rng.normal())
            if number == wrong:
                off += radians((90.0, 12.0, -18.0)[manner])
            return Line(value.point, value.along * turn_by(off))
        if isinstance(value, Circle):
            return Circle(value.centre, value.radius + mark / mm * float(rng.normal()))
        if isinstance(value, complex) and step.args and value != 0:
            shift = mark / mm * complex(rng.normal(), rng.normal())
            start = 0j
            if number == wrong and step.args:
                tail = exact.get(step.args[0])
                start = tail if isinstance(tail, complex) else 0j
                value = start + (value - start) * (0.7, 1.25, -1.0)[manner]
            return value + shift
        return value

    needed = tuple(drawing.trace.values)
    given = {n: exact[n] for n in needed if program.steps[n].given is not None}
    given |= {n: exact[n] for n in (program.seconds, *drawn_trials(drawing)) if n in exact}
    values = drawing.scene.values
    return run(program, needed, values, FLOAT, hook=hook, overrides=given, by_hand=True)


def drawn_trials(drawing: Drawing) -> tuple[int, ...]:
    """The steps of what a hand tries in trial plans."""
    return tuple(trial_rates(drawing.scene, drawing.trace.program))


def drawn_points(
    sheets: Sheets, drawing: Drawing, habits: Habits, rng: Any
) -> tuple[Any, tuple[TruePoint, ...], frozenset[int]]:
    """What somebody draws, where the letters stand then, and the steps that are left out."""
    layout = lay_out(drawing)
    program, names = drawing.trace.program, lettered_steps(drawing)
    plan = [n for n in names if program.steps[n].plane is drawing.plane]
    wrong = None
    if habits.mistake:
        starts = [
            number
            for number, step, value in drawing.steps(drawing.plane)
            if isinstance(value, Line | complex) and not step.arrow and step.args and step.of
        ]
        wrong = int(rng.choice(starts))
    own = erring(drawing, habits, rng, wrong, layout)
    hidden = frozenset[int]()
    if habits.missing:
        lost = int(rng.choice(plan[1:] or plan))
        hidden = program.descendants(lost) | set(range(lost, len(program.steps)))
        hidden |= {n for n in program.steps[lost].args if n not in names and n in behind(drawing)}
        hidden = frozenset(hidden)
    after = after_of(drawing, wrong)
    found: list[TruePoint] = []
    struck = False
    for number in names:
        field = layout.field(program.steps[number])
        value, exact = own.values[number], drawing.trace.values[number]
        at = field(value)
        off = abs(value - exact) * field.mm
        verdict = "right"
        if number in hidden:
            at, verdict = None, "missing"
        elif number in after:
            first = not struck
            struck = True
            verdict = "wrong" if first else "follows"
            if first and off < CLEAR:
                raise StepFailed(number, program.steps[number], ())
        if at is not None and not inside(at, field):
            raise StepFailed(number, program.steps[number], ())
        found.append(TruePoint(program.steps[number].name, number, at, verdict))
    if wrong is not None and not struck:
        raise StepFailed(wrong, program.steps[wrong], ())
    return own, tuple(found), hidden


def behind(drawing: Drawing) -> frozenset[int]:
    """The lines of the plan, which a hand draws to find a point."""
    return frozenset(n for n, _, v in drawing.steps(drawing.plane) if isinstance(v, Line))


def after_of(drawing: Drawing, wrong: int | None) -> frozenset[int]:
    """The steps that a mistake reaches, by the ways of the hand."""
    reached = set() if wrong is None else {wrong}
    steps = drawing.trace.program.steps
    for number in drawing.trace.values:
        step = steps[number]
        hand = step.by_hand
        ways = {hand} if hand is not None and hand in drawing.trace.values else {*step.args}
        if reached.intersection(ways):
            reached.add(number)
    return frozenset(reached)


def inside(at: tuple[float, float], field: Field) -> bool:
    """Whether a place lies well in its field."""
    left, top, right, bottom = field.rect
    return left + 4 < at[0] < right - 4 and top + 4 < at[1] < bottom - 6


def misdrawn(
    page: Page, drawing: Drawing, points: tuple[TruePoint, ...], end: str, rng: Any
) -> tuple[Page, tuple[TruePoint, ...]]:
    """A page on which one vector ends 5 to 60 % off its point, or has its head at its tail.

    Its head, its letter and its ring go with its end; all other lines stay at the right place.
    """
    steps, layout = drawing.trace.program.steps, lay_out(drawing)
    ends = {each.at: each for each in points if steps[each.step].plane is drawing.plane}
    shafts = [
        (mark, each)
        for mark in page.marks
        if isinstance(mark, LineMark) and mark.step is not None and steps[mark.step].arrow
        for at, each in ends.items()
        if at is not None and np.hypot(mark.x2 - at[0], mark.y2 - at[1]) < NEAR
        if np.hypot(mark.x2 - mark.x1, mark.y2 - mark.y1) > LONG
    ]
    if not shafts:
        raise StepFailed(0, steps[0], ())
    shaft, point = shafts[int(rng.integers(len(shafts)))]
    tail, tip = complex(shaft.x1, shaft.y1), complex(shaft.x2, shaft.y2)
    low, high = {"long": (1.05, 1.6), "short": (0.4, 0.95), "turned": (1.0, 1.0)}[end]
    moved = tail + (tip - tail) * float(rng.uniform(low, high))
    if end != "turned" and (
        abs(moved - tip) < OFF or not inside((moved.real, moved.imag), layout.plan)
    ):
        raise StepFailed(point.step, steps[point.step], ())
    one, other = (moved, tail) if end == "turned" else (tail, moved)
    drawn = list(
        arrow((one.real, one.imag), (other.real, other.imag), shaft.cls, shaft.name, shaft.step)
    )
    shift = moved - tip
    marks: list[Any] = []
    for mark in page.marks:
        if mark is shaft:
            marks += drawn
        elif "arrowhead" in mark.cls and mark.step == shaft.step and near(mark, tip):
            continue
        elif isinstance(mark, Text) and mark.step == point_mark(page, tip):
            marks.append(replace(mark, x=mark.x + shift.real, y=mark.y + shift.imag))
        elif isinstance(mark, CircleMark) and abs(complex(mark.cx, mark.cy) - tip) < NEAR:
            marks.append(replace(mark, cx=moved.real, cy=moved.imag))
        else:
            marks.append(mark)
    told = replace(point, at=(moved.real, moved.imag), verdict="wrong")
    told_points = tuple(told if each is point else each for each in points)
    return replace(page, marks=type(page.marks)(marks)), told_points


def misplaced(
    page: Page, drawing: Drawing, points: tuple[TruePoint, ...], kind: str
) -> tuple[Page, tuple[TruePoint, ...]]:
    """A page whose whole plan is scaled, turned or mirrored about its pole."""
    steps, layout = drawing.trace.program.steps, lay_out(drawing)
    size, mirrored = PLANS[kind]
    pole = next(
        complex(mark.cx, mark.cy)
        for mark in page.marks
        if isinstance(mark, CircleMark) and mark.cls.startswith("pole")
    )

    def moved(x: float, y: float) -> tuple[float, float]:
        way = complex(x, y) - pole
        found = pole + size * (way.conjugate() if mirrored else way)
        return found.real, found.imag

    marks: list[Any] = []
    for mark in page.marks:
        if mark.step is None or steps[mark.step].plane is not drawing.plane:
            marks.append(mark)
        elif isinstance(mark, LineMark):
            (x1, y1), (x2, y2) = moved(mark.x1, mark.y1), moved(mark.x2, mark.y2)
            marks.append(replace(mark, x1=x1, y1=y1, x2=x2, y2=y2))
        elif isinstance(mark, Polyline) and "arrowhead" in mark.cls:
            tip = complex(*moved(*mark.points[0]))
            back = complex(*moved(*mark.points[1])) + complex(*moved(*mark.points[2])) - 2 * tip
            tail = tip + back
            marks.append(head((tail.real, tail.imag), (tip.real, tip.imag), mark.cls))
        elif isinstance(mark, Polyline):
            marks.append(replace(mark, points=tuple(moved(*each) for each in mark.points)))
        elif isinstance(mark, CircleMark):
            cx, cy = moved(mark.cx, mark.cy)
            marks.append(replace(mark, cx=cx, cy=cy))
        elif isinstance(mark, Text):
            x, y = moved(mark.x, mark.y)
            marks.append(replace(mark, x=x, y=y))
        else:
            marks.append(mark)
    found = []
    first = True
    for each in points:
        if each.at is not None and steps[each.step].plane is drawing.plane:
            at = moved(*each.at)
            if not inside(at, layout.plan):
                raise StepFailed(each.step, steps[each.step], ())
            found.append(replace(each, at=at, verdict="wrong" if first else "follows"))
            first = False
        else:
            found.append(each)
    return replace(page, marks=type(page.marks)(marks)), tuple(found)


def exchanged(
    page: Page, drawing: Drawing, points: tuple[TruePoint, ...], rng: Any
) -> tuple[Page, tuple[TruePoint, ...]]:
    """A page on which the letters of two points of the plan are exchanged."""
    steps = drawing.trace.program.steps
    labels = {
        each.step: (each, mark)
        for each in points
        if steps[each.step].plane is drawing.plane and each.at is not None
        for mark in page.marks
        if isinstance(mark, Text) and mark.step == point_mark(page, complex(*each.at))
        if mark.markup[:1].isalpha() or mark.letters
    }
    pairs = [
        pair
        for pair in combinations(labels.values(), 2)
        if pair[0][0].name[0] != pair[1][0].name[0] and pair[0][1] is not pair[1][1]
        if all(len(one.letters) < 2 for _, one in pair)
    ]
    if not pairs:
        raise StepFailed(0, steps[0], ())
    (one, first), (other, second) = pairs[int(rng.integers(len(pairs)))]
    marks: list[Any] = []
    for mark in page.marks:
        if mark is first:
            marks.append(replace(first, markup=second.markup))
        elif mark is second:
            marks.append(replace(second, markup=first.markup))
        else:
            marks.append(mark)
    told = {
        one.step: replace(one, at=other.at, verdict="wrong"),
        other.step: replace(other, at=one.at, verdict="wrong"),
    }
    told_points = tuple(told.get(each.step, each) for each in points)
    return replace(page, marks=type(page.marks)(marks)), told_points


def near(mark: Any, tip: complex) -> bool:
    """Whether a head's tip is at a place."""
    return abs(complex(*mark.points[0]) - tip) < NEAR


def point_mark(page: Page, tip: complex) -> int | None:
    """The step whose ring is at a place, and whose letter stands there."""
    for mark in page.marks:
        if isinstance(mark, CircleMark) and abs(complex(mark.cx, mark.cy) - tip) < NEAR:
            return mark.step
    return None


def own_page(drawing: Drawing, own: Any) -> Page:
    """The key of what somebody draws, at the places of the task."""
    mine = replace(drawing, trace=own)
    layout = lay_out(drawing)
    places = replace(layout, spans=spans(mine, layout))
    said = documents.Writing([], [], frozenset())
    return joined(documents.sheet(mine, "key", "1/1", places, said))


# --- the pencil -----------------------------------------------------------------------------------


def pencilled(
    page: Page, drawing: Drawing, hidden: frozenset[int], habits: Habits, rng: Any, shape: Any
) -> Any:
    """How much of the light the pencil takes, from 0 to 1."""
    ink, hand = np.zeros(shape, np.float32), writing_of(rng)
    by_hand = {"link", "plate", "pin", "slider", "outline"}
    for mark in page.marks:
        drawn = mark.step is not None or mark.cls.split()[0] in by_hand
        if not drawn or mark.step in hidden or "detail" in mark.cls or "scheme" in mark.cls:
            continue
        if "arrowhead" in mark.cls and rng.random() < habits.headless:
            continue
        if isinstance(mark, Text) and not habits.letters:
            continue
        for path in strokes(mark, habits, hand, rng):
            stroke(ink, path, habits, rng)
    for _ in range(habits.stray):
        left, top = rng.uniform([150, 50], [380, 180])
        way = rng.uniform(-30, 30, 2)
        stroke(ink, np.array([[left, top], [left + way[0], top + way[1]]]), habits, rng, 0.5)
    if habits.erased:
        left, top = rng.uniform([150, 60], [380, 180])
        stroke(ink, np.array([[left, top], [left + 40, top + 12]]), habits, rng, 0.15)
    return cv2.GaussianBlur(ink, (0, 0), 0.8)


def strokes(mark: Any, habits: Habits, hand: Writing, rng: Any) -> list[Any]:
    """The paths of a mark in mm, as a hand draws them."""
    if isinstance(mark, LineMark):
        return [wobbled((mark.x1, mark.y1), (mark.x2, mark.y2), habits, rng)]
    if isinstance(mark, Polyline):
        ends = [*mark.points, mark.points[0]] if mark.closed else list(mark.points)
        return [wobbled(a, b, habits, rng) for a, b in pairwise(ends)]
    if isinstance(mark, Arc):
        turns = np.radians(np.linspace(mark.start, mark.end, 24))
        return [np.stack([mark.cx + mark.r * np.cos(turns), mark.cy - mark.r * np.sin(turns)], 1)]
    if isinstance(mark, CircleMark):
        turns = np.linspace(0, 2 * np.pi, 20)
        return [np.stack([mark.cx + mark.r * np.cos(turns), mark.cy + mark.r * np.sin(turns)], 1)]
    if isinstance(mark, Text):
        return written(mark, hand, rng)
    return []


def wobbled(start: Any, end: Any, habits: Habits, rng: Any) -> Any:
    """A line that is not quite straight."""
    start, end = np.array(start), np.array(end)
    long = float(np.hypot(*(end - start)))
    count = max(2, int(long / 2))
    along = np.linspace(0, 1, count)
    aside = np.zeros(count)
    for wave in range(1, 4):
        aside += rng.normal() * np.sin(np.pi * wave * along) / wave
    normal = np.array([-(end - start)[1], (end - start)[0]]) / max(long, 1e-9)
    offset = aside * habits.wobble / 1.2
    return start + along[:, None] * (end - start) + offset[:, None] * normal


def stroke(ink: Any, path: Any, habits: Habits, rng: Any, share: float = 1.0) -> None:
    """Put a path on the paper, its grey varying along it."""
    grey = habits.grey * share * float(rng.uniform(0.8, 1.15))
    width = max(1, round(habits.width * DENSITY * float(rng.uniform(0.8, 1.25))))
    low = np.floor(path.min(0) * DENSITY).astype(int) - 2 * width
    high = np.ceil(path.max(0) * DENSITY).astype(int) + 2 * width
    low = np.maximum(low, 0)
    high = np.minimum(high, [ink.shape[1] - 1, ink.shape[0] - 1])
    if (high - low < 2).any():
        return
    layer = np.zeros((high[1] - low[1], high[0] - low[0]), np.uint8)
    points = np.round((path * DENSITY - low - 0.5) * 2**SHIFT).astype(np.int32)
    for i, (a, b) in enumerate(pairwise(points)):
        tone = int(np.clip(255 * grey * (1 + 0.25 * np.sin(i * 0.7 + path[0, 0])), 0, 255))
        cv2.line(layer, a.tolist(), b.tolist(), tone, width, cv2.LINE_AA, SHIFT)
    part = ink[low[1] : high[1], low[0] : high[0]]
    np.maximum(part, layer.astype(np.float32) / 255, out=part)
