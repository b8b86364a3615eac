"""Groups that can be hung on what stands: drivers, dyads, higher groups, wheels."""

from __future__ import annotations

import math
from cmath import rect

from tests.chance.maker import LooseError, Maker
from tests.chance.records import FRAME, Straight

# --- drivers -------------------------------------------------------------------------------------


def crank(m: Maker) -> None:
    """A bar about a pin of any body, driven against the frame or any other."""
    on = m.any_body()
    pivot, place = m.anchor(on)
    tip = place + m.vector()
    name = m.body({pivot: place, m.name(): tip})
    against = on if m.coin() else m.any_body(but=[name])
    if against != FRAME and m.coin(0.2):
        m.turn(against, name)
    else:
        m.turn(name, against)


def driven_slide(m: Maker) -> None:
    """A block driven along a guide of a body, or a body whose guide slides over a known block."""
    on = m.any_body()
    place = m.somewhere() + m.vector()
    if m.may_be_block(on) and m.coin(0.3):
        along = m.standing.bodies[on].axis
        name = m.body({m.name(): place})
        m.guide(on, name, along)
        m.drive("slide", on, name, m.slide_coordinate(on))
        return
    along = m.direction()
    name = m.block({m.name(): place}, on, along)
    m.drive("slide", name, on, m.slide_coordinate(name))


# --- pairs ---------------------------------------------------------------------------------------


def led(m: Maker, points: dict[str, complex], wish, but: list[str]) -> tuple[str, str]:
    """A new body with some points that slides on a known one, or over it: names of both.

    ``wish`` makes directions for the guide; a known block has its own, which may not do.
    """
    known = m.any_body(but)
    if m.may_be_block(known) and m.coin(0.35):
        name = m.body(points)
        m.guide(known, name, m.standing.bodies[known].axis)
    else:
        name = m.block(points, known, wish())
    return name, known


def bar(m: Maker, start: tuple[str, complex], end: tuple[str, complex]) -> str:
    """A bar between two points."""
    return m.body(dict([start, end]))


# --- dyads ---------------------------------------------------------------------------------------


def rrr(m: Maker) -> None:
    """Two bars."""
    a = m.any_body()
    left = m.anchor(a)
    way = m.vector()
    pin = m.name(), left[1] + way
    b = m.any_body(but=[a])
    place = pin[1] + m.length() * m.across(way)
    right = m.point(b, place), place
    bar(m, left, pin)
    bar(m, right, pin)


def rrp(m: Maker) -> None:
    """A bar and a slide."""
    a = m.any_body()
    left = m.anchor(a)
    way = m.vector()
    pin = m.name(), left[1] + way
    bar(m, left, pin)
    led(m, dict([pin]), lambda: m.beside(way), [a, bar_of(m)])


def bar_of(m: Maker) -> str:
    """The body that was made last."""
    return list(m.standing.bodies)[-1]


def rpr(m: Maker) -> None:
    """A swivelling block and the bar that slides in it."""
    a = m.any_body()
    left = m.anchor(a)
    b = m.any_body(but=[a])
    place = left[1] + m.vector()
    right = m.point(b, place), place
    straight = m.coin(0.4)
    way = place - left[1]
    along = way / abs(way) * m.sign() if straight else m.beside(way)
    first, second = (left, right) if m.coin() else (right, left)
    carrier = m.body(dict([first]))
    if straight:
        name = m.body(dict([second]), along)
        m.guide(name, carrier, along, first[0] if m.coin() else None)
    else:
        m.block(dict([second]), carrier, along)


def prp(m: Maker) -> None:
    """Two slides and a pin between them."""
    pin = m.name(), m.somewhere() + m.vector()
    along = m.direction()
    first, a = led(m, dict([pin]), lambda: along, [])
    led(m, dict([pin]), lambda: m.across(along), [a, first])


def rpp(m: Maker) -> None:
    """A link on a pin slides on one that slides."""
    a = m.any_body()
    left = m.anchor(a)
    along = m.direction()
    place = left[1] + m.vector()
    second, _ = led(m, {m.name(): place}, lambda: along, [a])
    if second not in m.standing.slides and m.coin():
        first = m.body(dict([left]))
        m.guide(second, first, m.standing.bodies[second].axis)
    else:
        m.block(dict([left]), second, m.across(along))


