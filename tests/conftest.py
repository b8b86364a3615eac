"""Every run tries the same examples, however long each takes: the same tree, the same verdict."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import settings

from tests.chosen import EVERY

settings.register_profile(
    "same", derandomize=True, database=None, deadline=None, max_examples=200 if EVERY else 50
)
settings.load_profile("same")

LONG = ("browser", "reading", "web", "classroom", "golden", "documents")
"""The rooms whose files take longest, for few tests of theirs."""


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """The long ones come first, so that at the end no core waits for another."""
    rooms = {name: number for number, name in enumerate(LONG)}
    root = Path(__file__).parent
    items.sort(key=lambda item: rooms.get(item.path.relative_to(root).parts[0], len(LONG)))
