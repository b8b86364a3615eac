"""From 1e-40 m to 1e40 m, from 1e-40 to 1e40 rad/s, far from the origin, long beside short."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from msgspec.structs import replace

from graphkin.motion.cycle import cycle
from graphkin.text.errors import SceneError
from tests.chosen import by_turns
from tests.stress.cases import (
    DRAWN,
    LONG,
    Case,
    DrivenSlide,
    FourBar,
    Lever,
    SliderCrank,
    commanded,
    held,
    statuses,
)

KINDS: tuple[Case, ...] = (FourBar(), SliderCrank(), Lever(), DrivenSlide())
ANGLES = ["0", "60", "180", "-45.5"]


def sized(case: Case, factor: Fraction, speed: Fraction) -> Case:
    """The same mechanism, so many times as large and driven so fast, exactly."""
    bars = tuple(str(factor * Fraction(bar)) for bar in case.bars)
    slides = isinstance(case, DrivenSlide)
    at = str(factor * Fraction(case.at)) if slides else case.at
    pace = str(factor * speed) if slides else str(speed)
    return replace(case, bars=bars, at=at, speed=pace)


def ten(power: int) -> Fraction:
    """A power of ten."""
    return Fraction(10) ** power


@pytest.mark.parametrize("case", KINDS, ids=lambda case: type(case).__name__)
@pytest.mark.parametrize("size", [-29, -7, 7, 29])
def test_no_size_and_no_speed_is_too_small_or_too_large(case, size):
    """Lengths of 1e-7 m give what lengths of 1 m give; no tolerance is a length.

    An absolute tolerance of 1e-6, as another program has, takes all its points for one.
    """
    for speed in (-29, 0, 29):
        here = sized(case, ten(size), ten(speed))
        solution = held(here)
        assert here.mechanism().witness(solution).agrees


@pytest.mark.parametrize(
    ("case", "size"), by_turns(KINDS, [-7, 7]), ids=lambda each: type(each).__name__
)
def test_tiny_and_huge_mechanisms_go_through_all_the_commands(case, size, tmp_path):
    names = LONG if isinstance(case, FourBar) else DRAWN
    said = commanded(sized(case, ten(size), Fraction(1)), tmp_path, names)
    assert set(statuses(said).values()) == {0}, {k: v.stderr for k, v in said.items()}


@pytest.mark.parametrize("size", [-20, 20])
def test_a_sheet_of_any_size_has_its_guide(size, tmp_path):
    """The line of the guide is drawn in millimetres of paper, not in metres."""
    said = commanded(sized(SliderCrank(), ten(size), Fraction(1)), tmp_path, ["sheet"])
    assert statuses(said) == {"sheet": 0}
    (svg,) = (tmp_path / "out").glob("*velocity-key.svg")
    assert "guide 3" in svg.read_text(encoding="utf-8")


# --- far from the origin -------------------------------------------------------------------------

FAR = ("100000000", "-100000000")
"""1e8 m away in both directions, where doubles are 1.5e-8 m apart."""


@pytest.mark.parametrize("case", KINDS, ids=lambda case: type(case).__name__)
def test_far_from_the_origin_errors_are_those_of_the_coordinates(case):
    """1e8 away from it as good as sixteen digits can say where a pin stands, and told so."""
    away = replace(case, corner=FAR)
    solution = held(away)
    verdict = away.mechanism().witness(solution)
    assert verdict.agrees
    assert 2.0**-52 * 1e8 < verdict.limit < 1e-4


@pytest.mark.parametrize("case", KINDS, ids=lambda case: type(case).__name__)
def test_far_from_the_origin_all_the_commands_work(case, tmp_path):
    names = LONG if isinstance(case, DrivenSlide) else DRAWN
    said = commanded(replace(case, corner=FAR), tmp_path, names, pictures=True)
    assert set(statuses(said).values()) == {0}, {k: v.stderr for k, v in said.items()}


def test_the_range_of_a_slide_is_found_far_from_the_origin():
    """What is searched is as large as the mechanism, wherever that stands."""
    near, away = (cycle(replace(DrivenSlide(), corner=at).mechanism()) for at in (("0", "0"), FAR))
    assert np.allclose(near.ranges, [(2, 4), (-4, -2)], atol=1e-12)
    assert np.allclose(away.ranges, near.ranges, atol=1e-6)


def test_a_mechanism_too_small_for_its_coordinates_is_refused(tmp_path):
    """Lengths of 1e-7 m at 1e8 m: no digit of a pin would be left, and none is told."""
    lost = replace(sized(FourBar(), ten(-7), Fraction(1)), corner=FAR)
    with pytest.raises(SceneError, match="coordinates of 16 digits are too coarse") as raised:
        lost.mechanism()
    assert "put the origin near the mechanism" in str(raised.value)
    assert set(statuses(commanded(lost, tmp_path, LONG)).values()) == {2}


# --- long beside short ---------------------------------------------------------------------------


@pytest.mark.parametrize(
    "case",
    [
        SliderCrank(bars=("1", "1000000", "0")),
        SliderCrank(bars=("1/1000000", "1", "0")),
        SliderCrank(bars=("1/1000000", "1", "1/2")),
        FourBar(bars=("1/1000000", "3", "2", "3")),
        FourBar(bars=("1", "1000000", "800000", "300001")),
        Lever(bars=("1", "1000000", "3")),
        Lever(bars=("1", "2", "1000000")),
    ],
)
@pytest.mark.parametrize("at", ANGLES)
def test_lengths_a_million_times_apart(case, at):
    """No digits are lost where the sine is fair: the circles start from the smaller."""
    case = replace(case, at=at)
    if not fair(case):
        return
    solution = held(case)
    assert case.mechanism().witness(solution).agrees


def fair(case: Case) -> bool:
    """Whether a case closes with a fair sine."""
    try:
        return case.truth().sine > 1e-3
    except ValueError:
        return False
