"""Cams in the loops: a follower driven along its guide by s(φ), s'ω and s"ω² + s'ε.

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
from graphkin.numbers.arithmetic import FLOAT, Kind, Real
from graphkin.numbers.cam_motions import displaced
from graphkin.scene.expression import Number
from graphkin.scene.model import FRAME, Driver, Scene
from graphkin.scene.quantity import Quantity
from graphkin.scene.read_cams import turning_driver


@dataclass(frozen=True, slots=True)
class ByLaw(Quantity):
    """The coordinate of a follower, its speed or its acceleration (``order``), in SI."""

    scene: Scene | None = None
    follower: str = ""
    order: int = 0

    def si(self, values: Mapping[str, Any], kind: Kind = FLOAT) -> Real:
        """By the law, at the angle of the driver that turns the cam."""
        assert self.scene is not None
        cam = self.scene.cams[self.follower]
        driver = turning_driver(self.scene, cam)
        assert driver is not None
        turn = driver.position.direction(values, kind) / cam.start.direction(values, kind)
        rise = displaced(
            turn if cam.sense > 0 else turn.conjugate(),
            [piece.to.si(values, kind) for piece in cam.law],
            [piece.rise.si(values, kind) for piece in cam.law],
            [piece.motion for piece in cam.law],
        )
        omega = cam.sense * driver.speed.si(values, kind)
        if self.order == 0:
            return rise.at + self.least(values)
        if self.order == 1:
            return rise.rate * omega
        return rise.bend * omega**2 + rise.rate * cam.sense * driver.acceleration.si(values, kind)

    def least(self, values: Mapping[str, Any]) -> Real:
        """The coordinate of the follower on the base circle."""
        assert self.scene is not None
        numbers = Numbers.of(values)
        cam, slide = self.scene.cams[self.follower], self.scene.link(self.follower).slides[0]
        bodies, starts = bodies_of(replace(self.scene, links={}), numbers)
        through, along = guide_line(slide, bodies[FRAME], starts[FRAME], numbers)
        pivot = (bodies[FRAME][cam.pivot] - through) / along
        base = numbers.si(cam.base)
        if cam.is_flat:
            return pivot.real + base
        aside = numbers.si(slide.offset) - pivot.imag
        return pivot.real + numbers.kind.sqrt((base + numbers.si(cam.roller)) ** 2 - aside**2)


def by_law(scene: Scene) -> Scene:
    """The scene with its followers driven by their laws, and no equivalent linkages."""
    if not scene.cams:
        return scene
    centres, out = scene.cam_centres, scene.cam_links
    links = {
        name: link._replace(
            cam=None, points=tuple(point for point in link.points if point not in centres)
        )
        for name, link in scene.links.items()
        if name not in out
    }
    drivers = [*scene.drivers]
    for follower in scene.cams:
        place, speed, push = (
            ByLaw("", Number(Fraction(0)), "", "", scene, follower, order) for order in range(3)
        )
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
