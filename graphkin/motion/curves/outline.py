"""The mechanism as the scene stands, drawn lightly under paths and centrodes."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.solution import Verdict
from graphkin.construction.links.mechanism_symbols import draw_ground, draw_links
from graphkin.drawing.field import Field
from graphkin.drawing.labels import FieldContent, free_ones
from graphkin.drawing.scale import Scales
from graphkin.mechanism import Mechanism
from graphkin.motion.cycle import Cycle
from graphkin.text import words
from graphkin.text.errors import ClosureError

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Box = tuple[float, float, float, float]
MILLIMETRES = 180.0
"""Longer side of a picture in mm."""
FAINT = 0.6
"""How strong the lines of the mechanism are beside the curves."""
MOST_POINTS = 60
"""Points of a mechanism beyond which a picture shows only the part that it is about."""


class Outline(Struct, frozen=True):
    """The mechanism where the scene has it; ``factor`` turns metres into the picture's unit.

    ``drawn`` tells whether the scene itself can be drawn: else the first row of the cycle takes its
    place. ``left_out`` says what is not drawn.
    """

    drawing: Drawing
    factor: float
    drawn: bool
    left_out: str = ""

    @property
    def places(self) -> Mapping[str, complex]:
        """Where every point stands, in the unit of the picture."""
        return {name: place * self.factor for name, place in self.drawing.positions.items()}

    def breadth(self) -> float:
        """The longer side of the box around the mechanism."""
        every = np.array(list(self.places.values()))
        return float(max(np.ptp(every.real), np.ptp(every.imag))) or 1.0


def stand_of(cycle: Cycle, factor: float) -> Outline:
    """Where the mechanism stands in its scene."""
    try:
        return Outline(placed(cycle.mechanism), factor, True)
    except ClosureError:
        first = cycle.pieces[cycle.piece[0] - 1]
        return Outline(placed(Mechanism(first.course.standing(cycle.at[0]))), factor, False)


def placed(mechanism: Mechanism) -> Drawing:
    """A mechanism without its plans."""
    trace = mechanism.trace([t for t in mechanism.program.targets if t[0] in ("position", "axis")])
    nobody = Verdict(True, 0.0, "", 0.0, 0.0, 0.0)
    scales = Scales(1.0, 1.0, triangles=False)
    return Drawing("velocity", mechanism.scene, trace, scales, nobody, words("en"))


def stand_about(cycle: Cycle, factor: float, points: Collection[str]) -> Outline:
    """Where the mechanism stands; of a very long one only the links that have one of the points."""
    stand = stand_of(cycle, factor)
    if len(stand.places) <= MOST_POINTS:
        return stand
    scene, every = stand.drawing.scene, stand.drawing.scene.links
    links = {name: link for name, link in every.items() if not set(points).isdisjoint(link.points)}
    return replace(
        stand,
        drawing=replace(stand.drawing, scene=replace(scene, links=links)),
        left_out=f"{len(links)} of {len(every)} links drawn",
    )


def draw(ax: Axes, stand: Outline, box: Box) -> None:
    """The mechanism with the letters for which there is room, in axes that hold a ``box``."""
    from graphkin.writers.axes import put_to_scale

    (x0, x1, y0, y1), per_metre = box, stand.factor
    times = MILLIMETRES / max(x1 - x0, y1 - y0)
    middle = complex(x0 + x1, y0 + y1) / (2 * per_metre)
    wide, high = (x1 - x0) * times, (y1 - y0) * times
    rect = (0.0, 0.0, wide, high)
    field = Field(rect, per_metre * times, middle, (wide / 2, high / 2))
    board = FieldContent(rect)
    draw_ground(board, stand.drawing, field)
    draw_links(board, stand.drawing, field)
    marks = [*board.marks, *free_ones(board, board.spots([]))]
    put_to_scale(ax, marks, field(0j), times, strength=FAINT)
