"""Draw the marks of a page with matplotlib, lettering included: in axes, or as a PNG file."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from matplotlib.font_manager import FontProperties
from matplotlib.patches import Patch, PathPatch
from matplotlib.path import Path
from matplotlib.textpath import TextPath
from matplotlib.transforms import Affine2D, ScaledTranslation, Transform

from graphkin.drawing.field import Field
from graphkin.drawing.marks import (
    Arc,
    CircleMark,
    LineMark,
    Mark,
    Page,
    Polyline,
    Text,
    reach,
    style_class,
)
from graphkin.drawing.richtext import font_file, runs
from graphkin.drawing.style import Ink, Style, style_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

INCH = 25.4
DOTS = 150
"""Dots per inch of a PNG."""
POINTS = 72 / INCH
SIGNS = ("pole", "point", "pin", "centre", "number")
"""The classes of figures with a fixed size, independent of the drawing's scale."""


def put_marks(
    ax: Axes, marks: Sequence[Mark], origin: tuple[float, float], ink: Ink = "colour"
) -> None:
    """Draw marks to scale in mm, with lettering, and a place of the page at the axes' origin."""
    page = Affine2D().translate(-origin[0], -origin[1]).scale(1, -1)
    for order, mark in enumerate(marks):
        for patch in patches(mark, style_of(mark.cls, ink), page):
            put(ax, patch, order / len(marks))
    ax.set_aspect("equal")


def put_drawing(
    ax: Axes, marks: Sequence[Mark], field: Field, times: float, ink: Ink = "colour"
) -> None:
    """Draw the marks of a field in the size of the axes; set the limits and equal scales.

    One unit of the axes is ``times`` a millimetre of the figure. Letters and symbols keep their
    size in the figure when the axes are resized later.
    """
    x, y = field(0j)
    put_to_scale(ax, marks, (x, y), times, ink)
    width, height = size_of(ax)
    ax.set_xlim(-x / times, (width - x) / times)
    ax.set_ylim((y - height) / times, y / times)
    ax.set_aspect("equal")


def put_to_scale(
    ax: Axes,
    marks: Sequence[Mark],
    origin: tuple[float, float],
    times: float,
    ink: Ink = "colour",
    strength: float = 1.0,
) -> None:
    """Draw marks in axes with one unit equal to ``times`` a millimetre of the figure.

    ``origin`` is the place of the page at the axes' origin. Letters and symbols keep their size.
    ``strength`` is the opacity of lines.
    """
    page = Affine2D().translate(-origin[0], -origin[1]).scale(1 / times, -1 / times)
    for order, mark in enumerate(marks):
        place = place_of(mark)
        there = Affine2D().translate(-place[0], -place[1]).scale(1, -1) if place else page
        for patch in patches(mark, style_of(mark.cls, ink), there):
            if place:
                patch.set_transform(in_place(ax, *page.transform(place)))
            patch.set_alpha(1.0 if isinstance(mark, Text) else strength)
            put(ax, patch, order / len(marks))


def write_png(page: Page, ink: Ink = "colour", dots: int = DOTS) -> bytes:
    """A page as a PNG on white, the same bytes every time."""
    import io

    from matplotlib.backends.backend_agg import RendererAgg
    from PIL import Image

    page.check()
    scale = dots / INCH
    wide, high = round(page.width * scale), round(page.height * scale)
    renderer: Any = RendererAgg(wide, high, dots)  # type: ignore[no-untyped-call]
    paper = Affine2D().scale(1, -1).translate(0, page.height)
    pixels = Affine2D().scale(scale)
    for mark in page.marks:
        for patch in patches(mark, style_of(mark.cls, ink, page.weight), paper):
            patch.set_transform(pixels)
            patch.draw(renderer)
    image = Image.fromarray(np.asarray(renderer.buffer_rgba()))
    found = Image.new("RGB", image.size, "white")
    found.paste(image, mask=image)
    out = io.BytesIO()
    found.save(out, "PNG", dpi=(dots, dots), compress_level=4)
    return out.getvalue()


