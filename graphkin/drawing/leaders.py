"""Leaders for labels that could be read as naming a neighbour: nearer to it than to their own."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import dist
from typing import Any

import numpy as np
from msgspec.structs import replace

from graphkin.drawing.chords import pieces_of
from graphkin.drawing.field import XY, clipped
from graphkin.drawing.label import Label, segment_of
from graphkin.drawing.marks import LineMark, Mark, Polyline, style_class
from graphkin.drawing.placement import CLEAR, Spot
from graphkin.drawing.shapes import Array, struck
from graphkin.drawing.style import OWN_LINES, VECTORS

STRONG = (*VECTORS, "link", "outline", "guide", "guide-bar")
"""Classes of the lines that leaders should not cross."""
BARS, DIRECTIONS = ("link",), ("construction", OWN_LINES)
"""Classes of the bars of a mechanism, and of the lines that a plan is constructed by."""
KINDS = {cls: kinds for kinds in (BARS, VECTORS, DIRECTIONS) for cls in kinds}
MARGIN = 0.3
"""How much nearer a neighbour may be, in mm, before a label gets a leader."""
SHARES = (0.5, 0.3, 0.7, 0.15, 0.85)
"""Where else on its segment a leader may end."""
LEAST = MARGIN + CLEAR - 0.1
"""A label no farther from its own segment, in mm, is nearest to it: none is so near to a line."""


def with_leaders(
    labels: Sequence[Label], spots: Sequence[Spot], marks: Sequence[Mark]
) -> list[Spot]:
    """The places of labels, with a leader for each doubtful one that can have one."""
    found = list(spots)
    doubtful = [*doubtful_ones(labels, spots, marks), *doubtful_letters(labels, spots)]
    if not doubtful:
        return found
    areas = [label.area(spot) for label, spot in zip(labels, spots, strict=True)]
    strong = strong_lines(marks)
    for i in doubtful:
        leaders = [*leaders_to(labels[i], spots[i])]
        crossed = struck(np.array(leaders).reshape(-1, 4), strong)
        leader = leaders[int(crossed.argmin())]
        if not any(clipped(*leader, area) for area in [*areas[:i], *areas[i + 1 :]]):
            found[i] = replace(spots[i], leader=leader)
    return found


def strong_lines(marks: Sequence[Mark]) -> Array:
    """The links, guides and vectors of a drawing, which leaders should not cross."""
    return pieces_of([mark for mark in marks if style_class(mark) in STRONG])


def doubtful_letters(labels: Sequence[Label], spots: Sequence[Spot]) -> list[int]:
    """The letters of points without a leader that are nearer to another letter's point."""
    both = enumerate(zip(labels, spots, strict=True))
    letters = [i for i, (label, _) in both if label.radius and not segment_of(label)]
    bare = [i for i in letters if not (spots[i].leader or labels[i].led)]
    if not bare or len(letters) < 2:
        return []
    points = np.array([labels[i].subject for i in letters])
    sides = np.array([labels[i].area(spots[i]) for i in bare])[:, None]
    off = np.maximum(np.maximum(sides[..., :2] - points, points - sides[..., 2:]), 0.0)
    apart = np.hypot(off[..., 0], off[..., 1])
    own = apart[np.arange(len(bare)), [letters.index(i) for i in bare]]
    return [bare[k] for k in (apart.min(axis=1) < own - MARGIN).nonzero()[0].tolist()]


def doubtful_ones(
    labels: Sequence[Label], spots: Sequence[Spot], marks: Sequence[Mark]
) -> list[int]:
    """The labels without a leader that are nearer to another line than to their own.

    Numbers of links are held against bars and plates, directions against the construction's lines,
    other names against vectors.
    """
    import shapely

    found: list[int] = []
    bare: dict[tuple[str, ...], list[int]] = {}
    for i, (label, spot) in enumerate(zip(labels, spots, strict=True)):
        if segment_of(label) and not spot.leader:
            bare.setdefault(kinds_of(label), []).append(i)
    every = rivals(marks) if bare else {}
    for kinds, some in bare.items():
        shapes = every.get(kinds, {})
        place = {name: j for j, name in enumerate(shapes)}
        which = [i for i in some if labels[i].name in place]
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


def kinds_of(label: Label) -> tuple[str, ...]:
    """What a label could seem to name: the first class of such marks."""
    if label.ring:
        return BARS
    return DIRECTIONS if label.cls in DIRECTIONS else VECTORS


def rivals(marks: Sequence[Mark]) -> dict[tuple[str, ...], dict[str, Any]]:
    """The bars and plates, the vectors, and the construction's lines of a drawing, by name."""
    import shapely

    lines: dict[tuple[str, ...], dict[str, list[tuple[XY, XY]]]] = {}
    plates: dict[str, Any] = {}
    for mark in marks:
        if not mark.name or not isinstance(mark, LineMark | Polyline):
            continue
        cls = style_class(mark)
        if isinstance(mark, LineMark) and cls in KINDS:
            named = lines.setdefault(KINDS[cls], {}).setdefault(mark.name, [])
            named.append(((mark.x1, mark.y1), (mark.x2, mark.y2)))
        elif isinstance(mark, Polyline) and cls == "plate":
            plates[mark.name] = shapely.Polygon(mark.points)
    found: dict[tuple[str, ...], dict[str, Any]] = {}
    for kinds, parts in lines.items():
        drawn = shapely.linestrings([ends for each in parts.values() for ends in each])
        if len(drawn) > len(parts):
            which = [i for i, each in enumerate(parts.values()) for _ in each]
            drawn = np.asarray(shapely.multilinestrings(drawn, indices=which))
        found[kinds] = dict(zip(parts, drawn, strict=True))
    return {**found, BARS: {**found.get(BARS, {}), **plates}}


def leaders_to(label: Label, spot: Spot) -> Iterator[tuple[XY, XY]]:
    """From the side of a label's box to the nearest point in the middle part of its segment and to
    others, or to the circle that its point is drawn as."""
    ends = segment_of(label)
    if ends is None:
        start, (x, y) = label.short_leader(spot)
        far = dist(start, (x, y))
        share = max(0.0, 1 - label.radius / far) if far else 0.0
        yield start, (start[0] + share * (x - start[0]), start[1] + share * (y - start[1]))
        return
    (x0, y0), (x1, y1) = ends
    dx, dy = x1 - x0, y1 - y0
    near = ((spot.x - x0) * dx + (spot.y - y0) * dy) / (dx * dx + dy * dy)
    for share in (min(max(near, 0.15), 0.85), *SHARES):
        yield label.side(spot, x0 + share * dx, y0 + share * dy)
