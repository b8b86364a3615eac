"""All equations of equilibrium at once, and virtual power: the check of reactions and balance.

Newton and Euler's equations of every moving link make one linear system for all reactions and
driving forces. Positions and motions come from the vector loops, so nothing is shared with the
construction of reactions but the scene. Units are SI.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.solution import Balance, ForceSolution, PairReaction
from graphkin.loops.equations import guide_on
from graphkin.loops.loop_motion import Motion
from graphkin.loops.rigid_bodies import Reals
from graphkin.numbers.plane import Line
from graphkin.scene.forces import ByDriver, Directed, Forces, Size
from graphkin.scene.model import FRAME, Driver, Scene, joined_words
from graphkin.structure.pairs import Contact, contacts
from graphkin.structure.touching_wheels import radius, track_line
from graphkin.structure.turning import body
from graphkin.text.errors import StructureError, joined, message

RANK = 1e-10
"""Share of the largest singular value below which a constraint counts as redundant."""
PRESSURE = math.radians(20)
"""The pressure angle of teeth: ISO 53."""
LOOSE = 1e-6
"""The share of an unknown in what no equation determines, above which it is not determined."""
LITTLE = 1e-2
"""Share of the largest possible power below which the work of loads counts as none."""
HELD = 1e-9
"""Difference, as a share of the largest force, up to which two routes agree."""


class Equilibrium(Struct, frozen=True):
    """Forces by pair and link, and by driver, from all equations at once.

    ``pairs`` holds for each (name, link) the force and its moment about the pin or the block's
    first point. ``drivers`` holds forces along guides as vectors, and moments as numbers, by the
    names of drivers.
    ``size`` (m) is the longest length, by which moments are compared with forces.
    """

    pairs: Mapping[tuple[str, str], tuple[complex, float]]
    drivers: Mapping[str, complex]
    size: float

    @property
    def largest(self) -> float:
        """The largest force of a pair, or moment per longest length, in N."""
        every = (max(abs(force), abs(m) / self.size) for force, m in self.pairs.values())
        return max(every, default=0.0)


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
        couple = 0.0 if load.moment is None else number_here(scene, load.moment)
        if load.force is None:
            yield Acting(load.link, 0j, 0j, 0j, couple)
            continue
        here = motion.point(load.at)
        place, velocity = complex(here.place[0]), complex(here.velocity[0])
        if not isinstance(load.force, Directed):
            force = complex(si(load.force[0], scene), si(load.force[1], scene))
        else:
            size, way = number_here(scene, load.force.size), load.force.sense * velocity
            angle = float(load.force.angle.si(scene.values))
            unit = way / abs(way) if way else 0j
            force = size * (unit if load.force.sense else complex(np.exp(1j * angle)))
        yield Acting(load.link, place, velocity, force, couple)
    for spring in forces.springs:
        one, other = (motion.point(end) for end in spring.ends)
        way = complex(other.place[0] - one.place[0])
        unit = way / abs(way) if way else 0j
        pull = si(spring.stiffness, scene) * (abs(way) - si(spring.free, scene)) * unit
        for link, here, force in zip(spring.links, (one, other), (pull, -pull), strict=True):
            if link != FRAME:
                place, velocity = complex(here.place[0]), complex(here.velocity[0])
                yield Acting(link, place, velocity, force, 0.0)


def number_here(scene: Scene, size: Size) -> float:
    """A given number, or one from a table of a driver's coordinate."""
    if not isinstance(size, ByDriver):
        return si(size, scene)
    knots, period = size.knots
    at = si(scene.drivers[size.driver].position, scene)
    if period:
        at = knots[0] + (at - knots[0]) % period
    return float(np.interp(at, knots, [si(each, scene) for each in size.ends]))


class Column(Struct, frozen=True):
    """One unknown of a pair or driver: a unit force at a place or a unit couple, on two links.

    ``drives`` is the name of the driver.
    """

    name: str
    links: tuple[str, str]
    place: complex
    force: complex
    couple: float
    drives: str = ""


