"""Labels of a drawing: wished for while its marks are made, placed together at the end."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby
from typing import NamedTuple

import numpy as np
from msgspec import Struct, field
from msgspec.structs import replace

from graphkin.drawing import shapes
from graphkin.drawing.areas import Rect
from graphkin.drawing.chords import pieces_of
from graphkin.drawing.field import XY, clipped
from graphkin.drawing.label import LED, SMALL, Label
from graphkin.drawing.leaders import strong_lines, with_leaders
from graphkin.drawing.marks import Mark, SharedLetter, Text, reach
from graphkin.drawing.placement import HOPELESS, Spot, place
from graphkin.drawing.richtext import extent, flowed_pieces, plain, words_of
from graphkin.drawing.shapes import Array, Box
from graphkin.drawing.style import OWN_LINES
from graphkin.text.errors import PageError, Problem

ROUNDS = 4
"""How often labels are placed anew with more key numbers before a field counts as full."""
ASIDE = 15
"""How far a note is moved aside at a time, in mm, where it would stand on lines."""
LEADING = 4.6
"""Distance of lines of notes in mm, so that indices above and below do not meet."""
FOOT = 0.22
"""The part of a field that notes at its foot may take up; beyond it no key numbers are given."""
LEFT_OUT = "…"
"""What stands for the notes that have no room there."""
KEY = 4
"""Priority of a key number."""
NEAR = 0.6
"""How near to a note a label may stand, in mm."""
HELPERS = ("construction", OWN_LINES)
"""Classes of letters that a drawing can do without where there is no room for them."""


NOTE = "note"
"""The name of the lines at the foot of a field."""
BETWEEN = "; "
"""What stands between the notes at the foot of a field."""
EDGE = 0.3
"""How far labels stay inside their field, in mm."""


class FootNote(Struct, frozen=True):
    """What is said at the foot of a field, ``of`` a symbol, or of a key number, in its markup."""

    markup: str
    of: str = ""


class FieldContent(Struct):
    """One field of the page while it is drawn: its marks, and the labels still to be placed.

    ``taken`` are boxes that labels keep clear of, ``notes`` what is said at the field's foot,
    ``lettered`` the places of the labels that are letters of points; ``unnamed`` begins the note
    that lists the vectors for whose names there is no room. At ``crowds`` so much meets that it is
    shown enlarged. Labels that are ``dispensable`` are drawn where the others leave room near.
    ``unplaced`` are letters and numbers of a finished field that are only noted at its foot.
    """

    rect: Rect
    marks: list[Mark] = field(default_factory=list)
    labels: list[Label] = field(default_factory=list)
    taken: list[Rect] = field(default_factory=list)
    notes: list[FootNote] = field(default_factory=list)
    lettered: dict[int, XY] = field(default_factory=dict)
    unnamed: str = ""
    crowds: list[XY] = field(default_factory=list)
    dispensable: list[Label] = field(default_factory=list)
    unplaced: list[Label] = field(default_factory=list)

    @property
    def lettering(self) -> Rect:
        """The part of the field in which labels stand: clear of the lines around it."""
        left, top, right, low = self.rect
        return left + EDGE, top + EDGE, right - EDGE, low - EDGE

    @property
    def across(self) -> float:
        """The width of its foot."""
        return self.rect[2] - self.rect[0] - 6

    @property
    def most_notes(self) -> int:
        """How many lines of notes may stand at its foot; of a small field, as many as there are."""
        lines = int(FOOT * (self.rect[3] - self.rect[1]) / LEADING)
        return lines if lines > 1 else sys.maxsize

    def finish(self, made: tuple[list[Mark], list[Spot]] | None = None) -> list[Mark]:
        """The marks with every label at a free place; in a crowd, key numbers with a legend.

        ``made`` are the field's foot and the places of all labels if these were sought before,
        with other boards'. In a worse crowd letters of the construction are left out, then names
        of vectors, at last other letters, and a note says which. Where more than HOPELESS find
        none, key numbers would not help either.
        """
        meanings: list[FootNote] = []
        wished = list(self.labels)
        foot = made[0] if made else self.footed(self.notes)
        spots = made[1] if made else self.spots(foot)
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
            foot = self.footed([*self.notes, *meanings])
            if len(note_lines([*self.notes, *meanings], self.across)) > self.most_notes:
                self.labels = wished
                foot, spots = in_turn(self, self.notes, wished)
                break
            spots = self.spots_of_new(foot, before, spots) or self.spots(foot)
        named = marks_of(self.labels, with_leaders(self.labels, spots, self.marks))
        return [*self.marks, *foot, *named, *self.beside([*foot, *named])]

    def beside(self, named: Sequence[Mark]) -> list[Mark]:
        """The dispensable labels that have a place near what they name, clear of the rest."""
        if not self.dispensable:
            return []
        some = [replace(label, optional=True) for label in self.dispensable]
        both = zip(some, self.spots(named, some), strict=True)
        return [mark for label, spot in both if spot.free for mark in label.marks(spot)]

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

    def shorten(self, free: Sequence[bool], meanings: list[FootNote]) -> None:
        """Make crowded triangles' letters smaller, all at one pin, and give others key numbers.

        What key numbers mean is for the foot of the field.
        """
        crowded = [i for i, spot_is_free in enumerate(free) if not spot_is_free]
        letters = {self.labels[i].name[:1] for i in crowded if self.labels[i].shrinks}
        for i, label in enumerate(self.labels):
            if label.shrinks and label.name[:1] in letters:
                self.labels[i] = replace(label, height=SMALL)
            elif i in crowded and label.priority < KEY:
                key = f"{len(meanings) + 1})"
                meanings.append(FootNote(f"{key} {label.markup}", key))
                self.labels[i] = replace(label, markup=key, height=SMALL, priority=KEY, letters=())

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

    def footed(self, notes: Sequence[FootNote]) -> list[Mark]:
        """Notes at the foot of the field, where they cross the fewest lines.

        Where whole lines would stand on something drawn, shorter ones beside it are tried.
        """
        if not notes:
            return []
        across = self.across
        found: list[tuple[int, list[Text]]] = []
        for width in (across, across / 2, across / 3):
            lines = note_lines(notes, width)
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
        """How many drawn lines texts would cross in each of some places for them."""
        boxes = [reach(text) for texts in places for text in texts]
        crossed = shapes.met(boxes, shapes.segments(pieces_of(self.marks)))
        return [int(of_one) for of_one in crossed.reshape(len(places), -1).sum(axis=1)]

    def foot_places(self, lines: Sequence[NoteLine]) -> Iterator[list[Text]]:
        """The places, from left to right, in which lines may stand at the foot of the field."""
        y = self.rect[3] - 2.5 - LEADING * (len(lines) - 1)
        widest = max(extent(line.markup, 2.5)[0] for line in lines)
        room = self.across - widest
        for away in range(0, max(1, int(room)), ASIDE):
            yield [
                Text(
                    *(self.rect[0] + 3 + away, y + LEADING * i, line.markup, "caption", 2.5),
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
        """The lines and the boxes that labels keep clear of: of the marks, and of some more."""
        marks = [*self.marks, *more]
        boxes = [*self.taken, *(reach(mark) for mark in marks if isinstance(mark, Text))]
        return pieces_of(marks), boxes


class NoteLine(NamedTuple):
    """A line at the foot of a field, and what of each of its notes stands in it."""

    markup: str
    parts: tuple[SharedLetter, ...] = ()


def note_lines(notes: Sequence[FootNote], width: float) -> list[NoteLine]:
    """Notes in lines of a width in mm, cut between notes if that will do, else between words."""
    lines = flowed_pieces([note.markup for note in notes], BETWEEN, width, 2.5)
    if max((extent(line, 2.5)[0] for line, _ in lines), default=0.0) <= width:
        owners, pieces = [*range(len(notes))], [note.markup for note in notes]
    else:
        ended = [f"{note.markup}{BETWEEN.rstrip()}" for note in notes[:-1]] + [notes[-1].markup]
        told = [(i, word) for i, said in enumerate(ended) for word in words_of(said)]
        owners, pieces = [i for i, _ in told], [word for _, word in told]
        lines = flowed_pieces(pieces, " ", width, 2.5)
    return [NoteLine(line, tuple(parts(notes, owners, pieces, held))) for line, held in lines]


def parts(
    notes: Sequence[FootNote], owners: Sequence[int], pieces: Sequence[str], held: Sequence[int]
) -> Iterator[SharedLetter]:
    """What of each note stands in a line that holds some pieces, by what the note is of."""
    for nth, (owner, run) in enumerate(groupby(held, lambda k: owners[k])):
        said = " ".join(pieces[k] for k in run).removesuffix(BETWEEN.rstrip())
        yield SharedLetter(notes[owner].of, said, BETWEEN if nth else "")


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


# --- a field that is too full: what must be named comes first ------------------------------------


def by_need(
    board: FieldContent, wished: Sequence[Label], meanings: Sequence[FootNote]
) -> tuple[list[Mark], list[Spot]]:
    """Place letters of points and numbers first, then names of vectors, helping letters last.

    First the labels as they were wished, then as they stand, with what their key numbers mean.
    The foot of the field is returned with the places. Where a letter or a number of a link finds
    no place even so, it is noted there.
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
    """Place what must be named before what may be left out.

    What finds no place is taken off the board; vectors that stay without a name are noted at the
    foot. So are letters and numbers, as they are ``noted``; without these PageError is raised where
    one finds none.
    """
    labels = board.labels
    vectors = [i for i, label in enumerate(labels) if label.spare]
    helpers = [i for i, label in enumerate(labels) if label.cls in HELPERS]
    first = [i for i, label in enumerate(labels) if must_be_named(label)]
    left_out: list[int] = []
    while True:
        names = ", ".join(dict.fromkeys((noted or labels)[i].markup for i in left_out))
        unused = {labels[i].markup for i in left_out} if noted else set[str]()
        said = [note for note in notes if note.of not in unused]
        foot = board.footed([*said, *([FootNote(f"{board.unnamed} {names}")] if names else [])])
        found: dict[int, Spot] = {}
        wanted = [[i for i in which if i not in left_out] for which in (first, vectors)]
        for which in (*wanted, helpers):
            found |= placed_after(board, foot, found, which)
        if not noted:
            refuse_crowds([labels[i] for i in first], [found[i] for i in first])
        crowded = [i for which in wanted for i in which if not found[i].free]
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
    """The places of some labels, clear of those that have theirs."""
    taken = [m for i, spot in found.items() if spot.free for m in board.labels[i].marks(spot)]
    spots = board.spots([*foot, *taken], [board.labels[i] for i in which])
    return dict(zip(which, spots, strict=True))


def refuse_crowds(labels: Sequence[Label], spots: Sequence[Spot]) -> None:
    """Raise PageError naming every label for which there was no free place."""
    crowded = [
        label.name or plain(label.markup)
        for label, spot in zip(labels, spots, strict=True)
        if not spot.free
    ]
    if crowded:
        raise PageError(
            Problem(
                "labels",
                "does not fit: no free place for " + ", ".join(crowded),
                "room for every name",
                "ask for less on one sheet, or choose a position in which less falls together",
            )
        )
