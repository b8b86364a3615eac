"""How large mechanism and plans are drawn beside one another, from the boxes that they take up.

The mechanism stands at one place on all sheets, whose fields are divided alike. Vectors are set on
it as long as the one crank says that drives, or at a round kv; each plan is as many times as large
as its field holds. Of the scales of the mechanism that is taken at which all is largest together.

The search asks for boxes by yielding the time in which velocities are set on the mechanism as ways,
so that one search serves a single sheet and, all at a time, the variants of a class.
"""

from __future__ import annotations

from collections.abc import Generator, Iterable, Iterator, Mapping, Sequence
from itertools import islice
from math import log
from typing import NamedTuple

from msgspec import Struct

from graphkin.drawing.areas import HEIGHT, WIDTH
from graphkin.drawing.scale import LENGTHS, Extent, Scales, digits, preferred, ratio
from graphkin.text.errors import PageError, Problem

TIMES = (5.0, 4.0, 3.0, 2.5, 2.0, 1.5, 1.0, 0.75, 0.5, 0.4, 0.3, 0.25, 0.2, 0.15, 0.1, 0.05, 0.02)
"""How many times as large as on the mechanism plans are drawn."""
ROUND = (5.0, 4.0, 2.5, 2.0, 1.0, 0.5, 0.4, 0.25, 0.2, 0.1, 0.05, 0.02)
"""The same where no crank says how large: round scale factors stay round."""
SHORTER = (0.5, 0.25, 0.2, 0.1, 0.05, 0.02)
"""How many times as long as the crank vectors are set on a mechanism that they outgrow."""
LONGER = (1.5, 2.0, 3.0, 4.0, 5.0)
"""The same where they are short."""
NARROW = 45.0
"""Least width of a plan in mm, so that its caption has room above it."""
LADDER, MOST = 4, 60
"""Preferred scales that are tried from the first that holds all, and in search of it."""
PACES = 4
"""Round kv that are tried where no crank says one."""
OUTGROWN = 1.1
"""Vectors outgrow a mechanism that is so many times as large with them."""
GAIN, PLAIN = 0.15, 0.05
"""Gain in size for which vectors are set shorter than a crank says; for which a kv is less fine."""
LOSS = 0.02
"""Loss in size for which they are set longer."""
SHORT, LONG = 20.0, 90.0
"""A longest velocity on the mechanism that is long enough, and long, in mm."""
JUST = 1 + 1e-12
"""What fits but for rounding, fits."""


class Needs(Struct, frozen=True):
    """The boxes of a mechanism's drawings, in metres of the mechanism.

    ``bare`` holds the mechanism, ``whole`` all that any sheet draws on it; of each sheet's plan the
    box where it is as large as its vectors are set on the mechanism. ``longest`` is the longest
    velocity that is set on it.
    """

    bare: Extent
    whole: Extent
    plans: Mapping[str, Extent]
    longest: float

    @property
    def outgrown(self) -> bool:
        """Whether vectors reach far beyond the mechanism."""
        return self.whole.diagonal > OUTGROWN * self.bare.diagonal


class Stated(Struct, frozen=True):
    """What a scene says of its scale factors, 0 where it says nothing.

    ``scale`` is kL, ``ka`` in m/s² for each metre of paper; ``times`` how many times as long as the
    crank each plan draws the vectors of its pin.
    """

    scale: float
    times: Mapping[str, float]
    ka: float

    @property
    def keys(self) -> list[str]:
        """What of [sheet] it states."""
        enlarge = max(self.times.values())
        said = {"scale": self.scale, "enlarge": enlarge, "ka": self.ka}
        return [key for key, value in said.items() if value]


class Choice(NamedTuple):
    """A scale of the mechanism, how many times as large each plan is, and how large all is."""

    size: float
    kL: float  # noqa: N815
    times: Mapping[str, float]


Search = Generator[float, Needs, Scales]
"""The search for scale factors: it asks for needs by times in seconds, and ends in what it found.

It raises PageError where what is stated leaves no room.
"""


def searched(stated: Stated, crank: float, natural: float, *, triangles: bool) -> Search:
    """The scale factors of a mechanism that a ``crank`` drives with a speed in rad/s, or nought.

    ``natural`` is the time in which its vectors are about as large as itself.
    """
    if crank:
        return by_crank(stated, crank, triangles)
    return by_round_kv(stated, natural, triangles)


def by_crank(stated: Stated, crank: float, triangles: bool) -> Search:
    """Vectors on the mechanism as long as the crank says; shorter or longer where that serves."""
    needs = yield 1 / crank
    times, choice = 1.0, largest(needs, stated, 1 / crank, times_of(stated, TIMES, 1.0))
    free = not any(stated.times.values())
    if free and (choice is None or needs.outgrown):
        for less in SHORTER:
            fewer = yield less / crank
            found = largest(fewer, stated, less / crank, times_of(stated, TIMES, less))
            if found and (choice is None or found.size > choice.size + GAIN):
                times, choice = less, found
            if not fewer.outgrown:
                break
    elif free and choice and 1000 * needs.longest / choice.kL < SHORT:
        for more in LONGER:
            longer = yield more / crank
            found = largest(longer, stated, more / crank, times_of(stated, TIMES, more))
            if found is None or found.size < choice.size - LOSS:
                break
            times = more
            choice = found._replace(size=max(choice.size, found.size))
            if 1000 * longer.longest / choice.kL >= SHORT:
                break
    if choice is None:
        raise PageError(no_room(needs, stated, 1 / crank))
    return scaled(choice, times / crank, times, triangles)


