"""The residual check: a solution compared with vector loops independent of its construction.

A disagreement is the absolute difference divided by the largest magnitude of that quantity in the
scene. A scale is at least a thousandth of the value expected from the other quantities (v ≈ ω·L and
so on). Near singular positions it is at least the share of rounding in the limit. Otherwise the
rounding of a quantity that is zero everywhere would count as a difference.
"""

from graphkin.loops.witness.differences import sure_of
from graphkin.loops.witness.examine import Check, compare, examine

__all__ = ["Check", "compare", "examine", "sure_of"]
