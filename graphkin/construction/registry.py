"""The kinds of constructions, in the order in which calculation pages and slips name them."""

from __future__ import annotations

from graphkin.construction.core.component import Component, LaidOff
from graphkin.construction.core.kind import Construction
from graphkin.construction.coriolis.coriolis import CoriolisComponent
from graphkin.construction.links.counted_turn import CountedTurn
from graphkin.construction.links.placed_point import PlacedPoint
from graphkin.construction.normal_component.normal_component import NormalComponent
from graphkin.construction.rolling.common_normal import CommonNormal
from graphkin.construction.rolling.contact_points import (
    CentrePath,
    ContactOfWheels,
    ContactOnTrack,
    RackPoint,
    RollerCentre,
    Track,
)
from graphkin.construction.rolling.rolling_normal import RollingNormal

COMPONENTS: tuple[type[Component], ...] = (NormalComponent, RollingNormal, CoriolisComponent)
"""The components of accelerations that follow from velocities."""
KINDS: tuple[type[Construction], ...] = (
    *COMPONENTS,
    LaidOff,
    Track,
    CentrePath,
    ContactOnTrack,
    ContactOfWheels,
    RackPoint,
    RollerCentre,
    CommonNormal,
    CountedTurn,
    PlacedPoint,
)
"""All kinds."""
