"""Change points crossed on the right branch: parallelogram, kite, and a slot through its pivot."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from msgspec.structs import replace

from graphkin.motion.cycle import cycle
from graphkin.motion.pieces import MOST_BEYOND, others_of
from graphkin.scene.model import Closure
from graphkin.text.errors import ClosureError
from tests.stress.cases import LONG, FourBar, Lever, commanded, held, statuses

BAR = FourBar(bars=("2", "4", "2", "4"))
KITE = FourBar(bars=("3", "2", "2", "3"), at="50")
SLOT = Lever(bars=("1", "1", "3"), speed="2")
NEAR = [10.0**-k for k in range(1, 16)]


def side_at(degrees: float) -> str:
    """On which side of the way from A to O2 the parallelogram's B stands."""
    return "left" if 0 < degrees % 360 < 180 else "right"


@pytest.mark.parametrize("centre", [0, 180])
@pytest.mark.parametrize("way", [1, -1])
def test_a_parallelogram_beside_its_change_points_is_right_or_refused(centre, way):
    """From 0.1 to 1e-15 degrees of the position in line: the coupler shifts, the rocker turns."""
    answered = 0
    for near in NEAR:
        at = Fraction(centre) + way * Fraction(near)
        case = replace(BAR, at=str(at), side=side_at(float(at)))
        try:
            solution = held(case)
        except ClosureError as error:
            assert "dead point" in str(error)
            continue
        answered += 1
        true = case.truth()
        assert float(abs(true.links["2"].omega)) < 1e-60
        assert abs(solution.links["3"].omega - 1) <= 64 * 2.0**-52 / true.sine**2
    assert answered >= 5


def test_a_parallelogram_keeps_its_branch_through_forty_change_points():
    """The nearest place would lose it at 28 of them, the same side at all; the velocity at none."""
    found = cycle(replace(BAR, at="30").mechanism(), low=0.5, high=7200.5)
    a, b = (found.solution.points[name].position for name in "AB")
    assert np.allclose(b, a + 4, atol=1e-9)
    assert np.allclose(found.solution.links["3"].omega, 1, atol=1e-7)
    changes = [each for each in found.singulars if each.kind == "change"]
    assert len(changes) == 40


def test_the_other_branch_stays_the_other_branch():
    found = cycle(replace(BAR, at="30", side="right").mechanism())
    assert (found.solution.links["3"].omega < 0).all()
    held(replace(BAR, at="30", side="right"))


@pytest.mark.parametrize("side", ["left", "right"])
def test_a_kite_beside_the_place_where_its_crank_lies_on_its_frame(side):
    """A comes to stand on O2; B stays off the line, so that its velocity is finite."""
    answered = 0
    for near in NEAR:
        case = replace(KITE, at=str(Fraction(near)), side=side)
        try:
            held(case)
            answered += 1
        except ClosureError as error:
            assert "dead point" in str(error) or "falls on" in str(error)
    assert answered >= 6


def test_a_kite_exactly_there_says_that_its_arcs_are_one(tmp_path):
    """Two arcs of one radius about one point: any place would do, and none is picked."""
    folded = replace(KITE, at="0")
    with pytest.raises(ClosureError, match="A falls on O2, and AB is as long as O2B") as raised:
        folded.mechanism().solve()
    assert "change point" in str(raised.value)
    said = commanded(folded, tmp_path, LONG)
    assert {statuses(said)[name] for name in ("check", "solve", "json", "sheet")} == {2}
    assert statuses(said)["cycle"] == 0


@pytest.mark.parametrize("at", ["0", "180"])
def test_a_parallelogram_in_line_has_no_velocity_and_says_so(at, tmp_path):
    """At the change point itself the driver's speed determines no other."""
    said = commanded(replace(BAR, at=at), tmp_path, LONG)
    codes = statuses(said)
    assert {codes[name] for name in ("check", "solve", "json", "sheet")} == {2}
    assert "AB and O2B are" in said["solve"].stderr
    assert codes["cycle"] == 0


# --- a slot through its pivot --------------------------------------------------------------------


def test_beside_the_pivot_of_its_slot_a_lever_is_right_or_refused():
    """Crank as long as the frame: the lever turns half as fast, exactly, on either side."""
    answered = 0
    for near in NEAR:
        for at, way in ((Fraction(near), "forward"), (-Fraction(near), "forward")):
            case = replace(SLOT, at=str(at), way=way)
            try:
                solution = held(case)
            except ClosureError as error:
                assert "A falls on P" in str(error)
                continue
            answered += 1
            # that near the pins differ in few digits: the margin, a length, says so
            assert solution.margin == pytest.approx(abs(np.radians(float(at))), rel=1e-3)
            assert abs(solution.links["3"].omega - 1) < 64 * 2.0**-52 / solution.margin**2
    assert answered >= 12


@pytest.mark.parametrize("at", ["60", "0", "1/10**9", "1/10**4", "-1/10**4"])
def test_a_slot_passes_through_its_pivot_as_it_moves(at):
    """The lever turns on: the block comes to the other side of the pivot, another closure.

    The next time it comes back, so that the crank has a circle of two turns.
    """
    found = cycle(replace(SLOT, at=at).mechanism())
    assert [(each.kind, each.pin, each.lines) for each in found.singulars] == [
        ("change", "link 3", "A on P")
    ] * 2
    assert [each.at for each in found.singulars] == pytest.approx([0, 360], abs=1e-9)
    assert np.allclose(found.solution.links["3"].omega, 1, atol=1e-7)
    assert found.path.returns
    assert found.path.turns == 2
    assert found.witnessed.agrees.all()


@pytest.mark.parametrize(("at", "expected"), [("0", 2), ("1/10**15", 2), ("1/10**4", 1), ("1", 0)])
def test_the_commands_on_a_pin_that_falls_on_the_pivot_of_its_slot(at, expected, tmp_path):
    said = commanded(replace(SLOT, at=at), tmp_path, LONG)
    codes = statuses(said)
    assert {codes[name] for name in ("check", "solve", "json", "sheet")} == {expected}
    assert codes["cycle"] == 0
    if expected:
        assert "falls on P" in said["solve"].stderr


def test_a_numbered_closure_may_change_to_every_other_number():
    others = [branch.number for branch in others_of(Closure(3))]
    assert sorted([*others, 3]) == [*range(1, MOST_BEYOND + 1)]
