"""Forces in fifty digits from a scene alone: Newton and Euler's equations with multipliers.

Every pair and driver is an equation between the poses of its links. The poses close by Newton's
method; rates follow from differences of the equations along the motion. The gradient of an equation
times its multiplier is the force in the pair (Lagrange), so no arm, polygon or unit vector of a
reaction is written down. Only wheels need one: they push along their line of action.

Of the program it uses the numbers of the scene, and six digits of a position as a first guess.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from itertools import accumulate, pairwise, product
from typing import Any

import mpmath
from mpmath import mp

from graphkin.mechanism import Mechanism
from graphkin.numbers.kinds import kind_of_context
from graphkin.scene.forces import ByDriver, Components, Directed, Size
from graphkin.scene.model import (
    FRAME,
    Angled,
    Apart,
    At,
    Cam,
    Driver,
    Link,
    OnLine,
    Placing,
    Polar,
    Rolling,
    Scene,
    Slide,
    Triangle,
    Wheel,
)
from graphkin.scene.quantity import Quantity
from graphkin.structure.pairs import Contact, contacts
from tests.chance.lifts import lifted, raised

DIGITS = 140
"""Digits that are carried; differences of the step below leave more than fifty."""
STEP = "1e-32"
SETTLED = "1e-100"
"""A Newton step, in metres and radians, below which a position is closed."""
PRESSURE = 20
"""The pressure angle of teeth in degrees, ISO 53."""

Poses = Mapping[str, tuple[Any, Any, Any]]
"""The origin (m) and the angle (radians) of each link's axes."""


class UnsupportedError(Exception):
    """A pair whose equation is not written here."""


@dataclass
class Equation:
    """What vanishes between the poses of some links at a time, and whose force its gradient is.

    ``push`` replaces the gradient where the force is not along it: a place and a direction of the
    force on the first link, the opposite acting on the second. ``pulls`` are those of both strands
    of a belt, whose ``rule`` fixes their tensions; the multiplier is their difference.
    """

    name: str
    links: tuple[str, ...]
    miss: Callable[[Poses, Any], Any]
    drives: str = ""
    about: tuple[str, str] | None = None
    push: Callable[[Poses], tuple[Any, Any]] | None = None
    teeth: bool = False
    pulls: Callable[[Poses], Iterator[tuple[Any, Any]]] | None = None
    rule: tuple[str, Any] = ("", 0)

    def tensions(self, side: Any, times: Any = 1) -> tuple[Any, Any]:
        """What the left and the right strand carry for each unit of their difference.

        ``side`` is 1 where the left one is tight, -1 where the right one is, 0 for the mean.
        """
        key, number = self.rule
        if key == "pretension" or not side:
            return times / mp.mpf(2), -times / mp.mpf(2)
        tight, slack = (1, 0) if key == "slack" else (number / (number - 1), 1 / (number - 1))
        return (times * tight, times * slack) if side > 0 else (-times * slack, -times * tight)

    @property
    def before(self) -> Any:
        """What both strands carry without a difference."""
        return mp.mpf(0) if self.rule[0] == "ratio" else self.rule[1]


@dataclass
class ExactForces:
    """Forces and moments by pair and link, forces or moments by driver, and the motion."""

    pairs: dict[tuple[str, str], tuple[Any, Any]] = field(default_factory=dict)
    drivers: dict[str, Any] = field(default_factory=dict)
    points: dict[str, tuple[Any, Any, Any]] = field(default_factory=dict)


