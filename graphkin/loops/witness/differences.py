"""Every difference between a solution and the loops, over its scale, and what rounding allows."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from math import nan
from typing import Any

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.quantities import (
    KINDS,
    OF_POINTS,
    OF_SLIDES,
    RATES,
    MotionQuantity,
    motion_value,
)
from graphkin.construction.core.solution import UNKNOWN, Solution
from graphkin.loops.equations import equations
from graphkin.loops.loop_motion import Motion
from graphkin.loops.newton import LoopSolution
from graphkin.loops.rigid_bodies import Complexes, Reals
from graphkin.loops.rounding import Rounding
from graphkin.loops.witness.centre_differences import centre_differences
from graphkin.numbers.plane import Ratio
from graphkin.scene.model import Scene

Flags = np.ndarray[Any, np.dtype[np.bool_]]
FLOOR = 1e-3
"""Share of its natural size below which a scale is not taken seriously."""
LOST = 0.1
"""Bound of an error, as a share of the quantity, from which no digit of it is sure."""
LEAST_LIMIT = 1e-9
"""Difference that is always allowed."""
MOST_DIGITS = 15
"""Digits that a double has."""
KINDS_OF = {each.attribute: each.kind for each in (*OF_POINTS, *RATES, *OF_SLIDES)}
"""Of which derivative each quantity is; centres have none."""


class Differences(Struct, frozen=True, eq=False, dict=True):
    """Differences by the ``names`` of their quantities, the bounds of their errors, and the sizes
    of the quantities, all over their scales: each of shape (Q, N).
    """

    names: tuple[str, ...]
    found: Reals
    bound: Reals
    size: Reals

    @classmethod
    def of(cls, rows: Sequence[tuple[str, Any, Any, Any]], count: int) -> Differences:
        """From the name, difference, bound and size, (N,) each, of every quantity."""
        if not rows:
            return cls((), *np.zeros((3, 0, count)))
        names, *columns = zip(*rows, strict=True)
        return cls(tuple(names), *map(np.array, columns))

    @cached_property
    def sure(self) -> Flags:
        """Where some digit of the quantity is sure."""
        return np.asarray(~(share(self.bound, self.size) > LOST))

    @cached_property
    def judged(self) -> Flags:
        """Where the difference is judged: not where both routes know nothing; NaN is."""
        return np.asarray(self.sure | np.isnan(self.found))

    @cached_property
    def limit(self) -> Reals:
        """The largest difference that is allowed."""
        return np.maximum(LEAST_LIMIT, self.bound)


def share(bound: Reals, size: Reals) -> Reals:
    """A bound as a share of the quantity; of a small one, as that of a thousandth."""
    return np.asarray(bound / np.maximum(size, FLOOR))


class Magnitudes(Struct, frozen=True, eq=False):
    """Largest magnitude of each kind of quantity in the scene that is sure, shape (N,)."""

    length: Reals
    speed: Reals
    acceleration: Reals
    omega: Reals
    epsilon: Reals

    @classmethod
    def of(cls, motion: Motion, bounds: Rounding, length: Reals) -> Magnitudes:
        """Measured on the loops; a quantity that is zero throughout has scale 1."""
        points, errors = motion.points, bounds.points
        slides = np.stack(
            [largest(*pair) for pair in zip(motion.slides, bounds.slides, strict=True)]
        )
        speed = np.maximum(largest(points.velocity, errors.velocity), slides[1])
        pushed = np.maximum(largest(points.acceleration, errors.acceleration), slides[2])
        omega = largest(motion.omega, bounds.omega)
        epsilon = largest(motion.epsilon, bounds.epsilon)
        natural = np.maximum(speed**2 / length, omega**2 * length)
        fastest = np.maximum(speed, FLOOR * omega * length)
        turning = np.maximum(omega, FLOOR * speed / length)
        most = np.maximum(pushed, FLOOR * np.maximum(natural, epsilon * length))
        twist = np.maximum(epsilon, FLOOR * np.maximum(natural, pushed) / length)
        return cls(length, *map(or_one, (fastest, most, turning, twist)))


def largest(values: Reals | Complexes, bounds: Reals) -> Reals:
    """The largest magnitude in each row of which some digit is sure; zero where there is none."""
    sizes = np.abs(values)
    return np.asarray(np.where(bounds > LOST * sizes, 0.0, sizes).max(axis=1, initial=0.0))


def or_one(scale: Reals) -> Reals:
    """A scale to divide by: 1 where all is at rest, so that differences stay absolute."""
    return np.where(scale == 0, 1.0, scale)


def differing(solved: LoopSolution, solution: Solution, extent: Reals) -> Differences:
    """Every difference that can be taken, by the quantity's name."""
    scales = Magnitudes.of(solved.motion, solved.rounding, extent)
    pairs = (
        *of_points(solved, solution, scales),
        *of_links(solved, solution, scales),
        *of_slides(solved, solution, scales),
    )

    rows = [
        (name, abs(ours - theirs) / scale, bound / scale, abs(theirs) / scale)
        for name, ours, theirs, bound, scale in pairs
        if ours is not None
    ]
    left = centre_differences(solved, solution, scales)
    rows += [(name, each.found, each.bound, each.size) for name, each in left]
    return Differences.of(rows, len(extent))


