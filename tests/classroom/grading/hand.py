"""Labs drawn by hand, from formulas of their own: nothing here comes from graphkin.

A drawing is made on paper in millimetres, point by point, as a student makes it: every point that
is marked lies off by a gaussian error along either axis, every direction that is laid off or
transferred is turned by one, every length that is read is off by the ruler and rounded. What
comes later is drawn from the points that were marked, and computed from the lengths that were read.
Without errors it is the key. Sheets are given by kL (real over drawn), kv and ka (m/s and m/s² for
a metre of paper); v²/l of the lengths that are read is drawn kv²/(kL·ka) times as long.
"""

from __future__ import annotations

import cmath
from collections.abc import Callable, Collection
from dataclasses import dataclass, field
from math import pi, radians, sqrt

import numpy as np
from msgspec import Struct

SLIPS = (
    "angle_clockwise",
    "driver_reversed",
    "rpm_as_rad",
    "wrong_scale",
    "normal_missing",
    "normal_reversed",
    "coriolis_missing",
    "coriolis_reversed",
)
"""What a student may have understood wrongly, all through the drawing."""


class Data(Struct, frozen=True):
    """What a student is given: the crank's angle in degrees, its speed in rev/min."""

    angle: float
    speed: float

    @property
    def omega(self) -> float:
        """The same speed in rad/s."""
        return self.speed * pi / 30


def data(lab: str, n: float) -> Data:
    """The data of a student's number, as the shipped scenes state them."""
    if lab == "offset-slider-crank":
        return Data(128 + 6 * n / 5, 100 + 5 * n)
    if lab == "slotted-lever":
        return Data(28 + 3 * n / 2, 50 + 2 * n)
    return Data(30 + 2 * n, 300 + 10 * n)