class Exact:
    """A scene as equations in decimals. Use it within ``mpmath.workdps(DIGITS)``."""

    def __init__(self, mechanism: Mechanism) -> None:
        self.scene: Scene = mechanism.scene
        scene = self.scene
        self.kind = kind_of_context(mp)
        self.values = scene.values_in(self.kind)
        own = [each for each in scene.every_link if each.name not in scene.cam_links]
        self.local = {each.name: self.placed(each) for each in own}
        self.moving = [name for name in scene.links if name not in scene.cam_links]
        self.first = self.guess(mechanism)
        self.equations = [*self.pins(), *self.slides(), *self.wheels()]
        self.equations += [*self.lifts(), *self.driven()]

    # --- numbers of the scene ------------------------------------------------------------------

    def si(self, quantity: Quantity) -> Any:
        return mp.mpf(quantity.si(self.values, self.kind))

    def placed(self, link: Link) -> dict[str, Any]:
        """The points of a link in its own axes."""
        found: dict[str, Any] = {}
        for placing in link.placings:
            found[placing.point] = self.place(placing, found)
        for point in link.points:
            found.setdefault(point, mp.mpc(0))
        return {name: z for name, z in found.items() if name not in self.scene.cam_centres}

    def place(self, placing: Placing, found: Mapping[str, Any]) -> Any:
        """One point from those before it."""

        def at(name: str) -> Any:
            return found.get(name, mp.mpc(0))

        match placing:
            case At(_, x, y):
                return mp.mpc(self.si(x), self.si(y))
            case Polar(_, start, length, angle):
                return at(start) + self.si(length) * mp.expj(self.si(angle))
            case Apart(_, start, length):
                return at(start) + self.si(length)
            case Triangle(_, first, second, near, far, side):
                base, near, far = at(second) - at(first), self.si(near), self.si(far)
                x = (near**2 - far**2 + abs(base) ** 2) / (2 * abs(base))
                return at(first) + mp.mpc(x, side * mp.sqrt(near**2 - x**2)) * base / abs(base)
            case OnLine(_, first, second, start, length, sense):
                base = at(second) - at(first)
                return at(start) + sense * self.si(length) * base / abs(base)
            case Angled(_, vertex, arm, length, angle):
                base = at(arm) - at(vertex)
                return at(vertex) + self.si(length) * mp.expj(self.si(angle)) * base / abs(base)
        raise UnsupportedError(type(placing).__name__)

    def guess(self, mechanism: Mechanism) -> dict[str, tuple[Any, Any, Any]]:
        """The poses of the program's answer, to six digits."""
        motion = mechanism.check.examine(mechanism.solve(), numbered=0).solved.motion
        found: dict[str, tuple[Any, Any, Any]] = {FRAME: (mp.mpf(0),) * 3}
        for name in self.moving:
            k = motion.index[name]
            point, own = next(iter(self.local[name].items()))
            axis = mp.mpc(complex(motion.heading[0, k]))
            origin = mp.mpc(complex(motion.place(point)[0])) - axis * own
            found[name] = tuple(mp.mpf(f"{x:.6e}") for x in (*parts(origin), mp.arg(axis)))
        return found

    # --- equations -----------------------------------------------------------------------------

    def point(self, poses: Poses, link: str, local: Any) -> Any:
        """A place of a link's axes in the plane."""
        x, y, angle = poses[link]
        return mp.mpc(x, y) + mp.expj(angle) * local

    def named(self, poses: Poses, link: str, point: str) -> Any:
        return self.point(poses, link, self.local[link][point])

    def pins(self) -> Iterator[Equation]:
        """A point of two links is in one place."""
        owners: dict[str, list[str]] = {}
        for link, points in self.local.items():
            for name in points:
                owners.setdefault(name, []).append(link)
        for name, links in owners.items():
            for one, other in pairwise(links):

                def gap(poses: Poses, time: Any, ends=(one, other, name)) -> Any:
                    first, second, point = ends
                    return self.named(poses, second, point) - self.named(poses, first, point)

                for part in (lambda z: z.real, lambda z: z.imag):
                    miss = lambda p, t, gap=gap, part=part: part(gap(p, t))  # noqa: E731
                    yield Equation(name, (other, one), miss, about=(other, name))

    def line(self, on: str, path: Slide | Rolling) -> tuple[Any, Any]:
        """The start and the direction of a guide or track in the axes of its link."""
        if isinstance(path, Slide) and path.along is not None:
            start, end = (self.local[on][point] for point in path.along)
            return start, (end - start) / abs(end - start)
        along = mp.mpf(1) if path.angle is None else mp.expj(self.si(path.angle))
        match path.through:
            case None:
                return mp.mpc(0), along
            case str(name):
                return self.local[on][name], along
            case (x, y):
                return mp.mpc(self.si(x), self.si(y)), along

    def seen(self, poses: Poses, on: str, line: tuple[Any, Any], place: Any) -> Any:
        """A place as seen from a line of a link: along it, and to its left."""
        start, along = line
        turned = mp.expj(poses[on][2]) * along
        return (place - self.point(poses, on, start)) * mp.conj(turned)

    def slides(self) -> Iterator[Equation]:
        """The first point of a block keeps its distance from the guide, its x axis the angle."""
        for name in self.moving:
            link = self.scene.links[name]
            for slide in link.slides:
                yield from self.sliding(link, slide)

    def sliding(self, link: Link, slide: Slide) -> Iterator[Equation]:
        name, on, first = link.name, slide.on, link.points[0]
        if slide.rollers:
            raise UnsupportedError("rollers")
        line, offset = self.line(on, slide), self.si(slide.offset)

        def aside(poses: Poses, time: Any) -> Any:
            return self.seen(poses, on, line, self.named(poses, name, first)).imag - offset

        def lean(poses: Poses, time: Any) -> Any:
            return mp.sin(poses[name][2] - poses[on][2] - mp.arg(line[1]))

        for miss in (aside, lean):
            yield Equation(f"{name}-{on}", (name, on), miss, about=(name, first))

    def wheels(self) -> Iterator[Equation]:
        """Rims come equally far; a wheel that nothing else keeps stays at its track."""
        for contact in contacts(self.scene):
            if contact.track and contact.arm is None:
                raise UnsupportedError("wheels on wheels without an arm")
            belt = contact.rolling.belt
            if belt is not None and belt.tension is None:
                raise UnsupportedError("a belt whose tension nothing states")
            yield from self.on_wheel(contact) if contact.track else self.on_track(contact)

    def rim(self, wheel: Wheel) -> Any:
        """The radius of a wheel, below zero for a ring."""
        assert wheel.radius is not None
        return -self.si(wheel.radius) if wheel.inside else self.si(wheel.radius)

    def on_wheel(self, contact: Contact) -> Iterator[Equation]:
        """Two wheels whose centres a link keeps apart."""
        (name, on), arm, track = contact.links, contact.arm, contact.track
        assert arm is not None and track is not None
        own, other = self.rim(contact.wheel), self.rim(track)
        belt = contact.rolling.belt
        if belt is not None and not belt.crossed:
            other = -other
        shares = {name: own, on: other}
        shares[arm] = shares.get(arm, 0) - own - other
        start = {each: self.si(angle) for each, angle in contact.rolling.start.items()}

        def rolled(poses: Poses) -> Any:
            return sum(k * (poses[e][2] - start.get(e, 0)) for e, k in shares.items())

        whole = self.whole_turns(rolled(self.first), [*shares.values()])

        def push(poses: Poses) -> tuple[Any, Any]:
            centre = self.named(poses, name, contact.wheel.centre)
            base = self.named(poses, on, track.centre)
            away = (centre - base) / abs(centre - base)
            if track.inside or contact.wheel.inside:
                away = -away
            return base + other * away, away

        def pulls(poses: Poses) -> Iterator[tuple[Any, Any]]:
            centre = self.named(poses, name, contact.wheel.centre)
            way = self.named(poses, on, track.centre) - centre
            lean = mp.acos((own + other) / abs(way))
            for side in (1, -1):
                radius = mp.expj(mp.arg(way) + side * lean)
                yield centre + own * radius, -side * 1j * radius

        teeth = contact.wheel.teeth is not None or track.teeth is not None
        links = tuple(dict.fromkeys((name, on, arm)))
        miss = lambda poses, time: rolled(poses) - whole  # noqa: E731
        if belt is not None:
            rule = belt.tension.key, self.si(belt.tension.number)
            yield Equation(f"{name}-{on}", links, miss, pulls=pulls, rule=rule)
            return
        yield Equation(f"{name}-{on}", links, miss, push=push, teeth=teeth)

    def whole_turns(self, rolled: Any, shares: list[Any]) -> Any:
        """The whole turns of links, in metres of rim, that are nearest to a sum of rolled rims."""
        several = product(range(-4, 5), repeat=len(shares))
        sums = (2 * mp.pi * sum(k * r for k, r in zip(n, shares, strict=True)) for n in several)
        return min(sums, key=lambda each: abs(each - rolled))

    def on_track(self, contact: Contact) -> Iterator[Equation]:
        """A wheel on a straight track."""
        rolling, (name, on) = contact.rolling, contact.links
        if contact.wheel.inside:
            raise UnsupportedError("a ring on a track")
        line, radius, side = self.line(on, rolling), self.rim(contact.wheel), rolling.side
        zero = self.si(rolling.start[name]) if name in rolling.start else mp.mpf(0)
        if name == FRAME:
            zero = -self.si(rolling.start[on]) if on in rolling.start else mp.mpf(0)

        def way(poses: Poses) -> Any:
            return self.seen(poses, on, line, self.named(poses, name, contact.wheel.centre))

        def slip(poses: Poses, time: Any) -> Any:
            rolled = zero - side * way(poses).real / radius
            return radius * mp.sin(poses[name][2] - poses[on][2] - rolled)

        def push(poses: Poses) -> tuple[Any, Any]:
            away = side * 1j * mp.expj(poses[on][2]) * line[1]
            return self.named(poses, name, contact.wheel.centre) - radius * away, away

        teeth = contact.wheel.teeth is not None
        if contact.arm is not None:
            yield Equation(f"{name}-{on}", (name, on), slip, push=push, teeth=teeth)
            return
        yield Equation(f"{name}-{on}", (name, on), slip)
        height = lambda poses, time: way(poses).imag - side * radius  # noqa: E731
        yield Equation(f"{name}-{on}", (name, on), height)

    def lifts(self) -> Iterator[Equation]:
        """A follower is where the law of its cam puts it, and is pushed along the normal."""
        for follower, cam in self.scene.cams.items():
            if cam.conjugate is not None or (cam.slides and cam.is_flat):
                raise UnsupportedError("second rollers, flat faces on plates")
            ends = dict.fromkeys((follower, cam.on, cam.carrier))
            off = self.swung(follower, cam) if cam.lever else self.raised(follower, cam)
            yield Equation(
                f"{follower}-{cam.on}",
                (*ends,),
                lambda poses, time, off=off, cam=cam: off(
                    poses, self.lift(cam, self.at(poses, cam))
                ),
                push=partial(self.pushed, follower, cam),
            )

    def at(self, poses: Poses, cam: Cam) -> Any:
        """The angle of a cam against its carrier, or the coordinate of a plate."""
        if not cam.slides:
            return poses[cam.on][2] - poses[cam.carrier][2]
        plate = self.scene.link(cam.on)
        return self.seen(
            poses,
            cam.carrier,
            self.guide(plate, cam.carrier),
            self.named(poses, cam.on, plate.points[0]),
        ).real

    def guide(self, block: Link, on: str) -> tuple[Any, Any]:
        """The guide of a block on a link."""
        return self.line(on, next(each for each in block.slides if each.on == on))

    def lift(self, cam: Cam, at: Any) -> Any:
        """How far a cam lifts: metres, or radians of a lever."""
        past = cam.sense * (at - self.si(cam.start))
        ends = [self.si(each.to) for each in cam.law]
        if not cam.slides:
            ends = [mp.degrees(end) for end in ends]
        pieces = [(e, self.si(p.rise), p.motion) for e, p in zip(ends, cam.law, strict=True)]
        if cam.slopes:
            lifts = accumulate((rise for _, rise, _ in pieces), initial=mp.mpf(0))
            places = [ends[-1] - 360, *ends[:-1]]
            pieces = [(e, rise, "") for e, rise in zip(places, lifts, strict=False)]
        return raised(pieces, past) if cam.slides else lifted(pieces, past)

    def raised(self, follower: str, cam: Cam) -> Callable[[Poses, Any], Any]:
        """How far a sliding follower is off its place on the base circle or level and its lift."""
        link, carrier = self.scene.links[follower], cam.carrier
        if cam.point != link.points[0]:
            raise UnsupportedError("a tip beside the first point")
        line = self.guide(link, carrier)
        reach = self.si(cam.base) + self.si(cam.roller)

        def off(poses: Poses, lift: Any) -> Any:
            tip = self.seen(poses, carrier, line, self.named(poses, follower, cam.point))
            if cam.slides:
                plate = self.guide(self.scene.link(cam.on), carrier)
                foot = self.point(poses, carrier, line[0] + line[1] * (tip - lift))
                pin = self.named(poses, cam.on, cam.pivot)
                above = self.seen(poses, carrier, plate, foot) - self.seen(
                    poses, carrier, plate, pin
                )
                side = mp.sign((line[1] * mp.conj(plate[1])).imag)
                return above.imag - side * reach
            pivot = self.seen(poses, carrier, line, self.named(poses, cam.on, cam.pivot))
            if cam.is_flat:
                return tip.real - lift - pivot.real - self.si(cam.base)
            return tip.real - lift - pivot.real - mp.sqrt(reach**2 - (tip - pivot).imag ** 2)

        return off

    def swung(self, follower: str, cam: Cam) -> Callable[[Poses, Any], Any]:
        """How far the bar of a lever is off its place on the base circle or level and its lift."""
        lever = cam.lever
        assert lever is not None
        reach = self.si(cam.base) + self.si(cam.roller)

        def off(poses: Poses, lift: Any) -> Any:
            pin = self.named(poses, cam.carrier, lever.pin)
            bar = self.named(poses, follower, cam.point) - self.named(poses, follower, lever.pin)
            base, arm = self.named(poses, cam.on, cam.pivot), abs(bar)
            if cam.slides:
                along = self.guide(self.scene.link(cam.on), cam.carrier)[1]
                along *= mp.expj(poses[cam.carrier][2])
                above = ((pin - base) * mp.conj(along)).imag
                towards = along * (-1j if above > 0 else 1j)
                resting = mp.acos((abs(above) - reach) / arm)
            else:
                apart, towards = abs(base - pin), (base - pin) / abs(base - pin)
                resting = mp.acos((apart**2 + arm**2 - reach**2) / (2 * apart * arm))
                if cam.is_flat:
                    resting = mp.asin((self.si(cam.base) + self.si(lever.face)) / apart)
            wanted = towards * mp.expj(-lever.side * (resting + lift))
            return (bar / arm * mp.conj(wanted)).imag

        return off

    def pushed(self, follower: str, cam: Cam, poses: Poses) -> tuple[Any, Any]:
        """A place on the common normal of cam and follower, and the normal a quarter turn back.

        Nothing moves along the normal there, as seen from the carrier.
        """
        h, at = mp.mpf(STEP), self.at(poses, cam)
        slope = (self.lift(cam, at + h) - self.lift(cam, at - h)) / (2 * h)
        tip, base = self.named(poses, follower, cam.point), self.named(poses, cam.on, cam.pivot)
        turned, link = mp.expj(poses[cam.carrier][2]), self.scene.links[follower]
        if cam.lever is not None:
            pin, rate = self.named(poses, follower, cam.lever.pin), -cam.lever.side * slope
            speed = 1j * rate * (tip - pin)
            if cam.is_flat:
                bar = (tip - pin) / abs(tip - pin)
                along = (mp.conj(1j * bar) * 1j * (pin - base)).real / (rate - 1)
                return pin + along * bar, bar
        else:
            way = self.guide(link, cam.carrier)[1] * turned
            speed = slope * way
            if cam.is_flat:
                aside = (mp.conj(way) * 1j * (tip - base)).real - slope
                return tip + aside * 1j * way, -1j * way
        if cam.slides:
            speed -= self.guide(self.scene.link(cam.on), cam.carrier)[1] * turned
        else:
            speed -= 1j * (tip - base)
        return tip, speed / abs(speed)

    def driven(self) -> Iterator[Equation]:
        """A link is where its driver says."""
        for driver in self.scene.drivers:
            start, speed, rate = map(self.si, (driver.position, driver.speed, driver.acceleration))
            law = lambda t, a=start, v=speed, r=rate: a + v * t + r * t * t / 2  # noqa: E731
            ends = driver.link, driver.against
            name = self.scene.driver_name(driver)
            yield Equation(name, ends, self.led(driver, law), drives=driver.link)

    def led(self, driver: Driver, law: Callable[[Any], Any]) -> Callable[[Poses, Any], Any]:
        """How far a driven link is from its law."""
        link, against = driver.link, driver.against
        if driver.kind == "turn":
            lean = mp.mpf(0)
            if driver.of is not None:
                start, end = (self.local[link][point] for point in driver.of)
                lean = mp.arg(end - start)
            return lambda poses, t: mp.sin(poses[link][2] - poses[against][2] + lean - law(t))
        body = self.scene.link(link)
        if driver.kind == "slide":
            path: Slide | Rolling = next(e for e in body.slides if e.on == against)
            first = body.points[0]
        else:
            contact = next(e for e in contacts(self.scene) if e.links == (link, against))
            path, first = contact.rolling, contact.wheel.centre
        line = self.line(against, path)
        return lambda p, t: self.seen(p, against, line, self.named(p, link, first)).real - law(t)

    # --- motion --------------------------------------------------------------------------------

    def poses(self, unknowns: Any) -> dict[str, tuple[Any, Any, Any]]:
        found = {n: tuple(unknowns[3 * k + i] for i in range(3)) for k, n in enumerate(self.moving)}
        return found | {FRAME: self.first[FRAME]}

    def missed(self, unknowns: Any, time: Any) -> Any:
        poses = self.poses(unknowns)
        return mp.matrix([each.miss(poses, time) for each in self.equations])

    def gradient(self, each: Equation, unknowns: Any) -> dict[int, Any]:
        """The derivatives of an equation by the unknowns of its links."""
        h, found = mp.mpf(STEP), {}
        for link in each.links:
            if link == FRAME:
                continue
            for i in range(3 * self.moving.index(link), 3 * self.moving.index(link) + 3):
                ends = []
                for way in (h, -h):
                    there = unknowns.copy()
                    there[i] += way
                    ends.append(each.miss(self.poses(there), mp.mpf(0)))
                found[i] = (ends[0] - ends[1]) / (2 * h)
        return found

    def jacobian(self, unknowns: Any) -> Any:
        count = 3 * len(self.moving)
        if len(self.equations) != count:
            raise UnsupportedError(f"{len(self.equations)} equations of {count} unknowns")
        matrix = mp.matrix(count, count)
        for k, each in enumerate(self.equations):
            for i, value in self.gradient(each, unknowns).items():
                matrix[k, i] = value
        return matrix

    def closed(self) -> tuple[Any, Any]:
        """The poses as unknowns, and the Jacobian there."""
        unknowns = mp.matrix([x for name in self.moving for x in self.first[name]])
        for _ in range(12):
            matrix = self.jacobian(unknowns)
            step = mp.lu_solve(matrix, self.missed(unknowns, mp.mpf(0)))
            unknowns = unknowns - step
            if max(map(abs, step)) < mp.mpf(SETTLED):
                return unknowns, self.jacobian(unknowns)
        raise ArithmeticError("Newton's method does not settle")

    def rates(self, unknowns: Any, matrix: Any) -> tuple[Any, Any]:
        """First and second derivatives of the unknowns, by differences along the motion."""
        h = mp.mpf(STEP)
        change = (self.missed(unknowns, h) - self.missed(unknowns, -h)) / (2 * h)
        first = -mp.lu_solve(matrix, change)
        ends = self.missed(unknowns + h * first, h) + self.missed(unknowns - h * first, -h)
        bend = (ends - 2 * self.missed(unknowns, mp.mpf(0))) / (h * h)
        return first, -mp.lu_solve(matrix, bend)

    # --- forces --------------------------------------------------------------------------------

    def solved(self) -> ExactForces:
        """All forces, moments about the pin or the block's first point."""
        unknowns, matrix = self.closed()
        first, second = self.rates(unknowns, matrix)
        poses, found = self.poses(unknowns), ExactForces()
        found.points = self.motions(poses, self.poses(first), self.poses(second))
        right = self.known(poses, found.points, self.poses(second))
        columns = [
            self.column(each, poses, matrix[k, :], 0) for k, each in enumerate(self.equations)
        ]
        belts = [each for each in self.equations if each.pulls is not None]
        values = mp.lu_solve(joined(columns), -right)
        if belts or any(each.teeth for each in self.equations):
            for belt in belts:
                for pull in belt.pulls(poses):
                    right += self.wrench(belt, *pull, poses) * belt.before
            sides = [mp.sign(value) for value in values]
            pairs = enumerate(zip(self.equations, sides, strict=True))
            columns = [self.column(each, poses, matrix[k, :], side) for k, (each, side) in pairs]
            values = mp.lu_solve(joined(columns), -right)
            for each, side, value in zip(self.equations, sides, values, strict=True):
                assert not each.teeth or mp.sign(value) == side
        for each, column, value in zip(self.equations, columns, values, strict=True):
            if each.pulls is None:
                self.enter(found, each, value * column, poses)
                continue
            strands = ("left", "right")
            both = zip(each.pulls(poses), each.tensions(value, value), strands, strict=True)
            for pull, more, strand in both:
                named = replace(each, name=f"{each.name}-{strand}")
                tension = each.before + more
                self.enter(found, named, tension * self.wrench(each, *pull, poses), poses)
        return found

    def motions(self, poses: Poses, first: Poses, second: Poses) -> dict[str, Any]:
        """Position, velocity and acceleration of each named point."""
        found = {}
        for link, points in self.local.items():
            x, y, angle = poses[link]
            (u, v, w), (a, b, c) = first[link], second[link]
            if link == FRAME:
                u = v = w = a = b = c = mp.mpf(0)
            for point, local in points.items():
                arm = mp.expj(angle) * local
                speed = mp.mpc(u, v) + 1j * w * arm
                push = mp.mpc(a, b) + (1j * c - w * w) * arm
                found[point] = mp.mpc(x, y) + arm, speed, push
        return found

    def known(self, poses: Poses, points: Mapping[str, Any], second: Poses) -> Any:
        """Loads, weights and inertia forces of each link, with moments about its origin."""
        scene, right = self.scene, mp.matrix(3 * len(self.moving), 1)

        def add(link: str, place: Any, force: Any, couple: Any) -> None:
            k = 3 * self.moving.index(link)
            turned = cross(place - mp.mpc(*poses[link][:2]), force) + couple
            for i, part in enumerate((*parts(force), turned)):
                right[k + i] += part

        forces = scene.forces
        assert forces is not None
        falls = mp.mpc(*map(self.si, forces.gravity)) if forces.gravity else mp.mpc(0)
        for link, each in forces.masses.items():
            place, _, push = points[each.centre]
            inertia = mp.mpf(0) if each.inertia is None else self.si(each.inertia)
            add(link, place, self.si(each.mass) * (falls - push), -inertia * second[link][2])
        for load in forces.loads:
            couple = mp.mpf(0) if load.moment is None else self.here(load.moment)
            place = points[load.at][0] if load.force else mp.mpc(*poses[load.link][:2])
            force = self.given_force(load.force, points[load.at][1]) if load.force else mp.mpc(0)
            add(load.link, place, force, couple)
        for spring in forces.springs:
            one, other = (points[end][0] for end in spring.ends)
            pull = self.si(spring.stiffness) * (abs(other - one) - self.si(spring.free))
            pull *= (other - one) / abs(other - one)
            for link, place, force in zip(spring.links, (one, other), (pull, -pull), strict=True):
                if link != FRAME:
                    add(link, place, force, mp.mpf(0))
        return right

    def given_force(self, force: Components | Directed, speed: Any) -> Any:
        """A load's force, which may act along the velocity of its point."""
        if not isinstance(force, Directed):
            return mp.mpc(*map(self.si, force))
        if not force.sense:
            return self.here(force.size) * mp.expj(self.si(force.angle))
        return force.sense * self.here(force.size) * speed / abs(speed) if speed else mp.mpc(0)

    def here(self, size: Size) -> Any:
        """A number, or one on the straight line between its neighbours in a driver's table."""
        if not isinstance(size, ByDriver):
            return self.si(size)
        at = self.si(self.scene.drivers[size.driver].position)
        places, numbers = [*map(self.si, size.places)], [*map(self.si, size.numbers)]
        if size.period is not None:
            period = self.si(size.period)
            places, numbers = [*places, places[0] + period], [*numbers, numbers[0]]
            at = places[0] + (at - places[0]) % period
        if at <= places[0] or at >= places[-1]:
            return numbers[0] if at <= places[0] else numbers[-1]
        k = next(k for k, place in enumerate(places) if place > at)
        share = (at - places[k - 1]) / (places[k] - places[k - 1])
        return numbers[k - 1] + share * (numbers[k] - numbers[k - 1])

    def column(self, each: Equation, poses: Poses, gradient: Any, side: Any) -> Any:
        """What a unit multiplier of an equation does to each link."""
        if each.pulls is not None:
            both = zip(each.tensions(side), each.pulls(poses), strict=True)
            one, other = (more * self.wrench(each, *pull, poses) for more, pull in both)
            return one + other
        if each.push is None:
            return gradient.T
        place, away = each.push(poses)
        force = 1j * away + (side * mp.tan(mp.radians(PRESSURE)) * away if each.teeth else 0)
        return self.wrench(each, place, force, poses)

    def wrench(self, each: Equation, place: Any, force: Any, poses: Poses) -> Any:
        """A force at a place on the first link of an equation, and its opposite on the second."""
        found = mp.matrix(3 * len(self.moving), 1)
        for link, sign in zip(each.links[:2], (1, -1), strict=True):
            if link != FRAME:
                k = 3 * self.moving.index(link)
                turned = cross(place - mp.mpc(*poses[link][:2]), sign * force)
                for i, part in enumerate((*parts(sign * force), turned)):
                    found[k + i] = part
        return found

    def enter(self, found: ExactForces, each: Equation, forces: Any, poses: Poses) -> None:
        """One equation's forces on its links, the frame's being opposite to the other's."""
        ends = each.links[:2]
        some = {}
        for link in ends:
            if link != FRAME:
                k = 3 * self.moving.index(link)
                some[link] = mp.mpc(forces[k], forces[k + 1]), forces[k + 2]
        if each.drives:
            force, turned = some.get(each.drives, (0, 0))
            named = {self.scene.driver_name(e): e for e in self.scene.drivers}
            found.drivers[each.name] = turned if named[each.name].kind == "turn" else force
            return
        for link, (force, turned) in some.items():
            moment = mp.mpf(0)
            if each.about is not None:
                owner, point = each.about
                place = self.named(poses, owner, point)
                moment = turned - cross(place - mp.mpc(*poses[link][:2]), force)
            for end in (link, FRAME) if FRAME in ends else (link,):
                sign = 1 if end == link else -1
                before = found.pairs.get((each.name, end), (mp.mpc(0), mp.mpf(0)))
                found.pairs[each.name, end] = before[0] + sign * force, before[1] + sign * moment


