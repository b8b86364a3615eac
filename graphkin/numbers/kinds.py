"""The number kinds beside Python's float: arrays of three lengths, decimals, balls that certify.

All run the one program. Arrays hold many variants; decimals have as many digits as are asked; a
ball is a number with a radius in which the true value surely lies.
"""

from __future__ import annotations

import math
from fractions import Fraction
from functools import partial
from typing import Any

from graphkin.numbers.arithmetic import FLOAT, Kind, batch_kind, is_ball, is_decimal, np, sqrt

PI_REST = 1.2246467991473532e-16
"""What pi is more than its double, to 33 digits in all together."""
GUARD = 10
"""Digits carried beyond those that are asked of decimals."""


def array_kind(name: str) -> Kind:
    """Arrays of numpy's float32, float64 or longdouble: what cannot be drawn becomes NaN.

    What all variants share is worked out in doubles, or in longdoubles where those are asked, and
    joins the arrays as a number of their own type: a choice between two of Python's own would not.
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
    """An exact number as the sum of the double next to it and of what that lacks."""
    whole = Fraction(exact)
    near = float(whole)
    return dtype(near) + dtype(float(whole - Fraction(near)))


def sound_scalar(value: Any) -> bool:
    """True unless a number of numpy's is infinite or none."""
    return not isinstance(value, np.number) or bool(np.isfinite(value))


def decimal_kind(digits: int) -> Kind:
    """Numbers of mpmath with so many digits that hold, and some more that are carried."""
    import mpmath

    context = mpmath.mp.clone()
    context.dps = digits + GUARD
    return kind_of_context(context)


def kind_of_context(context: Any) -> Kind:
    """The kind of the decimals of one context of mpmath."""

    def number(exact: Any) -> Any:
        whole = Fraction(exact)
        return context.mpf(whole.numerator) / whole.denominator

    return Kind("decimal", number, +context.pi, context.cos, context.sin, sqrt)


def ball_kind(bits: int) -> Kind:
    """Balls of Arb with so many bits (Johansson 2017): the true value surely lies in each.

    What cannot be decided within the ball, such as a root of what may be negative, is not sound.
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
    """True unless a ball, or one of those of a line, a circle or a ratio, reaches to infinity."""
    if isinstance(value, tuple):
        return all(sound_ball(part) for part in value)
    return not is_ball(value) or bool(value.is_finite())


def kind_of(*values: Any) -> Kind:
    """The kind that some values of one run belong to; Python's float where none tells another."""
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
"""The kinds of arrays by numpy's letters for reals and for complex numbers."""


def in_doubles(value: Any) -> Any:
    """The double, or the array of doubles, next to a number of any kind."""
    if hasattr(value, "shape") and value.shape:
        return value.astype(np.complex128 if value.dtype.kind == "c" else np.float64)
    if isinstance(value, complex | float | int):
        return value
    parts = float(value.real), float(value.imag)
    is_complex = type(value).__name__.startswith(("mpc", "acb", "complex", "clongdouble"))
    return complex(*parts) if is_complex else parts[0]


def is_real_ball(value: Any) -> bool:
    """Whether a ball is one of real numbers."""
    from flint import arb

    return isinstance(value, arb)


def middle(value: Any) -> Any:
    """The middle of a ball; any other number as it is."""
    return value.mid() if is_ball(value) else value
