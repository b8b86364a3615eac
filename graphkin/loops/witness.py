"""The residual check: a solution compared with vector loops independent of its construction.

A disagreement is the absolute difference divided by the largest magnitude of that quantity in the
scene. A scale is at least a thousandth of the value expected from the other quantities (v ≈ ω·L and
so on). Near singular positions it is at least the share of rounding in the limit. Otherwise the
rounding of a quantity that is zero everywhere would count as a difference.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property
from math import isnan
from typing import Any

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.quantities import (
    JERK,
    QUANTITIES,
    LinkMotion,
    PointMotion,
    SlideMotion,
    motion_value,
)
from graphkin.construction.core.solution import Solution, Verdict
from graphkin.loops.assemble import (
    ON_LINE,
    closure_numbers,
    closures,
    facing,
    facing_alike,
    other_closure,
    turned_side,
)
from graphkin.loops.cam_laws import by_law, without_linkages
from graphkin.loops.closing_groups import Group, counted_in_order, groups, speaks_of, stages
from graphkin.loops.differences import (
    LEAST_LIMIT,
    Differences,
    Magnitudes,
    differing,
    digits_of,
    or_one,
)
from graphkin.loops.equations import Equations, equations, joined, part_of
from graphkin.loops.loop_motion import Motion, pose_of, setting_of, unknowns_of
from graphkin.loops.newton import LoopSolution, Start, closed_from, refuse_undriven, start_values
from graphkin.loops.rigid_bodies import Reals
from graphkin.scene.link_points import ends_of, is_under
from graphkin.scene.model import FRAME, Closure, Scene, Side, Way

NUMBERED = 12
"""Settings of a batch, evenly spread, whose closures are numbered; all would take too long."""

Flags = np.ndarray[Any, np.dtype[np.bool_]]


class Closed(Struct, frozen=True, eq=False, dict=True):
    """Closed loops with their motion, the sizes of their quantities and the branch conditions."""

    solved: LoopSolution

    @cached_property
    def scales(self) -> Magnitudes:
        """The largest magnitude of each kind of quantity."""
        motion = self.solved.motion
        return Magnitudes.of(motion, self.solved.rounding, breadth(motion))

    @cached_property
    def branches(self) -> dict[int, dict[str, Flags]]:
        """The branch conditions found so far, by the number of settings with numbered closures."""
        return {}


class Concerned(Struct, frozen=True, eq=False, dict=True):
    """The loops that a solution concerns, and the scene with the branches of their links."""

    scene: Scene
    loops: Equations

    @cached_property
    def closed(self) -> dict[tuple[bytes, bool], Closed]:
        """The loops closed last, by start values and whether accelerations were asked for."""
        return {}

    def closed_from(self, start: Reals, *, accelerations: bool) -> Closed:
        """The loops closed from given unknowns; the last result is reused for the same start."""
        key = start.tobytes(), accelerations
        if key not in self.closed:
            found = closed_from(self.loops, start, accelerations=accelerations, singular=True)
            self.closed.clear()
            self.closed[key] = Closed(found)
        return self.closed[key]

    def branches(self, closed: Closed, *, numbered: int) -> dict[str, Flags]:
        """The branch conditions of closed loops, kept once found."""
        if numbered not in closed.branches:
            found = branch_conditions(self, closed.solved, numbered=numbered)
            closed.branches[numbered] = found
        return closed.branches[numbered]

    @cached_property
    def groups(self) -> list[Group]:
        """The groups of two or more links, each in the order in which it becomes known."""
        return groups(self.scene, self.loops)


class Check(Struct, frozen=True, eq=False, dict=True):
    """The independent check of a scene, for its own parameters or for a batch of them.

    The loops are written once. They are reduced once for each set of links that a solution
    concerns.
    """

    scene: Scene
    values: Mapping[str, Any] | None = None

    @cached_property
    def whole(self) -> Concerned:
        scene = by_law(self.scene)
        loops = equations(scene, self.values)
        return Concerned(scene, counted_in_order(loops))

    @cached_property
    def stages(self) -> list[Group]:
        """All groups of links, in the order in which they become known."""
        return stages(self.whole.scene, self.whole.loops)

    @cached_property
    def parts(self) -> dict[frozenset[str], Concerned]:
        """The loops within a set of links, for the sets examined so far."""
        return {}

    def concerned(self, solution: Solution) -> Concerned:
        """The loops of the links in a solution, and of the links that these depend on."""
        within = links_concerned(self, solution)
        if within is None:
            return self.whole
        if within not in self.parts:
            loops = counted_in_order(joined(self.whole.scene, self.whole.loops.parts, within, {}))
            self.parts[within] = Concerned(scene_of(loops), loops)
        return self.parts[within]

    def examine(self, solution: Solution, *, numbered: int = NUMBERED) -> Examined:
        """Solve the loops from the solution's positions and compare every quantity of the solution.

        Links and accelerations that the solution does not contain are not compared.
        """
        solution = without_linkages(self.scene, solution)
        concerned = self.concerned(solution)
        loops = concerned.loops
        refuse_undriven(loops)
        start, guessed = started(concerned.scene, loops, solution)
        closed = concerned.closed_from(start, accelerations=has_acceleration(solution))
        with np.errstate(all="ignore"):
            differences = differing(closed.solved, solution, closed.scales)
            branches = concerned.branches(closed, numbered=numbered)
        return Examined(closed.solved, differences, branches, guessed)

    def compare(self, solution: Solution, *, numbered: bool = True) -> Verdict:
        """Compare one solution with the vector loops, with its positions as the start values.

        ``guessed`` in the verdict names the links that no position determines. Without
        ``numbered``, branches that require a count of all closures are not checked. Raises
        WitnessError where the loops do not close or are singular, StructureError where drivers are
        missing.
        """
        examined = self.examine(solution, numbered=NUMBERED if numbered else 0)
        difference, quantity, limit = examined.largest(0)
        broken = tuple(name for name, holds in examined.branches.items() if not holds[0])
        report = examined.solved.report
        return Verdict(
            agrees=bool(examined.agrees[0]),
            largest_difference=difference,
            quantity=quantity,
            limit=limit,
            residual=float(report.residual[0]),
            moved=float(report.moved[0]),
            branches=broken,
            guessed=examined.guessed,
            digits=digits_of(examined.differences),
            unsure=tuple(examined.unsure),
        )


def branch_conditions(
    concerned: Concerned, solved: LoopSolution, *, numbered: int = NUMBERED
) -> dict[str, Flags]:
    """Whether each statement of [branches] holds: arrays of shape (N,).

    Closure numbers, and ways of groups other than dyads, are checked in at most ``numbered``
    settings of a batch, evenly spread.
    """
    found: dict[str, Flags] = {}
    stated = concerned.scene.branches.items()
    sides_only = all(isinstance(branch, Side) for _, branch in stated)
    known = [] if sides_only else concerned.groups
    motion = solved.motion
    for name, branch in stated:
        if isinstance(branch, Side):
            side = turned_side(motion, branch.first, branch.second, name)
            found[name] = np.asarray(branch.side * side > -side_slack(solved, name, branch))
            continue
        if isinstance(branch, Way):
            ahead = facing(solved.loops, motion, name)
            if ahead is not None:
                found[name] = np.asarray(branch.way * ahead > 0)
                continue
        for group in (each for each in known if speaks_of(name, branch, each, solved.loops)):
            if isinstance(branch, Way) and group.is_dyad:
                holds = way_of_dyad(branch, solved, group)
            elif not numbered:
                continue
            else:
                holds = picked_rows(branch, solved, group, name, numbered)
            found[name] = found.get(name, True) & holds
    return found


def side_slack(solved: LoopSolution, name: str, branch: Side) -> Reals:
    """How far rounding may put a pin across the line through two others, as a sine."""
    pins, names = (branch.first, branch.second, name), solved.motion.names
    start, end, place = (solved.motion.place(each) for each in pins)
    errors = solved.rounding.points.place[:, [names[each] for each in pins]].sum(axis=1)
    return np.asarray(ON_LINE + errors / np.minimum(abs(end - start), abs(place - start)))


def way_of_dyad(branch: Way, solved: LoopSolution, group: Group) -> Flags:
    """Whether the slide of a dyad faces the stated way. A dyad with two slides has one closure."""
    loops = solved.loops
    if len(group.slides) != 1:
        return np.ones(loops.numbers.count, dtype=np.bool_)
    current, other = other_closure(loops, solved.motion, group)
    error = solved.rounding.slide(group.slides[0].slide).position
    return np.asarray(branch.way * (current - other) > -ON_LINE * loops.size - 4 * error)


def picked_rows(
    branch: Way | Closure, solved: LoopSolution, group: Group, name: str, most: int
) -> Flags:
    """Whether a group is in the stated closure, from all its closures in ``most`` settings."""
    count = solved.loops.numbers.count
    holds = np.ones(count, dtype=np.bool_)
    settings = np.flatnonzero(solved.report.good)
    for n in settings[evenly(len(settings), most)]:
        if isinstance(branch, Closure):
            row = solved.unknowns[n]
            numbers = closure_numbers(solved.loops, group, row, int(n))
            holds[n] = branch.number in numbers
        else:
            holds[n] = farthest(branch, solved, group, name, int(n))
    return holds


def evenly(count: int, most: int) -> list[int]:
    """At most ``most`` numbers below ``count``, evenly spread; the middle one if it is 1."""
    if most == 1:
        return [count // 2] if count else []
    spread = np.linspace(0, max(count - 1, 0), min(count, most))
    return [*dict.fromkeys(spread.astype(int).tolist())]


def farthest(branch: Way, solved: LoopSolution, group: Group, name: str, n: int) -> bool:
    """Whether a group's slide coordinate is the largest (or smallest) of all its closures."""
    from graphkin.loops.assemble import led_by

    loops = solved.loops
    part = part_of(loops, group.known | set(group.links), setting_of(loops, n))
    current = unknowns_of(part, pose_of(loops, solved.unknowns[n], n))
    j = led_by(name, group, loops, part)
    if j is None:
        return True
    column = part.turning_count + j
    rows = closures(part, current, group)
    every = rows[facing_alike(part, current, rows, group)][:, column]
    end = every.max(initial=-np.inf) if branch.way > 0 else every.min(initial=np.inf)
    return bool(abs(current[0, column] - end) <= 1e-6 * part.size[0])


