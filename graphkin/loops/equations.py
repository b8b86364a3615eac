"""The loop equations f(φ, q) = 0 of a planar mechanism, with exact first and second derivatives.

Unknowns φ: the angle θ_k of every turning but the frame's (radians), then the coordinate s_j of
every slide (metres). Equations: the two components of every closed chain (metres), then for each
driver its coordinate less its given value. All arrays carry the N settings of a batch first.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from graphkin.errors import Problem, StructureError
from graphkin.loops.bodies import (
    Body,
    Complexes,
    Guide,
    Numbers,
    Reals,
    bodies_of,
    guides_of,
    spans,
    unit,
)
from graphkin.loops.chains import Chains, Linear, packed
from graphkin.loops.vectors import Tree, Turnings, turnings
from graphkin.scene.model import FRAME, Driver, Scene


@dataclass(frozen=True, slots=True, eq=False)
class Drives:
    """The given motions: row d of ``selects`` (D, K + m) picks the driven coordinate.

    A turning driver compares the unit vector e^{i(selected angle)}·``lean`` with ``aim``, a
    sliding one its coordinate with ``aim``; all (N, D). ``speed`` and ``acceleration`` in SI.
    """

    selects: Reals
    turns: np.ndarray[Any, np.dtype[np.bool_]]
    lean: Complexes
    aim: Complexes
    speed: Reals
    acceleration: Reals

    def residual(self, unknowns: Reals) -> Reals:
        """Driven coordinate less given value, angles within half a turn: shape (N, D)."""
        coordinate = unknowns @ self.selects.T
        angle = np.angle(np.exp(1j * coordinate) * self.lean * self.aim.conj())
        return np.where(self.turns, angle, coordinate - self.aim.real)


@dataclass(frozen=True, slots=True, eq=False)
class Equations:
    """The vector loops of a scene: chains to every link's origin, and the chains that close.

    ``bodies`` place each link's points about its origin; ``owners`` gives the first link of each of
    the ``points`` and the point's local coordinates (N, points); ``home`` (N,) is the frame's first
    point; ``size`` and ``least`` (N,) are the longest and shortest bar in metres.
    """

    numbers: Numbers
    links: tuple[str, ...]
    points: tuple[str, ...]
    owners: tuple[list[int], Complexes]
    bodies: Mapping[str, Body]
    guides: tuple[Guide, ...]
    turned: Turnings
    chains: Chains
    drives: Drives
    home: Complexes
    size: Reals
    least: Reals

    @property
    def turning_count(self) -> int:
        """How many unknown angles there are."""
        return int(self.turned.count) - 1

    @property
    def unknown_count(self) -> int:
        """How many unknowns there are."""
        return self.turning_count + len(self.guides)

    @property
    def equation_count(self) -> int:
        """How many equations there are: two a closed chain, one a driver."""
        chains = self.chains.fixed.shape[1] - len(self.links)
        return int(2 * chains + len(self.drives.turns))

    @property
    def columns(self) -> Reals:
        """What one unit of each unknown is when lengths count in bars: (N, K + m)."""
        metres = np.ones((len(self.size), self.unknown_count))
        metres[:, self.turning_count :] = self.size[:, None]
        return metres

    @property
    def rows(self) -> Reals:
        """What one unit of each equation is when lengths count in bars: (N, equations)."""
        metres = np.repeat(self.size[:, None], self.equation_count, axis=1)
        metres[:, self.equation_count - len(self.drives.turns) :][:, self.drives.turns] = 1
        return metres

    def closures(self, rows: Reals | Complexes) -> Reals:
        """Two real equations from each closed chain among the rows (the second axis)."""
        closed = rows[:, len(self.links) :]
        return np.concatenate([closed.real, closed.imag], axis=1)

    def residual(self, linear: Linear, unknowns: Reals) -> Reals:
        """f(φ, q): shape (N, 2·closed chains + D)."""
        closed = self.closures(linear.place)
        return np.concatenate([closed, self.drives.residual(unknowns)], axis=1)

    def jacobian(self, linear: Linear, driven: bool = True) -> Reals:
        """∂f/∂φ: shape (N, equations, K + m); without the drivers' rows on request."""
        rows = np.concatenate([1j * linear.turned, linear.along], axis=-1)
        closed = self.closures(rows)
        if not driven:
            return closed
        shape = (closed.shape[0], *self.drives.selects.shape)
        return np.concatenate([closed, np.broadcast_to(self.drives.selects, shape)], axis=1)

    def second(self, linear: Linear, u: Reals, v: Reals) -> Reals:
        """Second derivative of f in two directions: drivers' rows are linear and give none."""
        closed = self.closures(self.chains.second(linear, u, v))
        return np.concatenate([closed, np.zeros_like(self.drives.speed)], axis=1)

    def guide_index(self, block: str, on: str | None = None) -> int | None:
        """The slide of a block: on a given link, or the one it names first."""
        for index, guide in enumerate(self.guides):
            if guide.block == block and (guide.on == on if on is not None else guide.first):
                return index
        return None


