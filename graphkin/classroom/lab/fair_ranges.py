"""Finds where in its parameter space a lab is fair, by sampling, and the widest fair ranges.

The draws fill the space evenly (Halton 1960), or are all points there are. Ranges are found by
peeling (Friedman and Fisher 1999, patient rule induction). From the whole box, the thin slice whose
loss leaves the largest fair share is removed, until everything inside is fair. New draws inside
must be fair too.

Draws where a lab is fair: the share by each parameter's values, and maps of pairs.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import combinations, pairwise, product
from math import prod
from typing import TYPE_CHECKING, Any

from msgspec import Struct

from graphkin.classroom.grading.neighbours import pencil_faults
from graphkin.classroom.lab.fairness import Fairness, judged
from graphkin.classroom.lab.lab_model import Lab, Range, Settings, ValueList
from graphkin.numbers.arithmetic import np
from graphkin.scene.model import Parameter, Scene
from graphkin.scene.parameters import plain
from graphkin.text.errors import Problem, SceneError, message
from graphkin.text.tables import Say
from graphkin.writers.plot_style import (
    COLOURS,
    FORMATS,
    figure_file,
    figure_title,
    look,
    new_figure,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Array = Any
DRAWS = 4000
"""The number of draws of a design."""
FINE = 50
"""The number of steps of a parameter for which the scene states none."""
PEEL = 0.04
"""The thickness of a peeled slice, relative to what is left of a range."""
PENCILLED = 200
"""The number of draws on which the accuracy of a pencil is tried."""
LEFT = 300
"""The fewest different data to keep where a pencil is accurate enough."""
AGAIN = 12
"""The most times that ranges are tried with new draws."""
SHARES = (0.75, 0.5, 0.25, 0.0)
"""The tried positions between what peeling left (0) and the whole space (1)."""
PRIMES = (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37)
"""The bases of the design, one for each parameter."""


class Tried(Struct, frozen=True):
    """Draws from a space: ``places`` are their indices by parameter, a row for each draw."""

    space: Mapping[str, Range]
    places: Array
    fairness: Fairness
    complete: bool

    @property
    def share(self) -> float:
        """The share of fair draws."""
        return float(self.fairness.fair.mean())

    def by_value(self, name: str, bins: int = 12) -> list[tuple[Fraction, Fraction, float, int]]:
        """For each part of a parameter's values: first and last value, fair share, draws."""
        values, column = self.space[name], [*self.space].index(name)
        edges = np.linspace(0, len(values), min(bins, len(values)) + 1).astype(int)
        found = []
        for low, high in pairwise(edges):
            inside = (self.places[:, column] >= low) & (self.places[:, column] < high)
            if inside.any():
                fair = float(self.fairness.fair[inside].mean())
                ends = values.value(int(low)), values.value(int(high) - 1)
                found.append((*ends, fair, int(inside.sum())))
        return found

    def guilt(self, name: str) -> float:
        """How much a parameter decides what is fair: the correlation ratio.

        This is the weighted variance of its fair shares, over the variance of all draws.
        """
        share = self.share
        if share in (0.0, 1.0):
            return 0.0
        parts = self.by_value(name)
        count = sum(part[3] for part in parts)
        spread = sum(part[3] * (part[2] - share) ** 2 for part in parts) / count
        return spread / (share * (1 - share))

    def reasons(self) -> list[tuple[str, int]]:
        """The limits that are broken, and how often, the most frequent first."""
        unfair = (i for i, fair in enumerate(self.fairness.fair) if not fair)
        every = (fault for i in unfair for fault in self.fairness.faults(i))
        return Counter(f"{fault.limit} {fault.where}".strip() for fault in every).most_common()


