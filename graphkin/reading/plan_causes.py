"""One cause for a whole plan: it is drawn at another scale, turned or mirrored about its pole.

Each line of the plan is then wrong where the key expects it, and all of them are there where one
similarity puts them.
"""

from __future__ import annotations

from cmath import phase
from collections.abc import Iterator, Sequence
from math import degrees

import numpy as np
from msgspec import Struct

from graphkin.reading.drawn_ink import DrawnInk
from graphkin.reading.vector_ends import OWN, RINGS, SHORTEST, heads_at, is_marked
from graphkin.text import Words

DRAWN, LEAST, LONG, KEPT = 0.9, 0.6, 20.0, 0.7
"""The drawn share of all vectors of a plan together, and of each of them, that shows a cause.

Letters may hide most of a vector shorter than LONG, in mm. A plan of which the share KEPT is drawn
where the key has it has no cause.
"""
ENDED = 0.4
"""The share of the vectors whose head or marked point must be seen at their tip.

Heads of several vectors to one point cover each other, and more so in a plan at half its size.
"""
NEAR, WIDE = 0.6, 1.5
"""How far beside a straight line a vector is drawn, and that line beside its place, in mm.

A careful hand is a millimetre off at the far ends of a large plan.
"""
FITTED = 2
"""How many times a similarity is fitted to the lines that are drawn."""
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
    """The similarities that take a tip of the key to one of some places, or only towards it.

    A line often runs on beyond its vector, so that its direction is tried at the key's size too.
    """
    for tip in tips:
        way = tip - pole
        for place in places:
            if abs(way) > SHORTEST and abs(place - pole) > SHORTEST:
                for size in (
                    (place - pole) / way,
                    (place - pole) / abs(place - pole) * abs(way) / way,
                ):
                    yield Similarity(pole, size, False)
                    yield Similarity(pole, size * way / way.conjugate(), True)


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
    if not long or sum(ink.cover(*shaft, NEAR) for shaft in long) > KEPT * len(long):
        return None
    tips = [tip for tail, tip in long if abs(tail - pole) < 1e-6]
    best, most = None, 0.0
    for each in similarities(pole, tips, places):
        share = drawn_share(ink, moved_by(each, long), len(long))
        if share > max(most, DRAWN):
            best, most = each, share
    if best is None:
        return None
    for _ in range(FITTED):
        best = fitted(ink, best, long)
    if max(abs(best(tip) - tip) for _, tip in long) < MOVED:
        return None
    there = moved_by(best, long)
    own = [own_shaft(ink, shaft) for shaft in there]
    ended = [
        is_ended(ink, *one) or is_ended(ink, *other) for one, other in zip(there, own, strict=True)
    ]
    drawn = drawn_share(ink, own, len(long), NEAR) >= DRAWN
    return best if drawn and sum(ended) >= ENDED * len(ended) else None


def own_shaft(ink: DrawnInk, shaft: Shaft) -> Shaft:
    """A vector along the straight line that is drawn near it, or where it is without one."""
    lines = ink.lines(*shaft, WIDE, WIDE)
    line = max(lines, key=lambda each: each.cover, default=None)
    return shaft if line is None else (line.start, line.end)


def moved_by(similarity: Similarity, shafts: Sequence[Shaft]) -> list[Shaft]:
    """The vectors that are long enough to be seen where a similarity puts them."""
    drawn = [(similarity(tail), similarity(tip)) for tail, tip in shafts]
    return [(tail, tip) for tail, tip in drawn if abs(tip - tail) > SHORTEST]


def drawn_share(ink: DrawnInk, shafts: Sequence[Shaft], count: int, beside: float = WIDE) -> float:
    """The drawn share of vectors of a plan of ``count``; 0 where a long one is not drawn."""
    if len(shafts) < max(FEWEST, SEEN * count):
        return 0.0
    total = 0.0
    for tail, tip in shafts:
        cover, long = ink.cover(tail, tip, beside), abs(tip - tail)
        if cover < LEAST and long > LONG:
            return 0.0
        total += cover * long
    return total / sum(abs(tip - tail) for tail, tip in shafts)


def fitted(ink: DrawnInk, similarity: Similarity, shafts: Sequence[Shaft]) -> Similarity:
    """A similarity with the size and turn that suit the drawn lines best, by least squares.

    A point that was read 0.5 mm off at the end of a short vector gives another scale.
    """
    pole, rows, offs = similarity.pole, [], []
    for tail, tip in shafts:
        ends = similarity(tail), similarity(tip)
        lines = ink.lines(*ends, WIDE, WIDE, most=1) if abs(ends[1] - ends[0]) > SHORTEST else []
        for line in lines:
            for end in ends:
                way = (end - pole) / similarity.size * line.way.conjugate()
                rows.append((way.imag, way.real))
                offs.append(line.off(pole))
    if len(rows) < 2 * FEWEST:
        return similarity
    real, imag = np.linalg.lstsq(np.array(rows), -np.array(offs), rcond=None)[0]
    return Similarity(pole, complex(real, imag), similarity.mirrored)


def is_ended(ink: DrawnInk, tail: complex, tip: complex) -> bool:
    """Whether a head or a mark is at the tip of a vector."""
    return heads_at(ink, tail, tip) >= OWN or is_marked(ink, tip, RINGS)
