"""solve --pencil: what it prints, its JSON, and the warning that a lab is not for the hand."""

from __future__ import annotations

import json
from typing import Any

import pytest

from graphkin.accuracy.pencil import Pencil, pencil_drawings
from graphkin.documents.sheet_documents import scales
from graphkin.mechanism import load
from tests.running import Run


def by_pencil(run: Run, *args: object) -> Any:
    """The key "pencil" of the JSON of solve."""
    result = run("solve", *args, "--json")
    assert result.exit_code == 0, result.stderr
    return json.loads(result.stdout)["pencil"]


def text(run: Run, *args: object) -> str:
    """What solve prints from the pencil on."""
    result = run("solve", *args)
    assert result.exit_code == 0, result.stderr
    return result.stdout[result.stdout.index("\npencil") :]


def test_what_is_foretold_is_what_drawings_are_off(run: Run) -> None:
    found = by_pencil(run, "pump", "--set", "n=20", "--pencil", 0.5)["answers"]
    pump = load("pump", n=20)
    many = pencil_drawings(pump, scales(pump), Pencil(0.5), 4000)
    for quantity, of in many.index:
        assert found[quantity][of]["predicted"] == pytest.approx(
            many.error((quantity, of)), rel=0.1
        )


def test_it_warns_by_the_error_of_what_is_asked_and_not_by_how_flat_lines_cross(run: Run) -> None:
    """Student 25's piston is nearly at its greatest speed: hardly any acceleration is left."""
    result = run("solve", "pump", "--set", "n=25", "--pencil", "0.25")
    assert result.exit_code == 0
    assert "should not be drawn by hand with a 0.25 mm pencil" in result.stderr
    assert "acceleration of D (101 %)" in result.stderr
    assert by_pencil(run, "pump", "--set", "n=25", "--pencil", 0.25)["warnings"]


def test_an_answer_that_is_zero_has_no_error_in_percent_and_is_not_warned_of(run: Run) -> None:
    scene = "examples/scenes/mobility-parallel-cranks.toml"
    found = by_pencil(run, scene, "--pencil", 0.5)
    zero = found["answers"]["omega"]["4"]
    assert zero["relative"] is None
    assert zero["predicted"] > 0
    assert not any("omega of 4" in warning for warning in found["warnings"])


def test_a_drawing_that_may_not_close_is_called_one(run: Run) -> None:
    scene = "examples/scenes/eight-link-2.toml"
    assert by_pencil(run, scene, "--pencil", 3)["answers"]["velocity"]["E"]["predicted"] is None
    assert "may not close" in text(run, scene, "--pencil", 3)


def test_where_all_that_is_asked_is_given_it_says_so(run: Run, four_bar: Any) -> None:
    scene = four_bar(ask="omega = [1]")
    assert by_pencil(run, scene, "--pencil", 0.5)["answers"] == {}
    assert text(run, scene, "--pencil", 0.5) == (
        "\npencil   nothing that is asked is read off a drawing\n"
    )


@pytest.mark.parametrize("wrong", ["-0.1", "sharp", "nan"])
def test_a_pencil_that_cannot_be_is_refused(run: Run, wrong: str) -> None:
    result = run("solve", "pump", "--pencil", wrong)
    assert result.exit_code == 2
    assert "Traceback" not in result.stderr
