"""A mechanism as a file of another program: Linkage and pylinkage here, PMKS+ beside.

Both programs know pins, bars and plates, cranks about fixed pins, and blocks with one pin. Linkage
has guides on the frame and along two joints of a link; pylinkage has them on the frame only.
Anything else is refused, never left out.
"""

from __future__ import annotations

from cmath import phase
from collections.abc import Callable, Mapping
from math import pi
from typing import Any
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from msgspec.json import encode, format

from graphkin.construction.core.drawn_scene import METRES
from graphkin.documents.pmks_file import along, not_cranks, pmks_file, without_counterpart
from graphkin.mechanism import Mechanism
from graphkin.scene.model import FRAME, Link, Slide
from graphkin.structure.turning import guide_line
from graphkin.text.errors import NO_WORDS, PageError, Problem, message

PER_INCH = 96
LAYER = "16"
"""The layer of mechanisms in Linkage."""
DIGITS = 9
"""Decimals of a coordinate."""


def linkage_file(mechanism: Mechanism) -> bytes:
    """A mechanism as a ``.linkage2`` file. Raises PageError for what Linkage does not have.

    The ends of a fixed guide are anchors on a link of their own.
    """
    sent = SentMechanism(mechanism, "Linkage", moving_guides=True)
    inches = mechanism.scene.units["length"] == "in"
    root = Element("linkage2")
    SubElement(root, "program", units="Inches" if inches else "Millimeters", scalefactor="1")
    ids = {point: str(number) for number, point in enumerate(sent.at, 1)}
    tracks: list[tuple[str, str]] = []
    later: list[tuple[str, complex]] = []
    for point, place in sent.at.items():
        more = {"anchor": "true"} if point in sent.fixed else {}
        speed = next((speed for about, speed in sent.cranks.values() if about == point), None)
        if speed is not None:
            more |= {"input": "true", "rpm": decimal(speed * 30 / pi)}
        connector = add_connector(root, ids[point], place, name=point, **more)
        if slide := sent.slides.get(point):
            connector.set("slider", "true")
            if slide.on == FRAME:
                ends = (str(len(ids) + len(later) + n) for n in (1, 2))
                track = (next(ends), next(ends))
                way = guide_line(mechanism.scene, slide).along * sent.extent
                later += zip(track, (place - way, place + way), strict=True)
                tracks.append(track)
            else:
                one, other = along(mechanism.scene, slide)
                track = (ids[one], ids[other])
            for end in track:
                SubElement(connector, "slidelimit", id=end)
    for own, place in later:
        add_connector(root, own, place, anchor="true")
    held = [(name, [ids[point] for point in points]) for name, points in sent.bodies.items()]
    held += [("", [*track]) for track in tracks]
    for number, (name, owns) in enumerate(held):
        link = SubElement(root, "Link", id=str(number), layer=LAYER, name=name)
        for own in owns:
            SubElement(link, "connector", id=own)
    indent(root)
    return f"{tostring(root, encoding='unicode')}\n".encode()


def add_connector(root: Element, own: str, place: complex, **more: str) -> Element:
    """Add a connector at a place in metres."""
    x, y = (decimal(part / METRES["in"] * PER_INCH) for part in (place.real, place.imag))
    return SubElement(root, "connector", {"id": own, "layer": LAYER, "x": x, "y": y, **more})


def pylinkage_file(mechanism: Mechanism) -> bytes:
    """A mechanism as the JSON of pylinkage, in mm and in radians per second for its steps.

    Raises PageError for what pylinkage does not have.
    """
    sent = SentMechanism(mechanism, "pylinkage", moving_guides=False)
    joints: list[dict[str, Any]] = []
    links: list[dict[str, Any]] = [{"id": "ground", "type": "ground", "joints": [*sent.fixed]}]
    for point, place in sent.at.items():
        kind = "ground" if point in sent.fixed else "revolute"
        joint = {"id": point, "type": kind, "position": in_mm(place)}
        if slide := sent.slides.get(point):
            axis = guide_line(mechanism.scene, slide).along
            joint |= {"type": "prismatic", "axis": [axis.real, axis.imag]}
            joint["line_point"] = joint["position"]
        joints.append(joint)
    for name, points in sent.bodies.items():
        link: dict[str, Any] = {"id": name, "type": "link", "joints": points}
        if name in sent.cranks:
            about, speed = sent.cranks[name]
            tip = next((sent.at[point] for point in points if point != about), sent.at[about] + 1)
            link |= {"type": "driver", "motor_joint": about, "angular_velocity": speed}
            link["initial_angle"] = phase(tip - sent.at[about])
        links.append(link)
    whole = {"name": mechanism.scene.name, "joints": joints, "links": links, "ground": "ground"}
    return format(encode(whole), indent=1) + b"\n"


Writer = Callable[[Mechanism], bytes]
PROGRAMS: Mapping[str, Writer] = {
    "linkage": linkage_file,
    "pmks": pmks_file,
    "pylinkage": pylinkage_file,
}
"""The writer of each program's file, by the program's name."""


class SentMechanism:
    """The joints, bodies, guides and cranks of a mechanism, where a program has them all."""

    def __init__(self, mechanism: Mechanism, program: str, *, moving_guides: bool) -> None:
        scene = mechanism.scene
        refused = [*without_counterpart(scene, program, NO_WORDS, moving_guides=moving_guides)]
        refused += [Problem("drivers", found, message("cranks")) for found in not_cranks(scene)]
        if refused:
            raise PageError(refused)
        motion = mechanism.solve()
        links = scene.links.values()
        held = {point for link in links for point in link.points}
        places = {p: complex(motion.points[p].position or 0j) for p in motion.points if p in held}
        self.at = places
        self.fixed = [point for point in places if point in scene.frame.points]
        self.slides: dict[str, Slide] = {
            link.points[0]: link.slides[0] for link in links if link.slides
        }
        driven = {driver.link for driver in scene.drivers}
        self.bodies = {
            link.name: [*link.points]
            for link in sorted(links, key=lambda link: link.name not in driven)
            if not link.slides
        }
        self.cranks = {
            name: (pivot(scene.link(name), self.fixed), float(motion.links[name].omega or 0.0))
            for name in driven
        }
        self.extent = 2 * max(abs(a - b) for a in places.values() for b in places.values())


def pivot(link: Link, fixed: list[str]) -> str:
    return next(point for point in link.points if point in fixed)


def in_mm(place: complex) -> list[float]:
    return [round(part / METRES["mm"], DIGITS) for part in (place.real, place.imag)]


def decimal(number: float) -> str:
    return f"{number:.{DIGITS}f}"