def in_place(ax: Axes, x: float, y: float) -> Transform:
    """Millimetres of the figure about a place of the axes."""
    size = Affine2D().scale(1 / INCH) + ax.figure.dpi_scale_trans
    moved = cast("Any", ScaledTranslation)  # the stub wants an affine transform
    return cast("Transform", size + moved(x, y, ax.transData))


def size_of(ax: Axes) -> tuple[float, float]:
    """Width and height of axes in a figure, in mm."""
    figure = ax.figure
    box = ax.get_position(original=True).transformed(figure.transSubfigure)
    return box.width / figure.dpi * INCH, box.height / figure.dpi * INCH


def place_of(mark: Mark) -> tuple[float, float] | None:
    """The place of a text, a symbol or an arrowhead; None for marks drawn to scale."""
    kind = style_class(mark)
    if isinstance(mark, Polyline) and kind == "arrowhead":
        return mark.points[0]
    if isinstance(mark, LineMark) or not (isinstance(mark, Text) or kind in SIGNS):
        return None
    left, top, right, bottom = reach(mark)
    return (left + right) / 2, (top + bottom) / 2


def put(ax: Axes, patch: Patch, order: float) -> None:
    """Add one patch to axes; a greater order is above."""
    patch.set_zorder(2 + order)
    ax.add_artist(patch)  # add_patch measures each one, and the limits are set by themselves


def patches(mark: Mark, style: Style, page: Affine2D) -> Iterator[Patch]:
    """The patches of one mark: one for a line or figure, one for each run of a text."""
    if isinstance(mark, Text):
        for run in runs(mark.markup, mark.height):
            turned = Affine2D().scale(1, -1).translate(mark.left() + run.x, run.y)
            turned = turned.rotate_deg(-mark.rotate).translate(mark.x, mark.y)
            letters = outlines(run.text, run.size, run.italic)
            shape = (turned + page).transform_path(letters)
            yield PathPatch(shape, fc=style.colour, lw=0, snap=False)  # whole pixels would bend ⊥
        return
    path, closed = path_of(mark)
    filled = bool(closed and style.fill)
    if style.width or filled:
        width = style.width * POINTS
        dash = (0, tuple(d / style.width for d in style.dash)) if style.dash and width else "solid"
        yield PathPatch(
            page.transform_path(path),
            fc=style.fill if filled else "none",
            ec=style.colour if style.width else "none",
            lw=width,
            ls=dash,
            capstyle="round" if style.round else "butt",
            joinstyle="round" if style.round else "miter",
        )


def path_of(mark: Mark) -> tuple[Path, bool]:
    """The outline of a mark on the page, and whether it is closed."""
    if isinstance(mark, LineMark):
        return Path([(mark.x1, mark.y1), (mark.x2, mark.y2)]), False
    if isinstance(mark, CircleMark):
        return Path.circle((mark.cx, mark.cy), mark.r), True
    if isinstance(mark, Arc):
        low, high = sorted((mark.start, mark.end))
        unit = cast("Any", Path).arc(low, high)  # the stub may want whole degrees
        place = Affine2D().scale(mark.r, -mark.r).translate(mark.cx, mark.cy)
        return place.transform_path(unit), False
    assert not isinstance(mark, Text)
    ends = [mark.points[0]] if mark.closed else []
    return Path([*mark.points, *ends], closed=mark.closed), mark.closed


@lru_cache(maxsize=2048)
def outlines(text: str, size: float, italic: bool) -> Path:
    """The outlines of letters from the origin, y up."""
    return TextPath((0, 0), text, size=size, prop=face(italic))


@lru_cache(maxsize=2)
def face(italic: bool) -> FontProperties:
    """The sheet's own font."""
    return FontProperties(fname=str(font_file(italic)))
