"""Quantities as a sheet prints them: in their written unit, in the language's own way."""

from __future__ import annotations

from graphkin.scene.model import Scene
from graphkin.scene.quantity import Quantity
from graphkin.text import Words

LONGEST = 9
"""Signs of the longest number printed in full among the data."""


def written(scene: Scene, words: Words, quantity: Quantity) -> str:
    """A quantity as printed: in its written unit, in the language's own way."""
    unit = words(f"unit.{quantity.unit}") if words.has(f"unit.{quantity.unit}") else quantity.unit
    text = quantity.written(scene.values)
    if len(text) > LONGEST:
        text = f"{float(text):.{LONGEST - 3}g}"
    return words.decimal(text) + ("" if unit == "°" else " ") + unit
