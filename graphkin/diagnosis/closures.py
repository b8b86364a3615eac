"""The closures of each group: where its points lie in each, and whether the rest follows."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from itertools import combinations
from types import MappingProxyType
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.bases import kept_touches
from graphkin.construction.core.branches import block_of, has_two_ways, key_of
from graphkin.construction.core.crossings import letter_of
from graphkin.construction.core.program import Part, Program, Step, Target
from graphkin.construction.core.run import StepFailed
from graphkin.construction.higher_class.closure_solver import closer_of, run_settled, ways
from graphkin.construction.links.position import IdleBar, idle_bars
from graphkin.scene.model import Branch, Scene, Side, Way
from graphkin.structure.groups import Dyad, Group, Higher, OnTwoPins, Stretched
from graphkin.structure.pairs import Pin


class GroupClosure(Struct, frozen=True):
    """One way in which a group closes: its words in [branches], and its point's place (m).

    ``fails`` names what cannot be drawn then, and ``unfit`` an idle link that has no room. Both are
    empty when all the rest closes too: ``points`` are then the places of all points (m), but of the
    picked closure. ``stands`` are the places of the group's points and the directions of its links,
    as far as they are found.
    """

    words: str
    place: complex | None
    picked: bool
    fails: str
    points: Mapping[str, complex] = MappingProxyType({})
    stands: Mapping[Target, complex] = MappingProxyType({})
    unfit: str = ""


class Choice(Struct, frozen=True):
    """A group, one of its points, and its closures: of a dyad the picked one first.

    Where no point of it tells them apart, ``pin`` is a link of it, ``is_turned``, and the places
    are unit vectors along that link's x axis. [branches] states the closure under ``key``.
    """

    links: tuple[str, ...]
    pin: str
    closures: tuple[GroupClosure, ...]
    key: str = ""
    is_turned: bool = False


class Positions(Struct, frozen=True):
    """A program of positions: the steps that place ``every`` point and turn every link, in order,
    their values as the scene states its branches, and the bars that must fit besides."""

    scene: Scene
    program: Program
    every: tuple[int, ...]
    stated: Mapping[int, Any]
    idle: tuple[IdleBar, ...]

    def unfit(self, values: Mapping[int, Any]) -> str:
        """The first idle link that has no room; empty where all have."""
        if not self.idle:
            return ""
        known = found_of(self.program, positions_of(self.program), values)
        places = {point: place for (_, point), place in known}
        return next((bar.link for bar in self.idle if not bar.fits(places)), "")


APART = 1e-6
"""Distance of two places, in parts of the largest coordinate, that a reader sees as two."""


def choices(scene: Scene, groups: tuple[Group, ...], program: Program) -> tuple[Choice, ...]:
    """The closures of every group that closes in more than one way."""
    axes = [target for target in program.targets if target[0] == "axis"]
    every = program.needed([*positions_of(program), *axes])
    stated = values_as_stated(scene, program, every)
    positions = Positions(scene, program, every, stated, tuple(idle_bars(scene, groups)))
    found: list[Choice] = []
    taken: set[int] = set()
    for whole in groups:
        group = whole.dyad if isinstance(whole, Stretched) else whole
        number = choosing_step(scene, group, program, taken)
        if number is None:
            continue
        taken.add(number)
        told = told_by(scene, group, program)
        if isinstance(group, Dyad):
            both = [dyad_closure(positions, number, group, told, way) for way in (1, -1)]
            closures = tuple(both)
        else:
            closures = numbered(positions, number, told)
        found.append(told_apart(group.links, told, closures, key_of(scene, group) or ""))
    return tuple(found)


def told_by(scene: Scene, group: Group, program: Program) -> tuple[Target, ...]:
    """What may tell the closures of a group apart: a point, its other points, then its links."""
    turned = [group.rail] if isinstance(group, OnTwoPins) else list(group.links)
    own = (p for link in group.links for p in scene.links[link].points)
    points = dict.fromkeys((shown_point(scene, group, program), *own))
    every = [("position", name) for name in points] + [("axis", name) for name in turned]
    return tuple(target for target in every if target in program.targets)


def told_apart(
    links: tuple[str, ...],
    told: tuple[Target, ...],
    closures: tuple[GroupClosure, ...],
    key: str,
) -> Choice:
    """The closures of a group by the first point that differs between all of them, or link."""
    drawn = [each.stands for each in closures if each.place is not None]
    shared = [target for target in told if all(target in stands for stands in drawn)]
    clear = [target for target in shared if are_apart([stands[target] for stands in drawn])]
    what, name = next(iter(clear), told[0])
    shown = tuple(
        each if each.place is None else replace(each, place=each.stands.get((what, name)))
        for each in closures
    )
    return Choice(links, name, shown, key, what == "axis")


def are_apart(places: Sequence[complex]) -> bool:
    """Whether no two of some places are the same."""
    least = APART * max(map(abs, places), default=0.0)
    return all(abs(one - other) > least for one, other in combinations(places, 2))


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
    positions: Positions, number: int, dyad: Dyad, told: tuple[Target, ...], way: int
) -> GroupClosure:
    """One closure of a dyad: the picked crossing (way +1) or the other one (-1)."""
    scene, program, stated = positions.scene, positions.program, positions.stated
    words = words_of(scene, dyad, way)
    if way > 0 and stated:
        stands = dict(found_of(program, told, stated))
        place, unfit = stands.get(told[0]), positions.unfit(stated)
        return GroupClosure(words, place, True, "", stands=stands, unfit=unfit)
    step = program.steps[number]
    other = replaced(program, number, replace(step, extra=(way * step.extra[0], *step.extra[1:])))
    own = replace(positions, program=other)
    return closure(own, number, words, told, chosen=way > 0, before=stated)


def numbered(
    positions: Positions, number: int, told: tuple[Target, ...]
) -> tuple[GroupClosure, ...]:
    """All closures of a group of higher class, in the order of their numbers."""
    scene, program = positions.scene, positions.program
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
        own = replace(positions, program=replaced(program, number, replace(step, action=action)))
        chosen = k == closer.number
        found.append(closure(own, number, f"closure {k}", told, chosen=chosen))
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
    positions: Positions,
    number: int,
    words: str,
    told: tuple[Target, ...],
    *,
    chosen: bool,
    before: Mapping[int, Any] = MappingProxyType({}),
) -> GroupClosure:
    """A closure in words: where it puts what tells it apart, and what then cannot be drawn.

    ``number`` is the step that picks it: what does not depend on that is as ``before``.
    """
    scene, program, every = positions.scene, positions.program, positions.every
    later = every[bisect_left(every, number) :]
    known = {**before}
    for step in program.descendants(number, later):
        known.pop(step, None)
    try:
        trace, failing = run_settled(scene, program, every, overrides=known), ""
    except StepFailed as failed:
        failing = letter_of(program, failed.number) or f"step {failed.number}"
        try:
            trace = run_settled(scene, program, program.needed(told[:1]), overrides=known)
        except StepFailed:
            return GroupClosure(words, None, chosen, failing)
    stands = dict(found_of(program, told, trace.values))
    if failing:
        return GroupClosure(words, stands.get(told[0]), chosen, failing, stands=stands)
    if unfit := positions.unfit(trace.values):
        return GroupClosure(words, stands.get(told[0]), chosen, "", stands=stands, unfit=unfit)
    points = {name: at for (_, name), at in found_of(program, positions_of(program), trace.values)}
    return GroupClosure(words, stands.get(told[0]), chosen, "", points, stands)


def found_of(
    program: Program, targets: Iterable[Target], values: Mapping[int, Any]
) -> Iterator[tuple[Target, complex]]:
    """The places and directions of some targets, as far as they are known."""
    for target in targets:
        place = values.get(program.targets[target])
        if isinstance(place, complex):
            yield target, place


def words_of(scene: Scene, dyad: Dyad, way: int) -> str:
    """A closure as [branches] writes it: left or right of a line, forward or backward."""
    match branch_of(scene, dyad):
        case Side(first, second, side):
            return f"{'left' if side * way > 0 else 'right'} of {first}-{second}"
        case Way(forward):
            return "forward" if forward * way > 0 else "backward"
    return "as the scene has it" if way > 0 else "the other"


def branch_of(scene: Scene, dyad: Dyad) -> Branch | None:
    """What the scene says of a dyad: of its inner pin, or of its block."""
    names = [key_of(scene, dyad)]
    if has_two_ways(dyad):
        names.append(block_of(dyad))
    return next(
        (b for b in (scene.branches.get(name or "") for name in names) if b is not None), None
    )
