"""What joins the bodies of a mechanism, as equations that must vanish: plain distances and angles.

Poses are (x, y, θ) of each body's own axes; the numbers are floats or of many digits.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Protocol

import mpmath
from flint import acb, arb

from tests.chance.lifts import lifted, raised
from tests.chance.many_digits import radians, unit
from tests.chance.records import FRAME, CamLaw, Drive, Gear, Slide, Standing, Straight

Pose = tuple[Any, Any, Any]


class Geometry(Protocol):
    """The shapes of the bodies in their own axes, in some kind of numbers."""

    def place(self, x: Any, y: Any) -> Any:
        """A place of the plane."""

    def cis(self, angle: Any) -> Any:
        """Unit vector at an angle (radians)."""

    def local(self, body: str, point: str) -> Any:
        """A point of a body."""

    def guide(self, slide: Slide) -> tuple[Any, Any, Any]:
        """A point of a guide and its direction on its body, and the block's offset."""

    def facing(self, slide: Slide) -> Any:
        """The direction of a block's own axes that lies along its guide."""

    def track(self, straight: Straight) -> tuple[Any, Any, Any, Any]:
        """Start and direction of a track on its body, radius, and start angle of its wheel."""

    def gear(self, gear: Gear) -> tuple[tuple[Any, Any], dict[str, Any]]:
        """Radii of two wheels, and for each body the angle that its turning is counted from."""

    def cam(self, cam: CamLaw) -> tuple[Any, Any, Any, list[tuple[Any, Any, str]], Any]:
        """Radii of the base circle and of the roller, start (radians, metres), pieces, face."""

    def drive(self, drive: Drive, time: Any) -> Any:
        """The given position at a time, as the angle of the body's x axis where it turns."""


@dataclass
class Moved:
    """Bodies in some poses."""

    geometry: Geometry
    poses: Mapping[str, Pose]

    def __post_init__(self) -> None:
        self.units = {name: self.geometry.cis(pose[2]) for name, pose in self.poses.items()}

    def at(self, body: str, local: Any) -> Any:
        """A point of a body, in the plane."""
        x, y, _ = self.poses[body]
        return self.geometry.place(x, y) + self.units[body] * local

    def point(self, body: str, name: str) -> Any:
        """A named point of a body, in the plane."""
        return self.at(body, self.geometry.local(body, name))

    def slid(self, standing: Standing, slide: Slide) -> Any:
        """Where a block's first point stands from the start of its guide: along and to the left."""
        through, along, _ = self.geometry.guide(slide)
        first = next(iter(standing.bodies[slide.block].points))
        way = self.point(slide.block, first) - self.at(slide.on, through)
        return way * (self.units[slide.on] * along).conjugate()


Equation = tuple[set[str], Callable[[Moved, Any], list[Any]]]
"""The bodies that some equations are about, and what must vanish, in poses at a time."""


def equations(standing: Standing) -> list[Equation]:
    """Everything that joins or drives the bodies of a mechanism."""
    found: list[Equation] = []
    for point, (first, *others) in standing.owners().items():
        for other in others:
            if standing.idle.get(other, ("", ""))[1] == point:
                found.append(({first, other}, pointing(standing, other, first, point)))
            else:
                found.append(({first, other}, pinned(point, first, other)))
    for slide in standing.slides.values():
        found.append(({slide.block, slide.on}, sliding(standing, slide)))
    for straight in standing.straights:
        found.append(({straight.wheel, straight.on}, rolling(straight)))
    for gear in (each for each in standing.gears if not each.idle):
        found.append(({gear.wheel, gear.on, gear.arm}, meshing(gear)))
    for cam in standing.cams:
        found.append(({cam.follower, cam.on, cam.carrier}, lifting(standing, cam)))
    for drive in standing.drives:
        found.append(({drive.body, drive.against}, driven(standing, drive)))
    return found


def pinned(point: str, first: str, other: str) -> Callable[[Moved, Any], list[Any]]:
    """A point of two bodies is in one place."""

    def apart(moved: Moved, time: Any) -> list[Any]:
        gap = moved.point(first, point) - moved.point(other, point)
        return [gap.real, gap.imag]

    return apart


def pointing(
    standing: Standing, bar: str, other: str, point: str
) -> Callable[[Moved, Any], list[Any]]:
    """An idle bar points to a point of another body: its length is not needed."""
    pivot = standing.idle[bar][0]

    def aside(moved: Moved, time: Any) -> list[Any]:
        start = moved.point(bar, pivot)
        way = moved.point(bar, point) - start
        return [((moved.point(other, point) - start) * way.conjugate()).imag / abs(way)]

    return aside


def sliding(standing: Standing, slide: Slide) -> Callable[[Moved, Any], list[Any]]:
    """A block stays at its offset from its guide, its x axis along it."""

    def off(moved: Moved, time: Any) -> list[Any]:
        _, along, offset = moved.geometry.guide(slide)
        ahead = moved.units[slide.block] * moved.geometry.facing(slide)
        lean = ahead * (moved.units[slide.on] * along).conjugate()
        return [moved.slid(standing, slide).imag - offset, lean.imag]

    return off


def rolling(straight: Straight) -> Callable[[Moved, Any], list[Any]]:
    """A wheel stays its radius from its track and turns by its way over the radius."""

    def slip(moved: Moved, time: Any) -> list[Any]:
        through, along, radius, start = moved.geometry.track(straight)
        on, wheel, side = straight.on, straight.wheel, straight.side
        way = moved.point(wheel, straight.centre) - moved.at(on, through)
        way = way * (moved.units[on] * along).conjugate()
        turned = moved.units[wheel] * moved.units[on].conjugate()
        rolled = moved.geometry.cis(start - side * way.real / radius)
        slip = (turned * rolled.conjugate()).imag
        return [slip] if straight.kept else [way.imag - side * radius, slip]

    return slip


