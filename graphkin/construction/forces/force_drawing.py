"""The material of a sheet of forces: the mechanism with its loads, polygons, and the lever."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import cached_property
from typing import Any, NamedTuple

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import constructions
from graphkin.construction.core.layout import Layout
from graphkin.construction.core.program import Part, Plane, Step
from graphkin.construction.core.quantities import RATE, MotionQuantity
from graphkin.construction.core.run import Trace
from graphkin.construction.forces.balance import BalancingMoment
from graphkin.construction.forces.force_words import sub
from graphkin.construction.forces.lever import LeverBalance
from graphkin.construction.forces.loads import ByTable, InertiaMoment, load_names, moment_name
from graphkin.construction.forces.polygon import InPolygon
from graphkin.drawing.field import Field
from graphkin.drawing.scale import Extent, extent_of
from graphkin.numbers.arithmetic import np
from graphkin.scene.forces import ByDriver


class ForceLayout(Layout, frozen=True):
    """The fields of a sheet of forces: each polygon's by its number, and the lever's."""

    polygons: Mapping[int, Field] = {}
    lever: Field | None = None


class ForceExtents(NamedTuple):
    """The box of each polygon in N, by its number, and that of the lever in m/s.

    The lever is None where there is none, or where nothing moves.
    """

    polygons: Mapping[int, Extent]
    lever: Extent | None

    @classmethod
    def of(cls, trace: Trace, around: Callable[[list[Any]], Extent] = extent_of) -> ForceExtents:
        """The boxes of a plan of forces, each ``around`` the points in it."""
        polygons: dict[int, list[Any]] = {}
        lever: list[Any] = []
        for number, value in trace.values.items():
            step = trace.program.steps[number]
            if isinstance(step.of, InPolygon) and step.plane is Plane.FORCES:
                polygons.setdefault(step.of.polygon, []).extend(own_points(value))
            elif step.plane is Plane.LEVER and not isinstance(step.of, LeverBalance):
                lever += own_points(value)
        box = around(lever)
        moves = len(lever) > 1 and np.any((box.width > 0) | (box.height > 0))
        own = {number: around(points) for number, points in polygons.items()}
        return cls(own, box if moves else None)


def own_points(value: Any) -> tuple[Any, ...]:
    """A value that is a point, or one of each variant; none for lines and arrows.

    Arrows of a polygon join points that are there.
    """
    return () if isinstance(value, tuple) else (value,)


class ForceDrawing(Drawing, frozen=True):
    """The material of a sheet of forces; ``fields`` is its ForceLayout."""

    @property
    def plane(self) -> Plane:
        """The polygons of forces."""
        return Plane.FORCES

    @property
    def unit(self) -> str:
        """The unit of the sides of its polygons."""
        return "N"

    @property
    def rate(self) -> MotionQuantity:
        """The angular acceleration, from which inertia moments follow."""
        return RATE["acceleration"]

    @property
    def pole(self) -> str:
        """The name of the lever's pole."""
        return "o"

    def turning(self, link: str) -> float | None:
        """The balancing moment or the first given moment on a link, in N·m; None without one."""
        return next(iter(self.moments.get(link, {}).values()), None)

    def turning_name(self, link: str) -> str:
        """The name of the moment on a link."""
        return next(iter(self.moments[link]))

    def turnings(self, link: str) -> Mapping[str, float]:
        """All moments on a link."""
        return self.moments.get(link, {})

    @cached_property
    def moments(self) -> Mapping[str, Mapping[str, float]]:
        """The moments on each link by their names: that of its driver, then given ones."""
        found: dict[str, dict[str, float]] = {}
        for each in constructions(self.trace.program, BalancingMoment):
            if size := each.size(self):
                found.setdefault(each.link, {})[each.name] = size
        forces, values = self.scene.forces, self.scene.values
        loads = () if forces is None else forces.loads
        for load, index in zip(loads, load_names(loads), strict=True):
            if load.moment is None:
                continue
            name = moment_name(load, index)
            size = (
                self.by_table[name]
                if isinstance(load.moment, ByDriver)
                else float(load.moment.si(values))
            )
            if size:
                found.setdefault(load.link, {})[name] = size
        for inertia in constructions(self.trace.program, InertiaMoment):
            if couple := float(self.trace.values[inertia.couple]):
                found.setdefault(inertia.link, {})["M_" + sub("i", inertia.link)] = couple
        return found

    @cached_property
    def by_table(self) -> Mapping[str, float]:
        """The loads that follow from tables, by their symbols, in N or N·m."""
        values = self.trace.values
        tables = constructions(self.trace.program, ByTable)
        return {each.name: float(values[each.number]) for each in tables}

    @cached_property
    def on_mechanism(self) -> tuple[tuple[int, Step, Any], ...]:
        """The forces and arms on the mechanism."""
        on_it = self.steps(Plane.MECHANISM)
        return tuple(drawn for drawn in on_it if drawn[1].part is Part.FORCE)

    @cached_property
    def natural(self) -> float:
        """The largest force, against which rounding is measured."""
        forces = [abs(value) for _, _, value in self.steps(Plane.FORCES) if is_point(value)]
        return max(forces, default=0.0)

    @cached_property
    def extents(self) -> ForceExtents:
        """The boxes of its polygons and of its lever."""
        return ForceExtents.of(self.trace)

    def lever_balances(self) -> Iterator[LeverBalance]:
        """The balance by the lever, if it is drawn."""
        if self.extents.lever is not None:
            for step in self.trace.program.steps:
                if isinstance(step.of, LeverBalance) and step.role == step.of.last:
                    yield step.of


def is_point(value: Any) -> bool:
    """Whether a value is a point of a plan."""
    return isinstance(value, complex)
