"""Write a page as a DXF drawing: in true millimetres, y up, with a layer for each class of mark."""

from __future__ import annotations

from cmath import rect
from collections.abc import Iterable
from io import StringIO
from math import isclose, radians
from typing import Any

from graphkin.drawing.marks import Arc, CircleMark, LineMark, Mark, Page, Polyline, Text
from graphkin.drawing.richtext import advance, capital, runs
from graphkin.drawing.style import Ink, Style, style_of
from graphkin.text.errors import PageError, message

MILLIMETRES = 4
"""The code of millimetres as the DXF drawing unit."""
FACE = "GRAPHKIN"
CONTINUOUS = "CONTINUOUS"
WEIGHTS = (0, 5, 9, 13, 15, 18, 20, 25, 30, 35, 40, 50, 53, 60, 70, 80, 90, 100, 106, 120)
"""The line widths of DXF, in hundredths of a millimetre."""


def write_dxf(page: Page, ink: Ink = "colour") -> bytes:
    """A page as the bytes of a DXF file. Raises PageError if the library is missing."""
    try:
        import ezdxf
        from ezdxf.enums import TextEntityAlignment
    except ImportError:
        hint = message("install it: pip install 'graphkin[cad]'")
        raise PageError.at("dxf", message("needs ezdxf"), hint=hint) from None
    page.check()
    before = ezdxf.options.write_fixed_meta_data_for_testing
    ezdxf.options.write_fixed_meta_data_for_testing = True  # the same page gives the same bytes
    try:
        document = ezdxf.new("R2010", units=MILLIMETRES)
        document.styles.add(FACE, font="DejaVuSans.ttf")
        drawn = Drawer(document, page.height, ink, TextEntityAlignment.FIT)
        drawn.all(page.marks)
        document.set_modelspace_vport(page.height, (page.width / 2, page.height / 2))
        for kind in sorted(document.entitydb.dxf_types_in_use()):  # else in the order of a set
            document.classes.add_class(kind)
        text = StringIO()
        document.write(text)
    finally:
        ezdxf.options.write_fixed_meta_data_for_testing = before
    return text.getvalue().encode("utf-8")


class Drawer:
    """Draws marks in the model space of a document, each on the layer of its class."""

    def __init__(self, document: Any, height: float, ink: Ink, fit: Any) -> None:
        self.document = document
        self.space = document.modelspace()
        self.height = height
        self.ink = ink
        self.fit = fit

    def all(self, marks: Iterable[Mark]) -> None:
        """Draw marks in their order."""
        for mark in marks:
            style = style_of(mark.cls, self.ink)
            look = self.look(mark.cls, style)
            if isinstance(mark, Text):
                self.lettering(mark, look)
            else:
                self.shape(mark, style, look)

    def up(self, x: float, y: float) -> tuple[float, float]:
        """A point of the page with y up from its lower edge."""
        return x, self.height - y

    def look(self, cls: str, style: Style) -> dict[str, Any]:
        """The layer, colour, width and dashes of a mark."""
        layer = cls.split(maxsplit=1)[0]
        if layer not in self.document.layers:
            self.document.layers.add(layer)
        hundredths = min(WEIGHTS, key=lambda weight: abs(weight - 100 * style.width))
        colour = int(style.colour.lstrip("#"), 16)
        return {
            "layer": layer,
            "true_color": colour,
            "lineweight": hundredths,
            "linetype": self.dashes(style.dash),
        }

    def dashes(self, dash: tuple[float, ...]) -> str:
        """The name of the line type for some dashes, in mm."""
        if not dash:
            return CONTINUOUS
        name = "DASH_" + "_".join(f"{length:g}" for length in dash).replace(".", "P")
        if name not in self.document.linetypes:
            ways = [length if n % 2 == 0 else -length for n, length in enumerate(dash)]
            self.document.linetypes.add(name, [sum(dash), *ways])
        return name

    def shape(
        self, mark: LineMark | Polyline | CircleMark | Arc, style: Style, look: dict[str, Any]
    ) -> None:
        """Draw a line, polyline, circle or arc; a mark without an outline is filled."""
        if isinstance(mark, LineMark):
            ends = self.up(mark.x1, mark.y1), self.up(mark.x2, mark.y2)
            if not all(map(isclose, *ends)):
                self.space.add_line(*ends, look)
        elif isinstance(mark, CircleMark) and not style.width:
            edge = self.filled(style, look).add_edge_path()
            edge.add_arc(self.up(mark.cx, mark.cy), mark.r, 0, 360)
        elif isinstance(mark, CircleMark):
            self.space.add_circle(self.up(mark.cx, mark.cy), mark.r, look)
        elif isinstance(mark, Arc):
            start, end = sorted((mark.start, mark.end))
            self.space.add_arc(self.up(mark.cx, mark.cy), mark.r, start, end, True, look)
        else:
            points = [self.up(x, y) for x, y in mark.points]
            if mark.closed and not style.width:
                self.filled(style, look).add_polyline_path(points, is_closed=True)
            else:
                self.space.add_lwpolyline(points, close=mark.closed, dxfattribs=look)

    def filled(self, style: Style, look: dict[str, Any]) -> Any:
        """The hatch paths of a filled surface, on the layer of its mark."""
        colour = int((style.fill or style.colour).lstrip("#"), 16)
        own = {"layer": look["layer"], "true_color": colour}
        return self.space.add_hatch(dxfattribs=own).paths

    def lettering(self, text: Text, look: dict[str, Any]) -> None:
        """Draw a text, each of its runs at its own place, as wide as on the page in any font."""
        turn = rect(1.0, radians(text.rotate))
        for run in runs(text.markup, text.height):
            along = complex(text.left() + run.x, -run.y) * turn
            x, y = self.up(text.x, text.y)
            own = {**look, "style": FACE, "oblique": 12 * run.italic}
            width = advance(run.text, run.italic) * run.size
            made = self.space.add_text(run.text, height=capital() * run.size, dxfattribs=own)
            start, end = complex(x, y) + along, complex(x, y) + along + width * turn
            made.set_placement((start.real, start.imag), (end.real, end.imag), self.fit)
