"""The loop equations f(φ, q) = 0 of a planar mechanism, with exact derivatives, chain by chain.

The unknowns φ are the angle θ_k of every turning except the frame's (radians), then the coordinate
s_j of every slide and track (metres). The equations are the two components of every closed chain
and the slips of wheels, in metres. Each driver adds its coordinate less its given value. The first
axis of every array is the N settings of a batch.
"""

from __future__ import annotations

from collections.abc import Collection, Container, Mapping, Sequence
from functools import cached_property
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from graphkin.loops.cam_laws import ByLaw, by_law
from graphkin.loops.no_slip import (
    Chain,
    CountedApart,
    Gear,
    NoSlip,
    OwnTurns,
    Slips,
    Tree,
    Turnings,
    counted_turnings,
    gears_of,
    own_turns_of,
    packed_slips,
    refuse_unknown_lean,
    slips_of,
    standing,
    starting_angles,
    tracks_of,
    turned_from,
    turnings,
    waiting,
)
from graphkin.loops.rigid_bodies import (
    Body,
    Complexes,
    Guide,
    Numbers,
    Parallel,
    Reals,
    bodies_of,
    guides_of,
    longest,
    parallels,
    unit,
)
from graphkin.numbers.arithmetic import Point, Real
from graphkin.scene.model import FRAME, LEADING, Driver, Scene
from graphkin.scene.wheels import angle_less_cycles as whole_turned
from graphkin.text.errors import Problem, StructureError, message

if TYPE_CHECKING:
    from graphkin.numbers.cam_motions import Rise


class Lift(Struct, frozen=True, eq=False):
    """A follower whose coordinate, driver ``row``, a cam's angle gives by a ``law``.

    ``way`` (K + m,) selects the cam's angle relative to its carrier, or its coordinate there.
    ``lean`` (N,) is the direction of the cam's x axis where that angle is 0. ``start`` is the
    follower's rest.
    """

    row: int
    law: ByLaw
    way: Reals
    lean: Complexes
    start: Complexes
    numbers: Numbers

    def of(self, values: Reals, way: Reals | None = None) -> Reals:
        """The cam's angle or coordinate in values of the unknowns: (N,)."""
        own = np.flatnonzero(self.way)
        return np.asarray(values[:, own] @ (self.way if way is None else way)[own])

    def at(self, unknowns: Reals) -> Rise:
        """The value of the law at some unknowns, with its derivatives by the cam's angle."""
        place = self.of(unknowns)
        if not self.law.cam.slides:
            place = np.exp(1j * place) * self.lean
        return self.law.at(place, self.numbers, self.start)

    def third(self, unknowns: Reals) -> Reals:
        """The third derivative of the law by the cam's angle or coordinate: (N,)."""
        from graphkin.numbers.dual_numbers import Dual, rate_of

        place = self.of(unknowns)
        if self.law.cam.slides:
            moved = Dual(place, np.ones_like(place))
        else:
            turn = np.exp(1j * place) * self.lean
            moved = Dual(turn, 1j * turn)
        return np.asarray(rate_of(self.law.at(moved, self.numbers, self.start).bend))


