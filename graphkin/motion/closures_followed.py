"""Groups of higher class along a sweep: each closure followed, and its numbers.

The number in the scene counts in the position that is drawn. From there the motion determines each
group's closure, in the order of construction, given the motion of the groups before it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from graphkin.construction.higher_class.closure_solver import closing
from graphkin.construction.higher_class.following import (
    LONGEST,
    MERGED,
    FollowedClosure,
    GroupOnWay,
    PairedClosures,
)
from graphkin.motion.course import Course
from graphkin.motion.driving import TURN
from graphkin.motion.sweep import name_of
from graphkin.motion.turns_followed import Followed, following, led, too_many
from graphkin.scene.model import Closure

Reals = np.ndarray[Any, np.dtype[Any]]

PLACES, FEWER = 360, 120
"""Positions in a usual sweep at which closures are numbered.

They are fewer where several links are tried at once, because each then costs a hundredfold.
"""
ENOUGH = 1e-10
"""Share of the usual sweep to which changes of number are located."""
ROUGH = 1e-4
"""ENOUGH where several links are tried and the closures do not continue one to one."""
STRIDE = 10
"""Steps between two positions at which all closures are searched for."""
PASSES, CROWDED = 3, 1e-3
"""Changes in a short bracket that are too many to tell apart, and the length of such a bracket.

Where another closure moves away without end, a wheel of it turns past the links of this one.
"""
PARTS, HALVES = 16, 2
"""Parts into which an interval with a new number is cut, all tried at once.

HALVES is for a group that tries several links, where positions together cost as much as apart.
"""
TIED = 1e-7
"""Share of the usual sweep within which numbers that change back and forth are one change."""
BESIDE = 1e-6
"""Distance from a meeting of two closures at which they are numbered, in usual sweeps."""
MOST = 20_000
"""The most positions at which closures are numbered in one sweep."""


def carried(course: Course, start: float, stop: float, longest: float = LONGEST) -> Course:
    """The course with its higher-class groups and counted links followed from one u to another.

    They are followed as far as they go, by steps of at most ``longest`` usual ranges. What was
    followed before is kept.
    """
    if course.closers and start != stop:
        end = stop
        for number in range(len(course.closers)):
            onward = followed(course, number, start, end, longest)
            if onward is None:
                return course.along(closures=())
            course, at = onward, onward.closures[number].at
            end = min(end, float(at[-1])) if stop > start else max(end, float(at[0]))
    return led(course, start, stop)


def carried_about(course: Course, start: float) -> Course:
    """The course with its groups followed in both directions from the scene's position."""
    sweep = course.sweep
    far = (start + TURN, start - TURN) if sweep.whole else (sweep.high, sweep.low)
    course = carried(course, start, max(far[0], start))
    if sweep.whole and not any(way.lost(np.array(far))[0] for way in course.closures):
        return course
    return carried(course, start, min(far[1], start))


def followed(
    course: Course, k: int, start: float, stop: float, longest: float = LONGEST
) -> Course | None:
    """The course with a group followed up to a given u; None where it does not close.

    Where the group is followed already, it continues from there.
    """
    known = course.closures[k] if k < len(course.closures) else None
    if known is not None:
        stops = np.array([stop])
        if (known.covers(stops) | known.lost(stops))[0]:
            return course
        start = float(known.at[-1 if stop > start else 0])
    step = course.closers[k]
    counting = counted_for(course, step)
    before = [link for link in counting if not hangs_on(course, link, step)]
    inside = [link for link in counting if link not in before]
    course = led(course, start, stop, links=before)
    moving = Counting(course, step, following(course, start, inside), inside, stop)
    group = moving.group()
    if known is not None:
        row = known.row_at(start)
    else:
        row = group.begun(start, closing(course.program.steps[step]).number)
    if row is None:
        return None
    way = group.followed(row, start, stop, moving.seen, longest)
    if known is not None:
        ways = (known, way) if stop > start else (way, known)
        way = ways[0].joined(ways[1], [one.turns for one in group.trying.unknowns])
    return moving.course.along(closures=(*course.closures[:k], way, *course.closures[k + 1 :]))


