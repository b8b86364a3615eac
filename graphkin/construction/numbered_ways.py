"""The number of a closure for links that two pins guide, in the ways that the scene now states.

Such links were one group of higher class once, and a scene stated the number of its closure.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product

from msgspec.structs import replace

from graphkin.construction.compile import write
from graphkin.construction.core.branches import block_of, key_of
from graphkin.construction.core.run import StepFailed, run
from graphkin.construction.higher_class.closure_solver import SAME
from graphkin.numbers.arithmetic import FLOAT, np, phase
from graphkin.scene.model import Branch, Closure, Scene, Side, Way
from graphkin.structure.decomposition import decompose
from graphkin.structure.groups import CoupledTrain, Dyad, Group, Higher, OnTwoPins, Stretched
from graphkin.structure.pairs import Pin
from graphkin.text.errors import StructureError

Order = tuple[float, ...]
"""By what closures are put in order: angles of links, then places of points."""


def in_ways(scene: Scene) -> Scene:
    """The scene with ways in place of each number of a closure of links that two pins guide.

    The same where there are none, or no closure of that number.
    """
    try:
        groups = decompose(scene)
        for name, branch in scene.branches.items():
            members = guided_with(groups, name)
            if isinstance(branch, Closure) and members:
                scene = with_ways(scene, groups, name, branch.number, members)
    except StructureError:  # what reads the groups after this tells it
        pass
    return scene


def guided_with(groups: tuple[Group, ...], name: str) -> list[Group]:
    """The group that a link guided by two pins is in, and all that guide its links."""
    guides = [group for group in groups if isinstance(group, OnTwoPins)]
    for group in groups:
        members = [*(each for each in guides if each.rail in group.links), group]
        is_tried = isinstance(group, Higher | CoupledTrain)
        if len(members) > 1 and not is_tried and any(name in each.links for each in members):
            return members
    return []


def with_ways(
    scene: Scene, groups: tuple[Group, ...], name: str, number: int, members: Sequence[Group]
) -> Scene:
    """The scene with the ways of the members in place of the number under a name."""
    branches = {key: branch for key, branch in scene.branches.items() if key != name}
    bare = replace(scene, branches=branches)
    free = [ways for each in members if (ways := [*open_ways(bare, each)])]
    choices = (dict(choice) for choice in product(*free))
    found: list[tuple[Order, Scene]] = []
    for choice in choices:
        stated = replace(scene, branches=branches | choice)
        try:
            found.append((order_of(stated, groups, members), stated))
        except StepFailed:  # this is no closure
            continue
    found.sort(key=lambda each: each[0])
    return found[number - 1][1] if number <= len(found) else scene


def open_ways(scene: Scene, group: Group) -> Iterator[tuple[str, Branch]]:
    """The ways of a group, each with its key; none where the scene states one, or none is open."""
    dyad, key = group.dyad if isinstance(group, Stretched) else group, key_of(scene, group)
    if not isinstance(dyad, Dyad) or key is None or key in scene.branches:
        return
    if isinstance(dyad.left, Pin) and isinstance(dyad.right, Pin) and dyad.type == "RRR":
        for side in (1, -1):
            yield key, Side(dyad.left.place, dyad.right.place, side)
    elif block_of(dyad) not in scene.branches:
        for way in (1, -1):
            yield key, Way(way)


def order_of(scene: Scene, groups: tuple[Group, ...], members: Sequence[Group]) -> Order:
    """What puts a closure in order: angles in the order of links, then places of their points.

    Raises StepFailed where it is none.
    """
    program = write(scene, groups, fitted=False)
    links = [name for name in scene.links if any(name in each.links for each in members)]
    points = dict.fromkeys(point for name in links for point in scene.links[name].points)
    wanted = [("axis", name) for name in links] + [("position", point) for point in points]
    values = run(program, program.needed(wanted), scene.values, FLOAT).values
    found = [values[program.targets[target]] for target in wanted]
    turns = (phase(axis) for axis in found[: len(links)])
    angles = [float(np.mod(turn + SAME, 2 * np.pi) // (2 * SAME)) for turn in turns]
    return (*angles, *(part for place in found[len(links) :] for part in (place.real, place.imag)))
