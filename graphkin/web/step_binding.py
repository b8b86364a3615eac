"""How the marks of steps follow: each by the stroke of the construction that drew it."""

from __future__ import annotations

from msgspec import Struct, field

from graphkin.construction.core.auxiliary_plan import auxiliary_plan
from graphkin.construction.core.kind import construction
from graphkin.construction.core.layout import Layout
from graphkin.construction.core.plan_vector import plan_vector
from graphkin.drawing.marks import Mark
from graphkin.numbers.plane import Vector
from graphkin.web.field_binder import Binding, FieldBinder, only_at_start
from graphkin.web.moving_canvas import MovingCanvas, Stroke


class StepStrokes(Struct, frozen=True):
    """The steps of one field, each drawn in traced numbers as it is drawn on paper."""

    binder: FieldBinder
    layout: Layout
    drawn: dict[int, MovingCanvas] = field(default_factory=dict)

    def canvas(self, number: int) -> MovingCanvas:
        """The strokes of a step; none where its construction is not whole."""
        if number not in self.drawn:
            self.drawn[number] = canvas = MovingCanvas(self.binder, self.layout, number)
            known = self.binder.places.values
            if number in known:
                kind, value = construction(canvas.step), known[number]
                plan = auxiliary_plan(canvas.drawing, number)
                if kind is not None and kind.is_whole(known):
                    kind.marks(canvas, canvas.step.role)
                if plan is not None:
                    plan.marks(canvas, number)
                elif isinstance(value, Vector):
                    canvas.vector(canvas.step.name, "", value.tail, value.tip)
                    if vector := plan_vector(canvas.step):
                        canvas.point("", value.tail if vector.back else value.tip)
        return self.drawn[number]

    def stroke(self, mark: Mark) -> Stroke | None:
        """The stroke that drew a mark of a step; None of what is drawn on paper alone."""
        assert mark.step is not None
        strokes = self.canvas(mark.step).strokes
        return strokes[mark.part] if mark.part < len(strokes) else None

    def binding(self, mark: Mark) -> Binding:
        """How a mark of a step follows; what is drawn on paper alone holds for that position."""
        stroke = self.stroke(mark)
        if stroke is None:
            return only_at_start
        return stroke.head if mark.cls.startswith("arrowhead") else stroke.mark

    def label(self, mark: Mark) -> Binding:
        """How the label of a step follows."""
        stroke = self.stroke(mark)
        return only_at_start if stroke is None else stroke.label
