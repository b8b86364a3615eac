"""The number kinds other than Python's float: arrays of three lengths, decimals, certified balls.

All of them run the same program. Arrays hold many variants. Decimals have as many digits as
requested. A ball is a number with a radius that surely contains the true value.
"""

from __future__ import annotations

import math
from fractions import Fraction
from functools import partial
from typing import Any

from graphkin.numbers.arithmetic import FLOAT, Kind, batch_kind, is_ball, is_decimal, np, sqrt

PI_REST = 1.2246467991473532e-16
"""The difference of pi and its double; together they give pi to 33 digits."""
GUARD = 10
"""Digits carried beyond the requested digits of decimals."""


def array_kind(name: str) -> Kind:
    """Arrays of numpy's float32, float64 or longdouble; impossible values become NaN.

    Values common to all variants are computed in doubles, or in longdoubles where requested. They
    join the arrays as numbers of the array's type, because a choice between two Python numbers
    would not.
    """
    if name == "float64":
        return batch_kind()
    dtype = np.dtype(name).type

    def number(exact: Any) -> Any:
        return np.asarray(exact, dtype=dtype) if hasattr(exact, "shape") else split(exact, dtype)

    complex_type = np.result_type(dtype, np.complex64).type

    def own(value: Any) -> Any:
        return (complex_type if isinstance(value, complex) else dtype)(value)

    functions = dtype(math.pi) + dtype(PI_REST), np.cos, np.sin, np.sqrt
    single = Kind(name, number, *functions, sound_scalar, own=own) if name == "longdouble" else None
    return Kind(name, number, *functions, shared=single, own=own)


def split(exact: Any, dtype: Any) -> Any:
    """An exact number as the sum of the nearest double and the remainder."""
    whole = Fraction(exact)
    near = float(whole)
    return dtype(near) + dtype(float(whole - Fraction(near)))


def sound_scalar(value: Any) -> bool:
    """False for a numpy number that is infinite or NaN."""
    return not isinstance(value, np.number) or bool(np.isfinite(value))


def decimal_kind(digits: int) -> Kind:
    """Numbers of mpmath with ``digits`` correct digits and some guard digits."""
    import mpmath

    context = mpmath.mp.clone()
    context.dps = digits + GUARD
    return kind_of_context(context)


def kind_of_context(context: Any) -> Kind:
    """The kind of the decimals of one mpmath context."""

    def number(exact: Any) -> Any:
        whole = Fraction(exact)
        return context.mpf(whole.numerator) / whole.denominator

    return Kind("decimal", number, +context.pi, context.cos, context.sin, sqrt)


def ball_kind(bits: int) -> Kind:
    """Balls of Arb with ``bits`` bits (Johansson 2017) that surely contain the true values.

    Undecided results, such as a root of a ball that may be negative, are not sound.
    """
    from flint import acb, arb, ctx, fmpq

    def number(exact: Any) -> Any:
        if is_ball(exact):
            return exact
        whole = Fraction(exact)
        return arb(fmpq(whole.numerator, whole.denominator))

    with ctx.workprec(bits):
        pi = arb.pi()

    def own(value: Any) -> Any:
        return (acb if isinstance(value, complex) else arb)(value)

    working = partial(ctx.workprec, bits)
    return Kind("ball", number, pi, arb.cos, arb.sin, arb.sqrt, sound_ball, working, own=own)


def sound_ball(value: Any) -> bool:
    """False for a ball, or one of a line, circle or ratio, that is not finite."""
    if isinstance(value, tuple):
        return all(sound_ball(part) for part in value)
    return not is_ball(value) or bool(value.is_finite())


def kind_of(*values: Any) -> Kind:
    """The kind of some values of one run; Python's float if none shows another."""
    for value in values:
        if is_decimal(value):
            return kind_of_context(value.context)
        if is_ball(value):
            from flint import ctx

            return ball_kind(ctx.prec)
        if hasattr(value, "dtype"):
            return array_kind(NAMES[value.dtype.char])
    return FLOAT


NAMES = {"d": "float64", "D": "float64", "f": "float32", "F": "float32", "g": "longdouble"} | {
    "G": "longdouble"
}
"""The kinds of arrays, by numpy's letters for real and complex numbers."""


def in_doubles(value: Any) -> Any:
    """The nearest double, or array of doubles, to a number of any kind."""
    if hasattr(value, "shape") and value.shape:
        return value.astype(np.complex128 if value.dtype.kind == "c" else np.float64)
    if isinstance(value, complex | float | int):
        return value
    parts = float(value.real), float(value.imag)
    is_complex = type(value).__name__.startswith(("mpc", "acb", "complex", "clongdouble"))
    return complex(*parts) if is_complex else parts[0]


def is_real_ball(value: Any) -> bool:
    """Whether a ball is real."""
    from flint import arb

    return isinstance(value, arb)


def middle(value: Any) -> Any:
    """The middle of a ball; any other number unchanged."""
    return value.mid() if is_ball(value) else value
