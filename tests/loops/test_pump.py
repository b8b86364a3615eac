"""The pump of the laboratory text: the printed digits, every student number, another route."""

from __future__ import annotations

import mpmath
import numpy as np
import pytest

from tests.chosen import STUDENTS
from tests.scene_files import scene_text

CASES = {
    "pump": {
        "v": -3.826845090,
        "a": -473.3382916,
        "omega": {"2": 6.170899, "3": 27.647074, "4": -30.749516},
        "epsilon": {"2": 467.7126, "3": -227.1911, "4": 656.9140},
    },
    "pump-collinear": {
        "v": -6.924166867,
        "a": -232.2322399,
        "omega": {"4": -21.6973},
        "epsilon": {"4": 813.359},
    },
}


def digits(value):
    """Half a unit of the last printed digit."""
    return 0.51 * 10.0 ** -len(repr(value).partition(".")[2])


@pytest.mark.parametrize("name", CASES)
def test_printed_digits_from_rough_positions(name, sheet, solved, pump_start):
    found = solved(sheet(name, n=7), **pump_start)
    motion, case = found.motion, CASES[name]
    _, velocity, acceleration = motion.point("D")
    assert velocity[0].real == pytest.approx(case["v"], abs=1e-8)
    assert acceleration[0].real == pytest.approx(case["a"], abs=1e-6)
    assert velocity[0].imag == acceleration[0].imag == 0
    for quantity, array in (("omega", motion.omega), ("epsilon", motion.epsilon)):
        for link, printed in case[quantity].items():
            assert array[0, motion.index[link]] == pytest.approx(printed, abs=digits(printed))
    assert 0 < found.report.residual[0] < 0.2
    assert found.report.remains[0] < 1e-15


def test_acceleration_poles_have_no_acceleration(sheet, solved, pump_start):
    motion = solved(sheet("pump", n=7), **pump_start).motion
    for link, pole in (("3", -0.285432 - 0.051933j), ("4", -0.005390 - 0.234573j)):
        left = motion.carried(link, np.array([pole])).acceleration
        assert abs(left[0]) < 1e-6 * 1e3


def circles(p, r, q, s, side):
    """Crossing of two circles on the side (+1 left) of the way from p to q."""
    d = abs(q - p)
    along = (r**2 - s**2 + d**2) / (2 * d)
    return p + (along + side * 1j * mpmath.sqrt(r**2 - along**2)) * (q - p) / d


def pump_by_circles(q, collinear):
    """Positions in 40 digits by circles; BC = 25 cm or C at the middle of AB."""
    a = mpmath.mpf(3) / 10 * mpmath.expj(q)
    o2 = mpmath.mpc(0, -mpmath.mpf(3) / 10)
    b = circles(a, mpmath.mpf(4) / 10, o2, mpmath.mpf(3) / 10, -1)
    c = (a + b) / 2 if collinear else circles(a, mpmath.mpf(1) / 5, b, mpmath.mpf(1) / 4, 1)
    d = mpmath.re(c) + mpmath.sqrt(mpmath.mpf(1) / 25 - mpmath.im(c) ** 2)
    return {"A": a, "B": b, "C": c, "D": mpmath.mpc(d)}


@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("n", STUDENTS)
def test_every_student_number_against_central_differences(name, n, sheet, solved):
    with mpmath.workdps(40):
        omega = (300 + 10 * n) * mpmath.pi / 30
        q = (30 + 2 * n) * mpmath.pi / 180
        h = mpmath.mpf(10) ** -12
        before, here, after = (
            pump_by_circles(q + k * h * omega, name == "pump-collinear") for k in (-1, 0, 1)
        )
        velocity = {p: complex((after[p] - before[p]) / (2 * h)) for p in here}
        acceleration = {p: complex((after[p] - 2 * here[p] + before[p]) / h**2) for p in here}
    start = {p: complex(z) + 0.007 - 0.007j for p, z in here.items()}
    motion = solved(sheet(name, n=n), **start).motion
    for p, z in here.items():
        found = motion.point(p)
        assert abs(found.place[0] - complex(z)) < 1e-15
        assert abs(found.velocity[0] - velocity[p]) < 1e-13 * 20
        assert abs(found.acceleration[0] - acceleration[p]) < 1e-12 * 1e3


def test_batch_equals_scalars(sheet, solved, pump_start):
    n = np.arange(1.0, 31.0)
    batch = solved(sheet("pump"), {"n": n}, **pump_start)
    assert batch.report.good.all()
    for i in range(30):
        one = solved(sheet("pump", n=i + 1), **pump_start).motion
        for rows, row in zip(batch.motion.points, one.points, strict=True):
            np.testing.assert_allclose(rows[i], row[0], rtol=1e-12, atol=1e-12)
        np.testing.assert_allclose(batch.motion.epsilon[i], one.epsilon[0], rtol=1e-12)


def test_a_batch_masks_what_does_not_assemble(read, solved):
    scene = read(scene_text("loops/batch"))
    found = solved(scene, {"c": np.array([2.0, 0.5, 3.0])}, A=1j, B=2 + 0j)
    assert found.report.good.tolist() == [True, False, True]
    assert np.isnan(found.motion.point("B").velocity).tolist() == [False, True, False]
