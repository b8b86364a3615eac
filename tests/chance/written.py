"""A mechanism as a scene, and the very numbers that the scene states, in any precision."""

from __future__ import annotations

import math
from cmath import phase
from random import Random
from typing import Any

from flint import acb, arb

from tests.chance.many_digits import angle_of, in_many_digits, radians, real, unit
from tests.chance.records import (
    FRAME,
    Body,
    CamLaw,
    Drive,
    Gear,
    Slide,
    Standing,
    Straight,
    Touch,
)
from tests.mechanisms import HEAD, angled, number, pair, sided

SHARE = arb(2) ** -53
"""By what share numbers are shaken: no more than doubles are rounded by."""


class Written:
    """The scene of a mechanism, without its branches, and its numbers as ``Geometry``."""

    def __init__(self, standing: Standing) -> None:
        self.standing = standing
        self.exact: dict[str, dict[str, Any]] = {}
        self.numbers: dict[int, tuple[Any, ...]] = {}
        with in_many_digits():
            bodies = [body for body in standing.bodies.values() if not body.unwritten]
            for touch in standing.touches:
                self.touched(touch)
            self.lines = [line for body in bodies for line in self.body(body)]
            for gear in standing.gears:
                self.kept_apart(gear)
            for drive in standing.drives:
                self.lines += self.driver(drive)

    def text(self, branches: dict[str, str]) -> str:
        """The whole scene."""
        said = [f'{name} = "{words}"' for name, words in branches.items()]
        time = [f"time = {self.standing.moment!r}"] if self.standing.moment else []
        return HEAD + "\n".join([*time, *self.lines, "[branches]", *said, ""])

    # --- writing ---------------------------------------------------------------------------------

    def body(self, body: Body) -> list[str]:
        """One link: its points, its guide, its wheels and what they roll on."""
        lines = ["[frame]" if body.name == FRAME else f"[links.{body.name}]"]
        lines += self.shape(body)
        for centre, radius in body.wheels:
            inside = ", inside = true" if radius < 0 else ""
            wheel = f'{{ centre = "{centre}", radius = {abs(radius)!r}{inside} }}'
            key = "wheel" if len(body.wheels) == 1 else "wheels"
            lines.append(f"{key} = {wheel}")
        if len(body.wheels) > 1:
            joined = ", ".join(line.partition(" = ")[2] for line in lines[-len(body.wheels) :])
            lines[-len(body.wheels) :] = [f"wheels = [{joined}]"]
        if slide := self.standing.slides.get(body.name):
            lines.append(f"slides = {{ {self.guided(slide)} }}")
        tracks = [self.tracked(each) for each in self.standing.straights if each.wheel == body.name]
        gears = [gear for gear in self.standing.gears if gear.wheel == body.name]
        tracks += [self.meshed(gear) for gear in gears if not gear.belt]
        if tracks:
            lines.append(f"rolls = [{', '.join(tracks)}]")
        if belts := [self.meshed(gear) for gear in gears if gear.belt]:
            lines.append(f"belt = [{', '.join(belts)}]")
        lines += [self.touched(each) for each in self.standing.touches if each.own == body.name]
        for cam in self.standing.cams:
            lines += self.lifted(cam) if cam.follower == body.name else []
        return lines

    def touched(self, touch: Touch) -> str:
        """Two profiles that touch, and the bar that stands for them."""
        own, other = (real(each) for each in touch.radii)
        apart = other - own if touch.inside else own + other
        self.exact[touch.link] = {
            touch.centres[0]: acb(0),
            touch.centres[1]: acb(apart),
        }
        inside = ", inside = true" if touch.inside else ""
        ends = f'centres = "{"-".join(touch.centres)}", radii = [{own_words(touch.radii)}]'
        return f'touches = {{ on = {touch.on}, {ends}{inside}, link = "{touch.link}" }}'

    def kept_apart(self, gear: Gear) -> None:
        """The bar between the centres of two wheels that no other link keeps, from the track's."""
        if gear.arm in self.standing.bodies and self.standing.bodies[gear.arm].unwritten:
            own, other = (real(each) for each in gear.radii)
            first, last = reversed(gear.centres)
            self.exact[gear.arm] = {first: acb(0), last: acb(abs(own + other))}

    def lifted(self, cam: CamLaw) -> list[str]:
        """A cam, of the follower that it lifts."""
        sizes = (real(each) for each in (cam.base, cam.roller))
        pieces = [(real(e), real(r), how) for e, r, how in cam.pieces]
        face = real(cam.lever.face) if cam.lever else arb(0)
        start = real(cam.start) if cam.slides else degrees(cam.start)
        self.numbers[id(cam)] = *sizes, start, pieces, face
        law = ", ".join(
            f'{{ to = {end!r}, rise = {rise!r}, motion = "{how}" }}'
            if how
            else f"[{end!r}, {rise!r}]"
            for end, rise, how in cam.pieces
        )
        roller = [f"roller = {cam.roller!r}"] if cam.tip == "roller" else []
        sense = "backward" if cam.slides else "clockwise"
        turned = [f"{sense} = true"] if cam.sense < 0 else []
        head = [f"[links.{cam.follower}.cam]", f"on = {cam.on}", f'tip = "{cam.tip}"']
        head += [f"base = {cam.base!r}", *roller, f"start = {cam.start}", *turned]
        if cam.lever:
            head.append(f'side = "{"left" if cam.lever.side > 0 else "right"}"')
        if cam.lever and cam.lever.face:
            head.append(f"face = {cam.lever.face!r}")
        return [*head, f"law = [{law}]"]

    def shape(self, body: Body) -> list[str]:
        """The points of a link, by coordinates or by lengths and angles."""
        exact = self.exact[body.name] = {}
        if body.along is not None:
            lines = []
            for point, place in body.points.items():
                local = (place - body.corner) * body.axis.conjugate()
                lines.append(f"{point} = {pair(local)}")
                exact[point] = acb(real(number(local.real)), real(number(local.imag)))
            return lines
        (p, a), (q, b), *rest = body.points.items()
        lines = [f"{p}-{q} = {abs(b - a)!r}"]
        exact |= {p: acb(0), q: acb(real(abs(b - a)))}
        for point, place in rest:
            said, exact[point] = third(body.ways[point], (p, q, point), (a, b, place), exact)
            lines += said
        return lines

    def local(self, body: str, place: complex) -> complex:
        """A place of the plane in the axes of a body."""
        owner = self.standing.bodies[body]
        return (place - owner.corner) * owner.axis.conjugate()

    def guided(self, slide: Slide) -> str:
        """A guide: through a point or coordinates at an angle, or along two points."""
        offset = f", offset = {number(slide.offset)}"
        exact = real(number(slide.offset))
        if slide.end is not None:
            first, second = (self.on_body(slide.on, point) for point in (slide.named, slide.end))
            way = second - first
            self.numbers[id(slide)] = first, way / abs(way), exact
            return f'on = {slide.on}, along = "{slide.named}-{slide.end}"{offset}'
        through, start = self.through(slide)
        angle, along = self.direction(slide.on, slide.along)
        self.numbers[id(slide)] = start, along, exact
        return f"on = {slide.on}, through = {through}, angle = {angle}{offset}"

    def on_body(self, body: str, point: str | None) -> Any:
        """A point of a body, exactly; the body may not have been written yet."""
        assert point is not None
        if body not in self.exact or point not in self.exact[body]:
            self.shape(self.standing.bodies[body])
        return self.exact[body][point]

    def through(self, joint: Slide | Straight) -> tuple[str, Any]:
        """The point that a guide or track is written through."""
        if isinstance(joint, Slide) and joint.named is not None:
            return f'"{joint.named}"', self.on_body(joint.on, joint.named)
        local = self.local(joint.on, joint.through)
        return pair(local), acb(real(number(local.real)), real(number(local.imag)))

    def direction(self, on: str, along: complex) -> tuple[str, Any]:
        """A direction of the plane as an angle on a body, in degrees, and exactly."""
        words = number(math.degrees(phase(along * self.standing.bodies[on].axis.conjugate())))
        return words, unit(radians(real(words)))

    def tracked(self, straight: Straight) -> str:
        """A straight track."""
        through, start = self.through(straight)
        angle, along = self.direction(straight.on, straight.along)
        zero = straight.start or 0.0
        self.numbers[id(straight)] = start, along, radius_of(straight.radius), degrees(zero)
        side = ', side = "right"' if straight.side < 0 else ""
        counted = straight.wheel, zero
        if straight.wheel == FRAME:
            counted = straight.on, -zero
        said = f", start = {{ {counted[0]} = {number(counted[1])} }}"
        said = "" if straight.start is None else said
        keeper = f', link = "{straight.keeper}"' if straight.keeper else ""
        line = f"through = {through}, angle = {angle}{side}{said}{keeper}"
        return f"{{ on = {straight.on}, {line} }}"

    def meshed(self, gear: Gear) -> str:
        """A wheel on another."""
        radii = tuple(real(each) for each in gear.radii)
        self.numbers[id(gear)] = (
            radii,
            {name: degrees(gear.start.get(name, 0.0)) for name in (gear.wheel, gear.on, gear.arm)},
        )
        said = ", ".join(f"{name} = {number(angle)}" for name, angle in gear.start.items())
        start = f", start = {{ {said} }}" if said else ""
        crossed = ", crossed = true" if gear.belt == "crossed" else ""
        runs = f", wheels = [{gear.runs[0]}, {gear.runs[1]}]" if gear.runs else ""
        arm = self.standing.bodies.get(gear.arm)
        keeper = f', link = "{gear.arm}"' if arm is not None and arm.unwritten else ""
        return f"{{ on = {gear.on}{crossed}{runs}{start}{keeper} }}"

    def driver(self, drive: Drive) -> list[str]:
        """A driver."""
        position = math.degrees(drive.position) if drive.kind == "turn" else drive.position
        where = real(number(position))
        if drive.kind == "turn":
            where = radians(where)
            if drive.of:
                p, q = (self.exact[drive.body][point] for point in drive.of)
                where -= angle_of(q - p)
        given = drive.speed, drive.acceleration
        turned = drive.kind == "turn"
        name = drive.body if drive.body.isdigit() else f'"{drive.body}"'
        lines = ["[[drivers]]", f"{drive.kind} = {name}"]
        lines += [] if drive.against == FRAME else [f"against = {drive.against}"]
        lines += [f'of = "{"-".join(drive.of)}"'] if drive.of else []
        key = "angle" if turned else "position"
        if drive.law is None:
            self.numbers[id(drive)] = where, *(real(each) for each in given)
            lines += [f"{key} = {number(position)}", f"speed = {drive.speed!r}"]
            return [*lines, f"acceleration = {drive.acceleration!r}"]
        swing, rate = (real(each) for each in drive.law)
        self.numbers[id(drive)] = where, radians(swing) if turned else swing, rate
        late = f"(t - {self.standing.moment!r})"
        return [
            *lines,
            f'{key} = "{number(position)} + {drive.law[0]!r}*sin({drive.law[1]!r}*{late})"',
        ]


