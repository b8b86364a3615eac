"""Certified numbers: a scene run in balls, and decimals of which every digit is proved.

A ball surely contains the true value. If both its ends round to the same digits, these are the
digits of the true value; else the run is repeated with more bits. If no precision decides a number,
such as whether it is zero, the result says so instead of printing digits.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from fractions import Fraction
from math import ceil, log2
from typing import Any

from msgspec import Struct, field

from graphkin.construction.core.program import Step, Target
from graphkin.construction.core.run import StepFailed, Trace, evaluate
from graphkin.construction.higher_class.closure_solver import closer_of
from graphkin.mechanism import Mechanism
from graphkin.numbers.arithmetic import is_ball
from graphkin.numbers.exact import FORMAL, Formal, letter, point
from graphkin.numbers.kinds import ball_kind, in_doubles, is_real_ball
from graphkin.numbers.plane import by_parts
from graphkin.scene.expression import TIME
from graphkin.scene.model import Scene
from graphkin.text.errors import SceneError

SPARE = 64
"""The bits beyond those of the digits at the first attempt."""
DOUBLINGS = 3
"""How often the bits are doubled before a number counts as not decided."""
IRRATIONAL = (ArithmeticError, TypeError, ValueError, AttributeError, SceneError)
"""The errors of an action on formal numbers: a zero divisor, no order, no such function."""


# --- runs in balls -------------------------------------------------------------------------------


def precisions(digits: int) -> Iterator[tuple[int, bool]]:
    """The bits to try in turn for ``digits`` digits, and whether formal numbers narrow the balls.

    Formal numbers take longer, and most scenes do not need them.
    """
    bits = ceil(digits * log2(10)) + SPARE
    yield bits, False
    for doublings in range(DOUBLINGS + 1):
        yield bits << doublings, True


class Certifier(Struct, frozen=True):
    """A mechanism to run in balls: the steps needed, and their values in formal numbers so far."""

    mechanism: Mechanism
    needed: tuple[int, ...]
    formal: dict[int, Any] = field(default_factory=dict)

    @classmethod
    def of(cls, mechanism: Mechanism, targets: Iterable[Target] | None = None) -> Certifier:
        """A certifier for some targets, or for everything that can be asked."""
        program = mechanism.program
        needed = program.needed(program.answers if targets is None else targets)
        return cls(mechanism, needed)

    def run(self, bits: int, narrowed: bool = True) -> Balls:
        """A run in balls of ``bits`` bits, narrowed to what is formally known.

        A step that fails affects only the steps that depend on it.
        """
        kind, program = ball_kind(bits), self.mechanism.program
        found: dict[int, Any] = {}
        margins: dict[int, Any] = {}
        blame: dict[int, StepFailed] = {}
        stated = fractions(self.mechanism.scene)
        with kind.working():
            values = self.mechanism.scene.values_in(kind)
            for number in self.needed:
                step = program.steps[number]
                lost = next((blame[n] for n in step.args if n in blame), None)
                if lost is not None:
                    blame[number] = lost
                    continue
                try:
                    value = evaluate(step, number, found, values, kind, margins)
                except StepFailed as failed:
                    blame[number] = failed
                    continue
                if narrowed and number not in self.formal:
                    args = [self.formal[n] for n in step.args]
                    self.formal[number] = formal_value(step, args, stated, value)
                found[number] = sharpened(value, self.formal[number]) if narrowed else value
        return Balls(Trace(program, found, margins), blame, self.formal)


class Balls(Struct, frozen=True):
    """A run in balls: the values found, and the failure that prevents each other step."""

    trace: Trace
    blame: Mapping[int, StepFailed]
    formal: Mapping[int, Any]

    def failure(self, target: Target) -> StepFailed | None:
        """Why a target was not found; the first failure if the target is not in the program."""
        number = self.trace.program.targets.get(target)
        if number is None or number not in self.blame:
            return next(iter(self.blame.values()), None)
        return self.blame[number]

    def narrowed(self, place: Any, target: Target) -> Any:
        """The place of a centre, as narrow as its formal value allows."""
        ratio = self.formal.get(self.trace.program.targets.get(target, -1))
        if ratio is None or not ratio.size.terms:
            return place
        return sharpened(place, ratio.start + ratio.shift / ratio.size)

    def in_doubles(self) -> Trace:
        """The doubles next to the middles of the balls."""
        trace = self.trace
        values, margins = (
            {number: nearest(value) for number, value in found.items()}
            for found in (trace.values, trace.margins)
        )
        return Trace(trace.program, values, margins)


def nearest(value: Any) -> Any:
    """The doubles next to the middles of a value made of balls."""
    if isinstance(value, tuple):
        return by_parts(nearest, value)
    return in_doubles(value)


def trace_by_balls(
    mechanism: Mechanism, digits: int, targets: Iterable[Target] | None
) -> Trace | None:
    """The values of some targets found by balls, in doubles, where doubles alone find none.

    None if balls do not find every position either, as at a dead point itself.
    """
    certifier = Certifier.of(mechanism, targets)
    for bits, narrowed in precisions(digits):
        found = certifier.run(bits, narrowed)
        if not found.blame:
            return found.in_doubles()
    return None


# --- formal values: what follows from the scene whatever the numbers are --------------------------


def fractions(scene: Scene) -> dict[str, Any]:
    """The parameters of a scene, and its time if that is a fraction."""
    given = {name: value for name, value in scene.values.items() if name != TIME}
    moment = scene.time.number(given) if scene.time is not None else None
    return given | {TIME: moment} if isinstance(moment, Fraction) else given


def formal_value(step: Step, args: Iterable[Any], values: Mapping[str, Any], ball: Any) -> Any:
    """The value of a step in formal numbers, or letters in the form of its ball if it has none."""
    try:
        if step.given is not None:
            return as_formal(step.given.value(values, FORMAL))
        if step.action is None or closer_of(step) is not None:
            return unknown(ball)
        return as_formal(step.action.value(*args, *step.extra))
    except IRRATIONAL:
        return unknown(ball)


def as_formal(value: Any) -> Any:
    """A value made of Python's numbers as formal numbers, also within lines and circles."""
    if isinstance(value, tuple):
        return by_parts(as_formal, value)
    return Formal.of(value)


