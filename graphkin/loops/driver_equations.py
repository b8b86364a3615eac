"""The drivers as equations: an angle, or a coordinate along a line, less its given value."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from msgspec import Struct

from graphkin.loops.cam_laws import ByLaw
from graphkin.loops.no_slip import CountedApart, OwnTurns, turned_from, waiting
from graphkin.loops.rigid_bodies import Body, Complexes, Guide, Numbers, Reals, unit
from graphkin.loops.vector_chains import Turnings
from graphkin.scene.model import Driver, Scene
from graphkin.scene.wheels import angle_less_cycles as whole_turned
from graphkin.text.errors import Problem, StructureError

if TYPE_CHECKING:
    from graphkin.numbers.cam_motions import Rise


class Lift(Struct, frozen=True, eq=False):
    """A follower whose coordinate, driver ``row``, its cam's angle gives by a ``law``.

    ``way`` (K + m,) picks the cam's angle against its carrier, or its coordinate there; ``lean``
    (N,) is the direction of its x axis where that angle is 0; the follower rests at ``start``.
    """

    row: int
    law: ByLaw
    way: Reals
    lean: Complexes
    start: Complexes
    numbers: Numbers

    def of(self, values: Reals, way: Reals | None = None) -> Reals:
        """What the cam's angle or coordinate has of values of the unknowns, those alone: (N,)."""
        own = np.flatnonzero(self.way)
        return np.asarray(values[:, own] @ (self.way if way is None else way)[own])

    def at(self, unknowns: Reals) -> Rise:
        """What the law gives at some unknowns, with its derivatives by the cam's angle."""
        place = self.of(unknowns)
        if not self.law.cam.slides:
            place = np.exp(1j * place) * self.lean
        return self.law.at(place, self.numbers, self.start)


class Drives(Struct, frozen=True, eq=False):
    """The given motions: row d of ``selects`` (D, K + m) picks the driven coordinate.

    A turning driver compares the unit vector e^{i(selected angle)}·``lean`` with ``aim``, a
    sliding one its coordinate with ``aim``; all (N, D). ``whole`` counts full turns, too, from the
    angle ``given`` (radians), ``leaning`` being the angle of ``lean``, not reduced: a wheel's place
    depends on them. Rates are in SI units. ``errors`` (3, N, D) bound what the rounding of a law of
    time adds to the given value and to its rates.
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
    errors: Reals
    lifts: tuple[Lift, ...] = ()
    bases: tuple[CountedApart, ...] = ()

    def residual(self, unknowns: Reals) -> Reals:
        """Driven coordinate less given value, angles within half a turn unless whole: (N, D)."""
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
        """The given values, those of followers by their cams: (N, D)."""
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
        """Second derivative in two directions, which laws alone have: (N, D)."""
        found = np.zeros((len(unknowns), len(self.turns)))
        for lift in self.lifts:
            found[:, lift.row] -= lift.at(unknowns).bend * lift.of(u) * lift.of(v)
        return found

    @property
    def waits(self) -> Reals:
        """The unknowns to be known before an equation tells its coordinate: (D, K + m)."""
        found = waiting(self.bases, self.selects.shape)
        for lift in self.lifts:
            found[lift.row] = abs(lift.way)
        return found

    def none(self) -> Drives:
        """No driver of them."""
        lean, leaning, aim = self.lean[:, :0], self.leaning[:, :0], self.aim[:, :0]
        given, rates = self.given[:, :0], (self.speed[:, :0], self.acceleration[:, :0])
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
    whole: bool,
) -> Drives:
    """The drivers' equations; ``whole`` counts full turns, on which places of wheels depend."""
    count = len(scene.drivers)
    selects = np.zeros((count, turned.count + len(guides)))
    lean = np.ones((numbers.count, count), dtype=np.complex128)
    aim = np.zeros((numbers.count, count), dtype=np.complex128)
    leaning, given, speed, acceleration, *errors = np.zeros((7, numbers.count, count))
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
            laws = driver.position, driver.speed, driver.acceleration
            for bound, law in zip(errors, laws, strict=True):
                bound[:, d] = numbers.error(law)
    turning = np.array([driver.kind == "turn" for driver in scene.drivers], dtype=np.bool_)
    rates = speed, acceleration, np.array(errors)
    lifts = lifts_of(scene, guides, turned, numbers)
    places = lean, leaning, aim, given
    bases = bases_of(scene, turned, own_turns, numbers)
    return Drives(selects[:, 1:], turning, *places, whole, *rates, lifts, bases)


def bases_of(
    scene: Scene, turned: Turnings, own_turns: OwnTurns, numbers: Numbers
) -> tuple[CountedApart, ...]:
    """The links that drivers turn others against, where these turn as one with further links.

    Those that a driver turns count with it.
    """
    counting = turned_from(scene, turned)
    against = [(d, each.against) for d, each in enumerate(scene.drivers) if each in counting]
    return tuple(base for d, link in against for base in own_turns.of(d, link, -1, turned, numbers))


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
    """Which slide coordinate is that of a block on a link."""
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
    """Which slide or track coordinate is driven."""
    for index, guide in enumerate(guides):
        if (guide.block, guide.on, guide.moved_by) == (driver.link, driver.against, driver.kind):
            return index
    raise StructureError(
        Problem(
            f"drivers.{number + 1}",
            f"link {driver.link} does not {driver.kind} on link {driver.against}",
            "a block and the link that carries its guide"
            if driver.kind == "slide"
            else "a wheel and the link that carries its straight track",
        )
    )
