"""Mechanisms that several of these tests need."""

from __future__ import annotations

import pytest

from graphkin.mechanism import Mechanism
from tests.mechanisms import mechanism_of
from tests.scene_files import scene_text

TOUCHING = scene_text("numbers/touching")


@pytest.fixture
def touching() -> Mechanism:
    """A crank that points at a pivot, as far from it as two bars together are long."""
    return mechanism_of(TOUCHING)
