"""Causes in reading and computing: what comes of a right drawing by a wrong ruler, scale or unit.

Each maps what a drawing shows to what a student writes, for many students at once. Arrays have a
row for each student and a column for each field of the form.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import cached_property
from itertools import combinations
from math import degrees, log, pi
from typing import Any

from msgspec import Struct
from msgspec.structs import astuple, replace

from graphkin.accuracy.pencil import SCALES
from graphkin.classroom.grading.causes import (
    Cause,
    Change,
    Misread,
    Told,
    Value,
    Variants,
    constructed,
    laid_anew,
    plan_of,
    speed_factors,
)
from graphkin.classroom.lab.items import motion_of
from graphkin.classroom.lab.lab_model import Item
from graphkin.construction.core.program import Plane
from graphkin.construction.core.quantities import (
    BALANCING_MOMENT,
    EPSILON,
    OMEGA,
    RATES,
    STROKE,
    SWING,
    TIME_RATIO,
)
from graphkin.construction.plan import TurningOfLink
from graphkin.numbers.arithmetic import np

Array = Any
FEW = 2
"""The fewest answers that determine a factor of a student's own."""
ODD, OWN = 1.07, 5.0
"""The least and the largest factor, up or down, by which a scale of one's own differs from the
right one. Three answers that agree may show a larger one."""
FREE = -3.5
"""How rare a factor that is fitted to several answers is, as a logarithm, beside a known one."""
POWER = -1.0
"""How rare a power of ten of a prefix is, as a logarithm; any other is twice as rare."""
OFTEN_OWN = 3.0
"""How often scales of one's own are chosen for the plans, beside any other cause."""
TEN, COARSE_TEN = 0.12, 0.3
"""How near a power of ten an answer is that is off by it, as a logarithm; and where that is within
the error of the drawing."""
PREFIXES = (2, 3)
"""The powers of ten between metres, centimetres and millimetres."""
ODD_PAIR = 0.3
"""How rare it is that two cells of one row of the table are exchanged."""
THOUSANDTHS = -5.0
"""How rare it is that all numbers lose three decimals, as a logarithm: that is rather a unit."""
OFTEN = 3.0
"""The deviations within which an answer is that of a drawing, but for a power of ten."""
OTHER = {"ν": "τ", "τ": "ν"}
"""The component mistaken for another."""


class FormFields(Struct, frozen=True, dict=True):
    """The fields of a form by kind, as masks, and how they depend on one another."""

    variants: Variants

    @cached_property
    def causes(self) -> tuple[Cause, ...]:
        """All causes, those in the construction first."""
        return (
            *constructed(self.variants.standards[0]),
            *of_rulers(self),
            *of_scales(self),
            *of_units(self),
            *of_formulas(self),
            *of_places(self),
            *of_table(self),
        )

    @cached_property
    def items(self) -> tuple[Item, ...]:
        """The fields."""
        return self.variants.layout.items

    def those(self, wanted: Callable[[Item], bool]) -> Array:
        """The mask of some fields."""
        return np.array([wanted(item) for item in self.items])

    @cached_property
    def senses(self) -> Array:
        """The senses."""
        return self.those(lambda item: item.what == "sense")

    @cached_property
    def centres(self) -> Array:
        """The coordinates of places."""
        return self.those(lambda item: item.what == "place")

    @cached_property
    def lengths(self) -> Array:
        """The segments measured in a plan."""
        return self.those(lambda item: item.what == "segment")

    @cached_property
    def rates(self) -> Array:
        """The rates of links."""
        return self.those(lambda item: item.what == "value" and motion_of(item) in RATES)

    @cached_property
    def moments(self) -> Array:
        """The balancing moments, which are computed from forces and arms."""
        return self.those(lambda item: item.what == "value" and motion_of(item) is BALANCING_MOMENT)

    @cached_property
    def computed(self) -> Array:
        """The vectors, rates, speeds, forces, moments and strokes that are computed."""
        angles = SWING, TIME_RATIO
        return self.those(lambda item: item.what == "value" and motion_of(item) not in angles)

    @cached_property
    def strokes(self) -> Array:
        """The strokes of blocks."""
        return self.those(lambda item: motion_of(item) is STROKE)

    @cached_property
    def ratios(self) -> Array:
        """The time ratios."""
        return self.those(lambda item: motion_of(item) is TIME_RATIO)

    @cached_property
    def plans(self) -> Array:
        """The plan of each field: 1 velocities, 2 accelerations, 3 forces, 0 the mechanism."""
        return np.array([plan_of(self.variants.layout, i) for i in self.variants.places])

    @cached_property
    def segments(self) -> Array:
        """The place of the segment from which a value is read; -1 where there is none."""
        at = {item.field: i for i, item in enumerate(self.items)}
        return np.array([at.get(item.segment, -1) for item in self.items])

    @cached_property
    def partners(self) -> Array:
        """The place of the segment of each value, and of the value of each segment; -1 for none."""
        found = self.segments.copy()
        values = np.flatnonzero(found >= 0)
        found[found[values]] = values
        return found

    @cached_property
    def sized(self) -> Array:
        """The place of the value of each sense; -1 where there is none."""
        at = {item.field: i for i, item in enumerate(self.items)}
        return np.array([at.get(i.sized, -1) if i.what == "sense" else -1 for i in self.items])

    @cached_property
    def formulas(self) -> Array:
        """The values of components, which may be computed without a length of the plan."""
        return self.those(lambda item: item.vector is not None and item.vector.sign in ("ν", "c"))


