"""Labels of a drawing: collected while its marks are made, and placed together at the end."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import lru_cache
from itertools import groupby
from math import dist, hypot
from typing import Any, NamedTuple

import numpy as np
from msgspec import Struct, field
from msgspec.structs import replace

from graphkin.drawing import shapes
from graphkin.drawing.clearance import LONGEST, pieces_of
from graphkin.drawing.field import XY, Rect, clipped
from graphkin.drawing.marks import (
    CircleMark,
    LineMark,
    Mark,
    Polyline,
    SharedLetter,
    Shown,
    Text,
    drawn_out,
    reach,
    style_class,
)
from graphkin.drawing.placement import CLEAR, HOPELESS, Spot, Wish, place
from graphkin.drawing.richtext import extent, flowed_pieces, plain, words_of
from graphkin.drawing.shapes import Array, Box, struck
from graphkin.drawing.style import OWN_LINES, VECTORS
from graphkin.text.errors import PageError, Problem, message

NUMBER = 2.3
"""Radius of the circle around a link's number, in mm."""
LETTERS = 2.5
"""Least height of letters in mm, and that of the notes at the foot of a field."""
EDGE = 0.3
"""Clearance of the text inside that circle, in mm; longer names widen the circle."""
GAP, LED = 0.9, 3.4
"""Distance of a label from its subject, and of a label that always has a leader, in mm."""


class Label(Struct, frozen=True):
    """A text to be placed at a subject.

    - ``ring`` puts the text into a circle (a link's number); ``led`` always gives it a leader.
    - ``spare`` labels are left out where only a leader across a strong line would reach them,
      because the construction and the tables name them, too.
    - ``optional`` labels are drawn only where there is a place for them at once.
    - ``letters`` are the letters of the points of a plan that the label names.
    - ``shows`` is the part of a link that no step draws.
    """

    markup: str
    cls: str
    subject: XY | tuple[XY, XY]
    height: float = LETTERS
    name: str = ""
    step: int | None = None
    away: XY | None = None
    priority: int = 0
    radius: float = 0.0
    ring: bool = False
    led: bool = False
    spare: bool = False
    optional: bool = False
    part: int = 0
    letters: tuple[SharedLetter, ...] = ()
    shows: Shown | None = None

    def of_letters(self, letters: tuple[SharedLetter, ...]) -> Label:
        """The label for coinciding points that share it."""
        names = " ".join(letter.name for letter in letters)
        markup = "".join(letter.joined for letter in letters)
        return replace(self, name=names, markup=markup, letters=letters)

    def size(self) -> tuple[float, float]:
        """Width and height of the label's box."""
        width, top, bottom = extent(self.markup, self.height)
        if self.ring:
            held = hypot(width, bottom - top) / 2 < NUMBER - EDGE
            return 2 * NUMBER if held else width + NUMBER, 2 * NUMBER
        return width, bottom - top

    @property
    def look(self) -> str:
        """The classes of its text."""
        return f"label {self.cls}".strip()

    @property
    def leader_look(self) -> str:
        """The classes of its leader."""
        return f"leader {self.cls}".strip()

    def wish(self) -> Wish:
        """The box that the label needs, with its preferred place."""
        gap = LED if self.led else GAP
        width, height = self.size()
        own = self.subject, self.away, self.priority, gap, self.radius, self.optional, self.spare
        return Wish(width, height, *own)

    def marks(self, spot: Spot) -> Iterable[Mark]:
        """The label at its place, with its leader or circle."""
        leader = spot.leader or (self.short_leader(spot) if self.led else None)
        if leader:
            (x1, y1), (x2, y2) = leader
            own = self.leader_look, self.name, self.step, self.part, self.shows
            yield LineMark(x1, y1, x2, y2, *own)
        if self.ring:
            yield self.balloon(spot)
        yield self.text(spot)

    def balloon(self, spot: Spot) -> Mark:
        """The circle around a link's number, widened for a longer name."""
        width, height = self.size()
        style = f"number {self.cls}".strip()
        if width <= height:
            return CircleMark(spot.x, spot.y, NUMBER, style, self.name)
        return drawn_out(spot.x, spot.y, NUMBER, width, style)

    def text(self, spot: Spot) -> Text:
        """The label's text, with the middle of its ink at a place."""
        width, top, bottom = extent(self.markup, self.height)
        x, y = spot.x - width / 2, spot.y - (top + bottom) / 2
        own = self.name, self.step, 0.0, self.part, self.letters, self.shows
        return Text(x, y, self.markup, self.look, self.height, "start", *own)

    def area(self, spot: Spot) -> Rect:
        """The box of the text's ink at a place."""
        width, top, bottom = extent(self.markup, self.height)
        high = (bottom - top) / 2
        return spot.x - width / 2, spot.y - high, spot.x + width / 2, spot.y + high

    def whole_area(self, spot: Spot) -> Rect:
        """The box of the text, or of the circle around it, with the air that a leader keeps."""
        wide, high = (side / 2 + AIR for side in self.size())
        return spot.x - wide, spot.y - high, spot.x + wide, spot.y + high

    @property
    def point(self) -> XY:
        """The point that the label names, if its subject is not a segment."""
        x, y = self.subject
        assert isinstance(x, float) and isinstance(y, float)
        return x, y

    def short_leader(self, spot: Spot) -> tuple[XY, XY]:
        """The line from the nearest side of the label's box to the point it names."""
        return self.side(spot, *self.point)

    def side(self, spot: Spot, x: float, y: float) -> tuple[XY, XY]:
        """The line from a little off the nearest side of the label's box to a place."""
        half_width, half_height = (side / 2 + 0.3 for side in self.size())
        near_x = min(max(x, spot.x - half_width), spot.x + half_width)
        near_y = min(max(y, spot.y - half_height), spot.y + half_height)
        return (near_x, near_y), (x, y)


