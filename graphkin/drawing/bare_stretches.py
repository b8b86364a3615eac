"""Where vectors lie along one another, the name of each stands at what of it no other covers (mm).

On o to b₁ and o to a along one line, the name of the longer stands between b₁ and a.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from msgspec.structs import replace

from graphkin.drawing.field import XY
from graphkin.drawing.label import Label, segment_of
from graphkin.drawing.marks import LineMark, Mark, style_class
from graphkin.drawing.style import VECTORS

ASIDE = 0.1
"""How far from a line both ends of another lie at most that lies along it, in mm."""
WHOLE = 0.999
"""A vector that lies along so much of another lies along all of it, and leaves none of it bare."""
LEAST = 8.0
"""Length in mm of a stretch that is long enough for a name."""


def at_bare_stretches(labels: Sequence[Label], marks: Sequence[Mark]) -> list[Label]:
    """The labels, those of vectors at the longest stretch that no other vector covers.

    Where no such stretch is long enough, or nothing is covered, they name the whole vector.
    """
    drawn = [m for m in marks if isinstance(m, LineMark) and style_class(m) in VECTORS]
    return [
        replace(label, subject=bare_stretch(label, drawn))
        if segment_of(label) and label.cls in VECTORS
        else label
        for label in labels
    ]


def bare_stretch(label: Label, drawn: Sequence[LineMark]) -> tuple[XY, XY] | XY:
    """The longest stretch of a label's vector that no other covers, or all of it."""
    ends = segment_of(label)
    if ends is None or not (covered := sorted(laps(label.name, ends, drawn))):
        return label.subject
    (x0, y0), (x1, y1) = ends
    bare, so_far = list[tuple[float, float]](), 0.0
    for low, high in [*covered, (1.0, 1.0)]:
        bare.append((so_far, low))
        so_far = max(so_far, high)
    low, high = max(bare, key=lambda part: part[1] - part[0])
    long = ((x1 - x0) ** 2 + (y1 - y0) ** 2) ** 0.5
    if (high - low) * long < LEAST:
        return label.subject
    first, last = ((x0 + at * (x1 - x0), y0 + at * (y1 - y0)) for at in (low, high))
    return first, last


def laps(
    name: str, ends: tuple[XY, XY], drawn: Sequence[LineMark]
) -> Iterator[tuple[float, float]]:
    """From which share of a vector to which each other one lies along it; not those along all."""
    (x0, y0), (x1, y1) = ends
    dx, dy = x1 - x0, y1 - y0
    square = dx * dx + dy * dy
    for line in drawn:
        places = (line.x1 - x0, line.y1 - y0), (line.x2 - x0, line.y2 - y0)
        aside = max(abs(u * dy - v * dx) for u, v in places)
        if line.name != name and aside <= ASIDE * square**0.5:
            low, high = sorted((u * dx + v * dy) / square for u, v in places)
            part = max(low, 0.0), min(high, 1.0)
            if 0 < part[1] - part[0] < WHOLE:
                yield part
