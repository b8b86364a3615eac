"""A mechanism with selected closures: its positions and motion for arrays of u."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cached_property
from typing import Any

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.compile import write
from graphkin.construction.core.kind import construction
from graphkin.construction.core.program import Program, Target
from graphkin.construction.core.run import (
    Ready,
    StepFailed,
    Trace,
    evaluate,
    is_array,
    made_ready,
    run_batch,
    run_blocks,
    run_moving,
)
from graphkin.construction.higher_class.closed_group import ClosedGroup
from graphkin.construction.higher_class.closure_solver import closer_of, closing
from graphkin.construction.higher_class.following import FollowedClosure, GroupOnWay
from graphkin.construction.links.rolled_turn import counted_link
from graphkin.mechanism import Mechanism
from graphkin.motion.sweep import Sweep, Turned, inputs
from graphkin.numbers.arithmetic import FLOAT, batch_kind
from graphkin.numbers.plane import Circle, Line, Ratio
from graphkin.scene.model import Branch, Closure, Scene
from graphkin.structure.decomposition import decompose
from graphkin.structure.groups import Group, Higher
from graphkin.text.errors import GraphkinError

Reals = np.ndarray[Any, np.dtype[Any]]
Flags = np.ndarray[Any, np.dtype[np.bool_]]
Branches = Mapping[str, Branch]
NOISE = 1e-9
"""Sine of a crossing below which its loci coincide but for rounding."""
PLACES = ("position", "slide", "axis", "rolled")
"""Targets that give the position of the mechanism."""


class Course(Struct, frozen=True, dict=True):
    """One choice of closures throughout a sweep: its scene, its program, and how to run it.

    ``here`` is a u at which these closures hold, so that the construction can use the shape of the
    mechanism there. Without it, they hold in the scene's position. ``turned`` gives the turned
    angles of links that only pins turn and on which wheels depend. Without it, these links count
    near the scene's angles throughout. ``closures`` are the followed closures of higher-class
    groups, in the order of construction. Groups without one are closed anew at every position.
    """

    sweep: Sweep
    branches: Branches
    here: float | None = None
    turned: Turned | None = None
    closures: tuple[FollowedClosure, ...] = ()

    def along(self, **ways: Any) -> Course:
        """The course with other followed closures; its cached program is kept."""
        other = replace(self, **ways)
        vars(other).update(vars(self))
        return other

    @cached_property
    def scene(self) -> Scene:
        """The scene ready for arrays, with these closures."""
        return self.standing(self.here)

    def standing(self, here: float | None) -> Scene:
        """The scene with these closures in the position of a given u."""
        values = None if here is None else self.values(np.array([here]))
        return self.sweep.with_branches(self.branches, values)

    def mechanism(self, here: float) -> Mechanism:
        """The mechanism at a given u, with its groups closed as they were followed to there."""
        at = np.array([here])
        closings = {}
        for step, closed in self.closing(self.values(at), at).items():
            links = self.closed_links[self.closers.index(step)]
            if all(np.isfinite(each).all() for each in closed):
                closings[links] = tuple(each[0].item() for each in closed)
        return Mechanism(self.standing(here), closings)

    def values(self, at: Any, *, geometric: bool = False) -> dict[str, Any]:
        """All values of the scene for an array of u (N,): those of the sweep, and turned angles."""
        turned = {} if self.turned is None else self.turned.values(at)
        return self.sweep.values(at, geometric=geometric) | turned

    @cached_property
    def groups(self) -> tuple[Group, ...]:
        """Driven links and groups, with the drivers that are named values."""
        return decompose(self.scene)

    @cached_property
    def program(self) -> Program:
        return write(self.scene, self.groups)

    @cached_property
    def early(self) -> tuple[int, ...]:
        """The steps that construct all positions."""
        return self.program.needed(t for t in self.program.targets if t[0] in PLACES)

    @cached_property
    def crossings(self) -> tuple[int, ...]:
        """The steps of positions that cross two loci and depend on u, in order."""
        moving = self._moving()
        steps = self.program.steps
        return tuple(
            n
            for n in self.early
            if n in moving and (action := steps[n].action) is not None and action.margin is not None
        )

    def _moving(self) -> set[int]:
        """The early steps that depend on a driver."""
        arrays = inputs(self.scene)
        moving: set[int] = set()
        for n in self.early:
            step = self.program.steps[n]
            given = step.given is not None and not arrays.isdisjoint(step.given.uses())
            if given or not moving.isdisjoint(step.args):
                moving.add(n)
        return moving

    @cached_property
    def counting(self) -> tuple[str, ...]:
        """The links whose angle counts near a followed one, because only pins turn them."""
        steps, moving = self.program.steps, self._moving()
        return tuple(
            of
            for (what, of), n in self.program.targets.items()
            if what == "turned" and n in moving and counted_link(steps[n]) == of
        )

    def counted(
        self,
        values: Mapping[str, Any],
        at: Reals,
        links: Iterable[str] | None = None,
        closed: Mapping[int, Any] | None = None,
    ) -> dict[str, Reals]:
        """The angles (radians), (N,) each, of ``links`` or of all counted links.

        ``closed`` are closed groups in addition to those that were followed.
        """
        some = self.counting if links is None else tuple(links)
        keep = tuple(self.program.targets["turned", link] for link in some)
        overrides = self.closing(values, at, keep, closed)
        trace = self.run_ready(keep, values, overrides)
        return {link: spread(trace.value("turned", link), len(at)) for link in some}

    def angles(self, at: float) -> dict[str, float]:
        """The angles (degrees) of the counted links at one u."""
        here = np.array([at])
        found = self.counted(self.values(here), here)
        return {link: float(np.degrees(row[0])) for link, row in found.items()}

    @cached_property
    def closing_work(self) -> int:
        """The steps that closing groups takes at one position of the driver; 0 without groups."""
        work = 0
        values = self.values(np.array([self.sweep.start]))
        for n in self.closers:
            work += closing(self.program.steps[n]).trying.work(self.known_of(n, values, 1))
        return work

    @property
    def is_searched(self) -> bool:
        """Whether there is a group of higher class, whose positions are known to few digits."""
        return any(isinstance(each, Closure) for each in self.branches.values())

    @property
    def tried_at_once(self) -> int:
        """The most links that a group tries at once; 0 if no group does."""
        return max((len(g.nested) for g in self.groups if isinstance(g, Higher)), default=0)

    @property
    def tries_several(self) -> bool:
        """Whether a group closes only when several of its links are tried at once."""
        return self.tried_at_once > 1

    def margins(self, at: Any) -> Reals:
        """The sine of every crossing (rows as ``crossings``) for each u (N,); NaN does not close.

        The last row is 1 where all positions are finite, NaN elsewhere.
        """
        trace = self.run(at, [target for target in self.program.targets if target[0] in PLACES])
        found = np.ones((len(self.crossings) + 1, len(at)))
        for row, number in enumerate(self.crossings):
            found[row] = trace.margins[number]
        for value in trace.values.values():
            found[-1] = np.where(np.isfinite(value), found[-1], np.nan)
        return found

    @cached_property
    def closers(self) -> tuple[int, ...]:
        """The steps that close groups of higher class, in order."""
        return tuple(n for n in self.early if closer_of(self.program.steps[n]) is not None)

    @cached_property
    def closed_links(self) -> tuple[tuple[str, ...], ...]:
        """The links of these groups, in the same order."""
        kinds = [construction(self.program.steps[number]) for number in self.closers]
        return tuple(kind.closes for kind in kinds if isinstance(kind, ClosedGroup))

    @cached_property
    def numbered(self) -> tuple[str, ...]:
        """The links under which the closures of these groups are numbered, in the same order."""
        stated = [name for name, each in self.branches.items() if isinstance(each, Closure)]
        every = self.closed_links
        return tuple(next(name for name in stated if name in links) for links in every)

    @cached_property
    def within_groups(self) -> frozenset[int]:
        """The steps that construct the links of these groups after they are closed."""
        found: set[int] = set()
        for number, links in zip(self.closers, self.closed_links, strict=True):
            every = [("axis", link) for link in links]
            every += [("position", p) for name in links for p in self.scene.link(name).points]
            last = max(self.program.targets.get(target, 0) for target in every)
            steps = range(number + 1, last + 1)
            found |= {n for n in steps if number not in self.program.steps[n].args}
        return frozenset(found)

    def group(self, k: int) -> GroupOnWay:
        """A followed group of higher class, with the groups before it followed, too."""
        step = self.closers[k]
        trying = closing(self.program.steps[step]).trying
        return GroupOnWay(trying, lambda at: self.known_at(step, at), self.sweep.usual)

    def closing(
        self,
        values: Mapping[str, Any],
        at: Reals,
        keep: tuple[int, ...] | None = None,
        closed: Mapping[int, Any] | None = None,
    ) -> dict[int, tuple[Any, ...]]:
        """The values that close the followed groups, by step, for each u (N,).

        With ``keep``, only the groups that these steps depend on. Groups in ``closed`` are taken as
        given: beyond where a group was followed, each position would be searched anew. NaN where
        the path of any group has ended, because the mechanism closes nowhere there.
        """
        found: dict[int, tuple[Any, ...]] = dict(closed or {})
        lost = np.any([way.lost(at) for way in self.closures], axis=0)
        needed = self.closers if keep is None else self.closed_behind(keep)
        for k, way in enumerate(self.closures):
            number = self.closers[k]
            if number in found or number not in needed:
                continue
            known = self.known_of(number, values, len(at), found)
            stated = closing(self.program.steps[number]).number
            with np.errstate(all="ignore"):
                found[number] = way.closed(self.group(k), stated, at, known, lost)
        return found

    def closed_behind(self, keep: tuple[int, ...]) -> frozenset[int]:
        """The steps that close the groups on which some steps depend."""
        if keep not in self._behind:
            self._behind[keep] = frozenset(self.closers).intersection(self.program.behind(keep))
        return self._behind[keep]

    @cached_property
    def _behind(self) -> dict[tuple[int, ...], frozenset[int]]:
        """The groups known to stand behind some steps."""
        return {}

    @cached_property
    def _readied(self) -> dict[Any, Ready]:
        """The prepared inputs of steps for arrays of some values."""
        return {}

    def known_at(self, number: int, at: Reals) -> list[Reals]:
        """The inputs of a step at each u (N,), with earlier groups as they were followed."""
        values = self.values(at)
        args = tuple(self.program.steps[number].args)
        return self.known_of(number, values, len(at), self.closing(values, at, args))

    def known_of(
        self,
        number: int,
        values: Mapping[str, Any],
        count: int,
        closed: Mapping[int, Any] | None = None,
    ) -> list[Reals]:
        """The inputs of a step for values of the scene: arrays (N,)."""
        args = self.program.steps[number].args
        trace = self.run_ready(args, values, closed or {})
        return [spread(trace.values[arg], count) for arg in args]

    def run_ready(
        self, keep: tuple[int, ...], values: Mapping[str, Any], closed: Mapping[int, Any]
    ) -> Trace:
        """The values of some steps for arrays of values, from steps prepared for the same arrays.

        All values that are no arrays are those of the scene.
        """
        arrays = frozenset(name for name, value in values.items() if is_array(value))
        key = keep, arrays, frozenset(closed)
        with np.errstate(all="ignore"):
            if key not in self._readied:
                before = self.program.behind(keep)
                self._readied[key] = made_ready(self.program, before, values, keep, key[-1])
            return run_moving(self._readied[key], values, batch_kind(), overrides=closed)

    def closes(self, at: Any) -> Flags:
        """Whether all positions exist and are unambiguous, for each u (N,)."""
        return closing_columns(self.margins(at))

    def is_placed(self, at: Any) -> Flags:
        """Whether all positions exist, if only by rounding, for each u (N,)."""
        return np.asarray(np.isfinite(self.margins(at)).all(axis=0))

    def run(
        self, at: Any, targets: Iterable[Target] | None = None, *, geometric: bool = False
    ) -> Trace:
        """Values of the targets (all if None) and margins of the crossings, for each u (N,)."""
        wanted = list(self.program.answers if targets is None else targets)
        needed = self.program.needed(wanted)
        keep = tuple(self.program.targets[target] for target in wanted)
        at = np.asarray(at, dtype=float)
        values = self.values(at, geometric=geometric)
        overrides = self.closing(values, at, keep)
        with np.errstate(all="ignore"):
            if overrides:
                return run_batch(
                    self.program,
                    needed,
                    values,
                    batch_kind(),
                    keep,
                    margins=True,
                    overrides=overrides,
                )
            return run_blocks(self.program, needed, values, batch_kind(), keep, margins=True)

    def columns(
        self, at: Any, targets: Iterable[Target], *, geometric: bool = False
    ) -> dict[Target, Any]:
        """Each target as an array (N,), even if all u share one value."""
        wanted = list(targets)
        trace = self.run(at, wanted, geometric=geometric)
        return {target: spread(trace.value(*target), len(at)) for target in wanted}

    def loci(self, number: int, at: float) -> tuple[Any, ...]:
        """The two loci that a step crosses at one u; empty where they are not known."""
        here = np.array([at])
        values = self.values(here)
        closed = self.closing(values, here).items()
        found: dict[int, Any] = {n: tuple(part[0] for part in parts) for n, parts in closed}
        floats = {k: float(v[0]) if hasattr(v, "shape") else v for k, v in values.items()}
        step = self.program.steps[number]
        try:
            for n in Program(self.program.steps, {("", ""): number}).needed([("", "")]):
                if n != number and n not in found:
                    found[n] = evaluate(self.program.steps[n], n, found, floats, FLOAT, {})
        except (StepFailed, KeyError):
            return ()
        every = (found[arg] for arg in step.args)
        return tuple(locus for locus in every if isinstance(locus, Line | Circle))

    def picks(self, name: str, other: Branch) -> set[int]:
        """The steps that one branch statement decides: those that change with it.

        All crossings where the construction does not accept the other closure.
        """
        changed = replace(self, branches={**self.branches, name: other})
        try:
            steps = changed.program.steps
        except GraphkinError:
            return set(self.crossings)
        return {
            n
            for n, (mine, theirs) in enumerate(zip(self.program.steps, steps, strict=False))
            if mine.extra != theirs.extra
        }


def closing_columns(margins: Reals) -> Flags:
    """Which columns of margins close: all positions exist, and no two loci coincide."""
    return np.asarray((margins >= NOISE).all(axis=0))  # false for NaN


def spread(value: Any, count: int) -> Any:
    """An array of shape (N,) from a value that all may share; None stays None."""
    if isinstance(value, Ratio):
        return Ratio(*(spread(part, count) for part in value))
    if value is None:
        return None
    return np.array(np.broadcast_to(np.asarray(value), (count,)))