class View(Struct, frozen=True, dict=True):
    """What some students have before them, and what they answered.

    ``answers`` are sizes, places with their sign, and senses as signs; NaN where there is none.
    ``rows`` are their variants, ``whole`` marks numbers without a decimal point. ``errors`` are the
    deviations of the forgiven pencil.
    """

    form: FormFields
    rows: Array
    answers: Array
    whole: Array
    errors: Array

    def some(self, which: list[int]) -> View:
        """What some of the students have before them."""
        each = (self.rows, self.answers, self.whole, self.errors)
        return View(self.form, *(part[which] for part in each))

    @cached_property
    def units(self) -> Array:
        """A millimetre on the ruler in the unit of each field."""
        return np.nan_to_num(self.form.variants.units[self.rows], posinf=0.0)

    @cached_property
    def scales(self) -> tuple[Array, ...]:
        """What a millimetre of each drawing of ``SCALES`` is worth, in columns."""
        return tuple(each[self.rows] / 1000 for each in astuple(self.form.variants.paper))

    def own(self, scale: int) -> Array:
        """What a millimetre of one plan is worth, where another plan's is due."""
        return self.scales[scale]

    @cached_property
    def worth(self) -> Array:
        """What a millimetre is worth in the drawing of each field."""
        return np.concatenate(self.scales, axis=1)[:, self.form.plans]

    def factor(self, predicted: Array, among: Array, fewest: int = FEW) -> Array:
        """The factor by which a student's answers in some fields are too large; 1 where too few.

        A segment and the value that was computed from it show it without the drawing's errors.
        """
        with np.errstate(all="ignore"):
            ratios = self.answers / abs(predicted)
            partners = self.form.partners
            paired = (partners >= 0) & ~among[partners] & ~np.isnan(self.answers[:, partners])
            ratios = ratios / np.where(paired, ratios[:, partners], 1.0)
            ratios = np.where(among, ratios, np.nan)
            ratios = np.where(np.isfinite(ratios) & (ratios > 0), ratios, np.nan)
            enough = np.isfinite(ratios).sum(axis=1) >= fewest
            long = np.where(self.units > 0, abs(predicted) / self.units, 1.0)
            middle = np.exp(middling(np.log(np.where(enough[:, None], ratios, 1.0)), long))
        found = np.where(enough, middle, 1.0)
        powers = np.log10(found)
        near = abs(powers - np.round(powers)) < np.log10(ODD)  # a power of ten is a cause itself
        return np.where(near, 1.0, found)[:, None]


def middling(logs: Array, weights: Array | None = None) -> Any:
    """The median of each row, without NaN; 0 where there is none. Long lengths may weigh more."""
    weights = np.ones(logs.shape) if weights is None else weights
    order = np.argsort(logs, axis=1, kind="stable")
    ordered, own = (np.take_along_axis(each, order, axis=1) for each in (logs, weights))
    own = np.where(np.isfinite(ordered) & np.isfinite(own), own, 0.0)
    share = np.cumsum(own, axis=1) / np.maximum(own.sum(axis=1, keepdims=True), 1e-300)
    rows = np.arange(len(logs))
    low, high = ((share < half).sum(axis=1) for half in (0.5 - 1e-9, 0.5 + 1e-9))
    last = logs.shape[1] - 1
    ends = (ordered[rows, np.minimum(each, last)] for each in (low, high))
    return np.nan_to_num(sum(ends) / 2)


