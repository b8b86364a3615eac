"""A pencil: the errors of its marks and lines, in millimetres of paper and degrees.

The expected error of drawings is predicted from the single errors of each mark. The rows of one
batch are the sources: one error of one mark at a time, at plus and minus √3 standard deviations.
With the exact drawing, these are the three points of Gauss and Hermite. They give mean and variance
of every answer, as long as errors of different marks do not interact. The 95th percentile follows
from these by a scaled chi-square (Satterthwaite 1946) and its quantile by the cube root (Wilson and
Hilferty 1931).

If a pencil is so coarse that answers are not linear in single errors, marks do interact; and some
drawings close with one error but not with many. Therefore some joint drawings are always made. If
they disagree, the error is read from more of them, which are the same at every run.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from enum import Enum
from functools import cached_property
from math import inf, isfinite, log, radians, sqrt
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.cams.cam_centre import CurvatureCentre
from graphkin.construction.core.component import component_of, has_many_triangles
from graphkin.construction.core.kind import ByHand, construction
from graphkin.construction.core.program import Plane, Program, Step, Target, sign_of
from graphkin.construction.core.quantities import (
    BALANCING_MOMENT,
    BY_TARGET,
    EPSILON,
    RATES,
    MotionQuantity,
)
from graphkin.construction.core.run import Trace
from graphkin.construction.higher_class.closure_solver import ClosureSolver, closer_of
from graphkin.construction.plan import TurningOfLink
from graphkin.drawing.scale import Scales
from graphkin.mechanism import Mechanism
from graphkin.numbers.arithmetic import Point, Real, np, turn_by
from graphkin.numbers.common_roots import solutions
from graphkin.numbers.plane import Circle, Line, Ratio, Vector, by_parts, cross
from graphkin.text.errors import Problem, SceneError, message, verbatim

POINT = 0.5
"""The distance in mm within which 95 of 100 marks of a fair drawing lie."""
RADIAL = sqrt(-2 * log(0.05))
"""The radius, in standard deviations of a coordinate, that holds 95 of 100 marks."""
STRAIGHT = 1.959963984540054
"""The two-sided limit, in standard deviations, that holds 95 of 100 numbers."""


class Pencil(Struct, frozen=True):
    """The errors of a pencil, by the limits that 95 of 100 marks and lines keep.

    - ``point`` (mm): 95 of 100 marks lie within this distance of their true place, evenly in all
      directions. A compass opening errs as a mark does along one axis.
    - ``line`` (degrees): 95 of 100 lines have a direction within this angle of theirs. The default
      is a degree for each mm of ``point``: a line as long as a hand then ends about ``point`` off.
    - ``grid`` (mm): marks are rounded to this grid, if it is not zero.

    Errors are Gaussian and independent.
    """

    point: float = POINT
    line: float | None = None
    grid: float = 0.0

    def __post_init__(self) -> None:
        problems = [
            Problem(
                f"pencil.{name}", verbatim(f"{value:g} {unit}"), message("a number, zero or more")
            )
            for name, value, unit in (
                ("point", self.point, "mm"),
                ("line", self.degrees, "degrees"),
                ("grid", self.grid, "mm"),
            )
            if not (isfinite(value) and value >= 0)
        ]
        if problems:
            raise SceneError(problems)

    @property
    def degrees(self) -> float:
        """The angle, in degrees, within which 95 of 100 lines have their direction."""
        return self.point if self.line is None else self.line

    @property
    def mark(self) -> float:
        """Standard deviation of either coordinate of a mark, in mm."""
        return self.point / RADIAL

    @property
    def turn(self) -> float:
        """Standard deviation of the direction of a line, in radians."""
        return radians(self.degrees) / STRAIGHT


# --- the mark of a step
# ----------------------------------------------------------------------------


class PencilMark(Enum):
    """The kinds of marks that a hand makes, each with the number of its independent errors."""

    POINT = "a point, pricked or crossed", 2
    ARROW = "a point laid off from another, along a line that is not drawn by itself", 3
    LINE = "a line through a point", 1
    ARC = "an opening of the compass", 1
    WAY = "a direction", 1
    CLOSING = "the place where a locus closes a group", 1

    def __init__(self, drawn: str, errors: int) -> None:
        self.drawn, self.errors = drawn, errors


def mark_of(step: Step, value: Any) -> PencilMark | None:
    """The mark that a step puts on paper; None if it puts none, or only joins existing points."""
    if closer_of(step) is not None:
        return PencilMark.CLOSING
    if step.plane is Plane.NUMBERS or isinstance(value, Vector):
        return None
    kind = construction(step)
    by_hand = kind.pencil.get(step.role) if kind is not None else None
    if by_hand is ByHand.KNOWN:
        return None
    if isinstance(value, Line):
        return PencilMark.LINE
    if isinstance(value, Circle):
        return PencilMark.ARC
    if isinstance(value, Ratio):
        return PencilMark.POINT
    if not isinstance(value, complex):
        return None
    if by_hand is ByHand.TURNED:
        return PencilMark.WAY
    return PencilMark.POINT if by_hand is None else PencilMark.ARROW


SCALES = (Plane.MECHANISM, Plane.VELOCITIES, Plane.ACCELERATIONS, Plane.FORCES)
"""The drawings in the order of their scales on paper."""


class Paper(Struct, frozen=True):
    """The amount that a metre of paper represents in each plan: m, m/s, m/s², N.

    ``forces`` is zero where no polygon of forces is drawn.
    """

    mechanism: float
    velocities: float
    accelerations: float
    forces: float = 0.0

    @classmethod
    def of(cls, scales: Scales) -> Paper:
        """The paper of some sheets."""
        return cls(scales.kL, scales.kv, scales.ka, scales.kF)

    def millimetre(self, plane: Plane) -> float:
        """The amount that a millimetre of paper represents in a plane."""
        match plane:
            case Plane.VELOCITIES | Plane.LEVER:  # the lever is the velocity plan, turned
                return self.velocities / 1000
            case Plane.ACCELERATIONS:
                return self.accelerations / 1000
            case Plane.FORCES:
                return self.forces / 1000
        return self.mechanism / 1000


def marked(
    mark: PencilMark, value: Any, start: Point, errors: Any, pencil: Pencil, mm: float
) -> Any:
    """A value with the pencil's errors; ``errors`` are columns in standard deviations.

    ``start`` is the point from which an arrow is laid off. ``mm`` is the amount that a millimetre
    of paper represents.
    """
    if mark is PencilMark.LINE:
        return Line(value.point, value.along * turn_by(pencil.turn * errors[:, 0]))
    if mark is PencilMark.WAY:
        return value * turn_by(pencil.turn * errors[:, 0])
    if mark is PencilMark.ARC:
        radius = value.radius + pencil.mark * mm * errors[:, 0]
        return Circle(value.centre, rounded(radius, pencil, mm))
    shift = pencil.mark * mm * (errors[:, 0] + 1j * errors[:, 1])
    if isinstance(value, Ratio):
        return Ratio(value.start + shift, value.shift, value.size)
    if mark is PencilMark.ARROW:
        shift = shift + (value - start) * (turn_by(pencil.turn * errors[:, 2]) - 1)
    return on_grid(value + shift, pencil, mm)


def rounded(value: Real, pencil: Pencil, mm: float) -> Real:
    """A length rounded to the pencil's grid, if it has one."""
    if not pencil.grid:
        return value
    step = pencil.grid * mm
    return np.rint(value / step) * step


