"""What solve and check report of forces: only what is asked, and the other routes' difference."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

from tests.running import Run

LOADED = 'velocity = ["B"]\n{}[[loads]]\nat = "B"\nlink = 3\nforce = [100, 0]'


def test_reactions_and_balance_are_reported_only_where_asked(
    run: Run, four_bar: Callable[..., Path]
) -> None:
    for asked, keys in (
        ("", set()),
        ('reactions = ["A"]\n', {"reactions", "force_witness"}),
        ("balance = true\n", {"balance", "force_witness"}),
    ):
        result = run("solve", four_bar(ask=LOADED.format(asked)), "--asked", "--json")
        assert result.exit_code == 0, result.stderr
        found = json.loads(result.stdout)
        assert {"reactions", "balance", "force_witness"} & found.keys() == keys
        assert not keys or found["force_witness"]["agrees"]


def test_action_is_the_opposite_of_reaction(run: Run, four_bar: Callable[..., Path]) -> None:
    result = run("solve", four_bar(ask=LOADED.format('reactions = ["A"]\n')), "--json")
    on = json.loads(result.stdout)["reactions"]["A"]
    assert on["1"]["force"] == [-part for part in on["2"]["force"]]


def test_text_and_check_tell_how_far_the_other_routes_are(
    run: Run, four_bar: Callable[..., Path]
) -> None:
    file = four_bar(ask=LOADED.format('reactions = ["A"]\nbalance = true\n'))
    said = "agrees with all equations of equilibrium to "
    for command in ("solve", "check"):
        result = run(command, file)
        assert result.exit_code == 0, result.stderr
        assert said in result.stdout
    assert "balance  moment on link 1: " in run("solve", file).stdout


def test_forces_that_nobody_asks_for_are_told(run: Run, four_bar: Callable[..., Path]) -> None:
    said = run("solve", four_bar(ask=LOADED.format(""))).stderr
    assert "[ask]" in said and "balance" in said


def test_their_digits_are_not_called_proved(run: Run, four_bar: Callable[..., Path]) -> None:
    file = four_bar(ask=LOADED.format("balance = true\n"))
    assert "not proved" in run("solve", file, "--digits", "20").stderr
