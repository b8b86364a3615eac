"""How wheels, gears and straight tracks follow: each mark is told by making it again."""

from __future__ import annotations

from math import pi
from typing import Any

from graphkin.construction.core.bodies import Disc, Touch
from graphkin.construction.guides.slide_symbols import REACH, within
from graphkin.construction.rolling.gear_symbols import BASE, ROOT, teeth_beside
from graphkin.construction.rolling.wheel_symbols import CONTACT, SPARE, spokes, track, wheel
from graphkin.drawing.field import Field
from graphkin.drawing.marks import CircleMark, LineMark, Mark, Polyline
from graphkin.numbers.arithmetic import larger, pick, smaller
from graphkin.numbers.plane import cross, dot
from graphkin.scene.model import FRAME
from graphkin.web.field_binder import SPACING, Binding, FieldBinder, Told
from graphkin.web.traced_poses import BodyPose


def of_wheel(binder: FieldBinder, disc: Disc) -> Told:
    """A wheel, its teeth where it meshes, and its spokes."""
    places, drawing = binder.places, binder.places.drawing
    centre = places.positions[disc.wheel.centre]
    touches = [
        touch
        for touch in drawing.standing.touches
        if disc in (touch.disc, touch.other)
        and touch.disc.module
        and (touch.other is None or touch.other.module)
    ]
    outline = binder.carried_by(BodyPose(centre, places.turn_of(disc.link)))
    if touches and disc.module:
        outline = binder.carried_by(places.teeth(disc, touches[0]))
    found: Told = {}
    for mark in wheel(drawing, binder.field, disc):
        found[mark] = outline if isinstance(mark, Polyline) else binder.with_point(centre)
    for mark in spokes(drawing, binder.field, disc):
        found[mark] = binder.carried_by(BodyPose(centre, places.turn_of(disc.link)))
    return found


def of_touch(binder: FieldBinder, touch: Touch) -> Told:
    """A contact, and the straight track that a wheel rolls on."""
    found: Told = {}
    pose = binder.places.touch(touch)
    dot_ = CircleMark(*binder.field(touch.at), CONTACT, "contact", touch.disc.link)
    if touch.zero is not None:
        found.update(of_track(binder, touch, pose))
    found[dot_] = binder.at(pose.origin)
    return found


def of_track(binder: FieldBinder, touch: Touch, pose: BodyPose) -> Told:
    """A straight track about its contact: of the frame its strokes stay, of a link its teeth go
    along with it."""
    places, field = binder.places, binder.field
    drawing, mm, on = places.drawing, field.mm, touch.on
    low, high = span_of(binder, touch, pose)
    page = binder.pose(pose)
    moved = dot(pose.origin - places.carried(on, touch.zero or 0j), pose.way) * mm
    since = binder.tape.lifted(moved - float(binder.tape.now(moved)))
    found: Told = {}
    marks = list(within(track(drawing, field, touch), field.rect))
    pitch = pi * touch.disc.module * mm if touch.disc.module else SPACING
    rest = since - (since * (1 / pitch)).do("round") * pitch
    teeth = BodyPose(page.origin - page.way * rest, page.way)
    body = rack_span(binder, touch, pose, low, high) if touch.disc.module else (low, high)
    for mark in marks:
        if isinstance(mark, Polyline):
            found[mark] = rack_binding(binder, touch, teeth, page, body)
        elif mark.cls == "pitch":
            first, last = (page.origin + page.way * end for end in body)
            found[mark] = binder.joining(first, last, binder.room)
        elif mark.cls == "ground":
            found[mark] = binder.on(teeth)
        elif mark.cls == "guide" and not touch.disc.module:
            reach = (low, high) if touch.side > 0 else (high, low)
            first, last = (page.origin + page.way * end for end in reach)
            found[mark] = binder.joining(first, last, binder.room)
        elif mark.cls == "guide":
            side, back = touch.side, rack_back(touch, mm)
            reach = body if side > 0 else body[::-1]
            first, last = (page.origin + page.way * (end + 1j * back) for end in reach)
            found[mark] = binder.joining(first, last, binder.room)
        elif abs(float(cross(page_way(field, touch), direction(mark)))) < 1e-6:
            found[mark] = bar_beside(binder, touch, page, mark, (low, high), body)
        else:
            found[mark] = binder.carried_by(places.pose(on))
    return found


