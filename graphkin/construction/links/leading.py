"""The kinds of pairs that lead a point of a link along a line of a known one."""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphkin.construction.guides.led_block import LedBlock
from graphkin.structure.pairs import Leading, Sliding

if TYPE_CHECKING:
    from graphkin.construction.rolling.led_wheel import LedWheel


def led_by(pair: Leading) -> LedBlock | LedWheel:
    """What a pair with a known link gives in each drawing."""
    if isinstance(pair, Sliding):
        return LedBlock(pair)
    from graphkin.construction.rolling.led_wheel import LedWheel

    return LedWheel(pair)
