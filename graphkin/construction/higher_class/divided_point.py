"""Points of the right plan: each divides the line through its two trials in the same ratio.

Where a line through a point's image is known, the point is where that line crosses the line of its
trials.

The misclosure of a trial plan at the last link or driver, and how it is measured.

The gap is measured across the line on which the plan's point should lie: perpendicular to the bar
that closes the group, or parallel to its guide. For a driver, the misclosure is the value in the
plan less the given value.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Container, Mapping
from typing import Any, ClassVar

from graphkin.construction.core.component import component_ending_at, component_of, index_before
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Canvas, Construction, FindsImage, GivesRate, JoinsPoints
from graphkin.construction.core.layout import BEYOND
from graphkin.construction.core.naming import scale_of, way_of
from graphkin.construction.core.palette import DIVIDE, JOIN, Move, two
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import OwnStep, Target
from graphkin.construction.core.relation import FINE, Relation, answer, figure, within
from graphkin.construction.core.vocabulary import action, meet
from graphkin.construction.group_images import GroupImages
from graphkin.construction.guides.guides import known_guide
from graphkin.construction.velocity.relative_motion import parallel_through
from graphkin.drawing.style import CHAIN_LINES, OWN_LINES
from graphkin.drawing.symbol_markup import TAGS, bar, symbol
from graphkin.numbers.arithmetic import Point, Real, larger, smaller
from graphkin.numbers.plane import Line, cross, dot
from graphkin.scene.link_points import is_under
from graphkin.scene.model import Driver
from graphkin.structure.groups import CoupledTrain, Higher, Tie
from graphkin.structure.pairs import Pin, Sliding, partner
from graphkin.text import MINUS

SHARE = "*λ*"
"""Symbol of the fraction of the way between two trials at which the misclosure is zero."""
ROUNDING = 1e-12
"""Fractions of the way between two trials up to this size are rounding, and count as zero."""


@action("between", move=Move(DIVIDE, two))
def between(first: Point, second: Point, part: Real) -> Point:
    """The point at the fraction ``part`` of the way from a point's first trial to its second."""
    return first + (second - first) * part


@action("line-through", move=Move(JOIN, two))
def line_through(first: Point, second: Point) -> Line:
    return Line(first, second - first)


class Divided(Construction, frozen=True, kw_only=True):
    """A value of the right plan between the values of two trials, ``first`` and ``second``."""

    first: int
    second: int
    share: int
    value: OwnStep


class DividedRate(Divided, GivesRate, frozen=True, kw_only=True):
    """The rate of the tried link itself."""

    def rate_reason(self, drawing: Drawing) -> str:
        """The reason: the rate is divided as every line of the two trials is."""
        return "why.trials"

    def rate_relation(self, drawing: Drawing, link: str, tail: tuple[str, str, str]) -> Relation:
        """The relation that divides the rate as every line of the two trials is divided."""
        numbers = (self.first, self.second, self.share)
        first, second, share = (float(drawing.trace.values[number]) for number in numbers)
        share = share if abs(share) > ROUNDING else 0.0
        figures = f"{figure(drawing, first)} + {figure(drawing, share, FINE)}·"
        figures += f"({figure(drawing, second, FINE)} − {within(drawing, first)})"
        letter = drawing.rate.letter
        one, two = (drawing.symbol(f"{letter}_{link}{tag}") for tag in TAGS)
        whole = f"{one} + {SHARE}·({two} − {one})"
        result, unit, turning = tail
        if first + share * (second - first) < 0:
            result = f"{MINUS}{result}"
        name = drawing.symbol(f"{letter}_{link}")
        return Relation(name, whole, figures, result, unit, turning, takes=SHARE)


