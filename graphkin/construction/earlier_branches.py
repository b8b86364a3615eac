"""Branches of a scene that numbers a closure of links that are grouped otherwise now.

Links that two pins guide were one group of higher class, and bars that parallel ones make idle were
part of one. The closures at the scene's own position tell what its number means.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import count, islice, product

from msgspec.structs import replace

from graphkin.construction.compile import write
from graphkin.construction.core.branches import block_of, choosing, key_of
from graphkin.construction.core.program import Step
from graphkin.construction.core.run import StepFailed, run
from graphkin.construction.higher_class.closure_solver import SAME, closer_of, closing, run_settled
from graphkin.construction.links.position import idle_bars
from graphkin.numbers.arithmetic import FLOAT, np, phase
from graphkin.numbers.plane import cross
from graphkin.scene.model import Branch, Closure, Scene, Side, Way
from graphkin.structure.decomposition import decompose
from graphkin.structure.groups import CoupledTrain, Dyad, Group, Higher, OnTwoPins, Stretched
from graphkin.structure.pairs import Pin
from graphkin.text.errors import StructureError

Order = tuple[float, ...]
"""By what closures are put in order: angles of links, then places of points."""


def in_present_words(scene: Scene) -> Scene:
    """The scene with its numbers of closures as the present groups state them.

    The same where they mean that, or no closure.
    """
    try:
        groups = decompose(scene)
        for name, branch in scene.branches.items():
            if isinstance(branch, Closure):
                members = guided_with(groups, name)
                group = next((each for each in groups if name in each.links), None)
                if members:
                    scene = with_ways(scene, groups, name, branch.number, members)
                elif isinstance(group, Higher):
                    scene = renumbered(scene, groups, group, name, branch.number)
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


def renumbered(
    scene: Scene, groups: tuple[Group, ...], group: Higher, name: str, number: int
) -> Scene:
    """The scene with the number of a closure among all, where sides are stated besides it.

    A side of a pin where nothing is left to choose was that of a dyad after the group: the number
    counts the closures in which it is true, and the idle bars fit.
    """
    own = {point for link in group.links for point in scene.links[link].points}
    allowed = choosing(groups)
    sides = {
        pin: side
        for pin, side in scene.branches.items()
        if isinstance(side, Side) and pin in own and pin not in allowed
    }
    if not sides:
        return scene
    branches = {key: branch for key, branch in scene.branches.items() if key not in sides}
    bare = replace(scene, branches=branches)
    real = (
        closure
        for closure, places in numbered_places(bare, groups, group)
        if all(bar.fits(places) for bar in idle_bars(scene, groups))
        and all(is_on_side(side, places, pin) for pin, side in sides.items())
    )
    found = next(islice(real, number - 1, None), None)
    return replace(bare, branches={**branches, name: Closure(found)}) if found else scene


def numbered_places(
    scene: Scene, groups: tuple[Group, ...], group: Higher
) -> Iterator[tuple[int, Mapping[str, complex]]]:
    """The number of each closure of a group, and where it puts the points known by then."""
    program = write(scene, groups, fitted=False)
    at = next(n for n, step in enumerate(program.steps) if closes(step, group))
    step, solver = program.steps[at], closing(program.steps[at])
    before = groups[: groups.index(group) + 1]
    links = [name for each in before for name in each.links]
    points = {*scene.frame.points, *(p for name in links for p in scene.links[name].points)}
    targets = {p: program.targets["position", p] for p in points}
    needed = program.needed(("position", point) for point in points)
    for number in count(1):
        assert step.action is not None
        action = replace(step.action, value=replace(solver, number=number))
        steps = (*program.steps[:at], replace(step, action=action), *program.steps[at + 1 :])
        try:
            values = run_settled(scene, replace(program, steps=steps), needed).values
        except StepFailed:
            return
        yield number, {point: values[target] for point, target in targets.items()}


def closes(step: Step, group: Higher) -> bool:
    """Whether a step closes a group."""
    return closer_of(step) is not None and getattr(step.of, "group", None) == group


def is_on_side(side: Side, places: Mapping[str, complex], pin: str) -> bool:
    """Whether a pin lies on the stated side of the line of two others."""
    if not {pin, side.first, side.second} <= places.keys():
        return False
    first, second = places[side.first], places[side.second]
    return bool(cross(second - first, places[pin] - first) * side.side > 0)
