"""The trial of a group of class III or higher: a program of its own.

It runs on arrays of trial values, or on one scene in any kind of number.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property
from math import pi, prod
from typing import Any

from msgspec import Struct

from graphkin.construction.core.program import Program
from graphkin.construction.core.run import (
    Ready,
    StepFailed,
    Values,
    made_ready,
    run,
    run_batch,
    run_moving,
)
from graphkin.construction.core.vocabulary import meet
from graphkin.numbers.arithmetic import Kind, batch_kind, np, phase, turn_by
from graphkin.numbers.kinds import middle
from graphkin.numbers.plane import cross

SAMPLES = 360
"""Trial positions in one revolution."""
MOST = 400_000
"""Trial positions run at once."""
START = 0.123e-3
"""The angle at which a revolution of trials begins: one at which links are hardly ever drawn."""
A_TURN = 24
"""Trial positions for each turn of a wheel on its track."""
FAR = 1.565
"""Angle whose tangent is the range tried along a guide, in units of the bars' reach."""


class Unknown(Struct, frozen=True):
    """An unknown of a trial: the step ``tried``, a unit vector (``turns``) or a coordinate (m).

    Its ``misfit`` must vanish. Its ``locus`` moves with the trial value and gives the angle of
    crossing. ``facing`` must be positive at a true fit. ``reach`` holds the range of a coordinate
    (m), and ``rim`` the radius of a wheel that is tried along its track (m).
    """

    tried: int
    turns: bool
    misfit: int
    locus: int
    facing: int | None = None
    reach: int | None = None
    rim: int | None = None

    @property
    def ends(self) -> tuple[int | None, ...]:
        """The steps whose values the search uses."""
        return self.misfit, self.locus, self.facing, self.reach, self.rim

    @property
    def shares(self) -> tuple[float, float]:
        """The start and the range of its shares: a revolution, a guide, or a path along a track."""
        if self.turns:
            return START, 2 * pi
        return (-FAR, 2 * FAR) if self.rim is None else (-1.0, 2.0)

    def number(self, value: Any) -> Any:
        """The angle of a unit vector in radians; a coordinate unchanged."""
        return phase(value) if self.turns else value

    def value(self, number: Any) -> Any:
        """The unit vector at an angle in radians; a coordinate unchanged."""
        return turn_by(number) if self.turns else number

    def valued(self, share: Any, scale: Any) -> Any:
        """Its trial values from shares: angles, or coordinates in units of their reach.

        A guide is tried to infinity both ways: other links may move the link farther than the bars
        reach.
        """
        return scale * (share if self.turns or self.rim is not None else np.tan(share))


