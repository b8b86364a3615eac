"""Centres of relative motion by Kennedy's lines, and the inflection circle of a link.

Every centre is a Ratio, start + shift/size, for it may lie at infinity.
"""

from __future__ import annotations

from graphkin.construction.core.vocabulary import action
from graphkin.numbers.arithmetic import Point, Real, at, pick
from graphkin.numbers.plane import Circle, Line, Ratio, cross, crossing_sine, dot


@action("pin-centre")
def pin_centre(pin: Point) -> Ratio:
    """A pin, or the point in which a wheel touches its track, is the centre of its two links."""
    return Ratio(pin, 0 * pin, 1.0)


@action("guide-centre")
def guide_centre(point: Point, guide: Line) -> Ratio:
    """The centre of a block and what guides it: at infinity, square to the guide."""
    return Ratio(point, 1j * guide.along, 0.0)


@action("acceleration-pole")
def turned_pole(p: Point, image: Point, omega: Real, epsilon: Real) -> Ratio:
    """The point of a link without acceleration from one point's and the link's turning."""
    return Ratio(p, image, at(omega * omega, -epsilon))


@action("relative-centre")
def relative_centre(
    p: Point, image_p: Point, omega_p: Real, q: Point, image_q: Point, omega_q: Real
) -> Ratio:
    """The point of two links with one velocity on both: p + i·(v_p - v_q at p)/(their ω apart).

    p is a point of the first link, q one of the second; 8·eps of the larger distance.
    """
    there = image_q + 1j * (p - q) * omega_q
    return Ratio(p, 1j * (image_p - there), omega_p - omega_q)


@action("kennedy-line")
def kennedy_line(a: Ratio, b: Ratio) -> Line:
    """The line of two centres of three links, on which the third lies (Kennedy, Aronhold).

    It is anchored at the one that is nearer to its own start, never at infinity. Two centres at
    infinity have a line only there: its direction is nought.
    """
    nearer = abs(a.shift) * abs(b.size) <= abs(b.shift) * abs(a.size)
    start, shift, size = (pick(nearer, x, y) for x, y in zip(a, b, strict=True))
    along = (b.start - a.start) * a.size * b.size + b.shift * a.size - a.shift * b.size
    return Line(start + shift / size, along)


def meet_anywhere(m: Line, n: Line) -> Ratio:
    """Where two lines meet, at infinity when they are parallel."""
    gap = n.point - m.point
    return Ratio(m.point, cross(gap, n.along) * m.along, cross(m.along, n.along))


@action("kennedy-meet", margin=crossing_sine)
def kennedy_meet(m: Line, n: Line) -> Ratio:
    """The centre of two links, where two lines of centres meet."""
    return meet_anywhere(m, n)


@action("kennedy-endless")
def kennedy_endless(line: Line) -> Ratio:
    """The centre at infinity on a line of centres; the other line lies wholly at infinity."""
    return Ratio(line.point, line.along, 0.0)


@action("normals-meet", margin=crossing_sine)
def normals_meet(m: Line, n: Line) -> Ratio:
    """The instantaneous centre, where the normals to two velocities meet (Chasles)."""
    return meet_anywhere(m, n)


# --- the inflection circle -----------------------------------------------------------------------


@action("inflection-pole")
def inflection_pole(
    p: Point, image_p: Point, second_image_p: Point, omega: Real, epsilon: Real
) -> Ratio:
    """W = I + a_I/ω², opposite to the centre I on the circle of points whose paths are straight.

    For the point of the link at r from I the velocity is i·ω·r and the acceleration
    a_I + (i·ε - ω²)·r; they are parallel where r·a_I = ω²·r², on the circle of diameter a_I/ω².
    From any point P of the link, I = P + i·v_P/ω and ε drop out of I: W = P + (a_P - ε·v_P/ω)/ω².
    """
    size = pick(omega == 0, 1.0, omega)
    return Ratio(
        p, (omega * second_image_p - epsilon * image_p) / size, omega * omega * omega / size
    )


@action("inflection-point")
def inflection_point(
    point: Point, ray: Line, second_image: Point, p: Point, q: Point, ip: Point, iq: Point
) -> Point:
    """On the ray from a point to the instantaneous centre the part a_n/ω², a_n along the ray.

    ω is the relative velocity of the base PQ over its length. Where the ray meets the inflection
    circle, for a_n = ω²·(way to that circle) on every ray (Euler, Savary).
    """
    unit = ray.along / abs(ray.along)
    turning = abs(iq - ip) / abs(q - p)
    return point + unit * (dot(unit, second_image) / (turning * turning))


@action("inflection-square")
def inflection_square(point: Point, image: Point) -> Line:
    """Through a point of the inflection circle the perpendicular to its ray (Thales)."""
    return Line(point, image)


@action("inflection-meet", margin=crossing_sine)
def inflection_meet(m: Line, n: Line) -> Ratio:
    """The inflection pole, where the perpendiculars to two rays meet."""
    return meet_anywhere(m, n)


@action("inflection-circle")
def inflection_circle(p: Point, image_p: Point, omega: Real, pole: Ratio) -> Circle:
    """The circle on the segment from the instantaneous centre p + i·v/ω to the inflection pole."""
    centre, far = p + 1j * image_p / omega, pole.start + pole.shift / pole.size
    return Circle((centre + far) / 2, abs(far - centre) / 2)