Reads = Callable[[Array, View, Mapping[int, Value]], Told]
"""What is written, from what a drawing shows, the students, and the drawing's values by step."""


def reading(
    name: str, way: str, reads: Reads, rare: float = 1.0, change: Change | None = None
) -> Cause:
    """A cause in reading or computing."""
    return Cause(name, way, change, reads, rare)


def only(mask: Array, changed: Array, shown: Array) -> Array:
    """Some fields changed, the others as shown."""
    return np.where(mask, changed, shown)


def changing(mask: Array, how: Callable[[Array, View], Array], free: Array | None = None) -> Reads:
    """Some fields changed; those of ``free`` may as well be right."""

    def reads(shown: Array, view: View, values: Mapping[int, Value]) -> Told:
        with np.errstate(all="ignore"):
            changed = only(mask, how(shown, view), shown)
        return Told(changed, None if free is None else only(free, shown, changed))

    return reads


def scaled(mask: Array, factor: Callable[[View], Array], free: Array | None = None) -> Reads:
    """Some fields a factor too large; those of ``free`` may as well be right."""
    return changing(mask, lambda shown, view: shown * factor(view), free)


# --- the ruler ------------------------------------------------------------------------------------


def of_rulers(form: FormFields) -> Iterator[Cause]:
    """Lengths read by the wrong edge of a scale ruler, or from its ten-millimetre mark.

    Components may be computed from the lengths read, and laid off with the same ruler or not.
    """
    layout, read = form.variants.layout, form.lengths | form.computed | form.centres
    for ratio in (2.0, 0.5):
        reads = scaled(read, steady(ratio), form.formulas)
        yield reading("ruler_scale", f"{ratio:g}", reads)
        for power in (1, 2):
            change = laid_anew(layout, steadily(ratio ** (power / 2)))
            yield reading("ruler_scale", f"{ratio:g} laid {power}", reads, 0.5, change)
    for shift in (10.0, -10.0):
        for way, mask in (("all", read), ("plans", form.lengths | form.computed)):
            reads = shifted(form, mask, shift)
            yield reading("ruler_from_ten", f"{way} {shift:g}", reads)
            for laid, also in (("laid", None), ("laid with it", shortened(shift))):
                change = laid_anew(layout, lengthened(shift), also)
                yield reading("ruler_from_ten", f"{way} {shift:g} {laid}", reads, 0.5, change)
    if form.centres.any():
        upwards = shifted(form, read, 10.0, upwards=True)
        yield reading("ruler_from_ten", "upwards", upwards)
        change = laid_anew(layout, lengthened(10.0))
        yield reading("ruler_from_ten", "upwards laid", upwards, 0.5, change)


def steady(ratio: float) -> Callable[[View], Array]:
    """The same factor for everybody."""
    return lambda view: ratio


def steadily(ratio: float) -> Misread:
    """The same factor for every length."""
    return lambda length, mm: ratio


def lengthened(shift: float) -> Misread:
    """The factor of a length that is too long by some millimetres."""
    return lambda length, mm: 1 + shift * mm / length


def shortened(shift: float) -> Misread:
    """The factor of a vector that is laid off too short by some millimetres."""
    return lambda vector, mm: np.maximum(0.0, 1 - shift * mm / abs(vector))


def shifted(form: FormFields, mask: Array, shift: float, *, upwards: bool = False) -> Reads:
    """Lengths too long by some millimetres; with ``upwards`` coordinates too large by as many."""

    def moved(shown: Array, view: View) -> Array:
        way = np.where(form.centres, 1.0, np.sign(shown)) if upwards else np.sign(shown)
        return shown + shift * view.units * way

    return changing(mask, moved, form.formulas)


# --- scale factors --------------------------------------------------------------------------------