def compare(
    scene: Scene,
    solution: Solution,
    values: Mapping[str, Any] | None = None,
    *,
    numbered: bool = True,
) -> Verdict:
    """The verdict of ``Check.compare`` on one solution."""
    return Check(scene, values).compare(solution, numbered=numbered)


class Examined(Struct, frozen=True, eq=False):
    """The comparison of both routes: differences and branches by name, of shape (N,) each."""

    solved: LoopSolution
    differences: Differences
    branches: Mapping[str, Flags]
    guessed: tuple[str, ...] = ()

    @property
    def unsure(self) -> dict[str, Flags]:
        """Quantities without a certain digit in some setting, and in which settings: (N,) each."""
        lost = ~self.differences.judged
        somewhere = np.flatnonzero(lost.any(axis=1))
        return {self.differences.names[q]: lost[q] for q in somewhere}

    @property
    def worst(self) -> Reals:
        """The largest certain difference of each setting; NaN where the setting fails."""
        each = self.differences
        known = np.where(self.solved.report.good, 0.0, np.nan)
        worst = np.where(each.judged, each.found, 0.0).max(axis=0, initial=0.0)
        return np.asarray(np.maximum(known, worst))

    @property
    def agrees(self) -> Flags:
        """Where every difference is within its limit and every branch as stated."""
        each = self.differences
        agrees = self.solved.report.good
        agrees = agrees & ((each.found <= each.limit) | ~each.judged).all(axis=0)
        for holds in self.branches.values():
            agrees = agrees & holds
        return np.asarray(agrees)

    def largest(self, row: int) -> tuple[float, str, float]:
        """The largest difference of one setting, the name of that quantity, and the largest limit.

        If a difference exceeds its limit, that difference is returned with its own limit. Of
        several, it is the one with the largest ratio to its limit.
        """
        every = self.differences
        found, limit = every.found[:, row].tolist(), every.limit[:, row].tolist()
        known = np.flatnonzero(every.judged[:, row]).tolist()
        beyond = [q for q in known if not found[q] <= limit[q]]

        def farthest(q: int) -> tuple[bool, float]:
            return isnan(found[q]), found[q] / limit[q] if beyond else found[q]

        if not known:
            return 0.0, "", LEAST_LIMIT
        worst = max(beyond or known, key=farthest)
        most = max(limit[q] for q in (beyond and [worst]) or known)
        return found[worst], every.names[worst], most


