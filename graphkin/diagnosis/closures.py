"""The closures of each group: its points' positions in each, and whether the rest can be drawn."""

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
from graphkin.construction.higher_class.completeness import is_complete
from graphkin.construction.links.position import IdleBar, idle_bars
from graphkin.scene.model import Branch, Scene, Side, Way
from graphkin.structure.groups import Dyad, Group, Higher, OnTwoPins, Stretched
from graphkin.structure.pairs import Pin


class GroupClosure(Struct, frozen=True):
    """One closure of a group: its statement in [branches] and the position of its point (m).

    ``fails`` names what cannot be drawn in this closure, and ``unfit`` an idle link that does not
    fit. Both are empty when everything else closes. Then ``points`` holds the positions of all
    points (m), except for the selected closure. ``placed`` holds the positions of the group's
    points and the directions of its links, as far as they are known.
    """

    words: str
    place: complex | None
    picked: bool
    fails: str
    points: Mapping[str, complex] = MappingProxyType({})
    placed: Mapping[Target, complex] = MappingProxyType({})
    unfit: str = ""


class Choice(Struct, frozen=True):
    """A group, one of its points, and its closures; for a dyad, the selected one is first.

    Where no point of it tells them apart, ``pin`` is a link of it, ``is_turned``, and the places
    are unit vectors along that link's x axis. [branches] states the closure under ``key``.
    ``is_complete`` says whether the closures are proved to be all; None where no proof was tried.
    """

    links: tuple[str, ...]
    pin: str
    closures: tuple[GroupClosure, ...]
    key: str = ""
    is_turned: bool = False
    is_complete: bool | None = None


class Positions(Struct, frozen=True):
    """A program of positions, with its values in the stated branches and the bars that must fit.

    ``every`` lists, in order, the steps that locate all points and the directions of all links.
    """

    scene: Scene
    program: Program
    every: tuple[int, ...]
    stated: Mapping[int, Any]
    idle: tuple[IdleBar, ...]

    def unfit(self, values: Mapping[int, Any]) -> str:
        """The first idle link that does not fit; empty if all fit."""
        if not self.idle:
            return ""
        known = found_of(self.program, positions_of(self.program), values)
        places = {point: place for (_, point), place in known}
        return next((bar.link for bar in self.idle if not bar.fits(places)), "")


APART = 1e-6
"""Distance, relative to the largest coordinate, above which a reader sees two positions."""


def choices(
    scene: Scene, groups: tuple[Group, ...], program: Program, *, proving: bool = False
) -> tuple[Choice, ...]:
    """The closures of every group that closes in more than one way.

    With ``proving`` a proof is tried that groups of higher class close in no other way.
    """
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
        targets = distinguishing_targets(scene, group, program)
        if isinstance(group, Dyad):
            both = [dyad_closure(positions, number, group, targets, way) for way in (1, -1)]
            closures, complete = tuple(both), None
        else:
            closures, complete = numbered(positions, number, targets, proving=proving)
        choice = distinguished(group.links, targets, closures, key_of(scene, group) or "")
        found.append(replace(choice, is_complete=complete))
    return tuple(found)


def distinguishing_targets(scene: Scene, group: Group, program: Program) -> tuple[Target, ...]:
    """Targets that may distinguish a group's closures: a point, other points, then links."""
    turned = [group.rail] if isinstance(group, OnTwoPins) else list(group.links)
    own = (p for link in group.links for p in scene.links[link].points)
    points = dict.fromkeys((shown_point(scene, group, program), *own))
    every = [("position", name) for name in points] + [("axis", name) for name in turned]
    return tuple(target for target in every if target in program.targets)


def distinguished(
    links: tuple[str, ...],
    targets: tuple[Target, ...],
    closures: tuple[GroupClosure, ...],
    key: str,
) -> Choice:
    """The closures of a group, shown by the first point or link that differs in all."""
    drawn = [each.placed for each in closures if each.place is not None]
    shared = [target for target in targets if all(target in placed for placed in drawn)]
    clear = [target for target in shared if are_apart([placed[target] for placed in drawn])]
    what, name = next(iter(clear), targets[0])
    shown = tuple(
        each if each.place is None else replace(each, place=each.placed.get((what, name)))
        for each in closures
    )
    return Choice(links, name, shown, key, what == "axis")


def are_apart(places: Sequence[complex]) -> bool:
    """Whether no two positions coincide."""
    least = APART * max(map(abs, places), default=0.0)
    return all(abs(one - other) > least for one, other in combinations(places, 2))


