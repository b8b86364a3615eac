"""What a scene says of forces: masses of links, gravity, loads, and what is asked of them.

All numbers are in SI units: kg, kg·m², N, N·m and m/s².
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from msgspec import Struct
from msgspec.structs import replace

from graphkin.scene.quantity import Quantity

Components = tuple[Quantity, Quantity]


class Mass(Struct, frozen=True):
    """The mass (kg) of a link at its point ``centre``, and its moment of inertia there (kg·m²)."""

    mass: Quantity
    centre: str
    inertia: Quantity | None = None


class Load(Struct, frozen=True):
    """A force (N) on a link ``at`` one of its points, or a moment (N·m) on the link, or both."""

    link: str
    at: str
    force: Components | None
    moment: Quantity | None


class Forces(Struct, frozen=True):
    """The masses by link, gravity (m/s²), the loads, and the reactions and balance that are asked.

    ``reactions`` are points, for pins, and blocks, for guides.
    """

    masses: Mapping[str, Mass]
    gravity: Components | None
    loads: tuple[Load, ...]
    reactions: tuple[str, ...] = ()
    balance: bool = False

    @property
    def asked(self) -> bool:
        """Whether any reaction or the balance is asked."""
        return bool(self.reactions) or self.balance

    def motions(self) -> Iterator[tuple[str, str]]:
        """The motions from which the forces follow, each a quantity with its point or link.

        They are the velocities of loaded points and links, for the lever, and the accelerations of
        masses.
        """
        for load in self.loads:
            if load.force is not None:
                yield "velocity", load.at
            if load.moment is not None:
                yield "omega", load.link
        for link, mass in self.masses.items():
            if mass.mass.is_zero():
                continue
            yield "velocity", mass.centre
            yield "acceleration", mass.centre
            if mass.inertia is not None and not mass.inertia.is_zero():
                yield "epsilon", link

    def called(self, names: Mapping[str, str]) -> Forces:
        """The same with links renamed."""
        return replace(
            self,
            masses={names.get(link, link): mass for link, mass in self.masses.items()},
            loads=tuple(replace(e, link=names.get(e.link, e.link)) for e in self.loads),
            reactions=tuple(names.get(name, name) for name in self.reactions),
        )
