"""Profiles of cams over a whole turn: the envelope of the follower, and how well it lifts.

The angle θ of the cam runs over a turn; places are counted from the cam's pivot, in the cam's own
axes (m), unless the axes of the frame are named.
"""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np
from msgspec import Struct

from graphkin.numbers.cam_followers import (
    FaceMotion,
    TipMotion,
    guided_face,
    guided_tip,
    lever_way,
    start_on_face,
    start_on_tip,
    swung_face,
    swung_tip,
)
from graphkin.numbers.cam_motions import Rise
from graphkin.scene.model import FRAME, Cam, Scene
from graphkin.structure.link_axes import body, guide_line, metres

DRAWN = 180
"""Corners of a profile as it is drawn."""
EXAMINED = 3600
"""Angles at which a profile is examined."""


class CamProfile(Struct, frozen=True, dict=True):
    """The cam of a follower, at ``count`` angles evenly over a turn, or at those that are given.

    With ``second`` it is the conjugate profile, on which the follower's second roller runs.
    """

    scene: Scene
    follower: str
    count: int = EXAMINED
    given: Any = None
    second: bool = False

    @property
    def cam(self) -> Cam:
        """The cam as written."""
        return self.scene.cams[self.follower]

    @cached_property
    def angles(self) -> Any:
        """The angles of the cam's axis, in radians."""
        if self.given is not None:
            return np.asarray(self.given)
        return np.arange(self.count) * (2 * np.pi / self.count)

    @property
    def law_angles(self) -> Any:
        """The angles from which the law counts, in degrees from 0 to 360."""
        start = self.cam.start.si(self.scene.values)
        return np.degrees(self.cam.sense * (self.angles - start)) % 360

    @cached_property
    def rise(self) -> Rise:
        """The displacement of the follower and its derivatives by the cam's angle."""
        return self.cam.displacement(np.exp(1j * self.angles), self.scene.values)

    @cached_property
    def guide(self) -> tuple[complex, float]:
        """The unit vector of the guide, and how far to its left the path passes the cam's pivot."""
        scene = self.scene
        slide = scene.link(self.follower).slides[0]
        line = guide_line(scene, slide)
        pivot = body(scene, slide.on)[self.cam.pivot]
        aside = ((line.point - pivot) * line.along.conjugate()).imag
        return complex(line.along), aside + float(slide.offset.si(scene.values))

    @cached_property
    def bar(self) -> tuple[complex, float]:
        """The pin of a lever from the cam's pivot, and its length from there to the tip."""
        lever, fixed = self.cam.lever, body(self.scene, FRAME)
        assert lever is not None
        own = body(self.scene, self.follower)
        return fixed[lever.pin] - fixed[self.cam.pivot], abs(own[self.cam.point] - own[lever.pin])

    @cached_property
    def way(self) -> Any:
        """The unit vectors of a lever in the axes of the frame."""
        lever, (pin, arm) = self.cam.lever, self.bar
        assert lever is not None
        if self.cam.is_flat:
            start = start_on_face(pin, self.base + metres(self.scene, lever.face))
        else:
            start = start_on_tip(pin, arm, self.prime)
        return lever_way(pin, start, lever.side, self.rise.at)

    @property
    def roller(self) -> float:
        """The radius of the roller."""
        conjugate = self.cam.conjugate
        roller = conjugate.roller if self.second and conjugate else self.cam.roller
        return float(roller.si(self.scene.values))

    @property
    def is_flat(self) -> bool:
        """Whether a face touches the profile."""
        return self.cam.is_flat and not self.second

    @property
    def prime(self) -> float:
        """The radius on which the first roller's centre rests, or the knife's edge."""
        return self.base + float(self.cam.roller.si(self.scene.values))

    @property
    def base(self) -> float:
        """The radius of the base circle."""
        return float(self.cam.base.si(self.scene.values))

    @property
    def height(self) -> Any:
        """How far a sliding follower's point stands along the guide from the foot of the pivot."""
        if self.cam.is_flat:
            return self.base + self.rise.at
        return np.sqrt(self.prime**2 - self.guide[1] ** 2) + self.rise.at

    @cached_property
    def tip(self) -> TipMotion:
        """The roller's centre, or the knife's edge, in the axes of the frame."""
        rates, lever = (self.rise.rate, self.rise.bend), self.cam.lever
        if lever:
            pin, arm = self.bar
            return swung_tip(pin, self.beside(arm) * self.way, lever.side, *rates)
        along, aside = self.guide
        tip = guided_tip(along, aside, self.height, *rates)
        return tip._replace(place=tip.place + self.beside(0.0) * along)

    def beside(self, arm: float) -> complex:
        """Where the roller's centre lies on the follower: from its pin along the bar, or from the
        first point along the guide; ``arm`` is where the first roller's does."""
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
        """The flat face, in the axes of the frame."""
        rates, lever = (self.rise.rate, self.rise.bend), self.cam.lever
        if lever:
            face = metres(self.scene, lever.face)
            return swung_face(self.bar[0], self.way, face, lever.side, *rates)
        return guided_face(self.guide[0], self.height, *rates)

    @cached_property
    def outline(self) -> Any:
        """The places of the profile in the cam's axes."""
        if self.is_flat:
            place = self.flat.contact
        else:
            way = self.tip.way
            place = self.tip.place - 1j * way * (self.roller / abs(way))
        return place * np.exp(-1j * self.angles)

    @property
    def reach(self) -> float:
        """The farthest that the profile comes from the pivot."""
        return float(abs(self.outline).max())

    @property
    def face(self) -> float:
        """How far a flat face must reach: both ways from the foot of the pivot, or from the pin."""
        if self.cam.lever is None:
            return float(abs(self.flat.slope).max())
        return float(((self.flat.contact - self.bar[0]) * self.way.conj()).real.max())

    @property
    def pressure(self) -> Any:
        """The pressure angle at each angle, in degrees: of the common normal with the tip's way."""
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
        """The curvature of the pitch curve, or the radius of a profile under a flat face.

        A curvature is positive where the curve is convex.
        """
        if self.is_flat:
            return self.flat.radius
        way = self.tip.way
        return -(way.conj() * self.tip.turn).imag / abs(way) ** 3

    @property
    def radius(self) -> Any:
        """The radius of curvature of the profile at each angle (m), positive where it is convex."""
        with np.errstate(divide="ignore"):
            return self.bend if self.is_flat else 1 / self.bend - self.roller

    @property
    def sharpest(self) -> tuple[float, float]:
        """The least radius of curvature of the profile where it is convex (m), and at which law's
        angle; nought or less where it is undercut."""
        bend = self.bend
        number = int(bend.argmin() if self.is_flat else bend.argmax())
        return float(self.radius[number]), float(self.law_angles[number])

    @property
    def steepest(self) -> tuple[float, float]:
        """The largest pressure angle, and at which angle of the law, in degrees."""
        number = int(self.pressure.argmax())
        return float(self.pressure[number]), float(self.law_angles[number])


def profiles_of(scene: Scene, follower: str, count: int = EXAMINED) -> list[CamProfile]:
    """The profile of a follower's cam, and the conjugate one where it has a second roller."""
    both = (False, True) if scene.cams[follower].conjugate else (False,)
    return [CamProfile(scene, follower, count, second=second) for second in both]


def profiles_along(scene: Scene, turned: str, angles: Any) -> dict[str, CamProfile]:
    """The cams on a link by their followers, at the angles of its x axis (radians)."""
    on = (follower for follower, cam in scene.cams.items() if cam.on == turned)
    return {follower: CamProfile(scene, follower, given=angles) for follower in on}
