"""The exact decision whether two loci meet, independent of the construction of their meeting.

Floating-point numbers and the numbers of a scene are rational. Whether a circle meets a circle or a
line is the sign of a polynomial in them: of (r1 + r2)² - d² and d² - (r1 - r2)². The product of
these is four times the square of r1·r2 less the square of d² - r1² - r2². In rounded numbers, one
in four pairs of circles that touch or nearly touch is misjudged; in fractions, none is.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from math import isqrt
from typing import Any

from msgspec import Struct

from graphkin.construction.core.program import Program
from graphkin.construction.core.run import StepFailed, evaluate
from graphkin.construction.higher_class.closure_solver import closer_of
from graphkin.numbers.exact import RATIONAL, Exact, IrrationalError
from graphkin.numbers.kinds import ball_kind
from graphkin.numbers.plane import Circle, Line
from graphkin.scene.model import Scene

Locus = Line | Circle
Loci = tuple[Locus, Locus]

EPS = 2.0**-52
ROUNDING = 16 * EPS
"""Share of their size within which the crossing of two loci in floats is undecided."""
BITS = (128, 512, 2048)
"""Bits of the balls that decide, in turn, whether loci meet."""


# --- the decision --------------------------------------------------------------------------------


def meet(first: Locus, second: Locus) -> int:
    """Whether two circles, or a line and a circle, cross (1), touch (0), or miss each other (-1).

    The result is exact for the given numbers, floats included.
    """
    power, _, _, _ = powers(first, second)
    return (power > 0) - (power < 0)


def clearance(first: Locus, second: Locus) -> float:
    """The gap between two loci (m): zero where they touch, negative where they cross.

    It is computed without cancellation, so that its sign is correct and its digits are, to 1e-15.
    """
    power, other, near, far = powers(first, second)
    if power == 0:
        return 0.0
    return -float(power / other / (near + far))


def powers(first: Locus, second: Locus) -> tuple[Fraction, Fraction, Fraction, Fraction]:
    """The deciding power, a nonzero factor of it, and two lengths that are equal at a contact.

    The power is positive where the loci cross. Divided by the factor, it is the difference of the
    squares of the two lengths: the reach of the radii and the distance.
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
    """The square root of a fraction, to at least 64 binary digits."""
    if not square:
        return square
    power = (square.denominator.bit_length() - square.numerator.bit_length()) // 2 + 64
    return Fraction(isqrt(int(square * Fraction(4) ** power))) / Fraction(2) ** power


# --- the loci of a step, as the scene states them ------------------------------------------------


class Meeting(Struct, frozen=True):
    """The gap between two loci (m), negative where they cross.

    ``exactly`` means that it holds for the rational numbers in the scene. ``proved`` means that
    balls prove it for what follows from them. Otherwise it is the gap of the loci in floats.
    ``rounded`` is that gap, and ``size`` the largest length of the loci.
    """

    missed: float
    size: float
    exactly: bool
    proved: bool
    rounded: float

    @property
    def slack(self) -> float:
        """The distance by which rounding may have moved the loci (m)."""
        return 0.0 if self.proved else ROUNDING * self.size

    @property
    def apart(self) -> bool:
        """Whether they miss each other."""
        return self.missed > self.slack

    @property
    def lost(self) -> bool:
        """Whether they cross although, beyond their own rounding, floats miss each other."""
        return self.proved and self.missed < 0 and self.rounded > ROUNDING * self.size

    @property
    def barely(self) -> bool:
        """Whether, as the scene states them, they cross by less than rounding or not at all."""
        return self.exactly and self.missed > -EPS * self.size


def meeting(scene: Scene, program: Program, number: int, loci: Loci) -> Meeting:
    """The gap of the loci of a step, by the scene's own numbers.

    Rational numbers are decided as fractions, others in balls of increasing precision.
    """
    stated = stated_loci(program, number, scene.values)
    found = clearance(rounded(loci[0]), rounded(loci[1]))
    if stated is not None:
        return Meeting(clearance(*stated), size_of(loci), True, True, found)
    proved = proved_clearance(scene, program, number)
    missed = found if proved is None else proved
    return Meeting(missed, size_of(loci), False, proved is not None, found)


def loci_of(args: Sequence[Any]) -> Loci | None:
    """The two loci, not both straight, among the inputs of a step."""
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
    """The two loci that a step crosses, exactly as stated in the scene; None where it does not.

    They are stated where they depend on frame points, on cranks at whole quarter turns, and on
    nothing constructed before.
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
    """The gap of the loci of a step (m), with a sign that balls prove.

    None where they do not, as at a contact, and after a group of higher class.
    """
    step = program.steps[number]
    needed = program.behind(step.args)
    if any(closer_of(program.steps[n]) is not None for n in needed):
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
    """The gap of two loci of balls, negative where they cross."""
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
    """The value of a step in rational numbers. Raises IrrationalError for a crossing."""
    step = program.steps[number]
    if step.given is not None:
        return step.given.value(values, RATIONAL)
    assert step.action is not None
    if step.action.margin is not None or closer_of(step) is not None:
        raise IrrationalError(f"the crossing {step.name}")
    return step.action.value(*(found[arg] for arg in step.args), *step.extra)