class Drives(Struct, frozen=True, eq=False):
    """The given motions: row d of ``selects`` (D, K + m) selects the driven coordinate.

    A turning driver compares the unit vector e^{i(selected angle)}·``lean`` with ``aim``; a sliding
    one compares its coordinate with ``aim``. All have shape (N, D). ``whole`` counts full turns,
    too, from the angle ``given`` (radians), because the position of a wheel depends on them.
    ``leaning`` is then the angle of ``lean``, not reduced. Rates are in SI units. ``errors`` (4, N,
    D) bound the rounding of a law of time, in the given value and in its rates.
    """

    selects: Reals
    turns: np.ndarray[Any, np.dtype[np.bool_]]
    lean: Complexes
    leaning: Reals
    aim: Complexes
    given: Reals
    whole: bool
    speed: Reals
    acceleration: Reals
    jerk: Reals
    errors: Reals
    lifts: tuple[Lift, ...] = ()
    bases: tuple[CountedApart, ...] = ()

    def residual(self, unknowns: Reals) -> Reals:
        """Driven coordinates less given values; angles within half a turn unless whole: (N, D)."""
        coordinate = unknowns @ self.selects.T
        aim, given = self.aimed(unknowns)
        angle = np.angle(np.exp(1j * coordinate) * self.lean * aim.conj())
        if self.whole:
            turned = coordinate + self.leaning - given - angle
            for base in self.bases:
                turned[:, base.row] -= base.excess(unknowns)
            angle = angle + 2 * np.pi * np.rint(turned / (2 * np.pi))
        return np.where(self.turns, angle, coordinate - aim.real)

    def aimed(self, unknowns: Reals) -> tuple[Complexes, Reals]:
        """The given values, with those of followers from their cams: (N, D)."""
        if not self.lifts:
            return self.aim, self.given
        shape = len(unknowns), len(self.turns)
        aim = np.array(np.broadcast_to(self.aim, shape))
        given = np.array(np.broadcast_to(self.given, shape))
        for lift in self.lifts:
            aim[:, lift.row] = lift.at(unknowns).at
            given[:, lift.row] = np.angle(aim[:, lift.row])
        return aim, given

    def rows(self, unknowns: Reals) -> Reals:
        """Derivative of the residual: (N, D, K + m)."""
        if not self.lifts and len(unknowns) == 1:
            return self.selects[None]
        rows = np.broadcast_to(self.selects, (len(unknowns), *self.selects.shape))
        if not self.lifts:
            return rows
        rows = np.array(rows)
        for lift in self.lifts:
            rows[:, lift.row] -= np.asarray(lift.at(unknowns).rate)[:, None] * lift.way
        return rows

    def second(self, unknowns: Reals, u: Reals, v: Reals) -> Reals:
        """Second derivative of the residual in two directions, nonzero only for laws: (N, D)."""
        found = np.zeros((len(unknowns), len(self.turns)))
        for lift in self.lifts:
            found[:, lift.row] -= lift.at(unknowns).bend * lift.of(u) * lift.of(v)
        return found

    def third(self, unknowns: Reals, u: Reals) -> Reals:
        """Third derivative of the residual in one direction, nonzero only for laws: (N, D)."""
        found = np.zeros((len(unknowns), len(self.turns)))
        for lift in self.lifts:
            found[:, lift.row] -= lift.third(unknowns) * lift.of(u) ** 3
        return found

    @property
    def waits(self) -> Reals:
        """The unknowns known before an equation determines its coordinate: (D, K + m)."""
        found = waiting(self.bases, self.selects.shape)
        for lift in self.lifts:
            found[lift.row] = abs(lift.way)
        return found

    def none(self) -> Drives:
        """The same structure without drivers."""
        lean, leaning, aim = self.lean[:, :0], self.leaning[:, :0], self.aim[:, :0]
        given, rates = (
            self.given[:, :0],
            (self.speed[:, :0], self.acceleration[:, :0], self.jerk[:, :0]),
        )
        left = lean, leaning, aim, given
        none = self.selects[:0], self.turns[:0], *left, self.whole, *rates
        return Drives(*none, self.errors[:, :, :0])