def columns_of(scene: Scene, motion: Motion) -> Iterator[Column]:
    """The unknowns: two for each pair, one for each driver."""
    owners: dict[str, list[str]] = {}
    for link in scene.every_link:
        for point in link.points if link.name not in scene.cam_links else ():
            if point not in scene.cam_centres:
                owners.setdefault(point, []).append(link.name)
    for point, links in owners.items():
        for one, other in pairwise(links):
            for way in (1, 1j):
                yield Column(point, (other, one), pin_of(motion, point), way, 0.0)
    for name, number in guides_of(scene, motion).items():
        guide = motion.loops.guides[number]
        ends = guide.block, guide.on
        way = 1j * along_guide(motion, number)
        yield Column(name, ends, pin_of(motion, guide.point), way, 0.0)
        yield Column(name, ends, 0j, 0j, 1.0)
    for driver in scene.drivers:
        moved, ends = scene.driver_name(driver), (driver.link, driver.against)
        name = f"driver {moved}"
        if driver.kind == "turn":
            yield Column(name, ends, 0j, 0j, 1.0, drives=moved)
            continue
        number = guide_of(motion, driver)
        place = pin_of(motion, motion.loops.guides[number].point)
        yield Column(name, ends, place, along_guide(motion, number), 0.0, drives=moved)


class Touching(Struct, frozen=True):
    """Two links in contact at a place: wheels, a wheel and its track, or a cam and its follower.

    ``along`` is the unit vector of the force that the contact always carries, ``away`` the one that
    pushes the links apart. Where the distance is ``kept``, only teeth push, by their ``pressure``
    angle, on the ``side`` of the force along: +1 or -1, and 0 while it is not known.
    """

    name: str
    links: tuple[str, str]
    place: complex
    along: complex
    away: complex = 0j
    kept: bool = True
    pressure: float = 0.0
    side: int = 0

    def columns(self) -> Iterator[Column]:
        """The unknown along the line of action; also the one across, where nothing keeps it."""
        pushed = self.side * math.tan(self.pressure) if self.kept else 0.0
        yield Column(self.name, self.links, self.place, self.along + pushed * self.away, 0.0)
        if not self.kept:
            yield Column(self.name, self.links, self.place, self.away, 0.0)


def touching_of(scene: Scene, motion: Motion) -> Iterator[Touching]:
    """The contacts of wheels that touch."""
    for each in contacts(scene):
        if each.rolling.belt is not None:
            continue
        centre, track = pin_of(motion, each.wheel.centre), each.track
        if track is None:
            line = line_of(scene, motion, each)
            start, way = line.point, line.along
            place = start + ((centre - start) * way.conjugate()).real * way
            away = centre - place
        else:
            other = pin_of(motion, track.centre)
            to_wheel = (centre - other) / abs(centre - other)
            place = other + radius(scene, track) * to_wheel * (-1 if each.wheel.inside else 1)
            away = place - other if each.wheel.inside else centre - place
        away /= abs(away)
        teeth = each.wheel.teeth is not None or (track is not None and track.teeth is not None)
        name, pressure = "-".join(each.links), PRESSURE if teeth else 0.0
        kept = each.arm is not None
        yield Touching(name, each.links, place, 1j * away, away, kept, pressure)


class Strands(Struct, frozen=True):
    """The strands of a belt, left and right as seen from its wheel, and what fixes their tensions.

    ``key`` and ``number`` are those of the belt's StrandTension. ``tight`` is the place of the
    tight strand, None while it is not known.
    """

    links: tuple[str, str]
    columns: tuple[Column, Column]
    key: str
    number: float
    tight: int | None = None

    @property
    def row(self) -> tuple[float, float, float]:
        """The factors of both tensions, and what they add up to.

        While the tight strand is not known, the tensions have no sum: their difference is right.
        """
        if self.tight is None:
            return 1.0, 1.0, 0.0
        if self.key == "pretension":
            return 1.0, 1.0, 2 * self.number
        by_slack = self.key == "slack"
        factors = (0.0, 1.0) if by_slack else (1.0, -self.number)
        one, other = factors if self.tight == 0 else factors[::-1]
        return one, other, self.number if by_slack else 0.0


