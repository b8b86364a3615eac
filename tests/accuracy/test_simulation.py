"""Drawings by the thousand: exact without errors, always the same, and larger paper helps."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace

from graphkin.accuracy.pencil import (
    RADIAL,
    Paper,
    Pencil,
    PencilMark,
    followed,
    read_off,
    redrawn,
    simulated,
)
from graphkin.construction.core.program import Plane
from graphkin.construction.higher_class.closure_solver import closer_of
from tests.accuracy.originals import pump, scene
from tests.chosen import HALVES

COUNT = 2000


def enlarged(exact, times: float):
    """The same drawing on paper so many times larger."""
    paper = exact.paper
    return replace(
        exact,
        paper=Paper(paper.mechanism / times, paper.velocities / times, paper.accelerations / times),
    )


@pytest.mark.parametrize("name", HALVES[1])
def test_a_perfect_pencil_gives_the_exact_answers_of_every_scene(name):
    many = simulated(scene(name), Pencil(0.0), 2)
    for answer in many.answers:
        size = max(abs(answer.value), 1e-6 * answer.millimetre, 1e-9)
        assert many[answer.target] == pytest.approx(answer.value, abs=1e-9 * size + 1e-12)


@pytest.mark.parametrize("n", [1, 7, 20, 30])
def test_a_perfect_pencil_gives_the_pump_to_rounding(n):
    many = simulated(pump(n), Pencil(0.0), 3)
    for answer in many.answers:
        assert many[answer.target] == pytest.approx(answer.value, rel=1e-12)


def test_errors_grow_in_proportion_to_a_small_pencil():
    small, double = (simulated(pump(), Pencil(p), COUNT) for p in (0.02, 0.04))
    for answer in small.answers:
        grown = double.error(answer.target) / small.error(answer.target)
        assert grown == pytest.approx(2, rel=0.02)


def test_paper_twice_as_large_halves_what_marks_do():
    exact, marks_only = pump(), Pencil(0.04, line=0.0)
    small, large = (simulated(each, marks_only, COUNT) for each in (exact, enlarged(exact, 2)))
    for answer in small.answers:
        shrunk = small.error(answer.target) / large.error(answer.target)
        assert shrunk == pytest.approx(2, rel=0.02)


def test_larger_paper_does_not_help_against_lines_that_point_wrongly():
    exact, lines_only = pump(), Pencil(0.0, line=0.5)
    small, large = (simulated(each, lines_only, COUNT) for each in (exact, enlarged(exact, 2)))
    for answer in small.answers:
        assert small.error(answer.target) == pytest.approx(large.error(answer.target), rel=1e-9)


def test_a_drawing_that_cannot_close_is_told_as_one():
    hopeless = simulated(scene("eight-link-2"), Pencil(5.0), 500)
    assert np.isnan(hopeless["acceleration", "E"]).mean() > 0.05
    assert hopeless.error(("acceleration", "E")) == np.inf


def test_velocities_hang_on_no_mark_of_the_acceleration_plan():
    exact = pump()
    coarse = replace(exact, paper=replace(exact.paper, accelerations=1e3))
    one, two = (simulated(each, Pencil(), 50) for each in (exact, coarse))
    for quantity, of in exact.targets:
        same = (one[quantity, of] == two[quantity, of]).all()
        assert same == (quantity in ("velocity", "omega", "centre"))


def test_a_drawn_bar_tells_its_direction_alone_for_its_length_is_given():
    """A rate is a length read off a plan over the length of the bar, not over how it came out."""
    exact = pump()
    number = exact.program.targets["omega", "3"]
    p, q = exact.program.steps[number].args[:2]
    longer = dict(exact.trace.values)
    longer[q] += 0.02 * (longer[q] - longer[p])
    assert read_off(exact, number, longer) == pytest.approx(longer[number], rel=1e-12)


def test_a_slip_along_the_perpendicular_is_read_as_tangential_component():
    """The perpendicular stays where it is, so that the image does; its arrow alone is longer."""
    exact = pump()
    number = exact.program.targets["epsilon", "3"]
    p, q, _, tip = exact.program.steps[number].args
    tail, values = exact.tails[number], exact.trace.values
    bar = values[q] - values[p]
    across = 1j * bar / abs(bar)
    slip = 1.0 * exact.paper.millimetre(Plane.ACCELERATIONS)

    def slipped(step: int, mark: PencilMark):
        rows = np.zeros((1, mark.errors))
        if step == tail:
            rows[0, :2] = across.real, across.imag
        return rows

    pencil = Pencil(RADIAL, line=0.0)
    found = redrawn(exact, pencil, slipped)
    assert found[tail] - values[tail] == pytest.approx(slip * across, rel=1e-9)
    assert found[tip] == pytest.approx(values[tip], rel=1e-9)
    assert found[number] - values[number] == pytest.approx(-slip / abs(bar), rel=1e-9)


def test_an_angular_acceleration_is_read_from_its_tangential_component():
    exact = pump()
    steps = exact.program.steps
    for link in "234":
        number = exact.program.targets["epsilon", link]
        tail = exact.tails[number]
        arrows = [s for s in steps if s.arrow and s.args == (tail, steps[number].args[3])]
        assert [arrow.of.sign for arrow in arrows] == ["τ"]


@pytest.mark.parametrize("name", ["rapid-return", "stephenson-2-binary", "rod-and-wheel"])
def test_a_higher_group_closes_on_its_drawn_pins_as_it_would_by_trying_all_round(name):
    exact = scene(name)
    (number,) = [n for n, mark in exact.marks.items() if mark is PencilMark.CLOSING]
    step = exact.program.steps[number]
    rng = np.random.default_rng(5)
    pins = [exact.trace.values[arg] for arg in step.args]
    for i, arg in enumerate(step.args):
        if exact.program.steps[arg].plane is Plane.MECHANISM:
            pins[i] += 1e-4 * complex(*rng.standard_normal(2))
    here = followed(closer_of(step), exact.trace.values[number], pins, np.zeros(1))
    there = closer_of(step)(*pins)
    assert complex(here[0][0]) == pytest.approx(complex(there[0]), abs=1e-9)
    assert here[1:-1] == there[1:-1]
