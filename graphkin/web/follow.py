"""How every mark of a field follows the driver: bodies, steps, and the labels beside them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from typing import Any

from msgspec import Struct

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.layout import Layout
from graphkin.construction.core.plot import above_foot, stretched
from graphkin.construction.core.solution import Curve
from graphkin.drawing.marks import LineMark, Mark, Text, style_class
from graphkin.numbers.plane import Line as Carrier
from graphkin.numbers.plane import Ratio
from graphkin.web.body_binding import StepStrokes, line_to_edge, mechanism_bindings
from graphkin.web.field_binder import Binding, FieldBinder, Record, Told, only_at_start, still
from graphkin.web.field_extents import must_be_seen

LABELS = ("label", "number", "leader")
"""The classes of a letter and of the circle and the leader that go with it."""
FIXED = ("caption", "guide", "ground", "fixed-pivot", "title", "panel")
"""The classes of marks that stay, where nothing else is known of them."""
ACROSS = "centre-line"
"""The class of lines that go across a whole field, where no driver draws them."""


class MarkBindings(Struct, frozen=True, dict=True):
    """The marks of one field, each with how it follows."""

    binder: FieldBinder
    layout: Layout
    marks: Sequence[Mark]
    angles: Mapping[str, Any]
    """The angles in degrees of the links that drivers turn."""

    @property
    def drawing(self) -> Drawing:
        """The sheet's material."""
        return self.binder.places.drawing

    @cached_property
    def steps(self) -> StepStrokes:
        """The steps of this field."""
        return StepStrokes(self.binder, self.layout)

    @cached_property
    def on_mechanism(self) -> bool:
        """Whether this is the field of the mechanism."""
        return self.binder.field is self.layout.mechanism

    @cached_property
    def bodies(self) -> Told:
        """The marks of bodies and drivers."""
        if not self.on_mechanism:
            return {}
        return mechanism_bindings(self.binder, self.angles)

    @cached_property
    def curves(self) -> Mapping[str, Curve]:
        """The curves of the whole motion by the names of their marks; not the locus of a group that
        is tried, which is another at each place."""
        return {curve.name: curve for curve in self.drawing.curves if curve.kind != "locus"}

    def records(self) -> Iterator[tuple[int, Record]]:
        """The record of every mark that moves, with the mark's number in the field."""
        for k, mark in enumerate(self.marks):
            record = self.binding(k, mark)(mark)
            if record is not None:
                yield k, record

    def in_sight(self, mark: Mark, record: Record) -> bool:
        """Whether what is at a mark's place must be in sight: all but what may be endlessly far, as
        are centres, poles and the lines to them."""
        if record[0] in "sioa" or not must_be_seen(mark):
            return False
        value = None if mark.step is None else self.drawing.trace.values.get(mark.step)
        if isinstance(value, Carrier):
            return not self.on_mechanism
        return not isinstance(value, Ratio)

    def sides(self, k: int, record: Record) -> int:
        """Whether a label can as well stand on the other side of what it names: that of a vector or
        a line, or a letter at a point; 2 where a leader leads to it, 0 for one in a circle."""
        led = {style_class(self.marks[j]) for j in self.led(k)}
        if "number" in led or not (record[0] == "b" or self.is_upright(record)):
            return 0
        return 2 if led else 1

    def going_before(self, k: int, bound: Mapping[int, int]) -> list[int]:
        """The records of the leader and the circle that go with a label; ``bound`` has those of the
        marks so far."""
        return [bound[before] for before in self.led(k) if before in bound]

    def led(self, k: int) -> list[int]:
        """The leader and the circle that come right before a label."""
        beside = (k - 1, k - 2)
        is_led = [j >= 0 and style_class(self.marks[j]) in LABELS[1:] for j in beside]
        return [*beside[: is_led.index(False)]] if False in is_led else [*beside]

    def keeps_off(self, k: int, record: Record) -> bool:
        """Whether a letter, or the leader or circle that goes with it, stands off a point."""
        text = self.text_of(k) if style_class(self.marks[k]) in LABELS else None
        if text is None or record[0] not in "tmf" or not self.is_upright(record):
            return False
        return text.step is not None or text.name in self.binder.places.spots

    def is_upright(self, record: Record) -> bool:
        """Whether what a pose carries does not turn."""
        graph, outputs = self.binder.tape.graph, self.binder.tape.outputs
        way = [outputs[record[3] + i] for i in (0, 1)]
        return all(graph.constant(node) is not None for node in way)

    def more(self) -> Iterator[tuple[int, str, str, Record]]:
        """Marks that are not drawn where the scene stands, after those of the same step: number of
        that one, element, class, record.

        The head of a vector too short to have one, the far part of a line too short to be parted.
        """
        for k, mark in enumerate(self.marks):
            first = style_class(mark)
            if not isinstance(mark, LineMark) or mark.step is None or first in LABELS:
                continue
            stroke, after = self.steps.stroke(mark), self.marks[k + 1 : k + 2]
            undrawn = self.steps.canvas(mark.step).undrawn
            if stroke is not None and stroke.is_vector:
                if not (after and style_class(after[0]) == "arrowhead"):
                    found = stroke.head(mark)
                    if found is not None:
                        yield k, "polygon", f"arrowhead {first}", found
            elif undrawn is not None:
                found = undrawn.mark(mark)
                if found is not None:
                    yield k, "line", mark.cls, found

    def binding(self, k: int, mark: Mark) -> Binding:
        """How a mark follows; what nothing is known of holds for the drawn position alone."""
        found = self.bodies.get(mark)
        if found is not None:
            return found
        first = style_class(mark)
        if first in LABELS:
            return self.label(k, mark)
        if mark.step is not None:
            return self.steps.binding(mark)
        if isinstance(mark, Text):
            return only_at_start if mark.name == "note" else still
        return self.body(mark, first)

    def body(self, mark: Mark, first: str) -> Binding:
        """A mark of the mechanism that no step has drawn."""
        if isinstance(mark, LineMark) and first == ACROSS:
            return self.across(mark)
        if curve := self.curves.get(mark.name):
            is_led = curve.kind == "moving-centrode"
            return self.binder.carried_by(self.binder.places.pose(curve.of)) if is_led else still
        is_fixed = first in FIXED or mark.name in self.drawing.scene.fixed_points
        return still if is_fixed else only_at_start

    def across(self, mark: LineMark) -> Binding:
        """A line across the field, which stays and goes on where the field grows."""
        (x1, y1), (x2, y2) = stretched((mark.x1, mark.y1), (mark.x2, mark.y2))
        whole = LineMark(x1, y1, x2, y2, mark.cls, mark.name)
        return line_to_edge(self.binder, whole, above_foot(self.binder.room))

    # --- labels --------------------------------------------------------------------------------

    def label(self, k: int, mark: Mark) -> Binding:
        """A letter, a number in its circle, or a leader: each goes with what it names."""
        text = self.text_of(k)
        if text is None:
            return only_at_start
        if text.step is not None:
            return self.steps.label(text)
        name, places = text.name, self.binder.places
        if name in self.drawing.scene.links:
            return self.binder.carried_by(places.pose(name))
        if name in places.spots:
            return self.binder.with_point(places.spots[name])
        if text.shows and text.shows.what == "rate":
            return self.binder.carried_by(places.pose(text.shows.link))
        return still if name in self.curves else only_at_start

    def text_of(self, k: int) -> Text | None:
        """The text of a label: a leader and a circle come right before it."""
        for mark in self.marks[k : k + 3]:
            if isinstance(mark, Text):
                return mark
        return None
