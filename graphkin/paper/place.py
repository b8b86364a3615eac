"""Places for labels on a page: near their subjects, clear of lines, boxes and each other (mm)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from graphkin.paper.clearance import (
    LEADER,
    NOWHERE,
    TINY,
    Array,
    Box,
    Clashes,
    Page,
    Places,
    Subjects,
    Tries,
)

Point = tuple[float, float]
Segment = tuple[Point, Point]

CLEAR = 0.6  # mm between a label and a drawn line, unless the caller says otherwise
NEAR = np.array([0.0, 0.6, 1.4, 2.8])  # mm beyond the gap, without a leader
FAR = np.array([4.0, 7.0, 11.0, 17.0])  # mm beyond the gap, with a leader

SIDE = 1.5  # cost of a place square to the preferred side; all costs are in mm of distance
UNPLACED = 1000.0  # a label without a place
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
    board.settle(board.sorry(0.2))
    return [board.spot(i) for i in range(len(wishes))]


def _subjects(wishes: Sequence[Wish]) -> Subjects:
    """Return the wishes as arrays."""
    flat = [np.asarray(wish.subject, dtype=np.float64).reshape(-1) for wish in wishes]
    ends = np.array([np.resize(subject, 4) for subject in flat])
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
        self.fine = UNPLACED * np.array([1.2**wish.priority for wish in wishes])
        self.rank = self.fine.tolist()
        self.pick = np.full(len(wishes), -1)
        self.paid = self.fine.copy()
        near = tries(page.subjects, NEAR)
        self.hope = near.centre[:, 0]
        self.middle = (page.subjects.ends[:, :2] + page.subjects.ends[:, 2:]) / 2
        self.wide: set[int] = set()
        self._open(page.places(np.arange(len(wishes)), near, led=False))
        self.widen(np.flatnonzero(self.best > LEADER + FAR[0]).tolist())

    def _open(self, places: Places) -> None:
        """Offer these places; those offered before come first, in the order they had."""
        self.places, self.clashes = places, Clashes(places)
        order = np.lexsort((places.cost, places.label))
        ends = np.searchsorted(places.label[order], np.arange(1, len(self.pick)))
        self.menus = np.split(order, ends)
        best = [places.cost[menu[0]] if len(menu) else np.inf for menu in self.menus]
        self.best = np.array(best)
        self.load = np.zeros(len(order), dtype=np.int64)
        for k in self.pick[self.pick >= 0].tolist():
            self.load += self.clashes.of(k)

    def order(self) -> list[int]:
        """Return the labels, those with few places first, then by priority."""
        count = [len(menu) for menu in self.menus]
        return sorted(range(len(count)), key=lambda i: (count[i] > 7, -self.rank[i], count[i], i))

    def sorry(self, limit: float) -> list[int]:
        """Return the labels that pay this much above their cheapest place, worst first."""
        regret = self.paid - self.best
        return [int(i) for i in np.argsort(-regret, kind="stable") if regret[i] > limit]

    def settle(self, which: Iterable[int]) -> None:
        """Give each of the labels the cheapest place that is left, if there is one."""
        for i in which:
            self._lift(i)
            left = self.load[self.menus[i]] == 0
            if left.any():
                self._put(i, int(self.menus[i][left.argmax()]))

    def dear(self) -> list[int]:
        """Return the labels that pay more than a leader would cost."""
        return np.flatnonzero(self.paid > LEADER + FAR[0]).tolist()

    def homeless(self) -> list[int]:
        """Return the labels without a place."""
        return np.flatnonzero(self.pick < 0).tolist()

    def crowd(self, i: int) -> list[int]:
        """Return a label and those with the nearest subjects within 20 mm, nearest first."""
        apart = np.abs(self.middle - self.middle[i]).max(axis=1)
        near = np.argsort(apart, kind="stable")[:CROWD].tolist()
        return [i, *(j for j in near if j != i and apart[j] < 20.0)]

    def widen(self, labels: Iterable[int]) -> bool:
        """Offer places with a leader to those of the labels that had none of these yet, if any."""
        which = np.array(sorted({*labels} - self.wide), dtype=np.intp)
        if not len(which):
            return False
        self.wide.update(which.tolist())
        some = tries(self.page.subjects.take(which), NEAR, FAR)
        both = zip(self.places, self.page.places(which, some, led=True), strict=True)
        self._open(Places(*(np.concatenate(pair) for pair in both)))
        if (self.pick >= 0).any():
            self.settle(i for i in self.order() if i in which)
        return True

    def chase(self, labels: Iterable[int], steps: int) -> None:
        """Let each of the labels push others aside and those others in turn, if it pays in all."""
        for i in labels:
            saved = self.pick.copy(), self.paid.copy(), self.load.copy()
            limit = self.paid.sum() - 0.01
            worn = np.zeros(len(self.load))
            if self.pick[i] >= 0:
                worn[self.pick[i]] = WEAR
            queue = [i]
            for _ in range(steps):
                queue += self._push(queue.pop(0), worn)
                hope = self.paid.sum() - (self.fine - self.best)[queue].sum()
                if not queue or hope > limit:
                    break
            if self.paid.sum() > limit:
                self.pick, self.paid, self.load = saved

    def _push(self, i: int, worn: Array) -> list[int]:
        """Put a label on the place with the best price, and return those it pushed aside."""
        self._lift(i)
        menu = self.menus[i]
        if not len(menu):
            return []
        price = self.places.cost[menu] + PUSH * self.load[menu] + worn[menu]
        k = int(menu[price.argmin()])
        others = np.flatnonzero((self.pick >= 0) & self.clashes.of(k)[self.pick]).tolist()
        for j in others:
            self._lift(j)
        self._put(i, k)
        worn[k] += WEAR
        return others

    def _put(self, i: int, k: int) -> None:
        """Put a label on a place."""
        self.pick[i], self.paid[i] = k, self.places.cost[k]
        self.load += self.clashes.of(k)

    def _lift(self, i: int) -> None:
        """Take a label off the page."""
        if self.pick[i] >= 0:
            self.load -= self.clashes.of(int(self.pick[i]))
        self.pick[i], self.paid[i] = -1, self.fine[i]

    def spot(self, i: int) -> Spot:
        """Return where a label is, or where it would like to be."""
        k = self.pick[i]
        x, y = (self.places.x[k], self.places.y[k]) if k >= 0 else self.hope[i]
        x0, y0, x1, y1 = self.places.leader[k].tolist() if k >= 0 else [NOWHERE] * 4
        return Spot(
            float(x), float(y), ((x0, y0), (x1, y1)) if x0 < NOWHERE else None, bool(k >= 0)
        )


def tries(subjects: Subjects, near: Array, far: Array | None = None) -> Tries:
    """Return candidates at the distances ``near`` beyond the gap or, if given, at ``far``, in mm.

    The far ones lie on rings around a point or three places of a segment; the near ones on rings
    around a point or along both sides of the middle two thirds of a segment.
    """
    start, end = subjects.ends[:, None, :2], subjects.ends[:, None, 2:]
    extent = np.abs(subjects.ends[:, 2:] - subjects.ends[:, :2]) / 2
    middle = (start + end) / 2
    if far is not None:
        around = _rings(subjects, middle, 0 * extent, 36, far)
        roots = start + (end - start) * np.array([0.5, 0.3, 0.7])[:, None]
        lines = _rings(subjects, roots, 0 * extent, 12, far)
    else:
        around = _rings(subjects, middle, 0 * extent, 20, near)
        ring = _rings(subjects, middle, np.minimum(extent, 3.0), 24, near[:1])
        both = zip(_sides(subjects, 7, near), ring, strict=True)
        lines = Tries(*(np.concatenate(pair, axis=1) for pair in both))
    rows = subjects.line[:, None, None]
    return Tries(*(np.where(rows, a, b) for a, b in zip(lines, around, strict=True)))


def _rings(subjects: Subjects, root: Array, extent: Array, angles: int, steps: Array) -> Tries:
    """Return places around roots (n, a, 2), each as wide as a half extent (n, 2); mm.

    Each root has its own share of the directions. The label's box slides around the root, and a
    push makes good what the sliding loses of the gap beside the box's edges.
    """
    roots = root.shape[1]
    turn = (np.arange(angles) * roots + np.arange(roots)[:, None]) * (2 * np.pi / angles / roots)
    u = np.stack([np.cos(turn), np.sin(turn)], axis=-1)[:, :, None, :]
    reach = (subjects.half + extent)[:, None, None, None, :]
    slide = np.clip(u * np.sqrt(2), -1, 1) * reach
    gap = (subjects.gap + subjects.radius)[:, None, None, None, None] + steps[:, None]
    edge = np.maximum(np.abs(slide) - reach + gap * np.abs(u), 0.0)
    push = gap * gap / np.sqrt((edge * edge).sum(-1, keepdims=True)).clip(TINY)
    centre = root[:, :, None, None, :] + slide + push * u
    return _flat(centre, u, root[:, :, None, None, :])


def _sides(subjects: Subjects, count: int, steps: Array) -> Tries:
    """Return places along both sides of the middle two thirds of segments; mm."""
    start, along = subjects.ends[:, None, :2], (subjects.ends[:, 2:] - subjects.ends[:, :2])
    unit = along / np.sqrt((along * along).sum(-1, keepdims=True)).clip(TINY)
    normal = np.stack([-unit[:, 1], unit[:, 0]], axis=-1)[:, None] * [[1.0], [-1.0]]
    support = (np.abs(normal) * subjects.half[:, None]).sum(-1)[:, :, None]
    off = (support + subjects.gap[:, None, None] + steps)[:, None, :, :, None]
    root = start + along[:, None] * np.linspace(1 / 6, 5 / 6, count)[:, None]
    root, normal = root[:, :, None, None], normal[:, None, :, None]
    return _flat(root + normal * off, normal, root)


def _flat(*fields: Array) -> Tries:
    """Return the candidates of a grid whose first axis is the subject."""
    shape = fields[0].shape
    return Tries(*(np.broadcast_to(f, shape).reshape(shape[0], -1, 2) for f in fields))
