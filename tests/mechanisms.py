"""Mechanisms made at random for the laws to hold on: positions first, so that they always close.

A mechanism is kept as the places where its points stand and as who is joined to whom; the scene,
with its lengths, angles, coordinates and sides, is written from the places. So to scale, turn,
shift or mirror a mechanism is to do so with its places.
"""

from __future__ import annotations

import math
from cmath import phase, rect
from collections.abc import Callable
from functools import cache

from hypothesis import settings
from hypothesis import strategies as st
from msgspec import Struct
from msgspec.structs import replace

from graphkin.mechanism import Mechanism, load
from graphkin.numbers.plane import cross, dot
from graphkin.scene.read_scene import read_text
from tests.chosen import EVERY

HEAD = """graphkin = 1
title = "made at random"
units = { length = "m", angle = "deg", speed = "rad/s" }
"""


COIN = st.booleans()
SHIPPED = ("pump", "pump-collinear")
LAW = settings(max_examples=100 if EVERY else 20, deadline=None, derandomize=True, database=None)
"""A law holds on so many mechanisms made at random, the same ones at every run."""


@cache
def shipped(name: str, n: int) -> Mechanism:
    """A shipped mechanism for a student's number."""
    return load(name, n=n)


def scene_of(text: str, **settings: object):
    """The scene of a text in metres, degrees and rad/s."""
    return read_text(HEAD + text, "made", None, settings)


def mechanism_of(text: str, **settings: object) -> Mechanism:
    """The mechanism of a text in metres, degrees and rad/s."""
    return Mechanism(scene_of(text, **settings))


class Bar(Struct, frozen=True):
    """A link with its points in the order written, and how the scene tells where they lie.

    ``how`` is "lengths" (sides, lines), "angles" or "coordinates"; ``axes`` are the link's own
    axes (origin and direction of x, in the plane) where it is given by coordinates.
    """

    name: str
    points: tuple[str, ...]
    how: str = "lengths"
    axes: tuple[complex, complex] = (0j, 1 + 0j)


class Block(Struct, frozen=True):
    """A block on a straight guide of the frame, pinned at one of its points.

    ``along`` is the direction of the guide, ``offset`` the first point's distance to its left and
    ``zero`` the coordinate of the first point; ``points`` has the first point first.
    """

    name: str
    points: tuple[str, ...]
    pin: str
    along: complex
    offset: float
    zero: float


class Driver(Struct, frozen=True):
    """A crank's motion: link, pivot and tip, ω (rad/s) and ε (rad/s²)."""

    link: str
    pivot: str
    tip: str
    speed: float
    acceleration: float = 0.0