class Exact:
    """What a scene states, in many digits: a ``Geometry``."""

    def __init__(self, written: Written) -> None:
        self.written, self.wound = written, {}

    def place(self, x: Any, y: Any) -> Any:
        """A place of the plane."""
        return acb(x, y)

    def cis(self, angle: Any) -> Any:
        """Unit vector at an angle."""
        return unit(angle)

    def local(self, body: str, point: str) -> Any:
        """A point of a body."""
        return self.written.exact[body][point]

    def guide(self, slide: Slide) -> tuple[Any, ...]:
        """A guide on its body, and the block's offset."""
        return self.written.numbers[id(slide)]

    def facing(self, slide: Slide) -> Any:
        """A block's x axis lies along its guide."""
        return acb(1)

    def track(self, straight: Straight) -> tuple[Any, ...]:
        """A track on its body, radius and start angle."""
        return self.written.numbers[id(straight)]

    def gear(self, gear: Gear) -> Any:
        """Radii of two wheels, and the angles that turnings are counted from."""
        radii, zero = self.written.numbers[id(gear)]
        if id(gear) not in self.wound:
            bodies = self.written.standing.bodies
            self.wound[id(gear)] = {
                name: angle
                + 2
                * arb.pi()
                * round((bodies[name].angle - float(angle) - gear.turned[name]) / (2 * math.pi))
                for name, angle in zero.items()
            }
        return radii, self.wound[id(gear)]

    def cam(self, cam: CamLaw) -> tuple[Any, ...]:
        """Sizes of a cam, where its law begins, and its pieces."""
        return self.written.numbers[id(cam)]

    def drive(self, drive: Drive, time: Any) -> Any:
        """The given position at a time."""
        return moved_by(drive, self.written.numbers[id(drive)], time)


