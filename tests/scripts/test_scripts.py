"""The scripts of the pages: modules checked by tools of Node, and bundles made from them."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from graphkin.construction.registry import BOARD, PALETTE
from graphkin.web.offline_page import BUNDLES, WEB
from tests.browser.opening import missing
from tests.scripts.actions import FILES, modules
from tests.scripts.node import HERE, TOOLS, missing_tools, ran

LONGEST = 400
"""Most lines of a module."""
CHECKS = {
    "format": ("prettier", "--check", *("graphkin/**/*.js", "tests/scripts/*.{js,ts}")),
    "lint": ("eslint", "--max-warnings=0", "graphkin", "tests/scripts"),
    "types": ("tsc", "-p", "tests/scripts/tsconfig.json"),
    "strict types": ("tsc", "-p", "tests/scripts/tsconfig.strict.json"),
    "types of a task page": ("tsc", "-p", "tests/scripts/tsconfig.board.json"),
}
"""The checks by Node's tools."""
CONFIGURED = {
    "prettier": (
        *("--config", str(HERE / ".prettierrc.json")),
        *("--ignore-path", str(HERE / ".prettierignore")),
    ),
    "eslint": ("--config", str(HERE / "eslint.config.js")),
    "tsc": (),
}


@pytest.fixture(scope="module")
def node() -> None:
    """Node with its tools: without them a test is skipped, or fails where browsers are a must."""
    if missing_tools():
        missing(missing_tools())


@pytest.mark.parametrize("check", CHECKS)
@pytest.mark.usefixtures("node")
def test_the_scripts_hold_to_the_rules(check: str):
    tool, *rest = CHECKS[check]
    found = ran(shutil.which(tool, path=TOOLS) or tool, *CONFIGURED[tool], *rest)
    assert found.returncode == 0, found.stdout + found.stderr


@pytest.mark.usefixtures("node")
def test_the_tests_of_the_modules_pass():
    found = ran("node", "--test", *map(str, sorted(HERE.glob("*.test.js"))))
    assert found.returncode == 0, found.stdout + found.stderr
    assert "# fail 0" in found.stdout and "# pass 0" not in found.stdout


@pytest.mark.usefixtures("node")
def test_the_bundles_are_made_from_the_modules(tmp_path: Path):
    found = ran("node", str(HERE / "build.js"), str(tmp_path))
    assert found.returncode == 0, found.stderr
    made = {path.name: path.read_text(encoding="utf-8") for path in tmp_path.iterdir()}
    kept = {path.name: path.read_text(encoding="utf-8") for path in BUNDLES.iterdir()}
    assert made == kept, "run python -m tests.scripts"


def test_the_actions_of_the_pages_are_those_of_the_registry():
    assert FILES == {"page_actions.js": PALETTE, "board_actions.js": BOARD}
    for name, text in modules().items():
        assert (WEB / name).read_text(encoding="utf-8") == text, "run python -m tests.scripts"


def test_modules_are_short_and_say_first_what_they_hold():
    for path in WEB.glob("*.js"):
        lines = path.read_text(encoding="utf-8").splitlines()
        assert len(lines) <= LONGEST, path.name
        assert lines[0].startswith("// "), path.name


def test_the_locked_tools_name_no_host():
    assert '"resolved"' not in (HERE / "package-lock.json").read_text(encoding="utf-8")
