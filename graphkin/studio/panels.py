"""The drawings of the studio: the mechanism and its plans, each by itself and cut to its content.

They are the fields of the sheets, with the same marks; only the words and tables around them belong
to the page.

The numbers next to the drawings: readings, flat crossings, and the verdict.
"""

from __future__ import annotations

from cmath import isnan
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from html import escape
from itertools import chain
from math import ceil, degrees, floor
from pathlib import Path
from tempfile import TemporaryDirectory
from threading import Lock
from typing import Any, TypeVar

import tomlkit
from msgspec import Struct, field
from msgspec.structs import replace

from graphkin.classroom.lab.fair_ranges import FairRanges, fair_ranges
from graphkin.classroom.lab.lab_model import Lab, exact_text
from graphkin.classroom.lab.lab_trial import (
    LabTrial,
    broken_table,
    fault_words,
    scale_table,
    some,
    spread_table,
    spreads_of,
    tried,
)
from graphkin.classroom.lab.new_lab import (
    APART,
    FormulaFaults,
    Mending,
    ProposedRanges,
    formula_faults,
    proposed_ranges,
)
from graphkin.classroom.lab.read_lab import LAB, SCENE, read_lab
from graphkin.classroom.variants.assign import Assigned
from graphkin.construction.core.crossings import Crossing
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.layout import Layout, lay_out, spans
from graphkin.construction.core.program import Part, Program
from graphkin.construction.core.quantities import CENTRES, Whose, motion_value, names_asked
from graphkin.construction.core.solution import Solution, Verdict
from graphkin.construction.result_tables import NUMBERS, result_tables, unread
from graphkin.documents.centre_tables import breadth_of, place_of, with_blocks
from graphkin.documents.detail import insets, with_detail
from graphkin.documents.relations import of_travel
from graphkin.documents.sentences import crossings_on
from graphkin.documents.sheet import apart, left_board, right_board
from graphkin.drawing.field import ABOVE, MARGIN, XY, Field, Rect
from graphkin.drawing.labels import GAP, FieldContent, Label
from graphkin.drawing.marks import LineMark, Mark, Text, reach, style_class
from graphkin.drawing.placement import Spot
from graphkin.drawing.richtext import extent
from graphkin.drawing.scale import Extent, Scales
from graphkin.drawing.style import in_variables
from graphkin.drawing.symbol_markup import symbol
from graphkin.mechanism import Mechanism
from graphkin.numbers.plane import Ratio
from graphkin.scene.link_points import lettered, point_of
from graphkin.scene.model import Scene
from graphkin.studio.mends import Edit, units
from graphkin.text import Words
from graphkin.text.errors import GraphkinError, PageError, Problem
from graphkin.text.tables import NOISE, CellTable, Row
from graphkin.writers.svg import element, rules
from graphkin.writers.templates import from_template, marked_up, tables_html

Key = tuple[str, str, int | None, int]
"""Class, name and step of a label, and its number among labels that share them."""
LETTERS = "label"
"""The class of the text of a label."""


class LabelPlace(Struct, frozen=True):
    """The place of a label: its offset from the middle of its object (mm), height, and leader."""

    x: float
    y: float
    height: float
    led: bool


class FollowLabels(Struct, frozen=True):
    """The places of all labels of a field; labels that were left out have none."""

    of: Mapping[Key, LabelPlace] = field(default_factory=dict)
    without: frozenset[Key] = frozenset()


def seats_of(labels: Sequence[Label], marks: Sequence[Mark]) -> FollowLabels:
    """The places of a board's labels among its finished marks."""
    texts = [mark for mark in marks if isinstance(mark, Text) and style_class(mark) == LETTERS]
    placed = dict(zip(keys((t.cls, t.name, t.step) for t in texts), texts, strict=True))
    leaders = {m.name for m in marks if isinstance(m, LineMark) and style_class(m) == "leader"}
    found: dict[Key, LabelPlace] = {}
    for key, label in keyed(labels):
        text = placed.get(key)
        if text is not None:
            x, y = middle_of(label)
            width, top, bottom = extent(text.markup, text.height)
            right, down = text.x + text.left() + width / 2 - x, text.y + (top + bottom) / 2 - y
            found[key] = LabelPlace(right, down, text.height, text.name in leaders)
    return FollowLabels(found, frozenset(key for key, _ in keyed(labels) if key not in found))