def on_grid(point: Point, pencil: Pencil, mm: float) -> Point:
    """A point rounded to the pencil's grid, if it has one."""
    if not pencil.grid:
        return point
    return rounded(point.real, pencil, mm) + 1j * rounded(point.imag, pencil, mm)


SAME = 1e-9
"""The share by which an arrow may differ from the vector that is read and count as the same."""


class Original(Struct, frozen=True, dict=True):
    """One construction by hand without errors: its trace at some scales, and its targets."""

    trace: Trace
    paper: Paper
    targets: tuple[Target, ...]
    triangles: bool = True

    @property
    def program(self) -> Program:
        return self.trace.program

    @cached_property
    def marks(self) -> Mapping[int, PencilMark]:
        """The mark of each step that puts one on paper, in the order of the drawing."""
        steps = self.program.steps
        found = {
            number: mark_of(steps[number], value) for number, value in self.trace.values.items()
        }
        return {
            number: mark
            for number, mark in found.items()
            if mark is not None and number not in self.skipped
        }

    @cached_property
    def crowded(self) -> bool:
        """Whether there are so many triangles that all of them are computed, not drawn."""
        return has_many_triangles(self.trace)

    @cached_property
    def order(self) -> tuple[int, ...]:
        """The steps whose values a pencil changes, each after the steps that it depends on."""
        moved: list[int] = []
        known: set[int] = set()
        for number in self.trace.values:
            step = self.program.steps[number]
            hand = {step.by_hand} if self.by_hand(number) is not None else set()
            if number not in self.skipped and (
                number in self.marks or known.intersection((*step.args, *hand))
            ):
                moved.append(number)
                known.add(number)
        return tuple(moved)

    @cached_property
    def skipped(self) -> frozenset[int]:
        """Arrows, which only join existing points."""
        return frozenset(n for n in self.trace.values if self.program.steps[n].arrow)

    def by_hand(self, number: int) -> int | None:
        """The drawn step that replaces a composite one; None if the drawing has no such step."""
        component, hand = component_of(self.program, number), self.program.steps[number].by_hand
        if component and (self.crowded or (component.gives_way and not self.triangles)):
            return None
        return hand if hand is not None and hand in self.trace.values else None

    @cached_property
    def tails(self) -> Mapping[int, int]:
        """For each angular acceleration the step at which its tangential component begins.

        A hand reads the arrow of that component, which is a part of the relative vector.
        """
        found = {}
        for number, value in self.trace.values.items():
            step = self.program.steps[number]
            if isinstance(step.of, TurningOfLink) and step.of.quantity == EPSILON:
                for tail in self.tangential_tails(step.args[3]):
                    if self.reads_alike(number, tail, value):
                        found[number] = tail
        return found

    def tangential_tails(self, tip: int) -> Iterable[int]:
        """The steps at which tangential components begin that end at a point of the plan."""
        for number in self.skipped:
            step = self.program.steps[number]
            if sign_of(step) == "τ" and step.args[1] == tip:
                yield step.args[0]

    def reads_alike(self, number: int, tail: int, value: float) -> bool:
        """Whether an arrow to the end of a bar's image gives the same rate."""
        p, q, _, tip = (self.trace.values[arg] for arg in self.program.steps[number].args)
        read = cross(q - p, tip - self.trace.values[tail]) / abs(q - p) ** 2
        return bool(abs(read - value) <= SAME * max(abs(value), abs(tip) / abs(q - p)))


