"""The scale factors of the sheets of many variants, each the same as for its own sheet.

The searches of all variants run side by side; drafts that are alike are computed together, in
arrays. This works for mechanisms of pins and guides driven by one crank. Other variants go through
:func:`graphkin.documents.scaling.scales`, one by one.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from math import nan
from typing import Any

from msgspec import Struct, field

from graphkin.construction.core.component import as_drawn, may_give_way
from graphkin.construction.core.drawn_scene import takes_room
from graphkin.construction.core.program import Part, Plane, Step, Target
from graphkin.construction.core.quantities import PLANES
from graphkin.construction.core.run import Trace, run_batch
from graphkin.documents.composing import Needs, Search, Stated, searched_scales
from graphkin.documents.scaling import scales, sheet_targets, stated_of
from graphkin.drawing.scale import Extent, Scales
from graphkin.mechanism import Mechanism
from graphkin.numbers.arithmetic import batch_kind, np
from graphkin.numbers.plane import Circle, Line, Ratio, Vector
from graphkin.text.errors import GraphkinError

ON_MECHANISM = {
    "velocity": (Part.POSITION, Part.VELOCITY),
    "acceleration": (Part.POSITION, Part.NORMAL, Part.ACCELERATION),
}
"""The parts that each sheet draws on the mechanism, except centres and poles."""
Array = Any


class VariantSheet(Struct, frozen=True, dict=True):
    """The content of one sheet for many variants: the steps that it draws, and their values.

    ``seconds`` is the time of each variant by which velocities are drawn on the mechanism as
    lengths.
    """

    mechanism: Mechanism
    kind: str
    trace: Trace
    seconds: Array

    def steps(self, *planes: Plane) -> Iterator[tuple[Step, Any]]:
        """The steps of some planes with their values."""
        for number, value in self.trace.values.items():
            step = self.trace.program.steps[number]
            if step.plane in planes:
                yield step, value

    @cached_property
    def bare_box(self) -> Extent:
        """The box of the mechanism alone, in metres."""
        return boxes(list(self.positions()), len(self.seconds))

    @cached_property
    def mechanism_box(self) -> Extent:
        """The box of the mechanism and what is drawn on it, in metres."""
        points = list(self.positions())
        for step, value in self.steps(Plane.MECHANISM):
            if step.part in ON_MECHANISM[self.kind] and takes_room(step, value):
                points += ends(value)
        return boxes(points, len(self.seconds))

    @cached_property
    def plan_box(self) -> Extent:
        """The box of the plan, with its vectors as long as on the mechanism, in metres."""
        scale = self.plan_seconds
        with np.errstate(all="ignore"):  # a variant that does not close has no plan
            points = [p * scale for _, v in self.steps(PLANES[self.kind]) for p in ends(v)]
        return boxes(points, len(self.seconds))

    @property
    def plan_seconds(self) -> Array:
        """The factor that converts a value of the plan to a length of the mechanism."""
        return self.seconds if self.kind == "velocity" else self.seconds**2

    @cached_property
    def reach(self) -> Array:
        """The largest distance in the mechanism along x or y, in metres."""
        return np.maximum(self.bare_box.width, self.bare_box.height)

    @cached_property
    def largest(self) -> Array:
        """The largest vector of the plan, as long as on the mechanism, in metres."""
        vectors = [
            abs(value.tip - value.tail)
            for step, value in self.steps(PLANES[self.kind])
            if step.arrow and isinstance(value, Vector)
        ]
        longest = np.zeros(len(self.seconds))
        for vector in vectors:
            longest = np.fmax(longest, vector)
        return longest * self.plan_seconds

    def positions(self) -> Iterator[Array]:
        """The positions of the points that belong to links."""
        scene = self.mechanism.scene
        owned = {p for link in (scene.frame, *scene.links.values()) for p in link.points}
        for (quantity, of), number in self.trace.program.targets.items():
            if quantity == "position" and of in owned and number in self.trace.values:
                yield self.trace.values[number]


def ends(value: Any) -> tuple[Any, ...]:
    """The points that a drawn value occupies; lines and arcs occupy none."""
    if isinstance(value, Vector):
        return value.tail, value.tip
    if isinstance(value, Line | Circle | Ratio | tuple):
        return ()
    is_point = isinstance(value, complex) or getattr(value, "dtype", None) == "complex128"
    return (value,) if is_point else ()


def boxes(points: Sequence[Array], size: int) -> Extent:
    """The boxes around points, each an array or one for all; the origin where there are none."""
    low_x, low_y = np.full(size, np.nan), np.full(size, np.nan)
    high_x, high_y = low_x.copy(), low_y.copy()
    for point in points:
        drawn = np.isfinite(point)
        x, y = (np.where(drawn, part, np.nan) for part in (np.real(point), np.imag(point)))
        low_x, high_x = np.fmin(low_x, x), np.fmax(high_x, x)
        low_y, high_y = np.fmin(low_y, y), np.fmax(high_y, y)
    return Extent(*(np.nan_to_num(side) for side in (low_x, low_y, high_x, high_y)))


def drawn_steps(
    mechanism: Mechanism, targets: Sequence[Target], *, triangles: bool
) -> tuple[int, ...]:
    """The steps of a sheet, with or without the triangles that may be left out."""
    program = mechanism.program
    needed = program.needed(targets, by_hand=True)
    trace = Trace(program, dict.fromkeys(needed), {})
    return tuple(as_drawn(trace, triangles=triangles).values)


def sketches(
    mechanism: Mechanism,
    values: Mapping[str, Any],
    seconds: Array,
    *,
    triangles: bool,
    rates: Mapping[int, Any] | None = None,
    margins: bool = False,
) -> list[VariantSheet]:
    """The sheets of many variants, by the ``seconds`` that scale velocities on each mechanism.

    ``values`` are the scene's parameters as arrays; ``rates`` are the trial rates of auxiliary
    plans.
    """
    program = mechanism.program
    found = []
    for kind, targets in sheet_targets(mechanism).items():
        overrides = dict(rates or {})
        if program.seconds is not None:
            overrides[program.seconds] = seconds
        steps = drawn_steps(mechanism, targets, triangles=triangles)
        with np.errstate(all="ignore"):
            trace = run_batch(
                program, steps, values, batch_kind(), steps, margins=margins, overrides=overrides
            )
        found.append(VariantSheet(mechanism, kind, trace, seconds))
    return found


def needs_of(drafts: Sequence[VariantSheet]) -> list[Needs | None]:
    """The boxes of each variant's drafts, as in documents.scaling; None where they are infinite."""
    bare, whole = (
        Extent(
            *(np.min([getattr(box, side) for box in some], axis=0) for side in ("left", "bottom")),
            *(np.max([getattr(box, side) for box in some], axis=0) for side in ("right", "top")),
        )
        for some in ([d.bare_box for d in drafts], [d.mechanism_box for d in drafts])
    )
    plans = {draft.kind: rows(draft.plan_box) for draft in drafts}
    found: list[Needs | None] = []
    for i, (own, every) in enumerate(zip(rows(bare), rows(whole), strict=True)):
        longest = {draft.kind: float(draft.largest[i]) for draft in drafts}
        needs = Needs(own, every, {kind: some[i] for kind, some in plans.items()}, longest)
        sound = np.isfinite([own.diagonal, every.diagonal, *longest.values()]).all()
        found.append(needs if sound and own.diagonal else None)
    return found


