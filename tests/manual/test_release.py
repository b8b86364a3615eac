"""A release is one: its version, its extras and its container name the same things everywhere."""

from __future__ import annotations

import re
import tomllib

from graphkin import __version__
from tests.manual.made import MANUAL, ROOT

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def text_of(name: str) -> str:
    return (ROOT / name).read_text(encoding="utf-8")


def test_one_version_everywhere() -> None:
    assert PROJECT["version"] == __version__
    assert re.findall(r"^## (\S+)", text_of("CHANGELOG.md"), re.MULTILINE)[0] == __version__
    assert re.findall(r"version (\d[\d.]*\d)", text_of("README.md")) == [__version__]


def test_the_extras_that_are_explained_are_those_that_exist() -> None:
    ours = {*PROJECT["optional-dependencies"]} - {"test", "dev"}
    page = (MANUAL / "howto" / "install.md").read_text(encoding="utf-8")
    assert {*re.findall(r"^\| `(\w+)`", page, re.MULTILINE)} == ours
    for text in (page, text_of("README.md"), text_of(".github/Containerfile")):
        named = re.findall(r"'(?:\.|/source)\[([\w,]+)\]'", text)
        assert named
        assert {extra for each in named for extra in each.split(",")} <= ours | {"test"}


def test_the_container_holds_what_the_wheel_is_made_of() -> None:
    kept = re.findall(r"^!(.+)$", text_of(".github/Containerfile.dockerignore"), re.MULTILINE)
    assert {"graphkin", "sheets", "examples", "pyproject.toml", PROJECT["readme"]} <= {*kept}
    assert all((ROOT / name).exists() for name in kept)
