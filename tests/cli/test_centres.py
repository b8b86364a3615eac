"""Relative centres and inflection circles in what solve reports."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.running import Run


def solved(run: Run, *args: object) -> Any:
    """The JSON of solve."""
    result = run("solve", *args, "--json")
    assert result.exit_code == 0, result.stderr
    return json.loads(result.stdout)


def test_a_relative_centre_at_infinity_is_null_and_said_in_words(
    run: Run, four_bar: Callable[..., Path]
) -> None:
    path = four_bar(ask='centres = "all"', coupler=80, rocker=30)
    assert solved(run, path)["centres"]["0-2"] is None
    text = run("solve", path).stdout
    line = next(line for line in text.splitlines() if line.startswith("0 and 2"))
    assert line.endswith("at infinity, in direction 60.0000°")


@pytest.mark.parametrize("args", [(), ("--asked",)])
def test_the_inflection_circle_has_pole_centre_and_radius(
    run: Run, four_bar: Callable[..., Path], args: tuple[str, ...]
) -> None:
    path = four_bar(ask="inflection = [2]")
    link = solved(run, path, *args)["links"]["2"]
    circle = link["inflection"]
    pole, centre = (complex(*circle[key]) for key in ("pole", "centre"))
    assert abs(pole - centre) == pytest.approx(circle["radius"], rel=1e-12)
    instant = solved(run, path)["links"]["2"]["instant_centre"]
    assert 2 * centre - pole == pytest.approx(complex(*instant), rel=1e-12)
    assert "inflection pole, m" in run("solve", path).stdout