def drives_of(
    scene: Scene,
    bodies: Mapping[str, Body],
    guides: Sequence[Guide],
    turned: Turnings,
    numbers: Numbers,
    own_turns: OwnTurns,
    known: Mapping[str, int],
    whole: bool,
) -> Drives:
    """The drivers' equations; ``whole`` counts full turns, on which positions of wheels depend."""
    count = len(scene.drivers)
    selects = np.zeros((count, turned.count + len(guides)))
    lean = np.ones((numbers.count, count), dtype=np.complex128)
    aim = np.zeros((numbers.count, count), dtype=np.complex128)
    leaning, given, speed, acceleration, jerk, *errors = np.zeros((9, numbers.count, count))
    for d, driver in enumerate(scene.drivers):
        if driver.kind == "turn":
            selects[d, turned.of[driver.link]] += 1
            selects[d, turned.of[driver.against]] -= 1
            line = driven_line(driver, bodies)
            leans = turned.lean[driver.link] / turned.lean[driver.against]
            lean[:, d] = line * leans
            turned_by = turned.angle[driver.link] - turned.angle[driver.against]
            leaning[:, d] = np.angle(line) + turned_by
            if not isinstance(driver.position, ByLaw):
                aim[:, d] = numbers.direction(driver.position)
                given[:, d] = numbers.si(whole_turned(scene, driver))
        else:
            selects[d, turned.count + driven_slide(d, driver, guides)] = 1
            if not isinstance(driver.position, ByLaw):
                aim[:, d] = numbers.si(driver.position)
        speed[:, d] = numbers.si(driver.speed)
        acceleration[:, d] = numbers.si(driver.acceleration)
        if not isinstance(driver.position, ByLaw):
            jerk[:, d] = numbers.si(driver.jerk)
            laws = driver.position, driver.speed, driver.acceleration, driver.jerk
            for bound, law in zip(errors, laws, strict=True):
                bound[:, d] = numbers.error(law)
    turning = np.array([driver.kind == "turn" for driver in scene.drivers], dtype=np.bool_)
    rates = speed, acceleration, jerk, np.array(errors)
    lifts = lifts_of(scene, guides, turned, numbers)
    places = lean, leaning, aim, given
    bases = bases_of(scene, turned, own_turns, numbers, known)
    return Drives(selects[:, 1:], turning, *places, whole, *rates, lifts, bases)


def bases_of(
    scene: Scene, turned: Turnings, own_turns: OwnTurns, numbers: Numbers, known: Mapping[str, int]
) -> tuple[CountedApart, ...]:
    """The links that drivers turn others from, where these turn as one with further links.

    Links that a driver turns are counted with the driver.
    """
    found = list[CountedApart]()
    for d, base in turned_from(scene, turned, known).items():
        weight = 1 if base == scene.drivers[d].link else -1
        found += own_turns.of(d, base, weight, turned, numbers)
    return tuple(found)


def lifts_of(
    scene: Scene, guides: Sequence[Guide], turned: Turnings, numbers: Numbers
) -> tuple[Lift, ...]:
    """The followers that cams lift, by the numbers of their drivers."""
    found = []
    for d, driver in enumerate(scene.drivers):
        law = driver.position
        if isinstance(law, ByLaw):
            cam, carrier = law.cam.on, law.cam.carrier
            way = np.zeros(turned.count + len(guides))
            if law.cam.slides:
                way[turned.count + guide_on(cam, carrier, guides)] = 1
            else:
                way[turned.of[cam]] += 1
                way[turned.of[carrier]] -= 1
            seen = turned.lean[cam] / turned.lean[carrier]
            lean, start = (numbers.complexes(z) for z in (seen, law.start(numbers)))
            found.append(Lift(d, law, way[1:], lean, start, numbers))
    return tuple(found)


def guide_on(block: str, on: str, guides: Sequence[Guide]) -> int:
    """The number of the slide coordinate of a block on a link."""
    ends = (block, on)
    return next(
        number
        for number, guide in enumerate(guides)
        if (guide.block, guide.on) == ends and guide.moved_by == "slide"
    )


def driven_line(driver: Driver, bodies: Mapping[str, Body]) -> Any:
    """Direction of the line whose angle is driven, in the link's axes."""
    if driver.of is None:
        return 1 + 0j
    start, end = (bodies[driver.link][name] for name in driver.of)
    return unit(end - start)


def driven_slide(number: int, driver: Driver, guides: Sequence[Guide]) -> int:
    """The number of the driven slide or track coordinate. Raises StructureError if none."""
    for index, guide in enumerate(guides):
        if (guide.block, guide.on, guide.moved_by) == (driver.link, driver.against, driver.kind):
            return index
    raise StructureError.at(
        f"drivers.{number + 1}",
        message(
            "link {link} does not {kind} on link {against}",
            link=driver.link,
            kind=driver.kind,
            against=driver.against,
        ),
        message("a block and the link that carries its guide")
        if driver.kind == "slide"
        else message("a wheel and the link that carries its straight track"),
    )