def cylinder_between(m: Maker, left: tuple[str, complex], pin: tuple[str, complex]) -> list[str]:
    """A driven cylinder between a known pin and another; its two links."""
    way = pin[1] - left[1]
    along = way / abs(way) * m.sign() if m.coin() else m.beside(way)
    near, far = dict([left]), dict([pin])
    if m.coin():
        near, far = far, near
    on = m.body(far)
    block = m.block(near, on, along)
    m.drive("slide", block, on, m.slide_coordinate(block))
    return [on, block]


def cylinder(m: Maker) -> None:
    """A driven cylinder as a bar of a dyad, its rod pinned to a bar, a cylinder or a block."""
    a = m.any_body()
    left = m.anchor(a)
    way = m.vector()
    pin = m.name(), left[1] + way
    links = cylinder_between(m, left, pin)
    kind = m.rng.choice(("bar", "cylinder", "block"))
    if kind == "block":
        led(m, dict([pin]), lambda: m.beside(way), [a, *links])
        return
    b = m.any_body(but=[a, *links])
    place = pin[1] + m.length() * m.across(way)
    right = m.point(b, place), place
    if kind == "bar":
        bar(m, right, pin)
    else:
        cylinder_between(m, right, pin)


# --- higher groups -------------------------------------------------------------------------------


def leg(m: Maker, plate: str, place: complex, but: list[str]) -> None:
    """What holds a plate at one place: a bar, a block on a guide, or a block of its own guide."""
    kind = m.rng.choice(("bar", "bar", "block", "guide"))
    if kind == "bar":
        pin = m.point(plate, place), place
        end = place + m.vector()
        b = m.any_body(but)
        bar(m, (m.point(b, end), end), pin)
    elif kind == "block":
        led(m, {m.point(plate, place): place}, m.direction, but)
    else:
        b = m.any_body(but)
        m.block({m.point(b, place): place}, plate, m.direction())


def three_legs(m: Maker) -> None:
    """A plate on three legs: class III, order 3."""
    known = m.bodies()
    place = m.somewhere() + m.vector()
    plate = m.body({m.name(): place, m.name(): place + m.vector()})
    for _ in range(3):
        spot = place + m.vector()
        leg(m, plate, spot, [n for n in m.bodies() if n not in known])


def two_plates(m: Maker) -> None:
    """Two plates pinned together, each on two legs: class III, order 4."""
    known = m.bodies()
    pin = m.name(), m.somewhere() + m.vector()
    for _ in range(2):
        plate = m.body({pin[0]: pin[1], m.name(): pin[1] + m.vector()})
        for _ in range(2):
            leg(m, plate, pin[1] + m.vector(), [n for n in m.bodies() if n not in known])


def loop_of_four(m: Maker) -> None:
    """Two plates on a pin or a guide each, and two bars between them: class IV."""
    known = m.bodies()
    plates = []
    for _ in range(2):
        but = [name for name in m.bodies() if name not in known]
        place = m.somewhere() + m.vector()
        if m.coin(0.75):
            plates.append(m.body(dict([m.anchor(m.any_body(but))])))
        else:
            plates.append(led(m, {m.name(): place}, m.direction, but)[0])
    middle = m.somewhere()
    for _ in range(2):
        ends = []
        for plate in plates:
            place = middle + m.vector()
            ends.append((m.point(plate, place), place))
        bar(m, *ends)


def coupled_plates(m: Maker) -> None:
    """Two plates on two legs each, and two bars between them: two links are tried at once."""
    known = m.bodies()
    plates = []
    for _ in range(2):
        place = m.somewhere() + m.vector()
        plates.append(m.body({m.name(): place, m.name(): place + m.vector()}))
        for _ in range(2):
            but = [name for name in m.bodies() if name not in known]
            leg(m, plates[-1], place + m.vector(), but)
    for _ in range(2):
        ends = []
        for plate in plates:
            start, *_ = m.standing.bodies[plate].points.values()
            place = start + m.vector()
            ends.append((m.point(plate, place), place))
        bar(m, *ends)


def ring_of_plates(m: Maker) -> None:
    """Four plates in a ring, a leg on each: two links are tried at once."""
    known = m.bodies()
    places = [m.somewhere() + m.vector()]
    for _ in range(3):
        places.append(places[-1] + m.vector())
    pins = [(m.name(), place) for place in places]
    for k, pin in enumerate(pins):
        plate = m.body(dict([pin, pins[k - 1]]))
        but = [name for name in m.bodies() if name not in known]
        leg(m, plate, pin[1] + m.vector(), but)


