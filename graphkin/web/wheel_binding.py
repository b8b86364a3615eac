"""How teeth and strokes follow: those that are drawn are carried, and go on by whole pitches."""

from __future__ import annotations

from collections.abc import Iterator
from math import pi
from typing import Any

from graphkin.construction.core.bodies import Disc, Touch
from graphkin.construction.rolling.gear_symbols import gear
from graphkin.drawing.marks import Mark
from graphkin.numbers.plane import dot
from graphkin.web.body_pose import BodyPose
from graphkin.web.field_binder import Binding, FieldBinder


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
