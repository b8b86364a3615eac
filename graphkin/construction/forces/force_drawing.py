"""The material of a sheet of forces: the mechanism with its loads, polygons, and the lever.

The tables of a sheet of forces: reactions, and the balance by polygons and by the lever.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import cached_property
from typing import Any, NamedTuple

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import constructions
from graphkin.construction.core.layout import Layout
from graphkin.construction.core.naming import sense
from graphkin.construction.core.program import Part, Plane, Step
from graphkin.construction.core.quantities import RATE, MotionQuantity, OnPaper, in_mm
from graphkin.construction.core.relation import Relation, answer, value_of
from graphkin.construction.core.run import Trace
from graphkin.construction.forces.belt_force import BeltStrand
from graphkin.construction.forces.lever import LeverBalance, LeverForce
from graphkin.construction.forces.line_force import LineForce, SlidePressure
from graphkin.construction.forces.loads import (
    ByTable,
    InertiaMoment,
    drawn_force,
    load_names,
    moment_name,
    on_lever,
    reaction_names,
    sub,
)
from graphkin.construction.forces.moments import SEEN, BalancingMoment, ForceArm
from graphkin.construction.forces.polygon import (
    ClosedByLines,
    ClosingReaction,
    InPolygon,
    side_size,
)
from graphkin.construction.forces.tooth_force import RackForce, ToothForce
from graphkin.drawing.field import Field
from graphkin.drawing.scale import Extent, extent_of
from graphkin.drawing.symbol_markup import symbol
from graphkin.numbers.arithmetic import np
from graphkin.scene.forces import ByDriver
from graphkin.text.tables import CellTable, Row


class ForceLayout(Layout, frozen=True):
    """The fields of a sheet of forces: each polygon's by its number, and the lever's."""

    polygons: Mapping[int, Field] = {}
    lever: Field | None = None

    def field(self, step: Step) -> Field:
        """The field in which a step is drawn: its polygon's, or that of the lever."""
        if step.plane is Plane.LEVER and self.lever is not None:
            return self.lever
        if step.plane is Plane.FORCES and isinstance(step.of, InPolygon):
            return self.polygons[step.of.polygon]
        return super().field(step)


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

    def in_units(self, newton: float) -> ForceExtents:
        """The same with the polygons in a unit of so many newtons."""
        return ForceExtents(
            {n: Extent(*(s / newton for s in box.sides)) for n, box in self.polygons.items()},
            self.lever,
        )


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
        return next(iter(self.moments[link]))

    def turnings(self, link: str) -> Mapping[str, float]:
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


FOUND = SlidePressure, ToothForce, RackForce, LineForce, BeltStrand
"""The kinds of reactions that other constructions than polygons give."""
ARMS = ForceArm, LineForce, SlidePressure, LeverForce
"""The kinds of constructions that have an arm of a force."""


def force_tables(drawing: Drawing, *, empty: bool) -> list[CellTable]:
    """The tables of a sheet of forces: reactions, and the balance by both routes."""
    words = drawing.words
    assert isinstance(drawing, ForceDrawing)
    rows = []
    for name, (size, _) in sorted_sides(drawing).items():
        cells = ("", "")
        if not empty:
            length = drawn_force(drawing, size)
            cells = (in_mm(words, length), value_of(words, size, length))
        rows.append(Row((symbol(name), *cells), name))
    heads = words("table.symbol"), words("table.millimetres"), words.unit("N")
    found = [CellTable(heads, rows, kind="sides")]
    if balance := balance_rows(drawing, empty=empty):
        over = words("table.balance"), words("table.by_polygon"), words("table.by_lever")
        found.append(CellTable(over[: len(balance[0].cells)], balance, kind="balance"))
    return [table for table in found if table.rows]


def arm_table(drawing: Drawing) -> CellTable:
    """The arms that moment equations use, on the mechanism and on the lever, in mm on paper."""
    words = drawing.words
    assert isinstance(drawing, ForceDrawing)
    rows = [
        Row((symbol(number), in_mm(words, length)), number) for number, length in arms_of(drawing)
    ]
    return CellTable((words("table.arm"), words("table.millimetres")), rows, kind="arms")


