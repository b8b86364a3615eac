"""What check tells: structure, closures, range, crossings, and every mistake at once."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import pytest

from graphkin import load
from graphkin.closures import choices
from tests.cli.conftest import ROOT, Run


def test_the_pump_is_told_in_full(run: Run) -> None:
    result = run("check", "pump")
    assert result.exit_code == 0
    for expected in (
        "5 moving (1, 2, 3, 4 and 5), and the frame",
        "pin A of links 1 and 3",
        "slide of block 5 on the frame",
        "3·5 − 2·7 = 1, mobility by the count",
        "1, true mobility by the rank of the constraints",
        "1. crank 1 about O1",
        "dyad RRR (class II) of links 3 and 2, inner pin B",
        "dyad RRP (class II) of links 4 and 5, inner pin D",
        "closes for driver angles",
        "flattest crossings",
        "agrees: largest difference",
    ):
        assert expected in result.stdout


def test_a_crossing_is_told_by_its_angle_its_part_and_its_point(run: Run) -> None:
    lines = run("check", "pump").stdout.splitlines()
    at = next(i for i, line in enumerate(lines) if line.startswith("crossings"))
    assert [line.split() for line in lines[at + 1 : at + 4]] == [
        ["54.90°", "shape", "C"],
        ["76.74°", "velocity", "b"],
        ["76.74°", "acceleration", "b′"],
    ]
    assert not any("sine" in line or "step" in line for line in lines)


def test_both_closures_of_each_dyad_are_shown(run: Run) -> None:
    lines = run("check", "pump").stdout.splitlines()
    shown = [line.split() for line in lines if "the rest closes" in line]
    assert [line[:2] for line in shown] == [
        ["*", "right"],
        ["left", "of"],
        ["*", "forward"],
        ["backward", "(-64.382,"],
    ]


def test_closures_are_mirrored_in_the_line_of_the_known_pins() -> None:
    pump = load("pump", n=7)
    b, d = choices(pump.scene, pump.groups, pump.program)
    solution = pump.solve()
    a, o2 = solution.points["A"].position, solution.points["O2"].position
    picked, other = (closure.place for closure in b.closures)
    assert picked == solution.points["B"].position
    assert abs((picked - a) / (o2 - a) - ((other - a) / (o2 - a)).conjugate()) < 1e-12
    assert d.closures[0].place == solution.points["D"].position
    assert [closure.words for closure in d.closures] == ["forward", "backward"]


def test_the_other_closure_is_what_the_scene_finds_with_the_other_branch(tmp_path: Path) -> None:
    text = (ROOT / "sheets" / "pump" / "scene.toml").read_text(encoding="utf-8")
    path = tmp_path / "turned.toml"
    path.write_text(text.replace('"right of A-O2"', '"left of A-O2"'), encoding="utf-8")
    pump, turned = load("pump"), load(str(path))
    other = choices(pump.scene, pump.groups, pump.program)[0].closures[1]
    assert other.place == turned.solve().points["B"].position
    assert other.fails == ""


def test_what_fails_with_the_other_closure_is_named(tmp_path: Path) -> None:
    text = (ROOT / "sheets" / "pump" / "scene.toml").read_text(encoding="utf-8")
    path = tmp_path / "low.toml"
    path.write_text(text.replace("C-D = 20", "C-D = 3"), encoding="utf-8")
    low = load(str(path))
    fails = [c.fails for c in choices(low.scene, low.groups, low.program)[0].closures]
    assert fails == ["", "D"]


def test_a_crank_that_turns_fully_has_the_whole_range(
    run: Run, four_bar: Callable[..., Path]
) -> None:
    assert "it turns fully" in run("check", four_bar()).stdout


def test_the_range_ends_where_the_mechanism_stretches(
    run: Run, four_bar: Callable[..., Path]
) -> None:
    text = run("check", four_bar(crank=60, coupler=30, rocker=40, base=80)).stdout
    low, high = map(float, re.findall(r"angles (-?[\d.]+)° to (-?[\d.]+)°", text)[0])
    assert low == pytest.approx(-high, abs=0.051)


def test_every_mistake_is_told_at_once(run: Run, four_bar: Callable[..., Path]) -> None:
    path = four_bar(ask='velocity = ["Q"]\nomgea = [2]')
    result = run("check", path)
    assert result.exit_code == 2
    told = result.stderr.splitlines()
    assert len(told) >= 2
    assert all(line.startswith("graphkin: ") for line in told)
    assert any("omgea" in line and "omega" in line for line in told)
    assert any("Q" in line for line in told)


def test_groups_are_named_even_where_they_cannot_be_constructed(
    run: Run, four_bar: Callable[..., Path]
) -> None:
    path = four_bar()
    path.write_text(path.read_text().replace('B = "left of A-O2"', ""))
    result = run("check", path)
    assert result.exit_code == 2
    assert "dyad RRR (class II) of links 2 and 3" in result.stdout
    assert "four.toml: branches.B: is missing" in result.stderr


def test_a_position_that_does_not_close_still_shows_its_range(
    run: Run, four_bar: Callable[..., Path]
) -> None:
    result = run("check", four_bar(crank=60, coupler=30, rocker=40, base=80, angle=180))
    assert result.exit_code == 2
    assert "cannot be drawn" in result.stdout
    assert "closes for driver angles" in result.stdout
    assert "B cannot be found" in result.stderr
