"""Judges how fair variants are to their students: a class as one batch, at its sheets' scales.

A variant is fair if it closes, fits its page, and keeps the lab's limits. These limit how flat a
crossing is, how short a segment is, and how narrow or long a triangle is. A centre or pole is
computed where its sheet does not hold it, or where its rays cross too flat; this spoils nothing
else.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property, reduce
from typing import Any

from msgspec import Struct, field
from msgspec.structs import astuple

from graphkin.classroom.lab.items import arrow_steps, items, motion_of
from graphkin.classroom.lab.lab_model import Fair, Item, Lab, Settings
from graphkin.classroom.lab.variant_scales import VariantSheet, boxes, scaling, sketches, taken
from graphkin.construction.core.component import component_of
from graphkin.construction.core.crossings import is_drawn, letter_of
from graphkin.construction.core.drawn_scene import ENDLESS
from graphkin.construction.core.layout import Held, held_beside, room_below
from graphkin.construction.core.paper_canvas import WITHIN
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.quantities import (
    BY_TARGET,
    FORCES,
    RATES,
    LinkMotion,
    PointMotion,
    SlideMotion,
)
from graphkin.construction.core.run import run_batch
from graphkin.construction.core.solution import FAIR
from graphkin.construction.forces.force_drawing import ForceExtents
from graphkin.construction.registry import LIMITED
from graphkin.documents.force_fields import cells_of, smallest
from graphkin.drawing.field import SheetPaper, paper_of
from graphkin.drawing.scale import Extent, Scales
from graphkin.mechanism import Mechanism
from graphkin.numbers.arithmetic import batch_kind, larger, np
from graphkin.numbers.plane import Ratio, Vector
from graphkin.scene.quantity import force_in

Array = Any


def crossing_angles(sheet: VariantSheet) -> Iterator[tuple[str, Array]]:
    """The angle in degrees at which lines cross, for each point that answers depend on.

    Steps that only the hand's construction of a plate or triangle needs are left out: there is
    another way, or they have a limit of their own.
    """
    program = sheet.trace.program
    for number, sine in sheet.trace.margins.items():
        step = program.steps[number]
        if step.hand or step.part in (Part.CENTRE, Part.POLE) or not is_drawn(step, 1.0):
            continue
        angle = np.degrees(np.arcsin(np.clip(sine, 0.0, 1.0)))
        yield letter_of(program, number) or f"step {number}", angle


def segment_lengths(
    sheet: VariantSheet, form: Sequence[Item], scale: Array
) -> Iterator[tuple[str, Array]]:
    """The length in mm of the segment measured for each field of the form, on its sheet."""
    for item in form:
        size = measured(sheet, item)
        if size is not None:
            yield item.field, 1000 * np.abs(size) / scale


def measured(sheet: VariantSheet, item: Item) -> Array | None:
    """The vector of a plan by which a field is measured; None where this sheet has none.

    A rate is measured by the relative velocity, or by the tangential acceleration, over the bar.
    """
    trace, program = sheet.trace, sheet.trace.program
    quantity = BY_TARGET.get(item.quantity)
    twin = quantity is None or quantity.sort == "vector"
    if item.what in ("sense", "place") or (item.what == "value" and twin):
        return None
    if quantity is None:
        value = trace.values.get(arrow_steps(program).get(item.of, -1))
        return value.tip - value.tail if isinstance(value, Vector) else None
    number = program.targets.get((item.quantity, item.of), -1)
    if number not in trace.values or sheet.kind != quantity.kind:
        return None
    if quantity not in RATES:
        return trace.values[number]
    args = program.steps[number].args
    if len(args) != 4:
        return None
    return trace.values[number] * abs(trace.values[args[1]] - trace.values[args[0]])


def triangle_ratios(sheet: VariantSheet) -> Iterator[tuple[str, Array]]:
    """v/l of each triangle that is drawn for a component, at the sheet's scale."""
    program, values = sheet.trace.program, sheet.trace.values
    for number in values:
        kind = component_of(program, number)
        if kind is not None and not program.steps[number].hand and kind.read in values:
            yield from kind.proportions(values, sheet.seconds)


