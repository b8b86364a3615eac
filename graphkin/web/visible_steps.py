"""What of the steps of a field is large enough, or near enough, to be seen at a place."""

from __future__ import annotations

from typing import Any

from msgspec import Struct, field

from graphkin.construction.core.auxiliary_plan import auxiliary_plan
from graphkin.construction.core.component import TriangleComponent
from graphkin.construction.core.kind import construction
from graphkin.construction.core.layout import Layout
from graphkin.construction.core.plot import Plot
from graphkin.construction.core.program import Plane, Step
from graphkin.drawing.labels import FieldContent
from graphkin.numbers.arithmetic import smaller
from graphkin.web.field_binder import FieldBinder
from graphkin.web.moving_canvas import MovingCanvas

ALIKE = 1e-6
"""Millimetres within which two places of the page are one."""


class VisibleSteps(Struct, frozen=True):
    """The steps of one field, as they are drawn and while they move."""

    binder: FieldBinder
    layout: Layout
    parts: dict[int, MovingCanvas] = field(default_factory=dict)

    @property
    def plot(self) -> Plot:
        """The field as paper knows it, without any marks."""
        board = FieldContent(self.binder.field.rect)
        return Plot(board, self.binder.field, self.binder.places.drawing, self.layout)

    def step(self, number: int) -> Step:
        """A step of the program."""
        return self.binder.places.trace.program.steps[number]

    def key(self, number: int) -> str:
        """The key of its action."""
        action = self.step(number).action
        return action.key if action else "given"

    def value(self, number: int) -> Any:
        """Its value while it moves."""
        return self.binder.places.values[number]

    def drawn(self, number: int) -> Any:
        """Its value where the scene stands."""
        return self.binder.places.drawing.trace.values[number]

    def seen(self, number: int) -> Any:
        """By how much a triangle on the mechanism is larger than what is drawn at all, in mm.

        None for what belongs to none.
        """
        step, kind = self.step(number), construction(self.step(number))
        if not isinstance(kind, TriangleComponent) or step.plane is not Plane.MECHANISM:
            return None
        return kind.room(MovingCanvas(self.binder))

    def part_of(self, number: int) -> MovingCanvas:
        """What the marks of a step that is part of a construction are drawn from."""
        if number not in self.parts:
            self.parts[number] = canvas = MovingCanvas(self.binder)
            step, kind = self.step(number), construction(self.step(number))
            known = self.binder.places.values
            plan = auxiliary_plan(self.binder.places.drawing, number)
            if kind is not None and number in known and kind.is_whole(known):
                kind.marks(canvas, step.role)
            if plan is not None and number in known:
                plan.marks(canvas, number)
        return self.parts[number]

    def apart(self, one: Any, other: Any) -> Any:
        """How far two points stand apart on the page, in mm."""
        return abs(self.binder.tape.lifted(one - other)) * self.binder.field.mm

    def within(self, point: Any, margin: float = 2.0) -> Any:
        """How far a point lies within what the field can grow to, less a margin, in mm."""
        left, top, right, bottom = self.binder.room
        place = self.binder.page(point)
        x, y = place.real, place.imag
        across = smaller(x - left, right - x)
        return smaller(across, smaller(y - top, bottom - y)) - margin + ALIKE
