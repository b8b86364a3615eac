"""The scale factors of the sheets of many variants: for each those of its own sheet.

The searches of all variants run side by side: what they ask for is reckoned in arrays, for those at
once that ask alike. Mechanisms of pins and guides that one crank drives can be reckoned so; others
go through scaling.scales, one variant after the other.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from math import nan
from typing import Any

from msgspec import Struct, field

from graphkin.classroom.lab.drawing_extents import needs_of, sketches
from graphkin.construction.core.component import may_give_way
from graphkin.documents.composing import Search, Stated, searched_scales
from graphkin.documents.scaling import scales, stated_of
from graphkin.drawing.scale import Scales
from graphkin.mechanism import Mechanism
from graphkin.numbers.arithmetic import batch_kind
from graphkin.numbers.arrays import np
from graphkin.text.errors import GraphkinError

Array = Any
Values = Mapping[str, Any]
Loader = Callable[[int], Mechanism]
"""What makes the mechanism of one variant, by its place in the batch."""


NOWHERE = Scales(nan, nan, nan, nan, nan)
"""What stands for the scale factors of a variant that fits nowhere."""


class Scaling(Struct):
    """The scale factors of each variant, None where nothing fits; ``rates`` is what the hand tries
    in auxiliary plans, an array by the step.
    """

    own: list[Scales | None]
    rates: dict[int, Array] = field(default_factory=dict)

    def together(self, which: Iterable[int]) -> Scales:
        """Those of some variants, of which each factor is an array; NaN where nothing fits."""
        some, names = [self.own[i] or NOWHERE for i in which], Scales.__struct_fields__
        factors: list[Any] = [np.array([getattr(each, name) for each in some]) for name in names]
        return Scales(*factors)


def scaling(
    mechanism: Mechanism, values: Values, count: int, load: Loader, closes: Array = True
) -> Scaling:
    """The scale factors of each of ``count`` variants, whose parameters are arrays or shared.

    ``load`` makes one variant's mechanism, for those that are not reckoned in arrays; only those
    that ``closes`` names are tried.
    """
    found = Scaling([None] * count)
    done = np.zeros(count, dtype=bool)
    if by_arrays(mechanism):
        done = scaled(mechanism, values, found)
    for index in np.flatnonzero(closes & ~done):
        one_by_one(load, int(index), found)
    return found


def by_arrays(mechanism: Mechanism) -> bool:
    """Whether one crank drives a mechanism of pins and guides, and no curve is drawn with it."""
    scene = mechanism.scene
    ask, links = scene.ask, (scene.frame, *scene.links.values())
    steps = mechanism.program.steps
    return (
        len(scene.drivers) == 1
        and scene.drivers[0].kind == "turn"
        and not (ask.curves or ask.centrodes)
        and not any(link.has_wheels for link in links)
        and not any(step.closes for step in steps)
        and not mechanism.trial_rates
    )


def scaled(mechanism: Mechanism, values: Values, found: Scaling) -> Array:
    """Scale what a crank drives that turns; the result says which variants that are."""
    size = len(found.own)
    speed = np.broadcast_to(np.abs(mechanism.scene.drivers[0].speed.si(values, batch_kind())), size)
    turning = np.flatnonzero(np.asarray(speed, dtype=float) > 0)
    part, speeds = taken(values, turning), speed[turning]
    said = stated_of(mechanism.scene.sheet, part, len(turning), batch_kind())
    drawn = side_by_side(mechanism, part, speeds, said)
    for index, own in zip(turning, drawn, strict=True):
        found.own[int(index)] = own
    done = np.zeros(size, dtype=bool)
    done[turning] = True
    return done


def side_by_side(
    mechanism: Mechanism, values: Values, speed: Array, said: Sequence[Stated]
) -> list[Scales | None]:
    """What the search of each variant ends in; None where nothing fits."""
    found: list[Scales | None] = [None] * len(said)
    gives_way = may_give_way(mechanism.program)
    asking: list[Search] = [
        searched_scales(each, float(w), 0.0, may_give_way=gives_way)
        for each, w in zip(said, speed, strict=True)
    ]
    waiting = {i: next(search) for i, search in enumerate(asking)}
    while waiting:
        triangles = next(iter(waiting.values())).triangles
        alike = [i for i, draft in waiting.items() if draft.triangles == triangles]
        which, seconds = np.array(alike), np.array([waiting[i].seconds for i in alike])
        drafts = sketches(mechanism, taken(values, which), seconds, triangles=triangles)
        for i, needs in zip(alike, needs_of(drafts), strict=True):
            del waiting[i]
            try:
                if needs is not None:
                    waiting[i] = asking[i].send(needs)
            except StopIteration as end:
                found[i] = end.value
            except GraphkinError:
                continue
    return found


def one_by_one(load: Loader, index: int, found: Scaling) -> None:
    """The scale factors of one variant by its own sheet, if it has some."""
    try:
        one = load(index)
        own = scales(one)
    except GraphkinError:
        return
    found.own[index] = own
    for number, rate in one.trial_rates.items():
        rates = found.rates.setdefault(number, np.full(len(found.own), np.nan))
        rates[index] = rate


def taken(values: Values, which: Array) -> dict[str, Any]:
    """The parameters of some variants."""
    return {n: v[which] if hasattr(v, "shape") else v for n, v in values.items()}
