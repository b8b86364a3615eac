"""Linkage: connectors and links of a ``.linkage2`` file, in 96ths of an inch."""

from __future__ import annotations

from collections.abc import Mapping
from xml.etree.ElementTree import Element, ParseError

from defusedxml import DefusedXmlException
from defusedxml.ElementTree import fromstring

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
from graphkin.text.errors import Message, message

PROGRAM = "Linkage"
PER_INCH = 96
UNITS = {"Millimeters": ("mm", 25.4 / PER_INCH), "Inches": ("in", 1 / PER_INCH)}
ROUNDING = 1e-5
OTHER_KINDS = ("gear", "actuator")


def linkage_text(text: str) -> Imported:
    """The mechanism of a file. Raises SceneError for gears and actuators too."""
    try:
        root = fromstring(text, forbid_dtd=True)
    except (ParseError, DefusedXmlException, ValueError):
        raise refused(message("the text is no XML that is safe to read")) from None
    program = root.find("program")
    unit, factor, notes = units(program)
    connectors, links = root.findall("connector"), root.findall("Link")
    few(len(connectors))
    few(len(links))
    refuse_others(links)
    joints = {}
    for each in connectors:
        place = complex(number(each.get("x", ""), factor), number(each.get("y", ""), factor))
        joints[each.attrib["id"]] = DrawnJoint(
            f"P{each.attrib['id']}", place, is_set(each, "anchor")
        )
    bodies = {}
    for link in links:
        held = tuple(each.attrib["id"] for each in link.findall("connector"))
        if not all(joint in joints for joint in held):
            raise damaged()
        own = f"link {link.attrib['id']}"
        bodies[own] = DrawnLink(link.get("name") or own, held)
    guides: list[DrawnGuide] = []
    for each in connectors:
        if is_set(each, "slider"):
            add_block(each, joints, bodies, guides)
    inputs = tuple(driven(each, joints, bodies) for each in connectors if is_set(each, "input"))
    if inputs:
        notes = (
            *notes,
            message("a positive speed is taken as counter-clockwise, y as upwards: compare"),
        )
    return Imported(PROGRAM, unit, ROUNDING, joints, bodies, tuple(guides), inputs, notes)


def units(program: Element | None) -> tuple[str, float, tuple[Message, ...]]:
    """The unit of length, the factor of coordinates to it, and what is to be said of them."""
    said = {} if program is None else program.attrib
    notes: list[Message] = []
    name = said.get("units", "Millimeters")
    if name not in UNITS:
        notes.append(message("unit {name} is unknown; mm are written", name=named(name)))
    if number(said.get("scalefactor", "1")) != 1.0:
        notes.append(message("the scale factor is left out: lengths are as on the screen"))
    unit, factor = UNITS.get(name, UNITS["Millimeters"])
    return unit, factor, tuple(notes)


def refuse_others(links: list[Element]) -> None:
    """Raise SceneError for links that move in other ways than by pins and slots."""
    for link in links:
        if any(is_set(link, kind) for kind in OTHER_KINDS):
            name = link.get("name") or link.attrib["id"]
            raise refused(
                message(
                    "link {name} is a gear or an actuator, which is not imported", name=named(name)
                ),
                message("pins and slots"),
            )


def add_block(
    slider: Element,
    joints: Mapping[str, DrawnJoint],
    bodies: dict[str, DrawnLink],
    guides: list[DrawnGuide],
) -> None:
    """Add the block of a sliding connector, in the slot between two others."""
    own = slider.attrib["id"]
    one, other = (limit.attrib["id"] for limit in slider.findall("slidelimit"))
    if joints[one].fixed and joints[other].fixed:
        on = ""
    else:
        both = (n for n, body in bodies.items() if {one, other} <= {*body.joints})
        found = next(both, None)
        if found is None:
            raise refused(
                message("the ends of the slot of connector {name} are on no link", name=named(own))
            )
        on = found
    block = f"block {own}"
    bodies[block] = DrawnLink(block, (own,))
    guides.append(DrawnGuide(block, own, on, (one, other)))


def driven(
    each: Element, joints: Mapping[str, DrawnJoint], bodies: Mapping[str, DrawnLink]
) -> DrawnInput:
    """The link that an input connector turns."""
    own = each.attrib["id"]
    at = [name for name, body in bodies.items() if own in body.joints]
    moving = [name for name in at if not all(joints[j].fixed for j in bodies[name].joints)]
    if not moving or (not joints[own].fixed and len(moving) < 2):
        raise damaged()
    against = "" if joints[own].fixed else moving[1]
    return DrawnInput(moving[0], number(each.get("rpm", "0")), own, against)


def is_set(element: Element, name: str) -> bool:
    return element.get(name) == "true"
