"""The poses of a mechanism's bodies: axes of links, guides, wheels and contacts, in metres."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property

from msgspec import Struct

from graphkin.construction.core.run import Trace
from graphkin.numbers.arithmetic import Point, Real, pick
from graphkin.numbers.plane import Line, cross, dot
from graphkin.scene.link_points import is_under, lettered, under
from graphkin.scene.model import (
    FRAME,
    Apart,
    At,
    Belt,
    Link,
    Polar,
    Rolling,
    Scene,
    Slide,
    Wheel,
    of_one_size,
)
from graphkin.scene.quantity import Quantity
from graphkin.structure.pairs import is_in_scene


class Guideway(Struct, frozen=True):
    """The straight guide of a block: its origin, its unit vector, and the block's first point.

    ``offset`` is the distance of the block's first point to the left of the guide.
    """

    block: str
    slide: Slide
    zero: complex
    along: complex
    at: complex
    offset: float

    @property
    def coordinate(self) -> Real:
        """The coordinate of the block along the guide, from its origin."""
        return dot(self.at - self.zero, self.along)

    @property
    def foot(self) -> Point:
        """The foot of the block's first point on the guide."""
        return self.zero + self.coordinate * self.along


class Disc(Struct, frozen=True):
    """A wheel of a link in the plane, with its label ``sign``; ``module`` is zero without teeth."""

    link: str
    sign: str
    wheel: Wheel
    centre: complex
    radius: float
    module: float

    @property
    def outer(self) -> float:
        """The radius of the circle that contains the whole wheel."""
        thick = 3 * self.module if self.wheel.inside else self.module
        return self.radius + thick


CLEAR = 1.6
"""Distance from a contact point to the drawn guide of its track, in radii of the wheel."""
ALONG = 1e-6
"""Sine of the angle below which two directions count as equal."""
APART = 1e-9
"""Points closer than this fraction of the largest distance count as one."""


class Touch(Struct, frozen=True):
    """The contact of a wheel and its track; ``along`` is a straight track's positive direction.

    ``zero`` is the origin of a straight track; ``other`` is the wheel that forms a circular track.
    """

    rolling: Rolling
    disc: Disc
    at: complex
    along: complex
    zero: complex | None = None
    other: Disc | None = None

    @property
    def on(self) -> str:
        """The link with the track."""
        return self.rolling.on

    @property
    def belt(self) -> Belt | None:
        """The belt that joins both wheels, if there is one."""
        return self.rolling.belt

    @property
    def side(self) -> int:
        """The side of a straight track on which the wheel is: 1 for its left."""
        return self.rolling.side