def choosing_step(
    scene: Scene, group: Group, program: Program, taken: Collection[int]
) -> int | None:
    """The step that selects one closure of a group; None where there is only one.

    ``taken`` are the steps of earlier groups.
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
    """Whether a step of a position selects one of several crossings."""
    step = program.steps[number]
    if step.part is not Part.POSITION or step.hand or step.action is None:
        return False
    if closing:
        return closer_of(step) is not None
    return len(step.extra) in (1, 2) and step.extra[0] in (1, -1)


def shown_point(scene: Scene, group: Group, program: Program) -> str:
    """The point that distinguishes the closures of a group."""
    if isinstance(group, Dyad) and isinstance(group.inner, Pin):
        return group.inner.point
    outside = {
        point for link in scene.every_link if link.name not in group.links for point in link.points
    }
    points = [p for link in group.links for p in scene.links[link].points]
    free = [p for p in points if p not in outside]
    outer = (group.left, group.right) if isinstance(group, Dyad) else ()
    known = {pair.point for pair in outer if isinstance(pair, Pin)}  # |the same in every closure
    led = [p for p in points if p not in known]
    kept = [p for p in kept_touches(scene, group.links) if ("position", p) in program.targets]
    return next(iter((*free, *led, *kept, *points)))


def dyad_closure(
    positions: Positions, number: int, dyad: Dyad, targets: tuple[Target, ...], way: int
) -> GroupClosure:
    """One closure of a dyad: the selected crossing (way +1) or the other one (-1)."""
    scene, program, stated = positions.scene, positions.program, positions.stated
    words = words_of(scene, dyad, way)
    if way > 0 and stated:
        placed = dict(found_of(program, targets, stated))
        place, unfit = placed.get(targets[0]), positions.unfit(stated)
        return GroupClosure(words, place, True, "", placed=placed, unfit=unfit)
    step = program.steps[number]
    other = replaced(program, number, replace(step, extra=(way * step.extra[0], *step.extra[1:])))
    own = replace(positions, program=other)
    return closure(own, number, words, targets, chosen=way > 0, before=stated)


def numbered(
    positions: Positions, number: int, targets: tuple[Target, ...], *, proving: bool
) -> tuple[tuple[GroupClosure, ...], bool | None]:
    """The closures of a group of higher class, in the order of their numbers; whether they are
    proved to be all."""
    scene, program = positions.scene, positions.program
    step = program.steps[number]
    closer = closer_of(step)
    assert closer is not None and step.action is not None
    alone = replace(program, targets={("", str(arg)): arg for arg in step.args})
    try:
        known = run_settled(scene, alone, alone.needed(alone.targets)).values
    except StepFailed:
        return (), None
    found, args = [], [known[arg] for arg in step.args]
    for k in range(1, ways(scene, program, number, args) + 1):
        action = replace(step.action, value=replace(closer, number=k))
        own = replace(positions, program=replaced(program, number, replace(step, action=action)))
        chosen = k == closer.number
        found.append(closure(own, number, f"closure {k}", targets, chosen=chosen))
    return tuple(found), is_complete(closer.trying, args) if proving else None


def replaced(program: Program, number: int, step: Step) -> Program:
    """The program with one step replaced."""
    steps = list(program.steps)
    steps[number] = step
    return replace(program, steps=tuple(steps))


def values_as_stated(scene: Scene, program: Program, every: tuple[int, ...]) -> Mapping[int, Any]:
    """The values of the positions in the stated branches; empty where these fail."""
    try:
        return run_settled(scene, program, every).values
    except StepFailed:
        return {}


def positions_of(program: Program) -> list[Target]:
    """The position targets of all points."""
    return [target for target in program.targets if target[0] == "position"]


def closure(
    positions: Positions,
    number: int,
    words: str,
    targets: tuple[Target, ...],
    *,
    chosen: bool,
    before: Mapping[int, Any] = MappingProxyType({}),
) -> GroupClosure:
    """A closure with the position that distinguishes it, and what cannot be drawn in it.

    ``number`` is the step that selects it. Steps that do not depend on it keep their values from
    ``before``.
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
            trace = run_settled(scene, program, program.needed(targets[:1]), overrides=known)
        except StepFailed:
            return GroupClosure(words, None, chosen, failing)
    placed = dict(found_of(program, targets, trace.values))
    if failing:
        return GroupClosure(words, placed.get(targets[0]), chosen, failing, placed=placed)
    if unfit := positions.unfit(trace.values):
        return GroupClosure(words, placed.get(targets[0]), chosen, "", placed=placed, unfit=unfit)
    points = {name: at for (_, name), at in found_of(program, positions_of(program), trace.values)}
    return GroupClosure(words, placed.get(targets[0]), chosen, "", points, placed)


def found_of(
    program: Program, targets: Iterable[Target], values: Mapping[int, Any]
) -> Iterator[tuple[Target, complex]]:
    """The positions and directions of some targets, as far as they are known."""
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
    """The scene's branch statement for a dyad, under its inner pin or its block."""
    names = [key_of(scene, dyad)]
    if has_two_ways(dyad):
        names.append(block_of(dyad))
    return next(
        (b for b in (scene.branches.get(name or "") for name in names) if b is not None), None
    )
