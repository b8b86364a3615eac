"""The centres and poles of links, each planned by its own kind."""

from __future__ import annotations

from collections.abc import Sequence

from graphkin.construction.centres.acceleration_poles import draw_pole
from graphkin.construction.centres.inflection import draw_circle
from graphkin.construction.centres.instant_centre import draw_centre
from graphkin.construction.centres.kennedy import relative
from graphkin.construction.core.bases import Base
from graphkin.construction.core.pen import Pen


def draw_centres(pen: Pen, bases: Sequence[Base]) -> None:
    """Every centre and pole: first those of velocities, then those of accelerations."""
    for base in bases:
        draw_centre(pen, base)
    relative(pen)
    for base in bases:
        draw_pole(pen, base)
        draw_circle(pen, base)