def ray_angles(sheet: VariantSheet, form: Sequence[Item]) -> Iterator[tuple[str, Array]]:
    """The angle in degrees at which the rays to each centre or pole of the form cross."""
    program, margins = sheet.trace.program, sheet.trace.margins
    for item in form:
        number = program.targets.get((item.quantity, item.of), -1)
        if item.what != "place" or number not in sheet.trace.values:
            continue
        sine = margins.get(program.steps[number].by_hand or -1)
        if sine is not None:
            yield item.field, np.degrees(np.arcsin(np.clip(sine, 0.0, 1.0)))


# --- centres and poles on the sheets of many variants ---------------------------------------------


PARTS = {"velocity": Part.CENTRE, "acceleration": Part.POLE}


def mechanism_fields(sheets: Sequence[VariantSheet], scales: Scales, paper: SheetPaper) -> Held:
    """The mechanism's field on the sheets of many variants; scales are arrays."""
    mm = 1000 / scales.kL
    plans = (each.plan_box.width * mm * scales.times(each.kind) for each in sheets)
    box = reduce(Extent.joined, (each.mechanism_box for each in sheets))
    poles = (place for each in sheets for place in poles_of(each))
    return held_beside(paper, box, poles, mm, reduce(larger, plans))


def held(
    sheets: Sequence[VariantSheet], sheet: VariantSheet, form: Sequence[Item], scales: Scales
) -> Iterator[tuple[str, Array]]:
    """Whether a sheet's mechanism field holds each place of the form; scales are arrays."""
    asked = [item for item in form if item.what == "place"]
    targets = sheet.trace.program.targets
    places = {
        item.field: sheet.trace.values[number]
        for item in asked
        if (number := targets.get((item.quantity, item.of), -1)) in sheet.trace.values
        and sheet.trace.program.steps[number].part is PARTS[sheet.kind]
    }
    if not places:
        return
    stated = sheet.mechanism.scene.sheet
    paper = paper_of(stated.paper, stated.frame)
    mm = 1000 / scales.kL
    field = mechanism_fields(sheets, scales, paper)
    left, bottom, right, top = field.box.sides
    height, room = (top - bottom) * mm, paper.fields[3] - paper.fields[1]
    lift = room_below(paper, height) + height / 2 - room / 2
    for name, value in places.items():
        point = placed(sheet, value)
        x = (point.real - (left + right) / 2) * mm
        y = (point.imag - (bottom + top) / 2) * mm + lift
        yield name, (abs(x) <= field.width / 2 - WITHIN) & (abs(y) <= room / 2 - WITHIN)


def poles_of(sheet: VariantSheet) -> Iterator[Array]:
    """The centres or poles on a sheet."""
    for step, value in sheet.steps(Plane.MECHANISM):
        if step.part is PARTS[sheet.kind] and isinstance(value, Ratio):
            yield placed(sheet, value)


def placed(sheet: VariantSheet, value: Ratio) -> Array:
    """The point of a centre or pole; NaN at infinity, or too far away to matter."""
    with np.errstate(all="ignore"):
        near = np.abs(value.size) * ENDLESS * sheet.reach > np.abs(value.shift)
        return np.where(near, value.start + value.shift / value.size, np.nan + 0j)


# --- the fairness of a batch ----------------------------------------------------------------------


BLOCK = 4096
"""The most variants judged at once, which keeps memory small."""
WORDS = {
    "closes": "does not close",
    "page": "does not fit the page",
    "crossing": "crosses flatter than the limit",
    "segment": "is shorter than the limit",
    "triangle": f"has a {LIMITED} outside its limits",
    "pencil": "is drawn less exactly than the limit",
    "apart": "earns more with another's right values than the limit",
    "room": "is not compared, since there was no room for hundreds in a row",
}


