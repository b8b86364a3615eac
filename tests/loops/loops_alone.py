"""The motion of a scene by the loops alone, without a construction, as a solution."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from graphkin.construction.core.quantities import LinkMotion, PointMotion, SlideMotion
from graphkin.construction.core.solution import Solution
from graphkin.loops.assemble import assemble
from graphkin.loops.loop_motion import Motion
from graphkin.loops.newton import LoopSolution
from graphkin.numbers.plane import Ratio
from graphkin.scene.model import FRAME, Scene


def by_loops(scene: Scene, values: Mapping[str, Any] | None = None) -> Solution:
    """The motion of every point, link and block of a scene, assembled by the loops from nothing.

    SI units, centres and poles included; with arrays of parameter ``values`` arrays, NaN where a
    setting does not close. Raises WitnessError where one scene does not close, StructureError where
    [branches] leave more than one closure or drivers are missing.
    """
    return as_solution(assemble(scene, values))


def as_solution(found: LoopSolution) -> Solution:
    """What the loops found as the records in which a construction gives it."""
    motion, loops = found.motion, found.loops
    single = loops.numbers.single

    def own(array: Any) -> Any:
        return array[0].item() if single else array

    named = (FRAME, *loops.scene.links)
    points = {
        name: PointMotion(*(own(row[:, i]) for row in motion.points))
        for name, i in motion.names.items()
    }
    links = {name: link_motion(motion, motion.index[name], own) for name in named[1:]}
    slides = {
        guide.block: SlideMotion(*map(own, motion.slide(j)))
        for j, guide in enumerate(loops.guides)
        if guide.first
    }
    pairs = [(pair, *pair.split("-")) for pair in loops.scene.ask.pairs]
    centres = {pair: relative(motion, first, second, own) for pair, first, second in pairs}
    return Solution(points, links, slides, centres=centres)


def link_motion(motion: Motion, i: int, own: Any) -> LinkMotion:
    """The motion of a link, its centre and its poles."""
    start, velocity, acceleration = (own(row[:, i]) for row in motion.origin)
    omega, epsilon = own(motion.omega[:, i]), own(motion.epsilon[:, i])
    return LinkMotion(
        omega,
        epsilon,
        Ratio(start, 1j * velocity, omega),
        Ratio(start, acceleration, omega**2 - 1j * epsilon),
        Ratio(start, acceleration * omega - epsilon * velocity, omega**3),
    )


def relative(motion: Motion, first: str, second: str, own: Any) -> Ratio:
    """The centre of the second link's motion against the first."""
    i, j = motion.index[first], motion.index[second]
    start, velocity = motion.origin.place[:, j], motion.origin.velocity[:, j]
    slip = velocity - motion.carried(first, start).velocity
    return Ratio(own(start), 1j * own(slip), own(motion.omega[:, j] - motion.omega[:, i]))
