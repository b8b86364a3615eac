"""How much of the curves over a whole motion a drawing makes room for."""

from __future__ import annotations

from collections.abc import Sequence

from graphkin.construction.core.solution import Curve
from graphkin.drawing.scale import Extent, extent_of
from graphkin.numbers.plane import cross

ROOMY = 3.5
"""A curve so many mechanisms wide, or less, is drawn whole; of a wider one only what fits."""
INWARD = 0.96
"""What of a path there is room for, in parts: its ends, which bear no letters, may stand in the
margin that those of the mechanism need."""
STRAIGHT = 1e-6
"""How far aside, in parts of its length, a curve may lead that counts as straight."""


def shown(curves: Sequence[Curve], mechanism: Extent) -> list[complex]:
    """The points of curves for which the drawing makes room.

    Curves of the mechanism's size are drawn whole; of a wider path what is about the mechanism, of
    wider centrodes, and of straight ones, where they touch. Of a locus what lies in the field
    will do.
    """
    found: list[complex] = []
    most = ROOMY * max(mechanism.width, mechanism.height)
    for curve in curves:
        if curve.kind == "locus":
            continue
        points = [point for run in curve.runs for point in run]
        box = extent_of(points) if points else mechanism
        is_wide = max(box.width, box.height) > most
        if curve.kind == "trajectory":
            if is_wide:
                points = [each for each in points if abs(each - mechanism.middle) <= most / 2]
            middle = mechanism.grown(points).middle
            found += [middle + INWARD * (point - middle) for point in points]
        elif not is_wide and not is_straight(points):
            found += points
        elif curve.now is not None and abs(curve.now - mechanism.middle) <= most:
            found.append(curve.now)
    return found


def is_straight(points: Sequence[complex]) -> bool:
    """Whether points all lie on one line."""
    if len(points) < 2:
        return False
    start, far = points[0], max(points, key=lambda point: abs(point - points[0]))
    aside = (abs(cross(far - start, point - start)) for point in points)
    return bool(max(aside) <= STRAIGHT * abs(far - start) ** 2)
