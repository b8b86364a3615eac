"""Change points: the motion goes on as its velocity leads, whatever the signs say."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from graphkin.mechanism import load
from graphkin.motion.cycle import columns_at, cycle
from tests.motion.linkages import four_bar

SCENES = Path(__file__).parent / "scenes"


@pytest.mark.parametrize(("crank", "frame"), [(2, 4), (4, 2), (1, 7.3)])
@pytest.mark.parametrize("angle", [0, 30, 180, 200, 359])
def test_a_parallelogram_stays_one_through_both_change_points(crank, frame, angle):
    side = "left" if 0 <= angle < 180 else "right"
    found = cycle(four_bar(crank, frame, crank, frame, angle=angle, side=side))
    a, b = (found.solution.points[name].position for name in "AB")
    assert len(found.at) == 358
    assert list(found.left_out) == [0, 180]
    assert np.allclose(b, a + frame, atol=1e-9 * frame)
    assert np.allclose(found.solution.links["2"].omega, 0, atol=1e-9)
    assert np.allclose(found.solution.links["3"].omega, 1, atol=1e-9)
    assert [each.at for each in found.singulars] == pytest.approx([0, 180], abs=6e-11)
    assert {each.kind for each in found.singulars} == {"change"}


def test_each_piece_has_constant_signs_and_says_them():
    found = cycle(four_bar(2, 4, 2, 4))
    ends = [end.at for piece in found.pieces for end in (piece.low, piece.high)]
    assert ends == pytest.approx([0, 180, 180, 360], abs=6e-11)
    assert [piece.branches["B"].side for piece in found.pieces] == [1, -1]
    assert found.path.returns
    sides = np.where(found.piece == 1, 1, -1)
    a, b = (found.solution.points[name].position for name in "AB")
    assert np.all(np.sign(((4 - a).conj() * (b - a)).imag) == sides)


def test_the_antiparallelogram_turns_against_its_crank_all_the_way():
    found = cycle(four_bar(2, 4, 2, 4, side="right"))
    omega = found.solution.links["3"].omega
    assert np.all(omega < 0)
    a, b = (found.solution.points[name].position for name in "AB")
    assert np.allclose(abs(b - a), 4)
    assert np.allclose(abs(b - 4), 2)
    # contra-parallelogram: the halves of the angles keep the ratio (g - a)/(g + a)
    crank, rocker = np.angle(a) / 2, np.angle(b - 4) / 2
    assert np.allclose(np.tan(rocker) * np.tan(crank) ** -1, np.tan(rocker[0]) / np.tan(crank[0]))
    assert abs(np.tan(rocker[0]) / np.tan(crank[0])) == pytest.approx(3.0)


def test_a_kite_goes_through_the_place_where_its_crank_lies_on_the_frame():
    # crank = frame: A passes through O2; coupler = rocker, so B stands off the frame's line
    found = cycle(four_bar(3, 2, 2, 3, angle=50))
    (change,) = (each for each in found.singulars if each.kind == "change")
    assert change.at == pytest.approx(0, abs=1e-9)
    assert change.lines == "A on O2"
    b = found.along(np.linspace(-5, 5, 400)).solution.points["B"].position
    assert np.abs(np.diff(b)).max() < 0.01
    at, rate = np.array([-1e-3, 1e-3]), ("omega", "3")
    omega = columns_at(found.sweep, found.path, at, [rate], geometric=True).columns[rate]
    assert omega[0] == pytest.approx(omega[1], rel=1e-4)


def test_the_pins_of_a_cycloidal_drive_turn_its_output_steadily():
    """Disc and output turn 1/(N - 1) backwards, N = 11 teeth of the ring (Kudrijavcev, Planetary
    gear trains); hole, pin and shaft come in line twice in a turn, and pins go on beside holes."""
    found = cycle(load(SCENES / "cycloidal-drive.toml"))
    changes = [each.at for each in found.singulars]
    assert found.path.turns == 10
    assert changes == pytest.approx(np.arange(22) * 360 / 2.2, abs=1e-6)
    assert found.at[-1] == 3599
    points, angle = found.solution.points, np.radians(found.at)
    assert np.allclose(found.solution.links["output"].omega[1:], -150 * np.pi / 30)
    assert np.allclose(points["Q"].position[1:], 0.03 * np.exp(-0.1j * angle[1:]))


@pytest.mark.parametrize("off", [1e-3, 1e-5])
def test_beside_a_change_point_there_is_none(off):
    # a rocker a little longer: the mechanism keeps its side, and B swings round near 180 degrees
    found = cycle(four_bar(2, 4, 2 + off, 4, angle=90))
    assert not found.singulars
    assert found.path.whole
    assert len(found.pieces) == 1
