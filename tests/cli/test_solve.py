"""What solve reports: the contract of its JSON, its text, and its warnings."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from graphkin.cli.report.solution_record import sure_lines, verdict_words
from graphkin.construction.core.solution import Verdict
from graphkin.mechanism import load
from tests.chosen import FOLDER
from tests.running import ROOT, Run
from tests.scene_files import scene_text


def solved(run: Run, *args: object) -> Any:
    """The JSON of solve, when all is well."""
    result = run("solve", *args, "--json")
    assert result.exit_code == 0, result.stderr
    assert result.stderr == ""
    return json.loads(result.stdout)


@pytest.fixture
def pump(run: Run) -> Any:
    return solved(run, "pump", "--set", "n=7")


def test_all_scale_factors_are_in_the_units_that_are_asked_for(run: Run, pump: Any) -> None:
    """Per metre of paper: 1:5 is 5 m, or 500 cm."""
    own, si = solved(run, "pump", "--set", "n=7", "--units", "scene")["scales"], pump["scales"]
    assert si["kL"] == 5 and own["kL"] == 500
    assert all(own[k] == pytest.approx(100 * si[k]) for k in ("kL", "kv", "ka"))


TIGHT = scene_text("cli/tight")


def test_a_scale_that_does_not_fit_stops_what_tells_scales_alone(run: Run, tmp_path: Path) -> None:
    """Of what is asked the text tells none; numbers for programs do, or end with status 2."""
    file = tmp_path / "tight.toml"
    file.write_text(TIGHT)
    assert run("solve", file, "--asked").exit_code == 0
    result = run("solve", file, "--asked", "--json")
    assert (result.exit_code, result.stdout) == (2, "")
    assert "sheet.scale: does not fit: at 10:1" in result.stderr


def test_a_link_in_translation_has_its_centre_at_infinity(
    run: Run, four_bar: Callable[..., Path]
) -> None:
    path = four_bar(rocker=30, coupler=80, ask="centres = [2]\npoles = [2]", angle=50)
    link = solved(run, path)["links"]["2"]
    assert link["instant_centre"] is None
    assert link["acceleration_pole"] is None
    text = run("solve", path).stdout
    assert "at infinity, in direction 50.0000°" in text
    assert "at infinity: all accelerate alike, towards -130.000°" in text


def test_links_at_rest_have_neither_centre_nor_pole(
    run: Run, four_bar: Callable[..., Path]
) -> None:
    path = four_bar(speed=0)
    assert solved(run, path)["links"]["3"]["instant_centre"] is None
    assert "every point: the link is at rest" in run("solve", path).stdout


def test_a_flat_crossing_is_answered_with_a_warning_and_status_1(
    run: Run, four_bar: Callable[..., Path]
) -> None:
    path = four_bar(crank=10, base=40, coupler=20, rocker='"10 + 1e-10"', angle=0)
    result = run("solve", path, "--json")
    assert result.exit_code == 1
    assert json.loads(result.stdout)["margin"] < 1e-4
    assert result.stderr.startswith("graphkin: ")
    assert "not fair to ask" in result.stderr
    assert "sure digits: positions 8, velocities 2, accelerations 2" in result.stderr
    assert "the lines at B (velocity) cross at a sine of" in result.stderr


def test_a_witness_that_disagrees_gives_status_1(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    from graphkin.construction.core.solution import Verdict
    from graphkin.mechanism import Mechanism

    verdict = Verdict(False, 0.5, "points.D.velocity", 1e-9, 0.0, 0.0, ("B",))
    monkeypatch.setattr(Mechanism, "witness", lambda self, solution: verdict)
    result = run("solve", "pump", "--json")
    assert result.exit_code == 1
    assert json.loads(result.stdout)["witness"]["agrees"] is False
    assert json.loads(result.stdout)["witness"]["branches_not_held"] == ["B"]
    assert "DOES NOT AGREE: the numbers differ: largest difference 5.0e-01" in result.stderr
    assert "points.D.velocity" in result.stderr
    assert run("check", "pump").exit_code == 1


def test_a_branch_that_does_not_hold_is_told_as_it_is_stated(
    run: Run, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """Numbers within their limit are not called different; the sheets refuse for the same cause."""
    from graphkin.construction.core.solution import Verdict
    from graphkin.mechanism import Mechanism

    verdict = Verdict(False, 1.1e-14, "links.3.epsilon", 1e-9, 0.0, 0.0, ("B", "5"))
    monkeypatch.setattr(Mechanism, "witness", lambda self, solution: verdict)
    stated = 'B = "right of A-O2", 5 = "forward"'
    agree = "the numbers agree: largest difference 1.1e-14 at links.3.epsilon, limit 1.0e-09"
    said = run("solve", "pump").stderr
    assert f"DOES NOT AGREE: {agree}; does not hold of [branches]: {stated}" in said
    refused = run("sheet", "pump", "-o", tmp_path).stderr
    assert f"branches: {stated} does not hold by the vector loops" in refused
    assert "differ" not in refused


def test_a_witness_that_cannot_judge_gives_status_1(
    run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    from graphkin.mechanism import Mechanism
    from graphkin.text.errors import Problem, WitnessError

    def refuse(self: Mechanism, solution: object) -> None:
        raise WitnessError(Problem("loops", "are singular here"))

    monkeypatch.setattr(Mechanism, "witness", refuse)
    result = run("solve", "pump", "--json")
    assert result.exit_code == 1
    assert json.loads(result.stdout)["witness"] == {"agrees": False, "largest_difference": None}
    assert "loops: are singular here" in result.stderr


def test_a_mechanism_that_does_not_close_gives_status_2(
    run: Run, four_bar: Callable[..., Path]
) -> None:
    result = run("solve", four_bar(coupler=9))
    assert result.exit_code == 2
    assert result.stdout == ""
    assert "B cannot be found: the arcs miss each other by" in result.stderr
    assert "Traceback" not in result.stderr


def test_an_open_chain_of_which_no_velocity_is_asked_is_solved(run: Run, tmp_path: Path) -> None:
    """Its velocity plan is empty, and takes no room where the scale is chosen."""
    text = (ROOT / "examples/scenes/excavator-relative.toml").read_text(encoding="utf-8")
    asked = 'velocity = ["A", "B", "C"]\n'
    assert asked in text
    path = tmp_path / "chain.toml"
    path.write_text(text.replace(asked, ""), encoding="utf-8")
    result = run("solve", path)
    assert result.exit_code == 0, result.stderr


def test_a_single_point_has_a_motion_and_no_scale(run: Run, tmp_path: Path) -> None:
    block = tmp_path / "block.toml"
    block.write_text(
        """graphkin = 1
