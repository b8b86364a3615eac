"""Commands that take seconds say on a terminal how far they are, and nothing elsewhere."""

from __future__ import annotations

import os
import pty
import subprocess
import sys
from pathlib import Path

import pytest


def on_terminal(folder: Path, *words: str) -> str:
    """What a command writes to standard error where that is a terminal."""
    ours, theirs = pty.openpty()
    command = [sys.executable, "-m", "graphkin", *words]
    with subprocess.Popen(
        command, cwd=folder, stdout=subprocess.DEVNULL, stderr=theirs, stdin=subprocess.DEVNULL
    ) as running:
        os.close(theirs)
        parts = list[bytes]()
        while True:
            try:
                part = os.read(ours, 65536)
            except OSError:  # the end of a terminal whose other side is closed
                break
            if not part:
                break
            parts.append(part)
        assert running.wait() == 0
    os.close(ours)
    return b"".join(parts).decode()


@pytest.mark.parametrize(
    ("command", "stages"),
    [
        ("cycle pump --format gif", ["looking for extremes in 219 rows", "drawing picture 2 of "]),
        ("cycle pump --format svg", ["holding 219 rows to the vector loops", "drawing the curves"]),
        ("ranges pump", ["trying variants"]),
        ("new lab mine --from pump", ["trying variants", "ranges have room"]),
    ],
)
def test_a_terminal_shows_how_far_a_command_is(tmp_path, command, stages):
    shown = on_terminal(tmp_path, *command.split())
    for stage in stages:
        assert stage in shown
    assert shown.endswith("\r\x1b[K")


def test_a_file_of_errors_stays_empty(tmp_path):
    command = [sys.executable, "-m", "graphkin", "cycle", "pump", "--format", "svg"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert done.stderr == ""
