"""Roots of many functions at once: simple ones, pairs close together, poles, ends."""

import numpy as np
import pytest

from graphkin.numbers.roots import closed_in, roots


def found(function, low=0.0, high=10.0, places=101):
    """The roots of one function on a grid."""
    grid = np.linspace(low, high, places)[None, :]
    with np.errstate(all="ignore"):
        which, place = roots(lambda _, x: function(x), grid)
    assert not which.any()
    return np.sort(place)


def test_simple_roots_are_found_to_all_digits():
    assert found(np.sin, 0.1, 10) == pytest.approx([np.pi, 2 * np.pi, 3 * np.pi], rel=4e-16)


@pytest.mark.parametrize("gap", [1e-1, 1e-3, 1e-5, 1e-7])
def test_two_roots_close_together_are_both_found(gap):
    """A parabola that dips below zero between two places of the grid."""
    middle = 3.14
    place = found(lambda x: (x - middle) ** 2 - (gap / 2) ** 2)
    assert place == pytest.approx([middle - gap / 2, middle + gap / 2], abs=1e-9)


@pytest.mark.parametrize("gap", [1e-7, 1e-4])
@pytest.mark.parametrize("power", [-60, 60])
def test_a_function_so_many_times_as_large_has_the_same_roots_to_the_last_bit(power, gap):
    """By a power of two, which rounds nothing."""

    def dip(x):
        return np.cos(gap) - np.cos(x - 3.14)

    assert found(dip).size == 4
    assert found(lambda x: 2.0**power * dip(x)).tolist() == found(dip).tolist()


def test_two_roots_are_two_where_rounding_moves_the_sides_of_a_dip():
    """A place that rounding alone puts below zero beside one root does not part the two."""
    grain = 2.0**-40
    for gap in np.linspace(5e-6, 1e-5, 200):
        place = found(lambda x, gap=gap: np.rint(((x - 3.14) ** 2 - gap**2 / 4) / grain) * grain)
        assert place == pytest.approx([3.14 - gap / 2, 3.14 + gap / 2], abs=gap / 4)


@pytest.mark.parametrize("miss", [1e-3, 1e-9])
def test_a_function_that_only_comes_near_zero_has_no_root(miss):
    assert found(lambda x: (x - 3.14) ** 2 + miss).size == 0


def test_a_pole_is_no_root():
    """1/(x - a) changes its sign at a; its only root here is that of the other factor."""
    assert found(lambda x: (x - 7.03) / (x - 3.14)) == pytest.approx([7.03], rel=1e-14)


@pytest.mark.parametrize("distance", [3e-2, 1e-5, 1e-9])
def test_a_root_between_the_last_place_and_a_break_is_found(distance):
    """sqrt(5.03 - x) - sqrt(d) is not defined beyond 5.03 and vanishes d before it."""
    place = found(lambda x: np.sqrt(5.03 - x) - np.sqrt(distance))
    assert place == pytest.approx([5.03 - distance], abs=1e-14)


def test_many_functions_keep_their_own_roots():
    shifts = np.array([0.5, 2.25, 9.75])
    grid = np.broadcast_to(np.linspace(0, 10, 41), (3, 41))
    which, place = roots(lambda owner, x: x - shifts[owner], grid)
    assert place[np.argsort(which)] == pytest.approx(shifts, rel=1e-15)


def test_a_root_on_a_place_of_the_grid_counts_once():
    assert found(lambda x: x - 5.0) == [5.0]


def test_an_interval_without_a_root_gives_none():
    """A jump across zero, which is no root either."""
    place = closed_in(
        lambda _, x: np.where(x < 0.3, -1.0, 2.0), np.array([0]), np.array([0.0]), np.array([1.0])
    )
    assert np.isnan(place).all()


def test_a_root_just_before_a_jump_is_found_to_all_digits():
    """As where a bar lies half a turn from where it counts: a wheel jumps by its rim's length."""
    root = 3.14
    place = found(lambda x: np.where(x < root + 1e-9, 55 * (x - root), 231.0))
    assert place == pytest.approx([root], abs=4e-15)


def test_a_jump_across_zero_is_no_root():
    assert found(lambda x: np.where(x < 3.14, -1.0, 231.0)).size == 0
