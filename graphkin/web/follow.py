"""How every mark of a field follows the driver: bodies, steps and labels."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from math import inf, pi
from typing import Any

from msgspec import Struct, field
from msgspec.structs import replace

from graphkin.construction.core.component import TriangleComponent
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import auxiliary_plan, construction
from graphkin.construction.core.layout import Layout
from graphkin.construction.core.link_poses import Disc, Touch
from graphkin.construction.core.paper_canvas import above_foot, inside, stretched
from graphkin.construction.core.program import plan_vector
from graphkin.construction.core.solution import Curve
from graphkin.construction.drivers.driver_symbols import draw_drivers
from graphkin.construction.guides.slide_symbols import within
from graphkin.construction.links.mechanism_symbols import draw_links
from graphkin.construction.links.wheel_symbols import gear
from graphkin.drawing.field import Field, Rect
from graphkin.drawing.labels import FieldContent
from graphkin.drawing.marks import Arc, CircleMark, LineMark, Mark, Polyline, Text, style_class
from graphkin.numbers.plane import Line as Carrier
from graphkin.numbers.plane import Ratio, Vector, dot
from graphkin.web.field_binder import (
    SPACING,
    Binding,
    FieldBinder,
    Record,
    Told,
    must_be_seen,
    only_at_start,
    still,
)
from graphkin.web.moving_canvas import Local, MovingCanvas, MovingCoordinate, MovingField, Stroke
from graphkin.web.moving_sheet import BodyPose

ENDLESS: Rect = (-inf, -inf, inf, inf)
"""A field that clips nothing."""
RACK = "gear-disc"
"""The class of the outline of a rack."""


def mechanism_bindings(binder: FieldBinder, angles: Mapping[str, Any]) -> Told:
    """The bindings of the marks of the mechanism and its drivers.

    ``angles`` are the angles in degrees of the links that drivers turn.
    """
    drawing, field = binder.places.drawing, replace(binder.field, rect=ENDLESS)
    drawn, moving = FieldContent(ENDLESS), FieldContent(ENDLESS)
    draw_bodies(drawn, drawing, field)
    traced = MovingField(ENDLESS, field.mm, field.middle, field.at, binder)
    found: Told = {}
    with binder.tape.choosing():
        draw_bodies(moving, replace(binder.places.moving, driven=angles), traced)
        borne = list(racks(binder))
        for mark, follows in zip(drawn.marks, moving.marks, strict=True):
            binding, seen = following(binder, follows, borne), [*within([mark], binder.field.rect)]
            if binding is still and isinstance(mark, LineMark) and seen != [mark]:
                binding = line_to_edge(binder, mark, inside(binder.room))
            found |= dict.fromkeys((mark, *seen), binding)
        found |= gears(binder)
    return found


def line_to_edge(binder: FieldBinder, mark: LineMark, room: Rect) -> Binding:
    """Bind a fixed line that the field clips; where the field grows, it extends within ``room``."""
    ends = (mark.x1, mark.y1), (mark.x2, mark.y2)
    start, end = (binder.tape.lifted(complex(*place)) for place in ends)
    return binder.joining(start, end, room)


def draw_bodies(board: FieldContent, drawing: Drawing, field: Field) -> None:
    """Draw the mechanism, and its drivers on a velocity sheet."""
    draw_links(board, drawing, field)
    if drawing.kind == "velocity":
        draw_drivers(board, drawing, field)


def following(
    binder: FieldBinder, mark: Mark, borne: Sequence[tuple[BodyPose, BodyPose]]
) -> Binding:
    """How a mark drawn in traced numbers follows; ``borne`` are the poses of racks."""
    if isinstance(mark, Arc):
        numbers = local(mark.cx).on_page, mark.r, (mark.start, mark.end)
        is_still = all(binder.is_constant(each) for each in (*numbers[:2], *numbers[2]))
        return still if is_still else binder.sweeping(*numbers)
    if isinstance(mark, CircleMark):
        return binder.on(BodyPose(local(mark.cx).on_page, binder.tape.lifted(1 + 0j)))
    if isinstance(mark, Polyline):
        places = [local(x) for x, _ in mark.points]
    else:
        assert isinstance(mark, LineMark)
        places = [local(mark.x1), local(mark.x2)]
    poses = [place.pose for place in places]
    if mark.cls == RACK:
        poses = [next((to for by, to in borne if pose.is_same(by)), pose) for pose in poses]
    if all(binder.is_constant(part) for pose in poses for part in pose):
        return still
    if len(places) == 2 and style_class(mark) == "arrowhead":
        tip, tail = (place.on_page for place in places)
        return binder.heading(tail, tip)
    if all(pose.is_same(poses[0]) for pose in poses):
        pose = poses[0]
        # a stroke of the frame stays, or takes the place of another stroke
        if mark.cls == "ground":
            pose = stepped(binder, pose, dot(*pose), SPACING)
        return binder.on(pose, inside(binder.room))
    if any(place.at for place in places) and isinstance(mark, Polyline):
        return binder.by_poses(poses)
    corners = [place.on_page for place in places]
    if isinstance(mark, LineMark):
        return binder.joining(corners[0], corners[1], inside(binder.room))
    return binder.corners(corners)


def local(number: Any) -> Local:
    """The place that a coordinate belongs to."""
    assert isinstance(number, MovingCoordinate)
    return number.local


def gears(binder: FieldBinder) -> Iterator[tuple[Mark, Binding]]:
    """The outlines of gears, each carried with its teeth."""
    drawing, moving = binder.places.drawing, binder.places.moving
    for disc, moved in zip(drawing.standing.discs, moving.standing.discs, strict=True):
        if disc.module:
            outline, *_ = gear(drawing, binder.field, disc)
            yield outline, binder.on(of_gear(binder, moved))


def racks(binder: FieldBinder) -> Iterator[tuple[BodyPose, BodyPose]]:
    """The page poses that racks are drawn from, each with the pose of its teeth."""
    for touch in binder.places.moving.standing.touches:
        if touch.disc.module and touch.zero is not None:
            pose = binder.pose(BodyPose(touch.at, touch.along / abs(touch.along)))
            moved = dot(touch.at - touch.zero, touch.along) * binder.field.mm
            yield pose, stepped(binder, pose, moved, pi * touch.disc.module * binder.field.mm)


def of_gear(binder: FieldBinder, disc: Disc) -> BodyPose:
    """The pose of a gear's outline, whose teeth are drawn at its mesh.

    As the wheel turns, its teeth pass the mesh, each taking the place of the one before it.
    """
    tape, turned = binder.tape, binder.places.turn_of(disc.link)
    for touch in binder.places.moving.standing.touches:
        if is_mesh(touch, disc):
            mesh = touch.along * complex(tape.now(touch.along)).conjugate()
            against = tape.lifted(turned * mesh.conjugate())
            angle, pitch = against.imag.do("atan2", against.real), pi * disc.module / disc.radius
            rest = angle - (angle * (1 / pitch)).do("round") * pitch
            turned = mesh * (rest.do("cos") + 1j * rest.do("sin"))
            break
    return binder.pose(BodyPose(disc.centre, turned))


def is_mesh(touch: Touch, disc: Disc) -> bool:
    """Whether a wheel takes part in a contact of teeth, with another wheel or with a rack."""
    both = touch.disc, touch.other or touch.disc
    wheels = [(each.link, each.wheel) for each in both]
    return (disc.link, disc.wheel) in wheels and all(each.module for each in both)


def stepped(binder: FieldBinder, pose: BodyPose, moved: Any, pitch: float) -> BodyPose:
    """A page pose moved along its direction by whole pitches relative to its support."""
    since = binder.tape.lifted(moved - float(binder.tape.now(moved)))
    rest = since - (since * (1 / pitch)).do("round") * pitch
    return BodyPose(pose.origin - pose.way * rest, pose.way)


class StepStrokes(Struct, frozen=True):
    """The steps of one field, each drawn in traced numbers as on paper."""

    binder: FieldBinder
    layout: Layout
    drawn: dict[int, MovingCanvas] = field(default_factory=dict)

    def canvas(self, number: int) -> MovingCanvas:
        """The strokes of a step; none where its construction is not complete."""
        if number not in self.drawn:
            self.drawn[number] = canvas = MovingCanvas(self.binder, self.layout, number)
            known = self.binder.places.values
            if number in known:
                kind, value = construction(canvas.step), known[number]
                plan = auxiliary_plan(canvas.drawing, number)
                lacks = isinstance(kind, TriangleComponent) and not kind.is_whole(known)
                if kind is not None and not lacks:
                    kind.marks(canvas, canvas.step.role)
                if plan is not None:
                    plan.marks(canvas, number)
                elif isinstance(value, Vector):
                    canvas.vector(canvas.step.name, "", value.tail, value.tip)
                    if vector := plan_vector(canvas.step):
                        canvas.point("", value.tail if vector.back else value.tip)
        return self.drawn[number]

    def stroke(self, mark: Mark) -> Stroke | None:
        """The stroke that drew a mark of a step; None for a mark that only paper has."""
        assert mark.step is not None
        strokes = self.canvas(mark.step).strokes
        return strokes[mark.part] if mark.part < len(strokes) else None

    def binding(self, mark: Mark) -> Binding:
        """How a mark of a step follows; a mark that only paper has holds for the drawn position."""
        stroke = self.stroke(mark)
        if stroke is None:
            return only_at_start
        return stroke.head if style_class(mark) == "arrowhead" else stroke.mark

    def label(self, mark: Mark) -> Binding:
        """How the label of a step follows."""
        stroke = self.stroke(mark)
        return only_at_start if stroke is None else stroke.label


# --- the marks of a field -------------------------------------------------------------------------


LABELS = ("label", "number", "leader")
"""The classes of a letter and of the circle and leader that go with it."""
FIXED = ("caption", "guide", "ground", "fixed-pivot", "title", "panel")
"""The classes of marks that do not move, unless something else is known of them."""
ACROSS = "centre-line"
"""The class of lines across a whole field, where no driver draws them."""


class MarkBindings(Struct, frozen=True, dict=True):
    """The marks of one field, each with the way in which it follows the driver."""

    binder: FieldBinder
    layout: Layout
    marks: Sequence[Mark]
    angles: Mapping[str, Any]
    """The angles in degrees of the links that drivers turn."""

    @property
    def drawing(self) -> Drawing:
        return self.binder.places.drawing

    @cached_property
    def steps(self) -> StepStrokes:
        return StepStrokes(self.binder, self.layout)

    @cached_property
    def on_mechanism(self) -> bool:
        """Whether this is the field of the mechanism."""
        return self.binder.field is self.layout.mechanism

    @cached_property
    def bodies(self) -> Told:
        """The bindings of bodies and drivers."""
        if not self.on_mechanism:
            return {}
        return mechanism_bindings(self.binder, self.angles)

    @cached_property
    def curves(self) -> Mapping[str, Curve]:
        """The curves of the whole motion by the name of their marks.

        The locus of a trial group is left out, since it differs at each position.
        """
        return {curve.name: curve for curve in self.drawing.curves if curve.kind != "locus"}

    def records(self) -> Iterator[tuple[int, Record]]:
        """The record of every mark that moves, with the number of the mark in the field."""
        for k, mark in enumerate(self.marks):
            record = self.binding(k, mark)(mark)
            if record is not None:
                yield k, record

    def in_sight(self, mark: Mark, record: Record) -> bool:
        """Whether the field must keep a mark in sight.

        Centres, poles and the lines to them are exempt, since they may be infinitely far away.
        """
        if record[0] in "sioa" or not must_be_seen(mark):
            return False
        value = None if mark.step is None else self.drawing.trace.values.get(mark.step)
        if isinstance(value, Carrier):
            return not self.on_mechanism
        return not isinstance(value, Ratio)

    def sides(self, k: int, record: Record) -> int:
        """Whether a label may move to the other side of its segment or point.

        Returns 1 if it may, 2 if it has a leader as well, and 0 if not, as for a number in a
        circle.
        """
        led = {style_class(self.marks[j]) for j in self.led(k)}
        if "number" in led or not (record[0] == "b" or self.is_upright(record)):
            return 0
        return 2 if led else 1

    def going_before(self, k: int, bound: Mapping[int, int]) -> list[int]:
        """The records of the leader and the circle that go with a label, from ``bound``."""
        return [bound[before] for before in self.led(k) if before in bound]

    def led(self, k: int) -> list[int]:
        """The leader and the circle that come right before a label."""
        beside = (k - 1, k - 2)
        is_led = [j >= 0 and style_class(self.marks[j]) in LABELS[1:] for j in beside]
        return [*beside[: is_led.index(False)]] if False in is_led else [*beside]

    def keeps_off(self, k: int, record: Record) -> bool:
        """Whether a letter, or its leader or circle, keeps a distance from a point."""
        text = self.text_of(k) if style_class(self.marks[k]) in LABELS else None
        if text is None or record[0] not in "tmf" or not self.is_upright(record):
            return False
        return text.step is not None or text.name in self.binder.places.spots

    def is_upright(self, record: Record) -> bool:
        """Whether a mark keeps its direction while its pose carries it."""
        graph, outputs = self.binder.tape.graph, self.binder.tape.outputs
        way = [outputs[record[3] + i] for i in (0, 1)]
        return all(graph.constant(node) is not None for node in way)

    def more(self) -> Iterator[tuple[int, str, str, Record]]:
        """Marks that the drawn position lacks: number of the mark before, element, class, record.

        These are the head of a vector too short for one, and the far part of a line too short to be
        split.
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
        """How a mark follows; a mark without a rule holds for the drawn position alone."""
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
        """Bind a mark of the mechanism that no step has drawn."""
        if isinstance(mark, LineMark) and first == ACROSS:
            return self.across(mark)
        if curve := self.curves.get(mark.name):
            is_led = curve.kind == "moving-centrode"
            return self.binder.carried_by(self.binder.places.pose(curve.of)) if is_led else still
        is_fixed = first in FIXED or mark.name in self.drawing.scene.fixed_points
        return still if is_fixed else only_at_start

    def across(self, mark: LineMark) -> Binding:
        """Bind a line across the field, which does not move and extends when the field grows."""
        (x1, y1), (x2, y2) = stretched((mark.x1, mark.y1), (mark.x2, mark.y2))
        whole = LineMark(x1, y1, x2, y2, mark.cls, mark.name)
        return line_to_edge(self.binder, whole, above_foot(self.binder.room))

    # --- labels --------------------------------------------------------------------------------

    def label(self, k: int, mark: Mark) -> Binding:
        """Bind a letter, a number in its circle, or a leader to the object that it names."""
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
        """The text of a label; the leader and the circle come right before it."""
        for mark in self.marks[k : k + 3]:
            if isinstance(mark, Text):
                return mark
        return None
