"""The pump of the laboratory text by the loops alone: many numbers at once as each by itself."""

from __future__ import annotations

import numpy as np

from tests.scene_files import scene_text


def digits(value):
    """Half a unit of the last printed digit."""
    return 0.51 * 10.0 ** -len(repr(value).partition(".")[2])


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
