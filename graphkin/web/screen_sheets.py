"""The sheets of a screen page: the two fields of each sheet, as marks in page millimetres."""

from __future__ import annotations

from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.layout import Layout, lay_out
from graphkin.documents.detail import insets, parted
from graphkin.documents.scaling import sheet_motion
from graphkin.documents.sheet import left_board, right_board
from graphkin.documents.sheet_documents import drawings_of, language_of, proved
from graphkin.drawing.field import Field
from graphkin.drawing.marks import Mark
from graphkin.mechanism import Mechanism


class ScreenSheet(Struct, frozen=True):
    """The marks of a sheet's two fields; mark k of sheet s has the id ``m{s}-{k}``.

    ``left`` is the field of the mechanism, ``right`` the field of the plan; k counts the left marks
    first. ``more_left`` and ``more_right`` are pictures within the picture (an enlarged detail,
    insets), which hold for the drawn position alone. ``enlarged`` is the magnification of the first
    detail of each field, listed once if both are equal.
    """

    drawing: Drawing
    layout: Layout
    left: tuple[Mark, ...]
    right: tuple[Mark, ...]
    more_left: tuple[Mark, ...] = ()
    more_right: tuple[Mark, ...] = ()
    enlarged: tuple[int, ...] = ()

    @property
    def marks(self) -> tuple[Mark, ...]:
        return (*self.left, *self.right, *self.more_left, *self.more_right)


def screen_sheets(
    mechanism: Mechanism, language: str | None = None, view: str = "key"
) -> list[ScreenSheet]:
    """The sheets that a scene asks for, at one scale, each verified first.

    ``view`` is key or task. Raises WitnessError when the independent route disagrees, and PageError
    where a drawing does not fit.
    """
    spoken = language_of(mechanism, language)
    verdict = proved(mechanism, sheet_motion(mechanism))
    drawings = drawings_of(mechanism, verdict, spoken)
    return [screen_sheet(drawing, lay_out(drawing), view) for drawing in drawings]


def screen_sheet(drawing: Drawing, layout: Layout, view: str = "key") -> ScreenSheet:
    """The fields of one drawing."""
    layout = on_grid(layout) if view == "task" else layout
    boards = left_board(drawing, layout, view), right_board(drawing, layout, view)
    (left, detail, times), (right, other, others) = parted(*boards)
    if view == "key":
        detail += insets(drawing, layout.mechanism, [*left, *detail])
    enlarged = tuple(dict.fromkeys((*times[:1], *others[:1])))
    more = tuple(detail), tuple(other), enlarged
    return ScreenSheet(drawing, layout, tuple(left), tuple(right), *more)


GRID = 10.0
"""The grid of a task's fields, in mm."""


def on_grid(layout: Layout) -> Layout:
    """The fields of a task with edges and origins on a grid.

    Their exact places would tell how far the drawing extends to each side.
    """
    edge = round(layout.mechanism.rect[2] / GRID) * GRID
    return replace(
        layout, mechanism=placed(layout.mechanism, 2, edge), plan=placed(layout.plan, 0, edge)
    )


def placed(field: Field, side: int, edge: float) -> Field:
    """A field with one edge moved, and its origin on the grid."""
    rect = list(field.rect)
    rect[side] = edge
    x, y = (round(place / GRID) * GRID for place in field(0j))
    return replace(field, rect=(rect[0], rect[1], rect[2], rect[3]), middle=0j, at=(x, y))
