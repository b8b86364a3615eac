"""A group of higher class followed through a sweep: its closures are numbered anew at every place.

The number that the scene picks counts where the scene stands. From there on the motion takes, at
each place, the closure that it leads to; its number there makes the piece.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.batch import run_batch
from graphkin.construction.higher_class.closure_solver import ClosureSolver, Trying
from graphkin.construction.higher_class.several_trials import SeveralTrials
from graphkin.motion.closures_followed import FollowedClosures, closed_on, paired
from graphkin.motion.course import Course, Reals, spread
from graphkin.motion.turns_followed import following
from graphkin.numbers.arithmetic import batch_kind
from graphkin.scene.model import Closure
from graphkin.text.errors import ClosureError, Problem

PLACES = 720
"""Places in a whole turn, or in any other sweep, at which closures are found.

Between them there are as many as the motion needs.
"""
FEWER = 120
"""The same where several links of the group are tried at once: each costs as much as a hundred."""
CHUNK = 120
"""Places at which closures are found at once."""
NEAR = 0.3
"""Largest miss of a prediction, in parts of the step and of the way to the next closure."""
SURE = 1e-6
"""Miss of a prediction, in parts of the mechanism's size, that is always taken."""
ENOUGH = 1e-10
"""Share of the sweep to which the places of new numbers and dead points are narrowed."""
PARTS = 16
"""Parts into which an interval is cut, all at once, where the motion is not sure.

It is halved where several links are tried at once: places together cost as much as apart there.
"""
LEAP = 6
"""Places of the grid over which the motion is led where no closure is found between."""
LEAP_NEAR = 0.1
"""As NEAR, for such a leap."""
LOOK_BACK = 200
"""Last places among which those that predict are looked for."""
MOST = 20_000
"""Places tried in one sweep at most."""


class Stop(Struct, frozen=True):
    """Where following ended: ``dead``, or at the end of the sweep; ``beyond`` does not close."""

    at: float
    dead: bool
    beyond: float


class NumberedPlace(Struct, frozen=True):
    """One place of the motion: u, the closure's number there, and where all points stand.

    ``turned`` are the angles (degrees) of the links that only their pins turn and whose wheels
    depend on it. ``every`` holds all closures there, in rows.
    ``leapt`` tells that no closure was found on the way to it, though the motion goes on there.
    """

    at: float
    number: int
    points: Reals
    turned: Reals
    every: Reals
    leapt: bool = False


class Numbered:
    """The only group of higher class of a course, and all its closures at any place."""

    def __init__(self, course: Course, step: int, link: str) -> None:
        self.course, self.step, self.link = course, step, link
        targets = course.program.targets
        self.targets = [target for target in targets if target[0] == "position"]
        self.rows = [*self.targets, *(("turned", link) for link in course.counting)]

    @property
    def parts(self) -> int:
        """Into how many parts an interval is cut where the motion is not sure."""
        return 2 if self.course.tries_several else PARTS

    def with_number(
        self, number: int, start: float, end: float, way: FollowedClosures | None
    ) -> Course:
        """The course with another number of the closure, on a part of the way that was followed."""
        branches = {**self.course.branches, self.link: Closure(number)}
        part = way and way.within(min(start, end), max(start, end))
        return replace(self.course, branches=branches, here=(start + end) / 2, closures=part)

    def followed(self, found: Sequence[NumberedPlace]) -> FollowedClosures | None:
        """What closes the group on the way through some places, if it tries several links."""
        if not self.course.tries_several:
            return None
        rising = sorted(found, key=lambda node: node.at)
        rows = np.array([node.every[node.number - 1] for node in rising])
        return FollowedClosures(np.array([node.at for node in rising]), rows)

    def node(
        self, at: float, number: int, closures: Reals, *, leapt: bool = False
    ) -> NumberedPlace:
        """The place of a closure, of all those there."""
        points, turned, _ = np.split(closures[number - 1], [len(self.targets), len(self.rows)])
        every = closures[~np.isnan(closures[:, 0]), len(self.rows) :].real
        return NumberedPlace(at, number, points, np.degrees(turned.real), every, leapt)

    def turned(self, node: NumberedPlace) -> dict[str, float]:
        """The angles (degrees) of the links that count at a place of the motion."""
        return dict(zip(self.course.counting, node.turned.tolist(), strict=True))

    def paired(self, low: NumberedPlace, high: NumberedPlace) -> list[FollowedClosures]:
        """All closures between two places of a group that tries several links, as they lead on.

        None where it tries one, or where the number of closures changes between.
        """
        if not self.course.tries_several:
            return []
        trying = self._known(np.array([high.at]))[0]
        assert isinstance(trying, SeveralTrials)
        both = sorted((low, high), key=lambda node: node.at)
        return paired(trying, (both[0].at, both[1].at), both[0].every, both[1].every)

    def places(self, at: Reals, ways: Sequence[FollowedClosures] = ()) -> Reals:
        """Where all points stand in every closure, how far links have turned (radians), and what
        closes the group.

        Shape (closures, points and links and what is tried, N); NaN for none. All are sought, or
        those that are on their ``ways`` are closed anew.
        """
        parts = [self._places(at[k : k + CHUNK], ways) for k in range(0, len(at), CHUNK)]
        most = max(len(part) for part in parts)
        whole = np.full((most, parts[0].shape[1], len(at)), np.nan + 0j)
        for k, part in enumerate(parts):
            whole[: len(part), :, k * CHUNK : k * CHUNK + part.shape[2]] = part
        return whole

    def _known(self, at: Reals) -> tuple[Trying, list[Reals], dict[str, Any]]:
        """What is tried, what is known of each place, and the values of the scene there."""
        program, values = self.course.program, self.course.values(at)
        step = program.steps[self.step]
        assert step.action is not None and isinstance(step.action.value, ClosureSolver)
        return step.action.value.trying, self.course.known_of(self.step, values, len(at)), values

    def _places(self, at: Reals, ways: Sequence[FollowedClosures]) -> Reals:
        trying, known, values = self._known(at)
        with np.errstate(all="ignore"):
            closures = closed_on(ways, trying, known, at) or trying.closures(known)
        counts = np.bincount(closures.table[:, 0].astype(int), minlength=len(at))
        every = [
            self._stand(at, values, trying, np.array(closures.picked(number)))
            for number in range(1, int(counts.max(initial=0)) + 1)
        ]
        size = len(self.rows) + closures.table.shape[1] - 1
        return np.array(every) if every else np.empty((0, size, len(at)), complex)

    def _stand(self, at: Reals, values: dict[str, Any], trying: Trying, closed: Reals) -> Reals:
        """Where all points and links stand in one closure at each place, and what closes it."""
        program = self.course.program
        overrides = {self.step: trying.parts(closed)}
        keep = [program.targets[target] for target in self.rows]
        with np.errstate(all="ignore"):
            trace = run_batch(
                program, self.course.early, values, batch_kind(), keep, overrides=overrides
            )
        rows = np.array([spread(trace.values[number], len(at)) for number in keep])
        rows = np.where(np.isfinite(rows).all(axis=0), rows, np.nan)
        return np.concatenate([rows, closed[:, 1:].T])


