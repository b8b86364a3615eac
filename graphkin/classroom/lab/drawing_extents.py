"""What the drawings of many variants take up, as arrays: the boxes that a sheet's scale hangs on.

The same steps as in construction.core.drawn_scene, of which each holds an array here; tests hold
the two equal.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from typing import Any

from msgspec import Struct

from graphkin.construction.core.batch import run_batch
from graphkin.construction.core.component import as_drawn
from graphkin.construction.core.drawn_scene import takes_room
from graphkin.construction.core.program import Part, Plane, Step, Target
from graphkin.construction.core.quantities import PLANES
from graphkin.construction.core.run import Trace
from graphkin.documents.composing import Needs
from graphkin.documents.scaling import sheet_targets
from graphkin.drawing.scale import Extent
from graphkin.mechanism import Mechanism
from graphkin.numbers.arithmetic import batch_kind
from graphkin.numbers.arrays import np
from graphkin.numbers.plane import Circle, Line, Ratio, Vector

ON_MECHANISM = {
    "velocity": (Part.POSITION, Part.VELOCITY),
    "acceleration": (Part.POSITION, Part.NORMAL, Part.ACCELERATION),
}
"""The parts of the work that each sheet draws on the mechanism, but centres and poles."""
Array = Any


class VariantSheet(Struct, frozen=True, dict=True):
    """The material of one sheet of many variants: the steps that it draws, and their values.

    ``seconds`` is the time of each variant in which velocities are set on the mechanism as ways.
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
        """The box of the plan once as large as its vectors on the mechanism, in metres."""
        scale = self.plan_seconds
        with np.errstate(all="ignore"):  # what does not close has no plan
            points = [p * scale for _, v in self.steps(PLANES[self.kind]) for p in ends(v)]
        return boxes(points, len(self.seconds))

    @property
    def plan_seconds(self) -> Array:
        """What makes a value of the plan a length of the mechanism."""
        return self.seconds if self.kind == "velocity" else self.seconds**2

    @cached_property
    def reach(self) -> Array:
        """The largest distance in the mechanism along x or y, in metres."""
        return np.maximum(self.bare_box.width, self.bare_box.height)

    @cached_property
    def largest(self) -> Array:
        """The largest vector of the plan as it is set on the mechanism, in metres."""
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
        """Where the points that links own stand."""
        scene = self.mechanism.scene
        owned = {p for link in (scene.frame, *scene.links.values()) for p in link.points}
        for (quantity, of), number in self.trace.program.targets.items():
            if quantity == "position" and of in owned and number in self.trace.values:
                yield self.trace.values[number]


def ends(value: Any) -> tuple[Any, ...]:
    """The points that a drawn value takes up by itself; lines and arcs take up none."""
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
    """The steps of a sheet, with or without the triangles that may give way."""
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
    """The sheets of many variants, by the ``seconds`` in which velocities are set on each as ways.

    ``values`` are the scene's parameters as arrays; ``rates`` what the hand tries.
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
    """The boxes of the drafts of each variant, as in documents.scaling; None for no number."""
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
