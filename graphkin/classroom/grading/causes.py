"""Causes in the construction: what a student draws who takes one thing of the task wrongly.

A cause changes a few steps; the construction is then run again from these, for all variants that
draw alike at once. Names of causes in components come from the kinds' own records.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from functools import cached_property, partial
from itertools import groupby
from math import pi
from typing import Any, NamedTuple

from msgspec import Struct
from msgspec.structs import astuple, replace

from graphkin.accuracy.pencil import (
    SCALES,
    STRAIGHT,
    Paper,
    Pencil,
    PencilMark,
    mark_of,
    marked,
    together,
)
from graphkin.classroom.grading.end_positions import round_the_turn
from graphkin.classroom.grading.standard import FormLayout, Standard, ruler_unit
from graphkin.construction.core.bases import crank_tip
from graphkin.construction.core.component import component_of
from graphkin.construction.core.crossings import Determined
from graphkin.construction.core.kind import Slip
from graphkin.construction.core.program import Drive, Plane, Step
from graphkin.construction.core.quantities import OMEGA
from graphkin.construction.core.vocabulary import similar_point
from graphkin.construction.higher_class.closure_solver import closer_of
from graphkin.construction.plan import TurningOfLink
from graphkin.construction.registry import SLIPPING, SLIPS
from graphkin.construction.velocity.relative_motion import square_to
from graphkin.mechanism import Mechanism
from graphkin.numbers.arithmetic import np
from graphkin.numbers.plane import Ratio, by_parts
from graphkin.structure.groups import Crank

Value = Any
Get = Callable[[int], Value]
Mend = Callable[[Value, Get], Value]
"""A step's value as a student has it, from its right value and the other steps' values."""
UNITS = {"rpm_as_rad": 30 / pi, "turns_as_rad": 1 / (2 * pi)}
"""The factor on a crank's speed where rev/min, or rev/s, are taken for rad/s."""
MILLIMETRES = {-1: "velocities", -2: "accelerations"}
"""In place of a step's number: the plan a millimetre of which is meant."""
OF_VELOCITIES, OF_ACCELERATIONS = MILLIMETRES
TURNED = 180
"""The positions in a turn by which the travel of a follower is found with a change."""
RAD_AS_RPM = pi / 30
"""The factor on a crank's speed where rad/s are taken for rev/min."""


class Told(NamedTuple):
    """What is written by a cause: sizes, places and senses by student and field.

    ``other`` holds values that are as likely, field by field; NaN for none. ``price`` is the
    logarithm of how likely the choices are that were made to fit each student. ``alone`` marks
    answers that are fitted by a choice of their own, so that they agree whatever they are.
    """

    written: Any
    other: Any = None
    price: Any = 0.0
    alone: Any = None


class Change(Struct, frozen=True):
    """The steps that a cause changes.

    ``mends`` change the values of steps, ``steps`` are drawn otherwise. ``faster`` is the factor
    on the crank's speed by which the scales of the plans follow.
    """

    mends: Mapping[int, Mend] = {}
    steps: Mapping[int, Step] = {}
    faster: float = 1.0

    def and_then(self, other: Change) -> Change | None:
        """Both changes; None where they change the same step."""
        mine, theirs = ({*each.mends, *each.steps} for each in (self, other))
        if not mine.isdisjoint(theirs):
            return None
        return Change(
            {**self.mends, **other.mends},
            {**self.steps, **other.steps},
            self.faster * other.faster,
        )


class Cause(Struct, frozen=True):
    """One thing that a student took wrongly, by its name, and the way in which it was done.

    No two causes of a form have the same name and the same way.
    ``change`` is what it changes in the construction, ``reads`` what it changes in reading and
    computing (:mod:`graphkin.classroom.grading.readings`). ``rare`` is the part of the cause's
    share that the way has.
    """

    name: str
    way: str = ""
    change: Change | None = None
    reads: Callable[..., Any] | None = None
    rare: float = 1.0


def speed_factors(mechanism: Mechanism) -> Mapping[str, float]:
    """The factor on a crank's speed for each cause in its unit."""
    in_turns = mechanism.scene.units.get("speed") == "rev/min"
    return UNITS if in_turns else {"rad_as_rpm": RAD_AS_RPM}


