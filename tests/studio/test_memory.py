"""Moving a slider for long holds no more than moving it for short."""

from __future__ import annotations

import gc
import tracemalloc

from graphkin.studio.look import Sight, look
from graphkin.studio.panels import Memory
from tests.studio.pump import PUMP

KEPT = 100_000
"""Bytes that may be held more after the moves: those of two answers, where none is to be kept."""
NUMBERS = ("3", "19")


def moved(memory: Memory, times: int) -> int:
    """Bytes held after moving over some numbers, so many times."""
    for number in NUMBERS * times:
        settings = {"n": number}
        look(Sight(PUMP, "pump", "en", settings, quick=True), memory, lambda: None)
    gc.collect()
    return tracemalloc.get_traced_memory()[0]


def test_moves_leave_nothing_behind():
    memory = Memory()
    look(Sight(PUMP, "pump", "en"), memory, lambda: None)
    tracemalloc.start()
    try:
        moved(memory, 2)  # caches fill
        first, second = moved(memory, 1), moved(memory, 4)
    finally:
        tracemalloc.stop()
    assert second - first < KEPT
    assert len(memory.seats) == len(memory.edges) == 3
