"""Cams in the loops: a follower's coordinate or angle equals the value of its cam's law.

The equivalent linkage is removed, and the loops contain no centres of curvature. The law is an
equation between the follower's unknown and the cam's angle or coordinate. All are relative to the
link that carries both, whatever moves the cam.
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

from msgspec.structs import replace

from graphkin.construction.core.solution import Solution
from graphkin.loops.rigid_bodies import Body, Numbers, bodies_of, guide_line
from graphkin.numbers.arithmetic import Point, Real, turn_by
from graphkin.scene.expression import Number
from graphkin.scene.link_points import ends_of
from graphkin.scene.model import FRAME, Cam, Driver, Link, Scene
from graphkin.scene.quantity import Quantity, exact

if TYPE_CHECKING:
    from graphkin.numbers.cam_motions import Rise


class ByLaw(Quantity, frozen=True, eq=False):
    """The coordinate or angle of a follower, given by its cam; it has no rates of its own."""

    scene: Scene | None = None
    follower: str = ""

    @property
    def key(self) -> tuple[object, ...]:
        """The key that distinguishes it from other quantities."""
        return *super().key, self.scene, self.follower

    @property
    def cam(self) -> Cam:
        """The cam that lifts the follower."""
        assert self.scene is not None
        return self.scene.cams[self.follower]

    def start(self, numbers: Numbers) -> Point:
        """The follower's rest on the base circle: its coordinate, or a lever's direction."""
        return self.resting(numbers) if self.cam.lever else self.least(numbers)

    def at(self, place: Point, numbers: Numbers, start: Point) -> Rise:
        """The follower's position with two derivatives by the cam's angle or coordinate.

        ``place`` is the direction of the cam's x axis relative to its carrier, or the coordinate
        (m) of a plate. The position is the follower's coordinate (m), or the direction of a lever's
        bar; the derivatives are those of the coordinate or of the lever's angle.
        """
        cam = self.cam
        rise = cam.displacement(place, numbers.values, numbers.kind)
        if cam.lever is None:
            return rise._replace(at=rise.at + start)
        away = -cam.lever.side
        turned = start * turn_by(away * rise.at)
        return rise._replace(at=turned, rate=away * rise.rate, bend=away * rise.bend)

    def resting(self, numbers: Numbers) -> Point:
        """The direction of a lever at rest, by half angles: on the base circle or a plate."""
        cam, lever = self.cam, self.cam.lever
        assert lever is not None
        bodies, starts = bodies_of(self.seen(follower=True), numbers)
        fixed, sqrt = bodies[cam.carrier], numbers.kind.sqrt
        own = bodies[self.follower]
        arm = abs(own[cam.point] - own[lever.pin])
        if cam.slides:
            through, along = self.plate(fixed, starts[cam.carrier], numbers)
            above = (fixed[lever.pin] - through) / along
            high = abs(above.imag)
            down = -1j * along * (above.imag / high)
            low = high - numbers.si(cam.base) - numbers.si(cam.roller)
            half = sqrt((arm - low) / (arm + low))
            return down * (1 - lever.side * half * 1j) ** 2 / (1 + half * half)
        bar = fixed[cam.pivot] - fixed[lever.pin]
        near = abs(bar)
        if cam.is_flat:
            half = (numbers.si(cam.base) + numbers.si(lever.face)) / near
            half = half / (1 + sqrt((1 - half) * (1 + half)))
        else:
            prime = numbers.si(cam.base) + numbers.si(cam.roller)
            over, under = (prime - near + arm) * (prime + near - arm), near + arm
            half = sqrt(over / ((under - prime) * (under + prime)))
        return bar / near * (1 - lever.side * half * 1j) ** 2 / (1 + half * half)

    def least(self, numbers: Numbers) -> Real:
        """The coordinate of a sliding follower at rest: on the base circle or on a level plate."""
        assert self.scene is not None
        cam, slide = self.cam, self.scene.link(self.follower).slides[0]
        bodies, starts = bodies_of(self.seen(), numbers)
        fixed, start = bodies[cam.carrier], starts[cam.carrier]
        through, along = guide_line(slide, fixed, start, numbers)
        base = numbers.si(cam.base)
        if cam.slides:
            point, way = self.plate(fixed, start, numbers)
            across = along / way
            above = (through + 1j * along * numbers.si(slide.offset) - point) / way
            side = across.imag / abs(across.imag)
            return ((base + numbers.si(cam.roller)) * side - above.imag) / across.imag
        pivot = (fixed[cam.pivot] - through) / along
        if cam.is_flat:
            return pivot.real + base
        aside = numbers.si(slide.offset) - pivot.imag
        return pivot.real + numbers.kind.sqrt((base + numbers.si(cam.roller)) ** 2 - aside**2)

    def plate(self, body: Body, start: Point, numbers: Numbers) -> tuple[Point, Point]:
        """The line on which the first point of a plate slides, in the carrier's axes."""
        assert self.scene is not None
        slide = self.scene.link(self.cam.on).slides[0]
        through, along = guide_line(slide, body, start, numbers)
        return through + 1j * along * numbers.si(slide.offset), along

    def seen(self, *, follower: bool = False) -> Scene:
        """The scene reduced to the frame and the carrier, with the ``follower`` on request."""
        assert self.scene is not None
        names = {self.cam.carrier, self.follower if follower else self.cam.carrier} - {FRAME}
        return replace(self.scene, links={name: self.scene.links[name] for name in sorted(names)})


def by_law(scene: Scene) -> Scene:
    """The scene with its followers driven by their laws, and without equivalent linkages."""
    if not scene.cams:
        return scene
    centres, out = scene.cam_centres, scene.cam_links

    def less(link: Link) -> Link:
        points = tuple(point for point in link.points if point not in centres)
        return replace(link, cam=None, points=points)

    links = {name: less(link) for name, link in scene.links.items() if name not in out}
    none = exact(0, scene.units["length"])
    drivers = [*scene.drivers]
    for follower, cam in scene.cams.items():
        law = ByLaw("", Number(Fraction(0)), "", "", scene, follower)
        line = (cam.lever.pin, cam.point) if cam.lever else None
        drivers.append(
            Driver("turn" if line else "slide", follower, cam.carrier, law, none, none, line)
        )
    return replace(scene, frame=less(scene.frame), links=links, drivers=tuple(drivers))


def without_linkages(scene: Scene, solution: Solution) -> Solution:
    """A solution without the quantities of equivalent linkages."""
    if not scene.cams:
        return solution
    centres, out = scene.cam_centres, scene.cam_links

    def stays(name: str) -> bool:
        point, link = ends_of(name)
        return point not in centres and link not in out

    return replace(
        solution,
        points={name: each for name, each in solution.points.items() if stays(name)},
        links={name: each for name, each in solution.links.items() if name not in out},
        slides={name: each for name, each in solution.slides.items() if name not in out},
        centres={
            pair: each
            for pair, each in solution.centres.items()
            if not out.keys() & set(pair.split("-"))
        },
    )
