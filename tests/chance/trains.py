"""Trains of wheels: compound ones, on couplers, and two sets in a loop."""

from __future__ import annotations

from itertools import pairwise

from tests.chance.groups import bar, meshed, wheel_body
from tests.chance.maker import LooseError, Maker
from tests.chance.records import FRAME


def compound(m: Maker) -> None:
    """Three wheels on pins of one body, the middle one with two rims: gears, belts or both.

    Belts run on equal wheels, too.
    """
    on = m.any_body()
    first = m.anchor(on)
    wheels, pins = [wheel_body(m, first)], [first]
    m.turn(wheels[0], on)
    rims: list[list[float]] = [[], [], []]
    stages = []
    for number in range(2):
        own, other = m.length(), m.length()
        belt = m.rng.choice(("", "", "open", "crossed"))
        if belt == "open" and m.coin():
            own = other
        apart = (own + other) * (m.rng.uniform(1.1, 3) if belt else 1)
        place = pins[-1][1] + apart * m.direction()
        pins.append((m.point(on, place), place))
        wheels.append(wheel_body(m, pins[-1]))
        rims[number].append(other)
        rims[number + 1].append(own)
        stages.append((own, other, belt))
    gaps = [abs(b[1] - a[1]) for a, b in pairwise(pins)]
    for number, (own, other, belt) in enumerate(stages):
        sums = [a + b for a in rims[number] for b in rims[number + 1]]
        wrong = [s for s in sums if s != other + own and abs(s - gaps[number]) < 1e-3 * s]
        if wrong and not belt:
            raise LooseError
    for wheel, pin, radii in zip(wheels, pins, rims, strict=True):
        m.standing.bodies[wheel].wheels += [(pin[0], radius) for radius in radii]
    for number, (own, other, belt) in enumerate(stages):
        ends = pins[number + 1][0], pins[number][0]
        turning = own, -other if belt == "open" else other
        meshed(m, wheels[number + 1], wheels[number], on, ends, turning, belt)
        if belt:
            m.standing.gears[-1].runs = 1, 1 + number


def lever_gear(m: Maker) -> None:
    """A wheel of a body on a pin of another, as of a coupler on its crank, turns one on the other.

    Watt's sun and planet is one of these.
    """
    bodies = m.standing.bodies
    pairs = [
        (arm, planet, point)
        for arm in m.bodies(but=[FRAME])
        for planet in m.bodies(but=[FRAME, arm])
        for point in bodies[arm].points
        if point in bodies[planet].points and not bodies[planet].wheels
    ]
    arm, planet, pin = m.rng.choice(pairs)
    others = [p for p, z in bodies[arm].points.items() if abs(z - bodies[arm].points[pin]) > 0]
    if others and m.coin(0.7):
        hub = m.rng.choice(others)
    else:
        hub = m.point(arm, bodies[arm].points[pin] + m.vector())
    apart = abs(bodies[arm].points[hub] - bodies[arm].points[pin])
    inside = m.coin(0.3)
    share = m.rng.uniform(0.2, 0.8)
    own = apart * (share / (1 - share) if inside else share)
    other = apart + own if inside else apart - own
    sun = wheel_body(m, (hub, bodies[arm].points[hub]))
    ring = inside and m.coin()
    if inside and not ring:
        own, other = other, own
    signed = -own if inside and not ring else own, -other if ring else other
    bodies[planet].wheels.append((pin, signed[0]))
    bodies[sun].wheels.append((hub, signed[1]))
    meshed(m, sun, planet, arm, (hub, pin), (signed[1], signed[0]))


def simpson(m: Maker) -> None:
    """Two planetary sets with one sun; the arm of the first is the ring of the second."""
    on = m.any_body()
    centre = m.anchor(on)
    small, sizes = m.length(), (m.length(), m.length())
    rings = [small + 2 * own for own in sizes]
    sun, first = wheel_body(m, centre), wheel_body(m, centre)
    m.turn(first, m.rng.choice([on, FRAME]))
    pins = [(m.name(), centre[1] + (small + own) * m.direction()) for own in sizes]
    joined, last = bar(m, centre, pins[0]), bar(m, centre, pins[1])
    m.turn(last, m.rng.choice([on, FRAME]))
    planets = [wheel_body(m, pin) for pin in pins]
    rims = ((sun, small), (first, -rings[0]), (joined, -rings[1]))
    for wheel, radius in rims:
        m.standing.bodies[wheel].wheels.append((centre[0], radius))
    turned = {joined: m.rng.uniform(-1, 1), sun: m.rng.uniform(-1, 1)}
    turned[first] = turned[joined] - small / rings[0] * (turned[sun] - turned[joined])
    share = small / rings[1]
    turned[last] = (turned[joined] + share * turned[sun]) / (1 + share)
    sets = ((joined, first, rings[0]), (last, joined, rings[1]))
    for planet, pin, own, (arm, ring, large) in zip(planets, pins, sizes, sets, strict=True):
        m.standing.bodies[planet].wheels.append((pin[0], own))
        turned[planet] = turned[arm] - small / own * (turned[sun] - turned[arm])
        for wheel, radius in ((sun, small), (ring, -large)):
            m.geared((planet, wheel, arm), (pin[0], centre[0]), (own, radius), turned)
