"""Where everything of a drawing stands while it moves: points, links, guides and wheels, traced.

What is chosen by value (which pin a link is seen from, on which side a block is drawn) is chosen
where the scene stands; all else follows the driver.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

from graphkin.construction.core.bodies import Disc, Guideway, Touch
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.link_poses import ALONG, CLEAR, lettered
from graphkin.construction.core.run import Trace
from graphkin.construction.guides.slide_symbols import is_swivel
from graphkin.construction.links.plates import farthest
from graphkin.numbers.arithmetic import pick
from graphkin.numbers.plane import Line, cross, dot
from graphkin.scene.model import FRAME
from graphkin.tape.tape_outputs import TapeOutputs

SAME = 1e-9
"""Parts of the mechanism within which two points are one."""


class BodyPose(NamedTuple):
    """Where a body stands: a point of it and a unit direction that turns with it."""

    origin: Any
    way: Any


def unit(way: Any) -> Any:
    """A direction of length one."""
    return way / abs(way)


@dataclass(frozen=True)
class TracedBodies:
    """The bodies of one sheet: its drawing, and the traced values of its steps."""

    drawing: Drawing
    trace: Trace
    tape: TapeOutputs

    @property
    def values(self) -> Mapping[int, Any]:
        """The traced values of the steps."""
        return self.trace.values

    @cached_property
    def positions(self) -> Mapping[str, Any]:
        """Where each point that a link owns stands."""
        return {name: self.known[name] for name in self.drawing.positions}

    @cached_property
    def known(self) -> Mapping[str, Any]:
        """Where every point of the program stands."""
        return {
            of: self.tape.lifted(self.values[number])
            for (quantity, of), number in self.trace.program.targets.items()
            if quantity == "position" and number in self.values
        }

    @cached_property
    def spots(self) -> Mapping[str, Any]:
        """Where every point of the drawing stands, by its letters."""
        found = dict(self.positions)
        for point, place in self.known.items():
            found.setdefault(lettered(point), place)
            if "@" not in point:
                for link in (FRAME, *self.drawing.scene.links):
                    found.setdefault(lettered(f"{point}@{link}"), place)
        return found

    # --- bodies --------------------------------------------------------------------------------

    def pose(self, link: str) -> BodyPose | None:
        """Where a link stands; None where nothing tells how it is turned."""
        return self.pose_of(link, frozenset())

    def pose_of(self, link: str, asking: frozenset[str]) -> BodyPose | None:
        """The same, without those links that are being asked already."""
        if link == FRAME:
            return BodyPose(self.tape.lifted(0j), self.tape.lifted(1 + 0j))
        if link not in self.poses:
            found = self.by_points(link) or self.by_axis(link)
            if found is None and link not in asking:
                return self.by_guides(link, asking | {link})
            self.poses[link] = found
        return self.poses[link]

    @cached_property
    def poses(self) -> dict[str, BodyPose | None]:
        """Those that are known."""
        return {}

    def points_of(self, link: str) -> list[str]:
        """The points of a link that are placed."""
        points = self.drawing.scene.link(link).points
        return [point for point in points if point in self.positions]

    def by_points(self, link: str) -> BodyPose | None:
        """From the two points of a link that are farthest apart."""
        names = self.points_of(link)
        places = {self.drawing.positions[name]: name for name in names}
        if len(places) < 2:
            return None
        first, last = farthest(list(places))
        if abs(last - first) <= SAME * self.drawing.standing.size:
            return None
        start, end = (self.positions[places[place]] for place in (first, last))
        return BodyPose(start, unit(end - start))

    def by_axis(self, link: str) -> BodyPose | None:
        """From its first point and the step that gives its axis, or the line it slides along."""
        names = self.points_of(link)
        if not names:
            return None
        axis = self.trace.value("axis", link)
        if axis is None:
            guide = self.trace.value("guide", link)
            axis = unit(self.tape.lifted(guide.along)) if isinstance(guide, Line) else None
        return None if axis is None else BodyPose(self.positions[names[0]], self.tape.lifted(axis))

    def by_guides(self, link: str, asking: frozenset[str]) -> BodyPose | None:
        """From what it slides on, or from what slides on it: neither turns against the other."""
        names, scene = self.points_of(link), self.drawing.scene
        others = [slide.on for slide in scene.link(link).slides]
        others += [o.name for o in scene.links.values() if any(s.on == link for s in o.slides)]
        for other in others:
            pose = self.pose_of(other, asking) if other not in asking else None
            if pose is not None:
                return BodyPose(self.positions[names[0]] if names else pose.origin, pose.way)
        return None

    def carried(self, link: str, place: complex) -> Any:
        """Where a place goes that a link carries along."""
        pose = self.pose(link)
        if pose is None:
            return self.tape.lifted(place)
        origin, way = self.tape.now(pose.origin), self.tape.now(pose.way)
        return pose.origin + pose.way * (complex(way).conjugate() * (place - origin))

    def turned(self, link: str, way: complex) -> Any:
        """Where a direction goes that a link carries along."""
        pose = self.pose(link)
        if pose is None:
            return self.tape.lifted(way)
        return pose.way * (complex(self.tape.now(pose.way)).conjugate() * way)

    # --- guides and wheels ---------------------------------------------------------------------

    def along(self, way: Guideway) -> Any:
        """The direction of a guide."""
        return self.turned(way.slide.on, way.along)

    def seat(self, way: Guideway) -> Any:
        """Where the middle of the rectangle of a sliding pair stands."""
        point, along = (
            self.positions[self.drawing.scene.links[way.block].points[0]],
            self.along(way),
        )
        if way.slide.on == FRAME:
            return self.beside_wheels(way, point)
        if not is_swivel(self.drawing, way.slide):
            zero = self.carried(way.slide.on, way.zero)
            return zero + along * dot(point - zero, along)
        pivot = self.positions[self.drawing.scene.links[way.slide.on].points[0]]
        return point + along * dot(pivot - point, along)

    def beside_wheels(self, way: Guideway, point: Any) -> Any:
        """Where a block of the frame is drawn: at its point, but clear of a wheel on its link."""
        found = self.tape.lifted(point)
        for touch in reversed(self.drawing.standing.touches):
            if touch.on != way.block or abs(cross(touch.along, way.along)) > ALONG:
                continue
            gap, clear = dot(point - self.touch(touch).origin, way.along), CLEAR * touch.disc.radius
            aside = point + (pick(gap < 0, -clear, clear) - gap) * way.along
            found = pick(abs(gap) < clear, aside, found)
        return found

    def touch(self, touch: Touch) -> BodyPose:
        """Where a wheel touches its track, and the way from its centre to there."""
        centre = self.positions[touch.disc.wheel.centre]
        if touch.zero is not None:
            on = touch.on
            zero, along = self.carried(on, touch.zero), self.turned(on, touch.along)
            return BodyPose(zero + along * dot(centre - zero, along), along)
        other = touch.other
        assert other is not None
        apart = unit(self.positions[other.wheel.centre] - centre)
        way = -apart if other.wheel.inside else apart
        return BodyPose(centre + way * touch.disc.radius, way)

    def turn_of(self, link: str) -> Any:
        """By how much a link has turned since the drawing, as a unit vector."""
        pose = self.pose(link)
        if pose is None:
            return self.tape.lifted(1 + 0j)
        return pose.way * complex(self.tape.now(pose.way)).conjugate()

    def teeth(self, disc: Disc, touch: Touch) -> BodyPose:
        """A gear's outline, whose teeth are drawn where it meshes: as the wheel turns they pass
        there, each taking the place of the one before it."""
        found, centre = self.touch(touch), self.positions[disc.wheel.centre]
        way = found.way if touch.zero is None else self.turned(touch.on, 1 + 0j)
        mesh = way * complex(self.tape.now(way)).conjugate()
        against = self.turn_of(disc.link) * mesh.conjugate()
        angle = self.tape.lifted(against).imag.do("atan2", self.tape.lifted(against).real)
        import numpy as np

        pitch = disc.module / disc.radius * np.pi
        rest = angle - (angle * (1 / pitch)).do("round") * pitch
        return BodyPose(centre, mesh * (rest.do("cos") + 1j * rest.do("sin")))