class Made(Struct, frozen=True):
    """A closed mechanism: where its points stand, its links, drivers, and pins with their sides."""

    places: dict[str, complex]
    frame: tuple[str, ...]
    bars: tuple[Bar, ...]
    blocks: tuple[Block, ...]
    drivers: tuple[Driver, ...]
    hinges: tuple[tuple[str, str, str], ...]
    """Inner pins with the two known pins of their dyads."""
    swings: tuple[tuple[str, str], ...]
    """Blocks with the pin that holds the other end of their rod."""

    def text(self, moving: bool = False) -> str:
        """The scene, without its head; if moving, ``h`` seconds away from the places."""
        parts = ["[parameters]", "h = 0"] if moving else []
        parts += ["[frame]", *(f"{p} = {pair(self.places[p])}" for p in self.frame)]
        for bar in self.bars:
            parts += [f"[links.{bar.name}]", *self.shape(bar)]
        for block in self.blocks:
            parts += [f"[links.{block.name}]", *self.guided(block)]
        for driver in self.drivers:
            parts += ["[[drivers]]", *self.driven(driver, moving)]
        return "\n".join([*parts, "[branches]", *self.branches(), ""])

    def mechanism(self) -> Mechanism:
        """The mechanism of the scene."""
        return mechanism_of(self.text())

    def shape(self, bar: Bar) -> list[str]:
        """How the scene gives the points of a link."""
        spots = [self.places[point] for point in bar.points]
        if bar.how == "coordinates":
            origin, axis = bar.axes
            local = [(spot - origin) * axis.conjugate() for spot in spots]
            return [f"{p} = {pair(z)}" for p, z in zip(bar.points, local, strict=True)]
        (p, q), (a, b) = bar.points[:2], spots[:2]
        words = [f"{p}-{q} = {abs(b - a)!r}"]
        for point, spot in zip(bar.points[2:], spots[2:], strict=True):
            words += angled(p, q, point, a, b, spot) if bar.how == "angles" else ()
            words += sided(p, q, point, a, b, spot) if bar.how == "lengths" else ()
        return words

    def guided(self, block: Block) -> list[str]:
        """A block's points in axes along its guide, and the guide."""
        first = self.places[block.points[0]]
        local = [(self.places[p] - first) * block.along.conjugate() for p in block.points]
        foot = first - block.along * (block.zero + 1j * block.offset)
        words = [f"{p} = {pair(z)}" for p, z in zip(block.points, local, strict=True)]
        angle = number(math.degrees(phase(block.along)))
        guide = f"on = 0, through = {pair(foot)}, angle = {angle}, offset = {number(block.offset)}"
        return [*words, f"slides = {{ {guide} }}"]

    def driven(self, driver: Driver, moving: bool) -> list[str]:
        """The driver: its angle is that of the link's x axis, or of the bar that it names."""
        bar = next(bar for bar in self.bars if bar.name == driver.link)
        a, b = (self.places[point] for point in bar.points[:2])
        turn = bar.axes[1] if bar.how == "coordinates" else b - a
        angle, speed, rate = math.degrees(phase(turn)), driver.speed, driver.acceleration
        law, now = number(angle), repr(speed)
        if moving:
            law = f'"{law} + ({math.degrees(speed)!r})*h + ({math.degrees(rate) / 2!r})*h*h"'
            now = f'"({speed!r}) + ({rate!r})*h"'
        return [
            f"turn = {driver.link}",
            f"angle = {law}",
            f"speed = {now}",
            f"acceleration = {rate!r}",
        ]

    def branches(self) -> list[str]:
        """The side of every inner pin and the way of every block, as the places show them."""
        words = []
        for pin, left, right in self.hinges:
            p, q, z = (self.places[name] for name in (left, right, pin))
            side = "left" if cross(q - p, z - p) > 0 else "right"
            words.append(f'{pin} = "{side} of {left}-{right}"')
        for name, far in self.swings:
            block = next(block for block in self.blocks if block.name == name)
            ahead = dot(block.along, self.places[block.pin] - self.places[far]) > 0
            words.append(f'{name} = "{"forward" if ahead else "backward"}"')
        return words

    def moved(
        self, place: Callable[[complex], complex], way: Callable[[complex], complex], sense: int
    ) -> Made:
        """The same mechanism with every place and every direction changed; sense -1 if mirrored."""
        size = abs(way(1 + 0j))

        def unit(direction: complex) -> complex:
            return way(direction) / size

        return replace(
            self,
            places={name: place(z) for name, z in self.places.items()},
            bars=tuple(
                replace(bar, axes=(place(bar.axes[0]), unit(bar.axes[1]))) for bar in self.bars
            ),
            blocks=tuple(
                replace(
                    block,
                    along=unit(block.along),
                    offset=sense * size * block.offset,
                    zero=size * block.zero,
                )
                for block in self.blocks
            ),
            drivers=tuple(
                replace(d, speed=sense * d.speed, acceleration=sense * d.acceleration)
                for d in self.drivers
            ),
        )

    def scaled(self, size: float) -> Made:
        """All lengths multiplied."""
        return self.moved(lambda z: size * z, lambda u: size * u, 1)

    def turned(self, unit: complex) -> Made:
        """The whole mechanism turned about the origin."""
        return self.moved(lambda z: unit * z, lambda u: unit * u, 1)

    def shifted(self, by: complex) -> Made:
        """The whole mechanism moved without turning."""
        return self.moved(lambda z: z + by, lambda u: u, 1)

    def mirrored(self) -> Made:
        """The mechanism's image in a mirror along the x axis."""
        return self.moved(complex.conjugate, complex.conjugate, -1)

    def sped(self, factor: float) -> Made:
        """The drivers turning faster; their accelerations grow with the square."""
        return replace(
            self,
            drivers=tuple(
                replace(d, speed=factor * d.speed, acceleration=factor**2 * d.acceleration)
                for d in self.drivers
            ),
        )

    def steady(self) -> Made:
        """The drivers at constant speed."""
        return replace(self, drivers=tuple(replace(d, acceleration=0.0) for d in self.drivers))


