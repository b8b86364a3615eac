"""Cams of every kind by their law: what they lift, what carries both, what moves them."""

from __future__ import annotations

import math
from cmath import rect

from tests.chance.groups import bar
from tests.chance.lifts import MOTIONS, lifted, raised
from tests.chance.maker import LooseError, Maker
from tests.chance.records import FRAME, CamLaw, Lever

EARLIER = ("harmonic", "cycloidal", "parabolic", "3-4-5", "4-5-6-7", "uniform")
"""The motions of the first kind here, which may not change."""


def cam(m: Maker) -> None:
    """A follower on a guide of the frame, lifted by a cam on any body that is pinned there."""
    fixed = m.standing.bodies[FRAME].points
    shafts = {
        name: pins
        for name in m.bodies(but=[FRAME])
        if len(pins := [p for p in m.standing.bodies[name].points if p in fixed]) == 1
        and name not in m.standing.slides
    }
    if not shafts:
        pivot, place = m.anchor(FRAME)
        on = bar(m, (pivot, place), (m.name(), place + m.vector()))
        m.turn(on, FRAME)
        shafts[on] = [pivot]
    on = m.rng.choice(list(shafts))
    pivot = shafts[on][0]
    ends = [*sorted(m.rng.sample(range(50, 311, 20), 3)), 360]
    base, rise = m.length(), m.rng.uniform(0.1, 0.6)
    rises = [rise, 0.0, -rise, 0.0] if m.coin() else [rise, -rise / 2, rise / 4, -rise * 0.75]
    if sum(rises) != 0:
        raise LooseError
    pieces = [(e, base * r, m.rng.choice(EARLIER)) for e, r in zip(ends, rises, strict=True)]
    tip = m.rng.choice(("roller", "knife", "flat"))
    roller = base * m.rng.uniform(0.1, 0.4) if tip == "roller" else 0.0
    law = CamLaw("", on, pivot, tip, base, roller, pieces, m.rng.randint(-180, 180), m.sign())
    angle = law.sense * (m.standing.bodies[on].angle - math.radians(law.start))
    at = math.degrees(angle) % 360
    if min(abs(at - each) for each in (0, *ends)) < 1:
        raise LooseError
    along, aside = m.direction(), base * m.rng.uniform(-0.6, 0.6)
    high = base if tip == "flat" else math.sqrt((base + roller) ** 2 - aside**2)
    high += float(lifted(pieces, angle))
    name = m.body({m.name(): fixed[pivot] + along * complex(high, aside)}, along)
    m.guide(name, FRAME, along)
    law.follower = name
    m.standing.cams.append(law)


# --- on any link ---------------------------------------------------------------------------------


def pinned_once(m: Maker) -> list[tuple[str, str, str]]:
    """Cams, what may carry their followers, and the one pin between them."""
    bodies = m.standing.bodies
    found = []
    for on in m.bodies():
        for carrier in m.bodies(but=[on]):
            pins = [point for point in bodies[on].points if point in bodies[carrier].points]
            slides = m.standing.slides.get(on)
            if len(pins) == 1 and not (slides and slides.on == carrier):
                found.append((on, carrier, pins[0]))
    return found


def seat(m: Maker, slides: bool) -> tuple[str, str, str]:
    """A cam, what carries it and its follower, and the pin of both, or its first point."""
    if slides:
        made = [
            (block, slide.on)
            for block, slide in m.standing.slides.items()
            if slide.block in m.standing.bodies
        ]
        if not made or m.coin():
            carrier, along = m.any_body(), m.direction()
            on = m.block({m.name(): m.somewhere() + m.vector()}, carrier, along)
            m.drive("slide", on, carrier, m.slide_coordinate(on))
        else:
            on, carrier = m.rng.choice(made)
        return on, carrier, next(iter(m.standing.bodies[on].points))
    seats = pinned_once(m)
    if not seats or m.coin(0.2):
        carrier = m.any_body()
        pivot, place = m.anchor(carrier)
        on = bar(m, (pivot, place), (m.name(), place + m.vector()))
        m.turn(on, carrier if m.coin() else FRAME)
        return on, carrier, pivot
    return m.rng.choice(seats)


def law_of(m: Maker, high: float) -> list[tuple[float, float, str]]:
    """A law of a turn that lifts as far as ``high``: pieces, or points of a table."""
    if m.coin(0.3):
        spots = sorted(m.rng.sample(range(40, 340, 20), m.rng.randint(3, 5)))
        return [(0.0, 0.0, ""), *((float(at), high * m.rng.uniform(0.1, 1), "") for at in spots)]
    ends = [*sorted(m.rng.sample(range(50, 311, 20), 3)), 360]
    shares = (1.0, 0.0, -1.0, 0.0) if m.coin() else (1.0, -0.5, 0.25, -0.75)
    motions = list(MOTIONS)
    return [
        (float(end), high * share, m.rng.choice(motions))
        for end, share in zip(ends, shares, strict=True)
    ]


