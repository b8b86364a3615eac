"""Closures of groups of class III and higher: one link is tried over its range until the cut fits.

Only here do values decide the number of steps. The trial runs its own program on arrays of trial
positions, brackets every fit and refines it. Its derivatives come from the plans.
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
"""The kinds of number in which closures are searched for; in the others they are refined."""
KEPT = 16
"""Number of solved sets of known values that a trial keeps."""
SAME = 1e-7
"""Radians within which two angles count as equal when closures are sorted."""
STEP = 1e-6
"""Half the difference step for slopes, in radians or as a fraction of the trial value."""

HIDDEN = 1e-6
"""Sine of crossing below which one closure in doubles may be two closures or none."""


BITS = (128, 256, 512, 1024)
"""Precisions of the balls, in bits, tried in this order."""


class ClosingError(ValueError):
    """A group that does not close, or that has fewer closures than the number asked for."""

    def __init__(self, ways: int, asked: int) -> None:
        self.ways, self.asked = ways, asked
        super().__init__(f"closes in {ways} ways, closure {asked} is asked")


class MergingError(ValueError):
    """A closure of uncertain number: two closures merge at it or before it, up to rounding."""

    def __init__(self, first: int, asked: int) -> None:
        self.first, self.asked = first, asked
        super().__init__(f"closures {first} and {first + 1} merge, closure {asked} is asked")


class Trying(Trial, frozen=True, dict=True):
    """A trial with the search for its closures."""

    def action(self, number: int) -> Action:
        """The step that closes the group in the closure with a given number, counted from one."""
        return Action(CLOSE, ClosureSolver(self, number))

    @cached_property
    def kept(self) -> dict[tuple[Any, ...], Closures]:
        """The closures found last, by the known values."""
        return {}

    @cached_property
    def settled(self) -> dict[tuple[Any, ...], list[tuple[Any, ...]] | None]:
        """The values of every closure, in order, where balls had to decide; by known values.

        Balls decide where rounding in doubles leaves the closures open. None marks known values for
        which balls do not decide either.
        """
        return {}

    def chosen(self, closings: Sequence[Any], number: int) -> Any:
        """The closure with a given number. Raises ClosingError where there is none."""
        if number > len(closings):
            raise ClosingError(len(closings), number)
        return closings[number - 1]

    def closed(self, known: Sequence[Any], number: int) -> tuple[Any, ...]:
        """Trial value, signs and sine of crossing in one closure: scalars or arrays.

        For scalars, raises ClosingError where that closure does not exist, and MergingError where
        rounding leaves its number open. For arrays, the element is NaN in both cases.
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
        """Every closure of any number of elements, computed in chunks."""
        chunk = self.together(known, size)
        parts = [
            self.closures([array[start : start + chunk] for array in known])
            for start in range(0, size, chunk)
        ]
        return joined(parts)

    def together(self, known: Sequence[Any], size: int) -> int:
        """The number of elements that are closed at once."""
        return max(1, MOST // int(self.shares(known, size).shape[1] * 2 ** len(self.signs)))

    def parts(self, table: Any) -> tuple[Any, ...]:
        """Trial values, signs and sines from rows of element, trial values, signs, sine."""
        count = 1 + len(self.unknowns)
        return (*self.placed(table[:, 1:count].T), *table[:, count:].T)

    def split(self, rows: Any) -> tuple[Any, Any, Any]:
        """The trial values (…, n), signs (…, k) and sines of crossing (…) of closures in rows."""
        size = len(self.unknowns)
        return rows[..., :size], rows[..., size:-1], rows[..., -1]

    def closed_beside(self, known: Sequence[Any], tried: Any, signs: Any) -> Any:
        """Trial values (K, n) of closures near given ones, by Newton's method.

        NaN where the method does not converge.
        """

        def missed(row: Any, share: Any) -> Any:
            return self.misfits([array[row] for array in known], share, signs[row])

        return roots_beside(missed, tried)

    def closures_of(self, known: Sequence[Any]) -> Closures:
        """Every closure on known scalars, in the order of their numbers; the last results are kept.

        The traces of a sheet, and those that choose its scale, ask for the same values many times.
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
        """The loci of the traced points over the trial, with a closure's signs: (N,) each."""
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
        once = [array[:1] if (array == array[0]).all() else array for array in known]
        found = zip(*self.fits(once, self.scales(known, size), (), windows), strict=True)
        return self.ordered(known, size, *(np.concatenate(column) for column in found))

    def fits(
        self, known: Sequence[Any], scales: Any, signs: tuple[int, ...], windows: Windows
    ) -> Iterator[tuple[Any, Any, Any, Any]]:
        """Every fit for sets of signs that begin with ``signs``.

        Yields elements, trial values (K, 1), signs, and a mask. The mask marks touches, where the
        misfit comes close to zero without changing sign. ``windows`` are the ranges in which the
        dyads of the given signs can be drawn. A known value that all elements share is one.
        """

        def trial(owner: Any, share: Any, rows: Any) -> tuple[list[Any], Any, Any]:
            tried = self.valued(share[:, None], scales[owner])
            here = [
                np.broadcast_to(array, owner.size) if len(array) == 1 else array[owner]
                for array in known
            ]
            return here, tried, rows

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
        """The least sine of the angles at which a locus crosses what was cut.

        Differences over a small step each way are used, with the groups within closed. A step out
        of the drawable range is not taken.
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

    Each unknown moves while the groups within stay closed. A difference without a value counts as a
    sine of zero.
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
    """The solver of a step that closes a group of higher class; None for other steps."""
    value = step.action.value if step.action is not None else None
    return value if isinstance(value, ClosureSolver) else None


def closing(step: Step) -> ClosureSolver:
    """The solver of a step that closes a group."""
    closer = closer_of(step)
    assert closer is not None
    return closer


class ClosureSolver(Struct, frozen=True):
    """The solver of a group in the closure with a given number, counted from one."""

    trying: Trying
    number: int

    def __call__(self, *known: Any) -> tuple[Any, ...]:
        """Trial value, signs and sine of crossing; as settled by balls, where balls were used."""
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
        """The loci of the traced points during the trial, (N,) each; NaN where a locus breaks off.

        Empty where no point shows the fit. ``value`` is the closure at which the loci are drawn.
        """
        return self.trying.loci(known, value) if self.trying.traced else []

    def ways(self, known: Sequence[Any]) -> int:
        """The number of ways in which the group closes on known values."""
        return self.trying.closures_of(known).ways()


class Closures(Struct, frozen=True):
    """All closures of some elements: rows of element, trial value, signs and sine of crossing.

    ``whole`` also has the rows that may be closures (``touching``): there the misfit comes so close
    to zero that rounding hides whether it changes sign. ``complete`` means that a proof excludes
    other closures; a search on a grid proves nothing.
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
        """A mask of the rows of ``whole`` that may be two closures or none, up to rounding."""
        return self.touching | (self.whole[:, -1] < HIDDEN)

    def ways(self) -> int:
        """The number of ways in which the first element closes."""
        return int((self.table[:, 0] == 0).sum())

    def picked(self, number: int) -> list[Any]:
        """The row of each element's closure with a given number; NaN where it has none."""
        rows = np.full((self.size, self.table.shape[1]), np.nan)
        owners = self.table[:, 0].astype(int)
        first = np.searchsorted(owners, np.arange(self.size))
        count = np.bincount(owners, minlength=self.size)
        there = count >= number
        rows[there] = self.table[first[there] + number - 1]
        return list(rows)

    def sure(self, number: int) -> list[Any]:
        """As ``picked``, with NaN where rounding leaves open which closure has that number."""
        rows = self.picked(number)
        merging = self.merging
        for owner in dict.fromkeys(self.whole[merging, 0].astype(int).tolist()):
            if number > self.before(owner):
                rows[owner] = rows[owner] * float("nan")
        return rows

    def before(self, owner: int) -> int:
        """The number of closures of an element before the first that rounding leaves open."""
        mine = self.merging[self.whole[:, 0] == owner]
        return int(mine.argmax()) if mine.any() else len(mine)

    def merging_at(self, number: int) -> MergingError | None:
        """The error for a closure number that rounding leaves open; None if certain.

        It concerns the first element.
        """
        before = self.before(0)
        if before < number and self.merging[self.whole[:, 0] == 0].any():
            return MergingError(before + 1, number)
        return None


def joined(parts: Sequence[Closures]) -> Closures:
    """The closures of several parts, with the elements renumbered in sequence."""
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
    """Every combination of ``count`` signs."""
    rows: list[tuple[int, ...]] = [()]
    for _ in range(count):
        rows = [(*row, sign) for row in rows for sign in (1, -1)]
    return rows


# --- balls decide where rounding leaves the number of closures open ------------------------------


def run_settled(
    scene: Scene,
    program: Program,
    needed: Sequence[int],
    *,
    overrides: Mapping[int, Any] | None = None,
    begun: Trace | None = None,
) -> Trace:
    """Run the program in doubles, as ``run`` does.

    Raises StepFailed, caused by MergingError where balls do not decide either.
    """
    while True:
        try:
            return run(program, needed, scene.values, FLOAT, overrides=overrides, begun=begun)
        except StepFailed as failed:
            if not isinstance(failed.__cause__, MergingError):
                raise
            if not newly_settled(scene, program, failed):
                raise


def ways(scene: Scene, program: Program, number: int, known: Sequence[Any]) -> int:
    """The number of ways in which a step closes its group on known floats.

    Where balls do not decide whether two closures merge, the number of certain ones before them.
    """
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
    """Whether balls now determine the closures of a group, having not been used before."""
    known, settled = failed.args_found, closing(failed.step).trying.settled
    if known in settled:
        return False
    settle(scene, program, failed.step, known)
    return settled[known] is not None


def settle(scene: Scene, program: Program, step: Step, known: tuple[Any, ...]) -> None:
    """Store in a step's trial its closures on known floats, as far as balls determine them."""
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