@dataclass
class Hand:
    """A hand at one sheet: ``sigma`` mm is the deviation of a marked point along an axis,
    ``degrees`` of a direction, ``ruler`` mm of a reading, which is rounded to ``step`` mm.
    """

    kL: float
    kv: float
    ka: float
    rng: np.random.Generator | None = None
    sigma: float = 0.0
    degrees: float = 0.0
    ruler: float = 0.0
    step: float = 0.0
    slips: Collection[str] = ()
    found: dict[str, float] = field(default_factory=dict)

    def normal(self, deviation: float) -> float:
        """One gaussian error."""
        return deviation * float(self.rng.standard_normal()) if self.rng is not None else 0.0

    def dot(self, point: complex) -> complex:
        """A point as it is marked."""
        return point + complex(self.normal(self.sigma), self.normal(self.sigma))

    def turned(self, way: complex) -> complex:
        """A direction as it is laid off."""
        return way * cmath.exp(1j * radians(self.normal(self.degrees)))

    def read(self, length: float) -> float:
        """A length or coordinate as it is read."""
        told = length + self.normal(self.ruler)
        return round(told / self.step) * self.step if self.step else told

    def metres(self, millimetres: float) -> float:
        """Real millimetres on paper."""
        return millimetres / self.kL

    def crossing(self, p: complex, way: complex, q: complex, other: complex) -> complex:
        """Where lines through two points in two directions meet, as it is marked."""
        way, other = self.turned(way), self.turned(other)
        across = (way.conjugate() * other).imag
        return self.dot(p + way * ((q - p).conjugate() * other).imag / across)

    def on_guide(self, start: complex, length: float, height: float) -> complex:
        """The point of a level guide, to the right, at a distance from another."""
        away = sqrt(length**2 - (height - start.imag) ** 2)
        return complex(start.real + self.side("guide") * away, height)

    def side(self, place: str) -> float:
        """1 for the side on which loci meet that the task says, -1 for the other."""
        return 1.0

    def plate(self, shape: complex) -> complex:
        """The shape of a plate: its third point, where the first is 0 and the second 1."""
        return shape

    def across(self, bar: complex, plan: str) -> complex:
        """The direction of the relative vector across a bar in a plan, v or a."""
        return 1j * bar

    def relative_normal(self, arrow: complex, bar: complex) -> complex:
        """The normal component v²/l of the far end of a bar, towards its near end."""
        if "normal_missing" in self.slips:
            return 0j
        size = self.read(abs(arrow)) ** 2 / abs(bar) * self.square
        turned = self.turned(-bar / abs(bar)) * size
        return -turned if "normal_reversed" in self.slips else turned

    @property
    def square(self) -> float:
        """How many times as long as v²/l of lengths on paper an acceleration is drawn."""
        return self.kv**2 / (self.kL * self.ka)

    # --- what is handed in ---------------------------------------------------------------------

    @property
    def odd(self) -> float:
        """By how much a scale is taken wrongly."""
        return 2.0 if "wrong_scale" in self.slips else 1.0

    @property
    def fast(self) -> float:
        """How many times too fast the crank is taken to turn."""
        return 30 / pi if "rpm_as_rad" in self.slips else 1.0

    def velocity(self, name: str, arrow: complex) -> None:
        """Hand in a velocity: its segment and its size in m/s."""
        self.found[f"{name}_mm"] = length = self.read(abs(arrow))
        self.found[name] = length * self.kv / 1000 * self.odd * self.fast

    def acceleration(self, name: str, arrow: complex) -> None:
        """Hand in an acceleration: its segment and its size in m/s²."""
        self.found[f"{name}_mm"] = length = self.read(abs(arrow))
        self.found[name] = length * self.ka / 1000 * self.odd * self.fast**2

    def along(self, name: str, arrow: complex, way: complex, per_mm: float) -> None:
        """Hand in the size of an arrow along a direction, in its unit, with the sense of it."""
        sign = 1.0 if (arrow * way.conjugate()).real > 0 else -1.0
        self.found[name] = sign * self.read(abs(arrow)) * per_mm * self.odd
        self.found[f"{name}_sense"] = sign

    def rate(self, name: str, arrow: complex, bar: complex, length: float) -> None:
        """Hand in ω or ε: the relative arrow across a bar, over the bar of so many mm."""
        power = 1 if name.startswith("omega") else 2
        per = (self.kv if power == 1 else self.ka) / self.kL * self.fast**power
        self.along(name, arrow, 1j * bar, per / length)

    def place(self, name: str, point: complex) -> None:
        """Hand in a place from the first fixed pivot."""
        self.found[f"{name}_x_mm"] = self.read(point.real)
        self.found[f"{name}_y_mm"] = self.read(point.imag)

    # --- the crank -----------------------------------------------------------------------------

    def crank(self, given: Data, length: float) -> tuple[complex, complex, complex]:
        """The crank's pin about the origin, its velocity and its acceleration, as drawn."""
        angle = -given.angle if "angle_clockwise" in self.slips else given.angle
        omega = -given.omega if "driver_reversed" in self.slips else given.omega
        way = self.turned(cmath.exp(1j * radians(angle)))
        pin = self.dot(way * self.metres(length))
        way = pin / abs(pin)
        velocity = self.dot(self.turned(1j * way) * length * omega / self.kv)
        size = length * omega**2 / self.ka
        return pin, velocity, self.dot(-self.turned(way) * size)


def slider_crank(hand: Hand, given: Data) -> None:
    """Crank 60 mm, rod 200 mm, guide 30 mm above the crank's pivot, C on the rod 90 mm from A."""
    a, va, aa = hand.crank(given, 60)
    rod = hand.metres(200)
    b = hand.dot(hand.on_guide(a, rod, hand.metres(30)))
    bar = b - a
    vb = hand.crossing(0j, 1 + 0j, va, hand.across(bar, "v"))
    part = hand.plate(90 / 200)
    vc = hand.dot(va + part * (vb - va))
    tip = hand.dot(aa + hand.relative_normal(vb - va, bar / abs(bar) * rod))
    ab = hand.crossing(0j, 1 + 0j, tip, hand.across(bar, "a"))
    ac = hand.dot(aa + part * (ab - aa))
    hand.velocity("v_B", vb)
    hand.velocity("v_C", vc)
    hand.acceleration("a_B", ab)
    hand.acceleration("a_C", ac)
    hand.rate("omega_2", vb - va, bar, rod)
    hand.rate("epsilon_2", ab - tip, bar, rod)
    hand.found["a_BA_nu_mm"] = hand.read(abs(tip - aa))


def slotted_lever(hand: Hand, given: Data) -> None:
    """Crank 120 mm, lever 620 mm about (0, -300 mm), rod 200 mm, ram 340 mm above the crank."""
    quick_return(hand, given, 120, 300, 620, 200, 340)


