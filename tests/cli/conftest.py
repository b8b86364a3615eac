"""A four-bar with numbers of one's own."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

FOUR_BAR = """
graphkin = 1
title = "Four-bar"
units = {{ length = "mm", angle = "deg", speed = "rad/s" }}
[parameters]
rocker = {rocker}
[frame]
O1 = [0, 0]
O2 = [{base}, 0]
[links.1]
O1-A = {crank}
[links.2]
A-B = {coupler}
[links.3]
O2-B = "rocker"
[[drivers]]
turn = 1
angle = {angle}
speed = {speed}
{driver}
[branches]
B = "left of A-O2"
[ask]
{ask}
"""
USUAL = {"rocker": 60, "base": 80, "crank": 30, "coupler": 70, "angle": 60, "speed": 2}


@pytest.fixture
def four_bar(tmp_path: Path) -> Callable[..., Path]:
    """Write a four-bar with some numbers of its own: four_bar(angle=0, ask='velocity = ["B"]')."""

    def written(ask: str = 'velocity = ["B"]', driver: str = "", **numbers: object) -> Path:
        path = tmp_path / "four.toml"
        text = FOUR_BAR.format(ask=ask, driver=driver, **(USUAL | numbers))
        path.write_text(text, encoding="utf-8")
        return path

    return written