def constructed(standard: Standard) -> tuple[Cause, ...]:
    """Every cause in the construction of a variant, as far as the fields depend on it."""
    mechanism, layout = standard.mechanism, standard.layout
    needed = frozenset(layout.needed)
    found = (
        *of_drivers(mechanism),
        *of_cranks(mechanism),
        *of_sides(layout),
        *of_plates(layout),
        *of_perpendiculars(layout, standard.exact.tails),
        *of_components(layout),
    )
    return tuple(
        each
        for each in found
        if each.change is not None
        and not needed.isdisjoint({*each.change.mends, *each.change.steps})
    )


def times(factor: complex) -> Mend:
    """A value taken ``factor`` times as large; a centre so many times as far from its origin."""

    def taken(value: Value, get: Get) -> Value:
        if isinstance(value, Ratio):
            return value._replace(shift=factor * value.shift)
        return factor * value

    return taken


# --- what the task states: drivers, cranks, sides, plates -----------------------------------------


def of_drivers(mechanism: Mechanism) -> Iterator[Cause]:
    """A driver's angle laid off otherwise, its speed in another unit or sense, no acceleration."""
    every = list(zip(mechanism.scene.drivers, mechanism.program.drives, strict=True))
    turning = [drive for driver, drive in every if driver.kind == "turn"]
    if turning:
        yield laid_off_otherwise("angle_clockwise", turning, lambda way: way.conjugate(), 0.0)
        yield laid_off_otherwise("other_scale_of_protractor", turning, mirrored, pi)
        if mechanism.scene.units.get("angle") == "deg":
            yield Cause("degrees_as_radians", "", Change(in_degrees(turning)))
        for name, ratio in speed_factors(mechanism).items():
            faster = {drive.speed: times(ratio) for drive in turning}
            yield Cause(name, "", Change(faster, faster=ratio))
        back = {drive.speed: times(-1.0) for drive in turning}
        yield Cause("driver_reversed", "", Change(back))
    values = mechanism.scene.values
    hastened = [
        drive
        for driver, drive in every
        if driver.acceleration is not None and float(driver.acceleration.si(values)) != 0
    ]
    if hastened:
        rest = {drive.acceleration: times(0.0) for drive in hastened}
        yield Cause("driver_acceleration_missing", "", Change(rest))


def mirrored(way: Value) -> Value:
    """A direction at 180° − φ."""
    return -way.conjugate()


def laid_off_otherwise(
    name: str, turning: Sequence[Drive], mend: Callable[[Value], Value], start: float
) -> Cause:
    """All cranks laid off in another direction, at an angle counted back from ``start``."""
    mends: dict[int, Mend] = {drive.position: lambda way, get: mend(way) for drive in turning}
    angles = (drive.angle for drive in turning if drive.angle is not None)
    mends |= {number: lambda angle, get: start - angle for number in angles}
    return Cause(name, "", Change(mends))


def in_degrees(turning: Sequence[Drive]) -> dict[int, Mend]:
    """The directions of cranks whose angle in degrees was taken for radians in a cosine."""
    found: dict[int, Mend] = {}
    for drive in turning:
        found[drive.position] = lambda way, get: turned_by(degrees_of(way))
        if drive.angle is not None:
            found[drive.angle] = lambda angle, get: angle * (180 / pi)
    return found


def degrees_of(way: Value) -> Value:
    """The angle of a direction in degrees, from 0 to 360."""
    return np.degrees(np.angle(way)) % 360


def turned_by(angle: Value) -> Value:
    """The direction at an angle in radians."""
    return np.exp(1j * angle)


def of_cranks(mechanism: Mechanism) -> Iterator[Cause]:
    """Cranks drawn twice or half as long: a diameter for a radius, or the reverse."""
    program = mechanism.program
    tips: dict[int, int] = {}
    for group in mechanism.groups:
        tip = crank_tip(mechanism.scene, group) if isinstance(group, Crank) else None
        number = program.targets.get(("position", tip or ""))
        if number is not None and isinstance(group, Crank):
            tips[number] = program.targets["position", group.pivot]

    def longer(pivot: int, ratio: float) -> Mend:
        return lambda tip, get: get(pivot) + ratio * (tip - get(pivot))

    for name, ratio in (("diameter_for_radius", 2.0), ("radius_for_diameter", 0.5)):
        if tips:
            mends = {number: longer(pivot, ratio) for number, pivot in tips.items()}
            yield Cause(name, "", Change(mends))


