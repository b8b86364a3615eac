"""Places for labels on a page: near their subjects, clear of lines, boxes and each other (mm)."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import inf

import numpy as np
from numpy.typing import ArrayLike

from graphkin.paper.candidates import Subjects, tries
from graphkin.paper.clashes import NO_PLACES, Clashes, Places
from graphkin.paper.clearance import Page
from graphkin.paper.shapes import NOWHERE, Array, Box

Point = tuple[float, float]
Segment = tuple[Point, Point]

CLEAR = 0.6  # mm between a label and a drawn line, unless the caller says otherwise
NEAR = np.array([0.0, 0.6, 1.4, 2.8])  # mm beyond the gap, without a leader
FAR = np.array([4.0, 7.0, 11.0, 17.0])  # mm beyond the gap, with a leader
FARTHEST = np.array([*FAR, 24.0, 33.0])  # for labels that find no other place

NEAREST, NEXT = 32, 96  # how many of a label's candidates are looked at, by distance, and then
FEW, MANY = 12, 32  # how many of these are offered at first, the cheapest ones
SOME, ALL = 8, 999  # the same in the last resort: some more of a whole crowd's, then all of them

SIDE = 1.5  # cost of a place square to the preferred side; all costs are in mm of distance
UNPLACED = 1000.0  # a label without a place
DEAR = 7.4  # what a label may pay before places with a leader are looked for
BAD = 2.0  # what a label may pay above its best before places are traded
CROWD = 8  # how many labels are settled anew for one without a place
PUSH = 4.0  # what it is reckoned to cost to push a label aside
SHORT, LONG, LONGEST = 8, 150, 400  # how many labels are pushed about in a chase
GAIN = 0.01  # what a chase must save in all to be kept
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
    field: Box | Sequence[Box],
    clearance: ArrayLike = CLEAR,
) -> list[Spot]:
    """Return a place for every wish, in the order of the wishes; lengths in mm.

    ``lines`` are drawn segments x0, y0, x1, y1 and ``clearance`` is how far labels stay from
    them (one length or one for each line); ``boxes`` are taken rectangles xmin, ymin, xmax,
    ymax; no label leaves the rectangle ``field``, or its own one if there is one for each. A label
    that is ``free`` touches nothing; one that is not is returned where it would like to be.
    """
    if not wishes:
        return []
    board = _Board(wishes, Page(_subjects(wishes), lines, boxes, field, clearance))
    board.settle(board.order())
    board.chase(board.sorry(BAD), SHORT)
    if board.widen([j for i in board.homeless() for j in board.crowd(i)] + board.dear()):
        board.chase(board.sorry(BAD), SHORT)
    board.chase(board.homeless(), LONG)
    if homeless := board.homeless():
        board.widen(j for i in homeless for j in board.crowd(i))
        board.widen_more(homeless, ALL, MANY)
        board.chase(board.homeless(), LONG)
    for reach, most in ((NEXT, SOME), (ALL, ALL)):
        homeless = [i for i in board.homeless() if board.menus[i]]  # others have no hope
        crowd = [j for i in homeless for j in board.crowd(i)]
        count = len(board.places.label)
        board.widen_more(crowd, reach, most)
        board.offer_rest(crowd, most)
        if most is SOME or len(board.places.label) > count:
            board.chase(homeless, LONGEST)
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
    """Which label has which place, and which places are taken, as bits of a number."""

    def __init__(self, wishes: Sequence[Wish], page: Page) -> None:
        self.page = page
        self.fine = [UNPLACED * 1.2**wish.priority for wish in wishes]
        self.pick = [-1] * len(wishes)
        self.paid = [*self.fine]
        self.taken = 0
        near = tries(page.subjects, NEAR)
        self.hope = np.stack([near.x[:, 0], near.y[:, 0]], axis=1)
        self.middle = (page.subjects.ends[:, :2] + page.subjects.ends[:, 2:]) / 2
        self.wide: set[int] = set()
        self.seen = [NEAREST] * len(wishes)  # how many of its candidates were looked at
        self.clashes, self.rest = Clashes(), NO_PLACES
        self._offer(page.near(page.open(np.arange(len(wishes)), near, slice(NEAREST))), FEW)
        self.widen(i for i, best in enumerate(self.best) if best > DEAR)

    def _offer(self, more: Places, most: int = MANY) -> None:
        """Offer the cheapest of some places, at most so many for each label; the rest is kept.

        Those of a label that cost the same keep their order.
        """
        order = np.lexsort((more.cost, more.label))
        label = more.label.take(order)
        cheap = np.arange(len(order)) - np.searchsorted(label, label) < most
        self.clashes.add(more.take(order.take(np.flatnonzero(cheap))))
        self.rest = self.rest.joined(more.take(order.take(np.flatnonzero(~cheap))))
        self.places = self.clashes.places
        order = np.lexsort((self.places.cost, self.places.label))
        bounds = np.searchsorted(self.places.label[order], np.arange(1, len(self.pick)))
        ranked = order.tolist()
        self.menus = [ranked[a:b] for a, b in pairwise([0, *bounds.tolist(), len(order)])]
        self.cost, self.label = self.places.cost.tolist(), self.places.label.tolist()
        self.best = [self.cost[menu[0]] if menu else inf for menu in self.menus]

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
        rows = self.clashes.rows()
        for i in which:
            self._lift(i)
            left = (k for k in self.menus[i] if not rows[k] & self.taken)
            self._put(i, next(left, -1))

    def dear(self) -> list[int]:
        """Return the labels that pay more than a leader would cost."""
        return [i for i, paid in enumerate(self.paid) if paid > DEAR]

    def homeless(self) -> list[int]:
        """Return the labels without a place."""
        return [i for i, k in enumerate(self.pick) if k < 0]

    def crowd(self, i: int) -> list[int]:
        """Return a label and those with the nearest subjects within 20 mm, nearest first."""
        apart = np.abs(self.middle - self.middle[i]).max(axis=1)
        near = np.argsort(apart, kind="stable")[:CROWD].tolist()
        return [i, *(j for j in near if j != i and apart[j] < 20.0)]

    def widen(self, labels: Iterable[int]) -> bool:
        """Offer places with a leader to those of the labels that had none of these yet, if any."""
        which = sorted({*labels} - self.wide)
        self.wide.update(which)
        if which:
            self._offer(self._led(which, FAR, slice(NEAREST)), FEW)
            if self.taken:
                self.settle(i for i in self.order() if i in which)
        return bool(which)

    def widen_more(self, labels: Iterable[int], reach: int, most: int) -> None:
        """Offer the same to them at other and at longer distances, up to so many candidates."""
        behind = {i for i in labels if self.seen[i] < reach}
        for seen in sorted({self.seen[i] for i in behind}):
            which = sorted(i for i in behind if self.seen[i] == seen)
            self._offer(self._led(which, FARTHEST, slice(seen, reach)), most)
        for i in behind:
            self.seen[i] = reach

    def _led(self, which: Sequence[int], far: Array, span: slice) -> Places:
        """Return places with a leader of some labels, at some distances in mm."""
        rows = np.array(which, dtype=np.intp)
        some = tries(self.page.subjects.take(rows), NEAR, far)
        return self.page.led(self.page.open(rows, some, span))

    def offer_rest(self, labels: Sequence[int], most: int) -> None:
        """Offer more places of these labels, which cost too much to be offered before."""
        if not labels:
            return
        wanted = np.isin(self.rest.label, list(labels))
        rest = self.rest.take(np.flatnonzero(wanted))
        self.rest = self.rest.take(np.flatnonzero(~wanted))
        self._offer(rest, most)

    def chase(self, labels: Iterable[int], steps: int) -> None:
        """Let each of the labels push others aside and those others in turn, if it pays in all."""
        rows = self.clashes.rows()
        for i in labels:
            if not self.menus[i]:
                continue
            saved = [*self.pick], [*self.paid], self.taken
            before = sum(self.paid)
            least = before - self.paid[i] + self.best[i]  # if those in the queue pay their best
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

        Those that it pushes aside queue up. Return how much more all pay above their best.
        """
        i = queue.popleft()
        cost, taken, best, chosen, pushed = self.cost, self.taken, inf, -1, 0
        for k in self.menus[i]:
            price = cost[k]
            if price >= best:  # and so are those after it
                break
            if clash := rows[k] & taken:
                price += PUSH * clash.bit_count()
            if k in worn:
                price += worn[k]
            if price < best:
                best, chosen, pushed = price, k, clash
        more: float = cost[chosen] - self.best[i]
        self.taken ^= pushed
        for j in self._on(pushed):
            more += self.best[j] - self.paid[j]
            self.pick[j], self.paid[j] = -1, self.fine[j]
            queue.append(j)
        self._put(i, chosen)
        worn[chosen] = worn.get(chosen, 0.0) + WEAR
        return more

    def _on(self, places: int) -> list[int]:
        """Return the labels of some places, which are the bits of a number, in order."""
        found = []
        while places:
            k = places.bit_length() - 1
            places ^= 1 << k
            found.append(self.label[k])
        return sorted(found)

    def _put(self, i: int, k: int) -> None:
        """Put a label on a place, if there is one."""
        if k >= 0:
            self.pick[i], self.paid[i] = k, self.cost[k]
            self.taken |= 1 << k

    def _lift(self, i: int) -> None:
        """Take a label off the page."""
        if self.pick[i] >= 0:
            self.taken ^= 1 << self.pick[i]
        self.pick[i], self.paid[i] = -1, self.fine[i]

    def spot(self, i: int) -> Spot:
        """Return where a label is, or where it would like to be."""
        k = self.pick[i]
        x, y = (self.places.x[k], self.places.y[k]) if k >= 0 else self.hope[i]
        x0, y0, x1, y1 = self.places.leader[k].tolist() if k >= 0 else [NOWHERE] * 4
        return Spot(
            float(x), float(y), ((x0, y0), (x1, y1)) if x0 < NOWHERE else None, bool(k >= 0)
        )