def inner_turn(m: Maker) -> None:
    """Three bars in a row, the second turned by a driver against the first or the frame."""
    a = m.any_body()
    left = m.anchor(a)
    places = [left[1] + m.vector()]
    places.append(places[0] + m.vector())
    pins = [(m.name(), place) for place in places]
    first = bar(m, left, pins[0])
    second = bar(m, *pins)
    b = m.any_body(but=[a, first, second])
    place = places[1] + m.vector()
    bar(m, (m.point(b, place), place), pins[1])
    m.turn(second, m.rng.choice([first, first, FRAME]))


def inner_slide(m: Maker) -> None:
    """A plate on two legs, and a driven cylinder between it and what is known."""
    known = m.bodies()
    place = m.somewhere() + m.vector()
    plate = m.body({m.name(): place, m.name(): place + m.vector()})
    new = lambda: [n for n in m.bodies() if n not in known]  # noqa: E731
    leg(m, plate, place + m.vector(), new())
    leg(m, plate, place + m.vector(), new())
    spot = place + m.vector()
    pin = m.point(plate, spot), spot
    b = m.any_body(new())
    end = m.anchor(b)
    on = m.body(dict([end]))
    block = m.block(dict([pin]), on, m.beside(spot - end[1]))
    m.drive("slide", block, on, m.slide_coordinate(block))


# --- idle bars -----------------------------------------------------------------------------------


def parallel_cranks(m: Maker) -> None:
    """A driven crank, a coupler parallel to the frame, and two more cranks, the last idle."""
    way, arm = m.length(), m.length() * rect(1, m.sign() * m.rng.uniform(0.6, 2.5))
    start = m.somewhere() + m.vector()
    spots = [start, start + way, start + way * m.rng.choice((2.0, 0.5, -1.0))]
    pins = [(m.point(FRAME, z), z) for z in spots]
    tips = [(m.name(), z + arm) for z in spots]
    first = bar(m, pins[0], tips[0])
    m.turn(first, FRAME)
    coupler = m.body(dict(tips))
    bar(m, pins[1], tips[1])
    last = bar(m, pins[2], tips[2])
    assert coupler
    m.standing.idle[last] = (pins[2][0], tips[2][0])


# --- wheels --------------------------------------------------------------------------------------


def straight(
    m: Maker,
    wheel: str,
    centre: str,
    on: str,
    along: complex,
    radius: float,
    side: int | None = None,
) -> Straight:
    """A wheel that stands on a straight track of a body, turned as it has rolled."""
    body = m.standing.bodies[wheel]
    side = m.sign() if side is None else side
    way = m.length() * m.sign()
    through = body.points[centre] - along * (way + 1j * side * radius)
    zero = m.angle(wheel) - m.angle(on) + side * way / radius
    start = math.degrees(zero)
    body.wheels.append((centre, radius))
    found = Straight(wheel, on, centre, radius, through, along, side, start)
    m.standing.straights.append(found)
    return found


def wheel_body(m: Maker, centre: tuple[str, complex]) -> str:
    """A body about a centre, with another point."""
    return m.body({centre[0]: centre[1], m.name(): centre[1] + m.vector()}, m.direction())


def rolled(m: Maker) -> None:
    """A wheel driven along a straight track, by its way or by its turning."""
    on = m.any_body()
    place = m.somewhere() + m.vector()
    name = wheel_body(m, (m.name(), place))
    centre = next(p for p, z in m.standing.bodies[name].points.items() if z == place)
    found = straight(m, name, centre, on, m.direction(), m.length())
    way = ((place - found.through) * found.along.conjugate()).real
    if m.coin():
        m.drive("roll", name, on, way)
    else:
        m.drive("turn", name, on, math.radians(found.start) - found.side * way / found.radius)


def rrw(m: Maker) -> None:
    """A bar to the centre of a wheel on a straight track."""
    a = m.any_body()
    left = m.anchor(a)
    way = m.vector()
    pin = m.name(), left[1] + way
    first = bar(m, left, pin)
    on = m.any_body(but=[a, first])
    straight(m, wheel_body(m, pin), pin[0], on, m.beside(way), m.length())