title = "One block"
units = { length = "mm", angle = "deg", speed = "rad/s" }
[frame]
[links.1]
B = [0, 0]
slides = { on = 0, through = [10, 20], angle = 30 }
[[drivers]]
slide = 1
position = 100
speed = 50
[ask]
velocity = ["B"]
""",
        encoding="utf-8",
    )
    asked = run("solve", block, "--asked")
    assert asked.exit_code == 0
    assert "0.0433013" in asked.stdout  # 50 mm/s × cos 30°
    assert "agrees" in asked.stdout
    assert "scale: the mechanism has no extent" in run("solve", block).stderr


# --- what drivers give ---------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "given"),
    [
        ("platform-3rpr", {"2": (0.18, 0.1, 0), "4": (0.17, -0.06, 0.04), "6": (0.19, 0.03, 0)}),
        ("cylinders-two", {"2": (0.25, 0.1, 0), "4": (0.22, -0.06, 0.05)}),
        ("rod-and-wheel", {"2": (0.21, 0.15, 0)}),
    ],
)
def test_what_a_driver_gives_along_a_guide_that_turns_is_told_as_given(
    run: Run, name: str, given: dict[str, tuple[float, float, float]]
) -> None:
    """A zero stands as 0, not as what rounding leaves: in JSON, table and proved digits."""
    scene = FOLDER / f"{name}.toml"
    found = json.loads(run("solve", scene, "--json").stdout)["slides"]
    for block, motion in given.items():
        told = tuple(found[block][key] for key in ("position", "speed", "acceleration"))
        assert told == motion
    table = run("solve", scene).stdout.partition("block  position")[2]
    rows = {line.split()[0]: line.split()[1:4] for line in table.splitlines()[1:] if line}
    for block, motion in given.items():
        assert tuple(map(float, rows[block])) == motion
        assert (rows[block][2] == "0") == (motion[2] == 0)
    proved = run("solve", scene, "--digits", "30", "--json")
    certified = json.loads(proved.stdout)
    for block, (position, speed, acceleration) in given.items():
        entry = certified["slides"][block]
        assert tuple(map(float, list(entry.values())[:3])) == (position, speed, acceleration)
    assert not [path for path in certified["undecided"] if path.endswith(".acceleration")]


def test_every_setting_that_is_none_is_told(run: Run) -> None:
    result = run("solve", "pump", "--set", "m", "--set", "n=7", "--set", "n=8", "--set", "q=")
    assert result.exit_code == 2
    for told in ("--set m: write NAME=VALUE", "--set n: is set twice", "--set q=: write NAME"):
        assert told in result.stderr


AT_DEAD_POINT = """
graphkin = 1
title = "Rhombus"
units = { length = "mm", angle = "deg", speed = "rad/s" }
[frame]
O = [0, 0]
[links.1]
O-A = 60
[links.2]
A-B = 60
[links.3]
B = [0, 0]
slides = { on = 0, through = [0, 0], angle = 0 }
[[drivers]]
turn = 1
angle = 90
speed = 10
[branches]
3 = "forward"
[ask]
velocity = ["B"]
"""


def test_at_a_dead_point_proved_digits_do_not_advise_themselves(run: Run, tmp_path: Path) -> None:
    file = tmp_path / "rhombus.toml"
    file.write_text(AT_DEAD_POINT)
    told = run("solve", file)
    assert (told.exit_code, told.stdout) == (2, "")
    assert "(solve --digits can)" in told.stderr
    proved = run("solve", file, "--digits", "20")
    assert (proved.exit_code, proved.stdout) == (2, "")
    assert "--digits" not in proved.stderr
    assert "the driver's speed determines no other: change the driver's position" in proved.stderr


def test_a_pin_beside_the_pivot_of_its_slot_is_left_to_proved_digits(
    run: Run, tmp_path: Path
) -> None:
    file = tmp_path / "slot.toml"
    file.write_text(scene_text("cli/slot-beside-its-pivot"))
    told = run("solve", file)
    assert (told.exit_code, told.stdout) == (2, "")
    assert "A falls on O2" in told.stderr
    assert "solve --digits finds it where doubles cannot tell" in told.stderr
    proved = run("solve", file, "--digits", "12")
    assert "velocity y, m/s        300000003.000" in proved.stdout
    assert "every one proved" in proved.stdout
    file.write_text(scene_text("cli/slot-beside-its-pivot").replace("100.000001", "100"))
    at_once = run("solve", file, "--digits", "12")
    assert at_once.exit_code == 2
    assert "--digits" not in at_once.stderr


def test_wheels_after_very_many_turns_are_judged_with_the_digits_that_are_left(
    run: Run, tmp_path: Path
) -> None:
    text = (FOLDER / "gears-lever.toml").read_text()
    file = tmp_path / "turns.toml"
    file.write_text(text.replace('angle = "angle"', 'angle = "2e15 + sqrt(2)"'))
    told = run("solve", file)
    assert "witness  agrees" in told.stdout
    assert "digits   sure: positions 1, velocities 0" in told.stdout
    assert "angles of many turns" in told.stderr
    assert "solve --digits proves what can be known" in told.stderr


def test_a_rack_that_is_far_away_does_not_hide_what_a_wheel_has_lost(
    run: Run, tmp_path: Path
) -> None:
    text = (FOLDER / "gears-rack.toml").read_text()
    file = tmp_path / "rack.toml"
    file.write_text(text.replace('angle = "angle"', 'angle = "2e15 + sqrt(2)"'))
    assert "digits   sure: positions 11, velocities 1, accelerations 1" in run("solve", file).stdout


def test_numbers_that_differ_are_told_with_the_digits_that_are_left() -> None:
    scene = load("pump").scene
    verdict = Verdict(False, 1e-3, "points.D.velocity", 1e-9, 0, 0, digits={"velocity": 3})
    words = verdict_words(verdict, scene)
    assert words.endswith("; sure digits: velocities 3; solve --digits proves what can be known")
    assert sure_lines(verdict) == []