class Counting:
    """A followed group, with its counted links followed from position to position."""

    def __init__(
        self, course: Course, step: int, counted: Followed, links: Sequence[str], stop: float
    ) -> None:
        self.course, self.step, self.counted = course, step, counted
        self.links, self.stop = links, stop

    def group(self) -> GroupOnWay:
        """The group, given the turns counted so far."""
        trying = closing(self.course.program.steps[self.step]).trying
        usual = self.course.sweep.usual
        return GroupOnWay(trying, lambda at: self.course.known_at(self.step, at), usual)

    def seen(self, at: float, row: Reals) -> None:
        """Update the count at a position where a link has turned too far."""
        if not self.links:
            return
        trying = closing(self.course.program.steps[self.step]).trying
        closed = {self.step: trying.parts(np.array([[0.0, *row, 1.0]]))}
        here = np.array([at])
        values = self.course.values(here)
        angles = self.course.counted(values, here, self.links, closed)
        degrees = {link: float(np.degrees(row[0])) for link, row in angles.items()}
        if np.isfinite([*degrees.values()]).all() and self.counted.counts_on(at, degrees):
            turned = self.counted.turned(self.stop).beside(self.course.turned)
            self.course = self.course.along(turned=turned)


def counted_for(course: Course, step: int) -> list[str]:
    """The links on whose counted turns a group depends."""
    steps = course.program.steps
    given = (steps[n].given for n in course.program.behind((step,)))
    used = {name for each in given if each is not None for name in each.uses()}
    return [link for link in course.counting if name_of(link) in used]


def hangs_on(course: Course, link: str, step: int) -> bool:
    """Whether the turn of a link follows from the closure of a group."""
    return step in course.program.behind((course.program.targets["turned", link],))


# --- the numbers along the way -------------------------------------------------------------------


class Bracket(NamedTuple):
    """Two positions between which the number of a closure changes, and the numbers there.

    A ``crowded`` one is not cut further.
    """

    low: float
    first: int
    high: float
    last: int
    pairs: PairedClosures | None = None
    crowded: bool = False


def numbers_between(course: Course, low: float, high: float) -> list[tuple[float, Course]]:
    """The start of each part of a sweep with constant closure numbers, and its course.

    The course states these numbers.
    """
    marks = [
        (at, name, number)
        for k, name in enumerate(course.numbered)
        for at, number in changes(course, k, low, high)
    ]
    numbers = dict[str, int]()
    found = list[tuple[float, dict[str, int]]]()
    for at, name, number in sorted(marks):
        numbers = numbers | {name: number}
        found = (
            [*found[:-1], (at, numbers)]
            if found and found[-1][0] == at
            else [*found, (at, numbers)]
        )
    ends = [*(at for at, _ in found[1:]), high]
    return [(at, stated(course, n, at, end)) for (at, n), end in zip(found, ends, strict=True)]


def stated(course: Course, numbers: dict[str, int], low: float, high: float) -> Course:
    """The course written for a part of its sweep, with the closure numbers there."""
    branches = {**course.branches, **{name: Closure(n) for name, n in numbers.items()}}
    ways = tuple(way.within(low, high) for way in course.closures)
    other = Course(course.sweep, branches, (low + high) / 2, course.turned, ways)
    return course.along(closures=ways) if branches == dict(course.branches) else other


def changes(course: Course, k: int, low: float, high: float) -> list[tuple[float, int]]:
    """The number of a group's closure at the start of an interval, and each later number."""
    group, way = course.group(k), course.closures[k]
    usual = course.sweep.usual
    places, least = (FEWER, STRIDE) if group.trying.several else (PLACES, 2 * STRIDE)
    count = max(int(np.ceil((high - low) / usual * places)), least)
    if count > MOST:
        raise too_many(course, MOST)
    grid = np.linspace(low, high, count + 1)
    numbers = known_numbers(numbers_at(group, way, grid), course.branches[course.numbered[k]])
    done = list[Bracket]()
    wide = at_meetings(group, way, parted(grid, numbers))
    while wide:
        done += [each for each in wide if each.high - each.low <= enough(group, each)]
        wide = narrowed(group, way, [each for each in wide if each not in done])
        led = [each for each in wide if each.pairs is not None]
        wide = led + at_meetings(group, way, [each for each in wide if each.pairs is None])
    brackets = sorted(done, key=lambda each: each.low)
    marks = ((each.low + each.high) / 2 for each in brackets)
    return settled(low, int(numbers[0]), [*zip(marks, brackets, strict=True)], usual * TIED)


