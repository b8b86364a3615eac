"""The motions of cams: a rise from 0 to 1 over u from 0 to 1, with both derivatives by u.

The functions accept any kind of number. The formulas are those of the textbooks (Norton, Cam Design
and Manufacturing Handbook). Modified trapezoid and modified sine are made of pieces of sines.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from graphkin.numbers.arithmetic import Point, Real, at, below, phase, pick, sqrt, turn_by
from graphkin.numbers.plane import Line, cross, dot

BORDER = 1e-9
"""How far (radians, or shares of a piece) before the end of a piece the next one begins.

Rounding then does not decide on which side of a border a cam is.
"""


HALVED = 0.0123
"""The cosine at which a turn is split into halves; a scene's angle is unlikely to be there."""


class Rise(NamedTuple):
    """A displacement and its first and second derivatives by the angle."""

    at: Real
    rate: Real
    bend: Real


Motion = Callable[[Real], Rise]


def half_turn(u: Real) -> Real:
    """Pi as a number of the same kind as ``u``."""
    zero = abs(u) * 0
    return phase(at(zero - 1, zero))


def chosen(condition: object, yes: Rise, no: Rise) -> Rise:
    """One of two rises, by a condition."""
    return Rise(*(pick(condition, *pair) for pair in zip(yes, no, strict=True)))


def before(u: Real, border: float) -> object:
    """Whether u is before a border."""
    return below(u, abs(u) * 0 + (border - BORDER))


def uniform(u: Real) -> Rise:
    """Constant velocity."""
    return Rise(u, u * 0 + 1, u * 0)


def mirrored(u: Real, first: Motion) -> Rise:
    """A motion whose second half is its first half, rotated by 180° about the middle."""
    late = first(1 - u)
    return chosen(before(u, 0.5), first(u), Rise(1 - late.at, late.rate, -late.bend))


def parabolic(u: Real) -> Rise:
    """Constant acceleration, then the same deceleration."""
    return mirrored(u, lambda w: Rise(2 * w * w, 4 * w, w * 0 + 4))


def harmonic(u: Real) -> Rise:
    """Half a period of a cosine."""
    pi = half_turn(u)
    way = turn_by(pi * u)
    return Rise((1 - way.real) / 2, pi * way.imag / 2, pi * pi * way.real / 2)


def cycloidal(u: Real) -> Rise:
    """A full period of a sine as acceleration."""
    pi = half_turn(u)
    way = turn_by(2 * pi * u)
    return Rise(u - way.imag / (2 * pi), 1 - way.real, 2 * pi * way.imag)


def polynomial_345(u: Real) -> Rise:
    """The polynomial 3-4-5: zero acceleration at both ends."""
    v, w = 1 - u, u * (1 - u)
    lift = u * u * u * (10 - u * (15 - 6 * u))
    return Rise(lift, 30 * w * w, 60 * w * (v - u))


def polynomial_4567(u: Real) -> Rise:
    """The polynomial 4-5-6-7: zero acceleration and jerk at both ends."""
    v, w = 1 - u, u * (1 - u)
    lift = u * u * u * u * (35 - u * (84 - u * (70 - 20 * u)))
    return Rise(lift, 140 * w * w * w, 420 * w * w * (v - u))


def modified_sine(u: Real) -> Rise:
    """Sine acceleration: fast in the first and last eighth, slow between them."""
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
    """Constant acceleration that begins and ends with quarter sines."""
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
"""The motions by their names in a scene."""


def turned(turn: Point) -> Real:
    """The angle of a unit vector, from 0 to a full turn; rounding puts none below 0.

    Each half of the turn is measured from its own middle, so that a ball has a jump only at 0.
    """
    ahead, behind = phase(turn), phase(-turn)
    half = half_turn(ahead)
    ahead = pick(below(ahead, -abs(ahead) * 0 - BORDER), ahead + 2 * half, ahead)
    return pick(below(turn.real, abs(ahead) * 0 + HALVED), behind + half, ahead)


def splined(u: Real, rise: Real, begin: Real, finish: Real) -> Rise:
    """A cubic from 0 to ``rise`` over u from 0 to 1, with given derivatives by u at both ends."""
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
    """The displacement of a follower for a cam turned by ``turn`` (a unit vector).

    The pieces end at the angles ``ends`` (radians, the last a full turn), and ``rises`` add up. At
    a border, the piece that begins there counts. With ``slopes``, all pieces are cubics with these
    end derivatives, each times the angle of its piece.
    """
    return pieced(turned(turn), ends, rises, motions, slopes)


def displaced_along(
    way: Real, ends: Sequence[Real], rises: Sequence[Real], motions: Sequence[str]
) -> Rise:
    """The displacement of a follower for a plate moved by ``way`` from the start of its law.

    The pieces end at the lengths ``ends``, and ``rises`` add up. The plate is level before the law
    and after it.
    """
    whole, share = ends[-1], way / ends[-1]
    inside = pieced(share, [end / whole for end in ends], rises, motions)
    found = Rise(inside.at, inside.rate / whole, inside.bend / (whole * whole))
    zero = share * 0
    before_it = Rise(rises[0] * zero, zero, zero)
    past_it = Rise(sum(rises[1:], rises[0]) + zero, zero, zero)
    found = chosen(below(share, zero + (1 - BORDER)), found, past_it)
    return chosen(below(share, zero - BORDER), before_it, found)


