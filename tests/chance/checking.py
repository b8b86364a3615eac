"""The construction of a random mechanism against the loops and against exact differences."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from graphkin.construction.core.solution import Solution
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.structure.groups import Dyad, Higher, Stretched
from graphkin.text.errors import StructureError, WitnessError
from tests.chance.branches import DeadChainError, branches_of
from tests.chance.exact import Motion, motion
from tests.chance.making import made
from tests.chance.many_digits import in_many_digits
from tests.chance.records import FRAME, Standing
from tests.chance.written import Shaken, Written

EPS = 2.0**-52
FLATTEST = 1e-4
"""Sine below which nothing is drawn any more."""
CLOSE = 1e-10
"""What the routes may differ by, in parts of the largest."""
CENTRE = 1e-9
"""The same of what moves still at a centre or pole, as the loops tell it.

Its place is as sure as the whole mechanism is large, while all that turns about it may be a bar a
thousand times shorter.
"""
ROUNDED = 16
"""How many times they may differ beyond that as what one rounding of every number makes."""
SHAKES = 3
"""How often all numbers are shaken to see that."""
TINY = 1e-9
"""What counts as rest, in parts of what the drivers could do."""

ASKED = re.compile(
    r"wheel of (the frame|link \w+) alone hold link (\w+), write link = \"?(\w+)\"? in rolls of"
)
"""How an error proposes to name what keeps a wheel at a track."""


@dataclass
class Case:
    """A mechanism made at random, with its scene."""

    seed: int
    kinds: tuple[str, ...]
    standing: Standing
    written: Written
    text: str
    mechanism: Mechanism

    @property
    def types(self) -> list[str]:
        """What its groups are called."""
        return [title_of(group) for group in self.mechanism.groups]

    @cached_property
    def exact(self) -> Motion:
        """The motion by exact differences."""
        return motion(self.written)

    def law(self, sine: float) -> float:
        """What rounding may grow to in accelerations by the least sine and the shortest bar.

        Positions, velocities and accelerations lose once, twice and three times by a flat crossing.
        """
        spread = self.standing.size / self.standing.least
        return 64 * EPS * spread / max(sine, FLATTEST) ** 3

    @cached_property
    def shaken(self) -> float:
        """How far the exact motion moves when every number is off by the share of a rounding."""
        with in_many_digits():
            others = [motion(self.written, Shaken(self.written, n)) for n in range(SHAKES)]
        return max(max(differences(each, self.exact))[0] for each in others)


def title_of(group: object) -> str:
    """The kind of a group, without the names of its links."""
    if isinstance(group, Stretched):
        return f"cylinder {group.dyad.type}"
    if isinstance(group, Dyad):
        return f"dyad {group.type}"
    if isinstance(group, Higher):
        return group.title
    return type(group).__name__.lower()


def case(seed: int) -> Case | None:
    """The mechanism of a seed, its scene complete.

    None where no more than a point could be made, or where a group is tried by a dyad on its dead
    point.
    """
    standing, kinds = made(seed)
    if not kinds or not standing.size:
        return None
    try:
        return told(seed, standing, kinds)
    except DeadChainError:
        return None


def told(seed: int, standing: Standing, kinds: tuple[str, ...]) -> Case:
    """A mechanism as its scene tells it.

    Where the scene leaves open what keeps a wheel at a track, it names that as the error proposes.
    """
    for left in range(len(standing.straights), -1, -1):
        written = Written(standing)
        try:
            text = written.text(branches_of(written))
            mechanism = Mechanism(read_text(text, f"made-{seed}", None, {}))
            assert mechanism.program
            break
        except StructureError as error:
            asked = ASKED.search(str(error))
            if asked is None or not left:
                raise
            wheel, on, keeper = asked.groups()
            wheel = FRAME if wheel == "the frame" else wheel.removeprefix("link ")
            for each in standing.straights:
                if (each.wheel, each.on) == (wheel, on):
                    each.keeper = keeper
    return Case(seed, kinds, standing, written, text, mechanism)


@dataclass
class Checked:
    """How far the construction is from the loops and from exact differences."""

    case: Case
    loops: float
    where_loops: str
    exact: float
    where_exact: str
    margin: float
    """The least sine of the construction, which may cross flatly where the mechanism does not."""
    refused: bool = False
    """Whether the loops say that the position is singular."""

    @property
    def bound(self) -> float:
        """How far the routes may lie apart.

        Farther where rounding the scene alone does as much, or where lines cross flatly and short
        bars carry far points.
        """
        if self.loops <= CLOSE and self.exact <= CLOSE:
            return CLOSE
        return max(CLOSE, ROUNDED * self.case.shaken, self.case.law(self.margin))

    @property
    def agrees(self) -> bool:
        """Whether all three routes agree; NaN does not.

        The loops may refuse only what rounding the scene moves by more than routes may differ.
        """
        if self.refused:
            return self.case.shaken > CLOSE and self.exact <= self.bound
        is_centre = self.where_loops.endswith(("_pole", "_centre"))
        loops = max(self.bound, CENTRE) if is_centre else self.bound
        return self.loops <= loops and self.exact <= self.bound


def checked(case: Case) -> Checked:
    """Construct, and hold the construction against both other routes."""
    solution = case.mechanism.solve()
    found = max(differences(solution, case.exact), key=lambda pair: pair[0])
    try:
        verdict = case.mechanism.witness(solution)
    except WitnessError as error:
        refused = "singular" in str(error)
        return Checked(case, math.nan, str(error), *found, solution.margin, refused)
    loops = verdict.largest_difference if not verdict.branches else math.nan
    where = verdict.quantity + "".join(f" branch {name}" for name in verdict.branches)
    return Checked(case, loops, where, *found, solution.margin)


def differences(solution: Solution | Motion, exact: Motion) -> Iterator[tuple[float, str]]:
    """Every difference over the largest such quantity in the mechanism."""
    points, links, slides = exact.points, exact.links, exact.slides
    first = next(iter(points.values()))[0]
    length = max(abs(z - first) for z, _, _ in points.values())
    omega = max(abs(each[1]) for each in links.values())
    twist = max(abs(each[2]) for each in links.values())
    speed = max(abs(each[1]) for each in (*points.values(), *slides.values()))
    push = max(abs(each[2]) for each in (*points.values(), *slides.values()))
    time = exact.period
    natural = max(speed**2 / length, omega**2 * length)
    speed = max(speed, 1e-3 * omega * length, TINY * length / time)
    omega = max(omega, 1e-3 * speed / length)
    push = max(push, 1e-3 * max(natural, twist * length), TINY * length / time**2)
    twist = max(twist, 1e-3 * max(natural, push) / length)
    sizes = length, speed, push
    ours = states_of(solution)
    for name, states in points.items():
        yield from over(f"point {name}", states, ours["point", name], sizes)
    for name, (_, *states) in links.items():
        yield from over(f"link {name}", states, ours["link", name], (omega, twist))
    for name, (*states, coriolis) in slides.items():
        *values, found = ours["slide", name]
        yield from over(f"slide {name}", states, values, sizes)
        yield abs(found - coriolis) / sizes[2], f"slide {name} Coriolis"


def states_of(found: Solution | Motion) -> dict[tuple[str, str], tuple]:
    """All that is compared of a motion: places and their rates, links' rates, slides."""
    if isinstance(found, Motion):
        links = {("link", name): tuple(rates) for name, (_, *rates) in found.links.items()}
        points = {("point", name): states for name, states in found.points.items()}
        return points | links | {("slide", name): each for name, each in found.slides.items()}
    points = {
        ("point", name): (each.position, each.velocity, each.acceleration)
        for name, each in found.points.items()
    }
    links = {("link", name): (each.omega, each.epsilon) for name, each in found.links.items()}
    slides = {
        ("slide", name): (each.position, each.speed, each.acceleration, each.coriolis or 0j)
        for name, each in found.slides.items()
    }
    return points | links | slides


def over(name, states, ours, sizes) -> Iterator[tuple[float, str]]:
    """Differences of a few quantities, each over its size."""
    kinds = ("position", "velocity", "acceleration")[-len(states) :]
    for kind, expected, found, size in zip(kinds, states, ours, sizes, strict=True):
        yield abs(found - expected) / size, f"{name} {kind}"
