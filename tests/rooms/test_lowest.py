"""pyproject.toml names the lowest version of every library; python -m tests.lowest tries them."""

from __future__ import annotations

import re
import tomllib

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name
from packaging.version import Version

from tests.lowest.__main__ import EXTRAS, ROOT, lowest

PYPROJECT = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
LOCK = (ROOT / "tests" / "requirements.lock").read_text(encoding="utf-8").splitlines()


def test_every_library_that_users_install_has_a_lowest_version() -> None:
    found = lowest(PYPROJECT)
    assert {"click", "matplotlib", "reportlab", "openpyxl", "numba", "waitress"} <= found.keys()
    assert all(version[0].isdigit() for version in found.values())


@pytest.mark.parametrize("written", ["click", "click==8.1.7", "click>=8.1.7,<9"])
def test_a_library_without_one_is_told(written: str) -> None:
    with pytest.raises(ValueError, match="no lowest version"):
        lowest(PYPROJECT.replace("click>=8.1.7", written))


def test_ci_tries_them() -> None:
    assert "-m tests.lowest" in (ROOT / ".ci" / "run").read_text(encoding="utf-8")


def test_every_extra_that_users_install_is_tried() -> None:
    extras = tomllib.loads(PYPROJECT)["project"]["optional-dependencies"]
    assert {*EXTRAS} == {*extras} - {"test", "dev"}


def test_the_lock_names_one_version_of_each_library_that_is_asked_for() -> None:
    """By name and version alone: no address and no path of the machine on which it was made."""
    pinned = dict(re.fullmatch(r"([\w.-]+)==([\w.]+)", line).groups() for line in LOCK[1:])
    versions = {canonicalize_name(name): Version(version) for name, version in pinned.items()}
    assert len(versions) == len(LOCK) - 1
    project = tomllib.loads(PYPROJECT)["project"]
    optional = project["optional-dependencies"].values()
    named = map(Requirement, [*project["dependencies"], *(r for each in optional for r in each)])
    for each in named:
        if each.name != "graphkin":
            assert versions[canonicalize_name(each.name)] in each.specifier, each.name


def test_each_licence_of_what_is_shipped_is_named() -> None:
    project = tomllib.loads(PYPROJECT)["project"]
    files = [path for pattern in project["license-files"] for path in ROOT.glob(pattern)]
    assert len(files) == 4
    told = {
        "MIT": "MIT License",
        "OFL-1.1": "SIL Open Font License, Version 1.1",
        "Bitstream-Vera": "Bitstream Vera",
    }
    assert project["license"] == " AND ".join(told)
    for path in files:
        text = path.read_text(encoding="utf-8")
        assert any(words in text for words in told.values()), path.name