def of_scales(form: FormFields) -> Iterator[Cause]:
    """Scale factors exchanged, forgotten or of one's own."""
    values = form.computed & ~form.moments
    first, second, third = ((form.plans == plan) & values for plan in (1, 2, 3))
    either = first | second

    def exchanged(own: int, other: int) -> Callable[[View], Array]:
        return lambda view: view.own(other) / view.own(own)

    for mask, own, other in ((first, 1, 2), (second, 2, 1), (first, 1, 0), (second, 2, 0)):
        way = f"{other} for {own}"
        yield reading("wrong_scale", way, scaled(mask, exchanged(own, other), form.rates))

    def crossed(shown: Array, view: View) -> Array:
        kv, ka = view.own(1), view.own(2)
        return np.where(first, shown * ka / kv, shown * kv / ka)

    yield reading("wrong_scale", "exchanged", changing(either, crossed, form.rates))
    owns = (("1", first), ("2", second), ("1 and 2", either), ("3", third))
    for plans, mask in owns if third.any() else owns[:3]:
        for free in (None, form.rates) if (mask & form.rates).any() else (None,):
            way = f"own {plans}" if free is None else f"own {plans} or right"
            yield reading("wrong_scale", way, by_own(form, mask, free))
    yield reading("scale_missing", "values", forgotten(form))
    if form.lengths.any():
        yield reading("scale_missing", "lengths", scaled(form.lengths, lambda view: view.worth))
        yield reading("drawn_in_full", "", scaled(form.lengths, lambda view: 1000 * view.own(0)))
        for number in range(1, len(SCALES)):
            mask = form.lengths & (form.plans == number)
            if mask.sum() >= FEW:
                yield reading("own_scale", str(number), by_own(form, mask, None))
        yield reading("own_scale", "both", by_own(form, form.lengths, None))
        yield reading("own_scale", "plans", by_plan(form, form.lengths), OFTEN_OWN)
    if form.centres.sum() > len("xy"):  # one place alone has errors along one line
        yield reading("own_scale", "mechanism", by_own(form, form.centres, None))
        everywhere = form.lengths | form.centres
        yield reading("own_scale", "sheet", by_plan(form, everywhere))
    if form.rates.any():
        for way, power in (("once", 1.0), ("twice", -1.0)):
            factor = powered(power)
            yield reading("length_not_scaled", way, scaled(form.rates, factor, form.rates))


def powered(power: float) -> Callable[[View], Array]:
    """A power of the scale of the mechanism."""
    return lambda view: (1000 * view.own(0)) ** power


def by_own(form: FormFields, mask: Array, free: Array | None) -> Reads:
    """Some fields off by one factor of the student's own, whatever it is."""

    def reads(shown: Array, view: View, values: Mapping[int, Value]) -> Told:
        factor = view.factor(shown, mask)
        changed = only(mask, shown * factor, shown)
        other = None if free is None else only(free, shown, changed)
        return Told(changed, other, FREE * (factor[:, 0] != 1))

    return reads


def by_plan(form: FormFields, mask: Array) -> Reads:
    """Some fields off by a factor of the student's own in each plan.

    A single answer of a plan gives the factor too, whatever the answer is.
    """

    def reads(shown: Array, view: View, values: Mapping[int, Value]) -> Told:
        changed, alone = shown, np.zeros(shown.shape, dtype=bool)
        fitted = np.zeros(len(shown))
        for plan in range(len(SCALES)):
            here = mask & (form.plans == plan)
            if here.any():
                factor = view.factor(shown, here, 1)
                read = here & ~np.isnan(view.answers)
                single = read.sum(axis=1, keepdims=True) == 1
                factor = np.where(single & (abs(np.log(factor)) > log(OWN)), 1.0, factor)
                changed = only(here, shown * factor, changed)
                alone |= read & single & (factor != 1)
                fitted += (~single & (factor != 1))[:, 0]
        return Told(changed, price=FREE * fitted, alone=alone)

    return reads


def forgotten(form: FormFields) -> Reads:
    """Vectors given as the millimetres that were measured."""
    vectors = form.computed & ~(form.rates | form.moments)

    def reads(shown: Array, view: View, values: Mapping[int, Value]) -> Told:
        with np.errstate(all="ignore"):
            drawn = np.where(view.units > 0, 1 / view.units, np.nan)
        changed = only(vectors, shown * drawn, shown)
        rates = shown * (1 / view.worth)  # computed from a length in mm over a bar in metres
        return Told(changed, only(form.rates, rates, changed))

    return reads


# --- units ----------------------------------------------------------------------------------------


def of_units(form: FormFields) -> Iterator[Cause]:
    """A speed in another unit in the answers only, rates in degrees or turns, powers of ten."""
    moving = form.computed & ~(form.moments | form.strokes)
    moving &= form.plans != SCALES.index(Plane.FORCES)
    for name, ratio in speed_factors(form.variants.standards[0].mechanism).items():
        for way, power in (("once", 1), ("squared", 2)):
            factors = np.where(moving, ratio ** np.where(form.plans == 2, power, 1), 1.0)
            yield reading(name, way, free_factors(factors, moving), 0.5)
    for name, ratio in (("rate_in_degrees", degrees(1)), ("rate_in_turns", 30 / pi)):
        if form.rates.any():
            factors = np.where(form.rates, ratio, 1.0)
            yield reading(name, "", free_factors(factors, form.rates))
    yield reading("power_of_ten", "", of_ten(form))
    yield reading("decimal_point_lost", "", of_ten(form, whole=True))