def joined(columns: list[Any]) -> Any:
    """Columns side by side."""
    return mp.matrix([[column[i] for column in columns] for i in range(len(columns))])


def parts(vector: Any) -> tuple[Any, Any]:
    return mp.mpf(vector.real), mp.mpf(vector.imag)


def cross(one: Any, other: Any) -> Any:
    return one.real * other.imag - one.imag * other.real


def exact_forces(mechanism: Mechanism) -> ExactForces:
    """The forces of a mechanism. Raises UnsupportedError."""
    with mpmath.workdps(DIGITS):
        return Exact(mechanism).solved()


def far_from_exact(mechanism: Mechanism) -> float:
    """The largest difference of the program's forces, as a share of the largest force."""
    found, verdict = mechanism.forces()
    assert verdict.agrees, verdict
    exact = exact_forces(mechanism)
    size = max(abs(complex(each[0])) for each in exact.points.values()) or 1.0
    forces = [abs(force) for force, _ in exact.pairs.values()]
    moments = [abs(moment) / size for _, moment in exact.pairs.values()]
    largest = float(max([*forces, *moments]))
    own = {(each.name, each.link): each for each in found.reactions}
    assert own.keys() == exact.pairs.keys(), own.keys() ^ exact.pairs.keys()
    off = [0.0]
    for key, (force, moment) in exact.pairs.items():
        off += [abs(own[key].force - complex(force)), abs(own[key].moment - float(moment)) / size]
    for balance in found.balance:
        other = exact.drivers[balance.link]
        if balance.moment is None:
            off.append(abs(balance.force - complex(other)))
        else:
            off.append(abs(balance.moment - float(other)) / size)
            largest = max(largest, abs(float(other)) / size)
    return max(off) / largest if largest else max(off)
