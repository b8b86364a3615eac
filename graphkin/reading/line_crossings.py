"""Where drawn lines cross, and how well that is known."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from typing import Any

import numpy as np
from msgspec import Struct

from graphkin.reading.drawn_ink import PAPER, InkLine

CROSSING = 0.12
"""Least sine of the angle at which lines cross that give a point."""
PASSES = 0.45
"""A line passes through a point that lies so many mm beside it at most."""


class LinesCrossing(Struct, frozen=True):
    """A place where lines cross: its covariance, and how many lines and how well they are there.

    ``ends`` tells that a single line ends there.
    """

    place: complex
    error: Any
    count: int
    cover: float
    ends: bool = False


def met(one: InkLine, other: InkLine) -> complex | None:
    """Where two lines meet; None where they cross too flatly."""
    if abs(sine(one.way, other.way)) < CROSSING:
        return None
    along = ((other.start - one.start) * other.way.conjugate()).imag / (
        (one.way * other.way.conjugate()).imag
    )
    return one.start + along * one.way


def sine(one: complex, other: complex) -> float:
    """The sine of the angle between two ways."""
    return (one.conjugate() * other).imag / abs(one) / abs(other)


def are_crossing(ends: Sequence[complex], place: complex) -> bool:
    """Whether some of the ways from some ends to a place cross there."""
    ways = [end - place for end in ends]
    return any(abs(sine(*both)) > CROSSING for both in combinations(ways, 2))


def along_way(way: complex, along: float, across: float) -> Any:
    """The covariance of a place that is known so well along a direction, and so well across it."""
    turned = np.array([[way.real, -way.imag], [way.imag, way.real]])
    return turned @ np.diag([along**2, across**2 + PAPER**2 / 2]) @ turned.T


def distinct(lines: list[list[InkLine]], place: complex) -> list[list[InkLine]]:
    """The lines of what leads to a point, those that were found twice only once."""
    kept: list[list[InkLine]] = []
    seen: list[InkLine] = []
    for some in lines:
        fresh = [line for line in some if not any(is_same(line, other, place) for other in seen)]
        seen += fresh
        if fresh:
            kept.append(fresh)
    return kept


def is_same(one: InkLine, other: InkLine, place: complex) -> bool:
    """Whether two lines are the same stroke about a place."""
    turn = abs(np.angle(one.way / other.way))
    flat = min(turn, np.pi - turn) < np.radians(1.2)
    return bool(flat and abs(abs(one.off(place)) - abs(other.off(place))) < 0.3)


def through(
    place: complex, lines: Sequence[Sequence[InkLine]], within: float = PASSES
) -> LinesCrossing | None:
    """The place nearest to all lines that pass through about a place, one of each."""
    chosen = []
    for some in lines:
        near = [line for line in some if abs(line.off(place)) < within and line.cover >= 0.5]
        if near:
            chosen.append(max(near, key=lambda line: line.cover - abs(line.off(place))))
    if len(chosen) < 2:
        return None
    normals = np.array([[-line.way.imag, line.way.real] for line in chosen])
    offs = np.array([line.off(place) for line in chosen])
    trust = 1 / np.array([line.error for line in chosen]) ** 2
    normal_matrix = (normals * trust[:, None]).T @ normals
    if np.linalg.eigvalsh(normal_matrix)[0] < trust.min() * CROSSING**2 / 2:
        return None
    shift = np.linalg.solve(normal_matrix, -(normals * trust[:, None]).T @ offs)
    error = np.linalg.inv(normal_matrix) + np.eye(2) * PAPER**2 / 2
    cover = float(np.mean(sorted((line.cover for line in chosen), reverse=True)[:2]))
    return LinesCrossing(place + complex(*shift), error, len(chosen), cover)
