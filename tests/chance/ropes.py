"""Ropes, hoists and drums, wheels that no arm keeps, profiles that touch."""

from __future__ import annotations

import math

from tests.chance.groups import bar, cylinder_between, straight, wheel_body
from tests.chance.maker import LooseError, Maker
from tests.chance.records import FRAME, Touch


def centre_of(m: Maker, body: str, place: complex) -> str:
    """The point of a body at a place."""
    return next(p for p, z in m.standing.bodies[body].points.items() if z == place)


def strand(m: Maker, on: str, place: complex, along: complex) -> str:
    """A taut strand that moves along itself: a block on a guide of a body."""
    return m.block({m.name(): place + along * m.length() * m.sign()}, on, along)


def hoist(m: Maker) -> None:
    """A driven drum, a strand, and a moving pulley in its bight whose other end is tied.

    The strand is tied to the body that carries the drum.
    """
    on, along, side = m.any_body(), m.direction(), m.sign()
    centre = m.anchor(on)
    drum = wheel_body(m, centre)
    m.turn(drum, on)
    radius, own = m.length(), m.length()
    edge = centre[1] - 1j * along * side * radius
    rope = strand(m, on, edge, along)
    straight(m, drum, centre[0], rope, along, radius, side).kept = True
    place = edge + along * m.length() * m.sign() + 1j * along * own * m.sign()
    pulley = wheel_body(m, (m.name(), place))
    pin = centre_of(m, pulley, place)
    over = 1 if ((place - edge) * along.conjugate()).imag > 0 else -1
    straight(m, pulley, pin, rope, along, own, over)
    straight(m, pulley, pin, on, along, own, -over).kept = True
    m.standing.bodies[pulley].wheels.pop()


def differential(m: Maker) -> None:
    """Weston's hoist: two pulleys of one driven link, two strands, and a pulley between these."""
    on, along = m.any_body(), m.direction()
    centre = m.anchor(on)
    upper = wheel_body(m, centre)
    m.turn(upper, on)
    large = m.length()
    small = large * m.rng.uniform(0.3, 0.9)
    own = (large + small) / 2
    ropes = []
    for side, radius in ((1, large), (-1, small)):
        edge = centre[1] - 1j * along * side * radius
        ropes.append(strand(m, on, edge, along))
        straight(m, upper, centre[0], ropes[-1], along, radius, side).kept = True
    place = centre[1] - 1j * along * (large - small) / 2 + along * m.length() * m.sign()
    pulley = wheel_body(m, (m.name(), place))
    pin = centre_of(m, pulley, place)
    for number, (rope, side) in enumerate(zip(ropes, (1, -1), strict=True)):
        straight(m, pulley, pin, rope, along, own, side).kept = number == 1
    m.standing.bodies[pulley].wheels.pop()


def spool(m: Maker) -> None:
    """A driven wheel on a track, and a rack on another rim of it or on the same."""
    on, along, side = m.any_body(), m.direction(), m.sign()
    place = m.somewhere() + m.vector()
    wheel = wheel_body(m, (m.name(), place))
    centre = centre_of(m, wheel, place)
    radius = m.length()
    found = straight(m, wheel, centre, on, along, radius, side)
    m.drive("roll", wheel, on, ((place - found.through) * along.conjugate()).real)
    own = radius if m.coin() else radius * m.rng.uniform(0.3, 0.9)
    rack = strand(m, on, place + 1j * along * side * own, along)
    straight(m, wheel, centre, rack, along, own, -side).kept = True
    if own == radius:
        m.standing.bodies[wheel].wheels.pop()


def frame_drum(m: Maker) -> None:
    """A bar that rolls on a drum of the frame: turned by a driver, or its end led by a rod."""
    if m.standing.bodies[FRAME].wheels:
        raise LooseError
    centre, place = m.anchor(FRAME)
    end = m.name(), place + m.vector()
    track = m.body({m.name(): place + m.vector(), end[0]: end[1]})
    turned = m.coin()
    if turned:
        m.turn(track, FRAME)
    found = straight(m, FRAME, centre, track, m.direction(), m.length())
    if turned:
        return
    if abs(m.angle(track) + math.radians(found.start)) > 3:  # a bar on pins counts from there
        raise LooseError
    known = m.any_body(but=[track])
    foot = end[1] + m.vector()
    bar(m, (m.point(known, foot), foot), end)


def rope(m: Maker) -> None:
    """A rope from a drum to a pin that moves: the drum of a body rolls on the strand.

    The pin belongs to a body that stands, so that the drum follows from it.
    """
    a = m.any_body()
    pin = m.anchor(a)
    on = m.any_body(but=[a])
    way = m.vector()
    place = pin[1] + way
    drum = wheel_body(m, (m.point(on, place), place))
    straight(m, drum, centre_of(m, drum, place), m.body(dict([pin])), m.beside(way), m.length())