# --- the loop equations f(φ, q) = 0 ---------------------------------------------------------------


class Linear(Struct, frozen=True, eq=False):
    """The vectors of all chains in one position, separated by the unknown that moves them.

    ``turned`` (N, R, K) is the part of each chain that turns with θ_k. ``along`` (N, R, m) is its
    derivative by s_j. ``place`` (N, R) is its end, and ``unknowns`` (N, K + m) are those of the
    position.
    """

    place: Complexes
    turned: Complexes
    along: Complexes
    unknowns: Reals


class Chains(Struct, frozen=True, eq=False):
    """Many chains as arrays: ``fixed`` (N, R, K + 1) by turning, ``slid`` (R, m) by slide.

    ``guide`` (N, m) holds the slide directions in their turning ``carrier`` (m,).
    """

    fixed: Complexes
    slid: Reals
    guide: Complexes
    carrier: np.ndarray[Any, np.dtype[np.intp]]

    def at(self, unknowns: Reals) -> Linear:
        """Evaluate every chain at unknowns of shape (N, K + m)."""
        angles, slides = self.split(unknowns)
        turn = np.exp(1j * angles)
        along = self.slid * (self.guide * turn[:, self.carrier])[:, None, :]
        turned = self.fixed * turn[:, None, :]
        for j, k in enumerate(self.carrier):
            turned[:, :, k] += along[:, :, j] * slides[:, None, j]
        return Linear(turned.sum(axis=-1), turned[:, :, 1:], along, unknowns)

    def split(self, unknowns: Reals) -> tuple[Reals, Reals]:
        """Angles of all turnings, with the frame's zero first, and slide coordinates."""
        moving = self.fixed.shape[-1] - 1
        frame = np.zeros((*unknowns.shape[:-1], 1))
        return np.concatenate([frame, unknowns[..., :moving]], axis=-1), unknowns[..., moving:]

    def second(self, linear: Linear, u: Reals, v: Reals) -> Complexes:
        """Second derivative of every chain in two directions of the unknowns: shape (N, R).

        Vectors that turn contribute -θ̇_u θ̇_v times themselves. A slide on a turning guide
        contributes i(ṡ_u θ̇_v + ṡ_v θ̇_u) along itself; for u = v this is the Coriolis term.
        """
        (turn_u, slide_u), (turn_v, slide_v) = self.split(u), self.split(v)
        centripetal = linear.turned @ (turn_u * turn_v)[:, 1:, None]
        mixed = slide_u * turn_v[:, self.carrier] + slide_v * turn_u[:, self.carrier]
        return (1j * (linear.along @ mixed[:, :, None]) - centripetal)[:, :, 0]

    def third(self, linear: Linear, u: Reals) -> Complexes:
        """Third derivative of every chain, three times in one direction of the unknowns: (N, R).

        Vectors that turn contribute -iθ̇³ times themselves, slides -3ṡθ̇² along themselves.
        """
        turn, slide = self.split(u)
        mixed = 3 * slide * turn[:, self.carrier] ** 2
        swung = linear.turned @ turn[:, 1:, None] ** 3
        return (-1j * swung - linear.along @ mixed[:, :, None])[:, :, 0]


def packed(rows: Sequence[Chain], tree: Tree, numbers: Numbers) -> Chains:
    """Chains as arrays."""
    turned, guides = tree.turned, tree.guides
    fixed = np.zeros((numbers.count, len(rows), turned.count), dtype=np.complex128)
    slid = np.zeros((len(rows), len(guides)))
    guide = np.zeros((numbers.count, len(guides)), dtype=np.complex128)
    for r, row in enumerate(rows):
        for k, vector in row.fixed.items():
            fixed[:, r, k] = vector
        for j, count in row.slid.items():
            slid[r, j] = count
    for j, line in enumerate(guides):
        guide[:, j] = turned.lean[line.on] * line.along
    carrier = np.array([turned.of[line.on] for line in guides], dtype=np.intp)
    return Chains(fixed, slid, guide, carrier)


