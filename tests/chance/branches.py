"""What a scene has to say so that its groups close as they stand."""

from __future__ import annotations

import numpy as np
from msgspec.structs import replace

from graphkin.construction.core.run import run
from graphkin.construction.higher_class.closure_solver import ClosureSolver
from graphkin.mechanism import Mechanism
from graphkin.numbers.arithmetic import FLOAT
from graphkin.numbers.plane import cross, dot
from graphkin.scene.model import Closure, Scene
from graphkin.scene.read_scene import read_text
from graphkin.structure.groups import Dyad, Group, Higher, Stretched
from graphkin.structure.pairs import Pin, Sliding
from tests.chance.records import Standing
from tests.chance.written import Written

DEAD = 1e-6
"""Sine below which a dyad stands on its dead point."""
SAME = 1e-6
"""How far a closure may be from where its links stand, in radians, or parts of the mechanism."""


class NoSuchClosureError(LookupError):
    """A position that is not among the closures that were found."""


class DeadChainError(LookupError):
    """A group whose chain of dyads stands on a dead point of one of them where it closes.

    The plans of such a chain cannot be drawn, though the group as a whole may move.
    """


def branches_of(written: Written) -> dict[str, str]:
    """[branches] of a mechanism: sides and ways from the places, closures by looking."""
    found: dict[str, str] = {}
    open_scene = Mechanism(read_text(written.text({}), "made", None, {}))
    closing = [group for group in open_scene.groups if isinstance(group, Higher)]
    for group in open_scene.groups:
        if isinstance(group, Higher):
            refuse_dead(written.standing, group, open_scene.scene)
        else:
            found |= words_of(written.standing, group, open_scene.scene)
    links = [name for name in open_scene.scene.links if name not in found]
    higher = [(next(name for name in links if name in each.links), each) for each in closing]
    found |= {first: "closure 1" for first, _ in higher}
    for count, (first, group) in enumerate(higher):
        scene = read_text(written.text(found), "made", None, {})
        number = closure_number(written.standing, Mechanism(scene), group, count)
        found[first] = f"closure {number}"
    return found


def along_of(standing: Standing, scene: Scene, block: str) -> complex:
    """The direction of a block's guide; of one that keeps a wheel in place that of its track."""
    if block not in scene.keepers:
        return standing.slides[block].along
    wheel, rolling = scene.keepers[block]
    tracks = (each for each in standing.straights if (each.wheel, each.on) == (wheel, rolling.on))
    return next(tracks).along


def refuse_dead(standing: Standing, group: Higher, scene: Scene) -> None:
    """Raise DeadChainError where a dyad of a group's chains stands on its dead point."""
    for each in (each for one in group.nested for each in one.chain):
        dyad = each.dyad if isinstance(each, Stretched) else each
        if isinstance(dyad, Dyad) and abs(sine_of(standing, dyad, scene)) < DEAD:
            raise DeadChainError(f"links {', '.join(dyad.links)}")


def sine_of(standing: Standing, dyad: Dyad, scene: Scene) -> float:
    """How far a dyad is from its dead point; 1 for those that have none."""
    guides = [pair for pair in (dyad.left, dyad.inner, dyad.right) if isinstance(pair, Sliding)]
    if len(guides) == 2:
        first, second = (along_of(standing, scene, pair.links[0]) for pair in guides)
        return cross(first, second)
    left, inner, right = (
        standing.place(pair.place) if isinstance(pair, Pin) else 0j
        for pair in (dyad.left, dyad.inner, dyad.right)
    )
    if dyad.type == "RRR":
        return cross((inner - left) / abs(inner - left), (right - inner) / abs(right - inner))
    if dyad.type == "RRP":
        along = along_of(standing, scene, dyad.right.links[0])
        return dot(along, (inner - left) / abs(inner - left))
    if dyad.type == "RPR":
        along = along_of(standing, scene, dyad.inner.links[0])
        return dot(along, (right - left) / abs(right - left))
    return 1.0


def words_of(standing: Standing, group: Group, scene: Scene) -> dict[str, str]:
    """The branch of a dyad, if it has two."""
    dyad = group.dyad if isinstance(group, Stretched) else group
    if not isinstance(dyad, Dyad):
        return {}
    pins = [
        standing.place(pair.place) if isinstance(pair, Pin) else None
        for pair in (dyad.left, dyad.inner, dyad.right)
    ]
    left, inner, right = pins
    if dyad.type == "RRR":
        ends = dyad.left.place, dyad.right.place
        side = "left" if cross(right - left, inner - left) > 0 else "right"
        return {dyad.inner.point: f"{side} of {ends[0]}-{ends[1]}"}
    if dyad.type == "RRP":
        block = dyad.right.links[0]
        ahead = dot(along_of(standing, scene, block), inner - left)
        return way(block, ahead if block in dyad.links else -ahead)
    if dyad.type == "RPR":
        block, carrier = dyad.inner.links
        by_link = dict(zip(dyad.links, (left, right), strict=True))
        along = along_of(standing, scene, block)
        return way(block, dot(along, by_link[block] - by_link[carrier]))
    if dyad.type == "RRW":
        wheel = dyad.right.links[0]
        if wheel not in dyad.links:
            return {}
        track = next(each for each in standing.straights if each.wheel == wheel)
        return way(wheel, dot(track.along, inner - left))
    return {}


def way(name: str, ahead: float) -> dict[str, str]:
    """A way by its sign."""
    return {name: "forward" if ahead > 0 else "backward"}


def closure_number(standing: Standing, mechanism: Mechanism, group: Higher, count: int) -> int:
    """The number of the closure in which a group stands as generated."""
    program = mechanism.program
    closers = [
        step
        for step in program.steps
        if step.action is not None and isinstance(step.action.value, ClosureSolver)
    ]
    step = closers[count]
    alone = replace(program, targets={("", str(arg)): arg for arg in step.args})
    needed = alone.needed(alone.targets)
    values = run(alone, needed, mechanism.scene.values, FLOAT).values
    trying = step.action.value.trying
    known = [np.atleast_1d(values[arg]) for arg in step.args]
    table = trying.closures(known).table
    tried, signs = np.split(table[:, 1:-1], [len(trying.unknowns)], axis=1)
    here = [np.broadcast_to(each, len(table)) for each in known]
    found = trying.found(here, tried, signs)
    links = [name for name in mechanism.scene.links if name in group.links]
    off = np.max(
        [
            abs(found[step] - standing.bodies[name].axis)
            for name, step in zip(links, trying.axes, strict=True)
            if name in standing.bodies
        ],
        axis=0,
        initial=0.0,
    )
    near = np.flatnonzero(off < SAME)
    if len(near) == 1:
        return int(near[0]) + 1
    for number in near:
        if stands(standing, mechanism, group, int(number) + 1):
            return int(number) + 1
    raise NoSuchClosureError(f"{len(table)} closures, the nearest off by {off.min(initial=9):.1e}")


def stands(standing: Standing, mechanism: Mechanism, group: Higher, number: int) -> bool:
    """Whether all points of a group stand as generated in a closure."""
    branches = {**mechanism.scene.branches}
    first = next(name for name in mechanism.scene.links if name in group.links)
    branches[first] = Closure(number)
    other = Mechanism(replace(mechanism.scene, branches=branches))
    points = [p for link in group.links for p in mechanism.scene.links[link].points]
    trace = other.trace([("position", p) for p in points])
    return all(
        abs(trace.value("position", p) - standing.place(p)) < SAME * standing.size for p in points
    )