def meshing(gear: Gear) -> Callable[[Moved, Any], list[Any]]:
    """Seen from the arm, the rims of two wheels have come equally far."""

    def slip(moved: Moved, time: Any) -> list[Any]:
        (own, other), zero = moved.geometry.gear(gear)
        turned = {name: moved.poses[name][2] - zero[name] for name in zero}
        against = turned[gear.arm]
        return [own * (turned[gear.wheel] - against) + other * (turned[gear.on] - against)]

    return slip


def lifting(standing: Standing, cam: CamLaw) -> Callable[[Moved, Any], list[Any]]:
    """A follower stands as its law says, beyond where it rests on the base circle or on the level.

    All as the body sees it that carries it and the cam.
    """
    resting = swung(standing, cam) if cam.lever else raised_by(standing, cam)

    def off(moved: Moved, time: Any) -> list[Any]:
        _, _, start, law, _ = moved.geometry.cam(cam)
        pieces = [(mpmath.mpf(end), mpmath.mpf(rise), how) for end, rise, how in law]
        if cam.slides:
            plate = standing.slides[cam.on]
            at, law_of = moved.slid(standing, plate).real, raised
        else:
            at, law_of = moved.poses[cam.on][2] - moved.poses[cam.carrier][2], lifted
        return [resting(moved, arb(law_of(pieces, mpmath.mpf(cam.sense * (at - start)))))]

    return off


def raised_by(standing: Standing, cam: CamLaw) -> Callable[[Moved, Any], Any]:
    """How far a sliding follower stands beyond its place on the base circle and its lift."""
    slide = standing.slides[cam.follower]

    def off(moved: Moved, lift: Any) -> Any:
        base, roller, *_ = moved.geometry.cam(cam)
        through, along, offset = moved.geometry.guide(slide)
        at = moved.slid(standing, slide).real - lift
        if cam.slides:
            start, way, aside = moved.geometry.guide(standing.slides[cam.on])
            centre = through + along * acb(at, offset)
            above = ((centre - start) * way.conjugate()).imag - aside
            side = 1 if (along * way.conjugate()).imag > 0 else -1
            return above - side * (base + roller)
        own = moved.units[cam.carrier] * along
        pivot = (moved.point(cam.on, cam.pivot) - moved.at(cam.carrier, through)) * own.conjugate()
        if cam.tip == "flat":
            return at - pivot.real - base
        return at - pivot.real - arb((base + roller) ** 2 - (offset - pivot.imag) ** 2).sqrt()

    return off


def swung(standing: Standing, cam: CamLaw) -> Callable[[Moved, Any], Any]:
    """How far the bar of a lever is off its place on the base circle, swung by its lift."""
    assert cam.lever is not None
    lever = cam.lever

    def off(moved: Moved, lift: Any) -> Any:
        base, roller, _, _, face = moved.geometry.cam(cam)
        pin = moved.point(cam.carrier, lever.pin)
        bar = moved.point(cam.follower, lever.tip) - moved.point(cam.follower, lever.pin)
        arm, prime = abs(bar), base + roller
        if cam.slides:
            start, way, aside = moved.geometry.guide(standing.slides[cam.on])
            along = moved.units[cam.carrier] * way
            above = ((pin - moved.at(cam.carrier, start)) * along.conjugate()).imag - aside
            towards = along * (-1j if above > 0 else 1j)
            resting = arb((abs(above) - prime) / arm).acos()
        else:
            gap = moved.point(cam.on, cam.pivot) - pin
            apart, towards = abs(gap), gap / abs(gap)
            if cam.tip == "flat":
                resting = arb((base + face) / apart).asin()
            else:
                resting = arb((apart**2 + arm**2 - prime**2) / (2 * apart * arm)).acos()
        wanted = towards * unit(-lever.side * (resting + radians(lift)))
        return (bar / arm * wanted.conjugate()).imag

    return off


def driven(standing: Standing, drive: Drive) -> Callable[[Moved, Any], list[Any]]:
    """A body stands as far against another as its driver says."""

    def off(moved: Moved, time: Any) -> list[Any]:
        given = moved.geometry.drive(drive, time)
        if drive.kind == "slide":
            return [moved.slid(standing, standing.slides[drive.body]).real - given]
        if drive.kind == "roll":
            straight = next(each for each in standing.straights if each.wheel == drive.body)
            through, along, *_ = moved.geometry.track(straight)
            way = moved.point(drive.body, straight.centre) - moved.at(drive.against, through)
            return [(way * (moved.units[drive.against] * along).conjugate()).real - given]
        straight = next(
            (s for s in standing.straights if (s.wheel, s.on) == (drive.body, drive.against)), None
        )
        if straight is not None:
            through, along, radius, start = moved.geometry.track(straight)
            way = moved.point(drive.body, straight.centre) - moved.at(drive.against, through)
            way = (way * (moved.units[drive.against] * along).conjugate()).real
            return [start - straight.side * way / radius - given]
        lean = moved.units[drive.body] * moved.units[drive.against].conjugate()
        return [(lean * moved.geometry.cis(given).conjugate()).imag]

    return off


def fixed_frame(poses: Mapping[str, Pose]) -> dict[str, Pose]:
    """Poses with the frame's."""
    return {FRAME: (arb(0), arb(0), arb(0)), **poses}