def equations(scene: Scene, values: Mapping[str, Any] | None = None) -> Equations:
    """Write the loop equations of a scene, for its own parameter values or for a batch of them.

    Raises StructureError for pairs that are not covered and links that nothing joins.
    """
    refuse_rolling(scene)
    numbers = Numbers.of({**scene.values, **(values or {})})
    bodies, starts = bodies_of(scene, numbers)
    guides = guides_of(scene, bodies, starts, numbers)
    turned = turnings(scene, guides)
    tree = Tree(bodies, guides, turned)
    links = (FRAME, *scene.links)
    refuse_loose(links, tree)
    chains = packed([*(tree.origins[name] for name in links), *tree.closures()], tree, numbers)
    lengths = spans(bodies, numbers)
    owner = {point: link for link in reversed(links) for point in bodies[link]}
    arms = [numbers.complexes(bodies[link][point]) for point, link in owner.items()]
    return Equations(
        numbers=numbers,
        links=links,
        points=tuple(owner),
        owners=([links.index(link) for link in owner.values()], np.stack(arms, axis=1)),
        bodies=bodies,
        guides=guides,
        turned=turned,
        chains=chains,
        drives=drives_of(scene, bodies, guides, turned, numbers),
        home=numbers.complexes(starts[FRAME]),
        size=lengths.max(axis=1),
        least=np.where(lengths > 0, lengths, np.inf).min(axis=1),
    )


def refuse_rolling(scene: Scene) -> None:
    """Say which pairs the vector loops do not cover."""
    problems = [
        Problem(
            f"links.{link.name}.rolls",
            "rolling and gear pairs are not covered by the vector loops yet",
            "pins and straight slides",
        )
        for link in scene.links.values()
        if link.rolls
    ]
    problems += [
        Problem(f"drivers.{number}", "a rolling driver is not covered by the vector loops yet")
        for number, driver in enumerate(scene.drivers, 1)
        if driver.kind == "roll"
    ]
    if problems:
        raise StructureError(problems)


def refuse_loose(links: Sequence[str], tree: Tree) -> None:
    """Every link must hang on the frame through pins and guides."""
    loose = [name for name in links if name not in tree.origins]
    if loose:
        raise StructureError(
            Problem(
                f"links.{name}",
                "no pin or guide joins this link to the frame",
                "a point shared with another link, or slides",
            )
            for name in loose
        )


def drives_of(
    scene: Scene,
    bodies: Mapping[str, Body],
    guides: Sequence[Guide],
    turned: Turnings,
    numbers: Numbers,
) -> Drives:
    """The drivers' equations."""
    count = len(scene.drivers)
    selects = np.zeros((count, turned.count + len(guides)))
    lean = np.ones((numbers.count, count), dtype=np.complex128)
    aim = np.zeros((numbers.count, count), dtype=np.complex128)
    speed, acceleration = np.zeros((2, numbers.count, count))
    for d, driver in enumerate(scene.drivers):
        if driver.kind == "turn":
            selects[d, turned.of[driver.link]] += 1
            selects[d, turned.of[driver.against]] -= 1
            lean[:, d] = driven_line(driver, bodies, turned) / turned.lean[driver.against]
            aim[:, d] = numbers.direction(driver.position)
        else:
            selects[d, turned.count + driven_slide(d, driver, guides)] = 1
            aim[:, d] = numbers.si(driver.position)
        speed[:, d] = numbers.si(driver.speed)
        acceleration[:, d] = numbers.si(driver.acceleration)
    turns = np.array([driver.kind == "turn" for driver in scene.drivers], dtype=np.bool_)
    return Drives(selects[:, 1:], turns, lean, aim, speed, acceleration)


def driven_line(driver: Driver, bodies: Mapping[str, Body], turned: Turnings) -> Any:
    """Direction of the line whose angle is driven, in the link's turning."""
    if driver.of is None:
        return turned.lean[driver.link]
    start, end = (bodies[driver.link][name] for name in driver.of)
    return turned.lean[driver.link] * unit(end - start)


def driven_slide(number: int, driver: Driver, guides: Sequence[Guide]) -> int:
    """Which slide coordinate is driven."""
    for index, guide in enumerate(guides):
        if (guide.block, guide.on) == (driver.link, driver.against):
            return index
    raise StructureError(
        Problem(
            f"drivers.{number + 1}",
            f"link {driver.link} does not slide on link {driver.against}",
            "a block and the link that carries its guide",
        )
    )
