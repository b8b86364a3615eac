"""How far a link has turned whose pins leave whole turns open, though wheels depend on them."""

from __future__ import annotations

from typing import ClassVar

from graphkin.construction.core.kind import Construction
from graphkin.construction.core.program import Step
from graphkin.construction.core.vocabulary import action
from graphkin.numbers.arithmetic import Point, Real, at, below, phase, pick

ROUND = 1e-9
"""Radians by which rounding may put half a turn on its other side."""


@action("counted-near")
def counted_near(axis: Point, heading: Point, angle: Real) -> Real:
    """The angle in radians of an axis, within half a turn of that of a heading.

    An axis turned just half round from it, but for rounding, has turned ahead and not back.
    """
    return angle + turned_ahead(axis * heading.conjugate())


def turned_ahead(way: Point) -> Real:
    """The angle of a direction: half a turn back, but for rounding, is half a turn ahead."""
    size = abs(way)
    quarter = phase(at(size * 0.0, size))
    since = phase(way)
    return pick(below(since, ROUND - 2 * quarter), since + 4 * quarter, since)


class CountedTurn(Construction, frozen=True, kw_only=True):
    """The ``turn`` of a ``link`` whose pins leave whole turns open, within half a turn of an angle.

    Two steps hold that angle: its ``heading`` and its ``radians``.
    """

    gives: ClassVar[tuple[str, ...]] = ("turn",)

    link: str
    heading: int
    radians: int
    turn: int


def counted_link(step: Step) -> str | None:
    """The link whose whole turns a step says, its pins leaving them open; None for other steps."""
    return step.of.link if isinstance(step.of, CountedTurn) else None