def pieced(
    angle: Real,
    ends: Sequence[Real],
    rises: Sequence[Real],
    motions: Sequence[str],
    slopes: Sequence[tuple[Real, Real]] = (),
) -> Rise:
    """The displacement by the pieces of a law, at an ``angle`` from the law's start."""
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


# --- the follower's position and motion by the cam's angle ----------------------------------------


class TipMotion(NamedTuple):
    """The position of a roller's centre or a knife edge, and its derivatives.

    ``drift`` is the unit vector of a sliding cam's direction; None for a cam that turns.
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
        """Derivative of the tangent in the cam's axes."""
        return self.bend if self.drift is not None else self.bend - 2j * self.rate - self.place

    @property
    def centre(self) -> Point:
        """Centre of curvature of the pitch curve."""
        way = self.way
        return self.place + 1j * way * (dot(way, way) / cross(way, self.turn))


class FaceMotion(NamedTuple):
    """A flat face: its unit ``normal``, its distance ``gap`` from the pivot, and their derivatives.

    ``spin`` and ``twist`` are the derivatives of the normal's angle; ``rate`` and ``bend`` are
    those of the distance.
    """

    normal: Point
    gap: Real
    spin: Real
    twist: Real
    rate: Real
    bend: Real

    @property
    def slope(self) -> Real:
        """dp/dα: the distance along the face from the pivot's foot to the contact point."""
        return self.rate / (self.spin - 1)

    @property
    def second(self) -> Real:
        """The second derivative d²p/dα²."""
        against = self.spin - 1
        return (self.bend * against - self.rate * self.twist) / against**3

    @property
    def contact(self) -> Point:
        """Contact point of the face and the cam."""
        return self.gap * self.normal + 1j * self.normal * self.slope

    @property
    def radius(self) -> Real:
        """Radius of curvature of the profile at the contact, positive where it is convex."""
        return self.gap + self.second

    @property
    def centre(self) -> Point:
        """Centre of curvature of the profile at the contact."""
        return 1j * self.normal * self.slope - self.normal * self.second


def guided_tip(along: Point, aside: Real, height: Real, rate: Real, bend: Real) -> TipMotion:
    """A tip on a guide along a unit vector, at ``aside`` to the left of the pivot."""
    return TipMotion(height * along + 1j * along * aside, rate * along, bend * along)


def guided_face(along: Point, height: Real, rate: Real, bend: Real) -> FaceMotion:
    """A face perpendicular to the guide on which it slides."""
    return FaceMotion(along, height, rate * 0, bend * 0, rate, bend)


def swung_tip(pin: Point, arm: Point, side: float, rate: Real, bend: Real) -> TipMotion:
    """A tip at the end of a lever's ``arm`` about ``pin``; ``side`` is +1 left of the pins' line.

    The line runs from the cam's pivot to the lever's pin. The lever lifts away from the cam.
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
    """The unit vector of a lever that has swung by ``lift`` from its rest on the base circle.

    ``start`` is its direction at rest, relative to the reversed line of the pins, as a
    counter-clockwise angle.
    """
    begins = start if side < 0 else start.conjugate()
    return -pin / abs(pin) * begins * turn_by(-side * lift)


def start_on_tip(pin: Point, arm: Real, prime: Real) -> Point:
    """The unit vector of the angle at the pin in a triangle with the sides pin, arm and prime."""
    bar = abs(pin)
    cosine = (bar * bar + arm * arm - prime * prime) / (2 * bar * arm)
    return at(cosine, sqrt((1 - cosine) * (1 + cosine)))


def upward(along: Point, toward: Point) -> Point:
    """The unit vector perpendicular to ``along``, on the side of ``toward``."""
    square = 1j * along / abs(along)
    side = dot(square, toward)
    return pick(below(side, side * 0), -square, square)


def level_on_path(path: Line, plate: Line, prime: Real) -> Real:
    """The distance along its path at which a tip rests on a plate.

    The tip is then ``prime`` above the plate's path.

    The distance is measured from the path's point.
    """
    along = path.along / abs(path.along)
    up = upward(plate.along, along)
    return (prime - dot(up, path.point - plate.point)) / dot(up, along)


def start_on_plate(above: Real, arm: Real, prime: Real) -> Point:
    """The unit vector of a lever's angle to the normal, its pin ``above`` a plate's path."""
    cosine = (above - prime) / arm
    return at(cosine, sqrt((1 - cosine) * (1 + cosine)))


def start_on_face(pin: Point, gap: Real) -> Point:
    """The unit vector of the angle at the pin of a line that passes the cam's pivot at ``gap``."""
    sine = gap / abs(pin)
    return at(sqrt((1 - sine) * (1 + sine)), sine)
