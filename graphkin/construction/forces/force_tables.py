"""The tables of a sheet of forces: reactions, and the balance by polygons and by the lever."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import constructions
from graphkin.construction.core.naming import sense
from graphkin.construction.core.quantities import in_mm
from graphkin.construction.core.relation import Relation, answer, value_of
from graphkin.construction.forces.balance import BalancingMoment
from graphkin.construction.forces.force_drawing import ForceDrawing
from graphkin.construction.forces.force_words import drawn_force, reaction_names
from graphkin.construction.forces.line_force import LineForce
from graphkin.construction.forces.polygon import ClosedByLines, ClosingReaction, side_size
from graphkin.construction.forces.slide_pressure import SlidePressure
from graphkin.construction.forces.tooth_force import RackForce, ToothForce
from graphkin.drawing.symbol_markup import symbol
from graphkin.text.tables import CellTable, Row

FOUND = SlidePressure, ToothForce, RackForce, LineForce
"""The kinds of reactions that other constructions than polygons give."""


def force_tables(drawing: Drawing, *, empty: bool) -> list[CellTable]:
    """The tables of a sheet of forces: reactions, arms, and the balance by both routes."""
    words = drawing.words
    assert isinstance(drawing, ForceDrawing)
    rows = []
    for name, size in sorted_sides(drawing):
        cells = ("", "")
        if not empty:
            length = drawn_force(drawing, size)
            cells = (in_mm(words, length), value_of(words, size, length))
        rows.append(Row((symbol(name), *cells), name))
    heads = words("table.symbol"), words("table.millimetres"), "N"
    found = [CellTable(heads, rows, kind="sides")]
    if balance := balance_rows(drawing, empty=empty):
        over = words("table.balance"), words("table.by_polygon"), words("table.by_lever")
        found.append(CellTable(over[: len(balance[0].cells)], balance, kind="balance"))
    return [table for table in found if table.rows]


def forces_asked(drawing: Drawing) -> Iterator[Relation]:
    """The reactions and the balance that the scene asks for, without how they follow."""
    forces = drawing.scene.forces
    assert isinstance(drawing, ForceDrawing) and forces is not None
    asked = {*reaction_names(drawing.scene, forces.reactions)}
    for name, size in sorted_sides(drawing):
        if name in asked:
            value = value_of(drawing.words, size, drawn_force(drawing, size))
            yield Relation(symbol(name), result=value, unit="N")
    for each in balances(drawing) if forces.balance else ():
        yield Relation(symbol(each.name), result=each.value, unit=each.unit, remark=each.sense)


def sorted_sides(drawing: ForceDrawing) -> list[tuple[str, float]]:
    """The whole reactions and driving forces of all polygons with their magnitudes, in order."""
    found: dict[str, float] = {}
    for step in drawing.trace.program.steps:
        kind = step.of
        if isinstance(kind, ClosedByLines) and step.role == "corner":
            for name, tail, tip in (
                (kind.first, kind.corner, kind.start),
                (kind.last, kind.end, kind.corner),
            ):
                if "^" not in name:
                    found[name] = side_size(drawing, tail, tip)
        elif isinstance(kind, ClosingReaction) and step.role == "arrow":
            found[kind.name] = side_size(drawing, kind.tail, kind.tip)
        elif isinstance(kind, FOUND) and step.role == "force" and "^" not in kind.name:
            found[kind.name] = drawing.settled(abs(drawing.trace.values[kind.force]))
    return list(found.items())


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
        rows.append(Row((f"{symbol(each.name)}, {each.unit}", *cells), each.name))
    return rows
