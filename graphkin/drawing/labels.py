"""Labels of a drawing: wished for while its marks are made, placed together at the end."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from graphkin.drawing import shapes
from graphkin.drawing.areas import Rect
from graphkin.drawing.chords import pieces_of
from graphkin.drawing.field import XY, clipped
from graphkin.drawing.leaders import with_leaders
from graphkin.drawing.marks import CircleMark, LineMark, Mark, Text, box, reach
from graphkin.drawing.overflow import HELPERS, by_need, placed_after
from graphkin.drawing.placement import Spot, Wish, place
from graphkin.drawing.richtext import extent, flowed, words_of
from graphkin.drawing.shapes import Array, Box

NUMBER = 2.3
"""Radius of the circle around a link's number, in mm."""


ROUNDS = 4
"""How often labels are placed anew with more key numbers before a field counts as full."""
ASIDE = 15
"""How far a note is moved aside at a time, in mm, where it would stand on lines."""
LEADING = 4.6
"""Distance of lines of notes in mm, so that indices above and below do not meet."""
SMALL = 1.8
"""Height of the smallest lettering in mm."""
KEY = 4
"""Priority of a key number."""
NEAR = 0.6
"""How near to a note a label may stand, in mm."""
GAP, LED = 0.9, 3.4
"""Clear distance of a label from its subject, and of one that always has a leader, in mm."""


@dataclass(frozen=True, slots=True)
class Label:
    """A text that wants a place at a subject.

    ``ring`` puts it into a circle (a link's number), ``led`` always gives it a leader; ``spare``
    may be left out in a crowd, for the construction and the tables name it too; ``optional`` is
    drawn only where there is a place for it at once.
    """

    markup: str
    cls: str
    subject: XY | tuple[XY, XY]
    height: float = 2.5
    name: str = ""
    step: int | None = None
    away: XY | None = None
    priority: int = 0
    radius: float = 0.0
    ring: bool = False
    led: bool = False
    spare: bool = False
    optional: bool = False

    def size(self) -> tuple[float, float]:
        """Width and height of the label's box."""
        width, top, bottom = extent(self.markup, self.height)
        if self.ring:
            return max(2 * NUMBER, width + NUMBER), 2 * NUMBER
        return width, bottom - top

    @property
    def shrinks(self) -> bool:
        """True for a letter of the construction that may still be made smaller."""
        return self.cls == "construction" and self.height > SMALL

    def wish(self) -> Wish:
        """The box that the label needs, and where."""
        gap = LED if self.led else GAP
        width, height = self.size()
        return Wish(
            width, height, self.subject, self.away, self.priority, gap, self.radius, self.optional
        )

    def marks(self, spot: Spot) -> Iterable[Mark]:
        """The label at its place, with its leader or circle."""
        leader = spot.leader or (self.short_leader(spot) if self.led else None)
        if leader:
            style = f"leader {self.cls}".strip()
            yield LineMark(*leader[0], *leader[1], style, self.name, self.step)
        if self.ring:
            yield self.balloon(spot)
        yield self.text(spot)

    def balloon(self, spot: Spot) -> Mark:
        """The circle around a link's number, or the frame around its name."""
        width, height = self.size()
        style = f"number {self.cls}".strip()
        if width <= height:
            return CircleMark(spot.x, spot.y, NUMBER, style, self.name)
        return box(spot.x - width / 2, spot.y - height / 2, width, height, style)

    def text(self, spot: Spot) -> Text:
        """The label's text with the middle of its ink at a place."""
        width, top, bottom = extent(self.markup, self.height)
        x, y = spot.x - width / 2, spot.y - (top + bottom) / 2
        style = f"label {self.cls}".strip()
        return Text(x, y, self.markup, style, self.height, "start", self.name, self.step)

    def area(self, spot: Spot) -> Rect:
        """The box that the text's ink takes up at a place."""
        width, top, bottom = extent(self.markup, self.height)
        high = (bottom - top) / 2
        return spot.x - width / 2, spot.y - high, spot.x + width / 2, spot.y + high

    def short_leader(self, spot: Spot) -> tuple[XY, XY]:
        """From the nearest side of the label's box to the point it names."""
        x, y = self.subject
        assert isinstance(x, float) and isinstance(y, float)
        return self.side(spot, x, y)

    def side(self, spot: Spot, x: float, y: float) -> tuple[XY, XY]:
        """From the nearest side of the label's box, a little off it, to a place."""
        half_width, half_height = (side / 2 + 0.3 for side in self.size())
        near_x = min(max(x, spot.x - half_width), spot.x + half_width)
        near_y = min(max(y, spot.y - half_height), spot.y + half_height)
        return (near_x, near_y), (x, y)


