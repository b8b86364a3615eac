"""GeoGebra: the points, segments and polygons of a ``.ggb`` file, which is a ZIP archive of XML.

Hidden segments and polygons are left out; coordinates are homogeneous.
"""

from __future__ import annotations

import io
from collections import Counter
from collections.abc import Iterator
from contextlib import suppress
from itertools import pairwise
from xml.etree.ElementTree import Element
from zipfile import BadZipFile, ZipFile

from graphkin.importing.record import BarFigure, few, named, number, refused, safe_xml
from graphkin.text.errors import Message, SceneError, joined, message

PROGRAM = "GeoGebra"
INSIDE = "geogebra.xml"
LARGEST_XML = 2 << 20
CHAIN = "PolyLine"
"""The command of a chain of bars; each of the others makes one bar or plate."""
DRAWN = ("Segment", "Polygon", "RigidPolygon", CHAIN)
QUIET = {
    "point",
    "segment",
    "polygon",
    "polyline",
    "numeric",
    "text",
    "angle",
    "boolean",
    "button",
    "image",
}
"""Kinds of element that are read, or that no mechanism has."""


def unpacked(data: bytes) -> str:
    """The XML in the bytes of a ``.ggb`` file. Raises SceneError for another ZIP, or a huge one."""
    try:
        with ZipFile(io.BytesIO(data)) as archive, archive.open(INSIDE) as stream:
            found = stream.read(LARGEST_XML + 1)
    except (BadZipFile, KeyError, OSError, RuntimeError, NotImplementedError, EOFError):
        raise refused(
            message("the archive holds no {name} that can be read", name=INSIDE),
            message("a .ggb file, as GeoGebra saves it"),
        ) from None
    if len(found) > LARGEST_XML:
        raise refused(message("more than {most} bytes", most=LARGEST_XML))
    return found.decode("utf-8", "replace")


def geogebra_figure(text: str) -> BarFigure:
    """The drawing in the XML of a file."""
    root = safe_xml(text, message("the whole file, as GeoGebra saves it"))
    construction = root.find("construction")
    if construction is None:
        raise refused(message("the file has no construction"))
    elements = {each.get("label", ""): each for each in construction.iter("element")}
    points = dict(places(elements))
    few(len(points))
    bars, notes = list[tuple[str, ...]](), list[Message]()
    for command in construction.iter("command"):
        if command.get("name") not in DRAWN:
            continue
        made = [*values(command.find("output"))]
        held = dict.fromkeys(each for each in values(command.find("input")) if each in points)
        held |= dict.fromkeys(each for each in made if each in points)
        drawn = [elements[each] for each in made if each in elements and each not in points]
        if drawn and not any(map(shown, drawn)):
            continue
        if len(held) < 2:
            notes.append(
                message("{name} has no points at its ends and is left out", name=named(made[0]))
                if made
                else message("a segment has no points at its ends and is left out")
            )
        elif command.get("name") == CHAIN:
            bars += pairwise(held)
        else:
            bars.append(tuple(held))
    others = Counter(
        each.get("type", "")
        for each in elements.values()
        if each.get("type", "") not in QUIET and shown(each)
    )
    if others:
        each = [message("{count} {kind}", count=n, kind=named(k)) for k, n in others.items()]
        notes.append(message("no links, and left out: {kinds}", kinds=joined(", ", each)))
    return BarFigure(PROGRAM, points, tuple(bars), notes=tuple(notes))


def places(elements: dict[str, Element]) -> Iterator[tuple[str, complex]]:
    """The place of each point that has one; others are undefined in the drawing, or far away."""
    for label, element in elements.items():
        coords = element.find("coords")
        if element.get("type") == "point" and coords is not None:
            with suppress(SceneError):
                x, y, z = (number(coords.get(name, "")) for name in "xyz")
                if z:
                    yield label, complex(number(str(x / z)), number(str(y / z)))


def values(element: Element | None) -> list[str]:
    return [] if element is None else [*element.attrib.values()]


def shown(element: Element) -> bool:
    show = element.find("show")
    return show is None or show.get("object") != "false"
