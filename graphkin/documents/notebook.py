"""Drawings in a notebook: both sheets as one picture, or one drawing in matplotlib's axes."""

from __future__ import annotations

from typing import TYPE_CHECKING, get_args

from graphkin.documents.scaling import shown
from graphkin.documents.sheet_documents import drawings_of, hand_out, language_of, proved
from graphkin.drawing.style import Ink
from graphkin.mechanism import Mechanism, Which
from graphkin.text.errors import Problem, SceneError

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from graphkin.construction.core.drawn_scene import Drawing


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
    """Draw the mechanism, its velocity plan or its acceleration plan into axes of matplotlib.

    One unit of the axes is a millimetre of the sheet, y up; the pole of a plan, or the origin of
    the frame, is the axes' origin. The drawing fills the axes as large as they are now; lines,
    arrowheads and letters have the sheet's own sizes (capitals of 2.5 mm, as text of 10 points)
    in every figure. Raises as hand_out does, PageError where the axes are too small for the
    letters, and SceneError where nothing of a plan is asked.
    """
    from graphkin.documents.figure import for_axes
    from graphkin.writers.axes import put_drawing, size_of

    spoken, mechanism = language_of(mechanism, language), mechanism.spoken(language)
    drawings = drawings_of(mechanism, proved(mechanism, shown(mechanism)), spoken)
    drawing = chosen(drawings, which)
    marks, field, times = for_axes(drawing, *size_of(ax), mechanism=which == "mechanism")
    put_drawing(ax, marks, field, times, ink)
    return ax


def chosen(drawings: list[Drawing], which: Which) -> Drawing:
    """The drawing that shows a plan; the mechanism stands on the first."""
    from graphkin.construction.core.naming import has_plan

    if which not in get_args(Which):
        raise SceneError(Problem("plot", f"{which!r} is no drawing", ", ".join(get_args(Which))))
    for drawing in drawings:
        if which == "mechanism" or (which == drawing.kind and has_plan(drawing)):
            return drawing
    raise SceneError(
        Problem(
            "plot",
            f"nothing of the {which} plan is asked",
            ", ".join(["mechanism", *(drawing.kind for drawing in drawings if has_plan(drawing))]),
            f"ask for {'an' if which == 'acceleration' else 'a'} {which} under [ask]",
        )
    )
