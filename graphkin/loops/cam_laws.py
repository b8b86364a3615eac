"""Cams in the loops: a follower driven along its guide, or turned, by s(φ), s'ω and s"ω² + s'ε.

The equivalent linkage is taken out: the loops know nothing of centres of curvature.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from msgspec.structs import replace

from graphkin.construction.core.solution import Solution
from graphkin.loops.rigid_bodies import Numbers, bodies_of, guide_line
from graphkin.numbers.arithmetic import FLOAT, Kind, Point, Real, phase, turn_by
from graphkin.numbers.cam_motions import Rise
from graphkin.scene.expression import Number
from graphkin.scene.model import FRAME, Cam, Driver, Scene
from graphkin.scene.quantity import Quantity
from graphkin.scene.read_cams import turning_driver


@dataclass(frozen=True, slots=True)
class ByLaw(Quantity):
    """The coordinate or the angle of a follower, its speed or its acceleration, in SI.

    ``order`` tells which of the three.
    """

    scene: Scene | None = None
    follower: str = ""
    order: int = 0

    @property
    def cam(self) -> Cam:
        """The cam that lifts the follower."""
        assert self.scene is not None
        return self.scene.cams[self.follower]

    def rise(self, values: Mapping[str, Any], kind: Kind) -> tuple[Rise, Driver]:
        """The displacement, by the angle of the driver that turns the cam."""
        assert self.scene is not None
        cam = self.cam
        driver = turning_driver(self.scene, cam)
        assert driver is not None
        turn = driver.position.direction(values, kind)
        return cam.displacement(turn, values, kind), driver

    def si(self, values: Mapping[str, Any], kind: Kind = FLOAT) -> Real:
        """By the law; of a lever the angle of its bar in the frame."""
        rise, driver = self.rise(values, kind)
        if self.order == 0:
            if self.cam.lever:
                return phase(self.direction(values, kind))
            return rise.at + self.least(values)
        away = -self.cam.lever.side if self.cam.lever else 1
        omega = driver.speed.si(values, kind)
        if self.order == 1:
            return away * rise.rate * omega
        push = driver.acceleration.si(values, kind)
        return away * (rise.bend * omega**2 + rise.rate * push)

    def direction(self, values: Mapping[str, Any], kind: Kind = FLOAT) -> Point:
        """The direction of a lever: on the base circle by half angles, then swung by the law."""
        numbers, cam, lever = Numbers.of(values), self.cam, self.cam.lever
        assert lever is not None and self.scene is not None
        rise, _ = self.rise(values, kind)
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
        begun = (1 - lever.side * half * 1j) ** 2 / (1 + half * half)
        return bar / near * begun * turn_by(-lever.side * rise.at)

    def least(self, values: Mapping[str, Any]) -> Real:
        """The coordinate of a sliding follower on the base circle."""
        assert self.scene is not None
        numbers = Numbers.of(values)
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
    drivers = [*scene.drivers]
    for follower, cam in scene.cams.items():
        place, speed, push = (
            ByLaw("", Number(Fraction(0)), "", "", scene, follower, order) for order in range(3)
        )
        if cam.lever:
            line = cam.lever.pin, cam.point
            drivers.append(Driver("turn", follower, FRAME, place, speed, push, line))
        else:
            drivers.append(Driver("slide", follower, FRAME, place, speed, push))
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
