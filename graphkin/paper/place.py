"""Places for labels on a page: near their subjects, clear of lines, boxes and each other (mm)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import inf

import numpy as np
from numpy.typing import ArrayLike

from graphkin.paper.candidates import NOWHERE, Array, Box, Subjects, tries
from graphkin.paper.clearance import Clashes, Page, Places

Point = tuple[float, float]
Segment = tuple[Point, Point]

CLEAR = 0.6  # mm between a label and a drawn line, unless the caller says otherwise
NEAR = np.array([0.0, 0.6, 1.4, 2.8])  # mm beyond the gap, without a leader
FAR = np.array([4.0, 7.0, 11.0, 17.0])  # mm beyond the gap, with a leader
FARTHEST = np.array([*FAR, 24.0, 33.0])  # for labels that find no other place

NEAREST = slice(0, 32)  # which of a label's places without a leader are looked at, by distance
FIRST, REST = slice(0, 32), slice(32, 999)  # with a leader: at first, and where nothing was free

SIDE = 1.5  # cost of a place square to the preferred side; all costs are in mm of distance
UNPLACED = 1000.0  # a label without a place
DEAR = 7.4  # what a label may pay before places with a leader are looked for
BAD = 2.0  # what a label may pay above its best before places are traded
CROWD = 8  # how many labels are settled anew for one without a place
PUSH = 4.0  # what it is reckoned to cost to push a label aside
WEAR = 4.0  # what a place costs more each time that it is taken in a chase


@dataclass(frozen=True, slots=True)
class Wish:
    """One label that wants a place; lengths in mm, y down."""

    width: float  # of the ink
    height: float
    subject: Point | Segment  # the point or the segment that it names
    away: Point | None = None  # unit vector from the subject to the preferred side
    priority: int = 0  # the higher goes first
    gap: float = 1.0  # clear distance to the subject
    radius: float = 0.0  # of the circle that a point subject is drawn as


@dataclass(frozen=True, slots=True)
class Spot:
    """The place of a label, mm: its centre, its leader if it has one, and whether it is free."""

    x: float
    y: float
    leader: Segment | None  # from the label's edge to the subject
    free: bool  # False: nothing in reach was free; use a key number and a legend


def place(
    wishes: Sequence[Wish],
    lines: ArrayLike,
    boxes: ArrayLike,
    field: Box,
    clearance: ArrayLike = CLEAR,
) -> list[Spot]:
    """Return a place for every wish, in the order of the wishes; lengths in mm.

    ``lines`` are drawn segments x0, y0, x1, y1 and ``clearance`` is how far labels stay from
    them (one length or one for each line); ``boxes`` are taken rectangles xmin, ymin, xmax,
    ymax; no label leaves the rectangle ``field``. A label that is ``free`` touches nothing;
    one that is not is returned where it would like to be.
    """
    if not wishes:
        return []
    board = _Board(wishes, Page(_subjects(wishes), lines, boxes, field, clearance))
    board.settle(board.order())
    board.chase(board.sorry(BAD), 8)
    if board.widen([j for i in board.homeless() for j in board.crowd(i)] + board.dear()):
        board.chase(board.sorry(BAD), 8)
    board.chase(board.homeless(), 60)
    if crowd := [j for i in board.homeless() for j in board.crowd(i)]:
        board.widen(crowd)
        board.widen(crowd, REST)
        board.chase(board.homeless(), 60)
    board.settle(board.sorry(0.2))
    return [board.spot(i) for i in range(len(wishes))]


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


class _Board:
    """Which label has which place, and how many placed labels rule out each place."""

    def __init__(self, wishes: Sequence[Wish], page: Page) -> None:
        self.page = page
        self.fine = [UNPLACED * 1.2**wish.priority for wish in wishes]
        self.pick = np.full(len(wishes), -1)
        self.paid = [*self.fine]
        near = tries(page.subjects, NEAR)
        self.hope = near.centre[:, 0]
        self.middle = (page.subjects.ends[:, :2] + page.subjects.ends[:, 2:]) / 2
        self.wide: dict[int, set[int]] = {FIRST.start: set(), REST.start: set()}
        self.clashes = Clashes()
        self._offer(page.places(np.arange(len(wishes)), near, NEAREST, led=False))
        self.widen(i for i, best in enumerate(self.best) if best > DEAR)
        self.clashes.find(int(menu[0]) for menu in self.menus if len(menu))

    def _offer(self, more: Places) -> None:
        """Offer more places; those of a label that cost the same keep their order."""
        self.clashes.add(more.take(np.lexsort((more.cost, more.label))))
        self.places = self.clashes.places
        order = np.lexsort((self.places.cost, self.places.label))
        bounds = np.searchsorted(self.places.label[order], np.arange(1, len(self.pick)))
        self.menus = [order[a:b] for a, b in pairwise([0, *bounds.tolist(), len(order)])]
        self.cost = self.places.cost.tolist()
        self.best = [self.cost[menu[0]] if len(menu) else inf for menu in self.menus]
        self.load = np.zeros(len(order), dtype=np.int64)
        for k in self.pick[self.pick >= 0].tolist():
            self.load += self.clashes.of(k)

    def order(self) -> list[int]:
        """Return the labels, those with few places first, then by priority."""
        count = [len(menu) for menu in self.menus]
        return sorted(range(len(count)), key=lambda i: (count[i] > 7, -self.fine[i], count[i], i))

    def sorry(self, limit: float) -> list[int]:
        """Return the labels that pay this much above their cheapest place, worst first."""
        regret = [paid - best for paid, best in zip(self.paid, self.best, strict=True)]
        worst = sorted(range(len(regret)), key=lambda i: -regret[i])
        return [i for i in worst if regret[i] > limit]

    def settle(self, which: Iterable[int]) -> None:
        """Give each of the labels the cheapest place that is left, if there is one."""
        for i in which:
            self._lift(i)
            left = self.menus[i][self.load[self.menus[i]] == 0]
            if len(left):
                self._put(i, int(left[0]))

    def dear(self) -> list[int]:
        """Return the labels that pay more than a leader would cost."""
        return [i for i, paid in enumerate(self.paid) if paid > DEAR]

    def homeless(self) -> list[int]:
        """Return the labels without a place."""
        return np.flatnonzero(self.pick < 0).tolist()

    def crowd(self, i: int) -> list[int]:
        """Return a label and those with the nearest subjects within 20 mm, nearest first."""
        apart = np.abs(self.middle - self.middle[i]).max(axis=1)
        near = np.argsort(apart, kind="stable")[:CROWD].tolist()
        return [i, *(j for j in near if j != i and apart[j] < 20.0)]

    def widen(self, labels: Iterable[int], span: slice = FIRST) -> bool:
        """Offer places with a leader to those of the labels that had none of these yet, if any."""
        which = np.array(sorted({*labels} - self.wide[span.start]), dtype=np.intp)
        if not len(which):
            return False
        self.wide[span.start].update(which.tolist())
        far = FAR if span == FIRST else FARTHEST
        some = tries(self.page.subjects.take(which), NEAR, far)
        self._offer(self.page.places(which, some, span, led=True))
        if (self.pick >= 0).any():
            self.settle(i for i in self.order() if i in which)
        return True

    def chase(self, labels: Iterable[int], steps: int) -> None:
        """Let each of the labels push others aside and those others in turn, if it pays in all."""
        for i in labels:
            saved = self.pick.copy(), [*self.paid], self.load.copy()
            limit = sum(self.paid) - 0.01
            worn = np.zeros(len(self.load))
            if self.pick[i] >= 0:
                worn[self.pick[i]] = WEAR
            queue = [i]
            for _ in range(steps):
                queue += self._push(queue.pop(0), worn)
                hope = sum(self.paid) - sum(self.fine[j] - self.best[j] for j in queue)
                if not queue or hope > limit:
                    break
            if sum(self.paid) > limit:
                self.pick, self.paid, self.load = saved

    def _push(self, i: int, worn: Array) -> list[int]:
        """Put a label on the place with the best price, and return those it pushed aside."""
        self._lift(i)
        menu = self.menus[i]
        if not len(menu):
            return []
        price = self.places.cost[menu] + PUSH * self.load[menu] + worn[menu]
        k = int(menu[price.argmin()])
        others: list[int] = []
        if self.load[k]:
            clash = self.clashes.of(k)[self.pick] & (self.pick >= 0)
            others = clash.nonzero()[0].tolist()
        for j in others:
            self._lift(j)
        self._put(i, k)
        worn[k] += WEAR
        return others

    def _put(self, i: int, k: int) -> None:
        """Put a label on a place."""
        self.pick[i], self.paid[i] = k, self.cost[k]
        self.load += self.clashes.of(k)

    def _lift(self, i: int) -> None:
        """Take a label off the page."""
        k = int(self.pick[i])
        if k >= 0:
            self.load -= self.clashes.of(k)
        self.pick[i], self.paid[i] = -1, self.fine[i]

    def spot(self, i: int) -> Spot:
        """Return where a label is, or where it would like to be."""
        k = self.pick[i]
        x, y = (self.places.x[k], self.places.y[k]) if k >= 0 else self.hope[i]
        x0, y0, x1, y1 = self.places.leader[k].tolist() if k >= 0 else [NOWHERE] * 4
        return Spot(
            float(x), float(y), ((x0, y0), (x1, y1)) if x0 < NOWHERE else None, bool(k >= 0)
        )