class Originals(Original, frozen=True, kw_only=True, dict=True):
    """The constructions of several variants with the same drawing steps.

    Each value has a row for each variant, or is a single one that all share. ``like`` is the first
    variant.
    """

    like: Original

    @cached_property
    def marks(self) -> Mapping[int, PencilMark]:
        return self.like.marks

    @cached_property
    def order(self) -> tuple[int, ...]:
        return self.like.order

    @cached_property
    def tails(self) -> Mapping[int, int]:
        return self.like.tails


def together(every: Sequence[Original]) -> Original:
    """The constructions of several variants as one."""
    first = every[0]
    if len(every) == 1:
        return first
    values = {
        number: stacked([each.trace.values[number] for each in every])
        for number in first.trace.values
        if number not in first.skipped
    }
    paper = Paper(
        *(
            stacked([getattr(each.paper, name) for each in every])
            for name in Paper.__struct_fields__
        )
    )
    trace = Trace(first.program, values, {})
    return Originals(trace, paper, first.targets, first.triangles, like=first)


def stacked(values: Sequence[Any]) -> Any:
    """The values of all variants as a column, by the parts of a line or circle.

    A value that all variants share stays single.
    """
    first = values[0]
    if isinstance(first, tuple):
        return by_parts(lambda *part: stacked(part), *values)
    if all(value == first for value in values):
        return first
    return np.array(values)[:, None]


