"""Groups of class III and higher: one link is tried all round, until what was cut fits again.

The only place where values decide how many steps there are: the trial runs a program of its own on
arrays of trial positions, brackets every fit and closes in on it. Its derivatives come from plans.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from graphkin.arithmetic import FLOAT, Point, Real, batch_kind, phase
from graphkin.plane import Line, cross, dot
from graphkin.steps.batch import run_batch
from graphkin.steps.program import Program
from graphkin.steps.run import Values
from graphkin.steps.vocabulary import Action, action

SAMPLES = 360
"""Trial positions of a round."""
FINER = 24
"""Into how many parts an interval is cut where the misfit turns back or the chain breaks off."""
ROUNDS = 60
"""Rounds of closing in on a fit; each at least halves the interval."""
CLOSE = 1e-6
"""Misfit of a fit, in parts of that of its interval: rounding leaves far less, a pole more."""
MOST = 400_000
"""Trial positions run at once."""
SAME = 1e-7
"""Radians within which two angles count as one when closures are put in order."""


class ClosingError(ValueError):
    """A group that does not close, or not in as many ways as asked."""

    def __init__(self, ways: int, asked: int) -> None:
        self.ways, self.asked = ways, asked
        super().__init__(f"closes in {ways} ways, closure {asked} is asked")


@dataclass(frozen=True, slots=True)
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

    def action(self, number: int) -> Action:
        """The step that closes the group in the closure of a number, counted from one."""
        return Action("close", Closer(self, number))

    # --- running the trial -----------------------------------------------------------------------

    def results(self) -> tuple[int, ...]:
        """The steps whose values are looked at."""
        facing = () if self.facing is None else (self.facing,)
        return (self.misfit, self.locus, *facing, *self.axes)

    def found(self, known: Sequence[Any], tried: Any, signs: Any) -> dict[int, Any]:
        """The results for arrays of trial values and of signs, known values given per element."""
        import numpy as np

        overrides = dict(zip(self.inputs, known, strict=True))
        overrides[self.tried] = np.exp(1j * tried) if self.turns else tried
        overrides |= {step: signs[:, k] for k, step in enumerate(self.signs)}
        needed = needed_of(self.program, self.results())
        with np.errstate(all="ignore"):
            trace = run_batch(
                self.program, needed, self.values, batch_kind(), self.results(), overrides=overrides
            )
        size = len(tried)
        return {n: np.broadcast_to(trace.values[n], size) for n in self.results()}

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

        grid = self.grid(known, size)
        low, high = grid[:, :-1], grid[:, 1:]
        owner = np.repeat(np.arange(size), grid.shape[1])
        here = [array[owner] for array in known]
        rows = np.broadcast_to(signs, (owner.size, len(signs)))
        misfit = self.misfits(here, grid.ravel(), rows).reshape(grid.shape)
        left, right = misfit[:, :-1], misfit[:, 1:]
        crossing = left * right <= 0
        doubtful = ~crossing & turning_back(misfit) | (np.isnan(left) != np.isnan(right))
        element, at = np.nonzero(doubtful)
        ends = [self.finer(known, element, low[element, at], high[element, at], signs)]
        element, at = np.nonzero(crossing)
        ends.append((element, low[element, at], high[element, at]))
        owner, low, high = (np.concatenate(column) for column in zip(*ends, strict=True))
        tried = self.closed_in(known, owner, low, high, signs)
        return owner, tried, np.broadcast_to(signs, (owner.size, len(signs)))

    def grid(self, known: Sequence[Any], size: int) -> Any:
        """The trial values of each element: a round, or as far to both sides as can be needed."""
        import numpy as np

        if self.turns:
            round_ = np.linspace(0, 2 * np.pi, SAMPLES + 1) + 0.123e-3
            return np.broadcast_to(round_, (size, SAMPLES + 1))
        assert self.reach is not None
        needed = needed_of(self.program, (self.reach,))
        overrides = dict(zip(self.inputs, known, strict=True))
        with np.errstate(all="ignore"):
            trace = run_batch(
                self.program, needed, self.values, batch_kind(), (self.reach,), overrides=overrides
            )
        reach = np.broadcast_to(trace.values[self.reach], size)
        return reach[:, None] * np.linspace(-1, 1, 2 * SAMPLES + 1)

    def finer(
        self, known: Sequence[Any], element: Any, low: Any, high: Any, signs: Any
    ) -> tuple[Any, Any, Any]:
        """Intervals with a crossing among parts of doubtful ones: near touching, near a break."""
        import numpy as np

        edge = self.edge(known, element, low, high, signs)
        share = np.linspace(0, 1, FINER + 1)
        values = edge[0][:, None] + (edge[1] - edge[0])[:, None] * share
        owner = np.repeat(element, FINER + 1)
        here = [array[owner] for array in known]
        rows = np.broadcast_to(signs, (owner.size, len(signs)))
        misfit = self.misfits(here, values.ravel(), rows).reshape(values.shape)
        row, at = np.nonzero(misfit[:, :-1] * misfit[:, 1:] <= 0)
        return element[row], values[row, at], values[row, at + 1]

    def edge(
        self, known: Sequence[Any], element: Any, low: Any, high: Any, signs: Any
    ) -> tuple[Any, Any]:
        """Intervals cut off where the chain breaks off; the others as they are."""
        import numpy as np

        here = [array[element] for array in known]
        rows = np.broadcast_to(signs, (element.size, len(signs)))
        ends = [np.isfinite(self.misfits(here, value, rows)) for value in (low, high)]
        inside = np.where(ends[0], low, high)
        outside = np.where(ends[0] & ends[1], high, np.where(ends[0], high, low))
        both = ends[0] & ends[1]
        for _ in range(ROUNDS):
            middle = (inside + outside) / 2
            good = np.isfinite(self.misfits(here, middle, rows))
            inside = np.where(~both & good, middle, inside)
            outside = np.where(~both & ~good, middle, outside)
        return np.where(both, low, np.where(ends[0], low, high)), np.where(both, high, inside)

    def closed_in(self, known: Sequence[Any], owner: Any, low: Any, high: Any, signs: Any) -> Any:
        """The fit in each interval by false position, halved where that stalls.

        NaN where the misfit does not vanish but jumps from one side to the other, at a pole.
        """
        import numpy as np

        here = [array[owner] for array in known]
        rows = np.broadcast_to(signs, (owner.size, len(signs)))
        left, right = (self.misfits(here, value, rows) for value in (low, high))
        best = np.where(abs(left) <= abs(right), low, high)
        allowed = CLOSE * np.maximum(abs(left), abs(right))
        for turn in range(ROUNDS):
            with np.errstate(all="ignore"):
                guess = high - right * (high - low) / (right - left)
            inside = (guess - low) * (guess - high) < 0
            middle = (low + high) / 2
            trial = np.where(inside & (turn % 3 != 2), guess, middle)
            value = self.misfits(here, trial, rows)
            best = np.where(abs(value) <= np.minimum(abs(left), abs(right)), trial, best)
            goes = left * value <= 0
            low, left = np.where(goes, low, trial), np.where(goes, left, value)
            high, right = np.where(goes, trial, high), np.where(goes, value, right)
        return np.where(abs(self.misfits(here, best, rows)) <= allowed, best, np.nan)

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


def turning_back(misfit: Any) -> Any:
    """Intervals beside a sample whose misfit is nearer to nought than both neighbours'."""
    import numpy as np

    size = abs(misfit)
    least = np.zeros(misfit.shape, dtype=bool)
    least[:, 1:-1] = (size[:, 1:-1] <= size[:, :-2]) & (size[:, 1:-1] <= size[:, 2:])
    return least[:, :-1] | least[:, 1:]


