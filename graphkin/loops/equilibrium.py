"""All equations of equilibrium at once, and virtual power: the check of reactions and balance.

Newton and Euler's equations of every moving link make one linear system for all reactions and
driving forces. Positions and motions come from the vector loops, so nothing is shared with the
construction of reactions but the scene. Units are SI.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import pairwise
from typing import Any

import numpy as np
from msgspec import Struct

from graphkin.construction.reactions import Balance, ForceSolution, PairReaction
from graphkin.loops.loop_motion import Motion
from graphkin.loops.rigid_bodies import Reals
from graphkin.scene.forces import Forces
from graphkin.scene.model import FRAME, Driver, Scene
from graphkin.text.errors import Problem, StructureError, joined, message

RANK = 1e-10
"""Share of the largest singular value below which a constraint counts as redundant."""
LITTLE = 1e-3
"""Share of the largest possible power below which the work of loads counts as none."""
HELD = 1e-9
"""Difference, as a share of the largest force, up to which two routes agree."""


class Equilibrium(Struct, frozen=True):
    """Forces by pair and link, and by driver, from all equations at once.

    ``pairs`` holds for each (name, link) the force and its moment about the pin or the block's
    first point. ``drivers`` holds forces along guides as vectors, and moments as numbers, by link.
    ``size`` (m) is the longest length, by which moments are compared with forces.
    """

    pairs: Mapping[tuple[str, str], tuple[complex, float]]
    drivers: Mapping[str, complex]
    size: float


class ForceVerdict(Struct, frozen=True):
    """How far the construction of forces is from the equations of equilibrium and from zero power.

    ``largest_difference`` is a share of the largest force, or of the largest force times the
    longest arm for moments. ``power`` is the sum of all powers per sum of their magnitudes.
    Forces that are not ``constructed`` are those of the equations; only their power is a check.
    """

    largest_difference: float
    quantity: str
    power: float
    constructed: bool = True

    @property
    def agrees(self) -> bool:
        """Whether both differences are rounding."""
        return self.largest_difference <= HELD and abs(self.power) <= HELD


def si(quantity: Any, scene: Scene) -> float:
    return float(quantity.si(scene.values))


def pin_of(motion: Motion, name: str) -> complex:
    return complex(motion.place(name)[0])


class Acting(Struct, frozen=True):
    """One known force on a link at a point with its velocity, and a couple."""

    link: str
    place: complex
    velocity: complex
    force: complex
    couple: float


def known_forces(scene: Scene, forces: Forces, motion: Motion) -> Iterator[Acting]:
    """Weights, inertia forces and loads, from the motion of the loops."""
    gravity = forces.gravity
    falls = 0j if gravity is None else complex(si(gravity[0], scene), si(gravity[1], scene))
    for link, each in forces.masses.items():
        here, mass = motion.point(each.centre), si(each.mass, scene)
        turned = motion.epsilon[0, motion.index[link]]
        spun = 0.0 if each.inertia is None else -si(each.inertia, scene) * float(turned)
        force = mass * (falls - complex(here.acceleration[0]))
        yield Acting(link, complex(here.place[0]), complex(here.velocity[0]), force, spun)
    for load in forces.loads:
        couple = 0.0 if load.moment is None else si(load.moment, scene)
        if load.force is None:
            yield Acting(load.link, 0j, 0j, 0j, couple)
            continue
        here = motion.point(load.at)
        force = complex(si(load.force[0], scene), si(load.force[1], scene))
        yield Acting(load.link, complex(here.place[0]), complex(here.velocity[0]), force, couple)


class Column(Struct, frozen=True):
    """One unknown of a pair or driver: a unit force at a place or a unit couple, on two links."""

    name: str
    links: tuple[str, str]
    place: complex
    force: complex
    couple: float
    drives: bool = False


def columns_of(scene: Scene, motion: Motion) -> Iterator[Column]:
    """The unknowns: two for each pair, one for each driver."""
    owners: dict[str, list[str]] = {}
    for link in scene.every_link:
        for point in link.points:
            owners.setdefault(point, []).append(link.name)
    for point, links in owners.items():
        for one, other in pairwise(links):
            for way in (1, 1j):
                yield Column(point, (other, one), pin_of(motion, point), way, 0.0)
    for number, guide in enumerate(motion.loops.guides):
        ends, name = (guide.block, guide.on), f"{guide.block}-{guide.on}"
        way = 1j * along_guide(motion, number)
        yield Column(name, ends, pin_of(motion, guide.point), way, 0.0)
        yield Column(name, ends, 0j, 0j, 1.0)
    for driver in scene.drivers:
        name, ends = f"driver {driver.link}", (driver.link, driver.against)
        if driver.kind == "turn":
            yield Column(name, ends, 0j, 0j, 1.0, drives=True)
            continue
        number = guide_of(motion, driver)
        place = pin_of(motion, motion.loops.guides[number].point)
        yield Column(name, ends, place, along_guide(motion, number), 0.0, drives=True)


def guide_of(motion: Motion, driver: Driver) -> int:
    """The number of the guide along which a driver moves its block."""
    ends = [(guide.block, guide.on) for guide in motion.loops.guides]
    return ends.index((driver.link, driver.against))


def along_guide(motion: Motion, number: int) -> complex:
    """The unit vector along a guide."""
    guide = motion.loops.guides[number]
    return complex(motion.heading[0, motion.index[guide.on]] * np.ravel(guide.along)[0])


def moment(place: complex, force: complex) -> float:
    return (place.conjugate() * force).imag


def equilibrium(scene: Scene, forces: Forces, motion: Motion) -> Equilibrium:
    """All reactions and driving forces, from all equations of equilibrium.

    Raises StructureError where the equations do not determine them: by redundant constraints, or
    in a singular position.
    """
    if any(link.rolls or link.cam is not None for link in scene.every_link):
        found = message("reactions of wheels and cams")
        raise StructureError(Problem("loads", found, message("a mechanism of pins and slides")))
    columns, size = [*columns_of(scene, motion)], float(np.max(motion.loops.size))
    rows = {name: 3 * k for k, name in enumerate(scene.links)}
    matrix, right = np.zeros((3 * len(rows), len(columns))), np.zeros(3 * len(rows))
    first = pin_of(motion, next(iter(scene.points)))
    for j, column in enumerate(columns):
        turned = moment(column.place - first, column.force) / size + column.couple
        entries = np.array([complex(column.force).real, complex(column.force).imag, turned])
        for link, sign in zip(column.links, (1, -1), strict=True):
            if link != FRAME:
                matrix[rows[link] : rows[link] + 3, j] += sign * entries
    for each in known_forces(scene, forces, motion):
        turned = (moment(each.place - first, each.force) + each.couple) / size
        k = rows[each.link]
        right[k : k + 3] -= [each.force.real, each.force.imag, turned]
    refuse_undetermined(columns, matrix)
    values = np.linalg.lstsq(matrix, right, rcond=None)[0]
    return gathered(columns, values.tolist(), size)


def refuse_undetermined(columns: list[Column], matrix: Reals) -> None:
    """Raise StructureError for unknowns that no equation determines, with the pairs concerned."""
    _, sines, across = np.linalg.svd(matrix)
    rank = int((sines > RANK * sines[0]).sum())
    if rank == len(columns):
        return
    free = np.abs(across[rank:]).max(axis=0)
    names = dict.fromkeys(c.name for c, share in zip(columns, free, strict=True) if share > 1e-6)
    if len(columns) > matrix.shape[0]:
        found = message(
            "{count} redundant constraints among {names}: equilibrium does not determine reactions",
            count=len(columns) - rank,
            names=joined(", ", names),
        )
        expected = message("as many unknown forces as equations")
        raise StructureError(Problem("loads", found, expected))
    found = message("no finite forces at {names} hold the loads here", names=joined(", ", names))
    raise StructureError(Problem("loads", found, message("a position away from the dead point")))


def gathered(columns: list[Column], values: list[float], size: float) -> Equilibrium:
    """The unknowns by pair and link, and by driver; couples in N·m."""
    pairs: dict[tuple[str, str], tuple[complex, float]] = {}
    drivers: dict[str, complex] = {}
    for column, value in zip(columns, values, strict=True):
        couple = float(value) * column.couple * size
        if column.drives:
            is_force = column.force != 0
            drivers[column.links[0]] = complex(value * column.force) if is_force else couple + 0j
            continue
        for link, sign in zip(column.links, (1, -1), strict=True):
            force, turned = pairs.get((column.name, link), (0j, 0.0))
            pairs[column.name, link] = force + sign * value * column.force, turned + sign * couple
    return Equilibrium(pairs, drivers, size)


def power(
    scene: Scene,
    forces: Forces,
    motion: Motion,
    drivers: Mapping[str, complex | float],
    largest: float,
) -> float:
    """Σ F·v + Σ M·ω of all loads, inertia and driving forces, per sum of the magnitudes.

    Where loads do next to no work, it is a share of what the largest force could do.
    """
    terms = []
    for each in known_forces(scene, forces, motion):
        omega = float(motion.omega[0, motion.index[each.link]])
        terms += [(each.force.conjugate() * each.velocity).real, each.couple * omega]
    for driver in scene.drivers:
        given = drivers[driver.link]
        if driver.kind == "turn":
            one, other = (motion.omega[0, motion.index[e]] for e in (driver.link, driver.against))
            terms.append(complex(given).real * float(one - other))
            continue
        number = guide_of(motion, driver)
        rate = complex(motion.slides[1, 0, number]) * along_guide(motion, number)
        terms.append((complex(given).conjugate() * rate).real)
    turning = float(np.max(np.abs(motion.omega), initial=0.0)) * float(np.max(motion.loops.size))
    sliding = float(np.max(np.abs(motion.slides[1]), initial=0.0))
    whole = max(sum(map(abs, terms)), LITTLE * largest * max(turning, sliding))
    return sum(terms) / whole if whole else 0.0


def by_equations(scene: Scene, motion: Motion, here: Equilibrium) -> ForceSolution:
    """The reactions and balances of the equations, for groups without a construction."""
    guides = {f"{guide.block}-{guide.on}": k for k, guide in enumerate(motion.loops.guides)}
    reactions = []
    for (name, link), (force, turned) in here.pairs.items():
        number = guides.get(name)
        if number is None:
            place = pin_of(motion, name)
            reactions.append(PairReaction(name, link, force, 0.0, place))
            continue
        guide, along = motion.loops.guides[number], along_guide(motion, number)
        place, normal = pin_of(motion, guide.point), moment(along, force)
        at = place + turned / normal * along if normal else None
        reactions.append(PairReaction(name, link, force, turned, at, guide.block))
    balance = [
        Balance(driver.link, moment=here.drivers[driver.link].real)
        if driver.kind == "turn"
        else Balance(driver.link, force=here.drivers[driver.link])
        for driver in scene.drivers
    ]
    return ForceSolution(tuple(reactions), tuple(balance))


def by_power_alone(scene: Scene, forces: Forces, motion: Motion, here: Equilibrium) -> ForceVerdict:
    """The verdict on forces of the equations: virtual power is their only check."""
    largest = max([abs(force) for force, _ in here.pairs.values()], default=0.0)
    done = float(power(scene, forces, motion, here.drivers, largest))
    return ForceVerdict(0.0, "", done, constructed=False)


def compare_forces(
    scene: Scene, forces: Forces, motion: Motion, here: Equilibrium, found: ForceSolution
) -> ForceVerdict:
    """The difference of constructed reactions and balance from two independent routes."""
    largest = max([abs(force) for force, _ in here.pairs.values()], default=0.0)
    largest = max([largest, *(abs(m) / here.size for _, m in here.pairs.values())])
    for balance in found.balance:
        value = abs(here.drivers[balance.link])
        largest = max(largest, value if balance.moment is None else value / here.size)
    off: dict[str, float] = {}
    own = {(each.name, each.link): each for each in found.reactions}
    for (name, link), (force, turned) in here.pairs.items():
        each = own.get((name, link))
        missed = np.inf if each is None else abs(each.force - force)
        by_arm = 0.0 if each is None else abs(each.moment - turned) / here.size
        off[f"reaction {name} on {link}"] = max(missed, by_arm)
    drivers: dict[str, complex | float] = {}
    for balance in found.balance:
        is_force = balance.moment is None
        given = balance.force if is_force else balance.moment
        assert given is not None
        drivers[balance.link] = given
        missed = abs(given - here.drivers[balance.link])
        off[f"balance {balance.link}"] = missed if is_force else missed / here.size
    worst = max(off, key=lambda name: off[name])
    difference = float(off[worst] / largest) if largest else float(off[worst])
    return ForceVerdict(difference, worst, float(power(scene, forces, motion, drivers, largest)))