class CrossedLine(JoinsPoints, frozen=True):
    """The line through two trials of a point, and its crossing with a line known before them."""

    lines: ClassVar[Mapping[str, str]] = {"line": "the line of the trials"}
    joins: ClassVar[frozenset[str]] = frozenset({"line"})
    reasons: ClassVar[Mapping[str, str]] = {"line": "why.trials"}

    first: int
    second: int
    locus: int
    line: OwnStep
    crossing: OwnStep

    def clause(self, drawing: Drawing, role: str) -> str:
        """The clause for the line, by the names of the trials."""
        if role != "line":
            return ""
        a, b = (drawing.lettered(number) for number in (self.first, self.second))
        return drawing.words("step.line-through", a=a, b=b)

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the line, a little beyond all three points."""
        if role == "line":
            canvas.line(CHAIN_LINES, "")

    def marks_aside(self, canvas: Canvas, role: str) -> None:
        """Draw the line in a trial plan."""
        self.marks(canvas, role)


class DividedPoint(Divided, FindsImage, frozen=True, kw_only=True):
    """The image of a ``point``: at the crossing on its line, or where it divides that line."""

    point: str
    crossed: CrossedLine | None = None

    def reason(self, drawing: Drawing, role: str) -> str:
        """The reason: a crossing of lines, or the same division as of every trial line."""
        return "why.meet" if self.is_crossed(drawing.trace.values) else "why.trials"

    def comes_along(self, role: str, found: Container[int]) -> bool:
        """Whether an arrow brings in the image: one at a crossing, or one under a sliding point.

        By the crossing, the lines of other points are divided. The components of the sliding point
        pass through the image under it.
        """
        return is_under(self.point) or self.is_crossed(found)

    def is_crossed(self, found: Container[int]) -> bool:
        """Whether a drawn crossing finds the image."""
        return self.crossed is not None and self.crossed.crossing in found

    @property
    def sought(self) -> str:
        return self.point

    def said_before(self, drawing: Drawing, role: str) -> tuple[int, ...]:
        """The two lines that cross."""
        if self.crossed is None or not self.is_crossed(drawing.trace.values):
            return ()
        return self.crossed.line, self.crossed.locus

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence for the crossing; empty for divided points, which share one sentence."""
        return self.crossing_words(drawing, "step.meet")

    def point_apart(self, drawing: Drawing, role: str) -> str:
        """The sentence for the crossing, on its own."""
        return self.crossing_words(drawing, "step.meet-apart")

    def crossing_words(self, drawing: Drawing, key: str) -> str:
        """The words of a key for the crossing; empty where the point divides its line."""
        crossed = self.is_crossed(drawing.trace.values)
        return drawing.words(key, name=drawing.lettered(self.value)) if crossed else ""

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the point, with the line of its trials where no other step draws that line."""
        self.draw_line(canvas)
        canvas.image()

    def marks_aside(self, canvas: Canvas, role: str) -> None:
        """Draw the point in a trial plan, where points are smaller."""
        self.draw_line(canvas)
        canvas.image_aside()

    def draw_line(self, canvas: Canvas) -> None:
        """Draw the line of its trials where no other step draws that line."""
        if not self.is_crossed(canvas.drawing.trace.values):
            canvas.through(*map(canvas.value, (self.first, self.second, self.value)))

    def ratio(self, drawing: Drawing, first: float, second: float) -> dict[str, str]:
        """The ratio in which the point divides the line of its trials, and the trial it is beyond.

        ``first`` and ``second`` are the gaps, or parts of the line. They have the same sign where
        the point is not between the trials.
        """
        numbers = (self.first, self.second, self.value)
        one, two, point = (drawing.lettered(number) for number in numbers)
        parts = f"{one}{point} : {point}{two}"
        sizes = " : ".join(drawing.words.fixed(abs(size), 2) for size in (first, second))
        beyond = ""
        if first * second > 0:
            end = two if abs(first) > abs(second) else one
            beyond = drawing.words("step.divided-beyond", end=end)
        return {"ratio": f"{parts} = {sizes}", "beyond": beyond}


# --- the crossing --------------------------------------------------------------------------------


def trials_of(layers: list[dict[Target, int]], quantity: str, point: str) -> tuple[int, int]:
    """The images of a point in both trial plans."""
    first, second = (layer[quantity, point] for layer in layers)
    return first, second


def crossings(
    pen: Pen, group: CoupledTrain | Higher, images: GroupImages, layers: list[dict[Target, int]]
) -> dict[str, CrossedLine]:
    """The crossing of the point whose line is known before the trials, by the point; else empty."""
    quantity = images.plan.quantity
    moved = [of for what, of in layers[0] if what == quantity]
    tried = {of for of in moved if len({*trials_of(layers, quantity, of)}) > 1}
    point = crossed_point(pen, group, quantity, tried)
    if point is None:
        return {}
    ends = trials_of(layers, quantity, point)
    return {point: crossing(pen, group, images, point, ends)}


def crossed_point(
    pen: Pen, group: CoupledTrain | Higher, quantity: str, tried: set[str]
) -> str | None:
    """The point whose right image lies on a line known before the trials; None if there is none.

    ``tried`` are the points that differ between the two trials.
    """
    match group.last:
        case Tie(_, Pin(point=p), Pin(point=q)):
            ends = [of for of, other in ((p, q), (q, p)) if pen.has(quantity, other)]
            return next((of for of in ends if of in tried), None)
        case Tie(link, Pin(point=p), Sliding() as pair) if p in tried:
            return None if partner(pair, link) in group.links else p
    return None


def crossing(
    pen: Pen, group: CoupledTrain | Higher, images: GroupImages, of: str, ends: tuple[int, int]
) -> CrossedLine:
    """Draw the crossing of the line through both trials of a point with the point's known line."""
    locus = locus_of(pen, group, images, of)
    with images.plan.drawn(pen), pen.hands_way():
        line = pen.draw(line_through, *ends)
        return pen.make(CrossedLine(*ends, locus, line, pen.draw(meet, line, locus)))


