"""Expressions made short have the same value, and their text is read as the same."""

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphkin.numbers.kinds import FLOAT
from graphkin.scene.expression import (
    Call,
    EvaluationError,
    Minus,
    Name,
    Number,
    Pair,
    differentiated,
    evaluate,
    parse,
)
from graphkin.scene.simplify import simplified, text_of

NUMBERS = st.fractions(-20, 20, max_denominator=12).map(Number)
LEAVES = NUMBERS | st.sampled_from([Name("t"), Name("a"), Name("pi")])
TREES = st.recursive(
    LEAVES,
    lambda inner: (
        inner.map(Minus)
        | st.builds(Pair, st.sampled_from("+-*/"), inner, inner)
        | st.builds(Pair, st.just("**"), inner, st.sampled_from([2, 3]).map(Fraction).map(Number))
        | st.builds(Call, st.sampled_from(["sin", "cos"]), inner)
    ),
    max_leaves=12,
)


def value(tree):
    return evaluate(tree, {"t": Fraction(3, 7), "a": Fraction(-5, 3)}, FLOAT)


@given(TREES)
def test_what_is_made_short_has_the_same_value(tree):
    try:
        wanted = value(tree)
    except EvaluationError:
        return
    assert float(value(simplified(tree))) == pytest.approx(float(wanted), rel=1e-9, abs=1e-9)


@given(TREES)
def test_its_text_is_read_as_the_same(tree):
    short = simplified(tree)
    try:
        wanted = value(short)
    except EvaluationError:
        return
    assert float(value(parse(text_of(short)))) == pytest.approx(float(wanted), rel=1e-9, abs=1e-9)


@pytest.mark.parametrize(
    ("law", "first", "second"),
    [
        ("2*t", "2", "0"),
        ("pi - (20*(t - 0.15)**2 + 0.7)", "-40*(t - 0.15)", "-40"),
        ("15*t**3 - 4*t + 1", "45*t**2 - 4", "90*t"),
        ("a*t + t*t/2", "a + t", "1"),
        ("t**3/3", "t**2", "2*t"),
        ("30*sin(90*t)", "15*cos(90*t)*pi", "-7.5*sin(90*t)*pi*pi"),
    ],
)
def test_derivatives_read_as_a_hand_writes_them(law, first, second):
    once = simplified(differentiated(parse(law), "t"))
    assert text_of(once) == first
    assert text_of(simplified(differentiated(once, "t"))) == second