def bar_beside(
    binder: FieldBinder,
    touch: Touch,
    page: BodyPose,
    mark: Mark,
    whole: tuple[Any, Any],
    body: tuple[Any, Any],
) -> Binding:
    """The bar of a straight track, or its part before or after the body of a rack."""
    ends = whole
    if touch.disc.module:
        assert isinstance(mark, LineMark)
        x, y = binder.field(touch.at)
        u, v = binder.field.way(touch.along)
        is_before = (mark.x1 - x) * u + (mark.y1 - y) * v < 0
        ends = (whole[0], body[0]) if is_before else (body[1], whole[1])
    first, last = (page.origin + page.way * end for end in ends)
    return binder.joining(first, last, binder.room)


def page_way(field: Field, touch: Touch) -> complex:
    """The direction of a track on the page."""
    return complex(*field.way(touch.along))


def direction(line: Mark) -> complex:
    """The unit direction of a line of the page."""
    assert isinstance(line, LineMark)
    way = complex(line.x2 - line.x1, line.y2 - line.y1)
    return way / (abs(way) or 1.0)


def rack_back(touch: Touch, mm: float) -> float:
    """How far the back of a rack lies beside its pitch line, in mm."""
    side = touch.side
    return side * ROOT * touch.disc.module * mm + side * BASE


def span_of(binder: FieldBinder, touch: Touch, pose: BodyPose) -> tuple[Any, Any]:
    """The drawn part of a straight track in mm from the contact, as paper has it."""
    places, mm, on = binder.places, binder.field.mm, touch.on
    drawing = places.drawing
    half = max(REACH, 0.8 * touch.disc.radius * mm)
    lift = binder.tape.lifted
    ends: list[Any] = [lift(-half), lift(half)]
    zero = dot(places.carried(on, touch.zero or 0j) - pose.origin, pose.way) * mm
    ends += seats_of(binder, touch, pose)
    if isinstance(touch.rolling.through, str):
        ends += [zero - 4, zero + 4]
    else:
        near = abs(zero) < SPARE
        ends += [pick(near, zero - 4, -half), pick(near, zero + 4, half)]
    if on != FRAME:
        close = 1e-6 * drawing.standing.size + 2.5 * touch.disc.module
        for name in places.points_of(on):
            if abs(cross(touch.along, drawing.positions[name] - touch.at)) < close:
                ends.append(dot(places.positions[name] - pose.origin, pose.way) * mm)
    low, high = ends[0], ends[1]
    for end in ends:
        low, high = smaller(low, end), larger(high, end)
    return low, high


def seats_of(binder: FieldBinder, touch: Touch, pose: BodyPose) -> list[Any]:
    """Where the blocks of a track's link stand on it, in mm from the contact."""
    places = binder.places
    return [
        dot(places.seat(way) - pose.origin, pose.way) * binder.field.mm
        for way in places.drawing.standing.guideways
        if way.block == touch.on and way.slide.on == FRAME
    ]


def rack_span(
    binder: FieldBinder, touch: Touch, pose: BodyPose, low: Any, high: Any
) -> tuple[Any, Any]:
    """The part of a track that has the body of a rack, as paper has it."""
    full = teeth_beside(touch) * pi * touch.disc.module * binder.field.mm + BASE
    low, high = smaller(low, -full), larger(high, full)
    for place in seats_of(binder, touch, pose):
        ahead = place > 0
        high = pick(ahead, smaller(high, place - REACH - 2), high)
        low = pick(ahead, low, larger(low, place + REACH + 2))
    return low, high


def rack_binding(
    binder: FieldBinder, touch: Touch, teeth: BodyPose, page: BodyPose, body: tuple[Any, Any]
) -> Binding:
    """The outline of a rack: its teeth go along, its four corners stand where its body ends."""
    low, high = (BodyPose(page.origin + page.way * end, page.way) for end in body)

    def bound(mark: Mark) -> list[Any]:
        assert isinstance(mark, Polyline)
        last = len(mark.points)
        poses = {0: low, last - 3: high, last - 2: high, last - 1: low}
        found: list[Any] = ["x", -1]
        for i, point in enumerate(mark.points):
            found += binder.rigid(CircleMark(*point, 1.0, ""), poses.get(i, teeth), None)[2:]
        return found

    return bound
