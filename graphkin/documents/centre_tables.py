"""Centres and poles of links: at a point, at infinity, or none for a link at rest."""

from __future__ import annotations

from cmath import isfinite, phase
from collections.abc import Iterable, Mapping
from math import degrees
from typing import Any

from msgspec.structs import replace

from graphkin.construction.core.quantities import LinkMotion, MotionQuantity, PointMotion
from graphkin.construction.core.solution import UNKNOWN, Solution
from graphkin.numbers.arithmetic import at
from graphkin.numbers.plane import Ratio
from graphkin.scene.model import FRAME, Scene
from graphkin.structure.turning import guides_under
from graphkin.text.tables import NOISE, Cell, cleaned, number, table

FAR = 1e9
"""Distance beyond which a centre counts as at infinity, in breadths of the mechanism."""
NOT_SURE = "not sure"
SURE = 9
"""Decimals of a direction in degrees, beyond which digits are rounding errors."""


def place_of(ratio: Ratio | None, breadth: float) -> complex | None:
    """The point of a ratio (m); None at infinity and where every point would do.

    NaN where no digit is reliable.
    """
    if ratio is not None and not isfinite(ratio.shift):
        return UNKNOWN
    if ratio is None or abs(ratio.shift) >= FAR * breadth * abs(ratio.size):
        return None
    return complex(ratio.start + ratio.shift / ratio.size)


def breadth_of(solution: Solution) -> float:
    """Half the perimeter of the box around all points (m), 1 if they coincide."""
    places = [p.position for p in solution.points.values() if p.position is not None]
    places = [z for z in places if isfinite(z)]
    xs, ys = [z.real for z in places], [z.imag for z in places]
    return (max(xs) - min(xs) + max(ys) - min(ys) if places else 0.0) or 1.0


def largest(values: Iterable[complex | float | None]) -> float:
    """The largest magnitude among the known values; zero if there are none."""
    known = (abs(value) for value in values if value is not None)
    return max((size for size in known if isfinite(size)), default=0.0)


def with_blocks(scene: Scene, solution: Solution) -> Solution:
    """The solution with every moving link added: a block turns with its guide.

    A link at rest has neither centre nor pole, since each of its points is one.
    """
    turning = largest(link.omega for link in solution.links.values())
    spinning = largest(link.epsilon for link in solution.links.values())
    speeds = largest(point.velocity for point in solution.points.values())
    rates = largest(point.acceleration for point in solution.points.values())
    links = {}
    for name in scene.links:
        motion = with_pole(solution.links.get(name), motion_of_block(scene, name, solution))
        points = [solution.points[p] for p in scene.links[name].points if p in solution.points]
        stops = still([motion.omega], turning)
        if stops and still((p.velocity for p in points), speeds):
            motion = replace(motion, instant_centre=None)
        unmoved = stops and still([motion.epsilon], spinning)
        if unmoved and still((p.acceleration for p in points), rates):
            motion = replace(motion, acceleration_pole=None)
        links[name] = motion
    return replace(solution, links=links)


def with_pole(motion: LinkMotion | None, turned: LinkMotion) -> LinkMotion:
    """The motion of a link, with its pole from its rotation where no two points gave the pole."""
    if motion is None:
        return turned
    if motion.acceleration_pole is not None or motion.epsilon is None:
        return motion
    return replace(motion, acceleration_pole=turned.acceleration_pole)


def still(values: Iterable[complex | float | None], biggest: float) -> bool:
    """Whether every value is known and negligible relative to the largest of its kind."""
    found = list(values)
    return bool(found) and all(z is not None and abs(z) <= NOISE * biggest for z in found)


