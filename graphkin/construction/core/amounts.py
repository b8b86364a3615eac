"""Quantities as a sheet prints them: in their written unit, in the language's own way."""

from __future__ import annotations

from math import degrees
from typing import NewType

from graphkin.scene.model import Scene
from graphkin.scene.quantity import Quantity
from graphkin.text import Words

OnPaper = NewType("OnPaper", float)
"""A length as it is drawn, in mm of paper; a length of the mechanism is a float, in metres."""
LONGEST = 9
"""Signs of the longest number printed in full among the data."""


def in_degrees(scene: Scene, words: Words, quantity: Quantity) -> str:
    """An angle that is written in radians as a protractor shows it; nothing for any other."""
    if quantity.unit != "rad":
        return ""
    return f"{words.fixed(degrees(float(quantity.si(scene.values))), 2)}°"


def in_mm(words: Words, length: OnPaper) -> str:
    """A drawn length in mm as it is written: one that no ruler shows as less than what one does."""
    under = f"<\N{NO-BREAK SPACE}{words.fixed(0.01, 2)}"
    return under if 0 < abs(length) < 0.005 else words.fixed(length, 2)


def written(scene: Scene, words: Words, quantity: Quantity) -> str:
    """A quantity as printed: in its written unit, in the language's own way."""
    unit = words(f"unit.{quantity.unit}") if words.has(f"unit.{quantity.unit}") else quantity.unit
    return number_of(scene, words, quantity) + ("" if unit == "°" else " ") + unit


def number_of(scene: Scene, words: Words, quantity: Quantity) -> str:
    """A quantity as printed, without its unit; a long number to as many digits as a hand needs."""
    text = quantity.written(scene.values)
    if len(text) > LONGEST:
        text = f"{float(text):.{LONGEST - 3}g}"
    return words.decimal(text)
