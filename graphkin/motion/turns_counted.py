"""The whole turns of links along a sweep, where wheels depend on them.

A position shows the direction of a link, but not how many turns it has made since its wheels were
at the start. Along a motion this is known, because the angle is continuous. The angles near which
links count are therefore followed from the position in which the scene states them.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from msgspec import Struct

from graphkin.scene.expression import Name
from graphkin.scene.model import Scene
from graphkin.scene.quantity import Quantity
from graphkin.structure.turn_counting import counted_near

Reals = np.ndarray[Any, np.dtype[Any]]


def name_of(link: str) -> str:
    """The name of the angle near which a link counts; no parameter can have such a name."""
    return f"turned {link}"


def named_angles(scene: Scene) -> tuple[dict[str, Quantity], dict[str, Any]]:
    """The angles near which links count, as named values in degrees, and their values."""
    near = counted_near(scene)
    values = {name_of(link): degrees_of(angle, scene) for link, angle in near.items()}
    named = {link: Quantity(name_of(link), Name(name_of(link)), "deg") for link in near}
    return named, values


def degrees_of(angle: Quantity, scene: Scene) -> Any:
    """An angle in degrees, exact where it is stated in degrees."""
    if angle.unit == "deg":
        return angle.number(scene.values)
    return float(np.degrees(angle.si(scene.values)))


class Turned(Struct, frozen=True, eq=False):
    """The angles (degrees) near which links count, each from a u in ``at`` on: (N,)."""

    at: Reals
    near: Mapping[str, Reals]

    def values(self, at: Any) -> dict[str, Any]:
        """The named angles at any u; before the first u, the first angles hold."""
        here = np.maximum(np.searchsorted(self.at, at, side="right") - 1, 0)
        return {name_of(link): row[here] for link, row in self.near.items()}

    def beside(self, other: Turned | None) -> Turned:
        """With the additional links of another."""
        more = {} if other is None else {k: n for k, n in other.near.items() if k not in self.near}
        if other is None or not more:
            return self
        at = np.union1d(self.at, other.at)
        near = {**self.values(at), **Turned(other.at, more).values(at)}
        return Turned(at, {link: near[name_of(link)] for link in (*self.near, *more)})

    def joined(self, other: Turned | None) -> Turned:
        """With the values of u of another that follow."""
        if other is None:
            return self
        both = {link: np.append(row, other.near[link]) for link, row in self.near.items()}
        return Turned(np.append(self.at, other.at), both)

    def within(self, low: float, high: float) -> Turned:
        """The part from one u to another."""
        here = (low < self.at) & (self.at < high)
        first = self.values(low)
        near = {link: np.append(first[name_of(link)], row[here]) for link, row in self.near.items()}
        return Turned(np.append(low, self.at[here]), near)

    def moved(self, by: float, gone: Mapping[str, float]) -> Turned:
        """The same motion shifted by ``by``, with links turned further by ``gone`` (degrees)."""
        near = {link: row + gone.get(link, 0.0) for link, row in self.near.items()}
        return Turned(self.at + by, near)
