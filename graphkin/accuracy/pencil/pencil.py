"""A pencil: the errors of its marks and lines, in millimetres of paper and degrees."""

from __future__ import annotations

from enum import Enum
from math import isfinite, log, radians, sqrt
from typing import Any

from msgspec import Struct

from graphkin.construction.core.kind import ByHand, construction
from graphkin.construction.core.program import Plane, Step
from graphkin.construction.higher_class.closure_solver import closer_of
from graphkin.drawing.scale import Scales
from graphkin.numbers.arithmetic import Point, Real, np, turn_by
from graphkin.numbers.plane import Circle, Line, Ratio, Vector
from graphkin.text.errors import Problem, SceneError, message, verbatim

POINT = 0.5
"""The distance in mm within which 95 of 100 marks of a fair drawing lie."""
RADIAL = sqrt(-2 * log(0.05))
"""The radius, in standard deviations of a coordinate, that holds 95 of 100 marks."""
STRAIGHT = 1.959963984540054
"""The two-sided limit, in standard deviations, that holds 95 of 100 numbers."""


class Pencil(Struct, frozen=True):
    """The errors of a pencil, by the limits that 95 of 100 marks and lines keep.

    - ``point`` (mm): 95 of 100 marks lie within this distance of their true place, evenly in all
      directions. A compass opening errs as a mark does along one axis.
    - ``line`` (degrees): 95 of 100 lines have a direction within this angle of theirs. The default
      is a degree for each mm of ``point``: a line as long as a hand then ends about ``point`` off.
    - ``grid`` (mm): marks are rounded to this grid, if it is not zero.

    Errors are Gaussian and independent.
    """

    point: float = POINT
    line: float | None = None
    grid: float = 0.0

    def __post_init__(self) -> None:
        problems = [
            Problem(
                f"pencil.{name}", verbatim(f"{value:g} {unit}"), message("a number, zero or more")
            )
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
        """The angle, in degrees, within which 95 of 100 lines have their direction."""
        return self.point if self.line is None else self.line

    @property
    def mark(self) -> float:
        """Standard deviation of either coordinate of a mark, in mm."""
        return self.point / RADIAL

    @property
    def turn(self) -> float:
        """Standard deviation of the direction of a line, in radians."""
        return radians(self.degrees) / STRAIGHT


# --- the mark of a step
# ----------------------------------------------------------------------------


class PencilMark(Enum):
    """The kinds of marks that a hand makes, each with the number of its independent errors."""

    POINT = "a point, pricked or crossed", 2
    ARROW = "a point laid off from another, along a line that is not drawn by itself", 3
    LINE = "a line through a point", 1
    ARC = "an opening of the compass", 1
    WAY = "a direction", 1
    CLOSING = "the place where a locus closes a group", 1

    def __init__(self, drawn: str, errors: int) -> None:
        self.drawn, self.errors = drawn, errors


def mark_of(step: Step, value: Any) -> PencilMark | None:
    """The mark that a step puts on paper; None if it puts none, or only joins existing points."""
    if closer_of(step) is not None:
        return PencilMark.CLOSING
    if step.plane is Plane.NUMBERS or isinstance(value, Vector):
        return None
    kind = construction(step)
    by_hand = kind.pencil.get(step.role) if kind is not None else None
    if by_hand is ByHand.KNOWN:
        return None
    if isinstance(value, Line):
        return PencilMark.LINE
    if isinstance(value, Circle):
        return PencilMark.ARC
    if isinstance(value, Ratio):
        return PencilMark.POINT
    if not isinstance(value, complex):
        return None
    if by_hand is ByHand.TURNED:
        return PencilMark.WAY
    return PencilMark.POINT if by_hand is None else PencilMark.ARROW


SCALES = (Plane.MECHANISM, Plane.VELOCITIES, Plane.ACCELERATIONS, Plane.FORCES)
"""The drawings in the order of their scales on paper."""


class Paper(Struct, frozen=True):
    """The amount that a metre of paper represents in each plan: m, m/s, m/s², N.

    ``forces`` is zero where no polygon of forces is drawn.
    """

    mechanism: float
    velocities: float
    accelerations: float
    forces: float = 0.0

    @classmethod
    def of(cls, scales: Scales) -> Paper:
        """The paper of some sheets."""
        return cls(scales.kL, scales.kv, scales.ka, scales.kF)

    def millimetre(self, plane: Plane) -> float:
        """The amount that a millimetre of paper represents in a plane."""
        match plane:
            case Plane.VELOCITIES:
                return self.velocities / 1000
            case Plane.ACCELERATIONS:
                return self.accelerations / 1000
            case Plane.FORCES:
                return self.forces / 1000
        return self.mechanism / 1000


def marked(
    mark: PencilMark, value: Any, start: Point, errors: Any, pencil: Pencil, mm: float
) -> Any:
    """A value with the pencil's errors; ``errors`` are columns in standard deviations.

    ``start`` is the point from which an arrow is laid off. ``mm`` is the amount that a millimetre
    of paper represents.
    """
    if mark is PencilMark.LINE:
        return Line(value.point, value.along * turn_by(pencil.turn * errors[:, 0]))
    if mark is PencilMark.WAY:
        return value * turn_by(pencil.turn * errors[:, 0])
    if mark is PencilMark.ARC:
        radius = value.radius + pencil.mark * mm * errors[:, 0]
        return Circle(value.centre, rounded(radius, pencil, mm))
    shift = pencil.mark * mm * (errors[:, 0] + 1j * errors[:, 1])
    if isinstance(value, Ratio):
        return Ratio(value.start + shift, value.shift, value.size)
    if mark is PencilMark.ARROW:
        shift = shift + (value - start) * (turn_by(pencil.turn * errors[:, 2]) - 1)
    return on_grid(value + shift, pencil, mm)


def rounded(value: Real, pencil: Pencil, mm: float) -> Real:
    """A length rounded to the pencil's grid, if it has one."""
    if not pencil.grid:
        return value
    step = pencil.grid * mm
    return np.rint(value / step) * step


def on_grid(point: Point, pencil: Pencil, mm: float) -> Point:
    """A point rounded to the pencil's grid, if it has one."""
    if not pencil.grid:
        return point
    return rounded(point.real, pencil, mm) + 1j * rounded(point.imag, pencil, mm)