def free_factors(factors: Array, free: Array) -> Reads:
    """Fields off by their factors; those of ``free`` may as well be right."""

    return changing(True, lambda shown, view: shown * factors, free)


def of_ten(form: FormFields, *, whole: bool = False) -> Reads:
    """Answers off by powers of ten, the same power for all answers with one unit.

    With ``whole``, most answers have lost their decimal point: each by its own digits.
    """
    units = {item.unit for item in form.items if item.unit}
    every = np.array([item.unit for item in form.items])
    groups = [every == unit for unit in sorted(units)]
    sized = ~form.senses

    def reads(shown: Array, view: View, values: Mapping[int, Value]) -> Told:
        given, sizes = abs(view.answers), abs(shown)
        alike = sized & ~(form.centres & (view.answers * shown <= 0))
        with np.errstate(all="ignore"):
            powers = np.log10(given / sizes)
            near = np.round(powers)
            apart = np.where(abs(given / 10.0**near - sizes) < view.errors, COARSE_TEN, TEN)
            fits = alike & (abs(powers - near) < apart) & (abs(near) >= 1) & (abs(near) <= 4)
        if whole:
            written = sized & ~np.isnan(view.answers)
            most = 2 * (written & view.whole).sum(axis=1) > written.sum(axis=1)
            shift = np.where(fits & view.whole & (near > 0) & most[:, None], near, np.nan)
            power = np.nan_to_num(shift)
            even = ((power == 0) | (power == PREFIXES[1])).all(axis=1) & power.any(axis=1)
            price = price_of(power) + np.where(even, THOUSANDTHS, 0.0)
            return Told(shown * 10.0**power, price=price)
        changed = shown
        least = np.where(np.isfinite(near) & fits, abs(near), np.inf).min(axis=1)
        usual = np.where(np.isfinite(least), middling(np.where(fits, near, np.nan)), 0.0)
        chosen: list[Array] = []
        for group in groups:
            here = fits & group
            power = np.where(here.any(axis=1), middling(np.where(here, near, np.nan)), usual)
            power = np.round(power)[:, None]
            with np.errstate(all="ignore"):
                away = abs(given / 10.0**power - sizes)
                beside = abs(given - sizes) > OFTEN * view.errors
            unsure = group & alike & beside & (away < OFTEN * view.errors) & (power != 0)
            some = (here & (near == power)) | unsure
            changed = only(some, shown * 10.0**power, changed)
            chosen.append(np.where(some.any(axis=1), power[:, 0], 0.0))
        return Told(changed, price=price_of(np.array(chosen).T))

    return reads


def price_of(powers: Array) -> Array:
    """How rare the powers of ten in each row are, as a logarithm; equal ones count once."""
    ordered = np.sort(powers, axis=1)
    new = (np.diff(ordered, axis=1, prepend=np.inf) != 0) & (ordered != 0)
    prefixed = np.isin(abs(ordered), PREFIXES)
    return np.where(new, np.where(prefixed, POWER, 2 * POWER), 0.0).sum(axis=1)


# --- formulas -------------------------------------------------------------------------------------


def of_formulas(form: FormFields) -> Iterator[Cause]:
    """Rates and components computed from another vector than the right one; ratios turned over."""
    layout = form.variants.layout
    if form.ratios.any():
        yield reading("ratio_inverted", "", changing(form.ratios, lambda shown, view: 1 / shown))
    steps = layout.program.steps
    turns = [
        (place, steps[probe.step].args, probe.item.quantity)
        for place, probe in enumerate(layout.probes)
        if probe.item.what == "value" and isinstance(steps[probe.step].of, TurningOfLink)
    ]
    omegas = [(place, args) for place, args, quantity in turns if quantity == OMEGA]
    epsilons = [(place, args) for place, args, quantity in turns if quantity == EPSILON]

    def tip(p: Value, q: Value, tail: Value, end: Value) -> Value:
        return abs(end) / abs(q - p)

    def start(p: Value, q: Value, tail: Value, end: Value) -> Value:
        return abs(tail) / abs(q - p)

    def normal(p: Value, q: Value, tail: Value, end: Value) -> Value:
        return abs(((end - tail) / (q - p)).real)

    def whole(p: Value, q: Value, tail: Value, end: Value) -> Value:
        return abs((end - tail) / (q - p))

    for name, way, places, formula in (
        ("absolute_for_relative", "tip", omegas, tip),
        ("absolute_for_relative", "tail", omegas, start),
        ("normal_for_tangential", "", epsilons, normal),
        ("whole_for_tangential", "", epsilons, whole),
    ):
        if places:
            yield reading(name, way, computed_from(places, formula))
    pairs = list(components_beside(form))
    if pairs:
        yield reading("swapped", "", exchanged(pairs))


