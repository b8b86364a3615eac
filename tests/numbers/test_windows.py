"""Windows of functions: narrower than the grid, and places close to their ends."""

import numpy as np
import pytest

from graphkin.numbers.roots import Windows, fits_beside, narrowed, roots

GRID = np.linspace(0, 10, 101)[None, :]


def parts(reaches):
    """The windows of one function on the grid, and their ends."""
    return narrowed(lambda _, place: reaches(place), Windows(np.array([0]), GRID))


@pytest.mark.parametrize("width", [1.0, 1e-2, 1e-4])
def test_a_window_narrower_than_the_grid_is_found_from_end_to_end(width):
    windows, ends = parts(lambda x: (width / 2) ** 2 - (x - 3.14) ** 2)
    expected = np.array([3.14 - width / 2, 3.14 + width / 2])
    assert ends.at == pytest.approx(expected, abs=1e-9 * max(width, 1e-3))
    assert (windows.places[0, [0, -1]] == ends.beside).all()
    inside = np.array([1, -1]) * (ends.beside - ends.at) / width
    assert ((inside > 0) & (inside < 1e-3)).all()


def test_what_can_be_drawn_everywhere_keeps_its_grid():
    windows, ends = parts(lambda x: x + 1)
    assert windows.places == pytest.approx(GRID)
    assert not ends.at.size


def test_what_can_be_drawn_nowhere_has_no_window():
    windows, ends = parts(lambda x: -x - 1)
    assert len(windows.owner) == len(ends.at) == 0


@pytest.mark.parametrize("far", [0, 1e-30, 1e-18, 1e-14, 1e-12, 1e-9, 1e-7])
@pytest.mark.parametrize("sign", [-1, 1])
@pytest.mark.parametrize("way", [-1, 1])
@pytest.mark.parametrize("rows", [1, 3])
def test_a_fit_beside_the_end_of_a_window_is_found_once_on_its_sign(far, sign, way, rows):
    """c + s·√τ + τ/5 on the signs s, τ before the end at 3.141: it vanishes at τ = far."""
    end = 3.141

    def missed(which, place, s):
        depth = way * (place - end)
        missing = sign * np.sqrt(far) + far / 5
        return s * np.sqrt(depth) + depth / 5 - missing

    windows, ends = parts(lambda x: way * (x - end))
    at, beside = (np.repeat(column, rows) for column in (ends.at, ends.beside))
    with np.errstate(invalid="ignore"):
        which, place, found, touching = fits_beside(missed, at, beside)
        _, open_place = roots(lambda _, x: missed(_, x, sign), windows.places)
    assert (which == np.arange(rows)).all()
    assert place == pytest.approx([end + way * far] * rows, abs=1e-13)
    assert far < 1e-17 or (found == sign).all()
    assert not touching.any() and not open_place.size


@pytest.mark.parametrize("missing", [0.1, 1.0])
def test_signs_that_do_not_meet_at_the_end_of_a_window_have_no_fit_between(missing):
    """Equal circles whose centres fall together: both crossings are there up to the end."""
    _, ends = parts(lambda x: x - 3.141)
    found = fits_beside(lambda _, x, s: s * (missing + (x - 3.141)), ends.at, ends.beside)
    assert not found[0].size
