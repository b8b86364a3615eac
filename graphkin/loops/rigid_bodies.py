"""Rigid bodies as numbers: each link's points and guides in its own axes, by trigonometry.

Local coordinates are relative to the link's first point, so that a drawing far from its origin
loses no digits. Lengths are in metres. Every value is a float or, in a batch, an array of shape
(N,).

Bodies that three or more equal bars keep parallel, and the bars that are spare because of that.

Equal bars stay parallel where their pins form congruent figures on both bodies. Two such bars could
cross, but a third one does not fit then. Each bar beyond two removes no freedom, and a count with
it seems to determine bodies that still move.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import reduce
from itertools import combinations
from typing import Any

import numpy as np
from msgspec import Struct

from graphkin.numbers.arithmetic import FLOAT, Kind, Point, Real, batch_kind
from graphkin.scene.model import (
    FRAME,
    Angled,
    Apart,
    At,
    GuideOrTrack,
    Link,
    OnLine,
    Placing,
    Polar,
    Scene,
    Slide,
    Triangle,
    Wheel,
)
from graphkin.scene.quantity import Quantity
from graphkin.text.errors import StructureError, message

Reals = np.ndarray[Any, np.dtype[np.float64]]
Complexes = np.ndarray[Any, np.dtype[np.complex128]]
Body = Mapping[str, Point]


class Numbers(Struct, frozen=True):
    """The scene's parameters as set, and the number of settings (N; 1 for one scene)."""

    values: Mapping[str, Any]
    kind: Kind
    count: int

    @classmethod
    def of(cls, values: Mapping[str, Any]) -> Numbers:
        """One setting in floats, or a batch if any value is an array of shape (N,)."""
        sizes = {len(value) for value in values.values() if hasattr(value, "shape")}
        if len(sizes) > 1:
            raise ValueError(f"arrays of one length expected, found lengths {sorted(sizes)}")
        return cls(values, batch_kind() if sizes else FLOAT, sizes.pop() if sizes else 1)

    def si(self, quantity: Quantity) -> Real:
        """A length, speed or angle in SI units."""
        return quantity.si(self.values, self.kind)

    def error(self, quantity: Quantity) -> Real:
        """Bound (SI) of the rounding error of a number computed by sums and functions."""
        return quantity.error(self.values, self.kind)

    def direction(self, quantity: Quantity) -> Point:
        """The unit vector of an angle."""
        return quantity.direction(self.values, self.kind)

    def reals(self, value: Real) -> Reals:
        """A value as an array of shape (N,)."""
        array = np.asarray(value, dtype=np.float64)
        return array.reshape(1) if self.count == 1 else np.broadcast_to(array, (self.count,))

    def complexes(self, value: Point) -> Complexes:
        """A vector as an array of shape (N,)."""
        array = np.asarray(value, dtype=np.complex128)
        return array.reshape(1) if self.count == 1 else np.broadcast_to(array, (self.count,))

    def columns(self, values: Sequence[Any], dtype: type = complex) -> Complexes:
        """Many values as columns, each a number or an array of shape (N,): (N, values)."""
        if any(getattr(value, "shape", ()) for value in values):
            shape = (self.count,)
            return np.stack(
                [np.broadcast_to(np.asarray(each, dtype), shape) for each in values], axis=1
            )
        found: Complexes = np.array([values], dtype)
        return found if self.count == 1 else np.broadcast_to(found, (self.count, len(values)))

    @property
    def single(self) -> bool:
        """Whether this is a single scene, whose failures are raised; a batch masks them."""
        return self.kind is FLOAT


class Guide(Struct, frozen=True):
    """A sliding pair, or the straight path of a wheel's centre along its track.

    The ``point`` of ``block`` is at through + (s + i·offset)·along, with ``through`` and the unit
    vector ``along`` in the axes of the link ``on``. ``number`` is its index among the slides or
    tracks of the block. ``first`` marks the guide reported under the block's name; a slide also
    sets the block's x axis along that guide. ``moved_by`` is the kind of driver that moves the
    block along it.
    """

    block: str
    on: str
    through: Point
    along: Point
    offset: Real
    first: bool
    point: str
    number: int
    moved_by: str = "slide"

    @property
    def turns_alike(self) -> bool:
        """Whether its two links turn alike, as on all guides except a track."""
        return self.moved_by == "slide"


