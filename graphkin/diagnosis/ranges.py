"""The positions of a driver at which a mechanism closes, with the other drivers at rest."""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce
from typing import TYPE_CHECKING, Any

from msgspec import Struct

from graphkin.numbers.arithmetic import np
from graphkin.scene.model import Scene
from graphkin.structure.driver_count import driver_name
from graphkin.text.errors import NO_WORDS, ClosureError, Message, joined, message

if TYPE_CHECKING:
    from graphkin.motion.course import Course
    from graphkin.motion.sweep import Sweep

WORK = 60_000_000
"""Steps of closing groups that a search may take: about a second."""
FEWEST, DEAREST = 180, 10 * WORK
"""Positions that are searched at up to DEAREST steps, and none beyond."""
NARROWINGS = 5
"""How many times the last step at the end of a range is cut into parts."""
PARTS = 16
"""Parts of each such cut, all tried at once."""
TOUCHING = 1e-7
"""Share of the whole search that rounding leaves between two ranges which meet."""
FEWER, ROUNDS = 36, (0, 2, 1, 3)
"""FEWEST for groups that try several links at once; a position costs a hundredfold.

They are searched in rounds of every fourth one, until one closes.
"""
SOUGHT = 2
"""The most links tried at once for which positions are searched at all."""
MOST = 3
"""The most drivers whose ranges are reported."""
LISTED = 6
"""The most ranges reported for one driver."""
Range = tuple[float, float]


class ClosingRanges(Struct, frozen=True):
    """The ranges of one driver's position (degrees or m) in which a mechanism closes.

    ``searched`` counts the positions searched where a bound on the work left some out, else it is
    0. There are no ranges where ``tried`` counts the links tried at once that are too many for a
    search, or ``dear`` says that it takes too many trials. ``followed`` means that the only range
    is the one through which the motion goes from the scene's position, where a search at every
    position would cost too much.
    """

    ranges: list[Range]
    searched: int = 0
    tried: int = 0
    dear: bool = False
    followed: bool = False

    @property
    def left_out(self) -> bool:
        """Whether nothing was searched."""
        return bool(self.tried) or self.dear

    @property
    def bound(self) -> Message:
        """Words for a search that was bounded or left out; empty otherwise."""
        if self.tried:
            return message(
                "not searched: {count} links are tried at once, which takes seconds for each "
                "position of the driver",
                count=self.tried,
            )
        if self.dear:
            return message("not searched, as it takes too many trials: check the lengths")
        if not self.searched:
            return NO_WORDS
        return message(
            "searched at {count} positions of the driver; what lies between two of them is not "
            "seen",
            count=self.searched,
        )


def where_it_closes(scene: Scene) -> Message:
    """Words for the positions of each driver at which the whole mechanism can be drawn."""
    return closes_where(scene, closings(scene))


def closings(scene: Scene) -> list[ClosingRanges]:
    """The ranges of each driver, with the other drivers at their stated positions."""
    return [closing(scene, n) for n in range(1, len(scene.drivers[:MOST]) + 1)]


def closes_where(scene: Scene, known: Sequence[ClosingRanges]) -> Message:
    """Words for the ranges of each driver."""
    if left_out := next((found.bound for found in known if found.left_out), None):
        return message("where it closes is {left_out}", left_out=left_out)
    words = closes_for(scene, known)
    bound = next((found.bound for found in known if found.bound), None)
    return message("{words} ({bound})", words=words, bound=bound) if bound else words


def closes_for(scene: Scene, known: Sequence[ClosingRanges]) -> Message:
    """Words for the ranges of each driver, without the bound of the search."""
    if len(scene.drivers) == 1:
        turns = scene.drivers[0].kind == "turn"
        if known[0].ranges:
            return message(
                "it closes for driver angles {ranges}"
                if turns
                else "it closes for driver positions {ranges}",
                ranges=reached_words(scene, known[0].ranges),
            )
        return message(
            "it closes for no angle of the driver: check the lengths"
            if turns
            else "it closes for no position of the driver: check the lengths"
        )
    ranges_by_driver = [
        message(
            "{driver} from {ranges}",
            driver=driver_name(driver),
            ranges=reached_words(scene, found.ranges, n),
        )
        for n, (driver, found) in enumerate(zip(scene.drivers, known, strict=False), 1)
        if found.ranges
    ]
    if not ranges_by_driver:
        return message(
            "no driver alone can close it: check lengths, sides and the drivers' positions"
        )
    return message(
        "with the other drivers where they are, it closes for {ranges}",
        ranges=reduce(
            lambda one, other: message("{one}; or for {other}", one=one, other=other),
            ranges_by_driver,
        ),
    )


