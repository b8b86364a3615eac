"""Where motions end and touch, found on functions whose places are known."""

from __future__ import annotations

import numpy as np
import pytest

from graphkin.motion.ends import (
    AROUND,
    crossings_of_zero,
    last_closing,
    least_square,
    touching,
)

PLACES = (-1.3, -0.4, 0.0, 0.7, 1.4)


@pytest.mark.parametrize("at", PLACES)
def test_a_margin_touches_zero_where_it_does(at):
    """Of the seventh degree on either side, as eight samples tell it."""
    margins = np.abs((AROUND - at) * (3 + AROUND + AROUND**6 / 1e3))
    assert touching(AROUND, margins) == pytest.approx(at, abs=1e-9)


def test_a_margin_without_a_place_near_by_touches_nowhere():
    assert touching(AROUND, np.sign(AROUND) * (AROUND + 2)) is None


@pytest.mark.parametrize("at", PLACES)
def test_the_least_square_is_that_of_the_parabola_and_where_it_has_it(at):
    margins = np.sqrt(0.04 + 3 * (AROUND - at) ** 2)
    assert least_square(AROUND, margins) == pytest.approx((at, 0.04), abs=1e-9)


def test_a_square_has_no_least_value_beyond_its_samples_or_where_one_is_missing():
    assert least_square(AROUND, np.sqrt(AROUND + 9)) is None
    assert least_square(AROUND, np.sqrt(1 + (AROUND - 5) ** 2)) is None
    assert least_square(AROUND, np.where(AROUND > 4, np.nan, np.abs(AROUND))) is None


def test_the_last_place_that_closes_is_found_to_the_last_bit():
    found = last_closing(lambda u: u * u <= 2, 1, 2)
    assert found * found <= 2 < np.nextafter(found, 2) ** 2
    assert last_closing(lambda u: u >= -0.1, 1, -1) == -0.1


def test_changes_of_sign_are_found_in_all_brackets_at_once_and_as_closely_as_asked():
    low, high, roots = np.array([0.0, 1, -3]), np.array([1.0, 2, -2]), np.array([0.3, 1.5, -2.25])
    found = crossings_of_zero(lambda u: (u - roots) * [1, -1, 2], low, high)
    assert np.abs(found - roots).max() <= 1e-15
    coarse = crossings_of_zero(lambda u: u - roots, low, high, enough=0.1)
    assert 1e-4 < np.abs(coarse - roots)[0] < 0.1


def test_a_change_of_sign_is_found_beside_places_that_tell_nothing():
    roots = np.array([0.5, 0.5 + 1e-9, 0.3])

    def blind(u):
        return np.where(np.abs(u - 0.5) < 1e-7, np.nan, u - roots)

    found = crossings_of_zero(blind, np.zeros(3), np.ones(3))
    assert np.abs(found - roots)[:2].max() < 1e-6
    assert found[2] == pytest.approx(0.3, abs=1e-15)
    assert np.isfinite(blind(found)).all()