def bodies_of(scene: Scene, numbers: Numbers) -> tuple[dict[str, Body], dict[str, Point]]:
    """Points of every link from its own first point, and that point's place in the written axes."""
    bodies: dict[str, Body] = {}
    starts: dict[str, Point] = {}
    for name in (FRAME, *scene.links):
        link = scene.link(name)
        placed = placed_points(link, numbers)
        starts[name] = placed[link.points[0]] if link.points else 0j
        bodies[name] = {point: where - starts[name] for point, where in placed.items()}
    return bodies, starts


def placed_points(link: Link, numbers: Numbers) -> dict[str, Point]:
    """Every point of a link in the axes of the scene."""
    placed: dict[str, Point] = {}
    with np.errstate(all="ignore"):
        for placing in link.placings:
            place = located(placing, placed, numbers)
            if numbers.single and not np.isfinite(place):
                raise StructureError.at(
                    f"links.{link.name}.{placing.point}",
                    message("the lengths give no such point"),
                    message("sides of a triangle, each shorter than the other two together"),
                )
            placed[placing.point] = place
    for point in link.points:
        placed.setdefault(point, 0j)
    return placed


def located(placing: Placing, placed: Mapping[str, Point], numbers: Numbers) -> Point:
    """One point from those placed before it; an unplaced point counts as the origin."""
    si = numbers.si

    def at(name: str) -> Point:
        return placed.get(name, 0j)

    match placing:
        case At(_, x, y):
            return si(x) + 1j * si(y)
        case Polar(_, start, length, angle):
            return at(start) + si(length) * numbers.direction(angle)
        case Apart(_, start, length):
            return at(start) + si(length)
        case Triangle(_, first, second, from_first, from_second, side):
            base = at(second) - at(first)
            turned = half_angle(si(from_first), si(from_second), abs(base), side)
            return at(first) + si(from_first) * turned**2 * unit(base)
        case OnLine(_, first, second, start, length, sense):
            return at(start) + sense * si(length) * unit(at(second) - at(first))
        case Angled(_, vertex, arm, length, angle):
            turned = numbers.direction(angle) * unit(at(arm) - at(vertex))
            return at(vertex) + si(length) * turned


def half_angle(near: Real, far: Real, base: Real, side: int) -> Point:
    """Unit vector at half the angle between ``near`` and ``base``, from the three sides.

    This is the law of cosines in half angles; the square of the vector is the direction of
    ``near``. NaN where there is no such triangle.
    """
    cosine = (near + base + far) * (near + base - far)
    sine = (far + (near - base)) * (far - (near - base))
    root = np.sqrt(4 * near * base)
    return (np.sqrt(cosine) + 1j * side * np.sqrt(sine)) / root


def radius(wheel: Wheel, numbers: Numbers) -> Real:
    """The radius of a wheel (m)."""
    assert wheel.radius is not None
    return numbers.si(wheel.radius)


def unit(vector: Point) -> Point:
    """A vector divided by its length; NaN for zero length."""
    length = np.abs(vector)
    return vector / np.where(length > 0, length, np.nan)


def guides_of(
    scene: Scene, bodies: Mapping[str, Body], starts: Mapping[str, Point], numbers: Numbers
) -> tuple[Guide, ...]:
    """Every sliding pair in the axes of the link that carries the guide."""
    guides: list[Guide] = []
    for link in scene.links.values():
        for number, slide in enumerate(link.slides):
            if slide.on not in bodies:
                continue
            through, along = guide_line(slide, bodies[slide.on], starts[slide.on], numbers)
            offset = numbers.si(slide.offset)
            first = not any(guide.block == link.name for guide in guides)
            point = next(iter(bodies[link.name]), "")
            guides.append(Guide(link.name, slide.on, through, along, offset, first, point, number))
    return tuple(guides)


def guide_line(slide: Slide, body: Body, start: Point, numbers: Numbers) -> tuple[Point, Point]:
    """A point of a guide and its unit vector, relative to the first point of the guide's link."""
    if slide.along is not None:
        first, second = slide.along
        return body[first], unit(body[second] - body[first])
    return written_line(slide, body, start, numbers)


def written_line(
    line: GuideOrTrack, body: Body, start: Point, numbers: Numbers
) -> tuple[Point, Point]:
    """A point and the unit vector of a line written by ``through`` and ``angle``."""
    along = 1.0 + 0j if line.angle is None else numbers.direction(line.angle)
    match line.through:
        case str(name):
            return body[name], along
        case (x, y):
            return numbers.si(x) + 1j * numbers.si(y) - start, along
    return -start, along


