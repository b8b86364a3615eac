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
from graphkin.construction.core.component import TriangleChoice, as_drawn
from graphkin.construction.core.program import Part, Plane, Step, Target
from graphkin.construction.core.quantities import PLANES, SHEETS
from graphkin.construction.core.run import Trace
from graphkin.documents.scaling import targets_of
from graphkin.mechanism import Mechanism
from graphkin.numbers.arithmetic import batch_kind
from graphkin.numbers.plane import Circle, Line, Ratio, Vector

ON_MECHANISM = {
    "velocity": (Part.POSITION, Part.VELOCITY),
    "acceleration": (Part.POSITION, Part.NORMAL, Part.ACCELERATION),
}
"""The parts of the work that each sheet draws on the mechanism, but centres and poles."""
Array = Any


class Boxes(Struct, frozen=True):
    """The upright boxes around points, one for each variant; what is not drawn does not count."""

    left: Array
    bottom: Array
    right: Array
    top: Array

    @property
    def width(self) -> Array:
        """From left to right."""
        return self.right - self.left

    @property
    def height(self) -> Array:
        """From bottom to top."""
        return self.top - self.bottom


class VariantSheet(Struct, frozen=True, dict=True):
    """The material of one sheet of many variants: the steps that it draws, and their values.

    ``seconds`` is the pace of each variant, at which velocities are set on the mechanism.
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
    def mechanism_box(self) -> Boxes:
        """The box of the mechanism and what is drawn on it, in metres."""
        points = list(self.positions())
        for step, value in self.steps(Plane.MECHANISM):
            if step.part in ON_MECHANISM[self.kind] and (step.name or isinstance(value, Vector)):
                points += ends(value)
        return boxes(points, len(self.seconds))

    @cached_property
    def plan_box(self) -> Boxes:
        """The box of the plan at the mechanism's scale, in metres."""
        scale = self.plan_seconds
        points = [p * scale for _, v in self.steps(PLANES[self.kind]) for p in ends(v)]
        return boxes(points, len(self.seconds))

    @property
    def plan_seconds(self) -> Array:
        """What makes a value of the plan a length of the mechanism."""
        return self.seconds if self.kind == "velocity" else self.seconds**2

    @cached_property
    def reach(self) -> Array:
        """The largest distance in the mechanism along x or y, in metres."""
        import numpy as np

        box = boxes(list(self.positions()), len(self.seconds))
        return np.maximum(box.width, box.height)

    @cached_property
    def largest(self) -> Array:
        """The largest vector of the plan at the mechanism's scale, in metres."""
        import numpy as np

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


def boxes(points: Sequence[Array], size: int) -> Boxes:
    """The boxes around points, each an array or one for all; the origin where there are none."""
    import numpy as np

    low_x, low_y = np.full(size, np.nan), np.full(size, np.nan)
    high_x, high_y = low_x.copy(), low_y.copy()
    for point in points:
        drawn = np.isfinite(point)
        x, y = (np.where(drawn, part, np.nan) for part in (np.real(point), np.imag(point)))
        low_x, high_x = np.fmin(low_x, x), np.fmax(high_x, x)
        low_y, high_y = np.fmin(low_y, y), np.fmax(high_y, y)
    return Boxes(*(np.nan_to_num(side) for side in (low_x, low_y, high_x, high_y)))


def sheet_targets(mechanism: Mechanism) -> dict[str, tuple[Target, ...]]:
    """What is drawn on each sheet; everything on both where nothing is asked."""
    asked = {kind: targets_of(mechanism, kind) for kind in SHEETS}
    if not any(asked.values()):
        return dict.fromkeys(SHEETS, mechanism.program.answers)
    return {kind: found for kind, found in asked.items() if found}


def drawn_steps(
    mechanism: Mechanism, targets: Sequence[Target], *, triangles: bool, apart: bool
) -> tuple[int, ...]:
    """The steps of a sheet, with or without the triangles that may give way.

    ``apart``: ka is stated by itself, and no right triangle holds either.
    """
    program = mechanism.program
    needed = program.needed(targets, by_hand=True)
    trace = Trace(program, dict.fromkeys(needed), {})
    return tuple(as_drawn(trace, TriangleChoice(triangles, float(apart))).values)


def sketches(
    mechanism: Mechanism,
    values: Mapping[str, Any],
    paces: Mapping[str, Array],
    *,
    triangles: bool,
    apart: bool = False,
    rates: Mapping[int, Any] | None = None,
    margins: bool = False,
) -> list[VariantSheet]:
    """The sheets of many variants, by ``paces`` the seconds in which each draws velocities as ways.

    ``values`` are the scene's parameters as arrays; ``rates`` what the hand tries in trial plans.
    """
    import numpy as np

    program = mechanism.program
    found = []
    for kind, targets in sheet_targets(mechanism).items():
        seconds = paces[kind]
        overrides = dict(rates or {})
        if program.seconds is not None:
            overrides[program.seconds] = seconds
        steps = drawn_steps(mechanism, targets, triangles=triangles, apart=apart)
        with np.errstate(all="ignore"):
            trace = run_batch(
                program, steps, values, batch_kind(), steps, margins=margins, overrides=overrides
            )
        found.append(VariantSheet(mechanism, kind, trace, seconds))
    return found
