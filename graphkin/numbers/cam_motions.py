"""The motions of cams: a rise from 0 to 1 over u from 0 to 1, with both derivatives by u.

Written for any kind of number. The forms are those of the textbooks (Norton, Cam Design and
Manufacturing Handbook): modified trapezoid and modified sine are made of pieces of sines.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from graphkin.numbers.arithmetic import Point, Real, at, below, phase, pick, sqrt, turn_by
from graphkin.numbers.plane import Line, cross, dot

BORDER = 1e-9
"""How far before the end of a piece (radians, or parts of it) the next one begins: rounding does
not decide on which side of a border a cam stands."""


HALVED = 0.0123
"""The cosine at which the halves of a turn part, where no angle of a scene is likely to be."""


class Rise(NamedTuple):
    """A displacement and its first and second derivatives by the angle."""

    at: Real
    rate: Real
    bend: Real


Motion = Callable[[Real], Rise]


def half_turn(u: Real) -> Real:
    """Pi as a number of the kind of another."""
    nought = abs(u) * 0
    return phase(at(nought - 1, nought))


def chosen(condition: object, yes: Rise, no: Rise) -> Rise:
    """One of two by a condition."""
    return Rise(*(pick(condition, *pair) for pair in zip(yes, no, strict=True)))


def before(u: Real, border: float) -> object:
    """Whether u lies before a border."""
    return below(u, abs(u) * 0 + (border - BORDER))


def uniform(u: Real) -> Rise:
    """Constant velocity."""
    return Rise(u, u * 0 + 1, u * 0)


def mirrored(u: Real, first: Motion) -> Rise:
    """A motion whose second half is the first, turned by half a turn about its middle."""
    late = first(1 - u)
    return chosen(before(u, 0.5), first(u), Rise(1 - late.at, late.rate, -late.bend))


def parabolic(u: Real) -> Rise:
    """Constant acceleration, then as much the other way."""
    return mirrored(u, lambda w: Rise(2 * w * w, 4 * w, w * 0 + 4))


def harmonic(u: Real) -> Rise:
    """Half a cosine."""
    pi = half_turn(u)
    way = turn_by(pi * u)
    return Rise((1 - way.real) / 2, pi * way.imag / 2, pi * pi * way.real / 2)


def cycloidal(u: Real) -> Rise:
    """A whole sine of acceleration."""
    pi = half_turn(u)
    way = turn_by(2 * pi * u)
    return Rise(u - way.imag / (2 * pi), 1 - way.real, 2 * pi * way.imag)


def polynomial_345(u: Real) -> Rise:
    """The polynomial 3-4-5: no acceleration at both ends."""
    v, w = 1 - u, u * (1 - u)
    lift = u * u * u * (10 - u * (15 - 6 * u))
    return Rise(lift, 30 * w * w, 60 * w * (v - u))


def polynomial_4567(u: Real) -> Rise:
    """The polynomial 4-5-6-7: no jerk at both ends either."""
    v, w = 1 - u, u * (1 - u)
    lift = u * u * u * u * (35 - u * (84 - u * (70 - 20 * u)))
    return Rise(lift, 140 * w * w * w, 420 * w * w * (v - u))


def modified_sine(u: Real) -> Rise:
    """Quick sines of acceleration in the first and last eighth, a slow one between them."""
    pi = half_turn(u)
    size, quick, slow = pi + 4, turn_by(4 * pi * u), turn_by((4 * pi * u + pi) / 3)
    peak = 4 * pi * pi / size

    def end(lift: int) -> Rise:
        at_u = (lift + pi * u - quick.imag / 4) / size
        return Rise(at_u, pi * (1 - quick.real) / size, peak * quick.imag)

    middle = Rise(
        (2 + pi * u - 9 * slow.imag / 4) / size, pi * (1 - 3 * slow.real) / size, peak * slow.imag
    )
    return chosen(before(u, 0.125), end(0), chosen(before(u, 0.875), middle, end(4)))


def modified_trapezoid(u: Real) -> Rise:
    """Constant acceleration that begins and ends in quarters of sines."""
    pi = half_turn(u)
    peak, k = 8 * pi / (pi + 2), 4 * pi

    def first(w: Real) -> Rise:
        early, late, far = turn_by(k * w), turn_by(k * (w - 0.375)), w - 0.125
        start, rate = 0.125 / k - 1 / k**2, 1 / k
        then, quicker = start + 0.25 * rate + 0.03125, rate + 0.25
        begins = Rise(w / k - early.imag / k**2, (1 - early.real) / k, early.imag)
        level = Rise(start + rate * far + far * far / 2, rate + far, w * 0 + 1)
        on = w - 0.375
        ends = Rise(
            then + quicker * on + (1 - late.real) / k**2, quicker + late.imag / k, late.real
        )
        return chosen(before(w, 0.125), begins, chosen(before(w, 0.375), level, ends))

    return mirrored(u, lambda w: Rise(*(peak * each for each in first(w))))


MOTIONS: dict[str, Motion] = {
    "uniform": uniform,
    "parabolic": parabolic,
    "harmonic": harmonic,
    "cycloidal": cycloidal,
    "3-4-5": polynomial_345,
    "4-5-6-7": polynomial_4567,
    "modified trapezoid": modified_trapezoid,
    "modified sine": modified_sine,
}
"""Every motion by its name in a scene."""


def turned(turn: Point) -> Real:
    """The angle of a unit vector from 0 to a whole turn; rounding puts none below 0.

    Each half of the turn is measured from its own middle, so that a ball meets no jump but at 0.
    """
    ahead, behind = phase(turn), phase(-turn)
    half = half_turn(ahead)
    ahead = pick(below(ahead, -abs(ahead) * 0 - BORDER), ahead + 2 * half, ahead)
    return pick(below(turn.real, abs(ahead) * 0 + HALVED), behind + half, ahead)


def splined(u: Real, rise: Real, begin: Real, finish: Real) -> Rise:
    """A cubic from 0 to ``rise`` over u from 0 to 1 with given derivatives by u at both ends."""
    v, ahead, back = 1 - u, begin - rise, rise - finish
    mixed = ahead * v + back * u
    rate = rise + (v - u) * mixed + u * v * (back - ahead)
    return Rise(rise * u + u * v * mixed, rate, 2 * (back - 2 * ahead + 3 * (ahead - back) * u))


def displaced(
    turn: Point,
    ends: Sequence[Real],
    rises: Sequence[Real],
    motions: Sequence[str],
    slopes: Sequence[tuple[Real, Real]] = (),
) -> Rise:
    """The displacement of a follower where the cam has turned by ``turn`` (a unit vector).

    The pieces end at angles ``ends`` (radians, the last a whole turn) and add up ``rises``; at a
    border the piece that begins there holds. Where ``slopes`` are given, all pieces are cubics that
    begin and finish with these, each times the angle of its piece.
    """
    return pieced(turned(turn), ends, rises, motions, slopes)


def displaced_along(
    way: Real, ends: Sequence[Real], rises: Sequence[Real], motions: Sequence[str]
) -> Rise:
    """The displacement of a follower where a plate has moved by ``way`` from where its law begins.

    The pieces end at lengths ``ends`` and add up ``rises``; the plate is level before the law and
    past it.
    """
    whole, share = ends[-1], way / ends[-1]
    inside = pieced(share, [end / whole for end in ends], rises, motions)
    found = Rise(inside.at, inside.rate / whole, inside.bend / (whole * whole))
    nought = share * 0
    before_it = Rise(rises[0] * nought, nought, nought)
    past_it = Rise(sum(rises[1:], rises[0]) + nought, nought, nought)
    found = chosen(below(share, nought + (1 - BORDER)), found, past_it)
    return chosen(below(share, nought - BORDER), before_it, found)


def pieced(
    angle: Real,
    ends: Sequence[Real],
    rises: Sequence[Real],
    motions: Sequence[str],
    slopes: Sequence[tuple[Real, Real]] = (),
) -> Rise:
    """The pieces of a law at an ``angle`` from its begin."""
    found = None
    low, start = angle * 0, angle * 0
    pieces = []
    for number, (end, rise) in enumerate(zip(ends, rises, strict=True)):
        pieces.append((low, end, start, rise, number))
        low, start = end, start + rise
    for low, end, start, rise, number in reversed(pieces):
        span = end - low
        u = (angle - low) / span
        if slopes:
            f = splined(u, rise, *slopes[number])
        else:
            f = Rise(*(rise * each for each in MOTIONS[motions[number]](u)))
        own = Rise(start + f.at, f.rate / span, f.bend / (span * span))
        found = own if found is None else chosen(below(angle, end - BORDER), own, found)
    assert found is not None
    return found


# --- how a cam's follower stands and moves by the cam's angle -------------------------------------


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
