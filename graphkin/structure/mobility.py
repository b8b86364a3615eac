"""The count of freedoms: Gruebler in the plane, Kutzbach in space; and of independent loops."""

from __future__ import annotations

from collections.abc import Mapping

from msgspec import Struct

from graphkin.scene.model import Scene
from graphkin.structure.pairs import all_pairs


class Count(Struct, frozen=True):
    """Moving links, pairs that take two freedoms, and those that take one.

    ``pairs`` are pins, slides, and wheels that their track alone keeps; ``singles`` are wheels that
    touch at a distance which an arm keeps already, teeth and tracks.
    """

    moving: int
    pairs: int
    singles: int = 0

    @property
    def mobility(self) -> int:
        """Gruebler: three freedoms a moving link, less what the pairs take."""
        return gruebler(self.moving, self.pairs, self.singles)

    @property
    def loops(self) -> int:
        """Independent closed loops: pairs beyond those that a tree of as many links needs."""
        return self.pairs + self.singles - self.moving

    @property
    def words(self) -> str:
        """The sum as it is written: 3·5 − 2·7 = 1."""
        singles = f" − 1·{self.singles}" if self.singles else ""
        return f"3·{self.moving} − 2·{self.pairs}{singles} = {self.mobility}".replace("= -", "= −")


def count(scene: Scene) -> Count:
    """Gruebler's count of a scene, a pin of k links counted as k - 1 pairs.

    Links put in to keep wheels on their tracks count with the pair that they stand for.
    Raises StructureError for wheels that do not touch.
    """
    bare = scene.bare
    every = all_pairs(bare)
    singles = sum(pair.taken == 1 for pair in every)
    return Count(len(bare.links), len(every) - singles, singles)


def gruebler(moving: int, lower: int, higher: int = 0) -> int:
    """Freedoms in the plane: 3 a moving link, less 2 a lower pair and 1 a higher pair.

    Lower pairs are pins and slides; higher ones cams, teeth and belts. Springs take nothing.
    """
    return 3 * moving - 2 * lower - higher


def kutzbach(links: int, pairs_by_freedom: Mapping[int, int]) -> int:
    """Freedoms of a mechanism in space: 6(n - 1) less 6 - f for each pair of f freedoms.

    ``links`` counts the frame; ``pairs_by_freedom`` maps f (1 to 5) to the number of such pairs.
    """
    return 6 * (links - 1) - sum((6 - f) * number for f, number in pairs_by_freedom.items())
