"""A cycle of the motion: a turn of the driver or its reachable range, in pieces of one closure."""

from graphkin.motion.cycle import Cycle, cycle

__all__ = ["Cycle", "cycle"]