def original(
    mechanism: Mechanism, scales: Scales, targets: Iterable[Target] | None = None
) -> Original:
    """The drawing of what a scene asks, or of some targets, at the scales of its sheets."""
    wanted = tuple(mechanism.asked() if targets is None else targets)
    trace = mechanism.trace(wanted, by_hand=True, seconds=scales.seconds)
    paper = Paper.of(scales)
    return Original(trace, paper, wanted, scales.triangles)


FAR = 10.0
"""Metres of paper beyond which a centre counts as at infinity, because no hand draws it."""


class DrawnQuantity(Struct, frozen=True):
    """One answer: its target, the step that gives it, its exact value and its scale.

    ``unit`` is the answer's SI unit. ``millimetre`` is the amount of it that a millimetre of paper
    represents, zero if the answer is not drawn.
    """

    target: Target
    number: int
    is_place: bool
    value: Any
    unit: str
    millimetre: float

    @property
    def size(self) -> float | None:
        """The size that a relative error refers to; None for a place, whose size has no meaning."""
        return None if self.is_place else abs(self.value)

    def of(self, found: Mapping[int, Any]) -> Any:
        """The answer in some drawings, an element for each."""
        value = found[self.number]
        return placed(value) if self.is_place else value

    def error(self, found: Mapping[int, Any]) -> Any:
        """The difference of the answer from the exact one in some drawings."""
        return self.of(found) - self.value


def answers(original: Original) -> Iterator[DrawnQuantity]:
    """The answers that depend on the drawing, in the order asked, without places at infinity.

    A rate that is given, or zero because nothing turns, is not an answer of the drawing. Nor is an
    auxiliary result, such as the angle through which a wheel has turned.
    """
    moved = frozenset(original.order)
    for target in original.targets:
        number = original.program.targets[target]
        quantity = BY_TARGET.get(target[0])
        if number not in moved or quantity is None or not quantity.words:
            continue
        found = answer(original, target, quantity, number)
        if found is not None:
            yield found


def answer(
    original: Original, target: Target, quantity: MotionQuantity, number: int
) -> DrawnQuantity | None:
    """One answer; None for a place that no drawing shows."""
    value = original.trace.values[number]
    mm = original.paper.millimetre(quantity.plane)
    if quantity.is_place:
        value = placed(value)
        if value is None or not isfinite(abs(value)) or abs(value) > FAR * 1000 * mm:
            return None
    elif quantity is BALANCING_MOMENT:
        mm = 0.0
    elif quantity in RATES:
        mm = mm / bar_of(original, original.program.steps[number])
    return DrawnQuantity(target, number, quantity.is_place, value, quantity.unit, mm)


def bar_of(original: Original, step: Step) -> float:
    """The length of the bar from whose relative vector a rate is read; infinite without a bar."""
    if len(step.args) == 4:
        p, q = (original.trace.values[arg] for arg in step.args[:2])
        return abs(q - p) if isinstance(p, complex) and isinstance(q, complex) else float("inf")
    return float("inf")


def placed(value: Any) -> Any:
    """The point of a centre, by construction or by hand; None for one at infinity."""
    if not isinstance(value, Ratio):
        return value
    if not hasattr(value.size, "shape") and value.size == 0:
        return None
    return value.start + value.shift / value.size


Errors = Callable[[int, PencilMark], Any]
"""The errors of a step's mark: a row for each drawing, in standard deviations."""


def redrawn(original: Original, pencil: Pencil, errors: Errors) -> dict[int, Any]:
    """Every value of the drawing with the pencil's errors, an array element for each drawing.

    A value that no error affects stays the single exact value; a value that cannot be drawn is NaN.
    """
    found = dict(original.trace.values)
    with np.errstate(all="ignore"):
        for number in original.order:
            mark = original.marks.get(number)
            row = None if mark is None else errors(number, mark)
            found[number] = step_drawn(original, number, found, row, pencil)
    return found


