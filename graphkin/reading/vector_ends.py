"""Where the vectors of a plan end: their arrowheads and the last of their strokes.

Lines that cross at a point say where it should be. Only the end of its vector says where the
student put it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from msgspec import Struct

from graphkin.reading.drawn_ink import COVERED, PITCH, DrawnInk

BARBS = np.radians([13.0, 17.0, 22.0, 28.0])
"""Angles between an arrowhead's sides and its shaft."""
SIDES = np.arange(1.5, 3.0, 0.15)
"""Distances in mm from an arrowhead's tip at which both its sides are examined."""
BARE = np.arange(4.0, 5.6, 0.2)
"""Distances in mm behind a tip at which only the shaft is drawn."""
LARGE = 1.8
"""How many times larger some hands draw their heads, which are then slimmer."""
ASIDE = 0.55
"""How far beside the bare shaft nothing is drawn, in mm."""
SWERVES = 0.75
"""How far beside its line a vector's stroke may run farther on, in mm."""
PAST, GOES_ON = np.arange(4.4, 6.0, 0.2), 0.75
"""Distances in mm behind a tip at which a line drawn to this share is no side of a head."""
ONE_WAY, FAN = np.ones(1), np.exp(1j * np.radians([-4.0, -2.0, 0.0, 2.0, 4.0]))
"""Turns of lines that may look like a head's sides; vectors that leave a pole turn most."""
HEADED, CLEARLY = 0.8, 0.25
"""The least share of an arrowhead that is drawn; how much clearer one head is than another."""
OWN = 0.75
"""The least share of the head at a point that counts as the end of its vector without a doubt."""
RINGS, PINS, ROUND = np.arange(0.7, 1.05, 0.1), np.arange(0.7, 1.45, 0.1), 0.86
"""Radii in mm of the rings of points and of pins; the least share of one that is drawn."""
FADED = 0.2
"""The darkness from which a ring counts as drawn where lines are crowded and fade each other."""
ASTRAY = 0.3
"""How far from its point, in mm, the middle of a ring may be."""
TURNED, PLAIN, LIKELY = 0.65, 0.45, 0.65
"""The least share of a head at the tail of a turned vector; the most at the tail of any other.

LIKELY is the least share of a head at a marked point whose vector begins where other heads are.
"""
LEAD = 0.1
"""By how much a likely head at a point must lead all others on its vector to count as its own."""
BESIDE = np.radians(20.0)
"""At a lesser angle, the head of another vector to the same point looks like a vector's own."""
WHOLE = 0.9
"""The least drawn share of a vector whose head alone says that its point is there."""
LACKS = 0.3
"""The least drawn share of a vector's line; the student left out a vector with less."""
CERTAIN = 0.9
"""The least drawn share, in three places in a row, of a head besides that at the point."""
ONE_HEAD, TIP = 1.2, 0.2
"""Over so many mm one head is clearly drawn at most; its tip is so far from their middle.

In 129 heads of simulated hands the middle was 0.2 mm behind the tip, with a deviation of 0.15 mm.
"""
PALE = 0.35
"""The darkness from which a head counts as drawn, relative to its own shaft."""
NEAR, CLEAR, AT = 1.4, 3.2, 0.6
"""A head this close to a point, in mm, is at the point; beyond CLEAR it is clearly elsewhere.

Between them, a ring about the point looks like the sides of a head. AT is the same as NEAR at a
vector's tail, and where a head is drawn just beyond a point.
"""
PASSED = 2.8, 3.8
"""Where a head beyond a point, in mm, is no ring about the point, though not clearly elsewhere."""
OVERSHOT, UNDERSHOT = (NEAR, 6.0), (-6.0, -2.2)
"""Where a head next to a point, in mm beyond it, is asked about: other heads at the point and lines
that cross there may look like a head at the point, and hide most of the head beside it.
"""
SHORTEST = 9.0
"""Vectors shorter than this, in mm, have heads too small to be read."""
NEAREST, FARTHEST = 0.3, 1.9
"""The shares of a vector's length between which its head is searched for."""
REACHED = 0.8
"""The drawn share of a vector's line up to a head that belongs to the vector."""
FREE = 4.0
"""Heads this close to another point, in mm, may belong to that point."""
CROWDED = np.radians(12.0)
"""The head of a vector that ends at another's tail at a lesser angle may look like the other's."""
LEANING = 0.2
"""The most slope of a line from a vector's end to another point that may hide what runs on."""
RING = 2.0
"""The first millimetres of a vector, which the mark of its tail may hide."""
BEYOND, RUNS_ON = (2.4, 6.0), 0.9
"""The piece beyond a point, in mm, that is drawn to this share where a vector runs on."""
UNBROKEN = (1.3, 6.0)
"""The piece beyond a point, in mm, over which a stroke that runs on has no gap; letters do."""
EMPTY = 0.2
"""A piece beyond a point that is drawn to no more than this shows that the stroke ends there."""
BEFORE, STOPS = (0.9, 3.0), 0.6
"""The piece before a point, in mm, that is drawn to a lesser share where a vector stops short."""


