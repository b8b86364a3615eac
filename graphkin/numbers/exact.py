"""Exact numbers: rational ones, and formal ones, whose zeros hold for all values.

A formal number is a polynomial with rational complex coefficients in letters. Letters represent
numbers of which nothing more is needed: real ones (pi, a root, a length found by compass) and
directions, whose conjugates are their inverses. Powers may be negative. Whatever is no polynomial
gets a letter of its own. A result that is a fraction, or zero, is therefore so for all values of
the letters.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Mapping
from fractions import Fraction
from functools import lru_cache
from itertools import count
from math import isqrt
from typing import Any

from msgspec import Struct

from graphkin.numbers.arithmetic import Kind, nearest_quarter, quarter_turns


class IrrationalError(ArithmeticError):
    """A value that is not rational, so that fractions cannot represent it."""


class Exact(Struct, frozen=True):
    """A point or a number with rational coordinates."""

    real: Fraction
    imag: Fraction = Fraction(0)

    @classmethod
    def of(cls, value: Any) -> Exact:
        """A number of any rational kind, unchanged. Raises IrrationalError for pi and the like."""
        if isinstance(value, Exact):
            return value
        if isinstance(value, complex):
            return cls(Fraction(value.real), Fraction(value.imag))
        if isinstance(value, int | float | Fraction):
            return cls(Fraction(value))
        raise IrrationalError(f"{value} is no rational number")

    def __add__(self, other: Any) -> Exact:
        other = Exact.of(other)
        return Exact(self.real + other.real, self.imag + other.imag)

    __radd__ = __add__

    def __neg__(self) -> Exact:
        return Exact(-self.real, -self.imag)

    def __sub__(self, other: Any) -> Exact:
        return self + -Exact.of(other)

    def __rsub__(self, other: Any) -> Exact:
        return Exact.of(other) - self

    def __mul__(self, other: Any) -> Exact:
        other = Exact.of(other)
        return Exact(
            self.real * other.real - self.imag * other.imag,
            self.real * other.imag + self.imag * other.real,
        )

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Exact:
        other = Exact.of(other)
        square = other.square()
        return self * Exact(other.real / square, -other.imag / square)

    def __rtruediv__(self, other: Any) -> Exact:
        return Exact.of(other).__truediv__(self)

    def __abs__(self) -> Exact:
        return Exact(root(self.square()))

    def conjugate(self) -> Exact:
        """The complex conjugate."""
        return Exact(self.real, -self.imag)

    def square(self) -> Fraction:
        """The square of the absolute value."""
        return self.real**2 + self.imag**2


def root(square: Fraction) -> Fraction:
    """The square root of a fraction. Raises IrrationalError if it is irrational."""
    top, bottom = isqrt(square.numerator), isqrt(square.denominator)
    if top**2 != square.numerator or bottom**2 != square.denominator:
        raise IrrationalError(f"the root of {square} is no rational number")
    return Fraction(top, bottom)


class Rational(Kind, frozen=True):
    """Rational numbers: the values of a scene as written, before any rounding."""

    def direction(self, degrees: Any) -> Exact:
        """Unit vector at whole quarter turns. Raises IrrationalError at other angles."""
        quarter = nearest_quarter(degrees)
        if degrees != 90 * quarter:
            raise IrrationalError(f"the direction of {degrees} degrees")
        return Exact.of(complex(quarter_turns(quarter)))

    def radians(self, angle: Any) -> Exact:
        """Unit vector at the angle zero. Raises IrrationalError at other angles."""
        if angle != Exact.of(0):
            raise IrrationalError(f"the direction of {angle} radians")
        return Exact.of(1)


def irrational(value: Any, *others: Any, **named: Any) -> Any:
    """A function with irrational values."""
    raise IrrationalError(f"a function of {value}")


class Pi:
    """An irrational number; every result with it is irrational, too."""

    __neg__ = __abs__ = __lt__ = irrational
    __add__ = __sub__ = __mul__ = __truediv__ = __pow__ = irrational
    __radd__ = __rsub__ = __rmul__ = __rtruediv__ = __rpow__ = irrational


RATIONAL = Rational("rational", Exact.of, Pi(), irrational, irrational, irrational)


# --- formal numbers -------------------------------------------------------------------------------


MOST = 48
"""Terms beyond which a polynomial gets a letter of its own."""
WIDEST = 2048
"""Bits above or below the fraction bar beyond which a number is not kept as a fraction."""


class Letter(Struct, frozen=True, eq=False):
    """A letter for a real number or a direction; ``over`` marks the inverse of a sum."""

    number: int
    direction: bool = False
    over: Formal | None = None

    def __lt__(self, other: Letter) -> bool:
        return self.number < other.number


Term = frozenset[tuple[Letter, int]]
"""The letters of a term with their powers."""

BARE: Term = frozenset()
ZERO, UNIT = Exact(Fraction(0)), Exact(Fraction(1))
COUNT = count()


class Formal:
    """A polynomial in letters; ``terms`` maps the letters of each term to its coefficient."""

    __slots__ = ("terms",)

    def __init__(self, terms: Mapping[Term, Exact]) -> None:
        self.terms = {term: each for term, each in terms.items() if each != ZERO}

    @classmethod
    def of(cls, value: Any) -> Formal:
        """A rational number as a polynomial. Raises IrrationalError for others."""
        return value if isinstance(value, Formal) else cls({BARE: Exact.of(value)})

    @property
    def constant(self) -> Exact | None:
        """The rational value; None if the polynomial contains letters."""
        return self.terms.get(BARE, ZERO) if self.terms.keys() <= {BARE} else None

    @property
    def key(self) -> frozenset[tuple[Term, Exact]]:
        """The identity of the polynomial, used to name a letter."""
        return frozenset(self.terms.items())

    @property
    def leading(self) -> Exact:
        """The coefficient of one of its terms, of the same term in all its multiples."""
        return self.terms[min(self.terms, key=sorted)]

    def __add__(self, other: Any) -> Formal:
        found = dict(self.terms)
        for term, each in Formal.of(other).terms.items():
            found[term] = found.get(term, ZERO) + each
        return kept(Formal(found))

    __radd__ = __add__

    def __neg__(self) -> Formal:
        return Formal({term: -each for term, each in self.terms.items()})

    def __sub__(self, other: Any) -> Formal:
        return self + -Formal.of(other)

    def __rsub__(self, other: Any) -> Formal:
        return Formal.of(other).__sub__(self)

    def __mul__(self, other: Any) -> Formal:
        by = Formal.of(other)
        return cancelled(self, by) or cancelled(by, self) or expanded(self, by)

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Formal:
        by = Formal.of(other)
        if not by.terms:
            raise ZeroDivisionError
        if not self.terms:
            return self
        if len(by.terms) == 1:
            ((term, each),) = by.terms.items()
            inverse = Formal({frozenset((name, -power) for name, power in term): UNIT / each})
            return self * inverse
        if (ratio := multiple(self, by)) is not None:
            return Formal.of(ratio)
        if not is_real(by):
            return self * by.conjugate() / (by * by.conjugate())
        scale: Fraction = 1 / (by.leading.real or by.leading.imag)
        return self * over((by * scale).key) * scale

    def __rtruediv__(self, other: Any) -> Formal:
        return Formal.of(other).__truediv__(self)

    def __abs__(self) -> Formal:
        return (self * self.conjugate()).sqrt()

    def conjugate(self) -> Formal:
        """The complex conjugate."""
        return Formal(
            {
                frozenset((n, -p if n.direction else p) for n, p in term): each.conjugate()
                for term, each in self.terms.items()
            }
        )

    @property
    def real(self) -> Formal:
        """The real part."""
        return (self + self.conjugate()) * Fraction(1, 2)

    @property
    def imag(self) -> Formal:
        """The imaginary part."""
        return (self - self.conjugate()) * -0.5j

    def sqrt(self) -> Formal:
        """The square root: a fraction where it is rational, else a letter."""
        if (value := self.constant) is not None and not value.imag and value.real >= 0:
            try:
                return Formal.of(root(value.real))
            except IrrationalError:
                pass
        return letter(("root", self.key))

    def arg(self) -> Formal:
        """The angle of a direction in radians: exact for quarter turns, else a letter."""
        value = self.constant
        if value is None or (value.real and value.imag):
            return letter(("angle", self.key))
        quarters = (value.real < 0) * 2 if value.real else (1 if value.imag > 0 else -1)
        return PI * Fraction(quarters, 2)

    def turn(self) -> Formal:
        """The unit vector at this angle in radians."""
        (pi,) = PI.terms
        halves = self.terms.get(pi, ZERO).real
        rest = self - PI * halves
        found = FORMAL.direction(180 * halves)
        return found * letter(("turn", rest.key), direction=True) if rest.terms else found

    def simpler(self, other: Formal) -> Formal:
        """The better known of this and another number, both of one value."""
        return min(self, other, key=lambda each: bool(each.real.terms) + bool(each.imag.terms))

    def __lt__(self, other: Any) -> Any:
        return below_zero(self - other)

    def __gt__(self, other: Any) -> Any:
        return below_zero(Formal.of(other) - self)

    def __le__(self, other: Any) -> Any:
        return Undecided() if isinstance(found := self > other, Undecided) else not found

    def __ge__(self, other: Any) -> Any:
        return Undecided() if isinstance(found := self < other, Undecided) else not found


class Undecided:
    """A condition that may hold or not, so that nothing can be selected by it."""

    __bool__ = __array__ = irrational


def below_zero(value: Formal) -> Any:
    """Whether a number is negative, if it has no letters, or only pi and a clear sign."""
    (pi,) = PI.terms
    if value.terms.keys() <= {BARE, pi}:
        whole, turns = (value.terms.get(term, ZERO).real for term in (BARE, pi))
        about = whole + turns * Fraction(math.pi)
        if not turns or abs(about) > abs(turns) / 10**12:
            return about < 0
    return Undecided()


@lru_cache(maxsize=4096)
def letter(name: Hashable, direction: bool = False) -> Formal:
    """The letter of a real number or a direction, cached by name.

    A name that has left the cache gets a new letter.
    """
    return Formal({frozenset({(Letter(next(COUNT), direction), 1)}): UNIT})


@lru_cache(maxsize=4096)
def over(key: frozenset[tuple[Term, Exact]]) -> Formal:
    """The letter of the inverse of a real sum."""
    return Formal({frozenset({(Letter(next(COUNT), over=Formal(dict(key))), 1)}): UNIT})


def point(name: Hashable) -> Formal:
    """A point or a vector of which nothing is known."""
    return letter((name, "x")) + letter((name, "y")) * 1j


def kept(value: Formal) -> Formal:
    """A polynomial, replaced by a letter if it has grown too long."""
    if len(value.terms) <= MOST and not any(map(is_wide, value.terms.values())):
        return value
    return letter(value.key) if is_real(value) else point(value.key)


def expanded(one: Formal, other: Formal) -> Formal:
    """The product, term by term."""
    found: dict[Term, Exact] = {}
    for term, each in one.terms.items():
        for by, factor in other.terms.items():
            both = product(term, by)
            found[both] = found.get(both, ZERO) + each * factor
    return kept(Formal(found))


def cancelled(one: Formal, other: Formal) -> Formal | None:
    """The product with the inverse of a sum that is the other factor's real or imaginary part.

    None where there is nothing to cancel.
    """
    inverses = [name for name, power in next(iter(other.terms), BARE) if name.over and power == 1]
    for name in inverses:
        if all((name, 1) in term for term in other.terms):
            rest = Formal({term - {(name, 1)}: each for term, each in other.terms.items()})
            ratios = [multiple(part, name.over) for part in (one.real, one.imag)]
            if any(ratios):
                parts = zip(ratios, (one.real, one.imag), strict=True)
                x, y = (rest * r if r else expanded(part, other) for r, part in parts)
                return x + y * 1j
    return None


def multiple(value: Formal, of: Formal | None) -> Exact | None:
    """The ratio of a polynomial to another; None if it is no multiple, or is zero."""
    if not value.terms or of is None:
        return None
    ratio = value.leading / of.leading
    return (
        ratio
        if value.key == Formal({t: each * ratio for t, each in of.terms.items()}).key
        else None
    )


def is_real(value: Formal) -> bool:
    """Whether a polynomial equals its own conjugate."""
    return value.key == value.conjugate().key


def is_wide(value: Exact) -> bool:
    """Whether a fraction is too long to be worth computing with."""
    parts = (value.real, value.imag)
    return any(max(abs(p.numerator), p.denominator).bit_length() > WIDEST for p in parts)


def product(one: Term, other: Term) -> Term:
    """The letters of a product of terms."""
    if not one or not other:
        return one or other
    powers = dict(one)
    for name, power in other:
        powers[name] = powers.get(name, 0) + power
    return frozenset((name, power) for name, power in powers.items() if power)


class FormalKind(Kind, frozen=True):
    """Formal numbers: the values of a scene as written, with letters for irrational numbers."""

    def direction(self, degrees: Any) -> Formal:
        """Unit vector at an angle in degrees, exact for whole quarter turns."""
        if not isinstance(degrees, Fraction):
            raise IrrationalError(f"the direction of {degrees} degrees")
        quarter = nearest_quarter(degrees)
        rest = degrees - 90 * quarter
        found = Formal.of((1, 1j, -1, -1j)[quarter % 4])
        return found * letter(("degrees", rest), direction=True) if rest else found

    def radians(self, angle: Any) -> Formal:
        """Unit vector at an angle in radians."""
        return Formal.of(angle).turn()


PI = letter("pi")
FORMAL = FormalKind("formal", Formal.of, PI, irrational, irrational, irrational)
