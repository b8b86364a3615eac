"""Groups of class III and higher: one link is tried all round, until what was cut fits again.

The only place where values decide how many steps there are: the trial runs a program of its own on
arrays of trial positions, brackets every fit and closes in on it. Its derivatives come from plans.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.program import CLOSE, Program, Step
from graphkin.construction.core.run import StepFailed, Trace, run
from graphkin.construction.core.vocabulary import Action
from graphkin.construction.higher_class.trial import MOST, Trial
from graphkin.numbers.arithmetic import FLOAT, np, phase
from graphkin.numbers.common_roots import roots_beside, solutions
from graphkin.numbers.kinds import ball_kind, in_doubles, kind_of
from graphkin.numbers.roots import (
    Windows,
    fits_beside,
    narrowed,
    roots_and_touches,
    roots_beside_poles,
)
from graphkin.scene.model import Scene

DOUBLES = ("float", "batch")
"""The kinds in which closures are looked for; in the others they are refined."""
KEPT = 16
"""Closures of a group that are kept."""
SAME = 1e-7
"""Radians within which two angles count as one when closures are put in order."""
STEP = 1e-6
"""Half the step of the differences that give slopes, in radians or in parts of a trial value."""

HIDDEN = 1e-6
"""Sine of crossing below which what doubles take for one closure may be two, or none."""


BITS = (128, 256, 512, 1024)
"""Bits of the balls that are asked one after the other."""


class ClosingError(ValueError):
    """A group that does not close, or not in as many ways as asked."""

    def __init__(self, ways: int, asked: int) -> None:
        self.ways, self.asked = ways, asked
        super().__init__(f"closes in {ways} ways, closure {asked} is asked")


class MergingError(ValueError):
    """A closure whose number rounding leaves open: before it, or with it, two closures merge."""

    def __init__(self, first: int, asked: int) -> None:
        self.first, self.asked = first, asked
        super().__init__(f"closures {first} and {first + 1} merge, closure {asked} is asked")


class Trying(Trial, frozen=True, dict=True):
    """A trial, and where it fits."""

    def action(self, number: int) -> Action:
        """The step that closes the group in the closure of a number, counted from one."""
        return Action(CLOSE, ClosureSolver(self, number))

    @cached_property
    def kept(self) -> dict[tuple[Any, ...], Closures]:
        """The closures that were found last, by what was known."""
        return {}

    @cached_property
    def settled(self) -> dict[tuple[Any, ...], list[tuple[Any, ...]] | None]:
        """What closes in every closure in order, by what was known, where rounding leaves that open
        and balls were asked; None where they leave it open too."""
        return {}

    def chosen(self, closings: Sequence[Any], number: int) -> Any:
        """The closure of a number of all closures. Raises ClosingError where there is none."""
        if number > len(closings):
            raise ClosingError(len(closings), number)
        return closings[number - 1]

    def closed(self, known: Sequence[Any], number: int) -> tuple[Any, ...]:
        """Trial value, signs and the sine of crossing in one closure: scalars or arrays.

        A scalar without that closure raises ClosingError, and MergingError where rounding leaves
        open which closure has the number; an element of an array gives NaN.
        """
        if not any(hasattr(value, "shape") for value in known):
            closures = self.closures_of(known)
            row = closures.sure(number)[0]
            if np.isnan(row[1]):
                raise closures.merging_at(number) or ClosingError(closures.ways(), number)
            return self.polished(row)
        arrays = [np.atleast_1d(value) for value in known]
        size = max((len(array) for array in arrays), default=1)
        arrays = [np.broadcast_to(array, size) for array in arrays]
        return self.parts(np.array(self.every(arrays, size).sure(number)))

    def every(self, known: Sequence[Any], size: int) -> Closures:
        """Every closure of any number of elements, a part of them at a time."""
        chunk = self.together(known, size)
        parts = [
            self.closures([array[start : start + chunk] for array in known])
            for start in range(0, size, chunk)
        ]
        return joined(parts)

    def together(self, known: Sequence[Any], size: int) -> int:
        """How many elements are closed at once."""
        return max(1, MOST // int(self.shares(known, size).shape[1] * 2 ** len(self.signs)))

    def parts(self, table: Any) -> tuple[Any, ...]:
        """Trial values, signs and sines of rows: element, trial values, signs, sine."""
        count = 1 + len(self.unknowns)
        return (*self.placed(table[:, 1:count].T), *table[:, count:].T)

    def split(self, rows: Any) -> tuple[Any, Any, Any]:
        """What is tried (…, n), signs (…, k) and sines of crossing (…) of closures in rows."""
        size = len(self.unknowns)
        return rows[..., :size], rows[..., size:-1], rows[..., -1]

    def closed_beside(self, known: Sequence[Any], tried: Any, signs: Any) -> Any:
        """Trial values at which all closes beside some (K, n), by Newton's method.

        NaN where it does not come to rest.
        """

        def missed(row: Any, share: Any) -> Any:
            return self.misfits([array[row] for array in known], share, signs[row])

        return roots_beside(missed, tried)

    def closures_of(self, known: Sequence[Any]) -> Closures:
        """Every closure on known scalars, in the order of their numbers; the last ones are kept.

        The traces of a sheet, and those by which its scale is chosen, ask the same many times.
        """
        asked = tuple(known)
        if asked not in self.kept:
            found = self.closures([np.atleast_1d(value) for value in known])
            if len(self.kept) >= KEPT:
                self.kept.clear()
            self.kept[asked] = found
        return self.kept[asked]

    def polished(self, row: Sequence[float]) -> tuple[Any, ...]:
        """A closure in floats: trial values, signs and the sine of crossing."""
        count = 1 + len(self.unknowns)
        return (*self.placed(map(float, row[1:count])), *map(float, row[count:]))

    def loci(self, known: Sequence[Any], value: Sequence[Any]) -> list[Any]:
        """Where the traced points go all round, with the signs of a closure: (N,) each."""
        arrays = [np.atleast_1d(each) for each in known]
        tried = self.grid(arrays, 1)[0]
        here = [np.broadcast_to(array, tried.shape) for array in arrays]
        signs = np.asarray(value[1:-1], dtype=float)
        rows = np.broadcast_to(signs, (tried.size, len(self.signs)))
        found = self.found(here, tried[:, None], rows)
        return [found[number] for number in self.traced]

    def closures(self, known: Sequence[Any]) -> Closures:
        """Every closure of every element of known values, in the order of their numbers."""
        size = len(known[0]) if known else 1
        windows = Windows(np.arange(size), self.shares(known, size))
        found = zip(*self.fits(known, self.scales(known, size), (), windows), strict=True)
        return self.ordered(known, size, *(np.concatenate(column) for column in found))

    def fits(
        self,
        known: Sequence[Any],
        scales: Any,
        signs: tuple[int, ...],
        windows: Windows,
    ) -> Iterator[tuple[Any, Any, Any, Any]]:
        """Every fit for sets of signs that begin so: its element, its trial value (K, 1), its
        signs, and whether it only may be one, as the misfit comes near zero without crossing it.

        ``windows`` are where the dyads of the signs that are set can be drawn.
        """

        def trial(owner: Any, share: Any, rows: Any) -> tuple[list[Any], Any, Any]:
            tried = self.valued(share[:, None], scales[owner])
            return [array[owner] for array in known], tried, rows

        def alike(owner: Any) -> Any:
            return np.broadcast_to(np.array(signs, dtype=float), (owner.size, len(signs)))

        k = len(signs)
        if k == len(self.signs):
            owner, places = windows

            def missing(row: Any, at: Any) -> Any:
                return self.misfits(*trial(owner[row], at, alike(row)))[:, 0]

            found = [roots_and_touches(missing, places)]
            for n in range(len(self.crossings)):

                def parallel(row: Any, at: Any, n: int = n) -> Any:
                    return self.crossing(n, *trial(owner[row], at, alike(row)))

                row, share = roots_beside_poles(missing, parallel, places)
                found.append((row, share, np.zeros(row.size, dtype=bool)))
            for row, share, touching in found:
                _, tried, rows = trial(owner[row], share, alike(row))
                yield owner[row], tried, rows, touching
            return
        if self.choices[k] is not None:
            windows, ends = narrowed(
                lambda owner, at: self.drawable(k, *trial(owner, at, alike(owner))), windows
            )
            later = np.array(sign_table(len(self.signs) - k - 1), dtype=float)
            owner, at, beside = (np.repeat(column, len(later)) for column in ends)
            later = np.tile(later, (len(ends.owner), 1))

            def missed(row: Any, share: Any, sign: Any) -> Any:
                rows = np.column_stack([alike(row), sign, later[row]])
                return self.misfits(*trial(owner[row], share, rows))[:, 0]

            row, share, sign, touching = fits_beside(missed, at, beside)
            rows = np.column_stack([alike(row), sign, later[row]])
            yield owner[row], trial(owner[row], share, rows)[1], rows, touching
        for sign in (1, -1):
            yield from self.fits(known, scales, (*signs, sign), windows)

    def ordered(
        self, known: Sequence[Any], size: int, owner: Any, tried: Any, signs: Any, touching: Any
    ) -> Closures:
        """The closures in the order of their numbers: by the angles of the group's links."""
        here = [array[owner] for array in known]
        found = self.found(here, tried, signs)
        good = np.ones(len(owner), dtype=bool)
        for one in self.unknowns:
            good &= np.isfinite(found[one.misfit])
            good &= one.facing is None or found[one.facing] > 0
        angles = [np.mod(phase(found[n]) + SAME, 2 * np.pi) // (2 * SAME) for n in self.axes]
        sine = self.sines(here, tried, signs)
        order = np.lexsort((*angles[::-1], owner))
        order = order[good[order]]
        keep = np.ones(order.size, dtype=bool)
        keys = np.array([owner, *angles])[:, order]
        keep[1:] = (abs(np.diff(keys, axis=1)) > 1.5).any(axis=0) | (np.diff(keys[0]) != 0)
        order = order[keep]
        table = np.column_stack([owner, tried, signs, sine])[order]
        return Closures(size, table[~touching[order]], table, touching[order])

    def sines(self, known: Sequence[Any], tried: Any, signs: Any) -> Any:
        """The least sine of the angles at which a locus crosses what was cut, those within closed,
        by a small step each way.

        Where a step leads beyond what can be drawn it is not taken.
        """
        turning = [one.turns for one in self.unknowns]
        step = STEP * np.where(turning, 1.0, np.maximum(abs(tried), 1e-3))
        size, here = len(self.unknowns), self.found(known, tried, signs)
        misfits = np.empty((len(tried), size, size))
        ways = np.empty(misfits.shape, complex)
        for k in range(size):
            away = np.where(np.arange(size) == k, step, 0.0)
            ends = [self.found(known, tried + way * away, signs) for way in (-1, 1)]
            for i, one in enumerate(self.unknowns):
                for end in ends:
                    drawn = np.isfinite(end[one.misfit]) & np.isfinite(end[one.locus])
                    end |= {n: np.where(drawn, end[n], here[n]) for n in (one.misfit, one.locus)}
                misfits[:, i, k] = ends[1][one.misfit] - ends[0][one.misfit]
                ways[:, i, k] = ends[1][one.locus] - ends[0][one.locus]
        return crossing_sines(misfits, ways)


def crossing_sines(misfits: Any, ways: Any) -> Any:
    """The least sine of the crossings of each row, from differences (K, n, n) of misfits and loci.

    An unknown moves while those within close; differences without a value count as a sine of zero.
    """
    count, size, _ = misfits.shape
    least = np.ones(count)
    with np.errstate(all="ignore"):
        for k in range(size):
            way = np.zeros((count, size))
            way[:, k] = 1
            if k + 1 < size:
                inner = misfits[:, k + 1 :, k + 1 :]
                way[:, k + 1 :] = solutions(inner, -misfits[:, k + 1 :, k])
            across = abs((misfits[:, k] * way).sum(axis=1))
            sine = np.minimum(across / abs((ways[:, k] * way).sum(axis=1)), 1.0)
            least = np.minimum(least, np.where(np.isfinite(sine), sine, 0.0))
    return least


def closer_of(step: Step) -> ClosureSolver | None:
    """What closes a group of higher class in a step; None for a step that closes none."""
    value = step.action.value if step.action is not None else None
    return value if isinstance(value, ClosureSolver) else None


def closing(step: Step) -> ClosureSolver:
    """What closes the group of a step that closes one."""
    closer = closer_of(step)
    assert closer is not None
    return closer


class ClosureSolver(Struct, frozen=True):
    """What closes a group in the closure of a number, counted from one."""

    trying: Trying
    number: int

    def __call__(self, *known: Any) -> tuple[Any, ...]:
        """Trial value, signs and the sine of crossing; as balls have settled them, if asked."""
        if all(isinstance(value, float | complex) for value in known):
            closings = self.trying.settled.get(known)
            if closings is not None:
                return self.trying.chosen(closings, self.number)  # type: ignore[no-any-return]
            return self.trying.closed(known, self.number)
        kind = kind_of(*known)
        if kind.name in DOUBLES:
            return self.trying.closed(known, self.number)
        from graphkin.construction.higher_class.refining import closed_in

        return closed_in(self.trying, known, self.number, kind)

    def loci(self, known: Sequence[Any], value: Sequence[Any]) -> list[Any]:
        """Where the traced points go while the link is tried, (N,) each; NaN where one breaks off.

        None where no point shows the fit. ``value`` is the closure beside which they are drawn.
        """
        return self.trying.loci(known, value) if self.trying.traced else []

    def ways(self, known: Sequence[Any]) -> int:
        """In how many ways the group closes on known values."""
        return self.trying.closures_of(known).ways()


class Closures(Struct, frozen=True):
    """All closures of some elements: rows of element, trial value, signs and sine of crossing.

    ``whole`` has the rows of what may be closures too (``touching``): the misfit comes there so
    near zero that rounding hides whether it crosses it. ``complete`` tells that there are proved
    to be no others; a search on a grid proves nothing.
    """

    size: int
    table: Any
    whole: Any
    touching: Any
    complete: bool = False

    def of(self, owner: int) -> Any:
        """The closures of one element in rows: trial values, signs, sine of crossing."""
        return self.table[self.table[:, 0] == owner, 1:]

    @property
    def merging(self) -> Any:
        """Which rows of the whole may be two closures or none: rounding does not tell."""
        return self.touching | (self.whole[:, -1] < HIDDEN)

    def ways(self) -> int:
        """In how many ways the first element closes."""
        return int((self.table[:, 0] == 0).sum())

    def picked(self, number: int) -> list[Any]:
        """The row of each element's closure of a number; NaN where it has none."""
        rows = np.full((self.size, self.table.shape[1]), np.nan)
        owners = self.table[:, 0].astype(int)
        first = np.searchsorted(owners, np.arange(self.size))
        count = np.bincount(owners, minlength=self.size)
        there = count >= number
        rows[there] = self.table[first[there] + number - 1]
        return list(rows)

    def sure(self, number: int) -> list[Any]:
        """As picked; NaN where rounding leaves open which closure has that number."""
        rows = self.picked(number)
        merging = self.merging
        for owner in dict.fromkeys(self.whole[merging, 0].astype(int).tolist()):
            if number > self.before(owner):
                rows[owner] = rows[owner] * float("nan")
        return rows

    def before(self, owner: int) -> int:
        """How many closures of an element come before the first that rounding leaves open."""
        mine = self.merging[self.whole[:, 0] == owner]
        return int(mine.argmax()) if mine.any() else len(mine)

    def merging_at(self, number: int) -> MergingError | None:
        """What to raise where it is open which closure of the first element has a number."""
        before = self.before(0)
        if before < number and self.merging[self.whole[:, 0] == 0].any():
            return MergingError(before + 1, number)
        return None


def joined(parts: Sequence[Closures]) -> Closures:
    """The closures of some elements after those of others."""
    if len(parts) == 1:
        return parts[0]
    before = np.cumsum([0, *(part.size for part in parts)])
    for start, part in zip(before, parts, strict=False):
        part.table[:, 0] += start
        part.whole[:, 0] += start
    table, whole, touching = (
        np.concatenate(column)
        for column in zip(*((p.table, p.whole, p.touching) for p in parts), strict=True)
    )
    return Closures(int(before[-1]), table, whole, touching, all(p.complete for p in parts))


def sign_table(count: int) -> list[tuple[int, ...]]:
    """Every set of so many signs."""
    rows: list[tuple[int, ...]] = [()]
    for _ in range(count):
        rows = [(*row, sign) for row in rows for sign in (1, -1)]
    return rows


# --- where rounding leaves open how many closures there are, balls decide ------------------------


def run_settled(
    scene: Scene,
    program: Program,
    needed: Sequence[int],
    *,
    overrides: Mapping[int, Any] | None = None,
    begun: Trace | None = None,
) -> Trace:
    """As run, in doubles. Raises StepFailed, of MergingError where balls do not decide either."""
    while True:
        try:
            return run(program, needed, scene.values, FLOAT, overrides=overrides, begun=begun)
        except StepFailed as failed:
            if not isinstance(failed.__cause__, MergingError):
                raise
            if not newly_settled(scene, program, failed):
                raise


def ways(scene: Scene, program: Program, number: int, known: Sequence[Any]) -> int:
    """In how many ways a step closes its group on known floats; how many of them are sure to come
    before two that merge, where balls do not decide whether these have."""
    step = program.steps[number]
    trying = closing(step).trying
    closures = trying.closures_of(known)
    sure = closures.before(0)
    if closures.merging_at(sure + 1) is None:
        return sure
    settle(scene, program, step, tuple(known))
    found = trying.settled[tuple(known)]
    return sure if found is None else len(found)


def newly_settled(scene: Scene, program: Program, failed: StepFailed) -> bool:
    """Whether balls now tell the closures of a group and were not asked before."""
    known, settled = failed.args_found, closing(failed.step).trying.settled
    if known in settled:
        return False
    settle(scene, program, failed.step, known)
    return settled[known] is not None


def settle(scene: Scene, program: Program, step: Step, known: tuple[Any, ...]) -> None:
    """Let the trial of a step keep what balls tell of its closures on known floats."""
    from graphkin.construction.higher_class.refining import merged

    trying = closing(step).trying
    closures, found = trying.closures_of(known), None
    before = replace(program, targets={("", str(n)): n for n in step.args})
    needed = before.needed(before.targets)
    for bits in () if trying.several else BITS:
        kind = ball_kind(bits)
        with kind.working():
            try:
                values = run(before, needed, scene.values_in(kind), kind).values
                found = merged(trying, [values[n] for n in step.args], closures, kind)
                break
            except (StepFailed, ValueError):
                continue
    trying.settled[known] = (
        None
        if found is None
        else [
            trying.polished((0, in_doubles(one.tried), *one.signs, in_doubles(one.sine)))
            for one in found
        ]
    )
