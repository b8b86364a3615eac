"""Roots of several functions of as many numbers: in doubles on cells, then in other kinds."""

import numpy as np
import pytest

from graphkin.numbers.common_roots import (
    STEP,
    Cells,
    by_newton,
    by_newton_arrays,
    common_roots,
    determinant,
    proved_together,
    roots_beside,
    solutions,
    solved,
)
from graphkin.numbers.kinds import ball_kind, decimal_kind, in_doubles

SIDE = 0.25
"""Side of a cell."""


def cells(low, high):
    """Square cells over a square, all of row 0, and half their sides."""
    middles = np.arange(low + SIDE / 2, high, SIDE)
    x, y = (each.ravel() for each in np.meshgrid(middles, middles))
    return Cells(np.zeros(x.size, dtype=int), np.column_stack([x, y])), np.full(2, SIDE / 2)


def places(missed, edges=(), low=-2.0, high=2.0, ranges=(4.0, 4.0)):
    """Where two functions vanish in a square: each place once, in order, with its row."""

    def looked(row, share):
        reaches = [reach(row, share) for reach, _ in edges]
        return [*missed(row, share).T], reaches

    with np.errstate(all="ignore"):
        row, share = common_roots(missed, looked, edges, *cells(low, high), np.tile(ranges, (2, 1)))
    return sorted(
        {(int(k), round(x, 9), round(y, 9)) for k, (x, y) in zip(row, share, strict=True)}
    )


def test_an_ellipse_and_a_parabola_cross_in_four_points():
    """x²/4 + y² = 1 and y = x² - 3/2: x⁴ - 11/4·x² + 5/4 = 0."""

    def missed(row, share):
        x, y = share.T
        return np.stack([x * x / 4 + y * y - 1, y - x * x + 1.5], axis=1)

    found = places(missed)
    squares = [(11 + way * 41**0.5) / 8 for way in (-1, 1)]
    right = sorted((0, way * r**0.5, r - 1.5) for r in squares for way in (-1, 1))
    assert np.array(found) == pytest.approx(np.array(right), abs=1e-8)


def test_from_a_start_beside_it_a_crossing_is_reached_and_none_where_there_is_none():
    """Of x² + y² = r² and y = x, beside (1, 1): x = r/√2 for r² = 2 and 2.2; no real x for -1."""
    squares = np.array([2.0, 2.2, -1.0])

    def missed(row, share):
        x, y = share.T
        return np.stack([x * x + y * y - squares[row], y - x], axis=1)

    found = roots_beside(missed, np.array([[1.05, 0.9]] * 3))
    right = [[(square / 2) ** 0.5] * 2 for square in squares[:2]]
    assert found[:2] == pytest.approx(np.array(right), abs=1e-12)
    assert np.isnan(found[2]).all()


def test_a_root_is_reached_where_the_misfits_bend_within_a_difference_for_slopes():
    """x - 1.6·x² + 0.65·x³ = y = 0, x in the difference: 1.6² < 4·0.65, so x = 0 alone."""

    def missed(row, share):
        x, y = share.T / STEP
        return np.stack([x - 1.6 * x**2 + 0.65 * x**3 - y, y], axis=1)

    found = roots_beside(missed, STEP * np.array([[0.1, 0.2], [-0.1, 0.1]]))
    assert found == pytest.approx(np.zeros((2, 2)), abs=1e-9)


def test_a_step_that_swings_about_a_root_beside_an_edge_is_no_limit():
    """√x + 6000·x = √r + 6000·r with √r = 5e-5: slopes by differences are 2.3 times too small.

    Each step is then 1.3 times the one before it, on the other side of the root.
    """
    root = (5e-5) ** 2

    def missed(row, share):
        return np.sqrt(share) - 5e-5 + 6000 * (share - root)

    starts = root + np.array([[5e-11], [-3e-11], [1e-11]])
    with np.errstate(all="ignore"):
        found = roots_beside(missed, starts)[:, 0]
    assert (np.isnan(found) | (abs(found - root) < 1e-14)).all()


@pytest.mark.parametrize("far", [1e-4, 1e-8])
def test_a_root_beside_a_flat_edge_is_found_on_its_sign(far):
    """s·√(1 - x) = √far and y = x/2: x = 1 - far on row 0 (s = 1) alone, not on 1 (s = -1)."""

    def missed(row, share):
        x, y = share.T
        sign = np.where(row & 1, -1.0, 1.0)
        return np.stack([sign * np.sqrt(1 - x) - far**0.5, y - x / 2], axis=1)

    found = places(missed, [(lambda row, share: 1 - share[:, 0], 1)])
    assert [each[0] for each in found] == [0]
    assert found[0][1:] == pytest.approx((1 - far, (1 - far) / 2), abs=1e-9)


def test_equations_without_an_inverse_have_no_solution():
    slopes = np.array([[[2.0, 1.0], [1.0, 3.0]], [[1.0, 2.0], [2.0, 4.0]], [[np.nan, 0], [0, 1]]])
    found = solutions(slopes, np.tile([3.0, 5.0], (3, 1)))
    assert slopes[0] @ found[0] == pytest.approx([3, 5])
    assert np.isnan(found[1:]).all()


# --- in other kinds ------------------------------------------------------------------------------


def roots_of_two_and_three(tried):
    """x² + y² = 5 and x²·y² = 6: x = √2 and y = √3, among others."""
    x, y = tried
    return [x * x + y * y - 5, x * x * y * y - 6]


START = [1.4142135623730951, 1.7320508075688772]


def test_decimals_have_all_digits_after_newton():
    kind = decimal_kind(50)
    found = by_newton(roots_of_two_and_three, [kind.number(each) for each in START])
    for value, square in zip(found, (2, 3), strict=True):
        assert abs(value * value - square) < 1e-48


def test_long_doubles_gain_the_digits_that_doubles_lack():
    start = [np.array([each], dtype=np.longdouble) for each in START]
    found = by_newton_arrays(roots_of_two_and_three, start)
    for value, square in zip(found, (2, 3), strict=True):
        assert abs(in_doubles(value * value - square)) < 8 * float(np.finfo(np.longdouble).eps)


def test_miranda_s_theorem_proves_a_root_and_no_other():
    from flint import arb

    with ball_kind(200).working():
        near = by_newton(roots_of_two_and_three, [arb(each) for each in START])
        for value, square in zip(
            proved_together(roots_of_two_and_three, roots_of_two_and_three, near),
            (2, 3),
            strict=True,
        ):
            assert value.contains(arb(square).sqrt().mid()) and value.rad() < arb("1e-50")

    def never(tried):
        x, y = tried
        return [x * x + 1, y - x]

    with ball_kind(200).working(), pytest.raises(ValueError, match="ball"):
        proved_together(never, never, [arb(1), arb(1)])


def test_where_curves_only_come_near_one_another_nothing_is_proved():
    """x² + y² = 5 touches x²·y² = 25/4 at x = y, and misses what is more by a ten-millionth."""
    from flint import arb

    def apart(tried):
        x, y = tried
        return [x * x + y * y - 5, x * x * y * y - arb("6.2500001")]

    with ball_kind(200).working(), pytest.raises(ValueError, match="whether the group closes"):
        proved_together(apart, apart, [arb("1.58"), arb("1.5823")])


def test_cramers_rule():
    rows, right = [[2, 1, 0], [1, 3, 1], [0, 1, 4]], [1, 2, 3]
    assert determinant(rows) == 18
    found = solved(rows, right)
    assert np.allclose(np.array(rows) @ np.array(found), right)
