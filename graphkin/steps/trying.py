"""Groups of class III and higher: one link is tried all round, until what was cut fits again.

The only place where values decide how many steps there are: the trial runs a program of its own on
arrays of trial positions, brackets every fit and closes in on it. Its derivatives come from plans.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from graphkin.arithmetic import FLOAT, batch_kind, phase
from graphkin.steps.batch import Ready, made_ready, run_batch, run_moving
from graphkin.steps.program import Program
from graphkin.steps.roots import roots
from graphkin.steps.run import Values
from graphkin.steps.vocabulary import Action

SAMPLES = 360
"""Trial positions of a round."""
MOST = 400_000
"""Trial positions run at once."""
SAME = 1e-7
"""Radians within which two angles count as one when closures are put in order."""


class ClosingError(ValueError):
    """A group that does not close, or not in as many ways as asked."""

    def __init__(self, ways: int, asked: int) -> None:
        self.ways, self.asked = ways, asked
        super().__init__(f"closes in {ways} ways, closure {asked} is asked")


@dataclass(frozen=True)
class Trying:
    """The program of a trial: its inputs, the tried value, the signs of its dyads, the misfit.

    ``inputs`` are overridden by what is known, ``tried`` by a unit vector (``turns``) or a
    coordinate in metres, ``signs`` by ±1; ``axes`` are the links' x axes in the order in which
    closures are numbered; ``locus`` is the point that moves when the tried value does, to tell the
    angle of crossing, and ``facing`` must be positive at a true fit.
    """

    program: Program
    values: Values
    inputs: tuple[int, ...]
    tried: int
    turns: bool
    signs: tuple[int, ...]
    misfit: int
    locus: int
    facing: int | None
    axes: tuple[int, ...]
    reach: int | None
    """The step that holds how far a coordinate may have to be tried, in metres."""
    traced: int | None = None
    """The step that holds the point whose locus a hand draws."""

    def action(self, number: int) -> Action:
        """The step that closes the group in the closure of a number, counted from one."""
        return Action("close", Closer(self, number))

    # --- running the trial -----------------------------------------------------------------------

    @cached_property
    def results(self) -> tuple[int, ...]:
        """The steps whose values are looked at."""
        others = [step for step in (self.facing, self.traced) if step is not None]
        return (self.misfit, self.locus, *others, *self.axes)

    @cached_property
    def ready(self) -> Ready:
        """The program made ready for arrays of trials."""
        outside = frozenset((*self.inputs, self.tried, *self.signs))
        needed = needed_of(self.program, self.results)
        return made_ready(self.program, needed, self.values, self.results, outside)

    def found(self, known: Sequence[Any], tried: Any, signs: Any) -> dict[int, Any]:
        """The results for arrays of trial values and of signs, known values given per element."""
        import numpy as np

        overrides = dict(zip(self.inputs, known, strict=True))
        overrides[self.tried] = np.exp(1j * tried) if self.turns else tried
        overrides |= {step: signs[:, k] for k, step in enumerate(self.signs)}
        with np.errstate(all="ignore"):
            trace = run_moving(self.ready, self.values, batch_kind(), overrides=overrides)
        return {n: np.broadcast_to(trace.values[n], len(tried)) for n in self.results}

    def misfits(self, known: Sequence[Any], tried: Any, signs: Any) -> Any:
        """The misfit alone; NaN where the chain cannot be drawn."""
        return self.found(known, tried, signs)[self.misfit]

    # --- closing ---------------------------------------------------------------------------------

    def closed(self, known: Sequence[Any], number: int) -> tuple[Any, ...]:
        """Trial value, signs and the sine of crossing in one closure: scalars or arrays.

        A scalar without that closure raises ClosingError, an element of an array gives NaN.
        """
        import numpy as np

        single = not any(hasattr(value, "shape") for value in known)
        arrays = [np.atleast_1d(value) for value in known]
        size = max((len(array) for array in arrays), default=1)
        arrays = [np.broadcast_to(array, size) for array in arrays]
        chunk = max(1, MOST // (SAMPLES * 2 ** len(self.signs)))
        parts = [
            self.closures([array[start : start + chunk] for array in arrays])
            for start in range(0, size, chunk)
        ]
        rows = [row for part in parts for row in part.picked(number)]
        if single:
            if np.isnan(rows[0][1]):
                raise ClosingError(parts[0].ways(), number)
            return self.polished(known, rows[0])
        table = np.array(rows)
        tried = np.exp(1j * table[:, 1]) if self.turns else table[:, 1]
        return (tried, *table[:, 2:].T)

    def polished(self, known: Sequence[Any], row: Sequence[float]) -> tuple[Any, ...]:
        """A closure in floats, with a last step along the secant."""
        tried, signs, sine = float(row[1]), [float(sign) for sign in row[2:-1]], float(row[-1])
        value: Any = complex(FLOAT.radians(tried)) if self.turns else tried
        return (value, *signs, sine)

    def closures(self, known: Sequence[Any]) -> Closures:
        """Every closure of every element of known values, in the order of their numbers."""
        import numpy as np

        size = len(known[0]) if known else 1
        found = []
        for signs in sign_table(len(self.signs)):
            found.append(self.roots(known, size, np.array(signs, dtype=float)))
        owner, tried, chosen = (np.concatenate(column) for column in zip(*found, strict=True))
        return self.ordered(known, size, owner, tried, chosen)

    def roots(self, known: Sequence[Any], size: int, signs: Any) -> tuple[Any, Any, Any]:
        """Every fit for one set of signs: the element that it belongs to, its trial value."""
        import numpy as np

        def misfit(owner: Any, tried: Any) -> Any:
            here = [array[owner] for array in known]
            return self.misfits(here, tried, np.broadcast_to(signs, (owner.size, len(signs))))

        owner, tried = roots(misfit, self.grid(known, size))
        return owner, tried, np.broadcast_to(signs, (owner.size, len(signs)))

    def grid(self, known: Sequence[Any], size: int) -> Any:
        """The trial values of each element: a round, or as far to both sides as can be needed."""
        import numpy as np

        if self.turns:
            round_ = np.linspace(0, 2 * np.pi, SAMPLES + 1) + 0.123e-3
            return np.broadcast_to(round_, (size, SAMPLES + 1))
        assert self.reach is not None
        overrides = dict(zip(self.inputs, known, strict=True))
        keep = (self.reach,)
        with np.errstate(all="ignore"):
            trace = run_batch(
                self.program,
                needed_of(self.program, keep),
                self.values,
                batch_kind(),
                keep,
                overrides=overrides,
            )
        reach = np.broadcast_to(trace.values[self.reach], size)
        return reach[:, None] * np.linspace(-1, 1, 2 * SAMPLES + 1)

    def ordered(
        self, known: Sequence[Any], size: int, owner: Any, tried: Any, signs: Any
    ) -> Closures:
        """The closures in the order of their numbers: by the angles of the group's links."""
        import numpy as np

        here = [array[owner] for array in known]
        found = self.found(here, tried, signs)
        good = np.isfinite(found[self.misfit])
        if self.facing is not None:
            good &= found[self.facing] > 0
        angles = [np.mod(phase(found[n]) + SAME, 2 * np.pi) // (2 * SAME) for n in self.axes]
        sine = self.sines(here, tried, signs)
        order = np.lexsort((*angles[::-1], owner))
        order = order[good[order]]
        keep = np.ones(order.size, dtype=bool)
        keys = np.array([owner, *angles])[:, order]
        keep[1:] = (abs(np.diff(keys, axis=1)) > 1.5).any(axis=0) | (np.diff(keys[0]) != 0)
        order = order[keep]
        table = np.column_stack([owner, tried, signs, sine])[order]
        return Closures(size, table)

    def sines(self, known: Sequence[Any], tried: Any, signs: Any) -> Any:
        """Sine of the angle at which the locus crosses what was cut, by a small step each way."""
        import numpy as np

        step = 1e-6 * (1 if self.turns else np.maximum(abs(tried), 1e-3))
        ends = [self.found(known, tried + way * step, signs) for way in (-1, 1)]
        across = ends[1][self.misfit] - ends[0][self.misfit]
        way = abs(ends[1][self.locus] - ends[0][self.locus])
        with np.errstate(all="ignore"):
            sine = np.minimum(abs(across) / way, 1.0)
        return np.where(np.isfinite(sine), sine, 0.0)


@dataclass(frozen=True, slots=True)
class Closer:
    """What closes a group in the closure of a number, counted from one."""

    trying: Trying
    number: int

    def __call__(self, *known: Any) -> tuple[Any, ...]:
        """Trial value, signs and the sine of crossing."""
        return self.trying.closed(known, self.number)

    def locus(self, known: Sequence[Any], signs: Sequence[float]) -> Any:
        """Where the traced point goes while the link is tried, (N,); NaN where it breaks off.

        None where no point shows the fit.
        """
        import numpy as np

        trying = self.trying
        if trying.traced is None:
            return None
        arrays = [np.atleast_1d(value) for value in known]
        tried = trying.grid(arrays, 1)[0]
        here = [np.broadcast_to(array, tried.shape) for array in arrays]
        rows = np.broadcast_to(np.asarray(signs, dtype=float), (tried.size, len(trying.signs)))
        return trying.found(here, tried, rows)[trying.traced]

    def ways(self, known: Sequence[Any]) -> int:
        """In how many ways the group closes on known values."""
        import numpy as np

        return self.trying.closures([np.atleast_1d(value) for value in known]).ways()


@dataclass(frozen=True, slots=True)
class Closures:
    """All closures of some elements: rows of element, trial value, signs and sine of crossing."""

    size: int
    table: Any

    def ways(self) -> int:
        """In how many ways the first element closes."""
        return int((self.table[:, 0] == 0).sum())

    def picked(self, number: int) -> list[Any]:
        """The row of each element's closure of a number; NaN where it has none."""
        import numpy as np

        rows = np.full((self.size, self.table.shape[1]), np.nan)
        owners = self.table[:, 0].astype(int)
        first = np.searchsorted(owners, np.arange(self.size))
        count = np.bincount(owners, minlength=self.size)
        there = count >= number
        rows[there] = self.table[first[there] + number - 1]
        return list(rows)


def needed_of(program: Program, steps: Sequence[int]) -> tuple[int, ...]:
    """The steps that some steps need."""
    return Program(program.steps, {("step", str(n)): n for n in steps}).needed(
        [("step", str(n)) for n in steps]
    )


def sign_table(count: int) -> list[tuple[int, ...]]:
    """Every set of so many signs."""
    rows: list[tuple[int, ...]] = [()]
    for _ in range(count):
        rows = [(*row, sign) for row in rows for sign in (1, -1)]
    return rows