Flags = np.ndarray[Any, np.dtype[np.bool_]]
Indices = np.ndarray[Any, np.dtype[np.intp]]

Bar = tuple[str, str, Complexes]
"""A bar by its ends and as a vector (N,) in the axes of its turning."""

UNIT = 4 * 2.0**-52
"""Largest residual, as a share of its terms, of an equation computed correctly in doubles."""

CANCELLED = 2.0**-48
"""Length, as a share of the mechanism's, that rounding may leave of bars that cancel."""


class Parts(Struct, frozen=True, eq=False):
    """The parts of a scene's loops, independent of the drivers: bodies, guides and wheels."""

    numbers: Numbers
    bodies: Mapping[str, Body]
    starts: Mapping[str, Point]
    gears: tuple[Gear, ...]
    guides: tuple[Guide, ...]
    parallel: tuple[Parallel, ...]
    turned: Turnings
    slips: tuple[NoSlip, ...]
    near: Mapping[str, Real]


class Equations(Struct, frozen=True, eq=False, dict=True):
    """The vector loops of a scene: chains to every link's origin, and the chains that close.

    ``bodies`` hold each link's points relative to its origin. ``owners`` gives the first link of
    each of the ``points`` and the point's local coordinates (N, points). ``closing`` names the
    joint that each closed chain closes. ``home`` (N,) is the frame's first point, and ``size`` (N,)
    the longest bar in metres. ``known`` numbers the groups of links in the order in which they
    become known, as far as whole turns depend on it; ``doubtful`` means that they do.
    """

    scene: Scene
    parts: Parts
    numbers: Numbers
    links: tuple[str, ...]
    points: tuple[str, ...]
    owners: tuple[list[int], Complexes]
    bodies: Mapping[str, Body]
    guides: tuple[Guide, ...]
    turned: Turnings
    gears: tuple[Gear, ...]
    chains: Chains
    closing: tuple[str, ...]
    slips: Slips
    drives: Drives
    home: Complexes
    size: Reals
    known: Mapping[str, int]
    doubtful: bool

    @property
    def turning_count(self) -> int:
        """The number of unknown angles."""
        return int(self.turned.count) - 1

    @property
    def unknown_count(self) -> int:
        """The number of unknowns."""
        return self.turning_count + len(self.guides)

    @property
    def equation_count(self) -> int:
        """The number of equations: two per closed chain, one per row of no slip or driver."""
        return 2 * len(self.closing) + len(self.slips.links) + len(self.drives.turns)

    @cached_property
    def around(self) -> Reals:
        """The length of each closed chain without its slides (m): (N, closed chains).

        A chain whose bars cancel, but for rounding, has the length of the mechanism.
        """
        length = abs(self.chains.fixed[:, len(self.links) :]).sum(axis=2)
        return np.where(length > CANCELLED * self.size[:, None], length, self.size[:, None])

    @cached_property
    def columns(self) -> Reals:
        """The size of each unknown: a radian, or (m) the shortest closed chain with the slide."""
        passed = abs(self.chains.slid[len(self.links) :]) > 0
        metres = np.where(passed, self.around[:, :, None], np.inf).min(axis=1, initial=np.inf)
        metres = np.where(np.isfinite(metres), metres, self.size[:, None])
        return np.concatenate([np.ones((len(self.size), self.turning_count)), metres], axis=1)

    @cached_property
    def rows(self) -> Reals:
        """The size of each equation: of its chain, its wheels or its driven unknown."""
        wheels = abs(self.slips.rows[:, :, : self.turning_count]).max(axis=2, initial=0)
        wheels = np.where(wheels > 0, wheels, self.size[:, None])
        driven = np.where(self.drives.turns, 1, self.columns @ abs(self.drives.selects).T)
        return np.concatenate([self.around, self.around, wheels, driven], axis=1)

    @cached_property
    def turning_of_link(self) -> Indices:
        """The turning of each link (links,)."""
        return np.array([self.turned.of[link] for link in self.links], dtype=np.intp)

    @cached_property
    def leans(self) -> Complexes:
        """The lean of each link relative to its turning, as unit vectors: (N, links)."""
        return self.numbers.columns([self.turned.lean[link] for link in self.links])

    @cached_property
    def link_index(self) -> dict[str, int]:
        return {link: number for number, link in enumerate(self.links)}

    @cached_property
    def point_index(self) -> dict[str, int]:
        return {name: number for number, name in enumerate(self.points)}

    @cached_property
    def longest_bars(self) -> dict[int, Bar]:
        """The longest bar of each turning."""
        return self.bars_among(self.points)

    def bars_among(self, known: Container[str]) -> dict[int, Bar]:
        """The longest bar of each turning between two known points."""
        found: dict[int, tuple[float, Bar]] = {}
        for link, body in self.bodies.items():
            k, names = self.turned.of[link], [name for name in body if name in known]
            places = self.numbers.columns([body[name] for name in names])
            for n in range(len(names) - 1):
                bars = places[:, n + 1 :] - places[:, n : n + 1]
                lengths = np.fmax.reduce(abs(bars), axis=0)
                far = int(np.argmax(np.where(np.isnan(lengths), 0.0, lengths)))
                if lengths[far] > (found[k][0] if k in found else 0.0):
                    way = bars[:, far] * self.turned.lean[link]
                    found[k] = float(lengths[far]), (names[n], names[n + 1 + far], way)
        return {k: bar for k, (_, bar) in found.items()}

    @cached_property
    def owners_of(self) -> dict[str, list[str]]:
        """The links that have each point."""
        found: dict[str, list[str]] = {}
        for link, body in self.bodies.items():
            for point in body:
                found.setdefault(point, []).append(link)
        return found

    @cached_property
    def carries(self) -> Flags:
        """Which links, then points, each turning carries: (K + 1, links + points)."""
        found = np.zeros((self.turned.count, len(self.links) + len(self.points)), dtype=np.bool_)
        for link, body in self.bodies.items():
            k = self.turned.of[link]
            found[k, self.link_index[link]] = True
            found[k, [len(self.links) + self.point_index[point] for point in body]] = True
        return found

    @cached_property
    def magnitudes(self) -> Reals:
        """Magnitudes of the vectors of the chains, then of those to every point.

        The shape is (N, R + points, K + 1 + m). The columns are the turnings, without sliding
        parts, then 1 for each slide in the chain.
        """
        owners, arms = self.owners
        turned, along = np.abs(self.chains.fixed), np.abs(self.chains.slid)
        reaching = turned[:, owners]
        for p, owner in enumerate(owners):
            reaching[:, p, self.turning_of_link[owner]] += np.abs(arms[:, p])
        turned = np.concatenate([turned, reaching], axis=1)
        passed = np.concatenate([along, along[owners]])
        passed = np.broadcast_to(passed, (self.numbers.count, *passed.shape))
        return np.concatenate([turned, passed], axis=2)

    @cached_property
    def turned_by(self) -> Indices:
        """The turning of every turning, itself, then of every slide: (K + 1 + m,)."""
        return np.concatenate([np.arange(self.turned.count), self.chains.carrier])

    @cached_property
    def twice(self) -> Reals:
        """1 for every turning, 2 for every slide, whose direction also turns: (K + 1 + m,)."""
        return np.repeat([1.0, 2.0], [self.turned.count, len(self.guides)])

    @cached_property
    def linear_sizes(self) -> Reals:
        """Magnitudes of the coefficients of the linear equations (N, R + D, K + m)."""
        return np.abs(self.linear_rows)

    @cached_property
    def whole_turns(self) -> Reals:
        """The rounding of constants in the linear equations (N, R + D).

        Angles are counted from a start or from a quarter turn, and a law of time rounds its value.
        """
        drives = np.where(self.drives.turns, UNIT, 0.0) + self.drives.errors[0]
        return np.concatenate([UNIT * np.abs(self.slips.constant), drives], axis=1)

    def closures(self, rows: Reals | Complexes) -> Reals:
        """Two real equations from each closed chain among the rows (the second axis)."""
        closed = rows[:, len(self.links) :]
        return np.concatenate([closed.real, closed.imag], axis=1)

    def residual(self, linear: Linear, unknowns: Reals) -> Reals:
        """f(φ, q): shape (N, 2·closed chains + R + D)."""
        return np.concatenate([self.closures(linear.place), self.linear(unknowns)], axis=1)

    def linear(self, unknowns: Reals) -> Reals:
        """The equations linear in the unknowns, those of no slip and of drivers: (N, R + D)."""
        slipped = self.slips.residual(unknowns)
        return np.concatenate([slipped, self.drives.residual(unknowns)], axis=1)

    @cached_property
    def linear_rows(self) -> Reals:
        """Derivative of the linear equations: shape (N, R + D, K + m).

        For a follower that a cam lifts, it is the derivative by the follower's own coordinate.
        """
        shape = (self.numbers.count, *self.drives.selects.shape)
        return np.concatenate(
            [self.slips.rows, np.broadcast_to(self.drives.selects, shape)], axis=1
        )

    def jacobian(self, linear: Linear, driven: bool = True) -> Reals:
        """∂f/∂φ: shape (N, equations, K + m), with or without the drivers' rows."""
        rows = np.concatenate([1j * linear.turned, linear.along], axis=-1)
        closed, slips = self.closures(rows), self.slips.rows
        if len(slips) != len(closed):
            slips = np.broadcast_to(slips, (len(closed), *slips.shape[1:]))
        own = [self.drives.rows(linear.unknowns)] if driven else []
        return np.concatenate([closed, slips, *own], axis=1)

    def scaled_jacobian(self, linear: Linear) -> Reals:
        """The Jacobian with each equation and unknown divided by its own size."""
        return self.jacobian(linear) * self.columns[:, None, :] / self.rows[:, :, None]

    def second(self, linear: Linear, u: Reals, v: Reals) -> Reals:
        """Second derivative of f in two directions; linear equations contribute nothing."""
        closed = self.closures(self.chains.second(linear, u, v))
        slips = np.zeros((len(closed), len(self.slips.links)))
        return np.concatenate([closed, slips, self.drives.second(linear.unknowns, u, v)], axis=1)

    def third(self, linear: Linear, u: Reals) -> Reals:
        """Third derivative of f in one direction; linear equations contribute nothing."""
        closed = self.closures(self.chains.third(linear, u))
        slips = np.zeros((len(closed), len(self.slips.links)))
        return np.concatenate([closed, slips, self.drives.third(linear.unknowns, u)], axis=1)

    def guide_index(self, block: str) -> int | None:
        """The first slide or track of a link, or None."""
        for index, guide in enumerate(self.guides):
            if guide.block == block and guide.first:
                return index
        return None