def of_sides(layout: FormLayout) -> Iterator[Cause]:
    """A pin drawn where its loci meet on the other side: another closure."""
    for number in layout.needed:
        step = layout.program.steps[number]
        if isinstance(step.of, Determined) and step.of.has_mirror and step.extra:
            other = replace(step, extra=tuple(-sign for sign in step.extra))
            yield Cause("other_side", str(number), Change(steps={number: other}))


def of_plates(layout: FormLayout) -> Iterator[Cause]:
    """A plate drawn on the other side of its base, or measured from the base's other end."""
    steps, moving = layout.program.steps, driven(layout)
    shapes = dict.fromkeys(
        step.args[2]
        for step in (steps[number] for number in layout.needed)
        if step.action is similar_point and step.args[2] not in moving
    )

    for number in shapes:
        for name, mend in (
            ("plate_flipped", lambda ratio, get: ratio.conjugate()),
            ("letters_exchanged", lambda ratio, get: 1 - ratio.conjugate()),
        ):
            yield Cause(name, str(number), Change({number: mend}))


def driven(layout: FormLayout) -> frozenset[int]:
    """The steps that depend on the driver's position."""
    roots = (drive.position for drive in layout.program.drives)
    return frozenset().union(*(layout.below(number) for number in roots))


# --- what the student draws: perpendiculars and components ----------------------------------------


def of_perpendiculars(layout: FormLayout, tails: Mapping[int, int]) -> Iterator[Cause]:
    """The parallel to a bar drawn for the perpendicular: in the plans, or in one of them.

    The bar's rate is then computed from an arrow along the bar, which turns it neither way.
    """
    steps = layout.program.steps
    bars: dict[tuple[int, ...], list[int]] = {}
    for number in layout.needed:
        if steps[number].action is square_to:
            bars.setdefault(steps[number].args[1:], []).append(number)

    def turned(line: Value, get: Get) -> Value:
        return line._replace(along=1j * line.along)

    for bar, lines in bars.items():
        ways = {tuple(lines), *((number,) for number in lines)}
        for way in sorted(ways, key=len, reverse=True):
            rates = list(rates_along(layout, bar, {steps[number].plane for number in way}))
            mends: dict[int, Mend] = dict.fromkeys(way, turned)
            mends |= {number: whole_arrow(steps[number], tails.get(number)) for number in rates}
            detail = f"{bar[0]}-{bar[1]} {len(way)}:{way[0]}"
            reads = without_sense(layout, rates) if rates else None
            yield Cause("parallel_for_perpendicular", detail, Change(mends), reads)


def rates_along(layout: FormLayout, bar: Sequence[int], plans: Collection[Plane]) -> Iterator[int]:
    """The steps that compute the rates of a bar from some of the plans."""
    for number in layout.needed:
        step = layout.program.steps[number]
        if isinstance(step.of, TurningOfLink) and {*step.args[:2]} == {*bar}:
            plan = Plane.VELOCITIES if step.of.quantity == OMEGA else Plane.ACCELERATIONS
            if plan in plans:
                yield number


def whole_arrow(step: Step, tail: int | None) -> Mend:
    """A rate computed from the length of the arrow that was drawn, whatever its direction."""
    p, q, start, tip = step.args

    def computed(rate: Value, get: Get) -> Value:
        return abs(get(tip) - get(start if tail is None else tail)) / abs(get(q) - get(p))

    return computed


def without_sense(layout: FormLayout, rates: Collection[int]) -> Callable[..., Any]:
    """Senses that the drawing leaves open."""
    probes = layout.probes
    mask = np.array([probe.item.what == "sense" and probe.step in rates for probe in probes])

    def reads(shown: Any, *rest: Any) -> Told:
        return Told(np.where(mask, 0.0, shown))

    return reads


