"""Reactions in pairs and balancing forces, read off the plan of forces.

All values are in SI units; moments are counter-clockwise positive.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from msgspec import Struct

from graphkin.construction.core.program import PairForce, Program
from graphkin.construction.core.run import StepFailed, Trace, Values, run
from graphkin.numbers.arithmetic import FLOAT
from graphkin.numbers.plane import cross
from graphkin.text.errors import StructureError, message


class PairReaction(Struct, frozen=True):
    """The force on a link in a pin or guide, and its moment about the pin or the block's point.

    ``name`` is the pin's point, or the block or wheel with the link on which it slides or rolls,
    such as 5-0.
    ``block`` is that block or wheel, None for a pin. ``at`` is a point on the line of the force;
    None where a guide carries a couple alone.
    """

    name: str
    link: str
    force: complex
    moment: float
    at: complex | None
    block: str | None = None


class Balance(Struct, frozen=True):
    """The force (N) or the moment (N·m) of a driver on its link that keeps the given motion.

    ``link`` is the driver's name: the driven link, or 1-2 where several drivers move link 1.
    """

    link: str
    force: complex | None = None
    moment: float | None = None


class ForceSolution(Struct, frozen=True):
    """Every reaction, and the balance of each driver.

    In a pin of several links each entry is the force on one link from all others there.
    """

    reactions: tuple[PairReaction, ...]
    balance: tuple[Balance, ...]


def reactions_of(program: Program, values: Values, motion: Trace) -> ForceSolution:
    """The reactions and balances of a plan of forces with the values of its scene.

    ``motion`` is a trace of the same values; its steps are not run again. Raises StructureError
    where two lines of a polygon do not cross.
    """
    own = [n for each in program.reactions for n in each.steps]
    own += [each.step for each in program.balances]
    try:
        trace = run(program, program.behind(own), values, FLOAT, begun=motion)
    except StepFailed:
        found = message("a polygon of forces does not close")
        expected = message("a position away from the dead point")
        raise StructureError.at("loads", found, expected) from None
    balance = []
    for each in program.balances:
        value = each.sense * trace.values[each.step]
        balance.append(
            Balance(each.driver, moment=float(value))
            if each.turns
            else Balance(each.driver, force=complex(value))
        )
    return ForceSolution(tuple(listed_reactions(trace)), tuple(reversed(balance)))


def listed_reactions(trace: Trace) -> Iterator[PairReaction]:
    """The reactions by pair and link, with the place of those of guides and contacts."""
    values = trace.values
    sums: dict[tuple[str, str], tuple[PairForce, complex, float]] = {}
    for each in trace.program.reactions:
        force = complex(values[each.force])
        turned = 0.0
        if each.about is not None:
            turned = float(cross(values[each.place] - values[each.about], force))
            turned += 0.0 if each.couple is None else float(values[each.couple])
        for link, sign in zip(each.links, (1, -1), strict=True):
            _, before, moment = sums.get((each.name, link), (each, 0j, 0.0))
            sums[each.name, link] = each, before + sign * force, moment + sign * turned
    for (name, link), (each, force, moment) in sums.items():
        place = complex(values[each.place])
        if each.about is not None and not force:
            yield PairReaction(name, link, force, moment, None, each.block)
            continue
        yield PairReaction(name, link, force, moment, place, each.block)


def by_name(found: ForceSolution, name: str) -> Mapping[str, tuple[PairReaction, ...]]:
    """The reactions that a name asks for: a pin, or all guides and contacts of a link."""
    some: dict[str, tuple[PairReaction, ...]] = {}
    for each in found.reactions:
        if name == (each.block or each.name):
            some[each.name] = (*some.get(each.name, ()), each)
    return some
