"""The fields that take the whole motion: strokes, swings and time ratios, read at dead positions.

A student draws the mechanism in both dead positions. The pencil's error is that of the follower's
point in these two drawings; an angle of the driver is read at the end of its crank.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import degrees, hypot, inf, sqrt
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from graphkin.accuracy.pencil import (
    Original,
    Paper,
    Pencil,
    answers,
    expected,
    original,
    redrawn,
    sources,
)
from graphkin.classroom.lab.items import is_of_travel
from graphkin.classroom.lab.lab_model import Item
from graphkin.construction.core.program import Plane, Program, Target
from graphkin.construction.core.quantities import STROKE, SWING, TIME_RATIO
from graphkin.drawing.scale import Scales
from graphkin.mechanism import Mechanism
from graphkin.motion.follower_limits import Travel, swinging_line, travels
from graphkin.numbers.arithmetic import np
from graphkin.text.errors import GraphkinError


class TravelKey(Struct, frozen=True):
    """The key of one field, the pencil's error in it, and a millimetre of the ruler in its unit.

    ``recurs`` says that the follower has one stroke each way, without dwells, in a driver's turn.
    """

    value: float
    pencil: float
    millimetre: float
    recurs: bool


def travel_keys(
    mechanism: Mechanism, items: Sequence[Item], scales: Scales, pencil: Pencil
) -> Mapping[str, TravelKey]:
    """The keys of the fields that take the whole motion. Raises SceneError as ``travels`` does."""
    some = [item for item in items if is_of_travel(item)]
    if not some:
        return {}
    found = travels(mechanism)
    return {
        item.field: travel_key(item, found[item.quantity, item.of], scales, pencil) for item in some
    }


def travel_key(item: Item, travel: Travel, scales: Scales, pencil: Pencil) -> TravelKey:
    """The key of one field."""
    paper = Paper.of(scales)
    mm = paper.millimetre(Plane.MECHANISM)
    recurs = travel.follower.strokes is not None and not travel.follower.dwells
    if item.quantity in (STROKE.target, SWING.target):
        low, high = (error_at(end, travel, scales, pencil) for end in travel.ends)
        per = 1.0 if item.quantity == STROKE.target else degrees(1 / arm_of(travel))
        return TravelKey(travel.value, per * hypot(low, high), per * mm, recurs)
    assert travel.follower.strokes is not None
    slow, fast = travel.follower.strokes
    share = travel.value * (1 / slow + 1 / fast)
    crank = crank_of(travel.ends[0])
    angle = hypot(pencil.degrees, degrees(pencil.point * mm / crank))
    pencil_error, ruler = share * sqrt(2) * angle, share * degrees(mm / crank)
    return TravelKey(travel.value, pencil_error, ruler, recurs)


def places_of(mechanism: Mechanism, items: Sequence[Item]) -> Mapping[str, tuple[Target, ...]]:
    """The coordinate of a block, or both ends of the line of a link, by field."""
    scene, found = mechanism.scene, dict[str, tuple[Target, ...]]()
    for item in filter(is_of_travel, items):
        line = swinging_line(scene, scene.links[item.of])
        some = tuple(("position", name) for name in line) if line else (("slide", item.of),)
        if all(map(mechanism.gives, some)):
            found[item.field] = some
    return found


def round_the_turn(quantity: str, places: Sequence[Any]) -> Any:
    """A travel (N, 1) from the places of a follower in equal steps of a whole turn: (N, M) each.

    ``places`` are a block's coordinates, or both ends of a link's line.
    """
    where = places[0]
    if len(places) > 1:
        where = np.degrees(np.unwrap(np.angle(places[1] - places[0]), axis=-1))
    (at_high, high), (at_low, low) = top(where), top(-where)
    if quantity != TIME_RATIO.target:
        return high + low
    share = (at_high - at_low) % 1
    return np.maximum(share, 1 - share) / np.minimum(share, 1 - share)


def top(where: Any) -> tuple[Any, Any]:
    """The place, as a share of the turn, and the largest value, by a parabola through three."""
    count, rows = where.shape[-1], np.arange(len(where))
    known = np.where(np.isfinite(where), where, -np.inf)
    k = known.argmax(axis=-1)
    before, here, after = (where[rows, (k + i) % count] for i in (-1, 0, 1))
    bend = before - 2 * here + after
    with np.errstate(all="ignore"):
        aside = np.where(bend < 0, (before - after) / (2 * bend), 0.0)
    aside = np.nan_to_num(aside)
    best = here - np.nan_to_num(before - after) * aside / 4
    return ((k + aside) / count)[:, None], best[:, None]


def error_at(end: Mechanism, travel: Travel, scales: Scales, pencil: Pencil) -> float:
    """The pencil's error (m) of a follower's point at a dead position; infinite if not drawn."""
    link = end.scene.links[travel.follower.name]
    point = link.points[0] if travel.follower.line is None else travel.follower.line[1]
    try:
        exact = original(end, scales, [("position", point)])
    except GraphkinError:
        return inf
    owners, errors = sources(exact)
    found = redrawn(exact, pencil, errors)
    return max((expected(each, found, owners).error for each in answers(exact)), default=0.0)


def arm_of(travel: Travel) -> float:
    """The length (m) of the line of a link that swings."""
    assert travel.follower.line is not None
    start, tip = (placed(travel.ends[0], name) for name in travel.follower.line)
    return abs(tip - start)


def crank_of(mechanism: Mechanism) -> float:
    """The distance (m) of the driver's farthest point from its pivot, where its angle is read."""
    scene = mechanism.scene
    link = scene.links[scene.drivers[0].link]
    pivots = [name for name in link.points if name in scene.fixed_points]
    if not pivots:
        return inf
    pivot = placed(mechanism, pivots[0])
    return max(abs(placed(mechanism, name) - pivot) for name in link.points) or inf


def placed(mechanism: Mechanism, point: str) -> complex:
    """The place (m) of a point."""
    return complex(mechanism.trace([("position", point)]).value("position", point))


def with_keys(
    exact: Original, program: Program, items: Sequence[Item], keys: Mapping[str, TravelKey]
) -> Original:
    """The drawing with the values of the fields that take the whole motion, at steps of their own.

    ``program`` has these steps.
    """
    if not keys:
        return exact
    values = {
        program.targets[item.quantity, item.of]: keys[item.field].value
        for item in items
        if item.field in keys
    }
    trace = replace(exact.trace, program=program, values={**exact.trace.values, **values})
    return replace(exact, trace=trace)
