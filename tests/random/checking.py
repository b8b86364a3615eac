"""The construction of a random mechanism against the loops and against exact differences."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from graphkin.mechanism import Mechanism
from graphkin.scene.read import read_text
from graphkin.steps.solution import Solution
from graphkin.structure.groups import Dyad, Higher, Stretched
from tests.random.branches import branches_of
from tests.random.exact import Motion, motion
from tests.random.groups import made
from tests.random.records import Standing
from tests.random.written import Written

EPS = 2.0**-52
CLOSE = 1e-10
"""What the routes may differ by away from singular positions, in parts of the largest."""
TINY = 1e-9
"""What counts as rest, in parts of what the drivers could do."""


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

    def bound(self, solution: Solution) -> float:
        """How far the routes may lie apart: by the flattest crossing, as rounding grows there."""
        spread = self.standing.size / self.standing.least
        return max(CLOSE, 64 * EPS * spread / max(solution.margin, 1e-9) ** 3)


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
    """The mechanism of a seed, its scene complete; None where nothing could be made."""
    standing, kinds = made(seed)
    if not kinds:
        return None
    written = Written(standing)
    text = written.text(branches_of(written))
    return Case(
        seed, kinds, standing, written, text, Mechanism(read_text(text, f"made-{seed}", None, {}))
    )


@dataclass
class Checked:
    """How far the construction is from the loops and from exact differences, and what it may be."""

    case: Case
    loops: float
    where_loops: str
    exact: float
    where_exact: str
    bound: float
    margin: float

    @property
    def agrees(self) -> bool:
        """Whether all three routes agree; NaN does not."""
        return self.loops <= self.bound and self.exact <= self.bound


def checked(case: Case) -> Checked:
    """Construct, and hold the construction against both other routes."""
    solution = case.mechanism.solve()
    verdict = case.mechanism.witness(solution)
    found = max(differences(solution, motion(case.written)), key=lambda pair: pair[0])
    loops = verdict.largest_difference if not verdict.branches else float("nan")
    return Checked(
        case,
        loops,
        verdict.quantity + "".join(f" branch {name}" for name in verdict.branches),
        *found,
        case.bound(solution),
        solution.margin,
    )


def differences(solution: Solution, exact: Motion) -> Iterator[tuple[float, str]]:
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
    for name, states in points.items():
        ours = solution.points[name]
        yield from over(
            f"point {name}", states, (ours.position, ours.velocity, ours.acceleration), sizes
        )
    for name, (_, *states) in links.items():
        ours = solution.links[name]
        yield from over(f"link {name}", states, (ours.omega, ours.epsilon), (omega, twist))
    for name, states in slides.items():
        ours = solution.slides[name]
        values = ours.position, ours.speed, ours.acceleration
        yield from over(f"slide {name}", states[:3], values, sizes)
        coriolis = ours.coriolis or 0j
        yield abs(coriolis - states[3]) / sizes[2], f"slide {name} Coriolis"


def over(name, states, ours, sizes) -> Iterator[tuple[float, str]]:
    """Differences of a few quantities, each over its size."""
    kinds = ("position", "velocity", "acceleration")[-len(states) :]
    for kind, expected, found, size in zip(kinds, states, ours, sizes, strict=True):
        yield abs(found - expected) / size, f"{name} {kind}"