def rim_pin(m: Maker) -> None:
    """A bar to a point of a wheel beside its centre: position by trial."""
    a = m.any_body()
    left = m.anchor(a)
    pin = m.name(), left[1] + m.vector()
    first = bar(m, left, pin)
    on = m.any_body(but=[a, first])
    centre = m.name(), pin[1] + m.vector()
    wheel = m.body(dict([centre, pin]), m.direction())
    straight(m, wheel, centre[0], on, m.direction(), m.length())


HOWS = ("outside", "outside", "ring", "within", "open", "crossed")
"""How two wheels touch, or how a belt goes round them."""


def gear(m: Maker, hows: tuple[str, ...] = HOWS) -> None:
    """A sun about a pin of a body, driven or part of the body, and a planet on a driven arm.

    They touch, or a belt joins them.
    """
    on = m.any_body()
    sun_at = m.anchor(on)
    radii = m.length(), m.length()
    how = m.rng.choice(hows)
    belt = how if how in ("open", "crossed") else ""
    if how not in ("outside", "crossed"):
        small, large = sorted(radii)
        large = max(large, 1.3 * small)
        radii = (small, large) if how == "within" else (large, small)
    apart = abs(radii[0] - radii[1]) if how in ("ring", "within") else radii[0] + radii[1]
    apart *= m.rng.uniform(1.1, 3) if belt else 1
    place = sun_at[1] + apart * m.direction()
    if on != FRAME and m.coin(0.3):
        planet_at = m.point(on, place), place
        arm = on
    else:
        planet_at = m.name(), place
        arm = bar(m, sun_at, planet_at)
        m.turn(arm, on if m.coin() else FRAME)
    if arm != on and m.coin() and not m.standing.bodies[on].wheels:
        sun = on
    else:
        sun = wheel_body(m, sun_at)
        m.turn(sun, m.rng.choice([on, arm, FRAME]))
    signs = (-1 if how == "ring" else 1), (-1 if how == "within" else 1)
    m.standing.bodies[sun].wheels.append((sun_at[0], signs[0] * radii[0]))
    planet = wheel_body(m, planet_at)
    m.standing.bodies[planet].wheels.append((planet_at[0], signs[1] * radii[1]))
    turning = signs[1] * radii[1], (-1 if how == "open" else signs[0]) * radii[0]
    meshed(m, planet, sun, arm, (planet_at[0], sun_at[0]), turning, belt)
    if m.coin(0.4):
        outer(m, planet, arm)


def outer(m: Maker, planet: str, arm: str) -> None:
    """A further wheel on the arm, which the planet turns; the centres in any direction."""
    (centre, own), *_ = m.standing.bodies[planet].wheels
    if own < 0:
        return
    radius = m.length()
    place = m.standing.bodies[planet].points[centre] + (abs(own) + radius) * m.direction()
    pin = m.point(arm, place), place
    last = wheel_body(m, pin)
    m.standing.bodies[last].wheels.append((pin[0], radius))
    meshed(m, last, planet, arm, (pin[0], centre), (radius, own))


def meshed(
    m: Maker,
    wheel: str,
    on: str,
    arm: str,
    centres: tuple[str, str],
    radii: tuple[float, float],
    belt: str = "",
) -> None:
    """The contact, or belt, counted from angles from which all has turned less than half a turn."""
    turned = {arm: m.rng.uniform(-2, 2), on: m.rng.uniform(-2, 2)}
    turned |= {name: 0.0 for name in turned if name == FRAME}
    turned[wheel] = turned[arm] - radii[1] / radii[0] * (turned[on] - turned[arm])
    m.geared((wheel, on, arm), centres, radii, turned, belt)


def belted(m: Maker) -> None:
    """Two wheels on an arm with a belt round them."""
    gear(m, ("open", "crossed"))


def rack(m: Maker) -> None:
    """A pinion about a pin of a body, driven, and a rack that slides on the body."""
    on = m.any_body()
    centre = m.anchor(on)
    pinion = wheel_body(m, centre)
    m.turn(pinion, on)
    along, radius = m.direction(), m.length()
    name = m.block({m.name(): centre[1] + m.vector()}, on, along)
    straight(m, pinion, centre[0], name, along * m.sign(), radius).kept = True


