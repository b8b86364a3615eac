"""The scale factors of the sheets of many variants: for each those of its own sheet.

A mechanism of pins and guides that one crank drives is reckoned in arrays, the same way as in
scaling.scales; whatever else there is goes through scaling.scales, one variant after the other.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from msgspec import Struct, field

from graphkin.classroom.lab.drawing_extents import VariantSheet, sketches
from graphkin.construction.core.component import may_give_way
from graphkin.construction.core.quantities import SHEETS
from graphkin.documents.scaling import HEADROOM, LITTLE, SMALL, larger_plans, scales
from graphkin.drawing.areas import HEIGHT, WIDTH
from graphkin.drawing.scale import NARROW, preferred
from graphkin.mechanism import Mechanism
from graphkin.motion.motion_curves import is_closer
from graphkin.numbers.arithmetic import batch_kind
from graphkin.text.errors import GraphkinError

Array = Any
Values = Mapping[str, Any]
Loader = Callable[[int], Mechanism]
"""What makes the mechanism of one variant, by its place in the batch."""


class Scaling(Struct):
    """kL and kL/kv of each variant, and whether triangles that may give way are drawn.

    NaN where nothing fits. ``apart`` is the root of kL/ka where a scene states ka, else 0;
    ``rates`` is what the hand tries in trial plans, by the step. As drawing.scale.Scales, an array
    for each.
    """

    kL: Array  # noqa: N815
    seconds: Array
    triangles: Array
    apart: Array
    rates: dict[int, Array] = field(default_factory=dict)

    def pace(self, kind: str) -> Array:
        """The seconds in which a sheet draws velocities as ways, and accelerations in twos."""
        import numpy as np

        own = np.where(self.apart > 0, self.apart, self.seconds)
        return own if kind == "acceleration" else self.seconds

    def stands(self, kind: str) -> Array:
        """What a metre of paper stands for in a sheet's plan, in SI."""
        return self.kL / self.pace(kind) ** (2 if kind == "acceleration" else 1)

    def taken(self, which: Array) -> Scaling:
        """The scale factors of some variants."""
        parts = (self.kL, self.seconds, self.triangles, self.apart)
        rates = {number: rate[which] for number, rate in self.rates.items()}
        kL, seconds, triangles, apart = (part[which] for part in parts)
        return Scaling(kL, seconds, triangles, apart, rates)


def empty(count: int) -> Scaling:
    """No scale factors yet."""
    import numpy as np

    kL, seconds = np.full(count, np.nan), np.full(count, np.nan)
    return Scaling(kL, seconds, np.ones(count, dtype=bool), np.zeros(count))


def scaling(
    mechanism: Mechanism, values: Values, count: int, load: Loader, closes: Array = True
) -> Scaling:
    """The scale factors of each of ``count`` variants, whose parameters are arrays or shared.

    ``load`` makes one variant's mechanism, for those that are not reckoned in arrays; only those
    that ``closes`` names are tried.
    """
    import numpy as np

    found = empty(count)
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
        and scene.sheet.ka is None
        and scene.sheet.enlarge is None
        and not (ask.curves or ask.centrodes)
        and not any(link.wheels or link.rolls for link in links)
        and not any(step.action and is_closer(step.action.value) for step in steps)
        and not mechanism.trial_rates
    )


def scaled(mechanism: Mechanism, values: Values, found: Scaling) -> Array:
    """Scale what the crank scales; the result says of which variants.

    Where triangles that may give way leave no room for a larger mechanism, they do.
    """
    import numpy as np

    size = len(found.kL)
    speed = np.broadcast_to(np.abs(mechanism.scene.drivers[0].speed.si(values, batch_kind())), size)
    turning = np.flatnonzero(np.asarray(speed, dtype=float) > 0)
    done = np.zeros(size, dtype=bool)
    part = taken(values, turning)
    kL, seconds, sure = crank_scales(mechanism, part, speed[turning], triangles=True)
    drawn = np.ones(len(turning), dtype=bool)
    if may_give_way(mechanism.program):
        less, less_seconds, less_sure = crank_scales(
            mechanism, part, speed[turning], triangles=False
        )
        sure &= less_sure
        drawn = ~(less < kL)
        kL, seconds = np.where(drawn, kL, less), np.where(drawn, seconds, less_seconds)
    done[turning[sure]] = True
    for whole, own in ((found.kL, kL), (found.seconds, seconds), (found.triangles, drawn)):
        whole[turning[sure]] = own[sure]
    return done


