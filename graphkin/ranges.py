"""For which positions of a driver a mechanism closes, while the other drivers stand."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from graphkin.errors import GraphkinError
from graphkin.scene.known import quoted
from graphkin.scene.model import Driver, Scene
from graphkin.scene.quantity import LENGTHS

if TYPE_CHECKING:
    from graphkin.motion.course import Course
    from graphkin.motion.sweep import Sweep

HALVINGS = 20
"""How often the last step at the end of a range is halved."""
NOISE = 1e-12
"""Sine of crossing of lines that are parallel throughout, but for rounding."""
MOST = 3
"""Drivers told with their ranges."""
LISTED = 6
"""Ranges told of one driver."""
FREE = {
    (False, False): "{0} to {1} {2}",
    (True, False): "up to {1} {2}",
    (False, True): "{0} {2} and more",
    (True, True): "of any size",
}
"""Words for a range of a sliding driver, by whether it reaches below and above what was tried."""
Range = tuple[float, float]


def where_it_closes(scene: Scene) -> str:
    """Words for the positions of each driver at which every position can be drawn."""
    known = [
        (driver, reached_words(scene, closing_ranges(scene, n), n))
        for n, driver in enumerate(scene.drivers[:MOST], 1)
    ]
    if len(scene.drivers) == 1:
        ((driver, words),) = known
        noun = "angle" if driver.kind == "turn" else "position"
        if words:
            return f"it closes for driver {noun}s {words}"
        return f"it closes for no {noun} of the driver: check the lengths"
    told = [f"{driver_words(driver)} from {words}" for driver, words in known if words]
    if not told:
        return "no driver alone can close it: check lengths, sides and the drivers' positions"
    return f"it closes, the other drivers as they stand, for {'; or for '.join(told)}"


def reached_words(scene: Scene, found: Sequence[Range], number: int = 1) -> str:
    """The ranges of one driver, counted from 1, in the scene's units; empty where there are none.

    Ranges of angles are told in order of their first angle from -180 to 180 degrees.
    """
    if scene.drivers[number - 1].kind == "turn":
        turned = sorted((r[0] - 360, r[1] - 360) if r[1] > 360 else r for r in found)
        words = [f"{low:.2f}° to {high:.2f}°" for low, high in turned]
    else:
        words = [slid_words(scene, each, number) for each in found]
    more = f" and {len(words) - LISTED} more ranges" if len(words) > LISTED else ""
    return ", ".join(words[:LISTED]) + more


def slid_words(scene: Scene, found: Range, number: int) -> str:
    """One range of a driver that slides or rolls."""
    sweep, unit = swept(scene, number), scene.units["length"]
    low, high = found
    free = low <= sweep.low + sweep.grid_step, high >= sweep.high - sweep.grid_step
    first, last = (f"{end / float(LENGTHS[unit]):.6g}" for end in found)
    return FREE[free].format(first, last, unit)


def closing_ranges(scene: Scene, number: int = 1) -> list[Range]:
    """The ranges of a driver's position (degrees or m) for which all positions can be drawn.

    The closures are those that the scene picks, the other drivers stand. One turn is looked at, or
    as far as all lengths together reach; [(0, 360)] is a whole turn.
    """
    import numpy as np

    from graphkin.motion.counted import led_both
    from graphkin.motion.course import Course
    from graphkin.motion.driving import GRID, TURN

    sweep = swept(scene, number)
    start = TURN * (sweep.start // TURN) if sweep.whole else sweep.low
    step = sweep.grid_step
    grid = start + np.arange(GRID + (not sweep.whole)) * step
    try:
        course = led_both(
            Course(sweep, scene.branches), sweep.start, float(grid[0]), float(grid[-1])
        )
        margins = course.margins(grid)
    except GraphkinError:
        return []
    closed = np.isfinite(margins).all(axis=0)
    if len(margins) > 1 and np.nanmin(margins[:-1], axis=0, initial=1.0).max(initial=0.0) < NOISE:
        return []
    if closed.all():
        return [(0.0, TURN)] if sweep.whole else [(float(grid[0]), float(grid[-1]))]
    if not closed.any():
        return []
    if not sweep.whole:
        closed = np.concatenate([[False], closed, [False]])
        grid = np.concatenate([[grid[0] - step], grid, [grid[-1] + step]])
    starts = np.flatnonzero(closed & ~np.roll(closed, 1))
    ends = np.flatnonzero(closed & ~np.roll(closed, -1))
    if ends[0] < starts[0]:
        ends = np.roll(ends, -1)
    lows, highs = refined(course, grid[starts], -step), refined(course, grid[ends], step)
    pairs = [(float(low), float(high)) for low, high in zip(lows, highs, strict=True)]
    return sorted((low - (TURN if high < low else 0), high) for low, high in pairs)


def swept(scene: Scene, number: int) -> Sweep:
    """One turn of a driver, or as far to both sides of nought as all lengths together reach."""
    from graphkin.motion.driving import reach_of, stated
    from graphkin.motion.sweep import sweep_of

    driver = scene.drivers[number - 1]
    if driver.kind == "turn":
        return sweep_of(scene, driver=number)
    far = 2 * reach_of(scene) + abs(stated(driver, scene)[0])
    return sweep_of(scene, driver=number, low=-far, high=far)


def refined(course: Course, at: Any, step: float) -> Any:
    """The ends of closing ranges, each between a position that closes and one a step further."""
    closing, size = at, step
    for _ in range(HALVINGS):
        size /= 2
        further = closing + size
        if course.sweep.whole:
            further = course.sweep.start // 360 * 360 + further % 360
        closing = closing + size * course.closes(further)
    return closing


def driver_words(driver: Driver) -> str:
    """A driver in short, as it is written: turn = 1."""
    return f"{driver.kind} = {quoted(driver.link)}"
