"""Profiles of cams over a whole turn: the envelope of the follower, and its pressure angles.

The angle θ of the cam runs over one turn. Places are in the cam's own axes, from its pivot, in
metres, unless a docstring names the carrier's axes. For a translating plate the coordinate (m) runs
over the law and takes the place of the angle.
"""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np
from msgspec import Struct

from graphkin.numbers.cam_motions import (
    FaceMotion,
    Rise,
    TipMotion,
    guided_face,
    guided_tip,
    level_on_path,
    lever_way,
    start_on_face,
    start_on_plate,
    start_on_tip,
    swung_face,
    swung_tip,
    upward,
)
from graphkin.numbers.dual_numbers import Dual, rate_of
from graphkin.numbers.plane import Line
from graphkin.scene.model import Cam, Scene
from graphkin.scene.quantity import Quantity
from graphkin.structure.turning import body, guide_line, metres

DRAWN = 180
"""Number of points on a profile as drawn."""
BESIDE = 0.15
"""How far a plate is drawn beyond both ends of its law, as a fraction of the law."""
EXAMINED = 3600
"""Number of angles at which a profile is examined."""


class CamProfile(Struct, frozen=True, dict=True):
    """The cam of a follower, at ``count`` angles spaced evenly over a turn, or at ``given`` angles.

    With ``second`` it is the conjugate profile, on which the follower's second roller runs.
    """

    scene: Scene
    follower: str
    count: int = EXAMINED
    given: Any = None
    second: bool = False

    @property
    def cam(self) -> Cam:
        return self.scene.cams[self.follower]

    @cached_property
    def angles(self) -> Any:
        """The angles of the cam's axis, in radians; for a plate its coordinates, in metres."""
        if self.given is not None:
            return np.asarray(self.given)
        if self.cam.slides:
            start, whole = (float(q.si(self.scene.values)) for q in (self.cam.start, self.whole))
            way = np.linspace(-BESIDE, 1 + BESIDE, self.count)
            return start + self.cam.sense * whole * way
        return np.arange(self.count) * (2 * np.pi / self.count)

    @property
    def whole(self) -> Quantity:
        """The angle or coordinate at which the law ends."""
        return self.cam.law[-1].to

    @property
    def law_angles(self) -> Any:
        """The angles along the law, in degrees from 0 to 360; for a plate lengths in metres."""
        start = self.cam.start.si(self.scene.values)
        if self.cam.slides:
            return self.cam.sense * (self.angles - float(start))
        return np.degrees(self.cam.sense * (self.angles - start)) % 360

    @cached_property
    def rise(self) -> Rise:
        """The displacement of the follower and its derivatives by the cam's angle."""
        if self.cam.slides:
            return self.cam.displacement(self.angles, self.scene.values)
        return self.cam.displacement(np.exp(1j * self.angles), self.scene.values)

    @cached_property
    def third(self) -> Any:
        """The third derivative of the displacement by the cam's angle."""
        place = self.angles if self.cam.slides else np.exp(1j * self.angles)
        moved = Dual(place, np.ones_like(place) if self.cam.slides else 1j * place)
        return rate_of(self.cam.displacement(moved, self.scene.values).bend)

    @cached_property
    def guide(self) -> tuple[complex, float]:
        """The unit vector of the guide, and how far to its left the path passes the cam's pivot."""
        scene = self.scene
        slide = scene.link(self.follower).slides[0]
        line = guide_line(scene, slide)
        pivot = self.origin
        aside = ((line.point - pivot) * line.along.conjugate()).imag
        return complex(line.along), aside + float(slide.offset.si(scene.values))

    @cached_property
    def plate(self) -> Line:
        """The path of a plate's pivot in the carrier's axes, along a unit vector."""
        slide = self.scene.link(self.cam.on).slides[0]
        line, offset = guide_line(self.scene, slide), metres(self.scene, slide.offset)
        return Line(line.point + 1j * line.along * offset, line.along)

    @property
    def origin(self) -> complex:
        """The cam's pivot in the carrier's axes; for a plate, the start of its path."""
        return (
            self.plate.point
            if self.cam.slides
            else body(self.scene, self.cam.carrier)[self.cam.pivot]
        )

    @cached_property
    def bar(self) -> tuple[complex, float]:
        """A lever's pin relative to the cam's pivot, and the length from the pin to the tip."""
        lever, fixed = self.cam.lever, body(self.scene, self.cam.carrier)
        assert lever is not None
        own = body(self.scene, self.follower)
        return fixed[lever.pin] - self.origin, abs(own[self.cam.point] - own[lever.pin])

    @cached_property
    def way(self) -> Any:
        """The unit vectors of a lever's bar in the axes of the carrier."""
        lever, (pin, arm) = self.cam.lever, self.bar
        assert lever is not None
        if self.cam.slides:
            up = upward(self.plate.along, pin)
            start = start_on_plate((pin * np.conj(up)).real, arm, self.prime)
            return lever_way(up, start, lever.side, self.rise.at)
        if self.cam.is_flat:
            start = start_on_face(pin, self.base + metres(self.scene, lever.face))
        else:
            start = start_on_tip(pin, arm, self.prime)
        return lever_way(pin, start, lever.side, self.rise.at)

    @property
    def roller(self) -> float:
        conjugate = self.cam.conjugate
        roller = conjugate.roller if self.second and conjugate else self.cam.roller
        return float(roller.si(self.scene.values))

    @property
    def is_flat(self) -> bool:
        """Whether a flat face touches the profile."""
        return self.cam.is_flat and not self.second

    @property
    def prime(self) -> float:
        """The radius of the prime circle, where the first roller's centre or a knife rests."""
        return self.base + float(self.cam.roller.si(self.scene.values))

    @property
    def base(self) -> float:
        """The radius of the base circle."""
        return float(self.cam.base.si(self.scene.values))

    @property
    def height(self) -> Any:
        """The coordinate of a follower's point along its guide, from the foot of the pivot."""
        if self.cam.slides:
            along, aside = self.guide
            path = Line(1j * along * aside, along)
            return level_on_path(path, Line(0j, self.plate.along), self.prime) + self.rise.at
        if self.cam.is_flat:
            return self.base + self.rise.at
        return np.sqrt(self.prime**2 - self.guide[1] ** 2) + self.rise.at

    @cached_property
    def tip(self) -> TipMotion:
        """The motion of the roller's centre, or of the knife edge, in the axes of the carrier."""
        rates, lever = (self.rise.rate, self.rise.bend), self.cam.lever
        if lever:
            pin, arm = self.bar
            tip = swung_tip(pin, self.beside(arm) * self.way, lever.side, *rates)
            return tip._replace(drift=self.drift)
        along, aside = self.guide
        tip = guided_tip(along, aside, self.height, *rates)._replace(drift=self.drift)
        return tip._replace(place=tip.place + self.beside(0.0) * along)

    def beside(self, arm: float) -> complex:
        """The position of the roller's centre on the follower.

        Along the bar from its pin for a lever; along the guide from the first point for a slide.
        ``arm`` is the position of the first roller's centre.
        """
        conjugate = self.cam.conjugate
        if not self.second or conjugate is None:
            return complex(arm)
        own, lever = body(self.scene, self.follower), self.cam.lever
        if lever is None:
            return complex(own[conjugate.at] - own[self.cam.point])
        bar = own[self.cam.point] - own[lever.pin]
        return complex((own[conjugate.at] - own[lever.pin]) / bar * abs(bar))

    @cached_property
    def flat(self) -> FaceMotion:
        """The motion of the flat face in the axes of the carrier."""
        rates, lever = (self.rise.rate, self.rise.bend), self.cam.lever
        if lever:
            face = metres(self.scene, lever.face)
            return swung_face(self.bar[0], self.way, face, lever.side, *rates)
        return guided_face(self.guide[0], self.height, *rates)

    @property
    def drift(self) -> complex | None:
        """The unit vector of a plate's path, in the carrier's axes; None where the cam turns."""
        return complex(self.plate.along) if self.cam.slides else None

    @cached_property
    def inward(self) -> complex:
        """The quarter turn from the tangent of the pitch curve towards the inside of the cam."""
        if not self.cam.slides:
            return -1j
        toward = self.bar[0] if self.cam.lever else self.guide[0]
        return 1j if (toward / self.plate.along).imag > 0 else -1j

    @cached_property
    def outline(self) -> Any:
        """The points of the profile in the cam's axes."""
        if self.is_flat:
            place = self.flat.contact
        else:
            way = self.tip.way
            place = self.tip.place + self.inward * way * (self.roller / abs(way))
        if self.cam.slides:
            return self.closed(place / self.plate.along - self.angles)
        return place * np.exp(-1j * self.angles)

    def closed(self, outline: Any) -> Any:
        """The profile of a plate with its side edges, down to the path of its point."""
        return np.concatenate([outline, [outline[-1].real, outline[0].real]])

    @property
    def reach(self) -> float:
        """The largest distance of the profile from the pivot."""
        return float(abs(self.outline).max())

    @property
    def face(self) -> float:
        """The length of a flat face: to both sides of the pivot's foot, or from the pin."""
        if self.cam.lever is None:
            return float(abs(self.flat.slope).max())
        return float(((self.flat.contact - self.bar[0]) * self.way.conj()).real.max())

    @property
    def pressure(self) -> Any:
        """The pressure angles in degrees, between the common normal and the path of the tip."""
        lever = self.cam.lever
        if self.is_flat:
            if lever is None:
                return np.zeros(len(self.angles))
            arm = self.flat.contact - self.bar[0]
            return abs(np.degrees(np.angle(self.flat.normal / (-1j * lever.side * arm))))
        if lever:
            bar = self.beside(self.bar[1])
            along = -1j * lever.side * self.way * (bar / abs(bar))
        else:
            along = self.guide[0]
        angle = abs(np.degrees(np.angle(1j * self.tip.way / along)))
        return np.minimum(angle, 180 - angle)

    @property
    def bend(self) -> Any:
        """The curvature of the pitch curve; under a flat face, the radius of the profile instead.

        The curvature is positive where the curve is convex.
        """
        if self.is_flat:
            return self.flat.radius
        way = self.tip.way
        across = (way.conj() * self.tip.turn).imag
        return self.inward.imag * across / abs(way) ** 3

    @property
    def radius(self) -> Any:
        """The radius of curvature of the profile at each angle (m), positive where it is convex."""
        with np.errstate(divide="ignore"):
            return self.bend if self.is_flat else 1 / self.bend - self.roller

    @property
    def sharpest(self) -> tuple[float, float]:
        """The least radius of curvature of the convex profile (m), and the angle of the law there.

        The radius is zero or negative where the profile is undercut.
        """
        bend = self.bend
        number = int(bend.argmin() if self.is_flat else bend.argmax())
        return float(self.radius[number]), float(self.law_angles[number])

    @property
    def steepest(self) -> tuple[float, float]:
        """The largest pressure angle and the angle of the law where it occurs, both in degrees."""
        number = int(self.pressure.argmax())
        return float(self.pressure[number]), float(self.law_angles[number])


def profiles_of(scene: Scene, follower: str, count: int = EXAMINED) -> list[CamProfile]:
    """The profile of a follower's cam, and the conjugate profile where it has a second roller."""
    both = (False, True) if scene.cams[follower].conjugate else (False,)
    return [CamProfile(scene, follower, count, second=second) for second in both]