class Trial(Struct, frozen=True, dict=True):
    """The program of a trial: its inputs, its unknowns, the signs of its dyads.

    ``inputs`` are overridden by known values; ``unknowns``, from the outermost group inwards, by
    unit vectors and coordinates; ``signs`` by ±1. ``axes`` are the links' x axes in the order in
    which closures are numbered. ``traced`` are the points whose loci are drawn by hand. Trial
    values are rows of an array, with a column for each unknown: angles, and coordinates in metres.
    """

    program: Program
    values: Values
    inputs: tuple[int, ...]
    unknowns: tuple[Unknown, ...]
    signs: tuple[int, ...]
    axes: tuple[int, ...]
    traced: tuple[int, ...] = ()

    @property
    def first(self) -> Unknown:
        """The unknown of the whole group."""
        return self.unknowns[0]

    @property
    def several(self) -> bool:
        """Whether links of groups within the group are tried with it."""
        return len(self.unknowns) > 1

    def numbers(self, closed: Sequence[Any]) -> list[Any]:
        """The trial values of a closure, as angles and coordinates."""
        return [one.number(each) for one, each in zip(self.unknowns, closed, strict=False)]

    def placed(self, numbers: Iterable[Any]) -> tuple[Any, ...]:
        """Unit vectors and coordinates from angles and coordinates."""
        return tuple(one.value(each) for one, each in zip(self.unknowns, numbers, strict=True))

    # --- runs of the program -------------------------------------------------------------------

    @cached_property
    def results(self) -> tuple[int, ...]:
        """The steps whose values the search uses."""
        each = [(one.misfit, one.locus, one.facing) for one in self.unknowns]
        own = (number for some in each for number in some if number is not None)
        return (*own, *self.traced, *self.axes)

    @cached_property
    def outside(self) -> frozenset[int]:
        """The steps whose values come from outside."""
        return frozenset((*self.inputs, *(one.tried for one in self.unknowns), *self.signs))

    def readied(self, keep: tuple[int, ...]) -> Ready:
        """The part of the program that gives some steps, prepared for arrays of trials."""
        needed = self.program.behind(keep)
        return made_ready(self.program, needed, self.values, keep, self.outside)

    @cached_property
    def ready(self) -> Ready:
        """The program for all results."""
        return self.readied(self.results)

    @cached_property
    def missing(self) -> Ready:
        """The program for the misfits."""
        return self.readied(tuple(one.misfit for one in self.unknowns))

    def run(self, ready: Ready, known: Sequence[Any], tried: Any, signs: Any) -> Mapping[int, Any]:
        """The results of a part of the program for arrays of trial values and of signs."""
        overrides = self.overrides(known, tried, signs)
        with np.errstate(all="ignore"):
            return run_moving(ready, self.values, batch_kind(), overrides=overrides).values

    def found(self, known: Sequence[Any], tried: Any, signs: Any) -> dict[int, Any]:
        """The results for arrays of trial values and of signs, with known values per element."""
        found = self.run(self.ready, known, tried, signs)
        return {n: np.broadcast_to(found[n], len(tried)) for n in self.results}

    def misfits(self, known: Sequence[Any], tried: Any, signs: Any) -> Any:
        """The misfits alone (K, n); NaN where the chain cannot be drawn."""
        found = self.run(self.missing, known, tried, signs)
        each = (np.broadcast_to(found[one.misfit], len(tried)) for one in self.unknowns)
        return np.stack([*each], axis=1)

    @cached_property
    def choices(self) -> tuple[tuple[Ready, Any, tuple[int, ...]] | None, ...]:
        """For each sign: the prepared program of its dyad's arguments, and the dyad's reach."""
        found: list[tuple[Ready, Any, tuple[int, ...]] | None] = []
        for sign in self.signs:
            steps = (each for each in self.program.steps if sign in each.args)
            drawn = ((each.action.reaches, each.args) for each in steps if each.action is not None)
            reaches, args = next((each for each in drawn if each[0] is not None), (None, ()))
            if reaches is None:
                found.append(None)
                continue
            args = tuple(arg for arg in args if arg != sign)
            found.append((self.readied(args), reaches, args))
        return tuple(found)

    def drawable(self, k: int, known: Sequence[Any], tried: Any, signs: Any) -> Any:
        """How far the dyad of a sign is drawable, by the signs before it; positive if it is."""
        choice = self.choices[k]
        assert choice is not None
        ready, reaches, args = choice
        found = self.run(ready, known, tried, signs)
        with np.errstate(all="ignore"):
            return np.broadcast_to(prod(reaches(*(found[arg] for arg in args))), len(tried))

    @cached_property
    def crossings(self) -> tuple[tuple[Ready, tuple[int, ...]], ...]:
        """The pairs of crossing lines in the trial, prepared; where parallel, it has poles."""
        found: list[tuple[Ready, tuple[int, ...]]] = []
        for number in self.program.behind((self.first.misfit,)):
            step = self.program.steps[number]
            if step.action is not None and step.action.value is meet.value:
                found.append((self.readied(step.args), step.args))
        return tuple(found)

    def crossing(self, n: int, known: Sequence[Any], tried: Any, signs: Any) -> Any:
        """The cross product of the directions of two lines: zero where they are parallel."""
        ready, args = self.crossings[n]
        found = self.run(ready, known, tried, signs)
        with np.errstate(all="ignore"):
            first, second = (found[arg] for arg in args)
            return np.broadcast_to(cross(first.along, second.along), len(tried))

    def overrides(self, known: Sequence[Any], tried: Any, signs: Any) -> dict[int, Any]:
        """The program's values from outside; the signs may be only the first few."""
        found = dict(zip(self.inputs, known, strict=True))
        for one, each in zip(self.unknowns, tried.T, strict=True):
            found[one.tried] = one.value(each)
        return found | {self.signs[k]: signs[:, k] for k in range(signs.shape[1])}

    # --- range of the trial --------------------------------------------------------------------

    def scales(self, known: Sequence[Any], size: int) -> Any:
        """The units of each element's trial values, with a column for each unknown.

        For coordinates, the unit is the range (m) that the bars allow.
        """
        each = (1.0 if u.reach is None else self.at_start(known, u.reach) for u in self.unknowns)
        return np.stack([np.broadcast_to(scale, size) for scale in each], axis=1)

    def valued(self, share: Any, scale: Any) -> Any:
        """Trial values from shares, both with a column for each unknown."""
        columns = zip(self.unknowns, share.T, scale.T, strict=True)
        return np.stack([one.valued(*each) for one, *each in columns], axis=1)

    def shares(self, known: Sequence[Any], size: int) -> Any:
        """The shares at which each element is tried: a revolution, or a range to both sides."""
        if self.first.turns:
            return self.grid(known, size)
        if self.first.rim is None:
            row = np.linspace(-FAR, FAR, 3 * SAMPLES + 1)
        else:
            reach = self.scales(known, size)[:, 0]
            turns = abs(reach / self.at_start(known, self.first.rim))
            most = np.max(turns, initial=0.0, where=~np.isnan(turns))
            count = np.clip(A_TURN * most / np.pi, 2 * SAMPLES, MOST // 4)
            row = np.linspace(-1, 1, int(count) + 1)
        return np.broadcast_to(row, (size, len(row)))

    def work(self, known: Sequence[Any]) -> int:
        """A lower bound on the number of steps run in a search for all closures on known values.

        Each sign doubles the windows in which the rest is tried.
        """
        tried = self.shares(known, 1).shape[1]
        return int(tried * (2 ** (len(self.signs) + 1) - 1) * len(self.ready.moving))

    def grid(self, known: Sequence[Any], size: int) -> Any:
        """The trial values of each element: a revolution, or the range to both sides."""
        if self.first.turns:
            round_ = np.linspace(0, 2 * np.pi, SAMPLES + 1) + START
            return np.broadcast_to(round_, (size, SAMPLES + 1))
        return self.scales(known, size) * np.linspace(-1, 1, 2 * SAMPLES + 1)

    def at_start(self, known: Sequence[Any], step: int) -> Any:
        """The value of a step that does not depend on the trial value."""
        overrides = dict(zip(self.inputs, known, strict=True))
        with np.errstate(all="ignore"):
            needed = self.program.behind((step,))
            trace = run_batch(
                self.program, needed, self.values, batch_kind(), (step,), overrides=overrides
            )
        return trace.values[step]


class TrialChain:
    """The trial chain of a group on one scene: its misfits at trial values, in a kind of number."""

    def __init__(self, trial: Trial, known: Sequence[Any], signs: Sequence[float], kind: Kind):
        self.trial, self.kind, self.signs = trial, kind, signs
        self.known = dict(zip(trial.inputs, known, strict=True))
        self.needed: dict[tuple[int, ...], tuple[int, ...]] = {}

    def misfits(self, tried: Sequence[Any], known: Mapping[int, Any] | None = None) -> list[Any]:
        """The misfit of each group; raises ValueError where the chain cannot be drawn."""
        unknowns = self.trial.unknowns
        facing = [one.facing for one in unknowns if one.facing is not None]
        found = self.drawn(tried, (*(one.misfit for one in unknowns), *facing), known)
        if not all(each > 0 for each in found[len(unknowns) :]):
            raise ValueError("the last link does not surely face the right way")
        return found[: len(unknowns)]

    def middles(self, tried: Sequence[Any]) -> list[Any]:
        """The midpoints of the misfits, in balls, for the midpoints of the known values."""
        known = {number: middle(value) for number, value in self.known.items()}
        return [middle(each) for each in self.misfits(tried, known)]

    def drawn(
        self, tried: Sequence[Any], wanted: tuple[int, ...], known: Mapping[int, Any] | None = None
    ) -> list[Any]:
        """The values of some steps at trial values; ValueError where they cannot be drawn."""
        trial = self.trial
        overrides = dict(self.known if known is None else known)
        for one, each in zip(trial.unknowns, tried, strict=True):
            overrides[one.tried] = one.value(each)
        overrides |= dict(zip(trial.signs, self.signs, strict=True))
        if wanted not in self.needed:
            self.needed[wanted] = trial.program.behind(wanted)
        needed = self.needed[wanted]
        try:
            trace = run(trial.program, needed, trial.values, self.kind, overrides=overrides)
        except StepFailed as failed:
            raise ValueError("the chain of the trial cannot be drawn") from failed
        return [trace.values[n] for n in wanted]

    # --- one link tried --------------------------------------------------------------------------

    def misfit(self, tried: Any) -> Any:
        """The misfit of the last link; raises ValueError where the chain cannot be drawn."""
        return self.misfits((tried,))[0]

    def middle_misfit(self, tried: Any) -> Any:
        """The midpoint of the misfit, in balls, for the midpoints of the known values."""
        return self.middles((tried,))[0]

    def axes(self, tried: Any) -> list[Any]:
        """The axes of the links in the order in which closures are numbered."""
        return self.drawn((tried,), self.trial.axes)

    def locus(self, tried: Any) -> Any:
        """The point that moves as the link is tried."""
        return self.drawn((tried,), (self.trial.first.locus,))[0]

    def reach(self, k: int, tried: Any) -> Any:
        """How far the dyad of a sign is drawable: positive where it can be; a midpoint in balls."""
        choice = self.trial.choices[k]
        assert choice is not None
        _, reaches, args = choice
        return middle(prod(reaches(*self.drawn((tried,), args))))

    def with_sign(self, k: int, sign: float) -> TrialChain:
        """The same chain with another sign of a dyad."""
        signs = [*self.signs[:k], sign, *self.signs[k + 1 :]]
        return TrialChain(self.trial, tuple(self.known.values()), signs, self.kind)