def motion_of_block(scene: Scene, name: str, solution: Solution) -> LinkMotion:
    """The motion of a block that turns with its guide; on the frame it does not turn."""
    point = next((p for p in scene.links[name].points if p in solution.points), None)
    motion = solution.points[point] if point is not None else PointMotion()
    own = solution.links.get(name)
    omega, epsilon = (own.omega, own.epsilon) if own else turning_of_guide(scene, name, solution)
    if motion.position is None or omega is None:
        return LinkMotion(omega, epsilon)
    centre = pole = None
    if motion.velocity is not None:
        centre = Ratio(motion.position, 1j * motion.velocity, omega)
    if motion.acceleration is not None and epsilon is not None:
        pole = Ratio(motion.position, -motion.acceleration, at(-omega * omega, epsilon))
    return LinkMotion(omega, epsilon, centre, pole)


def turning_of_guide(
    scene: Scene, name: str, solution: Solution
) -> tuple[float | None, float | None]:
    """ω and ε of the link that carries the guides under a block, through any number of blocks."""
    for link in guides_under(scene, name):
        if link == FRAME:
            return 0.0, 0.0
        if link in solution.links:
            return solution.links[link].omega, solution.links[link].epsilon
    return None, None


def centre_words(ratio: Ratio | None, breadth: float) -> str:
    """The place of an instantaneous centre (m), or its direction at infinity."""
    place = place_of(ratio, breadth)
    if place is not None:
        return point_words(place, breadth)
    if ratio is None or ratio.shift == 0:
        return "every point: the link is at rest"
    return f"at infinity, in direction {number(direction(ratio.shift) % 180)}°"


def pole_words(ratio: Ratio | None, acceleration: complex | None, breadth: float) -> str:
    """The place of an acceleration pole (m), or the common direction when it is at infinity."""
    place = place_of(ratio, breadth)
    if place is not None:
        return point_words(place, breadth)
    if ratio is None or not acceleration:
        return "every point: none of them accelerates"
    return f"at infinity: all accelerate alike, towards {number(direction(acceleration))}°"


def direction(vector: complex) -> float:
    """The direction of a vector in degrees, without rounding errors."""
    return round(degrees(phase(vector)), SURE) + 0.0


def relative_table(solution: Solution, names: Iterable[str], unit: str = "m") -> list[str]:
    """The places of the relative centres of two links."""
    breadth = breadth_of(solution)
    rows: list[list[Cell]] = []
    for name in names:
        ratio = solution.centres[name]
        words = centre_words(ratio, breadth)
        if place_of(ratio, breadth) is None and ratio.shift == 0:
            words = "every point: they move as one"
        rows.append([name.replace("-", " and "), words])
    return table(["links", f"centre of both, {unit}"], rows) if rows else []


def circles_table(
    records: Mapping[str, dict[str, Any]], quantity: MotionQuantity, unit: str = "m"
) -> list[str]:
    """The circle of a quantity for each link or point that reports one."""
    assert quantity.circle is not None
    found = {name: one[quantity.key] for name, one in records.items() if quantity.key in one}
    heads = list(quantity.circle.parts(0j, 0j))
    rows: list[list[Cell]] = []
    for name, circle in found.items():
        cells: list[Cell] = [quantity.circle.missing, *[None] * (len(heads) - 1)]
        if circle is not None:
            cells = [circle[key] if key == "radius" else pair_words(circle[key]) for key in heads]
        rows.append([name, *cells])
    named = {heads[0]: quantity.words, "centre": "centre of circle", "radius": "radius"}
    columns = [f"{({**named, heads[0]: quantity.words})[key]}, {unit}" for key in heads]
    return table([quantity.whose.removesuffix("s"), *columns], rows) if rows else []


def pair_words(pair: list[float | None]) -> str:
    """The coordinates of a pair in brackets."""
    known = [part for part in pair if part is not None]
    return point_words(complex(*known)) if len(known) == len(pair) else NOT_SURE


def point_words(place: complex, breadth: float = 0.0) -> str:
    """A point's coordinates in brackets; rounding errors of a mechanism so broad are zeros."""
    if not isfinite(place):
        return NOT_SURE
    x, y = (cleaned(part, max(abs(place), breadth)) for part in (place.real, place.imag))
    return f"({number(x)}, {number(y)})"
