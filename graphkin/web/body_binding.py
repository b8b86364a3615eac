"""How the mechanism and the marks of steps follow: drawn once for paper, once in traced numbers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from math import inf, pi
from typing import Any

from msgspec import Struct, field
from msgspec.structs import replace

from graphkin.construction.core.auxiliary_plan import auxiliary_plan
from graphkin.construction.core.component import TriangleComponent
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import construction
from graphkin.construction.core.layout import Layout
from graphkin.construction.core.link_poses import Disc, Touch
from graphkin.construction.core.plan_vector import plan_vector
from graphkin.construction.core.plot import inside
from graphkin.construction.drivers.driver_symbols import draw_drivers
from graphkin.construction.guides.slide_symbols import within
from graphkin.construction.links.gear_symbols import gear
from graphkin.construction.links.mechanism_symbols import draw_links
from graphkin.drawing.areas import Rect
from graphkin.drawing.field import Field
from graphkin.drawing.labels import FieldContent
from graphkin.drawing.marks import Arc, CircleMark, LineMark, Mark, Polyline, style_class
from graphkin.numbers.plane import Vector, dot
from graphkin.web.body_pose import BodyPose
from graphkin.web.field_binder import SPACING, Binding, FieldBinder, Told, only_at_start, still
from graphkin.web.moving_canvas import MovingCanvas, Stroke
from graphkin.web.moving_field import Local, MovingCoordinate, MovingField

ENDLESS: Rect = (-inf, -inf, inf, inf)
"""A field that cuts nothing."""
RACK = "gear-disc"
"""The class of the outline of a rack."""


def mechanism_bindings(binder: FieldBinder, angles: Mapping[str, Any]) -> Told:
    """The bindings of the marks of the mechanism and its drivers; ``angles`` are those in degrees
    of the links that drivers turn."""
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
    """A line that stays, cut at the edge of its field: all of it where the field grows, to the
    edge of its ``room``."""
    ends = (mark.x1, mark.y1), (mark.x2, mark.y2)
    start, end = (binder.tape.lifted(complex(*place)) for place in ends)
    return binder.joining(start, end, room)


def draw_bodies(board: FieldContent, drawing: Drawing, field: Field) -> None:
    """The mechanism, and its drivers where a sheet shows them."""
    draw_links(board, drawing, field)
    if drawing.kind == "velocity":
        draw_drivers(board, drawing, field)


def following(
    binder: FieldBinder, mark: Mark, borne: Sequence[tuple[BodyPose, BodyPose]]
) -> Binding:
    """How a mark follows that is drawn in traced numbers; ``borne`` are the poses of racks."""
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
        if mark.cls == "ground":  # a stroke of the frame stays, or stands where another did
            pose = stepped(binder, pose, dot(*pose), SPACING)
        return binder.on(pose, inside(binder.room))
    if any(place.at for place in places) and isinstance(mark, Polyline):
        return binder.by_poses(poses)
    corners = [place.on_page for place in places]
    if isinstance(mark, LineMark):
        return binder.joining(corners[0], corners[1], inside(binder.room))
    return binder.corners(corners)


def local(number: Any) -> Local:
    """The place to which a coordinate belongs."""
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
    """The poses of the page that racks are drawn from, each with that of its teeth."""
    for touch in binder.places.moving.standing.touches:
        if touch.disc.module and touch.zero is not None:
            pose = binder.pose(BodyPose(touch.at, touch.along / abs(touch.along)))
            moved = dot(touch.at - touch.zero, touch.along) * binder.field.mm
            yield pose, stepped(binder, pose, moved, pi * touch.disc.module * binder.field.mm)


def of_gear(binder: FieldBinder, disc: Disc) -> BodyPose:
    """Where the outline of a gear goes, whose teeth are drawn where it meshes: as the wheel turns
    they pass there, each taking the place of the one before it."""
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
    """Whether a wheel meshes with another one, or with a rack, where they touch."""
    both = touch.disc, touch.other or touch.disc
    wheels = [(each.link, each.wheel) for each in both]
    return (disc.link, disc.wheel) in wheels and all(each.module for each in both)


def stepped(binder: FieldBinder, pose: BodyPose, moved: Any, pitch: float) -> BodyPose:
    """A pose of the page that has gone along its way by whole pitches against what bears it."""
    since = binder.tape.lifted(moved - float(binder.tape.now(moved)))
    rest = since - (since * (1 / pitch)).do("round") * pitch
    return BodyPose(pose.origin - pose.way * rest, pose.way)


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
        """The stroke that drew a mark of a step; None of what is drawn on paper alone."""
        assert mark.step is not None
        strokes = self.canvas(mark.step).strokes
        return strokes[mark.part] if mark.part < len(strokes) else None

    def binding(self, mark: Mark) -> Binding:
        """How a mark of a step follows; what is drawn on paper alone holds for that position."""
        stroke = self.stroke(mark)
        if stroke is None:
            return only_at_start
        return stroke.head if style_class(mark) == "arrowhead" else stroke.mark

    def label(self, mark: Mark) -> Binding:
        """How the label of a step follows."""
        stroke = self.stroke(mark)
        return only_at_start if stroke is None else stroke.label
