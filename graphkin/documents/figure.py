"""A drawing laid out for axes of a figure: as large as they are, signs and letters as on paper."""

from __future__ import annotations

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.layout import Layout, centre, spans, with_poles
from graphkin.documents.captions import HEADING
from graphkin.documents.detail import with_detail
from graphkin.documents.sheet import left_board, right_board
from graphkin.drawing.areas import ABOVE, Rect
from graphkin.drawing.field import Field
from graphkin.drawing.labels import FieldContent
from graphkin.drawing.marks import Mark
from graphkin.drawing.scale import Extent
from graphkin.text.errors import PageError, Problem

BESIDE = 12.0
"""Room left and right of a drawing for its letters, in mm."""
EDGE = 1.0
"""Room between the axes' edge and what stands inside, in mm."""
LEAST = 0.4
"""Part of the axes that a drawing gets at least, whatever its letters need."""


def for_axes(
    drawing: Drawing, width: float, height: float, *, mechanism: bool
) -> tuple[list[Mark], Field, float]:
    """The marks of a mechanism or of its plan, their field, and how many times as large as on the
    sheet it is, in axes of a size in mm that have their upper left corner at (0, 0).

    Raises PageError where the axes are too small for the letters.
    """
    rect: Rect = (EDGE, EDGE, width - EDGE, height - EDGE)
    mm, metres = 1000 / drawing.scales.kL, drawing.scales.metres(drawing.kind)
    body, plan = drawing.mechanism_extent(), drawing.plan_extent()
    larger = times(body, mm, width, height), times(plan, mm, width, height)
    middle = with_poles([drawing], body, mm * larger[0], width).middle
    left = Field(rect, mm * larger[0], middle, centre(rect))
    right = Field(rect, mm * larger[1] * metres, plan.middle / metres, centre(rect))
    layout = Layout(left, right, {})
    layout = Layout(left, right, spans(drawing, layout))
    board = (left_board if mechanism else right_board)(drawing, layout, "key")
    marks = [mark for mark in lettered(board, width, height) if mark.name != HEADING]
    return (marks, left, larger[0]) if mechanism else (marks, right, larger[1])


def times(extent: Extent, mm: float, width: float, height: float) -> float:
    """How many times as large as on the sheet a drawing is in axes of a size."""
    sides = (
        (extent.width * mm, max(width - 2 * BESIDE, LEAST * width)),
        (extent.height * mm, max(height - 2 * ABOVE, LEAST * height)),
    )
    return min((room / side for side, room in sides if side > 0), default=1.0)


def lettered(board: FieldContent, width: float, height: float) -> list[Mark]:
    """The marks of a board with its letters. Raises PageError where there is no place for them."""
    try:
        return with_detail(board)
    except PageError as error:
        (problem,) = error.problems
        found = f"axes of {width:.0f} × {height:.0f} mm are too small: {problem.found}"
        hint = "a larger figure, or fewer axes in it"
        raise PageError(Problem("plot", found, problem.expected, hint)) from error
