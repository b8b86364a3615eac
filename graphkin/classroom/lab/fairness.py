"""How fair variants are to their students: a class as one batch, at the scales of its sheets.

A variant is fair that closes, fits its page, and asks of the hand no crossing flatter, no segment
shorter and no triangle narrower or longer than the lab allows. A centre or pole that its
sheet does not hold, or whose rays cross flatter than that, spoils nothing else: it is computed.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from typing import Any

from msgspec import Struct, field
from msgspec.structs import astuple

from graphkin.classroom.lab.demands import (
    crossing_angles,
    ray_angles,
    segment_lengths,
    triangle_ratios,
)
from graphkin.classroom.lab.drawing_extents import VariantSheet, sketches
from graphkin.classroom.lab.held_centres import held
from graphkin.classroom.lab.items import items
from graphkin.classroom.lab.lab_model import Fair, Item, Lab
from graphkin.classroom.lab.rules import Settings
from graphkin.classroom.lab.variant_scales import scaling, taken
from graphkin.construction.core.solution import FAIR, LinkMotion, PointMotion, SlideMotion
from graphkin.construction.registry import LIMITED
from graphkin.drawing.scale import Scales
from graphkin.mechanism import Mechanism
from graphkin.numbers.arrays import np

Array = Any
BLOCK = 4096
"""Variants judged at once, so that memory stays small."""
WORDS = {
    "closes": "does not close",
    "page": "does not fit the page",
    "crossing": "crosses flatter than the limit",
    "segment": "is shorter than the limit",
    "triangle": f"has a {LIMITED} outside its limits",
    "pencil": "is drawn less exactly than the limit",
    "apart": "earns more with another's right values than the limit",
}
"""The limits by name, in words."""


class Fault(Struct, frozen=True):
    """A limit that a variant does not keep: which, where, its value and the bound, in its unit."""

    limit: str
    where: str = ""
    value: float = float("nan")
    bound: float = float("nan")

    def __str__(self) -> str:
        """Read as ``segment a_D 0.4 mm, at least 3``."""
        match self.limit:
            case "crossing":
                return f"crossing {self.where} {self.value:.1f}°, at least {self.bound:g}°"
            case "segment":
                return f"segment {self.where} {self.value:.1f} mm, at least {self.bound:g} mm"
            case "triangle":
                side = "at least" if self.value < self.bound else "at most"
                return f"triangle {self.where} v/l {self.value:.3g}, {side} {self.bound:g}"
            case "pencil":
                error = f"{100 * self.value:.0f} % of its value, at most {100 * self.bound:g} %"
                return f"a pencil's error of {self.where} is {error}"
            case "apart":
                share = f"{100 * self.value:.0f} % of the points, at most {100 * self.bound:g} %"
                return f"the right values of {self.where} earn {share}"
        return WORDS[self.limit]


class Fairness(Struct, dict=True):
    """What the drawings of many variants demand of a hand, an array for each thing drawn.

    ``form`` names the fields; ``crossings`` are in degrees by the letter of the point, ``lengths``
    in mm and ``rays`` in degrees by the field, ``triangles`` as v/l by the relative velocity,
    ``on_page`` for fields of places; ``kL`` is the sheets' own scale, NaN where nothing fits, and
    ``larger`` and ``larger_still`` how many times as large the plans are drawn.
    """

    limits: Fair
    form: tuple[Item, ...]
    closes: Array
    fits: Array
    kL: Array
    larger: Array
    larger_still: Array
    crossings: dict[str, Array] = field(default_factory=dict)
    lengths: dict[str, Array] = field(default_factory=dict)
    triangles: dict[str, Array] = field(default_factory=dict)
    rays: dict[str, Array] = field(default_factory=dict)
    on_page: dict[str, Array] = field(default_factory=dict)

    def __len__(self) -> int:
        """How many variants there are."""
        return len(self.closes)

    @cached_property
    def flattest(self) -> Array:
        """The smallest angle of a crossing in degrees, 90 where nothing crosses; rays to centres
        and poles are told by themselves.
        """
        return least_of(self.crossings, len(self), 90.0)

    @cached_property
    def flattest_rays(self) -> Array:
        """The smallest angle in degrees of rays to a centre or pole; infinite where none is."""
        return least_of(self.rays, len(self), float("inf"))

    @cached_property
    def shortest(self) -> Array:
        """The shortest segment to be measured in mm; infinite where none is."""
        return least_of(self.lengths, len(self), float("inf"))

    @cached_property
    def fair(self) -> Array:
        """Which variants keep all limits."""
        low, high = self.limits.triangle
        good = self.closes & self.fits
        good &= (self.flattest >= self.limits.crossing) & (self.shortest >= self.limits.segment)
        for ratio in self.triangles.values():
            good &= np.isfinite(ratio) & (ratio >= low) & (ratio <= high)
        return good

    def faults(self, index: int) -> tuple[Fault, ...]:
        """The limits that one variant does not keep, each thing drawn by itself."""
        return () if self.fair[index] else tuple(self.all_faults(index))

    def all_faults(self, index: int) -> Iterator[Fault]:
        """As faults; what does not close or fit has no other."""
        if not self.closes[index]:
            yield Fault("closes")
            return
        if not self.fits[index]:
            yield Fault("page")
            return
        limits = self.limits
        for name, angles in self.crossings.items():
            if not angles[index] >= limits.crossing:
                yield Fault("crossing", name, float(angles[index]), limits.crossing)
        for name, lengths in self.lengths.items():
            if not lengths[index] >= limits.segment:
                yield Fault("segment", name, float(lengths[index]), limits.segment)
        low, high = limits.triangle
        for name, ratios in self.triangles.items():
            if not low <= ratios[index] <= high:
                bound = low if ratios[index] < low else high
                yield Fault("triangle", name, float(ratios[index]), bound)

    def computed(self, index: int) -> tuple[str, ...]:
        """The fields that one variant cannot measure, and so computes."""
        if not (self.closes[index] and self.fits[index]):
            return ()
        small = [n for n, mm in self.lengths.items() if not mm[index] >= self.limits.segment]
        flat = [n for n, angle in self.rays.items() if not angle[index] >= self.limits.crossing]
        off = [name for name, on in self.on_page.items() if not on[index]]
        wanting = {*small, *flat, *off}
        return tuple(each.field for each in self.form if wanting & {each.field, each.segment})


def judged(lab: Lab, many: Sequence[Settings]) -> Fairness:
    """The fairness of variants by their exact data, within what the scene allows."""
    count, form = len(many), items(lab.mechanism, lab)
    closes, fits = np.zeros((2, count), dtype=bool)
    found = Fairness(lab.fair, form, closes, fits, *np.full((3, count), np.nan))
    names = dict.fromkeys(name for settings in many for name in settings)
    for start in range(0, count, BLOCK):
        block = many[start : start + BLOCK]
        given = {n: np.array([float(settings[n]) for settings in block]) for n in names}
        judge(found, lab, block, {**lab.mechanism.scene.values, **given}, start)
    return found


def judge(
    found: Fairness, lab: Lab, block: Sequence[Settings], values: Mapping[str, Any], start: int
) -> None:
    """Judge as many variants as go into one block, put at their places from a start on."""
    mechanism, where = lab.mechanism, slice(start, start + len(block))
    closes = found.closes[where] = closing(mechanism, values, len(block))
    scaled = scaling(mechanism, values, len(block), lambda i: lab.variant(block[i]), closes)
    scales = scaled.together(range(len(block)))
    fits = found.fits[where] = np.isfinite(scales.kL)
    found.kL[where], found.larger[where] = scales.kL, scales.larger
    found.larger_still[where] = scales.larger_still
    for triangles in (True, False):
        which = np.flatnonzero(closes & fits & (scales.triangles == triangles))
        if len(which):
            own = scaled.together(which)
            drawn = sketches(
                mechanism,
                taken(values, which),
                own.seconds,
                triangles=triangles,
                rates={number: rate[which] for number, rate in scaled.rates.items()},
                margins=True,
            )
            put_drawn(found, drawn, own, start + which)


def closing(mechanism: Mechanism, values: Mapping[str, Any], count: int) -> Array:
    """Which variants can be constructed: all that is asked is finite, no crossing is singular."""
    given = {name: value for name, value in values.items() if hasattr(value, "shape")}
    asked = mechanism.run_many(given, asked=True, kind="float64")
    motions: list[PointMotion | LinkMotion | SlideMotion] = [*asked.points.values()]
    motions += [*asked.links.values(), *asked.slides.values()]
    sound = np.broadcast_to(np.asarray(asked.margin) >= FAIR, count).copy()
    for motion in motions:
        for value in astuple(motion):
            if value is not None and not isinstance(value, tuple):
                sound &= np.isfinite(value)
    return sound


def put_drawn(found: Fairness, drawn: Sequence[VariantSheet], scales: Scales, which: Array) -> None:
    """What is drawn on the sheets of some variants, put at their places; scales are arrays."""
    form = found.form
    for sheet in drawn:
        lengths = segment_lengths(sheet, form, scales.kL / scales.metres(sheet.kind))
        put(found.crossings, crossing_angles(sheet), which, len(found))
        put(found.lengths, lengths, which, len(found))
        put(found.triangles, triangle_ratios(sheet), which, len(found))
        put(found.rays, ray_angles(sheet, form), which, len(found))
        put(found.on_page, held(drawn, sheet, form, scales), which, len(found))


def put(
    room: dict[str, Array], found: Iterator[tuple[str, Array]], which: Array, size: int
) -> None:
    """Put arrays of some variants at their places; of two under one name the smaller stays."""
    for name, value in found:
        empty = np.zeros(size, dtype=bool) if np.asarray(value).dtype == bool else None
        array = room.setdefault(name, np.full(size, np.nan) if empty is None else empty)
        array[which] = value if empty is not None else np.fmin(array[which], value)


def least_of(room: Mapping[str, Array], size: int, default: float) -> Array:
    """The least of several arrays for each variant; NaN, where something is not drawn, as none."""
    least = np.full(size, np.nan)
    for array in room.values():
        least = np.fmin(least, array)
    return np.where(np.isnan(least), default, least)
