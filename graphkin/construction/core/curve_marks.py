"""Curves on the mechanism: paths, centrodes and circles, as much of them as lies in a field."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import cos, hypot, pi, sin

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.solution import Curve
from graphkin.drawing.areas import Rect
from graphkin.drawing.field import XY, Field
from graphkin.drawing.label import Label
from graphkin.drawing.labels import FieldContent
from graphkin.drawing.marks import Polyline
from graphkin.drawing.style import CENTRODES
from graphkin.drawing.symbol_markup import symbol
from graphkin.numbers.plane import Circle
from graphkin.text import Words

CHORDS, FINE = 240, 0.02
"""Straight pieces of a small circle, and how far (mm) those of a large one may leave it."""
UNSEEN = 0.01
"""How far, in mm, a broken line may pass by corners that are left out."""


def ring(circle: Circle, mm: float = 0.0) -> list[complex]:
    """Points around a circle, the first again at the end, close enough for so many mm a metre."""
    chords = max(CHORDS, int(pi * (circle.radius * mm / FINE / 2) ** 0.5))
    turns = (2 * pi * i / chords for i in range(chords + 1))
    return [circle.centre + circle.radius * complex(cos(a), sin(a)) for a in turns]


def clipped_path(
    points: Sequence[XY], rect: Rect, cls: str, name: str, step: int | None = None
) -> Iterator[Polyline]:
    """The parts of a broken line that lie in a rectangle, without corners that nobody sees."""
    from shapely import LineString, box

    if len(points) < 2:
        return
    line, field = LineString(points).simplify(UNSEEN, preserve_topology=False), box(*rect)
    found = line if field.covers(line) else line.intersection(field)
    for part in getattr(found, "geoms", [found]):
        if part.geom_type == "LineString" and len(part.coords) > 1:
            yield Polyline(tuple((x, y) for x, y in part.coords), cls, name, step)


def draw_curves(board: FieldContent, drawing: Drawing, field: Field, rect: Rect) -> None:
    """Paths of points and centrodes, each with its name."""
    for curve in drawing.curves:
        parts = [
            part
            for run in curve.runs
            for part in clipped_path([field(point) for point in run], rect, curve.kind, curve.name)
        ]
        board.marks += parts
        if parts:
            subject = middle_of(max(parts, key=length), share=SHARES[curve.kind])
            words = name_of(drawing.words, curve)
            cls = CENTRODES.get(curve.kind, "")
            board.labels.append(Label(words, cls, subject, 2.5, curve.name, led=True))


SHARES = {"fixed-centrode": 0.5, "moving-centrode": 0.3, "trajectory": 0.15, "locus": 0.6}
"""How far along its longest part a curve is named, so that names do not meet."""


def name_of(words: Words, curve: Curve) -> str:
    """What is written beside a curve."""
    return words(f"page.{curve.kind}", of=symbol(curve.of))


def length(part: Polyline) -> float:
    """Length of a broken line in mm."""
    ends = zip(part.points, part.points[1:], strict=False)
    return sum(hypot(x - u, y - v) for (x, y), (u, v) in ends)


def middle_of(part: Polyline, share: float) -> XY:
    """The place on a broken line that a share of its length lies before."""
    left = share * length(part)
    for (x, y), (u, v) in zip(part.points, part.points[1:], strict=False):
        step = hypot(x - u, y - v)
        if step >= left > 0:
            return x + (u - x) * left / step, y + (v - y) * left / step
        left -= step
    return part.points[-1]