def riding(board: FieldContent, seats: FollowLabels) -> list[Mark]:
    """The marks of a board, each label at the stored offset from its object."""
    marks = [*board.marks, *board.footed(board.notes)]
    for key, label in keyed(board.labels):
        if key not in seats.without:
            marks += seated(label, seats.of.get(key), board.rect)
    return marks


def seated(label: Label, seat: LabelPlace | None, rect: Rect) -> Iterable[Mark]:
    """One label at its stored place, or next to its object without one."""
    x, y = middle_of(label)
    if seat is None:
        side = label.away or (0.7, -0.7)
        width, height = label.size()
        right = side[0] * (GAP + width / 2 + label.radius)
        down = side[1] * (GAP + height / 2 + label.radius)
        seat = LabelPlace(right, down, label.height, led=False)
    if seat.height != label.height:
        label = replace(label, height=seat.height)
    width, height = label.size()
    at = (
        held(x + seat.x, rect[0] + width / 2, rect[2] - width / 2),
        held(y + seat.y, rect[1] + height / 2, rect[3] - height / 2),
    )
    spot = Spot(*at, None, True)
    if seat.led:
        spot = Spot(*at, label.side(spot, x, y), True)
    return replace(label, led=False).marks(spot)


def held(value: float, low: float, high: float) -> float:
    """A value within bounds."""
    return max(low, min(value, high))


def middle_of(label: Label) -> XY:
    """The point that a label names, or the middle of its segment."""
    first, second = label.subject
    if isinstance(first, tuple) and isinstance(second, tuple):
        return (first[0] + second[0]) / 2, (first[1] + second[1]) / 2
    assert isinstance(first, float) and isinstance(second, float)
    return first, second


def keyed(labels: Sequence[Label]) -> Iterator[tuple[Key, Label]]:
    """Each label with its key."""
    named = ((f"{LETTERS} {label.cls}".strip(), label.name, label.step) for label in labels)
    return zip(keys(named), labels, strict=True)


def keys(named: Iterable[tuple[str, str, int | None]]) -> Iterator[Key]:
    """Class, name and step, with a number that separates equal ones."""
    seen: Counter[tuple[str, str, int | None]] = Counter()
    for each in named:
        yield (*each, seen[each])
        seen[each] += 1


# --- the drawings of the studio -------------------------------------------------------------------


MECHANISM = "mechanism"
AROUND = 3.0
"""Room around the marks of a drawing, in mm."""
PLAN = 0.25
"""Margin of a plan's frame at each side while values move, in parts of its size.

Near a dead point the plan would otherwise shrink to a dot.
"""
GRID = 5.0
"""Grid in mm for the edges of a drawing, so that the edges hardly move while values move."""


class StaleError(Exception):
    """A newer request has arrived, and the drawing in progress is no longer wanted."""


class AtRest(Struct, frozen=True):
    """The scale factors and fields of a text's drawings at their last free layout."""

    text: str
    scales: Scales
    layouts: Mapping[str, Layout]


