"""Surds: exact numbers made of fractions, directions in rational degrees, pi and square roots.

A surd is a sum of terms over a denominator. A term is a power of pi, times some roots, times a
polynomial in a root of unity with rational coefficients; the denominator has no roots. Whether a
surd is zero is decided, not estimated:

- Without roots it is zero only if it has no terms: pi is transcendental, and polynomials reduced by
  the cyclotomic one are zero only with all their coefficients.
- a + b·r, where r is the root of d, is zero only if a² - b²·d is, which has one root less. One of
  a + b·r and a - b·r is then zero. If a is not, the other one is 2a, and a ball shows which it is.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from functools import lru_cache
from itertools import count
from math import gcd, isqrt, lcm
from typing import Any

from msgspec import Struct

from graphkin.numbers.arithmetic import Kind
from graphkin.numbers.exact import Exact, IrrationalError

FINEST = 3600
"""The highest order of a root of unity: that of the multiples of a tenth of a degree."""
LONGEST = 1_000_000
"""The bits of all coefficients beyond which a surd takes too long to compute with."""
START = 128
"""The bits of the first ball around a surd."""
SMALL_PRIMES = [n for n in range(2, 1000) if all(n % k for k in range(2, isqrt(n) + 1))]


class TooLongError(ArithmeticError):
    """A number that is a surd, but too long to compute with."""


class Root(Struct, frozen=True, eq=False):
    """The positive square root of a positive surd that has only roots of lower numbers."""

    number: int
    square: Surd


Key = tuple[int, frozenset[Root]]
"""The power of pi and the roots of a term."""

BARE: Key = (0, frozenset())
COUNT = count()


class Surd:
    """An exact number: ``terms`` with polynomials in the root of unity of an ``order``, a multiple
    of 4, over ``under``; None stands for 1."""

    __hash__ = None  # type: ignore[assignment]
    __slots__ = ("order", "terms", "under")

    def __init__(self, terms: Mapping[Key, Any], order: int, under: Surd | None = None) -> None:
        self.terms = {key: each for key, each in terms.items() if each}
        self.order, self.under = order, under

    @classmethod
    def of(cls, value: Any) -> Surd:
        """A rational number, real or complex. Raises IrrationalError for others."""
        if isinstance(value, Surd):
            return value
        exact = Exact.of(value)
        return cls({BARE: polynomial([exact.real, exact.imag])}, 4)

    @property
    def top(self) -> Surd:
        """The numerator."""
        return self if self.under is None else Surd(self.terms, self.order)

    @property
    def bottom(self) -> Surd:
        """The denominator."""
        return UNIT if self.under is None else self.under

    # --- arithmetic ------------------------------------------------------------------------------

    def __add__(self, other: Any) -> Surd:
        by = Surd.of(other)
        if same(self.bottom, by.bottom):
            return reduced(sum_of(self, by), self.bottom)
        tops = product(self.top, by.bottom), product(by.top, self.bottom)
        return reduced(sum_of(*tops), product(self.bottom, by.bottom))

    __radd__ = __add__

    def __neg__(self) -> Surd:
        return Surd({key: -each for key, each in self.terms.items()}, self.order, self.under)

    def __sub__(self, other: Any) -> Surd:
        return self + -Surd.of(other)

    def __rsub__(self, other: Any) -> Surd:
        return Surd.of(other) + -self

    def __mul__(self, other: Any) -> Surd:
        by = Surd.of(other)
        found = product(self.top, by.top)
        return reduced(found.top, product(found.bottom, product(self.bottom, by.bottom)))

    __rmul__ = __mul__

    def __pow__(self, power: int) -> Surd:
        return self if power == 1 else self * self ** (power - 1)

    def __truediv__(self, other: Any) -> Surd:
        return self * inverse(Surd.of(other))

    def __rtruediv__(self, other: Any) -> Surd:
        return inverse(self) * other

    def __abs__(self) -> Surd:
        if self == self.conjugate():
            return -self if self < 0 else self
        return (self * self.conjugate()).sqrt()

    def conjugate(self) -> Surd:
        """The complex conjugate: a root of unity becomes its inverse, and square roots are real."""
        below = None if self.under is None else self.under.conjugate()
        return Surd(mapped(self, self.order, -1), self.order, below)

    @property
    def real(self) -> Surd:
        """The real part."""
        return (self + self.conjugate()) * Fraction(1, 2)

    @property
    def imag(self) -> Surd:
        """The imaginary part."""
        return (self - self.conjugate()) * -0.5j

    # --- functions -------------------------------------------------------------------------------

    def sqrt(self) -> Surd:
        """The square root. Raises ValueError for a negative number."""
        if self.is_zero:
            return NOUGHT
        if self < 0:
            raise ValueError("the square root of a negative number")
        power, *others = {power for power, _ in self.terms}
        if others or power % 2:
            return root_of(self)
        return root_of(self.times_pi(-power)).times_pi(power // 2)

    def arg(self) -> Surd:
        """The angle of a direction in radians. Raises IrrationalError if no fraction of a turn."""
        if self.is_zero:
            return NOUGHT
        turns = ball(self, START).log().imag / (2 * ball(PI, START).real)
        steps = round(float((turns * self.order).mid()))
        back = self * unity(self.order, -steps)
        if not back.imag.is_zero or back.real < 0:
            raise IrrationalError("an angle that is no fraction of a turn")
        return PI * Fraction(2 * steps, self.order)

    def turn(self) -> Surd:
        """The unit vector at an angle. Raises IrrationalError if that is no fraction of a turn."""
        turns = self.times_pi(-1).constant
        if turns is None or turns.imag:
            raise IrrationalError("an angle that is no fraction of a turn")
        return SURD.direction(180 * turns.real)

    def simpler(self, other: Surd) -> Surd:
        """The shorter one of two surds of one value."""
        return min(self, other, key=length)

    def times_pi(self, power: int) -> Surd:
        """The product with a power of pi."""
        terms = {(n + power, roots): each for (n, roots), each in self.terms.items()}
        return reduced(Surd(terms, self.order), self.bottom)

    # --- decisions -------------------------------------------------------------------------------

    @property
    def is_zero(self) -> bool:
        """Whether the number is zero."""
        return vanishes(self.top)

    @property
    def constant(self) -> Exact | None:
        """The rational value; None for a surd that is none, or does not show it."""
        if self.is_zero:
            return Exact(Fraction(0))
        if self.under is not None or self.terms.keys() != {BARE}:
            return None
        parts = dict(enumerate(self.terms[BARE].coeffs()))
        found = [fraction(parts.pop(k, 0)) for k in (0, self.order // 4)]
        return None if any(parts.values()) else Exact(*found)

    def __eq__(self, other: object) -> bool:
        return (self - other).is_zero

    def __lt__(self, other: Any) -> bool:
        return sign(self - other) < 0

    def __gt__(self, other: Any) -> bool:
        return sign(self - other) > 0

    def __le__(self, other: Any) -> bool:
        return sign(self - other) <= 0

    def __ge__(self, other: Any) -> bool:
        return sign(self - other) >= 0


# --- polynomials in a root of unity --------------------------------------------------------------


def polynomial(coefficients: Any) -> Any:
    """A polynomial with rational coefficients, the constant one first."""
    from flint import fmpq, fmpq_poly

    return fmpq_poly(
        [fmpq(c.numerator, c.denominator) if isinstance(c, Fraction) else c for c in coefficients]
    )


def fraction(value: Any) -> Fraction:
    """A rational number of flint, or 0, as a fraction."""
    return Fraction(int(value.p), int(value.q)) if value else Fraction(0)


@lru_cache(maxsize=64)
def cyclotomic(order: int) -> Any:
    """The polynomial of the primitive roots of unity of an order. Raises TooLongError."""
    from flint import fmpq_poly, fmpz_poly

    if order > FINEST:
        raise TooLongError("angles of too small a fraction of a turn")
    return fmpq_poly(fmpz_poly.cyclotomic(order))


def unity(order: int, power: int) -> Surd:
    """A power of the root of unity of an order."""
    return Surd({BARE: polynomial([0] * (power % order) + [1]) % cyclotomic(order)}, order)


def mapped(value: Surd, order: int, step: int) -> dict[Key, Any]:
    """The terms with each power of the root of unity ``step`` times as high, in a given order."""
    found = {}
    for key, each in value.terms.items():
        room = [0] * order
        for power, coefficient in enumerate(each.coeffs()):
            room[power * step % order] = coefficient
        found[key] = polynomial(room) % cyclotomic(order)
    return found


def alike(one: Surd, other: Surd) -> tuple[Surd, Surd]:
    """Two numerators in the root of unity of one order."""
    order = lcm(one.order, other.order)
    pair = [
        each if each.order == order else Surd(mapped(each, order, order // each.order), order)
        for each in (one, other)
    ]
    return pair[0], pair[1]


# --- sums and products ---------------------------------------------------------------------------


def sum_of(one: Surd, other: Surd) -> Surd:
    """The sum of two numerators."""
    one, other = alike(one, other)
    found = dict(one.terms)
    for key, each in other.terms.items():
        found[key] = found[key] + each if key in found else each
    return kept(Surd(found, one.order))


def product(one: Surd, other: Surd) -> Surd:
    """The product of two numerators; the squares of common roots may give it a denominator."""
    one, other = alike(one, other)
    order, modulus = one.order, cyclotomic(lcm(one.order, 4))
    found: dict[frozenset[Root], dict[Key, Any]] = {}
    for (power, roots), each in one.terms.items():
        for (more, others), factor in other.terms.items():
            terms = found.setdefault(roots & others, {})
            key = power + more, roots ^ others
            terms[key] = terms.get(key, 0) + each * factor % modulus
    total = kept(Surd(found.pop(frozenset(), {}), order))
    for common, terms in found.items():
        rest = Surd(terms, order)
        for root in common:
            rest = rest * root.square
        total = total + rest
    return total


def reduced(top: Surd, bottom: Surd) -> Surd:
    """A fraction of surds; without its denominator where the numerator is a multiple of that."""
    if same(bottom, UNIT) or not top.terms:
        return top
    power = min(power for power, _ in bottom.terms)
    if len(bottom.terms) == 1:
        return product(top, inverse(bottom))
    first = bottom.terms[power, frozenset()]
    lead = {k: p for k, p in top.terms.items() if k[0] == min(n for n, _ in top.terms)}
    ratio = product(Surd(lead, top.order), inverse(Surd({(power, frozenset()): first}, bottom.order)))
    if same(product(ratio, bottom), top):
        return ratio
    return Surd(top.terms, top.order, bottom)


def same(one: Surd, other: Surd) -> bool:
    """Whether two numerators look alike."""
    return one is other or (one.order == other.order and one.terms == other.terms)


def bits_in(value: Any) -> int:
    """The bits of the longest coefficient of a polynomial, with its denominator."""
    longest = max(map(abs, value.numer().coeffs()), default=0)
    return int(longest).bit_length() + int(value.denom()).bit_length()


def length(value: Surd) -> int:
    """The bits of all coefficients, at most."""
    return sum(bits_in(each) * (each.degree() + 1) for each in value.terms.values())


def kept(value: Surd) -> Surd:
    """A surd as it is. Raises TooLongError if it has grown too long."""
    if length(value) > LONGEST:
        raise TooLongError("exact numbers that grow too long")
    return value


# --- roots ---------------------------------------------------------------------------------------


def root_of(square: Surd) -> Surd:
    """The square root of a positive surd; its square factors come before the root."""
    polynomials = square.terms.values()
    below = lcm(*(int(each.denom()) for each in polynomials))
    above = gcd(*(int((each * below).numer().content()) for each in polynomials))
    outside, inside = squares_in(above * below)
    within = square * Fraction(below * inside, above)
    if same(within, UNIT):
        return Surd.of(Fraction(outside, below))
    parts = (within.top, within.bottom)
    return as_surd(named_root(*map(name_of, parts))) * Fraction(outside, below)


Name = tuple[int, frozenset[tuple[Key, tuple[Any, ...]]]]


def name_of(value: Surd) -> Name:
    """The order and coefficients of a numerator."""
    return value.order, frozenset((k, tuple(p.coeffs())) for k, p in value.terms.items())


@lru_cache(maxsize=4096)
def named_root(*parts: Name) -> Root:
    """The root of a fraction by the names of its parts; one number has one root."""
    top, bottom = (Surd({k: polynomial(p) for k, p in terms}, order) for order, terms in parts)
    return Root(next(COUNT), reduced(top, bottom))


def as_surd(root: Root) -> Surd:
    """A root as a surd."""
    return Surd({(0, frozenset({root})): polynomial([1])}, 4)


def squares_in(number: int) -> tuple[int, int]:
    """The numbers a and b of a²·b, where b has no square of a small prime, nor is one itself."""
    outside, inside = 1, number
    for prime in SMALL_PRIMES:
        while inside % prime**2 == 0:
            outside, inside = outside * prime, inside // prime**2
    whole = isqrt(inside)
    return (outside * whole, 1) if whole**2 == inside else (outside, inside)


def latest(value: Surd) -> Root | None:
    """The root of the highest number in a numerator."""
    roots = (root for _, each in value.terms for root in each)
    return max(roots, key=lambda root: root.number, default=None)


def split(value: Surd, root: Root) -> tuple[Surd, Surd]:
    """The parts a and b of a numerator a + b·r."""
    a = {key: each for key, each in value.terms.items() if root not in key[1]}
    b = {(n, roots - {root}): p for (n, roots), p in value.terms.items() if root in roots}
    return Surd(a, value.order), Surd(b, value.order)


def vanishes(value: Surd) -> bool:
    """Whether a numerator is zero."""
    root = latest(value)
    if not value.terms or root is None or not near(value).contains(0):
        return not value.terms
    a, b = split(value, root)
    if not (a * a - b * b * root.square).is_zero:
        return False
    return vanishes(a) or not is_first(value, a - b * as_surd(root))


def inverse(value: Surd) -> Surd:
    """One over a number. Raises ZeroDivisionError."""
    if value.is_zero:
        raise ZeroDivisionError
    if value.under is not None:
        return inverse(value.top) * value.under
    root = latest(value)
    if root is not None:
        a, b = split(value, root)
        square = a * a - b * b * root.square
        return inverse(a * 2) if square.is_zero else (a - b * as_surd(root)) * inverse(square)
    if len(value.terms) > 1:
        return Surd(UNIT.terms, 4, value)
    ((power, _), each) = next(iter(value.terms.items()))
    unit, factor, _ = each.xgcd(cyclotomic(value.order))
    return Surd({(-power, frozenset()): factor / unit.coeffs()[0]}, value.order)


# --- balls ---------------------------------------------------------------------------------------


def ball(value: Surd, bits: int) -> Any:
    """A complex ball that contains the number."""
    from flint import acb, acb_poly, arb, ctx

    with ctx.workprec(bits):
        unit = (acb(2) / value.order).exp_pi_i()
        total = acb(0)
        for (power, roots), each in value.terms.items():
            part = acb_poly(each)(unit) * arb.pi() ** power
            for root in roots:
                part *= root_ball(root, bits)
            total += part
        return total if value.under is None else total / ball(value.under, bits)


@lru_cache(maxsize=4096)
def root_ball(root: Root, bits: int) -> Any:
    """A real ball that contains a root."""
    from flint import ctx

    with ctx.workprec(bits):
        return ball(root.square, bits).real.sqrt()


def near(value: Surd) -> Any:
    """A ball as narrow as the coefficients of a number are long."""
    widest = max((bits_in(each) for each in value.terms.values()), default=0)
    return ball(value, START + widest)


def is_first(one: Surd, other: Surd) -> bool:
    """Whether the first of two numbers is the one that is not zero; exactly one of them is not."""
    bits = START
    while True:
        for each in (one, other):
            if not ball(each, bits).contains(0):
                return each is one
        bits *= 2


def sign(value: Surd) -> int:
    """The sign of a real number."""
    if value.is_zero:
        return 0
    bits = START
    while (found := ball(value, bits).real).contains(0):
        bits *= 2
    return 1 if found > 0 else -1


# --- the kind ------------------------------------------------------------------------------------


class SurdKind(Kind, frozen=True):
    """Surds: the values of a scene as written, whose angles are fractions of a turn."""

    def direction(self, degrees: Any) -> Surd:
        """Unit vector at an angle in degrees. Raises IrrationalError if that is irrational."""
        if not isinstance(degrees, Fraction):
            raise IrrationalError("an angle that is no fraction of a turn")
        turns = degrees / 360
        order = lcm(4, turns.denominator)
        return unity(order, turns.numerator * (order // turns.denominator))

    def radians(self, angle: Any) -> Surd:
        """Unit vector at an angle in radians."""
        return Surd.of(angle).turn()


UNIT, NOUGHT = Surd.of(1), Surd.of(0)
PI = UNIT.times_pi(1)
SURD = SurdKind(
    "surd",
    Surd.of,
    PI,
    lambda angle: Surd.of(angle).turn().real,
    lambda angle: Surd.of(angle).turn().imag,
    lambda number: Surd.of(number).sqrt(),
)
