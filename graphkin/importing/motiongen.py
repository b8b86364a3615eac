"""MotionGen: the JSON of a ``.motiongen`` file, with joints, links and actuators by id.

A rotary actuator at a joint turns the link of its joint ``to`` against that of its joint ``from``.
Slots, cylinders and linear actuators are refused. The keys are those that two public programs read
(motiongen_parser.py) and write (motiongen_export.py); MotionGen itself describes none.
"""

from __future__ import annotations

from math import pi

from msgspec import MsgspecError, Struct, field
from msgspec.json import decode

from graphkin.importing.record import (
    FARTHEST,
    DrawnInput,
    DrawnJoint,
    DrawnLink,
    Imported,
    damaged,
    few,
    letter_of,
    named,
    one_at_welds,
    refused,
    unknown_unit,
)
from graphkin.text.errors import Message, message

PROGRAM = "MotionGen"
ROUNDING = 1e-6
UNITS = ("mm", "cm", "m", "in", "ft")
USUAL = "cm"
ROTARY = "rotary"


class FileJoint(Struct, frozen=True):
    """A joint as the file has it."""

    id: str
    x: float
    y: float
    welded: bool = field(name="isWelded", default=False)


class FileLink(Struct, frozen=True):
    """A link as the file has it."""

    id: str
    joints: tuple[str, ...] = field(name="jointIds", default=())
    slots: tuple[object, ...] = field(name="slotIds", default=())
    is_ground: bool = field(name="isGround", default=False)


class FileActuator(Struct, frozen=True):
    """A motor as the file has it; ``velocity`` is in the file's unit of angles per second."""

    type: str
    at: str
    start: str = field(name="from", default="")
    driven: str = field(name="to", default="")
    velocity: float = 1.0


class FileMechanism(Struct, frozen=True):
    """The mechanism of a file."""

    joints: tuple[FileJoint, ...]
    links: tuple[FileLink, ...]
    actuators: tuple[FileActuator, ...] = ()
    slots: tuple[object, ...] = ()
    cylinders: tuple[object, ...] = ()


class FileSettings(Struct, frozen=True):
    """The units of a file."""

    length: str = field(name="linearUnit", default="")
    angle: str = field(name="angularUnit", default="")


class MotionGenFile(Struct, frozen=True):
    """A whole file, without its pictures and its synthesis."""

    mechanism: FileMechanism
    settings: FileSettings = FileSettings()


def motiongen_text(text: str) -> Imported:
    """The mechanism of a file. Raises SceneError for slots, cylinders and linear actuators."""
    try:
        file = decode(text, type=MotionGenFile)
    except (MsgspecError, RecursionError):
        raise damaged() from None
    found = file.mechanism
    few(len(found.joints))
    few(len(found.links))
    refuse_unknown(found)
    notes: list[Message] = []
    unit = file.settings.length
    if unit not in UNITS:
        notes.append(unknown_unit(unit, USUAL))
        unit = USUAL
    fixed = {joint for link in found.links if link.is_ground for joint in link.joints}
    joints = {
        each.id: DrawnJoint(letter_of(place), place_of(each), each.id in fixed)
        for place, each in enumerate(found.joints)
    }
    moving = (link for link in found.links if not link.is_ground)
    bodies = {
        link.id: DrawnLink(f"L{number}", link.joints) for number, link in enumerate(moving, 1)
    }
    if any(joint not in joints for body in bodies.values() for joint in body.joints):
        raise damaged()
    one_at_welds([each.id for each in found.joints if each.welded], bodies)
    unit_angle = pi / 180 if file.settings.angle == "deg" else 1.0
    speeds = [each.velocity * unit_angle for each in found.actuators]
    motors = zip(found.actuators, speeds, strict=True)
    inputs = tuple(driven(each, speed, bodies, fixed) for each, speed in motors)
    notes += [
        message("the speed {speed} is taken as radians per second", speed=f"{speed:g}")
        for speed in speeds
    ]
    return Imported(PROGRAM, unit, ROUNDING, joints, bodies, (), inputs, tuple(notes))


def place_of(joint: FileJoint) -> complex:
    place = complex(joint.x, joint.y)
    if not abs(place) < FARTHEST:
        raise damaged()
    return place


def refuse_unknown(found: FileMechanism) -> None:
    """Raise SceneError for parts of a file whose form is not known."""
    parts = {
        "slots": bool(found.slots) or any(link.slots for link in found.links),
        "cylinders": bool(found.cylinders),
        "linear actuators": any(each.type != ROTARY for each in found.actuators),
    }
    if there := [name for name, is_there in parts.items() if is_there]:
        raise refused(
            message("the file has {parts}", parts=named(", ".join(there))),
            message("pins, bars and plates, and motors that turn"),
        )


def driven(
    motor: FileActuator, speed: float, bodies: dict[str, DrawnLink], fixed: set[str]
) -> DrawnInput:
    """The driver of a motor at a speed in rad/s: the link from its joint to the driven one."""
    own, other = (
        next((name for name, body in bodies.items() if {motor.at, joint} <= {*body.joints}), "")
        for joint in (motor.driven, motor.start)
    )
    if not own or (motor.at not in fixed and not other):
        raise damaged()
    return DrawnInput(own, speed * 30 / pi, motor.at, "" if motor.at in fixed else other)