def by_round_kv(stated: Stated, natural: float, triangles: bool) -> Search:
    """Vectors on the mechanism at a round kv, at which the longest velocity is at most 90 mm long."""
    first = yield natural
    ladders = times_of(stated, ROUND, 1.0)
    best: tuple[Choice, float] | None = None
    for kL in islice(lengths(first, stated), LADDER):
        finest = kL / natural * max(1000 * first.longest / kL / LONG, 0.02)
        for kv in islice(preferred(finest), PACES):
            needs = yield kL / kv
            found = composed(needs, kL, ladders, stated, kL / kv)
            if found and (best is None or found.size > best[0].size + PLAIN):
                best = found, kL / kv
    if best is None:
        raise PageError(no_room(first, stated, natural))
    return scaled(*best, 0.0, triangles)


def scaled(choice: Choice, seconds: float, of_crank: float, triangles: bool) -> Scales:
    """The scale factors of a choice."""
    m, again = (choice.times.get(kind, 1.0) for kind in ("velocity", "acceleration"))
    return Scales(choice.kL, seconds, m, again, of_crank, triangles)


def times_of(stated: Stated, ladder: Sequence[float], of_crank: float) -> Mapping[str, Sequence[float]]:
    """How many times as large as on the mechanism each plan may be, the largest first."""
    own = {"velocity": of_crank, "acceleration": of_crank**2}
    return {
        kind: [times / own[kind]] if times else ladder for kind, times in stated.times.items()
    }


def lengths(needs: Needs, stated: Stated) -> Iterator[float]:
    """The scales that are tried: the stated one, or preferred ones from which all may fit."""
    if stated.scale:
        return iter([stated.scale])
    return preferred(least(needs.bare), LENGTHS)


def least(box: Extent) -> float:
    """The kL at which a mechanism just leaves room for a plan. Raises PageError for a mere dot."""
    needed = max(1000 * box.width / (WIDTH - NARROW), 1000 * box.height / HEIGHT)
    if not needed > 0:
        raise PageError(Problem("scale", "the mechanism has no extent", "points apart"))
    return float(needed)


def largest(
    needs: Needs, stated: Stated, seconds: float, ladders: Mapping[str, Sequence[float]]
) -> Choice | None:
    """The scale at which mechanism and plans are largest together; None where none holds them."""
    found: list[Choice] = []
    for kL in islice(lengths(needs, stated), MOST):
        choice = composed(needs, kL, ladders, stated, seconds)
        found += [choice] if choice else []
        if len(found) == LADDER:
            break
    return max(found, default=None, key=lambda choice: choice.size)


def composed(
    needs: Needs,
    kL: float,
    ladders: Mapping[str, Sequence[float]],
    stated: Stated,
    seconds: float,
) -> Choice | None:
    """The largest plans beside a mechanism at a scale; None where it, or one of them, has no room.

    Its size adds the logarithms of the diagonals: the mechanism's, and the mean of the plans'.
    """
    mm = 1000 / kL
    room = WIDTH - needs.whole.width * mm
    if needs.whole.height * mm > HEIGHT * JUST or room < NARROW:
        return None
    times, sizes = {}, []
    for kind, box in needs.plans.items():
        apart = stated.ka and kind == "acceleration"
        tried: Iterable[float] = [kL / stated.ka / seconds**2] if apart else ladders[kind]
        wide, high = box.width * mm, box.height * mm
        fits = (m for m in tried if wide * m <= room * JUST and high * m <= HEIGHT * JUST)
        found = next(fits, None)
        if found is None:
            return None
        drawn = wide > 0 or high > 0
        times[kind] = found if drawn or apart else 1.0
        sizes += [log(box.diagonal * mm * found)] if drawn else []
    mean = sum(sizes) / len(sizes) if sizes else 0.0
    return Choice(log(needs.bare.diagonal * mm) + mean, kL, times)


def no_room(needs: Needs, stated: Stated, seconds: float) -> Problem:
    """The problem of scale factors that leave drawings no room: of the one that is stated."""
    if stated.ka:
        ka = digits(stated.ka / 1000)
        found = f"does not fit: at {ka} (m/s²)/mm the acceleration plan leaves its field"
        return Problem("sheet.ka", found, "a larger one", "write a larger ka, or leave it out")
    free = Stated(0.0, stated.times, 0.0)
    fits = largest(needs, free, seconds, times_of(free, TIMES, 1.0))
    found = f"does not fit: at {ratio(stated.scale or 1.0)} the drawing leaves its fields"
    if fits is None:
        return Problem("sheet", found, "drawings of a size", "leave [sheet] out")
    kL = next(kL for kL in preferred(least(needs.bare), LENGTHS) if fits_at(needs, free, kL))
    hint = f"write scale = {digits(kL)}, or leave it out"
    return Problem("sheet.scale", found, f"{ratio(kL)} or smaller", hint)


def fits_at(needs: Needs, stated: Stated, kL: float) -> bool:
    """Whether all has room at a scale."""
    return composed(needs, kL, times_of(stated, TIMES, 1.0), stated, 1.0) is not None