class FairRanges(Struct, frozen=True):
    """The parameter space of a lab as it was tried, and the ranges in which all draws were fair.

    ``ranges`` is None where there are none. ``left_alone`` are parameters without min and max.
    ``exact`` says of the first fair draws whether a pencil is as accurate as the lab demands; it is
    empty where the lab demands nothing. ``exact_inside`` is the share of draws from the ranges
    where it is.
    """

    tried: Tried
    ranges: Mapping[str, Range | ValueList] | None
    left_alone: tuple[str, ...]
    exact: tuple[bool, ...] = ()
    exact_inside: float = 1.0

    @property
    def count(self) -> int:
        """How many different data the ranges give."""
        return how_many(self.ranges) if self.ranges else 0


def fair_ranges(lab: Lab, say: Say = lambda words: None) -> FairRanges:
    """Try the whole space of a scene's parameters, and find the ranges in which all is fair.

    ``say`` receives the progress. Raises SceneError where no parameter of the scene has both
    ends.
    """
    say("trying variants")
    space = space_of(lab.mechanism.scene)
    tried = drawn_within(lab, space, whole_box(space))
    alone = tuple(name for name in lab.mechanism.scene.parameters if name not in space)
    limited = lab.fair.pencil is not None
    fair = tried.places[tried.fairness.fair]
    if tried.complete and len(space) == 1:
        good = tried.fairness.fair.copy()
        exact = drawn_exactly(lab, space, fair) if limited else ()
        good[good] = exact if limited else True
        ((name, values),) = space.items()
        runs = runs_of(values, good)
        return FairRanges(tried, {name: runs} if runs else None, alone, tuple(exact))
    say("drawing variants with a pencil" if limited else "narrowing the ranges")
    exact = drawn_exactly(lab, space, fair[:PENCILLED]) if limited else ()
    worst = max(space, key=tried.guilt)
    say("narrowing the ranges")
    boxes, ranges = [*between(whole_box(space), peeled(lab, tried))], []
    for number, box in enumerate(boxes, 1):
        say(f"trying ranges, {number} of {len(boxes)}")
        ranges.append(in_box(lab, space, box, worst, tried.share == 1))
    best = max((each for each in ranges if each is not None), key=how_many, default=None)
    if best is None or not limited:
        return FairRanges(tried, best, alone, tuple(exact))
    inside, share = pencilled(lab, best)
    return FairRanges(tried, inside, alone, tuple(exact), share)


def space_of(scene: Scene) -> dict[str, Range]:
    """All values that a scene allows to its parameters with both ends.

    Raises SceneError where no parameter has both ends.
    """
    every = {name: ends(each) for name, each in scene.parameters.items()}
    space = {name: values for name, values in every.items() if values is not None}
    if not space:
        found, wanted = (
            message("no parameter has min and max"),
            message("n = {{ value = …, min = …, max = … }}"),
        )
        raise SceneError(Problem("parameters", found, wanted, file="scene.toml"))
    return space


def between(whole: Box, peeled: Box | None) -> Iterator[Box]:
    """The whole box, the box that peeling left, and some between the two."""
    yield whole
    for share in SHARES if peeled is not None else ():
        yield [
            (round(low + share * (first - low)), round(high + share * (last - high)))
            for (low, high), (first, last) in zip(peeled or whole, whole, strict=True)
        ]


def in_box(
    lab: Lab, space: Mapping[str, Range], box: Box, worst: str, fair: bool
) -> dict[str, Range | ValueList] | None:
    """The ranges of a box; the parameter ``worst`` is restricted to its fair values.

    With ``fair``, everything in the space is fair and nothing is restricted. None where nothing is
    left.
    """
    ranges: dict[str, Range | ValueList] = {
        name: cut(values, *box[k]) for k, (name, values) in enumerate(space.items())
    }
    if fair:
        return ranges
    runs = all_runs(lab, space, box, worst)
    return None if runs is None else {**ranges, worst: runs}


def how_many(ranges: Mapping[str, Range | ValueList]) -> int:
    """How many different data some ranges give."""
    return prod(map(len, ranges.values()))


def ends(parameter: Parameter) -> Range | None:
    """All values that a scene allows, in its steps or in round ones; None without both ends."""
    if parameter.minimum is None or parameter.maximum is None:
        return None
    least, most = plain(parameter.minimum), plain(parameter.maximum)
    step = plain(parameter.step) if parameter.step is not None else round_step(most - least)
    return Range(least, most, step) if most > least else None


