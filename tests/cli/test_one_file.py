"""Commands that write one file: never over what they read, never in place of a device."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.running import Run


def test_a_scene_is_not_replaced_by_what_is_made_from_it(
    run: Run, four_bar: Callable[..., Path]
) -> None:
    scene = four_bar()
    before = scene.read_bytes()
    for made in (scene, scene.parent / "." / scene.name):
        result = run("export", scene, "--to", "c", "-o", made, "--force")
        assert result.exit_code == 2
        assert "is the file that is read" in result.stderr
        assert scene.read_bytes() == before


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes on this system")
@pytest.mark.parametrize("more", [(), ("--force",)])
def test_a_file_that_is_no_ordinary_one_stays(
    run: Run, tmp_path: Path, more: tuple[str, ...]
) -> None:
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    result = run("export", "pump", "--to", "c", "-o", pipe, *more)
    assert result.exit_code == 2
    assert "is no ordinary file" in result.stderr
    assert pipe.is_fifo()
