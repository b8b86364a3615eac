"""Every run tries the same examples, however long each takes: the same tree, the same verdict."""

from __future__ import annotations

import gc
import os
import sys
from itertools import chain, zip_longest
from pathlib import Path

import pytest
from hypothesis import settings

from graphkin.__main__ import GARBAGE
from tests.chosen import EVERY

gc.set_threshold(GARBAGE)
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # both as the command line has it

settings.register_profile(
    "same", derandomize=True, database=None, deadline=None, max_examples=200 if EVERY else 50
)
settings.load_profile("same")

if sys.dont_write_bytecode:  # workers and commands compile once, beside the tree, not each anew
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    os.environ["PYTHONPYCACHEPREFIX"] = str(Path(__file__).parents[1] / ".pytest_cache/compiled")

pytest_plugins = ["tests.browser.opening", "tests.browser.firefox", "tests.running"]
WAITING = ("browser",)
"""The rooms whose tests wait for a browser most of their time."""
LONG = ("reading", "golden", "laws", "classroom", "documents", "construction", "web")
"""The rooms whose files take longest of those that compute."""


def pytest_xdist_auto_num_workers() -> int:
    """One worker more than cores: while tests wait for their browsers another computes."""
    return (os.cpu_count() or 1) + 1


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """The long ones come first, so that at the end no core waits for another; files that wait and
    files that compute by turns."""
    root = Path(__file__).parent
    files: dict[Path, list[pytest.Item]] = {}
    for item in items:
        files.setdefault(item.path.relative_to(root), []).append(item)
    waiting = [found for path, found in files.items() if path.parts[0] in WAITING]
    rooms = {name: number for number, name in enumerate(LONG)}
    computing = [found for path, found in files.items() if path.parts[0] not in WAITING]
    computing.sort(key=lambda found: rooms.get(found[0].path.relative_to(root).parts[0], len(LONG)))
    waiting.sort(key=len, reverse=True)
    by_turns = chain.from_iterable(zip_longest(waiting, computing, fillvalue=[]))
    items[:] = chain.from_iterable(by_turns)


def pytest_collection_finish() -> None:
    """Modules and tests stay to the end: no collection of garbage looks through them again."""
    gc.freeze()