def quick_return(
    hand: Hand, given: Data, crank: float, below: float, reach: float, joint: float, above: float
) -> None:
    """A crank, a block at its pin in the slot of a lever about a pivot straight ``below``; a rod
    from the lever's end to a ram on the level guide ``above`` the crank's pivot."""
    a, va, aa = hand.crank(given, crank)
    pivot, long, rod = -1j * hand.metres(below), hand.metres(reach), hand.metres(joint)
    lever = a - pivot
    arm, way = hand.read(abs(lever)), lever / abs(lever)
    b = hand.dot(pivot + long * way)
    c = hand.dot(hand.on_guide(b, rod, hand.metres(above)))
    bar = c - b
    v3 = hand.crossing(0j, 1j * way, va, way)
    vb = hand.dot(v3 * long / arm)
    vc = hand.crossing(0j, 1 + 0j, vb, hand.across(bar, "v"))
    slip = va - v3
    turning = 1.0 if (v3 * (1j * way).conjugate()).real > 0 else -1.0
    cor = 2 * hand.read(abs(v3)) * hand.read(abs(slip)) / arm * turning * hand.square
    cor *= 1.0 if (slip * way.conjugate()).real > 0 else -1.0
    cor *= {"coriolis_missing": 0.0, "coriolis_reversed": -1.0}.get(
        next((slip for slip in hand.slips if slip.startswith("coriolis")), ""), 1.0
    )
    away = hand.dot(aa - hand.turned(1j * way) * cor)
    third = hand.dot(hand.relative_normal(v3, lever / abs(lever) * arm))
    a3 = hand.crossing(third, 1j * way, away, way)
    ab = hand.dot(a3 * long / arm)
    tip = hand.dot(ab + hand.relative_normal(vc - vb, bar / abs(bar) * rod))
    ac = hand.crossing(0j, 1 + 0j, tip, hand.across(bar, "a"))
    hand.velocity("v_C", vc)
    hand.velocity("v_A3", v3)
    hand.acceleration("a_C", ac)
    hand.acceleration("a_A3", a3)
    hand.rate("omega_3", v3, lever, arm)
    hand.rate("omega_4", vc - vb, bar, rod)
    hand.rate("epsilon_3", a3 - third, lever, arm)
    hand.rate("epsilon_4", ac - tip, bar, rod)
    hand.along("v_slide_2", slip, way, hand.kv / 1000 * hand.fast)
    hand.along("a_slide_2", away - a3, way, hand.ka / 1000 * hand.fast**2)


def pump(hand: Hand, given: Data) -> None:
    """Crank 300 mm, rocker 300 mm about (0, -300 mm), a plate ABC of 400, 200 and 250 mm, a rod
    of 200 mm to a piston on the level guide through the crank's pivot."""
    a, va, aa = hand.crank(given, 300)
    pivot = -1j * hand.metres(300)
    rocker, side, rod = hand.metres(300), hand.metres(400), hand.metres(200)
    axis = pivot - a
    along = (side**2 - rocker**2 + abs(axis) ** 2) / (2 * abs(axis))
    height = -sqrt(side**2 - along**2) * hand.side("rocker")
    b = hand.dot(a + complex(along, height) * axis / abs(axis))
    plate, arm = b - a, b - pivot
    part = (400**2 + 200**2 - 250**2) / (2 * 400**2)
    shape = hand.plate(complex(part, sqrt((200 / 400) ** 2 - part**2)))
    c = hand.dot(a + shape * plate)
    d = hand.dot(hand.on_guide(c, rod, 0.0))
    bar = d - c
    vb = hand.crossing(0j, 1j * arm, va, 1j * plate)
    vc = hand.dot(va + shape * (vb - va))
    vd = hand.crossing(0j, 1 + 0j, vc, hand.across(bar, "v"))
    second = hand.dot(hand.relative_normal(vb, arm / abs(arm) * rocker))
    third = hand.dot(aa + hand.relative_normal(vb - va, plate / abs(plate) * side))
    ab = hand.crossing(second, 1j * arm, third, 1j * plate)
    ac = hand.dot(aa + shape * (ab - aa))
    tip = hand.dot(ac + hand.relative_normal(vd - vc, bar / abs(bar) * rod))
    ad = hand.crossing(0j, 1 + 0j, tip, hand.across(bar, "a"))
    hand.velocity("v_D", vd)
    hand.acceleration("a_D", ad)
    hand.rate("omega_2", vb, arm, rocker)
    hand.rate("omega_3", vb - va, plate, side)
    hand.rate("omega_4", vd - vc, bar, rod)
    hand.rate("epsilon_2", ab - second, arm, rocker)
    hand.rate("epsilon_3", ab - third, plate, side)
    hand.rate("epsilon_4", ad - tip, bar, rod)
    hand.place("I_3", hand.crossing(0j, a, pivot, arm))
    hand.place("J_3", pole(hand, (a, b), (aa, ab)))
    hand.place("J_4", pole(hand, (c, d), (ac, ad)))


