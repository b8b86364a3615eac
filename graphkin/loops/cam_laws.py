"""Cams in the loops: a follower's coordinate, or its angle, less what the law of its cam gives.

The equivalent linkage is taken out: the loops know nothing of centres of curvature. The law is an
equation between the follower's unknown and the cam's angle, whatever turns the cam.
"""

from __future__ import annotations

from fractions import Fraction

from msgspec.structs import replace

from graphkin.construction.core.solution import Solution
from graphkin.loops.rigid_bodies import Numbers, bodies_of, guide_line
from graphkin.numbers.arithmetic import Point, Real, turn_by
from graphkin.numbers.cam_motions import Rise
from graphkin.scene.expression import Number
from graphkin.scene.model import FRAME, Cam, Driver, Scene
from graphkin.scene.quantity import Quantity, exact


class ByLaw(Quantity, frozen=True, eq=False):
    """The coordinate or the angle of a follower, which its cam's angle gives; its rates are none
    of their own.
    """

    scene: Scene | None = None
    follower: str = ""

    @property
    def key(self) -> tuple[object, ...]:
        """By what it is told from others."""
        return *super().key, self.scene, self.follower

    @property
    def cam(self) -> Cam:
        """The cam that lifts the follower."""
        assert self.scene is not None
        return self.scene.cams[self.follower]

    def start(self, numbers: Numbers) -> Point:
        """Where the follower rests on the base circle: its coordinate, or a lever's direction."""
        return self.resting(numbers) if self.cam.lever else self.least(numbers)

    def at(self, turn: Point, numbers: Numbers, start: Point) -> Rise:
        """By the direction of the cam's x axis: the coordinate (m) or the direction of a lever's
        bar, then its first and second derivative by the cam's angle, of the lever's angle."""
        cam = self.cam
        rise = cam.displacement(turn, numbers.values, numbers.kind)
        if cam.lever is None:
            return Rise(rise.at + start, rise.rate, rise.bend)
        away = -cam.lever.side
        return Rise(start * turn_by(away * rise.at), away * rise.rate, away * rise.bend)

    def resting(self, numbers: Numbers) -> Point:
        """The direction of a lever on the base circle, by half angles."""
        cam, lever = self.cam, self.cam.lever
        assert lever is not None
        bodies, _ = bodies_of(self.without_cams(), numbers)
        bar = bodies[FRAME][cam.pivot] - bodies[FRAME][lever.pin]
        near, sqrt = abs(bar), numbers.kind.sqrt
        if cam.is_flat:
            half = (numbers.si(cam.base) + numbers.si(lever.face)) / near
            half = half / (1 + sqrt((1 - half) * (1 + half)))
        else:
            own = bodies[self.follower]
            arm = abs(own[cam.point] - own[lever.pin])
            prime = numbers.si(cam.base) + numbers.si(cam.roller)
            over, under = (prime - near + arm) * (prime + near - arm), near + arm
            half = sqrt(over / ((under - prime) * (under + prime)))
        return bar / near * (1 - lever.side * half * 1j) ** 2 / (1 + half * half)

    def least(self, numbers: Numbers) -> Real:
        """The coordinate of a sliding follower on the base circle."""
        assert self.scene is not None
        cam, slide = self.cam, self.scene.link(self.follower).slides[0]
        bodies, starts = bodies_of(replace(self.scene, links={}), numbers)
        through, along = guide_line(slide, bodies[FRAME], starts[FRAME], numbers)
        pivot = (bodies[FRAME][cam.pivot] - through) / along
        base = numbers.si(cam.base)
        if cam.is_flat:
            return pivot.real + base
        aside = numbers.si(slide.offset) - pivot.imag
        return pivot.real + numbers.kind.sqrt((base + numbers.si(cam.roller)) ** 2 - aside**2)

    def without_cams(self) -> Scene:
        """The frame and the follower alone."""
        assert self.scene is not None
        return replace(self.scene, links={self.follower: self.scene.links[self.follower]})


def by_law(scene: Scene) -> Scene:
    """The scene with its followers driven by their laws, and no equivalent linkages."""
    if not scene.cams:
        return scene
    centres, out = scene.cam_centres, scene.cam_links
    links = {
        name: replace(
            link, cam=None, points=tuple(point for point in link.points if point not in centres)
        )
        for name, link in scene.links.items()
        if name not in out
    }
    none = exact(0, scene.units["length"])
    drivers = [*scene.drivers]
    for follower, cam in scene.cams.items():
        law = ByLaw("", Number(Fraction(0)), "", "", scene, follower)
        line = (cam.lever.pin, cam.point) if cam.lever else None
        drivers.append(Driver("turn" if line else "slide", follower, FRAME, law, none, none, line))
    return replace(scene, links=links, drivers=tuple(drivers))


def without_linkages(scene: Scene, solution: Solution) -> Solution:
    """What a solution says of all but the equivalent linkages."""
    if not scene.cams:
        return solution
    centres, out = scene.cam_centres, scene.cam_links

    def stays(name: str) -> bool:
        point, _, link = name.partition("@")
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
