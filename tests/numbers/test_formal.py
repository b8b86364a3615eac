"""Formal numbers claim nothing that does not hold for every value of their letters."""

from __future__ import annotations

import cmath
import random
from collections.abc import Callable
from fractions import Fraction
from operator import add, mul, sub, truediv
from typing import Any

import pytest

from graphkin.numbers.exact import FORMAL, Exact, Formal, IrrationalError, letter, point
from graphkin.numbers.plane import Line, cross, line_meets_line

TWO: dict[str, Callable[[Any, Any], Any]] = {
    "add": add,
    "sub": sub,
    "mul": mul,
    "truediv": truediv,
}
ONE: dict[str, Callable[[Any], Any]] = {
    "abs": abs,
    "real": lambda z: z.real,
    "imag": lambda z: z.imag,
    "conjugate": lambda z: z.conjugate(),
    "neg": lambda z: -z,
}
U, R, P = FORMAL.direction(Fraction(20)), letter("r"), point("p")
VALUES = (cmath.rect(1, cmath.pi / 9), 0.7, 1.3 - 0.4j, 2.0, -1j)


@pytest.mark.parametrize("seed", range(40))
def test_what_a_formal_number_claims_holds_for_its_letters(seed):
    """Random towers of operations, each beside the same one in complex numbers."""
    chance = random.Random(seed)
    both = list(zip((U, R, P, Formal.of(2), Formal.of(-1j)), VALUES, strict=True))
    claims = 0
    for _ in range(60):
        if chance.random() < 0.6:
            (a, x), (b, y) = chance.choices(both[-12:] + both[:5], k=2)
            found, value = (TWO[chance.choice(list(TWO))], None)
            if found is truediv and (not b.terms or abs(y) < 1e-3):
                continue
            found, value = found(a, b), found(complex(x), y)
        else:
            a, x = chance.choice(both)
            operation = ONE[chance.choice(list(ONE))]
            found, value = operation(a), operation(complex(x))
        if not 1e-4 < abs(value) < 1e4:
            continue
        both.append((found, value))
        for part, true in ((found.real, value.real), (found.imag, value.imag)):
            if part.constant is not None:
                claims += 1
                assert float(part.constant.real) == pytest.approx(true, abs=1e-7)
    assert claims > 5


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (U * U.conjugate(), 1),
        ((1j * U - 1j * U.conjugate()).imag, 0),
        ((1 / (1j * U - 1j * U.conjugate())).imag, 0),
        ((P + R) / (2 * P + 2 * R), Fraction(1, 2)),
        ((3 * (P + R) * (1 / (P + R).real)).real, 3),
        (cross(P, 3 * P), 0),
        (abs(3 * U), 3),
        ((FORMAL.pi / 2).turn(), 1j),
        (Formal.of(-1).arg() / FORMAL.pi, 1),
    ],
)
def test_what_is_a_number_is_known(value, expected):
    assert value.constant == Exact.of(expected)


def test_what_may_be_anything_is_not_known():
    for value in (P.real, P - P.conjugate(), 1 / P, U.imag, abs(P), (R + 1).sqrt(), R.turn()):
        assert value.constant is None


def test_a_point_on_a_level_guide_keeps_its_height():
    found = line_meets_line(Line(Formal.of(0), Formal.of(1)), Line(P, point("q")))
    assert found.imag.constant == Exact.of(0)
    assert found.real.constant is None


def test_order_is_told_of_fractions_and_pi_alone():
    assert Formal.of(Fraction(1, 3)) < FORMAL.pi
    assert not FORMAL.pi <= 3
    with pytest.raises(IrrationalError):
        bool(R < 1)
    with pytest.raises(IrrationalError):
        bool(FORMAL.pi < Fraction(3141592653589793238462643383279, 10**30))