def step_drawn(
    original: Original, number: int, found: Mapping[int, Any], errors: Any, pencil: Pencil
) -> Any:
    """The value of one step from the values before it, with the errors of its mark."""
    step, mark = original.program.steps[number], original.marks.get(number)
    mm = original.paper.millimetre(step.plane)
    if mark is PencilMark.CLOSING:
        return closed(original, number, found, pencil.mark * mm * errors[:, 0])
    value = unmarked(original, number, found)
    if mark is None:
        return value
    start, kind = value, construction(step)
    if mark is PencilMark.ARROW and kind is not None:
        start = found[kind.pivot if isinstance(kind, CurvatureCentre) else step.args[0]]
    return marked(mark, value, start, errors, pencil, mm)


def unmarked(original: Original, number: int, found: Mapping[int, Any]) -> Any:
    """The value of a step from earlier values: given, drawn by hand, read off, or computed."""
    step, hand = original.program.steps[number], original.by_hand(number)
    if hand is not None:
        return found[hand]
    if step.given is not None:
        return original.trace.values[number]
    assert step.action is not None
    if isinstance(step.of, TurningOfLink):
        return read_off(original, number, found)
    return step.action.value(*(found[arg] for arg in step.args), *step.extra)


def read_off(original: Original, number: int, found: Mapping[int, Any]) -> Any:
    """An angular rate as read by hand: a length in the plan over the known length of the bar.

    For an acceleration the hand reads the tangential component, if it is drawn.
    """
    step = original.program.steps[number]
    p, q, start, tip = step.args
    exact = original.trace.values
    bar = found[q] - found[p]
    tail = original.tails.get(number, start)
    return cross(bar, found[tip] - found[tail]) / (abs(bar) * abs(exact[q] - exact[p]))


def closed(original: Original, number: int, found: Mapping[int, Any], shift: Any) -> Any:
    """The closing value of a group of higher class in each drawing."""
    step = original.program.steps[number]
    known = [found[arg] for arg in step.args]
    exact = original.trace.values[number]
    closer = closer_of(step)
    assert closer is not None
    return followed(closer, exact, known, shift)


ROUNDS = 6
"""The number of Newton steps; three would do, because errors of a drawing are small."""
SMALL = 1e-6
"""Half the step of the difference quotient, in radians or as a share of the reach."""


def followed(
    closer: ClosureSolver, exact: Any, known: Sequence[Any], shift: Any
) -> tuple[Any, ...]:
    """The closure (tried value, signs, sine) for drawn known values, one for each drawing.

    ``shift`` (m) is the error of the mark at the crossing, by which the locus is missed.
    """
    trying = closer.trying
    count = len(trying.unknowns)
    signs, sine = exact[count:-1], exact[-1]
    rows = np.broadcast_to(np.array(signs, dtype=float), (len(shift), len(signs)))
    args = [np.broadcast_to(value, len(shift)) for value in known]
    start = np.array([*map(float, trying.numbers(exact))])
    turned = [one.turns for one in trying.unknowns]
    sizes = np.where(turned, 1.0, np.maximum(abs(start), 1e-3))
    tried, steps = np.tile(start, (len(shift), 1)), SMALL * sizes
    missed = np.column_stack([shift] * count)
    for _ in range(ROUNDS):
        slopes = np.empty((len(shift), count, count))
        for k in range(count):
            away = np.where(np.arange(count) == k, steps, 0.0)
            low, high = (trying.misfits(args, tried + way * away, rows) for way in (-1, 1))
            slopes[:, :, k] = (high - low) / (2 * steps[k])
        left = trying.misfits(args, tried, rows) - missed
        with np.errstate(all="ignore"):
            tried = tried - (left / slopes[:, 0] if count == 1 else solutions(slopes, left))
    return (*trying.placed(tried.T), *signs, sine)


# --- thousands of drawings with random errors, as a class would hand them in ----------------------


BLOCK = 4096
"""Drawings made at once: few enough that the values of a step fit the processor's cache."""
COMMON = 95.0
"""The percentile of drawings that an error covers."""