Pairs = Iterator[tuple[str, Any, Reals | Complexes, Reals, Reals]]
"""Name of a quantity, its value by the solution and by the loops, its bound, its scale."""


def of_points(solved: LoopSolution, solution: Solution, scales: Magnitudes) -> Pairs:
    """Position, velocity and acceleration of every point."""
    for name, point in solution.points.items():
        found = solved.motion.point(name), solved.rounding.point(name)
        yield from paired(f"points.{name}", point, OF_POINTS, *found, scales)


def paired(
    name: str,
    ours: object,
    quantities: Sequence[MotionQuantity],
    theirs: Sequence[Any],
    bounds: Sequence[Any],
    scales: Magnitudes,
) -> Pairs:
    """Some quantities of a point or a block, which the loops give in the same order."""
    sizes = dict(zip(KINDS, (scales.length, scales.speed, scales.acceleration), strict=True))
    for each, *pair in zip(quantities, theirs, bounds, strict=True):
        yield f"{name}.{each.attribute}", motion_value(ours, each), *pair, sizes[each.kind]


def of_links(solved: LoopSolution, solution: Solution, scales: Magnitudes) -> Pairs:
    """ω and ε of every link."""
    motion, bounds = solved.motion, solved.rounding
    for name, link in solution.links.items():
        i = motion.index[name]
        for rate in RATES:
            theirs, bound = motion_value(motion, rate)[:, i], motion_value(bounds, rate)[:, i]
            path = f"links.{name}.{rate.attribute}"
            yield path, motion_value(link, rate), theirs, bound, motion_value(scales, rate)


def of_slides(solved: LoopSolution, solution: Solution, scales: Magnitudes) -> Pairs:
    """The motion of every block along its guide."""
    for name, slide in solution.slides.items():
        j = solved.loops.guide_index(name)
        if j is not None:
            found = solved.motion.slide(j), solved.rounding.slide(j)
            yield from paired(f"slides.{name}", slide, OF_SLIDES, *found, scales)


def digits_of(differences: Differences) -> dict[str, int]:
    """How many significant digits are sure of every position, velocity and acceleration.

    As many as rounding leaves the loops, and no more than those in which both routes agree. Of one
    smaller than a thousandth of the largest of its kind, digits of that thousandth.
    """
    found: dict[str, int] = {}
    apart = np.fmax(differences.bound, differences.found)[:, 0]
    shares = share(apart, differences.size[:, 0]).tolist()
    for name, off in zip(differences.names, shares, strict=True):
        kind = KINDS_OF.get(name.rpartition(".")[2])
        if kind is not None:
            found[kind] = min(found.get(kind, MOST_DIGITS), sure_digits(off))
    return found


def sure_digits(share: float) -> int:
    """How many digits are sure of what may be off by a share of itself."""
    if not share <= LOST:
        return 0
    return min(MOST_DIGITS, int(-np.log10(max(share, 1e-99))))


def sure_of(solution: Solution, unsure: Mapping[str, Any]) -> Solution:
    """The solution with NaN for every quantity of which no digit is sure, by its path.

    Of a batch of N each path has flags (N,), and only the variants that they mark are lost.
    """
    parts: dict[str, dict[str, Any]] = {}
    for path, where in unsure.items():
        part, name, *key = path.split(".")
        motions = parts.setdefault(part, dict(getattr(solution, part)))
        found = getattr(motions[name], key[0]) if key else motions[name]
        without = lost(found, where)
        motions[name] = replace(motions[name], **{key[0]: without}) if key else without
    return replace(solution, **parts)


def lost(value: Any, where: Any = True) -> Any:
    """What stands for a value of which no digit is sure, or for some rows of an array."""
    if isinstance(value, Ratio):
        return Ratio(*(lost(part + 0j, where) for part in value))
    gone = UNKNOWN if np.iscomplexobj(value) else nan
    return gone if where is True else np.where(where, gone, value)


def evenness(scene: Scene) -> float:
    """The shortest vector of the loops and arm of a wheel, in parts of the longest."""
    loops = equations(scene)
    sizes = [abs(loops.chains.fixed).ravel(), abs(loops.slips.rows).ravel()]
    lengths = np.concatenate([part[part > 0] for part in sizes])
    return float(lengths.min() / lengths.max()) if lengths.size else 1.0
