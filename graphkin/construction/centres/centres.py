"""The centres and poles of links, each planned by its own kind."""

from __future__ import annotations

from collections.abc import Sequence

from graphkin.construction.centres.acceleration_poles import draw_pole
from graphkin.construction.centres.instant_centre import draw_centre
from graphkin.construction.core.bases import Base
from graphkin.construction.core.pen import Pen


def draw_centres(pen: Pen, bases: Sequence[Base]) -> None:
    """Every centre and pole: first those of velocities, then those of accelerations.

    What only some scenes ask is loaded for these.
    """
    for base in bases:
        draw_centre(pen, base)
    if pen.scene.ask.pairs:
        from graphkin.construction.centres.kennedy import draw_relative

        draw_relative(pen)
    for base in bases:
        draw_pole(pen, base)
        if base.link in pen.scene.ask.inflection:
            from graphkin.construction.centres.inflection import draw_circle

            draw_circle(pen, base)