class Memory(Struct):
    """The state kept between answers: scales and fields, places of labels, edges.

    ``frames`` are the edges of the drawings at rest, ``edges`` those of the moving drawings.
    ``program`` is the construction of a text, which holds for all values of its parameters.
    """

    at_rest: AtRest | None = None
    seats: dict[tuple[str, str], FollowLabels] = field(default_factory=dict)
    frames: dict[tuple[str, str], Rect] = field(default_factory=dict)
    edges: dict[tuple[str, str], Rect] = field(default_factory=dict)
    program: tuple[str, Program] | None = None

    def mechanism(self, scene: Scene, text: str) -> Mechanism:
        """The mechanism of a text, whose construction is written once.

        Raises StructureError where the values of its parameters do not allow its assembly.
        """
        found, key = Mechanism(scene), f"{scene.base}\n{text}"
        if self.program and self.program[0] == key and found.groups:
            found.__dict__["program"] = self.program[1]
        else:
            self.program = key, found.program
        return found

    def held(self, text: str) -> Scales | None:
        """The scale factors that are kept while values of a text move; None without any."""
        return self.at_rest.scales if self.at_rest and self.at_rest.text == text else None

    def layouts(self, drawings: Sequence[Drawing], text: str, *, quick: bool) -> dict[str, Layout]:
        """The layout of each drawing: while values move as it was at rest, otherwise new.

        Raises PageError where the drawings are too large for their fields.
        """
        if quick and self.held(text) and self.at_rest:
            return {d.kind: moved(d, self.at_rest.layouts[d.kind]) for d in drawings}
        found = {drawing.kind: lay_out(drawing) for drawing in drawings}
        self.at_rest = AtRest(text, drawings[0].scales, found)
        return found


class Panel(Struct, frozen=True):
    """One drawing: its name, its caption as HTML, and its picture."""

    name: str
    caption: str
    svg: str
    marks: tuple[Mark, ...]


def moved(drawing: Drawing, layout: Layout) -> Layout:
    """The layout of a drawing with moved values, with scale and origin of its fields kept."""
    metres = drawing.scales.metres(drawing.kind)
    fields = replace(
        layout,
        mechanism=widened(layout.mechanism, drawing.mechanism_extent(), 1.0),
        plan=widened(layout.plan, drawing.plan_extent(), metres),
    )
    return replace(fields, spans=spans(drawing, fields))


def widened(field: Field, extent: Extent, metres: float) -> Field:
    """A field enlarged to hold a drawing, with unchanged places of points."""
    low, high = complex(extent.left, extent.bottom), complex(extent.right, extent.top)
    (left, bottom), (right, top) = field(low / metres), field(high / metres)
    drawn = left - MARGIN, top - ABOVE, right + MARGIN, bottom + ABOVE
    return replace(field, rect=around(field.rect, drawn))


def around(one: Rect, other: Rect) -> Rect:
    """The rectangle around two rectangles."""
    left, top = (min(pair) for pair in zip(one[:2], other[:2], strict=True))
    right, bottom = (max(pair) for pair in zip(one[2:], other[2:], strict=True))
    return left, top, right, bottom


def panels(
    drawings: Sequence[Drawing], text: str, shown: str, memory: Memory, *, quick: bool
) -> Iterator[tuple[Panel, Sequence[Problem]]]:
    """The mechanism with the construction of one plan, then the plans, with problems of fit.

    ``shown`` is the kind of plan whose construction is shown on the mechanism. ``quick``, while
    values of the scene's text move, keeps scales and fields, and lets labels keep their offsets.
    """
    on_mechanism = next((d for d in drawings if d.kind == shown), drawings[0])
    places = memory.layouts(drawings, text, quick=quick)
    for name, drawing in ((MECHANISM, on_mechanism), *((d.kind, d) for d in drawings)):
        own = (name, drawing.kind)
        board = board_of(name, drawing, places[drawing.kind])
        said, board.marks = apart(board.marks)
        labels, marks = list(board.labels), None
        problems: tuple[Problem, ...] = ()
        try:
            marks = None if quick else finished(name, drawing, places[drawing.kind], board)
        except PageError as error:
            problems = error.problems
            board.labels = labels
        if marks is not None:
            memory.seats[own] = seats_of(labels, marks)
        else:
            marks = riding(board, memory.seats.get(own, FollowLabels()))
        if quick and own in memory.frames:
            most = outside(memory.frames[own], 1.0 if name == MECHANISM else PLAN)
            memory.edges[own] = grown(memory.edges[own], edges_of(marks), most)
        else:
            memory.frames[own] = memory.edges[own] = edges_of(marks)
        svg = picture(name, marks, memory.edges[own], drawing)
        yield Panel(name, marked_up(said), svg, tuple(marks)), problems