class Fault(Struct, frozen=True):
    """A limit that a variant breaks: which, where, the value and the bound, in the limit's unit."""

    limit: str
    where: str = ""
    value: float = float("nan")
    bound: float = float("nan")

    def __str__(self) -> str:
        """The fault as text, such as ``segment a_D 0.4 mm, at least 3 mm``."""
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
    """What drawing many variants demands of a hand, an array for each thing drawn.

    ``form`` are the fields. ``crossings`` are in degrees, by the letter of the point. ``lengths``
    are in mm, and ``rays`` in degrees, by the field. ``triangles`` are v/l, by the relative
    velocity. ``on_page`` says for each place whether its sheet holds it.

    ``kL`` is the scale of the sheets, NaN where nothing fits. ``larger`` and ``larger_still`` are
    the enlargements of the plans.
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
        return len(self.closes)

    @cached_property
    def flattest(self) -> Array:
        """The smallest crossing angle in degrees, 90 where nothing crosses.

        Rays to centres and poles are listed in ``flattest_rays``.
        """
        return least_of(self.crossings, len(self), 90.0)

    @cached_property
    def flattest_rays(self) -> Array:
        """The smallest angle in degrees of rays to a centre or pole, infinite without any."""
        return least_of(self.rays, len(self), float("inf"))

    @cached_property
    def shortest(self) -> Array:
        """The shortest segment to measure, in mm; infinite where there is none."""
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
        """The limits that one variant breaks, with each thing drawn by itself."""
        return () if self.fair[index] else tuple(self.all_faults(index))

    def all_faults(self, index: int) -> Iterator[Fault]:
        """The limits that one variant breaks. One that does not close or fit has no other fault."""
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
        """The fields that one variant cannot measure, and therefore computes."""
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
    """Judge a block of variants and write the results from index ``start`` on."""
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
            put_forces(found, mechanism, taken(values, which), drawn, own, start + which)


def closing(mechanism: Mechanism, values: Mapping[str, Any], count: int) -> Array:
    """Which variants can be constructed: all values asked are finite, no crossing is singular."""
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
    """Write what is drawn on the sheets of some variants at their indices; scales are arrays."""
    form = found.form
    for sheet in drawn:
        lengths = segment_lengths(sheet, form, scales.kL / scales.metres(sheet.kind))
        put(found.crossings, crossing_angles(sheet), which, len(found))
        put(found.lengths, lengths, which, len(found))
        put(found.triangles, triangle_ratios(sheet), which, len(found))
        put(found.rays, ray_angles(sheet, form), which, len(found))
        put(found.on_page, held(drawn, sheet, form, scales), which, len(found))


def put_forces(
    found: Fairness,
    mechanism: Mechanism,
    values: Mapping[str, Any],
    sheets: Sequence[VariantSheet],
    scales: Scales,
    which: Array,
) -> None:
    """Write the lengths of forces in the polygons of some variants at their indices.

    A variant whose polygons have no room does not fit its page.
    """
    form = [item for item in found.form if item.what == "segment" and motion_of(item) in FORCES]
    if not form:
        return
    program = mechanism.with_forces.program
    drawn = [n for n, step in enumerate(program.steps) if step.plane in (Plane.FORCES, Plane.LEVER)]
    with np.errstate(all="ignore"):
        trace = run_batch(program, program.behind(drawn), values, batch_kind(), drawn)
    extents = ForceExtents.of(trace, lambda points: boxes(points, len(which)))
    stated = mechanism.scene.sheet
    paper = paper_of(stated.paper, stated.frame)
    ends = paper.fields[0] + mechanism_fields(sheets, scales, paper).width
    left, top, right, low = paper.beside((0.0, 0.0, ends, 0.0))
    newton = float(force_in(mechanism.scene.unit_of_results) / force_in(mechanism.scene.base))
    cells = cells_of(extents.in_units(newton))
    kF = newton * smallest(cells, np.broadcast_to(right - left, len(which)), low - top)
    found.fits[which] &= np.isfinite(kF)
    lengths = {}
    for item in form:
        tail, tip = program.steps[program.targets[item.quantity, item.of]].args
        lengths[item.field] = np.abs(trace.values[tip] - trace.values[tail]) / kF
    put(found.lengths, iter(lengths.items()), which, len(found))


def put(
    room: dict[str, Array], found: Iterator[tuple[str, Array]], which: Array, size: int
) -> None:
    """Write arrays of some variants at their indices.

    Of two arrays with one name, the smaller values are kept.
    """
    for name, value in found:
        empty = np.zeros(size, dtype=bool) if np.asarray(value).dtype == bool else None
        array = room.setdefault(name, np.full(size, np.nan) if empty is None else empty)
        array[which] = value if empty is not None else np.fmin(array[which], value)


def least_of(room: Mapping[str, Array], size: int, default: float) -> Array:
    """The least of several arrays for each variant; the default where all are NaN."""
    least = np.full(size, np.nan)
    for array in room.values():
        least = np.fmin(least, array)
    return np.where(np.isnan(least), default, least)