def locus_of(pen: Pen, group: CoupledTrain | Higher, images: GroupImages, of: str) -> int:
    """Draw the line in the plan on which a pin must lie.

    The line is perpendicular to the pin's bar, or parallel to its guide.
    """
    last, plan = group.last, images.plan
    assert isinstance(last, Tie)
    if isinstance(last.second, Sliding):
        with plan.drawn(pen):
            start = images.known_end(pen, last.second, last.link, of)
        guide = known_guide(pen, last.second)
        with plan.drawn(pen), pen.hands_way():
            return parallel_through(pen, start, guide, last.second.links[0])
    ends = last.first, last.second
    other = next(end.point for end in ends if isinstance(end, Pin) and end.point != of)
    bar = images.bar(other, of)
    vector = bar.component(pen)
    with plan.drawn(pen), pen.hands_way():
        return bar.line(pen, vector)[1]


@action("lacks")
def lacks(p: Point, q: Point, image_p: Point, image_q: Point, wanted: Point) -> Real:
    """The error of a bar's trial images, along the bar."""
    bar = q - p
    return dot(bar, image_q - image_p - wanted) / abs(bar)


@action("lacks")
def lacks_across(line: Line, start: Point, image: Point) -> Real:
    """The error of a sliding point's trial image, across its guide."""
    return cross(line.along, image - start) / abs(line.along)


class Misclosure(Construction, frozen=True, kw_only=True):
    """The gap of a trial plan: the step of its ``size``, positive to one side.

    The gap is drawn unless a crossing, at the step ``settled``, shows how the right plan divides.
    """

    size: OwnStep
    settled: int | None = None

    def amount(self, drawing: Drawing) -> float:
        """The size in the unit of the plan."""
        return float(drawing.settled(drawing.trace.values[self.size]))

    def point(self, drawing: Drawing) -> str:
        """Markup of the point, or the vector of the plan, at which the gap is measured."""
        raise NotImplementedError

    def fields(self, drawing: Drawing) -> tuple[str, Mapping[str, str]]:
        """The key of the words for the line from which the gap is measured, and their fields."""
        return "given", {}

    def line(self, drawing: Drawing) -> str:
        """The words for the line on which the plan's point should lie."""
        key, fields = self.fields(drawing)
        return drawing.words(f"step.gap-{key}", **fields)

    def relation(self, drawing: Drawing, name: str) -> Relation:
        """The relation for the gap as read from the plan."""
        scale = scale_of(drawing, drawing.plane) / 1000
        size, (key, fields) = self.amount(drawing), self.fields(drawing)
        figures = f"{figure(drawing, scale)}·{within(drawing, size / scale)}"
        remark = drawing.words(f"calculation.gap-{key}", one=self.point(drawing), **fields)
        unit = drawing.vector.caret_unit
        return Relation(name, "", figures, answer(drawing, size), unit, remark)

    def draw_gap(self, canvas: Canvas, foot: Any, start: Any, tip: Any, across: Any) -> None:
        """Draw the part laid off, the line from its end for the point, and the gap."""
        end, along = tip - across * canvas.value(self.size), 1j * across
        reach, beyond = dot(along, end - start), BEYOND / 2 / canvas.mm
        low, high = smaller(reach, 0.0) - beyond, larger(reach, 0.0) + beyond
        canvas.leg("laid off", OWN_LINES, foot, start)
        canvas.stretch("locus of a trial", OWN_LINES, start, along, low, high)
        canvas.leg("gap", CHAIN_LINES, tip, end)

    def is_measured(self, drawing: Drawing) -> bool:
        """Whether the gap is drawn, and measured on a sheet."""
        return self.settled not in drawing.trace.values

    def reason(self, drawing: Drawing, role: str) -> str:
        """The reason why the gap is measured."""
        return "why.gaps" if self.is_measured(drawing) else ""