def board_of(name: str, drawing: Drawing, layout: Layout) -> FieldContent:
    """The field of the mechanism or of the plan, with labels not yet placed."""
    draw = left_board if name == MECHANISM else right_board
    return draw(drawing, layout, "key")


def finished(name: str, drawing: Drawing, layout: Layout, board: FieldContent) -> list[Mark]:
    """The marks of a field with every label at a free place. Raises PageError where one has none.

    Centres far off the mechanism get insets.
    """
    marks = with_detail(board)
    return [*marks, *insets(drawing, layout.mechanism, marks)] if name == MECHANISM else marks


def grown(before: Rect, needed: Rect, most: Rect) -> Rect:
    """Edges that hold the current and the earlier drawing, within the widest edges allowed."""
    left, top, right, bottom = around(before, needed)
    return max(left, most[0]), max(top, most[1]), min(right, most[2]), min(bottom, most[3])


def outside(frame: Rect, part: float) -> Rect:
    """A frame extended at every side by a part of its size."""
    across, up = part * (frame[2] - frame[0]), part * (frame[3] - frame[1])
    return frame[0] - across, frame[1] - up, frame[2] + across, frame[3] + up


def edges_of(marks: Iterable[Mark]) -> Rect:
    """The box around some marks with a little room, on a grid."""
    boxes = [reach(mark) for mark in marks]
    sides = [min(box[i] for box in boxes) - AROUND for i in (0, 1)]
    sides += [max(box[i] for box in boxes) + AROUND for i in (2, 3)]
    left, top = (GRID * floor(side / GRID) for side in sides[:2])
    right, bottom = (GRID * ceil(side / GRID) for side in sides[2:])
    return left, top, right, bottom


def picture(name: str, marks: Iterable[Mark], edges: Rect, drawing: Drawing) -> str:
    """A drawing as SVG, named by its caption on the page."""
    left, top, right, bottom = edges
    view = f"{left:g} {top:g} {right - left:g} {bottom - top:g}"
    language = escape(drawing.words.language)
    head = f'<svg viewBox="{view}" role="img" aria-labelledby="caption-{name}" lang="{language}">'
    return "".join((head, *map(element, marks), "</svg>"))


def style(found: Iterable[Panel]) -> str:
    """The style rules for the marks of some drawings, in the colours of the page."""
    marks = (mark for panel in found for mark in panel.marks)
    return in_variables("\n".join(rules(marks, "colour")))


FLATTEST = 6
"""Number of crossings shown."""
FLAT, SLANTED = 15.0, 30.0
"""Angles in degrees below which a crossing is unfairly flat, and below which it is poor."""
WHERE = {
    Part.POSITION: "studio.in_mechanism",
    Part.VELOCITY: "sheet.velocity",
    Part.NORMAL: "studio.in_triangle",
    Part.ACCELERATION: "sheet.acceleration",
    Part.CENTRE: "studio.in_centre",
    Part.POLE: "studio.in_pole",
}
"""The words for the place of a crossing."""


def results(drawings: Sequence[Drawing], solution: Solution) -> str:
    """The results as HTML: notes, then vectors, angular and sliding values, centres and travels.

    The notes say what is asked for but cannot be read off.
    """
    notes = [note for drawing in drawings for note in unread(drawing, drawing.symbol)]
    said = from_template("studio/web/notes.html", notes=notes)
    found = [table for drawing in drawings for table in read_off(drawing, solution)]
    found += places(drawings[0].scene, solution, drawings[0].words)
    found += asked_travels(drawings[0])
    return f"{said}{tables_html(found)}"


