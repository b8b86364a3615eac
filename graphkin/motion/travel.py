"""The strokes, swings and time ratios that a scene asks for, from the dead positions."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct

from graphkin.construction.core.program import Target
from graphkin.construction.core.quantities import STROKE, SWING, TIME_RATIO
from graphkin.motion.cycle import Cycle, cycle_at
from graphkin.motion.driving import TURN
from graphkin.motion.follower_limits import Follower, followers
from graphkin.motion.pieces import reachable_ranges
from graphkin.motion.sweep import sweep_of
from graphkin.text.errors import Problem, SceneError, message

if TYPE_CHECKING:
    from graphkin.mechanism import Mechanism


class Travel(Struct, frozen=True):
    """What one request gives: its value, the follower, and the mechanism at both dead positions.

    A stroke is in m, a swing in degrees; the time ratio is the slower stroke over the faster.
    """

    value: float
    follower: Follower
    ends: tuple[Mechanism, Mechanism]


def travels(mechanism: Mechanism) -> Mapping[Target, Travel]:
    """The travel of each follower that [ask] names, over the range of the scene.

    Raises SceneError for all links that do not move to and fro or have no time ratio.
    """
    ask = mechanism.scene.ask
    if not (ask.strokes or ask.time_ratios):
        return {}
    moved = whole_motion(mechanism)
    known = {each.name: each for each in followers(moved) if is_to_and_fro(each)}
    found: dict[Target, Travel] = {}
    problems: list[Problem] = []
    for place, names in (("strokes", ask.strokes), ("time_ratios", ask.time_ratios)):
        for i, name in enumerate(names):
            own = known.get(name)
            if own is None:
                wrong = message("link {name} does not move to and fro", name=name)
                wanted = message("a block, or a link on the frame that swings")
                problems.append(Problem(f"ask.{place}[{i}]", wrong, wanted))
            elif place == "strokes":
                quantity = STROKE if own.line is None else SWING
                found[quantity.target, name] = Travel(own.extent, own, ends_of(moved, own))
            elif own.time_ratio is None:
                wrong = message("link {name} has no time ratio", name=name)
                wanted = message("a driver that turns fully, and one stroke each way in its turn")
                problems.append(Problem(f"ask.{place}[{i}]", wrong, wanted))
            else:
                ratio = Travel(own.time_ratio, own, ends_of(moved, own))
                found[TIME_RATIO.target, name] = ratio
    if problems:
        raise SceneError(problems)
    return found


def whole_motion(mechanism: Mechanism) -> Cycle:
    """The motion over the range of the scene, with one row in its middle."""
    sweep = sweep_of(mechanism.scene)
    path = reachable_ranges(sweep)
    return cycle_at(mechanism, sweep, path, np.array([sum(path.spans[0]) / 2]), ())


def is_to_and_fro(travel: Follower) -> bool:
    """Whether a follower moves to and fro: a block, or a link that never turns fully."""
    return not travel.full and (travel.line is None or travel.extent < TURN)


def ends_of(moved: Cycle, travel: Follower) -> tuple[Mechanism, Mechanism]:
    """The mechanism at the low and at the high limit of a follower."""
    low, high = (moved.mechanism_at(limit.at) for limit in (travel.low, travel.high))
    return low, high