class VectorEnd(Struct, frozen=True):
    """What the end of a vector says of the point there.

    - ``head``: where its arrowhead is, if that is clearly elsewhere.
    - ``reversed``: its head is at its tail.
    - ``doubled``: it seems to have a head at its point and another one elsewhere.
    - ``runs_on``, ``stops_short``: its stroke goes on beyond the point, or ends before it.
    - ``open``: neither a head, nor a mark of the point, nor the end of its stroke is at the point.
    """

    head: complex | None = None
    reversed: bool = False
    doubled: bool = False
    runs_on: bool = False
    stops_short: bool = False
    open: bool = False

    @property
    def is_there(self) -> bool:
        """Whether nothing speaks against an end at the point."""
        return self == VectorEnd()

    @property
    def is_wrong(self) -> bool:
        """Whether the end says that the vector is wrong."""
        beside = self.open and (self.runs_on or self.stops_short)
        return self.head is not None or self.reversed or beside


def heads(
    ink: DrawnInk,
    places: Any,
    way: complex,
    pale: float = COVERED,
    lines: Any = ONE_WAY,
    size: float = 1.0,
) -> Any:
    """The drawn share of an arrowhead with its tip at each place, pointing along ``way``.

    The weaker of both sides counts, less what is drawn beside the shaft behind the head. A side
    that goes on behind the head, turned by one of the angles ``lines``, is another line. Ink darker
    than ``pale`` counts as drawn. The head is ``size`` times as large as usual.
    """
    best = np.zeros(len(places))
    for barb in BARBS / np.sqrt(size):
        sides = []
        for turn in (np.exp(1j * barb), np.exp(-1j * barb)):
            dark, known = ink.at(places[:, None] - size * way * SIDES * turn)
            seen = np.maximum(known.sum(axis=1), 1)
            enough = known.mean(axis=1) > 0.5
            behind = places[:, None, None] - size * way * turn * lines[:, None] * PAST
            past = (ink.at(behind.reshape(len(places), -1))[0] > pale).reshape(behind.shape)
            enough &= past.mean(axis=2).max(axis=1) < GOES_ON
            sides.append(((dark > pale) * known).sum(axis=1) / seen * enough)
        best = np.maximum(best, np.minimum(*sides))
    bare = [
        (ink.at(places[:, None] - way * (size * BARE + side * ASIDE))[0] > pale).mean(axis=1)
        for side in (1j, -1j)
    ]
    return best - np.minimum(*bare)