def segment_of(label: Label) -> tuple[XY, XY] | None:
    """The segment that a label names; None for a point."""
    first, second = label.subject
    if isinstance(first, tuple) and isinstance(second, tuple):
        return first, second
    return None


# --- leaders for labels that could be read as naming a neighbour ----------------------------------


STRONG = (*VECTORS, "link", "outline", "guide", "guide-bar")
"""Classes of the lines that leaders should not cross."""
BARS, DIRECTIONS = ("link",), ("construction", OWN_LINES)
"""Classes of the bars of a mechanism, and of the construction lines of a plan."""
KINDS = {cls: kinds for kinds in (BARS, VECTORS, DIRECTIONS) for cls in kinds}
AIR = 0.15
"""Distance in mm that a leader keeps from other labels: half of a thin line and a little."""
MARGIN = 0.3
"""How much nearer a neighbour may be, in mm, before a label gets a leader."""
SHARES = (0.5, 0.3, 0.7, 0.15, 0.85)
"""Other shares of its segment at which a leader may end."""
LEAST = MARGIN + CLEAR - 0.1
"""Distance in mm within which a label's own segment is certainly its nearest line."""


def with_leaders(
    labels: Sequence[Label], spots: Sequence[Spot], marks: Sequence[Mark]
) -> list[Spot]:
    """The places of labels, with a leader for each ambiguous label that can have one.

    A spare one whose leader would cross a strong line has no free place.
    """
    found = list(spots)
    doubtful = [*doubtful_ones(labels, spots, marks), *doubtful_letters(labels, spots)]
    if not doubtful:
        return found
    areas = [label.whole_area(spot) for label, spot in zip(labels, spots, strict=True)]
    strong = strong_lines(marks)
    for i in doubtful:
        leaders = [each for each in leaders_to(labels[i], spots[i]) if dist(*each) <= LONGEST]
        if not leaders:
            continue
        crossed = struck(np.array(leaders).reshape(-1, 4), strong)
        others = [*areas[:i], *areas[i + 1 :]]
        clear = [not any(clipped(*leader, area) for area in others) for leader in leaders]
        if labels[i].spare and crossed.min():
            found[i] = replace(spots[i], free=False)
        elif any(clear):
            best = np.where(clear, crossed, np.inf).argmin()
            found[i] = replace(spots[i], leader=leaders[int(best)])
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

    Numbers of links are compared with bars and plates, directions with construction lines, and
    other names with vectors.
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
    """The kind of marks that a label could seem to name."""
    if label.ring:
        return BARS
    return DIRECTIONS if label.cls in DIRECTIONS else VECTORS


