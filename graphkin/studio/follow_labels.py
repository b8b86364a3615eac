"""Labels while a slider moves: each rides beside what it names, as far off as it last stood.

To find free places for all labels takes longer than everything else about a drawing. While values
move nobody reads that closely, and labels that jump about could not be followed anyway: so each one
keeps its distance to its subject, and new places are sought when the slider rests.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence

from msgspec import Struct, field
from msgspec.structs import replace

from graphkin.drawing.areas import Rect
from graphkin.drawing.field import XY
from graphkin.drawing.label import GAP, Label
from graphkin.drawing.labels import FieldContent
from graphkin.drawing.marks import LineMark, Mark, Text, style_class
from graphkin.drawing.placement import Spot
from graphkin.drawing.richtext import extent

Key = tuple[str, str, int | None, int]
"""Class, name and step of a label, and which of those that share them."""
LETTERS = "label"
"""The class of the text of a label."""


class LabelPlace(Struct, frozen=True):
    """Where a label stood: from the middle of its subject to its own (mm), its height, a leader."""

    x: float
    y: float
    height: float
    led: bool


class FollowLabels(Struct, frozen=True):
    """Where all labels of a field stood; those that were left out have no seat."""

    of: Mapping[Key, LabelPlace] = field(default_factory=dict)
    without: frozenset[Key] = frozenset()


def seats_of(labels: Sequence[Label], marks: Sequence[Mark]) -> FollowLabels:
    """Where the labels that a board wished for stand among its finished marks."""
    texts = [mark for mark in marks if isinstance(mark, Text) and style_class(mark) == LETTERS]
    placed = dict(zip(keys((t.cls, t.name, t.step) for t in texts), texts, strict=True))
    leaders = {m.name for m in marks if isinstance(m, LineMark) and style_class(m) == "leader"}
    found: dict[Key, LabelPlace] = {}
    for key, label in keyed(labels):
        text = placed.get(key)
        if text is not None:
            x, y = middle_of(label)
            width, top, bottom = extent(text.markup, text.height)
            right, down = text.x + text.left() + width / 2 - x, text.y + (top + bottom) / 2 - y
            found[key] = LabelPlace(right, down, text.height, text.name in leaders)
    return FollowLabels(found, frozenset(key for key, _ in keyed(labels) if key not in found))


def riding(board: FieldContent, seats: FollowLabels) -> list[Mark]:
    """The marks of a board, its labels as far from their subjects as their seats are."""
    marks = [*board.marks, *board.footed(board.notes)]
    for key, label in keyed(board.labels):
        if key not in seats.without:
            marks += seated(label, seats.of.get(key), board.rect)
    return marks


def seated(label: Label, seat: LabelPlace | None, rect: Rect) -> Iterable[Mark]:
    """One label at its seat, or beside its subject where it has none."""
    x, y = middle_of(label)
    if seat is None:
        side = label.away or (0.7, -0.7)
        width, height = label.size()
        right = side[0] * (GAP + width / 2 + label.radius)
        down = side[1] * (GAP + height / 2 + label.radius)
        seat = LabelPlace(right, down, label.height, led=False)
    if seat.height != label.height:
        label = replace(label, height=seat.height)
    width, height = label.size()
    at = (
        held(x + seat.x, rect[0] + width / 2, rect[2] - width / 2),
        held(y + seat.y, rect[1] + height / 2, rect[3] - height / 2),
    )
    spot = Spot(*at, None, True)
    if seat.led:
        spot = Spot(*at, label.side(spot, x, y), True)
    return replace(label, led=False).marks(spot)


def held(value: float, low: float, high: float) -> float:
    """A value within bounds."""
    return max(low, min(value, high))


def middle_of(label: Label) -> XY:
    """The point that a label names, or the middle of its segment."""
    first, second = label.subject
    if isinstance(first, tuple) and isinstance(second, tuple):
        return (first[0] + second[0]) / 2, (first[1] + second[1]) / 2
    assert isinstance(first, float) and isinstance(second, float)
    return first, second


def keyed(labels: Sequence[Label]) -> Iterator[tuple[Key, Label]]:
    """Each label with its key."""
    named = ((f"{LETTERS} {label.cls}".strip(), label.name, label.step) for label in labels)
    return zip(keys(named), labels, strict=True)


def keys(named: Iterable[tuple[str, str, int | None]]) -> Iterator[Key]:
    """Class, name and step, with a number that tells equal ones apart."""
    seen: Counter[tuple[str, str, int | None]] = Counter()
    for each in named:
        yield (*each, seen[each])
        seen[each] += 1