def six_bar(hand: Hand, given: Data, crank: float, rod: float, rocker: float) -> None:
    """A four-bar of 200 and 140 mm about (210, -30), a plate ABC of 150 and 110 mm on its coupler,
    a rod from C to a rocker about (360, 120); B and D lie where arcs meet."""
    a, va, aa = hand.crank(given, crank)
    second, third = hand.metres(1) * (210 - 30j), hand.metres(1) * (360 + 120j)
    b = hand.dot(arcs(a, hand.metres(200), second, hand.metres(140)))
    plate, arm = b - a, b - second
    part = (200**2 + 150**2 - 110**2) / (2 * 200**2)
    shape = complex(part, sqrt((150 / 200) ** 2 - part**2))
    c = hand.dot(a + shape * plate)
    d = hand.dot(arcs(third, hand.metres(rocker), c, hand.metres(rod)))
    bar, swing = d - c, d - third
    vb = hand.crossing(0j, 1j * arm, va, 1j * plate)
    vc = hand.dot(va + shape * (vb - va))
    vd = hand.crossing(0j, 1j * swing, vc, 1j * bar)
    first = hand.dot(hand.relative_normal(vb, arm / abs(arm) * hand.metres(140)))
    tip = hand.dot(aa + hand.relative_normal(vb - va, plate / abs(plate) * hand.metres(200)))
    ab = hand.crossing(first, 1j * arm, tip, 1j * plate)
    ac = hand.dot(aa + shape * (ab - aa))
    own = hand.dot(hand.relative_normal(vd, swing / abs(swing) * hand.metres(rocker)))
    away = hand.dot(ac + hand.relative_normal(vd - vc, bar / abs(bar) * hand.metres(rod)))
    ad = hand.crossing(own, 1j * swing, away, 1j * bar)
    hand.velocity("v_C", vc)
    hand.velocity("v_D", vd)
    hand.acceleration("a_C", ac)
    hand.acceleration("a_D", ad)
    hand.rate("omega_2", vb - va, plate, hand.metres(200))
    hand.rate("omega_5", vd, swing, hand.metres(rocker))
    hand.rate("epsilon_2", ab - tip, plate, hand.metres(200))
    hand.rate("epsilon_5", ad - own, swing, hand.metres(rocker))


def arcs(p: complex, own: float, q: complex, other: float) -> complex:
    """Where arcs about two points meet, to the left of the way from the first to the second."""
    axis = q - p
    along = (own**2 - other**2 + abs(axis) ** 2) / (2 * abs(axis))
    return p + complex(along, sqrt(own**2 - along**2)) * axis / abs(axis)


def pole(hand: Hand, ends: tuple[complex, complex], tips: tuple[complex, complex]) -> complex:
    """The pole of accelerations of a link: it lies to its ends as the plan's pole to their tips."""
    (p, q), (first, second) = ends, tips
    place = p + (q - p) * first / (first - second)
    return hand.crossing(p, place - p, q, place - q)


DRAW: dict[str, Callable[[Hand, Data], None]] = {
    "offset-slider-crank": slider_crank,
    "slotted-lever": slotted_lever,
    "pump": pump,
}


def drawn(
    lab: str,
    given: Data,
    sheet: tuple[float, float, float],
    rng: np.random.Generator | None = None,
    sigma: float = 0.0,
    degrees: float | None = None,
    ruler: float = 0.0,
    step: float = 0.0,
    slips: Collection[str] = (),
) -> dict[str, float]:
    """Every field of a lab's form as it is read off one drawing at a sheet of (kL, kv, ka).

    Rates have their sign. As many degrees as ``sigma`` has millimetres unless they are stated;
    without ``rng`` there are no errors. Raises ValueError where the drawing does not close.
    """
    hand = Hand(
        *sheet, rng, sigma, sigma if degrees is None else degrees, ruler, step, frozenset(slips)
    )
    DRAW[lab](hand, given)
    return hand.found


def key(lab: str, given: Data, sheet: tuple[float, float, float]) -> dict[str, float]:
    """Every field as it is: the drawing without errors."""
    return drawn(lab, given, sheet)
