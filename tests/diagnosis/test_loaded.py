"""A command loads the libraries that it needs, and none that it does not, in a fresh process."""

from __future__ import annotations

import subprocess
import sys

import pytest

from tests.diagnosis.scope import FILES, ROOT

HEAVY = (
    "numpy",
    "shapely",
    "matplotlib",
    "reportlab",
    "svgwrite",
    "jinja2",
    "pikepdf",
    "numba",
    "flint",
    "mpmath",
    "sympy",
    "scipy",
)
HOUSE = (
    "graphkin.loops",
    "graphkin.drawing.labels",
    "graphkin.motion.course",
    "graphkin.motion.curves",
)
"""Rooms that only some commands enter."""


def loaded(*words: str) -> tuple[set[str], set[str]]:
    """The heavy libraries, and the rooms of the house, that a command has loaded at its end."""
    code = (
        "import sys, io, contextlib\n"
        "from graphkin.cli.main import app\n"
        "with contextlib.redirect_stdout(io.StringIO()):\n"
        f"    try: app({list(words)!r})\n"
        "    except SystemExit as left: assert not left.code, left.code\n"
        "print(*sys.modules)"
    )
    ran = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert ran.returncode == 0, ran.stderr
    modules = set(ran.stdout.split())
    return modules & set(HEAVY), modules & set(HOUSE)


PAGE = {"numpy", "shapely", "svgwrite"}
CASES = [
    (("--help",), set(), set()),
    (("list",), set(), set()),
    # what a user waits for is timed: the check and a page too
    (("explain", "pump"), PAGE, {"graphkin.loops", "graphkin.drawing.labels"}),
    (
        ("explain", "{oscillating-slide}", "--json"),
        PAGE,
        {"graphkin.loops", "graphkin.drawing.labels"},
    ),
    # the witness solves its loops as matrices
    (("solve", "pump", "--asked"), {"numpy"}, {"graphkin.loops"}),
    (("solve", "pump", "--asked", "--json"), {"numpy"}, {"graphkin.loops"}),
    (("solve", "pump"), {"numpy"}, {"graphkin.loops"}),
    (("check", "pump", "--set", "n=7"), {"numpy"}, {"graphkin.loops", "graphkin.motion.course"}),
]


@pytest.mark.parametrize(
    ("words", "libraries", "rooms"), CASES, ids=[" ".join(case[0]) for case in CASES]
)
def test_a_command_loads_what_it_needs(words, libraries, rooms):
    named = [word.format(**FILES) if "{" in word else word for word in words]
    assert loaded(*named) == (libraries, rooms)
