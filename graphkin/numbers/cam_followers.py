"""How a cam's follower stands and moves by the cam's angle, and the centre of curvature under it.

Places are counted from the cam's pivot in the axes of its frame, derivatives are by the cam's
angle θ. In the axes of the cam the tip at w runs along the pitch curve w·exp(-iθ), whose tangent is
t = w' - iw and whose bend is m = w" - 2iw' - w, both turned back with the frame: the centre of
curvature lies at w + it|t|²/(t×m). A face with the unit normal n at the distance p from the pivot
envelops the profile; with α the angle of n in the cam its centre lies at in·dp/dα - n·d²p/dα².
Of a cam that slides along the unit vector e all is counted by its coordinate: t = w' - e, m = w".
Written for any kind of number (Norton, Cam Design and Manufacturing Handbook; Rothbart, Cams).
"""

from __future__ import annotations

from typing import NamedTuple

from graphkin.numbers.arithmetic import Point, Real, at, below, pick, sqrt, turn_by
from graphkin.numbers.plane import Line, cross, dot


class TipMotion(NamedTuple):
    """The place of a roller's centre or a knife's edge, and its derivatives.

    ``drift`` is the unit vector along which the cam slides; None where it turns.
    """

    place: Point
    rate: Point
    bend: Point
    drift: Point | None = None

    @property
    def way(self) -> Point:
        """Tangent of the pitch curve."""
        return self.rate - (1j * self.place if self.drift is None else self.drift)

    @property
    def turn(self) -> Point:
        """Derivative of the tangent in the cam."""
        return self.bend if self.drift is not None else self.bend - 2j * self.rate - self.place

    @property
    def centre(self) -> Point:
        """The centre of curvature of the pitch curve."""
        way = self.way
        return self.place + 1j * way * (dot(way, way) / cross(way, self.turn))


class FaceMotion(NamedTuple):
    """A flat face: its unit ``normal``, its distance ``gap`` from the pivot, how these change.

    ``spin`` and ``twist`` are the derivatives of the normal's angle, ``rate`` and ``bend`` those of
    the distance.
    """

    normal: Point
    gap: Real
    spin: Real
    twist: Real
    rate: Real
    bend: Real

    @property
    def slope(self) -> Real:
        """dp/dα: how far beside the foot of the pivot the face touches the cam."""
        return self.rate / (self.spin - 1)

    @property
    def second(self) -> Real:
        """d²p/dα²."""
        against = self.spin - 1
        return (self.bend * against - self.rate * self.twist) / against**3

    @property
    def contact(self) -> Point:
        """Where the face touches the cam."""
        return self.gap * self.normal + 1j * self.normal * self.slope

    @property
    def radius(self) -> Real:
        """The radius of curvature of the profile there, positive where it is convex."""
        return self.gap + self.second

    @property
    def centre(self) -> Point:
        """Its centre of curvature."""
        return 1j * self.normal * self.slope - self.normal * self.second


def guided_tip(along: Point, aside: Real, height: Real, rate: Real, bend: Real) -> TipMotion:
    """A tip that a guide along a unit vector leads at ``aside`` to the left of the pivot."""
    return TipMotion(height * along + 1j * along * aside, rate * along, bend * along)


def guided_face(along: Point, height: Real, rate: Real, bend: Real) -> FaceMotion:
    """A face square to the guide on which it slides."""
    return FaceMotion(along, height, rate * 0, bend * 0, rate, bend)


def swung_tip(pin: Point, arm: Point, side: float, rate: Real, bend: Real) -> TipMotion:
    """A tip at the end of the ``arm`` of a lever about ``pin``; ``side`` +1 left of the pins' line.

    The line leads from the cam's pivot to the lever's pin; the lever lifts away from the cam.
    """
    spin = -side * rate
    return TipMotion(pin + arm, 1j * arm * spin, 1j * arm * (-side * bend) - arm * (spin * spin))


def swung_face(
    pin: Point, way: Point, face: Real, side: float, rate: Real, bend: Real
) -> FaceMotion:
    """A face along the unit vector ``way`` of a lever about ``pin``, ``face`` nearer to the cam."""
    normal, spin, twist = -1j * way * side, -side * rate, -side * bend
    across, off = dot(1j * normal, pin), dot(normal, pin)
    gap = off - face
    return FaceMotion(normal, gap, spin, twist, spin * across, twist * across - spin * spin * off)


def lever_way(pin: Point, start: Point, side: float, lift: Real) -> Point:
    """The unit vector of a lever that has swung by ``lift`` from where it rests on the base circle.

    ``start`` is its direction there, from that of the pins' line backwards, as of an angle
    counter-clockwise.
    """
    begins = start if side < 0 else start.conjugate()
    return -pin / abs(pin) * begins * turn_by(-side * lift)


def start_on_tip(pin: Point, arm: Real, prime: Real) -> Point:
    """The unit vector of the angle at the pin of a triangle with the sides pin, arm and prime."""
    bar = abs(pin)
    cosine = (bar * bar + arm * arm - prime * prime) / (2 * bar * arm)
    return at(cosine, sqrt((1 - cosine) * (1 + cosine)))


def upward(along: Point, toward: Point) -> Point:
    """The unit vector square to ``along``, to the side on which a vector points."""
    square = 1j * along / abs(along)
    side = dot(square, toward)
    return pick(below(side, side * 0), -square, square)


def level_on_path(path: Line, plate: Line, prime: Real) -> Real:
    """How far along its path a tip rests on a plate, ``prime`` above the path of this.

    Counted from the path's point.
    """
    along = path.along / abs(path.along)
    up = upward(plate.along, along)
    return (prime - dot(up, path.point - plate.point)) / dot(up, along)


def start_on_plate(above: Real, arm: Real, prime: Real) -> Point:
    """The unit vector of the angle at the pin, ``above`` a plate's path, from square to it."""
    cosine = (above - prime) / arm
    return at(cosine, sqrt((1 - cosine) * (1 + cosine)))


def start_on_face(pin: Point, gap: Real) -> Point:
    """The unit vector of the angle at the pin of a line that passes the cam's pivot at ``gap``."""
    sine = gap / abs(pin)
    return at(sqrt((1 - sine) * (1 + sine)), sine)