def pinion(m: Maker) -> None:
    """A rack driven along a guide of a body, and a pinion about a pin of the body."""
    on = m.any_body()
    centre = m.anchor(on)
    along = m.direction()
    name = m.block({m.name(): centre[1] + m.vector()}, on, along)
    m.drive("slide", name, on, m.slide_coordinate(name))
    wheel = wheel_body(m, centre)
    straight(m, wheel, centre[0], name, along * m.sign(), m.length()).kept = True


def roller(m: Maker) -> None:
    """A wheel between two driven plates that slide on a body in one direction."""
    on = m.any_body()
    along, place = m.direction(), m.somewhere() + m.vector()
    plates = [m.block({m.name(): place + m.vector()}, on, along) for _ in range(2)]
    for plate in plates:
        m.drive("slide", plate, on, m.slide_coordinate(plate))
    centre = m.name(), place
    wheel = wheel_body(m, centre)
    radius = m.length()
    first = straight(m, wheel, centre[0], plates[0], along * m.sign(), radius)
    second = straight(m, wheel, centre[0], plates[1], along * m.sign(), radius)
    sides = [each.side * (each.along * along.conjugate()).real for each in (first, second)]
    if sides[0] * sides[1] > 0:
        raise LooseError
    second.kept = True
    m.standing.bodies[wheel].wheels.pop()


def planet(m: Maker) -> None:
    """A sun and a ring about one pin, both driven, and between them a planet on a free arm."""
    on = m.any_body()
    centre = m.anchor(on)
    small, own = m.length(), m.length()
    large = small + 2 * own
    wheels = [wheel_body(m, centre) for _ in range(2)]
    for wheel, radius in zip(wheels, (small, -large), strict=True):
        m.turn(wheel, m.rng.choice([on, FRAME]))
        m.standing.bodies[wheel].wheels.append((centre[0], radius))
    place = centre[1] + (small + own) * m.direction()
    pin = m.name(), place
    arm = bar(m, centre, pin)
    last = wheel_body(m, pin)
    m.standing.bodies[last].wheels.append((pin[0], own))
    arm_turned = m.rng.uniform(-2, 2)
    turned = {arm: arm_turned, wheels[0]: m.rng.uniform(-2, 2)}
    turned[last] = arm_turned - small / own * (turned[wheels[0]] - arm_turned)
    turned[wheels[1]] = arm_turned + own / large * (turned[last] - arm_turned)
    for wheel, radius in zip(wheels, (small, -large), strict=True):
        m.geared((last, wheel, arm), (pin[0], centre[0]), (own, radius), turned)


def series(m: Maker) -> None:
    """A sun and a ring about one pin, both driven, and two planets in a row on a free arm."""
    on = m.any_body()
    centre = m.anchor(on)
    small, first, second = m.length(), m.length(), m.length()
    spots = [centre[1] + (small + first) * m.direction()]
    spots.append(spots[0] + (first + second) * m.across(spots[0] - centre[1]))
    large = abs(spots[1] - centre[1]) + second
    suns = [wheel_body(m, centre) for _ in range(2)]
    for wheel, radius in zip(suns, (small, -large), strict=True):
        m.turn(wheel, m.rng.choice([on, FRAME]))
        m.standing.bodies[wheel].wheels.append((centre[0], radius))
    pins = [(m.name(), spot) for spot in spots]
    arm = m.body(dict([centre, *pins]))
    planets = [wheel_body(m, pin) for pin in pins]
    turned = {arm: m.rng.uniform(-2, 2), suns[0]: m.rng.uniform(-2, 2)}

    for planet, pin, radius in zip(planets, pins, (first, second), strict=True):
        m.standing.bodies[planet].wheels.append((pin[0], radius))
    seen = turned[suns[0]] - turned[arm]
    turned[planets[0]] = turned[arm] - small / first * seen
    turned[planets[1]] = turned[arm] + small / second * seen
    turned[suns[1]] = turned[arm] + small / large * seen
    (one, other), (near, far) = planets, (pin[0] for pin in pins)
    m.geared((one, suns[0], arm), (near, centre[0]), (first, small), turned)
    m.geared((other, one, arm), (far, near), (second, first), turned)
    m.geared((other, suns[1], arm), (far, centre[0]), (second, -large), turned)