class DrawnMisclosure(Misclosure, frozen=True, kw_only=True):
    """A gap in the plan, at the image ``tip`` of the point that is found last."""

    tip: int

    def point(self, drawing: Drawing) -> str:
        return drawing.lettered(self.tip)

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the gap, where no crossing replaces it."""
        if self.is_measured(canvas.drawing):
            self.draw(canvas)

    @abstractmethod
    def draw(self, canvas: Canvas) -> None:
        """Draw the gap."""


class LineMisclosure(DrawnMisclosure, frozen=True, kw_only=True):
    """The gap across the line ``along`` through the image ``start``, where the image belongs."""

    along: int
    start: int

    def draw(self, canvas: Canvas) -> None:
        """Draw the gap from the line to the point."""
        along, start, tip = map(canvas.value, (self.along, self.start, self.tip))
        self.draw_gap(canvas, start, start, tip, 1j * along.along / abs(along.along))


class BarMisclosure(DrawnMisclosure, frozen=True, kw_only=True):
    """The gap along a bar between the images of its ends; ``wanted`` is the known part along it."""

    p: int
    q: int
    foot: int
    wanted: int

    def fields(self, drawing: Drawing) -> tuple[str, Mapping[str, str]]:
        """The line perpendicular to the bar, from the end of the known component."""
        steps = drawing.trace.program.steps
        p, q = steps[self.p].name, steps[self.q].name
        fields = {"bar": bar(p, q), "s": drawing.lettered(self.foot), "p": symbol(p)}
        component = component_of(drawing.trace.program, self.wanted)
        if component is None:
            return "square", fields
        return "square-end", {**fields, "a": component.symbol(drawing)}

    def draw(self, canvas: Canvas) -> None:
        """Draw the gap from the end of the known component to the point."""
        ends = (self.p, self.q, self.foot, self.tip, self.wanted)
        p, q, foot, tip, wanted = map(canvas.value, ends)
        self.draw_gap(canvas, foot, foot + wanted, tip, (q - p) / abs(q - p))


class GuideMisclosure(LineMisclosure, frozen=True, kw_only=True):
    """The gap across the guide of a ``block``, from the known part to the image of its point."""

    block: str

    def fields(self, drawing: Drawing) -> tuple[str, Mapping[str, str]]:
        """The line parallel to the guide, from the end of the part laid off."""
        fields = {"guide": way_of(drawing, self.block)}
        program = drawing.trace.program
        laid = component_ending_at(program, self.start)
        if laid is None:
            return "parallel", {**fields, "s": drawing.symbol(program.steps[self.start].name)}
        fields |= {
            "a": laid.component.symbol(drawing),
            "s": drawing.symbol(program.steps[laid.start].name),
        }
        return "parallel-end", fields


class DrivenMisclosure(Misclosure, frozen=True, kw_only=True):
    """The excess of a driver's rate in a plan over the given rate; ``found`` is the rate's step.

    For a sliding driver, the rate is measured between the images ``start`` and ``tip``.
    """

    driver: Driver
    found: int
    start: int | None = None
    tip: int | None = None

    def is_measured(self, drawing: Drawing) -> bool:
        """False: this misclosure is computed."""
        return False

    def has(self, drawing: Drawing) -> float:
        """The driver's rate in the plan."""
        return float(drawing.trace.values[self.found])

    def point(self, drawing: Drawing) -> str:
        """The vector along the guide; empty for a driver that turns."""
        if self.start is None or self.tip is None:
            return ""
        program = drawing.trace.program
        start, tip = program.steps[self.start], program.steps[self.tip]
        if not start.name:
            return drawing.symbol(f"a_{index_before(program, self.start)}^r")
        return drawing.symbol(start.name) + drawing.symbol(tip.name)

    def relation(self, drawing: Drawing, name: str) -> Relation:
        """The relation: the rate in the plan, less the given rate."""
        found, size = self.has(drawing), self.amount(drawing)
        turns = self.driver.kind == "turn"
        if turns:
            figures, unit, remark = figure(drawing, found, FINE), drawing.rate.caret_unit, ""
        else:
            scale = scale_of(drawing, drawing.plane) / 1000
            figures = f"{figure(drawing, scale)}·{within(drawing, found / scale)}"
            unit, point = drawing.vector.caret_unit, self.point(drawing)
            remark = drawing.words("calculation.gap-given", one=point)
        figures += f" − {within(drawing, found - size)}"
        return Relation(name, "", figures, answer(drawing, size), unit, remark, turns=turns)
