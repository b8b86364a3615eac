"""The closures of each group: where its points lie in each, and whether the rest follows."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.branches import has_two_ways
from graphkin.construction.core.program import Part, Program, Step
from graphkin.construction.core.run import StepFailed, Trace
from graphkin.construction.higher_class.closure_solver import ClosureSolver
from graphkin.construction.higher_class.settling import run_settled, ways
from graphkin.scene.model import Branch, Scene, Side, Way
from graphkin.structure.groups import Dyad, Group, Higher, Stretched
from graphkin.structure.pairs import Pin


class GroupClosure(Struct, frozen=True):
    """One way in which a group closes: its words in [branches], and its point's place (m).

    ``fails`` names what cannot be drawn then, and is empty when all the rest closes too.
    """

    words: str
    place: complex | None
    picked: bool
    fails: str


class Choice(Struct, frozen=True):
    """A group, one of its points, and its closures: of a dyad the picked one first."""

    links: tuple[str, ...]
    pin: str
    closures: tuple[GroupClosure, ...]


def choices(scene: Scene, groups: tuple[Group, ...], program: Program) -> tuple[Choice, ...]:
    """The closures of every group that closes in more than one way."""
    found: list[Choice] = []
    taken: set[int] = set()
    for whole in groups:
        group = whole.dyad if isinstance(whole, Stretched) else whole
        number = choosing_step(scene, group, program, taken)
        if number is None:
            continue
        taken.add(number)
        point = shown_point(scene, group, program)
        if isinstance(group, Dyad):
            both = [dyad_closure(scene, program, number, group, point, way) for way in (1, -1)]
            found.append(Choice(group.links, point, tuple(both)))
        else:
            found.append(Choice(group.links, point, numbered(scene, program, number, point)))
    return tuple(found)


def choosing_step(
    scene: Scene, group: Group, program: Program, taken: Collection[int]
) -> int | None:
    """The step that picks one of the ways in which a group closes; None where there is one.

    The groups before it have ``taken`` theirs.
    """
    if isinstance(group, Dyad) and (group.type == "RRR" or has_two_ways(group)):
        closing = False
    elif isinstance(group, Higher):
        closing = True
    else:
        return None
    points = [p for link in group.links for p in scene.links[link].points]
    targets = [("position", p) for p in points] + [("axis", link) for link in group.links]
    fixed = {program.targets.get(("position", point)) for point in scene.frame.points}
    for number in program.needed(t for t in targets if t in program.targets):
        if number not in fixed and number not in taken and picks(program, number, closing=closing):
            return number
    return None


def picks(program: Program, number: int, *, closing: bool) -> bool:
    """True for a step of a position that picks one of several crossings."""
    step = program.steps[number]
    if step.part is not Part.POSITION or step.hand or step.action is None:
        return False
    if closing:
        return isinstance(step.action.value, ClosureSolver)
    return len(step.extra) in (1, 2) and step.extra[0] in (1, -1)


def shown_point(scene: Scene, group: Group, program: Program) -> str:
    """The point by which the closures of a group are told apart."""
    if isinstance(group, Dyad) and isinstance(group.inner, Pin):
        return group.inner.point
    outside = {
        point
        for link in (scene.frame, *scene.links.values())
        if link.name not in group.links
        for point in link.points
    }
    points = [p for link in group.links for p in scene.links[link].points]
    free = [p for p in points if p not in outside]
    outer = (group.left, group.right) if isinstance(group, Dyad) else ()
    known = {pair.point for pair in outer if isinstance(pair, Pin)}  # the same in every closure
    led = [p for p in points if p not in known]
    return next(iter((*free, *led, *points)))


def dyad_closure(
    scene: Scene, program: Program, number: int, dyad: Dyad, point: str, way: int
) -> GroupClosure:
    """One closure of a dyad: the picked crossing (way +1) or the other one (-1)."""
    step = program.steps[number]
    other = replaced(program, number, replace(step, extra=(way * step.extra[0], *step.extra[1:])))
    words = words_of(scene, point, dyad, way)
    return GroupClosure(words, place_of(scene, other, point), way > 0, failing(scene, other))


def numbered(scene: Scene, program: Program, number: int, point: str) -> tuple[GroupClosure, ...]:
    """All closures of a group of higher class, in the order of their numbers."""
    step = program.steps[number]
    assert step.action is not None and isinstance(step.action.value, ClosureSolver)
    closer = step.action.value
    alone = replace(program, targets={("", str(arg)): arg for arg in step.args})
    try:
        known = run_positions(scene, alone, alone.needed(alone.targets)).values
    except StepFailed:
        return ()
    found = []
    for k in range(1, ways(scene, program, number, [known[arg] for arg in step.args]) + 1):
        action = replace(step.action, value=replace(closer, number=k))
        other = replaced(program, number, replace(step, action=action))
        place = place_of(scene, other, point)
        words = f"closure {k}"
        found.append(GroupClosure(words, place, k == closer.number, failing(scene, other)))
    return tuple(found)


def replaced(program: Program, number: int, step: Step) -> Program:
    """The program with another step in place of one."""
    steps = list(program.steps)
    steps[number] = step
    return replace(program, steps=tuple(steps))


def failing(scene: Scene, program: Program) -> str:
    """What cannot be drawn of the positions; empty when all closes."""
    positions = [target for target in program.targets if target[0] == "position"]
    try:
        run_positions(scene, program, program.needed(positions))
    except StepFailed as failed:
        return failed.step.name or f"step {failed.number}"
    return ""


def place_of(scene: Scene, program: Program, point: str) -> complex | None:
    """Where a point lies (m), None where it cannot be drawn."""
    target = ("position", point)
    try:
        trace = run_positions(scene, program, program.needed([target]))
    except StepFailed:
        return None
    value = trace.value(*target)
    return value if isinstance(value, complex) else None


def run_positions(scene: Scene, program: Program, needed: tuple[int, ...]) -> Trace:
    """Run some steps of a program on the scene's own numbers."""
    return run_settled(scene, program, needed)


def words_of(scene: Scene, pin: str, dyad: Dyad, way: int) -> str:
    """A closure as [branches] writes it: left or right of a line, forward or backward."""
    match branch_of(scene, pin, dyad):
        case Side(first, second, side):
            return f"{'left' if side * way > 0 else 'right'} of {first}-{second}"
        case Way(forward):
            return "forward" if forward * way > 0 else "backward"
    return "as the scene has it" if way > 0 else "the other"


def branch_of(scene: Scene, pin: str, dyad: Dyad) -> Branch | None:
    """What the scene says of a dyad: of its inner pin, or of one of its links."""
    names: Iterator[str] = iter((pin, *dyad.links, *dyad.inner.links, *dyad.right.links))
    return next((b for b in (scene.branches.get(name) for name in names) if b is not None), None)