def belts_of(scene: Scene, motion: Motion) -> Iterator[Strands]:
    """The belts. Raises StructureError for a belt whose tension nothing states."""
    for each in contacts(scene):
        belt = each.rolling.belt
        if belt is None:
            continue
        if belt.tension is None:
            raise StructureError.at(
                "loads",
                message("the forces of the belt of {links}", links=joined_words(each.links)),
                message("slack, pretension or ratio among the keys of the belt"),
                message("equilibrium gives the difference of both strands, not their sum"),
            )
        assert each.track is not None
        centre, other = pin_of(motion, each.wheel.centre), pin_of(motion, each.track.centre)
        own, on = radius(scene, each.wheel), radius(scene, each.track)
        columns = []
        for name, side in (("left", 1), ("right", -1)):
            # the strand is square to both radii: their sum or difference is its height
            height = own + on if belt.crossed else own - on
            apart = abs(other - centre)
            long = math.sqrt(apart**2 - height**2)
            along = (other - centre) / apart * complex(long, -side * height) / apart
            place = centre + 1j * side * own * along
            named = "-".join((*each.links, name))
            columns.append(Column(named, each.links, place, along, 0.0))
        yield Strands(
            each.links, (columns[0], columns[1]), belt.tension.key, si(belt.tension.number, scene)
        )


def line_of(scene: Scene, motion: Motion, contact: Contact) -> Line:
    """The straight track of a contact in the plane."""
    on = contact.links[1]
    line, turned = track_line(scene, contact.rolling), complex(motion.heading[0, motion.index[on]])
    point = next(iter(scene.link(on).points), None)
    shift = line.point if point is None else line.point - body(scene, on)[point]
    start = complex(motion.origin.place[0, motion.index[on]])
    return Line(start + turned * shift, turned * line.along)


def cams_of(scene: Scene, motion: Motion) -> Iterator[Touching]:
    """The contacts of cams with their followers, each along the common normal.

    The follower slips along the cam as the cam moves, so the normal is square to that slip. The law
    gives the slip for a unit of the cam's motion, though the cam may be at rest against its
    carrier. Raises StructureError where nothing slips, and for a second roller, which presses as
    well.
    """
    for follower, cam in scene.cams.items():
        name, links = f"{follower}-{cam.on}", (follower, cam.on)
        tip = pin_of(motion, cam.point)
        slip, turned = slip_of(scene, motion, follower)
        if cam.conjugate is not None or not slip or (cam.is_flat and not turned):
            raise StructureError.at(
                "loads",
                message("the force of the cam of {links}", links=joined_words(links)),
                message("one roller, knife or face that slips along a moving cam"),
            )
        if not cam.is_flat:
            yield Touching(name, links, tip, 1j * slip / abs(slip))
            continue
        if cam.lever is not None:
            bar = tip - pin_of(motion, cam.lever.pin)
            normal = 1j * bar / abs(bar)
        else:
            normal = along_guide(motion, guide_on(follower, cam.carrier, motion.loops.guides))
        centre = tip + 1j * slip / turned
        yield Touching(name, links, centre, normal)


def slip_of(scene: Scene, motion: Motion, follower: str) -> tuple[complex, float]:
    """The velocity of a follower's tip and its turning against its cam, by the cam's own motion.

    That is the cam's turning against the carrier, or a plate's sliding on it, with the carrier at
    rest.
    """
    cam, guides = scene.cams[follower], motion.loops.guides
    lift = next(each for each in motion.loops.drives.lifts if each.law.follower == follower)
    tip = pin_of(motion, cam.point)
    place: Any
    if cam.slides:
        plate = guide_on(cam.on, cam.carrier, guides)
        place, under, turned = motion.slides[0, :, plate], along_guide(motion, plate), 0.0
    else:
        seen = [motion.heading[:, motion.index[link]] for link in (cam.on, cam.carrier)]
        place, under, turned = seen[0] / seen[1], 1j * (tip - pin_of(motion, cam.pivot)), 1.0
    rate = float(np.ravel(lift.law.at(place, lift.numbers, lift.start).rate)[0])
    if cam.lever is None:
        way = along_guide(motion, guide_on(follower, cam.carrier, guides))
        return rate * way - under, -turned
    return rate * 1j * (tip - pin_of(motion, cam.lever.pin)) - under, rate - turned


