"""Kutzbach's plan drawn: which wheels it holds, and where they stand on its axis."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from graphkin.construction.core.bases import contact_name
from graphkin.construction.core.pen import Pen, image
from graphkin.construction.core.program import SPEEDS, Part, Plane
from graphkin.construction.core.quantities import OMEGA
from graphkin.construction.core.vocabulary import meet
from graphkin.construction.guides.coincident_points import image_under
from graphkin.construction.plan import VELOCITY
from graphkin.construction.rolling.kutzbach import (
    PLAN,
    LadderAxis,
    LadderPoint,
    LadderRay,
    SpeedPole,
    SpeedRead,
    axis_through,
    foot_beyond,
    kept,
    line_of_speeds,
    parallel_to_ray,
    ray_through,
    speed_cut,
    tip_over,
)
from graphkin.numbers.plane import dot
from graphkin.scene.link_points import under
from graphkin.scene.model import FRAME, Driver
from graphkin.structure.pairs import Contact, contacts
from graphkin.text.errors import Problem, StructureError

BESIDE = 0.2
"""Room between the velocity plan and the axis, and between both plans, in parts of the axis."""


class OnAxis(NamedTuple):
    """A point on the axis: its foot, its tip, and where it stands at the scene's own numbers."""

    foot: int
    tip: int
    at: float