@dataclass
class FieldContent:
    """One field of the page while it is drawn: its marks, and the labels still to be placed.

    ``taken`` are boxes that labels keep clear of, ``notes`` what is said at the field's foot,
    ``lettered`` the places of the labels that are letters of points; ``unnamed`` begins the note
    that lists the vectors for whose names there is no room.
    """

    rect: Rect
    marks: list[Mark] = field(default_factory=list)
    labels: list[Label] = field(default_factory=list)
    taken: list[Rect] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    lettered: dict[int, XY] = field(default_factory=dict)
    unnamed: str = ""

    def finish(self, made: tuple[list[Mark], list[Spot]] | None = None) -> list[Mark]:
        """The marks with every label at a free place; in a crowd, key numbers with a legend.

        ``made`` are the field's foot and the places of all labels if these were sought before,
        with other boards'. In a worse crowd letters of the construction are left out, then names
        of vectors, and a note says which. Raises PageError when another label finds no place even
        so.
        """
        meanings: list[str] = []
        wished = list(self.labels)
        foot = made[0] if made else self.footed(self.notes)
        spots = made[1] if made else self.spots(foot)
        for rounds_left in reversed(range(ROUNDS)):
            before = list(self.labels)
            if all(spot.free for spot in spots) and not self.unled(spots):
                break
            if not rounds_left:
                if all(
                    spot.free or label.cls in HELPERS
                    for label, spot in zip(self.labels, spots, strict=True)
                ):
                    spots = self.without_helpers(spots)
                else:
                    foot, spots = by_need(self, wished, meanings)
                break
            self.shorten([spot.free for spot in spots], meanings)
            foot = self.footed([*self.notes, *meanings])
            spots = self.spots_of_new(foot, before, spots) or self.spots(foot)
        clear = with_leaders(self.labels, spots, self.marks)
        return [*self.marks, *foot, *marks_of(self.labels, clear)]

    def without_helpers(self, spots: Sequence[Spot]) -> list[Spot]:
        """Leave out the letters of the construction that find no place; the rest is drawn."""
        kept = [
            (label, spot)
            for label, spot in zip(self.labels, spots, strict=True)
            if spot.free or label.cls not in HELPERS
        ]
        self.labels = [label for label, _ in kept]
        return [spot for _, spot in kept]

    def unled(self, spots: Sequence[Spot]) -> bool:
        """Bring labels nearer whose leaders would cross others; true when there were any."""
        both = [*zip(self.labels, spots, strict=True)]
        led = [i for i, (label, spot) in enumerate(both) if label.led and not spot.leader]
        areas = [(label.name, label.area(spot)) for label, spot in both] if led else []
        blocked = [i for i in led if not is_clear(*both[i], areas)]
        for i in blocked:
            self.labels[i] = replace(self.labels[i], led=False)
        return bool(blocked)

    def shorten(self, free: Sequence[bool], meanings: list[str]) -> None:
        """Make crowded triangles' letters smaller, all at one pin, and give others key numbers.

        What key numbers mean is for the foot of the field.
        """
        crowded = [i for i, spot_is_free in enumerate(free) if not spot_is_free]
        letters = {self.labels[i].name[:1] for i in crowded if self.labels[i].shrinks}
        for i, label in enumerate(self.labels):
            if label.shrinks and label.name[:1] in letters:
                self.labels[i] = replace(label, height=SMALL)
            elif i in crowded and label.priority < KEY:
                meanings.append(f"{len(meanings) + 1}) {label.markup}")
                key = f"{len(meanings)})"
                self.labels[i] = replace(label, markup=key, height=SMALL, priority=KEY)

    def spots_of_new(
        self, foot: Sequence[Mark], before: Sequence[Label], spots: Sequence[Spot]
    ) -> list[Spot]:
        """The places after some labels have changed, if all others can keep theirs; else none."""
        boxes = [reach(mark) for mark in foot]
        kept = {
            i: spot
            for i, spot in enumerate(spots)
            if spot.free and self.labels[i] is before[i] and stays(self.labels[i], spot, boxes)
        }
        if not kept:
            return []
        found = placed_after(self, foot, kept, [i for i in range(len(spots)) if i not in kept])
        if not all(spot.free for spot in found.values()):
            return []
        leaders = ([f.leader for f in some.values() if f.leader] for some in (kept, found))
        ends = [np.array(some).reshape(-1, 4) for some in leaders]
        if shapes.crossings(ends[0][:, None], ends[1]).any():
            return []
        return [spot for _, spot in sorted((kept | found).items())]

    def footed(self, notes: Sequence[str]) -> list[Mark]:
        """Notes in lines at the foot of the field, where they cross the fewest lines."""
        across = self.rect[2] - self.rect[0] - 6
        lines = flowed(notes, "; ", across, 2.5)
        if not lines:
            return []
        if max(extent(line, 2.5)[0] for line in lines) > across:
            lines = flowed(words_of("; ".join(notes)), " ", across, 2.5)
        y = self.rect[3] - 2.5 - LEADING * (len(lines) - 1)
        room = self.rect[2] - self.rect[0] - 6 - max(extent(line, 2.5)[0] for line in lines)
        tried: list[list[Text]] = [
            [
                Text(self.rect[0] + 3 + away, y + LEADING * i, line, "caption", 2.5, name="note")
                for i, line in enumerate(lines)
            ]
            for away in range(0, max(1, int(room)), ASIDE)
        ]
        if len(tried) == 1:
            return [*tried[0]]
        boxes = [reach(text) for texts in tried for text in texts]
        crossed = shapes.met(boxes, shapes.segments(pieces_of(self.marks)))
        return [*tried[int(crossed.reshape(len(tried), -1).sum(axis=1).argmin())]]

    def spots(self, more: Sequence[Mark] = (), some: Sequence[Label] | None = None) -> list[Spot]:
        """The places of all labels, or of some, clear of marks, taken boxes and each other."""
        lines, boxes = self.obstacles(more)
        labels = self.labels if some is None else some
        return place([label.wish() for label in labels], lines, boxes, self.rect)

    def obstacles(self, more: Sequence[Mark] = ()) -> tuple[Array, list[Box]]:
        """The lines and the boxes that labels keep clear of: of the marks, and of some more."""
        marks = [*self.marks, *more]
        boxes = [*self.taken, *(reach(mark) for mark in marks if isinstance(mark, Text))]
        return pieces_of(marks), boxes


