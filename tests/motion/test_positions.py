"""Equal positions of a drawing, and the workbook of a cycle's tables."""

from __future__ import annotations

import csv
import io
from math import asin, degrees
from pathlib import Path

import numpy as np
import pytest
from openpyxl import load_workbook

from graphkin.mechanism import load
from graphkin.motion.cycle import cycle
from graphkin.motion.equal_positions import equal_positions
from graphkin.text.errors import SceneError
from tests.motion.linkages import four_bar, slider_crank
from tests.running import Run


def test_positions_divide_a_turn_from_the_scene_on():
    found = equal_positions(cycle(slider_crank(2, 5, 1, angle=17), steps=12), 8)
    assert found.at == pytest.approx(17 + 45 * np.arange(8))


def test_positions_of_a_driver_that_runs_backwards_follow_its_motion():
    found = equal_positions(cycle(slider_crank(2, 5, 1, angle=17, speed=-3), steps=12), 8)
    assert found.at == pytest.approx(17 - 45 * np.arange(8))
    rise = np.diff(found.solution.points["B"].position.real)
    speed = found.solution.points["B"].velocity.real
    steady = speed[1:] * speed[:-1] > 0
    assert steady.sum() > 4
    assert (rise * speed[1:] > 0)[steady].all()


def test_positions_start_where_crank_and_rod_are_in_line():
    """The inner dead point of a slider-crank: sin φ = -e/(l - r), with φ beyond 180°."""
    found = equal_positions(cycle(slider_crank(2, 5, 1), steps=12), 12, "dead")
    assert found.at[0] == pytest.approx(180 + degrees(asin(1 / 3)), abs=1e-6)
    ram = found.solution.points["B"]
    assert abs(ram.velocity[0]) < 1e-9
    assert ram.position.real[0] == min(ram.position.real)
    assert len(found.at) == 12


def test_positions_of_a_range_lie_between_its_dead_points():
    moved = cycle(load("pump", n=7), steps=12)
    (low, high) = moved.ranges[0]
    found = equal_positions(moved, 8, "dead")
    assert found.at == pytest.approx(low + (high - low) / 8 * np.arange(1, 8))
    own = equal_positions(moved, 8)
    assert min(abs(own.at - 44)) < 1e-9
    assert np.diff(own.at) == pytest.approx((high - low) / 8)


def test_without_a_dead_point_none_can_be_the_start():
    """A double crank: everything on the frame turns fully."""
    with pytest.raises(SceneError, match="dead point"):
        equal_positions(cycle(four_bar(90, 70, 100, 40), steps=12), 8, "dead")


def test_positions_far_outside_the_range_are_refused():
    """A crank longer than its rod allows moves over some degrees, far from the scene's own."""
    moved = cycle(slider_crank(20, 5, 3, angle=136), steps=12)
    with pytest.raises(SceneError, match="outside the range of the driver"):
        equal_positions(moved, 12)


def test_a_workbook_holds_the_tables_and_depends_on_no_clock(run: Run, tmp_path: Path):
    options = ("--steps", 4, "--positions", 3, "--format", "csv,xlsx")
    result = run("cycle", "offset-slider-crank", "-o", tmp_path, *options)
    assert result.exit_code == 0, result.stderr
    assert {path.suffix for path in tmp_path.iterdir()} == {".csv", ".xlsx"}
    (path,) = tmp_path.glob("*.xlsx")
    book = load_workbook(io.BytesIO(path.read_bytes()))
    tables = {}
    for name in book.sheetnames:
        tables[name] = (tmp_path / f"offset-slider-crank-{name}.csv").read_text()
        heads, *rows = csv.reader(io.StringIO(tables[name]))
        every = [[cell.value for cell in row] for row in book[name]]
        assert every[0] == heads
        for cells, texts in zip(every[1:], rows, strict=True):
            for cell, text in zip(cells, texts, strict=True):
                if isinstance(cell, float | int):
                    assert cell == pytest.approx(float(text), rel=1e-15)
                else:
                    assert (cell or "") == text
    assert set(tables) == {"cycle", "extremes", "positions"}
    again = run("cycle", "offset-slider-crank", "-o", tmp_path / "again", *options)
    assert again.exit_code == 0, again.stderr
    assert (tmp_path / "again" / path.name).read_bytes() == path.read_bytes()


def test_a_table_says_minus_infinity_as_a_number(run: Run, tmp_path: Path):
    """At its dead points the coupler of the pump turns without bound, one way and the other."""
    assert run("cycle", "pump", "-o", tmp_path, "--format", "csv").exit_code == 0
    rows = csv.DictReader((tmp_path / "pump-extremes.csv").read_text().splitlines())
    ends = {row["value"] for row in rows if row["of"] == "4" and row["unit"] == "rad/s"}
    assert ends == {"-inf", "inf"}
