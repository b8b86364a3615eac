"""The sizes of the mechanism and its plans on a sheet, from the boxes that they occupy.

The mechanism has the same place on all sheets, and their fields are divided alike. Vectors on the
mechanism have the length that the single driving crank sets, or a round kv. Each plan is enlarged
as far as its field allows. The search chooses the mechanism's scale at which the drawings together
are largest.

The search asks for boxes by yielding the scale factors of drafts. So one search serves a single
sheet and, in parallel, the variants of a class.
"""

from __future__ import annotations

from collections.abc import Generator, Iterable, Iterator, Mapping, Sequence
from itertools import islice
from math import log, sqrt

from msgspec import Struct
from msgspec.structs import replace

from graphkin.drawing.field import A3, ABOVE, LEAST_FIELD, MARGIN, SheetPaper
from graphkin.drawing.scale import (
    Extent,
    Scales,
    digits,
    is_standard,
    preferred,
    preferred_scales,
    ratio,
)
from graphkin.text.errors import PageError, Problem, message

TIMES = (5.0, 4.0, 3.0, 2.5, 2.0, 1.5, 1.0, 0.75, 0.5, 0.4, 0.3, 0.25, 0.2, 0.15, 0.1, 0.05, 0.02)
"""Possible enlargements of plans relative to the vectors on the mechanism."""
ROUND = (5.0, 4.0, 2.5, 2.0, 1.0, 0.5, 0.4, 0.25, 0.2, 0.1, 0.05, 0.02)
"""The same for velocity plans without a crank, where a round kv stays round."""
STILL_LARGER = (10.0, 8.0, 6.0, *TIMES)
"""The same for acceleration plans without a crank."""
SHORTER = (0.5, 0.25, *(digit * 10.0**-power for power in range(1, 15) for digit in (2, 1, 0.5)))
"""Lengths of vectors relative to the crank's, for a mechanism that its vectors outgrow."""
LONGER = (2.0, 4.0, 5.0)
"""The same for short vectors."""
NARROW = LEAST_FIELD - 2 * MARGIN
"""Least width of mechanism and plan in mm, so that captions have room above them."""
LADDER, MOST = 6, 90
"""Number of preferred scales tried from the first that holds everything, and in search of it."""
PACES = 4
"""Number of round kv tried without a crank."""
OUTGROWN = 1.1
"""Vectors outgrow a mechanism if they enlarge it by more than this factor."""
GAIN, PLAIN = 0.15, 0.05
"""Least gain in size for shorter vectors than the crank's, and for a coarser kv."""
LOSS = 0.02
"""Largest loss in size for longer vectors."""
SHORT, LONG = 20.0, 90.0
"""Lengths in mm of a longest vector on the mechanism: the least, and the largest wanted."""
COARSEST = 0.02
"""Least factor on the natural kv, for vectors of length zero."""
NOISE = 1e-9
"""Relative size below which a plan consists of rounding errors."""
WEIGHT = 1.3
"""Weight of the size of the mechanism against its plans together."""
BLUR = 0.2
"""Loss in size where components are laid off e times as long as in their triangles."""
RARE = 0.25
"""Loss in size for a scale that ISO 5455 lacks: 1:5 goes before 1:4, but 1:2.5 before 1:5."""
LINE = 0.1
"""Least ratio of a plan's breadth to its length; a plan below it counts as a line."""
LITTLE = 0.12
"""Least part of its field that a plan fills; below it the plan counts as smaller than it is."""
JUST = 1 + 1e-12
"""Tolerance for rounding in tests of fit."""


class Needs(Struct, frozen=True):
    """The boxes of a mechanism's drawings, in metres of the mechanism.

    ``bare`` holds the mechanism, ``whole`` all that any sheet draws on it. ``plans`` are the boxes
    of the plans at the scale of their vectors on the mechanism; ``longest`` are the longest of
    these vectors.
    """

    bare: Extent
    whole: Extent
    plans: Mapping[str, Extent]
    longest: Mapping[str, float]

    @property
    def outgrown(self) -> bool:
        """Whether vectors extend far beyond the mechanism."""
        return self.whole.diagonal > OUTGROWN * self.bare.diagonal


class Stated(Struct, frozen=True):
    """The scale factors that a scene states, 0 for each factor not stated.

    ``scale`` is kL; ``ka`` is in m/s² per metre of paper. ``times`` is the length of the pin's
    vector in each plan relative to the crank. ``steps`` are the first digits of a school's scales.
    """

    scale: float
    times: Mapping[str, float]
    ka: float
    steps: tuple[float, ...] = ()
    paper: SheetPaper = A3

    @property
    def keys(self) -> list[str]:
        """The keys of [sheet] that the scene states."""
        enlarge = max(self.times.values())
        said = {"scale": self.scale, "enlarge": enlarge, "ka": self.ka}
        return [key for key, value in said.items() if value]


