"""Drawings in a notebook: both sheets as one picture, or one drawing in matplotlib's axes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, get_args

from graphkin.errors import Problem, SceneError
from graphkin.handout import drawings_of, hand_out, language_of, proved
from graphkin.paper.style import Ink
from graphkin.scaling import shown

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from graphkin.mechanism import Mechanism
    from graphkin.paper.drawing import Drawing

Which = Literal["mechanism", "velocity", "acceleration"]


def picture(mechanism: Mechanism) -> str:
    """The first sheet of a mechanism with its key, as SVG text."""
    from graphkin.paper.svg import write_svg

    return write_svg(hand_out(mechanism)[0].pages[0])


def plot(
    mechanism: Mechanism,
    ax: Axes,
    which: Which = "velocity",
    *,
    language: str | None = None,
    ink: Ink = "colour",
) -> Axes:
    """Draw the mechanism, its velocity plan or its acceleration plan into axes of matplotlib.

    One unit of the axes is a millimetre of paper, y up; the pole of a plan, or the origin of the
    frame, is the axes' origin. Raises as hand_out does, and SceneError where nothing of a plan is
    asked.
    """
    from graphkin.paper.axes import put_marks
    from graphkin.paper.detail import with_detail
    from graphkin.paper.layout import lay_out
    from graphkin.paper.marks import Text
    from graphkin.paper.sheet import left_board, right_board

    drawings = drawings_of(
        mechanism, proved(mechanism, shown(mechanism)), language_of(mechanism, language)
    )
    drawing = chosen(drawings, which)
    layout = lay_out(drawing)
    field = layout.mechanism if which == "mechanism" else layout.plan
    draw = left_board if which == "mechanism" else right_board
    marks = [
        mark
        for mark in with_detail(draw(drawing, layout, "key"))
        if not (isinstance(mark, Text) and mark.cls == "caption" and not mark.name)
    ]
    put_marks(ax, marks, field(0j), ink)
    return ax


def chosen(drawings: list[Drawing], which: Which) -> Drawing:
    """The drawing that shows a plan; the mechanism stands on the first."""
    if which not in get_args(Which):
        raise SceneError(Problem("plot", f"{which!r} is no drawing", ", ".join(get_args(Which))))
    for drawing in drawings:
        if which in ("mechanism", drawing.kind):
            return drawing
    raise SceneError(
        Problem(
            "plot",
            f"nothing of the {which} plan is asked",
            ", ".join(["mechanism", *(drawing.kind for drawing in drawings)]),
            f"ask for {'an' if which == 'acceleration' else 'a'} {which} under [ask]",
        )
    )
