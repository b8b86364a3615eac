"""DXF: the lines and polylines of a drawing as bars, with circles and points on them as joints.

A short text beside a point names it. The extra [cad] reads the file.
"""

from __future__ import annotations

import io
from collections import Counter
from collections.abc import Iterator
from itertools import islice, pairwise, product
from typing import Any

from graphkin.importing.record import NEAR, BarFigure, named, number, refused
from graphkin.text.errors import Message, SceneError, joined, message

PROGRAM = "DXF"
UNITS = {1: "in", 4: "mm", 5: "cm", 6: "m"}
"""Units of length by the number of $INSUNITS."""
MOST_LINES = 1000
LONGEST_NAME = 4
FARTHEST_NAME = 4.0
"""How far a name may be from its point, in heights of its letters."""
BINARY = "AutoCAD Binary DXF"


def dxf_figure(text: str) -> BarFigure:
    """The drawing of a text file. Raises SceneError where ezdxf is missing or cannot read it."""
    if text.startswith(BINARY):
        raise refused(message("the file is a binary DXF"), message("a DXF file saved as text"))
    try:
        import ezdxf
        from ezdxf.lldxf.const import DXFError
    except ImportError:
        hint = message("install it: pip install 'graphkin[cad]'")
        raise SceneError.at("dxf", message("needs ezdxf"), hint=hint) from None
    try:
        drawing = ezdxf.read(io.StringIO(text))
        entities = [*drawing.modelspace()]
    except (DXFError, ValueError, KeyError, IndexError, TypeError, AttributeError):
        raise refused(message("the DXF file is damaged")) from None
    return DrawingReader(entities).figure(UNITS.get(drawing.units, ""))


class DrawingReader:
    """The points and bars of the entities of a drawing."""

    def __init__(self, entities: list[Any]) -> None:
        self.ways = [way for each in entities for way in ways_of(each)]
        spots = [each for each in entities if each.dxftype() in ("CIRCLE", "POINT")]
        lines(len(self.ways) + len(spots))
        places = (e.dxf.center if e.dxftype() == "CIRCLE" else e.dxf.location for e in spots)
        self.marks = [flat(place) for place in places]
        self.labels = [label for each in entities for label in label_of(each)]
        known = {"LINE", "LWPOLYLINE", "POLYLINE", "CIRCLE", "POINT", "TEXT", "MTEXT"}
        self.others = Counter(e.dxftype() for e in entities if e.dxftype() not in known)
        every = [place for _, way in self.ways for place in way] + self.marks
        self.near = NEAR * (max(map(abs, every), default=1.0) or 1.0)
        self.places: list[complex] = []
        self.cells: dict[tuple[int, int], int] = {}

    def figure(self, unit: str) -> BarFigure:
        """The drawing with names of points."""
        bars = list[tuple[int, ...]]()
        for closed, way in self.ways:
            ends = [self.point(place) for place in way]
            bars += [tuple(dict.fromkeys(ends))] if closed else [*pairwise(ends)]
        for place in self.marks:
            self.point(place)
        lines(len(bars))
        names = self.names()
        notes = list[Message]()
        if self.others:
            each = [
                message("{count} {kind}", count=n, kind=named(k)) for k, n in self.others.items()
            ]
            notes.append(message("no links, and left out: {kinds}", kinds=joined(", ", each)))
        return BarFigure(
            PROGRAM,
            {names[own]: place for own, place in enumerate(self.places)},
            tuple(tuple(names[own] for own in bar) for bar in bars if len({*bar}) > 1),
            unit,
            tuple(notes),
        )

    def point(self, place: complex) -> int:
        """The number of the point at a place."""
        x, y = (round(part / self.near) for part in (place.real, place.imag))
        for cell in product((x - 1, x, x + 1), (y - 1, y, y + 1)):
            if cell in self.cells:
                return self.cells[cell]
        self.cells[x, y] = len(self.places)
        self.places.append(place)
        return self.cells[x, y]

    def names(self) -> list[str]:
        """A name for each point: of the nearest short text, or P with its number."""
        found: dict[int, str] = {}
        for text, place, height in self.labels:
            free = [own for own in range(len(self.places)) if own not in found]
            own = min(free, key=lambda own: abs(self.places[own] - place), default=None)
            if own is not None and abs(self.places[own] - place) <= FARTHEST_NAME * height:
                found[own] = text if text not in found.values() else f"{text}{own}"
        return [found.get(own, f"P{own}") for own in range(len(self.places))]


def lines(count: int) -> None:
    """Raise SceneError for more lines than are read; those of a title block count, too."""
    if count > MOST_LINES:
        raise refused(message("more than {most} lines", most=MOST_LINES))


def ways_of(entity: Any) -> Iterator[tuple[bool, list[complex]]]:
    """The corners of a line or polyline, and whether it is closed."""
    kind = entity.dxftype()
    if kind == "LINE":
        yield False, [flat(entity.dxf.start), flat(entity.dxf.end)]
    elif kind in ("LWPOLYLINE", "POLYLINE"):
        corners = entity.vertices() if kind == "LWPOLYLINE" else entity.points()
        way = [flat(corner) for corner in islice(corners, MOST_LINES)]
        yield bool(entity.closed if kind == "LWPOLYLINE" else entity.is_closed), way


def label_of(entity: Any) -> Iterator[tuple[str, complex, float]]:
    """A short text with its place and height."""
    if entity.dxftype() in ("TEXT", "MTEXT"):
        text = (entity.dxf.text if entity.dxftype() == "TEXT" else entity.plain_text()).strip()
        height = entity.dxf.height if entity.dxftype() == "TEXT" else entity.dxf.char_height
        if text.isalnum() and text[0].isalpha() and len(text) <= LONGEST_NAME:
            yield text, flat(entity.dxf.insert), float(height)


def flat(place: Any) -> complex:
    """A place as a complex number. Raises SceneError where it is too far away."""
    x, y = place[0], place[1]
    return complex(number(str(x)), number(str(y)))