def pair(z: complex) -> str:
    """A point as the scene writes it."""
    return f"[{number(z.real)}, {number(z.imag)}]"


def number(x: float) -> str:
    """A number as the scene writes it, all digits; what only rounding left is zero."""
    return repr(x if abs(x) > 1e-30 else 0.0)


def sided(p: str, q: str, r: str, a: complex, b: complex, c: complex) -> list[str]:
    """A third point by two lengths and a side, or by one length where it lies on the line."""
    lean = cross(b - a, c - a) / abs(b - a) ** 2
    if abs(lean) < 1e-9:
        part = dot(b - a, c - a) / abs(b - a) ** 2
        if part > 1:
            return [f"{q}-{r} = {abs(c - b)!r}", f'{r} = "beyond {q} on {p}-{q}"']
        word = "on" if part > 0 else f"beyond {p} on"
        return [f"{p}-{r} = {abs(c - a)!r}", f'{r} = "{word} {p}-{q}"']
    side = "left" if lean > 0 else "right"
    return [
        f"{p}-{r} = {abs(c - a)!r}",
        f"{q}-{r} = {abs(c - b)!r}",
        f'{r} = "{side} of {p}-{q}"',
    ]


def angled(p: str, q: str, r: str, a: complex, b: complex, c: complex) -> list[str]:
    """A third point by one length and the angle that it makes at the first point."""
    angle = number(math.degrees(phase((c - a) / (b - a))))
    return [f"{p}-{r} = {abs(c - a)!r}", f"{q}-{p}-{r} = {angle}"]


# --- at random -----------------------------------------------------------------------------------


@cache
def log_scaled(low: float, high: float) -> st.SearchStrategy[float]:
    """Numbers between two powers, all orders of magnitude alike."""
    powers = st.integers(round(1000 * math.log10(low)), round(1000 * math.log10(high)))
    return powers.map(lambda power: 10.0 ** (power / 1000))


@cache
def signs() -> st.SearchStrategy[int]:
    """+1 or -1."""
    return st.sampled_from((1, -1))


@cache
def angles(low: float, high: float) -> st.SearchStrategy[float]:
    """Angles in radians between two in degrees, in steps of a thousandth of a degree."""
    return st.integers(round(1000 * low), round(1000 * high)).map(lambda a: math.radians(a / 1000))


@cache
def directions() -> st.SearchStrategy[complex]:
    """Unit vectors, the four quarters often among them."""
    quarters = st.sampled_from((1 + 0j, 1j, -1 + 0j, -1j))
    return angles(-180, 180).map(lambda angle: rect(1, angle)) | quarters


@st.composite
def mechanisms(draw, most=3, spread=1.0, cross_at=20, steady=None, types=("RRR", "RRP")) -> Made:
    """Cranks and dyads one after the other, sizes log-scaled over ``spread`` orders of magnitude.

    Every dyad crosses at ``cross_at`` degrees or more. ``steady`` fixes whether the cranks have
    no acceleration.
    """
    maker = Maker(draw, draw(log_scaled(1e-3, 1e3)), spread, cross_at)
    for _ in range(draw(st.sampled_from((1, 1, 1, 2)))):
        maker.crank(draw(st.booleans()) if steady is None else steady)
    for _ in range(draw(st.integers(1, most))):
        if draw(st.sampled_from(types)) == "RRR":
            maker.hinge()
        else:
            maker.swing()
    return maker.made()