def reached_words(scene: Scene, found: Sequence[Range], number: int = 1) -> Message:
    """The ranges of one driver, counted from 1, in the scene's units; empty without any."""
    if scene.drivers[number - 1].kind == "turn":
        words = [message("{low:.2f}° to {high:.2f}°", low=low, high=high) for low, high in found]
    else:
        words = [slid_words(scene, each, number) for each in found]
    some = joined(", ", words[:LISTED])
    more = len(words) - LISTED
    if more <= 0:
        return some
    return message("{ranges} and {count} more ranges", ranges=some, count=more)


def slid_words(scene: Scene, found: Range, number: int) -> Message:
    """Words for one range of a sliding driver."""
    from graphkin.motion.driving import GRID

    sweep, unit = swept(scene, number), scene.units["length"]
    low, high = found
    step = (sweep.high - sweep.low) / GRID
    free = low <= sweep.low + step, high >= sweep.high - step
    first, last = (f"{end / scene.unit_length:.6g}" for end in found)
    ends = {"first": first, "last": last, "unit": unit}
    match free:
        case (False, False):
            return message("{first} to {last} {unit}", **ends)
        case (True, False):
            return message("up to {last} {unit}", last=last, unit=unit)
        case (False, True):
            return message("{first} {unit} and more", first=first, unit=unit)
    return message("of any size")


def closing(scene: Scene, number: int = 1) -> ClosingRanges:
    """The positions of one driver at which the whole mechanism can be drawn, found once a scene.

    The closures are those of the scene, and the other drivers are at rest. The search covers one
    turn, or the reach of all lengths together; [(0, 360)] is a whole turn. Where groups are closed
    by trial, the number of positions depends on the work, and the result states it.
    """
    known: dict[int, ClosingRanges] = scene.__dict__.setdefault("closing_ranges", {})
    if number not in known:
        known[number] = sought(scene, number)
    return known[number]


