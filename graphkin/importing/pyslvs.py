"""Pyslvs: an expression ``M[J[R, P[x, y], L[ground, link_1]], …]`` of pins, and pins in slots of
the frame. Each joint names the links that meet there; of a slot, the first link has it.
"""

from __future__ import annotations

import re
from math import radians

from graphkin.importing.record import (
    DrawnGuide,
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
ROUNDING = 1e-4
JOINT = re.compile(
    r"\s*J\[(?P<kind>\w+)(?:, *A\[(?P<angle>[^]]*)\])?(?:, *color\[[^]]*\])?"
    r", *P\[(?P<x>[^],]*),(?P<y>[^],]*)\], *L\[(?P<links>[^]]*)\]\]\s*,?\s*"
)
"""One joint and the comma after it."""


def pyslvs_text(text: str) -> Imported:
    """The mechanism of an expression. Raises SceneError for slots that move, too."""
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
        slotted = found["kind"] == "RP"
        if found["kind"] not in ("R", "RP") or (slotted and links[:1] != [FRAME_NAME]):
            raise refused(
                message(
                    "joint {name} of kind {kind} moves a slot or has no pin",
                    name=own,
                    kind=named(found["kind"]),
                ),
                message("pins, and pins in slots of the frame"),
            )
        at = complex(number(found["x"]), number(found["y"]))
        joints[own] = DrawnJoint(own, at, FRAME_NAME in links and not slotted)
        few(len(joints) + len(links))
        for link in links:
            if link != FRAME_NAME:
                held.setdefault(link, []).append(own)
        if slotted:
            block = f"block {own}"
            held[block] = [own]
            guides.append(DrawnGuide(block, own, angle=radians(number(found["angle"] or "0"))))
    few(len(held))
    bodies = {link: DrawnLink(link, tuple(owns)) for link, owns in held.items()}
    notes = (message("lengths have no unit in the file; mm are written"),)
    return Imported(PROGRAM, "mm", ROUNDING, joints, bodies, tuple(guides), (), notes)