def rivals(marks: Sequence[Mark]) -> dict[tuple[str, ...], dict[str, Any]]:
    """The bars and plates, the vectors, and the construction lines of a drawing, by name."""
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
    """Possible leaders from the side of a label's box, best first.

    They end at the nearest point in the middle part of its segment, at other points of it, or at
    the circle of its point.
    """
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


# --- the labels of one field ----------------------------------------------------------------------


ROUNDS = 4
"""Rounds of placing with more key numbers before a field counts as full."""
ASIDE = 15
"""Step in mm by which a note is moved sideways off drawn lines."""
LEADING = 4.6
"""Distance of lines of notes in mm, so that indices above and below do not touch."""
FOOT = 0.22
"""Share of a field that notes at its foot may take; beyond it no key numbers are used."""
LEFT_OUT = "…"
"""Replacement for notes that do not fit there."""
KEY = 4
"""Priority of a key number."""
NEAR = 0.6
"""Least distance of a label from a note, in mm."""
HELPERS = ("construction", OWN_LINES)
"""Classes of letters that may be left out where there is no room for them."""


NOTE = "note"
"""The name of the lines at the foot of a field."""


class FootNote(Struct, frozen=True):
    """A note at the foot of a field, ``of`` a symbol or of a key number, as markup.

    Notes with one ``lead`` are listed together after it.
    """

    markup: str
    of: str = ""
    lead: str = ""