class Drawn(Struct, frozen=True, dict=True):
    """The answers of many drawings: for each target an array with an element for each drawing.

    Vectors and places are complex; NaN where a drawing does not close.
    """

    original: Original
    answers: tuple[DrawnQuantity, ...]
    values: tuple[Any, ...]

    def __getitem__(self, target: Target) -> Any:
        return self.values[self.index[target]]

    @cached_property
    def index(self) -> dict[Target, int]:
        return {answer.target: i for i, answer in enumerate(self.answers)}

    def error(self, target: Target, percent: float = COMMON) -> float:
        """The largest error of ``percent`` percent of the drawings; infinite if too many fail."""
        off = abs(self[target] - self.answers[self.index[target]].value)
        return float(np.percentile(np.where(np.isnan(off), np.inf, off), percent, method="lower"))


def pencil_drawings(
    mechanism: Mechanism,
    scales: Scales,
    pencil: Pencil,
    count: int,
    seed: int = 0,
    targets: Iterable[Target] | None = None,
) -> Drawn:
    """``count`` drawings of what a scene asks, or of some targets, at the scales of its sheets.

    The same seed gives the same drawings, and a larger ``count`` begins with the same drawings:
    each step has its own random stream (PCG64 of the seed and the step's number).
    """
    return simulated(original(mechanism, scales, targets), pencil, count, seed)


def simulated(exact: Original, pencil: Pencil, count: int, seed: int = 0) -> Drawn:
    """``count`` drawings of an original."""
    wanted = tuple(answers(exact))
    values = [np.empty(count, dtype=np.result_type(type(answer.value))) for answer in wanted]
    streams = {
        number: np.random.Generator(np.random.PCG64([seed, number])) for number in exact.marks
    }
    for start in range(0, count, BLOCK):
        size = min(BLOCK, count - start)

        def errors(number: int, mark: PencilMark, size: int = size) -> Any:
            return streams[number].standard_normal((size, mark.errors))

        found = redrawn(exact, pencil, errors)
        with np.errstate(all="ignore"):
            for answer, array in zip(wanted, values, strict=True):
                array[start : start + size] = answer.of(found)
    return Drawn(exact, wanted, tuple(values))


NODE = sqrt(3)
"""The size of a trial error, in standard deviations."""
WEIGHT = 1 / 6
"""The weight of each of the two trial errors; the exact drawing has the rest."""
BENT = 0.1
"""The ratio of an answer's total drift to its deviation above which errors do not just add."""
TRIED = 500
"""The number of joint drawings that test every forecast."""
ALIKE = 1.25
"""The factor within which a forecast must agree with the joint drawings."""
JOINT = 4000
"""The number of joint drawings from which the error is read if the forecast fails."""
SEED = 95
"""The seed of the errors of joint drawings."""
NORMAL_95 = 1.6448536269514722
"""The 95th percentile of the standard normal distribution."""


class Expected(Struct, frozen=True):
    """The forecast for one answer; ``error`` is its 95th percentile in the answer's SI unit.

    ``sources`` are the shares of its variance, which add up to one, by the step whose mark errs.
    ``joint`` says that errors do not just add, so that joint drawings were made. The error is
    infinite if one drawing in twenty does not close.
    """

    answer: DrawnQuantity
    error: float
    sources: Mapping[int, float]
    joint: bool = False

    @property
    def relative(self) -> float | None:
        """The error over the answer's size; None for a place, infinite for a zero answer."""
        if self.answer.size is None:
            return None
        return self.error / self.answer.size if self.answer.size else inf

    @property
    def millimetres(self) -> float | None:
        """The error in mm of the plan in which the answer is measured; None if it is in none."""
        return self.error / self.answer.millimetre if self.answer.millimetre else None

    @property
    def heaviest(self) -> int | None:
        """The step whose mark contributes most to the error; None if no mark errs."""
        return max(self.sources, key=lambda number: self.sources[number], default=None)


class Forecast(Struct, frozen=True, dict=True):
    """The expected error of each answer of a drawing made with a pencil."""

    original: Original
    pencil: Pencil
    expected: tuple[Expected, ...]

    def __getitem__(self, target: Target) -> Expected:
        return self.index[target]

    @cached_property
    def index(self) -> Mapping[Target, Expected]:
        return {found.answer.target: found for found in self.expected}