def longest(scene: Scene, bodies: Mapping[str, Body], numbers: Numbers) -> Reals:
    """The longest distance of two points of one link, or radius (m): (N,); 1 if all are zero."""
    links = scene.every_link
    lengths = list[Any]()
    for body in bodies.values():
        places = numbers.columns(list(body.values()))
        for i in range(places.shape[1] - 1):
            lengths.append(abs(places[:, i + 1 :] - places[:, i : i + 1]).max(axis=1))
    lengths += [radius(wheel, numbers) for link in links for wheel in link.wheels]
    most = numbers.reals(reduce(np.maximum, lengths, 0.0))
    return np.where(most == 0, 1.0, most)


SAME = 1e-9
"""Relative difference of two lengths that rounding leaves."""


class Parallel(Struct, frozen=True):
    """Two ``bodies`` kept parallel by ``bars``; ``along`` is the second's x axis from the first."""

    bodies: tuple[str, str]
    bars: tuple[str, ...]
    along: Point


class JoiningBar(Struct, frozen=True):
    """A link that joins two bodies: the vector between its pins, and these pins on each body."""

    link: str
    way: Any
    near: Any
    far: Any


def parallels(bodies: Mapping[str, Body]) -> Iterator[Parallel]:
    """The bodies that are kept parallel, in each setting of a batch."""
    joined: dict[tuple[str, str], list[JoiningBar]] = {}
    owners: dict[str, list[str]] = {}
    for name, body in bodies.items():
        for point in body:
            owners.setdefault(point, []).append(name)
    for link, body in bodies.items():
        pins = [(other, p) for p in body for other in owners[p] if other != link]
        for one, other in combinations(pins, 2):
            if one[0] != other[0] and one[1] != other[1]:
                (near, p), (far, q) = sorted((one, other))
                bar = JoiningBar(link, body[q] - body[p], bodies[near][p], bodies[far][q])
                joined.setdefault((near, far), []).append(bar)
    for pair, bars in joined.items():
        yield from parallel_sets(pair, bars)


def parallel_sets(pair: tuple[str, str], bars: list[JoiningBar]) -> Iterator[Parallel]:
    """The sets of parallel bars among the bars between two bodies."""
    while len(bars) > 2:
        one, *bars = bars
        for other in bars:
            alike = [bar for bar in bars if are_parallel(one, other, bar)]
            if len(alike) > 1:
                turn = (other.near - one.near) / (other.far - one.far)
                names = (one.link, *(bar.link for bar in alike))
                yield Parallel(pair, names, turn / abs(turn))
                bars = [bar for bar in bars if bar not in alike]
                break


def are_parallel(one: JoiningBar, other: JoiningBar, third: JoiningBar) -> bool:
    """Whether three bars are equal and their pins form congruent figures on both bodies.

    The third bar may be the second one itself.
    """
    near, far = other.near - one.near, other.far - one.far
    if not np.all(abs(near) * abs(far)):
        return False
    turn = far / near
    pairs = [(abs(bar.way), abs(one.way)) for bar in (other, third)]
    pairs += [(third.far - one.far, turn * (third.near - one.near)), (abs(far), abs(near))]
    apart = np.all(abs(third.near - one.near))
    return bool(apart) and all(np.all(abs(a - b) <= SAME * abs(b)) for a, b in pairs)


def spare_bars(bodies: Mapping[str, Body], busy: Collection[str]) -> frozenset[str]:
    """The plain bars beyond two in each set that stays parallel.

    A plain bar has two pins, each on one other body, and is not ``busy`` with anything else.
    """
    owners = [point for body in bodies.values() for point in body]
    plain = {
        link
        for link, body in bodies.items()
        if link not in busy and sorted(owners.count(point) for point in body)[-3:] == [2, 2]
    }
    sets = (each.bars for each in parallels(bodies))
    return frozenset(bar for bars in sets for bar in sparing(bars, plain))


def sparing(bars: tuple[str, ...], plain: Collection[str]) -> list[str]:
    """The bars that can be left out of a set, later ones first, so that two remain."""
    able = [bar for bar in reversed(bars) if bar in plain]
    return able[: max(0, len(bars) - 2)]