def examine(
    scene: Scene, solution: Solution, values: Mapping[str, Any] | None, *, numbered: int = NUMBERED
) -> Examined:
    """The comparison of one solution, by ``Check.examine``."""
    return Check(scene, values).examine(solution, numbered=numbered)


def started(scene: Scene, loops: Equations, solution: Solution) -> tuple[Reals, tuple[str, ...]]:
    """The start values for Newton's method, and the links and blocks assembled for them.

    The start values are the solution's positions. The loops' own assembly, in the branches that the
    scene states, gives what these positions do not determine.
    """
    solution, scene = without_linkages(scene, solution), by_law(scene)
    places = {name: p.position for name, p in solution.points.items() if p.position is not None}
    slides = {name: s.position for name, s in solution.slides.items() if s.position is not None}
    named = {name: place for name, place in places.items() if not is_under(name)}
    with np.errstate(all="ignore"):
        start = start_values(loops, named, slides)
    if start.determined.all():
        return start.unknowns, ()
    from graphkin.loops.assemble import completed_start

    return completed_start(scene, loops, start), untold(loops, start)


def untold(loops: Equations, start: Start) -> tuple[str, ...]:
    """The links whose angle, and the blocks whose coordinate, no position determines."""
    turnings = {k + 1 for k in range(loops.turning_count) if not start.determined[k]}
    links = [link for link, k in loops.turned.of.items() if k in turnings and link != FRAME]
    blocks = [
        guide.block
        for j, guide in enumerate(loops.guides)
        if not start.determined[loops.turning_count + j]
    ]
    return tuple(dict.fromkeys([*links, *blocks]))


