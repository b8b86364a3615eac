"""Drawings in a notebook: both sheets as one picture, or one drawing in matplotlib axes."""

from __future__ import annotations

from typing import TYPE_CHECKING, get_args

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.layout import Layout, centre, poles_of, spans, with_poles
from graphkin.documents.detail import parted
from graphkin.documents.scaling import sheet_motion
from graphkin.documents.sheet import HEADING, left_board, right_board
from graphkin.documents.sheet_documents import drawings_of, hand_out, language_of, proved
from graphkin.drawing.field import ABOVE, Field, Rect
from graphkin.drawing.labels import FieldContent, must_be_named, no_place_for
from graphkin.drawing.marks import Mark, Text
from graphkin.drawing.scale import Extent
from graphkin.drawing.style import Ink
from graphkin.mechanism import Mechanism, Which
from graphkin.text.errors import PageError, SceneError, joined, message

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def picture(mechanism: Mechanism) -> str:
    """The first sheet of a mechanism with its key, as SVG text."""
    from graphkin.writers.svg import write_svg

    return write_svg(hand_out(mechanism)[0].pages[0])


def plot(
    mechanism: Mechanism,
    ax: Axes,
    which: Which = "velocity",
    *,
    language: str | None = None,
    ink: Ink = "colour",
) -> Axes:
    """Draw the mechanism, its velocity plan or its acceleration plan into matplotlib axes.

    One unit of the axes is a millimetre of the sheet, with y up. The origin is the pole of a plan,
    or the origin of the frame. The drawing fills the axes at their present size. Lines, arrowheads
    and letters have the sheet's own sizes in every figure (capitals of 2.5 mm, as text of 10
    points).

    Raises the errors of hand_out. Raises PageError where the axes are too small for most letters,
    and SceneError where the scene asks for nothing of a plan.
    """
    from graphkin.writers.axes import put_drawing, size_of

    mechanism = mechanism.spoken(language).measured
    spoken = language_of(mechanism, language)
    drawings = drawings_of(mechanism, proved(mechanism, sheet_motion(mechanism)), spoken)
    drawing = chosen(drawings, which)
    marks, field, times = for_axes(drawing, *size_of(ax), mechanism=which == "mechanism")
    put_drawing(ax, marks, field, times, ink)
    return ax


def chosen(drawings: list[Drawing], which: Which) -> Drawing:
    """The drawing that shows a plan; the mechanism is on the first."""
    from graphkin.construction.core.naming import has_plan

    if which not in get_args(Which):
        raise SceneError.at(
            "plot", message("{which!r} is no drawing", which=which), joined(", ", get_args(Which))
        )
    for drawing in drawings:
        if which == "mechanism" or (which == drawing.kind and has_plan(drawing)):
            return drawing
    raise SceneError.at(
        "plot",
        message("nothing of the {which} plan is asked", which=which),
        joined(", ", ("mechanism", *(each.kind for each in drawings if has_plan(each)))),
        message("ask for {which} under [ask]", which=which),
    )


BESIDE = 12.0
"""Room left and right of a drawing for its letters, in mm."""
EDGE = 1.0
"""Room between the axes' edge and their content, in mm."""
LEAST = 0.4
"""Least part of the axes for a drawing, whatever its letters need."""


def for_axes(
    drawing: Drawing, width: float, height: float, *, mechanism: bool
) -> tuple[list[Mark], Field, float]:
    """The marks of a mechanism or of its plan, their field, and the enlargement.

    The enlargement is relative to the sheet. The axes have a size in mm and their upper left corner
    at (0, 0). Raises PageError where the axes are too small for most letters.
    """
    rect: Rect = (EDGE, EDGE, width - EDGE, height - EDGE)
    mm, metres = 1000 / drawing.scales.kL, drawing.scales.metres(drawing.kind)
    body, plan = drawing.mechanism_extent(), drawing.plan_extent()
    larger = times(body, mm, width, height), times(plan, mm, width, height)
    middle = with_poles(drawing.paper, body, poles_of(drawing), mm * larger[0], width).middle
    left = Field(rect, mm * larger[0], middle, centre(rect))
    right = Field(rect, mm * larger[1] * metres, plan.middle / metres, centre(rect))
    layout = Layout(left, right, {})
    layout = Layout(left, right, spans(drawing, layout))
    board = (left_board if mechanism else right_board)(drawing, layout, "key")
    marks = [mark for mark in lettered(board, width, height) if mark.name != HEADING]
    return (marks, left, larger[0]) if mechanism else (marks, right, larger[1])


def times(extent: Extent, mm: float, width: float, height: float) -> float:
    """The enlargement of a drawing relative to the sheet, in axes of a size."""
    sides = (
        (extent.width * mm, max(width - 2 * BESIDE, LEAST * width)),
        (extent.height * mm, max(height - 2 * ABOVE, LEAST * height)),
    )
    return min((room / side for side, room in sides if side > 0), default=1.0)


def lettered(board: FieldContent, width: float, height: float) -> list[Mark]:
    """The marks of a board with its letters.

    Raises PageError where more letters and numbers are only noted than have a place.
    """
    (field,) = parted(board)
    shown = {mark.markup for mark in field.details if isinstance(mark, Text)}
    lost = [label for label in board.unplaced if label.markup not in shown]
    if len(lost) > sum(map(must_be_named, board.labels)):
        problem = no_place_for(lost)
        found = message(
            "axes of {width:.0f} × {height:.0f} mm are too small: {found}",
            width=width,
            height=height,
            found=problem.found,
        )
        hint = message("a larger figure, or fewer axes in it")
        raise PageError.at("plot", found, problem.expected, hint)
    return [*field.marks, *field.details]
