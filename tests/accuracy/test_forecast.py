"""The error foretold without drawing, against twenty thousand drawings of everything shipped."""

from __future__ import annotations

from math import sqrt

import numpy as np
import pytest

from graphkin.accuracy.pencil import RADIAL, Pencil, forecast, original, percentile, simulated
from graphkin.documents.sheet_documents import scales
from tests.accuracy.originals import D_AWAY, pump, scene
from tests.chance.checking import case
from tests.chosen import EVERY, HALVES, STUDENTS
from tests.mechanisms import SHIPPED

DRAWINGS = 20_000
FACTOR = 1.5
"""Every error foretold lies within this factor of the simulated 95th percentile."""


def outside(exact, pencil: Pencil, drawings: int) -> list[str]:
    """The answers whose error is not foretold within the factor."""
    found, many = forecast(exact, pencil), simulated(exact, pencil, drawings)
    assert found.expected
    wrong = []
    for each in found.expected:
        target = each.answer.target
        there = many.error(target)
        if not (each.error == there or there / FACTOR < each.error < there * FACTOR):
            wrong.append(f"{target}: foretold {each.error:.3g}, drawn {there:.3g}")
    return wrong


@pytest.mark.parametrize("n", STUDENTS)
@pytest.mark.parametrize("lab", SHIPPED)
def test_every_answer_of_every_shipped_lab_is_foretold(lab, n):
    assert not outside(pump(n, lab), Pencil(0.5), DRAWINGS)


@pytest.mark.parametrize("name", HALVES[0])
def test_so_it_is_in_every_scene_that_comes_with_it(name):
    exact = scene(name)
    if exact.order and forecast(exact, Pencil()).expected:
        assert not outside(exact, Pencil(), 4000)


@pytest.mark.parametrize("seed", [7, 19, 27, 34] if EVERY else [7, 19, 34])
def test_so_it_is_where_errors_do_not_add_or_drawings_do_not_close(seed):
    """Mechanisms made at random that single errors alone foretell badly."""
    made = case(seed)
    assert made is not None
    exact = original(made.mechanism, scales(made.mechanism))
    assert not outside(exact, Pencil(), 6000)


def test_drawings_on_a_grid_are_foretold_jointly():
    on_grid = Pencil(0.4, grid=0.5)
    assert not outside(pump(), on_grid, DRAWINGS)
    free = forecast(pump(), Pencil(0.4))
    assert forecast(pump(), on_grid)[D_AWAY].error > 1.05 * free[D_AWAY].error


def test_where_errors_do_not_just_add_up_joint_drawings_are_made():
    """The pole of the plate of student 1 is where two rays cross at 10 degrees."""
    pole = ("pole", "3")
    assert not forecast(pump(1), Pencil(0.1))[pole].joint
    coarse = forecast(pump(1), Pencil(2.0))[pole]
    assert coarse.joint
    single = forecast(pump(1), Pencil(0.1))[pole].error * 20
    assert coarse.error > 1.5 * single


def test_a_perfect_pencil_is_foretold_to_make_no_error():
    for each in forecast(pump(), Pencil(0.0)).expected:
        size = max(abs(each.answer.value), each.answer.millimetre)
        assert each.error <= 1e-12 * size


def test_shares_of_the_sources_add_up_and_name_a_mark():
    exact = pump()
    for each in forecast(exact, Pencil()).expected:
        assert sum(each.sources.values()) == pytest.approx(1)
        assert each.heaviest in exact.marks
        assert each.sources[each.heaviest] == max(each.sources.values())


def test_the_heaviest_mark_is_that_without_which_the_answer_gains_most():
    exact = pump()
    found = forecast(exact, Pencil(0.05))[D_AWAY]
    streams = {n: mark for n, mark in exact.marks.items() if n != found.heaviest}
    without = type(exact)(exact.trace, exact.paper, exact.targets, exact.triangles)
    without.__dict__["marks"] = streams
    without.__dict__["order"] = exact.order
    left = forecast(without, Pencil(0.05))[D_AWAY].error
    share = found.sources[found.heaviest]
    assert left / found.error == pytest.approx(sqrt(1 - share), rel=0.05)


def test_errors_on_paper_are_those_of_the_plan_in_which_they_are_read():
    found, paper = forecast(pump(), Pencil()), pump().paper
    millimetres = {
        ("velocity", "D"): paper.velocities / 1000,
        ("acceleration", "D"): paper.accelerations / 1000,
        ("omega", "3"): paper.velocities / 1000 / 0.4,
        ("epsilon", "4"): paper.accelerations / 1000 / 0.2,
        ("pole", "3"): paper.mechanism / 1000,
    }
    for target, mm in millimetres.items():
        assert found[target].millimetres == pytest.approx(found[target].error / mm)


# --- the percentile of a Gaussian vector ---------------------------------------------------------


def test_of_an_even_spread_in_the_plane_the_percentile_is_that_of_rayleigh():
    assert percentile(np.zeros(2), 4 * np.eye(2)) == pytest.approx(2 * RADIAL, rel=0.005)


@pytest.mark.parametrize("seed", range(8))
def test_of_any_gaussian_vector_it_is_near_that_of_many_samples(seed):
    rng = np.random.default_rng(seed)
    root = rng.standard_normal((2, 2)) * [1, 10.0 ** -rng.uniform(0, 3)]
    mean = rng.standard_normal(2) * rng.uniform(0, 2)
    samples = mean + rng.standard_normal((100_000, 2)) @ root.T
    there = np.percentile(np.linalg.norm(samples, axis=1), 95)
    assert percentile(mean, root @ root.T) == pytest.approx(there, rel=0.06)