def rows(box: Extent) -> list[Extent]:
    """The box of each variant."""
    columns = zip(box.left, box.bottom, box.right, box.top, strict=True)
    return [Extent(*map(float, sides)) for sides in columns]


# --- scale factors --------------------------------------------------------------------------------


Values = Mapping[str, Any]
Loader = Callable[[int], Mechanism]
"""A function that makes the mechanism of one variant, by its index in the batch."""


NOWHERE = Scales(nan, nan, nan, nan, nan)
"""The scale factors of a variant that fits no sheet."""


class Scaling(Struct):
    """The scale factors of each variant, None where nothing fits.

    ``rates`` are the trial rates of auxiliary plans: an array for each step.
    """

    own: list[Scales | None]
    rates: dict[int, Array] = field(default_factory=dict)

    def together(self, which: Iterable[int]) -> Scales:
        """The scale factors of some variants, each an array; NaN where nothing fits."""
        some, names = [self.own[i] or NOWHERE for i in which], Scales.__struct_fields__
        factors: list[Any] = [np.array([getattr(each, name) for each in some]) for name in names]
        return Scales(*factors)


def scaling(
    mechanism: Mechanism, values: Values, count: int, load: Loader, closes: Array = True
) -> Scaling:
    """The scale factors of ``count`` variants, whose parameters are arrays or shared.

    ``load`` makes the mechanism of a variant that is not computed in arrays. Variants outside
    ``closes`` are not tried one by one.
    """
    found = Scaling([None] * count)
    done = np.zeros(count, dtype=bool)
    if by_arrays(mechanism):
        done = scaled(mechanism, values, found)
    for index in np.flatnonzero(closes & ~done):
        one_by_one(load, int(index), found)
    return found


def by_arrays(mechanism: Mechanism) -> bool:
    """Whether arrays can be used: pins and guides, one driving crank, no curves."""
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
    """Find the scale factors of variants with a turning crank; the result marks these variants."""
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
    """The result of each variant's search; None where nothing fits."""
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
    """Find the scale factors of one variant by its sheet, if it has any."""
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
