"""What every test in a browser opens its pages with."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from graphkin.studio.server import Served, serve
from tests.studio.pump import desk_in, running


@pytest.fixture
def served(tmp_path: Path) -> Iterator[Served]:
    """A studio that runs in an own folder, in English."""
    session = desk_in(tmp_path)
    session.language = "en"
    with running(serve(session)) as found:
        yield found
