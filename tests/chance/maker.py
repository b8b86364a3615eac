"""Puts a mechanism together, one body after the other, each where it is to stand."""

from __future__ import annotations

import math
from cmath import phase, rect
from collections.abc import Collection, Iterator, Mapping
from contextlib import contextmanager
from copy import deepcopy
from random import Random

import numpy as np

from tests.chance.constraints import Moved, equations
from tests.chance.records import FRAME, ROUND, Body, Drive, Gear, Slide, Standing, Straight

STIFF = 0.03
"""Least share by which a group must resist every way of moving it, or it is made anew."""


class LooseError(ValueError):
    """A group that hardly holds together where it stands."""


class Maker:
    """What stands already, and how to add to it; ``spread`` is in orders of magnitude."""

    def __init__(self, rng: Random, spread: float, size: float, cross_at: float = 20.0) -> None:
        self.rng, self.spread, self.size, self.cross_at = rng, spread, size, cross_at
        self.standing = Standing()
        self.count = 0

    # --- numbers ---------------------------------------------------------------------------------

    def coin(self, share: float = 0.5) -> bool:
        """Heads or tails."""
        return self.rng.random() < share

    def sign(self) -> int:
        """+1 or -1."""
        return self.rng.choice((1, -1))

    def length(self) -> float:
        """A length of this mechanism's order of magnitude."""
        return self.size * 10 ** self.rng.uniform(-self.spread / 2, self.spread / 2)

    def direction(self) -> complex:
        """A unit vector, at times along an axis."""
        if self.coin(0.15):
            return self.rng.choice((1 + 0j, 1j, -1 + 0j, -1j))
        return rect(1, self.rng.uniform(-math.pi, math.pi))

    def vector(self) -> complex:
        """A way somewhere."""
        return self.length() * self.direction()

    def across(self, way: complex) -> complex:
        """A unit vector that crosses a way at a good angle, at times at a right one."""
        low = math.radians(self.cross_at)
        turn = math.pi / 2 if self.coin(0.1) else self.rng.uniform(low, math.pi - low)
        return way / abs(way) * rect(1, turn * self.sign())

    def beside(self, way: complex) -> complex:
        """A unit vector along a way or back, leaning by less than what is too much."""
        most = 90 - self.cross_at
        lean = 0.0 if self.coin(0.1) else math.radians(self.rng.uniform(-most, most))
        return way / abs(way) * rect(1, lean) * self.sign()

    def rate(self) -> float:
        """A speed, in turns of the second, or in sizes."""
        return 10 ** self.rng.uniform(-1, 1) * self.sign()

    # --- points and bodies -----------------------------------------------------------------------

    def bodies(self, but: Collection[str] = ()) -> list[str]:
        """What stands and is written, less some."""
        bodies = self.standing.bodies
        return [name for name in bodies if name not in but and not bodies[name].unwritten]

    def any_body(self, but: Collection[str] = ()) -> str:
        """The frame at times, else a moving body."""
        moving = [name for name in self.bodies(but) if name != FRAME]
        if FRAME not in but and (not moving or self.coin(0.4)):
            return FRAME
        return self.rng.choice(moving)

    def point(self, body: str, place: complex) -> str:
        """A new point of a body."""
        name = f"P{self.count}"
        self.count += 1
        self.own(body, name, place)
        return name

    def own(self, body: str, point: str, place: complex) -> None:
        """A body has a point, which others may have already."""
        owner = self.standing.bodies[body]
        owner.points[point] = place
        if owner.along is None and len(owner.points) > 2:
            owner.ways[point] = self.way_written(owner, place)

    def way_written(self, owner: Body, place: complex) -> str:
        """How a further point may be written without losing digits."""
        a, b, *_ = owner.points.values()
        sine = abs((((place - a) / (b - a)) if place != a else 1).imag) * abs(b - a) ** 2
        sine /= max(abs(place - a) * abs(place - b), 1e-300)
        ways = ["polar", "angle"] + (["lengths", "lengths"] if sine > 0.3 else [])
        return self.rng.choice(ways)

    def anchor(self, body: str) -> tuple[str, complex]:
        """A point of a body to hang something on."""
        points = self.standing.bodies[body].points
        if body != FRAME and self.coin():
            name = self.rng.choice(list(points))
            return name, points[name]
        near = self.somewhere() if body == FRAME else self.rng.choice(list(points.values()))
        place = near + self.vector()
        return self.point(body, place), place

    def somewhere(self) -> complex:
        """The place of a point that stands, the origin at first."""
        places = [z for body in self.standing.bodies.values() for z in body.points.values()]
        return self.rng.choice(places) if places else 0j

    def body(self, points: dict[str, complex], along: complex | None = None) -> str:
        """A new body on some points; ``along`` is its x axis if that may not be chosen."""
        name = str(len(self.standing.bodies))
        first = next(iter(points.values()))
        far = [z for z in points.values() if z != first]
        origin = first if self.coin() else first + self.vector()
        if along is None and (not far or len(points) < 2 or self.coin(0.4)):
            along = self.direction()
        if self.coin() and along is None:
            points = dict(reversed(points.items()))
        body = Body(name, {}, origin, along)
        self.standing.bodies[name] = body
        for point, place in points.items():
            self.own(name, point, place)
        if self.coin(0.25):
            self.point(name, first + self.vector())
        return name

    def unwritten(self, points: dict[str, complex], length: float) -> str:
        """A link between two points that the program puts in where it is asked for it by name."""
        name = f"h{len(self.standing.bodies)}"
        self.standing.bodies[name] = Body(name, points, length=length)
        return name

    # --- guides ----------------------------------------------------------------------------------

    def may_be_block(self, body: str) -> bool:
        """Whether a body that stands may become a block of an unknown guide.

        The follower of a cam that has a guide slides there, so that a lever may not.
        """
        levers = {cam.follower for cam in self.standing.cams if cam.lever}
        return body != FRAME and body not in self.standing.slides and body not in levers

    def guide(self, block: str, on: str, along: complex, through: str | None = None) -> None:
        """A slide between two bodies, the block's x axis along it."""
        first = next(iter(self.standing.bodies[block].points.values()))
        owner = self.standing.bodies[on]
        if through is not None:
            start = owner.points[through]
            offset = ((first - start) * along.conjugate()).imag
            offset = 0.0 if abs(offset) < 1e-12 * self.size else offset
            slide = Slide(block, on, start, along, offset, through)
        else:
            offset = self.length() * self.sign() if self.coin() else 0.0
            start = first - along * (self.length() * self.sign() + 1j * offset)
            slide = Slide(block, on, start, along, offset)
            if self.coin():
                slide.named = self.point(on, start)
        if slide.named is not None and self.coin():
            slide.end = self.point(on, start + along * self.length())
        self.standing.slides[block] = slide

    def block(self, points: dict[str, complex], on: str, along: complex) -> str:
        """A new block on some points, on a guide of a body that has its axes."""
        if self.coin(0.3):
            first = next(iter(points.values()))
            points = {self.name(): first + self.vector(), **points}
        name = self.body(points, along)
        self.guide(name, on, along)
        return name

    def geared(
        self,
        names: tuple[str, str, str],
        centres: tuple[str, str],
        radii: tuple[float, float],
        turned: Mapping[str, float],
        belt: str = "",
        idle: bool = False,
    ) -> None:
        """The first body rolls on the second, on the arm of the third; so far each has turned."""
        start = {n: math.degrees(self.angle(n) - turned[n]) for n in names if n != FRAME}
        own = {n: turned[n] for n in names}
        self.standing.gears.append(Gear(*names, centres, radii, belt, start, own, idle))

    def name(self) -> str:
        """The name of a point that is still to come."""
        self.count += 1
        return f"P{self.count - 1}"

    # --- drivers and checks ----------------------------------------------------------------------

    def drive(
        self, kind: str, body: str, against: str, position: float, of: tuple[str, str] | None = None
    ) -> Drive:
        """A driver, accelerated at times, at times at rest."""
        size = 1.0 if kind == "turn" else self.size
        speed = 0.0 if self.coin(0.03) else self.rate()
        rate = speed**2 * self.rate() if self.coin() else 0.0
        drive = Drive(kind, body, against, position, speed * size, rate * size, of)
        self.standing.drives.append(drive)
        return drive

    def turn(self, body: str, against: str) -> None:
        """A driver that turns a body that stands as it does."""
        bodies = self.standing.bodies
        owner, of = bodies[body], None
        axis = owner.axis
        if len(owner.points) > 1 and self.coin(0.3):
            p, q = self.rng.sample(list(owner.points), 2)
            way = owner.points[q] - owner.points[p]
            if abs(way) > 1e-9 * self.size:
                of, axis = (p, q), way / abs(way)
        self.drive("turn", body, against, phase(axis * bodies[against].axis.conjugate()), of)

    def angle(self, body: str) -> float:
        """The angle of a body's x axis, with the whole turns that its driver is written with."""
        bodies = self.standing.bodies
        if body == FRAME:
            return 0.0
        if (drive := self.driven_from(body)) is not None:
            line = 1 + 0j
            if drive.of:
                p, q = (bodies[drive.body].points[point] for point in drive.of)
                line = (q - p) * bodies[drive.body].axis.conjugate()
                straight = abs(line.imag) < 1e-12 * abs(line)
                line = complex(line.real, 0.0) if straight else line
            turned = drive.position - phase(line)
            if drive.body == body:
                return self.angle(drive.against) + turned
            return self.angle(drive.body) - turned
        known = self.slid_with_counted(body)
        return bodies[body].angle if known is None else self.along(known, body)

    def driven_from(self, body: str) -> Drive | None:
        """The driver that turns a body from one that stands before it, whichever it names first."""
        order = [*self.standing.bodies]
        for drive in self.standing.drives:
            ends = {drive.body, drive.against}
            if drive.kind == "turn" and body in ends:
                (other,) = ends - {body}
                if order.index(other) < order.index(body):
                    return drive
        return None

    def counts(self, body: str) -> bool:
        """Whether a driver or a contact turns a body, or one that it slides along."""
        return body in self.counted or self.slid_with_counted(body) is not None

    @property
    def counted(self) -> set[str]:
        """The bodies that drivers or contacts turn."""
        return {n for n in self.standing.bodies if self.driven_from(n)} | self.standing.led

    def slid_with_counted(self, body: str) -> str | None:
        """The next body along slides towards one that a driver or a contact turns."""
        counted = self.counted
        slides = [(slide.block, slide.on) for slide in self.standing.slides.values()]
        towards, waiting = {body: body}, [body]
        while waiting:
            here = waiting.pop(0)
            if here != body and here in counted:
                return towards[here]
            beside = [on for block, on in slides if block == here]
            beside += [block for block, on in slides if on == here]
            for each in beside:
                if each not in (FRAME, *towards):
                    towards[each] = each if here == body else towards[here]
                    waiting.append(each)
        return None

    def turned_by_contacts(self) -> set[str]:
        """Bodies that contacts turn, or whose wheels they keep apart, but for driven ones."""
        found = {each.wheel for each in self.standing.straights}
        found |= {name for gear in self.standing.gears for name in (gear.wheel, gear.on, gear.arm)}
        return {name for name in found if self.driven_from(name) is None}

    def shifts(self, body: str) -> bool:
        """Whether slides alone join a body to the frame, so that it never turns."""
        found, waiting = {body}, [body]
        slides = [{slide.block, slide.on} for slide in self.standing.slides.values()]
        while waiting:
            here = waiting.pop()
            more = {each for pair in slides if here in pair for each in pair} - found
            found |= more
            waiting += more
        return FRAME in found

    def along(self, on: str, body: str) -> float:
        """The angle of a body that slides along another and counts its turns with that."""
        bodies = self.standing.bodies
        if self.shifts(on):
            return bodies[body].angle
        lean = phase(bodies[body].axis * bodies[on].axis.conjugate())
        return self.angle(on) + (lean if lean > ROUND - math.pi else lean + math.tau)

    def slide_coordinate(self, block: str) -> float:
        """Where a block stands on its guide."""
        slide = self.standing.slides[block]
        first = next(iter(self.standing.bodies[block].points.values()))
        return ((first - slide.through) * slide.along.conjugate()).real

    @contextmanager
    def group(self) -> Iterator[None]:
        """What is added must hold together well; else all of it is taken away (LooseError)."""
        before, count = deepcopy(self.standing), self.count
        try:
            yield
            if stiffness(self.standing, set(before.bodies)) < STIFF:
                raise LooseError
            self.standing.led |= self.turned_by_contacts() - set(before.bodies)
        except (LooseError, ZeroDivisionError):
            self.standing, self.count = before, count
            raise LooseError from None


