"""Where a body stands while it moves: a point of it and a direction, traced."""

from __future__ import annotations

from typing import Any, NamedTuple


class BodyPose(NamedTuple):
    """Where a body stands: a point of it and a unit direction that turns with it."""

    origin: Any
    way: Any

    def is_same(self, other: BodyPose) -> bool:
        """Whether both are one pose at every place."""
        return is_one(self.origin, other.origin) and is_one(self.way, other.way)


def is_one(one: Any, other: Any) -> bool:
    """Whether two traced points or ways are one at every place."""
    return bool((one.node, one.imag.node) == (other.node, other.imag.node))


def unit(way: Any) -> Any:
    """A direction of length one."""
    return way / abs(way)
