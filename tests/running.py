"""Running the commands, in this process or in one of their own."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from graphkin.cli.main import app

ROOT = Path(__file__).resolve().parents[1]
Run = Callable[..., Result]


def ran(*args: object) -> Result:
    """Run a command in this process: ran("solve", "pump")."""
    return CliRunner().invoke(app, [str(arg) for arg in args])


@pytest.fixture
def run() -> Run:
    """The same, for a test."""
    return ran


def command(*args: str, **env: str) -> subprocess.CompletedProcess[bytes]:
    """Run the command line in a process of its own, its output as bytes."""
    return python("-m", "graphkin", *args, **env)


def python(*args: str, **env: str) -> subprocess.CompletedProcess[bytes]:
    """Run Python in a process of its own on this checkout."""
    surroundings = {**os.environ, "PYTHONPATH": str(ROOT), **env}
    return subprocess.run(
        [sys.executable, *args], env=surroundings, capture_output=True, check=False
    )


DIES = """
import os, pathlib, signal, sys
rename, left = pathlib.Path.replace, [int(sys.argv[1])]
def dying(path, target):
    left[0] -= 1
    if not left[0]:
        os.kill(os.getpid(), signal.SIGKILL)
    return rename(path, target)
pathlib.Path.replace = dying
from graphkin.cli.main import app
app(sys.argv[2:])
"""


def killed_at(rename: int, *args: object) -> None:
    """Run the command line in a process that is killed as it puts a file in its place."""
    found = python("-c", DIES, str(rename), *map(str, args))
    assert found.returncode == -signal.SIGKILL