def computed_from(
    places: list[tuple[int, tuple[int, ...]]], formula: Callable[..., Value]
) -> Reads:
    """Rates by a wrong formula; each of them may as well be right."""

    def reads(shown: Array, view: View, values: Mapping[int, Value]) -> Told:
        changed = shown.copy()
        with np.errstate(all="ignore"):
            for place, args in places:
                value = np.asarray(formula(*(values[arg] for arg in args)), dtype=float)
                every = np.broadcast_to(value, (len(view.form.variants.standards), 1))
                changed[:, place] = np.copysign(every[view.rows, 0], shown[:, place])
        return Told(changed, shown)

    return reads


def components_beside(form: FormFields) -> Iterator[tuple[int, int]]:
    """The places of fields that are the other component of one vector."""
    items = form.items
    for i, item in enumerate(items):
        if item.vector is None or item.vector.sign not in OTHER:
            continue
        other = replace(item.vector, sign=OTHER[item.vector.sign]).symbol
        for k, each in enumerate(items):
            vector = each.vector
            alike = k > i and each.what == item.what and vector is not None
            if alike and vector is not None and vector.symbol == other:
                yield i, k


def exchanged(pairs: list[tuple[int, int]]) -> Reads:
    """Fields written in each other's place."""

    def reads(shown: Array, view: View, values: Mapping[int, Value]) -> Told:
        changed = shown.copy()
        for one, other in pairs:
            changed[:, one], changed[:, other] = shown[:, other], shown[:, one]
        return Told(changed)

    return reads


# --- places and the table -------------------------------------------------------------------------


def of_places(form: FormFields) -> Iterator[Cause]:
    """Coordinates of the other axis, or counted the other way."""
    at = {item.field: i for i, item in enumerate(form.items)}
    pairs = [
        (i, at[item.beside("place", "y")])
        for i, item in enumerate(form.items)
        if item.what == "place" and item.axis == "x" and item.beside("place", "y") in at
    ]
    if pairs:
        yield reading("axes_swapped", "", exchanged(pairs))
    for axis in "xy":
        mask = form.centres & np.array([item.axis == axis for item in form.items])
        if mask.any():
            yield reading("opposite", axis, free_factors(np.where(mask, -1.0, 1.0), mask))


def of_table(form: FormFields) -> Iterator[Cause]:
    """The answers for two points or links exchanged, and all senses taken the other way."""
    if form.senses.any():
        factors = np.where(form.senses, -1.0, 1.0)
        yield reading("sense_reversed", "", free_factors(factors, form.senses & False))
    owners: dict[str, dict[tuple[str, str, str], int]] = {}
    for i, item in enumerate(form.items):
        if item.vector is None:
            owners.setdefault(item.of, {})[item.quantity, item.what, item.axis] = i
    for one, other in combinations(owners, 2):
        shared = [kind for kind in owners[one] if kind in owners[other]]
        ways = {"": shared} | {
            plan: [kind for kind in shared if kind[0] == plan] for plan, _, _ in shared
        }
        ways |= {" ".join(kind[:2]): [kind] for kind in shared if kind[1] not in ("place", "sense")}
        seen: list[list[tuple[int, int]]] = []
        for way, kinds in ways.items():
            pairs = [(owners[one][kind], owners[other][kind]) for kind in kinds]
            if pairs and pairs not in seen:
                seen.append(pairs)
                yield reading("answers_exchanged", f"{one}-{other} {way}", exchanged(pairs))
    for owner, kinds_of in owners.items():
        for (one_kind, i), (other_kind, k) in combinations(kinds_of.items(), 2):
            if {one_kind[1], other_kind[1]} <= {"segment", "value"}:
                way = f"{owner} {' '.join((*one_kind, *other_kind))}"
                yield reading("answers_exchanged", way, exchanged([(i, k)]), ODD_PAIR)
