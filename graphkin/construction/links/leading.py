"""The kinds of pairs that lead a point of a link along a line of a known one."""

from __future__ import annotations

from graphkin.construction.guides.led_block import LedBlock
from graphkin.construction.rolling.led_wheel import LedWheel
from graphkin.structure.pairs import Leading, Sliding


def led_by(pair: Leading) -> LedBlock | LedWheel:
    """What a pair with a known link gives in each drawing."""
    return LedBlock(pair) if isinstance(pair, Sliding) else LedWheel(pair)