def guides_of(scene: Scene, motion: Motion) -> dict[str, int]:
    """The numbers of the guides of blocks, by their names; those of wheels on tracks are none."""
    sliding = {(link.name, slide.on) for link in scene.every_link for slide in link.slides}
    ends = [(guide.block, guide.on) for guide in motion.loops.guides]
    return {"-".join(pair): number for number, pair in enumerate(ends) if pair in sliding}


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
    system = System(scene, motion)
    touching = system.without_pressing([*touching_of(scene, motion), *cams_of(scene, motion)])
    columns = system.columns(touching)
    values = system.solved(forces, columns)
    if system.belts or any(each.pressure for each in touching):
        along = {c.name: v for c, v in reversed([*zip(columns, values, strict=True)])}
        columns = system.columns(
            [replace(e, side=1 if along[e.name] > 0 else -1) for e in touching]
        )
        system.tighten(along)
        values = system.solved(forces, columns)
        refuse_loose_strands(system.belts, columns, values)
    return gathered(columns, values, system.size)


def refuse_loose_strands(
    belts: Sequence[Strands], columns: Sequence[Column], values: Sequence[float]
) -> None:
    """Raise StructureError for a strand that would have to push."""
    largest = max(map(abs, values))
    found = dict(zip((each.name for each in columns), values, strict=True))
    for belt in belts:
        least = min(found[each.name] for each in belt.columns)
        if least < -HELD * largest:
            raise StructureError.at(
                "loads",
                message(
                    "the slack strand of the belt of {links} would push with {force} N",
                    links=joined_words(belt.links),
                    force=f"{-least:.4g}",
                ),
                message("a larger pretension, so that both strands pull"),
            )


class System:
    """The equations of equilibrium of the moving links, about one pin of the mechanism."""

    def __init__(self, scene: Scene, motion: Motion) -> None:
        self.scene, self.motion = scene, motion
        self.size = float(np.max(motion.loops.size))
        self.about = pin_of(motion, next(iter(scene.points)))
        self.belts = [*belts_of(scene, motion)]
        strands = (column for each in self.belts for column in each.columns)
        self.pairs = [*columns_of(scene, motion), *strands]
        links = (name for name in scene.links if name not in scene.cam_links)
        self.rows = {name: 3 * k for k, name in enumerate(links)}

    def columns(self, touching: Sequence[Touching]) -> list[Column]:
        """The unknowns of all pairs, drivers and contacts."""
        return [*self.pairs, *(column for each in touching for column in each.columns())]

    def matrix(self, columns: Sequence[Column]) -> Reals:
        """The coefficients of some unknowns; moments are parts of the longest length."""
        found = np.zeros((3 * len(self.rows) + len(self.belts), len(columns)))
        for j, column in enumerate(columns):
            turned = moment(column.place - self.about, column.force) / self.size + column.couple
            entries = np.array([complex(column.force).real, complex(column.force).imag, turned])
            for link, sign in zip(column.links, (1, -1), strict=True):
                if link != FRAME:
                    found[self.rows[link] : self.rows[link] + 3, j] += sign * entries
        places = {column.name: j for j, column in enumerate(columns)}
        for row, belt in zip(found[3 * len(self.rows) :], self.belts, strict=True):
            left, right = (places[each.name] for each in belt.columns)
            row[left], row[right], _ = belt.row
        return found

    def tighten(self, along: Mapping[str, float]) -> None:
        """Note the tight strand of each belt, by the tensions that have no sum."""
        tight = (0 if along[belt.columns[0].name] > 0 else 1 for belt in self.belts)
        self.belts = [replace(e, tight=k) for e, k in zip(self.belts, tight, strict=True)]

    def without_pressing(self, touching: list[Touching]) -> list[Touching]:
        """The contacts, without the pressing force where other pairs keep the distance as well.

        No equation determines such a force. Only teeth then push the links apart.
        """
        for k, each in enumerate(touching):
            if not each.kept:
                columns = self.columns(touching)
                j = next(j for j, c in enumerate(columns) if c.name == each.name) + 1
                if shares(self.matrix(columns))[j] > LOOSE:
                    touching = [*touching[:k], replace(each, kept=True), *touching[k + 1 :]]
        return touching

    def solved(self, forces: Forces, columns: list[Column]) -> list[float]:
        """The unknowns. Raises StructureError where the equations do not determine them."""
        matrix = self.matrix(columns)
        right = np.array([0.0] * 3 * len(self.rows) + [each.row[2] for each in self.belts])
        for each in known_forces(self.scene, forces, self.motion):
            turned = (moment(each.place - self.about, each.force) + each.couple) / self.size
            k = self.rows[each.link]
            right[k : k + 3] -= [each.force.real, each.force.imag, turned]
        refuse_undetermined(columns, matrix)
        found: list[float] = np.linalg.lstsq(matrix, right, rcond=None)[0].tolist()
        return found