def round_step(span: Fraction) -> Fraction:
    """A step with the first digit 1, 2 or 5 that divides a span into about ``FINE`` parts."""
    rough, power = span / FINE, Fraction(1)
    while power > rough:
        power /= 10
    while power * 10 <= rough:
        power *= 10
    return next(power * digit for digit in (5, 2, 1) if power * digit <= rough)


Space = Mapping[str, Range | ValueList]
Box = list[tuple[int, int]]
"""The first and the last index of each parameter."""


def whole_box(space: Space) -> Box:
    """The box of all indices."""
    return [(0, len(values) - 1) for values in space.values()]


def drawn_within(lab: Lab, space: Mapping[str, Range], box: Box, start: int = 1) -> Tried:
    """Draws within a box: all points there are, or a design from number ``start`` on."""
    places = draws(box, DRAWS, start)
    many = [settings_at(space, row) for row in places]
    complete = prod(high - low + 1 for low, high in box) <= DRAWS
    return Tried(space, places, judged(lab, many), complete)


def draws(box: Box, count: int, start: int) -> Array:
    """The indices of draws within a box: all points there are, or ``count`` points of a design."""
    sizes = [high - low + 1 for low, high in box]
    if prod(sizes) <= count:
        found = np.array([*product(*map(range, sizes))])
    else:
        found = (halton(len(sizes), count, start) * sizes).astype(int)
    return found + np.array([low for low, _ in box])


def settings_at(space: Space, row: Sequence[int]) -> Settings:
    """The data at some indices."""
    return {n: values.value(int(k)) for (n, values), k in zip(space.items(), row, strict=True)}