def read_off(drawing: Drawing, solution: Solution) -> Iterator[CellTable]:
    """The tables of one sheet, with a dash for each value without a reliable digit."""
    words, lost = drawing.words, losses(drawing, solution)
    plan = words(f"sheet.{drawing.kind}")
    captions = {"vectors": plan, "turns": words("studio.turning_of", plan=plan)}
    captions["slides"] = words("studio.sliding_of", plan=plan)
    for table in result_tables(drawing, empty=False):
        heads = NUMBERS[table.kind][0]
        dashes = ("–",) * (len(table.heads) - heads)
        rows = [
            replace(row, cells=(*row.cells[:heads], *dashes)) if lost(row.name) else row
            for row in table.rows
        ]
        yield replace(table, rows=rows, caption=captions[table.kind], kind="")


def losses(drawing: Drawing, solution: Solution) -> Callable[[str], bool]:
    """A test for rows of a sheet's tables without a reliable digit, that is NaN in the solution.

    Vectors that the solution does not hold, such as relative vectors, are reliable if everything in
    the solution is.
    """
    parts = (
        (f"{drawing.vector.letter}_", drawing.vector, solution.points),
        (drawing.rate.letter, drawing.rate, solution.links),
        ("slide ", drawing.sliding, solution.slides),
    )
    known = {
        f"{start}{name}": motion_value(motion, quantity)
        for start, quantity, motions in parts
        for name, motion in motions.items()
    }
    sure = {name: not isnan(value) for name, value in known.items() if value is not None}
    return lambda name: not sure.get(name, all(sure.values()))


def places(scene: Scene, solution: Solution, words: Words) -> Iterator[CellTable]:
    """The places of the centres and poles that are asked for, in the unit of the scene."""
    full, breadth, unit = with_blocks(scene, solution), breadth_of(solution), scene.units["length"]
    asked: list[tuple[str, Ratio | None, Whose]] = []
    for quantity in CENTRES:
        motions: Mapping[str, Any] = getattr(full, quantity.whose)
        for name in names_asked(scene.ask, quantity):
            own = point_of(scene, name) if quantity.whose == "points" else name
            found = motion_value(motions[own], quantity) if own in motions else None
            ratio = solution.centres.get(own, found)
            asked.append((f"{quantity.letter}_{lettered(own)}", ratio, quantity.whose))
    rows = []
    for name, ratio, whose in asked:
        at = place_of(ratio, breadth)
        cells: tuple[str, str] = (words("calculation.at_infinity"), "")
        if at is not None and isnan(at):
            cells = ("–", "–")
        elif at is not None:
            metre, least = scene.unit_length, NOISE * breadth
            x, y = (0.0 if abs(part) < least else part / metre for part in (at.real, at.imag))
            cells = (words.significant(x, 5), words.significant(y, 5))
        elif whose == "points":
            cells = (words("calculation.no_curvature"), "")
        elif ratio is None or ratio.shift == 0:
            cells = (words("calculation.everywhere"), "")
        rows.append(Row((symbol(name), *cells)))
    head = (words("table.symbol"), f"*x*, {unit}", f"*y*, {unit}")
    yield CellTable(head, rows, words("studio.places"))


def asked_travels(drawing: Drawing) -> Iterator[CellTable]:
    """The strokes, swings and time ratios that are asked for."""
    words = drawing.words
    found = of_travel(drawing)
    spaces = {"°": ""}
    rows = [Row((e.left, f"{e.result}{spaces.get(e.unit, ' ')}{e.unit}".rstrip())) for e in found]
    if rows:
        head = (words("table.symbol"), words("calculation.answers"))
        yield CellTable(head, rows, words("calculation.travel"))


