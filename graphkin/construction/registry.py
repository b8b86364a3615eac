"""The kinds of acceleration components, and sentences that cover several constructions."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

from graphkin.construction.centres.instant_centre import with_centres_together
from graphkin.construction.centres.path_curvature import CURVATURE, PathCentre
from graphkin.construction.core.component import Component
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Construction, Sentence
from graphkin.construction.core.palette import (
    COINCIDE,
    COMPASS,
    CUT,
    DIVIDE,
    JOIN,
    LAY_OFF,
    MARK_OFF,
    PARALLEL,
    PERPENDICULAR,
    POLE,
    RAY,
    SET_OFF,
    SIMILAR,
    TRANSFER,
    PaletteAction,
)
from graphkin.construction.core.relation import Relation
from graphkin.construction.coriolis import CoriolisComponent
from graphkin.construction.forces.line_force import BeltStrand
from graphkin.construction.forces.loads import InertiaForce, InertiaMoment, PassedReaction, Weight
from graphkin.construction.forces.moments import ForceArm, TangentialPart
from graphkin.construction.forces.polygon import ClosedByLines
from graphkin.construction.higher_class.two_trials import with_trials_together
from graphkin.construction.links.plate_points import with_starts_together
from graphkin.construction.normal_component import (
    KleinComponent,
    NormalComponent,
    with_normals_together,
)
from graphkin.construction.rolling.contact_points import TOUCHING, TouchingEffect, of_contacts
from graphkin.construction.rolling.kutzbach import BEGINNING, PLAN, with_ladder_together
from graphkin.construction.rolling.wheel_images import RollingNormal

COMPONENTS: tuple[type[Component], ...] = (NormalComponent, RollingNormal, CoriolisComponent)
"""The acceleration components that follow from velocities."""
LIMITED = next(kind.limited for kind in COMPONENTS if kind.limited)
"""The name of the figure that can be too narrow or too long to be drawn."""
PALETTE: Mapping[str, PaletteAction] = {
    action.key: action
    for action in (
        PERPENDICULAR,
        PARALLEL,
        CUT,
        LAY_OFF,
        COMPASS,
        MARK_OFF,
        SIMILAR,
        COINCIDE,
        NormalComponent.palette,
        KleinComponent.palette,
        CoriolisComponent.palette,
        JOIN,
        DIVIDE,
        POLE,
        CURVATURE,
        TRANSFER,
    )
}
"""The actions of a page's palette, in its order."""
BOARD: Mapping[str, PaletteAction] = {
    action.key: action for action in (RAY, SET_OFF, *PALETTE.values()) if action.draw is not None
}
"""The actions of the board of a task page."""
SLIPPING: tuple[type[Construction], ...] = (
    BeltStrand,
    ClosedByLines,
    TangentialPart,
    PassedReaction,
    ForceArm,
    Weight,
    InertiaMoment,
    InertiaForce,
    PathCentre,
    *COMPONENTS,
)
"""The kinds of constructions in which slips are made, each with its ``slips``."""
SLIPS = {name: slip for kind in reversed(SLIPPING) for name, slip in kind.slips.items()}
"""All slips by name; several kinds may share one."""
CAUSES: tuple[type[Component] | TouchingEffect, ...] = (*COMPONENTS, *TOUCHING)
"""The classes that can say why an effect is in or out of a scene."""
SAID_FIRST = {PLAN: BEGINNING}
"""The text of a page before a student draws a plan next to the velocity plan."""
ALSO_READ: tuple[Callable[[Drawing], Iterator[Relation]], ...] = (of_contacts,)
"""Further relations read off a plan, after everything drawn in it."""
TOGETHER: tuple[Callable[[Drawing, list[Sentence]], list[Sentence]], ...] = (
    with_trials_together,
    with_starts_together,
    with_centres_together,
    with_normals_together,
    with_ladder_together,
)
"""The functions that merge several constructions of a kind in one sentence, in their order."""