def sought(scene: Scene, number: int) -> ClosingRanges:
    """The positions of one driver at which the whole mechanism can be drawn."""
    from graphkin.motion.course import Course
    from graphkin.motion.driving import GRID
    from graphkin.motion.turns_followed import TooManyPositionsError, wheels

    course = Course(swept(scene, number), scene.branches)
    try:
        if course.sweep.whole and wheels(course) and not course.closing_work:
            return ClosingRanges(ranges_followed(course))
        if course.tries_several and (reached := range_reached(course)):
            return ClosingRanges(reached, followed=True)
        if course.tried_at_once > SOUGHT:
            return ClosingRanges([], tried=course.tried_at_once)
        if course.tries_several:
            return range_sought(course)
        if FEWEST * course.closing_work > DEAREST:
            return ClosingRanges([], dear=True)
        count = min(GRID, max(FEWEST, WORK // max(course.closing_work, 1)))
        found = ranges_of(course, count)
    except TooManyPositionsError:
        return ClosingRanges([], dear=True)
    except ClosureError:
        return ClosingRanges([])
    return ClosingRanges(found, count if count < GRID else 0)


def ranges_of(course: Course, count: int) -> list[Range]:
    """The ranges in which a course closes, from ``count`` evenly spread positions."""
    from graphkin.motion.course import closing_columns
    from graphkin.motion.driving import TURN
    from graphkin.motion.turns_followed import led_both

    sweep = course.sweep
    start = TURN * (sweep.start // TURN) if sweep.whole else sweep.low
    step = (sweep.high - sweep.low) / count
    grid = start + np.arange(count + (not sweep.whole)) * step
    least = step if course.closing_work else 0.0
    course = led_both(course, sweep.start, float(grid[0]), float(grid[-1]), least)
    margins = course.margins(grid)
    closed = closing_columns(margins)
    if not closed.any():
        return []
    closed |= touched(margins, closed, sweep.whole)
    if closed.all():
        return [(0.0, TURN)] if sweep.whole else [(float(grid[0]), float(grid[-1]))]
    if not sweep.whole:
        closed = np.concatenate([[False], closed, [False]])
        grid = np.concatenate([[grid[0] - step], grid, [grid[-1] + step]])
    change = np.diff(closed.astype(int), prepend=int(closed[-1]))
    starts, ends = np.flatnonzero(change > 0), np.flatnonzero(change < 0) - 1
    if ends[0] < starts[0]:
        ends = np.append(ends[1:], ends[0])
    steps = np.repeat([-step, step], [len(starts), len(ends)])
    at = refined(course, np.concatenate([grid[starts], grid[ends]]), steps)
    lows, highs = at[: len(starts)].tolist(), at[len(starts) :].tolist()
    pairs = zip(lows, highs, strict=True)
    begun = [(low - (TURN if high < low else 0), high) for low, high in pairs]
    over = TURN if sweep.whole else float("inf")
    placed = ((low - TURN, high - TURN) if high > over else (low, high) for low, high in begun)
    return joined_at_touches(sorted(placed), TOUCHING * (sweep.high - sweep.low), sweep.whole)


def joined_at_touches(found: list[Range], near: float, whole: bool) -> list[Range]:
    """The ranges, without the gap at a position at which loci only touch and rounding parts them.

    Such a gap is at most ``near`` wide. ``whole``: the last range goes on in the first.
    """
    from graphkin.motion.driving import TURN

    kept = found[:1]
    for low, high in found[1:]:
        if low - kept[-1][1] <= near:
            kept[-1] = kept[-1][0], high
        else:
            kept.append((low, high))
    if whole and kept[0][0] + TURN - kept[-1][1] <= near:
        if len(kept) == 1:
            return [(0.0, TURN)]
        (_, high), *rest, (low, _) = kept
        kept = [(low - TURN, high), *rest]
    return kept


def touched(margins: Any, closed: Any, whole: bool) -> Any:
    """Single positions, between two that close, at which loci only touch: change points."""
    about = np.pad(closed, 1, mode="wrap" if whole else "constant")
    return np.isfinite(margins).all(axis=0) & about[:-2] & about[2:]


def ranges_followed(course: Course) -> list[Range]:
    """The ranges that the motion reaches, for wheels that differ after the driver's turn."""
    from graphkin.motion.driving import TURN
    from graphkin.motion.pieces import reachable_ranges

    path = reachable_ranges(course.sweep)
    if path.whole:
        return [(0.0, TURN)]
    return sorted(path.spans)


def range_sought(course: Course) -> ClosingRanges:
    """The range through which the motion goes from the first of some positions that closes."""
    sweep = course.sweep
    grid = sweep.low + (np.arange(FEWER) + 0.5) * (sweep.high - sweep.low) / FEWER
    for n, first in enumerate(ROUNDS, 1):
        tried = grid[first :: len(ROUNDS)]
        for start in tried[course.closes(tried)].tolist():
            if reached := range_reached(course, start):
                return ClosingRanges(reached, n * len(tried))
    return ClosingRanges([], FEWER)


def range_reached(course: Course, start: float | None = None) -> list[Range]:
    """The range through which the motion goes from a position, or the scene's; empty without."""
    from graphkin.motion.driving import TURN
    from graphkin.motion.pieces import range_about

    path = range_about(course.sweep, start)
    if path is None:
        return []
    return [(0.0, TURN)] if path.whole else [*path.spans]


def swept(scene: Scene, number: int) -> Sweep:
    """One turn of a driver, or a slide on both sides of zero as far as all lengths reach.

    A cylinder stays on the side of zero on which the scene has it.
    """
    from graphkin.motion.driving import reach_of, stated_motion
    from graphkin.motion.sweep import on_one_side, sweep_of

    driver = scene.drivers[number - 1]
    if driver.kind == "turn":
        return sweep_of(scene, driver=number)
    start = float(stated_motion(driver, scene)[0])
    far = 2 * reach_of(scene) + abs(start)
    low, high = on_one_side(scene, driver, start, -far, far)
    return sweep_of(scene, driver=number, low=low, high=high)


def refined(course: Course, at: Any, steps: Any) -> Any:
    """The ends of closing ranges, each between a closing position and one a step further."""
    share = np.arange(1, PARTS) / PARTS
    for _ in range(NARROWINGS):
        between = at[:, None] + steps[:, None] * share
        turn = course.sweep.start // 360 * 360  # |the full turn of the driver's position
        tried = turn + between % 360 if course.sweep.whole else between
        closes = course.closes(tried.ravel()).reshape(between.shape)
        passed = np.cumprod(closes, axis=1).sum(axis=1)
        at, steps = at + steps * passed / PARTS, steps / PARTS
    return at
