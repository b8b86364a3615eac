"""Rods that lie flat: in line with their cranks, where a dyad of the two has no sure crossing.

Where parallel bars keep a rod or a wheel parallel, its direction places it there, too.
"""

from __future__ import annotations

from msgspec.structs import replace

from graphkin.construction.compile import write
from graphkin.construction.core.branches import choosing
from graphkin.construction.core.program import Program
from graphkin.construction.core.run import StepFailed, run
from graphkin.numbers.arithmetic import FLOAT
from graphkin.scene.model import Scene, Side
from graphkin.structure.decomposition import decompose
from graphkin.structure.groups import Group, Tie
from graphkin.structure.joints import parallel_sets

FLAT = 1e-6
"""Sine of a crossing below which a rod counts as flat."""

Laid = tuple[tuple[Group, ...], Program]


def laid(scene: Scene, groups: tuple[Group, ...]) -> Laid:
    """The groups as drawn, and their program: parallel bars place what a flat rod does not."""
    first = groups, write(scene, groups)
    if not any(isinstance(group, Tie) for group in groups) or not is_flat(scene, first[1]):
        return first
    other = without_idle_sides(scene)
    return first if other is scene else ((found := decompose(other)), write(other, found))


def is_flat(scene: Scene, program: Program) -> bool:
    """Whether two loci only touch in the scene's position."""
    places = program.needed(target for target in program.targets if target[0] == "position")
    try:
        margins = run(program, places, scene.values, FLOAT).margins
    except StepFailed:
        return False
    return bool(min(margins.values(), default=1.0) < FLAT)


def without_idle_sides(scene: Scene) -> Scene:
    """The scene without the sides of pins of parallel bars, where these leave no choice.

    The same where it states none.
    """
    pins = {p for each in parallel_sets(scene) for ends in each.pins for p in ends}
    idle = {pin for pin in pins if isinstance(scene.branches.get(pin), Side)}
    if not idle:
        return scene
    branches = {name: each for name, each in scene.branches.items() if name not in idle}
    left = idle & {*choosing(decompose(replace(scene, branches=branches)))}
    branches = {name: each for name, each in scene.branches.items() if name not in idle - left}
    return replace(scene, branches=branches)