class Maker:
    """Adds one crank or dyad after the other to what stands already."""

    def __init__(self, draw, size: float, spread: float, cross_at: float) -> None:
        self.draw, self.size, self.spread, self.cross_at = draw, size, spread, cross_at
        self.places: dict[str, complex] = {}
        self.frame: list[str] = []
        self.moving: list[str] = []
        self.bars: list[Bar] = []
        self.blocks: list[Block] = []
        self.drivers: list[Driver] = []
        self.hinges: list[tuple[str, str, str]] = []
        self.swings: list[tuple[str, str]] = []

    def made(self) -> Made:
        """What has been put together."""
        return Made(
            self.places,
            tuple(self.frame),
            tuple(self.bars),
            tuple(self.blocks),
            tuple(self.drivers),
            tuple(self.hinges),
            tuple(self.swings),
        )

    def coin(self) -> bool:
        """Heads or tails."""
        return self.draw(COIN)

    def length(self) -> float:
        """A length of this mechanism's order of magnitude."""
        half = 10 ** (self.spread / 2)
        return self.size * self.draw(log_scaled(1 / half, half))

    def point(self, where: complex, moving: bool = True) -> str:
        """A new point."""
        name = f"P{len(self.places)}"
        self.places[name] = where
        (self.moving if moving else self.frame).append(name)
        return name

    def fixed(self, where: complex) -> str:
        """A new point of the frame."""
        return self.point(where, moving=False)

    def bar(self, start: str, end: str) -> str:
        """A new link on two points, perhaps with a third that is its own."""
        points = [start, end]
        a, b = self.places[start], self.places[end]
        if self.coin():
            turn = self.draw(angles(17, 160)) * self.draw(signs())
            third = a + rect(self.length(), turn) * (b - a) / abs(b - a)
            if self.draw(st.integers(0, 3)) == 0:
                third = a + (b - a) * self.draw(st.sampled_from((0.5, 0.25, -0.5, 1.75)))
            points.append(self.point(third))
        if self.coin():
            points[:2] = points[1], points[0]
        how = self.draw(st.sampled_from(("lengths", "lengths", "angles", "coordinates")))
        name = f"{len(self.bars) + len(self.blocks) + 1}"
        axes = (a + self.length() * self.draw(directions()), self.draw(directions()))
        self.bars.append(Bar(name, tuple(points), how, axes))
        return name

    def crank(self, steady: bool) -> None:
        """A driven bar on the frame."""
        where = self.length() * self.draw(directions())
        pivot = self.fixed(where)
        tip = self.point(where + self.length() * self.draw(directions()))
        link = self.bar(pivot, tip)
        speed = self.draw(log_scaled(1e-2, 1e3)) * self.draw(signs())
        rate = 0.0 if steady else speed**2 * self.draw(log_scaled(0.03, 3)) * self.draw(signs())
        self.drivers.append(Driver(link, pivot, tip, speed, rate))

    def hinge(self) -> None:
        """A dyad RRR: its inner pin somewhere, its other end on the frame or on what moves."""
        left = self.draw(st.sampled_from(self.moving))
        first = self.length() * self.draw(directions())
        pin = self.places[left] + first
        right = self.fitting(left, pin)
        if right is None:
            turn = self.draw(angles(self.cross_at, 180 - self.cross_at))
            way = first / abs(first) * rect(1, turn * self.draw(signs()))
            right = self.fixed(pin + self.length() * way)
        inner = self.point(pin)
        self.bar(left, inner)
        self.bar(right, inner)
        self.hinges.append((inner, left, right))

    def fitting(self, left: str, pin: complex) -> str | None:
        """A point that stands already and from which the inner pin is seen across, at times."""
        if self.coin():
            return None
        a = pin - self.places[left]
        for name in self.moving:
            b = pin - self.places[name]
            if name == left or abs(b) == 0:
                continue
            size = abs(b) / self.size
            sine = abs(cross(a, b)) / (abs(a) * abs(b))
            if (
                sine > math.sin(math.radians(self.cross_at))
                and size * 10 ** (self.spread / 2) / 3 > 0.1
            ):
                return name
        return None

    def swing(self) -> None:
        """A dyad RRP: a rod from a moving pin to a block, the guide across the rod's end."""
        left = self.draw(st.sampled_from(self.moving))
        first = self.length() * self.draw(directions())
        inner = self.point(self.places[left] + first)
        self.bar(left, inner)
        turn = self.draw(angles(0, 90 - self.cross_at)) * self.draw(signs())
        along = first / abs(first) * rect(1, turn) * self.draw(signs())
        points = [inner]
        if self.coin():
            points.append(self.point(self.places[inner] + self.length() * self.draw(directions())))
            if self.coin():
                points.reverse()
        name = f"{len(self.bars) + len(self.blocks) + 1}"
        offset = self.draw(st.sampled_from((0.0, 1.0, -1.0))) * self.length()
        zero = self.length() * self.draw(signs())
        self.blocks.append(Block(name, tuple(points), inner, along, offset, zero))
        self.swings.append((name, left))
