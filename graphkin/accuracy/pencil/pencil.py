"""A pencil: how far its marks and lines lie from where they belong, in millimetres of paper."""

from __future__ import annotations

from math import isfinite, log, radians, sqrt

from msgspec import Struct

from graphkin.text.errors import Problem, SceneError

POINT = 0.5
"""Millimetres within which 95 of 100 marks of a fair drawing lie."""
RADIAL = sqrt(-2 * log(0.05))
"""Within so many standard deviations of either coordinate lie 95 of 100 points of the plane."""
STRAIGHT = 1.959963984540054
"""Within so many standard deviations lie 95 of 100 numbers, to both sides."""


class Pencil(Struct, frozen=True):
    """Of 100 marks 95 lie within ``point`` mm of where they belong, evenly in all directions; of
    100 lines 95 have a direction within ``line`` degrees of theirs.

    Errors are Gaussian and independent. A compass opening errs as a mark does along one axis.
    ``line`` is a degree for each mm of ``point`` where it is not stated: a line a hand long ends
    about a point's error off. Marks are rounded to a ``grid`` of so many mm, if there is one.
    """

    point: float = POINT
    line: float | None = None
    grid: float = 0.0

    def __post_init__(self) -> None:
        problems = [
            Problem(f"pencil.{name}", f"{value:g} {unit}", "a number, zero or more")
            for name, value, unit in (
                ("point", self.point, "mm"),
                ("line", self.degrees, "degrees"),
                ("grid", self.grid, "mm"),
            )
            if not (isfinite(value) and value >= 0)
        ]
        if problems:
            raise SceneError(problems)

    @property
    def degrees(self) -> float:
        """The angle within which 95 of 100 lines have their direction."""
        return self.point if self.line is None else self.line

    @property
    def mark(self) -> float:
        """Standard deviation of either coordinate of a mark, in mm."""
        return self.point / RADIAL

    @property
    def turn(self) -> float:
        """Standard deviation of the direction of a line, in radians."""
        return radians(self.degrees) / STRAIGHT