def breadth(motion: Motion) -> Reals:
    """Largest distance between two points of the mechanism (m), shape (N,)."""
    places = motion.points.place
    return or_one(np.abs(places[:, :, None] - places[:, None, :]).max(axis=(1, 2)))


def links_concerned(check: Check, solution: Solution) -> frozenset[str] | None:
    """The links in a solution and those they depend on, or None if these are all links.

    A pin of several links counts for the link that becomes known first. All links are taken where
    one belongs to no group: it may be idle and still hold the others.
    """
    loops = check.whole.loops
    spoken, moving = set(links_named(solution)), set(loops.links) - {FRAME}
    links_of = loops.owners_of
    named = (name for name, motion in solution.points.items() if says_anything(motion))
    owners = [links_of.get(ends_of(name)[0], []) for name in named]
    if spoken.union(*(each for each in owners if len(each) == 1)) >= moving:
        return None
    order = check.stages
    place = {link: n for n, group in enumerate(order) for link in group.links}
    if not place.keys() >= moving:
        return None
    firsts = (min(each, key=lambda link: place.get(link, -1)) for each in owners if each)
    wanted = {place[link] for link in spoken.union(firsts) if link in place}
    for n in range(len(order) - 1, -1, -1):
        if n in wanted:
            joints = (*order[n].outer, *order[n].ties)  # to links known before
            wanted |= {place[link] for joint in joints for link in joint.links if link in place}
    return frozenset(link for n in wanted for link in order[n].links)


def links_named(solution: Solution) -> Iterator[str]:
    """The links and blocks with a known quantity, and links named in a point such as A@3."""
    yield from (name for name, link in solution.links.items() if says_anything(link))
    yield from (name for name, slide in solution.slides.items() if says_anything(slide))
    for pair in solution.centres:
        yield from pair.split("-")
    yield from (link for name in solution.points if (link := ends_of(name)[1]))


def says_anything(motion: PointMotion | LinkMotion | SlideMotion) -> bool:
    return any(getattr(motion, name) is not None for name in motion.__struct_fields__)


def has_acceleration(solution: Solution) -> bool:
    """Whether a solution holds an acceleration."""
    return any(
        motion_value(motion, quantity) is not None
        for quantity in QUANTITIES
        if quantity.kind in ("acceleration", JERK)
        for motion in getattr(solution, quantity.whose).values()
    )


def scene_of(loops: Equations) -> Scene:
    """The scene of the equations, with only the branches of their points and links."""
    branches = {
        name: branch
        for name, branch in loops.scene.branches.items()
        if (
            {name, branch.first, branch.second} <= set(loops.points)
            if isinstance(branch, Side)
            else name in loops.links
        )
    }
    return replace(loops.scene, branches=branches)
