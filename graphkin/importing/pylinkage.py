"""pylinkage: the JSON of a mechanism, with its joints and links by id.

A prismatic joint is a pin on a block on a fixed line; a tracker is one more point of the link that
has its two reference joints. Positions have no unit. A driver's speed is in radians per step.
"""

from __future__ import annotations

from cmath import phase, rect
from collections.abc import Iterable, Iterator
from math import pi

from msgspec import MsgspecError, Struct
from msgspec.json import decode

from graphkin.importing.record import (
    FARTHEST,
    DrawnGuide,
    DrawnInput,
    DrawnJoint,
    DrawnLink,
    Imported,
    damaged,
    few,
    named,
    refused,
)
from graphkin.text.errors import Message, message

PROGRAM = "pylinkage"
ROUNDING = 1e-6
KINDS = ("ground", "revolute", "prismatic", "tracker")
DRIVERS = ("driver", "arc_driver")
ONE_STEP = 2 * pi / 360
"""The speed of a driver that states none, in radians per step."""

Place = tuple[float | None, float | None]


class JsonJoint(Struct, frozen=True):
    """A joint as the file has it."""

    id: str
    type: str = "revolute"
    position: Place = (None, None)
    name: str | None = None
    axis: tuple[float, float] = (1.0, 0.0)
    ref_joint1_id: str = ""
    ref_joint2_id: str = ""
    distance: float = 0.0
    angle: float = 0.0


class JsonLink(Struct, frozen=True):
    """A link as the file has it; ``angular_velocity`` is in radians per step."""

    id: str
    type: str = "link"
    joints: tuple[str, ...] = ()
    name: str | None = None
    angular_velocity: float = ONE_STEP
    motor_joint: str | None = None


class JsonMechanism(Struct, frozen=True):
    """A mechanism as the file has it."""

    joints: tuple[JsonJoint, ...]
    links: tuple[JsonLink, ...]


def pylinkage_text(text: str) -> Imported:
    """The mechanism of a file. Raises SceneError for a joint of another kind, or with no place."""
    try:
        found = decode(text, type=JsonMechanism)
    except (MsgspecError, RecursionError):
        raise damaged() from None
    few(len(found.joints))
    few(len(found.links))
    grounds = {joint for link in found.links if link.type == "ground" for joint in link.joints}
    grounds |= {link.motor_joint or "" for link in found.links if link.type in DRIVERS}
    at = dict(placed(found.joints))
    joints = {
        each.id: DrawnJoint(each.name or each.id, at[each.id], fixed(each, grounds))
        for each in found.joints
    }
    held = {link.id: [*link.joints] for link in found.links if link.type != "ground"}
    if any(joint not in joints for owns in held.values() for joint in owns):
        raise damaged()
    notes = [message("lengths have no unit in the file; mm are written"), *tracked(found, held)]
    names = {link.id: link.name or link.id for link in found.links}
    bodies = {own: DrawnLink(names[own], tuple(owns)) for own, owns in held.items()}
    guides = []
    for each in found.joints:
        if each.type == "prismatic":
            block = f"block {each.id}"
            bodies[block] = DrawnLink(block, (each.id,))
            guides.append(DrawnGuide(block, each.id, angle=phase(complex(*each.axis))))
    inputs = tuple(driven(link, held) for link in found.links if link.type in DRIVERS)
    if inputs:
        notes.append(message("a speed in radians per step is taken as radians per second"))
    return Imported(PROGRAM, "mm", ROUNDING, joints, bodies, tuple(guides), inputs, tuple(notes))


def placed(joints: Iterable[JsonJoint]) -> Iterator[tuple[str, complex]]:
    """The place of each joint; that of a tracker follows from its two joints."""
    known: dict[str, complex] = {}
    for each in sorted(joints, key=lambda joint: joint.type == "tracker"):
        if each.type not in KINDS:
            raise refused(
                message(
                    "joint {name} is of kind {kind}", name=named(each.id), kind=named(each.type)
                ),
                message("pins, sliding pins and trackers"),
            )
        if each.type == "tracker":
            one, other = known[each.ref_joint1_id], known[each.ref_joint2_id]
            place = one + each.distance * rect(1.0, each.angle + phase(other - one))
        else:
            x, y = each.position
            if x is None or y is None:
                raise refused(message("joint {name} has no position", name=named(each.id)))
            place = complex(x, y)
        if not abs(place) < FARTHEST:
            raise damaged()
        known[each.id] = place
        yield each.id, place


def fixed(joint: JsonJoint, grounds: set[str]) -> bool:
    return joint.type == "ground" or (joint.id in grounds and joint.type == "revolute")


def tracked(found: JsonMechanism, held: dict[str, list[str]]) -> Iterator[Message]:
    """Add each tracker to the link of its two joints; a note for each that is on no link."""
    for each in found.joints:
        if each.type == "tracker" and not any(each.id in owns for owns in held.values()):
            both = {each.ref_joint1_id, each.ref_joint2_id}
            on = next((owns for owns in held.values() if both <= {*owns}), None)
            if on is None:
                yield message("tracker {name} is on no link and is left out", name=named(each.id))
            else:
                on.append(each.id)


def driven(link: JsonLink, held: dict[str, list[str]]) -> DrawnInput:
    """The driver of a link about its motor's joint."""
    if link.motor_joint not in held[link.id]:
        raise damaged()
    return DrawnInput(link.id, link.angular_velocity * 30 / pi, link.motor_joint or "")
