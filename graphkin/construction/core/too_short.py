"""What is too short to be drawn: one rule for marks, sentences, and what calculations say of it."""

from __future__ import annotations

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.naming import drawn_in
from graphkin.construction.core.program import Plane
from graphkin.construction.core.quantities import in_mm

TINY = 0.5
"""Vectors shorter than this, in mm, are named at the foot of their field."""
NEAR = 0.3
"""A thin line between two points of a plan that is shorter than this, in mm, is not drawn."""


def is_short(drawing: Drawing, size: float, plane: Plane) -> bool:
    """True for a vector of a plan, by its magnitude, that is too short to be drawn."""
    return drawn_in(drawing, plane, abs(size)) < TINY


def laid_off(drawing: Drawing, key: str, size: float, **fields: str) -> str:
    """Which way a computed vector is laid off and how long it is drawn, or that it is too short.

    Nothing of one that is nought.
    """
    if size == 0:
        return ""
    short = "_short" if is_short(drawing, size, drawing.plane) else ""
    drawn = in_mm(drawing.words, drawn_in(drawing, drawing.plane, size))
    return drawing.words(f"calculation.{key}{short}", drawn=drawn, **fields)