def margins(drawings: Sequence[Drawing]) -> str:
    """The flattest crossings, with the effect of one millimetre of pencil error."""
    words = drawings[0].words
    found = chain.from_iterable(crossings_on(drawing) for drawing in drawings)
    worst = sorted(found, key=lambda crossing: crossing.angle)[:FLATTEST]
    keys = ("studio.crossing", "studio.drawn_in", "studio.angle", "studio.pencil")
    head = tuple(map(words, keys))
    rows = [margin_row(crossing, words) for crossing in worst]
    looks = [{"class": look} if (look := look_of(crossing)) else {} for crossing in worst]
    return str(tables_html([CellTable(head, rows, words("studio.margins"), marks=looks)]))


def margin_row(crossing: Crossing, words: Words) -> Row:
    """One crossing: its letter, its place, its angle, and the effect of a millimetre."""
    angle = words.fixed(degrees(crossing.angle), 1)
    factor = words.significant(crossing.factor, 2)
    flat = f" ({words('studio.flat')})" if look_of(crossing) == "flat" else ""
    where = words(WHERE.get(crossing.part, "studio.in_mechanism"))
    return Row((symbol(crossing.name, signs=words.signs), where, f"{angle}°{flat}", f"{factor} mm"))


def look_of(crossing: Crossing) -> str:
    """The class of a crossing: flat, slanted, or empty."""
    angle = degrees(crossing.angle)
    return "flat" if angle < FLAT else "slanted" if angle < SLANTED else ""


def verdict_words(verdict: Verdict, scene: Scene, words: Words) -> str:
    """The verdict of the independent route, and the largest difference allowed."""
    difference = words.significant(verdict.largest_difference, 2)
    limit = words.significant(verdict.limit, 2)
    if verdict.agrees:
        said = words("page.verified", difference=difference)
        return f"{said} ({words('studio.limit', limit=limit)})"
    found = {"difference": difference, "limit": limit, "where": verdict.quantity}
    says = [words("studio.disagrees", **found)] if verdict.differs else []
    if verdict.branches:
        stated = verdict.not_as_stated(scene.branches)
        says.append(words("studio.not_as_stated", branches=stated))
    return " ".join(says)


POLL = 0.05
"""Seconds between two checks whether a result is still wanted."""
ONE_AT_A_TIME = Lock()
Found = TypeVar("Found")


class LabTexts(Struct, frozen=True):
    """The texts of a scene and of its lab.toml, and the name of the lab."""

    scene: str
    rules: str
    name: str

    @contextmanager
    def lab(self) -> Iterator[Lab]:
        """The lab that the texts state. Raises SceneError for mistakes in them."""
        with TemporaryDirectory() as folder:
            for name, text in ((SCENE, self.scene), (LAB, self.rules)):
                (Path(folder) / name).write_text(text, encoding="utf-8")
            yield read_lab(folder, self.name)


class LabProblems(Struct, frozen=True):
    """Why a lab cannot be tried: problems of its rules, or of its scene."""

    rules: tuple[Problem, ...]
    scene: tuple[Problem, ...]


class LabProposal(Struct, frozen=True):
    """The fair ranges of a lab, the proposed ranges, and the faults of a formula."""

    found: FairRanges
    proposed: ProposedRanges | None
    formula: FormulaFaults | None


def trial_of(texts: LabTexts) -> LabTrial | LabProblems:
    """A lab tried on a thousand variants and a class."""
    return answered(texts, tried)


def proposal_of(texts: LabTexts) -> LabProposal | LabProblems:
    """The ranges in which a lab is fair."""
    return answered(texts, searched)


def searched(lab: Lab) -> LabProposal:
    """The search of a lab's whole space, and of a formula's faults."""
    found = fair_ranges(lab)
    formula = None if lab.rule.is_drawn else formula_faults(lab)
    return LabProposal(found, proposed_ranges(lab, found), formula)


def answered(texts: LabTexts, work: Callable[[Lab], Found]) -> Found | LabProblems:
    """The result of work on a lab, or the problems that prevent it."""
    try:
        with texts.lab() as lab:
            return work(lab)
    except GraphkinError as error:
        own = tuple(each for each in error.problems if each.file == LAB)
        return LabProblems(own, tuple(each for each in error.problems if each.file != LAB))