def twins(m: Maker) -> None:
    """A driven ring and a free sun about one pin, two planets on a free arm, and a rod to one.

    The other planet's contact with the sun is idle.
    """
    on = m.any_body()
    centre = m.anchor(on)
    small, own = m.length(), m.length()
    large = small + 2 * own
    ring, sun = (wheel_body(m, centre) for _ in range(2))
    m.turn(ring, m.rng.choice([on, FRAME]))
    way = (small + own) * m.direction()
    pins = [(m.name(), centre[1] + way), (m.name(), centre[1] + m.across(way) * abs(way))]
    arm = m.body(dict([centre, *pins]))
    m.standing.bodies[ring].wheels.append((centre[0], -large))
    m.standing.bodies[sun].wheels.append((centre[0], small))
    turned = {arm: m.rng.uniform(-2, 2), ring: m.rng.uniform(-2, 2)}
    seen = turned[ring] - turned[arm]
    turned[sun] = turned[arm] - large / small * seen
    planets = [wheel_body(m, pin) for pin in pins]
    for number, (planet_, pin) in enumerate(zip(planets, pins, strict=True)):
        m.standing.bodies[planet_].wheels.append((pin[0], own))
        turned[planet_] = turned[arm] + large / own * seen
        for wheel, radius in ((ring, -large), (sun, small)):
            idle, ends = number == 1 and wheel == sun, (pin[0], centre[0])
            m.geared((planet_, wheel, arm), ends, (own, radius), turned, idle=idle)
    spot = pins[0][1] + m.vector()
    rod = m.point(planets[0], spot), spot
    known = m.any_body(but=[ring, sun, arm, *planets])
    bar(m, rod, m.anchor(known))


def plank(m: Maker) -> None:
    """A plank on two rollers of one size on a body, the first driven."""
    on, along = m.any_body(), m.direction()
    place, radius, side = m.somewhere() + m.vector(), m.length(), m.sign()
    lower = place - along * (m.length() + 1j * side * radius)
    upper = place + along * (m.length() + 1j * side * radius)
    name = m.body({m.name(): upper + m.vector()}, along)
    turned = m.angle(on)
    own = m.along(on, name) if m.counts(on) else m.standing.bodies[name].angle
    way = 0.0
    for number in range(2):
        spot = place + along * way
        wheel = wheel_body(m, (m.name(), spot))
        centre = next(p for p, z in m.standing.bodies[wheel].points.items() if z == spot)
        m.standing.bodies[wheel].wheels.append((centre, radius))
        for body, through, facing in ((on, lower, side), (name, upper, -side)):
            gone = ((spot - through) * along.conjugate()).real
            zero = m.angle(wheel) - (turned if body == on else own) + facing * gone / radius
            m.standing.straights.append(
                Straight(wheel, body, centre, radius, through, along, facing, math.degrees(zero))
            )
        if number == 0:
            m.drive("roll", wheel, on, ((spot - lower) * along.conjugate()).real)
        way = m.length() * m.sign()


def kept_bar(m: Maker) -> None:
    """A bar that a pin and a wheel alone hold: on a roller about a pin of a body, or on a drum.

    The drum is a wheel of a body that stands, and a further bar leads the end of the first.
    """
    a = m.any_body()
    left = m.anchor(a)
    way = m.vector()
    pin, along = (m.name(), left[1] + way), m.beside(way)
    if m.coin():
        wheel = wheel_body(m, (m.point(m.any_body(but=[a]), pin[1]), pin[1]))
        centre = next(p for p, z in m.standing.bodies[wheel].points.items() if z == pin[1])
        straight(m, wheel, centre, m.body(dict([left])), along, m.length())
        return
    drums = [n for n in m.bodies(but=[FRAME]) if not m.standing.bodies[n].wheels]
    drum = m.rng.choice(drums)
    centre, place = m.anchor(drum)
    end = m.name(), place + m.vector()
    track = m.body({m.name(): place + m.vector(), end[0]: end[1]})
    found = straight(m, drum, centre, track, m.direction(), m.length())
    if abs(math.radians(found.start) - m.angle(drum)) > 3:  # a drum on pins counts from there
        raise LooseError
    known = m.any_body(but=[drum, track])
    foot = end[1] + m.vector()
    bar(m, (m.point(known, foot), foot), end)
