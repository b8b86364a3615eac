"""Leaders for labels that could be read as naming a neighbour: nearer to it than to their own."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from graphkin.paper.field import XY
from graphkin.paper.marks import Line, Mark, Polyline, reach
from graphkin.paper.place import Spot
from graphkin.paper.symbols import VECTORS

if TYPE_CHECKING:
    from graphkin.paper.labels import Label

MARGIN = 0.3
"""How much nearer a neighbour may be, in mm, before a label gets a leader."""


def with_leaders(
    labels: Sequence[Label], spots: Sequence[Spot], marks: Sequence[Mark]
) -> list[Spot]:
    """The places of labels, with a leader for each doubtful one that can have one."""
    import shapely

    texts = [label.text(spot) for label, spot in zip(labels, spots, strict=True)]
    boxes = [shapely.box(*reach(text)) for text in texts]
    bars, vectors = rivals(marks, bars=True), rivals(marks, bars=False)
    found = []
    for i, (label, spot) in enumerate(zip(labels, spots, strict=True)):
        ends = segment_of(label)
        doubtful = ends and not spot.leader and is_doubtful(label, boxes[i], bars, vectors)
        leader = leader_to(label, spot, ends) if ends and doubtful else None
        others = [*boxes[:i], *boxes[i + 1 :]]
        if leader and not shapely.intersects(shapely.LineString(leader), others).any():
            found.append(replace(spot, leader=leader))
        else:
            found.append(spot)
    return found


def rivals(marks: Sequence[Mark], *, bars: bool) -> dict[str, Any]:
    """The bars and plates, or the vectors, of a drawing by name."""
    import shapely

    found: dict[str, Any] = {}
    for mark in marks:
        kind = mark.cls.split()[0]
        if isinstance(mark, Line) and mark.name and (kind == "link" if bars else kind in VECTORS):
            found[mark.name] = shapely.LineString([(mark.x1, mark.y1), (mark.x2, mark.y2)])
        elif bars and isinstance(mark, Polyline) and kind == "plate":
            found[mark.name] = shapely.Polygon(mark.points)
    return found


def is_doubtful(label: Label, box: Any, bars: dict[str, Any], vectors: dict[str, Any]) -> bool:
    """True when another bar (for a link's number) or vector is nearer than the label's own."""
    import shapely

    near = bars if label.ring else vectors
    if label.name not in near:
        return False
    own = shapely.distance(box, near[label.name])
    other = [shape for name, shape in near.items() if name != label.name]
    return bool(other and shapely.distance(box, other).min() < own - MARGIN)


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