def stiffness(standing: Standing, known: set[str]) -> float:
    """Least resistance of new bodies to being moved, all scaled; 0 where the count is wrong."""
    new = [name for name in standing.bodies if name not in known]
    rules = [miss for about, miss in equations(standing) if about & set(new)]
    spots = {name: list(standing.bodies[name].points.values()) for name in standing.bodies}
    size = {n: max([abs(z - spots[n][0]) for z in spots[n]], default=0) for n in new}
    most = max(size.values(), default=1.0) or 1.0
    poses = dict.fromkeys(standing.bodies, (0.0, 0.0, 0.0))
    geometry = AsPlaced(standing)

    def missed(body: str, k: int, by: float):
        at = spots[body][0]
        turn = geometry.cis(by) if k == 2 else 1
        shift = (by if k == 0 else 1j * by if k == 1 else 0) + at - turn * at
        pose = (shift.real, shift.imag, by if k == 2 else 0.0)
        moved = Moved(geometry, {**poses, body: pose})
        return np.array([float(value) for miss in rules for value in miss(moved, 0.0)])

    columns = []
    for name in new:
        own = size[name] or most
        for k in range(3):
            step = 1e-4 * (1 if k == 2 else own)
            columns.append((missed(name, k, step) - missed(name, k, -step)) / 2e-4)
    matrix = np.array(columns).T
    if matrix.ndim != 2 or matrix.shape[0] != matrix.shape[1]:
        return 0.0
    rows = np.linalg.norm(matrix, axis=1, keepdims=True)
    if not rows.all():
        return 0.0
    matrix = matrix / rows
    return float(np.linalg.svd(matrix, compute_uv=False)[-1])


