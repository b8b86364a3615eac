"""Places for labels on a page: near their subjects, clear of lines, boxes and each other; mm."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise
from math import inf
from typing import NamedTuple

import numpy as np
from msgspec import Struct
from numpy.typing import ArrayLike

from graphkin.drawing.clearance import NO_PLACES, Clashes, Clearance, OpenPlaces, Subjects, tries
from graphkin.drawing.shapes import NOWHERE, Box, Index, where

NEAR = np.array([0.0, 0.6, 1.4, 2.8])  # mm beyond the gap, without a leader
MOST = 12_000  # most places offered on a page: the memory needed grows with their square
AT_ONCE = 64  # labels whose wider search is done at once
FAR = np.array([4.0, 7.0, 10.5, 14.0])  # mm beyond the gap, with a leader


class Level(NamedTuple):
    """How many candidates of a label are examined, cheapest first, and how many are offered."""

    seen: int
    offered: int  # the cheapest ones, at once


NONE, FEW, CLOSE = Level(0, 0), Level(24, 4), Level(24, 10)


class CandidateSet:
    """The places offered to each label, cheapest first, and which of them exclude each other.

    ``menus`` holds the numbers of each label's places. ``cost`` and ``label`` are indexed by place,
    and ``best`` is the cost of each label's cheapest place.
    """

    def __init__(self, page: Clearance, first: Level = CLOSE) -> None:
        """Offer every label its nearest places."""
        self.page = page
        near = tries(page.subjects, NEAR)
        self.hope = np.array([near.x[:, 0], near.y[:, 0]]).T
        self.level = [NONE] * len(near.x)  # of the candidates with a leader
        self.clashes, self.rest = Clashes(), NO_PLACES
        every = np.arange(len(near.x))
        seen, offered = (np.full(len(every), number) for number in first)
        self._offer(page.near(page.open(every, near, 0 * every, seen)), offered)

    def widen(self, levels: Mapping[int, Level]) -> bool:
        """Offer places with a leader to labels at lower levels; True if there were any."""
        behind = {i: level for i, level in sorted(levels.items()) if self.level[i] < level}
        if not behind:
            return False
        most = np.zeros(len(self.level), dtype=np.intp)
        most[[*behind]] = [level.offered for level in behind.values()]
        wanted = most.take(self.rest.label) > 0
        more = self.rest.take(where(wanted)).joined(self._led(behind))
        self.rest = self.rest.take(where(~wanted))
        for i, level in behind.items():
            self.level[i] = level
        self._offer(more, most)
        return True

    def _led(self, levels: Mapping[int, Level]) -> OpenPlaces:
        """Return the places with a leader that some labels have not examined yet."""
        seeking = [i for i, level in levels.items() if self.level[i].seen < level.seen]
        found = NO_PLACES
        for start in range(0, len(seeking), AT_ONCE):
            rows = np.array(seeking[start : start + AT_ONCE])
            first, last = (np.array([a[i].seen for i in rows]) for a in (self.level, levels))
            some = tries(self.page.subjects.take(rows), NEAR, FAR)
            found = found.joined(self.page.led(self.page.open(rows, some, first, last)))
        return found

    def _offer(self, more: OpenPlaces, most: Index) -> None:
        """Offer the cheapest of some places, at most ``most`` for each label, and keep the rest.

        Places of a label with equal costs keep their order.
        """
        order = np.lexsort((more.cost, more.label))
        label = more.label.take(order)
        rank = np.arange(len(order)) - np.searchsorted(label, label)
        cheap = rank < most[label]
        room = max(MOST - len(self.clashes.places.label), 0)
        if np.count_nonzero(cheap) > room:
            cheap &= rank < np.sort(rank[cheap])[room]
        self.clashes.add(more.take(order.take(where(cheap))))
        self.rest = self.rest.joined(more.take(order.take(where(~cheap))))
        self.places = self.clashes.places
        order = np.lexsort((self.places.cost, self.places.label))
        bounds = np.searchsorted(self.places.label[order], np.arange(1, len(self.level)))
        ranked = order.tolist()
        self.menus = [ranked[a:b] for a, b in pairwise([0, *bounds.tolist(), len(order)])]
        self.cost, self.label = self.places.cost.tolist(), self.places.label.tolist()
        self.best = [self.cost[menu[0]] if menu else inf for menu in self.menus]

    def rows(self) -> list[int]:
        """Return for each place the others that it excludes, as a bit mask."""
        return self.clashes.rows()


PUSH = 4.0  # estimated cost, in mm, of pushing a label aside
GAIN = 0.01  # mm that a chain of pushes must save in total to be kept
WEAR = 4.0  # extra cost of a place, in mm, each time that a chain of pushes takes it

LEAST = 500.0  # least fine of labels that must have a place
URGENT = 2500.0  # least fine, in mm, of labels that choose first

Moves = tuple[tuple[int, int], ...]


class Assignment:
    """The place of each label, what each label pays, and the taken places as a bit mask."""

    def __init__(self, offers: CandidateSet, fine: Sequence[float]) -> None:
        """Start with no label on the page; each label pays a fine as long as it has no place."""
        self.offers, self.fine = offers, fine
        self.pick = [-1] * len(fine)
        self.paid = [*fine]
        self.taken = 0

    def order(self) -> list[int]:
        """Return the labels: the urgent ones, then those with few places, then by priority."""
        count, fine = [len(menu) for menu in self.offers.menus], self.fine
        first = [(fine[i] < URGENT, count[i] > 7, -fine[i], count[i], i) for i in range(len(fine))]
        return [i for *_, i in sorted(first)]

    def regretted(self, limit: float) -> list[int]:
        """Return the labels that pay over ``limit`` more than their cheapest place, worst first."""
        regret = [paid - best for paid, best in zip(self.paid, self.offers.best, strict=True)]
        worst = sorted(range(len(regret)), key=lambda i: -regret[i])
        return [i for i in worst if regret[i] > limit]

    def unplaced(self) -> list[int]:
        """Return the labels without a place."""
        return [i for i, k in enumerate(self.pick) if k < 0]

    def seeking(self) -> list[int]:
        """Return the labels without a place that must have one."""
        return [i for i in self.unplaced() if not self.is_given_up(i)]

    def is_given_up(self, i: int) -> bool:
        """Whether a label has no place and may stay without one."""
        return self.pick[i] < 0 and self.fine[i] < LEAST

    def settle(self, which: Iterable[int]) -> None:
        """Give each of the labels the cheapest free place, if there is one."""
        rows = self.offers.rows()
        for i in which:
            self._lift(i)
            left = (k for k in self.offers.menus[i] if not rows[k] & self.taken)
            self._put(i, next(left, -1))

    def shift(self, labels: Iterable[int]) -> None:
        """Give labels a place that a chain of other labels can free, each moving elsewhere."""
        rows = self.offers.rows()
        for i in labels:
            moves = self._moves(i, rows)
            for label, _ in moves:
                self._lift(label)
            for label, place in moves:
                self._put(label, place)

    def _moves(self, i: int, rows: Sequence[int]) -> Moves:
        """Return the shortest chain of moves that gives a label a place, as (label, place) pairs.

        Each label in the chain displaces one other at most; () where no chain ends at a free place.
        """
        moved = {i}
        queue: deque[tuple[int, int, Moves]] = deque([(i, self.taken, ())])
        while queue:
            label, taken, moves = queue.popleft()
            for k in self.offers.menus[label]:
                clash = rows[k] & taken
                if not clash:
                    return (*moves, (label, k))
                other = self.offers.label[clash.bit_length() - 1]
                if clash.bit_count() == 1 and other not in moved:
                    moved.add(other)
                    queue.append((other, taken ^ clash | 1 << k, (*moves, (label, k))))
        return ()

    def improve(self, labels: Iterable[int], steps: int) -> None:
        """Let each label push others aside, and those others in turn, if the total cost falls."""
        rows = self.offers.rows()
        for i in labels:
            if not self.offers.menus[i]:
                continue
            saved = [*self.pick], [*self.paid], self.taken
            before = sum(self.paid)
            least = before - self.paid[i] + self.offers.best[i]  # as if the others paid their best
            worn, queue = {self.pick[i]: WEAR}, deque([i])
            self._lift(i)
            for _ in range(steps):
                least += self._push(queue, rows, worn)
                if not queue or least > before - GAIN:
                    break
            if sum(self.paid) > before - GAIN:
                self.pick, self.paid, self.taken = saved

    def _push(self, queue: deque[int], rows: Sequence[int], worn: dict[int, float]) -> float:
        """Put the first label of a queue on the place with the best price.

        The labels that it pushes aside join the queue. Return how much the total above the best
        costs grows.
        """
        i = queue.popleft()
        offers, taken, best, chosen, pushed = self.offers, self.taken, inf, -1, 0
        cost = offers.cost
        for k in offers.menus[i]:
            price = cost[k]
            if price >= best:  # the places after it cost at least as much
                break
            if clash := rows[k] & taken:
                price += PUSH * clash.bit_count()
            if k in worn:
                price += worn[k]
            if price < best:
                best, chosen, pushed = price, k, clash
        more: float = cost[chosen] - offers.best[i]
        self.taken ^= pushed
        for j in self._on(pushed):
            more += offers.best[j] - self.paid[j]
            self.pick[j], self.paid[j] = -1, self.fine[j]
            queue.append(j)
        self._put(i, chosen)
        worn[chosen] = worn.get(chosen, 0.0) + WEAR
        return more

    def _on(self, places: int) -> list[int]:
        """Return the labels of the places in a bit mask, sorted."""
        found = []
        while places:
            k = places.bit_length() - 1
            places ^= 1 << k
            found.append(self.offers.label[k])
        return sorted(found)

    def _put(self, i: int, k: int) -> None:
        if k >= 0:
            self.pick[i], self.paid[i] = k, self.offers.cost[k]
            self.taken |= 1 << k

    def _lift(self, i: int) -> None:
        if self.pick[i] >= 0:
            self.taken ^= 1 << self.pick[i]
        self.pick[i], self.paid[i] = -1, self.fine[i]


# --- placing the labels of a page -----------------------------------------------------------------


Point = tuple[float, float]
Segment = tuple[Point, Point]

CLEAR = 0.6  # mm between a label and a drawn line
SIDE = 1.5  # cost of a place perpendicular to the preferred side; all costs are in mm of distance
UNPLACED, OPTIONAL = 1000.0, 100.0  # fine of a label without a place, and of one that may stay so
DEAR = 7.4  # what a label may pay before places with a leader are searched
STRUCK = 20.0  # least cost of a place whose leader crosses a strong line
WIDE = Level(192, 48)  # how widely a label with such a place searches
BAD = 2.0  # what a label may pay above its best before places are exchanged
CROWD, AROUND = 8, 20.0  # most labels around one without a place, within how many mm
HOPELESS = 60  # number of labels without a place above which only near places are searched
MANY = 300  # above this many labels, each is offered fewer places
SHORT, LONG, LONGEST = 8, 16, 150  # steps of a chain of pushes
LAST_RESORT = (
    (Level(48, 16), Level(128, 32)),
    (Level(128, 32), Level(999, 64)),
    (Level(999, 999), Level(999, 999)),
)
"""The last offers to the labels around one without a place, and to that label itself."""


class Wish(Struct, frozen=True):
    """A label that needs a place; lengths in mm, y down."""

    width: float  # of the ink
    height: float
    subject: Point | Segment  # the point or the segment that it labels
    away: Point | None = None  # unit vector from the subject to the preferred side
    priority: int = 0  # higher goes first
    gap: float = 1.0  # free distance to the subject
    radius: float = 0.0  # of the circle that marks a point subject
    optional: bool = False  # may stay without a place
    spare: bool = False  # stays without a place rather than with a leader across a strong line


class Spot(Struct, frozen=True):
    """The place of a label, in mm: its centre, its leader if any, and whether the place is free."""

    x: float
    y: float
    leader: Segment | None  # from the label's edge to the subject
    free: bool  # False: no free place within reach; use a key number and a legend


def place(
    wishes: Sequence[Wish],
    lines: ArrayLike,
    boxes: ArrayLike,
    field: Box | Sequence[Box],
    strong: ArrayLike = (),
) -> list[Spot]:
    """Return a place for every wish, in the order of the wishes; lengths in mm.

    ``lines`` are drawn segments x0, y0, x1, y1; ``strong`` are those that leaders should not cross.
    ``boxes`` are taken rectangles xmin, ymin, xmax, ymax. No label leaves the rectangle ``field``,
    or its own rectangle if ``field`` has one for each label. A label that is ``free`` touches
    nothing; one that is not is returned at its preferred place.
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
    spare = np.array([w.spare for w in wishes], dtype=np.bool_)
    return Subjects(ends, sizes[:, :2], sizes[:, 2], sizes[:, 3], np.array(lean), line, spare)


def _widen(seats: Assignment) -> None:
    """Widen the search for labels with no place or a dear one, and for the labels around them."""
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
        seats.improve([i for i in struck if seats.paid[i] > STRUCK], LONG)
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
    """Return the levels for labels without a place, and for those around them."""
    return dict.fromkeys(_crowds(seats), crowded) | dict.fromkeys(seats.seeking(), seeking)


def _crowds(seats: Assignment) -> list[int]:
    """Return the labels around each one without a place that has places to choose from."""
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
    """Return the place of a label, or its preferred place if it has none."""
    if place < 0:
        x, y = offers.hope[label].tolist()
        return Spot(x, y, None, False)
    places = offers.places
    x0, y0, x1, y1 = places.leader[place].tolist()
    leader = ((x0, y0), (x1, y1)) if x0 < NOWHERE else None
    return Spot(float(places.x[place]), float(places.y[place]), leader, True)