def beside(work: Callable[[LabTexts], Any], texts: LabTexts, go_on: Callable[[], None]) -> Any:
    """The result of a piece of work in a separate process; such processes run one after another.

    ``go_on`` is called while waiting and may raise, which ends the process.
    """
    from graphkin.classroom.printing.workers import fresh_processes

    while not ONE_AT_A_TIME.acquire(timeout=POLL):
        go_on()
    try:
        context = fresh_processes()
        receiving, sending = context.Pipe(duplex=False)
        process = context.Process(target=send_result, args=(work, texts, sending), daemon=True)
        process.start()
        sending.close()
        try:
            while not receiving.poll(POLL):
                go_on()
            return receiving.recv()
        finally:
            process.kill()
            process.join()
            receiving.close()
    finally:
        ONE_AT_A_TIME.release()


def send_result(work: Callable[[LabTexts], Any], texts: LabTexts, sending: Any) -> None:
    """Run a piece of work and send its result to the studio."""
    from graphkin.classroom.printing.workers import begin

    begin()
    sending.send(work(texts))


# --- the page's view of a lab that was tried ------------------------------------------------------


class StudentRow(Struct, frozen=True):
    """A student of the class: name, data, faults, and what makes the sheet hard.

    ``earns`` is the largest share, in percent, that another student's right values earn on this
    sheet; ``whose`` is that student. ``settings`` draw the sheet.
    """

    name: str
    data: str
    settings: Mapping[str, str]
    faults: str
    flattest: str
    shortest: str
    earns: str
    whose: str


class LabReport(Struct, frozen=True):
    """A lab that was tried: the number of fair variants, tables as HTML, and the students.

    ``shares`` has a row for each sheet: the percent that each student's right values earn on it (-1
    for the student's own). More than ``apart`` is too much. ``exact`` says how many of the fair
    variants a pencil draws with sufficient accuracy.
    """

    fair: int = 0
    count: int = 0
    tables: str = ""
    students: list[StudentRow] = field(default_factory=list)
    shares: list[list[int]] = field(default_factory=list)
    apart: int = 0
    closest: str = ""
    exact: str = ""


def lab_report(outcome: LabTrial, words: Words) -> LabReport:
    """The report on a lab that was tried, in the language of the page."""
    count, near = len(outcome.many), outcome.neighbours
    shares = [] if near is None else [[percent(share) for share in row] for row in near.exact]
    names = [each.student.id for each in outcome.compared]
    closest = ""
    if near is not None:
        own, other = near.closest()[0]
        gaps = {"own": names[own], "other": names[other], "share": str(shares[own][other])}
        closest = words("studio.closest", **gaps)
    rows = [student_row(i, each, shares, names, words) for i, each in enumerate(outcome.compared)]
    broken = broken_table(outcome, words, lambda at: outcome.symbols.get(at) or symbol(at))
    found = [broken, spread_table(spreads_of(outcome), words)]
    tables = str(tables_html([*found, scale_table(outcome, words)]))
    limit = outcome.lab.fair.apart
    apart = percent(APART if limit is None else limit)
    exact = ""
    if outcome.pencilled:
        drawn = outcome.pencilled - len(outcome.coarse)
        exact = words("studio.exact_of", count=drawn, of=outcome.pencilled)
    return LabReport(count - outcome.unfair, count, tables, rows, shares, apart, closest, exact)


def percent(share: float) -> int:
    """A share in percent; -1 for a student's own sheet."""
    return -1 if isnan(share) else round(100 * share)


def student_row(
    index: int, each: Assigned, shares: Sequence[Sequence[int]], names: Sequence[str], words: Words
) -> StudentRow:
    """A student of the class that was tried."""
    most = max(range(len(names)), key=lambda other: shares[index][other]) if shares else None
    settings = {name: exact_text(value) for name, value in each.settings.items()}
    return StudentRow(
        each.student.id,
        ", ".join(f"{name} = {value}" for name, value in settings.items()),
        settings,
        "; ".join(fault_words(fault, words) for fault in each.faults),
        "" if each.flattest is None else f"{words.fixed(each.flattest, 1)}°",
        "" if each.shortest is None else f"{words.fixed(each.shortest, 1)} mm",
        "" if most is None else f"{shares[index][most]} %",
        "" if most is None else names[most],
    )


