"""The two closures of each dyad: where its inner pin lies in each, and whether the rest follows."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from graphkin.arithmetic import FLOAT
from graphkin.scene.model import Branch, Scene, Side, Way
from graphkin.steps.program import Part, Program
from graphkin.steps.run import StepFailed, Trace, run
from graphkin.structure.groups import Dyad, Group


@dataclass(frozen=True, slots=True)
class Closure:
    """One way in which a dyad closes: its words in [branches], and the inner pin's place (m).

    ``fails`` names what cannot be drawn then, and is empty when all the rest closes too.
    """

    words: str
    place: complex | None
    picked: bool
    fails: str


@dataclass(frozen=True, slots=True)
class Choice:
    """A dyad and its two closures, the one that the scene has picked first."""

    links: tuple[str, str]
    pin: str
    closures: tuple[Closure, Closure]


def choices(scene: Scene, groups: tuple[Group, ...], program: Program) -> tuple[Choice, ...]:
    """The closures of every dyad whose inner pin is picked from two crossings."""
    return tuple(
        Choice(
            dyad.links,
            program.steps[number].name,
            (
                closure(scene, program, number, words_of(scene, program, dyad, number, 1), 1),
                closure(scene, program, number, words_of(scene, program, dyad, number, -1), -1),
            ),
        )
        for dyad, number in choosing_steps(scene, groups, program)
    )


def choosing_steps(
    scene: Scene, groups: tuple[Group, ...], program: Program
) -> Iterator[tuple[Dyad, int]]:
    """Each dyad with the step that picks one of two crossings for it."""
    taken: set[int] = set()
    for group in groups:
        if not isinstance(group, Dyad):
            continue
        points = [p for link in group.links for p in scene.links[link].points]
        targets = [("position", p) for p in points] + [("slide", link) for link in group.links]
        for number in program.needed(t for t in targets if t in program.targets):
            if number not in taken and is_choice(scene, program, number):
                taken.add(number)
                yield group, number
                break


def is_choice(scene: Scene, program: Program, number: int) -> bool:
    """True for a step of a position that picks one of two crossings, the frame's own excepted."""
    step = program.steps[number]
    fixed = {program.targets.get(("position", point)) for point in scene.frame.points}
    picks = len(step.extra) == 1 and step.extra[0] in (1, -1)
    return step.part is Part.POSITION and not step.hand and picks and number not in fixed


def closure(scene: Scene, program: Program, number: int, words: str, way: int) -> Closure:
    """One closure: the picked crossing (way +1) or the other one (-1), and what follows from it."""
    step = program.steps[number]
    turned = replace(step, extra=(way * step.extra[0],))
    steps = (*program.steps[:number], turned, *program.steps[number + 1 :])
    other = replace(program, steps=steps)
    positions = [target for target in other.targets if target[0] == "position"]
    fails = ""
    try:
        run_positions(scene, other, other.needed(positions))
    except StepFailed as failed:
        fails = failed.step.name or f"step {failed.number}"
    return Closure(words, place_at(scene, other, number), way > 0, fails)


def place_at(scene: Scene, program: Program, number: int) -> complex | None:
    """Where one step's point lies (m), None where it cannot be drawn."""
    alone = replace(program, targets={("position", ""): number})
    try:
        value = run_positions(scene, alone, alone.needed(alone.targets)).values[number]
    except StepFailed:
        return None
    return value if isinstance(value, complex) else None


def run_positions(scene: Scene, program: Program, needed: tuple[int, ...]) -> Trace:
    """Run some steps of a program on the scene's own numbers."""
    return run(program, needed, scene.values, FLOAT)


def words_of(scene: Scene, program: Program, dyad: Dyad, number: int, way: int) -> str:
    """A closure as [branches] writes it: left or right of a line, forward or backward."""
    step = program.steps[number]
    branch = branch_of(scene, step.name, dyad)
    match branch:
        case Side(first, second, side):
            return f"{'left' if side * way > 0 else 'right'} of {first}-{second}"
        case Way(forward):
            return "forward" if forward * way > 0 else "backward"
    return "as the scene has it" if way > 0 else "the other"


def branch_of(scene: Scene, pin: str, dyad: Dyad) -> Branch | None:
    """What the scene says of a dyad: of its inner pin, or of one of its links."""
    named = (scene.branches.get(name) for name in (pin, *dyad.links))
    return next((branch for branch in named if branch is not None), None)