def moved_by(drive: Drive, given: tuple[Any, ...], time: Any) -> Any:
    """Where a driver stands: by a speed and an acceleration, or by a sine of the time."""
    where, first, second = given
    if drive.law is None:
        return where + first * time + second * time * time / 2
    return where + first * radians(second * time).sin()


class Shaken(Exact):
    """The same with every number off by a tiny share, as if it had been rounded so.

    Places are off by a share of the whole mechanism: so are those that rounded steps find.
    """

    def __init__(self, written: Written, seed: int) -> None:
        super().__init__(written)
        self.seed = seed
        self.size = arb(written.standing.size)

    def share(self, *what: Any) -> Any:
        """A tiny share of its own, between -SHARE and SHARE, for every number."""
        return SHARE * Random(f"{self.seed} {what}").uniform(-1, 1)

    def local(self, body: str, point: str) -> Any:
        """A point of a body, beside its place."""
        off = acb(self.share(body, point, "x"), self.share(body, point, "y"))
        return super().local(body, point) + self.size * off

    def guide(self, slide: Slide) -> tuple[Any, ...]:
        """A guide, turned and shifted; one along two points as these lie."""
        through, along, offset = super().guide(slide)
        if slide.named is not None and slide.end is not None:
            through, end = (self.local(slide.on, point) for point in (slide.named, slide.end))
            along = (end - through) / abs(end - through)
        return through, along * self.cis(self.share(slide.block)), offset

    def track(self, straight: Straight) -> tuple[Any, ...]:
        """A track, and a wheel, a little off."""
        through, along, radius, start = super().track(straight)
        turned = along * self.cis(self.share(straight.wheel, straight.on))
        radius *= 1 + self.share(straight.wheel)
        return through, turned, radius, start * (1 + self.share(straight.wheel, "start"))

    def gear(self, gear: Gear) -> Any:
        """Wheels of other sizes, counted from other angles."""
        (own, other), zero = super().gear(gear)
        zero = {name: angle * (1 + self.share(gear.wheel, name)) for name, angle in zero.items()}
        return (own * (1 + self.share(gear.wheel, gear.on)), other), zero

    def cam(self, cam: CamLaw) -> tuple[Any, ...]:
        """A cam a little larger, its law a little later and higher."""
        base, roller, start, pieces, face = super().cam(cam)
        more = 1 + self.share(cam.follower, "cam")
        risen = [
            (end, rise * (1 + self.share(cam.follower, "lift")), how) for end, rise, how in pieces
        ]
        late = self.share(cam.follower, "start") * (self.size if cam.slides else 1)
        return base * more, roller * more, start + late, risen, face * more

    def drive(self, drive: Drive, time: Any) -> Any:
        """A driver that is ahead or behind, and faster or slower."""
        where, speed, rate = self.written.numbers[id(drive)]
        ahead = 1 if drive.kind == "turn" else self.size
        where += self.share(drive.body, "where") * ahead
        speed *= 1 + self.share(drive.body, "speed")
        rate *= 1 + self.share(drive.body, "rate")
        return moved_by(drive, (where, speed, rate), time)


