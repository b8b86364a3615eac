"""Scenes from their text, and their loops closed from rough positions."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import pytest

from graphkin.loops.equations import equations
from graphkin.loops.newton import LoopSolution, solve
from graphkin.scene.model import Scene
from graphkin.scene.read_scene import read_scene, read_text

SHEETS = Path(__file__).parents[2] / "sheets"
HEAD = """graphkin = 1
title = "test"
units = { length = "m", angle = "deg", speed = "rad/s" }
"""
ROUGH = {"A": 0.21 + 0.21j, "B": -0.115 - 0.015j, "C": 0.13 + 0.03j, "D": 0.335 + 0.005j}


@pytest.fixture
def read() -> Callable[..., Scene]:
    """A scene in metres, degrees and rad/s from the rest of its text."""

    def reader(text: str, **settings: object) -> Scene:
        return read_text(HEAD + text, "test", None, settings)

    return reader


@pytest.fixture
def sheet() -> Callable[..., Scene]:
    """A scene that is shipped."""

    def reader(name: str, **settings: object) -> Scene:
        return read_scene(SHEETS / name / "scene.toml", settings)

    return reader


@pytest.fixture
def pump_start() -> dict[str, complex]:
    """The pump at n = 7, read off a drawing to about a centimetre."""
    return ROUGH


@pytest.fixture
def solved() -> Callable[..., LoopSolution]:
    """The loops of a scene closed from rough positions."""

    def solver(
        scene: Scene, values: Mapping[str, Any] | None = None, **start: complex
    ) -> LoopSolution:
        slides = {name[1:]: s.real for name, s in start.items() if name.startswith("_")}
        places = {name: z for name, z in start.items() if not name.startswith("_")}
        return solve(equations(scene, values), places, slides)

    return solver