class Composition(Struct, frozen=True):
    """A scale of the mechanism, the enlargement of each plan, and a measure of the total size.

    The size is reduced by ``lack`` for plans that fill little of their fields.
    """

    size: float
    kL: float
    times: Mapping[str, float]
    lack: float


Ladders = Mapping[str, Sequence[float]]
"""The possible enlargements of each plan relative to the mechanism, the largest first."""
Search = Generator[Scales, Needs, Scales]
"""A search for scale factors: it yields drafts at 1:1 and receives their needs.

It returns the scale factors found. It raises PageError where the stated factors leave no room.
"""


class Attempt(Struct, frozen=True):
    """A composition, and the scales of its draft."""

    composition: Composition
    draft: Scales

    @property
    def size(self) -> float:
        """The measure of the total size."""
        return self.composition.size

    @property
    def scales(self) -> Scales:
        """The scale factors of the composition."""
        kL, times = self.composition.kL, self.composition.times
        m, again = (times.get(kind, 1.0) for kind in ("velocity", "acceleration"))
        return replace(self.draft, kL=kL, larger=m, larger_still=again)


Best = Generator[Scales, Needs, Attempt]
"""A search with all triangles drawn, or without the optional ones."""


def searched_scales(stated: Stated, crank: float, natural: float, *, may_give_way: bool) -> Search:
    """The scale factors of a mechanism whose ``crank`` has a speed in rad/s, 0 without one.

    ``natural`` is the time in which vectors are about as large as the mechanism. Optional triangles
    (``may_give_way``) are dropped where they cause a smaller mechanism, or much smaller drawings.
    """

    def best(*, triangles: bool) -> Best:
        if crank:
            return by_crank(stated, crank, triangles)
        return by_round_kv(stated, natural, triangles)

    drawn = yield from best(triangles=True)
    if may_give_way:
        computed = yield from best(triangles=False)
        if computed.composition.kL < drawn.composition.kL or computed.size > drawn.size + GAIN:
            return computed.scales
    return drawn.scales


def by_crank(stated: Stated, crank: float, triangles: bool) -> Best:
    """The best composition with vectors of the crank's length, or another if that helps."""

    def draft(times: float) -> Scales:
        return Scales(1.0, times / crank, of_crank=times, triangles=triangles)

    def tried(times: float, needs: Needs) -> Attempt | None:
        composition = largest(needs, stated, times / crank, times_of(stated, TIMES, times))
        return Attempt(composition, draft(times)) if composition else None

    needs = yield draft(1.0)
    found, free = tried(1.0, needs), not any(stated.times.values())
    if free and (found is None or needs.outgrown):
        for times in SHORTER:
            fewer = yield draft(times)
            less = tried(times, fewer)
            if less and (found is None or less.size > found.size + GAIN):
                found = less
            if found and not fewer.outgrown:
                break
    elif free and found:
        size = found.size
        for times in LONGER:
            if not found.composition.lack and not is_short(needs, found.composition.kL):
                break
            needs = yield draft(times)
            more = tried(times, needs)
            if more is None or more.size < size - LOSS:
                break
            found = more
    if found is None:
        raise PageError(no_room(needs, stated, 1 / crank))
    return found


def by_round_kv(stated: Stated, natural: float, triangles: bool) -> Best:
    """The best composition at a round kv, with the longest vector at most 90 mm long."""
    first = yield Scales(1.0, natural, triangles=triangles)
    ladders = {**times_of(stated, STILL_LARGER, 1.0), "velocity": ROUND}
    best: Attempt | None = None
    for kL in islice(lengths(first, stated), LADDER):
        own: Attempt | None = None
        finest = kL / natural * coarseness(first, kL)
        for kv in islice(preferred(finest), PACES):
            draft = Scales(1.0, kL / kv, triangles=triangles)
            composition = composed((yield draft), kL, ladders, stated, draft.seconds)
            if composition and own and composition.size < own.size + PLAIN:
                break
            own = Attempt(composition, draft) if composition else own
        if own and (best is None or own.size > best.size + PLAIN):
            best = own
    if best is None:
        raise PageError(no_room(first, stated, natural))
    return best


def is_short(needs: Needs, kL: float) -> bool:
    """Whether the longest velocity on a mechanism is short but not zero."""
    return 0 < 1000 * needs.longest.get("velocity", 0.0) / kL < SHORT


def coarseness(needs: Needs, kL: float) -> float:
    """The factor on the natural kv at which no vector is longer than LONG."""
    speed, thrust = (needs.longest.get(kind, 0.0) for kind in ("velocity", "acceleration"))
    times = 1000 / kL / LONG
    return max(times * speed, sqrt(times * thrust), COARSEST)