def unknown(ball: Any) -> Any:
    """An unknown formal value in the form of a ball."""
    if isinstance(ball, tuple):
        return by_parts(unknown, ball)
    if not is_ball(ball):
        return Formal.of(ball)
    return letter(object()) if is_real_ball(ball) else point(object())


def sharpened(value: Any, formal: Any) -> Any:
    """A ball narrowed to its formal value: of zero width if that is a finite binary fraction."""
    if isinstance(value, tuple):
        return by_parts(sharpened, value, formal)
    if not is_ball(value):
        return value
    from flint import acb

    if is_real_ball(value):
        return narrowed(value, formal)
    return acb(narrowed(value.real, formal.real), narrowed(value.imag, formal.imag))


def narrowed(ball: Any, formal: Formal) -> Any:
    """A real ball, or the fraction that it is known to be."""
    from flint import arb, fmpq

    if (known := formal.constant) is None:
        return ball
    exact = arb(fmpq(known.real.numerator, known.real.denominator))
    assert ball.overlaps(exact), "a ball holds the number that it is formally known to be"
    return exact


# --- decimals ------------------------------------------------------------------------------------


class Decimals(Struct, frozen=True):
    """The printed form of a real ball: ``text`` if its digits are proved, else ``doubt``."""

    text: str | None
    doubt: str = ""


def decimals(ball: Any, digits: int) -> Decimals:
    """The significant digits to which both ends of a ball round; ties go to the even digit."""
    low, high = ends(ball)
    if low == high == 0:
        return Decimals("0")
    if low <= 0 <= high:
        return Decimals(None, f"zero within ±{next_power(max(-low, high))}: not decided")
    first, second = rounded(low, digits), rounded(high, digits)
    if first == second:
        return Decimals(written(*first, digits))
    return Decimals(None, f"known within ±{next_power((high - low) / 2)} only: not decided")


def ends(ball: Any) -> tuple[Fraction, Fraction]:
    """Both ends of a real ball, without rounding; a Python number is its own ball."""
    if not is_ball(ball):
        return Fraction(ball), Fraction(ball)
    if ball.is_exact():
        return (both := dyadic(ball)), both
    middle, radius = dyadic(ball.mid()), dyadic(ball.rad())
    return middle - radius, middle + radius


def dyadic(number: Any) -> Fraction:
    """A ball of zero width as a fraction."""
    mantissa, exponent = (int(part) for part in number.man_exp())
    return Fraction(mantissa) * Fraction(2) ** exponent


def rounded(value: Fraction, digits: int) -> tuple[int, int]:
    """A nonzero number as a whole number of ``digits`` digits, and its leading power of ten."""
    power = power_below(abs(value))
    whole = round(value / Fraction(10) ** (power - digits + 1))
    if abs(whole) == 10**digits:
        return whole // 10, power + 1
    return whole, power


def power_below(size: Fraction) -> int:
    """The power of ten of the first digit of a positive number."""
    bits = size.numerator.bit_length() - size.denominator.bit_length()
    power = (bits - 1) * 30103 // 100000 - 1
    while Fraction(10) ** (power + 1) <= size:
        power += 1
    return power


def next_power(size: Fraction) -> str:
    """The least power of ten not below a positive number, such as 1e-60."""
    power = power_below(size)
    return f"1e{power if Fraction(10) ** power == size else power + 1}"


def written(whole: int, power: int, digits: int) -> str:
    """The digits with their point; with a power of ten where zeros would not be digits."""
    sign, text = "-" if whole < 0 else "", str(abs(whole))
    if 0 <= power < digits:
        before, after = text[: power + 1], text[power + 1 :]
        return f"{sign}{before}.{after}" if after else f"{sign}{before}"
    if -5 <= power < 0:
        return f"{sign}0.{'0' * (-power - 1)}{text}"
    after = f".{text[1:]}" if digits > 1 else ""
    return f"{sign}{text[0]}{after}e{power:+03d}"