def shares(matrix: Reals) -> Reals:
    """The largest share of each unknown in what no equation determines."""
    _, sines, across = np.linalg.svd(matrix)
    rank = int((sines > RANK * sines[0]).sum())
    return np.asarray(np.abs(across[rank:]).max(axis=0, initial=0.0))


def refuse_undetermined(columns: list[Column], matrix: Reals) -> None:
    """Raise StructureError for unknowns that no equation determines, with the pairs concerned."""
    free = shares(matrix)
    names = dict.fromkeys(c.name for c, each in zip(columns, free, strict=True) if each > LOOSE)
    if not names:
        return
    if len(columns) > matrix.shape[0]:
        found = message(
            "{count} redundant constraints among {names}: equilibrium does not determine reactions",
            count=len(columns)
            - int(np.linalg.matrix_rank(matrix, RANK * np.linalg.norm(matrix, 2))),
            names=joined(", ", names),
        )
        expected = message("as many unknown forces as equations")
        raise StructureError.at("loads", found, expected)
    found = message("no finite forces at {names} hold the loads here", names=joined(", ", names))
    raise StructureError.at("loads", found, message("a position away from the dead point"))


def gathered(columns: list[Column], values: list[float], size: float) -> Equilibrium:
    """The unknowns by pair and link, and by driver; couples in N·m."""
    pairs: dict[tuple[str, str], tuple[complex, float]] = {}
    drivers: dict[str, complex] = {}
    for column, value in zip(columns, values, strict=True):
        couple = float(value) * column.couple * size
        if column.drives:
            is_force = column.force != 0
            drivers[column.drives] = complex(value * column.force) if is_force else couple + 0j
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
        given = drivers[scene.driver_name(driver)]
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
    guides = guides_of(scene, motion)
    strands = (column for each in belts_of(scene, motion) for column in each.columns)
    some: list[Touching | Column] = [*touching_of(scene, motion), *cams_of(scene, motion), *strands]
    touching = {each.name: each for each in some}
    reactions = []
    for (name, link), (force, turned) in here.pairs.items():
        number = guides.get(name)
        if name in touching:
            contact = touching[name]
            reactions.append(PairReaction(name, link, force, 0.0, contact.place, contact.links[0]))
            continue
        if number is None:
            place = pin_of(motion, name)
            reactions.append(PairReaction(name, link, force, 0.0, place))
            continue
        guide, along = motion.loops.guides[number], along_guide(motion, number)
        place, normal = pin_of(motion, guide.point), moment(along, force)
        at = place + turned / normal * along if normal else None
        reactions.append(PairReaction(name, link, force, turned, at, guide.block))
    balance = []
    for driver in scene.drivers:
        name = scene.driver_name(driver)
        given = here.drivers[name]
        turns = driver.kind == "turn"
        balance.append(Balance(name, moment=given.real) if turns else Balance(name, force=given))
    return ForceSolution(tuple(reactions), tuple(balance))


def by_power_alone(scene: Scene, forces: Forces, motion: Motion, here: Equilibrium) -> ForceVerdict:
    """The verdict on forces of the equations: virtual power is their only check."""
    done = float(power(scene, forces, motion, here.drivers, here.largest))
    return ForceVerdict(0.0, "", done, constructed=False)


def compare_forces(
    scene: Scene, forces: Forces, motion: Motion, here: Equilibrium, found: ForceSolution
) -> ForceVerdict:
    """The difference of constructed reactions and balance from two independent routes."""
    largest = here.largest
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
