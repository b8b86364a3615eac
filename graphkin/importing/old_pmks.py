"""PMKS, the program before PMKS+: the content of its links, ``mech=`` and ``set=``.

Each joint has the names of its links, its type, place, angle in degrees and four flags, the last of
them for the driver, with commas or blanks between them: ``ground,crank,R,0,0,tfft|``. A pin in a
slot (RP) does not say which of its links has the slot, and a gear (G) has no size.
"""

from __future__ import annotations

from math import pi, radians
from urllib.parse import parse_qs

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

PROGRAM = "PMKS"
FRAME_NAME = "ground"
TYPES = ("R", "P", "RP", "G")
ROUNDING = 1e-3
MOST_FIELDS = 8


def mech_text(text: str) -> Imported:
    """The mechanism of a link, from what follows its question mark.

    Raises SceneError for a pin in a slot and for a gear, too.
    """
    fields = parse_qs(text, keep_blank_values=True, max_num_fields=MOST_FIELDS)
    said = fields["mech"][0].replace("\n", "|").split("|")
    lines = [line.replace(",", " ").split() for line in said]
    lines = [line for line in lines if line]
    few(len(lines))
    joints: dict[str, DrawnJoint] = {}
    held: dict[str, list[str]] = {}
    guides: list[DrawnGuide] = []
    inputs: list[DrawnInput] = []
    speed = next((s[1:] for s in fields.get("set", [""])[0].split("|") if s[:1] == "s"), "1")
    for place, line in enumerate(lines):
        own = chr(ord("A") + place) if place < 26 else f"P{place}"
        kind = next((each for each in line if each in TYPES), None)
        if kind is None:
            raise damaged()
        links, (x, y, *others) = line[: line.index(kind)], line[line.index(kind) + 1 :]
        if kind not in ("R", "P") or not links or (kind == "P" and len(links) != 2):
            raise refused(
                message(
                    "joint {name} is of kind {kind} between {count} links",
                    name=own,
                    kind=named(kind),
                    count=len(links),
                ),
                message("pins, and blocks between two links"),
            )
        *angles, flags = others
        driven = flags[3:4] in ("t", "+", "1")
        moving = [link for link in dict.fromkeys(links) if link != FRAME_NAME]
        few(len(lines) + len(held) + len(moving))
        fixed = FRAME_NAME in links
        joints[own] = DrawnJoint(own, complex(number(x), number(y)), fixed and kind == "R")
        if not moving or (driven and len(links) < 2):
            raise damaged()
        for link in moving if kind == "R" else moving[:1]:
            held.setdefault(link, []).append(own)
        against = "" if fixed else moving[-1]
        if kind == "P":
            angle = radians(number(angles[0] if angles else "0"))
            guides.append(DrawnGuide(moving[0], own, against, angle=angle))
        if driven:
            rate = number(speed)
            about = DrawnInput(moving[0], rate * 30 / pi, own, against)
            inputs.append(about if kind == "R" else DrawnInput(moving[0], rate))
    bodies = {link: DrawnLink(link, tuple(owns)) for link, owns in held.items()}
    notes = [message("lengths have no unit in the file; mm are written")]
    if inputs:
        notes.append(message("the speed {speed} is taken as radians per second", speed=speed))
    return Imported(
        PROGRAM, "mm", ROUNDING, joints, bodies, tuple(guides), tuple(inputs), tuple(notes)
    )