def numbered(course: Course) -> Numbered | None:
    """The group of higher class of a course; None without one, or where there are several."""
    names = [name for name, branch in course.branches.items() if isinstance(branch, Closure)]
    steps = [
        n
        for n in course.early
        if (action := course.program.steps[n].action) is not None
        and isinstance(action.value, ClosureSolver)
    ]
    return Numbered(course, steps[0], names[0]) if len(names) == len(steps) == 1 else None


def nodes(group: Numbered, start: float, stop: float) -> tuple[list[NumberedPlace], Stop]:
    """The places of the motion from one u to another, or to the dead point before it.

    The course of the group then counts how far links turn on the way.
    """
    course = group.course
    whole = course.sweep.usual
    places = FEWER if course.tries_several else PLACES
    count = max(int(np.ceil(abs(stop - start) / whole * places)), 2)
    if count > MOST:
        raise too_many(course)
    grid = np.linspace(start, stop, count + 1)
    some = CHUNK if course.counting else len(grid)
    followed = following(course, start)
    if course.counting:
        group.course = replace(course, turned=followed.turned(stop))
    branch = course.branches[group.link]
    assert isinstance(branch, Closure)
    first = np.moveaxis(group.places(grid[:1]), 2, 0)[0]
    found = [group.node(float(start), branch.number, first)]
    known: dict[float, Reals] = {}
    ahead = grid[:0:-1].tolist() if start != stop else []
    for _ in range(MOST):
        if not ahead:
            return found, Stop(float(stop), False, float(stop))
        target = ahead[-1]
        if followed.counts_on(found[-1].at, group.turned(found[-1])):
            group.course = replace(course, turned=followed.turned(stop))
            known = {}
        if target not in known:
            known |= closures_at(group, ahead[-1 : -some - 1 : -1])
        number = led_to(group, found, target, known[target])
        if number:
            found.append(group.node(target, number, known[target]))
            ahead.pop()
        elif abs(target - found[-1].at) < ENOUGH * whole:
            node = leap(group, found, grid, known)
            if node is None:
                return found, Stop(found[-1].at, True, target)
            found.append(node)
            ahead = [at for at in grid[:0:-1].tolist() if abs(at - start) > abs(node.at - start)]
        else:
            between = np.linspace(found[-1].at, target, group.parts + 1)[1:-1].tolist()
            known |= closures_at(group, between)
            ahead += between[::-1]
    raise too_many(course)


def too_many(course: Course) -> ClosureError:
    """What to raise where a motion would have to be followed through more places than allowed."""
    sweep = course.sweep
    found = f"from {sweep.low:.10g} to {sweep.high:.10g} {sweep.unit} it has to be tried at more"
    most = f"at most {MOST} positions of the driver"
    return ClosureError(Problem("the cycle", found, most, "show less with --from and --to"))


