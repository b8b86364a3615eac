"""pyproject.toml names the lowest version of every library; python -m tests.lowest tries them."""

from __future__ import annotations

import pytest

from tests.lowest.__main__ import ROOT, lowest

PYPROJECT = (ROOT / "pyproject.toml").read_text(encoding="utf-8")


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