def begun(m: Maker, law: CamLaw) -> float:
    """How far the law has come, in radians or metres; LooseError beside a border of its pieces.

    A plate that moves level, or with a straight flank, has no circle that stands for it.
    """
    bodies = m.standing.bodies
    if law.slides:
        size = m.length()
        ends = sorted(m.rng.uniform(0.3, 3) * size for _ in range(3))
        at, high = m.rng.uniform(0, ends[-1]), size * m.rng.uniform(0.1, 0.6)
        shares = (1.0, -0.5, 0.75) if m.coin() else (1.0, -1.0, 0.5)
        motions = [name for name in MOTIONS if name != "uniform"]
        law.pieces = [
            (end, high * share, m.rng.choice(motions))
            for end, share in zip(ends, shares, strict=True)
        ]
        law.start = m.slide_coordinate(law.on) - law.sense * at
        borders, near, now = [0.0, *ends], 0.02 * size, at
    else:
        at = law.sense * (
            bodies[law.on].angle - bodies[law.carrier].angle - math.radians(law.start)
        )
        borders = [0.0, *(end for end, *_ in law.pieces), 360.0]
        near, now = 1.0, math.degrees(at) % 360
    if min(abs(now - each) for each in borders) < near:
        raise LooseError
    return at


def lift_of(law: CamLaw, at: float) -> float:
    """The lift where the law has come so far."""
    return float(raised(law.pieces, at) if law.slides else lifted(law.pieces, at))


def slid_cam(m: Maker, slides: bool = False) -> None:
    """A follower on a guide of any link, lifted by a cam that is pinned to it or slides on it.

    So cams are carried, and one of the two may be the frame.
    """
    on, carrier, pivot = seat(m, slides)
    tip = m.rng.choice(("roller", "knife") if slides else ("roller", "knife", "flat"))
    base = m.length()
    roller = base * m.rng.uniform(0.1, 0.4) if tip == "roller" else 0.0
    law = CamLaw("", on, pivot, tip, base, roller, [], m.rng.randint(-180, 180), m.sign(), carrier)
    law.slides = slides
    if not slides:
        law.pieces = law_of(m, base * m.rng.uniform(0.1, 0.6))
    lift = lift_of(law, begun(m, law))
    pin = m.standing.bodies[on].points[pivot]
    if slides:
        way = m.standing.slides[on].along
        along = m.across(way)
        side = 1 if (along * way.conjugate()).imag > 0 else -1
        level = pin + side * 1j * way * (base + roller) + way * m.length() * m.sign()
        place = level + along * lift
    else:
        along, aside = m.direction(), base * m.rng.uniform(-0.6, 0.6)
        high = base if tip == "flat" else math.sqrt((base + roller) ** 2 - aside**2)
        place = pin + along * complex(high + lift, aside)
    name = m.body({m.name(): place}, along)
    m.guide(name, carrier, along)
    law.follower = name
    m.standing.cams.append(law)


def swung_cam(m: Maker, slides: bool = False) -> None:
    """A lever on a pin of any link, swung by a cam that is pinned to this or slides on it."""
    on, carrier, pivot = seat(m, slides)
    tip = m.rng.choice(("roller", "knife") if slides else ("roller", "knife", "flat"))
    base, side = m.length(), m.sign()
    roller = base * m.rng.uniform(0.1, 0.4) if tip == "roller" else 0.0
    law = CamLaw("", on, pivot, tip, base, roller, [], m.rng.randint(-180, 180), m.sign(), carrier)
    law.slides, prime = slides, base + roller
    if not slides:
        law.pieces = law_of(m, m.rng.uniform(5, 25))
    at = begun(m, law)
    arm, here = m.length(), m.standing.bodies[on].points[pivot]
    face = base * m.rng.uniform(-0.3, 0.3) if tip == "flat" and m.coin() else 0.0
    if slides:
        way, left = m.standing.slides[on].along, m.sign()
        law.pieces = [
            (end, math.degrees(rise / arm) % 25 * (1 if rise > 0 else -1), how)
            for end, rise, how in law.pieces
        ]
        law.pieces = settled(law.pieces)
        above = prime + arm * m.rng.uniform(-0.6, 0.9)
        if above < 0.05 * arm:
            raise LooseError
        pin = here + way * complex(m.length() * m.sign(), left * above)
        towards, resting = -1j * left * way, math.acos((above - prime) / arm)
    else:
        apart = prime * m.rng.uniform(1.2, 3)
        pin = here + apart * m.direction()
        towards = (here - pin) / apart
        if tip == "flat":
            if not 0.1 < (base + face) / apart < 0.9:
                raise LooseError
            resting = math.asin((base + face) / apart)
        else:
            arm = apart * m.rng.uniform(0.6, 1.3)
            cosine = (apart**2 + arm**2 - prime**2) / (2 * apart * arm)
            if abs(cosine) > 0.98:
                raise LooseError
            resting = math.acos(cosine)
    swing = resting + math.radians(lift_of(law, at))
    if not 0.1 < swing < math.pi - 0.1:
        raise LooseError
    foot = m.point(carrier, pin), pin
    end = m.name(), pin + arm * towards * rect(1, -side * swing)
    law.follower = bar(m, foot, end)
    law.lever = Lever(foot[0], end[0], side, face)
    m.standing.cams.append(law)


def settled(pieces: list[tuple[float, float, str]]) -> list[tuple[float, float, str]]:
    """Pieces of which none leads below where the law begins."""
    found, height = [], 0.0
    for end, rise, how in pieces:
        lift = abs(rise) if height + rise < 0 else rise
        height += lift
        found.append((end, lift, how))
    return found


def plate_cam(m: Maker) -> None:
    """A plate that slides on any link lifts a follower in a guide of this link."""
    slid_cam(m, slides=True)


def plate_lever(m: Maker) -> None:
    """A plate that slides on any link swings a lever on a pin of this link."""
    swung_cam(m, slides=True)