def parts_of(scene: Scene, values: Mapping[str, Any] | None = None) -> Parts:
    """The parts of a scene's loops in numbers. Raises as ``equations`` does."""
    numbers = Numbers.of({**scene.values, **(values or {})})
    bodies, starts = bodies_of(scene, numbers)
    gears, arms = gears_of(scene, bodies, numbers)
    bodies |= arms
    slides = guides_of(scene, bodies, starts, numbers)
    parallel = tuple(parallels(bodies))
    turned = turnings(tuple(bodies), slides, parallel)
    refuse_unknown_lean(turned, slides)
    guides, rolled = tracks_of(scene, bodies, starts, slides, turned, numbers)
    slips = slips_of(gears, rolled, guides, numbers)
    near = starting_angles(scene, slips, numbers)
    return Parts(numbers, bodies, starts, gears, guides, parallel, turned, slips, near)


def equations(
    scene: Scene,
    values: Mapping[str, Any] | None = None,
    within: Collection[str] | None = None,
    known: Mapping[str, int] = MappingProxyType({}),
) -> Equations:
    """Write the loop equations of a scene, for its own parameter values or for a batch of them.

    ``within`` restricts them to some links, with the joints and drivers among these. ``known``
    numbers the groups of links, where whole turns depend on which becomes known first. Raises
    StructureError for links that nothing joins, wheels that do not touch, and a block whose angle
    on a further guide is not stated.
    """
    scene = by_law(scene)
    return joined(scene, parts_of(scene, values), within, known)