def arms_of(drawing: ForceDrawing) -> Iterator[tuple[str, OnPaper]]:
    """The arms that are drawn, by their symbols."""
    values = drawing.trace.values
    for number, step in enumerate(drawing.trace.program.steps):
        kind = step.of
        if step.role != "foot" or not isinstance(kind, ARMS):
            continue
        if isinstance(kind, LeverForce):
            length = on_lever(drawing, float(abs(values[number])))
        else:
            about = kind.about if isinstance(kind, ForceArm) else kind.moments.about
            length = OnPaper(drawing.on_paper(float(abs(values[number] - values[about]))))
        if length > SEEN and drawing.settled(abs(values[kind.force])):
            yield kind.number, length


def forces_asked(drawing: Drawing) -> Iterator[Relation]:
    """The reactions and the balance that the scene asks for, without how they follow."""
    forces = drawing.scene.forces
    assert isinstance(drawing, ForceDrawing) and forces is not None
    asked = {*reaction_names(drawing.scene, forces.reactions)}
    for name, (size, _) in sorted_sides(drawing).items():
        if name in asked:
            value = value_of(drawing.words, size, drawn_force(drawing, size))
            yield Relation(symbol(name), result=value, unit="N")
    for each in balances(drawing) if forces.balance else ():
        yield Relation(symbol(each.name), result=each.value, unit=each.unit, remark=each.sense)


def sorted_sides(drawing: ForceDrawing) -> dict[str, tuple[float, int]]:
    """The whole reactions and driving forces of all polygons in order: magnitude, and its step."""
    found: dict[str, tuple[float, int]] = {}
    for number, step in enumerate(drawing.trace.program.steps):
        kind = step.of
        if isinstance(kind, ClosedByLines) and step.role == "corner":
            for name, tail, tip in (
                (kind.first, kind.corner, kind.start),
                (kind.last, kind.end, kind.corner),
            ):
                if "^" not in name:
                    found[name] = side_size(drawing, tail, tip), number
        elif isinstance(kind, ClosingReaction) and step.role == "arrow":
            found[kind.name] = side_size(drawing, kind.tail, kind.tip), number
        elif isinstance(kind, FOUND) and step.role == "force" and "^" not in kind.name:
            found[kind.name] = drawing.settled(abs(drawing.trace.values[kind.force])), number
    return found


class DriverBalance(NamedTuple):
    """What balances a driver: symbol, unit, value and sense, and its value by the lever."""

    name: str
    unit: str
    value: str
    sense: str
    by_lever: str


def balances(drawing: ForceDrawing) -> Iterator[DriverBalance]:
    """The balance of each driver: by polygons, and by the lever where it is drawn."""
    levers = {each.other: each for each in drawing.lever_balances()}
    for each in constructions(drawing.trace.program, BalancingMoment):
        lever, size = levers.get(each.moment), each.size(drawing)
        other = answer(drawing, abs(lever.size(drawing))) if lever is not None else "–"
        way = sense(drawing.words, size)
        yield DriverBalance(each.name, "N·m", answer(drawing, abs(size)), way, other)
    for driver in drawing.trace.program.balances:
        if not driver.turns:
            lever = levers.get(driver.step)
            other = answer(drawing, lever.size(drawing)) if lever is not None else "–"
            force = answer(drawing, drawing.settled(abs(drawing.trace.values[driver.step])))
            yield DriverBalance(driver.name, "N", force, "", other)


def balance_rows(drawing: ForceDrawing, *, empty: bool) -> list[Row]:
    """One row for the balance of each driver; without values on a task.

    The lever has its column where there is one.
    """
    has_lever = any(True for _ in drawing.lever_balances())
    rows = []
    for each in balances(drawing):
        found = (f"{each.value} {each.sense}".strip(), *([each.by_lever] if has_lever else []))
        cells = ("",) * len(found) if empty else found
        rows.append(
            Row((f"{symbol(each.name)}, {drawing.words.unit(each.unit)}", *cells), each.name)
        )
    return rows
