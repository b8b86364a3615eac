"""The pencil's own numbers: 95 of 100 marks and lines lie as near as it says."""

from __future__ import annotations

import numpy as np
import pytest

from graphkin.accuracy.pencil import Pencil, PencilMark, mark_of, marked, redrawn
from graphkin.construction.core.program import Plane
from graphkin.numbers.plane import Circle, Line, Ratio
from graphkin.text.errors import SceneError
from tests.accuracy.originals import pump, scene

DRAWINGS = 40_000
MM = 0.002
"""What a millimetre of paper stands for."""


def errors(mark: PencilMark, seed: int = 1):
    return np.random.default_rng(seed).standard_normal((DRAWINGS, mark.errors))


def within(amounts, limit: float) -> float:
    return float(np.mean(np.abs(amounts) <= limit))


def test_of_a_hundred_marks_95_lie_within_the_point():
    pencil = Pencil(0.4)
    found = marked(PencilMark.POINT, 3 + 4j, 0j, errors(PencilMark.POINT), pencil, MM)
    assert within(found - (3 + 4j), 0.4 * MM) == pytest.approx(0.95, abs=0.004)
    spread = np.std(found.real), np.std(found.imag), np.std(((1 + 1j) * found).real) / 2**0.5
    assert spread == pytest.approx((spread[0],) * 3, rel=0.02)


def test_of_a_hundred_lines_95_point_within_the_angle_and_all_pass_through_their_point():
    line = marked(
        PencilMark.LINE, Line(1j, 2 + 1j), 0j, errors(PencilMark.LINE), Pencil(1.0, line=0.3), MM
    )
    turned = np.degrees(np.angle(line.along / (2 + 1j)))
    assert within(turned, 0.3) == pytest.approx(0.95, abs=0.004)
    assert line.point == 1j


def test_an_arrow_that_is_laid_off_errs_across_itself_in_proportion_to_its_length():
    sharp = Pencil(0.0, line=0.5)
    short, long = (
        marked(PencilMark.ARROW, complex(x), 0j, errors(PencilMark.ARROW), sharp, MM)
        for x in (1, 7)
    )
    assert np.std(long.imag) == pytest.approx(7 * np.std(short.imag), rel=1e-9)
    assert within(np.degrees(np.angle(long)), 0.5) == pytest.approx(0.95, abs=0.004)
    assert np.abs(long) == pytest.approx(7, rel=1e-12)


def test_an_arrow_errs_in_place_and_in_direction_independently():
    place, turn, both = (
        marked(PencilMark.ARROW, 7 + 0j, 0j, errors(PencilMark.ARROW), pencil, MM) - 7
        for pencil in (Pencil(20.0, line=0.0), Pencil(0.0, line=0.5), Pencil(20.0, line=0.5))
    )
    assert np.corrcoef([place.real, place.imag, turn.imag]) == pytest.approx(np.eye(3), abs=0.02)
    assert np.std(both.imag) == pytest.approx(
        np.hypot(np.std(place.imag), np.std(turn.imag)), rel=0.01
    )


def test_a_line_has_a_degree_for_each_millimetre_of_the_point():
    assert Pencil(0.5).degrees == 0.5
    assert Pencil(0.5, line=0.1).degrees == 0.1


@pytest.mark.parametrize(
    ("wrong", "name"),
    [({"point": -1.0}, "point"), ({"line": float("nan")}, "line"), ({"grid": -0.1}, "grid")],
)
def test_a_pencil_that_cannot_be_is_refused_by_name(wrong, name):
    with pytest.raises(SceneError, match=f"pencil.{name}: .* a number, zero or more"):
        Pencil(**wrong)


def test_a_grid_rounds_marks_to_its_mesh_on_paper():
    pencil = Pencil(0.0, grid=0.5)
    found = marked(PencilMark.POINT, 0.00713 + 0.0149j, 0j, np.zeros((1, 2)), pencil, MM)
    assert found[0] == pytest.approx(0.007 + 0.015j, abs=1e-15)


def test_what_is_computed_or_only_joined_is_no_mark_and_a_pole_is_where_it_is_put():
    exact = pump()
    steps, values = exact.program.steps, exact.trace.values
    for number, value in values.items():
        step = steps[number]
        key = step.action.key if step.action else ""
        if step.plane is Plane.NUMBERS or step.arrow or key == "pole":
            assert number not in exact.marks
        elif isinstance(value, Line):
            assert exact.marks[number] is PencilMark.LINE
        elif isinstance(value, Circle):
            assert exact.marks[number] is PencilMark.ARC
        else:
            assert exact.marks[number] in (PencilMark.POINT, PencilMark.ARROW), key


def test_every_value_drawn_in_a_scene_has_its_rule():
    for name in ("rapid-return", "oscillating-slide", "gears-rack", "roller", "eight-link-2"):
        exact = scene(name)
        for number, value in exact.trace.values.items():
            step = exact.program.steps[number]
            is_unit = isinstance(value, complex) and abs(abs(value) - 1) < 1e-12
            if step.plane is Plane.MECHANISM and step.action and step.action.key == "axis":
                assert is_unit and mark_of(step, value) is PencilMark.WAY
            if isinstance(value, Ratio):
                assert mark_of(step, value) is PencilMark.POINT


def test_only_what_hangs_on_a_mark_moves():
    exact = pump()
    pinned = exact.program.targets["position", "C"]

    def only_c(number: int, mark: PencilMark):
        rows = np.zeros((2, mark.errors))
        rows[1] = number == pinned
        return rows

    found = redrawn(exact, Pencil(0.5), only_c)
    hanging = exact.program.descendants(pinned)
    by_hand = {n: step.by_hand for n, step in enumerate(exact.program.steps) if step.by_hand}
    moved = {n for n in exact.order if not isinstance(found[n], tuple)}
    moved = {n for n in moved if np.ptp(abs(np.broadcast_to(found[n], 2))) > 1e-9}
    assert exact.program.targets["position", "D"] in moved
    assert exact.program.targets["velocity", "B"] not in moved
    reached = set(hanging)
    for _ in range(4):
        reached |= {n for n, hand in by_hand.items() if hand in reached}
        reached |= {m for n in tuple(reached) for m in exact.program.descendants(n)}
    assert moved <= reached
