"""The closures of each group: where its points lie in each, and whether the rest follows."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Collection, Iterator, Mapping
from types import MappingProxyType
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.bases import kept_touches
from graphkin.construction.core.branches import block_of, has_two_ways
from graphkin.construction.core.crossings import letter_of
from graphkin.construction.core.program import Part, Program, Step, Target
from graphkin.construction.core.run import StepFailed
from graphkin.construction.higher_class.closure_solver import closer_of, run_settled, ways
from graphkin.scene.model import Branch, Scene, Side, Way
from graphkin.structure.groups import Dyad, Group, Higher, OnTwoPins, Stretched
from graphkin.structure.pairs import Pin


class GroupClosure(Struct, frozen=True):
    """One way in which a group closes: its words in [branches], and its point's place (m).

    ``fails`` names what cannot be drawn then, and is empty when all the rest closes too: ``points``
    are then the places of all points (m), but of the picked closure.
    """

    words: str
    place: complex | None
    picked: bool
    fails: str
    points: Mapping[str, complex] = MappingProxyType({})


class Choice(Struct, frozen=True):
    """A group, one of its points, and its closures: of a dyad the picked one first."""

    links: tuple[str, ...]
    pin: str
    closures: tuple[GroupClosure, ...]


def choices(scene: Scene, groups: tuple[Group, ...], program: Program) -> tuple[Choice, ...]:
    """The closures of every group that closes in more than one way."""
    found: list[Choice] = []
    taken: set[int] = set()
    every = program.needed(positions_of(program))
    stated = values_as_stated(scene, program, every)
    for whole in groups:
        group = whole.dyad if isinstance(whole, Stretched) else whole
        number = choosing_step(scene, group, program, taken)
        if number is None:
            continue
        taken.add(number)
        point = shown_point(scene, group, program)
        if isinstance(group, Dyad):
            own = program, number, group, point
            both = [dyad_closure(scene, *own, way, every, stated) for way in (1, -1)]
            found.append(Choice(group.links, point, tuple(both)))
        else:
            every_one = numbered(scene, program, number, point, every)
            found.append(Choice(group.links, point, every_one))
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
    fixed = {program.targets.get(("position", point)) for point in scene.fixed_points}
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
        return closer_of(step) is not None
    return len(step.extra) in (1, 2) and step.extra[0] in (1, -1)


def shown_point(scene: Scene, group: Group, program: Program) -> str:
    """The point by which the closures of a group are told apart."""
    if isinstance(group, Dyad) and isinstance(group.inner, Pin):
        return group.inner.point
    outside = {
        point for link in scene.every_link if link.name not in group.links for point in link.points
    }
    points = [p for link in group.links for p in scene.links[link].points]
    free = [p for p in points if p not in outside]
    outer = (group.left, group.right) if isinstance(group, Dyad) else ()
    known = {pair.point for pair in outer if isinstance(pair, Pin)}  # the same in every closure
    led = [p for p in points if p not in known]
    kept = [p for p in kept_touches(scene, group.links) if ("position", p) in program.targets]
    return next(iter((*free, *led, *kept, *points)))


def dyad_closure(
    scene: Scene,
    program: Program,
    number: int,
    dyad: Dyad,
    point: str,
    way: int,
    every: tuple[int, ...],
    before: Mapping[int, Any],
) -> GroupClosure:
    """One closure of a dyad: the picked crossing (way +1) or the other one (-1).

    ``before`` are the values that the program has as the scene states it.
    """
    words = words_of(scene, point, dyad, way)
    if way > 0 and before:
        place = before.get(program.targets.get(("position", point), -1))
        return GroupClosure(words, place if isinstance(place, complex) else None, True, "")
    step = program.steps[number]
    other = replaced(program, number, replace(step, extra=(way * step.extra[0], *step.extra[1:])))
    return closure(scene, other, number, words, point, every, chosen=way > 0, before=before)


def numbered(
    scene: Scene, program: Program, number: int, point: str, every: tuple[int, ...]
) -> tuple[GroupClosure, ...]:
    """All closures of a group of higher class, in the order of their numbers."""
    step = program.steps[number]
    closer = closer_of(step)
    assert closer is not None and step.action is not None
    alone = replace(program, targets={("", str(arg)): arg for arg in step.args})
    try:
        known = run_settled(scene, alone, alone.needed(alone.targets)).values
    except StepFailed:
        return ()
    found = []
    for k in range(1, ways(scene, program, number, [known[arg] for arg in step.args]) + 1):
        action = replace(step.action, value=replace(closer, number=k))
        other = replaced(program, number, replace(step, action=action))
        chosen = k == closer.number
        found.append(closure(scene, other, number, f"closure {k}", point, every, chosen=chosen))
    return tuple(found)


def replaced(program: Program, number: int, step: Step) -> Program:
    """The program with another step in place of one."""
    steps = list(program.steps)
    steps[number] = step
    return replace(program, steps=tuple(steps))


def values_as_stated(scene: Scene, program: Program, every: tuple[int, ...]) -> Mapping[int, Any]:
    """The values of the positions as the scene states its branches; none where these fail."""
    try:
        return run_settled(scene, program, every).values
    except StepFailed:
        return {}


def positions_of(program: Program) -> list[Target]:
    """The places of all points."""
    return [target for target in program.targets if target[0] == "position"]


def closure(
    scene: Scene,
    program: Program,
    number: int,
    words: str,
    point: str,
    every: tuple[int, ...],
    *,
    chosen: bool,
    before: Mapping[int, Any] = MappingProxyType({}),
) -> GroupClosure:
    """A closure in words: where it puts a point (m), and what then cannot be drawn.

    ``number`` is the step that picks it: what does not depend on that is as ``before``. ``every``
    are the steps that place all points, in order.
    """
    target = ("position", point)
    later = every[bisect_left(every, number) :]
    known = {**before}
    for step in program.descendants(number, later):
        known.pop(step, None)
    try:
        trace, failing = run_settled(scene, program, every, overrides=known), ""
    except StepFailed as failed:
        failing = letter_of(program, failed.number) or f"step {failed.number}"
        try:
            trace = run_settled(scene, program, program.needed([target]), overrides=known)
        except StepFailed:
            return GroupClosure(words, None, chosen, failing)
    place = trace.value(*target)
    known_place = place if isinstance(place, complex) else None
    found = {} if failing else {p: trace.value(what, p) for what, p in positions_of(program)}
    points = {name: at for name, at in found.items() if isinstance(at, complex)}
    return GroupClosure(words, known_place, chosen, failing, points)


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
    if isinstance(dyad, OnTwoPins):
        names = iter((block_of(dyad),))
    return next((b for b in (scene.branches.get(name) for name in names) if b is not None), None)