class Ladder:
    """Draws the plan of a train whose wheels turn about fixed centres, or on arms about these."""

    def __init__(self, pen: Pen) -> None:
        self.pen, self.scene = pen, pen.scene
        self.meshes = [
            each
            for each in contacts(pen.scene)
            if each.track is not None and each.rolling.belt is None and each.arm is not None
        ]
        self.centres: dict[str, OnAxis] = {}
        self.on: dict[str, list[OnAxis]] = {}
        self.axis, self.seconds = 0, 0

    # --- finding its points ----------------------------------------------------------------------

    def refusal(self) -> str:
        """Why a scene has no such plan; nothing where it has one."""
        if any(each not in self.meshes for each in contacts(self.scene)):
            return "a belt, a rack or a rolling wheel belongs to it"
        if not self.meshes:
            return "no wheels touch"
        if self.turner() is None:
            return "no driver turns with a speed"
        for point in self.moving():
            if self.arm_of(point) is None:
                return f"no arm about a fixed pin carries {point}"
        return ""

    def turner(self) -> Driver | None:
        """The first driver that turns a link, not with the speed nought."""
        for driver in self.scene.drivers:
            if driver.kind == "turn" and not driver.speed.is_zero():
                return driver
        return None

    def moving(self) -> list[str]:
        """The centres of wheels that move."""
        found = dict.fromkeys(centre for each in self.meshes for centre in centres_of(each))
        return [centre for centre in found if centre not in self.scene.frame.points]

    def fixed(self) -> list[str]:
        """The centres that stand still, and the pins of arms, in the order of the frame."""
        every = (centre for each in self.meshes for centre in centres_of(each))
        arms = (arm[1] for centre in self.moving() if (arm := self.arm_of(centre)))
        found = {*every, *arms}
        return [point for point in self.scene.frame.points if point in found]

    def arm_of(self, centre: str) -> tuple[str, str] | None:
        """The link that carries a moving centre about a fixed pin, and that pin."""
        for link in self.scene.links.values():
            if centre in link.points and not any(w.centre == centre for w in link.wheels):
                pins = [point for point in link.points if point in self.scene.frame.points]
                if pins:
                    return link.name, pins[0]
        return None

    def spot(self, point: str) -> complex:
        """Where a point stands at the scene's own numbers."""
        return complex(self.pen.peek(self.pen.the("position", point)))

    # --- drawing it ------------------------------------------------------------------------------

    def draw(self) -> None:
        """The axis, its points, the rays, the pole of speeds and what the parallels cut off."""
        pen, driver = self.pen, self.turner()
        assert driver is not None
        with pen.on(Part.SHAPE, Plane.NUMBERS):
            self.seconds = pen.given("seconds", driver.speed)
        with pen.on(Part.VELOCITY, Plane.VELOCITIES):
            self.begin()
            self.place_fixed()
            for centre in self.moving():
                self.place_moving(centre)
            for contact in self.meshes:
                self.place_contact(contact)
            rays = {link: self.ray(link) for link in self.scene.links if link in self.on}
            pole = self.speed_pole()
            for link, ray in rays.items():
                self.speed(link, ray, pole)

    def begin(self) -> None:
        """The axis along the first line of centres, and the first fixed centre on it."""
        pen, first = self.pen, self.fixed()[0]
        every = dict.fromkeys(c for each in self.meshes for c in centres_of(each))
        other = next(centre for centre in (*every, *self.moving()) if centre != first)
        ends = pen.the("position", first), pen.the("position", other)
        o = pen.pole(Plane.VELOCITIES)
        self.axis = pen.draw(axis_through, o, *ends)
        extra = (BESIDE,)
        start = pen.draw(
            foot_beyond, o, self.axis, *ends, self.seconds, extra=extra, name=foot_name(first)
        )
        names = {"p": first, "q": other, "name": foot_name(first)}
        pen.make(LadderAxis(**names, axis=self.axis, start=start))
        self.centres[first] = OnAxis(start, start, 0.0)

    def place_fixed(self) -> None:
        """The other fixed centres, each beyond one that its wheels touch, else beyond the first."""
        waiting = [centre for centre in self.fixed() if centre not in self.centres]
        while waiting:
            known, centre = next(self.reached(waiting), (next(iter(self.centres)), waiting[0]))
            self.put(centre, known, (known, centre), 1, moves=False)
            waiting.remove(centre)

    def reached(self, waiting: list[str]) -> Iterator[tuple[str, str]]:
        """The centres on the axis with others whose wheels touch theirs."""
        for contact in self.meshes:
            for known, centre in (centres_of(contact), centres_of(contact)[::-1]):
                if known in self.centres and centre in waiting:
                    yield known, centre

    def place_moving(self, centre: str) -> None:
        """The centre of a planet, as far from the pin of its arm as the arm says."""
        arm = self.arm_of(centre)
        assert arm is not None
        link, pin = arm
        self.put(centre, pin, (pin, centre), 1, moves=True)
        self.carry(link, self.centres[pin], self.centres[centre])
        for wheel in self.wheels_about(centre):
            self.carry(wheel, self.centres[centre])

    def place_contact(self, contact: Contact) -> None:
        """A pitch point on the line from a fixed centre; that of two planets is off the axis."""
        fixed = [c for c in centres_of(contact) if c in self.scene.frame.points]
        if not fixed:
            return
        first = fixed[0]
        other = next(centre for centre in centres_of(contact) if centre != first)
        name = contact_name(contact)
        there, way = self.spot(name) - self.spot(first), self.spot(other) - self.spot(first)
        side = 1 if self.centres[other].at > self.centres[first].at else -1
        side *= 1 if dot(there, way) > 0 else -1
        self.put(name, first, (first, name), side, moves=True)
        for link in contact.links:
            own = contact.wheel_of(link).centre
            if link != FRAME:
                self.carry(link, self.centres[own], self.centres[name])

    def put(self, point: str, before: str, line: tuple[str, str], side: int, moves: bool) -> None:
        """A point on the axis, and over it its velocity."""
        pen, start = self.pen, self.centres[before]
        ends = tuple(pen.the("position", end) for end in line)
        args = start.foot, self.axis, *ends, self.seconds
        foot = pen.draw(foot_beyond, *args, extra=(side,), name=foot_name(point))
        tip, velocity, o = None, None, pen.pole(Plane.VELOCITIES)
        if moves:
            velocity = self.velocity(point)
            known = foot, self.axis, *ends, o, velocity
            tip = pen.draw(tip_over, *known, extra=(side,), name=f"{image(point)}_x")
        pen.make(
            LadderPoint(point=str(point), before=start.foot, velocity=velocity, foot=foot, tip=tip)
        )
        at = start.at + side * abs(self.spot(line[1]) - self.spot(line[0]))
        self.centres[point] = OnAxis(foot, foot if tip is None else tip, at)

    def velocity(self, point: str) -> int:
        """The image of a point; of a pitch point that of either wheel."""
        if self.pen.has("velocity", point):
            return self.pen.the("velocity", point)
        links = next(c.links for c in self.meshes if contact_name(c) == point)
        for link in links:
            if self.pen.has("velocity", under(point, link)):
                return self.pen.the("velocity", under(point, link))
        return image_under(self.pen, links[1], point, VELOCITY)

    def wheels_about(self, centre: str) -> list[str]:
        """The links whose wheels turn about a moving centre."""
        links = self.scene.links.values()
        return [link.name for link in links if any(w.centre == centre for w in link.wheels)]

    def carry(self, link: str, *points: OnAxis) -> None:
        """Points that a link carries, each once."""
        own = self.on.setdefault(link, [])
        own += [point for point in points if point not in own]

    def ray(self, link: str) -> int:
        """The ray of a link through the two of its tips that stand farthest apart."""
        own = sorted(self.on[link], key=lambda each: each.at)
        if len(own) < 2 or own[-1].at - own[0].at == 0:
            raise StructureError(
                problem(f"link {link} touches no wheel about a fixed centre, so that it has no ray")
            )
        ends = own[0].tip, own[-1].tip
        ray = self.pen.draw(ray_through, *ends, *(each.tip for each in own[1:-1]))
        return self.pen.make(LadderRay(link=link, first=ends[0], last=ends[1], ray=ray)).ray

    def speed_pole(self) -> SpeedPole:
        """The pole of speeds beyond the ladder, and the line of speeds as far from it as the
        smallest wheel's rim is from its centre."""
        pen, contact = self.pen, min(self.meshes, key=self.smallest)
        far = max(self.centres.values(), key=lambda each: each.at)
        near = next(name for name, each in self.centres.items() if each.at == 0)
        end = next(name for name, each in self.centres.items() if each is far)
        span = tuple(pen.the("position", point) for point in (near, end))
        aside = far.foot, self.axis, *span, self.seconds
        pole = pen.draw(foot_beyond, *aside, extra=(BESIDE,), name=self.free_letter())
        p, q = min(centres_of(contact), key=lambda c: self.rim(c, contact)), contact_name(contact)
        width = tuple(pen.the("position", point) for point in (p, q))
        start = pen.draw(foot_beyond, pole, self.axis, *width, self.seconds, extra=(1,), name="n_0")
        line = pen.draw(line_of_speeds, start, self.axis)
        return pen.make(SpeedPole(p=p, q=str(q), pole=pole, start=start, line=line))

    def free_letter(self) -> str:
        """The letter of the pole of speeds: one that no point of the scene has."""
        links = (self.scene.frame, *self.scene.links.values())
        taken = {point for link in links for point in link.points}
        return next(letter for letter in ("S", "H", "Z", "Sn") if letter not in taken)

    def rim(self, centre: str, contact: Contact) -> float:
        """The distance of a centre from a pitch point."""
        return abs(self.spot(contact_name(contact)) - self.spot(centre))

    def smallest(self, contact: Contact) -> float:
        """The radius of the smaller of two wheels that touch."""
        return min(self.rim(centre, contact) for centre in centres_of(contact))

    def speed(self, link: str, ray: int, scale: SpeedPole) -> None:
        """The point of a link on the line of speeds, and its angular velocity by it."""
        pen = self.pen
        parallel = pen.draw(parallel_to_ray, scale.pole, ray)
        cut = pen.draw(meet, parallel, scale.line, name=f"n_{link}")
        pen.want(SPEEDS, link, cut)
        read = rate = None
        known = pen.the(OMEGA, link) if pen.has(OMEGA, link) else None
        if known is not None and pen.steps[known].args:
            with pen.on(Part.RESULT, Plane.NUMBERS):
                ends = tuple(pen.the("position", point) for point in (scale.p, scale.q))
                with pen.hands_way():
                    args = scale.start, self.axis, cut, *ends, self.seconds, scale.pole
                    read = pen.draw(speed_cut, *args)
                rate = pen.draw(kept, known, name=link, by_hand=read)
            pen.want(OMEGA, link, rate)
        pen.make(
            SpeedRead(link=link, scale=scale, parallel=parallel, cut=cut, read=read, rate=rate)
        )


def centres_of(contact: Contact) -> tuple[str, str]:
    """The centres of two wheels that touch."""
    assert contact.track is not None
    return contact.wheel.centre, contact.track.centre


def foot_name(point: str) -> str:
    """The letter of a point on the axis."""
    return f"{point}_x"


def problem(found: str) -> Problem:
    """The problem of a scene that has no such plan."""
    expected = "wheels that touch, about fixed pins or on arms about these"
    return Problem("sheet.plan", found, expected, "leave plan out for the velocity plan alone")


def draw_ladder(pen: Pen) -> None:
    """Kutzbach's plan where a scene wants it. Raises StructureError where it cannot be drawn."""
    if pen.scene.sheet.plan != PLAN:
        return
    ladder = Ladder(pen)
    if refused := ladder.refusal():
        raise StructureError(problem(refused))
    ladder.draw()
