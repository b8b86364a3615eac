"""The kinds of components of accelerations, as calculation pages and slips name them."""

from __future__ import annotations

from graphkin.construction.core.component import Component
from graphkin.construction.coriolis.coriolis import CoriolisComponent
from graphkin.construction.normal_component.normal_component import NormalComponent
from graphkin.construction.rolling.rolling_normal import RollingNormal

COMPONENTS: tuple[type[Component], ...] = (NormalComponent, RollingNormal, CoriolisComponent)
"""The components of accelerations that follow from velocities."""