class FieldContent(Struct):
    """One field of the page during drawing: its marks, and the labels still to be placed.

    - ``taken`` are boxes that labels avoid; ``notes`` are the notes at the field's foot.
    - ``lettered`` are the places of labels that are letters of points.
    - ``unnamed`` is the start of the note that lists vectors without room for their names.
    - ``between`` separates the notes.
    - ``crowds`` are places where so much meets that they are shown enlarged.
    - ``dispensable`` labels are drawn where the others leave room nearby.
    - ``detailed`` fields may have details, which show their short vectors enlarged.
    - ``unplaced`` are letters and numbers of a finished field that only its foot notes, and
      ``left_out`` the names of vectors.
    """

    rect: Rect
    marks: list[Mark] = field(default_factory=list)
    labels: list[Label] = field(default_factory=list)
    taken: list[Rect] = field(default_factory=list)
    notes: list[FootNote] = field(default_factory=list)
    lettered: dict[int, XY] = field(default_factory=dict)
    unnamed: str = ""
    between: str = "; "
    crowds: list[XY] = field(default_factory=list)
    dispensable: list[Label] = field(default_factory=list)
    unplaced: list[Label] = field(default_factory=list)
    left_out: list[str] = field(default_factory=list)
    detailed: bool = True

    @property
    def lettering(self) -> Rect:
        """The part of the field for labels: clear of the lines around it."""
        left, top, right, low = self.rect
        return left + EDGE, top + EDGE, right - EDGE, low - EDGE

    @property
    def across(self) -> float:
        """The width of its foot."""
        return self.rect[2] - self.rect[0] - 6

    @property
    def most_notes(self) -> int:
        """The most lines of notes at its foot; unlimited for a small field."""
        lines = int(FOOT * (self.rect[3] - self.rect[1]) / LEADING)
        return lines if lines > 1 else sys.maxsize

    def finish(self, made: tuple[list[Mark], list[Spot]] | None = None) -> list[Mark]:
        """The marks with every label at a free place; in a crowd, key numbers with a legend.

        ``made`` holds the field's foot and the places of all labels, if these were found with other
        fields. In a worse crowd, letters of the construction are left out, then names of vectors,
        and finally other letters. A note lists them. Where more than HOPELESS labels have no place,
        key numbers would not help either.
        """
        meanings: list[FootNote] = []
        foot = made[0] if made else self.footed(self.notes)
        spots = made[1] if made else self.spots(foot)
        while lost := self.lost(spots):
            foot, spots = self.without_spare(lost, spots)
        wished = list(self.labels)
        for rounds_left in reversed(range(ROUNDS)):
            before = list(self.labels)
            if sum(not spot.free for spot in spots) > HOPELESS:
                self.labels = wished
                foot, spots = in_turn(self, self.notes, wished)
                break
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
            foot = self.footed([*self.footnotes, *meanings])
            if (
                len(note_lines([*self.footnotes, *meanings], self.between, self.across))
                > self.most_notes
            ):
                self.labels = wished
                foot, spots = in_turn(self, self.notes, wished)
                break
            spots = self.spots_of_new(foot, before, spots) or self.spots(foot)
        named = marks_of(self.labels, with_leaders(self.labels, spots, self.marks))
        return [*self.marks, *foot, *named, *self.beside([*foot, *named])]

    def beside(self, named: Sequence[Mark]) -> list[Mark]:
        """The dispensable labels that have a place near their subject, clear of the rest."""
        if not self.dispensable:
            return []
        some = [replace(label, optional=True) for label in self.dispensable]
        both = zip(some, self.spots(named, some), strict=True)
        return [mark for label, spot in both if spot.free for mark in label.marks(spot)]

    @property
    def footnotes(self) -> list[FootNote]:
        """The notes at its foot, the last one that of the vectors without a name."""
        return [*self.notes, *self.nameless(())]

    def nameless(self, more: Iterable[str]) -> Iterator[FootNote]:
        """The note of the vectors left without a name, and of some more; none without any."""
        if names := ", ".join(dict.fromkeys([*self.left_out, *more])):
            yield FootNote(f"{self.unnamed} {names}")

    def lost(self, spots: Sequence[Spot]) -> list[int]:
        """The spare labels that have no place, or only one whose leader crosses a strong line."""
        if not any(label.spare for label in self.labels):
            return []
        led = with_leaders(self.labels, spots, self.marks)
        return [i for i, spot in enumerate(led) if self.labels[i].spare and not spot.free]

    def without_spare(
        self, lost: Sequence[int], spots: Sequence[Spot]
    ) -> tuple[list[Mark], list[Spot]]:
        """Leave out some spare labels and note them; the field's foot and the others' places."""
        self.left_out += [self.labels[i].markup for i in lost]
        kept = [i for i in range(len(spots)) if i not in lost]
        self.labels = [self.labels[i] for i in kept]
        foot = self.footed(self.footnotes)
        others = [spots[i] for i in kept]
        return foot, self.spots_of_new(foot, self.labels, others) or self.spots(foot)

    def without_helpers(self, spots: Sequence[Spot]) -> list[Spot]:
        """Leave out construction letters without a place; the rest is drawn."""
        kept = [
            (label, spot)
            for label, spot in zip(self.labels, spots, strict=True)
            if spot.free or label.cls not in HELPERS
        ]
        self.labels = [label for label, _ in kept]
        return [spot for _, spot in kept]

    def unled(self, spots: Sequence[Spot]) -> bool:
        """Bring labels nearer whose leaders would cross others; return whether there were any."""
        both = [*zip(self.labels, spots, strict=True)]
        led = [i for i, (label, spot) in enumerate(both) if label.led and not spot.leader]
        areas = [(label.name, label.area(spot)) for label, spot in both] if led else []
        blocked = [i for i in led if not is_clear(*both[i], areas)]
        for i in blocked:
            self.labels[i] = replace(self.labels[i], led=False)
        return bool(blocked)

    def shorten(self, free: Sequence[bool], meanings: list[FootNote]) -> None:
        """Give crowded labels key numbers where these take less room than the names.

        The meanings of the key numbers go to the foot of the field.
        """
        for i, label in enumerate(self.labels):
            key = f"{len(meanings) + 1})"
            keyed = replace(label, markup=key, height=LETTERS, priority=KEY, letters=())
            if not free[i] and label.priority < KEY and keyed.size() < label.size():
                meanings.append(FootNote(f"{key} {label.markup}", key))
                self.labels[i] = keyed

    def spots_of_new(
        self, foot: Sequence[Mark], before: Sequence[Label], spots: Sequence[Spot]
    ) -> list[Spot]:
        """The places after some labels have changed, if all others keep theirs; else none."""
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

    def footed(self, notes: Sequence[FootNote]) -> list[Mark]:
        """The notes at the foot of the field, where they cross the fewest lines.

        Where full lines would cross something drawn, shorter lines next to it are tried.
        """
        if not notes:
            return []
        across = self.across
        found: list[tuple[int, list[Text]]] = []
        for width in (across, across / 2, across / 3):
            lines = note_lines(notes, self.between, width)
            if (most := self.most_notes) < len(lines):
                if found:
                    break
                lines = [*lines[: most - 1], NoteLine(LEFT_OUT)]
            places = [*self.foot_places(lines)]
            found += zip(self.lines_crossed(places), places, strict=True)
            if not (fewest := min(crossed for crossed, _ in found)):
                break
        return [*next(texts for crossed, texts in found if crossed == fewest)]

    def lines_crossed(self, places: Sequence[Sequence[Text]]) -> list[int]:
        """How many drawn lines the texts would cross at each possible place."""
        boxes = [reach(text) for texts in places for text in texts]
        crossed = shapes.met(boxes, shapes.segments(pieces_of(self.marks)))
        return [int(of_one) for of_one in crossed.reshape(len(places), -1).sum(axis=1)]

    def foot_places(self, lines: Sequence[NoteLine]) -> Iterator[list[Text]]:
        """The places, from left to right, for lines at the foot of the field."""
        y = self.rect[3] - LETTERS - LEADING * (len(lines) - 1)
        widest = max(extent(line.markup, LETTERS)[0] for line in lines)
        room = self.across - widest
        for away in range(0, max(1, int(room)), ASIDE):
            yield [
                Text(
                    *(self.rect[0] + 3 + away, y + LEADING * i, line.markup, "caption", LETTERS),
                    name=NOTE,
                    letters=line.parts,
                )
                for i, line in enumerate(lines)
            ]

    def spots(self, more: Sequence[Mark] = (), some: Sequence[Label] | None = None) -> list[Spot]:
        """The places of all labels, or of some, clear of marks, taken boxes and each other."""
        lines, boxes = self.obstacles(more)
        labels = self.labels if some is None else some
        wishes = [label.wish() for label in labels]
        return place(wishes, lines, boxes, self.lettering, strong=strong_lines(self.marks))

    def obstacles(self, more: Sequence[Mark] = ()) -> tuple[Array, list[Box]]:
        """The lines and boxes that labels avoid: those of the marks, and of some more marks."""
        marks = [*self.marks, *more]
        boxes = [*self.taken, *(reach(mark) for mark in marks if is_lettering(mark))]
        return pieces_of(marks), boxes


