"""The count of freedoms: Gruebler in the plane, Kutzbach in space."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from graphkin.scene.model import Scene
from graphkin.structure.graph import pairs


@dataclass(frozen=True, slots=True)
class Count:
    """Moving links, pairs that leave one freedom, and the freedoms that the count leaves."""

    moving: int
    pairs: int

    @property
    def mobility(self) -> int:
        """Gruebler: three freedoms a moving link, two taken by each lower pair."""
        return 3 * self.moving - 2 * self.pairs


def count(scene: Scene) -> Count:
    """Gruebler's count of a scene, multiple hinges counted as so many pairs less one."""
    return Count(len(scene.links), len(pairs(scene)))


def kutzbach(links: int, pairs_by_freedom: Mapping[int, int]) -> int:
    """Freedoms of a mechanism in space: 6(n - 1) less 6 - f for each pair of f freedoms.

    ``links`` counts the frame; ``pairs_by_freedom`` maps f (1 to 5) to the number of such pairs.
    """
    return 6 * (links - 1) - sum((6 - f) * number for f, number in pairs_by_freedom.items())
