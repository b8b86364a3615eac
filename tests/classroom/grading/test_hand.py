"""The hand that draws by formulas of its own agrees with the key, and is off as it says."""

from __future__ import annotations

import numpy as np
import pytest

from tests.classroom.grading import hand
from tests.classroom.grading.students import marker_of


@pytest.mark.parametrize("lab", hand.DRAW)
def test_without_errors_it_is_the_key(lab):
    """All fields of all variants; what is nearly zero to a thousandth of a millimetre."""
    for n in range(1, 31):
        standard = marker_of(lab, n).standard
        scales = standard.scales
        found = hand.key(lab, hand.data(lab, n), (scales.kL, scales.kv, scales.ka))
        assert set(found) == set(standard.key)
        for field, right in standard.key.items():
            tolerance = standard.tolerance.get(field)
            near = 1e-5 * tolerance.value if tolerance is not None else 0
            told = found[field]
            signed = standard.by_field[field].vector or told * right > 0 or abs(right) < near
            assert signed, (n, field)
            assert told == pytest.approx(right, rel=1e-9, abs=near), (n, field)


@pytest.mark.parametrize("lab", hand.DRAW)
def test_errors_grow_with_the_hand(lab):
    """The error of the ruler alone is that of the readings; a hand twice as bad, twice as far."""
    scales = marker_of(lab, 7).standard.scales
    given, sheet = hand.data(lab, 7), (scales.kL, scales.kv, scales.ka)
    right = hand.key(lab, given, sheet)
    field = {"pump": "v_D_mm", "slotted-lever": "v_A3_mm"}.get(lab, "v_C_mm")

    def spread(**how: float) -> float:
        rng = np.random.default_rng(5)
        many = [hand.drawn(lab, given, sheet, rng, **how)[field] for _ in range(400)]
        return float(np.std(np.array(many) - right[field]))

    assert spread(ruler=0.2) == pytest.approx(0.2, rel=0.15)
    assert spread(sigma=0.2) == pytest.approx(2 * spread(sigma=0.1), rel=0.1)
    assert spread(sigma=0.1) > 0.05