def numbers_at(group: GroupOnWay, way: FollowedClosure, at: Reals) -> Reals:
    """The number of a followed closure at each u; 0 where that is open.

    All closures are searched for at a few positions and followed between them. Where they do not
    continue one to one, or come too near one another, the middle is searched, too. All numbers are
    open where a third of the searches do not find the followed closure.
    """
    rows: Reals = way.rows(group, at)
    numbers: Reals = np.zeros(len(at), dtype=int)
    nodes = np.unique(np.append(np.arange(0, len(at) - 1, STRIDE), len(at) - 1))
    wide, searched = [*zip(nodes.tolist(), nodes[1:].tolist(), strict=False)], nodes[:0]
    while nodes.size:
        every = group.every(at[nodes])
        numbers[nodes] = [group.number(e, r) for e, r in zip(every, rows[nodes], strict=True)]
        searched = np.append(searched, nodes)
        if 3 * ((numbers[searched] == 0) & (rows[searched, -1] > MERGED)).sum() > searched.size:
            return 0 * numbers
        halves = list[tuple[int, int]]()
        for first, last in wide:
            inside = np.arange(first + 1, last)
            if not inside.size or not (numbers[first] or numbers[last]):
                continue
            pairs = group.paired_at(float(at[first]), float(at[last]))
            led = None if pairs is None else group.numbers_led(pairs, way, at[inside])
            if led is None:
                middle = (first + last) // 2
                halves += [(first, middle), (middle, last)]
            else:
                numbers[inside] = led
        wide, nodes = halves, np.array([last for _, last in halves[::2]], dtype=int)
    return numbers


def enough(group: GroupOnWay, bracket: Bracket) -> float:
    """The width at which a bracket locates a change of number."""
    if bracket.crowded:
        return bracket.high - bracket.low
    searched = group.trying.several and bracket.pairs is None
    return (ROUGH if searched else ENOUGH) * group.usual


def settled(
    low: float, first: int, marks: Sequence[tuple[float, Bracket]], near: float
) -> list[tuple[float, int]]:
    """The numbers from a given u on, each with its start.

    Where several numbers change near one place, the last counts: the angles of two closures are
    equal there but for rounding.
    """
    found = [(low, first)]
    for n, (at, each) in enumerate(marks):
        if n + 1 < len(marks) and marks[n + 1][0] - at < near:
            continue
        if each.last != found[-1][1]:
            found.append((at, each.last))
    return found


def known_numbers(numbers: Reals, stated: Any) -> Reals:
    """The numbers, with one that rounding leaves open replaced by the one before it.

    At the start, the next one replaces it.
    """
    known = np.flatnonzero(numbers)
    if not known.size:
        return np.full(len(numbers), stated.number)
    before = np.maximum(np.searchsorted(known, np.arange(len(numbers)), side="right") - 1, 0)
    return numbers[known[before]]


def parted(at: Reals, numbers: Reals) -> list[Bracket]:
    """The neighbouring positions between which the number changes."""
    return [
        Bracket(float(at[n]), int(numbers[n]), float(at[n + 1]), int(numbers[n + 1]))
        for n in np.flatnonzero(np.diff(numbers))
    ]


def at_meetings(group: GroupOnWay, way: FollowedClosure, wide: Sequence[Bracket]) -> list[Bracket]:
    """The brackets with all closures at both ends, where these continue one to one.

    Where two closures appear or vanish in between, it is the place at which these meet.
    """
    found = list[Bracket]()
    group.every(np.array([(each.low, each.high) for each in wide]).ravel())
    for each in wide:
        meeting = group.met(each.low, each.high)
        if meeting is not None:
            beside = meeting + BESIDE * group.usual * np.array([-1, 1])
            if (each.first, each.last) == tuple(group.numbers(way, beside)):
                found.append(each._replace(low=meeting, high=meeting))
                continue
        found.append(each._replace(pairs=group.paired_at(each.low, each.high)))
    return found


def narrowed(group: GroupOnWay, way: FollowedClosure, wide: Sequence[Bracket]) -> list[Bracket]:
    """Each bracket cut into parts: those in which the number changes."""
    found, rest = list[Bracket](), list[Bracket]()
    for each in wide:
        at = np.linspace(each.low, each.high, PARTS + 1)
        numbers = None if each.pairs is None else group.numbers_led(each.pairs, way, at[1:-1])
        if numbers is None:
            rest.append(each)
        else:
            found += within(group, each, at, numbers)
    if rest:
        count = HALVES if group.trying.several else PARTS
        grids = np.array([np.linspace(each.low, each.high, count + 1) for each in rest])
        inside = group.numbers(way, grids[:, 1:-1].ravel()).reshape(len(rest), count - 1)
        for each, at, numbers in zip(rest, grids, inside, strict=True):
            found += within(group, each._replace(pairs=None), at, numbers)
    return found


def within(group: GroupOnWay, each: Bracket, at: Reals, numbers: Reals) -> list[Bracket]:
    """The parts of a bracket in which the number changes, by the numbers at positions within."""
    every = known_numbers(np.array([each.first, *numbers, each.last]), None)
    found = [part._replace(pairs=each.pairs) for part in parted(at, every)]
    if len(found) > PASSES and each.high - each.low <= CROWDED * group.usual:
        return [each._replace(crowded=True)] if each.first != each.last else []
    return found
