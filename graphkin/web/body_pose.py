"""The traced pose of a moving body: one of its points and a direction."""

from __future__ import annotations

from typing import Any, NamedTuple


class BodyPose(NamedTuple):
    """The pose of a body: one of its points and a unit direction that turns with it."""

    origin: Any
    way: Any

    def is_same(self, other: BodyPose) -> bool:
        """Whether both are the same pose at every position."""
        return is_one(self.origin, other.origin) and is_one(self.way, other.way)


def is_one(one: Any, other: Any) -> bool:
    """Whether two traced points or directions are the same at every position."""
    return bool((one.node, one.imag.node) == (other.node, other.imag.node))


def unit(way: Any) -> Any:
    return way / abs(way)