def joined(
    scene: Scene, parts: Parts, within: Collection[str] | None, known: Mapping[str, int]
) -> Equations:
    """The equations of a scene's parts: of all links, or of those ``within``."""
    numbers, every, written, near = parts.numbers, parts.slips, scene, parts.near
    bodies, gears, guides, turned = parts.bodies, parts.gears, parts.guides, parts.turned
    own_turns = own_turns_of(written, every, turned, near, known)
    slips = every
    if within is not None:
        names = {FRAME, *within}
        bodies = {name: body for name, body in bodies.items() if name in names}
        guides = tuple(guide for guide in guides if {guide.block, guide.on} <= names)
        gears = tuple(gear for gear in gears if {*gear.links, gear.arm} <= names)
        slips = tuple(slip for slip in slips if names.issuperset(slip.links))
        scene = replace(
            scene, drivers=tuple(d for d in scene.drivers if names.issuperset(tied_by(d)))
        )
        turned = turnings(tuple(bodies), guides, parts.parallel)
    tree = Tree(bodies, guides, turned)
    links = tuple(bodies)
    refuse_loose(links, tree)
    closing = tree.closures()
    chains = packed([*(tree.origins[name] for name in links), *closing.values()], tree, numbers)
    turned = standing(turned, near, numbers)
    counted = counted_turnings(written, every, turned, numbers, known)
    owner = {point: link for link in reversed(links) for point in bodies[link]}
    reach = numbers.columns([bodies[link][point] for point, link in owner.items()])
    return Equations(
        scene=scene,
        parts=parts,
        numbers=numbers,
        links=links,
        points=tuple(owner),
        owners=([links.index(link) for link in owner.values()], reach),
        bodies=bodies,
        guides=guides,
        turned=turned,
        gears=gears,
        chains=chains,
        closing=tuple(closing),
        slips=packed_slips(slips, counted, own_turns, turned, guides, numbers),
        drives=drives_of(scene, bodies, guides, turned, numbers, own_turns, known, bool(every)),
        home=numbers.complexes(parts.starts[FRAME]),
        size=longest(scene, bodies, numbers),
        known=known,
        doubtful=own_turns.doubtful,
    )


def part_of(
    loops: Equations, links: Collection[str], values: Mapping[str, Any] | None = None
) -> Equations:
    """The equations within some links, for the same parameter values or for one setting of them."""
    if values is None or loops.numbers.single:
        return joined(loops.scene, loops.parts, links, loops.known)
    return equations(loops.scene, values, links, loops.known)


def tied_by(driver: Driver) -> tuple[str, ...]:
    """The links that a driver ties: the driven link, its reference, and a lifting cam."""
    law = driver.position
    cams = (law.cam.on, law.cam.carrier) if isinstance(law, ByLaw) else ()
    return (driver.link, driver.against, *cams)


def undriven(loops: Equations) -> Equations:
    """The equations without those of the drivers."""
    return replace(loops, drives=loops.drives.none())


def refuse_loose(links: Sequence[str], tree: Tree) -> None:
    """Raise StructureError if a link is not connected to the frame by pins and guides."""
    loose = [name for name in links if name not in tree.origins]
    if loose:
        raise StructureError(
            Problem(
                f"links.{name}",
                message("no pin, guide or track joins this link to the frame"),
                message("a point shared with another link, {leading}", leading=LEADING),
            )
            for name in loose
        )
