"""A closure of a group of higher class in decimals and in balls: right to the last digit, or not
claimed at all."""

from __future__ import annotations

from fractions import Fraction

import pytest

from graphkin.construction.core.run import StepFailed, run
from graphkin.construction.higher_class.closure_solver import ClosureSolver
from graphkin.numbers.arithmetic import is_ball, phase, turn_by
from graphkin.numbers.common_roots import proved
from graphkin.numbers.kinds import ball_kind, decimal_kind
from tests.chosen import EVERY
from tests.numbers import number_kinds as nk
from tests.numbers.test_every_group import NAMES, of_higher_class, work

CLOSED = ("rapid-return", "stephenson-3-crank", "platform-3rpr", "stephenson-2-ternary")
"""The scenes with a group of higher class."""
DIGITS = 60
FINE = decimal_kind(2 * DIGITS)
"""Decimals in which the bisection is done."""


def closings(name):
    """Of each group that is closed by trials: its trial, what is known, its trial value, its signs;
    all in 60 digits."""
    kind, what = decimal_kind(DIGITS), work(name)
    trace = run(what.program, what.needed, what.values, kind)
    for number, value in trace.values.items():
        step = what.program.steps[number]
        if step.action is not None and isinstance(step.action.value, ClosureSolver):
            trying = step.action.value.trying
            tried, *signs, _ = value
            known = [trace.values[arg] for arg in step.args]
            yield trying, known, phase(tried) if trying.first.turns else tried, signs


def misfit_of(trying, known, signs):
    """By how much a trial misses, run anew from the trial's own program."""
    context = FINE.pi.context
    given = dict(zip(trying.inputs, known, strict=True))
    given |= dict(zip(trying.signs, signs, strict=True))

    def misfit(tried):
        tried = context.mpf(tried)
        here = given | {trying.first.tried: turn_by(tried) if trying.first.turns else tried}
        needed = trying.program.behind((trying.first.misfit,))
        return run(trying.program, needed, trying.values, FINE, overrides=here).values[
            trying.first.misfit
        ]

    return misfit


def bisected(misfit, low, high):
    """Where a function changes its sign, by halving alone."""
    at_low = misfit(low)
    assert at_low * misfit(high) < 0
    for _ in range(300):
        middle = (low + high) / 2
        value = misfit(middle)
        low, high = (middle, high) if value * at_low > 0 else (low, middle)
    return (low + high) / 2


def test_all_scenes_of_higher_class_are_tried():
    found = {*filter(of_higher_class, NAMES)}
    assert found >= {*CLOSED} if EVERY else found == {*CLOSED}


@pytest.mark.parametrize("name", CLOSED)
def test_the_secant_finds_what_bisection_finds_to_60_digits(name):
    found = list(closings(name))
    assert found
    for trying, known, tried, signs in found:
        here = FINE.pi.context.mpf(tried)
        away = FINE.number(Fraction(1, 10**12))
        root = bisected(misfit_of(trying, known, signs), here - away, here + away)
        assert abs(root - here) < 10.0**-DIGITS * max(1, abs(here))


@pytest.mark.parametrize("bits", [106, 400])
@pytest.mark.parametrize("name", CLOSED)
def test_the_ball_of_a_closure_holds_what_bisection_finds(name, bits):
    kind, what = ball_kind(bits), work(name)
    with kind.working():
        trace = run(what.program, what.needed, what.values, kind)
        for trying, known, tried, signs in closings(name):
            number = next(
                n
                for n in trace.values
                if (action := what.program.steps[n].action)
                and isinstance(action.value, ClosureSolver)
                and action.value.trying is trying
            )
            here = FINE.pi.context.mpf(tried)
            away = FINE.number(Fraction(1, 10**12))
            root = bisected(misfit_of(trying, known, signs), here - away, here + away)
            ball = trace.values[number][0]
            assert is_ball(ball)
            # what is known is good to 60 digits here, so is the root
            near = turn_by(root) if trying.first.turns else root
            assert nk.contains(ball, near, Fraction(1, 10**58))


# --- the proof -----------------------------------------------------------------------------------


def proof(misfit, near, step=1):
    """The ball that the proof gives, in 200 bits."""
    from flint import arb

    with ball_kind(200).working():
        return proved(misfit, arb(near), step)


def test_a_change_of_sign_is_proved_and_the_root_is_in_the_ball():
    from flint import arb

    ball = proof(lambda x: x * x - 2, "1.4142135623730950488016887242")
    with ball_kind(400).working():
        assert ball.contains(arb(2).sqrt())
        assert ball.rad() < arb("1e-25")


def test_a_falling_misfit_is_proved_as_a_rising_one_is():
    from flint import arb

    ball = proof(lambda x: 2 - x * x, "1.4142135623730950488016887242")
    with ball_kind(400).working():
        assert ball.contains(arb(2).sqrt())


@pytest.mark.parametrize(
    ("misfit", "near"),
    [
        (lambda x: x * x + 1, 1),  # positive everywhere
        (lambda x: -x * x - 1, 1),  # negative everywhere
        (lambda x: x * x + 2.0**-150, 2.0**-75),  # all but touches zero
        (lambda x: x * x, 0),  # touches it: two closures meet
        (lambda x: (x - 1) * (x - 1), 1 + 2.0**-40),
    ],
)
def test_without_a_change_of_sign_nothing_is_claimed(misfit, near):
    with pytest.raises(ValueError, match="ball does not tell"):
        proof(misfit, near)


def test_a_pole_is_no_closure():
    with pytest.raises(ValueError, match="ball does not tell"):
        proof(lambda x: 1 / x - 2.0**-20, 2.0**-60)


def test_a_misfit_known_too_badly_to_have_a_sign_is_no_proof():
    from flint import arb

    with pytest.raises(ValueError, match="ball does not tell"):
        proof(lambda x: x.tanh() + arb(0, 2), 0)


# --- a dead point --------------------------------------------------------------------------------


def test_bars_in_line_at_an_irrational_place_are_not_claimed_at_any_precision(touching):
    """The second dyad stands in line: its circles touch, which no ball tells from missing."""
    program, values = touching.program, touching.scene.values
    for bits in (106, 212, 5000):
        kind = ball_kind(bits)
        with kind.working(), pytest.raises(StepFailed) as failed:
            run(program, program.needed(program.answers), values, kind)
        assert failed.value.step.name == "B"