def is_lettering(mark: Mark) -> bool:
    """Whether a mark is a text or the circle around a link's number, which no leader crosses."""
    return isinstance(mark, Text) or style_class(mark) == "number"


class NoteLine(NamedTuple):
    """A line at the foot of a field, and the part of each note in it."""

    markup: str
    parts: tuple[SharedLetter, ...] = ()


def note_lines(notes: Sequence[FootNote], between: str, width: float) -> list[NoteLine]:
    """Notes in lines of a width in mm, broken between notes if possible, else between words."""
    notes = listed_notes(notes)
    lines = flowed_pieces([note.markup for note in notes], between, width, LETTERS)
    if max((extent(line, LETTERS)[0] for line, _ in lines), default=0.0) <= width:
        owners, pieces = [*range(len(notes))], [note.markup for note in notes]
    else:
        ended = [f"{note.markup}{between.rstrip()}" for note in notes[:-1]] + [notes[-1].markup]
        all_words = [(i, word) for i, said in enumerate(ended) for word in words_of(said)]
        owners, pieces = [i for i, _ in all_words], [word for _, word in all_words]
        lines = flowed_pieces(pieces, " ", width, LETTERS)
    return [
        NoteLine(line, tuple(parts(notes, between, owners, pieces, held))) for line, held in lines
    ]


def listed_notes(notes: Sequence[FootNote]) -> list[FootNote]:
    """The notes in order, those with one lead last and together, the first of them with it."""
    found = [note for note in notes if not note.lead]
    for lead in dict.fromkeys(note.lead for note in notes if note.lead):
        first, *others = (note for note in notes if note.lead == lead)
        found += [replace(first, markup=f"{lead} {first.markup}"), *others]
    return found


def parts(
    notes: Sequence[FootNote],
    between: str,
    owners: Sequence[int],
    pieces: Sequence[str],
    held: Sequence[int],
) -> Iterator[SharedLetter]:
    """The parts of the notes in a line of some pieces, by the notes' subjects."""
    for nth, (owner, run) in enumerate(groupby(held, lambda k: owners[k])):
        said = " ".join(pieces[k] for k in run).removesuffix(between.rstrip())
        yield SharedLetter(notes[owner].of, said, between if nth else "")