class ParameterShares(Struct, frozen=True):
    """The fair share, in percent, by the values of a parameter, and the parameter's weight."""

    name: str
    decides: int
    parts: list[tuple[str, int]]


class LabAdvice(Struct, frozen=True):
    """Advice for a lab: its fair share by parameters, new ranges, and a corrected formula.

    ``shares`` has for each parameter the part of fairness that it decides and the fair share by its
    values. ``ranges`` is the text of the proposal and ``rules`` the whole lab.toml with it;
    ``mending`` is an edit of the scene.
    """

    fair: str
    shares: list[ParameterShares]
    ranges: str = ""
    rules: str = ""
    kept: str = ""
    formula: str = ""
    mending: Edit | None = None


def lab_advice(proposal: LabProposal, texts: LabTexts, words: Words) -> LabAdvice:
    """The report on a search for fair ranges, in the language of the page."""
    tried, new = proposal.found.tried, proposal.proposed
    guilt = sorted(((tried.guilt(name), name) for name in tried.space), reverse=True)
    shares = [
        ParameterShares(name, percent(decides), list(value_shares(proposal, name)))
        for decides, name in guilt
    ]
    fair = words("studio.fair_share", share=percent(tried.share), count=len(tried.places))
    formula, mending = formula_words(proposal, texts.scene, words)
    if new is None:
        return LabAdvice(
            fair, shares, kept=words("studio.no_ranges"), formula=formula, mending=mending
        )
    lines = new.lines
    gaps = {"count": new.count, "apart": f"{100 * new.apart:g}", "kept": new.kept, "of": new.of}
    rules = with_variants(texts.rules, lines)
    kept = words("studio.kept_apart", **gaps)
    if new.exact < 1:
        kept += f" {words('studio.exact_share', share=percent(new.exact))}"
    return LabAdvice(fair, shares, "\n".join(lines), rules, kept, formula, mending)


def value_shares(proposal: LabProposal, name: str) -> Iterator[tuple[str, int]]:
    """The fair share by the values of a parameter."""
    for first, last, share, _ in proposal.found.tried.by_value(name):
        ends = exact_text(first) if last == first else f"{exact_text(first)} … {exact_text(last)}"
        yield ends, percent(share)


def with_variants(rules: str, lines: Sequence[str]) -> str:
    """The text of a lab.toml with new [variants]; everything else stays as written."""
    document = tomlkit.parse(rules)
    document["variants"] = tomlkit.parse("\n".join([*lines, "", ""]))["variants"]
    return tomlkit.dumps(document)


def formula_words(proposal: LabProposal, scene: str, words: Words) -> tuple[str, Edit | None]:
    """The numbers for which a formula is unfair and the correction, in words and as an edit."""
    found = proposal.formula
    if found is None:
        return "", None
    if not found.unfair:
        return words("studio.formula_fair"), None
    unfair = words("studio.formula_unfair", names=some([*found.unfair]))
    mending = found.mending
    if mending is None:
        return f"{unfair} {words('studio.no_mending')}", None
    gaps = {"line": mending.line, "text": mending.text, "old": mending.old, "new": mending.new}
    change = edit_of(mending, scene)
    return f"{unfair} {words('studio.mending', **gaps)}", change


def edit_of(mending: Mending, scene: str) -> Edit:
    """The change of a scene's line as an edit of its text."""
    lines = scene.split("\n")
    start = sum(len(line) + 1 for line in lines[: mending.line - 1]) + mending.column
    end = start + len(mending.old)
    return Edit(units(scene[:start]), units(scene[:end]), mending.new, before=mending.old)
