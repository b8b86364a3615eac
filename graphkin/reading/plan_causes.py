"""One cause for a whole plan: it is drawn at another scale, turned or mirrored about its pole.

Each line of the plan is then wrong where the key expects it, and all of them are there where one
similarity puts them.
"""

from __future__ import annotations

from cmath import phase
from collections.abc import Iterator, Sequence
from math import degrees

from msgspec import Struct

from graphkin.reading.drawn_ink import DrawnInk
from graphkin.reading.vector_ends import OWN, RINGS, SHORTEST, heads_at, is_marked
from graphkin.text import Words

DRAWN, LEAST = 0.9, 0.7
"""The drawn share of all vectors of a plan together, and of each of them, that shows a cause.

A plan of which the share LEAST is drawn where the key has it has none.
"""
ENDED = 0.75
"""The share of the vectors that must have a head or a marked point at their tip."""
MOVED = 3.0
"""A cause moves a point of the plan by at least this many mm."""
FEWEST, SEEN = 3, 0.5
"""A cause is seen on at least so many vectors, and on this share of those of the plan."""
EQUAL, STRAIGHT = 0.03, 1.5
"""A plan is scaled or turned where its factor differs by more from 1, its turn by more degrees."""


class PlanCause(Struct, frozen=True):
    """How a plan is drawn: lengths times ``factor``, turned by ``turn`` degrees counter-clockwise.

    A ``mirrored`` plan is first mirrored at a horizontal line.
    """

    factor: float
    turn: float
    mirrored: bool = False

    @property
    def is_scaled(self) -> bool:
        """Whether the plan has another scale."""
        return abs(self.factor - 1) > EQUAL

    @property
    def is_turned(self) -> bool:
        """Whether the plan is turned and not mirrored: mirroring turns by the line at which."""
        return not self.mirrored and abs(self.turn) > STRAIGHT

    def sentences(self, words: Words) -> Iterator[str]:
        """What is said of the whole plan."""
        if self.mirrored:
            yield words("marked.plan_mirrored")
        if self.is_scaled:
            yield words("marked.plan_scaled", factor=words.decimal(f"{self.factor:.2f}"))
        if self.is_turned:
            yield words("marked.plan_turned", turn=words.decimal(f"{self.turn:.0f}"))


class Similarity(Struct, frozen=True):
    """A similarity of the paper that keeps the pole (complex mm, y down)."""

    pole: complex
    size: complex
    mirrored: bool

    def __call__(self, place: complex) -> complex:
        way = place - self.pole
        return self.pole + self.size * (way.conjugate() if self.mirrored else way)

    @property
    def cause(self) -> PlanCause:
        """The cause for a reader: y points upwards."""
        return PlanCause(
            round(abs(self.size), 3), round(-degrees(phase(self.size)), 2), self.mirrored
        )


Shaft = tuple[complex, complex]
"""The tail and the tip of a vector on paper."""


def similarities(
    pole: complex, tips: Sequence[complex], places: Sequence[complex]
) -> Iterator[Similarity]:
    """The similarities that take a tip of the key to one of some places."""
    for tip in tips:
        way = tip - pole
        for place in places:
            if abs(way) > SHORTEST and abs(place - pole) > SHORTEST:
                yield Similarity(pole, (place - pole) / way, False)
                yield Similarity(pole, (place - pole) / way.conjugate(), True)


def similarity_of(
    ink: DrawnInk,
    shafts: Sequence[Shaft],
    pole: complex,
    places: Sequence[complex],
) -> Similarity | None:
    """The similarity at which the vectors of a plan are all drawn; None without one.

    ``places`` are where a vector from the pole may end. A plan most of which is drawn where the
    key has it has no cause.
    """
    long = [shaft for shaft in shafts if abs(shaft[1] - shaft[0]) > SHORTEST]
    if not long or sum(ink.cover(*shaft, 0.6) for shaft in long) > LEAST * len(long):
        return None
    tips = [tip for tail, tip in long if abs(tail - pole) < 1e-6]
    best, most = None, DRAWN
    for each in similarities(pole, tips, places):
        drawn = [(each(tail), each(tip)) for tail, tip in long]
        drawn = [(tail, tip) for tail, tip in drawn if abs(tip - tail) > SHORTEST]
        moved = max((abs(each(tip) - tip) for _, tip in long), default=0.0)
        if len(drawn) < max(FEWEST, SEEN * len(long)) or moved < MOVED:
            continue
        total = 0.0
        for tail, tip in drawn:
            cover = ink.cover(tail, tip, 0.6)
            if cover < LEAST:
                break
            total += cover / len(drawn)
        else:
            if total > most and is_ended(ink, drawn):
                best, most = each, total
    return best


def is_ended(ink: DrawnInk, shafts: Sequence[Shaft]) -> bool:
    """Whether heads or marks are at the tips of most vectors."""
    ended = [heads_at(ink, tail, tip) >= OWN or is_marked(ink, tip, RINGS) for tail, tip in shafts]
    return sum(ended) >= ENDED * len(ended)
