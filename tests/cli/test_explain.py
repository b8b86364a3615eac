"""Explain tells of each effect whether it is in, why, its steps, and the time of those alone."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from graphkin import load
from graphkin.accuracy.pencil import Pencil, forecast, original
from graphkin.cli.report.explain_report import waits_of
from graphkin.construction.core import run as running
from graphkin.construction.core.timing import Stopwatch, Work, one_position
from graphkin.diagnosis.effects import BY_COMMAND, BY_HAND, EFFECTS, EffectRow, effects
from graphkin.documents.scaling import scales
from tests.running import ROOT, Run

SCENES = ROOT / "examples" / "scenes"


def of(path: str | Path) -> dict[str, EffectRow]:
    """The effects of a scene by name."""
    return {row.name: row for row in effects(load(str(path)))}


def told(run: Run, *args: object) -> Any:
    """The JSON of explain."""
    result = run("explain", *args, "--json")
    assert result.exit_code == 0, result.stderr
    return json.loads(result.stdout)


FORCES = ROOT / "tests" / "scenes" / "forces"


def test_forces_have_their_own_effects_and_causes(run: Run, tmp_path: Path) -> None:
    """Steps for loads and for reactions, only where they are asked; the reason names the masses."""
    found = told(run, FORCES / "gas-engine.toml")
    assert found["asked"] == "reactions O, A and 3; balance"
    by_name = {row["effect"]: row for row in found["effects"]}
    for name in ("loads", "reactions and balance"):
        assert by_name[name]["in"] and by_name[name]["steps"] > 5
    assert "links 1, 2 and 3 have masses" in by_name["loads"]["why"]
    assert sum(by_name[e]["steps"] for e in EFFECTS) == found["steps_asked"]
    assert found["steps_asked"] < found["steps_everything"]
    text = (FORCES / "gas-engine.toml").read_text(encoding="utf-8")
    quiet = tmp_path / "quiet.toml"
    quiet.write_text(text.partition("reactions =")[0] + 'velocity = ["A"]\n', encoding="utf-8")
    row = of(quiet)["reactions and balance"]
    assert not row.included and row.reason == "[ask] names no reactions and no balance"
    assert "no masses and no loads" in of("pump")["loads"].reason


@pytest.mark.parametrize("name", ["pump", SCENES / "oscillating-slide.toml"])
def test_every_effect_that_is_in_has_its_own_time_and_no_other(run: Run, name: object) -> None:
    found = told(run, name)
    assert {row["effect"] for row in found["effects"]} == {*EFFECTS, BY_HAND, *BY_COMMAND}
    for row in found["effects"]:
        assert (row["time"] is not None) == (row["steps"] > 0), row
        if row["time"]:
            assert 0 < row["time"]["low"] <= row["time"]["median"] <= row["time"]["high"]
    assert (
        sum(r["steps"] for r in found["effects"] if r["effect"] in EFFECTS) == found["steps_asked"]
    )
    assert found["steps_asked"] < found["steps_everything"]
    assert found["time_asked"]["rounds"] == 25


def test_only_the_steps_of_an_effect_are_timed(monkeypatch: pytest.MonkeyPatch) -> None:
    """The steps handed to the clock are those of the slice, each once, under its own effect."""
    from graphkin.diagnosis import effects as room

    mechanism = load(str(SCENES / "oscillating-slide.toml"))
    handed: list[list[int]] = []

    def noted(trace: object, numbers: list[int], values: object) -> Work:
        handed.append(list(numbers))
        return lambda: None

    monkeypatch.setattr(room, "work_of_steps", noted)
    rows, _ = room.measured(mechanism, Stopwatch(rounds=2, least=0, patience=0), [])
    assert [len(numbers) for numbers in handed] == [row.steps for row in rows if row.steps]
    program, asked = mechanism.program, mechanism.asked()
    every = sorted(number for numbers in handed for number in numbers)
    assert every == list(program.needed(asked, by_hand=True))
    in_order = iter(handed)
    effect_of = {row.name: next(in_order) for row in rows if row.steps}
    for number in effect_of["Coriolis"]:
        action = program.steps[number].action
        assert action is not None
        assert action.key in ("coriolis", "lay-off", "lay-back")


def test_a_position_that_does_not_close_is_explained_without_times(
    run: Run, four_bar: Callable[..., Path]
) -> None:
    result = run("explain", four_bar(coupler=9))
    assert result.exit_code == 0
    assert "no time is measured: " in result.stdout
    assert "the arcs miss each other by" in result.stdout
    found = told(run, four_bar(coupler=9))
    assert found["time_asked"] is None
    assert found["steps_asked"] > 0


def test_what_is_asked_is_timed_where_the_rest_cannot_be_drawn(run: Run) -> None:
    """The block that drives a slider-crank moves as given, too far off for crank and rod."""
    scene = ROOT / "tests" / "scenes" / "cli" / "block-out-of-reach.toml"
    result = run("explain", scene)
    assert result.exit_code == 0
    (line,) = [each for each in result.stdout.splitlines() if "would give everything" in each]
    assert "no time is measured: " in line
    assert "the arcs miss each other by 0.001 m" in line
    found = told(run, scene)
    assert found["time_asked"] is not None
    assert found["time_everything"] is None
    assert list(found["waits"]) == ["load", "solve", "check"]


def test_a_guide_that_never_turns_is_not_said_to() -> None:
    """The cylinder of the locomotive is carried by its frame, which two wheels keep level."""
    reason = of(SCENES / "locomotive.toml")["Coriolis"].reason
    assert reason.startswith("the guide of 6 is on a link that may turn; ")


def test_one_position_is_every_needed_step_with_nothing_kept(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    mechanism = load("pump")
    mechanism.solve()
    ran: list[int] = []
    evaluate = running.evaluate

    def counted(step: Any, number: int, *rest: Any) -> Any:
        ran.append(number)
        return evaluate(step, number, *rest)

    monkeypatch.setattr(running, "evaluate", counted)
    needed = mechanism.program.needed(mechanism.asked())
    work = one_position(mechanism.program, needed, mechanism.scene.values)
    work()
    work()
    assert ran == [*needed, *needed]


def test_what_a_user_waits_for_and_what_a_lab_sheet_needs(run: Run) -> None:
    found = told(run, "pump")
    assert list(found["waits"]) == ["load", "solve", "check", "page"]
    assert all(time["median"] > 0 for time in found["waits"].values())
    pump = load("pump")
    digits = pump.witness(pump.solve(asked=True)).digits
    expected = forecast(original(pump, scales(pump)), Pencil()).expected
    errors = [each.relative for each in expected if each.relative is not None]
    sheet = {"drawing": max(errors), "marks_within_mm": 0.5, "digits": min(digits.values())}
    assert found["sheet"] == pytest.approx(sheet, rel=5e-3)
    last = run("explain", "pump").stdout.splitlines()[-1]
    assert last.startswith("for a lab sheet: a drawing with marks within 0.5 mm is sure to ")
    assert last.endswith(f"float64 leaves {min(digits.values())} digits")


def test_a_mechanism_without_a_sheet_is_timed_without_a_page(
    four_bar: Callable[..., Path],
) -> None:
    """Beside its dead point: everything is measured but the page, and that is said."""
    flat = four_bar(coupler=10.0000000001, angle=0)
    found = waits_of(lambda: load(str(flat)), Stopwatch(rounds=2, least=0, patience=0))
    assert "page" not in found.times and found.undrawn
    assert found.drawing is None
