"""What a scene says of forces: masses of links, gravity, loads, and what is asked of them.

All numbers are in SI units: kg, kg·m², N, N·m and m/s².
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import isclose

from msgspec import Struct
from msgspec.structs import replace

from graphkin.scene.quantity import Quantity

Components = tuple[Quantity, Quantity]


class Mass(Struct, frozen=True):
    """The mass (kg) of a link at its point ``centre``, and its moment of inertia there (kg·m²)."""

    mass: Quantity
    centre: str
    inertia: Quantity | None = None


class ByDriver(Struct, frozen=True):
    """A number from a table over the coordinate of a driver (its number in the scene).

    Between two points of the table, the number is interpolated linearly. ``places`` are the
    coordinates in the driver's unit, in increasing order and without parameters; ``numbers`` are
    the values there. A table of angles repeats after ``period``. Any other table keeps its first
    number before its first place, and its last number after its last one.
    """

    driver: int
    places: tuple[Quantity, ...]
    numbers: tuple[Quantity, ...]
    period: Quantity | None

    @property
    def begins_again(self) -> bool:
        """Whether the table ends before its period, so that its first number closes it."""
        if self.period is None:
            return False
        last, first, period = (
            float(e.si({})) for e in (self.places[-1], self.places[0], self.period)
        )
        return not isclose(last - first, period)

    @property
    def knots(self) -> tuple[tuple[float, ...], float]:
        """The places in SI units, up to a whole period, and the period; 0 without one."""
        places = tuple(float(place.si({})) for place in self.places)
        period = 0.0 if self.period is None else float(self.period.si({}))
        return ((*places, places[0] + period) if self.begins_again else places), period

    @property
    def ends(self) -> tuple[Quantity, ...]:
        """The number at each knot."""
        return (*self.numbers, self.numbers[0]) if self.begins_again else self.numbers


Size = Quantity | ByDriver
"""A number that the scene states, or that follows from a table."""


class Directed(Struct, frozen=True):
    """A force by its size and its ``angle`` against the x axis of the frame.

    With a ``sense`` it acts along (+1) or against (-1) the velocity of its point instead.
    """

    size: Size
    angle: Quantity
    sense: int = 0


class Load(Struct, frozen=True):
    """A force (N) on a link ``at`` one of its points, or a moment (N·m) on the link, or both."""

    link: str
    at: str
    force: Components | Directed | None
    moment: Size | None


class Spring(Struct, frozen=True):
    """A spring between two points of two links: its stiffness (N/m) and its free length."""

    ends: tuple[str, str]
    links: tuple[str, str]
    stiffness: Quantity
    free: Quantity


class Forces(Struct, frozen=True):
    """The masses by link, gravity (m/s²), loads and springs, and what is asked of forces.

    ``reactions`` are points, for pins, and blocks, for guides.
    """

    masses: Mapping[str, Mass]
    gravity: Components | None
    loads: tuple[Load, ...]
    reactions: tuple[str, ...] = ()
    balance: bool = False
    springs: tuple[Spring, ...] = ()

    @property
    def asked(self) -> bool:
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
        for spring in self.springs:
            yield from (("velocity", end) for end in spring.ends)
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
            springs=tuple(
                replace(
                    e, links=(names.get(e.links[0], e.links[0]), names.get(e.links[1], e.links[1]))
                )
                for e in self.springs
            ),
            reactions=tuple(names.get(name, name) for name in self.reactions),
        )