def of_components(layout: FormLayout) -> Iterator[Cause]:
    """Slips in components, centres and forces: in all of a kind, or in one."""
    steps = layout.program.steps
    for name in SLIPS:
        mends = {
            number: partial(slip.value, step.of)
            for number in layout.needed
            if (slip := slip_at(step := steps[number], name)) is not None
        }
        alone = [[*own] for _, own in groupby(mends, lambda number: id(steps[number].of))]
        for way in [[*mends], *(alone if len(alone) > 1 else [])] if mends else []:
            detail = str(way[0]) if len(way) < len(mends) else ""
            yield Cause(name, detail, Change({number: mends[number] for number in way}))


def slip_at(step: Step, name: str) -> Slip | None:
    """The slip of a name in the construction of a step, if that step is its result."""
    for kind in SLIPPING:
        slip = kind.slips.get(name) if isinstance(step.of, kind) else None
        if slip is not None and slip.meets(step):
            return slip
    return None


Misread = Callable[[Value, Value], Value]
"""The factor of a length, from its real size and from what a millimetre of its plan is worth."""


def laid_anew(layout: FormLayout, misread: Misread, laid: Misread | None = None) -> Change:
    """Components computed from velocities that were misread, each by a factor.

    ``laid`` gives the factor of a length that is laid off in the acceleration plan.
    """
    program = layout.program
    mends: dict[int, Mend] = {}
    for number in layout.needed:
        component = component_of(program, number)
        if component is None:
            continue
        tail, tip = program.steps[number].args[-2:]

        def mend(value: Value, get: Get, tail: int = tail, tip: int = tip) -> Value:
            computed = value * misread(abs(get(tip) - get(tail)), get(OF_VELOCITIES)) ** 2
            return computed if laid is None else computed * laid(computed, get(OF_ACCELERATIONS))

        mends[number] = mend
    return Change(mends)


# --- variants side by side ------------------------------------------------------------------------


