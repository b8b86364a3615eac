"""A page drawn by plain matplotlib artists, one for each mark, as one does who has no backend."""

from __future__ import annotations

from io import BytesIO

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Arc as ArcPatch
from matplotlib.patches import Circle as CirclePatch
from matplotlib.patches import Polygon

from graphkin.drawing.marks import Arc, CircleMark, LineMark, Page, Polyline, Text
from graphkin.drawing.richtext import plain

POINTS_PER_MM = 72 / 25.4


def drawn(page: Page) -> Figure:
    """The page's marks as matplotlib artists, millimetres as data."""
    figure = Figure(figsize=(page.width / 25.4, page.height / 25.4))
    FigureCanvasAgg(figure)
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=(0, page.width), ylim=(page.height, 0))
    axes.axis("off")
    for mark in page.marks:
        match mark:
            case LineMark():
                axes.plot([mark.x1, mark.x2], [mark.y1, mark.y2], linewidth=0.7)
            case Polyline():
                axes.add_patch(Polygon(mark.points, closed=mark.closed, fill=False))
            case CircleMark():
                axes.add_patch(CirclePatch((mark.cx, mark.cy), mark.r, fill=False))
            case Arc():
                size = 2 * mark.r
                axes.add_patch(
                    ArcPatch((mark.cx, mark.cy), size, size, theta1=mark.start, theta2=mark.end)
                )
            case Text():
                size = mark.height * POINTS_PER_MM
                axes.text(mark.x, mark.y, plain(mark.markup), fontsize=size)
    return figure


def both_files(page: Page) -> int:
    """The page as SVG and PDF; the number of bytes."""
    figure, total = drawn(page), 0
    for kind in ("svg", "pdf"):
        out = BytesIO()
        figure.savefig(out, format=kind)
        total += len(out.getvalue())
    return total
