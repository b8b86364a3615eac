"""Do two loci meet? Decided without rounding, apart from the construction of where they meet.

Floating-point numbers and the numbers of a scene are rational, and whether a circle meets a circle
or a line is the sign of a polynomial in rational numbers: of (r1 + r2)² - d² and d² - (r1 - r2)²,
whose product is four times the square of r1·r2 less the square of d² - r1² - r2². Rounded, they
misjudge one pair in four of circles that touch or nearly touch; as fractions they misjudge none.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from math import isqrt
from typing import Any

from msgspec import Struct

from graphkin.construction.core.program import Program
from graphkin.construction.core.run import StepFailed, evaluate
from graphkin.construction.higher_class.closure_solver import ClosureSolver
from graphkin.numbers.exact import RATIONAL, Exact, IrrationalError
from graphkin.numbers.kinds import ball_kind
from graphkin.numbers.plane import Circle, Line
from graphkin.scene.model import Scene

Locus = Line | Circle
Loci = tuple[Locus, Locus]

EPS = 2.0**-52
ROUNDING = 16 * EPS
"""Share of their size within which two loci found in floats may cross or not."""
BITS = (128, 512, 2048)
"""Bits of the balls that decide one after the other whether loci meet."""


# --- the decision --------------------------------------------------------------------------------


def meet(first: Locus, second: Locus) -> int:
    """Whether two circles, or a line and a circle, cross: 1; touch: 0; or miss each other: -1.

    Never wrong for the numbers it is given, floats included.
    """
    power, _, _, _ = powers(first, second)
    return (power > 0) - (power < 0)


def clearance(first: Locus, second: Locus) -> float:
    """By how much two loci miss each other (m): nought where they touch, negative where they cross.

    It is found without cancellation, so that its sign is right and its digits are, to 1e-15.
    """
    power, other, near, far = powers(first, second)
    if power == 0:
        return 0.0
    return -float(power / other / (near + far))


def powers(first: Locus, second: Locus) -> tuple[Fraction, Fraction, Fraction, Fraction]:
    """What decides, a factor of it that does not vanish, and two lengths that are alike at a touch.

    The power is positive where the loci cross. Over the factor it is the difference of the squares
    of the two lengths: of the reach of the radii and the distance.
    """
    if isinstance(first, Circle) and isinstance(second, Circle):
        a, b = (Exact.of(each.radius).square() for each in (first, second))
        d = (Exact.of(second.centre) - Exact.of(first.centre)).square()
        half = d - a - b
        r, t = length(a), length(b)
        near = r + t if half > 0 else abs(a - b) / (r + t)
        return 4 * a * b - half**2, abs(half) + 2 * r * t, near, length(d)
    line, circle = (first, second) if isinstance(first, Line) else (second, first)
    assert isinstance(line, Line) and isinstance(circle, Circle)
    along, gap = Exact.of(line.along), Exact.of(circle.centre) - Exact.of(line.point)
    area = (along.conjugate() * gap).imag
    a, square = Exact.of(circle.radius).square(), along.square()
    return a * square - area**2, square, length(a), length(area**2 / square)


def length(square: Fraction) -> Fraction:
    """The root of a fraction, to 64 digits in binary and more."""
    if not square:
        return square
    power = (square.denominator.bit_length() - square.numerator.bit_length()) // 2 + 64
    return Fraction(isqrt(int(square * Fraction(4) ** power))) / Fraction(2) ** power


# --- the loci of a step, as the scene states them ------------------------------------------------


class Meeting(Struct, frozen=True):
    """By how much two loci miss each other (m), negative where they cross.

    ``exactly`` tells that it is so for the rational numbers that the scene states, ``proved`` that
    it is so for what follows from them, by balls; else it is so for the loci found in floats, by
    which it is ``rounded`` and whose largest length is ``size``.
    """

    missed: float
    size: float
    exactly: bool
    proved: bool
    rounded: float

    @property
    def slack(self) -> float:
        """How far rounding may have moved the loci (m)."""
        return 0.0 if self.proved else ROUNDING * self.size

    @property
    def apart(self) -> bool:
        """They miss each other."""
        return self.missed > self.slack

    @property
    def lost(self) -> bool:
        """They cross, and farther than their own rounding explains floats miss each other."""
        return self.proved and self.missed < 0 and self.rounded > ROUNDING * self.size

    @property
    def barely(self) -> bool:
        """They cross, if at all, by less than rounding, as the scene states it."""
        return self.exactly and self.missed > -EPS * self.size


def meeting(scene: Scene, program: Program, number: int, loci: Loci) -> Meeting:
    """Whether the loci of a step meet, by the scene's own numbers: as fractions where these are
    rational, else in balls of more and more bits."""
    stated = stated_loci(program, number, scene.values)
    found = clearance(rounded(loci[0]), rounded(loci[1]))
    if stated is not None:
        return Meeting(clearance(*stated), size_of(loci), True, True, found)
    proved = proved_clearance(scene, program, number)
    missed = found if proved is None else proved
    return Meeting(missed, size_of(loci), False, proved is not None, found)


def loci_of(args: Sequence[Any]) -> Loci | None:
    """The two loci, not both straight, among the values that a step is drawn from."""
    match args:
        case [Circle() | Line() as first, Circle() as second, *_]:
            return first, second
    return None


def rounded(locus: Locus) -> Locus:
    """A locus of any kind of number in floats."""
    if isinstance(locus, Circle):
        return Circle(complex(locus.centre), float(locus.radius))
    return Line(complex(locus.point), complex(locus.along))


def size_of(loci: Loci) -> float:
    """The largest radius of two loci (m)."""
    return max(float(each.radius) for each in loci if isinstance(each, Circle))


def stated_loci(program: Program, number: int, values: Mapping[str, Any]) -> Loci | None:
    """The two loci that a step crosses, exactly as the scene states them; None where it does not.

    It does where they hang on frame points, on cranks at whole quarters of a turn, and on nothing
    that had to be constructed before.
    """
    found: dict[int, Any] = {}
    step = program.steps[number]
    try:
        for earlier in program.behind(step.args):
            found[earlier] = exact_value(program, earlier, found, values)
    except (IrrationalError, ZeroDivisionError, OverflowError):
        return None
    return loci_of([found[arg] for arg in step.args])


def proved_clearance(scene: Scene, program: Program, number: int) -> float | None:
    """By how much the loci of a step miss each other (m), of a sign that balls prove; None where
    they do not, as at a touch, and behind a group of higher class."""
    step = program.steps[number]
    needed = program.behind(step.args)
    if any(
        isinstance(getattr(program.steps[n].action, "value", None), ClosureSolver) for n in needed
    ):
        return None
    for bits in BITS:
        kind = ball_kind(bits)
        with kind.working():
            values, found = scene.values_in(kind), dict[int, Any]()
            try:
                for earlier in needed:
                    args = program.steps[earlier], earlier, found, values, kind
                    found[earlier] = evaluate(*args, {})
            except StepFailed:
                continue
            loci = loci_of([found[arg] for arg in step.args])
            assert loci is not None
            gap = gap_of(*loci)
            if gap > 0 or gap < 0:
                return float(gap)
    return None


def gap_of(first: Locus, second: Locus) -> Any:
    """By how much two loci of balls miss each other, negative where they cross."""
    if isinstance(first, Circle) and isinstance(second, Circle):
        apart = abs(second.centre - first.centre)
        within = abs(first.radius - second.radius) - apart
        return (apart - first.radius - second.radius).max(within)
    line, circle = (first, second) if isinstance(first, Line) else (second, first)
    assert isinstance(line, Line) and isinstance(circle, Circle)
    area = (line.along.conjugate() * (circle.centre - line.point)).imag
    return abs(area) / abs(line.along) - circle.radius


def exact_value(
    program: Program, number: int, found: Mapping[int, Any], values: Mapping[str, Any]
) -> Any:
    """The value of a step in rational numbers; IrrationalError for a crossing that is none."""
    step = program.steps[number]
    if step.given is not None:
        return step.given.value(values, RATIONAL)
    assert step.action is not None
    if step.action.margin is not None or isinstance(step.action.value, ClosureSolver):
        raise IrrationalError(f"the crossing {step.name}")
    return step.action.value(*(found[arg] for arg in step.args), *step.extra)