class Variants(Struct, frozen=True, dict=True):
    """Some variants that draw alike, whose values are arrays with a row for each."""

    standards: Sequence[Standard]

    @cached_property
    def layout(self) -> FormLayout:
        """The form, which all share."""
        return self.standards[0].layout

    @cached_property
    def fields(self) -> tuple[str, ...]:
        """The fields of the form, senses too."""
        return tuple(item.field for item in self.layout.items)

    @cached_property
    def values(self) -> Mapping[int, Value]:
        """The right values of all steps that the fields need."""
        found = dict(together([each.exact for each in self.standards]).trace.values)
        missing = [number for number in self.layout.needed if number not in found]
        for number in missing:
            step = self.layout.program.steps[number]
            if step.given is None and step.action is not None:
                args = (found[arg] for arg in step.args)
                found[number] = step.action.value(*args, *step.extra)
        return found

    @cached_property
    def paper(self) -> Paper:
        """The scale factors, in columns."""
        papers = [each.paper for each in self.standards]
        names = Paper.__struct_fields__
        columns: list[Any] = [np.array([[getattr(p, name)] for p in papers]) for name in names]
        return Paper(*columns)

    @cached_property
    def units(self) -> Any:
        """A millimetre on the ruler in the unit of each field; zero for senses."""
        return np.array([[millimetre(each, i) for i in self.places] for each in self.standards])

    @property
    def places(self) -> range:
        """The places of the fields."""
        return range(len(self.fields))

    @cached_property
    def key(self) -> Any:
        """The right value of each field, a row for each variant."""
        return np.array([[each.key[field] for field in self.fields] for each in self.standards])

    def changed(self, change: Change) -> dict[int, Value] | None:
        """The values of the steps that a change moves; None where nothing can be drawn."""
        found = self.moved(change, self.layout.needed, {})
        return found if found is None else {**found, **self.travel_with(change)}

    def travel_with(self, change: Change) -> Mapping[int, Value]:
        """The strokes, swings and time ratios with a change, over a whole turn of the driver."""
        layout, touched = self.layout, {*change.mends, *change.steps}
        again: dict[int, Value] = {}
        for field, places in layout.places.items():
            begun = whole_turn(layout.program.drives[0])
            some = layout.program.behind(places)
            recurs = all(each.travel[field].recurs for each in self.standards)
            if not recurs or self.closes or (touched - begun.keys()).isdisjoint(some):
                continue
            moved = self.moved(change, some, begun)
            if moved is not None:
                probe, shape = layout.by_field[field], (len(self.standards), TURNED)
                every = {**self.values, **moved}
                rows = [np.broadcast_to(every[n], shape) for n in places]
                again[probe.step] = round_the_turn(probe.item.quantity, rows)
        return again

    def moved(
        self, change: Change, some: Sequence[int], begun: Mapping[int, Value]
    ) -> dict[int, Value] | None:
        """The values of some steps that a change moves, or that follow from others ``begun``."""
        steps, values = self.layout.program.steps, self.values
        found = dict(begun)

        def get(number: int) -> Value:
            if number in MILLIMETRES:
                return getattr(self.paper, MILLIMETRES[number]) / 1000
            return found[number] if number in found else values[number]

        try:
            with np.errstate(all="ignore"):
                for number in some:
                    if number in begun:
                        continue
                    step = change.steps.get(number, steps[number])
                    moved = number in change.steps or not found.keys().isdisjoint(step.args)
                    if not moved and number not in change.mends:
                        continue
                    value = values[number]
                    if moved and step.action is not None:
                        value = step.action.value(*(get(arg) for arg in step.args), *step.extra)
                    mend = change.mends.get(number)
                    found[number] = value if mend is None else mend(value, get)
        except (ZeroDivisionError, ValueError, OverflowError):
            return None
        return found

    def read(self, found: Mapping[int, Value], faster: float = 1.0) -> Any:
        """Every field as read off the construction with some values changed; rates have a sign.

        The plans of a crank ``faster`` than it is keep their size where the crank sets their scale.
        """
        paper = self.paper_of(faster)
        every = {**self.values, **found}
        shape = len(self.standards), len(self.fields)
        readings = np.empty(shape)
        for place, probe in enumerate(self.layout.probes):
            value = np.real(np.asarray(probe.read(every, paper), dtype=complex))
            column = np.broadcast_to(value, (shape[0], 1))[:, 0]
            readings[:, place] = np.sign(column) if probe.item.what == "sense" else column
        return readings

    def paper_of(self, faster: float) -> Paper:
        """The scale factors of a crank so many times as fast, where the crank sets them."""
        paper = self.paper
        if faster == 1.0:
            return paper
        by_crank: Any = np.array([[float(bool(each.scales.of_crank))] for each in self.standards])
        ratio = faster**by_crank
        return replace(
            paper,
            velocities=paper.velocities * ratio,
            accelerations=paper.accelerations * ratio**2,
        )

    # --- how far off a drawing is -----------------------------------------------------------------

    @cached_property
    def marks(self) -> Mapping[int, PencilMark]:
        """The mark that each step puts on paper, composite steps by their result."""
        steps = self.layout.program.steps
        found = {n: mark_of(steps[n], first_of(self.values[n])) for n in self.layout.needed}
        known = {n: mark for n, mark in found.items() if mark not in (None, PencilMark.CLOSING)}
        return {n: mark for n, mark in known.items() if mark is not None and not steps[n].arrow}

    @cached_property
    def single_errors(self) -> Mapping[int, Any]:
        """The errors of each mark in drawings with one error each; the last drawing has none."""
        count = sum(mark.errors for mark in self.marks.values())
        found, start = {}, 0
        for number, mark in self.marks.items():
            found[number] = np.eye(count + 1)[:, start : start + mark.errors]
            start += mark.errors
        return found

    def deviations(self, change: Change, rows: Any) -> Any:
        """The deviation of each field in drawings of some variants with a change, for one pencil.

        A row for each variant; senses are zero. The pencil is the one that is forgiven. NaN where
        the construction closes a group of higher class, whose drawings have no errors here.
        """
        rubric = self.standards[0].rubric
        count = sum(mark.errors for mark in self.marks.values()) + 1
        shape = len(rows), count
        if self.closes:
            return np.full((len(rows), len(self.fields)), np.nan)
        pencil = Pencil(rubric.point, rubric.line)
        paper = repeated(self.paper_of(change.faster), rows, count)
        found = self.redrawn(change, rows, pencil, paper)
        deviations = np.zeros((len(rows), len(self.fields)))
        for place, probe in enumerate(self.layout.probes):
            if probe.item.what != "sense":
                value = np.real(np.asarray(probe.read(found, paper), dtype=complex))
                each = np.broadcast_to(value, (len(rows) * count,)).reshape(shape)
                off = each - each[:, -1:]
                deviations[:, place] = np.sqrt(np.sum(off * off, axis=1))
        for field in self.standards[0].travel:
            own = [self.standards[row].travel[field].pencil / STRAIGHT for row in rows]
            deviations[:, self.fields.index(field)] = own
        return deviations

    @property
    def closes(self) -> bool:
        """Whether the construction closes a group of higher class by trials."""
        return any(closer_of(self.layout.program.steps[n]) is not None for n in self.layout.needed)

    def redrawn(
        self, change: Change, rows: Any, pencil: Pencil, paper: Paper
    ) -> Mapping[int, Value]:
        """The values of the steps of some variants with a change, drawing by drawing."""
        steps, count = self.layout.program.steps, len(next(iter(self.single_errors.values())))
        values = {n: repeated(self.values[n], rows, count) for n in self.values}
        found: dict[int, Value] = {}

        def get(number: int) -> Value:
            if number in MILLIMETRES:
                return getattr(paper, MILLIMETRES[number]) / 1000
            return found[number] if number in found else values[number]

        for number in self.layout.needed:
            step, value = change.steps.get(number, steps[number]), values[number]
            moved = number in change.steps or not found.keys().isdisjoint(step.args)
            mend, mark = change.mends.get(number), self.marks.get(number)
            if not moved and mend is None and mark is None:
                continue
            if moved and step.action is not None:
                value = step.action.value(*(get(arg) for arg in step.args), *step.extra)
            value = value if mend is None else mend(value, get)
            if mark is not None:
                start = get(step.args[0]) if mark is PencilMark.ARROW and step.args else value
                start = start if is_place(start) else value
                mm = paper.millimetre(step.plane)
                errors = np.tile(self.single_errors[number], (len(rows), 1))
                value = marked(mark, value, start, errors, pencil, mm)
            found[number] = value
        return {**values, **found}


