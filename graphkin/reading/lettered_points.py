"""The lettered points of a student's sheet, and the lines, bars and arrows that meet at each.

The points are in the order of the construction.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property
from itertools import combinations
from typing import Any

from msgspec import Struct

from graphkin.accuracy.pencil import Original, Paper
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import construction, constructions
from graphkin.construction.core.layout import Layout, lay_out
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.vocabulary import join, similar_point
from graphkin.construction.forces.polygon import DrawnSide, InPolygon
from graphkin.construction.guides.guides import GuideLine
from graphkin.construction.higher_class.two_trials import TwoTrials
from graphkin.drawing.field import Field
from graphkin.drawing.marks import Page
from graphkin.numbers.plane import Circle, Line, Ratio, Vector

LETTERED = (Part.POSITION, Part.VELOCITY, Part.ACCELERATION, Part.CENTRE, Part.POLE)
"""The parts of the construction whose points are read."""
SHORT = 3.0
"""A line's first millimetres from a point give no evidence about it."""
EXACT = 1e-6
"""A line passes exactly through a point if it is this close, in mm."""
LONGEST = 420.0
"""Lines longer than the paper, in mm, end off the paper."""
AHEAD = 40.0
"""How far, in mm, a line that begins at the point itself is searched."""


class Leading(Struct, frozen=True):
    """A line that helps to locate a point, by the step at its far end.

    That step is a point, or a line that begins there.

    - ``given``: the line is printed.
    - ``bow``: it is a compass arc.
    - ``after``: it is drawn through or from the point once the point exists.
    - ``arrow``: it is a vector that begins or ends at the point and does not go on.
    - ``back``: the far end is the tail of a vector.
    - ``light``: it is a side of a similar triangle, which need not be drawn when dividers are used.
    """

    far: int
    given: bool = False
    bow: bool = False
    after: bool = False
    arrow: bool = False
    back: bool = False
    light: bool = False


class Arrow(Struct, frozen=True):
    """An arrow of the plan: its step, the step of its tail if that is a point, and of its tip."""

    step: int
    tail: int | None
    tip: int


