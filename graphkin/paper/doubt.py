"""Leaders for labels that could be read as naming a neighbour: nearer to it than to their own."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from graphkin.paper.field import XY, clipped
from graphkin.paper.marks import Line, Mark, Polyline
from graphkin.paper.place import CLEAR, Spot
from graphkin.paper.symbols import VECTORS

if TYPE_CHECKING:
    from graphkin.paper.labels import Label

MARGIN = 0.3
"""How much nearer a neighbour may be, in mm, before a label gets a leader."""
LEAST = MARGIN + CLEAR - 0.1
"""A label no farther from its own segment, in mm, is nearest to it: none is so near to a line."""


def with_leaders(
    labels: Sequence[Label], spots: Sequence[Spot], marks: Sequence[Mark]
) -> list[Spot]:
    """The places of labels, with a leader for each doubtful one that can have one."""
    found = list(spots)
    doubtful = doubtful_ones(labels, spots, marks)
    if doubtful:
        areas = [label.area(spot) for label, spot in zip(labels, spots, strict=True)]
    for i in doubtful:
        ends = segment_of(labels[i])
        leader = leader_to(labels[i], spots[i], ends) if ends else None
        if leader and not any(clipped(*leader, area) for area in [*areas[:i], *areas[i + 1 :]]):
            found[i] = replace(spots[i], leader=leader)
    return found


def doubtful_ones(
    labels: Sequence[Label], spots: Sequence[Spot], marks: Sequence[Mark]
) -> list[int]:
    """The labels without a leader that are nearer to another bar or vector than to their own.

    Numbers of links are held against bars and plates, other names against vectors.
    """
    import numpy as np
    import shapely

    found: list[int] = []
    for bars in (True, False):
        bare = [
            i
            for i, (label, spot) in enumerate(zip(labels, spots, strict=True))
            if label.ring is bars and segment_of(label) and not spot.leader
        ]
        shapes = rivals(marks, bars=bars) if bare else {}
        place = {name: j for j, name in enumerate(shapes)}
        which = [i for i in bare if labels[i].name in place]
        if not which or len(shapes) < 2:
            continue
        areas = shapely.box(*np.array([labels[i].area(spots[i]) for i in which]).T)
        drawn, mine = np.array([*shapes.values()]), np.array([place[labels[i].name] for i in which])
        own = shapely.distance(areas, drawn[mine])
        far = (own > LEAST).nonzero()[0]
        apart = shapely.distance(areas[far, None], drawn)
        apart[np.arange(len(far)), mine[far]] = np.inf
        nearer = far[apart.min(axis=1) < own[far] - MARGIN]
        found += [which[k] for k in nearer.tolist()]
    return sorted(found)


def rivals(marks: Sequence[Mark], *, bars: bool) -> dict[str, Any]:
    """The bars and plates, or the vectors, of a drawing by name."""
    import shapely

    kinds = ("link",) if bars else VECTORS
    lines = {
        mark.name: ((mark.x1, mark.y1), (mark.x2, mark.y2))
        for mark in marks
        if isinstance(mark, Line) and mark.name and mark.cls.split()[0] in kinds
    }
    found: dict[str, Any] = {}
    if lines:
        found |= zip(lines, shapely.linestrings([*lines.values()]), strict=True)
    for mark in marks if bars else ():
        if isinstance(mark, Polyline) and mark.cls.split()[0] == "plate":
            found[mark.name] = shapely.Polygon(mark.points)
    return found


def segment_of(label: Label) -> tuple[XY, XY] | None:
    """The segment that a label names; None for a point."""
    first, second = label.subject
    if isinstance(first, tuple) and isinstance(second, tuple):
        return first, second
    return None


def leader_to(label: Label, spot: Spot, ends: tuple[XY, XY]) -> tuple[XY, XY]:
    """From the side of a label's box to the nearest point in the middle part of its segment."""
    (x0, y0), (x1, y1) = ends
    dx, dy = x1 - x0, y1 - y0
    share = ((spot.x - x0) * dx + (spot.y - y0) * dy) / (dx * dx + dy * dy)
    share = min(max(share, 0.15), 0.85)
    return label.side(spot, x0 + share * dx, y0 + share * dy)