def closures_at(group: Numbered, at: Sequence[float]) -> dict[float, Reals]:
    """All closures at some places, by the place."""
    if not at:
        return {}
    return dict(zip(at, np.moveaxis(group.places(np.array(at)), 2, 0), strict=True))


def leap(
    group: Numbered, found: Sequence[NumberedPlace], grid: Reals, known: dict[float, Reals]
) -> NumberedPlace | None:
    """The next place of the grid at which the motion goes on, over a few where nothing is found.

    Where two closures pass each other closely, the search for them may miss both.
    """
    here = found[-1].at
    way = np.sign(grid[-1] - grid[0])
    beyond = [u for u in grid.tolist() if (u - here) * way > 0][:LEAP]
    known |= closures_at(group, [at for at in beyond if at not in known])
    for at in beyond:
        number = led_to(group, found, at, known[at], LEAP_NEAR)
        if number:
            return group.node(at, number, known[at], leapt=True)
    return None


def led_to(
    group: Numbered, found: Sequence[NumberedPlace], at: float, closures: Reals, near: float = NEAR
) -> int:
    """The number of the closure to which the motion leads; 0 where it is not sure of any."""
    here = found[-1]
    predicted, closures = prediction(group, found, at), closures[:, : len(group.targets)]
    misses = np.abs(closures - predicted).max(axis=1)
    misses = np.where(np.isfinite(misses), misses, np.inf)
    if not len(misses) or not np.isfinite(misses).any():
        return 0
    order = np.argsort(misses)
    best = float(misses[order[0]])
    others = [closures[n] for n in order[1:] if np.isfinite(misses[n])]
    step = float(np.abs(predicted - here.points).max())
    size = float(np.abs(here.points - here.points.mean()).max())
    apart = min((float(np.abs(o - closures[order[0]]).max()) for o in others), default=np.inf)
    sure = best <= max(near * step, SURE * size) and best <= near * apart
    return int(order[0]) + 1 if sure else 0


def prediction(group: Numbered, found: Sequence[NumberedPlace], at: float) -> Reals:
    """Where all points will stand: by the velocity from the first place, then by the last ones."""
    here = found[-1]
    last = spaced(found, abs(at - here.at))
    if len(last) == 1:
        course = group.course
        wanted = [("velocity", of) for _, of in group.targets]
        known = [target for target in wanted if target in course.program.targets]
        rates = course.columns(np.array([here.at]), known, geometric=True)
        slope = np.array([rates[t][0] if t in rates else 0.0 for t in wanted])
        return np.asarray(here.points + slope * (at - here.at) * course.sweep.per_unit)
    total = np.zeros_like(here.points)
    for i, node in enumerate(last):
        others = [other.at for k, other in enumerate(last) if k != i]
        weight = np.prod([(at - other) / (node.at - other) for other in others])
        total = total + weight * node.points
    return np.asarray(total)


def spaced(found: Sequence[NumberedPlace], way: float) -> list[NumberedPlace]:
    """The last places, at most three, none nearer to another than half the way to be predicted."""
    last = [found[-1]]
    for node in reversed(found[-LOOK_BACK:]):
        if abs(node.at - last[-1].at) >= way / 2:
            last.append(node)
        if len(last) == 3:
            break
    return last


def changes(group: Numbered, found: list[NumberedPlace]) -> list[tuple[float, float, int]]:
    """Where a number ends, where the next one begins, and that number.

    Both places are one, but for a leap.
    """
    span = group.course.sweep.usual
    marks = []
    for k in range(1, len(found)):
        if found[k].leapt:
            marks.append((found[k - 1].at, found[k].at, found[k].number))
            continue
        if found[k].number == found[k - 1].number:
            continue
        low, high = found[k - 1], found[k]
        ways = group.paired(low, high)
        while abs(high.at - low.at) > ENOUGH * span:
            low, high = narrowed(group, low, high, ways)
        middle = (low.at + high.at) / 2
        marks.append((middle, middle, found[k].number))
    return marks


def narrowed(
    group: Numbered,
    low: NumberedPlace,
    high: NumberedPlace,
    ways: Sequence[FollowedClosures],
) -> tuple[NumberedPlace, NumberedPlace]:
    """Two neighbouring places between which the number changes, of many between two such."""
    share = np.linspace(0, 1, (PARTS if ways else group.parts) + 1)[1:-1]
    at = low.at + (high.at - low.at) * share
    between = low.points[:, None] + (high.points - low.points)[:, None] * share
    closures = group.places(at, ways)
    misses = np.abs(closures[:, : len(group.targets)] - between).max(axis=1)
    numbers = np.where(np.isfinite(misses), misses, np.inf).argmin(axis=0) + 1
    for k, number in enumerate(numbers.tolist()):
        node = group.node(float(at[k]), number, closures[:, :, k])
        if number != low.number:
            return low, node
        low = node
    return low, high


def same_place(first: NumberedPlace, last: NumberedPlace) -> bool:
    """Whether the motion has come back to where it began."""
    size = float(np.abs(first.points - first.points.mean()).max())
    return bool(np.abs(first.points - last.points).max() <= SURE * size)