def whole_turn(drive: Drive) -> dict[int, Value]:
    """The steps of a driver that turns, in equal steps of a whole turn: (1, M)."""
    angles = np.linspace(0.0, 2 * pi, TURNED, endpoint=False)[None]
    begun: dict[int, Value] = {drive.position: turned_by(angles)}
    return begun if drive.angle is None else {**begun, drive.angle: angles}


def first_of(value: Value) -> Any:
    """The value of the first variant."""
    if isinstance(value, tuple):
        return by_parts(first_of, value)
    return np.ravel(value)[0].item() if isinstance(value, np.ndarray) else value


def repeated(value: Value, rows: Any, count: int) -> Any:
    """The values of some variants, each so many times; a value that all share stays single."""
    if isinstance(value, Paper):
        return Paper(*(repeated(each, rows, count) for each in astuple(value)))
    if isinstance(value, tuple):
        return by_parts(lambda part: repeated(part, rows, count), value)
    if isinstance(value, np.ndarray) and value.ndim > 1:
        return np.repeat(value[rows, 0], count)
    return value


def is_place(value: Value) -> bool:
    """Whether a value is a point, or many of them."""
    return isinstance(value, complex | np.ndarray)


def millimetre(standard: Standard, place: int) -> float:
    """A millimetre on the ruler in the unit of a field; zero for a sense."""
    probe = standard.layout.probes[place]
    if probe.item.what == "sense":
        return 0.0
    return float(ruler_unit(next(r for r in standard.readings if r.probe is probe)))


def plan_of(layout: FormLayout, place: int) -> int:
    """The plan by whose scale a field is computed, as an index in ``SCALES``."""
    probe = layout.probes[place]
    return 0 if probe.item.what == "place" else SCALES.index(probe.plane)
