"""Explain counts: every step of what is asked belongs to one effect."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from graphkin import load
from graphkin.effects import BY_HAND, NAMES, Effect, effects
from graphkin.steps.program import Part
from tests.cli.conftest import Run


def of(path: str | Path) -> dict[str, Effect]:
    """The effects of a scene by name."""
    return {effect.name: effect for effect in effects(load(str(path)))}


@pytest.mark.parametrize("lab", ["pump", "pump-collinear"])
def test_the_counts_add_up_to_the_sliced_program(lab: str) -> None:
    mechanism = load(lab)
    program, asked = mechanism.program, mechanism.asked()
    found = {effect.name: effect.steps for effect in effects(mechanism)}
    plain, drawn = program.needed(asked), program.needed(asked, by_hand=True)
    assert sum(found[name] for name in NAMES) == len(plain)
    assert found[BY_HAND] == len(drawn) - len(plain)


def test_parts_are_counted_as_the_program_marks_them() -> None:
    mechanism = load("pump")
    steps = mechanism.program.steps
    needed = mechanism.program.needed(mechanism.asked())
    found = of("pump")
    for part, name in (
        (Part.POSITION, "position"),
        (Part.VELOCITY, "velocity"),
        (Part.CENTRE, "instantaneous centres"),
        (Part.POLE, "acceleration poles"),
        (Part.RESULT, "results"),
    ):
        drawn = [n for n in needed if steps[n].part is part and steps[n].given is None]
        assert found[name].steps == len(drawn), name


def test_the_pump_runs_steadily_on_a_fixed_guide() -> None:
    found = of("pump")
    assert not found["driver acceleration"].included
    assert found["driver acceleration"].reason == "every driver has a constant speed"
    assert not found["Coriolis"].included
    assert found["Coriolis"].reason == "the guide of 5 does not turn"
    assert found["rolling and gears"].reason == "no link rolls"
    assert found["laws of time"].reason == "no driver is written in t"
    assert found["acceleration poles"].steps == 2
    assert found["instantaneous centres"].steps == 1


def test_velocity_alone_needs_no_acceleration(four_bar: Callable[..., Path]) -> None:
    found = of(four_bar())
    out = ("acceleration", "normal components", "tangential components", "acceleration poles")
    assert not any(found[name].included for name in out)
    assert found["normal components"].reason == "velocity of B can be found without"
    assert found["velocity"].reason == "needed for all that is asked"


def test_an_accelerated_driver_costs_one_step(four_bar: Callable[..., Path]) -> None:
    steady = four_bar(ask='acceleration = ["B"]')
    before = of(steady)
    after = of(four_bar(ask='acceleration = ["B"]', driver="acceleration = 5"))
    assert (before["driver acceleration"].steps, after["driver acceleration"].steps) == (0, 1)
    assert after["driver acceleration"].reason.startswith("driver 1 has an acceleration")
    without = of(four_bar(driver="acceleration = 5"))["driver acceleration"]
    assert without == Effect("driver acceleration", 0, "velocity of B can be found without")


def test_a_law_of_time_is_named(four_bar: Callable[..., Path]) -> None:
    path = four_bar(ask='acceleration = ["B"]')
    text = path.read_text()
    text = text.replace("angle = 60\nspeed = 2", 'angle = "60 + 10*t**2"')
    path.write_text(text.replace("graphkin = 1", "graphkin = 1\ntime = 0.5"))
    found = of(path)
    assert found["laws of time"].included
    assert found["laws of time"].reason.startswith("driver 1 has a law of time")
    assert found["driver acceleration"].included


def test_a_scene_that_asks_nothing_is_asked_everything(four_bar: Callable[..., Path]) -> None:
    path = four_bar(ask="")
    mechanism = load(path)
    everything = len(mechanism.program.needed(mechanism.program.answers))
    assert sum(e.steps for e in of(path).values() if e.name != "by-hand marks") == everything


def test_the_text_says_in_and_out_with_their_steps(run: Run) -> None:
    result = run("explain", "pump")
    assert result.exit_code == 0
    mechanism = load("pump")
    total = len(mechanism.program.needed(mechanism.asked()))
    assert f"{total} steps give what is asked" in result.stdout
    rows = [line.split() for line in result.stdout.splitlines()]
    assert ["Coriolis", "out", "0"] in [row[:3] for row in rows]