def rope_levers(m: Maker) -> None:
    """A rope from a drum, fixed to a driven lever, to the end of a rocker."""
    a = m.any_body()
    pivot = m.anchor(a)
    place = pivot[1] + m.vector()
    drum_at = m.name(), place
    lever = bar(m, pivot, drum_at)
    m.turn(lever, a if m.coin() else FRAME)
    end = m.name(), place + m.vector()
    strand_ = m.body(dict([end]))
    found = straight(m, lever, drum_at[0], strand_, m.beside(end[1] - place), m.length())
    if abs(math.radians(found.start) - m.angle(lever)) > 3:
        raise LooseError
    b = m.any_body(but=[lever, strand_])
    foot = end[1] + m.vector()
    bar(m, (m.point(b, foot), foot), end)


def free_wheel(m: Maker) -> None:
    """A wheel in a ring, or on another wheel, without an arm.

    A driver turns what keeps it there or the wheel itself, or a rod leads a point of its.
    """
    hosts = [n for n in m.bodies() if not m.standing.bodies[n].wheels]
    on = m.rng.choice(hosts)
    centre = m.anchor(on)
    inside, own = m.coin(0.7), m.length()
    other = own * m.rng.uniform(1.4, 4) if inside else m.length()
    apart = other - own if inside else other + own
    place = centre[1] + apart * m.direction()
    pin = m.name(), place
    wheel = wheel_body(m, pin)
    arm = m.unwritten({centre[0]: centre[1], pin[0]: place}, apart)
    m.standing.bodies[on].wheels.append((centre[0], -other if inside else other))
    m.standing.bodies[wheel].wheels.append((pin[0], own))
    turned = {arm: m.rng.uniform(-1, 1), on: 0.0 if on == FRAME else m.rng.uniform(-1, 1)}
    signed = -other if inside else other
    turned[wheel] = turned[arm] - signed / own * (turned[on] - turned[arm])
    how = m.rng.choice(("arm", "wheel", "rod"))
    if how == "rod":
        spot = place + m.vector()
        rod = m.point(wheel, spot), spot
        known = m.any_body(but=[on, wheel])
        bar(m, rod, m.anchor(known))
    else:
        m.turn(arm if how == "arm" else wheel, on if m.coin() else FRAME)
    m.geared((wheel, on, arm), (pin[0], centre[0]), (own, signed), turned)


def touching(m: Maker) -> None:
    """Profiles of a body that stands and of a rocker or a follower touch: a bar at the instant."""
    a = m.any_body()
    start = m.anchor(a)
    radii = m.length(), m.length()
    inside = m.coin(0.3)
    if inside:
        small, large = sorted(radii)
        radii = small, max(large, 1.3 * small)
    touch = Touch("", "", a, ("", start[0]), radii, inside)
    way = touch.apart * m.direction()
    centre = m.name(), start[1] + way
    touch.link = m.unwritten({centre[0]: centre[1], start[0]: start[1]}, touch.apart)
    touch.centres = centre[0], start[0]
    b = m.any_body(but=[a])
    if m.coin(0.7):
        foot = centre[1] + m.length() * m.across(way)
        touch.own = bar(m, (m.point(b, foot), foot), centre)
    else:
        touch.own = m.block(dict([centre]), b, m.beside(way))
    m.standing.touches.append(touch)


def platform(m: Maker) -> None:
    """A plate on three driven cylinders."""
    known = m.bodies()
    place = m.somewhere() + m.vector()
    plate = m.body({m.name(): place, m.name(): place + m.vector()})
    for _ in range(3):
        spot = place + m.vector()
        pin = m.point(plate, spot), spot
        foot = m.anchor(m.any_body([n for n in m.bodies() if n not in known]))
        cylinder_between(m, foot, pin)


def by_time(m: Maker) -> None:
    """A crank or a block that a law of time drives."""
    on = m.any_body()
    pivot, place = m.anchor(on)
    if m.coin():
        name = bar(m, (pivot, place), (m.name(), place + m.vector()))
        m.turn(name, on)
        swing = m.rng.uniform(5, 60)
    else:
        along = m.direction()
        name = m.block({m.name(): place + m.vector()}, on, along)
        m.drive("slide", name, on, m.slide_coordinate(name))
        swing = m.length()
    drive = m.standing.drives[-1]
    m.standing.moment = m.standing.moment or m.rng.uniform(0.1, 2)
    rate = 360 * abs(m.rate())
    drive.law, drive.acceleration = (swing, rate), 0.0
    drive.speed = swing * math.radians(rate) * (math.radians(1) if drive.kind == "turn" else 1)