def free_ones(board: FieldContent, spots: Sequence[Spot]) -> list[Mark]:
    """The labels of a board that have a free place."""
    free = [(label, spot) for label, spot in zip(board.labels, spots, strict=True) if spot.free]
    return marks_of([label for label, _ in free], [spot for _, spot in free])


def stays(label: Label, spot: Spot, boxes: Sequence[Rect]) -> bool:
    """True when a label with its leader is clear of boxes that are to be taken."""
    taken = [(b[0] - NEAR, b[1] - NEAR, b[2] + NEAR, b[3] + NEAR) for b in boxes]
    return not any(
        left < b[2] and b[0] < right and top < b[3] and b[1] < bottom
        for left, top, right, bottom in map(reach, label.marks(spot))
        for b in taken
    )


def marks_of(labels: Sequence[Label], spots: Sequence[Spot]) -> list[Mark]:
    """The labels at their places."""
    return [mark for label, spot in zip(labels, spots, strict=True) for mark in label.marks(spot)]


def is_clear(label: Label, spot: Spot, areas: Sequence[tuple[str, Rect]]) -> bool:
    """True when a leader from a label's box to its point crosses no label of another name."""
    start, end = label.short_leader(spot)
    others = [box for name, box in areas if name != label.name and near(box, *start)]
    return not any(clipped(start, end, box) for box in others)


def near(box: Rect, x: float, y: float) -> bool:
    """True when a box lies within reach of a short leader that starts at a place."""
    far = 2 * LED
    return box[0] - far < x < box[2] + far and box[1] - far < y < box[3] + far
