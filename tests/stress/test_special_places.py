"""The crank at whole quarters, rest, translation, poles at infinity, and points on their line."""

from __future__ import annotations

from math import isfinite

import mpmath
import pytest
from msgspec.structs import replace

from tests.stress.cases import (
    DRAWN,
    LONG,
    Case,
    DrivenSlide,
    FourBar,
    Lever,
    SliderCrank,
    assert_near,
    commanded,
    held,
    statuses,
)
from tests.stress.closed import EPS, Motion, Moving, number

QUARTERS = ("0", "90", "180", "270", "360", "-90", "3600000000000000090")
CASES: tuple[Case, ...] = (
    FourBar(),
    SliderCrank(),
    SliderCrank(bars=("1", "3", "1/2")),
    Lever(),
)
ASKED = "velocity = ['B']\nacceleration = ['B']\ncentres = [2]\npoles = [2]\ninflection = [2]"


# --- the crank at exactly 0, 90, 180, 270 degrees ------------------------------------------------


@pytest.mark.parametrize("case", CASES, ids=lambda case: type(case).__name__)
@pytest.mark.parametrize("at", QUARTERS)
def test_at_whole_quarters_of_a_turn(case, at):
    """An angle of 90° is 90°, also after ten million billion turns: cosine zero, no 6e-17."""
    solution = held(replace(case, at=at))
    pin, pivot = solution.points["A"], complex(0)
    x, y = (pin.position - pivot).real, (pin.position - pivot).imag
    assert (x == 0) != (y == 0)
    assert abs(x) + abs(y) == 1
    assert pin.velocity == 1j * pin.position
    assert pin.acceleration == -pin.position


@pytest.mark.parametrize(("at", "place", "pull"), [("0", 4.0, -4 / 3), ("180", 2.0, 2 / 3)])
def test_the_slider_crank_in_line_stands_moves_and_turns_round_exactly(at, place, pull):
    """At its dead points the block is at rest: r + l, zero, and r·ω²(±1 + r/l)."""
    block = held(replace(SliderCrank(), at=at)).points["B"]
    assert block.position == place
    assert block.velocity == 0
    assert block.acceleration == pytest.approx(pull, rel=2 * EPS)


# --- at rest, without acceleration, in translation -----------------------------------------------


@pytest.mark.parametrize("case", [*CASES, DrivenSlide()], ids=lambda case: type(case).__name__)
def test_a_driver_at_rest_gives_zeros(case, tmp_path):
    """Velocity zero and acceleration zero: every plan is a point, and no number is NaN."""
    still = replace(case, speed="0", ask="velocity = ['B']\nacceleration = ['B']")
    solution = held(still)
    for point in solution.points.values():
        assert (point.velocity, point.acceleration) == (0, 0)
    for link in solution.links.values():
        assert (link.omega, link.epsilon) == (0, 0)
    assert still.mechanism().witness(solution).agrees
    names = LONG if isinstance(case, SliderCrank) else DRAWN
    assert set(statuses(commanded(still, tmp_path, names)).values()) == {0}


@pytest.mark.parametrize("case", CASES, ids=lambda case: type(case).__name__)
def test_a_driver_that_starts_from_rest_has_accelerations_only(case):
    starting = replace(case, speed="0", push="2")
    solution = held(starting)
    assert all(point.velocity == 0 for point in solution.points.values())
    assert abs(solution.points["B"].acceleration) > 0
    assert starting.mechanism().witness(solution).agrees


def test_a_block_at_constant_speed_has_no_acceleration():
    """Driven evenly: acceleration exactly zero, its pole nowhere, no ε from 0/0."""
    block = held(DrivenSlide()).points["B"]
    assert (block.velocity, block.acceleration) == (1, 0)


TRANSLATING = FourBar(bars=("2", "4", "2", "4"), ask=ASKED)


@pytest.mark.parametrize(
    ("case", "direction"),
    [(TRANSLATING, "60.0000°"), (SliderCrank(at="90", ask=ASKED), "90.0000°")],
)
def test_a_link_in_translation_has_its_centre_at_infinity(case, direction, tmp_path):
    """The coupler of a parallelogram, and a rod as its crank stands square: in which direction."""
    solution = held(case)
    centre = solution.links["2"].instant_centre
    assert abs(centre.size) <= 4 * EPS * abs(centre.shift)
    assert isfinite(abs(centre.shift)) and abs(centre.shift) > 1
    said = commanded(case, tmp_path, DRAWN)
    assert set(statuses(said).values()) == {0}
    assert f"at infinity, in direction {direction}" in said["solve"].stdout


def test_a_link_all_of_whose_points_accelerate_alike_has_its_pole_at_infinity(tmp_path):
    solution = held(TRANSLATING)
    pole = solution.links["2"].acceleration_pole
    assert abs(pole.size) <= 4 * EPS * abs(pole.shift)
    said = commanded(TRANSLATING, tmp_path, ["solve", "json"])
    assert "at infinity: all accelerate alike, towards -120.000°" in said["solve"].stdout


def test_centres_of_a_link_at_rest_are_told_in_words(tmp_path):
    said = commanded(replace(TRANSLATING, speed="0"), tmp_path, DRAWN)
    assert set(statuses(said).values()) == {0}
    assert "at rest" in said["solve"].stdout


# --- a point of the coupler on its line, and 1e-12 beside it -------------------------------------


class Plate(FourBar, frozen=True):
    """A four-bar with a point C of its coupler, in the coupler's axes."""

    at: str = "60"
    bars: tuple[str, str, str, str] = ("1", "3", "2", "3")
    beside: tuple[str, str] = ("1", "0")
    ask: str = "velocity = ['C']\nacceleration = ['C']"

    def parts(self) -> str:
        x, y = self.beside
        coupler = f'[links.2]\nA = [0, 0]\nB = ["{self.bars[1]}", 0]\nC = ["{x}", "{y}"]\n'
        return super().parts().replace(f'[links.2]\nA-B = "{self.bars[1]}"\n', coupler)

    def found(self, origin: Moving) -> Motion:
        motion = super().found(origin)
        a, b = motion.points["A"], motion.points["B"]
        ratio = mpmath.mpc(*map(number, self.beside)) / number(self.bars[1])
        c = Moving(*(p + (q - p) * ratio for p, q in zip(a, b, strict=True)))
        return replace(motion, points={**motion.points, "C": c})


BESIDE = [f"{sign}1/{10**k}" for k in (3, 9, 15) for sign in ("", "-")]


@pytest.mark.parametrize("along", ["1", "-2", "3", "1/1000000000000"])
@pytest.mark.parametrize("aside", ["0", *BESIDE])
def test_a_point_on_its_line_or_beside_it(along, aside):
    """Two perpendiculars there are one line; the similar figure knows nothing of it."""
    solution = held(Plate(beside=(along, aside)))
    case = Plate(beside=(along, aside))
    true, bounds = case.truth().points["C"], case.truth().bounds()
    point = solution.points["C"]
    for found, exact, bound in zip(
        (point.position, point.velocity, point.acceleration), true, bounds, strict=True
    ):
        assert_near("C", found, exact, bound / 4)


def test_the_point_beside_the_line_moves_as_the_one_on_it():
    """1e-12 beside it differs by 1e-12 and not by a lost digit more."""
    on, off = (held(Plate(beside=("1", y))).points["C"] for y in ("0", "1/1000000000000"))
    for what in ("position", "velocity", "acceleration"):
        apart = abs(getattr(on, what) - getattr(off, what))
        assert 1e-13 < apart < 3e-12