def times_of(stated: Stated, ladder: Sequence[float], of_crank: float) -> Ladders:
    """The possible enlargements of each plan relative to the mechanism, the largest first."""
    own = {"velocity": of_crank, "acceleration": of_crank**2}
    return {kind: [times / own[kind]] if times else ladder for kind, times in stated.times.items()}


def lengths(needs: Needs, stated: Stated) -> Iterator[float]:
    """The scales to try: the stated one, or the preferred ones from the first that may fit."""
    if stated.scale:
        return iter([stated.scale])
    return preferred_scales(least(needs.bare, stated.paper), stated.steps)


def least(box: Extent, paper: SheetPaper) -> float:
    """The kL at which a mechanism just leaves room for a plan. Raises PageError for a dot."""
    room = paper.room / 2 if paper.is_parted else paper.room - NARROW
    needed = max(1000 * box.width / room, 1000 * box.height / paper.upright)
    if not needed > 0:
        raise PageError.at("scale", message("the mechanism has no extent"), message("points apart"))
    return float(needed)


def largest(needs: Needs, stated: Stated, seconds: float, ladders: Ladders) -> Composition | None:
    """The scale at which mechanism and plans together are largest; None if none fits."""
    found: list[Composition] = []
    for kL in islice(lengths(needs, stated), MOST):
        choice = composed(needs, kL, ladders, stated, seconds)
        found += [choice] if choice else []
        if len(found) == LADDER:
            break
    return max(found, default=None, key=lambda choice: choice.size)


def composed(
    needs: Needs,
    kL: float,
    ladders: Ladders,
    stated: Stated,
    seconds: float,
) -> Composition | None:
    """The largest plans next to a mechanism at a scale; None where any drawing has no room.

    The size is the logarithm of a harmonic mean of the diagonals of the mechanism and the plans. It
    is reduced for plans that fill little of their fields, and for the errors of triangles laid off
    at many times their length.
    """
    mm = 1000 / kL
    paper = stated.paper
    room = paper.room_beside(max(needs.whole.width * mm, NARROW))
    if needs.whole.height * mm > paper.upright * JUST or room < NARROW:
        return None
    times, sizes, lack = {}, [], 0.0
    for kind, box in needs.plans.items():
        apart = stated.ka and kind == "acceleration"
        tried: Iterable[float] = [kL / stated.ka / seconds**2] if apart else ladders[kind]
        wide, high = box.width * mm, box.height * mm
        fits = (m for m in tried if wide * m <= room * JUST and high * m <= paper.upright * JUST)
        found = next(fits, None)
        if found is None:
            return None
        drawn = box.diagonal > NOISE * needs.bare.diagonal
        times[kind] = found if drawn or apart else 1.0
        sizes += [box.diagonal * mm * found] if drawn else []
        share = wide * high * found**2 / ((room + 2 * MARGIN) * (paper.upright + 2 * ABOVE))
        if drawn and min(wide, high) > LINE * max(wide, high):
            lack += max(log(LITTLE / share), 0.0)
    small = sum(1 / size for size in sizes) / len(sizes) if sizes else 0.0
    size = -log(WEIGHT / (needs.bare.diagonal * mm) + small)
    size -= 0.0 if stated.scale or stated.steps or is_standard(kL) else RARE
    blur = BLUR * max(log(times.get("acceleration", 1.0)), 0.0)
    return Composition(size - blur - lack, kL, times, lack)


def no_room(needs: Needs, stated: Stated, seconds: float) -> Problem:
    """The problem of stated scale factors that leave no room for the drawings."""
    if stated.ka:
        ka = digits(stated.ka / 1000)
        found = message(
            "does not fit: at {ka} (m/s²)/mm the acceleration plan leaves its field", ka=ka
        )
        return Problem(
            "sheet.ka",
            found,
            message("a larger one"),
            message("write a larger ka, or leave it out"),
        )
    free = Stated(0.0, stated.times, 0.0, stated.steps, stated.paper)
    fits = largest(needs, free, seconds, times_of(free, TIMES, 1.0))
    found = message(
        "does not fit: at {scale} the drawing leaves its fields", scale=ratio(stated.scale or 1.0)
    )
    if fits is None:
        return Problem("sheet", found, message("drawings of a size"), message("leave [sheet] out"))
    kL = next(
        kL
        for kL in preferred_scales(least(needs.bare, stated.paper), stated.steps)
        if composed(needs, kL, times_of(free, TIMES, 1.0), free, 1.0) is not None
    )
    hint = message("write scale = {kL}, or leave it out", kL=digits(kL))
    return Problem("sheet.scale", found, message("{kL} or smaller", kL=ratio(kL)), hint)