def free_ones(board: FieldContent, spots: Sequence[Spot]) -> list[Mark]:
    """The labels of a field that have a free place."""
    free = [(label, spot) for label, spot in zip(board.labels, spots, strict=True) if spot.free]
    return marks_of([label for label, _ in free], [spot for _, spot in free])


def stays(label: Label, spot: Spot, boxes: Sequence[Rect]) -> bool:
    """Whether a label with its leader is clear of newly taken boxes."""
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
    """Whether a leader from a label's box to its point crosses no label of another name."""
    start, end = label.short_leader(spot)
    others = [box for name, box in areas if name != label.name and near(box, *start)]
    return not any(clipped(start, end, box) for box in others)


def near(box: Rect, x: float, y: float) -> bool:
    """Whether a box lies within reach of a short leader that starts at a place."""
    far = 2 * LED
    return box[0] - far < x < box[2] + far and box[1] - far < y < box[3] + far


# --- a field that is too full: essential labels come first ----------------------------------------


def by_need(
    board: FieldContent, wished: Sequence[Label], meanings: Sequence[FootNote]
) -> tuple[list[Mark], list[Spot]]:
    """Place letters of points and numbers first, then names of vectors, construction letters last.

    The labels are tried as requested, and then as shortened, with their key numbers explained.
    Returns the field's foot and the places. A letter or number of a link that still has no place is
    noted in the foot.
    """
    shortened = board.labels
    try:
        board.labels = list(wished)
        return in_turn(board, board.notes)
    except PageError:
        board.labels = shortened
    try:
        return in_turn(board, [*board.notes, *meanings])
    except PageError:
        board.labels = shortened
        return in_turn(board, [*board.notes, *meanings], wished)


def must_be_named(label: Label) -> bool:
    """Whether a label is the letter of a point or the number of a link."""
    return not label.spare and label.cls not in HELPERS


def in_turn(
    board: FieldContent, notes: Sequence[FootNote], noted: Sequence[Label] = ()
) -> tuple[list[Mark], list[Spot]]:
    """Place essential labels before dispensable ones.

    Labels without a place are removed; vectors without a name are noted in the foot. Letters and
    numbers are noted in the form ``noted``. Without it, PageError is raised where one has no place.
    """
    labels = board.labels
    vectors = [i for i, label in enumerate(labels) if label.spare and label.cls not in HELPERS]
    helpers = [i for i, label in enumerate(labels) if label.cls in HELPERS]
    first = [i for i, label in enumerate(labels) if must_be_named(label)]
    left_out: list[int] = []
    while True:
        unused = {labels[i].markup for i in left_out} if noted else set[str]()
        said = [note for note in notes if note.of not in unused]
        names = [(noted or labels)[i].markup for i in left_out]
        foot = board.footed([*said, *board.nameless(names)])
        found: dict[int, Spot] = {}
        for which in (first, vectors, helpers):
            wanted = [i for i in which if i not in left_out]
            found |= placed_after(board, foot, found, wanted)
        if not noted:
            refuse_crowds([labels[i] for i in first], [found[i] for i in first])
        crowded = [
            i
            for i, spot in found.items()
            if not spot.free and (labels[i].spare or labels[i].cls not in HELPERS)
        ]
        if not crowded:
            break
        left_out = sorted([*left_out, *crowded])
    board.unplaced = [noted[i] for i in left_out if noted and must_be_named(noted[i])]
    kept = [i for i in sorted(found) if found[i].free]
    board.labels = [labels[i] for i in kept]
    return foot, [found[i] for i in kept]


def placed_after(
    board: FieldContent, foot: Sequence[Mark], found: Mapping[int, Spot], which: Sequence[int]
) -> dict[int, Spot]:
    """The places of some labels, clear of those already placed."""
    taken = [m for i, spot in found.items() if spot.free for m in board.labels[i].marks(spot)]
    spots = board.spots([*foot, *taken], [board.labels[i] for i in which])
    return dict(zip(which, spots, strict=True))


def refuse_crowds(labels: Sequence[Label], spots: Sequence[Spot]) -> None:
    """Raise PageError naming every label for which there was no free place."""
    crowded = [label for label, spot in zip(labels, spots, strict=True) if not spot.free]
    if crowded:
        raise PageError(no_place_for(crowded))