def forecast(exact: Original, pencil: Pencil) -> Forecast:
    """The 95th percentile of the error of each answer, with few simulated drawings.

    A grid rounds some marks and leaves others in place, so that a pencil with one needs joint
    drawings.
    """
    owners, errors = sources(exact)
    found = redrawn(exact, replace(pencil, grid=0.0), errors)
    single = [expected(answer, found, owners) for answer in answers(exact)]
    few = simulated(exact, pencil, TRIED, SEED)
    judged = [
        replace(each, joint=each.joint or pencil.grid > 0 or not is_alike(each, few))
        for each in single
    ]
    if any(each.joint for each in judged):
        many = simulated(exact, pencil, JOINT, SEED)
        judged = [
            replace(each, error=many.error(each.answer.target)) if each.joint else each
            for each in judged
        ]
    return Forecast(exact, pencil, tuple(judged))


def is_alike(each: Expected, few: Drawn) -> bool:
    """Whether the joint drawings give about the forecast error; zero agrees with zero."""
    drawn = few.error(each.answer.target)
    return drawn / ALIKE <= each.error <= drawn * ALIKE


def sources(exact: Original) -> tuple[Any, Any]:
    """The step that owns each source, and the errors of each mark, two rows for each source."""
    first: dict[int, int] = {}
    owners: list[int] = []
    for number, mark in exact.marks.items():
        first[number] = len(owners)
        owners += [number] * mark.errors

    def errors(number: int, mark: PencilMark) -> Any:
        rows = np.zeros((len(owners), 2, mark.errors))
        for k in range(mark.errors):
            rows[first[number] + k, :, k] = NODE, -NODE
        return rows.reshape(-1, mark.errors)

    return np.array(owners, dtype=int), errors


def expected(answer: DrawnQuantity, found: Mapping[int, Any], owners: Any) -> Expected:
    """The forecast for one answer, from the drawings with one error each."""
    with np.errstate(all="ignore"):
        off = np.broadcast_to(answer.error(found), 2 * len(owners)).reshape(-1, 2)
        parts = np.stack([off.real, off.imag]) if np.iscomplexobj(off) else off[None]
        mean = WEIGHT * parts.sum(axis=2)
        own = np.einsum("is,js->sij", mean, mean)
        spread = WEIGHT * np.einsum("isk,jsk->sij", parts, parts) - own
        variances = np.einsum("sii->s", spread)
    drift = float(np.hypot(*mean).sum() if len(mean) > 1 else abs(mean).sum())
    bent = not drift <= BENT * sqrt(variances.sum())
    error = percentile(mean.sum(axis=1), spread.sum(axis=0))
    return Expected(answer, error, dict(shares(owners, variances)), bent)


def shares(owners: Any, variances: Any) -> Iterator[tuple[int, float]]:
    """The share of each step in a variance; the sources of a step are adjacent."""
    whole = float(variances.sum())
    if isfinite(whole) and whole > 0:
        first = np.flatnonzero(np.diff(owners, prepend=-1))
        parts = np.add.reduceat(variances, first) / whole
        yield from zip(owners[first].tolist(), parts.tolist(), strict=True)


def percentile(mean: Any, spread: Any) -> float:
    """The 95th percentile of the length of a Gaussian vector, or of the size of a number.

    The square of the length has the mean tr C + m·m and the variance 2 tr C² + 4 m·C·m. It is
    replaced by a scaled chi-square with the same mean and variance. Infinite if these are not
    finite.
    """
    size = float(np.trace(spread) + mean @ mean)
    if not isfinite(size):
        return inf
    if size == 0:
        return 0.0
    change = float(2 * np.trace(spread @ spread) + 4 * mean @ spread @ mean)
    freedoms = 2 * size**2 / change if change > 0 else inf
    return sqrt(size * chi_square_share(freedoms))


def chi_square_share(freedoms: float) -> float:
    """The 95th percentile of a chi-square over its mean (Wilson and Hilferty)."""
    lack = 2 / (9 * freedoms)
    return float((1 - lack + NORMAL_95 * sqrt(lack)) ** 3)
