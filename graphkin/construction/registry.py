"""The kinds of components of accelerations, and what is said of several constructions at once."""

from __future__ import annotations

from collections.abc import Callable

from graphkin.construction.centres.relative_centre import with_centres_together
from graphkin.construction.core.component import Component
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.sentence import Sentence
from graphkin.construction.coriolis.coriolis import CoriolisComponent
from graphkin.construction.higher_class.two_trials import with_trials_together
from graphkin.construction.links.placed_point import with_starts_together
from graphkin.construction.normal_component.normal_component import (
    NormalComponent,
    with_normals_together,
)
from graphkin.construction.rolling.kutzbach import with_ladder_together
from graphkin.construction.rolling.rolling_normal import RollingNormal
from graphkin.construction.rolling.touching import TOUCHING, TouchingEffect

COMPONENTS: tuple[type[Component], ...] = (NormalComponent, RollingNormal, CoriolisComponent)
"""The components of accelerations that follow from velocities."""
CAUSES: tuple[type[Component] | TouchingEffect, ...] = (*COMPONENTS, *TOUCHING)
"""What knows why an effect is in or out of a scene."""
TOGETHER: tuple[Callable[[Drawing, list[Sentence]], list[Sentence]], ...] = (
    with_trials_together,
    with_starts_together,
    with_centres_together,
    with_normals_together,
    with_ladder_together,
)
"""What says several constructions of a kind in one sentence, in the order in which it is done."""