class AsPlaced:
    """The bodies as they stand: own axes are those of the plane. A ``Geometry`` in floats."""

    def __init__(self, standing: Standing) -> None:
        self.standing = standing

    def place(self, x: float, y: float) -> complex:
        """A place of the plane."""
        return complex(x, y)

    def cis(self, angle: float) -> complex:
        """Unit vector at an angle."""
        return rect(1, angle)

    def local(self, body: str, point: str) -> complex:
        """A point of a body."""
        return self.standing.bodies[body].points[point]

    def guide(self, slide: Slide) -> tuple[complex, complex, float]:
        """A guide, the block turned as it."""
        return slide.through, slide.along, slide.offset

    def facing(self, slide: Slide) -> complex:
        """A block faces along its guide."""
        return slide.along

    def track(self, straight: Straight) -> tuple[complex, complex, float, float]:
        """A track; turnings are counted from here."""
        centre = self.standing.bodies[straight.wheel].points[straight.centre]
        way = ((centre - straight.through) * straight.along.conjugate()).real
        return (
            straight.through,
            straight.along,
            straight.radius,
            straight.side * way / (straight.radius),
        )

    def gear(self, gear):
        """Radii; turnings are counted from here."""
        return gear.radii, dict.fromkeys((gear.wheel, gear.on, gear.arm), 0.0)

    def cam(self, cam):
        """Sizes, the law and where it begins; own axes turn from here."""
        bodies = self.standing.bodies
        turned = 0.0 if cam.slides else bodies[cam.on].angle - bodies[cam.carrier].angle
        start = cam.start if cam.slides else math.radians(cam.start)
        face = cam.lever.face if cam.lever else 0.0
        return cam.base, cam.roller, start - turned, cam.pieces, face

    def drive(self, drive: Drive, time: float) -> float:
        """Turning drivers stand at zero here."""
        return 0.0 if drive.kind == "turn" else drive.position
