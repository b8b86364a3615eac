"""Reactions and balance as JSON and as text, in the units of their mechanism.

Counter-clockwise is positive.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from graphkin.cli.report.solution_record import Record, pair, real
from graphkin.construction.reactions import ForceSolution, PairReaction, by_name
from graphkin.loops.equilibrium import ForceVerdict
from graphkin.scene.forces import Forces
from graphkin.scene.model import FRAME
from graphkin.text.tables import Cell, cleaned, table


def force_record(forces: Forces, found: ForceSolution, verdict: ForceVerdict) -> Record:
    """The reactions and the balance that [ask] asks, and the difference of the other routes."""
    reactions: Record = {}
    for name in forces.reactions:
        for pair_name, some in by_name(found, name).items():
            reactions[pair_name] = {each.link: reaction_record(each) for each in some}
    record: Record = {"reactions": reactions} if forces.reactions else {}
    if forces.balance:
        record["balance"] = {
            each.link: {"moment": real(each.moment)}
            if each.force is None
            else {"force": pair(each.force)}
            for each in found.balance
        }
    return {**record, "force_witness": witness_of_forces(verdict)}


def witness_of_forces(verdict: ForceVerdict) -> Record:
    """The differences from the equations of equilibrium and from zero power."""
    return {
        "agrees": verdict.agrees,
        "largest_difference": real(verdict.largest_difference) if verdict.constructed else None,
        "quantity": verdict.quantity,
        "power": real(verdict.power),
    }


def reaction_record(each: PairReaction) -> dict[str, Any]:
    """The force on one link, with the place and moment of a guide's reaction."""
    found: dict[str, Any] = {"force": pair(each.force)}
    if each.block is not None:
        found |= {"moment": real(each.moment), "at": pair(each.at)}
    return found


def force_lines(found: Record, unit: Callable[[str], str]) -> list[str]:
    """The record in aligned tables, each table after an empty line, with the names of units."""
    force, turning = unit("N"), unit("N·m")
    lines: list[str] = []
    rows: list[list[Cell]] = []
    forces = [e["force"] for on in found.get("reactions", {}).values() for e in on.values()]
    biggest = max((abs(complex(*force)) for force in forces), default=0.0)
    for name, on in found.get("reactions", {}).items():
        for link, each in on.items():
            x, y = (cleaned(part, biggest) for part in each["force"])
            size = abs(complex(x, y))
            rows.append(
                [name, "frame" if link == FRAME else link, x, y, size, moment_of(each, biggest)]
            )
    if rows:
        heads = ["reaction", "on link", *(f"{each}, {force}" for each in ("Fx", "Fy", "F"))]
        heads.append(f"moment, {turning}")
        lines += ["", *table(heads, rows)]
    for name, each in found.get("balance", {}).items():
        link = name.replace("-", " against ")
        if "moment" in each:
            lines += ["", f"balance  moment on link {link}: {each['moment']:.6g} {turning}"]
        else:
            x, y = each["force"]
            along = f"{abs(complex(x, y)):.6g} {force} along the guide"
            lines += ["", f"balance  force on link {link}: ({x:.6g}, {y:.6g}) {force}, {along}"]
    return [*lines, "", f"forces   {force_verdict_words(found['force_witness'])}"]


def moment_of(each: dict[str, Any], biggest: float) -> float | None:
    """The moment of a guide's reaction; zero where it is noise of the largest force."""
    moment = each.get("moment")
    return None if moment is None else cleaned(moment, biggest)


def force_verdict_words(witness: Record) -> str:
    """How far the equations of equilibrium and virtual power are from the construction."""
    said = "agrees" if witness["agrees"] else "DIFFERS"
    if witness["largest_difference"] is None:
        power = abs(witness["power"])
        return f"by all equations of equilibrium; {said} with virtual power to {power:.1e}"
    return (
        f"{said} with all equations of equilibrium to {witness['largest_difference']:.1e} "
        f"({witness['quantity']}) and with virtual power to {abs(witness['power']):.1e}"
    )