def halton(dimensions: int, count: int, start: int) -> Array:
    """Points that fill a unit cube evenly: the digits of their numbers, mirrored at the point."""
    found = np.zeros((count, dimensions))
    for column in range(dimensions):
        base = PRIMES[column % len(PRIMES)]
        numbers, part = np.arange(start, start + count) * (1 + column // len(PRIMES)), 1.0
        while numbers.any():
            part /= base
            found[:, column] += part * (numbers % base)
            numbers //= base
    return found


# --- ranges ------------------------------------------------------------------------------------


def runs_of(values: Range, fair: Sequence[bool]) -> Range | ValueList | None:
    """The fair values of one parameter: a range, or a list of ranges and values.

    None where there are none.
    """
    runs: list[Range] = []
    begun = None
    for index, good in enumerate([*fair, False]):
        if good and begun is None:
            begun = index
        elif not good and begun is not None:
            runs.append(cut(values, begun, index - 1))
            begun = None
    return None if not runs else runs[0] if len(runs) == 1 else ValueList(tuple(runs))


def cut(values: Range, low: int, high: int) -> Range:
    """The part of a range between two indices."""
    return Range(values.value(low), values.value(high), values.step)


def part_of(values: Range | ValueList, low: int, high: int) -> Range | ValueList:
    """The part of a range, or of a list of ranges and values, between two indices."""
    if isinstance(values, Range):
        return cut(values, low, high)
    parts, begun = list[Range](), 0
    for part in values.parts:
        first, last = max(low - begun, 0), min(high - begun, len(part) - 1)
        if first <= last:
            parts.append(cut(part, first, last))
        begun += len(part)
    return parts[0] if len(parts) == 1 else ValueList(tuple(parts))


def peeled(lab: Lab, tried: Tried) -> Box | None:
    """The box that peeling leaves, with fair draws only; None where nothing is left."""
    box, places, fair = whole_box(tried.space), tried.places, tried.fairness.fair
    for turn in range(AGAIN):
        found = peel(box, places, fair)
        if found is None:
            return None
        box = pasted(found, whole_box(tried.space), places, fair) if turn == 0 else found
        more = drawn_within(lab, tried.space, box, 1 + (turn + 1) * DRAWS)
        if more.fairness.fair.all():
            return box
        places = np.concatenate([places, more.places])
        fair = np.concatenate([fair, more.fairness.fair])
    return None


def peel(box: Box, places: Array, fair: Array) -> Box | None:
    """Peel slices off a box until all draws inside are fair; None where nothing is left.

    Each slice is the one whose loss leaves the largest fair share.
    """

    inside = within(box, places)
    while not fair[inside].all():
        best: tuple[float, int, Box, Array] | None = None
        for smaller in slices(box):
            kept = inside & within(smaller, places)
            if kept.any():
                rank = (float(fair[kept].mean()), int(kept.sum()))
                if best is None or rank > best[:2]:
                    best = (*rank, smaller, kept)
        if best is None:
            return None
        _, _, box, inside = best
    return box if inside.any() else None


def pasted(box: Box, whole: Box, places: Array, fair: Array) -> Box:
    """The box, extended by slices at each end as long as all draws in it are fair."""
    grown = True
    while grown:
        grown = False
        for k, ((low, high), (first, last)) in enumerate(zip(box, whole, strict=True)):
            thin = max(1, round(PEEL * (high - low + 1)))
            for wider in ((max(first, low - thin), high), (low, min(last, high + thin))):
                larger = [*box[:k], wider, *box[k + 1 :]]
                if wider != (low, high) and fair[within(larger, places)].all():
                    box, grown = larger, True
                    break
    return box


def all_runs(lab: Lab, space: Mapping[str, Range], box: Box, name: str) -> Range | ValueList | None:
    """All values of one parameter that are fair with any values of the others in the box."""
    values, column = space[name], [*space].index(name)
    low, high = box[column] if len(values) > DRAWS // 8 else (0, len(values) - 1)
    good = np.zeros(len(values), dtype=bool)
    good[low : high + 1] = True
    for turn in range(AGAIN):
        left = np.flatnonzero(good)
        if not len(left):
            return None
        each = max(1, DRAWS // len(left))
        sizes = [high - low + 1 for low, high in box]
        spread = (halton(len(box), len(left) * each, 1 + turn * DRAWS) * sizes).astype(int)
        places = spread + np.array([low for low, _ in box])
        places[:, column] = np.repeat(left, each)
        fair = judged(lab, [settings_at(space, row) for row in places]).fair
        good[left] = fair.reshape(len(left), each).all(axis=1)
        if fair.all():
            break
    return runs_of(values, good.tolist())


def slices(box: Box) -> Iterator[Box]:
    """The box without a thin slice at either end of each parameter."""
    for k, (low, high) in enumerate(box):
        thin = max(1, round(PEEL * (high - low + 1)))
        if high - low >= thin:
            yield [*box[:k], (low + thin, high), *box[k + 1 :]]
            yield [*box[:k], (low, high - thin), *box[k + 1 :]]


def within(box: Box, places: Array) -> Array:
    """Which draws lie in a box."""
    low, high = np.array(box).T
    return ((places >= low) & (places <= high)).all(axis=1)


# --- the pencil ---------------------------------------------------------------------------------


def drawn_exactly(lab: Lab, space: Space, places: Array) -> Sequence[bool]:
    """Whether a pencil draws everything as accurately as the lab demands, for each fair draw."""
    many = [settings_at(space, row) for row in places]
    fairness = judged(lab, many)
    asked = [(each, fairness.computed(i)) for i, each in enumerate(many)]
    return [fault is None for fault in pencil_faults(lab, asked)]


def pencilled(lab: Lab, ranges: Space) -> tuple[Space, float]:
    """The part of fair ranges in which a pencil was accurate enough in all draws, and 1.

    The part is found by peeling, with fewer draws than for the space, since each needs drawings
    with a pencil. Where too few data for a class would be left, the ranges stay whole. The second
    result is then the share of draws in which a pencil is accurate enough; the other draws will be
    repeated.
    """
    box: Box | None = whole_box(ranges)
    places, good, share = np.empty((0, len(ranges)), dtype=int), np.empty(0, dtype=bool), 1.0
    for turn in range(AGAIN):
        if box is None or (turn and prod(high - low + 1 for low, high in box) < LEFT):
            break
        more = draws(box, PENCILLED, 1 + turn * PENCILLED)
        exact = np.array(drawn_exactly(lab, ranges, more), dtype=bool)
        share = share if turn else float(exact.mean())
        if exact.all():
            pairs = zip(ranges.items(), box, strict=True)
            return {name: part_of(values, *ends) for (name, values), ends in pairs}, 1.0
        places, good = np.concatenate([places, more]), np.concatenate([good, exact])
        box = peel(box, places, good)
    return ranges, share


MAPPED = 4
"""The number of parameters in the maps: those that decide most."""
BINS = 24
"""The number of parts of a parameter's values."""


def pictures(found: FairRanges, name: str, title: str) -> Iterator[tuple[str, bytes]]:
    """The files of the pictures, with their names."""
    tried = found.tried
    worst = sorted(tried.space, key=tried.guilt, reverse=True)
    with look():
        figures = {"fair-by-parameter": by_parameter(tried, title)}
        if len(worst) > 1:
            figures["fair-by-pairs"] = by_pairs(tried, worst[:MAPPED], title)
        for what, figure in figures.items():
            for kind in FORMATS:
                yield f"{name}-{what}.{kind}", figure_file(figure, kind)


def by_parameter(tried: Tried, title: str) -> Figure:
    """Draw the fair share by the values of each parameter, one panel below the other."""
    figure = new_figure(7.2, 0.6 + 1.7 * len(tried.space))
    figure_title(figure, title)
    panels = figure.subplots(len(tried.space), 1, squeeze=False)[:, 0]
    for axes, name in zip(panels, tried.space, strict=True):
        step = float(tried.space[name].step)
        for first, last, share, _ in tried.by_value(name, BINS):
            low, high = float(first) - step / 2, float(last) + step / 2
            axes.bar(low, 100 * share, high - low, align="edge", color=COLOURS[0], lw=0)
        axes.set_ylim(0, 100)
        axes.set_xlabel(name)
        axes.set_ylabel("fair, %")
    return figure


def by_pairs(tried: Tried, names: list[str], title: str) -> Figure:
    """Draw a map of the fair share for each pair of parameters."""
    pairs = [*combinations(names, 2)]
    across = min(3, len(pairs))
    down = -(-len(pairs) // across)
    figure = new_figure(3.4 * across + 0.6, 3.0 * down + 0.5)
    figure_title(figure, title)
    panels = figure.subplots(down, across, squeeze=False).ravel()
    for axes, pair in zip(panels, pairs, strict=False):
        fair_map(axes, tried, *pair)
    for axes in panels[len(pairs) :]:
        axes.set_visible(False)
    return figure


def fair_map(axes: Axes, tried: Tried, across: str, up: str) -> None:
    """Draw the fair share over two parameters, from red (none) to blue (all)."""
    x, y = values_of(tried, across), values_of(tried, up)
    edges = [np.linspace(v.min(), v.max(), min(BINS, len(set(v))) + 1) for v in (x, y)]
    every, _, _ = np.histogram2d(x, y, bins=edges)
    fair, _, _ = np.histogram2d(x, y, bins=edges, weights=tried.fairness.fair.astype(float))
    with np.errstate(all="ignore"):
        share = np.where(every > 0, 100 * fair / every, np.nan)
    drawn = axes.pcolormesh(*edges, share.T, cmap="RdYlBu", vmin=0, vmax=100, rasterized=True)
    axes.figure.colorbar(drawn, ax=axes, label="fair, %")
    axes.set_xlabel(across)
    axes.set_ylabel(up)
    axes.grid(visible=False)


def values_of(tried: Tried, name: str) -> Any:
    """The value of a parameter at each draw."""
    values, column = tried.space[name], [*tried.space].index(name)
    return np.array([float(values.value(int(k))) for k in tried.places[:, column]])