def no_place_for(labels: Sequence[Label]) -> Problem:
    """The problem that some labels have no place in a field."""
    names = ", ".join(label.name or plain(label.markup) for label in labels)
    return Problem(
        "labels",
        message("does not fit: no free place for {names}", names=names),
        message("room for every name"),
        message("ask for less on one sheet, or choose a position in which less falls together"),
    )


# --- fields of a page that do not overlap, with all their labels placed at once -------------------


KEPT = 2**24
"""Bytes of a block after whose release the C library of Linux keeps memory for reuse."""


def finished(
    boards: Sequence[FieldContent], details: Sequence[FieldContent] = ()
) -> tuple[list[list[Mark]], list[list[Spot]]]:
    """The marks of finished fields, and the places of the labels of details drawn elsewhere.

    All labels are placed at once; none of the fields and details overlap.
    """
    feet = [board.footed(board.notes) for board in boards]
    found = spots_on([*boards, *details], [*feet, *([] for _ in details)])
    made = zip(feet, found[: len(boards)], strict=True)
    marks = [board.finish(each) for board, each in zip(boards, made, strict=True)]
    return marks, found[len(boards) :]


def spots_on(boards: Sequence[FieldContent], more: Sequence[Sequence[Mark]]) -> list[list[Spot]]:
    """The places of all labels of fields that do not overlap, found at once.

    ``more`` are further marks of each field that its labels avoid.
    """
    keep_memory()
    obstacles = [board.obstacles(marks) for board, marks in zip(boards, more, strict=True)]
    lines = np.concatenate([drawn for drawn, _ in obstacles])
    boxes = [box for _, taken in obstacles for box in taken]
    wishes = [label.wish() for board in boards for label in board.labels]
    fields = [board.lettering for board in boards for _ in board.labels]
    strong = np.concatenate([strong_lines(board.marks) for board in boards])
    found = iter(place(wishes, lines, boxes, fields, strong=strong))
    return [[next(found) for _ in board.labels] for board in boards]


@lru_cache(maxsize=1)
def keep_memory() -> None:
    """Keep the memory of arrays for later ones; returning it takes a tenth of a page's time.

    Processor time of the layout and SVG of two pages with it and without, in ms: stephenson-3 30.2
    and 34.9, gears-ring 21.3 and 26.2.
    """
    np.empty(KEPT, dtype=np.uint8)


# --- vectors that lie along one another -----------------------------------------------------------


BESIDE_LINE = 0.1
"""Largest distance in mm of both ends of a line from another that it lies along."""
WHOLE = 0.999
"""Share of a vector above which another covers all of it and leaves nothing bare."""
LEAST_STRETCH = 8.0
"""Length in mm of a stretch that has room for a name."""


def at_bare_stretches(labels: Sequence[Label], marks: Sequence[Mark]) -> list[Label]:
    """The labels, with those of vectors at the longest stretch that no other vector covers.

    Where no stretch is long enough, or nothing is covered, they name the whole vector.
    """
    drawn = [m for m in marks if isinstance(m, LineMark) and style_class(m) in VECTORS]
    return [
        replace(label, subject=bare_stretch(label, drawn))
        if segment_of(label) and label.cls in VECTORS
        else label
        for label in labels
    ]


def bare_stretch(label: Label, drawn: Sequence[LineMark]) -> tuple[XY, XY] | XY:
    """The longest stretch of a label's vector that no other covers, or the whole vector."""
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
    if (high - low) * long < LEAST_STRETCH:
        return label.subject
    first, last = ((x0 + at * (x1 - x0), y0 + at * (y1 - y0)) for at in (low, high))
    return first, last


def laps(
    name: str, ends: tuple[XY, XY], drawn: Sequence[LineMark]
) -> Iterator[tuple[float, float]]:
    """The shares of a vector along which another lies, from and to, except full covers."""
    (x0, y0), (x1, y1) = ends
    dx, dy = x1 - x0, y1 - y0
    square = dx * dx + dy * dy
    for line in drawn:
        places = (line.x1 - x0, line.y1 - y0), (line.x2 - x0, line.y2 - y0)
        aside = max(abs(u * dy - v * dx) for u, v in places)
        if line.name != name and aside <= BESIDE_LINE * square**0.5:
            low, high = sorted((u * dx + v * dy) / square for u, v in places)
            part = max(low, 0.0), min(high, 1.0)
            if 0 < part[1] - part[0] < WHOLE:
                yield part