class LetteredSheet(Struct, frozen=True, dict=True):
    """A student's sheet as it should be drawn, and the page that was printed for it.

    On a sheet of forces, the points are the corners of polygons, named by the sides that end there.
    """

    drawing: Drawing
    page: Page

    @property
    def kind(self) -> str:
        """``velocity``, ``acceleration`` or ``force``."""
        return self.drawing.kind

    @cached_property
    def layout(self) -> Layout:
        return lay_out(self.drawing)

    @cached_property
    def exact(self) -> Original:
        """The construction without drawing errors."""
        scales = self.drawing.scales
        paper = Paper.of(scales)
        return Original(self.drawing.trace, paper, (), scales.triangles)

    def field(self, number: int) -> Field:
        """The field in which a step is drawn."""
        return self.layout.field(self.exact.program.steps[number])

    def place(self, number: int, value: Any) -> Any:
        """Where a step's value is on paper (complex mm, y down); for a line, where it begins."""
        if isinstance(value, Ratio):
            value = value.start + value.shift / value.size
        elif isinstance(value, Line):
            value = value.point
        elif isinstance(value, Circle):
            value = value.centre
        elif isinstance(value, Vector):
            value = value.tip
        field = self.field(number)
        shift = (value - field.middle) * field.mm
        return complex(*field.at) + shift.conjugate()

    def value(self, number: int, place: complex) -> Any:
        """The value of a step that is at a place of the paper."""
        field = self.field(number)
        found = (place - complex(*field.at)).conjugate() / field.mm + field.middle
        exact = self.exact.trace.values[number]
        return Ratio(found, 0j, 1.0) if isinstance(exact, Ratio) else found

    @cached_property
    def points(self) -> tuple[int, ...]:
        """The steps of the points that are read, in the order of the construction."""
        return tuple(number for number in self.exact.order if self.is_read(number))

    @cached_property
    def found_by(self) -> Mapping[int, int]:
        """The points that are read, by the steps that construct them by hand."""
        hands = {self.exact.by_hand(number): number for number in self.points}
        return {hand: number for hand, number in hands.items() if hand is not None}

    @cached_property
    def order(self) -> tuple[int, ...]:
        """The steps that drawing errors affect, each point directly after its construction by hand.

        Rates of trial plans are left out: they are printed and do not follow from what was read.
        """
        apart = set(self.found_by.values())
        for trials in constructions(self.exact.program, TwoTrials):
            apart.update(trials.rates)
        return tuple(
            number
            for step in self.exact.order
            if step not in apart
            for number in (step, self.found_by.get(step))
            if number is not None
        )

    @cached_property
    def sources(self) -> Mapping[int, frozenset[int]]:
        """The steps from which each step that drawing errors affect is drawn."""
        steps, exact = self.exact.program.steps, self.exact
        found = {}
        for number in self.order:
            hand, tail = exact.by_hand(number), exact.tails.get(number)
            args = {hand} if hand is not None else {*steps[number].args, tail}
            found[number] = frozenset(arg for arg in args if arg is not None)
        return found

    @cached_property
    def corners(self) -> tuple[int, ...]:
        """The steps of the plan's corners without a letter of their own.

        They are ends of components from which lines are drawn, and points of auxiliary plans.
        """
        steps, values = self.exact.program.steps, self.exact.trace.values
        lettered = {*self.points, *self.short}
        return tuple(
            number
            for number in self.exact.order
            if steps[number].plane is self.drawing.plane
            and isinstance(values[number], complex)
            and number not in lettered
            and steps[number].args
            and (not steps[number].name or steps[number].aside is not None)
            and any(steps[other].arrow and number in steps[other].args for other in values)
        )

    def is_read(self, number: int) -> bool:
        """Whether a step is a lettered point of this sheet that is constructed by hand."""
        step, value = self.exact.program.steps[number], self.exact.trace.values[number]
        own = step.plane is self.drawing.plane or number in self.on_mechanism
        lettered = bool(step.name) and step.aside is None and step.part in LETTERED
        lettered |= number in self.ended and number not in self.short
        if not (own and lettered and step.args and step.given is None and not step.arrow):
            return False
        if isinstance(value, Ratio):
            place = self.drawing.place(value)
            return place is not None and self.field(number).holds(place, 2.0)
        return isinstance(value, complex)

    @cached_property
    def sides(self) -> tuple[tuple[int, DrawnSide], ...]:
        """The sides of polygons of forces, each with the step with which it is drawn."""
        found = list[tuple[int, DrawnSide]]()
        for number, step, _ in self.drawing.steps(self.drawing.plane):
            if isinstance(kind := construction(step), InPolygon):
                found += [(number, each) for each in kind.sides_at(step.role)]
        return tuple(found)

    @cached_property
    def ended(self) -> Mapping[int, DrawnSide]:
        """The first side that ends at each corner of a polygon of forces, in order."""
        found = dict[int, DrawnSide]()
        for _, side in self.sides:
            if self.exact.program.steps[side.tip].args:
                found.setdefault(side.tip, side)
        return found

    @cached_property
    def short(self) -> Mapping[int, DrawnSide]:
        """Those of them that are too short to be seen, so that nothing is read of their ends.

        The student's corner is taken to be where the side puts it.
        """
        values = self.exact.trace.values
        return {
            tip: side
            for tip, side in self.ended.items()
            if abs(values[tip] - values[side.tail]) * self.field(tip).mm < 2 * SHORT
        }

    def name(self, number: int) -> str:
        """The letter of a point, or the symbol of the side that ends there."""
        side = self.ended.get(number)
        return str(self.exact.program.steps[number].name) if side is None else side.name

    @cached_property
    def on_mechanism(self) -> frozenset[int]:
        """The steps that this sheet draws on the mechanism, which is drawn anew on each sheet."""
        places = (
            n for n, step, _ in self.drawing.steps(Plane.MECHANISM) if step.part is Part.POSITION
        )
        return frozenset((*places, *(number for number, _, _ in self.drawing.on_mechanism)))

    @cached_property
    def leading(self) -> Mapping[int, tuple[Leading, ...]]:
        """The lines that help to locate each point that is read."""
        return {
            number: tuple(dict.fromkeys(self.led(number)))
            for number in (*self.points, *self.corners)
        }

    @cached_property
    def key_lines(self) -> tuple[tuple[float, float, float, float], ...]:
        """The lines to the points in the key, as x1, y1, x2, y2 in mm, to compare drawings with."""
        values, found = self.exact.trace.values, dict[tuple[float, float, float, float], None]()
        for number, every in self.leading.items():
            end = complex(self.place(number, values[number]))
            for each in every:
                start = complex(self.place(each.far, values[each.far]))
                far = each.given or each.bow or each.after or abs(end - start) < SHORT
                if not far and abs(end - start) < LONGEST:
                    x, y = round(start.real, 2), round(start.imag, 2)
                    found[x, y, round(end.real, 2), round(end.imag, 2)] = None
        return tuple(found)

    def led(self, number: int) -> Iterator[Leading]:
        """The lines that help to locate a point: its own lines first, then arrows, then bars."""
        steps, values = self.exact.program.steps, self.exact.trace.values
        hand = steps[number].by_hand
        for way in (number, hand) if hand is not None and hand in values else (number,):
            for arg in steps[way].args:
                if isinstance(values.get(arg), Line) and steps[arg].plane is steps[number].plane:
                    yield Leading(arg, self.is_given(arg))
                elif isinstance(values.get(arg), Circle):
                    yield Leading(arg, bow=True)
        yield from (Leading(line, given=True) for line in self.printed_through(number))
        ends = set[int]()
        for tail, tip in self.vectors:
            if number in (tail, tip) and steps[tail].plane is steps[number].plane:
                ends.add(tip if number == tail else tail)
                yield Leading(tip if number == tail else tail, arrow=True)
        if steps[number].action is similar_point and hand not in values:
            corners = steps[number].args[:2]
            for corner in corners:
                yield Leading(corner, light=corner not in ends and bool(ends & set(corners)))
        yield from (Leading(far) for far in self.bars.get(number, ()))
        yield from self.after(number)

    def printed_through(self, number: int) -> Iterator[int]:
        """The printed guides through a point of a moving link, however the point is constructed."""
        steps, values = self.exact.program.steps, self.exact.trace.values
        own = values[number]
        if steps[number].plane is Plane.MECHANISM and isinstance(own, complex):
            for line in self.guides:
                value = values[line]
                beside = ((own - value.point) * value.along.conjugate()).imag / abs(value.along)
                if abs(beside) * self.field(number).mm < EXACT and self.is_given(line):
                    yield line

    @cached_property
    def vectors(self) -> tuple[tuple[int, int], ...]:
        """The tail and tip points of each vector that joins two points."""
        steps = self.exact.program.steps
        joined = (steps[n] for n in self.exact.trace.values if steps[n].action is join)
        arrows = ((step.args[0], step.args[1]) for step in joined if step.arrow)
        return (*arrows, *((side.tail, side.tip) for _, side in self.sides))

    @cached_property
    def arrows(self) -> tuple[Arrow, ...]:
        """The arrows of the plan that end at points that are read, components included."""
        steps, values = self.exact.program.steps, self.exact.trace.values
        found = []
        for number, value in values.items():
            step = steps[number]
            if step.arrow and step.plane is self.drawing.plane and isinstance(value, Vector):
                tips = [n for n in step.args if n in self.points and self.is_at(n, value.tip)]
                tails = [
                    n
                    for n in (*step.args, *self.points, *self.corners)
                    if self.is_at(n, value.tail)
                ]
                found += [Arrow(number, next(iter(tails), None), tip) for tip in tips[:1]]
        sides = ((number, side) for number, side in self.sides if side.tip in self.points)
        return (*found, *(Arrow(number, side.tail, side.tip) for number, side in sides))

    def is_at(self, number: int, place: complex) -> bool:
        """Whether a step of the plan is a point at a place of the plan."""
        value = self.exact.trace.values.get(number)
        if not isinstance(value, complex):
            return False
        same = self.exact.program.steps[number].plane is self.drawing.plane
        return same and abs(value - place) * self.field(number).mm < EXACT

    def after(self, number: int) -> Iterator[Leading]:
        """The lines drawn through a point once it exists, and the vectors laid off from it."""
        steps, values = self.exact.program.steps, self.exact.trace.values
        own = values[number]
        if not isinstance(own, complex):
            return
        later = self.exact.program.descendants(number)
        for other, value in values.items():
            step = steps[other]
            here = step.plane is self.drawing.plane or other in self.on_mechanism
            if other not in later or step.plane is not steps[number].plane or not here:
                continue
            if isinstance(value, Line):
                beside = ((own - value.point) * value.along.conjugate()).imag / abs(value.along)
                if abs(beside) * self.field(number).mm < EXACT:
                    yield Leading(other, after=True)
            elif isinstance(value, Vector) and step.action is not join:
                for end, back in ((value.tail, False), (value.tip, True)):
                    if abs(end - own) * self.field(number).mm < EXACT:
                        yield Leading(other, after=True, back=back)

    def is_given(self, number: int) -> bool:
        """Whether a line is a printed guide, so that nothing of it was drawn."""
        steps, pending = self.exact.program.steps, [number]
        while pending:
            step = steps[pending.pop()]
            if step.plane not in (Plane.MECHANISM, Plane.NUMBERS):
                return False
            if step.part is not Part.POSITION or step.name in self.moving:
                return False
            pending += step.args
        return steps[number].plane is Plane.MECHANISM and number in self.guides

    @cached_property
    def guides(self) -> frozenset[int]:
        """The lines of the mechanism that are guides of the frame."""
        steps = self.exact.program.steps
        return frozenset(
            number
            for number, value in self.exact.trace.values.items()
            if isinstance(value, Line) and isinstance(steps[number].of, GuideLine)
        )

    @cached_property
    def moving(self) -> frozenset[str]:
        """The names of the points of moving links."""
        scene = self.drawing.scene
        fixed = set(scene.fixed_points)
        every = {point for link in scene.links.values() for point in link.points}
        return frozenset(every - fixed)

    @cached_property
    def bars(self) -> Mapping[int, tuple[int, ...]]:
        """For each point of the mechanism, the other points of its links."""
        targets, found = self.exact.program.targets, dict[int, list[int]]()
        for link in self.drawing.scene.links.values():
            numbers = [targets.get(("position", point)) for point in link.points]
            there = [n for n in numbers if n is not None and n in self.exact.trace.values]
            for one, other in combinations(there, 2):
                found.setdefault(one, []).append(other)
                found.setdefault(other, []).append(one)
        return {number: tuple(others) for number, others in found.items()}
