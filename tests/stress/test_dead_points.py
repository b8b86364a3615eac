"""Dead points approached to 1e-15, by a crank and by a slide: right, or told to be wrong."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from msgspec.structs import replace

from graphkin.construction.core.solution import FAIR
from graphkin.motion.cycle import cycle
from graphkin.text.errors import ClosureError, GraphkinError
from tests.stress.cases import (
    DRAWN,
    LONG,
    Case,
    DrivenSlide,
    FourBar,
    assert_within,
    commanded,
    held_batch,
    statuses,
)

STEPS = [10.0**-k for k in range(16)]
"""How far from the dead point: from 1 to 1e-15."""
OPEN = FourBar(bars=("2", "1.5", "1.5", "4"))
"""A four-bar whose crank stops at cos φ = 11/16, coupler and rocker in line."""
SLIDE = DrivenSlide()
"""A slider-crank driven by its block, which stops at 4 m, crank and rod in line."""


def told_or_right(case: Case) -> float:
    """The margin of a solution within its bound, or 0 where an error names the dead point."""
    try:
        solution = case.mechanism().solve()
    except ClosureError as error:
        words = str(error)
        assert "dead point" in words, words
        assert "in line" in words or "parallel" in words, words
        return 0.0
    assert_within(solution, case.truth())
    return float(solution.margin)


@pytest.mark.parametrize("side", ["left", "right"])
def test_a_block_drives_towards_its_dead_point(side):
    """Gap 1 to 1e-15 m, exactly as written: the sine falls as its root, to 5e-8."""
    margins = []
    for k in range(16):
        gap = Fraction(1, 10**k)
        case = replace(SLIDE, side=side, at=str(Fraction(4) - gap))
        margins.append(told_or_right(case))
        true = case.truth().sine
        assert margins[-1] == 0 or abs(margins[-1] / true - 1) < 8 * 2**-52 / true**2 + 1e-12
    assert margins[:15] == sorted(margins[:15], reverse=True)
    assert all(margins[:15])


@pytest.mark.parametrize("side", ["left", "right"])
def test_a_crank_drives_towards_its_dead_point(side):
    """The last closing angle of the cycle, and 1 to 1e-15 degrees before it."""
    case = replace(OPEN, side=side, at="0")
    (low, high), *_ = cycle(case.mechanism()).ranges
    assert np.cos(np.radians(high)) == pytest.approx(11 / 16, abs=1e-15)
    assert low == pytest.approx(-high, abs=1e-12)
    for step in STEPS:
        told_or_right(replace(case, at=str(Fraction(high) - Fraction(step))))


def test_beyond_the_dead_point_the_miss_is_told_to_the_last_digit():
    """Decided on the numbers of the scene, not on what doubles make of them."""
    for k in range(1, 31):
        beyond = replace(SLIDE, at=str(Fraction(4) + Fraction(1, 10**k)))
        with pytest.raises(ClosureError, match=r"the arcs miss each other by ") as raised:
            beyond.mechanism().solve()
        words = str(raised.value)
        told = words.split(" miss each other by ")[1].split(" m;", maxsplit=1)[0]
        assert float(told) == pytest.approx(10.0**-k, rel=1e-3)
        assert ("a dead point" in words) == (k >= 9)


@pytest.mark.parametrize("at", ["4", "2", "-2", "-4"])
def test_exactly_on_the_dead_point_there_are_places_and_no_velocities(at):
    """Crank and rod in line, stretched or folded: the places are exact."""
    case = replace(SLIDE, at=at)
    mechanism = case.mechanism()
    with pytest.raises(ClosureError, match="dead point"):
        mechanism.solve()
    trace = mechanism.trace([("position", "A")])
    assert trace.value("position", "A") == (1 if abs(float(at)) == 4 else -1) * np.sign(float(at))


def test_a_batch_over_a_dead_point_is_nan_only_where_nothing_closes():
    near = [4 - step for step in STEPS] + [4 + step for step in STEPS]
    held_batch(SLIDE, [*near, 2.0, -4.0, 4.0, np.nextafter(4, 0), np.nextafter(4, 5)])
    (_, high), *_ = cycle(OPEN.mechanism()).ranges
    held_batch(OPEN, [high - step for step in STEPS] + [high + step for step in STEPS])


@pytest.mark.parametrize(
    ("case", "at", "expected"),
    [
        (SLIDE, "4-1/10**4", 0),
        (SLIDE, "4-1/10**15", 1),
        (SLIDE, "4", 2),
        (SLIDE, "4+1/10**15", 2),
        (SLIDE, "4+1/10**3", 2),
        (FourBar(bars=("2", "1", "1", "4")), "1/10**9", 2),
    ],
)
def test_the_commands_say_what_is_wrong(case, at, expected, tmp_path):
    """0 where the answer is fair, 1 with a warning where it is not, 2 where there is none."""
    found = replace(case, at=at)
    said = commanded(found, tmp_path, LONG if expected == 2 else DRAWN)
    codes = statuses(said)
    assert {codes[name] for name in ("check", "solve", "json", "sheet")} == {expected}
    if expected == 1:
        assert "less than 0.0001: the answer is not fair to ask" in said["solve"].stderr
    if expected == 2:
        assert "dead point" in said["solve"].stderr or "miss each other" in said["solve"].stderr


def test_what_is_not_fair_is_never_told_without_a_word():
    """Below the fair sine the margin says so, and the bound of the witness holds the error."""
    for k in range(4, 16):
        case = replace(SLIDE, at=str(Fraction(4) - Fraction(1, 10**k)))
        mechanism = case.mechanism()
        solution = mechanism.solve()
        if solution.margin >= FAIR:
            continue
        try:
            verdict = mechanism.witness(solution)
        except GraphkinError as error:
            assert "singular" in str(error)
            continue
        if "links.1.omega" in verdict.unsure:
            continue
        truth = case.truth()
        omega = truth.links["1"].omega
        error = abs(solution.links["1"].omega - float(omega)) / abs(float(omega))
        assert error <= verdict.limit
