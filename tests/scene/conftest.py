"""Scenes of the format's own description, and a way to read them changed at one place."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from graphkin.scene.model import Link, Scene
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import Problem, SceneError
from tests.scene_files import scene_text

DATA = Path(__file__).parent / "data"
HEAD = scene_text("scene/head")
DRIVER = """
[[drivers]]
turn = "crank"
angle = 0
speed = 60
"""


@pytest.fixture
def data() -> Path:
    return DATA


@pytest.fixture
def changed() -> Callable[..., Scene]:
    """The pump with one piece of its text replaced, read with settings."""

    def read(old: str = "", new: str = "", scene: str = "pump", **settings: object) -> Scene:
        text = (DATA / f"{scene}.toml").read_text(encoding="utf-8")
        assert old in text
        return read_text(text.replace(old, new, 1), "pump", None, settings)

    return read


@pytest.fixture
def problems(changed: Callable[..., Scene]) -> Callable[..., list[Problem]]:
    """The problems found in the pump with one piece of its text replaced."""

    def find(
        old: str = "", new: str = "", scene: str = "pump", **settings: object
    ) -> list[Problem]:
        with pytest.raises(SceneError) as caught:
            changed(old, new, scene, **settings)
        return list(caught.value.problems)

    return find


@pytest.fixture
def problem(problems: Callable[..., list[Problem]]) -> Callable[..., Problem]:
    """The one problem found in the pump with one piece of its text replaced."""

    def find(*args: str, **settings: object) -> Problem:
        found = problems(*args, **settings)
        assert len(found) == 1, "\n".join(map(str, found))
        return found[0]

    return find


@pytest.fixture
def crank() -> Callable[[str], Link]:
    """A single link whose points are given by the keys of a text."""

    def read(keys: str) -> Link:
        return read_text(f"{HEAD}[links.crank]\n{keys}\n{DRIVER}", "crank").links["crank"]

    return read


@pytest.fixture
def broken_crank() -> Callable[[str], list[Problem]]:
    """The problems of a single link whose points are given by the keys of a text."""

    def find(keys: str) -> list[Problem]:
        with pytest.raises(SceneError) as caught:
            read_text(f"{HEAD}[links.crank]\n{keys}\n{DRIVER}", "crank")
        return list(caught.value.problems)

    return find
