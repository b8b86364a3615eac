"""Places for labels on a page: near their subjects, clear of lines, boxes and each other (mm)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from msgspec import Struct
from numpy.typing import ArrayLike

from graphkin.drawing.assignment import CLOSE, FEW, Assignment, CandidateSet, Level
from graphkin.drawing.candidates import Subjects
from graphkin.drawing.clearance import Clearance
from graphkin.drawing.shapes import NOWHERE, Box

Point = tuple[float, float]
Segment = tuple[Point, Point]

CLEAR = 0.6  # mm between a label and a drawn line
SIDE = 1.5  # cost of a place square to the preferred side; all costs are in mm of distance
UNPLACED, OPTIONAL = 1000.0, 100.0  # a label without a place, and one that may stay so
DEAR = 7.4  # what a label may pay before places with a leader are looked for
STRUCK = 20.0  # what a place costs at least whose leader crosses a strong line
WIDE = Level(108, 12)  # how far a label looks that has such a place
BAD = 2.0  # what a label may pay above its best before places are traded
CROWD, AROUND = 8, 20.0  # how many labels are a crowd around one without a place, within how far
HOPELESS = 60  # so many labels without a place that none are sought for them but the nearest
MANY = 300  # labels of which each is offered fewer places
SHORT, LONG, LONGEST = 8, 16, 150  # how many labels are pushed about in a chase
LAST_RESORT = (
    (Level(48, 16), Level(128, 32)),
    (Level(128, 32), Level(999, 64)),
    (Level(999, 999), Level(999, 999)),
)
"""What is offered at last to the labels around one without a place, and to that one itself."""


class Wish(Struct, frozen=True):
    """One label that wants a place; lengths in mm, y down."""

    width: float  # of the ink
    height: float
    subject: Point | Segment  # the point or the segment that it names
    away: Point | None = None  # unit vector from the subject to the preferred side
    priority: int = 0  # the higher goes first
    gap: float = 1.0  # clear distance to the subject
    radius: float = 0.0  # of the circle that a point subject is drawn as
    optional: bool = False  # it may stay without a place


class Spot(Struct, frozen=True):
    """The place of a label, mm: its centre, its leader if it has one, and whether it is free."""

    x: float
    y: float
    leader: Segment | None  # from the label's edge to the subject
    free: bool  # False: nothing in reach was free; use a key number and a legend


def place(
    wishes: Sequence[Wish],
    lines: ArrayLike,
    boxes: ArrayLike,
    field: Box | Sequence[Box],
    strong: ArrayLike = (),
) -> list[Spot]:
    """Return a place for every wish, in the order of the wishes; lengths in mm.

    ``lines`` are drawn segments x0, y0, x1, y1, ``strong`` those that leaders should not cross;
    ``boxes`` are taken rectangles xmin, ymin, xmax, ymax; no label leaves the rectangle ``field``,
    or its own one if there is one for each. A label that is ``free`` touches nothing; one that is
    not is returned where it would like to be.
    """
    if not wishes:
        return []
    page = Clearance(_subjects(wishes), lines, boxes, field, CLEAR, strong)
    offers = CandidateSet(page, FEW if len(wishes) > MANY else CLOSE)
    fines = [(OPTIONAL if w.optional else UNPLACED) * 1.2**w.priority for w in wishes]
    seats = Assignment(offers, fines)
    seats.settle(seats.order())
    seats.improve(seats.regretted(BAD), SHORT)
    seats.shift(seats.unplaced())
    fields = 1 if len(field) == 4 and isinstance(field[0], float) else len({*field})
    if len(seats.seeking()) <= HOPELESS * fields:
        _widen(seats)
    seats.settle(seats.regretted(0.2))
    return [_spot(offers, i, place) for i, place in enumerate(seats.pick)]


def _subjects(wishes: Sequence[Wish]) -> Subjects:
    """Return the wishes as arrays."""
    both = [w.subject if isinstance(w.subject[0], tuple) else (w.subject,) * 2 for w in wishes]
    ends = np.array(both, dtype=np.float64).reshape(-1, 4)
    line = np.any(ends[:, :2] != ends[:, 2:], axis=1)
    sizes = np.array([(w.width / 2, w.height / 2, w.gap, w.radius) for w in wishes])
    lean = [
        (SIDE * w.away[0], SIDE * w.away[1]) if w.away else (0.0 if seg else 0.15, -0.2)
        for w, seg in zip(wishes, line, strict=True)
    ]
    return Subjects(ends, sizes[:, :2], sizes[:, 2], sizes[:, 3], np.array(lean), line)


def _widen(seats: Assignment) -> None:
    """Let labels without a place, or with a dear one, look further, and those around them too."""
    offers = seats.offers
    dear = [i for i, paid in enumerate(seats.paid) if paid > DEAR and not seats.is_given_up(i)]
    more = dict.fromkeys(dear, CLOSE) | _round_about(seats, CLOSE, Level(32, 12))
    if offers.widen(more):
        seats.settle(i for i in seats.order() if i in more)
        seats.improve(seats.regretted(BAD), SHORT)
    paying = (i for i, paid in enumerate(seats.paid) if paid > STRUCK)
    struck = dict.fromkeys((i for i in paying if not seats.is_given_up(i)), WIDE)
    if offers.widen(struck):
        seats.settle(i for i in seats.order() if i in struck)
    before = [*seats.pick]
    seats.shift(seats.seeking())
    seats.improve(seats.seeking(), LONG)
    for levels in LAST_RESORT:
        if offers.widen(_round_about(seats, *levels)):
            seats.shift(seats.seeking())
            seats.improve(seats.seeking(), LONGEST)
    if seats.pick != before:
        seats.improve(seats.regretted(BAD), SHORT)


def _round_about(seats: Assignment, crowded: Level, seeking: Level) -> dict[int, Level]:
    """Return what is to be offered to labels without a place, and to those around them."""
    return dict.fromkeys(_crowds(seats), crowded) | dict.fromkeys(seats.seeking(), seeking)


def _crowds(seats: Assignment) -> list[int]:
    """Return the labels around each one without a place that has a place in sight."""
    offers, seeking = seats.offers, seats.seeking()
    found: list[int] = []
    ends = offers.page.subjects.ends
    middle = (ends[:, :2] + ends[:, 2:]) / 2
    for i in seeking:
        if offers.menus[i]:
            apart = np.abs(middle - middle[i]).max(axis=1)
            near = np.argsort(apart, kind="stable")[:CROWD].tolist()
            found += [j for j in near if apart[j] < AROUND]
    return found


def _spot(offers: CandidateSet, label: int, place: int) -> Spot:
    """Return where a label is, or where it would like to be if it has no place."""
    if place < 0:
        x, y = offers.hope[label].tolist()
        return Spot(x, y, None, False)
    places = offers.places
    x0, y0, x1, y1 = places.leader[place].tolist()
    leader = ((x0, y0), (x1, y1)) if x0 < NOWHERE else None
    return Spot(float(places.x[place]), float(places.y[place]), leader, True)
