"""Put the marks of a page into axes of matplotlib, lettering and all, in millimetres with y up."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import lru_cache
from typing import TYPE_CHECKING, Any, cast

from matplotlib.font_manager import FontProperties
from matplotlib.patches import Patch, PathPatch
from matplotlib.path import Path
from matplotlib.textpath import TextPath
from matplotlib.transforms import Affine2D

from graphkin.paper.glyphs import font_file
from graphkin.paper.marks import Arc, Circle, Line, Mark, Text, reach
from graphkin.paper.richtext import runs
from graphkin.paper.style import Ink, Style, style_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

POINTS = 72 / 25.4
"""Points to the millimetre."""
ROOM = 4.0
"""Free room around a drawing, in mm."""


def put_marks(
    ax: Axes, marks: Iterable[Mark], origin: tuple[float, float], ink: Ink = "colour"
) -> None:
    """Draw marks with a place of the page at the axes' origin; sets the limits and equal scales."""
    drawn = list(marks)
    page = Affine2D().translate(-origin[0], -origin[1]).scale(1, -1)
    for order, mark in enumerate(drawn):
        style = style_of(mark.cls, ink)
        for patch in patches(mark, style, page):
            patch.set_zorder(2 + order / len(drawn))
            ax.add_artist(patch)  # add_patch measures each one, and the limits are set below
    boxes = [reach(mark) for mark in drawn] or [(*origin, *origin)]
    ax.set_xlim(
        min(b[0] for b in boxes) - origin[0] - ROOM, max(b[2] for b in boxes) - origin[0] + ROOM
    )
    ax.set_ylim(
        origin[1] - max(b[3] for b in boxes) - ROOM, origin[1] - min(b[1] for b in boxes) + ROOM
    )
    ax.set_aspect("equal")


def patches(mark: Mark, style: Style, page: Affine2D) -> Iterator[Patch]:
    """The patches of one mark: one for a line or figure, one for each run of a text."""
    if isinstance(mark, Text):
        for run in runs(mark.markup, mark.height):
            turned = Affine2D().scale(1, -1).translate(mark.left() + run.x, run.y)
            turned = turned.rotate_deg(-mark.rotate).translate(mark.x, mark.y)
            letters = TextPath((0, 0), run.text, size=run.size, prop=face(run.italic))
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
    if isinstance(mark, Line):
        return Path([(mark.x1, mark.y1), (mark.x2, mark.y2)]), False
    if isinstance(mark, Circle):
        return Path.circle((mark.cx, mark.cy), mark.r), True
    if isinstance(mark, Arc):
        low, high = sorted((mark.start, mark.end))
        unit = cast("Any", Path).arc(low, high)  # the stub may want whole degrees
        place = Affine2D().scale(mark.r, -mark.r).translate(mark.cx, mark.cy)
        return place.transform_path(unit), False
    assert not isinstance(mark, Text)
    ends = [mark.points[0]] if mark.closed else []
    return Path([*mark.points, *ends], closed=mark.closed), mark.closed


@lru_cache(maxsize=2)
def face(italic: bool) -> FontProperties:
    """The sheet's own font."""
    return FontProperties(fname=str(font_file(italic)))