def on_shaft(ink: DrawnInk, places: Any, way: complex) -> Any:
    """Places moved sideways to the middle of the stroke that comes to them along ``way``.

    A place beyond a vector's tip is beside its stroke, which would else be taken for the side of a
    head.
    """
    aside = np.arange(-SWERVES, SWERVES + 0.01, 0.15)
    behind = places[:, None, None] + 1j * way * aside[:, None] - way * BARE
    dark, _ = ink.at(behind.reshape(len(places), -1))
    full = np.clip(dark, 0, 1).reshape(behind.shape).mean(axis=2)
    middle = full[:, [len(aside) // 2]]
    weight = np.clip(full - COVERED, 0, None) * (full.max(axis=1, keepdims=True) > middle)
    total = weight.sum(axis=1)
    shift = (weight * aside).sum(axis=1) / np.maximum(total, 1e-6)
    return places + 1j * way * np.where(total > 0, shift, 0.0)


def vector_end(
    ink: DrawnInk,
    tail: complex,
    tip: complex,
    others: list[complex],
    arriving: Sequence[complex] = (),
    *,
    along_line: bool,
    beside: Sequence[complex] = (),
) -> VectorEnd:
    """What the end of a vector from a tail says of the point at its tip.

    ``others`` are the places of the other points, ``arriving`` the directions in which vectors end
    at the tail, ``beside`` those of the other vectors to the tip. With ``along_line``, a
    construction line is drawn along the vector, so that only the head shows where the vector ends.
    A vector of which hardly anything is drawn says nothing.
    """
    long = abs(tip - tail)
    if not long >= SHORTEST or ink.cover(tail, tip, 0.4, hidden=1.0) < LACKS:
        return VectorEnd()
    way = (tip - tail) / long
    shaft, known = ink.at(tail + way * np.arange(RING, long - SIDES[-1], PITCH))
    dark = float(np.median(shaft[known > 0])) if known.any() else 1.0
    pale = float(np.clip(PALE * dark, COVERED * PALE, COVERED))
    along = np.arange(max(NEAREST * long, 5.0), FARTHEST * long + PITCH, PITCH)
    at_shaft = on_shaft(ink, tail + along * way, way)
    share, near = heads(ink, at_shaft, way, pale), abs(along - long) <= NEAR
    large = float(heads(ink, at_shaft[near], way, pale, size=LARGE).max())
    here = max(float(share[near].max()), large)
    marked = is_marked(ink, tip, RINGS, FADED)
    others = [(each - tail) / way for each in others]
    shared = any(
        o.real > long + NEAR and abs(o.imag) < NEAR + LEANING * (o.real - long) for o in others
    )
    alike = any(abs(np.angle(each / way)) < BESIDE for each in beside)
    free = abs(along - long) > (CLEAR * LARGE if large >= OWN else CLEAR)
    for other in others:
        free &= abs(along - other) > FREE
    there = np.where(free, share, -1.0)
    least = CERTAIN if marked else HEADED
    clearer = there.max() >= least and there.max() > here + CLEARLY
    rival = there if clearer or alike else steady(there)
    place = tail + float(along[int(rival.argmax())]) * way
    elsewhere = (clearer or rival.max() >= CERTAIN) and (
        ink.cover(tail, place, 0.4, hidden=1.0) >= REACHED
    )
    close = np.arange(-AT, AT + PITCH / 2, PITCH)
    back = heads(ink, tail + close * way, -way, pale, FAN)
    unsure = heads(ink, tail + close * way, -way, pale).max()
    plain = bool(unsure <= PLAIN or unsure < here)
    crowded = any(abs(o) <= FREE for o in others) or any(
        abs(np.angle(-each / way)) < CROWDED for each in arriving
    )
    turned = bool(back.max() >= TURNED and back.max() > here + CLEARLY and not crowded)
    likely = back.max() >= TURNED if alike or shared else steady(back).max() >= HEADED
    at_tail = bool(likely) and not crowded
    head = complex(place) if elsewhere and (clearer or here < OWN) else None
    off, by = along - long, [other.real - long for other in others]
    rivalled = (
        elsewhere
        or (here < OWN and there.max() >= HEADED)
        or (along_line and is_beside(share, off, by))
        or is_passed(ink, tip, way, share, off, by)
    )
    doubled = bool((at_tail and not turned) or (rivalled and head is None))
    only = here >= LIKELY and here > max(float(steady(there).max()), unsure) + LEAD
    past = (along - long >= PASSED[0]) & (along - long <= PASSED[1])
    alone = marked and steady(np.where(past, share, -1.0)).max() < LIKELY
    ended = bool(here >= OWN or only or (alone and (plain or (crowded and here >= LIKELY))))
    if along_line:
        return VectorEnd(head, turned, doubled, open=not ended)
    beyond = drawn(ink, tip, way, BEYOND, pale)
    before = drawn(ink, tip, -way, BEFORE, pale)
    stops = not shared and beyond <= EMPTY and before >= RUNS_ON
    if stops:
        head = None
    ended |= stops and plain
    certain = (marked or (not alike and here >= CERTAIN)) and (
        here >= OWN and there[along > long].max() < OWN
    )
    unbroken = drawn(ink, tip, way, UNBROKEN, pale) >= RUNS_ON
    runs_on = not (shared or certain) and beyond >= RUNS_ON and unbroken
    return VectorEnd(head, turned, doubled, runs_on, before < STOPS, not ended)


def is_beside(share: Any, off: Any, others: Sequence[float]) -> bool:
    """Whether a head next to a point is drawn as well as the one that seems to be there.

    ``share`` is the drawn share of a head at each distance ``off`` beyond the point, in mm;
    ``others`` are the distances of other points, to which a head may belong. A ring without a head
    looks like a head beyond it.
    """
    here = float(share[abs(off) <= NEAR].max())
    free = free_of(off, others)
    over = np.where(free & (off > OVERSHOT[0]) & (off <= OVERSHOT[1]), share, -1.0)
    under = np.where(free & (off >= UNDERSHOT[0]) & (off < UNDERSHOT[1]), share, -1.0)
    close = over[off <= CLEAR].max() >= CERTAIN or (here < CERTAIN and over.max() >= HEADED)
    behind = LIKELY <= here < CERTAIN and steady(under).max() >= CERTAIN
    return bool((here >= OWN and close) or behind)


def is_passed(
    ink: DrawnInk, tip: complex, way: complex, share: Any, off: Any, others: Sequence[float]
) -> bool:
    """Whether the only head next to a point is drawn a little beyond it.

    A ring about the point looks like such a head, but no ring is about that head's tip. For
    ``share``, ``off`` and ``others``, see ``is_beside``.
    """
    free = free_of(off, others)
    over = np.where(free & (off > 0) & (off <= CLEAR), steady(share), -1.0)
    if share[abs(off) <= AT].max() >= OWN or over.max() < HEADED:
        return False
    place = tip + float(off[over.argmax()]) * way
    return not is_marked(ink, tip, RINGS, FADED) or is_marked(ink, place, RINGS)


def free_of(off: Any, others: Sequence[float]) -> Any:
    """Where along a vector no head of another point can be."""
    return np.all([abs(off - each) > FREE for each in others], axis=0) if others else True


def is_headed(ink: DrawnInk, tail: complex, tip: complex) -> bool:
    """Whether a vector is wholly drawn from a tail to a tip, and has its head there."""
    long = abs(tip - tail)
    return (
        long >= SHORTEST and ink.cover(tail, tip, 0.4) >= WHOLE and heads_at(ink, tail, tip) >= OWN
    )


def head_along(ink: DrawnInk, foot: complex, way: complex, reach: float) -> float | None:
    """Where the tip of the only head along a line is, in mm from a place on it.

    None where there is no clear head within ``reach``, or several.
    """
    along = np.arange(-reach - NEAR, reach + NEAR, PITCH)
    share = steady(heads(ink, on_shaft(ink, foot + along * way, way), way))
    clear = along[share >= CERTAIN]
    if not len(clear) or np.ptp(clear) > ONE_HEAD:
        return None
    return float(clear.mean()) + TIP


def heads_at(ink: DrawnInk, tail: complex, tip: complex) -> float:
    """The drawn share of the head of a vector at its tip."""
    way = (tip - tail) / abs(tip - tail)
    near = np.arange(-NEAR, NEAR + PITCH / 2, PITCH)
    return float(heads(ink, on_shaft(ink, tip + near * way, way), way).max())


def bar_runs_on(ink: DrawnInk, tail: complex, tip: complex, others: list[complex]) -> bool:
    """Whether a bar is drawn on beyond the point at its end, and no mark says where it ends."""
    long = abs(tip - tail)
    if not long >= SHORTEST:
        return False
    way = (tip - tail) / long
    shared = any(
        o.real > long + NEAR and abs(o.imag) < NEAR + LEANING * (o.real - long)
        for o in ((each - tail) / way for each in others)
    )
    whole = ink.cover(tail, tip, 0.4) >= RUNS_ON
    runs_on = whole and not shared and drawn(ink, tip, way, BEYOND, COVERED) >= RUNS_ON
    return runs_on and not is_marked(ink, tip, PINS)


def is_marked(ink: DrawnInk, place: complex, radii: Any, pale: float = COVERED) -> bool:
    """Whether a dot or a ring of one of some radii (mm) is drawn about a place.

    Ink darker than ``pale`` counts as drawn.
    """
    near = np.arange(-ASTRAY, ASTRAY + 0.01, 0.15)
    middles = (place + near[:, None] + 1j * near[None, :]).ravel()
    turns = np.exp(1j * np.radians(np.arange(0.0, 360.0, 15.0)))
    rings = middles[:, None, None] + radii[:, None] * turns
    dark, known = ink.at(rings.reshape(len(middles), -1))
    seen = (known > 0).reshape(rings.shape)
    dark = (dark > pale).reshape(rings.shape) & seen
    full = dark.sum(axis=2) / np.maximum(seen.sum(axis=2), 1)
    return bool((full * (seen.mean(axis=2) > 0.5)).max() >= ROUND)


def steady(share: Any) -> Any:
    """The least of three shares in a row: chance ink looks like a head at a single place."""
    before, after = np.roll(share, 1), np.roll(share, -1)
    least = np.minimum(np.minimum(before, share), after)
    least[[0, -1]] = -1.0
    return least


def drawn(
    ink: DrawnInk, tip: complex, way: complex, piece: tuple[float, float], pale: float
) -> float:
    """The drawn share of a short piece beside a point; ``STOPS`` where print hides most of it.

    ``piece`` is where it begins and ends along a direction, in mm.
    """
    along = np.arange(*piece, PITCH)
    across = np.arange(-0.3, 0.31, 0.15)
    dark, known = ink.at(tip + way * (along[:, None] + 1j * across))
    here = known[:, len(across) // 2] > 0
    if here.mean() < 0.5:
        return STOPS
    return float((dark.max(axis=1) > pale)[here].mean())