class LinkPoses(Struct, frozen=True, dict=True):
    """The poses of a scene's bodies, as a trace has placed them."""

    scene: Scene
    trace: Trace

    def si(self, quantity: Quantity) -> float:
        return float(quantity.si(self.scene.values))

    @cached_property
    def positions(self) -> Mapping[str, complex]:
        """The position of each point that belongs to a link."""
        links = (self.scene.frame, *self.scene.links.values())
        owned = {point for link in links for point in link.points}
        return {name: place for name, place in self.known.items() if name in owned}

    @cached_property
    def known(self) -> Mapping[str, complex]:
        """The position of every point of the program that the trace has placed."""
        return {
            of: self.trace.values[number]
            for (quantity, of), number in self.trace.program.targets.items()
            if quantity == "position" and number in self.trace.values
        }

    @cached_property
    def places(self) -> Mapping[str, complex]:
        """The position of every point of the drawing by its letters: A, A3 under it, T."""
        found = dict(self.positions)
        for point, place in self.known.items():
            found.setdefault(lettered(point), place)
            if not is_under(point):
                for link in (FRAME, *self.scene.links):
                    found.setdefault(lettered(under(point, link)), place)
        return found

    def spot(self, letters: str) -> complex:
        return self.places[letters]

    def name_at(self, place: complex) -> str:
        """The name of a drawn point at a place that belongs to no link; empty without one."""
        near = APART * self.size
        found = (n for n in self.known if not is_in_scene(n) and not is_under(n))
        return next((lettered(n) for n in found if abs(self.known[n] - place) <= near), "")

    @cached_property
    def size(self) -> float:
        """The largest extent of the points along x or y; 1 where they all coincide."""
        xs = [p.real for p in self.positions.values()] or [0.0]
        ys = [p.imag for p in self.positions.values()] or [0.0]
        size = max(max(xs) - min(xs), max(ys) - min(ys))
        return size if size > 0 else 1.0

    def axis(self, link: str) -> complex | None:
        """The unit vector of a link's x axis; None where the trace does not hold it."""
        found: complex | None = 1 + 0j if link == FRAME else self.trace.value("axis", link)
        return found

    def direction(self, slide: Slide) -> complex | None:
        """The unit vector of a guide; None where the trace does not determine it."""
        if slide.along:
            start, end = (self.positions.get(point) for point in slide.along)
            if start is None or end is None or start == end:
                return None
            return (end - start) / abs(end - start)
        base = self.axis(slide.on)
        if base is None or slide.angle is None:
            return None
        return base * complex(slide.angle.direction(self.scene.values))

    def carried(self, link: str, through: str | tuple[Quantity, Quantity] | None) -> complex | None:
        """The position of a link's point, given by its name or by coordinates."""
        if isinstance(through, str):
            return self.positions.get(through)
        axis = self.axis(link)
        if axis is None or through is None:
            return None
        local = complex(*(self.si(q) for q in through))
        if link == FRAME:
            return local
        for point, place in written_places(self, self.scene.link(link)).items():
            if point in self.positions:
                return self.positions[point] + axis * (local - place)
        return None

    def guideway(self, block: Link, slide: Slide) -> Guideway | None:
        """The guide of a block in the plane; None where its direction is unknown."""
        at = self.positions.get(block.points[0]) if block.points else None
        if at is None:
            return None
        along, offset = self.direction(slide), self.si(slide.offset)
        stated = self.trace.value("guide", block.name)
        if along is None and isinstance(stated, Line) and len(block.slides) == 1:
            along = stated.along / abs(stated.along)
        if along is None:
            return None
        zero = self.carried(slide.on, slide.along[0] if slide.along else slide.through)
        if zero is None:
            zero = at - 1j * offset * along
        if block.name in self.scene.cam_links:
            offset = cross(along, at - zero)
        return Guideway(block.name, slide, zero, along, at, offset)

    @cached_property
    def guideways(self) -> tuple[Guideway, ...]:
        """Every guide in the plane, in the order of the scene."""
        found = (
            self.guideway(link, slide)
            for link in self.scene.bare.links.values()
            for slide in link.slides
        )
        return tuple(way for way in found if way is not None)

    @cached_property
    def discs(self) -> tuple[Disc, ...]:
        """Every wheel in the plane, the largest first."""
        found = [
            self.disc(link.name, wheel)
            for link in (self.scene.frame, *self.scene.links.values())
            for wheel in link.wheels
            if wheel.centre in self.positions and wheel.radius is not None
        ]
        return tuple(sorted(found, key=lambda disc: -disc.radius))

    def disc(self, link: str, wheel: Wheel) -> Disc:
        assert wheel.radius is not None
        radius = self.si(wheel.radius)
        teeth = float(wheel.teeth.number(self.scene.values)) if wheel.teeth else 0.0
        module = 2 * radius / teeth if teeth else 0.0
        sign = self.scene.link(link).wheel_sign(wheel)
        return Disc(link, sign, wheel, self.positions[wheel.centre], radius, module)

    @cached_property
    def touches(self) -> tuple[Touch, ...]:
        """Every contact of a wheel with its track."""
        found = []
        for link in self.scene.every_link:
            own = [disc for disc in self.discs if disc.link == link.name]
            for rolling in link.rolls:
                touch = self.on_line(own, rolling) if rolling.angle else self.on_wheel(own, rolling)
                if touch is not None:
                    found.append(touch)
        return tuple(found)

    def beside_wheels(self, way: Guideway) -> complex:
        """The place where a block of the frame is drawn: its point, clear of a wheel there."""
        found = way.at
        for touch in reversed(self.touches):
            if touch.on != way.block or abs(cross(touch.along, way.along)) > ALONG:
                continue
            gap, clear = dot(way.at - touch.at, way.along), CLEAR * touch.disc.radius
            aside = way.at + (pick(gap < 0, -1, 1) * clear - gap) * way.along
            found = pick(abs(gap) < clear, aside, found)
        return found

    def on_line(self, own: list[Disc], rolling: Rolling) -> Touch | None:
        """The contact with a straight track: the foot of the normal from the wheel's centre."""
        axis, zero = self.axis(rolling.on), self.carried(rolling.on, rolling.through)
        if axis is None or zero is None or rolling.angle is None or not own:
            return None
        along = axis * complex(rolling.angle.direction(self.scene.values))

        def miss(disc: Disc) -> float:
            return abs(abs(cross(along, disc.centre - zero)) - disc.radius)  # type: ignore[no-any-return]

        disc = min(own, key=miss)
        at = zero + dot(disc.centre - zero, along) * along
        return Touch(rolling, disc, at, along, zero)

    def on_wheel(self, own: list[Disc], rolling: Rolling) -> Touch | None:
        """The contact with a circular track, on the line of centres of the two wheels."""
        others = [disc for disc in self.discs if disc.link == rolling.on]
        wheels = self.scene.link(own[0].link).wheels if own else ()
        meant = rolling.pairs(wheels, self.scene.link(rolling.on).wheels) if wheels else []
        pairs = [(a, b) for a in own for b in others if (a.wheel, b.wheel) in meant]
        if not pairs:
            return None
        if rolling.belt is not None:
            return self.by_belt(*pairs[0], rolling, rolling.belt)

        def miss(pair: tuple[Disc, Disc]) -> float:
            one, other = pair
            reach = one.radius + other.radius
            if one.wheel.inside or other.wheel.inside:
                reach = abs(one.radius - other.radius)
            return abs(abs(other.centre - one.centre) - reach)

        one, other = min(pairs, key=miss)
        apart = other.centre - one.centre
        if abs(apart) <= APART * self.size:
            return None
        way = -apart / abs(apart) if other.wheel.inside else apart / abs(apart)
        return Touch(rolling, one, one.centre + one.radius * way, 1j * way, None, other)

    def by_belt(self, one: Disc, other: Disc, rolling: Rolling, belt: Belt) -> Touch:
        """The contact of a belt: where its strands meet the line of centres."""
        apart = other.centre - one.centre
        share = 0.5
        if belt.crossed or not of_one_size(one.wheel, other.wheel):
            share = one.radius / (one.radius + belt.sense * other.radius)
        at = one.centre + apart * share
        return Touch(rolling, one, at, 1j * apart / abs(apart), None, other)


def written_places(standing: LinkPoses, link: Link) -> dict[str, complex]:
    """The points of a link that the scene gives by coordinates or on its axis, in its own axes."""
    places: dict[str, complex] = {}
    for placing in link.placings:
        match placing:
            case At(point, x, y):
                places[point] = complex(standing.si(x), standing.si(y))
            case Apart(point, start, length) if start in places:
                places[point] = places[start] + standing.si(length)
            case Polar(point, start, length, angle) if start in places:
                way = complex(angle.direction(standing.scene.values))
                places[point] = places[start] + standing.si(length) * way
    return places
