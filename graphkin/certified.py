"""Certified numbers: a scene run in balls, and the decimals of which every digit is proved.

A ball surely holds the true value. Where both its ends round to the same digits, these are the
digits of the true value; else the run is repeated with more bits. What a ball cannot tell at any
precision, such as whether a number is nought, is said and not printed.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from math import ceil, log2
from typing import Any

from graphkin.arithmetic import is_ball
from graphkin.errors import SceneError
from graphkin.exact import Exact
from graphkin.kinds import ball_kind
from graphkin.mechanism import Mechanism
from graphkin.meeting import exact_value
from graphkin.scene.expression import TIME
from graphkin.scene.model import Scene
from graphkin.steps.program import Program, Target
from graphkin.steps.run import StepFailed, Trace, evaluate

SPARE = 64
"""Bits beyond those of the digits at the first trial."""
DOUBLINGS = 3
"""How often the bits are doubled before a number counts as not decided."""
WIDEST = 2048
"""Bits above or below the fraction bar beyond which a number is no longer kept as a fraction."""
IRRATIONAL = (ArithmeticError, TypeError, AttributeError, SceneError)
"""What an action raises on fractions: no such root, nothing to divide by, no order, no angle."""


# --- runs in balls -------------------------------------------------------------------------------


def precisions(digits: int) -> Iterator[int]:
    """The bits that are tried one after the other for so many significant digits."""
    bits = ceil(digits * log2(10)) + SPARE
    for _ in range(DOUBLINGS + 1):
        yield bits
        bits *= 2


@dataclass(frozen=True)
class Certifier:
    """A mechanism to be run in balls: the steps that are needed, and the values that are exact."""

    mechanism: Mechanism
    needed: tuple[int, ...]
    stated: Mapping[int, Any]

    @classmethod
    def of(cls, mechanism: Mechanism, targets: Iterable[Target] | None = None) -> Certifier:
        """Ready for some targets, or for all that can be asked."""
        program = mechanism.program
        needed = program.needed(program.answers if targets is None else targets)
        return cls(mechanism, needed, rational(program, needed, fractions(mechanism.scene)))

    def run(self, bits: int) -> Balls:
        """All that can be drawn in balls of so many bits; a step that fails takes with it only
        what follows from it."""
        kind, program = ball_kind(bits), self.mechanism.program
        found: dict[int, Any] = {}
        margins: dict[int, Any] = {}
        blame: dict[int, StepFailed] = {}
        with kind.working():
            values = self.mechanism.scene.values_in(kind)
            for number in self.needed:
                lost = next((blame[n] for n in program.steps[number].args if n in blame), None)
                if lost is not None:
                    blame[number] = lost
                    continue
                try:
                    value = evaluate(program.steps[number], number, found, values, kind, margins)
                except StepFailed as failed:
                    blame[number] = failed
                    continue
                found[number] = sharpened(value, self.stated.get(number))
        return Balls(bits, Trace(program, found, margins), blame)


@dataclass(frozen=True, slots=True)
class Balls:
    """A run in balls: what was found, and for every other step the failure that it hangs on."""

    bits: int
    trace: Trace
    blame: Mapping[int, StepFailed]

    def failure(self, target: Target) -> StepFailed | None:
        """Why a target was not found; the first failure of all for what is no target itself."""
        number = self.trace.program.targets.get(target)
        if number is None or number not in self.blame:
            return next(iter(self.blame.values()), None)
        return self.blame[number]


# --- values that the scene states ----------------------------------------------------------------


def fractions(scene: Scene) -> dict[str, Any]:
    """The parameters of a scene, and its moment where that is a fraction."""
    given = {name: value for name, value in scene.values.items() if name != TIME}
    moment = scene.time.number(given) if scene.time is not None else None
    return given | {TIME: moment} if isinstance(moment, Fraction) else given


def rational(
    program: Program, needed: Iterable[int], values: Mapping[str, Any]
) -> Mapping[int, Any]:
    """The values of the steps that are rational numbers, or made of them, without any rounding."""
    found: dict[int, Any] = {}
    for number in needed:
        if found.keys() >= set(program.steps[number].args):
            try:
                value = exact_value(program, number, found, values)
            except IRRATIONAL:
                continue
            if not is_wide(value):
                found[number] = value
    return found


def is_wide(value: Any) -> bool:
    """Whether a fraction has grown so long that to reckon with it takes more time than it saves."""
    if isinstance(value, tuple):
        return any(is_wide(part) for part in value)
    if isinstance(value, Exact):
        return is_wide(value.real) or is_wide(value.imag)
    whole = Fraction(value) if not isinstance(value, complex) else Fraction(0)
    return max(whole.numerator.bit_length(), whole.denominator.bit_length()) > WIDEST


def sharpened(value: Any, stated: Any) -> Any:
    """A ball as narrow as a known fraction allows: of no width at all where that ends in binary."""
    if stated is None or isinstance(value, float | complex):
        return value
    if isinstance(value, tuple):
        parts = zip(value, stated, strict=True)
        return type(value)(*(sharpened(*both) for both in parts))
    from flint import acb, arb, fmpq

    exact = Exact.of(stated)
    x, y = (arb(fmpq(part.numerator, part.denominator)) for part in (exact.real, exact.imag))
    return acb(x, y) if isinstance(value, acb) else x


# --- decimals ------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Decimals:
    """How a real ball prints: ``text`` where its digits are proved, else ``doubt`` says why not."""

    text: str | None
    doubt: str = ""


def decimals(ball: Any, digits: int) -> Decimals:
    """The significant digits to which both ends of a ball round; a tie goes to the even digit."""
    low, high = ends(ball)
    if low == high == 0:
        return Decimals("0")
    if low <= 0 <= high:
        return Decimals(None, f"nought within ±{next_power(max(-low, high))}: not decided")
    first, second = rounded(low, digits), rounded(high, digits)
    if first == second:
        return Decimals(written(*first, digits))
    return Decimals(None, f"known within ±{next_power((high - low) / 2)} only: not decided")


def ends(ball: Any) -> tuple[Fraction, Fraction]:
    """Both ends of a real ball, without rounding; a number of Python's is its own ball."""
    if not is_ball(ball):
        return Fraction(ball), Fraction(ball)
    if ball.is_exact():
        return (both := dyadic(ball)), both
    middle, radius = dyadic(ball.mid()), dyadic(ball.rad())
    return middle - radius, middle + radius


def dyadic(number: Any) -> Fraction:
    """A ball of no width as a fraction."""
    mantissa, exponent = (int(part) for part in number.man_exp())
    return Fraction(mantissa) * Fraction(2) ** exponent


def rounded(value: Fraction, digits: int) -> tuple[int, int]:
    """A number other than nought as a whole number of so many digits, and the power of ten of its
    first digit."""
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
    """The power of ten that is no smaller than a positive number, such as 1e-60."""
    power = power_below(size)
    return f"1e{power if Fraction(10) ** power == size else power + 1}"


def written(whole: int, power: int, digits: int) -> str:
    """So many digits with their point; with a power of ten where noughts would not be digits."""
    sign, text = "-" if whole < 0 else "", str(abs(whole))
    if 0 <= power < digits:
        before, after = text[: power + 1], text[power + 1 :]
        return f"{sign}{before}.{after}" if after else f"{sign}{before}"
    if -5 <= power < 0:
        return f"{sign}0.{'0' * (-power - 1)}{text}"
    after = f".{text[1:]}" if digits > 1 else ""
    return f"{sign}{text[0]}{after}e{power:+03d}"