def crank_scales(
    mechanism: Mechanism, values: Values, speed: Array, *, triangles: bool
) -> tuple[Array, Array, Array]:
    """kL and kL/kv as the crank says them, and of which variants it does; as scaling.scales_with.

    A scale that the scene states, and that does not hold the drawing, leaves NaN.
    """
    import numpy as np

    count = len(speed)
    if not count:
        return np.zeros(0), np.zeros(0), np.zeros(0, dtype=bool)
    seconds = 1 / speed
    trials = sketches(mechanism, values, at(seconds), triangles=triangles)
    least = fitting(trials, HEIGHT)
    kL, wanted = least.copy(), mechanism.scene.sheet.scale
    if wanted is not None:
        stated = np.broadcast_to(
            np.asarray(wanted.number(values, batch_kind()), dtype=float), count
        )
        kL = np.where(stated < least * (1 - 1e-12), np.nan, stated)
    large = 1000 * np.min([trial.reach for trial in trials], axis=0) / kL >= LITTLE
    sure = large | (wanted is not None)
    seconds = enlarged(mechanism, values, kL, seconds, trials, triangles=triangles)
    return kL, seconds, sure & (np.isfinite(least) & (least > 0))


def enlarged(
    mechanism: Mechanism,
    values: Values,
    kL: Array,
    seconds: Array,
    trials: list[VariantSheet],
    *,
    triangles: bool,
) -> Array:
    """kL/kv at which short plans are drawn larger where they fit, else as given.

    As scaling.enlarged: the largest plans that do.
    """
    import numpy as np

    found = seconds.copy()
    lengths = np.array([1000 * trial.largest / kL for trial in trials])
    short = ((lengths > 0) & (lengths < SMALL)).any(axis=0)
    waiting, longest = np.flatnonzero(short), lengths.max(axis=0)
    each = (map(float, column[waiting]) for column in (kL, seconds, longest))
    ladders = [larger_plans(*one) for one in zip(*each, strict=True)]
    while len(waiting):
        larger = np.array([next(ladder, (np.nan, 1.0))[0] for ladder in ladders])
        on = np.isfinite(larger)
        waiting, larger, ladders = waiting[on], larger[on], some(ladders, on)
        if not len(waiting):
            break
        again = sketches(mechanism, taken(values, waiting), at(larger), triangles=triangles)
        fits = fitting(again, HEIGHT + HEADROOM) <= kL[waiting] * (1 + 1e-12)
        found[waiting[fits]] = larger[fits]
        waiting, ladders = waiting[~fits], some(ladders, ~fits)
    return found


def at(seconds: Array) -> dict[str, Array]:
    """The same kL/kv on every sheet."""
    return dict.fromkeys(SHEETS, seconds)


def some(every: list[Any], which: Array) -> list[Any]:
    """Those of a list that a mask names."""
    return [one for one, on in zip(every, which, strict=True) if on]


def fitting(trials: list[VariantSheet], height: float) -> Array:
    """The smallest preferred kL at which mechanism and plan stand side by side on every sheet."""
    import numpy as np

    across = np.max([t.mechanism_box.width + t.plan_box.width for t in trials], axis=0)
    beside = np.max([t.mechanism_box.width for t in trials], axis=0)
    down = np.max([np.maximum(t.mechanism_box.height, t.plan_box.height) for t in trials], axis=0)
    wide = np.maximum(across / WIDTH, beside / (WIDTH - NARROW))
    return first_preferred(1000 * np.maximum(wide, down / height))


def first_preferred(least: Array) -> Array:
    """The first preferred number not less than each; NaN for what is not above nought."""
    import numpy as np

    sound = np.isfinite(least) & (least > 0)
    return np.array(
        [next(preferred(float(n))) if ok else np.nan for n, ok in zip(least, sound, strict=True)]
    )


def one_by_one(load: Loader, index: int, found: Scaling) -> None:
    """The scale factors of one variant by its own sheet; NaN stays where it has none."""
    import numpy as np

    try:
        one = load(index)
        own = scales(one)
    except GraphkinError:
        return
    found.kL[index], found.seconds[index] = own.kL, own.seconds
    found.triangles[index], found.apart[index] = own.triangles, own.apart
    for number, rate in one.trial_rates.items():
        rates = found.rates.setdefault(number, np.full(len(found.kL), np.nan))
        rates[index] = rate


def taken(values: Values, which: Array) -> dict[str, Any]:
    """The parameters of some variants."""
    return {n: v[which] if hasattr(v, "shape") else v for n, v in values.items()}