# --- what the trial's program and the plans of the group draw ------------------------------------


@action("part", margin=lambda closing, place: closing[-1])
def part(closing: tuple[Any, ...], place: int) -> Any:
    """One of the values that close a group: the tried one, or a dyad's sign."""
    return closing[place]


@action("excess")
def excess(p: Point, q: Point, length: Real) -> Real:
    """By how much two points stand farther apart than a bar is long."""
    return abs(q - p) - length


@action("from-to")
def from_to(p: Point, q: Point) -> Point:
    """The way from one point to another."""
    return q - p


@action("on-line")
def on_line(line: Line, point: Point) -> Point:
    """A point in the axes of a line: how far along it, and how far to its left."""
    return (point - line.point) * line.along.conjugate() / abs(line.along)


@action("beside-line")
def beside_line(line: Line, point: Point) -> Real:
    """How far a point stands to the left of a line."""
    return cross(line.along, point - line.point) / abs(line.along)


@action("less")
def less(a: Real, b: Real) -> Real:
    """What a number has too much."""
    return a - b


@action("sine-between")
def sine_between(axis: Point, other: Point) -> Real:
    """Sine of the angle from one direction to another; nought where they agree or are opposed."""
    return cross(other, axis)


@action("cosine-between")
def cosine_between(axis: Point, other: Point) -> Real:
    """Cosine of the angle between two directions: positive where they agree."""
    return dot(other, axis)


@action("far")
def far(p: Point, *others: Point) -> Real:
    """How far some points lie from a point in the mean."""
    total: Real = 0.0
    for other in others:
        total = total + abs(other - p)
    return total / len(others)


@action("lacks")
def lacks(p: Point, q: Point, image_p: Point, image_q: Point, wanted: Point) -> Real:
    """What a bar's trial images miss along the bar."""
    bar = q - p
    return dot(bar, image_q - image_p - wanted) / abs(bar)


@action("lacks")
def lacks_across(line: Line, start: Point, image: Point) -> Real:
    """What a sliding point's trial image misses across its guide."""
    return cross(line.along, image - start) / abs(line.along)


@action("share")
def share(first: Real, second: Real) -> Real:
    """Where between two trials the misfit vanishes: it grows in proportion."""
    return first / (first - second)


@action("between")
def between(first: Point, second: Point, part: Real) -> Point:
    """The point that divides the way from the first trial's point to the second's so."""
    return first + (second - first) * part


@action("inverse")
def inverse(seconds: Real) -> Real:
    """The rate of one radian in a time."""
    return 1 / seconds


@action("product")
def product(a: Real, b: Real) -> Real:
    """The product of two numbers."""
    return a * b


@action("reach")
def reach(line: Line, *rest: Any) -> Real:
    """How far from a line's own point the bars of a group allow: ``rest`` are so many lengths,
    then the known points, then how many lengths there are."""
    *values, count = rest
    total: Real = 0.0
    for length in values[:count]:
        total = total + abs(length)
    for place in values[count:]:
        total = total + abs(place - line.point)
    return 1.01 * total


@action("line-through")
def line_through(first: Point, second: Point) -> Line:
    """The line through two points."""
    return Line(first, second - first)
