"""Pyslvs: an expression ``M[J[R, P[x, y], L[ground, link_1]], …]`` of pins (R), pins in slots (RP)
and blocks that do not turn in their slots (P).

Each joint names the links that meet there; of a slot, the first link has it. The angle of a slot is
that of the drawing. A ``.pyslvs`` file is YAML with such an expression under ``mechanism``, and the
numbers of a fixed and a turned joint for each input under ``input``.
"""

from __future__ import annotations

import re
from math import radians

from msgspec.structs import replace

from graphkin.importing.record import (
    DrawnGuide,
    DrawnInput,
    DrawnJoint,
    DrawnLink,
    Imported,
    damaged,
    few,
    named,
    number,
    refused,
)
from graphkin.text.errors import message

PROGRAM = "Pyslvs"
FRAME_NAME = "ground"
KINDS = ("R", "RP", "P")
ROUNDING = 1e-4
JOINT = re.compile(
    r"\s*J\[(?P<kind>\w+)(?:, *A\[(?P<angle>[^]]*)\])?(?:, *color\[[^]]*\])?"
    r", *P\[(?P<x>[^],]*),(?P<y>[^],]*)\], *L\[(?P<links>[^]]*)\]\]\s*,?\s*"
)
"""One joint and the comma after it."""
EXPRESSION = re.compile(r"\bmechanism:\s*['\"]?M\[")
INPUTS = re.compile(r"\binput:\s*([-\[\](),\s\d]*)")
"""Pairs of numbers as YAML writes them, in blocks or in brackets."""


def project_text(text: str) -> Imported:
    """The mechanism of a ``.pyslvs`` file, with its inputs."""
    begin = EXPRESSION.search(text)
    assert begin is not None
    depth, end = 0, begin.end() - 1
    for end in range(begin.end() - 1, len(text)):
        depth += (text[end] == "[") - (text[end] == "]")
        if not depth:
            break
    found = pyslvs_text("M" + " ".join(text[begin.end() - 1 : end + 1].split()))
    stated = INPUTS.search(text[: begin.start()]) or INPUTS.search(text[end:])
    numbers = re.findall(r"\d+", stated[1]) if stated else []
    inputs = []
    for one, other in zip(numbers[::2], numbers[1::2], strict=False):
        about, turned = f"P{int(one)}", f"P{int(other)}"
        both = (own for own, body in found.bodies.items() if {about, turned} <= {*body.joints})
        inputs.append(DrawnInput(next(both, ""), 1.0, about))
        if not inputs[-1].body:
            raise damaged()
    more = (message("no speed in the file; 1 rev/min is written"),) if inputs else ()
    return replace(found, inputs=tuple(inputs), notes=(*found.notes, *more))


def pyslvs_text(text: str) -> Imported:
    """The mechanism of an expression. Raises SceneError for joints of other kinds, too."""
    joints: dict[str, DrawnJoint] = {}
    held: dict[str, list[str]] = {}
    guides = []
    place, end = len("M["), text.rstrip().rfind("]")
    while place < end:
        found = JOINT.match(text, place, end)
        if found is None:
            raise damaged()
        place = found.end()
        own = f"P{len(joints)}"
        links = [link.strip() for link in found["links"].split(",") if link.strip()]
        kind = found["kind"]
        if kind not in KINDS or (kind == "P" and len(links) != 2) or (kind != "R" and not links):
            raise refused(
                message(
                    "joint {name} is of kind {kind} between {count} links",
                    name=own,
                    kind=named(kind),
                    count=len(links),
                ),
                message("pins, pins in slots, and blocks between two links"),
            )
        slotted, *on_pin = links if kind != "R" else ["", *links]
        if kind == "P" and on_pin == [FRAME_NAME]:
            slotted, on_pin = FRAME_NAME, [slotted]
        at = complex(number(found["x"]), number(found["y"]))
        joints[own] = DrawnJoint(own, at, FRAME_NAME in on_pin)
        few(len(joints) + len(links))
        for link in on_pin:
            if link != FRAME_NAME:
                held.setdefault(link, []).append(own)
        if slotted:
            block = f"block {own}" if kind == "RP" else on_pin[0]
            on = "" if slotted == FRAME_NAME else slotted
            if kind == "RP":
                held[block] = [own]
            guides.append(DrawnGuide(block, own, on, angle=radians(number(found["angle"] or "0"))))
    few(len(held))
    bodies = {link: DrawnLink(link, tuple(owns)) for link, owns in held.items()}
    notes = (message("lengths have no unit in the file; mm are written"),)
    return Imported(PROGRAM, "mm", ROUNDING, joints, bodies, tuple(guides), (), notes)