def own_words(numbers: tuple[float, ...]) -> str:
    """Some numbers as a scene has them in a list."""
    return ", ".join(map(repr, numbers))


def degrees(angle: float) -> Any:
    """A written angle, in radians."""
    return radians(real(number(angle)))


def radius_of(radius: float) -> Any:
    """A written radius."""
    return real(radius)


def third(
    way: str, names: tuple[str, str, str], places: tuple[complex, ...], exact: dict[str, Any]
) -> tuple[list[str], Any]:
    """A third point of a link beside its first two: how it is written, and where that puts it."""
    (p, q, r), (a, b, c) = names, places
    if way == "polar":
        angle = number(math.degrees(phase((c - a) / (b - a))))
        said = f'{r} = {{ from = "{p}", length = {abs(c - a)!r}, angle = {angle} }}'
        return [said], real(abs(c - a)) * unit(degrees(float(angle)))
    if way == "angle":
        angle = number(math.degrees(phase((c - a) / (b - a))))
        local = real(abs(c - a)) * unit(degrees(float(angle)))
        return angled(p, q, r, a, b, c), local
    lines = sided(p, q, r, a, b, c)
    base, near, far = (real(abs(each)) for each in (b - a, c - a, c - b))
    x = (near * near - far * far + base * base) / (2 * base)
    side = 1 if "left" in lines[-1] else -1
    return lines, acb(x, side * (near * near - x * x).sqrt())
