"""Choosing between two equivalent rods: the one that is not flat in the scene's position.

Coupled wheels pass the position where one rod is in line with its cranks by means of a second rod.
"""

from __future__ import annotations

from collections.abc import Iterator

from msgspec.structs import replace

from graphkin.construction.compile import write
from graphkin.construction.core.program import Program
from graphkin.construction.core.run import StepFailed, run
from graphkin.numbers.arithmetic import FLOAT
from graphkin.scene.model import Scene, Side
from graphkin.structure.decomposition import decompose
from graphkin.structure.groups import CoupledTrain, Dyad, Group, Higher, Tie
from graphkin.structure.joints import partner
from graphkin.structure.pairs import Pin
from graphkin.text.errors import StructureError

FLAT = 1e-6
"""Sine of a crossing below which a rod counts as flat."""

Laid = tuple[tuple[Group, ...], Program]


def laid(scene: Scene, groups: tuple[Group, ...]) -> Laid:
    """The groups as drawn, and their program: an idle rod replaces a rod that is flat."""
    first = groups, write(scene, groups)
    if not any(isinstance(group, Tie) for group in groups) or not is_flat(scene, first[1]):
        return first
    others = (
        found
        for dyad, tie, wheel in exchangeable(groups)
        for found in exchanged(scene, dyad, tie, wheel)
    )
    return next((found for found in others if not is_flat(scene, found[1])), first)


def is_flat(scene: Scene, program: Program) -> bool:
    """Whether two loci only touch in the scene's position."""
    places = program.needed(target for target in program.targets if target[0] == "position")
    try:
        margins = run(program, places, scene.values, FLOAT).margins
    except StepFailed:
        return False
    return bool(min(margins.values(), default=1.0) < FLAT)


def exchangeable(groups: tuple[Group, ...]) -> Iterator[tuple[Dyad, Tie, str]]:
    """Each RRR dyad with an idle rod that also joins one of its links to known links."""
    if any(isinstance(group, CoupledTrain | Higher) for group in groups):
        return
    for tie in groups:
        if not isinstance(tie, Tie) or not all(isinstance(pair, Pin) for pair in tie.outer):
            continue
        ends = {partner(pair, tie.link) for pair in tie.outer}
        for dyad in groups:
            if isinstance(dyad, Dyad) and dyad.type == "RRR":
                led = [link for link in dyad.links if link in ends]
                if len(led) == 1:
                    yield dyad, tie, led[0]


def exchanged(scene: Scene, dyad: Dyad, tie: Tie, led: str) -> Iterator[Laid]:
    """The groups with an idle rod in place of a dyad's rod, on either side, where this fits."""
    rod = next(link for link in dyad.links if link != led)
    names = [name for name in scene.links if name != tie.link]
    names.insert(names.index(rod), tie.link)
    other = replace(scene, links={name: scene.links[name] for name in names})
    groups = decompose(other)
    new = next((g for g in groups if isinstance(g, Dyad) and {*g.links} == {tie.link, led}), None)
    if new is None or new.type != "RRR":
        return
    assert isinstance(dyad.inner, Pin) and isinstance(new.inner, Pin)
    assert isinstance(new.left, Pin) and isinstance(new.right, Pin)
    branches = {name: way for name, way in scene.branches.items() if name != dyad.inner.point}
    for side in (1, -1):
        branches[new.inner.point] = Side(new.left.place, new.right.place, side)
        try:
            yield groups, write(replace(other, branches=dict(branches)), groups)
        except StructureError:
            continue
