"""The places that labels are offered, a few of the cheapest at a time (mm)."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise
from math import inf
from typing import NamedTuple

import numpy as np

from graphkin.drawing.candidates import tries
from graphkin.drawing.clashes import NO_PLACES, Clashes, OpenPlaces
from graphkin.drawing.clearance import Clearance
from graphkin.drawing.shapes import Index, where

NEAR = np.array([0.0, 0.6, 1.4, 2.8])  # mm beyond the gap, without a leader
MOST = 12_000  # places that are offered on a page in all: memory grows with their square
AT_ONCE = 64  # labels that look further at one go
FAR = np.array([4.0, 7.0, 11.0, 17.0, 24.0, 33.0])  # mm beyond the gap, with a leader


class Level(NamedTuple):
    """How many candidates of a label are looked at, by distance, and how many are offered."""

    seen: int
    offered: int  # the cheapest ones, at one go


NONE, FEW, CLOSE = Level(0, 0), Level(24, 4), Level(24, 10)


class CandidateSet:
    """The places offered to each label, cheapest first, and which of them rule each other out.

    ``menus`` holds the numbers of each label's places; ``cost`` and ``label`` belong to places,
    ``best`` is what the cheapest place of each label costs.
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
        """Offer labels that were at lower levels more places, with a leader; true if any were."""
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
        """Return the places with a leader that some labels did not look at before."""
        seeking = [i for i, level in levels.items() if self.level[i].seen < level.seen]
        found = NO_PLACES
        for start in range(0, len(seeking), AT_ONCE):
            rows = np.array(seeking[start : start + AT_ONCE])
            first, last = (np.array([a[i].seen for i in rows]) for a in (self.level, levels))
            some = tries(self.page.subjects.take(rows), NEAR, FAR)
            found = found.joined(self.page.led(self.page.open(rows, some, first, last)))
        return found

    def _offer(self, more: OpenPlaces, most: Index) -> None:
        """Offer the cheapest of some places, at most so many for each label; the rest is kept.

        Those of a label that cost the same keep their order.
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
        """Return for each place which others it rules out: bits of a number."""
        return self.clashes.rows()
