"""Linkage: connectors and links of a ``.linkage2`` file, in 96ths of an inch.

An older ``.linkage`` file is read in the same way.

Layer 1 is for drawing only. An actuator is a tube about its first connector, and a rod to its
second. A link in whose slot two connectors of one body slide is a rod in bushings.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import pairwise
from xml.etree.ElementTree import Element

from graphkin.importing.record import (
    DrawnGear,
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
    safe_xml,
    unknown_unit,
)
from graphkin.text.errors import Message, message

PROGRAM = "Linkage"
NEWEST = "linkage2"
PER_INCH = 96
UNITS = {"Millimeters": ("mm", 25.4 / PER_INCH), "Inches": ("in", 1 / PER_INCH)}
ROUNDING = 1e-5
DRAWING = 1
STROKES = 2 / 60
"""Strokes per second at one cycle per minute."""


def linkage_text(text: str) -> Imported:
    """The mechanism of a file. Raises SceneError for curved slots and actuators that bend too."""
    root = safe_xml(text, message("the whole file, as Linkage saves it"))
    unit, factor, notes = units(root.find("program"))
    if root.tag != NEWEST:
        notes = (*notes, message("an older file of Linkage is read as a new one: compare"))
    few(len(root.findall("connector")))
    few(len(root.findall("Link")) + len(root.findall("element")))
    connectors = [each for each in root.findall("connector") if works(each)]
    links = [each for each in (*root.findall("Link"), *root.findall("element")) if works(each)]
    joints = {}
    for each in connectors:
        own = each.attrib["id"]
        if own in joints:
            raise refused(message("two connectors have the id {name}", name=named(own)))
        name = each.get("name") or f"P{own}"
        joints[own] = DrawnJoint(name, place_of(each, factor), is_set(each, "anchor"))
    if not any(joint.fixed for joint in joints.values()):
        raise refused(message("no connector is an anchor"), message("at least one anchor"))
    bodies: dict[str, DrawnLink] = {}
    guides: list[DrawnGuide] = []
    strokes: list[DrawnInput] = []
    sliders = [each for each in connectors if is_set(each, "slider")]
    sliding = {each.attrib["id"] for each in sliders}
    for place, link in enumerate(links):
        held = tuple(each.attrib["id"] for each in link.findall("connector"))
        own = body_name(link, place)
        name = (link.get("name") or "").strip() or f"link {link.attrib['id']}"
        if missing := [joint for joint in held if joint not in joints]:
            raise refused(
                message(
                    "{link} has connector {name}, which the file does not have",
                    link=named(name),
                    name=named(missing[0]),
                )
            )
        if is_set(link, "actuator"):
            strokes.append(add_cylinder(own, name, held, link, factor, bodies, guides))
        elif not {*held} <= sliding or len(held) > 1:
            bodies[own] = DrawnLink(name, held)
    for rod, first, second in rods(sliders, joints, bodies):
        sliders = [each for each in sliders if each not in (first, second)]
        add_rod(rod, first, second, joints, bodies, guides)
    for each in sliders:
        add_block(each, joints, bodies, guides)
    fastened = fasten(links, bodies)
    gears = tuple(geared(root, links, fastened))
    if any(gear.belt for gear in gears):
        notes = (*notes, message("the wheels of a chain are drawn in its ratio, not in its size"))
    wheels = {own for gear in gears for own in (gear.one, gear.other)}
    inputs = tuple(
        driven(each, joints, bodies, wheels) for each in connectors if is_set(each, "input")
    )
    if strokes:
        notes = (
            *notes,
            message("a cylinder extends at its mean speed: strokes in and out per minute"),
        )
    if inputs:
        notes = (
            *notes,
            message("a positive speed is taken as counter-clockwise, y as upwards: compare"),
        )
    return Imported(
        PROGRAM, unit, ROUNDING, joints, bodies, tuple(guides), (*inputs, *strokes), notes, gears
    )


def place_of(connector: Element, factor: float) -> complex:
    """The place of a connector. Raises SceneError with its name where it has none."""
    both = connector.get("x", ""), connector.get("y", "")
    if not all(part.strip() for part in both):
        raise refused(
            message("connector {name} has no place", name=named(connector.attrib["id"])),
            message("its x and y"),
        )
    return complex(*(number(part, factor) for part in both))


def works(element: Element) -> bool:
    """Whether an element belongs to the mechanism, and is not only drawn or measured."""
    layer = int(element.get("layer") or 0)
    return layer != DRAWING and not is_set(element, "measurementelement")


def body_name(link: Element, place: int) -> str:
    """The name of a body: files give several links one id."""
    return f"link {link.attrib['id']} at {place}"


def units(program: Element | None) -> tuple[str, float, tuple[Message, ...]]:
    """The unit of length, the factor of coordinates to it, and what is to be said of them."""
    said = {} if program is None else program.attrib
    notes: list[Message] = []
    name = said.get("units", "Millimeters")
    if name not in UNITS:
        notes.append(unknown_unit(name, "mm"))
    if number(said.get("scalefactor", "1")) != 1.0:
        notes.append(message("the scale factor is left out: lengths are as on the screen"))
    unit, factor = UNITS.get(name, UNITS["Millimeters"])
    return unit, factor, tuple(notes)


def add_cylinder(
    own: str,
    name: str,
    held: tuple[str, ...],
    link: Element,
    factor: float,
    bodies: dict[str, DrawnLink],
    guides: list[DrawnGuide],
) -> DrawnInput:
    """Add the tube and the rod of an actuator; return how it is driven."""
    if len(held) != 2:
        raise refused(
            message("actuator {name} has other connectors than its ends", name=named(name)),
            message("an actuator with two connectors"),
        )
    tube, rod = f"{own}, tube", f"{own}, rod"
    bodies[tube] = DrawnLink(name, held[:1])
    bodies[rod] = DrawnLink(name, held[1:])
    guides.append(DrawnGuide(rod, held[1], tube, tube=held[0]))
    speed = STROKES * number(link.get("throw", "0"), factor) * number(link.get("cpm", "0"))
    return DrawnInput(rod, speed)


def ends_of(slider: Element) -> tuple[str, str]:
    """The two connectors between which another slides. Raises SceneError for a curved slot."""
    if number(slider.get("slideradius") or "0"):
        raise refused(
            message("the slot of connector {name} is curved", name=named(slider.attrib["id"])),
            message("straight slots"),
        )
    ends = [limit.attrib["id"] for limit in slider.findall("slidelimit")]
    if len(ends) != 2:
        raise refused(
            message("connector {name} slides in no slot", name=named(slider.attrib["id"])),
            message("two slidelimit, the ends of its slot"),
        )
    return ends[0], ends[1]


def rods(
    sliders: list[Element], joints: Mapping[str, DrawnJoint], bodies: Mapping[str, DrawnLink]
) -> Iterator[tuple[str, Element, Element]]:
    """The moving links in whose slot two connectors of one body slide, with these connectors."""
    for rod, body in bodies.items():
        on = [each for each in sliders if {*ends_of(each)} <= {*body.joints}]
        if all(joints[joint].fixed for joint in body.joints):
            continue
        for one, other in pairwise(on):
            same = {*ends_of(one)} == {*ends_of(other)}
            if same and carrier(one, other, joints, bodies) is not None:
                yield rod, one, other
                break


def carrier(
    one: Element, other: Element, joints: Mapping[str, DrawnJoint], bodies: Mapping[str, DrawnLink]
) -> str | None:
    """The body that has two connectors, empty for the frame; None where there is none."""
    both = {one.attrib["id"], other.attrib["id"]}
    if all(joints[own].fixed for own in both):
        return ""
    return next((own for own, body in bodies.items() if both <= {*body.joints}), None)


def add_rod(
    rod: str,
    one: Element,
    other: Element,
    joints: Mapping[str, DrawnJoint],
    bodies: Mapping[str, DrawnLink],
    guides: list[DrawnGuide],
) -> None:
    """Add the guide of a rod in two bushings."""
    on = carrier(one, other, joints, bodies)
    assert on is not None
    bushings = (one.attrib["id"], other.attrib["id"])
    guides.append(DrawnGuide(rod, ends_of(one)[0], on, bushings))


def fasten(links: list[Element], bodies: dict[str, DrawnLink]) -> dict[str, str]:
    """The body of each link by its id; a link that is fastened to another becomes a part of it."""
    names = {link.attrib["id"]: body_name(link, place) for place, link in enumerate(links)}
    for link in links:
        own, other = link.attrib["id"], link.get("fastenlink")
        if other is None or names.get(other, "") not in bodies or names[own] not in bodies:
            continue
        part, whole = names[own], names[other]
        if part != whole:
            joints = dict.fromkeys((*bodies[whole].joints, *bodies.pop(part).joints))
            bodies[whole] = DrawnLink(bodies[whole].name, tuple(joints))
            names |= {each: whole for each, body in names.items() if body == part}
    return names


def geared(root: Element, links: list[Element], names: Mapping[str, str]) -> Iterator[DrawnGear]:
    """The pairs of wheels; the first connector of a gear is its centre."""
    centres = {link.attrib["id"]: link.find("connector") for link in links}
    for ratio in root.iterfind("ratios/ratio"):
        one, other = (each.attrib["id"] for each in ratio.findall("link"))
        p, q = (number(each.get("size", "")) for each in ratio.findall("link"))
        first, second = centres[one], centres[other]
        if p <= 0 or q <= 0 or first is None or second is None:
            raise damaged()
        yield DrawnGear(
            names[one],
            names[other],
            (first.attrib["id"], second.attrib["id"]),
            (p, q),
            ratio.get("type") != "gears",
        )


def add_block(
    slider: Element,
    joints: Mapping[str, DrawnJoint],
    bodies: dict[str, DrawnLink],
    guides: list[DrawnGuide],
) -> None:
    """Add the block of a sliding connector, in the slot between two others."""
    own = slider.attrib["id"]
    one, other = ends_of(slider)
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
    each: Element,
    joints: Mapping[str, DrawnJoint],
    bodies: Mapping[str, DrawnLink],
    wheels: set[str],
) -> DrawnInput:
    """The link that an input connector turns."""
    own = each.attrib["id"]
    at = [name for name, body in bodies.items() if own in body.joints]
    moving = [
        name
        for name in at
        if name in wheels or not all(joints[j].fixed for j in bodies[name].joints)
    ]
    if not moving or (not joints[own].fixed and len(moving) < 2):
        raise damaged()
    against = "" if joints[own].fixed else moving[1]
    return DrawnInput(moving[0], number(each.get("rpm", "0")), own, against)


def is_set(element: Element, name: str) -> bool:
    return element.get(name) == "true"
