"""Forces by several routes, and masses and loads at random on any mechanism."""

from __future__ import annotations

import random
from collections.abc import Iterator

from msgspec.structs import replace

from graphkin.construction.core.kind import constructions
from graphkin.construction.core.run import Trace
from graphkin.construction.core.solution import ForceSolution
from graphkin.construction.forces.lever import LeverBalance
from graphkin.construction.forces.loads import link_pair
from graphkin.construction.forces.polygon import ClosedByLines, ClosingReaction
from graphkin.documents.force_fields import traced
from graphkin.loops.equilibrium import by_equations, equilibrium
from graphkin.mechanism import Mechanism, gathered
from graphkin.scene.forces import Forces, Load, Mass
from graphkin.scene.model import Link, StrandTension
from graphkin.scene.quantity import Quantity, exact


def loaded(mechanism: Mechanism, rng: random.Random) -> Mechanism:
    """The mechanism with a mass on most links, gravity, a force and a moment.

    They are on links and points of the scene, not on those that stand for a cam.
    """
    scene = mechanism.scene
    links = {
        name: [point for point in link.points if point not in scene.cam_centres]
        for name, link in scene.links.items()
        if name not in scene.cam_links
    }
    masses = {}
    for name, points in links.items():
        if rng.random() < 0.8:
            inertia = number(rng, 0.01, 2, "kg·m²") if rng.random() < 0.8 else None
            masses[name] = Mass(number(rng, 0.1, 9, "kg"), rng.choice(points), inertia)
    on, turned = rng.choice([*links]), rng.choice([*links])
    force = number(rng, -900, 900, "N"), number(rng, -900, 900, "N")
    loads = (
        Load(on, rng.choice(links[on]), force, None),
        Load(turned, "", None, number(rng, -90, 90, "N·m")),
    )
    gravity = exact(0, "m/s²"), exact("-9.81", "m/s²")
    scene = replace(scene, links={name: taut(link, rng) for name, link in scene.links.items()})
    return Mechanism(replace(scene, forces=Forces(masses, gravity, loads, balance=True)))


def taut(link: Link, rng: random.Random) -> Link:
    """The link with a tension in the slack strand, or a ratio of tensions, of each belt."""
    rolls = []
    for each in link.rolls:
        if each.belt is not None and each.belt.tension is None:
            slack = StrandTension("slack", number(rng, 0, 400, "N"))
            ratio = StrandTension("ratio", number(rng, 1.5, 4, ""))
            tension = slack if rng.random() < 0.5 else ratio
            rolls.append(replace(each, belt=replace(each.belt, tension=tension)))
        else:
            rolls.append(each)
    return replace(link, rolls=tuple(rolls))


def number(rng: random.Random, low: float, high: float, unit: str) -> Quantity:
    """A quantity of three digits."""
    return exact(f"{rng.uniform(low, high):.3f}", unit)


def drawn(trace: Trace) -> Iterator[tuple[str, complex]]:
    """The reactions of polygons by their symbols, such as R_03."""
    values = trace.values
    for each in constructions(trace.program, ClosingReaction):
        yield each.name, values[each.force]
    for each in constructions(trace.program, ClosedByLines):
        yield each.first, values[each.start] - values[each.corner]
        yield each.last, values[each.corner] - values[each.end]


def on_links(found: ForceSolution) -> dict[str, complex]:
    """The reactions in pairs of two links by their symbols."""
    pairs: dict[str, list[tuple[str, complex]]] = {}
    for each in found.reactions:
        pairs.setdefault(each.name, []).append((each.link, each.force))
    named = {}
    for some in pairs.values():
        if len(some) == 2:
            (one, force), (other, back) = some
            named |= {f"R_{link_pair(other, one)}": force, f"R_{link_pair(one, other)}": back}
    return named


def of_equations(mechanism: Mechanism) -> ForceSolution:
    """The forces by all equations of equilibrium at once."""
    scene = mechanism.scene
    solution = gathered(mechanism.trace(), scene.links)
    motion = mechanism.check.examine(solution, numbered=0).solved.motion
    return by_equations(scene, motion, equilibrium(scene, scene.forces, motion))


def differences(mechanism: Mechanism) -> Iterator[float]:
    """How far polygons are from the equations of equilibrium, and the lever from the polygons.

    As shares of the largest force.
    """
    own, verdict = mechanism.forces()
    assert verdict.agrees and verdict.constructed
    found = of_equations(mechanism)
    trace, expected = traced(mechanism), on_links(found)
    largest = max(abs(each.force) for each in found.reactions)
    compared = [abs(force - expected[n]) for n, force in drawn(trace) if n in expected]
    assert compared
    yield from (each / largest for each in compared)
    values = trace.values
    for lever in constructions(trace.program, LeverBalance):
        balance = values[lever.force if lever.moment is None else lever.moment]
        other = next(each for each in own.balance if each.link in lever.moment_name)
        size = other.force if other.moment is None else other.moment
        yield abs(balance - size) / max(abs(size), 1e-6 * largest)
